"""The torque in a note: of cylinders and shafts, its harmonics; flywheel, motor, speed, torsional vibration."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis import Array
from crankwork.analysis.motor_choice import SERIES_SOURCE, selection_of
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import in_order
from crankwork.locale import capital
from crankwork.note.document import Block, Bold, Citation, Equation, Math, Paragraph, Reference, Run, Table
from crankwork.note.lines import WHEEL_SIZES
from crankwork.note.material import Material
from crankwork.note.parts import (
    At,
    Condition,
    Head,
    Lines,
    Listed,
    Part,
    Places,
    Rows,
    Section,
    Shown,
    Text,
    When,
    amount,
    drawn,
    draws,
    either,
    every,
    full,
    has,
    has_torques,
    lacks,
    machine_has,
    number,
    school,
    turning,
    works,
)
from crankwork.note.tables import Column, angle_table, position_tables, quantity_column, quantity_columns, tabulated
from crankwork.note.wording import named
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit, link_label, row_name
from crankwork.report.torque import MODES

# terms of links that a table has beside their sum
_MOST_LINKS = 6
# share of the largest torque that is rounding
_NOISE = 1e-6
_WORK, _EFFICIENCY, _HARMONICS = "artobolevsky_1988, ch. 15", "artobolevsky_1988, ch. 14", "den_hartog_1956, ch. 5"
_TORQUES = ("static_torque", "dynamic_torque", "balancing_torque", "driving_torque")
_OF_TABLE = ("reduced_inertia_1", "dynamic_torque", "static_torque", "balancing_torque", "driving_torque")
_HOLZER, _ORDERS = "holzer_1921", "den_hartog_1956, ch. 5"
# rows of critical speeds, and of tables by Holzer
_MOST_CRITICAL, _MOST_ROWS = 12, 40
_FREQUENCIES = ("natural_frequency", "damped_frequency", "angular_frequency")
# least number that has four digits without decimals, and decimals at most
_FOUR_DIGITS, _DECIMALS = 1000.0, 2


_EQUATION = ("(", Math("K"), " − ", Math("ω"), "² ", Math("J"), ") ", Math("Θ"), " = 0")
_OF_ALL = ("work_per_cycle", "energy_fluctuation", *WHEEL_SIZES)
# of the speed over a cycle, that in which a flywheel is found first
_FIGURES = ("wittenbauer", "excess_work", "crank_speed")
# rows of a table over the angle of a shaft
_MOST_ANGLES = 120
# a speed changes little
_DIGITS = defaultdict(lambda: 4, crank_speed=6)
_COLUMNS = (
    "turning_moment", "load_torque", "excess_torque", "kinetic_energy_change", "crank_speed", "angular_acceleration",
)  # fmt: skip
_DYNAMICS = "artobolevsky_1988, ch. 15"
_ROWS = 21
_MOST_EVENTS = 24
_SHOWN = ("time", "crank_angle", "crank_speed", "angular_acceleration", "kinetic_energy", "potential_energy")


def _firing_order(material: Material) -> str:
    engine = material.machine.engine
    return "–".join(map(str, engine.layout.firing_order)) if engine is not None else ""


def _all_cylinders(material: Material) -> Table | None:
    """Return the torques of the cylinders, their sum, and the sum of the tangential forces."""
    keys = [key for key in material.columns if key.startswith("crank_torque.")]
    interval = math.inf if material.full else repeat_interval(material)
    return angle_table(material, "total", [*keys, "total_torque", "total_tangential_force"], until=interval)


def repeat_interval(material: Material) -> float:
    """Return the crank angle after which the total torque repeats, infinite if that is the cycle. [deg]"""
    results, cycle = material.results, material.machine.cycle
    known, degrees = results.trace.get("firing_interval"), results.grid.degrees
    interval = cycle if known is None else math.degrees(known.value)
    total = dict(zip(np.round(degrees % cycle, 9).tolist(), material.columns["total_torque"].tolist(), strict=True))
    later = [(value, total.get(round((angle + interval) % cycle, 9), value)) for angle, value in total.items()]
    limit = _NOISE * max(map(abs, total.values()))
    repeats = all(abs(value - again) <= limit for value, again in later)
    return interval if interval < cycle and interval in degrees and repeats else math.inf


def _losses(material: Material) -> Iterator[Block]:
    """Yield the paragraphs on the efficiency of the joints."""
    words = material.words
    drive = material.machine.drive
    if drive.efficiency == 1 and material.machine.friction:
        # a section of its own says what rubs
        return
    if drive.efficiency == 1:
        yield words.paragraph("no_losses")
        return
    yield words.heading("efficiency", 2)
    yield words.paragraph(
        "efficiency", source=Citation(_EFFICIENCY), value=words.number(drive.efficiency, digits=material.digits)
    )
    # what the chain comes to before it is rounded is the efficiency as well
    marks = {"efficiency.exact": words.symbol("efficiency")}
    lines = material.lines("efficiency")
    yield from material.worked(lines if material.full else lines[-1:], marks)
    if drive.exact_efficiency is not None:
        used, exact = words.number(drive.efficiency), words.number(drive.exact_efficiency, digits=material.digits)
        yield words.paragraph("efficiency_rounded", used=used, exact=exact)


def _is_lossy(material: Material) -> bool:
    """Return whether an efficiency divides or multiplies the torque."""
    return material.machine.drive.efficiency != 1


def _over_positions(caption: str, label: str, *keys: str) -> Callable[[Material], Iterator[Table]]:
    """Return what yields a table of a machine whose positions are rows of its file, numbered from one."""

    def table(material: Material) -> Iterator[Table]:
        shown = [*(_of_bodies(material) if caption == "reduced" else []),
                 *quantity_columns(material, keys, material.results.columns)]  # fmt: skip
        return position_tables(caption, material.results.grid.degrees, shown, material.words, first=1, label=label)

    return table


def _reduced_by_links(material: Material) -> Iterator[Block]:
    """Yield the reduced inertia at the positions, with the terms of its links where there is room for them."""
    own = quantity_columns(material, material.nonzero("reduced_inertia", "reduced_inertia_1"), material.columns)
    of_links = _of_bodies(material, material.positions)
    yield from tabulated(
        material, "reduced", [*(of_links if 1 < len(of_links) <= _MOST_LINKS else ()), *own], "reduced"
    )


def _of_bodies(material: Material, degrees: ArrayLike | None = None) -> list[Column]:
    """Return the terms of the bodies in the reduced inertia, at crank angles or those of the table. [deg]"""
    results = material.results
    traced_values = in_order([results.trace["reduced_inertia"]])
    known = {traced.key: traced for traced in traced_values if traced.key.startswith("reduced_inertia.")}
    rows = Program(known)(results.grid if degrees is None else results.grid.from_degrees(degrees))
    return quantity_columns(material, [key for key in known if rows[key].any()], rows)


def _at_all(key: str) -> Callable[[Material], Iterator[Block]]:
    """Return what yields the equation of a quantity at every position, its number in the subscript."""

    def equations(material: Material) -> Iterator[Block]:
        results, shown = material.results, material.words.symbol(key)
        for place, degrees in enumerate(results.grid.degrees.tolist(), start=1):
            symbol = f"{shown}{',' if '_' in shown else '_'}{place}"
            yield Equation(results.moment(degrees).step(results.trace[key]), symbol=symbol)

    return equations


def _cylinders(count: Callable[[int], bool]) -> Condition:
    """Return the condition on how many cylinders turn a shaft together."""
    return lambda material: material.machine.engine is not None and count(len(material.machine.engine.layout.places))


def _has_static(material: Material) -> bool:
    return bool(material.nonzero("static_torque"))


def _states(name: str) -> Condition:
    """Return the condition that the table of transfer functions of a machine has a column."""
    return lambda material: getattr(material.machine.transfer, name) is not None


# the angle that is worked, within the interval that is tabulated
_REPEATS = Text("total_repeats", {"value": lambda material: material.words.place_text(
    (material.groups["engine_torque"].degrees or 0.0) % repeat_interval(material))})  # fmt: skip
ONE, _SEVERAL = _cylinders(lambda count: count == 1), _cylinders(lambda count: count > 1)
# amplitudes of the torque by order, worked for the first of them
HARMONICS: tuple[Part, ...] = (
    Lines("torque_harmonics", ("harmonic_amplitude", "total_harmonic_amplitude"), intro="harmonics", first=True),
    Shown(("torque_harmonics", "phase_stars"), (Rows("torque_harmonics", "harmonics"),)),
)
_CITED = {"source": Citation(_WORK)}
_IS_TABLE = machine_has("transfer")


class _Listing:
    """A listing as a table without a reference, its rows those of the greatest exciting torque if there are many."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        words, listing = material.words, material.results.listings.get(self.name)
        if listing is None:
            return
        rows = np.arange(len(next(iter(listing.columns.values()))))
        if "excitation_torque" in listing.columns:
            rows = np.sort(np.argsort(-listing.columns["excitation_torque"])[:_MOST_CRITICAL])
        if self.name == "holzer" and not material.full:
            rows = rows[listing.columns["angular_frequency"] == listing.columns["angular_frequency"][0]]
        rows = rows[:_MOST_ROWS]
        # the caption says at which frequency
        columns = {key: values[rows] for key, values in listing.columns.items()
                   if material.full or (self.name, key) != ("holzer", "angular_frequency")}  # fmt: skip
        made = [
            column._replace(heading=(link_label(key_of(key).owner, words.language),))
            if key.startswith("relative_amplitude.") else column
            for key, column in zip(columns, _columns(material, columns), strict=True)
        ]  # fmt: skip
        if listing.names:
            made.insert(0, Column((words.column("row"),), [_called(listing.names[row], material) for row in rows]))
        cells = list(zip(*(column.entries for column in made), strict=True))
        align = "l" * bool(listing.names) + "r" * len(columns)
        caption = "holzer_first" if self.name == "holzer" and not material.full else self.name
        yield words.table(caption, [column.heading for column in made], cells, align, self.name)


