"""Kinds of robots. Begin with `forward_kinematics` and `jacobian`; most others rest on these two.

`_chain` has the chain of an arm and what its frames, axes and origins are called, `_columns` how a Jacobian
is written, `_point` the point whose motion is asked for. The folders are rooms for one topic each: `_rows`
(link parameters and screws), `_velocity`, `_reach` (workspaces), `_singular`, `_inverse`, `_dynamics`.
"""
