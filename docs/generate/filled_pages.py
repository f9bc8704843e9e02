"""Pages whose commands are carried out: each page in an empty folder, as a reader has it.

A fence marked `run` holds commands of a shell; below each stands what it printed. `run 20` keeps the first 20 lines,
`run with WORDS` those with these words. `hidden` runs and shows nothing. `file NAME` writes a file and shows it; with
`of PATH` it is that file of the repository, or the first file that a page shows. `show NAME` shows a file that a
command wrote: from the line that stands in the fence, and as many lines as `show NAME 20` says. `python` runs a
program, whose output follows. A picture `made/NAME` is a file that a command wrote.
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
    r"^```(?P<kind>run|hidden|file|show|python)(?: (?P<what>[^\n]+))?\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL
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


def _shortened(printed: str, which: str | None) -> str:
    lines = printed.rstrip("\n").splitlines()
    if which and not which.isdigit():
        lines = [line for line in lines if re.search(which.removeprefix("with "), line)]
        return "\n".join(["...", *lines, "..."])
    return "\n".join(lines if not which or len(lines) <= int(which) else [*lines[: int(which)], "..."])


def _listing(name: str, written: str) -> str:
    language = {".toml": "toml"}.get(Path(name).suffix, "text")
    return f"```{{code-block}} {language}\n:caption: {name}\n\n{written.rstrip()}\n```"


def _of_repository(path: str) -> str:
    """Return a file of the repository, or the first file that a page of it shows."""
    written = (ROOT / path).read_text(encoding="utf-8")
    shown = re.search(r"^```toml\n(.*?)^```$", written, re.MULTILINE | re.DOTALL)
    return shown[1] if shown and path.endswith(".md") else written


def filled(page: Path, written: str) -> str:
    """Return the text of a page with what its commands print, and put its pictures beside it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(command: str) -> str:
            return _output(["bash", "-c", command], folder, page.name)

        def carried_out(match: re.Match[str]) -> str:
            kind, what, body = match["kind"], match["what"] or "", match["body"]
            match kind:
                case "file":
                    file, _, source = what.partition(" of ")
                    body = _of_repository(source) if source else body
                    (folder / file).write_text(body, encoding="utf-8")
                    return _listing(file, body)
                case "show":
                    file, _, most = what.partition(" ")
                    shown = (folder / file).read_text(encoding="utf-8")
                    return _listing(file, _shortened(shown[shown.index(body.strip()) :], most))
                case "python":
                    printed = _shortened(_output([sys.executable, "-c", body], folder, page.name), what)
                    return f"```python\n{body}```\n\n```text\n{printed}\n```" if printed else f"```python\n{body}```"
                case "hidden":
                    run(body)
                    return ""
            parts = []
            for command in body.strip().splitlines():
                printed = _shortened(run(command), what)
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
