"""A file written out is read again and gives the same numbers."""

from __future__ import annotations

import math
import re
import runpy
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from crankwork import CrankGrid, analyse, read, template
from crankwork.analysis.cylinder_forces import traced_cylinder
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.description.shorthand import expanded
from crankwork.errors import CrankworkError, InputError
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Input, in_order
from each import for_each
from expansions import ROOT, differences, machine_files, of_linkage
from machine_texts import POINTS_ENGINE
from shown import in_parts

plausible_file = runpy.run_path(str(ROOT / "tests" / "doors" / "plausible.py"))["plausible_file"]
FILES = machine_files("examples", "tests/machines")
# machines whose pressures follow from heights or stages cannot be compared, their results can
TRACED = ("triplex-pump", "two-stage-compressor")
# column of a crank gear, and that of the linkage that it stands for
COLUMNS = {
    "piston_displacement": ("slider_displacement.piston", 1),
    "piston_velocity": ("slider_velocity.piston", 1),
    "piston_acceleration": ("slider_acceleration.piston", 1),
    "cylinder_volume": ("cylinder_volume.cylinder", 1),
    "gas_pressure": ("gas_pressure.cylinder", 1),
    "side_force": ("normal_force.piston", 1),
    "crank_torque": ("balancing_torque", -1),
    "reduced_inertia_1": ("reduced_inertia_1", 1),
}
VALUES = {
    "indicated_work": "indicated_work.cylinder",
    "indicated_power": "indicated_power.cylinder",
    "swept_volume": "swept_volume.cylinder",
    "clearance_volume": "clearance_volume.cylinder",
    "flywheel_inertia": "flywheel_inertia.exact",
}


def kind(text):
    values = tomllib.loads(text)
    if "crank" in values and "transfer" not in values and "rod" in values:
        method = values.get("method", {}).get("kinematics", "exact")
        return ("engine" if "engine" in values else "gear") if method == "exact" else "approximate"
    return "transfer" if "transfer" in values else "linkage"


def of_kind(wanted, few=(), but=()):
    """Return the names of files of a kind, the few and the others; `but`: those that are like others."""
    names = [name for name, text in FILES.items() if kind(text) == wanted and name not in but]
    assert set(few) <= set(names)
    return list(few), [name for name in names if name not in few]


def written(tmp_path, text, name="machine"):
    path = tmp_path / f"{name}.toml"
    path.write_text(text, "utf-8")
    return path


def numbers_of_a_gear_are_those_of_its_linkage(tmp_path, text):
    path = written(tmp_path, text)
    out = expanded(path)
    again = written(tmp_path, out, "again")
    assert expanded(again) == out
    gear, linkage = analyse(read(path)), of_linkage(read(again))
    for key, (other, sign) in COLUMNS.items():
        if key in gear.columns:
            size = np.max(np.abs(gear.columns[key]))
            assert sign * linkage.columns[other] == pytest.approx(gear.columns[key], rel=1e-9, abs=1e-9 * size), key
    for key, other in VALUES.items():
        if key in gear.summary:
            assert linkage.summary[other] == pytest.approx(gear.summary[key], rel=1e-9), key


@in_parts("name", *of_kind("gear", ("engine", "leaning-compressor", "two-stroke-ports")))
def test_a_crank_gear_is_written_out_as_the_linkage_that_it_is(tmp_path, name):
    numbers_of_a_gear_are_those_of_its_linkage(tmp_path, FILES[name])


@for_each(
    ("name", "changes"),
    [
        ("engine", {"[method]\n": "[method]\npi = 3.14\nweights = true\n"}),
        ("engine", {"[table]": '[flywheel]\nfluctuation = 0.02\ninertia = "0.3 kg*m2"\n[table]'}),
        ("compressor", {
            "# piston_rod_diameter": "piston_rod_diameter", "[gas]": '[gas]\nback_pressure = "0.1 MPa"',
            'bore = "100 mm"': 'bore = "100 mm"\noffset = "-20 mm"\ninclination = "30 deg"', "# weights": "weights",
            'mass = "1.4 kg"': 'mass = "10 g/cm2"',
        }),
        ("slider-crank", {
            "small_end_share = 0.275": 'small_end_share = 0.275\nradius_of_gyration = "89 mm"',
            "# angular_acceleration = \"0 ": "angular_acceleration = \"50 ", "# mass = \"2 kg\"": 'mass = "2 kg"',
        }),
        ("slider-crank", {'kinematics = "exact"': 'kinematics = "exact"\nrod = "two-mass"'}),
        ("slider-crank", {
            'mass = "1.2 kg"': 'small_end_mass = "0.3 kg"',
            "small_end_share": 'big_end_mass = "1 kg"\n# small_end_share',
        }),
    ],
)  # fmt: skip
def test_every_part_of_a_crank_gear_is_written_out(tmp_path, name, changes):
    text = template(name)
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new, 1)
    numbers_of_a_gear_are_those_of_its_linkage(tmp_path, text)


