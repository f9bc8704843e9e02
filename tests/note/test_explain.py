"""Every value of every machine is explained down to what is given."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

import crankwork
from crankwork.cli import commands
from crankwork.errors import CrankworkError
from crankwork.locale import texts
from crankwork.report.display import label
from note.built import EXAMPLES, LINKAGES, SOME, broken, looked_at, results, source

LATE = ("two-stroke", "v8-diesel")
ENGINES = ("spark-engine: exact", "v8-diesel", "radial-five", "two-stroke")


def explained(name: str | Path, arguments: str) -> list[str]:
    file = EXAMPLES / f"{name}.toml" if isinstance(name, str) else name
    result = CliRunner().invoke(commands, ["explain", str(file), *arguments.split()], catch_exceptions=False)
    assert result.exit_code == 0
    return [line.strip() for line in result.output.replace("\u00a0", " ").splitlines()]


def legend(told: str, language: str) -> list[tuple[str, str]]:
    """Return the symbols of the legend of an explanation, each with its words."""
    heading = {"en": "\nWhere\n", "ru": "\nГде\n", "vi": "\nTrong đó\n"}[language]
    listed = told.partition(heading)[2].partition("\n\n")[0].replace("\u00a0", " ")
    entries = " ".join(listed.split()).split("; ")
    return [tuple(one.split(" – ", 1)) for one in entries if " – " in one]


def english_words(told: str, text: str, language: str) -> set[str]:
    """Return the words in subscripts that neither the file nor the symbols of the language have."""
    known = set(re.findall(r"\w+", " ".join([text, *texts("symbols", language).values()]).replace("_", " ")))
    # what a crank is called that has no name of its own
    known |= set(re.findall(r"\w+", texts("report", language)["crank"]))
    # phase of a harmonic, with the letter that the crank angle has
    known |= {*texts("marks", language).values(), "max", "min", "sin", "cos", "tan", "exp", "abs", "kφ₀", "kα₀"}
    lines = [one for one in told.splitlines() if one.startswith("  ") and " = " in one]
    shown = {one for line in lines for one in re.findall(r"[^\W\d_]{3,}", line.split(" = ")[0])}
    return set() if language == "en" else shown - known


def two_meanings(told: str, language: str) -> list[str]:
    """Return the letters that stand for two quantities in one explanation."""
    found: dict[str, str] = {}
    return [f"{shown}: {words}" for shown, words in legend(told, language) if found.setdefault(shown, words) != words]


def wrong_explanations(case: str, seen: set[str]) -> list[str]:
    """Return what is wrong with the explanations of a machine, of every kind of value that is not seen yet."""
    found, wrong = results(case), []
    at = float(found.grid.degrees[len(found.grid) // 3])
    at = at * found.period / 360 if found.period else at
    for key in (*found.columns, *found.summary):
        wrong += [] if key in found.trace else [f"{key} is not remembered"]
        kind = re.sub(r"_(max|min)(_angle)?(?=\.|$)", "_max", key).partition(".")[0]
        if kind in seen:
            continue
        seen.add(kind)
        language = ("en", "ru", "vi")[len(seen) % 3]
        told = found.explain(key, at, language)
        wrong += [line for line in told.splitlines() if re.search(r"\?|nan|inf\b|_\.| = $", line)]
        wrong += two_meanings(told, language)
        wrong += english_words(told, source(case.partition(": ")[0]), language)
    return wrong


@looked_at(SOME, ENGINES, LINKAGES)
def test_every_kind_of_value_is_explained(cases):
    seen: set[str] = set()
    assert broken(lambda case: wrong_explanations(case, seen), cases) == {}


def without(lines: list[str], wanted: tuple[str, ...]) -> list[str]:
    """Return the wanted lines that do not follow one another, with … for whatever stands there."""
    left, missing = iter(lines), []
    for one in wanted:
        pattern = re.compile(".*".join(map(re.escape, one.split("…"))))
        if not any(pattern.fullmatch(line) for line in left):
            missing.append(one)
            left = iter(lines)
    return missing


# what is explained, and lines of its explanation in their order
FOLLOWED = {
    ("spark-engine", "crank_torque --at 390 --method textbook"): (
        "Crank torque: M(390°) = 712.026 N·m",
        "…(law from 375° to 505°)",
        "sin φ = sin 390° = 0.5",
        "sin β = λ·sin φ = 0.25·0.5 = 0.125   [1, ch. 6]",
        "M = F_T·r = 13459.84·0.0529 = 712.026 N·m   [1, ch. 7]",
        "Given values",
        "r = 0.0529 m = 52.9 mm   crank.radius, line …",
    ),
    ("spark-engine", "crank_torque_max --method textbook --set crank.radius=60mm"): (
        "Largest crank torque: M_max = 737.594 N·m",
        "At the crank angle 383.9096275°",
        "M_max = largest value (M), at 383.9096275° = 737.594 N·m",
        "r = 0.06 m = 60 mm   crank.radius, set on the command line by --set",
    ),
    ("spark-engine", "piston_acceleration --at 77 --method series:3"): (
        "x″_k2 = a_k,2·cos 2φ = …",
        "x″ = x″_k1 + x″_k2 = …",
    ),
    ("spark-engine", "mean_torque"): ("…mean over the cycle (M: crank torque) = …",),
    ("spark-engine", "weight_force --set method.weights=true"): ("…method.gravity: default, not in the file",),
    ("spark-engine", "gas_pressure --at 100"): (
        "p_g = p_(d) = 80000 Pa = 0.08 MPa   (law from 5° to 180°)",
        "p_(d) = 80000 Pa = 0.08 MPa   gas.points.d.pressure, line …",
    ),
    # an error is the difference of both methods
    ("spark-engine", "piston_acceleration_error --method textbook"): (
        "Δa = a − a_ex = −767.2 − (−792.361) = 25.1608 m/s²",
    ),
    # what is integrated
    ("petrol-four", "kinetic_energy_change --at 50"): ("ΔT = −∫(M_st − M_st,m) dφ = …",),
    # another cylinder is the first one later
    ("petrol-four", "total_torque --at 30 --method textbook"): (
        "F_T,4(30°) = F_T(390°) = …",
        "M_4 = F_T,4·r = …",
        "M_Σ = M_1 + M_2 + M_3 + M_4 = …",
    ),
    # what is made of an extreme stands after it
    ("petrol-four", "bearing_load_ratio.crankpin.1"): ("R_c,max,1 = …", "… = R_c,max,1/…", "Given values"),
    ("two-stroke", "cylinder_temperature_max"): ("p = …", "T_max = …", "Given values"),
    ("radial-five", "crank_torque.2 --at 100"): (
        "sin φ_m = sin (φ + 72°) = sin 460° = 0.984808",
        "sin β_m = λ_m·sin φ_m = 0.25·0.984808 = …",
        "cos β_1 = √(1 − (sin β_1)²) = …",
        "β′_1 = y_A′/(l_1·cos β_1) = …",
        "Y_A = F_P·sin β_1/cos β_1 − m_2A·a_Ay = …",
        "Given values",
        "r_1 = 0.048 m = 48 mm   engine.articulated.knuckle_radius, line …",
    ),
    ("v8-diesel", "main_journal_load.2 --at 100"): (
        "cos ψ_k,2 = cos 90° = 0",
        "Given values",
        "ψ_k,2 = 1.5708 rad = 90°   follows from engine.layout, line …",
    ),
    ("v8-diesel", "crank_torque --at 33 --set rod.ratio=0.3"): (
        "λ = 0.3   rod.ratio, set on the command line by --set",
    ),
    # the working cycle of books has letters that the motion has too
    ("v8-diesel", "total_torque --at 100 --lang vi"): ("M_hh = α_kk·M_0 = …",),
    ("v8-diesel", "gas_pressure --at 370 --lang vi"): ("p = đường cong nối……τ²…",),
    ("v8-diesel", "gas_pressure --at 370 --lang ru"): ("p = плавная кривая……τ²…",),
    ("press-geometry", "joint_force.D --at 60"): (
        "Joint force, D: R_D(60°) = …",
        "Given values",
        "l_rod = 0.6 m = 600 mm   links.rod.length, line …",
    ),
}  # fmt: skip


@looked_at(*([one for one in FOLLOWED if (one[0] in LATE) == late] for late in (False, True)))
def test_values_are_followed_to_what_is_given(cases):
    assert broken(lambda *asked: without(explained(*asked), FOLLOWED[asked]), cases) == {}


def line_of(text: str, key: str, after: str) -> int:
    lines = text.splitlines()
    begin = next(number for number, one in enumerate(lines) if after in one)
    return next(number for number, one in enumerate(lines, start=1) if number > begin and one.startswith(key))


LEAVES = {
    ("radial-five", "crank_torque --at 33"): ("S = 0.115 m = 115 mm   crank.stroke", "stroke", "[crank]"),
    ("v8-diesel", "crank_torque --at 33"): ("λ = 0.27   rod.ratio", "ratio", "[rod]"),
    ("spark-engine", "crank_torque --at 33"): ("r = 0.0529 m = 52.9 mm   crank.radius", "radius", "[crank]"),
    ("spark-engine", "piston_mass"): ("m′_p = 158.7 kg/m² = 15.87 g/cm²   piston.mass", "mass", "[piston]"),
    ("press", "rotational_speed"): ("n = 14.65 rad/s = 139.897 rpm   crank.speed", "speed", "[crank]"),
    ("press-geometry", "kinetic_energy --at 9"): ("m_punch = 102 kg   sliders.punch.mass", "punch", "[sliders]"),
}


def misplaced(name: str, arguments: str) -> list[str]:
    shown, key, table = LEAVES[name, arguments]
    return without(explained(name, arguments), (f"{shown}, line {line_of(source(name), key, table)}",))


def test_a_leaf_is_what_stands_on_its_line():
    assert broken(misplaced, LEAVES) == {}


def test_each_polytrope_has_the_exponent_of_its_piece():
    told = [line for at in ("200", "400") for line in explained("spark-engine", f"gas_pressure --at {at}")]
    stated = [number for number, one in enumerate(source("spark-engine").splitlines(), 1) if "exponent" in one]
    assert [int(one.rpartition(" ")[2]) for one in told if "].exponent" in one] == stated


def test_an_explanation_ends_with_what_its_symbols_mean():
    words = dict(legend("\n".join(explained("v8-diesel", "total_torque --at 100 --lang vi")), "vi"))
    assert (words["M"], words["α"]) == ("mômen quay trục khuỷu", "góc quay trục khuỷu")
    assert words["α_kk"] == "hệ số dư lượng không khí"
    assert words["λ_p"].startswith("tỉ số tăng áp suất")


def test_no_line_stands_twice_and_noise_is_zero():
    twice = {}
    for name, arguments in (
        ("spark-engine", "crank_torque --at 77"), ("spark-engine", "overturning_moment --at 77"),
        ("spark-engine", "rod_force --at 77"), ("radial-five", "crank_torque.2 --at 100"),
    ):  # fmt: skip
        lines = [one for one in explained(name, arguments) if one]
        twice[arguments] = {one for one in lines if lines.count(one) > 1}
    assert not any(twice.values()), twice
    assert sum(one.startswith("ΔF_N = ") for one in explained("radial-five", "crank_torque.2 --at 100")) == 1
    press = Path(crankwork.__file__).parent / "description" / "templates" / "toggle-press.toml"
    lines = explained(press, "joint_force.D --at 90")
    # numbers that are angles have their unit
    assert [one for one in lines if re.search(r"10⁻¹[0-9]|(sin|cos)\([−\d.]+\)", one)] == []
    assert any(one.startswith("cos θ_ram,g = cos(−90°) = 0 ") for one in lines)


def test_tables_and_integrals_of_a_press_are_followed(tmp_path):
    file = tmp_path / "press.toml"
    file.write_text(crankwork.template("toggle-press") + "\n[flywheel]\nfluctuation = 0.02\n", encoding="utf-8")
    assert without(explained(file, "kinetic_energy_change --at 50"), ("ΔT = −∫(M_st − M_st,m) dφ = …",)) == []
    lines = explained(file, "static_torque --at 250")
    # both rows that the value lies between
    assert sum("loads[1].force[" in one for one in lines) == 2
    assert without(lines, ("F_p,ram = table of given values = F_p,ram,i + (F_p,ram,j − F_p,ram,i)·τ = …",)) == []


def test_a_measured_pressure_names_its_samples(tmp_path):
    rows = [f"{angle},{1e5 + 5e6 * math.exp(-(((angle - 370) / 30) ** 2)):.1f}" for angle in range(0, 720, 2)]
    (tmp_path / "p.csv").write_text("\n".join(["deg,Pa", *rows]), encoding="utf-8")
    text = source("slider-crank")
    text += '[cylinder]\nbore = "80 mm"\ncompression_ratio = 9\n[gas]\ncycle = "720 deg"\npressures = "absolute"\n'
    text += '[gas.measured]\nfile = "p.csv"\npressure_unit = "Pa"\n'
    (tmp_path / "e.toml").write_text(text, encoding="utf-8")
    lines = explained(tmp_path / "e.toml", "diagram_pressure --at 371")
    assert any(one.startswith("p = measured, between two samples = p_(i)·(1 + 2·τ)·") for one in lines)
    assert "p_(i) = 5.1·10⁶ Pa = 5.1 MPa   p.csv, line 187" in lines
    assert "φ_j = 6.49262 rad = 372°   p.csv, line 188" in lines


@pytest.mark.filterwarnings("ignore::crankwork.errors.RenamedKeyWarning")
def test_what_is_found_of_a_column_is_followed_to_its_numbers():
    lines = explained("v8-diesel", "mean_torque")
    start = next(at for at, one in enumerate(lines) if one.startswith("M_Σ, N·m – 0°: 438.39; "))
    told = " ".join(lines[start : lines.index("Where")])
    found = [float(one.replace("−", "-")) for one in re.findall(r"°: ([−\d.]+)", told)]
    assert len(found) == 25
    # the rule of trapezes is exact to what its step leaves of the harmonics
    assert sum(found[:-1]) / 24 == pytest.approx(1096.7, rel=0.06)


def test_keys_are_listed_once_and_mistakes_refused():
    lines = explained("spark-engine", "--list")
    keys = [one.split()[0] for one in lines]
    assert "crank_torque" in keys
    assert len(keys) == len(set(keys))
    # what varies says so
    varies = {one.split()[0]: "(φ)" in one for one in lines}
    assert (varies["crank_torque"], varies["rotating_inertia_force"]) == (True, False)
    for arguments, sentence in (
        (["crank_torqe"], "did you mean crank_torque"),
        (["crank_torque"], "varies with the crank angle; say where, for example"),
        ([], "say which value"),
    ):
        with pytest.raises(CrankworkError, match=sentence):
            CliRunner().invoke(
                commands, ["explain", str(EXAMPLES / "spark-engine.toml"), *arguments], catch_exceptions=False
            )


def test_a_driver_that_turns_has_an_angle_in_radians():
    told = explained(Path(__file__).parents[1] / "machines" / "elbow.toml", "driver_angle --at 0.5")
    assert any(line.startswith("φ_q = φ_q,1 + h_φ,1·f") and "rad = " in line and " m " not in line for line in told)


def test_terms_of_a_sum_have_symbols_of_their_own():
    # a torque stated on a link, and the torque of its inertia
    told = explained(Path(__file__).parents[1] / "machines" / "driven-slider.toml", "driver_force --at 0.4")
    line = next(line for line in told if line.startswith("ΣM_arm = "))
    terms = line.split(" = ")[1].split(" + ")
    assert len(set(terms)) == len(terms) == 4, line


def test_a_force_in_a_joint_says_on_which_link_it_acts():
    keys = ("joint_force.O", "joint_force_x.B")
    told = [
        explained(Path(__file__).parents[1] / "machines" / "driven-slider.toml", f"{key} --at 0.4")[1] for key in keys
    ]
    assert told == ["on link arm, from the frame", "on link rod, from link piston"]


def test_the_least_of_a_column_is_called_so():
    words = [label("reduced_inertia.min", language) for language in ("en", "ru")]
    assert words == ["smallest reduced moment of inertia", "приведённый момент инерции: наименьшее значение"]


def test_a_pressure_of_a_point_stands_on_the_line_of_the_point(tmp_path):
    """Whatever the point is called: a pressure that does not change has none."""
    file = tmp_path / "level.toml"
    gear = 'crank.radius = "60 mm"\ncrank.speed = "720 rpm"\nrod.length = "240 mm"\ncylinder.bore = "150 mm"\n'
    points = 'gas.cycle = "360 deg"\ngas.points.o = { angle = "0 deg", pressure = "0.3 MPa" }\n'
    pieces = """gas.points."o'".angle = "360 deg"\ngas.pieces = [{ law = "constant", points = ["o", "o'"] }]\n"""
    for gas, place in (
        (points + pieces, "gas.points.o.pressure, line 6"),
        ('gas.pressure = "0.3 MPa"', "gas.pressure"),
    ):
        file.write_text(gear + gas, encoding="utf-8")
        assert any("300000 Pa = 0.3 MPa" in line and place in line for line in explained(file, "gas_force --at 30"))
