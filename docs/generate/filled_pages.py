"""Pages whose commands are carried out: each page in an empty folder with the examples beside it.

A fence marked `run` holds commands of a shell; below each stands what it printed. `run 20` keeps the first 20 lines.
`file NAME` writes a file and shows it; `python` runs a program, whose output follows. A picture `made/NAME` is a file
that a command wrote.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
_FENCE = re.compile(
    r"^```(?P<kind>run|file|python)(?: (?P<what>[^\n]+))?\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL
)
_MADE = re.compile(r"(?<=\]\()made/(?P<name>[^)\s]+)")
_LIMIT = 120


def _environment() -> dict[str, str]:
    program = str(Path(sys.executable).parent)
    return {**os.environ, "PATH": f"{program}{os.pathsep}{os.environ['PATH']}", "LANG": "C.UTF-8", "LC_ALL": "C.UTF-8",
            "OPENBLAS_NUM_THREADS": "1", "COLUMNS": "110"}  # fmt: skip


def _output(command: list[str], folder: Path, page: str) -> str:
    done = subprocess.run(
        command, cwd=folder, env=_environment(), capture_output=True, text=True, timeout=_LIMIT, check=False
    )
    # with a mistake in the file that is shown on purpose, the command line ends with 2
    if done.returncode and "mistake" not in command[-1]:
        raise SystemExit(f"{page}: {command[-1]}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def _shortened(printed: str, most: str | None) -> str:
    lines = printed.rstrip("\n").splitlines()
    return "\n".join(lines if not most or len(lines) <= int(most) else [*lines[: int(most)], "..."])


def filled(page: Path, written: str) -> str:
    """Return the text of a page with what its commands print, and put its pictures beside it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copytree(ROOT / "examples", folder / "examples")

        def carried_out(match: re.Match[str]) -> str:
            kind, what, body = match["kind"], match["what"], match["body"]
            if kind == "file":
                (folder / what).write_text(body, encoding="utf-8")
                return f"```{{code-block}} {Path(what).suffix.removeprefix('.')}\n:caption: {what}\n\n{body}```"
            if kind == "python":
                printed = _shortened(_output([sys.executable, "-c", body], folder, page.name), what)
                return f"```python\n{body}```\n\n```text\n{printed}\n```" if printed else f"```python\n{body}```"
            parts = []
            for command in body.strip().splitlines():
                printed = _shortened(_output(["bash", "-c", command], folder, page.name), what)
                parts += [f"$ {command}", *([printed] if printed else [])]
            return "```console\n" + "\n".join(parts) + "\n```"

        def picture(match: re.Match[str]) -> str:
            target = page.parent / "made" / f"{page.stem}-{Path(match['name']).name}"
            target.parent.mkdir(exist_ok=True)
            shutil.copyfile(folder / match["name"], target)
            return f"made/{target.name}"

        return _MADE.sub(picture, _FENCE.sub(carried_out, written))


def is_filled(written: str) -> bool:
    """Return whether a page has commands to carry out."""
    return _FENCE.search(written) is not None
