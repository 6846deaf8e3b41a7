"""What a page has room for, and what it leaves out."""

from __future__ import annotations

from dataclasses import replace

import pytest

from derive.derivation import Derivation, PageFacts, Record, Step, Table
from derive.expression import Expr, Matrix, Symbol, add, number, symbols
from derive.render.entries import with_named_entries
from derive.render.latex import Printer
from derive.render.layout import LINE
from derive.render.notation import Notation
from derive.render.room import abridged, fits, has_room, kept

PRINTER = Printer(Notation())
A, B, C = symbols("A B C")


def long(terms: int) -> Expr:
    return add(*(Symbol(f"m_{k}") for k in range(terms)))


@pytest.mark.parametrize(("terms", "lines", "room"), [(20, 2, True), (40, 2, False), (40, 4, True)])
def test_a_sum_may_take_so_many_lines(terms: int, lines: int, room: bool) -> None:
    assert fits(long(terms), PRINTER, lines) is room


def test_a_matrix_does_not_break() -> None:
    assert fits(Matrix(((long(10), long(10)),)), PRINTER)
    assert not fits(Matrix(((long(15), long(15)),)), PRINTER)
    assert fits(Matrix(((long(12),),) * 3), PRINTER)
    assert not fits(Matrix(((long(12),),) * 6), PRINTER, lines=9)  # as long, if narrow


def test_only_spare_links_are_left_out() -> None:
    whole = (A, B, long(60))
    assert kept(Step("A", whole), PRINTER) == whole
    assert kept(Step("A", whole, spare=(whole[2],)), PRINTER) == (A, B)
    assert kept(Step("A", whole, spare=(B,)), PRINTER) == whole


def test_a_huge_link_is_not_even_printed() -> None:
    assert not fits(long(10**5), PRINTER)


def test_tables_beside_and_above() -> None:
    rows: tuple[tuple[Expr | str, ...], ...] = tuple((number(k), long(3)) for k in range(20))
    assert has_room(Table(("k", "m"), rows), PRINTER)
    assert not has_room(Table(("k", "m"), ((long(15), long(25)),)), PRINTER)
    shown = abridged(rows, 13)
    assert len(shown) == 13 and shown[-2:] == (("...", "..."), rows[-1]) and abridged(rows, 20) == rows


def test_entries_of_one_letter_are_named_together() -> None:
    names = {(0, 0): Symbol("r_11"), (0, 1): Symbol("r_12"), (1, 0): Symbol("p_x")}
    matrix = Matrix(((long(30), B), (A, number(1))))
    (_, shown), listed = with_named_entries((C, matrix), PRINTER, LINE, names)
    assert shown == Matrix(((Symbol("r_11"), Symbol("r_12")), (A, number(1))))
    assert listed == ((Symbol("r_11"), long(30)), (Symbol("r_12"), B))


class Told(PageFacts):
    G: Symbol


def test_facts_are_values_of_one_shape() -> None:
    facts = Told(G=A)
    assert replace(facts, G=B) == Told(G=B) != facts
    assert Derivation("told", (), {}, facts=facts).told(Told).G == A
    with pytest.raises(TypeError, match="told"):
        Derivation("told", (), {}).told(Told)
    assert Step("A").facts == Record()
