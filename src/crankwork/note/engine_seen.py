"""What a figure of an engine shows, in words, for who cannot see it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Protocol

from crankwork.analysis import Array, Results
from crankwork.note.engine_words import EngineWords
from crankwork.report.figure_data import kind_of
from crankwork.report.language import label

_SHOWN: Mapping[str, tuple[str, ...]] = {
    "kinematics": ("piston_displacement", "piston_velocity", "piston_acceleration"),
    "pressure": ("gas_pressure",),
    "indicator": ("gas_pressure",),
    "piston_forces": ("gas_force", "inertia_force", "piston_force"),
    "rod_forces": ("rod_force", "side_force"),
    "crankpin_forces": ("tangential_force", "radial_force"),
    "torque": ("crank_torque",),
    "crankpin_polar": ("crankpin_tangential_force", "crankpin_radial_force"),
    "brix": ("piston_displacement",),
    "tolle": ("piston_displacement", "piston_acceleration"),
    "total_torque": ("total_torque",),
    "crankpin_load": ("crankpin_load",),
    "big_end_polar": ("big_end_load",),
    "small_end_polar": ("small_end_load",),
    "excess_work": ("kinetic_energy_change",),
    "crank_speed": ("crank_speed",),
    "crankpin_wear": ("wear_sum",),
    "balance_orders": ("free_force", "free_moment"),
    "torque_harmonics": ("harmonic_amplitude", "total_harmonic_amplitude"),
}
# figures that show each crankpin whose load is another
_OF_CRANKPINS = ("crankpin_polar", "crankpin_load", "crankpin_wear")
_OVER_CYCLE = {"accumulated_torque": "accumulated_torque", "main_journal_polar": "main_journals"}


class Shown(Protocol):
    """What is shown: results, columns and listings in the units in which they are shown, and words."""

    results: Results

    @property
    def words(self) -> EngineWords:
        """The words of the language."""

    @property
    def columns(self) -> dict[str, Array]:
        """Columns over the crank angle by key."""

    @property
    def listings(self) -> dict[str, dict[str, Array]]:
        """Other tables by name."""


def seen(name: str, shown: Shown) -> str:
    """Return the quantities of a figure with their extreme values."""
    keys = _SHOWN.get(kind_of(name), ())
    pins = crankpins(name, shown.results.columns)
    if pins:
        keys = tuple(f"{key}.{pin}" for pin in pins for key in keys)
    if name in _OVER_CYCLE:
        keys = shown.results.groups.get(_OVER_CYCLE[name], ())
    return "; ".join(one for one in (_range(key, shown) for key in keys) if one)


def crankpins(name: str, columns: Iterable[str]) -> tuple[str, ...]:
    """Return the numbers of the crankpins that a figure shows: of a polar diagram one, none of other figures."""
    kind = kind_of(name)
    pins = tuple(key.partition(".")[2] for key in columns if key.startswith("crankpin_load."))
    if kind not in _OF_CRANKPINS or not pins:
        return ()
    if kind != "crankpin_polar":
        return pins
    return (name.rpartition("_")[2],) if name != kind else pins[:1]


def _range(key: str, shown: Shown) -> str:
    """Return the least and the largest value of a column or listing, in words."""
    words, values = shown.words, shown.columns.get(key)
    if values is None:
        values = next((one[key] for one in shown.listings.values() if key in one), None)
    if values is None or not len(values):
        return ""
    low, high = (words.number(float(one), digits=4) for one in (values.min(), values.max()))
    named = label(key, words.language)
    return words.phrase("seen", quantity=named, low=low, high=f"{high}\u00a0{words.unit(key)}".rstrip())
