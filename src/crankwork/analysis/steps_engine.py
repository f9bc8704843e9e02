"""What the memory of an engine has to show, by subject: which values, and at which crank angle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved
from crankwork.formula.known import Given as GivenNode
from crankwork.formula.known import Known
from crankwork.formula.lines import Moment
from crankwork.formula.steps import AnyStep, Given, StepGroup
from crankwork.kinematics.crank_grid import CrankGrid

_GEOMETRY = ("rod_ratio", "relative_offset", "stroke", "top_dead_centre_angle", "bottom_dead_centre_angle")
_SPEED = ("speed", "mean_piston_speed")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine")
_MOTION = (
    *_SWING, "rod_angle", "piston_displacement", "piston_transfer_1", "piston_transfer_2", "piston_velocity",
    "piston_acceleration", "rod_transfer_1", "rod_transfer_2", "rod_angular_velocity", "rod_angular_acceleration",
)  # fmt: skip
_EXTREMES = tuple(f"piston_{noun}_{end}" for noun in ("velocity", "acceleration") for end in ("max", "min"))
_MASSES = ("reciprocating_mass", "rotating_mass")
_SPACE = ("piston_area", "swept_volume", "clearance_volume", "compression_ratio")
_POINTS = ("cylinder_volume.", "diagram_pressure.")
_FORCES = (
    *_SWING, "cylinder_volume", "diagram_pressure", "gas_pressure", "gas_force", "inertia_acceleration",
    "inertia_force", "weight_force", "transverse_weight", "piston_force",
    "side_factor", "rod_factor", "radial_factor", "tangential_factor",
    "correction_couple", "rod_transverse_force", "side_force.couple", "side_force", "rod_force", "radial_force",
    "tangential_force", "rotating_inertia_force", "rotating_torque", "crank_torque", "pin_distance",
    "overturning_moment",
)  # fmt: skip
_FORCE_EXTREMES = tuple(
    f"{key}_{end}"
    for key in ("inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque")
    for end in ("max", "min")
)
_POWER = ("indicated_work", "indicated_mean_pressure", "indicated_power", "mean_torque")


def engine_steps(results: Results, crank_angle: float, force_angle: float) -> tuple[StepGroup, ...]:
    """Return the worked steps of an engine.

    Parameters
    ----------
    results : Results
        Of an engine.
    crank_angle, force_angle : float
        Where the motion and the forces are shown. [deg]

    Returns
    -------
    tuple of StepGroup
        Groups `cycle` (the steps that the results themselves hold), `geometry`, `speed`, `motion`, `harmonics`,
        `extremes`, `masses`, `gas`, `forces`, `force_extremes`, `power`, and those of `steps_whole` for an engine of
        several; those without a step are left out.
    """
    solved, memory = results.solved, results.memory
    moving, loaded = Moment(CrankGrid.from_degrees, crank_angle), Moment(CrankGrid.from_degrees, force_angle)
    order = ("displacement", "transfer_1", "velocity", "transfer_2", "acceleration")
    harmonics = [f"piston_{noun}_{which}_order" for which in ("first", "second") for noun in order]
    points = [key for key in memory if key.startswith(_POINTS)]
    at, there = (float(CrankGrid.from_degrees([one]).angle[0]) for one in (crank_angle, force_angle))
    groups: tuple[StepGroup, ...] = (
        StepGroup("cycle", tuple(_cycle(results, solved))),
        StepGroup("geometry", tuple(_own(moving, memory, _GEOMETRY))),
        StepGroup("speed", tuple(_own(moving, memory, _SPEED))),
        StepGroup("motion", tuple(_followed(moving, memory, _MOTION)), at),
        StepGroup("harmonics", tuple(_own(moving, memory, harmonics)), at),
        StepGroup("extremes", tuple(_own(moving, memory, _EXTREMES))),
        StepGroup("masses", tuple(_own(moving, memory, _MASSES))),
        StepGroup("gas", tuple(_own(loaded, memory, (*_SPACE, *points)))),
        StepGroup("forces", tuple(_followed(loaded, memory, _FORCES if "piston_force" in memory else ())), there),
        StepGroup("force_extremes", tuple(_own(loaded, memory, _FORCE_EXTREMES))),
        StepGroup("power", tuple(_own(loaded, memory, _POWER if solved.space is not None else ()))),
    )
    if solved.machine.engine is not None:
        # loaded when needed, as the analysis of whole engines is
        from crankwork.analysis.steps_whole import whole_engine_steps  # noqa: PLC0415

        groups = (*groups, *whole_engine_steps(results, force_angle))
    return tuple(group for group in groups if group.steps)


def _own(moment: Moment, memory: Mapping[str, Known], keys: Iterable[str]) -> Iterator[AnyStep]:
    """Yield the lines of keys themselves: what they are made of is shown elsewhere."""
    for key in keys:
        if key in memory and not _is_stated(memory[key]):
            yield moment.step(memory[key])


def _followed(moment: Moment, memory: Mapping[str, Known], keys: Iterable[str]) -> Iterator[AnyStep]:
    """Yield the lines of keys after those of everything they are made of."""
    yield from moment.steps(memory[key] for key in keys if key in memory)


def _is_stated(known: Known) -> bool:
    return isinstance(known.node, GivenNode)


def _cycle(results: Results, solved: Solved) -> Iterator[AnyStep]:
    """Yield the steps of a calculated cycle, before them what was given and after them what was integrated.

    A value that the rest of the results has too is that `.cycle`. A size is calculated twice where it was rounded.
    """
    calculated = solved.space.calculated if solved.space is not None else None
    if calculated is None:
        return
    last = {step.key: at for at, step in enumerate(results.steps)}
    others = {"displacement"} if solved.machine.engine is not None else set()

    def key_of(key: str) -> str:
        return f"{key}.cycle" if f"{key}.cycle" in results.summary or key in others else key

    end = max((at for at, key in enumerate(calculated.values) if key in last), default=-1)
    known = [
        (at, Given(key_of(key), value))
        for at, (key, value) in enumerate(calculated.values.items())
        if key not in last and key_of(key) in results.summary
    ]
    yield from (one for at, one in known if at < end)
    for at, step in enumerate(results.steps):
        yield step._replace(key=key_of(step.key) if at == last[step.key] else f"{step.key}.before_rounding")
    yield from (one for at, one in known if at > end)
