"""Torque of all cylinders, bearings, wear, balance and flywheel in the note of an engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from crankwork.note.document import Block, Math, Reference, Runs, Table
from crankwork.note.engine_lines import first_articulated
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import angle_table, column_table, folded, listing_table
from crankwork.note.flywheel import flywheel_by_methods

_AMPLITUDES = ("harmonic_amplitude", "total_harmonic_amplitude")
_ON_CRANKPIN = (
    "big_end_inertia_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load",
)  # fmt: skip
_STATISTICS = (
    "mean_crankpin_load", "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max", "reversal_duration",
    "reversal_ratio",
)  # fmt: skip
_ON_ROD = ("big_end_load", "piston_pin_force", "small_end_load")
_OF_ORDERS = (
    "acceleration_coefficient", "order_inertia_force", "force_factor", "free_force", "moment_factor", "free_moment",
    "rotating_mass", "counterweight_moment", "best_balanced_share", "best_counterweight_moment", "shaft_unbalance",
    "unbalance_force",
)  # fmt: skip
_ON_MAINS = (
    "shaft_unbalance", "unbalance_force", "unbalance_weight", "unbalance_tangential_force", "journal_share",
    "main_journal_load",
)  # fmt: skip


def _cylinders(material: Material) -> int:
    return len(material.machine.engine.layout.places) if material.machine.engine else 0


def total(material: Material) -> Iterator[Block]:
    """Yield the torque of all cylinders; for one cylinder only where the order of sections asks for it."""
    words, summary, engine = material.words, material.summary, material.machine.engine
    if engine is None or "total_torque_max" not in summary:
        return
    count = _cylinders(material)
    if count == 1 and material.order != "vi":
        return
    yield words.heading("total")
    yield words.paragraph("one_cylinder" if count == 1 else "total")
    if count > 1:
        yield words.paragraph("order", order="–".join(map(str, engine.layout.firing_order)))
    yield from material.equations("firing")
    yield from material.equations("uniformity", "mean_total_torque", "mean_driving_torque", "mean_torque")
    firing = listing_table(material, "firing", "firing") if count > 1 else None
    if firing is not None:
        yield from material.presented([firing])
    if count > 1:
        yield from material.worked_at("engine_torque")
        kinds = ("tangential_force", "crank_torque", "throw_torque", "total_torque")
        yield from material.equations("engine_torque", *kinds)
    if material.order == "vi":
        yield words.paragraph("tangential_sum")
    yield from material.presented([_total_table(material)] if count > 1 else [], ("total_torque",))
    if count == 1 and "torque" in material.drawn:
        yield words.paragraph("see_figure", figures=Reference("f:torque"))
    if count > 1:
        yield from _harmonics(material)


def _harmonics(material: Material) -> Iterator[Block]:
    """Yield amplitudes of the torque by order, worked for the first of them."""
    yield from material.intro("harmonics", material.equations("torque_harmonics", *_AMPLITUDES, first=True))
    figures = ("torque_harmonics", "phase_stars")
    yield from material.presented([listing_table(material, "torque_harmonics", "harmonics")], figures)


def _total_table(material: Material) -> Table | None:
    """Return the torques of the cylinders and their sum; Vietnamese notes add the sum of the tangential forces."""
    words, columns = material.words, material.columns
    keys = [key for key in columns if key.startswith("crank_torque.")] or ["crank_torque"]
    keys.append("total_torque")
    if material.order != "vi":
        return angle_table(material, "total", keys)
    force = material.results.columns["total_torque"] / material.summary["crank_radius"]
    unit = words.unit("tangential_force")
    texts: list[tuple[Runs, Sequence[str]]] = [
        (words.titled("crank_angle"), [words.number(float(angle)) for angle in material.results.grid.degrees])
    ]
    texts += [(words.titled(key), words.column_texts(columns[key].tolist())) for key in keys]
    texts.append(((Math("ΣT"), f", {unit}"), words.column_texts(material.shown("tangential_force", force).tolist())))
    return folded(column_table("total", texts, words))


def _bearings(material: Material) -> list[str]:
    return [key for key in material.results.groups.get("bearings", ()) if key in material.columns]


def crankpin(material: Material) -> Iterator[Block]:
    """Yield the loads on the crankpin; polar, unrolled and wear in one."""
    if not _bearings(material):
        return
    yield material.words.heading("crankpin")
    yield from _crankpin_lines(material)
    yield from material.equations("bearings", *_ON_ROD)
    yield from _statistics(material)
    yield from material.presented(
        [angle_table(material, "crankpin", _bearings(material)), listing_table(material, "bearing_loads", "loads")],
        (*_polars(material), "crankpin_load", "big_end_polar", "small_end_polar"),
    )
    yield material.words.heading("wear", 2)
    yield from _wear(material)


def polar(material: Material) -> Iterator[Block]:
    """Yield the polar diagram of the crankpin as a section of its own."""
    if not _bearings(material):
        return
    yield material.words.heading("crankpin")
    yield from _crankpin_lines(material)
    keys = [key for key in _bearings(material) if key.startswith("crankpin_")]
    yield from material.presented([angle_table(material, "crankpin", keys)], _polars(material))


def unrolled(material: Material) -> Iterator[Block]:
    """Yield the load on the crankpin over the crank angle as a section of its own."""
    if not _bearings(material):
        return
    yield material.words.heading("unrolled")
    yield from _statistics(material)
    yield from material.presented([listing_table(material, "bearing_loads", "loads")], ("crankpin_load",))


def _statistics(material: Material) -> Iterator[Block]:
    """Yield means and ratios of the loads, worked for the crankpin."""
    blocks = material.equations("bearing_loads", *_STATISTICS, first=True)
    yield from material.intro("loads", blocks)


def big_end(material: Material) -> Iterator[Block]:
    """Yield the load on the big end as a section of its own."""
    if "big_end_load" not in material.columns:
        return
    yield material.words.heading("big_end")
    yield material.words.paragraph("big_end")
    yield from material.worked_at("bearings")
    yield from material.equations("bearings", *_ON_ROD)
    shown = angle_table(material, "rods", ("big_end_load", "small_end_load"))
    yield from material.presented([shown], ("big_end_polar", "small_end_polar"))


def wear(material: Material) -> Iterator[Block]:
    """Yield the wear of the crankpin as a section of its own."""
    if "crankpin_wear" in material.results.listings:
        yield material.words.heading("wear")
        yield from _wear(material)


def _polars(material: Material) -> list[str]:
    return [name for name in material.drawn if name.startswith("crankpin_polar")]


def _crankpin_lines(material: Material) -> Iterator[Block]:
    """Yield the load on the crankpin, worked at the angle of the forces."""
    yield material.words.paragraph("crankpin")
    yield from _articulated(material)
    yield from material.worked_at("bearings")
    yield from material.equations("bearings", *_ON_CRANKPIN)


def _articulated(material: Material) -> Iterator[Block]:
    """Yield motion and forces of the first cylinder whose rod is articulated, worked at its own crank angle."""
    words, engine = material.words, material.machine.engine
    if engine is None or "articulated" not in material.groups:
        return
    number = first_articulated(engine)
    of_crankpin, own = (
        words.amount(math.radians(material.groups[name].degrees or 0.0), "deg") for name in ("bearings", "articulated")
    )
    shown: Runs = (Math(words.symbol(f"crank_angle.{number}")), f" = {own}")
    yield words.paragraph("articulated", number=str(number), value=of_crankpin, own=shown)
    yield from material.equations("articulated")


def _wear(material: Material) -> Iterator[Block]:
    words, summary = material.words, material.summary
    angle = next((summary[key] for key in summary if key.startswith("oil_hole_angle")), None)
    if angle is not None:
        yield words.paragraph("wear", value=words.amount(angle, "deg", digits=4))
    yield from material.presented([listing_table(material, "crankpin_wear", "crankpin_wear")], ("crankpin_wear",))


def mains(material: Material) -> Iterator[Block]:
    """Yield loads and wear of the main journals, and the torque along the shaft."""
    if not material.has_engine or "main_journals" not in material.results.tables:
        return
    yield from _heading(material, "mains")
    yield material.words.paragraph("mains")
    yield from material.worked_at("bearings")
    yield from material.equations("bearings", *_ON_MAINS)
    groups = material.results.groups
    yield from material.presented([angle_table(material, "mains", groups["main_journals"])], ("main_journal_polar",))
    yield from material.presented([listing_table(material, "main_wear", "main_wear")], ("main_wear",))
    yield from material.equations("engine_torque")
    yield from material.presented(
        [angle_table(material, "accumulated", groups.get("accumulated_torque", ()))], ("accumulated_torque",)
    )


def _heading(material: Material, key: str) -> Iterator[Block]:
    """Yield a heading, one level lower where the Vietnamese order puts the section into the appendix."""
    lower = material.order == "vi"
    yield material.words.heading(key, 2 if lower else 1, numbered=not lower)


def balance(material: Material) -> Iterator[Block]:
    """Yield free forces and moments by order."""
    if "balance" not in material.results.listings:
        return
    yield from _heading(material, "balance")
    yield material.words.paragraph("balance")
    yield from material.equations("balance", *_OF_ORDERS)
    yield from material.presented(
        [listing_table(material, "balance", "balance")], ("balance_orders", "balance_ellipses")
    )


def evenness(material: Material) -> Iterator[Block]:
    """Yield the excess work, the flywheel and the speed over the cycle."""
    if "excess_work" not in material.summary:
        return
    yield from _heading(material, "evenness")
    is_full = "excess_work.mertsalov" in material.summary
    yield material.words.paragraph("evenness_of_all" if is_full else "evenness")
    yield from material.equations("uniformity")
    wanted = material.machine.drive.fluctuation
    if wanted is not None and "flywheel_inertia.exact" in material.summary:
        yield material.words.paragraph("flywheel", value=material.words.number(wanted))
        yield from flywheel_by_methods(material.groups["flywheel"].lines, material.summary, material.words)
    keys = ("kinetic_energy_change", "crank_speed")
    caption = "speed" if "crank_speed" in material.columns else "energy"
    yield from material.presented([angle_table(material, caption, keys)], ("excess_work", "crank_speed"))
    if _cylinders(material) == 1:
        yield from _harmonics(material)
