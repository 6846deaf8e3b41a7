"""What every kind promises: its example builds, its results bear the names it lists, its words tell all."""

from __future__ import annotations

import json
import re
from importlib import import_module
from pathlib import Path

import pytest

from derive.build import derive_all
from derive.derivation import Branch
from derive.errors import SheetError
from derive.kinds import registry
from derive.render.questions import example_of, results_of
from derive.sheet.load import load_sheet
from derive.sheet.subjects.registry import subjects
from derive.writing import render
from tests.kinds.planting import Planting, lines, printed_wrong, results, values

KINDS = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]
MODULES = sorted({registry.module_name(subject, kind) for subject, kind in KINDS})
every_kind = pytest.mark.parametrize(("subject", "kind"), KINDS, ids=[f"{s}-{k}" for s, k in KINDS])
WORDS = Path(__file__).parents[2] / "templates" / "words"


@pytest.fixture
def document(subject: str, kind: str, tmp_path: Path):
    """The example of a kind, built."""
    path = tmp_path / "example.yaml"
    path.write_text(example_of(registry.module_name(subject, kind)), encoding="utf-8")
    warned: list[SheetError] = []
    sheet = load_sheet(path)
    (built,) = derive_all([sheet], True, lambda _: None, warned.append)
    assert not [each.message for each in (*sheet.warnings, *warned)]
    return built


def pattern(listed: str) -> re.Pattern[str]:
    """`T_1^0, T_2^1, ...` as a pattern: any number may stand for a number or for n."""
    names = [name for name in listed.split(", ") if name != "..."]
    texts = [re.sub(r"\d+|(?<=_)n(?=\\)", r"\\d+", re.escape(name)) for name in names]
    return re.compile("|".join(texts))


def test_every_subject_has_kinds_and_every_kind_a_subject() -> None:
    assert all(registry.kinds_of(subject) for subject in subjects())
    files = [path for path in registry.KINDS.glob("*/*.py") if path.name[0] != "_"]
    assert {subject for path in files for subject in registry.serves(path)} == set(subjects())
    answers = [(subject, path.stem) for path in files for subject in registry.serves(path)]
    assert len(answers) == len(set(answers)), "two modules answer the same question"


@pytest.mark.parametrize("module", MODULES)
def test_the_subjects_of_a_kind_can_be_read_from_its_text(module: str) -> None:
    loaded = import_module(module)
    path = Path(loaded.__file__ or "")
    assert registry.serves(path) == getattr(loaded, "SUBJECTS", (path.parent.name,))


@every_kind
def test_the_example_is_of_this_kind_and_its_claims_hold(document, kind: str) -> None:
    derivations = [question.derivation for _, question in document.questions()]
    assert kind in {derivation.kind for derivation in derivations if derivation}
    assert all(claim.holds for derivation in derivations for claim in derivation.claims)


@every_kind
def test_a_law_or_an_independent_route_of_its_own_proves_it(document, kind: str) -> None:
    own = [question.derivation for _, question in document.questions() if question.derivation.kind == kind]
    assert any(not claim.link for derivation in own for claim in derivation.claims)


@pytest.mark.parametrize("module", MODULES)
def test_it_declares_its_claims(module: str) -> None:
    loaded = import_module(module)
    assert hasattr(loaded, "CLAIMS") or hasattr(loaded, "claims_of")


@every_kind
def test_its_laws_are_tried_in_an_instance(document, kind: str) -> None:
    untried = {
        step.name
        for _, question in document.questions()
        for step in question.derivation.all_steps()
        if question.derivation.kind == kind and step.rule == "law" and len(step.chain) > 1
        if not step.instance
    }
    assert untried == set()


@pytest.mark.parametrize("planting", [values, lines, results])
@pytest.mark.parametrize("module", MODULES)
def test_a_wrong_sign_is_refused(module: str, planting: Planting, tmp_path: Path) -> None:
    sheet = tmp_path / "example.yaml"
    sheet.write_text(example_of(module), encoding="utf-8")
    assert printed_wrong(planting, sheet) == set(), (
        "printed under 'Verified' with a wrong sign: see 'What proves an answer' in CONTRIBUTING.md"
    )


@every_kind
def test_results_bear_the_names_that_are_listed(document, subject: str, kind: str) -> None:
    listed = [pattern(name) for name in results_of(registry.module_name(subject, kind))]
    for _, question in document.questions():
        if question.derivation.kind == kind:
            names = question.derivation.results
            unlisted = [name for name in names if not any(each.fullmatch(name) for each in listed)]
            assert unlisted == []


@every_kind
def test_every_format_of_text_is_rendered(document) -> None:
    markdown, latex, results = (render(document, kind) for kind in ("md", "tex", "json"))
    assert "$" in markdown
    assert latex.count(r"\begin{") == latex.count(r"\end{")
    assert json.loads(results)["title"] == document.title


@every_kind
def test_solutions_say_when(document) -> None:
    for _, question in document.questions():
        for result in question.derivation.results.values():
            if isinstance(result, tuple) and result and isinstance(result[0], Branch):
                assert all(branch.when for branch in result)


@every_kind
def test_options_have_defaults_that_are_frozen(subject: str, kind: str) -> None:
    options = registry.load(subject, kind).Options
    assert options.model_config["frozen"]
    assert options.model_config["extra"] == "forbid"


@pytest.mark.parametrize("module", MODULES)
def test_a_kind_has_a_first_line_and_words(module: str) -> None:
    _, _, folder, stem = module.split(".")
    loaded = import_module(module)
    assert (loaded.__doc__ or "").strip()
    assert (WORDS / folder / f"{stem}.j2").is_file()
    assert loaded.derive.__doc__


def test_no_words_are_left_over() -> None:
    kept = {f"derive.kinds.{path.parent.name}.{path.stem}" for path in WORDS.glob("*/[!_]*.j2")}
    assert kept == set(MODULES)
