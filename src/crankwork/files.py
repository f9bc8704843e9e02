"""The only place that opens files. Reading is bounded; writing leaves either the whole file or nothing."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
import re
import shutil
import stat
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TextIO

from crankwork.errors import CrankworkError

try:
    import fcntl
except ImportError:  # pragma: no cover - Windows has no such locks
    fcntl = None  # type: ignore[assignment]

MAX_MACHINE_FILE = 256 * 1024
MAX_LINE = 4096
MAX_DATA_FILE = 64 * 1024 * 1024
_STAGING = ".crankwork-"
_STAGED = re.compile(re.escape(_STAGING) + r"[a-z0-9_]{8}")
# Names the files that runs wrote into a folder, with their hashes: nothing else is ever deleted there.
MANIFEST = ".crankwork.json"
# Stands in a folder while its results are replaced, and stays where that was cut short.
MARK = "UNFINISHED-crankwork.txt"
_MARKED = """\
A run of crankwork was replacing the results in this folder and was stopped before it was done:
old and new results stand side by side. Run it again with --overwrite.
"""
# What was read in this process, which no result may replace.
_inputs: set[Path] = set()


def read_resource(*names: str) -> str:
    """Return the text of a file of the package."""
    return Path(__file__).parent.joinpath(*names).read_text(encoding="utf-8")


def resource_names(folder: str, suffix: str) -> list[str]:
    """Return the sorted stems of the package files in a folder that end with `suffix`."""
    entries = Path(__file__).parent.joinpath(folder).iterdir()
    return sorted(entry.name.removesuffix(suffix) for entry in entries if entry.name.endswith(suffix))


def read_text(path: str | Path, *, limit: int = MAX_MACHINE_FILE, advice: str = "check the path") -> str:
    """Return the text of a file, UTF-8 with or without a byte order mark.

    `advice`: what to do if there is no such file.
    """
    path = Path(path)
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            raise CrankworkError(f"{path}: is a folder; give a file")
        # a pipe or a device may never end, and opening it may never return
        if not stat.S_ISREG(mode):
            raise CrankworkError(f"{path}: is not an ordinary file; save its content to a file and give that")
        with path.open("rb") as stream:
            data = stream.read(limit + 1)
        _inputs.add(path.resolve())
    except FileNotFoundError:
        raise CrankworkError(f"{path}: no such file; {advice}") from None
    except (OSError, ValueError) as error:
        raise CrankworkError(f"{path}: cannot be read ({_reason(error)}); {advice}") from None
    if len(data) > limit:
        size = f"{limit >> 20} MB" if limit >= 1 << 20 else f"{limit >> 10} kB"
        raise CrankworkError(f"{path}: larger than {size}; keep what is needed, or give another file")
    return _decoded(path, data)


def _decoded(path: Path, data: bytes) -> str:
    """Return bytes as text, or raise with the line where they are none."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise CrankworkError(f"{path}:1: is UTF-16 text; save it as UTF-8")
    if b"\0" in data:
        raise CrankworkError(f"{path}:{_line(data, data.index(0))}: is a binary file; give a text file")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CrankworkError(
            f"{path}:{_line(data, error.start)}: is not UTF-8 text; give a text file, saved as UTF-8"
        ) from None


def _line(data: bytes, position: int) -> int:
    return data.count(b"\n", 0, position) + 1


def write_new(path: str | Path, text: str, *, overwrite: bool = False) -> None:
    """Write a text file, whole or not at all."""
    _check_new(Path(path), overwrite=overwrite)
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise _unwritable(Path(path), error) from None
    write_files({path: text.encode("utf-8")}, overwrite=overwrite)


def check_files(*paths: str | Path, overwrite: bool = False) -> None:
    """Raise unless files may be written, before anything is computed for them."""
    for path in map(Path, paths):
        _check_new(path, overwrite=overwrite)
        try:
            if not path.parent.is_dir():
                raise CrankworkError(f"{path}: there is no folder {path.parent}; make it or choose another place")
            if not os.access(path.parent, os.W_OK | os.X_OK):
                raise CrankworkError(
                    f"{path}: cannot be written ({path.parent} is not a writable folder); choose another place"
                )
        except (OSError, ValueError) as error:
            raise _unwritable(path, error) from None


