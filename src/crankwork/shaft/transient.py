"""Start and run-down of a machine: its speed from cycle to cycle, until it is steady, stands still or stalls."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from crankwork.dynamics.reduction import kinetic_energy
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.collocation import WEIGHTS, Panels, integrate
from crankwork.shaft.speed import ReducedMachine, SpeedRun, Status, energy_drift

# A panel on which the energy falls below this part of what it was may hold the end of the motion.
_FALL = 0.3
_SHORTEST = 1e-9
_HALVINGS = 60


@dataclass
class _Path:
    """What has been gone through so far."""

    angles: list[float]
    speeds: list[float]
    times: list[float]
    drift: float = 0.0
    largest: float = 0.0
    pieces: list[Panels] = field(default_factory=list)

    def add(self, angle: Array, speed: Array, time: Array) -> None:
        self.angles += angle[1:].tolist()
        self.speeds += speed[1:].tolist()
        self.times += (self.times[-1] + time[1:]).tolist()


def run(
    machine: ReducedMachine, *, angle: float = 0.0, speed: float = 0.0, cycles: int = 1000, until_steady: bool = True
) -> SpeedRun:
    """Return how a machine turns from a given speed: a start from rest, a run-down, or anything between.

    Up to steady motion if wanted, to standstill (`stopped` where no motor acts any more is the same as `stalled` where
    one does, so a machine that has ever gained speed stalls), or to the last cycle. What happens after a standstill,
    when the load turns the crank back, is not followed (artobolevsky_1988, ch. 15).

    While it turns, the unknown is T = J w^2 / 2 over the crank angle; at rest, where w' is infinite over the angle,
    it is the crank angle over the speed: dphi/dw = J w / (M - w^2 J' / 2).
    """
    if speed < 0:
        raise MethodError(f"the crank turns with its positive direction; a speed of {speed:g} rad/s is against it")
    path = _Path([angle], [speed], [0.0])
    if speed == 0 and not _set_off(machine, path):
        degrees = math.degrees(angle)
        moment = float(machine.torque(np.array([angle]), np.array([0.0]))[0])
        return _told(machine, path, "not started", f"at {degrees:.1f} deg the torque at rest is {moment:.4g} N m")
    last = path.speeds[-1]
    for _ in range(cycles):
        start = path.angles[-1]
        begin_speed = path.speeds[-1]
        end = _cycle_end(machine, start, angle)
        if not _turn(machine, path, end):
            return _standstill(machine, path)
        steady = abs(path.speeds[-1] - begin_speed) <= 1e-9 * begin_speed and end - start > 0.999 * machine.cycle
        if until_steady and steady:
            return _told(machine, path, "steady", "")
        last = path.speeds[-1]
    message = f"not steady after {cycles} cycles, at {last:.6g} rad/s" if until_steady else ""
    return _told(machine, path, "turning", message)


def _cycle_end(machine: ReducedMachine, start: float, first: float) -> float:
    """Return the next angle that is whole cycles from the first one."""
    done = math.floor((start - first) / machine.cycle + 1e-9)
    return first + (done + 1) * machine.cycle


def _standstill(machine: ReducedMachine, path: _Path) -> SpeedRun:
    place = math.degrees(path.angles[-1] % machine.cycle)
    turns = (path.angles[-1] - path.angles[0]) / (2 * math.pi)
    if path.speeds[-1] > 0:
        return _told(machine, path, "not solved", f"the motion was lost at a crank angle of {place:.2f} deg")
    gained = max(path.speeds) > path.speeds[0] * (1 + 1e-12)
    rest = float(machine.torque(np.array([path.angles[-1]]), np.array([0.0]))[0])
    message = f"at a crank angle of {place:.2f} deg after {turns:.3f} turns, where the torque at rest is {rest:.4g} N m"
    if gained:
        return _told(machine, path, "stalled", f"the machine stalls {message}: the motor is weaker than the load")
    return _told(machine, path, "stopped", f"the machine stops {message}")


def _told(machine: ReducedMachine, path: _Path, status: Status, message: str) -> SpeedRun:
    angle, speed, time = np.array(path.angles), np.array(path.speeds), np.array(path.times)
    low, high = int(np.argmin(speed)), int(np.argmax(speed))
    return SpeedRun(
        angle,
        speed,
        machine.acceleration(angle, speed),
        time,
        status,
        message,
        energy_drift=path.drift / path.largest if path.largest else 0.0,
        least=float(speed[low]),
        at_least=float(angle[low]),
        largest=float(speed[high]),
        at_largest=float(angle[high]),
    )


def _turn(machine: ReducedMachine, path: _Path, end: float) -> bool:
    """Go on to an angle, as many panels at once as go smoothly; False at a standstill."""
    shortest = _SHORTEST * machine.cycle
    edges = machine.edges(path.angles[-1], end)
    count = edges.size - 1
    while edges.size > 1:
        if edges[1] - edges[0] < shortest:
            return False
        if _advance(machine, path, edges[: count + 1]):
            edges = edges[count:]
            count = min(2 * count, edges.size - 1)
        elif count > 1:
            count //= 2
        elif _stop(machine, path, float(edges[1])):
            return False
        else:
            edges = np.insert(edges, 1, (edges[0] + edges[1]) / 2)
    return True


def _advance(machine: ReducedMachine, path: _Path, edges: Array) -> bool:
    energy = float(kinetic_energy(machine.inertia(edges[:1])[0][0], path.speeds[-1]))
    # if the speed stayed the same, and the torque with it
    held = machine.torque(edges, np.full_like(edges, path.speeds[-1]))
    gain = np.concatenate([[0.0], np.cumsum(np.diff(edges) * (held[1:] + held[:-1]) / 2)])
    guess = np.maximum(energy + gain, energy * (_FALL if gain[-1] < 0 else 1.0))
    solved = integrate(machine.power(), edges, energy, guess=guess, positive=True)
    if not solved.converged or np.min(solved.values) < _FALL * energy:
        return False
    pace = 1 / machine.speed(solved.points, solved.inside)
    time = np.concatenate([[0.0], np.cumsum(np.diff(solved.edges) * (pace @ WEIGHTS))])
    path.add(solved.edges, machine.speed(solved.edges, solved.values), time)
    most = float(np.max(solved.values))
    path.drift += energy_drift(machine, solved) * most
    path.largest = max(path.largest, most)
    return True


def _by_speed(machine: ReducedMachine, edges: Array, angle: float) -> Panels:
    """Return the crank angle over the speed."""

    def rate(speed: Array, at: Array) -> Array:
        J, J_1 = machine.inertia(at)
        return np.asarray(J * speed / (machine.torque(at, speed) - speed**2 * J_1 / 2))

    return integrate(rate, edges, angle)


def _time_by_speed(machine: ReducedMachine, solved: Panels) -> Array:
    pace = 1 / machine.acceleration(solved.inside, solved.points)
    return np.concatenate([[0.0], np.cumsum(np.diff(solved.edges) * (pace @ WEIGHTS))])


def _set_off(machine: ReducedMachine, path: _Path) -> bool:
    """Go from rest to a low speed."""
    angle = path.angles[-1]
    moment = float(machine.torque(np.array([angle]), np.array([0.0]))[0])
    if moment <= 0:
        return False
    inertia = float(machine.inertia(np.array([angle]))[0][0])
    corner = float(machine.edges(angle, angle + machine.cycle)[1])
    speed = math.sqrt(moment * min(corner - angle, machine.cycle / 100) / inertia)
    for _ in range(_HALVINGS):
        solved = _by_speed(machine, np.linspace(0.0, speed, 2), angle)
        ahead = solved.converged and angle < solved.values[-1] <= corner and bool(np.all(solved.rate > 0))
        if ahead:
            path.add(solved.values, solved.edges, _time_by_speed(machine, solved))
            return True
        speed /= 2
    return False


def _stop(machine: ReducedMachine, path: _Path, end: float) -> bool:
    """Go from a low speed to rest, if that is where the next panel leads."""
    solved = _by_speed(machine, np.linspace(path.speeds[-1], 0.0, 3), path.angles[-1])
    if not solved.converged or np.any(solved.rate >= 0) or not path.angles[-1] < solved.values[-1] <= end + 1e-12:
        return False
    path.add(solved.values, solved.edges, _time_by_speed(machine, solved))
    path.speeds[-1] = 0.0
    return True
