"""Places in tables: whole numbers that are not negative, and that the compiler knows not to be.

A negative index counts from the end, and a remainder of it is no negative number. To have both
looked after at every access took a fifth of the time of a triangulation. A negative number is not
to be handed over: it would be a place far outside of every table.
"""

from midrib.kernels.jit import njit

__all__ = ["FURTHEST", "place"]

LAST = 2**62 - 1
FURTHEST = 2**31 - 1  # of tables whose places take half as much room: less goes through the cache


@njit(inline=True, borrows=True)
def place(i: int) -> int:
    """Return a number, which is not negative, as one that cannot be."""
    return int(i) & LAST