def _columns(material: Material, columns: Mapping[str, Array]) -> Iterator[Column]:
    """Yield columns of quantities; of frequencies the lowest, which matters most, has its digits too."""
    for key, values in columns.items():
        lowest = float(np.min(np.abs(material.shown(key, values)), initial=np.inf))
        is_spread = key_of(key).quantity in _FREQUENCIES and 0.0 < lowest < _FOUR_DIGITS
        decimals = min(_DECIMALS, 3 - math.floor(math.log10(lowest))) if is_spread else None
        yield quantity_column(material, key, values, decimals=decimals)


def _called(name: str, material: Material) -> str:
    """Return the name of a disc, or of a shaft with the discs between which it is."""
    model, language = material.machine.torsion, material.words.language
    text = link_label(name, language)
    if model is None or name not in model.shafts:
        return text
    return f"{text} ({' – '.join(link_label(end, language) for end in model.shafts[name].between)})"


def _worked(material: Material) -> Iterator[Block]:
    """Yield the equations of the system; what is given stands in the tables."""
    blocks = material.equations("torsion")
    kept = [block for block in blocks if not isinstance(block, Equation) or isinstance(block.step, FormulaLine)]
    return material.intro("torsion_lengths", kept)


def _nodes(material: Material) -> Iterator[Block]:
    """Yield the table of nodes: between which discs, and where between them."""
    words, results = material.words, material.results
    listing, model = results.listings.get("torsional_nodes"), results.machine.torsion
    if listing is None or model is None:
        return
    shapes, places, shares = results.listings["natural_modes"].columns, list[str](), list[str]()
    modes = listing.columns["mode_number"].astype(int)
    # those of the modes that are drawn
    rows = np.flatnonzero(material.full | (modes <= MODES))
    for mode, name in ((int(modes[row]), listing.names[row]) for row in rows):
        ends = model.shafts[name].between if name in model.shafts else (name,)
        a, *b = (float(shapes[f"relative_amplitude.{end}"][mode - 1]) for end in ends)
        places.append(" – ".join(link_label(end, words.language) for end in ends))
        shares.append(words.number(100 * a / (a - b[0]), digits=3) if b else "–")
    number, *distances = (quantity_column(material, key, values[rows]) for key, values in listing.columns.items())
    made = [number, Column((words.column("row"),), places), Column((words.column("share"),), shares), *distances]
    cells = list(zip(*(column.entries for column in made), strict=True))
    yield words.paragraph("torsion_nodes")
    yield words.table("torsional_nodes", [column.heading for column in made], cells, "rlr" + "r" * len(distances),
                      "torsional_nodes")  # fmt: skip


