"""What is dragged of a drawing: dimensions by the field that states each, and dyads, which go on in two ways."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR


class Handle(NamedTuple):
    """A dimension between two parts of the drawing; `power`: of the distance, by which the number of the field goes."""

    key: str
    start: str
    end: str
    power: int = 1


def handles(values: Mapping[str, Any], groups: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Return the dimensions that a machine file states by a number, with that number."""
    numbers = {row["key"]: row for group in groups for row in group["rows"] if "number" in row}
    listed = _of_linkage(values) if "links" in values or "sliders" in values else _of_crank_gear(values)
    return [
        {"key": one.key, "from": one.start, "to": one.end, "power": one.power,
         "number": numbers[one.key]["number"], "unit": numbers[one.key]["after"].strip()}
        for one in listed
        if one.key in numbers
    ]  # fmt: skip


def _of_crank_gear(values: Mapping[str, Any]) -> Iterator[Handle]:
    crank, rod, piston = (f"side.{one}.1" for one in ("crank", "rod", "piston"))
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
    """Return the dyads that go together in two ways: their branch, their parts, where they change it.

    `at`: the joint at which links come into line; `ends`: what it hangs on; `others`: what turns with a lever.
    """
    mechanism, drawn, found = machine.mechanism, machine.drawn, list[dict[str, Any]]()
    for index, one in enumerate(mechanism.dyads):
        parts: dict[str, Any]
        match one:
            case RRR():
                parts = {"kind": "RRR", "name": one.point, "ends": [one.joint_a, one.joint_b], "at": one.point,
                         "links": [one.link_a, one.link_b]}  # fmt: skip
            case RRP(guide_link=""):
                parts = {"kind": "RRP", "name": one.slider, "ends": [one.joint], "at": one.slider, "links": [one.link],
                         "way": [math.cos(one.guide_angle), -math.sin(one.guide_angle)]}  # fmt: skip
            case RPR():
                others = [name for name in drawn.member(one.link).points if name != one.pivot]
                parts = {"kind": "RPR", "name": one.link, "ends": [one.pivot], "at": one.joint, "links": [one.link],
                         "others": others}  # fmt: skip
            case _:
                continue
        passage = mechanism.passages.get(index)
        changes = [] if passage is None else [float(at) for at in passage.changes]
        found.append({**parts, "branch": one.branch, "changes": changes})
    return found
