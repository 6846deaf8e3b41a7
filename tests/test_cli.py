from __future__ import annotations

import json
import re
from errno import ENOSPC
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete

from derive import build as pipeline
from derive.cli import main
from derive.errors import Place, SheetError
from derive.messages import written
from tests.commands import SHEET, run


def test_a_sheet_alone_is_built(folder: Path) -> None:
    done = run("week1.yaml", "--format", "json")
    assert done.exit_code == 0, done.output
    found = json.loads((folder / "output" / "week1.json").read_text(encoding="utf-8"))
    assert found["problems"][0]["questions"][0]["find"] == "dh-table"
    assert [path.name for path in (folder / "output").iterdir()] == ["week1.json"]


def test_output_to_the_terminal(folder: Path) -> None:
    done = run("build", "week1.yaml", "--format", "json", "--output", "-")
    assert json.loads(done.stdout)["title"] == "A planar arm"
    assert not (folder / "output").exists()


def test_what_was_proved_is_explained(folder: Path) -> None:
    (folder / "week1.yaml").write_text(SHEET.replace("dh-table", "jacobian"), encoding="utf-8")
    done = run("week1.yaml", "--format", "md", "--explain")
    assert done.exit_code == 0, done.output
    lines = done.stderr.splitlines()
    assert lines[1] == "week1, question 1.1, jacobian"
    assert any(line.startswith("  second route, ") for line in lines)
    assert re.fullmatch(r"week1, the page: \d+ formulas read back", lines[-1])
    assert max(map(len, lines)) < 80
    assert run("week1.yaml", "--problems", "--explain").exit_code == 2


def test_a_directory_stands_for_its_sheets(folder: Path) -> None:
    (folder / "week2.yaml").write_text(SHEET, encoding="utf-8")
    assert run(".", "--format", "json", "--output", "built").exit_code == 0
    assert sorted(path.name for path in (folder / "built").iterdir()) == ["week1.json", "week2.json"]


def test_nothing_is_written_if_one_sheet_is_wrong(folder: Path) -> None:
    (folder / "week2.yaml").write_text(SHEET.replace("find", "fnd"), encoding="utf-8")
    done = run("week1.yaml", "week2.yaml", "--format", "json")
    assert done.exit_code == 1
    assert "week2.yaml:6:3: unknown key 'fnd'\n      fnd: dh-table\n      ^" in done.stderr
    assert "did you mean find?" in done.stderr
    assert "Traceback" not in done.output
    assert "\x1b" not in done.stderr
    assert not (folder / "output").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ("nothing.yaml",), ("week1.yaml", "--format", "odt"), ("week1.yaml", "--format", ","),
        ("week1.yaml", "--what"),
        ("week1.yaml", "--output", "-"), ("week1.yaml", "--format", "pdf", "--output", "-"), ("build",),
        ("new", "week1"), ("empty",), ("bild", "week1.yaml"), ("watch", "empty"),
        ("watch", "week1.yaml", "--output", "-"), ("watch", "week1.yaml", "--port", "8000"),
        ("watch", "week1.yaml", "--serve", "--format", "md"),
        ("watch", "week1.yaml", "--serve", "--port", "x"),
        ("week1.yaml", "second.yaml", "--format", "md", "--output", "-"),
    ],
)  # fmt: skip
def test_a_wrong_command_line(folder: Path, arguments: tuple[str, ...]) -> None:
    (folder / "empty").mkdir()
    (folder / "second.yaml").write_text(SHEET, encoding="utf-8")
    assert run(*arguments).exit_code == 2


@pytest.mark.parametrize("command", [(), ("build",), ("check",), ("watch",)])
def test_a_sheet_without_its_ending(folder: Path, command: tuple[str, ...]) -> None:
    done = run(*command, "week1")
    assert done.exit_code == 2
    assert "did you mean week1.yaml?" in done.stderr


def test_a_misspelt_command() -> None:
    assert "did you mean build?" in run("bild", "week1.yaml").stderr


@pytest.mark.parametrize(
    "arguments", [("week1.yaml", "--format", "md", "--output", "taken"), ("new", "no/x")]
)
def test_a_place_that_cannot_be_written(folder: Path, arguments: tuple[str, ...]) -> None:
    (folder / "taken").write_text("a file", encoding="utf-8")
    done = run(*arguments)
    assert done.exit_code == 1
    assert done.stderr.count("\n") == 1
    assert "derive failed" not in done.stderr


def test_two_sheets_of_one_name(folder: Path) -> None:
    (folder / "output").mkdir()
    (folder / "output" / "week1.md").write_text("an old page", encoding="utf-8")
    (folder / "week1.yml").write_text(SHEET, encoding="utf-8")
    done = run(".", "--format", "md")
    assert done.exit_code == 1
    assert "week1.yml: its pages would have the names of those of week1.yaml" in done.stderr
    assert [path.read_text() for path in (folder / "output").iterdir()] == ["an old page"]


def test_one_sheet_named_twice(folder: Path) -> None:
    assert run("week1.yaml", "./week1.yaml", str(folder / "week1.yaml"), "--format", "md").exit_code == 0


