"""A linkage of crank, rods and pistons is the engine that it is, however it is written; another linkage is none."""

from __future__ import annotations

import math
import random
import runpy
import tomllib

import numpy as np
import pytest

import crankwork
from crankwork import CrankGrid, analyse, read_machine, template
from crankwork.analysis.results import Results
from crankwork.description.shorthand import expanded
from crankwork.errors import CrankworkError, InputError, Problem
from crankwork.formula.traced_value import Input, in_order
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.lowering import NotCompiledError
from crankwork.locale import LANGUAGES, in_language
from crankwork.machine import Machine
from crankwork.preparation.cell_gas import linkage_paths, relocate
from crankwork.preparation.cylinder_form import engine_form, engine_form_or_reason
from each import for_each
from expansions import ROOT, differences, machine_files, mirrored, renamed, shuffled, turned, written
from machine_texts import POINTS_ENGINE
from shown import in_parts

smooth_engine = runpy.run_path(str(ROOT / "tests" / "doors" / "plausible_engines.py"))["smooth_engine"]
FILES = machine_files("examples", "tests/machines")
# what was measured on a test bed and masses that replace a rod belong to the engine: its linkage has none
ENGINES = [
    name
    for name, text in FILES.items()
    if "rod" in (values := tomllib.loads(text)) and "test" not in values and "equivalent" not in values["rod"]
]
WAYS = {
    "again": written,
    "renamed": lambda values: written(renamed(values)),
    "shuffled": lambda values: written(shuffled(values, 1)),
    "turned": lambda values: written(turned(values, 37.0)),
    "mirrored": lambda values: written(mirrored(values)),
}
EXACT = "method.kinematics=exact"
DOUBLE = {
    "# piston_rod_diameter": "piston_rod_diameter",
    "[gas]": '[gas]\nback_pressure = "0.1 MPa"',
    'bore = "100 mm"': 'bore = "100 mm"\noffset = "-20 mm"\ninclination = "30 deg"',
}
PETROL, RADIAL, NARROW = (FILES[name] for name in ("petrol-four", "radial-five", "narrow-v6"))
V_TWO, ENGINE, COMPRESSOR = FILES["v-two"], template("engine"), template("compressor")


def with_changes(text, changes):
    for old, new in changes.items():
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def form_of(text: str) -> Machine:
    form = engine_form_or_reason(read_machine(text))
    assert isinstance(form, Machine), form
    return form


def linkage_of(tmp_path, text, *settings):
    path = tmp_path / "machine.toml"
    path.write_text(text, "utf-8")
    return expanded(path, [EXACT, *settings])


def is_the_engine(tmp_path, text, *settings, ways=tuple(WAYS)) -> tuple[Results, Results]:
    out = linkage_of(tmp_path, text, *settings)
    machine = read_machine(text, overrides=[EXACT, *settings], folder=ROOT)
    engine, values = analyse(machine), tomllib.loads(out)
    # weights point down, whichever way the machine is turned
    for way in (way for way in ways if not (machine.has_gravity and way == "turned")):
        form = form_of(WAYS[way](values))
        assert differences(engine, analyse(form)) == [], way
        assert (form.engine is None) == (machine.engine is None), way
        if machine.engine is not None and form.engine is not None:
            layouts = form.engine.layout, machine.engine.layout
            assert len({(layout.kind, layout.firing_order, layout.cycle) for layout in layouts}) == 1, way
    return engine, analyse(form)


@in_parts("name", ["compressor", "two-stroke"], [name for name in ENGINES if name not in ("compressor", "two-stroke")])
def test_an_engine_written_out_is_the_engine_again(tmp_path, name):
    is_the_engine(tmp_path, FILES[name])


@in_parts(
    ("text", "changes", "settings"),
    [
        (COMPRESSOR, DOUBLE, ["method.weights=true"]),
        (V_TWO, {}, ["crank.angular_acceleration=200 rad/s2", "method.weights=true", "cylinder.inclination=-45 deg"]),
        (NARROW.partition("[cycle]")[0].replace("compression_ratio", "# compression_ratio") + "[method]\n", {}, []),
    ],
    [
        (ENGINE, {"[method]\n": '[engine]\nlayout = "inline"\ncylinders = 1\n[method]\n'}, ["method.pi=3.14"]),
        (ENGINE, {"[table]": '[flywheel]\nfluctuation = 0.02\ninertia = "0.3 kg*m2"\n[table]'}, []),
        (PETROL, {}, ["engine.misfire=[3]", "engine.pressure_factors=[1.0, 0.93, 1.0, 1.05]"]),
        (PETROL, {}, ["bearings.counterweight=0.01 kg*m", "balance.rotating_share=0", "balance.shafts=[2]"]),
        (RADIAL, {}, ["engine.misfire=[1]", "cycle.motored=ambient"]),
        (
            RADIAL,
            {"knuckle_radius": 'mass = "1.1 kg"\nsmall_end_share = 0.3\ninertia = "0.02 kg*m2"\nknuckle_radius'},
            [],
        ),
        (FILES["v8-diesel"], {}, ["method.weights=true", "crank.angular_acceleration=-300 rad/s2"]),
        (FILES["wiebe"], {"[cycle]": '[engine]\nlayout = "inline"\ncylinders = 4\n\n[cycle]'}, ["engine.misfire=[2]"]),
    ],
)
def test_every_part_of_an_engine_comes_back(tmp_path, text, changes, settings):
    is_the_engine(tmp_path, with_changes(text, changes), *settings)


