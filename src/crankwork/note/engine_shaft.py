"""Torque of all cylinders, bearings, wear, balance and flywheel in the note of an engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from crankwork.cylinders import balance as balance_formulas
from crankwork.cylinders import bearings as bearing_formulas
from crankwork.cylinders import torque as torque_formulas
from crankwork.note.document import Block, Math, Reference, Runs, Table
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import angle_table, column_table, folded, listing_table
from crankwork.shaft import flywheel as flywheel_formulas
from crankwork.shaft import flywheel_parts
from crankwork.shaft.fluctuation import fluctuation_of_energy
from crankwork.steps import AnyStep, Given, Step, worked_step

_NEAR = 1e-9
_HARMONICS = ("torque_harmonics", "phase_stars")


def _cylinders(material: Material) -> int:
    return len(material.machine.engine.layout.places) if material.machine.engine else 0


def total(material: Material) -> Iterator[Block]:
    """Yield the torque of all cylinders; for one cylinder only where the order of sections asks for it.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    words, summary, engine = material.words, material.summary, material.machine.engine
    if engine is None or "mean_total_torque" not in summary:
        return
    count = _cylinders(material)
    if count == 1 and material.order != "vi":
        return
    yield words.heading("total")
    yield words.paragraph("one_cylinder" if count == 1 else "total")
    if count > 1:
        yield words.paragraph("order", order="–".join(map(str, engine.layout.firing_order)))
    yield from material.worked(_torque_steps(material, count))
    firing = listing_table(material, "firing", "firing") if count > 1 else None
    if firing is not None:
        yield from material.presented([firing])
    if material.order == "vi":
        yield words.paragraph("tangential_sum")
    yield from material.presented([_total_table(material)], ("total_torque",))
    if count == 1 and "torque" in material.drawn:
        yield words.paragraph("see_figure", figures=Reference("f:torque"))
    if count > 1:
        yield from material.presented([listing_table(material, "torque_harmonics", "harmonics")], _HARMONICS)


def _torque_steps(material: Material, count: int) -> Iterator[AnyStep]:
    summary, cycle = material.summary, math.radians(material.machine.cycle)
    intervals = material.results.listings["firing"].columns["firing_interval"]
    step = worked_step(torque_formulas.even_firing_interval, cycle, count)
    if all(abs(one - step.value) < _NEAR for one in intervals):
        yield step
    if "indicated_work" in summary:
        yield _or_given(
            worked_step(torque_formulas.mean_torque_of_work, count, summary["indicated_work"], cycle),
            summary["mean_total_torque"],
        )
    else:
        yield Given("mean_total_torque", summary["mean_total_torque"])


def _or_given(step: Step, value: float) -> AnyStep:
    """Return a step that gives the value of the results, or the value alone where a method makes them differ."""
    return step if math.isclose(step.value, value, rel_tol=_NEAR, abs_tol=1e-300) else Given(step.key, value)


def _total_table(material: Material) -> Table | None:
    """Return the torques of the cylinders and their sum; Vietnamese notes add the sum of the tangential forces."""
    words, columns = material.words, material.columns
    keys = [key for key in columns if key.startswith("crank_torque.")] or ["crank_torque"]
    keys.append("total_torque")
    if material.order != "vi":
        return angle_table(material, "total", keys)
    area = material.summary["piston_area"] * 1e6 if material.per_area else 1.0
    tangential = (material.results.columns["total_torque"] / material.summary["crank_radius"] / area).tolist()
    unit = words.unit("tangential_force")
    texts: list[tuple[Runs, Sequence[str]]] = [
        (words.titled("crank_angle"), [words.number(float(one)) for one in material.results.grid.degrees])
    ]
    texts += [(words.titled(key), words.column_texts(columns[key].tolist())) for key in keys]
    texts.append(((Math("ΣT"), f", {unit}"), words.column_texts(tangential)))
    return folded(column_table("total", texts, words))


def _bearings(material: Material) -> list[str]:
    return [key for key in material.results.groups.get("bearings", ()) if key in material.columns]


def crankpin(material: Material) -> Iterator[Block]:
    """Yield the loads on the crankpin; polar, unrolled and wear in one.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if not _bearings(material):
        return
    yield material.words.heading("crankpin")
    yield from _crankpin_steps(material)
    yield from material.presented(
        [angle_table(material, "crankpin", _bearings(material)), listing_table(material, "bearing_loads", "loads")],
        (*_polars(material), "crankpin_load", "big_end_polar", "small_end_polar"),
    )
    yield material.words.heading("wear", 2)
    yield from _wear(material)


def polar(material: Material) -> Iterator[Block]:
    """Yield the polar diagram of the crankpin as a section of its own.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if not _bearings(material):
        return
    yield material.words.heading("crankpin")
    yield from _crankpin_steps(material)
    keys = [key for key in _bearings(material) if key.startswith("crankpin_")]
    yield from material.presented([angle_table(material, "crankpin", keys)], _polars(material))


def unrolled(material: Material) -> Iterator[Block]:
    """Yield the load on the crankpin over the crank angle as a section of its own.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if not _bearings(material):
        return
    words, summary = material.words, material.summary
    yield words.heading("unrolled")
    found = [Given(key, summary[key]) for key in summary if key.startswith("mean_crankpin_load")]
    yield from material.worked(found)
    yield from material.presented([listing_table(material, "bearing_loads", "loads")], ("crankpin_load",))


def big_end(material: Material) -> Iterator[Block]:
    """Yield the load on the big end as a section of its own.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if "big_end_load" not in material.columns:
        return
    yield material.words.heading("big_end")
    yield material.words.paragraph("big_end")
    shown = angle_table(material, "rods", ("big_end_load", "small_end_load"))
    yield from material.presented([shown], ("big_end_polar", "small_end_polar"))