def _torques(material: Material) -> Iterator[Block]:
    """Yield the sentence that tells which torques excite."""
    words, model, parts = material.words, material.machine.torsion, list[Run]()
    for torque in () if model is None else model.torques:
        order = torque.order is not None
        key, value = ("harmonic_order", torque.order) if order else ("angular_frequency", torque.frequency)
        amount = words.amount(torque.torque, "N*m", digits=4)
        turns = words.number(value or 0.0) if order else words.amount(value or 0.0, "rad/s", digits=4)
        if torque.phase:
            turns += f", {words.amount(torque.phase, 'deg', digits=4)}"
        name, symbol = link_label(torque.disc, words.language), Math(words.symbol("excitation_torque"))
        parts += ["; " if parts else "", f"{name}: ", symbol, f" = {amount}, ", Math(words.symbol(key)), f" = {turns}"]
    if parts:
        yield words.paragraph("torsion_torques", values=tuple(parts))


def _vibration(material: Material) -> Iterator[Block]:
    """Yield vibration at the speed of the machine as a table, and the largest over the range of speeds."""
    words, summary, listing = material.words, material.summary, material.results.listings.get("torsional_response")
    kinds = ("vibration_amplitude", "vibration_torque", "vibration_stress")
    known = [kind for kind in kinds if any(key.startswith(f"{kind}.") for key in summary)]
    names = list(dict.fromkeys(key_of(key).owner for key in summary if key_of(key).quantity in known))
    rows = [
        (link_label(name, words.language), *(_cell(material, f"{kind}.{name}") for kind in known)) for name in names
    ]
    yield words.table("torsional_vibration", ["row", *map(words.titled, known)], rows, "l" + "r" * len(known),
                      "torsional_vibration")  # fmt: skip
    if listing is None:
        return
    speed, parts = listing.columns["rotational_speed"], list[Run]()
    is_damped = "torsion_undamped" not in [notice.code for notice in material.results.notices]
    for kind in known if is_damped else ():
        own = [key for key in listing.columns if key_of(key).quantity == kind]
        best = max(own, key=lambda key: float(np.max(listing.columns[key])))
        peak = int(np.argmax(listing.columns[best]))
        amount = words.amount(float(listing.columns[best][peak]), key_unit(best), digits=4)
        where = words.amount(float(speed[peak]), "rpm", digits=4)
        name = link_label(key_of(best).owner, words.language)
        parts += ["; " if parts else "", Math(words.symbol(kind)), f" = {amount} ({name}, {where})"]
    low, high = (words.amount(float(end), "rpm", digits=4) for end in (speed[0], speed[-1]))
    yield words.paragraph("torsion_response", low=low, high=high)
    if parts:
        yield words.paragraph("torsion_largest", values=tuple(parts))


