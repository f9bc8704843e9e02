"""What an analysis returns: columns over the crank angle, single values, checks and notices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from crankwork.analysis.solved import Notice
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.method import Method
from crankwork.steps import Step

if TYPE_CHECKING:
    from crankwork.linkage_machine import AnyMachine


class Listing(NamedTuple):
    """A table that does not run over the crank angle: orders, rays, cylinders, bearings.

    Parameters
    ----------
    columns : mapping of str to array, shape (n,)
        Columns by key of `quantities.QUANTITIES`, the first of which says what each row is. [SI]
    names : tuple of str
        What rows are called where they are things, such as `crankpin.1`; empty where the first column says it.
    """

    columns: Mapping[str, Array]
    names: tuple[str, ...] = ()


@dataclass(frozen=True)
class Results:
    """What a machine does over one cycle, in SI.

    Parameters
    ----------
    solved : Solved, SolvedLinkage or SolvedTable
        The machine and the method that made the results.
    grid : CrankGrid, shape (n,)
        Crank angles of the columns. [rad]
    columns : mapping of str to array, shape (n,)
        Results by key of `quantities.QUANTITIES`. [SI]
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
    steps : tuple of Step
        How calculated values of the working cycle came about, in order.
    """

    solved: Any
    grid: CrankGrid
    columns: Mapping[str, Array]
    summary: Mapping[str, float]
    checks: Mapping[str, float]
    notices: tuple[Notice, ...]
    groups: Mapping[str, tuple[str, ...]]
    listings: Mapping[str, Listing] = field(default_factory=dict)
    steps: tuple[Step, ...] = ()

    @property
    def machine(self) -> AnyMachine:
        """The machine."""
        machine: AnyMachine = self.solved.machine
        return machine

    @property
    def method(self) -> Method:
        """The method that made the results."""
        method: Method = self.solved.method
        return method

    @property
    def tables(self) -> Mapping[str, tuple[str, ...]]:
        """The keys of each table, crank angle first."""
        present = {
            name: ("crank_angle", *(key for key in keys if key in self.columns)) for name, keys in self.groups.items()
        }
        return {name: keys for name, keys in present.items() if len(keys) > 1}

    def __getitem__(self, key: str) -> Array | float:
        """Return a column, or a single value of the summary, in SI."""
        return self.columns[key] if key in self.columns else self.summary[key]
