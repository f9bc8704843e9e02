"""Figures of results, as many as there are data for: the one list of them, and what is drawn of it."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.compare import Comparison, comparison_key, difference_key
from crankwork.analysis.constructions import force_laws
from crankwork.analysis.sampled_motion import SampledMotion, sample_motion
from crankwork.analysis.stages import stage_diagrams
from crankwork.analysis.vector_polygons import accelerations, driver_rates, position_step, velocities
from crankwork.errors import CrankworkError, InputError, Problem
from crankwork.locale import ErrorMessage, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language, Quantity
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of, use_numbers
from crankwork.report.cylinders import (
    balance_ellipses,
    balance_orders,
    balance_polygons,
    big_end_polar,
    crankpin_load,
    crankpin_polar,
    crankpin_polar_of_one,
    crankpin_wear,
    curved_loci,
    has_polygons,
    main_journal_polar,
    main_wear,
    phase_stars,
    small_end_polar,
    torque_harmonics,
)
from crankwork.report.display import displayed, for_readers, in_own_units, key_unit, link_numbers, symbol
from crankwork.report.forces import (
    force_law,
    forces_over_cycle,
    has_force_plans,
    has_lever,
    lever_figure,
    piston_forces,
    plans_of_forces,
)
from crankwork.report.gas import (
    chamber_indicator,
    indicator,
    log_indicator,
    pressure,
    pump_flow,
    recorded_cycles,
    rod_loads,
    stage_indicator,
    willans,
)
from crankwork.report.look import (
    PLAIN,
    Drawn,
    Style,
    axis_title,
    displayed_values,
    drawn_of,
    drive_graph,
    figure_title,
    key_of_links,
    kind_of,
    math_symbol,
    quantity_of,
)
from crankwork.report.motion import brix, centrodes, curved_paths, has_centrodes, kinematics, path_figure, tolle
from crankwork.report.plans import acceleration_plan, position_plans, size_of, velocity_plan
from crankwork.report.tables import any_nonzero, shown_names
from crankwork.report.torque import (
    accumulated_torque,
    campbell,
    crank_speed,
    cylinder_torques,
    excess_work,
    has_energy_mass_diagram,
    has_speed,
    has_turning_moment,
    loops,
    natural_modes,
    speed_curve,
    torque,
    torsional_response,
    total_tangential_force,
    total_torque,
    turning_moment,
    wittenbauer,
)
from crankwork.show.canvas import Canvas, current_layout, plain, scaled_height
from crankwork.show.chart import (
    BOTTOM,
    LEGEND_ROW,
    TOP,
    ChartBox,
    Graph,
    Row,
    limits,
    name_at_the_end,
    over_cycle,
    round_ticks,
    sheet,
    write_remark,
)
from crankwork.show.label_placement import mark_point
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, STYLES, Drawing
from crankwork.show.scene import Style as Dashes
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

# curves of a panel, and of what there is more is drawn in further figures
_PER_PANEL = 4
# what shows a machine at the position that is worked
AT_ONE_POSITION = frozenset({"velocity_plan", "acceleration_plan", "force_plans", "zhukovsky_lever", "centrodes"})
Needs = Callable[[Drawn], bool]
Draw = Callable[[Drawn], tuple[Canvas, Mapping[str, Graph]]]
_ALONE, _PANEL, _GAP = 216.0, 126.0, 16.0
# what a page of a note holds with its caption [pt]
_TALLEST = 600.0
# characters of a name that fit beside a panel
_LONG = 36
# what tells where something is
_PLACES = ("slider_displacement", "driver_displacement", "driver_angle", "link_angle", "point_x", "point_y")
# curves nearer than this share of the range fall together in print
_SAME, _ROUNDING = 0.003, 1e-9
# of a comparison
_STEP, _MOST = 1.0, 2000
# a cycle of more has no lines at multiples of 90 degrees
_LONG_CYCLE = 720.0
_COLOURS = ("#000000", "#b03030", "#2f5fa8", "#3a7d44", "#8a5a9c", "#a87b1f", "#4d4d4d")
_UPPER, _LOWER, _BETWEEN = 110.0, 62.0, 12.0
# what a page of a note holds of it together with its caption, without axis and edges [pt]
_TALLEST_NOTE = 540.0
# what a figure shows: of each row the first kind that there is
_DRAWN = (
    ("piston_displacement", "slider_displacement", "link_angle", "turning_moment"),
    ("piston_velocity", "slider_velocity", "link_angular_velocity", "excess_torque"),
    ("piston_acceleration", "slider_acceleration", "link_angular_acceleration", "kinetic_energy_change"),
    ("total_torque", "crank_torque", "driving_torque", "balancing_torque", "static_torque", "driver_force",
     "driver_torque"),
)  # fmt: skip


class Diagram(NamedTuple):
    """A figure with its name, what draws it on a paper, and what of a machine it needs."""

    name: str
    draw: Draw
    needs: Needs
    frame: str | Callable[[Drawn], str] = ""  # Key of the remark at its lower left: the frame of its vectors
    is_of_forces: bool = False  # Whether its values may be by the piston area
    owner: str = ""  # What it is of, for its title
    number: str = ""  # That of a crankpin, where there are several

    def picture(self, machine: Drawn) -> Drawing:
        """Return it."""
        title = kind_of(self.name) + (f"_{self.number}" if self.number else "")
        frame = self.frame(machine) if callable(self.frame) else self.frame
        remark = translate(f"drawing.{frame}", machine.language) if frame else ""
        paper, _ = self.draw(machine)
        return machine.finished(title, paper, remark, forces=self.is_of_forces, owner=self.owner)


class Construction(NamedTuple):
    """A figure that states its method and title itself."""

    name: str
    picture: Callable[[Drawn], Drawing]
    needs: Needs


class Curves(NamedTuple):
    """A figure of curves: the keys of each of its panels, and the key of its own title; it needs what they have."""

    name: str
    panels: Callable[[Drawn], Sequence[Sequence[str]]]
    title: str = ""
    when: Needs = lambda _: True
    remark: Callable[[Drawn], str] = lambda _: ""

    def needs(self, machine: Drawn) -> bool:
        """Return whether there is anything in it."""
        return self.when(machine) and bool(self.panels(machine))

    def picture(self, machine: Drawn) -> Drawing:
        """Return it."""
        reached, style, panels = machine.reached, machine.style, self.panels(machine)
        title = translate(self.title, style.language) if self.title else figure_title(self.name, style.language)
        return curves(reached.degrees, reached.columns, panels, title, style, self.remark(machine))


class Several(NamedTuple):
    """Figures of one kind whose number depends on the machine."""

    each: Callable[[Drawn], Iterable[Diagram | Construction | Curves]]
    needs: Needs


Entry = Diagram | Construction | Curves | Several


def has(*keys: str) -> Needs:
    """Return the condition that results have a column, or a listing, of each name."""
    return lambda machine: all(key in machine.results.columns or key in machine.results.listings for key in keys)


def piston(*keys: str) -> Needs:
    """Return the condition that a piston has a column of each name."""
    return lambda machine: machine.has_piston and all(key in machine.columns for key in keys)


def every(*conditions: Needs) -> Needs:
    """Return the condition that all of some hold."""
    return lambda machine: all(condition(machine) for condition in conditions)


def _drawn(machine: Drawn) -> bool:
    """Return whether links are drawn one by one."""
    return machine.results.machine.linkage is not None


def _turning(machine: Drawn) -> bool:
    """Return whether links are drawn, and no law over time drives."""
    return _drawn(machine) and not machine.style.period


def _engine(machine: Drawn) -> bool:
    """Return whether cylinders turn a shaft, and their torque is known."""
    return machine.has_piston and machine.results.machine.engine is not None and "crank_torque" in machine.columns


def _many(machine: Drawn) -> bool:
    return _engine(machine) and machine.diagrams.count > 1


def _of_kinds(*kinds: str) -> Callable[[Drawn], list[Sequence[str]]]:
    """Return what gives panels of the columns of each kind, a few in each."""

    def panels(machine: Drawn) -> list[Sequence[str]]:
        columns = machine.reached.columns
        return [keys for kind in kinds for keys in _few_curves(_named(columns, kind), columns)]

    return panels


def _few_curves(keys: Sequence[str], columns: Mapping[str, Array]) -> Iterator[Sequence[str]]:
    """Yield a few keys at a time; curves that coincide, and are drawn once, count as one."""
    groups = _together([columns[key] for key in keys])
    for start in range(0, len(groups), _PER_PANEL):
        yield [keys[index] for group in groups[start : start + _PER_PANEL] for index in group]


def _by_fours(keys: Sequence[str]) -> list[Sequence[str]]:
    return [keys[start : start + _PER_PANEL] for start in range(0, len(keys), _PER_PANEL)]


def _named(columns: Iterable[str], kind: str) -> list[str]:
    return [key for key in columns if key_of(key).quantity == kind]


def _as_they_are(panels: Sequence[Sequence[str]], _: Drawn) -> Sequence[Sequence[str]]:
    return panels


def _each(figure: str, *kinds: str, owners: int = 0) -> Several:
    """Return figures of all that have some quantities, a few in each; those after the first have numbers."""

    def figures_(machine: Drawn) -> Iterable[Curves]:
        columns = machine.reached.columns
        names = [key_of(key).owner for key in _named(columns, kinds[owners])]
        # points of a link that have no name of their own are not told
        names = [name for name in names if all(f"{kind}.{name}" in columns for kind in kinds)
                 and not (figure == "points" and "." in name)]  # fmt: skip
        for count, group in enumerate(_by_fours(names), start=1):
            panels = [[f"{kind}.{name}" for name in group] for kind in kinds]
            name = f"{figure}_{count}" if count > 1 else figure
            yield Curves(name, partial(_as_they_are, panels), when=_drawn)

    return Several(figures_, _drawn)


def _paths(machine: Drawn) -> Iterable[Construction]:
    """Yield figures of the paths of points in the plane, a few in each."""
    for count, group in enumerate(_by_fours(list(curved_paths(machine))), start=1):
        yield Construction(f"paths_{count}" if count > 1 else "paths", partial(path_figure, names=group), _drawn)


def _unbalanced(machine: Drawn) -> list[Sequence[str]]:
    """Return the forces and the couple of what moves along the line of stroke."""
    columns = machine.results.columns
    forces = [key for key in columns if key.startswith("unbalanced_force")]
    return [forces, *[("unbalanced_couple",)] * ("unbalanced_couple" in columns)] if forces else []


def _inertia(machine: Drawn) -> list[Sequence[str]]:
    columns = machine.reached.columns
    keys = any_nonzero(("reduced_inertia", "reduced_inertia_1"), columns)
    return [(key,) for key in keys] if "dynamic_torque" in columns else []


def _torques(machine: Drawn) -> list[Sequence[str]]:
    keys = any_nonzero(("static_torque", "dynamic_torque", "driving_torque"), machine.reached.columns)
    return [keys] if keys else []


def _gives_work(machine: Drawn) -> str:
    """Return the remark on a machine that nobody drives."""
    driving = machine.reached.columns.get("driving_torque")
    gives = driving is not None and bool(np.any(driving)) and np.nanmean(driving) < 0
    sign = f"${symbol('driving_torque', machine.language)}$"
    return translate("drawing.gives_work", machine.language, symbol=sign) if gives else ""


def _friction(machine: Drawn) -> list[Sequence[str]]:
    """Return the driving forces and torques with and without friction, and the efficiency."""
    columns = machine.reached.columns
    pairs = (("balancing_torque", "torque_with_friction"), ("driver_force", "driver_force_with_friction"),
             ("driver_torque", "driver_torque_with_friction"))  # fmt: skip
    panels = [[key for key in pair if key in columns] for pair in pairs if pair[1] in columns]
    ratio = [["instantaneous_efficiency"]] if "instantaneous_efficiency" in columns else []
    shown = itertools.chain(*panels, *ratio)
    return [*panels, *ratio] if panels and all(np.isfinite(columns[key]).any() for key in shown) else []


def _joint_forces(machine: Drawn) -> list[Sequence[str]]:
    """Return magnitudes in pins, and apart from them forces of guides, which have a sign."""
    columns = machine.reached.columns
    kinds = (any_nonzero(_named(columns, kind), columns) for kind in ("joint_force", "normal_force"))
    return [panel for keys in kinds for panel in _few_curves(keys, columns)]


_IN_TIME = (("crank_angle",), ("crank_speed",), ("kinetic_energy", "potential_energy"), ("driving_torque",))


def _transient(machine: Drawn) -> Drawing:
    """Return crank angle, speed, energies and torque since a machine was let go."""
    columns = machine.results.listings["transient"].columns
    time = columns["time"]
    panels = [tuple(key for key in panel if key in columns and np.any(columns[key])) for panel in _IN_TIME]
    style = machine.style._replace(period=float(time[-1]))
    title = translate("tables.transient", machine.language)
    return curves(360.0 * time / time[-1], columns, [panel for panel in panels if panel], title, style)


def _positions(machine: Drawn) -> Drawing:
    """Return position plans over the whole motion."""
    reached = machine.reached
    ends = None if reached.is_whole else (float(reached.degrees[0]), float(reached.degrees[-1]))
    mechanism, step = machine.results.machine.mechanism, position_step(machine.results.machine)
    return position_plans(mechanism, ends, float(reached.degrees[reached.row]), machine.style, step)


def _plan(order: int) -> Callable[[Drawn], Drawing]:
    """Return what draws the plan of velocities, or of accelerations, at the angle that is worked."""

    def picture(machine: Drawn) -> Drawing:
        mechanism, (moved, first, second) = machine.results.machine.mechanism, _state(machine)
        among = machine.plans[order - 1] if machine.plans else ()
        if order == 1:
            return velocity_plan(mechanism, moved, 0, first, machine.style, among=among)
        return acceleration_plan(mechanism, moved, 0, first, second, machine.style, among=among)

    return picture


def _state(machine: Drawn) -> tuple[SampledMotion, float, float]:
    """Return a linkage at the angle that is worked, and the rates of its driver there."""
    reached = machine.reached
    moved = sample_motion(machine.results.machine.mechanism, reached.degrees[[reached.row]])
    first, second = (float(rate[reached.row]) for rate in driver_rates(machine.results, reached.columns))
    return moved, first, second


def _crankpins(machine: Drawn) -> Iterable[Diagram]:
    """Yield the polar diagram of every unlike crankpin; the first has no number in its name."""
    if not machine.has_piston:
        for number, pin in enumerate(machine.bearings.pins, start=1):
            name = f"crankpin_polar_{number}" if number > 1 else "crankpin_polar"
            yield Diagram(name, partial(crankpin_polar, pin=pin), _drawn, "crank_up", owner=plain(pin))
        return
    pins = machine.bearings.pins if _engine(machine) else ()
    for index, pin in enumerate(pins):
        name = f"crankpin_polar_{pin}" if index else "crankpin_polar"
        # of several crankpins the first has a number too
        own = pin if len(pins) > 1 else ""
        yield Diagram(name, partial(crankpin_polar, pin=pin), _engine, "crank_up", is_of_forces=True, number=own)
    if not pins:
        yield Diagram("crankpin_polar", crankpin_polar_of_one, _engine, "crank_up", is_of_forces=True)


def _forces(name: str, **styles: Dashes) -> Diagram:
    """Return the figure of forces of one cylinder over the cycle."""
    return Diagram(name, partial(forces_over_cycle, styles=styles), piston(*styles), is_of_forces=True)


def _listed(listing: str) -> Needs:
    """Return the condition that the loads of an engine, or a listing of joints, are known."""
    return lambda machine: _engine(machine) or (_drawn(machine) and listing in machine.results.listings)


def _has_joint_forces(machine: Drawn) -> bool:
    return _drawn(machine) and bool(_joint_forces(machine))


def _speed(machine: Drawn) -> bool:
    """Return whether the speed over a cycle is known of a linkage, or of a shaft whose torques are."""
    if machine.results.machine.turning is not None:
        return has_turning_moment(machine) and "crank_speed" in machine.results.columns
    return _drawn(machine) and has_speed(machine)


def _loops(machine: Drawn) -> bool:
    shaft = machine.results.machine.turning is not None
    return shaft and not has_turning_moment(machine) and "energy_extremes" in machine.results.listings


def _heat_release(machine: Drawn) -> Drawing:
    """Return rates of heat release, heat and fraction burnt over the closed period."""
    gas = machine.results.machine.gas
    if gas is None or gas.combustion is None:
        raise TypeError("no combustion was analysed")
    data = gas.combustion
    keys = ("net_heat_rate", "gross_heat_rate"), ("net_heat", "gross_heat"), ("burnt_fraction",)
    # without losses both are one
    panels = [group[-1:] if "wall_heat_rate" not in machine.results.columns else group for group in keys]
    degrees = np.arange(data.start, data.end + 0.25, 0.5)
    columns = machine.results.columns_at(degrees, tuple(itertools.chain(*panels)))
    return curves(degrees, columns, panels, figure_title("combustion", machine.language), machine.style)


def _compared(machine: Drawn) -> Drawing:
    results = machine.results
    if results.compared is None:
        raise TypeError("these results stand beside no others")
    return comparison_figure(results, results.compared, machine.language, per_area=machine.per_area)


def _own(machine: Drawn, name: str, keys: Sequence[str]) -> Drawing:
    """Return a figure that a file asks for: columns of one unit in one panel."""
    reached = machine.reached
    degrees, columns = (machine.degrees, machine.columns) if machine.has_piston else (reached.degrees, reached.columns)
    for count, key in enumerate(keys, start=1):
        if key not in columns:
            message = ErrorMessage("no_column", value=key, known=", ".join(columns))
            raise InputError([Problem(f"document.figures.{name}[{count}]", message)], [""])
    panels = itertools.groupby(keys, key=lambda key: quantity_of(key).unit)
    parts = [part for _, group in panels for part in _by_fours(list(group))]
    return curves(degrees, columns, parts, figure_title(name, machine.language), machine.style)


def _drawn_of(draw: Callable[[Drawn, str], tuple[Canvas, Mapping[str, Graph]]], owner: str) -> Draw:
    return lambda machine: draw(machine, owner)


def _by_owner(
    name: str, draw: Callable[[Drawn, str], tuple[Canvas, Mapping[str, Graph]]], part: str, key: str
) -> Several:
    """Return a figure of each sliding piece or vessel that a part of the machine names, which has a column."""

    def figures_(machine: Drawn) -> Iterable[Diagram]:
        owners = [
            owner for owner in getattr(machine.results.machine, part) if f"{key}.{owner}" in machine.reached.columns
        ]
        for count, owner in enumerate(owners, start=1):
            own = f"{name}_{count}" if count > 1 else name
            yield Diagram(own, _drawn_of(draw, owner), _drawn, owner=plain(owner))

    return Several(figures_, _drawn)


_GAS = _of_kinds("cylinder_volume", "gas_pressure", "gas_force", "rod_load")
# every figure, in the order in which they are told
DIAGRAMS: tuple[Entry, ...] = (
    Curves("driver", lambda machine: [(key,) for key in machine.reached.columns if key.startswith("driver_")]
           if machine.style.period else [], "tables.driver", _drawn),
    Construction("position_plans", _positions, _drawn),
    Construction("velocity_plan", _plan(1), _drawn),
    Construction("acceleration_plan", _plan(2), _drawn),
    _each("sliders", "slider_displacement", "slider_velocity", "slider_acceleration"),
    _each("links", "link_angle", "link_angular_velocity", "link_angular_acceleration", owners=1),
    Several(_paths, _drawn),
    _each("points", "point_velocity", "point_acceleration", owners=1),
    Construction("centrodes", centrodes, every(_turning, has_centrodes)),
    Construction("indicator", chamber_indicator, lambda machine: _drawn(machine) and bool(_GAS(machine))),
    Curves("chambers", _GAS, when=_drawn),
    Construction("stage_indicator", stage_indicator, lambda machine: bool(stage_diagrams(machine.results))),
    _by_owner("rod_loads", rod_loads, "crossheads", "crosshead_load"),
    _by_owner("pump_flow", pump_flow, "vessels", "vessel_flow"),
    Construction("process_force", force_law, lambda machine: bool(force_laws(machine.results))),
    Curves("reduced_inertia", _inertia, "quantities.reduced_inertia"),
    Curves("torques", _torques, "quantities.driving_torque", remark=_gives_work),
    Curves("friction", _friction, "tables.friction"),
    Curves("joint_forces", _joint_forces, "tables.joint_forces"),
    Construction("force_plans", plans_of_forces, every(_has_joint_forces, has_force_plans)),
    Construction("zhukovsky_lever", lever_figure, every(_has_joint_forces, _turning, has_lever)),
    Construction("turning_moment", turning_moment, has_turning_moment),
    Construction("loops", loops, _loops),
    Diagram("kinematics", kinematics, piston("piston_displacement"),
            lambda machine: "orders" if "piston_velocity_first_order" in machine.columns else ""),
    Diagram("brix", brix, piston("piston_displacement")),
    Diagram("tolle", tolle, piston("piston_displacement")),
    Diagram("pressure", pressure, piston("gas_pressure")),
    Diagram("indicator", indicator, piston("gas_pressure")),
    Diagram("log_indicator", log_indicator, has("net_heat")),
    Construction("combustion", _heat_release, has("net_heat")),
    Diagram("recorded_cycles", recorded_cycles, has("recorded_cycles")),
    Diagram("willans", willans, has("willans")),
    Diagram("piston_forces", piston_forces, piston("piston_force"), is_of_forces=True),
    _forces("rod_forces", rod_force=SOLID, side_force=DASHED),
    _forces("crankpin_forces", tangential_force=SOLID, radial_force=DASHED, side_force=DASH_DOT),
    Diagram("torque", torque, piston("crank_torque")),
    Several(_crankpins, lambda machine: piston("tangential_force")(machine) or _drawn(machine)),
    Diagram("crankpin_load", crankpin_load, _listed("crankpin_wear"), is_of_forces=True),
    Diagram("big_end_polar", big_end_polar, _engine, "rod_up", is_of_forces=True),
    Diagram("small_end_polar", small_end_polar, _engine, "rod_up", is_of_forces=True),
    Diagram("main_journal_polar", main_journal_polar, _listed("main_wear"), lambda machine: machine.shaft_frame,
            is_of_forces=True),
    Diagram("crankpin_wear", crankpin_wear, _listed("crankpin_wear"), is_of_forces=True),
    Diagram("main_wear", main_wear, _listed("main_wear"), is_of_forces=True),
    Diagram("total_tangential_force", total_tangential_force, _many, is_of_forces=True),
    Diagram("total_torque", total_torque, _many),
    Diagram("cylinder_torques", cylinder_torques, _many),
    Diagram("accumulated_torque", accumulated_torque, every(_engine, lambda machine: machine.diagrams.has_throws)),
    Diagram("excess_work", excess_work, _engine),
    Diagram("crank_speed", crank_speed, every(_engine, lambda machine: machine.diagrams.torque.speed is not None)),
    Diagram("torque_harmonics", torque_harmonics, _listed("torque_harmonics")),
    Diagram("phase_stars", phase_stars, _many),
    Diagram("balance_orders", balance_orders, every(_engine, lambda machine: "inertia_force" in machine.columns)),
    Diagram("balance_ellipses", balance_ellipses, every(_engine, lambda machine: bool(curved_loci(machine)))),
    Diagram("balance_polygons", balance_polygons, has_polygons),
    Curves("unbalanced", _unbalanced, "subjects.balance"),
    Construction("torsional_modes", natural_modes, has("natural_modes")),
    Construction("campbell", campbell, has("critical_speeds")),
    Construction("torsional_response", torsional_response, has("torsional_response")),
    Construction("transient", _transient, every(_drawn, has("transient"))),
    Construction("speed", speed_curve, _speed),
    Construction("wittenbauer", wittenbauer, lambda machine: (_drawn(machine) or _engine(machine))
                 and has_energy_mass_diagram(machine)),
    Construction("comparison", _compared, lambda machine: machine.results.compared is not None
                 and bool(drawn_keys(machine.results.compared))),
)  # fmt: skip


def diagrams(machine: Drawn) -> dict[str, Diagram | Construction | Curves]:
    """Return the figures that there are of a machine, by name."""
    entries = (entry for entry in DIAGRAMS if entry.needs(machine))
    each = (entry.each(machine) if isinstance(entry, Several) else (entry,) for entry in entries)
    stated = machine.results.machine.document.figures.items()
    own = (Construction(name, partial(_own, name=name, keys=keys), has()) for name, keys in stated)
    return {entry.name: entry for entry in itertools.chain(*each, own)}


def figures(
    results: Results, *, language: Language = "en", per_area: bool = False, theme: Theme = "print"
) -> dict[str, bytes]:
    """Return the figures of a machine as SVG by name; those for which nothing is known are left out.

    `theme`: `print`, `colour` or `dark`.

    Raises
    ------
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    return {
        name: svg(drawing, theme) for name, drawing in drawings(results, language=language, per_area=per_area).items()
    }


