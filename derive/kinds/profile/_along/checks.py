"""The fastest motion along a path held to its limits by differences over time, and to a second search that
halves what is left at each of other steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.arrays import arrays
from derive.expression import Expr, Symbol
from derive.kinds.chain_rule import chain_rule
from derive.kinds.checks import close
from derive.kinds.fields import TREES
from derive.kinds.meanings import column_of, farthest
from derive.kinds.profile._along.fastest import STEPS
from derive.kinds.profile._along.told import Along, limits_told
from derive.kinds.profile._shapes import TIME

if TYPE_CHECKING:
    from numpy.typing import NDArray

OTHERS, HALVINGS = 240, 70  # steps of the second search
SHARES = (0.17, 0.46, 0.83)
H, WITHIN = 1e-4, 0.37  # of a time, and of a spell: not where it turns from faster to slower
PRESSED, NEARLY = 13, 0.9  # every which step is looked at; others lie between two limits
SURE, SEARCHED, OVER = 1e-5, 5e-3, 2e-2


def place(given: Along, s: float) -> NDArray[Any]:
    """Where the axes are, by what was typed."""
    import numpy as np

    at = {**given.point, given.path.parameter: s}
    return np.array([arrays(tree, at) for tree in given.path.places])


def limits(given: Along) -> tuple[NDArray[Any], NDArray[Any]]:
    """Of velocities, without end where there is none, and accelerations, by what was typed."""
    import numpy as np

    v_max = [arrays(each, given.point) for each in given.path.v_max] or [np.inf] * len(given.path.places)
    return np.array(v_max), np.array([arrays(each, given.point) for each in given.path.a_max])


def slopes(given: Along, s: float, h: float) -> tuple[NDArray[Any], NDArray[Any]]:
    """The first and the second derivative, by five points."""
    a, b, c, d, e = (place(given, s + k * h) for k in (-2, -1, 0, 1, 2))
    return (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)


def lines(given: Along) -> Iterator[bool]:
    """The derivatives, the chain rule along a motion that is made up, and the time."""
    low, high = float(given.found.s[0]), float(given.found.s[-1])
    yield close([low, high], [arrays(end, given.point) for end in given.path.between])
    s, s_dot, s_ddot = given.rates
    h = 1e-3 * (high - low)
    chains = {step.name: step.chain for step in given.steps}
    for share in SHARES:
        here = low + share * (high - low)
        first, second = slopes(given, here, h)
        rate, change = 0.7 * (high - low), -0.4 * (high - low)
        a, b, c = (place(given, here + rate * t + change * t * t / 2) for t in (-H, 0.0, H))
        q = given.names[0].name
        names: dict[Expr, Any] = {Symbol(name): value for name, value in given.point.items()}
        names |= dict(zip(given.names, map(column_of, (place(given, here), first, second)), strict=True))
        names |= {s: here, s_dot: rate, s_ddot: change, TIME: given.time}
        names |= {Symbol(f"{q}_dot"): column_of((c - a) / (2 * H))}
        names |= {Symbol(f"{q}_ddot"): column_of((a - 2 * b + c) / H**2)}
        yield farthest(list(chains.values()), names) < 1e-4
    laws = [step.result for step in given.steps if step.name in given.told.rates]
    yield from chain_rule(laws, given.names[1:], given.rates)


def kept(given: Along) -> Iterator[bool]:
    """By differences of the places over time no limit is exceeded, and nearly always one is reached."""
    import numpy as np

    t, s, b = given.found.t, given.found.s, given.found.b
    v_max, a_max = limits(given)
    reached = 0
    times = np.linspace(0.01, 0.99, 99) * t[-1]
    for moment in times:
        k = int(np.searchsorted(t, moment)) - 1
        u = float(b[k + 1] - b[k]) / (2 * float(s[k + 1] - s[k]))
        rate = float(b[k]) ** 0.5

        def there(by: float, k: int = k, u: float = u, rate: float = rate) -> NDArray[Any]:
            return place(given, float(s[k]) + rate * by + u * by * by / 2)

        before, now, after = (there(by * H) for by in (-1, 0, 1))
        fast = abs(after - before) / (2 * H) / v_max
        strong = abs(after - 2 * now + before) / H**2 / a_max
        yield bool(max(fast.max(), strong.max()) <= 1 + OVER)
        reached += bool(max(fast.max(), strong.max()) >= 1 - OVER)
    yield reached >= 0.9 * len(times)


def pressed(given: Along) -> Iterator[bool]:
    """At one end or the other of nearly every step a limit is reached, and none is exceeded."""
    t, s, b = given.found.t, given.found.s, given.found.b
    v_max, a_max = limits(given)
    h = 1e-3 * float(s[-1] - s[0])
    chosen = range(PRESSED // 2, len(s) - 1, PRESSED)
    reached = 0
    for k in chosen:
        u = float(b[k + 1] - b[k]) / (2 * float(s[k + 1] - s[k]))
        yield close(float(t[k + 1] - t[k]) * float(b[k] ** 0.5 + b[k + 1] ** 0.5) / 2, float(s[k + 1] - s[k]))
        ends = [(slopes(given, float(s[i]), h), float(b[i])) for i in (k, k + 1)]
        shares = [
            max((abs(x) * c**0.5 / v_max).max(), (abs(x * u + y * c) / a_max).max()) for (x, y), c in ends
        ]
        yield max(shares) <= 1 + SURE
        reached += max(shares) >= 1 - SURE
    yield reached >= NEARLY * len(chosen)


def no_shorter(given: Along) -> Iterator[bool]:
    """The time against a search by halving, with limits in the middle of other steps."""
    once, twice = (_searched(given, steps) for steps in (OTHERS, 2 * OTHERS))
    least = 2 * twice - once  # what is left is of the order of a step
    yield abs(least - given.time) <= SEARCHED * given.time
    yield abs(float(given.found.t[-1]) - given.time) <= SEARCHED * given.time


def _searched(given: Along, steps: int) -> float:
    import numpy as np

    low, high = float(given.found.s[0]), float(given.found.s[-1])
    step = (high - low) / steps
    v_max, a_max = limits(given)
    middles = [slopes(given, low + (k + 0.5) * step, 1e-3 * (high - low)) for k in range(steps)]
    tops = []
    for k in range(steps + 1):
        first, second = slopes(given, low + k * step, 1e-3 * (high - low))
        tops.append(_top(first, second, v_max, a_max))
    back = [0.0] * (steps + 1)
    for k in range(steps - 1, -1, -1):
        back[k] = _halved(partial(_onward, middles[k], a_max, step, back[k + 1]), tops[k])
    b = [0.0] * (steps + 1)
    for k in range(steps):
        onward = _onward(middles[k], a_max, step, back[k + 1], b[k])
        b[k + 1] = 0.0 if onward is None else onward
    rates = np.sqrt(np.array(b))
    return float((2 * step / (rates[1:] + rates[:-1])).sum())


def _top(first: Any, second: Any, v_max: Any, a_max: Any) -> float:
    """The greatest b by velocities, and by what accelerations of axes that just turn allow."""
    bounds = [(v / abs(x)) ** 2 for v, x in zip(v_max, first, strict=True) if abs(x) > 1e-9]
    size = max(map(abs, first))
    still = [abs(x) < 1e-9 * size and abs(y) > 1e-9 for x, y in zip(first, second, strict=True)]
    bounds += [a / abs(y) for a, y, only in zip(a_max, second, still, strict=True) if only]
    return float(min([*bounds, 1e12]))


def _onward(middle: tuple[Any, Any], a_max: Any, step: float, most: float, b: float) -> float | None:
    """The greatest b after a step, at most as much; None where there is none."""
    least = 0.0
    for x, y, a in zip(*middle, a_max, strict=True):
        after, before = x / (2 * step) + y / 2, y / 2 - x / (2 * step)
        if abs(after) < 1e-12:
            if abs(before * b) > a:
                return None
            continue
        ends = sorted(((-a - before * b) / after, (a - before * b) / after))
        least, most = max(least, ends[0]), min(most, ends[1])
    return most if least <= most else None


def _halved(onward: Callable[[float], float | None], top: float) -> float:
    """The greatest from which there is a way on."""
    if onward(top) is not None:
        return top
    low, high = 0.0, top
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if onward(middle) is not None else (low, middle)
    return low


def as_tabled(given: Along) -> Iterator[bool]:
    """Within each spell the limits that are told are reached, by differences over time."""
    import numpy as np

    table = given.told.table
    rows = () if table is None else table.rows
    yield table is None or (given.told.binding.key == "binding-in-turn")
    t, s, b = given.found.t, given.found.s, given.found.b
    v_max, a_max = limits(given)
    before = 0.0
    for start_cell, end_cell, told in rows:
        start, end = (arrays(cell, {}) for cell in (start_cell, end_cell) if isinstance(cell, TREES))
        yield start == before
        before = end
        k = int(np.searchsorted(t, start + WITHIN * (end - start))) - 1
        u = float(b[k + 1] - b[k]) / (2 * float(s[k + 1] - s[k]))
        first, second = slopes(given, float(s[k]), 1e-3 * float(s[-1] - s[0]))
        fast, strong = abs(first) * float(b[k]) ** 0.5 / v_max, abs(first * u + second * b[k]) / a_max
        found = {("velocity", i) for i, x in enumerate(fast, 1) if x > 1 - OVER}
        found |= {("acceleration", i) for i, x in enumerate(strong, 1) if x > 1 - OVER}
        yield told in {limits_told(frozenset(each)) for n in (1, 2, 3) for each in combinations(found, n)}
    yield not rows or abs(before - float(t[-1])) < SURE * before


def said(given: Along) -> Iterator[bool]:
    """The sentences are about the rates, and as many steps as were made."""
    s, s_dot, s_ddot = given.rates
    told = given.told
    yield told.bounded.about == {"rate": s_dot, "change": s_ddot, "square": s_dot**2}
    yield told.searched.about == {"square": s_dot**2, "s": s, "count": STEPS}
    yield len(given.found.s) == STEPS + 1
