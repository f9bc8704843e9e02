"""Kernels against analyses: the same single values, by operations of the memory at another grid."""

import functools
import itertools
import math
import runpy
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.formula.known import Found, Known, OfAngle, Pieces, given
from crankwork.formula.replay import Program
from crankwork.kernel import compiled as compiled_kernels
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.derivative import PARTIALS, ByAngle
from crankwork.kernel.graph import COMPUTE, Graph, number
from crankwork.kernel.graph import in_order as values_in_order
from crankwork.kernel.sums import shared
from crankwork.kernel.trace import Designs, NotCompiledError, Trace
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import polytropic_pressure
from crankwork.study.sought import sought_number

BULK = runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "bulk.py"))
ENGINE = BULK["ENGINE"].replace("compression_ratio = 9\n", 'compression_ratio = 9\noffset = "4 mm"\n')
EIGHT = BULK["V8"]
FIVE = """
[engine]
layout = "inline"
cylinders = 5
firing_order = [1, 2, 4, 5, 3]
spacing = "110 mm"
"""
LENGTHS = ("crank.radius", "rod.length", "cylinder.bore", "crank.speed", "piston.mass", "cylinder.compression_ratio")
MACHINES = {
    "engine": (ENGINE, LENGTHS),
    "textbook engine": (ENGINE.replace('offset = "4 mm"\n', "") + '[method]\nkinematics = "textbook"\n', LENGTHS),
    "five in line": (ENGINE + FIVE, LENGTHS),
    "V8": (ENGINE + EIGHT, LENGTHS),
    "four-bar": ("four-bar", ("crank.radius", "crank.speed", "links.coupler.length", "links.rocker.mass")),
    "six-bar": ("watt-six-bar", ("crank.radius", "crank.speed")),
    "shaper": ("crank-shaper", ("crank.radius", "crank.speed", "links.lever.length", "links.link.mass")),
    "press": ("press", ("crank.radius", "crank.speed", "links.rod.length")),
}
# what is found on rows, by vectors of forces or by the motion in time
PROCEDURES = {
    "energy", "oil_hole", "reversal", "vector_sum", "vector_share",  "harmonic", "fourier", "phase_star",
}  # fmt: skip


class Study:
    """A machine file with some fields varied."""

    def __init__(self, name):
        text, self.fields = MACHINES[name]
        self.description = crankwork.Description(text if "\n" in text else crankwork.template(text))
        values = self.description.values
        self.numbers = [sought_number(values, key) for key in self.fields]
        self.middle = np.array([one.now for one in self.numbers])
        of = np.arange(len(self.fields))
        ends = itertools.product(of, (0.98, 1.02))
        rows = [self.middle, *(np.where(of == at, factor * self.middle, self.middle) for at, factor in ends)]
        self.rows = np.array(rows)
        self.analysed = [self.results(one) for one in rows]
        self.memories = [one.memory for one in self.analysed]
        self.cycle = self.analysed[0].machine.cycle

    def results(self, design):
        pairs = zip(self.fields, self.numbers, design, strict=True)
        settings = [f"{key}={number.written(float(value))}" for key, number, value in pairs]
        return crankwork.analyse(self.description.machine(settings))

    def drawn(self, count, spread=0.02):
        factors = np.random.default_rng(11).uniform(1 - spread, 1 + spread, (len(self.fields), count))
        return self.middle[:, None] * factors

    @functools.cached_property
    def trace(self):
        self.designs = Designs(self.memories, self.rows, ())
        return Trace(self.designs, CrankGrid.from_degrees, np.arange(0, 360, 7.0), is_shifted=False)

    def compiles(self, key):
        trace = self.trace
        try:
            self.designs.add(key)
            trace.value(self.memories[0][key])
        except NotCompiledError as error:
            return error
        return None

    def kernel(self, keys, steps=None):
        return Kernel(self.memories, self.rows, keys, CrankGrid.from_degrees, cycle=self.cycle, steps=steps)


@pytest.fixture(scope="module", params=MACHINES)
def study(request):
    return Study(request.param)


@pytest.fixture(scope="module", params=["five in line", "four-bar"])
def short_study(request):
    return Study(request.param)


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CRANKWORK_CACHE", str(tmp_path_factory.mktemp("kernels")))
        yield


@pytest.fixture
def by_arrays(monkeypatch):
    monkeypatch.setattr(compiled_kernels, "compiles", lambda: False)


@pytest.fixture(params=["compiled", "arrays"])
def by(request):
    if request.param == "arrays":
        request.getfixturevalue("by_arrays")
    else:
        pytest.importorskip("numba")


