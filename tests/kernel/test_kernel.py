"""Kernels against analyses: the same single values, by operations of the memory at another grid."""

import math
import runpy
from pathlib import Path

import mpmath
import numpy as np
import pytest

from crankwork import Description, sweep, template
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import AngleFunction, Piecewise, ProcedureValue, TracedValue, given
from crankwork.kernel import compiled as compiled_kernels
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.graph import COMPUTE, PARTIALS, ByAngle, KernelGraph, number
from crankwork.kernel.graph import in_order as values_in_order
from crankwork.kernel.lowering import DesignTraces, Lowering, NotCompiledError
from crankwork.kernel.schedule import shared
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import polytropic_pressure
from varied import Varied

BULK = runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "bulk.py"))
ENGINE = BULK["ENGINE"].replace("compression_ratio = 9\n", 'compression_ratio = 9\noffset = "4 mm"\n')
THREE = """
[engine]
layout = "inline"
cylinders = 3
firing_order = [1, 3, 2]
spacing = "110 mm"
[method]
kinematics = "textbook"
"""
LENGTHS = ("crank.radius", "rod.length", "cylinder.bore", "crank.speed", "piston.mass", "cylinder.compression_ratio")
MACHINES = {
    "engine": (ENGINE, LENGTHS),
    "three in line by the textbook": (BULK["ENGINE"] + THREE, LENGTHS),
    "V8": (ENGINE + BULK["V8"], LENGTHS),
    "four-bar": ("four-bar", ("crank.radius", "crank.speed", "links.coupler.length", "links.rocker.mass")),
    "six-bar": ("watt-six-bar", ("crank.radius", "crank.speed")),
    "shaper": ("crank-shaper", ("crank.radius", "crank.speed", "links.lever.length", "links.link.mass")),
    "press": ("press", ("crank.radius", "crank.speed", "links.rod.length")),
}


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CRANKWORK_CACHE", str(tmp_path_factory.mktemp("kernels")))
        yield


@pytest.fixture
def by_arrays(monkeypatch):
    monkeypatch.setattr(compiled_kernels, "compiles", lambda: False)


def refusals(study):
    """Return why values do not compile, by their keys."""
    designs, found = DesignTraces(study.traces, study.rows, ()), {}
    trace = Lowering(designs, CrankGrid.from_degrees, np.arange(0, 360, 7.0), is_shifted=False)
    for key, known in study.traces[0].items():
        try:
            designs.add(key)
            trace.value(known)
        except NotCompiledError as error:
            found[key] = error
    return found


def sizes(study, keys):
    """Return the size beside which each value is judged: that of the largest torque, force and so on, or a turn."""
    results = study.analysed[0]
    degrees = np.arange(0.0, study.cycle, 5.0)
    columns = results.columns_at(degrees, [key for key, known in results.trace.items() if known.varies])
    largest = {key: float(np.max(np.abs(column))) for key, column in columns.items()}
    largest |= {key: abs(value) for key, value in results.summary.items() if "angle" not in key}
    found = []
    for key in keys:
        word = key.partition(".")[0].removesuffix("_max").removesuffix("_min").rpartition("_")[2]
        same = [value for other, value in largest.items() if word in other.partition(".")[0] and "angle" not in other]
        found.append(2 * math.pi if "_angle" in key else max([*same, abs(results.summary[key])]))
    return np.array(found)


def wrong_values(kernel, study, designs):
    """Return values that are not those of analyses, by design and key."""
    found, size, wrong = kernel(designs), sizes(study, kernel.keys), {}
    assert np.all(found.truncation_error < 1e-12)
    for at, design in enumerate(designs.T):
        summary = study.results(design).summary
        for key, one, of in zip(kernel.keys, found.values[:, at], size, strict=True):
            # a place where a column is flat is known to the root of its digits, and so is a ratio of places
            limit = 1e-7 if key.partition(".")[0].endswith(("_angle", "time_ratio")) else 1e-12
            if not (abs(one - summary[key]) <= limit * of or math.isnan(summary[key])):
                wrong[at, key] = one, summary[key]
    return wrong


