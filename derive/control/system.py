"""A linear system as equations in the Laplace domain."""

from __future__ import annotations

from dataclasses import dataclass

from derive.control.delays import Delay
from derive.expression import Expr, Symbol, free_symbols, walk


@dataclass(frozen=True, slots=True)
class Equation:
    """left = right."""

    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class System:
    """Equations linear in their signals; `disturbance` is zero in the transfer function.

    `motor` says in words' terms which motor it is ("armature", "angle"), empty for any other. `delays` are
    those in whose place the equations have fractions, and `units` those of signals that have one.
    """

    equations: tuple[Equation, ...]
    input: Symbol
    output: Symbol
    disturbance: Symbol | None = None
    motor: tuple[str, ...] = ()
    delays: tuple[Delay, ...] = ()
    units: tuple[tuple[str, str], ...] = ()

    @property
    def names(self) -> frozenset[str]:
        """Every name in the equations: those of signals and those of parameters."""
        sides = (side for equation in self.equations for side in (equation.left, equation.right))
        return frozenset[str]().union(*map(free_symbols, sides))

    @property
    def letters(self) -> tuple[str, ...]:
        """The same in the order in which the equations have them, which products keep: K_m K_b."""
        sides = (side for equation in self.equations for side in (equation.left, equation.right))
        symbols = (node.name for side in sides for node in walk(side) if isinstance(node, Symbol))
        return tuple(dict.fromkeys(symbols))

    def unit(self, signal: Symbol) -> str:
        """That of a signal, "" where none is given."""
        return dict(self.units).get(signal.name, "")

    @property
    def defines(self) -> frozenset[str]:
        """Names of the author's that an answer may define again: all of them, as the equations do."""
        return self.names
