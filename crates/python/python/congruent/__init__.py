"""Do two descriptions of a robot arm describe the same robot? And what an arm does, for numpy arrays.

>>> import congruent
>>> robot = congruent.Robot("robots/ur5e")
>>> robot.fk([0.0] * 6).shape
(4, 4)
>>> print(congruent.check("robots/ur5e").grade)
identical

Units are m, kg, s and rad. ``base_from_tip`` is the pose of the tip in the base.
"""

from . import engines, spatial
from ._errors import CongruentError, Finding
from ._native import Report, Robot, check, run
from ._results import BaseParameter, IkResult

__all__ = ["BaseParameter", "CongruentError", "Finding", "IkResult", "Report", "Robot", "check", "engines", "run", "spatial"]
