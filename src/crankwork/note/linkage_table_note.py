"""The note of a mechanism that is given by a table of transfer functions, as courses of machines do with a press."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.formula.known import in_order
from crankwork.formula.replay import Program
from crankwork.machine import TransferTable
from crankwork.note.document import Block, Citation, Equation, ItemList, Math, Reference, Runs
from crankwork.note.linkage_data import method
from crankwork.note.linkage_forces import efficiency
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import Column, position_tables, quantity_columns
from crankwork.note.symbols import subscript
from crankwork.note.words import Words

_WORK = "artobolevsky_1988, ch. 15"


def table_task(material: Material) -> Iterator[Block]:
    """Yield the task, the masses, and the transfer functions."""
    words, table = material.words, material.transfer
    yield words.heading("task")
    yield words.paragraph("task_table")
    yield words.paragraph("table_speed", value=words.amount(material.results.solved.speed, "rad/s"))
    yield words.paragraph("bodies")
    yield ItemList(tuple(_body(table, index, words) for index in range(len(table.bodies))))
    yield from position_tables(
        "table_transfer", material.results.grid.degrees, list(_ratios(material)), words, first=1, label="transfer"
    )
    yield method(material)
    if material.options.sheets:
        yield words.paragraph("sheets")


def _body(table: TransferTable, index: int, words: Words) -> Runs:
    body = table.bodies[index]
    mass, inertia = Math(words.symbol(f"body_mass.{body.name}")), Math(f"J_{subscript(body.name)}")
    runs: list[str | Math] = [f"{body.name}: "]
    if body.mass:
        runs += [mass, f" = {words.amount(body.mass, 'kg')}"]
    if body.inertia:
        runs += [", " if body.mass else "", inertia, f" = {words.amount(body.inertia, 'kg*m2')}"]
    return tuple(runs)


def _ratios(material: Material) -> Iterator[Column]:
    """Yield the columns of the table, in metres and without a unit, as the formulas take them."""
    words, count = material.words, len(material.transfer.angles)
    for body in material.transfer.bodies:
        for key, unit, ratios in (
            ("velocity_ratio", "m", body.velocity_ratio),
            ("rotation_ratio", "", body.rotation_ratio),
        ):
            if any(ratios):
                values = ratios if len(ratios) > 1 else ratios * count
                yield Column(words.titled(f"{key}.{body.name}", unit), [words.number(value) for value in values])


def static(material: Material) -> Iterator[Block]:
    """Yield the static torque, where it is known."""
    words, columns = material.words, material.results.columns
    if "static_torque" not in columns:
        return
    yield words.heading("static")
    if material.transfer.static_torque is None:
        yield words.paragraph("given_balancing")
        yield from material.worked("torques", "static_torque")
    shown = quantity_columns(("static_torque",), columns, words)
    yield from position_tables("table_static", material.results.grid.degrees, shown, words, first=1, label="static")


def dynamic(material: Material) -> Iterator[Block]:
    """Yield reduced inertia, its derivative and the dynamic torque, at all positions one after the other."""
    words, columns = material.words, material.results.columns
    yield words.heading("dynamic")
    yield words.paragraph("table_reduction", source=Citation(_WORK), table=Reference("transfer"))
    yield from material.equations("speed")
    yield from material.worked("reduction", "reduced_inertia")
    if material.transfer.reduced_inertia_1 is not None:
        yield words.paragraph("given_derivative")
    else:
        yield from _at_all(material, "reduced_inertia_1")
    shown = _parts(material) + quantity_columns(("reduced_inertia", "reduced_inertia_1"), columns, words)
    yield from position_tables("reduced", material.results.grid.degrees, shown, words, first=1, label="reduced")
    yield from material.figures("reduced_inertia")
    yield from _at_all(material, "dynamic_torque")


def _parts(material: Material) -> list[Column]:
    """Return the terms of the bodies in the reduced inertia."""
    words, results = material.words, material.results
    traced_values = in_order([results.memory["reduced_inertia"]])
    known = {traced.key: traced for traced in traced_values if traced.key.startswith("reduced_inertia.")}
    rows = Program(known)(results.grid)
    parts = {
        key: rows[key] for key in (f"reduced_inertia.{body.name}" for body in material.transfer.bodies) if key in rows
    }
    return [quantity_columns((key,), parts, words)[0] for key, values in parts.items() if values.any()]


def driving(material: Material) -> Iterator[Block]:
    """Yield the driving torque with the losses, at all positions one after the other."""
    words, columns = material.words, material.results.columns
    if "driving_torque" not in columns:
        return
    yield words.heading("driving")
    yield words.paragraph("torques")
    yield from efficiency(material)
    yield words.paragraph("driving")
    yield from _at_all(material, "driving_torque")
    keys = ("reduced_inertia_1", "dynamic_torque", "static_torque", "balancing_torque", "driving_torque")
    shown = quantity_columns(keys, columns, words)
    yield from position_tables("table_torque", material.results.grid.degrees, shown, words, first=1, label="torque")
    yield from material.figures("torques")


def _at_all(material: Material, key: str) -> Iterator[Block]:
    """Yield the equation of a quantity at every position, its number in the subscript."""
    results, shown = material.results, material.words.symbol(key)
    for number, degrees in enumerate(results.grid.degrees.tolist(), start=1):
        yield Equation(results.moment(degrees).step(results.memory[key]), symbol=_numbered(shown, number))


def _numbered(symbol: str, position: int) -> str:
    return f"{symbol}{',' if '_' in symbol else '_'}{position}"
