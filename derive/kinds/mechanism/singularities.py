"""Where a linkage of four or five bars or a slider-crank is singular: positions with bars in line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from derive.algebra.formulas.quantities import rational
from derive.algebra.normal import normal
from derive.derivation import Branch, Derivation, Phrase, Step
from derive.expression import (
    PI,
    ZERO,
    Call,
    Expr,
    Product,
    Symbol,
    cos,
    negate,
    number,
    sin,
    subtract,
)
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.mechanism import _four_bar as _four_bar_names
from derive.kinds.mechanism import _slider_crank as _slider_crank_names
from derive.kinds.mechanism._ends import End, of_rocker, of_slider
from derive.kinds.mechanism._facts import Singular
from derive.kinds.mechanism._facts import SingularFacts as Facts
from derive.kinds.mechanism._five_bar_singular import of_five_bars
from derive.kinds.mechanism._loop import loop_of, units_of
from derive.kinds.mechanism._singular_checks import all_found, vanish_in_line
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FiveBar, FourBar, SliderCrank

NEEDS = ("loop",)
CLAIMS = ("all-around",)
TWO = number(2)
Row: TypeAlias = tuple[str, Expr, End | None]  # a position, what the crank has there, and what it moves
CLAIMED = {"solutions": "all-around"}


def derive(linkage: FourBar | SliderCrank | FiveBar, options: Options, problem: Problem) -> Derivation:
    """sin(theta_3 - theta_4) = 0 and sin(theta_2 - theta_3) = 0 (Gosselin and Angeles, Singularity analysis
    of closed-loop kinematic chains; toggle and limit positions of Norton, Design of Machinery, section 3.3).

    Raises NotDerivable where bars of these lengths cannot be joined.
    """
    if isinstance(linkage, FiveBar):
        return of_five_bars(linkage, problem)
    rates = problem.ask("velocity")
    work, loop = loop_of(linkage, Work(problem, uses=(rates,)))
    theta, (third, last) = loop.angle, loop.unknown
    four = isinstance(linkage, FourBar)
    rows = _four_bar(linkage, work) if isinstance(linkage, FourBar) else _slider_crank(linkage, work, last)
    head = cos(theta) if four else sin(theta)
    branches, places = list[Branch](), list[Singular]()
    for key, formula, end in rows:
        value = work.shown(formula)
        links = (head, formula) if value == formula else (head, formula, value)
        work = work.showing(Step(key, links, "in-numbers"))
        angles = _angles(problem.final(value), four)
        end = end if angles else None
        work = work.showing(end.step) if end else work
        nowhere = None if angles else Phrase("nowhere")
        places.append(Singular(lie=Phrase(key), line=key, nowhere=nowhere, end=end.told if end else None))
        for k, each in enumerate(angles):
            there = {last.name: end.values[k]} if end else {}
            branches.append(Branch({theta.name: each} | there, (Phrase(key),)))
    results = {"solutions": tuple(branches)}
    around = _around([problem.final(work.shown(formula)) for _, formula, _ in rows[:2]])
    work = work.claim(route("all-around", all_found(linkage, work, results["solutions"], around, places)))
    factors = (sin(subtract(third, last)) if four else cos(third), sin(subtract(theta, third)))
    work = work.claim(route("all-around", vanish_in_line(linkage, factors, (theta, third, last))))
    facts = Facts(
        det=rates.step("det").chain,
        factors=factors,
        unbounded=tuple(places[:2]), at_rest=tuple(places[2:]), last=Symbol(f"{last.name}_dot"),
        around=around, four=four, angle=theta, angle_results=(theta.name, "theta_4"), in_degrees=True,
    )  # fmt: skip
    return work.answer("singularities", results, facts, units={} if four else units_of(problem, last))


def _around(values: Sequence[Expr]) -> Phrase | None:
    """Whether a position stops the crank, which cosines or sines of its angle decide."""
    sizes = list(map(rational, values))
    if any(size is None or abs(size) == 1 for size in sizes):
        return None
    return Phrase("stops" if any(size is not None and abs(size) < 1 for size in sizes) else "all-round")


def _angles(value: Expr, four: bool) -> tuple[Expr, ...]:
    """All that have this cosine, or this sine: none of a number beyond 1."""
    size = rational(value)
    if size is not None and abs(size) > 1:
        return ()
    angle = Call("acos" if four else "asin", (value,))
    if size is not None and abs(size) == 1:
        return (angle,)
    if four:
        return angle, negate(angle)
    return angle, subtract(negate(PI) if size is not None and size < 0 else PI, angle)


def _four_bar(linkage: FourBar, work: Work) -> list[Row]:
    """The cosine of the angle of the crank in each."""
    work, names = _four_bar_names.lengths(linkage, work)
    crank, coupler, rocker, ground = (names[name] for name in ("a", "b", "c", "d"))
    rows = list[Row]()
    for key, reach in (("toggle-stretched", coupler + rocker), ("toggle-folded", coupler - rocker)):
        rows.append((key, (ground**2 + crank**2 - reach**2) / (2 * ground * crank), None))
    for key, reach in (("limit-stretched", crank + coupler), ("limit-folded", crank - coupler)):
        if normal(reach, work.definitions):
            side = 1 if key == "limit-stretched" else work.sign(reach)
            end = of_rocker(work, f"{key}-end", reach, side, (rocker, ground))
            rows.append((key, (ground**2 + reach**2 - rocker**2) / Product((TWO, ground, reach)), end))
    return rows


def _slider_crank(linkage: SliderCrank, work: Work, last: Symbol) -> list[Row]:
    """The sine of the angle of the crank in each."""
    work, names = _slider_crank_names.lengths(linkage, work)
    crank, rod, height = names["a"], names["b"], names.get("e", ZERO)
    rows: list[Row] = [
        ("upright-above", (height + rod if height != ZERO else rod) / crank, None),
        ("upright-below", subtract(height, rod) / crank, None),
    ]
    for key, reach in (("rod-stretched", crank + rod), ("rod-folded", subtract(crank, rod))):
        if normal(reach, work.definitions):
            side = 1 if key == "rod-stretched" else work.sign(reach)
            end = of_slider(work, f"{key}-end", reach, side, height, last)
            rows.append((key, height / reach if height != ZERO else ZERO, end))
    return rows


def measures(linkage: FourBar | SliderCrank | FiveBar) -> dict[str, str]:
    """The distances at which a five-bar linkage is singular, and the places of a slider."""
    if isinstance(linkage, FiveBar):
        return dict.fromkeys(("r_1", "r_2", "e"), "m")
    return {"s": "m"} if isinstance(linkage, SliderCrank) else {}
