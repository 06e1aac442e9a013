"""Runs the missing cases of a sweep as tasks of a Dask cluster."""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

# Tasks for each thread of the cluster, so that the last ones do not wait for one that is slow.
TASKS_A_THREAD = 20
# Most cases of a task: its rows travel as one message.
MOST_CASES = 5000
# Between two attempts to reach a scheduler.
RETRY_S = 1.0
# How long a connection may take.
CONNECT_S = 10.0


# What a connection that is lost raises, here and there.
CONNECTION_ERRORS = (OSError, TimeoutError, concurrent.futures.CancelledError, asyncio.CancelledError)


class SweepError(Exception):
    """The sweep cannot be run; the message says why."""


class _SchedulerLost(Exception):
    """The scheduler cannot be reached; what it had not returned is run again."""


def command_line() -> list[str]:
    """The command ``congruent`` of this Python."""
    return [sys.executable, "-m", "congruent"]


def run_cases(command: Sequence[str], plan: str, first: int, end: int) -> bytes:
    """Runs the cases from ``first`` to before ``end`` on this machine, and gives their rows as lines of JSON. A task of the cluster."""
    with tempfile.TemporaryDirectory(prefix="congruent_sweep_") as folder:
        call = [*command, "sweep", "run", plan, "--out", folder, "--cases", f"{first}..{end}", "--jobs", "1", "-q"]
        ended = subprocess.run(call, capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            # The name of the machine is in the message of the worker.
            raise SweepError(f"cases {first}..{end} cannot be run: {ended.stderr.strip() or ended.returncode}")
        return b"".join(path.read_bytes() for path in sorted(Path(folder, "rows").glob("*.jsonl")))


def run_sweep(
    plan: str | Path,
    out: str | Path,
    *,
    address: str | None = None,
    chunk: int | None = None,
    patience_s: float = 300.0,
    command: Sequence[str] | None = None,
) -> int:
    """Runs the cases of ``plan`` that have no row in the folder ``out``; returns how many tasks have run.

    ``address`` is that of a Dask scheduler; without it a cluster of this machine is used. A scheduler that is lost is waited for
    ``patience_s`` seconds. ``command`` is another command line of ``congruent`` on the workers.

    Raises ``SweepError`` if the plan is refused, a case range cannot be run, or the scheduler does not come back.
    """
    try:
        import distributed
    except ImportError:
        raise SweepError("dask.distributed is not installed: pip install distributed") from None
    command = list(command or command_line())
    plan, out = str(Path(plan).resolve()), Path(out)
    ran, lost_since = 0, None
    while missing := _missing(command, plan, out):
        try:
            with _connected(distributed, address) as client:
                for first, end, rows in _results(distributed, client, (command, plan), _tasks(missing, client, chunk)):
                    _keep(out, first, end, rows)
                    ran, lost_since = ran + 1, None
        except _SchedulerLost as error:
            lost_since = lost_since or time.monotonic()
            if time.monotonic() - lost_since > patience_s:
                raise SweepError(f"the scheduler {address} cannot be reached: {error}; the same call goes on later") from None
            time.sleep(RETRY_S)
    return ran


def _missing(command: Sequence[str], plan: str, out: Path) -> list[tuple[int, int]]:
    """The ranges of cases that have no row; the folder is made if it is not there."""
    call = [*command, "sweep", "status", str(out), "--plan", plan, "--format", "json"]
    ended = subprocess.run(call, capture_output=True, text=True, check=False)
    if not ended.stdout:
        raise SweepError(ended.stderr.strip() or f"{' '.join(call)} ended with {ended.returncode}")
    progress = json.loads(ended.stdout)
    if "missing" not in progress:
        raise SweepError("; ".join(finding.get("message", "") for finding in progress.get("findings", [])) or ended.stdout)
    return [(int(first), int(end)) for first, end in (text.split("..") for text in progress["missing"])]


@contextlib.contextmanager
def _connected(distributed: Any, address: str | None) -> Iterator[Any]:
    """A client of the scheduler, or of a cluster of its own, which ends with it: one thread a process, since each runs the command."""
    try:
        client = distributed.Client(address, timeout=CONNECT_S) if address else distributed.Client(threads_per_worker=1, dashboard_address=None)
    except CONNECTION_ERRORS as error:
        raise _SchedulerLost(str(error)) from None
    try:
        yield client
    finally:
        # Of a scheduler that is gone nothing can be closed.
        with contextlib.suppress(*CONNECTION_ERRORS):
            client.close(timeout=CONNECT_S)


def _tasks(missing: Sequence[tuple[int, int]], client: Any, chunk: int | None) -> list[tuple[int, int]]:
    """The missing ranges, cut into tasks."""
    cases = sum(end - first for first, end in missing)
    try:
        threads = max(1, sum(client.nthreads().values()))
    except CONNECTION_ERRORS as error:
        raise _SchedulerLost(str(error)) from None
    size = chunk or min(MOST_CASES, max(1, cases // (threads * TASKS_A_THREAD)))
    return [(first, min(first + size, end)) for begin, end in missing for first in range(begin, end, size)]


def _results(
    distributed: Any, client: Any, call: tuple[Sequence[str], str], tasks: Sequence[tuple[int, int]]
) -> Iterator[tuple[int, int, bytes]]:
    """The rows of each task as they come. A task of a lost worker is run again by the scheduler."""
    command, plan = call
    try:
        futures = {client.submit(run_cases, command, plan, first, end, pure=False): (first, end) for first, end in tasks}
        for future in distributed.as_completed(futures, raise_errors=False):
            first, end = futures[future]
            if future.status == "cancelled" or client.status != "running":
                raise _SchedulerLost("its connection was closed")
            if future.status == "error":
                raise SweepError(str(future.exception()))
            yield first, end, future.result(timeout=CONNECT_S)
            # The scheduler may forget the rows: they are kept here.
            future.release()
    except CONNECTION_ERRORS as error:
        raise _SchedulerLost(str(error)) from None


def _keep(out: Path, first: int, end: int, rows: bytes) -> None:
    """Keeps the rows of a task as one file, which is there whole or not at all."""
    folder = out / "rows"
    partial = folder / f"{first:012}-{end:012}-dask.partial"
    partial.write_bytes(rows)
    partial.replace(folder / f"{first:012}-{end:012}-dask.jsonl")