def wear(material: Material) -> Iterator[Block]:
    """Yield the wear of the crankpin as a section of its own.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if "crankpin_wear" in material.results.listings:
        yield material.words.heading("wear")
        yield from _wear(material)


def _polars(material: Material) -> list[str]:
    return [name for name in material.drawn if name.startswith("crankpin_polar")]


def _crankpin_steps(material: Material) -> Iterator[Block]:
    """Yield the load on the crankpin of one rod, worked at the angle of the forces."""
    known = {one.key: one.value for one in material.groups["forces"].steps} if "forces" in material.groups else {}
    given = material.machine.masses
    yield material.words.paragraph("crankpin")
    if given is None or not {"tangential_force", "radial_force"} <= known.keys():
        return
    radius, speed = float(material.results.solved.lengths.crank_radius), float(material.results.solved.speed)
    turning = worked_step(bearing_formulas.big_end_inertia_force, given.rod_big_end, radius, speed)
    radial, tangential = known["radial_force"], known["tangential_force"]
    yield from material.worked_at("forces")
    yield from material.worked([
        turning,
        worked_step(bearing_formulas.crankpin_radial_force, radial, turning.value),
        worked_step(bearing_formulas.crankpin_load, tangential, radial, turning.value),
    ])  # fmt: skip


def _wear(material: Material) -> Iterator[Block]:
    words, summary = material.words, material.summary
    angle = next((summary[key] for key in summary if key.startswith("oil_hole_angle")), None)
    if angle is not None:
        yield words.paragraph("wear", value=words.amount(angle, "deg", digits=4))
    yield from material.presented([listing_table(material, "crankpin_wear", "crankpin_wear")], ("crankpin_wear",))


def mains(material: Material) -> Iterator[Block]:
    """Yield loads and wear of the main journals, and the torque along the shaft.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if not material.has_engine or "main_journals" not in material.results.tables:
        return
    yield from _heading(material, "mains")
    yield material.words.paragraph("mains")
    groups = material.results.groups
    yield from material.presented([angle_table(material, "mains", groups["main_journals"])], ("main_journal_polar",))
    yield from material.presented([listing_table(material, "main_wear", "main_wear")], ("main_wear",))
    yield from material.presented(
        [angle_table(material, "accumulated", groups.get("accumulated_torque", ()))], ("accumulated_torque",)
    )


def _heading(material: Material, key: str) -> Iterator[Block]:
    """Yield a heading, one level lower where the Vietnamese order puts the section into the appendix."""
    lower = material.order == "vi"
    yield material.words.heading(key, 2 if lower else 1, numbered=not lower)


def balance(material: Material) -> Iterator[Block]:
    """Yield free forces and moments by order.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    summary, solved = material.summary, material.results.solved
    if "balance" not in material.results.listings:
        return
    yield from _heading(material, "balance")
    yield material.words.paragraph("balance")
    radius, speed = float(solved.lengths.crank_radius), float(solved.speed)
    ratio = solved.method.inertia_rod_ratio
    if ratio is None or solved.method.is_exact:
        ratio = summary["rod_ratio"]
    mass = summary["reciprocating_mass"]
    yield from material.worked([
        worked_step(balance_formulas.primary_inertia_force, mass, radius, speed),
        worked_step(balance_formulas.secondary_inertia_force, mass, radius, speed, ratio),
    ])  # fmt: skip
    yield from material.presented(
        [listing_table(material, "balance", "balance")], ("balance_orders", "balance_ellipses")
    )


def evenness(material: Material) -> Iterator[Block]:
    """Yield the excess work, the flywheel and the speed over the cycle.

    Parameters
    ----------
    material : Material
        Of an engine.
    """
    if "excess_work" not in material.summary:
        return
    yield from _heading(material, "evenness")
    yield material.words.paragraph("evenness")
    yield from material.worked(_flywheel_steps(material))
    keys = ("kinetic_energy_change", "crank_speed")
    yield from material.presented([angle_table(material, "speed", keys)], ("excess_work", "crank_speed"))
    if _cylinders(material) == 1:
        yield from material.presented([listing_table(material, "torque_harmonics", "harmonics")], _HARMONICS)


def _flywheel_steps(material: Material) -> Iterator[AnyStep]:
    summary, engine = material.summary, material.machine.engine
    excess, cycle = summary["excess_work"], math.radians(material.machine.cycle)
    yield Given("excess_work", excess)
    if "energy_fluctuation" in summary:
        work = worked_step(flywheel_parts.work_of_mean_torque, summary["mean_total_torque"], cycle)
        ratio = worked_step(fluctuation_of_energy, excess, work.value)
        if math.isclose(ratio.value, summary["energy_fluctuation"], rel_tol=_NEAR):
            yield work
        yield _or_given(ratio, summary["energy_fluctuation"])
    if engine is not None and engine.fluctuation is not None and "flywheel_inertia" in summary:
        speed = float(material.results.solved.speed)
        whole = worked_step(flywheel_formulas.inertia_for_fluctuation, excess, engine.fluctuation, speed)
        added = worked_step(flywheel_parts.flywheel_beside_machine, whole.value, engine.inertia)
        if engine.inertia and math.isclose(added.value, summary["flywheel_inertia"], rel_tol=_NEAR):
            yield whole._replace(key="whole_inertia")
            yield added
        else:
            yield _or_given(whole, summary["flywheel_inertia"])
    if "speed_fluctuation" in summary:
        yield Given("speed_fluctuation", summary["speed_fluctuation"])
