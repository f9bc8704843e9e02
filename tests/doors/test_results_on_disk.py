"""What stands on the disk after a run, also after one that was refused, killed or out of space."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from crankwork import files
from crankwork.errors import CrankworkError
from crankwork.resources import installable

CHECKOUT = Path(__file__).parents[2]
ENVIRONMENT = os.environ | {"PYTHONPATH": str(Path(files.__file__).parents[1])}
RESULTS = {"tables/kinematics.csv": b"1", "tables/forces.csv": b"2", "machine.svg": b"3"}
OTHERS = {"tables/mine.csv": b"mine", "figures/mine.svg": b"mine", "tables.xlsx": b"mine"}
UNIX = pytest.mark.skipif(sys.platform == "win32", reason="links, masks and signals are those of Unix")


def _contents(folder: str | Path) -> dict[str, bytes]:
    folder = Path(folder)
    found = {one.relative_to(folder).as_posix(): one.read_bytes() for one in folder.rglob("*") if one.is_file()}
    return {name: data for name, data in found.items() if Path(name).name != files.MANIFEST}


def _put(contents: dict[str, bytes], folder: str = "out") -> None:
    for name, data in contents.items():
        Path(folder, name).parent.mkdir(parents=True, exist_ok=True)
        Path(folder, name).write_bytes(data)


def _fill_disk(monkeypatch, at: int = 1) -> None:
    """Let no more be written from one file on."""
    calls = []

    def full(descriptor: int) -> None:
        calls.append(descriptor)
        if len(calls) >= at:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)


def test_results_go_into_a_new_folder_with_its_parents_or_into_an_empty_one(monkeypatch) -> None:
    files.write_folder("a/b/c", RESULTS)
    assert _contents("a") == {f"b/c/{name}": data for name, data in RESULTS.items()}
    shutil.rmtree("a")
    for name in (".", "out", "x" * 250, "d\u00f4i \u0434\u0432\u0430"):
        Path(name).mkdir(exist_ok=True)
        files.write_folder(name, RESULTS, overwrite=name == ".")
        assert RESULTS.items() <= _contents(name).items(), name
    assert len(_contents(".")) == 4 * len(RESULTS)
    # also where the system has no locks
    monkeypatch.setattr(files, "fcntl", None)
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS
    assert not list(Path().rglob(".crankwork-*"))


def test_a_folder_that_holds_results_is_left_alone(machine_file, check_refusals) -> None:
    files.write_folder("out", {"mine.txt": b"mine"})
    name = machine_file()
    told = "out: holds files already; choose another folder or add --overwrite"
    check_refusals([(("run", name, "-o", "out"), told)])
    with pytest.raises(CrankworkError, match=f"^{told}$"):
        files.write_folder("out", RESULTS)
    assert _contents("out") == {"mine.txt": b"mine"}


def test_overwriting_deletes_what_an_earlier_run_wrote_and_nothing_else() -> None:
    _put(OTHERS)
    # where no manifest says who wrote it, nothing is deleted
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS | OTHERS
    more = {"tables/gone.csv": b"4", "tables/edited.csv": b"5", "figures/gone.svg": b"6"}
    files.write_folder("out", RESULTS | more | {"machine.svg": b"old"}, overwrite=True)
    _put({"tables/edited.csv": b"mine"})
    files.write_folder("out", RESULTS, overwrite=True)
    before = RESULTS | OTHERS | {"tables/edited.csv": b"mine"}
    assert _contents("out") == before
    # a folder in the place of a result stops before anything is replaced
    with pytest.raises(CrankworkError, match=r"tables: is a folder; move it away"):
        files.write_folder("out", {"machine.svg": b"new", "tables": b"1"}, overwrite=True)
    assert _contents("out") == before


def test_a_manifest_names_nothing_outside_its_folder_and_nothing_where_it_cannot_be_read(tmp_path) -> None:
    mine = b"{}"
    names = ("../mine.txt", str(tmp_path / "mine.txt"), "a/../../mine.txt", ".", "tables")
    leading = [json.dumps({"files": {name: [hashlib.sha256(mine).hexdigest()]}}) for name in names]
    for text in (*leading, "", "{", "[]", '{"files": []}', '{"files": {"a": 1}}', "\ud800", "[" * 100_000):
        Path("mine.txt").write_bytes(mine)
        _put(OTHERS | {files.MANIFEST: text.encode("utf-8", "surrogatepass")})
        files.write_folder("out", RESULTS, overwrite=True)
        assert (Path("mine.txt").read_bytes(), _contents("out")) == (mine, RESULTS | OTHERS), text[:99]
        shutil.rmtree("out")


def test_a_file_of_the_user_with_the_name_of_a_result_is_not_replaced() -> None:
    name = next(iter(RESULTS))
    # put there by the user, and changed since it was written
    for earlier in ({name: b"mine"}, RESULTS | {name: b"mine"}):
        _put({name: b"mine"})
        with pytest.raises(CrankworkError, match=r"\.csv: was not written by crankwork, or was changed since;"):
            files.write_folder("out", {**RESULTS, name: b"new"}, overwrite=True)
        assert _contents("out") == earlier
        Path("out", name).unlink()
        files.write_folder("out", RESULTS, overwrite=True)
        assert _contents("out") == RESULTS


@UNIX
def test_nothing_is_deleted_or_replaced_through_a_link() -> None:
    files.write_folder("out", RESULTS | {"figures/gone.svg": b"6", "gone.svg": b"6"})
    mine = {"kinematics.csv": b"1", "gone.svg": b"6"}
    _put(mine, "elsewhere")
    for name in ("figures", "gone.svg", "machine.svg"):
        shutil.move(f"out/{name}", f"moved-{name}")
    Path("out/figures").symlink_to(Path("elsewhere").absolute())
    for name in ("machine.svg", "gone.svg"):
        Path("out", name).symlink_to(Path("elsewhere/gone.svg").absolute())
    files.write_folder("out", RESULTS, overwrite=True)
    # a link in the place of a result gives way to it
    assert [Path("out", name).is_symlink() for name in ("machine.svg", "gone.svg", "figures")] == [False, True, True]
    shutil.rmtree("out/tables")
    Path("out/tables").symlink_to(Path("elsewhere").absolute())
    with pytest.raises(CrankworkError, match="tables: is a link to another folder; move it away or choose another"):
        files.write_folder("out", RESULTS | {"machine.svg": b"new"}, overwrite=True)
    assert _contents("elsewhere") == mine
    assert Path("out/machine.svg").read_bytes() == b"3"
    # but the folder itself may be one
    Path("whole").symlink_to("elsewhere")
    files.write_folder("whole", RESULTS, overwrite=True)
    files.write_folder("whole", {"machine.svg": b"new"}, overwrite=True)
    assert _contents("elsewhere") == mine | {"machine.svg": b"new"}
    assert Path("whole").is_symlink()


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
        answer = crankwork("run", file, "-o", "out", "--overwrite", "--no-figures", "--step", "30")
        refused = "out/tables/forces.csv: is what this run reads; move it away or choose another name or folder\n"
        assert (answer.code, answer.err) == ((2, refused) if name == "forces" else (0, ""))
        assert before.items() <= _contents("out").items()


@UNIX
@pytest.mark.parametrize("mask", [0o077, 0o002])
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
    modes = {one: one.stat().st_mode & 0o777 for one in Path().rglob("*")}
    assert modes == {one: (0o777 if one.is_dir() else 0o666) & ~mask for one in modes}


def test_a_base_installation_writes_what_it_can(crankwork, machine_file, monkeypatch) -> None:
    file = machine_file()
    assert crankwork("run", file, "-o", "whole", "--no-figures").code == 0
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    answer = crankwork("run", file, "-o", "out", "--no-figures")
    sentence = f"writing tables.xlsx needs an optional part; install it with: pip install -e '{CHECKOUT}[tables]'"
    assert (answer.code, answer.err) == (0, f"note: {sentence}\n")
    assert set(_contents("out")) == set(_contents("whole")) - {"tables.xlsx"}


def test_what_is_missing_is_installed_from_where_the_rest_came_from(monkeypatch, tmp_path) -> None:
    monkeypatch.setattr("crankwork.resources.__file__", str(tmp_path / "lib" / "crankwork" / "resources.py"))
    of_git = '{"url": "https://x.org/c.git", "vcs_info": {"vcs": "git", "commit_id": "ab12"}}'
    for origin, expected in {
        None: "'crankwork[data]'",
        '{"url": "file:///home/me/a b", "dir_info": {}}': "'crankwork[data] @ file:///home/me/a b'",
        of_git: "'crankwork[data] @ git+https://x.org/c.git@ab12'",
    }.items():
        one = SimpleNamespace(read_text=lambda _, origin=origin: origin)
        monkeypatch.setattr("importlib.metadata.distribution", lambda _, one=one: one)
        assert installable("data") == expected


UNWRITABLE = {
    "file": "is a file; give a folder for -o",
    "file/out": "is not a writable folder",
    "/dev/null": "is a file; give a folder for -o",
    "/proc/crankwork/out": "cannot be written",
    "x" * 300: "cannot be written (file name too long)",
    "a\0b": "cannot be written (not a usable path)",
    "": "-o: is empty; write the name of a folder",
}
NO_FILES = {
    ".": "is a folder",
    "/dev/null": "is not an ordinary file",
    "file/x": "cannot be written",
    "a\0b": "usable",
}


@pytest.mark.skipif(sys.platform != "linux", reason="the places are those of Linux")
def test_a_place_that_cannot_be_written_is_refused(machine_file, check_refusals, monkeypatch) -> None:
    Path("file").write_text("mine", encoding="utf-8")
    name = machine_file()
    check_refusals((("run", name, "-o", folder, "--no-figures"), told) for folder, told in UNWRITABLE.items())
    check_refusals((("new", "engine", "-o", path, "--overwrite"), told) for path, told in NO_FILES.items())
    assert not Path("/dev/null").is_file()
    # before anything is computed
    monkeypatch.setattr(os, "access", lambda *_: False)
    check_refusals([(("run", "no.toml", "-o", "out"), "is not a writable folder); choose another folder")])


@pytest.mark.parametrize("fails_at", [1, 3])
def test_a_full_disk_leaves_nothing_behind(monkeypatch, fails_at) -> None:
    _put({"mine.txt": b"mine"}, "old")
    Path("empty").mkdir()
    for folder in ("new", "empty", "old"):
        _fill_disk(monkeypatch, fails_at)
        told = rf"{folder}: cannot be written \(no space left on device\); .* free some space"
        with pytest.raises(CrankworkError, match=told):
            files.write_folder(folder, RESULTS, overwrite=folder == "old")
    assert sorted(Path().rglob("*")) == [Path("empty"), Path("old"), Path("old/mine.txt")]


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


def test_a_disk_that_is_full_of_the_rows_of_a_workbook_is_told(crankwork, machine_file, check_mistakes, monkeypatch):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("crankwork.report.results_folder._MANY", 100)
    monkeypatch.setattr("xlsxwriter.worksheet.Worksheet._write_single_row", full)
    answer = crankwork("run", machine_file(), "-o", "out", "--no-figures")
    check_mistakes(answer)
    assert "cannot be written (no space left on device); choose another place or free some space" in answer.err
    assert not Path("out").exists()


# writes new results, and is killed before one of the steps that a folder goes through
KILLED = """
import os, signal, sys
from pathlib import Path
from crankwork import files
calls = []
def counted(step):
    def called(*arguments):
        calls.append(step)
        if len(calls) == int(sys.argv[2]):
            os.kill(os.getpid(), signal.SIGKILL)
        return step(*arguments)
    return called
