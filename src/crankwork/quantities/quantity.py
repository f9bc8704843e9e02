"""What a row of the table of quantities holds."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from types import MappingProxyType
from typing import NamedTuple

from crankwork.locale import Language, translate
from crankwork.quantities.key import key_of
from crankwork.units import coherent_unit, shown_unit

# how the name of what a point, link, slider or joint has ends
OWNED = re.compile(
    r" (точки|звена|ползуна|в шарнире|điểm|khâu|con trượt|khớp)$| of(?P<article> a) (point|link|slider)$"
)


class Quantity(NamedTuple):
    """One row of the table. `metric_per_area` is set where the quantity may be given per piston area.

    `unit` is that of tables, figures and notes, in the system in use; values of results and arguments of functions are
    in `si_unit`.
    A copy of a row whose key goes on after a dot, `joint_force.A`, is the quantity of that point or link.
    """

    key: str
    metric: str
    metric_per_area: str = ""

    @property
    def unit(self) -> str:
        """Unit of tables, figures and notes."""
        return shown_unit(self.metric)

    @property
    def per_area_unit(self) -> str:
        """Unit of forces per piston area, where the quantity may be given so."""
        return shown_unit(self.metric_per_area)

    @property
    def si_unit(self) -> str:
        """Unit of the values of results, which are in SI: `m` where `unit` is `mm`."""
        return coherent_unit(self.metric)

    def symbol(self, language: Language = "en") -> str:
        """Return the symbol used in books of that language, the name of a point or link in its subscript."""
        kind, part = self._split()
        shown = translate(f"symbols.{kind}", language)
        if part and shown.endswith("_i") and not kind.startswith("indicated"):
            # the name takes the place of the index
            return f"{shown.removesuffix('i')}{part}"
        return f"{shown}{',' if '_' in shown else '_'}{part}" if part else shown

    def label(self, language: Language = "en") -> str:
        """Return the name of the quantity in that language."""
        kind, part = self._split()
        name = translate(f"quantities.{kind}", language)
        return owned_name(name, part.replace(".", ", "))

    def definition(self, language: Language = "en") -> str:
        """Return a sentence on what the quantity is and which direction is positive."""
        return translate(f"definitions.{key_of(self.key).quantity}", language)

    def _split(self) -> tuple[str, str]:
        kind, part = key_of(self.key)
        return kind, own_name(kind, part)


def table(**units: str) -> tuple[Quantity, ...]:
    """Return rows of the table from their units by key: `N or MPa` where forces may be given per piston area."""
    return tuple(Quantity(key, *unit.split(" or ")) for key, unit in units.items())


_NUMBERS: ContextVar[Mapping[str, str]] = ContextVar("numbers", default=MappingProxyType({}))


@contextmanager
def use_numbers(numbers: Mapping[str, str]) -> Iterator[None]:
    """Call links by these numbers in symbols and in names of quantities within this context, as documents do."""
    token = _NUMBERS.set(numbers)
    try:
        yield
    finally:
        _NUMBERS.reset(token)


def number_of(link: str) -> str:
    """Return what a link is called in a symbol: its number where links have numbers, else its name."""
    return _NUMBERS.get().get(link, link)


def own_name(kind: str, name: str) -> str:
    """Return the name of what a quantity belongs to; the link that tells apart joints of one point follows a space.

    A centre of mass of a link has the letter S.
    """
    if name.endswith(".centre"):
        return f"S {number_of(name.removesuffix('.centre'))}"
    owner, dot, rest = name.partition(".")
    owner, rest = number_of(owner), ".".join(map(number_of, rest.split(".")))
    of_joint = kind.startswith(("joint_", "doubled_area"))
    # what acts on a link is told by the joint it comes from
    return f"{owner.replace('_', ' ') if of_joint else owner}{dot}{rest.replace('_', ' ')}"


def owned_name(name: str, owner: str) -> str:
    """Return the name of a quantity with what it belongs to, if anything.

    Examples
    --------
    >>> owned_name("velocity of a point", "B"), owned_name("угол поворота звена", "rod"), owned_name("joint force", "A")
    ('velocity of point B', 'угол поворота звена rod', 'joint force, A')
    >>> owned_name("ход ползуна", "ползун"), owned_name("угол поворота звена", "звено 3")
    ('ход ползуна', 'угол поворота звена 3')
    """
    if not owner:
        return name
    noun, (first, *further) = name.rsplit(maxsplit=1)[-1], owner.split()
    if len(first) > 3 and noun[:4] == first.lower()[:4] and abs(len(noun) - len(first)) < 3:
        # a slider that is called slider is told once
        return " ".join([name, *further])
    result = OWNED.search(name)
    if not result:
        return f"{name}, {owner}"
    return (
        f"{name[: result.start('article')]}{name[result.end('article') :]} {owner}"
        if result["article"]
        else f"{name} {owner}"
    )
