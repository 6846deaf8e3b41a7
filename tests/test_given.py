"""Problem sheets can be handed out: what an answer depends on stands on paper, and no answer does.

The pages are read from outside: the Markdown as it is, the PDF as `pdftotext` sees it. Every name, number and
word that is typed in a problem is looked for in the text of that problem; what is not there is changed in the
sheet, and then the answers must stay the same.
"""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import pytest
from ruamel.yaml import YAML

from derive.build import build, derive_all
from derive.derivation import Branch
from derive.errors import SheetErrors
from derive.expression import Expr, walk
from derive.kinds import registry
from derive.kinds.problem import expressions
from derive.render.document import Document
from derive.render.latex import latex
from derive.render.questions import example_of
from derive.sheet.load import load_sheet
from derive.sheet.subjects.registry import subjects
from derive.writing import render
from tests.paper import POWER, TOKEN, Paper, Text
from tests.sheets import NAMES, OUTPUT, ROOT, SHEETS

KINDS = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]
NO_DATA = {"title", "text", "hint", "marks", "answer", "figure", "given", "find", "name", "notation"}
NAMED = {"evaluate", "where", "symbols", "start", "at", "forces", "damping", "inputs"}  # whose keys are names
SHORT = 6  # nodes; m l^2, a matrix of one entry, stands in many an energy
POSE = re.compile("r[1-3][1-3]|x|y|z")  # names of the entries of a pose


def leaves(value: Any, route: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], str]]:
    """Every text typed, and the names among the keys, with the way to it."""
    if isinstance(value, dict):
        for key, part in value.items():
            if key not in NO_DATA:
                if route and route[-1] in NAMED:
                    yield (*route, None), str(key)
                yield from leaves(part, (*route, key))
    elif isinstance(value, list):
        for place, part in enumerate(value):
            yield from leaves(part, (*route, place))
    elif value is not None:
        yield route, str(value)


def problems_of(path: Path) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """The top of a sheet and its problems, robots in files of their own put in."""
    reader = YAML(typ="safe", pure=True)
    sheet = reader.load(path.read_text(encoding="utf-8").replace("\t", " "))
    problems = json.loads(json.dumps(sheet.pop("problems")))
    for problem in problems:
        if isinstance(problem.get("robot"), str):
            robot = reader.load((path.parent / problem["robot"]).read_text(encoding="utf-8"))
            problem["robot"] = json.loads(json.dumps(robot))
    return json.loads(json.dumps(sheet, default=str)), problems


def answers(sheet: dict[str, Any], problem: dict[str, Any], folder: Path) -> Any:
    """The results of a problem; None where the sheet is refused."""
    path = folder / "changed.yaml"
    path.write_text(json.dumps({**sheet, "problems": [{**problem, "figure": "false"}]}), encoding="utf-8")
    try:
        (document,) = derive_all([load_sheet(path)], True, lambda _: None, lambda _: None)
    except SheetErrors:
        return None
    found = json.loads(render(document, "json"))["problems"][0]["questions"]
    return [(each["results"], each.get("evaluated")) for each in found]


def changed(problem: dict[str, Any], route: tuple[Any, ...], found: re.Match[str]) -> dict[str, Any]:
    """The problem with another name or number in the place of one."""
    copied: dict[str, Any] = json.loads(json.dumps(problem))
    part: Any = copied
    for key in route[:-1]:
        part = part[key]
    typed, number = str(part[route[-1]]), found["number"] or "0"
    another = f"{number}1" if "." in number else str(int(number) + 1)
    group, new = ("name", f"{found['name']}_q") if found["name"] else ("number", another)
    part[route[-1]] = typed[: found.start(group)] + new + typed[found.end(group) :]
    return copied


def missing(path: Path, texts: list[Text], folder: Path) -> list[str]:
    """What an answer depends on, and the text of its problem does not say."""
    sheet, problems = problems_of(path)
    lacking = []
    for number, (problem, text) in enumerate(zip(problems, texts, strict=True), 1):
        own, before = dict(leaves(problem)), None
        whole = {**problem, "where": {**sheet.get("where", {}), **problem.get("where", {})}}
        for route, typed in leaves(whole):
            if problem.get("given") is False and route[0] in subjects():
                continue  # its author says that the figure shows it
            for found in TOKEN.finditer(POWER.sub(r"\1", typed)):
                if text.has(found) or (found["number"] and asks_for_rows(problem)):
                    continue  # where rows are wanted axes stand in their place
                if "evaluate" in route and POSE.fullmatch(found[0]) and "bmatrix" in text.text:
                    continue  # a pose stands as a matrix
                if route[-1] is not None and route in own:
                    before = before or answers(sheet, problem, folder)
                    if before == answers(sheet, changed(problem, route, found), folder):
                        continue
                lacking.append(f"problem {number}: {found[0]} of {typed!r} at {'.'.join(map(str, route))}")
        used = re.findall(r"\w+", json.dumps({**problem, "where": whole["where"], "text": ""}))
        names = [name for name in whole["where"] if used.count(name) > 1]
        lacking += [f"problem {number}: what {name} is" for name in names if not text.defines(name)]
    return lacking


def asks_for_rows(problem: dict[str, Any]) -> bool:
    """Whether the link parameters are wanted."""
    return any(each["find"] == "dh-table" for each in problem.get("questions", [problem]))


