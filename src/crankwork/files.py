"""The only module that opens files. Reading is bounded; writing leaves either the whole file or nothing."""

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
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import TextIO

from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage

try:
    import fcntl
except ImportError:  # pragma: no cover - Windows has no such locks
    fcntl = None  # type: ignore[assignment]

MAX_MACHINE_FILE = 256 * 1024
MAX_LINE = 4096
MAX_DATA_FILE = 64 * 1024 * 1024
_STAGING = ".crankwork-"
_STAGED = re.compile(re.escape(_STAGING) + r"[a-z0-9_]{8}")
# Lists the files that runs wrote into a folder, with their hashes: nothing else is ever deleted there.
MANIFEST = ".crankwork.json"
# Is in a folder while its results are replaced, and remains after an interruption.
MARK = "UNFINISHED-crankwork.txt"
_MARKED = """\
A run of crankwork was replacing the results in this folder and was stopped before it was done:
old and new results stand side by side. Run it again with --overwrite.
"""
# Names the study whose parts are in a folder; a run that works there holds a lock on it.
STUDY = "study.json"
_PART = re.compile(r"part-([0-9]{7,})\.parquet")
# Files that were read in this process, which no result may replace.
_inputs: set[Path] = set()


def read_text(path: str | Path, *, limit: int = MAX_MACHINE_FILE, advice: str = "") -> str:
    """Return the text of a file, UTF-8 with or without a byte order mark.

    `advice`: what to do if there is no such file, otherwise to check the path.
    """
    return _decoded(Path(path), read_data(path, limit=limit, advice=advice))


def read_data(path: str | Path, *, limit: int = MAX_DATA_FILE, advice: str = "") -> bytes:
    """Return the content of a file; `advice`: what to do if there is no such file, otherwise to check the path."""
    path, advice = Path(path), advice or ErrorMessage("check_path")
    try:
        mode = path.stat().st_mode
        # a pipe or a device may never end, and opening it may never return
        if not stat.S_ISREG(mode):
            raise CrankworkError(ErrorMessage("path_folder" if stat.S_ISDIR(mode) else "path_odd", path=path))
        with path.open("rb") as stream:
            data = stream.read(limit + 1)
        _inputs.add(_real(path))
    except FileNotFoundError:
        raise CrankworkError(ErrorMessage("path_absent", path=path, advice=advice)) from None
    except (OSError, ValueError) as error:
        raise CrankworkError(ErrorMessage("path_unreadable", path=path, reason=_reason(error), advice=advice)) from None
    if len(data) > limit:
        if limit >= 1 << 20:
            raise CrankworkError(ErrorMessage("path_large", path=path, size=limit >> 20))
        raise CrankworkError(ErrorMessage("path_large_kb", path=path, size=limit >> 10))
    return data


