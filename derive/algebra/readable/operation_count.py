"""How long a formula is: its operations, counted as SymPy counts them but for signs and roots."""

from __future__ import annotations

from derive.expression import Call, Expr, Number, Power, Product, Quotient, Sum, children, is_negative


def operations(expr: Expr) -> int:
    """Additions, products, quotients, powers, signs and function calls.

    SymPy's `count_ops` of the tree as it stands, every sine and cosine taken for one letter, for so it is
    printed (c_12). Two things count one less here: a square root is one call, where `count_ops` sees a
    power and a quotient, and a lone minus sign is nothing: -a b is one product. Before the first term of
    a sum it is an operation, -a - b has two, and between terms it is the subtraction.
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
