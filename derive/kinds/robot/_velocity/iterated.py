"""What is said of an iteration: its rows, how it ended and would go on, and the picture of its errors."""

from __future__ import annotations

from derive.derivation import Cell, Phrase, Plot, Said
from derive.expression import ZERO, Approximate, Expr, Product, Relation, Symbol, number, symbols, transpose
from derive.figures.axes import short
from derive.mechanics.iteration import CLOSE, Iteration, Row, Verdict

J, E = symbols("J e")


def ended(verdict: Verdict, newton: bool, at_once: bool) -> str:
    """How it ended; `at_once` where it could not begin."""
    match verdict:
        case "converged":
            return "converged"
        case "singular":
            return "newton-stopped-at-once" if at_once else "newton-stopped"
        case "stuck":
            return "gradient-stopped-at-once" if at_once else "gradient-stopped"
        case "diverging":
            return "newton-diverged" if newton else "gradient-diverged"
    return "not-yet"


def share(run: Iteration) -> dict[str, Said]:
    """What a step leaves of an error that is still there."""
    return {"share": Approximate(run.share)} if run.verdict == "unfinished" else {}


def stopped(verdict: Verdict, square: bool) -> Phrase | None:
    """What the Jacobian is like where an iteration cannot go on."""
    match verdict:
        case "singular":
            return Phrase("no-inverse" if square else "no-pseudo-inverse")
        case "stuck":
            return Phrase("no-slope", {"slope": Relation(Product((transpose(J), E)), "=", ZERO)})
    return None


def outlook(verdict: Verdict, newton: bool, fixed: bool) -> str:
    """What is said of how fast it goes, or would go on."""
    if verdict == "converged":
        return "quadratic" if newton else "linear"
    if newton:
        return "newton-goes-on"
    return "fixed-goes-on" if fixed else "gradient-goes-on"


def result_row(k: int, row: Row) -> tuple[Expr, ...]:
    """One row of the results."""
    error = row.error if row.error >= CLOSE else 0.0
    return (number(k), *map(Approximate, row.q), Approximate(error), Approximate(error**2 / 2))


def table_row(k: int, row: Row, bound: Expr) -> tuple[Cell, ...]:
    """One row of the table; an error that is none is below the bound, as it is said under the table."""
    error = Approximate(row.error) if row.error >= CLOSE else Phrase("error-below", {"bound": bound})
    return (number(k), *map(Approximate, row.q), error)


def error_plot(run: Iteration, newton: bool, unit: str) -> Plot:
    """The errors that the table has numbers of, on a logarithmic scale: Newton's method falls ever
    more steeply, the gradient method along a line."""
    kept = [(float(k), row.error) for k, row in enumerate(run.rows) if row.error >= CLOSE]
    counts, errors = zip(*kept, strict=True)
    about = {"steps": str(len(run.rows) - 1), "first": short(errors[0]), "last": short(run.rows[-1].error)}
    name, k = Phrase("error"), {"k": Symbol("k")}
    return Plot(
        "error", Phrase("iteration", k), Phrase("with-unit", {"name": name, "unit": unit}) if unit else name,
        {"": (counts, errors)}, counted=True, log=True, alt=Phrase("seen-errors", about),
        caption=Phrase("drawn-newton" if newton else "drawn-gradient", k),
    )  # fmt: skip
