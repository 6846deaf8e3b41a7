"""Sines and cosines: short for joint angles (c_1, s_{12}, and c_\\phi where asked), or written out."""

from __future__ import annotations

from collections.abc import Iterable

from derive.expression import Call, Degrees, Expr, Number, Power, Sum, Symbol, is_negative
from derive.render.names import Name, name_latex, name_parts
from derive.render.notation import Notation

JOINT_STEMS = (r"\theta", "q")
SHORT = {"cos": "c", "sin": "s"}


def short_index(angle: Expr, notation: Notation) -> str:
    """The subscript that stands for an angle in short notation, or "" where it is written out.

    theta1 is `1`, theta1 + theta2 is `12`; an angle the notation lists is its whole name; a difference
    or any other angle is written out, as textbooks do.
    """
    if notation.trig == "long":
        return ""
    index = _index(angle, notation)
    return "" if index in notation.meant else index


def meant_indices(names: Iterable[str]) -> frozenset[str]:
    """The indices with which a c or an s is one of these names: the 1 of c1."""
    parts = [name_parts(name) for name in names]
    return frozenset(part.lower for part in parts if part.stem in SHORT.values() and part.lower)


def alike_letters(names: Iterable[str]) -> frozenset[str]:
    """The letters before which a c or an s would look like the index of one of these names: the L of L_c."""
    parts = [name_parts(name) for name in names]
    return frozenset(part.stem for part in parts if part.lower[:1] in SHORT.values())


def _index(angle: Expr, notation: Notation) -> str:
    match angle:
        case Symbol(name) if name in notation.short_names:
            return name_latex(name)
        case Symbol(name):
            return joint_index(name)
        case Sum(terms):
            return _summed_index(terms)
        case _:
            return ""


def joint_index(name: str) -> str:
    """The index of a joint variable, or "": theta2 and q2 are `2`, phi and theta1_dot are none."""
    parts = name_parts(name)
    return parts.index if _is_joint(parts) else ""


def _is_joint(parts: Name) -> bool:
    return parts.stem in JOINT_STEMS and parts.index.isdigit() and not parts.upper


def _summed_index(terms: tuple[Expr, ...]) -> str:
    parts = [name_parts(term.name) for term in terms if isinstance(term, Symbol)]
    one_kind = len({part.stem for part in parts}) == 1 and all(map(_is_joint, parts))
    if len(parts) != len(terms) or not one_kind:
        return ""
    indices = [part.index for part in parts]
    return ("" if all(len(index) == 1 for index in indices) else ",").join(indices)


def is_short_argument(argument: Expr) -> bool:
    """Whether it can stand after a function without parentheses."""
    match argument:
        case Symbol():
            return True
        case Degrees(value) | Number(value):
            return value >= 0 and value.denominator == 1
        case _:
            return False


def is_written_out(factor: Expr, notation: Notation) -> bool:
    """Whether it prints as a function before its argument, `\\cos \\phi`."""
    raised = isinstance(factor, Power) and not is_negative(factor.exponent)  # cos^-1 would be the arc
    call = factor.base if isinstance(factor, Power) and raised else factor
    if not isinstance(call, Call) or call.function not in ("cos", "sin", "tan"):
        return False
    return call.function not in SHORT or not short_index(call.arguments[0], notation)
