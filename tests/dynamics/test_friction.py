from dataclasses import replace

import numpy as np
import pytest

from crankwork.dynamics import friction_equations as module
from crankwork.dynamics.friction import GuideFriction, PinFriction, friction_forces
from crankwork.dynamics.friction_equations import CONVERGED, NOT_CONVERGED, SELF_LOCKING
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.load import ForceOnPoint, ProcessForce, TorqueOnLink, Weight, applied_loads
from crankwork.mechanism.catalog import crank_shaper, scotch_yoke
from crankwork.mechanism.dyads import RPP, RRP, Guide
from crankwork.mechanism.joints import Pin, joints
from crankwork.mechanism.mechanism import Crank, Mechanism, slider_crank
from each import for_each
from linkages import slotted_press

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(2.5, 360, 5))


def running_of(mechanism, *loads, speed=10.0, grid=GRID):
    moved = linkage_motion(mechanism, grid)
    return OperatingState(mechanism, moved, speed, applied_loads(mechanism, moved, loads))


def everywhere(mechanism, coefficient):
    return [
        PinFriction(joint.name, 0.01, coefficient)
        if isinstance(joint, Pin)
        else GuideFriction(joint.link, coefficient, 0.06)
        for joint in joints(mechanism)
    ]


@pytest.fixture(scope="module")
def shaper():
    return running_of(crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14), ProcessForce("ram", lambda way: 300 + 0 * way))


def test_without_friction_nothing_changes(shaper):
    found = friction_forces(shaper, everywhere(shaper.mechanism, 0.0))
    expected = joint_forces(shaper)
    assert found.joint_forces.balancing_torque == pytest.approx(expected.balancing_torque, abs=1e-12)
    assert found.efficiency[found.ideal_torque > 1e-9] == pytest.approx(1)
    assert not found.power_loss.any()


@for_each("mechanism", [crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14), slotted_press(), scotch_yoke(0.1)])
def test_the_power_lost_is_what_the_crank_gives_more(mechanism):
    loads = [TorqueOnLink("crank", -3.0), ForceOnPoint("crank_pin", 100.0, -40.0), Weight()]
    sliders = [joint.link for joint in joints(mechanism) if not isinstance(joint, Pin)]
    running = running_of(mechanism, *loads, *(ProcessForce(one, lambda way: 500 + 0 * way) for one in sliders))
    found = friction_forces(running, everywhere(mechanism, 0.08))
    assert (found.status == CONVERGED).all()
    assert found.residual.max() < 1e-12
    extra = 10.0 * (found.joint_forces.balancing_torque - found.ideal_torque)
    assert extra == pytest.approx(found.power_loss, abs=1e-9 * np.abs(10 * found.ideal_torque).max())
    assert (found.power_loss >= 0).all()


def test_turning_backwards_loses_power_too(shaper):
    forward = friction_forces(shaper, everywhere(shaper.mechanism, 0.05))
    found = friction_forces(replace(shaper, speed=-10.0), everywhere(shaper.mechanism, 0.05))
    assert (found.power_loss >= 0).all()
    extra = -10.0 * (found.joint_forces.balancing_torque - found.ideal_torque)
    assert extra == pytest.approx(found.power_loss, abs=1e-9)
    assert found.joint_forces.balancing_torque.max() < forward.joint_forces.balancing_torque.max()


def pressed_piston():
    """Return a slider-crank on the x axis whose piston is pushed against its way, before the outer dead centre."""
    crank = Mechanism(Crank(0.1), (RRP("crank_pin", "B", "rod", 0.3, block="piston"),))
    grid = CrankGrid.from_degrees(np.arange(190.0, 355, 10))
    return running_of(crank, ForceOnPoint("B", -1000.0, 0.0, "piston"), grid=grid)


