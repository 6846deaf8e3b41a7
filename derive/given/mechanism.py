"""What is given of a mechanism: its space, its bodies and its joints, or its legs."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase, Said
from derive.given.datum import Datum
from derive.given.linkages import of_linkage
from derive.kinds.problem import Problem
from derive.mechanics.linkages import Linkage
from derive.mechanics.mobility import LETTERS, Joints, Mechanism

SORTS = {
    "revolute": "revolute|hinge|pin", "prismatic": "prismatic|slid", "helical": "helical|screw",
    "cylindrical": "cylindrical", "universal": "universal", "spherical": "spherical|ball", "planar": "planar",
}  # fmt: skip
SPACES = {"planar": "plane|planar|linkage", "spatial": "space|spatial", "spherical": "spher"}

IN_QUESTIONS = True


def data(mechanism: Mechanism | Linkage, problem: Problem) -> Iterator[Datum]:
    """Its parts."""
    if not isinstance(mechanism, Mechanism):
        yield from of_linkage(mechanism)
        return
    about: dict[str, Said] = {"space": Phrase(mechanism.space)}
    if mechanism.legs:
        for chain, count in mechanism.legs:
            joints = tuple(Phrase(f"one-{LETTERS[letter]}") for letter in chain)
            said = Phrase("legs", about | {"count": count, "joints": joints})
            yield Datum(said, words=(SPACES[mechanism.space], *(SORTS[LETTERS[letter]] for letter in chain)))
        return
    sorts = dict.fromkeys(SORTS[each.name] for each in mechanism.joints if each.name)
    about |= {"bodies": mechanism.bodies, "joints": tuple(map(_joints, mechanism.joints))}
    yield Datum(Phrase("parts", about), words=(SPACES[mechanism.space], *sorts))
    if mechanism.rods:
        yield Datum(Phrase("rods", {"rods": mechanism.rods}), words=("rod",))


def _joints(joints: Joints) -> Phrase:
    """So many of one sort; one that joins several bodies is no pair."""
    unknown = {} if joints.name else {"constraints": joints.constraints}
    about: dict[str, Said] = {"sort": Phrase(joints.name or "constrained", unknown)}
    if joints.count > 1:
        about["count"] = joints.count
    if joints.joining > 2:
        about["joining"] = joints.joining
    key = "joining" if joints.joining > 2 else "joints"
    return Phrase(key if joints.count > 1 else f"{key}-one", about)
