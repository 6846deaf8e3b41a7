"""What an encoder counts in a turn, and the angle of one count."""

from __future__ import annotations

from derive.expression import ONE, PI, Expr, Power, Product, Quotient, Symbol, free_symbols, number, symbols
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Absolute, Encoder, Incremental
from derive.names import named

DELTA_M, DELTA = symbols("Delta_m Delta")
TURN = Product((number(2), PI))


def counted(problem: Problem, encoder: Encoder) -> tuple[Work, Symbol | None]:
    """The working up to the angle of one count, at the motor and at the link; and the name of the gear."""
    values: dict[Expr, Expr] = {}
    formula = _counts(encoder, values, problem)
    gear = None
    if encoder.gear is not None:
        gear = named("G", encoder.gear, problem.taken)
        values[gear] = encoder.gear
    start = Work(problem, values, angular=True, taken=problem.symbols & {"N"})
    N = start.symbol("N")
    working = start.worked("N", formula, _power(encoder, formula, problem))
    first = "Delta_m" if gear else "Delta"
    shown = _over(TURN, working)
    working = working.worked(first, Quotient(TURN, N), shown)
    if gear is None:
        return working, None
    last = shown and Quotient(TURN, Product((encoder.gear or ONE, working.known[N])))
    return working.worked("Delta", Quotient(DELTA_M, gear), last), gear


def _power(encoder: Encoder, formula: Expr, problem: Problem) -> Expr | None:
    """2^b stays a power where b is a symbol; None for what is worked out."""
    disc = encoder.disc
    bits = disc.bits if isinstance(disc, Absolute) else ONE
    return Power(number(2), bits) if free_symbols(problem.final(bits)) else None


def _over(turn: Expr, working: Work) -> Expr | None:
    return (
        Quotient(turn, working.known[working.symbol("N")])
        if isinstance(working.known[working.symbol("N")], Power)
        else None
    )


def _counts(encoder: Encoder, values: dict[Expr, Expr], problem: Problem) -> Expr:
    disc = encoder.disc
    if isinstance(disc, Incremental):
        edges, lines = named("k", disc.edges, problem.taken), named("N_l", disc.lines, problem.taken)
        values |= {edges: disc.edges, lines: disc.lines}
        return Product((edges, lines))
    bits = named("b", disc.bits, problem.taken)
    values[bits] = disc.bits
    return Power(number(2), bits)
