"""Lines of neighbouring areas that meet: joints in the middles of shared edges.

end to end          side            An edge is a joint if it is at an end of one of its two areas
+-----+-----+      +---------+      at least. Both end their lines in its middle, or one does, and
|--i--o--j--|      |----o-j--|      goes on from there to the other's line by the shortest path.
+-----+-----+      +---+|+---+      An edge along both areas, a road beside its verge, is none.
                       |i|
"""

from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString

from midrib import interrupts
from midrib.curves.meeting import ROUNDING, Chain, way_to_chain
from midrib.curves.outlines import Outline, Stretch
from midrib.ends import End
from midrib.errors import MidribError
from midrib.geodesy import degree_lengths
from midrib.layout import Scale
from midrib.ragged import normalised, pack_areas
from midrib.shared_edges import SharedEdge, find_shared_edges
from midrib.types import Floats

__all__ = ["Joined", "Kind", "Plan", "make_joints", "plan_joints", "straightened"]

Areas = NDArray[np.object_]
Lines = list[LineString | None]
Chains = dict[int, Chain]
Kind = Literal["end to end", "side", "none"]
PLANE: Scale = (1.0, 1.0)
HALF = 0.5
FAR = 8.0  # widths of an area: a way through it that is longer goes along it, beside its line
OFFERED = HALF**HALF  # what an edge counts that is only a neighbour's end: two of them half


class Joined(NamedTuple):
    """What became of a shared edge: a joint of two areas, or the reason why it is none."""

    areas: tuple[int, int]  # of a side joint the area whose line ends on the other's comes first
    kind: Kind
    point: Floats  # where the lines meet, or the middle of the edge
    reason: str


@dataclass(eq=False)
class Contact:
    """A shared edge and what its two areas make of it."""

    edge: SharedEdge
    length: float
    middle: Floats
    is_open: bool = False  # whether the middle lies in a gap, as narrow as the rounding
    stretch: dict[int, Stretch] = field(default_factory=dict)  # by area, where on its shell
    at_end: set[int] = field(default_factory=set)  # areas at whose ends it is
    chosen: dict[int, int] = field(default_factory=dict)  # area to the end of its line, 0 or 1

    def beyond(self, i: int) -> int:
        """Return the other one of the two areas."""
        return self.edge.areas[1] if self.edge.areas[0] == i else self.edge.areas[0]


Pair = tuple[Contact | None, Contact | None]
Ends = tuple[End, End]


@dataclass
class Plan:
    """Areas with the ends their lines are to have, and the shared edges these come from."""

    areas: Areas  # with the ends of edges as vertices
    ends: list[Ends | None]
    contacts: list[Contact]
    outlines: dict[int, Outline]


def plan_joints(areas: Areas, n_lines: int, *, geographic: bool) -> Plan:
    """Choose the ends of areas so that their lines meet.

    Parameters
    ----------
    areas : (n,) Polygons; the first ``n_lines`` are collapsed, the others only have a boundary
    n_lines : how many
    geographic : whether coordinates are degrees

    Notes
    -----
    1. Each area takes the shared edges at the ends that its shape proposes, and so offers them to
    its neighbours. 2. Each area looks again, now also at edges that are offered near its ends
    (``Outline.is_near``). An end that is left over where the area is about as long as wide moves to
    the other side from the edge that it does take, and may meet one there. So do short pieces,
    whose shape proposes the wrong two sides. 3. Again, until nothing new is offered.
    """
    shared = find_shared_edges(areas)
    contacts = [contact_of(edge, geographic=geographic) for edge in shared.edges]
    mark_gaps(contacts, areas)
    touched = sorted({i for edge in shared.edges for i in edge.areas if i < n_lines})
    outlines = outlines_of(shared.areas, touched, geographic=geographic)
    edges = edges_of_areas(contacts, outlines)
    pairs = agreed_pairs(outlines, edges)
    ends: list[Ends | None] = [None] * n_lines
    for i, pair in pairs.items():
        ends[i] = ends_at(i, outlines[i], pair)
        if ends[i] is not None:
            for number, contact in enumerate(pair):
                if contact is not None:
                    contact.chosen[i] = number
    return Plan(shared.areas, ends, contacts, outlines)


