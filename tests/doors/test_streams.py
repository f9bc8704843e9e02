"""The program among others: pipes that close, disks that fill, terminals that know no Unicode, and what it loads."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import crankwork

HEAVY = ("matplotlib", "pydantic", "scipy", "xlsxwriter")
ENVIRONMENT = os.environ | {"PYTHONPATH": str(Path(crankwork.__file__).parents[1])}
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the shell is that of Unix")


def _shell(program_words: str, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", "-c", program_words], env=environment, capture_output=True, text=True, timeout=60, check=False
    )


@pytest.fixture
def shell(machine_file):
    """Run a line of the shell in which `crankwork` is the program and my.toml an engine."""
    machine_file()
    environment = ENVIRONMENT | {"PYTHON": sys.executable}

    def run(line: str, **more: str) -> subprocess.CompletedProcess[str]:
        line = 'crankwork() { "$PYTHON" -m crankwork "$@"; }; ' + line
        return _shell(line, environment | more)

    return run


def test_a_reader_that_leaves_early_is_no_error_to_talk_about(shell) -> None:
    result = shell("crankwork run my.toml | head -1")
    assert (result.stdout, result.stderr) == ("Four-stroke engine\n", "")


def test_a_full_device_behind_the_output_is_told_in_one_line(shell) -> None:
    result = shell("crankwork run my.toml > /dev/full")
    assert result.returncode == 2
    assert result.stderr == "the output cannot be written (no space left on device); send it elsewhere\n"


@pytest.mark.parametrize("line", ["crankwork run my.toml >&-", "crankwork check none.toml 2>&-", "crankwork >&- 2>&-"])
def test_closed_streams_are_no_traceback(shell, line) -> None:
    result = shell(line)
    assert result.stdout + result.stderr == ""


def test_a_locale_without_unicode_prints_all_the_same(shell) -> None:
    expected = shell("crankwork run my.toml --lang vi").stdout
    for variables in ({"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}, {"PYTHONIOENCODING": "ascii"},
                      {"PYTHONIOENCODING": "koi8-r"}):  # fmt: skip
        result = shell("crankwork run my.toml --lang vi", **variables)
        assert (result.stdout, result.stderr) == (expected, "")


def test_a_name_that_is_no_text_is_refused_in_one_line(shell) -> None:
    result = shell(r"crankwork check $'\xff.toml'; crankwork run my.toml --set title=$'\xff'")
    first, second, last = result.stderr.splitlines()
    assert "no such file" in first
    assert second.startswith("--set title: ")
    assert last == "nothing was computed"


@pytest.mark.parametrize("arguments", [("run", "my.toml"), ("run", "my.toml", "--json"), ("check", "my.toml")])
def test_a_first_answer_loads_nothing_that_draws_or_writes_workbooks(machine_file, program, arguments) -> None:
    machine_file()
    code = (
        "import sys; from crankwork import cli\n"
        "try: cli.main()\n"
        f"finally: print(*[name for name in {HEAVY!r} if name in sys.modules], 'heavy', file=sys.stderr)"
    )
    result = program(*arguments)
    assert result.returncode == 0
    command = [sys.executable, "-c", code, *arguments]
    loaded = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=False, timeout=60)
    assert loaded.stderr == "heavy\n"
    assert loaded.stdout == result.stdout.decode()


def test_the_schema_is_printed_as_json(program) -> None:
    assert json.loads(program("schema").stdout)["title"] == "crankwork machine file"
