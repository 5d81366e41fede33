"""One line about a run: how many lines, how long, how fast."""

from typing import TYPE_CHECKING

from midrib.formats.units import Unit, unit_of

if TYPE_CHECKING:
    from midrib.engines.batches import Counts

__all__ = ["summary"]

KILO = 1000.0
MANY = 10_000.0  # from so many metres on, lengths are in kilometres


def summary(counts: "Counts", crs: str | None, seconds: float) -> str:
    """One line about a run."""
    length = length_text(counts.length, unit_of(crs))
    rate = counts.features / seconds
    return (
        f"{counts.lines} lines of {counts.features} features, {counts.refused} refused, "
        f"{counts.repaired} repaired; {length} in {seconds:.1f} s, {rate:,.0f} features/s"
    )


def length_text(length: float, unit: Unit | None) -> str:
    """Write a length for people: ``12.3 km``, ``840.0 m``, ``3.1 units``."""
    if unit is None:
        return f"{length:.4g} units"
    if unit.metres == 1.0 and length >= MANY:
        return f"{length / KILO:,.1f} km"
    return f"{length:,.1f} {unit.name}"
