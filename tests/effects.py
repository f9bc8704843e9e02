"""Which values of a machine file change a result, found by changing each and computing again."""

from __future__ import annotations

import copy
import re
import tomllib
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.analysis.assumptions import _DISPLAY
from crankwork.description.machine_file import Setting, apply_override, entry_at, file_keys, read_machine
from crankwork.description.schema import (
    InertiaKind,
    ListOf,
    NameOr,
    NumberOr,
    OneForAll,
    OneOrMore,
    TableSpec,
    Values,
    WordOr,
)
from crankwork.description.value_types import Choice, Flag, Number, Quantity, Reader, split_deviation
from crankwork.errors import CrankworkError
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Arithmetic, FormulaCall, Input, Node, Sum, TracedValue, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.quantities import QUANTITIES, base_key
from crankwork.units import UNITS, parse
from expansions import written

# a change is more than this part of a value, and of the largest of its dimension
LIMIT, ROUNDING = 1e-9, 1e-13
# of columns of one cylinder a greater part, so that those of the engine have a change in any case
_SEEN = 1e-6
# the place of an extreme, and how little a value changes that has none
_EXTREME, _FLAT = re.compile("_(max|min)_angle"), 1e-9
# crank angles at which columns are computed again
_LOOKS = CrankGrid.from_degrees([17.0, 71.0, 139.0, 223.0, 311.0])
# tables of a file about all of its cylinders
_WHOLE = ("engine", "bearings", "balance", "flywheel", "motor", "motor_selection", "transient")
# notices that all there is to a key silences: engine.uneven
_PERMITTED = {"uneven_intervals"}
# what stands for a value of zero, in SI
_SCALES = {"length": 1e-3, "angle": 0.01, "mass": 0.01, "inertia": 1e-5, "pressure": 1e3, "force": 10.0, "torque": 1.0}


def stated_values(values: Mapping[str, Any]) -> Iterator[tuple[str, Any, object]]:
    """Yield path, value and kind of every value that a file states."""
    yield from _stated(values, file_keys(values), "")


