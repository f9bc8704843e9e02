"""Every column of a linkage as a traced value: motion, reduction to the crank, torques, forces in joints."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.counterweight_balance import shaking
from crankwork.analysis.flywheel import turning_inertia
from crankwork.analysis.operating_state import is_shared, traced_joint_forces
from crankwork.analysis.transmission_quality import transmissions
from crankwork.dynamics import reduction
from crankwork.dynamics.efficiency import driving_torque_as_brake, driving_torque_as_motor
from crankwork.dynamics.link_loads import OperatingState, link_angular_acceleration
from crankwork.dynamics.reaction import JointForces, pin_columns
from crankwork.formula.traced_value import Piecewise, TracedValue, absent, reached
from crankwork.kinematics import kinematic_coefficients as rates
from crankwork.kinematics.dyads import is_zero
from crankwork.kinematics.instant_centres import instant_centres
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.motion_laws import clock, traced_jerk
from crankwork.kinematics.traced_motion import angle_of, interpolant_of, traced_mechanism
from crankwork.loads.load import applied_loads
from crankwork.machine import Drive, Machine
from crankwork.mechanism.driver import Law, LinkMotor
from crankwork.mechanism.joints import SlidingJoint, joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank
from crankwork.preparation import traced_inputs
from crankwork.preparation.linkage import driver_speed_and_acceleration
from crankwork.preparation.prepared import PreparedLinkage

# result of a driver, by whether it turns
DRIVEN = {False: "driver_force", True: "driver_torque"}


def traced_state(solved: PreparedLinkage, motion: Motion) -> OperatingState:
    """Return a linkage at work, with its loads, traced."""
    machine = solved.machine
    w, eps = driver_speed_and_acceleration(machine, motion)
    mechanism = traced_mechanism(machine.mechanism, machine.linkage)
    loads = applied_loads(mechanism, motion, machine.loads, w).also(solved.filling.loads(mechanism, motion))
    return OperatingState(mechanism, motion, w, loads, eps)


def linkage_trace(solved: PreparedLinkage, running: OperatingState) -> dict[str, TracedValue]:
    """Return all columns of a linkage (artobolevsky_1988, ch. 13-16).

    Columns by key; those of points, links, sliders, joints and chambers are `key.NAME`. `running`: the linkage at work,
    traced.
    """
    machine, motion, w, eps = solved.machine, running.motion, running.speed, running.angular_acceleration
    if motion.driver is not None and machine.mechanism.driver.law is not None:
        return {key: value.named(key) for key, value in _by_law(solved, running, machine.mechanism.driver.law).items()}
    columns: dict[str, TracedValue] = {"crank_angle": angle_of(motion.grid), **dict(_moving(machine, motion, w, eps))}
    columns |= solved.filling.columns
    if machine.mechanism.bodies or machine.loads or machine.chambers or machine.friction or machine.drive.inertia:
        columns |= _at_work(solved, running)
    return {key: value.named(key) for key, value in columns.items()}


def _by_law(solved: PreparedLinkage, running: OperatingState, law: Law) -> dict[str, TracedValue]:
    """Return the columns of a linkage whose driver follows a law over time, with the torque or force of the driver."""
    machine, motion = solved.machine, running.motion
    q, rate, second = motion.driver or Transfer(None, None, None)
    columns = {"time": clock(law), **{item.key: item for item in (q, rate, second)}}
    jerk = traced_jerk(law, turns=machine.mechanism.driver.turns) if law.has_jerk else None
    columns |= {jerk.key: jerk} if jerk is not None else {}
    columns |= {**dict(_moving(machine, motion, rate, second)), **solved.filling.columns}
    if machine.mechanism.bodies or machine.loads or machine.chambers or machine.friction:
        torque, forces = _forces(solved, running)
        driven = torque.named(DRIVEN[machine.mechanism.driver.turns])
        columns |= {driven.key: driven, "driver_power": reduction.driver_power(driven, rate), **forces}
    return columns


def _moving(machine: Machine, motion: Motion, w: TracedValue, eps: TracedValue) -> Iterator[tuple[str, TracedValue]]:
    """Yield positions, velocities and accelerations of everything that moves."""
    driver = machine.mechanism.driver
    for name, (x, y) in motion.points.items():
        if name in machine.mechanism.ground:
            continue
        yield f"point_x.{name}", x.position
        yield f"point_y.{name}", y.position
        yield from _rates_of_point(name, PointMotion(x, y), w, eps)
    for name, value in motion.links.items():
        if name != driver.link or not isinstance(driver, Crank | LinkMotor):
            yield f"link_angle.{name}", value.position
            yield f"link_angular_velocity.{name}", rates.link_angular_velocity(value.position_1, w)
            turning = link_angular_acceleration(value.position_2, w, value.position_1, eps)
            yield f"link_angular_acceleration.{name}", turning
    carrier = {
        joint.name: joint.other
        for joint in joints(machine.mechanism)
        if isinstance(joint, SlidingJoint) and joint.other != GROUND
    }
    for name, value in motion.sliders.items():
        yield f"slider_displacement.{name}", value.position
        yield f"slider_velocity.{name}", rates.slider_velocity(value.position_1, w)
        yield f"slider_acceleration.{name}", rates.slider_acceleration(value.position_2, w, value.position_1, eps)
        turning = motion.frames[carrier[name]].angle_1 if name in carrier else absent("link_angle_1")
        # the crank has no transfer function of its own
        crank = driver if isinstance(driver, Crank) and carrier.get(name) == driver.link else None
        if crank is not None or not turning.is_absent:
            velocity = rates.slider_velocity(value.position_1, w).named(f"slider_velocity.{name}")
            carried = rates.link_angular_velocity(turning, w)
            if crank is not None:
                carried = w if crank.direction > 0 else -w
            carried = carried.named(f"link_angular_velocity.{carrier[name]}")
            yield f"coriolis_acceleration.{name}", rates.coriolis_acceleration(carried, velocity)
    yield from transmissions(machine.mechanism, motion)
    yield from instant_centres(machine.mechanism, motion)


def _rates_of_point(
    name: str, point: PointMotion, w: TracedValue, eps: TracedValue
) -> Iterator[tuple[str, TracedValue]]:
    """Yield velocity and acceleration of a point: along the axes, and their magnitude."""
    (_, x_1, x_2), (_, y_1, y_2) = point
    v_x = rates.point_velocity_x(x_1, w).named(f"point_velocity_x.{name}")
    v_y = rates.point_velocity_y(y_1, w).named(f"point_velocity_y.{name}")
    a_x = rates.point_acceleration_x(x_2, w, x_1, eps).named(f"point_acceleration_x.{name}")
    a_y = rates.point_acceleration_y(y_2, w, y_1, eps).named(f"point_acceleration_y.{name}")
    velocity, acceleration = rates.point_velocity(v_x, v_y), rates.point_acceleration(a_x, a_y)
    yield from ((item.key, item) for item in (v_x, v_y, velocity.named(f"point_velocity.{name}")))
    yield from ((item.key, item) for item in (a_x, a_y, acceleration.named(f"point_acceleration.{name}")))


def _at_work(solved: PreparedLinkage, running: OperatingState) -> dict[str, TracedValue]:
    """Return reduction, torques and forces in joints."""
    machine, mechanism, motion, loads = solved.machine, running.mechanism, running.motion, running.loads
    w, eps = running.speed, running.angular_acceleration
    added = turning_inertia(machine, "reduced_inertia.drive")
    inertia = reduction.reduced_inertia(mechanism, motion, added)
    reduced: TracedValue = reduction.reduced_torque(motion, loads)
    static: TracedValue = absent("static_torque") if reduced.is_absent else reduction.static_torque(reduced)
    dynamic: TracedValue = reduction.dynamic_torque(w, inertia.inertia_1, inertia.inertia, eps)
    static, dynamic = static.named("static_torque"), dynamic.named("dynamic_torque")
    balancing: TracedValue = reduction.balancing_torque_of_parts(static, dynamic)
    columns = {
        "reduced_inertia": inertia.inertia,
        "reduced_inertia_1": inertia.inertia_1,
        "kinetic_energy": reduction.kinetic_energy(inertia.inertia, w),
        "static_torque": static,
        "dynamic_torque": dynamic,
        "balancing_torque": balancing,
        "driving_torque": _driving(static, dynamic, balancing, machine.drive, motion),
        **_forces(solved, running)[1],
    }
    if any(not is_zero(body.mass) for body in mechanism.bodies):
        columns |= shaking(running)
    return columns if reduced.is_absent else columns | {"reduced_torque": reduced}


def _driving(
    static: TracedValue, dynamic: TracedValue, balancing: TracedValue, drive: Drive, motion: Motion
) -> TracedValue:
    """Return the torque of the motor, which drives where it is positive and brakes where it is negative."""
    eta = traced_inputs.efficiency_of(drive)
    motor: TracedValue = driving_torque_as_motor(static, dynamic, eta)
    if eta.is_absent or not balancing.varies:
        return motor
    ends, is_brake = interpolant_of(motion.grid)({"": balancing}).sign_intervals("")
    brake: TracedValue = driving_torque_as_brake(static, dynamic, eta)
    places: list[TracedValue | float] = [*(reached(balancing, end) for end in ends[:-1]), ends[-1]]
    return TracedValue(Piecewise(places, tuple(brake if item else motor for item in is_brake)), "driving_torque")


def _forces(solved: PreparedLinkage, running: OperatingState) -> tuple[TracedValue, dict[str, TracedValue]]:
    """Return the balancing torque, and the forces in joints and guides.

    The joint of crank and ground has the name of its fixed point.
    """
    values, along = traced_joint_forces(solved, running)
    if not is_shared(solved.machine.redundant):
        return values.balancing_torque, {}
    columns = joint_columns(solved.machine, values)
    for name, (across, separating) in values.teeth.items():
        columns |= {f"tooth_force.{name}": across, f"separating_force.{name}": separating}
    return values.balancing_torque, columns | along


def joint_columns(machine: Machine, forces: JointForces, suffix: str = "") -> dict[str, TracedValue]:
    """Return the forces in joints and guides; `suffix`: of their quantities."""
    pivots, columns = names_of_pivots(machine.mechanism), dict[str, TracedValue]()
    for joint, pin in forces.pins.items():
        columns |= pin_columns(pivots.get(joint, joint), pin.x, pin.y, kind=f"joint_force{suffix}")
    for name, guide in forces.guides.items():
        columns |= {f"normal_force{suffix}.{name}": guide.normal, f"normal_moment{suffix}.{name}": guide.moment}
    return columns