def agreed_pairs(outlines: dict[int, Outline], edges: dict[int, list[Contact]]) -> dict[int, Pair]:
    """Choose edges for the ends of all areas, in rounds; see ``plan_joints``."""
    candidates = {i: at_ends(i, outline, edges[i]) for i, outline in outlines.items()}
    pairs: dict[int, Pair] = {}
    offers: set[tuple[Contact, int]] = set()  # an edge and the area it is an end of
    asked = set(outlines)
    while asked:  # offers are never taken back, so this ends
        for i in asked:
            interrupts.check()
            offered = [c for c in edges[i] if (c, c.beyond(i)) in offers]
            pair = widest_way(i, outlines[i], with_near(outlines[i], i, candidates[i], offered))
            pairs[i] = with_opposite(i, outlines[i], pair, edges[i])
        new = {(c, i) for i in asked for c in pairs[i] if c is not None} - offers
        offers |= new
        asked = {c.beyond(i) for c, i in new} & outlines.keys()
    return pairs


def contact_of(edge: SharedEdge, *, geographic: bool) -> Contact:
    """Measure a shared edge and find its middle."""
    low, high = edge.points.min(axis=0), edge.points.max(axis=0)
    scale = degree_lengths(np.append(low, high)) if geographic else PLANE
    arc = np.append(0.0, np.cumsum(np.hypot(*(np.diff(edge.points, axis=0) * scale).T)))
    k = int(np.searchsorted(arc[1:-1], arc[-1] / 2.0, side="right"))
    share = (arc[-1] / 2.0 - arc[k]) / (arc[k + 1] - arc[k])
    middle = edge.points[k] + share * (edge.points[k + 1] - edge.points[k])
    return Contact(edge, float(arc[-1]), middle)


def mark_gaps(contacts: list[Contact], areas: Areas) -> None:
    """Mark edges with a middle that is not in both areas.

    It may be so where only one of them has a vertex on it: rounded, that is off the other's edge.
    """
    pairs = np.array([contact.edge.areas for contact in contacts], dtype=np.intp).reshape(-1, 2)
    middles = np.array([contact.middle for contact in contacts]).reshape(-1, 2)
    off = shapely.distance(areas[pairs], shapely.points(middles)[:, None]).max(axis=1)
    for k in np.flatnonzero(off > ROUNDING * np.abs(middles).max(axis=1)):
        contacts[k].is_open = True


def outlines_of(areas: Areas, which: list[int], *, geographic: bool) -> dict[int, Outline]:
    """Outlines of some of the areas, but for those that cannot be meshed."""
    outlines: dict[int, Outline] = {}
    if not which:
        return outlines
    packed = pack_areas(areas[which])
    for row, i in enumerate(which):
        interrupts.check()
        try:
            scale = degree_lengths(np.array(areas[i].bounds)) if geographic else PLANE
            outlines[i] = Outline(normalised(*packed.rings(row))[0], scale)
        except MidribError:  # the line of such an area is refused, with the reason
            continue
    return outlines


def edges_of_areas(
    contacts: list[Contact], outlines: dict[int, Outline]
) -> dict[int, list[Contact]]:
    """Contacts on the shell of each area."""
    edges: dict[int, list[Contact]] = {i: [] for i in outlines}
    for contact in contacts:
        for i, corners in zip(contact.edge.areas, contact.edge.corners, strict=True):
            if i not in outlines or contact.edge.is_closed or contact.is_open:
                continue
            on_shell = outlines[i].stretch(corners, contact.length)
            if on_shell is not None:
                contact.stretch[i] = on_shell
                edges[i].append(contact)
    return edges


def at_ends(i: int, outline: Outline, edges: list[Contact]) -> list[list[Contact]]:
    """Contacts at either end of an area."""
    found = [[c for c in edges if outline.is_at(c.stretch[i], end)] for end in outline.ends]
    for contact in (*found[0], *found[1]):
        contact.at_end.add(i)
    return found


