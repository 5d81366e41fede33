"""Slopes of any register: finds out what a file is and has it read."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from midrib.errors import ParameterError
from midrib.formats import bdot500, bgt, gml
from midrib.formats.cad import read_cad
from midrib.formats.layers import Hints, read_layer
from midrib.hatching.slope import KINDS, Slope, SlopeProblem

__all__ = ["DRAWING", "XML", "Slope", "SlopeProblem", "count_ended", "read_slopes"]

XML, DRAWING = (".gml", ".xml"), ".dxf"


def read_slopes(
    path: str | Path,
    *,
    layer: str | None = None,
    top: str | None = None,
    toe: str | None = None,
    start: str | None = None,
    end: str | None = None,
    kind: str | None = None,
    history: bool = False,
) -> tuple[list[Slope], list[SlopeProblem]]:
    r"""Read the slopes of a register: areas with their tops and toes.

    Finds out what the file is: BDOT500 of the models of 2015 and 2021 (GML), BGT (CityGML), a
    drawing (DXF), or any vector layer with areas and something that tells where their tops are.

    Parameters
    ----------
    path : str or Path
    layer : str, optional
        Layer of areas; needed if several could be meant.
    top : str, optional
        Lines along the tops: ``LAYER``, matched by place, ``LAYER:ID``, matched by a field that
        both layers have, or ``FIELD`` with WKT. Of a drawing: its layer of tops.
    toe : str, optional
        Lines along the toes, where there are no areas: a layer, as ``top`` is then.
    start, end : str, optional
        Where the tops start and end: two fields ``X,Y`` or a layer of points ``LAYER:ID``.
    kind : str, optional
        What the objects are, in place of what the file says: one of ``Slope.kind``, for all of
        them, or a field with such names.
    history : bool, default False
        Whether to read objects that the register says have ended.

    Returns
    -------
    slopes : list of Slope
        In the order of the file, one for each side that has a top.
    problems : list of SlopeProblem
        What could not be read, and what is doubtful about some of the slopes.

    Raises
    ------
    ParameterError
        If the file cannot be read, nothing tells where the tops are, or there is no such kind.
    MissingDependencyError
        If it is a drawing and ezdxf is not installed.

    Notes
    -----
    Start and end need not be vertices. Off the boundary, a vertex within a tenth of the mean width
    is taken, else the nearest place if that is as near. Either is listed as a problem. A height of
    0 is unknown. Points of known height are on an edge if they are within a 100th of the mean width
    of it. O(n) memory in the vertices of the slopes; GML is read one feature at a time.

    References
    ----------
    docs/registers.md: what becomes a slope in each model, with sources.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "slopes.csv"
    ...     row = '"POLYGON ((0 0, 9 0, 9 2, 0 2, 0 0))",a,"LINESTRING (0 2, 9 2)"'
    ...     _ = path.write_text(f"WKT,id,crest\n{row}")
    ...     (slope,), problems = read_slopes(path, top="crest")
    >>> slope.top.wkt, slope.toe.wkt, problems
    ('LINESTRING (0 2, 9 2)', 'LINESTRING (0 2, 0 0, 9 0, 9 2)', [])
    """
    slopes, problems = read_file(Path(path), Hints(layer, top, toe, start, end), history=history)
    return slopes if kind is None else of_kind(slopes, kind), problems


def count_ended(path: str | Path, problems: Sequence[SlopeProblem], **hints: str | None) -> int:
    """Count what has ended in a register that has no slope of today, refused objects too.

    ``problems`` are those of today's objects, ``hints`` those of ``read_slopes``.
    """
    slopes, found = read_slopes(path, history=True, **hints)
    refused, of_today = (sum(p.kind == "refused" for p in some) for some in (found, problems))
    return len(slopes) + refused - of_today


def read_file(path: Path, hints: Hints, *, history: bool) -> tuple[list[Slope], list[SlopeProblem]]:
    """Read the slopes of a file of any kind."""
    if not path.exists():
        msg = f"IN {str(path)!r} does not exist"
        raise ParameterError(msg)
    if path.suffix.lower() == DRAWING:
        return read_cad(path, hints.top, hints.toe)
    if path.suffix.lower() in XML and hints == Hints():
        spaces = " ".join(gml.namespaces(path))
        if any(name in spaces for name in bdot500.DATABASES):
            return bdot500.read_bdot500(path, history=history)
        if bgt.MODEL in spaces:
            return bgt.read_bgt(path, history=history)
        for _ in gml.features(path):  # a file that breaks off says so, not that it lacks something
            pass
    return read_layer(path, hints)


def of_kind(slopes: list[Slope], kind: str) -> list[Slope]:
    """Return slopes that are of a kind, or of the kinds that a field tells.

    Raises
    ------
    ParameterError
        If it is neither a kind nor a field, or a field tells something else.
    """
    if kind in KINDS:
        return [replace(slope, kind=kind) for slope in slopes]
    wanted = f"expected one of {', '.join(KINDS)}"
    told = []
    for slope in slopes:
        if kind not in slope.attributes:
            msg = f"kind is {kind!r}, {wanted}, or a field of IN with these"
            raise ParameterError(msg)
        name = str(slope.attributes[kind])
        if name not in KINDS:
            msg = f"field {kind!r} of object {slope.id!r} is {name!r}, {wanted}"
            raise ParameterError(msg)
        told.append(replace(slope, kind=name))
    return told
