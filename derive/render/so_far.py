"""What a page has told so far: what was explained, its figures, and its equations, of which answers have
numbers and those that a later sentence refers to.

Which they are is known at the end, so until then equations and references stand in the page between marks.
They are counted as they are told in full, so that a sheet has the same numbers where only the key to it is
printed, and in every format.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from derive.derivation import Derivation
from derive.errors import NotAsWritten
from derive.expression import Expr
from derive.render.skin import HELD_LINE, english

MARKS = str.maketrans("", "", f"{HELD_LINE}\x02")  # for what lays out the page, which a number may move
SHOWN = re.compile("\x03(\\d+)\x04(.*?)\x05", re.DOTALL)
PICTURED = re.compile("\ue000(\\d+)\ue001")  # which plain texts may hold
CITED = re.compile("\x06(\\d+)\x07")

Chains = tuple[tuple[Expr, ...], ...]


@dataclass(frozen=True, slots=True)
class Equation:
    """A display of a problem: its chains, the derivation it is of, its place there, and whether it says the
    answer."""

    problem: int
    chains: Chains
    of: Derivation
    place: int
    answer: bool

    def same(self, other: Equation) -> bool:
        """Whether it is told again, which a key may do elsewhere."""
        return self.of.results is other.of.results and self.place == other.place


@dataclass(slots=True)
class SoFar:
    """`explained` says in which problem first; `figures` are the paths of the pictures met."""

    figures: list[str] = field(default_factory=list)
    problem: int = 0
    explained: dict[object, int] = field(default_factory=dict)
    equations: list[Equation] = field(default_factory=list)
    counted: set[int] = field(default_factory=set)
    begun: dict[int, dict[object, int]] = field(default_factory=dict)  # what was explained before each
    sought: list[tuple[int, Expr, Expr | None]] = field(default_factory=list)  # displays for names

    @contextmanager
    def telling(self, derivation: Derivation) -> Iterator[None]:
        """While a derivation is told: a second time, as a key may, in the words of the first."""
        key, now = id(derivation.results), self.explained
        if key not in self.begun:
            self.begun[key] = dict(now)
            yield
            return
        self.explained = dict(self.begun[key])
        yield
        self.explained = now

    def explanation(self, about: object) -> str:
        """Where something was explained already, "as before" or "as in Problem 1"; "" where it is now."""
        if about not in self.explained:
            self.explained[about] = self.problem
            return ""
        first = self.explained[about]
        return english("as_before") if first == self.problem else f"{english('as_in_problem')} {first}"

    def marked(self, written: str, equation: Equation, framed: bool) -> str:
        """A display between its marks."""
        told = (k for k, each in enumerate(self.equations) if each.same(equation))
        key = next(told, len(self.equations))
        met = self.equations[key : key + 1]
        if any(_ends(each) != _ends(equation) or not each.same(equation) for each in met):
            raise NotAsWritten("an equation has the number of another")
        if framed:
            self.counted.add(key)
        self.equations[key : key + 1] = [equation]
        inside = written.strip("\n")
        return written.replace(inside, f"\x03{key}\x04{inside}\x05")

    def law(self, chain: tuple[Expr, ...]) -> str | None:
        """A reference to the display of a law, wherever on the sheet; None where there is none."""
        return self._reference(k for k, each in enumerate(self.equations) if chain in each.chains)

    def value(self, name: Expr, here: Derivation) -> str | None:
        """A reference to the last display of this problem that says what a name is, the same as here."""
        known = here.definitions.get(name)
        found = (
            k
            for k, each in self._of_the_problem()
            if _says(each, name) and each.of.definitions.get(name) == known
        )
        if (first := next(found, None)) is None:
            return None
        self.sought.append((first, name, known))
        return self._reference([first])

    def answer(self, kind: str, here: Derivation) -> str | None:
        """A reference to the answer of a kind, on which this derivation rests."""
        used = (self._answers(each) for each in _used(here) if each.kind == kind)
        return self._reference(k for found in used for k in found)

    def same_working(self, here: Derivation) -> Derivation | None:
        """What was told in this problem in the lines of this derivation, which differs in its numbers."""
        told = (each.of for _, each in self._of_the_problem() if each.of.kind == here.kind)
        others = (each for each in told if each.results is not here.results)
        return next((each for each in others if _lines(each) == _lines(here)), None)

    def answers_of(self, derivation: Derivation) -> list[str | None]:
        """References to all answers of a derivation, in their order."""
        return [self._reference([k]) for k in sorted(self._answers(derivation))]

    def answer_of(self, derivation: Derivation) -> str | None:
        """A reference to the answer that a derivation ends in."""
        return self._reference(self._answers(derivation))

    def _answers(self, derivation: Derivation) -> Iterator[int]:
        told = self._of_the_problem()
        return (k for k, each in told if each.answer and each.of.results is derivation.results)

    def _of_the_problem(self) -> Iterator[tuple[int, Equation]]:
        """The displays told last first."""
        found = [(k, each) for k, each in enumerate(self.equations) if each.problem == self.problem]
        return reversed(found)

    def _reference(self, found: Iterable[int]) -> str | None:
        first = next(iter(found), None)
        if first is None:
            return None
        self.counted.add(first)
        return f"\x06{first}\x07"

    def _leads(self, to: int, name: Expr, known: Expr | None) -> bool:
        """Whether a display begins with a name that stands for this there."""
        display = self.equations[to]
        heads = [chain[0] for chain in display.chains]
        return name in heads and display.of.definitions.get(name) == known

    def figure(self, path: str) -> str:
        """What stands for the number of a figure, by the path of its picture, until it is known."""
        if path not in self.figures:
            self.figures.append(path)
        return f"\ue000{self.figures.index(path)}\ue001"

    def settled(self, page: str, numbered: Callable[[str, int], str]) -> str:
        """The page with its numbers, and without the marks. Raises NotAsWritten where a display is lost, or a
        reference leads to one of something else."""
        if not all(self._leads(*each) for each in self.sought):
            raise NotAsWritten("a reference leads to another equation")
        number = {key: count for count, key in enumerate(sorted(self.counted), 1)}

        def shown(found: re.Match[str]) -> str:
            key, written = int(found[1]), found[2]
            return numbered(written, number[key]) if key in number else written

        whole = CITED.sub(lambda found: f"({number[int(found[1])]})", SHOWN.sub(shown, page))
        told, seen = (each.translate(MARKS) for each in (page, whole))
        if not all(longest in seen for longest in map(_longest_line, told.split("\x04")[1:])):
            raise NotAsWritten("a display is not on its page")
        figures = {key: str(count) for count, key in enumerate(dict.fromkeys(PICTURED.findall(whole)), 1)}
        return PICTURED.sub(lambda found: figures[found[1]], whole)


def _longest_line(rest: str) -> str:
    """That of the display with which the rest of a page begins."""
    return max(rest.partition("\x05")[0].splitlines(), key=len, default="")


def _lines(derivation: Derivation) -> Chains:
    return tuple(step.chain for step in derivation.all_steps())


def _used(derivation: Derivation) -> Iterator[Derivation]:
    """What a derivation rests on, and what that rests on."""
    for used in derivation.uses:
        yield used
        yield from _used(used)


def _ends(equation: Equation) -> list[Expr]:
    return [chain[-1] for chain in equation.chains]


def _says(equation: Equation, name: Expr) -> bool:
    return any(len(chain) > 1 and chain[0] == name for chain in equation.chains)
