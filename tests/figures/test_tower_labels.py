"""Labels of a curve, as they are drawn: clear of each other, of the curve and of the frame."""

from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Annotation

from midrib.figures.tower_labels import label_curve
from midrib.figures.tower_pages import sheet_of

RUN = np.linspace(0.0, 1.0, 121)
CURVES = {
    "lean": np.column_stack([200.0 * RUN, 200.0 * RUN]),
    "level": np.column_stack([200.0 * RUN, 0.0 * RUN]),
    "bend": np.column_stack([100.0 * RUN, -100.0 * RUN * np.sin(2.0 * np.pi * RUN)]),
    "spiral": 50.0 * RUN[:, None] * np.column_stack([np.cos(15.0 * RUN), np.sin(15.0 * RUN)]),
    "broken": np.column_stack([30.0 * RUN + 10.0 * (RUN > 0.5), np.where(RUN == 0.5, np.nan, RUN)]),
}


@pytest.mark.parametrize("name", CURVES)
def test_labels_meet_nothing(name: str) -> None:
    corners = CURVES[name]
    sheet = sheet_of(90.0, 76.0)
    axes = sheet.place(14.0, 12.0, 70.0, 54.0)
    axes.plot(*corners.T)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.12)
    rows = np.flatnonzero(np.isfinite(corners[:, 1]))[::2]
    rows = np.roll(rows, 1)
    kept = label_curve(axes, corners, rows, [f"{row} m" for row in rows], 0.0)
    canvas: Any = FigureCanvasAgg(sheet.figure)
    canvas.draw()
    labels = [text for text in axes.texts if isinstance(text, Annotation)]
    assert [label.get_text() for label in labels] == [f"{row} m" for row in kept]
    assert kept[:2].tolist() == rows[:2].tolist()  # both ends
    assert len(kept) >= 4
    boxes = np.array([super(Annotation, t).get_window_extent(canvas.get_renderer()).extents
                      for t in labels])  # fmt: skip
    low, high = boxes[:, :2], boxes[:, 2:]
    meets = ((low[:, None] < high) & (high[:, None] > low)).all(axis=2)
    assert np.array_equal(meets, np.eye(len(boxes), dtype=bool))
    fine = np.column_stack([np.interp(np.arange(0.0, 120.0, 0.05), np.arange(121.0), c)
                            for c in corners.T])  # fmt: skip
    curve = axes.transData.transform(fine)[:, None]
    assert not ((curve > low) & (curve < high)).all(axis=2).any()
    frame = np.array(axes.bbox.extents)
    assert (low >= frame[:2] - 1.0).all()
    assert (high <= frame[2:] + 1.0).all()
