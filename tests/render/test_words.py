from __future__ import annotations

from dataclasses import replace

import pytest
from jinja2 import DictLoader
from markdown_it import MarkdownIt

from derive.derivation import Derivation, PageFacts, Phrase, Step, Table
from derive.expression import Approximate, Expr, Symbol, number
from derive.render.notation import Notation
from derive.render.page import LATEX, MARKDOWN
from derive.render.skin import HELD_LINE, environment
from derive.render.so_far import SoFar
from derive.render.untold import EarlyStep, ForgottenFact, ForgottenStep, UnknownFamily
from derive.render.words import words

A, B = Symbol("A"), Symbol("B")
TOLD = Derivation("told", (Step("A", (A, B, number(3))), Step("x", (Symbol("x"), Approximate(0.1234)))), {})


class Facts(PageFacts):
    size: Expr | None = None
    verdict: Phrase | None = None
    rows: Table | None = None


def tell(
    monkeypatch: pytest.MonkeyPatch, source: str, asked: bool = True, facts: PageFacts | None = None,
    so_far: SoFar | None = None,
) -> str:  # fmt: skip
    loader = environment().loader
    assert loader is not None
    kept = ("markdown/skin.j2", "words/_english.j2")
    templates = {name: loader.get_source(environment(), name)[0] for name in kept}
    templates["words/any/told.j2"] = source
    monkeypatch.setattr(environment(), "loader", DictLoader(templates))
    told = replace(TOLD, facts=facts or PageFacts())
    return words(told, "any", MARKDOWN, Notation(), asked, so_far=so_far)


def test_a_step_the_words_forgot_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ForgottenStep, match="words of told neither show nor tell: x"):
        tell(monkeypatch, '{{ show("A") }}')


def test_what_was_not_asked_for_may_be_brief(monkeypatch: pytest.MonkeyPatch) -> None:
    brief = '{{ inline("A") }}{{ tell("x") if not asked }}'
    assert tell(monkeypatch, brief, asked=False) == "$A = B = 3$"
    with pytest.raises(ForgottenStep):
        tell(monkeypatch, '{{ inline("A") }}', asked=False)


def test_names_with_an_index_are_those_of_something(monkeypatch: pytest.MonkeyPatch) -> None:
    numbered = replace(TOLD, definitions={Symbol("r_c1"): A, Symbol("F_2"): B})
    monkeypatch.setattr("tests.render.test_words.TOLD", numbered)
    told = '{{ "r_c" | each }} and {{ "F" | each }}{{ tell("A", "x") }}'
    assert tell(monkeypatch, told) == "$r_{ci}$ and $F_i$"
    with pytest.raises(UnknownFamily):
        tell(monkeypatch, '{{ "N" | each }}{{ tell("A", "x") }}')


def test_every_way_to_tell_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    assert tell(monkeypatch, '{{ "A" | m }}{{ tell("A") }} {{ step("x") | m }}') == r"$A$ $x \approx 0.123$"
    assert tell(monkeypatch, "{% for s in d.steps %}{{ inline(s) }}{% endfor %}").startswith("$A = B")


def test_lists_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = tell(monkeypatch, '{{ ["a", "b", "c"] | listed }}; {{ ["a"] | listed }}{{ tell("A", "x") }}')
    assert shown == "$a$, $b$ and $c$; $a$"


def test_a_display_stands_apart() -> None:
    from derive.render.layout import Display

    assert MARKDOWN.display(Display(("a = b",))).strip() == "$$\na = b\n$$"
    assert LATEX.display(Display(("a &= b", "&= c"))).strip() == (
        "\\begin{align*}\na &= b \\\\\n&= c\n\\end{align*}"
    )
    assert LATEX.display(Display(("a = b",), wide=True)).strip() == "\\[\n\\fitted{a = b}\n\\]"


@pytest.mark.parametrize("text", ["a = 1;\n\n\n\nb'", "```\n````", "\\end{listing}\n\\[", "$x$ <b>&amp; # %"])
def test_a_listing_stands_as_it_is(text: str) -> None:
    shown = MARKDOWN.listing(text, "matlab").replace(HELD_LINE, "\n")
    tokens = MarkdownIt().parse(shown)
    assert [(token.type, token.content) for token in tokens] == [("fence", text + "\n")]
    latex = LATEX.listing(text, "matlab").replace(HELD_LINE, "\n").strip()
    first, _, rest = latex.partition("\n")
    assert rest == f"{text}\n{first.replace('begin', 'end').partition('[')[0]}"
    assert first.replace("begin", "end") not in text


def test_what_was_derived_first_is_told_first(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(EarlyStep, match="the words of told tell before what was derived first: x"):
        tell(monkeypatch, '{{ show("x") }}{{ show("A") }}')
    assert tell(monkeypatch, '{{ tell("A") }}{{ show("x") }}{{ show("A") }}')


TOLD_ALL = '{{ tell("A", "x") }}'
PHRASES = "{% block phrases %}\nstable: it is *now* **stable** at {place}\n{% endblock %}\n"


@pytest.mark.parametrize(
    ("facts", "name"),
    [
        (Facts(size=A), "size"),
        (Facts(verdict=Phrase("stable", {"place": A})), "verdict"),
        (Facts(rows=Table(("",), ((B,),))), "rows"),
    ],
)
def test_a_fact_that_is_not_said_is_an_error(
    monkeypatch: pytest.MonkeyPatch, facts: PageFacts, name: str
) -> None:
    with pytest.raises(ForgottenFact, match=f"the words of told do not say these facts: {name}"):
        tell(
            monkeypatch,
            TOLD_ALL + "{% if facts.size and facts.verdict %}{{ facts.size | m }}{% endif %}",
            facts=facts,
        )
    tell(monkeypatch, TOLD_ALL, asked=False, facts=facts)


def test_every_way_to_say_a_fact(monkeypatch: pytest.MonkeyPatch) -> None:
    facts = Facts(size=A, verdict=Phrase("stable", {"place": A}))
    source = f"{PHRASES}{TOLD_ALL}{{{{ say(facts.verdict) }}}}; {{{{ [facts.size] | listed }}}}"
    assert tell(monkeypatch, source, facts=facts) == "it is *now* **stable** at $A$; $A$"
    assert tell(monkeypatch, '{{ show("A") }}{{ tell("x") }}', facts=Facts(size=B))


def test_what_is_not_there_is_not_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match="nothing to list"):
        tell(monkeypatch, TOLD_ALL + "here {{ [] | listed }}")


def test_what_was_explained_before_is_told_in_a_short_line(monkeypatch: pytest.MonkeyPatch) -> None:
    source = (
        "{% block phrases %}\nlong: It is {size}, and why\n{% endblock %}"
        "{% set before = again(step('A')) %}{% if before %}{{ before }}{% else %}"
        "{{ inline('A') }}{% endif %}{{ tell('x') }}"
        "{{ ', again' if again(facts.verdict) else say(facts.verdict) }}"
    )
    so_far = SoFar()
    facts = Facts(verdict=Phrase("long", {"size": A}))
    first = tell(monkeypatch, source, facts=facts, so_far=so_far)
    assert "$A = B = 3$" in first and "It is $A$, and why" in first
    assert tell(monkeypatch, source, facts=facts, so_far=so_far) == "as before, again"
    other = Facts(verdict=Phrase("long", {"size": B}))
    assert tell(monkeypatch, source, facts=other, so_far=so_far) == "as beforeIt is $B$, and why"
