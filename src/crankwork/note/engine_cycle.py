"""Working cycle and indicator diagram in the note of an engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import cast

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.loads.gas import cylinder_volume, polytropic_pressure
from crankwork.loads.indicator import IndicatorDiagram, Segment
from crankwork.loads.measured import measured_diagram
from crankwork.note.document import Block, Math, Reference, Runs, Table
from crankwork.note.engine_cycle_data import cycle_data_rows
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import column_table, folded, value_table
from crankwork.report.language import displayed, word
from crankwork.steps import Step

# stage of the calculation: what it gives
_STAGES: dict[str, tuple[str, ...]] = {
    "fuel": (
        "fuel_heating_value", "air_mass_needed", "air_amount_needed", "fresh_charge_amount", "product_co",
        "product_h2", "product_co2", "product_h2o", "product_o2", "product_n2", "product_amount", "molar_change_ideal",
        "heat_lost_incomplete",
    ),
    "intake": (
        "compressor_temperature", "charge_temperature", "charge_pressure", "charge_density", "intake_pressure_loss",
        "intake_pressure", "residual_fraction", "intake_temperature", "volumetric_efficiency",
    ),
    "compression": (
        "compression_pressure", "compression_temperature", "compression_celsius", "fresh_charge_heat", "product_heat",
        "mixture_heat",
    ),
    "combustion": (
        "molar_change", "working_mixture_heat", "product_heat_constant", "product_heat_slope",
        "product_heat_constant_pressure", "combustion_energy", "combustion_celsius", "combustion_temperature",
        "combustion_pressure", "combustion_pressure_real", "pressure_rise_ratio", "cut_off",
    ),
    "expansion": (
        "afterexpansion", "expansion_pressure", "expansion_temperature", "residual_temperature_found",
        "residual_temperature_deviation",
    ),
    "heat_release": (
        "gas_mass", "burning_progress", "burnt_fraction", "burning_rate", "cylinder_temperature", "gas_heat_ratio",
        "motored_pressure", "wall_gas_speed", "heat_transfer_coefficient", "wall_area", "wall_heat_rate",
        "pressure_rise",
    ),
    "indicated": (
        "theoretical_mean_pressure", "indicated_mean_pressure", "indicated_efficiency", "indicated_fuel_consumption",
    ),
    "effective": (
        "mechanical_loss_pressure", "effective_mean_pressure", "mechanical_efficiency", "effective_efficiency",
        "effective_fuel_consumption", "effective_power", "effective_torque", "fuel_rate", "power_per_litre",
    ),
    "size": (
        "bore", "stroke", "crank_radius", "piston_area", "swept_volume", "displacement", "mean_piston_speed",
        "clearance_volume",
    ),
    "heat_balance": (
        "heat_supplied", "heat_to_coolant", "heat_to_exhaust", "heat_unburnt", "heat_rest", "heat_share",
        "molar_enthalpy",
    ),
}  # fmt: skip
_SHARES = (
    ("effective", "effective_power"), ("to_coolant", "heat_to_coolant"), ("to_exhaust", "heat_to_exhaust"),
    ("unburnt", "heat_unburnt"), ("rest", "heat_rest"),
)  # fmt: skip
_HALF = 360.0
_ROWS = 12
_MEASURED_STEP = 10.0


def cycle(material: Material) -> Iterator[Block]:
    """Yield the calculation of the working cycle, stage by stage; nothing if none was made.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    words = material.words
    steps = [one for one in material.groups["cycle"].steps if isinstance(one, Step)] if material.results.steps else []
    if not steps:
        return
    numbered = material.order != "vi"
    yield words.heading("cycle", numbered=numbered)
    rows = list(cycle_data_rows(material, steps))
    if rows:
        yield words.paragraph("cycle_data", table=Reference("t:cycle_data"))
        yield value_table("cycle_data", rows, words)
    yield words.paragraph("cycle")
    for stage, some in _staged(steps).items():
        equations = material.worked(some)
        if equations:
            yield words.heading(stage, 2, numbered=numbered)
        if equations and stage == "heat_release":
            yield words.paragraph("heat_release")
        yield from equations
    yield from material.presented([_heat_balance(material)])


