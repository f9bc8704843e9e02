"""Mistakes in the file of a whole engine: each is told on its line, with what to write instead."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from each import for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
ORDER = "firing_order = [1, 3, 4, 2]"
WIEBE = "combustion_duration = "
TITLE, SPRING = "title = ", "{ kind = 'spring', slider = '%s', stiffness = '1 N/mm' }"
PUSH = "{ kind = 'torque', link = '%s', torque = '1 N*m' }"

# example, the original text, what a user writes, the key blamed, and words of the advice
MISTAKES = {
    "no such pin": ("petrol-four", TITLE, f"friction.pins.crank_pin.moment = '1 N*m'\n{TITLE}",
                    "friction.pins.crank_pin", "there is O, A1, B1, A2, B2, A3, B3, A4, B4"),
    "pin of two rods": ("v8-diesel", TITLE, f"friction.pins.A1.moment = '1 N*m'\n{TITLE}", "friction.pins.A1",
                        "there is O, A1_rod_1, B1, A2_rod_2"),
    "bore for piston": ("two-stroke", TITLE, f"friction.sliders.bore_1.force = '1 N'\n{TITLE}",
                        "friction.sliders.bore_1", "there is piston_1, piston_2, piston_3"),
    "no such piston": ("two-stroke", TITLE, f"loads = [{SPRING % 'piston'}]\n{TITLE}", "loads[1].slider",
                       "there is piston_1, piston_2, piston_3"),
    "no such link": ("two-stroke", TITLE, f"loads = [{PUSH % 'con-rod'}]\n{TITLE}", "loads[1].link",
                     "there is crank, piston_1, piston_2, piston_3, rod_1, rod_2, rod_3"),
    "motor where none drives": ("two-stroke", TITLE, f"transient = {{ time = '1 s', motor = true }}\n{TITLE}",
                                "transient.motor", "[motor]"),
    "friction by a series": ("petrol-four", TITLE,
                             f"friction.pins.O.moment = '1 N*m'\nmethod.kinematics = 'series:6'\n{TITLE}",
                             "method.kinematics", "write exact, or leave friction out"),
    "recovery beside friction": ("petrol-four", "fluctuation = 0.01",
                                 "fluctuation = 0.01\nrecovery = '1 s'\n[friction.pins.O]\nmoment = '1 N*m'",
                                 "flywheel.recovery", "constant moment of inertia"),
    "recovery beside moving masses": ("petrol-four", "fluctuation = 0.01", "fluctuation = 0.01\nrecovery = '1 s'",
                                      "flywheel.recovery", "engine by the method textbook"),
    "order repeats": ("petrol-four", ORDER, "firing_order = [1, 3, 4, 4]", "engine.firing_order",
                      "names cylinder 4 twice and leaves out cylinder 2"),
    "order too short": ("petrol-four", ORDER, "firing_order = [1, 3, 4]", "engine.firing_order", "leaves out"),
    "no such cylinder": ("petrol-four", ORDER, "firing_order = [1, 3, 5, 2]", "engine.firing_order",
                         "there is no cylinder 5"),
    "order as text": ("petrol-four", ORDER, 'firing_order = "1, 3, 4, 2"', "engine.firing_order", "must be a list"),
    "half a cylinder": ("petrol-four", "cylinders = 4", "cylinders = 4.5", "engine.cylinders", "write a whole number"),
    "no cylinders": ("petrol-four", "cylinders = 4\n", "", "engine.cylinders", "is missing"),
    "other layout": ("petrol-four", '"inline"', '"star"', "engine.layout", 'write "inline", "V"'),
    "key of another layout": ("petrol-four", ORDER, f'{ORDER}\nbank_angle = "60 deg"', "engine.bank_angle",
                              'means nothing with layout = "inline"; leave it out, or write layout = "V"'),
    "too few throws": ("petrol-four", ORDER, f'{ORDER}\nthrows = ["0 deg", "180 deg"]', "engine.throws",
                       "the crankshaft has 4 throws"),
    "order against throws": ("petrol-four", ORDER,
                             f'{ORDER}\nthrows = ["0 deg", "0 deg", "180 deg", "180 deg"]', "engine.firing_order",
                             ""),
    "V without its angle": ("v8-diesel", 'bank_angle = "90 deg"\n', "", "engine.bank_angle", "is missing"),
    "common pins disagree": ("v8-diesel", 'bank_angle = "90 deg"', 'bank_angle = "60 deg"', "engine.pin_offset",
                             "engine.uneven = true"),
    "odd V": ("v8-diesel", "cylinders = 8", "cylinders = 7", "engine.cylinders", "a multiple of 2"),
    "rod too short": ("radial-five", '"182 mm"', '"60 mm"', "engine.articulated.knuckle_radius", "mm"),
    "no rod left": ("radial-five", 'knuckle_radius = "48 mm"\nrod_length = "182 mm"', 'knuckle_radius = "240 mm"',
                    "engine.articulated.rod_length", "smaller radius"),
    "knuckle pin beyond the piston": ("radial-five", '"48 mm"', '"300 mm"', "engine.articulated.knuckle_radius",
                                      "not less than the master rod of 230 mm"),
    "no spacing": ("radial-five", 'spacing = "160 mm"', 'spacing = "0 mm"', "engine.spacing", 'at least "0.1 mm"'),
    "knuckle angles": ("radial-five", 'rod_length = "182 mm"', 'rod_length = "182 mm"\nknuckle_angles = ["72 deg"]',
                       "engine.articulated.knuckle_angles", "one for each of the 4 articulated rods"),
    "throws of a radial": ("radial-five", 'spacing = "160 mm"', 'throws = ["0 deg"]', "engine.throws", "leave it out"),
    "fluctuation of 2": ("petrol-four", "fluctuation = 0.01", "fluctuation = 2", "flywheel.fluctuation", "to 1"),
    "counterweight as a mass": ("petrol-four", "[balance]", '[bearings.x]\n[balance]', "bearings.x", "unknown"),
    "13 rays": ("v8-diesel", "rays = 24", "rays = 13", "bearings.rays", "write 12 or 24"),
    "third-order shafts": ("two-stroke", "shafts = [1]", "shafts = [3]", "balance.shafts[1]", "write 1 or 2"),
    "gas and cycle": ("petrol-four", "[cycle]", '[gas]\ncycle = "720 deg"\n[cycle]', "cycle", "says the same as gas"),
    "key of another cycle": ("two-stroke", WIEBE, f"heat_use = 0.9\n{WIEBE}", "cycle.heat_use",
                             'means nothing with kind = "wiebe"; leave it out, or write kind = "petrol" or "diesel"'),
    "loss in words": ("petrol-four", 'kind = "petrol"', 'kind = "petrol"\nmechanical_loss = [0.03, "x"]',
                      "cycle.mechanical_loss[2]", "must be a plain number"),
    "loss of one number": ("petrol-four", 'kind = "petrol"', 'kind = "petrol"\nmechanical_loss = [0.03]',
                           "cycle.mechanical_loss", "has 1 entries; write 2 of them"),
    "28 radial cylinders": ("radial-five", "cylinders = 5\nfiring_order = [1, 3, 5, 2, 4]", "cylinders = 28",
                            "engine.cylinders", "take 25 or 27, or write"),
    "no compression ratio": ("petrol-four", "compression_ratio = 8.5", "",
                             "cylinder.compression_ratio", "is missing"),
    "unknown fuel": ("petrol-four", "excess_air = 0.96", 'fuel = "coal"', "cycle.fuel", "write petrol or diesel"),
    "fuel of half a kilogram": ("petrol-four", "excess_air = 0.96",
                                'fuel = { carbon = 0.5, hydrogen = 0.1, heating_value = "44 MJ/kg" }', "cycle.fuel",
                                "add up to 0.6"),
    "burning too long": ("two-stroke", '"48 deg"', '"150 deg"', "cycle", "shorten the burning"),
    "no heat": ("two-stroke", 'cycle_heat = "560 J"\n', "", "cycle", 'cycle_heat = "1500 J"'),
    "fuel without heating value": ("two-stroke", 'cycle_heat = "560 J"', 'fuel_mass = "0.013 g"', "cycle",
                                   'and heating_value = "44 MJ/kg"'),
    "heat and fuel": ("two-stroke", 'cycle_heat = "560 J"', 'cycle_heat = "560 J"\nfuel_mass = "0.013 g"',
                      "cycle.cycle_heat", "cycle_heat and fuel_mass say the heat of the fuel twice"),
    "exponent of one": ("petrol-four", "1.377", "1.0", "cycle", "1.0001"),
    "temperature without a scale": ("petrol-four", '"293 K"', "293", "cycle.ambient_temperature", "has no unit"),
    "pressure of nothing": ("petrol-four", '"0.085 MPa"', '"0 MPa"', "cycle.intake_pressure",
                            'write at least "0.0001 MPa"'),
    "counterweights twice": ("petrol-four", "[balance]", 'counterweight = "0.02 kg*m"\n[balance]',
                             "bearings.counterweight", "counterweights of balance.rotating_share; keep one"),
    "metric or not": ("narrow-v6", 'kind = "petrol"', 'kind = "petrol"\npower = "80 hp"', "cycle.power",
                      '"80 PS" for the first, "80 hp(I)" for the second, or the power in kW'),
    "heat of a dozen cylinders": ("two-stroke", "560 J", "56 kJ", "cycle", "more than any fuel gives; write less"),
    "no radius, as a power would give": ("petrol-four", 'radius = "39 mm"\n', "", "crank.radius", "is missing"),
    "intake below the residual gas": ("petrol-four", '"0.085 MPa"', '"0.005 MPa"', "cycle", "no fresh charge"),
}  # fmt: skip


def engine(name, *changes):
    """Write the file of an engine with pieces of an example replaced."""
    text = (EXAMPLES / f"{name}.toml").read_text("utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    Path("engine.toml").write_text(text, "utf-8")
    return "engine.toml"


@for_each(("name", "old", "new", "key", "advice"), MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake_is_told_with_its_fix(crankwork, name, old, new, key, advice):
    answer = crankwork("check", engine(name, (old, new)))
    assert answer.code == 2
    assert "Traceback" not in answer.err
    told = [line for line in answer.mistakes if f": {key}: " in line]
    assert told, answer.err
    assert advice in told[0]


SETTINGS = {
    "gas hotter than the laws of heat reach": (
        "radial-five", ("cylinder.compression_ratio=100", "cycle.compression_exponent=3"),
        "cycle: at the end of compression the gas has",
        "K, for which no heat capacities are known; lower compression_ratio",
    ),
    "a W without bank angles": ("v8-diesel", ("engine.layout=W",), "engine.bank_angles: ", "is missing"),
    "a cylinder that its walls cool at once": (
        "two-stroke", ("crank.speed=0.001 rpm",), "cycle: the pressure cannot be followed from 344 to 392 deg: at",
        "changes too fast; correct speed, bore",
    ),
}  # fmt: skip


@for_each("case", SETTINGS.values(), ids=list(SETTINGS))
def test_settings_that_cannot_be_are_refused_with_what_to_correct(crankwork, case):
    name, settings, wrong, advice = case
    answer = crankwork("check", engine(name), *(word for one in settings for word in ("--set", one)))
    assert answer.code == 2
    assert wrong in answer.err
    assert advice in answer.err


def test_several_mistakes_at_once(crankwork):
    changes = (ORDER, "firing_order = [1, 1, 4, 2]"), ('"0.085 MPa"', "0.085"), ("rod]", "rood]")
    answer = crankwork("check", engine("petrol-four", *changes))
    assert answer.code == 2
    assert len(answer.mistakes) >= 2
    assert "did you mean rod" in answer.err


def test_uneven_intervals_are_said_with_the_intervals(crankwork):
    throws = 'throws = ["0 deg", "90 deg", "270 deg", "180 deg"]'
    change = ('bank_angle = "90 deg"', f'bank_angle = "60 deg"\n{throws}')
    answer = crankwork("check", engine("v8-diesel", change))
    assert answer.code == 0
    assert "uneven intervals" in answer.out
    meant = engine("v8-diesel", change, ("[engine]", "[engine]\nuneven = true"))
    assert "uneven" not in crankwork("check", meant).out


OUTSIDE = {
    ("compression_ratio = 8.5", "compression_ratio = 14.5"): "knock",
    ("excess_air = 0.96", "excess_air = 2.5"): "excess air",
    ('"1060 K"', '"700 K"'): "residual gas",
    ("compression_exponent = 1.377", "compression_exponent = 1.6"): "compression",
}


def test_values_outside_a_correlation_are_said_and_used(crankwork):
    found = {}
    before = crankwork("run", engine("petrol-four"), "--json").out
    for change, said in OUTSIDE.items():
        answer = crankwork("run", engine("petrol-four", change), "--json")
        notes = [line for line in crankwork("check", "engine.toml").out.splitlines() if line.startswith("note:")]
        found[change] = (answer.code, answer.out != before, [said for line in notes if said in line][:1])
    assert found == {change: (0, True, [said]) for change, said in OUTSIDE.items()}


def test_measured_pressure_over_half_a_cycle_is_refused(crankwork):
    angle = np.arange(0.0, 361.0, 1.0)
    Path("p.csv").write_text("\n".join(["angle,p", *(f"{one},{0.2 + 0.1 * np.cos(np.radians(one))}" for one in angle)]))
    gas = '[gas]\ncycle = "720 deg"\n[gas.measured]\nfile = "p.csv"\npressure_unit = "MPa"\n'
    text = (EXAMPLES / "petrol-four.toml").read_text("utf-8")
    cycle = text[text.index("[cycle]") : text.index("[bearings]")]
    answer = crankwork("check", engine("petrol-four", (cycle, gas)))
    assert answer.code == 2
    assert "gas.measured" in answer.err
    assert "720" in answer.err


def test_power_gives_bore_and_stroke(crankwork):
    changes = (
        ('radius = "39 mm"\n', ""),
        ('bore = "78 mm"\n', ""),
        ('kind = "petrol"', 'kind = "petrol"\npower = "60 kW"'),
    )
    answer = crankwork("check", engine("petrol-four", *changes))
    assert answer.code == 0
    assert "rounded to 78 and 78 mm" in answer.out


def test_forces_per_area_and_the_speed_are_those_of_the_file(crankwork):
    answer = crankwork("run", engine("petrol-four"), "--per-area", "-o", "out", "--no-figures")
    assert answer.code == 0, answer.err
    assert "5600 rpm" in answer.out
    heading = Path("out/tables/bearings.csv").read_text("utf-8").splitlines()[0]
    assert "crankpin_load.1 [MPa]" in heading


def test_an_engine_of_which_only_the_motion_is_known_says_so(crankwork):
    text = '[crank]\nradius = "40 mm"\nspeed = "3000 rpm"\n[rod]\nratio = 0.25\n'
    Path("engine.toml").write_text(text + '[engine]\nlayout = "inline"\ncylinders = 4\n', "utf-8")
    answer = crankwork("check", "engine.toml")
    assert answer.code == 0
    assert "motion only" in answer.out


@for_each("ratio", ["4", "1.5", "1.0000001", "1"])
def test_the_ratio_that_is_advised_may_be_written(crankwork, machine_file, ratio) -> None:
    file = machine_file(name="slider-crank")
    told = crankwork("check", file, "--set", f"rod.ratio={ratio}").err
    advised = re.search(r"write (0\.\d+)", told)
    assert advised, told
    assert crankwork("check", file, "--set", f"rod.ratio={advised[1]}").code == 0