@pytest.mark.parametrize("name", MACHINES)
def test_values_and_columns_are_those_of_analyses_and_others_say_why_not(name, by_arrays):
    study = Varied(*MACHINES[name])
    told = refusals(study)
    reasons = {key: error.reason for key, error in told.items() if key in study.summary}
    assert set(reasons.values()) <= {"procedure", "table", "ways", "solved"}
    assert reasons or name != "V8"
    keys = [key for key in study.summary if key in study.traces[0] and key not in told]
    assert len(keys) > len(study.summary) / 2
    assert wrong_values(study.kernel(keys), study, study.drawn(5)) == {}
    # every operation is one of a formula: the graph played as it is gives the columns that the memory gives
    keys = [key for key, known in study.traces[0].items() if known.varies and key not in told]
    degrees, design = np.linspace(1.3, study.cycle - 2.2, 60), study.drawn(1)[:, 0]
    trace = study.results(design).trace
    lowering = Lowering(DesignTraces(study.traces, study.rows, keys), CrankGrid.from_degrees, degrees, is_shifted=True)
    expected = Program({key: trace[key] for key in keys})(CrankGrid.from_degrees(degrees))
    found = played([lowering.value(study.traces[0][key]) for key in keys], design, degrees, study.cycle)
    apart = {key: np.max(np.abs(one - expected[key])) for key, one in zip(keys, found, strict=True)}
    assert {key for key, one in apart.items() if not one <= 1e-12 * max(np.max(np.abs(expected[key])), 1e-9)} == set()


@pytest.mark.compiled
@pytest.mark.parametrize("name", MACHINES)
def test_compiled_loops_give_what_analyses_and_arrays_give(name, monkeypatch):
    """Of seventy designs, because 64 are calculated at once."""
    study = Varied(*MACHINES[name])
    told, designs = refusals(study), study.drawn(70)
    kernel = study.kernel([key for key in study.summary if key in study.traces[0] and key not in told])
    assert wrong_values(kernel, study, designs[:, :5]) == {}
    found = kernel(designs).values
    few = [*[key for key in kernel.keys if key.endswith("_max")][:4], *({"excess_work"} & set(kernel.keys))]
    steps = study.kernel(few, steps=720)(designs).values if name in ("V8", "four-bar") else None
    monkeypatch.setattr(compiled_kernels, "compiles", lambda: False)
    rows = [kernel.keys.index(key) for key in few]
    np.testing.assert_allclose(found[rows], study.kernel(few)(designs).values, rtol=1e-11)
    if steps is not None:
        np.testing.assert_allclose(steps, study.kernel(few, steps=720)(designs).values, rtol=1e-11)


def played(wanted, design, degrees, cycle):
    """Return values of a graph at crank angles, each operation by NumPy."""
    made = {}
    for one in values_in_order(wanted):
        operands = [made[other.index] for other in one.operands]
        match one.kind:
            case "constant":
                made[one.index] = number(one) + 0 * degrees
            case "input":
                made[one.index] = design[one.detail] + 0 * degrees
            case "angle" if one.detail[0] == "reading":
                made[one.index] = one.graph.functions[one.detail[1]]((degrees + one.detail[2]) % cycle)
            case "angle":
                name, multiple, shift = one.detail
                made[one.index] = getattr(CrankGrid.from_degrees(multiple * degrees + shift), name)
            case "delayed" if not one.detail:
                made[one.index] = operands[0]
            case "pieces":
                ends, shift = [end.stated for end in one.detail[0]], one.detail[1]
                law = np.minimum(np.searchsorted(ends, (degrees + shift) % cycle), len(ends) - 1)
                made[one.index] = (
                    np.choose(law, operands) if len(operands) < 32 else np.array(operands)[law, range(len(law))]
                )
            case _:
                with np.errstate(all="ignore"):
                    made[one.index] = COMPUTE[one.kind](*operands)
    return [made[one.index] for one in wanted]


