"""Compiled calculations: from many designs to the single values of each."""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, partial
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork import files
from crankwork.formula.traced_value import (
    Delayed,
    FormulaCall,
    FunctionValue,
    Node,
    ProcedureValue,
    Root,
    TracedValue,
    breakpoints_of,
    in_order,
)
from crankwork.kernel.gradient import Gradient, ReductionAdjoint, part_key, split_extreme
from crankwork.kernel.graph import COMPUTE, KernelValue, number
from crankwork.kernel.graph import in_order as values_in_order
from crankwork.kernel.grid import (
    Edges,
    Grid,
    lobatto,
    lobatto_grid,
    nodes_between,
    subdivide,
    uniform_grid,
    with_delayed_breakpoints,
)
from crankwork.kernel.javascript import Script
from crankwork.kernel.lowering import DesignTraces, Lowering, NotCompiledError, compiled_values
from crankwork.kernel.python_source import ACCUMULATED, LANES, Source
from crankwork.kernel.reductions import Block, LevelReductions, PolynomialReductions, SampledReductions
from crankwork.kernel.schedule import Schedule

Array = NDArray[np.float64]
# widths of panels that are tried, and the truncation error at which a column is accepted
_WIDTHS = (30.0, 15.0, 7.5, 3.75)
CONVERGED = 1e-12
# how often panels are divided where friction forces are not followed, and into how many
_DIVISIONS, _PARTS = 8, 4
# limit of the breakpoints of a grid, with those of delayed columns
_MAX_BREAKPOINTS = 400
_POLYNOMIALS = lobatto(16)
# designs per batch of values that do not depend on the crank angle
_BATCH_SIZE = 2048
# first step of the secant method, the step after which it ends, and the largest last step [deg]
_FIRST_STEP, _PLACED, _NEARLY_PLACED, _MAX_SECANTS = 1e-3, 1e-11, 1e-8, 20


class BatchResult(NamedTuple):
    """Single values of designs, shape (keys, n) [SI], and truncation errors of their columns, shape (n,)."""

    values: Array
    truncation_error: Array


