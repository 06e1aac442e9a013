"""Results that have several parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from numpy import bool_, float64, int64
from numpy.typing import NDArray


class IkResult(NamedTuple):
    """Joint positions that bring a frame to its targets, or as near as was found. For one target the arrays have no dimension
    for the rows: ``q`` is (joints,) and the others are ()."""

    q: NDArray[float64]
    """Joint positions, (n, joints), rad or m, always within the limits."""
    converged: NDArray[bool_]
    """Whether both residuals are within the tolerance, (n,)."""
    position_error_m: NDArray[float64]
    """Distance to the target, (n,), m."""
    orientation_error_rad: NDArray[float64]
    """Angle to the target, (n,), rad; 0 for a target without an orientation."""
    iterations: NDArray[int64]
    """Steps of all attempts, (n,)."""


@dataclass(frozen=True)
class BaseParameter:
    """A sum of inertial parameters that are identifiable only together."""

    name: str
    """The parameter that the sum is named by, as ``joint.ixx``; its factor is 1."""
    value: float
    """Value of the sum by the description."""
    unit: str
    """``kg m^2``, ``kg m`` or ``kg``."""
    grouped: dict[str, float]
    """The parameters that are added to it, with their factors."""

    def coefficients(self, names: list[str]) -> NDArray[Any]:
        """The row that gives the sum from the values of these parameters, such as ``robot.parameter_names``: (parameters,)."""
        import numpy

        row = numpy.zeros(len(names))
        row[names.index(self.name)] = 1.0
        for name, factor in self.grouped.items():
            row[names.index(name)] = factor
        return row