def _check_new(path: Path, *, overwrite: bool) -> None:
    """Raise if something stands where a file is to go."""
    try:
        if path.is_dir():
            raise CrankworkError(f"{path}: is a folder; give a file name")
        if path.exists() and not path.is_file():
            raise CrankworkError(f"{path}: is not an ordinary file; choose another name")
        if path.exists() and not overwrite:
            raise CrankworkError(f"{path}: exists already; choose another name or add --overwrite")
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None


def write_files(contents: Mapping[str | Path, bytes], *, overwrite: bool = False) -> None:
    """Write files into folders that are there, so that a failure leaves what was there before."""
    check_files(*contents, overwrite=overwrite)
    path = Path(next(iter(contents), ""))
    try:
        with contextlib.ExitStack() as stack:
            staging = {
                folder: stack.enter_context(_staging(folder)) for folder in {Path(one).parent for one in contents}
            }
            for path, data in ((Path(name), data) for name, data in contents.items()):
                _write_through(staging[path.parent] / path.name, data)
            for path in map(Path, contents):
                (staging[path.parent] / path.name).replace(path)
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None


def write_folder(folder: str | Path, contents: dict[str, bytes], *, overwrite: bool = False) -> None:
    """Write files into a folder so that a failure leaves what was there before.

    Killed at any moment, the folder holds the old results, the new ones, or the file `MARK`, which says that both are
    there. `overwrite`: write into a folder that holds something already. What an earlier run wrote there, by the
    folder's manifest, and is not written anew is deleted if it is still as it was written; all other files stay.
    """
    folder = Path(folder)
    check_folder(folder, overwrite=overwrite)
    try:
        # next to the folder, or in it where it exists, because that may be another disk
        nearby = folder if folder.is_dir() else folder.parent
        nearby.mkdir(parents=True, exist_ok=True)
        with _staging(nearby) as staging:
            staged = staging / "results"
            for name, data in contents.items():
                _write_through(staged / name, data)
            _write_through(staged / MANIFEST, _manifest({name: [_hash(data)] for name, data in contents.items()}))
            _move(staged, folder, contents, overwrite=overwrite)
    except (OSError, ValueError) as error:
        raise _unwritable(folder, error) from None


def send_nowhere(stream: TextIO) -> None:
    """Let what is still buffered in a stream go nowhere, where nobody reads it any more.

    `stream`: the output; the interpreter would try to write it once more when it ends, and complain.
    """
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)


def check_folder(folder: str | Path, *, overwrite: bool = False) -> None:
    """Raise unless results may be written into a folder."""
    folder = Path(folder)
    try:
        if folder.exists() and not folder.is_dir():
            raise CrankworkError(f"{folder}: is a file; give a folder for -o")
        if folder.is_dir() and not overwrite:
            _check_empty(folder)
        nearest = next(one for one in (folder, *folder.absolute().parents) if one.exists())
        if not nearest.is_dir() or not os.access(nearest, os.W_OK | os.X_OK):
            raise CrankworkError(
                f"{folder}: cannot be written ({nearest} is not a writable folder); choose another folder"
            )
    except (OSError, ValueError) as error:
        raise _unwritable(folder, error) from None


def _check_empty(folder: Path) -> None:
    """Raise if a folder holds anything but what a killed run left behind."""
    if any(not entry.name.startswith(_STAGING) and entry.name != MANIFEST for entry in folder.iterdir()):
        raise CrankworkError(f"{folder}: holds files already; choose another folder or add --overwrite")


@contextlib.contextmanager
def _staging(nearby: Path) -> Iterator[Path]:
    """Give a folder to write in at first, and sweep those of runs that are dead."""
    with _locked(nearby):
        _sweep(nearby)
        staging = Path(tempfile.mkdtemp(prefix=_STAGING, dir=nearby))
        life = contextlib.ExitStack()
        life.enter_context(_locked(staging))
    with life:
        try:
            yield staging
        finally:
            shutil.rmtree(staging, ignore_errors=True)


