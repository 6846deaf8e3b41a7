"""What can be asked of a pose, whatever it is the pose of: beside one turn (`turns`) its Euler angles, and
how their rates turn it. An answer is put back: the rotation is made of it anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain, combinations, islice, product
from typing import Any, TypeAlias

import mpmath
import numpy as np
import sympy

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.linear import det
from derive.audit.points import NEAR, ROUNDED, Number, Point, floating
from derive.audit.poses import UNIT, turned, vector_of
from derive.audit.putting_back import array, flat, put_back, rounded
from derive.audit.registry import Auditor
from derive.audit.turns import ZERO, Array, Pose, axis_angle, inverse, quaternion, rotation, rotation_vector
from derive.expression import Symbol
from derive.mechanics.motion import Motion

PoseOf: TypeAlias = Callable[[Asked, Point], Pose]
ANGLES = (("phi", "theta", "psi"), ("alpha", "beta", "gamma"), ("phi_e", "theta_e", "psi_e"))
SPECIAL = (sympy.Integer(0), sympy.pi / 2, sympy.pi, -sympy.pi / 2)
TRIED = 4  # pairs of names in which a singular rotation is looked for
STARTS = (("0.4", "0.7"), ("-1.1", "2.3"))
STEPS = 12
FIRST, MIDDLE, LAST = sympy.symbols("_first _middle _last")


def kinds(pose: PoseOf) -> Mapping[str, Auditor]:
    """The auditors of the kinds that ask about a pose."""

    def of_pose(audit: Callable[[Asked, Point, Pose], Iterator[Test]]) -> Auditor:
        return lambda asked, point: audit(asked, point, pose(asked, point))

    return {
        "inverse": of_pose(inverse),
        "axis-angle": of_pose(axis_angle),
        "quaternion": of_pose(quaternion),
        "rotation-vector": of_pose(rotation_vector),
        "euler-angles": lambda asked, point: euler_angles(asked, point, pose),
        "euler-rates": euler_rates,
    }


def sequence(convention: str, turns: Sequence[tuple[Number, Number]]) -> Array:
    """R (3 by 3) of three turns (cosine, sine) as SciPy names them: ZYX about current axes, xyz about those
    of the world."""
    R = np.eye(3, dtype=int)
    for letter, (c, s) in zip(convention, turns, strict=True):
        turn = rotation(UNIT[letter.lower()], c, s)
        R = R @ turn if letter.isupper() else turn @ R
    return R


def euler_angles(asked: Asked, point: Point, pose: PoseOf) -> Iterator[Test]:
    """The matrix of the sequence, and every branch put back; a singular one where it is met."""
    convention = asked.options.convention
    branches = [(_angles(each, asked), str(each["when"])) for each in asked.objects("solutions")]
    names = tuple(branches[0][0]) if branches else ()
    yield Holds("solutions", len(names) == 3, "every rotation has three Euler angles")
    yield Same("R", sequence(convention, [point.turn(sympy.Symbol(name)) for name in names]).tolist())
    places = list(_singular(asked, point, pose)) if any(_free(angles) for angles, _ in branches) else []
    for angles, when in branches:
        met = _met(asked, point, angles[names[1]], places) if _free(angles) else point
        if met is None and len(places) != FIXED:
            yield Beyond("solutions", "no point was found at which the rotation is singular")
        elif met is not None:
            again = sequence(convention, [met.turn(value) for value in angles.values()])
            near = ROUNDED if rounded(list(angles.values())) else NEAR
            said = f"the branch {_shown(angles)} is another rotation"
            yield put_back("solutions", met, again, array(pose(asked, met)[:3, :3], met), said, near)
        yield from _said(angles, when, asked, point)
    regular = sum(not _free(angles) for angles, _ in branches)
    yield Holds("solutions", regular in (0, 2), "two branches, but for a singular rotation")
    if asked.evaluated:
        yield from _in_numbers(asked, pose)


def _free(angles: Mapping[str, sympy.Expr]) -> bool:
    """Whether one of them may be anything: the branch is a singular one."""
    return any(value == sympy.Symbol(name) for name, value in angles.items())


def _said(angles: Mapping[str, sympy.Expr], when: str, asked: Asked, point: Point) -> Iterator[Test]:
    """The condition of a branch, put to the test with its angles; a singular one has its middle angle."""
    if _free(angles):
        first, _, last = asked.options.convention.lower()
        zeros = (ZERO, sympy.pi) if first == last else (sympy.pi / 2, -sympy.pi / 2)
        yield Holds("solutions", list(angles.values())[1] in zeros, f"{_shown(angles)} is not singular")
    else:
        there = Point(point.seed, False, point.angles, point.assumptions, {**point.fixed, **angles})
        met = holds(when, asked, there)
        yield Holds("solutions", met is not False, f"{when} does not hold for {_shown(angles)}")


def _in_numbers(asked: Asked, pose: PoseOf) -> Iterator[Test]:
    """The rotation where the author wants numbers, and the branches that are real there."""
    R = array(pose(asked, asked.here), asked.here)[:3, :3]
    yield Same("evaluated R", R.tolist())
    for branch in asked.objects("evaluated solutions"):
        if branch.get("real", True):
            angles = _angles(branch, asked)
            again = sequence(asked.options.convention, [asked.here.turn(angle) for angle in angles.values()])
            yield put_back("evaluated solutions", asked.here, again, R, f"{branch} is another", ROUNDED)
            if not _free(angles):
                yield from _said(angles, branch["when"], asked, asked.here)


def _angles(branch: Mapping[str, Any], asked: Asked) -> dict[str, sympy.Expr]:
    return {name: asked.read(value) for name, value in branch.items() if name not in ("when", "real")}


# -- where a rotation is singular ----------------------------------------------------------------------

FIXED = 1  # places where the entry that tells never changes
Place: TypeAlias = tuple[Point, mpmath.mpf]  # and the entry that holds the middle angle alone


def _met(asked: Asked, point: Point, middle: sympy.Expr, places: Sequence[Place]) -> Point | None:
    """The place where the rotation has this middle angle, if one is known."""
    entry, _, _ = _middle_entry(asked.options.convention)
    wanted = floating(point.at(entry.subs(MIDDLE, middle)))
    return next((there for there, value in places if abs(value - wanted) <= NEAR), None)


def _middle_entry(convention: str) -> tuple[sympy.Expr, int, int]:
    """The entry of the matrix of a sequence that holds the middle angle alone, and its row and column."""
    turns = [(sympy.cos(name), sympy.sin(name)) for name in (FIRST, MIDDLE, LAST)]
    E = sequence(convention, turns)
    i, j = next((i, j) for i, j in product(range(3), range(3)) if E[i, j].free_symbols == {MIDDLE})
    return E[i, j], i, j


def _singular(asked: Asked, point: Point, pose: PoseOf) -> Iterator[Place]:
    """The point, and places where that entry is 1 and -1 so far as some are found; the point alone where the
    entry never changes."""
    _, i, j = _middle_entry(asked.options.convention)
    entry = pose(asked, point)[i, j]
    free = entry.free_symbols if isinstance(entry, sympy.Basic) else asked.subject.variables
    found: set[int] = set()

    def row(there: Point) -> list[mpmath.mpf]:
        return [floating(each) for each in flat(list(pose(asked, there)[i, :3]), there)]

    names = sorted(map(str, free))
    yield point, row(point)[j]
    sizes = (1, 2) if isinstance(entry, sympy.Basic) else (2,)  # of an arm a pose is dear
    for there in chain(_special(point, names), _rooted(point, names, j, row, sizes)) if names else ():
        value = row(there)[j]
        if abs(abs(value) - 1) <= NEAR and int(mpmath.sign(value)) not in found:
            found.add(int(mpmath.sign(value)))
            yield there, value
        if len(found) == 2:
            return
    if names and not found:
        raise NotImplementedError("no point was found at which the rotation is singular")


def _special(point: Point, names: Sequence[str]) -> Iterator[Point]:
    """Such at which one name has a special value."""
    yield from (point.where(**{name: value}) for name in names for value in SPECIAL)


def _rooted(
    point: Point, names: Sequence[str], j: int, row: Callable[[Point], list[mpmath.mpf]], sizes: Sequence[int]
) -> Iterator[Point]:
    """Points at which the other two entries of a row of the rotation vanish: Newton in one or two names."""
    here = row(point)
    turning = [name for name in names if row(point.where(**{name: SPECIAL[1]})) != here]
    for pair in chain(*(islice(combinations(reversed(turning), size), TRIED) for size in sizes)):

        def others(values: Array, pair: tuple[str, ...] = pair) -> Array:
            there = point.in_digits().where(**dict(zip(pair, values, strict=True)))
            return np.array([each for k, each in enumerate(row(there)) if k != j], dtype=object)

        for start in STARTS:
            with suppress(ZeroDivisionError):
                if (found := _root(others, start[: len(pair)])) is not None:
                    for turn in product((0, mpmath.pi), repeat=len(pair)):
                        yield point.in_digits().where(**dict(zip(pair, found + turn, strict=True)))


def _root(of: Callable[[Array], Array], start: Sequence[str]) -> Array | None:
    """One or two numbers at which two functions vanish: Newton, by least squares."""
    x, small = np.array([mpmath.mpf(each) for each in start], dtype=object), mpmath.mpf(10) ** -30
    for _ in range(STEPS):
        value = of(x)
        if max(map(abs, value)) <= NEAR**2:
            return x
        units = np.eye(len(x), dtype=int)
        J = mpmath.matrix([list((of(x + small * unit) - value) / small) for unit in units]).T
        x = x - np.array(list(mpmath.lu_solve(J, mpmath.matrix(list(value)))), dtype=object)
    return None


def _shown(angles: Mapping[str, sympy.Expr]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in angles.items())


def euler_rates(asked: Asked, point: Point) -> Iterator[Test]:
    """omega = T times the rates: dR/dt R^T, angle by angle (R^T dR/dt in body axes)."""
    T = sympy.Matrix(asked.result("T"))
    convention, body = asked.options.convention, asked.options.frame == "body"
    angles = [sympy.Symbol(name) for name in _angle_names(asked, T)]
    R = sympy.eye(3)
    for letter, angle in zip(convention, angles, strict=True):
        turn = turned(UNIT[letter.lower()], angle)
        R = R * turn if letter.isupper() else turn * R
    turns = [R.T * R.diff(angle) if body else R.diff(angle) * R.T for angle in angles]
    rate_matrix = sympy.Matrix([vector_of(turn) for turn in turns]).T
    yield Same("T", point.each(rate_matrix))
    yield Same("det", det(point.matrix(rate_matrix.tolist())))
    omega = list(sympy.symbols("omega_x omega_y omega_z"))
    again = array(rate_matrix, point) @ array(asked.result("rates"), point)
    yield put_back("rates", point, again, omega, "T times them is not omega")
    said = [str(each["when"]) for each in asked.objects("singular")]
    right = all(each.startswith("det(") and each.endswith("= 0") for each in said)
    yield Holds("singular", right, "where det T is zero")
    told = (pair for each in asked.objects("singular") for pair in each.items() if pair[0] != "when")
    places = [(name, asked.read(value)) for name, value in told]
    for name, value in places:
        zero = det(point.where(**{name: value}).matrix(rate_matrix.tolist()))
        yield put_back("singular", point, zero, ZERO, f"det T is not zero at {name} = {value}")
    zeros = {ZERO, sympy.pi} if convention[0] == convention[2] else {sympy.pi / 2, -sympy.pi / 2}
    yield Holds("singular", {value for _, value in places} == zeros, f"det T vanishes at {zeros}")


def _angle_names(asked: Asked, T: sympy.Matrix) -> tuple[str, ...]:
    """The author's, those that a motion is by, or the first of the usual ones that are in the answer."""
    used = {symbol.name for symbol in T.free_symbols}
    given = [] if asked.options.angles is None else [tuple(asked.options.angles)]
    if isinstance(asked.subject, Motion):
        given.append(tuple(m.by.name for m in asked.subject.moves if isinstance(m.by, Symbol)))
    return next((names for names in (*given, *ANGLES) if len(names) == 3 and used <= set(names)), ANGLES[0])
