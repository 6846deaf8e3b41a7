"""A page that does not say what was derived is refused: mistakes planted into the printer and the layout."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from derive.build import build, derive_all
from derive.errors import SheetErrors
from derive.expression import (
    Degrees,
    Derivative,
    Expr,
    Matrix,
    Measured,
    Number,
    Product,
    Sum,
    Symbol,
    cos,
    number,
    sin,
    symbols,
)
from derive.read_back import MISPRINTED, read_back, reading_of
from derive.render import chain_links, entries, latex, layout, lettering, names, phrases, trig
from derive.render.document import Document
from derive.render.latex import Printer
from derive.render.notation import Notation
from derive.render.page import render_markdown
from derive.render.printed import Naming, Printed, Said, says
from derive.render.skin import Skin
from derive.sheet.load import load_sheet
from tests.sheets import ROOT

SHEETS = ("planar-2r", "kinematics", "lagrange", "mechanics-notes", "dc-motor", "week3")
Patch = Callable[[pytest.MonkeyPatch], None]


@cache
def derived(name: str) -> Document:
    (document,) = derive_all([load_sheet(ROOT / "exercises" / f"{name}.yaml")], True, lambda _: None)
    return document


@cache
def page(name: str) -> str:
    return render_markdown(derived(name), read=read_back)


def of_printer(name: str, wrong: Callable[..., Any]) -> Patch:
    """A method of the printer that does what it should with a mistake in it."""
    right = getattr(Printer, name)

    def method(self: Printer, *arguments: Any) -> Any:
        return wrong(lambda *changed: right(self, *changed), *arguments)

    return lambda patch: patch.setattr(Printer, name, method)


def of_module(module: Any, name: str, wrong: Callable[..., Any]) -> Patch:
    right = getattr(module, name)
    return lambda patch: patch.setattr(module, name, lambda *given, **more: wrong(right, *given, **more))


def of_table(table: dict[str, str], **wrong: str) -> Patch:
    def planted(patch: pytest.MonkeyPatch) -> None:
        for key, value in wrong.items():
            patch.setitem(table, key, value)

    return planted


def in_text(right: str, wrong: str) -> Callable[..., Any]:
    """Something else written in what a method gives, once."""

    def method(printed: Callable[..., Any], *arguments: Any) -> Any:
        found = printed(*arguments)
        if isinstance(found, tuple):
            return found[0].replace(right, wrong, 1), found[1]
        return found.replace(right, wrong, 1)

    return method


def flipped(printed: Callable[..., Any], *arguments: Any) -> Any:
    return printed(*arguments[::-1])


def backwards(printed: Callable[..., Any], parts: tuple[Any, ...], *others: Any) -> Any:
    return printed(parts[::-1], *others)


def transposed(printed: Callable[..., Any], rows: tuple[tuple[Expr, ...], ...]) -> Any:
    return printed(tuple(zip(*rows, strict=True)))


def unheld(right: Callable[..., str], expr: Expr, least: int) -> str:
    return right(expr, least if isinstance(expr, Derivative) else 0)  # d/dt of one needs none


def without_exponent(self: Printer, base: Expr, exponent: Expr) -> tuple[str, int]:
    return self.measured(base)


def without_last(
    right: Callable[..., layout.Display], chains: tuple[layout.Chain, ...], room: float
) -> layout.Display:
    display = right(chains, room)
    return replace(display, lines=display.lines[:-1] or display.lines)


def renamed(right: Callable[[str], Any], name: str) -> Any:
    parts = right(name)
    return replace(parts, lower=parts.upper, upper=parts.lower) if parts.upper else parts


MISTAKES: dict[str, Patch] = {
    "a minus printed as a plus": of_printer("sum", in_text(" - ", " + ")),
    "a plus printed as a minus": of_printer("sum", in_text(" + ", " - ")),
    "a term forgotten": of_printer("sum", lambda right, terms: right(terms[1:] or terms)),
    "atan2 with x first": of_printer("_atan2", flipped),
    "matrices transposed": of_printer("matrix", transposed),
    "fractions upside down": of_printer("quotient", flipped),
    "exponents forgotten": lambda patch: patch.setattr(Printer, "power", without_exponent),
    "an exponent without braces": of_module(latex, "script", lambda right, mark, inner: mark + inner),
    "parentheses forgotten": of_printer("held", unheld),
    "parentheses of functions forgotten": of_module(latex, "parenthesised", lambda right, inner: inner),
    "a leading minus forgotten": of_printer("product", in_text("-", "")),
    "factors in another order": of_printer("product", backwards),
    "a factor forgotten": of_printer("product", lambda right, factors: right(factors[:-1] or factors)),
    "numbers that run together": of_module(latex, "meet_as_numbers", lambda right, before, after: False),
    "sines for cosines": of_table(trig.SHORT, cos="s"),
    "sines for cosines, written out": of_table(latex.OPERATORS, cos=r"\sin"),
    "the inverse for the transpose": of_table(latex.MARKS, transpose="-1"),
    "a command that TeX does not know": of_table(latex.OPERATORS, sin=r"\sine"),
    "radicals forgotten": of_printer("call", in_text(r"\sqrt", "")),
    "bars forgotten": of_printer("call", in_text(r"\lvert", "(")),
    "the vector product in another order": of_printer(
        "call", lambda right, f, given: right(f, given[::-1] if f == "cross" else given)
    ),
    "joint angles by another index": of_module(
        latex, "short_index", lambda right, *given: right(*given).replace("1", "2")
    ),
    "indices in another order": of_printer(
        "indexed", lambda right, name: right(replace(name, lower=name.lower[::-1]))
    ),
    "scripts above for those below": of_module(lettering, "name_parts", renamed),
    "the inner derivative by another name": of_printer("derivative", in_text(r"\partial ", "")),
    "another unit": of_module(latex, "unit_latex", lambda right, unit: right("N" if unit == "m" else unit)),
    "no unit": of_module(latex, "unit_latex", lambda right, unit: ""),
    "degrees as numbers": of_printer("rarer", in_text(r"^\circ", "")),
    "decimals cut": of_module(
        latex, "fraction_latex", lambda right, *given, **more: right(*given, **more)[:3]
    ),
    "numbers rounded down": of_module(latex, "rounded_latex", lambda right, value, n: right(value, n - 1)),
    "a sign that a break has lost": of_module(
        layout, "_split", lambda right, *given: [part.lstrip("+- ") for part in right(*given)]
    ),
    "a term that a break has lost": of_module(layout, "pieces", lambda right, *given: right(*given)[:1]),
    "a line that a break has lost": of_module(layout, "_broken", without_last),
    "equations side by side in another order": of_module(
        layout, "_grid_lines", lambda right, chains, count: right(chains[::-1], count)
    ),
    "a format that loses a sign": of_module(Skin, "display", in_text(" - ", " + ")),
    "a format that loses a line": of_module(Skin, "display", in_text(" \\\\\n", "")),
    "another relation": of_module(phrases.Speech, "_relation", in_text(">", "<")),
    "an equal sign for what is rounded": of_module(chain_links, "is_approximate", lambda right, expr: False),
}  # fmt: skip


def unbroken(text: str) -> str:
    """A page without what breaks a display into lines: one that is not broken loses nothing."""
    return re.sub(r"\\(?:begin|end)\{aligned\}|\\\\|\\quad|&|\s", "", text)


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_of_the_printer_is_refused_wherever_it_is_seen(
    mistake: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for sheet in SHEETS:
        page(sheet)
    names.name_latex.cache_clear()
    MISTAKES[mistake](monkeypatch)
    refused, missed = [], []
    try:
        for sheet in SHEETS:
            try:
                printed = render_markdown(derived(sheet), read=read_back)
            except SheetErrors as errors:
                assert all(MISPRINTED in error.message for error in errors.errors)
                refused.append(sheet)
            else:
                missed += [sheet] if unbroken(printed) != unbroken(page(sheet)) else []
    finally:
        names.name_latex.cache_clear()
    assert refused
    assert not missed


def test_a_build_is_refused_before_anything_is_written(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    MISTAKES["a minus printed as a plus"](monkeypatch)
    for kind in ("md", "tex", "html", "pdf", "docx"):
        with pytest.raises(SheetErrors) as caught:
            build([ROOT / "exercises" / "planar-2r.yaml"], [kind], tmp_path)
        assert all(error.place is not None for error in caught.value.errors)
    assert not [*tmp_path.iterdir()]
    (page,) = build([ROOT / "exercises" / "planar-2r.yaml"], ["json"], None)
    assert page


@pytest.mark.parametrize("sheet", SHEETS)
def test_everything_on_a_page_is_read(sheet: str) -> None:
    reading = reading_of(derived(sheet))
    assert reading.read > 20
    assert not reading.unread


@pytest.mark.parametrize(
    ("latex", "why"),
    [
        (r"\M", "no command"), (r"\dot{\M}", "no command"),
        ("x^-1", "several signs"), ("x^12", "several signs"), (r"x_1_2", "stands on"),
        (r"\left( x", "closed"), (r"\frac{x}{y", "closed"), ("2 3", "side by side"),
        ("xy", "without a space"),
        (r"2 \frac{1}{2}", "side by side"), ("z", "no symbol"), (r"x + ", "ends"), (r"(x", "closed"),
        (r"\begin{bmatrix} x & y \\ x \end{bmatrix}", "equally long"), (r"x^2^2", "stands on"),
        ("y", "another"),
        (r"x = y", "one too many"), (r"\varphi", "no symbol"), (r"x \times y", "another"),
        (r"\theta 1", "no symbol"), (r"x y + \phi + c_1", "another"),
    ],
)  # fmt: skip
def test_what_tex_would_refuse_or_the_tree_does_not_say_is_refused(latex: str, why: str) -> None:
    tree = Symbol("x") * Symbol("y") + Symbol("phi") + Symbol("theta1")
    said = Said("1.1", None, (Printed.inline(latex, says(tree, latex), Notation()),))
    with pytest.raises(SheetErrors) as caught:
        read_back([said])
    assert why in caught.value.errors[0].message


@pytest.mark.parametrize(
    ("latex", "held"),
    [
        (r"\frac{120 \cdot 9^\circ}{0.01\ \mathrm{s}}", True),
        (r"\frac{120 \cdot 9^\circ}{0.01\ \mathrm{m}}", False),
        (r"\frac{120 \cdot 9^\circ}{0.01}", False),
        (r"\frac{120 \cdot 9^\circ\ \mathrm{s}}{0.01\ \mathrm{s}}", False),
    ],
)
def test_units_of_what_was_put_in_are_read(latex: str, held: bool) -> None:
    tree = 120 * Degrees(Fraction(9)) / Measured(Number(Fraction(1, 100), True), "s")
    said = [Said("1.1", None, (Printed.inline(latex, says(tree, latex), Notation()),))]
    if held:
        assert read_back(said).read == 1
    else:
        with pytest.raises(SheetErrors, match="failed its own check"):
            read_back(said)


def wide(printer: Printer) -> Said:
    """A matrix whose entries are too long for its page, as it is shown."""
    a, b, phi = symbols("a b phi")
    long = [
        Sum(tuple(Product((number(k), a, b, cos(phi), sin(phi))) for k in range(n, n + 4)))
        for n in range(2, 6)
    ]
    chain = (Symbol("D"), Matrix(((long[0], long[1]), (long[2], long[3]))))
    (shown, listed) = entries.with_named_entries(chain, printer)
    assert len(listed) == 4
    display = layout.lay_out((chain_links.chain_links(shown, printer),))
    naming = Naming(chain[0], chain[-1], shown[-1], tuple((name, tree) for name, tree in listed))
    return Said("1.1", None, (Printed.display(display, printer.notation, (naming,)),))


def test_names_of_entries_are_those_of_their_places(monkeypatch: pytest.MonkeyPatch) -> None:
    printer = Printer(Notation())
    assert read_back([wide(printer)]).read == 1
    right = entries.entry_symbol
    monkeypatch.setattr(entries, "entry_symbol", lambda letter, i, j: right(letter, j, i))
    with pytest.raises(SheetErrors) as caught:
        read_back([wide(printer)])
    assert "names of its entries" in caught.value.errors[0].message


@pytest.mark.parametrize(
    ("typed", "held"), [("c_i", True), ("c_j", False), ("a - b", True), ("a + b", False)]
)
def test_what_is_typed_stands_in_a_formula(typed: str, held: bool) -> None:
    a, b, c = symbols("a b c_i")
    shown = Printed(("c_i = 2 (a - b)",), (says(c, "c_i")[:1],), Notation())
    said = Said(
        "1.1",
        None,
        (replace(shown, chains=((*says(c, "c_i"), *_link(2 * (a - b))),)), Printed((typed,), (), Notation())),
    )
    if held:
        assert read_back([said]).typed == 1
    else:
        with pytest.raises(SheetErrors) as caught:
            read_back([said])
        assert "it was typed, and stands in no formula" in caught.value.errors[0].message


def _link(tree: Expr) -> tuple[Any, ...]:
    return says(tree, "2 (a - b)")
