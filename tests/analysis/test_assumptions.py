"""What results assume and which inputs have no effect, against changing every value and computing again."""

import math

import numpy as np
import pytest

from crankwork import Description, analyse, template
from crankwork.analysis.assumptions import leaves
from crankwork.description.machine_file import read_machine
from crankwork.errors import InputError
from effects import mistold
from expansions import ROOT, machine_files
from machine_texts import POINTS_ENGINE

FILES = machine_files("examples")
MACHINES = machine_files("tests/machines")
# computed again some hundred times each
LONG = ("knuckle-press", "press-start", "andrews-squeezer", "burning", "rubbing-swing")
QUICK = ("crank-shaper", "engine", "scotch-yoke", "toggle-press", "whole-engine")


@pytest.mark.parametrize("name", QUICK)
def test_what_is_told_is_what_has_an_effect(name):
    assert mistold(FILES[name], ROOT / "examples") == []


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in FILES if name not in (*QUICK, *LONG)])
def test_what_is_told_is_what_has_an_effect_in_every_file(name):
    assert mistold(FILES[name], ROOT / "examples") == []


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in MACHINES if name not in (*FILES, *LONG)][::4])
def test_what_is_told_is_what_has_an_effect_in_machines_of_the_tests(name):
    """Every fourth; the campaign of effects grows machines from all of them."""
    assert mistold(MACHINES[name], ROOT / "tests" / "machines") == []


def codes(results):
    return {item.code for item in results.assumptions}


def idle(results):
    return {item.key: item.reason for item in results.without_effect}


def test_weights_that_are_given_and_not_counted_are_told():
    description = Description(template("four-bar"))
    description["method.gravity"] = "9.81 m/s2"
    assert idle(analyse(description)) == {"method.gravity": "weights_off"}
    description["method.weights"] = True
    results = analyse(description)
    assert idle(results) == {}
    assert "no_weights" not in codes(results)


def test_a_force_beyond_the_stroke_is_told():
    description = Description(template("toggle-press"))
    travel = analyse(description)["slider_stroke.ram"] * 1e3
    for number, at in enumerate((1.1, 1.2, 1.3), start=1):
        description[f"loads[1].at[{number}]"] = f"{at * travel} mm"
    results = analyse(description)
    assert set(idle(results).values()) == {"never_acts"}
    assert results.without_effect[0].values["to"] == pytest.approx(travel)


def test_an_inclination_without_weights_is_told():
    description = Description(POINTS_ENGINE)
    description["cylinder.inclination"] = "30 deg"
    assert idle(analyse(description)) == {"cylinder.inclination": "weights_off"}


def test_a_compression_ratio_without_gas_is_told():
    description = Description(template("slider-crank"))
    description.replace({"format": 1, "cylinder.bore": "80 mm", "cylinder.compression_ratio": 9.0})
    assert "cylinder.compression_ratio" in idle(analyse(description))


def test_parts_without_mass_beside_others_are_told():
    description = Description(template("four-bar"))
    for key in ("mass", "inertia", "centre"):
        del description[f"links.rocker.{key}"]
    light = next(item for item in analyse(description).assumptions if item.code == "massless")
    assert light.names == ("links.rocker",)


def test_valve_timing_of_a_release_of_heat_is_told():
    description = Description(POINTS_ENGINE)
    del description["gas"]
    description.replace(
        {
            "cycle.kind": "wiebe",
            "cycle.cycle_heat": "1100 J",
            "cylinder.compression_ratio": 10.0,
            "method.kinematics": "exact",
        }
    )
    events = {key: item.value for item in analyse(description).assumptions for key in item.keys if "timing" in key}
    assert events["cycle.timing.intake_closes"] == "50 deg"
    assert events["cycle.timing.exhaust_opens"] == "60 deg"


