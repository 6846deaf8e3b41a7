"""Mistakes in what moves, stands, is fitted or optimised: a plain build refuses each.

One place of a function is typed wrongly, as someone might, and the function runs so wherever it is called.
"""

from __future__ import annotations

import inspect
import textwrap
from pathlib import Path
from types import FunctionType
from typing import Any, NamedTuple

import pytest

from derive.algebra import calculus
from derive.algebra.readable import angle_sums
from derive.build import derive_all
from derive.errors import SheetErrors
from derive.kinds.frames import _frames, change_of_frame, loop
from derive.kinds.frames import transform as frame_transform
from derive.kinds.function import _extremes, _newton, _stationary, _worked, _writing
from derive.kinds.lagrange import (
    _energies,
    _equations,
    _solved,
    _stiffness,
    equations_of_motion,
    linearisation,
)
from derive.kinds.motion import _factors, _product, equivalent_sequences, rotation_vector, velocity
from derive.kinds.points import _rows, _svd
from derive.kinds.pose import _euler_steps, _given, _numbers, axis_angle, euler_rates, quaternion
from derive.kinds.profile import _axis, _blends, _drawn, _ends, _spline_laws, _trapezoid
from derive.mechanics import euler, fitting, frame_tree, lagrangian, sequences
from derive.render.questions import example_of
from derive.sheet.load import load_sheet

ROLLING = """
title: A rolling disc
problems:
- lagrange:
    coordinates: [x, phi, theta]
    kinetic: m*x_dot^2/2 + J*phi_dot^2/2 + I*theta_dot^2/2
    constraints: [x_dot*cos(theta) = r*phi_dot]
  find: equations-of-motion
"""
CART = """
title: A cart with a pole
problems:
- lagrange:
    coordinates: [x, theta]
    bodies:
    - {mass: m_c, position: [x, 0]}
    - {mass: m_p, position: [x + l*sin(theta), -l*cos(theta)]}
    forces: {x: F}
  find: equations-of-motion
  solve: true
"""
MIRRORED = """
title: Points in a mirror
problems:
- points:
    from: [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]]
    to: [[0, 0, 0], [-1, 0, 0], [0, 2.1, 0], [0, 0, 3]]
  find: fit-transform
"""
BY_ROWS = MIRRORED + "  method: rows\n"
TREE = """
title: Four frames
problems:
- frames:
  - {x: y0, y: -x0, z: z0, origin: [a, 0, 0]}
  - {x: 0.6*x1 + 0.8*y1, y: -0.8*x1 + 0.6*y1, z: z1, origin: [0, b, 0]}
  - {in: 1, motion: [{translate: x, by: c}, {rotate: z, by: phi}]}
  questions:
  - {find: transforms}
  - {find: transform, from: 3, to: 2}
  - {find: change-of-frame, point: [1, 2, 3], from: 3, to: 2}
"""
ABOUT_BOTH = """
title: Moves
problems:
- motion: [{rotate: z, by: phi}, {rotate: x, by: theta, about: world}, {rotate: y, by: psi}]
  questions:
  - {find: rotation-matrix}
  - {find: velocity}
  - {find: quaternion}
"""
ABOUT_Y = """
title: About one axis
problems:
- motion: [{rotate: y, by: phi}]
  questions: [{find: axis-angle}, {find: quaternion}]
"""
SINGULAR = """
title: t
problems:
- motion: [{rotate: z, by: 30 deg}, {rotate: y, by: 90 deg}]
  find: euler-angles
"""
RENAMED = (
    "title: t\nproblems:\n- motion: [{rotate: z, by: a}, {rotate: y, by: b}, {rotate: x, by: c}]\n"
    "  find: euler-angles\n"
)
QUATERNION = "title: t\nproblems:\n- motion: [{quaternion: [1/2, 1/2, 1/2, 1/2]}]\n  find: rotation-matrix\n"
HALF_TURN = (
    "title: t\nproblems:\n- motion: [{rotate: x, by: 180 deg}, {rotate: z, by: 60 deg}]\n  find: axis-angle\n"
)
TOO_FAST = """
title: Beyond a limit
problems:
- profile: {from: 0, to: 60 deg, time: 2 s, v_max: 40 deg/s}
  find: cubic-trajectory
"""
TIMED = """
title: In a given time
problems:
- profile: {distance: 3 m, v_max: 1 m/s, a_max: 2 m/s^2, time: 5 s}
  find: trapezoidal-profile
- profile: {distance: 3 m, v_max: 2 m/s, a_max: 2 m/s^2, time: 5 s}
  find: trapezoidal-profile
"""
BOUNDED = """
title: On a circle
problems:
- function: {variables: [x, y], value: x*y, subject_to: x^2 + y^2 = 1}
  find: lagrange-multipliers
"""
SYMBOLS = """
title: Angles of two turns
problems:
- motion: [{rotate: x, by: phi}, {rotate: y, by: theta}]
  find: euler-angles
  convention: ZYZ
"""


