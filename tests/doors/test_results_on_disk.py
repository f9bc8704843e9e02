"""What stands on the disk after a run, also after one that was refused, killed or out of space."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from crankwork import files
from crankwork.errors import CrankworkError
from crankwork.resources import installable

CHECKOUT = Path(__file__).parents[2]
RESULTS = {"tables/kinematics.csv": b"1", "tables/forces.csv": b"2", "machine.svg": b"3"}


def _contents(folder: str | Path) -> dict[str, bytes]:
    folder = Path(folder)
    found = {one.relative_to(folder).as_posix(): one.read_bytes() for one in folder.rglob("*") if one.is_file()}
    return {name: data for name, data in found.items() if Path(name).name != files.MANIFEST}


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
    files.write_folder("out", {"machine.svg": b"old"})
    Path("out/mine.txt").write_bytes(b"mine")
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | {"mine.txt": b"mine"}


OTHERS = {"tables/mine.csv": b"mine", "figures/mine.svg": b"mine", "tables.xlsx": b"mine"}


def _put(contents: dict[str, bytes], folder: str = "out") -> None:
    for name, data in contents.items():
        Path(folder, name).parent.mkdir(parents=True, exist_ok=True)
        Path(folder, name).write_bytes(data)


def test_overwriting_deletes_what_an_earlier_run_wrote_and_nothing_else() -> None:
    files.write_folder("out", RESULTS | {"tables/gone.csv": b"4", "tables/edited.csv": b"5", "figures/gone.svg": b"6"})
    _put(OTHERS | {"tables/edited.csv": b"mine"})
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | OTHERS | {"tables/edited.csv": b"mine"}


def test_overwriting_deletes_nothing_where_no_manifest_says_who_wrote_it() -> None:
    _put(OTHERS)
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | OTHERS


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_a_folder_that_is_a_link_is_written_as_what_it_leads_to() -> None:
    _put(OTHERS, "elsewhere")
    Path("out").symlink_to("elsewhere")
    files.write_folder("out", RESULTS | {"gone.svg": b"6"}, overwrite=True)
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("elsewhere") == RESULTS | OTHERS
    assert Path("out").is_symlink()


@pytest.mark.parametrize("name", ["../mine.txt", "/mine.txt", "a/../../mine.txt", ".", "tables"])
@pytest.mark.parametrize("data", [b"mine", b"{}", b""])
def test_a_manifest_leads_to_no_file_outside_its_folder(tmp_path, name, data) -> None:
    files.write_folder("out", RESULTS)
    Path("mine.txt").write_bytes(data)
    digest = hashlib.sha256(data).hexdigest()
    named = str(tmp_path / "mine.txt") if name.startswith("/") else name
    Path("out", files.MANIFEST).write_text(json.dumps({"files": {named: [digest]}}), encoding="utf-8")
    for one in RESULTS:
        Path("out", one).unlink()
    files.write_folder("out", RESULTS, overwrite=True)
    assert Path("mine.txt").read_bytes() == data
    assert _contents("out") == RESULTS


@pytest.mark.parametrize("is_ours", [True, False])
def test_a_file_of_the_user_with_the_name_of_a_result_is_not_replaced(is_ours) -> None:
    """Put there by the user, or changed since it was written."""
    name = next(iter(RESULTS))
    if is_ours:
        files.write_folder("out", RESULTS)
    _put({name: b"mine"})
    before = _contents("out")
    with pytest.raises(CrankworkError, match=r"\.csv: was not written by crankwork, or was changed since;"):
        files.write_folder("out", {**RESULTS, name: b"new"}, overwrite=True)
    assert _contents("out") == before
    Path("out", name).unlink()
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS


@pytest.mark.parametrize("text", ["", "{", "[]", '{"files": []}', '{"files": {"a": 1}}', "\ud800", "[" * 100_000])
def test_a_manifest_that_cannot_be_read_names_nothing(text) -> None:
    _put(OTHERS | {files.MANIFEST: text.encode("utf-8", "surrogatepass")})
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | OTHERS


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_nothing_is_deleted_or_replaced_through_a_link() -> None:
    files.write_folder("out", RESULTS | {"figures/gone.svg": b"6"})
    Path("elsewhere").mkdir()
    for kept in ("tables/kinematics.csv", "figures/gone.svg"):
        Path("out", kept).replace(Path("elsewhere", Path(kept).name))
    shutil.rmtree("out/figures")
    Path("out/figures").symlink_to(Path("elsewhere").absolute())
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("elsewhere") == {"kinematics.csv": b"1", "gone.svg": b"6"}
    shutil.rmtree("out/tables")
    Path("out/tables").symlink_to(Path("elsewhere").absolute())
    with pytest.raises(CrankworkError, match="tables: is a link to another folder; move it away or choose another"):
        files.write_folder("out", RESULTS | {"machine.svg": b"new"}, overwrite=True)
    assert _contents("elsewhere") == {"kinematics.csv": b"1", "gone.svg": b"6"}
    assert Path("out/machine.svg").read_bytes() == b"3"


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_a_link_in_the_place_of_a_file_is_replaced_and_what_it_leads_to_stays() -> None:
    files.write_folder("out", RESULTS | {"gone.svg": b"6"})
    Path("mine.svg").write_bytes(b"6")
    for name in ("machine.svg", "gone.svg"):
        Path("out", name).unlink()
        Path("out", name).symlink_to(Path("mine.svg").absolute())
    files.write_folder("out", RESULTS, overwrite=True)
    assert Path("mine.svg").read_bytes() == b"6"
    assert not Path("out/machine.svg").is_symlink()
    assert Path("out/gone.svg").is_symlink()


MEASURED = """
crank.radius = "40 mm"
crank.speed = "3000 rpm"
rod.ratio = 0.3
cylinder = { bore = "80 mm", compression_ratio = 9 }
gas = { cycle = "720 deg", measured = { file = "out/tables/NAME.csv", pressure_unit = "bar" } }
"""


@pytest.mark.parametrize("name", ["forces", "measured"])
def test_a_run_keeps_the_pressure_it_reads_wherever_it_lies(crankwork, machine_file, name) -> None:
    rows = "".join(f"{angle},{1 + 30 * max(0, 1 - abs(angle - 370) / 90)}\n" for angle in range(0, 720, 5))
    _put({f"tables/{name}.csv": f"angle,pressure\n{rows}".encode()})
    before = _contents("out")
    file = machine_file(text=MEASURED.replace("NAME", name))
    for _ in range(2):
        answer = crankwork("run", file, "-o", "out", "--overwrite", "--no-figures")
        refused = "out/tables/forces.csv: is what this run reads; move it away or choose another name or folder\n"
        assert (answer.code, answer.err) == ((2, refused) if name == "forces" else (0, ""))
        assert before.items() <= _contents("out").items()


@pytest.mark.skipif(sys.platform == "win32", reason="there is no umask")
@pytest.mark.parametrize("mask", [0o077, 0o022, 0o002])
def test_files_and_folders_are_as_open_as_the_mask_lets_them_be(mask) -> None:
    before = os.umask(mask)
    try:
        files.write_folder("new", RESULTS)
        _put({"mine.txt": b"mine"})
        files.write_folder("out", RESULTS, overwrite=True)
        files.write_new("a/my.toml", "one")
        files.write_files({"note.html": b"one"})
    finally:
        os.umask(before)
    folders = [Path(name) for name in ("new", "out", "a")]
    written = [Path("note.html"), *folders, *(one for folder in folders for one in folder.rglob("*"))]
    modes = {one: one.stat().st_mode & 0o777 for one in written}
    assert modes == {one: (0o777 if one.is_dir() else 0o666) & ~mask for one in written}


def test_a_base_installation_writes_what_it_can(crankwork, machine_file, monkeypatch) -> None:
    file = machine_file()
    assert crankwork("run", file, "-o", "whole").code == 0
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    answer = crankwork("run", file, "-o", "out")
    sentence = f"writing tables.xlsx needs an optional part; install it with: pip install -e '{CHECKOUT}[tables]'"
    assert (answer.code, answer.err) == (0, f"note: {sentence}\n")
    assert set(_contents("out")) == set(_contents("whole")) - {"tables.xlsx"}


INSTALLED = {
    "from an index": (None, "'crankwork[data]'"),
    "from a folder": ('{"url": "file:///home/me/a b", "dir_info": {}}', "'crankwork[data] @ file:///home/me/a b'"),
    "from a repository": (
        '{"url": "https://x.org/c.git", "vcs_info": {"vcs": "git", "commit_id": "ab12"}}',
        "'crankwork[data] @ git+https://x.org/c.git@ab12'",
    ),
}


@pytest.mark.parametrize(("origin", "expected"), INSTALLED.values(), ids=INSTALLED)
def test_what_is_missing_is_installed_from_where_the_rest_came_from(monkeypatch, tmp_path, origin, expected) -> None:
    monkeypatch.setattr("crankwork.resources.__file__", str(tmp_path / "lib" / "crankwork" / "resources.py"))
    monkeypatch.setattr("importlib.metadata.distribution", lambda _: SimpleNamespace(read_text=lambda _: origin))
    assert installable("data") == expected


def test_a_folder_in_the_place_of_a_result_stops_before_anything_is_replaced() -> None:
    files.write_folder("out", {"machine.svg/mine.txt": b"mine"})
    with pytest.raises(CrankworkError, match=r"machine\.svg: is a folder; move it away"):
        files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == {"machine.svg/mine.txt": b"mine"}


def test_what_a_killed_run_left_behind_does_not_count_as_results() -> None:
    Path("out/.crankwork-abc01def/results").mkdir(parents=True)
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


def test_a_workbook_that_a_program_has_open_is_told_as_that(crankwork, machine_file, check_mistakes, monkeypatch):
    assert crankwork("run", machine_file(), "-o", "out", "--no-figures").code == 0
    before, replace = _contents("out"), Path.replace

    def held(self: Path, target: Path) -> Path:
        if target.name == "tables.xlsx":
            raise PermissionError(errno.EACCES, "Permission denied", str(self), None, str(target))
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", held)
    answer = crankwork("run", "my.toml", "-o", "out", "--no-figures", "--overwrite")
    check_mistakes(answer)
    assert answer.err == (
        "out/tables.xlsx: cannot be written (permission denied); close the program that has it open, "
        "or choose another place\n"
    )
    assert _contents("out")["tables.xlsx"] == before["tables.xlsx"]


def test_results_are_written_where_the_system_has_no_locks(monkeypatch) -> None:
    monkeypatch.setattr(files, "fcntl", None)
    for _ in range(2):
        files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS
    assert not list(Path().glob(".crankwork-*"))


def test_a_disk_that_is_full_of_the_rows_of_a_workbook_is_told(crankwork, machine_file, check_mistakes, monkeypatch):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("crankwork.report.workbook._MANY", 100)
    monkeypatch.setattr("xlsxwriter.worksheet.Worksheet._write_single_row", full)
    answer = crankwork("run", machine_file(), "-o", "out", "--no-figures")
    check_mistakes(answer)
    assert "cannot be written (no space left on device); choose another place or free some space" in answer.err
    assert not Path("out").exists()


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
    assert _contents("out") == RESULTS


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


REPLACING = """
from crankwork import files
old = {f"tables/{number}.csv": b"old" for number in range(40)}
new = {f"tables/{number}.csv": b"new" for number in range(20, 60)}
print("started", flush=True)
while True:
    files.write_folder("out", old, overwrite=True)
    files.write_folder("out", new, overwrite=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="litter of the dead is known by locks")
