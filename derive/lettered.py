"""The letters that a sheet asks for, held to its answers: each is used, and none has two meanings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches

from derive.derivation import Derivation
from derive.errors import SheetError, SheetErrors
from derive.expression import Call, Expr, Indexed, Symbol, walk
from derive.kinds.problem import TREES, expressions
from derive.kinds.problem import Problem as Working
from derive.render.lettering import Lettering, lettering
from derive.render.names import stem_of
from derive.sheet.model import Notation


def letters_of(given: Notation, working: Working, answers: Iterable[Derivation]) -> Lettering:
    """The letters of one problem. Raises SheetErrors where a letter would stand for two things."""
    if not given.style and not given.names:
        return Lettering()
    options = (part for _, options in working.questions for part in expressions(options))
    own = frozenset(working.taken).union(*(_names(tree) for tree in options))
    found = lettering(given.style or "", given.names.items(), own)
    used = _used(answers) | own
    printed = {name: found.called(name) for name in sorted(used)}
    if faults := [*_namesakes(given, printed)]:
        raise SheetErrors(faults)
    return found


def _namesakes(given: Notation, printed: dict[str, str]) -> Iterator[SheetError]:
    """Names that would be printed as another is."""
    first = {written: name for name, written in printed.items() if name == written}
    for name, written in printed.items():
        if name != written and written in first and given.at:
            by, route = (stem_of(name), ("names",)) if given.names else (str(given.style), ("style",))
            hint = f"give another letter for {stem_of(name)} under notation: names"
            yield given.at.fault(
                f"{by} would print {name} as {written}, which means something else", route, hint
            )
            return


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
