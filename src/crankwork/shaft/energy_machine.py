"""Reduced inertia and potential energy of a mechanism with springs, for motion by energy quadrature."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from crankwork.dynamics.reduction import reduced_inertia
from crankwork.errors import MethodError, MissingExtraError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.spring import Spring
from crankwork.locale import Refusal
from crankwork.mechanism.dyads import RRR
from crankwork.mechanism.mechanism import Mechanism
from crankwork.shaft.energy_motion import EnergyMachine

State = tuple[Array, Array, Array]


def energy_machine(
    mechanism: Mechanism, drive: float, springs: tuple[Spring, ...] = (), *, inertia: float = 0.0, fast: bool = False
) -> EnergyMachine:
    """Return a mechanism with springs and a constant torque on its crank, for motion by energy quadrature.

    `inertia`: moment of inertia that turns with the crank, besides the bodies [kg m2]; `fast`: whether to compile;
    for a crank and RRR dyads, with the extra `fast`.
    """
    if any(spring.preload for spring in springs):
        raise MethodError(Refusal("spring_preload"))
    compiles = fast and not mechanism.passages
    state = _compiled(mechanism, springs) if compiles else functools.partial(_state, mechanism, springs)
    return EnergyMachine(_with_inertia(state, inertia) if inertia else state, drive)


def _with_inertia(state: Callable[[Array], State], inertia: float) -> Callable[[Array], State]:
    def heavier(angle: Array) -> State:
        reduced, potential, slope = state(angle)
        return reduced + inertia, potential, slope

    return heavier


def _state(mechanism: Mechanism, springs: tuple[Spring, ...], angle: Array) -> State:
    moved = linkage_motion(mechanism, CrankGrid.from_radians(angle))
    inertia = reduced_inertia(mechanism, moved).inertia
    potential, slope = np.zeros_like(angle), np.zeros_like(angle)
    for spring in springs:
        start, end = moved.points[spring.start], moved.points[spring.end]
        dx, dy = end.x.position - start.x.position, end.y.position - start.y.position
        length = np.sqrt(dx * dx + dy * dy)
        longer = length - spring.free_length
        rate = (end.x.position_1 - start.x.position_1) * dx + (end.y.position_1 - start.y.position_1) * dy
        potential += spring.stiffness * longer * longer / 2
        slope += spring.stiffness * longer * rate / length
    return inertia, potential, slope


# For the compiler a point is (x, y, x', y') in one row of a table and a link (cos, sin, angle') with its origin's row.
def _rows(  # noqa: PLR0913 - tables instead of types, which the compiler takes apart faster
    angles: Array,
    crank: Array,
    fixed: Array,
    dyads: Array,
    dyad_rows: Any,  # noqa: ANN401 - integer table
    points: Array,
    point_rows: Any,  # noqa: ANN401
    bodies: Array,
    body_rows: Any,  # noqa: ANN401
    springs: Array,
    spring_rows: Any,  # noqa: ANN401
) -> Any:  # noqa: ANN401
    """Fill inertia, potential and its derivative for a crank, RRR dyads and points on links."""
    result = np.zeros((3, angles.size))
    p = fixed.copy()
    f = np.zeros((1 + 2 * len(dyads), 3))
    origin = np.zeros(len(f), np.int64)
    origin[0] = 1
    for i in range(angles.size):
        d = crank[4]
        c, s = math.cos(crank[3] + d * angles[i]), math.sin(crank[3] + d * angles[i])
        f[0, 0], f[0, 1], f[0, 2] = c, s, d
        p[0, 0], p[0, 1] = crank[1] + crank[0] * c, crank[2] + crank[0] * s
        p[0, 2], p[0, 3] = -d * crank[0] * s, d * crank[0] * c
        next_point = 0
        for k in range(-1, len(dyads)):
            if k >= 0:
                a, b, q = dyad_rows[k, 0], dyad_rows[k, 1], dyad_rows[k, 2]
                la, lb = dyads[k, 0], dyads[k, 1]
                dx, dy = p[b, 0] - p[a, 0], p[b, 1] - p[a, 1]
                square = dx * dx + dy * dy
                area = ((la + lb) ** 2 - square) * (square - (la - lb) ** 2)
                h = 0.5 * dyads[k, 2] * math.sqrt(area) if area >= 0 else math.nan
                along, side = 0.5 * (la * la - lb * lb) / square + 0.5, h / square
                ux, uy = along * dx - side * dy, along * dy + side * dx
                vx, vy = ux - dx, uy - dy
                ex, ey = p[b, 2] - p[a, 2], p[b, 3] - p[a, 3]
                one, two = 1 + 2 * k, 2 + 2 * k
                f[one, 0], f[one, 1], f[one, 2] = ux / la, uy / la, (ex * vx + ey * vy) / h
                f[two, 0], f[two, 1], f[two, 2] = vx / lb, vy / lb, (ex * ux + ey * uy) / h
                origin[one], origin[two] = a, b
                p[q, 0], p[q, 1] = p[a, 0] + ux, p[a, 1] + uy
                p[q, 2], p[q, 3] = p[a, 2] - f[one, 2] * uy, p[a, 3] + f[one, 2] * ux
            while next_point < len(points) and point_rows[next_point, 1] <= 2 + 2 * k:
                q, m = point_rows[next_point, 0], point_rows[next_point, 1]
                u, v = points[next_point, 0], points[next_point, 1]
                dx, dy = u * f[m, 0] - v * f[m, 1], u * f[m, 1] + v * f[m, 0]
                o = origin[m]
                p[q, 0], p[q, 1] = p[o, 0] + dx, p[o, 1] + dy
                p[q, 2], p[q, 3] = p[o, 2] - f[m, 2] * dy, p[o, 3] + f[m, 2] * dx
                next_point += 1
        for k in range(len(bodies)):
            a, b, m = body_rows[k, 0], body_rows[k, 1], body_rows[k, 2]
            x = p[a, 2] + bodies[k, 2] * (p[b, 2] - p[a, 2])
            y = p[a, 3] + bodies[k, 2] * (p[b, 3] - p[a, 3])
            result[0, i] += bodies[k, 0] * (x * x + y * y) + bodies[k, 1] * f[m, 2] * f[m, 2]
        for k in range(len(springs)):
            a, b = spring_rows[k, 0], spring_rows[k, 1]
            dx, dy = p[b, 0] - p[a, 0], p[b, 1] - p[a, 1]
            length = math.sqrt(dx * dx + dy * dy)
            longer = length - springs[k, 1]
            rate = (p[b, 2] - p[a, 2]) * dx + (p[b, 3] - p[a, 3]) * dy
            result[1, i] += springs[k, 0] * longer * longer / 2
            result[2, i] += springs[k, 0] * longer * rate / length
    return result


@functools.cache
def _compiler() -> Callable[..., Any]:
    try:
        import numba  # noqa: PLC0415 - the extra `fast`
    except ImportError:
        raise MissingExtraError(Refusal("extra_fast"), "fast") from None
    return numba.njit(cache=True)(_rows)


def _compiled(mechanism: Mechanism, springs: tuple[Spring, ...]) -> Callable[[Array], State]:
    """Return the state as one compiled call on the tables of a mechanism."""
    kernel, tables = _compiler(), _tables(mechanism, springs)

    def state(angle: Array) -> State:
        inertia, potential, slope = kernel(angle, *tables)
        if not np.isfinite(inertia).all():
            linkage_motion(mechanism, CrankGrid.from_radians(angle))
        return inertia, potential, slope

    return state


def _tables(mechanism: Mechanism, springs: tuple[Spring, ...]) -> tuple[Any, ...]:
    crank, dyads = mechanism.crank, []
    for group in mechanism.dyads:
        if not isinstance(group, RRR):
            raise MethodError("compiled motion is for a crank and RRR dyads only; leave `fast` out")
        dyads.append(group)
    # row 0 is the crank pin, row 1 the pivot
    points = {crank.pin: 0, "": 1}
    for name in (*mechanism.ground, *(dyad.point for dyad in dyads), *(point.name for point in mechanism.points)):
        points[name] = len(points)
    links = {crank.link: 0}
    for dyad in dyads:
        links[dyad.link_a], links[dyad.link_b] = len(links), len(links) + 1
    fixed = np.zeros((len(points), 4))
    for name, place in {"": crank.pivot, **mechanism.ground}.items():
        fixed[points[name], :2] = place
    extra = sorted(mechanism.points, key=lambda one: links[one.link])

    def floats(rows: list[tuple[float, ...]], width: int) -> Array:
        return np.array(rows, dtype=float).reshape(-1, width)

    def whole(rows: list[tuple[int, ...]], width: int) -> Any:  # noqa: ANN401 - integer table
        return np.array(rows, dtype=np.int64).reshape(-1, width)

    return (
        floats([(crank.radius, *crank.pivot, crank.start, crank.direction)], 5)[0],
        fixed,
        floats([(one.length_a, one.length_b, one.branch) for one in dyads], 3),
        whole([(points[one.joint_a], points[one.joint_b], points[one.point]) for one in dyads], 3),
        floats([(one.along, one.across) for one in extra], 2),
        whole([(points[one.name], links[one.link]) for one in extra], 2),
        floats([(one.mass, one.inertia, one.share) for one in mechanism.bodies], 3),
        whole([(points[one.start], points[one.end], links[one.link]) for one in mechanism.bodies], 3),
        floats([(one.stiffness, one.free_length) for one in springs], 2),
        whole([(points[one.start], points[one.end]) for one in springs], 2),
    )
