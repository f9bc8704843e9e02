"""What rubs in a linkage, from the values of a machine file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from crankwork.description.kinds import Reader
from crankwork.description.schema import Values
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import Circle, Friction, GuideFriction, PinFriction
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import Point
from crankwork.mechanism.joints import Pin, names_of_pivots
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Crank, Mechanism


def build_friction(values: Values, linkage: Linkage, mechanism: Mechanism, reader: Reader) -> tuple[Friction, ...]:
    """Return the friction of pins and guides; complain of joints that are not there."""
    table = values.get("friction")
    if table is None:
        return ()
    held, shown = all_links_and_joints(mechanism)[1], names_of_pivots(mechanism)
    pins = {shown.get(one.name, one.name): one.name for one in held if isinstance(one, Pin)}
    guides = {one.name: one.name for one in held if not isinstance(one, Pin)}
    circle: Circle = table["circle"] or "tangent"
    rubbing_pins = tuple(
        PinFriction(joint, one.si("radius") or 0.0, one["coefficient"], one.si("moment"), one.si("damping"), circle)
        for joint, one in _known(table["pins"], pins, "pins", reader)
    )
    sliding = tuple(
        _guide(name, one, _middle(name, linkage, mechanism))
        for name, one in _known(table["sliders"], guides, "sliders", reader)
    )
    return (*rubbing_pins, *sliding)


def _guide(name: str, one: Values, middle: Point) -> GuideFriction:
    length, force, damping = (one.si(key) or 0.0 for key in ("length", "force", "damping"))
    return GuideFriction(name, one["coefficient"], length, force, damping, middle)


def _middle(name: str, linkage: Linkage, mechanism: Mechanism) -> Point:
    """Return where the origin of a sliding piece, which is on its guide, lies from the pin that it is solved at."""
    member = next((one for one in linkage.members if one.name == name), None)
    chained = (link.name for group in mechanism.dyads if isinstance(group, Chain) for link in group.links)
    if member is None or not member.points or name in chained:
        return 0.0, 0.0
    further = {one.name: (one.along, one.across) for one in mechanism.points if one.link == name}
    point = next(iter(further), next(iter(member.points)))
    (x, y), (u, v) = further.get(point, (0.0, 0.0)), member.points[point]
    return x - u, y - v


def _known(
    tables: Mapping[str, Values | None], known: Mapping[str, str], kind: str, reader: Reader
) -> Iterator[tuple[str, Values]]:
    """Yield the joints that are there with their tables, and complain of the others."""
    for name, one in tables.items():
        if name not in known:
            told = Refusal(f"absent_rubbing_{kind}", name=name, known=", ".join(known) or "–")
            reader.complain(f"friction.{kind}.{name}", told)
        elif one is not None:
            yield known[name], one


def check_friction(machine: Machine, reader: Reader) -> None:
    """Complain of friction where forces are told that do not know of it."""
    if not machine.friction:
        return
    crank = machine.mechanism.driver
    if machine.redundant:
        reader.complain("friction", Refusal("friction_redundant", name=machine.redundant[0].member.name))
    if machine.mechanism.passages:
        reader.complain("friction", Refusal("friction_passages"))
    if isinstance(crank, Crank) and any(one.pressure_angle for one in crank.geared):
        reader.complain("friction", Refusal("friction_teeth"))
