"""Numbers about a line: how long it is, how wide its area, how near to where it should be.

Every measure takes one geometry or arrays that broadcast, and gives a float or an array; what is
missing or empty has NaN. Those that go along a line take one and give an array along it.
"""

from midrib.measures.containing import length_ratio, outside_length, turning
from midrib.measures.nearness import Deviation, centredness, deviation, symmetry
from midrib.measures.radii import gap_share, jumps
from midrib.measures.widths import largest_width, length, mean_width, width

__all__ = [
    "Deviation",
    "centredness",
    "deviation",
    "gap_share",
    "jumps",
    "largest_width",
    "length",
    "length_ratio",
    "mean_width",
    "outside_length",
    "symmetry",
    "turning",
    "width",
]
