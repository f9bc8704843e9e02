"""Results of an analysis: columns over the crank angle, single values, checks and notices."""

from __future__ import annotations

import difflib
import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from crankwork.errors import CrankworkError, RenamedKeyWarning, UnknownKeyError
from crankwork.formula.calculation_lines import Snapshot
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.method import Method
from crankwork.preparation.prepared import Notice
from crankwork.quantities import QUANTITIES, base_key, derived_unit
from crankwork.quantities.key import MOVED, RENAMED, key_of
from crankwork.registered import RegisteredMethod
from crankwork.units import coherent_unit

if TYPE_CHECKING:
    from crankwork.analysis.assumptions import Assumption, IdleInput
    from crankwork.analysis.compare import Comparison
    from crankwork.machine import Machine

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


# a residual above this is more than rounding
_ROUNDING = 1e-7
# largest distance of a row of a table from its stated angle [deg]
_SAME_ANGLE = 1e-9


class Listing(NamedTuple):
    """A table that does not run over the crank angle: orders, rays, cylinders, bearings."""

    # Columns by key of `quantities.QUANTITIES`, the first of which identifies each row, shape (n,) [SI]
    columns: Mapping[str, Array]
    # Names of the rows, such as `crankpin.1`; empty if the first column identifies the rows
    names: tuple[str, ...] = ()

    def with_rows_of(self, other: Listing) -> Listing:
        """Return this table with further rows and columns of another; rows of the same name are joined."""
        if not self.names:
            return Listing({**other.columns, **self.columns})
        names = (*self.names, *(name for name in other.names if name not in self.names))
        columns = {key: np.full(len(names), np.nan) for key in (*self.columns, *other.columns)}
        for table in (other, self):
            rows = [names.index(name) for name in table.names]
            for key, values in table.columns.items():
                columns[key][rows] = values
        return Listing(columns, names)


