"""Units on pages, held to SymPy's system of units: what is printed has the dimension of its formula."""

from __future__ import annotations

import json
import math
import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import sympy
from sympy.physics import units as si

from derive.answers.latex import units as reader
from derive.build import derive_all
from derive.errors import SheetErrors
from derive.expression import Symbol
from derive.kinds.profile import trapezoidal_profile
from derive.kinds.robot import statics
from derive.render import numbers
from derive.render.document import Document
from derive.sheet.load import load_sheet
from derive.writing import render

BASE = (si.kilogram, si.meter, si.second, si.ampere)
SYMBOLS = dict(zip(BASE, sympy.symbols("kg m s A", positive=True), strict=True))
UNITS = {"m": si.meter, "s": si.second, "kg": si.kilogram, "N": si.newton, "J": si.joule, "Hz": si.hertz}
KNOWN = {name: si.convert_to(unit, BASE).subs(SYMBOLS) for name, unit in UNITS.items()}
KNOWN["rad"] = sympy.Integer(1)
ENDS = r"(?: &?\\qquad|\n\$\$|\n\\end\{aligned\}|\$[,:. ]| \\\\\n(?=[^&\n]*&))"
UNIT = re.compile(r"(?:\\ |\^\\circ/|\^\\circ)((?:(?:/|\\ )?\\mathrm\{[^{}]*\}(?:\^\d+)?)*)$")


def document(text: str, folder: Path) -> Document:
    path = folder / "sheet.yaml"
    path.write_text(text)
    (found,) = derive_all([load_sheet(path)], True, lambda _: None)
    return found


def unit_printed(page: str, name: str) -> str | None:
    """The unit behind the value of a name where the numbers at the point stand, as `m/s^2`; None for none."""
    sign = r" &?(?:=|\\approx) (.*?)"
    (*_, said) = re.findall(r"(?<![\w}])" + re.escape(name) + sign + ENDS, page, re.DOTALL)
    found = UNIT.search(said.strip())
    if found is None:
        return None
    spelled = re.sub(r"\\mathrm\{([^{}]*)\}", r"\1", found[1]).replace("\\ ", " ")
    return spelled if "circ" not in said[found.start() :] else f"rad/{spelled}" if spelled else "rad"


def quantity(unit: str) -> sympy.Expr:
    """A unit as a product of SymPy's."""
    above, _, below = unit.partition("/")
    return _product(above) / _product(below)


def _product(text: str) -> sympy.Expr:
    parts = (part.partition("^") for part in text.split())
    return sympy.prod(KNOWN[name] ** int(power or 1) for name, _, power in parts if name != "1")


def dimension(expr: sympy.Expr) -> tuple[float, ...]:
    """The exponents of the base units of a quantity that is not zero: by what factor it grows with each."""
    one = dict.fromkeys(SYMBOLS.values(), 1)
    return tuple(
        round(math.log2(abs(expr.subs(one | {base: 2}) / expr.subs(one))), 9) for base in SYMBOLS.values()
    )


def in_quantities(text: str, point: dict[str, tuple[float, str]]) -> sympy.Expr:
    """A result of the JSON at a point, each name with its unit."""
    letters = {name: sympy.Symbol(name) for name in point}
    expr = sympy.sympify(text, locals=letters)
    values = {letters[name]: value for name, (value, _) in point.items()}
    expr = expr.subs({call: call.subs(values) for call in expr.atoms(sympy.sin, sympy.cos)})
    return expr.subs({letters[name]: value * quantity(unit) for name, (value, unit) in point.items()})