def test_a_balance_shaft_of_an_order_without_forces_is_told():
    description = Description(template("whole-engine"))
    # the first order of four throws 0, 180, 180, 0 has neither force nor moment
    description["balance.shafts"] = [1, 2]
    told = idle(analyse(description))
    assert {key: told.get(key) for key in ("balance.shafts[1]", "balance.shafts[2]")} == {
        "balance.shafts[1]": "no_order",
        "balance.shafts[2]": None,
    }


def test_uneven_intervals_permitted_for_nothing_and_numbers_of_banks_with_one_cylinder_are_told():
    description = Description(template("whole-engine"))
    description["engine.uneven"] = True
    assert idle(analyse(description))["engine.uneven"] == "even_intervals"
    description.replace({"engine.layout": "V", "engine.cylinders": 2, "engine.bank_angle": "60 deg"})
    description.replace({"engine.firing_order": [1, 2], "engine.numbering": "pairs"})
    told = idle(analyse(description))
    assert (told["engine.numbering"], told.get("engine.uneven")) == ("one_a_bank", None)


def test_uneven_intervals_of_a_pair_in_which_nothing_burns_are_told_as_free():
    description = Description(template("slider-crank"))
    description.replace({"engine.layout": "V", "engine.cylinders": 2, "engine.bank_angle": "60 deg"})
    assert [item.code for item in analyse(description).notices] == []
    description["engine.uneven"] = True
    assert [item.code for item in analyse(description).notices] == ["uneven_pair"]


def test_uneven_intervals_are_told_by_the_dead_centres_of_offset_cylinders():
    description = Description(FILES["narrow-v6"])
    assert "engine.uneven" not in idle(analyse(description))
    # without them they follow from even firing
    del description["engine.throws"]
    assert idle(analyse(description))["engine.uneven"] == "even_intervals"


def test_fixed_points_and_guides_that_no_part_names_are_told():
    description = Description(template("four-bar"))
    description["fixed_points.Q"] = ["300 mm", "10 mm"]
    assert idle(analyse(description)) == {f"fixed_points.Q[{number}]": "unused" for number in (1, 2)}


def test_the_offset_of_a_cylinder_that_is_not_stated_is_an_assumption():
    text = 'crank = { radius = "50 mm", speed = "300 rpm" }\nrod.length = "200 mm"\n'
    keys = {key for item in analyse(Description(text)).assumptions for key in item.keys}
    assert "cylinder.offset" in keys
    assert mistold(text, ROOT) == []


FRICTION = """
format = 2
crank = { radius = "50 mm", speed = "300 rpm" }
rod = { length = "200 mm", mass = "1 kg", small_end_share = 0.3 }
piston.mass = "0.8 kg"
cylinder = { bore = "80 mm", compression_ratio = 8, inclination = "20 deg" }
method.gravity = "9.8 m/s2"
gas.cycle = "360 deg"
gas.pressures = "absolute"
gas.ambient = "1 bar"
gas.valves = { suction = "1 bar", discharge = "4 bar" }
friction.pins.A = { coefficient = 0.1, radius = "20 mm" }
"""


def test_inputs_without_effect_of_an_engine_with_friction_are_told():
    assert idle(analyse(Description(FRICTION))) == {"method.gravity": "weights_off"}
    assert mistold(FRICTION, ROOT) == []


@pytest.mark.parametrize("name", ["engine", "two-stroke-ports"])
def test_a_cycle_takes_its_compression_ratio_from_the_clearance_volume(name):
    description = Description(MACHINES[name])
    stated = analyse(description)
    ratio = description["cylinder.compression_ratio"]
    # bore 85 mm, stroke 90 mm, ratio 9; ports take a part of the stroke
    volume = math.pi / 4 * 8.5**2 * 9 / 8 if name == "engine" else stated["clearance_volume"] * 1e6
    del description["cylinder.compression_ratio"]
    description["cylinder.clearance_volume"] = f"{volume!r} cm3"
    results = analyse(description)
    assert results["compression_ratio"] == pytest.approx(ratio, rel=1e-12)
    assert {key: results[key] for key in stated.summary} == pytest.approx(stated.summary, rel=1e-9, nan_ok=True)
    assert "cylinder.clearance_volume" not in idle(results)


