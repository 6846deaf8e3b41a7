"""Whether mathematics in TeX is put together as every format reads it: arguments, brackets, cells."""

from __future__ import annotations

import re
from dataclasses import dataclass

from derive.errors import FormulaError

_ONE = """
    hat bar vec dot ddot dddot tilde check acute grave breve widehat widetilde overline underline
    overrightarrow overbrace underbrace mathrm mathbf mathit mathsf mathtt mathbb mathcal mathfrak
    boldsymbol bm operatorname sqrt
"""
_TWO = "frac dfrac tfrac binom overset underset stackrel"
_OPERATORS = "sum prod int oint iint lim max min sup inf det gcd operatorname"
_SIZES = "big Big bigg Bigg bigl bigr Bigl Bigr"
_DELIMITERS = r"""
    ( ) [ ] / | . < > \{ \} \| \langle \rangle \lvert \rvert \lVert \rVert \vert \Vert \lbrace \rbrace
    \lfloor \rfloor \lceil \rceil \uparrow \downarrow
"""
TEXTS = frozenset({"text", "textbf", "textit", "textrm"})
ARGUMENTS = {
    **dict.fromkeys((*_ONE.split(), *TEXTS), 1),
    **dict.fromkeys(_TWO.split(), 2),
}
SIZES = frozenset(_SIZES.split())
UNBRACED = ARGUMENTS.keys() | SIZES | {"begin", "left"}  # no argument without braces around
DELIMITERS = frozenset(_DELIMITERS.split())
OPERATORS = frozenset(_OPERATORS.split())
DEEPEST = 40  # braces in braces
CLOSING = frozenset({"}", "&", r"\\", r"\right", r"\end", ""})
TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\S", re.DOTALL)
NAME = re.compile(r"\s*\{([^{}]*)\}")
COLUMNS = re.compile(r"\s*\{[lcr|\s]+\}")


