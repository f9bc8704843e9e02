"""The moment of inertia of a flywheel by each of four ways, of the same formulas and curves as an analysis."""

from crankwork.shaft import flywheel as wheel
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import excess_work

WAYS = ("energy", "mertsalov", "wittenbauer", "exact")


def flywheel(inertia: Curve, torque: Curve, w: float, delta: float, way: str = "exact") -> float:
    """Return the inertia on the crank; negative where the machine needs none. [kg m2]"""
    wheel.check_fluctuation(delta, w)
    excess = excess_work(torque)
    slopes = {
        "mertsalov": 2 * (wheel.slope_of_mean_speed(w),),
        "wittenbauer": (wheel.wittenbauer_slope_largest(w, delta), wheel.wittenbauer_slope_least(w, delta)),
        "exact": (wheel.slope_largest(w, delta), wheel.slope_least(w, delta)),
    }
    less = {"energy": inertia.mean, "mertsalov": inertia.extremes().least}.get(way, 0.0)
    work = excess.work if way == "energy" else wheel.works_of_tangents(inertia, excess, [slopes[way]])[0]
    return wheel.inertia_for_fluctuation(work, delta, w) - less