def _sweep(nearby: Path) -> None:
    """Delete what killed runs were writing: a run that lives holds a lock."""
    if fcntl is None:
        return
    for left in nearby.glob(f"{_STAGING}*"):
        if not _STAGED.fullmatch(left.name) or left.is_symlink() or not left.is_dir():
            continue
        # alive, another user's, or on a disk that knows no locks
        with contextlib.suppress(OSError):
            descriptor = os.open(left, os.O_RDONLY)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(left)
            finally:
                os.close(descriptor)


def _write_through(path: Path, data: bytes) -> None:
    """Write a file and wait until it is on the disk."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as stream:
        stream.write(data)
        stream.flush()
        os.fsync(stream.fileno())


def _move(staged: Path, folder: Path, contents: dict[str, bytes], *, overwrite: bool) -> None:
    """Move staged files into place: the whole folder at once if it is new, else file by file under a mark."""
    try:
        if not folder.exists():
            staged.rename(folder)
            return
    except OSError as error:
        # another run was faster
        if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
            raise
    with _locked(folder):
        if not overwrite:
            _check_empty(folder)
        for name in contents:
            _check_place(folder, name)
        for name in contents:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
        _replace(staged, folder, contents)


def _replace(staged: Path, folder: Path, contents: dict[str, bytes]) -> None:
    """Replace the results in a folder, under a mark and with a manifest that always names every file of ours."""
    earlier = _earlier(folder)
    both = {name: [*earlier.get(name, []), _hash(data)] for name, data in contents.items()}
    _write_through(staged.parent / MANIFEST, _manifest(earlier | both))
    _write_through(staged.parent / MARK, _MARKED.encode())
    for name in (MANIFEST, MARK):
        (staged.parent / name).replace(folder / name)
    for name in contents:
        (staged / name).replace(folder / name)
    for name in earlier.keys() - contents.keys():
        if _is_as_written(folder, name, earlier[name]):
            (folder / name).unlink()
    (staged / MANIFEST).replace(folder / MANIFEST)
    (folder / MARK).unlink()


def _check_place(folder: Path, name: str) -> None:
    """Raise unless a result may go where its name says."""
    path = folder / name
    if (link := _link(folder, name)) is not None:
        raise CrankworkError(f"{link}: is a link to another folder; move it away or choose another folder")
    if path.is_dir():
        raise CrankworkError(f"{path}: is a folder; move it away or choose another folder")
    if path.resolve() in _inputs:
        raise CrankworkError(f"{path}: is what this run reads; move it away or choose another folder")


def _link(folder: Path, name: str) -> Path | None:
    """Return the link on the way from a folder to a file in it, if there is one."""
    inside = [folder / parent for parent in PurePosixPath(name).parents if parent.name]
    return next((one for one in inside if one.is_symlink()), None)


def _manifest(written: Mapping[str, list[str]]) -> bytes:
    about = "files that crankwork run wrote here, with their SHA-256; --overwrite deletes no others"
    return json.dumps({"about": about, "files": written}, indent=1).encode()


def _earlier(folder: Path) -> dict[str, list[str]]:
    """Return what earlier runs wrote into a folder: possible hashes by name."""
    try:
        with (folder / MANIFEST).open("rb") as stream:
            read = json.loads(stream.read(MAX_DATA_FILE))["files"]
        return {name: [str(one) for one in hashes] for name, hashes in read.items() if _is_inside(name)}
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        # there is none, or somebody else's: then nothing is known to be ours
        return {}


def _is_inside(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(path.name) and not path.is_absolute() and ".." not in path.parts


def _is_as_written(folder: Path, name: str, hashes: list[str]) -> bool:
    """Say whether a file is still what a run wrote, and nobody's input or link."""
    path = folder / name
    if _link(folder, name) is not None or path.is_symlink() or not path.is_file() or path.resolve() in _inputs:
        return False
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest() in hashes


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Keep other runs out of a folder; the system releases the lock even of a killed run."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        # some network disks know no locks; then runs are on their own
        with contextlib.suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _unwritable(path: Path, error: Exception) -> CrankworkError:
    return CrankworkError(f"{path}: cannot be written ({_reason(error)}); choose another place or free some space")


def _reason(error: Exception) -> str:
    return (getattr(error, "strerror", None) or "not a usable path").lower()
