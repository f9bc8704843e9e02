"""Every value of every machine is explained down to what is given."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

import crankwork
from crankwork.cli import commands
from crankwork.errors import CrankworkError
from crankwork.locale import texts

FILES = [*sorted(Path("examples").glob("*.toml")), *crankwork.template_names()]
CASES = [(file, way) for file in FILES for way in ("exact", "textbook")]
ENGINE = "examples/spark-engine.toml"


@pytest.mark.parametrize(("file", "way"), CASES)
def test_every_kind_of_value_is_explained(file, way, results_of):
    results = results_of(file, way)
    at = float(results.grid.degrees[len(results.grid) // 3])
    at = at * results.period / 360 if results.period else at
    unknown, wrong, seen = [], [], set()
    for key in (*results.columns, *results.summary):
        if key not in results.memory:
            unknown.append(key)
        kind = re.sub(r"_(max|min)(_angle)?(?=\.|$)", "_max", key).partition(".")[0]
        if kind in seen:
            continue
        seen.add(kind)
        language = ("en", "ru", "vi")[len(seen) % 3]
        told = results.explain(key, at, language)
        wrong += [line for line in told.splitlines() if re.search(r"\?|nan|inf\b|_\.| = $", line)]
        wrong += [*two_meanings(told, language), *english_words(told, file, language)]
    assert wrong == []
    assert unknown == []


def legend(told: str, language: str = "en") -> list[tuple[str, str]]:
    """Return the symbols of the legend of an explanation, each with its words."""
    heading = {"en": "\nWhere\n", "ru": "\nГде\n", "vi": "\nTrong đó\n"}[language]
    listed = told.partition(heading)[2].partition("\n\n")[0].replace("\u00a0", " ")
    entries = " ".join(listed.split()).split("; ")
    return [tuple(one.split(" – ", 1)) for one in entries if " – " in one]


def english_words(told: str, file: Path | str, language: str) -> set[str]:
    """Return the words in subscripts that neither the file nor the symbols of the language have."""
    text = file.read_text("utf-8") if isinstance(file, Path) else crankwork.template(file)
    known = set(re.findall(r"\w+", " ".join([text, *texts("symbols", language).values()]).replace("_", " ")))
    # what a crank is called that has no name of its own
    known |= set(re.findall(r"\w+", texts("report", language)["crank"]))
    known |= set(texts("marks", language).values()) | {"max", "min", "sin", "cos", "tan", "exp", "abs"}
    # phase of a harmonic, with the letter that the crank angle has
    known |= {"kφ₀", "kα₀"}
    lines = [one for one in told.splitlines() if one.startswith("  ") and " = " in one]
    shown = {one for line in lines for one in re.findall(r"[^\W\d_]{3,}", line.split(" = ")[0])}
    return set() if language == "en" else shown - known


def two_meanings(told: str, language: str) -> list[str]:
    """Return the letters that stand for two quantities in one explanation."""
    found: dict[str, str] = {}
    return [f"{shown}: {words}" for shown, words in legend(told, language) if found.setdefault(shown, words) != words]


def test_an_explanation_ends_with_what_its_symbols_mean():
    told = "\n".join(explained("examples/v8-diesel.toml", "total_torque", "--at", "100", "--lang", "vi"))
    words = dict(legend(told, "vi"))
    assert words["M"] == "mômen quay trục khuỷu"
    assert words["α"] == "góc quay trục khuỷu"
    # the working cycle of books has letters that the motion has too
    assert words["α_n"] == "hệ số dư lượng không khí"
    assert words["λ_p"].startswith("tỉ số tăng áp suất")
    assert "  M_hh = α_n·M_0 = " in told


def explained(*arguments: str) -> list[str]:
    result = CliRunner().invoke(commands, ["explain", *arguments], catch_exceptions=False)
    assert result.exit_code == 0
    return result.output.replace("\u00a0", " ").splitlines()


def test_a_torque_is_followed_from_the_file():
    lines = explained(ENGINE, "crank_torque", "--at", "390", "--method", "textbook")
    assert lines[0] == "Crank torque: M(390°) = 712.026 N·m"
    assert "  sin φ = sin 390° = 0.5" in lines
    assert "  M = F_T·r = 13459.84·0.0529 = 712.026 N·m   [1, ch. 7]" in lines
    assert any(line.endswith("(law from 375° to 505°)") for line in lines)
    number = next(n for n, one in enumerate(Path(ENGINE).read_text("utf-8").splitlines(), 1) if "radius" in one)
    assert f"  r = 0.0529 m = 52.9 mm   crank.radius, line {number}" in lines
    # operands before what is made of them
    assert lines.index("  sin β = λ·sin φ = 0.25·0.5 = 0.125   [1, ch. 6]") > lines.index("  sin φ = sin 390° = 0.5")


def test_no_line_stands_twice():
    for key in ("crank_torque", "overturning_moment", "rod_force"):
        lines = [one for one in explained(ENGINE, key, "--at", "77") if one]
        assert len(lines) == len(set(lines))


def test_an_extreme_is_followed_where_it_stands():
    lines = explained(ENGINE, "crank_torque_max", "--set", "crank.radius=60 mm", "--method", "textbook")
    assert lines[0] == "Largest crank torque: M_max = 737.594 N·m"
    assert "At the crank angle 383.9096275°" in lines
    assert "  M_max = largest value (M), at 383.9096275° = 737.594 N·m" in lines
    assert "  r = 0.06 m = 60 mm   crank.radius, set on the command line by --set" in lines


def test_what_is_made_of_an_extreme_stands_after_it():
    for file, key, made_of in (
        ("petrol-four", "bearing_load_ratio.crankpin.1", "R_c,max,1"),
        ("two-stroke", "cylinder_temperature_max", "p"),
    ):
        lines = explained(f"examples/{file}.toml", key)
        (line,) = (
            at for at, one in enumerate(lines) if one.startswith(f"  {lines[0].split(': ')[1].split(' = ')[0]} = ")
        )
        before = max(
            at for at, one in enumerate(lines[: lines.index("Given values")]) if one.startswith(f"  {made_of} = ")
        )
        assert before < line


def test_an_integral_says_what_is_integrated(tmp_path):
    file = tmp_path / "press.toml"
    file.write_text(crankwork.template("toggle-press") + "\n[flywheel]\nfluctuation = 0.02\n", encoding="utf-8")
    for path, integral in (("examples/petrol-four.toml", "∫(M_Σ − M_Σm) dφ"), (str(file), "−∫(M_st − M_st,m) dφ")):
        lines = explained(path, "kinetic_energy_change", "--at", "50")
        assert any(one.startswith(f"  ΔT = {integral} = ") for one in lines)


def test_another_cylinder_is_the_first_one_later():
    lines = explained("examples/petrol-four.toml", "total_torque", "--at", "30", "--method", "textbook")
    assert any(line.startswith("  F_T,4(30°) = F_T(390°) = ") for line in lines)
    assert any(line.startswith("  M_4 = F_T,4·r = ") for line in lines)
    assert any(line.startswith("  M_Σ = M_1 + M_2 + M_3 + M_4 = ") for line in lines)


def test_an_articulated_rod_is_told_from_the_master_rod():
    lines = explained("examples/radial-five.toml", "crank_torque.2", "--at", "100")
    assert "  sin φ_m = sin (φ + 72°) = sin 460° = 0.984808" in lines
    assert any(one.startswith("  sin β_m = λ_m·sin φ_m = 0.25·0.984808 = ") for one in lines)
    assert any(one.startswith("  cos β_1 = √(1 − (sin β_1)²) = ") for one in lines)
    assert any(one.startswith("  β′_1 = y_A′/(l_1·cos β_1) = ") for one in lines)
    assert any(one.startswith("  Y_A = F_P·sin β_1/cos β_1 − m_2A·a_Ay = ") for one in lines)
    assert "  sin γ = sin 72° = 0.951057" in lines
    assert sum(one.startswith("  ΔF_N = ") for one in lines) == 1
    given = lines[lines.index("Given values") :]
    assert any(one.startswith("  r_1 = 0.048 m = 48 mm   engine.articulated.knuckle_radius, line ") for one in given)


def test_numbers_that_are_angles_have_their_unit_and_noise_is_zero():
    lines = explained("src/crankwork/description/templates/toggle-press.toml", "joint_force.D", "--at", "90")
    assert not [one for one in lines if re.search("10⁻¹[0-9]", one)]
    assert not [one for one in lines if re.search(r"(sin|cos)\([−\d.]+\)", one)]
    assert any(one.startswith("  cos θ_ram,g = cos(−90°) = 0 ") for one in lines)


def test_orders_of_a_series_are_told_apart():
    lines = explained(ENGINE, "piston_acceleration", "--at", "77", "--method", "series:3")
    assert any(one.startswith("  x″ = x″_k1 + x″_k2 = ") for one in lines)
    assert any(one.startswith("  x″_k2 = a_k,2·cos 2φ = ") for one in lines)


def test_each_crankpin_has_an_angle_of_its_own():
    lines = explained("examples/v8-diesel.toml", "main_journal_load.2", "--at", "100")
    assert "  cos ψ_k,2 = cos 90° = 0" in lines
    assert any(one.startswith("  ψ_k,2 = 1.5708 rad = 90°   follows from engine.layout, line ") for one in lines)


def test_a_mean_says_what_it_is_of():
    assert any("mean over the cycle (M: crank torque) = " in line for line in explained(ENGINE, "mean_torque"))


def test_what_is_found_of_a_column_is_followed_to_its_numbers():
    lines = explained("examples/v8-diesel.toml", "mean_total_torque")
    start = next(at for at, one in enumerate(lines) if one.startswith("    M_Σ, N·m – 0°: 438.39; "))
    told = " ".join(lines[start : lines.index("Where")])
    found = [float(one.replace("−", "-")) for one in re.findall(r"°: ([−\d.]+)", told)]
    assert len(found) == 25
    # the rule of trapezes is exact to what its step leaves of the harmonics
    assert sum(found[:-1]) / 24 == pytest.approx(1096.7, rel=0.06)


def test_a_default_is_told_from_what_the_file_states():
    settings = ("--set", "method.weights=true")
    lines = explained(ENGINE, "weight_force", *settings)
    assert any(line.endswith("method.gravity: default, not in the file") for line in lines)


def test_a_joint_force_is_followed_to_the_lengths():
    lines = explained("examples/press-geometry.toml", "joint_force.D", "--at", "60")
    assert lines[0].startswith("Joint force, D: R_D(60°) = ")
    given = lines[lines.index("Given values") :]
    assert any(one.startswith("  l_rod = 0.6 m = 600 mm   links.rod.length, line ") for one in given)


def test_keys_are_listed_and_mistakes_refused():
    assert any(one.startswith("crank_torque ") for one in explained(ENGINE, "--list"))
    for arguments, sentence in (
        (["crank_torqe"], "did you mean crank_torque"),
        (["crank_torque"], "varies with the crank angle; say where, for example"),
        ([], "say which value"),
    ):
        with pytest.raises(CrankworkError, match=sentence):
            CliRunner().invoke(commands, ["explain", ENGINE, *arguments], catch_exceptions=False)
