"""Short notation for sines and cosines of joint angles: c_1, s_{12}, and c_\\phi where asked."""

from __future__ import annotations

from derive.expression import Expr, Sum, Symbol
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
