"""How panels with the same shape in each are laid out on a sheet of a given width.

A sheet is between half as high as it is wide and ``TALLEST`` times as high, whatever the shape: of
all numbers of columns, and of the shape upright and turned by a quarter, that layout is taken in
which the shape is largest, for what the sheet takes.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["GAP", "Sheet", "sheet_of"]

TITLE, GAP = 9.5, 4.0  # millimetres: a title with air above it, and between columns
NARROWEST = 40.0  # millimetres: panel that has room for its title
FLATTEST, TALLEST = 0.5, 1.4  # height of a sheet over its width
TURNED = 1.25  # times as large as upright a shape is to be, or north stays up
LOWEST = 5.0  # millimetres: panel, however small the sheet
MARGIN = 1.02  # a panel's size over what of it a shape may fill


class Sheet(NamedTuple):
    """A layout, lengths in millimetres."""

    width: float
    height: float
    columns: int
    panel: "Floats"  # (2,) width and height
    scale: float  # millimetres of one unit of the shape
    is_turned: bool  # by a quarter, clockwise

    def place(self, k: int) -> tuple[float, float, float, float]:
        """Left, bottom, width and height of panel k as shares of the sheet."""
        left = GAP + k % self.columns * (self.panel[0] + GAP)
        bottom = self.height - (k // self.columns + 1) * (self.panel[1] + TITLE)
        return (
            left / self.width,
            bottom / self.height,
            self.panel[0] / self.width,
            self.panel[1] / self.height,
        )


def sheet_of(count: int, extent: "Floats", width: float, footer: float) -> Sheet:
    """Lay out panels.

    Parameters
    ----------
    count : int
        How many there are.
    extent : ndarray, shape (2,)
        Width and height of the shape.
    width, footer : float
        Of the sheet, and of what is below the panels, in millimetres.

    Returns
    -------
    Sheet
    """
    upright = best(count, extent, width, footer)
    if extent[1] > extent[0]:
        turned = best(count, extent[::-1], width, footer)
        if turned.scale > TURNED * upright.scale:
            return turned._replace(is_turned=True)
    return upright


def best(count: int, extent: "Floats", width: float, footer: float) -> Sheet:
    """Take the number of columns with the largest shape for what the sheet takes."""
    most = max(min(count, int((width - GAP) / (NARROWEST + GAP))), 1)
    layouts = [layout(count, n, extent, width, footer) for n in range(1, most + 1)]
    return max(layouts, key=lambda sheet: sheet.scale / np.cbrt(sheet.height))


def layout(count: int, columns: int, extent: "Floats", width: float, footer: float) -> Sheet:
    """Lay out panels in a number of columns, as high as the shape needs and the sheet allows."""
    rows = -(-count // columns)
    wide = (width - (columns + 1) * GAP) / columns
    low, high = ((share * width - footer) / rows - TITLE for share in (FLATTEST, TALLEST))
    tall = max(float(np.clip(wide * extent[1] / extent[0], low, high)), LOWEST)
    panel = np.array([wide, tall])
    height = rows * (tall + TITLE) + footer
    return Sheet(width, height, columns, panel, float((panel / extent).min()) / MARGIN, False)
