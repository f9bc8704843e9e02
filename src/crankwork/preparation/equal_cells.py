"""The cells of a linkage that are equal: same lengths, masses, loads and gas, later and turned about the crank."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from crankwork.formula.traced_value import TracedValue, delayed
from crankwork.loads.chamber import Chamber
from crankwork.loads.load import Weight
from crankwork.machine import Machine
from crankwork.mechanism.equal_parts import EqualPart, equal_parts
from crankwork.mechanism.joints import joints
from crankwork.mechanism.mechanism import Mechanism
from crankwork.preparation.cell_gas import nearly_equal
from crankwork.quantities.key import key_of

_TURN = 360.0
# columns that do not depend on where a part points to
_WITHOUT_DIRECTION = frozenset({
    "slider_displacement", "slider_velocity", "slider_acceleration", "coriolis_acceleration", "link_angular_velocity",
    "link_angular_acceleration", "point_velocity", "point_acceleration", "joint_force", "normal_force",
    "normal_moment", "transmission_angle", "pressure_angle", "transmission_cosine", "pressure_sine",
})  # fmt: skip
# of angles that are worked out of positions [deg]
_SAME_ANGLE = 1e-9


def equal_cells(machine: Machine) -> tuple[EqualPart, ...]:
    """Return the cells of a linkage that are equal to an earlier one; none where something else joins them."""
    is_partial = machine.working_range is not None or (machine.way is not None and not machine.way.is_whole)
    has_other_loads = any(not isinstance(load, Weight) for load in machine.loads)
    if is_partial or has_other_loads or machine.friction or machine.redundant or machine.charges:
        return ()
    parts = (_with_chambers(machine, part) for part in equal_parts(machine.mechanism))
    # weights do not turn with a cell
    return tuple(part for part in parts if part is not None and not (machine.loads and part.turn))


def with_equal_columns(
    columns: Mapping[str, TracedValue], mechanism: Mechanism, parts: Sequence[EqualPart]
) -> dict[str, TracedValue]:
    """Return columns, in equal parts those of the earlier ones at their own crank angle where no direction matters."""
    result, held = dict(columns), joints(mechanism)
    for part in parts:
        owners = {own: name for name, own in part.names.items() if own != name}
        owners |= {joint.name: part.joint_of_first(joint, held).name for joint in held if joint.link in part.links}
        for key in columns:
            kind, owner = key_of(key)
            first = f"{kind}.{owners.get(owner, '')}"
            if kind in _WITHOUT_DIRECTION and first in columns and columns[key].varies:
                result[key] = delayed(columns[first], part.delay, part.cycle, key)
    return result


def _with_chambers(machine: Machine, part: EqualPart) -> EqualPart | None:
    """Return an equal part with its chambers and its delay within the cycle, None if the gas of both differs."""
    first, own = (_chambers_on(machine, links) for links in (part.first, part.links))
    if first is None or own is None or len(first) != len(own):
        return None
    names = dict[str, str]()
    delays = {part.delay + turns * _TURN for turns in range(round(machine.cycle / _TURN))}
    for (name, chamber), (own_name, other) in zip(first.items(), own.items(), strict=True):
        faces = tuple(replace(face, slider=part.names[face.slider]) for face in chamber.faces)
        expected = replace(chamber, faces=faces, delay=other.delay)
        if expected != other and not nearly_equal(expected, other):
            return None
        names[name] = own_name
        delays = {delay for delay in delays if _is_later(chamber, other, delay)}
    return None if not delays else replace(part, chambers=names, delay=min(delays), cycle=machine.cycle)


def _chambers_on(machine: Machine, links: frozenset[str]) -> Mapping[str, Chamber] | None:
    """Return the chambers at the pieces of a part, None if one is shared, measured or has pipes."""
    result = {}
    for name, chamber in machine.chambers.items():
        pieces = {face.slider for face in chamber.faces}
        if not pieces & links:
            continue
        has_pipes = chamber.valves is not None and chamber.valves.has_pipes
        if not pieces <= links or chamber.measured is not None or has_pipes:
            return None
        result[name] = chamber
    return result


def _is_later(first: Chamber, other: Chamber, delay: float) -> bool:
    """Return whether the gas in a chamber is that of the first chamber, delayed by an angle. [deg]"""
    if first.pressure is not None:
        return True
    # a release of heat or valves begin at a dead centre, of which there is one in a turn
    if (first.valves is not None or first.calculated is not None) and first.cycle == _TURN:
        return True
    return abs(math.remainder(other.delay - first.delay - delay, first.cycle)) <= _SAME_ANGLE
