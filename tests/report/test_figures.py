"""Figures: which there are, that no letter is missing in any language, and what they say in words."""

from __future__ import annotations

import html
import re
from dataclasses import replace
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from crankwork.analysis import analyse
from crankwork.analysis.constructions import force_laws
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import CrankworkError
from crankwork.quantities import LANGUAGES
from crankwork.report.figures import drawings, figure_names, figures
from crankwork.report.look import drawn_of, figure_title
from crankwork.report.tables import sheets
from crankwork.show.scene import printable
from crankwork.show.svg import svg
from crankwork.show.theme import alt_text
from each import for_each
from shown import FEW, REST, figures_of, in_parts, machine_of, results_of

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


@in_parts("name", FEW, REST)
def test_every_machine_has_the_figures_of_what_is_known(name):
    results, drawn = results_of(name), figures_of(name)
    if not results.machine.lengths:
        assert set(drawn) == _of_a_linkage(name, results, drawn)
        return
    expected = ALL if results.solved.space else [*MOTION, *FORCES] if results.machine.masses else MOTION
    for names in (list(drawn), figure_names(results_of(name, "textbook"))):
        if results.machine.engine is None:
            assert names == expected
        else:
            assert {*expected, *WHOLE} <= set(names)


def _of_a_linkage(name, results, drawn):
    expected = {"reduced_inertia", "torques"}
    if name == "parallelogram":
        # nothing but its driver is heavy, and the torque is rounding
        expected = {"reduced_inertia"}
    if results.period:
        # by a law over time nothing is reduced to a crank
        expected = {"driver"}
    if results.machine.turning is not None:
        expected = {"turning_moment", "speed"}
    if results.machine.rotor is not None:
        expected = {"balance_polygons", "unbalanced"}
    elif results.machine.linkage is None and results.machine.clutch is not None:
        expected = set()
    elif results.machine.linkage is None and "stages" in results.listings:
        # stages alone, of which no machine is drawn
        expected = {"stage_indicator"}
    if results.machine.linkage is not None:
        # of a linkage that nothing loads, only how it moves
        has_forces = any(key.startswith("joint_force.") for key in results.columns)
        expected = expected if has_forces else expected & {"driver"}
        expected |= {"position_plans", "velocity_plan", "acceleration_plan"}
        expected |= {"joint_forces"} if has_forces else set()
        expected |= {"sliders"} if any(key.startswith("slider_") for key in results.columns) else set()
        expected |= {"indicator", "chambers"} if results.machine.chambers else set()
        expected |= {"friction"} if results.machine.friction else set()
        expected |= {"process_force"} if force_laws(results) else set()
        expected |= {"wittenbauer", "speed"} if results.machine.drive.fluctuation else set()
        expected |= {"transient"} if results.machine.transient else set()
        expected |= {"force_plans", "zhukovsky_lever"} if has_forces and name not in _WITHOUT_PLANS else set()
        for figure, owners in (("rod_loads", results.machine.crossheads), ("pump_flow", results.machine.vessels)):
            expected |= {f"{figure}_{at}" if at > 1 else figure for at in range(1, len(owners) + 1)}
        named = [key for key in results.columns if key.startswith("point_velocity.") and key.count(".") == 1]
        expected |= _by_fours("points", len(named))
        expected |= _by_fours("links", sum(key.startswith("link_angular_velocity.") for key in results.columns))
        crankpins = [key for key in results.columns if key.startswith("crankpin_load.")]
        polars = {
            f"crankpin_polar_{number}" if number > 1 else "crankpin_polar" for number in range(1, len(crankpins) + 1)
        }
        expected |= polars | {"crankpin_load", "crankpin_wear"} if crankpins else set()
        expected |= {"main_journal_polar", "main_wear"} if "main_journals" in results.tables else set()
        # of a parallelogram the torque is rounding
        expected |= {"torque_harmonics"} if crankpins and name != "parallelogram" else set()
        # where a centre is far away for most of the turn there is nothing to see
        expected |= {"centrodes"} & set(drawn)
        # nor of paths that are lines, or circles about a pivot
        expected |= {one for one in drawn if one.startswith("paths")}
    return expected


def _by_fours(name, count):
    """Return the names of figures that show four of so many each."""
    return {f"{name}_{at // 4 + 1}" if at else name for at in range(0, count, 4)}


