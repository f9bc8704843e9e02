"""The note of an engine: its sections in the order of the school; those of one cylinder, and the conclusion."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.polytropes import Polytropes, polytropes
from crankwork.analysis.solved import Notice
from crankwork.analysis.whole_engine import as_engine
from crankwork.errors import CrankworkError
from crankwork.formula.expression import symbol
from crankwork.formula.known import Pieces
from crankwork.formula.known import Table as TableOfValues
from crankwork.formula.lines import FormulaLine, Line, ValueLine
from crankwork.locale import has_text, say
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.comparison import comparison_blocks, main_numbers
from crankwork.note.document import Bibliography, Block, Cell, Citation, ItemList, Math, Note, Reference, Runs, Table
from crankwork.note.engine_data import GEAR, cycle_keys, data, method, preface
from crankwork.note.engine_material import Material
from crankwork.note.engine_shaft import balance, big_end, crankpin, evenness, mains, polar, total, unrolled, wear
from crankwork.note.engine_tables import angle_table, column_table, folded, long_table, value_row, value_table
from crankwork.note.legends import legend
from crankwork.note.options import NoteOptions
from crankwork.note.printed_units import printed_unit
from crankwork.note.sections import note_of_sections
from crankwork.note.words import EngineWords, in_display_unit
from crankwork.quantities import QUANTITIES, base_key
from crankwork.report.language import FILE_KEYS, display_key, displayed, key_unit, label
from crankwork.report.notices import notice_text
from crankwork.report.tables import any_nonzero
from crankwork.units import UNITS

_NOUNS = ("piston_displacement", "piston_velocity", "piston_acceleration")
_ROD = ("rod_angle", "rod_angular_velocity", "rod_angular_acceleration")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine", "rod_angle")
_ORDER_NAMES = ("first", "second")
_ALONG = ("gas_pressure", "gas_force", "piston_acceleration", "inertia_force", "weight_force", "piston_force")
_ACROSS = (
    "side_factor", "side_force", "rod_factor", "rod_force", "rod_transverse_force", "radial_factor", "radial_force",
    "tangential_factor", "tangential_force", "crank_torque",
)  # fmt: skip
_OF_PISTON = ("gas_force", "inertia_force", "piston_force")
_BEFORE_FORCES = (
    "rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine", "cylinder_volume", "diagram_pressure",
    "gas_pressure", "gas_force",
)  # fmt: skip
_INERTIA = (
    "piston_transfer_1", "piston_transfer_2", "piston_acceleration", "inertia_acceleration", "inertia_force",
    "rotating_inertia_force",
)  # fmt: skip
# decimals of the table of forces that Vietnamese notes print
_VIETNAMESE = {"gas_force": 5, "inertia_force": 6, "piston_force": 6}
_MAIN = (
    "mean_piston_speed", "piston_velocity_max", "piston_velocity_min", "piston_acceleration_max",
    "piston_acceleration_min", "gas_pressure_max", "inertia_force_max", "inertia_force_min", "piston_force_max",
    "piston_force_min", "side_force_max", "side_force_min", "tangential_force_max", "tangential_force_min",
    "rotating_inertia_force", "crank_torque_max", "crank_torque_min", "mean_torque", "indicated_work",
    "indicated_mean_pressure", "indicated_power", "effective_mean_pressure", "effective_power", "effective_torque",
    "effective_efficiency", "effective_fuel_consumption", "displacement", "total_torque_max",
    "total_torque_min", "excess_work", "flywheel_inertia", "speed_fluctuation", "mean_crankpin_load",
    "crankpin_load_max", "oil_hole_angle",
)  # fmt: skip
_OF_ENGINES = (
    "displacement", "mean_torque.1", "indicated_power.1", "total_torque_max", "total_torque_min", "cylinder_count",
)  # fmt: skip
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
        "motored_pressure", "wall_gas_speed", "heat_transfer_coefficient", "piston_displacement", "wall_area",
        "wall_heat_rate", "pressure_rise",
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
_MEASURED_STEP = 10.0
_DELIVERED = "eastop_mcconkey_1993, ch. 12"


def kinematics(material: Material) -> Iterator[Block]:
    """Yield the section about the motion: displacement, velocity and acceleration in one."""
    words = material.words
    yield words.heading("kinematics")
    yield from material.worked_at("motion")
    yield from material.equations("motion")
    yield words.heading("harmonics", 2)
    yield from material.intro("orders", material.equations("harmonics"))
    yield words.heading("extremes", 2)
    yield from material.intro("extremes", material.equations("extremes"))
    keys = [f"{noun}{order}" for noun in _NOUNS for order in ("_first_order", "_second_order", "")]
    yield words.paragraph("repeats")
    tables = [angle_table(material, "motion", keys, one_turn=True), angle_table(material, "rod", _ROD, one_turn=True)]
    yield from material.presented(tables, ("kinematics", "brix", "tolle"))
    yield from error_bound(material)


def displacement(material: Material) -> Iterator[Block]:
    """Yield the section about the displacement, by the construction of Brix."""
    words = material.words
    yield words.heading("brix")
    yield words.paragraph("brix")
    yield from material.worked_at("motion")
    yield from material.equations("motion", *_SWING, "piston_displacement")
    yield from material.equations("harmonics", "piston_displacement_first_order", "piston_displacement_second_order")
    yield words.paragraph("repeats")
    yield from material.presented([_table(material, "displacement")], ("brix",))


def velocity(material: Material) -> Iterator[Block]:
    """Yield the section about the velocity."""
    yield material.words.heading("velocity")
    yield from material.worked_at("motion")
    yield from material.equations("motion", "piston_transfer_1", "piston_velocity")
    kinds = ("piston_transfer_1", "piston_velocity")
    yield from material.equations("harmonics", *(f"{kind}_{order}_order" for kind in kinds for order in _ORDER_NAMES))
    yield from material.equations("motion", "rod_transfer_1", "rod_angular_velocity")
    most = material.equations("extremes", "piston_velocity_max_angle", "piston_velocity_max", "piston_velocity_min")
    yield from material.intro("extremes", most)
    yield from material.presented([_table(material, "velocity")], ("kinematics",))


def acceleration(material: Material) -> Iterator[Block]:
    """Yield the section about the acceleration over the displacement, by the construction of Tolle."""
    yield material.words.heading("acceleration")
    yield material.words.paragraph("tolle")
    yield from material.worked_at("motion")
    yield from material.equations("motion")
    yield from material.equations("harmonics")
    yield from material.intro("extremes", material.equations("extremes"))
    tables = [_table(material, "acceleration"), angle_table(material, "rod", _ROD, one_turn=True)]
    yield from material.presented(tables, ("tolle",))
    yield from error_bound(material)


def _table(material: Material, noun: str) -> Table | None:
    """Return the table of one of displacement, velocity, acceleration with its first two orders."""
    keys = [f"piston_{noun}_{order}_order" for order in _ORDER_NAMES]
    return angle_table(material, noun, [*keys, f"piston_{noun}"], one_turn=True)


def error_bound(material: Material) -> Iterator[Block]:
    """Yield how far the method is from exact; nothing if it is exact."""
    largest_errors = errors(material)
    if "piston_acceleration_error" in largest_errors:
        share = material.words.number(100 * largest_errors["piston_acceleration_error"][1], digits=2)
        yield material.words.paragraph("error", share=share, table=Reference("t:errors"))
    if "inertia_force_error" in largest_errors:
        share = material.words.number(100 * largest_errors["inertia_force_error"][1], digits=2)
        yield material.words.paragraph("force_error", share=share)


def errors(material: Material) -> dict[str, tuple[float, float]]:
    """Return the largest errors against exact [SI], and their shares of the largest value, by key."""
    largest_errors = {}
    for key in (name for name in material.summary if name.endswith("_error")):
        values = material.results.columns.get(key.removesuffix("_error"))
        if values is not None and np.any(values):
            largest_errors[key] = (material.summary[key], material.summary[key] / float(np.max(np.abs(values))))
    return largest_errors


def dynamics(material: Material) -> Iterator[Block]:
    """Yield the section about masses and forces; nothing if neither is known."""
    words = material.words
    if "masses" not in material.groups and "forces" not in material.groups:
        return
    yield words.heading("dynamics")
    yield words.heading("masses", 2)
    yield from masses(material)
    if "forces" not in material.groups:
        return
    yield words.heading("forces", 2)
    yield from material.worked_at("forces")
    yield from material.equations("forces")
    yield from material.equations("reduction")
    yield from per_area(material)
    method = material.results.method
    keys = any_nonzero(_ALONG, material.columns)
    if method.inertia_rod_ratio is not None and not method.is_exact:
        # the acceleration of the columns is not the one that the inertia force is made of
        keys.remove("piston_acceleration")
    yield from material.presented([angle_table(material, "along", keys)], ("piston_forces",))
    across = [key for key in _ACROSS if key != "rod_transverse_force" or any_nonzero((key,), material.columns)]
    yield from material.presented(
        [angle_table(material, "forces", across)], ("rod_forces", "crankpin_forces", "torque")
    )
    yield words.heading("extremes", 2)
    yield from material.intro("extremes", material.equations("force_extremes"))
    yield from material.equations("power", "mean_torque", "mean_driving_torque")


def masses(material: Material) -> Iterator[Block]:
    """Yield the masses of the crank gear."""
    given = material.machine.masses
    rigid = given is not None and bool(given.rod_inertia_excess) and material.results.method.rod == "rigid"
    yield from material.intro("masses_rigid" if rigid else "masses", material.equations("masses"))


def per_area(material: Material) -> Iterator[Block]:
    """Yield how forces are related to the piston area, where they are."""
    if material.per_area:
        words = material.words
        value = words.amount(material.summary["piston_area"], "cm2")
        yield words.paragraph("per_area", value=value, unit=words.unit("gas_pressure"))


def inertia(material: Material) -> Iterator[Block]:
    """Yield masses and inertia force as a section of its own; nothing if no masses are known."""
    words = material.words
    if "masses" not in material.groups:
        return
    yield words.heading("inertia")
    yield from masses(material)
    yield from material.worked_at("forces")
    yield from material.intro("inertia", material.equations("forces", *_INERTIA))
    most = material.equations("force_extremes", "inertia_force_max", "inertia_force_min")
    yield from material.intro("extremes", most)
    if "forces" in material.groups:
        yield words.paragraph("see_table", tables=Reference("t:along"))


def along(material: Material) -> Iterator[Block]:
    """Yield the forces along the cylinder axis with the table that Vietnamese notes print."""
    words = material.words
    if "forces" not in material.groups:
        return
    yield words.heading("along")
    yield from material.worked_at("forces")
    yield from material.equations("forces", *_BEFORE_FORCES, "weight_force", "piston_force")
    yield from per_area(material)
    yield from material.presented([_along_table(material)], ("piston_forces",))
    most = material.equations("force_extremes", "piston_force_max", "piston_force_min")
    yield from material.intro("extremes", most)


def _along_table(material: Material) -> Table | None:
    """Return the gas force, inertia force and their sum, to six decimals where they are per area."""
    if not material.per_area:
        return long_table(material, "along", _OF_PISTON)
    return long_table(material, "along", _OF_PISTON, decimals=_VIETNAMESE)


def across(material: Material) -> Iterator[Block]:
    """Yield the forces on wall, rod and crankpin as a section of its own."""
    if "forces" not in material.groups:
        return
    yield material.words.heading("forces")
    yield from material.worked_at("forces")
    yield from material.equations("forces")
    yield from material.equations("reduction")
    shown = [key for key in _ACROSS if key != "rod_transverse_force" or any_nonzero((key,), material.columns)]
    figures = ("rod_forces", "crankpin_forces", "torque")
    yield from material.presented([angle_table(material, "forces", shown)], figures)
    yield from material.intro("extremes", material.equations("force_extremes"))
    yield from material.equations("power", "mean_torque", "mean_driving_torque")


def checks(material: Material) -> Iterator[Block]:
    """Yield the identities that were checked, the errors of the method, and what the reader should know."""
    words, results = material.words, material.results
    largest_errors = errors(material)
    if not (results.checks or largest_errors or results.notices):
        return
    yield words.heading("checks")
    if results.checks:
        yield words.paragraph("checks", table=Reference("t:identities"))
        rows = [(_identity(key, words), words.number(100.0 * check, digits=2)) for key, check in results.checks.items()]
        yield words.table("identities", ("identity", "residual"), rows, "lr", "t:identities")
    if largest_errors:
        yield words.paragraph("errors", table=Reference("t:errors"))
        yield _errors(material, largest_errors)
    if results.notices:
        yield words.paragraph("notices")
        yield ItemList(tuple((_notice(notice, words),) for notice in results.notices))


def comparison(material: Material) -> Iterator[Block]:
    """Yield the values and curves by other methods, or of another machine, beside those of this one."""
    words = material.words
    heading = words.heading("comparison")
    # two machines have pistons of their own
    compared = material.results.compared
    per_area = material.per_area and compared is not None and compared.is_of_methods
    caption = words.caption("comparison")
    yield from comparison_blocks(material.results, words, heading, caption, per_area=per_area)
    yield from material.presented((), ("comparison",))


def _identity(key: str, words: EngineWords) -> Cell:
    """Return the identity that a check tests: in words, or symbols where it is an equation."""
    text = say(f"report.{key}", words.language)
    return Math(text) if "²" in text else text


def _notice(notice: Notice, words: EngineWords) -> str:
    """Return the sentence of a notice; keys of the machine file that it names become what they mean."""
    values = {
        name: ", ".join(map(words.meaning, value.split(", "))) if name in ("name", "names") else value
        for name, value in notice.values.items()
        if isinstance(value, str)
    }
    return notice_text(notice.code, {**notice.values, **values}, words.language)


def _errors(material: Material, largest_errors: dict[str, tuple[float, float]]) -> Table:
    """Return the errors of the method, each also as a share of the largest value."""
    words = material.words
    rows = [
        (
            label(key.removesuffix("_error"), words.language),
            words.number(displayed(key, error), digits=4),
            printed_unit(key_unit(key), words.language) or "–",
            words.number(100 * share, digits=2),
        )
        for key, (error, share) in largest_errors.items()
    ]
    return words.table("errors", ("quantity", "value", "unit", "relative"), rows, "lrcr", "t:errors")


def conclusion(material: Material) -> Iterator[Block]:
    """Yield the main results as a table."""
    words = material.words
    yield words.heading("results" if material.order == "en" else "conclusion")
    yield from main_numbers(material.results, words)
    yield words.paragraph("conclusion", table=Reference("t:summary"))
    yield value_table("summary", [_row(material, key) for key in _main_keys(material)], words)


def _main_keys(material: Material) -> list[str]:
    """Return the keys of the main results, in order; for one cylinder those of its own torque only."""
    # those of each method have a table of their own
    alone = ("excess_work", "flywheel_inertia")
    keys = [
        key
        for kind in _MAIN
        for key in material.summary
        if key == kind or (key.startswith(f"{kind}.") and kind not in alone)
    ]
    return [key for key in keys if material.has_engine or key not in _OF_ENGINES]


def _row(material: Material, key: str) -> tuple[Cell, ...]:
    """Return name, symbol, value and unit of a single value, and the crank angle where it is reached."""
    words, summary = material.words, material.summary
    area = summary["piston_area"] if material.per_area else None
    kind, dot, name = key.partition(".")
    angle = summary.get(f"{kind}_angle{dot}{name}") if kind.endswith(("_max", "_min")) else None
    row = value_row(display_key(key, material.results), summary[key], words, area=area)
    return (*row, "–" if angle is None else words.amount(angle, "deg", digits=4))


def sources(material: Material) -> Iterator[Block]:
    """Yield the bibliography."""
    yield material.words.heading("sources")
    yield Bibliography()


def appendix(material: Material) -> Iterator[Block]:
    """Yield the blocks of no section: journals, balance and flywheel in Vietnamese notes, further values, figures."""
    blocks: list[Block] = []
    if material.order == "vi":
        blocks += [*mains(material), *balance(material), *evenness(material)]
    rest = [*material.intro("further", material.remaining_lines()), *_further(material)]
    if rest:
        blocks += [material.words.heading("more", 2, numbered=False), *rest]
    if blocks:
        yield material.words.heading("appendix")
        yield from blocks


def _further(material: Material) -> Iterator[Block]:
    """Yield single values that are not among the main results, and figures that no section has."""
    words, summary = material.words, material.summary
    main = {*_main_keys(material), *(() if material.has_engine else _OF_ENGINES)}
    main |= {*GEAR, "bore", *(cycle_keys(material) if material.cycle else ())}
    left = [
        key
        for key in summary
        if key not in main
        and not material.is_shown(key)
        and not key.partition(".")[0].endswith(("_max_angle", "_min_angle", "_error"))
    ]
    if left:
        yield words.paragraph("more", table=Reference("t:more"))
        yield value_table("more", [_row(material, key) for key in left], words)
    yield from material.presented((), material.remaining_figures())


def cycle(material: Material) -> Iterator[Block]:
    """Yield the calculation of the working cycle, stage by stage; nothing if none was made."""
    words = material.words
    if not material.cycle:
        return
    steps = [line for line in material.groups["cycle"].lines if not isinstance(line, ValueLine)]
    yield words.heading("cycle")
    rows = list(cycle_data_rows(material, [step for step in steps if isinstance(step, FormulaLine)]))
    if rows:
        yield words.paragraph("cycle_data", table=Reference("t:cycle_data"))
        yield value_table("cycle_data", rows, words)
    yield words.paragraph("cycle")
    for stage, lines in _staged(steps).items():
        equations = material.worked(lines)
        if equations:
            yield words.heading(stage, 2)
        if equations and stage == "heat_release":
            yield words.paragraph("heat_release")
        yield from equations
    yield from material.presented([_heat_balance(material)])


def _staged(steps: Sequence[Line]) -> dict[str, list[Line]]:
    """Return steps by the stage that they belong to; a part of a quantity belongs where it is used."""
    stages = {key: stage for stage, keys in _STAGES.items() for key in keys}
    lines_of: dict[str, list[Line]] = {stage: [] for stage in _STAGES}
    current = "fuel"
    for step in steps:
        kind, dot, _ = step.key.partition(".")
        if not dot or kind == "heat_share" or step.key.endswith((".cycle", ".peak")):
            current = stages.get(kind, current)
        lines_of[current].append(step)
    return lines_of


def _heat_balance(material: Material) -> Table | None:
    words, summary = material.words, material.summary
    if "heat_share.rest" not in summary:
        return None
    parts = [(name, key) for name, key in _SHARES if f"heat_share.{name}" in summary and key in summary]
    columns: list[tuple[Runs, Sequence[str]]] = [
        ((words.column("row"),), [say(f"report.{name}", words.language) for name, _ in parts]),
        ((words.column("heat", "kW"),), words.column_texts([displayed(key, summary[key]) for _, key in parts])),
        ((words.column("share"),), words.column_texts([summary[f"heat_share.{name}"] * 100 for name, _ in parts])),
    ]
    return column_table("heat_balance", columns, words)


def indicator(material: Material) -> Iterator[Block]:
    """Yield volumes, tables and figures of the indicator diagram, and its work; nothing without gas."""
    words = material.words
    if material.results.solved.space is None:
        return
    yield words.heading("indicator")
    yield from _measured(material)
    yield from material.intro("volumes", material.equations("gas"))
    lines = polytropes(material.results)
    if lines is not None:
        yield words.paragraph("polytropes", polytrope=_exponents(lines, words), table=Reference("t:polytropes"))
        yield _polytrope_table(lines, words)
    gas = material.machine.gas
    if gas is not None and gas.is_absolute:
        yield words.paragraph("absolute")
    yield from material.presented([_points(material), _laws(material)], ("indicator", "pressure"))
    kinds = ("indicated_work", "indicated_mean_pressure", "indicated_power")
    yield from material.intro("work", material.equations("power", *kinds))
    yield from material.intro("delivery", material.equations("delivery"), source=Citation(_DELIVERED))
    if any(key.startswith("inlet_flow.") for key in material.summary):
        yield words.paragraph("delivery_of_all")


def _measured(material: Material) -> Iterator[Block]:
    """Yield where measured pressure comes from, with a coarse table of it; nothing if it was not measured."""
    words, gas = material.words, material.machine.gas
    if gas is None or gas.measured is None:
        return
    cycles = next((item.values["cycles"] for item in material.results.notices if item.code == "cycles_averaged"), 1)
    yield words.paragraph(
        "measured",
        file=gas.measured.file or "–",
        samples=words.number(len(gas.measured.degrees)),
        cycles=words.number(float(cycles)),
        table=Reference("t:measured"),
    )
    if gas.angle_shift:
        yield words.paragraph("shifted", shift=words.amount(math.radians(gas.angle_shift), "deg"))
    if gas.resample is not None:
        yield words.paragraph("resampled", step=words.amount(math.radians(gas.resample), "deg"))
    degrees = np.arange(0.0, gas.cycle + 1e-9, _MEASURED_STEP)
    pressures = material.results.columns_at(degrees, ("diagram_pressure",))["diagram_pressure"]
    columns: list[tuple[Runs, Sequence[str]]] = [
        (words.titled("crank_angle"), [words.number(float(angle)) for angle in degrees]),
        _shown("diagram_pressure", pressures.tolist(), words),
    ]
    yield folded(column_table("measured", columns, words))


def _exponents(lines: Polytropes, words: EngineWords) -> Runs:
    numbers = {name: words.number(exponent) for name, exponent in lines.exponents.items()}
    if len(numbers) == 1:
        ((name, value),) = numbers.items()
        return words.sentence("exponent", symbol=Math(words.symbol(f"{name}_exponent")), value=value)
    return words.sentence("exponents", **numbers)


def _polytrope_table(lines: Polytropes, words: EngineWords) -> Table:
    multiple = "/".join(map(words.symbol, ("cylinder_volume", "clearance_volume")))
    columns: list[tuple[Runs, Sequence[str]]] = [
        ((Math(multiple),), [words.number(multiple_value, digits=5) for multiple_value in lines.multiples]),
        _shown("cylinder_volume", lines.volumes.tolist(), words),
    ]
    for name, pressures in lines.pressures.items():
        shown = in_display_unit("diagram_pressure", pressures.tolist())
        heading = (f"{words.column(name)} ", *words.titled("diagram_pressure"))
        columns.append((heading, words.column_texts(shown)))
    return column_table("polytropes", columns, words)


def _points(material: Material) -> Table | None:
    """Return the named points of the diagram with angle, volume and pressure, in the order of the cycle."""
    words, results = material.words, material.results
    named = sorted(results.solved.space.diagram.named.items(), key=lambda item: item[1][0])
    if not named:
        return None
    degrees = np.array([angle for _, (angle, _) in named])
    volumes = results.columns_at(degrees, ("cylinder_volume",))["cylinder_volume"]
    columns: list[tuple[Runs, Sequence[Cell]]] = [
        ((words.column("point"),), [Math(name) if "_" in name else name for name, _ in named]),
        (words.titled("crank_angle"), [words.number(float(angle), digits=5) for angle in degrees]),
        _shown("cylinder_volume", volumes.tolist(), words),
        _shown("diagram_pressure", [pressure for _, (_, pressure) in named], words),
    ]
    gas = material.machine.gas
    if gas is not None and gas.is_absolute:
        columns.append(_shown("gas_pressure", [pressure - gas.ambient for _, (_, pressure) in named], words))
    return column_table("points", columns, words)


def _laws(material: Material) -> Table | None:
    """Return the law of the pressure on each stretch of the cycle, where it has several."""
    words, results = material.words, material.results
    known = results.memory.get("diagram_pressure")
    if known is None or not isinstance(known.node, Pieces):
        return None
    rows: list[tuple[Cell, ...]] = []
    start = 0.0
    for end in np.unique([*known.node.ends, results.machine.cycle]).tolist():
        moment = results.moment((start + end) / 2)
        law, step = moment.law(known).node, moment.step(known)
        if isinstance(step, FormulaLine):
            law_text: Cell = Math(step)
        elif isinstance(law, TableOfValues):
            law_text = say(f"memory.{law.word}", words.language)
        else:
            law_text = words.amount(step.value, "MPa")
        rows.append((words.number(start, digits=5), words.number(end, digits=5), law_text))
        start = end
    ends = ((words.column(name, "deg"),) for name in ("law_from", "law_to"))
    return words.table("laws", (*ends, (Math(words.symbol("diagram_pressure")),)), rows, "rrl", "t:laws")


def _shown(key: str, values: Sequence[float], words: EngineWords) -> tuple[Runs, Sequence[str]]:
    """Return a column of values in SI under its title."""
    return words.titled(key), words.column_texts(in_display_unit(key, values))


# what varies with the crank angle or stands among the data of the machine
_ELSEWHERE = (
    "crank_angle", "cylinder_pressure", "cylinder_temperature", "cylinder_volume", "piston_displacement",
    "diagram_pressure", "bore", "rotational_speed", "speed", "stroke",
)  # fmt: skip
# arguments that formulas of the cycle calculate under several names
_CALCULATED = ("Q_part", "mc_gas", "th_gas", "T_zero", "t_gas", "h_prod", "h_fresh", "p_1", "V_1", "V_phi")
# what a fuel, or the kind of an engine, brings along when it is taken as usual
_BROUGHT = {
    "fuel": ("fuel_carbon", "fuel_hydrogen", "fuel_oxygen", "fuel_molar_mass"),
    "mechanical_loss_pressure": ("mechanical_loss_constant", "mechanical_loss_slope"),
}


def cycle_data_rows(material: Material, steps: Sequence[FormulaLine]) -> Iterator[tuple[Cell, ...]]:
    """Yield the inputs of the cycle, given or assumed, and other arguments of its formulas that no formula gives."""
    words, given, assumed = material.words, cycle_keys(material), _assumed(material)

    def marked(key: str, row: tuple[Cell, ...]) -> tuple[Cell, ...]:
        return (f"{row[0]} ({words.term('assumed')})", *row[1:]) if key in assumed else row

    for key in given:
        yield marked(key, value_row(key, material.summary[key], words))
    known = {*given, *material.summary, *material.results.columns, *_ELSEWHERE}
    known |= {base_key(line.key) for line in material.cycle}
    for step in steps:
        meanings = {entry.symbol: entry.text for entry in legend(step, words.language, frozenset(known))}
        for name, value in step.values.items():
            if name not in ARGUMENTS:
                continue
            shown, key = symbol(name, words.language), _key(name)
            if shown not in meanings or key in known or name in _CALCULATED:
                continue
            known.add(key)
            stated = argument_unit(name)
            if key in QUANTITIES and stated in UNITS and UNITS[stated].factor == 1.0:
                yield marked(key, value_row(key, value, words))
                continue
            unit = printed_unit(stated, words.language)
            title = meanings[shown].removesuffix(f", {unit}") if unit else meanings[shown]
            yield marked(key, (title, Math(shown), words.number(value), unit or "–"))


def _key(name: str) -> str:
    entry = ARGUMENTS[name]
    return f"argument:{name}" if has_text(f"arguments.{name}") else entry.quantity


def _assumed(material: Material) -> set[str]:
    """Return the keys of default values that the calculation assumes."""
    names = [str(notice.values["names"]) for notice in material.results.notices if notice.code == "cycle_assumed"]
    keys = {FILE_KEYS.get(name, name) for names_of_notice in names for name in names_of_notice.split(", ")}
    return keys | {key_brought for key in keys for key_brought in _BROUGHT.get(key, ())}


Section = Callable[[Material], Iterator[Block]]
_SECTIONS: dict[str, Section] = {
    "preface": preface, "data": data, "method": method, "cycle": cycle, "indicator": indicator,
    "kinematics": kinematics, "displacement": displacement, "velocity": velocity, "acceleration": acceleration,
    "dynamics": dynamics, "inertia": inertia, "piston_forces": along, "crank_forces": across, "torque": total,
    "crankpin": crankpin, "polar": polar, "unrolled": unrolled, "big_end": big_end, "wear": wear, "mains": mains,
    "balance": balance, "evenness": evenness, "comparison": comparison, "checks": checks, "conclusion": conclusion,
    "sources": sources, "appendix": appendix,
}  # fmt: skip
_ORDERS: dict[str, tuple[str, ...]] = {
    "ru": (
        "preface", "data", "cycle", "indicator", "kinematics", "dynamics", "torque", "crankpin", "mains", "balance",
        "evenness", "comparison", "checks", "conclusion", "sources", "appendix",
    ),
    # between the data and the checks the twelve sections that such notes have
    "vi": (
        "preface", "data", "cycle", "indicator", "displacement", "velocity", "acceleration", "inertia",
        "piston_forces", "crank_forces", "torque", "polar", "unrolled", "big_end", "wear", "comparison", "checks",
        "conclusion", "sources", "appendix",
    ),
    # engineers who read English want the results before the way to them
    "en": (
        "data", "method", "conclusion", "cycle", "indicator", "kinematics", "dynamics", "torque", "crankpin", "mains",
        "balance", "evenness", "comparison", "checks", "sources", "appendix",
    ),
}  # fmt: skip


def engine_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of an engine, or of a crank gear of which less is known (kolchin_demidov_2008, ch. 4-9)."""
    if options.order not in _ORDERS:
        raise CrankworkError(f'no school of notes is called "{options.order}"; take en, ru or vi')
    material = Material(as_engine(results), options, has_engine=results.machine.engine is not None)
    words = material.words
    return note_of_sections(
        material,
        _SECTIONS,
        _ORDERS[options.order],
        words.title("crank_gear"),
        words.title("subtitle"),
        with_results=True,
    )
