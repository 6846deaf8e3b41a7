"""`derive build --audit`: what is said, and what is written."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest
from click.testing import Result

from derive.audit import engine
from derive.audit.asked import Asked, Same
from derive.audit.points import Point
from tests import commands
from tests.commands import SHEET


def run(*arguments: str) -> Result:
    return commands.run("week1.yaml", "--format", "json", *arguments)


def test_the_answers_audited_are_counted(folder: Path) -> None:
    done = run("--audit")
    assert done.exit_code == 0, done.output
    assert "Audited by SymPy 1." in done.output
    assert ": 1 answer\n" in done.output
    assert (folder / "output" / "week1.json").exists()


def test_nothing_is_audited_unasked(folder: Path) -> None:
    assert "Audited" not in run().output


def test_what_is_not_audited_is_said_with_its_place(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "auditor", lambda subject, kind: None)
    done = run("--audit")
    assert done.exit_code == 0
    assert ": 0 answers\n" in done.output
    assert "not audited: week1.yaml:6:9: dh-table: nobody audits this kind yet" in done.output


def test_what_is_too_much_work_is_said(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "week1.yaml").write_text(SHEET.replace("dh-table", "jacobian"), encoding="utf-8")
    monkeypatch.setattr("derive.audit.budget.MOST", 3)
    assert "jacobian: it is too much work" in run("--audit").output


def test_what_does_not_come_to_an_end_is_a_fault(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(asked: Asked, point: Point) -> list[Same]:
        while True:
            with suppress(Exception):  # as SymPy deals with accidents of its own
                while True:
                    pass

    monkeypatch.setattr(engine, "auditor", lambda subject, kind: endless)
    monkeypatch.setattr("derive.audit.budget.SECONDS", 0.2)
    done = run("--audit")
    assert done.exit_code == 1
    assert "week1.yaml:6:9: SymPy does not come to an end with this answer" in done.output
    assert not (folder / "output").exists()


def test_a_contradiction_is_a_fault_and_nothing_is_written(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def wrong(asked: Asked, point: Point) -> list[Same]:
        return [Same("DH", [[0, 0, 0, 0]])]

    monkeypatch.setattr(engine, "auditor", lambda subject, kind: wrong)
    done = run("--audit")
    assert done.exit_code == 1
    assert "week1.yaml:6:9: SymPy contradicts this answer: DH[1][1] is theta1" in done.output
    assert not (folder / "output").exists()


def test_problems_alone_have_nothing_to_audit(folder: Path) -> None:
    assert run("--audit", "--problems").exit_code == 2
