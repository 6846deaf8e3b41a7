"""What authors write, in Typst: any text comes out as the characters it has, any formula as mathematics."""

from __future__ import annotations

import json
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st
from typst import Compiler

from derive.errors import FormulaError
from derive.render.author_text import typst_prose
from derive.render.formula.tex import boxes
from derive.render.formula.typst import in_text, typst
from derive.render.plain_text import typst_string, typst_text
from derive.sheet.tex import COMMANDS, ENVIRONMENTS, check_mathematics

SIGNS = "#$@<>\\*_`~=+-/[](){}'\".,:;!?|%&^0123 x1.\nθé\x01\x02\x1e\u2028"
TEXTS = st.lists(st.text(st.sampled_from(SIGNS), max_size=12), min_size=1, max_size=20)
TEX = st.lists(
    st.sampled_from(
        ["\\" + name for name in sorted(COMMANDS)] + [*"{}{}{}()[]^_&=+-'<>|/#@~`\",.;:!?ab1θ", r"\\", " "]
    ),
    min_size=1,
    max_size=8,
).map("".join)
SHAPES = (
    r"a \%s b", r"\%s{a + b} c", r"\%s{a}{b} c", r"x \%s\limits_{i}^{n} y", r"\%s( x",
    r"\left\%s x \right\%s",
)  # fmt: skip
ENVIRONMENT = r"\begin{%s} a & b \\ c & d \end{%s} + 1"
_MATHEMATICS = """
    accent align-point attach binom cases class frac h limits linebreak lr mat op primes root sequence
    space styled symbol text underline overline underbrace overbrace
"""
MATHEMATICS = frozenset(_MATHEMATICS.split())


def shown(source: str, selector: str) -> list[dict[str, Any]]:
    """What Typst takes a source for."""
    found: list[dict[str, Any]] = json.loads(
        Compiler(source.encode(), ignore_system_fonts=True).query(selector)
    )
    return found


def characters(node: dict[str, Any]) -> str:
    """The characters of plain content; anything else is refused."""
    match node["func"]:
        case "text" | "symbol":
            return str(node["text"])
        case "space" | "parbreak":
            return " "
        case "smartquote":
            return '"' if node.get("double", True) else "'"
        case "sequence":
            return "".join(map(characters, node["children"]))
        case other:
            raise AssertionError(f"a text became {other}")


@settings(max_examples=30, deadline=None)
@given(TEXTS)
def test_a_text_is_nothing_but_its_characters(texts: list[str]) -> None:
    source = "\n".join(f"#metadata([{typst_text(text)}]) <it>" for text in texts)
    for node, text in zip(shown(source, "<it>"), texts, strict=True):
        plain = characters(node["value"])
        wanted = "".join(char for char in text if char not in "\x01\x02\x1e")
        assert "".join(plain.split()) == "".join(wanted.split())


@settings(max_examples=30, deadline=None)
@given(TEXTS)
def test_a_string_is_itself(texts: list[str]) -> None:
    source = "\n".join(f"#metadata({typst_string(text)}) <it>" for text in texts)
    wanted = ["".join(char for char in text if char not in "\x01\x02\x1e") for text in texts]
    assert [node["value"] for node in shown(source, "<it>")] == wanted


@settings(max_examples=30, deadline=None)
@given(TEXTS)
def test_no_markdown_runs_code(texts: list[str]) -> None:
    """Markdown may make lists and emphasis; nothing else comes out of it."""
    safe = [text.replace("$", "").replace("\x01", "").replace("\x02", "") for text in texts]
    source = "\n".join(f"#metadata([{typst_prose(text)}]) <it>" for text in safe)
    for node in shown(source, "<it>"):
        assert kinds(node["value"]) <= {
            "emph", "enum", "item", "link", "list", "parbreak", "raw", "sequence", "smartquote", "space",
            "strong", "symbol", "text",
        }  # fmt: skip


def kinds(node: Any) -> set[str]:
    """The kinds of content in a piece of it."""
    if isinstance(node, list):
        return {kind for part in node for kind in kinds(part)}
    if not isinstance(node, dict):
        return set()
    own = {str(node["func"])} if "func" in node else set()
    return own | {kind for part in node.values() for kind in kinds(part)}


def allowed(formulas: list[str]) -> list[str]:
    """Those that the reader of sheets admits."""
    found = []
    for formula in formulas:
        try:
            check_mathematics(formula)
            found.append(formula)
        except FormulaError:
            continue
    return found


def require_mathematics(formulas: list[str]) -> None:
    source = "\n\n".join(f"${written(boxes(f))}$" for f in formulas for written in (typst, in_text))
    for node in shown(source, "math.equation"):
        assert kinds(node["body"]) <= MATHEMATICS


def test_every_command_that_an_author_may_write_is_known() -> None:
    shapes = [shape.replace("%s", name) for name in sorted(COMMANDS) for shape in SHAPES]
    environments = [ENVIRONMENT.replace("%s", name) for name in sorted(ENVIRONMENTS - {"array"})]
    admitted = allowed([*shapes, *environments, r"\begin{array}{cc} a & b \end{array}"])
    assert len(admitted) > 700
    require_mathematics(admitted)


@settings(max_examples=40, deadline=None)
@given(st.lists(TEX, min_size=10, max_size=30))
def test_every_formula_that_is_admitted_is_mathematics(formulas: list[str]) -> None:
    require_mathematics([*allowed(formulas), "x"])
