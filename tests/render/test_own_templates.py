"""Templates of an instructor's own: they change the look and the words, and nothing that was derived."""

from __future__ import annotations

import json
import re
from pathlib import Path
from shutil import copytree

import pytest

from derive.render.sandbox import FILE
from derive.render.skin import templates
from tests.commands import run
from tests.sheets import ROOT

PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^`look/(\S+)`: [^\n]+\n\n```jinja\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
SHEET = """title: One arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: jacobian
"""
JACOBIAN = "words/robot/jacobian.j2"
EXTENDS = f'{{% extends "house/{JACOBIAN}" %}}\n'


@pytest.fixture
def look(folder: Path) -> Path:
    (folder / "arm.yaml").write_text(SHEET, encoding="utf-8")
    (folder / "look").mkdir()
    return folder / "look"


def put(look: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (look / name).parent.mkdir(parents=True, exist_ok=True)
        (look / name).write_text(text, encoding="utf-8")


def page(*options: str, kind: str = "md") -> str:
    done = run("arm.yaml", "--format", kind, "--output", "-", *options)
    assert done.exit_code == 0, done.output
    return done.stdout


def fault(look: Path, files: dict[str, str], kind: str = "md") -> str:
    """What is said of these templates, in place of a page."""
    put(look, files)
    done = run("arm.yaml", "--format", kind, "--output", "out", "--templates", "look")
    assert done.exit_code == 1
    assert not [*Path("out").glob("*.*")]
    assert "should not have" not in done.stderr
    return done.stderr


def test_the_example_of_the_docs(look: Path) -> None:
    plain = page()
    put(look, dict(EXAMPLES))
    own = page("--templates", "look")
    assert "Derive the Jacobian matrix." in own
    assert "All joints of this arm are revolute." in own
    assert "> [!NOTE]" in own
    formulas = re.compile(r"\$\$.*?\$\$", re.DOTALL)
    assert formulas.findall(own) == formulas.findall(plain) != []
    assert run("arm.yaml", "--format", "pdf", "--templates", "look").exit_code == 0
    assert json.loads(page("--templates", "look", kind="json")) == json.loads(page(kind="json"))


def test_all_of_ours_may_be_ones_own(look: Path) -> None:
    """Every template of the house works in the sandbox."""
    plain = page(kind="tex")
    copytree(templates(), look, dirs_exist_ok=True, ignore=lambda _, names: {"laws.txt"} & {*names})
    assert page("--templates", "look", kind="tex") == plain


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({JACOBIAN: "{% if %}"}, f"look/{JACOBIAN}:1:1: Expected an expression"),
        ({JACOBIAN: "\n{{ shown('J') }}"}, f"look/{JACOBIAN}:2:1: 'shown' is undefined"),
        ({JACOBIAN: "{{ facts.analytics }}"}, f"look/{JACOBIAN}:1:1: "),
        ({JACOBIAN: "Nothing."}, f"look/{JACOBIAN}:1:1: the words of jacobian neither show nor tell: "),
        ({JACOBIAN: EXTENDS + "{% block phrases %}\nall-turn\n{% endblock %}"}, f"look/{JACOBIAN}:1:1: "),
        ({JACOBIAN.replace("jac", "jak"): "x"}, f"did you mean {JACOBIAN}?"),
        (
            {"typst/furniture.typ": '\n#import "@preview/cetz:0.3.0"'},
            "look/typst/furniture.typ:2:1: packages",
        ),
        ({"laws.txt": "x"}, "look/laws.txt: the laws of the house are no template"),
        (
            {"markdown/skin.j2": "\n{% macro display(lines, w, b) %}{{ 1 / 0 }}{% endmacro %}"},
            "skin.j2:2:1: Zero",
        ),
        (
            {"markdown/skin.j2": "\n{% macro display(lines, w, b) %}{{ lines[0] | lower }}{% endmacro %}"},
            "look/markdown/skin.j2:2:1: it does not print what it is given: ",
        ),
        (
            {"markdown/page.j2": "{{ conventions }}"},
            "look/markdown/page.j2:1:1: it does not print what it is",
        ),
    ],
)
def test_a_fault_has_its_file_and_line(look: Path, files: dict[str, str], said: str) -> None:
    assert said in fault(look, files)


@pytest.mark.parametrize("typed", ["$J = 0$", "$J_{77}$"])
def test_mathematics_that_is_typed_is_held_to_the_page(look: Path, typed: str) -> None:
    ours = (templates() / JACOBIAN).read_text(encoding="utf-8")
    said = fault(look, {JACOBIAN: f"{ours}\nSo {typed}.\n"})
    assert f"look/{JACOBIAN}:{len(ours.splitlines()) + 2}:" in said
    assert "failed its own check" in said


@pytest.mark.parametrize(
    "reaching",
    [
        "{{ facts.__class__ }}",
        "{{ ''.__class__.__mro__ }}",
        "{{ show.__globals__ }}",
        "{{ '{0.__class__}'.format(facts) }}",
        "{{ '%s' % facts }}",
        "{{ (d | attr('__class__')) }}",
        "{{ ['__class__'] | map('attr', 'x') }}",
        "{{ d.told(d) }}",
        "{% include '../secret.txt' %}",
        "{% include 'link.txt' %}",
        "{% include '/etc/passwd' %}",
        "{% import 'os' as os %}",
        "{{ lipsum() }}",
    ],
)
def test_nothing_is_reached_behind_what_is_shown(look: Path, reaching: str) -> None:
    (look.parent / "secret.txt").write_text("hidden words", encoding="utf-8")
    (look / "link.txt").symlink_to("../secret.txt")
    said = fault(look, {JACOBIAN: reaching})
    assert f"look/{JACOBIAN}:1:1: " in said or "link.txt" in said
    assert "hidden" not in said


@pytest.mark.parametrize(
    "endless",
    [
        "{% for a in range(90000) %}{% for b in range(90000) %}{% endfor %}{% endfor %}",
        "{% macro a(n) %}{{ a(n + 1) }}{% endmacro %}{{ a(0) }}",
        f'{{% include "{JACOBIAN}" %}}',
        "{{ 'x' * 10000000000 }}",
        "{{ 10 ** 1000000000 }}",
        "{{ '%09999999999d' % 1 }}",
        "{% set n = namespace(x='xx') %}{% for k in range(60) %}{% set n.x = n.x ~ n.x %}{% endfor %}",
        "{% set n = namespace(x=[1]) %}{% for k in range(60) %}{% set n.x = n.x + n.x %}{% endfor %}",
        "{% set n = namespace(x=3) %}{% for k in range(60) %}{% set n.x = n.x * n.x %}{% endfor %}",
        "{% set n = namespace(x='xx') %}{% for k in range(60) %}"
        "{% set y %}{{ n.x }}{{ n.x }}{% endset %}{% set n.x = y %}{% endfor %}",
        "{{ range(90000) | map('string') | join('x' * 90000) }}",
        "{{ 'x' * 90000 | replace('x', 'x' * 90000) }}",
        "{{ 'x' | center(10000000000) }}",
        "x" * FILE + "xx",
    ],
)
def test_every_template_comes_to_an_end(look: Path, endless: str) -> None:
    assert f"look/{JACOBIAN}:1:1: " in fault(look, {JACOBIAN: endless})
