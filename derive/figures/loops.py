"""Systems drawn as block diagrams: alone, and in a loop with a controller."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

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
NO_LABELS: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Pictured:
    """A diagram, and how it is drawn."""

    diagram: Diagram
    drawing: Drawing


def drawn_blocks(system: System, whole: Rational, style: Style) -> Drawing:
    """The diagram of a system as a teacher draws it; one block, G(s), where that could not be read. Raises
    NotDerivable where none can be built."""
    diagram, _ = drawn(system, whole, None, style)
    try:
        return pictured(system, diagram, "figure").drawing
    except NotDerivable:
        entry, output = system.input.name, system.output.name
        blocks = source(entry), transfer(output, (SYSTEM,), (ONE,))
        alone = Diagram(blocks, (Line(entry, output),), entry, output)
        return pictured(system, alone, "figure", {output: SYSTEM.name}).drawing


def pictured(system: System, diagram: Diagram, name: str, labels: Mapping[str, str] = NO_LABELS) -> Pictured:
    """A diagram with the names of the signals of its system, and those that a loop adds. Raises NotDerivable
    where it could not be read."""
    caption = Phrase("drawn-blocks", {"input": Symbol(diagram.input), "output": system.output})
    error = diagram.targets(diagram.input) if diagram.input not in system.names else ()
    signals = frozenset((*system.names, diagram.input, *error))
    layout = Layout(diagram, signals, labels)
    return Pictured(diagram, layout.drawing(name, caption, seen(diagram, signals)))


def looped(system: System, whole: Rational, style: Style) -> Pictured:
    """The system in a loop with a controller C(s), the reference and the error: block by block, with what
    disturbs it, where that can be built and read, else as one block G(s)."""
    try:
        inner, wired = drawn(system, whole, None, style)
        if wired:
            return _looped(system, inner)
    except NotDerivable:
        pass
    return _looped(system, None)


def _looped(system: System, inner: Diagram | None) -> Pictured:
    entry, output = system.input.name, system.output.name
    reference, error = free(system.names, "r", "r_d"), free(system.names, "e", "e_r")
    labels = {entry: CONTROLLER.name}
    lines: tuple[Line, ...] = (Line(entry, output),)
    plant = [transfer(output, (SYSTEM,), (ONE,))]
    framed = None
    if inner is None:
        labels[output] = SYSTEM.name
    else:
        plant = [block for block in inner.blocks if block.name != entry]
        lines, framed = inner.lines, Framed(frozenset(block.name for block in plant), SYSTEM.name)
    blocks = source(reference), summing(error, (1, -1)), transfer(entry, (CONTROLLER,), (ONE,)), *plant
    outer = (Line(reference, error, 1), Line(output, error, 2), Line(error, entry))
    diagram = Diagram(blocks, (*outer, *lines), reference, output)
    about: dict[str, Said] = {"input": system.input, "output": system.output}
    about |= {"error": Symbol(error), "reference": Symbol(reference)}
    signals = frozenset((*system.names, reference, error))
    layout = Layout(diagram, signals, labels)
    return Pictured(
        diagram, layout.drawing("loop", Phrase("drawn-loop", about), seen(diagram, signals), framed)
    )


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