def _stated(value: Any, kind: object, path: str) -> Iterator[tuple[str, Any, object]]:
    if isinstance(value, Mapping):
        for name, item in value.items():
            yield from _stated(item, entry_at(kind, name), f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        for number, item in enumerate(value, start=1):
            yield from _stated(item, entry_at(kind, number), f"{path}[{number}]")
    elif not _DISPLAY.fullmatch(path):
        yield path, value, kind


def default_values(values: Mapping[str, Any]) -> Iterator[tuple[str, Any, object]]:
    """Yield path, value and kind of every default that the file could state in the tables that it has."""
    keys = file_keys(values)
    present = {**values, "method": values.get("method", {})}
    if "rod" in values:
        present["cylinder"] = values.get("cylinder", {})
    if values.get("cycle", {}).get("kind") == "wiebe":
        present["cycle"] = {"timing": {}, **values["cycle"]}
    read = keys.read(present, "", Reader()) or Values({}, keys)
    yield from _defaults(present, read, keys, "")


def _defaults(value: Any, read: Any, kind: object, path: str) -> Iterator[tuple[str, Any, object]]:
    if isinstance(value, list) and isinstance(read, list):
        for number, (item, inner) in enumerate(zip(value, read, strict=True), start=1):
            yield from _defaults(item, inner, entry_at(kind, number), f"{path}[{number}]")
    if not isinstance(value, Mapping):
        return
    for name, item in value.items():
        yield from _defaults(item, read.get(name), entry_at(kind, name), f"{path}.{name}" if path else name)
    table = kind.other if isinstance(kind, NameOr) else kind
    if isinstance(table, TableSpec):
        for name in table.keys:
            full = f"{path}.{name}" if path else name
            default = None if name in value else table.written_default(name, read)
            if default is not None and not _DISPLAY.fullmatch(full):
                yield full, default, table.keys[name].kind


def alternatives(value: Any, kind: object) -> Iterator[Any]:
    """Yield other values in the place of one."""
    while isinstance(kind, NameOr | OneForAll | OneOrMore):
        kind = kind.other if isinstance(kind, NameOr) else kind.entry
    if isinstance(kind, InertiaKind):
        # of a multiple of m l^2 another one is meant by no file
        kind = kind.quantity if not isinstance(value, str) or "l^2" not in value else None
    elif isinstance(kind, NumberOr | WordOr):
        inner = [getattr(kind, name) for name in kind._fields if name in ("number", "quantity", "words")]
        kind = next((one for one in inner if isinstance(one, Quantity) == isinstance(value, str)), None)
    match kind:
        case Flag():
            yield not value
        case Choice():
            yield from (option for option in kind.options if option != value)
        case Number(whole=True):
            yield from (value + 1, value - 1)
        case Number():
            yield from (value * 1.01, value * 0.99, value * 2.0) if value else (0.01, -0.01)
        case Quantity() if isinstance(value, str):
            yield from _other_quantities(value, kind)
        case ListOf() if isinstance(value, list):
            others = [(number, other) for number, item in enumerate(value) for other in alternatives(item, kind.entry)]
            yield from ([*value[:number], other, *value[number + 1 :]] for number, other in others)


def _other_quantities(value: str, kind: Quantity) -> Iterator[str]:
    parsed = parse(split_deviation(value)[0], kind.dimensions, metric_hp=True, decimal_comma="," in value)
    unit = UNITS[parsed.unit]
    size = (parsed.value - unit.zero) / unit.factor
    step = _SCALES.get(parsed.dimension, 1.0) / unit.factor
    others = (size * 1.01, size * 0.99, size * 2.0) if parsed.value else (step, -step)
    yield from (f"{other!r} {parsed.unit}" for other in others)


def computed(values: Mapping[str, Any], folder: Path) -> Results:
    """Return the results of a file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return analyse(read_machine(written(values), folder=folder))


def has_changed(first: Results, second: Results) -> bool:
    """Return whether any summary value, column or entry of a table differs, or a notice that a key permits."""
    if _permitted(first) != _permitted(second):
        return True
    one, other = _values_of(first), _values_of(second)
    if any(np.any({**one, **other}[key]) for key in one.keys() ^ other.keys()):
        return True
    scales = _scales(first)
    for key in one.keys() & other.keys():
        value = one[key]
        if value.shape != other[key].shape:
            return True
        apart = np.abs(value - other[key])
        size = np.maximum(np.abs(value), np.abs(other[key]))
        limit = np.maximum(LIMIT * size, ROUNDING * scales.get(_unit(key), 0.0))
        if np.any(np.isnan(value) != np.isnan(other[key])) or np.any(apart > limit):
            return True
    return False


def _permitted(results: Results) -> set[str]:
    return {notice.code for notice in results.notices} & _PERMITTED


def _unit(key: str) -> str:
    quantity = QUANTITIES.get(base_key(key.rpartition("/")[2]))
    return quantity.si_unit if quantity is not None else ""


def _values_of(results: Results) -> dict[str, np.ndarray]:
    """Return all values, without the places of extremes of what stays the same."""
    flat = {key for key, value in results.columns.items() if np.ptp(value) <= _FLAT * np.max(np.abs(value))}
    places = {key: _EXTREME.sub("", key) for key in results.summary if _EXTREME.search(key)}
    values = {
        **results.columns,
        **{f"1/{key}": value for key, value in results.summary.items() if places.get(key) not in flat},
    }
    for name, table in results.listings.items():
        values |= {f"{name}/{key}": column for key, column in table.columns.items()}
        for key in (key for key in table.columns if _EXTREME.search(key)):
            high, low = (table.columns.get(_EXTREME.sub(end, key)) for end in ("_max", "_min"))
            if high is not None and low is not None:
                values[f"{name}/{key}"] = np.where(high - low <= _FLAT * np.abs(high), 0.0, table.columns[key])
    return {key: np.atleast_1d(np.asarray(value, dtype=float)) for key, value in values.items()}


def _scales(results: Results) -> dict[str, float]:
    scales: dict[str, float] = {}
    for key, value in _values_of(results).items():
        finite = np.abs(value[np.isfinite(value)])
        if finite.size:
            scales[_unit(key)] = max(scales.get(_unit(key), 0.0), float(finite.max()))
    return scales


class OneCylinder(NamedTuple):
    """Results of one cylinder of an engine, which take a small part of the time, and the columns that both have."""

    results: Results
    columns: Sequence[str]


def one_cylinder(values: Mapping[str, Any], base: Results, folder: Path) -> OneCylinder | None:
    """Return one cylinder of an engine; None of other machines."""
    if "engine" not in values:
        return None
    try:
        results = computed(_without_engine(values), folder)
    except CrankworkError:
        return None
    columns = [key for key, column in results.columns.items() if np.array_equal(column, base.columns.get(key))]
    return OneCylinder(results, columns)


def _without_engine(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: table for name, table in values.items() if name not in _WHOLE}


def _moves(cylinder: OneCylinder, changed: Mapping[str, Any], folder: Path) -> bool:
    """Return whether columns of one cylinder change by more than what an engine has of rounding."""
    try:
        columns = computed(_without_engine(changed), folder).columns
    except CrankworkError:
        return False
    for key in cylinder.columns:
        before, after = cylinder.results.columns[key], columns.get(key, np.zeros(1))
        if len(after) not in (1, len(before)) or np.any(np.abs(after - before) > _SEEN * np.max(np.abs(before))):
            return True
    return False


def has_effect(
    values: dict[str, Any], path: str, others: Iterable[Any], base: Results, folder: Path, cylinder: OneCylinder | None
) -> bool | None:
    """Return whether one of other values in a place changes a result; None if no other is possible.

    `cylinder`: results of one cylinder, which are looked at first.
    """
    computed_any = False
    for other in others:
        changed = copy.deepcopy(values)
        try:
            apply_override(changed, Setting("--set", path, other))
            if cylinder is not None and path.partition(".")[0] not in _WHOLE and _moves(cylinder, changed, folder):
                # the engine may not take this value
                read_machine(written(changed), folder=folder)
                return True
            results = computed(changed, folder)
        except CrankworkError:
            continue
        if has_changed(base, results):
            return True
        computed_any = True
    return False if computed_any else None


def measured(text: str, folder: Path) -> tuple[Results, dict[str, bool], dict[str, bool]]:
    """Return the results of a file, and whether each stated value and each default has an effect."""
    values = tomllib.loads(text)
    base = computed(values, folder)
    idle, assumed = told(base)
    cylinder = one_cylinder(values, base, folder)
    found = []
    for items, is_idle in (
        ([*stated_values(values)], idle.__contains__),
        ([*default_values(values)], lambda path: path not in assumed),
    ):
        effects = without_effect(values, [item for item in items if is_idle(item[0])], base, folder)
        effects |= {path: True for path, *_ in items if not is_idle(path) and moves_columns(base, path)}
        for path, value, kind in items:
            if path not in effects:
                effects[path] = has_effect(values, path, alternatives(value, kind), base, folder, cylinder)
        found.append({path: effect for path, effect in effects.items() if effect is not None})
    return base, found[0], found[1]


def moves_columns(results: Results, path: str) -> bool:
    """Return whether columns change as their formulas are computed again with an input greater by a hundredth.

    Extremes, means and tables stay as they are, so that False says nothing.
    """
    columns = {key: results.trace[key] for key in results.columns if key in results.trace}
    order = [known.node for known in in_order(columns.values())]
    kept = {id(node): (node, node.value) for node in order if isinstance(node, Input) and node.path == path}
    if not any(value for _, value in kept.values()):
        return False
    before = Program(columns)(_LOOKS)
    try:
        for node, value in [*kept.values()]:
            node.value = value * 1.01
        for node in order:
            if node.value is not None and any(id(operand.node) in kept for operand in node.operands):
                number = _again(node)
                if number is not None:
                    kept[id(node)] = node, node.value
                    node.value = number
        after = Program(columns)(_LOOKS)
    finally:
        for node, value in kept.values():
            node.value = value
    limits = {key: 1e-6 * np.max(np.abs(column), initial=0.0) for key, column in before.items()}
    return any(np.any(np.abs(after[key] - column) > limits[key]) for key, column in before.items())


def _again(node: Node) -> float | None:
    """Return the value of a formula with the present values of its operands."""
    if isinstance(node, Sum):
        return sum(operand.value for operand in node.operands)
    function = getattr(getattr(node, "formula", node), "function", None)
    if not isinstance(node, Arithmetic | FormulaCall) or function is None:
        return None
    return float(function(*(item.value if isinstance(item, TracedValue) else item for item in node.inputs)))


def without_effect(
    values: dict[str, Any], items: Sequence[tuple[str, Any, object]], base: Results, folder: Path
) -> dict[str, bool | None]:
    """Return False for values that change no result where all of them are changed at once; empty if something does."""
    others = {path: [*alternatives(value, kind)] for path, value, kind in items}
    for number in range(max(map(len, others.values()), default=0)):
        changed = copy.deepcopy(values)
        try:
            for path, listed in others.items():
                if number < len(listed):
                    apply_override(changed, Setting("--set", path, listed[number]))
            if has_changed(base, computed(changed, folder)):
                return {}
        except CrankworkError:
            return {}
    return {path: False if listed else None for path, listed in others.items()}


# changes of these keys are no test of what is told, by pattern and reason
EXCEPTIONS = {
    r"method\.pi": "a constant of mathematics, changed only to follow a book",
    r"method\.kinematics": "the summary names the method",
    r"(positions|branch)\..*": "they choose a circuit; others near by choose the same",
    r"chambers\..*\.delay": "that of a calculated cycle chooses a dead centre; others near by choose the same",
    r"transient\.(stops.*|restitution)|friction\.sliders\..*\.length|.*\.vapour_pressure": "limits not reached",
    r"rotor\.kind": "it permits other keys",
    r"torsion\.(discs|shafts|throw_shaft).*\.(damping|loss_factor)": "the first one makes damped modes",
    r"cycle\.kind": "the other kinds need other keys, and assigned ones differ by the corners that a school rounds",
    r"engine\.layout": "of few cylinders two layouts are one engine",
    r"efficiency\.decimals": "more decimals than a product has",
    r"motor\.(frequency|pole_pairs|overload|ratio|rated_.*)": "of a motor that stalls another speed may make it turn",
    r".*\.pieces\[\d+\]\.law": "between points of equal pressure all laws are one line",
    r".*\.points\..*\.pressure": "that of the last point must agree with the first",
}


def told(results: Results) -> tuple[set[str], set[str]]:
    """Return the inputs that results call without effect, and the defaults that they call assumptions."""
    assumed = {key for item in results.assumptions for key in item.keys if item.code in ("default", "no_weights")}
    # the notice says what to write
    assumed |= {"engine.uneven"} if _permitted(results) else set()
    return {item.key for item in results.without_effect}, assumed


def mistold(text: str, folder: Path) -> list[str]:
    """Return the keys of a file whose effect is another than results tell."""
    base, stated, defaults = measured(text, folder)
    idle, assumed = told(base)
    wrong = {key for key, effect in stated.items() if effect == (key in idle)}
    wrong |= {key for key, effect in defaults.items() if effect != (key in assumed)}
    return sorted(key for key in wrong if not any(re.fullmatch(pattern, key) for pattern in EXCEPTIONS))
