"""How lines, networks and labels are made, and what becomes of them after."""

from typing import Annotated, TypeAlias

from midrib.cli.options.choices import Centring, Channel, EndRule, Holes, Mean, SkipRule
from midrib.cli.options.panels import of_care, of_line

__all__ = [
    "Aspect",
    "CentringOption",
    "ChannelOption",
    "Connect",
    "Count",
    "EndClearance",
    "EndsOption",
    "HolesOption",
    "LabelHeight",
    "LabelLength",
    "LeastBranch",
    "LeastPart",
    "MeanOption",
    "Merge",
    "Method",
    "Methods",
    "NarrowerThan",
    "PartialMethod",
    "Percent",
    "PointCount",
    "PointTolerance",
    "Significance",
    "Simplify",
    "SkeletonMethod",
    "SkeletonSignificance",
    "SkipOption",
    "Smooth",
    "Spacing",
    "Tolerance",
    "Vertices",
]

Methods: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="NAME,NAME",
        help="Some of [bold]midrib methods[/], the first is the measure. After a colon a value of "
        "--centring or --mean: minimal-radii:none, the paper's curve, minimal-radii:symmetric, "
        "mean-curve:kinks.",
    ),
]
Method: TypeAlias = Annotated[str, of_line(metavar="NAME", help="One of [bold]midrib methods[/].")]
Spacing: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="LENGTH",
        help="Interval of the radii: 2m, 50cm, 10ft; a plain number is in units of the CRS, "
        "metres if it is geographic. The mean width unless you say otherwise.",
    ),
]
Count: TypeAlias = Annotated[int | None, of_line(metavar="N", help="Or: number of intervals.")]
Percent: TypeAlias = Annotated[
    float | None, of_line(metavar="N", help="Or: interval in percent of the side's length.")
]
Vertices: TypeAlias = Annotated[
    bool | None,
    of_line(
        metavar="",
        help="Radii at the vertices of the side too; yes, unless the line is centred.",
        show_default=False,
    ),
]
CentringOption: TypeAlias = Annotated[
    Centring,
    of_line(
        metavar="HOW",
        help="centred: equally far from both sides; symmetric: mean of the two curves from "
        "either side; none: the paper's curve.",
    ),
]
Tolerance: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="LENGTH|PERCENT",
        help="How far off the middle a centred line may be where it is probed, a quarter of the "
        "width apart; 1% of the mean width unless you say otherwise, 0 for exact lines. Of other "
        "lines how far off the limit of ever denser radii. A length, or a share of the width: 1%.",
    ),
]
MeanOption: TypeAlias = Annotated[
    Mean | None,
    of_line(
        metavar="NAME", help="Mean of a symmetric line: radii, proportional, kinks, same-height."
    ),
]
SkipOption: TypeAlias = Annotated[
    SkipRule | None,
    of_line(
        metavar="WHICH",
        help="Radii to leave out. bays: those in bays and side arms, as of the paper's curve "
        "unless you say otherwise; none: no radius.",
    ),
]
HolesOption: TypeAlias = Annotated[
    Holes,
    of_line(
        metavar="WHAT",
        help="What holes are. blocked: in the way, the line goes round them; auxiliary: parts "
        "of the other side, the line stays between the main side and them; ignored: nothing, "
        "the line may cross them, and they do not bound widths.",
    ),
]
ChannelOption: TypeAlias = Annotated[
    Channel,
    of_line(
        metavar="WHICH",
        help="Where a centred line passes islands: the shorter way, or through the wider channels.",
    ),
]
EndsOption: TypeAlias = Annotated[
    EndRule,
    of_line(
        metavar="RULE",
        help="Where the line ends. caps: in the middles of the end caps; main: at the ends of "
        "the main side; radii: at the middles of its last radii to other segments; none: with "
        "its last radius.",
    ),
]
EndClearance: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="RULE|LENGTH",
        help="What keeps radii out of a tip that both sides share: station, proportional, "
        "none, or a length; proportional, unless the line is centred.",
    ),
]
Connect: TypeAlias = Annotated[
    bool,
    of_line(
        "--connect",
        metavar="",
        help="Lines of areas that share an edge meet; joints, and edges without one, go to a "
        "layer, or a file, …_joints.",
    ),
]
SkeletonMethod: TypeAlias = Annotated[
    str, of_line(metavar="NAME", help="One of [bold]midrib methods[/] that have branches.")
]
PartialMethod: TypeAlias = Annotated[
    str,
    of_line(metavar="NAME", help="[bold]medial-axis[/], whose discs touch both banks; no other."),
]
Merge: TypeAlias = Annotated[
    float,
    of_line(
        metavar="N",
        help="Junctions are one crossing up to so many times the sum of their radii apart, twice "
        "as many where all arms lead to one point. 0 keeps those of the skeleton.",
    ),
]
NarrowerThan: TypeAlias = Annotated[
    str,
    of_line(
        "--narrower-than",
        metavar="LENGTH",
        help="Parts that are less wide become lines: 20m, 50ft; a plain number is in units of the "
        "CRS, metres if it is geographic.",
        show_default=False,
    ),
]
LeastPart: TypeAlias = Annotated[
    str | None,
    of_line(
        "--min-length",
        metavar="LENGTH",
        help="Shorter parts go with what is beside them, unless they are 1.25 times as wide as "
        "that. As long as it is wide unless you say otherwise.",
    ),
]
LeastBranch: TypeAlias = Annotated[
    str | None,
    of_line("--min-branch-length", metavar="LENGTH", help="Leave out shorter dead ends."),
]
Significance: TypeAlias = Annotated[
    float,
    of_line(
        metavar="N",
        help="Leave out dead ends that reach less than so many radii from their junction; a "
        "corner reaches 1.41.",
    ),
]
SkeletonSignificance: TypeAlias = Annotated[
    float | None,
    of_line(
        "--min-significance",
        metavar="N",
        help="Leave out dead ends that reach less than so many radii from their junction: 1.5 for "
        "corners, 3 for all but arms. None unless you say so.",
    ),
]
LabelLength: TypeAlias = Annotated[
    str | None,
    of_line("--length", metavar="LENGTH", help="Of the text; as long as fits unless given."),
]
LabelHeight: TypeAlias = Annotated[
    str | None,
    of_line("--height", metavar="LENGTH", help="Of the text; as high as fits unless given."),
]
Aspect: TypeAlias = Annotated[
    float | None,
    of_line(
        metavar="N", help="Length over height of the text, where neither is given.  [default: 6]"
    ),
]
PointCount: TypeAlias = Annotated[
    int | None, of_line("--count", metavar="N", help="So many points of each line at most.")
]
PointTolerance: TypeAlias = Annotated[
    str | None,
    of_line(
        "--tolerance",
        metavar="LENGTH",
        help="Or: as few as keep the whole line this near to the line through them.",
    ),
]
Simplify: TypeAlias = Annotated[
    str | None,
    of_care(
        metavar="LENGTH|PERCENT",
        help="Leave out vertices as long as the line stays this near to the full one, inside "
        "the area: 50cm, or 5% of the mean width.",
    ),
]
Smooth: TypeAlias = Annotated[
    bool,
    of_care(
        "--smooth",
        metavar="",
        help="Cut the line's corners, inside the area, in three rounds.",
    ),
]