def test_a_refused_gas_says_nothing_of_special_angles():
    text = "\n".join(line for line in template("engine").split("\n") if "compression_ratio =" not in line)
    assert '"372 deg"' in text
    with pytest.raises(InputError) as refused:
        read_machine(text)
    assert [line.split(": ")[1] for line in refused.value.lines()] == ["cylinder.compression_ratio"]


def test_the_guide_of_a_driving_slider_is_found_in_its_file():
    results = analyse(read_machine(MACHINES["rope-pulley"]))
    paths = {path for path in leaves(results) if path.startswith("guides.")}
    # through = "Q" is stated by name
    assert paths >= {"guides.rail.angle", "guides.rail.through[1]"}
    assert not {path for path in paths if not path.startswith("guides.rail.")}


PARALLEL = """
loads = [{ kind = "force", point = "A", x = "5 N" }]
[links]
rod = { joins = ["A", "B"], length = "50 mm", mass = "3 kg", inertia = "0.0006 kg*m2", centre = ["25 mm", "-30 mm"] }
[guides]
low = { through = ["-12 mm", "-5 mm"], angle = "0 deg" }
high = { through = ["-76 mm", "-17 mm"], angle = "180 deg" }
[sliders]
first = { guide = "low", pin = "A", mass = "0.6 kg" }
second = { guide = "high", pin = "B", mass = "1 kg" }
[driver]
slider = "first"
start = "-18 mm"
law = [{ kind = "cubic", to = "-8 mm", over = "1 s" }, { kind = "cubic", to = "-18 mm", over = "1 s" }]
[positions]
B = ["-78 mm", "-17 mm"]
"""


def test_the_inertia_of_a_link_that_never_turns_is_told_and_it_has_no_instant_centre():
    results = analyse(read_machine(PARALLEL))
    assert idle(results) == {"links.rod.inertia": "never_turns"}
    assert not [key for key in results.columns if key.startswith("instant_centre")]
    assert all(np.isnan(results.columns_at([10.0], [key])[key]).all() for key in results.trace if "instant_c" in key)
    unstated = PARALLEL.replace('inertia = "0.0006 kg*m2", ', "")
    assert [mistold(text, ROOT) for text in (PARALLEL, unstated)] == [[], []]


def rounded(text, **changes):
    description = Description(text)
    description.replace({f"cycle.{key}": value for key, value in changes.items()})
    return analyse(description)


def assumed(results):
    return {key for item in results.assumptions if item.code == "default" for key in item.keys}


def test_conventions_of_rounding_are_told_only_where_they_round():
    assert {"cycle.blow_down", "cycle.rise"} <= assumed(rounded(template("engine")))
    opening = {"timing": {"ignition": "20 deg", "intake_opens": "50 deg", "exhaust_opens": "60 deg"}}
    two_stroke = rounded(MACHINES["two-stroke-ports"], **opening)
    assert "cycle.blow_down" not in assumed(two_stroke)
    assert (
        idle(rounded(MACHINES["two-stroke-ports"], **opening, blow_down="intake"))["cycle.blow_down"]
        == "falls_through_ports"
    )
    # 1.2 times the pressure of compression is above half of the way to a peak of 1.3 times it
    small = template("engine")
    compressed = 0.09 * 9.0**1.36
    peak = f"{1.3 / 0.85 * compressed:.6f} MPa"
    assert "cycle.rise" not in assumed(rounded(small, peak_pressure=peak))
    assert idle(rounded(small, peak_pressure=peak, rise=1.25))["cycle.rise"] == "halfway"