def test_a_run_killed_while_replacing_leaves_one_result_or_says_that_there_are_two() -> None:
    source = str(Path(files.__file__).parents[1])
    old = {f"tables/{number}.csv": b"old" for number in range(40)}
    new = {f"tables/{number}.csv": b"new" for number in range(20, 60)}
    delays = random.Random(1)  # noqa: S311 - no secret
    for _ in range(12):
        files.write_folder("out", old, overwrite=True)
        command = [sys.executable, "-c", REPLACING]
        environment = os.environ | {"PYTHONPATH": source}
        with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) as running:
            assert running.stdout is not None
            running.stdout.readline()
            time.sleep(delays.uniform(0, 0.4))
            running.kill()
        found = _contents("out")
        results = {name: data for name, data in found.items() if not name.startswith(".")}
        assert files.MARK in results or results in (old, new)
        files.write_folder("out", RESULTS, overwrite=True)
        assert _contents("out") == RESULTS


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such signals")
@pytest.mark.parametrize("at", range(1, 8))
def test_a_run_killed_between_two_files_says_so(at) -> None:
    files.write_folder("out", {"a.csv": b"old", "b.csv": b"old", "c.csv": b"old", "d.csv": b"old"})
    source = str(Path(files.__file__).parents[1])
    killed = subprocess.run(
        [sys.executable, "-c", KILLED_REPLACING, str(at)], env=os.environ | {"PYTHONPATH": source}, check=False
    )
    assert killed.returncode == -signal.SIGKILL
    found = {name: data for name, data in _contents("out").items() if not name.startswith(".")}
    marked = found.pop(files.MARK, None)
    # manifest and mark come first, then three files, then the manifest of the new results
    assert (marked is not None) is (2 < at < 7)
    assert (set(found.values()) == {b"old"}) is (at < 4)
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS


KILLED_REPLACING = """
import os, signal, sys
from pathlib import Path
from crankwork import files
calls = []
replace = Path.replace
def counted(path, target):
    calls.append(path)
    if len(calls) == int(sys.argv[1]):
        os.kill(os.getpid(), signal.SIGKILL)
    replace(path, target)
Path.replace = counted
files.write_folder("out", {"a.csv": b"new", "b.csv": b"new", "c.csv": b"new"}, overwrite=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_lives_is_not_swept_and_what_is_not_ours_neither() -> None:
    for name in (".crankwork-notes", ".crankwork-abc01def.txt"):
        Path("out", name).mkdir(parents=True)
    Path("elsewhere/results").mkdir(parents=True)
    if sys.platform != "win32":
        Path("out/.crankwork-abc01xyz").symlink_to(Path("elsewhere").absolute())
    with files._staging(Path("out")) as alive:
        files.write_folder("out", RESULTS, overwrite=True)
        assert alive.is_dir()
    assert Path("elsewhere/results").is_dir()
    assert Path("out/.crankwork-notes").is_dir()
    assert not alive.exists()


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
    assert [one.name for one in Path("out").glob(".*")] == [files.MANIFEST]
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
