"""Singular sets for the results, and how they look."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce
from typing import Any

from derive.algebra.infix import text
from derive.derivation import Branch, Condition, Phrase
from derive.expression import ZERO, Relation
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.geometry import Look
from derive.kinds.robot._singular.sets import Analysed, Block, Case

LOOKS = {
    "axis": "on-an-axis", "plane": "in-a-plane", "coincide": "axes-coincide", "parallel": "axes-parallel",
    "stretched": "elbow-stretched", "folded": "elbow-folded",
}  # fmt: skip
PLACES = {"axis": "shoulder", "plane": "shoulder", "coincide": "wrist", "parallel": "wrist"}
NAMED = {"shoulder": "shoulder-singularity", "wrist": "wrist-singularity"}
BENT = {"stretched": "elbow-is-stretched", "folded": "elbow-is-folded"}


def branches(problem: Problem, found: Iterable[Analysed], point: Phrase) -> tuple[Branch, ...]:
    """The solutions for the results: the values of each case, what it looks like, and the rank there."""
    made = []
    for each in found:
        for case in each.cases:
            values = {str(text(name)): problem.final(value) for name, value in case.values}
            looks = () if each.inner else _distinct(_look(one, point, each.block) for one in _telling(case))
            made.append(Branch(values, (_listed(looks) if looks else _vanishing(each),), facts=_facts(each)))
        if not each.cases:
            values = {str(text(name)): problem.final(value) for name, value in each.decided}
            made.append(Branch(values, (_vanishing(each),), facts=_facts(each)))
    return tuple(made)


def _facts(each: Analysed) -> dict[str, Any]:
    """The rank, and the expressions that vanish all over the set."""
    told = {"equations": [text(equation) for equation in each.equations]} if each.equations else {}
    return {**told, "rank" if each.exact else "rank_at_most": each.rank}


def _vanishing(each: Analysed) -> Phrase:
    equations: tuple[Condition, ...] = (
        *(Relation(name, "=", value) for name, value in each.decided),
        *(Relation(equation, "=", ZERO) for equation in each.equations),
    )
    equations = equations or (Phrase("minors-vanish", {"size": each.rank + 1}),)
    return Phrase("inside-larger-sets" if each.inner else "on-the-set", {"equations": equations})


def _listed(looks: tuple[Phrase, ...]) -> Phrase:
    return reduce(lambda one, other: Phrase("besides", {"one": one, "other": other}), looks)


def _distinct(looks: Iterable[Phrase]) -> tuple[Phrase, ...]:
    found = tuple(looks)
    return tuple(look for k, look in enumerate(found) if look not in found[:k])


def _telling(case: Case) -> tuple[Look, ...]:
    """What says most: axes in line before anything; the plane only by itself. Where several joint variables
    are fixed, everything of that sort."""
    looks, several = case.looks, len(case.zeros) > 1
    for kinds in (("coincide",), ("stretched", "folded"), ("axis",), ("parallel",), ("plane",)):
        if found := tuple(look for look in looks if look.kind in kinds):
            return found if several or kinds == ("stretched", "folded") else found[-1:]
    return ()


def clauses(case: Case, block: Block, point: Phrase) -> tuple[Phrase, ...]:
    """The same as sentences to go on with."""
    return _distinct(_clause(look, point, block) for look in _telling(case))


def _clause(look: Look, point: Phrase, block: Block) -> Phrase:
    if look.kind in BENT:
        return Phrase(BENT[look.kind], {"joint": look.joints[-1]})
    where, said = _where(look, block), _plain(look, point)
    return Phrase(NAMED[where], {"look": said}) if where else said


def _look(look: Look, point: Phrase, block: Block) -> Phrase:
    where, said = _where(look, block), _plain(look, point)
    return Phrase(where, {"look": said}) if where else said


def _where(look: Look, block: Block) -> str:
    """Of the joints that move the point, the first is the shoulder's; the last three are a wrist where they
    are not all parallel."""
    rows, sort = block.seen.rows, PLACES.get(look.kind, "")
    wrist = look.joints == (rows[-1] - 2, rows[-1]) and block.seen.has_wrist
    is_there = {"shoulder": look.joints[0] == rows[0], "wrist": wrist}
    return sort if is_there.get(sort) else ""


def _plain(look: Look, point: Phrase) -> Phrase:
    of = Phrase("point-of-axis", {"axis": look.of}) if look.of and look.kind == "plane" else point
    return Phrase(LOOKS[look.kind], {"point": of, "first": look.joints[0], "last": look.joints[-1]})
