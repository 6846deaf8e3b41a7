"""Systems drawn as block diagrams: alone, and in a loop with a controller."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from derive.algebra.readable.terms import Style
from derive.control.diagram import Block, Diagram, Line, source, summing, transfer
from derive.control.rational import Rational
from derive.control.system import System
from derive.derivation import Drawing, Phrase, Said
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Symbol, add, multiply, negate
from derive.figures.block_diagram import drawn
from derive.figures.block_layout import Framed, Layout, transfer_label
from derive.names import free

CONTROLLER, SYSTEM = Symbol("C(s)"), Symbol("G(s)")


@dataclass(frozen=True, slots=True)
class Pictured:
    """A diagram as it is to be drawn: the signals with names, `labels` that stand for transfer functions, and
    the blocks that are framed as one system."""

    name: str
    diagram: Diagram
    signals: frozenset[str]
    caption: Phrase
    labels: Mapping[str, str] = field(default_factory=dict)
    framed: Framed | None = None

    def drawing(self) -> Drawing:
        """On paper."""
        layout = Layout(self.diagram, self.signals, self.labels)
        return layout.drawing(self.name, self.caption, seen(self.diagram, self.signals), self.framed)


def drawn_blocks(system: System, whole: Rational, style: Style) -> Drawing:
    """The diagram of a system as a teacher draws it. Raises NotDerivable where none can be built."""
    diagram, _ = drawn(system, whole, None, style)
    return pictured(system, diagram, "figure").drawing()


def pictured(system: System, diagram: Diagram, name: str) -> Pictured:
    """A diagram with the names of the signals of its system, and those that a loop adds."""
    caption = Phrase("drawn-blocks", {"input": Symbol(diagram.input), "output": system.output})
    error = diagram.targets(diagram.input) if diagram.input not in system.names else ()
    return Pictured(name, diagram, frozenset((*system.names, diagram.input, *error)), caption)


def looped(system: System, whole: Rational, style: Style) -> Pictured:
    """The system, block by block where it can be built, in a loop with a controller C(s), with the reference,
    the error, and what disturbs it."""
    entry, output = system.input.name, system.output.name
    reference, error = free(system.names, "r", "r_d"), free(system.names, "e", "e_r")
    try:
        inner, wired = drawn(system, whole, None, style)
        plant = [block for block in inner.blocks if block.name != entry] if wired else []
    except NotDerivable:
        plant = []
    lines = inner.lines if plant else (Line(entry, output),)
    labels = {entry: CONTROLLER.name} if plant else {entry: CONTROLLER.name, output: SYSTEM.name}
    framed = Framed(frozenset(block.name for block in plant), SYSTEM.name) if plant else None
    blocks = (
        source(reference), summing(error, (1, -1)), transfer(entry, (CONTROLLER,), (ONE,)),
        *(plant or [transfer(output, (SYSTEM,), (ONE,))]),
    )  # fmt: skip
    outer = (Line(reference, error, 1), Line(output, error, 2), Line(error, entry))
    diagram = Diagram(blocks, (*outer, *lines), reference, output)
    about: dict[str, Said] = {"input": system.input, "output": system.output}
    about |= {"error": Symbol(error), "reference": Symbol(reference)}
    signals = frozenset((*system.names, reference, error))
    return Pictured("loop", diagram, signals, Phrase("drawn-loop", about), labels, framed)


def seen(diagram: Diagram, signals: frozenset[str]) -> Phrase:
    """Every block with what enters it and what leaves it, from the input on."""
    blocks = [b for b in diagram.blocks if b.shape != "source"]
    named = [b for b in blocks if b.name in signals or _is_derivative(b.name, signals)]
    return Phrase("seen-blocks", {"blocks": tuple(_told(diagram, block, signals) for block in named)})


def _told(diagram: Diagram, block: Block, signals: frozenset[str]) -> Phrase:
    about = {"input": _entering(diagram, block, signals), "output": Symbol(block.name)}
    if block.shape == "sum":
        return Phrase("seen-sum", about)
    return Phrase("seen-block", {**about, "block": transfer_label(block)})


def _entering(diagram: Diagram, block: Block, signals: frozenset[str]) -> Expr:
    """What enters a block, by the signals that have names."""
    pairs = zip(_signs(block, diagram), diagram.into(block), strict=True)
    trees = [(sign, _signal(diagram, name, signals)) for sign, name in pairs]
    return add(*(tree if sign > 0 else negate(tree) for sign, tree in trees))


def _signs(block: Block, diagram: Diagram) -> tuple[int, ...]:
    return block.signs if block.shape == "sum" else (1,) * len(diagram.into(block))


def _signal(diagram: Diagram, name: str, signals: frozenset[str]) -> Expr:
    block = diagram.block(name)
    if block.shape == "source" or name in signals or _is_derivative(name, signals):
        return Symbol(name)
    inside = _entering(diagram, block, signals)
    return inside if block.shape == "sum" else multiply(transfer_label(block), inside)


def _is_derivative(name: str, signals: frozenset[str]) -> bool:
    return name.removesuffix("_dot").removesuffix("_ddot") in signals
