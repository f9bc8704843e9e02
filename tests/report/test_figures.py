"""Figures: which there are, that they are the same every time, and that no letter is missing in any language."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import read, read_machine
from crankwork.errors import CrankworkError
from crankwork.quantities import LANGUAGES
from crankwork.report.figure_data import drawn_from, figure_title
from crankwork.report.figures import figures
from crankwork.show.scene import printable

ROOT = Path(__file__).parents[2]
TEMPLATES = ROOT / "src" / "crankwork" / "description" / "templates"
FILES = [*sorted((ROOT / "examples").glob("*.toml")), *sorted(TEMPLATES.glob("*.toml"))]
ENGINES = [path for path in FILES if read(path).lengths]
LINKAGES = [path for path in FILES if path not in ENGINES]
FORCES = ["piston_forces", "rod_forces", "crankpin_forces", "torque", "crankpin_polar"]
MOTION = ["kinematics", "brix", "tolle"]
ALL = [*MOTION, "pressure", "indicator", *FORCES]
# of a whole engine, whatever its layout
WHOLE = {
    "crankpin_load", "big_end_polar", "small_end_polar", "main_journal_polar", "crankpin_wear", "main_wear",
    "total_torque", "excess_work", "torque_harmonics", "balance_orders",
}  # fmt: skip
SVG = "{http://www.w3.org/2000/svg}"


def _results(path: Path, method: str = "exact") -> Results:
    machine = read(path)
    return analyse(machine, method=machine.method.named(method))


@pytest.fixture(scope="module")
def engine() -> Results:
    return _results(TEMPLATES / "engine.toml")


@pytest.mark.parametrize("path", ENGINES, ids=lambda path: f"{path.parent.name}-{path.stem}")
@pytest.mark.parametrize("method", ["exact", "textbook"])
def test_every_machine_has_the_figures_of_what_is_known(path, method):
    results = _results(path, method)
    expected = ALL if results.solved.space else [*MOTION, *FORCES] if results.machine.masses else MOTION
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn = figures(results)
    if results.machine.engine is None:
        assert list(drawn) == expected
    else:
        assert {*expected, *WHOLE} <= set(drawn)
    for data in drawn.values():
        assert ET.fromstring(data).tag == f"{SVG}svg"  # noqa: S314 - our own bytes


@pytest.mark.parametrize("path", LINKAGES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_every_linkage_has_its_plans_and_the_curves_of_what_is_known(path):
    results = analyse(read(path))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn = figures(results, language=LANGUAGES[len(path.stem) % 3])
    expected = {"reduced_inertia", "torques"}
    if results.period:
        # by a law over time nothing is reduced to a crank
        expected = {"driver"}
    if results.machine.turning is not None:
        expected = {"turning_moment", "speed"}
    if results.machine.linkage is not None:
        expected |= {"position_plans", "velocity_plan", "acceleration_plan", "joint_forces"}
        expected |= {"sliders"} if any(key.startswith("slider_") for key in results.columns) else set()
        expected |= {"indicator", "chambers"} if results.machine.chambers else set()
        expected |= {"friction"} if results.machine.friction else set()
        expected |= {"wittenbauer", "speed"} if results.machine.drive.fluctuation else set()
        expected |= {"transient"} if results.machine.transient else set()
    assert set(drawn) == expected
    for data in drawn.values():
        assert ET.fromstring(data).tag == f"{SVG}svg"  # noqa: S314 - our own bytes


def test_a_wanted_flywheel_adds_the_energy_mass_diagram_and_the_speed():
    text = (TEMPLATES / "crank-shaper.toml").read_text(encoding="utf-8") + "\n[flywheel]\nfluctuation = 0.04\n"
    assert {"wittenbauer", "speed"} <= set(figures(analyse(read_machine(text)), language="ru"))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("method", ["textbook", "series:4"])
def test_no_letter_is_missing(language, method):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drawn = figures(_results(TEMPLATES / "engine.toml", method), language=language, per_area=True)
    assert list(drawn) == ALL


def test_figures_are_the_same_every_time(engine):
    assert figures(engine, language="vi") == figures(engine, language="vi")


def test_every_language_has_its_own_labels(engine):
    one, two, three = (figures(engine, language=language) for language in LANGUAGES)
    for name in ALL:
        assert len({one[name], two[name], three[name]}) == 3
        assert len({figure_title(name, language) for language in LANGUAGES}) == 3


def test_the_title_for_those_who_cannot_see_is_in_the_picture(engine):
    assert figure_title("torque", "ru").encode() in figures(engine, language="ru")["torque"]


def test_forces_per_area_change_forces_only(engine):
    plain, per_area = figures(engine), figures(engine, per_area=True)
    changed = [name for name in ALL if plain[name] != per_area[name]]
    assert changed == [name for name in FORCES if name != "torque"]


def test_forces_per_area_without_a_bore_are_refused():
    machine = read(TEMPLATES / "slider-crank.toml")
    with pytest.raises(CrankworkError, match=r"cylinder\.bore"):
        figures(analyse(replace(machine, cylinder=None)), per_area=True)


def test_the_curves_hold_the_numbers_of_the_table(engine):
    drawn = drawn_from(engine, "en", per_area=False)
    at = np.searchsorted(drawn.degrees, engine.grid.degrees)
    for key in ("gas_pressure", "piston_force", "crank_torque", "radial_force"):
        np.testing.assert_allclose(drawn.columns[key][at], engine.columns[key], rtol=1e-12, atol=1e-6)


def test_both_sides_of_a_jump_of_pressure_are_drawn():
    results = _results(ROOT / "examples" / "spark-engine.toml")
    drawn = drawn_from(results, "en", per_area=False)
    near = drawn.columns["gas_pressure"][np.abs(drawn.degrees - 360) < 1e-3]
    assert near.tolist() == pytest.approx([2.42322e6, 4.5083e6], rel=1e-4)


def test_point_names_that_cannot_be_printed_become_boxes():
    assert [printable(name, 16) for name in ("c1", "точка", "a\u202eb", "a" * 40)] == [
        "c1", "точка", "a□b", f"{'a' * 15}…"
    ]  # fmt: skip
