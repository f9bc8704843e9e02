"""Assembly modes of a linkage: its circuits, their branches, and how far everything moves on each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from crankwork.errors import CrankworkError, GeometryError
from crankwork.kinematics.circuits import Circuit, CircuitPart, all_circuits, circuit_at
from crankwork.kinematics.configuration_curve import driver_coordinate, link_angle, rod_of
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import find_crank_range, has_steady_crank
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR, Chain
from crankwork.mechanism.mechanism import Mechanism

_SAME, _FULL = 1e-6, 1e-9
# most dyads with two signs whose combinations are all tried: each doubles them
MOST_SIGNED = 7


@dataclass(frozen=True)
class AssemblyMode:
    """A branch of a circuit, between dead positions of the driver; the whole circuit if it has none."""

    circuit: int  # Number of the circuit, and of the branch on it, from 1
    branch: int
    is_stated: bool  # Whether the position that the description states is on it
    # Least and greatest coordinate of the driver [rad] or [m]; that of a crank that turns fully is a turn or more
    start: float
    end: float
    turns: int  # Turns of a crank that turns fully after which everything repeats; none where it turns back
    # Swing of links that do not turn fully [rad], stroke of sliding pieces [m], by name
    swings: Mapping[str, float]
    strokes: Mapping[str, float]


class AssemblyModes(NamedTuple):
    """The branches of all circuits, in their order, and whether these are all."""

    branches: tuple[AssemblyMode, ...]
    is_all: bool


def assembly_modes(machine: Machine) -> AssemblyModes:
    """Return every circuit and branch of a linkage of dyads; of any other those of the stated position.

    Examples
    --------
    >>> import crankwork
    >>> modes = assembly_modes(crankwork.read_machine(crankwork.template("four-bar")))
    >>> [(mode.circuit, mode.branch, mode.is_stated, mode.turns) for mode in modes.branches]
    [(1, 1, True, 1), (2, 1, False, 1)]
    """
    if machine.linkage is None:
        raise CrankworkError(ErrorMessage("circuits_of_linkage"))
    mechanism = replace(machine.mechanism, passages={})
    stated = _stated(mechanism)
    is_all = _is_countable(mechanism)
    circuits = all_circuits(mechanism) if is_all else [stated]
    configurations, _ = stated.curve.at(np.array([stated.curve.stated]))
    result: list[AssemblyMode] = []
    # the circuit of the stated position first
    order = sorted(circuits, key=lambda item: item.curve.nearest(configurations[0])[1] > _SAME)
    for number, circuit in enumerate(order, start=1):
        result += _branches(circuit, number, configurations[0] if number == 1 else None)
    return AssemblyModes(tuple(result), is_all)


def _is_countable(mechanism: Mechanism) -> bool:
    groups = mechanism.dyads
    signed = sum(isinstance(group, RRR | RRP | RPR) for group in groups)
    return signed <= MOST_SIGNED and not any(isinstance(group, Chain) for group in groups)


def _stated(mechanism: Mechanism) -> Circuit:
    if has_steady_crank(mechanism):
        return find_crank_range(mechanism).circuit
    law = mechanism.driver.law
    return circuit_at(mechanism, CrankGrid.from_radians([law.start if law else 0.0]))


def _branches(circuit: Circuit, number: int, stated: Array | None) -> Iterator[AssemblyMode]:
    """Yield the branches of a circuit, that of a stated position first."""
    driver = driver_coordinate(circuit.mechanism)
    parts = circuit.branches(driver)
    position = circuit.curve.nearest(stated)[0] if stated is not None else None
    if position is not None:
        parts = sorted(parts, key=lambda item: not _holds(circuit, item, position))
    link = circuit.mechanism.driver.link
    names = [item for item in circuit.curve.system.equations.index if item not in (link, rod_of(link))]
    is_turning = circuit.mechanism.driver.turns
    for count, part in enumerate(parts, start=1):
        is_stated = position is not None and _holds(circuit, part, position)
        start, end = sorted(map(float, circuit.values(driver, np.array(part))))
        if not math.isfinite(start + end):
            raise GeometryError(ErrorMessage("circuit_lost", links=circuit.curve.system.equations.names))
        turns = round((end - start) / math.tau) if is_turning and part == circuit.full_part else 0
        if turns:
            start, end = 0.0, math.tau * turns
        elif is_turning and not (is_stated and circuit.mechanism.driver.law):
            back = math.tau * round((start + end) / 2 / math.tau)
            start, end = start - back, end - back
        sliders = {name: value for name, value in circuit.sliders.items() if name in names}
        swings = {name: circuit.extent(link_angle(name), part).travel for name in names if name not in sliders}
        swings = {name: value for name, value in swings.items() if value < math.tau - _FULL}
        strokes = {name: circuit.extent(value, part).travel for name, value in sliders.items()}
        yield AssemblyMode(number, count, is_stated, start, end, turns, swings, strokes)


def _holds(circuit: Circuit, part: CircuitPart, position: float) -> bool:
    length = circuit.curve.length
    return any(part.start <= position + shift <= part.end for shift in (-length, 0.0, length))
