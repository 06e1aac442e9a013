"""Poses and mass matrices of a written MJCF in MuJoCo, against its source, without anything of the project.

    python3 against_mujoco.py SOURCE WRITTEN

A source in MJCF is loaded in MuJoCo too. Of a URDF the poses and the
mass matrix, the sum of m Jv' Jv + Jw' I Jw over all links, are computed here. Printed are the largest differences: of positions
in m, of rotation matrices, and of mass matrices relative to their largest entry.
"""
import sys
import xml.etree.ElementTree as ET
import mujoco
import numpy as np


def rpy(r, p, y):
    cr, sr, cp, sp, cy, sy = np.cos(r), np.sin(r), np.cos(p), np.sin(p), np.cos(y), np.sin(y)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def origin(e):
    t, o = np.eye(4), None if e is None else e.find("origin")
    if o is not None:
        t[:3, :3] = rpy(*map(float, o.get("rpy", "0 0 0").split()))
        t[:3, 3] = list(map(float, o.get("xyz", "0 0 0").split()))
    return t


def turn(axis, angle):
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


class Urdf:
    def __init__(self, path):
        root = ET.parse(path).getroot()
        self.links = {l.get("name"): l for l in root.findall("link")}
        self.joints = root.findall("joint")
        self.by_parent = {}
        for j in self.joints:
            self.by_parent.setdefault(j.find("parent").get("link"), []).append(j)
        children = {j.find("child").get("link") for j in self.joints}
        self.root = next(l for l in self.links if l not in children)
        self.moving = [j.get("name") for j in self.joints if j.get("type") != "fixed"]

    def evaluate(self, q):
        poses, n = {self.root: np.eye(4)}, len(self.moving)
        # Index, kind, axis and point of each joint on the path to a link.
        jac = {self.root: []}
        stack = [self.root]
        while stack:
            link = stack.pop()
            for j in self.by_parent.get(link, []):
                child, t = j.find("child").get("link"), poses[link] @ origin(j)
                path = list(jac[link])
                if j.get("type") != "fixed":
                    i = self.moving.index(j.get("name"))
                    a = j.find("axis")
                    a = np.array(list(map(float, a.get("xyz").split())) if a is not None else [1.0, 0, 0])
                    a = a / np.linalg.norm(a)
                    path.append((i, j.get("type"), t[:3, :3] @ a, t[:3, 3].copy()))
                    m = np.eye(4)
                    if j.get("type") == "prismatic":
                        m[:3, 3] = a * q[i]
                    else:
                        m[:3, :3] = turn(a, q[i])
                    t = t @ m
                poses[child], jac[child] = t, path
                stack.append(child)
        mass = np.zeros((n, n))
        for name, l in self.links.items():
            e = l.find("inertial")
            if e is None:
                continue
            t = poses[name] @ origin(e)
            m = float(e.find("mass").get("value"))
            i = {k: float(v) for k, v in e.find("inertia").attrib.items()}
            tensor = np.array([[i["ixx"], i["ixy"], i["ixz"]], [i["ixy"], i["iyy"], i["iyz"]], [i["ixz"], i["iyz"], i["izz"]]])
            tensor = t[:3, :3] @ tensor @ t[:3, :3].T
            jw, jv = np.zeros((3, n)), np.zeros((3, n))
            for k, kind, a, p in jac[name]:
                if kind == "prismatic":
                    jv[:, k] = a
                else:
                    jw[:, k], jv[:, k] = a, np.cross(a, t[:3, 3] - p)
            mass += m * jv.T @ jv + jw.T @ tensor @ jw
        return poses, mass


def full(model, data):
    m = np.zeros((model.nv, model.nv))
    for k in range(model.nv):
        unit, column = np.zeros(model.nv), np.zeros(model.nv)
        unit[k] = 1
        mujoco.mj_mulM(model, data, column, unit)
        m[:, k] = column
    return m


def compare(source, written):
    model = mujoco.MjModel.from_xml_path(written)
    data = mujoco.MjData(model)
    rng = np.random.default_rng(1)
    is_urdf = source.endswith("urdf")
    if is_urdf:
        urdf = Urdf(source)
        names = urdf.moving
    else:
        other = mujoco.MjModel.from_xml_path(source)
        od = mujoco.MjData(other)
        names = [other.joint(i).name for i in range(other.njnt)]
    adr = [model.joint(n).qposadr[0] for n in names]
    dof = [model.joint(n).dofadr[0] for n in names]
    worst_p = worst_r = worst_m = 0.0
    for k in range(20):
        q = rng.uniform(-1, 1, len(names)) if k else np.zeros(len(names))
        data.qpos[:] = 0
        data.qpos[adr] = q
        mujoco.mj_forward(model, data)
        if is_urdf:
            poses, mass = urdf.evaluate(q)
            poses = {n: p for n, p in poses.items() if mujoco.mj_name2id(model, 1, n) >= 0}
        else:
            od.qpos[[other.joint(n).qposadr[0] for n in names]] = q
            mujoco.mj_forward(other, od)
            theirs = [other.joint(n).dofadr[0] for n in names]
            mass = full(other, od)[np.ix_(theirs, theirs)]
            poses = {}
            for b in range(other.nbody):
                p = np.eye(4)
                p[:3, :3], p[:3, 3] = od.xmat[b].reshape(3, 3), od.xpos[b]
                poses[other.body(b).name] = p
        for n, p in poses.items():
            b = model.body(n).id
            worst_p = max(worst_p, np.abs(data.xpos[b] - p[:3, 3]).max())
            worst_r = max(worst_r, np.abs(data.xmat[b].reshape(3, 3) - p[:3, :3]).max())
        found = full(model, data)[np.ix_(dof, dof)]
        largest = np.abs(mass).max()
        # Without any mass the written one has that of the warning, 1e-12 kg.
        worst_m = max(worst_m, np.abs(found - mass).max() / (largest if largest > 1e-9 else 1.0))
    return worst_p, worst_r, worst_m


if __name__ == "__main__":
    print(*compare(sys.argv[1], sys.argv[2]))