class Kernel:
    """Single values of many designs, calculated by the operations that one analysis has traced.

    `traces`: that of the stated design, then two for each field, with a smaller and a larger value of it alone, and
    others; `fields`: their values in each, shape (traces, fields) [SI]. `steps`: number of evenly spaced crank angles;
    without it extremes and integrals are those of polynomials between the breakpoints of laws, as in an analysis.
    `parts`: the extremes of so many parts of the cycle are calculated too; `is_for_few`: uses arrays, as compiling
    takes longer than a few designs. Columns among the keys are stored, also at `rows` [deg], for what carries out the
    schedule elsewhere. `enough`: accepted truncation error. `NotCompiledError` says why a calculation cannot be
    compiled.
    """

    def __init__(  # noqa: PLR0913 - designs, what is wanted of them, and where it is looked at
        self,
        traces: Sequence[Mapping[str, TracedValue]],
        fields: Array,
        keys: Sequence[str],
        angles_at: Callable[[Any], Any],
        *,
        cycle: float,
        start: float = 0.0,
        steps: int | None = None,
        parts: int = 0,
        is_for_few: bool = False,
        rows: Array | None = None,
        enough: float = CONVERGED,
    ) -> None:
        designs = DesignTraces(traces, fields, keys)
        self.fields = fields.shape[1]
        self._wanted = {key: traces[0][key] for key in keys}
        traced = list(in_order(self._wanted.values(), into=_dependencies))
        if steps and any(isinstance(operand.node, FunctionValue) for operand in traced):
            raise NotCompiledError("procedure", next(iter(keys)))
        delays = sorted({operand.node.by for operand in traced if isinstance(operand.node, Delayed)})
        breaks = [breakpoints_of(_reduced([trace[key] for key in keys]), cycle, start) for trace in traces]
        # thousands of operations of a root take a minute to compile
        is_compiled = compiles() and not is_for_few and not designs.roots
        # corners of friction forces, and what the ends of laws follow from, calculated by a kernel of its own: further
        # inputs of this one
        corners = [] if steps else _corners(traced)
        self._inputs_of = {id(place.node): index for index, place in enumerate(corners, start=self.fields)}
        self._corners: Crossings | None = None
        self._before: Kernel | None = None
        before = partial(Kernel, angles_at=angles_at, cycle=cycle, start=start, is_for_few=is_for_few)
        widths = [width for width in _WIDTHS if width * parts <= cycle] or _WIDTHS[-1:]
        # forces that nearly vanish turn within thousandths of a degree: after the first width panels are divided
        self.is_iterated = bool(designs.roots)
        is_divided = self.is_iterated and not delays
        divided: Edges | None = None
        for width in (cycle,) if steps else [widths[0]] * _DIVISIONS if is_divided else widths:
            grid, edges = _grid(breaks, delays, width, steps) if divided is None else (_grid_between(divided), divided)
            grid = grid if rows is None else grid.with_rows(rows)
            if divided is None:
                is_shifted = any(grid.earlier(delay) is None for delay in delays)
                lower = partial(Lowering, designs, angles_at, grid.degrees, is_shifted=is_shifted, is_exact=not steps)
                lowering, outputs = self._lowered(lower, corners, designs, grid, None if steps else before)
            if lowering.moving and steps:
                grid = uniform_grid(lowering.zones(breaks[0]), steps)
            elif lowering.moving and edges is not None:
                edges = _following(edges, lowering, keys[0])
                grid = grid._replace(moves=edges.moves)
            self._edges = edges if lowering.moving else None
            if parts:
                split = {key: split_extreme(outputs[key], parts) for key in keys}
                outputs |= {part_key(key, part): value for key in keys for part, value in enumerate(split[key])}
            guard = lowering.guard(is_sampled=steps is not None)
            ends = [end for end, _ in lowering.moving]
            guarded = outputs | ({} if guard is None else {"": guard})
            law_ends = () if steps else ends
            inputs = self.fields + len(self._inputs_of)
            self.plan = Schedule(guarded, grid, inputs, angles_at, law_ends, shares=is_compiled)
            self._carry_out(grid, is_compiled=is_compiled, steps=steps, parts=parts)
            self.keys = tuple(outputs)
            # evaluated with arrays, so that only the accepted grid is compiled
            if steps:
                break
            # designs whose laws have another order are not followed by any grid
            error = self(fields.T).truncation_error
            if float(np.max(error, where=np.isfinite(error), initial=0.0)) <= enough:
                break
            if is_divided and edges is not None:
                divided = edges.divided(self._coarse_panels(fields.T[:, np.isfinite(error)], enough), _PARTS)
        self._module = compiled(self.source.text) if is_compiled else None

    def _lowered(
        self,
        lower: Callable[..., Lowering],
        corners: Sequence[TracedValue],
        designs: DesignTraces,
        grid: Grid,
        before: Callable[..., Kernel] | None,
    ) -> tuple[Lowering, dict[str, KernelValue]]:
        """Return a lowering and the outputs, after calculations of what must be known before; `before`: makes them."""
        reduced: dict[int, TracedValue] = {}
        while True:
            lowering = lower(beforehand=self._inputs_of)
            outputs = compiled_values(lambda key: _of_cycle(self._wanted[key], lowering), self._wanted)  # noqa: B023
            if before is not None and self._before is None and not reduced:
                # panels are laid before any value is reduced, and an end may follow from an extreme
                reduced = lowering.reduced_before_ends()
            if not reduced or self._before is not None:
                break
            first = self.fields + len(corners)
            self._inputs_of |= {node: index for index, node in enumerate(reduced, start=first)}
            self._before = before(*_traces_of(designs, reduced.values())) if before else None
        if corners and self._corners is None:
            self._corners = Crossings(designs, corners, lower(beforehand=self._inputs_of), grid, len(self._inputs_of))
        return lowering, outputs

    def _carry_out(self, grid: Grid, *, is_compiled: bool, steps: int | None, parts: int) -> None:
        """Write the schedule out, and set what carries it out with arrays."""
        is_running = all(value.detail in ACCUMULATED for level in self.plan.levels for value in level.reductions)
        self.source = Source(self.plan, is_reduced=is_compiled and steps is not None and is_running)
        earlier = [grid.earlier(delay) for delay in self.source.delays.of]
        places = np.array(earlier, dtype=np.intp).reshape(len(earlier), grid.degrees.size)
        # unsigned, so that no index counts from the end
        below = (indices.astype(np.uintp) for indices in (places, self.source.order))
        self._given = self.plan.table, *below, grid.weights, grid.degrees
        self._module, self._arrays = None, Arrays(self.source, places)
        self._exact = None if steps else PolynomialReductions(grid, _POLYNOMIALS)
        self._reduced = LevelReductions(self.source, self._exact or SampledReductions(grid), parts)

    def __call__(self, designs: Array) -> BatchResult:
        """Return the single values of designs, shape (fields, n). [SI]"""
        designs = np.ascontiguousarray(designs, dtype=float)
        result = BatchResult(np.empty((len(self.keys), designs.shape[1])), np.zeros(designs.shape[1]))
        self.run(designs, result, 0, designs.shape[1])
        return result

    def run(self, designs: Array, result: BatchResult, first: int, last: int) -> None:
        """Store the single values of designs `first` to `last` in a result; threads may do so at the same time."""
        for start in range(first, last, _BATCH_SIZE):
            batch, error = self._inputs(designs[:, start : min(start + _BATCH_SIZE, last)])
            given = np.empty((self.source.given, batch.shape[1]))
            given[: len(batch)] = batch
            self._arrays.designs(0, given)
            if self.source.is_reduced and self._module is not None:
                self._module.run(given, result.values, result.truncation_error, *self._given, start)
            else:
                self._run(given, result, start)
            of_batch = result.truncation_error[start : start + batch.shape[1]]
            np.maximum(of_batch, error, out=of_batch)

    def _inputs(self, designs: Array) -> tuple[Array, Array]:
        """Return fields of designs and what is calculated beforehand, shape (inputs, n), and its truncation error."""
        if self._before is None and self._corners is None:
            return designs, np.zeros(designs.shape[1])
        empty = BatchResult(np.empty((0, designs.shape[1])), np.zeros(designs.shape[1]))
        before = empty if self._before is None else self._before(designs)
        corners = empty if self._corners is None else self._corners(designs, before.values)
        error = np.maximum(before.truncation_error, corners.truncation_error)
        return np.concatenate([designs, corners.values, before.values]), error

    def slopes(self, design: Array) -> tuple[Array, Array]:
        """Return single values of a design, shape (keys,), and their derivatives by its fields, (keys, fields). [SI]"""
        procedures = (value.detail.startswith("procedure") for level in self.plan.levels for value in level.reductions)
        if self._corners is not None or any(procedures):
            raise NotCompiledError("procedure", self.keys[0])
        store, blocks, _ = self._blocks(design[:, None])
        edges = np.full(self.plan.grid.edges.size, -1) if self._edges is None else self._edges.ends
        adjoints = [None if block is None else ReductionAdjoint(block, self.plan.grid, edges) for block in blocks]
        values = [self._of_output(value, store[:, 0]) for key, value in self.plan.outputs.items() if key]
        slopes = self._gradient(store, adjoints)
        if self._before is not None:
            slopes = slopes[:, : self.fields] + slopes[:, self.fields :] @ self._before.slopes(design)[1]
        return np.array(values), slopes

    def _blocks(self, designs: Array) -> tuple[Array, list[Block | None], Array]:
        """Return the store of a few designs, the reductions of the levels, and the error of what is known before."""
        store, columns = self._stores(designs.shape[1])
        inputs, error = self._inputs(designs)
        store[: len(inputs)] = inputs
        self._arrays.designs(0, store)
        return store, self._levels(store, columns, designs.shape[1])[1], error

    def _coarse_panels(self, designs: Array, enough: float) -> NDArray[np.bool_]:
        """Return in which panels a column of one of these designs has a larger truncation error."""
        blocks = self._blocks(designs)[1]
        return np.asarray(np.any([block.coarse_panels(enough) for block in blocks if block is not None], axis=0))

    def truncation_error_of(self, designs: Array) -> Array:
        """Return the truncation error of the columns that each single value depends on, shape (keys, n)."""
        _, blocks, before = self._blocks(designs)
        errors = dict[int, Array]()
        for value in values_in_order(self.plan.outputs.values()):
            error = np.max([before, *(errors[operand.index] for operand in value.operands)], axis=0)
            if (
                value.kind == "reduction"
                and value.detail != "column"
                and (block := blocks[value.level - 1]) is not None
            ):
                error = np.maximum(error, block.truncation_error_of(value))
            errors[value.index] = error
        return np.array([errors[value.index] for key, value in self.plan.outputs.items() if key])

    @cached_property
    def _gradient(self) -> Gradient:
        return Gradient(self.source)

    def _stores(self, lanes: int) -> tuple[Array, Array]:
        """Return empty stores for a block of designs, and for their columns."""
        angles = self.plan.grid.degrees.size
        return np.empty((len(self.source.rows.of), lanes)), np.empty((len(self.source.columns.of), angles, lanes))

    def _run(self, given: Array, result: BatchResult, first: int) -> None:
        last = first + given.shape[1]
        lanes = LANES if self._module is not None else min(LANES, last - first)
        store, columns = self._stores(lanes)
        for start in range(first, last, lanes):
            end = min(start + lanes, last)
            store[: len(given)] = given[:, np.minimum(np.arange(start, start + lanes), last - 1) - first]
            error = self._levels(store, columns, end - start)[0]
            for row, (key, value) in enumerate(self.plan.outputs.items()):
                output = self._of_output(value, store)
                if key:
                    result.values[row, start:end] = output[: end - start] if isinstance(output, np.ndarray) else output
                else:
                    error = np.maximum(error, output)
            result.truncation_error[start:end] = error[: end - start]

    def _of_output(self, value: KernelValue, store: Array) -> Any:  # noqa: ANN401 - a number, or an array of designs
        return number(value) if value.is_constant else store[self.source.rows(self.source.place(value))]

    def _levels(self, store: Array, columns: Array, count: int) -> tuple[Array, list[Block | None]]:
        """Calculate the levels of so many designs; return their truncation error, and their reductions."""
        error, reductions, blocks = np.zeros(store.shape[1]), self._exact, []
        module = self._module if store.shape[1] == LANES else None
        for index, level in enumerate(self.plan.levels):
            if index and module is not None:
                getattr(module, f"designs_{index}")(store.reshape(-1), columns, *self._given)
            elif index:
                self._arrays.designs(index, store)
            elif self._edges is not None and self._exact is not None:
                reductions, error = self._moved(self._edges, self._exact, store, columns)
            if module is not None:
                getattr(module, f"level_{index}")(store.reshape(-1), columns, *self._given)
            else:
                self._arrays.level(index, store, columns)
            block = self._reduced(level, store, columns, reductions, count)
            error = error if block is None else np.maximum(error, block.truncation_error)
            blocks.append(block)
        return error, blocks

    def _moved(
        self, edges: Edges, exact: PolynomialReductions, store: Array, columns: Array
    ) -> tuple[PolynomialReductions, Array]:
        """Store functions of the crank angle at the panels of each design; return its reductions.

        And the truncation error, which is infinite for a design whose laws have another order.
        """
        plan, source = self.plan, self.source
        ends = edges.at(np.stack([store[source.rows(source.place(end))] for end in plan.ends]))
        moves = plan.grid.moves
        degrees, weights = nodes_between(ends, _POLYNOMIALS)
        middles = np.broadcast_to(plan.grid.middles[moves, None, None], degrees[moves].shape)
        angles = np.flatnonzero(moves[plan.grid.panel])
        leaves = [value.detail for value in plan.moved.values()]
        values = plan.at(leaves, degrees[moves].ravel(), middles.ravel())
        for column, leaf in zip(plan.moved, leaves, strict=True):
            columns[source.columns(column), angles] = values[leaf.index].reshape(angles.size, -1)
        is_other = np.any(np.diff(ends, axis=0) < 0, axis=0)
        lanes = store.shape[1]
        moved = exact.moved_to(ends, degrees.reshape(-1, lanes), weights.reshape(-1, lanes))
        return moved, np.where(is_other, np.inf, 0.0)

    def script(self) -> Script:
        """Return the schedule as JavaScript."""
        return Script(self.source, _POLYNOMIALS)


