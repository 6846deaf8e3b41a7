"""All twenty-four sequences of three angles against SciPy, in both directions, singular ones included."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.numbers.floats import number, numbers
from derive.build import build
from derive.derivation import Phrase
from derive.errors import NotDerivable, SheetErrors
from derive.expression import PI, ZERO, Degrees, Symbol, multiply
from derive.expression import number as exact
from derive.kinds.problem import Problem
from derive.mechanics import euler
from derive.mechanics.frames import ByMatrix, Frame, Frames
from derive.mechanics.motion import Motion, Move
from derive.mechanics.rotations import GivenRotation
from tests.kinds.published import matrix

SEQUENCES = ["".join(axes) for axes in product("xyz", repeat=3) if axes[0] != axes[1] != axes[2]]
CONVENTIONS = [*SEQUENCES, *(axes.upper() for axes in SEQUENCES)]
ANGLES = ("phi", "theta", "psi")
every_convention = pytest.mark.parametrize("convention", CONVENTIONS)


def motion(convention: str, by: tuple) -> Motion:
    """The three rotations of a convention."""
    about = "current" if convention.isupper() else "world"
    pairs = zip(convention.lower(), by, strict=True)
    return Motion(tuple(Move("rotate", axis, angle, about) for axis, angle in pairs))


def holds(derivation) -> bool:
    return all(claim.holds for claim in derivation.claims)


def degrees(*values: int) -> tuple[Degrees, ...]:
    return tuple(Degrees(Fraction(value)) for value in values)


def angles_of(branch, point=None) -> list[float]:
    return [number(branch.values[name], point or {}) for name in ANGLES]


def scipy_matrix(convention: str, angles) -> np.ndarray:
    return Rotation.from_euler(convention, angles).as_matrix()


def test_there_are_twelve_sequences() -> None:
    assert len(SEQUENCES) == 12


@every_convention
def test_the_matrix_of_the_angles_is_scipys(convention: str) -> None:
    """From angles to the rotation."""
    found = Problem("motion", motion(convention, (Symbol("a"), Symbol("b"), Symbol("c")))).ask(
        "rotation-matrix"
    )
    for angles in ((0.3, -1.1, 2.2), (-2.5, 0.4, 0.9)):
        ours = numbers(found.results["R"], dict(zip("abc", angles, strict=True)))
        assert np.allclose(ours, scipy_matrix(convention, angles))
    assert holds(found)


@every_convention
def test_both_branches_of_numbers(convention: str) -> None:
    """From a rotation to the angles: SciPy's is one of the two, and both give the rotation."""
    found = Problem("motion", motion(convention, degrees(30, 70, -110))).ask(
        "euler-angles", convention=convention
    )
    R = scipy_matrix(convention, np.radians([30, 70, -110]))
    theirs = Rotation.from_matrix(R).as_euler(convention)
    ours = [angles_of(branch) for branch in found.results["solutions"]]
    assert len(ours) == 2
    assert holds(found)
    assert any(np.allclose(np.exp(1j * np.array(each)), np.exp(1j * theirs)) for each in ours)
    for each in ours:
        assert np.allclose(scipy_matrix(convention, each), R)


@every_convention
def test_symbolic_orientation(convention: str) -> None:
    """The formulas at random points, and what is left in the singular cases."""
    subject = Motion((Move("rotate", "y", Symbol("q")), Move("rotate", "z", Symbol("w"))))
    found = Problem("motion", subject).ask("euler-angles", convention=convention)
    assert holds(found)
    for point in ({"q": 0.4, "w": -1.2}, {"q": 2.4, "w": 0.3}):
        R = (Rotation.from_euler("y", point["q"]) * Rotation.from_euler("z", point["w"])).as_matrix()
        for branch in found.results["solutions"]:
            if not isinstance(branch.when[0], Phrase):
                assert np.allclose(scipy_matrix(convention, angles_of(branch, point)), R)


@every_convention
@pytest.mark.parametrize("upper", [True, False])
def test_singular_orientations(convention: str, upper: bool) -> None:
    """One case, one free angle, and every choice of that gives the rotation."""
    proper = convention[0] == convention[2]
    middle = (0 if upper else 180) if proper else (90 if upper else -90)
    subject = motion(convention, degrees(20, middle, 65))
    found = Problem("motion", subject).ask("euler-angles", convention=convention)
    (branch,) = found.results["solutions"]
    assert holds(found)
    R = scipy_matrix(convention, np.radians([20, middle, 65]))
    for free in (0.0, 0.7, -2.0):
        choice = dict.fromkeys(ANGLES, free)
        assert np.allclose(scipy_matrix(convention, angles_of(branch, choice)), R)


