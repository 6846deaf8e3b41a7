"""Writes `numbers.json`: poses, Jacobians, D and g of the robots beside it by `pinocchio`, where that is
installed. Run once; the tests read the file."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

HERE = Path(__file__).parent
TIPS = {
    "mimics": "e",
    "panda": "panda_hand",
    "so101": "moving_jaw_so101_v1_link",
    "tiago": "wrist_ft_tool_link",
}
FOLLOWS = {"mimics": {"j2": ("j1", -1, 0.2), "j4": ("j3", 0.5, 0.1)}}


def by_pinocchio(path: Path, random: Random) -> dict[str, Any]:
    """At one point, by the names of the joints that move; what moves beside the arm is locked at zero."""
    import numpy as np
    import pinocchio as pin

    model = pin.buildModelFromUrdf(str(path))
    tip = model.getFrameId(TIPS.get(path.stem) or [f.name for f in model.frames if f.type == pin.BODY][-1])
    above, joints = model.frames[tip].parentJoint, []
    while above:
        joints.append(model.names[above])
        above = model.parents[above]
    name, locked = model.frames[tip].name, [n for n in model.names[1:] if n not in joints]
    if locked:
        ids = [model.getJointId(each) for each in locked]
        model = pin.buildReducedModel(model, ids, pin.neutral(model))
    follows = FOLLOWS.get(path.stem, {})
    free = [each for each in model.names[1:] if each not in follows]
    G, offset = np.zeros((model.nv, len(free))), np.zeros(model.nv)
    for i, each in enumerate(model.names[1:]):
        master, ratio, shift = follows.get(each, (each, 1.0, 0.0))
        G[i, free.index(master)], offset[i] = ratio, shift
    point = np.array([round(random.uniform(-1, 1), 3) for _ in free])
    q, v = pin.neutral(model), G @ point + offset
    for joint, value in zip(list(model.joints)[1:], v, strict=True):
        q[joint.idx_q : joint.idx_q + joint.nq] = value if joint.nq == 1 else (np.cos(value), np.sin(value))
    data, frame = model.createData(), model.getFrameId(name)
    pin.framesForwardKinematics(model, data, q)
    J = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED) @ G
    D = np.triu(pin.crba(model, data, q))
    D = G.T @ (D + np.triu(D, 1).T) @ G
    g = G.T @ pin.computeGeneralizedGravity(model, data, q)
    found = {"T": data.oMf[frame].homogeneous, "J": J, "D": D, "g": g}
    return {"tip": name, "q": dict(zip(free, map(float, point), strict=True))} | {
        key: value.tolist() for key, value in found.items()
    }


if __name__ == "__main__":
    import pinocchio

    random = Random(13)
    robots = {path.stem: by_pinocchio(path, random) for path in sorted((HERE / "robots").glob("*.urdf"))}
    text = json.dumps({"by": f"pinocchio {pinocchio.__version__}", "robots": robots})
    (HERE / "numbers.json").write_text(text.replace('}, "', '},\n"') + "\n", encoding="utf-8")
