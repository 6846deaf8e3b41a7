"""The second route: the same answers in plain NumPy from the trees of the sheet, on ground of its own.

Sixteen typed entries for a row of Denavit and Hartenberg (`rows`), Rodrigues' formula (`poses`), moments of
inertia by quadrature over the solid (`bodies`), torques by the motion of each body (`sweep`) or from nothing
but where things are (`displacements`). It reads the records of a sheet and the values of trees, and none of
the formulas that it checks: a contract in pyproject.toml holds it to that. Begin at `arm`.

Arrays: T 4 by 4, vectors of 3, q of n.
"""

from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.oracle.calculus import STEP, exponential, slope, vee
from derive.mechanics.oracle.poses import compose, elementary, in_sequence, made

__all__ = ["STEP", "Oracle", "compose", "elementary", "exponential", "in_sequence", "made", "slope", "vee"]
