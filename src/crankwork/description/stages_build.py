"""From the values of a machine file to the stages of a compressor, alone or with the chambers of a linkage."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from crankwork.description.build import crank_speed, exact_method, machine_alone, read_drive
from crankwork.description.schema import Values, stated_numbers
from crankwork.description.value_types import MeasuredValue, Reader
from crankwork.loads.indicator import DiagramError
from crankwork.loads.stages import Stages
from crankwork.loads.valves import Valves
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.method import Method
from crankwork.preparation.stages import stage_states, stage_values
from crankwork.quantities.key import key_of

_DELIVERIES = ("flow", "free_flow", "mass_flow")
_SHAPES = ("stroke", "stroke_bore_ratio", "piston_speed")
# lists with an entry for each stage, and for each cooler
_BY_STAGE, _BY_COOLER = (
    ("exponent", "expansion_exponent", "clearance", "volumetric_efficiency"),
    ("between", "losses", "temperatures"),
)


def build_compressor(values: Values, reader: Reader) -> Machine | None:
    """Return the machine of stages without a mechanism, or None after complaints."""
    method, table = exact_method(values, reader), values["stages"]
    drive, has_speed = read_drive(values, reader), "crank" in values
    if reader.problems or table is None:
        return None
    _check_sizes(table, reader, has_speed=has_speed)
    if "shaft_power" in table and drive.chain is not None:
        reader.add_error("stages.shaft_power", ErrorMessage("same", others=["efficiency"]))
    speed = crank_speed(values["crank"]["speed"], method) if has_speed else 1.0
    stages = Stages(_numbers(table), has_speed=has_speed)
    machine = machine_alone(values, method, speed, stages=stages, drive=drive)
    _check(stages, machine, table, reader)
    if reader.problems:
        return None
    for key, share in stage_values(machine, stages).items():
        if key.startswith("clearance_volumetric_efficiency.") and not 0 < share.value <= 1:
            reader.add_error("stages", ErrorMessage("stages_filled", number=key_of(key).owner, share=share.value))
    return None if reader.problems else machine


def _check_sizes(table: Values, reader: Reader, *, has_speed: bool) -> None:
    """Report a delivery and sizes that are not enough, or too many."""
    has_flow, has_shape = any(name in table for name in _DELIVERIES), any(name in table for name in _SHAPES)
    if not has_flow and not ("bore" in table and has_shape):
        reader.add_error("stages", ErrorMessage("stages_size"))
    if not has_speed and ("bore" in table or has_shape):
        reader.add_error("crank.speed", ErrorMessage("missing", advice=('speed = "300 rpm"',)))
    for name in ("clearance", "volumetric_efficiency"):
        if has_flow and "bore" in table and name in table:
            reader.add_error(f"stages.{name}", ErrorMessage("stages_twice"))


def stage_valves(values: Values, method: Method, reader: Reader) -> tuple[Stages | None, Mapping[str, Valves]]:
    """Return the stages of chambers, and the valves that each of these has of its stage, by name; report mistakes."""
    if reader.problems or "stages" not in values:
        return None, {}
    table, known = values["stages"], values["chambers"]
    named = [(name, f"stages.chambers[{i}][{j}]") for i, names in enumerate(table["chambers"], start=1)
             for j, name in enumerate(names, start=1)]  # fmt: skip
    for name, place in named:
        if name not in known:
            reader.add_error(place, ErrorMessage("absent_chamber", name=name, known=", ".join(known) or "–"))
        elif [item for item, _ in named].count(name) > 1:
            reader.add_error(place, ErrorMessage("chamber_staged_twice", name=name))
    numbers = {**_numbers(table), "count": (float(len(table["chambers"])),)}
    stages = Stages(numbers, tuple(map(tuple, table["chambers"])))
    crank = Mechanism(Crank(radius=0.0), ())
    machine = Machine(crank, speed=1.0, stages=stages, method=method, stated=stated_numbers(values))
    _check(stages, machine, table, reader)
    if reader.problems:
        return None, {}
    valves = dict[str, Valves]()
    for names, state in zip(stages.chambers, stage_states(machine, stages), strict=True):
        linked = {"compression_exponent" if name == "exponent" else name: value for name, value in state.items()}
        fields: dict[str, Any] = {name: value.value for name, value in linked.items()}
        valves |= dict.fromkeys(names, Valves(**fields, linked=linked))
    return stages, valves


def _numbers(table: Values) -> dict[str, tuple[float, ...]]:
    """Return the numbers of a table by key, defaults too."""
    numbers = dict[str, tuple[float, ...]]()
    for name in table.table.keys:
        value = table[name]
        entries = value if isinstance(value, list) else [value]
        if name != "chambers" and entries and None not in entries:
            numbers[name] = tuple(item.value if isinstance(item, MeasuredValue) else float(item) for item in entries)
    return numbers


def _check(stages: Stages, machine: Machine, table: Values, reader: Reader) -> None:
    """Report lists of a wrong length, and pressures that do not rise from stage to stage."""
    if reader.problems:
        return
    try:
        states = len(stage_states(machine, stages))
    except DiagramError as error:
        reader.add_error(error.key, error.args[0])
        return
    for names, wanted in ((_BY_STAGE, states), (_BY_COOLER, states - 1)):
        for name in names:
            count = (
                len(table[name])
                if isinstance(table[name], list)
                else 1
                if name == "between" and name in table
                else wanted
            )
            if count != wanted:
                reader.add_error(f"stages.{name}", ErrorMessage("entries", count=count, wanted=wanted))
    exponents = {value for name in _BY_STAGE[:2] for value in stages.numbers.get(name, ())}
    if 1.0 in exponents and len(exponents) > 1:
        reader.add_error("stages.exponent", ErrorMessage("stages_isothermal"))
    if len(set(stages.numbers.get("exponent", ()))) > 1 and "between" not in table:
        reader.add_error("stages.exponent", ErrorMessage("stages_best"))
