"""An engine file and the file of the linkage that it is give the same results under the same keys."""

from __future__ import annotations

import functools
import math
import tempfile
import tomllib
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from crankwork import Description, analyse, read_machine, template
from crankwork.analysis.results import Results
from crankwork.description.document import numeric_field
from crankwork.description.shorthand import expanded
from crankwork.errors import RenamedKeyWarning
from crankwork.quantities.key import RENAMED
from crankwork.study.variants import MachineVariants
from each import for_each
from expansions import ROOT, WAYS, differences, differences_as_drawn, machine_files
from shown import in_parts

FILES = machine_files("examples")
# a linkage has no torsional vibration
ENGINES = [name for name, text in FILES.items() if "rod" in (values := tomllib.loads(text)) and "torsion" not in values]
LIGHT = ["compressor", "slider-crank"]
EXACT = "method.kinematics=exact"


@functools.cache
def linkage_text(name: str) -> str:
    """Return the file of the linkage that an engine is, its motion by the exact method."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "machine.toml"
        path.write_text(FILES[name], "utf-8")
        return expanded(path, [EXACT])


@functools.cache
def both(name: str) -> tuple[Results, Results]:
    """Return the results of an engine and of its linkage."""
    engine = analyse(read_machine(FILES[name], overrides=[EXACT], folder=ROOT))
    return engine, analyse(read_machine(linkage_text(name), folder=ROOT))


@in_parts("name", LIGHT, [name for name in ENGINES if name not in LIGHT])
def test_an_engine_and_its_linkage_have_the_same_results(name):
    engine, values = both(name)[0], tomllib.loads(linkage_text(name))
    for way in WAYS:
        assert differences_as_drawn(engine, values, way) == []


@in_parts(("name", "method"), [("compressor", "textbook"), ("slider-crank", "series:6")],
          [(name, "textbook") for name in ENGINES if name != "compressor"])  # fmt: skip
def test_an_engine_and_its_linkage_have_the_same_results_by_approximate_methods(name, method, tmp_path):
    path, setting = tmp_path / "machine.toml", f"method.kinematics={method}"
    path.write_text(FILES[name], "utf-8")
    engine = analyse(read_machine(FILES[name], overrides=[setting], folder=ROOT))
    linkage = analyse(read_machine(expanded(path, [setting]), folder=ROOT))
    assert engine.method.name == linkage.method.name == method
    assert "piston_velocity_error" in linkage.summary
    assert differences(engine.complete, linkage.complete) == []


REACHED = ["compressor", "engine"]
_ROW = 5


@in_parts("name", REACHED, [name for name in ENGINES if name not in REACHED])
def test_every_key_of_one_form_is_reached_from_the_other(name):
    engine, linkage = both(name)
    for results, other in ((engine, linkage), (linkage, engine)):
        keys = {*other.complete.summary, *other.complete.columns} | set(results.other)
        assert keys - {*other.summary, *other.columns}, "each form has keys that the other has not"
        for key in keys:
            with warnings.catch_warnings():
                # what an engine calls otherwise today
                warnings.simplefilter("ignore", RenamedKeyWarning)
                assert key in results, key
                wanted = results.complete[key]
                largest = np.nanmax(np.abs(wanted)) if np.any(np.isfinite(wanted)) else 0.0
                assert results[key] == pytest.approx(wanted, rel=0, abs=1e-9 * largest, nan_ok=True), key
                if np.ndim(wanted):
                    at = float(results.grid.degrees[_ROW])
                    if np.isfinite(wanted[_ROW]):
                        assert results.value(key, at) == pytest.approx(wanted[_ROW], rel=0, abs=1e-9 * largest), key
                else:
                    assert results.value(key) == pytest.approx(wanted, rel=1e-12), key


@for_each(("key", "at"), [("joint_force.B", 30.0), ("kinetic_energy", 30.0), ("crank_torque", 30.0), ("stroke", None)])
def test_a_value_of_the_other_form_is_explained(key, at):
    engine, linkage = both("compressor")
    first, second = (results.explain(key, at) for results in (engine, linkage))
    # the value stands in front of how it came about
    assert first.splitlines()[0] == second.splitlines()[0]
    assert len(first.splitlines()) > 2


# a number of each file, and values of the other form: of lengths alone, of masses, of gas
_SWEPT = {
    "engine": {
        "crank.speed": ["kinetic_energy_max", "shaking_force_max", "joint_force_max.B"],
        "piston.mass": ["shaking_force_max", "joint_force_max.O"],
        "rod.length": ["slider_velocity_max.piston", "joint_force_max.A"],
        "cylinder.bore": ["gas_force_max.cylinder", "joint_force_max.B"],
    },
    "linkage": {
        "crank.speed": ["piston_acceleration_max", "inertia_force_max"],
        "sliders.piston.mass": ["inertia_force_max", "crank_torque_max"],
        "links.rod.length": ["piston_velocity_max", "stroke"],
        "chambers.cylinder.bore": ["side_force_max", "indicated_power"],
    },
}


@in_parts(
    ("form", "number"),
    [("engine", "piston.mass"), ("linkage", "sliders.piston.mass")],
    [(form, number) for form, numbers in _SWEPT.items() for number in numbers],
)
def test_a_sweep_of_one_form_gives_values_of_the_other(form, number):
    text = template("compressor") if form == "engine" else linkage_text("compressor")
    description, keys = Description(text, "machine.toml"), [*_SWEPT[form][number]]
    keys = [key for key in keys if key in both("compressor")[0]]
    assert keys, number
    field = numeric_field(description.values, number)
    designs = field.now * np.array([[0.97, 1.0, 1.01, 1.03]])
    spans = np.array([[designs.min(), field.now, designs.max()]])
    variants = MachineVariants(description, {number: field}, spans, keys)
    variants.compile(None, designs[:, [0, 3]])
    found = variants.values(designs)
    assert not found.refused
    for design, column in zip(designs.T, found.values.T, strict=True):
        results = variants.results(design)
        assert column == pytest.approx([results.value(key) for key in keys], rel=1e-9), design
        # and the other file gives them too, with the same number written there
        other = {"engine": "linkage", "linkage": "engine"}[form]
        path = dict(zip(_SWEPT[form], _SWEPT[other], strict=True))[number]
        text = template("compressor") if other == "engine" else linkage_text("compressor")
        machine = read_machine(text, overrides=[f"{path}={field.written(float(design[0]))}"])
        # the inertia of a rod by its two masses is that of its length
        if number != "rod.length" or "joint_force_max.A" not in keys:
            assert column == pytest.approx([analyse(machine).value(key) for key in keys], rel=1e-9), (path, design)


@for_each("number", [0, 1])
def test_old_keys_tell_once_what_they_are_called_now(number):
    results = replace(both("petrol-four")[number], _noticed=set())
    for old, new in RENAMED.items():
        if new not in results:
            continue
        assert old in results
        with pytest.warns(RenamedKeyWarning, match=f"^{old} is called {new} now") as told:
            value = results[old]
        assert np.array_equal(value, results[new])
        assert len(told) == 1
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert np.array_equal(results[old], results[new])
            assert results.unit(old) == results.unit(new)
    assert {"mean_torque", "reduced_inertia"} <= {new for new in RENAMED.values() if new in results}


@pytest.mark.elsewhere
def test_what_speeds_up_the_parts_is_not_in_the_mean_torque():
    """The work of the diagram of a compressor in closed form; 200 rad/s2 of the parts take 1.49 N m more."""
    suction, discharge, rise, fall = 0.95e5, 5e5, 1.35, 1.25
    swept, least = math.pi / 4 * 0.1**2 * 0.08, 32e-6
    most, pressed = least + swept, (least + swept) * (suction / discharge) ** (1 / rise)
    expanded_to = least * (discharge / suction) ** (1 / fall)
    work = (discharge * pressed - suction * most) / (rise - 1) + discharge * (pressed - least)
    work -= (discharge * least - suction * expanded_to) / (fall - 1) + suction * (most - expanded_to)
    crank = '[crank]\nmass = "3 kg"\nangular_acceleration = "200 rad/s2"\n'
    text = template("compressor").replace("[crank]\n", crank)
    wheel = text + '\n[flywheel]\nfluctuation = 0.02\ninertia = "0.1 kg*m2"\n'
    for results in map(analyse, map(read_machine, (text, wheel))):
        for form in (results, results.other):
            assert form["mean_torque"] == pytest.approx(work / math.tau, rel=1e-9)
    # of the machine with its wheel that is the work which swings by the excess work
    assert results["energy_fluctuation"] == pytest.approx(results["excess_work"] / work, rel=1e-9)


def test_without_gas_no_work_is_done_in_a_cycle():
    """Weights of eight cylinders in line cancel but for 1e-4 N m of 3.9 N m, the mean of which is nothing."""
    text = """
crank = { stroke = "44.919216 mm", speed = "745.4 rpm", mass = "1.2 kg" }
rod = { ratio = 0.198, mass = "0.963 kg", small_end_share = 0.246, inertia = "0.006118 kg*m2" }
piston = { mass = "2.216 kg" }
cylinder = { bore = "52.692396 mm", compression_ratio = 11.92 }
engine = { layout = "inline", cylinders = 8, firing_order = [1, 6, 4, 2, 7, 5, 8, 3], strokes = 2 }
flywheel = { fluctuation = 0.02, inertia = "0.3 kg*m2" }
method = { weights = true }
"""
    summary = analyse(read_machine(text)).summary
    assert summary["mean_torque"] == 0.0
    assert "energy_fluctuation" not in summary