@every_convention
def test_a_matrix_of_numbers(convention: str) -> None:
    """An exact rotation that is no product of known angles."""
    R = matrix("2/3, -1/3, 2/3\n2/3, 2/3, -1/3\n-1/3, 2/3, 2/3")
    found = Problem("frames", Frames((Frame(1, 0, ByMatrix(R)),))).ask("euler-angles", convention=convention)
    exact = np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3
    assert len(found.results["solutions"]) == 2
    assert holds(found)
    for branch in found.results["solutions"]:
        assert np.allclose(scipy_matrix(convention, angles_of(branch)), exact)


TURNS = [
    (("x", 0),), (("x", 180),), (("y", 180),), (("z", 180),), (("x", 180), ("y", 180)),
    (("x", 90), ("y", 180)), (("x", 90), ("z", 90)), (("y", 120),), (("z", -150), ("x", 45)), (("z", 1),),
]  # fmt: skip


@pytest.mark.parametrize("turns", TURNS)
def test_axis_angle_and_quaternion(turns) -> None:
    """0 and 180 degrees included."""
    subject = Motion(tuple(Move("rotate", axis, *degrees(by)) for axis, by in turns))
    R = np.eye(3)
    for axis, by in turns:
        R = R @ Rotation.from_euler(axis, by, degrees=True).as_matrix()
    problem = Problem("motion", subject)
    q = problem.ask("quaternion")
    assert holds(q)
    w, x, y, z = numbers(q.results["q"], {})
    assert np.allclose(Rotation.from_quat([x, y, z, w]).as_matrix(), R)
    turn = problem.ask("axis-angle")
    assert holds(turn)
    if turn.results["axis"] == "any":
        assert np.allclose(R, np.eye(3))
    else:
        vector = number(turn.results["angle"], {}) * np.array(numbers(turn.results["axis"], {}))
        assert np.allclose(Rotation.from_rotvec(vector).as_matrix(), R)


QUATERNIONS = [
    "1/2, 1/2, 1/2, 1/2",
    "0.1, 0.2, 0.3, 0.4",
    "0, 3/5, 0, 4/5",
    "1, 0, 0, 0",
    "-1, 1, 0, 0",
    "1, 0, 0, 1",
]


@pytest.mark.parametrize("typed", QUATERNIONS)
def test_a_quaternion_as_a_move(tmp_path, typed: str) -> None:
    """The way back: from a quaternion of any length to the rotation."""
    from derive.build import assemble
    from derive.sheet.load import load_sheet

    sheet = tmp_path / "q.yaml"
    sheet.write_text(f"title: q\nproblems:\n- motion: [{{quaternion: [{typed}]}}]\n  find: rotation-matrix\n")
    ((_, question),) = assemble(load_sheet(sheet)).questions()
    w, x, y, z = (float(Fraction(part)) for part in typed.split(","))
    assert np.allclose(
        numbers(question.derivation.results["R"], {}), Rotation.from_quat([x, y, z, w]).as_matrix()
    )


@pytest.mark.parametrize("order", ["yx", "xy"])
def test_the_notation_of_atan2_is_respected(tmp_path, order: str) -> None:
    from derive.build import build

    sheet = tmp_path / "n.yaml"
    sheet.write_text(
        f"title: n\nnotation: {{atan2: {order}}}\nproblems:\n"
        "- motion: [{rotate: y, by: q}, {rotate: z, by: w}]\n  find: euler-angles\n"
    )
    (page,) = build([sheet], ["md"], None)
    written = r"\mathrm{Atan2}(r_{11}, r_{21})" if order == "xy" else r"\mathrm{atan2}(r_{21}, r_{11})"
    assert written in page


