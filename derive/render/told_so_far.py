"""A derivation that is being told: which of its steps and facts were, and what the page has told before."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from derive.derivation import Derivation, Phrase, Step, Table
from derive.expression import (
    Degrees,
    Expr,
    Number,
    Symbol,
    number,
)
from derive.render import twists
from derive.render.entries import Names
from derive.render.facts import Sayable, parts, sayable
from derive.render.latex import Printer
from derive.render.notation import Notation
from derive.render.phrases import Speech
from derive.render.printed import Printed
from derive.render.room import has_room, kept
from derive.render.skin import Skin, joined
from derive.render.so_far import SoFar
from derive.render.values import Values, in_unit

Mathematics = Expr | Step | str | int | tuple[Expr, ...]
Shown = str | Step | tuple[Expr, ...]  # a step or a bare chain
Trig = Literal["short", "long"] | None
Steps = Literal["full", "key", "answers"]


@dataclass(slots=True)
class ToldSoFar:
    """One derivation being told in one format; remembers which steps were."""

    d: Derivation
    speech: Speech
    skin: Skin
    notation: Notation
    plots: Mapping[str, str]
    files: Mapping[str, str]
    printed: list[Printed]
    values: Values
    asked: bool
    of: tuple[str, str]  # the folder and the kind
    so_far: SoFar
    level: Steps
    displays: int = 0
    told: dict[str, int] = field(default_factory=dict)  # steps, and when each was told first
    left_out: set[str] = field(default_factory=set)  # steps of which the page need not speak
    said: list[Sayable] = field(default_factory=list)
    answered: list[str] = field(default_factory=list)  # what stands in frames
    kept: list[Printed] = field(default_factory=list)  # and its mathematics

    def steps(self, *rules: str) -> list[Step]:
        """The outer steps of these rules, in their order."""
        return [step for step in self.d.steps if step.rule in rules]

    def again(self, explained: Phrase | Step | str | Iterable[Phrase]) -> str:
        """Where the sheet has explained this already, in these words: a phrase or several, the law of
        a step, or what the template calls so; "" where nowhere. It is told by that, and a short line will
        do: "as before", or "as in Problem 1"."""
        match explained:
            case Phrase() | str():
                about: object = explained
            case Step():
                self._note(explained)
                about = explained.chain
            case _:
                explained = about = tuple(explained)
        self.said.extend(parts(explained.chain if isinstance(explained, Step) else explained))
        return self.so_far.explanation((*self.of, about))

    def cited(self, *whats: Step | Expr) -> str:
        """ " (2) and (5)": the numbers of the equations of this problem that say what these names are, and of
        laws that the sheet has told; "" where one of them was not displayed."""
        return self._references(
            self.so_far.law(self.values.shown(what.chain))
            if isinstance(what, Step)
            else self.so_far.value(what, self.d)
            for what in whats
        )

    def found(self, *kinds: str) -> str:
        """The same for the answers of these kinds, on which this one rests."""
        return self._references(self.so_far.answer(kind, self.d) for kind in kinds)

    def worked(self) -> str:
        """ " (2) and (3)", the answers of an earlier question of this problem, worked in the very lines
        of this one; what both know need not be said again. "" where there is none."""
        before = self.so_far.same_working(self.d)
        if before is None or self.level == "answers":
            return ""
        self.tell(*self.d.steps)
        self.said.extend(fact for _, fact in sayable(before))
        return _numbers(self.so_far.answers_of(before))

    def _references(self, found: Iterator[str | None]) -> str:
        """None where the page has answers alone: what they rest on is not on it."""
        return "" if self.level == "answers" else _numbers(found)

    def tell(self, *names: str | Step) -> str:
        """Marks steps as told in prose; prints nothing."""
        for name in names:
            self._note(self._step(name))
        return ""

    def unsaid(self) -> list[str]:
        """The facts that could be said and were not."""
        return list(dict.fromkeys(name for name, fact in sayable(self.d) if fact not in self.said))

    def _note(self, step: Step) -> None:
        self.told.setdefault(step.name, len(self.told))

    def _step(self, name: str | Step) -> Step:
        return self.d.step(name) if isinstance(name, str) else name

    def _entries(self, name: Shown) -> Names:
        return {} if isinstance(name, tuple) else self._step(name).entries

    def _chain(self, name: Shown, printer: Printer, lines: int = 2) -> tuple[Expr, ...]:
        """The chain of a step, without the spare links that are too long for a page."""
        if isinstance(name, tuple):
            self.said.extend(name)
            return self.values.shown(name)
        step = self._step(name)
        self._note(step)
        self.said.extend(step.chain)
        chain = kept(step, printer, lines) if step.spare else step.chain
        return self.values.shown(
            twists.line(step.rule, chain, self.d) if self.notation.angular_first else chain
        )

    def cut(self, name: str | Step) -> bool:
        """Whether a link of this step is too long for a page and left out."""
        step = self._step(name)
        return kept(step, self._printer(None)) != step.chain

    def whole(self, steps: Iterable[Step]) -> list[Step]:
        """Those of the steps of which nothing is left out; of the others the page need not speak."""
        found = [(step, self.cut(step)) for step in steps]
        self.left_out.update(step.name for step, cut in found if cut)
        return [step for step, cut in found if not cut]

    def fits(self, table: Table) -> bool:
        """Whether the page has room for a table."""
        return has_room(table, self._printer(None))

    def _printer(self, trig: Trig) -> Printer:
        """That of the sheet; a display may ask for another way to write angles, where the sheet does not."""
        if not trig or self.notation.trig == "long":
            return Printer(self.notation)
        return Printer(replace(self.notation, trig=trig))

    def _trees(self, value: Mathematics) -> tuple[Expr, ...]:
        """The chain of what is written in a line of text."""
        self.said.extend(parts(value))
        match value:
            case str():
                return (Symbol(value),)
            case int():
                return (number(value),)
            case Step():
                self._note(value)
                return self.values.shown(value.chain)
            case (name, (Number() | Degrees()) as typed) if typed.unit:
                return name, in_unit(typed, typed.unit)
            case tuple():
                return self.values.shown(value)
            case _:
                return self.values.shown((value,))


def _numbers(references: Iterable[str | None]) -> str:
    found = [*references]
    return f" {joined([*filter(None, found)])}" if all(found) else ""