def test_measured_pressure_comes_back(tmp_path):
    samples = "".join(f"{angle},{1 + math.exp(-(((angle - 370) / 40) ** 2)):.6f}\n" for angle in range(0, 721, 5))
    (tmp_path / "pressure.csv").write_text(samples, "utf-8")
    start, end = POINTS_ENGINE.index("[gas.points]"), POINTS_ENGINE.index("[method]")
    measured = '[gas.measured]\nfile = "pressure.csv"\npressure_unit = "bar"\nshift = "0 deg"\n\n'
    path = tmp_path / "machine.toml"
    path.write_text(POINTS_ENGINE[:start] + measured + POINTS_ENGINE[end:], "utf-8")
    linkage = read_machine(expanded(path), folder=tmp_path)
    form = engine_form(linkage)
    assert form is not None
    assert differences(analyse(crankwork.read(path)), analyse(form)) == []


@in_parts("seed", [1], [2, 3])
def test_engines_by_chance_come_back(tmp_path, seed):
    seen = 0
    for number in range(5 if seed == 1 else 12):
        text = written(smooth_engine(random.Random(f"engine form {100 * seed + number}")))  # noqa: S311 - no secret
        try:
            linkage_of(tmp_path, text)
        except CrankworkError:
            continue
        is_the_engine(tmp_path, text, ways=(list(WAYS)[number % len(WAYS)],))
        seen += 1
    assert seen > 1


# a crank of 50 mm that turns anticlockwise, and a rod of 200 mm to a piston on the line y = 0
DRAWN = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "P"
radius = "50 mm"
speed = "100 rad/s"
[links.rod]
joins = ["P", "Q"]
length = "200 mm"
mass = "2 kg"
centre = ["50 mm", "0 mm"]
inertia = "0.012 kg*m2"
[guides.line]
[sliders.piston]
guide = "line"
pin = "Q"
mass = "1.5 kg"
[chambers.head]
slider = "piston"
sense = -1
bore = "100 mm"
pressure = "0.2 MPa"
"""


@pytest.mark.elsewhere
def test_a_drawn_crank_mechanism_is_an_engine_of_one_cylinder():
    form = form_of(DRAWN)
    assert form.engine is None
    assert form.lengths == (0.05, 0.2, 0.0)
    # two masses by the lever of the centre, and what is left of the inertia
    masses = form.masses
    assert (masses.rod_small_end, masses.rod_big_end) == pytest.approx((0.5, 1.5))
    assert masses.rod_inertia_excess == pytest.approx(0.012 - 2 * 0.05 * 0.15)
    results = analyse(form, [0.0, 90.0])
    # at 0 degrees the piston accelerates by r w^2 (1 + r / l), at 90 the rod has no torque but that of the couple
    assert results["inertia_force"][0] == pytest.approx(-2.0 * 0.05 * 100**2 * 1.25)
    assert results["gas_force"] == pytest.approx(0.2e6 * math.pi / 4 * 0.1**2)


def test_a_linkage_gives_the_numbers_of_its_engine_form():
    linkage, form = analyse(read_machine(DRAWN)), analyse(form_of(DRAWN))
    assert form["piston_velocity"] == pytest.approx(-linkage["slider_velocity.piston"], abs=1e-12)
    assert form["crank_torque"] == pytest.approx(-linkage["balancing_torque"], abs=1e-9)


def test_the_mass_of_a_crank_is_that_of_its_throw_and_the_rest_turns_with_it():
    crank = 'mass = "3 kg"\ncentre = ["20 mm", "0 mm"]\ninertia = "0.02 kg*m2"\n[links.rod]'
    form = form_of(DRAWN.replace("[links.rod]", crank, 1))
    # 3 kg at 20 mm are 1.2 kg at 50 mm
    assert form.masses.crank == pytest.approx(1.2)
    assert form.drive.inertia == pytest.approx(0.02 - 1.2 * 0.05**2)


def test_the_delay_of_a_chamber_is_that_of_its_gas():
    points = """
