"""What was taken for nothing, or ended in an error of Python, is told at its line."""

import re

import pytest

import crankwork
from crankwork import template
from crankwork.locale import LANGUAGES, in_language
from each import for_each
from expansions import machine_files

FILES = machine_files("tests/machines")
FOUR_BAR, PRESS, GEARED, STAGES, BURNING = (
    template("four-bar"), template("toggle-press"),
    *(FILES[name] for name in ("toothed-five-bar", "stages-by-size", "burning")),
)  # fmt: skip
PLACED = "has its place already"
TEST = """
crank = { stroke = "86 mm", speed = "3000 rpm" }
rod.ratio = 0.28
cylinder = { bore = "86 mm", compression_ratio = 9 }
gas.cycle = "720 deg"
gas.points = { a = { angle = "0 deg", pressure = "0 MPa" }, b = { angle = "720 deg", pressure = "0 MPa" } }
gas.pieces = [{ law = "constant", points = ["a", "b"] }]
test.effective_torque = "1 N*m"
"""

MISTAKES = [
    (FOUR_BAR, 'radius = "62.5 mm"', 'radius = "62.5 mm"\npoints.A = ["1 mm", "2 mm"]', "crank.points.A", PLACED),
    (FOUR_BAR, 'radius = "62.5 mm"', 'radius = "62.5 mm"\npoints.O = ["1 mm", "2 mm"]', "crank.points.O", PLACED),
    (FOUR_BAR, 'radius = "62.5 mm"', 'radius = "62.5 mm"\npoints.C = ["1 mm", "2 mm"]', "crank.points.C", PLACED),
    (FOUR_BAR, 'radius = "62.5 mm"', 'radius = "62.5 mm"\npoints.X = ["1 mm", "2 mm"]', None, None),
    (PRESS, 'pin = "D"', 'pin = "D", points = { D = ["1 mm", "2 mm"] }', "sliders.ram.points.D", PLACED),
    (GEARED, "points = { D =", 'points = { A = ["1 mm", "0 mm"], D =', "geared.second.points.A", PLACED),
    (FOUR_BAR, 'mass = "1.5 kg"', 'mass = "1e-310 kg"', "links.coupler.mass", "too small to calculate with"),
    (FOUR_BAR, 'mass = "1.5 kg"', 'mass = "1e-20 kg"', "links.coupler.mass", "out of range"),
    (STAGES, 'temperature_limit = "430 K"', 'temperature_limit = "290 K"', "stages.temperature_limit", "at 305 K"),
    (STAGES, "exponent = 1.3", "exponent = 1", "stages.temperature_limit", "with the exponent 1 keeps"),
    (STAGES, "exponent = 1.3", "exponent = 1.0000001", "stages.temperature_limit", "keeps to no such limit"),
    (BURNING, "43.094", "1e-300", "gas.measured", "no pressure left at 374 deg"),
    (BURNING, " 1.18103, ", " 1e-300, ", "gas.measured", "no pressure left at"),
    (BURNING, "values = [", "x = [", "gas.measured.x", "unknown key"),
    (BURNING, 'pressure_unit = "bar"\nvalues = [', 'values = "1 mm"\npeg = [', "gas.measured.values", "must be a list"),
    (TEST, "1 N*m", "2 N*m", "test", "no mechanical efficiency follows"),
    (TEST, 'law = "constant"', 'law = "constant", exponent = 1.3', "gas.pieces[1].exponent", "polytropic"),
    (TEST, 'law = "constant"', 'law = "constant", reference = "a"', "gas.pieces[1].reference", "polytropic"),
]  # fmt: skip


@for_each(("text", "old", "new", "key", "message"), MISTAKES, ids=[f"{one[3]}: {one[2][:30]}" for one in MISTAKES])
def test_it_is_told_at_its_line(text, old, new, key, message):
    changed = text.replace(old, new, 1)
    assert changed != text
    if key is None:
        crankwork.read_machine(changed)
        return
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(changed, "my.toml")
    problems = {one.key: one.message for one in refused.value.problems}
    assert message in problems[key]
    for line in str(refused.value).splitlines():
        assert re.match(r"my\.toml:\d+: ", line)
    assert all(in_language(one, language) for one in problems.values() for language in LANGUAGES)
