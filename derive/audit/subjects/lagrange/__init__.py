"""Lagrange's equations: from energies made anew of the bodies, differentiated by SymPy."""

from __future__ import annotations

from derive.audit.subjects.lagrange.motion import equations_of_motion
from derive.audit.subjects.lagrange.rest import equilibria, linearisation

KINDS = {
    "equations-of-motion": equations_of_motion,
    "equilibria": equilibria,
    "linearisation": linearisation,
}