def _staged(steps: Sequence[Step]) -> dict[str, list[Step]]:
    """Return steps by the stage they belong to; a part of a quantity belongs where it was needed."""
    stages = {key: stage for stage, keys in _STAGES.items() for key in keys}
    found: dict[str, list[Step]] = {stage: [] for stage in _STAGES}
    current = "fuel"
    for one in steps:
        kind, dot, _ = one.key.partition(".")
        if not dot or kind == "heat_share" or one.key.endswith(".cycle"):
            current = stages.get(kind, current)
        found[current].append(one)
    return found


def _heat_balance(material: Material) -> Table | None:
    words, summary = material.words, material.summary
    if "heat_share.rest" not in summary:
        return None
    parts = [(name, key) for name, key in _SHARES if f"heat_share.{name}" in summary and key in summary]
    columns: list[tuple[Runs, Sequence[str]]] = [
        ((words.column("row"),), [word(name, words.language) for name, _ in parts]),
        ((words.column("heat", "kW"),), words.column_texts([displayed(key, summary[key]) for _, key in parts])),
        ((words.column("share"),), words.column_texts([summary[f"heat_share.{name}"] * 100 for name, _ in parts])),
    ]
    return column_table("heat_balance", columns, words)


def indicator(material: Material) -> Iterator[Block]:
    """Yield volumes, tables and figures of the indicator diagram, and its work; nothing without gas.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    words = material.words
    if material.results.solved.space is None:
        return
    yield words.heading("indicator")
    yield from _measured(material)
    yield from material.intro("volumes", material.equations("gas"))
    polytropes = _polytrope_table(material)
    if polytropes is not None:
        yield words.paragraph("polytropes", polytrope=_exponents(material), table=Reference("t:polytropes"))
        yield polytropes
    yield from material.presented([_points(material)], ("indicator", "pressure"))
    kinds = ("indicated_work", "indicated_mean_pressure", "indicated_power")
    yield from material.intro("work", material.equations("power", *kinds))


def _measured(material: Material) -> Iterator[Block]:
    """Yield where measured pressure comes from, with a coarse table of it; nothing if it was not measured."""
    words, solved = material.words, material.results.solved
    gas = material.machine.gas
    if gas is None or gas.measured is None:
        return
    _, cycles, _ = measured_diagram(gas.measured, gas.cycle, shift=gas.angle_shift, step=gas.resample)
    yield words.paragraph(
        "measured",
        file=gas.measured.file or "–",
        samples=words.number(len(gas.measured.degrees)),
        cycles=words.number(cycles),
        table=Reference("t:measured"),
    )
    if gas.angle_shift:
        yield words.paragraph("shifted", shift=words.amount(math.radians(gas.angle_shift), "deg"))
    if gas.resample is not None:
        yield words.paragraph("resampled", step=words.amount(math.radians(gas.resample), "deg"))
    degrees = np.arange(0.0, gas.cycle + 1e-9, _MEASURED_STEP)
    moved = solved.motion(CrankGrid.from_degrees(degrees)).piston.position
    volumes = np.asarray(cylinder_volume(solved.space.clearance, solved.space.area, moved))
    pressures = solved.space.diagram.pressure(degrees, volumes)
    columns: list[tuple[Runs, Sequence[str]]] = [
        (words.titled("crank_angle"), [words.number(float(one)) for one in degrees]),
        (words.titled("diagram_pressure"), words.column_texts((pressures / 1e6).tolist())),
    ]
    yield folded(column_table("measured", columns, words))


def _exponents(material: Material) -> Runs:
    words = material.words
    numbers = {name: words.number(one.state[2]) for name, one in _polytropes(material).items()}
    if len(numbers) == 1:
        return words.sentence("exponent", value=next(iter(numbers.values())))
    return words.sentence("exponents", **numbers)


def _polytropes(material: Material) -> dict[str, Segment]:
    """Return the polytropes of compression and expansion; the first of each half of the cycle."""
    half = min(material.machine.cycle / 2, _HALF)
    found: dict[str, Segment] = {}
    for one in _diagram(material).segments:
        if one.law == "polytropic":
            is_compression = one.start < half if material.machine.cycle > _HALF else one.start >= half
            found.setdefault("compression" if is_compression else "expansion", one)
    return {name: found[name] for name in ("compression", "expansion") if name in found}


def _polytrope_table(material: Material) -> Table | None:
    words, space, found = material.words, material.results.solved.space, _polytropes(material)
    if not found:
        return None
    spans = {name: _span(material, one) for name, one in found.items()}
    ratio = 1 + space.swept / space.clearance
    step = max(1.0, math.ceil(ratio / _ROWS))
    multiples = np.array([*np.arange(1.0, ratio - 1e-9, step), ratio])
    ends = [end / space.clearance for span in spans.values() for end in span]
    # an end beside a whole multiple is that multiple
    ends = [one for one in ends if not np.any(np.isclose(one, multiples, rtol=1e-6))]
    volumes = np.unique(np.round([*multiples, *ends], 9)) * space.clearance
    within = {name: _is_within(volumes, *span) for name, span in spans.items()}
    kept = np.logical_or.reduce(list(within.values()))
    volumes = volumes[kept]
    columns: list[tuple[Runs, Sequence[str]]] = [
        ((Math("i"),), [words.number(one, digits=5) for one in volumes / space.clearance]),
        (words.titled("cylinder_volume"), words.column_texts((volumes * 1e6).tolist())),
    ]
    for name, segment in found.items():
        pressure, reference, exponent = segment.state
        values = np.asarray(polytropic_pressure(pressure, reference, volumes, exponent)) / 1e6
        values = np.where(within[name][kept], values, np.nan)
        columns.append(((words.column(name, "MPa"),), words.column_texts(values.tolist())))
    return column_table("polytropes", columns, words)


def _span(material: Material, segment: Segment) -> tuple[float, float]:
    """Return the least and the largest volume of a polytrope, with that of the state it passes through. [m3]"""
    solved = material.results.solved
    same = [one for one in _diagram(material).segments if one.law == "polytropic" and one.state == segment.state]
    degrees = np.array([angle for one in same for angle in (one.start, one.end)])
    moved = solved.motion(CrankGrid.from_degrees(degrees)).piston.position
    volumes = np.asarray(cylinder_volume(solved.space.clearance, solved.space.area, moved))
    reference = segment.state[1]
    return min(float(volumes.min()), reference), max(float(volumes.max()), reference)


def _is_within(volumes: Array, least: float, largest: float) -> Array:
    """Return which volumes a polytrope has, its ends included."""
    return np.asarray((volumes >= least * (1 - 1e-6)) & (volumes <= largest * (1 + 1e-6)))


def _diagram(material: Material) -> IndicatorDiagram:
    """Return the diagram whose polytropes are constructed: of a calculated cycle before its corners were rounded."""
    space = material.results.solved.space
    return cast("IndicatorDiagram", space.theoretical or space.diagram)


def _points(material: Material) -> Table | None:
    """Return the named points of the diagram with angle, volume and pressure, in the order of the cycle."""
    words, solved = material.words, material.results.solved
    named = sorted(solved.space.diagram.named.items(), key=lambda one: one[1][0])
    if not named:
        return None
    degrees = np.array([angle for _, (angle, _) in named])
    moved = solved.motion(CrankGrid.from_degrees(degrees)).piston.position
    volumes = np.asarray(cylinder_volume(solved.space.clearance, solved.space.area, moved))
    columns: list[tuple[Runs, Sequence[str]]] = [
        ((words.column("point"),), [name for name, _ in named]),
        (words.titled("crank_angle"), [words.number(float(one), digits=5) for one in degrees]),
        (words.titled("cylinder_volume"), words.column_texts((volumes * 1e6).tolist())),
        (words.titled("diagram_pressure"), words.column_texts([pressure / 1e6 for _, (_, pressure) in named])),
    ]
    return column_table("points", columns, words)
