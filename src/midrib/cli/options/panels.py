"""Where options stand in the help."""

from functools import partial

import typer

__all__ = [
    "argument",
    "of_care",
    "of_check",
    "of_engine",
    "of_layers",
    "of_line",
    "of_output",
    "of_strokes",
    "of_table",
    "of_tower",
]

argument = partial(typer.Argument, show_default=False)
of_layers = partial(typer.Option, rich_help_panel="Which features")
of_table = partial(typer.Option, rich_help_panel="What the table holds")
of_check = partial(typer.Option, rich_help_panel="What is checked")
of_strokes = partial(typer.Option, rich_help_panel="How strokes are made, lengths in mm on paper")
of_line = partial(typer.Option, rich_help_panel="How the line is made")
of_care = partial(typer.Option, rich_help_panel="After-care")
of_tower = partial(typer.Option, rich_help_panel="How the axis is found")
of_engine = partial(typer.Option, rich_help_panel="Where the work is done")
of_output = partial(typer.Option, rich_help_panel="Output")
