"""The gas in a note: the working cycle calculated, the indicator diagram, the chambers between sliding pieces."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from crankwork.analysis.constructions import Polytropes, polytropes
from crankwork.analysis.input_loads import stated_chambers
from crankwork.formula.calculation_lines import FormulaLine, Line, ValueLine
from crankwork.formula.expression import Formula, Operation, Symbol, evaluate, symbol, text
from crankwork.formula.traced_value import Piecewise
from crankwork.formula.traced_value import Tabulated as TableOfValues
from crankwork.locale import has_text, translate
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.captions import printed_unit
from crankwork.note.data import cycle_keys
from crankwork.note.document import Block, Cell, Citation, Equation, Math, Reference, Runs, Table
from crankwork.note.equations import value_box, value_symbol
from crankwork.note.layout import EQUALS, SPACE, PrintedEquation, Sign, row
from crankwork.note.legends import legend
from crankwork.note.material import Material
from crankwork.note.math import enough_digits, formula_box
from crankwork.note.parts import (
    At,
    Head,
    Lines,
    Listed,
    Places,
    Rows,
    Section,
    Shown,
    Text,
    When,
    full,
    in_full,
    machine_has,
    works,
)
from crankwork.note.symbols import symbol_box
from crankwork.note.tables import Column, column_table, folded, quantity_column, value_row, value_table
from crankwork.note.wording import Words, in_display_unit
from crankwork.preparation.prepared import Notice
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.display import FILE_KEYS, displayed
from crankwork.units import UNITS

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
_BURNT, _HEATS = ("combustion_celsius", "combustion_temperature"), "kolchin_demidov_2008, ch. 1"
_DELIVERED, _VOLUME = "eastop_mcconkey_1993, ch. 12", "kolchin_demidov_2008, ch. 5"
_API = "api_618, 6.6"
_CHARGE = "urieli_berchowitz_1984"
_SINGLE = (
    "swept_volume", "clearance_volume", "compression_ratio", "gas_pressure_max", "indicated_work",
    "indicated_mean_pressure", "indicated_power",
)  # fmt: skip


# heats of single gases and parts of the heat balance, which the full note has
_OF_CHEMISTRY = (
    "fresh_charge_heat", "product_", "molar_enthalpy", "heat_share", "gas_celsius",
)  # fmt: skip
# what varies with the crank angle or stands among the data of the machine
_ELSEWHERE = (
    "crank_angle", "cylinder_pressure", "cylinder_temperature", "cylinder_volume", "piston_displacement",
    "diagram_pressure", "bore", "rotational_speed", "speed", "stroke",
)  # fmt: skip
# values of an engine that burns at constant volume and uses its whole stroke
_NEUTRAL = {"cut_off": 1.0, "lost_stroke": 0.0}
# arguments that formulas of the cycle calculate under several names
_CALCULATED = ("Q_part", "mc_gas", "th_gas", "T_zero", "t_gas", "h_prod", "h_fresh", "p_1", "V_1", "V_phi")
# what a fuel, or the kind of an engine, brings along when it is taken as usual
_BROUGHT = {
    "fuel": ("fuel_carbon", "fuel_hydrogen", "fuel_oxygen", "fuel_molar_mass"),
    "mechanical_loss_pressure": ("mechanical_loss_constant", "mechanical_loss_slope"),
}


def _cycle(material: Material) -> Iterator[Block]:
    """Yield the calculation of the working cycle, stage by stage."""
    words = material.words
    steps = [line for line in material.groups["cycle"].lines if not isinstance(line, ValueLine)]
    formulas = [step for step in steps if isinstance(step, FormulaLine)]
    rows = list(_cycle_data(material, formulas))
    if rows:
        marked = any(str(row[0]).endswith("*") for row in rows)
        key = "cycle_data_assumed" if marked else "cycle_data"
        yield words.paragraph(key, table=Reference("t:cycle_data"))
        yield value_table("cycle_data", rows, words)
    if not material.full:
        yield from _worked_cycle(material, {step.key: step for step in formulas})
        left = [line.key for line in steps if line.key in material.summary and not material.is_shown(line.key)]
        # sizes that the diagram gives too are told with it
        left = [key for key in left if not key.startswith(_OF_CHEMISTRY) and material.of_cycle(key) == key]
        if left:
            further = [value_row(key, material.summary[key], words, digits=material.digits) for key in left]
            yield words.paragraph("cycle_results", table=Reference("t:cycle_results"))
            yield value_table("cycle_results", further, words)
        return
    yield words.paragraph("cycle")
    for stage, lines in _staged(steps).items():
        equations = material.worked(lines)
        if equations:
            yield words.heading(stage, 2)
        if equations and stage == "heat_release":
            yield words.paragraph("heat_release")
        yield from equations
    yield from material.presented([_heat_balance(material)])


def _worked_cycle(material: Material, steps: Mapping[str, FormulaLine]) -> Iterator[Block]:
    """Yield the main equations of the cycle: heats of the products as a table, burning as its balance of energy."""
    heats, burnt = _heats(material, steps), next((steps[key] for key in _BURNT if key in steps), None)
    given = cycle_keys(material)
    for block in material.equations("cycle"):
        key = block.step.key if isinstance(block, Equation) and not isinstance(block.step, Formula) else ""
        if key == "molar_change" and heats is not None:
            yield material.words.paragraph("heats", table=Reference("t:heats"), source=Citation(_HEATS))
            yield heats
        if burnt is not None and key == burnt.key:
            yield _balance_of_burning(material, burnt)
        elif key not in given and (heats is None or key not in ("product_heat_constant", "product_heat_slope")):
            yield block


def _heats(material: Material, steps: Mapping[str, FormulaLine]) -> Table | None:
    """Return amounts and heats of the gases of the products, None where the law of heats does not part them."""
    at_c, constant, slope = (steps.get(key) for key in ("product_heat", "product_heat_constant", "product_heat_slope"))
    if at_c is None or constant is None or slope is None or "M_prod" not in constant.values:
        return None
    words, language = material.words, material.words.language
    gases = [name for name in constant.values if name != "M_prod" and constant.values[name]]
    rows: list[tuple[Cell, ...]] = []
    amounts = words.column_texts([constant.values[gas] for gas in (*gases, "M_prod")], decimals=5)
    for gas, shown in zip([*gases, "M_prod"], amounts, strict=True):
        # each gas alone, and all of them
        share = {name: 1.0 if name in (gas, "M_prod") else 0.0 for name in constant.values} if gas in gases else {}
        own = [float(evaluate(step.expression, {**step.values, **share})) for step in (at_c, constant, slope)]
        warm, first, further = (words.number(value, digits=4) for value in own)
        rows.append((Math(symbol(gas, language)), shown, warm, f"{first} + {further} t"))
    heat, amount = printed_unit("kJ/(kmol*K)", language), printed_unit("kmol/kg", language)
    ranges = (f"{words.number(steps['compression_celsius'].value, digits=4)} °C", "1500…2800 °C")
    titles: list[Runs] = [(words.column("symbol"),), (Math("M"), f", {amount}")]
    titles += [(Math(words.symbol("product_heat")), f" ({place}), {heat}") for place in ranges]
    return words.table("heats", titles, rows, "crrl", "t:heats")


def _balance_of_burning(material: Material, step: FormulaLine) -> Equation:
    """Return the equation of burning, in letters and in numbers, with the temperature that satisfies it."""
    language, name = material.words.language, "t_z" if step.key == "combustion_celsius" else "T_z"
    constant, slope, change, temperature = map(Symbol, ("a_prod", "b_prod", "mu", name))
    heat = Operation(operator.add, (constant, Operation(operator.mul, (slope, temperature))))
    tree = Operation(operator.mul, (Operation(operator.mul, (change, heat)), temperature))
    names, digits = dict(step.named), enough_digits(step, material.digits)
    symbols = {key: value_symbol(named, language) for key, named in names.items()}
    sides = [
        row(formula_box(tree, values, language, digits=digits, symbols=symbols), EQUALS,
            formula_box(Symbol("E_z"), values, language, digits=digits))
        for values in (None, step.values)
    ]  # fmt: skip
    value = value_box(step.value, step.formula.unit or "K", language, material.digits)
    solution = row(symbol_box(symbol(name, language)), EQUALS, value)
    numbers = {key: material.words.number(put_in, digits=digits) for key, put_in in step.values.items()}
    lines = (sides[0], row(sides[1], Sign(";", "comma"), SPACE, solution))
    return Equation(step, digits=material.digits, printed=PrintedEquation(lines, text(tree, numbers, language)))


def _staged(steps: Sequence[Line]) -> dict[str, list[Line]]:
    """Return steps by the stage that they belong to; a part of a quantity belongs where it is used."""
    stages = {key: stage for stage, keys in _STAGES.items() for key in keys}
    lines_of: dict[str, list[Line]] = {stage: [] for stage in _STAGES}
    current = "fuel"
    for step in steps:
        kind, owner = key_of(step.key)
        if not owner or kind == "heat_share" or step.key.endswith((".cycle", ".peak")):
            current = stages.get(kind, current)
        lines_of[current].append(step)
    return lines_of


def _heat_balance(material: Material) -> Table | None:
    words, summary = material.words, material.summary
    if "heat_share.rest" not in summary:
        return None
    parts = [(name, key) for name, key in _SHARES if f"heat_share.{name}" in summary and key in summary]
    columns = [
        Column((words.column("row"),), [translate(f"report.{name}", words.language) for name, _ in parts]),
        Column((words.column("heat", "kW"),), words.column_texts([displayed(key, summary[key]) for _, key in parts])),
        Column(
            (words.column("share"),), words.column_texts([summary[f"heat_share.{name}"] * 100 for name, _ in parts])
        ),
    ]
    return column_table("heat_balance", columns, words)


def _measured(material: Material) -> Iterator[Block]:
    """Yield where measured pressure comes from, with a coarse table of it; nothing if it was not measured."""
    words, gas = material.words, material.machine.gas
    if gas is None or gas.measured is None:
        return
    cycles = next((item.values["cycles"] for item in material.results.notices if item.code == "cycles_averaged"), 1)
    yield words.paragraph(
        "measured" if gas.measured.file else "measured_given",
        file=gas.measured.file,
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
    columns = [
        Column(words.titled("crank_angle"), [words.number(float(angle)) for angle in degrees]),
        quantity_column(material, "diagram_pressure", pressures),
    ]
    yield folded(column_table("measured", columns, words))


def _exponents(lines: Polytropes, words: Words) -> Runs:
    numbers = {name: words.number(exponent) for name, exponent in lines.exponents.items()}
    if len(numbers) == 1:
        ((name, value),) = numbers.items()
        return words.sentence("exponent", symbol=Math(words.symbol(f"{name}_exponent")), value=value)
    return words.sentence("exponents", **numbers)


def _polytrope_table(lines: Polytropes, material: Material) -> Table:
    words = material.words
    multiple = "/".join(map(words.symbol, ("cylinder_volume", "clearance_volume")))
    columns = [
        Column((Math(multiple),), [words.number(multiple_value, digits=5) for multiple_value in lines.multiples]),
        quantity_column(material, "cylinder_volume", lines.volumes),
    ]
    for name, pressures in lines.pressures.items():
        column = quantity_column(material, "diagram_pressure", pressures)
        columns.append(column._replace(heading=(f"{words.column(name)} ", *column.heading)))
    return column_table("polytropes", columns, words)


def _points(material: Material) -> Table | None:
    """Return the named points of the diagram with angle, volume and pressure, in the order of the cycle."""
    words, results = material.words, material.results
    named = sorted(results.solved.space.diagram.named.items(), key=lambda item: item[1][0])
    if not named:
        return None
    degrees = np.array([angle for _, (angle, _) in named])
    pressures = np.array([pressure for _, (_, pressure) in named])
    volumes = results.columns_at(degrees, ("cylinder_volume",))["cylinder_volume"]
    columns = [
        Column((words.column("point"),), [Math(name) if "_" in name else name for name, _ in named]),
        Column(words.titled("crank_angle"), [words.number(float(angle), digits=5) for angle in degrees]),
        quantity_column(material, "cylinder_volume", volumes),
        quantity_column(material, "diagram_pressure", pressures),
    ]
    gas = material.machine.gas
    points = {} if gas is None else gas.points
    if listed := [points[name].inputs for name, _ in named if name in points and points[name].inputs]:
        shares = np.array([share.value for share, _ in listed])
        numbers = np.array([pressure.node.operands[0].value for _, pressure in listed])
        columns.insert(1, quantity_column(material, "travel_share", shares))
        columns.insert(4, quantity_column(material, "listed_pressure", numbers))
        if not material.full:
            # what is given, so narrow that its halves stand side by side
            return folded(column_table("points", columns[:3] + columns[4:], words))
    if gas is not None and gas.is_absolute:
        columns.append(quantity_column(material, "gas_pressure", pressures - gas.ambient))
    return column_table("points", columns, words)


def _laws(material: Material) -> Table | None:
    """Return the law of the pressure on each stretch of the cycle, where it has several."""
    words, results = material.words, material.results
    known = results.trace.get("diagram_pressure")
    if known is None or not isinstance(known.node, Piecewise):
        return None
    rows: list[tuple[Cell, ...]] = []
    start = 0.0
    for end in np.unique([*known.node.ends, results.machine.cycle]).tolist():
        moment = results.moment((start + end) / 2)
        law, step = moment.law(known).node, moment.step(known)
        if isinstance(step, FormulaLine):
            law_text: Cell = Math(step)
        elif isinstance(law, TableOfValues):
            law_text = translate(f"memory.{law.word}", words.language)
        else:
            law_text = words.amount(step.value, "MPa")
        rows.append((words.number(start, digits=5), words.number(end, digits=5), law_text))
        start = end
    ends = ((words.column(name, "deg"),) for name in ("law_from", "law_to"))
    return words.table("laws", (*ends, (Math(words.symbol("diagram_pressure")),)), rows, "rrl", "t:laws")


def _polytropes(material: Material) -> Iterator[Block]:
    """Yield the polytropes that compression and expansion follow; nothing where they follow none."""
    words, lines = material.words, polytropes(material.results)
    if lines is not None:
        yield words.paragraph("polytropes", polytrope=_exponents(lines, words), table=Reference("t:polytropes"))
        yield _polytrope_table(lines, material)


def _cycle_data(material: Material, steps: Sequence[FormulaLine]) -> Iterator[tuple[Cell, ...]]:
    """Yield the inputs of the cycle, given or assumed, and other arguments of its formulas that no formula gives."""
    words, given, assumed = material.words, cycle_keys(material), _assumed(material)

    def marked(key: str, row: tuple[Cell, ...]) -> tuple[Cell, ...]:
        return (f"{row[0]}*", *row[1:]) if key in assumed else row

    for key in given:
        if material.full or _NEUTRAL.get(key) != material.summary[key]:
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
    taken = (
        key for item in material.results.assumptions if item.code.startswith(("taken", "fuel")) for key in item.keys
    )
    names = {key.rpartition(".")[2].partition("[")[0] for key in taken}
    keys = {FILE_KEYS.get(name, name) for name in names}
    return keys | {key_brought for key in keys for key_brought in _BROUGHT.get(key, ())}


def _works(material: Material) -> Iterator[Block]:
    """Yield the table of the single values of every chamber."""
    words = material.words
    rows = [
        (number_of(chamber.name), *_values(chamber.name, material)) for chamber in stated_chambers(material.machine)
    ]
    titles = [words.titled(key, QUANTITIES[base_key(key)].unit) for key in _SINGLE]
    yield words.table("gas_work", ("chamber", *titles), rows, "l" + "r" * len(_SINGLE))


def _values(name: str, material: Material) -> Iterator[str]:
    """Yield the single values of a chamber; a dash for what it has not."""
    words, summary = material.words, material.results.summary
    for key in _SINGLE:
        value = summary.get(f"{key}.{name}", math.nan)
        yield words.number(in_display_unit(key.removesuffix("_max"), [value])[0], digits=material.digits)


def two_bases(material: Material) -> Notice | None:
    """Return the notice that diagram and heat calculation give different powers, where a note can say why."""
    known = {"indicated_mean_pressure.cycle", "filling_factor.diagram"} <= material.summary.keys()
    return next((item for item in material.results.notices if known and item.code == "torque_of_cycle"), None)


def _bases(material: Material) -> Iterator[Block]:
    """Yield why the diagram that is drawn and the heat calculation give different powers."""
    words, summary, difference = material.words, material.summary, two_bases(material)
    if difference is not None:
        drawn, calculated = (
            words.amount(summary[f"indicated_mean_pressure{suffix}"], "MPa", digits=4) for suffix in ("", ".cycle")
        )
        yield words.paragraph(
            "two_bases",
            drawn=drawn,
            calculated=calculated,
            power=words.amount(summary["indicated_power"], "kW", digits=4),
            percent=words.number(abs(float(difference.values["percent"])), digits=2),
            diagram=words.number(summary["filling_factor.diagram"], digits=3),
            assumed=words.number(summary["filling_factor"], digits=3),
        )


_OF_DELIVERY = Lines("delivery", intro="delivery", source=_DELIVERED)
SECTIONS = (
    Section("cycle", (Head("cycle"), _cycle), lambda material: bool(material.cycle)),
    Section("indicator", (
        Head("indicator"), _measured, Lines("gas", intro="volumes"), When(full, (_polytropes,)),
        When(lambda material: material.machine.gas is not None and material.machine.gas.is_absolute,
             (Text("absolute"),)),
        Shown(("indicator", "pressure"), (_points, in_full(_laws))),
        Lines("power", ("indicated_work", "indicated_mean_pressure", "indicated_power"), intro="work"),
        _bases, _OF_DELIVERY,
        When(lambda material: any(key.startswith("inlet_flow.") for key in material.summary), (
            Text("delivery_of_all"),
        )),
    ), lambda material: material.has_piston and material.results.solved.space is not None),
    Section("burning", (
        Head("heat_release"), Text("burning"), At("burning"), Lines("burning"),
        Shown(("log_indicator", "combustion", "recorded_cycles"), (Rows("fitted_polytropes", "fitted_polytropes"),)),
    ), works("burning")),
    Section("test", (
        Head("test"), Lines("test", intro="test", source="heywood_1988, ch. 2"), Shown(("willans",)),
    ), works("test")),
    Section("clutch", (
        Head("clutch"), Lines("clutch", intro="clutch", source="khurmi_gupta_2005, ch. 10"),
    ), works("clutch")),
    Section("chambers", (
        Head("chambers"), Text("chambers", {"source": Citation(_VOLUME)}),
        When(lambda material: any(charge.exponent is None for charge in material.machine.charges.values()), (
            Text("isothermal", {"source": Citation(_CHARGE)}),
        )),
        Lines("charges"), At("chambers"), Lines("chambers"),
        Places("gas", ("cylinder_volume", "gas_pressure", "gas_force", "rod_load"), "gas"),
        Shown(("chambers", "indicator")), Text("gas_work"), Lines("gas_work"), _works, _OF_DELIVERY,
        When(machine_has("crossheads"), (
            Text("rod_loads", {"source": Citation(_API)}), At("rod_loads"), Lines("rod_loads"),
            Places("rod_loads", ("piston_rod_load", "crosshead_load"), "rod_loads"), Shown(("rod_loads",)),
        )),
        When(machine_has("vessels"), (
            Text("vessels"), At("vessels"), Lines("vessels"),
            Places("flows", ("chamber_flow", "vessel_flow", "vessel_inflow"), "flows"), Shown(("pump_flow",)),
        )),
    ), machine_has("chambers")),
    Section("stages", (
        Head("stages"), Text("stages", {"source": Citation(_DELIVERED)}), Lines("stages"), Listed("stages", "stages"),
        Shown(("stage_indicator",)),
    ), machine_has("stages")),
)  # fmt: skip
