"""What the words are told, changed in one place: such a sheet is refused, or reads as it did.

Verdicts, names and mathematics that sentences hold come from the facts of a derivation. One after the other
is turned into its opposite as the kind states it, before it claims anything."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from importlib import import_module
from pathlib import Path
from string import Formatter
from typing import Any, get_args

import pytest

from derive.derivation import PageFacts, Phrase, Record, Table
from derive.errors import SheetErrors
from derive.expression import ZERO, Expr, Relation, negate
from derive.render.phrases import lines_in
from derive.render.questions import example_of
from derive.render.skin import words_file
from tests.kinds.planting import Built

TREES = get_args(Expr)
SHARED = {each.name for each in fields(PageFacts)}
OTHER_WORDS = {"space": ("planar", "spatial", "spherical")}
OTHERS = 6  # phrases that are tried in the place of one
TRUE_ANYWAY = {  # what a sentence says then is less, or is so too
    "system.stability": "coefficients: Phrase(key='met', about={}) -> Phrase(key='open', about={})",
    **dict.fromkeys(
        ("system.transfer_function", "system.closed_loop", "system.model", "sensor.resolution"),
        "drawn: True -> False",  # its picture is left out
    ),
}
SHEETS = {
    "system.transfer_function": (
        "- system: {equations: [\"(s + 1)*x = (s + 1)*u\", \"s*y = x\"], input: u, output: y}\n"
        "  find: transfer-function\n  evaluate: true\n",
        "- motor: {control: field, output: speed}\n  find: transfer-function\n  from: T_d\n",
    ),
    "system.closed_loop": (
        "- system: {equations: [\"(s^2 + a*s)*y = u\"], input: u, output: y}\n  find: closed-loop\n"
        "  controller: PI\n",
    ),
    "system.stability": (
        "- system: {equations: [\"(s^3 + 2*s^2 + s + 2)*y = u\"], input: u, output: y}\n  find: stability\n",
        "- system: {equations: [\"(s^3 + a*s^2 + b*s + a*b)*y = u\"], input: u, output: y}\n"
        "  find: stability\n",
        "- system: {equations: [\"(s^4 + s^3 + 3*s^2 + 3*s + 5)*y = u\"], input: u, output: y}\n"
        "  find: stability\n",
        "- motor: {control: armature, output: angle}\n  find: stability\n  controller: P\n"
        "  evaluate: {J: 2, K_m: 10, R_a: 1, L_a: 1, b: 0.5, K_b: 0.1, K_p: 3}\n",
    ),
    "system.state_space": (
        "- system: {equations: [\"(s^3 + a*s^2 + 2)*y = (s^3 + 1)*u\"], input: u, output: y}\n"
        "  find: state-space\n  evaluate: {a: 2}\n",
    ),
    "system.step_response": (
        "- system: {equations: [\"s*(s + 1)*y = 3*u\"], input: u, output: y}\n  find: step-response\n"
        "  evaluate: true\n",
        "- system: {equations: [\"(s^2 + 1)*y = s*u\"], input: u, output: y}\n  find: step-response\n",
        "- system: {equations: [\"(s + 1)*y = s*u\"], input: u, output: y}\n  find: step-response\n",
    ),
    "system.model": (
        "- motor: {control: armature, output: speed}\n  find: model\n"
        "  evaluate: {J: 2, K_m: 10, R_a: 1, L_a: 1, b: 0.5, K_b: 0.1}\n",
    ),
    "profile.lspb_trajectory": (),
    "points.fit_transform": (),
    "pose.quaternion": (),
    "pose.euler_angles": (),
    "motion.rotation_matrix": (),
    "motion.equivalent_sequences": (),
    "frames.loop": (),
    "frames.transform": (),
    "function.stationary_points": (),
    "function.lagrange_multipliers": (),
    "lagrange.linearisation": (),
    "sensor.mean_voltage": (
        "- sensor: {pwm: U, low: -U, duty: D, frequency: f}\n  find: mean-voltage\n",
    ),
    "sensor.resolution": (),
    "sensor.speed": (),
    "drive.gear_ratio": (
        "- drive: {rotor: 0.002, load: 0.6, torque: 0.5, load_torque: 4}\n  find: gear-ratio\n",
    ),
    "drive.reflected_inertia": ("- drive: {rotor: 0.002, load: 0.6, gear: 20}\n  find: reflected-inertia\n",),
    "mechanism.mobility": (
        "- mechanism: {space: spatial, bodies: 4, joints: [{revolute: 4}]}\n  find: mobility\n",
        "- mechanism: {space: spatial, legs: [{chain: SPS, count: 6}]}\n  find: mobility\n",
        "- mechanism: {space: spatial, bodies: 3, joints: [{spherical: 2}, {revolute: 1}]}\n"
        "  find: mobility\n",
        "- mechanism: {space: planar, bodies: 3, joints: [{revolute: 2}]}\n  find: mobility\n",
    ),
}  # fmt: skip


def phrases(phrase: Phrase, kind: str) -> Iterator[Phrase]:
    """Other phrases of a kind that say something of the same things."""
    folder, _, name = kind.partition(".")
    lines = lines_in(words_file(folder, name))
    fields_of = {
        key: {field for _, field, *_ in Formatter().parse(words) if field} for key, words in lines.items()
    }
    alike = [key for key in fields_of if key != phrase.key and fields_of[key] == {*phrase.about}]
    yield from (replace(phrase, key=key) for key in alike[-OTHERS:])


def others(name: str, value: Any, kind: str = "") -> Iterator[Any]:
    """Values that a fact could have by mistake."""
    match value:
        case Phrase(key, about):
            yield from phrases(value, kind)
            for field, part in about.items():
                yield from (Phrase(key, {**about, field: other}) for other in others(field, part, kind))
        case bool():
            yield not value
        case int():
            yield from (value + 1, -value - 1)
        case str():
            yield from (each for each in OTHER_WORDS.get(name, (f"{value}x",)) if each != value)
        case Relation(left, sign, right):
            yield Relation(left, "<" if sign == ">" else ">", right)
        case Table(headings, rows) if rows:
            yield Table(headings, rows[:-1])
            changed = (row for row in others("", rows[-1], kind) if len(row) == len(headings))
            yield from (Table(headings, (*rows[:-1], row)) for row in changed)
        case tuple() if value:
            yield value[:-1]
            yield from ((other, *value[1:]) for other in others(name, value[0], kind))
            yield from ((*value[:-1], other) for other in others(name, value[-1], kind))
        case Record():
            for each in fields(value):
                if each.name not in SHARED:
                    for other in others(each.name, getattr(value, each.name), kind):
                        yield replace(value, **{each.name: other})
        case _ if isinstance(value, TREES) and value != ZERO:
            yield negate(value)


def sheets(kind: str) -> Iterator[str]:
    yield example_of(f"derive.kinds.{kind}")
    yield from (f"title: x\nproblems:\n{problem}" for problem in SHEETS[kind])


def _is_made_of(told: dict[str, Any], before: dict[str, Any]) -> bool:
    """Whether these are the same facts, with something added for the page when all was claimed."""
    kept = [name for name in told if not isinstance(told[name], bool | None) and told[name] != ()]
    return told == before or any(told[name] is before[name] for name in kept)


def survivors(kind: str, sheet: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Facts that a page tells wrong though it is built."""
    facts = import_module(f"derive.kinds.{kind}").Facts
    right, made = Built.of(sheet), facts.__init__
    stated: list[dict[str, Any]] = []

    def listen(self: Any, **told: Any) -> None:
        stated.append(told)
        made(self, **told)

    monkeypatch.setattr(facts, "__init__", listen)
    Built.of(sheet)
    own = [{name: value for name, value in told.items() if name not in SHARED} for told in stated]
    for place, told in enumerate(own):
        if any(_is_made_of(told, before) for before in own[:place]):
            continue
        for name, value in told.items():
            for other in others(name, value, kind):
                count = -1

                def state(
                    self: Any, *, name: str = name, other: Any = other, place: int = place, **now: Any
                ) -> None:
                    nonlocal count
                    count += 1
                    made(self, **{**now, name: other} if count == place else now)

                monkeypatch.setattr(facts, "__init__", state)
                try:
                    if Built.of(sheet).page != right.page:
                        yield f"{name}: {value} -> {other}"
                except SheetErrors:
                    continue
                except Exception:  # the words cannot be written with it
                    continue


@pytest.mark.parametrize("kind", SHEETS)
def test_a_changed_fact_is_refused(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet, found = tmp_path / "sheet.yaml", []
    for text in sheets(kind):
        sheet.write_text(text, encoding="utf-8")
        told = survivors(kind, sheet, monkeypatch)
        found += [each for each in told if not each.startswith(TRUE_ANYWAY.get(kind, "-"))]
        monkeypatch.undo()
    assert found == []
