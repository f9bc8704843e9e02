"""The torque of the whole engine: sum, torques along the shaft, harmonics, and how evenly it runs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.analysis.cylinders import WholeEngine, cylinder_columns
from crankwork.analysis.results import Listing
from crankwork.analysis.solved import Notice
from crankwork.cylinders.layout import Layout
from crankwork.cylinders.torque import firing_intervals, torques_along_shaft
from crankwork.cylinders.torque_harmonics import (
    curve_harmonics,
    phase_star,
    torque_harmonics,
    total_harmonics,
)
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import ExcessWork, TrueSpeed, excess_work, true_speed
from crankwork.shaft.flywheel import flywheel

_ORDERS = 12
_SAMPLES = 1440


class EngineTorque(NamedTuple):
    """Torque of cylinder 1 and of all over the cycle, the excess work of the sum, and the speed with the flywheel."""

    one: Curve
    total: Curve
    excess: ExcessWork
    flywheel: float | None
    speed: TrueSpeed | None


def engine_torque(whole: WholeEngine, one: Curve, total: Curve) -> tuple[EngineTorque, tuple[Notice, ...]]:
    """Return the torque of the engine with the flywheel it needs, and why there is none.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    one, total : Curve
        Torque of cylinder 1 and of all. [N m]
    """
    excess = excess_work(total)
    wanted, inertia, w = whole.engine.fluctuation, whole.engine.inertia, whole.master.speed
    added, notices = None, []
    if wanted is not None:
        try:
            added = max(flywheel(Curve.constant(inertia, total.cycle), total, w, wanted, "energy").inertia, 0.0)
        except MethodError as error:
            notices.append(Notice("no_flywheel", {"message": str(error)}))
    speed = None
    if inertia + (added or 0.0) > 0:
        try:
            speed = true_speed(Curve.constant(inertia + (added or 0.0), total.cycle), total, w)
        except MethodError as error:
            notices.append(Notice("no_steady_speed", {"message": str(error)}))
    return EngineTorque(one, total, excess, added, speed), tuple(notices)


def torque_columns(whole: WholeEngine, torque: EngineTorque, degrees: Array) -> dict[str, Array]:
    """Return the torques of all cylinders, their sum and those along the shaft; energy and speed where they are known.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    torque : EngineTorque
        What `engine_torque` has found.
    degrees : array, shape (n,)
        Crank angles of cylinder 1. [deg]

    Returns
    -------
    dict of str to array, shape (n,)
        Columns by key. [SI]
    """
    each = cylinder_columns(whole, degrees)["crank_torque"]
    along = torques_along_shaft(each, whole.layout)
    result = {f"crank_torque.{number}": row for number, row in enumerate(each, start=1)} if len(each) > 1 else {}
    result["total_torque"] = along.journals[-1]
    if len(along.throws) > 1:
        result |= {f"journal_torque.{at}": row for at, row in enumerate(along.journals[1:], start=2)}
        result |= {f"crankpin_torque.{at}": row for at, row in enumerate(along.crankpins, start=1)}
    angle = np.radians(degrees)
    result["kinetic_energy_change"] = torque.excess.curve(angle)
    if torque.speed is not None:
        result["crank_speed"] = torque.speed.speed(angle)
    return result


def torque_summary(torque: EngineTorque) -> dict[str, float]:
    """Return mean and extremes of the total torque, excess work and flywheel.

    Parameters
    ----------
    torque : EngineTorque
        What `engine_torque` has found.
    """
    extremes = torque.total.extremes()
    rounding = 1e-13 * max(abs(extremes.largest), abs(extremes.least))
    mean = torque.excess.mean_torque
    result = {
        "mean_total_torque": mean if abs(mean) > rounding else 0.0,
        "total_torque_max": extremes.largest,
        "total_torque_max_angle": extremes.at_largest,
        "total_torque_min": extremes.least,
        "total_torque_min_angle": extremes.at_least,
        "excess_work": torque.excess.work,
    }
    if result["mean_total_torque"]:
        result["energy_fluctuation"] = torque.excess.coefficient
    if torque.flywheel is not None:
        result["flywheel_inertia"] = torque.flywheel
    if torque.speed is not None:
        result["speed_fluctuation"] = torque.speed.fluctuation
        result["crank_speed_max"] = torque.speed.extremes.largest
        result["crank_speed_min"] = torque.speed.extremes.least
    return result


def torque_listings(whole: WholeEngine, torque: EngineTorque) -> dict[str, Listing]:
    """Return the firing of the cylinders and the harmonics of the torque.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    torque : EngineTorque
        What `engine_torque` has found.
    """
    layout = whole.layout
    places = layout.places
    radians = {
        "bank_axis": [one.axis for one in places],
        "crankpin_angle": [one.pin_angle for one in places],
        "firing_angle": [one.firing_angle for one in places],
    }
    after = dict(zip(layout.firing_order, firing_intervals(layout), strict=True))
    radians["firing_interval"] = [after[one.number] for one in places]
    if any(one.slave is not None for one in whole.cylinders):
        strokes = [one.stroke for one in whole.cylinders]
        radians["top_dead_centre_angle"] = [
            (place.firing_angle + stroke[1]) % layout.cycle for place, stroke in zip(places, strokes, strict=True)
        ]
    firing = {key: np.radians(values) for key, values in radians.items()}
    if "top_dead_centre_angle" in firing:
        firing["stroke"] = np.array([stroke[0] for stroke in strokes])
        spaces = [one.space for one in whole.cylinders]
        if all(space is not None for space in spaces):
            firing["swept_volume"] = np.array([space.swept for space in spaces if space is not None])
    numbers = np.array([float(one.number) for one in places])
    count = round(_ORDERS * layout.cycle / 360)
    one, total = curve_harmonics(torque.one, count), curve_harmonics(torque.total, count)
    stars = np.array([abs(phase_star(layout, order).sum) for order in one.orders])
    harmonics = {
        "harmonic_order": one.orders,
        "harmonic_cosine": one.cosine,
        "harmonic_sine": one.sine,
        "harmonic_amplitude": one.amplitude,
        "harmonic_phase": one.phase,
        "phase_sum": stars,
        "total_harmonic_amplitude": total.amplitude,
    }
    return {"firing": Listing({"cylinder_number": numbers, **firing}), "torque_harmonics": Listing(harmonics)}


def torque_checks(whole: WholeEngine, torque: EngineTorque) -> dict[str, float]:
    """Return the residuals between sums over cylinders, phase stars and the total.

    Parameters
    ----------
    whole : WholeEngine
        The engine.
    torque : EngineTorque
        What `engine_torque` has found.
    """
    works = [one.space.work for one in whole.cylinders if one.space is not None]
    result = {}
    if len(works) == len(whole.cylinders) and not whole.machine.angular_acceleration:
        work = torque.excess.work_per_cycle
        result["engine_work"] = abs(work - sum(works)) / max(abs(work), 1e-300)
    samples = _common_samples(whole.layout)
    if len(set(map(id, whole.cylinders))) == 1 and len(whole.cylinders) > 1 and samples:
        degrees: Array = np.arange(float(samples)) * (whole.layout.cycle / samples)
        each = cylinder_columns(whole, degrees)["crank_torque"]
        count = round(_ORDERS * whole.layout.cycle / 360)
        one = torque_harmonics(each[0], whole.layout.cycle, count)
        stars, direct = (
            total_harmonics(one, whole.layout),
            torque_harmonics(each.sum(axis=0), whole.layout.cycle, count),
        )
        apart = np.hypot(stars.cosine - direct.cosine, stars.sine - direct.sine)
        result["phase_stars"] = float(np.max(apart)) / max(float(np.max(one.amplitude)), 1e-300)
    return result


def _common_samples(layout: Layout) -> int:
    """Return how many samples of a cycle have one at every firing; 0 if no moderate number has."""
    firing = np.array([one.firing_angle for one in layout.places]) / layout.cycle
    for count in range(_SAMPLES, 2 * _SAMPLES):
        if np.max(np.abs(firing * count - np.rint(firing * count))) < 1e-9 * count:
            return count
    return 0