def test_conventions_of_rounding_are_those_of_the_cylinders_that_fire():
    description = Description(template("whole-engine"))
    stated = assumed(analyse(description))
    description.replace({"engine.misfire": [1], "cycle.motored": "compressed"})
    assert "cycle.rise" in stated
    assert assumed(analyse(description)) >= stated


def test_a_force_on_a_piece_that_never_moves_back_acts_forward_in_any_case():
    text = """
fixed_points = { D = ["0 mm", "0 mm"] }
guides.line = { through = ["0 mm", "0 mm"], angle = "0 deg" }
sliders.ram = { guide = "line", pin = "A" }
links.rod = { joins = ["A", "B"], length = "300 mm" }
links.rocker = { joins = ["D", "B"], length = "200 mm" }
driver = { slider = "ram", start = "200 mm", period = "1 s", law = LAW }
positions = { B = ["0 mm", "200 mm"] }
[[loads]]
kind = "process"
slider = "ram"
stroke = "growing"
at = ["0 mm", "50 mm"]
force = ["0 N", "9 N"]
acts = "both"
"""
    there, rest = '{ kind = "trapezoidal", to = "250 mm", over = 0.5, ramp = 0.1 }', '{ kind = "dwell", over = 0.5 }'
    laws = f"[{there}, {there.replace('250', '200')}]", f"[{there}, {rest}]"
    told = [idle(analyse(Description(text.replace("LAW", law)))) for law in laws]
    assert [known.get("loads[1].acts") for known in told] == [None, "no_return_force"]


def test_uneven_intervals_of_a_customary_order_are_told_by_its_intervals():
    text = FILES["whole-engine"]
    description = Description(text)
    del description["engine.firing_order"]
    description.replace({"engine.uneven": True, "engine.offsets": ["4 mm", "-4 mm", "4 mm", "-4 mm"]})
    assert "engine.uneven" not in idle(analyse(description))
    description["engine.offsets"] = ["4 mm", "4 mm", "4 mm", "4 mm"]
    assert idle(analyse(description))["engine.uneven"] == "even_intervals"


def test_names_with_dots_are_those_of_parts():
    text = """
fixed_points = { O = ["0 mm", "0 mm"], "D.1" = ["300 mm", "0 mm"], E = ["9 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "60 mm", speed = "120 rpm" }
[links]
"cou.pler" = { joins = ["A", "B"], length = "250 mm", mass = "1 kg", centre = ["9 cm", "0 cm"], inertia = "1 kg*m2" }
rocker = { joins = ["D.1", "B"], length = "180 mm" }
"""
    assert idle(analyse(read_machine(text))) == {"fixed_points.E[1]": "unused", "fixed_points.E[2]": "unused"}


def test_about_which_point_an_inertia_is_matters_only_with_a_centre_of_mass_beside_the_pivot():
    text = """
fixed_points = { O = ["0 mm", "0 mm"], C = ["300 mm", "0 mm"] }
[crank]
pivot = "O"
pin = "A"
radius = "60 mm"
speed = "120 rpm"
mass = "2 kg"
inertia = "0.01 kg*m2"
[links]
coupler = { joins = ["A", "B"], length = "250 mm" }
rocker = { joins = ["C", "B"], length = "180 mm" }
"""
    eccentric = text.replace('mass = "2 kg"', 'mass = "2 kg"\ncentre = ["30 mm", "0 mm"]')
    for machine in (text, eccentric):
        assert mistold(machine, ROOT) == []
        assert mistold(machine.replace("[links]", 'inertia_about = "centre"\n[links]'), ROOT) == []


@pytest.mark.parametrize(
    ("name", "reasons"),
    {
        "turning-given-rim": {"torque.period": "unused"},
        "rope-pulley": {"links.pulley.mass": "at_rest"},
    }.items(),
)
def test_a_period_of_harmonics_beside_a_longer_one_and_a_mass_at_rest_are_told(name, reasons):
    assert idle(analyse(read_machine(MACHINES[name]))).items() >= reasons.items()


