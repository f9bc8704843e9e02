"""What results assume that nobody stated, what they leave out, and the inputs that no result depends on."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.dynamics.friction import Friction, PinFriction
from crankwork.formula.traced_value import Input, in_order
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import ProcessForce, Weight
from crankwork.machine import FileInput, InputNumber
from crankwork.shaft.torque_diagram import common_period
from crankwork.working_cycle.fuels import FUELS
from crankwork.working_cycle.schools import PEAK_LEVEL

# keys of a file about its texts, tables and drawings, which change no result
_DISPLAY = re.compile(r"(title|document|format|units|decimal_mark|table)\b.*|.*\bsource|torsion\.(modes|trials.*)")
# they choose a circuit, which nearby positions choose as well, or permit what may not be there
_CHOOSING = re.compile(r"(positions|branch)\..*")
# numbers that are in the trace if a result depends on them
_TRACED = re.compile(
    r"(crank|rod|piston|links|sliders|geared|driver)\b.*\.(\w*mass|inertia|radius_of_gyration|centre_of_mass|small_end_share)"
    r"|(cylinder|chambers\..*)\.(inclination|compression_ratio|clearance_volume|piston_rod_diameter|rod_diameter|bore|displacement|stroke_bore_ratio)"
    r"|method\.gravity|(gas|chambers\.[^.]+)\.(ambient|back_pressure)|bearings\..*_(diameter|length)"
    r"|engine\.articulated\.\w+|cycle\.\w+"
)
_FIRING = re.compile(r"engine\.firing_order|shaft\.firing")
# names of sliding pieces and links
_OF_BODIES = re.compile(r".*\.(slider|links?|cylinders)(\[\d+\])?")
_ABOUT = r"(crank|geared\..+)\.inertia_about"
_FACE = re.compile(r"\.faces\[1\]")
_SAMPLES, _ROUNDING, _EVEN = 721, 1e-9, 1e-6
_ROUNDED = r".*cycle\.(rise|rise_share|peak_level|blow_down)"
# a rise of pressure that is less by a hundredth has the same effect
_LOWERED = 0.99
_SPARK = ("petrol", "otto", "assigned-petrol")
_CORNERS = ("petrol", "diesel", "otto", "ideal-diesel", "dual", "assigned-petrol", "assigned-diesel")


class Assumption(NamedTuple):
    """Something that results assume: the default of a key, a value taken as usual, an effect left out, a convention.

    `code` names its sentence; `keys` of the machine file state it otherwise; `value` as a file would state it or in SI
    with its `quantity`; `meaning` is the key of the text about the field; `names` are the parts that it concerns.
    """

    code: str
    keys: tuple[str, ...] = ()
    value: Any = None
    meaning: str = ""
    quantity: str = ""
    names: tuple[str, ...] = ()


class IdleInput(NamedTuple):
    """An input that no result depends on, and the code of the reason with its values."""

    key: str
    reason: str
    values: Mapping[str, float] = MappingProxyType({})


def assumptions(results: Results) -> tuple[Assumption, ...]:
    """Return what results assume, what matters most first; of the defaults those that a result depends on."""
    inputs = results.machine.inputs
    if inputs is None:
        return ()
    file = inputs()
    listed = [
        *_left_out(results, file.stated),
        *_conventions(results),
        *_taken(results, {**file.stated, **file.defaults}),
    ]
    defaults: dict[tuple[str, str], list[str]] = {}
    for path, default in file.defaults.items():
        if path not in _WITH_SENTENCES and _default_matters(path, results, file.stated):
            defaults.setdefault((default.meaning, str(default.value)), []).append(path)
    listed += [
        Assumption("default", tuple(paths), file.defaults[paths[0]].value, meaning)
        for (meaning, _), paths in defaults.items()
    ]
    # what a law does at its ends decides about all forces
    return tuple(sorted(listed, key=lambda item: not any(key.endswith(".ends") for key in item.keys)))


# defaults that have sentences of their own
_WITH_SENTENCES = ("method.weights",)


def _left_out(results: Results, stated: Mapping[str, FileInput]) -> Iterator[Assumption]:
    """Yield effects that are not included."""
    machine = results.machine
    has_forces = any(key.startswith(("joint_force", "piston_force")) for key in results.columns)
    if _has_mass(results) and not _has_weights(results) and machine.method.gravity:
        yield Assumption("no_weights", ("method.weights",))
    if has_forces and not machine.friction and machine.drive.efficiency == 1.0:
        yield Assumption("no_friction", ("friction", "efficiency"))
    if _needs_motor(results) and machine.drive.efficiency == 1.0:
        yield Assumption("no_drive_losses", ("efficiency",))
    masses = machine.masses
    if masses is not None and masses.rod_small_end and not masses.rod_inertia_excess and machine.method.rod == "rigid":
        yield Assumption("two_masses", ("rod.inertia",))
    piped = tuple(name for name, vessel in machine.vessels.items() if vessel.pipe is not None)
    if piped:
        yield Assumption("vessel_pipes", tuple(f"vessels.{name}.length" for name in piped), names=piped)
    names = results.summary.keys() & {"swept_flow.1", "swept_volume.1", "clearance_volumetric_efficiency.1"}
    if names == {"swept_flow.1", "swept_volume.1"}:
        yield Assumption("no_clearance", ("stages.clearance", "stages.volumetric_efficiency"))
    yield from _without_mass(results, stated)


def _without_mass(results: Results, stated: Mapping[str, FileInput]) -> Iterator[Assumption]:
    """Yield the moving parts whose mass is not stated beside others whose mass is."""
    machine = results.machine
    if machine.linkage is not None:
        parts = {f"links.{member.name}" if not member.guide else f"sliders.{member.name}": member.mass
                 for member in machine.linkage.members}  # fmt: skip
    elif machine.masses is not None:
        rod = machine.masses.rod_small_end + machine.masses.rod_big_end
        parts = {"piston": machine.masses.piston, "rod": rod}
    else:
        return
    # sides of a drive that are no parts of the file have no mass either
    light = [name for name, mass in parts.items() if not mass and any(path.startswith(f"{name}.") for path in stated)]
    if light and _has_mass(results):
        yield Assumption("massless", tuple(f"{name}.mass" for name in light), names=tuple(light))


def _has_mass(results: Results) -> bool:
    machine, linkage = results.machine, results.machine.linkage
    members = (*linkage.members, *linkage.geared, linkage.driving) if linkage is not None else ()
    return any(member.mass for member in members) or (machine.masses is not None and any(vars(machine.masses).values()))


def _needs_motor(results: Results, *_: object) -> bool:
    return any(key.startswith("motor_ratio.") for key in results.summary)


def _has_weights(results: Results) -> bool:
    return results.machine.has_gravity or any(isinstance(load, Weight) for load in results.machine.loads)


def _conventions(results: Results) -> Iterator[Assumption]:
    """Yield conventions of angles, of tolerances, and of the length of a link with more than two joints."""
    machine = results.machine
    for member in machine.linkage.members if machine.linkage is not None else ():
        joints = [name for name in member.points if name != f"{member.name}.centre"]
        of_length = {"mass": member.length_mass, "centre": member.centre_share, "inertia": member.length_inertia}
        stated = tuple(f"links.{member.name}.{key}" for key, value in of_length.items() if value)
        if stated and len(joints) > 2:
            yield Assumption("first_joints", stated, names=("".join(joints[:2]),))
    if machine.lengths is not None and machine.gas is not None:
        yield Assumption("angle_of_cycle" if machine.cycle > 360.0 else "angle_of_turn", ())
    if machine.tolerances:
        yield Assumption("deviation", tuple(machine.tolerances))


def _taken(results: Results, stated: Mapping[str, FileInput]) -> Iterator[Assumption]:
    """Yield inputs of the calculation that a cycle takes as usual for the kind of engine, and orders of cylinders."""
    engine = results.machine.engine
    if engine is not None and len(engine.layout.places) > 1 and not any(map(_FIRING.match, stated)):
        order = "-".join(str(number) for number in engine.layout.firing_order)
        yield Assumption("firing_order", ("engine.firing_order",), order)
    kind = getattr(getattr(getattr(results.machine.gas, "calculated", None), "cycle", None), "kind", "")
    if kind not in FUELS:
        return
    fuel = next((path for path in stated if re.fullmatch(r"(.*\.)?cycle\.fuel\b.*", path)), "")
    if not fuel:
        yield Assumption(f"fuel_{kind}", ("cycle.fuel",))
    for path, (node, quantity) in leaves(results).items():
        table = path.partition("[")[0]
        if re.fullmatch(r"(chambers\.[^.]+\.)?cycle\.\w+(\[\d\])?", path) and not any(
            name.startswith(table) for name in stated
        ):
            yield Assumption("taken", (path,), node.value, quantity=quantity)


def leaves(results: Results) -> dict[str, tuple[Input, str]]:
    """Return the inputs that results depend on, by path, with the key of their quantity."""
    inputs: dict[str, tuple[Input, str]] = {}
    for known in in_order(results.trace.values()):
        if isinstance(known.node, Input) and known.node.path:
            inputs.setdefault(_FACE.sub("", known.node.path), (known.node, known.key))
    return inputs


_Rule = Callable[["Results", Mapping[str, FileInput], str], bool]
# defaults that matter on a condition only; the others always do
_CONDITIONS: tuple[tuple[str, _Rule], ...] = (
    # the summary says the method, and pi is a constant of mathematics
    (r"method\.(pi|kinematics)", lambda *_: False),
    (r".*\.measured\.shift", lambda results, *_: all(item.code != "measured_zero" for item in results.notices)),
    (r"method\.gravity", lambda results, *_: "method.gravity" in leaves(results) and _has_mass(results)),
    (r"loads\[\d+\]\.acts", lambda *found: not _idle_return(*found)),
    (r"method\.weights", lambda results, *_: _has_mass(results)),
    (r"rod\.ratio_definition", lambda _, stated, __: "rod.ratio" in stated),
    (r"engine\.strokes", lambda results, *_: results.machine.gas is None and not results.machine.chambers),
    (r"engine\.uneven|rotor\.(arrangement|reciprocating_share)", lambda *_: False),
    (r"(cycle|chambers\..*\.cycle)\.stroke_bore_ratio", lambda _, stated, __: "cycle.power" in stated),
    (r"(cycle|chambers\..*\.cycle)\.motored", lambda results, *_: _has_misfire(results)),
    (r"links\..+\.inertia", lambda results, stated, path: not _idle_inertia(results, stated, path)),
    (r"sliders\..*\.inertia", lambda results, _, path: _turns(results, _part(path))),
    (_ABOUT, lambda results, stated, path: not _idle_about(results, stated, path)),
    (r"loads\[\d+\]\.stroke", lambda *_: True),
    (r"loads\[\d+\]\.(curve|against)", lambda _, stated, path: f"{path.rpartition('.')[0]}.at[3]" in stated),
    (r"transient\.until", lambda *_: False),
    (r"transfer\.bodies\..*\.(mass|inertia)", lambda *known: not _idle_body(*known)),
    (r".*\.timing\.peak", lambda results, stated, path: not _idle_event(path, stated, results)),
    (r".*cycle\.school", lambda results, stated, path: not _idle_event(f"{path[:-7]}.timing.peak", stated, results)),
    (r"motor_selection\.\w+", _needs_motor),
    (r"stages\.(water_heat_capacity|sides)", lambda results, _, path: path in leaves(results)),
    (_ROUNDED, lambda results, stated, path: not _idle_convention(path, stated, results)),
    (r"motor\.\w+", lambda results, stated, path: not _idle(path, stated, results, ())),
    (r"torsion\.modulus", lambda results, *_: "torsion.modulus" in leaves(results)),
    (r"torsion\.(orders|.*\.(damping|loss_factor))", lambda *known: not _idle_torsion(*known)),
    (r"friction\.circle|balance\.rotating_share|.*\.strokes\[\d+\]\.(shape|peak)",
     lambda results, stated, path: not _idle(path, stated, results, ())),
)  # fmt: skip


def _default_matters(path: str, results: Results, stated: Mapping[str, FileInput]) -> bool:
    if _DISPLAY.fullmatch(path):
        return False
    return next((rule(results, stated, path) for pattern, rule in _CONDITIONS if re.fullmatch(pattern, path)), True)


def _has_misfire(results: Results) -> bool:
    engine = results.machine.engine
    return engine is not None and bool(engine.misfires)


def _part(path: str) -> str:
    """Return the name of a part of the machine, which may have dots, from the path of one of its keys."""
    return path.partition(".")[2].rpartition(".")[0]


def _turns(results: Results, slider: str) -> bool:
    """Return whether a sliding piece turns with the link that carries its guide."""
    linkage = results.machine.linkage
    guide_of = {member.name: member.guide for member in linkage.members if member.guide} if linkage is not None else {}
    if linkage is None or slider not in guide_of:
        # one that drives slides on a fixed guide
        return False
    carrier = linkage.guides[guide_of[slider]].link
    return _turns(results, carrier) if carrier in guide_of else bool(carrier)


def idle_inputs(results: Results) -> tuple[IdleInput, ...]:
    """Return the stated inputs that no result depends on."""
    inputs = results.machine.inputs
    if inputs is None:
        return ()
    stated = {path: item for path, item in inputs().stated.items() if not _DISPLAY.fullmatch(path)}
    idle = {item.key: item for item in _unreached_forces(results, stated)}
    in_trace = set(leaves(results))
    if results.machine.linkage is not None and _is_engine(stated):
        # the trace of an engine with friction or loads names the parts of the linkage that it is
        # few machines are calculated as another form
        from crankwork.preparation.cell_gas import linkage_paths  # noqa: PLC0415 - loaded where it is needed

        parts, ends = {key: _FACE.sub("", part) for key, part in linkage_paths(results.machine).items()}, (".", "[")
        in_trace |= {key for key in stated if key not in parts and not key.startswith("method.")}
        in_trace |= {key for key, part in parts.items() for path in in_trace
                     if path == part or (path.startswith(part) and path[len(part)] in ends)}  # fmt: skip
    for path in stated:
        if path not in idle and not _CHOOSING.fullmatch(path) and (code := _idle(path, stated, results, in_trace)):
            idle[path] = IdleInput(path, code)
    return tuple(idle[path] for path in stated if path in idle)


def _idle(path: str, stated: Mapping[str, FileInput], results: Results, in_trace: Container[str]) -> str:
    """Return the code of the reason why nothing depends on an input; empty if something does."""
    rule = next((rule for pattern, rule in _REASONS if re.fullmatch(pattern, path)), None)
    if rule is not None:
        return rule(results, stated, path)
    number = results.machine.stated.get(path)
    if (
        number is None
        or not (number.value or path == "method.gravity")
        or _FACE.sub("", path) in in_trace
        or not _TRACED.fullmatch(path)
    ):
        return ""
    if path == "method.gravity" and any(notice.code == "weight" for notice in results.notices):
        # makes masses of weights
        return ""
    return "weights_off" if path == "method.gravity" and not _has_weights(results) else "unused"


def _idle_torsion(results: Results, _: object, path: str) -> str:
    """Orders make critical speeds, and undamped modes have no damping."""
    listing = "critical_speeds" if path == "torsion.orders" else "damped_modes"
    vibrates = any(key.startswith("vibration_amplitude") for key in results.summary)
    return "" if vibrates or listing in results.listings else "unused"


def _idle_body(_: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """The mass of a body moves by a velocity, its inertia by a rotation."""
    table, name = path.rsplit(".", 1)
    return "" if f"{table}.{'velocity' if name == 'mass' else 'rotation'}[1]" in stated else "unused"


def _idle_losses(results: Results, *_: object) -> str:
    """They count with friction, and with a flywheel where a torque varies."""
    machine, torque = results.machine, results.trace.get("static_torque")
    has_wheel = machine.drive.fluctuation is not None or machine.drive.wheel is not None
    return "" if machine.friction or (has_wheel and torque is not None and torque.varies) else "unused"


def _idle_wheel(results: Results, *_: object) -> str:
    wheels = [value for key, value in results.summary.items() if key.startswith("flywheel_inertia")]
    return "" if any(wheels) else "steady_enough" if wheels else "no_flywheel"


def _idle_motor(results: Results, stated: Mapping[str, FileInput], _: str) -> str:
    return "" if "steady_speed" in results.summary or "transient.motor" in stated else "not_running"


def _idle_spacing(results: Results, *_: object) -> str:
    moments = results.listings["balance"].columns.get("free_moment") if "balance" in results.listings else None
    return "no_moments" if moments is None or not np.any(moments) else ""


def _is_engine(stated: Mapping[str, FileInput]) -> bool:
    return any(path.startswith("rod.") for path in stated)


def _idle_order(results: Results, stated: Mapping[str, FileInput], path: str) -> str:
    listing = results.listings.get("balance")
    return "" if listing is not None and f"balance_shafts.{stated[path].value}" in listing.names else "no_order"


def _idle_uneven(results: Results, *_: object) -> str:
    layout = results.machine.engine.layout if results.machine.engine is not None else None
    # cylinders fire at their own dead centres, which an offset moves
    tops = [(place.firing_angle + place.top) % layout.cycle for place in layout.places] if layout is not None else []
    angles = sorted(tops)
    gaps = np.diff([*angles, angles[0] + layout.cycle]) if layout is not None else np.array([0.0, 1.0])
    return "even_intervals" if np.ptp(gaps) <= _EVEN else ""


def _idle_return(results: Results, _: Mapping[str, FileInput], path: str) -> str:
    """Return whether a process force is zero wherever its piece moves back."""
    load = results.machine.loads[int(re.findall(r"\d+", path)[0]) - 1]
    if not isinstance(load, ProcessForce):
        return ""
    position, velocity = (f"{name}.{load.slider}" for name in ("slider_displacement", "slider_velocity"))
    degrees = np.linspace(results.grid.degrees[0], results.grid.degrees[-1], 4 * _SAMPLES)
    columns = results.columns_at(degrees, [position, velocity])
    rate = load.forward * columns[velocity]
    force = load.force(
        load.forward * (columns[position] - load.start) if load.against == "stroke" else np.radians(degrees)
    )
    return "" if np.any(force[rate < -_ROUNDING * np.max(np.abs(rate))]) else "no_return_force"


def _idle_numbering(results: Results, *_: object) -> str:
    engine = results.machine.engine
    places = engine.layout.places if engine is not None else ()
    return "one_a_bank" if places and len({place.axis for place in places}) == len(places) else ""


def _idle_place(_: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether no part of a linkage names a fixed point or a guide."""
    place = path.partition(".")[2]
    named = (str(item.value) for key, item in stated.items() if not _OF_BODIES.fullmatch(key))
    return "" if any(place.startswith((f"{name}.", f"{name}[")) for name in named) else "unused"