def test_friction_of_a_guide_as_in_closed_form():
    running, f = pressed_piston(), 0.15
    found = friction_forces(running, [GuideFriction("piston", f)])
    rod = running.motion.frames["rod"]
    # rod force S: S cos b = P + f N and N = S sin b
    force = 1000 / (rod.cos - f * np.abs(rod.sin))
    assert found.joint_forces.pins["crank_pin"].resultant == pytest.approx(force)
    assert np.abs(found.joint_forces.guides["piston"].normal) == pytest.approx(force * np.abs(rod.sin))
    assert found.friction[GuideFriction("piston", f)] == pytest.approx(-f * force * np.abs(rod.sin))
    ideal = 1000 / rod.cos
    assert found.efficiency == pytest.approx(ideal / force)


def test_friction_of_pins_tilts_the_force_along_the_friction_circles():
    running, rho = pressed_piston(), 0.15 * 0.04
    of_pin = PinFriction("crank_pin", 0.04, 0.15)
    found = friction_forces(running, [of_pin, PinFriction("B", 0.04, 0.15)])
    rod, pin = running.motion.frames["rod"], found.joint_forces.pins["crank_pin"]
    # the force passes each pin at the radius of its friction circle
    across = (rod.cos * pin.y - rod.sin * pin.x) / pin.resultant
    at_crank, at_piston = (-np.sign(one) for one in (rod.angle_1 - 1, -rod.angle_1))
    assert found.friction[of_pin] == pytest.approx(at_crank * rho * pin.resultant)
    assert across == pytest.approx((at_crank - at_piston) * rho / 0.3, abs=1e-12)


def test_friction_in_one_cylinder_does_not_change_the_forces_in_another():
    """The torque of both is the sum, but for the bearing of the crank, which rubs by the sum of what presses."""
    rods = [
        RRP("crank_pin", f"B{number}", f"rod{number}", 0.3, guide_angle=angle, block=f"piston{number}")
        for number, angle in enumerate((0.0, 1.2), start=1)
    ]
    loads = [ForceOnPoint(f"B{number}", -1000.0, 300.0 * number, f"piston{number}") for number in (1, 2)]
    machines = [running_of(Mechanism(Crank(0.1), (rod,)), load) for rod, load in zip(rods, loads, strict=True)]
    both = running_of(Mechanism(Crank(0.1), tuple(rods)), *loads)
    alone = [friction_forces(running, everywhere(running.mechanism, 0.12)) for running in machines]
    found = friction_forces(both, everywhere(both.mechanism, 0.12))
    assert (found.status == CONVERGED).all()
    pins, lost = found.joint_forces.pins, [0.0, 0.0]
    for number, forces in enumerate(alone, start=1):
        assert pins[f"B{number}"].resultant == pytest.approx(forces.joint_forces.pins[f"B{number}"].resultant)
        at_pin = forces.joint_forces.pins["crank_pin"]
        assert pins[f"crank_pin_rod{number}"].x == pytest.approx(at_pin.x)
        lost[number - 1] = 0.12 * 0.01 * forces.joint_forces.pins["crank_pivot"].resultant
    x, y = (sum(getattr(forces.joint_forces.pins["crank_pivot"], axis) for forces in alone) for axis in "xy")
    without_bearing = sum(forces.joint_forces.balancing_torque for forces in alone) - sum(lost)
    assert found.joint_forces.balancing_torque == pytest.approx(without_bearing + 0.12 * 0.01 * np.hypot(x, y))


def test_a_tilted_piece_presses_with_both_ends():
    yoke = running_of(scotch_yoke(0.1), ProcessForce("yoke", lambda way: 100 + 0 * way))
    short, none = (friction_forces(yoke, [GuideFriction("yoke", 0.1, length)]) for length in (0.2, 0.0))
    assert none.power_loss == pytest.approx(0, abs=1e-9)
    forward = yoke.motion.sliders["yoke"].position_1 > 0
    guide = short.joint_forces.guides["yoke"]
    assert np.abs(short.friction[GuideFriction("yoke", 0.1, 0.2)][forward]) == pytest.approx(
        0.1 * 2 * np.abs(guide.moment[forward]) / 0.2
    )
    # the slot presses with N at the height of the pin: N = F + mu 2 N 0.1 |sin phi| / 0.2
    force = 100 / (1 - 0.1 * np.abs(GRID.sin[forward]))
    assert np.abs(short.joint_forces.guides["block"].normal[forward]) == pytest.approx(force)


