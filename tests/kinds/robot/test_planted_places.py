"""Mistakes planted into the solutions at one place: each is refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import pytest

from derive.derivation import Claim, Phrase
from derive.expression import Number
from derive.kinds.robot._inverse import evaluated
from derive.kinds.robot._inverse.at_pose import AtPose, Configuration
from tests.kinds.robot.arms import ARMS
from tests.kinds.robot.test_inverse_poses import drawn, placed

Entries = list[dict[str, Any]]
ARMS_TRIED = ("2R", "3R", "spherical", "SCARA", "PUMA 560", "UR5")


def at_place(name: str, **more: float) -> Claim:
    arm = ARMS[name]
    place = tuple(
        (n, Number(Fraction(repr(v)))) for n, v in placed(arm, drawn(name, "random"), **more).items()
    )
    found = arm.problem().ask("inverse-kinematics", given=arm.given, evaluate=place)
    (claim,) = (each for each in found.claims if each.key == "placed")
    return claim


def one_wrong_sign(entries: Entries) -> Entries:
    first = next(each for each in entries if each.get("real", True))
    joint = next(
        name for name in reversed(first) if isinstance(first[name], float) and abs(first[name]) > 0.1
    )
    return [{**each, joint: -each[joint]} if each is first else each for each in entries]


def two_exchanged(entries: Entries) -> Entries:
    first = next(k for k, each in enumerate(entries) if each.get("real", True))
    other = first - 1 if first else 1
    whens = {first: entries[other]["when"], other: entries[first]["when"]}
    return [{**each, "when": whens.get(k, each["when"])} for k, each in enumerate(entries)]


def one_not_real(entries: Entries) -> Entries:
    first = next(each for each in entries if each.get("real", True))
    return [{"when": each["when"], "real": False} if each is first else each for each in entries]


def one_left_out(entries: Entries) -> Entries:
    return entries[1:]


def elbows_exchanged(entries: Entries) -> Entries:
    turned = {"elbow-up": Phrase("elbow-down"), "elbow-down": Phrase("elbow-up")}

    def word(each: Any) -> Any:
        return turned.get(each.key, each) if isinstance(each, Phrase) else each

    return [{**each, "when": tuple(map(word, each["when"]))} for each in entries]


@pytest.mark.parametrize("name", ARMS_TRIED)
def test_what_is_right_holds(name: str) -> None:
    claim = at_place(name)
    assert claim.holds
    assert claim.tried > 4


@pytest.mark.parametrize("name", ARMS_TRIED)
@pytest.mark.parametrize("mistake", [one_wrong_sign, two_exchanged, one_not_real, one_left_out])
def test_a_wrong_entry(
    name: str, mistake: Callable[[Entries], Entries], monkeypatch: pytest.MonkeyPatch
) -> None:
    right = evaluated.listed
    monkeypatch.setattr(evaluated, "listed", lambda *given: mistake(right(*given)))
    assert not at_place(name).holds


def test_the_elbows_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    right = evaluated.listed
    monkeypatch.setattr(evaluated, "listed", lambda *given: elbows_exchanged(right(*given)))
    assert not at_place("2R").holds


@pytest.mark.parametrize("name", [name for name in ARMS_TRIED if name != "2R"])
def test_the_values_of_the_branch_before(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    right = AtPose.configurations

    def before(self: AtPose, k: int, *given: Any) -> Iterator[Configuration]:
        return right(self, k - 1, *given)

    monkeypatch.setattr(AtPose, "configurations", before)
    assert not at_place(name).holds


def test_a_wrong_sign_where_letters_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    right, arm = evaluated._in_letters, ARMS["3R"]
    place = (("phi", Number(Fraction(1))), ("x", Number(Fraction(3, 2))))

    def asked() -> bool:
        found = arm.problem().ask("inverse-kinematics", given=arm.given, evaluate=place)
        return all(each.holds for each in found.claims if each.key == "placed")

    def turned(*given: Any) -> dict[str, Any]:
        entry = right(*given)
        return {**entry, "theta2": -entry["theta2"]}

    assert asked()
    monkeypatch.setattr(evaluated, "_in_letters", turned)
    assert not asked()
