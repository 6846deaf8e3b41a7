"""The velocity and force ellipsoids at a configuration: semi-axes, directions, and the picture of an arm
that moves in a plane."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, get_args

from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.arrays import arrays
from derive.algebra.rationals import significant_digits
from derive.derivation import Claim, Label, Panels, Phrase, Record, Result, Step, Table
from derive.errors import DivisionByZero, NotDerivable, NotReal
from derive.expression import Approximate, Expr, Matrix, Number, Relation, Symbol, column
from derive.figures.axes import axis
from derive.figures.ellipses import Rates, Tip, at_the_tip
from derive.kinds.checks import close, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._velocity.task import Task
from derive.kinds.sure import place as surely
from derive.kinds.values_at import point_of

TREES = get_args(Expr)
DIFFERENCES = 1e-6
FEW = 3  # digits of a number that is exact
NONE = 1e-9  # a semi-axis that is none, relative to the largest
INFINITE = "infinite"
PLANE = (("vx", "vy"), ("vx", "vz"), ("vy", "vz"))


class PointTold(Record):
    point: tuple[tuple[Symbol, Expr], ...]
    table: Table
    figure: Phrase
    lengths: Phrase | None  # of the axes, to each other
    plots: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Ellipsoids:
    """What a configuration adds to a derivation."""

    place: dict[str, float]
    step: Step
    results: dict[str, Result]
    evaluated: dict[str, Any]
    claims: tuple[Claim, ...]
    plots: tuple[Panels, ...]
    told: PointTold


def at_point(task: Task, place: Place, compared: Sequence[Place] = ()) -> Ellipsoids:
    """By the singular values of J (m by n) at the place, drawn to one scale with places that are `compared`.
    Raises NotDerivable for a name without a value."""
    import numpy as np

    here = dict.fromkeys(task.problem.symbols, 0.0) | _numbers(task, place)  # a height has no part in J
    J = np.array(numeric.matrix_numbers(task.J, here))
    U, values, _ = np.linalg.svd(J)
    sizes = [float(value) if value >= NONE * max(values[0], 1.0) else 0.0 for value in values]
    sizes += [0.0] * (len(task.rows) - len(values))
    directions = [_turned(U[:, k]) for k in range(len(sizes))]
    order = sorted(range(len(sizes)), key=sizes.__getitem__)
    forces: list[Any] = [1 / sizes[k] if sizes[k] else INFINITE for k in order]
    pushes = tuple(Approximate(force) if force != INFINITE else force for force in forces)
    turned = [directions[k] for k in order]
    unit = unit_of_lengths(task.problem, (value for _, value in place))
    plots = _pictures(task, here, J, sizes, directions, unit, place, [*_elsewhere(task, compared)])
    told = PointTold(
        point=tuple((Symbol(name), value) for name, value in place),
        table=_table(task, sizes, directions),
        figure=figure_of(task),
        lengths=_compared(sizes, len(sizes) <= J.shape[1]),
        plots=tuple(plot.name for plot in plots),
    )
    results: dict[str, Result] = {
        "axes": column(map(Approximate, sizes)),
        "directions": _rounded(directions),
        "force_axes": column(pushes) if all(sizes) else pushes,
        "force_directions": _rounded(turned),
    }
    evaluated = {"axes": sizes, "directions": directions, "force_axes": forces, "force_directions": turned}
    step = Step("J_here", (Symbol("J"), Matrix(_exact(task, place) or _rounded(J))), "numbers")
    there = here | surely({**task.problem.where, **dict(place)})
    claims = tuple(_claims(task, there, step, results, evaluated, told))
    if plots:
        claims += (route("drawn", as_drawn(plots[0], task.numbers(there))),)
    return Ellipsoids(here, step, results, evaluated, claims, plots, told)


def exactly(problem: Problem, expr: Expr, place: Place) -> Number | None:
    """The value at a place where it is a number of few digits, so that nothing has to be rounded."""
    values: dict[Expr, Expr] = {
        Symbol(name): value for name, value in {**problem.where, **dict(place)}.items()
    }
    try:
        value = normal(expr, values).constant
    except (NotDerivable, NotReal, DivisionByZero):  # a rounded number has no normal form
        return None
    digits = None if value is None else significant_digits(value)
    return Number(value, True) if value is not None and digits is not None and digits <= FEW else None


def _exact(task: Task, place: Place) -> tuple[tuple[Expr, ...], ...]:
    """J at the place, where every element is such a number."""
    rows = tuple(tuple(exactly(task.problem, each, place) for each in row) for row in task.written.rows)
    kept = tuple(tuple(each for each in row if each is not None) for row in rows)
    return kept if kept == rows else ()


def figure_of(task: Task) -> Phrase:
    """What velocities of unit joint rates fill."""
    return Phrase("ellipse" if len(task.rows) == 2 else "ellipsoid")


def _compared(sizes: Sequence[float], full: bool) -> Phrase | None:
    """How long the axes are to each other; `full` where there are joints for all of them."""
    if not sizes[-1]:
        return Phrase("singular") if full else None
    ratio = sizes[0] / sizes[-1]
    key = "uneven-ellipse" if len(sizes) == 2 else "uneven"
    return Phrase("even") if ratio < 1 + NONE else Phrase(key, {"ratio": Approximate(ratio)})


def _rounded(rows: Any) -> tuple[tuple[Expr, ...], ...]:
    """Rows of numbers as trees."""
    return tuple(tuple(Approximate(float(x)) for x in row) for row in rows)


def decided(task: Task, place: Place) -> bool:
    """Whether every name that stands in J has a value."""
    return not place or _used(task) <= _numbers(task, place).keys()


def _numbers(task: Task, place: Place) -> dict[str, float]:
    known = dict(oracle_of(task.problem).at(point_of(dict(place), task.problem.where)))
    if not place and (missing := sorted(_used(task) - set(known))):
        raise NotDerivable(
            f"no value is known for {', '.join(missing)}: give it under evaluate: or where:", "evaluate"
        )
    return known


def _used(task: Task) -> set[str]:
    """The names that stand in J."""
    return {name for entry in task.J.entries for name in entry.letters()}


def _turned(vector: Any) -> list[float]:
    """Of the two opposite directions the one whose largest entry is positive; tiny entries are zero."""
    largest = max(vector, key=abs)
    return [0.0 if abs(x) < 1e-12 else float(x if largest > 0 else -x) for x in vector]


def _table(task: Task, values: list[float], directions: list[list[float]]) -> Table:
    """Each direction by its components, with how fast and how hard the arm is along it."""
    rows = tuple(
        (*map(Approximate, vector), Approximate(s), Approximate(1 / s) if s else INFINITE)
        for s, vector in zip(values, directions, strict=True)
    )
    axes = (Phrase("along" if row[0] == "v" else "about", {"axis": row[1]}) for row in task.rows)
    return Table((*axes, Phrase("velocity"), Phrase("force")), rows)


def _claims(
    task: Task,
    here: Mapping[str, float],
    step: Step,
    results: Mapping[str, Result],
    evaluated: Mapping[str, Any],
    told: PointTold,
) -> Iterator[Claim]:
    """The axes are those of J J^T with J by differences: as results, in the table and in what is said."""
    import numpy as np

    J = task.numbers(here)
    gram, n = J @ J.T, len(task.rows)
    rows = [[cell for cell in row if isinstance(cell, TREES)] for row in told.table.rows]
    table = [[numeric.number(cell, {}) for cell in row] for row in rows]
    shown = [(row[n], row[:n]) for row in table]
    listed = list(zip(evaluated["axes"], evaluated["directions"], strict=True))
    printed = list(zip(_numbers_of(results["axes"]), _numbers_of(results["directions"]), strict=True))
    yield route(
        "eigenvectors",
        (
            close(gram @ np.array(vector), size**2 * np.array(vector), DIFFERENCES)
            and close(np.linalg.norm(vector), 1.0, DIFFERENCES)
            for size, vector in (*shown, *listed, *printed)
        ),
    )
    sizes = [row[n] for row in table]
    yield route("jacobian-here", close(arrays(step.result, here), J, DIFFERENCES))
    yield route("said-of-the-axes", _said(told, sizes, J))
    pushes = [(row[n], row[n + 1 :], row[:n]) for row in table]
    listed = list(zip(evaluated["force_axes"], evaluated["force_directions"], strict=True))
    printed = list(
        zip(_numbers_of(results["force_axes"]), _numbers_of(results["force_directions"]), strict=True)
    )
    yield route(
        "force-axes",
        (
            *(close(1 / size, push, DIFFERENCES) if size else not push for size, push, _ in pushes),
            *(any(_same(*each, push, along) for _, push, along in pushes) for each in (*listed, *printed)),
        ),
    )


def _same(force: Any, direction: list[float], push: list[float], along: list[float]) -> bool:
    """Whether a force along its direction is that of a row of the table, which has no number for one without
    bounds."""
    return close([] if force == INFINITE else [force], push) and close(direction, along)


def _numbers_of(result: Any) -> Any:
    """A column, or rows of vectors; what has no number is said as it is."""
    match result:
        case Matrix(rows):
            return [numeric.number(entry, {}) for (entry,) in rows]
        case tuple():
            return [_numbers_of(part) for part in result]
    return result if result == INFINITE else numeric.number(result, {})


def _said(told: PointTold, sizes: Sequence[float], J: Any) -> Iterator[bool]:
    """Whether the axes are said to be equal, the arm to be singular, and one axis so many times another
    where they are."""
    import numpy as np

    values = np.linalg.svd(J, compute_uv=False)
    least, most = float(values[-1]), float(values[0])
    yield close(sorted(sizes, reverse=True), sizes, DIFFERENCES)
    full = len(values) == len(J)
    said = told.lengths.key if told.lengths else ""
    yield (said == "singular") == (full and least < DIFFERENCES * most)
    yield (said == "even") == (full and least > most * (1 - DIFFERENCES))
    yield bool(said) == full
    if told.lengths and isinstance(ratio := told.lengths.about.get("ratio"), TREES):
        yield close(numeric.number(ratio, {}) * least, most, DIFFERENCES)
    yield (told.figure.key == "ellipse") == (len(J) == 2)


def _pictures(
    task: Task,
    here: Mapping[str, float],
    J: Any,
    values: list[float],
    directions: list[list[float]],
    unit: str,
    place: Place,
    compared: Sequence[tuple[float, float]],
) -> tuple[Panels, ...]:
    """The arm with both ellipses at its tip, where two components in a plane are asked for."""
    if tuple(sorted(task.rows)) not in PLANE or not values[-1]:
        return ()
    letters, variables = [row[1] for row in task.rows], task.found.variables
    tip = Tip(
        arm=_arm(task, here, ["xyz".index(each) for each in letters]),
        axes=(Symbol(letters[0]), Symbol(letters[1])),
        unit=unit,
        sizes=(values[0], values[1]),
        directions=[(along[0], along[1]) for along in directions],
        compared=compared,
        at=tuple(Relation(Symbol(name), "=", value) for name, value in place if name in variables),
    )
    return (at_the_tip(tip, _rates(task, J, values, directions, unit)),)


def _elsewhere(task: Task, places: Sequence[Place]) -> Iterator[tuple[float, float]]:
    """The semi-axes of the ellipse at other places where it can be drawn."""
    import numpy as np

    for place in places:
        if decided(task, place):
            values = np.linalg.svd(np.array(numeric.matrix_numbers(task.J, _numbers(task, place))))[1]
            if len(values) == 2 and values[-1] >= NONE * values[0]:
                yield float(values[0]), float(values[1])


def _rates(task: Task, J: Any, values: list[float], directions: list[list[float]], unit: str) -> Rates | None:
    """Those of size one that J turns into the half axes, where there are two joints."""
    if len(task.rates) != 2:
        return None
    turning = {joint.variable for _, joint in task.found.moving if joint.type == "revolute"}
    slide = "m/s" if unit else ""
    units = ("rad/s" if name in turning else slide for name in task.found.variables)
    first, second = map(axis, task.rates, units)
    images = [J.T @ along / size for along, size in zip(directions, values, strict=True)]
    return Rates((first, second), [(float(q[0]), float(q[1])) for q in images])


def as_drawn(panels: Panels, J: Any) -> Iterator[bool]:
    """Every point of the ellipses is the image of joint rates, and of torques, of size one; their half axes
    those of the rates that are drawn."""
    import numpy as np

    *_, plot = panels.plots
    gram, tip = J @ J.T, np.array([[x[-1], y[-1]] for x, y in plot.arms.values()])
    for (label, curve), form in zip(plot.series.items(), (np.linalg.inv(gram), gram), strict=True):
        away = (np.array(curve).T - tip) / _scale(label)
        yield close(np.einsum("ki,ij,kj->k", away, form, away), np.ones(len(away)), DIFFERENCES)
    scale = _scale(next(iter(plot.series)))
    half_axes = [np.array(end) - np.array(start) for start, end in plot.arrows.values()]
    yield close(*(float(half_axes[0] @ half_axes[1]), 0.0), DIFFERENCES)
    for circle in panels.plots[:-1]:
        for (_, rates), half in zip(circle.arrows.values(), half_axes, strict=True):
            yield close(scale * J @ np.array(rates), half, DIFFERENCES)
            yield close(float(np.linalg.norm(rates)), 1.0, DIFFERENCES)


def _scale(label: Label) -> float:
    """How long 1 is said to be drawn."""
    drawn = label.about["drawn"] if isinstance(label, Phrase) else ""
    return float(str(drawn).split()[0])


def _arm(task: Task, here: Mapping[str, float], plane: list[int]) -> list[tuple[float, float]]:
    """The origins of the frames, seen in the plane; the last is the point itself."""
    origins = [T[:3, 3] for T in oracle_of(task.problem).poses(here)]
    tip = [row[0] for row in numeric.matrix_numbers(task.point.position, here)]
    points: list[Any] = [*origins[: task.point.last], tip]
    return [(float(p[plane[0]]), float(p[plane[1]])) for p in points]
