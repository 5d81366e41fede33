"""The command ``midrib compare``."""

from typing import TYPE_CHECKING, Any
from warnings import catch_warnings, simplefilter

import typer

from midrib.cli import options as cli
from midrib.errors import ParameterError, RepairedAreaWarning

if TYPE_CHECKING:
    from midrib.formats.reading import Batch, Source

__all__ = ["compare"]


def compare(
    source: cli.Source,
    out: cli.ComparisonOut,
    layer: cli.Layer = None,
    feature: cli.OneFeature = None,
    part: cli.OnePart = None,
    methods: cli.Methods = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Compare the lines of several methods in one area: a figure and a table."""
    from midrib.cli.report import Report
    from midrib.cli.shown import show
    from midrib.comparison import compare as compare_lines
    from midrib.figures.comparison_page import check_comparison, rows_of, write_comparison
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import is_geographic, unit_of
    from midrib.formats.writing import check_free, staged

    check_comparison(out)
    check_free([out], "OUT", overwrite=overwrite)
    report = Report(quiet=quiet)
    layer = choose_layer(source, layer)
    with open_layer(source, layer) as features:
        area = chosen_area(features, feature)
        geographic, unit = is_geographic(features.crs), unit_of(features.crs)
    report.announce()
    names = None if methods is None else [name.strip() for name in methods.split(",")]
    with catch_warnings():
        simplefilter("ignore", RepairedAreaWarning)  # it is said below
        found = compare_lines(area, names, geographic=geographic, part=part)
    for note in found.notes:
        report.say(note)
    show(rows_of(found))
    title = f"{layer}, {feature}" if feature else layer
    with staged(out.parent) as stage:
        write_comparison(found, stage / out.name, title, None if unit is None else unit.name)
    report.say(f"written to {out}")
    if any(row.line is None for row in found.rows):
        raise typer.Exit(1)


def chosen_area(features: "Source", feature: str | None) -> Any:
    """Return the area of one feature: by its number, or by the value of a field.

    Raises
    ------
    ParameterError
        If there is no such feature, or there are several.
    """
    key, is_field, value = (feature or "").partition("=")
    if is_field and key not in features.attributes.names:
        msg = f"--feature {feature!r}: IN has no field {key!r}, expected one of "
        raise ParameterError(msg + ", ".join(features.attributes.names))
    if feature and not is_field and not feature.isdecimal():
        msg = f"--feature is {feature!r}, expected the number of a feature, or FIELD=VALUE"
        raise ParameterError(msg)
    found: list[Any] = []
    count = 0
    for batch in features.batches():
        count += len(batch.geometries)
        if is_field:
            found += by_value(batch, key, value)
        else:
            found += [g for k, g in enumerate(batch.geometries, batch.first) if f"{k}" == feature]
            if not feature:
                found += list(batch.geometries[:2])
    if not count:
        msg = "IN has no features, expected one at least"
        raise ParameterError(msg)
    if len(found) != 1:
        told = f"--feature {feature!r} fits {len(found)}" if feature else f"IN has {count}"
        msg = f"{told} features, expected one: --feature 0 to {count - 1}, or FIELD=VALUE"
        raise ParameterError(msg)
    return found[0]


def by_value(batch: "Batch", key: str, value: str) -> list[Any]:
    """Geometries of the features that have a value, as it is written."""
    values = batch.attributes.column(key).to_pylist()
    return [g for g, known in zip(batch.geometries, values, strict=True) if str(known) == value]
