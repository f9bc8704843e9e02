"""What the comparison with frozen results sees of crankwork: the only file here that knows its classes."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

import crankwork
from crankwork.quantities import QUANTITIES, base_key

HERE = Path(__file__).parent
OWN = "own"
METHODS = ("exact", "textbook", "series:4")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that `scripts/freeze` gives."""
    parser.addoption("--freeze", action="store_true", help="freeze what the machines in tests/golden give today")


def pytest_configure(config: pytest.Config) -> None:
    """Write the results of machines that have none yet, where that is asked for."""
    if not config.getoption("--freeze", default=False):
        return
    for path in sorted(HERE.glob("*/*.toml")):
        if any(path.parent.glob(f"{path.stem}.*.json")):
            continue
        degrees = Adapter.angles(path)
        for method in Adapter.methods(path):
            text = _written({"degrees": degrees} | Adapter.values(path, method, degrees))
            path.with_suffix(f".{method.replace(':', '-')}.json").write_text(text, "utf-8")


@pytest.fixture(scope="session")
def adapter() -> type[Adapter]:
    """Give what is known of crankwork."""
    return Adapter


_read = functools.cache(crankwork.read)


class Adapter:
    """Today's results as plain lists."""

    @staticmethod
    def methods(path: Path) -> list[str]:
        """Return the file's own method and, of a piston moved by lengths, the others."""
        machine = _read(path)
        if machine.lengths is None:
            return [OWN]
        own = crankwork.analyse(machine).method.name
        return [OWN, *(method for method in METHODS if method != own)]

    @staticmethod
    def angles(path: Path) -> list[float]:
        """Return the angles to freeze: every 15 degrees, what the file's table adds to its own steps, and 370. [deg]"""
        machine = _read(path)
        own = crankwork.analyse(machine).grid.degrees.tolist()
        regular = [15.0 * step for step in range(int(own[-1] / 15) + 1)]
        wanted = sorted({*regular, *([370.0] if own[-1] == 720 else []), *(one for one in own if one % 5)})
        # a table of transfer functions is known where it stands, and stays there
        frozen: list[float] = crankwork.analyse(machine, crankwork.CrankGrid.from_degrees(wanted)).grid.degrees.tolist()
        return frozen

    @staticmethod
    def values(path: Path, method: str, degrees: Sequence[float]) -> dict[str, Any]:
        """Return columns by key, single values by key, and listings by name and key, all in SI."""
        machine = _read(path)
        if method != OWN:
            machine = crankwork.with_method(machine, method)
        results = crankwork.analyse(machine, crankwork.CrankGrid.from_degrees(degrees))
        listings = {
            name: {key: values.tolist() for key, values in one.columns.items()}
            for name, one in results.listings.items()
        }
        return {
            "columns": {key: values.tolist() for key, values in results.columns.items()},
            "summary": {key: float(value) for key, value in results.summary.items()},
            "listings": listings,
            "rows": {name: list(one.names) for name, one in results.listings.items() if one.names},
        }

    @staticmethod
    def is_angle(key: str) -> bool:
        """Say whether a value is an angle. [rad]"""
        return Adapter.unit(key) == "deg"

    @staticmethod
    def unit(key: str) -> str:
        """Return the unit by which values of one kind are known."""
        return "deg" if key.partition(".")[0].endswith("_angle") else QUANTITIES[base_key(key)].unit


def _written(frozen: Mapping[str, Any]) -> str:
    """Return results as JSON, a line for each key, twelve digits for each number, so that a difference can be read."""

    def short(value: Any) -> Any:
        if isinstance(value, list):
            return [short(one) for one in value]
        if isinstance(value, float):
            return None if math.isnan(value) else float(f"{value:.12g}")
        return value

    def lines(value: Any, depth: int) -> str:
        if not isinstance(value, dict) or not value:
            return json.dumps(short(value), allow_nan=False, separators=(",", ":"))
        inner = ",\n".join(f'{" " * depth}"{key}": {lines(one, depth + 1)}' for key, one in value.items())
        return f"{{\n{inner}\n{' ' * (depth - 1)}}}"

    return lines(frozen, 1) + "\n"
