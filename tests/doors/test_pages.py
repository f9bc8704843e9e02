"""What the README, its two translations and the guide show works: files, commands and their answers, Python, links."""

from __future__ import annotations

import re
import shlex
import shutil
import tomllib
from pathlib import Path
from typing import NamedTuple

import pytest

from crankwork.description.machine_file import template

ROOT = Path(__file__).parents[2]
LANDING = {"en": "README.md", "ru": "docs/README.ru.md", "vi": "docs/README.vi.md"}
GUIDE = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs" / "guide").glob("*.md"))
PAGES = [*LANDING.values(), *GUIDE]
# until it is stopped
_GOES_ON = {"studio"}
# what takes longer than a look
_LONG = {"report", "page", "map", "sweep", "optimise", "spread", "solve"}


class Command(NamedTuple):
    """A command of a page, by its words after the name of the program."""

    page: str
    words: tuple[str, ...]


def _text(page: str) -> str:
    return (ROOT / page).read_text("utf-8")


def _blocks(page: str, kind: str) -> list[str]:
    found = re.findall(r"^```(\w*)\n(.*?)^```$", _text(page), re.DOTALL | re.MULTILINE)
    return [text for is_of, text in found if is_of == kind]


def _commands(page: str) -> list[Command]:
    lines = [line for block in _blocks(page, "sh") for line in block.splitlines()]
    found = [tuple(shlex.split(line, comments=True)) for line in lines if line.startswith("crankwork ")]
    return [Command(page, words[1:]) for words in found]


def _set_up(folder: Path) -> None:
    """Lay a machine file and a study where the commands of the pages expect them."""
    (folder / "my.toml").write_text(template("engine"), encoding="utf-8")
    (folder / "shaper.toml").write_text(_blocks("docs/guide/linkages.md", "toml")[0], encoding="utf-8")
    (folder / "examples").symlink_to(ROOT / "examples")
    study = (ROOT / "examples" / "studies" / "million-engines.toml").read_text("utf-8")
    for text, few in {"1_000_000": "4_000", "petrol-cylinder.toml": "examples/studies/petrol-cylinder.toml"}.items():
        assert study.count(f" {text}") + study.count(f'"{text}') == 1, text
        study = study.replace(text, few)
    (folder / "designs.toml").write_text(study, encoding="utf-8")


@pytest.mark.parametrize("language", ["en", *(pytest.param(one, marks=pytest.mark.slow) for one in ("ru", "vi"))])
def test_the_file_of_a_landing_page_gives_what_stands_below_it(crankwork, tmp_path, language) -> None:
    page = LANDING[language]
    (file,), (answer, told) = _blocks(page, "toml"), _blocks(page, "")
    name = told.partition(":")[0]
    (tmp_path / name).write_text(file, encoding="utf-8")
    commands = [command.words for command in _commands(page)]
    assert [words[0] for words in commands] == ["run", "report", "explain"]
    for words in commands:
        assert words[1] == name
        given = crankwork(*words)
        assert given.code == 0, given.err
        if words[0] == "run":
            assert [line for line in answer.splitlines() if line not in given.out.splitlines()] == []
    key = told.split(": ")[1]
    (tmp_path / name).write_text(file.replace("length =", f"{key.rpartition('.')[2]} =", 1), encoding="utf-8")
    assert told in crankwork("check", name, "--lang", language).err


def test_landing_pages_are_short_and_name_what_there_is() -> None:
    project = tomllib.loads(_text("pyproject.toml"))["project"]
    for page in LANDING.values():
        text = _text(page)
        assert len(text) < 6000, page
        scripts = set(re.findall(r"^scripts/(\w+)", text, re.MULTILINE))
        assert scripts == {"demo", "test"}, page
        extras = {one for found in re.findall(r"\[([a-z]+)\](?!\()", "".join(re.findall(r".*pip install.*", text)))
                  for one in found.split(",")}  # fmt: skip
        assert "all" in extras
        assert extras <= project["optional-dependencies"].keys(), page
        assert project["requires-python"] == ">=3.11"
        assert "Python 3.11" in text


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_what_there_is(page) -> None:
    text = re.sub(r"```.*?```", "", _text(page), flags=re.DOTALL)
    links = re.findall(r'(?:\]\(|(?:src|srcset)=")([^)"#]+)', text)
    assert [link for link in links if not (ROOT / page).parent.joinpath(link).exists()] == []


@pytest.mark.parametrize("page", GUIDE)
def test_commands_of_the_guide_are_commands_with_these_options(crankwork, page) -> None:
    wrong = []
    for _, (name, *words) in _commands(page):
        options = {word for word in words if word.startswith("--")}
        if not options <= set(re.findall(r"--[a-z-]+", crankwork(name, "--help").out)):
            wrong.append((name, options))
    # those in sentences too
    for name, rest in re.findall(r"`crankwork (\w+)([^`]*)`", _text(page)):
        answer = crankwork(name, "--help")
        if answer.code or not set(re.findall(r"--[a-z-]+", rest)) <= set(re.findall(r"--[a-z-]+", answer.out)):
            wrong.append((name, rest))
    assert wrong == []