period = "720 deg"
delay = "{} deg"
points.a = {{ angle = "0 deg", pressure = "0.1 MPa" }}
points.b = {{ angle = "360 deg", pressure = "2 MPa" }}
points.c = {{ angle = "720 deg", pressure = "0.1 MPa" }}
pieces = [{{ law = "rounded", points = ["a", "b", "c"] }}]
"""
    stated = 'pressure = "0.2 MPa"'
    assert stated in DRAWN
    plain = DRAWN.replace(stated, points.format(0))
    later = DRAWN.replace(stated, points.format(30))
    found = [analyse(form_of(text), np.arange(0.0, 720.0, 10.0))["gas_pressure"] for text in (plain, later)]
    assert found[1] == pytest.approx(np.roll(found[0], 3))
    linkage = analyse(read_machine(later), np.arange(0.0, 720.0, 10.0))
    assert linkage["gas_pressure.head"] == pytest.approx(found[1])


OTTO = """compression_ratio = 9
period = "720 deg"
ambient = "0.1 MPa"
pressures = "absolute"
cycle = { kind = "otto", intake_pressure = "0.1 MPa", intake_temperature = "300 K", heat = "1000 kJ/kg" }
"""


@pytest.mark.elsewhere
def test_a_calculated_cycle_of_a_drawn_chamber_is_that_of_an_engine():
    """Of Otto's cycle in closed form: efficiency 1 - 9^-0.4, and its share of the heat to p V / (R T) of gas."""
    linkage = analyse(read_machine(DRAWN.replace('pressure = "0.2 MPa"', OTTO)))
    swept = math.pi / 4 * 0.1**2 * 0.1
    mass = 0.1e6 * swept * 9 / 8 / (287 * 300)
    efficiency = 1 - 9**-0.4
    for results in (linkage, linkage.other):
        assert results["thermal_efficiency"] == pytest.approx(efficiency, rel=1e-12)
    assert linkage["indicated_work.head"] == pytest.approx(efficiency * 1e6 * mass, rel=1e-9)
    assert linkage["indicated_work"] == pytest.approx(efficiency * 1e6 * mass, rel=1e-9)
    leaves = {known.node.path for known in in_order(linkage.trace.values()) if isinstance(known.node, Input)}
    places = {"chambers.head.cycle.heat", "chambers.head.cycle.intake_temperature", "chambers.head.compression_ratio"}
    assert places <= leaves
    assert not any(path.startswith(("cycle", "cylinder")) for path in leaves)


@pytest.mark.elsewhere
@for_each(("word", "work"), [("compressed", 0.0), ("ambient", 0.0)])
def test_a_chamber_without_combustion_does_no_work(word, work):
    cold = OTTO.replace("cycle = {", f'cycle = {{ motored = "{word}",')
    linkage = analyse(read_machine(DRAWN.replace('pressure = "0.2 MPa"', cold)))
    # what is compressed adiabatically expands as it was
    assert linkage["indicated_work.head"] == pytest.approx(work, abs=1e-9)
    peak = 0.1e6 * (9**1.4 if word == "compressed" else 1)
    assert linkage.value("diagram_pressure.head", 360.0) == pytest.approx(peak, rel=1e-9)


@for_each(
    ("old", "new", "key"),
    [
        ("compression_ratio = 9\n", "", "chambers.head.compression_ratio"),
        ('heat = "1000 kJ/kg"', 'heat = "1000 kJ/kg", cut_off = 2', "chambers.head.cycle"),
        ('kind = "otto"', 'kind = "otto", fuel = "petrol"', "chambers.head.cycle.fuel"),
    ],
)
def test_mistakes_of_a_cycle_are_told_at_its_chamber(old, new, key):
    assert old in OTTO
    with pytest.raises(InputError) as refusal:
        read_machine(DRAWN.replace('pressure = "0.2 MPa"', OTTO.replace(old, new)))
    assert refusal.value.problems[0].key.startswith(key)


def test_a_cycle_with_corners_needs_the_strokes_of_an_engine():
    text, cycle = FILES["atkinson"], tomllib.loads(OTTO.replace("720 deg", "360 deg"))
    values = tomllib.loads(text)
    ((name, chamber),) = values["chambers"].items()
    faces = {key: value for key, value in chamber.items() if key in ("slider", "bore", "sense")}
    with pytest.raises(InputError, match="turns back 4 times"):
        read_machine(written({**values, "chambers": {name: {**faces, **cycle}}}))


