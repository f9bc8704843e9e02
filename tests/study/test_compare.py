"""Results beside others: every value is that of its own analysis, and differences are differences."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork import CrankworkError, NoteOptions
from crankwork.analysis.compare import comparison_key, difference_key
from crankwork.note.document import Figure, Heading, Table
from crankwork.report.figures import drawings
from crankwork.report.tables import comparison_rows, comparison_text, sheets
from each import for_each
from notes import texts

MACHINES = Path(__file__).parents[1] / "machines"
EXAMPLES = Path(__file__).parents[2] / "examples"


def machine(name, *overrides):
    return crankwork.read_machine(crankwork.template(name), overrides=overrides)


def by_methods(name, *methods):
    one = machine(name)
    others = {method: crankwork.analyse(crankwork.with_method(one, method)) for method in methods}
    return crankwork.compare(crankwork.analyse(one), others)


def of(path):
    return crankwork.analyse(crankwork.read(path))


@pytest.mark.parametrize("name", ["slider-crank", "whole-engine"])
def test_columns_are_those_of_each_method_and_of_their_differences(name):
    results = by_methods(name, "textbook", "series:4")
    compared = results.compared
    assert compared.names == ("exact", "textbook", "series:4")
    assert {"piston_displacement", "piston_velocity", "piston_acceleration"} <= set(compared.keys)
    for key in compared.keys:
        own = compared.columns[comparison_key(key, "exact")]
        assert np.array_equal(own, results.columns[key])
        for method, other in zip(compared.names[1:], compared.others, strict=True):
            size = np.max(np.abs(own))
            its = compared.columns[comparison_key(key, method)]
            assert its == pytest.approx(other.columns[key], abs=1e-12 * size)
            assert compared.columns[difference_key(key, method)] == pytest.approx(its - own, abs=1e-12 * size)
    # in the figure each curve is that of its name, and below it are the differences
    plots, wrong = iter(drawings(results)["comparison"].plots), []
    for key in ("piston_displacement", "piston_velocity", "piston_acceleration"):
        for of_name, names in ((comparison_key, compared.names), (difference_key, compared.names[1:])):
            curves = next(plots).curves
            assert tuple(curves) == names
            for which, (angles, drawn) in curves.items():
                column = compared.columns_at(angles)[of_name(key, which)]
                if drawn / np.max(np.abs(drawn)) != pytest.approx(column / np.max(np.abs(column)), abs=1e-9):
                    wrong.append((key, which))
    assert wrong == []


@for_each(
    ("others", "told"),
    [(["textbook"], "Δ: textbook, two terms less exact"), (["textbook", "series:4"], "Δ: each less exact")],
)
def test_a_legend_says_what_is_taken_from_what(others, told):
    drawing = drawings(by_methods("slider-crank", *others))["comparison"]
    assert told in [one.text for one in texts(drawing)]


@pytest.mark.elsewhere
def test_the_textbook_differs_from_exact_by_what_its_two_terms_leave_out():
    compared = by_methods("slider-crank", "textbook").compared
    r, ratio = 0.045, 0.045 / 0.16
    own = crankwork.analyse(machine("slider-crank"))
    r, ratio = own["crank_radius"], own["rod_ratio"]
    phi = np.radians([0.0, 50.0, 90.0, 222.0])
    exact = 1 / ratio - np.sqrt(1 / ratio**2 - np.sin(phi) ** 2)
    found = compared.columns_at(np.degrees(phi))[difference_key("piston_displacement", "textbook")]
    assert found == pytest.approx(r * (ratio / 4 * (1 - np.cos(2 * phi)) - exact), abs=1e-15)


def test_the_largest_difference_is_the_error_that_the_method_states():
    results = by_methods("engine", "textbook")
    compared = results.compared
    for key in ("piston_displacement", "piston_velocity", "piston_acceleration"):
        found = np.max(np.abs(compared.columns_at(np.arange(0, 720, 0.1))[difference_key(key, "textbook")]))
        assert found == pytest.approx(compared.others[0].summary[f"{key}_error"], rel=1e-5)


def test_single_values_that_do_not_differ_are_left_out_of_methods():
    results = by_methods("engine", "textbook")
    rows = comparison_rows(results)
    assert "crank_radius" not in rows
    own, other, apart = rows["crank_torque_max"]
    assert own == pytest.approx(results.summary["crank_torque_max"])
    assert other - own == apart
    # only the approximate method has an error to state
    own, other, apart = rows["crank_torque_error"]
    assert [math.isnan(one) for one in (own, other, apart)] == [True, False, True]


def test_two_machines_stand_side_by_side_with_all_their_values():
    one, other = (crankwork.analyse(machine("engine", *overrides)) for overrides in ((), ("rod.length=140 mm",)))
    results = crankwork.compare(one, {"short": other}, "long")
    rows = comparison_rows(results)
    assert set(rows) == set(one.summary) | set(other.summary)
    assert rows["rod_length"] == pytest.approx((160.0, 140.0, -20.0))
    for key in results.compared.keys:
        assert results.compared.columns[comparison_key(key, "short")] == pytest.approx(
            other.columns[key], rel=1e-12, abs=1e-9
        )


def test_linkages_are_compared_by_what_they_have_in_common():
    one, other = (crankwork.analyse(machine("four-bar", *overrides)) for overrides in ((), ("crank.radius=60 mm",)))
    compared = crankwork.compare(one, {"other": other}, "own").compared
    assert {"link_angle.rocker", "driving_torque"} <= set(compared.keys)
    assert compared.columns["link_angle.rocker.other"] == pytest.approx(other.columns["link_angle.rocker"])
    assert compared.columns["link_angle_difference.rocker.other"] == pytest.approx(
        other.columns["link_angle.rocker"] - one.columns["link_angle.rocker"]
    )


def test_where_another_linkage_does_not_get_there_is_nothing():
    whole, partial = (crankwork.analyse(machine("four-bar", *some)) for some in ((), ("links.coupler.length=260 mm",)))
    results = crankwork.compare(whole, {"partial": partial}, "whole")
    column = results.compared.columns["link_angle.rocker.partial"]
    assert np.isnan(column).any()
    assert np.isfinite(column).any()
    assert b"nan" not in crankwork.figures(results)["comparison"]
    # the other way round there are only the angles that it reaches
    turned = crankwork.compare(partial, {"whole": whole}, "partial").compared
    assert np.isfinite(turned.columns["link_angle.rocker.whole"]).all()


def test_of_cycles_of_one_turn_and_of_two_only_the_motion_is_compared():
    compared = crankwork.compare(
        crankwork.analyse(machine("engine")), {"compressor": crankwork.analyse(machine("compressor"))}, "engine"
    ).compared
    assert compared.keys == ("piston_displacement", "piston_velocity", "piston_acceleration")


def test_what_goes_by_a_law_has_only_single_values_in_common_with_another_period():
    one = of(MACHINES / "elbow.toml")
    other = crankwork.analyse(crankwork.read(MACHINES / "elbow.toml", ["driver.law[1].over=1 s"]))
    results = crankwork.compare(one, {"quick": other}, "slow")
    assert results.compared.keys == ()
    assert "comparison" not in crankwork.figures(results)
    assert comparison_rows(results)["period"] == pytest.approx((2.7, 2.5, -0.2))
    same = crankwork.compare(one, {"again": one}, "slow")
    assert same.compared.keys
    assert b"time" in crankwork.figures(same)["comparison"]


def test_machines_without_anything_in_common_are_refused():
    one, other = of(EXAMPLES / "excavator-boom.toml"), crankwork.analyse(machine("engine"))
    with pytest.raises(CrankworkError, match=r"^--compare: the two machines have no results in common"):
        crankwork.compare(one, {"other": other})


@pytest.mark.slow
def test_notes_have_a_section_with_table_and_figure():
    four_bars = [crankwork.analyse(machine("four-bar", *some)) for some in ((), ("crank.radius=60 mm",))]
    compared = by_methods("engine", "textbook", "series:3"), crankwork.compare(four_bars[0], {"b": four_bars[1]}, "a")
    for language, results in (("en", compared[0]), ("ru", compared[1]), ("vi", compared[0])):
        note = crankwork.note_of(results, NoteOptions(full=True, language=language))
        titles = {"en": "Comparison", "ru": "Сравнение", "vi": "So sánh"}
        assert titles[language] in [one.text for one in note.blocks if isinstance(one, Heading)]
        (table,) = (one for one in note.blocks if isinstance(one, Table) and one.label == "t:compared")
        assert len(table.headings) == 1 + 2 * len(results.compared.names)
        figures = [one for one in note.blocks if isinstance(one, Figure) and "comparison" in one.label]
        assert len(figures) == 1
        assert crankwork.written_note(note, "note.html")


def test_without_a_comparison_nothing_is_shown():
    results = crankwork.analyse(machine("engine"))
    assert comparison_text(results) == ""
    assert "comparison" not in crankwork.figures(results)
    assert "Comparison" not in [one.text for one in crankwork.note_of(results).blocks if isinstance(one, Heading)]


def test_everything_is_shown_in_the_system_of_the_own_machine():
    one, other = (crankwork.analyse(machine("engine", *some)) for some in (("units=imperial",), ("rod.length=140 mm",)))
    results = crankwork.compare(one, {"short": other}, "long")
    assert comparison_rows(results)["rod_length"] == pytest.approx((160 / 25.4, 140 / 25.4, -20 / 25.4))
    assert "lbf·ft" in comparison_text(results)
    sheet = sheets(results)["comparison"]
    assert sheet.units["crank_torque_difference.short"] == "lbf*ft"


def test_shafts_with_torques_are_compared():
    text = (
        '[crank]\nspeed = "100 rpm"\n[torque]\nperiod = "360 deg"\nat = ["0 deg", "80 deg", "360 deg"]\n'
        'torque = ["0 N*m", "2000 N*m", "0 N*m"]\n'
    )
    one, other = (crankwork.analyse(crankwork.read_machine(some)) for some in (text, text.replace("2000", "1800")))
    results = crankwork.compare(one, {"other": other}, "own")
    assert {"turning_moment", "excess_torque"} <= set(results.compared.keys)
    assert comparison_rows(results)["turning_moment_max"] == pytest.approx((2000.0, 1800.0, -200.0))
    assert "comparison" in crankwork.figures(results)
    headings = [one.text for one in crankwork.note_of(results).blocks if isinstance(one, Heading)]
    assert "Comparison" in headings
