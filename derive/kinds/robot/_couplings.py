"""How coupled joints are written: the motions phi of the rows, their rates Gamma qdot, and the chain rule."""

from __future__ import annotations

from derive.algebra.normal import normal_matrix
from derive.derivation import Step
from derive.expression import Expr, Symbol, column
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.coupling import Coupling, Drive
from derive.mechanics.dynamics import time_derivative
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


def motion_lines(work: Work, coupling: Coupling) -> Work:
    """phi (m), phi_dot = Gamma qdot, and Gamma = dphi/dq (m by n)."""
    phi, gamma = phi_of(work.problem), gamma_of(work.problem)
    rates = (Symbol(f"{phi.name}_dot"), gamma * Symbol("q_dot"))
    work = work.line(phi, value=column(drive.by for drive in coupling.drives), rule="motions", label="phi")
    turning = column(drive.by for drive in coupling.drives)
    case: dict[Expr, Expr] = {
        rates[0]: work.readable(time_derivative(normal_matrix(turning), work.problem.subject.variables)),
        gamma: work.readable(coupling.gamma),
        Symbol("q_dot"): column(Symbol(f"{name}_dot") for name in work.problem.subject.variables),
    }
    work = work.step(Step("motion-rates", rates, "law", instance=case))
    return work.line(gamma, value=coupling.gamma, rule="motion-rates", label="Gamma")


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
