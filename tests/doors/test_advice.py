"""What is advised is accepted: suggestions of faulty files are applied, and the file is then right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import crankwork as package
from crankwork.errors import CrankworkError
from crankwork.studio.session import Session
from each import for_each
from machine_texts import POINTS_ENGINE

ENGINE = POINTS_ENGINE
ORDER = '\n[engine]\nlayout = "inline"\ncylinders = 4\nfiring_order = {}\n'
# what stands in the template and what is written in its place; several are several mistakes at once
FAULTY = {
    "no quotes": [('radius = "45 mm"', "radius = 45 mm")],
    "no quotes, a comma": [('mass = "0.55 kg"', "mass = 0,55 kg")],
    "a fraction": [('length = "160 mm"', "ratio = 1/3.5")],
    "quotation marks of a text": [('bore = "85 mm"', "bore = “85 mm”")],
    "a decimal comma": [("small_end_share = 0.275", "small_end_share = 0,275")],
    "a decimal comma of a text": [('"0.55 kg"', '"0,55 kg"')],
    "a Cyrillic letter": [("bore = ", "Вore = ")],
    "Cyrillic letters in quotes": [("mass = \"0.55 kg\"", "\"mаss\" = \"0.55 kg\"")],
    "a unit of two alphabets": [('"45 mm"', '"45 mм"')],
    "a unit that is none": [('"3000 rpm"', '"3000 rmp"')],
    "a speed per second": [('"3000 rpm"', '"314.159 1/s"')],
    "no unit": [('"45 mm"', "45")],
    "a misspelt key": [('radius = "45 mm"', 'raduis = "45 mm"')],
    "a misspelt table": [("[piston]", "[pistn]")],
    "a firing order as text": [("[table]", ORDER.format('"1, 3, 4, 2"') + "[table]")],
    "many of syntax and of values": [
        ('radius = "45 mm"', "radius = 45 mm"), ('mass = "0.55 kg"', "mass = 0,55 kg"),
        ('bore = "85 mm"', "bore = “85 mm”"), ('length = "160 mm"', 'length = "160 мm"'), ("[gas]", "[gаs]"),
    ],
}  # fmt: skip


def advised(line: str, message: str) -> str:
    """Return a line of a file as a message advises it."""
    key = line.partition("=")[0]
    if match := re.search(r"did you mean (\w+)\?|which looks like a Latin one; write (\w+)$", message):
        meant = match[1] or match[2]
        return f"[{meant}]" if line.startswith("[") else f"{meant} ={line.partition('=')[2]}"
    words, value = r"(?:write|did you mean|example|like) (?:straight ones: )?", r"(\w+ = .*?|\".*?\"|\[.*?\]|[\d.]+)"
    if match := re.search(rf"{words}{value}(?:,? or .*|\?.*|, for example.*)?$", message.partition("? ")[0]):
        return match[1] if match[1].startswith(key.strip()) else f"{key}= {match[1]}"
    raise AssertionError(f"no advice in {message}")


def mistakes(text: str) -> dict[int, str]:
    """Return what is wrong with a text, by line."""
    try:
        package.read_machine(text, "f.toml")
    except CrankworkError as error:
        told = [re.match(r"f\.toml:(\d+): (.*)", line) for line in str(error).splitlines()]
        return {int(match[1]): match[2] for match in told if match}
    return {}


@for_each(("name", "changes"), FAULTY.items())
def test_what_is_advised_is_accepted(name, changes):
    text = ENGINE
    for old, new in changes:
        assert text.count(old) >= 1, old
        text = text.replace(old, new, 1)
    found = mistakes(text)
    assert len(found) == len(changes), found
    lines = text.split("\n")
    for number, message in found.items():
        lines[number - 1] = advised(lines[number - 1], message)
    assert mistakes("\n".join(lines)) == {}, name


def test_a_decimal_comma_in_a_list_is_told_in_one_line():
    text = '[crank]\nradius = "45 mm"\nspeed = "60 rpm"\n[rod]\nlength = "160 mm"\n[efficiency]\nchain = [0,98, 0,98]\n'
    found = mistakes(text)
    assert found == {7: "[0,98, 0,98]: the commas separate entries, and decimal marks are points; write [0.98, 0.98]"}
    assert mistakes(text.replace("[0,98, 0,98]", "[0.98, 0.98]")) == {}


def test_a_number_of_python_without_a_unit_may_be_in_either():
    description = package.Description(ENGINE)
    description["crank.radius"] = 0.1
    with pytest.raises(package.InputError, match=r'for example "0.1 mm" or "0.1 m"'):
        description.machine()


def test_a_key_that_a_machine_has_not_is_answered_with_those_like_it():
    results = package.analyse(package.Description(ENGINE).machine())
    with pytest.raises(
        KeyError, match="this machine has no mean_driving_torque by its method, exact; it has mean_torque"
    ):
        results["mean_driving_torque"]


def test_options_of_other_commands_and_entries_of_lists_are_told(crankwork, machine_file):
    name = machine_file()
    assert (
        "--slider: this command has no such option; it belongs to page" in crankwork("run", name, "--slider", "a").err
    )
    assert "write it behind, like crankwork page FILE --slider" in crankwork("--slider", "a", "page", name).err
    boom = (Path(__file__).parents[2] / "examples" / "excavator-boom.toml").read_text("utf-8")
    answer = crankwork("check", machine_file(text=boom), "--set", "driver.law.0.to=3 deg")
    assert "law is a list in this file; write the number of an entry in brackets, law[1] for the first" in answer.err


def test_the_studio_marks_the_lines_of_all_mistakes_of_syntax():
    text = ENGINE.replace('radius = "45 mm"', "radius = 45 mm").replace('bore = "85 mm"', "bore = “85 mm”")
    refusals = Session("vi").answer({"do": "show", "text": text})["refusals"]
    assert [refusal["line"] for refusal in refusals] == [
        number for number, line in enumerate(text.split("\n"), start=1) if "= 45 mm" in line or "“" in line
    ]
