"""How a curve is made from a strip: every option in one place, checked once, used many times."""

from contextlib import suppress
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from midrib.checks import is_number, shown
from midrib.curves.averaging import Mean, average, check_mean
from midrib.curves.joining import Channel, EndRule, between_ends, check_ends, join_middles
from midrib.curves.kinks import kink_mean
from midrib.curves.limit import draw_limit
from midrib.curves.radii import EndClearance, Radii, draw_radii
from midrib.curves.stations import WHOLE, Skip, StationRule
from midrib.errors import InvalidAreaError, ParameterError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from midrib.curves.joining import Path
    from midrib.layout import Layout

__all__ = ["CENTRED_WITHIN", "Centring", "Construction", "Holes"]

Centring: TypeAlias = Literal["none", "symmetric", "centred"]
Holes: TypeAlias = Literal["blocked", "auxiliary", "ignored"]
CENTRINGS = ("none", "symmetric", "centred")
HOLES = ("blocked", "auxiliary", "ignored")
CHANNELS = ("shorter", "wider")
CENTRED_WITHIN = 1.0 / 100.0  # of the mean width, unless a tolerance is given


class Construction:
    """The construction of a curve; see ``minimal_radii`` for what the options mean.

    Raises
    ------
    ParameterError
        If an option has a value it cannot have.
    """

    def __init__(
        self,
        *,
        spacing: float | None = None,
        count: int | None = None,
        percent: float | None = None,
        vertices: bool | None = None,
        tolerance: float | str | None = None,
        stations: "ArrayLike | None" = None,
        skip: Skip | None = None,
        ends: EndRule = "main",
        end_clearance: EndClearance = "proportional",
        centring: Centring = "none",
        mean: Mean | None = None,
        holes: Holes = "blocked",
        channel: Channel = "shorter",
    ) -> None:
        self.ends, self.end_clearance = check_ends(ends, end_clearance)
        check_centring(centring)
        self.tolerance = check_tolerance(tolerance)
        self.follows_limit = tolerance is not None and centring != "centred"
        if self.follows_limit:
            refuse_with_tolerance(
                spacing=spacing, count=count, percent=percent, vertices=vertices, stations=stations,
                skip=skip, holes="auxiliary" if holes == "auxiliary" else None,
            )  # fmt: skip
        check_holes(holes, channel, centring)
        check_mean(mean, centring)
        if vertices is None:
            vertices = centring != "centred"  # the trunk is probed between radii anyway
        self.rule = StationRule(spacing, count, percent, vertices, stations, skip)
        self.centring, self.mean = centring, mean
        self.holes, self.channel = holes, channel

    def of(self, layout: "Layout") -> "tuple[Radii, Path]":
        """Radii and the chain that is made from them.

        Raises
        ------
        InvalidAreaError
            If no station sees anything of the auxiliary curve, or the curve is one point.
        """
        if self.holes == "auxiliary":
            layout = layout.bridged()
        radii, ends = between_ends(self.radii(layout), self.ends)
        if isinstance(self.mean, str) and self.mean == "kinks":
            return radii, kink_mean(layout, ends, radii)
        if self.centring == "symmetric":
            other = layout.swapped()
            from_other, _ = between_ends(self.radii(other), ends)
            if not len(radii.points) or not len(from_other.points):
                msg = "no radius is left between the two points of ends, so there is no mean"
                raise ParameterError(msg)
            return radii, average(
                layout,
                (radii, join_middles(layout, radii, ends)),
                (from_other, join_middles(other, from_other, ends)),
                self.mean,
            )
        if self.centring == "centred":
            return radii, join_middles(
                layout, radii, ends, centred_within=self.within(layout), channel=self.channel
            )
        return radii, join_middles(layout, radii, ends)

    def radii(self, layout: "Layout") -> Radii:
        """Radii from a layout's main curve."""
        if self.follows_limit:
            radii = draw_limit(layout, self.within(layout), self.end_clearance)
        else:
            radii = draw_radii(layout, self.rule, self.end_clearance)
        if len(radii.points) == 0:
            msg = "no station of the main curve sees anything of the auxiliary curve"
            raise InvalidAreaError(msg)
        return radii

    def within(self, layout: "Layout") -> float:
        """Return the tolerance as a length."""
        value, is_share = self.tolerance
        return value * layout.mean_width if is_share else value


def check_centring(centring: Any) -> None:
    """Refuse ways of centring that do not exist."""
    if not isinstance(centring, str) or centring not in CENTRINGS:
        msg = f"centring is {shown(centring)}, expected 'none', 'symmetric' or 'centred'"
        raise ParameterError(msg)


def check_tolerance(tolerance: Any) -> tuple[float, bool]:
    """Return the tolerance, and whether it is a share of the mean width.

    Raises
    ------
    ParameterError
        If it is neither a length nor a share.
    """
    if tolerance is None:
        return CENTRED_WITHIN, True
    is_share = isinstance(tolerance, str) and tolerance.strip().endswith("%")
    value = tolerance
    if is_share:
        with suppress(ValueError):
            value = float(tolerance.strip().removesuffix("%")) / WHOLE
    if not is_number(value) or not 0.0 <= value < float("inf"):
        msg = (
            f"tolerance is {shown(tolerance)}, expected a length of 0 or more, or a share of the "
            "width: '1%'"
        )
        raise ParameterError(msg)
    return float(value), is_share


def refuse_with_tolerance(**options: Any) -> None:
    """Refuse options that choose stations: with a tolerance the limit curve chooses them."""
    for name, value in options.items():
        if value is not None:
            msg = (
                f"tolerance and {name} exclude each other unless centring is 'centred': the "
                "tolerance chooses the stations"
            )
            raise ParameterError(msg)


def check_holes(holes: Any, channel: Any, centring: Any) -> None:
    """Refuse meanings of holes and ways past islands that do not exist."""
    if not isinstance(holes, str) or holes not in HOLES:
        msg = f"holes is {shown(holes)}, expected 'blocked', 'auxiliary' or 'ignored'"
        raise ParameterError(msg)
    if holes == "auxiliary" and centring == "symmetric":
        msg = "holes='auxiliary' goes with centring='none' or 'centred', found 'symmetric'"
        raise ParameterError(msg)
    if not isinstance(channel, str) or channel not in CHANNELS:
        msg = f"channel is {shown(channel)}, expected 'shorter' or 'wider'"
        raise ParameterError(msg)
    if channel == "wider" and (holes != "blocked" or centring != "centred"):
        msg = (
            "channel='wider' goes with holes='blocked' and centring='centred', found "
            f"holes={holes!r} and centring={centring!r}"
        )
        raise ParameterError(msg)
