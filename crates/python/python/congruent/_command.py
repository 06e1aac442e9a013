"""The command ``congruent`` that the package installs."""

import signal
import sys
from typing import NoReturn

from ._native import run_command


def main() -> NoReturn:
    """Does what the command does with the arguments of the process, and ends it with the exit code of the command."""
    # The command handles Ctrl-C by itself: Python would raise an exception beside that, in place of the exit code.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(run_command(sys.argv[1:]))