@pytest.mark.parametrize("way", [pytest.param("compiled", marks=pytest.mark.compiled), "arrays"])
def test_sampled_values_are_those_of_columns_at_the_angles(way, request):
    if way == "arrays":
        request.getfixturevalue("by_arrays")
    study = Varied(*MACHINES["engine"])
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
    study = Varied(*MACHINES["engine"])
    keys = ["excess_work", "flywheel_inertia"]
    designs = study.drawn(3)
    exact = study.kernel(keys)(designs).values
    coarse, fine = (np.abs(study.kernel(keys, steps=steps)(designs).values / exact - 1) for steps in (720, 7200))
    assert np.all(coarse < 2e-3)
    assert np.all(fine < coarse / 8)


def test_engines_are_as_an_engineer_writes_them_with_numpy(by_arrays):
    """Sums over whole degrees by trapezoids, where kernels have the curve."""
    designs = BULK["drawn"](BULK["FIELDS"], 128)
    np.testing.assert_allclose(BULK["kernel"](720)(designs).values, BULK["by_numpy"](designs), rtol=2e-4)


def test_fields_that_are_followed_crookedly_are_refused():
    traces = [{"y": given("y", value, "a.field") * TracedValue(AngleFunction("sin"))} for value in (4.0, 1.0, 9.0)]
    for one in traces:
        one["y_max"] = TracedValue(ProcedureValue(0.0, "max", (one["y"],)), "y_max")
    with pytest.raises(NotCompiledError, match="curved_field"):
        Kernel(traces, np.array([[2.0], [1.0], [3.0]]), ["y_max"], CrankGrid.from_degrees, cycle=360.0)


def test_laws_that_end_elsewhere_are_refused():
    traces = [
        {"y": TracedValue(Piecewise([end, 360.0], (given("p", 1.0), given("p", 2.0)))) * given("a", one)}
        for end, one in ((90.0, 1.0), (91.0, 1.1), (92.0, 1.2))
    ]
    with pytest.raises(NotCompiledError, match="ways"):
        DesignTraces(traces, np.array([[1.0], [1.1], [1.2]]), ["y"])


def test_of_two_extremes_the_worse_one_is_chosen_for_each_design(by_arrays):
    study, radii = Varied("crank-shaper", ["crank.radius"]), [0.050, 0.049, 0.051, 0.055, 0.090]
    keys = ["pressure_angle_max.D", "transmission_angle_min.D"]
    expected = [[study.results([one]).summary[key] for one in radii] for key in keys]
    # far from the designs that were traced the ram leans the other way
    assert expected[0][0] == expected[0][2] < expected[0][3]
    found = study.kernel(keys, is_for_few=True)(np.array([radii])).values
    assert found == pytest.approx(np.array(expected), abs=1e-9)


def test_the_mean_of_what_is_nothing_but_for_rounding_is_nothing():
    study = Varied("slider-crank", ["crank.radius"])
    assert study.summary["mean_torque"] == 0
    assert not study.kernel(["mean_torque"], is_for_few=True)(np.array([[0.050, 0.045, 0.060]])).values.any()


def test_two_equal_ways_of_writing_are_one_operation():
    graph = KernelGraph()
    a, b = graph.input(0), graph.input(1)
    assert a * b is b * a
    assert a + b is b + a
    assert (a + 0.0) is a
    assert (a * b) / b is not None
    assert a**3 is a * (a * a)
    assert np.sqrt(a) is a**0.5