def _cell(material: Material, key: str) -> str:
    value = material.summary.get(key)
    unit = key_unit(key)
    return "–" if value is None else material.words.number(displayed(key, value) if unit else value, digits=4)


def _alone(material: Material) -> bool:
    """Return whether discs and shafts are all that a file states."""
    turning = material.machine.turning
    return turning is not None and not turning.diagrams


def _by_methods(material: Material) -> Iterator[Block]:
    """Yield the lines of every method under its name, and the table of what they find."""
    words, summary, lines, last = material.words, material.results.summary, material.lines("flywheel"), ""
    methods = [key_of(key).owner for key in summary if key.startswith("flywheel_inertia.")]
    marks = _marks(methods, material)
    # where all is not shown, the way that leaves nothing out
    shown_lines = lines if material.full else [line for line in lines if "exact" in line.key.split(".")]
    for line in shown_lines:
        method = next((name for name in methods if name in line.key.split(".")), last or methods[0])
        if material.full and method != last and line.key not in _OF_ALL:
            yield Paragraph((Bold(capital(words.way(method))), ":"))
            last = method
        yield from material.worked((line,), marks, again=True)
    excess = {
        name: line.value for name in methods for line in lines if line.key in (f"excess_work.{name}", "excess_work")
    }
    rows = [
        (words.way(name), words.shown("excess_work", excess[name], digits=material.digits),
         words.shown("flywheel_inertia", summary[f"flywheel_inertia.{name}"], digits=material.digits))
        for name in methods
        if name in excess
    ]  # fmt: skip
    if not material.full and material.has_piston:
        inertias = [f"{words.way(name)} – {inertia}" for name, (_, _, inertia) in zip(excess, rows, strict=True)]
        yield words.paragraph("flywheel_others", others="; ".join(inertias[:-1]), unit=words.unit("flywheel_inertia"))
        return
    titles = ("way", words.titled("excess_work"), words.titled("flywheel_inertia"))
    yield words.paragraph("flywheel_ways")
    yield words.table("flywheels", titles, rows, "lrr", "flywheels")


