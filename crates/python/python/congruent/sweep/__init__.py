"""Sweeps on a Dask cluster, from the shell::

    python -m congruent.sweep plan.sweep.toml --out results --dask tcp://host:8786

Each task is a range of cases that a worker runs with the command ``congruent sweep run``; the rows come back to this process, which
keeps them in the folder. What was lost, with a worker or with the scheduler, is run again; the tables are the same.
"""

from ._driver import SweepError, run_sweep

__all__ = ["SweepError", "run_sweep"]
