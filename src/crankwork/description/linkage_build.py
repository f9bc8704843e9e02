"""From the values of a machine file to the linkage it describes, or to the tabulated motion of one."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from crankwork.description.build import build_method
from crankwork.description.schema import Measure, Reader
from crankwork.dynamics.efficiency import Chain, Parallel, Series, efficiency
from crankwork.dynamics.tabulated import TabulatedBody
from crankwork.errors import MethodError
from crankwork.loads.load import Load
from crankwork.loads.process import ForceOnPoint, ProcessForce, TorqueOnLink
from crankwork.loads.spring import SliderSpring, Spring
from crankwork.loads.table import Table as LoadTable
from crankwork.loads.weight import Weight
from crankwork.machine import Drive, LinkageMachine, TabulatedMachine, Transient
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.description import linkage_from
from crankwork.mechanism.linkage import Linkage
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor

_GEOMETRY = ("fixed_points", "crank", "links", "guides", "sliders", "branch", "positions")
_ELSEWHERE = ("speed", "angular_acceleration", "inertia")
# what each kind of load needs, and what it may have besides
_LOAD_KEYS = {
    "process": (("slider", "force"), ("at", "against", "curve", "stroke", "start", "acts")),
    "force": (("point",), ("x", "y", "link")),
    "torque": (("link", "torque"), ("at", "curve")),
    "spring": (("stiffness",), ("between", "slider", "free_length", "preload")),
}


def build_linkage(values: Mapping[str, Any], reader: Reader) -> LinkageMachine | None:
    """Return the linkage machine, or None after complaints.

    Parameters
    ----------
    values : mapping
        What `linkage_keys.LINKAGE_FILE` has read.
    reader : Reader
        Collects the complaints.
    """
    if reader.problems:
        return None
    tables = {name: _plain(values[name]) for name in _GEOMETRY if name in values}
    tables["crank"] = {name: one for name, one in tables["crank"].items() if name not in _ELSEWHERE}
    linkage, problems = linkage_from(tables)
    mechanism = None
    if linkage is not None:
        mechanism, problems = mechanism_of(linkage)
    for problem in problems:
        reader.complain(problem.key or "links", problem.message)
    method = build_method(values.get("method", {}), reader)
    if not method.is_exact:
        reader.complain("method.kinematics", "a linkage is computed exactly; write exact or leave it out")
    loads = _loads(values, linkage, reader)
    drive = _drive(values, reader)
    transient = _transient(values, loads, reader)
    if reader.problems or mechanism is None or linkage is None:
        return None
    if values.get("method", {}).get("weights"):
        loads = (*loads, Weight(method.gravity))
    crank, table = values["crank"], values.get("table", {})
    return LinkageMachine(
        mechanism=mechanism,
        linkage=linkage,
        speed=crank["speed"].value,
        angular_acceleration=_value(crank, "angular_acceleration"),
        title=values.get("title", ""),
        loads=loads,
        drive=replace(drive, inertia=drive.inertia + _value(crank, "inertia")),
        transient=transient,
        method=method,
        table_step=round(math.degrees(_value(table, "step", math.radians(10.0))), 9),
        table_special=tuple(round(math.degrees(one.value), 9) for one in table.get("special_angles", []) if one),
    )


def build_tabulated(values: Mapping[str, Any], reader: Reader) -> TabulatedMachine | None:
    """Return the machine of a table of transfer functions, or None after complaints.

    Parameters
    ----------
    values : mapping
        What `linkage_keys.TRANSFER_FILE` has read.
    reader : Reader
        Collects the complaints.
    """
    method = build_method(values.get("method", {}), reader)
    drive = _drive(values, reader)
    if reader.problems:
        return None
    transfer = values["transfer"]
    angles = _plain(transfer["angles"])
    count = len(angles)
    if any(after <= before for before, after in itertools.pairwise(angles)):
        reader.complain("transfer.angles", "must rise from position to position, within one revolution")
    bodies = []
    for name, body in transfer["bodies"].items():
        columns = {key: tuple(_plain(body[key])) for key in ("velocity", "rotation") if key in body}
        for key, column in columns.items():
            _check_count(f"transfer.bodies.{name}.{key}", column, count, reader)
        if not columns:
            reader.complain(f"transfer.bodies.{name}", "needs velocity or rotation, a number for each position")
        still = (0.0,) * count
        bodies.append(TabulatedBody(
            name, _value(body, "mass"), _value(body, "inertia"),
            columns.get("velocity", still), columns.get("rotation", still),
        ))  # fmt: skip
    optional: dict[str, tuple[float, ...] | None] = {}
    for key in ("reduced_inertia_1", "static_torque", "balancing_torque"):
        column = tuple(_plain(transfer[key])) if key in transfer else None
        if column is not None:
            _check_count(f"transfer.{key}", column, count, reader)
        optional[key] = column
    if reader.problems:
        return None
    return TabulatedMachine(
        speed=values["crank"]["speed"].value,
        angles=tuple(angles),
        bodies=tuple(bodies),
        title=values.get("title", ""),
        differences=transfer.get("differences", "central"),
        drive=drive,
        method=method,
        reduced_inertia_1=optional["reduced_inertia_1"],
        static_torque=optional["static_torque"],
        balancing_torque=optional["balancing_torque"],
    )


def _check_count(key: str, column: tuple[float, ...], count: int, reader: Reader) -> None:
    if len(column) != count:
        reader.complain(key, f"has {len(column)} values for {count} positions; give one for each of transfer.angles")


def _drive(values: Mapping[str, Any], reader: Reader) -> Drive:
    """Return efficiency, motor and flywheel."""
    drive = Drive(fluctuation=values.get("flywheel", {}).get("fluctuation"))
    if values.get("efficiency", {}).get("chain"):
        table = values["efficiency"]
        parts: list[Chain] = [Parallel(tuple(one)) if isinstance(one, list) else one for one in table["chain"]]
        whole = efficiency(Series(tuple(parts)))
        drive = replace(drive, efficiency=whole)
        if "decimals" in table:
            drive = replace(drive, efficiency=round(whole, int(table["decimals"])), exact_efficiency=whole)
    motor = values.get("motor")
    if motor and {"rated_power", "rated_speed", "overload", "pole_pairs"} <= set(motor):
        frequency = _value(motor, "frequency", 2 * math.pi * 50) / (2 * math.pi)
        try:
            own = AsynchronousMotor.of_catalogue(
                motor["rated_power"].value, motor["rated_speed"].value, motor["overload"],
                frequency=frequency, pole_pairs=int(motor["pole_pairs"]),
            )  # fmt: skip
        except MethodError as error:
            reader.complain("motor.rated_speed", str(error))
        else:
            geared = GearedMotor(own, motor.get("ratio", 1.0), _value(motor, "inertia"), drive.efficiency)
            drive = replace(drive, motor=geared, rated_power=motor["rated_power"].value)
    return drive


def _transient(values: Mapping[str, Any], loads: tuple[Load, ...], reader: Reader) -> Transient | None:
    table = values.get("transient")
    if table is None:
        return None
    if values.get("method", {}).get("weights") or not all(isinstance(one, Spring) and not one.preload for one in loads):
        reader.complain(
            "transient", "takes springs between points, without preload, as its only loads; remove the others"
        )
    return Transient(table["torque"].value, table["time"].value, _value(table, "speed"))


def _loads(values: Mapping[str, Any], linkage: Linkage | None, reader: Reader) -> tuple[Load, ...]:
    made = []
    for number, one in enumerate(values.get("loads", []), start=1):
        if one and "kind" in one and _check_load(f"loads[{number}]", one, linkage, reader):
            try:
                made.append(_load(one))
            except ValueError as error:
                reader.complain(f"loads[{number}]", str(error))
    return tuple(made)


def _check_load(key: str, load: Mapping[str, Any], linkage: Linkage | None, reader: Reader) -> bool:
    """Complain of keys that this kind of load lacks or does not know, and of names that stand for nothing."""
    needed, allowed = _LOAD_KEYS[load["kind"]]
    for name in needed:
        if name not in load:
            reader.complain(f"{key}.{name}", f"is missing; a {load['kind']} load needs it")
    for name in set(load) - {"kind", *needed, *allowed}:
        reader.complain(f"{key}.{name}", f"means nothing for this kind; it takes {', '.join(needed + allowed)}")
    if load["kind"] == "spring" and ("between" in load) == ("slider" in load):
        reader.complain(f"{key}.between", "a spring joins two points or holds a slider; give between or slider")
    if linkage is not None:
        names = {"slider": {one.name for one in linkage.members if one.guide},
                 "link": {one.name for one in linkage.members} | {linkage.crank.link},
                 "point": set(linkage.owners())}  # fmt: skip
        for name, known in names.items():
            if name in load and load[name] not in known:
                reader.complain(
                    f"{key}.{name}", f'there is no {name} "{load[name]}"; there is {", ".join(sorted(known))}'
                )
        for point in load.get("between", []):
            if point not in names["point"]:
                reader.complain(f"{key}.between", f'there is no point "{point}"')
    return not any(problem.key.startswith(key) for problem in reader.problems)


def _load(load: Mapping[str, Any]) -> Load:
    match load["kind"]:
        case "process":
            return ProcessForce(
                load["slider"], _curve(load, "force"), load.get("against", "stroke"),
                -1 if load.get("stroke") == "falling" else 1, _value(load, "start"), load.get("acts", "forward"),
            )  # fmt: skip
        case "force":
            return ForceOnPoint(load["point"], _value(load, "x"), _value(load, "y"), load.get("link", ""))
        case "torque":
            return TorqueOnLink(load["link"], _curve(load, "torque"))
        case _ if "slider" in load:
            return SliderSpring(
                load["slider"], load["stiffness"].value, _value(load, "free_length"), _value(load, "preload")
            )
    start, end = load["between"]
    return Spring(start, end, load["stiffness"].value, _value(load, "free_length"), _value(load, "preload"))


def _curve(load: Mapping[str, Any], key: str) -> LoadTable:
    """Return the table of a load; a single value holds everywhere."""
    values = tuple(_plain(load[key]))
    smooth = load.get("curve") == "smooth"
    if "at" not in load:
        if len(values) != 1:
            raise ValueError(f"{len(values)} values need as many in at = [...]; a single one holds everywhere")
        return LoadTable((-1e3, 1e3), (values[0], values[0]))
    at = tuple(_plain(load["at"]))
    period = 2 * math.pi if load.get("against") == "angle" or load["kind"] == "torque" else 0.0
    return LoadTable(at, values, "monotone" if smooth else "linear", period)


def _value(table: Mapping[str, Any], key: str, default: float = 0.0) -> float:
    measure = table.get(key)
    return default if measure is None else float(measure.value)


def _plain(value: Any) -> Any:  # noqa: ANN401 - tables, lists and quantities, as the file has them
    """Return values with every quantity as its SI number."""
    match value:
        case Measure():
            return value.value
        case dict():
            return {name: _plain(one) for name, one in value.items()}
        case list():
            return [_plain(one) for one in value]
    return value
