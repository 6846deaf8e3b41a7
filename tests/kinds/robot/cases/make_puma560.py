"""Writes the numbers of other programs for the PUMA 560: `python make_puma560.py roboticstoolbox` or
`pinocchio`, where that program is installed. Run once; the tests read the files."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
POINTS = 20
# alpha, a, d, mass, com, moments about it, rotor, ratio: Corke and Armstrong-Helouvry, 1994
ROWS = (
    (np.pi / 2, 0, 0.67183, 0, (0, 0, 0), (0, 0.35, 0), 0.0002, -62.6111),
    (0, 0.4318, 0, 17.4, (-0.3638, 0.006, 0.2275), (0.13, 0.524, 0.539), 0.0002, 107.815),
    (-np.pi / 2, 0.0203, 0.15005, 4.8, (-0.0203, -0.0141, 0.07), (0.066, 0.086, 0.0125), 0.0002, -53.7063),
    (np.pi / 2, 0, 0.4318, 0.82, (0, 0.019, 0), (0.0018, 0.0013, 0.0018), 3.3e-5, 76.0364),
    (-np.pi / 2, 0, 0, 0.34, (0, 0, 0), (0.0003, 0.0004, 0.0003), 3.3e-5, 71.923),
    (0, 0, 0, 0.09, (0, 0, 0.032), (0.00015, 0.00015, 4e-5), 3.3e-5, 76.686),
)


def by_roboticstoolbox(points):
    """D with its rotors, C qdot and g of the toolbox's own model."""
    import roboticstoolbox as rtb

    arm = rtb.models.DH.Puma560()
    for link, (alpha, a, d, m, r, I, J, G) in zip(arm.links, ROWS, strict=True):
        own = (link.alpha, link.a, link.d, link.m, *link.r, *np.diag(link.I), link.Jm, link.G)
        assert np.allclose(own, (alpha, a, d, m, *r, *I, J, G), rtol=0, atol=1e-15)
    bare = arm.nofriction(coulomb=True, viscous=True)
    found = [(bare.inertia(q), bare.coriolis(q, qd) @ qd, bare.gravload(q)) for q, qd in points]
    return f"roboticstoolbox-python {rtb.__version__}, models.DH.Puma560", found


def by_pinocchio(points):
    """The same arm built row by row: crba, nle less gravity, computeGeneralizedGravity."""
    import pinocchio as pin

    model, parent, placement = pin.Model(), 0, pin.SE3.Identity()
    for i, (alpha, a, d, m, r, I, _, _) in enumerate(ROWS):
        parent = model.addJoint(parent, pin.JointModelRZ(), placement, f"joint{i + 1}")
        turn = np.array([[1, 0, 0], [0, np.cos(alpha), -np.sin(alpha)], [0, np.sin(alpha), np.cos(alpha)]])
        placement = pin.SE3(turn, np.array([a, 0.0, d]))
        body = pin.Inertia(float(m), np.array(r, float), np.diag(np.array(I, float)))
        model.appendBodyToJoint(parent, body, placement)
    model.gravity.linear = np.array([0, 0, -9.81])
    model.armature = np.array([G**2 * J for *_, J, G in ROWS])
    data = model.createData()
    found = []
    for q, qd in points:
        D = np.triu(pin.crba(model, data, q))
        g = pin.computeGeneralizedGravity(model, data, q).copy()
        h = pin.nonLinearEffects(model, data, q, qd) - g
        found.append((D + np.triu(D, 1).T, h, g))
    return f"pinocchio {pin.__version__}, model built joint by joint", found


def main(name: str) -> None:
    draw = np.random.default_rng(560)
    points = [(draw.uniform(-3, 3, 6), draw.uniform(-2, 2, 6)) for _ in range(POINTS)]
    source, found = {"roboticstoolbox": by_roboticstoolbox, "pinocchio": by_pinocchio}[name](points)
    rows = [
        {"q": list(q), "qdot": list(qd), "D": D.tolist(), "C_qdot": list(h), "g": list(g)}
        for (q, qd), (D, h, g) in zip(points, found, strict=True)
    ]
    text = json.dumps({"source": source, "points": rows}, indent=None).replace('{"q"', '\n{"q"')
    (HERE / f"puma560-{name}.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
