"""Write docs/standards.md, and draw the picture of each standard in it.

python tools/standards.py
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from shapely import LineString

from midrib import Standard, Strip, standard, standards
from midrib.formats.drawing.content import Drawing, Drawn
from midrib.formats.drawing.write import write_drawing
from midrib.hatching.draw import draw
from midrib.hatching.keys import CONFIDENCES, RULES, STROKED

DOCS = Path(__file__).parents[1] / "docs"
SCALE = 500.0
HEADING = (
    "| standard | symbol | line | short | gap | least gap | outline | code | for | confidence |"
)
START = """# Standards of hatching

What a hatched object looks like on paper. Each standard is a file of `midrib/hatching/standards`;
lengths are millimetres on paper. `midrib hatch --standard NAME` takes the name, or the beginning of
some (`pl-2015`, each object by the one made for its kind); `midrib.standards()` and
`midrib standards` list them. This page is written by `tools/standards.py`.

How sure the figures are, by their source:
"""
NOTES = """
Values with an asterisk are our own, whatever the confidence in the others. F: the gap is so many
times the local width, and no less than the least gap. Figures for 1:1000 are those of all scales
that are nearer to it than to 1:500, by ratio. Colours are our own: black, and brown for
orienteering maps.

The sizes of conveyors, gantries and water gates were not found. Of conveyors the paper has the
arrangement (Fig. 13: middles on the axis, every second circle tangent to both edges), of gantries
and water gates only that the axis can carry their symbols. Their templates are there to be
replaced.
"""
PYTHON = """## From Python

```python
slopes, problems = midrib.read_slopes("bdot500.gml")
drawing = midrib.draw_slopes(slopes, "pl-2015", 500, problems=problems)
midrib.write_drawing("map.pdf", drawing, paper="A3")
```
"""
SYMBOLS = """## Symbols

Wedges, triangles, forks and heads are as wide as the standard says, narrower where the next stroke
or the boundary is near: each has a part of the top for itself, and its sides are inside the area,
so symbols do not overlap where strokes do not. The options `--symbol` and `--symbol-width` of
`midrib hatch` draw any of them by any standard of strokes. Here they are 1.6 mm wide, and the
standard is `tadpole`, which draws no outline: the line of the top would make a fork a triangle.
"""
OWN = """## A standard of your own

A TOML file with the same keys, given by its path:
`midrib hatch slopes.gpkg map.pdf --standard house.toml`. It may build on another one; its title,
source and confidence are always its own. Values for other scales stand in tables of their own.

```toml
title = "Slopes of our house style"
source = "our manual, page 12"
confidence = "read"
base = "pl-2021-slope-unreinforced"
pattern = "LSS"
short_ratio = 0.4

[scale.1000]
min_spacing = 0.6
```

