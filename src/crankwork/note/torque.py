"""The torque in a note: of all cylinders, reduced to a crank, of a table, on a shaft; its harmonics and losses."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import ArrayLike

from crankwork.formula.replay import Program
from crankwork.formula.traced_value import in_order
from crankwork.note.document import Block, Citation, Equation, Reference, Table
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
    draws,
    either,
    every,
    full,
    has,
    has_torques,
    lacks,
    machine_has,
    school,
    turning,
)
from crankwork.note.tables import Column, angle_table, position_tables, quantity_columns, tabulated

# terms of links that a table has beside their sum
_MOST_LINKS = 6
# share of the largest torque that is rounding
_NOISE = 1e-6
_WORK, _EFFICIENCY, _HARMONICS = "artobolevsky_1988, ch. 15", "artobolevsky_1988, ch. 14", "den_hartog_1956, ch. 5"
_TORQUES = ("static_torque", "dynamic_torque", "balancing_torque", "driving_torque")
_OF_TABLE = ("reduced_inertia_1", "dynamic_torque", "static_torque", "balancing_torque", "driving_torque")


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
        for number, degrees in enumerate(results.grid.degrees.tolist(), start=1):
            yield Equation(results.moment(degrees).step(results.trace[key]), symbol=_numbered(shown, number))

    return equations


def _numbered(symbol: str, position: int) -> str:
    return f"{symbol}{',' if '_' in symbol else '_'}{position}"


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
)  # fmt: skip
