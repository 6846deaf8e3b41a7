"""Systems by their energies: equations of motion, equilibria, linearisation.

Begin with `equations_of_motion`; `_model` is the system in normal form, `_oracle` the second route by
differences.
"""