def test_sums_of_columns_share_their_parts():
    graph = KernelGraph()
    column, radius = graph.angle("sin", 1, 0.0) * graph.input(0), graph.input(1)
    of = [graph.delayed(column, 90.0 * at) for at in range(4)]
    torque = (of[0] * radius + of[1] * radius) + (of[2] * radius + of[3] * radius)
    load = 0.5 * (of[0] + radius) + 0.5000000000000001 * (of[1] + radius) - 0.5 * of[2]
    other = -of[2] + (of[1] + of[0]) * 0.25
    roots = [torque, load * load, other]
    by = shared(roots, list(values_in_order(roots, into=lambda one: one.kind != "delayed")))
    assert set(by) == {torque.index, load.index, other.index}
    numbers = {one.index: known for one, known in zip((*of, radius), (0.3, 0.7, 1.9, 2.3, 1.1), strict=True)}

    def value(one):
        if one.index not in numbers:
            numbers[one.index] = number(one) if one.is_constant else COMPUTE[one.kind](*map(value, one.operands))
        return numbers[one.index]

    for one in (torque, load, other):
        assert value(by[one.index]) == pytest.approx(value(one), rel=1e-15)
    made = {
        one.index: one
        for one in values_in_order(by.values(), into=lambda one: one.kind != "delayed")
        if one.depends_on_angle
    }
    # of the first two the sum once, and the radius times one sum
    assert sum(one.kind in ("add", "sub") for one in made.values()) == 6
    assert sum(one.kind == "mul" for one in made.values()) == 3


@pytest.mark.elsewhere
def test_derivatives_by_the_angle_are_those_of_differences_with_forty_digits():
    graph = KernelGraph()
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
def test_derivatives_of_operations_are_those_of_differences_with_forty_digits():
    exactly = {
        "add": mpmath.fadd, "sub": mpmath.fsub, "mul": mpmath.fmul, "div": mpmath.fdiv, "neg": mpmath.fneg,
        "half_turns": lambda near, angle: mpmath.nint((near - angle) / mpmath.pi),
        "log_ratio": lambda x, y: mpmath.log(x / y), "arcsin": mpmath.asin, "arccos": mpmath.acos,
        "arctan": mpmath.atan,
    }  # fmt: skip
    wrong = {}
    for name, partials in PARTIALS.items():
        of = [0.3, 0.7][: 2 if name in ("add", "sub", "mul", "div", "half_turns", "log_ratio") else 1]
        function = exactly.get(name) or getattr(mpmath, name)
        with mpmath.workdps(40):
            for at, one in enumerate(partials(COMPUTE[name](*of), *of)):
                order = tuple(int(at == other) for other in range(len(of)))
                expected = float(mpmath.diff(function, tuple(map(mpmath.mpf, of)), order))
                if one != pytest.approx(expected, rel=1e-14, abs=1e-30):
                    wrong[name, at] = one, expected
    assert wrong == {}


@pytest.mark.compiled
def test_a_cached_kernel_is_not_written_again(monkeypatch, tmp_path):
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path))
    study = Varied(*MACHINES["engine"])

    def written():
        study.kernel(["mean_torque"], steps=36)(study.drawn(2))
        return [(path.name, path.stat().st_mtime_ns) for path in tmp_path.rglob("kernel_*.py")]

    first = written()
    assert len(first) == 1
    assert written() == first


@pytest.mark.compiled
def test_where_nothing_can_be_kept_a_kernel_is_compiled_for_the_run(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("CRANKWORK_CACHE", str(tmp_path / "file"))
    study = Varied(*MACHINES["four-bar"])
    found = study.kernel(["joint_force_max.B"], steps=36)(study.middle[:, None])
    assert found.values[0, 0] > 0


@pytest.mark.elsewhere
def test_no_law_ends_where_nothing_is_calculated_yet(monkeypatch):
    """Valves open where the gas has a pressure, and the volume of a linkage follows from the stroke, an extreme.

    The extreme is calculated before panels are laid: with stores full of no numbers nothing else may be read.
    """

    def stores(kernel, lanes):
        shapes = (
            (len(kernel.source.rows.of), lanes),
            (len(kernel.source.columns.of), kernel.plan.grid.degrees.size, lanes),
        )
        return tuple(np.full(shape, np.nan) for shape in shapes)

    monkeypatch.setattr(Kernel, "_stores", stores)
    bores = np.array([0.097, 0.1, 0.101, 0.103])
    swept = sweep(Description(template("compressor")), {"cylinder.bore": bores}, ["gas_force_max.cylinder"])
    # 5 bar in the cylinder, 1 bar behind the piston
    assert swept.values["gas_force_max.cylinder"] == pytest.approx(4e5 * math.pi / 4 * bores**2, rel=1e-12)
    assert (swept.reason, swept.one_by_one) == ("", 0)
