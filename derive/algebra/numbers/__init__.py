"""Trees and normal forms as numbers. Begin with `floats`: `number` of a tree, `scalar_number` of a normal
form.

`balls` has intervals that certainly hold the value, and signs with as many bits as they take; `compiled`
makes a tree a function that is called often; `many_points` evaluates many polynomials at many points.
"""