def _marks(methods: list[str], material: Material) -> Mapping[str, str]:
    """Return symbols of the slopes and inertias of each method: its name does not stand in a symbol."""
    words, marks = material.words, dict[str, str]()
    for name in methods:
        for kind in ("flywheel_inertia", "whole_inertia"):
            marks[f"{kind}.{name}"] = words.symbol(kind)
        slope = words.symbol("wittenbauer_slope")
        ends = {"largest": "max", "least": "min"}
        marks[f"wittenbauer_slope.{name}"] = slope
        marks |= {f"wittenbauer_slope.{name}.{end}": f"{slope}_{mark}" for end, mark in ends.items()}
    return marks


def _over_angle(material: Material) -> Iterator[Block]:
    """Yield the table over the angle of a shaft."""
    results, degrees = material.results, material.results.grid.degrees
    stride = math.ceil(degrees.size / _MOST_ANGLES)
    rows = np.unique(np.append(np.arange(0, degrees.size, stride), degrees.size - 1))
    shown = [key for key in _COLUMNS if key in results.columns]
    columns = [quantity_column(material, key, results.columns[key][rows], digits=_DIGITS[key]) for key in shown]
    return position_tables("turning", degrees[rows], columns, material.words, first=None, label="turning")


def _over_cycle(material: Material) -> Iterator[Block]:
    """Yield energy and speed over the cycle, with the figure that the flywheel is found in."""
    caption, is_short = "speed" if material.has("crank_speed") else "energy", not material.full
    until = repeat_interval(material) if is_short and material.has("total_torque") else math.inf
    table = angle_table(material, caption, ("kinetic_energy_change", "crank_speed"), until=until)
    used = ("wittenbauer",) if "wittenbauer" in material.drawn and is_short else _FIGURES
    return material.presented([table], used)


def _whole_inertia(material: Material) -> list[Block]:
    """Return how the parts of a crank gear are reduced, and the sum of those of all cylinders."""
    parts = [line for line in material.lines("reduction", "reduced_inertia") if isinstance(line, FormulaLine)]
    return material.worked([*parts, *material.lines("engine_torque", "total_reduced_inertia")])


