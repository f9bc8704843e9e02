"""Tables of pressures over the stroke, as sheets print them, against interpolation and sums of numpy and SciPy."""

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork
from each import for_each
from machine_texts import analysed

MACHINES = Path(__file__).parents[1] / "machines"
TABLE = (MACHINES / "stroke-table-engine.toml").read_text("utf-8")
COMPRESSOR = (MACHINES / "stroke-table-compressor.toml").read_text("utf-8")
SHARES = [0, 0.025, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1]
LISTS = [
    [0.018, 0.006, 0, -0.01, -0.015, -0.02, -0.02, -0.02, -0.02, -0.015, -0.012, -0.01, -0.005],
    [0.47, 0.37, 0.3, 0.2, 0.12, 0.075, 0.05, 0.03, 0.018, 0.01, 0.004, 0, -0.005],
    [0.47, 1, 0.92, 0.69, 0.45, 0.33, 0.25, 0.2, 0.165, 0.14, 0.12, 0.1, 0.07],
    [0.018, 0.018, 0.018, 0.018, 0.019, 0.02, 0.021, 0.022, 0.024, 0.027, 0.032, 0.042, 0.07],
]
LARGEST, STROKE, BORE, RATIO, SPEED = 4.2e6, 0.092, 0.088, 0.27, 3200 * math.pi / 30
AREA = math.pi * BORE**2 / 4


def _travel(degrees: np.ndarray, radius: float, length: float, offset: float = 0.0) -> np.ndarray:
    """Return the way of the piston from its top dead centre. [m]"""
    phi = np.radians(degrees)
    top = math.sqrt((radius + length) ** 2 - offset**2)
    return top - radius * np.cos(phi) - np.sqrt(length**2 - (radius * np.sin(phi) - offset) ** 2)