class Crossings:
    """Crank angles at which columns pass zero, of many designs at once by the secant method. [deg]

    `lowering`: of a calculation in which these angles are the inputs after the fields; `more`: number of such inputs
    and further ones.
    """

    def __init__(
        self, designs: DesignTraces, places: Sequence[TracedValue], lowering: Lowering, grid: Grid, more: int
    ) -> None:
        self._fields = designs.fields
        self._stated = np.array([[node.value for node in designs.counterparts(place.node)] for place in places]).T
        first = self._fields.shape[1]
        columns = {str(k): lowering.at_input(place, first + k) for k, place in enumerate(places)}
        self._plan = Schedule(columns, grid, first + more, lowering.angles_at, shares=False)
        self._source = Source(self._plan, is_reduced=False)
        self._arrays = Arrays(self._source, np.zeros((0, 0), dtype=np.intp))

    def __call__(self, designs: Array, more: Array) -> BatchResult:
        """Return the angles of designs, shape (places, n), with an infinite error where one is not found."""
        store = np.empty((len(self._source.rows.of), designs.shape[1]))
        count, angles = len(designs), self._start(designs)
        store[: len(designs)], store[count + len(angles) : count + len(angles) + len(more)] = designs, more
        step, values = np.full(angles.shape, _FIRST_STEP), self._values(store, angles)
        for _ in range(_MAX_SECANTS):
            angles = angles + step
            new = self._values(store, angles)
            with np.errstate(all="ignore"):
                step = np.where(new == values, 0.0, new * step / (values - new))
            values = new
            if not np.any(np.abs(step) > _PLACED):
                break
        is_found = np.all(np.abs(step) <= _NEARLY_PLACED, axis=0)
        return BatchResult(np.where(is_found, angles, self._stated[0][:, None]), np.where(is_found, 0.0, np.inf))

    def _start(self, designs: Array) -> Array:
        """Return angles by straight lines through those of the designs compared."""
        rises, widths = (values[2:][::2][: len(designs)] - values[1:][::2][: len(designs)] for values in
                         (self._stated, self._fields))  # fmt: skip
        slopes = rises.T / np.diag(widths)
        return np.asarray(self._stated[0][:, None] + slopes @ (designs - self._fields[0][:, None]))

    def _values(self, store: Array, angles: Array) -> Array:
        first = self._fields.shape[1]
        store[first : first + len(angles)] = angles
        self._arrays.designs(0, store)
        return store[[self._source.rows(self._source.place(value)) for value in self._plan.outputs.values()]]


