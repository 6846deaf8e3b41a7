"""What the author of a kind imports, in one line: the board, the trees, the normal form, claims and options.

A kind is a module with `class Options(OptionsModel)` and `derive(subject, options, problem)`, and a file of
words of the same name in `templates/words/`. CONTRIBUTING.md shows one from end to end.
"""

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, matrix_numbers, numbers, scalar_number
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Claim, Derivation, PageFacts, Phrase, Plot, Record, Step, Table
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    PI,
    ZERO,
    Derivative,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Relation,
    Sum,
    Symbol,
    add,
    column,
    cos,
    free_symbols,
    multiply,
    negate,
    number,
    replace,
    sin,
    sqrt,
    squared,
    subtract,
    symbols,
    transpose,
)
from derive.kinds.checks import agreement, close, is_rotation, law, random_points
from derive.kinds.fields import Evaluation, NoOptions, OptionsModel, Quantity
from derive.kinds.links import links
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.names import free, named

__all__ = [
    "ONE",
    "PI",
    "ZERO",
    "Branch",
    "Claim",
    "Derivation",
    "Derivative",
    "Evaluation",
    "Expr",
    "Matrix",
    "NoOptions",
    "NotDerivable",
    "Number",
    "OptionsModel",
    "PageFacts",
    "Phrase",
    "Plot",
    "Point",
    "Power",
    "Problem",
    "Product",
    "Quantity",
    "Quotient",
    "Record",
    "Relation",
    "Scalar",
    "ScalarMatrix",
    "Step",
    "Sum",
    "Symbol",
    "Table",
    "Work",
    "add",
    "agreement",
    "close",
    "column",
    "cos",
    "free",
    "free_symbols",
    "is_rotation",
    "law",
    "links",
    "matrix_numbers",
    "multiply",
    "named",
    "negate",
    "normal",
    "normal_matrix",
    "number",
    "numbers",
    "random_points",
    "replace",
    "scalar_number",
    "sin",
    "sqrt",
    "squared",
    "subtract",
    "symbols",
    "transpose",
]  # fmt: skip
