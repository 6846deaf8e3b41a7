"""Every field of every subject is honoured by every kind, or a fault where it stands."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, get_args

import pytest
from pydantic import BaseModel

from derive.build import build
from derive.errors import SheetErrors
from derive.kinds import registry
from derive.sheet.honoured import ignored, uses
from derive.sheet.reader import read_text
from derive.sheet.source import At
from derive.sheet.subjects.registry import load, subjects

KINDS = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]
NONE: frozenset[str] = frozenset()


def models(annotation: Any) -> Iterator[type[BaseModel]]:
    """Every model in a type."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from models(part)


def optional_fields(annotation: Any, parts: tuple[str, ...] = ()) -> Iterator[str]:
    """The names of the fields that may be left out."""
    for model in models(annotation):
        for key, field in model.model_fields.items():
            name = (*parts, field.alias or key)
            if field.is_required():
                yield from optional_fields(field.annotation, name)
            else:
                yield ".".join(name)


@pytest.mark.parametrize("subject", subjects())
def test_every_field_is_accounted_for(subject: str) -> None:
    """Harmless to leave out, or honoured by some kind; and nothing is said of fields that are none."""
    module = load(subject)
    harmless, shared = getattr(module, "HARMLESS", NONE), getattr(module, "SHARED", NONE)
    kinds = [registry.load(subject, kind) for kind in registry.kinds_of(subject)]
    fields = set(optional_fields(module.Given))
    shared_kinds = [kind for kind in kinds if len(getattr(kind, "SUBJECTS", ())) > 1]
    used = frozenset().union(*(uses(kind) for kind in kinds if kind not in shared_kinds))
    used |= fields & frozenset().union(*(uses(kind) for kind in shared_kinds))  # of any of their subjects
    assert harmless | shared | used == fields
    assert not harmless & (shared | used)
    assert shared <= used


class Novel(BaseModel):
    """A subject with a field that nobody has thought of."""

    novel: int = 0


@pytest.mark.parametrize(("subject", "kind"), KINDS)
def test_a_new_field_cannot_be_forgotten(subject: str, kind: str) -> None:
    at = At(read_text("novel: 1", Path("x.yaml")))
    question: Any = SimpleNamespace(kind=registry.load(subject, kind), find=kind)
    (fault,) = ignored((question,), subject, Novel(novel=1), at)
    assert (fault.message, str(fault.place)) == (f"'novel' is not used by {kind}", "x.yaml:1:1")


# -- what a profile is given, and what its kinds make of it -----------------------------------------------

MOTION = "from: 1 m, to: 3 m, time: 4 s, v_max: 1 m/s, a_max: 2 m/s^2"
FIELDS = {
    "start_velocity": "0.1 m/s",
    "end_velocity": "0.2 m/s",
    "start_acceleration": "0.3 m/s^2",
    "end_acceleration": "0.1 m/s^2",
    "via": "[{time: 1 s, at: 1.2 m}]",
    "cruise": "0.75 m/s",
    "acceleration": "0.75 m/s^2",
    "blend": "1 s",
}


def told(folder: Path, subject: str, *kinds: str) -> str:
    """The JSON of a sheet, or its faults."""
    sheet = folder / "x.yaml"
    asked = "\n".join(f"  - find: {kind}" for kind in kinds)
    sheet.write_text(f"title: t\nproblems:\n- {subject}\n  questions:\n{asked}\n", encoding="utf-8")
    try:
        (page,) = build([sheet], ["json"], None)
    except SheetErrors as errors:
        return "\n".join(f"{error.place}: {error.message}" for error in errors.errors)
    return str(page)


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("kind", registry.kinds_of("profile"))
def test_a_profile_is_honoured_or_refused(kind: str, field: str, tmp_path: Path) -> None:
    via = ", via: [{time: 2 s, at: 1.5 m}]" if kind == "spline-trajectory" and field != "via" else ""
    motion = MOTION.replace(" time: 4 s,", "") if kind == "minimum-time" else MOTION
    plain = told(tmp_path, f"profile: {{{motion}{via}}}", kind)
    given = told(tmp_path, f"profile: {{{motion}{via}, {field}: {FIELDS[field]}}}", kind)
    if field in uses(registry.load("profile", kind)):
        assert given.startswith("{") and given != plain
    else:
        column = len(f"- profile: {{{motion}{via}, ") + 1
        assert f"x.yaml:3:{column}: '{field}' is not used by {kind}" in given


def test_what_one_question_uses_the_others_may_leave(tmp_path: Path) -> None:
    both = "profile: {from: 0 m, to: 1 m, time: 2 s, cruise: 0.75 m/s}"
    assert told(tmp_path, both, "lspb-trajectory", "cubic-trajectory").startswith("{")
    circle = 'function: {variables: [x, y], value: x*y, subject_to: "x^2 + y^2 = 1"}'
    assert told(tmp_path, circle, "gradient", "lagrange-multipliers").startswith("{")
    assert "'subject_to' is not used by gradient" in told(tmp_path, circle, "gradient", "hessian")


ARM = "robot: {links: [{theta: q1*, d: 0, a: 1, alpha: 0}, {theta: q2*, d: 0, a: 1, alpha: 0}]}\n  find: "


@pytest.mark.parametrize(
    ("subject", "fault"),
    [
        (ARM + "jacobian\n  convention: ZYZ", "5:3: 'convention' is only used with kind: analytic"),
        (ARM + "jacobian\n  angles: [u, v, w]", "5:3: 'angles' is only used with kind: analytic"),
        (
            ARM + "numerical-inverse-kinematics\n  step: 0.1\n  target: [1, 1]\n  start: {q1: 0, q2: 1}",
            "5:3: 'step' is only used with method: gradient",
        ),
        (
            "mechanism: {space: spatial, legs: [{chain: SPS, count: 6}], rods: 6}\n  find: mobility",
            "3:63: 'rods' follows from the legs",
        ),
        (
            "robot: {links: [{screw: {axis: z}, variable: q*}], convention: modified, home: []}\n"
            "  find: forward-kinematics",
            "3:54: convention: belongs to Denavit-Hartenberg rows",
        ),
        (
            "profile: {from: 0 m, to: 1 m, time: 2 s, start_velocity: 1 m/s, via: [{time: 1 s, at: 1 m}]}\n"
            "  find: spline-trajectory\n  ends: natural",
            "5:3: natural ends are given no velocity: leave start_velocity: and end_velocity: out",
        ),
    ],
)
def test_what_belongs_to_something_else(subject: str, fault: str, tmp_path: Path) -> None:
    sheet = tmp_path / "x.yaml"
    sheet.write_text(f"title: t\nproblems:\n- {subject}\n", encoding="utf-8")
    with pytest.raises(SheetErrors) as caught:
        build([sheet], ["json"], None)
    told = [f"{error.place}: {error.message}".partition("x.yaml:")[2] for error in caught.value.errors]
    assert [one for one in told if one.startswith(fault)], told