def slanted_yoke(degrees):
    slot = Guide(angle=np.radians(degrees))
    return Mechanism(Crank(0.05), (RPP("crank_pin", "yoke", "block", slot, Guide((0.0, 0.0))),))


def test_self_locking_begins_at_the_friction_angle():
    # the slot pushes the yoke at an angle of 90 - gamma to its guide; friction locks where tan(90 - gamma) f = 1
    locking = []
    for gamma in (30.0, 25.0, 20.0, 15.0):
        running = running_of(slanted_yoke(gamma), ProcessForce("yoke", lambda way: 100 + 0 * way, acts="forward"))
        found = friction_forces(running, [GuideFriction("yoke", 0.4)])
        forward = running.motion.sliders["yoke"].position_1 > 1e-9
        locking.append(bool((found.status[forward] == SELF_LOCKING).all()))
        free = (found.status == CONVERGED) & forward
        normal = found.joint_forces.guides["block"].normal[free]
        tilt = np.radians(gamma)
        assert np.abs(normal) == pytest.approx(100 / (np.sin(tilt) - 0.4 * np.cos(tilt)))
    # arctan 0.4 = 21.8 degrees
    assert locking == [False, False, True, True]


def test_self_locking_is_said_with_the_angles():
    running = running_of(slanted_yoke(15.0), ProcessForce("yoke", lambda way: 100 + 0 * way, acts="both"))
    found = friction_forces(running, [GuideFriction("yoke", 0.4)])
    locked = found.status == SELF_LOCKING
    assert locked.any()
    assert np.isnan(found.joint_forces.balancing_torque[locked]).all()


def test_friction_that_holds_the_load():
    running = pressed_piston()
    pulled = running_of(running.mechanism, ForceOnPoint("B", 1.0, 0.0, "piston"), grid=running.motion.grid)
    found = friction_forces(pulled, [PinFriction("crank_pivot", 0.04, 0.5), PinFriction("crank_pin", 0.04, 2.0)])
    assert found.held.any()
    assert (found.efficiency[found.held] <= 0).all()


def test_a_joint_at_rest_does_not_rub():
    engine = slider_crank(0.05, 0.2)
    dead = CrankGrid.from_degrees(np.array([0.0, 90.0, 180.0]))
    running = running_of(engine, ForceOnPoint("piston_pin", 200.0, -1000.0), grid=dead)
    found = friction_forces(running, [GuideFriction("piston_pin", 0.1)])
    (friction,) = found.friction.values()
    assert friction[[0, 2]] == pytest.approx(0, abs=1e-12)
    assert friction[1] != 0


def test_no_load_no_friction():
    running = running_of(slider_crank(0.05, 0.2))
    found = friction_forces(running, everywhere(running.mechanism, 0.1))
    assert not found.power_loss.any()
    assert np.isnan(found.efficiency).all()
    assert (found.status == CONVERGED).all()
    assert not found.held.any()


@for_each(
    ("friction", "message"),
    [
        ([PinFriction("nowhere", 0.01, 0.1)], "no joint nowhere.*crank_pivot, crank_pin, piston_pin"),
        ([GuideFriction("crank_pin", 0.1)], "no joint crank_pin.*piston_pin"),
        ([GuideFriction("piston_pin", 0.1), GuideFriction("piston_pin", 0.2)], "two frictions"),
    ],
)
def test_joints_that_do_not_exist(friction, message):
    with pytest.raises(MethodError, match=message):
        friction_forces(running_of(slider_crank(0.05, 0.2)), friction)


def test_an_iteration_that_is_stopped_early_says_so(shaper, monkeypatch):
    monkeypatch.setattr(module, "_ITERATIONS", 1)
    found = friction_forces(shaper, everywhere(shaper.mechanism, 0.3))
    stopped = found.status == NOT_CONVERGED
    assert stopped.any()
    assert np.isnan(found.joint_forces.balancing_torque[stopped]).all()
    assert (found.residual[stopped] > 1e-13).all()
