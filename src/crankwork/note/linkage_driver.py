"""What the note of a linkage says of a driver that follows a law over time: its task, its law, what it has to give."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from crankwork.locale import say
from crankwork.mechanism.driver import Cylinder, DrivingSlider, Law, LinkMotor, Segment
from crankwork.mechanism.mechanism import Driver
from crankwork.note.document import Block, Citation, Paragraph, Reference, Table
from crankwork.note.linkage_data import given_parts, method
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_motion import ACCELERATING, MOVING, instant_centres, positions
from crankwork.note.words import Words, named
from crankwork.report.language import key_unit

_SOURCE = "artobolevsky_1988, ch. 4"
_STATICS = "artobolevsky_1988, ch. 13"
_COORDINATE = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration",
)  # fmt: skip


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
    yield words.paragraph("driven_positions", source=Citation(_SOURCE))
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