@pytest.mark.parametrize("shape", ["constant", "triangle"])
def test_the_shape_of_a_work_that_is_done_at_once_is_told(shape):
    text = MACHINES["turning-shears"].replace("{ shear_energy", f'{{ shape = "{shape}", shear_energy')
    assert text != MACHINES["turning-shears"]
    assert idle(analyse(read_machine(text))) == {"load.strokes[1].shape": "at_once"}
    assert "load.strokes[1].shape" not in assumed(analyse(read_machine(MACHINES["turning-shears"])))


def test_what_an_engine_or_linkage_does_not_use_of_its_method_and_shares_is_told():
    text = """
crank = { radius = "50 mm", speed = "300 rpm" }
rod = { length = "200 mm", mass = "1 kg", small_end_share = 0.3 }
piston.mass = "0.8 kg"
method.rod = "two-mass"
balance.rotating_share = 0.5
"""
    assert idle(analyse(read_machine(text))) == {"method.rod": "unused"}
    ratio = text + "method.inertia_rod_ratio = 0.3\n"
    assert "method.inertia_rod_ratio" in idle(analyse(read_machine(ratio)))
    assert "method.inertia_rod_ratio" not in idle(analyse(read_machine(ratio), method="textbook"))
    light = text.replace(', mass = "1 kg", small_end_share = 0.3', "").replace("piston.mass", "piston . mass")
    assert idle(analyse(read_machine(light)))["balance.rotating_share"] == "no_rotating_mass"
    assert mistold(text, ROOT) == []


def test_what_the_rest_of_a_file_leaves_without_use_is_told():
    masses = 'masses = [{ mass = "9 kg", radius = "4 mm", angle = "0 deg", position = "0 mm" }]'
    wheel = 'percent = 2, radius_of_gyration = "0.7 m"'
    rows = '"0 deg", "90 deg", "180 deg", "270 deg"'
    body = 'bodies.arm = { mass = "6 kg", inertia = "1 kg*m2", rotation = [0.1, 0.3, 0.2, -0.4] }'
    for text, path in (
        (f'crank = {{}}\nrotor = {{ bearings = ["0 mm", "9 mm"], {masses} }}', "rotor.bearings[2]"),
        (
            f'crank.speed = "300 rpm"\ntorque = {{ period = "360 deg", constant = "7 N*m" }}\nflywheel = {{ {wheel} }}',
            "flywheel.radius_of_gyration",
        ),
        (f'crank.speed = "300 rpm"\ntransfer = {{ angles = [{rows}], {body} }}', "transfer.bodies.arm.mass"),
        (template("engine").replace("bore =", 'piston_rod_diameter = "20 mm"\nbore ='), "cylinder.piston_rod_diameter"),
    ):
        assert path in idle(analyse(read_machine(text)))
    shaper = template("crank-shaper") + '[flywheel]\npercent = 2\n[efficiency]\nchain = [0.9]\nlosses = "machine"\n'
    mean = analyse(read_machine(shaper.replace('"machine"', '"drive"'))).summary["flywheel_inertia"]
    # losses take more of the torque where it is greater
    assert analyse(read_machine(shaper)).summary["flywheel_inertia"] > mean
    assert "efficiency.losses" not in idle(analyse(read_machine(shaper)))


def test_pressures_listed_against_the_rotation_are_those_listed_backwards():
    text = MACHINES["burning"]
    begins, ends = text.index("values = [") + 10, text.index("]", text.index("values = ["))
    backwards = ", ".join(text[begins:ends].replace("\n", "").strip(" ,").split(",")[::-1])
    other = f"{text[:begins]}{backwards}{text[ends:]}".replace('step = "2 deg"', 'step = "2 deg"\nstart = "2 deg"')
    other = other.replace("[gas.measured]", "[gas.measured]\nreversed = true")
    found, expected = (analyse(read_machine(item)).summary for item in (other, text))
    assert found == pytest.approx(expected, rel=1e-9, nan_ok=True)
