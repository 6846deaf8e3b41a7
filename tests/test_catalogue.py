"""What `derive kinds` and `derive new` say, and that the README says the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive import catalogue
from derive.kinds import registry as kinds
from derive.sheet.subjects import registry as subjects

README = Path(__file__).parent.parent / "README.md"
EVERY = sorted({kind for subject in subjects.subjects() for kind in kinds.kinds_of(subject)})


def test_the_readme_lists_the_kinds() -> None:
    _, _, rest = README.read_text(encoding="utf-8").partition("<!-- kinds")
    between = rest.partition("-->\n")[2].partition("<!-- /kinds -->")[0]
    assert between.strip() == catalogue.table().strip(), "paste the output of: derive kinds --format markdown"


@pytest.mark.parametrize("kind", EVERY)
def test_every_kind_is_described(kind: str) -> None:
    said = catalogue.describe(kind)
    assert said.startswith(f"{kind} (")
    assert "Results:" in said
    assert "Example:\n\n    title: " in said


def test_forms_of_options_in_words() -> None:
    said = catalogue.describe("jacobian")
    assert " in " in said and "  base or tool (default base)" in said
    assert "a list of: vx or vy" in said
