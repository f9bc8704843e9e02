"""Carries out a schedule with arrays if loops are not compiled."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import COMPUTE, KernelValue, number
from crankwork.kernel.source import Source

Array = NDArray[np.float64]


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
                for value in loop.values:
                    if value.kind == "delayed":
                        row, delay = source.columns(value.operands[0].index), source.delays(value.detail)
                        results[value.index] = columns[row, self._places[delay, loop.angles]]
                    elif value.kind == "moved":
                        results[value.index] = columns[source.columns(value.detail.index), loop.angles]
                    else:
                        results[value.index] = self._result(value, results, store, loop.angles)
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
