"""A mistake planted into the running program, and what a build of some problems makes of it."""

from __future__ import annotations

import gc
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from types import CodeType, FunctionType
from typing import Any

from jinja2 import ChoiceLoader, DictLoader

from derive.render.skin import environment, templates
from tests.mutants.operators import (
    CODE,
    WORDINGS,
    WORDS,
    Mutant,
    code_of,
    in_code,
    in_words,
    words_of,
)
from tests.mutants.units import Lines, Page, Unit, built, forked
from tests.mutants.verdict import Verdict, verdict, worst

# Mistakes of each in a round: about as they lay in the first trial, of 478, so that numbers can be compared.
WEIGHTS = {"mechanics": 4, "kinds": 5, "control": 2, "algebra": 2, "render": 2, WORDS: 1}
MOST = 6  # problems that are built for one mistake


@dataclass(frozen=True, slots=True)
class Ground:
    """What mistakes are planted into: the problems that build, as they are, and what each reaches."""

    pages: dict[Unit, Page]
    lines: dict[Unit, Lines]

    def reaching(self, mutant: Mutant) -> list[Unit]:
        """The problems whose build runs the line; of a template, those whose page is made with it."""
        path = str(mutant.path)
        return [
            unit
            for unit, lines in self.lines.items()
            if path in lines and (mutant.stratum == WORDS or mutant.line in lines[path])
        ]


def sample(ground: Ground, seed: int) -> Iterator[Mutant]:
    """Mistakes that some problem reaches, from each stratum and each operator in turn."""
    draw = random.Random(seed)
    piles: list[list[list[Mutant]]] = []
    for stratum in WEIGHTS:
        every = list(in_words() if stratum == WORDS else in_code(stratum))
        operators = [
            [m for m in every if m.operator == name] for name in (WORDINGS if stratum == WORDS else CODE)
        ]
        for pile in operators:
            draw.shuffle(pile)
        piles.append([pile for pile in operators if pile])
    while any(piles):
        for operators, weight in zip(piles, WEIGHTS.values(), strict=True):
            for _ in range(weight):
                if operators:
                    yield from _next(ground, operators)


def _next(ground: Ground, operators: list[list[Mutant]]) -> Iterator[Mutant]:
    """One of the operator whose turn it is, which then comes last; one that has no more is left out."""
    pile = operators.pop(0)
    while pile:
        mutant = pile.pop()
        if ground.reaching(mutant):
            operators.append(pile)
            yield mutant
            return


def tried(ground: Ground, mutant: Mutant, seed: int, most: int = MOST) -> tuple[Verdict, list[Unit]]:
    """The worst that some problems, drawn from those that reach the mistake, make of it."""
    reach = ground.reaching(mutant)
    drawn = random.Random(f"{seed} {mutant}").sample(reach, min(most, len(reach)))
    found = []
    for unit in drawn:
        found.append(verdict(ground.pages[unit], forked(partial(_with, mutant, partial(built, unit)))))
        if found[-1].kind == "wrong":
            break
    return worst(found), drawn[: len(found)]


def _with(mutant: Mutant, work: Callable[[], Any]) -> Any:
    """The work done with the mistake in place, for the rest of this process."""
    if mutant.stratum == WORDS:
        name = str(mutant.path.relative_to(templates()))
        jinja = environment()
        jinja.loader = ChoiceLoader([DictLoader({name: words_of(mutant)}), jinja.loader])
        if jinja.cache is not None:
            jinja.cache.clear()
    else:
        _replace(code_of(mutant))
    return work()


def _replace(code: CodeType) -> None:
    """Every function made of the code of this place is made of the new one."""
    for each in list(gc.get_objects()):
        if isinstance(each, FunctionType):
            old = each.__code__
            if (old.co_filename, old.co_qualname, old.co_firstlineno) == (
                code.co_filename,
                code.co_qualname,
                code.co_firstlineno,
            ):
                each.__code__ = code
