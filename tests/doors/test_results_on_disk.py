"""What stands on the disk after a run, also after one that was refused, killed or out of space."""

from __future__ import annotations

import errno
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from crankwork import files
from crankwork.errors import CrankworkError

RESULTS = {"tables/kinematics.csv": b"1", "tables/forces.csv": b"2", "machine.svg": b"3"}


def _contents(folder: str | Path) -> dict[str, bytes]:
    folder = Path(folder)
    return {one.relative_to(folder).as_posix(): one.read_bytes() for one in folder.rglob("*") if one.is_file()}


def test_results_go_into_a_new_folder_with_its_parents() -> None:
    files.write_folder("a/b/c", RESULTS)
    assert _contents("a") == {f"b/c/{name}": data for name, data in RESULTS.items()}


@pytest.mark.parametrize("name", ["out", ".", "x" * 250, "d\u00f4i \u0434\u0432\u0430"])
def test_results_go_into_an_empty_folder(name) -> None:
    Path(name).mkdir(exist_ok=True)
    files.write_folder(name, RESULTS)
    assert _contents(name) == RESULTS


def test_results_are_readable_by_others_as_any_new_folder_is(tmp_path) -> None:
    files.write_folder("out", RESULTS)
    (tmp_path / "plain").mkdir()
    assert Path("out").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("command", ["run", "write"])
def test_a_folder_that_holds_results_is_left_alone(crankwork, machine_file, check_mistakes, command) -> None:
    files.write_folder("out", {"mine.txt": b"mine"})
    if command == "run":
        answer = crankwork("run", machine_file(), "-o", "out")
        check_mistakes(answer)
        assert answer.err == "out: holds files already; choose another folder or add --overwrite\n"
    else:
        with pytest.raises(CrankworkError, match="holds files already"):
            files.write_folder("out", RESULTS)
    assert _contents("out") == {"mine.txt": b"mine"}


def test_overwriting_replaces_results_and_keeps_other_files() -> None:
    files.write_folder("out", {"mine.txt": b"mine", "machine.svg": b"old"})
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | {"mine.txt": b"mine"}


def test_a_folder_in_the_place_of_a_result_stops_before_anything_is_replaced() -> None:
    files.write_folder("out", {"machine.svg/mine.txt": b"mine"})
    with pytest.raises(CrankworkError, match=r"machine\.svg: is a folder; move it away"):
        files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == {"machine.svg/mine.txt": b"mine"}


def test_what_a_killed_run_left_behind_does_not_count_as_results() -> None:
    Path("out/.crankwork-abc/results").mkdir(parents=True)
    files.write_folder("out", RESULTS)
    assert _contents("out") == RESULTS


UNWRITABLE = {
    "a file": ("file", "is a file; give a folder for -o"),
    "below a file": ("file/out", "is not a writable folder"),
    "a device": ("/dev/null", "is a file; give a folder for -o"),
    "no real disk": ("/proc/crankwork/out", "cannot be written"),
    "a name too long": ("x" * 300, "cannot be written (file name too long)"),
    "a zero byte": ("a\0b", "cannot be written (not a usable path)"),
    "nothing": ("", "-o: is empty; write the name of a folder"),
}


@pytest.mark.skipif(sys.platform != "linux", reason="the places are those of Linux")
@pytest.mark.parametrize(("folder", "answered"), UNWRITABLE.values(), ids=UNWRITABLE)
def test_a_folder_that_cannot_be_written_is_refused(crankwork, machine_file, check_mistakes, folder, answered) -> None:
    Path("file").write_text("mine", encoding="utf-8")
    answer = crankwork("run", machine_file(), "-o", folder, "--no-figures")
    check_mistakes(answer)
    assert answered in answer.err
    assert Path("file").read_text("utf-8") == "mine"


def test_a_folder_without_permission_is_refused_before_the_computing(
    crankwork, machine_file, check_mistakes, monkeypatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    answer = crankwork("run", machine_file(), "-o", "out")
    check_mistakes(answer)
    assert "is not a writable folder); choose another folder" in answer.err


@pytest.mark.parametrize("existing", [True, False])
@pytest.mark.parametrize("fails_at", [1, 3])
def test_a_full_disk_leaves_nothing_behind(monkeypatch, existing, fails_at) -> None:
    if existing:
        Path("out").mkdir()
    calls = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) == fails_at:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(CrankworkError, match=r"out: cannot be written \(no space left on device\); .* free some space"):
        files.write_folder("out", RESULTS)
    assert list(Path().rglob("*")) == ([Path("out")] if existing else [])


