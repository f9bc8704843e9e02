"""What an explanation says to be given is what the file states where it is said to stand."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import crankwork
from crankwork.cli import commands
from crankwork.description.origins import origins
from crankwork.errors import CrankworkError
from crankwork.formula.known import Given, Known, OfAngle, Table, in_order
from crankwork.formula.lines import ValueLine
from crankwork.formula.replay import replay
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.note.equations import shown_values
from crankwork.quantities import QUANTITIES, base_key
from crankwork.units import UNITS, parse, to_si

TEMPLATES = Path(crankwork.__file__).parent / "description" / "templates"
FOLDERS = (Path("examples"), TEMPLATES, Path("tests/machines"))
FILES = [one for folder in FOLDERS for one in sorted(folder.glob("*.toml"))]
CASES = [(file, way) for file in FILES for way in ("exact", "textbook")]
DIMENSIONS = tuple({one.dimension for one in UNITS.values()})
# what no key of a file states
CONSTANTS = {
    "branch", "compressor_exponent", "cooler_drop", "cooling_exponent", "cooling_factor", "cycle_angle",
    "exhaust_exponent",
    "gear_meshes", "heat_zero_temperature",
    "hydrogen_share", "lower_pairs", "molar_gas_constant", "moving_links", "polytropic_exponent",
    "specific_gas_constant",
}  # fmt: skip


def leaves(file, way):
    try:
        results = crankwork.analyse(crankwork.read(file, [f"method.kinematics={way}"]))
    except CrankworkError:
        assert way == "textbook"
        return
    for known in in_order(results.memory.values()):
        if isinstance(known.node, Given) and not known.is_absent:
            yield known


def numbers_of(known):
    """Return the number of a leaf in SI, and as it may be printed without a unit."""
    unit = known.node.unit
    if unit:
        return [float(to_si(known.value, unit)), known.value]
    return [known.value, *(number for number, _ in shown_values(ValueLine(known.key, known.value)))]


def stated(values, path):
    """Return what a file states at a path, read by nothing of crankwork but the table of units."""
    for name in re.split(r"[.\[]", path):
        values = values[int(name[:-1]) - 1] if name.endswith("]") else values[name]
    return values


@pytest.mark.parametrize(
    ("file", "way"), CASES, ids=lambda one: "/".join(one.parts[-2:]) if isinstance(one, Path) else one
)
def test_a_given_value_is_what_the_file_states(file, way):
    source = file.read_text(encoding="utf-8")
    values, lines, origin = tomllib.loads(source), source.splitlines(), origins(file)
    wrong = []
    for known in leaves(file, way):
        key, path, numbers = known.key, known.node.path, numbers_of(known)
        if base_key(key) not in QUANTITIES:
            wrong.append(f"{path or known.value}: no quantity is called {key!r}")
        if not path:
            wrong += [] if key in CONSTANTS else [f"{key}: comes from nowhere"]
            continue
        where = origin(path, numbers)
        if where.kind != "line":
            # what follows from a key stands in the file, and a default does not
            assert where.kind == ("follows_line" if where.line else "default")
            continue
        text = stated(values, where.path)
        number = parse(text, DIMENSIONS)[0] if isinstance(text, str) else text
        if not any(math.isclose(number, one, rel_tol=1e-9) for one in numbers):
            wrong.append(f"{key} = {numbers}: {where.path} is {text}")
        name = re.sub(r"(\[\d+\])+$", "", where.path).rpartition(".")[2]
        if name not in "".join(lines[int(where.line) - 1 : int(where.line)]) and "[" not in where.path:
            wrong.append(f"{key}: line {where.line} does not state {where.path}")
    assert wrong == []


def explained(file, *arguments):
    result = CliRunner().invoke(commands, ["explain", str(file), *arguments], catch_exceptions=False)
    assert result.exit_code == 0
    return [line.strip() for line in result.output.replace("\u00a0", " ").splitlines()]


def line_of(file, text, after=""):
    lines = Path(file).read_text(encoding="utf-8").splitlines()
    begin = next(number for number, one in enumerate(lines) if after in one)
    return next(number for number, one in enumerate(lines, start=1) if number > begin and one.startswith(text))


@pytest.mark.parametrize(
    ("name", "arguments", "shown", "key", "table"),
    [
        ("two-stroke", ("gas_pressure", "--at", "33"), "n = 5000 rpm   crank.speed", "speed", "[crank]"),
        ("radial-five", ("crank_torque", "--at", "33"), "n = 1900 rpm   crank.speed", "speed", "[crank]"),
        ("radial-five", ("crank_torque", "--at", "33"), "S = 0.115 m = 115 mm   crank.stroke", "stroke", "[crank]"),
        ("v8-diesel", ("crank_torque", "--at", "33"), "λ = 0.27   rod.ratio", "ratio", "[rod]"),
        ("spark-engine", ("piston_mass",), "m′_p = 158.7 kg/m² = 15.87 g/cm²   piston.mass", "mass", "[piston]"),
        ("press", ("rotational_speed",), "n = 14.65 rad/s = 139.897 rpm   crank.speed", "speed", "[crank]"),
        ("press-geometry", ("kinetic_energy", "--at=9"), "m_punch = 102 kg   sliders.punch.mass", "punch", "[sliders]"),
    ],
)  # fmt: skip
def test_a_leaf_is_what_stands_on_its_line(name, arguments, shown, key, table):
    file = Path("examples") / f"{name}.toml"
    assert f"{shown}, line {line_of(file, key, table)}" in explained(file, *arguments)


def test_what_is_set_on_the_command_line_stands_on_no_line():
    lines = explained("examples/v8-diesel.toml", "crank_torque", "--at", "33", "--set", "rod.ratio=0.3")
    assert "λ = 0.3   rod.ratio, set on the command line by --set" in lines


def test_each_polytrope_has_the_exponent_of_its_piece():
    file = Path("examples/spark-engine.toml")
    exponents = [
        line for at in ("200", "400") for line in explained(file, "gas_pressure", "--at", at) if "].exponent" in line
    ]
    stated = [
        number for number, one in enumerate(file.read_text(encoding="utf-8").splitlines(), 1) if "exponent" in one
    ]
    assert [int(one.rpartition(" ")[2]) for one in exponents] == stated


def test_a_measured_pressure_names_its_samples(tmp_path):
    rows = [f"{angle},{1e5 + 5e6 * math.exp(-(((angle - 370) / 30) ** 2)):.1f}" for angle in range(0, 720, 2)]
    (tmp_path / "p.csv").write_text("\n".join(["deg,Pa", *rows]), encoding="utf-8")
    source = Path("examples/slider-crank.toml").read_text(encoding="utf-8")
    source += '[cylinder]\nbore = "80 mm"\ncompression_ratio = 9\n[gas]\ncycle = "720 deg"\npressures = "absolute"\n'
    source += '[gas.measured]\nfile = "p.csv"\npressure_unit = "Pa"\n'
    (tmp_path / "e.toml").write_text(source, encoding="utf-8")
    lines = explained(tmp_path / "e.toml", "diagram_pressure", "--at", "371")
    assert any(one.startswith("p = measured, between two samples = p_(i)·(1 + 2·τ)·") for one in lines)
    assert "p_(i) = 5.1·10⁶ Pa = 5.1 MPa   p.csv, line 187" in lines
    assert "φ_j = 6.49262 rad = 372°   p.csv, line 188" in lines


def test_a_table_shows_the_rows_that_a_value_lies_between(tmp_path):
    (tmp_path / "press.toml").write_text(crankwork.template("toggle-press"), encoding="utf-8")
    lines = explained(tmp_path / "press.toml", "static_torque", "--at", "250")
    force = [one for one in lines if "loads[1].force[" in one]
    assert len(force) == 2
    assert any(
        re.match(r"F_p,ram = table of given values = F_p,ram,i \+ \(F_p,ram,j − F_p,ram,i\)·τ = ", one) for one in lines
    )


def test_a_corner_of_a_calculated_diagram_prints_its_cubic():
    for language, word in (("vi", "đường cong nối"), ("ru", "плавная кривая")):
        lines = explained("examples/v8-diesel.toml", "gas_pressure", "--at", "370", "--lang", language)
        assert any(one.startswith(f"p = {word}") and "·τ·τ·" in one for one in lines)
        assert not any("làm tròn" in one or "округлено" in one for one in lines)


def test_an_error_is_the_difference_of_both_methods():
    lines = explained("examples/spark-engine.toml", "piston_acceleration_error", "--method", "textbook")
    assert any(re.fullmatch(r"Δa = a − a_ex = −767.2 − \(−792.361\) = 25.1608 m/s²", one) for one in lines)


@pytest.mark.parametrize("file", FILES, ids=lambda one: "/".join(one.parts[-2:]))
def test_a_value_of_a_curve_is_that_of_its_points(file):
    results = crankwork.analyse(crankwork.read(file))
    for known in in_order(results.memory.values()):
        node = known.node
        if not isinstance(node, Table) or node.by is not None or not hasattr(node.function, "between"):
            continue
        inside = [one for one in results.grid.degrees if not node.knots or node.knots[0] <= one <= node.knots[-1]]
        for degrees in (*inside[::7], *node.knots[:3]):
            spelt = node.function.between(float(degrees), Known(OfAngle("angle"), "crank_angle"))
            table = float(node.function(np.array([float(degrees)]))[0])
            value = float(replay(spelt, CrankGrid.from_degrees([float(degrees)]))[0])
            assert value == pytest.approx(table, rel=1e-9)


def test_a_constant_law_says_which_value_holds():
    lines = explained("examples/spark-engine.toml", "gas_pressure", "--at", "100")
    assert "p_g = p_(d) = 80000 Pa = 0.08 MPa   (law from 5° to 180°)" in lines
    assert any(re.fullmatch(r"p_\(d\) = 80000 Pa = 0.08 MPa   gas.points.d.pressure, line \d+", one) for one in lines)


def test_a_key_is_listed_once_and_says_whether_it_varies():
    lines = explained("examples/spark-engine.toml", "--list")
    keys = [one.split()[0] for one in lines]
    assert len(keys) == len(set(keys))
    (line,) = (one for one in lines if one.startswith("rotating_inertia_force"))
    assert "(φ)" not in line
