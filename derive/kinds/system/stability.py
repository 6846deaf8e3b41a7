"""For which values a system, or its loop, is stable: by the array of Routh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from derive.algebra.kernels import root
from derive.algebra.normal import normal
from derive.algebra.numeric import number as value_of
from derive.algebra.numeric import scalar_number
from derive.algebra.operations import operations
from derive.algebra.polynomials import coefficients, known_sign, numerator
from derive.algebra.readable import readable
from derive.algebra.scalar import Scalar
from derive.algebra.text import text
from derive.control.axis import points, roots_at
from derive.control.controllers import Controller
from derive.control.hidden import hidden
from derive.control.hurwitz import Condition, conditions, is_never, written
from derive.control.rational import Polynomial, Rational, shared, times
from derive.control.rational import written as collected
from derive.control.roots import roots
from derive.control.routh import remainder, routh, sign_changes
from derive.control.system import System
from derive.derivation import Claim, Derivation, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    Expr,
    Product,
    Quotient,
    Sum,
    Symbol,
    add,
    free_symbols,
    multiply,
    number,
    squared,
    walk,
)
from derive.kinds.checks import SECOND_ROUTE, law, links
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._options import ControllerField
from derive.kinds.system._plant import (
    Plant,
    asked,
    plant,
    point_chains,
    poles_json,
    root_tree,
    rounded,
    verdict,
)
from derive.kinds.system._routh_steps import LONG, Array, entry_steps
from derive.kinds.system.closed_loop import closed

RESULTS = {
    "routh": "the array of Routh, a row for each power of s from the highest",
    "conditions": "what must hold for stability; none for a system that is stable anyway",
    "unstable_poles": "how many poles lie right of the imaginary axis (where there are no symbols)",
}
EXAMPLE = """\
title: The gain at which a loop begins to swing
symbols: {K_p: positive}
problems:
- system:
    equations: ["s*(s + 1)*(s + 5)*Y = U"]
    input: U
    output: Y
  find: stability
  controller: P
