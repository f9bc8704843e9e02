"""Files that are no machine files, by accident or on purpose: refused at once, in one line."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from crankwork.description.machine_file import template
from each import for_each

# what is written, and what the answer says
DOTS = b".a" * 2000
HOSTILE: dict[str, tuple[bytes, str]] = {
    "300 kB": (b"# " + b"x" * 100 + b"\n" + b"a = 1\n" * 50_000, "my.toml: larger than 256 kB; keep what is needed"),
    "a key of 200,000 parts": (b".".join([b"a"] * 100_000) + b" = 1", "my.toml:1: line longer than 4096 characters"),
    "keys of 2,000 parts": (b"".join(b"b%d%s = 1\n" % (n, DOTS) for n in range(60)), "more than 8 parts"),
    "headers of 2,000 parts": (b"".join(b"[b%d%s]\n" % (n, DOTS) for n in range(60)), "more than 8 parts"),
    "inline keys": (b"a = [\n" + (b"{ b" + b" . a" * 1000 + b" = 1 },\n") * 50 + b"]", "more than 8 parts"),
    "quoted keys of 800 parts": (b'"a"' + b'."a"' * 900 + b" = 1\n", "my.toml:1: a key of more than 8 parts"),
    "10,000 nested brackets": (b"a = [\n" + (b"[" * 2000 + b"\n") * 5, "nested too deeply"),
    "nested tables": (b"a = " + b"{a=" * 1000 + b"1" + b"}" * 1000, "nested too deeply"),
    "20,000 keys": (b"".join(b"k%d = 1\n" % n for n in range(20_000)), "more mistakes; correct these first"),
    "15,000 pieces": (b"[[gas.pieces]]\n" * 15_000, "has 15000 entries; write at least 1"),
    "400 pieces": (b"[gas]\n" + b"[[gas.pieces]]\n" * 400, "is missing; write law ="),
    "9,000 misspelt keys": (b"[gas.points]\n" + b"p%d={angel=1}\n" * 9_000 % (*range(9_000),), "did you mean angle?"),
    "quotation marks": (b'"\\"' * 1300 + b"\n", "my.toml:1: is not valid TOML"),
    "a picture": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)) * 10, "my.toml:3: is a binary file; give"),
    "UTF-16": ("title = 'x'\n".encode("utf-16"), "my.toml:1: is UTF-16 text; save it as UTF-8"),
    "UTF-16 without a mark": ("title = 'x'\n".encode("utf-16-le"), "my.toml:1: is a binary file; give"),
    "Windows Cyrillic": ('title = "a"\n# мм\n'.encode("cp1251"), "my.toml:2: is not UTF-8 text; give"),
    "empty": (b"", "my.toml:1: crank: is missing; write a table [crank]"),
}  # fmt: skip


@for_each(("data", "answered"), HOSTILE.values(), ids=list(HOSTILE))
def test_a_hostile_file_is_refused_at_once(crankwork, check_mistakes, data, answered) -> None:
    Path("my.toml").write_bytes(data)
    with _stopped_after(seconds=10):
        answer = crankwork("check", "my.toml")
    check_mistakes(answer)
    assert answered in answer.err, answer.err[:2000]
    assert len(answer.err) < 20_000


@contextlib.contextmanager
def _stopped_after(seconds: float) -> Iterator[None]:
    """Fail where a program hangs: an ordinary file takes a hundredth of a second of the processor."""
    before = signal.signal(signal.SIGPROF, _hangs)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def _hangs(*_: object) -> None:
    pytest.fail("it hangs")


def test_a_byte_order_mark_and_line_ends_of_windows_change_nothing(crankwork) -> None:
    text = template("engine")
    found = []
    for one in (text, "\ufeff" + text, text.replace("\n", "\r\n")):
        Path("my.toml").write_bytes(one.encode())
        found.append(crankwork("run", "my.toml", "--json").results)
    assert found[1:] == [found[0]] * 2


def test_lines_of_windows_are_counted_as_lines(crankwork) -> None:
    text = template("engine").replace('"45 mm"', "45")
    line = text[: text.index("radius = 45")].count("\n") + 1
    Path("my.toml").write_bytes(text.replace("\n", "\r\n").encode())
    assert crankwork("check", "my.toml").err.startswith(f"my.toml:{line}: crank.radius: 45 has no unit")


def test_a_missing_file_is_refused_with_the_way_to_make_one(crankwork, check_mistakes) -> None:
    answer = crankwork("check", "none.toml")
    check_mistakes(answer)
    assert "none.toml: no such file; check the path, or make one with: crankwork new engine -o none.toml" in answer.err


def test_a_folder_is_refused(crankwork, check_mistakes) -> None:
    answer = crankwork("check", ".")
    check_mistakes(answer)
    assert answer.err == ".: is a folder; give a file\n"


@for_each("name", ["a\0b", "x" * 5000, ""])
def test_a_name_that_no_file_can_have_is_refused(crankwork, check_mistakes, name) -> None:
    check_mistakes(crankwork("check", name))


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there are no devices in the file system")
def test_devices_and_pipes_are_refused_without_waiting(crankwork, check_mistakes) -> None:
    os.mkfifo("pipe")
    reading, writing = os.pipe()
    try:
        answers = {name: crankwork("check", name) for name in ("/dev/zero", f"/dev/fd/{reading}", "pipe")}
    finally:
        os.close(reading)
        os.close(writing)
    said = "is not an ordinary file; save its content to a file and give that"
    assert {name: answer.err for name, answer in answers.items() if said not in answer.err} == {}
    for answer in answers.values():
        check_mistakes(answer)


@pytest.mark.skipif(sys.platform == "win32", reason="links are those of Unix")
def test_links_that_lead_to_each_other_are_refused_as_file_and_as_place(
    crankwork, check_mistakes, machine_file
) -> None:
    name = machine_file()
    Path("one").symlink_to("other")
    Path("other").symlink_to("one")
    for words in (("check", "one"), ("run", name, "-o", "one"), ("new", "engine", "-o", "one", "--overwrite")):
        check_mistakes(crankwork(*words))


def test_a_file_that_may_not_be_read_is_refused(crankwork, check_mistakes, monkeypatch) -> None:
    Path("my.toml").write_text(template("engine"), encoding="utf-8")
    monkeypatch.setattr(Path, "open", _refuse)
    answer = crankwork("check", "my.toml")
    check_mistakes(answer)
    assert "my.toml: cannot be read (permission denied)" in answer.err


def _refuse(*_: object, **__: object) -> None:
    raise PermissionError(13, "Permission denied")
