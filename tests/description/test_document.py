"""A machine file is changed as text: the value is new, everything else stays, and the file means what was asked for."""

from __future__ import annotations

import copy
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import crankwork
from crankwork.description.document import Description, load
from crankwork.description.machine_file import Setting, apply_override, read_machine, template, template_names
from crankwork.description.toml_edit import TomlPositions, toml
from crankwork.errors import CrankworkError, InputError, UnknownKeyError
from each import for_each
from machine_texts import POINTS_ENGINE

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
TEXTS = [template(name) for name in template_names()] + [path.read_text("utf-8") for path in EXAMPLES]
ENGINE = POINTS_ENGINE


def comments(text):
    return [line.partition("#")[2] for line in text.split("\n") if "#" in line]


def test_twelve_lines_of_python_change_a_file():
    d = crankwork.load(EXAMPLES[-2])
    d["rod.ratio"] = 0.3
    d.replace({"crank.speed": "2900 rpm", "table.step": "5 deg"})
    assert (d["crank.speed"], d["rod.ratio"]) == ("2900 rpm", 0.3)
    assert comments(d.dump()) == comments(EXAMPLES[-2].read_text("utf-8"))
    assert d.machine().table_step == 5.0
    assert repr(d).startswith("<Description ")


def test_only_the_value_is_new():
    d = Description(ENGINE)
    d["rod.mass"] = "1.1 kg"
    assert d.dump() == ENGINE.replace('mass = "0.90 kg"', 'mass = "1.1 kg"')
    d["gas.points.c.pressure"] = "2.4 MPa"
    d["gas.pieces[3].exponent"] = 1.3
    assert d.dump() == (
        ENGINE.replace('mass = "0.90 kg"', 'mass = "1.1 kg"').replace("2.30 MPa", "2.4 MPa").replace("1.36", "1.3")
    )


def test_what_says_the_same_gives_way_in_its_place():
    d = Description(ENGINE)
    d["rod.ratio"] = 0.28
    assert d.dump() == ENGINE.replace('length = "160 mm"', "ratio = 0.28")
    assert "rod.length" not in d


def test_a_new_key_stands_behind_the_last_one_of_its_table_and_before_what_heads_the_next():
    d = Description('a = 1\n\n# The rod\n[rod]\nlength = "1 m"  # long\n\n# The piston\n[piston]\nmass = "1 kg"\n')
    d["rod.mass"] = "2 kg"
    d["title"] = "x"
    assert d.dump() == (
        'a = 1\ntitle = "x"\n\n# The rod\n[rod]\nlength = "1 m"  # long\nmass = "2 kg"\n\n'
        '# The piston\n[piston]\nmass = "1 kg"\n'
    )


@for_each(
    ("text", "key", "value", "changed"),
    [
        ("# head\n[a]\n", "title", "t", '# head\n\ntitle = "t"\n[a]\n'),
        ("p = {}\n", "p.x", 1, "p = { x = 1 }\n"),
        ("p = { a = 1 } # c\n", "p.x", 1, "p = { a = 1, x = 1 } # c\n"),
        ("a.b = 1 # c\n[d]\n", "a.c", 2, "a.b = 1 # c\na.c = 2\n[d]\n"),
        ("[a]\nb.c = 1\n", "a.b.d", 2, "[a]\nb.c = 1\nb.d = 2\n"),
        ("[a]\n", "b.c", 2, "[a]\n\n[b]\nc = 2\n"),
        ("[a]", "a.b.c.d", 2, "[a]\nb = { c = { d = 2 } }"),
        ("[[l]]\nx = 1\n[[l]]\nx = 2 # two\n", "l[2].x", 3, "[[l]]\nx = 1\n[[l]]\nx = 3 # two\n"),
        ("[[l]]\nx = 1\n# next\n[[l]]\nx = 2\n", "l[1].y", [1, 2], "[[l]]\nx = 1\ny = [1, 2]\n# next\n[[l]]\nx = 2\n"),
        ("v = [1, [2, 3]] # c\n", "v[2]", 4, "v = [1, 4] # c\n"),
        ("[a.b]\nx = 1\n", "a.c", True, "[a.b]\nx = 1\n\n[a]\nc = true\n"),
        ("[a]\nx = 1 # one\ny = 2\n", "a", {"y": 3, "z": 4}, "[a]\ny = 3\nz = 4\n"),
        ("'q r' = 1\n", "t", 'say "x"\x7f', '\'q r\' = 1\nt = "say \\"x\\"\\u007f"\n'),
    ],
)
def test_every_form_of_toml_can_be_changed(text, key, value, changed):
    values = tomllib.loads(text)
    d = Description(text)
    d[key] = value
    assert d.dump() == changed
    apply_override(values, Setting("key", key, value))
    assert tomllib.loads(changed) == values


def test_a_key_goes_with_what_is_said_beside_it():
    d = Description(ENGINE)
    del d["rod.mass"]
    del d["gas.points.d.pressure"]
    del d["crank"]
    lines = [line for line in ENGINE.split("\n") if not line.startswith('mass = "0.90 kg"')]
    start = next(at for at, line in enumerate(lines) if line == "[crank]")
    text = "\n".join(lines[:start] + lines[lines.index("[rod]") :])
    assert d.dump() == text.replace('d  = { angle = "12 deg", pressure = "0.090 MPa" }', 'd  = { angle = "12 deg" }')


