from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.by_mass import by_mass
from derive.algebra.readable.form import readable
from derive.algebra.readable.operation_count import operations
from derive.algebra.readable.terms import Alphabet, terms_of
from derive.expression import Expr, Sum, Symbol, multiply
from tests.trees import formula, polynomials

MASSES = tuple(map(Symbol, ("m1", "m2", "I_zz", "I2")))


def weighted() -> st.SearchStrategy[Expr]:
    """m1 (...) + m2 (...) + ..."""
    parts = st.lists(polynomials(6), min_size=len(MASSES), max_size=len(MASSES))
    return parts.map(lambda inner: Sum(tuple(map(multiply, MASSES, inner))))


@given(weighted())
def test_sums_over_masses_normalise_back(expr: Expr) -> None:
    found = normal(expr)
    assert normal(readable(found)) == found


def test_every_mass_with_what_it_multiplies() -> None:
    alphabet = Alphabet()
    groups = by_mass(terms_of(normal(formula("m1 (a + b) + I2 a + m2 b + I_zz b")), alphabet), alphabet)
    names = {str(text(alphabet.expression(atom))): len(inner) for atom, inner in groups.items()}
    assert names == {"m1": 2, "I2": 1, "I_zz + m2": 1} or names == {"m1": 2, "I2": 1, "m2 + I_zz": 1}


def test_nothing_is_grouped_where_a_term_has_no_mass() -> None:
    alphabet = Alphabet()
    assert by_mass(terms_of(normal(formula("m1 a + b")), alphabet), alphabet) == {}
    assert by_mass(terms_of(normal(formula("m1 m2 a + m1 b")), alphabet), alphabet) == {}


def test_a_long_sum_is_written_by_masses() -> None:
    """The first entry of D of a planar arm of three joints, each square as it arises."""
    typed = """
        m1 (a1 + x1)^2 + m2 (a1^2 + (a2 + x2)^2 + 2 a1 (a2 + x2) cos(t2))
        + m3 (a1^2 + a2^2 + (a3 + x3)^2 + 2 a1 a2 cos(t2) + 2 a1 (a3 + x3) cos(t2 + t3)
        + 2 a2 (a3 + x3) cos(t3)) + I1 + I2 + I3"""
    found = readable(normal(formula(typed)))
    assert normal(found) == normal(formula(typed))
    assert operations(found) <= operations(formula(typed))
    assert text(found).startswith(
        "m1*(a1 + x1)**2 + m2*(a1**2 + (a2 + x2)**2 + 2*a1*(a2 + x2)*cos(t2)) + m3*("
    )
