"""Torques on a shaft against brute sums, closed forms and values worked by hand; and everything that shows them."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.analysis import Results, analyse
from crankwork.analysis.given_torques import turning_diagram
from crankwork.description.machine_file import read, read_machine
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import LANGUAGES
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.web import web
from crankwork.report.figures import drawings, figures
from crankwork.report.tables import sheets
from crankwork.show.scene import Hatch, Polyline

ROOT = Path(__file__).parents[2]
FILES = [*sorted((ROOT / "tests" / "machines").glob("turning-*.toml")), ROOT / "examples" / "punching-machine.toml"]


def analysed(text: str) -> Results:
    return analyse(read_machine(text))


@pytest.mark.elsewhere
class TestByHand:
    """A rim of 1 m, 100 mm by 50 mm, 7200 kg/m3, on a shaft of 20 rad/s."""

    FILE = """
        crank.speed = "20 rad/s"
        torque = { period = "360 deg", constant = "50 N*m", harmonics = [{ order = 1, sin = "100 N*m" }] }
        flywheel.rim = { diameter = "1 m", width = "100 mm", thickness = "50 mm", density = "7200 kg/m3" }
        """

    @property
    def results(self) -> Results:
        return analysed(self.FILE)

    def test_the_rim(self) -> None:
        assert self.results["rim_mass"] == pytest.approx(36 * math.pi)
        assert self.results["rim_speed"] == pytest.approx(10.0)
        assert self.results["rim_stress"] == pytest.approx(720e3)

    def test_a_rim_of_twice_the_diameter(self) -> None:
        """72 pi kg at a radius of 1 m."""
        found = analysed(self.FILE.replace('"1 m"', '"2 m"'))
        assert found["speed_fluctuation"] == pytest.approx(200 / (72 * math.pi * 400))
        assert found["rim_speed"] == pytest.approx(20.0)

    def test_the_speed(self) -> None:
        """An energy of 100 (1 - cos) and an inertia of 9 pi."""
        assert self.results["excess_work"] == pytest.approx(200.0)
        assert self.results["speed_fluctuation"] == pytest.approx(200 / (9 * math.pi * 400))
        assert self.results["angular_acceleration_max"] == pytest.approx(100 / (9 * math.pi))

    def test_a_triangle_and_its_blow(self) -> None:
        """Two thirds of 90 J rise to 60 N m at a third of the stretch of 2 rad; 30 J are lost at once."""
        found = analysed("""
            crank.speed = "20 rad/s"
            [torque]
            period = "6 rad"
            [[torque.strokes]]
            work = "60 J"
            over = "2 rad"
            shape = "triangle"
            peak = 0.25
            [[torque.strokes]]
            work = "-30 J"
            from = "3 rad"
            """)
        assert found["mean_torque"] == pytest.approx(5.0)
        assert found["turning_moment_max"] == pytest.approx(60.0)
        assert found["turning_moment_max_angle"] == pytest.approx(0.5)
        # from 1/24 rad to 2 - 1/8 rad the triangle is above the mean
        assert found["excess_work"] == pytest.approx(60 - 60 / 12 * 2 / 12 / 2 - 5 * (2 - 1 / 6) + 0.0, rel=0.02)


@st.composite
def broken_lines(draw: st.DrawFn) -> tuple[list[float], list[float], int]:
    count = draw(st.integers(3, 9))
    at = sorted(draw(st.lists(st.integers(0, 72), min_size=count, max_size=count)))
    at = [5.0 * one for one in at]
    kept = [one for number, one in enumerate(at) if at[max(number - 2, 0) : number].count(one) < 2]
    torque = draw(st.lists(st.integers(-500, 900), min_size=len(kept), max_size=len(kept)))
    return kept, [float(one) for one in torque], draw(st.integers(1, 4))


@given(broken_lines())
def test_a_broken_line_is_integrated_as_by_trapezoids(line: tuple[list[float], list[float], int]) -> None:
    at, torque, cylinders = line
    # a table that is shorter than the period is refused
    if at[0] == at[-1] or 360 - (at[-1] - at[0]) > max(after - before for before, after in itertools.pairwise(at)):
        return
    found = analysed(f"""
        crank.speed = "300 rpm"
        [torque]
        period = "360 deg"
        at = {[f"{one} deg" for one in at]}
        torque = {[f"{one} N*m" for one in torque]}
        cylinders = {cylinders}
        [flywheel]
        inertia = "5000 kg*m2"
        """)
    step = 0.01
    angles = (np.arange(round(360 / step)) + 0.5) * step
    values = np.zeros_like(angles)
    for number in range(cylinders):
        local = np.mod(angles - 360 * number / cylinders, 360.0)
        corners = np.array([at[-1] - 360, *at, at[0] + 360])
        heights = np.array([torque[-1], *torque, torque[0]])
        left = np.clip(np.searchsorted(corners, local, side="right") - 1, 0, len(corners) - 2)
        width = corners[left + 1] - corners[left]
        share = (local - corners[left]) / np.where(width > 0, width, 1.0)
        values += heights[left] + (heights[left + 1] - heights[left]) * share
    mean = float(values.mean())
    energy = np.append(0.0, np.cumsum(values - mean) * math.radians(step))
    size = max(float(np.max(np.abs(values))), 1.0)
    assert found["mean_torque"] == pytest.approx(mean, abs=1e-3 * size)
    assert found["excess_work"] == pytest.approx(float(np.ptp(energy)), abs=1e-3 * size)
    assert not found.unmet


def test_points_may_stand_in_a_file(tmp_path: Path) -> None:
    """Two lobes a turn, 1000 (1 - cos 2 phi), by 721 points: a mean of 1000 N m and an excess work of 1000 J."""
    angles = np.linspace(0.0, 360.0, 721).tolist()
    rows = [f"{one};{1000 * (1 - math.cos(2 * math.radians(one)))!r}" for one in angles]
    (tmp_path / "torque.csv").write_text("\n".join(["phi [deg];M [N*m]", *rows]), encoding="utf-8")
    machine = tmp_path / "machine.toml"
    machine.write_text(
        """
        crank.speed = "100 rpm"
        torque = { period = "360 deg", file = "torque.csv", at = "phi", torque = "M" }
        """,
        encoding="utf-8",
    )
    found = analyse(read(machine))
    assert found["mean_torque"] == pytest.approx(1000.0, rel=1e-12)
    assert found["excess_work"] == pytest.approx(1000.0, rel=1e-4)
    assert not found.unmet


@pytest.mark.slow
def test_sampling_changes_nothing_and_every_value_can_be_explained() -> None:
    wrong = []
    for path in FILES:
        machine = read(path)
        first, *others = (analyse(machine, CrankGrid.steps(step, machine.cycle)) for step in (1.0, 7.0, 30.0))
        wrong += [path.stem for one in others if one.summary != first.summary or one.unmet]
        at = {key: machine.cycle / 3 if first.trace[key].varies else None for key in first.keys()}  # noqa: SIM118 - of both
        wrong += [(path.stem, key) for key, angle in at.items() if not first.explain(key, angle)]
    assert wrong == []


def test_a_shaft_is_shown() -> None:
    wrong = []
    for path, language in zip(FILES, itertools.cycle(LANGUAGES)):
        results = analyse(read(path))
        assert set(figures(results, language=language)) in ({"turning_moment", "speed"}, {"loops"}), path.stem
        assert "energy_extremes" in sheets(results), path.stem
        page = web(note_of(results, NoteOptions(full=True, language=language))).decode()
        if "<table" not in page or "None" in page:
            wrong.append((path.stem, language))
    assert wrong == []


def test_the_loops_of_a_turning_moment_are_shaded_above_the_load_and_hatched_below_it() -> None:
    seen = set()
    for path in FILES:
        results = analyse(read(path))
        drawn, works = drawings(results).get("turning_moment"), turning_diagram(results)
        if drawn is None or works is None:
            continue
        less, more = works.torque < works.load, works.torque > works.load
        hatched = [one for one in drawn.items if isinstance(one, Hatch)]
        shaded = [one for one in drawn.items if isinstance(one, Polyline) and one.fill not in (None, 1.0)]
        # what is taken away at once has no area
        assert bool(hatched) is bool(np.any(less[1:] & less[:-1])), path.stem
        assert bool(shaded) is bool(np.any(more[1:] & more[:-1])), path.stem
        seen |= {bool(hatched), bool(shaded)}
    assert seen == {True, False}


@pytest.mark.elsewhere
def test_a_torque_with_a_negative_mean_is_told() -> None:
    notice = next(item for item in analysed(TestByHand.FILE.replace('"50 N', '"-50 N')).notices if "back" in item.code)
    assert notice.values["torque"] == pytest.approx(-50)
    assert all("back" not in item.code for item in analysed(TestByHand.FILE).notices)
