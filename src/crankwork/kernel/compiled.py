"""A calculation compiled: many designs in, single values of each out."""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork import files
from crankwork.formula.known import Delayed, Found, Known, Node, Procedure, Use, breaks_of, in_order
from crankwork.kernel.arrays import Arrays
from crankwork.kernel.gradient import Gradient
from crankwork.kernel.graph import Value, number
from crankwork.kernel.graph import in_order as values_in_order
from crankwork.kernel.grid import Edges, Grid, between, closed, divided, even, lobatto, nodes_between
from crankwork.kernel.plan import Plan
from crankwork.kernel.reduced import Block, Reduced
from crankwork.kernel.reductions import Even, Exact
from crankwork.kernel.script import Script
from crankwork.kernel.slopes import Taking, apart, in_part
from crankwork.kernel.source import LANES, RUNNING, Source
from crankwork.kernel.trace import Designs, NotCompiledError, Trace

Array = NDArray[np.float64]


# widths of panels that are tried, and what polynomials may leave out of a column to be taken for it
_WIDTHS = (30.0, 15.0, 7.5, 3.75)
CONVERGED = 1e-12
# breaks of laws and of those of other cylinders that a grid may have
_MOST_BREAKS = 400
_POLYNOMIALS = lobatto(16)
# designs of which that is done together which does not depend on the crank angle
_TOGETHER = 2048


class Bulk(NamedTuple):
    """Single values of designs, shape (keys, n) [SI], and what polynomials left out of columns, shape (n,)."""

    values: Array
    left_out: Array