@for_readers
def drawings(
    results: Results, *, language: Language = "en", per_area: bool = False, only: Collection[str] | None = None
) -> dict[str, Drawing]:
    """Return the figures of a machine as drawings; `only`: the names of those that are wanted."""
    machine = drawn_of(results, language, per_area=per_area)
    with use_numbers(link_numbers(results)):
        chosen = ((name, figure) for name, figure in diagrams(machine).items() if only is None or name in only)
        return {name: figure.picture(machine) for name, figure in chosen}


@for_readers
def drawings_at(
    results: Results, degrees: Array, language: Language, only: Collection[str]
) -> dict[str, list[Drawing | None]]:
    """Return figures of one position by name, each at some crank angles; None where there is none. [deg]"""
    machine = drawn_of(results, language)
    with use_numbers(link_numbers(results)):
        known = {name: figure for name, figure in diagrams(machine).items() if name in only}
        mechanism, links = results.machine.mechanism, machine.style.links
        states = list(map(_state, machine.at(degrees)))
        plans = (
            [size_of(velocities(mechanism, moved, 0, first, links)) for moved, first, _ in states],
            [size_of(accelerations(mechanism, moved, 0, first, second, links)) for moved, first, second in states],
        )
        each = list(replace(machine, plans=plans).at(degrees))
        return {
            name: [figure.picture(moved) if figure.needs(moved) else None for moved in each]
            for name, figure in known.items()
        }


