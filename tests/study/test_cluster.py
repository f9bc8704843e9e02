"""A study on a cluster whose workers, and whose driver, are killed is the same to the last bit."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.description.machine_file import template
from crankwork.errors import CrankworkError
from crankwork.study.runner import ExecutionOptions, run_study
from crankwork.study.study_file import load_study

pytestmark = pytest.mark.data
KILLS = 4
STUDY = """\
machine = "machine.toml"
values = "time_ratio.rocker"
[designs]
drawing = "random"
count = 400
chunk = 4
rows = true
[vary]
crank.radius = { from = "55 mm", to = "65 mm" }
"""


@pytest.fixture
def study(tmp_path):
    (tmp_path / "machine.toml").write_text(template("four-bar"), encoding="utf-8")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    return load_study(tmp_path / "study.toml")


@pytest.mark.filterwarnings("default")
def test_killed_workers_and_drivers_of_a_cluster_lose_nothing(study, tmp_path):
    """At moments that a generator chooses: a worker while a driver is at work, or that driver."""
    import distributed

    run_study(study, tmp_path / "whole", ExecutionOptions(1))
    out, generator = tmp_path / "out", np.random.default_rng(14)
    killed, gone = {"worker": 0, "driver": 0}, set()
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True, silence_logs=50
    ) as cluster:
        words = [sys.executable, "-m", "crankwork", "sweep", study.name, "-o", str(out)]
        words += ["--no-figures", "--scheduler", cluster.scheduler_address]
        own = os.environ | {"PYTHONPATH": str(Path(crankwork.__file__).parents[1])}
        while True:
            there = parts_of(out)
            resume = ["--resume"] if (out / "study.json").exists() else []
            driver = subprocess.Popen([*words, *resume], env=own, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            while driver.poll() is None and sum(killed.values()) < KILLS:
                # of the first runs none comes to its end
                wanted = len(there) + generator.integers(1, 4)
                wait_until(lambda: driver.poll() is not None or len(parts_of(out)) >= wanted)  # noqa: B023
                if driver.poll() is not None:
                    break
                is_driver = generator.random() < 0.4
                pid = driver.pid if is_driver else one_of(cluster, gone, generator)
                os.kill(pid, signal.SIGKILL)
                gone.add(pid)
                killed["driver" if is_driver else "worker"] += 1
                if is_driver:
                    driver.wait(60)
                there = parts_of(out)
            _, told = driver.communicate(timeout=200)
            if driver.returncode == 0:
                break
            assert driver.returncode == -signal.SIGKILL, told.decode()
    assert sum(killed.values()) == KILLS
    assert min(killed.values()) > 0
    assert parts_of(out) == parts_of(tmp_path / "whole")


def parts_of(folder):
    """Return the parts that are there, by name."""
    return {one.name: one.read_bytes() for one in (folder / "parts").glob("part-*")}


def wait_until(is_so):
    end = time.monotonic() + 100
    while not is_so() and time.monotonic() < end:
        time.sleep(0.01)


def one_of(cluster, gone, generator):
    """Return a worker that lives: its nanny has started it in the place of one that was killed."""

    def living():
        return [one.pid for one in cluster.workers.values() if one.pid and one.pid not in gone]

    wait_until(living)
    return int(generator.choice(living()))


@pytest.mark.filterwarnings("default")
def test_a_cluster_that_does_not_answer_is_named(study, tmp_path, monkeypatch):
    monkeypatch.setattr("crankwork.study.runner._TIMEOUT", "1s")
    with pytest.raises(CrankworkError, match="nothing answers there"):
        run_study(study, tmp_path / "out", ExecutionOptions(scheduler="tcp://127.0.0.1:1"))
