"""A point that leaves symbols open: equal to the whole answer with the values put in, by SymPy."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import sympy
from ruamel.yaml import YAML

from derive.build import build
from derive.kinds import registry
from derive.render.questions import example_of

KINDS = [
    ("robot", "jacobian"), ("robot", "dynamics"), ("robot", "forward-kinematics"), ("robot", "velocity"),
    ("robot", "jacobian-derivative"), ("robot", "singularities"), ("motion", "transform"),
    ("motion", "velocity"), ("frames", "transform"), ("function", "gradient"),
    ("lagrange", "equations-of-motion"), ("profile", "cubic-trajectory"),
    ("system", "state-space"),
]  # fmt: skip
VALUES = ("0.3", "1", "30 deg", "0.25", "sqrt(2)", "2/3", "1.234567", "60 deg", "2")
WORDS = ("when", "case", "real")
LETTERS = {name: sympy.Symbol(name) for name in ("E", "I", "S", "N", "C", "O", "Q", "beta", "gamma", "zeta")}


def _built(data: Any, folder: Path) -> Any:
    path = folder / "sheet.yaml"
    with path.open("w", encoding="utf-8") as file:
        YAML().dump(data, file)
    return json.loads(str(build([path], ["json"], None)[0]))["problems"][0]["questions"][0]


def _flat(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    if isinstance(value, dict | list):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _flat(part, (*path, key))
    elif path[-1] not in WORDS and not isinstance(value, bool):
        yield path, value


def _tree(text: str) -> sympy.Expr:
    return sympy.sympify(text, locals=LETTERS)


@pytest.mark.parametrize(("subject", "kind"), KINDS, ids=[f"{s}-{k}" for s, k in KINDS])
def test_it_is_the_whole_answer_with_the_values_put_in(subject: str, kind: str, tmp_path: Path) -> None:
    draw = random.Random(kind)
    data = YAML().load(example_of(registry.module_name(subject, kind)))
    data["problems"] = data["problems"][:1]
    question = data["problems"][0].get("questions", data["problems"])[0]
    whole = dict(_flat(_built(data, tmp_path)["results"]))
    trees = {path: _tree(text) for path, text in whole.items() if isinstance(text, str)}
    names = sorted({str(each) for tree in trees.values() for each in tree.free_symbols} - {"s"})
    given = {name: draw.choice(VALUES) for name in draw.sample(names, max(1, len(names) // 2))}
    question["evaluate"] = given
    at = {
        sympy.Symbol(name): sympy.sympify(typed.replace(" deg", "*pi/180"), rational=True)
        for name, typed in given.items()
    }
    evaluated = dict(_flat(_built(data, tmp_path)["evaluated"]))
    assert evaluated
    for path, found in evaluated.items():
        ours = _tree(found) if isinstance(found, str) else sympy.Float(found)
        assert not {str(each) for each in ours.free_symbols} & given.keys()
        theirs = trees[path].subs(at)
        point = {
            each: sympy.Float(draw.uniform(0.4, 1.9)) for each in theirs.free_symbols | ours.free_symbols
        }
        left, right = (complex(each.subs(point).evalf()) for each in (ours, theirs))
        assert abs(left - right) < 1e-8 * (1 + abs(right)), path