def _gear_ratios(material: Material) -> Iterator[Block]:
    """Yield the size of the motor that is selected, and the table of its gear ratios."""
    words, summary, slip = material.words, material.results.summary, selection_of(material.machine).slip
    size = summary.get("standard_motor_power")
    if size is None:
        yield words.paragraph("motor_beyond", source=Citation(SERIES_SOURCE))
    else:
        yield words.paragraph("motor_size", source=Citation(SERIES_SOURCE), size=words.amount(size, "kW", digits=4))
    speeds = {float(key_of(key).owner): value for key, value in summary.items() if key.startswith("motor_ratio.")}
    rows = [
        tuple(words.number(value, digits=4) for value in (speed, speed * (1 - slip), ratio))
        for speed, ratio in speeds.items()
    ]
    titles = [(words.column(key, "rpm"),) for key in ("synchronous_speed", "rated_speed")]
    yield words.table("gear_ratios", (*titles, words.titled("motor_ratio")), rows, "rrr", "gear_ratios")


def _is_wanted(material: Material) -> bool:
    """Return whether a fluctuation of the speed is wanted, for which a flywheel is found."""
    return material.machine.drive.fluctuation is not None


_FOUND: tuple[Part, ...] = (
    When(
        either(full, drawn),
        (
            Text(
                "flywheel", {"value": lambda material: material.words.number(material.machine.drive.fluctuation or 0.0)}
            ),
        ),
    ),
    _by_methods,
)
_OF_ENERGY_AND_SPEED = ("kinetic_energy_change", "crank_speed")
_OF_ENERGY = has("excess_work.mertsalov")
_IS_EXACT = every(_is_wanted, has("flywheel_inertia.exact"))
_STEADY = Text("steady", {"speed": amount("steady_speed", "rpm"), "fluctuation": number("steady_fluctuation")})


def _driven(material: Material) -> Iterator[Block]:
    """Yield how the machine is let go, and what drives it."""
    words, wanted = material.words, material.machine.transient
    if wanted is None:
        return
    driven = "transient_motor" if wanted.motor else "transient_torque" if wanted.torque else "transient_free"
    yield words.paragraph(
        driven,
        angle=words.amount(wanted.start, "deg"),
        speed=words.amount(wanted.speed, "rad/s"),
        torque=words.amount(wanted.torque, "N*m"),
    )


def _motion(material: Material) -> Iterator[Block]:
    """Yield a table of some rows of the motion."""
    columns = material.results.listings["transient"].columns
    count = len(columns["time"])
    rows = np.unique(np.round(np.linspace(0, count - 1, min(_ROWS, count))).astype(int))
    keys = [*(key for key in _SHOWN if np.any(columns[key])), *named(columns, "slider_displacement")]
    yield _table("transient", {key: columns[key][rows] for key in keys}, material)


def _events(material: Material) -> Iterator[Block]:
    """Yield a table of what happened."""
    happened = material.results.listings.get("transient_events")
    if happened is not None:
        names = [row_name(name, material.words.language) for name in happened.names[:_MOST_EVENTS]]
        shown = {key: column[:_MOST_EVENTS] for key, column in happened.columns.items()}
        yield _table("transient_events", shown, material, names)


def _table(caption: str, columns: Mapping[str, Array], material: Material, names: Sequence[str] = ()) -> Table:
    """Return columns as a table, rows called by names where they have some."""
    made = quantity_columns(material, columns, columns)
    if names:
        made.insert(0, Column((material.words.column("event"),), names))
    rows = list(zip(*(column.entries for column in made), strict=True))
    align = "l" * bool(names) + "r" * len(columns)
    return material.words.table(caption, [column.heading for column in made], rows, align, caption)


