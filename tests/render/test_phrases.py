from __future__ import annotations

import pytest
from jinja2 import ChoiceLoader, DictLoader

from derive.algebra.formulas.grammar import parse
from derive.derivation import Condition, Phrase, Plot
from derive.expression import Degrees, Relation, Symbol, number
from derive.render.latex import Printer
from derive.render.notation import Notation
from derive.render.phrases import PhraseError, Speech, on_page, spoken
from derive.render.plain_text import markdown_text
from derive.render.skin import environment

WORDS = """\
{% block phrases %}
elbow-up: elbow up
always: always
free: {at:typed}, where {free} is free: only {only} is determined
odd: what is <this> =
{% endblock %}
"""
theta, psi, phi = Symbol("theta"), Symbol("psi"), Symbol("phi")
FREE = Phrase(
    "free",
    {"at": Relation(theta, "=", Degrees(90)), "free": (psi, phi), "only": parse("psi - phi")},
)
POSITIVE = Relation(Symbol("theta2"), ">", number(0))


@pytest.fixture(autouse=True)
def words(monkeypatch: pytest.MonkeyPatch) -> None:
    loader = environment().loader
    assert loader is not None
    monkeypatch.setattr(
        environment(), "loader", ChoiceLoader([DictLoader({"words/any/kind.j2": WORDS}), loader])
    )


@pytest.mark.parametrize(
    ("when", "page", "text"),
    [
        ((Phrase("elbow-up"), POSITIVE), r"elbow up, $\theta_2 > 0$", "elbow up, theta2 > 0"),
        (
            (Relation(parse("x^2"), "<=", number(4)),),
            r"$x^2 \leq 4$",
            "x**2 <= 4",
        ),
        (
            (Relation(Relation(number(0), "<=", Symbol("t")), "<=", number(1)),),
            r"$0 \leq t \leq 1$",
            "0 <= t <= 1",
        ),
        ((Phrase("odd"),), r"what is \<this\> =", "what is <this> ="),
        ((Phrase("always"),), "always", "always"),
        (
            (FREE,),
            r"$\theta = 90^\circ$, where $\psi$ and $\phi$ is free: only $\psi - \phi$ is determined",
            "theta = 90 deg, where psi and phi is free: only psi - phi is determined",
        ),
    ],
)
def test_conditions_are_typeset_on_the_page_and_plain_in_the_json(
    when: tuple[Condition, ...], page: str, text: str
) -> None:
    assert on_page("any", "kind", Printer(Notation()), markdown_text, []).when(when) == page
    assert spoken("any", "kind").when(when) == text


def test_a_phrase_without_words_is_an_error_that_says_where_they_go() -> None:
    with pytest.raises(PhraseError, match="no words for 'elbow-down': write"):
        spoken("any", "kind").say(Phrase("elbow-down"))


def test_words_that_are_not_written_as_they_have_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(PhraseError, match=r"nothing fills the field \{at\} of the words for 'free'"):
        spoken("any", "kind").say(Phrase("free"))
    wrong = DictLoader({"words/any/kind.j2": "{% block phrases %}\nelbow-up elbow up\n{% endblock %}"})
    monkeypatch.setattr(environment(), "loader", wrong)
    with pytest.raises(PhraseError, match="is 'key: words', not 'elbow-up elbow up'"):
        spoken("any", "kind")


def test_whoever_does_not_see_a_figure_is_told_all_of_it() -> None:
    speech = Speech({"seen": "from {start} to {end}", "less": "from {start}"})
    told = {"start": "1", "end": "2"}
    assert speech.seen_in(Plot("p", "x", "y", {}, alt=Phrase("seen", told))) == "from 1 to 2"
    with pytest.raises(PhraseError, match="leave out end"):
        speech.seen_in(Plot("p", "x", "y", {}, alt=Phrase("less", told)))
