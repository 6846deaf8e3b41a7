"""The arms of the grid: tables of Denavit and Hartenberg, and what is given of the end-effector."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

PLANE, POINT = ("x", "y"), ("x", "y", "z")
TURNED, LIFTED = (*PLANE, "phi"), (*POINT, "phi")
POSE, ORIENTATION = "pose", "orientation"
COLUMNS = ("theta", "d", "a", "alpha")


@dataclass(frozen=True, slots=True)
class Arm:
    """`table` has a row of theta, d, a and alpha for each joint, angles in degrees if they are numbers, the
    joint variable as a star. `rows` are the velocities that its joints command, where not all; `free` are the
    joints that are chosen beforehand where it is inverted."""

    name: str
    table: str
    given: tuple[str, ...] | str = POSE
    rows: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    convention: str = "standard"
    gravity: tuple[str, ...] = ("0", "0", "-g")
    tool: tuple[dict[str, Any], ...] = field(default=())

    def links(self) -> Iterator[dict[str, str]]:
        """The rows as a sheet has them."""
        for i, row in enumerate(self.table.split(";"), 1):
            cells = dict(zip(COLUMNS, row.split(), strict=True))
            for key, text in cells.items():
                star = f"{'d' if key == 'd' else 'theta'}{i}*"
                cells[key] = (
                    _angle(text.replace("*", star)) if key in ("theta", "alpha") else text.replace("*", star)
                )
            yield cells


def _angle(text: str) -> str:
    """With the unit of its number, which stands alone or after the joint variable."""
    at = max(text.rfind("+"), text.rfind("-"))
    return f"{text} deg" if text[at + 1 :].replace(".", "").isdigit() and text != "0" else text


def _planar(n: int) -> Arm:
    table = ";".join(f"* 0 a{i} 0" for i in range(1, n + 1))
    free = tuple(f"theta{i}" for i in range(1, n - 2))
    given, rows = (PLANE, ("vx", "vy")) if n == 2 else (TURNED, ("vx", "vy", "wz"))
    return Arm(f"planar{n}R", table, given, rows, free, gravity=("0", "-g", "0"))


V, W = ("vx", "vy", "vz"), ("wx", "wy", "wz")
PUMA = "* 0 0 90; * 0 a2 0; * d3 a3 -90; * d4 0 90; * 0 0 -90; * d6 0 0"
WRIST = "* d4 0 90; * 0 0 -90; * d6 0 0"
IRB = "* d1 a1 -90; * 0 a2 0; *-theta2 0 a3 -90; "

ARMS = (
    *map(_planar, (2, 3, 4, 5, 6, 7, 10)),
    Arm("RP", "*+90 0 0 90; 0 * 0 0", PLANE, ("vx", "vy")),
    Arm("PR", "0 * 0 90; * 0 a2 0", ("x", "z"), ("vx", "vz")),
    Arm("RPR", "*+90 0 0 90; 0 * 0 -90; * 0 a3 0", TURNED, ("vx", "vy", "wz")),
    Arm("RRP", "* d1 0 -90; * d2 0 90; 0 * 0 0", POINT, V),
    Arm("PPP", "0 * 0 -90; 90 * 0 -90; 0 * 0 0", POINT, V),
    Arm("PRP_general", "0 * a1 alpha1; * d2 a2 alpha2; 0 * a3 0", POINT, V),
    Arm("cylindrical", "* d1 0 0; 0 * 0 -90; 0 * 0 0", POINT, V),
    Arm("anthropomorphic", "* d1 0 90; * 0 a2 0; * 0 a3 0", POINT, V),
    Arm("anthro_offset", "* d1 a1 90; * d2 a2 0; * 0 a3 0", POINT, V),
    Arm("ortho3R", "* d1 a1 -90; * d2 a2 90; * 0 a3 0", POINT, V),
    Arm("ortho3R_num", "* 0 1 -90; * 1 2 90; * 0 1.5 0", POINT, V),
    Arm("general3R", "* d1 a1 alpha1; * d2 a2 alpha2; * d3 a3 0", POINT, V),
    Arm("wrist_zyz", "* 0 0 -90; * 0 0 90; * d3 0 0", ORIENTATION, W),
    Arm("wrist_twist60", "* 0 0 60; * 0 0 -60; * d3 0 0", ORIENTATION, W),
    Arm("twoR_twist", "* d1 a1 60; * 0 a2 0", POINT, ("vx", "vy")),
    Arm("3R_twist30", "* d1 a1 30; * 0 a2 0; * 0 a3 0", POINT, V),
    Arm("3R_twist45", "* d1 a1 45; * d2 a2 45; * 0 a3 0", POINT, V),
    Arm("SCARA", "* d1 a1 0; * 0 a2 180; 0 * 0 0; * d4 0 0", LIFTED, (*V, "wz")),
    Arm("SCARA_offset", "*+30 d1 a1 0; * d2 a2 180; 0 * a3 0; *+45 d4 a4 0", LIFTED, (*V, "wz")),
    Arm("PRRR_gantry_scara", "0 * 0 0; * 0 a2 0; * 0 a3 0; * d4 0 180", LIFTED, (*V, "wz")),
    Arm("palletiser4R", "* d1 0 90; * 0 a2 0; * 0 a3 0; * 0 a4 0"),
    Arm("palletiser_parallelogram", "* d1 0 90; * 0 a2 0; *-theta2 0 a3 0; *-theta3 0 a4 0"),
    Arm("RRR_parallelogram", "* d1 0 90; * 0 a2 0; *-theta2 0 a3 0", POINT, V),
    Arm("katana5", "* d1 0 90; * 0 a2 0; * 0 a3 0; *+90 0 0 90; * d5 0 0"),
    Arm("youbot5", "* 0.147 0.033 90; * 0 0.155 0; * 0 0.135 0; *+90 0 0 90; * 0.2175 0 0"),
    Arm("scorbot5", "* d1 a1 -90; * 0 a2 0; * 0 a3 0; *-90 0 0 -90; * d5 0 0"),
    Arm("stanford", "* 0 0 -90; * d2 0 90; 0 * 0 0; * 0 0 -90; * 0 0 90; * d6 0 0"),
    Arm("puma560", PUMA),
    Arm("puma560_num", "* 0 0 90; * 0 0.4318 0; * 0.15005 0.0203 -90; * 0.4318 0 90; * 0 0 -90; * 0 0 0"),
    Arm(
        "puma_modified",
        "* 0 0 0; * 0 0 -90; * d3 a2 0; * d4 a3 -90; * 0 0 90; * 0 0 -90",
        convention="modified",
    ),
    Arm("kuka_kr", f"* d1 a1 -90; * 0 a2 0; *-90 0 a3 -90; {WRIST}"),
    Arm(
        "kuka_kr6_num", "* 0.4 0.025 -90; * 0 0.455 0; *-90 0 0.035 -90; * 0.42 0 90; * 0 0 -90; * 0.08 0 180"
    ),
    Arm("abb_irb_parallelogram", IRB + WRIST),
    Arm("ur5", "* d1 0 90; * 0 a2 0; * 0 a3 0; * d4 0 90; * d5 0 -90; * d6 0 0"),
    Arm(
        "ur10e_num",
        "* 0.1807 0 90; * 0 -0.6127 0; * 0 -0.57155 0; * 0.17415 0 90; * 0.11985 0 -90; * 0.11655 0 0",
    ),
    Arm(
        "jaco6_num",
        "* 0.2755 0 90; *-90 0 0.41 180; *+90 -0.0098 0 90; * -0.2502 0 60; *-180 -0.0858 0 60; "
        "*+90 -0.2028 0 180",
    ),
    Arm("jaco6", "* d1 0 90; *-90 0 a2 180; *+90 d3 0 90; * d4 0 60; *-180 d5 0 60; *+90 d6 0 180"),
    Arm("crx_offset_wrist", "* 0 0 -90; * 0 a2 180; * 0 0 -90; * d4 0 90; * d5 0 -90; * d6 0 180"),
    Arm("general6R", ";".join(f"* d{i} a{i} alpha{i}" for i in range(1, 7))),
    Arm(
        "general6R_num",
        "* 0.1 0.3 80; * 0.05 1 15; * 0.2 0.12 70; * 0.3 1.5 -35; * 0.07 0.04 85; * 0.15 0.02 20",
    ),
    Arm("PPPRRR", f"0 * 0 -90; 90 * 0 -90; 0 * 0 0; {WRIST.replace('d4', '0')}"),
    Arm("RPPRRR", f"* d1 0 0; 0 * 0 -90; 0 * 0 0; {WRIST.replace('d4', '0')}"),
    Arm("pieper_spatial", f"* d1 a1 -90; * d2 a2 90; * 0 a3 -90; {WRIST}"),
    Arm("spherical_shoulder", "* 0 0 90; * 0 0 -90; * d3 0 90; * 0 a4 0; * 0 a5 90; * d6 0 0"),
    Arm(
        "panda",
        "* 0.333 0 0; * 0 0 -90; * 0.316 0 90; * 0 0.0825 90; * 0.384 -0.0825 -90; * 0 0 90; * 0 0.088 90",
        free=("theta7",),
        convention="modified",
        tool=({"translate": "z", "by": "0.107"},),
    ),
    Arm(
        "iiwa",
        "* 0.36 0 -90; * 0 0 90; * 0.42 0 90; * 0 0 -90; * 0.4 0 -90; * 0 0 90; * 0.126 0 0",
        free=("psi",),
    ),
    Arm(
        "gen3",
        "* -0.2848 0 90; *+180 -0.0118 0 90; *+180 -0.4208 0 90; *+180 -0.0128 0 90; *+180 -0.3143 0 90; "
        "*+180 0 0 90; *+180 -0.1674 0 180",
        free=("theta3",),
    ),
    Arm(
        "sawyer",
        "* 0.317 0.081 -90; *+90 0.1925 0 90; * 0.4 0 -90; * 0.1685 0 90; * 0.4 0 -90; * 0.1363 0 90; "
        "* 0.13375 0 0",
        free=("theta7",),
    ),
    Arm(
        "general7R_quarter",
        ";".join(f"* d{i} a{i} {90 if i % 2 else -90}" for i in range(1, 8)),
        free=("theta7",),
    ),
)