def with_near(
    outline: Outline, i: int, candidates: list[list[Contact]], offered: list[Contact]
) -> list[list[Contact]]:
    """Complete the candidates for either end by edges that neighbours offer near it."""
    return [
        known + [c for c in offered if c not in known and outline.is_near(c.stretch[i], end)]
        for known, end in zip(candidates, outline.ends, strict=True)
    ]


def widest_way(i: int, outline: Outline, candidates: list[list[Contact]]) -> Pair:
    """Choose an edge for each end: both if possible, then long edges far apart.

    Far apart, so that the line goes straight on through a junction; long, up to the area's width,
    so that it follows the wide arm where narrow ones meet it. An edge that is not at an end of the
    area itself counts less, and a bank of the area does not go with the end that it leads up to.
    """
    best: Pair = (None, None)
    most = (0, 0.0)
    for first in (*candidates[0], None):
        for second in (*candidates[1], None):
            if first is second or is_bank_of(i, outline, first, second):
                continue
            places = [
                outline.middle(end) if contact is None else contact.middle
                for contact, end in zip((first, second), outline.ends, strict=True)
            ]
            apart = float(np.hypot(*((places[1] - places[0]) * outline.scale)))
            taken = [c for c in (first, second) if c is not None]
            wide = min([outline.width, *(c.length for c in taken)])
            own = OFFERED ** sum(i not in c.at_end for c in taken)
            value = (len(taken), wide * apart * own)
            if value > most:
                best, most = (first, second), value
    return best


def is_bank_of(i: int, outline: Outline, first: Contact | None, second: Contact | None) -> bool:
    """Whether one of two edges is a bank of the area, right up to the other.

    A neighbour's end on such a bank is joined from the side.
    """
    if first is None or second is None:
        return False
    a, b = first.stretch[i], second.stretch[i]
    return outline.is_bank_up_to(a, b) or outline.is_bank_up_to(b, a)


def with_opposite(i: int, outline: Outline, pair: Pair, edges: list[Contact]) -> Pair:
    """Complete a pair with one edge, where the area is short, by the edge on its other side."""
    for number in (0, 1):
        contact = pair[1 - number]
        if pair[number] is None and contact is not None:
            end = free_end(i, outline, number, contact)
            if end == outline.ends[number]:
                continue
            for edge in edges:
                is_as_long = edge.length >= HALF * contact.length
                if edge is not contact and is_as_long and not outline.gap(edge.stretch[i], end):
                    return (edge, contact) if number == 0 else (contact, edge)
    return pair


def free_end(i: int, outline: Outline, number: int, contact: Contact) -> End:
    """Return an end that no edge takes; moved to the other side if it is near one that is taken."""
    on_shell = contact.stretch[i]
    if outline.is_near(on_shell, outline.ends[number]):
        return outline.at(on_shell.start + (on_shell.length + outline.perimeter) * HALF)
    return outline.ends[number]


def ends_at(i: int, outline: Outline, pair: Pair) -> Ends | None:
    """Place the ends of an area: each edge is a cap, or a point if caps would use up a bank."""
    if pair == (None, None):
        return None
    caps, middles = [], []
    for number, contact in enumerate(pair):
        if contact is None:
            other = pair[1 - number]
            assert other is not None
            end = free_end(i, outline, number, other)
            if outline.has(outline.ends[number], outline.position(end)):
                end = outline.ends[number]
            caps.append(end)
            middles.append(outline.at(outline.position(end) + outline.length(end) * HALF))
        else:
            on_shell = contact.stretch[i]
            caps.append(End(on_shell.place, on_shell.other))
            middles.append(outline.at(on_shell.start + on_shell.length * HALF))
    for first, second in (
        (caps[0], caps[1]),
        (caps[0], middles[1]),
        (middles[0], caps[1]),
        (middles[0], middles[1]),
    ):
        if outline.leaves_two_banks(first, second):
            return first, second
    return None


