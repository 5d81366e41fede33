"""The work of ``midrib network``: features in, a line from node to node and the nodes out."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib import measures
from midrib.cli.job import add_refused, whole, with_columns
from midrib.cli.output import Second
from midrib.curves.network import network
from midrib.engines.batches import numbers, statuses
from midrib.formats.units import is_geographic
from midrib.measures.widths import mean_widths_of_pieces

if TYPE_CHECKING:
    from collections.abc import Iterable

    from midrib.cli.job import Results
    from midrib.formats.reading import Batch, Geometries
    from midrib.types import Floats

__all__ = ["Nodes", "add_pieces", "check_network", "dissolved", "network_layer"]


class Nodes:
    """Nodes of networks, numbered as they come; those in the same place are one."""

    def __init__(self) -> None:
        self.number: dict[tuple[float, float], int] = {}
        self.ways: list[int] = []  # how many lines lead to each

    def numbered(self, points: "Floats") -> list[int]:
        """Numbers of the nodes at points."""
        found = []
        for x, y in points[:, :2].tolist():
            node = self.number.setdefault((x, y), len(self.number))
            if node == len(self.ways):
                self.ways.append(0)
            self.ways[node] += 1
            found.append(node)
        return found

    def layer(self) -> Second:
        """Return the layer of nodes."""
        table = pa.table(
            {"node": whole_numbers(len(self.ways)), "ways": pa.array(self.ways, pa.int64())}
        )
        places = np.array(list(self.number), dtype=np.float64).reshape(-1, 2)
        n_junctions = sum(ways > 2 for ways in self.ways)
        n_ends = sum(ways == 1 for ways in self.ways)
        summary = f"{n_junctions} junctions, {n_ends} dead ends"
        return Second(table, shapely.points(places), "Point", summary)


def whole_numbers(n: int) -> pa.Array:
    """Numbers from 0 to n - 1, of a type that files know even if there is none."""
    return pa.array(range(n), pa.int64())


def check_network(method: str, options: dict[str, Any]) -> None:
    """Refuse a method or an option that there is not, even where no feature needs it."""
    network([], method, **options)


def dissolved(batches: "Iterable[Batch]") -> "Batch":
    """All features in one batch, as one for each piece of what they cover together.

    Areas that are not valid stay as they are, to be repaired or refused by themselves.
    """
    batch = whole(batches)
    areas = batch.geometries
    is_whole = shapely.is_valid(areas) & (shapely.get_dimensions(areas) == 2)
    pieces = shapely.get_parts(shapely.union_all(areas[is_whole]))
    others = np.flatnonzero(~is_whole)
    rows = {int(row): k for k, row in enumerate(others, pieces.size)}
    unreadable = {rows[row]: why for row, why in batch.unreadable.items() if row in rows}
    return batch._replace(
        attributes=pa.table({"piece": whole_numbers(pieces.size + others.size)}),
        geometries=np.concatenate([pieces, areas[others]]),
        unreadable=unreadable,
    )


def network_layer(
    results: "Results", nodes: Nodes, batch: "Batch", method: str, options: dict[str, Any]
) -> None:
    """Find the networks of the features of a batch."""
    geographic = is_geographic(results.source.crs)
    areas = batch.geometries
    found, problems = network(areas, method, on_error="report", geographic=geographic, **options)
    refused = dict(batch.unreadable)
    status = statuses(batch.geometries, problems, refused)
    add_pieces(results, nodes, batch, found, status, geographic)
    add_refused(results, batch, refused)
    results.n_features += len(areas)
    results.n_repaired += len({p.index for p in problems if p.status == "repaired"})


def add_pieces(
    results: "Results",
    nodes: Nodes,
    batch: "Batch",
    found: "Geometries",
    status: list[str],
    geographic: bool,
) -> None:
    """Keep a row for each line, with the attributes of its feature and the numbers of its nodes."""
    lines, row = shapely.get_parts(found, return_index=True)
    ends = np.array([shapely.get_coordinates(line)[[0, -1]] for line in lines]).reshape(-1, 2)
    numbered = np.array(nodes.numbered(ends), dtype=np.int64).reshape(-1, 2)
    columns = {
        "from_node": pa.array(numbered[:, 0]),
        "to_node": pa.array(numbered[:, 1]),
        "length": numbers(measures.length(lines, geographic=geographic)),
        "width_mean": numbers(
            mean_widths_of_pieces(found, batch.geometries, geographic=geographic)
        ),
        "status": pa.array([status[i] for i in row], type=pa.string()),
    }
    results.attributes.append(with_columns(batch.attributes.take(row), columns))
    results.lines.append(lines)
    results.n_lines += len(lines)
    results.total_length += float(np.nansum(measures.length(lines, geographic=geographic)))
