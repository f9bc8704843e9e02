"""Studies in folders: the same parts to the last bit whoever is killed, and nothing of another study."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from crankwork import cli, files
from crankwork.description.machine_file import template
from crankwork.errors import CrankworkError
from crankwork.kernel import compiled
from crankwork.locale import LANGUAGES, translate
from crankwork.study.chunks import prepared_study
from crankwork.study.runner import ExecutionOptions, run_study
from crankwork.study.study_file import load_study
from crankwork.study.study_text import found_data, found_text, ranked

pytestmark = pytest.mark.data
MILLION = Path(__file__).parents[2] / "examples" / "studies" / "million-engines.toml"
# fits of these are carried out by nothing but an analysis of every design
ALONE = """\
machine = "machine.toml"
values = ["free_force.1", "counterweight_moment"]
[designs]
drawing = "latin"
count = 60
chunk = 4
rows = true
[vary]
crank.radius = { from = "55 mm", to = "65 mm" }
"""
COMPILED = """\
machine = "machine.toml"
values = "stroke"
[designs]
drawing = "sobol"
count = 3000
chunk = 512
angles = 72
rows = true
[vary]
crank.radius = { from = "40 mm", to = "50 mm" }
rod.ratio = "0.25 sd 0.01"
[objectives]
piston_velocity_max = "minimise"
piston_acceleration_max = "maximise"
"""


@pytest.fixture
def write(tmp_path):
    def study(text=COMPILED, machine="slider-crank"):
        (tmp_path / "machine.toml").write_text(template(machine), encoding="utf-8")
        (tmp_path / "study.toml").write_text(text, encoding="utf-8")
        return tmp_path / "study.toml"

    return study


def rows_of(path):
    """Return what stands in a part, or in a folder of them."""
    from pyarrow import parquet

    return parquet.read_table(path)


def parts_of(folder):
    return {one.name: hashlib.sha256(one.read_bytes()).hexdigest() for one in (Path(folder) / "parts").iterdir()}


def written_parts(folder):
    """Return how many parts are whole, while a run may be writing others."""
    return len(list((folder / "parts").glob("part-*")))


def started(*arguments):
    words = [sys.executable, "-m", "crankwork", "sweep", *map(str, arguments)]
    source = str(Path(cli.__file__).parents[2])
    nowhere = subprocess.DEVNULL
    return subprocess.Popen(words, env=os.environ | {"PYTHONPATH": source}, stdout=nowhere, stderr=nowhere)


def wait_for(done, running):
    """Wait until something is so, or a program has ended."""
    end = time.monotonic() + 60
    while not done() and running.poll() is None and time.monotonic() < end:
        time.sleep(0.02)


def workers_of(pid):
    """Return the processes that a driver has started, by what Linux tells of them."""
    found = []
    for one in Path("/proc").glob("[0-9]*/stat"):
        try:
            words = one.read_text().rpartition(")")[2].split()
            is_worker = int(words[1]) == pid and b"spawn_main" in (one.parent / "cmdline").read_bytes()
        except OSError:
            continue
        if is_worker and words[0] != "Z":
            found.append(int(one.parent.name))
    return found


@pytest.mark.elsewhere
def test_indices_of_a_swept_volume_are_those_of_a_product(write, tmp_path):
    """Of a product of independent factors, D^2 and 2 r, from the variance of each over the square of its mean."""
    text = (
        'machine = "machine.toml"\nvalues = "swept_volume"\n[designs]\ndrawing = "saltelli"\ncount = 16384\n'
        "angles = 36\n"
        '[vary]\ncrank.radius = { uniform = "45 ± 9 mm" }\ncylinder.bore = { uniform = "85 ± 17 mm" }\n'
    )
    study = load_study(write(text, "engine"))
    found = run_study(study, tmp_path / "out", ExecutionOptions(1))
    alone, _, total, _ = found.shares["swept_volume"].indices()
    # of a uniform share about 1 within h: E x^2 = 1 + h^2/3, E x^4 = 1 + 2 h^2 + h^4/5
    h = 0.2
    radius = h**2 / 3
    bore = (1 + 2 * h**2 + h**4 / 5) / (1 + h**2 / 3) ** 2 - 1
    whole = (1 + radius) * (1 + bore) - 1
    np.testing.assert_allclose(alone, [radius / whole, bore / whole], atol=3e-3)
    np.testing.assert_allclose(total, [radius * (1 + bore) / whole, bore * (1 + radius) / whole], atol=3e-3)
    assert found.moments["swept_volume"].mean == pytest.approx(np.pi / 4 * 0.085**2 * (1 + h**2 / 3) * 0.09, rel=1e-4)


def test_the_example_says_which_engine_is_best(tmp_path):
    text = MILLION.read_text("utf-8").replace("1_000_000", "8192")
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    (tmp_path / "petrol-cylinder.toml").write_text(MILLION.with_name("petrol-cylinder.toml").read_text("utf-8"))
    study = load_study(tmp_path / "study.toml")
    assert prepared_study(study).reason == ""
    found = run_study(study, tmp_path / "out", ExecutionOptions(2))
    assert found.designs == 8192
    assert 0 < found.within < 8192
    best, pareto = ranked(study, found)
    force = found.values[study.keys.index("piston_force_max")]
    assert np.all(force[np.concatenate([pareto, *best.values()])] <= 36e3)
    assert np.any(force > 36e3)
    # torque is that of the work, whatever turns
    alone = found.shares["mean_torque"].indices()[0]
    np.testing.assert_allclose(alone, found.shares["indicated_work"].indices()[0], atol=1e-9)


def test_rows_tell_their_units_and_the_seed(write, tmp_path):
    study = load_study(write(COMPILED.replace("count = 3000", "count = 700\nseed = 42")))
    run_study(study, tmp_path / "out", ExecutionOptions(1))
    table = rows_of(tmp_path / "out" / "parts" / "part-0000001.parquet")
    units = {one.name: (one.metadata or {}).get(b"unit") for one in table.schema}
    assert units == {"design": None, "crank.radius": b"m", "rod.ratio": b"", "piston_velocity_max": b"m/s",
                     "piston_acceleration_max": b"m/s2", "stroke": b"m"}  # fmt: skip
    assert json.loads(table.schema.metadata[b"crankwork"])["seed"] == 42
    assert table["design"].to_pylist() == list(range(512, 700))
    np.testing.assert_allclose(table["stroke"].to_numpy(), 2 * table["crank.radius"].to_numpy(), rtol=1e-14)


def test_a_run_goes_on_where_it_was_stopped(write, tmp_path):
    # 100 chunks, and a worker is at most 64 of them ahead of the one that is waited for
    study = load_study(write(COMPILED.replace("chunk = 512", "chunk = 30")))
    whole = run_study(study, tmp_path / "whole", ExecutionOptions(2))

    def stop(count):
        if count > 500:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(study, tmp_path / "stopped", ExecutionOptions(2), progress=stop)
    assert 17 <= len(parts_of(tmp_path / "stopped")) <= 17 + 64
    found = run_study(study, tmp_path / "stopped", ExecutionOptions(1), resume=True)
    assert parts_of(tmp_path / "stopped") == parts_of(tmp_path / "whole")
    np.testing.assert_array_equal(found.numbers, whole.numbers)
    assert found.moments == whole.moments
    assert found.histograms == whole.histograms


@pytest.mark.compiled
@pytest.mark.parametrize("values", ['["time_ratio.rocker", "link_swing.rocker"]', '"joint_force_max.A"'])
def test_who_compiles_and_who_finds_it_compiled_give_the_same_bits(write, tmp_path, monkeypatch, values):
    text = ALONE.replace('["free_force.1", "counterweight_moment"]', values)
    study = write(text.replace("count = 60", "count = 12"), "four-bar")
    assert prepared_study(load_study(study)).reason == ""
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path / "cache"))
    for out in ("first", "second"):
        assert started(study, "-o", tmp_path / out, "--workers", 1).wait(100) == 0
    assert parts_of(tmp_path / "first") == parts_of(tmp_path / "second")


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are found as Linux tells of them")
def test_killed_workers_and_drivers_lose_nothing(write, tmp_path):
    # a link that turns about
    text = ALONE.replace('["free_force.1", "counterweight_moment"]', '"link_swing.coupler"')
    study = write(text.replace("55 mm", "198 mm").replace("65 mm", "202 mm"), "chebyshev")
    assert prepared_study(load_study(study)).reason == "direction"
    run_study(load_study(study), tmp_path / "whole", ExecutionOptions(1))
    out, kills = tmp_path / "out", 0
    while True:
        resume = ["--resume"] if (out / "study.json").exists() else []
        running = started(study, "-o", out, "--workers", 2, *resume)
        before = written_parts(out)
        wait_for(lambda: written_parts(out) >= before + 2, running)  # noqa: B023
        workers = workers_of(running.pid)
        if kills < 4 and running.poll() is None and workers:
            os.kill(workers[0] if kills % 2 else running.pid, signal.SIGKILL)
            kills += 1
            if running.wait(60) == -signal.SIGKILL:
                # nobody is left of those it has started
                end = time.monotonic() + 10
                while [one for one in workers if _lives(one)] and time.monotonic() < end:
                    time.sleep(0.05)
                assert [one for one in workers if _lives(one)] == []
        if running.wait(100) == 0:
            break
        assert running.returncode == -signal.SIGKILL
    assert kills >= 2
    assert parts_of(out) == parts_of(tmp_path / "whole")
    rows = rows_of(out / "parts")["design"].to_pylist()
    assert sorted(rows) == list(range(60))


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are found as Linux tells of them")
def test_a_worker_that_ends_while_nobody_looks_loses_nothing(write, tmp_path):
    study, ended = load_study(write(ALONE, "four-bar")), []

    def end_one(_):
        if workers := workers_of(os.getpid())[: len(ended) < 2]:
            ended.extend(workers)
            os.kill(workers[0], signal.SIGKILL)
            # the pool notices, and takes nothing more
            time.sleep(1)

    run_study(study, tmp_path / "whole", ExecutionOptions(1))
    found = run_study(study, tmp_path / "out", ExecutionOptions(2), progress=end_one)
    assert ended
    assert found.designs == 60
    assert parts_of(tmp_path / "out") == parts_of(tmp_path / "whole")


def _lives(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_another_study_is_refused(write, tmp_path):
    run_study(load_study(write()), tmp_path / "out", ExecutionOptions(1))
    with pytest.raises(CrankworkError, match="holds a study already; go on with it by --resume"):
        run_study(load_study(write()), tmp_path / "out", ExecutionOptions(1))
    other = load_study(write(COMPILED.replace("0.01", "0.02")))
    with pytest.raises(CrankworkError, match="holds another study, study, machine differ; undo the change"):
        run_study(other, tmp_path / "out", ExecutionOptions(1), resume=True)
    study = load_study(write())
    (tmp_path / "machine.toml").write_text(template("slider-crank").replace("0.55 kg", "0.56 kg") + "# changed\n")
    with pytest.raises(CrankworkError, match="machine differ"):
        run_study(load_study(tmp_path / "study.toml"), tmp_path / "out", ExecutionOptions(1), resume=True)
    with pytest.raises(CrankworkError, match="holds no study to go on with"):
        run_study(study, tmp_path / "empty", ExecutionOptions(1), resume=True)


def test_one_driver_works_in_a_folder(write, tmp_path):
    pytest.importorskip("fcntl")
    study = load_study(write())
    refused = []

    def beside(_):
        with pytest.raises(CrankworkError, match="another run is working on this study") as error:
            run_study(study, tmp_path / "out", ExecutionOptions(1), resume=True)
        refused.append(error)

    run_study(study, tmp_path / "out", ExecutionOptions(1), progress=beside)
    assert len(refused) == 6


def test_a_damaged_part_is_named(write, tmp_path):
    study = load_study(write())
    run_study(study, tmp_path / "out", ExecutionOptions(1))
    path = tmp_path / "out" / "parts" / "part-0000003.parquet"
    whole = path.read_bytes()
    for data in (
        whole[:500],
        whole[:300] + b"\0\0\0" + whole[303:],
        path.with_name("part-0000002.parquet").read_bytes(),
    ):
        path.write_bytes(data)
        with pytest.raises(CrankworkError, match=r"part-0000003.parquet: is damaged, or not a part of this study"):
            run_study(study, tmp_path / "out", ExecutionOptions(1), resume=True)
    path.unlink()
    run_study(study, tmp_path / "out", ExecutionOptions(1), resume=True)
    assert path.read_bytes() == whole


def test_a_full_disk_stops_a_run_that_can_go_on(write, tmp_path, monkeypatch):
    study, through, written = load_study(write()), files._write_through, []

    def write_through(path, data):
        written.append(path)
        if len(written) == 4:
            path.write_bytes(data[:100])
            raise OSError(errno.ENOSPC, "No space left on device")
        through(path, data)

    with monkeypatch.context() as patched:
        patched.setattr(files, "_write_through", write_through)
        with pytest.raises(
            CrankworkError, match=r"cannot be written \(no space left on device\); choose another place"
        ):
            run_study(study, tmp_path / "out", ExecutionOptions(1))
    assert len(parts_of(tmp_path / "out")) == 3
    assert run_study(study, tmp_path / "out", ExecutionOptions(1), resume=True).designs == 3000


@pytest.fixture
def small_disk(tmp_path):
    """A disk of so few bytes that parts do not fit on it, and how it is made larger."""
    disk = tmp_path / "disk"
    disk.mkdir()

    def mounted(options):
        asked = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(disk)]
        return subprocess.run(asked, capture_output=True, check=False).returncode == 0

    if os.name != "posix" or os.geteuid() != 0 or not mounted("size=100k"):
        # nothing that could be installed grants it; a disk full by a stand-in is tested above
        pytest.xfail("only who may mount has a small disk")
    yield disk, lambda: mounted("remount,size=4m")
    subprocess.run(["umount", "-l", str(disk)], check=True)


def test_what_was_written_before_a_disk_was_full_is_whole(write, tmp_path, small_disk):
    (disk, enlarged), study = small_disk, load_study(write())
    run_study(study, tmp_path / "whole", ExecutionOptions(1))
    whole = parts_of(tmp_path / "whole")
    with pytest.raises(CrankworkError, match=r"cannot be written \(no space left on device\)"):
        run_study(study, disk / "out", ExecutionOptions(1))
    written = parts_of(disk / "out")
    assert 0 < len(written) < len(whole)
    assert written.items() < whole.items()
    # nothing else has room either, and says so
    with pytest.raises(CrankworkError, match="no space left on device"):
        run_study(study, disk / "out", ExecutionOptions(1), resume=True)
    assert enlarged()
    run_study(study, disk / "out", ExecutionOptions(1), resume=True)
    assert parts_of(disk / "out") == whole


def test_what_cannot_be_assembled_is_counted_by_reason(write, tmp_path):
    text = ALONE.replace('"55 mm", to = "65 mm"', '"20 mm", to = "120 mm"').replace(
        '["free_force.1", "counterweight_moment"]', '"joint_force_max.B"'
    )
    found = run_study(load_study(write(text, "four-bar")), tmp_path / "out", ExecutionOptions(1))
    absent = 60 - found.moments["joint_force_max.B"].count
    assert absent > 0
    assert sum(count for count, _ in found.refused.values()) == absent


def test_draws_outside_what_a_field_may_be_are_counted(write, tmp_path):
    found = run_study(
        load_study(write(COMPILED.replace("0.25 sd 0.01", "0.25 sd 0.2"))), tmp_path / "out", ExecutionOptions(1)
    )
    count, reason = found.refused["vary_outside"]
    # below zero is what lies 1.25 deviations below the mean
    assert count / 3000 == pytest.approx(0.10565, abs=2e-3)
    assert reason == "rod.ratio is drawn outside what the field may be"


@pytest.mark.elsewhere
def test_a_tolerance_is_drawn_as_three_deviations_of_a_normal_distribution(write):
    texts = (COMPILED, COMPILED.replace("0.25 sd 0.01", "0.25 ± 0.03"))
    fields = [load_study(write(text)).varied[-1] for text in texts]
    # 0.135 % lie below three deviations and 15.87 % below one
    for field in fields:
        np.testing.assert_allclose(field.of_shares(np.array([0.0013498980316, 0.1586552539])), [0.22, 0.24], rtol=1e-8)


def test_words_have_designs_of_their_own(write, tmp_path):
    text = (
        'machine = "machine.toml"\nvalues = "piston_acceleration_max"\n[designs]\ndrawing = "grid"\nrows = true\n'
        "[vary]\n"
        'method.kinematics = ["exact", "textbook"]\nrod.ratio = [0.2, 0.25, 0.3]\n'
    )
    run_study(load_study(write(text)), tmp_path / "out", ExecutionOptions(1))
    rows = rows_of(tmp_path / "out" / "parts").to_pylist()
    assert [row["method.kinematics"] for row in rows] == ["exact"] * 3 + ["textbook"] * 3
    # r w^2 (1 + lambda) at the top, by either
    largest = [row["piston_acceleration_max"] / (1 + row["rod.ratio"]) for row in rows]
    np.testing.assert_allclose(largest, largest[0], rtol=1e-9)


OF_CYCLE = """\
machine = "machine.toml"
values = "{key}"
[designs]
drawing = "sobol"
count = 8
angles = 360
[vary]
cylinder.compression_ratio = {{ from = 8, to = 9 }}
"""


@pytest.mark.filterwarnings("ignore::crankwork.errors.RenamedKeyWarning")
def test_a_study_says_whether_it_is_compiled_and_why_not(tmp_path, monkeypatch):
    monkeypatch.setattr(compiled, "compiles", lambda: False)
    machine, wrong = Path(__file__).parents[2] / "examples" / "petrol-four.toml", []
    (tmp_path / "machine.toml").write_bytes(machine.read_bytes())
    for key in ("mean_torque", "filling_factor.diagram"):
        (tmp_path / "study.toml").write_text(OF_CYCLE.format(key=key), encoding="utf-8")
        study = load_study(tmp_path / "study.toml")
        found = run_study(study, str(tmp_path / key), ExecutionOptions(1))
        is_compiled, reason = key == "mean_torque", found_data(study, found)["not_compiled"]
        assert (found.one_by_one, key in (reason or "")) == ((0, False) if is_compiled else (8, True))
        for language in LANGUAGES:
            why = translate("study.because_procedure", language, name=key)
            why = translate("study.compiled", language, count="0") if is_compiled else why
            if why not in found_text(study, found, language):
                wrong.append((key, language))
    assert wrong == []
