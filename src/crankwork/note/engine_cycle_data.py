"""What the working cycle starts from in the note of an engine: given, or taken as usual."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from crankwork.formula.expression import symbol
from crankwork.formula.lines import FormulaLine
from crankwork.locale import has_text
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.document import Cell, Math
from crankwork.note.engine_data import cycle_keys
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import value_row
from crankwork.note.legends import legend
from crankwork.note.printed_units import printed_unit
from crankwork.quantities import QUANTITIES, base_key
from crankwork.report.language import FILE_KEYS
from crankwork.units import UNITS

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
    """Yield what is given or chosen for the cycle, and what is put into its formulas that nothing else gives."""
    words, given, assumed = material.words, cycle_keys(material), _assumed(material)

    def marked(key: str, row: tuple[Cell, ...]) -> tuple[Cell, ...]:
        return (f"{row[0]} ({words.term('assumed')})", *row[1:]) if key in assumed else row

    for key in given:
        yield marked(key, value_row(key, material.summary[key], words))
    known = {*given, *material.summary, *material.results.columns, *_ELSEWHERE}
    known |= {base_key(one.key) for one in material.cycle}
    for step in steps:
        meanings = {one.symbol: one.text for one in legend(step, words.language, frozenset(known))}
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
    """Return the keys of what the calculation has taken as usual."""
    names = [str(one.values["names"]) for one in material.results.notices if one.code == "cycle_assumed"]
    keys = {FILE_KEYS.get(one, one) for some in names for one in some.split(", ")}
    return keys | {one for key in keys for one in _BROUGHT.get(key, ())}
