"""The functions of a formula, and what an author probably meant by one that does not exist."""

from __future__ import annotations

from difflib import get_close_matches

from derive.errors import FormulaError

ARGUMENTS = {
    **dict.fromkeys(("cos", "sin", "tan", "acos", "asin", "atan", "sqrt", "abs", "sign", "exp", "log"), 1),
    "atan2": 2,
}
TRIGONOMETRIC = frozenset({"cos", "sin", "tan"})
INVERSE = frozenset({"acos", "asin", "atan", "atan2"})
_OTHER_NAMES = {"arctan2": "atan2", "arccos": "acos", "arcsin": "asin", "arctan": "atan", "ln": "log"}


def meant(name: str) -> str:
    """The function a misspelt name stands for, or an empty text."""
    if known := _OTHER_NAMES.get(name.lower()):
        return known
    close = get_close_matches(name.lower(), ARGUMENTS, n=1, cutoff=0.75) if len(name) > 2 else []
    return close[0] if close else ""


def unknown_function(name: str, argument: str, at: int) -> FormulaError:
    """The error for `name(argument)` where there is no such function."""
    if function := meant(name):
        return FormulaError(f"there is no function '{name}'", at, f"did you mean {function}?")
    if argument in ("s", "t"):
        return FormulaError(
            f"'{name}({argument})' reads as a function", at, f"write {name} alone for the signal"
        )
    hint = f"for a product write {name}*(...); the functions are {', '.join(sorted(ARGUMENTS))}"
    return FormulaError(f"there is no function '{name}'", at, hint)
