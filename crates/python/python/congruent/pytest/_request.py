"""What a test module asks for: which robots, compared with what. It needs no pytest."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias, TypedDict

PathText: TypeAlias = str | os.PathLike[str]

REQUEST = "congruent_request"
"""The attribute of a function that holds its request."""


class CheckOptions(TypedDict, total=False):
    """Options of ``congruent.check`` that are passed on; those that are not given are left out."""

    tolerance: str
    base: str
    tip: str
    seed: int
    strict: bool


@dataclass(frozen=True)
class CheckRequest:
    """The arguments of one call of ``congruent_check``."""

    patterns: tuple[str, ...]
    against: tuple[str, ...] = ()
    options: CheckOptions = field(default_factory=CheckOptions)


def congruent_check(
    *robots: PathText,
    against: PathText | Sequence[PathText] = (),
    tolerance: str | None = None,
    base: str | None = None,
    tip: str | None = None,
    seed: int = 0,
    strict: bool = False,
) -> Callable[[], None]:
    """A test for each comparison of these robots, if it is assigned to a name of a test module.

    ``robots`` are paths or patterns, such as ``"robots/*"``: folders with robot.toml, robot files, URDFs or MJCFs. They are looked
    for in the folder of the test module, and if no robot is there, in pytest's root folder; ``against`` is relative to the same
    folder. A pattern takes robots alone, and passes over other files; without a robot it is an error. A path without a wildcard
    is always taken.

    Each robot is compared with every path or ``git:REV`` of ``against``, or else with every ``[[reference]]`` of its robot file; a
    robot without either is checked by itself. The other options are those of ``congruent.check``.
    """
    if not robots:
        raise TypeError('congruent_check() needs a path or a pattern, such as "robots/*"')
    others = [against] if isinstance(against, (str, os.PathLike)) else against
    options: CheckOptions = {}
    if tolerance is not None:
        options["tolerance"] = tolerance
    if base is not None:
        options["base"] = base
    if tip is not None:
        options["tip"] = tip
    if seed:
        options["seed"] = seed
    if strict:
        options["strict"] = True

    # The plugin puts its tests in the place of this function. Without the plugin nothing would be checked, and nobody would see it.
    def without_plugin() -> None:
        raise RuntimeError("nothing was checked: the plugin is not loaded; call pytest with -p congruent.pytest.plugin")

    request = CheckRequest(tuple(os.fspath(robot) for robot in robots), tuple(os.fspath(other) for other in others), options)
    setattr(without_plugin, REQUEST, request)
    return without_plugin
