"""Whether a number made of fixed angles and roots is zero: 4 cos(36 deg) = 1 + sqrt(5).

Each fixed angle is a pair of generators of its own, so a polynomial in them may stand for zero and not look
it. Begin with `zero_recognition`, which asks in this order: `constants` (ball arithmetic, which refutes),
`addition_theorems` (angles that are sums of others), `exponential_sums` (roots of unity, which decide).
"""
