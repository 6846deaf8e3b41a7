"""The fastest motion along a path, as the page tells it: the derivatives of the path, the time, and which
limit binds when."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

from derive.algebra.normal import normal
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point, number
from derive.derivation import Cell, Derivation, Label, Phrase, Plot, Record, Result, Step, Table
from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Expr,
    Matrix,
    Number,
    Symbol,
    column,
    free_symbols,
    multiply,
    squared,
    walk,
)
from derive.figures.axes import axis as in_brackets
from derive.figures.axes import short
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.profile._along.fastest import STEPS, Fastest, fastest
from derive.kinds.profile._shapes import TIME
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.profile import JointPath
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

TIGHT, SHORT = 3e-4, 1e-2  # of a limit that is reached, and of the whole time
SMALL = 1e-6  # of the greatest derivative by the parameter
MOST = 16  # rows of the table
LISTED = 50  # every which value is a result
OPEN = (
    "the fastest motion along a path is found in numbers, and no value is known for {}; give one under where:"
)
STILL = (
    "the path stands still somewhere within its range, or has no derivatives there: no limit of an axis "
    "bounds the rate of its parameter"
)


class PathTold(Record):
    """Steps, and what is said between them."""

    derivatives: tuple[str, ...]
    rates: tuple[str, ...]
    bounded: Phrase
    searched: Phrase
    time: str
    binding: Phrase
    table: Table | None


@dataclass(frozen=True)
class Along:
    """The motion found, and what made it: the names of the place with its derivatives, and of the parameter
    with its rates; the place with its derivatives as trees."""

    path: JointPath
    found: Fastest
    point: Point
    names: tuple[Symbol, Symbol, Symbol]
    rates: tuple[Symbol, Symbol, Symbol]
    trees: tuple[Matrix, Matrix, Matrix]
    time: float
    steps: tuple[Step, ...]
    told: PathTold
    picture: Plot

    @property
    def limits(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Of velocities, without end where there is none, and accelerations."""
        return limits_of(self.path, self.point)


