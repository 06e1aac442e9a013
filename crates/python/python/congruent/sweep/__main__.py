"""``python -m congruent.sweep``: the command line."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from .._native import run_command
from ._driver import SweepError, run_sweep

# Exit codes of the command: bad input, and what Ctrl-C ends with in a shell.
BAD_INPUT, INTERRUPTED = 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the sweep that the arguments describe, merges it, and gives the exit code of the merge."""
    parser = argparse.ArgumentParser(
        prog="python -m congruent.sweep",
        description="Runs a sweep on a Dask cluster. Plan, scenario and robot must have the same paths on all workers.",
    )
    parser.add_argument("plan", help="the plan, *.sweep.toml")
    parser.add_argument("--out", required=True, metavar="DIR", help="the folder of rows, tables and pages")
    parser.add_argument("--dask", metavar="ADDRESS", help="the scheduler, as tcp://host:8786; without it a local cluster")
    parser.add_argument("--chunk", type=int, metavar="N", help="cases of a task; by default a task for each 1/20 of the share of a thread")
    parser.add_argument("--patience", type=float, default=300.0, metavar="S", help="how long a lost scheduler is waited for (default: 300 s)")
    options = parser.parse_args(arguments)
    if options.chunk is not None and options.chunk < 1:
        parser.error("--chunk is at least 1")
    try:
        ran = run_sweep(options.plan, options.out, address=options.dask, chunk=options.chunk, patience_s=options.patience)
    except SweepError as error:
        print(f"error: {error}", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        print(f"interrupted; the same call goes on: rows are kept in {options.out}", file=sys.stderr)
        return INTERRUPTED
    print(f"{ran} tasks ran", file=sys.stderr)
    return run_command(["sweep", "merge", options.out, "--plan", options.plan])


if __name__ == "__main__":
    sys.exit(main())
