"""The forces in a note: masses, forces of a crank gear, inertia of links, forces and friction in joints, the lever."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.input_loads import FrictionInput, stated_friction, stated_loads
from crankwork.analysis.mechanism import torque_by_routes
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.note.document import Block, Citation, ItemList, Math, Paragraph, Reference, Run, Runs
from crankwork.note.material import Material
from crankwork.note.parts import (
    At,
    Head,
    Lines,
    Over,
    Part,
    Places,
    Section,
    Shown,
    Text,
    When,
    amount,
    drawn,
    driven,
    either,
    every,
    full,
    has,
    lacks,
    number,
    works,
)
from crankwork.note.readings import ROUNDING
from crankwork.note.tables import Column, long_table, quantity_column, tabulated
from crankwork.note.vector_equations import compared_forces, equilibrium, has_polygons, inertia_of_links
from crankwork.note.wording import Words, named
from crankwork.quantities.quantity import own_name
from crankwork.report.display import key_unit
from crankwork.report.notices import skipped_figure_notes
from crankwork.report.tables import any_nonzero

_STATICS, _WORK = "artobolevsky_1988, ch. 13", "artobolevsky_1988, ch. 15"
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
# share of the largest force below which weights may be left out
_NOTABLE = 0.1
# decimals of the table of forces that Vietnamese notes print
_VIETNAMESE = {"gas_force": 5, "inertia_force": 6, "piston_force": 6}
_SOURCE = "artobolevsky_1988, ch. 11, 14"
_WITH_FRICTION = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "static_torque_with_friction",
    "instantaneous_efficiency",
)  # fmt: skip
_JOINTS = ("friction_torque", "friction_force", "joint_force_with_friction", "normal_force_with_friction")


def _per_area(material: Material) -> Iterator[Block]:
    """Yield how forces are related to the piston area, where they are."""
    if material.per_area:
        words = material.words
        value = words.amount(material.summary["piston_area"], "cm2", digits=material.digits)
        yield words.paragraph("per_area", value=value, unit=words.unit("gas_pressure"))


def _masses(material: Material) -> Iterator[Block]:
    """Yield the masses of the crank gear."""
    given = material.machine.masses
    rigid = given is not None and bool(given.rod_inertia_excess) and material.results.method.rod == "rigid"
    # masses given by the piston area have nothing to be worked
    parts = ("reciprocating_mass", "rotating_mass") if material.lines("masses", "piston_area") else ()
    equations = material.equations("masses", *(() if material.full else parts))
    yield from material.intro("masses_rigid" if rigid else "masses", equations)


def _along(material: Material) -> Iterable[str]:
    """Return the columns of forces along the cylinder axis."""
    keys, method = any_nonzero(_ALONG, material.columns), material.results.method
    if method.inertia_rod_ratio is not None and not method.is_exact:
        # the acceleration of the columns is not the one that the inertia force is made of
        keys.remove("piston_acceleration")
    return keys


def _across(material: Material) -> Iterable[str]:
    """Return the columns of forces on wall, rod and crankpin."""
    return [key for key in _ACROSS if key != "rod_transverse_force" or any_nonzero((key,), material.columns)]


def _undrawn(material: Material) -> Iterator[Block]:
    """Yield which figures are left out, and why."""
    # what is zero throughout is said in the text
    for notice in skipped_figure_notes(material.results, material.words.language, zeros=False):
        yield Paragraph((f"{notice[0].upper()}{notice[1:]}.",))


def _sizes(material: Material) -> Iterator[Block]:
    """Yield how weights and inertia compare with the force of the process, and which of them rules."""
    words, machine, results = material.words, material.machine, material.results
    weight = results.method.gravity * sum(body.mass for body in machine.mechanism.bodies)
    inertia, loads = results.summary.get("shaking_force_max", 0.0), stated_loads(machine)
    if not weight or not inertia or machine.chambers:
        return
    process = max((load.amounts["force"][0] or 0.0 for load in loads if load.kind == "slider"), default=0.0)
    kinds = {load.kind for load in loads}
    if not process and kinds - {"weight"}:
        # what other loads come to is not stated as a force
        return
    sizes = {"load": process, "inertia": inertia, "weight": weight}
    force = {key: words.amount(size, key_unit("joint_force"), digits=4) for key, size in sizes.items()}
    share = weight / max(process, inertia)
    force["load"] = words.phrase("sizes_load", force=force["load"]) if process else ""
    if "weight" not in kinds:
        del sizes["weight"]
    omitted = "weight_left_out" if share > _NOTABLE else "weight_small"
    verdict = omitted if "weight" not in kinds else f"ruled_by_{max(sizes, key=sizes.__getitem__)}"
    ruling = words.sentence(verdict, share=words.fixed(100.0 * share, 0))
    yield Paragraph((*words.sentence("sizes", **force), " ", *ruling))


def _lever(material: Material) -> Iterator[Block]:
    """Yield the balancing torque by five methods at every position, with their largest difference."""
    words = material.words
    routes, gaps = torque_by_routes(material.results, material.positions)
    of_routes = {f"balancing_torque.{name}": values for name, values in routes.items()}
    printed = without_rounding({**material.columns, **of_routes}, material.machine.speed)
    if not any_nonzero(of_routes, printed):
        # differences of rounding noise mean nothing
        routes, gaps = {name: printed[key] for name, key in zip(routes, of_routes, strict=True)}, np.zeros_like(gaps)
    largest = float(np.max(gaps, initial=0.0))
    agreement = words.sentence("routes_agree")
    if material.full or largest > ROUNDING:
        agreement = words.sentence("routes_differ", difference=words.number(100.0 * largest, digits=2))
    yield Paragraph((*words.sentence("lever", source=Citation(_WORK)), " ", *agreement))
    if not material.full:
        return
    shown = [_route(name, values, material) for name, values in routes.items()]
    percent = [words.number(difference, digits=2) for difference in (100.0 * gaps).tolist()]
    shown.append(Column((words.column("difference"),), percent))
    yield from tabulated(material, "routes", shown, "routes")


def _route(name: str, values: Array, material: Material) -> Column:
    column = quantity_column(material, "balancing_torque", values, digits=5)
    return column._replace(heading=(*column.heading, f", {material.words.term(name)}"))


def _is_loaded(material: Material) -> bool:
    """Return whether anything acts on links: masses, loads or gas."""
    machine = material.machine
    return drawn(material) and bool(machine.mechanism.bodies or machine.loads or machine.chambers)


def _has_bodies(material: Material) -> bool:
    return bool(material.machine.mechanism.bodies)


_OF_FORCES = Lines("force_extremes", intro="extremes")
_OF_POWER = Lines("power", ("mean_torque", "mean_driving_torque"))
_WORKED: tuple[Part, ...] = (At("forces"), Lines("forces"), When(full, (Lines("reduction"),)))
_ON_CRANKPIN = Shown(("rod_forces", "crankpin_forces", "torque"), (Over("forces", _across),))
_INERTIA_OF_LINKS: tuple[Part, ...] = (
    Text("inertia_of_links", {"source": Citation(_STATICS)}), At("inertia_loads"), Lines("inertia_loads"),
)  # fmt: skip
_IN_JOINTS = ("joint_force", "tooth_force", "separating_force", "normal_force", "normal_moment")


def _joints(material: Material) -> Iterator[Block]:
    """Yield what rubs, and how much."""
    joints = stated_friction(material.machine)
    yield ItemList(tuple(_friction_of_joint(joint, material.words) for joint in joints))


def _friction_of_joint(joint: FrictionInput, words: Words) -> Runs:
    """Return the friction of a joint in words."""
    runs: list[Run] = []
    for key, (value, unit) in joint.amounts.items():
        runs += [
            ", " if runs else f"{own_name('joint_force', joint.name)}: ",
            Math(words.symbol(key)),
            f" = {words.amount(value, unit)}",
        ]
    return tuple(runs)


def _columns(material: Material) -> Iterable[str]:
    columns = material.columns
    return any_nonzero([*named(columns, *_WITH_FRICTION), "friction_power", *named(columns, *_JOINTS)], columns)


SECTIONS = (
    Section("dynamics", (
        Head("dynamics"), _per_area, Head("masses", 2), _masses,
        When(works("forces"), (
            Head("forces", 2), *_WORKED, Shown(("piston_forces",), (Over("along", _along),)), _ON_CRANKPIN,
            When(full, (Head("extremes", 2), _OF_FORCES)), _OF_POWER,
        )),
    ), either(works("masses"), works("forces"))),
    Section("inertia", (
        Head("inertia"), _per_area, _masses, At("forces"), Lines("forces", _INERTIA, intro="inertia"),
        Lines("force_extremes", ("inertia_force_max", "inertia_force_min"), intro="extremes"),
        When(works("forces"), (Text("see_table", {"tables": Reference("t:along")}),)),
    ), works("masses")),
    Section("piston_forces", (
        Head("along"), At("forces"), Lines("forces", (*_BEFORE_FORCES, "weight_force", "piston_force")),
        # to six decimals where they are per area
        Shown(("piston_forces",), (lambda material: long_table(
            material, "along", _OF_PISTON, decimals=_VIETNAMESE if material.per_area and material.full else None),)),
        Lines("force_extremes", ("piston_force_max", "piston_force_min"), intro="extremes"),
    ), works("forces")),
    Section("crank_forces", (Head("forces"), *_WORKED, _ON_CRANKPIN, _OF_FORCES, _OF_POWER), works("forces")),
    # what a driver with a law of its own has to give
    Section("forces", (
        Head("linkage_forces"), When(_has_bodies, _INERTIA_OF_LINKS), Text("driven_reactions"), equilibrium,
        When(either(full, lacks(has_polygons)), (Lines("joint_forces"),)), Lines("driver_force"),
        Places("reactions", (
            "driver_force", "driver_torque", "driver_power", "joint_force", "axial_force", "normal_force",
            "normal_moment",
        ), "reactions", filled=True),
        Shown(("process_force", "joint_forces", "force_plans")), compared_forces,
    ), every(_is_loaded, driven)),
    Section("forces", (
        Head("linkage_forces"), _sizes,
        When(_has_bodies, (Head("inertia_loads", 2), *_INERTIA_OF_LINKS, inertia_of_links)),
        Head("reactions", 2), Text("reactions"), equilibrium,
        When(either(full, lacks(has_polygons)), (At("joint_forces"), Lines("joint_forces", first=True))),
        Places("reactions", _IN_JOINTS, "reactions", filled=True),
        Shown(("process_force", "joint_forces", "force_plans")), compared_forces, _undrawn,
        Head("lever", 2), _lever, Shown(("zhukovsky_lever",)),
    ), _is_loaded),
    Section("friction", (
        Head("friction"), Text("rubbing"), _joints, Text("with_friction", {"source": Citation(_SOURCE)}),
        At("friction"), Lines("friction"), Places("friction", _columns, "friction"),
        When(has("mean_friction_power"), (
            Text("mean_friction_power", {"value": amount("mean_friction_power", "W")}),
        )),
        When(has("mean_efficiency"), (Text("mean_efficiency", {"value": number("mean_efficiency")}),)),
        Shown(("friction",)),
    ), every(drawn, has("friction_power"), lambda material: bool(stated_friction(material.machine)))),
)  # fmt: skip