def _idle_mass(results: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether a driving link has its mass at its pivot."""
    moves = not _idle_about(results, stated, path) or results.machine.linkage is None or _is_engine(stated)
    return "" if moves or _has_weights(results) else "at_rest"


def _idle_about(_: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether a driving link turns about its centre of mass, as it does if no other centre is stated."""
    centre = f"{path.rpartition('.')[0]}.centre"
    return "" if centre in stated or f"{centre}[1]" in stated else "about_centre"


def _idle_place_of_mass(results: Results, _: Mapping[str, FileInput], path: str) -> str:
    """Return whether the centre of mass of a link stands still."""
    places = [results.columns.get(f"point_{axis}.{_part(path)}.centre", np.arange(2.0)) for axis in "xy"]
    still = all(np.ptp(place) <= _ROUNDING * np.max(np.abs(place)) for place in places)
    return "at_rest" if still and not _has_weights(results) else ""


def _idle_period(results: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether a torque is the same over twice its period, and the other torque has a longer one."""
    names, turning = ("torque", "load") if path.startswith("torque") else ("load", "torque"), results.machine.turning
    if turning is None:
        return ""
    own, other = (getattr(turning, name) for name in names)
    if own.points or own.strokes or any(own.delays) or not own.is_complete:
        return ""
    is_stated = {f"{names[1]}.period", f"{names[1]}.rate"} & stated.keys()
    return "unused" if is_stated and common_period(2 * own.period, other.period) == turning.cycle else ""


def _idle_shape(results: Results, _: Mapping[str, FileInput], path: str) -> str:
    """Return whether a work is done at once."""
    name, number = path.partition(".")[0], int(re.findall(r"\d+", path)[0])
    stroke = getattr(results.machine.turning, name).strokes[number - 1]
    return "" if stroke.over and stroke.work else "at_once" if stroke.work else "unused"


def _is_rough(law: Friction) -> bool:
    return isinstance(law, PinFriction) and law.coefficient > 0


def _mass_of(results: Results, *names: str) -> float:
    """Return the sum of masses of a crank gear, 1 of another machine."""
    masses = results.machine.masses
    return 1.0 if masses is None else sum(getattr(masses, name) for name in names)


def _idle_inertia(results: Results, _: Mapping[str, FileInput], path: str) -> str:
    angles = results.columns.get(f"link_angle.{_part(path)}", np.empty(0))
    return "never_turns" if len(angles) > 2 and np.ptp(angles) <= _ROUNDING else ""


def _idle_point(_: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether a point of a diagram stands on none of its pieces, or serves as a reference by its volume only."""
    place, __, name = path.rpartition(".")
    gas, __, point = place.rpartition(".points.")
    uses = {key.rpartition(".")[2].partition("[")[0] for key, item in stated.items()
            if item.value == point and key.startswith(f"{gas}.pieces[")}  # fmt: skip
    if not uses:
        return "unused"
    if name == "volume" and f"{place}.angle" in stated and point not in _states(gas, stated):
        return "unused"
    return "only_volume" if name == "angle" and "points" not in uses and f"{place}.volume" in stated else ""


def _states(gas: str, stated: Mapping[str, FileInput]) -> set[str]:
    """Return the points whose volumes polytropes go through."""
    pieces = [key.removesuffix(".law") for key, item in stated.items()
              if key.startswith(f"{gas}.pieces[") and item.value == "polytropic"]  # fmt: skip
    return {str((stated.get(f"{piece}.reference") or stated[f"{piece}.points[1]"]).value) for piece in pieces}


def _idle_school(_: Results, stated: Mapping[str, FileInput], path: str) -> str:
    """Return whether there are no corners that a school could round."""
    cycle = path.removesuffix(".school")
    corners = stated.get(f"{cycle}.corners", FileInput(None)).value
    has_timing = any(key.startswith(f"{cycle}.timing.") for key in stated)
    return "" if corners == "rounded" or (corners is None and has_timing) else "sharp_corners"


# why an input may have no effect although it is in the trace, or need not be in it
_REASONS: tuple[tuple[str, Callable[[Results, Mapping[str, FileInput], str], str]], ...] = (
    (r"motor\.\w+", _idle_motor),
    (r"motor_selection\.\w+", lambda results, *_: "" if _needs_motor(results) else "no_motor_needed"),
    (r".*\.timing\.\w+", lambda results, stated, path: _idle_event(path, stated, results)),
    (_ROUNDED, lambda results, stated, path: _idle_convention(path, stated, results)),
    (r".*cycle\.school", _idle_school),
    (r"engine\.spacing", _idle_spacing),
    (r"engine\.uneven", _idle_uneven),
    (r"engine\.numbering", _idle_numbering),
    (r"balance\.shafts\[\d\]", _idle_order),
    (r"(fixed_points|guides)\..*", _idle_place),
    (r"engine\.strokes", lambda results, *_: "strokes_of_gas" if results.machine.gas is not None else ""),
    (r"flywheel\.(fluctuation|percent)", _idle_wheel),
    (r"flywheel\.(radius_of_gyration|rim\..*)", lambda results, _, path: ""
     if results.machine.drive.fluctuation is None and path in leaves(results) else _idle_wheel(results)),
    (r"cylinder\.piston_rod_diameter", lambda results, stated, _: ""
     if "gas.back_pressure" in stated or results.machine.test is not None else "unused"),
    # places of the links of one that is drawn turn with it
    (r"cylinder\.inclination", lambda known, *_: "" if known.machine.linkage or _has_weights(known) else "weights_off"),
    (r"crank\.mass|geared\..*\.mass", _idle_mass),
    (r"links\..+\.mass", _idle_place_of_mass),
    (r"sliders\..+\.inertia", lambda results, _, path: "" if _turns(results, _part(path)) else "never_turns"),
    (r"friction\.circle", lambda known, *_: "" if any(map(_is_rough, known.machine.friction)) else "no_rubbing_pin"),
    (r"(torque|load)\.(period|rate)", _idle_period),
    (r"(torque|load)\.strokes\[\d+\]\.(shape|peak)", _idle_shape),
    (r"balance\.rotating_share",
     lambda known, *_: "" if _mass_of(known, "crank", "rod_big_end") else "no_rotating_mass"),
    (r"efficiency\.losses", _idle_losses),
    (r"transfer\.bodies\..*\.(mass|inertia)", _idle_body),
    (r"torsion\.orders", _idle_torsion),
    (r"torsion\.reference_diameter", lambda results, _, path: "" if path in leaves(results) else "unused"),
    (r"rotor\.bearings.*", lambda known, *_: "" if any(key.startswith("bearing_load") for key in known.trace)
     else "unused"),
    (r"method\.rod", lambda known, stated, _: "" if not _is_engine(stated) or _mass_of(known, "rod_inertia_excess")
     else "unused"),
    (r"method\.inertia_rod_ratio", lambda known, stated, _: ""
     if _is_engine(stated) and _has_mass(known) and not known.method.is_exact else "unused"),
    (r"chambers\.[^.]+\.pressures", lambda _, stated, path: "unused" if f"{path[:-9]}cycle.kind" in stated else ""),
    (_ABOUT, _idle_about),
    (r"links\..+\.(inertia|radius_of_gyration)", _idle_inertia),
    (r"loads\[\d+\]\.acts", _idle_return),
    (r"method\.weights", lambda results, *_: "" if _has_mass(results) else "no_masses"),
    (r".*\.points\.[^.]+\.(angle|stroke|pressure|volume)", _idle_point),
)  # fmt: skip


def _idle_event(path: str, stated: Mapping[str, FileInput], results: Results) -> str:
    """Return why an event of the valves has no effect in a calculated cycle; empty if it has."""
    table, name = path.rsplit(".", 1)
    cycle = table.removesuffix(".timing")
    kind, corners, school = (
        stated.get(f"{cycle}.{key}", FileInput(None)).value for key in ("kind", "corners", "school")
    )
    has_timing = any(path.startswith(f"{cycle}.timing.") for path in stated)
    is_rounded = school != "none" and (corners == "rounded" or (corners is None and has_timing))
    if (kind in _CORNERS or name == "peak") and not (is_rounded and kind in _CORNERS):
        return "sharp_corners"
    if name in ("ignition", "ignition_delay") and kind not in _CORNERS:
        return "unused"
    if results.machine.cycle > 360.0:
        return "from_dead_centre" if name == "intake_closes" and kind in _CORNERS else ""
    other = {"intake_closes": "exhaust_closes", "exhaust_closes": "intake_closes"}.get(name, "")
    numbers = results.machine.stated
    first, second = (numbers.get(f"{table}.{key}", InputNumber(0.0)).value for key in (name, other))
    # one that is not far from the other may become the later one
    return "closes_first" if other and 2 * first < second else ""


def _idle_convention(path: str, stated: Mapping[str, FileInput], results: Results) -> str:
    """Return why a convention of rounding has no effect: without the event whose corner it rounds, or without room."""
    table, name = path.rsplit(".", 1)
    event = "exhaust_opens" if name == "blow_down" else "ignition"
    if f"{table}.timing.{event}" not in stated or _idle_event(f"{table}.timing.peak", stated, results):
        return "sharp_corners"
    if name == "blow_down":
        return "" if results.machine.cycle > 360.0 else "falls_through_ports"
    calculated = getattr(results.machine.gas, "calculated", None)
    if name != "rise" or calculated is None or calculated.rounding.filling_factor:
        return ""
    kind = "petrol" if calculated.cycle.kind in _SPARK else "diesel"
    level = calculated.rounding.peak_level or PEAK_LEVEL[kind]
    compressed, peak = (calculated.cycle.values[f"{stage}_pressure"] for stage in ("compression", "combustion"))
    # it is at most halfway to the peak
    room = (1 + level * peak / compressed) / 2
    return "halfway" if _LOWERED * calculated.rounding.ratio_of_rise >= room else ""


def _unreached_forces(results: Results, stated: Mapping[str, FileInput]) -> Iterator[IdleInput]:
    """Yield entries of tables of process forces that lie beyond what the piece travels."""
    for number, load in enumerate(results.machine.loads, start=1):
        if not isinstance(load, ProcessForce) or not isinstance(load.force, LoadCurve) or load.against != "stroke":
            continue
        travel = _travel(results, load)
        acting = load.force(travel)
        values = {"begins": load.force.at[0] * 1e3, "from": float(travel[0]) * 1e3, "to": float(travel[-1]) * 1e3}
        for key, name in (("at", "at"), ("force", "values")):
            for index in range(len(load.force.at)):
                path = f"loads[{number}].{key}[{index + 1}]"
                if path in stated and not _acts(load.force, name, index, travel):
                    is_inside = abs(load.force.at[index] - np.mean(travel)) <= (0.5 + _ROUNDING) * np.ptp(travel)
                    of_entry = "zero_around" if is_inside else "beyond_stroke"
                    code = of_entry if np.any(acting) else "never_acts" if any(load.force.values) else "zero_force"
                    yield IdleInput(path, code, values)


def _travel(results: Results, load: ProcessForce) -> Array:
    """Return distances from the start of the working stroke that the piece comes to. [m]"""
    key, degrees = f"slider_displacement.{load.slider}", results.grid.degrees
    positions = results.columns_at(np.linspace(degrees[0], degrees[-1], _SAMPLES), [key])[key] - load.start
    low, high = sorted((load.forward * float(np.min(positions)), load.forward * float(np.max(positions))))
    return np.linspace(low, high, 4 * _SAMPLES, dtype=np.float64)


def _acts(curve: LoadCurve, name: str, index: int, travel: Array) -> bool:
    """Return whether a force that is met changes with an entry of its table, `at` or `values`."""
    columns = {"at": curve.at, "values": curve.values}
    largest, acting = max(map(abs, columns[name])), curve(travel)
    for share in (0.01, -0.01):
        other = list(columns[name])
        other[index] += share * (other[index] or largest)
        entries = {**columns, name: tuple(other)}
        try:
            changed = replace(curve, at=entries["at"], values=entries["values"])(travel)
        except ValueError:
            return True
        if np.max(np.abs(changed - acting)) > _ROUNDING * max(map(abs, curve.values)):
            return True
    return False
