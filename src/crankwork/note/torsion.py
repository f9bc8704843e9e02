"""Torsional vibration in a note: its system, natural modes, critical speeds, vibration over the speed, dampers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.note.document import Block, Citation, Equation, Math, Run
from crankwork.note.material import Material
from crankwork.note.parts import Head, Lines, Section, Shown, Text, When, has, lacks
from crankwork.note.tables import Column, quantity_column
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, key_unit, link_label
from crankwork.report.torsion import MODES

_HOLZER, _ORDERS = "holzer_1921", "den_hartog_1956, ch. 5"
# rows of critical speeds, and of tables by Holzer
_MOST_CRITICAL, _MOST_ROWS = 12, 40
_FREQUENCIES = ("natural_frequency", "damped_frequency", "angular_frequency")
# least number that has four digits without decimals, and decimals at most
_FOUR_DIGITS, _DECIMALS = 1000.0, 2


_EQUATION = ("(", Math("K"), " − ", Math("ω"), "² ", Math("J"), ") ", Math("Θ"), " = 0")


class _Listing:
    """A listing as a table without a reference, its rows those of the greatest exciting torque if there are many."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __call__(self, material: Material) -> Iterator[Block]:
        """Yield it."""
        words, listing = material.words, material.results.listings.get(self.name)
        if listing is None:
            return
        rows = np.arange(len(next(iter(listing.columns.values()))))
        if "excitation_torque" in listing.columns:
            rows = np.sort(np.argsort(-listing.columns["excitation_torque"])[:_MOST_CRITICAL])
        if self.name == "holzer" and not material.full:
            rows = rows[listing.columns["angular_frequency"] == listing.columns["angular_frequency"][0]]
        rows = rows[:_MOST_ROWS]
        # the caption says at which frequency
        columns = {key: values[rows] for key, values in listing.columns.items()
                   if material.full or (self.name, key) != ("holzer", "angular_frequency")}  # fmt: skip
        made = [
            column._replace(heading=(link_label(key_of(key).owner, words.language),))
            if key.startswith("relative_amplitude.") else column
            for key, column in zip(columns, _columns(material, columns), strict=True)
        ]  # fmt: skip
        if listing.names:
            made.insert(0, Column((words.column("row"),), [_called(listing.names[row], material) for row in rows]))
        cells = list(zip(*(column.entries for column in made), strict=True))
        align = "l" * bool(listing.names) + "r" * len(columns)
        caption = "holzer_first" if self.name == "holzer" and not material.full else self.name
        yield words.table(caption, [column.heading for column in made], cells, align, self.name)


def _columns(material: Material, columns: Mapping[str, Array]) -> Iterator[Column]:
    """Yield columns of quantities; of frequencies the lowest, which matters most, has its digits too."""
    for key, values in columns.items():
        lowest = float(np.min(np.abs(material.shown(key, values)), initial=np.inf))
        is_spread = key_of(key).quantity in _FREQUENCIES and 0.0 < lowest < _FOUR_DIGITS
        decimals = min(_DECIMALS, 3 - math.floor(math.log10(lowest))) if is_spread else None
        yield quantity_column(material, key, values, decimals=decimals)


def _called(name: str, material: Material) -> str:
    """Return the name of a disc, or of a shaft with the discs between which it is."""
    model, language = material.machine.torsion, material.words.language
    text = link_label(name, language)
    if model is None or name not in model.shafts:
        return text
    return f"{text} ({' – '.join(link_label(end, language) for end in model.shafts[name].between)})"


def _worked(material: Material) -> Iterator[Block]:
    """Yield the equations of the system; what is given stands in the tables."""
    blocks = material.equations("torsion")
    kept = [block for block in blocks if not isinstance(block, Equation) or isinstance(block.step, FormulaLine)]
    return material.intro("torsion_lengths", kept)


def _nodes(material: Material) -> Iterator[Block]:
    """Yield the table of nodes: between which discs, and where between them."""
    words, results = material.words, material.results
    listing, model = results.listings.get("torsional_nodes"), results.machine.torsion
    if listing is None or model is None:
        return
    shapes, places, shares = results.listings["natural_modes"].columns, list[str](), list[str]()
    modes = listing.columns["mode_number"].astype(int)
    # those of the modes that are drawn
    rows = np.flatnonzero(material.full | (modes <= MODES))
    for mode, name in ((int(modes[row]), listing.names[row]) for row in rows):
        ends = model.shafts[name].between if name in model.shafts else (name,)
        a, *b = (float(shapes[f"relative_amplitude.{end}"][mode - 1]) for end in ends)
        places.append(" – ".join(link_label(end, words.language) for end in ends))
        shares.append(words.number(100 * a / (a - b[0]), digits=3) if b else "–")
    number, *distances = (quantity_column(material, key, values[rows]) for key, values in listing.columns.items())
    made = [number, Column((words.column("row"),), places), Column((words.column("share"),), shares), *distances]
    cells = list(zip(*(column.entries for column in made), strict=True))
    yield words.paragraph("torsion_nodes")
    yield words.table("torsional_nodes", [column.heading for column in made], cells, "rlr" + "r" * len(distances),
                      "torsional_nodes")  # fmt: skip


