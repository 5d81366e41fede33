"""Names that every doctest may use without importing them."""

import numpy as np
import pytest
import shapely
from shapely import LineString, Polygon, box

import midrib


@pytest.fixture(autouse=True)
def _names_of_doctests(doctest_namespace: dict[str, object]) -> None:
    """Fill the namespace of doctests; a fixture below tests/ would not reach those in src/."""
    doctest_namespace.update(np=np, shapely=shapely, LineString=LineString, Polygon=Polygon)
    doctest_namespace.update(box=box, midrib=midrib)
    doctest_namespace.update({name: getattr(midrib, name) for name in midrib.__all__})
