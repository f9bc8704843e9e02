"""Whatever writes a file refuses to write over what it reads, before it computes anything."""

from __future__ import annotations

from pathlib import Path

import pytest

from crankwork import analyse, cli, files, read
from crankwork.description.machine_file import template
from crankwork.errors import CrankworkError

# every command that takes a name for its output, and the endings that it writes
WRITERS = {
    "page": ("html", "htm"),
    "report": ("pdf", "docx", "html"),
    "draw": ("svg", "gif", "mp4", "pdf", "png", "dxf"),
}
REFUSED = "{}: is what this run reads; move it away or choose another name or folder\n"
COMPUTING = ("crankwork.cli.options.analyse_with_progress", "crankwork.description.machine_file.read")


def test_the_commands_that_write_one_file_are_those_tried_here() -> None:
    one_file = {
        name
        for name, command in cli.commands.commands.items()
        if any(option.name == "output" and option.metavar in ("FILE", "NOTE") for option in command.params)
    }
    # `new` reads nothing
    assert one_file == {*WRITERS, "new"}


@pytest.mark.parametrize("overwrite", [(), ("--overwrite",)])
def test_no_command_writes_over_its_input(crankwork, monkeypatch, overwrite) -> None:
    def computed(*_: object, **__: object) -> None:
        raise AssertionError("computed before the place was refused")

    for name in COMPUTING:
        monkeypatch.setattr(name, computed)
    text = template("engine")
    found = {}
    for command, endings in WRITERS.items():
        for ending in endings:
            name = f"{command}.{ending}"
            Path(name).write_text(text, "utf-8")
            Path(f"link.{ending}").unlink(missing_ok=True)
            Path(f"link.{ending}").symlink_to(name)
            for place in (name, f"./{name}", f"link.{ending}"):
                answer = crankwork(command, name, "-o", place, *overwrite)
                expected = (2, "", REFUSED.format(Path(place)))
                if answer != expected or Path(name).read_text("utf-8") != text:
                    found[command, place] = answer
    assert found == {}


@pytest.mark.slow
def test_a_sheet_beside_a_note_is_not_written_over_the_input(crankwork) -> None:
    text = template("four-bar")
    Path("my-sheet-1.svg").write_text(text, "utf-8")
    answer = crankwork("report", "my-sheet-1.svg", "-o", "my.html", "--sheets", "--no-figures", "--overwrite")
    assert (answer.code, answer.out, answer.err) == (2, "", REFUSED.format("my-sheet-1.svg"))
    assert {one.name: one.read_text("utf-8") for one in Path().iterdir()} == {"my-sheet-1.svg": text}


def test_results_in_python_do_not_replace_what_they_were_read_from() -> None:
    text = template("engine")
    for name in ("my.svg", "my.csv"):
        Path(name).write_text(text, "utf-8")
    results = analyse(read("my.svg"))
    for write in (
        lambda: results.write("my.svg", overwrite=True),
        lambda: files.write_files({"my.svg": b"drawn"}, overwrite=True),
        lambda: files.write_new("my.svg", "drawn", overwrite=True),
    ):
        with pytest.raises(CrankworkError, match="is what this run reads"):
            write()
    assert Path("my.svg").read_text("utf-8") == text
    files.write_files({"my.svg": b"saved by who reads it"}, save=True)
    assert Path("my.svg").read_bytes() == b"saved by who reads it"


def test_a_machine_under_a_name_that_the_program_gives_is_kept(crankwork) -> None:
    text = template("slider-crank")
    found = {}
    for at, name in enumerate((".crankwork.json", "UNFINISHED-crankwork.txt", ".crankwork-abcdefgh/my.toml")):
        for overwrite in ((), ("--overwrite",)):
            file = Path(f"out{at}", name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, "utf-8")
            answer = crankwork("run", str(file), "-o", f"out{at}", "--no-figures", *overwrite)
            if answer.code != 2 or not file.is_file() or file.read_text("utf-8") != text:
                found[name, overwrite] = answer
    assert found == {}


def test_a_folder_that_is_named_as_the_machine_is_refused(crankwork) -> None:
    Path("out").mkdir()
    for overwrite in ((), ("--overwrite",)):
        answer = crankwork("run", "out", "-o", "out", *overwrite)
        assert (answer.code, answer.out) == (2, "")
        assert answer.err.startswith("out: is a folder")
