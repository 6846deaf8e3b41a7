"""What is wrong with the words of a kind: steps they leave out or tell too early, names that are nowhere."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import pairwise

from derive.derivation import Derivation, Step


class Untold(Exception):
    """A template does not tell what it has to. `template` is its path, `macro` the one of its macros."""

    template = ""
    macro = ""


class Withheld(Untold):
    """A template of one's own does not print what it is given to print."""

    def __init__(self, template: str, text: str, macro: str = "") -> None:
        super().__init__(f"it does not print what it is given: {text}")
        self.template = template
        self.macro = macro


class ForgottenStep(Untold):
    """The words of a kind left out steps of its derivation."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} neither show nor tell: {', '.join(names)}")


class UnknownFamily(Untold):
    """The words of a kind speak of names that its derivation has not."""

    def __init__(self, kind: str, letter: str) -> None:
        super().__init__(f"the words of {kind} speak of {letter} with an index, and nothing is called so")


class ForgottenFact(Untold):
    """The words of a kind leave out what its derivation gives them to say."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} do not say these facts: {', '.join(names)}")


class EarlyStep(Untold):
    """The words of a kind tell steps in another order than they were derived in."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} tell before what was derived first: {', '.join(names)}")


def forgotten(derivation: Derivation, told: Collection[str]) -> list[str]:
    """The steps with something to say that were not told."""
    steps = derivation.all_steps()
    return [step.name for step in steps if step.name not in told and (step.chain or not step.steps)]


def early(derivation: Derivation, told: Mapping[str, int]) -> list[str]:
    """The steps that are told before one that was derived earlier beside them; of each its place is given."""
    found: list[str] = []
    for steps in _siblings(derivation.steps):
        names = dict.fromkeys(step.name for step in steps if step.name in told)
        found += [name for before, name in pairwise(names) if told[name] < told[before]]
    return found


def _siblings(steps: tuple[Step, ...]) -> Iterator[tuple[Step, ...]]:
    """The steps beside each other, at every depth."""
    yield steps
    for step in steps:
        if step.steps:
            yield from _siblings(step.steps)
