"""A field states its default and when it applies once; reader, refusals and schema say the same of it."""

from __future__ import annotations

import dataclasses
import json
import math
import tomllib

import jsonschema
import pytest

from crankwork.description.keys import CYCLE
from crankwork.description.machine_file import FILES, json_schema, read_machine, template
from crankwork.description.schema import DefaultBy, TableSpec, Values
from crankwork.description.value_types import MeasuredValue, Quantity, Reader
from crankwork.errors import InputError
from crankwork.working_cycle.closed_gas import HeatReleaseData
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.ideal import IdealData
from each import for_each

SCHEMA = json.loads(json_schema())
ENGINE = template("whole-engine").replace('layout = "inline"', 'layout = "V"\nbank_angle = "90 deg"')


def tables(kind):
    if isinstance(kind, TableSpec):
        yield kind
        for entry in kind.keys.values():
            yield from tables(entry.kind)
    else:
        below = getattr(kind, "entry", getattr(kind, "other", None))
        yield from tables(below) if below is not None else ()


DEFAULTS = {
    f"{table.name}.{name}={one}": (entry.kind, one)
    for file in FILES for table in tables(file) for name, entry in table.keys.items() if entry.default is not None
    for one in (entry.default.values.values() if isinstance(entry.default, DefaultBy) else [entry.default])
}  # fmt: skip


@for_each(("kind", "default"), DEFAULTS.values(), ids=DEFAULTS)
def test_a_default_is_what_a_file_could_state(kind, default):
    reader = Reader()
    assert kind.read(default, "key", reader) is not None
    assert reader.problems == []


def quantities(kind):
    """Yield the quantities with a unit that a kind of entry may hold."""
    if isinstance(kind, Quantity):
        yield kind
    for name in ("kind", "entry", "other", "quantity"):
        if (below := getattr(kind, name, None)) is not None and not isinstance(below, str):
            yield from quantities(below)


def test_every_quantity_has_a_floor_and_a_ceiling_that_a_division_bears():
    every = {
        f"{table.name}.{name}": one
        for file in FILES for table in tables(file) for name, entry in table.keys.items()
        for one in quantities(entry.kind)
    }  # fmt: skip
    assert len(every) > 100
    assert {key for key, one in every.items() if not -1e15 <= one.low < one.high <= 1e15} == set()
    assert {key for key, one in every.items() if 0 < abs(one.low) < 1e-18} == set()


def test_what_must_stand_beside_a_key_is_a_key():
    for table in (one for file in FILES for one in tables(file)):
        for entry in table.keys.values():
            decides = [entry.default.key] if isinstance(entry.default, DefaultBy) else []
            around = CYCLE.keys if table.name == "timing" else {}
            assert {*entry.only, *entry.instead_of, *decides} <= {*table.keys, *around}


@for_each(
    ("kind", "room", "names"),
    [
        ("petrol", GrinevetskyData, {}),
        ("otto", IdealData, {}),
        ("wiebe", HeatReleaseData, {"shape": "burning_shape", "adiabatic_exponent": "heat_ratio",
                                    "combustion_start": "burning_advance", "combustion_duration": "burning_duration"}),
    ],
)  # fmt: skip
def test_the_calculation_of_a_cycle_takes_the_same_by_default(kind, room, names):
    stated = Values({"kind": kind}, CYCLE)
    found = {
        one.name: one.default for one in dataclasses.fields(room) if one.default not in (dataclasses.MISSING, None)
    }
    for key in CYCLE.keys:
        name, value = names.get(key, key), stated[key]
        if name in found and key != "cycle" and value not in (None, []):
            is_angle = isinstance(value, MeasuredValue) and value.dimension == "angle"
            number = math.degrees(value.value) if is_angle else stated.si(key)
            assert found[name] == (pytest.approx(number, rel=1e-12) if isinstance(number, float) else number)


def test_what_is_not_given_has_its_default_and_does_not_stand_there():
    values = Values({"pressures": "gauge"}, next(one for file in FILES for one in tables(file) if one.name == "gas"))
    assert values["ambient"] is None
    assert values.but(pressures="absolute").si("ambient") == 101325.0
    assert "ambient" not in values
    assert values["points"] == {}
    assert values["measured"].si("shift") == 0.0


FOREIGN = [
    ('layout = "V"', 'layout = "inline"', "engine.bank_angle", 'means nothing with layout = "inline"'),
    ('layout = "V"', 'layout = "V"\nbank_angles = ["0 deg", "1 deg"]', "engine.bank_angles", 'layout = "V"'),
    ('bank_angle = "90 deg"', "", "engine.bank_angle", "is missing"),
]


@for_each(("old", "new", "key", "told"), FOREIGN)
def test_schema_and_reader_refuse_what_does_not_apply_or_is_missing_for_a_kind(old, new, key, told):
    assert old in ENGINE
    text = ENGINE.replace(old, new, 1)
    assert not jsonschema.Draft202012Validator(SCHEMA).is_valid(tomllib.loads(text))
    with pytest.raises(InputError) as refusal:
        read_machine(text)
    assert any(one.key == key and told in one.message for one in refusal.value.problems)


def test_the_schema_says_default_range_and_unit():
    step = SCHEMA["anyOf"][0]["properties"]["table"]["properties"]["step"]
    assert (step["default"], step["minimum"], step["maximum"], step["unit"]) == ("10 deg", 0.01, 180.0, "deg")
    shown = json.loads(json_schema("ru"))["anyOf"][0]["properties"]["table"]["properties"]["step"]["description"]
    cycle = SCHEMA["anyOf"][0]["properties"]["cycle"]["properties"]
    assert "by default 0.09 MPa with kind = wiebe" in cycle["intake_pressure"]["description"]
    of_ideal = "; only with kind = otto | kind = ideal-diesel | kind = dual | kind = assigned-petrol"
    assert of_ideal in cycle["cut_off"]["description"]
    assert shown.startswith("шаг таблиц; угол; от 0.01 deg до 180 deg")
