"""Harmonics of a torque over the cycle, each under its order: `harmonic_amplitude.2.5`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from crankwork.analysis.results import Listing
from crankwork.cylinders.torque import TorqueHarmonics, amplitude_of_harmonic, curve_harmonics
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, TracedValue, total
from crankwork.quantities.key import key_of
from crankwork.shaft.curve import Curve

# orders per revolution, and relative size of coefficients of polynomials that are rounding
_ORDERS = 12
_ROUNDING = 1e-16
# share of the torque of the largest joint force below which a torque is rounding
_NEGLIGIBLE = 1e-12
# digits to which vectors of a layout are rounded
_DIGITS = 13


def order_count(cycle: float) -> int:
    """Return how many harmonics of a cycle are listed. [deg]"""
    return round(_ORDERS * cycle / 360)


def curve_of(over: CycleInterpolant, key: str) -> Curve:
    """Return a column as polynomials, without degrees that are only rounding."""
    series = over.polynomials(key)
    sizes = np.max(np.abs(series), axis=0)
    last = int(np.max(np.flatnonzero(sizes > _ROUNDING * sizes.max()), initial=0))
    return Curve.legendre(np.radians(over.edges), series[:, : last + 1])


def amplitude_of_order(column: TracedValue, order: float, cosine: float, sine: float) -> TracedValue:
    """Return the amplitude of a harmonic of a column from its coefficients."""
    waves = {"cosine": cosine, "sine": sine}
    parts = (TracedValue(HarmonicCoefficient(value, column, part, order)) for part, value in waves.items())
    amplitude: TracedValue = amplitude_of_harmonic(*parts)
    return amplitude


def direction(x: TracedValue, y: TracedValue) -> TracedValue:
    """Return the direction of a vector from the x axis. [rad]"""
    return TracedValue(ProcedureValue(math.atan2(y.value, x.value), "direction", (x, y)))


def size_of_sum(products: Sequence[tuple[TracedValue, complex]]) -> TracedValue:
    """Return the magnitude of a sum of forces times vectors of the layout, which are rounded."""
    x, y = (
        total("", [force * round(part, _DIGITS) for (force, _), part in zip(products, parts, strict=True)])
        for parts in ([item.real for _, item in products], [item.imag for _, item in products])
    )
    size: TracedValue = amplitude_of_harmonic(x, y)
    return size


def traced_harmonics(harmonics: TorqueHarmonics, torque: TracedValue, kind: str = "harmonic") -> Iterator[TracedValue]:
    """Yield coefficients, amplitude and phase of every harmonic of a torque.

    `torque`: that they are of; `kind`: with which the keys begin, `total_harmonic` of the whole machine.
    """
    for index, order in enumerate(harmonics.orders.tolist()):
        cosine, sine = (
            TracedValue(
                HarmonicCoefficient(float(getattr(harmonics, part)[index]), torque, part, order),
                f"{kind}_{part}.{order:g}",
            )
            for part in ("cosine", "sine")
        )
        amplitude = amplitude_of_harmonic(cosine, sine).named(f"{kind}_amplitude.{order:g}")
        yield from (cosine, sine, amplitude)
        phase, parts = float(harmonics.phase[index]), (cosine, sine)
        yield TracedValue(
            ProcedureValue(phase, "fourier", parts, argument=direction(*parts)), f"{kind}_phase.{order:g}"
        )


def harmonics_listing(harmonics: Mapping[str, TracedValue]) -> Listing:
    """Return the harmonics of the torque by their order."""
    columns: dict[str, list[float]] = {"harmonic_order": []}
    for key, known in harmonics.items():
        kind, order = key_of(key)
        columns.setdefault(kind, []).append(known.value)
        if kind.endswith("harmonic_cosine"):
            columns["harmonic_order"].append(float(order))
    return Listing({key: np.array(values) for key, values in columns.items()})


def delivered_harmonics(over: CycleInterpolant, cycle: float, radius: float) -> dict[str, TracedValue]:
    """Return the torque that a linkage gives to its crank, minus the balancing torque, and its harmonics.

    Empty if the torque is only the rounding of the joint forces at the crank radius. `over`: its
    columns over a whole cycle [deg]; `radius`: of the crank [m].
    """
    reach = {key: max(abs(end.value) for end in ends) for key, ends in over.extreme_points.items()}
    forces = [size for key, size in reach.items() if key.startswith("joint_force.")]
    if reach.get("balancing_torque", 0.0) <= _NEGLIGIBLE * radius * max(forces, default=0.0):
        return {}
    torque = (-over.columns["balancing_torque"]).named("total_torque")
    coefficients = curve_harmonics(-curve_of(over, "balancing_torque"), order_count(cycle))
    harmonics = traced_harmonics(coefficients, torque, "total_harmonic")
    return {torque.key: torque} | {known.key: known for known in harmonics}


def listed_harmonics(values: Mapping[str, TracedValue]) -> dict[str, Listing]:
    """Return the table of the harmonics of a linkage, if there are any."""
    harmonics = {key: known for key, known in values.items() if key.startswith("total_harmonic")}
    return {"torque_harmonics": harmonics_listing(harmonics)} if harmonics else {}