def sizes(study, keys):
    """Return the size beside which each value is judged: that of the largest torque, force and so on, or a turn."""
    results = study.analysed[0]
    degrees = np.arange(0.0, study.cycle, 5.0)
    columns = results.columns_at(degrees, [key for key, known in results.memory.items() if known.varies])
    largest = {key: float(np.max(np.abs(column))) for key, column in columns.items()}
    largest |= {key: abs(value) for key, value in results.summary.items() if "angle" not in key}
    found = []
    for key in keys:
        word = key.partition(".")[0].removesuffix("_max").removesuffix("_min").rpartition("_")[2]
        same = [value for other, value in largest.items() if word in other.partition(".")[0] and "angle" not in other]
        found.append(2 * math.pi if "_angle" in key else max([*same, abs(results.summary[key])]))
    return np.array(found)


def test_single_values_are_those_of_analyses(study):
    pytest.importorskip("numba")
    keys = [key for key in study.analysed[0].summary if key in study.memories[0] and study.compiles(key) is None]
    assert len(keys) > len(study.analysed[0].summary) / 2
    designs = study.drawn(5)
    found = study.kernel(keys)(designs)
    size = sizes(study, keys)
    for at, design in enumerate(designs.T):
        summary = study.results(design).summary
        apart = np.abs(found.values[:, at] - [summary[key] for key in keys]) / size
        # a place where a column is flat is known to the root of its digits, and so is a ratio of places
        limits = [1e-7 if key.partition(".")[0].endswith(("_angle", "time_ratio")) else 1e-12 for key in keys]
        assert found.left_out[at] < 1e-12
        for key, one, limit in zip(keys, apart, limits, strict=True):
            assert one <= limit or math.isnan(summary[key]), (key, one)


def test_arrays_give_what_compiled_loops_give(short_study, monkeypatch):
    pytest.importorskip("numba")
    keys = [key for key in short_study.analysed[0].summary if key.endswith("_max")][:4]
    keys += [key for key in ("excess_work",) if key in short_study.analysed[0].summary]
    designs = short_study.drawn(70)
    for steps in (None, 720):
        by_loops = short_study.kernel(keys, steps)(designs).values
        with monkeypatch.context() as without:
            without.setattr(compiled_kernels, "compiles", lambda: False)
            by_arrays = short_study.kernel(keys, steps)(designs).values
        np.testing.assert_allclose(by_loops, by_arrays, rtol=1e-11)


def test_what_does_not_compile_says_why(study):
    reasons = set()
    for key in study.analysed[0].summary:
        told = study.compiles(key) if key in study.memories[0] else None
        if told is not None:
            reasons.add((told.reason, told.key.partition(".")[0]))
            assert told.reason in ("procedure", "table", "ways", "solved")
    if "V8" in str(study.description):
        assert reasons


def test_columns_of_a_graph_are_those_of_the_memory(study):
    """Every operation is one of a formula: the graph played as it is gives the columns that the memory gives."""
    keys = [key for key, known in study.memories[0].items() if known.varies and study.compiles(key) is None]
    degrees = np.linspace(1.3, study.cycle - 2.2, 60)
    design = study.drawn(1)[:, 0]
    memory = study.results(design).memory
    trace = Trace(Designs(study.memories, study.rows, keys), CrankGrid.from_degrees, degrees, is_shifted=True)
    expected = Program({key: memory[key] for key in keys})(CrankGrid.from_degrees(degrees))
    found = played([trace.value(study.memories[0][key]) for key in keys], design, degrees, study.cycle)
    for key, one in zip(keys, found, strict=True):
        size = np.max(np.abs(expected[key]))
        assert np.max(np.abs(one - expected[key])) <= 1e-12 * max(size, 1e-9), key


def played(wanted, design, degrees, cycle):
    """Return values of a graph at crank angles, each operation by NumPy."""
    made = {}
    for one in values_in_order(wanted):
        operands = [made[other.at] for other in one.operands]
        match one.kind:
            case "constant":
                made[one.at] = number(one) + 0 * degrees
            case "input":
                made[one.at] = design[one.detail] + 0 * degrees
            case "angle" if one.detail[0] == "reading":
                made[one.at] = one.graph.functions[one.detail[1]]((degrees + one.detail[2]) % cycle)
            case "angle":
                name, multiple, shift = one.detail
                made[one.at] = getattr(CrankGrid.from_degrees(multiple * degrees + shift), name)
            case "delayed" if not one.detail:
                made[one.at] = operands[0]
            case "pieces":
                ends, shift = [end.stated for end in one.detail[0]], one.detail[1]
                law = np.minimum(np.searchsorted(ends, (degrees + shift) % cycle), len(ends) - 1)
                made[one.at] = (
                    np.choose(law, operands) if len(operands) < 32 else np.array(operands)[law, range(len(law))]
                )
            case _:
                with np.errstate(all="ignore"):
                    made[one.at] = COMPUTE[one.kind](*operands)
    return [made[one.at] for one in wanted]


