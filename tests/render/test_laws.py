"""The laws that words have as they were typed: listed, and true of random matrices."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from functools import reduce
from itertools import product
from typing import Any

import numpy as np
import pytest

from derive.answers.latex.letters import Letters
from derive.answers.latex.parser import read_latex
from derive.answers.latex.printed import parts_of
from derive.errors import FormulaError
from derive.expression import Call, Expr, Indexed, Number, Power, Product, Quotient, Sum, Symbol
from derive.render.skin import templates
from derive.render.typed import is_law, laws

Array = Any
RELATION = re.compile(r"=|<|>|\\leq|\\geq|\\neq|\\approx")
INLINE = re.compile(r"\$((?:[^$\n{}]|\{(?:[^{}$]|\{(?:[^{}$]|\{[^{}$]*\})*\})*\})+)\$")
DISPLAYED = re.compile(r'formula\("((?:[^"\\]|\\.)*)"\)')
CHOSEN = re.compile(r"\{\{|if z ==")  # put together by the template: seen where a page has it


def typed() -> list[tuple[str, str]]:
    """The formulas that stand in the templates as they are, with the names of their files."""
    found = []
    for file in sorted((templates() / "words").rglob("*.j2")):
        text = file.read_text(encoding="utf-8")
        whole = [found.replace("\\\\", "\\") for found in (*INLINE.findall(text), *DISPLAYED.findall(text))]
        found += [(file.name, each) for each in whole if RELATION.search(each) and not CHOSEN.search(each)]
    return found


def test_every_typed_formula_is_a_law_that_is_listed() -> None:
    assert len(typed()) >= 35
    assert [each for each in typed() if not is_law(each[1])] == []


# -- laws in an instance ------------------------------------------------------------------------------

WRITTEN = (
    (r"\\,", ""), (r"\\dot ([a-zA-Z])", r"\\dot{\1}"), (r"\\ddot ([a-zA-Z])", r"\\ddot{\1}"), (r"\(q\)", ""),
    (r"\\frac\{\\partial d_\{(\w)(\w)\}\}\{\\partial q_(\w)\}", r"\\mathrm{dd}_{\1,\2,\3}"),
    (r"\\frac\{\\partial D\}\{\\partial q_i\}", r"\\mathrm{DD}_i"),
    (r"_\{([ijk])([ijk])\}", r"_{\1,\2}"), (r"_\{([ijk])([ijk])([ijk])\}", r"_{\1,\2,\3}"),
    (r"\\sum_", r"\\Sigma_"),
    (r"\\delta ([qp])", r"\\mathrm{d\1}"),
)  # fmt: skip
CONDITIONS = (r"\dot q^T \dot q = 1",)  # which rates are meant
TRIED = 19  # the others are of functions, of arrays, of an iteration, or say what a letter means


def column(*entries: float) -> Array:
    return np.array(entries, dtype=float).reshape(-1, 1)


def world() -> dict[str, Array]:
    """What the laws speak of: a mechanism of three joints with kinetic energy q_dot^T D q_dot / 2, where D is
    linear in q, its Jacobian, and rotations about an axis."""
    dice = np.random.default_rng(3)
    dd = dice.normal(size=(3, 3, 3))
    dd = dd + dd.transpose(1, 0, 2)  # of d_kj by q_i
    D = np.eye(3) * 9 + dd @ np.array([0.3, -0.2, 0.5])
    q_dot, q_ddot = dice.normal(size=(3, 1)), dice.normal(size=(3, 1))

    def coriolis(rate: Array) -> Array:
        """d/dt of dK/dq_dot without accelerations, less dK/dq: by the energy alone."""
        speed = np.einsum("kji,i,j->k", dd, rate, rate)
        return speed - 0.5 * np.einsum("ijk,i,j->k", dd, rate, rate)

    units = np.eye(3)
    c = np.array([
        [0.5 * (coriolis(a + b) - coriolis(a) - coriolis(b)) for b in units] for a in units
    ])  # c_ijk, made of the energies  # fmt: skip
    rate = q_dot.ravel()
    D_dot, C = np.einsum("kji,i->kj", dd, rate), np.einsum("ijk,i->kj", c, rate)
    J, J_dot = dice.normal(size=(3, 3)), dice.normal(size=(3, 3))
    g, B = dice.normal(size=(3, 1)), dice.normal(size=3)
    h = coriolis(rate).reshape(-1, 1) + g
    tau = D @ q_ddot + h
    axis = dice.normal(size=3)
    axis /= np.linalg.norm(axis)
    S = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    R = np.eye(3) + np.sin(0.7) * S + (1 - np.cos(0.7)) * S @ S
    v = J @ q_dot
    return {
        "D": D, "D_dot": D_dot, "C": C, "N": D_dot - 2 * C, "q_dot": q_dot, "q_ddot": q_ddot,
        "dd": dd, "c": c,
        "DD": dd.transpose(2, 0, 1), "d": D, "n": D_dot - 2 * C, "J": J, "J_dot": J_dot, "v": v, "h": h,
        "tau": tau,
        "v_dot": J @ q_ddot + J_dot @ q_dot, "Lambda": np.linalg.inv(J @ np.linalg.inv(D) @ J.T),
        "R": R, "I": np.eye(3), "eye": np.eye(3), "S": S, "omega": column(*axis),
        "p": dice.normal(size=(3, 1)),
        "g": g, "F_v": np.diag(B), "k": column(*axis), "S_k": S, "dq": q_dot, "dp": J @ q_dot,
    }  # fmt: skip


def value(tree: Expr, here: Mapping[str, Array], at: Mapping[str, int]) -> Array:
    """A tree of matrices in numbers; a sign of summation sums what is multiplied after it."""
    match tree:
        case Symbol(name):
            return here[name]
        case Number(exact):
            return float(exact)
        case Indexed(base, lower):
            found = here[base]
            return found[tuple(at[each.name] for each in lower if isinstance(each, Symbol))].squeeze()
        case Sum(terms):
            return sum(value(term, here, at) for term in terms)
        case Product((Indexed("Sigma", (first, *more)), *rest)) if isinstance(first, Symbol):
            inner: Expr = Product((Indexed("Sigma", tuple(more)), *rest)) if more else Product(tuple(rest))
            return sum(value(inner, here, {**at, first.name: k}) for k in range(3))
        case Product(factors):
            return reduce(multiplied, (value(factor, here, at) for factor in factors))
        case Quotient(top, bottom):
            return value(top, here, at) / value(bottom, here, at)
        case Power(base, Number(exact)) if exact == -1:
            return np.linalg.inv(value(base, here, at))
        case Call("transpose", (inside,)):
            return np.transpose(value(inside, here, at))
        case Call("det", (inside,)):
            return np.linalg.det(value(inside, here, at))
        case Call("adj", (inside,)):
            matrix = value(inside, here, at)
            return np.linalg.inv(matrix) * np.linalg.det(matrix)
        case Call("cross", (left, right)):
            return np.cross(value(left, here, at).ravel(), value(right, here, at).ravel()).reshape(-1, 1)
    raise KeyError(tree)


def multiplied(left: Array, right: Array) -> Array:
    matrices = np.ndim(left) == np.ndim(right) == 2
    product = left @ right if matrices else left * right
    return product.item() if np.size(product) == 1 else product


def read(law: str, here: Mapping[str, Array]) -> list[list[Expr]]:
    """The chains of a law, as trees of the names of a world."""
    for pattern, instead in WRITTEN:
        law = re.sub(pattern, instead, law)
    names = frozenset(here) | {"i", "j", "k"}
    letters = Letters(names, False, names, True, frozenset(here) | {"Sigma"}, frozenset(), True)
    chains = parts_of([law])
    return [[read_latex(part, letters)[0] for _, part in chain] for chain in chains]


def tried() -> dict[str, bool]:
    """The laws that speak of the world, and whether each holds in it."""
    here, found = world(), dict[str, bool]()
    for law in sorted(law for law in laws() if not re.search("[<>]|eq", law) and law not in CONDITIONS):
        try:
            chains = read(law, here)
        except FormulaError:
            continue
        if all(len(chain) > 1 for chain in chains):
            found[law] = all(holds(chain, here) for chain in chains)
    return found


def holds(chain: list[Expr], here: Mapping[str, Array]) -> bool:
    """Whether all parts of a chain are equal, for all indices."""
    for i, j, k in product(range(3), repeat=3):
        first, *others = (value(part, here, {"i": i, "j": j, "k": k}) for part in chain)
        if not all(np.allclose(first, other) for other in others):
            return False
    return True


def test_laws_hold_of_random_matrices() -> None:
    found = tried()
    assert [law for law, held in found.items() if not held] == []
    assert len(found) >= TRIED


@pytest.mark.parametrize(("right", "wrong"), [(" - ", " + "), ("ijk", "jki"), ("_{kj}", "_{ij}"), ("^T", "")])
def test_a_mistyped_law_does_not_hold(right: str, wrong: str) -> None:
    here = world()
    mistyped = [law.replace(right, wrong, 1) for law in tried() if right in law]
    assert mistyped
    for law in mistyped:
        with suppress(ValueError):  # shapes that do not go together
            assert not all(holds(chain, here) for chain in read(law, here)), law
