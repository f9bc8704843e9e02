"""Engines as tests make them: customary ones, at which angle of its own a cylinder stands, and its volume."""

from __future__ import annotations

import numpy as np

from crankwork.cylinders.arrangement import build_layout
from crankwork.cylinders.layout import Banks
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.piston import piston_motion
from crankwork.loads import gas as gas_formulas
from crankwork.method import EXACT

_DECIMALS = 9


def standard_layout(standard, *, spacing=0.0):
    """Return a customary engine."""
    own = standard.kind in ("inline", "boxer")
    pitch, stagger = (2 * spacing, spacing) if standard.kind == "boxer" else (spacing, 0.0)
    banks = Banks(
        standard.kind, standard.cylinders, standard.axes, pitch, stagger, standard.pin_offset, standard.numbering, own
    )
    return build_layout(banks, standard.order, strokes=standard.strokes, throws=standard.throws)


def cylinder_angle(degrees, place, cycle):
    """Return the crank angle of a cylinder in its own cycle. [deg]

    (degrees - firing angle) mod cycle; a decimal where rounding alone keeps it from being one, and left as it is for
    a cylinder that fires with the first, within one cycle.
    """
    degrees = np.asarray(degrees, dtype=float)
    within = (degrees >= 0) & (degrees <= cycle)
    if place.firing_angle == 0 and np.all(within):
        return degrees
    rest = np.mod(degrees - place.firing_angle, cycle)
    near = np.round(rest, _DECIMALS)
    reach = 1e-15 * (np.abs(degrees) + place.firing_angle + cycle)
    rest = np.where(np.abs(rest - near) <= reach, near, rest)
    return np.where(cycle - rest <= 1e-12 * cycle, 0.0, rest)


def cylinder_volumes(lengths, bore, clearance, method=EXACT):
    """Return the volume of a cylinder and its derivative as functions of the crank angle.

    [deg] -> [m3] and [deg] -> [m3/rad].
    """
    area = float(gas_formulas.piston_area(method.pi, bore))

    def volume_at(degrees):
        x = piston_motion(lengths, CrankGrid.from_degrees(degrees), method).piston.position
        return np.asarray(gas_formulas.cylinder_volume(clearance, area, x))

    def volume_rate_at(degrees):
        return np.asarray(area * piston_motion(lengths, CrankGrid.from_degrees(degrees), method).piston.position_1)

    return volume_at, volume_rate_at
