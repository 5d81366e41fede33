"""The heap against sorting."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from midrib.kernels import heap as kernels
from tests.kernels.calling import callable_from_python

pop = callable_from_python(kernels.pop)
push = callable_from_python(kernels.push)


@given(keys=st.lists(st.integers(-5, 5), min_size=1, max_size=60))
@settings(max_examples=200)
def test_items_come_off_in_order_of_their_keys(keys: list[int]) -> None:
    key = np.array(keys, dtype=np.float64)
    heap, size = np.empty(len(keys), dtype=np.intp), 0
    for item in range(len(keys)):
        size = push(heap, key, size, item)
    assert size == len(keys)
    found = []
    while size > 0:
        found.append(int(pop(heap, key, size)))
        size -= 1
    assert sorted(found) == list(range(len(keys)))
    assert [keys[i] for i in found] == sorted(keys)


@given(keys=st.lists(st.integers(-9, 9), min_size=1, max_size=60), takes=st.randoms())
@settings(max_examples=200)
def test_pushing_and_popping_may_take_turns(keys: list[int], takes: object) -> None:
    key = np.array(keys, dtype=np.float64)
    heap, size = np.empty(len(keys), dtype=np.intp), 0
    inside: list[int] = []
    for item in range(len(keys)):
        size = push(heap, key, size, item)
        inside.append(item)
        if takes.random() < 0.4:  # type: ignore[attr-defined]
            top = int(pop(heap, key, size))
            size -= 1
            assert keys[top] == min(keys[i] for i in inside)
            inside.remove(top)
