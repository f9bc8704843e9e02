"""Many designs of one machine file: the single values of each."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.report.dataset import check_extras
from crankwork.report.language import key_unit
from crankwork.study.machines import Machines
from crankwork.study.sought import Sought, sought_number
from crankwork.units import coherent_unit, parse_in, use_units

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# designs that are calculated both ways before all others are compiled
_CHECKED = 4


@dataclass(frozen=True)
class Swept:
    """Single values of designs. [SI]

    Parameters
    ----------
    fields : mapping of str to array, shape (n,)
        What the designs state, by the keys of the file.
    values : mapping of str to array, shape (n,)
        Single values by key, not numbers where there is no machine.
    refused : mapping of str to int
        How many designs there are no machines for, by the reason.
    one_by_one : int
        How many designs were analysed one by one.
    reason : str
        Why the calculation was not compiled; empty where it was.
    units : mapping of str to str
        The SI units of fields and values, by their keys.
    about : mapping of str to str
        Where the designs come from, such as the seed of what was drawn.
    """

    fields: Mapping[str, Array]
    values: Mapping[str, Array] = field(repr=False)
    refused: Mapping[str, int]
    one_by_one: int = 0
    reason: str = ""
    units: Mapping[str, str] = field(default_factory=dict, repr=False)
    about: Mapping[str, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return next(iter(self.fields.values())).size

    def to_xarray(self) -> xr.Dataset:
        """Return fields and values over the designs, the fields as coordinates, with their units as attributes.

        Raises
        ------
        MissingExtraError
            If xarray is not installed.
        """
        check_extras("xarray")
        import xarray as xr  # noqa: PLC0415 - an optional part

        def of(columns: Mapping[str, Array]) -> dict[str, tuple[str, Array, dict[str, str]]]:
            return {key: ("design", one, {"units": self.units.get(key, "")}) for key, one in columns.items()}

        return xr.Dataset(of(self.values), of(self.fields), dict(self.about))

    def to_dataframe(self) -> pd.DataFrame:
        """Return fields and values as a frame, a row for each design; units are among its `attrs`.

        Raises
        ------
        MissingExtraError
            If pandas is not installed.
        """
        check_extras("pandas")
        import pandas as pd  # noqa: PLC0415 - an optional part

        found = pd.DataFrame({**self.fields, **self.values})
        found.attrs.update(self.about, units=dict(self.units))
        return found


def sweep(
    description: Description,
    designs: Mapping[str, Sequence[float | str]],
    keys: Sequence[str],
    *,
    steps: int | None = None,
    overrides: Sequence[str | Setting] = (),
    workers: int | None = None,
) -> Swept:
    """Return single values of many designs of a machine file.

    What one analysis remembers is compiled and calculated for all designs at once; extremes and integrals are those of
    the analysis. What does not compile, or is not followed to the last digits, is analysed one by one.

    Parameters
    ----------
    description : Description
        The machine file.
    designs : mapping of str to sequence
        Values of fields by their keys, as many for each: numbers in SI, or texts with units.
    keys : sequence of str
        Single values wanted: keys of the summary.
    steps : int, optional
        How many evenly spaced crank angles are looked at, where exact extremes and integrals are not needed.
    overrides : sequence of str
        Settings laid over the file, `KEY=VALUE`.
    workers : int, optional
        Threads; as many as there are processors by default.

    Returns
    -------
    Swept
        Fields and values of each design.

    Raises
    ------
    CrankworkError
        If a field or a key is not there, or the fields have different numbers of values.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> found = crankwork.sweep(d, {"crank.radius": ["40 mm", "50 mm"]}, ["stroke"])
    >>> found.values["stroke"]
    array([0.08, 0.1 ])
    """
    values = description.values_with(overrides)
    numbers = {key: sought_number(values, key) for key in designs}
    columns = [_in_si(numbers[key], of) for key, of in designs.items()]
    if len({len(one) for one in columns}) != 1 or not columns[0]:
        raise CrankworkError(Refusal("sweep_lengths", keys=", ".join(designs)))
    every: Array = np.array(columns)
    spans = np.stack([every.min(axis=1), np.median(every, axis=1), every.max(axis=1)], axis=1)
    machines = Machines(description, numbers, spans, keys, overrides)
    machines.compile(steps, every[:, np.linspace(0, every.shape[1] - 1, _CHECKED).astype(int)])
    found = machines.values(every, workers=workers or os.cpu_count() or 1)
    refused = Counter(str(one) for one in found.refused.values())
    fields = dict(zip(numbers, every, strict=True))
    values_of = dict(zip(keys, found.of, strict=True))
    return Swept(fields, values_of, refused, found.one_by_one, machines.reason, units_of(numbers, keys))


def units_of(numbers: Mapping[str, Sought], keys: Sequence[str]) -> dict[str, str]:
    """Return the SI units of fields and of single values."""
    with use_units("si"):
        values = {key: coherent_unit(key_unit(key)) for key in keys}
    return {key: coherent_unit(number.unit) if number.unit else "" for key, number in numbers.items()} | values


def _in_si(number: Sought, values: Sequence[float | str]) -> list[float]:
    try:
        return [parse_in(one, number.unit) if isinstance(one, str) else float(one) for one in values]
    except ValueError as error:
        raise CrankworkError(Refusal("option_key_wrong", key=number.key, mistake=error.args[0])) from None
