"""Numbers about a line: how long it is, how wide its area, how near to where it should be.

Every measure takes one geometry or arrays that broadcast, and gives a float or an array; what is
missing or empty has NaN.
"""

from midrib.measures.widths import largest_width, length, mean_width, width

__all__ = ["largest_width", "length", "mean_width", "width"]
