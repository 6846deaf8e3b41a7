"""How coupled joints are written: the motions phi of the rows, their rates Gamma qdot, and the chain rule."""

from __future__ import annotations

from derive.derivation import Step
from derive.expression import ZERO, Expr, Product, Symbol, column, cross, subtract
from derive.kinds.problem import Problem
from derive.mechanics.chain import Chain
from derive.mechanics.coupling import Coupling, Drive
from derive.mechanics.robot import DHRow, Robot
from derive.names import free

# What the moves of a row are, in their order.
COLUMNS = {"standard": ("theta", "d", "a", "alpha"), "modified": ("alpha", "a", "theta", "d")}


def phi_of(problem: Problem) -> Symbol:
    """The motions of the rows, one below the other."""
    return Symbol(free(problem.taken, "phi", "psi", "xi"))


def gamma_of(problem: Problem) -> Symbol:
    """Their partial derivatives by the joint variables."""
    return Symbol(free(problem.taken, "Gamma", "Psi", "Xi"))


def motion_steps(problem: Problem, coupling: Coupling) -> tuple[Step, ...]:
    """phi (m), phi_dot = Gamma qdot, and Gamma = dphi/dq (m by n)."""
    phi, gamma = phi_of(problem), gamma_of(problem)
    rates = (Symbol(f"{phi.name}_dot"), Product((gamma, Symbol("q_dot"))))
    return (
        Step("phi", (phi, column(drive.by for drive in coupling.drives)), "motions"),
        Step("motion-rates", rates, "law"),
        Step("Gamma", (gamma, problem.readable_matrix(coupling.gamma)), "motion-rates"),
    )


def drive_names(found: Chain, robot: Robot, drive: Drive) -> tuple[Symbol, Symbol]:
    """(axis, point): z or x and o of a frame in a row after Denavit and Hartenberg, k and p elsewhere."""
    i, row = drive.i, None if drive.i > len(robot.links) else robot.links[drive.i - 1].row
    if i and isinstance(row, DHRow) and not (i == 1 and robot.base):
        along_z = COLUMNS[robot.convention][drive.k] in ("theta", "d")
        frame = i - 1 if along_z == (robot.convention == "standard") else i
        return Symbol(f"{'z' if along_z else 'x'}_{frame}"), Symbol(f"o_{frame}")
    drives = found.coupling.drives if found.coupling else ()
    place = "e" if row is None else str(i)
    if sum(each.i == i for each in drives) > 1:
        place += f"_{drive.k + 1}"
    return Symbol(f"k_{place}"), Symbol(f"p_{place}")


def drive_blocks(found: Chain, robot: Robot, drive: Drive, point: Symbol, last: int) -> tuple[Expr, Expr]:
    """The linear and the angular part of the column of one motion, in the names of its vectors."""
    if drive.i > last:
        return ZERO, ZERO
    axis, o = drive_names(found, robot, drive)
    return (axis, ZERO) if drive.slides else (cross(axis, subtract(point, o)), axis)