SECTIONS = (
    # for one cylinder only where the order of sections asks for it
    Section("torque", (
        Head("total"), When(ONE, (Text("one_cylinder"),)),
        When(_SEVERAL, (Text("total"), Text("order", {"order": _firing_order}))),
        Lines("firing"), Lines("uniformity", ("mean_total_torque", "mean_driving_torque", "mean_torque")),
        When(_SEVERAL, (
            Shown((), (Rows("firing", "firing"),)), At("engine_torque"),
            Lines("engine_torque", (
                "tangential_force", "crank_torque", "throw_torque", "total_torque", "total_tangential_force",
            )),
        )),
        When(every(_SEVERAL, lacks(full), lambda material: repeat_interval(material) < math.inf), (_REPEATS,)),
        When(_SEVERAL, (Shown(("total_tangential_force", "total_torque"), (_all_cylinders,)),)),
        When(ONE, (
            Shown(("total_torque",)),
            When(every(full, draws("torque")), (Text("see_figure", {"figures": Reference("f:torque")}),)),
        )),
        When(every(full, _SEVERAL), HARMONICS),
    ), every(has("total_torque_max"), either(_SEVERAL, every(ONE, school("vi"))))),
    Section("static", (
        Head("static"),
        When(lacks(_states("static_torque")), (
            Text("given_balancing"), At("torques"), Lines("torques", ("static_torque",)),
        )),
        _over_positions("table_static", "static", "static_torque"),
    ), every(_IS_TABLE, has("static_torque"))),
    Section("dynamic", (
        Head("dynamic"), Text("table_reduction", {**_CITED, "table": Reference("t:transfer")}), Lines("speed"),
        At("reduction"), Lines("reduction", ("reduced_inertia",)),
        When(_states("reduced_inertia_1"), (Text("given_derivative"),)),
        When(lacks(_states("reduced_inertia_1")), (_at_all("reduced_inertia_1"),)),
        _over_positions("reduced", "reduced", "reduced_inertia", "reduced_inertia_1"), Shown(("reduced_inertia",)),
        _at_all("dynamic_torque"),
    ), _IS_TABLE),
    Section("driving", (
        Head("driving"), Text("torques"), _losses, When(_is_lossy, (Text("driving"),)), _at_all("driving_torque"),
        _over_positions("table_torque", "torque", *_OF_TABLE), Shown(("torques",)),
    ), every(_IS_TABLE, has("driving_torque"))),
    Section("moments", (
        Head("turning_moments"),
        When(has("turning_moment"), (
            Lines("stretches"), At("turning_moments"), Lines("turning_moments"), Text("mean_of_torque"),
        )),
        Lines("shaft_power"),
    ), has_torques),
    Section("reduction", (
        Head("reduction"), Text("reduction", _CITED), At("reduction"), Lines("reduction"),
        _reduced_by_links,
        Shown(("reduced_inertia",)),
    ), every(turning, has("reduced_inertia"))),
    Section("torques", (
        Head("torques"), When(_has_static, (Text("torques"),)), When(lacks(_has_static), (Text("torques_dynamic"),)),
        At("torques"), Lines("torques", ("static_torque", "dynamic_torque", "balancing_torque")), _losses,
        When(_is_lossy, (Text("driving"), Lines("torques", ("driving_torque",)))),
        Places("table_torque", _TORQUES, "torque", filled=True),
        Shown(("torques",)),
    ), every(turning, has("reduced_inertia"))),
    Section("harmonics", (
        Head("torque_harmonics"), Text("crank_harmonics", {"source": Citation(_HARMONICS)}), Lines("crank_harmonics"),
        Listed("torque_harmonics", "harmonics"), Shown(("torque_harmonics",)),
    ), every(full, turning, has("torque_harmonics"))),
    Section("task", (
        Head("task"), Text("task_torsion", {
            "discs": lambda material: str(len(material.results.listings["torsional_discs"].names)),
            "shafts": lambda material: str(len(material.results.listings["torsional_shafts"].names)),
        }),
    ), _alone),
    Section("torsion", (
        Head("torsion"), When(lacks(_alone), (Text("torsion_of_engine"),)), _Listing("torsional_discs"),
        _worked, _Listing("torsional_shafts"), _torques,
        When(has("natural_modes"), (
            Text("torsion_modes", {"equation": lambda _: _EQUATION, "J": lambda _: Math("J"), "K": lambda _: Math("K"),
                                    "source": Citation("thomson_1988, ch. 6")}), _Listing("natural_modes"),
            Shown(("torsional_modes",)), _nodes,
        )),
        When(has("holzer"), (Text("torsion_holzer", {"source": Citation(_HOLZER)}), _Listing("holzer"))),
        _Listing("holzer_trials"), _Listing("damped_modes"),
        When(has("critical_speeds"), (
            Text("torsion_critical", {"source": Citation(_ORDERS)}), _Listing("critical_speeds"), Shown(("campbell",)),
        )),
        When(lambda material: any(key.startswith("vibration_amplitude.") for key in material.summary),
             (_vibration, Shown(("torsional_response",)))),
        Lines("torsional_dampers", intro="torsion_dampers"),
    ), has("torsional_discs")),
    Section("evenness", (
        Head("evenness"), When(every(_OF_ENERGY, lacks(_IS_EXACT)), (Text("evenness_of_all"),)),
        When(every(_OF_ENERGY, _IS_EXACT), (
            Text("evenness_exact", {"work": lambda material: Math(material.words.symbol("excess_work.exact"))}),)),
        When(lacks(_OF_ENERGY), (Text("evenness"),)), When(either(full, lacks(_IS_EXACT)), (Lines("uniformity"),)),
        When(_IS_EXACT, (
            At("reduction"), _whole_inertia, *_FOUND,
        )),
        _over_cycle,
        When(every(full, ONE), HARMONICS),
    ), has("piston_displacement", "excess_work")),
    Section("energy", (
        Head("energy_extremes"),
        When(has("energy_extremes"), (Text("extremes_of_energy"), Listed("energy_extremes", "energy_extremes"))),
        Lines("energy_extremes"), Shown(("turning_moment", "loops")),
    ), has_torques),
    Section("flywheel", (Head("flywheel"), Lines("flywheel")), every(has_torques, works("flywheel"))),
    Section("law_of_motion", (
        Head("law_of_shaft"), When(has("crank_speed"), (Text("speed_of_shaft"),)), Lines("shaft_course"), _over_angle,
        Shown(("speed",)),
    ), lambda material: bool(material.machine.turning) and any(map(material.has, _COLUMNS))),
    Section("motor", (
        Head("motor"), Text("motor_choice", {
            "slip": lambda material: material.words.number(100 * selection_of(material.machine).slip)}),
        Lines("motor", ("shaft_power", "efficiency", "motor_power")),
        When(full, (Lines("motor"),)), When(lacks(full), (Lines("motor", ("motor_ratio",), first=True),)),
        _gear_ratios,
    ), every(works("motor"), lambda material: material.machine.drive.motor is None)),
    Section("motor", (Head("motor"), Text("motor", {
        "rated": lambda material: material.words.amount(material.machine.drive.rated_power, "kW")}), Lines("motor")),
            lambda material: turning(material) and material.machine.drive.motor is not None),
    Section("flywheel", (
        Head("flywheel"), When(lacks(_is_wanted), (Lines("flywheel"),)),
        When(_is_wanted, (*_FOUND, Shown(("wittenbauer",)))),
    ), every(turning, has("excess_work"))),
    Section("law_of_motion", (
        Head("law"), When(has("crank_speed"), (Text("law"), Places("speeds", _OF_ENERGY_AND_SPEED), Shown(("speed",)))),
        When(has("steady_speed"), (_STEADY,)),
    ), lambda material: turning(material) and any(map(material.has, ("crank_speed", "steady_speed")))),
    Section("transient", (
        Head("transient"), Text("transient_equation", {"source": Citation(_DYNAMICS)}), _driven,
        Text("transient_end", {
            "time": amount("transient_time", "s"), "turn": amount("final_turn", "deg"),
            "speed": amount("final_speed", "rad/s"),
        }),
        _motion, Shown(("transient",)), _events,
    ), lambda material: turning(material) and material.has("transient")),
)  # fmt: skip
