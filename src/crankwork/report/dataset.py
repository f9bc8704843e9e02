"""Results as the data that other programs take: an xarray dataset, a pandas frame, NetCDF, Parquet and MAT files."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from crankwork import files
from crankwork.analysis import Array, Results
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import Key, key_of
from crankwork.report.display import displayed_column, in_own_units, key_unit, label, symbol
from crankwork.report.summary import provenance_data
from crankwork.report.tables import table_column
from crankwork.units import coherent_unit

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# what the name after the dot is one of, by the beginning of a key
_OWNERS = {
    "crank_torque": "cylinder", "crankpin": "crankpin", "mean_crankpin": "crankpin", "oil_hole": "crankpin",
    "crankpin_wear": "crankpin", "main_wear": "journal", "journal": "journal", "main_journal": "journal",
    "point_": "point", "link_": "link", "instant_centre": "link", "slider_": "slider", "normal_": "slider",
    "friction_force": "slider", "joint_force": "joint", "friction_torque": "joint", "transmission_angle": "joint",
    "pressure_angle": "joint", "free_": "order", "shaking_moment_amplitude": "order",
    "flywheel_inertia": "way", "relative_speed": "joint",
}  # fmt: skip
# what a table runs over whose first column says it
_FIRST = {"wear_ray_angle": "ray", "harmonic_order": "order", "cylinder_number": "cylinder"}
# with which module each kind of file is written
_MODULES = {".nc": "h5netcdf", ".parquet": "pyarrow", ".mat": "scipy"}


@in_own_units
def dataset(results: Results, *, shown: bool = False) -> xr.Dataset:
    """Return everything as a dataset with dimensions: crank angle, cylinder, crankpin, joint, point, link, ray ...

    Parameters
    ----------
    results : Results
        Results of an analysis.
    shown : bool
        In the units of tables instead of SI; the attribute `units` of each variable says which.

    Raises
    ------
    MissingExtraError
        If xarray is not installed.
    """
    check_extras("xarray")
    import xarray as xr  # noqa: PLC0415 - an optional part

    along = "time" if "time" in results.columns else "crank_angle"
    variables = _Variables(shown=shown)
    for key, values in results.columns.items():
        if key not in ("crank_angle", along):
            variables.put(key, key, (along,), values)
    for key, value in results.summary.items():
        variables.put(key, key, (), np.asarray(value))
    parts = [variables.made(), *(_listing(results, name, variables.owned, shown=shown) for name in results.listings)]
    index = results.grid.degrees if along == "crank_angle" else results.columns["time"]
    joined = xr.merge([*parts, xr.Dataset(coords={along: index})], join="outer", compat="no_conflicts")
    joined[along].attrs = {"units": "deg" if along == "crank_angle" else "s", "long_name": label(along, "en")}
    return joined.assign_attrs(provenance_data(results))


class _Variables:
    """Variables by name; what belongs to different owners stands under one."""

    def __init__(self, *, shown: bool) -> None:
        self.owned: dict[str, dict[str, tuple[tuple[str, ...], Array]]] = {}
        self._attributes: dict[str, dict[str, str]] = {}
        self._shown = shown

    def put(self, name: str, key: str, along: tuple[str, ...], values: Array) -> None:
        """Add a column, a single value or a listing of the quantity of a key."""
        kind, owner = key_of(name)
        name, owner = (kind, owner) if owner and _owner(kind) else (name, "")
        self.owned.setdefault(name, {})[owner] = along, _in_unit(key, values, shown=self._shown)
        self._attributes[name] = _attributes(key_of(key).quantity if owner else key, shown=self._shown)

    def made(self) -> xr.Dataset:
        """Return all of them."""
        import xarray as xr  # noqa: PLC0415 - an optional part

        parts = [self._variable(name, owned) for name, owned in self.owned.items()]
        return xr.merge(parts, join="outer", compat="no_conflicts")

    def _variable(self, name: str, owned: Mapping[str, tuple[tuple[str, ...], Array]]) -> xr.Dataset:
        """Return one variable, with a dimension of owners if it has those; one without owners keeps its name."""
        import xarray as xr  # noqa: PLC0415 - an optional part

        attributes, arrays = self._attributes[name], dict[str, Any]()
        owners = {owner: value for owner, value in owned.items() if owner}
        # of one cylinder that stands for all of them there is no need twice
        is_own = "" in owned and not any(np.array_equal(owned[""][1], array) for _, array in owners.values())
        if is_own:
            arrays[name] = (*owned[""], attributes)
        if not owners:
            return xr.Dataset(arrays)
        dimension = _owner(name) or "part"
        (inner, _), *_ = owners.values()
        values = np.stack([value for _, value in owners.values()])
        arrays[f"{name}_by_{dimension}" if is_own else name] = ((dimension, *inner), values, attributes)
        numbered = all(owner.isdecimal() for owner in owners)
        return xr.Dataset(arrays, {dimension: [int(owner) for owner in owners] if numbered else list(owners)})


def _owner(kind: str) -> str:
    return next((dimension for begin, dimension in _OWNERS.items() if kind.startswith(begin)), "")


def _listing(results: Results, name: str, taken: Mapping[str, object], *, shown: bool) -> xr.Dataset:
    """Return a table that runs over something else than the crank angle."""
    listing = results.listings[name]
    first, *_ = listing.columns
    along = name if listing.names else _FIRST.get(first, name)
    variables = _Variables(shown=shown)
    for key, values in listing.columns.items():
        if listing.names or key != first:
            kind, owner = key_of(key)
            # wear of pins and of journals are two variables
            called = name if kind == "wear_sum" else f"{name}_{kind}" if kind in taken or along == name else kind
            variables.put(str(Key(called, owner)), key, (along,), values)
    if listing.names:
        return variables.made().assign_coords({along: list(listing.names)})
    joined = variables.made().assign_coords({along: _in_unit(first, listing.columns[first], shown=shown)})
    joined[along].attrs = _attributes(first, shown=shown)
    return joined


def _in_unit(key: str, values: Array, *, shown: bool) -> Array:
    return displayed_column(key, values) if shown else np.asarray(values, dtype=float)


def _attributes(key: str, *, shown: bool) -> dict[str, str]:
    """Return unit, name, symbol and meaning of a quantity."""
    unit, row = key_unit(key), QUANTITIES.get(base_key(key))
    texts = {
        "units": unit if shown else coherent_unit(unit),
        "long_name": label(key, "en"),
        "symbol": symbol(key, "en"),
    }
    return texts if row is None else texts | {"definition": row.definition("en")}


@in_own_units
def frame(results: Results, *, shown: bool = False) -> pd.DataFrame:
    """Return the columns as a frame over the crank angle, or over the time of a law.

    `shown`: in the units of tables, with these in the headings.

    Raises
    ------
    MissingExtraError
        If pandas is not installed.
    """
    check_extras("pandas")
    import pandas as pd  # noqa: PLC0415 - an optional part

    along = "time" if "time" in results.columns else "crank_angle"
    index = results.grid.degrees if along == "crank_angle" else results.columns["time"]
    keys = [key for key in results.columns if key not in ("crank_angle", along)]
    units = {key: key_unit(key) if shown else coherent_unit(key_unit(key)) for key in keys}
    columns = {
        f"{key} [{units[key] or '-'}]" if shown else key: table_column(results, key) if shown else results.columns[key]
        for key in keys
    }
    table = pd.DataFrame(columns, index=pd.Index(index, name=f"{along} [{'deg' if along == 'crank_angle' else 's'}]"))
    table.attrs.update(provenance_data(results), units=units)
    return table


def write(results: Results, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the data as NetCDF (`.nc`), Parquet (`.parquet`) or MAT (`.mat`), in SI.

    Raises
    ------
    CrankworkError
        If the ending is another, or the file is there and is not to be replaced.
    MissingExtraError
        If a library is not installed.
    """
    files.check_files(path, overwrite=overwrite)
    files.write_files({path: _written(results, str(path))}, overwrite=overwrite)