@pytest.mark.elsewhere
def test_approximate_methods_are_those_of_the_engine():
    """The first two terms of the binomial: x = r [(1 - cos) + (r / l) / 4 (1 - cos 2)]."""
    textbook = read_machine(f'{DRAWN}\n[method]\nkinematics = "textbook"\n')
    at = np.radians([30.0, 60.0, 200.0])
    wanted = 0.05 * (1 - np.cos(at) + 0.25 / 4 * (1 - np.cos(2 * at)))
    for results in (analyse(textbook, np.degrees(at)), analyse(read_machine(DRAWN), np.degrees(at), method="textbook")):
        assert results["piston_displacement"] == pytest.approx(wanted, rel=1e-12)
        exact = 0.05 * (1 - np.cos(at)) + 0.2 - np.sqrt(0.04 - (0.05 * np.sin(at)) ** 2)
        assert results["piston_displacement_error"] >= np.max(np.abs(wanted - exact))
    leaves = {known.node.path for known in in_order(results.trace.values()) if isinstance(known.node, Input)}
    assert "links.rod.length" in leaves


def test_another_linkage_refuses_an_approximate_method_by_name():
    for text in (FILES["four-bar"], DRAWN.replace("[sliders.piston]", f"{RUBBED}[sliders.piston]")):
        with pytest.raises(InputError) as refusal:
            read_machine(f'{text.partition("[method]")[0]}\n[method]\nkinematics = "textbook"\n')
        (problem,) = refusal.value.problems
        assert problem.key == "method.kinematics"
        for language in LANGUAGES:
            assert "textbook" in in_language(problem.message, language)
            assert "exact" in in_language(problem.message, language)


RUBBED = '[friction]\npins = { Q = { coefficient = 0.1, radius = "5 mm" } }\n'


def test_an_engine_that_rubs_keeps_what_has_no_friction():
    """The forces of an engine are those without friction; what it takes is told of the linkage."""
    rubbed, smooth = (analyse(read_machine(DRAWN.replace("[sliders", f"{extra}[sliders"))) for extra in (RUBBED, ""))
    assert "friction_power" in rubbed
    assert rubbed["crank_torque_max"] == pytest.approx(smooth["crank_torque_max"], rel=1e-12)


OTHER = {
    'speed = "100 rad/s"': ('speed = "100 rad/s"\nstart = "10 deg"', "angle of 0"),
    "[sliders.piston]": ('[[loads]]\nkind = "force"\npoint = "Q"\nx = "10 N"\n[sliders.piston]', "loads"),
    "sense = -1": ('sense = 1\nrod_diameter = "20 mm"', "no chamber"),
    'centre = ["50 mm", "0 mm"]': ('centre = ["50 mm", "1 mm"]', "centre of mass of rod"),
}


@for_each("old", OTHER)
def test_another_machine_is_no_engine_and_says_why(old):
    new, reason = OTHER[old]
    found = engine_form_or_reason(read_machine(with_changes(DRAWN, {old: new})))
    assert isinstance(found, Problem)
    assert reason in found.message
    assert engine_form(read_machine(with_changes(DRAWN, {old: new}))) is None


@for_each("name", ["four-bar", "scotch-yoke", "opposed-pistons", "atkinson", "andrews-squeezer"])
def test_linkages_of_other_groups_are_no_engines(name):
    assert engine_form(read_machine(FILES[name])) is None


@for_each("degrees", [30, 120, 210])
def test_banks_lean_as_before_whichever_way_the_engine_is_turned(tmp_path, degrees):
    """Of a boxer engine one bank stands at -90 degrees from the reference and one at 90."""
    boxer = V_TWO.replace('layout = "V"', 'layout = "boxer"').replace('bank_angle = "90 deg"\n', "")
    values = turned(tomllib.loads(linkage_of(tmp_path, boxer)), degrees)
    form = form_of(written(values))
    assert [place.axis for place in form.engine.layout.places] == pytest.approx([-90.0, 90.0])


def test_unequal_rods_are_no_engine(tmp_path):
    values = tomllib.loads(linkage_of(tmp_path, V_TWO))
    values["links"]["rod_2"]["mass"] = "0.9 kg"
    del values["shaft"]
    for table in ("bearings", "balance"):
        values.pop(table, None)
    assert "rod_2 is not like rod_1" in engine_form_or_reason(read_machine(written(values))).message


