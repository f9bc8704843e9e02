"""How large the parts of an engine are drawn: what is known as it is, the rest as it usually is."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving_engine import CylinderMoving, EngineMoving
from crankwork.machine import Bearings, Machine

# of the bore, where nobody says: crankpin, journal, piston pin, the crown above its pin and the skirt below it
_PIN, _MAIN, _WRIST, _CROWN, _SKIRT = 0.27, 0.3, 0.12, 0.42, 0.3
_PITCH, _WALL = 1.25, 0.03
# of the pitch of throws
_JOURNAL = 0.3


class Sizes(NamedTuple):
    """Sizes of the parts, and where they stand along the shaft. [m]"""

    bore: float
    crank: float  # Radius
    pin: float  # Radius of a crankpin
    main: float  # Radius of a main journal
    wrist: float  # Radius of a piston pin
    crown: float  # From the piston pin to the top of the piston
    skirt: float  # From the piston pin to its lower edge
    clearance: float  # Between piston and head at the top dead centre
    counterweight: float  # Radius of the counterweights, zero where there are none
    stations: dict[int, float]  # Where each cylinder stands along the shaft, by number
    journals: tuple[float, ...]  # Main journals along the shaft, one more than throws
    journal_length: float

    def scaled(self, scale: float) -> Sizes:
        """Return them in other units of length."""
        stations = {number: station * scale for number, station in self.stations.items()}
        journals = tuple(journal * scale for journal in self.journals)
        lengths = {
            name: value * scale for name, value in self._asdict().items() if name not in ("stations", "journals")
        }
        return Sizes(**lengths, stations=stations, journals=journals)

    def head(self, cylinder: CylinderMoving) -> float:
        """Return the distance of the head of a cylinder from the shaft, along its axis."""
        return cylinder.top + self.crown + self.clearance


def sizes(machine: Machine, engine: EngineMoving) -> Sizes:
    """Return the sizes of a machine with cylinders."""
    first, radius = engine.cylinders[0], float(np.hypot(*engine.cylinders[0].pin[0]))
    stroke, bore = first.top - first.bottom, machine.cylinder.bore if machine.cylinder else 2 * radius
    known = machine.engine.bearings if machine.engine else Bearings()
    # what is drawn beside the crank is no larger than the crank lets it be
    small = min(bore, 1.6 * stroke)
    skirt, crown = min(_SKIRT * bore, 0.35 * stroke), min(_CROWN * bore, 0.6 * stroke)
    lowest = min(cylinder.bottom for cylinder in engine.cylinders) - skirt
    stations, journals = _along_shaft(engine, bore)
    pitch = (journals[-1] - journals[0]) / max(len(journals) - 1, 1)
    return Sizes(
        bore,
        radius,
        known.crankpin_diameter / 2 if known.crankpin_diameter else min(_PIN * small, 0.45 * radius),
        known.main_diameter / 2 if known.main_diameter else min(_MAIN * small, 0.5 * radius),
        known.pin_diameter / 2 if known.pin_diameter else _WRIST * small,
        crown,
        skirt,
        _clearance(machine, stroke),
        min(1.35 * radius, lowest - _WALL * bore) if _has_counterweights(machine) else 0.0,
        stations,
        journals,
        min(known.main_length or _JOURNAL * pitch, 0.4 * pitch),
    )


def _clearance(machine: Machine, stroke: float) -> float:
    """Return the height of the clearance volume above the piston, a twentieth of the stroke where nobody says. [m]"""
    cylinder = machine.cylinder
    if cylinder and cylinder.clearance_volume is not None:
        return min(cylinder.clearance_volume / (math.pi / 4 * cylinder.bore**2), stroke)
    if cylinder and cylinder.compression_ratio is not None:
        return min(stroke / (cylinder.compression_ratio - 1), stroke)
    return stroke / 20


def _has_counterweights(machine: Machine) -> bool:
    engine = machine.engine
    return engine is not None and bool(engine.counterweight or engine.rotating_share or engine.reciprocating_share)


def _along_shaft(engine: EngineMoving, bore: float) -> tuple[dict[int, float], tuple[float, ...]]:
    """Return where cylinders and main journals stand; a usual distance apart where nobody says. [m]"""
    places, given = engine.layout.places, engine.layout.journal_positions
    throws = 1 + max(place.throw for place in places)
    if given or throws == 1:
        span = (-_PITCH * bore / 2, _PITCH * bore / 2)
        return {place.number: place.position for place in places}, given or span
    pitch, middle = _PITCH * bore, (throws - 1) / 2
    stations = {place.number: (place.throw - middle) * pitch for place in places}
    return stations, tuple((index - 0.5 - middle) * pitch for index in range(throws + 1))


def reach(engine: EngineMoving, size: Sizes) -> Array:
    """Return places that an engine seen along the shaft reaches, shape (k, 2). [m]"""
    around = max(size.crank + 1.4 * size.pin, size.counterweight)
    corners = [np.array([[side * around, side * around] for side in (1, -1)])]
    for cylinder in engine.cylinders:
        across = np.array([cylinder.axis[1], -cylinder.axis[0]])
        corners += [
            (size.head(cylinder) * cylinder.axis + (cylinder.offset + side * size.bore / 2) * across)[None]
            for side in (1, -1)
        ]
    return np.vstack(corners)
