"""Discs on elastic shafts against dense eigenvalues, a continuous shaft and matrices assembled by energy."""

import math

import numpy as np
import pytest
from scipy import linalg, optimize

from crankwork.shaft.torsional_system import GROUND, TorsionalStructure, TorsionalSystem, largest_of_waves
from each import for_each

pytestmark = pytest.mark.elsewhere


def random_tree(seed: int) -> TorsionalSystem:
    """Return a branched system, every third edge or so a pair of gears, at times held by the ground."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 10))
    edges = [(int(rng.integers(0, k)), k) for k in range(1, count)]
    is_gear = rng.random(count - 1) < 0.3
    is_gear[0] = False
    shafts = [edge for edge, gear in zip(edges, is_gear, strict=True) if not gear]
    if seed % 4 == 0:
        shafts.append((int(rng.integers(0, count)), GROUND))
    gears = [edge for edge, gear in zip(edges, is_gear, strict=True) if gear]
    return TorsionalSystem(
        TorsionalStructure(count, tuple(shafts), tuple(gears)),
        rng.uniform(0.1, 10.0, count),
        rng.uniform(1e3, 1e5, len(shafts)),
        rng.uniform(0.3, 3.0, len(gears)) * rng.choice([-1, 1], len(gears)),
    )


def dense(system: TorsionalSystem) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return stiffness, mass and null space of the constraints: gears as constraint equations of all discs."""
    structure = system.structure
    K, M = np.zeros((structure.discs, structure.discs)), np.diag(system.inertia)
    for (a, b), k in zip(structure.shafts, system.stiffness, strict=True):
        for one, other in ((a, b), (b, a)):
            if one != GROUND:
                K[one, one] += k
                if other != GROUND:
                    K[one, other] -= k
    bound = np.zeros((len(structure.gears), structure.discs))
    for row, ((a, b), i) in enumerate(zip(structure.gears, system.ratio, strict=True)):
        bound[row, b], bound[row, a] = 1.0, -i
    return K, M, linalg.null_space(bound) if structure.gears else np.eye(structure.discs)


@for_each("seed", range(100))
def test_branched_and_geared_systems_have_the_eigenvalues_of_dense_matrices(seed):
    system = random_tree(seed)
    K, M, free = dense(system)
    values = linalg.eigh(free.T @ K @ free, free.T @ M @ free, eigvals_only=True)
    modes = system.modes()
    size = values[-1]
    assert np.max(np.abs(modes.frequency**2 - values)) <= 1e-10 * size
    elastic = slice(modes.rigid, None)
    assert modes.frequency[elastic] == pytest.approx(np.sqrt(values[elastic]), rel=1e-10)
    assert modes.rigid == int(np.sum(values < 1e-9 * size))


def test_modes_and_tables_of_holzer_leave_no_torque():
    for seed in range(40):
        system = random_tree(seed)
        modes = system.modes()
        for w, shape in zip(modes.frequency[modes.rigid :], modes.shape[modes.rigid :], strict=True):
            table = system.holzer(w, shape)
            largest = max(abs(row.torque) for row in table.rows)
            assert abs(table.remainder) <= 1e-9 * largest


def test_a_trial_by_holzer_balances_all_discs_but_the_last():
    for seed in range(40):
        system = random_tree(seed)
        K, M, free = dense(system)
        w = 77.0
        angle = system.trial(w)
        left = free.T @ (K - w**2 * M) @ angle
        unbalanced = np.zeros(angle.size)
        unbalanced[-1] = -system.holzer(w, angle).remainder
        assert left == pytest.approx(free.T @ unbalanced, abs=1e-9 * np.max(np.abs(K @ angle)))


def test_discs_without_inertia_only_pass_the_torque_on():
    structure = TorsionalStructure(3, ((0, 1), (1, 2)))
    light = TorsionalSystem(structure, np.array([2.0, 0.0, 3.0]), np.array([1000.0, 4000.0]))
    modes = light.modes()
    stiffness = 1 / (1 / 1000.0 + 1 / 4000.0)
    assert modes.frequency == pytest.approx([0.0, math.sqrt(stiffness * 5 / 6)], abs=1e-12)
    shape = modes.shape[1] / modes.shape[1][0]
    assert shape[1] == pytest.approx(1 - 0.8 * (1 - shape[2]), rel=1e-12)


def test_a_shaft_with_mass_has_the_roots_of_the_continuous_shaft():
    """Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines, problem 9.9."""
    length, modulus, density, left, right = 800.0, 75e9, 8000.0, 200.0, 10.0
    moment = math.pi / 32 * (0.78**4 - 0.65**4)
    system = TorsionalSystem(
        TorsionalStructure(2, ((0, 1),), (), (0,)), np.array([left, right]), np.array([modulus * moment / length]),
        own_inertia=np.array([density * moment * length]),
    )  # fmt: skip
    speed = math.sqrt(modulus / density)

    def end_torque(w):
        beta = w / speed
        stiff = modulus * moment * beta
        return stiff * (left * w**2 + right * w**2) * math.cos(beta * length) - (
            left * right * w**4 - stiff**2
        ) * math.sin(beta * length)

    found = system.modes().frequency[1:7]
    for w in found:
        root = optimize.brentq(end_torque, 0.999 * w, 1.001 * w, xtol=1e-13)
        assert w == pytest.approx(root, rel=1e-10)


def test_forced_vibration_is_that_of_matrices_assembled_by_hand():
    rng = np.random.default_rng(5)
    structure = TorsionalStructure(4, ((0, 1), (1, 2), (2, 3)))
    J, k, c, loss, held = (
        rng.uniform(low, 2 * low, n) for low, n in ((1.0, 4), (1e4, 3), (3.0, 3), (0.01, 3), (2.0, 4))
    )
    system = TorsionalSystem(structure, J, k, disc_damping=held, shaft_damping=c, loss_factor=loss)
    w, torque = 130.0, rng.normal(size=4) + 1j * rng.normal(size=4)
    matrix = np.diag(-(w**2) * J + 1j * w * held).astype(complex)
    for index in range(3):
        part = k[index] * (1 + 1j * loss[index]) + 1j * w * c[index]
        matrix[index : index + 2, index : index + 2] += part * np.array([[1, -1], [-1, 1]])
    angle, inside = system.forced([w], torque[None])
    expected = np.linalg.solve(matrix, torque)
    assert angle[0] == pytest.approx(expected, rel=1e-12)
    assert inside[0] == pytest.approx((k * (1 + 1j * loss) + 1j * w * c) * -np.diff(expected), rel=1e-9)


def test_the_largest_of_a_sum_of_waves_is_that_of_many_points():
    rng = np.random.default_rng(3)
    orders = np.arange(1, 25) / 2
    waves = (rng.normal(size=(24, 5)) + 1j * rng.normal(size=(24, 5))) / orders[:, None]
    angle = np.linspace(0, 4 * math.pi, 200_001)
    values = np.abs((np.exp(1j * np.outer(angle, orders)) @ waves).real).max(axis=0)
    assert largest_of_waves(orders, waves, 4 * math.pi) == pytest.approx(values, rel=2e-5)
