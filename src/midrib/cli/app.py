"""The commands that there are."""

from typing import Annotated

import typer

from midrib import __version__
from midrib.cli.check import check
from midrib.cli.collapse import collapse
from midrib.cli.compare import compare
from midrib.cli.hatch import hatch
from midrib.cli.label import label
from midrib.cli.network import network
from midrib.cli.partial import partial
from midrib.cli.points import points
from midrib.cli.profile import profile
from midrib.cli.shown import show
from midrib.cli.skeleton import skeleton
from midrib.cli.tower import tower

__all__ = ["app"]

app = typer.Typer(
    help="Areas to lines: one unbranched line inside each river or road, strokes on slopes.",
    epilog="Example:  midrib collapse rivers.gpkg centrelines.gpkg",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command(
    help="Collapse areas to lines: one line without branches inside each.\n\n"
    "Attributes and CRS are kept. New columns: length, width_mean and width_max (in units of the "
    "CRS, metres if it is geographic) and status. Areas that are refused go to a layer, or a file, "
    "…_refused, with the reason.\n\n"
    "Files of any size are read, worked on and written batch by batch, but for --connect and "
    "--figure, which take all areas into memory.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib collapse rivers.gpkg out.gpkg --spacing 5m\n\n"
    "midrib collapse rivers.parquet lines --workers 8\n\n"
    "midrib collapse roads.gpkg out.gpkg --connect\n\n"
    "midrib collapse map.gpkg out.parquet --layer slope --main crest:slope_id --figure out.svg",
)(collapse)
app.command(
    help="Find the centre lines of networks: roads with their crossings, one feature from node to "
    "node.\n\n"
    "Attributes and CRS are kept. New columns: from_node and to_node, length, width_mean (in units "
    "of the CRS, metres if it is geographic) and status. Nodes go to a layer, or a file, …_nodes: "
    "node, and ways, how many lines lead there. Areas that are refused go to …_refused, with the "
    "reason.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib network streets.gpkg lines.gpkg --layer carriageway --dissolve\n\n"
    "midrib network rivers.gpkg lines.parquet --min-branch-length 200m",
)(network)
app.command(
    help="Find the skeletons of areas: every branch, one feature each, with its distance to the "
    "boundary.\n\n"
    "Attributes and CRS are kept. New columns: branch (number in the skeleton), tips (how many of "
    "its ends are dead ends), length, radius_min and radius_max (in units of the CRS, metres if it "
    "is geographic) and status. Areas that are refused go to …_refused, with the reason.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib skeleton lakes.gpkg axes.gpkg --radius m --min-significance 1.5\n\n"
    "midrib skeleton roofs.gpkg ridges.gpkg --method straight-skeleton",
)(skeleton)
app.command(
    help="Collapse the parts of areas that are narrower than a width to lines, and keep the "
    "others: for maps at a smaller scale.\n\n"
    "OUT has the lines, one feature from node to node, as of [bold]midrib network[/]; the parts "
    "that are wider go to a layer, or a file, …_areas, one feature a part, with the attributes of "
    "their area, the number of the part and the status. Each line ends in a vertex of the part it "
    "leads to. Areas that are refused go to …_refused, with the reason, and so do those with a "
    "narrow part that could not be cut off and stays an area (uncut).\n\n"
    "Exit code 0: done; 1: some areas refused or uncut, the rest is written; 2: wrong usage.",
    epilog="Example:\n\nmidrib partial rivers.gpkg small_scale.gpkg --narrower-than 25m",
)(partial)
app.command(
    help="Find lines for the names of areas: curves with few bends in their widest parts.\n\n"
    "Attributes and CRS are kept. New columns: length, height (of the text that fits there, in "
    "units of the CRS, metres if it is geographic) and status. Areas without room for the text are "
    "among those that are refused; they go to …_refused, with the reason.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib label lakes.gpkg names.gpkg\n\n"
    "midrib label lakes.gpkg names.gpkg --height 300m --length 4km",
)(label)
app.command(
    help="Find control points of the lines of areas: the vertices that matter most.\n\n"
    "One feature a point, in the order of the line, with the attributes of its area. New columns: "
    "part (of the area), vertex (of the line, from 0), importance (the tolerance up to which the "
    "point is needed; infinite at ends) and status. The line through the points of an area is "
    "inside.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib points rivers.gpkg points.gpkg --count 12\n\n"
    "midrib points rivers.gpkg points.gpkg --tolerance 5m",
)(points)
app.command(
    help="Measure the width of areas along their lines: a table of stations and widths.\n\n"
    "Columns: feature (number in the file, from 0) and part; station along the line; x, y and z if "
    "there are heights; width, twice the distance to the boundary; to_left and to_right, the "
    "distances to the two banks, left and right in the line's direction. Lengths are in units of "
    "the CRS, metres if it is geographic. The lines are those of midrib collapse. Areas that are "
    "refused go to a layer, or a file, …_refused, with the reason.\n\n"
    "Exit code 0: done; 1: some areas refused, the rest is written; 2: wrong usage.",
    epilog="Examples:\n\nmidrib profile rivers.gpkg widths.csv --spacing 10m --id name\n\n"
    "midrib profile rivers.gpkg stations.gpkg --figure widths.svg",
)(profile)
app.command(
    help="Compare the lines of several methods in one area: a figure and a table.\n\n"
    "The table: vertices, length, how far off the middle (centredness), turning, how far from the "
    "line of the first method, CPU time. Lengths are in units of the CRS, metres if it is "
    "geographic.\n\n"
    "Exit code 0: done; 1: a method has no line, the reason is in the table; 2: wrong usage.",
    epilog="Examples:\n\nmidrib compare rivers.gpkg odra.html --feature name=Odra\n\n"
    "midrib compare roads.gpkg one.svg --feature 17 --methods minimal-radii,mean-curve:kinks",
)(compare)
app.command(
    help="Check slopes before they are hatched: a table of what is wrong with them, and where.\n\n"
    "refused: no slope, for want of a top, an area or good coordinates; swapped: the top is lower "
    "than the toe, by known heights; off-ring: an edge, its start or its end is off the boundary; "
    "orientation: doubtful which edge is the top; pieces: the top is stored in pieces; pairs: "
    "doubtful which top goes with which toe; unmatched: strokes are left out, or there is none, in "
    "some place; beyond: strokes exceed a bound there; crossing: strokes of --strokes cross or lie "
    "on each other; outside: strokes of --strokes are outside of every slope, or stick out of "
    "theirs.\n\n"
    "Exit code 0: nothing found; 1: something found; 2: wrong usage.",
    epilog="Examples:\n\nmidrib check BDOT500.gml -o findings.gpkg --figure findings.svg\n\n"
    "midrib check slopes.gpkg --layer slope --top crest:slope_id --strokes hatching\n\n"
    "midrib check map.dxf --top SLOPE_TOP --toe SLOPE_TOE",
)(check)
app.command(
    help="Hatch slopes at map scale: strokes from top to toe that never cross, as a standard has "
    "them; and draw walls, stairs, conveyors, gantries and water gates.\n\n"
    "Layers: strokes, symbols (filled), outlines, problems. Columns of strokes: area (identifier "
    "in the register), kind, standard, stroke (number along the top), is_long, width (of the "
    "slope there) and length. Slopes that are refused are listed and in the layer, or file, "
    "problems, with the reason.\n\n"
    "Exit code 0: done, or IN is empty; 1: some slopes refused, the rest is written, or IN has "
    "objects and none is drawn; 2: wrong usage.",
    epilog="Examples:\n\nmidrib hatch bdot500.gml map.gpkg --standard pl-2015 --scale 500\n\n"
    "midrib hatch bgt.gml map.pdf --standard de-general --scale 1000 --paper A3\n\n"
    "midrib hatch slopes.gpkg map.dxf --top crest:slope_id --symbol wedge",
)(hatch)
app.command(
    help="Find the axis of a tower or chimney in a laser scan, with its uncertainty by level.\n\n"
    "Levels: z, x, y, radius, deviation from the vertical through the base and its azimuth (from "
    "y, clockwise), ovality, degrees of the shell that are seen, points, residual, standard "
    "deviation of the centre, flag. Lengths are in units of the coordinates; the report has metres "
    "and millimetres.\n\n"
    "Exit code 0: done; 1: some levels are flagged, all is written; 2: wrong usage, or no tower.",
    epilog="Examples:\n\nmidrib tower scan.laz --report chimney.html -o levels.csv -o axis.dxf\n\n"
    "midrib tower scan.e57 --report chimney.pdf --registration 2mm --tolerance h/1000",
)(tower)


def show_version(is_asked: bool) -> None:
    """Print the version and leave."""
    if is_asked:
        typer.echo(f"midrib {__version__}")
        raise typer.Exit


@app.callback()
def options(
    _version: Annotated[
        bool,
        typer.Option(
            "--version", callback=show_version, is_eager=True, metavar="", help="Show the version."
        ),
    ] = False,
) -> None:
    """Take the options that every command has."""


@app.command()
def methods() -> None:
    """List the methods that collapse areas: name, source, what each can do and costs."""
    import midrib

    rows: list[tuple[str, ...]] = [("name", "source", "branches", "holes", "exact", "cost")]
    for method in midrib.methods():
        flags = method.has_branches, method.supports_holes, method.is_exact
        able = ("yes" if flag else "no" for flag in flags)
        rows.append((method.name, method.source, *able, method.cost))
    show(rows)


@app.command()
def standards() -> None:
    """List the standards of hatching: name, symbol, confidence in its figures, what it is for."""
    import midrib

    rows: list[tuple[str, ...]] = [("name", "symbol", "confidence", "for", "source")]
    for standard in midrib.standards():
        texts = (standard.name, standard.symbol, standard.confidence)
        rows.append((*texts, ", ".join(standard.kinds), standard.source))
    show(rows)