@for_readers
def figure_names(results: Results, language: Language = "en") -> list[str]:
    """Return the names of the figures of a machine, of which none is drawn."""
    return list(diagrams(drawn_of(results, language)))


def curves(
    degrees: Array,
    columns: Mapping[str, Array],
    panels: Sequence[str | Sequence[str]],
    title: str,
    style: Style = PLAIN,
    remark: str = "",
) -> Drawing:
    """Return quantities over the crank angle, one panel below the other.

    `columns`: values in SI by key, `joint_force.A` for what belongs to a point or link; `panels`: keys of each panel;
    those of one panel share a unit; `remark`: what stands beneath.
    """
    all_panels = [_panel((panel,) if isinstance(panel, str) else tuple(panel), columns) for panel in panels]
    if not all_panels:
        raise CrankworkError("curves need at least one key")
    # quantities that are zero throughout are named in a remark
    sets = [panel for panel in all_panels if any(np.any(columns[row.key]) for row in panel)] or all_panels
    shown = [[displayed_values(row, columns[row.key]) for row in panel] for panel in sets]
    room = (_TALLEST - BOTTOM) / len(sets) - _GAP
    high = scaled_height(_ALONE if len(sets) == 1 else min(_PANEL, room))
    paper = Canvas(current_layout().width, TOP + len(sets) * (high + _GAP) - _GAP + BOTTOM)
    abscissas = degrees * style.period / 360.0 if style.period else degrees
    top = TOP
    for quantities, values in zip(sets, shown, strict=True):
        box = ChartBox(current_layout().left, top, current_layout().inner, high)
        name_at_the_end(paper, _rows(quantities, values, style), box)
        kind = key_of(quantities[0].key).quantity
        # panels of one quantity have one scale
        of_kind = [shown[k] for k, panel in enumerate(sets) if key_of(panel[0].key).quantity == kind]
        ends = limits(*itertools.chain(*of_kind), is_place=kind in _PLACES)
        graph = drive_graph(paper, box, abscissas, ends, style, is_last=quantities is sets[-1])
        _draw(graph, abscissas, quantities, values)
        graph.y_title(_title(quantities, style))
        top += graph.box.height + _GAP
    dead = "; ".join(f"{number(round(limit, 2), style.language)}°" for limit in style.limits)
    owners = dict.fromkeys(key_of(row.key).owner.partition(".")[0] for panel in all_panels for row in panel)
    # links in their order, then chambers and vessels, which have Roman numbers
    names = [*(name for name in style.links if name in owners), *(name for name in owners if name not in style.links)]
    known = {number_of(name): name for name in names if number_of(name) != name and "_" not in number_of(name)}
    zero = [math_symbol(row.symbol(style.language)) for panel in all_panels if panel not in sets for row in panel]
    unnamed = [panel[0] for panel in sets if len(panel) == 1 and not _is_on_axis(panel, style)]
    remarks = [
        translate("drawing.dead_positions", style.language, angles=dead) if dead and not style.period else "",
        f"{' = '.join(zero)} = 0" if zero else "",
        *(
            f"{math_symbol(quantity.symbol(style.language))} – {plain(quantity.label(style.language))}"
            for quantity in unnamed
        ),
        remark,
        *key_of_links(known, known, style.language),
    ]
    write_remark(paper, "; ".join(text for text in remarks if text))
    return paper.drawing(title, style.language)


