"""A worked answer as a value: what was found, by which steps, and what was verified about it.

Frozen values and no behaviour beyond reading them. There is no English and no LaTeX here: the
sentences live in `templates/words/` and refer to the steps by name. `said` has phrases and tables,
`pictures` figures, `answer` the rest.
"""

from derive.derivation.answer import (
    Branch,
    Claim,
    Derivation,
    LinearSystem,
    PageFacts,
    Result,
    Step,
    as_matrix,
    has_equations,
)
from derive.derivation.pictures import (
    Caption,
    Curve,
    Drawing,
    Figure,
    Panels,
    Place,
    Plot,
    Span,
    Stroke,
    Words,
)
from derive.derivation.said import (
    Cell,
    Condition,
    Label,
    Phrase,
    Record,
    Said,
    Table,
)

__all__ = [
    "Branch",
    "Caption",
    "Cell",
    "Claim",
    "Condition",
    "Curve",
    "Derivation",
    "Drawing",
    "Figure",
    "Label",
    "LinearSystem",
    "PageFacts",
    "Panels",
    "Phrase",
    "Place",
    "Plot",
    "Record",
    "Result",
    "Said",
    "Span",
    "Step",
    "Stroke",
    "Table",
    "Words",
    "as_matrix",
    "has_equations",
]
