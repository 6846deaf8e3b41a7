"""An answer about stability as it is printed, held to the equations, to determinants and to roots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.control.oracle import poles
from derive.control.oracle.equations import divides_by_s
from derive.derivation import Claim, Result, Said
from derive.expression import Symbol, free_symbols
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.system._array_checks import as_printed, is_determinant, is_of_array, minors
from derive.kinds.system._checked_array import Printed
from derive.kinds.system._oracle import Held
from derive.kinds.system._verdict_checks import changes, limit, marginal, said, sought, stable

CALLED = {
    "stable": {"is-stable"}, "unstable": {"is-unstable", "unstable-by-a-repeated-root"},
    "integrator": {"is-marginal"}, "oscillator": {"is-marginal"},
}  # fmt: skip
MOST = 12  # equations whose determinant is taken


def routes(held: Held, printed: Printed, results: Mapping[str, Result]) -> Iterator[Claim]:
    """The polynomial against the equations, the array against determinants, what is concluded against
    roots."""
    told = printed.told
    yield route("polynomial", held.compared(lambda at: is_of_array(printed, at)))
    if not divides_by_s(held.system) and len(held.system.equations) <= MOST:
        yield route("determinant", held.compared(lambda at: is_determinant(held, printed, at)))
    yield route("minors", minors(printed))
    yield route("array-as-printed", as_printed(printed))
    found = [*stable(printed)]
    if found or (printed.symbols and not told.never):
        yield route("exactly-stable", found)
    if found := [*sought(printed)]:
        yield route("stable-elsewhere", found)
    if told.never and (found := [*marginal(printed)]):
        yield route("marginally-stable", found)
    if printed.epsilon is None and (found := [*changes(printed)]):
        yield route("sign-changes-at-random", found)
    yield route(
        "as-said",
        (*said(held, printed, results), _is_polynomial(told.criterion.about.get("hidden", Symbol("s")))),
    )
    if found := [*limit(printed)]:
        yield route("limit", found)
    called = {each.key for each in told.concluded}
    if not printed.symbols:
        (_, polynomial), *_ = printed.points()
        possible = poles.possible(polynomial)
        yield route("verdict", (any(CALLED[each] & called for each in possible),))


def _is_polynomial(hidden: Said) -> bool:
    """Whether a factor that is said to be hidden is a polynomial in s, and no number."""
    return isinstance(hidden, TREES) and "s" in free_symbols(hidden)
