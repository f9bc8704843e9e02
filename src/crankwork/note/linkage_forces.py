"""Forces of a linkage: inertia, joints, the balancing torque by five routes, reduction to the crank."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.linkage import torque_by_routes
from crankwork.analysis.rounding import without_rounding
from crankwork.analysis.stated import StatedFriction, stated_friction
from crankwork.note.document import Block, Citation, ItemList, Math, Paragraph, Reference, Run, Runs
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import Column, equations
from crankwork.note.words import Words, in_display_unit, named
from crankwork.report.not_drawn import not_drawn
from crankwork.report.tables import any_nonzero

_STATICS, _WORK, _EFFICIENCY = (f"artobolevsky_1988, ch. {chapter}" for chapter in (13, 15, 14))
_BALANCE = "den_hartog_1956, ch. 5"
_SHAKING = ("shaking_force_x", "shaking_force_y", "shaking_force", "shaking_moment")
_TORQUES = ("static_torque", "dynamic_torque", "balancing_torque", "driving_torque")


def has_forces(material: Material) -> bool:
    """Return whether anything of the linkage has a mass, a load or inertia."""
    return "reduced_inertia" in material.results.columns


def forces(material: Material) -> Iterator[Block]:
    """Yield the section about inertia forces, joint forces and the balancing torque."""
    mechanism = material.machine.mechanism
    if not (mechanism.bodies or material.machine.loads or material.machine.chambers):
        return
    words = material.words
    yield words.heading("linkage_forces")
    if mechanism.bodies:
        yield words.heading("inertia_loads", 2)
        yield words.paragraph("inertia_of_links", source=Citation(_STATICS))
        yield from material.worked("inertia_loads")
    yield words.heading("reactions", 2)
    yield words.paragraph("reactions")
    yield from material.worked("joint_forces")
    keys = material.nonzero("joint_force", "tooth_force", "separating_force", "normal_force", "normal_moment")
    yield from material.table("reactions", keys, label="reactions")
    yield from material.figures("joint_forces", "force_plans")
    for notice in not_drawn(material.results, words.language):
        yield Paragraph((f"{notice[0].upper()}{notice[1:]}.",))
    yield from _lever(material)


def _lever(material: Material) -> Iterator[Block]:
    """Yield the balancing torque by five methods at every position, with their largest difference."""
    words = material.words
    routes, gaps = torque_by_routes(material.results, material.positions)
    of_routes = {f"balancing_torque.{name}": values for name, values in routes.items()}
    printed = without_rounding({**material.columns, **of_routes}, material.machine.speed)
    if not any_nonzero(of_routes, printed):
        # differences of rounding noise mean nothing
        routes, gaps = {name: printed[key] for name, key in zip(routes, of_routes, strict=True)}, np.zeros_like(gaps)
    yield words.heading("lever", 2)
    largest = words.number(100.0 * float(np.max(gaps, initial=0.0)), digits=2)
    yield words.paragraph("lever", source=Citation(_WORK), difference=largest)
    shown = [_route(name, values, words) for name, values in routes.items()]
    percent = [words.number(difference, digits=2) for difference in (100.0 * gaps).tolist()]
    shown.append(Column((words.column("difference"),), percent))
    yield from material.tabulated("routes", shown, label="routes")
    yield from material.figures("zhukovsky_lever")


def _route(name: str, values: Array, words: Words) -> Column:
    heading = (*words.titled("balancing_torque"), f", {words.term(name)}")
    return Column(heading, words.column_texts(in_display_unit("balancing_torque", values.tolist()), digits=5))


def balance(material: Material) -> Iterator[Block]:
    """Yield the section about what the moving masses do to the foundation, and the best counterweight on the crank."""
    words, columns, summary = material.words, material.columns, material.results.summary
    if "shaking_force" not in columns:
        return
    yield words.heading("linkage_balance")
    yield words.paragraph("shaking", source=Citation(_BALANCE))
    yield from material.worked("shaking")
    yield from material.table("shaking", material.nonzero(*_SHAKING), label="shaking")
    orders = named(summary, "free_force")
    if not orders:
        return
    yield words.paragraph("free_forces", table=Reference("orders"))
    kinds = [kind for kind in ("free_force", "shaking_moment_amplitude") if named(summary, kind)]
    sizes = [
        words.column_texts(in_display_unit(kind, [summary[key] for key in named(summary, kind)]), digits=6)
        for kind in kinds
    ]
    rows = list(zip((key.partition(".")[2] for key in orders), *sizes, strict=True))
    titles: list[str | Runs] = ["order_of_turn", *(words.titled(kind) for kind in kinds)]
    yield words.table("linkage_orders", titles, rows, "c" + "r" * len(kinds), "orders")
    yield words.paragraph("counterweight")
    yield from material.equations("counterweight")


def reduction(material: Material) -> Iterator[Block]:
    """Yield the section about reduced inertia and reduced torque."""
    if not has_forces(material):
        return
    words = material.words
    yield words.heading("reduction")
    yield words.paragraph("reduction", source=Citation(_WORK))
    yield from material.worked("reduction")
    keys = material.nonzero("reduced_inertia", "reduced_inertia_1")
    yield from material.table("reduced", keys, label="reduced")
    yield from material.figures("reduced_inertia")


def torques(material: Material) -> Iterator[Block]:
    """Yield the section about static, dynamic and driving torque, with the efficiency."""
    if not has_forces(material):
        return
    words = material.words
    yield words.heading("torques")
    yield words.paragraph("torques")
    yield from material.worked("torques", "static_torque", "dynamic_torque", "balancing_torque")
    yield from efficiency(material)
    yield words.paragraph("driving")
    yield from material.equations("torques", "driving_torque")
    yield from material.table("table_torque", material.nonzero(*_TORQUES), label="torque")
    yield from material.figures("torques")


def efficiency(material: Material) -> Iterator[Block]:
    """Yield the paragraphs on the efficiency of the joints."""
    words = material.words
    drive = material.machine.drive
    if drive.efficiency == 1 and material.machine.friction:
        # a section of its own says what rubs
        return
    yield words.heading("efficiency", 2)
    if drive.efficiency == 1:
        yield words.paragraph("no_losses")
        return
    yield words.paragraph("efficiency", source=Citation(_EFFICIENCY), value=words.number(drive.efficiency))
    # what the chain comes to before it is rounded is the efficiency as well
    marks = {"efficiency.exact": words.symbol("efficiency")}
    yield from equations(material.lines("efficiency"), words, marks=marks)
    if drive.exact_efficiency is not None:
        used, exact = words.number(drive.efficiency), words.number(drive.exact_efficiency)
        yield words.paragraph("efficiency_rounded", used=used, exact=exact)


_SOURCE = "artobolevsky_1988, ch. 11, 14"
_WITH_FRICTION = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "static_torque_with_friction",
    "instantaneous_efficiency",
)  # fmt: skip
_JOINTS = ("friction_torque", "friction_force", "joint_force_with_friction", "normal_force_with_friction")


def friction(material: Material) -> Iterator[Block]:
    """Yield the section about friction in the joints."""
    words, columns, summary = material.words, material.columns, material.results.summary
    joints = stated_friction(material.machine)
    if not joints or "friction_power" not in columns:
        return
    yield words.heading("friction")
    yield words.paragraph("rubbing")
    yield ItemList(tuple(_friction_of_joint(joint, words) for joint in joints))
    yield words.paragraph("with_friction", source=Citation(_SOURCE))
    yield from material.worked("friction")
    keys = any_nonzero([*named(columns, *_WITH_FRICTION), "friction_power", *named(columns, *_JOINTS)], columns)
    yield from material.table("friction", keys, label="friction")
    if "mean_friction_power" in summary:
        yield words.paragraph("mean_friction_power", value=words.amount(summary["mean_friction_power"], "W"))
    if "mean_efficiency" in summary:
        yield words.paragraph("mean_efficiency", value=words.number(summary["mean_efficiency"]))
    yield from material.figures("friction")


def _friction_of_joint(joint: StatedFriction, words: Words) -> Runs:
    """Return the friction of a joint in words."""
    runs: list[Run] = []
    for key, (value, unit) in joint.amounts.items():
        runs += [
            ", " if runs else f"{joint.name.replace('_', ' ')}: ",
            Math(words.symbol(key)),
            f" = {words.amount(value, unit)}",
        ]
    return tuple(runs)
