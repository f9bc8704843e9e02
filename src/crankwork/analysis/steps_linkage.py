"""The memory of a linkage as lines, in the groups that a note shows them in."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from crankwork.analysis.linkage import SolvedLinkage
from crankwork.analysis.results import Results
from crankwork.formula.known import Known, Use, given, in_order
from crankwork.formula.lines import Moment
from crankwork.formula.steps import AnyStep, Given, Step, StepGroup, worked_step
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.mechanism.structure import chain_mobility, structure
from crankwork.shaft.fluctuation import fluctuation_of_energy
from crankwork.shaft.flywheel import WAYS, inertia_on_other_shaft, work_of_mean_torque

_MOTION = (
    "point_x", "point_y", "point_velocity", "point_acceleration", "link_angle", "link_angular_velocity",
    "link_angular_acceleration", "slider_displacement", "slider_velocity", "slider_acceleration",
)  # fmt: skip
_INERTIA = ("link_inertia_force", "link_inertia_torque")
_JOINTS = ("joint_force_x", "joint_force_y", "joint_force", "normal_force", "normal_moment")
_REDUCTION = ("reduced_inertia", "kinetic_energy", "reduced_inertia_1", "reduced_torque")
_WHEEL = ("wittenbauer_slope", "whole_inertia", "flywheel_inertia")
_TORQUES = ("static_torque", "dynamic_torque", "balancing_torque", "driving_torque")


def linkage_steps(results: Results, row: int, force_row: int) -> tuple[StepGroup, ...]:
    """Return the lines of a linkage, or of a table of transfer functions.

    Parameters
    ----------
    results : Results
        Of either.
    row, force_row : int
        Rows of the columns where the motion, and where inertia and torques are shown.

    Returns
    -------
    tuple of StepGroup
        Groups `structure`, `speed`, `motion`, `inertia_loads`, `joint_forces`, `reduction`, `torques`, `flywheel`,
        `motor`; those without a line are left out. What has been shown is not shown again.
    """
    told = _Told(results, row), _Told(results, force_row)
    if row == force_row:
        told = told[0], told[0]
    motion, forces = told
    of_table = not isinstance(results.solved, SolvedLinkage)
    groups = [
        StepGroup("structure", () if of_table else tuple(_structure(results))),
        StepGroup("speed", motion.lines(["speed"]) if results.method.pi != math.pi else ()),
        motion.group("motion", _MOTION),
        StepGroup("inertia_loads", forces.of(_inertia(results)), forces.angle),
        forces.group("joint_forces", _JOINTS),
        forces.group("reduction", _REDUCTION),
        forces.group("torques", _TORQUES),
        StepGroup("flywheel", tuple(_flywheel(results, forces))),
        StepGroup("motor", tuple(_motor(results, forces))),
    ]
    return tuple(group for group in groups if group.steps)


class _Told:
    """Lines at one crank angle, each told once."""

    def __init__(self, results: Results, row: int) -> None:
        self._memory, self.angle = results.memory, float(results.grid.angle[row])
        self._moment = Moment(CrankGrid.from_degrees, float(results.grid.degrees[row]))
        self._told: set[tuple[str, float]] = set()

    def of(self, knowns: Iterable[Known]) -> tuple[AnyStep, ...]:
        """Return the lines of knowns that have not been told; of what is nothing but a number, only if asked for."""
        found, wanted = [], [one for one in knowns if not one.is_absent]
        asked = {one.key for one in wanted}
        for one in self._moment.steps(wanted):
            if (one.key, one.value) not in self._told and (one.key in asked or not isinstance(one, Given)):
                self._told.add((one.key, one.value))
                found.append(one)
        return tuple(found)

    def lines(self, kinds: Iterable[str]) -> tuple[AnyStep, ...]:
        """Return the lines of what the memory has of some kinds."""
        kinds = tuple(kinds)
        return self.of(known for key, known in self._memory.items() if key.partition(".")[0] in kinds)

    def group(self, name: str, kinds: Iterable[str]) -> StepGroup:
        """Return these lines as a group."""
        return StepGroup(name, self.lines(kinds), self.angle)


def _structure(results: Results) -> Iterator[Step]:
    found, _ = structure(results.solved.machine.linkage)
    if found is not None:
        yield worked_step(chain_mobility, float(len(found.links)), float(found.joints))


def _inertia(results: Results) -> Iterator[Known]:
    """Yield inertia forces and torques, which the forces in the joints remember."""
    forces = [known for key, known in results.memory.items() if key.partition(".")[0] in _JOINTS]
    yield from (known for known in in_order(forces) if known.key.partition(".")[0] in _INERTIA)


def _flywheel(results: Results, told: _Told) -> Iterator[AnyStep]:
    """Yield the flywheel in the four ways; the excess work of each is found over the turn and given here."""
    memory = results.memory
    for way in WAYS if "excess_work" in memory else ():
        for known in in_order([memory[f"flywheel_inertia.{way}"]]):
            kind = known.key.partition(".")[0]
            if kind == "excess_work":
                yield Given(known.key, known.value)
            elif kind in _WHEEL and isinstance(known.node, Use) and known.value > 0:
                yield from told.of([known])
    mean = memory.get("mean_torque")
    if "excess_work" in memory and mean is not None and mean.value:
        work = work_of_mean_torque(mean, 2 * math.pi)
        yield from told.of([work, fluctuation_of_energy(memory["excess_work"], work)])


def _motor(results: Results, told: _Told) -> Iterator[AnyStep]:
    """Yield the power that the motor needs and its inertia on the crank."""
    motor = results.solved.machine.drive.motor if isinstance(results.solved, SolvedLinkage) else None
    if motor is None:
        return
    if "motor_power" in results.memory:
        yield from told.of([results.memory["motor_power"]])
    if motor.inertia:
        inertia, ratio = given("flywheel_inertia.motor", motor.inertia), given("gear_ratio", motor.ratio)
        yield from told.of([inertia_on_other_shaft(inertia, ratio)])
