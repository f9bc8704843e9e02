"""Tries an installed crankwork in an empty folder: what is there works, what is missing says what to install.

Run by the Python of the installation: python tried.py EXTRA; nothing but the standard library is imported here.
"""

from __future__ import annotations

import importlib.metadata
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

PROGRAM = Path(sys.executable).with_name("crankwork")
STUDY = """machine = "my.toml"
[designs]
drawing = "sobol"
count = 16
seed = 1
[vary]
crank.speed = { from = "1000 rpm", to = "2000 rpm" }
[objectives]
mean_torque = "maximise"
"""
WIEBE = """[cycle]
kind = "wiebe"
cycle_heat = "900 J"
combustion_start = "20 deg"
combustion_duration = "60 deg"
shape = 2.0
wall_temperature = "450 K"
"""
SEARCH = """machine = "my.toml"
[vary]
cylinder.offset = { from = "0 mm", to = "10 mm" }
[objectives]
side_force_max = "minimise"
"""


class Capability(NamedTuple):
    """What an extra brings: with which extras it works, the command, and a file that it leaves."""

    extras: frozenset[str]
    command: tuple[str, ...]
    leaves: str = ""


def _capability(extras: str, command: str, leaves: str = "") -> Capability:
    return Capability(frozenset(extras.split()), tuple(command.split()), leaves)


PYTHON = "import crankwork as cw; r = cw.analyse(cw.load('my.toml')); "
CAPABILITIES = {
    "figures": _capability("", "run my.toml -o figures --format svg", "figures/figures/torque.svg"),
    "web note": _capability("", "report my.toml -o note.html", "note.html"),
    "web page": _capability("", "page my.toml -o page.html", "page.html"),
    "moving drawing": _capability("", "draw my.toml -o machine.svg", "machine.svg"),
    "explanation": _capability("", "explain my.toml crank_torque --at 390"),
    "one number sought": _capability("", "solve my.toml mean_torque=0 --for crank.speed"),
    "tolerances": _capability("", "spread my.toml mean_torque --set crank.radius=42.5±0.1mm --samples 100"),
    "workbook": _capability("tables all", "run my.toml -o results", "results/tables.xlsx"),
    "heat release": _capability("dynamics data all", "run wiebe.toml"),
    "several numbers sought": _capability(
        "dynamics data all", "solve my.toml stroke=90mm side_force_max=3kN --for crank.radius --for rod.length"
    ),
    "PDF note": _capability("report all", "report my.toml -o note.pdf", "note.pdf"),
    "Word note": _capability("report all", "report my.toml -o note.docx", "note.docx"),
    "drawing sheets": _capability("report all", "report my.toml -o sheets.html --sheets", "sheets.html"),
    "DXF": _capability("report all", "draw my.toml -o machine.dxf --at 390", "machine.dxf"),
    "GIF": _capability("report all", "draw my.toml -o machine.gif", "machine.gif"),
    "studio": _capability("studio all", "studio my.toml --no-browser"),
    "study": _capability("data", "sweep study.toml -o swept", "swept/study.json"),
    "best design": _capability("dynamics data all", "optimise search.toml -o best"),
    "data frame": _capability("data", f"-c {PYTHON}r.to_dataframe()"),
    "NetCDF": _capability("data", f"-c {PYTHON}r.write('my.nc')", "my.nc"),
}


def _command(words: tuple[str, ...]) -> list[str]:
    if words[0] == "-c":
        return [sys.executable, "-W", "error::DeprecationWarning:crankwork", "-c", " ".join(words[1:])]
    return [str(PROGRAM), *words]


def _run(words: tuple[str, ...], folder: Path) -> tuple[int, str]:
    """Return the exit status and what was said beside the results; what goes on is stopped and counts as success."""
    try:
        timeout = 20 if words[0] == "studio" else 300
        ended = subprocess.run(
            _command(words), cwd=folder, capture_output=True, text=True, check=False, timeout=timeout
        )
    except subprocess.TimeoutExpired:
        return 0, ""
    return ended.returncode, ended.stderr


def _mistake(name: str, extra: str, folder: Path) -> str:
    """Return what is wrong with a capability, if anything."""
    extras, words, leaves = CAPABILITIES[name]
    is_there = not extras or extra in extras
    status, said = _run(words, folder)
    if is_there:
        left = not leaves or (folder / leaves).exists()
        return "" if status == 0 and left else f"status {status}, {leaves} {'is' if left else 'is not'} there: {said}"
    lines = [line for line in said.splitlines() if "pip install" in line]
    is_told = len(lines) == 1 and re.search(r"pip install \S.*crankwork\[[a-z,]+\]", lines[0])
    if "Traceback" in said.replace("crankwork.errors.MissingExtraError", "") and words[0] != "-c":
        return f"a traceback: {said}"
    return "" if is_told else f"status {status}, not told in one line: {said}"


def main(extra: str) -> int:
    """Try everything with the extra that is installed, `base` for none; print a line for what is wrong."""
    version = importlib.metadata.version("crankwork")
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        told = subprocess.run([str(PROGRAM), "--version"], capture_output=True, text=True, check=False).stdout
        mistakes = {} if told == f"crankwork {version}\n" else {"version": f"{version} says {told}"}
        _run(("new", "engine", "-o", "my.toml"), folder)
        text = (folder / "my.toml").read_text("utf-8")
        cycle = text[text.index("[cycle]") : text.index("[method]")]
        (folder / "wiebe.toml").write_text(text.replace(cycle, WIEBE), "utf-8")
        (folder / "study.toml").write_text(STUDY, "utf-8")
        (folder / "search.toml").write_text(SEARCH, "utf-8")
        # what needs no extra is tried without any and with all; the main job is the same for each
        is_whole = extra in ("base", "all")
        tried = [name for name, one in CAPABILITIES.items() if is_whole or one.extras or name == "figures"]
        mistakes |= {name: told for name in tried if (told := _mistake(name, extra, folder))}
    python = ".".join(map(str, sys.version_info[:3]))
    works = sum(not CAPABILITIES[name].extras or extra in CAPABILITIES[name].extras for name in tried)
    told = f"Python {python}, {extra}: {works} things work, {len(tried) - works} say what they need"
    told += f"; wrong: {', '.join(mistakes)}" if mistakes else ""
    sys.stdout.write("\n  ".join([told, *(f"{name}: {what}" for name, what in mistakes.items())]) + "\n")
    return bool(mistakes)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