@pytest.mark.elsewhere
def test_pressure_forces_and_mean_pressure_of_a_four_stroke_sheet() -> None:
    degrees = np.arange(2.5, 720.0, 5.0)
    results = analysed(TABLE, *degrees)
    shares = _travel(degrees, STROKE / 2, STROKE / 2 / RATIO) / STROKE
    pressure = LARGEST * np.array([
        np.interp(share, SHARES, LISTS[int(phi // 180)]) for phi, share in zip(degrees, shares, strict=True)
    ])  # fmt: skip
    assert results.columns["gas_pressure"] == pytest.approx(pressure, rel=1e-9, abs=1e-3)
    sin_beta = RATIO * np.sin(np.radians(degrees))
    beta, phi = np.arcsin(sin_beta), np.radians(degrees)
    acceleration = STROKE / 2 * SPEED**2 * (
        np.cos(phi + beta) / np.cos(beta) + RATIO * np.cos(phi) ** 2 / np.cos(beta) ** 3
    )  # fmt: skip
    force = pressure * AREA - (0.6 + 0.3 * 0.8) * acceleration
    assert results.columns["piston_force"] == pytest.approx(force, rel=1e-9, abs=1e-6)
    assert results.columns["tangential_force"] == pytest.approx(force * np.sin(phi + beta) / np.cos(beta), rel=1e-9)
    under = [np.trapezoid(pressures, SHARES) for pressures in LISTS]
    mean = LARGEST * (under[0] - under[1] + under[2] - under[3])
    assert results["indicated_mean_pressure"] == pytest.approx(mean, rel=1e-12)
    assert results["mean_torque"] == pytest.approx(mean * AREA * STROKE / (4 * math.pi), rel=1e-12)
    assert max(results.checks.values()) < 1e-12
    assert not {item.code for item in results.notices} & {"jump"}


DOWN = [0.40, 0.20, 0.13, *[0.095] * 9]
UP = [0.40, 0.40, 0.40, 0.40, 0.30, 0.24, 0.20, 0.17, 0.15, 0.132, 0.118, 0.105]
COARSE = [0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1]


@pytest.mark.elsewhere
@for_each("law", ("straight", "rounded"))
def test_an_offset_compressor_counts_from_its_own_dead_centres(law: str) -> None:
    from scipy.interpolate import PchipInterpolator
    from scipy.optimize import brentq

    sizes = (0.06, 0.24, 0.012)
    top, bottom = math.degrees(math.asin(0.012 / 0.3)), 180 + math.degrees(math.asin(0.012 / 0.18))
    stroke = float(_travel(np.array([bottom]), *sizes)[0])
    degrees = np.arange(5.0, 360.0, 7.0)
    expected = np.empty(len(degrees))
    for start, end, pressures in ((top, bottom, DOWN), (bottom, top + 360, UP)):
        part = (degrees > start) & (degrees <= end)
        travel = _travel(degrees[part], *sizes)
        if law == "straight":
            expected[part] = np.interp(travel, stroke * np.array(COARSE), pressures)
            continue
        knots = [
            brentq(lambda phi, share=share: _travel(phi, *sizes) - share * stroke, start, end, xtol=1e-12)
            for share in COARSE[1:-1]
        ]
        knots, values = [start, *sorted(knots), end], pressures if start == top else pressures[::-1]
        expected[part] = PchipInterpolator(knots, values)(degrees[part])
    results = analysed(COMPRESSOR.replace('law = "rounded"', f'law = "{law}"'), *degrees)
    assert results.columns["gas_pressure"] == pytest.approx(1e6 * (expected - 0.1), rel=1e-8, abs=0.1)
    jumps = [(item.values["angle"], item.values["step"]) for item in results.notices if item.code == "jump"]
    assert jumps == [(pytest.approx(bottom), pytest.approx(0.01e6))]
    if law == "straight":
        mean = 1e6 * (np.trapezoid(DOWN, COARSE) - np.trapezoid(UP, COARSE))
        assert results["indicated_mean_pressure"] == pytest.approx(mean, rel=1e-12)


DOUBLE = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "100 mm", speed = "300 rpm", start = "180 deg" }
links.rod = { joins = ["A", "B"], length = "400 mm" }
guides.bed = { through = "O" }
sliders.piston = { guide = "bed", pin = "B", mass = "8 kg" }
branch.B = -1
[chambers.head]
slider = "piston"
bore = "150 mm"
[chambers.crank]
slider = "piston"
bore = "150 mm"
rod_diameter = "40 mm"
sense = -1
"""
STEAM = """
[chambers.{name}.strokes]
shares = [0, 0.3, 0.6, 1]
down = [1, 1, 0.5, 0.25]
up = [0.3, 0.1, 0.1, 0.1]
largest = "0.8 MPa"
"""


@pytest.mark.elsewhere
def test_both_sides_of_a_piston_have_the_table_from_their_own_dead_centres() -> None:
    text = DOUBLE + STEAM.format(name="head") + STEAM.format(name="crank")
    degrees = np.arange(5.0, 360.0, 10.0)
    results = analysed(text, *degrees)
    travel = _travel(degrees, 0.1, 0.4) / 0.2

    def table(share: np.ndarray, *, falls: np.ndarray) -> np.ndarray:
        shares = [0, 0.3, 0.6, 1]
        down, up = np.interp(share, shares, [1, 1, 0.5, 0.25]), np.interp(share, shares, [0.3, 0.1, 0.1, 0.1])
        return 0.8e6 * np.where(falls, up, down)

    head, crank = table(travel, falls=degrees > 180), table(1 - travel, falls=degrees < 180)
    assert results.columns["gas_pressure.head"] == pytest.approx(head, rel=1e-9)
    assert results.columns["gas_pressure.crank"] == pytest.approx(crank, rel=1e-9)
    mean = 0.8e6 * (
        np.trapezoid([1, 1, 0.5, 0.25], [0, 0.3, 0.6, 1]) - np.trapezoid([0.3, 0.1, 0.1, 0.1], [0, 0.3, 0.6, 1])
    )
    areas = math.pi / 4 * (2 * 0.15**2 - 0.04**2)
    assert results["mean_torque"] == pytest.approx(mean * areas * 0.2 / math.tau, rel=1e-9)


@pytest.mark.elsewhere
def test_the_largest_pressure_and_the_stroke_are_swept() -> None:
    changes = {"gas.strokes.largest": ["4.2 MPa", "5 MPa"], "crank.stroke": ["92 mm", "80 mm"],
               "gas.strokes.expansion[3]": [0.92, 0.8]}  # fmt: skip
    designs = crankwork.sweep(
        crankwork.Description(TABLE), changes, ["indicated_mean_pressure", "gas_pressure_max", "indicated_work"]
    )
    less = np.trapezoid(LISTS[2], SHARES) - np.trapezoid([*LISTS[2][:2], 0.8, *LISTS[2][3:]], SHARES)
    means = [np.trapezoid(pressures, SHARES) for pressures in LISTS]
    mean = means[0] - means[1] + means[2] - means[3]
    assert not designs.reason
    for largest, stroke, ratio, found, peak, work in zip(
        *(designs.fields[key] for key in changes), *designs.values.values(), strict=True
    ):
        wanted = largest * (mean - (less if ratio < 0.9 else 0.0))
        assert found == pytest.approx(wanted, rel=1e-9)
        assert peak == pytest.approx(largest, rel=1e-9)
        assert work == pytest.approx(wanted * AREA * stroke, rel=1e-9)


@pytest.mark.elsewhere
def test_straight_lines_between_points() -> None:
    """A triangle in the diagram over the volume: half of its base times its height."""
    text = """
        crank = { radius = "50 mm", speed = "600 rpm" }
        rod.ratio = 0.25
        cylinder.bore = "100 mm"
        gas.cycle = "360 deg"
        gas.points.a = { stroke = 0, pressure = "1 MPa" }
        gas.points.b = { stroke = 1, pressure = "0 MPa" }
        gas.points.c = { stroke = 0, pressure = "0 MPa" }
        gas.points.d = { angle = "360 deg", pressure = "1 MPa" }
        gas.pieces = [{ law = "straight", points = ["a", "b"] }, { law = "straight", points = ["b", "c"] },
                      { law = "constant", points = ["c", "d"] }]
    """
    results = analysed(text)
    assert results["indicated_mean_pressure"] == pytest.approx(0.5e6, rel=1e-12)
    with pytest.raises(
        crankwork.InputError, match=r"gas.pieces\[1\].points: goes on beyond the dead centre at 180 deg"
    ):
        crankwork.read_machine(text.replace('"a", "b"] }, { law = "straight", points = [', '"a", '))


def test_the_expansion_states_the_same_table() -> None:
    for text in (TABLE, COMPRESSOR):
        own = analysed(text)
        linkage = crankwork.analyse(crankwork.read_machine(_expanded(text)))
        assert linkage["mean_torque"] == pytest.approx(own["mean_torque"], rel=1e-9)


def _expanded(text: str) -> str:
    from crankwork.description.shorthand import linkage_of
    from crankwork.description.toml_edit import document

    return document(linkage_of(crankwork.Description(text)))


MISTAKES = {
    ("0.07]\nlargest", "]\nlargest"): "gas.strokes.exhaust: has 12 values for 13 of shares",
    ("[0.47,  1, ", "[0.47,  1.2, "): "gas.strokes.expansion[2]: 1.2 is out of range",
    ("0.05,  0.1, ", "0.1,  0.05, "): "gas.strokes.shares: must rise from 0",
    ("0.9,    1]", "0.9,    0.99]"): "gas.strokes.shares: must rise from 0",
    ("exhaust =", "up ="): "gas.strokes.exhaust: is missing; write exhaust = [...]",
    ("720 deg", "360 deg"): 'gas.strokes.intake: means nothing with cycle = "360 deg"',
    ('largest = "4.2 MPa"', ""): 'gas.strokes.largest: is missing; write largest = "4 MPa"',
    ('largest = "4.2 MPa"', 'largest = "4 MPa"\nunit = "bar"'): "gas.strokes.unit: says the same as largest",
    ('cycle = "720 deg"', 'cycle = "720 deg"\npressures = "absolute"'): "gas.strokes.intake[4]: is below vacuum",
    ("4.2 MPa", "-4.2 MPa"): 'gas.strokes.largest: "-4.2 MPa" is out of range; write more than "0 MPa"',
    ("[gas.strokes]", "[gas.points]\na.stroke = 0\n[gas.strokes]"): "gas.strokes: says the same as points",
}


@for_each("change", MISTAKES)
def test_mistakes_are_told(change: tuple[str, str]) -> None:
    assert change[0] in TABLE
    with pytest.raises(crankwork.InputError) as refused:
        crankwork.read_machine(TABLE.replace(*change))
    assert MISTAKES[change] in str(refused.value)
