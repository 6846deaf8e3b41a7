"""How long a formula is: its operations, counted as SymPy counts them."""

from __future__ import annotations

from derive.expression import Call, Expr, Number, Power, Product, Quotient, Sum, children, is_negative


def operations(expr: Expr) -> int:
    """Additions, products, quotients, powers, signs and function calls.

    A rational number p/q counts as a quotient; a sine or cosine counts one, as in SymPy's
    `count_ops`, whatever its argument, for it prints as one letter (c_12).
    """
    inner = sum(map(operations, children(expr)))
    match expr:
        case Number(value):
            return int(value.denominator > 1)
        case Call("cos" | "sin"):
            return 0
        case Sum(terms):
            return inner + len(terms) - 1 + int(is_negative(terms[0]))
        case Product((Number(value), *rest)) if value in (1, -1):
            return inner + len(rest) - 1
        case Product((Number(value), *rest)) if value.numerator in (1, -1):
            return inner + len(rest) - 1
        case Product(factors):
            return inner + len(factors) - 1
        case Quotient() | Power() | Call():
            return inner + 1
    return inner