def _corners(traced: Iterable[TracedValue]) -> list[TracedValue]:
    """Return the places at which unknowns that values depend on have corners."""
    roots = [known.node for known in traced if isinstance(known.node, Root)]
    places = [(column, place) for root in roots for column, ends in root.sides for place in ends]
    return [place for column, place in places if place.node.operands[0] is column]


def _traces_of(
    designs: DesignTraces, wanted: Iterable[TracedValue]
) -> tuple[list[dict[str, TracedValue]], Array, list[str]]:
    """Return traces that have these values of each design, with the fields and the keys."""
    nodes = {f"reduced.{index}": designs.counterparts(known.node) for index, known in enumerate(wanted)}
    traces = [
        {key: TracedValue(of_design[index], key) for key, of_design in nodes.items()}
        for index in range(len(designs.traces))
    ]
    return traces, designs.fields, list(nodes)


def _of_cycle(known: TracedValue, lowering: Lowering) -> KernelValue:
    """Return a single value, or the reduction that stores a column."""
    value = lowering.value(known)
    return value.graph.reduction("column", value) if known.varies else value


def _dependencies(node: Node) -> Sequence[TracedValue]:
    return (
        (node.general_form,)
        if isinstance(node, ProcedureValue | FormulaCall) and node.general_form is not None
        else node.operands
    )


