"""The theoretical diagram closes on any crank gear, and its area is the mean pressure of the calculation."""

from typing import NamedTuple

import numpy as np
import pytest

from crankwork.formula.replay import replay
from crankwork.formula.traced_value import Tabulated, TracedValue, given, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.indicator import IndicatorDiagram
from crankwork.loads.traced_diagram import traced_pressure
from crankwork.working_cycle.calculated_cycle import CalculatedCycle
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.grinevetsky import grinevetsky
from crankwork.working_cycle.ideal import IdealData, ideal_cycle
from crankwork.working_cycle.pressure_models import CornerPressure, sharp_diagram
from crankwork.working_cycle.rounding import Timing
from each import for_each

pytestmark = pytest.mark.elsewhere

CYCLES = {
    "petrol": grinevetsky(GrinevetskyData("petrol", 8.5, 5600.0)),
    "diesel": grinevetsky(GrinevetskyData("diesel", 17.0, 2600.0)),
    "two-stroke": grinevetsky(
        GrinevetskyData("diesel", 14.0, 2000.0, strokes=2, lost_stroke=0.18, charge_pressure=0.15e6)
    ),
    "two-stroke petrol": grinevetsky(GrinevetskyData("petrol", 7.0, 3000.0, strokes=2, lost_stroke=0.2)),
    "otto": ideal_cycle(IdealData("otto", 8.0, 1e5, 300.0, heat=1.5e6)),
    "ideal-diesel": ideal_cycle(IdealData("ideal-diesel", 18.0, 1e5, 300.0, cut_off=2.0)),
    "dual": ideal_cycle(IdealData("dual", 16.0, 1e5, 300.0, heat=1.5e6, pressure_ratio=1.4)),
    "two-stroke ideal": ideal_cycle(IdealData("otto", 8.0, 1e5, 300.0, heat=1.5e6, angle=360.0)),
}
every_cycle = for_each("cycle", CYCLES.values(), ids=CYCLES)
every_offset = for_each("offset", [0.0, 0.01, -0.01], ids=["central", "offset", "offset the other way"])
RADIUS, ROD, AREA = 0.045, 0.15, 0.005


class Cylinder(NamedTuple):
    """Volume by crank angle of an offset crank gear, written down anew, and its dead centres."""

    offset: float
    ratio: float

    @property
    def centres(self) -> tuple[float, float]:
        return dead_centres(SliderCrank(RADIUS, ROD, self.offset))

    @property
    def swept(self) -> float:
        low, high = (np.sqrt((ROD + sign * RADIUS) ** 2 - self.offset**2) for sign in (-1, 1))
        return float(AREA * (high - low))

    def volume_at(self, degrees):
        phi = np.radians(degrees)
        reach = RADIUS * np.cos(phi) + np.sqrt(ROD**2 - (RADIUS * np.sin(phi) - self.offset) ** 2)
        return self.swept / (self.ratio - 1) + AREA * (np.sqrt((ROD + RADIUS) ** 2 - self.offset**2) - reach)


def _cylinder(cycle: CalculatedCycle, offset: float) -> Cylinder:
    corners = cycle.corners
    return Cylinder(offset, (corners.epsilon.value - corners.psi.value) / (1 - corners.psi.value))


def _diagram(cycle: CalculatedCycle, cylinder: Cylinder) -> IndicatorDiagram:
    return sharp_diagram(cycle.corners, cycle.angle, cylinder.volume_at, cylinder.centres)


def _mean_pressure(cycle: CalculatedCycle) -> float:
    values = cycle.values
    whole = values.get("theoretical_mean_pressure", values.get("ideal_mean_pressure"))
    assert whole is not None
    return whole * (1 - cycle.corners.psi.value)


@every_cycle
@every_offset
def test_the_area_of_the_diagram_is_the_calculated_mean_pressure(cycle: CalculatedCycle, offset: float):
    cylinder = _cylinder(cycle, offset)
    diagram = _diagram(cycle, cylinder)
    work = diagram.work(cylinder.volume_at)
    if cycle.angle == 720:
        work -= (cycle.corners.p_a.value - cycle.corners.p_r.value) * cylinder.swept
    assert work / cylinder.swept == pytest.approx(_mean_pressure(cycle), rel=1e-10)


