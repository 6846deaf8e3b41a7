"""What a count of freedoms is held to: a mechanism built at random, and all that is said about it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Phrase, Step
from derive.expression import Symbol
from derive.expression import number as _tree
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.mechanism._facts import Facts
from derive.mechanics.mobility import Mechanism, Space

if TYPE_CHECKING:
    from derive.kinds.mechanism._oracle import Instance, Pair, Sort

CLOSED_OUTSIDE: dict[Space, tuple[Space, ...]] = {
    "spatial": ("planar", "spherical"),
    "planar": (),
    "spherical": (),
}
FLAT: dict[Space, set[str]] = {  # joints that are possible there
    "planar": {"revolute", "prismatic"},
    "spherical": {"revolute", "universal"},
}


@dataclass(frozen=True, slots=True)
class Built:
    """A mechanism by its sorts of joints, and an instance of it where that is not too large."""

    space: Space
    bodies: int
    sorts: tuple[Sort, ...]
    instance: Instance | None
    legs: tuple[tuple[Pair, ...], ...]
    index: int

    @staticmethod
    def of(mechanism: Mechanism) -> Built:
        """By its legs, where it is given by them, or else by its joints."""
        from derive.kinds.mechanism import _oracle as made

        legs: tuple[tuple[Pair, ...], ...] = ()
        size = len(made.COORDINATES[mechanism.space])
        if mechanism.legs:
            bodies = 2 + sum(count * (len(chain) - 1) for chain, count in mechanism.legs)
            letters = [(made.LETTERS[x], count) for chain, count in mechanism.legs for x in chain]
            sorts = tuple(made.Sort(name, count) for name, count in letters)
        else:
            bodies = mechanism.bodies
            sorts = tuple(made.Sort(j.name, j.count, j.joining, j.constraints) for j in mechanism.joints)
        instance = None
        if size * bodies <= made.LARGEST:
            if mechanism.legs:
                instance, legs = made.of_legs(mechanism.space, mechanism.legs)
            else:
                instance = made.assembled(mechanism.space, bodies, sorts)
        index = made.index(mechanism.space, bodies, sorts)
        return Built(mechanism.space, bodies, sorts, instance, legs, index)

    @property
    def pairs(self) -> Counter[str]:
        """How many there are of each sort."""
        found = Counter[str]()
        for each in self.sorts:
            found[each.name] += each.count * (each.joining - 1)
        return found

    @property
    def loops(self) -> int:
        """Pairs beyond a tree of the bodies; of an instance by following it."""
        return self.instance.loops if self.instance else self.pairs.total() - (self.bodies - 1)

    def lying(self, space: Space) -> int | None:
        """The index of the same joints in a plane or about a point; None where they cannot lie so."""
        from derive.kinds.mechanism import _oracle as made

        possible = self.pairs.keys() <= FLAT[space]
        return made.index(space, self.bodies, self.sorts) if possible else None


def proofs(
    mechanism: Mechanism, steps: tuple[Step, ...], told: Facts, results: Mapping[str, int]
) -> Iterator[Claim]:
    """`results` are those that are printed, `told` is what the words say."""
    dof, idle = results["dof"], results.get("idle", 0)
    built = Built.of(mechanism)
    yield route("constraints-of-a-joint", (_is_counted(each, built) for each in told.takes))
    yield route("as-written", _lines(steps, built, dof, idle))
    if built.instance is None:
        yield route("random-joints", (dof == built.index,))
    else:
        yield route("random-instance", (dof == built.instance.motions - built.instance.repeated,))
        if built.instance.motions == max(built.index, 0):
            yield route("moves", (told.sign == _sign(built.instance.motions - built.instance.repeated),))
    yield route("as-said", _said(mechanism, told, built))
    yield route("without-idle", _idle(mechanism, results))
    if mechanism.legs and built.instance is not None:
        yield route("idle-rods", (idle == sum(map(built.instance.spins, built.legs)),))


def _lines(steps: tuple[Step, ...], built: Built, dof: int, idle: int) -> Iterator[bool]:
    """Each formula of the lines in numbers; a line without one says nothing."""
    from derive.kinds.mechanism import _oracle as made

    size = len(made.COORDINATES[built.space])
    taken = size * (built.bodies - 1) - built.index
    known = {step.name: step for step in steps}
    yield at(known["size"].result, {}) == size
    for step, worth in ((known["constraints"], taken), (known["dof"], dof)):
        yield len(step.chain) > 1
        yield from (at(expr, {"C": float(taken)}) == worth for expr in step.chain[1:])
    yield ("effective" in known) == bool(idle)
    for expr in known["effective"].chain if idle else ():
        yield at(expr, {"dof": float(dof)}) == dof - idle


def _is_counted(told: Phrase, built: Built) -> bool:
    """What a joint of a sort leaves, and what it takes away."""
    from derive.kinds.mechanism import _oracle as made

    freedoms, each = _number(told, "freedoms"), _number(told, "constraints")
    sort = told.about.get("sort")
    if isinstance(sort, Phrase):
        right = told.key == "takes" and each == made.constraints_of(built.space, made.Sort(sort.key, 1))
    else:
        right = told.key == "other-takes" and each in {s.constraints for s in built.sorts if not s.name}
    return right and freedoms + each == len(made.COORDINATES[built.space])


def _number(phrase: Phrase, field: str) -> int:
    """What is said there; -1 where it is no number."""
    said = phrase.about.get(field)
    return round(at(said, {})) if isinstance(said, TREES) else -1


def _sign(value: int) -> int:
    return (value > 0) - (value < 0)


def _said(mechanism: Mechanism, told: Facts, built: Built) -> Iterator[bool]:
    """Everything the words tell, worked out again."""
    pairs = built.pairs
    yield told.space == built.space
    yield told.bodies == (Symbol("n"), _tree(built.bodies))
    several_loops = Phrase("loops", {"count": _tree(built.loops)})
    yield told.loops == (several_loops if built.loops > 1 else Phrase("one-loop") if built.loops else None)
    yield _totals(told.together) == {name or "other": count for name, count in pairs.items()}
    yield {_sort(each) for each in told.takes} == {_sort(each) for each in told.together}
    stuck = built.loops > 0 > built.index
    yield told.sign == _sign(built.index) and told.missing == (_tree(-built.index) if stuck else None)
    rods = mechanism.rods
    yield told.idle == (_tree(rods) if rods else None)
    yield told.motors == (_tree(built.index - rods) if built.index > rods else None)
    yield told.sliders == ("prismatic" in pairs)
    yield told.legs == tuple((chain, _tree(n), _tree(len(chain[1:]))) for chain, n in mechanism.legs)
    several = [each for each in built.sorts if each.joining > 2]
    yield told.coincident == tuple(
        (Phrase(s.name) if s.name else None, *map(_tree, (s.joining, s.joining - 1))) for s in several
    )
    others = [(space, built.lying(space)) for space in CLOSED_OUTSIDE[built.space] if built.loops > 0]
    yield [(space, n) for space, _, n in told.others] == [
        (space, _tree(n)) for space, n in others if n is not None and n > 0 and n > built.index
    ]
    yield all(size == (Symbol("lambda"), _tree(_size(space))) for space, size, _ in told.others)
    spatial = built.space == "spatial" and built.loops > 0
    held_twice = spatial and not rods and not mechanism.legs and pairs["spherical"] > 1
    yield told.may_spin == (Phrase("idle-rods-apart") if held_twice else None)
    known = spatial and built.loops == 1 and pairs.keys() == {"revolute"} and 3 < pairs.total() < 7
    yield told.pairs == (_tree(pairs.total()) if known else None)
    yield not known or pairs.total() < 6 or _freedoms_of_sarrus() == 1


def _freedoms_of_sarrus() -> int:
    from derive.kinds.mechanism import _oracle as made

    return made.freedoms_of_sarrus()


def _size(space: Space) -> int:
    from derive.kinds.mechanism import _oracle as made

    return len(made.COORDINATES[space])


def _idle(mechanism: Mechanism, results: Mapping[str, int]) -> Iterator[bool]:
    """What is left without idle rods, where there are some."""
    rods = {"idle": mechanism.rods, "effective": results["dof"] - mechanism.rods} if mechanism.rods else {}
    yield dict(results) == {"dof": results["dof"], **rods}


def _totals(together: tuple[Phrase, ...]) -> dict[str, int]:
    """The pairs of each sort, as they are told."""
    found = Counter[str]()
    for each in together:
        found[_sort(each)] += 1 if each.key == "one" else _number(each, "count")
    return dict(found)


def _sort(phrase: Phrase) -> str:
    """Which joints it speaks of."""
    sort = phrase.about.get("sort")
    return sort.key if isinstance(sort, Phrase) else "other"