def _panel(keys: tuple[str, ...], columns: Mapping[str, Array]) -> list[Quantity]:
    """Return the quantities of a panel."""
    missing = [key for key in keys if key not in columns]
    if missing:
        raise CrankworkError(f"there is no column {missing[0]}; there is {', '.join(columns)}")
    quantities = [quantity_of(key) for key in keys]
    units = {row.unit for row in quantities}
    if len(units) > 1:
        raise CrankworkError(f"{', '.join(keys)} have different units; give each a panel of its own")
    return quantities


def _draw(graph: Graph, abscissas: Array, quantities: Sequence[Quantity], values: Sequence[Array]) -> None:
    """Draw the curves of a panel, and the extremes of one that is alone."""
    for order, together in enumerate(_together(values)):
        first, *further = together
        for other in further:
            graph.curves[quantities[other].key] = abscissas, values[other]
        graph.curve(quantities[first].key, abscissas, values[first], STYLES[order % 4])
    known = np.where(np.isfinite(values[0]), values[0], 0.0)
    if len(values) > 1 or np.ptp(known) <= _SAME * np.max(np.abs(known)):
        return
    for name, where in (("max", int(np.argmax(known))), ("min", int(np.argmin(known)))):
        # a value that is very small against the largest is rounding
        value = float(known[where]) if abs(known[where]) > _ROUNDING * np.max(np.abs(known)) else 0.0
        mark_point(graph, name, float(abscissas[where]), value, graph.tick_text(value))


