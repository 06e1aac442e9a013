"""Mass matrices of MuJoCo, armature of joints and actuators included: python3 mass_matrices.py CORPUS > golden.json"""
import glob, json, os, sys
import mujoco, numpy as np

corpus = sys.argv[1]
names = [f"pairs/{name}/robot.xml" for name in ("panda", "piper", "so_arm100", "ur5e", "wx250s")]
names += [f"pairs/mjcf-constructs/{os.path.basename(path)}" for path in
          sorted(glob.glob(f"{corpus}/pairs/mjcf-constructs/c0[78]*.xml"))]
here = os.path.dirname(os.path.abspath(__file__))
rng, cases = np.random.default_rng(58), []
# A hinge and a slide, whose motors add the square of the gear times their own armature.
for name in names + ["geared.xml"]:
    model = mujoco.MjModel.from_xml_path(os.path.join(corpus if "/" in name else here, name))
    data = mujoco.MjData(model)
    joints = [j for j in range(model.njnt) if model.jnt_type[j] in (2, 3)]
    dofs = [int(model.jnt_dofadr[j]) for j in joints]
    states = []
    for _ in range(3):
        mujoco.mj_resetData(model, data)
        q = rng.uniform(-1, 1, len(joints))
        data.qpos[[model.jnt_qposadr[j] for j in joints]] = q
        mujoco.mj_forward(model, data)
        unit, matrix = np.eye(model.nv), np.zeros((model.nv, model.nv))
        for k in range(model.nv):
            mujoco.mj_mulM(model, data, matrix[k], unit[k])
        states.append({"q": q.tolist(), "mass_matrix": matrix[np.ix_(dofs, dofs)].tolist()})
    case = {"file": name, "joints": [model.joint(j).name for j in joints], "states": states}
    cases.append(case)
print(json.dumps({"generator": f"MuJoCo {mujoco.__version__} (Python), {os.path.basename(__file__)}", "cases": cases}))