def _decoded(path: Path, data: bytes) -> str:
    """Return bytes as text, or raise with the line of the first invalid byte."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise CrankworkError(ErrorMessage("path_utf_16", path=path))
    if b"\0" in data:
        raise CrankworkError(ErrorMessage("path_binary", path=path, line=_line(data, data.index(0))))
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CrankworkError(ErrorMessage("path_no_utf_8", path=path, line=_line(data, error.start))) from None


def _line(data: bytes, position: int) -> int:
    return data.count(b"\n", 0, position) + 1


def write_new(path: str | Path, text: str, *, overwrite: bool = False) -> None:
    """Write a text file, whole or not at all, into a folder that is created for it."""
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
                raise CrankworkError(ErrorMessage("folder_absent", path=path, folder=path.parent))
            if not os.access(path.parent, os.W_OK | os.X_OK):
                raise CrankworkError(ErrorMessage("place_locked", path=path, folder=path.parent))
        except (OSError, ValueError) as error:
            raise _unwritable(path, error) from None


def _check_new(path: Path, *, overwrite: bool) -> None:
    """Raise if the path exists, or if it has been read."""
    try:
        if path.exists() and not path.is_file():
            raise CrankworkError(ErrorMessage("name_of_folder" if path.is_dir() else "name_of_odd", path=path))
        if _real(path) in _inputs:
            raise CrankworkError(ErrorMessage("place_read", path=path))
        if path.exists() and not overwrite:
            raise CrankworkError(ErrorMessage("name_taken", path=path))
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None


def write_files(contents: Mapping[str | Path, bytes], *, overwrite: bool = False, save: bool = False) -> None:
    """Write files into existing folders, so that a failure leaves the previous state.

    `save`: also over existing files and those that were read.
    """
    if not save:
        check_files(*contents, overwrite=overwrite)
    path = Path(next(iter(contents), ""))
    try:
        with contextlib.ExitStack() as stack:
            folders = {Path(name).parent for name in contents}
            staging = {folder: stack.enter_context(_staging(folder)) for folder in folders}
            for path, data in ((Path(name), data) for name, data in contents.items()):
                _write_through(staging[path.parent] / path.name, data)
            for path in map(Path, contents):
                (staging[path.parent] / path.name).replace(path)
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None


def mark_inputs(*paths: str | Path) -> None:
    """Name files that will be read, so that results cannot replace them; checked before anything is computed."""
    with contextlib.suppress(OSError, ValueError):
        _inputs.update(_real(path) for path in paths)


def write_folder(folder: str | Path, contents: dict[str, bytes], *, overwrite: bool = False) -> None:
    """Write files into a folder so that a failure leaves the previous state.

    If killed at any moment, the folder has the old results, the new ones, or the file `MARK`, which says that both are
    there. `overwrite`: write into a folder that is not empty. Files of an earlier run, by the manifest of the folder,
    that are not written again are deleted unless they have changed; all other files stay.
    """
    folder = Path(folder)
    check_folder(folder, overwrite=overwrite)
    try:
        # next to the folder, or in it if it exists, because that may be another disk
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


def cached_file(name: str, text: str) -> Path | None:
    """Return the path of a text that is cached between runs, written if it is absent; None if it cannot be.

    `CRANKWORK_CACHE` is its folder, by default that of the system.
    """
    try:
        path = _between_runs(name)
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            _write_atomically(path, text)
    except (OSError, RuntimeError):
        return None
    return path


def update_user_file(name: str, change: Callable[[str], str], *, limit: int) -> str:
    """Update a file in the user's cache folder under a lock; return its new text, or an empty text on failure.

    `limit`: longer texts are replaced as if empty [bytes].
    """
    try:
        path = _between_runs(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        with _locked(path.parent):
            data = b""
            if path.is_file():
                with path.open("rb") as stream:
                    data = stream.read(limit + 1)
            before = data.decode("utf-8", "replace") if len(data) <= limit else ""
            after = change(before)
            if after != before:
                _write_atomically(path, after)
    except (OSError, RuntimeError):
        return ""
    return after


def _between_runs(name: str) -> Path:
    stated = os.environ.get("CRANKWORK_CACHE") or os.environ.get("XDG_CACHE_HOME")
    return (Path(stated) if stated else Path.home() / ".cache") / "crankwork" / name


def _write_atomically(path: Path, text: str) -> None:
    """Write a text, whole or not at all, into an existing folder."""
    with tempfile.NamedTemporaryFile("w", dir=path.parent, suffix=".tmp", delete=False, encoding="utf-8") as file:
        file.write(text)
    Path(file.name).replace(path)


def discard_output(stream: TextIO) -> None:
    """Discard the rest of a stream that nobody reads any more.

    Otherwise the interpreter would try to write it at exit, and print an error.
    """
    with contextlib.suppress(OSError, ValueError):
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, stream.fileno())
        os.close(null)


class StudyFolder:
    """A folder that one run fills part by part, and another may resume; the system releases its lock after either."""

    def __init__(self, folder: str | Path, identity: bytes, *, resume: bool) -> None:
        self._folder, self._lock = Path(folder), -1
        self._parts = self._folder / "parts"
        try:
            self._open(identity, resume=resume)
        except (OSError, ValueError, CrankworkError) as error:
            self.close()
            raise error if isinstance(error, CrankworkError) else _unwritable(self._folder, error) from None

    def _open(self, identity: bytes, *, resume: bool) -> None:
        path = self._folder / STUDY
        if resume and not path.is_file():
            raise CrankworkError(ErrorMessage("study_none", path=self._folder))
        if not resume and path.exists():
            raise CrankworkError(ErrorMessage("study_there", path=self._folder))
        if not resume:
            check_folder(self._folder)
            self._parts.mkdir(parents=True, exist_ok=True)
        self._lock = os.open(path, os.O_RDWR | (0 if resume else os.O_CREAT | os.O_EXCL), 0o644)
        if fcntl is not None:
            try:
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise CrankworkError(ErrorMessage("study_busy", path=self._folder)) from None
            except OSError:
                # some network disks have no locks; then runs are not protected from each other
                pass
        if not resume:
            os.write(self._lock, identity)
            os.fsync(self._lock)
        elif (existing := os.pread(self._lock, MAX_MACHINE_FILE, 0)) != identity:
            raise CrankworkError(ErrorMessage("study_other", path=self._folder, what=_differing(existing, identity)))
        for left in self._parts.glob(f"{_STAGING}*"):
            left.unlink()

    def done(self) -> set[int]:
        """Return the numbers of the parts that exist."""
        matches = (_PART.fullmatch(path.name) for path in self._parts.iterdir())
        return {int(match[1]) for match in matches if match}

    def path(self, number: int) -> Path:
        """Return the path of a part."""
        return self._parts / f"part-{number:07d}.parquet"

    def read(self, number: int) -> bytes:
        """Return the content of a part."""
        return read_data(self.path(number))

    def write(self, number: int, data: bytes) -> None:
        """Write a part, whole or not at all."""
        path = self.path(number)
        staged = path.with_name(f"{_STAGING}{path.name}")
        try:
            _write_through(staged, data)
            staged.replace(path)
        except OSError as error:
            with contextlib.suppress(OSError):
                staged.unlink(missing_ok=True)
            raise _unwritable(path, error) from None

    def close(self) -> None:
        """Release the lock."""
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def _differing(existing: bytes, identity: bytes) -> str:
    """Return the names of the entries in which two identities differ."""
    try:
        first, second = json.loads(existing), json.loads(identity)
        return ", ".join(name for name in second if first.get(name) != second[name]) or STUDY
    except (ValueError, AttributeError):
        return STUDY


def _real(path: str | Path) -> Path:
    """Return the whole path without links; of links that lead to each other one of them."""
    return Path(os.path.realpath(path))


def check_folder(folder: str | Path, *, overwrite: bool = False) -> None:
    """Raise unless results may be written into a folder."""
    folder = Path(folder)
    try:
        if folder.exists() and not folder.is_dir():
            raise CrankworkError(ErrorMessage("folder_is_file", path=folder))
        # files that a run replaces or deletes without asking
        for read in (path for path in _inputs if _real(folder) in path.parents):
            if (own := read.relative_to(_real(folder)).parts[0]) in (MANIFEST, MARK) or own.startswith(_STAGING):
                raise CrankworkError(ErrorMessage("place_read", path=read))
        if folder.is_dir() and not overwrite:
            _check_empty(folder)
        nearest = next(path for path in (folder, *folder.absolute().parents) if path.exists())
        if not nearest.is_dir() or not os.access(nearest, os.W_OK | os.X_OK):
            raise CrankworkError(ErrorMessage("folder_locked", path=folder, folder=nearest))
    except (OSError, ValueError) as error:
        raise _unwritable(folder, error) from None


def _check_empty(folder: Path) -> None:
    """Raise if a folder has anything but the remains of a killed run."""
    if any(not entry.name.startswith(_STAGING) and entry.name != MANIFEST for entry in folder.iterdir()):
        raise CrankworkError(ErrorMessage("folder_full", path=folder))


@contextlib.contextmanager
def _staging(nearby: Path) -> Iterator[Path]:
    """Yield a temporary folder to write in first, and delete those of killed runs."""
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
    """Delete what killed runs were writing: a live run holds a lock."""
    if fcntl is None:
        return
    for left in nearby.glob(f"{_STAGING}*"):
        if not _STAGED.fullmatch(left.name) or left.is_symlink() or not left.is_dir():
            continue
        # alive, another user's, or on a disk without locks
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
    """Move staged files into place: the whole folder at once if it is new, otherwise file by file under a mark."""
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
        earlier = _earlier(folder)
        for name in contents:
            _check_place(folder, name, earlier.get(name, []))
        for name in contents:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
        _replace(staged, folder, contents)


def _replace(staged: Path, folder: Path, contents: dict[str, bytes]) -> None:
    """Replace the results in a folder, under a mark and with a manifest that always lists all our files."""
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


def _check_place(folder: Path, name: str, hashes: list[str]) -> None:
    """Raise unless a result may be written under its name; `hashes`: of what earlier runs wrote there."""
    path = folder / name
    if (link := _link(folder, name)) is not None:
        raise CrankworkError(ErrorMessage("place_linked", path=link))
    if path.is_dir():
        raise CrankworkError(ErrorMessage("place_folder", path=path))
    if _real(path) in _inputs:
        raise CrankworkError(ErrorMessage("place_read", path=path))
    if path.exists() and not path.is_symlink() and not _is_as_written(folder, name, hashes):
        raise CrankworkError(ErrorMessage("place_taken", path=path))


def _link(folder: Path, name: str) -> Path | None:
    """Return the first link on the path from a folder to a file in it, or None."""
    inside = [folder / parent for parent in PurePosixPath(name).parents if parent.name]
    return next((parent for parent in inside if parent.is_symlink()), None)


def _manifest(written: Mapping[str, list[str]]) -> bytes:
    about = "files that crankwork run wrote here, with their SHA-256; --overwrite deletes no others"
    return json.dumps({"about": about, "files": written}, indent=1).encode()


def _earlier(folder: Path) -> dict[str, list[str]]:
    """Return the files that earlier runs wrote into a folder: possible hashes by name."""
    try:
        with (folder / MANIFEST).open("rb") as stream:
            listed = json.loads(stream.read(MAX_DATA_FILE))["files"]
        inside = {name: hashes for name, hashes in listed.items() if (path := PurePosixPath(name)).name
                  and not path.is_absolute() and ".." not in path.parts}  # fmt: skip
        return {name: [str(value) for value in hashes] for name, hashes in inside.items()}
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        # absent, or of another program: then no file is ours
        return {}


def _is_as_written(folder: Path, name: str, hashes: list[str]) -> bool:
    """Return whether a file is still as a run wrote it, and is neither an input nor a link."""
    path = folder / name
    if _link(folder, name) is not None or path.is_symlink() or not path.is_file() or _real(path) in _inputs:
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
        # some network disks have no locks; then runs are not protected from each other
        with contextlib.suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _unwritable(path: Path, error: Exception) -> CrankworkError:
    if isinstance(error, PermissionError):
        # of two names the second is that of the existing file
        path = Path(error.filename2 or error.filename or path)
        return CrankworkError(ErrorMessage("place_held", path=path, reason=_reason(error)))
    return CrankworkError(ErrorMessage("place_unwritable", path=path, reason=_reason(error)))


def _reason(error: Exception) -> str:
    # a folder that accepts no files, as /proc, reports a missing file
    if isinstance(error, FileNotFoundError) and Path(error.filename2 or error.filename or "").parent.is_dir():
        return ErrorMessage("place_takes_nothing")
    reason = getattr(error, "strerror", None)
    return reason.lower() if reason else ErrorMessage("path_unusable")