def test_sampled_values_are_those_of_columns_at_the_angles(by):
    study = Study("engine")
    keys = ["piston_force_max", "tangential_force_min", "mean_torque", "piston_force_min_angle"]
    designs = study.drawn(70)
    found = study.kernel(keys, steps=720)(designs).values
    for at in (0, 63, 64, 69):
        columns = study.results(designs[:, at]).columns_at(np.arange(720.0))
        expected = [
            columns["piston_force"].max(), columns["tangential_force"].min(), columns["crank_torque"].mean(),
            math.radians(columns["piston_force"].argmin()),
        ]  # fmt: skip
        np.testing.assert_allclose(found[:, at], expected, rtol=1e-12)


def test_sampled_work_and_flywheel_come_near_the_exact_ones_with_the_square_of_the_step(by_arrays):
    study = Study("engine")
    keys = ["excess_work", "flywheel_inertia"]
    designs = study.drawn(3)
    exact = study.kernel(keys)(designs).values
    coarse, fine = (np.abs(study.kernel(keys, steps=steps)(designs).values / exact - 1) for steps in (720, 7200))
    assert np.all(coarse < 2e-3)
    assert np.all(fine < coarse / 8)


def test_fields_that_are_followed_crookedly_are_refused():
    memories = [{"y": given("y", value, "a.field") * Known(OfAngle("sin"))} for value in (4.0, 1.0, 9.0)]
    for one in memories:
        one["y_max"] = Known(Found(0.0, "max", (one["y"],)), "y_max")
    with pytest.raises(NotCompiledError, match="curved_field"):
        Kernel(memories, np.array([[2.0], [1.0], [3.0]]), ["y_max"], CrankGrid.from_degrees, cycle=360.0)


def test_laws_that_end_elsewhere_are_refused():
    memories = [
        {"y": Known(Pieces([end, 360.0], (given("p", 1.0), given("p", 2.0)))) * given("a", one)}
        for end, one in ((90.0, 1.0), (91.0, 1.1), (92.0, 1.2))
    ]
    with pytest.raises(NotCompiledError, match="ways"):
        Designs(memories, np.array([[1.0], [1.1], [1.2]]), ["y"])


def test_of_two_extremes_the_worse_one_is_chosen_for_each_design():
    description = crankwork.Description(crankwork.template("crank-shaper"))
    radii = [0.050, 0.049, 0.051, 0.055, 0.090]
    analyses = [crankwork.analyse(description.machine([f"crank.radius={one * 1000:g} mm"])) for one in radii]
    keys = ["pressure_angle_max.D", "transmission_angle_min.D"]
    kernel = Kernel(
        [one.memory for one in analyses[:3]], np.array(radii[:3])[:, None], keys, CrankGrid.from_degrees,
        cycle=360.0, is_for_few=True,
    )  # fmt: skip
    expected = [[one.summary[key] for one in analyses] for key in keys]
    # far from the designs that were traced the ram leans the other way
    assert expected[0][0] == expected[0][2] < expected[0][3]
    assert kernel(np.array([radii])).values == pytest.approx(np.array(expected), abs=1e-9)


def test_the_mean_of_what_is_nothing_but_for_rounding_is_nothing():
    description = crankwork.Description(crankwork.template("slider-crank"))
    analyses = [crankwork.analyse(description.machine([f"crank.radius={one} mm"])) for one in (50, 49, 51)]
    radii = np.array([[0.050, 0.049, 0.051]])
    memories = [one.memory for one in analyses]
    kernel = Kernel(memories, radii.T, ["mean_torque"], CrankGrid.from_degrees, cycle=360.0, is_for_few=True)
    assert analyses[0].summary["mean_torque"] == 0
    assert not kernel(np.array([[0.050, 0.045, 0.060]])).values.any()


def test_two_equal_ways_of_writing_are_one_operation():
    graph = Graph()
    a, b = graph.input(0), graph.input(1)
    assert a * b is b * a
    assert a + b is b + a
    assert (a + 0.0) is a
    assert (a * b) / b is not None
    assert a**3 is a * (a * a)
    assert np.sqrt(a) is a**0.5