@for_each(
    ("text", "left"),
    [
        (
            "[[loads]]\nat = 1\n\n# two\n[[loads]]\nat = 2\n\n[[loads]]\nat = 3\n",
            "# two\n[[loads]]\nat = 2\n\n[[loads]]\nat = 3\n",
        ),
        ("loads = [{ at = 1 }, { at = 2 }]\n", "loads = [{ at = 2 }]\n"),
        ("loads = [{ at = 1 }]\n", "loads = []\n"),
    ],
    ids=["lines", "inline", "only"],
)
def test_an_entry_of_a_list_goes_and_the_others_stay(text, left):
    described = Description(text)
    del described["loads[1]"]
    assert described.dump() == left


def test_a_default_is_given_where_nothing_is_stated():
    d = Description(ENGINE)
    assert d["rod.ratio_definition"] == "r/l"
    assert "rod.ratio_definition" not in d
    assert d["gas.ambient"] == "0.1 MPa"
    assert d["gas.points"]["r"]["angle"] == "0 deg"
    d["gas.points"]["r"]["angle"] = "spoilt"
    assert d["gas.points.r.angle"] == "0 deg"


@for_each("key", ["rod.inertia", "nothing", "gas.points.q", "gas.pieces[99].law", "gas.pieces[1][2]"])
def test_what_is_neither_stated_nor_by_default_is_told(key):
    d = Description(ENGINE)
    with pytest.raises(KeyError, match="does not state"):
        d[key]
    with pytest.raises(UnknownKeyError):
        del d[key]


@for_each("key", ["", "a[", "a[x]", "gas.pieces[99].law", "title.x", "gas[1]"])
def test_a_key_that_is_none_changes_nothing(key):
    d = Description(ENGINE)
    with pytest.raises(CrankworkError):
        d.replace({"rod.mass": "2 kg", key: 1})
    assert d.dump() == ENGINE


def test_a_description_tells_mistakes_on_their_lines():
    d = Description(ENGINE, "my.toml")
    d["rod.mass"] = "2 parsecs"
    with pytest.raises(crankwork.InputError, match=r"my\.toml:17: rod\.mass"):
        d.machine()


WORDS = st.text(st.characters(blacklist_categories=["Cs", "Cc"]), max_size=8)
VALUES = st.recursive(
    st.one_of(WORDS, st.booleans(), st.integers(-(2**40), 2**40), st.floats(allow_nan=False)),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3),
    max_leaves=6,
)


@given(VALUES)
def test_a_value_is_read_as_it_was_written(value):
    assert tomllib.loads(f"v = {toml(value)}")["v"] == value


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_any_change_means_what_was_asked_and_keeps_every_comment(data):
    text = data.draw(st.sampled_from(TEXTS))
    d, values = Description(text), tomllib.loads(text)
    for _ in range(data.draw(st.integers(1, 4))):
        key = data.draw(
            st.sampled_from(sorted(TomlPositions(d.dump()).lines)) | st.sampled_from(["rod.ratio", "title", "x.y"])
        )
        value = data.draw(st.sampled_from([0.25, "75 mm", True, ["a", "b"], {"angle": "1 deg"}]))
        before, wanted = d.dump(), copy.deepcopy(values)
        try:
            apply_override(wanted, Setting("key", key, value))
        except CrankworkError:
            with pytest.raises(CrankworkError):
                d[key] = value
            continue
        if key.endswith("]") and key in TomlPositions(before).ends and not isinstance(value, dict):
            with pytest.raises(CrankworkError, match="is a table"):
                d[key] = value
            continue
        d[key] = value
        values = wanted
        assert tomllib.loads(d.dump()) == values
        span = TomlPositions(before).pairs.get(key)
        if span is not None and "\n" not in before[span.start : span.end]:
            assert [one for one in comments(before) if one not in comments(d.dump())] == []


def test_what_stands_where_a_table_belongs_has_no_values():
    with pytest.raises(UnknownKeyError):
        Description("crank = 1")["crank.speed"]


@for_each(
    ("before", "key"),
    [
        ("guides.bed.through = 1\n", "guides.bed.angle"),
        ("[gas]\npoints.a.angle = 1\nfactor = 1\n", "gas.points.a.pressure"),
        ("[[loads]]\nbetween.a.b = 1\n[[loads]]\nbetween.a.b = 2\n", "loads[2].between.a.c"),
    ],
)
def test_a_key_beside_dotted_keys_stands_in_their_table(before, key):
    description = Description(before)
    description[key] = 7
    assert Description(description.dump())[key] == 7
    assert description.dump().startswith(before)


def test_a_setting_reaches_as_deep_as_a_file_does():
    description = Description("[chambers.cylinder.points.c]\npressure = '2 MPa'\n")
    laid = description.values_with(["chambers.cylinder.points.c.pressure=1.9 MPa"])
    assert laid["chambers"]["cylinder"]["points"]["c"]["pressure"] == "1.9 MPa"
    with pytest.raises(CrankworkError):
        description.values_with([f"{'.'.join('abcdefghi')}=1"])


def test_mistakes_of_the_syntax_and_all_others_are_told_at_once(tmp_path):
    text = 'crank = { radius = "45 mm", speed = "300 rpm" }\nrod.length = 160 mm\npistn.mass = "1 kg"\n'
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    told = []
    for read in (lambda: Description(text, str(path)), lambda: load(path), lambda: read_machine(text, str(path))):
        with pytest.raises(InputError) as raised:
            read()
        told.append(raised.value.lines())
    assert told[0] == told[1] == told[2]
    assert len(told[0]) == 2
