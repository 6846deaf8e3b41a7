"""Where the rule of a sub-problem breaks, as the page says: what must not vanish are the coefficients of the
unknown in the equations, and a value is real exactly where the condition beside it holds."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.compiled import Compiled, compiled
from derive.expression import ONE, Expr, Relation, Symbol, free_symbols, replace
from derive.kinds.checks import close
from derive.kinds.robot._inverse.subproblem import Item, Solved, defined
from derive.kinds.robot._inverse.target import Values

SAME = 1e-7
DRAWN, LEAST = 40, 6  # points drawn, and those that have to count
SPREAD = 2.0
AWAY = 0.37  # by which a joint is moved
Swing = tuple[float, float]  # a and b of a cos q + b sin q, or of b d alone


def determined(solved: Solved, known: Values, rates: Values) -> Iterator[bool]:
    """Whether what must not vanish, for the unknown to be determined, stands before it in its equations at a
    solution; `rates` are those of the joints as the unknown moves."""
    method = solved.facts.method
    told = [abs(arrays(each.left, known)) for each in method.unless if not isinstance(each.left, Relation)]
    swings = list(_swings(solved, known, rates))
    if method.factor is not None and method.name != "zero":
        told.append(abs(arrays(method.factor, known)))
    if not told:
        return
    sizes = [math.hypot(*swing) for swing in swings]
    match method.name:
        case "direction" | "slide" | "quadratic":
            yield all(any(close(each, size, SAME) for size in sizes) for each in told)
        case "determinant":
            (a, b), (c, d) = swings
            yield all(close(each, abs(a * d - b * c), SAME) for each in told)
        case _:
            yield all(close(math.hypot(*told), size, SAME) for size in sizes)


def turned(solved: Solved, known: Values) -> Iterator[bool]:
    """Whether the vector that is said to be turned by the unknown comes to the known sides."""
    if vector := solved.facts.method.vector:
        (x, y), q = (arrays(each, known) for each in vector), arrays(solved.head, known)
        there = [x * math.cos(q) - y * math.sin(q), y * math.cos(q) + x * math.sin(q)]
        yield close([arrays(left, known) for left, _ in solved.equations], there, SAME)


def sided(solved: Solved, known: Values, choice: int) -> Iterator[bool]:
    """Whether what is said to be positive for the first of two values, and negative for the other, is so."""
    if solved.facts.positive is not None:
        yield (arrays(solved.facts.positive, known) > 0) == (choice == 0)
    if solved.facts.negative is not None:
        yield (arrays(solved.facts.negative, known) < 0) == (choice == 0)


def signed(solved: Solved, known: Values, choice: int) -> Iterator[bool]:
    """Whether the factor whose sign decides between two lines is positive where the first is taken."""
    factor = solved.facts.method.factor
    if factor is not None and len(solved.facts.choices) > 1:
        yield (arrays(factor, known) > 0) == (choice == 0)


def real(solved: Solved, before: Sequence[Solved] = ()) -> Iterator[bool]:
    """At values of its names drawn at random: whether the unknown is real just where the page says so. A
    length found before of which that says nothing has the value it was given."""
    conditions = list(_conditions(solved))
    if not conditions:
        return
    told = frozenset[str]().union(*map(free_symbols, conditions))
    found = {each.unknown: each.choices[0].value for each in before if isinstance(each.unknown, str)}
    lengths: dict[Expr, Expr] = {Symbol(name): length for name, length in found.items() if name not in told}
    value = replace(solved.choices[0].value, lengths)
    names = sorted(free_symbols(value).union(*map(free_symbols, conditions)) - {"pi"})
    draw = random.Random(" ".join(names))
    formula, margins = compiled(value), list(map(compiled, conditions))
    met = 0
    for _ in range(DRAWN):
        at = {name: draw.uniform(-SPREAD, SPREAD) for name in names}
        try:
            holds = all(margin(at) > 0 for margin in margins)
        except (ValueError, ZeroDivisionError):
            continue
        met += 1
        yield holds == _is_real(formula, at)
    if met < LEAST:
        yield False


def decided(solved: Solved, items: Sequence[Item], known: Values, joints: Sequence[str]) -> Iterator[bool]:
    """Whether a value is real changes, the pose being the same, with no joints but those that are said to
    decide it, and with one of these."""
    conditions = [compiled(each) for each in _conditions(solved)]
    if not conditions:
        return

    def margins(at: Values) -> list[float]:
        there = defined(items, at)
        return [margin(there) for margin in conditions]

    here, told = margins(known), {each.name for each in solved.facts.resting}
    changing = {
        name for name in joints if not close(margins({**known, name: known[name] + AWAY}), here, SAME)
    }
    yield changing <= told
    yield bool(changing) == bool(told)


def _is_real(formula: Compiled, at: Values) -> bool:
    try:
        formula(at)
    except ValueError:
        return False
    return True


def _conditions(solved: Solved) -> Iterator[Expr]:
    """What has to be positive."""
    method = solved.facts.method
    if method.exists is not None and not method.by_length:
        own = {key: value for key, value in solved.trig.get(1, {}).items() if key == method.exists}
        bounded = replace(method.exists, own)
        yield ONE - bounded
        yield ONE + bounded
    if method.bound is not None and not isinstance(method.bound.left, Relation):
        yield method.bound.left - method.bound.right


def _swings(solved: Solved, known: Values, rates: Values) -> Iterator[Swing]:
    """The coefficients of the unknown in each equation, by moving it."""

    def at(by: float) -> Values:
        return {**known, **{name: known[name] + by * rate for name, rate in rates.items()}}

    for left, right in solved.equations:
        if isinstance(solved.unknown, str):
            yield 0.0, _gap(left, right, at(1.0)) - _gap(left, right, known)
            continue
        turned = arrays(solved.head, known)
        zero, quarter, half = (_gap(left, right, at(q - turned)) for q in (0.0, math.pi / 2, math.pi))
        yield (zero - half) / 2, quarter - (zero + half) / 2


def _gap(left: Expr, right: Expr, at: Values) -> float:
    return float(arrays(left, at) - arrays(right, at))
