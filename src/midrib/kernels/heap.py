"""A binary heap of integers ordered by keys kept elsewhere."""

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["pop", "push"]


@njit(borrows=True)
def push(heap: Ints, key: Floats, size: int, item: int) -> int:
    """Put an item on a heap of ``size`` items; return the new size."""
    place = size
    while place > 0:
        parent = (place - 1) // 2
        if key[heap[parent]] <= key[item]:
            break
        heap[place] = heap[parent]
        place = parent
    heap[place] = item
    return size + 1


@njit(borrows=True)
def pop(heap: Ints, key: Floats, size: int) -> int:
    """Take the item with the smallest key off a heap of ``size`` items; it has one less then."""
    top, item = heap[0], heap[size - 1]
    size -= 1
    place = 0
    while 2 * place + 1 < size:
        child = 2 * place + 1
        if child + 1 < size and key[heap[child + 1]] < key[heap[child]]:
            child += 1
        if key[item] <= key[heap[child]]:
            break
        heap[place] = heap[child]
        place = child
    heap[place] = item
    return top
