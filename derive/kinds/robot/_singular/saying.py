"""Singular sets for the results, and how they look in plain words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from derive.algebra.infix import text
from derive.derivation import Branch
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.geometry import Look
from derive.kinds.robot._singular.sets import Analysed, Block, Case


def branches(problem: Problem, found: Iterable[Analysed], point: str) -> tuple[Branch, ...]:
    """The solutions for the results: the values of each case, what it looks like, and the rank there."""
    made = []
    for each in found:
        for case in each.cases:
            values = {str(text(name)): problem.final(value) for name, value in case.values}
            when = ("" if each.inner else said(case, each.block, point)) or _vanishing(each)
            made.append(Branch(values, when, facts=_facts(each)))
        if not each.cases:
            values = {str(text(name)): problem.final(value) for name, value in each.decided}
            made.append(Branch(values, _vanishing(each), facts=_facts(each)))
    return tuple(made)


def _facts(each: Analysed) -> dict[str, Any]:
    """The rank, and the expressions that vanish all over the set."""
    told = {"equations": [text(equation) for equation in each.equations]} if each.equations else {}
    return {**told, "rank" if each.exact else "rank_at_most": each.rank}


def _vanishing(each: Analysed) -> str:
    inside = "inside larger sets: " if each.inner else ""
    values = [f"{text(name)} = {text(value)}" for name, value in each.decided]
    told = [*values, *(f"{text(equation)} = 0" for equation in each.equations)]
    return inside + (" and ".join(told) or f"all minors of size {each.rank + 1} vanish")


def said(case: Case, block: Block, point: str) -> str:
    """How a case looks, in plain words."""
    return "; ".join(dict.fromkeys(_spoken(look, point, block) for look in _telling(case)))


def _telling(case: Case) -> tuple[Look, ...]:
    """What says most: axes in line before anything; the plane only by itself. Where several joint variables
    are fixed, everything of that sort."""
    looks, several = case.looks, len(case.zeros) > 1
    for kinds in (("coincide",), ("stretched", "folded"), ("axis",), ("parallel",), ("plane",)):
        if found := tuple(look for look in looks if look.kind in kinds):
            return found if several or kinds == ("stretched", "folded") else found[-1:]
    return ()


def clauses(case: Case, block: Block, point: str) -> tuple[str, ...]:
    """The same as sentences to go on with."""
    return tuple(dict.fromkeys(_clause(look, point, block) for look in _telling(case)))


def _clause(look: Look, point: str, block: Block) -> str:
    name, _, rest = _spoken(look, point, block).rpartition(": ")
    match look.kind:
        case "stretched" | "folded":
            return f"the elbow at joint {look.joints[-1]} is {look.kind}"
        case _:
            return f"{rest} (a {name} singularity)" if name else rest


def _spoken(look: Look, point: str, block: Block) -> str:
    """Of the joints that move the point, the first is the shoulder's; the last three are a wrist where they
    are not all parallel."""
    rows = block.seeing.rows
    first, last = look.joints[0], look.joints[-1]
    of = point if not look.of else f"the point of axis {look.of}"
    shoulder = "shoulder: " if first == rows[0] else ""
    wrist = "wrist: " if look.joints == (rows[-1] - 2, rows[-1]) and block.seeing.has_wrist else ""
    return {
        "axis": f"{shoulder}{point} lies on the axis of joint {first}",
        "plane": f"{shoulder}{of} lies in the plane of the axes of joints {first} and {last}",
        "coincide": f"{wrist}the axes of joints {first} and {last} coincide",
        "parallel": f"{wrist}the axes of joints {first} and {last} are parallel",
        "stretched": f"elbow stretched at joint {last}",
        "folded": f"elbow folded at joint {last}",
    }[look.kind]