# column of each cylinder of an engine, and that of the linkage that the engine stands for
OF_CYLINDERS = {
    "piston_displacement": "slider_displacement.piston_",
    "cylinder_volume": "cylinder_volume.cylinder_",
    "gas_pressure": "gas_pressure.cylinder_",
    "side_force": "normal_force.piston_",
}


def numbers_of_an_engine_are_those_of_its_linkage(tmp_path, text, settings=()):
    path = written(tmp_path, text)
    out = expanded(path, settings)
    again = written(tmp_path, out, "again")
    assert expanded(again) == out
    machine = read(path, settings)
    engine, linkage = analyse(machine), of_linkage(read(again))
    whole = multi_cylinder_engine(traced_cylinder(machine, machine.method))
    # beside the corners of diagrams, where one side or the other is meant
    degrees = np.arange(0.3, machine.cycle, 7.5)

    def same(found, wanted, what):
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.max(np.abs(wanted))), what

    def column(key):
        return linkage.columns_at(degrees, [key])[key]

    # what the engine gives is what the driver need not, who also speeds up the flywheel
    torque = engine.columns_at(degrees, ["total_torque"])["total_torque"]
    same(-column("balancing_torque"), torque - machine.drive.inertia * machine.angular_acceleration, "torque")
    for key, other in OF_CYLINDERS.items():
        if whole.has(key):
            own = whole.each(key, degrees)
            if key == "side_force":
                # the wall of a master rod bears what articulated ones pass on to it
                for number in whole.has("knuckle_side_force"):
                    passed = whole.of(number, "knuckle_side_force")
                    own[whole.layout.places[number - 1].master - 1] += Program({"": passed})(
                        CrankGrid.from_degrees(degrees)
                    )[""]
            for number, values in enumerate(own, start=1):
                same(column(f"{other}{number}"), values, f"{key}.{number}")
    for key in (one for one in engine.trace if one.startswith("crankpin_load.") and one.count(".") == 1):
        pin = key.replace("crankpin_load.", "A")
        names = [one for one in linkage.trace if re.fullmatch(rf"joint_force_x\.{pin}(_rod_\d+)?", one)]
        x, y = (sum(column(one.replace("_x", part)) for one in names) for part in ("_x", "_y"))
        same(np.hypot(x, y), engine.columns_at(degrees, [key])[key], key)
    whole_inertia = engine.trace.get("reduced_inertia")
    if whole_inertia is not None:
        same(column("reduced_inertia"), Program({"": whole_inertia})(CrankGrid.from_degrees(degrees))[""], "inertia")
    assert linkage.summary["mean_torque"] == pytest.approx(work_per_angle(engine, machine), rel=1e-9)


def work_per_angle(engine, machine):
    """Return the mean torque of the gas."""
    return engine.summary["indicated_power"] / (machine.speed * machine.method.pi / math.pi)


@in_parts(
    "name", *of_kind("engine", ("v-two",), but=("whole-engine", "petrol-four", "v8-diesel", "narrow-v6", "radial-five"))
)
def test_an_engine_of_many_cylinders_is_written_out_as_the_linkage_that_it_is(tmp_path, name):
    numbers_of_an_engine_are_those_of_its_linkage(tmp_path, FILES[name])


STATED = """
[gas]
cycle = "720 deg"
pressures = "absolute"
ambient = "0.1 MPa"
pieces = [
    { law = "constant", points = ["r", "a"] },
    { law = "polytropic", points = ["a", "c"], exponent = 1.35 },
    { law = "polytropic", points = ["z", "b"], exponent = 1.25 },
    { law = "constant", points = ["s", "t"] },
]
[gas.points]
r = { angle = "0 deg", pressure = "0.09 MPa" }
a = { angle = "180 deg", pressure = "0.09 MPa" }
c = { angle = "360 deg" }
z = { angle = "360 deg", pressure = "5 MPa" }
b = { angle = "540 deg" }
s = { angle = "540 deg", pressure = "0.11 MPa" }
t = { angle = "720 deg", pressure = "0.11 MPa" }
"""
WHOLE, V_TWO = template("whole-engine"), FILES["v-two"]
FOUR = '[engine]\nlayout = "inline"\ncylinders = 4\n\n[cycle]'
SPLIT = {
    'layout = "V"': 'layout = "V"\nfiring_order = [1, 2]\npin_offset = "30 deg"',
    'bank_angle = "90 deg"': 'bank_angle = "60 deg"',
}


