"""The mechanism of a machine as it moves: engines as they are built, any other linkage link by link."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.moving import Course, course, moving
from crankwork.analysis.moving_engine import FORCES, engine_moving
from crankwork.analysis.skeleton import Skeleton, numbered, skeleton
from crankwork.errors import CrankworkError, GeometryError
from crankwork.locale import Refusal, capital, say
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.joints import joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.engine_drawing import engine_sketch
from crankwork.report.language import called, displayed, for_readers, key_unit, label, symbol
from crankwork.report.linkage_drawing import linkage_sketch
from crankwork.report.linkage_look import scale_text
from crankwork.report.sketch import Sketch
from crankwork.show.film import Progress
from crankwork.show.formats import FILMS, FORMATS
from crankwork.show.moving import Animation, Part, part
from crankwork.show.paper import WIDER, marked
from crankwork.show.scene import SMALL, TEXT, Box, Drawing, Item, Text, flow_rows, line, text_width
from crankwork.show.theme import Theme

_MARGIN, _FOOT, _ROW, _KEY, _NARROWEST = 8.0, 14.0, 8.0, 4.5, 80.0
# about a view that is looked at alone [mm]
_AROUND = 4.0
# a still shows the crank at this angle
_STILL = 60.0
_TURN = 360.0
# frames of a turn, and of the two turns of four strokes
_FRAMES, _FRAMES_OF_CYCLE = 72, 120


def moving_drawing(  # noqa: PLR0913 - a machine, and how it is shown
    machine: Results | Machine | Mechanism,
    *,
    language: Language = "en",
    seconds: float = 4.0,
    frames: int = 0,
    way: Course | None = None,
    forces: bool = False,
    still: int | None = None,
) -> Animation:
    """Return the mechanism of a machine as a drawing that moves, one cycle after the other, or to and fro.

    Lengths are to scale and the motion is exact at each frame. Gas, firing and forces are shown of results. Links have
    the numbers of the structure, or follow group after group where only a mechanism is known. `seconds`: time of a
    turn; `frames`: of a cycle, else as many as the eye asks for; `way`: how the crank moves, that of a machine let go
    in its own time; `forces`: whether arrows show those in pins and joints; `still`: the only frame that is looked at.
    """
    if (frames and frames < 8) or not 0 < seconds < math.inf:
        raise CrankworkError("a moving drawing needs at least 8 frames and a time above zero")
    results = machine if isinstance(machine, Results) else None
    whole = results.machine if results is not None else machine if isinstance(machine, Machine) else None
    mechanism = whole.mechanism if whole else machine
    assert isinstance(mechanism, Mechanism)  # noqa: S101 - what else there could be
    way = way or _course(whole, mechanism, frames)
    engine = engine_moving(whole, way.degrees, results) if whole else None
    time = _time(way, seconds, language)
    if engine is not None and whole is not None:
        labels = {key: marked(f"${symbol(key, language)}$") for key in FORCES}
        sketch = engine_sketch(whole, engine, labels if forces else None, still)
        keys = [f"{labels[key]} – {label(key, language)}" for key in engine.cylinders[0].forces]
        about = [*_lengths(way.mechanism, whole, language), time]
    else:
        shape = skeleton(way.mechanism, _links(whole))
        columns = _columns(results, way.degrees, forces=forces) if results is not None else {}
        sketch = linkage_sketch(
            shape, moving(way.mechanism, way.degrees), whole, columns, _named_forces(columns, language), still
        )
        keys = _acting(way.mechanism, shape, _named_forces(columns, language), language)
        about = [*_lengths(way.mechanism, None, language), *_members(shape, language), time]
    return _film(sketch, way, seconds, whole, "; ".join(about), keys, language)


def film_of(results: Results, *, language: Language = "en", frames: int = 0, forces: bool = False) -> Animation | None:
    """Return the machine of results as it moves, if it has a mechanism, and one that is driven by what it can turn."""
    if results.machine.transfer is not None or results.machine.turning is not None:
        return None
    try:
        return moving_drawing(results, language=language, frames=frames, forces=forces)
    except GeometryError:
        # a linkage that cannot turn fully has a notice that says so
        return None


@for_readers
def drawn(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    ending: str,
    theme: Theme,
    at: float | None = None,
    language: Language = "en",
    *,
    forces: bool,
    told: Progress = lambda _: None,
) -> bytes:
    """Return a machine in a format as it moves, or as it stands.

    `at`: crank angle of a still, or time where a law drives [deg] or [s]; a format that holds no film has one anyway;
    `told`: is told which part of a film is done.
    """
    machine = results.machine
    if machine.transfer is not None or machine.turning is not None:
        raise CrankworkError(Refusal("nothing_moves"))
    if results.period and at is not None and not 0 <= at <= results.period:
        raise CrankworkError(Refusal("time_outside", time=at, period=results.period))
    way = _course(machine, machine.mechanism, 0)
    if at is not None:
        way, rest = _through(way, results.degrees_of(at))
    still = None if at is None else rest
    film = moving_drawing(results, language=language, forces=forces, way=way, still=still)
    if forces and not any(one.name.startswith("force.") for one in film.parts):
        raise CrankworkError(Refusal("forces_unknown"))
    if at is None and ending in FILMS:
        return FILMS[ending](film, theme, told)
    return FORMATS[ending](film.still(still), theme)


def _through(way: Course, at: float) -> tuple[Course, int]:
    """Return a course of which a frame stands at a crank angle, and which. [deg]"""
    low, high = float(way.degrees.min()), float(way.degrees.max())
    if not low <= at <= high:
        raise CrankworkError(Refusal("still_outside", angle=at, low=f"{low:.4g}", high=f"{high:.4g}"))
    degrees, frame = way.degrees.copy(), int(np.argmin(np.abs(way.degrees[:-1] - at)))
    degrees[frame] = at
    return way._replace(degrees=degrees), frame


def _columns(results: Results, degrees: Array, *, forces: bool) -> dict[str, Array]:
    """Return volume and pressure of chambers by key, and the forces in joints where they are wanted. [SI]"""
    kinds = ("cylinder_volume.", "gas_pressure.", *(("joint_force_x.", "joint_force_y.") if forces else ()))
    keys = [key for key in results.memory if key.startswith(kinds)]
    return results.columns_at(np.mod(degrees, results.machine.cycle), keys)


def _course(whole: Machine | None, mechanism: Mechanism, frames: int) -> Course:
    """Return how the crank goes: that of an engine through its cycle, any other as far as it gets."""
    if whole is None or whole.lengths is None:
        return course(mechanism, frames or _FRAMES)
    frames = frames or (_FRAMES if whole.cycle <= _TURN else _FRAMES_OF_CYCLE)
    return Course(np.arange(frames + 1) * whole.cycle / frames, mechanism, turns=True)


def _links(whole: Machine | None) -> Sequence[str]:
    """Return the links of a machine in the order of their numbers."""
    if whole is None or whole.linkage is None:
        return ()
    found, _ = structure(whole.linkage)
    return found.links if found else ()


def _passage(way: Course, seconds: float) -> float:
    """Return the time of one passage. [s]"""
    turns = (way.degrees[-1] - way.degrees[0]) / _TURN if way.turns else 1.0
    return way.own_time or seconds * max(1.0, float(turns))


def _film(  # noqa: PLR0913 - a sketch, how it moves, and what is said of it
    sketch: Sketch,
    way: Course,
    seconds: float,
    whole: Machine | None,
    about: str,
    keys: Sequence[str],
    language: Language,
) -> Animation:
    """Return a sketch on its paper, with a scale and the crank angle beneath it; `keys`: what its forces are."""
    (wide, tall), middle = sketch.high - sketch.low, (sketch.low + sketch.high) / 2
    width, readouts = max(float(wide), _NARROWEST) + 2 * _MARGIN, _readouts(way, language)
    bar, below, foot = _scale_bar(sketch.scale, 0.3 * width, language), list[Part](), _FOOT
    if sketch.force_scale:
        text = marked(scale_text("μ_F", sketch.force_scale, key_unit("piston_force"), language))
        # in a row of its own where it would stand on the length of the bar or on the crank angle
        taken = text_width(text) + 2 * max(0.3 * width, *map(text_width, readouts)) + 2 * _MARGIN
        row = _ROW if taken > width - 2 * _MARGIN else 0.0
        foot += row
        texts = [Text((width / 2, _MARGIN + row), text, TEXT, "middle")]
        rows = flow_rows(keys, "; ", (width - 2 * _MARGIN) / WIDER, partial(text_width, height=SMALL))
        texts += [Text((_MARGIN, foot + 1.5 + _KEY * at), one, SMALL) for at, one in enumerate(reversed(rows))]
        foot += _KEY * len(rows) + 1.5
        # left out with the forces
        below.append(part("force.scale", texts, (0.0, 0.0)))
    height = float(tall) + 2 * _MARGIN + foot
    placed = sketch.moved(np.array([width / 2, (height + foot) / 2]) - middle)
    frames, items = len(way.degrees) - 1, (*placed.items, *bar)
    ground = Drawing(_title(whole.title if whole else "", language), language, width, height, items)
    return Animation(
        ground, (*placed.parts, *below), way.degrees, _passage(way, seconds), readouts,
        (width - _MARGIN, _MARGIN), round(frames * _STILL / (way.degrees[-1] or _TURN)) % frames if way.turns else 0,
        way.turns, about, _views(placed, height, language), _choices(placed, language),
    )  # fmt: skip


def _named_forces(columns: Mapping[str, Array], language: Language) -> dict[str, str]:
    """Return the symbols of forces in joints, by the joint."""
    names = [key.partition(".")[2] for key in columns if key.startswith("joint_force_x.")]
    sign = symbol("joint_force", language)
    told = {name: name.replace("_", ",") for name in names}
    return {name: marked(f"${sign}_{one}$") if one.replace(",", "").isalnum() else "" for name, one in told.items()}


def _acting(mechanism: Mechanism, shape: Skeleton, symbols: Mapping[str, str], language: Language) -> list[str]:
    """Return which link acts on which in the joints that forces are drawn in."""
    numbers = {name: at for at, name in numbered(shape)} | {GROUND: 0}
    pivots = names_of_pivots(mechanism)
    driver = mechanism.driver
    # the rod of a cylinder is a link of its own
    rod = {driver.rod: {driver.link: rod_name(driver.link)}} if isinstance(driver, Cylinder) else {}
    found = [
        (symbols.get(pivots.get(one.name, one.name)), *(numbers.get(rod.get(one.name, {}).get(link, link))
                                                         for link in (one.other, one.link)))
        for one in joints(mechanism)
    ]  # fmt: skip
    told = [f"{sign} {other} → {link}" for sign, other, link in found if sign and None not in (other, link)]
    return [f"{say('drawing.acts_on', language)} {told[0]}", *told[1:]] if told else []


def _views(sketch: Sketch, height: float, language: Language) -> tuple[tuple[str, Box], ...]:
    """Return views by name, with where they are from the top left corner of the paper. [mm]"""
    if len(sketch.views) < 2:
        return ()
    found = []
    for cylinders, low, high in sketch.views:
        numbers = ", ".join(map(str, cylinders))
        name = say("drawing.from_side", language, numbers=numbers) if cylinders else say("drawing.along", language)
        (left, low_end), (right, top) = low - _AROUND, high + _AROUND
        found.append((name, Box(float(left), height - float(top), float(right - left), float(top - low_end))))
    return tuple(found)


def _choices(sketch: Sketch, language: Language) -> dict[str, str]:
    """Return the kinds of forces that are drawn."""
    names = [one.name for one in sketch.parts if one.name.startswith("force.")]
    kinds = {f"force.{key}.": label(key, language) for key in FORCES}
    found = {start: text for start, text in kinds.items() if any(one.startswith(start) for one in names)}
    return found or ({"force.": label("joint_force", language)} if names else {})


def _scale_bar(scale: float, longest: float, language: Language) -> list[Item]:
    """Return a bar of a round length with the length on it; `scale` in millimetres of the paper per metre."""
    millimetres = longest / scale * 1e3
    power = 10.0 ** math.floor(math.log10(millimetres))
    length = max(one * power for one in (1, 2, 5) if one * power <= millimetres)
    end = _MARGIN + length / 1e3 * scale
    text = f"{number(length, language)} {unit_name('mm', language)}"
    ticks = [line((x, _MARGIN - 1.2), (x, _MARGIN + 1.2), "medium") for x in (_MARGIN, end)]
    bar = line((_MARGIN, _MARGIN), (end, _MARGIN), "medium")
    return [bar, *ticks, Text(((_MARGIN + end) / 2, _MARGIN + 1.8), text, TEXT, "middle")]


def period_of(mechanism: Mechanism) -> float:
    """Return the period of the law that drives; zero where a crank turns all the time. [s]"""
    return 0.0 if mechanism.driver.law is None else mechanism.driver.law.period


def _readouts(way: Course, language: Language) -> tuple[str, ...]:
    """Return the crank angle or the time at each frame."""
    frames, period = len(way.degrees) - 1, way.own_time or period_of(way.mechanism)
    if period:
        sign, unit = symbol("time", language), unit_name("s", language)
        return tuple(f"/{{{sign}}} = {number(period * at / frames, language, digits=3)} {unit}" for at in range(frames))
    sign, unit = symbol("crank_angle", language), unit_name("deg", language)
    return tuple(f"/{{{sign}}} = {number(round(float(one), 1), language)}{unit}" for one in way.degrees[:-1])


def _title(title: str, language: Language) -> str:
    what = say("drawing.moving_drawing", language)
    own = "".join(one for one in title if one.isprintable()).strip()
    return f"{own}: {what}" if own else capital(what)


def _lengths(mechanism: Mechanism, whole: Machine | None, language: Language) -> list[str]:
    """Return the lengths of the crank, and of the rod of an engine, in words."""
    lengths = [("crank_radius", mechanism.driver.radius)] if isinstance(mechanism.driver, Crank) else []
    if whole is not None and whole.lengths is not None:
        lengths.append(("rod_length", whole.lengths.rod_length))
    return [
        f"{label(key, language)} {number(displayed(key, value), language)} {unit_name(key_unit(key), language)}"
        for key, value in lengths
    ]


def _members(shape: Skeleton, language: Language) -> list[str]:
    """Return what the numbers stand for."""
    return [f"{number} – {called(name, language)}" for number, name in numbered(shape)]


def _time(way: Course, seconds: float, language: Language) -> str:
    """Return how long a turn takes, or to and fro."""
    every = "one_period" if period_of(way.mechanism) else "one_revolution" if way.turns else "to_and_fro"
    every, seconds = ("in_its_time", way.own_time) if way.own_time else (every, seconds)
    return say(f"drawing.{every}", language, seconds=number(seconds, language))