def _reduced(traced: Iterable[TracedValue]) -> list[TracedValue]:
    """Return the columns that single values are reduced from, and those that are stored."""
    traced = list(traced)
    nodes = [known.node for known in in_order(traced, into=_dependencies)]
    reduced = [node for node in nodes if isinstance(node, ProcedureValue) and node.general_form is None]
    columns = [operand for node in reduced for operand in node.operands if operand.varies]
    return [*columns, *(known for known in traced if known.varies)]


def _grid(
    breaks: Sequence[Array], delays: Sequence[float], width: float, steps: int | None
) -> tuple[Grid, Edges | None]:
    """Return the crank angles of the stated design, and the edges of their panels in all compared designs."""
    if steps:
        return uniform_grid(breaks[0], steps), None
    all_breaks = [with_delayed_breakpoints(of_design, delays, _MAX_BREAKPOINTS) for of_design in breaks]
    edges = subdivide(all_breaks, width)
    return _grid_between(edges), edges


def _following(edges: Edges, lowering: Lowering, key: str) -> Edges:
    """Return edges that follow the ends of laws."""
    is_reduced = any(end.level > 0 for end, _ in lowering.moving)
    following = None if is_reduced else edges.following(lowering.moving)
    if following is None:
        raise NotCompiledError("ends", key)
    return following


