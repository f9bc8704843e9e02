"""The pressure of an indicator diagram over the crank angle, traced piece by piece."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from crankwork.formula.replay import replay
from crankwork.formula.traced_value import FormulaCall, Piecewise, ProcedureValue, Tabulated, TracedValue, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.loads.curves import CurvePoint, curve_between
from crankwork.loads.gas import gauge_pressure, polytropic_pressure
from crankwork.loads.indicator import IndicatorDiagram, Segment

# A stated volume within this tolerance is the computed volume.
_SAME_VOLUME = 1e-12


def pressure_on_piston(
    pressure: TracedValue, ambient: tuple[float, str], factor: tuple[float, str], owner: str = ""
) -> TracedValue:
    """Return the pressure of gas above that on the other side, and what of it is taken.

    `ambient`, `factor`: pressure on the other side [Pa] and share, each with where it is stated; `owner`: what follows
    each key.
    """
    above = pressure.named(f"gas_pressure{owner}")
    if ambient[0]:
        above = gauge_pressure(pressure, given(f"ambient_pressure{owner}", *ambient)).named(above.key)
    if factor[0] != 1:
        above = (above * given(f"pressure_factor{owner}", *factor)).named(above.key)
    return above


def traced_pressure(
    diagram: IndicatorDiagram,
    volume: TracedValue,
    path: str = "gas",
    retold: Callable[[], TracedValue] | None = None,
    owner: str = "",
) -> TracedValue:
    """Return the pressure of a diagram as a sequence of laws; `retold`: its form that holds for all inputs.

    `path`: of the diagram in the description; `owner`: the chamber it belongs to, if it is one of a linkage.
    """
    laws = tuple(_law(diagram, segment, volume, (path, owner)) for segment in diagram.segments)
    ends = [segment.end for segment in diagram.segments]
    return TracedValue(Piecewise(ends, laws, diagram.breaks.tolist(), retold), _of("diagram_pressure", owner))


def _of(key: str, owner: str, name: str = "") -> str:
    """Return the key of a column, or of its value at a named point, with the chamber it belongs to."""
    return ".".join((key, *(part for part in (owner, name) if part)))


def at_angle(column: TracedValue, degrees: float, key: str, angle: TracedValue | None = None) -> TracedValue:
    """Return the value of a column at one crank angle under a key; `angle`: that angle if it is traced."""
    value = float(replay(column, CrankGrid.from_degrees([degrees]))[0])
    return TracedValue(ProcedureValue(value, "at", (column,), degrees, angle), key)


def polytrope_origin(
    diagram: IndicatorDiagram, segment: Segment, volume: TracedValue, path: str = "gas", owner: str = ""
) -> tuple[TracedValue, TracedValue, TracedValue]:
    """Return pressure and volume of the state that a polytrope passes through, and its exponent."""
    pressure, state_volume, exponent = segment.state
    name = segment.origin
    if segment.operands:
        p_1, n_p, *remaining = segment.operands
        if name == "z" and isinstance(volume.node, FormulaCall):
            # at the end of combustion the volume is the clearance volume times the cut-off ratio
            burnt = (remaining[0] * volume.node.operands[0]).named(f"cylinder_volume.{name}")
            if math.isclose(burnt.value, state_volume, rel_tol=_SAME_VOLUME):
                return p_1, burnt, n_p
        angle = diagram.named.get(name, (None, 0.0))[0]
        return (
            p_1,
            TracedValue(ProcedureValue(state_volume, "at", (volume, *remaining), angle), f"cylinder_volume.{name}"),
            n_p,
        )
    keys = [_of(key, owner, name) if name else "" for key in ("diagram_pressure", "cylinder_volume")]
    place = f"{path}.points.{_stated(name)}"
    p_1 = given(keys[0], pressure, f"{place}.pressure")
    V_1 = given(keys[1], state_volume, f"{place}.volume")
    if name in diagram.named:
        computed = at_angle(volume, diagram.named[name][0], V_1.key)
        if math.isclose(computed.value, state_volume, rel_tol=_SAME_VOLUME):
            V_1 = computed
    kind = "compression_exponent" if segment.pressures[-1] > segment.pressures[0] else "expansion_exponent"
    return p_1, V_1, given(kind, exponent, f"{path}.pieces[{segment.piece}].exponent")


def _stated(name: str) -> str:
    """Return the name of a point as stated, without the primes of later cycles."""
    return name.rstrip("′")


def _law(diagram: IndicatorDiagram, segment: Segment, volume: TracedValue, stated: tuple[str, str]) -> TracedValue:
    path, owner = stated
    match segment.law:
        case "constant":
            name, pressure = segment.origin, float(segment.pressures[0])
            place = f"{path}.points.{_stated(name)}.pressure"
            plain = given(_of("diagram_pressure", owner, name), pressure, place)
            return segment.operands[0] if segment.operands else plain
        case "polytropic":
            p_1, V_1, exponent = polytrope_origin(diagram, segment, volume, path, owner)
            return polytropic_pressure(p_1, V_1, volume, exponent)  # type: ignore[no-any-return]
    word = "first_law" if segment.operands else "measured" if segment.is_measured else "curve"
    return TracedValue(
        Tabulated(PressureCurve(segment), word, segment.knots.tolist(), segment.operands), "diagram_pressure"
    )


@dataclass(frozen=True)
class PressureCurve:
    """The pressure on the curve of a segment. [deg] -> [Pa]"""

    segment: Segment

    def __call__(self, degrees: Array) -> Array:
        """Return the pressure at crank angles."""
        return self.segment.rounded(degrees)

    def between(self, degrees: float, angle: TracedValue) -> TracedValue:
        """Return the pressure at one crank angle, interpolated between two knots."""
        knots = self.segment.knots
        index = int(np.clip(np.searchsorted(knots, degrees, side="right") - 1, 0, len(knots) - 2))
        return curve_between("diagram_pressure", angle, self._knot(index), self._knot(index + 1))

    def _knot(self, index: int) -> CurvePoint:
        segment = self.segment
        degrees, pressure, slope = (float(part[index]) for part in (segment.knots, segment.pressures, segment.slopes))
        if segment.operands:
            value = TracedValue(ProcedureValue(pressure, "first_law", segment.operands))
            return CurvePoint(TracedValue(ProcedureValue(math.radians(degrees), "step")), value, math.degrees(slope))
        path = segment.places[index] if segment.places else "cycle.timing"
        angle = given("", math.radians(degrees), path.replace(".pressure", ".angle"))
        return CurvePoint(angle, given("", pressure, path), math.degrees(slope))