def split(page: str) -> list[Text]:
    """What a page in Markdown says of each problem, its solutions left out."""
    unsolved = re.sub(r"^#### Solution$.*?(?=^##|^---$|\Z)", "", page, flags=re.MULTILINE | re.DOTALL)
    return [*map(Text, re.split(r"^## Problem \d+", unsolved, flags=re.MULTILINE)[1:])]


def derived(path: Path) -> tuple[Document, str]:
    """A sheet with its answers, and the page of its problems."""
    (document,) = derive_all([load_sheet(path)], True, lambda _: None, lambda _: None)
    return document, render(replace(document, solutions=False), "md")


def told(path: Path, document: Document, page: str) -> list[str]:
    """The results that the page of the problems gives away: none but what the sheet itself gives."""
    dense, found = Text(page).dense, []
    for problem, whole in zip(load_sheet(path).problems, document.problems, strict=True):
        typed = {*expressions(problem.subject), *problem.where.values()}
        for question in whole.questions:
            results = question.derivation.results if question.derivation else {}
            trees = [
                (name, tree)
                for name, value in results.items()
                for tree in trees_of(value)
                if tree not in typed
            ]
            for name, tree in trees:
                if len([*walk(tree)]) > SHORT and Text(latex(tree, whole.notation)).dense in dense:
                    found.append(f"problem {whole.number}: {name}")
    return found


def trees_of(value: Any) -> Iterator[Expr]:
    if isinstance(value, get_args(Expr)):
        yield value
    elif isinstance(value, Branch):
        yield from (tree for tree in value.values.values() if isinstance(tree, get_args(Expr)))
    elif isinstance(value, tuple):
        for part in value:
            yield from trees_of(part)


@pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
def test_what_answers_depend_on_stands_on_paper(sheet: Path, tmp_path: Path) -> None:
    kept = (OUTPUT / f"{sheet.stem}.md").read_text(encoding="utf-8")  # held to the program by test_golden
    assert missing(sheet, split(kept), tmp_path) == []


@pytest.mark.parametrize(("subject", "kind"), KINDS, ids=[f"{s}-{k}" for s, k in KINDS])
def test_the_problem_of_an_example_stands_on_paper_and_its_answer_does_not(
    subject: str, kind: str, tmp_path: Path
) -> None:
    path = tmp_path / "example.yaml"
    path.write_text(example_of(registry.module_name(subject, kind)), encoding="utf-8")
    document, page = derived(path)
    assert missing(path, split(page), tmp_path) == []
    assert told(path, document, page) == []


@pytest.mark.parametrize("name", ["week2", "week3", "week4", "planar-2r", "lagrange"])
def test_no_answer_stands_on_a_problem_sheet(name: str) -> None:
    path = ROOT / "exercises" / f"{name}.yaml"
    assert told(path, *derived(path)) == []


@pytest.mark.parametrize("name", ["week4", "lagrange", "trajectories"])
def test_the_pdf_says_it_too(name: str, tmp_path: Path) -> None:
    path = ROOT / "exercises" / f"{name}.yaml"
    build([path], ["pdf"], tmp_path, problems=True)
    made = tmp_path / f"{name}-problems.pdf"
    seen = subprocess.run(
        ["pdftotext", "-layout", made, "-"], capture_output=True, text=True, check=True
    ).stdout
    assert missing(path, [*map(Paper, re.split(r"\nProblem \d+", seen)[1:])], tmp_path) == []


ARM = """\
title: A link
problems:
- text: A link of length $L$ turns by $\\theta_1$. Where is its end?
  figure: false
  {given}
  robot: {links: [{theta: theta1*, d: 0, a: L, alpha: 0}]}
  find: forward-kinematics
"""


def problem(tmp_path: Path, given: str) -> str:
    path = tmp_path / "sheet.yaml"
    path.write_text(ARM.replace("{given}", given), encoding="utf-8")
    return derived(path)[1]


def test_what_the_text_says_is_given_again_only_where_that_is_asked(tmp_path: Path) -> None:
    assert "link parameters" not in problem(tmp_path, "")
    assert "| 1 | $\\theta_1^\\ast$ | $0$ | $L$ | $0$ |" in problem(tmp_path, "given: true")
    assert "link parameters" not in problem(tmp_path, "given: false")


def test_given_is_true_or_false(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as raised:
        problem(tmp_path, "given: maybe")
    (fault,) = raised.value.errors
    assert fault.place is not None and (fault.place.line, fault.place.column) == (5, 10)


def test_an_option_of_that_name_is_one(tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    arm = ARM.replace("{given}", "given: [x, y]").replace("forward", "inverse")
    arm = arm.replace("alpha: 0}", "alpha: 0}, {theta: theta2*, d: 0, a: M, alpha: 0}")
    path.write_text(arm, encoding="utf-8")
    (only,) = load_sheet(path).problems
    assert only.given is None and only.questions[0].options.given == ("x", "y")


def test_a_screw_is_given_with_its_offset(tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    screw = "{screw: {axis: z, through: [L, 0, 0]}, variable: theta1* + 30 deg}"
    arm = ARM.replace("{given}", "given: true").replace("{theta: theta1*, d: 0, a: L, alpha: 0}", screw)
    path.write_text(arm, encoding="utf-8")
    assert "| 1 | $\\theta_1 + 30^\\circ$ | revolute | $z$-axis | $(L, 0, 0)^T$ |" in derived(path)[1]