@in_parts(
    ("text", "changes", "settings"),
    [
        (V_TWO, {}, ["crank.angular_acceleration=200 rad/s2", "method.weights=true", "cylinder.inclination=-45 deg"]),
        (V_TWO, SPLIT, ["crank.angular_acceleration=200 rad/s2"]),
    ],
    [
        (V_TWO, {}, ["crank.angular_acceleration=200 rad/s2", "method.weights=true"]),
        (V_TWO, {}, ["method.weights=true", "cylinder.inclination=0 deg"]),
        (WHOLE, {}, ["engine.misfire=[3]", "engine.pressure_factors=[1.0, 0.93, 1.0, 1.05]"]),
        (FILES["radial-five"], {}, ["engine.misfire=[2, 4]"]),
        (FILES["radial-five"], {}, ["engine.misfire=[1]", "cycle.motored=ambient"]),
        (FILES["wiebe"], {"[cycle]": FOUR}, ["engine.misfire=[2]", "engine.pressure_factors=[1.0, 1.0, 0.9, 1.0]"]),
        (FILES["wiebe"], {"[cycle]": FOUR}, ["engine.misfire=[3]", "cycle.motored=ambient"]),
        (FILES["narrow-v6"], {}, ["crank.angular_acceleration=200 rad/s2", "method.weights=true"]),
        (FILES["narrow-v6"].partition("[cycle]")[0] + STATED, {}, []),
        (V_TWO, SPLIT, []),
    ],
)
def test_every_part_of_an_engine_is_written_out(tmp_path, text, changes, settings):
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new, 1)
    numbers_of_an_engine_are_those_of_its_linkage(tmp_path, text, settings)


@in_parts("name", *of_kind("linkage", ("four-bar", "opposed-pistons", "andrews-squeezer", "boom", "rope-pulley")))
def test_a_linkage_stands_for_itself_with_its_defaults(tmp_path, name):
    text = FILES[name]
    path = written(tmp_path, text)
    out = expanded(path)
    again = written(tmp_path, out, "again")
    assert expanded(again) == out
    if name in TRACED:
        assert differences(analyse(read(path)), analyse(read(again))) == []
    else:
        assert read(again) == read(path)
    assert "# by default" in out
    stated, found = (tomllib.loads(one) for one in (text, out))
    assert {key for key in stated if key not in found} == set()


def test_defaults_are_marked_in_any_language_and_settings_are_in_what_is_written_out(tmp_path):
    path = written(tmp_path, template("four-bar"))
    assert 'direction = "anticlockwise"  # по умолчанию' in expanded(path, (), "ru")
    assert 'direction = "anticlockwise"  # mặc định' in expanded(path, (), "vi")
    assert 'radius = "60 mm"' in expanded(path, ["crank.radius=60 mm"])


@for_each("name", of_kind("transfer")[1])
def test_transfer_functions_are_those_of_links_with_given_motion(tmp_path, name):
    path = written(tmp_path, FILES[name])
    again = written(tmp_path, expanded(path), "again")
    assert expanded(again) == again.read_text("utf-8")
    assert {"rod", "piston", "cylinder", "engine", "transfer"}.isdisjoint(tomllib.loads(again.read_text("utf-8")))
    assert differences(analyse(read(path)), analyse(read(again))) == []


# a body of 2 kg at 0.1 and 0.2 m and of 0.5 kg m2 at 0.4 and 0.6 a radian
GIVEN = """
[crank]
speed = "10 rad/s"
static_torque = ["3 N*m", "4 N*m"]
reduced_inertia_1 = ["0.02 kg*m2", "-0.02 kg*m2"]
[table]
angles = ["0 deg", "180 deg"]
[links.arm]
mass = "2 kg"
inertia = "0.5 kg*m2"
velocity = ["0.1 m", "0.2 m"]
rotation = [0.4, 0.6]
"""


@pytest.mark.elsewhere
def test_links_with_given_motion_are_reduced_to_the_crank(tmp_path):
    path = written(tmp_path, GIVEN)
    results = analyse(read(path))
    assert results["reduced_inertia"] == pytest.approx([2 * 0.01 + 0.5 * 0.16, 2 * 0.04 + 0.5 * 0.36])
    # w^2 / 2 is 50
    assert results["balancing_torque"] == pytest.approx([3 + 50 * 0.02, 4 - 50 * 0.02])
    leaves = {known.node.path for known in in_order(results.trace.values()) if isinstance(known.node, Input)}
    assert {"crank.speed", "links.arm.mass", "links.arm.inertia"} <= leaves
    assert "static_torque" in results.explain("static_torque", 180.0)
    mistakes = {
        '0.2 m"]': ('0.2 m", "0.3 m"]', "links.arm.velocity"), '"180 deg"]': ('"-20 deg"]', "table.angles"),
        '"4 N*m"]': ('"4 N*m", "5 N*m"]', "crank.static_torque"),
    }  # fmt: skip
    for old, (new, key) in mistakes.items():
        with pytest.raises(InputError) as refusal:
            read(written(tmp_path, GIVEN.replace(old, new)))
        assert refusal.value.problems[0].key.startswith(key)


