"""Whether a system comes back to a state of rest: by the stiffness there, exactly where it is exact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import completed, matrix_numbers, number
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import known_sign, odd_part
from derive.derivation import Phrase, Said
from derive.expression import Approximate, Relation, Symbol, add, is_negative, negate, terms_of, walk
from derive.kinds.lagrange._angles_found import Found
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._rest import there
from derive.mechanics.lagrangian import without

ROUNDED = 1e-6  # of the largest stiffness: one that is smaller may be zero
STABLE, UNSTABLE, OPEN = Phrase("stable"), Phrase("unstable"), Phrase("undecided")


def put_in(model: Model, value: Scalar, found: Found) -> Scalar:
    return there(model, value, {Symbol(q): tree for q, tree in found.values.items()})


def is_exact(found: Found) -> bool:
    return not any(isinstance(node, Approximate) for tree in found.values.values() for node in walk(tree))


def said(model: Model, found: Found, stiffness: ScalarMatrix, positive: set[str]) -> Phrase:
    """Stable where K is positive definite there; the condition, where parameters decide."""
    if is_exact(found):
        said = _stability(model, found, stiffness, positive)
    else:
        said = _stability_in_numbers(model, found, stiffness)
    for need in dict.fromkeys(_positive(model, each, positive) for each in found.real_if):
        said = Phrase("where", {"said": said, "need": need})
    return said


def _stability(model: Model, found: Found, stiffness: ScalarMatrix, positive: set[str]) -> Phrase:
    """Of the coordinates that are not free; along a free one with zeros in K the state is neutral."""
    whole = ScalarMatrix.of([put_in(model, entry, found) for entry in row] for row in stiffness.rows)
    names = model.system.coordinates
    kept = [k for k, q in enumerate(names) if q not in found.free or any(whole.rows[k])]
    K = ScalarMatrix(tuple(whole.rows[k] for k in kept)).columns(*kept) if kept else whole
    if K != K.T:
        return OPEN
    minors = [K.block(slice(k), slice(k)).det() for k in range(1, len(K.rows) + 1)]
    signs = [_sign(minor, found, positive) for minor in minors]
    neutral = tuple(
        tuple(Symbol(q) for k, q in enumerate(names) if (k in kept) == held) for held in (True, False)
    )
    if (driven := _driven(model, found, positive)) is not None:
        return driven
    if all(sign == 1 for sign in signs):
        return _neutral(STABLE, neutral)
    if any(_sign(minor, found, positive) == -1 for minor in _principal_minors(K)):
        return OPEN if is_gyroscopic(model) else UNSTABLE
    if 0 in signs:
        return OPEN
    left = [minor for minor, sign in zip(minors, signs, strict=True) if sign is None]
    needs = dict.fromkeys(_positive(model, each, positive) for each in left)
    return _neutral(_conditional(tuple(needs), model), neutral)


def _neutral(said: Phrase, parts: tuple[tuple[Symbol, ...], ...]) -> Phrase:
    """Said of the coordinates in which it is decided, beside those along which nothing changes."""
    others, along = parts
    return Phrase("neutral", {"said": said, "others": others, "along": along}) if along else said


def _driven(model: Model, found: Found, positive: set[str]) -> Phrase | None:
    """Where forces along the rates feed energy in instead of taking it; None where they are not known to."""
    pairs = [(model.rest[k] - model.forces[q]) for k, q in enumerate(model.system.coordinates)]
    still = model.system.rates
    C = ScalarMatrix.of([without(each.diff(along), still) for along in still] for each in pairs)
    C = ScalarMatrix.of([put_in(model, entry, found) for entry in row] for row in C.rows)
    if not any(_sign(minor, found, positive) == -1 for minor in _principal_minors(C + C.T)):
        return None
    return UNSTABLE if len(still) == 1 else OPEN


def _stability_in_numbers(model: Model, found: Found, stiffness: ScalarMatrix) -> Phrase:
    """Of rounded coordinates, where rounding does not decide it."""
    import numpy

    if found.free or stiffness != stiffness.T:
        return OPEN
    try:
        point = {q: number(tree, {}) for q, tree in found.values.items()}
        K = numpy.array(matrix_numbers(stiffness, completed(point, model.problem.where)))
    except KeyError:  # symbols decide
        return OPEN
    eigenvalues = numpy.linalg.eigvalsh(K)
    clear = ROUNDED * numpy.abs(K).max()
    if eigenvalues.min() > clear:
        return STABLE
    return UNSTABLE if eigenvalues.min() < -clear and not is_gyroscopic(model) else OPEN


def _conditional(needs: tuple[Relation, ...], model: Model) -> Phrase:
    """Where parameters decide the signs of leading minors."""
    if is_gyroscopic(model):
        return Phrase("it-is-if", {"said": STABLE, "needs": needs})
    both: dict[str, Said] = {"said": STABLE, "other": UNSTABLE}
    if len(needs) > 1:
        return Phrase("either-or-negative", both | {"needs": needs})
    return Phrase("either-or", both | {"need": needs[0], "opposite": replace(needs[0], sign="<")})


def _principal_minors(K: ScalarMatrix) -> Iterator[Scalar]:
    """The determinants of the rows and columns of every choice; none is negative where K is positive
    semidefinite (Horn and Johnson, Matrix Analysis, section 7.2)."""
    n = len(K.rows)
    for size in range(1, n + 1):
        for kept in combinations(range(n), size):
            yield ScalarMatrix(tuple(K.rows[k] for k in kept)).columns(*kept).det()


def is_gyroscopic(model: Model) -> bool:
    """Whether forces linear in the rates do no work, as in a turning frame: they may hold a system on a
    hill (Kelvin, Tait and Chetaev)."""
    system = model.system
    G = ScalarMatrix.of(
        [without(left.diff(along), system.rates) for along in system.rates] for left in model.rest
    )
    return bool(G - G.T)


def _sign(value: Scalar, found: Found, positive: set[str]) -> int | None:
    """The sign; what makes the solution real is positive too."""
    known = known_sign(value, positive)
    if known is not None:
        return known
    part = odd_part(value, positive)
    for each in found.real_if:
        given = odd_part(each, positive)
        if part == given or part == -given:
            return 1 if part == given else -1
    return None


def _positive(model: Model, value: Scalar, positive: set[str]) -> Relation:
    """What is positive, with its negative terms on the other side."""
    terms = terms_of(model.problem.readable(odd_part(value, positive)))
    more, less = ([each for each in terms if is_negative(each) == low] for low in (False, True))
    return Relation(add(*more), ">", add(*map(negate, less)))