def test_letters_that_the_pdf_has_no_font_for(folder: Path) -> None:
    """The other pages are written; an older PDF would tell another story."""
    (folder / "output").mkdir()
    (folder / "output" / "week1.pdf").write_text("an old page", encoding="utf-8")
    named = SHEET.replace("problems:", "author: 王伟 and 😀\nproblems:")
    (folder / "week1.yaml").write_text(named, encoding="utf-8")
    done = run("week1.yaml", "--format", "pdf,md,json")
    assert done.exit_code == 1
    assert "week1.yaml:2:9: week1.pdf: no font of ours has 王伟😀" in done.stderr
    assert "1 fault; the other pages were written" in done.stderr
    output = folder / "output"
    assert _files(output) == ["week1.json", "week1.md", "week1/problem-1-figure.svg"]  # which the md shows
    assert run("week1.yaml", "--format", "pdf", "--output", "alone").exit_code == 1
    assert not _files(folder / "alone")
    assert run("week1.yaml", "--format", "pdf,json", "--output", "unseen").exit_code == 1
    assert _files(folder / "unseen") == ["week1.json"]


def _files(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_a_question_without_text_is_asked_all_the_same(folder: Path) -> None:
    page = run("week1.yaml", "--problems", "--format", "md", "--output", "-").stdout
    assert "Find the link parameters of the arm" in page
    asked = SHEET.replace("- robot", "- text: Fill in the table.\n  robot")
    (folder / "week1.yaml").write_text(asked, encoding="utf-8")
    page = run("week1.yaml", "--format", "md", "--output", "-").stdout
    assert "Fill in the table." in page
    assert "Find the link parameters" not in page


def test_lengths_keep_their_unit_in_the_table(folder: Path) -> None:
    (folder / "week1.yaml").write_text(SHEET.replace("d: 0,", "d: 100 mm,"), encoding="utf-8")
    page = run("week1.yaml", "--format", "md", "--output", "-").stdout
    assert "| $d_i$ [m] |" in page
    assert re.search(r"^\| \$1\$ .* \| \$0\.1\$ \| \$L\$ ", page, re.MULTILINE)


def test_a_long_line_is_cut_around_the_fault() -> None:
    text = "a" * 200 + "!" + "b" * 200
    line, caret = written(SheetError("no", Place("x.yaml", 1, 201, text))).splitlines()[1:]
    assert len(line) < 140
    assert line[caret.index("^")] == "!"


def test_a_disk_that_was_full_behind_an_accident(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        try:
            raise OSError(ENOSPC, "No space left on device")
        finally:
            raise AttributeError("'Stream' object has no attribute 'pos'")

    monkeypatch.setattr(pipeline, "load_sheet", broken)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    done = run("week1.yaml")
    assert (done.exit_code, done.stderr) == (1, "this could not be written: no space left on device\n")


def test_the_unexpected_is_an_apology(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("an accident")

    monkeypatch.setattr(pipeline, "load_sheet", broken)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    done = run("week1.yaml")
    assert done.exit_code == 1
    assert "ZeroDivisionError: an accident" in done.stderr
    assert "please report" in done.stderr
    assert "Traceback" not in done.output


def test_an_accident_says_at_which_question(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise KeyError("x")

    monkeypatch.setattr(pipeline.Working, "answer", broken)
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    assert run("week1.yaml").stderr.startswith("week1.yaml:6:9: derive failed, and should not have: KeyError")


def test_kinds() -> None:
    assert "dh-table" in run("kinds").stdout
    one = run("kinds", "dh-table").stdout
    assert "Results:" in one
    assert "Example:" in one
    wrong = run("kinds", "dh-tabel")
    assert wrong.exit_code == 1
    assert "did you mean dh-table?" in wrong.stderr


def test_new_sheet_has_a_name(folder: Path) -> None:
    assert "has no name" in run("new", "").stderr
    assert not list(folder.glob(".*"))


def test_new_sheet_builds(folder: Path) -> None:
    assert run("new", "mine", "--kind", "jacobian").exit_code == 0
    assert run("mine.yaml", "--format", "json").exit_code == 0


@pytest.mark.parametrize(
    ("typed", "begun", "offered"),
    [
        (["kinds"], "rob", {"robot"}),
        (["kinds"], "jac", {"jacobian", "jacobian-derivative"}),
        (["kinds", "motor"], "st", {"stability", "state-space", "step-response"}),
        (["new", "mine", "--kind"], "dh", {"dh-table"}),
    ],
)
def test_a_shell_completes_subjects_and_kinds(typed: list[str], begun: str, offered: set[str]) -> None:
    shell = ShellComplete(main, {}, "derive", "_DERIVE_COMPLETE")
    assert {each.value for each in shell.get_completions(typed, begun)} == offered


def test_the_tour_builds_and_its_answers_hold(folder: Path) -> None:
    assert run("new", "tour").exit_code == 0
    assert run("tour.yaml", "--format", "json").exit_code == 0
    assert "4 equal" in run("check", "tour.yaml").stdout
    first = (folder / "tour.yaml").read_text(encoding="utf-8").partition("\n")[0]
    assert first == "# yaml-language-server: $schema=derive-schema.json"
    assert (folder / "derive-schema.json").read_text(encoding="utf-8") == run("schema").stdout


def test_schema() -> None:
    schema = json.loads(run("schema").stdout)
    assert {"title", "problems", "where"} <= schema["properties"].keys()
    assert "forward-kinematics" in json.dumps(schema)