"""
MOST_SYMBOLIC, MOST = 8, 24  # degrees that are looked at, with symbols and without
POINTS = 40


class Options(OptionsModel):
    """With a controller the loop is closed, without one the system itself is looked at."""

    controller: ControllerField | None = None
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Answer:
    """`whole` is the characteristic polynomial as it is found, `final` with `where` replaced; the array is
    that of `final` without `factor`, which has no s in it."""

    plant: Plant
    base: Derivation
    found: tuple[Expr, ...]  # how the characteristic polynomial comes about
    hidden: Polynomial  # its factor that the transfer function does not show
    whole: Polynomial
    final: Polynomial
    factor: Scalar
    array: Array
    conditions: tuple[Scalar, ...]
    positive: frozenset[str]

    @property
    def symbols(self) -> list[str]:
        return sorted({name for k in self.array.polynomial if k for name in k.generators()} - {"pi"})

    @property
    def written(self) -> tuple[Condition, ...]:
        return tuple(written(each, self.plant.style) for each in self.conditions)

    @property
    def changes(self) -> int:
        """Sign changes of a first column in numbers."""
        return sign_changes([scalar_number(entry, {}) for entry in self.array.column])


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """Routh and Hurwitz (Dorf and Bishop, Modern Control Systems, sections 6.2 and 6.3)."""
    answer = _answer(options, problem)
    steps = tuple(_steps(answer))
    definitions = _definitions(answer)
    claims = (*links(steps, {**problem.names, **definitions}), *_claims(answer))
    results: dict[str, Result] = {
        "routh": answer.array.matrix,
        "conditions": tuple(f"{text(c.left)} {c.sign} {text(c.right)}" for c in answer.written),
    }
    if not answer.symbols:
        results["unstable_poles"] = number(answer.changes)
    evaluated, numbers = _evaluated(answer, options)
    return Derivation(
        "stability", steps, results, claims, definitions, evaluated, uses=(answer.base,),
        facts={**_facts(answer, options), **numbers, "numbers": ()}, matrices=frozenset({"routh"}),
    )  # fmt: skip


# -- what is looked at --------------------------------------------------------------------------------


def _answer(options: Options, problem: Problem) -> Answer:
    """Raises NotDerivable where there are no poles, or too many."""
    base, solved, found, shown, beside = _characteristic(options, problem)
    whole = times(beside, shown)
    if len(beside) > 1:
        found = (Product((collected(beside, solved.style), collected(shown, solved.style))),)
    final = Rational((), whole).at(problem.names).den
    if len(final) < 2:
        raise NotDerivable("there are no poles, for the denominator has no s in it: nothing can be unstable")
    factor = shared(final) if any(k.constant is None for k in final if k) else Scalar.of(1)
    polynomial = tuple(k / factor for k in final)
    names = {name for k in polynomial if k for name in k.generators()}
    most = MOST_SYMBOLIC if names else MOST
    if len(polynomial) - 1 > most:
        raise NotDerivable(f"the array is filled in up to degree {most}; this one has {len(polynomial) - 1}")
    positive = frozenset(name for name, what in problem.assumptions.items() if what == "positive")
    array = _array(polynomial, solved, options)
    column = [*array.column, *([Scalar.of(0)] if array.mended else [])]
    needed = conditions(column, positive)
    answer = Answer(solved, base, found, beside, whole, final, factor, array, needed, positive)
    if not names and "epsilon" in array.mended and answer.changes != _right(roots(polynomial)):
        raise NotDerivable(
            "a zero in the first column hides roots that lie symmetric to the origin; divide them out first, "
            "for the method of the small number does not count these"
        )
    return answer


def _characteristic(
    options: Options, problem: Problem
) -> tuple[Derivation, Plant, tuple[Expr, ...], Polynomial, Polynomial]:
    """The derivation this rests on, the plant, how the polynomial comes about, the denominator of the
    transfer function with everything in it, and what the equations have besides."""
    if options.controller is None:
        solved = plant(problem, None, options.evaluate)
        beside = hidden(solved.system, solved.rational.den, solved.decimals)
        return asked(problem, "transfer-function", source=None), solved, (), solved.rational.den, beside
    loop = closed(problem, options.controller, options.evaluate)
    solved = loop.plant
    C, G = loop.loop.controller, loop.loop.plant
    parts = [(C.den, G.den), (C.num, G.num)]
    products = [multiply(*(collected(side, solved.style) for side in pair)) for pair in parts]
    terms = (term for each in products for term in (each.terms if isinstance(each, Sum) else (each,)))
    base = asked(problem, "closed-loop", controller=options.controller)
    beside = hidden(solved.system, G.den, solved.decimals)
    return base, solved, (add(*terms),), loop.transfer.den, beside


def _array(polynomial: Polynomial, solved: Plant, options: Options) -> Array:
    sides = [side for equation in solved.system.equations for side in (equation.left, equation.right)]
    sides += [*solved.problem.where.values(), *(options.controller.gains if options.controller else ())]
    taken = frozenset[str]().union(*map(free_symbols, sides)) | set(solved.problem.where)
    epsilon = _free(("epsilon", "delta", "eta"), taken)
    letter = _free_letter(("r", "q", "w"), taken)
    auxiliary = _free_letter(("A", "P", "Q"), taken)
    return Array(polynomial, routh(polynomial, epsilon), solved.style, letter, epsilon, auxiliary)


def _free(names: tuple[str, ...], taken: frozenset[str]) -> str:
    return next((name for name in names if name not in taken), names[0] + "_0")


def _free_letter(letters: tuple[str, ...], taken: frozenset[str]) -> str:
    """One that no name with an index begins with."""
    return _free(letters, frozenset(name[0] for name in taken if name[1:].strip("_").isdigit()))


# -- the page -----------------------------------------------------------------------------------------


def _delta(answer: Answer) -> Symbol:
    return answer.plant.named("Delta")


def _steps(answer: Answer) -> Iterator[Step]:
    style = answer.plant.style
    whole = collected(answer.whole, style)
    found = tuple(each for each in answer.found if each != whole)
    yield Step("characteristic", (_delta(answer), *found, whole), "denominator")
    if any(node in answer.plant.problem.names for node in walk(whole)):
        yield Step("values", (_delta(answer), collected(answer.final, style)), "substitute")
    yield from entry_steps(answer.array)
    yield from _limit_steps(answer)


def _definitions(answer: Answer) -> dict[Expr, Expr]:
    found = {_delta(answer): collected(answer.final, answer.plant.style), **answer.array.definitions}
    if (square := _frequency_squared(answer)) is not None:
        found[_omega(answer)] = readable(root(square), answer.plant.style)
    return found


def _omega(answer: Answer) -> Symbol:
    taken = frozenset(answer.symbols)
    return Symbol(_free(("omega_0", "omega_n", "w_0"), taken))


def _limit_steps(answer: Answer) -> Iterator[Step]:
    """The frequency of the motion that is left where the row of s vanishes."""
    square, array = _frequency_squared(answer), answer.array
    if square is None:
        return
    row = len(array.rows) - 2
    value = readable(square, answer.plant.style)
    chain: tuple[Expr, ...] = (squared(_omega(answer)), Quotient(array.name(row, 2), array.name(row, 1)))
    yield Step("limit", (*chain, value) if value not in chain and _short(value) else chain, "limit")


def _frequency_squared(answer: Answer) -> Scalar | None:
    """r_2 / r_1 of the row of s^2; None where the row of s cannot be made to vanish."""
    if len(answer.array.rows) < 3 or answer.array.mended or not _limiting(answer):
        return None
    first, second = answer.array.rows[-3].entries[:2]
    return second / first if second else None


def _limiting(answer: Answer) -> Scalar | None:
    """The condition that the row of s brings in; None where it follows from the others."""
    entry = numerator(answer.array.rows[-2].entries[0])
    if known_sign(entry, answer.positive) is not None:
        return None
    for each in answer.conditions:
        if not is_never(each) and (each / entry).constant is not None:
            return each
    return None


def _short(value: Expr) -> bool:
    return operations(value) <= LONG


def _facts(answer: Answer, options: Options) -> dict[str, Any]:
    array, solved = answer.array, answer.plant
    degree = len(array.rows) - 1
    never = any(is_never(each) for each in answer.conditions)
    return {
        "closed": options.controller is not None,
        "motor": solved.system.motor,
        "hidden": collected(answer.hidden, solved.style) if len(answer.hidden) > 1 else None,
        "degree": degree,
        "factor": None if answer.factor.constant is not None else readable(answer.factor, solved.style),
        "coefficients": _coefficients(answer),
        "array": array.table if degree > 1 else None,
        "letter": array.letter,
        "column": tuple(array.value(i, 1) for i in range(1, degree + 2)),
        "mended": array.mended,
        "epsilon": Symbol(array.epsilon),
        "never": never,
        "conditions": answer.written,
        "marginal": _possible(answer) if _marginal(answer) else None,
        "one_sign": _of_one_sign(answer),
        "assumed": bool(answer.positive & set(answer.symbols)),
        "origin": number(0),
        "symbolic": bool(answer.symbols),
        "limiting": _written_limit(answer),
        "critical": _critical(answer),
        **_numeric_facts(answer),
    }


def _marginal(answer: Answer) -> bool:
    """Whether only a row of zeros stands against stability."""
    never = [each for each in answer.conditions if is_never(each)]
    return answer.array.mended == ("derivative",) and not any(never)


def _possible(answer: Answer) -> tuple[Condition, ...]:
    """The conditions that can hold."""
    return tuple(written(each, answer.plant.style) for each in answer.conditions if not is_never(each))


def _of_one_sign(answer: Answer) -> tuple[Expr, ...]:
    """The coefficients, where the conditions say no more than that they have one sign, whichever."""
    lead, *rest = answer.array.polynomial
    if (
        len(rest) > 2
        or any(k.constant is not None for k in rest)
        or known_sign(lead, answer.positive) is not None
    ):
        return ()
    return tuple(readable(k, answer.plant.style) for k in answer.array.polynomial)


def _coefficients(answer: Answer) -> str:
    """Whether all coefficients are there and of one sign: "met", "violated" or "open"."""
    lead, *rest = (known_sign(k, answer.positive) if k else 0 for k in answer.array.polynomial)
    if 0 in rest or (lead is not None and -lead in rest):
        return "violated"
    return "open" if lead is None or None in rest else "met"


def _numeric_facts(answer: Answer) -> dict[str, Any]:
    """What can be said of a polynomial in numbers."""
    if answer.symbols:
        return {"changes": None, "axis": (), "verdict": ""}
    found = roots(answer.array.polynomial)
    axis = tuple(dict.fromkeys(root_tree(each) for each in found if each.real == 0 and each.imag >= 0))
    return {"changes": answer.changes, "axis": axis, "verdict": verdict(found)}


def _written_limit(answer: Answer) -> Condition | None:
    limiting = _limiting(answer)
    if limiting is None or _frequency_squared(answer) is None:
        return None
    return written(limiting, answer.plant.style)


def _critical(answer: Answer) -> tuple[tuple[Expr, ...], ...] | None:
    """(K = its value at the limit, omega there) where only one symbol is open."""
    limiting, square = _limiting(answer), _frequency_squared(answer)
    if limiting is None or square is None or len(answer.symbols) != 1:
        return None
    (name,) = answer.symbols
    found = coefficients(limiting, name)
    if len(found) != 2:
        return None
    value = -found[0] / found[1]
    others = (each for each in answer.conditions if each is not limiting)
    if not all(known_sign(each.substitute({name: value})) == 1 for each in others):
        return None
    at = square.substitute({name: value})
    if known_sign(at) != 1:
        return None
    exact = readable(root(at), answer.plant.style)
    size = scalar_number(root(at), {})
    omega: tuple[Expr, ...] = (_omega(answer), exact)
    omega = omega if root(at).constant is not None else (*omega, rounded(size))
    return (Symbol(name), readable(value, answer.plant.style)), omega


# -- in numbers ---------------------------------------------------------------------------------------


def _evaluated(answer: Answer, options: Options) -> tuple[dict[str, Any], dict[str, Any]]:
    """What goes to the JSON, and what the words print."""
    if options.evaluate is None:
        return {}, {"numeric": None}
    solved = answer.plant
    numeric = solved.numeric(Rational((), answer.final))
    poles = roots(numeric.den)
    point = _point(answer)
    values: dict[str, Any] = {
        "conditions": [_holds(each, point) for each in answer.written],
        "poles": poles_json(numeric),
        "stable": verdict(poles) == "stable",
        "unstable_poles": sum(pole.real > 0 for pole in poles),
    }
    rows = _rows_at(answer, point)
    return ({"routh": rows} if rows else {}) | values, {
        "numeric": (_delta(answer), collected(numeric.den, solved.style)),
        "point": point_chains(options.evaluate, {}),
        "poles": tuple(map(root_tree, poles)),
        "at_point": verdict(poles),
        "failing": tuple(each for each in answer.written if not _holds(each, point)),
    }


def _point(answer: Answer) -> dict[str, float]:
    names = {**answer.plant.problem.names, **answer.plant.point}
    return {name: scalar_number(normal(Symbol(name), names), {}) for name in answer.symbols}


def _holds(condition: Condition, point: Mapping[str, float]) -> bool:
    return condition.holds(value_of(condition.left, point), value_of(condition.right, point))


def _rows_at(answer: Answer, point: Mapping[str, float]) -> list[list[float]] | None:
    """The array in numbers; None where it needs its special cases there."""
    try:
        rows = [[scalar_number(k, point) if k else 0.0 for k in row.entries] for row in answer.array.rows]
    except (KeyError, ZeroDivisionError):
        return None
    return rows if all(row[0] for row in rows) else None


# -- what it is held to -------------------------------------------------------------------------------


def _claims(answer: Answer) -> Iterator[Claim]:
    array = answer.array
    if "epsilon" not in array.mended:
        for i, row in enumerate(array.rows, 1):
            if row.origin == "derivative":
                left = remainder(array.polynomial, array.rows[i - 2].polynomial)
                yield law(
                    f"the polynomial of row {i - 1} divides the characteristic polynomial", not any(left)
                )
    if _frequency_squared(answer) is not None:
        yield law("where the row of s vanishes, that of s^2 divides the polynomial", _divides(answer))
    if not answer.symbols:
        right = _right(roots(array.polynomial))
        yield Claim(
            "sign changes of the first column: roots on the right", SECOND_ROUTE, answer.changes == right
        )
    yield from _at_random(answer)


def _divides(answer: Answer) -> bool:
    """The remainder after the row of s^2 holds the entry of the row of s as a factor."""
    array = answer.array
    entry = numerator(array.rows[-2].entries[0])
    return all(
        not left or _is_free(left / entry, entry)
        for left in remainder(array.polynomial, array.rows[-3].polynomial)
    )


def _is_free(value: Scalar, entry: Scalar) -> bool:
    """Whether nothing of the entry is left in the denominator."""
    if value.denominator is None:
        return True
    below = Scalar(value.ring, value.denominator)
    both = below + entry
    common = below.into(both.ring).numerator.gcd(entry.into(both.ring).numerator)
    return bool(common.is_constant())


def _at_random(answer: Answer) -> Iterator[Claim]:
    """Conditions and sign changes against the roots themselves."""
    array, stable, right, marginal = answer.array, True, True, True
    for point in points(answer.symbols, answer.positive, POINTS if answer.symbols else 1):
        found = roots_at(array.polynomial, point)
        if not found:
            continue
        lies_left = all(each.real < 0 for each in found)
        stable = stable and lies_left == all(_holds(each, point) for each in answer.written)
        on_axis = verdict(found) in ("integrator", "oscillator")
        marginal = marginal and on_axis == all(_holds(each, point) for each in _possible(answer))
        signs = _signs_at(answer, point)
        right = right and (signs is None or sign_changes(signs) == _right(found))
    yield Claim("the conditions hold exactly where all roots lie left", SECOND_ROUTE, stable)
    if answer.symbols and _marginal(answer):
        yield Claim("the others hold exactly where it is marginally stable", SECOND_ROUTE, marginal)
    if answer.symbols and "epsilon" not in array.mended:
        yield Claim("sign changes at random values: roots on the right", SECOND_ROUTE, right)


def _signs_at(answer: Answer, point: Mapping[str, float]) -> list[float] | None:
    """The first column; None where it vanishes there."""
    try:
        signs = [scalar_number(entry, point) if entry else 0.0 for entry in answer.array.column]
    except ZeroDivisionError:
        return None
    return signs if all(signs) else None


def _right(found: tuple[complex, ...]) -> int:
    return sum(each.real > 0 for each in found)