@pytest.fixture
def small_disk(tmp_path):
    """A disk of 64 kB, where the system lets us have one."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True, check=False).returncode:
        yield None
        return
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


def test_a_disk_that_really_is_full_keeps_what_it_had(crankwork, machine_file, check_mistakes, small_disk) -> None:
    if small_disk is None:
        return  # no right to mount; the test above stands in for it
    (small_disk / "mine.txt").write_text("mine", encoding="utf-8")
    answer = crankwork("run", machine_file(), "-o", str(small_disk), "--overwrite", "--step", "0.5", "--no-figures")
    assert answer.code == 2
    assert "no space left on device" in answer.err
    assert _contents(small_disk) == {"mine.txt": b"mine"}


KILLED = """
import os, signal
from crankwork import files
calls = []
def fsync(descriptor):
    calls.append(descriptor)
    if len(calls) == 2:
        os.kill(os.getpid(), signal.SIGKILL)
os.fsync = fsync
files.write_folder("out", {"a.csv": b"1", "b.csv": b"2", "c.csv": b"3"})
"""


@pytest.mark.parametrize("existing", [True, False])
def test_a_run_killed_while_writing_leaves_no_results_and_the_next_one_works(existing) -> None:
    if existing:
        Path("out").mkdir()
    source = str(Path(files.__file__).parents[1])
    killed = subprocess.run([sys.executable, "-c", KILLED], env=os.environ | {"PYTHONPATH": source}, check=False)
    assert killed.returncode == -signal.SIGKILL
    assert all(part.parts[0].startswith(".crankwork-") or part.parts[0] == "out" for part in Path().rglob("*"))
    assert not list(Path("out").glob("[!.]*"))
    files.write_folder("out", RESULTS)
    assert {name: data for name, data in _contents("out").items() if not name.startswith(".")} == RESULTS


def test_a_program_killed_at_any_time_leaves_all_results_or_none(machine_file, spawn) -> None:
    name = machine_file(name="slider-crank")
    reference = spawn("run", name, "-o", "reference", "--no-figures")
    reference.communicate()
    whole = set(_contents("reference"))
    for number, delay in enumerate((0.15, 0.3, 0.45, 0.6)):
        running = spawn("run", name, "-o", f"out{number}", "--no-figures")
        time.sleep(delay)
        running.kill()
        running.communicate()
        assert set(_contents(f"out{number}")) in (set(), whole)


@pytest.mark.parametrize("overwrite", [True, False])
def test_two_runs_at_once_never_mix_their_results(machine_file, spawn, overwrite) -> None:
    name = machine_file(name="slider-crank")
    options = ["-o", "out", "--no-figures", *(["--overwrite"] if overwrite else [])]
    running = [spawn("run", name, "--set", f"crank.speed={speed} rpm", *options) for speed in (1000, 2000, 3000)]
    errors = [one.communicate()[1].decode() for one in running]
    codes = sorted(one.returncode for one in running)
    assert codes == ([0, 0, 0] if overwrite else [0, 2, 2])
    assert all(
        error in ("", "out: holds files already; choose another folder or add --overwrite\n") for error in errors
    )
    assert not list(Path("out").glob(".*"))
    alone = []
    for speed in (1000, 2000, 3000):
        spawn("run", name, "--set", f"crank.speed={speed} rpm", "-o", f"out{speed}", "--no-figures").communicate()
        alone.append(_without_times(f"out{speed}"))
    assert _without_times("out") in alone


def _without_times(folder: str) -> dict[str, bytes]:
    # a workbook holds the time at which it was made
    return {name: data for name, data in _contents(folder).items() if not name.endswith(".xlsx")}


def test_a_file_is_written_whole_or_not_at_all(monkeypatch) -> None:
    files.write_new("a/my.toml", "one")
    assert Path("a/my.toml").read_text("utf-8") == "one"
    with pytest.raises(CrankworkError, match=r"my\.toml: exists already; choose another name or add --overwrite"):
        files.write_new("a/my.toml", "two")
    files.write_new("a/my.toml", "two", overwrite=True)

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(CrankworkError, match="no space left"):
        files.write_new("a/my.toml", "three", overwrite=True)
    assert _contents("a") == {"my.toml": b"two"}


@pytest.mark.parametrize(
    ("path", "answered"),
    [
        (".", "is a folder"),
        ("/dev/null", "is not an ordinary file"),
        ("file/x", "cannot be written"),
        ("a\0b", "usable"),
    ],
)
def test_a_template_is_not_written_where_no_file_can_be(crankwork, check_mistakes, path, answered) -> None:
    Path("file").touch()
    answer = crankwork("new", "engine", "-o", path, "--overwrite")
    check_mistakes(answer)
    assert answered in answer.err
    assert not Path("/dev/null").is_file()
