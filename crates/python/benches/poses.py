"""A million tip poses of an arm with six joints, beside other libraries that are installed.

python crates/python/benches/poses.py [ROBOT.urdf]

Each library is called as its documentation shows it: in one call for all rows if it has one, or else in a loop over rows, of
which fewer are measured. Times are the least of five, on all cores that the library uses by itself.
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import congruent

URDF = Path(__file__).resolve().parents[3] / "robots/ur5e/ur5e.urdf"
ROWS = 1_000_000
# Rows of a loop in Python.
FEW = 20_000
REPEATS = 5


def least_s(call: Callable[[], object]) -> float:
    """The least time of some calls: noise only adds."""
    times = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return min(times)


def ours(urdf: Path, q: np.ndarray) -> tuple[int, Callable[[], object]]:
    robot = congruent.Robot(urdf)
    return len(q), lambda: robot.fk(q)


def by_pinocchio(urdf: Path, q: np.ndarray) -> tuple[int, Callable[[], object]]:
    import pinocchio as pin  # type: ignore[import-untyped]

    model = pin.buildModelFromUrdf(str(urdf))
    data, frame = model.createData(), model.getFrameId(congruent.Robot(urdf).tip)

    def loop() -> None:
        for row in q[:FEW]:
            pin.forwardKinematics(model, data, row)
            pin.updateFramePlacement(model, data, frame)

    return FEW, loop


def by_mujoco(urdf: Path, q: np.ndarray) -> tuple[int, Callable[[], object]]:
    import mujoco  # type: ignore[import-untyped]

    model = mujoco.MjModel.from_xml_path(str(urdf))
    data = mujoco.MjData(model)

    def loop() -> None:
        for row in q[:FEW]:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)

    return FEW, loop


def by_roboticstoolbox(urdf: Path, q: np.ndarray) -> tuple[int, Callable[[], object]]:
    import roboticstoolbox as rtb

    robot = rtb.Robot.URDF(str(urdf))
    return FEW, lambda: robot.fkine(q[:FEW])


def main() -> None:
    urdf = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else URDF
    joints = congruent.Robot(urdf).dof
    q = np.random.default_rng(0).uniform(-3, 3, (ROWS, joints))
    print(f"{urdf.name}, {joints} joints")
    libraries = {
        "congruent": ours,
        "pinocchio": by_pinocchio,
        "mujoco": by_mujoco,
        "roboticstoolbox": by_roboticstoolbox,
    }
    for name, prepare in libraries.items():
        try:
            rows, call = prepare(urdf, q)
            time_s = least_s(call)
        except ImportError as error:
            print(f"  {name:16} not installed ({error})")
        except Exception as error:  # noqa: BLE001, another library may refuse the file in any manner
            print(f"  {name:16} not measured: {type(error).__name__}: {error}")
        else:
            print(f"  {name:16} {time_s / rows * 1e6:8.3f} us a pose, {time_s / rows * ROWS:8.3f} s for a million")


if __name__ == "__main__":
    main()
