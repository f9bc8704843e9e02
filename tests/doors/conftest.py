"""The command line as a user meets it, in this process for speed."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from crankwork import cli
from crankwork.description.machine_file import template
from machine_texts import POINTS_ENGINE


class Answer(NamedTuple):
    """What a command said and how it ended."""

    code: int
    out: str
    err: str

    @property
    def mistakes(self) -> list[str]:
        """The lines that name a mistake."""
        return [line for line in self.err.splitlines() if line != "nothing was computed"]

    @property
    def results(self) -> dict[str, Any]:
        """What `--json` printed, all but of which file."""
        assert self.code == 0, self.err
        return {key: value for key, value in json.loads(self.out).items() if key != "machine_file_sha256"}


Command = Callable[..., Answer]


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def crankwork(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Run a command in this process."""

    def run(*arguments: str) -> Answer:
        monkeypatch.setattr(sys, "argv", ["crankwork", *arguments])
        capsys.readouterr()
        with pytest.raises(SystemExit) as ended:
            cli.main()
        out, err = capsys.readouterr()
        return Answer(int(ended.value.code or 0), out, err)

    return run


@pytest.fixture
def machine_file(tmp_path: Path) -> Callable[..., str]:
    """Write a machine file: a template, or an engine with a diagram of points, with pieces of its text replaced."""

    def write(*changes: tuple[str, str], name: str = "", text: str | None = None) -> str:
        source = text or (template(name) if name else POINTS_ENGINE)
        for old, new in changes:
            assert source.count(old) == 1, f"{old!r} stands {source.count(old)} times"
            source = source.replace(old, new)
        (tmp_path / "my.toml").write_text(source, encoding="utf-8")
        return "my.toml"

    return write


@pytest.fixture
def check_mistakes(crankwork: Command) -> Callable[[Answer], None]:
    """Make sure that an answer refuses as every refusal does: code 2, one line per mistake, no traceback."""

    def check(answer: Answer) -> None:
        assert answer.code == 2
        assert answer.out == "" or "cannot be written" in answer.err  # computed, but nowhere to put it
        assert answer.mistakes
        assert "Traceback" not in answer.err
        assert not re.search(r"tomllib|numpy|pydantic|errno|error code|exception", answer.err, re.IGNORECASE)

    return check


@pytest.fixture
def check_refusals(
    crankwork: Command, check_mistakes: Callable[[Answer], None]
) -> Callable[[Iterable[tuple[tuple[str, ...], str]]], None]:
    """Make sure that each command is refused in one line with what is told and writes nothing; name others."""

    def check(refusals: Iterable[tuple[tuple[str, ...], str]]) -> None:
        before, failures = _contents("."), {}
        for arguments, told in refusals:
            answer = crankwork(*arguments)
            try:
                check_mistakes(answer)
                (line,) = answer.mistakes
                assert told in line
                assert _contents(".") == before
            except (AssertionError, ValueError) as error:
                failures[" ".join(arguments)[:200]] = f"{answer.err[:500]} {error}"
        assert failures == {}

    return check


def _contents(folder: str | Path) -> dict[str, bytes]:
    """Return what is in the files of a folder and below it, by their names."""
    folder = Path(folder)
    return {one.relative_to(folder).as_posix(): one.read_bytes() for one in folder.rglob("*") if one.is_file()}