def arms() -> Iterator[tuple[str, str, str, dict[str, tuple[float, str]]]]:
    """Kinds asked about planar arms of two turning joints, results as the page calls them, and points
    with units."""
    draw = random.Random(20)
    for _ in range(2):
        point = {name: (draw.randint(2, 9) / 10, "m") for name in ("l1", "l2")}
        point |= {name: (draw.randint(2, 12) / 10, "rad") for name in ("theta1", "theta2")}
        rates = {f"theta{k}_dot": (draw.randint(1, 5) / 2, "rad/s") for k in (1, 2)}
        loads = {"fx": (draw.randint(2, 9), "N"), "fy": (draw.randint(2, 9), "N")}
        bodies = {"m1": (2.5, "kg"), "m2": (1.5, "kg"), "g": (9.81, "m/s^2")}
        yield "velocity", "v", "v", point | rates
        yield "velocity", "omega", r"\omega", point | rates
        yield "statics", "tau", r"\tau", point | loads
        yield "gravity", "P", "P", point | bodies
        yield "gravity", "g", "g", point | bodies
        yield "energy", "K", "K", point | bodies | rates
        yield "workspace", "r_max", r"r_{\mathrm{max}}", {name: point[name] for name in ("l1", "l2")}


ARM = """
title: t
symbols: {l1: positive, l2: positive}
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0, mass: m1, com: center, inertia: point}
    - {theta: theta2*, d: 0, a: l2, alpha: 0, mass: m2, com: center, inertia: point}
    gravity: [0, -g, 0]
"""


@pytest.mark.parametrize(("kind", "name", "called", "point"), [*arms()])
def test_a_unit_has_the_dimension_of_its_formula(
    kind: str, name: str, called: str, point: dict[str, tuple[float, str]], tmp_path: Path
) -> None:
    given = ", ".join(f"{letter}: {value} {unit}" for letter, (value, unit) in point.items())
    more = "\n  force: [fx, fy]" if kind == "statics" else ""
    made = document(f"{ARM}  find: {kind}{more}\n  evaluate: {{{given}}}\n", tmp_path)
    answer = made.problems[0].questions[0].derivation
    assert answer is not None
    printed = unit_printed(render(made, "md"), called)
    results = made_results(made)[name]
    entries = [results] if isinstance(results, str) else [entry for entry in results if entry != "0"]
    assert printed
    for entry in entries:
        assert dimension(in_quantities(entry, point)) == dimension(quantity(printed)), (entry, printed)


def made_results(made: Document) -> dict[str, object]:
    found: dict[str, object] = json.loads(render(made, "json"))["problems"][0]["questions"][0]["results"]
    return found


SLIDE = "distance: 1.5 m, v_max: 1 m/s, a_max: 2 m/s^2"
MOTION = "title: t\nproblems:\n- profile: {{{}}}\n  find: {}\n"


@pytest.mark.parametrize(
    ("given", "kind", "units"),
    [
        ("distance: 90 deg, v_max: 45 deg/s, a_max: 90 deg/s^2", "trapezoidal-profile",
         {"v": "rad/s", "a": "rad/s^2", "t_3": "s"}),
        (SLIDE, "trapezoidal-profile", {"v": "m/s", "a": "m/s^2", "t_3": "s"}),
        ("from: 0, to: 30 deg, time: 2 s", "cubic-trajectory", {"a_2": "rad/s^2", "a_3": "rad/s^3"}),
        ("from: 0.1 m, to: 1.3 m, time: 2 s", "quintic-trajectory", {"a_3": "m/s^3", "a_5": "m/s^5"}),
        ("from: 6 deg, to: 0, time: 3 s, acceleration: 6 deg/s^2", "lspb-trajectory", {"v": "rad/s"}),
        ("from: 0, to: 1, time: 3", "cubic-trajectory", {"a_2": None}),
    ],
)  # fmt: skip
def test_a_motion_is_said_in_the_units_that_were_typed(
    given: str, kind: str, units: dict[str, str | None], tmp_path: Path
) -> None:
    page = render(document(MOTION.format(given, kind), tmp_path), "md")
    assert {name: unit_printed(page, name) for name in units} == units
    assert ("circ" in page) == ("deg" in given)