@pytest.mark.parametrize(
    "part", ["short", pytest.param("long", marks=[pytest.mark.slow, pytest.mark.data, pytest.mark.compiled])]
)
def test_commands_of_the_guide_are_run(crankwork, tmp_path, part) -> None:
    _set_up(tmp_path)
    stand_for = {"STUDY.toml": "examples/studies/least-side-force.toml"}
    commands = [one for page in GUIDE for one in _commands(page) if one.words[0] not in _GOES_ON]
    failures = {}
    for command in commands:
        words = [stand_for.get(word, word) for word in command.words]
        if (words[0] in _LONG) != (part == "long"):
            continue
        if words[0] == "new" and "-o" in words:
            (tmp_path / "my.toml").unlink()
        if words[0] == "sweep":
            words[1] = "designs.toml"
        if words[0] == "spread":
            words += ["--set", "rod.length=160 ± 0.1 mm"]
        if words[0] in ("sweep", "optimise"):
            shutil.rmtree(tmp_path / "DIR", ignore_errors=True)
        # what the shell does, and drawing everything as PNG takes long
        words = [word.replace("svg,pdf,png,dxf", "svg") for word in words if word not in (">", "crankwork.schema.json")]
        answer = crankwork(*words)
        if answer.code:
            failures[" ".join(words)] = answer.err
    assert failures == {}


def test_what_a_command_of_the_guide_answers_is_what_it_answers(crankwork, tmp_path) -> None:
    _set_up(tmp_path)
    for command, page in {
        "explain examples/spark-engine.toml side_force --at 390": "docs/guide/commands.md",
        "check shaper.toml": "docs/guide/linkages.md",
    }.items():
        told = crankwork(*command.split()).out
        shown = [block.removeprefix(f"$ crankwork {command}\n") for block in _blocks(page, "")]
        assert f"crankwork {command}" in _text(page)
        assert any(block and f"\n{block}" in f"\n{told}" for block in shown), told


def test_the_mistakes_that_the_guide_shows_are_told_so(crankwork, machine_file) -> None:
    engine = template("engine").replace("\nlength =", "\nlenght =").replace('bore = "85 mm"', "bore = 85")
    v8 = (ROOT / "examples" / "v8-diesel.toml").read_text("utf-8").replace("[1, 5, 4, 2", "[1, 5, 4, 4")
    for page, text in (("docs/guide/commands.md", engine), ("docs/guide/engines.md", v8)):
        told = crankwork("check", machine_file(text=text)).mistakes
        shown = [line for block in _blocks(page, "") for line in block.splitlines() if line.startswith("my.toml:")]
        assert told == shown


def test_the_files_of_the_guide_are_read(crankwork, tmp_path, machine_file) -> None:
    """Those that are a part of a file, in a file."""
    engines, notes = _blocks("docs/guide/engines.md", "toml"), _blocks("docs/guide/notes.md", "toml")
    linkages = _blocks("docs/guide/linkages.md", "toml")
    (measured,) = _blocks("docs/guide/measured-pressure.md", "toml")
    example = (ROOT / "examples" / "spark-engine.toml").read_text("utf-8")
    shown = re.findall(r"^[a-z_]+ = .*?(?=  |$)|^\[.*?\](?=  |$)", engines[0], re.MULTILINE)
    assert [line for line in shown if line not in example] == []
    v8 = (ROOT / "examples" / "v8-diesel.toml").read_text("utf-8")
    lines = [line.partition("#")[0].strip() for line in engines[2].splitlines() if line.strip()]
    assert [line for line in lines if line not in v8] == []
    engine = template("slider-crank").replace('bore = "80 mm"', 'bore = "80 mm"\ncompression_ratio = 9')
    (tmp_path / "card.csv").write_text(
        "angle [deg],p [bar]\n" + "".join(f"{angle},{_pressure(angle):.6f}\n" for angle in range(720)), "utf-8"
    )
    for text in (
        engine + engines[1],
        engine + engines[3],
        *("format = 2\n" + text for text in (engines[4], *linkages)),
        *(f"{engine}{text}" for text in engines[5:]),
        template("engine") + notes[0],
        engine + '[gas]\ncycle = "720 deg"\n' + measured,
    ):
        answer = crankwork("check", machine_file(text=text))
        assert answer.code == 0, answer.err


def _pressure(angle: int) -> float:
    """Return a pressure over the crank angle with compression and expansion about 360 degrees. [bar]"""
    from math import cos, radians, sqrt

    turned = radians(angle)
    travel = 1 - cos(turned) + (1 - sqrt(1 - (0.25 * (1 - cos(turned) ** 2) ** 0.5) ** 2)) / 0.25
    ratio = 9 / (1 + 8 * travel / 2)
    if not 180 < angle < 540:
        return 1.0
    return ratio**1.35 * (1.0 if angle < 360 else 3.0)


@pytest.mark.parametrize("extra", ["none", pytest.param("data", marks=pytest.mark.data)])
def test_the_python_of_the_guide_runs(tmp_path, extra) -> None:
    _set_up(tmp_path)
    names: dict[str, object] = {}
    for block in _blocks("docs/guide/python.md", "python"):
        if "to_xarray" in block and extra == "none":
            continue
        exec(compile(block, "python.md", "exec"), names)  # noqa: S102 - of the guide of this program
    assert (tmp_path / "torque.svg").exists()
    assert (tmp_path / "engine.nc").exists() == (extra == "data")
