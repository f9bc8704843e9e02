"""The note of a linkage: its sections in the order of the school; motion, law of the driver, quality, tables."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.moving import transfer_ratios
from crankwork.analysis.quality import USUAL, USUAL_PRESSURE
from crankwork.analysis.rounding import without_rounding
from crankwork.formula.known import in_order
from crankwork.formula.replay import Program
from crankwork.locale import say
from crankwork.machine import TransferTable
from crankwork.mechanism.driver import Cylinder, DrivingSlider, Law, LinkMotor, Segment
from crankwork.mechanism.mechanism import Driver
from crankwork.note.document import Block, Citation, Equation, ItemList, Math, Note, Paragraph, Reference, Runs, Table
from crankwork.note.linkage_bearings import bearings, harmonics
from crankwork.note.linkage_data import chambers, given_parts, method, structural_analysis, task
from crankwork.note.linkage_forces import balance, efficiency, forces, friction, reduction, torques
from crankwork.note.linkage_lines import WORST_ANGLES, extreme_of, worst_angles
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_shaft import appendix, checks, comparison, conclusion, flywheel, motor, sources
from crankwork.note.linkage_tables import Column, equations, position_tables, quantity_columns
from crankwork.note.options import NoteOptions
from crankwork.note.printed_units import printed_unit
from crankwork.note.sections import note_of_sections
from crankwork.note.symbols import subscript
from crankwork.note.words import Words, named
from crankwork.report.language import displayed, key_unit, row_name

_CENTRES = "khurmi_gupta_2005, ch. 6"
MOVING = ("point_velocity", "link_angular_velocity", "slider_velocity")
ACCELERATING = ("point_acceleration", "link_angular_acceleration", "slider_acceleration")
_POSITIONS = "artobolevsky_1988, ch. 4"
_STATICS = "artobolevsky_1988, ch. 13"
_COORDINATE = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration",
)  # fmt: skip
_SOURCE = "norton_2012, ch. 4"
_TRAVEL = {"slider_displacement": "slider_stroke", "link_angle": "link_swing"}
_ANGLES = ("transmission_angle", "pressure_angle")
_NONE = "–"
_WORK = "artobolevsky_1988, ch. 15"


def kinematics(material: Material) -> Iterator[Block]:
    """Yield the section about the motion."""
    words, columns = material.words, material.columns
    yield words.heading("linkage_kinematics")
    yield words.heading("plans", 2)
    yield words.paragraph("positions")
    yield from material.figures("position_plans")
    yield from material.table("positions", positions(material))
    yield words.heading("transfer", 2)
    yield words.paragraph("transfer", source=Citation(_POSITIONS))
    yield from material.tabulated("transfer", _transfer_columns(material), label="transfer")
    yield words.heading("worked_motion", 2)
    yield from material.worked_at("motion")
    yield from material.equations("speed")
    yield from material.equations("motion")
    yield from material.table("velocities", named(columns, *MOVING))
    yield from material.table("accelerations", named(columns, *ACCELERATING, "coriolis_acceleration"))
    yield from instant_centres(material)
    yield from material.figures("centrodes", "points", "links")
    if material.drawn:
        yield words.heading("polygons", 2)
        yield words.paragraph("plan_numbers", table=Reference("links"))
        yield from material.figures("velocity_plan", "acceleration_plan", "sliders")


def positions(material: Material) -> list[str]:
    """Return the columns that say where points, links and sliders are."""
    return [*material.of_axes("point"), *named(material.columns, "link_angle", "slider_displacement")]


def instant_centres(material: Material) -> Iterator[Block]:
    """Yield where links turn about that have no fixed pivot, worked at one position and at all of them."""
    words, keys = material.words, material.of_axes("instant_centre")
    if not keys:
        return
    yield words.heading("instant_centres", 2)
    yield words.paragraph("instant_centres", source=Citation(_CENTRES))
    yield from material.worked("instant_centres")
    yield from material.table("instant_centres", keys)


def _transfer_columns(material: Material) -> list[Column]:
    """Return velocities of points and sliders and angular velocities of links, over that of the crank."""
    words = material.words
    ratios = transfer_ratios(material.machine.mechanism, material.positions)
    return [
        Column(
            words.titled(key, "m") if key.startswith("velocity_ratio.") else words.titled(key),
            words.column_texts(values.tolist()),
        )
        for key, values in without_rounding(ratios, 1.0).items()
    ]


def law_of_motion(material: Material) -> Iterator[Block]:
    """Yield the speed of the crank with the flywheel found, where it is known."""
    words, summary = material.words, material.results.summary
    has_speed = "crank_speed" in material.columns
    if not has_speed and "steady_speed" not in summary:
        return
    yield words.heading("law")
    if has_speed:
        yield words.paragraph("law")
        yield from material.table("speeds", ("kinetic_energy_change", "crank_speed"))
        yield from material.figures("speed")
    if "steady_speed" in summary:
        yield words.paragraph(
            "steady",
            speed=words.amount(summary["steady_speed"], "rpm"),
            fluctuation=words.number(summary["steady_fluctuation"]),
        )


_DYNAMICS = "artobolevsky_1988, ch. 15"
_ROWS = 21
_MOST_EVENTS = 24
_SHOWN = ("time", "crank_angle", "crank_speed", "angular_acceleration", "kinetic_energy", "potential_energy")


def transient(material: Material) -> Iterator[Block]:
    """Yield the section about the transient motion."""
    words, results, wanted = material.words, material.results, material.machine.transient
    if wanted is None or "transient" not in results.listings:
        return
    yield words.heading("transient")
    yield words.paragraph("transient_equation", source=Citation(_DYNAMICS))
    driven = "transient_motor" if wanted.motor else "transient_torque" if wanted.torque else "transient_free"
    yield words.paragraph(
        driven,
        angle=words.amount(wanted.start, "deg"),
        speed=words.amount(wanted.speed, "rad/s"),
        torque=words.amount(wanted.torque, "N*m"),
    )
    yield words.paragraph(
        "transient_end",
        time=words.amount(results.summary["transient_time"], "s"),
        turn=words.amount(results.summary["final_turn"], "deg"),
        speed=words.amount(results.summary["final_speed"], "rad/s"),
    )
    columns = results.listings["transient"].columns
    count = len(columns["time"])
    rows = np.unique(np.round(np.linspace(0, count - 1, min(_ROWS, count))).astype(int))
    keys = [*(key for key in _SHOWN if np.any(columns[key])), *named(columns, "slider_displacement")]
    yield _table("transient", {key: columns[key][rows] for key in keys}, words)
    yield from material.figures("transient")
    happened = results.listings.get("transient_events")
    if happened is not None:
        names = [row_name(name, words.language) for name in happened.names[:_MOST_EVENTS]]
        shown = {key: column[:_MOST_EVENTS] for key, column in happened.columns.items()}
        yield _table("transient_events", shown, words, names)


def _table(caption: str, columns: dict[str, np.ndarray], words: Words, names: list[str] | None = None) -> Table:
    """Return columns as a table, rows called by names where they have some."""
    made = quantity_columns(columns, columns, words)
    titles: list[Runs] = [column.heading for column in made]
    entries = [column.entries for column in made]
    if names is not None:
        titles.insert(0, (words.column("event"),))
        entries.insert(0, names)
    align = "l" * (names is not None) + "r" * len(made)
    return words.table(caption, titles, list(zip(*entries, strict=True)), align, caption)


def driven_task(material: Material) -> Iterator[Block]:
    """Yield the task and the given data, the law of the driver first."""
    words, machine = material.words, material.machine
    driver = machine.mechanism.driver
    yield words.heading("task")
    yield words.paragraph("driven_task")
    yield _drives(driver, words)
    for name, half in zip(("barrel", "rod"), machine.mechanism.halves, strict=False):
        if half.mass:
            along, across = (words.amount(coordinate, "mm") for coordinate in half.centre)
            amounts = {"mass": words.amount(half.mass, "kg"), "inertia": words.amount(half.inertia, "kg*m2")}
            yield words.paragraph(f"cylinder_{name}", **amounts, along=along, across=across)
    if driver.law is not None:
        period = words.amount(driver.law.period, "s")
        yield words.paragraph("driver_law", period=period, table=Reference("law"))
        yield _segments(driver.law, words, turns=driver.turns)
    yield from given_parts(material)
    yield method(material)


def _drives(driver: Driver, words: Words) -> Paragraph:
    match driver:
        case DrivingSlider(link=name):
            return words.paragraph("driver_slider", name=name)
        case Cylinder(barrel=first, rod=second):
            return words.paragraph("driver_cylinder", first=first, second=second)
        case LinkMotor(links=(first, second), pin=pin):
            return words.paragraph("driver_motor", first=first, second=second, pin=pin)
    return words.paragraph("driver_crank", radius=words.amount(driver.radius, "mm"))


def _segments(law: Law, words: Words, *, turns: bool) -> Table:
    """Return the segments of a law: kind of motion, ends, start and duration."""
    key = "link_angle" if turns else "slider_displacement"
    places = [law.start, *(segment.to for segment in law.segments)]
    times = [segment.share * law.period for segment in law.segments]
    rows = [
        (
            str(number), _moves(segment, words), *(words.shown(key, place) for place in ends),
            words.number(sum(times[: number - 1])), words.number(times[number - 1]),
        )
        for number, (segment, ends) in enumerate(zip(law.segments, itertools.pairwise(places), strict=True), start=1)
    ]  # fmt: skip
    ends = ((words.column(name, key_unit(key)),) for name in ("law_from", "law_to"))
    times_of = (words.titled(title) for title in ("start_time", "segment_time"))
    return words.table("law", ("number", "motion_law", *ends, *times_of), rows, "clrrrr", "law")


def _moves(segment: Segment, words: Words) -> str:
    return words.kind(segment.kind) if isinstance(segment.kind, str) else say("memory.own_law", words.language)


def driven_motion(material: Material) -> Iterator[Block]:
    """Yield the section about the motion of the driver and what it moves."""
    words, columns = material.words, material.columns
    yield words.heading("linkage_kinematics")
    yield words.paragraph("driven_positions", source=Citation(_POSITIONS))
    yield from material.figures("position_plans")
    yield from material.worked("driver")
    yield from material.table("driver", named(columns, *_COORDINATE))
    yield from material.equations("motion")
    yield from material.table("positions", positions(material))
    yield from material.table("velocities", named(columns, *MOVING))
    yield from material.table("accelerations", named(columns, *ACCELERATING))
    yield from instant_centres(material)
    yield from material.figures("driver", "sliders")
    if "velocity_plan" in material.drawn:
        yield words.heading("polygons", 2)
        yield words.paragraph("plan_numbers", table=Reference("links"))
        yield from material.figures("velocity_plan", "acceleration_plan")


def driven_forces(material: Material) -> Iterator[Block]:
    """Yield the section about inertia, joint forces, and what the driver has to give."""
    words, mechanism = material.words, material.machine.mechanism
    if not (mechanism.bodies or material.machine.loads or material.machine.chambers):
        return
    yield words.heading("linkage_forces")
    if mechanism.bodies:
        yield words.paragraph("inertia_of_links", source=Citation(_STATICS))
        yield from material.worked("inertia_loads")
    yield words.paragraph("driven_reactions")
    yield from material.equations("joint_forces")
    yield from material.equations("driver_force")
    keys = material.nonzero(
        "driver_force", "driver_torque", "driver_power", "joint_force", "axial_force", "normal_force", "normal_moment"
    )
    yield from material.table("reactions", keys, label="reactions")
    yield from material.figures("joint_forces")


def quality(material: Material) -> Iterator[Block]:
    """Yield the section about range, ends, time ratio, transmission and pressure angles."""
    blocks = [*_range(material), *_ends(material), *_transmission(material)]
    if blocks:
        yield material.words.heading("quality")
        yield from blocks


def _range(material: Material) -> Iterator[Block]:
    """Yield the range of a crank that does not turn fully, and the travel of its links, on branch and circuit."""
    words, summary = material.words, material.summary
    if "crank_range" not in summary:
        return
    ends = {name: words.amount(summary[f"crank_range_{name}"], "deg") for name in ("start", "end")}
    yield words.paragraph("crank_range", value=words.amount(summary["crank_range"], "deg"), **ends)
    rows = []
    for kind in _TRAVEL.values():
        for key in named(summary, kind, f"{kind}_circuit"):
            name = key.partition(".")[2]
            reached = (_value(material, f"{reach}.{name}") for reach in (kind, f"{kind}_circuit"))
            row = (name, _unit(material, key), *reached)
            if row not in rows:
                rows.append(row)
    if rows:
        yield words.paragraph("reach", table=Reference("reach"))
        yield words.table("reach", ("link", "unit", "on_branch", "on_circuit"), rows, "lcrr", "reach")


def _ends(material: Material) -> Iterator[Block]:
    """Yield both ends of what slides or rocks, the way between them, and the ratio of the times of both strokes."""
    words, summary = material.words, material.summary
    rows = []
    for kind, travel in _TRAVEL.items():
        for key in named(summary, f"{kind}_min"):
            name = key.partition(".")[2]
            ends = [f"{kind}_{word}.{name}" for word in ("min", "max")]
            shown = [text for end in ends for text in (_value(material, end), _place(material, end))]
            ways = [_value(material, f"{quantity}.{name}") for quantity in (travel, "time_ratio")]
            rows.append((name, _unit(material, key), *shown, *ways))
    if not rows:
        return
    has_ratio = any(key.startswith("time_ratio.") for key in summary)
    yield words.paragraph("ends", table=Reference("ends"))
    if has_ratio:
        yield words.paragraph("time_ratio")
    angle_title = words.reached_at()
    titles: list[str | Runs] = ["link", "unit", "least", angle_title, "largest", angle_title, "travel"]
    if has_ratio:
        titles.append(words.titled("time_ratio"))
    else:
        rows = [row[:-1] for row in rows]
    yield words.table("ends", titles, rows, "lc" + "r" * (len(titles) - 2), "ends")


def _transmission(material: Material) -> Iterator[Block]:
    """Yield the extreme transmission and pressure angles, worked where they are reached, and all over the positions."""
    words, columns = material.words, material.columns
    keys = named(columns, *_ANGLES)
    if not keys:
        return
    yield words.heading("transmission", 2)
    if named(columns, "transmission_angle"):
        low, high = (words.number(angle) + "°" for angle in USUAL)
        yield words.paragraph("transmission", source=Citation(_SOURCE), low=low, high=high)
    if named(columns, "pressure_angle"):
        yield words.paragraph("pressure", source=Citation(_SOURCE), limit=words.number(USUAL_PRESSURE) + "°")
    yield from _worst(material)
    yield from material.table("transmission_angles", keys)


def _worst(material: Material) -> Iterator[Block]:
    """Yield the extreme angles, each worked where it is reached, and all of them in a table."""
    words = material.words
    extremes = [(key, extreme_of(material.results, key)) for key in worst_angles(material.results)]
    if not extremes:
        return
    yield words.paragraph("worst_angles")
    for key, extreme in extremes:
        if extreme is not None:
            symbol, place, unit = words.place(extreme.at)
            name, value = key.partition(".")[2], _with_unit(place, unit, words)
            yield words.paragraph("worst_angle", name=name, place=symbol, value=value)
            lines = [line for line in material.lines("transmission") if line.key in (extreme.key, key)]
            yield from equations(lines, words)
    yield _limits(material)


def _limits(material: Material) -> Table:
    """Return the extreme angles of every pin and slider, each with where it is reached."""
    words, summary = material.words, material.summary
    kinds = [angle_kind for angle_kind in WORST_ANGLES if named(summary, angle_kind)]
    names = dict.fromkeys(key.partition(".")[2] for key in named(summary, *kinds))
    rows = [
        (
            name,
            *(text for end in kinds for text in (_value(material, f"{end}.{name}"), _place(material, f"{end}.{name}"))),
        )
        for name in names
    ]
    angles = [title for kind in kinds for title in (words.titled(kind, "deg"), words.reached_at())]
    return words.table("limits", ("transmitting", *angles), rows, "l" + "r" * len(angles), "limits")


def _value(material: Material, key: str) -> str:
    summary = material.summary
    return material.words.number(displayed(key, summary[key])) if key in summary else _NONE


def _unit(material: Material, key: str) -> str:
    return printed_unit(key_unit(key), material.words.language)


def _place(material: Material, key: str) -> str:
    """Return the crank angle or time at which an extreme is reached."""
    extreme = extreme_of(material.results, key)
    return _NONE if extreme is None else material.words.number(material.words.place(extreme.at)[1], digits=4)


def _with_unit(value: float, unit: str, words: Words) -> str:
    return words.number(value) + ("°" if unit == "deg" else f"\u00a0{printed_unit(unit, words.language)}")


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


Section = Callable[[Material], Iterator[Block]]
_SECTIONS: dict[str, Section] = {
    "task": task, "structure": structural_analysis, "kinematics": kinematics, "quality": quality,
    "chambers": chambers, "forces": forces, "balance": balance, "reduction": reduction, "torques": torques,
    "friction": friction, "bearings": bearings, "harmonics": harmonics, "motor": motor, "flywheel": flywheel,
    "law_of_motion": law_of_motion, "transient": transient, "comparison": comparison, "checks": checks,
    "conclusion": conclusion, "sources": sources, "appendix": appendix,
}  # fmt: skip
# a driver with a law of its own needs a torque or force at every moment, and no flywheel
_DRIVEN = {"task": driven_task, "kinematics": driven_motion, "forces": driven_forces}
_NOT_DRIVEN = (
    "balance", "reduction", "torques", "bearings", "harmonics", "motor", "flywheel", "law_of_motion", "transient",
)  # fmt: skip
# the tables keep the numbers that courses of machines give them
_OF_TABLE: dict[str, Section] = {
    "task": table_task, "static": static, "dynamic": dynamic, "driving": driving, "comparison": comparison,
    "checks": checks, "conclusion": conclusion, "sources": sources,
}  # fmt: skip


def linkage_note(results: Results, options: NoteOptions) -> Note:
    """Return the note of a linkage, or of a table of transfer functions (artobolevsky_1988, ch. 2-16)."""
    material = Material(results, options)
    sections, order, title = _SECTIONS, list(_SECTIONS), "linkage"
    if results.has_positions:
        sections, order, title = _OF_TABLE, list(_OF_TABLE), "tabulated"
    elif results.period:
        sections = {**_SECTIONS, **_DRIVEN, **dict.fromkeys(_NOT_DRIVEN, _no_section)}
    elif options.order == "en":
        # engineers who read English want the results before the way to them
        order = ["task", "conclusion", *(name for name in order if name not in ("task", "conclusion"))]
    words = material.words
    return note_of_sections(material, sections, tuple(order), words.title(title), words.title("linkage_subtitle"))


def _no_section(_: Material) -> Iterator[Block]:
    """Yield no blocks: a section that such a machine does not have."""
    yield from ()
