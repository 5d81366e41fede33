"""Jobs that survive an interrupt: what a folder of parts is made from, and which are finished.

    OUT/_midrib.json   what the parts are made from; totals once all are there
    OUT/_lock.json     which run is writing there, while it does
    OUT/_log.jsonl     one line for each part that a run has finished: counts, seconds

A part that is there is never made twice: its footer says whether it is of this job. A job whose
input or options have changed is another job.
"""

import hashlib
import json
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import midrib
from midrib.engines.batches import Counts
from midrib.engines.fingerprints import fingerprints
from midrib.engines.locks import LOCK, alone_in
from midrib.engines.partitions import Partition, partitions_of
from midrib.engines.parts import REFUSED, Done, Work, remove_unfinished
from midrib.engines.recipe import Recipe
from midrib.errors import ParameterError
from midrib.formats.failures import failures_named

__all__ = ["Job", "logged", "plan"]

MANIFEST, LOG = "_midrib.json", "_log.jsonl"


@dataclass(frozen=True)
class Job:
    """A layer, what to make of it, and the folder for the parts."""

    work: Work
    partitions: list[Partition]
    made_from: dict[str, Any]

    @property
    def folder(self) -> Path:
        """Where the parts go."""
        return self.work.folder

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Keep other runs out of the folder, which is there from now on.

        Raises
        ------
        ParameterError
            If the folder holds something else, or another run is writing to it.
        """
        check_ours(self.folder)
        with failures_named(f"OUT {str(self.folder)!r}"):
            self.folder.mkdir(exist_ok=True)
        with alone_in(self.folder):
            yield

    def begin(self, *, overwrite: bool) -> tuple[list[Partition], Counts]:
        """Make the folder ready: partitions without a finished part, and counts of the others.

        Raises
        ------
        ParameterError
            If the folder holds something else, or parts of another job and not ``overwrite``.
        """
        check_ours(self.folder)
        if overwrite:
            clear(self.folder)
        before = read_manifest(self.folder)
        if before and before != self.made_from:
            said = "; ".join(differences(before, self.made_from))
            msg = (
                f"OUT {str(self.folder)!r} holds parts of another job ({said}), give the same "
                "input and options to go on, or --overwrite to begin anew"
            )
            raise ParameterError(msg)
        self.folder.mkdir(exist_ok=True)
        remove_unfinished(self.folder)
        self.write_manifest()
        counts, missing = Counts(), []
        for partition in self.partitions:
            done = self.work.finished(partition.number)
            if done is None:
                missing.append(partition)
            else:
                counts.add(done)
        return missing, counts

    def write_manifest(self, counts: Counts | None = None) -> None:
        """Write what the parts are made from, and the totals if all are there; whole or not."""
        content = {"made_from": self.made_from, "parts": len(self.partitions)}
        if counts is not None:
            content["totals"] = vars(counts)
        path = self.folder / f".{MANIFEST}"
        with failures_named(repr(str(self.folder / MANIFEST))):
            path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
            path.replace(self.folder / MANIFEST)


def plan(
    folder: Path, files: list[Path], layer: str, recipe: Recipe, rows: int, main: str | None
) -> Job:
    """Divide layers into partitions, and say what their parts are made from.

    ``main`` is where the guides of the recipe come from.
    """
    made_from: dict[str, Any] = {
        "midrib": midrib.__version__,
        "layer": layer,
        "method": recipe.method,
        **recipe.options,
        "main": main,
        "width": "m" if recipe.has_m else "columns",
        "part-rows": rows,
        "crs": recipe.crs,
        "files": [some for file in files for some in fingerprints(file)],
    }
    made_from = json.loads(json.dumps(made_from))  # as it comes back from a file
    key = hashlib.sha256(json.dumps(made_from, sort_keys=True).encode()).hexdigest()[:16]
    return Job(Work(folder, key, recipe), partitions_of(files, layer, rows), made_from)


def check_ours(folder: Path) -> None:
    """Refuse a place with something that is no output of an earlier run.

    Raises
    ------
    ParameterError
        If so.
    """
    if not folder.exists() or (folder / MANIFEST).is_file():
        return
    if not folder.is_dir() or any(path.name != LOCK for path in folder.iterdir()):
        what = "a folder, but no output of an earlier run" if folder.is_dir() else "a file"
        msg = f"OUT {str(folder)!r} is {what}, expected another place or an empty folder"
        raise ParameterError(msg)


def read_manifest(folder: Path) -> dict[str, Any]:
    """Read what the parts in a folder are made from; nothing if there are none.

    Raises
    ------
    ParameterError
        If that cannot be read, as after a power cut.
    """
    path = folder / MANIFEST
    if not path.exists():
        return {}
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))["made_from"]
    except (ValueError, LookupError, TypeError) as error:
        msg = (
            f"{str(path)!r} is damaged, expected what an earlier run has written; --overwrite "
            "begins anew"
        )
        raise ParameterError(msg) from error
    return found


def clear(folder: Path) -> None:
    """Remove what earlier runs have written into a folder, and nothing else."""
    remove_unfinished(folder)
    shutil.rmtree(folder / REFUSED, ignore_errors=True)
    for path in (folder / MANIFEST, folder / LOG, *folder.glob("part-*.parquet")):
        path.unlink(missing_ok=True)


def differences(before: dict[str, Any], now: dict[str, Any]) -> Iterator[str]:
    """Say what differs between two jobs."""
    for name in {**before, **now}:
        old, new = before.get(name), now.get(name)
        if old == new:
            continue
        if name == "files":
            yield changed_files(old, new)
        elif name == "crs":
            yield "the CRS of the input has changed"
        else:
            yield f"{name} is {new!r}, was {old!r}"


def changed_files(before: Any, now: Any) -> str:
    """Say which files are not what they were."""
    known = {file["name"]: file for file in before}
    changed = [file["name"] for file in now if known.get(file["name"]) != file]
    gone = sorted({*known} - {file["name"] for file in now})
    return f"input has changed: {', '.join([*changed, *gone])}"


def logged(done: Iterable[Done], folder: Path) -> Iterator[Done]:
    """Parts as they are finished, each noted in the log of the job."""
    for part in done:
        line = {"part": part.number, **vars(part.counts), "seconds": part.seconds}
        path = folder / LOG
        with failures_named(repr(str(path))), path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
        yield part