def test_a_mistake_is_told_before_anything_is_written_out(tmp_path):
    path = written(tmp_path, POINTS_ENGINE.replace('"45 mm"', '"45 apples"'))
    with pytest.raises(InputError, match=r"crank\.radius"):
        expanded(path)


@pytest.mark.slow
def test_random_files_stand_for_themselves(tmp_path):
    seen = 0
    for number in range(20):
        text = plausible_file(7, number).text
        path = written(tmp_path, text)
        try:
            machine = read(path)
            out = expanded(path)
        except CrankworkError:
            continue
        again = written(tmp_path, out, "again")
        assert expanded(again) == out
        if machine.linkage is not None:
            assert read(again) == machine
        else:
            assert read(again).speed == pytest.approx(machine.speed, rel=1e-12)
        seen += not math.isnan(machine.speed)
    assert seen > 6


def test_measured_pressure_is_that_of_a_chamber(tmp_path):
    samples = "".join(f"{angle},{1 + math.exp(-(((angle - 370) / 40) ** 2)):.6f}\n" for angle in range(0, 721, 5))
    (tmp_path / "pressure.csv").write_text(samples, "utf-8")
    text = POINTS_ENGINE
    start, end = text.index("[gas.points]"), text.index("[method]")
    measured = '[gas.measured]\nfile = "pressure.csv"\npressure_unit = "bar"\nshift = "0 deg"\n\n'
    numbers_of_a_gear_are_those_of_its_linkage(tmp_path, text[:start] + measured + text[end:])


def test_an_engine_of_one_cylinder_is_a_crank_gear(tmp_path):
    text = POINTS_ENGINE.replace("[method]", '[engine]\nlayout = "inline"\ncylinders = 1\n\n[method]')
    numbers_of_a_gear_are_those_of_its_linkage(tmp_path, text)


LOADING = """
friction.pins = { O = { coefficient = 0.01, radius = "20 mm" } }
motor = { rated_power = "30 hp", rated_speed = "1450 rpm", overload = 2.2, pole_pairs = 2 }
efficiency = { chain = [0.9], losses = "drive" }
transient = { time = "0.1 s", speed = "100 rpm" }
loads = [
    { kind = "torque", link = "crank", torque = "5 N*m" },
    { kind = "torque", link = "crank", file = "brake.csv", at = "angle", torque = "torque" },
]
document = { author = "A. Student", sections = ["task", "friction"] }
"""


@in_parts("name", ["engine"], ["v8-diesel", "radial-five", "narrow-v6", "leaning-compressor", "wiebe", "wanted-power"])
def test_an_engine_with_loads_and_friction_is_written_out_as_what_it_is_read_as(tmp_path, name):
    text = re.sub(r"\n\[document\]\n(title_\w+ = .*\n)+", "\n", FILES[name])
    # a format that reads hp as metric
    text = f"{LOADING}{text}".replace("format = 2\n", "")
    (tmp_path / "brake.csv").write_text("angle [deg],torque [N*m]\n0,1\n180,2\n360,1\n", "utf-8")
    path = written(tmp_path, text)
    out = expanded(path)
    again = written(tmp_path, out, "again")
    assert expanded(again) == out
    one, other = read(path), read(again)
    assert replace(one, notices=()) == replace(other, notices=())
    assert one.document == other.document
    assert one.loads
    assert one.friction
    assert one.transient is not None
    assert one.drive.rated_power == pytest.approx(30 * 735.49875)


def test_values_with_a_decimal_comma_are_written_out_as_stated(tmp_path: Path) -> None:
    """The ambient pressure of a compressor, which has a default."""
    text = (Path(__file__).parents[1] / "literature" / "assignments" / "uk_compressor.toml").read_text(encoding="utf-8")
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    written = tmp_path / "expanded.toml"
    written.write_text(expanded(path), encoding="utf-8")
    assert written.read_text(encoding="utf-8").count('ambient = "0,1 МПа"') == 2
    results = [analyse(read(file)) for file in (path, written)]
    assert results[0].summary == pytest.approx(results[1].summary, rel=1e-12)
    stated = {key for item in results[0].assumptions for key in item.keys}
    assert not {"gas.ambient", "crank.stroke", "flywheel.fluctuation"} & stated
