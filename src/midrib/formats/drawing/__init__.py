"""Drawings of hatched objects: layers with a style, CAD, sheets to scale, cartographic objects."""
