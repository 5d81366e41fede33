"""The cheapest sequence of chords beside one that is looked for in every way."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from midrib.kernels.fans import Fans, Wanted, cheapest_way
from midrib.types import Ints

TOTAL = 12.0
OPEN = np.zeros(3)
ENDS = np.array([[np.nan, np.nan, 0.0], [np.nan, np.nan, TOTAL]])


def random_fans(seed: int, n: int, m: int) -> Fans:
    """Fans on a slope about 4 wide whose gaps are 2; a fifth of the chords join no edges."""
    rng = np.random.default_rng(seed)
    tau = np.sort(rng.uniform(0.2, TOTAL - 0.2, n))
    turn = np.linspace(-0.4, 0.4, m) + rng.normal(0.0, 0.02, (n, m))
    feet = tau[:, None, None] + 2.0 * np.stack([-turn, turn], axis=2)
    feet += rng.normal(0.0, 0.2, feet.shape)
    width = rng.uniform(3.6, 4.4, (n, m))
    cost = turn**2
    cost[rng.random((n, m)) < 0.2] = np.inf
    return Fans(tau, 0.05 * tau, np.full(n, 0.35), turn, feet, width, width / 2.0, cost)


def cost_of(fans: Fans, j: int, d: int, i: int, c: int, wanted: Wanted) -> float:
    """What it costs to go on from one chord to another, written down anew."""
    ahead = fans.tau[i] - fans.tau[j]
    plain = (fans.gap[i, c] + fans.gap[j, d]) / 2.0
    off = abs(np.log(ahead / (wanted.stretch * plain))) if ahead > 0.0 else np.inf
    if off > 0.7:
        return np.inf
    raw = abs(np.log(ahead / plain))
    cost = 5.0 * off**2 + 200.0 * max(off - 0.08, 0.0) ** 2 + 4000.0 * max(raw - 0.2, 0.0) ** 2
    cost += 20.0 * (raw > np.log(1.25))
    bend = fans.turn[i, c] - fans.turn[j, d]
    reach = wanted.stiffness * (fans.width[i, c] + fans.width[j, d]) / 2.0
    cost += reach**2 / (ahead * wanted.stretch * plain) * bend**2
    turn = abs(fans.calm[i] - fans.calm[j] + bend) / 0.35
    cost += 0.35**2 * (200.0 * max(turn - 0.9, 0.0) ** 2 + 20_000.0 * max(turn - 0.985, 0.0) ** 2)
    cost += 20.0 * (turn > 1.0)
    for foot in (fans.feet[i, c] - fans.feet[j, d]) / plain:
        if foot <= 0.0:
            return np.inf
        cost += 60.0 * min(max(0.45 - foot, foot - 1.5, 0.0), 0.3) ** 2
        cost += 2000.0 * max(0.28 - foot, min(foot - 1.7, 0.3), 0.0) ** 2
        cost += 400.0 * max(np.log(foot / 2.0), 0.0) ** 3
        cost += 20.0 * (foot < 0.25 or foot > 1.75)
    return float(cost)


def at_end(away: float, gap: float) -> float:
    """Cost of a first or last stroke."""
    off = np.log(away / gap) if away > 0.0 else np.inf
    return np.inf if abs(off) >= 1.0 else 10.0 * off**2 + 4000.0 * max(off - 0.35, 0.0) ** 2


def plain_cost(fans: Fans, fixed: tuple[int, int], wanted: Wanted) -> float:
    """Least cost of all sequences, without any short cut."""
    n, m = fans.turn.shape
    cost = np.full((n, m, wanted.period), np.inf)
    best = np.inf
    for i in range(n):
        for c in range(m):
            own, asked = fans.cost[i, c], wanted.offset * wanted.stretch * fans.gap[i, c]
            if not fixed[0]:
                cost[i, c, 0] = own + at_end(fans.tau[i], asked)
            elif i == 0:
                cost[i, c, 0] = own
            for j in range(i):
                for d in range(m):
                    step = own + cost_of(fans, j, d, i, c, wanted)
                    for r in range(wanted.period):
                        after = (r + 1) % wanted.period
                        cost[i, c, after] = min(cost[i, c, after], cost[j, d, r] + step)
            if not fixed[1]:
                best = min(best, cost[i, c, wanted.rest] + at_end(TOTAL - fans.tau[i], asked))
            elif i == n - 1:
                best = min(best, cost[i, c, wanted.rest])
    return float(best)


def cost_of_way(fans: Fans, way: Ints, fixed: tuple[int, int], wanted: Wanted) -> float:
    """Cost of a sequence."""
    m = fans.turn.shape[1]
    chords = [(int(at) // m, int(at) % m) for at in way]
    total = sum(fans.cost[i, c] for i, c in chords)
    for (j, d), (i, c) in itertools.pairwise(chords):
        total += cost_of(fans, j, d, i, c, wanted)
    for end, (i, c) in enumerate((chords[0], chords[-1])):
        if not fixed[end]:
            away = TOTAL - fans.tau[i] if end else fans.tau[i]
            total += at_end(away, wanted.offset * wanted.stretch * fans.gap[i, c])
    return float(total)


@given(
    seed=st.integers(0, 10_000),
    n=st.integers(1, 14),
    m=st.sampled_from([1, 3, 5]),
    fixed=st.tuples(st.integers(0, 1), st.integers(0, 1)),
    stretch=st.sampled_from([0.95, 1.0, 1.1]),
)
@settings(max_examples=80)
def test_no_sequence_is_cheaper(
    seed: int, n: int, m: int, fixed: tuple[int, int], stretch: float
) -> None:
    fans, wanted = random_fans(seed, n, m), Wanted(1.0, stretch, 0.9, 1, 0)
    way, cost = cheapest_way(fans, fixed, wanted, ENDS, OPEN, np.inf)
    expected = plain_cost(fans, fixed, wanted)
    assert cost == pytest.approx(expected)
    assert way.size or np.isinf(expected)
    if way.size:
        assert cost_of_way(fans, way, fixed, wanted) == pytest.approx(cost)


@given(seed=st.integers(0, 10_000), period=st.integers(2, 3), rest=st.integers(0, 1))
@settings(max_examples=40)
def test_counts_are_whole_patterns(seed: int, period: int, rest: int) -> None:
    fans, wanted = random_fans(seed, 12, 3), Wanted(1.0, 1.0, 0.9, period, rest)
    way, cost = cheapest_way(fans, (1, 1), wanted, ENDS, OPEN, np.inf)
    assert cost == pytest.approx(plain_cost(fans, (1, 1), wanted))
    assert not way.size or (way.size - 1) % period == rest


@given(seed=st.integers(0, 10_000), share=st.sampled_from([0.5, 0.999, 1.001, 2.0]))
@settings(max_examples=40)
def test_what_others_may_cost_changes_no_choice(seed: int, share: float) -> None:
    fans, wanted = random_fans(seed, 12, 3), Wanted(1.0, 1.0, 0.9, 1, 0)
    way, cost = cheapest_way(fans, (0, 0), wanted, ENDS, OPEN, np.inf)
    again, _ = cheapest_way(fans, (0, 0), wanted, ENDS, OPEN, share * cost)
    assert again.tolist() == (way.tolist() if share > 1.0 else [])
