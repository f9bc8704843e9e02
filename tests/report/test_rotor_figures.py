"""The figures of masses in planes: polygons that close, forces over a turn, in every language."""

import numpy as np
import pytest

import crankwork
from crankwork.locale import LANGUAGES
from crankwork.report.figures import drawings
from each import for_each


@pytest.fixture(scope="module")
def results():
    return crankwork.analyse(crankwork.Description(crankwork.template("balancing")))


@for_each("language", LANGUAGES)
def test_polygons_have_the_moments_and_couples_of_the_table(results, language) -> None:
    drawing = drawings(results, language=language, only=["balance_polygons"])["balance_polygons"]
    curves = [plot.curves for plot in drawing.plots]
    columns = results.listings["planes"].columns
    turned = np.exp(1j * columns["plane_angle"])
    moments, couples = (columns[key] * turned for key in ("plane_moment", "plane_couple"))
    side, star, polygon, closed = ((np.array(x) + 1j * np.array(y)) for one in curves for x, y in one.values())
    # from the side the shaft has its planes in millimetres, and of the moments what goes up
    positions = [results.trace[f"plane_position.{name}"].value for name in results.listings["planes"].names]
    assert side == pytest.approx(1e3 * np.array(positions) + 1j * moments.imag, abs=1e-9)
    assert star == pytest.approx(moments, abs=1e-9)
    assert polygon == pytest.approx(np.cumsum(moments), abs=1e-9)
    # couples count from the plane of the first, which has none
    assert closed == pytest.approx(np.cumsum(couples)[1:], abs=1e-9)
    assert abs(polygon[-1]) + abs(closed[-1]) < 1e-9
    # a symbol and a unit each
    assert [len(plot.titles[axis].split(", ")) for plot in drawing.plots[2:] for axis in "xy"] == [2] * 4


def test_forces_over_a_turn_reach_their_extremes(results) -> None:
    drawing = drawings(results, only=["unbalanced"])["unbalanced"]
    curves = {name: np.array(y) for plot in drawing.plots for name, (_, y) in plot.curves.items()}
    along = curves["unbalanced_force_along"]
    assert 1e3 * np.max(along) == pytest.approx(results["tractive_effort_variation"], rel=1e-4)
    assert np.max(curves["unbalanced_couple"]) == pytest.approx(results["swaying_couple"], rel=1e-4)
