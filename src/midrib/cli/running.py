"""The work of ``midrib collapse``: partitions to parts, parts to the files that are asked for."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from midrib.checks import check_library
from midrib.cli.options import Engine
from midrib.cli.summary import summary
from midrib.engines.batches import Counts
from midrib.engines.jobs import logged, plan
from midrib.engines.partitions import partitions_of
from midrib.engines.parts import REFUSED, Work
from midrib.errors import ParameterError
from midrib.formats.contents import count_features
from midrib.formats.writing import staged

if TYPE_CHECKING:
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.engines.jobs import Job
    from midrib.engines.partitions import Partition
    from midrib.engines.parts import Done
    from midrib.engines.recipe import Recipe
    from midrib.formats.reading import Source

__all__ = ["Machines", "Run", "check_folder", "is_folder"]

LEAST_ROWS = 1000  # of a partition: some tenths of a second of work
SHARES = 4  # partitions for each worker, so that all end at about the same time


class Machines(NamedTuple):
    """What does the work."""

    engine: Engine
    workers: int | None
    scheduler: str | None
    master: str | None
    part_rows: int

    def check(self) -> None:
        """Refuse options that are of another engine, and engines that are not installed.

        Raises
        ------
        ParameterError, MissingDependencyError
            If so.
        """
        owners = {
            "--scheduler": (self.scheduler, Engine.dask),
            "--master": (self.master, Engine.spark),
        }
        for name, (value, owner) in owners.items():
            if value is not None and self.engine is not owner:
                msg = f"{name} is an option of --engine {owner}, --engine is {self.engine}"
                raise ParameterError(msg)
        if self.workers is not None and (self.engine is Engine.spark or self.scheduler):
            msg = "--workers counts processes on this machine, a cluster has its own"
            raise ParameterError(msg)
        if self.engine is Engine.dask:
            check_library("distributed", "--engine dask", "dask")
        if self.engine is Engine.spark:
            from midrib.engines.spark import check_spark

            check_spark()

    def parts(
        self, work: Work, partitions: "list[Partition]", said: Callable[[int], None]
    ) -> "Iterator[Done]":
        """Make parts; ``said`` hears of features that are done."""
        if self.engine is Engine.dask:
            from midrib.engines import dask

            return dask.run(work, partitions, said, scheduler=self.scheduler, workers=self.workers)
        if self.engine is Engine.spark:
            from midrib.engines import spark

            return spark.run(work, partitions, said, master=self.master)
        from midrib.engines import local

        return local.run(work, partitions, said, workers=self.workers)

    def rows(self, count: int | None) -> int | None:
        """Features of a partition, if that is for us to choose: None for all of a file."""
        if self.engine is Engine.local and self.workers in {None, 1}:
            return None
        share = math.ceil((count or self.part_rows) / (SHARES * (self.workers or SHARES)))
        return min(max(share, LEAST_ROWS), self.part_rows)


def is_folder(out: Path) -> bool:
    """Whether parts are to be kept in a folder: a name without an ending."""
    return not out.suffix


def check_folder(source: Path, out: Path, figure: Path | None, *, has_m: bool) -> None:
    """Refuse a folder that parts cannot be kept in, and what does not go with parts.

    Raises
    ------
    ParameterError
        If it is IN, in a folder that does not exist, or if M values or a figure are asked for.
    """
    if figure is not None:
        msg = "--figure needs all areas in memory, expected a file as OUT with it"
        raise ParameterError(msg)
    if out.exists() and source.exists() and out.samefile(source):
        msg = f"OUT {str(out)!r} is IN, expected another folder"
        raise ParameterError(msg)
    if not out.parent.is_dir():
        msg = f"OUT {str(out)!r} lies in a folder that does not exist"
        raise ParameterError(msg)
    if has_m:
        msg = f"OUT {str(out)!r} is a folder of GeoParquet, which has no place for M values"
        raise ParameterError(msg)


@dataclass(frozen=True)
class Run:
    """Files with areas, and what to make of them by which machines."""

    files: list[Path]
    source: "Source"  # of the first file; it need not be open any more
    recipe: "Recipe"
    machines: Machines
    report: "Report"

    @property
    def count(self) -> int | None:
        """Features of all files, None where it takes long to find out."""
        if len(self.files) == 1:
            return self.source.count
        return sum(count_features(file, file.stem) for file in self.files)

    def into_files(self, places: "Places", layer: str) -> Counts:
        """Write lines and refused areas, whole or not at all.

        Parts lie in a temporary folder meanwhile: a format wants to know the kind of all
        geometries before it takes the first.
        """
        counts = Counts()
        self.report.start()
        partitions = partitions_of(self.files, self.source.layer, self.machines.rows(self.count))
        with staged(places.out.parent, stale=places.stale) as stage:
            work = Work(stage.parent / "parts", "", self.recipe)
            work.folder.mkdir()
            with self.report.progress(self.count) as said:
                for done in self.machines.parts(work, partitions, said):
                    counts.add(done.counts)
            numbers = [partition.number for partition in partitions]
            notes, where = places.write_parts(stage, work, numbers, self.source, layer)
        places.sum_up(self.report, counts, self.recipe.crs, notes, where)
        return counts

    def into_folder(self, out: Path, main: str | None, *, overwrite: bool) -> Counts:
        """Keep parts in a folder, those of an earlier run too."""
        rows = self.machines.part_rows
        job = plan(out, self.files, self.source.layer, self.recipe, rows, main)
        with job.alone():
            counts = self.parts_of(job, overwrite=overwrite)
            job.write_manifest(counts)
        self.report.say(summary(counts, self.recipe.crs, self.report.elapsed))
        self.report.say(f"written to {out}, in {len(job.partitions)} parts")
        if counts.refused:
            self.report.say(f"refused areas, with reasons, in {out / REFUSED}")
        return counts

    def parts_of(self, job: "Job", *, overwrite: bool) -> Counts:
        """Make the parts of a job that are missing, and count what is in all of them."""
        missing, counts = job.begin(overwrite=overwrite)
        n_parts, n_there = len(job.partitions), len(job.partitions) - len(missing)
        if n_there:
            self.report.say(f"{n_there} of {n_parts} parts are there from an earlier run")
        if missing:
            self.report.start()
        try:
            with self.report.progress(self.count, counts.features) as said:
                for done in logged(self.machines.parts(job.work, missing, said), job.folder):
                    counts.add(done.counts)
        except KeyboardInterrupt:
            self.report.say("finished parts are kept, the same command goes on from there")
            raise
        return counts
