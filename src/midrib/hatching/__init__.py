"""Hatching: the strokes that show on a map which way a slope falls."""
