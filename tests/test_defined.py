"""Define before use: every name in a formula of a page is in the question, is given, stands alone or at the
head of a formula of the same problem, or is among the conventions of the sheet."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from derive.build import derive_all
from derive.expression import Expr, Indexed, Matrix, Number, Symbol, walk
from derive.render.mentioned import Mentioned
from derive.render.names import name_latex
from derive.render.page import render_markdown
from derive.render.printed import Printed, Reading, Said
from derive.sheet.load import load_sheet
from tests.sheets import NAMES, SHEETS

KNOWN = {"pi", "t", "x", "y", "z", "0_3x3", "0_3x1"}  # time, axes, and what says itself
ENTRY = re.compile(r"[a-z]_(\d\d|[ijk]{2})")
ANY = re.compile(r"\d+|(?<=[_^])[ijk]+(-1)?|(?<=[vwc])[ijk]$")  # the index of one thing of a sort
RATE = re.compile(r"_?d?dot$")
OF_Q = re.compile(r"q_[ijk]+")


def index(tree: Expr) -> str:
    return tree.name if isinstance(tree, Symbol) else str(tree.value) if isinstance(tree, Number) else "i"


def names(tree: Expr) -> Iterator[str]:
    for node in walk(tree):
        match node:
            case Symbol(name):
                yield name.rstrip("*")
            case Indexed(base, lower, upper):
                below = "_" + "".join(map(index, lower)) if lower else ""
                yield base + below + ("^" + "".join(map(index, upper)) if upper else "")


def trees(formula: Printed) -> Iterator[tuple[bool, Expr]]:
    """Each with whether it names: the head of a chain, and all of a relation."""
    for chain in formula.chains:
        named = any(link.relation not in ("=", r"\approx") for link in chain)
        for link in chain:
            assert link.tree is not None
            yield named or link is chain[0], link.tree


def sorts(found: set[str]) -> set[str]:
    return {ANY.sub("#", RATE.sub("", name)) for name in found}


class Conventions:
    """What the head of a sheet says."""

    def __init__(self, said: list[Said]) -> None:
        told = [tree for part in said if part.question == "conventions" for each in part.printed
                for _, tree in trees(each)]  # fmt: skip
        self.names = {name for tree in told for name in names(tree)}
        self.moves = {tree.base for tree in told if isinstance(tree, Indexed)}
        self.entries = any(map(ENTRY.fullmatch, self.names))
        self.components = any(name.endswith("_x") for name in self.names)
        self.parts = any(re.fullmatch(r"R_.*\^.*", name) for name in self.names)

    def say(self, name: str) -> bool:
        base, _, lower = name.partition("_")
        return (
            (base in self.moves and lower[:1] in ("x", "y", "z"))
            or (self.entries and ENTRY.fullmatch(name) is not None)
            or (self.components and name[-2:] in ("_x", "_y", "_z"))
            or (self.parts and re.fullmatch(r"R_\w+\^\w+", name) is not None)
            or base == "sum"
        )


@pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
def test_every_name_is_defined(sheet: Path) -> None:
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None, lambda _: None)
    said: list[Said] = []

    def read(parts: Sequence[Said]) -> Reading:
        said.extend(parts)
        return Reading()

    render_markdown(document, read=read)
    conventions = Conventions(said)
    for problem in document.problems:
        texts = [problem.title, problem.text, *(each.text + each.hint for each in problem.questions)]
        typed, known = {*Mentioned.of(texts).names}, KNOWN | conventions.names
        for part in said:
            if part.question.split(".")[0] != str(problem.number):
                continue
            used = set[str]()
            for formula in part.printed:
                if not formula.chains:
                    typed |= Mentioned.of(f"${line}$" for line in formula.lines).names
                for naming, tree in trees(formula):
                    used |= {*names(tree)}
                    known |= {*names(tree)} if naming else set()
                    cells = (entry for row in tree.rows for entry in row) if isinstance(tree, Matrix) else ()
                    known |= {entry.name for entry in cells if isinstance(entry, Symbol)}
            ours = sorts(known) | sorts({*typed})
            left = {
                name for name in used - known
                if RATE.sub("", name) not in known and not conventions.say(name)
                and _bare(name) not in typed and ANY.sub("#", RATE.sub("", name)) not in ours
                and not (OF_Q.fullmatch(RATE.sub("", name)) and "q" in known)
            }  # fmt: skip
            assert not left, f"question {part.question}: {sorted(left)}"
            known |= used


def _bare(name: str) -> str:
    (found,) = Mentioned.of([f"${name_latex(name)}$"]).names or {""}
    return found
