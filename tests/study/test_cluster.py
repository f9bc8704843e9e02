"""A study on a cluster, one of whose workers is killed, is the same to the last bit."""

from __future__ import annotations

import os
import signal

import pytest

from crankwork.description.machine_file import template
from crankwork.errors import CrankworkError
from crankwork.study.running import Where, run_study
from crankwork.study.study_file import load_study

distributed = pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

STUDY = """\
machine = "machine.toml"
values = "time_ratio.rocker"
[designs]
drawing = "random"
count = 60
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
def test_a_killed_worker_of_a_cluster_loses_nothing(study, tmp_path):
    run_study(study, tmp_path / "whole", Where(1))
    killed = []
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True, silence_logs=50
    ) as cluster:

        def kill(_):
            if not killed:
                killed.append(next(iter(cluster.workers.values())).pid)
                os.kill(killed[0], signal.SIGKILL)

        run_study(study, tmp_path / "out", Where(scheduler=cluster.scheduler_address), told=kill)
    assert killed
    found, wanted = (
        {one.name: one.read_bytes() for one in (tmp_path / at / "parts").iterdir()} for at in ("out", "whole")
    )
    assert found == wanted


@pytest.mark.filterwarnings("default")
def test_a_cluster_that_does_not_answer_is_named(study, tmp_path, monkeypatch):
    monkeypatch.setattr("crankwork.study.running._WAITS", "1s")
    with pytest.raises(CrankworkError, match="nothing answers there"):
        run_study(study, tmp_path / "out", Where(scheduler="tcp://127.0.0.1:1"))
