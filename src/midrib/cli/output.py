"""Where results go: lines, refused areas, a second layer, a figure, a summary."""

from collections import Counter
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from midrib.cli.job import JOINT_COLUMNS, joint_features
from midrib.cli.summary import summary
from midrib.engines.batches import Counts
from midrib.engines.parts import kinds_in, tables_of
from midrib.errors import ParameterError
from midrib.figures.draw import check_figure, draw_collapse
from midrib.formats.contents import column_names
from midrib.formats.endings import endings_with_m, format_of
from midrib.formats.units import is_geographic, unit_of
from midrib.formats.writing import (
    KINDS,
    Features,
    Layer,
    check_free,
    one_kind_each,
    staged,
    write_layer,
    write_tables,
)

if TYPE_CHECKING:
    from midrib.cli.job import Results
    from midrib.cli.report import Report
    from midrib.engines.parts import Work
    from midrib.engines.recipe import Recipe
    from midrib.formats.guides import Guides
    from midrib.formats.reading import Geometries, Source

__all__ = ["Places", "Second", "draw", "joints_of"]

LINE_OF = {"Polygon": "LineString", "MultiPolygon": "MultiLineString"}
REASON = "reason"  # the column that every layer of refused areas, or of joints, has
# The column that tells a second layer of an earlier run, by the name of the layer.
MARKS = {"joints": REASON, "nodes": "node", "areas": "part"}


class Second(NamedTuple):
    """What goes into a layer beside the lines."""

    attributes: pa.Table
    geometries: "Geometries"
    kind: str
    summary: str


class Places(NamedTuple):
    """The files of one run."""

    source: Path
    out: Path
    figure: Path | None
    second: str | None = None  # what the name of a second layer ends in

    @property
    def refused(self) -> Path:
        """File for refused areas: OUT where its format has layers, else one beside it."""
        return self.beside("refused")

    def beside(self, name: str) -> Path:
        """File for a second layer."""
        if format_of(self.out).has_layers:
            return self.out
        return self.out.with_name(f"{self.out.stem}_{name}{self.out.suffix}")

    @property
    def all(self) -> list[Path]:
        """Every file for features that a run may write or remove, OUT first, each once."""
        second = [self.beside(self.second)] if self.second else []
        old = [self.beside("joints")] if self.has_old_joints else []
        return [*dict.fromkeys([self.out, *self.all_refused.values(), *second, *old])]

    @property
    def stale(self) -> list[Path]:
        """Files of an earlier run that go away, unless this one writes them again."""
        # A drawing does not tell whether an earlier run has made it: it stays.
        return [] if format_of(self.out).is_drawing else self.all[1:]

    @property
    def has_old_joints(self) -> bool:
        """Whether joints of an earlier run are in a file of their own."""
        path = self.beside("joints")
        if path == self.out or not path.exists() or format_of(path).is_drawing:
            return False
        return {*JOINT_COLUMNS} <= {*column_names(path)}

    @property
    def all_refused(self) -> dict[str, Path]:
        """Files for refused features by what is added to the name for their kind of geometry."""
        path = self.refused
        if path == self.out or not format_of(path).has_one_kind:
            return {"": path}
        return {kind: path.with_name(f"{path.stem}{kind}{path.suffix}") for kind in KINDS}

    def check(self, *, overwrite: bool, needs_m: str = "") -> None:
        """Refuse places that cannot be written to, before any work is done.

        Raises
        ------
        ParameterError
            If OUT has an unknown ending or no place for M values that ``needs_m``, an option, asks
            for, is IN, or exists and is not to be overwritten; or if there is a file in the place
            for refused areas or joints that an earlier run has not written.
        """
        if needs_m and not format_of(self.out).has_m:
            msg = (
                f"OUT {str(self.out)!r} has no place for M values, expected one of "
                f"{', '.join(endings_with_m())} with {needs_m}"
            )
            raise ParameterError(msg)
        for path in self.all:
            if self.source.exists() and path.exists() and self.source.samefile(path):
                msg = f"OUT {str(path)!r} is IN, expected another file"
                raise ParameterError(msg)
        check_free(self.all, "OUT", overwrite=overwrite)
        for path in self.all[1:]:
            if path.exists() and not self.may_replace(path):
                what = self.content(path)
                msg = (
                    f"{str(path)!r}, the place for {what or 'refused areas'}, has no column "
                    f"{MARKS.get(what, REASON)!r} and so is no output of an earlier run, expected "
                    "it elsewhere"
                )
                raise ParameterError(msg)
        if self.figure is not None:
            check_figure(self.figure)
            check_free([self.figure], "--figure", overwrite=overwrite)

    def content(self, path: Path) -> str:
        """Name of the second layer that a file is for, none if it is for refused areas."""
        return next((name for name in MARKS if path == self.beside(name)), "")

    def may_replace(self, path: Path) -> bool:
        """Whether a file is a second layer of an earlier run; drawings do not tell."""
        mark = MARKS.get(self.content(path), REASON)
        is_drawing = format_of(path).is_drawing
        return is_drawing or any(name.lower().startswith(mark) for name in column_names(path))

    def write(
        self,
        results: "Results",
        layer: str,
        report: "Report",
        second: Second | None = None,
        kind: str | None = None,
    ) -> None:
        """Write everything, whole or not at all; then sum up."""
        source = results.source
        lines = Features(
            layer,
            pa.concat_tables(results.attributes),
            np.concatenate(results.lines),
            source.geometry,
            kind or LINE_OF.get(source.kind, "LineString"),
            source.crs,
            source.more,
        )
        with staged(self.out.parent, stale=self.stale) as stage:
            notes = write_layer(stage / self.out.name, lines)
            where: list[str] = []
            if results.has_doubts:
                refused = lines._replace(
                    layer=f"{layer}_refused",
                    attributes=pa.concat_tables(results.refused_attributes),
                    geometries=np.concatenate(results.refused_areas),
                    kind=source.kind,
                )
                lost, where = self.write_refused(stage, refused)
                notes += lost
            if second is not None:
                more = lines._replace(
                    layer=f"{layer}_{self.second}",
                    attributes=second.attributes,
                    geometries=second.geometries,
                    kind=second.kind,
                )
                notes += write_layer(stage / self.beside(str(self.second)).name, more)
        self.sum_up(report, results.counts, source.crs, notes, where)
        if second is not None:
            place = self.where(f"{layer}_{self.second}", self.beside(str(self.second)))
            report.say(f"{second.summary}, in {place}")

    def write_parts(
        self, stage: Path, work: "Work", numbers: list[int], source: "Source", layer: str
    ) -> tuple[list[str], list[str]]:
        """Write parts as layers into files that are to be there whole or not at all.

        Returns
        -------
        list of str
            Notes.
        list of str
            Where refused areas are.
        """
        recipe = work.recipe
        paths = [work.lines(k) for k in numbers]
        lines = stored(paths, recipe.lines, recipe, layer, LINE_OF.get(source.kind, "LineString"))
        notes = write_tables(stage / self.out.name, lines, partial(tables_of, paths))
        paths = [path for k in numbers if (path := work.refused(k)).exists()]
        if not paths:
            return notes, []
        refused = stored(paths, recipe.refused, recipe, f"{layer}_refused", source.kind)
        if format_of(self.out).has_one_kind:
            lost, where = self.write_refused(stage, in_memory(refused, paths))
        else:
            lost = write_tables(stage / self.refused.name, refused, partial(tables_of, paths))
            where = [self.where(refused.name, self.refused)]
        return notes + lost, where

    def write_refused(self, stage: Path, refused: Features) -> tuple[list[str], list[str]]:
        """Write refused areas; return notes, and where they are."""
        apart, notes = one_kind_each(refused, format_of(self.out))
        where = []
        for name, some in apart.items():
            path = self.all_refused.get(name, self.out)
            notes += write_layer(stage / path.name, some)
            where.append(self.where(some.layer, path))
        return notes, where

    def sum_up(
        self, report: "Report", counts: Counts, crs: str | None, notes: list[str], where: list[str]
    ) -> None:
        """Say what has been written, and what the format could not keep."""
        if format_of(self.out).is_drawing:
            kept = [self.refused] * (not where) + [self.beside("joints")] * (self.second is None)
            notes = notes + [
                f"{p} was there before, it is left as it was" for p in kept if p.exists()
            ]
        for note in dict.fromkeys(notes):
            report.say(f"note: {note}")
        report.say(summary(counts, crs, report.elapsed))
        report.say(f"written to {self.out}")
        if where:
            report.say(f"refused areas, with reasons, in {' and '.join(where)}")

    def where(self, layer: str, path: Path) -> str:
        """Say where a second layer is."""
        return f"layer {layer} of {path}" if path == self.out else str(path)


