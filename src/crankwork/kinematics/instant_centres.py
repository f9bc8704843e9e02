"""Instantaneous centres of velocity of links, relative to the ground."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.driver import LinkMotor
from crankwork.mechanism.joints import Pin, joints
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities.key import key_of

_REST_TOLERANCE = 1e-12
# beyond it the centre of a link that does not turn is rounding [m]
_FARTHEST = 1e9


@formula("instant_centre_x", "khurmi_gupta_2005, ch. 6")
def instant_centre_x(x_P: Value, y_P1: Value, theta_1: Value) -> Value:
    """Coordinate x of the point about which a link turns, from one of its points."""
    return x_P - y_P1 / theta_1


@formula("instant_centre_y", "khurmi_gupta_2005, ch. 6")
def instant_centre_y(y_P: Value, x_P1: Value, theta_1: Value) -> Value:
    """Coordinate y of the point about which a link turns, from one of its points."""
    return y_P + x_P1 / theta_1


def pivoted_links(mechanism: Mechanism) -> set[str]:
    """Return the links that turn about a fixed pivot."""
    return {joint.link for joint in joints(mechanism) if isinstance(joint, Pin) and joint.other == GROUND}


def instant_centres(mechanism: Mechanism, motion: Motion) -> Iterator[tuple[str, TracedValue]]:
    """Yield the instant centres of rotating links without a fixed pivot; `motion` is traced."""
    # the third side of the triangle of a motor is not a link
    pivoted = pivoted_links(mechanism) | ({mechanism.driver.link} if isinstance(mechanism.driver, LinkMotor) else set())
    for name in motion.links:
        if name in pivoted or name not in motion.frames or motion.frames[name].angle_1.is_absent:
            continue
        (x, y), turning = motion.frames[name].origin, motion.frames[name].angle_1
        yield f"instant_centre_x.{name}", instant_centre_x(x.position, y.position_1, turning)
        yield f"instant_centre_y.{name}", instant_centre_y(y.position, x.position_1, turning)


def absent_where_still(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return columns with NaN for the instant centres of links at rest."""
    rates = {key: np.abs(column) for key, column in columns.items() if key.startswith("link_angular_velocity.")}
    largest = max((float(np.max(rate, initial=0.0)) for rate in rates.values()), default=0.0)
    result = dict(columns)
    for key, values in columns.items():
        kind, name = key_of(key)
        if kind in {"instant_centre_x", "instant_centre_y"}:
            turns = rates[f"link_angular_velocity.{name}"] > _REST_TOLERANCE * largest
            both = (np.abs(columns.get(f"instant_centre_{axis}.{name}", 0.0)) < _FARTHEST for axis in "xy")
            result[key] = np.where(np.logical_and(*both) & turns, values, np.nan)
    return result
