"""How joints move a point: what is said of their sorts, and the law of a turn."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import readable_matrix
from derive.derivation import Phrase, Said, Step
from derive.expression import ONE, ZERO, Expr, Relation, Symbol, column, cos, cross, sin, symbols
from derive.kinds.robot._chain import joint_numbers
from derive.mechanics.chain import Chain
from derive.names import free

Z, P, O, P_DOT = symbols("z p o p_dot")
RATE = (P_DOT, "=", cross(Z, P - O))  # of a point p, by a turn about z through o


def turning_law(taken: Collection[str]) -> Step:
    """p_dot = z x (p - o) of a turn about z through o, tried on a point that goes round in a circle."""
    angle, x, y, r, high = (Symbol(free(taken, f"zeta_{k}")) for k in range(1, 6))
    along = column((x + r * cos(angle), y + r * sin(angle), high))
    moved: ScalarMatrix = normal_matrix(along).diff(angle.name)
    case: dict[Expr, Expr] = {
        Z: column((ZERO, ZERO, ONE)),
        O: column((x, y, ZERO)),
        P: along,
        P_DOT: readable_matrix(moved),
    }
    return Step("turning-law", RATE[::2], "law", instance=case)


@dataclass(frozen=True, slots=True)
class Sorts:
    """The joints that move a point by how they do; where joints are coupled it is rows that move it."""

    turning: tuple[int, ...]
    helical: tuple[int, ...]
    sliding: tuple[int, ...]
    coupled: bool

    @classmethod
    def of(cls, found: Chain, last: int | None = None) -> Sorts:
        """Up to a row."""
        return cls(
            turning=joint_numbers(found, lambda joint: joint.type != "prismatic", last),
            helical=joint_numbers(found, lambda joint: bool(joint.pitch), last),
            sliding=joint_numbers(found, lambda joint: joint.type == "prismatic", last),
            coupled=found.coupling is not None,
        )

    @property
    def key(self) -> str:
        """Of what is said of them."""
        if self.coupled:
            return "coupled-rows"
        if self.turning and self.sliding:
            return "turn-or-slide"
        return "all-slide" if self.sliding else "turn-or-advance" if self.helical else "all-turn"

    @property
    def told(self) -> Phrase:
        about: dict[str, Said] = {
            "z": Z, "o": O, "p": P, "rate": Relation(*RATE), "passing": cross(O, Z),
            "turning": self.turning, "sliding": self.sliding,
        }  # fmt: skip
        return Phrase(self.key, about)

    @property
    def advancing(self) -> Phrase | None:
        """What is said of helical joints."""
        return Phrase("helical", {"helical": self.helical}) if self.helical and not self.coupled else None
