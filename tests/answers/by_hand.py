"""LaTeX as people write it, from a formula that SymPy holds: every step on the way is a choice."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence

import sympy as sp

GREEK = frozenset(("alpha", "beta", "gamma", "delta", "theta", "phi", "psi", "omega", "tau", "zeta", "rho"))
FUNCTIONS = {
    sp.sin: r"\sin", sp.cos: r"\cos", sp.tan: r"\tan", sp.log: r"\ln", sp.asin: r"\arcsin",
    sp.acos: r"\arccos", sp.atan: r"\arctan",
}  # fmt: skip
ONE = sp.Integer(1)


class Hand:
    """The hand of one author, who writes c_1 and s_{12} or cos(theta_1); `draw` makes the choices."""

    def __init__(self, draw: random.Random) -> None:
        self.draw = draw
        self.letters = draw.choice(("", "", "cs", "CS"))

    def either(self, *forms: str) -> str:
        return self.draw.choice(forms)

    # -- sums, products, powers -------------------------------------------------------------------

    def write(self, formula: sp.Expr) -> str:
        terms = list(sp.Add.make_args(formula))
        self.draw.shuffle(terms)
        written = ""
        for term in terms:
            number, rest = term.as_coeff_Mul()
            minus = bool(number.is_real and number < 0)
            sign = "-" if minus else "+" if written else ""
            blank = self.either("", " ") if written else ""
            written += f"{blank}{sign}{blank}{self.product(-number if minus else number, rest)}"
        return written

    def product(self, number: sp.Expr, rest: sp.Expr) -> str:
        top, bottom = sp.fraction(rest)
        over = sp.Integer(number.q) if number.is_Rational else ONE
        number = sp.Integer(number.p) if number.is_Rational else number
        if bottom == 1 and over == 1:
            return self.factors(number, top)
        if bottom == 1 and top != 1 and self.draw.random() < 0.5:
            return f"{self.fraction(str(number), str(over))} {self.factors(ONE, top, behind=True)}"
        return self.fraction(self.factors(number, top), self.factors(over, bottom))

    def fraction(self, top: str, bottom: str) -> str:
        if len(top) == len(bottom) == 1 and (top + bottom).isdigit() and self.draw.random() < 0.3:
            return rf"\frac{top}{bottom}"
        form = self.either(r"\frac{{{}}}{{{}}}", r"\dfrac{{{}}}{{{}}}", r"{{{} \over {}}}")
        return form.format(top, bottom)

    def factors(self, number: sp.Expr, product: sp.Expr, behind: bool = False) -> str:
        """`behind` says that something stands before it already."""
        found = [each for each in sp.Mul.make_args(product) if each != 1]
        self.draw.shuffle(found)
        found.sort(key=lambda each: bool(each.has(sp.sin, sp.cos)))
        alone = len(found) == 1 and number == 1 and not behind
        written = [self.factor(each, alone) for each in found]
        if number != 1 or not written:
            written.insert(0, sp.latex(number))
        return self.either(" ", " ", r" \, ", r" \cdot ", r"\;").join(written)

    def factor(self, factor: sp.Expr, alone: bool) -> str:
        if factor.is_Add:
            return self.write(factor) if alone else self.enclosed(self.write(factor))
        return self.power(factor.base, factor.exp) if factor.is_Pow else self.atom(factor)

    def power(self, base: sp.Expr, exponent: sp.Expr) -> str:
        if exponent == sp.Rational(1, 2):
            return rf"\sqrt{{{self.write(base)}}}"
        above = f"^{exponent}" if exponent in range(2, 10) else f"^{{{self.write(exponent)}}}"
        if isinstance(base, sp.sin | sp.cos) and self.draw.random() < 0.7:
            return self.turning(base, above)
        return (self.atom(base) if base.is_Symbol else self.enclosed(self.write(base))) + above

    def enclosed(self, inside: str) -> str:
        return self.either(
            f"({inside})", rf"\left({inside}\right)", f"[{inside}]", rf"\bigl( {inside} \bigr)"
        )

    # -- what stands alone ------------------------------------------------------------------------

    def atom(self, atom: sp.Expr) -> str:
        if atom.is_Symbol:
            return self.name(str(atom))
        if isinstance(atom, sp.sin | sp.cos):
            return self.turning(atom, "")
        if isinstance(atom, sp.atan2):
            arguments = self.round(", ".join(map(self.write, atom.args)))
            return self.either(r"\operatorname{atan2}", r"\mathrm{atan2}", "atan2") + arguments
        if isinstance(atom, sp.Abs):
            return self.either("|{}|", r"\left|{}\right|").format(self.write(atom.args[0]))
        if type(atom) in FUNCTIONS:
            return FUNCTIONS[type(atom)] + self.round(self.write(atom.args[0]))
        return str(sp.latex(atom))

    def turning(self, call: sp.Expr, power: str) -> str:
        """A sine or cosine, its exponent behind its name."""
        (angle,), cosine = call.args, isinstance(call, sp.cos)
        index = joints(angle)
        if self.letters and index:
            low = f"{{{index}}}" if len(index) > 1 else self.either(index, f"{{{index}}}")
            return f"{self.letters[0 if cosine else 1]}_{low}{power}"
        name, inside = FUNCTIONS[type(call)] + power, self.write(angle)
        if angle.is_Symbol and self.draw.random() < 0.6:
            return f"{name}{inside}" if inside.startswith("\\") else f"{name} {inside}"
        return name + self.round(inside)

    def round(self, inside: str) -> str:
        return self.either(f"({inside})", rf"\left({inside}\right)")

    def name(self, name: str) -> str:
        found = re.fullmatch(r"([A-Za-z]+?)(?:_(?!d?dot)(\w+?)|(\d+))?(?:_(d?dot))?", name)
        assert found is not None, name
        letter, index, accent = found[1], found[2] or found[3] or "", found[4]
        letter = f"\\{letter}" if letter in GREEK else letter
        low = f"_{{{index}}}" if index else ""
        low = self.either(low, f"_{index}") if len(index) == 1 else low
        if not accent:
            return letter + low
        return self.either(
            rf"\{accent}{{{letter}}}{low}", rf"\{accent}{{{letter}{low}}}", rf"\{accent} {letter}{low}"
        )

    # -- around it --------------------------------------------------------------------------------

    def matrix(self, rows: Sequence[Sequence[sp.Expr]]) -> str:
        body = r" \\ ".join(self.either(" & ", "&").join(map(self.write, row)) for row in rows)
        return self.either(
            rf"\begin{{bmatrix}} {body} \end{{bmatrix}}",
            rf"\begin{{pmatrix}} {body} \\ \end{{pmatrix}}",
            rf"\left[\begin{{array}}{{{'c' * len(rows[0])}}} {body} \end{{array}}\right]",
            rf"\left( \begin{{matrix}} {body} \end{{matrix}} \right)",
        )

    def around(self, formula: str) -> str:
        return self.either(
            formula, formula, f"X = {formula}", rf"\boxed{{{formula}}}", rf"\[ X = {formula} \]",
            f"$ {formula} $", rf"\begin{{align}} X &= {formula} \end{{align}}", rf"{formula} \tag{{4.2}}",
            rf"X \equiv {formula}", f"{formula},",
        )  # fmt: skip


def joints(angle: sp.Expr) -> str:
    """12 of theta1 + theta2; nothing of what is no sum of joint angles."""
    terms = [re.fullmatch(r"theta_?(\d)", str(term)) for term in sp.Add.make_args(angle)]
    return "".join(sorted(term[1] for term in terms if term)) if all(terms) else ""
