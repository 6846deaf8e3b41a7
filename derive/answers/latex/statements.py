r"""What an old key writes around a formula: environments, boxes, labels, chains, and what follows.

`J = A = B, \quad k = 2a \quad (3)` is two statements: the answer with three parts and the definition of k.
The number of the equation is none. Nothing that may mean something is dropped: what is left over stays a
statement, and whoever reads it has to understand or to refuse it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.formulas.tokens import Token
from derive.answers.latex.scripts import Tokens, group, group_text
from derive.errors import FormulaError

Found: TypeAlias = tuple[Tokens, int]  # tokens, and the place after those they stand for
Rule: TypeAlias = Callable[[Tokens, int], Found | None]

DISPLAYS = frozenset(
    {"equation", "align", "aligned", "alignat", "flalign", "gather", "gathered", "multline", "split", "math"}
    | {"eqnarray", "displaymath", "IEEEeqnarray"}
)
WITH_ARGUMENT = ("alignat", "IEEEeqnarray")
BOXES = ("boxed", "fbox", "framebox", "ensuremath")
EQUALS = ("equiv", "coloneqq", "coloneq", "triangleq", "approx", "simeq", "doteq")
STACKED = ("stackrel", "overset", "underset")
TEXTS = ("text", "textrm", "textnormal", "mbox", "mathrm")
JOINING = ("where", "with", "and", "wherein", "here", "for", "")
LEADS = ("Rightarrow", "Longrightarrow", "implies", "iff", "Leftrightarrow", "therefore")
OPENS, CLOSES = ("(", "[", "{"), (")", "]", "}")
SIGNS = ("+", "-", "*", "/", "=", "^", "_", "&")


@dataclass(frozen=True, slots=True)
class Statement:
    """A chain a = b = c, each part without the signs between them, and where it begins."""

    parts: tuple[Tokens, ...]
    offset: int


def statements(found: Tokens) -> tuple[Statement, ...]:
    """The statements of an answer (an end token last), the answer itself first. Raises FormulaError."""
    for rule in (_display, _box, _equal):
        found = _rewritten(found, rule)
    pieces = [_without_membership(piece) for piece in _pieces(_without_stray_gaps(found))]
    kept = [piece for k, piece in enumerate(pieces) if piece and not (k and _is_number(piece))]
    if not kept:
        raise FormulaError("the answer ends too early", found[-1].offset)
    return tuple(_statement(piece) for piece in kept)


# -- environments, boxes and signs of equality ------------------------------------------------------


def _rewritten(found: Tokens, rule: Rule) -> Tokens:
    """With what a rule puts in the place of the tokens where it applies."""
    kept: list[Token] = []
    at = 0
    while found[at].kind != "end":
        new, at = rule(found, at) or ((found[at],), at + 1)
        kept.extend(new)
    return (*kept, found[at])


def _display(found: Tokens, at: int) -> Found | None:
    r"""Nothing for \begin{align} and the like; a matrix keeps its own."""
    name = group_text(found, at + 1).rstrip("*") if _is_command(found, at, ("begin", "end")) else ""
    if name not in DISPLAYS:
        return None
    _, end = group(found, at + 1)
    if name in WITH_ARGUMENT and found[at].text == "begin":
        _, end = group(found, end)
    return (), end


def _box(found: Tokens, at: int) -> Found | None:
    r"""What stands in \boxed{}, boxes in it opened too."""
    if not _is_command(found, at, BOXES):
        return None
    inner, end = group(found, at + 1)
    return _rewritten((*inner, _end(inner)), _box)[:-1], end


def _equal(found: Tokens, at: int) -> Found | None:
    r"""The sign = for :=, \equiv and what is stacked on a sign of equality."""
    token = found[at]
    if _is_command(found, at, STACKED):
        _, middle = group(found, at + 1)
        inner, end = group(found, middle)
        return (inner, end) if [each.text for each in inner] == ["="] else None
    if token.text == ":" and found[at + 1].text == "=":
        return found[at + 1 : at + 2], at + 2
    if token.kind == "command" and token.text in EQUALS:
        return (Token("sign", "=", token.offset, token.end),), at + 1
    return None


def _is_command(found: Tokens, at: int, names: Collection[str]) -> bool:
    """Whether a command stands there, and something behind it."""
    return found[at].kind == "command" and found[at].text in names and found[at + 1].kind != "end"


# -- from one statement to the next -------------------------------------------------------------------


def _without_stray_gaps(found: Tokens) -> Tokens:
    """Wide spaces kept only where they may stand between statements: not in a matrix, not beside a sign."""
    kept: list[Token] = []
    for k, (token, depth) in enumerate(_depths(found)):
        if token.kind == "gap":
            before = kept[-1] if kept else None
            after = next(t for t in found[k + 1 :] if t.kind != "gap")
            if depth or before is None or after.kind == "end" or before.kind == "gap":
                continue
            if before.text in SIGNS or after.text in SIGNS:
                continue
        kept.append(token)
    return tuple(kept)


def _pieces(found: Tokens) -> list[Tokens]:
    r"""Cut at commas, wide spaces, words such as where, and at lines that begin anew."""
    pieces: list[list[Token]] = [[]]
    after = 0
    for k, (token, depth) in enumerate(_depths(found[:-1])):
        if k < after:
            continue
        after = k + 1
        if depth:
            pieces[-1].append(token)
        elif _joins(found, k):
            after = group(found, k + 1)[1]
            pieces.append([])
        elif _cuts(token) or (token.kind == "row" and not _goes_on(found[k + 1 :])):
            pieces.append([])
        elif token.text == "&" and not _lines_up(found, k):
            raise FormulaError("'&' cannot stand here", token.offset, "it separates the entries of a matrix")
        elif token.text != "&" and token.kind != "row":
            pieces[-1].append(token)
    return [tuple(piece) for piece in pieces]


def _joins(found: Tokens, at: int) -> bool:
    r"""Whether words such as \text{where} begin here."""
    return _is_command(found, at, TEXTS) and group_text(found, at + 1).strip(",:. ").lower() in JOINING


def _cuts(token: Token) -> bool:
    """Whether a statement ends with a token."""
    if token.kind == "command":
        return token.text in LEADS
    return token.kind == "gap" or (token.kind == "sign" and token.text in (",", ";", "."))


def _goes_on(rest: Tokens) -> bool:
    """Whether a new line goes on with the formula of the one before."""
    first = next((token for token in rest if token.text != "&" and token.kind != "gap"), None)
    return first is not None and first.kind != "name" and first.text in ("=", "+", "-", "cdot", "times")


def _lines_up(found: Tokens, at: int) -> bool:
    """Whether a & lines up equations: beside a sign, or at the beginning of a line."""
    before = found[at - 1] if at else None
    if before is None or before.kind == "row":
        return True
    return any(token.text in ("=", "+", "-") for token in (before, found[at + 1]))


def _is_number(piece: Tokens) -> bool:
    """Whether it is the number of an equation: (3), (2.14), (3a)."""
    inner = piece[1:-1]
    if len(piece) < 3 or piece[0].text != "(" or piece[-1].text != ")":
        return False
    letter = inner[-1].kind == "name" and len(inner[-1].text) == 1
    return inner[0].kind == "number" and all(
        token.kind == "number" or token.text in (".", "-") or (letter and token is inner[-1])
        for token in inner
    )


def _without_membership(piece: Tokens) -> Tokens:
    r"""Without \in \mathbb{R}^{2 \times 2}: all is real here, and a shape is compared as a shape."""
    for k, token in enumerate(piece):
        if token.kind == "command" and token.text == "in":
            field = "".join(t.text for t in piece[k + 1 : k + 5] if t.text not in ("{", "}"))
            if field.startswith(("mathbbR", "R", "Re", "mathbfR")):
                return piece[:k]
    return piece


def _statement(piece: Tokens) -> Statement:
    parts: list[list[Token]] = [[]]
    for token, depth in _depths(piece):
        if depth == 0 and token.text == "=" and token.kind == "sign":
            parts.append([])
        else:
            parts[-1].append(token)
    if len(parts) > 1 and not parts[0]:
        parts = parts[1:]
    empty = next((k for k, part in enumerate(parts) if not part), None)
    if empty is not None:
        raise FormulaError("the answer ends too early", piece[-1].end, "write what stands after the =")
    return Statement(tuple((*part, _end(tuple(part))) for part in parts), piece[0].offset)


def _depths(found: Tokens) -> list[tuple[Token, int]]:
    """Each token with the number of parentheses, braces and environments around it."""
    told, depth = [], 0
    for token in found:
        if (token.text in CLOSES and token.kind == "sign") or (
            token.text == "end" and token.kind == "command"
        ):
            depth -= 1
        told.append((token, max(depth, 0)))
        if (token.text in OPENS and token.kind == "sign") or (
            token.text == "begin" and token.kind == "command"
        ):
            depth += 1
    return told


def _end(found: Tokens) -> Token:
    at = found[-1].end if found else 0
    return Token("end", "", at, at)
