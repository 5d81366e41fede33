"""Collapse the bundled areas, draw some of them and say where everything is.

``make demo`` runs it; so does ``python examples/demo.py`` wherever midrib is installed.
"""

import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import shapely
from rich.console import Console
from rich.table import Table

import midrib
from midrib import measures
from midrib.figures.draw import draw_collapse
from midrib.formats.contents import layer_names
from midrib.formats.reading import Source, open_layer
from midrib.formats.units import is_geographic
from midrib.formats.writing import Features, write_layer

HERE = Path(__file__).parent
AREAS = HERE / "areas.gpkg"
OUT = HERE.parent / "out"
PICTURE_OF = shapely.box(141000, 466462, 141095, 466600)  # paths and banks at a flyover


def main() -> None:
    """Collapse each layer to a file of its own and draw a picture."""
    console = Console(highlight=False)
    OUT.mkdir(exist_ok=True)
    console.print("Loading the kernels; the first time compiles them, which takes a while …")
    midrib.collapse(shapely.box(0.0, 0.0, 3.0, 1.0))
    table = Table("layer", "areas", "lines", "refused", "length", "mean width", "time")
    for column in table.columns[1:]:
        column.justify = "right"
    for layer in layer_names(AREAS):
        with open_layer(AREAS, layer) as source:
            table.add_row(layer, *collapsed(source, OUT / f"{layer}.gpkg"))
    with open_layer(AREAS, "roads") as source:
        draw(source, OUT / "demo.png")
    console.print(table)
    console.print("Written:", *(f"  out/{path.name}" for path in sorted(OUT.iterdir())), sep="\n")


def collapsed(source: Source, path: Path) -> list[str]:
    """Write the lines of a layer and return a row of numbers about them."""
    batches = list(source.batches())
    areas = np.concatenate([batch.geometries for batch in batches])
    attributes = pa.concat_tables([batch.attributes for batch in batches])
    geographic = is_geographic(source.crs)
    started = time.perf_counter()
    lines, problems = midrib.collapse(areas, on_error="report", geographic=geographic)
    seconds = time.perf_counter() - started
    length = measures.length(lines, geographic=geographic)
    width = measures.mean_width(lines, areas, geographic=geographic)
    attributes = attributes.append_column("length", pa.array(length))
    attributes = attributes.append_column("width_mean", pa.array(width))
    path.unlink(missing_ok=True)
    write_layer(
        path, Features(source.layer, attributes, lines, source.geometry, "LineString", source.crs)
    )
    refused = sum(problem.status == "refused" for problem in problems)
    return [
        f"{areas.size}",
        f"{np.count_nonzero(~np.isnan(length))}",
        f"{refused}",
        f"{np.nansum(length) / 1000:.1f} km",
        f"{np.nansum(width * length) / np.nansum(length):.1f} m",
        f"{seconds:.2f} s",
    ]


def draw(source: Source, path: Path) -> None:
    """Draw the areas of a layer that lie where the picture is of."""
    areas = np.concatenate([batch.geometries for batch in source.batches()])
    draw_collapse(areas[shapely.within(areas, PICTURE_OF)], path, unit="m", width=150.0)


if __name__ == "__main__":
    main()
