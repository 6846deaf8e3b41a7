"""What `derive kinds` and `derive new` say, and that the README says the same."""

from __future__ import annotations

import pytest

from derive import catalogue
from derive.errors import SheetErrors
from derive.kinds import registry as kinds
from derive.sheet.reference import reference
from derive.sheet.subjects import registry as subjects
from tests.sheets import ROOT

README = ROOT / "README.md"
LANGUAGE = ROOT / "docs" / "language.md"
EVERY = sorted({kind for subject in subjects.subjects() for kind in kinds.kinds_of(subject)})


def test_the_readme_lists_the_kinds() -> None:
    _, _, rest = README.read_text(encoding="utf-8").partition("<!-- kinds")
    between = rest.partition("-->\n")[2].partition("<!-- /kinds -->")[0]
    assert between.strip() == catalogue.table().strip(), "paste the output of: derive kinds --format markdown"


def test_the_page_on_the_language_lists_the_fields() -> None:
    _, _, rest = LANGUAGE.read_text(encoding="utf-8").partition("<!-- fields")
    between = rest.partition("-->\n")[2].partition("<!-- /fields -->")[0]
    assert between.strip() == reference().strip(), "paste the output of: derive kinds --format reference"


@pytest.mark.parametrize("kind", EVERY)
def test_every_kind_is_described(kind: str) -> None:
    said = catalogue.describe(kind)
    assert said.startswith(f"{kind} (") or kind in subjects.subjects()
    assert "Results:" in said
    assert "Example:\n\n    title: " in said


@pytest.mark.parametrize("subject", subjects.subjects())
def test_every_subject_is_described(subject: str) -> None:
    said = catalogue.describe(subject)
    assert said.startswith(f"{subject}: ")
    assert "Fields:" in said
    assert "Example:\n\n    title: " in said
    assert all(f"\n  {kind} " in said for kind in kinds.kinds_of(subject))


def test_a_kind_of_one_subject() -> None:
    assert catalogue.describe("function", "jacobian").startswith("jacobian (function)\n")
    assert "jacobian (robot)" in catalogue.describe("jacobian")
    assert "path: a line" in catalogue.describe("path") and "path (path)" in catalogue.describe("path")


@pytest.mark.parametrize(
    ("asked", "message", "hint"),
    [
        (("robto",), "there is no kind 'robto'", "did you mean robot?"),
        (("robto", "jacobian"), "there is no subject 'robto'", "did you mean robot?"),
        (("motor", "jacobian"), "there is no kind 'jacobian' for motor", "kinds for motor: "),
    ],
)
def test_what_is_not_there(asked: tuple[str, ...], message: str, hint: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        catalogue.describe(*asked)
    (error,) = caught.value.errors
    assert error.message == message
    assert error.hint.startswith(hint)


def test_forms_of_options_in_words() -> None:
    said = catalogue.describe("jacobian")
    assert " in " in said and " [base or tool (default base)]" in said
    assert "a list of: vx or vy" in said
