"""What can be dragged in a drawing: dimensions, by the field of each, and dyads, which have two branches."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from crankwork.description.load_keys import LOADING
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR


class Handle(NamedTuple):
    """A dimension between two parts of the drawing; its field is proportional to the distance to the `power`."""

    key: str
    start: str
    end: str
    power: int = 1


def handles(values: Mapping[str, Any], groups: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Return the dimensions that a machine file states as numbers, with the numbers."""
    numbers = {row["key"]: row for group in groups for row in group["rows"] if "number" in row}
    listed = _of_linkage(values) if "links" in values or "sliders" in values else _of_crank_mechanism(values)
    return [
        {"key": handle.key, "from": handle.start, "to": handle.end, "power": handle.power,
         "number": numbers[handle.key]["number"], "unit": numbers[handle.key]["after"].strip()}
        for handle in listed
        if handle.key in numbers
    ]  # fmt: skip


def _of_crank_mechanism(values: Mapping[str, Any]) -> Iterator[Handle]:
    crank, rod, piston = (f"side.{part}.1" for part in ("crank", "rod", "piston"))
    if not LOADING.keys().isdisjoint(values):
        # drawn as a linkage
        number = "" if values.get("engine", {}).get("cylinders", 1) == 1 else "1"
        crank, rod, piston = "joint.O", f"joint.A{number}", f"joint.B{number}"
    yield Handle("crank.radius", crank, rod)
    yield Handle("crank.stroke", crank, rod)
    yield Handle("rod.length", rod, piston)
    definition = values.get("rod", {}).get("ratio_definition", "r/l")
    yield Handle("rod.ratio", rod, piston, -1 if definition == "r/l" else 1)


def _of_linkage(values: Mapping[str, Any]) -> Iterator[Handle]:
    crank = values.get("crank", {})
    if "pivot" in crank and "pin" in crank:
        yield Handle("crank.radius", f"joint.{crank['pivot']}", f"joint.{crank['pin']}")
    for name, link in values.get("links", {}).items():
        joins = link.get("joins", []) if isinstance(link, Mapping) else []
        if len(joins) > 1:
            yield Handle(f"links.{name}.length", f"joint.{joins[0]}", f"joint.{joins[1]}")


def dyads(machine: Machine) -> list[dict[str, Any]]:
    """Return the dyads with two branches: branch, parts, and where the branch changes.

    `at`: the joint where links come into line; `ends`: the joints at its ends; `others`: points that turn with a lever.
    """
    mechanism, drawn, listed = machine.mechanism, machine.drawn, list[dict[str, Any]]()
    if not {"rod.length", "rod.ratio"}.isdisjoint(machine.stated):
        # the file of an engine states no branches
        return []
    for index, dyad in enumerate(mechanism.dyads):
        parts: dict[str, Any]
        match dyad:
            case RRR():
                parts = {"kind": "RRR", "name": dyad.point, "ends": [dyad.joint_a, dyad.joint_b], "at": dyad.point,
                         "links": [dyad.link_a, dyad.link_b]}  # fmt: skip
            case RRP(guide_link=""):
                direction = [math.cos(dyad.guide_angle), -math.sin(dyad.guide_angle)]
                parts = {"kind": "RRP", "name": dyad.slider, "ends": [dyad.joint], "at": dyad.slider,
                         "links": [dyad.link], "way": direction}  # fmt: skip
            case RPR():
                turning = [name for name in drawn.member(dyad.link).points if name != dyad.pivot]
                parts = {"kind": "RPR", "name": dyad.link, "ends": [dyad.pivot], "at": dyad.joint, "links": [dyad.link],
                         "others": turning}  # fmt: skip
            case _:
                continue
        passage = mechanism.passages.get(index)
        changes = [] if passage is None else [float(angle) for angle in passage.changes]
        listed.append({**parts, "branch": dyad.branch, "changes": changes})
    return listed
