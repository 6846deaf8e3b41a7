from __future__ import annotations

import re

from derive.expression import Matrix, Sum, Symbol, number
from derive.render.entries import with_named_entries
from derive.render.latex import Printer
from derive.render.layout import LINE, Link, lay_out, pieces
from derive.render.notation import Notation
from derive.render.width import width


def chain(*parts: str) -> tuple[Link, ...]:
    return tuple(Link("=", part) for part in parts)


WIDE = " + ".join(["a b c d"] * 9)


def test_what_fits_stays_on_one_line() -> None:
    assert lay_out((chain("a", "b", "c"),)).lines == ("a = b = c",)


def test_a_wide_chain_breaks_at_an_equal_sign() -> None:
    assert lay_out((chain("a", WIDE, WIDE),)).lines == (f"a &= {WIDE}", f"&= {WIDE}")


def test_equations_of_one_index_stand_in_one_row() -> None:
    column = r"\begin{bmatrix} a + b + c + d \\ 0 \\ 1 \end{bmatrix}"
    pairs = tuple(chain(f"{letter}_{k}", column) for k in range(3) for letter in "zo")
    assert [line.count("&=") for line in lay_out(pairs).lines] == [2, 2, 2]
    apart = tuple(chain(f"z_{k}", column) for k in range(6))
    assert [line.count("&=") for line in lay_out(apart).lines] == [3, 3]


def test_a_wide_sum_breaks_between_its_terms() -> None:
    display = lay_out((chain("a", " - ".join([WIDE] * 4)),))
    assert len(display.lines) > 2 and not display.wide
    assert all(line.startswith(("a &= ", r"&\quad - ", r"&\quad + ")) for line in display.lines)
    assert all(width(line.replace("&", "")) <= LINE for line in display.lines)


def test_a_wide_factor_breaks_inside_its_parentheses() -> None:
    broken = pieces(rf"m ({WIDE} + {WIDE} + \left( x + y \right))", LINE / 2)
    assert broken[0].startswith("m (") and broken[-1].endswith(r"+ \left( x + y \right))")
    assert " ".join(broken) == rf"m ({WIDE} + {WIDE} + \left( x + y \right))"


def test_a_wide_fraction_breaks_into_fractions() -> None:
    long = " ".join(["x"] * 40)
    whole = rf"\frac{{{long} + {long} - {long} + \left( x - y \right)}}{{d}}"
    assert pieces(whole, LINE) == [
        rf"\frac{{{long}}}{{d}}",
        rf"+ \frac{{{long}}}{{d}}",
        rf"- \frac{{{long} - \left( x - y \right)}}{{d}}",
    ]
    assert pieces(f"- {whole}", LINE)[1:] == [
        rf"- \frac{{{long}}}{{d}}",
        rf"+ \frac{{{long} - \left( x - y \right)}}{{d}}",
    ]
    assert pieces(rf"\frac{{{long} {long}}}{{d}}", LINE) == [rf"\frac{{{long} {long}}}{{d}}"]


def test_no_break_stands_in_parentheses_behind_tall_ones() -> None:
    tall = rf"\left( x - y \right) ({WIDE} + {WIDE})"
    assert pieces(rf"\frac{{{tall}}}{{d}}", LINE) == [rf"\frac{{{tall}}}{{d}}"]


def test_short_equations_stand_side_by_side_and_long_ones_in_a_list() -> None:
    assert lay_out((chain("a", "1"), chain("b", "2"))).lines == (r"a = 1 \qquad b = 2",)
    long = " ".join(["x y z"] * 6)
    grid = lay_out(tuple(chain(name, long) for name in "abcd")).lines
    assert grid == (rf"a &= {long} &\qquad b &= {long}", rf"c &= {long} &\qquad d &= {long}")
    assert len(lay_out(tuple(chain(name, WIDE) for name in "abcd")).lines) == 4


def test_many_columns_stand_beside_each_other() -> None:
    def column(size: int) -> str:
        return rf"\begin{{bmatrix}} {'x ' * size} \\ 0 \\ 0 \end{{bmatrix}}"

    pairs = tuple(
        chain(f"{name}_{k}", column(52 if (name, k) == ("o", 5) else 1)) for k in range(6) for name in "zo"
    )
    lines = lay_out(pairs).lines
    assert len(lines) == 3 and lines[-1].startswith("z_5 &=")
    assert [name for line in lines for name in re.findall(r"[zo]_\d", line)] == [
        each[0].latex for each in pairs
    ]
    assert all(width(line.replace("&", "")) <= LINE for line in lines)


def test_what_cannot_break_is_marked_for_scaling() -> None:
    assert lay_out((chain("a", " ".join(["x"] * 100)),)).wide


def test_a_matrix_far_too_wide_names_its_long_entries() -> None:
    a, b = Symbol("a"), Symbol("b")
    long = Sum((a, b) * 12)
    shown = (Symbol("D"), Matrix(((long, number(0)), (long, Sum((b, a) * 12)))))
    changed, entries = with_named_entries(shown, Printer(Notation()))
    d_11, d_22 = Symbol("d_11"), Symbol("d_22")
    assert changed[-1] == Matrix(((d_11, number(0)), (d_11, d_22)))
    assert [name for name, _ in entries] == [d_11, d_22]
