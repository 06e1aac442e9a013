"""``python -m congruent.sweep``: the same rows from a Dask cluster, also if a worker or the scheduler is lost on the way."""

import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from congruent.sweep import SweepError, run_sweep

distributed = pytest.importorskip("distributed")

CASES = 60


@pytest.fixture
def plan(tmp_path: Path, root: Path) -> Path:
    path = tmp_path / "payload.sweep.toml"
    path.write_text(
        f'schema_version = 1\nname = "payload"\nscenario = "{root}/scenarios/ur5e_payload.toml"\ncases = {CASES}\n'
        '[[vary]]\nkey = "fault.wrong_payload.mass_kg"\nuniform = [0.0, 4.0]\n'
    )
    return path


def congruent(*words: str | Path) -> subprocess.CompletedProcess[str]:
    call = [sys.executable, "-m", "congruent", *map(str, words)]
    return subprocess.run(call, capture_output=True, text=True, check=False)


def digest(plan: Path, out: Path) -> str:
    merged = congruent("sweep", "merge", out, "--plan", plan, "--worst", "0", "--format", "json")
    return str(json.loads(merged.stdout)["table_sha256"])


class Cluster:
    """A scheduler with workers as processes of their own."""

    def __init__(self) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.processes: list[subprocess.Popen[bytes]] = []

    def start(self, *words: str) -> "subprocess.Popen[bytes]":
        environment = os.environ | {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "10"}
        process = subprocess.Popen([sys.executable, "-m", *words], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.processes.append(process)
        return process

    def scheduler(self) -> "subprocess.Popen[bytes]":
        return self.start("distributed.cli.dask_scheduler", "--port", str(self.port), "--no-dashboard")

    def worker(self) -> "subprocess.Popen[bytes]":
        words = ("--nthreads", "1", "--no-dashboard", "--no-nanny", "--death-timeout", "60")
        return self.start("distributed.cli.dask_worker", self.address, *words)

    def close(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()


@pytest.fixture
def cluster():
    made = Cluster()
    yield made
    made.close()


def after_first_rows(out: Path, act) -> "object":
    """Does something once the first rows are there, beside the sweep."""
    import threading

    def wait() -> None:
        for _ in range(1200):
            if len(list((out / "rows").glob("*.jsonl"))) >= 2:
                break
            time.sleep(0.05)
        act()

    thread = threading.Thread(target=wait)
    thread.start()
    return thread


@pytest.mark.parametrize("lost", ["worker", "scheduler"])
def test_what_is_lost_is_run_again(plan: Path, tmp_path: Path, cluster: Cluster, lost: str) -> None:
    alone = tmp_path / "alone"
    congruent("sweep", "run", plan, "--out", alone, "--worst", "0")
    scheduler, first, _ = cluster.scheduler(), cluster.worker(), cluster.worker()
    out = tmp_path / "out"

    def act() -> None:
        if lost == "worker":
            first.kill()
        else:
            scheduler.kill()
            scheduler.wait()
            time.sleep(1.0)
            cluster.scheduler()
            cluster.worker()

    thread = after_first_rows(out, act)
    tasks = run_sweep(plan, out, address=cluster.address, chunk=3, patience_s=120.0)
    thread.join()
    # Each task was kept once: nothing ran twice but what was lost before it came back.
    assert tasks == CASES // 3 == len(list((out / "rows").glob("*.jsonl")))
    assert digest(plan, alone) == digest(plan, out)


def test_what_is_there_is_not_run_again(plan: Path, tmp_path: Path, cluster: Cluster) -> None:
    cluster.scheduler(), cluster.worker()
    out = tmp_path / "out"
    congruent("sweep", "run", plan, "--out", out, "--cases", "0..50")
    assert run_sweep(plan, out, address=cluster.address, chunk=5) == 2
    assert run_sweep(plan, out, address=cluster.address) == 0


def test_refusals_say_why(plan: Path, tmp_path: Path) -> None:
    with pytest.raises(SweepError, match="cannot be reached"):
        run_sweep(plan, tmp_path / "out", address="tcp://127.0.0.1:1", patience_s=0.0)
    plan.write_text(plan.read_text().replace("wrong_payload", "wrong_pay_load"))
    with pytest.raises(SweepError, match="one entry"):
        run_sweep(plan, tmp_path / "other")
