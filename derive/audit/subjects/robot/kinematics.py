"""Poses and velocities: forward kinematics, joint axes, Jacobians and what is made of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.linear import is_zero, solve, transposed
from derive.audit.orientation import ANGLES
from derive.audit.points import Number, Point, agree, shown
from derive.audit.putting_back import put_back
from derive.audit.subjects.robot.arm import Arm, entries, numbers
from derive.audit.subjects.robot.displacements import UNITS, modified, rotation, standard
from derive.audit.subjects.robot.series import Array, Series, diff, values
from derive.audit.subjects.robot.task import ROWS, Task
from derive.mechanics.robot import DHRow

FORCES = dict(zip(ROWS, ("fx", "fy", "fz", "mx", "my", "mz"), strict=True))


def forward_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """T_i^{i-1} and the whole pose, the tool included; of screws each of them too."""
    arm = Arm(asked, point, 1)
    links = len(arm.local)
    to = asked.options.to or links
    if asked.options.coordinates:
        place = numbers(arm.end if to == links else arm.poses[to])
        for (
            name,
            (*_, value),
        ) in zip(asked.options.coordinates, place, strict=False):
            yield Same(name, value)
        return
    if arm.robot.by_screws:
        yield from screws(arm)
    for i in range(1, to + 1):
        name = f"T_{i}^{i - 1}"
        if name != f"T_{to}^0" and (name in asked.results or not arm.robot.by_screws):
            yield Same(name, numbers(arm.local[i - 1] if i > 1 else arm.poses[1]))
    yield Same(f"T_{to}^0", numbers(arm.end if to == links else arm.poses[to]))


def screws(arm: Arm) -> Iterator[Test]:
    """M, and S_i and E_i of each joint: [S_i] is the derivative of e^{[S_i] q_i} where it is the identity."""
    if "M" in arm.asked.results:
        yield Same("M", numbers(arm.tool))
    for i, E in enumerate(arm.local, 1):
        if f"E_{i}" in arm.asked.results:
            yield Same(f"E_{i}", numbers(E))
        variable = arm.robot.links[i - 1].variable
        if f"S_{i}" in arm.asked.results and variable:
            S = diff(E, arm.robot.variables.index(variable)) @ inverse_pose(E)
            yield Same(f"S_{i}", entries(twist(S)))


def twist(S: Array) -> Array:
    """(v, w) of a matrix [S] (4 by 4)."""
    return np.array([*S[:3, 3], S[2, 1], S[0, 2], S[1, 0]], dtype=object)


def inverse_pose(T: Array) -> Array:
    """T^-1 of a displacement."""
    R, p = T[:3, :3].T, T[:3, 3]
    found = np.array([[*row, 0] for row in R] + [[0, 0, 0, 1]], dtype=object)
    found[:3, 3] = -(R @ p)
    return found


def product_of_exponentials(asked: Asked, point: Point) -> Iterator[Test]:
    """The same of an arm given by rows: the joints' axes while all of them are at zero, the pose there."""
    arm = Arm(asked, point, 1)
    yield Same(f"T_{len(arm.local)}^0", numbers(arm.end))
    if arm.robot.by_screws:
        yield from screws(arm)
        return
    if arm.robot.coupled:
        raise NotImplementedError("the screws of coupled joints are not sought")
    zero = {name: sympy.Integer(0) for name in arm.robot.variables}
    home = Arm(asked, point.where(**zero), 1)
    yield Same("M", numbers(home.end))
    whole: Array = np.eye(4, dtype=object) * 1
    for i in range(arm.n):
        S = diff(home.end, i) @ inverse_pose(home.end)
        yield Same(f"S_{i + 1}", entries(twist(S)))
        E = _exponential(values(S), arm, i)
        yield Same(f"E_{i + 1}", E.tolist())
        whole = whole @ E


