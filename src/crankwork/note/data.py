"""The task of a note: what was given of a machine, and how it is computed."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace

from crankwork.analysis.input_loads import ChamberInput, LoadInput, stated_chambers, stated_charges, stated_loads
from crankwork.formula.traced_value import Input, Node, in_order
from crankwork.locale import translate
from crankwork.machine import Bearings, Engine, TransferTable
from crankwork.mechanism.driver import Cylinder, DrivingSlider, Law, LinkMotor
from crankwork.mechanism.linkage import Member
from crankwork.mechanism.mechanism import Crank, Driver
from crankwork.mechanism.structure import links_of
from crankwork.note.document import Block, Cell, Figure, ItemList, Math, Paragraph, Reference, Runs, Table
from crankwork.note.material import Material
from crankwork.note.parts import (
    Head,
    Lines,
    Section,
    Text,
    When,
    drawn,
    driven,
    every,
    full,
    has,
    has_torques,
    lacks,
    machine_has,
    school,
)
from crankwork.note.symbols import subscript
from crankwork.note.table_width import is_narrow
from crankwork.note.tables import Column, position_tables, value_row, value_table
from crankwork.note.wording import Words, in_display_unit
from crankwork.quantities import SUBJECTS
from crankwork.quantities.quantity import number_of
from crankwork.report.display import key_unit, link_label
from crankwork.report.drawing import crank_gear_scheme
from crankwork.report.sketch import Length
from crankwork.report.summary import results_method
from crankwork.units import to_si

GEAR = ("rotational_speed", "angular_acceleration", "stroke", "crank_radius", "rod_length", "rod_ratio", "offset")
_SIZES = (
    ("bearing_diameter", "crankpin_diameter", "crankpin"), ("bearing_length", "crankpin_length", "crankpin"),
    ("bearing_diameter", "main_diameter", "main_journal"), ("bearing_length", "main_length", "main_journal"),
    ("bearing_diameter", "pin_diameter", "small_end"), ("bearing_length", "pin_length", "small_end"),
)  # fmt: skip
_OF_ROD = ("rod_mass", "small_end_share", "rod_centre_distance", "rod_inertia", "rod_gyration_radius")
_ELSEWHERE = ("cylinder_count", "displacement")


_PAIR, _MOST_JOINTS = 2, 3
_MINUS = "\N{MINUS SIGN}"
# torques on a shaft: table of the file, sentence, quantity, and how many points of one are listed
_ACTING = (("torque", "drives", "turning_moment"), ("load", "resists", "load_torque"))
_MOST_POINTS = 60


def _given(material: Material) -> Iterator[Block]:
    """Yield the table of the input data, beside it the crank gear with the senses of its angles and forces."""
    yield material.words.paragraph("data", table=Reference("t:data"))
    if not material.options.figures or "piston_force" not in material.results.columns:
        yield value_table("data", _rows(material), material.words)
        return
    title, language = material.words.title("scheme"), material.words.language
    half = is_narrow(table := value_table("data", _rows(material), material.words, parts=1))
    scheme = crank_gear_scheme(title, language)
    yield material.words.paragraph("scheme_drawn", figure=Reference("f:scheme"))
    yield Figure(scheme, title, translate("seen.scheme", language), label="f:scheme", half=half)
    yield replace(table, half=half)


def _how(material: Material) -> Iterator[Block]:
    """Yield method, constants that are not those of everybody, crank-to-rod ratios, and conventions."""
    words, results = material.words, material.results
    pi, gravity = results.method.pi, results.method.gravity
    method = [results_method(results, words.language)]
    if material.full or pi != math.pi:
        method.append(f"π = {words.number(pi, digits=9 if pi == math.pi else 6)}")
    if material.full or "weight_force" in results.columns:
        method.append(f"g = {words.amount(gravity, 'm/s2')}")
    used, ratio = results.method.inertia_rod_ratio, results.summary["rod_ratio"]
    sentences = list(words.sentence("method", method=", ".join(method)))
    if used is not None and not results.method.is_exact:
        sentences += [" ", *words.sentence("two_ratios", used=words.number(used), ratio=words.number(ratio))]
    yield Paragraph((*sentences, " ", *words.sentence("conventions")))


def _rows(material: Material) -> Iterator[tuple[Cell, ...]]:
    """Yield the rows of the input data."""
    words, machine = material.words, material.machine
    # values calculated from them are in the equations after the table
    known = {value.key: value.value for value in in_order(material.results.trace.values()) if _is_stated(value.node)}
    if "crank_radius" in known:
        known.pop("stroke", None)
    known |= {"rotational_speed": machine.speed, "angular_acceleration": machine.angular_acceleration}
    known |= {"offset": material.summary.get("offset", 0.0)}
    for key in GEAR:
        if known.get(key):
            yield value_row(key, known[key], words)
    yield from _cylinder(material)
    yield from _masses(material)
    if machine.gas is not None:
        yield value_row("cycle_angle", math.radians(machine.gas.cycle), words)
        if machine.gas.is_absolute:
            yield value_row("ambient_pressure", machine.gas.ambient, words)
        for point in [point for point in machine.gas.points.values() if point.inputs][:1]:
            yield value_row("listed_pressure_unit", point.inputs[1].node.operands[1].value, words)
    engine = machine.engine
    if engine is not None:
        yield from _engine(engine, words) if len(engine.layout.places) > 1 else ()
        yield from _sizes(engine.bearings, words)
        if machine.drive.fluctuation is not None:
            yield value_row("speed_fluctuation", machine.drive.fluctuation, words)


def _is_stated(node: Node) -> bool:
    return isinstance(node, Input) and bool(node.path) and not node.is_absent


def _cylinder(material: Material) -> Iterator[tuple[Cell, ...]]:
    cylinder = material.machine.cylinder
    if cylinder is not None:
        for key in ("bore", "clearance_volume", "compression_ratio", "inclination"):
            value = getattr(cylinder, key)
            if value:
                yield value_row(key, value, material.words)


def _masses(material: Material) -> Iterator[tuple[Cell, ...]]:
    masses = material.machine.masses
    if masses is not None:
        rod = _rod(material) or {
            "rod_small_end_mass": masses.rod_small_end,
            "rod_big_end_mass": masses.rod_big_end,
            "rod_inertia_excess": masses.rod_inertia_excess,
        }
        parts = {"piston_mass": masses.piston, **rod, "crank_mass": masses.crank}
        area = material.summary.get("piston_area") if material.per_area else None
        yield from (value_row(key, value, material.words, area=area) for key, value in parts.items() if value)


def _rod(material: Material) -> dict[str, float]:
    """Return the mass of the rod and its centre, for a rod whose parts follow from them."""
    trace = material.results.trace
    behind = in_order([trace[key] for key in ("reciprocating_mass", "correction_couple") if key in trace])
    known = {traced.key: traced.value for traced in behind if traced.key in _OF_ROD and isinstance(traced.value, float)}
    if "small_end_share" in known:
        known.pop("rod_centre_distance", None)
    return {key: known[key] for key in _OF_ROD if key in known} if "rod_mass" in known else {}


def _engine(engine: Engine, words: Words) -> Iterator[tuple[Cell, ...]]:
    layout = engine.layout
    yield value_row("cylinder_count", float(len(layout.places)), words)
    yield (words.term("arrangement"), "–", words.kind(layout.kind), "–")
    yield (words.term("order"), "–", "–".join(map(str, layout.firing_order)), "–")


def _sizes(bearings: Bearings, words: Words) -> Iterator[tuple[Cell, ...]]:
    for key, name, part in _SIZES:
        value = getattr(bearings, name)
        if value is not None:
            yield value_row(f"{key}.{part}", value, words)


def cycle_keys(material: Material) -> list[str]:
    """Return the keys of the inputs of the working cycle: its values without a line."""
    given = {row.key for row in SUBJECTS["cycle"]} - {line.key for line in material.cycle}
    return [key for key in material.summary if key in given and key not in _ELSEWHERE]


def _task(material: Material) -> Iterator[Block]:
    """Yield the task and the given data."""
    words, machine = material.words, material.machine
    crank = machine.mechanism.crank
    yield words.paragraph("task_partial" if words.is_partial else "task")
    (turning,) = words.sentence("clockwise" if crank.direction < 0 else "anticlockwise")
    yield words.paragraph(
        "crank",
        radius=words.amount(crank.radius, "mm"),
        direction=turning,
        start=words.amount(crank.start, "deg"),
        value=words.amount(material.results.solved.speed, "rad/s", digits=material.digits),
    )
    for geared in crank.geared:
        yield words.paragraph("geared_crank", name=words.part(geared.link), ratio=words.number(geared.ratio))
    if machine.angular_acceleration:
        yield words.paragraph("acceleration", value=words.amount(machine.angular_acceleration, "rad/s2"))
    yield from _parts(material)
    if machine.drive.inertia:
        yield words.paragraph("drive_inertia", value=words.amount(machine.drive.inertia, "kg*m2"))
    if machine.drive.fluctuation is not None:
        yield words.paragraph("fluctuation", value=words.number(machine.drive.fluctuation))


def _method(material: Material) -> Iterator[Block]:
    """Yield the paragraph that says how everything is computed."""
    results, words = material.results, material.words
    values = {
        "method": results_method(results, words.language),
        "pi": words.number(results.method.pi, digits=9 if results.method.pi == math.pi else 6),
    }
    before = (*words.sentence("linkage_computed"), " ") if material.machine.linkage is not None else ()
    yield Paragraph((*before, *words.sentence("linkage_method", **values)))


def _parts(material: Material) -> Iterator[Block]:
    """Yield tables of the links, the fixed points and the guides, then loads and chambers."""
    words, machine = material.words, material.machine
    yield _links(material)
    yield from _places(material)
    if machine.loads:
        yield words.paragraph("outer_loads")
        yield ItemList(tuple(_outer_load(load, words) for load in stated_loads(machine)))
    elif machine.mechanism.bodies and not machine.chambers:
        yield words.paragraph("no_loads")
    yield from _chambers(material)


def _links(material: Material) -> Table:
    """Return links and sliding pieces with their masses."""
    words, linkage = material.words, material.machine.drawn
    owners = linkage.owners
    rows = []
    numbers = {name: number for number, name in enumerate(links_of(linkage), start=1)}
    driving = (linkage.driving, *linkage.geared) if linkage.driving.centre or linkage.driving.guide else linkage.geared
    if isinstance(linkage.driver, Crank):
        # its pin and pivot are points of the driver
        pivot = next((name for name, place in linkage.ground.items() if place == linkage.driver.pivot), "")
        ends = {pivot: (0.0, 0.0), linkage.driver.pin: (linkage.driver.radius, 0.0)}
        points = {name: place for name, place in ends.items() if name} | dict(linkage.driving.points)
        driving = (replace(linkage.driving, name=linkage.driver.link, points=points), *linkage.geared)
    for member in (*driving, *linkage.members):
        if member.name == linkage.driver.link and member not in driving:
            continue
        number = numbers[member.name]
        shared = [name for name in member.points if len({*owners[name], member.name}) > 1]
        rows.append((
            str(number), link_label(member.name, words.language), ", ".join(shared), _length(member, shared, words),
            words.shown("body_mass", member.mass) if member.mass else "–",
            words.shown("body_inertia", member.inertia) if member.inertia else "–", _centre(member, words),
        ))  # fmt: skip
    masses = (words.titled(key) for key in ("body_mass", "body_inertia"))
    length, centre = ((words.column(name, "mm"),) for name in ("length", "centre"))
    return words.table("links", ("number", "link", "joints", length, *masses, centre), rows, "clcrrrc", "links")


def link_lengths(material: Material) -> list[Length]:
    """Return the lengths of the crank and of links with two joints."""
    words, linkage = material.words, material.machine.drawn
    pairs = [[name for name in member.points if len(linkage.owners[name]) > 1] for member in linkage.members]
    lengths = [Length(shared[0], shared[1], _length(member, shared, words)) for member, shared in
               zip(linkage.members, pairs, strict=True) if len(shared) == _PAIR and not member.guide]  # fmt: skip
    if isinstance(linkage.driver, Crank):
        pivot = next((name for name, place in linkage.ground.items() if place == linkage.driver.pivot), "O")
        lengths.insert(0, Length(pivot, linkage.driver.pin, words.shown("point_x", linkage.driver.radius)))
    return lengths


def fixed_distances(material: Material) -> list[Length]:
    """Return the distances of fixed pivots from that of the crank along both axes."""
    words, linkage = material.words, material.machine.drawn
    if not isinstance(linkage.driver, Crank):
        return []
    pivot = next((name for name, place in linkage.ground.items() if place == linkage.driver.pivot), "")
    joined = [name for name in linkage.ground if name != pivot and len(linkage.owners.get(name, ())) > 1]
    return [
        Length(pivot, name, words.shown("point_x", abs(away)), axis)
        for name in joined if pivot for axis in (0, 1)
        if (away := linkage.ground[name][axis] - linkage.driver.pivot[axis])
    ]  # fmt: skip


def _length(member: Member, shared: list[str], words: Words) -> str:
    """Return the distances of the joints of a link: `600`, or `AB 100; BC 200` where there are more than two."""
    pairs = [(a, b) for i, a in enumerate(shared) for b in shared[i + 1 :]] if len(shared) <= _MOST_JOINTS else []
    spans = [(a, b, math.dist(member.points[a], member.points[b])) for a, b in pairs]
    if member.guide or not spans:
        return "–"
    if len(spans) == 1:
        return words.shown("point_x", spans[0][2])
    return "; ".join(f"{a}{b} {words.shown('point_x', span)}" for a, b, span in spans)


def _centre(member: Member, words: Words) -> str:
    if not member.centre:
        return "–"
    # the centre of a crank may be its pivot
    x, y = (words.shown("point_x", coordinate) for coordinate in member.points.get(member.centre, (0.0, 0.0)))
    named = "" if "." in member.centre or "_" in member.centre else f"{member.centre} "
    return f"{named}({x}; {y})"


def _places(material: Material) -> Iterator[Block]:
    """Yield fixed points and guides."""
    words, linkage = material.words, material.machine.drawn
    places = [
        f"{name} ({words.shown('point_x', x)}; {words.shown('point_y', y)})" for name, (x, y) in linkage.ground.items()
    ]
    axes = (words.titled("point_x"), words.titled("point_y"))
    if places:
        yield words.paragraph("fixed_points", unit=words.unit("point_x"), points=", ".join(places))
    lines = [
        (
            link_label(name, words.language), words.part(guide.link) if guide.link else words.term("ground"),
            *(words.shown("point_x", value) for value in guide.point),
            words.number(math.degrees(guide.angle)),
        )
        for name, guide in linkage.guides.items()
    ]  # fmt: skip
    if lines:
        yield words.table("guides", ("guide", "carrier", *axes, "angle"), lines, "ccrrr")


def _outer_load(load: LoadInput, words: Words) -> Runs:
    """Return a load in words."""
    amounts = {
        name: "…" if value is None else words.amount(value, unit) for name, (value, unit) in load.amounts.items()
    }
    parts = {key: words.part(name) for key, name in load.names.items()}
    return words.sentence(f"load_{load.kind}", **parts, **amounts)


def _chambers(material: Material) -> Iterator[Block]:
    """Yield the chambers as they are given, and the gas sealed in them."""
    words = material.words
    given = stated_chambers(material.machine)
    if not given:
        return
    rows = [tuple(_of_chamber(chamber, material)) for chamber in given]
    sizes = (words.titled(key) for key in ("piston_area", "clearance_volume", "ambient_pressure"))
    yield words.table("chambers", ("chamber", "faces", *sizes, "gas"), rows, "llrrrl")
    for charge in stated_charges(material.machine):
        dead = "; ".join(_amount(volume, temperature, words) for volume, temperature in charge.dead_volumes) or "–"
        parts = {"name": charge.name, "chambers": ", ".join(map(number_of, charge.chambers)), "dead": dead}
        if charge.exponent is None:
            yield words.paragraph("charge_given", **parts)
        else:
            yield words.paragraph("charge_polytrope", exponent=words.number(charge.exponent), **parts)


def _of_chamber(chamber: ChamberInput, material: Material) -> Iterator[str]:
    """Yield name, faces, areas, clearance, pressure around, and what gives the pressure of a chamber."""
    words, results = material.words, material.results
    yield words.part(chamber.name)
    yield ", ".join(f"{words.part(slider)} ({'+' if sense > 0 else _MINUS})" for slider, sense in chamber.faces)
    keys = [f"piston_area.{owner}" for owner in chamber.owners]
    yield "; ".join(words.shown(key, results.value(key), digits=material.digits) for key in keys)
    yield words.number(
        in_display_unit("clearance_volume", [results.summary.get(f"clearance_volume.{chamber.name}", 0.0)])[0]
    )
    # of gauge pressures the ambient pressure is not known
    yield words.number(in_display_unit("ambient_pressure", [chamber.ambient])[0]) if chamber.ambient else "–"
    amounts = {
        name: words.amount(value, unit, digits=material.digits) for name, (value, unit) in chamber.amounts.items()
    }
    pressure = translate(f"sentences.of_{chamber.kind}", words.language, **chamber.names, **amounts)
    if chamber.delay:
        pressure = translate(
            "sentences.of_later", words.language, text=pressure, delay=words.amount(chamber.delay, "deg")
        )
    if chamber.factor != 1:
        pressure = translate("sentences.of_factor", words.language, text=pressure, factor=words.number(chamber.factor))
    yield pressure


def _amount(volume: float, temperature: float | None, words: Words) -> str:
    shown = words.amount(volume, "cm3")
    return shown if temperature is None else f"{shown} ({words.amount(temperature, 'K')})"


def _driven(material: Material) -> Iterator[Block]:
    """Yield the task and the given data, the law of the driver first."""
    words, machine = material.words, material.machine
    driver = machine.mechanism.driver
    yield _drives(driver, words)
    for name, half in zip(("barrel", "rod"), machine.mechanism.halves, strict=False):
        if half.mass:
            along, across = (words.amount(coordinate, "mm") for coordinate in half.centre)
            amounts = {"mass": words.amount(half.mass, "kg"), "inertia": words.amount(half.inertia, "kg*m2")}
            yield words.paragraph(f"cylinder_{name}", **amounts, along=along, across=across)
    if driver.law is not None:
        period = words.amount(driver.law.period, "s")
        yield words.paragraph("driver_law", period=period, table=Reference("t:law"))
        yield _segments(driver.law, words, turns=driver.turns)
    yield from _parts(material)
    yield from _method(material)


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
            str(number),
            words.kind(segment.kind) if isinstance(segment.kind, str) else translate("memory.own_law", words.language),
            *(words.shown(key, place) for place in ends),
            words.number(sum(times[: number - 1])), words.number(times[number - 1]),
        )
        for number, (segment, ends) in enumerate(zip(law.segments, itertools.pairwise(places), strict=True), start=1)
    ]  # fmt: skip
    ends = ((words.column(name, key_unit(key)),) for name in ("law_from", "law_to"))
    times_of = (words.titled(title) for title in ("start_time", "segment_time"))
    return words.table("law", ("number", "motion_law", *ends, *times_of), rows, "clrrrr", "t:law")


def _table(material: Material) -> Iterator[Block]:
    """Yield the task, the masses, and the transfer functions."""
    words, table = material.words, material.machine.transfer
    if table is None:
        return
    yield words.paragraph("table_speed", value=words.amount(material.results.solved.speed, "rad/s"))
    yield words.paragraph("bodies")
    yield ItemList(tuple(_body(table, index, words) for index in range(len(table.bodies))))
    ratios = list(_ratios(table, words))
    yield from position_tables(
        "table_transfer", material.results.grid.degrees, ratios, words, first=1, label="t:transfer"
    )
    yield from _method(material)


def _body(table: TransferTable, index: int, words: Words) -> Runs:
    body = table.bodies[index]
    mass, inertia = Math(words.symbol(f"body_mass.{body.name}")), Math(f"J_{subscript(body.name)}")
    runs: list[str | Math] = [f"{body.name}: "]
    if body.mass:
        runs += [mass, f" = {words.amount(body.mass, 'kg')}"]
    if body.inertia:
        runs += [", " if body.mass else "", inertia, f" = {words.amount(body.inertia, 'kg*m2')}"]
    return tuple(runs)


def _ratios(table: TransferTable, words: Words) -> Iterator[Column]:
    """Yield the columns of the table, in metres and without a unit, as the formulas take them."""
    count = len(table.angles)
    for body in table.bodies:
        for key, unit, ratios in (
            ("velocity_ratio", "m", body.velocity_ratio),
            ("rotation_ratio", "", body.rotation_ratio),
        ):
            if any(ratios):
                values = ratios if len(ratios) > 1 else ratios * count
                yield Column(words.titled(f"{key}.{body.name}", unit), [words.number(value) for value in values])


# what is calculated from a table of data alone
_TABULAR = ("test", "clutch")


def _stated_rows(material: Material) -> dict[str, tuple[Cell, ...]]:
    """Return the rows of numbers that are given, by key."""
    traced = [value for value in in_order(material.results.trace.values()) if _is_stated(value.node) and value.key]
    known = {
        value.key: to_si(value.value, value.node.unit)
        if isinstance(value.node, Input) and value.node.unit
        else value.value
        for value in traced
    }
    return {key: value_row(key, value, material.words, digits=material.digits) for key, value in known.items()}


def _stated(material: Material) -> Iterator[Block]:
    """Yield the table of the numbers that are given of stages."""
    yield value_table("data", _stated_rows(material).values(), material.words)


def _planes(material: Material) -> Iterator[Block]:
    """Yield the task, the masses in their planes as they are given, and the other numbers that are given."""
    words, rotor = material.words, material.machine.rotor
    if rotor is None:
        return
    columns = {
        key: [_of_mass(material, index, key) for index in range(len(rotor.masses))]
        for key in ("mass", "reciprocating", "radius", "moment", "angle", "position")
    }
    columns = {key: entries for key, entries in columns.items() if any(entry != "–" for entry in entries)}
    names = [link_label(mass.name, words.language) for mass in rotor.masses]
    titles: list[str | Runs] = ["row", *(words.titled(f"plane_{key}") for key in columns)]
    data = [row for key, row in _stated_rows(material).items() if not key.startswith("plane_")]
    task = words.sentence("masses_listed", count=str(len(names)), table=Reference("t:masses"))
    task += (" ", *words.sentence("others_listed", table=Reference("t:data"))) if data else ()
    yield Paragraph((*task, " ", *words.sentence("masses_wanted" if rotor.wanted else "masses_left")))
    rows = list(zip(names, *columns.values(), strict=True))
    yield words.table("given_masses", titles, rows, "l" + "r" * len(columns), "t:masses")
    if data:
        yield value_table("data", data, words)


def _of_mass(material: Material, index: int, key: str) -> str:
    """Return a value of a mass in a plane, a question mark where it is wanted."""
    rotor = material.machine.rotor
    if rotor is None:
        return ""
    mass, wanted = rotor.masses[index], rotor.wanted
    value = getattr(mass, key)
    if value or (value is not None and key != "reciprocating"):
        return material.words.shown(f"plane_{key}", value)
    sizes = ("mass", "radius") if mass.mass or mass.radius else () if mass.sector else ("moment",)
    return "?" if (key, index) in wanted or (key in sizes and ("size", index) in wanted) else "–"


def _shaft(material: Material) -> Iterator[Block]:
    """Yield the task and the given data."""
    words, machine = material.words, material.machine
    turning = machine.turning
    if turning is None:
        return
    yield words.paragraph("task_turning", cycle=words.amount(turning.cycle, "deg"))
    yield words.paragraph("table_speed", value=words.amount(material.results.solved.speed, "rad/s"))
    for table, verb, key in _ACTING:
        diagram = turning.diagrams.get(table)
        if diagram is None:
            yield words.paragraph(f"{verb}_mean")
            continue
        yield words.paragraph(verb, period=words.amount(diagram.period, "deg"))
        yield ItemList(tuple(_items(material, table)))
        if 0 < len(diagram.points) <= _MOST_POINTS:
            yield _points(material, table, key)
    yield from _method(material)


def _items(material: Material, table: str) -> Iterator[Runs]:
    """Yield the terms of a torque, in words."""
    words, turning = material.words, material.machine.turning
    diagram = turning.diagrams[table] if turning is not None else None
    if diagram is None:
        return
    if diagram.constant:
        yield words.sentence("item_constant", torque=words.amount(diagram.constant, "N*m"))
    if diagram.points:
        yield words.sentence("item_points", count=str(len(diagram.points)))
    for order, sine, cosine in diagram.harmonics:
        sine_, cosine_ = (words.amount(amplitude, "N*m") for amplitude in (sine, cosine))
        yield words.sentence("item_order", order=words.number(order), sine=sine_, cosine=cosine_)
    for stroke in diagram.strokes:
        values = {"work": words.amount(stroke.work, "J"), "start": words.amount(stroke.start, "deg")}
        if stroke.over:
            shape = words.phrase(f"shape_{stroke.shape}")
            yield words.sentence("item_stretch", over=words.amount(stroke.over, "deg"), shape=shape, **values)
        else:
            yield words.sentence("item_blow", **values)
    if diagram.loops:
        shown = "; ".join(words.amount(loop, "J") for loop in diagram.loops)
        yield words.sentence("item_loops", works=shown)
    if diagram.excess is not None:
        yield words.sentence("item_excess", work=words.amount(diagram.excess, "J"))
    if len(diagram.delays) > 1:
        delays = ", ".join(words.number(math.degrees(delay)) for delay in diagram.delays)
        yield words.sentence("item_cylinders", count=str(len(diagram.delays)), delays=delays)


def _points(material: Material, table: str, key: str) -> Table:
    """Return the points of a torque."""
    words, turning = material.words, material.machine.turning
    points = turning.diagrams[table].points if turning is not None else ()
    rows = [(words.number(math.degrees(angle)), words.shown(key, torque)) for angle, torque in points]
    return words.table("points_of_torque", (words.titled("crank_angle"), words.titled(key)), rows, "rr")


_SHEETS = When(lambda material: material.options.sheets, (Text("sheets"),))
SECTIONS = (
    Section("preface", (Head("preface"), Text("preface")), has("piston_displacement")),
    Section("data", (
        Head("data"), _given, When(lacks(school("en")), (_how,)),
        When(full, (Lines("geometry", intro="geometry"),)), Lines("geometry"),
        Lines("speed", ("speed", "mean_piston_speed")),
        When(lambda material: material.results.solved.space is None, (Lines("gas", intro="volumes"),)),
    ), has("piston_displacement")),
    Section("method", (Head("method"), _how), has("piston_displacement")),
    Section("task", (Head("task"), _shaft), has_torques),
    Section("task", (Head("task"), _planes), machine_has("rotor")),
    Section("task", (Head("task"), Text("task_given"), _stated), lambda material: material.machine.alone in _TABULAR),
    Section("task", (Head("task"), Text("task_stages"), _stated, _method), every(machine_has("stages"), lacks(drawn))),
    Section("task", (Head("task"), Text("task_table"), _table, _SHEETS), machine_has("transfer")),
    Section("task", (Head("task"), Text("driven_task"), _driven), driven),
    Section("task", (Head("task"), _task, _method, _SHEETS), machine_has("linkage")),
)  # fmt: skip
