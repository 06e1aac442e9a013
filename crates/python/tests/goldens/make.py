"""Writes what Pinocchio computes of robots of this repository, for tests that need no Pinocchio.

python crates/python/tests/goldens/make.py
"""

import json
from pathlib import Path

import numpy as np
import pinocchio as pin  # type: ignore[import-untyped]

HERE = Path(__file__).resolve().parent
ROBOTS = HERE.parents[3] / "robots"
# Tips by robot: the declared ones.
TIPS = {"ur5e": "tool0", "panda": "panda_link8", "rrr_arm": "gripper_frame_cp", "cylindrical_rpp": "flange"}


def entry(name: str, tip: str) -> dict[str, object]:
    model = pin.buildModelFromUrdf(str(ROBOTS / name / f"{name}.urdf"))
    # Compared are the equations of the rigid bodies, without what a file says of motors.
    data, frame = model.createData(), model.getFrameId(tip)
    random = np.random.default_rng(2026)
    states = []
    for _ in range(5):
        q, v, a = (random.uniform(-1, 1, model.nq) for _ in range(3))
        pin.forwardKinematics(model, data, q)
        pose = pin.updateFramePlacement(model, data, frame)
        jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED)
        tau = pin.rnea(model, data, q, v, a)
        states.append(
            {
                "q": q.tolist(),
                "qd": v.tolist(),
                "qdd": a.tolist(),
                "base_from_tip": pose.homogeneous.tolist(),
                # Pinocchio has the linear part first.
                "jacobian": np.vstack([jacobian[3:], jacobian[:3]]).tolist(),
                "mass_matrix": pin.crba(model, data, q).tolist(),
                "tau": tau.tolist(),
            }
        )
    return {"tip": tip, "joints": list(model.names)[1:], "states": states}


if __name__ == "__main__":
    tool = f"pinocchio {pin.__version__}, 17 digits, q, qd and qdd random in [-1, 1], seed 2026"
    robots = {name: entry(name, tip) for name, tip in TIPS.items()}
    text = json.dumps({"tool": tool, "command": "python crates/python/tests/goldens/make.py", "robots": robots})
    (HERE / "pinocchio.json").write_text(text + "\n")