class Kernel:
    """Single values of many designs, calculated by the operations that one analysis remembers.

    `memories` are that of the stated design, then two for each field, of a smaller and a larger value of it alone, and
    others; `fields` what the fields are in each, shape (memories, fields) [SI]. With `steps` so many evenly spaced
    crank angles are looked at; otherwise extremes and integrals are those of polynomials between the breaks of laws, as
    in an analysis. With `parts` largest and least values in so many parts of the cycle are found too; `is_for_few`:
    carried out with arrays, where compiling takes longer than the few designs that are asked for. Columns among the
    keys are kept, at `rows` too [deg], for what carries the plan out elsewhere. `enough`: what polynomials may
    leave out. `NotCompiledError` says why a calculation cannot be compiled.
    """

    def __init__(  # noqa: PLR0913 - designs, what is wanted of them, and where it is looked at
        self,
        memories: Sequence[Mapping[str, Known]],
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
        designs = Designs(memories, fields, keys)
        self.fields = fields.shape[1]
        wanted = {key: memories[0][key] for key in keys}
        every = list(in_order(wanted.values(), into=_told))
        if steps and any(isinstance(one.node, Procedure) for one in every):
            raise NotCompiledError("procedure", next(iter(keys)))
        delays = sorted({one.node.by for one in every if isinstance(one.node, Delayed)})
        breaks = [breaks_of(_reduced([one[key] for key in keys]), cycle, start) for one in memories]
        is_compiled = compiles() and not is_for_few
        widths = [one for one in _WIDTHS if one * parts <= cycle] or _WIDTHS[-1:]
        for width in (cycle,) if steps else widths:
            grid, edges = _grid(breaks, delays, width, steps)
            grid = grid if rows is None else grid.with_rows(rows)
            trace = Trace(designs, angles_at, grid.degrees, is_shifted=any(grid.earlier(one) is None for one in delays))
            outputs = {key: _of_cycle(one, trace.value(one)) for key, one in wanted.items()}
            if trace.moving and steps:
                grid = even(trace.zones(breaks[0]), steps)
            elif trace.moving and edges is not None:
                edges = edges.following(trace.moving)
                if edges is None:
                    raise NotCompiledError("ends", keys[0])
                grid = grid._replace(moves=edges.moves)
            self._edges = edges if trace.moving else None
            if parts:
                outputs |= {in_part(key, at): of for key in keys for at, of in enumerate(apart(outputs[key], parts))}
            guard = trace.guard(is_sampled=steps is not None)
            ends = [one for one, _ in trace.moving]
            guarded = outputs | ({} if guard is None else {"": guard})
            self.plan = Plan(guarded, grid, self.fields, angles_at, () if steps else ends, shares=is_compiled)
            is_running = all(one.detail in RUNNING for level in self.plan.levels for one in level.reductions)
            self.source = Source(self.plan, is_reduced=is_compiled and steps is not None and is_running)
            earlier = [grid.earlier(by) for by in self.source.delays.of]
            places = np.array(earlier, dtype=np.intp).reshape(len(earlier), grid.degrees.size)
            # without signs, so that no place is looked at from the end
            below = (one.astype(np.uintp) for one in (places, self.source.order))
            self._given = self.plan.table, *below, grid.weights, grid.degrees
            self._module, self._arrays = None, Arrays(self.source, places)
            self._exact = None if steps else Exact(grid, _POLYNOMIALS)
            self._reduced = Reduced(self.source, self._exact or Even(grid), parts)
            self.keys = tuple(outputs)
            # looked at with arrays, so that only what is taken is compiled
            if steps or float(np.max(self(fields.T).left_out)) <= enough:
                break
        self._module = compiled(self.source.text) if is_compiled else None

    def __call__(self, designs: Array) -> Bulk:
        """Return the single values of designs, shape (fields, n). [SI]"""
        designs = np.ascontiguousarray(designs, dtype=float)
        found = Bulk(np.empty((len(self.keys), designs.shape[1])), np.zeros(designs.shape[1]))
        self.run(designs, found, 0, designs.shape[1])
        return found

    def run(self, designs: Array, found: Bulk, first: int, last: int) -> None:
        """Put the single values of some designs where they belong; threads may do so at the same time."""
        for start in range(first, last, _TOGETHER):
            some = designs[:, start : min(start + _TOGETHER, last)]
            given = np.empty((self.source.given, some.shape[1]))
            given[: len(some)] = some
            self._arrays.designs(0, given)
            if self.source.is_reduced and self._module is not None:
                self._module.run(given, found.values, found.left_out, *self._given, start)
            else:
                self._run(given, found, start)

    def slopes(self, design: Array) -> tuple[Array, Array]:
        """Return single values of a design, shape (keys,), and their derivatives by its fields, (keys, fields). [SI]"""
        if any(one.detail.startswith("procedure") for level in self.plan.levels for one in level.reductions):
            raise NotCompiledError("procedure", self.keys[0])
        store, kept = self._stores(1)
        store[: self.fields] = design[:, None]
        self._arrays.designs(0, store)
        blocks = self._levels(store, kept, 1)[1]
        edges = np.full(self.plan.grid.edges.size, -1) if self._edges is None else self._edges.ends
        taking = [None if one is None else Taking(one, self.plan.grid, edges) for one in blocks]
        values = [self._of_output(one, store[:, 0]) for key, one in self.plan.outputs.items() if key]
        return np.array(values), self._gradient(store, taking)

    def left_out_of(self, designs: Array) -> Array:
        """Return what polynomials leave out of the columns that each single value follows from, shape (keys, n)."""
        count = designs.shape[1]
        store, kept = self._stores(count)
        store[: self.fields] = designs
        self._arrays.designs(0, store)
        blocks = self._levels(store, kept, count)[1]
        left = dict[int, Array]()
        for one in values_in_order(self.plan.outputs.values()):
            own = np.max([np.zeros(count), *(left[of.at] for of in one.operands)], axis=0)
            if one.kind == "reduction" and one.detail != "column" and (block := blocks[one.level - 1]) is not None:
                own = np.maximum(own, block.left_out_of(one))
            left[one.at] = own
        return np.array([left[one.at] for key, one in self.plan.outputs.items() if key])

    @cached_property
    def _gradient(self) -> Gradient:
        return Gradient(self.source)

    def _stores(self, lanes: int) -> tuple[Array, Array]:
        """Return the stores of a block of designs, and of their columns."""
        angles = self.plan.grid.degrees.size
        return np.empty((len(self.source.rows.of), lanes)), np.empty((len(self.source.columns.of), angles, lanes))

    def _run(self, given: Array, found: Bulk, first: int) -> None:
        last = first + given.shape[1]
        lanes = LANES if self._module is not None else min(LANES, last - first)
        store, kept = self._stores(lanes)
        for start in range(first, last, lanes):
            end = min(start + lanes, last)
            store[: len(given)] = given[:, np.minimum(np.arange(start, start + lanes), last - 1) - first]
            left_out = self._levels(store, kept, end - start)[0]
            for row, (key, value) in enumerate(self.plan.outputs.items()):
                of = self._of_output(value, store)
                if key:
                    found.values[row, start:end] = of[: end - start] if isinstance(of, np.ndarray) else of
                else:
                    left_out = np.maximum(left_out, of)
            found.left_out[start:end] = left_out[: end - start]

    def _of_output(self, value: Value, store: Array) -> Any:  # noqa: ANN401 - of a design a number, of many an array
        return number(value) if value.is_constant else store[self.source.rows(self.source.place(value))]

    def _levels(self, store: Array, kept: Array, count: int) -> tuple[Array, list[Block | None]]:
        """Calculate the levels of so many designs; return what is left out of them, and their reductions."""
        left_out, reductions, blocks = np.zeros(store.shape[1]), self._exact, []
        module = self._module if store.shape[1] == LANES else None
        for at, level in enumerate(self.plan.levels):
            if at and module is not None:
                getattr(module, f"designs_{at}")(store.reshape(-1), kept, *self._given)
            elif at:
                self._arrays.designs(at, store)
            elif self._edges is not None and self._exact is not None:
                reductions, left_out = self._moved(self._edges, self._exact, store, kept)
            if module is not None:
                getattr(module, f"level_{at}")(store.reshape(-1), kept, *self._given)
            else:
                self._arrays.level(at, store, kept)
            block = self._reduced(level, store, kept, reductions, count)
            left_out = left_out if block is None else np.maximum(left_out, block.left_out)
            blocks.append(block)
        return left_out, blocks

    def _moved(self, edges: Edges, exact: Exact, store: Array, kept: Array) -> tuple[Exact, Array]:
        """Put what depends on the crank angle where panels lie in each design; return reductions over them.

        And what is left out: all of a design in which laws follow one another in another order.
        """
        plan, source = self.plan, self.source
        ends = edges.at(np.stack([store[source.rows(source.place(one))] for one in plan.ends]))
        moves = plan.grid.moves
        degrees, weights = nodes_between(ends, _POLYNOMIALS)
        middles = np.broadcast_to(plan.grid.middles[moves, None, None], degrees[moves].shape)
        angles = np.flatnonzero(moves[plan.grid.panel])
        leaves = [one.detail for one in plan.moved.values()]
        found = plan.at(leaves, degrees[moves].ravel(), middles.ravel())
        for at, one in zip(plan.moved, leaves, strict=True):
            kept[source.columns(at), angles] = found[one.at].reshape(angles.size, -1)
        is_other = np.any(np.diff(ends, axis=0) < 0, axis=0)
        lanes = store.shape[1]
        moved = exact.moved_to(ends, degrees.reshape(-1, lanes), weights.reshape(-1, lanes))
        return moved, np.where(is_other, np.inf, 0.0)

    def script(self) -> Script:
        """Return the plan in the language of browsers."""
        return Script(self.source, _POLYNOMIALS)


def _of_cycle(known: Known, value: Value) -> Value:
    """Return a value of the whole cycle: of a column that it is kept."""
    return value.graph.reduction("column", value) if known.varies else value


def _told(node: Node) -> Sequence[Known]:
    return (node.retold,) if isinstance(node, Found | Use) and node.retold is not None else node.operands


def _reduced(knowns: Iterable[Known]) -> list[Known]:
    """Return the columns that single values are found of, and those that are kept."""
    knowns = list(knowns)
    nodes = [one.node for one in in_order(knowns, into=_told)]
    found = [of for node in nodes if isinstance(node, Found) for of in node.operands if of.varies]
    return [*found, *(one for one in knowns if one.varies)]


def _grid(
    breaks: Sequence[Array], delays: Sequence[float], width: float, steps: int | None
) -> tuple[Grid, Edges | None]:
    """Return the crank angles of the stated design, and what their panels lie between in all that are compared."""
    if steps:
        return even(breaks[0], steps), None
    every = [closed(one, delays, _MOST_BREAKS) for one in breaks]
    edges, parts = divided(every[0], width)
    grid = between(edges, np.zeros(edges.size - 1, dtype=bool), _POLYNOMIALS)
    return grid, Edges(every, parts)


def compiles() -> bool:
    """Return whether Numba is there."""
    return importlib.util.find_spec("numba") is not None


def compiled(text: str) -> ModuleType:
    """Return the module of a kernel's source, compiled once for this machine: Numba keeps what stands in a file."""
    from crankwork.kernel import elementary  # noqa: PLC0415 - Numba is an optional part

    name = f"kernel_{hashlib.sha256((inspect.getsource(elementary) + text).encode()).hexdigest()[:24]}"
    path = files.kept(f"kernels/{name}.py", text)
    if path is None:
        # from memory, for this run
        module = ModuleType(name)
        exec(compile(text, name, "exec"), vars(module))  # noqa: S102 - written above
        return module
    spec = importlib.util.spec_from_file_location(f"crankwork_{name}", path)
    assert spec is not None and spec.loader is not None  # noqa: S101, PT018 - of a file that is there
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module
