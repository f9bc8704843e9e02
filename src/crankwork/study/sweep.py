"""Single values of many designs of one machine file."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.description.numeric_field import NumericField, numeric_field
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.report.dataset import check_extras
from crankwork.report.display import key_unit
from crankwork.study.variants import MachineVariants
from crankwork.units import coherent_unit, parse_in, use_units

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# designs analysed to check the compiled calculation
_CHECKED = 4


@dataclass(frozen=True)
class Swept:
    """Single values of designs. [SI]

    Parameters
    ----------
    fields : mapping of str to array, shape (n,)
        Values of the fields, by the keys of the file.
    values : mapping of str to array, shape (n,)
        Single values by key, NaN without a machine.
    refused : mapping of str to int
        Number of designs without a machine, by reason.
    one_by_one : int
        Number of designs analysed one by one.
    reason : str
        Why the calculation was not compiled; empty if it was.
    units : mapping of str to str
        The SI units of fields and values, by their keys.
    about : mapping of str to str
        Origin of the designs, such as the seed of a sample.
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

        def variables(columns: Mapping[str, Array]) -> dict[str, tuple[str, Array, dict[str, str]]]:
            return {key: ("design", column, {"units": self.units.get(key, "")}) for key, column in columns.items()}

        return xr.Dataset(variables(self.values), variables(self.fields), dict(self.about))

    def to_dataframe(self) -> pd.DataFrame:
        """Return fields and values as a frame, a row for each design; units are among its `attrs`.

        Raises
        ------
        MissingExtraError
            If pandas is not installed.
        """
        check_extras("pandas")
        import pandas as pd  # noqa: PLC0415 - an optional part

        frame = pd.DataFrame({**self.fields, **self.values})
        frame.attrs.update(self.about, units=dict(self.units))
        return frame


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

    The calculation of one analysis is compiled and evaluated for all designs at once; extremes and integrals are those
    of the analysis. Designs that are not compiled accurately are analysed one by one.

    Parameters
    ----------
    description : Description
        The machine file.
    designs : mapping of str to sequence
        Values of fields by their keys, as many for each: numbers in SI, or texts with units.
    keys : sequence of str
        Keys of the summary.
    steps : int, optional
        Number of evenly spaced crank angles, if exact extremes and integrals are not needed.
    overrides : sequence of str
        Settings that replace those of the file, `KEY=VALUE`.
    workers : int, optional
        Number of threads, by default that of the processors.

    Returns
    -------
    Swept
        Fields and values of each design.

    Raises
    ------
    CrankworkError
        If a field or a key does not exist, or the fields have different numbers of values.

    Examples
    --------
    >>> import crankwork
    >>> d = crankwork.Description(crankwork.template("slider-crank"))
    >>> found = crankwork.sweep(d, {"crank.radius": ["40 mm", "50 mm"]}, ["stroke"])
    >>> found.values["stroke"]
    array([0.08, 0.1 ])
    """
    values = description.values_with(overrides)
    numbers = {key: numeric_field(values, key) for key in designs}
    columns = [_in_si(numbers[key], column) for key, column in designs.items()]
    if len({len(column) for column in columns}) != 1 or not columns[0]:
        raise CrankworkError(ErrorMessage("sweep_lengths", keys=", ".join(designs)))
    all_designs: Array = np.array(columns)
    spans = np.stack([all_designs.min(axis=1), np.median(all_designs, axis=1), all_designs.max(axis=1)], axis=1)
    machines = MachineVariants(description, numbers, spans, keys, overrides)
    machines.compile(steps, all_designs[:, np.linspace(0, all_designs.shape[1] - 1, _CHECKED).astype(int)])
    result = machines.values(all_designs, workers=workers or os.cpu_count() or 1)
    refused = Counter(str(error) for error in result.refused.values())
    fields = dict(zip(numbers, all_designs, strict=True))
    values_of = dict(zip(keys, result.values, strict=True))
    return Swept(fields, values_of, refused, result.one_by_one, machines.reason, units_of(numbers, keys))


def units_of(numbers: Mapping[str, NumericField], keys: Sequence[str]) -> dict[str, str]:
    """Return the SI units of fields and of single values."""
    with use_units("si"):
        values = {key: coherent_unit(key_unit(key)) for key in keys}
    return {key: coherent_unit(number.unit) if number.unit else "" for key, number in numbers.items()} | values


def _in_si(number: NumericField, values: Sequence[float | str]) -> list[float]:
    try:
        return [parse_in(value, number.unit) if isinstance(value, str) else float(value) for value in values]
    except ValueError as error:
        raise CrankworkError(ErrorMessage("option_key_wrong", key=number.key, mistake=error.args[0])) from None
