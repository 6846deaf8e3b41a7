"""The letters of the books: what one calls M and others call D or B, and where the indices of frames stand.
The names of a sheet stay as its author typed them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Literal, TypeAlias

from derive.errors import NotAsWritten
from derive.expression import Call, Expr, Indexed, Symbol, replace, walk
from derive.render.names import Name, name_latex, name_parts, stem_of

Frames: TypeAlias = Literal["after", "before", "below"]  # T_1^0, {}^0_1 T, T_{01}
ENTRY = re.compile(r"_(\d{2}|\d+,\d+|[ijk]{2})(?!\d)")  # of a matrix: two indices
CONSTANT = "_0"  # g_0 is no entry of g
BEFORE = r"(?<![\\A-Za-z^])(?<!\^\{)"  # a letter that is one: of no word, and no T of a transpose
OPERATIONS = frozenset({"T", "-1", "*"})  # as superscripts
FRAMED = re.compile(rf"{BEFORE}[TR]_\w\^(?!T)\w")  # a pose or a rotation that was typed


@dataclass(frozen=True, slots=True)
class Style:
    """How one book writes: its letters for ours, the place of the indices of frames, the columns of a table
    of link parameters, and whether a twist begins with the angular velocity."""

    letters: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    frames: Frames = "after"
    columns: tuple[str, ...] = ()
    angular_first: bool = False


STYLES: Mapping[str, Style] = {
    # Spong, Hutchinson and Vidyasagar, chapters 3, 4 and 6
    "spong": Style(columns=("a", "alpha", "d", "theta")),
    # Siciliano, Sciavicco, Villani and Oriolo, chapters 2, 3 and 7
    "siciliano": Style({"D": "B"}, columns=("a", "alpha", "d", "theta")),
    # Craig, chapters 2, 3 and 6
    "craig": Style({"D": "M", "g": "G"}, "before", ("alpha", "a", "d", "theta")),
    # Lynch and Park, chapters 3, 5 and 8, appendix C
    "lynch": Style({"D": "M"}, "below", ("alpha", "a", "d", "theta"), angular_first=True),
}


@dataclass(frozen=True, slots=True)
class Lettering:
    """The letters of one sheet. `stems` are those of the answers, each with what is printed for it; names in
    `own` are the author's and stay."""

    stems: tuple[tuple[str, str], ...] = ()
    own: frozenset[str] = frozenset()
    frames: Frames = "after"

    def __bool__(self) -> bool:
        return bool(self.stems) or self.frames != "after"

    def called(self, name: str) -> str:
        """What is printed for a plain name: M_11 for D_11, T_01 for T_1^0."""
        return _called(self, name) if self and name not in self.own else name

    def tree(self, tree: Expr) -> Expr:
        """The tree with the names that are printed."""
        if not self:
            return tree
        nodes = {node for node in walk(tree) if isinstance(node, Symbol | Indexed | Call)}
        return replace(tree, {node: other for node in nodes if (other := self._node(node)) != node})

    def indexed(self, node: Indexed) -> Indexed:
        """A name with indices that are trees."""
        base = self.called(node.base)
        if self.frames == "below" and node.upper and node.lower:
            return Indexed(base, (*node.upper, *node.lower), ())
        return Indexed(base, node.lower, node.upper)

    def latex(self, typed: str) -> str:
        """A formula that was typed in LaTeX, with the letters that are printed."""
        typed = FRAMED.sub(self._framed, typed)
        for ours, theirs in self.stems:
            letter = name_latex(theirs).replace("\\", r"\\")
            typed = re.sub(rf"{BEFORE}{re.escape(name_latex(ours))}(?![A-Za-z])", letter, typed)
            if ours != ours.lower():
                typed = re.sub(rf"{BEFORE}{ours.lower()}(?=_\{{[ijk]{{2}}\}})", theirs.lower(), typed)
        return typed

    def _framed(self, typed: re.Match[str]) -> str:
        """T_i^0 with its indices where this sheet has them; its letter is changed like any other."""
        return str(Lettering(frames=self.frames).parts(typed[0]))

    def _node(self, node: Expr) -> Expr:
        match node:
            case Symbol(name):
                return Symbol(self.called(name))
            case Indexed(base, lower, upper):
                return self.indexed(Indexed(base, tuple(map(self.tree, lower)), tuple(map(self.tree, upper))))
        return node

    def parts(self, name: str) -> Name:
        """The parts of a plain name as it is printed."""
        parts = name_parts(self.called(name))
        framed = self.frames == "before" and name not in self.own and _is_framed(parts)
        return parts.led() if framed else parts


HOUSE = Lettering()


def _is_framed(parts: Name) -> bool:
    return bool(parts.upper) and parts.upper not in (*OPERATIONS, r"\ast") and "_" not in parts.lower


@lru_cache(10_000)
def _called(lettering: Lettering, name: str) -> str:
    """Raises NotAsWritten where an index would be lost."""
    called = _renamed(lettering, name)
    if Counter(filter(str.isdigit, name)) - Counter(called):
        raise NotAsWritten(f"{called} stands for {name} and has not its indices")
    return called


def _renamed(lettering: Lettering, name: str) -> str:
    stem = stem_of(name)
    rest = name[len(stem) :]
    for ours, theirs in lettering.stems:
        if stem == ours and rest != CONSTANT:
            name = theirs + rest
        elif stem == ours.lower() != ours and ENTRY.match(rest):
            name = theirs.lower() + rest
    if lettering.frames == "below":
        return _below(name)
    return name


def _below(name: str) -> str:
    """T_01 for T_1^0: the frame that it is seen in first (Lynch and Park, section 3.3)."""
    head, mark, upper = name.partition("^")
    stem, line, lower = head.partition("_")
    if not mark or not line or upper in OPERATIONS or "_" in lower:
        return name
    between = "" if len(upper) == len(lower) == 1 else "_"
    return f"{stem}_{upper}{between}{lower}"
