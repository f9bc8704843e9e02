"""The sheets of a linkage: position, velocity and acceleration plans on the first, dynamics on the second."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.diagrams import Fluctuation
from crankwork.analysis.moving import moving, reached_angles
from crankwork.analysis.plans import accelerations, driver_rates, velocities
from crankwork.analysis.skeleton import skeleton
from crankwork.locale import say
from crankwork.machine import Machine
from crankwork.mechanism.structure import structure
from crankwork.note.sheets.graph import Graph
from crankwork.note.sheets.linkage_dynamics import MOST, over_angle, wittenbauer
from crankwork.note.sheets.linkage_polygons import Numbered, vector_plans
from crankwork.note.sheets.linkage_positions import position_plans
from crankwork.note.sheets.sheet import Paper, Sheet
from crankwork.note.sheets.words import Words
from crankwork.quantities import Language
from crankwork.report.summary import results_method
from crankwork.report.tables import any_nonzero
from crankwork.show.scene import SMALL, TEXT, Text, printable

_DENSE_STEP = 1.0
_POSITIONS = tuple(range(0, 360, 30))
# position whose plan is bold, and those that get an acceleration plan
_MAIN = 1
_ACCELERATIONS = (1, 5, 9)
_MOST_REMARKS = 6
# where graphs of dynamics are, beside others or alone
_BESIDE = {"torques": (0, 290, 408, 290), "reduced_inertia": (0, 145, 408, 145), "reduced_inertia_1": (0, 0, 408, 145)}
_ALONE = {
    "torques": (0, 145, 408, 435),
    "reduced_inertia": (408, 320, 408, 260),
    "reduced_inertia_1": (408, 62, 408, 256),
}
_REDUCED = ("reduced_inertia", "reduced_inertia_1")
_DRIVER = ("driver_force", "driver_torque", "driver_power", "driver_velocity", "driver_speed")
_TORQUES = ("static_torque", "dynamic_torque", "driving_torque")


def linkage_sheets(results: Results, language: Language, paper: Paper) -> Iterator[Sheet]:
    """Yield a sheet of the plans of a linkage that was drawn, and one of its dynamics or those of a table."""
    words = Words(language, period=results.period)
    machine, wanted, graphs = results.machine, None, list[Graph]()
    if machine.linkage is not None:
        degrees, _ = reached_angles(machine, _DENSE_STEP)
        known = results.columns_at(degrees)
        yield _kinematics(results, machine, degrees, known, paper, words)
        if machine.drive.fluctuation is not None and "crank_speed" in known:
            wanted = Fluctuation(results.solved.speed, machine.drive.fluctuation)
        graphs = _dynamics(wanted, degrees, known, paper, words)
    elif "dynamic_torque" in results.columns:
        graphs = _dynamics(wanted, results.grid.degrees, results.columns, paper, words)
    if graphs:
        yield Sheet("linkage-dynamics", words.say("linkage_dynamics"), language, paper, tuple(graphs))


def _kinematics(
    results: Results, machine: Machine, degrees: Array, known: Mapping[str, Array], paper: Paper, words: Words
) -> Sheet:
    """Return the sheet of plans, and below them the motion of sliders, or of links where nothing slides."""
    mechanism, rates = machine.mechanism, driver_rates(results, known)
    found, _ = structure(machine.drawn)
    links = found.links if found is not None else ()
    moved = moving(mechanism, degrees)
    indices = [int(np.argmin(np.abs(degrees - one))) for one in _POSITIONS]
    shown = [at for at, one in zip(indices, _POSITIONS, strict=True) if abs(degrees[at] - one) < _DENSE_STEP]
    main = min(_MAIN, len(shown) - 1)
    shape = skeleton(mechanism, links)
    graphs = [position_plans(shape, moved, shown, main, paper.part(0, 190, 400, 390), words)]
    by_velocity = [
        Numbered(i, velocities(mechanism, moved, at, float(rates.first[at]), links)) for i, at in enumerate(shown)
    ]
    polygons, heads = vector_plans("velocity_plans", by_velocity, paper.part(400, 316, 416, 264), 4, words)
    chosen = [i for i in _ACCELERATIONS if i < len(shown)] or [0]
    by_acceleration = [
        Numbered(i, accelerations(mechanism, moved, at, float(rates.first[at]), float(rates.second[at]), links))
        for i, at in ((i, shown[i]) for i in chosen)
    ]
    box = paper.part(400, 190, 416, 124)
    further, further_heads = vector_plans("acceleration_plans", by_acceleration, box, 3, words)
    graphs += [*polygons, *further, *_motion(degrees, known, paper, words)]
    remarks = _remarks(results, by_velocity[main], words)
    box = paper.part(632, 62, 184, 126)
    more = [*heads, *further_heads, Text((box.left + 1.5, box.top - 6.5), words.say("data"), 5.0)]
    more += [Text((box.left + 1.5, box.top - 14.0 - 6.5 * i), one, _fit(one)) for i, one in enumerate(remarks)]
    return Sheet(
        "linkage-kinematics", words.say("linkage_kinematics"), words.language, paper, tuple(graphs), tuple(more)
    )


def _fit(text: str) -> float:
    return TEXT if len(text) < 56 else SMALL


def _motion(degrees: Array, known: Mapping[str, Array], paper: Paper, words: Words) -> list[Graph]:
    """Return displacement, velocity and acceleration of sliders, or of links where nothing slides."""
    kinds = ("slider_displacement", "slider_velocity", "slider_acceleration")
    if not any(key.startswith("slider_displacement.") for key in known):
        kinds = ("link_angle", "link_angular_velocity", "link_angular_acceleration")
    graphs = []
    for count, kind in enumerate(kinds):
        keys = [key for key in known if key.partition(".")[0] == kind]
        graphs.append(over_angle(kind, keys, known, degrees, paper.part(210.6 * count, 0, 210.6, 188), words))
    return [one for one in graphs if one is not None]


def _remarks(results: Results, main: Numbered, words: Words) -> list[str]:
    """Return speed and method, the turning of the links in the bold plan, and what the small letters are."""
    key, value, unit = ("period", words.period, "s") if words.period else ("speed", results.solved.speed, "rad/s")
    driven = f"{words.symbol(key)} = {words.number(value)} {words.unit(unit)}"
    rows = [f"{driven}; {words.say('method')}: {results_method(results, words.language)}"]
    turning = [
        f"ω_{{{link}}} = {words.number(value)}" for link, value in main.plan.turning.items() if abs(value) > 1e-9
    ]
    rows += [f"{'; '.join(turning[at : at + 4])} {words.unit('rad/s')}" for at in range(0, len(turning), 4)]
    rows.append(f"({words.say('position')} {main.position}; {words.say('anticlockwise')})")
    for under, (link, over) in list(main.plan.beneath.items())[:_MOST_REMARKS]:
        rows.append(
            say("sheets.beneath", words.language, point=printable(under, 8), link=link, other=printable(over, 8))
        )
    return rows


def _dynamics(
    wanted: Fluctuation | None, degrees: Array, known: Mapping[str, Array], paper: Paper, words: Words
) -> list[Graph]:
    """Return torques and reduced inertia, beside them energy and speed, or else joint forces, where they are known."""
    joints = any_nonzero((key for key in known if key.partition(".")[0] == "joint_force"), known)
    has_energy = wanted is not None and "kinetic_energy_change" in known
    is_alone = not joints and not has_energy
    places = _ALONE if is_alone else _BESIDE
    drawn: list[tuple[str, tuple[str, ...]]] = [("torques", _TORQUES), *((one, (one,)) for one in _REDUCED)]
    if words.period:
        drawn = [(one, (one,)) for one in _DRIVER if one in known]
    graphs = [
        over_angle(name, some, known, degrees, paper.part(*place), words)
        for (name, some), place in zip(drawn, places.values(), strict=True)
    ]
    if wanted is not None and has_energy:
        graphs.append(wittenbauer(known, degrees, wanted, paper.part(408, 220, 408, 360), words))
        for key, left in (("kinetic_energy_change", 408), ("crank_speed", 612)):
            graphs.append(over_angle(key, (key,), known, degrees, paper.part(left, 60, 204, 158), words))
    else:
        for count, some in enumerate((joints[:MOST], joints[MOST : 2 * MOST])):
            box = paper.part(408, 290 - 230 * count, 408, 290 - 62 * count)
            graphs.append(over_angle("joint_forces", some, known, degrees, box, words))
    return [one for one in graphs if one is not None]
