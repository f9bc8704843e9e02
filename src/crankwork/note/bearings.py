"""The loads of bearings and their wear in a note: of a crankpin, its rod and the main journals, of any joints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from crankwork.note.document import Block, Citation, Math, Runs
from crankwork.note.lines import first_articulated
from crankwork.note.material import Material
from crankwork.note.parts import (
    At,
    Head,
    Keys,
    Lines,
    Listed,
    Over,
    Part,
    Places,
    Rows,
    Section,
    Shown,
    Text,
    When,
    every,
    full,
    has,
    in_full,
    lacks,
    turning,
)
from crankwork.note.wording import named
from crankwork.quantities.key import key_of

_SOURCE = "kolchin_demidov_2008, ch. 9"
_ON_CRANKPIN = (
    "big_end_inertia_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load",
)  # fmt: skip
_STATISTICS = (
    "mean_crankpin_load", "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max", "reversal_duration",
    "reversal_ratio",
)  # fmt: skip
_ON_ROD = ("big_end_load", "piston_pin_force", "small_end_load")
_ON_MAINS = (
    "shaft_unbalance", "unbalance_force", "unbalance_weight", "unbalance_tangential_force", "journal_share",
    "main_journal_load",
)  # fmt: skip
_ON_PINS = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "main_journal_load")


def _columns(material: Material) -> list[str]:
    return [key for key in material.results.groups.get("bearings", ()) if key in material.columns]


def _of_pin_and_rod(material: Material) -> list[str]:
    """Return the columns of crankpin and rod; without the big end where it carries what the crankpin does."""
    return [key for key in _columns(material) if material.full or key != "big_end_load" or not _is_same(material)]


def _is_same(material: Material) -> bool:
    """Return whether one rod alone is on each crankpin, so that its big end carries the same load."""
    pin, columns = "crankpin_load.1", material.columns
    return {pin, "big_end_load"} <= columns.keys() and np.allclose(columns[pin], columns["big_end_load"])


def _components(material: Material) -> Iterator[Block]:
    """Yield the components of the load on the first main journal, sums over the throws beside it."""
    lines = material.lines("bearings", "bearing_force_x", "bearing_force_y")
    yield from () if material.full else material.worked(line for line in lines if line.key.endswith("main_journal.1"))


def _has_pin(material: Material) -> bool:
    return material.has_piston and bool(_columns(material))


def _of_crankpin(material: Material) -> Iterable[str]:
    return [key for key in _columns(material) if key.startswith("crankpin_")]


def _group(name: str) -> Keys:
    """Return what gives the keys of a table of the results."""
    return lambda material: material.results.groups.get(name, ())


def _articulated(material: Material) -> Iterator[Block]:
    """Yield motion and forces of the first cylinder whose rod is articulated, worked at its own crank angle."""
    words, engine = material.words, material.machine.engine
    if engine is None or "articulated" not in material.groups:
        return
    number = first_articulated(engine)
    of_crankpin, own = (
        words.amount(math.radians(material.groups[name].degrees or 0.0), "deg") for name in ("bearings", "articulated")
    )
    shown: Runs = (Math(words.symbol(f"crank_angle.{number}")), f" = {own}")
    yield words.paragraph("articulated", number=str(number), value=of_crankpin, own=shown)
    yield from material.equations("articulated")


def _oil_hole(material: Material) -> Iterator[Block]:
    """Yield where the oil hole belongs."""
    angle = next((material.summary[key] for key in material.summary if key.startswith("oil_hole_angle")), None)
    if angle is not None:
        yield material.words.paragraph("wear", value=material.words.amount(angle, "deg", digits=4))


def _oil_holes(material: Material) -> Iterator[Block]:
    """Yield where the oil hole of each pin belongs."""
    words = material.words
    for key in named(material.summary, "oil_hole_angle"):
        angle = words.amount(material.summary[key], "deg", digits=4)
        yield words.paragraph("joint_wear", name=key_of(key).owner, value=angle)


_PIN: tuple[Part, ...] = (
    Text("crankpin"), When(every(lacks(full), _is_same), (Text("big_end_same"),)), _articulated, At("bearings"),
    Lines("bearings", _ON_CRANKPIN),
)  # fmt: skip
_STATED = Lines("bearing_loads", _STATISTICS, intro="loads", first=True)
_OF_ROD = Lines("bearings", _ON_ROD)
_LOADS, _OF_WEAR = Rows("bearing_loads", "loads"), Rows("crankpin_wear", "crankpin_wear")
_WEAR: tuple[Part, ...] = (
    _oil_hole, Shown(("crankpin_wear",), (in_full(_OF_WEAR),)),
)  # fmt: skip
SECTIONS = (
    # polar, unrolled and wear in one
    Section("crankpin", (
        Head("crankpin"), *_PIN, _OF_ROD, _STATED,
        When(lacks(full), (_oil_hole,)),
        Shown((), (_LOADS,)),
        Shown(("crankpin_polar", "crankpin_load", "big_end_polar", "small_end_polar"),
              (Over("crankpin", _of_pin_and_rod),), ("crankpin_wear",)),
        When(full, (Head("wear", 2), *_WEAR)),
    ), _has_pin),
    Section("polar", (
        Head("crankpin"), *_PIN, Shown(("crankpin_polar",), (Over("crankpin", _of_crankpin),)),
    ), _has_pin),
    Section("unrolled", (Head("unrolled"), _STATED, Shown(("crankpin_load",), (_LOADS,))), _has_pin),
    Section("big_end", (
        Head("big_end"), Text("big_end"), At("bearings"), _OF_ROD,
        Shown(("big_end_polar", "small_end_polar"), (Over("rods", ("big_end_load", "small_end_load")),)),
    ), has("piston_displacement", "big_end_load")),
    Section("wear", (Head("wear"), *_WEAR), has("piston_displacement", "crankpin_wear")),
    # main journals, and the torque along the shaft
    Section("mains", (
        Head("mains", sinks=True), Text("mains"), At("bearings"), _components, Lines("bearings", _ON_MAINS),
        Shown(("main_journal_polar",), (Over("mains", _group("main_journals")),)),
        When(full, (
            Shown(("main_wear",), (Rows("main_wear", "main_wear"),)), Lines("engine_torque"),
            Shown(("accumulated_torque",), (Over("accumulated", _group("accumulated_torque")),)),
        )),
    ), lambda material: material.has_piston and material.has_engine and material.has("main_journals")),
    Section("bearings", (
        Head("bearings"), Text("joint_bearings", {"source": Citation(_SOURCE)}), At("joint_bearings"),
        Lines("joint_bearings", _ON_PINS), Places("bearings", _ON_PINS, "bearings", filled=True),
        Text("joint_loads"), Lines("bearing_sizes"), Listed("bearing_loads", "loads"), Shown(("crankpin_polar",)),
        _oil_holes, When(full, (
            Shown(("crankpin_load", "main_journal_polar")), Listed("crankpin_wear", "crankpin_wear"),
            Listed("main_wear", "main_wear"), Shown(("crankpin_wear", "main_wear")),
        )),
    ), every(turning, has("bearing_loads"))),
)  # fmt: skip
