"""The command ``midrib tower``."""

from typing import Any

import typer

from midrib.cli import options as cli
from midrib.cli.options import TowerMode, TowerShape, TowerThinning
from midrib.errors import ParameterError

__all__ = ["tower"]


def tower(
    source: cli.PointsIn,
    reports: cli.TowerReport = None,
    out: cli.TowerOut = None,
    mode: cli.TowerModeOption = TowerMode.joint,
    shape: cli.TowerShapeOption = TowerShape.auto,
    planes: cli.FanPlanes = 18,
    thinning: cli.TowerThinningOption = TowerThinning.moving_least_squares,
    step: cli.LevelStep = None,
    near: cli.Near = None,
    radius: cli.RadiusRange = None,
    unit: cli.CloudUnit = None,
    registration: cli.Registration = None,
    levelling: cli.Levelling = 0.0,
    tolerance: cli.Verticality = None,
    title: cli.ReportTitle = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Find the axis of a tower or chimney in a laser scan."""
    from midrib.cli.axes import Places, chosen_options
    from midrib.cli.report import Report
    from midrib.cli.shown import show
    from midrib.figures.tower_report import summary_lines
    from midrib.formats.clouds import open_cloud
    from midrib.towers.pipeline import Options, axis_of
    from midrib.towers.tolerance import tolerance_from

    check_used("--planes", mode, TowerMode.fan, changed=planes != Options.planes)
    check_used("--thinning", mode, TowerMode.paper, changed=thinning.value != Options.thinning)
    places = Places(source, tuple(reports or ()), tuple(out or ()))
    places.check(overwrite=overwrite)
    allowed = None if tolerance is None else tolerance_from(tolerance)
    cloud = open_cloud(source)
    told = {"step": step, "near": near, "radius": radius, "registration": registration}
    others = {"levelling": levelling, "planes": planes, "thinning": thinning.value}
    options = chosen_options(cloud, unit, told, mode=mode.value, shape=shape.value, **others)
    report = Report(quiet=quiet)
    report.start(lambda: None)

    def track(chunks: Any, doing: str) -> Any:
        return report.track(chunks, cloud.count, len, doing)

    axis = axis_of(cloud, options, track)
    if not quiet:
        show(summary_lines(axis, allowed))
    notes = places.write(axis, title or source.stem, allowed, options)
    for note in [*notes, *(f"written to {path}" for path in places.all)]:
        report.say(note)
    if (axis.levels["flag"] != "").any():
        raise typer.Exit(1)


def check_used(option: str, mode: TowerMode, user: TowerMode, *, changed: bool) -> None:
    """Refuse an option that the mode has no use for.

    Raises
    ------
    ParameterError
        If it is not as usual, and another mode is its user.
    """
    if changed and mode is not user:
        msg = f"{option} is of no effect in --mode {mode.value}, expected --mode {user.value}"
        raise ParameterError(msg)
