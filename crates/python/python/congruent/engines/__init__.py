"""What an engine of physics has loaded, compared with the file that it should simulate.

>>> import congruent
>>> report = congruent.check("ur5e.urdf", engine=congruent.engines.mujoco(model))  # doctest: +SKIP
>>> assert report.ok, str(report)  # doctest: +SKIP

An adapter reads the arrays of the loaded model, and not its file: bodies, joints, masses, damping, dry friction, armature,
limits. What was read is then verified: the engine's own poses and torques at some dozens of states have to be those of the
numbers read. While it is asked, limits, contacts, constraints and dry friction are off; every flag and value is as before
afterwards, also after an exception.

An engine is imported when its adapter is called. The head of each adapter says with which version it is tested.
"""

from ._engine import Engine, Precision
from ._drake import drake
from ._mujoco import mujoco
from ._newton import newton
from ._pinocchio import pinocchio
from ._pybullet import pybullet

__all__ = ["Engine", "Precision", "drake", "mujoco", "newton", "pinocchio", "pybullet"]