def draw(source: "Source", guides: "Guides", options: dict[str, Any], figure: Path) -> None:
    """Draw the areas of a layer and what they collapse to in a file, whole or not at all."""
    batches = list(source.batches())
    unit = unit_of(source.crs)
    along = np.concatenate([guides.of(batch)[0] for batch in batches])
    with staged(figure.parent) as easel:
        draw_collapse(
            np.concatenate([batch.geometries for batch in batches]),
            easel / figure.name,
            along=None if options.get("connect") else along,
            geographic=is_geographic(source.crs),
            unit=None if unit is None else unit.name,
            **options,
        )


def stored(paths: list[Path], schema: pa.Schema, recipe: "Recipe", layer: str, kind: str) -> Layer:
    """Tell what is known of a layer whose features are in parts."""
    attributes = pa.schema([*schema][:-1])
    return Layer(layer, attributes, recipe.geometry, kind, recipe.crs, kinds_in(paths), recipe.more)


def in_memory(layer: Layer, paths: list[Path]) -> Features:
    """Read all features of a layer whose features are in parts."""
    table = pa.concat_tables(tables_of(paths))
    wkb = table.column(table.num_columns - 1)
    return Features(
        layer.name,
        table.select(layer.attributes.names),
        shapely.from_wkb(wkb.to_numpy()),
        layer.geometry,
        layer.kind,
        layer.crs,
        layer.more,
    )


def joints_of(results: "Results") -> Second:
    """Return the layer of joints, and of shared edges without one."""
    made = Counter(joint.kind for joint in results.joints)
    summary = (
        f"{made['end to end']} joints end to end, {made['side']} on the side, "
        f"{made['none']} shared edges without"
    )
    return Second(*joint_features(results.joints), "Point", summary)