owner = {"fsync": os, "replace": Path, "unlink": Path}
for name in sys.argv[1].split():
    setattr(owner[name], name, counted(getattr(owner[name], name)))
files.write_folder("out", {"a.csv": b"new", "b.csv": b"new", "c.csv": b"new"}, overwrite=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


def _killed(steps: str, at: int) -> dict[str, bytes]:
    """Return what results are there after a run was killed, and that the next one works."""
    killed = subprocess.run([sys.executable, "-c", KILLED, steps, str(at)], env=ENVIRONMENT, check=False)
    assert killed.returncode == -signal.SIGKILL
    assert all(part.parts[0].startswith(".crankwork-") or part.parts[0] == "out" for part in Path().rglob("*"))
    found = {name: data for name, data in _contents("out").items() if not name.startswith(".")}
    files.write_folder("out", RESULTS, overwrite=True)
    assert _contents("out") == RESULTS
    assert not list(Path().rglob(".crankwork-*"))
    shutil.rmtree("out")
    return found


@UNIX
def test_a_run_killed_while_writing_leaves_no_results_and_the_next_one_works() -> None:
    assert [_killed("fsync", at) for at in (1, 2, 4)] == [{}, {}, {}]
    Path("out").mkdir()
    assert _killed("fsync", 2) == {}


@UNIX
def test_a_run_killed_while_replacing_leaves_one_result_or_says_that_there_are_two() -> None:
    old = dict.fromkeys(("a.csv", "b.csv", "c.csv", "d.csv"), b"old")
    found = []
    for at in range(1, 10):
        files.write_folder("out", old)
        found.append(_killed("replace unlink", at))
    # manifest and mark come first, then three files, what is gone, the manifest of the new results, and the mark
    assert [files.MARK in one for one in found] == [2 < at < 9 for at in range(1, 10)]
    found = [{name: data for name, data in one.items() if name != files.MARK} for one in found]
    new = dict.fromkeys(("a.csv", "b.csv", "c.csv"), b"new")
    assert (found[:3], found[6:]) == ([old] * 3, [new] * 3)
    assert [list(one.values()).count(b"new") for one in found[3:6]] == [1, 2, 3]


def test_what_lives_is_not_swept_and_what_is_not_ours_neither() -> None:
    for name in (".crankwork-notes", ".crankwork-abc01def.txt", ".crankwork-abc01def/results"):
        Path("out", name).mkdir(parents=True)
    Path("elsewhere/results").mkdir(parents=True)
    if sys.platform != "win32":
        Path("out/.crankwork-abc01xyz").symlink_to(Path("elsewhere").absolute())
    # what a killed run left behind does not count as results
    files.write_folder("out", RESULTS)
    with files._staging(Path("out")) as alive:
        files.write_folder("out", RESULTS, overwrite=True)
        assert alive.is_dir()
    assert _contents("out") == RESULTS
    assert Path("elsewhere/results").is_dir()
    assert Path("out/.crankwork-notes").is_dir()
    assert Path("out/.crankwork-abc01def.txt").is_dir()
    assert not Path("out/.crankwork-abc01def").exists()
    assert not alive.exists()


@pytest.mark.slow
@pytest.mark.parametrize("overwrite", [True, False])
def test_two_runs_at_once_never_mix_their_results(crankwork, machine_file, overwrite) -> None:
    name, speeds = machine_file(name="slider-crank"), (1000, 2000, 3000)
    runs = [("run", name, "--set", f"crank.speed={speed} rpm", "--no-figures", "-o") for speed in speeds]
    options = ["out", *(["--overwrite"] if overwrite else [])]
    words = [[sys.executable, "-m", "crankwork", *one, *options] for one in runs]
    running = [subprocess.Popen(one, env=ENVIRONMENT, stderr=subprocess.PIPE) for one in words]
    errors = [one.communicate()[1].decode() for one in running]
    refused = "out: holds files already; choose another folder or add --overwrite\n"
    wanted = [(0, "")] * 3 if overwrite else [(0, ""), (2, refused), (2, refused)]
    assert sorted(zip((one.returncode for one in running), errors, strict=True)) == wanted
    assert [one.name for one in Path("out").glob(".*")] == [files.MANIFEST]
    alone = []
    for one, speed in zip(runs, speeds, strict=True):
        crankwork(*one, f"out{speed}")
        alone.append(_without_times(f"out{speed}"))
    assert _without_times("out") in alone


def _without_times(folder: str) -> dict[str, bytes]:
    # a workbook holds the time at which it was made
    return {name: data for name, data in _contents(folder).items() if not name.endswith(".xlsx")}


def test_files_are_written_whole_or_not_at_all(monkeypatch) -> None:
    files.write_new("a/my.toml", "one")
    assert Path("a/my.toml").read_text("utf-8") == "one"
    with pytest.raises(CrankworkError, match=r"my\.toml: exists already; choose another name or add --overwrite"):
        files.write_new("a/my.toml", "two")
    files.write_new("a/my.toml", "two", overwrite=True)
    files.write_files({"a/a": b"1", "a/b": b"1"})
    _fill_disk(monkeypatch)
    with pytest.raises(CrankworkError, match="no space left"):
        files.write_new("a/my.toml", "three", overwrite=True)
    # of several files all are replaced or none
    _fill_disk(monkeypatch, at=2)
    with pytest.raises(CrankworkError, match=r"^a/b: cannot be written"):
        files.write_files({"a/a": b"2", "a/b": b"2"}, overwrite=True)
    assert _contents("a") == {"my.toml": b"two", "a": b"1", "b": b"1"}
