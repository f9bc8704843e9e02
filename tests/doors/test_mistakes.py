"""Mistakes in a machine file: each is told on its line, with what to write instead, all at once."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from crankwork.description.machine_file import template
from each import for_each

# the original line of the template, what a user writes, the key blamed, and words of the advice
MISTAKES = {
    "unknown key": ('radius = "45 mm"', 'radiuss = "45 mm"', "crank.radiuss", "unknown key; did you mean radius?"),
    "key of another table": ("[piston]", '[piston]\nbore = "8 cm"', "piston.bore", "did you mean cylinder.bore?"),
    "unknown key like none": ("[piston]", "[piston]\ncolour = 3", "piston.colour", "unknown key; known here: mass"),
    "unknown table": ("[cylinder]", "[cylindre]", "cylindre", "unknown table; did you mean cylinder?"),
    "unknown table like none": ("[piston]", "[xyz]\n[piston]", "xyz", "unknown table; known here: title"),
    "unknown unit": ('"3000 rpm"', '"3000 rmp"', "crank.speed", '"rmp" is not a unit known here; did you mean "3000 r'),
    "another dimension": ('"45 mm"', '"45 kg"', "crank.radius", '"kg" measures mass; length is wanted: mm'),
    "bare number": ('"45 mm"', "45", "crank.radius", '45 has no unit; write it as text with a unit, for '),
    "number as text": ("9.0", '"9.0"', "cylinder.compression_ratio", '"9.0" must be a plain number without quotes'),
    "decimal comma": ('"0.55 kg"', '"1,1 kg"', "piston.mass", 'write "1.1 kg", or put decimal_mark = ","'),
    "power tower": ('"45 mm"', '"9**9**9 mm"', "crank.radius", "length is wanted: mm"),
    "nan": ("0.275", "nan", "rod.small_end_share", "out of range; write a number from 0 to 1"),
    "inf": ("0.275", "inf", "rod.small_end_share", "out of range; write a number from 0 to 1"),
    "minus inf without unit": ('"45 mm"', "-inf", "crank.radius", '-inf has no unit; write it as text with a unit'),
    "nan with unit": ('"45 mm"', '"nan mm"', "crank.radius", 'write it like "30 mm"'),
    "huge": ('"45 mm"', '"1e999 mm"', "crank.radius", "too large"),
    "huge mass per area": ('"0.55 kg"', '"1e200 g/cm2"', "piston.mass", "out of range"),
    "huge integer": ("0.275", "0x" + "f" * 4000, "rod.small_end_share", "out of range; write a number from 0 to 1"),
    "huge bare integer": ('"45 mm"', "0x" + "f" * 4000, "crank.radius", 'for example "30 mm"'),
    "negative mass": ('"0.55 kg"', '"-0.55 kg"', "piston.mass", 'write at least "0 kg"'),
    "negative length": ('"45 mm"', '"-45 mm"', "crank.radius", 'write at least "0.001 mm"'),
    "short rod": ('length = "160 mm"', 'length = "40 mm"', "rod.length", "it misses 5 mm; lengthen it"),
    "offset too large": ('bore = "85 mm"', 'bore = "85 mm"\noffset = "125 mm"', "rod.length", "it misses 10 mm"),
    "l/r for r/l": ('length = "160 mm"', "ratio = 4", "rod.ratio", 'write 0.25, or add ratio_definition = "l/r"'),
    "no clearance": ("compression_ratio = 9.0", "", "cylinder", "gas needs its smallest"),
    "clearance below zero": ("compression_ratio = 9.0", 'clearance_volume = "-1 cm3"', "cylinder.clearance_volume",
                             'write at least "0 cm3"'),
    "compression ratio 1": ("= 9.0", "= 1", "cylinder.compression_ratio", "write a number from 1.001 to 100"),
    "ratio and length": ('length = "160 mm"', 'length = "160 mm"\nratio = 0.28', "rod.ratio", "same as length; keep"),
    "inertia of a rod like the crank": ('"exact" ', '"series:3"\ninertia_rod_ratio = 1.0', "method.inertia_rod_ratio",
                                        "write a smaller ratio, like 0.25"),
    "no speed": ('speed = "3000 rpm"', "", "crank.speed", 'is missing; write speed = "2300 rpm"'),
    "no radius": ('radius = "45 mm"', "", "crank.radius", 'write radius = "30 mm" or stroke = "30 mm"'),
    "no rod length": ('length = "160 mm"', "", "rod.ratio", 'write ratio = 0.25 or length = "30 mm"'),
    "no bore": ('bore = "85 mm"', "", "cylinder.bore", 'is missing; write bore = "30 mm"'),
    "no volume": ("compression_ratio = 9.0", "", "cylinder", "write compression_ratio = 9 or clearance_volume"),
    "mass nowhere": ("small_end_share = 0.275", "", "rod.mass", 'add centre_of_mass = "50 mm"'),
    "share of nothing": ('mass = "0.90 kg"', "", "rod.small_end_share", 'add mass = "1 kg"'),
    "centre beyond the pin": ("small_end_share = 0.275", 'centre_of_mass = "170 mm"', "rod.centre_of_mass", "160 mm"),
    "cycle as number": ('cycle = "720 deg"', "cycle = 720", "gas.cycle", 'write "720 deg" or "360 deg"'),
    "ambient of gauge": ('"absolute"', '"gauge"', "gas.ambient", 'leave it out, or write pressures = "absolute"'),
    "method": ('kinematics = "exact"', 'kinematics = "foo"', "method.kinematics", "exact, textbook or series:N"),
    "truth as text": ("# weights = true", 'weights = "yes"', "method.weights", "true or false, without quotes"),
    "date": ('"45 mm"', "1979-05-27", "crank.radius", "must be a number with a unit as text"),
    "date as text": ('title = "Four-stroke engine"', "title = 1979-05-27", "title", "must be text in quotes"),
    "table as text": ("[piston]\nmass", "[piston.mass]\nkg", "piston.mass", "must be a number with a unit as text"),
    "angle beyond the cycle": ('["372 deg"]', '["10 deg", "721 deg"]', "table.special_angles[2]", "at most"),
    "one angle": ('["372 deg"]', '"372 deg"', "table.special_angles", 'must be a list in square brackets, like ["'),
    "control characters": ('"Four-stroke engine"', '"a\\u001b[31mb"', "title", "control character; write plain text"),
    "letters that turn others": ('"Four-stroke engine"', '"a\\u202eb"', "title", "control character; write plain"),
    "line break": ('"Four-stroke engine"', '"a\\nb"', "title", "line break"),
    "long title": ('"Four-stroke engine"', '"' + "x" * 1000 + '"', "title", "too long, 1000 characters; write at most"),
    "unknown point": ('["d", "a"]', '["d", "aa"]', "gas.pieces[2].points[2]", 'no point "aa" in [gas.points]; did you'),
    "gap": ('["b1", "b", "e"]', '["b", "e"]', "gas.pieces[6]", "fill the gap"),
    "point is text": ('r2 = { angle = "720 deg" }', 'r2 = "720 deg"', "gas.points.r2", "must be a table"),
    "few points": ('points = ["d", "a"]', 'points = ["d"]', "gas.pieces[2].points", "has 1 entries; write at least 2"),
    "clearance of a barrel": ("compression_ratio = 9.0", 'clearance_volume = "1 m3"', "cylinder.clearance_volume",
                              "times the swept volume of"),
    "pressure beside no rod": ("[gas]", '[gas]\nback_pressure = "1 bar"', "gas.back_pressure", "give cylinder.piston"),
    "rod beside no pressure": ("[cylinder]", '[cylinder]\npiston_rod_diameter = "20 mm"',
                               "cylinder.piston_rod_diameter", "give gas.back_pressure ="),
    "exponent missing": ("exponent = 1.36", "", "gas.pieces[3].exponent", "write exponent = 1.35"),
    "going backwards": ('["c1", "c", "z"]', '["c1", "z", "c"]', "gas.pieces[4].points", "rising crank angles"),
    "beyond the next dead centre": ('"180 deg", pressure = "0.090 MPa"', '"540 deg", pressure = "0.090 MPa"',
                                    "gas.pieces[3]", "goes backwards, from 540 to 345 deg; order its points"),
    "not from zero": ('["r", "d"]', '["d", "a"]', "gas.pieces[1]", "12 deg, but the pieces before it end at 0"),
    "not to the end": ('["e", "r2"]', '["e", "e"]', "gas.pieces", "the cycle is closed at 720 deg"),
    "not closed": ('"570 deg", pressure = "0.115 MPa"', '"570 deg", pressure = "3 MPa"', "gas.pieces", "not close"),
    "quoted key": ("[piston]", '[piston]\n"a\\nb" = 1', "piston.a\\nb", "unknown key"),
}  # fmt: skip


@for_each("mistake", MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake_is_told_once_on_its_line_with_what_to_write(
    crankwork, machine_file, check_mistakes, mistake
) -> None:
    old, new, key, advice = mistake
    answer = crankwork("check", machine_file((old, new)))
    check_mistakes(answer)
    assert len(answer.mistakes) == 1, answer.err
    told = re.fullmatch(r"my\.toml:(\d+): ([^:]+): (.+)", answer.mistakes[0])
    assert told, answer.err
    assert (told[2], advice in told[3]) == (key, True), answer.err
    assert int(told[1]) in _lines_of(new, key)


def _lines_of(new: str, key: str) -> set[int]:
    """Return the lines that may be blamed: the changed ones, or those of the key or the table around it."""
    text = Path("my.toml").read_text("utf-8")
    first = text[: text.index(new)].count("\n") + 1 if new else 0
    changed = set(range(first, first + new.count("\n") + 1)) if new else set()
    table = re.sub(r"\[\d+\].*", "", key)
    names = (table, table.rpartition(".")[0])
    named = {
        number for number, line in enumerate(text.split("\n"), start=1) if line.split("#")[0].strip(" []") in names
    }
    last = table.rpartition(".")[2]
    return changed | named | {n for n, line in enumerate(text.split("\n"), start=1) if re.match(rf"{last}\s*=", line)}


def test_all_mistakes_are_told_at_once_in_the_order_of_the_lines(crankwork, machine_file, check_mistakes) -> None:
    changes = [(old, new) for old, new, *_ in (MISTAKES[name] for name in (
        "unknown unit", "decimal comma", "l/r for r/l", "nan", "compression ratio 1", "cycle as number",
        "unknown point", "truth as text", "one angle", "long title", "ambient of gauge",
    ))]  # fmt: skip
    answer = crankwork("run", machine_file(*changes), "-o", "out")
    check_mistakes(answer)
    lines = [int(line.split(":")[1]) for line in answer.mistakes]
    assert len(lines) == 11
    assert lines == sorted(lines)


def test_what_follows_from_a_mistake_is_not_told_as_another(crankwork, machine_file) -> None:
    changes = [('bore = "85 mm"', 'bore = "85 kg"'), ('"0.55 kg"', '"12 g/cm2"')]
    assert len(crankwork("check", machine_file(*changes)).mistakes) == 1


def test_mistakes_in_a_misspelt_table_are_told_with_it(crankwork, machine_file) -> None:
    answer = crankwork("check", machine_file(("[crank]", "[crnk]"), ('"45 mm"', "45")))
    first, second = answer.mistakes
    assert "crnk: unknown table; did you mean crank?" in first
    assert "crnk.radius: 45 has no unit" in second


def test_thousands_of_mistakes_are_counted_not_listed(crankwork, machine_file, check_mistakes) -> None:
    text = "".join(f"wrong_{number} = {number}\n" for number in range(12_000)) + template("slider-crank")
    answer = crankwork("check", machine_file(text=text))
    check_mistakes(answer)
    assert len(answer.mistakes) == 51
    assert "11950 more mistakes; correct these first" in answer.mistakes[-1]


def test_a_decimal_comma_is_read_where_the_file_says_so(crankwork, machine_file) -> None:
    dots = crankwork("run", machine_file(name="slider-crank"), "--json")
    text = template("slider-crank").replace("0.8 kg", "0,8 kg").replace("0.275 ", '"0,275" ')
    commas = crankwork("run", machine_file(('# decimal_mark = ","', 'decimal_mark = ","'), text=text), "--json")
    assert dots.results == commas.results


SYNTAX = {
    "unit without quotes": ("[crank]\nradius = 75 mm", 2, 'needs quotes: radius = 75 mm; write radius = "75 mm"'),
    "key twice": ('title = "a"\ntitle = "b"', 2, 'stands twice: title = "b"; keep one'),
    "table twice": ("[crank]\n[rod]\n[crank]", 3, "stands twice: [crank]; keep one"),
    "no value": ("[crank]\nradius =", 2, "is not valid TOML: radius =; write key ="),
    "open text": ('title = "abc', 1, "is not valid TOML"),
    "ends early": ("a = [", 1, "is not valid TOML"),
    "a sentence": ("the crank is 45 mm long", 1, "is not valid TOML"),
    "impossible date": ("a = 2021-02-30", 1, "is not valid TOML"),
    "4,000 digits and more": ("a = " + "9" * 4090, 1, "is missing"),
}


@for_each(("text", "line", "advice"), SYNTAX.values(), ids=list(SYNTAX))
def test_text_that_is_no_toml_is_refused_on_its_line(
    crankwork, machine_file, check_mistakes, text, line, advice
) -> None:
    answer = crankwork("check", machine_file(text=text))
    check_mistakes(answer)
    assert advice in answer.err
    assert answer.mistakes[0].startswith(f"my.toml:{line}: ")


@for_each(
    ("line", "written"),
    [
        ("radius = “50 mm”", 'radius = "50 mm"'),
        ("radius = «50 mm»", 'radius = "50 mm"'),
        ("[xi lanh]", '["xi lanh"]'),
    ],
)
def test_quotation_marks_of_a_text_and_names_of_two_words_are_written_as_toml_has_them(crankwork, line, written):
    Path("a.toml").write_text(f"{line}\n", encoding="utf-8")
    told = crankwork("check", "a.toml").err.splitlines()[0]
    assert told.startswith("a.toml:1: ")
    assert told.endswith(written)
    tomllib.loads(written)