def _written(results: Results, name: str) -> bytes:
    """Return results as the file that the ending of a name asks for."""
    ending = PurePath(name).suffix.lower()
    if ending not in _MODULES:
        raise CrankworkError(ErrorMessage("data_ending", name=name[-60:], known=", ".join(_MODULES)))
    check_extras(_MODULES[ending], "xarray", "pandas")
    stream = io.BytesIO()
    if ending == ".parquet":
        frame(results).to_parquet(stream)
    elif ending == ".nc":
        dataset(results).to_netcdf(stream, engine="h5netcdf")
    else:
        from scipy.io import savemat  # noqa: PLC0415 - an optional part

        savemat(stream, dict(_variables(dataset(results))), long_field_names=True, do_compression=True)  # type: ignore[arg-type]
    return stream.getvalue()


def _variables(data: xr.Dataset) -> Iterator[tuple[str, object]]:
    """Yield variables and coordinates by names that MATLAB takes, and the units of all."""
    units = {}
    for name, variable in data.variables.items():
        key = str(name).replace(".", "_")
        yield key, variable.values.astype(object) if variable.dtype.kind in "OUT" else variable.values
        units[key] = str(variable.attrs.get("units", ""))
    yield "units", units
    yield "about", {key: str(value) for key, value in data.attrs.items()}


def check_extras(*modules: str) -> None:
    """Refuse with the extras that bring modules which are not installed."""
    if extras := missing_extras(dict.fromkeys(modules, "data")):
        raise MissingExtraError(ErrorMessage("extra_data"), *extras)