@pytest.mark.parametrize(
    "asked", ["find: euler-angles, convention: ZYZ", "find: euler-rates, convention: zxy"]
)
def test_axes_exchanged_in_a_convention(asked: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet = tmp_path / "axes.yaml"
    sheet.write_text("title: Axes\nproblems:\n- {motion: [{rotate: x, by: alpha}], " + asked + "}\n")
    build([sheet], ["md"], None)
    monkeypatch.setattr(euler, "_axis", lambda letter: {"x": "x", "y": "z", "z": "y"}[letter])
    with pytest.raises(SheetErrors):
        build([sheet], ["md"], None)


# -- any rotation matrix -----------------------------------------------------------------------------

ENTRIES = tuple(f"r{i}{j}" for i, j in product((1, 2, 3), repeat=2))
ANY = Problem("rotation", GivenRotation(matrix("r11, r12, r13\nr21, r22, r23\nr31, r32, r33")))


def met(kind: str, R: np.ndarray, **options) -> list[dict]:
    """The solutions that are some where the entries have these values."""
    at = {name: exact(repr(float(value))) for name, value in zip(ENTRIES, R.ravel(), strict=True)}
    derivation = ANY.ask(kind, evaluate=at, **options)
    assert holds(derivation)
    return [each for each in derivation.evaluated["solutions"] if each.get("real", True)]


@every_convention
def test_any_matrix_has_these_angles(convention: str) -> None:
    R = Rotation.from_rotvec([0.3, -1.1, 0.7]).as_matrix()
    found = met("euler-angles", R, convention=convention)
    assert len(found) == 2
    for each in found:
        assert np.allclose(scipy_matrix(convention, [each[name] for name in ANGLES]), R)


@every_convention
@pytest.mark.parametrize("sign", [1, -1])
def test_a_singular_matrix_has_angles_too(convention: str, sign: int) -> None:
    proper = convention[0] == convention[2]
    middle = (0 if sign > 0 else np.pi) if proper else sign * np.pi / 2
    R = np.round(scipy_matrix(convention, [np.pi / 2, middle, np.pi]))
    (each,) = met("euler-angles", R, convention=convention)
    assert np.allclose(scipy_matrix(convention, [each[name] for name in ANGLES]), R)


@pytest.mark.parametrize("vector", [(0.3, -1.1, 0.7), (-2, 0.1, 0.1), (0, 0, 3)])
def test_any_matrix_turns_about_this_axis(vector) -> None:
    turn = Rotation.from_rotvec(vector)
    plus, minus = met("axis-angle", turn.as_matrix())
    assert np.allclose(plus["angle"] * np.array(plus["axis"]), turn.as_rotvec())
    assert np.allclose(minus["angle"] * np.array(minus["axis"]), turn.as_rotvec())
    assert minus["angle"] < 0


@pytest.mark.parametrize("axis", [(2, -3, 6), (0, 3, -4), (0, 0, 1)])
def test_half_a_turn_has_two_axes(axis) -> None:
    k = np.array(axis) / np.linalg.norm(axis)
    R = 2 * np.outer(k, k) - np.eye(3)
    found = met("axis-angle", np.where(abs(R) < 1e-15, 0, R))
    assert len(found) == 2
    assert all(each["angle"] == pytest.approx(np.pi) for each in found)
    assert np.allclose(found[0]["axis"], -np.array(found[1]["axis"]))
    assert abs(np.dot(found[0]["axis"], k)) == pytest.approx(1)


def test_nothing_turned_has_any_axis() -> None:
    (found,) = met("axis-angle", np.eye(3))
    assert found["angle"] == 0 and "axis" not in found


def test_numbers_of_no_rotation_are_refused() -> None:
    with pytest.raises(NotDerivable, match="no rotation"):
        met("axis-angle", np.diag([1.0, 1.0, -1.0]))
    with pytest.raises(NotDerivable, match="give all nine"):
        ANY.ask("euler-angles", evaluate={"r11": exact("1")})


def test_what_is_known_of_the_entries_is_put_in() -> None:
    psi = matrix("0, sin(psi), cos(psi)\n0, cos(psi), -sin(psi)\n-1, 0, 0")
    found = Problem("rotation", GivenRotation(psi)).ask(
        "euler-angles", convention="XYX", angles=("phi", "theta", "psi_e")
    )
    first = found.results["solutions"][0]
    angles = [first.values[name] for name in ("phi", "theta", "psi_e")]
    assert angles == [ZERO, multiply(exact("1/2"), PI), Symbol("psi")]