def test_sums_of_columns_share_their_parts():
    graph = Graph()
    column, radius = graph.angle("sin", 1, 0.0) * graph.input(0), graph.input(1)
    of = [graph.delayed(column, 90.0 * at) for at in range(4)]
    torque = (of[0] * radius + of[1] * radius) + (of[2] * radius + of[3] * radius)
    load = 0.5 * (of[0] + radius) + 0.5000000000000001 * (of[1] + radius) - 0.5 * of[2]
    other = -of[2] + (of[1] + of[0]) * 0.25
    roots = [torque, load * load, other]
    by = shared(roots, list(values_in_order(roots, into=lambda one: one.kind != "delayed")))
    assert set(by) == {torque.at, load.at, other.at}
    numbers = {one.at: known for one, known in zip((*of, radius), (0.3, 0.7, 1.9, 2.3, 1.1), strict=True)}

    def value(one):
        if one.at not in numbers:
            numbers[one.at] = number(one) if one.is_constant else COMPUTE[one.kind](*map(value, one.operands))
        return numbers[one.at]

    for one in (torque, load, other):
        assert value(by[one.at]) == pytest.approx(value(one), rel=1e-15)
    made = {one.at: one for one in values_in_order(by.values(), into=lambda one: one.kind != "delayed") if one.by_angle}
    # of the first two the sum once, and the radius times one sum
    assert sum(one.kind in ("add", "sub") for one in made.values()) == 6
    assert sum(one.kind == "mul" for one in made.values()) == 3


@pytest.mark.elsewhere
def test_derivatives_by_the_angle_are_those_of_differences_with_forty_digits():
    mpmath = pytest.importorskip("mpmath")
    graph = Graph()
    sin, cos = graph.angle("sin", 1, 0.0), graph.angle("cos", 1, 0.0)
    ratio = graph.input(0)
    column = (
        polytropic_pressure(2.0, 3.0, 1.0 + ratio * cos, 1.3) * np.sqrt(1.0 - (ratio * sin) ** 2) / (2.0 + np.exp(cos))
    )
    column = column + np.arctan(sin / (3.0 + cos)) + np.log(2.0 + sin) + np.tan(ratio * sin) + np.arcsin(ratio * cos)
    slope = ByAngle(graph).of(column)
    degrees = np.array([17.0, 93.0, 211.0, 340.0])
    (found,) = played([slope], [0.3], degrees, 360.0)

    def exactly(angle, q):
        s, c = mpmath.sin(angle), mpmath.cos(angle)
        first = 2 * (3 / (1 + q * c)) ** mpmath.mpf("1.3") * mpmath.sqrt(1 - (q * s) ** 2) / (2 + mpmath.exp(c))
        return first + mpmath.atan(s / (3 + c)) + mpmath.log(2 + s) + mpmath.tan(q * s) + mpmath.asin(q * c)

    with mpmath.workdps(40):
        for one, value in zip(degrees.tolist(), found, strict=True):
            at = mpmath.radians(one)
            assert value == pytest.approx(float(mpmath.diff(lambda x: exactly(x, mpmath.mpf("0.3")), at)), rel=1e-12)


@pytest.mark.elsewhere
@pytest.mark.parametrize("name", PARTIALS)
def test_derivatives_of_operations_are_those_of_differences_with_forty_digits(name):
    mpmath = pytest.importorskip("mpmath")
    exactly = {
        "add": mpmath.fadd, "sub": mpmath.fsub, "mul": mpmath.fmul, "div": mpmath.fdiv, "neg": mpmath.fneg,
        "half_turns": lambda near, angle: mpmath.nint((near - angle) / mpmath.pi),
        "log_ratio": lambda x, y: mpmath.log(x / y), "arcsin": mpmath.asin, "arccos": mpmath.acos,
        "arctan": mpmath.atan,
    }  # fmt: skip
    function = exactly.get(name) or getattr(mpmath, name)
    of = [0.3, 0.7][: 2 if name in ("add", "sub", "mul", "div", "half_turns", "log_ratio") else 1]
    found = PARTIALS[name](COMPUTE[name](*of), *of)
    with mpmath.workdps(40):
        for at, one in enumerate(found):
            order = tuple(int(at == other) for other in range(len(of)))
            expected = mpmath.diff(function, tuple(map(mpmath.mpf, of)), order)
            assert one == pytest.approx(float(expected), rel=1e-14, abs=1e-30)


def test_a_cached_kernel_is_not_written_again(monkeypatch, tmp_path):
    pytest.importorskip("numba")
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    study = Study("engine")

    def written():
        study.kernel(["mean_torque"], steps=36)(study.drawn(2))
        return [(path.name, path.stat().st_mtime_ns) for path in tmp_path.rglob("kernel_*.py")]

    first = written()
    assert len(first) == 1
    assert written() == first


def test_where_nothing_can_be_kept_a_kernel_is_compiled_for_the_run(monkeypatch, tmp_path):
    pytest.importorskip("numba")
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path / "file"))
    study = Study("four-bar")
    found = study.kernel(["joint_force_max.B"], steps=36)(study.middle[:, None])
    assert found.values[0, 0] > 0
