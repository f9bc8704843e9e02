"""The keys of results, taken apart in one place."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import NamedTuple

# result keys of earlier versions, for one release: the same value under another key
RENAMED: Mapping[str, str] = MappingProxyType(
    {
        "mean_total_torque": "mean_torque",
        "mean_total_torque.indicated": "mean_torque.indicated",
        "engine_indicated_power": "indicated_power",
        "total_reduced_inertia": "reduced_inertia",
        "total_reduced_inertia_1": "reduced_inertia_1",
    }
)
# keys that were those of cylinder 1 in an engine and are those of the machine; the key of the cylinder's value
MOVED: Mapping[str, str] = MappingProxyType(
    {key: f"{key}.1" for key in ("mean_torque", "indicated_power", "reduced_inertia", "reduced_inertia_1")}
)


class Key(NamedTuple):
    """The key of a result: its quantity, and the part of the machine that it belongs to.

    `joint_force.A` is the joint force of joint A. What belongs to the whole machine has no owner. Where it is taken
    stands with the owner: `@33deg`, or `A@33deg`.
    """

    quantity: str
    owner: str = ""

    def __str__(self) -> str:
        separator = "." if self.owner and not self.owner.startswith("@") else ""
        return f"{self.quantity}{separator}{self.owner}"

    def derived(self, suffix: str) -> str:
        """Return the key of what is derived from this: `joint_force.A` with `_max` is `joint_force_max.A`."""
        return str(Key(self.quantity + suffix, self.owner))


@cache
def key_of(text: str) -> Key:
    """Return the key that a text spells.

    Examples
    --------
    >>> key_of("joint_force.A").derived("_max_angle")
    'joint_force_max_angle.A'
    >>> str(Key("point_x", "coupler.centre"))
    'point_x.coupler.centre'
    >>> key_of("crank_torque@33.5deg").quantity
    'crank_torque'
    """
    what, sign, place = text.partition("@")
    quantity, _, owner = what.partition(".")
    return Key(quantity, f"{owner}{sign}{place}")
