"""Golden lines: what a construction gave when somebody looked at it and found it right.

``python -m tests.golden_files`` writes them anew; say why in the commit.
"""

import json
from pathlib import Path

import numpy as np
import shapely
from shapely import LineString, Polygon

__all__ = ["FOLDER", "difference", "read_golden", "write_golden"]

FOLDER = Path(__file__).parent / "golden"


def difference(found: LineString, expected: LineString) -> float:
    """How far two lines are apart, by their points in order of travel.

    Infinite where one has other ends than the other, or runs the other way.
    """
    size = np.hypot(*np.ptp(shapely.get_coordinates(expected), axis=0))
    ends = [
        shapely.Point(a).distance(shapely.Point(b))
        for a, b in zip(
            (found.coords[0], found.coords[-1]),
            (expected.coords[0], expected.coords[-1]),
            strict=True,
        )
    ]
    if max(ends) > 0.01 * size:
        return float(np.inf)
    off = float(found.hausdorff_distance(expected))
    return float(max(*ends, off, abs(found.length - expected.length)))


def write_golden(name: str, area: Polygon, lines: dict[str, LineString]) -> None:
    """Write an area and its lines as GeoJSON with nine decimals."""
    roles: dict[str, object] = {"area": area, **lines}
    features = [
        {
            "type": "Feature",
            "properties": {"role": role},
            "geometry": json.loads(shapely.to_geojson(shapely.set_precision(shape, 1e-9))),
        }
        for role, shape in roles.items()
    ]
    rows = ",\n".join(json.dumps(feature) for feature in features)
    text = f'{{"type": "FeatureCollection", "features": [\n{rows}\n]}}\n'
    (FOLDER / f"{name}.geojson").write_text(text, encoding="utf-8")


def read_golden(name: str) -> dict[str, shapely.Geometry]:
    """Shapes of a golden file by their role."""
    text = (FOLDER / f"{name}.geojson").read_text(encoding="utf-8")
    return {
        feature["properties"]["role"]: shapely.from_geojson(json.dumps(feature["geometry"]))
        for feature in json.loads(text)["features"]
    }


def main() -> None:
    """Write every golden file anew."""
    from tests.curves.test_figures import FIGURES

    for name, figure in FIGURES.items():
        strip, lines = figure()
        write_golden(name, strip.area, lines)


if __name__ == "__main__":
    main()
