"""The figures of a drawn linkage, and of what is reduced to a driver: which there are, from the results."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.chambers import indicators
from crankwork.analysis.diagrams import Fluctuation
from crankwork.analysis.moving import moving, reached_angles
from crankwork.analysis.plans import DriverRates, driver_rates, worked_position
from crankwork.analysis.rounding import without_rounding
from crankwork.formula.known import Found, breaks_of
from crankwork.locale import say
from crankwork.machine import Machine
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.figure_data import figure_title
from crankwork.report.language import label, symbol
from crankwork.report.linkage_bearings import bearing_pictures
from crankwork.report.linkage_centrodes import centrodes
from crankwork.report.linkage_curves import STYLES, curves
from crankwork.report.linkage_energy import speed_curve, wittenbauer
from crankwork.report.linkage_force_figures import force_figure
from crankwork.report.linkage_lever import lever_figure
from crankwork.report.linkage_look import PLAIN, Style, axis_title, displayed_values, quantity_of
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.report.summary import results_method
from crankwork.report.tables import any_nonzero
from crankwork.show.chart import Graph, Row, limits, round_ticks, sheet, write_method
from crankwork.show.paper import plain
from crankwork.show.scene import Drawing

_DENSE_STEP = 2.0
_PER_PANEL = 4
# behind a corner, where there may be a jump [deg]
_AFTER = 1e-6

Pictures = dict[str, Callable[[], Drawing]]


def linkage_pictures(results: Results, language: Language) -> Pictures:
    """Return what draws each figure of a linkage where it is placed."""
    style = Style(language, (), results_method(results, language), results.period)
    if results.machine.linkage is None:
        columns = without_rounding(results.columns, results.machine.speed)
        return _dynamics(*_closed(results.grid.degrees, columns, results.machine.cycle), style)
    return _of_drawing(results, results.machine.linkage, style)


def _of_drawing(results: Results, linkage: Linkage, style: Style) -> Pictures:
    """Return the figures of a linkage that was drawn, between its dead positions."""
    machine, (found, _) = results.machine, structure(linkage)
    ends = [results.summary[one] for one in ("crank_range_start", "crank_range_end") if one in results.summary]
    style = style._replace(links=found.links if found is not None else (), limits=tuple(np.degrees(ends).tolist()))
    degrees, is_whole = reached_angles(machine, _DENSE_STEP)
    worked = worked_position(results)
    degrees = np.union1d(_with_corners(results, degrees), worked)
    known = without_rounding(results.columns_at(degrees), results.solved.speed)
    rates = driver_rates(results, known)
    drawn = _driver(degrees, known, style) if style.period else {}
    at = int(np.searchsorted(degrees, worked))
    drawn |= _plans(machine, degrees, at, rates, style, is_whole=is_whole)
    drawn |= _sliders(degrees, known, style)
    drawn |= _links(degrees, known, style)
    drawn |= _points(degrees, known, style)
    if not style.period:
        drawn |= centrodes(machine.mechanism, known, degrees, at, style)
    drawn |= chamber_figures(results, degrees, known, style)
    drawn |= _dynamics(degrees, known, style)
    if "joint_forces" in drawn:
        drawn |= force_figure(results, float(degrees[at]), style)
        drawn |= {} if style.period else lever_figure(results, float(degrees[at]), style)
    drawn |= bearing_pictures(results, style.language)
    drawn |= transient_figures(results, style)
    if is_whole:
        drawn |= _evenness(results, degrees, known, style)
    return drawn


def _with_corners(results: Results, degrees: Array) -> Array:
    """Return crank angles with those of extremes, and on both sides of where a load jumps or bends. [deg]"""
    found = breaks_of([results.memory[key] for key in results.columns if key in results.memory], results.machine.cycle)
    single = (results.memory[key].node for key in results.summary if key in results.memory)
    extremes = [one.at for one in single if isinstance(one, Found) and one.at is not None]
    found = np.concatenate([found, found + _AFTER, extremes])
    return np.union1d(degrees, found[(found >= degrees[0]) & (found <= degrees[-1])])


def _closed(degrees: Array, columns: Mapping[str, Array], cycle: float) -> tuple[Array, Mapping[str, Array]]:
    """Return a table up to the end of its cycle, where it is what it was at the beginning."""
    step = float(degrees[-1] - degrees[-2])
    if degrees[0] != 0 or abs(degrees[-1] + step - cycle) > _AFTER:
        return degrees, columns
    return np.append(degrees, cycle), {key: np.append(one, one[0]) for key, one in columns.items()}


def _plans(machine: Machine, degrees: Array, at: int, rates: DriverRates, style: Style, *, is_whole: bool) -> Pictures:
    """Return position plans of all that is reached, and the plans of velocity and acceleration at one crank angle.

    `at`: which of the crank angles.
    """
    mechanism = machine.mechanism
    ends = None if is_whole else (float(degrees[0]), float(degrees[-1]))
    plans = {"position_plans": partial(position_plans, mechanism, ends, float(degrees[at]), style)}
    moved, first, second = moving(mechanism, degrees), float(rates.first[at]), float(rates.second[at])
    return plans | {
        "velocity_plan": partial(velocity_plan, mechanism, moved, at, first, style),
        "acceleration_plan": partial(acceleration_plan, mechanism, moved, at, first, second, style),
    }


def _driver(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return coordinate and rates of the driver, its force or torque, its power."""
    panels = [key for key in known if key.startswith("driver_")]
    return {"driver": partial(curves, degrees, known, panels, say("tables.driver", style.language), style)}


