"""Figures: which there are, that they are the same every time, and that no letter is missing in any language."""

from __future__ import annotations

import html
import re
import warnings
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import read, read_machine, template
from crankwork.errors import CrankworkError
from crankwork.quantities import LANGUAGES
from crankwork.report.engine_figure_data import engine_drawn
from crankwork.report.figure_data import figure_title
from crankwork.report.figures import drawings, figures
from crankwork.report.tables import sheets
from crankwork.show.alt import described
from crankwork.show.scene import printable
from crankwork.show.svg import svg

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
# linkages of redundant links, or driven by a law over time
_WITHOUT_PLANS = ("parallelogram", "excavator-boom")
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
    if path.stem == "parallelogram":
        # nothing but its driver is heavy, and the torque is rounding
        expected = {"reduced_inertia"}
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
        expected |= {"force_plans"} if path.stem not in _WITHOUT_PLANS else set()
        expected |= {"zhukovsky_lever"} if path.stem not in _WITHOUT_PLANS else set()
        named = [key for key in results.columns if key.startswith("point_velocity.") and key.count(".") == 1]
        expected |= _by_fours("points", len(named))
        expected |= _by_fours("links", sum(key.startswith("link_angular_velocity.") for key in results.columns))
        # where a centre is far away for most of the turn there is nothing to see
        expected |= {"centrodes"} & set(drawn)
    assert set(drawn) == expected
    for data in drawn.values():
        assert ET.fromstring(data).tag == f"{SVG}svg"  # noqa: S314 - our own bytes


def _by_fours(name, count):
    """Return the names of figures that show four of so many each."""
    return {f"{name}_{at // 4 + 1}" if at else name for at in range(0, count, 4)}


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
    drawn = engine_drawn(engine, "en", per_area=False)
    at = np.searchsorted(drawn.degrees, engine.grid.degrees)
    for key in ("gas_pressure", "piston_force", "crank_torque", "radial_force"):
        np.testing.assert_allclose(drawn.columns[key][at], engine.columns[key], rtol=1e-12, atol=1e-6)


def test_both_sides_of_a_jump_of_pressure_are_drawn():
    results = _results(ROOT / "examples" / "spark-engine.toml")
    drawn = engine_drawn(results, "en", per_area=False)
    near = drawn.columns["gas_pressure"][np.abs(drawn.degrees - 360) < 1e-3]
    assert near.tolist() == pytest.approx([2.42322e6, 4.5083e6], rel=1e-4)


def test_point_names_that_cannot_be_printed_become_boxes():
    assert [printable(name, 16) for name in ("c1", "точка", "a\u202eb", "a" * 40)] == [
        "c1", "точка", "a□b", f"{'a' * 15}…"
    ]  # fmt: skip


@pytest.mark.parametrize("path", FILES[::4], ids=lambda path: path.stem)
def test_a_figure_says_in_words_what_it_shows(path):
    for language in LANGUAGES:
        for name, one in drawings(analyse(read(path)), language=language).items():
            words = described(one)
            assert words.startswith(one.title), name
            assert re.search(r"\d", words), name
            assert not re.search(r"[\^_${}]|nan", words), name
            assert f"<desc>{words}</desc>" in html.unescape(svg(one).decode())


def test_the_words_of_a_figure_have_its_extremes(engine):
    words = described(drawings(engine, language="ru")["pressure"])
    values = engine.columns["gas_pressure"] / 1e6
    # between the angles of the table the pressure may go further
    found = re.search(r"от (\S+) \(при (\S+)\) до (\S+) \(при (\S+)\)", words).groups()
    low, _, high, at = (float(one.replace(",", ".").replace("−", "-")) for one in found)
    assert low <= values.min() + 5e-4
    assert high >= values.max() - 5e-3
    assert abs(at - engine.grid.degrees[np.argmax(values)]) <= 10
    assert words.endswith("от 0 до 720")


@pytest.mark.parametrize("name", ["v8-diesel", "petrol-four", "two-stroke"])
def test_forces_of_many_newtons_are_shown_in_kilonewtons_alone(name):
    """Five figures of a number are two too many for an axis; tables keep their newtons."""
    results = analyse(read(ROOT / "examples" / f"{name}.toml"))
    shown = figures(results, language="en")["piston_forces"].decode()
    assert "kN" in shown
    assert "0000<" not in shown
    assert sheets(results)["forces"].units["piston_force"] == "N"


def test_small_forces_are_shown_in_newtons():
    small = figures(analyse(read_machine(template("slider-crank"))), language="en")["piston_forces"].decode()
    assert "kN" not in small
