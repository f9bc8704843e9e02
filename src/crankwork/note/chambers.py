"""The gas in the chambers of a linkage: what is given, volumes, pressures and forces, work and power."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.analysis.stated import StatedChamber, stated_chambers, stated_charges
from crankwork.locale import say
from crankwork.note.document import Block, Citation
from crankwork.note.linkage_material import Material
from crankwork.note.words import Words, in_display_unit, named
from crankwork.quantities import QUANTITIES, base_key

_VOLUME, _CHARGE = "kolchin_demidov_2008, ch. 5", "urieli_berchowitz_1984"
_DELIVERED = "eastop_mcconkey_1993, ch. 12"
_MINUS = "\N{MINUS SIGN}"
_SINGLE = (
    "swept_volume", "clearance_volume", "compression_ratio", "gas_pressure_max", "indicated_work",
    "indicated_mean_pressure", "indicated_power",
)  # fmt: skip


def given_chambers(material: Material) -> Iterator[Block]:
    """Yield the chambers as they are given, and the gas sealed in them."""
    words = material.words
    given = stated_chambers(material.machine)
    if not given:
        return
    rows = [tuple(_given(chamber, material)) for chamber in given]
    sizes = (words.titled(key) for key in ("piston_area", "clearance_volume", "ambient_pressure"))
    yield words.table("chambers", ("chamber", "faces", *sizes, "gas"), rows, "llrrrl")
    for charge in stated_charges(material.machine):
        dead = "; ".join(_amount(volume, temperature, words) for volume, temperature in charge.dead_volumes) or "–"
        parts = {"name": charge.name, "chambers": ", ".join(charge.chambers), "dead": dead}
        if charge.exponent is None:
            yield words.paragraph("charge_given", **parts)
        else:
            yield words.paragraph("charge_polytrope", exponent=words.number(charge.exponent), **parts)


def _given(chamber: StatedChamber, material: Material) -> Iterator[str]:
    """Yield name, faces, areas, clearance, pressure around, and what gives the pressure of a chamber."""
    words, results = material.words, material.results
    yield chamber.name
    yield ", ".join(f"{slider} ({'+' if sense > 0 else _MINUS})" for slider, sense in chamber.faces)
    keys = [f"piston_area.{owner}" for owner in chamber.owners]
    yield "; ".join(words.number(in_display_unit(key, [results.value(key)])[0]) for key in keys)
    yield words.number(
        in_display_unit("clearance_volume", [results.summary.get(f"clearance_volume.{chamber.name}", 0.0)])[0]
    )
    # of gauge pressures the ambient pressure is not known
    yield words.number(in_display_unit("ambient_pressure", [chamber.ambient])[0]) if chamber.ambient else "–"
    amounts = {name: words.amount(value, unit) for name, (value, unit) in chamber.amounts.items()}
    pressure = say(f"sentences.of_{chamber.kind}", words.language, **chamber.names, **amounts)
    if chamber.delay:
        pressure = say("sentences.of_later", words.language, text=pressure, delay=words.amount(chamber.delay, "deg"))
    if chamber.factor != 1:
        pressure = say("sentences.of_factor", words.language, text=pressure, factor=words.number(chamber.factor))
    yield pressure


def _amount(volume: float, temperature: float | None, words: Words) -> str:
    shown = words.amount(volume, "cm3")
    return shown if temperature is None else f"{shown} ({words.amount(temperature, 'K')})"


def chambers(material: Material) -> Iterator[Block]:
    """Yield the section about the gas: volumes, pressures and forces, then work and power."""
    words, columns, machine = material.words, material.columns, material.machine
    if not machine.chambers:
        return
    yield words.heading("chambers")
    yield words.paragraph("chambers", source=Citation(_VOLUME))
    if any(charge.exponent is None for charge in machine.charges.values()):
        yield words.paragraph("isothermal", source=Citation(_CHARGE))
    yield from material.equations("charges")
    yield from material.worked("chambers")
    keys = named(columns, "cylinder_volume", "gas_pressure", "gas_force", "rod_load")
    yield from material.table("gas", keys, label="gas")
    yield from material.figures("chambers", "indicator")
    yield words.paragraph("gas_work")
    yield from material.equations("gas_work")
    rows = [(chamber.name, *_values(chamber.name, material)) for chamber in stated_chambers(machine)]
    titles = [words.titled(key, QUANTITIES[base_key(key)].unit) for key in _SINGLE]
    yield words.table("gas_work", ("chamber", *titles), rows, "l" + "r" * len(_SINGLE))
    if material.lines("delivery"):
        yield words.paragraph("delivery", source=Citation(_DELIVERED))
        yield from material.equations("delivery")


def _values(name: str, material: Material) -> Iterator[str]:
    """Yield the single values of a chamber; a dash for what it has not."""
    words, summary = material.words, material.results.summary
    for key in _SINGLE:
        value = summary.get(f"{key}.{name}", math.nan)
        yield words.number(in_display_unit(key.removesuffix("_max"), [value])[0])