def _together(values: Sequence[Array]) -> list[list[int]]:
    """Return the groups of curves of a panel that coincide, so that each is drawn once."""
    size = max((float(np.ptp(row[np.isfinite(row)])) for row in values if np.isfinite(row).any()), default=0.0)
    # constants differ by rounding
    size += _ROUNDING * max((float(np.max(np.abs(row[np.isfinite(row)]), initial=0.0)) for row in values), default=0.0)
    groups: list[list[int]] = []
    for index, column in enumerate(values):
        for group in groups:
            if np.allclose(values[group[0]], column, rtol=0.0, atol=_SAME * size, equal_nan=True):
                group.append(index)
                break
        else:
            groups.append([index])
    return groups


def _is_on_axis(quantities: Sequence[Quantity], style: Style) -> bool:
    """Return whether the title of the axis says what the curves are: all of one kind, whose name is not too long."""
    kinds = {key_of(row.key).quantity for row in quantities}
    return len(kinds) == 1 and len(quantities[0].label(style.language)) <= _LONG


def _rows(quantities: Sequence[Quantity], values: Sequence[Array], style: Style) -> list[Row]:
    """Return the names of the curves of a panel: symbols, and what the title of its axis does not say."""
    rows, is_on_axis = [], _is_on_axis(quantities, style)
    if len(quantities) == 1:
        return []
    for order, together in enumerate(_together(values)):
        signs = dict.fromkeys(math_symbol(quantities[index].symbol(style.language)) for index in together)
        names = "; ".join(plain(quantities[index].label(style.language)) for index in together)
        meant = "" if is_on_axis else f" – {names}"
        rows.append(Row(f"{', '.join(signs)}{meant}", STYLES[order % 4]))
    return rows


