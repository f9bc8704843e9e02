"""The mechanism of a machine as it moves, engines as they are built; the scheme of a crank gear."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.sampled_motion import FORCES, AnimationPath, animation_path, engine_moving, sample_motion
from crankwork.analysis.skeleton import Skeleton, numbered, skeleton
from crankwork.errors import CrankworkError, GeometryError
from crankwork.locale import ErrorMessage, capital, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.driver import Cylinder, rod_name
from crankwork.mechanism.joints import joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, for_readers, key_unit, label, link_label, symbol
from crankwork.report.drawn_cylinders import engine_sketch
from crankwork.report.drawn_links import linkage_sketch
from crankwork.report.sketch import Length, Sketch, dimension_line, tints
from crankwork.show.animation import Animation, Part, part
from crankwork.show.canvas import WIDER, Canvas, marked
from crankwork.show.formats import FILMS, FORMATS, Progress
from crankwork.show.scene import (
    DASH_DOT,
    SMALL,
    TEXT,
    Anchor,
    ChartBox,
    Drawing,
    Item,
    Pen,
    Polyline,
    Text,
    flow_rows,
    line,
    rectangle,
    text_width,
)
from crankwork.show.theme import Theme
from crankwork.units import from_si, shown_unit

_MARGIN, _FOOT, _ROW, _KEY, _NARROWEST = 8.0, 14.0, 10.5, 4.5, 80.0
# tints of the key to the pressure, and how wide each is [mm]
_TINTS, _TINT = 6, 4.0
# about a view that is looked at alone [mm]
_AROUND = 4.0
# how far a piston that stands upright is moved aside [mm]
_UPRIGHT = 1e-6
# a still shows the crank at this angle
_STILL = 60.0
_TURN = 360.0
# frames of a turn, and of the two turns of four strokes
_FRAMES, _FRAMES_OF_CYCLE = 72, 120
# paper, centre of the crank, and the lengths that are drawn, of no machine [pt]
_WIDTH, _HEIGHT = 260.0, 310.0
_CENTRE, _CRANK, _ROD = np.array([120.0, 236.0]), 62.0, 158.0
_ANGLE, _FORCE, _BORE, _PISTON = math.radians(48.0), 56.0, 56.0, 34.0
_ACCENT = "#1f5fae"


def moving_drawing(  # noqa: PLR0913 - a machine, and how it is shown
    machine: Results | Machine | Mechanism,
    *,
    language: Language = "en",
    seconds: float = 4.0,
    frames: int = 0,
    path: AnimationPath | None = None,
    forces: bool = False,
    still: int | None = None,
    lengths: Sequence[Length] = (),
    has_room: bool = True,
) -> Animation:
    """Return the mechanism of a machine as a drawing that moves, one cycle after the other, or to and fro.

    Lengths are to scale and the motion is exact at each frame. Gas, firing and forces are shown of results. Links have
    the numbers of the structure, or follow group after group where only a mechanism is known. `seconds`: time of a
    turn; `frames`: of a cycle, else as many as the eye needs; `path`: motion of the crank, that of a transient
    simulation in its own time; `forces`: whether arrows show those in pins and joints; `still`: the only frame shown;
    `lengths`: measured there; `has_room`: whether the paper has room for forces, which are else seen by choice.
    """
    if (frames and frames < 8) or not 0 < seconds < math.inf:
        raise CrankworkError("a moving drawing needs at least 8 frames and a time above zero")
    results = machine if isinstance(machine, Results) else None
    known = results.machine if results is not None else machine if isinstance(machine, Machine) else None
    mechanism = known.mechanism if known else machine
    assert isinstance(mechanism, Mechanism)  # noqa: S101 - what else there could be
    path = path or _path_of_crank(known, mechanism, frames)
    engine = engine_moving(known, path.degrees, results) if known else None
    time = _time(path, seconds, language)
    if engine is not None and known is not None:
        labels = {key: marked(f"${symbol(key, language)}$") for key in FORCES}
        sketch = engine_sketch(known, engine, labels if forces else None, still, has_room=has_room)
        keys = [f"{labels[key]} – {label(key, language)}" for key in engine.cylinders[0].forces]
        about = [*_lengths(path.mechanism, known, language), time]
        pressures = [cylinder.pressure for cylinder in engine.cylinders if cylinder.pressure is not None]
    else:
        shape = skeleton(path.mechanism, _links(known))
        columns = _columns(results, path.degrees, forces=forces) if results is not None else {}
        sketch = linkage_sketch(
            shape, sample_motion(path.mechanism, path.degrees), known, columns, _named_forces(columns, language), still,
            lengths, has_room=has_room,
        )  # fmt: skip
        keys = _acting(path.mechanism, shape, _named_forces(columns, language), language)
        named = (f"{number} – {link_label(name, language)}" for number, name in numbered(shape))
        about = [*_lengths(path.mechanism, None, language), *named, time]
        tinted = [item.name.removeprefix("gas.") for item in sketch.parts if item.name.startswith("gas.")]
        pressures = [columns[f"gas_pressure.{name}"] for name in tinted if f"gas_pressure.{name}" in columns]
    return _film(sketch, path, seconds, known, "; ".join(about), keys, pressures, language, has_room=has_room)


def film_of(
    results: Results,
    *,
    language: Language = "en",
    frames: int = 0,
    forces: bool = False,
    still: int | None = None,
    lengths: Sequence[Length] = (),
) -> Animation | None:
    """Return the machine of results as it moves, if it has a mechanism, and one that is driven by what it can turn."""
    if not results.machine.moves:
        return None
    try:
        return moving_drawing(
            results, language=language, frames=frames, forces=forces, still=still, lengths=lengths, has_room=False
        )
    except GeometryError:
        # a linkage that cannot turn fully has a notice that says so
        return None


def dimensioned(film: Animation, bore: str, stroke: str) -> Drawing:
    """Return a film at rest with the dimensions of its first cylinder, where that stands upright; each as text."""
    still, of_name = film.still(), {moving.name: moving for moving in film.parts}
    piston = of_name.get("row.1.piston.1") or of_name.get("side.piston.1")
    if piston is None or np.ptp(piston.shift[:, 0]) > _UPRIGHT:
        return still
    points = np.vstack([item.points for item in piston.at(film.rest) if isinstance(item, Polyline)])
    # the gas fills the bore, in which the piston has some play
    gas = of_name.get(piston.name.replace("piston", "gas"), piston).at(film.rest)
    walls = np.vstack([item.points[:, :1] for item in gas if isinstance(item, Polyline)] or [points[:, :1]])
    left, right = float(np.min(walls)), float(np.max(walls))
    crowns = float(np.max(points[:, 1])) + piston.shift[:, 1] - piston.shift[film.rest, 1]
    low, high = float(np.min(crowns)), float(np.max(crowns))
    over, column = still.height - _FOOT / 2, left - _FOOT
    corners = np.array([[left, high], [right, high], [left, low]])
    items = list(dimension_line(corners[:2], np.array([[left, over], [right, over]]), _AROUND))
    items += dimension_line(corners[[2, 0]], np.array([[column, low], [column, high]]), 1.0)
    items.append(Text(((left + right) / 2, over + 1), bore, anchor="middle"))
    items.append(Text((column - 1, (low + high) / 2), stroke, anchor="middle", angle=90.0))
    return still._replace(items=(*still.items, *items))


@for_readers
def drawn(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    ending: str,
    theme: Theme,
    angle_or_time: float | None = None,
    language: Language = "en",
    *,
    forces: bool,
    progress: Progress = lambda _: None,
) -> bytes:
    """Return a machine in a format as it moves, or as it stands.

    `angle_or_time`: crank angle of a still, or time where a law drives [deg] or [s]; a format that holds no film has
    one anyway; `progress`: is told which part of a film is done.
    """
    machine = results.machine
    if not machine.moves:
        raise CrankworkError(ErrorMessage("nothing_moves"))
    if results.period and angle_or_time is not None and not 0 <= angle_or_time <= results.period:
        raise CrankworkError(ErrorMessage("time_outside", time=angle_or_time, period=results.period))
    path = _path_of_crank(machine, machine.mechanism, 0)
    if angle_or_time is not None:
        path, rest = _through(path, results.degrees_of(angle_or_time))
    still = None if angle_or_time is None else rest
    film = moving_drawing(results, language=language, forces=forces, path=path, still=still)
    if forces and not any(item.name.startswith("force.") for item in film.parts):
        raise CrankworkError(ErrorMessage("forces_unknown"))
    if angle_or_time is None and ending in FILMS:
        return FILMS[ending](film, theme, progress)
    return FORMATS[ending](film.still(still), theme)


def _through(path: AnimationPath, angle: float) -> tuple[AnimationPath, int]:
    """Return a path with a frame at a crank angle, and the number of that frame. [deg]"""
    low, high = float(path.degrees.min()), float(path.degrees.max())
    if not low <= angle <= high:
        # the same position, whole turns apart
        period = high - low if path.turns else _TURN
        angle += period * math.ceil((low - angle) / period)
    if not low <= angle <= high:
        raise CrankworkError(ErrorMessage("still_outside", angle=angle, low=f"{low:.4g}", high=f"{high:.4g}"))
    degrees, frame = path.degrees.copy(), int(np.argmin(np.abs(path.degrees[:-1] - angle)))
    degrees[frame] = angle
    return path._replace(degrees=degrees), frame


def _columns(results: Results, degrees: Array, *, forces: bool) -> dict[str, Array]:
    """Return volume and pressure of chambers by key, and the forces in joints where they are wanted. [SI]"""
    kinds = ("cylinder_volume.", "gas_pressure.", *(("joint_force_x.", "joint_force_y.") if forces else ()))
    keys = [key for key in results.trace if key.startswith(kinds)]
    return results.columns_at(np.mod(degrees, results.machine.cycle), keys)


def _path_of_crank(machine: Machine | None, mechanism: Mechanism, frames: int) -> AnimationPath:
    """Return the path of the crank: that of an engine through its cycle, any other over its range."""
    if machine is None or machine.lengths is None:
        return animation_path(mechanism, frames or _FRAMES)
    frames = frames or (_FRAMES if machine.cycle <= _TURN else _FRAMES_OF_CYCLE)
    return AnimationPath(np.arange(frames + 1) * machine.cycle / frames, mechanism, turns=True)


def _links(machine: Machine | None) -> Sequence[str]:
    """Return the links of a machine in the order of their numbers."""
    if machine is None or machine.linkage is None:
        return ()
    analysed, _ = structure(machine.linkage)
    return analysed.links if analysed else ()


def _passage(path: AnimationPath, seconds: float) -> float:
    """Return the time of one passage. [s]"""
    turns = (path.degrees[-1] - path.degrees[0]) / _TURN if path.turns else 1.0
    return path.own_time or seconds * max(1.0, float(turns))


def _film(  # noqa: PLR0913 - a sketch, how it moves, and what is said of it
    sketch: Sketch,
    path: AnimationPath,
    seconds: float,
    machine: Machine | None,
    about: str,
    keys: Sequence[str],
    pressures: Sequence[Array],
    language: Language,
    *,
    has_room: bool,
) -> Animation:
    """Return a sketch on its paper, with a scale and the crank angle beneath it.

    `keys`: legend of its forces; `pressures`: of the gas that is tinted. [Pa]
    """
    (wide, tall), middle = sketch.high - sketch.low, (sketch.low + sketch.high) / 2
    width, readouts = max(float(wide), _NARROWEST) + 2 * _MARGIN, _readouts(path, language)
    of_lengths = shown_unit("mm")
    bar = _scale_bar(sketch.scale / float(from_si(1.0, of_lengths)), 0.3 * width, _MARGIN, of_lengths, language)
    below, foot = list[Part](), _FOOT
    if pressures:
        bar = [*_pressure_key(pressures, foot + _MARGIN + _ROW - _FOOT, language), *bar]
        foot += _ROW
    rows, under = [], foot
    if sketch.force_scale:
        rows = flow_rows(keys, "; ", (width - 2 * _MARGIN) / WIDER, partial(text_width, height=SMALL))
        foot += (_ROW + _KEY * len(rows) + 3.0) * has_room
    height = float(tall) + 2 * _MARGIN + foot
    placed = sketch.moved(np.array([width / 2, (height + foot) / 2]) - middle)
    covered = ChartBox(0.0, 0.0, width, height)
    if sketch.force_scale:
        if not has_room:
            shifts = [moving.shift for moving in placed.parts if moving.name.startswith("force.")]
            tips = np.vstack([[(0.0, 0.0), (width, height)], *shifts])
            low, high = tips.min(axis=0) - _AROUND, tips.max(axis=0) + _AROUND
            under = float(low[1]) - _ROW - _KEY * len(rows) - 3.0
            covered = ChartBox(float(low[0]), under, float(high[0] - low[0]), float(high[1]) - under)
        texts = _scale_bar(
            1 / sketch.force_scale, 0.3 * width, under + _MARGIN + _ROW - _FOOT, key_unit("piston_force"), language
        )
        texts += [Text((_MARGIN, under + _ROW + 3.0 + _KEY * k), row_text, SMALL)
                  for k, row_text in enumerate(reversed(rows))]  # fmt: skip
        # left out with the forces
        below.append(part("force.scale", texts, (0.0, 0.0)))
    frames, items = len(path.degrees) - 1, (*placed.items, *bar)
    ground = Drawing(_title(machine.title if machine else "", language), language, width, height, items)
    return Animation(
        ground, (*placed.parts, *below), path.degrees, _passage(path, seconds), readouts,
        (width - _MARGIN, _MARGIN), round(frames * _STILL / (path.degrees[-1] or _TURN)) % frames if path.turns else 0,
        path.turns, about, _views(placed, height, language), _choices(placed, language), covered,
    )  # fmt: skip


def _named_forces(columns: Mapping[str, Array], language: Language) -> dict[str, str]:
    """Return the symbols of forces in joints, by the joint."""
    names = [key_of(key).owner for key in columns if key.startswith("joint_force_x.")]
    sign = symbol("joint_force", language)
    subscripts = {name: name.replace("_", ",") for name in names}
    return {
        name: marked(f"${sign}_{mark}$") if mark.replace(",", "").isalnum() else "" for name, mark in subscripts.items()
    }


def _acting(mechanism: Mechanism, shape: Skeleton, symbols: Mapping[str, str], language: Language) -> list[str]:
    """Return which link acts on which in the joints that forces are drawn in."""
    numbers = {name: own_number for own_number, name in numbered(shape)} | {GROUND: 0}
    pivots = names_of_pivots(mechanism)
    driver = mechanism.driver
    # the rod of a cylinder is a link of its own
    rod = {driver.rod: {driver.link: rod_name(driver.link)}} if isinstance(driver, Cylinder) else {}
    rows = [
        (symbols.get(pivots.get(joint.name, joint.name)), *(numbers.get(rod.get(joint.name, {}).get(link, link))
                                                         for link in (joint.other, joint.link)))
        for joint in joints(mechanism)
    ]  # fmt: skip
    texts = [f"{sign} {other} → {link}" for sign, other, link in rows if sign and None not in (other, link)]
    return [f"{translate('drawing.acts_on', language)} {texts[0]}", *texts[1:]] if texts else []


def _views(sketch: Sketch, height: float, language: Language) -> tuple[tuple[str, ChartBox], ...]:
    """Return views by name, with where they are from the top left corner of the paper. [mm]"""
    if len(sketch.views) < 2:
        return ()
    views = []
    for cylinders, low, high in sketch.views:
        numbers = ", ".join(map(str, cylinders))
        name = (
            translate("drawing.from_side", language, numbers=numbers)
            if cylinders
            else translate("drawing.along", language)
        )
        (left, low_end), (right, top) = low - _AROUND, high + _AROUND
        views.append((name, ChartBox(float(left), height - float(top), float(right - left), float(top - low_end))))
    return tuple(views)


def _choices(sketch: Sketch, language: Language) -> dict[str, str]:
    """Return the kinds of forces that are drawn."""
    names = [item.name for item in sketch.parts if item.name.startswith("force.")]
    kinds = {f"force.{key}.": label(key, language) for key in FORCES}
    choices = {start: text for start, text in kinds.items() if any(name.startswith(start) for name in names)}
    return choices or ({"force.": label("joint_force", language)} if names else {})


def _scale_bar(scale: float, longest: float, level: float, unit: str, language: Language) -> list[Item]:
    """Return a bar of a round size with the size on it; `scale`: millimetres of the paper per unit."""
    power = 10.0 ** math.floor(math.log10(longest / scale))
    size = max(digit * power for digit in (1, 2, 5) if digit * power <= longest / scale)
    end = _MARGIN + size * scale
    text = f"{number(float(f'{size:.6g}'), language)} {unit_name(unit, language)}"
    ticks = [line((x, level - 1.2), (x, level + 1.2), "medium") for x in (_MARGIN, end)]
    bar = line((_MARGIN, level), (end, level), "medium")
    return [bar, *ticks, Text(((_MARGIN + end) / 2, level + 1.8), text, TEXT, "middle")]


def _pressure_key(pressures: Sequence[Array], level: float, language: Language) -> list[Item]:
    """Return the tints of gas from its least to its greatest pressure. [Pa]"""
    values = np.array([min(map(np.min, pressures)), max(map(np.max, pressures))])
    shades = tints([values[0] + np.linspace(0.0, 1.0, _TINTS) ** 2 * np.ptp(values)])[0]
    steps = [rectangle(ChartBox(_MARGIN + _TINT * k, level - 1.2, _TINT, 3.5), fill=1.0 - float(shade))
             for k, shade in enumerate(shades)]  # fmt: skip
    low, high = (number(float(f"{displayed('gas_pressure', value):.3g}"), language) for value in values)
    text = marked(
        f"${symbol('gas_pressure', language)}$ = {low} … {high} {unit_name(key_unit('gas_pressure'), language)}"
    )
    return [
        *(step._replace(kind=Pen(0.0), name="gas") for step in steps),
        Text((_MARGIN + _TINT * _TINTS + 2, level - 1), text),
    ]


def period_of(mechanism: Mechanism) -> float:
    """Return the period of the law that drives; zero where a crank turns all the time. [s]"""
    return 0.0 if mechanism.driver.law is None else mechanism.driver.law.period


def _readouts(path: AnimationPath, language: Language) -> tuple[str, ...]:
    """Return the crank angle or the time at each frame."""
    frames, period = len(path.degrees) - 1, path.own_time or period_of(path.mechanism)
    if period:
        sign, unit = symbol("time", language), unit_name("s", language)
        return tuple(f"/{{{sign}}} = {number(period * k / frames, language, digits=3)} {unit}" for k in range(frames))
    sign, unit = symbol("crank_angle", language), unit_name("deg", language)
    return tuple(f"/{{{sign}}} = {number(round(float(angle), 1), language)}{unit}" for angle in path.degrees[:-1])


def _title(title: str, language: Language) -> str:
    what = translate("drawing.moving_drawing", language)
    own = "".join(letter for letter in title if letter.isprintable()).strip()
    return f"{own}: {what}" if own else capital(what)


def _lengths(mechanism: Mechanism, machine: Machine | None, language: Language) -> list[str]:
    """Return the lengths of the crank, and of the rod of an engine, in words."""
    lengths = [("crank_radius", mechanism.driver.radius)] if isinstance(mechanism.driver, Crank) else []
    if machine is not None and machine.lengths is not None:
        lengths.append(("rod_length", machine.lengths.rod_length))
    return [
        f"{label(key, language)} {number(displayed(key, value), language)} {unit_name(key_unit(key), language)}"
        for key, value in lengths
    ]


def _time(path: AnimationPath, seconds: float, language: Language) -> str:
    """Return the time of a turn or of a passage to and fro, in words."""
    key = "one_period" if period_of(path.mechanism) else "one_revolution" if path.turns else "to_and_fro"
    key, seconds = ("in_its_time", path.own_time) if path.own_time else (key, seconds)
    return translate(f"drawing.{key}", language, seconds=number(seconds, language))


def crank_gear_scheme(title: str, language: Language = "en") -> Drawing:
    """Return the scheme of a crank gear with its axis upward and its crank turning clockwise; not to scale."""
    canvas = Canvas(_WIDTH, _HEIGHT)
    along, across = np.array([math.sin(_ANGLE), -math.cos(_ANGLE)]), np.array([math.cos(_ANGLE), math.sin(_ANGLE)])
    pin = _CENTRE + _CRANK * along
    tilt = math.asin(_CRANK * math.sin(_ANGLE) / _ROD)
    rod = np.array([math.sin(tilt), math.cos(tilt)])
    piston = pin - _ROD * rod
    _mechanism(canvas, pin, piston)
    _angles(canvas, tilt, piston, language)
    _scheme_lengths(canvas, pin, piston, rod, across, language)
    side = _FORCE * math.tan(tilt)
    forces = (
        ("piston_force", piston, np.array([0.0, _FORCE]), (-5.0, 0.0)),
        ("side_force", piston, np.array([-max(side, 26.0), 0.0]), (2.0, -6.0)),
        ("rod_force", pin, 0.9 * _FORCE * rod, (5.0, 8.0)),
        ("tangential_force", pin, _FORCE * math.sin(_ANGLE + tilt) * across, (6.0, 2.0)),
        ("radial_force", pin, -_FORCE * max(math.cos(_ANGLE + tilt), 0.45) * along, (5.0, 9.0)),
    )
    for key, start, reach, (right, down) in forces:
        end = start + reach
        canvas.arrow(start.tolist(), end.tolist(), width=0.9, colour=_ACCENT)
        anchor: Anchor = "end" if right < 0 else "start"
        text = f"${symbol(key, language)}$"
        canvas.text(end[0] + right, end[1] + down, text, size=10.0, anchor=anchor, colour=_ACCENT)
    return canvas.drawing(title, language)


def _mechanism(canvas: Canvas, pin: Array, piston: Array) -> None:
    """Draw axis, crank circle, crank, rod, piston and cylinder walls."""
    (x, y), top = _CENTRE, piston[1] - _PISTON / 2 - 30.0
    canvas.line([x, x], [top - 12.0, y + _CRANK + 10.0], style=DASH_DOT, width=0.45)
    circle = np.linspace(0.0, 2 * math.pi, 121)
    canvas.line(x + _CRANK * np.sin(circle), y - _CRANK * np.cos(circle), style=(4.0, 4.0), width=0.45)
    for wall, side in ((x - _BORE / 2, -1.0), (x + _BORE / 2, 1.0)):
        canvas.line([wall, wall], [top, piston[1] + 46.0], width=0.9)
        ends = [(wall, lower, wall + side * 6.0, lower - 6.0) for lower in np.arange(top + 6.0, piston[1] + 46.0, 8.0)]
        canvas.segments(np.array(ends), width=0.45)
    half = _BORE / 2 - 1.5
    left, right, up, down = x - half, x + half, piston[1] - _PISTON / 2, piston[1] + _PISTON / 2
    canvas.area([left, right, right, left], [up, up, down, down], fill="#eeeeee", width=0.9)
    canvas.line([piston[0], pin[0]], [piston[1], pin[1]], width=0.9)
    canvas.line([x, pin[0]], [y, pin[1]], width=0.9)
    for place in (_CENTRE, pin, piston):
        canvas.dot(place[0], place[1], 3.0, fill="#ffffff", width=0.9)


def _angles(canvas: Canvas, tilt: float, piston: Array, language: Language) -> None:
    """Draw crank angle, rod angle and the sense of rotation."""
    (x, y), radius = _CENTRE, 26.0
    turn = np.linspace(0.0, _ANGLE, 25)
    canvas.line(x + radius * np.sin(turn[:-3]), y - radius * np.cos(turn[:-3]), width=0.45)
    _head(canvas, _CENTRE, radius, _ANGLE)
    middle = _ANGLE / 2
    canvas.text(
        x + 34.0 * math.sin(middle) - 3.0,
        y - 34.0 * math.cos(middle),
        f"${symbol('crank_angle', language)}$",
        size=10.0,
    )
    radius, swing = 74.0, np.linspace(0.0, tilt, 15)
    canvas.line(piston[0] + radius * np.sin(swing), piston[1] + radius * np.cos(swing), width=0.45)
    canvas.text(piston[0] + 4.0, piston[1] + radius + 11.0, f"${symbol('rod_angle', language)}$", size=10.0)
    radius, sweep = _CRANK + 9.0, np.radians(np.linspace(200.0, 262.0, 40))
    canvas.line(x + radius * np.sin(sweep[:-2]), y - radius * np.cos(sweep[:-2]), width=0.9)
    _head(canvas, _CENTRE, radius, sweep[-1])
    canvas.text(
        x - radius - 8.0, y + 8.0, f"${symbol('speed', language)}$, ${symbol('crank_torque', language)}$",
        size=10.0, anchor="end",
    )  # fmt: skip


def _head(canvas: Canvas, centre: Array, radius: float, angle: float) -> None:
    """Draw the head of a clockwise arrow on a circle, which ends at an angle from the axis."""
    back = angle - 7.0 / radius
    start, end = (centre + radius * np.array([math.sin(turned), -math.cos(turned)]) for turned in (back, angle))
    canvas.arrow(start.tolist(), end.tolist(), width=0.45)


def _scheme_lengths(canvas: Canvas, pin: Array, piston: Array, rod: Array, across: Array, language: Language) -> None:
    """Name crank and rod, and draw the displacement of the piston from its upper end."""
    middle = _CENTRE + 0.3 * (pin - _CENTRE) + 10.0 * across
    canvas.text(middle[0], middle[1], f"${symbol('crank_radius', language)}$", size=10.0)
    middle = piston + 0.62 * _ROD * rod + np.array([7.0, -2.0])
    canvas.text(middle[0], middle[1], f"${symbol('rod_length', language)}$", size=10.0)
    level, right = _CENTRE[1] - _CRANK - _ROD, _CENTRE[0] + _BORE / 2 + 16.0
    for height in (level, piston[1]):
        canvas.line([_CENTRE[0], right + 4.0], [height, height], width=0.45)
    canvas.arrow((right, level), (right, piston[1]), width=0.45)
    canvas.text(right + 5.0, (level + piston[1]) / 2 + 3.0, f"${symbol('piston_displacement', language)}$", size=10.0)
