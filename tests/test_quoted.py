"""What a sentence says in mathematics is not the opposite of what is verified or typed."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from derive.build import derive_all
from derive.derivation import Phrase
from derive.errors import SheetErrors
from derive.expression import Relation, negate
from derive.quoted import OWN
from derive.render.phrases import PHRASES, lines_in
from derive.render.skin import templates
from derive.sheet.load import load_sheet

SHEET = """
title: t
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, range: [-90 deg, 120 deg]}
    - {theta: theta2*, d: 0, a: 0.7 m, alpha: 0, range: [10 deg, 150 deg]}
  where: {a1: 0.9 m}
  questions:
  - find: workspace
  - {find: singularities, rows: [vx, vy]}
"""
PLANTED = {  # a field of a phrase, and what it is made to say
    "two-links-within.lengths": lambda said: (negate(said[0]), *said[1:]),
    "within-limits.ranges": lambda said: (Relation(said[0].left, ">=", said[0].right), *said[1:]),
    "ranges.ranges": lambda said: (Relation(said[0].left, "<=", negate(said[0].right)), *said[1:]),
}


@pytest.mark.parametrize("place", PLANTED)
def test_a_wrong_formula_in_a_sentence_is_refused(
    place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(SHEET)
    sheet, made, met = load_sheet(path), Phrase.__init__, []
    where, _, name = place.partition(".")

    def planted(self: Phrase, key: str, about: Mapping[str, Any] | None = None) -> None:
        about = dict(about or {})
        if key == where and name in about:
            met.append(key)
            about[name] = PLANTED[place](about[name])
        made(self, key, about)

    derive_all([sheet], True, lambda _: None)
    monkeypatch.setattr(Phrase, "__init__", planted)
    with pytest.raises(SheetErrors, match="failed its own check"):
        derive_all([sheet], True, lambda _: None)
    assert met


def test_what_claims_hold_is_said_somewhere() -> None:
    pages = (str(path.relative_to(templates())) for path in templates().rglob("*.j2"))
    said = {key for page in pages for key in lines_in(page, PHRASES)}
    assert OWN.keys() <= said