def _title(quantities: Sequence[Quantity], style: Style) -> str:
    """Return the title of the vertical axis: the name of what all curves are, or the symbols of several."""
    if _is_on_axis(quantities, style):
        alone = quantities[0] if len(quantities) == 1 else QUANTITIES[key_of(quantities[0].key).quantity]
        return axis_title(alone, style.language)
    unit = unit_name(quantities[0].unit, style.language)
    names = ", ".join(dict.fromkeys(math_symbol(row.symbol(style.language)) for row in quantities))
    return f"{names}, {unit}" if unit else names


@in_own_units
def comparison_figure(results: Results, compared: Comparison, language: Language, *, per_area: bool = False) -> Drawing:
    """Return the figure of a comparison: quantities by each name, and below each its differences."""
    keys = drawn_keys(compared)
    # two machines have pistons of their own
    per_area = per_area and compared.is_of_methods
    cycle = results.machine.cycle
    degrees = np.linspace(0.0, cycle, min(round(cycle / _STEP), _MOST) + 1)
    area = results.summary["piston_area"] if per_area else None
    columns = compared.columns_at(degrees)
    other_names, named = compared.names[1:], shown_names(compared, language)
    looks = zip(named, _looks(compared.names), strict=True)
    rows = [Row(shown, style, colour=colour) for shown, (_, style, colour) in looks]
    if len(other_names) == 1:
        rows.append(Row(f"Δ: {translate('report.less', language, name=named[1], other=named[0])}", width=0.0))
    else:
        rows.append(Row(f"Δ: {translate('report.less_own', language, other=named[0])}", width=0.0))
    room = (_TALLEST_NOTE - LEGEND_ROW * len(rows)) / len(keys) - 1.5 * _BETWEEN
    upper, lower = (min(most, share * room) for most, share in ((_UPPER, 0.63), (_LOWER, 0.37)))
    paper, box = sheet(len(keys) * (upper + lower + 1.5 * _BETWEEN) - _BETWEEN, rows)
    abscissas = degrees * results.period / 360.0 if results.period else degrees
    top = box.top
    for key in keys:
        scale, unit = displayed(key, 1.0, per_area=area), unit_name(key_unit(key, per_area=per_area), language)
        sign = QUANTITIES[key_of(key).quantity]._replace(key=key).symbol(language)
        for names, place, tall, mark in (
            ([(comparison_key(key, name), name) for name in compared.names], top, upper, f"${sign}$"),
            (
                [(difference_key(key, name), name) for name in other_names],
                top + upper + _BETWEEN / 2,
                lower,
                f"$Δ{sign}$",
            ),
        ):
            is_last = key == keys[-1] and place > top
            curves = {name: columns[column] * scale for column, name in names}
            graph = _graph(
                paper, ChartBox(box.left, place, box.width, tall), abscissas, curves, results, language, numbers=is_last
            )
            for name, style, colour in _looks(compared.names):
                if name in curves:
                    graph.curve(name, abscissas, curves[name], style, colour=colour)
            graph.y_title(f"{mark}, {unit}" if unit else mark)
            if is_last:
                graph.x_title(_x_title(results, language))
        top += upper + lower + 1.5 * _BETWEEN
    return paper.drawing(translate("figures.comparison", language), language)


