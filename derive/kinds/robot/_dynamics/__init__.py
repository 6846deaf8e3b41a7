"""The dynamics of arms. Begin with `arm`: D, the rates by name, and the second route that every kind asks.

`bodies` makes each link ready for its energies, `body_steps` writes the way from its pose to its inertia, and
`drives` knows motors and friction. `terms` writes the equation of each joint in the names of its terms,
`khatib_dynamics` the same as M qddot + v + G. `recursion` has the lines of Newton and Euler, `regressor` the
parameters in which torques are linear, `linearisation` the equations about rest.
"""