ACCIDENTS = (KeyError, ValueError, TypeError, AttributeError, IndexError)  # stop a build too


class Mistake(NamedTuple):
    """What a function says, what is typed in its place, and a sheet, or the kind whose example shows it."""

    of: Any
    right: str
    wrong: str
    sheet: str


MISTAKES = {
    # accelerations and constraints
    "sin for sin^2": Mistake(angle_sums._square_of_sine, "[0], 2)", "[0], 1)", CART),
    "d cos = + sin": Mistake(calculus._along_symbols_and_angles, "* c - poly", "* c + poly", ROLLING),
    "a constraint differentiated once": Mistake(
        lagrangian.on_accelerations, "rate(once, system)", "once", ROLLING
    ),
    "a multiplier that pushes back": Mistake(
        _solved.solved, "*(-condition.a[k]", "*(condition.a[k]", ROLLING
    ),
    "a minus lost before a fraction": Mistake(_equations.written_fraction, "MINUS_ONE * (Sum", "(Sum", CART),
    "energies added": Mistake(
        _energies.energy_steps, "(letters.kinetic) - Symbol", "(letters.kinetic) + Symbol", CART
    ),
    "a term of Lagrange's equation turned": Mistake(
        equations_of_motion._general, 'negate(Derivative(L, Symbol("q")))', 'Derivative(L, Symbol("q"))', CART
    ),
    "stiffness turned": Mistake(
        linearisation._linear,
        "derivatives(system.coordinates),",
        "derivatives(system.coordinates, -1),",
        "lagrange.linearisation",
    ),
    "inputs turned": Mistake(
        linearisation._linear, "derivatives(inputs, -1)", "derivatives(inputs)", "lagrange.linearisation"
    ),
    "the equation of a small motion": Mistake(
        linearisation._small_motion, 'add(Symbol("M_0")', '-add(Symbol("M_0")', "lagrange.linearisation"
    ),
    "unstable called stable": Mistake(
        _stiffness._stability, "_neutral(STABLE", "_neutral(UNSTABLE", "lagrange.equilibria"
    ),
    "a condition turned": Mistake(_stiffness._positive, '">"', '"<"', "lagrange.equilibria"),
    # moves
    "omega_z turned": Mistake(velocity.derive, "turn[1, 0]))", "-turn[1, 0]))", ABOUT_BOTH),
    "omega_x and omega_y exchanged": Mistake(
        velocity.derive, "(turn[2, 1], turn[0, 2],", "(turn[0, 2], turn[2, 1],", ABOUT_BOTH
    ),
    "pre- and postmultiplied": Mistake(
        sequences.placings,
        'move.about == "world" else "right"',
        'move.about != "world" else "right"',
        ABOUT_BOTH,
    ),
    "a side told wrong": Mistake(_factors.Factors._placed, "placing.side]", '"left"]', ABOUT_BOTH),
    "world and current in a sequence": Mistake(
        equivalent_sequences._told,
        "move.kind, move.about",
        'move.kind, "world"',
        "motion.equivalent_sequences",
    ),
    "Rodrigues' last term": Mistake(
        _factors.rodrigues,
        "ONE - cos(angle)",
        "ONE + cos(angle)",
        HALF_TURN.replace("rotate: z", "rotate: [1, 1, 0]"),
    ),
    "a rotation vector along the other axis": Mistake(
        rotation_vector._entry,
        "normal(multiply(angle, entry))",
        "-normal(multiply(angle, entry))",
        "motion.rotation_vector",
    ),
    # rotations
    "trace 1 + cos(theta)": Mistake(axis_angle._facts, "1 + 2 * cos", "1 + cos", "pose.axis_angle"),
    "the turn along another axis": Mistake(
        _numbers.along, "ratio * sign", "abs(ratio) * sign", "pose.axis_angle"
    ),
    "w = 2 cos(theta) k": Mistake(
        axis_angle._facts, "axis * sin(names.angle)", "axis * cos(names.angle)", "pose.axis_angle"
    ),
    "r_00 in the trace": Mistake(_given.diagonal, "(1, 2, 3)", "(0, 1, 2)", "pose.axis_angle"),
    "R = 2 k k^T + 1": Mistake(axis_angle._half_facts, "- Symbol", "+ Symbol", HALF_TURN),
    "entries of w exchanged": Mistake(
        _given.lacking, '("r_32", "r_23")', '("r_23", "r_32")', "pose.quaternion"
    ),
    "four times the scalar part": Mistake(
        quaternion._steps, "each / (4 * scalar)", "each / (2 * scalar)", "pose.quaternion"
    ),
    "another angle of a singular rotation": Mistake(
        _euler_steps.Comparison.chosen, "found = (value,", "found = (-value,", SINGULAR
    ),
    "angles that turn the other way": Mistake(
        _euler_steps.Comparison.same, "return same", "return tuple((n, -v) for n, v in same)", RENAMED
    ),
    "half the angle of a quaternion": Mistake(_factors._turned, "2 * atan2", "atan2", QUATERNION),
    "both branches on the same side": Mistake(
        euler.Euler.regular, "self.g if sign > 0 else -self.g", "self.g", "pose.euler_angles"
    ),
    "a condition for the other branch": Mistake(
        _euler_steps.Comparison._regular, '">" if sign > 0', '">" if sign < 0', "pose.euler_angles"
    ),
    "the body's axes told for the world's": Mistake(
        euler_rates._axis, "factors[:place]), unit", "factors[place:]), unit", "pose.euler_rates"
    ),
    "a sum that is not determined": Mistake(
        _euler_steps.Comparison.determined,
        "return last + -first",
        "return first + -last",
        SYMBOLS,
    ),
    "r_23 - r_32 where both are zero": Mistake(
        _given.lacking, '("r_32", "r_23")', '("r_23", "r_32")', ABOUT_Y
    ),
    "factors under the names of others": Mistake(
        _product._factor_results, "{factor.index}", "{len(factors.factors) + 1 - factor.index}", ABOUT_BOTH
    ),
    # frames
    "T_1^3 for T_3^1": Mistake(_frames.pose_name, "T_{number}^{reference}", "T_{reference}^{number}", TREE),
    "0.6 - 0.8 without axes": Mistake(
        _frames.combination, "multiply(*factors_of(part), unit)", "multiply(*factors_of(part))", TREE
    ),
    "in frame 2 what is in frame 1": Mistake(
        change_of_frame._board, "{letter}^{options.target}", "{letter}^{options.target - 1}", TREE
    ),
    "a way that is not turned round": Mistake(
        frame_tree.relative, "inverse_pose(along(path.down, names)) @ T", "along(path.down, names) @ T", TREE
    ),
    "a point taken for a free vector": Mistake(
        change_of_frame._board, "(named, written) if options", "(named, written) if not options", TREE
    ),
    "a point said to be a free vector": Mistake(
        change_of_frame.derive, "options.vector is not None", "options.vector is None", TREE
    ),
    "T_2^3, of which R_3^2 is not a part": Mistake(
        change_of_frame.derive, "pose_name(source, options.target)", "pose_name(options.target, source)", TREE
    ),
    "a loop that does not close told closed": Mistake(
        loop._Loop.facts, "any(j < 3 for _, j in wrong)", "not any(j < 3 for _, j in wrong)", "frames.loop"
    ),
    "yes for no": Mistake(
        loop.derive, '"yes" if loop.closes else "no"', '"no" if loop.closes else "yes"', "frames.loop"
    ),
    "from and to exchanged": Mistake(
        frame_transform.derive, "pose_name(source, options.target)", "pose_name(options.target, source)", TREE
    ),
    "a stable state said to be undecided": Mistake(
        _stiffness._stability, "_neutral(STABLE, neutral)", "_neutral(OPEN, neutral)", "lagrange.equilibria"
    ),
    # points
    "a reflection for a rotation": Mistake(fitting.by_singular_values, "*= det", "*= 1", MIRRORED),
    "D of five rows": Mistake(_svd._diagonal, "(len(fit.S) - 1)", "(len(fit.S) + 1)", MIRRORED),
    "a centroid over one point more": Mistake(
        _svd._means, "whole(len(points))", "whole(len(points) + 1)", MIRRORED
    ),
    "p = b + R a": Mistake(_svd._ends, "B_MEAN - R", "B_MEAN + R", MIRRORED),
    "singular values turned": Mistake(
        _svd._spectral, "_diagonal_rows(fit.S)", "_diagonal_rows([-s for s in fit.S])", MIRRORED
    ),
    "a row of T": Mistake(_rows._transform, "[0] * size + [1]", "[1] * size + [1]", BY_ROWS),
    "a rotation that is none": Mistake(_rows.Scaled.verdict, "self.det == number(1)", "True", BY_ROWS),
    # profiles
    "the area of the plateau": Mistake(
        _axis._what, "given.fastest * T_2", "given.fastest * T_1", "profile.trapezoidal_profile"
    ),
    "a triangle told a trapezoid": Mistake(
        _axis._what, "is None, outcome.plateau", "is None, not outcome.plateau", TIMED
    ),
    "the peak of a triangle": Mistake(_trapezoid.timed, "peak = 2 * d / t_3", "peak = d / t_3", TIMED),
    "a blend too long": Mistake(
        _blends._solved, "T + _minus(way / given)", "T - _minus(way / given)", "profile.lspb_trajectory"
    ),
    "a piece from the wrong place": Mistake(
        _blends.Blended.laws, "self.end + _minus", "self.start + _minus", "profile.lspb_trajectory"
    ),
    "a coefficient of a cubic": Mistake(_ends.upper, "(3, way)", "(2, way)", "profile.cubic_trajectory"),
    "a limit told kept": Mistake(_drawn._limit, "kept=reached <= most", "kept=reached > -most", TOO_FAST),
    "too late beyond it": Mistake(_drawn._crossing, "return high", "return high + 0.2", TOO_FAST),
    "v_{k+1} for v_{k-1}": Mistake(
        _spline_laws._condition, "here * v_0", "here * v_2", "profile.spline_trajectory"
    ),
    # extreme values
    "a minimum called a maximum": Mistake(
        _stationary.patterns, "[(-1) ** m] * count", "[-(-1) ** m] * count", "function.stationary_points"
    ),
    "every point singular": Mistake(_worked._said, 'point.kind == "singular"', "True", BOUNDED),
    "isolated for a local extreme": Mistake(
        _worked._said, "LOCAL.get(point.kind)", 'LOCAL.get("isolated")', "function.stationary_points"
    ),
    "nothing found by Newton's method": Mistake(
        _newton.stationary, "return _distinct", "return [] and _distinct", "function.stationary_points"
    ),
    "the greatest of another point": Mistake(
        _extremes.extremes, 'said[k] = "both" if said[k] else word', "said[k - 1] = word", BOUNDED
    ),
    "names of angles exchanged": Mistake(
        euler_rates._of_motion,
        "names[0], names[1], names[2]",
        "names[1], names[0], names[2]",
        "pose.euler_rates",
    ),
    "a case told wrong": Mistake(
        _writing.vanishing,
        "problem.readable(-right)",
        "problem.readable(right)",
        "function.lagrange_multipliers",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mistake, sheet = MISTAKES[name], tmp_path / "sheet.yaml"
    text = mistake.sheet if "\n" in mistake.sheet else example_of(f"derive.kinds.{mistake.sheet}")
    sheet.write_text(text, encoding="utf-8")
    derive_all([load_sheet(sheet)], True, lambda _: None)
    plant(monkeypatch, function_of(mistake.of), mistake.right, mistake.wrong)
    with pytest.raises((SheetErrors, *ACCIDENTS)):
        derive_all([load_sheet(sheet)], True, lambda _: None)


def function_of(member: Any) -> FunctionType:
    """The function of a method or a property."""
    found = getattr(member, "fget", None) or getattr(member, "func", None) or member
    return getattr(found, "__wrapped__", found)


def plant(monkeypatch: pytest.MonkeyPatch, function: FunctionType, right: str, wrong: str) -> None:
    """The function with one place of it typed in another way, for all who call it."""
    source = textwrap.dedent(inspect.getsource(function))
    assert right in source, f"{function.__qualname__} does not say {right!r} any more"
    lines = source.replace(right, wrong, 1).splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("def "))
    scope = dict(function.__globals__)
    exec("\n".join(("from __future__ import annotations", *lines[first:])), scope)
    monkeypatch.setattr(function, "__code__", scope[function.__name__].__code__)
