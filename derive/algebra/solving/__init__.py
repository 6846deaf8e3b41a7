"""What a person solves by hand, exactly: factors, roots, ranks, systems of equations. All of it is bounded,
by counts of terms and of work and never by time.

Begin with `polynomial_systems`: case by case, by the `elimination_rules`, then a `groebner` basis, then
`real_roots`; `polynomials` reads scalars as polynomials in some of their letters. Sines and cosines:
`half_angles`, where factors are unique, then `factors` and `resultants`. Linear algebra: `row_reduction`
(rank, null space), `linear_dependence`, `unit_vectors`. `fixed_directions` names the angle of a fixed
direction.
"""
