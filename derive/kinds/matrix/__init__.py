"""Kinds for a matrix that is given as such, a Jacobian or an inertia matrix.

Those that arms have too, `rank` and `redundancy`, are in `spaces`.
"""
