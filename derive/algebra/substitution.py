"""A name given a value: an angle by its cosine and sine, any other symbol by a scalar."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import fmpq_mpoly

from derive.algebra.exact_values import Pair, added, form_trig, multiple
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.multivariate import grouped
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar, common_ring
from derive.errors import NotDerivable


def pinned(value: Scalar, name: str, at: Pair | Scalar) -> Scalar:
    """The scalar where the angle `name` has this cosine and sine, or the symbol this value.

    Raises NotDerivable where the name stands inside a root or a fraction of the angle.
    """
    if isinstance(at, Scalar):
        return value.substitute({name: at})
    images = _images(value.ring, name, at)
    if images is None:
        return value
    top = _composed(value.numerator, value.ring, images)
    return top if value.denominator is None else top / _composed(value.denominator, value.ring, images)


def pinned_matrix(matrix: ScalarMatrix, name: str, at: Pair | Scalar) -> ScalarMatrix:
    """The matrix with every entry so. Raises what `pinned` raises."""
    return ScalarMatrix.of([pinned(entry, name, at) for entry in row] for row in matrix.rows)


def _images(home: Ring, name: str, at: Pair) -> Mapping[int, Scalar] | None:
    """What each sine and cosine that holds the angle becomes; None where none does."""
    images = {}
    for k, form in enumerate(home.angles):
        times = form.of_atom(name)
        if not times:
            continue
        if times.denominator != 1:
            raise NotDerivable(f"a fraction of the angle {name}")
        c, s = home.pair_index(k)
        images[c], images[s] = added(form_trig(form.without(name)), multiple(at, int(times)))
    _refuse_roots(home, images)
    return images or None


def _refuse_roots(home: Ring, images: Mapping[int, Scalar]) -> None:
    names = {home.names[place] for place in images}
    for root in home.roots:
        if any(name in names for powers, _ in root.radicand for name, _ in powers):
            raise NotDerivable("a joint variable inside a root")


def _composed(polynomial: fmpq_mpoly, source: Ring, images: Mapping[int, Scalar]) -> Scalar:
    """The angles that are replaced are left behind: sums of the others would else be written as differences
    of those."""
    replaced = {source.names[place] for place in images}
    kept = tuple(form for form in source.angles if f"cos({form})" not in replaced)
    home = ring(source.roots, kept, source.symbols)
    parts = [
        _product(Scalar(home, rest.project_to_context(home.context)), tuple(images.values()), powers)
        for powers, rest in grouped(polynomial, images).items()
    ]
    home = common_ring(parts)
    return sum((part.into(home) for part in parts), Scalar(home, home.zero))


def _product(rest: Scalar, values: Sequence[Scalar], powers: Sequence[int]) -> Scalar:
    for value, power in zip(values, powers, strict=True):
        if power:
            rest = rest * value**power
    return rest


def rationalised(value: Scalar) -> Scalar:
    """The same without square roots below the fraction, as far as their conjugates remove them:
    (r a + r^2)/r is a + r."""
    for root in (root for root in value.ring.roots if root.degree == 2):
        bottom = value.denominator
        if bottom is None:
            break
        along = bottom.derivative(value.ring.index[root.name])
        if along != 0:
            other = Scalar(value.ring, bottom - 2 * along * value.ring.gen(root.name))
            whole = Scalar(value.ring, bottom) * other
            value = Scalar(value.ring, value.numerator) * other / whole
    return value