def drawn_keys(compared: Comparison) -> list[str]:
    """Return the columns that a figure shows; of several links or sliders the last, which others move."""
    selected = []
    for kinds in _DRAWN:
        own = {key: compared.columns[comparison_key(key, compared.names[0])] for key in compared.keys}
        keys = {key_of(key).quantity: key for key, values in own.items() if np.any(values)}
        selected += [keys[kind] for kind in kinds if kind in keys][:1]
    return selected


def _looks(names: tuple[str, ...]) -> list[tuple[str, Dashes, str]]:
    return [
        (name, STYLES[min(index, len(STYLES) - 1)], _COLOURS[index % len(_COLOURS)]) for index, name in enumerate(names)
    ]


def _x_title(results: Results, language: Language) -> str:
    key = "time" if results.period else "crank_angle"
    return f"{QUANTITIES[key].label(language)} ${symbol(key, language)}$, {unit_name(key_unit(key), language)}"


def _graph(  # noqa: PLR0913 - place, curves and how they are told
    paper: Canvas,
    box: ChartBox,
    abscissas: Array,
    curves: Mapping[str, Array],
    results: Results,
    language: Language,
    *,
    numbers: bool,
) -> Graph:
    """Return a graph that holds all numbers of some curves, with its frame drawn."""
    y = limits(*curves.values())
    if results.period or results.machine.cycle > _LONG_CYCLE:
        over = "time" if results.period else "crank_angle"
        graph = Graph(paper, box, (0.0, float(abscissas[-1])), y, language, over)
        graph.frame(round_ticks(0.0, float(abscissas[-1])), round_ticks(*y, 4), labels=(numbers, True))
        return graph
    return over_cycle(paper, box, y, float(abscissas[-1]), language, numbers=numbers)
