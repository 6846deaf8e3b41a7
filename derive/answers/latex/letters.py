"""The names an answer may use: the problem's own, however written, and c_1, s_{12} for its angles."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from itertools import pairwise

from derive.errors import FormulaError
from derive.expression import Call, Expr, Sum, Symbol

TRIG = {"c": "cos", "s": "sin", "C": "cos", "S": "sin"}
_GREEK = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi rho sigma tau upsilon phi chi"
    " psi omega Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega"
)
GREEK_NAMES = frozenset(_GREEK.split(" "))
LETTERS = GREEK_NAMES | {
    "Pi",
    "pi",
    "omicron",
    "ell",
    "hbar",
    "nabla",
    "imath",
    "jmath",
    "varpi",
    "digamma",
    "sum",
}
VARIANTS = ("theta", "phi", "epsilon", "rho", "sigma", "kappa")  # \\varphi is \\phi unless there are both
LETTERS |= {f"var{name}" for name in VARIANTS}
_VARIANT = re.compile(rf"var(?=(?:{'|'.join(VARIANTS)}))")
_INDEXED = re.compile(r"([A-Za-z]+)_?(\d+)")
_SEPARATORS = re.compile(r"[_,\s]")
_STEMS = ("theta", "q")  # which an index alone stands for, before other Greek letters


@dataclass(frozen=True)
class Letters:
    """The names of a problem and of what is derived in it; `xy` says that Atan2 has x first in its LaTeX.

    A page of ours is `printed`: what people mean is not guessed there, \\times is a cross product and [S] the
    matrix of a vector or a twist. `indexed` are names with formulas for indices, `functions` those that stand
    before an argument, and a T above is a transpose where something is `turned`.
    """

    known: frozenset[str]
    xy: bool = False
    own: frozenset[str] = frozenset()  # of the known names those that stand for themselves; they come first
    printed: bool = False
    indexed: frozenset[str] = frozenset()
    functions: frozenset[str] = frozenset()
    turned: bool = False

    @cached_property
    def squeezed(self) -> Mapping[str, str]:
        """Names by their letters and digits alone; one that could be either of two stands for neither."""
        found: dict[str, str] = {}
        for name in sorted(self.known):
            key = self.key(name)
            found[key] = "" if key in found else name
        return found | {self.key(name): name for name in self.own}

    @cached_property
    def joints(self) -> Mapping[str, str]:
        """The angle an index stands for: theta1 or q1, else the only Greek letter of that index. Delta_12 is
        a minor and no angle."""
        found: dict[str, list[str]] = {}
        for name in self.known:
            match = _INDEXED.fullmatch(squeeze(name))
            minor = match and match[1][0].isupper() and len(match[2]) > 1
            if match and not minor and (match[1] in _STEMS or match[1] in GREEK_NAMES):
                found.setdefault(match[2], []).append(name)
        chosen = {index: _angle(names) for index, names in found.items()}
        return {index: name for index, name in chosen.items() if name}

    @cached_property
    def owned(self) -> Mapping[str, str]:
        """The names that stand for themselves, by their letters and digits."""
        return {self.key(name): name for name in sorted(self.own)}

    def key(self, name: str) -> str:
        """What is left of a name by which it is found; to people \\varphi and \\phi are one letter."""
        return _SEPARATORS.sub("", name) if self.printed else squeeze(name)

    def find(self, name: str) -> str:
        """The name of the problem that is meant, or an empty text. s_12 is a sine unless the problem itself
        has such a name: what a derivation calls S_2 or c_123 is no word of its reader's."""
        key = self.key(name)
        if name not in self.own and key not in self.owned and self._is_trig(key):
            return ""
        if name in self.own or (name in self.known and self.squeezed.get(key) not in self.own):
            return name
        return self.squeezed.get(key) or self.squeezed.get(key.replace("omega", "w")) or ""

    def _is_trig(self, key: str) -> bool:
        """Whether it is a c or s with joint angles that rise: c_112 is none."""
        index = key[1:]
        rising = index.isdigit() and all(a < b for a, b in pairwise(index))
        return key[:1] in TRIG and rising and self.summed(index) is not None

    def summed(self, indices: Iterable[str]) -> Expr | None:
        """theta1 + theta2 for 1 and 2; None where there is no such angle."""
        names = [self.joints.get(index, "") for index in indices]
        if not names or not all(names):
            return None
        angles = tuple(Symbol(name) for name in names)
        return angles[0] if len(angles) == 1 else Sum(angles)

    def abbreviated(self, name: str) -> Expr | None:
        """cos(theta1) for c1 and c_1, sin(theta1 + theta2) for s12, cos(phi) for c_phi; None for others."""
        function, index = TRIG.get(name[:1]), name[1:].lstrip("_")
        if function is None or not index:
            return None
        angle = self.angle(index)
        return None if angle is None else Call(function, (angle,))

    def angle(self, index: str) -> Expr | None:
        """What an index stands for: 12 and 1,2 for a sum of joint angles, theta1 for itself."""
        parts = index.replace("_", ",").split(",")
        if all(part.isdigit() for part in parts):
            return self.summed(parts if len(parts) > 1 or index in self.joints else index)
        name = self.find(index)
        return Symbol(name) if name else None

    def unknown(self, name: str, offset: int) -> FormulaError:
        """The error for a name that the problem does not have."""
        close = get_close_matches(name, sorted(self.known), n=1, cutoff=0.5)
        close = close or [each for each in sorted(self.known) if each.lower() == name.lower()]
        if name == "g":  # near to every g_1, which is another thing
            hint = "gravity: of the robot says what stands for gravity; left out, it is [0, 0, -g]"
            return FormulaError("the problem has no symbol 'g'", offset, hint)
        hint = f"did you mean {close[0]}?" if close else "say what it stands for under where:"
        return FormulaError(f"the problem has no symbol '{name}'", offset, hint)


def squeeze(name: str) -> str:
    """Letters, digits and ^ only, without variants: theta_1, vartheta1 and theta1 are one name."""
    return _VARIANT.sub("", _SEPARATORS.sub("", name))


def _angle(names: list[str]) -> str:
    for stem in _STEMS:
        for name in sorted(names):
            if name.startswith(stem):
                return name
    return names[0] if len(names) == 1 else ""
