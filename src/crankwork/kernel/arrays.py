"""A plan carried out with arrays, where nothing compiles loops."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import COMPUTE, Value, number
from crankwork.kernel.source import Source

Array = NDArray[np.float64]


class Arrays:
    """A plan carried out level by level, in the stores of its source; `places`: of angles earlier by each delay."""

    def __init__(self, source: Source, places: NDArray[np.intp]) -> None:
        self._source, self._places = source, places
        self._table = source.plan.table

    def designs(self, at: int, store: Array) -> None:
        """Calculate what of designs is possible when lower levels are; `store`: of designs, shape (rows, lanes)."""
        level, source = self._source.plan.levels[at], self._source
        with np.errstate(all="ignore"):
            of_design: dict[int, Any] = {}
            for one in level.designs:
                if one.kind == "input":
                    continue
                of_design[one.at] = self._made(one, of_design, store, None)
                if one.at in source.used:
                    store[source.rows(one.at)] = of_design[one.at]

    def level(self, at: int, store: Array, kept: Array) -> None:
        """Calculate columns of a level; `kept`: columns, shape (columns, angles, lanes)."""
        level, source = self._source.plan.levels[at], self._source
        with np.errstate(all="ignore"):
            for loop in level.loops:
                made: dict[int, Any] = {}
                for one in loop.values:
                    if one.kind == "delayed":
                        row, delay = source.columns(one.operands[0].at), source.delays(one.detail)
                        made[one.at] = kept[row, self._places[delay, loop.angles]]
                    elif one.kind == "moved":
                        made[one.at] = kept[source.columns(one.detail.at), loop.angles]
                    else:
                        made[one.at] = self._made(one, made, store, loop.angles)
                for column, value in zip(level.columns, loop.columns, strict=True):
                    kept[source.columns(column.at), loop.angles] = self._taken(value, made, store, loop.angles)

    def _made(self, one: Value, made: dict[int, Any], store: Array, angles: Any) -> Any:  # noqa: ANN401
        return COMPUTE[one.kind](*(self._taken(other, made, store, angles) for other in one.operands))

    def _taken(self, one: Value, made: dict[int, Any], store: Array, angles: Any) -> Any:  # noqa: ANN401
        if one.is_constant:
            return number(one)
        if one.at in made:
            return made[one.at]
        if one.by_angle:
            return self._table[self._source.plan.row_of_angle[one.at], angles][:, None]
        return store[self._source.rows(self._source.place(one))]