def _exponential(S: Array, arm: Arm, i: int) -> Array:
    """e^{[S] q_i} of a unit screw (Lynch and Park, proposition 3.25)."""
    q = arm.q[i]
    R, v = S[:3, :3], S[:3, 3]
    found: Array = np.eye(4, dtype=object) * 1
    if not R.any():
        found[:3, 3] = v * arm.point.at(q)
        return found
    c, s = arm.point.turn(q)
    one: Array = np.eye(3, dtype=object) * 1
    found[:3, :3] = one + R * s + R @ R * (1 - c)
    pitch = np.array([S[2, 1], S[0, 2], S[1, 0]], dtype=object) @ v
    along = pitch * arm.point.at(q) if pitch else 0
    w = np.array([S[2, 1], S[0, 2], S[1, 0]], dtype=object)
    found[:3, 3] = (one - found[:3, :3]) @ np.cross(w, v) + w * along
    return found


def jacobian(asked: Asked, point: Point) -> Iterator[Test]:
    """J of the point, in the frame and with the rows asked for."""
    task = Task(Arm(asked, point, 1))
    J, options = values(task.whole), asked.options
    if options.kind == "analytic":
        J = np.vstack([J[:3], _rates(asked, point, J[3:])])
    elif options.frame == "tool":
        R = values(task.pose[:3, :3])
        J = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    names = options.rows or ROWS
    yield Same("J", J[[ROWS.index(name) for name in names]].tolist())


def _rates(asked: Asked, point: Point, angular: Array) -> Array:
    """The rates of the Euler angles that make an angular velocity (3 by n): w = T rates, and the columns of T
    are read out of dR R^T."""
    order, used = asked.options.convention, _names(asked, "J") - taken(asked)
    usual = ANGLES if asked.options.angles is None else (asked.options.angles,)
    names = next((names for names in usual if used <= set(names)), None)
    if names is None:
        raise NotImplementedError("the names of the angles are not known")
    turns = []
    for k, (axis, name) in enumerate(zip(order.lower(), names, strict=True)):
        c, s = point.turn(sympy.Symbol(name))
        change = Series({(k,): point.number(1)}, 1)
        w = np.array(UNITS[axis], dtype=object)
        turns.append(rotation((-s * change + c, c * change + s), w))
    R = turns[0] @ turns[1] @ turns[2] if order.isupper() else turns[2] @ turns[1] @ turns[0]
    columns = []
    for k in range(3):
        S = values(diff(R, k)) @ values(R).T
        columns.append([S[2, 1], S[0, 2], S[1, 0]])
    return np.array(solve(transposed(columns), angular.tolist()), dtype=object)


def _names(asked: Asked, name: str) -> set[str]:
    """The names in a result."""
    return {str(symbol) for row in asked.result(name) for entry in row for symbol in entry.free_symbols}


def statics(asked: Asked, point: Point) -> Iterator[Test]:
    """J^T F, of a force in the axes of the base, and the force in the other axes."""
    task = Task(Arm(asked, point, 1))
    force, names = asked.options.force, _loaded(task)
    if force is None:
        F = [point[_force_name(asked, name)] for name in names]
    else:
        F = [point.at(asked.formula(part)) for part in force]
    given = dict(zip(names, F, strict=True))
    wrench = np.array([given.get(name, point.number(0)) for name in ROWS], dtype=object)
    R = values(task.pose[:3, :3])
    tool, sign = asked.options.frame == "tool", -1 if asked.options.acting == "on-robot" else 1
    other = np.concatenate([(R if tool else R.T) @ half for half in (wrench[:3], wrench[3:])])
    J = values(task.whole)
    yield Same("tau", (sign * (J.T @ (other if tool else wrench))).tolist())
    if "wrench" in asked.results:
        yield Same("wrench", other.tolist())


def _loaded(task: Task) -> tuple[str, ...]:
    """The rows asked for; else as many of those that move as the force has components."""
    options = task.arm.asked.options
    if options.rows:
        return tuple(options.rows)
    moving = _moving_in_tool(task) if options.frame == "tool" else task.moving
    linear = tuple(name for name in moving if name[0] == "v")
    if options.force is None:
        return linear or moving
    n = len(options.force)
    choices = (linear, moving, ("vx", "vy"), ("vx", "vy", "vz"), ("vx", "vy", "wz"), ROWS)
    return next((names for names in choices if len(names) == n), linear)


