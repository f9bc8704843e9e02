"""The JSON Schema, the templates and the examples say the same as the reader."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import jsonschema
import pytest

import crankwork
from crankwork.description.machine_file import (
    TEMPLATES,
    file_keys,
    json_schema,
    read_machine,
    template,
    template_names,
)
from crankwork.description.schema import ListOf, MapOf, NameOr, Nested, TableSpec
from crankwork.errors import CrankworkError
from crankwork.locale import texts
from crankwork.study.study_file import study_schema
from each import for_each
from machine_texts import POINTS_ENGINE

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
WRITTEN = sorted((Path(crankwork.__file__).parent / TEMPLATES).glob("*.toml"))
TEXTS = {name: template(name) for name in template_names()} | {path.stem: path.read_text("utf-8") for path in EXAMPLES}
SCHEMA = json.loads(json_schema())
STUDIES = json.loads(study_schema())
VALIDATOR, OF_STUDIES = (jsonschema.Draft202012Validator(one) for one in (SCHEMA, STUDIES))
STUDY_FILES = [
    path for path in sorted(EXAMPLES[0].parent.glob("studies/*.toml")) if "[vary]" in path.read_text("utf-8")
]


@pytest.mark.slow
def test_the_schema_is_a_json_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    jsonschema.Draft202012Validator.check_schema(STUDIES)


STUDY = """
machine = "machine.toml"
[designs]
drawing = "sobol"
count = 64
[vary]
crank.radius = { from = "40 mm", to = "50 mm" }
rod.length = "200 ± 1 mm"
[objectives]
joint_force_max.B = "minimise"
"""


@for_each("text", [STUDY, *(path.read_text("utf-8") for path in STUDY_FILES)])
def test_studies_follow_their_schema(text) -> None:
    OF_STUDIES.validate(tomllib.loads(text))


@for_each(
    ("old", "new"),
    [
        ("sobol", "sobel"),
        ("count = 64", "count = 0"),
        ("count", "cuont"),
        ("minimise", "small"),
        ('machine = "machine.toml"', ""),
        ('"200 ± 1 mm"', "200"),
        ("[objectives]", "[search]\nway = 'luck'\n[objectives]"),
    ],
)
def test_what_studies_are_refused_for_their_schema_refuses_too(old, new) -> None:
    assert old in STUDY
    assert not OF_STUDIES.is_valid(tomllib.loads(STUDY.replace(old, new, 1)))


@for_each("text", TEXTS.values(), ids=TEXTS)
def test_templates_and_examples_follow_the_schema_and_the_reader_and_use_documented_keys_only(text) -> None:
    values = tomllib.loads(text)
    VALIDATOR.validate(values)
    assert read_machine(text).title
    assert list(_undocumented(values, file_keys(values), "")) == []


@for_each(
    "wrong",
    [
        "crank = {radius = 45}",
        "crank = {radiuss = '45 mm'}",
        "gas = {cycle = '700 deg'}",
        "rod = {ratio = -1}",
        "x = 1",
    ],
)
def test_what_the_reader_refuses_the_schema_refuses_too(wrong) -> None:
    values = tomllib.loads(template("slider-crank")) | tomllib.loads(wrong)
    assert not VALIDATOR.is_valid(values)
    with pytest.raises(CrankworkError):
        read_machine(wrong)


@for_each("key", ["two kinds", "nothing"])
def test_a_file_is_of_one_kind_only(key) -> None:
    values = {} if key == "nothing" else tomllib.loads(template("engine")) | tomllib.loads(template("four-bar"))
    assert not VALIDATOR.is_valid(values)


@for_each(
    ("chain", "fits"),
    [
        ([0.98], True), ([0.98, [0.9, 0.8], 1], True), ([], False), ([[]], False), ([0.9, [[0.8]]], False),
        ([1.2], False), ([0], False), ("0.9", False), (["0.9"], False),
    ],
)  # fmt: skip
def test_a_chain_of_efficiencies_is_the_same_to_schema_and_reader(chain, fits) -> None:
    values = tomllib.loads(template("four-bar")) | {"efficiency": {"chain": chain}}
    assert VALIDATOR.is_valid(values) == fits
    text = f"{template('four-bar')}\n[efficiency]\nchain = {json.dumps(chain)}\n"
    if fits:
        assert read_machine(text)
    else:
        with pytest.raises(CrankworkError, match=r"efficiency\.chain"):
            read_machine(text)


def _undocumented(value, kind, path):
    match kind:
        case TableSpec() if isinstance(value, dict):
            for name, one in value.items():
                if name not in kind.keys or not kind.meaning(name, "en"):
                    yield f"{path}.{name}"
                else:
                    yield from _undocumented(one, kind.keys[name].kind, f"{path}.{name}")
        case MapOf():
            for name, one in value.items():
                yield from _undocumented(one, kind.entry, f"{path}.{name}")
        case Nested() | NameOr():
            assert not isinstance(value, dict)
        case ListOf():
            for one in value:
                yield from _undocumented(one, kind.entry, path)


COMMENTED = re.compile(r"# (?P<key>\w+) = (?P<value>\"[^\"]*\"|\[[^\]]*\]|[\w.]+)")
ALTERNATIVE = re.compile(r"(?:or|add) (?P<key>\w+) = (?P<value>\"[^\"]*\"|[\d.]+)")


# measured pressures need a file beside them
HEADER, ANY_HEADER = re.compile(r"# \[+(?!gas)[a-z_.]+\]"), re.compile(r"# \[+[a-z_.]+\]")


def _header_above(lines: list[str], number: int) -> int | None:
    """Return the line of the commented table header that a commented line belongs to."""
    while number > 0 and lines[number].startswith("# "):
        number -= 1
        if ANY_HEADER.match(lines[number]):
            return number
    return None


def _comments():
    """Give every setting that stands in a comment of a template: alone on a line, or after `or`."""
    for name in template_names():
        lines = template(name).split("\n")
        for number, line in enumerate(lines):
            if HEADER.match(line):
                yield name, number, line.removeprefix("# ")
            if _header_above(lines, number) is not None:
                continue
            alone = COMMENTED.match(line)
            if alone and "gas.measured" not in "".join(lines[max(0, number - 3) : number]):
                yield name, number, line.removeprefix("# ")
            for other in ALTERNATIVE.finditer(line.partition("#")[2]):
                key, value = other["key"], other["value"]
                if line.lstrip().startswith("#") or key == "ratio_definition":
                    continue
                yield name, number, f"{key} = {value}"


# what a setting needs or takes the place of, as the comment beside it says
GOES_WITH = {
    "piston_rod_diameter": {"[gas]": '[gas]\nback_pressure = "0.1 MPa"'},
    "counterweight": {"rotating_share": "", "reciprocating_share": ""},
    "power": {"bore": "", "radius": ""},
}


@pytest.mark.slow
@for_each(("name", "number", "line"), list(_comments()))
def test_every_setting_in_a_comment_of_a_template_can_be_used(name, number, line) -> None:
    lines = template(name).split("\n")
    is_alternative = not lines[number].startswith("#")
    for below in range(number + 1, len(lines)) if HEADER.match(lines[number]) else ():
        if not lines[below].startswith("# "):
            break
        lines[below] = lines[below].removeprefix("# ")
    lines[number] = line
    for old, new in GOES_WITH.get(line.partition(" ")[0], {}).items():
        lines = [new if one.startswith(old) else one for one in lines]
    # a zero, and a decimal mark where no comma stands, change nothing
    is_neutral = '"0 ' in line or "decimal_mark" in line
    assert is_alternative or is_neutral or read_machine("\n".join(lines)) != read_machine(template(name))
    assert read_machine("\n".join(lines)).title


def test_comments_of_the_templates_are_found() -> None:
    assert len(list(_comments())) >= 50


@for_each(
    ("name", "key", "alternative"),
    [
        ("engine", 'radius = "45 mm"', 'stroke = "90 mm"'),
        ("engine", 'length = "160 mm"', "ratio = 0.28125"),
        ("engine", "small_end_share = 0.275", 'centre_of_mass = "44 mm"'),
        ("slider-crank", "small_end_share = 0.275", 'centre_of_mass = "55 mm"'),
        ("slider-crank", 'length = "200 mm"', "ratio = 0.25"),
        ("compressor", "small_end_share = 0.3", 'centre_of_mass = "54 mm"'),
    ],
)
def test_an_alternative_in_a_comment_is_the_same_machine(name, key, alternative) -> None:
    text = template(name)
    assert key in text
    assert alternative in text
    one, other = read_machine(text), read_machine(text.replace(key, alternative, 1))
    assert one.mechanism == other.mechanism
    assert (one.masses is None) == (other.masses is None)
    if one.masses is not None and other.masses is not None:
        assert one.masses.reciprocating == pytest.approx(other.masses.reciprocating, rel=1e-12)


def test_a_measured_pressure_takes_the_place_of_points_and_pieces(tmp_path) -> None:
    text = POINTS_ENGINE
    start, end = text.index("[gas.points]"), text.index("# [gas.measured]")
    tail = "\n".join(line.removeprefix("# ") if 0 < number < 4 else line for number, line in enumerate(
        text[end:].removeprefix("# ").split("\n"))
    )  # fmt: skip
    (tmp_path / "pressure.csv").write_text("".join(f"{a},{1 + a % 360 / 100}\n" for a in range(0, 721, 5)), "utf-8")
    machine = read_machine(text[:start] + tail, folder=tmp_path)
    assert machine.gas is not None
    assert machine.gas.measured is not None
    assert machine.gas.angle_shift == 0.0


def _names(schema: object) -> set[str]:
    """Return the keys and the words that machine files may hold."""
    if isinstance(schema, list):
        return set().union(*map(_names, schema))
    if not isinstance(schema, dict):
        return set()
    own = {*schema.get("properties", {}), *map(str, schema.get("enum", ()))}
    return own.union(*map(_names, schema.values()))


@for_each("path", WRITTEN, ids=lambda path: path.stem)
def test_what_a_template_says_in_words_stands_in_the_languages(path) -> None:
    known = _names(SCHEMA) | {"exact", "textbook", "series", "n1", "n2", "p_a", "p_z", "p_r", "true"}
    comments = " ".join(re.findall(r"#(.*)", path.read_text("utf-8")))
    plain = re.sub(r"\{[a-z][\w.]*\}|\"[^\"]*\"", "", comments)
    assert {word for word in re.findall(r"[^\W\d]\w+(?:-\w+)*", plain) if word not in known} == set()


@for_each("language", ["ru", "vi"])
@for_each("name", template_names())
def test_a_template_states_the_same_in_every_language(name, language) -> None:
    english, other = template(name), template(name, language)
    values, others = tomllib.loads(english), tomllib.loads(other)
    assert values.pop("title") != others.pop("title")
    if "school" in values.get("cycle", {}):
        # which construction rounds the corners is that of the books of a language
        assert (values["cycle"].pop("school"), others["cycle"].pop("school")) == ("ru", language)
    assert values == others
    assert read_machine(other).title


def test_every_comment_of_the_templates_is_translated() -> None:
    english = texts("templates", "en")
    assert [
        (name, language) for language in ("ru", "vi") for name, said in texts("templates", language).items()
        if said == english[name] or re.findall(r"\d+", said) != re.findall(r"\d+", english[name])
    ] == []  # fmt: skip
