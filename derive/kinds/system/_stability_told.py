"""What is said of an answer about stability, in phrases."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.readable.form import readable
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import coefficients, known_sign
from derive.control.hurwitz import is_impossible, written
from derive.control.rational import written as collected
from derive.control.roots import roots
from derive.derivation import Phrase
from derive.expression import ZERO, Expr, Relation, Symbol, number
from derive.kinds.system._pairs import root_tree, rounded
from derive.kinds.system._plant import verdict
from derive.kinds.system._stability_answer import Answer
from derive.kinds.system._stability_facts import NEVER, Facts, StabilityAtPoint
from derive.kinds.system._stability_limit import (
    frequency_squared,
    is_marginal,
    limiting,
    necessary,
    of_one_sign,
    possible,
)
from derive.names import free

S = Symbol("s")
CALLED = {
    "stable": "is-stable", "unstable": "is-unstable",
    "integrator": "is-marginal", "oscillator": "is-marginal",
}  # fmt: skip


def facts_of(answer: Answer, closed: bool, at: StabilityAtPoint | None) -> Facts:
    """What the words read."""
    array, solved = answer.array, answer.plant
    motor = "motor" if solved.system.motor else "system"
    what = Phrase("loop" if closed else motor)
    never = is_impossible(answer.conditions, answer.positive)
    assumed = answer.positive & set(answer.symbols)
    needed = Phrase("needed-beside" if assumed else "needed") if answer.symbols and answer.written else None
    return Facts(
        criterion=_criterion(answer, what),
        factor=None if answer.factor.constant is not None else readable(answer.factor, solved.style),
        coefficients=Phrase(necessary(answer)),
        array=array.table if len(array.rows) > 2 else None,
        second=_second(answer),
        concluded=tuple(_concluded(answer, what)),
        needed=None if never else needed,
        conditions=() if never or not answer.symbols else in_one(answer),
        one_sign=_one_sign(answer) if not never else None,
        limit=_limit(answer),
        critical=_critical(answer),
        at=at and replace(at, verdict=at.verdict and replace(at.verdict, about={"what": what})),
        numbers=(),
    )


def small_of(answer: Answer) -> Symbol | None:
    return Symbol(answer.array.epsilon) if "epsilon" in answer.array.mended else None


def _second(answer: Answer) -> Phrase | None:
    """That the second row begins with a zero; the others are found with their entries."""
    row = answer.array.rows[1]
    return Phrase("second-row", {"epsilon": small_of(answer) or ZERO}) if row.origin == "epsilon" else None


def _criterion(answer: Answer, what: Phrase) -> Phrase:
    """When it is stable, and of which polynomial."""
    if len(answer.hidden) > 1:
        hidden = collected(answer.hidden, answer.plant.style)
        return Phrase("criterion-hidden", {"what": what, "hidden": hidden})
    return Phrase("criterion", {"what": what})


def _one_sign(answer: Answer) -> Phrase | None:
    found = of_one_sign(answer)
    return Phrase("one-sign", {"coefficients": found}) if found and answer.written else None


def _concluded(answer: Answer, what: Phrase) -> Iterator[Phrase]:
    """What the first column says: with symbols when it is stable, else how many roots lie where."""
    if not answer.symbols:
        yield from _roots_told(answer, what)
    elif is_impossible(answer.conditions, answer.positive):
        yield Phrase(NEVER[next(iter(answer.array.mended), "")], {"what": what})
        if is_marginal(answer):
            where = written_of(answer, possible(answer))
            yield (
                Phrase("marginal-where", {"conditions": where})
                if where
                else Phrase("marginal", {"conditions": ()})
            )
    elif not answer.written:
        yield Phrase("always", {"what": what, "column": _column(answer)})
    elif len(answer.array.rows) > 2:
        yield Phrase("left-where")


def _column(answer: Answer) -> tuple[Expr, ...]:
    return tuple(answer.array.value(i, 1) for i in range(1, len(answer.array.rows) + 1))


def _roots_told(answer: Answer, what: Phrase) -> Iterator[Phrase]:
    """How often the first column changes its sign, and what that means."""
    found, array, count = roots(answer.array.polynomial), answer.array, answer.changes
    if len(array.rows) > 2:
        key = {0: "no-change", 1: "one-change", 2: "two-changes"}.get(count, "changes")
        yield Phrase(key, {"column": _column(answer), "count": count})
        if "epsilon" in array.mended:
            yield Phrase("small-is-positive")
        if on_axis := tuple(dict.fromkeys(root_tree(z) for z in found if z.real == 0)):
            yield Phrase("on-the-axis", {"roots": on_axis})
    verdict_ = verdict(array.polynomial)
    again = verdict_ == "unstable" and not count
    yield Phrase("unstable-by-a-repeated-root" if again else CALLED[verdict_], {"what": what})


def _limit(answer: Answer) -> Phrase | None:
    """Where it is only just stable."""
    relation = _written_limit(answer)
    if relation is None:
        return None
    several = len(in_one(answer)) > 1
    equation = Relation(relation.left, "=", relation.right)
    return Phrase(
        "limit-while" if several else "limit-alone", {"equation": equation, "s": S, "square": S ** number(2)}
    )


def in_one(answer: Answer) -> tuple[Relation, ...]:
    """Two bounds of one name as a person writes them, 0 < K < 5; other conditions as they are."""
    match answer.written:
        case (Relation(Symbol() as name, ">", low), Relation(also, "<", high)) if name == also:
            if known_sign(normal(high) - normal(low), answer.positive) == 1:
                return (Relation(Relation(low, "<", name), "<", high),)
    return answer.written


def written_of(answer: Answer, found: Iterable[Scalar]) -> tuple[Relation, ...]:
    return tuple(written(each, answer.plant.style) for each in found)


def _written_limit(answer: Answer) -> Relation | None:
    found = limiting(answer)
    if found is None or frequency_squared(answer) is None:
        return None
    return written(found, answer.plant.style)


def _critical(answer: Answer) -> tuple[tuple[Expr, ...], ...] | None:
    """(K = its value at the limit, omega there) where only one symbol is open."""
    limit, square = limiting(answer), frequency_squared(answer)
    if limit is None or square is None or len(answer.symbols) != 1:
        return None
    (name,) = answer.symbols
    found = coefficients(limit, name)
    if len(found) != 2:
        return None
    value = -found[0] / found[1]
    others = (each for each in answer.conditions if each is not limit)
    if not all(known_sign(each.substitute({name: value})) == 1 for each in others):
        return None
    at = square.substitute({name: value})
    if known_sign(at) != 1:
        return None
    exact = readable(root(at), answer.plant.style)
    size = scalar_number(root(at), {})
    omega: tuple[Expr, ...] = (omega_of(answer), exact)
    omega = omega if root(at).constant is not None else (*omega, rounded(size))
    return (Symbol(name), readable(value, answer.plant.style)), omega


def omega_of(answer: Answer) -> Symbol:
    """What the frequency at the limit is called."""
    return Symbol(free(answer.symbols, "omega_0", "omega_n", "w_0"))
