"""Motions along a coordinate: velocity profiles and trajectories.

Begin with `cubic_trajectory`; `_polynomial`, `_blends`, `_trapezoid` and `_axis` work them out, `_drawn`
evaluates and draws them.
"""
