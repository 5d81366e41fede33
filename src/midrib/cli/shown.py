"""Tables on the terminal."""

import typer

__all__ = ["show"]


def show(rows: list[tuple[str, ...]]) -> None:
    """Print a table, its heading first."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        typer.echo("  ".join(cells).rstrip())
