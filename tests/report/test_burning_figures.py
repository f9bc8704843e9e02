"""The figures and the note of a measured pressure and of a test of an engine, in every language."""

from __future__ import annotations

import numpy as np
import pytest

import crankwork
from crankwork.locale import LANGUAGES, translate
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of_sections
from crankwork.report.figures import diagrams, drawings
from crankwork.report.look import drawn_of

MACHINE = """
crank = { stroke = "90 mm", speed = "3000 rpm" }
rod.ratio = 0.27
cylinder = { bore = "85 mm", compression_ratio = 10.0 }
gas.cycle = "720 deg"
gas.pressures = "absolute"
gas.measured = { file = "p.csv", cycle = "mean", pressure_column = "2..4" }
gas.combustion = { from = "230 deg", to = "490 deg", windows = [["260 deg", "330 deg"]] }
test = { mechanical_loss_constant = "0.15 MPa", fuel_rate = "1 kg/h", fuel_heating_value = "44 MJ/kg" }
"""


@pytest.fixture(scope="module")
def measured(tmp_path_factory) -> crankwork.Results:
    folder = tmp_path_factory.mktemp("measured")
    degrees = np.arange(0.0, 720.0, 2.0)
    bar = 1 + 40 * np.exp(12 * (np.cos(np.radians(degrees - 372) / 2) - 1))
    rows = np.stack([degrees, bar, 0.98 * bar, 1.03 * bar], axis=1)
    np.savetxt(folder / "p.csv", rows, "%.6f", ";", header="angle [deg];a [bar];b [bar];c [bar]", comments="")
    return crankwork.analyse(crankwork.read_machine(MACHINE, folder=folder))


def test_figures_have_their_titles_in_every_language(measured) -> None:
    names = {"log_indicator": "figures", "combustion": "tables", "recorded_cycles": "figures"}
    for language in LANGUAGES:
        drawn = drawings(measured, language=language, only=set(names))
        assert set(drawn) == set(names)
        for name, room in names.items():
            assert translate(f"{room}.{name}", language).lower() in drawn[name].title.lower(), (name, language)


def test_the_note_has_a_section_of_each_in_every_language(measured) -> None:
    for language in LANGUAGES:
        note = note_of_sections(measured, NoteOptions(language=language))
        headings = [getattr(block, "text", "") for block in note.blocks]
        text = " ".join(map(str, headings)).lower()
        assert translate("headings.heat_release", language).lower() in text, language
        assert translate("headings.test", language).lower() in text, language


def test_a_test_alone_is_no_mechanism_that_is_drawn() -> None:
    text = 'crank.speed = "1000 rpm"\ntest = { brake_load = "100 N", brake_arm = "1 m" }'
    results = crankwork.analyse(crankwork.Description(text))
    assert not results.machine.moves
    assert drawings(results) == {}
    assert results["effective_torque"] == 100.0


def test_the_line_of_willans_meets_no_fuel_at_the_losses() -> None:
    """The root of the line through the points by least squares, of numpy's polyfit, is the power of the losses."""
    powers, rates = [10.0, 20.0, 30.0, 40.0], [4.0, 6.1, 8.0, 10.1]
    results = crankwork.analyse(
        crankwork.Description(f"""
        crank.speed = "1500 rpm"
        [test]
        effective_power = "40 kW"
        load_powers = {[f"{power} kW" for power in powers]}
        load_fuel_rates = {[f"{rate} kg/h" for rate in rates]}
    """)
    )
    columns = results.listings["willans"].columns
    np.testing.assert_allclose(columns["effective_power"], 1e3 * np.array(powers))
    np.testing.assert_allclose(columns["fuel_rate"], np.array(rates) / 3600)
    slope, idle = np.polyfit(powers, rates, 1)
    for language in LANGUAGES:
        drawn = drawn_of(results, language)
        graph = diagrams(drawn)["willans"].draw(drawn)[1]["willans"]
        below, over = (np.array(graph.curves[name]) for name in ("extended", "fuel_rate"))
        np.testing.assert_allclose(below, [[-idle / slope, 0], [0, idle]], atol=1e-9)
        np.testing.assert_allclose(over, [[0, 40], [idle, idle + 40 * slope]], rtol=1e-9)
        assert translate("figures.willans", language) == drawings(results, language=language)["willans"].title
