"""Steps of a machine let go, written for Numba: those of `gauss_step` one after another, as long as nothing happens.

A step that may reach an end of its stretch, a stop or rest is left to `Run`, which looks closer.
"""

from __future__ import annotations

import math

import numpy as np

from crankwork.formula.expression import FORMULAS
from crankwork.kernel.elementary import compiled, once
from crankwork.shaft.gauss_step import (
    AHEAD,
    AT_LOOKS,
    INTEGRATION,
    ITERATIONS,
    LOOKS,
    NEGLIGIBLE,
    NODES,
    POINTS,
    SETTLED,
    STAGNANT,
    TO_SERIES,
    TWICE,
    TWICE_AT_LOOKS,
    WEIGHTS,
)
from crankwork.shaft.transient import AT_END, GROWTH, SHARE, SHORTEST, TAIL

_acceleration = once(FORMULAS["acceleration_of_crank"].function)


@compiled
def accelerations(edges, powers, law, q, v, accelerations_out):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Put the accelerations at coordinates and rates into an array.

    `powers`: of inertia, torque, damping and the derivative of the inertia, shape (panels, 16, 4); `law`: ends of the
    stretch, period and the last panel that may be taken.
    """
    low, high, period, last = law[0], law[1], law[2], int(law[3])
    wraps = math.isinf(low) and not math.isinf(period)
    panel = 0
    for i in range(q.size):
        x = min(max(q[i], low), high)
        turned = period * math.floor((x - edges[0]) / period) if wraps else 0.0
        x -= turned
        while panel < last and x >= edges[panel + 1]:
            panel += 1
        while panel > 0 and x < edges[panel]:
            panel -= 1
        place = 2 * (q[i] - turned - edges[panel]) / (edges[panel + 1] - edges[panel]) - 1
        held = min(max(place, -1.0), 1.0)
        p = powers[panel]
        J, M, d, J_1 = p[-1, 0], p[-1, 1], p[-1, 2], p[-1, 3]
        for k in range(p.shape[0] - 2, -1, -1):
            J, M, d, J_1 = J * held + p[k, 0], M * held + p[k, 1], d * held + p[k, 2], J_1 * held + p[k, 3]
        if place != held:
            # along the tangents
            s = s_M = s_d = s_1 = 0.0
            for k in range(p.shape[0] - 1, 0, -1):
                s, s_M = s * held + k * p[k, 0], s_M * held + k * p[k, 1]
                s_d, s_1 = s_d * held + k * p[k, 2], s_1 * held + k * p[k, 3]
            beyond = place - held
            J, M, d, J_1 = J + beyond * s, M + beyond * s_M, d + beyond * s_d, J_1 + beyond * s_1
        accelerations_out[i] = _acceleration(M - d * v[i], v[i], J, J_1)


@compiled
def factored(matrix, order):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Turn a matrix into its factors, rows in another order."""
    for k in range(POINTS):
        best = k
        for i in range(k + 1, POINTS):
            if abs(matrix[i, k]) > abs(matrix[best, k]):
                best = i
        order[k] = best
        for j in range(POINTS):
            matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
        per = 1 / matrix[k, k]
        for i in range(k + 1, POINTS):
            matrix[i, k] *= per
            for j in range(k + 1, POINTS):
                matrix[i, j] -= matrix[i, k] * matrix[k, j]


@compiled
def solved(matrix, order, x):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Turn a right side into the solution."""
    for k in range(POINTS):
        x[k], x[order[k]] = x[order[k]], x[k]
    for j in range(POINTS):
        for i in range(j + 1, POINTS):
            x[i] -= matrix[i, j] * x[j]
    for j in range(POINTS - 1, -1, -1):
        x[j] /= matrix[j, j]
        for i in range(j):
            x[i] -= matrix[i, j] * x[j]


@compiled
def dot(row, a):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the sum of products."""
    result = 0.0
    for j in range(POINTS):
        result += row[j] * a[j]
    return result


@compiled
def farthest(a, start):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the largest distance of values from another one, infinite if one is not a number."""
    result = 0.0
    for i in range(POINTS):
        far = abs(a[i] - start)
        result = max(result, far) if far < math.inf else math.inf
    return result


@compiled
def slopes(q, v, h, values, matrix):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Put the derivatives of the residuals by the accelerations into a matrix."""
    rates = h / (q[POINTS] - q[0]), h / (v[2 * POINTS] - v[0])
    for i in range(POINTS):
        by_q, by_v = h * rates[0] * (values[POINTS + i] - values[i]), rates[1] * (values[2 * POINTS + i] - values[i])
        for j in range(POINTS):
            matrix[i, j] = -by_q * TWICE[i, j] - by_v * INTEGRATION[i, j]
        matrix[i, i] += 1.0