@dataclass(frozen=True, eq=False, repr=False)
class Results(Mapping[str, Array | float]):
    """What a machine does over one cycle, in SI.

    A mapping of every key, of columns, single values and what lies between them, to its value.

    Parameters
    ----------
    solved : PreparedMachine
        The machine and the method that made the results.
    grid : CrankGrid, shape (n,)
        Crank angles of the columns. [rad]
    columns : mapping of str to array, shape (n,)
        Results by key of `quantities.QUANTITIES`, in the `si_unit` of its row; tables show its `unit`. [SI]
    summary : mapping of str to float
        Single values by key. [SI]
    checks : mapping of str to float
        Residuals of identities that must hold, relative. [-]
    notices : tuple of Notice
        What the reader should know.
    groups : mapping of str to tuple of str
        Keys of each table; those without a column are left out.
    listings : mapping of str to Listing
        Tables over something else than the crank angle, by name.
    allowed : mapping of str to float
        What a residual may be by the error that an approximate method states, by its key in `checks`; the others
        may be rounding. [-]
    trace : mapping of str to TracedValue
        How every column, every single value and what lies between them came about.
    compared : Comparison, optional
        Results that stand beside these, by `crankwork.compare`.
    in_other_form : callable, optional
        Returns the results of the same machine as a linkage of an engine, or as an engine of a linkage; None if it is
        none.
    """

    solved: Any
    grid: CrankGrid
    columns: Mapping[str, Array]
    summary: Mapping[str, float]
    checks: Mapping[str, float]
    notices: tuple[Notice, ...]
    groups: Mapping[str, tuple[str, ...]]
    listings: Mapping[str, Listing] = field(default_factory=dict)
    allowed: Mapping[str, float] = field(default_factory=dict)
    trace: Mapping[str, TracedValue] = field(default_factory=dict)
    compared: Comparison | None = None
    in_other_form: Callable[[], Results | None] | None = field(default=None, compare=False)
    # old keys that have been asked for
    _noticed: set[str] = field(default_factory=set, compare=False)

    @property
    def machine(self) -> Machine:
        """The machine."""
        machine: Machine = self.solved.machine
        return machine

    @property
    def method(self) -> Method:
        """The method that made the results."""
        method: Method = self.solved.method
        return method

    @property
    def memory(self) -> Mapping[str, TracedValue]:
        """The trace, under its name until the next release."""
        warnings.warn(
            RenamedKeyWarning(ErrorMessage("key_renamed", old="Results.memory", new="Results.trace")), stacklevel=2
        )
        return self.trace

    @property
    def period(self) -> float:
        """Period of the law that drives; zero where a crank turns at the angle of the tables. [s]"""
        return self.machine.mechanism.driver.law.period if self.machine.mechanism.driver.law else 0.0

    def degrees_of(self, at: float) -> float:
        """Return the angle of the tables, at a crank angle [deg], or at a time where a law drives. [s] -> [deg]"""
        return 360.0 * at / self.period if self.period else float(at)

    @property
    def unmet(self) -> tuple[str, ...]:
        """The keys of the checks that are not met."""
        met = {key: value <= max(_ROUNDING, self.allowed.get(key, 0.0)) for key, value in self.checks.items()}
        return tuple(key for key, value in met.items() if not value)

    @cached_property
    def assumptions(self) -> tuple[Assumption, ...]:
        """What the results assume that the description does not state, and what they leave out."""
        # not needed for results
        from crankwork.analysis.assumptions import assumptions  # noqa: PLC0415 - loaded where it is needed

        return assumptions(self)

    @cached_property
    def without_effect(self) -> tuple[IdleInput, ...]:
        """The inputs of the description that no result depends on, each with the reason."""
        from crankwork.analysis.assumptions import idle_inputs  # noqa: PLC0415 - loaded where it is needed

        return idle_inputs(self)

    @property
    def tables(self) -> Mapping[str, tuple[str, ...]]:
        """The keys of each table, crank angle first, or the time where a law drives."""
        first = "time" if "time" in self.columns else "crank_angle"
        present = {name: (first, *(key for key in keys if key in self.columns)) for name, keys in self.groups.items()}
        return {name: keys for name, keys in present.items() if len(keys) > 1}

    @cached_property
    def other(self) -> Results | None:
        """The results of the same machine in its other form: an engine as a linkage, or a linkage as an engine.

        They are computed when they are first asked for; None if there is no other form.
        """
        return None if self.in_other_form is None else self.in_other_form()

    @cached_property
    def complete(self) -> Results:
        """These results together with those of the other form."""
        other = self.other
        if other is None:
            return self
        groups = {
            name: tuple(dict.fromkeys((*keys, *other.groups.get(name, ()))))
            for name, keys in {**other.groups, **self.groups}.items()
        }
        codes = {notice.code for notice in self.notices}
        # in either file the rows of the engine come first
        first, second = (
            (self.listings, other.listings) if self.machine.linkage is None else (other.listings, self.listings)
        )
        listings = {
            name: table.with_rows_of(second[name]) if name in second else table
            for name, table in {**second, **first}.items()
        }
        return replace(
            self,
            columns={**other.columns, **self.columns},
            summary={**other.summary, **self.summary},
            checks={**other.checks, **self.checks},
            allowed={**other.allowed, **self.allowed},
            notices=(*self.notices, *(notice for notice in other.notices if notice.code not in codes)),
            groups=groups,
            listings=listings,
            trace={**other.trace, **self.trace},
            in_other_form=None,
        )

    def holding(self, key: str) -> Results:
        """Return the results, of this form of the machine or of the other one, that have a key; these if none has."""
        if self._has(key) or base_key(key) not in QUANTITIES or self.other is None:
            return self
        return self.other if self.other._has(key) else self  # noqa: SLF001 - of its own class

    def current(self, key: str) -> str:
        """Return the current key of a result; warn if the key was renamed, or was the key of another value."""
        renamed, engine = RENAMED.get(key, key), self.machine.engine
        notice, is_renamed = None, renamed != key and renamed in self
        if is_renamed:
            notice = ErrorMessage("key_renamed", old=key, new=renamed)
        elif key in MOVED and engine is not None and len(engine.layout.places) > 1:
            notice = ErrorMessage("key_moved", key=key, new=MOVED[key])
        if notice is not None and key not in self._noticed:
            self._noticed.update((key, renamed))
            warnings.warn(RenamedKeyWarning(notice), stacklevel=3)
        return renamed if is_renamed else key

    def _has(self, key: str) -> bool:
        return key in self.columns or key in self.summary or key in self.trace

    def columns_at(self, angles: CrankGrid | ArrayLike, keys: Iterable[str] | None = None) -> dict[str, Array]:
        """Return columns that are traced, at other crank angles.

        Parameters
        ----------
        angles : array, shape (m,), or CrankGrid
            Crank angles. [deg]
        keys : iterable of str, optional
            Which, those that nobody has named as a column among them; all columns otherwise.

        Returns
        -------
        dict of str to array, shape (m,)
            Columns by key. [SI]

        Raises
        ------
        CrankworkError
            If angles are no finite numbers.
        """
        if not isinstance(angles, CrankGrid) and not np.all(np.isfinite(np.asarray(angles, dtype=float))):
            raise CrankworkError(ErrorMessage("angles_finite"))
        grid = angles if isinstance(angles, CrankGrid) else CrankGrid.from_degrees(angles)
        if keys is not None and not RENAMED.keys().isdisjoint(keys := list(keys)):
            renamed = self.columns_at(grid, [self.current(key) for key in keys])
            return {key: renamed[RENAMED.get(key, key)] for key in keys if RENAMED.get(key, key) in renamed}
        if keys is not None and any(self.holding(key) is not self for key in keys):
            return self.complete.columns_at(grid, keys)
        wanted = [key for key in (self.columns if keys is None else keys) if key in self.trace]
        if not any(key.startswith("instant_centre_") for key in wanted):
            return Program({key: self.trace[key] for key in wanted})(grid)
        # engines do not load it
        from crankwork.kinematics.instant_centres import absent_where_still  # noqa: PLC0415

        rates = [key for key in self.trace if key.startswith(("link_angular_velocity.", "instant_centre_"))]
        values = absent_where_still(Program({key: self.trace[key] for key in {*wanted, *rates}})(grid))
        return {key: values[key] for key in wanted}

    def moment(self, at: float = 0.0, mark: str = "") -> Snapshot:
        """Return the lines of the trace at a crank angle.

        Parameters
        ----------
        at : float
            Crank angle. [deg]
        mark : str
            Whose lines they are, as `Snapshot` takes it.
        """
        return Snapshot(CrankGrid.from_degrees, at, mark)

    def __getitem__(self, key: str) -> Array | float:
        """Return a column, or a single value. [SI]"""
        key = self.current(key)
        if key in self.columns:
            return self.columns[key]
        if key in self.summary:
            return self.summary[key]
        if (holding := self.holding(key)) is not self:
            return holding[key]
        known = self.trace.get(key)
        return known.value if known is not None and not known.varies else self.column(key)

    def column(self, key: str) -> Array:
        """Return a column, or what lies between columns, at the crank angles of the table, shape (n,). [SI]

        Raises
        ------
        UnknownKeyError
            If there is no such key.
        """
        key = self.current(key)
        if (holding := self.holding(key)) is not self:
            return holding.column(key)
        if key in self.columns:
            return self.columns[key]
        if key not in self.trace:
            raise self._unknown(key, self)
        return np.asarray(Program({key: self.trace[key]})(self.grid)[key] + np.zeros(len(self.grid)))

    # identity: comparing arrays gives no single truth value
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __iter__(self) -> Iterator[str]:
        return iter({**self.columns, **self.summary, **self.trace})

    def __len__(self) -> int:
        return len({*self.columns, *self.summary, *self.trace})

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and self.holding(key := RENAMED.get(key, key))._has(key)  # noqa: SLF001 - own class

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def unit(self, key: str) -> str:
        """Return the SI unit of the value of a key, empty for a pure number."""
        if key not in self:
            raise self._unknown(key, self)
        return coherent_unit(derived_unit(key) or QUANTITIES[base_key(key)].unit)

    # what shows, writes or explains results is defined in packages above the analysis
    explain, figure, to_dataframe, to_xarray, write, _repr_html_ = (RegisteredMethod() for _ in range(6))
    __repr__ = RegisteredMethod()

    def value(self, key: str, at: float | None = None) -> float:
        """Return one value.

        Parameters
        ----------
        key : str
            Key of a column, of a single value, or of what lies between them.
        at : float, optional
            Crank angle, any within the cycle: columns are played again there, not interpolated; the time where a
            law drives. [deg] or [s]

        Returns
        -------
        float
            The value. [SI]

        Raises
        ------
        UnknownKeyError
            If there is no such key.
        CrankworkError
            If the value varies with the crank angle and none is named, or there is no value at that angle.

        Examples
        --------
        >>> import crankwork
        >>> results = crankwork.analyse(crankwork.read_machine(crankwork.template("engine")))
        >>> results.value("stroke"), round(results.value("crank_torque", at=390.5), 3)
        (0.09, 340.192)
        """
        key = self.current(key)
        if (holding := self.holding(key)) is not self:
            return holding.value(key, at)
        known = self.trace.get(key)
        if key in self.summary or (known is not None and not known.varies):
            return float(self.summary[key]) if known is None else known.value
        if known is None and key not in self.columns:
            raise self._unknown(key, self)
        return self._column_at(key, known, self._within(key, at))

    def _column_at(self, key: str, known: TracedValue | None, degrees: float) -> float:
        row = int(np.argmin(np.abs(self.grid.degrees - degrees)))
        if known is None or self.has_positions:
            if abs(float(self.grid.degrees[row]) - degrees) > _SAME_ANGLE:
                nearest = f"{self.grid.degrees[row]:g}"
                raise CrankworkError(ErrorMessage("angle_between_rows", key=key, angle=degrees, nearest=nearest))
            if known is None:
                return float(self.columns[key][row])
        with warnings.catch_warnings():
            # at an angle that the crank does not reach, an error is raised below
            warnings.simplefilter("ignore", RuntimeWarning)
            value = float(Program({key: known})(CrankGrid.from_degrees([degrees]))[key][0])
        if not math.isfinite(value):
            raise CrankworkError(ErrorMessage("angle_unreached", key=key, angle=degrees))
        return value

    @property
    def has_positions(self) -> bool:
        """Whether columns have values only at the positions of a document's table, none between them."""
        return self.machine.transfer is not None

    def _within(self, key: str, angle_or_time: float | None) -> float:
        """Return the crank angle of a value that varies. [deg]"""
        if self.period:
            if angle_or_time is None:
                raise CrankworkError(ErrorMessage("time_missing", key=key, example=f"{self.period / 2:g}"))
            if not 0 <= angle_or_time <= self.period:
                raise CrankworkError(ErrorMessage("time_outside", time=angle_or_time, period=self.period))
            return self.degrees_of(angle_or_time)
        if angle_or_time is None:
            middle = float(self.grid.degrees[len(self.grid) // 2])
            raise CrankworkError(ErrorMessage("angle_missing", key=key, example=f"{middle:g}"))
        first, last = min(0.0, self.grid.degrees[0]), max(self.machine.cycle, self.grid.degrees[-1])
        if not first <= angle_or_time <= last:
            raise CrankworkError(ErrorMessage("angle_outside", angle=angle_or_time, cycle=self.machine.cycle))
        return float(angle_or_time)

    def _unknown(self, key: str, known: Iterable[str]) -> UnknownKeyError:
        """Return the error of an unknown key, with the nearest keys that exist."""
        known, kind = list(known), key_of(key).quantity
        near = difflib.get_close_matches(key, known, n=3, cutoff=0.7) or [item for item in known if key in item][:3]
        if kind in QUANTITIES and not any(key_of(item).quantity == kind for item in known):
            values = {"key": _printable(key), "method": self.method.name, "nearest": tuple(near)}
            return UnknownKeyError(ErrorMessage("result_absent_near" if near else "result_absent", **values))
        if near:
            return UnknownKeyError(ErrorMessage("result_unknown_near", key=_printable(key), nearest=tuple(near)))
        return UnknownKeyError(ErrorMessage("result_unknown", key=_printable(key)))


def _printable(key: str) -> str:
    return "".join(item if item.isprintable() else ascii(item)[1:-1] for item in key[:60])
