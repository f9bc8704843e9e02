"""The keys of results, taken apart in one place."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple


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