def _sliders(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    kinds = ("slider_displacement", "slider_velocity", "slider_acceleration")
    return _by_fours("sliders", kinds, _named(known, kinds[0]), degrees, known, style)


def _links(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return angle, angular velocity and acceleration of the links."""
    kinds = ("link_angle", "link_angular_velocity", "link_angular_acceleration")
    return _by_fours("links", kinds, _named(known, kinds[1]), degrees, known, style)


def _points(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return place, velocity and acceleration of the points that have names of their own."""
    kinds = ("point_x", "point_y", "point_velocity", "point_acceleration")
    names = [one for one in _named(known, kinds[2]) if "." not in one]
    return _by_fours("points", kinds, names, degrees, known, style)


def _named(known: Mapping[str, Array], kind: str) -> list[str]:
    """Return what a quantity is known of."""
    return [key.partition(".")[2] for key in known if key.startswith(f"{kind}.")]


def _by_fours(
    figure: str,
    kinds: Sequence[str],
    names: Sequence[str],
    degrees: Array,
    known: Mapping[str, Array],
    style: Style,
) -> Pictures:
    """Return quantities of all that have them, a few in each figure; those after the first have numbers."""
    names = [one for one in names if all(f"{kind}.{one}" in known for kind in kinds)]
    found: Pictures = {}
    for first in range(0, len(names), _PER_PANEL):
        name = f"{figure}_{first // _PER_PANEL + 1}" if first else figure
        panels = [[f"{kind}.{one}" for one in names[first : first + _PER_PANEL]] for kind in kinds]
        found[name] = partial(curves, degrees, known, panels, figure_title(name, style.language), style)
    return found


def _dynamics(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return reduced inertia, torques and joint forces."""
    result: Pictures = {}
    inertia = any_nonzero(("reduced_inertia", "reduced_inertia_1"), known)
    if inertia and "dynamic_torque" in known:
        result["reduced_inertia"] = partial(
            curves, degrees, known, inertia, label("reduced_inertia", style.language), style
        )
    torques = any_nonzero(("static_torque", "dynamic_torque", "driving_torque"), known)
    if torques:
        # a machine that nobody drives
        gives = "driving_torque" in torques and np.nanmean(known["driving_torque"]) < 0
        sign = f"${symbol('driving_torque', style.language)}$"
        remark = say("drawing.gives_work", style.language, symbol=sign) if gives else ""
        title = label("driving_torque", style.language)
        result["torques"] = partial(curves, degrees, known, [torques], title, style, remark)
    result |= _friction(degrees, known, style)
    panels = []
    # magnitudes in pins, and apart from them forces of guides, which have a sign
    for kind in ("joint_force", "normal_force"):
        held = any_nonzero((key for key in known if key.partition(".")[0] == kind), known)
        panels += _panels(held)
    if panels:
        result["joint_forces"] = partial(
            curves, degrees, known, panels, say("tables.joint_forces", style.language), style
        )
    return result


def _friction(degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return what the driver needs with and without friction, and the efficiency."""
    pairs = (("balancing_torque", "torque_with_friction"), ("driver_force", "driver_force_with_friction"),
             ("driver_torque", "driver_torque_with_friction"))  # fmt: skip
    panels = [[one for one in pair if one in known] for pair in pairs if pair[1] in known]
    ratio = [["instantaneous_efficiency"]] if "instantaneous_efficiency" in known else []
    if not panels or not all(np.isfinite(known[key]).any() for key in itertools.chain(*panels, *ratio)):
        return {}
    title = say("tables.friction", style.language)
    return {"friction": partial(curves, degrees, known, [*panels, *ratio], title, style)}


def _evenness(results: Results, degrees: Array, known: Mapping[str, Array], style: Style) -> Pictures:
    """Return the energy-mass diagram and the speed with the flywheel found."""
    if "crank_speed" not in known:
        return {}
    speed, drive = results.solved.speed, results.machine.drive
    evenness = Fluctuation(speed, results.summary["speed_fluctuation"])
    course: Pictures = {"speed": partial(speed_curve, degrees, known["crank_speed"], evenness, style)}
    if drive.fluctuation is None:
        return course
    wanted = Fluctuation(speed, drive.fluctuation)
    energy, inertia = known["kinetic_energy_change"], known["reduced_inertia"]
    if np.any(inertia):
        # without masses the energy stands over one point
        course["wittenbauer"] = partial(wittenbauer, inertia, energy, wanted, degrees, style)
    return course


_KINDS = ("cylinder_volume", "gas_pressure", "gas_force", "rod_load")


def chamber_figures(
    results: Results, degrees: Array, known: Mapping[str, Array], style: Style = PLAIN
) -> dict[str, Callable[[], Drawing]]:
    """Return the figures of the gas by name; none without chambers."""
    panels = [keys for kind in _KINDS for keys in _panels([one for one in known if one.partition(".")[0] == kind])]
    if not panels:
        return {}
    return {
        "indicator": partial(indicator, results, style),
        "chambers": partial(curves, degrees, known, panels, say("figures.chambers", style.language), style),
    }


def indicator(results: Results, style: Style = PLAIN) -> Drawing:
    """Return pressure over volume of every chamber."""
    found = indicators(results)
    volume, pressure = quantity_of("cylinder_volume"), quantity_of("diagram_pressure")
    drawn = {
        name: (displayed_values(volume, one.volume), displayed_values(pressure, one.pressure))
        for name, one in found.items()
    }
    rows = [Row(plain(name), STYLES[number % 4]) for number, name in enumerate(drawn)] if len(drawn) > 1 else []
    paper, box = sheet(259.0, rows)
    x, y = (limits(*some, margin=0.05) for some in zip(*drawn.values(), strict=True))
    graph = Graph(paper, box, x, y, style.language)
    graph.frame(round_ticks(*x), round_ticks(*y, 10))
    for number, (name, (across, up)) in enumerate(drawn.items()):
        # tables of a law over time go by time
        angles = found[name].degrees * (results.period / 360.0 if results.period else 1.0)
        graph.curve(name, across, up, STYLES[number % 4], angles=angles)
    graph.x_title(axis_title(volume, style.language))
    graph.y_title(axis_title(pressure, style.language))
    write_method(paper, style.method)
    return paper.drawing(say("figures.indicator", style.language), style.language)


def _panels(keys: Sequence[str]) -> list[Sequence[str]]:
    return [keys[start : start + _PER_PANEL] for start in range(0, len(keys), _PER_PANEL)]


_PANELS = (("crank_angle",), ("crank_speed",), ("kinetic_energy", "potential_energy"), ("driving_torque",))


def transient_figures(results: Results, style: Style) -> dict[str, Callable[[], Drawing]]:
    """Return crank angle, speed, energies and torque since a machine was let go; none where it was not."""
    if "transient" not in results.listings:
        return {}
    columns = results.listings["transient"].columns
    time = columns["time"]
    panels = [tuple(key for key in panel if key in columns and np.any(columns[key])) for panel in _PANELS]
    in_time = style._replace(period=float(time[-1]))
    shown = [panel for panel in panels if panel]
    title = say("tables.transient", style.language)
    return {"transient": partial(curves, 360.0 * time / time[-1], columns, shown, title, in_time)}
