"""From a normal form to what a person would write. The normal form decides; here only a short way of saying
it is searched. Nothing is proved here: what is printed is brought back to the normal form and compared.

The pipeline, led by `form` (begin there): bases of the angles (theta1, theta1 + theta2 or single angles) ->
`terms` (a polynomial over letters) -> `angle_sums` (c_1 c_2 - s_1 s_2 = c_12) -> `repeated_sums` (x and y
only as x + y) -> `by_rate` (what moves, rate by rate) -> `by_mass` and `nesting` (common factors out, by
price; `factoring`) -> `writing` (the tree).
`order` is the one rule of what stands before what, in products, sums, matrices and results alike.
`matrix_factor` writes what all entries share once; `operation_count` says how long a formula is.
"""
