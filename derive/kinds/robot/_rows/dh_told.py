"""How the frames and the parameters of a convention are told; `dh_checks` holds it against numbers.

A parameter is the turn about an axis, or the shift along it, that leads from one thing to another.
"""

from __future__ import annotations

from dataclasses import dataclass

from derive.derivation import Phrase, Record, Said
from derive.expression import MINUS_ONE, ONE, Expr, Indexed, Product, Symbol, symbols
from derive.mechanics.assignment import Assignment
from derive.mechanics.robot import Convention

ANGLES = ("theta", "alpha")
I = Symbol("i")


def _of_frame(letter: str, index: Expr = I) -> Indexed:
    return Indexed(letter, (index,))


X, Z, O, THETA, D, A, ALPHA = map(_of_frame, ("x", "z", "o", "theta", "d", "a", "alpha"))
X_BEFORE, Z_BEFORE, O_BEFORE, A_BEFORE, ALPHA_BEFORE = (
    _of_frame(letter, I + MINUS_ONE) for letter in ("x", "z", "o", "a", "alpha")
)
Z_NEXT = _of_frame("z", I + ONE)


@dataclass(frozen=True, slots=True)
class Measured:
    """A parameter: it leads from `start` to `end`, about or along `axis`."""

    name: Indexed
    start: Indexed
    end: Indexed
    axis: Indexed

    @property
    def turns(self) -> bool:
        return self.name.base in ANGLES

    @property
    def phrase(self) -> Phrase:
        about = {"name": self.name, "start": self.start, "end": self.end, "axis": self.axis}
        return Phrase("measured-angle" if self.turns else "measured-length", about)

    @property
    def move(self) -> Phrase:
        return Phrase("turned" if self.turns else "moved", {"by": self.name, "axis": self.axis})

    @property
    def factor(self) -> Indexed:
        """Rot_{z, theta_i}."""
        return Indexed("Rot" if self.turns else "Trans", (Symbol(self.axis.base), self.name))


@dataclass(frozen=True, slots=True)
class Assigned:
    """Where frame i stands: the axis of joint i, the axes that x_i joins, and the one that o_i lies on."""

    axis: Indexed
    start: Indexed
    end: Indexed
    on: Indexed

    @property
    def phrase(self) -> Phrase:
        about: dict[str, Said] = {
            "axis": self.axis,
            "x": X,
            "start": self.start,
            "end": self.end,
            "o": O,
            "on": self.on,
            "i": I,
        }
        return Phrase("assigned", about)


MEASURED = {
    "standard": (
        Measured(THETA, X_BEFORE, X, Z_BEFORE),
        Measured(D, O_BEFORE, X, Z_BEFORE),
        Measured(A, Z_BEFORE, O, X),
        Measured(ALPHA, Z_BEFORE, Z, X),
    ),
    "modified": (
        Measured(ALPHA_BEFORE, Z_BEFORE, Z, X_BEFORE),
        Measured(A_BEFORE, Z_BEFORE, Z, X_BEFORE),
        Measured(THETA, X_BEFORE, X, Z),
        Measured(D, X_BEFORE, X, Z),
    ),
}
ASSIGNED = {
    "standard": Assigned(Z_BEFORE, Z_BEFORE, Z, Z),
    "modified": Assigned(Z, Z, Z_NEXT, Z),
}


class FrameTold(Record):
    number: int
    why: Phrase  # why it stands where it does


class Given(Record):
    """Of rows as they were given."""

    name: Phrase  # of the convention
    moves: tuple[Phrase, ...]  # from frame to frame


class Restated(Record):
    """Of rows of the other convention."""

    name: Phrase
    given: Expr  # the product of a row
    here: Expr
    shift: Phrase


class Found(Record):
    """Of frames that were assigned."""

    assigned: Phrase
    frames: tuple[FrameTold, ...]
    measured: tuple[Phrase, ...]


def given_told(convention: Convention) -> Given:
    """In the indices of row i, as all these."""
    return Given(name=Phrase(convention), moves=tuple(each.move for each in MEASURED[convention]))


def restated_told(given: Convention, here: Convention) -> Restated:
    shift = Phrase("on" if here == "modified" else "back")
    return Restated(name=Phrase(here), given=_product(given), here=_product(here), shift=shift)


def found_told(found: Assignment, convention: Convention) -> Found:
    return Found(
        assigned=ASSIGNED[convention].phrase,
        frames=frames_told(found, convention),
        measured=tuple(each.phrase for each in MEASURED[convention]),
    )


def _product(convention: Convention) -> Product:
    """Of the elementary motions of a row."""
    return Product(tuple(each.factor for each in MEASURED[convention]))


def frames_told(found: Assignment, convention: Convention) -> tuple[FrameTold, ...]:
    """How each frame came about, in the names of the axes and origins."""
    return tuple(FrameTold(number=i, why=_why(i, found, convention)) for i, _ in enumerate(found.frames))


def joins(i: int, convention: Convention) -> tuple[int, int]:
    """The two z axes that x_i joins."""
    return (i - 1, i) if convention == "standard" else (i, i + 1)


def _why(i: int, found: Assignment, convention: Convention) -> Phrase:
    a, b = joins(i, convention)
    letters = symbols(f"x_{i} z_{i} o_{i} d_{i} x_{i - 1} o_{i - 1} z_{a} z_{b}")
    about: dict[str, Said] = dict(zip(("x", "z", "o", "d", "kept", "near", "a", "b"), letters, strict=True))
    return Phrase(f"frame-{_case(i, found, convention)}", {**about, "before": i - 1})


def _case(i: int, found: Assignment, convention: Convention) -> str:
    frame, before = found.frames[i], found.frames[i - 1]
    if frame.turned:
        return "turned"
    if frame.kind == "coincident" and (frame.x, frame.o) != (before.x, before.o):
        return "coincident-near"
    return f"{frame.kind}-{convention}" if frame.kind in ("free", "end-effector", "last") else frame.kind
