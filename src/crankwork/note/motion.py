"""The motion in a note: of a piston, of links and sliders, of what drives them by a law of its own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.sampled_motion import transfer_ratios
from crankwork.analysis.skeleton import skeleton
from crankwork.mechanism.dyads import Chain
from crankwork.note.closing import errors
from crankwork.note.document import Block, Citation, Reference, Run
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
from crankwork.note.tables import Column, tabulated
from crankwork.note.vector_equations import has_vector_equations, vector_plans
from crankwork.note.wording import named
from crankwork.quantities.key import key_of

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


def _accelerations(material: Material) -> Iterable[str]:
    return named(material.columns, *_ACCELERATING, *(("coriolis_acceleration",) if material.full else ()))


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


def _centres(material: Material) -> Iterable[str]:
    return material.of_axes("instant_centre")


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
    Lines("instant_centres"), Places("instant_centres", _centres),
))  # fmt: skip
_OF_PIN = {"along": "x₁ + ξ₁ cos φ₁ − η₁ sin φ₁ = x₂ + ξ₂ cos φ₂ − η₂ sin φ₂",
           "across": "y₁ + ξ₁ sin φ₁ + η₁ cos φ₁ = y₂ + ξ₂ sin φ₂ + η₂ cos φ₂"}  # fmt: skip
# how groups are solved that are no dyads
_LOOPS = When(
    lambda material: any(isinstance(group, Chain) for group in material.machine.mechanism.dyads),
    (Text("loop_equations", _OF_PIN),),
)
_POLYGONS: tuple[Part, ...] = (Head("polygons", 2), Text("plan_numbers", {"table": Reference("links")}))
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
        Places("velocities", _MOVING), Places("accelerations", _accelerations),
        _INSTANT_CENTRES, Shown(("centrodes", "paths", "points", "links")),
        Shown(("sliders",)),
    ), drawn),
)  # fmt: skip