def _moving_in_tool(task: Task) -> tuple[str, ...]:
    """The rows that are not zero in the axes of the frame that carries the point."""
    J, R = values(task.whole), values(task.pose[:3, :3])
    rows = [*(R.T @ J[:3]), *(R.T @ J[3:])]
    return tuple(name for name, row in zip(ROWS, rows, strict=True) if not all(map(is_zero, row)))


def _force_name(asked: Asked, row: str) -> str:
    """fx, or f_ex where the sheet means something else by that."""
    name = FORCES[row]
    return name if name not in taken(asked) else f"{name[0]}_e{name[1]}"


def taken(asked: Asked) -> set[str]:
    """Every name that stands in the subject or under `where`."""
    found = set(asked.where)
    pending: list[object] = [asked.subject, *asked.where.values()]
    while pending:
        part = pending.pop()
        if isinstance(part, list | tuple):
            pending.extend(part)
        elif hasattr(part, "name") and not getattr(part, "links", ()) and type(part).__name__ == "Symbol":
            found.add(part.name)
        elif slots := getattr(type(part), "__dataclass_fields__", None):
            pending.extend(getattr(part, slot) for slot in slots)
    return found


def space_jacobian(asked: Asked, point: Point) -> Iterator[Test]:
    """Column i is the twist dT/dq_i T^-1, in the frame of the end-effector T^-1 dT/dq_i."""
    arm = Arm(asked, point, 1)
    T = arm.end
    columns: list[list[Number]] = []
    for i in range(arm.n):
        dT = values(diff(T, i))
        S = dT @ values(inverse_pose(T)) if asked.options.frame == "space" else values(inverse_pose(T)) @ dT
        columns.append(twist(S).tolist())
    yield Same("J_s" if asked.options.frame == "space" else "J_b", transposed(columns))


def dh_table(asked: Asked, point: Point) -> Iterator[Test]:
    """The rows as they are given; else rows that make the same arm, between T_base and T_tool."""
    arm = Arm(asked, point, 1)
    convention = asked.options.convention or arm.robot.convention
    table = asked.result("DH")
    given = [link.row for link in arm.robot.links if isinstance(link.row, DHRow)]
    if len(given) == len(arm.robot.links) and convention == arm.robot.convention:
        for tree, row in zip(given, table, strict=True):
            typed = [arm.formula(each) for each in (tree.theta, tree.d, tree.a, tree.alpha)]
            yield put_back("DH", point, row, typed, f"a row is {typed}")
        return
    base, tool = (_fixed(asked, point, name) for name in ("T_base", "T_tool"))
    whole = base
    for theta, d, a, alpha in table:
        turns, lengths = (arm.turned(theta), arm.turned(alpha)), (arm.exact(a), arm.exact(d))
        whole = whole @ (standard if convention == "standard" else modified)(*turns, *lengths)
    end = whole @ tool
    same = all(_near(a, b) for a, b in zip(numbers(end), numbers(arm.end), strict=True))
    yield Holds("DH", same, f"the end-effector is at {shown(numbers(arm.end))}, not {shown(numbers(end))}")
    for name in ("T_base", "T_tool"):
        if name in asked.results:
            yield Holds(name, same, "the end-effector is elsewhere")


def _near(one: list[Number], other: list[Number]) -> bool:
    size = max(map(abs, other))
    return all(agree(a, b, size) for a, b in zip(one, other, strict=True))


def _fixed(asked: Asked, point: Point, name: str) -> Array:
    """A pose of the answer in numbers, the identity where there is none."""
    rows = asked.ours(name, point) if name in asked.results else np.diag([1, 1, 1, 1])
    return np.array(rows, dtype=object)
