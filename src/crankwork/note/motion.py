"""Structure, motion and quality in a note: of a piston, of links and sliders, of what drives them by a law."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from crankwork.analysis.mechanism import four_bar_type
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.sampled_motion import transfer_ratios
from crankwork.analysis.skeleton import skeleton
from crankwork.analysis.transmission_quality import USUAL, USUAL_PRESSURE
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.dyads import Chain
from crankwork.mechanism.joints import Pin, group_links, joints, pivots_of
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.structure import ROMAN
from crankwork.note.captions import printed_unit
from crankwork.note.closing import errors
from crankwork.note.document import Block, Citation, Reference, Run, Runs, Table
from crankwork.note.lines import WORST_ANGLES, extreme_of, worst_angles
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
    drawn,
    draws,
    driven,
    either,
    every,
    full,
    has,
    in_full,
    lacks,
)
from crankwork.note.tables import Column, folded, tabulated
from crankwork.note.vector_equations import has_vector_equations, vector_plans
from crankwork.note.wording import named
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit, link_label

_NOUNS = ("piston_displacement", "piston_velocity", "piston_acceleration")
_ROD = ("rod_angle", "rod_angular_velocity", "rod_angular_acceleration")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine", "rod_angle")
_ORDERS = ("_first_order", "_second_order")
_MOVING = ("point_velocity", "link_angular_velocity", "slider_velocity")
_ACCELERATING = ("point_acceleration", "link_angular_acceleration", "slider_acceleration")
_CENTRES, _POSITIONS = "khurmi_gupta_2005, ch. 6", "artobolevsky_1988, ch. 4"
_COORDINATE = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration", "driver_jerk", "driver_angular_jerk",
)  # fmt: skip
_SOURCE = "norton_2012, ch. 4"
_TRAVEL = {"slider_displacement": "slider_stroke", "link_angle": "link_swing"}
_ANGLES = ("transmission_angle", "pressure_angle")
_NONE = "–"


def _orders(*kinds: str) -> tuple[str, ...]:
    """Return the parts of first and second order of quantities."""
    return tuple(f"{kind}{order}" for kind in kinds for order in _ORDERS)


def _of_piston(noun: str) -> Over:
    """Return the table of one of displacement, velocity, acceleration with its first two orders."""
    key = f"piston_{noun}"
    return Over(noun, (*_orders(key), key), one_turn=True)


def _largest_errors(material: Material) -> Iterator[Block]:
    """Yield how far the method is from exact; nothing if it is exact."""
    largest = errors(material)
    values: dict[str, Run] = {"table": Reference("t:errors")}
    for sentence, key in (("error", "piston_acceleration_error"), ("force_error", "inertia_force_error")):
        if key in largest:
            share = material.words.number(100 * largest[key][1], digits=2)
            yield material.words.paragraph(sentence, share=share, **values)
        values = {}


def _positions(material: Material) -> Iterable[str]:
    """Return the columns that say where points, links and sliders are; the main ones leave out pin and centres."""
    shape = skeleton(material.machine.mechanism)
    known = () if material.full else (shape.pin, *shape.centres)
    points = [key for key in material.of_axes("point") if key_of(key).owner not in known]
    return [*points, *named(material.columns, "link_angle", "slider_displacement")]


def _transfer(material: Material) -> Iterator[Block]:
    """Yield velocities of points and sliders and angular velocities of links, over that of the crank."""
    words = material.words
    ratios = transfer_ratios(material.machine.mechanism, material.positions)
    columns = [
        Column(
            words.titled(key, "m") if key.startswith("velocity_ratio.") else words.titled(key),
            words.column_texts(values.tolist()),
        )
        for key, values in without_rounding(ratios, 1.0).items()
    ]
    return tabulated(material, "transfer", columns, "transfer")


_MOST = ("piston_velocity_max_angle", "piston_velocity_max", "piston_velocity_min")
_OF_RODS = Over("rod", _ROD, one_turn=True)
_EXACT_ORDERS = When(
    lambda material: (
        material.results.method.is_exact and "piston_acceleration_second_order" in material.results.columns
    ),
    (Text("exact_orders"),),
)
_REPEATS, _EXTREMES = Text("repeats"), Lines("extremes", intro="extremes")
# where links turn about that have no fixed pivot
_INSTANT_CENTRES = When(lambda material: material.full and bool(material.of_axes("instant_centre")), (
    Head("instant_centres", 2), Text("instant_centres", {"source": Citation(_CENTRES)}), At("instant_centres"),
    Lines("instant_centres"), Places("instant_centres", lambda material: material.of_axes("instant_centre")),
))  # fmt: skip
_OF_PIN = {"along": "x₁ + ξ₁ cos φ₁ − η₁ sin φ₁ = x₂ + ξ₂ cos φ₂ − η₂ sin φ₂",
           "across": "y₁ + ξ₁ sin φ₁ + η₁ cos φ₁ = y₂ + ξ₂ sin φ₂ + η₂ cos φ₂"}  # fmt: skip
# how groups are solved that are no dyads
_LOOPS = When(
    lambda material: any(isinstance(group, Chain) for group in material.machine.mechanism.dyads),
    (Text("loop_equations", _OF_PIN),),
)
_POLYGONS: tuple[Part, ...] = (Head("polygons", 2), Text("plan_numbers", {"table": Reference("links")}))


def _structure(material: Material) -> Iterator[Block]:
    """Yield links, joints, mobility, groups and class."""
    words, analysed = material.words, material.structure
    if analysed is None:
        return
    yield words.heading("structure")
    yield words.paragraph("structure", n=str(len(analysed.links)), p=str(analysed.joints))
    yield _pairs(material, ("", *analysed.links))
    yield words.paragraph("chebyshev")
    yield from material.equations("structure")
    yield words.paragraph("one_driver" if material.words.period else "one_drive")
    numbers = {name: str(number) for number, name in enumerate(analysed.links, start=1)}
    driver = material.machine.mechanism.driver
    if isinstance(driver, Cylinder):
        # barrel and rod stand for one link of changing length
        numbers[driver.link] += f"+{numbers[rod_name(driver.link)]}"
    kinds = {frozenset(group_links(dyad)): type(dyad).__name__ for dyad in material.machine.mechanism.dyads}
    rows = [
        (
            str(number),
            ", ".join(
                f"{numbers[name]} ({link_label(name, words.language)})" for name in group.members if name in numbers
            ),
            ROMAN[group.number],
            words.kind(kinds.get(frozenset(group.members), "")),
        )
        for number, group in enumerate(analysed.groups, start=1)
    ]
    yield words.table("groups", ("group", "members", "class", "species"), rows, "clcc")
    yield words.paragraph("formula", formula=analysed.formula.replace("->", "→"), number=ROMAN[analysed.number])
    kind = four_bar_type(material.machine)
    if kind:
        yield words.paragraph("grashof", type=words.kind(kind))


def _pairs(material: Material, links: tuple[str, ...]) -> Table:
    """Return the joints with the numbers of the links that they join."""
    words, driver = material.words, material.machine.mechanism.driver
    pivots = pivots_of(material.machine.mechanism)
    rows = []
    for number, joint in enumerate(joints(material.machine.mechanism), start=1):
        both = [joint.link, joint.other]
        if isinstance(driver, Cylinder) and isinstance(joint, Pin) and joint.point == driver.rod:
            # there the rod of the cylinder ends, not its barrel
            both = [rod_name(name) if name == driver.link else name for name in both]
        ends = sorted(0 if name == GROUND else links.index(name) for name in both)
        name = (
            (joint.point or pivots.get(joint.link, ""))
            if isinstance(joint, Pin)
            else link_label(joint.link, words.language)
        )
        kind = words.term("turning" if isinstance(joint, Pin) else "sliding")
        rows.append((str(number), name, f"{ends[0]}–{ends[1]}", kind))
    if isinstance(driver, Cylinder):
        inside = "–".join(str(links.index(name)) for name in (driver.link, rod_name(driver.link)))
        rows.append((str(len(rows) + 1), link_label(driver.link, words.language), inside, words.term("sliding")))
    return folded(words.table("pairs", ("number", "pair", "between", "kind"), rows, "cccc"), most=2, long=6)


def _quality(material: Material) -> Iterator[Block]:
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
            name = key_of(key).owner
            reached = (_value(material, f"{reach}.{name}") for reach in (kind, f"{kind}_circuit"))
            row = (words.part(name), _unit(material, key), *reached)
            if row not in rows:
                rows.append(row)
    if rows:
        yield words.paragraph("reach", table=Reference("t:reach"))
        yield words.table("reach", ("link", "unit", "on_branch", "on_circuit"), rows, "lcrr", "t:reach")


def _ends(material: Material) -> Iterator[Block]:
    """Yield both ends of what slides or rocks, the way between them, and the ratio of the times of both strokes."""
    words, summary = material.words, material.summary
    rows = []
    for kind, travel in _TRAVEL.items():
        for key in named(summary, f"{kind}_min"):
            name = key_of(key).owner
            ends = [f"{kind}_{word}.{name}" for word in ("min", "max")]
            shown = [text for end in ends for text in (_value(material, end), _place(material, end))]
            ways = [_value(material, f"{quantity}.{name}") for quantity in (travel, "time_ratio")]
            rows.append((words.part(name), _unit(material, key), *shown, *ways))
    if not rows:
        return
    has_ratio = any(key.startswith("time_ratio.") for key in summary)
    yield words.paragraph("ends", table=Reference("t:ends"))
    if has_ratio:
        yield words.paragraph("time_ratio")
    angle_title = words.reached_at()
    titles: list[str | Runs] = ["link", "unit", "least", angle_title, "largest", angle_title, "travel"]
    if has_ratio:
        titles.append(words.titled("time_ratio"))
    else:
        rows = [row[:-1] for row in rows]
    yield words.table("ends", titles, rows, "lc" + "r" * (len(titles) - 2), "t:ends")


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
    if material.full:
        yield from tabulated(material, "transmission_angles", keys)


def _worst(material: Material) -> Iterator[Block]:
    """Yield the extreme angles, each worked where it is reached, and all of them in a table."""
    words = material.words
    extremes = [(key, extreme_of(material.results, key)) for key in worst_angles(material.results)]
    if not extremes:
        return
    yield words.paragraph("worst_angles")
    for key, extreme in extremes if material.full else ():
        if extreme is not None:
            name, symbol, value = (
                words.part(key_of(key).owner),
                words.place(extreme.at)[0],
                words.place_text(extreme.at),
            )
            yield words.paragraph("worst_angle", name=name, place=symbol, value=value)
            lines = [line for line in material.lines("transmission") if line.key in (extreme.key, key)]
            yield from material.worked(lines)
    yield _limits(material)


def _limits(material: Material) -> Table:
    """Return the extreme angles of every pin and slider, each with where it is reached."""
    words, summary = material.words, material.summary
    kinds = [angle_kind for angle_kind in WORST_ANGLES if named(summary, angle_kind)]
    names = dict.fromkeys(key_of(key).owner for key in named(summary, *kinds))
    rows = [
        (
            words.part(name),
            *(text for end in kinds for text in (_value(material, f"{end}.{name}"), _place(material, f"{end}.{name}"))),
        )
        for name in names
    ]
    angles = [title for kind in kinds for title in (words.titled(kind, "deg"), words.reached_at())]
    return words.table("limits", ("transmitting", *angles), rows, "l" + "r" * len(angles), "limits")


def _value(material: Material, key: str) -> str:
    summary = material.summary
    return material.words.number(displayed(key, summary[key]), digits=material.digits) if key in summary else _NONE


def _unit(material: Material, key: str) -> str:
    return printed_unit(key_unit(key), material.words.language)


def _place(material: Material, key: str) -> str:
    """Return the crank angle or time at which an extreme is reached."""
    extreme = extreme_of(material.results, key)
    return _NONE if extreme is None else material.words.number(material.words.place(extreme.at)[1], digits=4)


SECTIONS = (
    # displacement, velocity and acceleration in one
    Section("kinematics", (
        Head("kinematics"), At("motion"), Lines("motion"),
        When(full, (Head("harmonics", 2), Lines("harmonics", intro="orders"), Head("extremes", 2), _EXTREMES)),
        _REPEATS,
        Shown(("kinematics", "brix", "tolle"), (
            Over("motion", tuple(key for noun in _NOUNS for key in (*_orders(noun), noun)), one_turn=True),
            in_full(_OF_RODS),
        )),
        _EXACT_ORDERS, _largest_errors,
    ), has("piston_displacement")),
    Section("displacement", (
        Head("brix"), Text("brix"), At("motion"), Lines("motion", (*_SWING, "piston_displacement")),
        Lines("harmonics", _orders("piston_displacement")), _REPEATS, Shown(("brix",), (_of_piston("displacement"),)),
        _EXACT_ORDERS,
    ), has("piston_displacement")),
    Section("velocity", (
        Head("velocity"), At("motion"), Lines("motion", ("piston_transfer_1", "piston_velocity")),
        Lines("harmonics", _orders("piston_transfer_1", "piston_velocity")),
        Lines("motion", ("rod_transfer_1", "rod_angular_velocity")), Lines("extremes", _MOST, intro="extremes"),
        Shown(("kinematics",), (_of_piston("velocity"),)),
    ), has("piston_displacement")),
    Section("acceleration", (
        Head("acceleration"), Text("tolle"), At("motion"), Lines("motion"), Lines("harmonics"), _EXTREMES,
        Shown(("tolle",), (_of_piston("acceleration"), in_full(_OF_RODS))), _largest_errors,
    ), has("piston_displacement")),
    # a driver with a law of its own
    Section("kinematics", (
        Head("linkage_kinematics"), Text("driven_positions", {"source": Citation(_POSITIONS)}),
        Shown(("position_plans",)), _LOOPS,
        At("driver"), Lines("driver"), Places("driver", _COORDINATE), Lines("motion"),
        Places("positions", _positions), Places("velocities", _MOVING), Places("accelerations", _ACCELERATING),
        _INSTANT_CENTRES, Shown(("driver", "sliders")),
        When(draws("velocity_plan"), (*_POLYGONS, vector_plans)),
    ), every(drawn, driven)),
    Section("kinematics", (
        Head("linkage_kinematics"), Head("plans", 2), Text("positions"), Shown(("position_plans",)),
        Places("positions", _positions), When(full, (
            Head("transfer", 2), Text("transfer", {"source": Citation(_POSITIONS)}), _transfer,
        )), *_POLYGONS, _LOOPS, vector_plans,
        When(either(full, lacks(has_vector_equations)), (
            Head("worked_motion", 2), At("motion"), Lines("speed"), Lines("motion", first=True),
        )), Head("motion_tables", 2),
        Places("velocities", _MOVING),
        Places("accelerations", lambda material: named(
            material.columns, *_ACCELERATING, *(("coriolis_acceleration",) if material.full else ()))),
        _INSTANT_CENTRES, Shown(("centrodes", "paths", "points", "links")),
        Shown(("sliders",)),
    ), drawn),
    Section("structure", (_structure,), drawn),
    Section("quality", (_quality,), drawn),
)  # fmt: skip
