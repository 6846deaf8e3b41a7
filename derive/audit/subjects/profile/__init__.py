"""Profiles of motion: put back at their ends, where they are joined, and as the area that they cover."""

from __future__ import annotations

from derive.audit.subjects.profile.pieces import lspb_trajectory, spline_trajectory
from derive.audit.subjects.profile.polynomial import cubic_trajectory, quintic_trajectory
from derive.audit.subjects.profile.times import minimum_time, time_scaling
from derive.audit.subjects.profile.trapezoid import trapezoidal_profile

KINDS = {
    "cubic-trajectory": cubic_trajectory,
    "quintic-trajectory": quintic_trajectory,
    "lspb-trajectory": lspb_trajectory,
    "spline-trajectory": spline_trajectory,
    "trapezoidal-profile": trapezoidal_profile,
    "minimum-time": minimum_time,
    "time-scaling": time_scaling,
}