def test_a_wrong_unit_of_a_given_name_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = trapezoidal_profile.units_of
    wrong = {Symbol("v_M"): "m", Symbol("d"): "m/s"}
    monkeypatch.setattr(trapezoidal_profile, "units_of", lambda *given: {**right(*given), **wrong})
    with pytest.raises(SheetErrors) as refused:
        document(MOTION.format(SLIDE, "trapezoidal-profile"), tmp_path)
    assert "every line has the dimension of its name" in refused.value.errors[0].message


def test_a_wrong_unit_of_a_result_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statics, "measures", lambda robot: {"tau": "N"})
    point = "l1: 0.5 m, l2: 0.4 m, theta1: 30 deg, theta2: 60 deg, fx: 10 N, fy: -5 N"
    made = document(f"{ARM}  find: statics\n  force: [fx, fy]\n  evaluate: {{{point}}}\n", tmp_path)
    with pytest.raises(SheetErrors) as refused:
        render(made, "md")
    assert "these are not the numbers that were evaluated" in refused.value.errors[0].message


def test_torques_of_a_force_that_was_typed_with_its_unit(tmp_path: Path) -> None:
    point = "l1: 0.5 m, l2: 0.4 m, theta1: 30 deg, theta2: 60 deg"
    made = document(f"{ARM}  find: statics\n  force: [10 N, 5 N]\n  evaluate: {{{point}}}\n", tmp_path)
    assert r"\mathrm{N}\ \mathrm{m}" in render(made, "md")


@pytest.mark.parametrize(("right", "wrong"), [("m/s", "m"), ("/s", ""), ("s", "ms")])
def test_a_misprinted_unit_is_refused(
    right: str, wrong: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = MOTION.format("distance: 90 deg, v_max: 45 deg/s, a_max: 90 deg/s^2", "trapezoidal-profile")
    if right == "m/s":
        text = MOTION.format(SLIDE, "trapezoidal-profile")
    made, said = document(text, tmp_path), numbers.unit_latex
    monkeypatch.setattr("derive.render.latex.unit_latex", lambda unit: said(wrong if unit == right else unit))
    with pytest.raises(SheetErrors) as refused:
        render(made, "md")
    assert "the page says something else" in refused.value.errors[0].message


def test_the_reader_spells_a_unit_as_a_sheet_does() -> None:
    assert reader.UNIT.search("8.67 mathrm { kg } mathrm { m } ^ 2 / mathrm { s } ^ 2")


def test_columns_have_their_unit_in_the_heading(tmp_path: Path) -> None:
    given = "from: 0, to: 30 deg, time: 4 s, via: [{time: 1 s, at: 45 deg}]"
    page = render(document(MOTION.format(given, "spline-trajectory"), tmp_path), "md")
    assert "| point | $t$ [s] | $q$ [°] |" in page
    assert "| $1$ | $1$ | $45$ |" in page


def test_a_time_is_never_in_degrees_and_an_angle_is_where_they_were_typed(tmp_path: Path) -> None:
    text = MOTION.format("from: q_0, to: q_f, time: t_f, cruise: V", "lspb-trajectory")
    point = "{q_0: 0, q_f: 40 deg, t_f: 1 s, V: 60 deg/s}"
    page = render(document(f"{text}  evaluate: {point}\n", tmp_path), "md")
    said = r"t_b \approx 0.333\ \mathrm{s} \qquad a = 180^\circ/\mathrm{s}^2"
    assert said in page


@pytest.mark.parametrize(
    ("position", "said"), [(11, r"= 247.5^\circ"), (1, r"= 22.5^\circ")], ids=["tenths", "less"]
)
def test_an_angle_that_is_short_is_exact(position: int, said: str, tmp_path: Path) -> None:
    """It is a fraction of a turn, with fewer digits than numbers are rounded to."""
    text = (
        "title: A code\nproblems:\n- sensor: {encoder: absolute, bits: 4}\n"
        f"  find: gray-code\n  position: {position}\n"
    )
    assert said in render(document(text, tmp_path), "md")
