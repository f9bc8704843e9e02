"""Mappings of which a part is computed when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TypeVar

V = TypeVar("V")


class Deferred(Mapping[str, V]):
    """A mapping whose further entries are computed when a key that is not among the first ones is asked for."""

    def __init__(self, first: Mapping[str, V], further: Callable[[], Mapping[str, V]]) -> None:
        self._first, self._further = first, further

    @cached_property
    def _all(self) -> Mapping[str, V]:
        return {**self._first, **{key: value for key, value in self._further().items() if key not in self._first}}

    def __reduce__(self) -> tuple[type[Deferred[V]], tuple[Mapping[str, V], type[dict[str, V]]]]:
        # a deferred calculation cannot be sent to another process
        return Deferred, (self._all, dict)

    def __getitem__(self, key: str) -> V:
        """Return an entry."""
        return self._first[key] if key in self._first else self._all[key]

    def __contains__(self, key: object) -> bool:
        return key in self._first or key in self._all

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)