@compiled
def settled(edges, powers, law, start, rate, h, a):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201, PLR0913
    """Turn a guess of the accelerations at the Gauss points into those of a step; return whether there is one."""
    q, v, values = np.empty(3 * POINTS), np.empty(3 * POINTS), np.empty(3 * POINTS)
    matrix, order, move = np.empty((POINTS, POINTS)), np.empty(POINTS, np.intp), np.empty(POINTS)
    last = math.inf
    for iteration in range(ITERATIONS):
        for i in range(POINTS):
            q[i] = start + h * NODES[i] * rate + h * h * dot(TWICE[i], a)
            v[i] = rate + h * dot(INTEGRATION[i], a)
        farthest_q, fastest, count = farthest(q, start), farthest(v, 0.0), POINTS
        if iteration % 6 == 0:
            # once more at places near them, for the slopes that steer Newton's method
            by_q, by_v = 1e-7 * max(farthest_q, 1e-3 * farthest(q, 0.0), 1e-9), 1e-7 * max(fastest, 1e-9)
            for i in range(POINTS):
                q[POINTS + i], v[POINTS + i] = q[i] + by_q, v[i]
                q[2 * POINTS + i], v[2 * POINTS + i] = q[i], v[i] + by_v
            count = 3 * POINTS
        accelerations(edges, powers, law, q[:count], v[:count], values)
        if count > POINTS:
            slopes(q, v, h, values, matrix)
            factored(matrix, order)
        for i in range(POINTS):
            move[i] = values[i] - a[i]
        solved(matrix, order, move)
        for i in range(POINTS):
            a[i] += move[i]
        size, scale = farthest(move, 0.0), farthest(a, 0.0)
        if not math.isfinite(scale + size):
            return False
        change = max(size * h * h / max(farthest_q, 1e-300), size * h / max(fastest, 1e-300))
        stagnates = size >= last / 4 and (size <= STAGNANT * scale or change <= NEGLIGIBLE)
        left = size * min(size / last, 1.0) if iteration else size
        if left <= SETTLED * scale or change <= 1e-17 or stagnates:
            return True
        last = size
    return False


@compiled
def ahead(a, reach, guess):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Put what the polynomial of a step tells of the next into its guess; `reach`: how long that is, of the step."""
    for i in range(POINTS):
        x = 1 + 2 * min(reach * NODES[i], AHEAD)
        before, now = 1.0, x
        guess[i] = dot(TO_SERIES[0], a) + dot(TO_SERIES[1], a) * x
        for k in range(2, POINTS):
            before, now = now, ((2 * k - 1) * x * now - (k - 1) * before) / k
            guess[i] += dot(TO_SERIES[k], a) * now


@compiled
def may_leave(start, rate, h, a, limits, direction):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return whether a step turns back or goes beyond limits."""
    for i in range(1, LOOKS.size):
        q = start + h * LOOKS[i] * rate + h * h * dot(TWICE_AT_LOOKS[i], a)
        if not ((rate + h * dot(AT_LOOKS[i], a)) * direction > 0 and limits[0] < q < limits[1]):
            return True
    return False


@compiled
def left_out(a, h, fast, size):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the error of a step in units of the tolerance, relative to the largest rate and a size."""
    last = abs(dot(TO_SERIES[POINTS - 2], a)) + abs(dot(TO_SERIES[POINTS - 1], a))
    left = max(last * h * h / (TAIL * size), last * h / (TAIL * fast))
    return min(left, last / max(farthest(a, 0.0), 1e-300) / SHARE)


@compiled
def take_steps(edges, powers, law, limits, direction, sizes, state, kept):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201, PLR0913
    """Take steps while nothing may happen; return how many.

    `limits`: of the coordinate; `sizes`: end of the time, and the coordinate, of which a step may leave a small part
    out; `state`: time, coordinate, rate, whole periods, length to try, largest rate, length of the step before or zero,
    and its accelerations; `kept`: of each step time, coordinate, rate, length, periods and accelerations.
    """
    time, q, v, base, h, largest, before = state[0], state[1], state[2], state[3], state[4], state[5], state[6]
    past, a, count = state[7:], np.empty(POINTS), 0
    while count < len(kept) and time < sizes[0] * (1 - AT_END):
        h = min(h, sizes[0] - time)
        if before > 0:
            ahead(past, h / before, a)
        else:
            accelerations(edges, powers, law, np.array([q]), np.array([v]), a)
            a[:] = a[0]
        is_settled = settled(edges, powers, law, q, v, h, a)
        if is_settled and may_leave(q, v, h, a, limits, direction):
            break
        rate = v + h * dot(WEIGHTS, a)
        fast = max(largest, abs(v), abs(rate))
        tail = left_out(a, h, max(fast, 1e-300), sizes[1]) if is_settled else math.inf
        if not tail <= 1:
            before = before if is_settled else 0.0
            if h / 2 <= SHORTEST * max(time, 1e-3):
                break
            h /= 2
            continue
        kept[count, 0], kept[count, 1], kept[count, 2], kept[count, 3], kept[count, 4] = time, q, v, h, base
        kept[count, 5:], past[:] = a, a
        for i in range(POINTS):
            q += h * WEIGHTS[i] * (v + h * dot(INTEGRATION[i], a))
        count, before, largest, time, v = count + 1, h, fast, time + h, rate
        if math.isinf(law[1]) and not math.isinf(law[2]):
            turned = law[2] * math.floor((q - edges[0]) / law[2])
            base, q, limits = base + turned, q - turned, limits - turned
        h *= min(GROWTH, 0.9 * math.pow(max(tail, 1e-30), -1 / POINTS))
    state[0], state[1], state[2], state[3], state[4], state[5], state[6] = time, q, v, base, h, largest, before
    return count