def _torques(material: Material) -> Iterator[Block]:
    """Yield the sentence that tells which torques excite."""
    words, model, parts = material.words, material.machine.torsion, list[Run]()
    for torque in () if model is None else model.torques:
        order = torque.order is not None
        key, value = ("harmonic_order", torque.order) if order else ("angular_frequency", torque.frequency)
        amount = words.amount(torque.torque, "N*m", digits=4)
        turns = words.number(value or 0.0) if order else words.amount(value or 0.0, "rad/s", digits=4)
        if torque.phase:
            turns += f", {words.amount(torque.phase, 'deg', digits=4)}"
        name, symbol = link_label(torque.disc, words.language), Math(words.symbol("excitation_torque"))
        parts += ["; " if parts else "", f"{name}: ", symbol, f" = {amount}, ", Math(words.symbol(key)), f" = {turns}"]
    if parts:
        yield words.paragraph("torsion_torques", values=tuple(parts))


def _vibration(material: Material) -> Iterator[Block]:
    """Yield vibration at the speed of the machine as a table, and the largest over the range of speeds."""
    words, summary, listing = material.words, material.summary, material.results.listings.get("torsional_response")
    kinds = ("vibration_amplitude", "vibration_torque", "vibration_stress")
    known = [kind for kind in kinds if any(key.startswith(f"{kind}.") for key in summary)]
    names = list(dict.fromkeys(key_of(key).owner for key in summary if key_of(key).quantity in known))
    rows = [
        (link_label(name, words.language), *(_cell(material, f"{kind}.{name}") for kind in known)) for name in names
    ]
    yield words.table("torsional_vibration", ["row", *map(words.titled, known)], rows, "l" + "r" * len(known),
                      "torsional_vibration")  # fmt: skip
    if listing is None:
        return
    speed, parts = listing.columns["rotational_speed"], list[Run]()
    is_damped = "torsion_undamped" not in [notice.code for notice in material.results.notices]
    for kind in known if is_damped else ():
        own = [key for key in listing.columns if key_of(key).quantity == kind]
        best = max(own, key=lambda key: float(np.max(listing.columns[key])))
        peak = int(np.argmax(listing.columns[best]))
        amount = words.amount(float(listing.columns[best][peak]), key_unit(best), digits=4)
        where = words.amount(float(speed[peak]), "rpm", digits=4)
        name = link_label(key_of(best).owner, words.language)
        parts += ["; " if parts else "", Math(words.symbol(kind)), f" = {amount} ({name}, {where})"]
    low, high = (words.amount(float(end), "rpm", digits=4) for end in (speed[0], speed[-1]))
    yield words.paragraph("torsion_response", low=low, high=high)
    if parts:
        yield words.paragraph("torsion_largest", values=tuple(parts))


def _cell(material: Material, key: str) -> str:
    value = material.summary.get(key)
    unit = key_unit(key)
    return "–" if value is None else material.words.number(displayed(key, value) if unit else value, digits=4)


def _is_forced(material: Material) -> bool:
    return any(key.startswith("vibration_amplitude.") for key in material.summary)


def _alone(material: Material) -> bool:
    """Return whether discs and shafts are all that a file states."""
    turning = material.machine.turning
    return turning is not None and not turning.diagrams


SECTIONS = (
    Section("task", (
        Head("task"), Text("task_torsion", {
            "discs": lambda material: str(len(material.results.listings["torsional_discs"].names)),
            "shafts": lambda material: str(len(material.results.listings["torsional_shafts"].names)),
        }),
    ), _alone),
    Section("torsion", (
        Head("torsion"), When(lacks(_alone), (Text("torsion_of_engine"),)), _Listing("torsional_discs"),
        _worked, _Listing("torsional_shafts"), _torques,
        When(has("natural_modes"), (
            Text("torsion_modes", {"equation": lambda _: _EQUATION, "J": lambda _: Math("J"), "K": lambda _: Math("K"),
                                    "source": Citation("thomson_1988, ch. 6")}), _Listing("natural_modes"),
            Shown(("torsional_modes",)), _nodes,
        )),
        When(has("holzer"), (Text("torsion_holzer", {"source": Citation(_HOLZER)}), _Listing("holzer"))),
        _Listing("holzer_trials"), _Listing("damped_modes"),
        When(has("critical_speeds"), (
            Text("torsion_critical", {"source": Citation(_ORDERS)}), _Listing("critical_speeds"), Shown(("campbell",)),
        )),
        When(_is_forced, (_vibration, Shown(("torsional_response",)))),
        Lines("torsional_dampers", intro="torsion_dampers"),
    ), has("torsional_discs")),
)  # fmt: skip