| key | what it may be |
| --- | --- |
"""


def slope() -> Strip:
    """Make a slope with a corner that runs out to a point."""
    x = np.linspace(0.0, 26.0, 53)
    top = [*np.column_stack([x, 14.0 + 1.2 * np.sin(x / 5.0)]), (36.0, 8.0), (38.0, 0.5)]
    toe = [(0.0, 9.0), (12.0, 8.5), (25.0, 8.0), (31.0, 4.5), (38.0, 0.5)]
    return Strip(LineString(top), LineString(toe))


def band(width: float) -> Strip:
    """Make a long object of some width, curved."""
    x = np.linspace(0.0, 38.0, 77)
    y = 2.5 * np.sin(x / 9.0)
    return Strip(LineString(np.column_stack([x, y + width])), LineString(np.column_stack([x, y])))


def sample(known: Standard) -> Strip:
    """Object that shows a standard."""
    widths = {"ticks": 0.9, "circles": 2.2, "template": 4.0}
    if known.symbol in widths:
        return band(widths[known.symbol])
    return band(3.0) if "stairs" in known.kinds else slope()


def draw_picture(name: str, known: Standard) -> None:
    """Draw an object by a standard."""
    symbols, _ = draw(sample(known), known, SCALE)
    drawing = Drawing(SCALE, objects=[Drawn(known.name, known.kinds[0], symbols)])
    write_drawing(DOCS / "pictures" / f"{name}.svg", drawing)


def row(known: Standard) -> str:
    """Row of the table."""
    is_stroked = known.symbol in STROKED
    cells = (
        f"`{known.name}`",
        known.symbol,
        marked(known, "stroke_width"),
        marked(known, "short_ratio") if is_stroked and "S" in known.pattern else "",
        gap(known),
        marked(known, "min_spacing") if is_stroked else "",
        outline(known),
        known.code,
        ", ".join(known.kinds),
        f"{known.confidence}: {known.source}",
    )
    return f"| {' | '.join(cells)} |"


def gap(known: Standard) -> str:
    """Cell about gaps, or the spacing of ticks and circles."""
    if known.factor is not None:
        text = f"F {marked(known, 'factor')}"
        if known.rule == "mean":
            return f"{text} of the mean width"
        if known.gentle_factor is None:
            return text
        return f"{text}, {known.gentle_factor:g} if gentler than 1:{known.gentle_run:g}"
    if known.spacing is None:
        return ""
    pair = f", pairs {both(known, 'pair')} apart" if known.pair else ""
    return f"{both(known, 'spacing')}{'*' if 'spacing' in known.assumed else ''}{pair}"


def outline(known: Standard) -> str:
    """Cell about the outline."""
    if known.outline == "none":
        return ""
    dashes = f", dashes {both(known, 'outline_dash')}" if known.outline_dash else ""
    return f"{known.outline}, {marked(known, 'outline_width')}{dashes}"


def marked(known: Standard, key: str) -> str:
    """Value of a key, with an asterisk if it is our own."""
    return f"{getattr(known, key):g}{'*' if key in known.assumed else ''}"


def both(known: Standard, key: str) -> str:
    """Values of a key at 1:500 and, if it differs, at 1:1000."""
    values = [getattr(known.at(scale), key) for scale in (500, 1000)]
    texts = [
        " / ".join(f"{v:g}" for v in value) if isinstance(value, tuple) else f"{value:g}"
        for value in values
    ]
    return texts[0] if texts[0] == texts[1] else f"{texts[0]} (1:1000: {texts[1]})"


def page() -> str:
    """Text of the page."""
    rows = [HEADING, "|" + " --- |" * (HEADING.count("|") - 1), *map(row, standards())]
    confidences = [f"- *{word}*: {meaning}" for word, meaning in CONFIDENCES.items()]
    keys = [f"| `{key}` | {wanted} |" for key, (_, wanted) in RULES.items()]
    shown = [f"{known.title}:\n\n{picture(f'standard-{known.name}')}" for known in standards()]
    symbols = [f"{symbol}:\n\n{picture(f'symbol-{symbol}')}" for symbol in STROKED]
    sections = [
        START + "\n" + "\n".join(confidences),
        "\n".join(rows) + "\n" + NOTES.rstrip("\n"),
        "## Pictures\n\nAt 1:500.",
        *shown,
        SYMBOLS.rstrip("\n"),
        *symbols,
        OWN + "\n".join(keys),
        PYTHON.rstrip("\n"),
    ]
    return "\n\n".join(sections) + "\n"


def picture(name: str) -> str:
    """Markdown of a picture."""
    return f"![{name}](pictures/{name}.svg)"


def main() -> None:
    """Draw everything and write the page."""
    for known in standards():
        draw_picture(f"standard-{known.name}", known)
    base = standard("tadpole")
    for symbol in STROKED:
        changed = base.with_values(symbol=symbol, symbol_width=1.6)
        draw_picture(f"symbol-{symbol}", replace(changed, name=f"symbol {symbol!r}"))
    (DOCS / "standards.md").write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
