"""Stationary points worked out: the steps, the points and what they are held to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import arb

from derive.algebra.function import Function
from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.floats import completed
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomial_systems import Value, put_in
from derive.algebra.solving.polynomials import known_sign, odd_part
from derive.derivation import Branch, Claim, Condition, Derivation, PageFacts, Phrase, Said, Step, Table
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Derivative, Expr, Relation, Sum, Symbol, add, multiply
from derive.kinds.checks import NORMAL_FORM, every, law, random_points, route
from derive.kinds.function._case_checks import cases_told
from derive.kinds.function._extremes import extremes, reach
from derive.kinds.function._landscape import Landscape
from derive.kinds.function._naming import function_name, multiplier_names
from derive.kinds.function._newton import NEAR, stationary
from derive.kinds.function._point_checks import PointsTold
from derive.kinds.function._stationary import Point, Task, bordered_hessian, is_flat_saddle, patterns, points
from derive.kinds.function._telling import CaseTold, divided_by, is_enclosed, told
from derive.kinds.function._verdicts import HESSIAN, flat_test, minors_of, reached, tests_of
from derive.kinds.function._writing import written
from derive.kinds.problem import Problem
from derive.kinds.work import Work

LAMBDA = Symbol("Lambda")
SINGULAR = "singular-point"
SINGULAR_ONE, SINGULAR_SEVERAL = "at-singular-points-of-one", "at-singular-points"
LOCAL = {
    "maximum": "local-maximum", "minimum": "local-minimum", "saddle": "saddle-point",
    "undecided": "undecided", "isolated": "isolated-point", "singular": SINGULAR,
}  # fmt: skip
GLOBAL = {"maximum": "global-maximum", "minimum": "global-minimum", "both": "global-extremes"}
LARGEST_SEARCH = 5  # unknowns with which Newton's method is cheap


class Facts(PageFacts):
    goal: Symbol  # f, or the Lagrange function
    value: Relation | None  # the function by its name, where another one is made of it
    name: Symbol | None  # whose gradient is a combination of others
    multipliers: tuple[Symbol, ...]
    partials: tuple[tuple[Expr, ...], ...]  # each with the zero that it is equal to
    determinants: tuple[tuple[Expr, ...], ...]  # likewise
    variables: int
    cases: tuple[CaseTold, ...]
    nonzero: tuple[Expr, ...]  # taken not to vanish
    enclosed: Phrase | None  # roots that are rounded
    tests: tuple[Phrase, ...]  # by which the points are told apart
    flat: Phrase | None  # a test where the last minor vanishes
    table: Table | None  # of the points, where there are some
    singular: Phrase | None
    reach: Phrase | None  # the greatest and the smallest value


def worked(kind: str, function: Function, problem: Problem) -> Derivation:
    """The answer to either kind. Raises NotDerivable where a point is out of reach."""
    if function.vector:
        raise NotDerivable("extreme values are those of a scalar function, not of a list of components")
    name = function_name(problem)
    multipliers = multiplier_names(len(function.constraints), problem) if function.constraints else ()
    task = Task.of(function, multipliers, problem.names, problem.assumptions)
    case = task.candidates()
    found = points(task, case)
    limits = reach(task)
    best = extremes(found, limits, task.positive)
    said = [_said(point, extreme, problem, task) for point, extreme in zip(found, best, strict=True)]
    goal = LAMBDA if multipliers else name
    definitions: dict[Expr, Expr] = {name: function.values[0], goal: _lagrange(function, multipliers, name)}
    definitions[name] = function.values[0]
    steps = (
        Step(goal.name, (goal, definitions[goal]), "lagrange"),
        *_partials(problem, definitions[goal], goal, (*function.variables, *task.multipliers)),
        *_determinants(task, problem),
        *_hessian(task, problem, found),
    )
    solutions = tuple(_branch(p, when, name, task, problem) for p, when in zip(found, said, strict=True))
    work = Work(problem, definitions, steps=steps).claim(*_put_back(task, found, solutions, name))
    work = work.claim(*_search(function, task, problem, found))
    table, land = _table(found, said, name, task, problem), Landscape.of(function, problem)
    checked = PointsTold(land, problem, name, goal, tuple(multipliers), solutions, table)
    cases = told(case, problem, function.variables)
    work = work.claim(checked.lines(steps), *checked.points())
    work = work.claim(*cases_told(cases, function.variables, problem))
    singular_points = SINGULAR_ONE if len(function.constraints) == 1 else SINGULAR_SEVERAL
    greatest, smallest = (_best(each, found, best, problem) for each in ("maximum", "minimum"))
    facts = Facts(
        goal=goal, value=Relation(name, "=", function.values[0]) if multipliers else None,
        name=name if any(step.rule == "dependent" for step in steps) else None,
        multipliers=tuple(multipliers), variables=len(function.variables),
        partials=tuple((*step.chain, ZERO) for step in steps if step.rule == "stationary"),
        determinants=tuple((*step.chain, ZERO) for step in steps if step.rule == "dependent"),
        cases=cases, nonzero=divided_by(case, problem),
        enclosed=Phrase("enclosed") if is_enclosed([p.solution for p in found]) else None,
        tests=tests_of(len(function.variables), len(function.constraints), found),
        flat=flat_test(found, bool(multipliers)), table=table if found else None,
        singular=Phrase(singular_points) if any(p.kind == "singular" for p in found) else None,
        reach=reached(limits, name, greatest, smallest, len(function.constraints)),
    )  # fmt: skip
    work = work.claim(*checked.greatest_and_smallest(facts.reach), checked.tests(facts.tests, facts.flat))
    singular = any(SINGULAR in _keys(each) for when in said for each in when)
    one = facts.singular is None or (facts.singular.key == SINGULAR_ONE) == (len(function.constraints) == 1)
    work = work.law("said", ((facts.singular is not None) == singular, one))
    return work.answer(kind, {"solutions": solutions}, facts)


def _best(extreme: str, found: Sequence[Point], extremes: Sequence[str], problem: Problem) -> Expr | None:
    """The greatest or the smallest value, where it is known to exist."""
    best = [point for point, which in zip(found, extremes, strict=True) if which in (extreme, "both")]
    return written(best[-1].value, problem) if best else None


def _lagrange(function: Function, multipliers: Sequence[Symbol], name: Symbol) -> Expr:
    """f - lambda (g - c), as the author wrote f, g and c."""
    parts = [function.values[0]]
    for multiplier, c in zip(multipliers, function.constraints, strict=True):
        terms = c.left.terms if isinstance(c.left, Sum) else (c.left,)
        difference = c.left if c.right == ZERO else add(*terms, -c.right)
        parts.append(-multiply(multiplier, difference))
    return add(*(term for part in parts for term in (part.terms if isinstance(part, Sum) else (part,))))


def _partials(problem: Problem, of: Expr, goal: Symbol, names: Sequence[str]) -> Iterator[Step]:
    for name in names:
        by = Symbol(name)
        value = problem.readable(normal(Derivative(of, by), problem.names))
        yield Step(f"d{goal.name}_d{name}", (Derivative(goal, by), value), "stationary")


def _determinants(task: Task, problem: Problem) -> Iterator[Step]:
    """Of every m + 1 columns of the gradients; those that vanish anyway are left out."""
    if not task.g:
        return
    rows = task.gradients
    for k, (columns, value) in enumerate(task.determinants().items(), 1):
        if value:
            matrix = problem.readable_matrix(rows.columns(*columns))
            yield Step(f"determinant_{k}", (Call("det", (matrix,)), problem.readable(value)), "dependent")


def _hessian(task: Task, problem: Problem, found: Sequence[Point]) -> Iterator[Step]:
    if any(point.minors for point in found):
        yield Step("H", (HESSIAN, problem.readable_matrix(bordered_hessian(task))), "hessian")


def _said(point: Point, extreme: str, problem: Problem, task: Task) -> tuple[Condition, ...]:
    """What a point is, and where."""
    if extreme:
        said = [Phrase(GLOBAL[extreme]), *([Phrase(SINGULAR)] if point.kind == "singular" else [])]
    else:
        local = LOCAL.get(point.kind)
        said = [Phrase(local)] if local else list(_conditional(point, problem, task))
    for each in point.solution.real_if:
        need = Relation(problem.readable(each), ">=", ZERO)
        said[-1:] = [Phrase("where", {"said": said[-1] if said else "", "need": need})]
    return tuple(said)


def _keys(said: Said) -> Iterator[str]:
    """Of a phrase, and of what it says holds somewhere."""
    while isinstance(said, Phrase):
        yield said.key
        said = said.about.get("said", "")


def _conditional(point: Point, problem: Problem, task: Task) -> Iterator[Phrase]:
    """Where the parameters decide: by the signs of the minors."""
    for kind, wanted in patterns(len(task.g), len(point.minors)).items():
        needs = [_need(v, sign, problem, task) for v, sign in zip(point.minors, wanted, strict=True)]
        if None not in needs:
            given = tuple(dict.fromkeys(each for n in needs for each in n or ()))
            yield Phrase("it-is-if", {"said": Phrase(LOCAL[kind]), "needs": given})


def _need(minor: Value, sign: int, problem: Problem, task: Task) -> tuple[Relation, ...] | None:
    """The condition for a minor to have this sign: none where it has, None where it cannot."""
    if isinstance(minor, arb):
        return () if (minor > 0) == (sign > 0) else None
    known = known_sign(minor, task.positive)
    if known is not None:
        return () if known == sign else None
    value = odd_part(minor, task.positive)
    if as_fraction(value.numerator.leading_coefficient()) < 0:
        value, sign = -value, -sign
    return (Relation(problem.readable(value), ">" if sign > 0 else "<", ZERO),)


def _branch(point: Point, when: tuple[Condition, ...], name: Symbol, task: Task, problem: Problem) -> Branch:
    values = {each: written(value, problem) for each, value in point.solution.values.items()}
    values |= {each: Symbol(each) for each in point.solution.free}
    values = {each: values[each] for each in task.variables}
    if point.multipliers is not None:
        pairs = zip(task.multipliers, point.multipliers, strict=True)
        values |= {each: written(value, problem) for each, value in pairs}
    return Branch({**values, name.name: written(point.value, problem)}, when)


def _table(
    found: Sequence[Point], said: Sequence[tuple[Condition, ...]], name: Symbol, task: Task, problem: Problem
) -> Table:
    minors = minors_of(len(task.variables), len(task.g))
    headings = (*map(Symbol, (*task.variables, *task.multipliers)), name, *minors, "")
    rows = []
    for point, when in zip(found, said, strict=True):
        branch = _branch(point, when, name, task, problem).values
        known = [branch.get(each, Phrase("none")) for each in (*task.variables, *task.multipliers, name.name)]
        signs: list[Expr | str] = [written(minor, problem) for minor in point.minors] or [""] * len(minors)
        rows.append((*known, *signs, when))
    return Table(headings, tuple(rows))


# -- what it is held to ----------------------------------------------------------------------------------


def _put_back(
    task: Task, found: Sequence[Point], solutions: Sequence[Branch], name: Symbol
) -> Iterator[Claim]:
    """Every equation of the Lagrange function at every point, which is printed as it was found."""
    equations = [task.lagrange.diff(x) for x in (*task.variables, *task.multipliers)]
    for k, (point, branch) in enumerate(zip(found, solutions, strict=True), 1):
        same = _is_told(branch, {**_values(point, task), name.name: point.value})
        if point.multipliers is None:
            yield law("on-the-constraints", (same, *(_vanishes(g, point, task) for g in task.g)), k=k)
        else:
            by = NORMAL_FORM if point.is_exact else "ball-arithmetic"
            yield every("satisfies", (same, *(_vanishes(each, point, task) for each in equations)), by, k=k)


def _values(point: Point, task: Task) -> dict[str, Value]:
    """Its coordinates and multipliers."""
    return {**point.solution.values, **dict(zip(task.multipliers, point.multipliers or (), strict=False))}


def _is_told(branch: Branch, values: Mapping[str, Value]) -> bool:
    """Whether what is exact has these values as it is printed."""
    exact = {
        name: each for name, each in values.items() if isinstance(each, Scalar) and name in branch.values
    }
    return all(normal(branch.values[name]) == each for name, each in exact.items())


def _vanishes(equation: Scalar, point: Point, task: Task) -> bool:
    value = put_in(equation, _values(point, task))
    return not value if isinstance(value, Scalar) else bool(value.contains(0))


def _search(function: Function, task: Task, problem: Problem, found: Sequence[Point]) -> Iterator[Claim]:
    """No point that Newton's method finds is missing. Curves of points are not looked for."""
    unknowns = (*task.variables, *task.multipliers)
    if len(unknowns) > LARGEST_SEARCH or any(p.solution.free for p in found):
        return
    parameters = problem.symbols - set(task.variables)
    known = completed(next(iter(random_points(parameters, 1))), problem.where)
    tree = _lagrange(function, tuple(map(Symbol, task.multipliers)), Symbol("f"))

    ours = [_numbers(p, task, known) for p in found]  # at a singular point any multiplier may do
    regular = [mine for mine, p in zip(ours, found, strict=True) if mine and _is_found(p)]
    walked = stationary(tree, known, unknowns, [mine for mine in regular if len(mine) == len(unknowns)])
    others = [each for each in walked if _allowed(each, task)]
    listed = [any(_near(theirs, mine) for mine in ours) for theirs in others]
    if others or not regular:  # where there is none to be found, none of the starts leads to one
        yield route("newtons-method", listed or [not walked], count=len(others))
    else:
        yield route("newtons-method", (), count=0)


def _is_found(point: Point) -> bool:
    """Whether the second derivatives decide what it is, so that Newton's method finds it."""
    return point.kind in ("maximum", "minimum", "saddle") and not is_flat_saddle(point)


def _allowed(point: Sequence[float], task: Task) -> bool:
    """Whether no variable declared positive is negative there."""
    pairs = zip(task.variables, point, strict=False)
    return all(value > 0 for name, value in pairs if name in task.positive)


def _numbers(point: Point, task: Task, known: Mapping[str, float]) -> list[float]:
    values = [*(point.solution.values[x] for x in task.variables), *(point.multipliers or ())]
    try:
        return [float(v.mid()) if isinstance(v, arb) else numeric.scalar_number(v, known) for v in values]
    except ValueError:  # not real for these parameters
        return []


def _near(theirs: Sequence[float], ours: Sequence[float]) -> bool:
    pairs = zip(theirs, ours, strict=False)
    return bool(ours) and all(abs(a - b) < 100 * NEAR * (1 + abs(b)) for a, b in pairs)
