"""The letters that a sheet asks for, held to its answers: each is used, and none has two meanings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from difflib import get_close_matches

from derive.derivation import Derivation
from derive.errors import SheetError
from derive.expression import Call, Expr, Indexed, Symbol, walk
from derive.kinds.problem import TREES, expressions
from derive.kinds.problem import Problem as Working
from derive.render.lettering import HOUSE, STYLES, Lettering
from derive.render.names import stem_of
from derive.sheet.model import Notation


def letters_of(given: Notation, working: Working, answers: Iterable[Derivation]) -> Lettering:
    """The letters of one problem: those of its style, where nothing else in it is called so, and those that
    the author asks for. Raises SheetErrors where one of these would stand for two things."""
    style = STYLES.get(given.style or "")
    if style is None and not given.names:
        return HOUSE
    options = (part for _, options in working.questions for part in expressions(options))
    own = frozenset(working.taken).union(*(_names(tree) for tree in options))
    used = _used(answers) | own
    found = Lettering(tuple(given.names.items()), own, style.frames if style else "after")
    if given.at and (clash := _clash(found, used)):
        name, written = clash
        message = f"{name} would be printed as {written}, which means something else here"
        raise given.at.error(message, ("names",), f"give another letter for {stem_of(name)}")
    for ours, theirs in style.letters.items() if style and working.name == "robot" else ():
        wider = replace(found, stems=(*found.stems, (ours, theirs)))
        if ours not in given.names and not _clash(wider, used):
            found = wider
    return found


def _clash(letters: Lettering, used: Iterable[str]) -> tuple[str, str] | None:
    """A name that would be printed as another is, and how."""
    printed = {name: letters.called(name) for name in sorted(used)}
    same = Counter(printed.values())
    return next(((name, to) for name, to in printed.items() if name != to and same[to] > 1), None)


def unused_letters(given: Notation, answers: Sequence[Derivation]) -> Iterator[SheetError]:
    """A warning for each letter that no answer has."""
    if not given.names or not given.at:
        return
    stems = sorted({stem_of(name) for name in _used(answers)})
    for letter in given.names:
        if letter not in stems:
            near = get_close_matches(letter, stems, 1, 0.6)
            hint = f"did you mean {near[0]}?" if near else f"they have {', '.join(stems)}"
            yield given.at.fault(
                f"no answer of this sheet has a letter {letter}", ("names", letter), hint, True
            )


def _used(answers: Iterable[Derivation]) -> set[str]:
    """The names in answers and in what they rest on."""
    found = set[str]()
    for answer in answers:
        for step in answer.all_steps():
            found.update(*map(_names, step.chain))
        found |= {*answer.results} | _used(answer.uses)
        found.update(*(_names(tree) for tree in answer.results.values() if isinstance(tree, TREES)))
    return found


def _names(tree: Expr) -> set[str]:
    found = set[str]()
    for node in walk(tree):
        match node:
            case Symbol(name) | Indexed(name):
                found.add(name)
            case Call(function):
                found.add(function)
    return found
