from __future__ import annotations

import pytest

from derive.kinds import registry

KINDS = {
    "robot": ("dynamics", "jacobian", "transform"),
    "motion": ("transform",),
    "frames": ("transform",),
    "system": ("transform",),
    "motor": ("transform",),
}


@pytest.fixture(autouse=True)
def stand_in_kinds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The kinds of `tests/sheet/kinds` in place of the real ones."""

    def kinds_of(subject: str) -> dict[str, str]:
        return {kind: f"tests.sheet.kinds.{kind}" for kind in KINDS[subject]}

    monkeypatch.setattr(registry, "kinds_of", kinds_of)
    monkeypatch.setattr(registry, "module_name", lambda subject, kind: kinds_of(subject)[kind])