def _grid_between(edges: Edges) -> Grid:
    return lobatto_grid(edges.in_stated, np.zeros(edges.share.size, dtype=bool), _POLYNOMIALS)


def compiles() -> bool:
    """Return whether Numba is installed."""
    return importlib.util.find_spec("numba") is not None


def compiled(text: str) -> ModuleType:
    """Return the module of a kernel's source, compiled once for this machine, because Numba caches modules in files."""
    from crankwork.kernel import elementary  # noqa: PLC0415 - Numba is an optional part

    name = f"kernel_{hashlib.sha256((inspect.getsource(elementary) + text).encode()).hexdigest()[:24]}"
    path = files.cached_file(f"kernels/{name}.py", text)
    if path is None:
        # not cached
        module = ModuleType(name)
        exec(compile(text, name, "exec"), vars(module))  # noqa: S102 - written above
        return module
    spec = importlib.util.spec_from_file_location(f"crankwork_{name}", path)
    assert spec is not None and spec.loader is not None  # noqa: S101, PT018 - the file exists
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


class Arrays:
    """Carries out a schedule level by level in the stores of its source.

    `places`: indices of angles earlier by each delay.
    """

    def __init__(self, source: Source, places: NDArray[np.intp]) -> None:
        self._source, self._places = source, places
        self._table = source.plan.table

    def designs(self, index: int, store: Array) -> None:
        """Calculate the design values of a level after lower levels; `store`: of designs, shape (rows, lanes)."""
        level, source = self._source.plan.levels[index], self._source
        with np.errstate(all="ignore"):
            results: dict[int, Any] = {}
            for value in level.designs:
                if value.kind == "input":
                    continue
                results[value.index] = self._result(value, results, store, None)
                if value.index in source.used:
                    store[source.rows(value.index)] = results[value.index]

    def level(self, index: int, store: Array, columns: Array) -> None:
        """Calculate the columns of a level; `columns`: shape (columns, angles, lanes)."""
        level, source = self._source.plan.levels[index], self._source
        with np.errstate(all="ignore"):
            for loop in level.loops:
                results: dict[int, Any] = {}
                for value, unused in zip(loop.values, loop.unused, strict=True):
                    if value.kind == "delayed":
                        row, delay = source.columns(value.operands[0].index), source.delays(value.detail)
                        results[value.index] = columns[row, self._places[delay, loop.angles]]
                    elif value.kind == "moved":
                        results[value.index] = columns[source.columns(value.detail.index), loop.angles]
                    else:
                        results[value.index] = self._result(value, results, store, loop.angles)
                    for last in unused:
                        del results[last]
                for column, value in zip(level.columns, loop.columns, strict=True):
                    columns[source.columns(column.index), loop.angles] = self._read(value, results, store, loop.angles)

    def _result(self, value: KernelValue, results: dict[int, Any], store: Array, angles: Any) -> Any:  # noqa: ANN401
        return COMPUTE[value.kind](*(self._read(operand, results, store, angles) for operand in value.operands))

    def _read(self, value: KernelValue, results: dict[int, Any], store: Array, angles: Any) -> Any:  # noqa: ANN401
        if value.is_constant:
            return number(value)
        if value.index in results:
            return results[value.index]
        if value.depends_on_angle:
            return self._table[self._source.plan.row_of_angle[value.index], angles][:, None]
        return store[self._source.rows(self._source.place(value))]
