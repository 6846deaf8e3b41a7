"""What an encoder counts in a turn, and the angle of one count."""

from __future__ import annotations

from collections.abc import Mapping

from derive.derivation import Phrase
from derive.expression import ONE, PI, Expr, Power, Product, Symbol, free_symbols, number, symbols
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Absolute, Encoder, Incremental

DELTA_M, DELTA, OMEGA = symbols("Delta_m Delta omega")
TURN = 2 * PI
# An angle is said in degrees, a speed in degrees per second.
UNITS: Mapping[Expr | Phrase, str] = {
    **dict.fromkeys(symbols("N k N_l b b_t G n N_t n_t"), ""),
    **dict.fromkeys((DELTA_M, DELTA), "deg"),
    Symbol("T"): "s",
    OMEGA: "deg/s",
}


def counted(problem: Problem, encoder: Encoder) -> tuple[Work, Symbol | None]:
    """The work up to the angle of one count, at the motor and at the link; and the name of the gear."""
    work, formula = _counts(Work(problem, angular=True, taken=problem.symbols & {"N"}, units=UNITS), encoder)
    work = work.worked("N", formula, _power(encoder, problem))
    N = work.symbol("N")
    open_ = isinstance(work[N], Power)
    if encoder.gear is None:
        return work.worked("Delta", TURN / N, TURN / work[N] if open_ else None), None
    work, (gear,) = work.naming(G=encoder.gear)
    work = work.worked("Delta_m", TURN / N, TURN / work[N] if open_ else None)
    last = TURN / (encoder.gear * work[N]) if open_ else None
    return work.worked("Delta", DELTA_M / gear, last), gear


def _power(encoder: Encoder, problem: Problem) -> Expr | None:
    """2^b stays a power where b is a symbol; None for what is worked out."""
    disc = encoder.disc
    bits = disc.bits if isinstance(disc, Absolute) else ONE
    return number(2) ** bits if free_symbols(problem.final(bits)) else None


def _counts(work: Work, encoder: Encoder) -> tuple[Work, Expr]:
    """Edges times lines, or two to the number of bits."""
    disc = encoder.disc
    if isinstance(disc, Incremental):
        work, names = work.naming(k=disc.edges, N_l=disc.lines)
        return work, Product(names)
    work, (bits,) = work.naming(b=disc.bits)
    return work, number(2) ** bits