def along(path: JointPath, evaluate: Place | None, problem: Problem) -> Along:
    """Raises NotDerivable where symbols are left, and where the path stands still on its way."""
    point = point_of(dict(evaluate or ()), problem.where)
    s = Symbol(path.parameter)
    missing = {
        name
        for tree in (*path.places, *path.between, *path.v_max, *path.a_max)
        for name in free_symbols(tree)
    }
    if left := sorted(missing - {s.name} - point.keys()):
        raise NotDerivable(OPEN.format(", ".join(left)))
    first = [normal(tree, problem.names).diff(s.name) for tree in path.places]
    trees = (
        column(path.places),
        column(problem.readable(each) for each in first),
        column(problem.readable(each.diff(s.name)) for each in first),
    )
    ends = number(path.between[0], point), number(path.between[1], point)
    derivatives = [_vector(tree, s, point) for tree in trees[1:]]
    limits = limits_of(path, point)
    try:
        found = fastest(derivatives[0], derivatives[1], limits, ends, STEPS)
        coarse = fastest(derivatives[0], derivatives[1], limits, ends, STEPS // 2)
    except ZeroDivisionError:
        raise NotDerivable(STILL, "path") from None
    sizes = [float(abs(derivatives[0](float(each))).max()) for each in found.s[::LISTED]]
    if min(sizes) <= SMALL * max(sizes):
        raise NotDerivable(STILL, "path")
    time = float(2 * found.t[-1] - coarse.t[-1])  # what is left is of the order of a step
    letters = {*problem.taken, *missing, s.name}
    names = tuple(
        Symbol(free(letters, each, f"{each}_e")) for each in ("q", f"q_{s.name}", f"q_{s.name}{s.name}")
    )
    rates = (s, Symbol(f"{s.name}_dot"), Symbol(f"{s.name}_ddot"))
    steps = tuple(_steps(names, rates, trees, time))
    table = _table(binding(found, derivatives, limits))
    told = PathTold(
        derivatives=tuple(step.name for step in steps[:3]),
        rates=("q_dot", "q_ddot"),
        bounded=Phrase("bounded", {"rate": rates[1], "change": rates[2], "square": squared(rates[1])}),
        searched=Phrase("searched", {"square": squared(rates[1]), "s": s, "count": STEPS}),
        time="time",
        binding=Phrase("binding-in-turn" if table else "binding-often"),
        table=table,
    )
    return Along(
        path,
        found,
        point,
        (names[0], names[1], names[2]),
        rates,
        trees,
        time,
        steps,
        told,
        _picture(found, rates, path),
    )


def fastest_along(path: JointPath, evaluate: Place | None, problem: Problem) -> Derivation:
    """The least time, and the motion in a list of values."""
    from derive.kinds.profile._along.checks import as_tabled, kept, lines, no_shorter, pressed, said
    from derive.kinds.profile._minimum_told import Facts

    given = along(path, evaluate, problem)
    some = slice(None, None, LISTED)
    listed = {
        "t": [float(each) for each in given.found.t[some]],
        "parameter": [float(each) for each in given.found.s[some]],
    }
    work = Work(problem).showing(*given.steps)
    work = work.claim(
        route("path-lines", lines(given)),
        route("limits-kept", chain(kept(given), pressed(given))),
        route("no-time-is-shorter", no_shorter(given)),
        route("binding-limits", as_tabled(given)),
        route("said", said(given)),
    )
    facts = Facts(cases=(), path=given.told, numbers=(), page_names={"time": TIME.name})
    results: dict[str, Result] = {"time": Approximate(given.time)}
    results |= {name: tuple(map(Approximate, values)) for name, values in listed.items()}
    units: dict[Expr | Phrase, str] = {TIME: "s", Phrase("from"): "s", Phrase("to"): "s"}
    return work.answer(
        "minimum-time",
        results,
        facts,
        evaluated={"time": given.time, **listed},
        plots=(given.picture,),
        units=units,
    )


def limits_of(path: JointPath, point: Point) -> tuple[NDArray[Any], NDArray[Any]]:
    """Of velocities and accelerations, in numbers."""
    import numpy as np

    v_max = [number(each, point) for each in path.v_max] or [float("inf")] * len(path.places)
    return np.array(v_max), np.array([number(each, point) for each in path.a_max])


def _vector(tree: Matrix, s: Symbol, point: Point) -> Any:
    import numpy as np

    entries = [compiled(entry) for (entry,) in tree.rows]
    return lambda value: np.array([entry({**point, s.name: value}) for entry in entries])


def _steps(
    names: Sequence[Symbol], rates: Sequence[Symbol], trees: Sequence[Matrix], time: float
) -> Iterator[Step]:
    for name, tree in zip(names, trees, strict=True):
        yield Step(name.name, (name, tree), "in-numbers")
    q, q_s, q_ss = names
    _, s_dot, s_ddot = rates
    moved = multiply(q_s, s_ddot) + multiply(q_ss, squared(s_dot))
    yield Step("q_dot", (Symbol(f"{q.name}_dot"), multiply(q_s, s_dot)), "in-numbers")
    yield Step("q_ddot", (Symbol(f"{q.name}_ddot"), moved), "in-numbers")
    yield Step("time", (TIME, Approximate(time)), "in-numbers")


Limit = tuple[str, int]  # of a velocity or an acceleration, of which axis
Spell = tuple[float, float, frozenset[Limit]]  # from, to, what is reached


def binding(
    found: Fastest, derivatives: Sequence[Any], limits: tuple[NDArray[Any], NDArray[Any]]
) -> list[Spell]:
    """Times between which the same limits are reached; shorter spells go to what is before them."""
    spells: list[Spell] = []
    for k, (start, end) in enumerate(zip(found.t, found.t[1:], strict=False)):
        reached = frozenset(_reached(found, k, derivatives, *limits))
        if spells and spells[-1][2] == reached:
            spells[-1] = (spells[-1][0], float(end), reached)
        else:
            spells.append((float(start), float(end), reached))
    merged: list[Spell] = []
    for start, end, reached in spells:
        if merged and (end - start < SHORT * found.t[-1] or merged[-1][2] == reached):
            merged[-1] = (merged[-1][0], end, merged[-1][2])
        else:
            merged.append((start, end, reached))
    return merged


def _reached(
    found: Fastest, k: int, derivatives: Sequence[Any], v_max: NDArray[Any], a_max: NDArray[Any]
) -> Iterator[Limit]:
    """In a step, at either end of it."""
    for place in (k, k + 1):
        q_s, q_ss = (each(float(found.s[place])) for each in derivatives)
        fast = abs(q_s) * found.b[place] ** 0.5
        strong = abs(q_s * found.u[k] + q_ss * found.b[place])
        for axis in range(len(a_max)):
            if fast[axis] >= (1 - TIGHT) * v_max[axis]:
                yield "velocity", axis + 1
            if strong[axis] >= (1 - TIGHT) * a_max[axis]:
                yield "acceleration", axis + 1


def _table(spells: Sequence[Spell]) -> Table | None:
    """None where the limits change too often to be listed."""
    if len(spells) > MOST or not all(reached for *_, reached in spells):
        return None
    rows: list[tuple[Cell, ...]] = [
        (Approximate(start), Approximate(end), limits_told(reached)) for start, end, reached in spells
    ]
    return Table((Phrase("from"), Phrase("to"), Phrase("limit-reached")), tuple(rows))


def limits_told(reached: frozenset[Limit]) -> Phrase:
    """ "acceleration of axis 2", or several."""
    said = tuple(
        Phrase("of-axis", {"limit": Phrase(sort), "axis": axis})
        for sort, axis in sorted(reached, key=lambda each: (each[1], each[0]))
    )
    return said[0] if len(said) == 1 else Phrase("binding", {"limits": said})


def _picture(found: Fastest, rates: Sequence[Symbol], path: JointPath) -> Plot:
    """The rate over the parameter, and the greatest that the limits allow at each place."""
    s, s_dot, _ = rates
    units = {node.unit for end in path.between for node in walk(end) if isinstance(node, Number)}
    rate = f"{max(units, default='') or 1}/s"
    some = slice(None, None, 10)
    places = tuple(map(float, found.s[some]))
    ours = tuple(map(float, found.b[some] ** 0.5))
    top = 2 * max(ours)
    most = tuple(min(float(each), top) for each in found.most[some] ** 0.5)
    allowed: dict[Label, Any] = {Phrase("allowed"): (places, most)} if found.most.min() < top**2 else {}
    said = {"fast": short(max(ours)), "time": short(float(found.t[-1]))}
    return Plot(
        "phase", s, in_brackets(s_dot, rate), {Phrase("fastest"): (places, ours), **allowed},
        caption=Phrase("drawn-phase"), alt=Phrase("seen-phase", {**said}),
    )  # fmt: skip
