"""What is said about a transfer function and on the way to it, worked out again from what is printed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.control.oracle.equations import Numeric, value
from derive.control.oracle.growth import degree
from derive.derivation import Claim, Phrase, Step
from derive.expression import ONE, Expr, Product, Quotient, Relation, Symbol, free_symbols
from derive.kinds.checks import route
from derive.kinds.fields import TREES, OptionsModel
from derive.kinds.system._drift import DriftAtPoint, is_drift, is_drift_there
from derive.kinds.system._oracle import Held, Point, names_inside, reals
from derive.kinds.system._transfer_facts import Facts, Told

WAYS = (("given-directly", "solve"), ("put-into", "solve-and-put"))  # with nothing put in, and with something
LAST = (("left", "only-one"), ("left-put",))
NEARLY = 1e-9
NAME = "transfer-function"


def said(held: Held, told: Facts, steps: Sequence[Step], G: Expr, asked: OptionsModel) -> Claim:
    """Degree, proper or not, integrating or not; which inputs and signals; where the equations are."""
    system, ends = held.system, {"input": held.source, "output": held.system.output}
    done = [step for step in steps if step.rule == "elimination"]
    motors = [each for each in ("armature", "field") if each in system.motor]
    plain = [
        told.described == Phrase(motors[0] if motors else "a-system") or _asked_before(held, told, asked),
        told.start == (Phrase("from-the-output", ends) if done else None),
        (told.input, told.output) == (held.source, system.output),
        *(_zero(held, step) for step in steps if step.rule == "superposition"),
        *names_inside(held, told.inside),
    ]
    return route("as-said", [*plain, *held.compared(lambda at: _degrees(held, told, steps, G, at))])


def _asked_before(held: Held, told: Facts, asked: OptionsModel) -> bool:
    """Whether the question that is said to have the equations already stands before the one that is asked."""
    number = told.described.about.get("number")
    kinds = {k: (kind, each == asked) for k, (kind, each) in enumerate(held.problem.questions, 1)}
    own = [k for k, each in kinds.items() if each == (NAME, True)]
    return isinstance(number, int) and kinds[number] == (NAME, False) and number < min(own, default=0)


def _zero(held: Held, step: Step) -> bool:
    """Which input is set to zero, and for which."""
    if not isinstance(step.facts, Told):
        return False
    zero = {"zero": Relation(step.chain[0], "=", step.chain[1])}
    usual = held.source == held.system.input
    wanted = (
        Phrase("disturbance-zero", zero) if usual else Phrase("others-zero", zero | {"input": held.source})
    )
    return step.facts.said == wanted


def _degrees(held: Held, told: Facts, steps: Sequence[Step], G: Expr, at: Point) -> Iterator[bool]:
    whole = next(step.chain[2] for step in steps if step.name == "G")
    left = next((step.result for step in steps if step.rule == "cancel"), None)
    order, lost = denominator_degree(whole, at), told.cancelled.about.get("count", 0) if told.cancelled else 0
    vanishes = not abs(value(G, at))
    yield told.found == (Phrase("vanishes", {"input": told.input}) if vanishes else Phrase("ratio"))
    lose = Phrase("motion-cancels", {"count": lost}) if lost else Phrase("factor-cancels", {"s": Symbol("s")})
    yield told.cancelled == (None if left is None else lose)
    if left is not None and (after := denominator_degree(left, at)) is not None:
        yield order is None or order - after == lost
    if vanishes:
        return
    nature = told.nature.key if told.nature else ""
    yield nature in ("", "improper", "integrates", "integrates-often")
    far, near = (degree(lambda s: value(G, {**at, "s": s}), inward) for inward in (False, True))
    yield from is_drift(steps, nature == "integrates", held, at)
    if told.nature and nature.startswith("integrates"):
        about = {"s": Symbol("s"), "input": told.input, "output": told.output}
        yield told.nature.about == {"order": told.nature.about["order"], **about}
        yield order is None or told.nature.about["order"] == order
    if far is not None:
        yield (nature == "improper") == (far > 0)
    if near is not None and nature != "improper":
        yield near == -1 if nature == "integrates" else near < 0 if nature else near >= 0 or bool(lost)


def drift_claims(held: Held, told: DriftAtPoint | None, steps: Sequence[Step]) -> Iterator[Claim]:
    """The rate in numbers of a system that integrates."""
    if told and told.drift:
        yield route("rate-in-numbers", held.compared(lambda at: is_drift_there(told, steps, held, at)))


def is_degree(told: int, seen: int | None) -> Iterator[bool]:
    """Whether a degree is the one that is seen, if one is."""
    if seen is not None:
        yield told == seen


def denominator_degree(tree: Expr, at: Point) -> int | None:
    """The degree in s of what stands below the bar."""
    factors = tree.factors if isinstance(tree, Product) else (tree,)
    below = next((each.denominator for each in factors if isinstance(each, Quotient)), ONE)
    return degree(lambda s: value(below, {**at, "s": s}))


def eliminations(held: Held, steps: Sequence[Step]) -> Claim:
    """What each elimination is said to be: the equation holds, the signal stands in it, and what is put in
    has been found before."""
    done = [step for step in steps if step.rule in ("elimination", "relation")]
    return route("eliminations", [*_told(held, done), *held.compared(lambda at: _holding(held, done, at))])


def _told(held: Held, steps: Sequence[Step]) -> Iterator[bool]:
    known: list[Expr] = []
    for step in steps:
        said = step.facts.said if isinstance(step.facts, Told) else Phrase("only-one")
        equation, signal, put = (said.about.get(name) for name in ("equation", "signal", "put"))
        sides = (equation.left, equation.right) if isinstance(equation, Relation) else step.chain[:2]
        inside = frozenset[str]().union(*(free_symbols(side) for side in sides if isinstance(side, TREES)))
        before = {each for each in known if isinstance(each, Symbol) and each.name in inside}
        yield {*(put if isinstance(put, tuple) else ())} <= before
        yield (put is not None) == bool(before)
        yield said.key in (LAST if step.rule == "relation" else WAYS)[put is not None]
        if step.rule == "relation":
            ends = {"input": held.source, "output": held.system.output}
            yield {name: tree for name, tree in said.about.items() if name in ends} == ends
            yield (said.key == "only-one") == (len(steps) == 1)
            continue
        explicit = said.key in ("put-into", "given-directly")
        yield explicit == (step.chain[0] in sides) and step.chain[0] not in known
        yield signal in (None, step.chain[0]) and (not explicit or step.chain[1] in sides)
        known.append(step.chain[0])


def _holding(held: Held, steps: Sequence[Step], at: Point) -> Iterator[bool]:
    solved = Numeric.of(held.system, held.source, reals(at))
    found = {**at, **solved.signals(at["s"], {held.source: 1.0})}
    size = max(map(abs, found.values()))
    for step in steps:
        said = step.facts.said.about.get("equation") if isinstance(step.facts, Told) else None
        pair = (said.left, said.right) if isinstance(said, Relation) else step.chain[:2]
        left, right = (value(side, found) for side in pair if isinstance(side, TREES))
        yield abs(left - right) <= NEARLY * max(abs(left), abs(right), size)
