"""The command ``congruent`` that the package installs."""

import sys
from typing import NoReturn

from ._native import run_command


def main() -> NoReturn:
    """Does what the command does with the arguments of the process, and ends it with the exit code of the command."""
    sys.exit(run_command(sys.argv[1:]))
