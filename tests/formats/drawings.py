"""Drawings to write: a slope with wedges, a mound with tadpoles, a conveyor, and a problem."""

from typing import Any

import numpy as np
import shapely
from shapely import LineString
from shapely.affinity import translate

from midrib import Strip, standard
from midrib.formats.drawing.content import Drawing, Drawn, Trouble
from midrib.hatching.along import symbols_along
from midrib.hatching.symbols import symbols
from tests.hatching.standin import Sides, mound, rectangle

EAST, NORTH = 6481500.0, 5616900.0
IDENTIFIER: dict[str, object] = {
    "lokalnyId": "c9b9",
    "przestrzenNazw": "PL.PZGiK.1.BDOT",
    "wersjaId": "2022",
}


def moved(hatching: Any, x: float, y: float) -> Any:
    """Chords in another place."""
    return hatching._replace(
        strokes=[translate(stroke, x, y) for stroke in hatching.strokes],
        on_top=hatching.on_top + np.array([x, y]),
        on_toe=hatching.on_toe + np.array([x, y]),
        strip=Sides(*(translate(part, x, y) for part in hatching.strip)),
    )


def hatched(name: str, hatching: Any, x: float, y: float, **values: Any) -> Drawn:
    """Object with strokes."""
    there = moved(hatching._replace(standard=standard(hatching.standard, **values)), x, y)
    return Drawn(name, "slope-unreinforced", symbols(there), there.is_long, there.width, IDENTIFIER)


def drawing(crs: str | None = None, scale: float = 500.0) -> Drawing:
    """Everything there is, north of a town."""
    x = EAST + 15.0
    conveyor = Strip(
        LineString([(x, NORTH - 5.0), (x + 30.0, NORTH - 5.0)]),
        LineString([(x, NORTH - 7.0), (x + 30.0, NORTH - 7.0)]),
    )
    return Drawing(
        scale,
        crs,
        objects=[
            hatched("s1", rectangle("pl-2015-slope-unreinforced"), EAST, NORTH),
            hatched(
                "s2", rectangle("iof-104"), EAST, NORTH + 9.0, symbol="wedge", symbol_width=1.0
            ),
            hatched("m1", mound("tadpole", count=40), EAST + 40.0, NORTH + 8.0),
            Drawn(
                "c1",
                "conveyor",
                symbols_along(conveyor, "pl-2015-conveyor", scale),
                attributes=IDENTIFIER,
            ),
        ],
        problems=[
            Trouble("s3", "no way through", shapely.Point(EAST + 5.0, NORTH - 6.0)),
            Trouble("s4", "no geometry"),
        ],
    )
