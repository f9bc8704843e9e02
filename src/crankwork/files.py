"""The only place that opens files. Reading is bounded; writing leaves either the whole file or nothing."""

from __future__ import annotations

import contextlib
import errno
import os
import stat
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
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


def read_resource(*names: str) -> str:
    """Return the text of a file of the package.

    Parameters
    ----------
    *names : str
        Path within the package, part by part.
    """
    return Path(__file__).parent.joinpath(*names).read_text(encoding="utf-8")


def resource_names(folder: str, suffix: str) -> list[str]:
    """Return the sorted stems of the package files in a folder that end with `suffix`."""
    entries = Path(__file__).parent.joinpath(folder).iterdir()
    return sorted(entry.name.removesuffix(suffix) for entry in entries if entry.name.endswith(suffix))


def read_text(path: str | Path, *, limit: int = MAX_MACHINE_FILE, advice: str = "check the path") -> str:
    """Return the text of a file, UTF-8 with or without a byte order mark.

    Parameters
    ----------
    path : path
        The file.
    limit : int
        Largest size accepted. [bytes]
    advice : str
        What to do if there is no such file.

    Raises
    ------
    CrankworkError
        If the file is missing, unreadable, larger than the limit, or not text.
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
    """Write a text file, whole or not at all.

    Parameters
    ----------
    path : path
        The file.
    text : str
        What goes in.
    overwrite : bool
        Replace a file that is there.

    Raises
    ------
    CrankworkError
        If the file exists and `overwrite` is not set, or it cannot be written.
    """
    _check_new(Path(path), overwrite=overwrite)
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise _unwritable(Path(path), error) from None
    write_files({path: text.encode("utf-8")}, overwrite=overwrite)


def check_files(*paths: str | Path, overwrite: bool = False) -> None:
    """Raise unless files may be written, before anything is computed for them.

    Parameters
    ----------
    *paths : path
        The files.
    overwrite : bool
        Whether they may be there already.

    Raises
    ------
    CrankworkError
        With the fix.
    """
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
    """Write files into folders that are there, so that a failure leaves what was there before.

    Parameters
    ----------
    contents : mapping of path to bytes
        Data by the file that it goes to.
    overwrite : bool
        Replace files that are there.

    Raises
    ------
    CrankworkError
        If a file exists and `overwrite` is not set, or one cannot be written.
    """
    check_files(*contents, overwrite=overwrite)
    staged: list[tuple[Path, Path]] = []
    path = Path()
    try:
        for path, data in ((Path(name), data) for name, data in contents.items()):
            descriptor, name = tempfile.mkstemp(prefix=_STAGING, dir=path.parent)
            staged.append((Path(name), path))
            os.close(descriptor)
            _write_through(Path(name), data)
            Path(name).chmod(0o644)
        for one, path in staged:
            one.replace(path)
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None
    finally:
        for one, _ in staged:
            one.unlink(missing_ok=True)


def write_folder(
    folder: str | Path, contents: dict[str, bytes], *, overwrite: bool = False, stale: tuple[str, ...] = ()
) -> None:
    """Write files into a folder so that a failure leaves what was there before.

    Parameters
    ----------
    folder : path
        Made if missing.
    contents : dict of str to bytes
        Data by path relative to the folder.
    overwrite : bool
        Write into a folder that holds something already; files of other names stay.
    stale : tuple of str
        Patterns of what an earlier run may have left there; of those, what is not written anew is removed.

    Raises
    ------
    CrankworkError
        If the folder holds something and `overwrite` is not set, or it cannot be written.
    """
    folder = Path(folder)
    check_folder(folder, overwrite=overwrite)
    try:
        # next to the folder, or in it where it exists, because that may be another disk
        nearby = folder if folder.is_dir() else folder.parent
        nearby.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=_STAGING, dir=nearby) as staging:
            staged = Path(staging) / "results"
            for name, data in contents.items():
                _write_through(staged / name, data)
            _move(staged, folder, contents, overwrite=overwrite)
            for old in {path for pattern in stale for path in folder.glob(pattern)}:
                if str(old.relative_to(folder).as_posix()) not in contents:
                    old.unlink(missing_ok=True)
    except (OSError, ValueError) as error:
        raise _unwritable(folder, error) from None


def send_nowhere(stream: TextIO) -> None:
    """Let what is still buffered in a stream go nowhere, where nobody reads it any more.

    Parameters
    ----------
    stream : text stream
        The output; the interpreter would try to write it once more when it ends, and complain.
    """
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)


def check_folder(folder: str | Path, *, overwrite: bool = False) -> None:
    """Raise unless results may be written into a folder.

    Parameters
    ----------
    folder : path
        Where results are to go.
    overwrite : bool
        Whether it may hold something already.

    Raises
    ------
    CrankworkError
        With the fix.
    """
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
    if any(not entry.name.startswith(_STAGING) for entry in folder.iterdir()):
        raise CrankworkError(f"{folder}: holds files already; choose another folder or add --overwrite")


def _write_through(path: Path, data: bytes) -> None:
    """Write a file and wait until it is on the disk."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as stream:
        stream.write(data)
        stream.flush()
        os.fsync(stream.fileno())


def _move(staged: Path, folder: Path, contents: dict[str, bytes], *, overwrite: bool) -> None:
    """Move staged files into place: the whole folder at once if it is new, else file by file."""
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
            if (folder / name).is_dir():
                raise CrankworkError(f"{folder / name}: is a folder; move it away or choose another folder")
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
        for name in contents:
            (staged / name).replace(folder / name)


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