MISTAKES = {
    ("shaft", "cylinders"): (["piston_1"], "add or correct piston_2"),
    ("shaft", "positions"): ({"piston_1": "0 mm"}, "add or correct piston_2"),
    ("shaft", "firing"): ({"piston_1": "0 deg", "piston_2": "100 deg"}, "write that, or add 360"),
    ("shaft", "throws"): ([["A1"], ["Q"]], "each pin"),
    ("shaft", "journals"): (["10 mm", "-10 mm"], "ascending"),
    ("shaft", "misfire"): (["rod_1"], "there is no slider"),
}


@for_each("place", MISTAKES)
def test_a_crankshaft_that_does_not_fit_is_told_on_its_line(tmp_path, place):
    table, key = place
    wrong, told = MISTAKES[place]
    values = tomllib.loads(linkage_of(tmp_path, V_TWO))
    values[table] = {**values[table], key: wrong}
    with pytest.raises(InputError) as refusal:
        read_machine(written(values))
    problem = refusal.value.problems[0]
    assert problem.key.startswith(f"{table}.{key}")
    assert told in problem.message


@for_each(
    "table",
    ['[bearings]\ncrankpin_diameter = "48 mm"', "[balance]\nrotating_share = 1.0", '[shaft]\nmisfire = ["ram"]'],
)
def test_a_crankshaft_of_another_linkage_is_refused(table):
    with pytest.raises(InputError, match="only for a crank with rods and pistons") as refusal:
        read_machine(f"{FILES['four-bar']}\n{table}\n")
    assert refusal.value.problems[0].key == table[1 : table.index("]")]


def test_cylinders_without_a_crankshaft_are_numbered_by_their_chambers(tmp_path):
    values = tomllib.loads(linkage_of(tmp_path, PETROL))
    for table in ("shaft", "bearings", "balance", "flywheel"):
        values.pop(table, None)
    form = form_of(written(values))
    assert form.engine is not None
    assert form.engine.layout.firing_order == (1, 3, 4, 2)
    # what fires half a cycle after cylinder 1 is the first now: 4-2-1-3 of before
    backwards = {**values, "chambers": dict(reversed(values["chambers"].items()))}
    form = form_of(written(backwards))
    assert form.engine is not None
    assert (form.engine.layout.firing_order, form.gas.delay) == ((1, 3, 4, 2), pytest.approx(360.0))


@for_each(("text", "changes"), [(COMPRESSOR, DOUBLE), (V_TWO, {}), (RADIAL, {}), (NARROW, {})])
def test_inputs_of_the_form_are_those_of_the_linkage(tmp_path, text, changes):
    machine = read_machine(linkage_of(tmp_path, with_changes(text, changes)))
    results, paths = analyse(engine_form(machine)), linkage_paths(machine)
    relocate(results.trace.values(), paths)
    nodes = [known.node for known in in_order(results.trace.values()) if isinstance(known.node, Input)]
    tables = {node.path.partition(".")[0] for node in nodes} - {"", "method", "table"}
    assert tables <= {
        "crank",
        "links",
        "sliders",
        "guides",
        "chambers",
        "shaft",
        "bearings",
        "balance",
        "flywheel",
        "motor_selection",
    }
    assert results.trace["rod_length"].node.path in {f"links.{rod}.length" for rod in ("rod", "rod_1")}
    stated = machine.stated
    assert {path for path in ("links.rod.length", "links.rod_1.length") if path in stated} <= {
        node.path for node in nodes
    }


def test_a_study_of_a_linkage_calculates_its_engine_form_anew():
    """A kernel compares the traces of analyses: a leaf of the form differs where the linkage does."""
    traces, lengths = [], (0.2, 0.19, 0.22)
    for length in lengths:
        text = DRAWN.replace('length = "200 mm"', f'length = "{length} m"')
        machine = read_machine(text)
        results = analyse(engine_form(machine))
        relocate(results.trace.values(), linkage_paths(machine))
        traces.append(results.trace)
    keys = ["piston_velocity_max", "crank_torque_max"]
    kernel = Kernel(traces, np.array(lengths)[:, None], keys[:1], CrankGrid.from_degrees, cycle=360.0)
    wanted = analyse(form_of(DRAWN.replace('length = "200 mm"', 'length = "0.21 m"'))).summary
    assert kernel(np.array([[0.21]])).values[0, 0] == pytest.approx(wanted[keys[0]], rel=1e-9)
    # the masses of the rod at its ends are worked out of the length before they are remembered
    with pytest.raises(NotCompiledError, match="curved_field"):
        Kernel(traces, np.array(lengths)[:, None], keys[1:], CrankGrid.from_degrees, cycle=360.0)