def straightened(plan: Plan, lines: Lines) -> Lines:
    """Return the lines between their ends without hooks at shared edges; see ``Chain.unhook``.

    Ends where no line could be drawn between them are no longer chosen.
    """
    chains = {i: Chain.of(line) for i, line in enumerate(lines) if line is not None}
    for contact in plan.contacts:
        contact.chosen = {i: end for i, end in contact.chosen.items() if plan.ends[i] is not None}
        for i, end in contact.chosen.items():
            if i in chains:
                interrupts.check()
                scale = plan.outlines[i].scale
                chains[i].unhook(end, plan.areas[i], contact.edge.points, scale)
    return [chains[i].line() if i in chains else None for i in range(len(lines))]


def make_joints(plan: Plan, lines: Lines) -> tuple[Lines, list[Joined]]:
    """Let the lines of areas with chosen ends meet.

    Parameters
    ----------
    plan : which ends were chosen
    lines : the line of each area between its ends, None where it was refused

    Returns
    -------
    lines : with joints as vertices, bit by bit the same in both
    joined : one row for each shared edge
    """
    chains = {i: Chain.of(line) for i, line in enumerate(lines) if line is not None}
    joined: list[Joined] = []
    sides: list[tuple[Contact, int, int]] = []
    for contact in plan.contacts:
        reason = obstacle(contact, chains)
        if reason:
            joined.append(Joined(contact.edge.areas, "none", contact.middle, reason))
            continue
        meet(contact, chains)
        if len(contact.chosen) == 2:
            joined.append(Joined(contact.edge.areas, "end to end", contact.middle, ""))
        else:
            (i,) = contact.chosen
            sides.append((contact, i, contact.beyond(i)))
    for side in sides:
        interrupts.check()
        joined.append(join_side(*side, plan.outlines, chains))
    return finished(lines, chains, joined)


def finished(lines: Lines, chains: Chains, joined: list[Joined]) -> tuple[Lines, list[Joined]]:
    """Return the joined lines, those that would cross themselves as they were, and the rows."""
    done = [chains[i].line() if i in chains else None for i in range(len(lines))]
    crossed = {i for i, line in enumerate(done) if line is not None and not line.is_simple}
    for i in crossed:
        done[i] = lines[i]
    rows = [
        row._replace(kind="none", reason="a line would cross itself there")
        if row.kind != "none" and crossed.intersection(row.areas)
        else row
        for row in joined
    ]
    return done, rows


def obstacle(contact: Contact, chains: Chains) -> str:
    """Say why two lines do not meet at a shared edge, or nothing."""
    there = [i in chains for i in contact.edge.areas]
    if not all(there):
        return "one of the areas has no line" if any(there) else "neither area has a line"
    if contact.chosen:
        return ""
    if contact.is_open:
        return "a gap as wide as the rounding of the coordinates is between the areas"
    if contact.edge.is_closed:
        return "one area lies inside the other"
    if contact.at_end:
        return "the end there is joined to another area"
    return "it is at an end of neither area"


def meet(contact: Contact, chains: Chains) -> None:
    """Let lines end in exactly the middle of a shared edge, at their mean height."""
    ends = [(chains[i], end) for i, end in contact.chosen.items()]
    height = [chain.points[-end, 2] for chain, end in ends if chain.points.shape[1] > 2]
    for chain, end in ends:
        has_z = chain.points.shape[1] > 2
        chain.put_end(end, np.append(contact.middle, np.mean(height)) if has_z else contact.middle)


def join_side(
    contact: Contact, i: int, j: int, outlines: dict[int, Outline], chains: Chains
) -> Joined:
    """Lead the line of area i on to the line of area j."""
    side, main = chains[i], chains[j]
    outline = outlines[j]
    way = way_to_chain(outline, contact.middle, main.points[:, :2])
    reason = "no way leads from it to the other line"
    if way is not None and way.length(outline.scale) > FAR * outline.width:
        far, width = way.length(outline.scale), outline.width
        reason = f"the other line is {far:.3g} away, and its area {width:.3g} wide"
    elif way is not None:
        end, point = contact.chosen[i], main.point_at(way)
        side.go_on(end, way, point, outline.scale)
        if side.line().is_simple:
            main.pass_through(way, point)
            return Joined((i, j), "side", point[:2], "")
        side.ways.pop(end, None)
        reason = "on the way to the other line it would cross itself"
    return Joined((i, j), "none", contact.middle, reason)