def test_a_wanted_flywheel_adds_the_energy_mass_diagram_and_the_speed():
    text = f"{template('crank-shaper')}\n[flywheel]\nfluctuation = 0.04\n"
    assert {"wittenbauer", "speed"} <= set(figure_names(analyse(read_machine(text))))


@for_each(("method", "language"), [("textbook", "en"), ("series:4", "ru"), ("textbook", "vi")])
def test_no_letter_is_missing_by_any_method(method, language):
    drawn = figures(results_of("template engine", method), language=language, per_area=True)
    assert list(drawn) == ALL
    assert [name for name, one in drawn.items() if "□" in one.decode()] == []


def test_every_language_has_its_own_labels_and_titles():
    found = {name: [figures_of(name, language) for language in LANGUAGES] for name in ("spark-engine", "atkinson")}
    for three in found.values():
        for name in three[0]:
            assert len({svg(one[name]) for one in three}) == 3, name
            assert len({figure_title(name, language) for language in LANGUAGES}) == 3, name


def test_forces_per_area_change_forces_only_and_need_a_bore():
    plain, per_area = figures_of("petrol-four"), figures_of("petrol-four", per_area=True)
    changed = {name for name in plain if svg(plain[name]) != svg(per_area[name])}
    loads = {"crankpin_load", "crankpin_wear", "main_wear"} | {name for name in plain if "polar" in name}
    assert changed == {*FORCES, *loads, "total_tangential_force"} - {"torque"}
    with pytest.raises(CrankworkError, match=r"cylinder\.bore"):
        figures(analyse(replace(machine_of("template slider-crank"), cylinder=None)), per_area=True)


def test_both_sides_of_a_jump_of_pressure_are_drawn():
    drawn = drawn_of(results_of("spark-engine", "exact"), "en")
    near = drawn.columns["gas_pressure"][np.abs(drawn.degrees - 360) < 1e-3]
    assert near.tolist() == pytest.approx([2.42322e6, 4.5083e6], rel=1e-4)


def test_point_names_that_cannot_be_printed_become_boxes():
    assert [printable(name, 16) for name in ("c1", "точка", "a\u202eb", "a" * 40)] == [
        "c1", "точка", "a□b", f"{'a' * 15}…"
    ]  # fmt: skip


@in_parts("name", FEW, REST)
def test_a_figure_is_svg_and_says_in_words_what_it_shows(name):
    for figure, one in figures_of(name).items():
        words, text = alt_text(one), svg(one).decode()
        assert words.startswith(one.title), figure
        # the law of a force is told by its axes
        assert re.search(r"\d", words) or figure == "process_force", figure
        # a line between two words is a name of the user's own
        assert not re.search(r"[\^${}□]|(?<!\w{3})_|_(?!\w{3})|\bnan\b", words), figure
        assert f"<desc>{words}</desc>" in html.unescape(text)
        root = ET.fromstring(text)  # noqa: S314 - our own bytes
        assert (root.tag, root.findtext(f"{SVG}title")) == (f"{SVG}svg", one.title), figure


def test_the_words_of_a_figure_have_its_extremes():
    engine = results_of("template engine")
    words = alt_text(drawings(engine, language="ru", only=["pressure"])["pressure"])
    values = engine.columns_at(engine.grid, ["diagram_pressure"])["diagram_pressure"] / 1e6
    # between the angles of the table the pressure may go further
    found = re.search(r"от (\S+) \(при (\S+)\) до (\S+) \(при (\S+)\)", words).groups()
    low, _, high, at = (float(one.replace(",", ".").replace("−", "-")) for one in found)
    assert low <= values.min() + 5e-4
    assert high >= values.max() - 5e-3
    assert abs(at - engine.grid.degrees[np.argmax(values)]) <= 10
    assert words.endswith("от 0 до 720")


def test_forces_of_many_newtons_are_shown_in_kilonewtons_alone_and_small_ones_in_newtons():
    """Five figures of a number are two too many for an axis; tables keep their newtons."""
    shown = svg(figures_of("petrol-four")["piston_forces"]).decode()
    assert "kN" in shown
    assert "0000<" not in shown
    assert sheets(results_of("petrol-four"))["forces"].units["piston_force"] == "N"
    assert "kN" not in svg(figures_of("template slider-crank", "en")["piston_forces"]).decode()