@dataclass(slots=True)
class _Tex:
    """Reads from `place` on; `offset` is where the mathematics begins in its text."""

    tex: str
    offset: int
    place: int = 0
    depth: int = 0

    def peek(self) -> str:
        """The next token, "" at the end."""
        found = TOKEN.search(self.tex, self.place)
        return found[0] if found else ""

    def take(self) -> tuple[str, int]:
        """The next token and where it stands."""
        found = TOKEN.search(self.tex, self.place)
        if found is None:
            return "", len(self.tex)
        self.place = found.end()
        return found[0], found.start()

    def fault(self, message: str, place: int, hint: str = "") -> FormulaError:
        return FormulaError(message, self.offset + place, hint)

    # -- what there is ----------------------------------------------------------------------------

    def formula(self, cells: bool = False) -> None:
        """Everything up to what closes it; with `cells` rows and columns are allowed."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.fault("mathematics nested too deeply", self.place, "make it several formulas")
        scripts = before = ""
        while (token := self.peek()) not in CLOSING or (cells and token in ("&", r"\\")):
            if token in ("^", "_", "'"):
                scripts = self.script(scripts)
                continue
            if token == r"\limits" and before[1:] not in OPERATORS:
                raise self.fault(r"\limits stands behind \sum and the like only", self.take()[1])
            scripts, before = "", token
            self.atom()
        if token in ("&", r"\\"):
            what = {"&": "& stands between cells of a matrix only", r"\\": r"\\ ends a row of a matrix only"}
            hint = {"&": r"write \& for the sign", r"\\": r"a command has one backslash, as \theta"}
            raise self.fault(what[token], self.take()[1], hint[token])
        self.depth -= 1

    def script(self, before: str) -> str:
        """An index, an exponent or a prime; two of one sort on a letter mean nothing. Returns all so far."""
        sign, place = self.take()
        kind = "^" if sign == "'" else sign
        primes = sign in "'^" and before.endswith("'")  # x'' and x'^2
        if kind in before.replace("'", "^") and not primes:
            raise self.fault(f"two {sign} on one symbol", place, "use braces, as x_{1 2} or {x^2}^3")
        if sign != "'":
            self.argument(sign, place)
        return before + sign

    def atom(self) -> None:
        """A symbol, a group, or a command with its arguments."""
        token, place = self.take()
        name = token[1:] if token.startswith("\\") else ""
        match token:
            case "{":
                self.formula()
                self.close("}", place, "a brace { is never closed", "write the missing }")
            case r"\begin":
                self.environment(place)
            case r"\left":
                self.delimiter(token, place)
                self.formula()
                self.close(r"\right", place, r"\left without its \right", r"write \right) or \right.")
                self.delimiter(r"\right", self.place)
            case r"\displaystyle" | r"\textstyle" if self.peek() in CLOSING:
                raise self.fault(f"{token} has nothing behind it", place, "leave it out")
            case "#":
                raise self.fault("# has no meaning here", place, r"write \#")
            case "%":
                raise self.fault("% begins a comment in TeX", place, "write \\%")
            case _ if name in SIZES:
                self.delimiter(token, place)
            case _ if name in ARGUMENTS:
                for _ in range(ARGUMENTS[name]):
                    self.argument(token, place)

    def argument(self, token: str, place: int) -> None:
        """What a command or a script applies to."""
        name = token[1:] if token.startswith("\\") else ""
        if name == "sqrt" and self.peek() == "[":
            end = self.tex.find("]", self.place)
            if end < 0:
                raise self.fault("a bracket [ is never closed", place, "write the missing ]")
            self.place = end + 1
        following = self.peek()
        if following in CLOSING or following in ("^", "_", "'"):
            needs = "two arguments" if ARGUMENTS.get(name) == 2 else "something"
            raise self.fault(
                f"{token} needs {needs} behind it", place, f"write {token}" + "{...}" * ARGUMENTS.get(name, 1)
            )
        if name in TEXTS:
            self.text(token, place)
        elif name and following[1:] in UNBRACED:
            raise self.fault(
                f"{token} of {following} needs braces", place, f"write {token}{{{following}...}}"
            )
        else:
            self.atom()

    def text(self, token: str, place: int) -> None:
        """Words among the mathematics."""
        found = NAME.match(self.tex, self.place)
        if found is None:
            raise self.fault(f"{token} needs its words in one pair of braces", place, f"write {token}{{...}}")
        if wrong := re.search(r"(?<!\\)[_^&#%]", found[1]):
            hint = f"write \\{wrong[0]}" if wrong[0] not in "_^" else "end the words before it"
            raise self.fault(f"{wrong[0]} cannot stand among words", found.start(1) + wrong.start(), hint)
        self.place = found.end()

    def environment(self, place: int) -> None:
        """Rows and columns between \\begin and \\end of the same name."""
        name = self.name(place)
        if name.rstrip("*") == "array":
            columns = COLUMNS.match(self.tex, self.place)
            if columns is None:
                raise self.fault("an array needs its columns", place, r"write \begin{array}{cc}")
            self.place = columns.end()
        self.formula(cells=True)
        self.close(r"\end", place, rf"\begin{{{name}}} without its \end", rf"write \end{{{name}}}")
        end = self.place
        if self.name(end) != name:
            raise self.fault(rf"\begin{{{name}}} is closed by another \end", end, rf"write \end{{{name}}}")

    def name(self, place: int) -> str:
        found = NAME.match(self.tex, self.place)
        if found is None:
            raise self.fault("the name of the environment is missing", place, r"write \begin{matrix}")
        self.place = found.end()
        return found[1]

    def delimiter(self, token: str, place: int) -> None:
        if self.take()[0] not in DELIMITERS:
            raise self.fault(f"{token} needs a bracket behind it", place, f"write {token}( or {token}.")

    def close(self, wanted: str, place: int, message: str, hint: str) -> None:
        if self.peek() != wanted:
            raise self.fault(message, place, hint)
        self.take()


def check_structure(tex: str, offset: int = 0) -> None:
    """Raises FormulaError where mathematics in TeX is not put together."""
    reader = _Tex(tex, offset)
    reader.formula()
    token, place = reader.take()
    if token:
        said = {
            "}": "a } without its {",
            r"\right": r"\right without its \left",
            r"\end": r"\end without its \begin",
        }
        raise reader.fault(said[token], place)