@every_cycle
@every_offset
def test_the_diagram_closes_without_a_jump_that_was_not_meant(cycle: CalculatedCycle, offset: float):
    cylinder = _cylinder(cycle, offset)
    diagram = _diagram(cycle, cylinder)
    assert diagram.jumps == ()
    start, end = diagram.segments[0], diagram.segments[-1]
    assert (start.start, end.end) == pytest.approx((0.0, cycle.angle), abs=1e-9)


@every_cycle
@every_offset
def test_the_greatest_pressure_is_just_after_the_firing_dead_centre(cycle: CalculatedCycle, offset: float):
    cylinder = _cylinder(cycle, offset)
    degrees = np.linspace(0, cycle.angle, 7201)
    pressure = _diagram(cycle, cylinder).pressure(degrees, cylinder.volume_at(degrees))
    firing = 360.0 if cycle.angle == 720 else 0.0
    away = (degrees[np.argmax(pressure)] - firing - cylinder.centres[0] + 180) % 360 - 180
    assert -0.2 < away < 60
    assert pressure.max() == pytest.approx(cycle.corners.p_z.value, rel=0.02)


def test_the_points_of_a_diesel_are_where_books_put_them():
    cycle = CYCLES["diesel"]
    cylinder = _cylinder(cycle, 0.0)
    angles = {name: angle for name, (angle, _) in _diagram(cycle, cylinder).named.items()}
    assert [angles[name] for name in ("r", "a", "c", "z'", "b", "e", "r'")] == [0, 180, 360, 360, 540, 540, 720]
    ratio = cylinder.volume_at(np.array([angles["z"]])) / cylinder.volume_at(np.array([0.0]))
    assert ratio[0] == pytest.approx(cycle.corners.rho.value, rel=1e-13)


def test_a_cylinder_of_another_ratio_says_so():
    cycle = CYCLES["diesel"]
    cylinder = Cylinder(0.0, cycle.corners.epsilon.value * 1.1)
    assert {name for name, _, _ in _diagram(cycle, cylinder).jumps} == {"c", "b"}
    with pytest.raises(CycleError, match="compression ratio"):
        sharp_diagram(
            CYCLES["dual"].corners._replace(rho=given("cut_off", 20.0)), 720.0, cylinder.volume_at, cylinder.centres
        )


def test_the_work_does_not_depend_on_the_speed_and_that_is_said():
    works = []
    for speed in (2600.0, 1300.0):
        cycle = grinevetsky(GrinevetskyData("diesel", 17.0, speed, bore=0.1, stroke=0.1))
        cylinder = _cylinder(cycle, 0.0)
        found = CornerPressure(cycle).pressure(cylinder.volume_at, cylinder.volume_at, cylinder.centres)
        works.append(found.diagram.work(cylinder.volume_at))
        assert "cycle_speed" in dict(found.notices)
    assert works[0] == pytest.approx(works[1], rel=1e-12)


@for_each("timing", [None, Timing(20.0, 5.0, 10.0, 60.0, 55.0, 15.0)], ids=["sharp", "rounded"])
@for_each("name", ["petrol", "diesel"])
def test_the_pressure_at_any_angle_is_followed_into_the_calculation(name: str, timing: Timing | None):
    cycle = CYCLES[name]
    cylinder = _cylinder(cycle, 0.0)
    diagram = CornerPressure(cycle, timing).pressure(cylinder.volume_at, cylinder.volume_at, cylinder.centres).diagram
    volume = TracedValue(Tabulated(cylinder.volume_at, "measured"), "cylinder_volume")
    pressure = traced_pressure(diagram, volume)
    grid = CrankGrid.steps(7.3, 720.0)
    assert np.array_equal(replay(pressure, grid), diagram.pressure(grid.degrees, cylinder.volume_at(grid.degrees)))
    made_of = {one.key for one in in_order([pressure])}
    assert {"combustion_pressure", "expansion_exponent", "intake_pressure", "compression_exponent"} <= made_of
    assert {"residual_pressure", "fuel_carbon", "cylinder_volume.a"} <= made_of
