"""Bearings and balance of cylinders in a note: loads, wear, free forces and moments, masses in planes."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator

import numpy as np

from crankwork.formula.calculation_lines import FormulaLine, ValueLine
from crankwork.formula.expression import Operation, Symbol
from crankwork.formula.traced_value import HarmonicCoefficient, ProcedureValue, in_order
from crankwork.mechanism.mechanism import Crank
from crankwork.note import layout
from crankwork.note.document import Block, Citation, Equation, Math, Reference, Runs, Strong
from crankwork.note.equations import value_box
from crankwork.note.layout import EQUALS, MINUS, SPACE, Digits, PrintedEquation, Sign, Upright, row
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
    machine_has,
    turning,
    works,
)
from crankwork.note.symbols import number_box, symbol_box
from crankwork.note.tables import listing_table
from crankwork.note.wording import in_display_unit, named
from crankwork.quantities.key import key_of

_MAINS = "kolchin_demidov_2008, ch. 7"
_SOURCE = "kolchin_demidov_2008, ch. 9"
_ON_CRANKPIN = (
    "big_end_inertia_force", "crankpin_radial_force", "crankpin_tangential_force", "crankpin_load",
)  # fmt: skip
_STATISTICS = (
    "mean_crankpin_load", "bearing_load_ratio", "bearing_pressure", "bearing_pressure_max", "reversal_duration",
    "reversal_ratio",
)  # fmt: skip
_ON_MAINS = (
    "shaft_unbalance", "unbalance_force", "unbalance_weight", "unbalance_tangential_force", "journal_share",
    "main_journal_load",
)  # fmt: skip
_ON_PINS = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load", "main_journal_load")
_BALANCE = "den_hartog_1956, ch. 5"
# share of the largest force below which one is not seen beside it
_SEEN = 0.05
_SHAKING = ("shaking_force_x", "shaking_force_y", "shaking_force", "shaking_moment")
_OF_ORDERS = (
    "acceleration_coefficient", "order_inertia_force", "force_factor", "free_force", "moment_factor", "free_moment",
    "rotating_mass", "counterweight_moment", "best_balanced_share", "best_counterweight_moment", "shaft_unbalance",
    "unbalance_force",
)  # fmt: skip


def _columns(material: Material) -> list[str]:
    return [key for key in material.results.groups.get("bearings", ()) if key in material.columns]


def _of_pin_and_rod(material: Material) -> list[str]:
    """Return the columns of crankpin and rod; without the big end where it carries what the crankpin does."""
    return [key for key in _columns(material) if material.full or key != "big_end_load" or not _is_same(material)]


def _is_same(material: Material) -> bool:
    """Return whether one rod alone is on each crankpin, so that its big end carries the same load."""
    pin, columns = "crankpin_load.1", material.columns
    return {pin, "big_end_load"} <= columns.keys() and np.allclose(columns[pin], columns["big_end_load"])


def _on_big_end(material: Material) -> Iterator[Block]:
    """Yield the load of the big end along the rod and across it, turned by the crank angle and that of the rod."""
    for line in material.lines("bearings", "bearing_force_x", "bearing_force_y"):
        if (
            key_of(line.key).owner != "big_end"
            or not isinstance(line, FormulaLine)
            or len(line.named) != len(("along", "across"))
        ):
            continue
        (radial, _), (tangential, _) = line.named
        cosine, sine = Symbol("cos_phi_beta"), Symbol("sin_phi_beta")
        first, second, join = (
            (cosine, sine, operator.add) if line.key.startswith("bearing_force_x") else (sine, cosine, operator.sub)
        )
        along, across = (
            Operation(operator.mul, (Symbol(name), factor)) for name, factor in ((radial, first), (tangential, second))
        )
        values = {**line.values, "cos_phi_beta": line.values["cos_psi"], "sin_phi_beta": line.values["sin_psi"]}
        yield from material.worked([line._replace(tree=Operation(join, (along, across)), values=values)])
    yield from material.worked(material.lines("bearings", "big_end_load"), again=True)


def _on_journal(material: Material) -> Iterator[Block]:
    """Yield the forces on the throws beside a main journal with their shares, and the load that they add up to."""
    words, values = material.words, {line.key: line.value for line in material.lines("bearings")}
    loads = [key for key in values if key.startswith("main_journal_load.")]
    # the first one between two throws
    owner = f"main_journal.{key_of(loads[min(1, len(loads) - 1)]).owner}"
    axes = ("bearing_force_x", "bearing_force_y")
    parts = [key.partition(f".{owner}.")[2] for key in values if key.startswith(f"{axes[0]}.{owner}.")]
    forces = [[values.get(f"{axis}.{part}", 0.0) for part in parts] for axis in axes]
    held = [[*(values[f"{axis}.{owner}.{part}"] for part in parts), values[f"{axis}.{owner}"]] for axis in axes]
    along = [max(range(len(axes)), key=lambda axis: abs(forces[axis][k])) for k in range(len(parts))]
    shares = [-held[axis][k] / (forces[axis][k] or 1.0) for k, axis in enumerate(along)]
    kinds = [part if part.partition(".")[2] else f"rod.{part}" for part in parts]
    names = [words.phrase(f"acts_{kind}", number=number) for kind, _, number in (kind.partition(".") for kind in kinds)]
    shown = material.shown(axes[0], np.array(held)).tolist()
    count = words.decimals([value for each in shown for value in each], digits=4)
    columns = [
        [*names, words.column("total")],
        [*(words.number(share, digits=4) for share in shares), ""],
        *(
            [*words.column_texts(each, decimals=count), ""]
            for each in material.shown(axes[0], np.array(forces)).tolist()
        ),
        *(words.column_texts(each, decimals=count) for each in shown),
    ]
    share, unit = words.symbol("journal_share"), words.unit(axes[0])
    of_axes = [words.symbol(axis) for axis in axes]
    titles: list[str | Runs] = ["row", (Math(share),), *(words.titled(axis) for axis in axes)]
    titles += [("−", Math(share), " ", Math(symbol), f", {unit}") for symbol in of_axes]
    *rows, last = zip(*columns, strict=True)
    number = key_of(owner).owner
    if rows:
        yield words.paragraph("on_journal", number=number, table=Reference("t:on_journal"))
        yield words.table("on_journal", titles, [*rows, tuple(map(Strong, last))], "lrrrrr", "t:on_journal")
    sums = [line for line in material.lines("bearings") if line.key in (f"{axis}.{owner}" for axis in axes)]
    for symbol, line, value in zip(of_axes, sums, (column[-1] for column in columns[-2:]), strict=True):
        total = row(symbol_box(words.symbol(line.key)), EQUALS, MINUS, Sign("Σ"), symbol_box(share), SPACE,
                    symbol_box(symbol), EQUALS, *([MINUS] if value.startswith("−") else []),
                    Digits(value.lstrip("−")), SPACE, Upright(unit))  # fmt: skip
        yield Equation(line, printed=PrintedEquation((total,), words.symbol(line.key)))
    yield from material.worked(material.lines("bearings", "main_journal_load")[int(number) - 1 :][:1])


def _has_pin(material: Material) -> bool:
    return material.has_piston and bool(_columns(material))


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
_OF_ROD: tuple[Part, ...] = (
    Lines("bearings", ("big_end_load",)), Lines("bearings", ("piston_pin_force", "small_end_load"), intro="small_end"),
)  # fmt: skip
_LOADS, _OF_WEAR = Rows("bearing_loads", "loads"), Rows("crankpin_wear", "crankpin_wear")
_WEAR: tuple[Part, ...] = (
    _oil_hole, Shown(("crankpin_wear",), (in_full(_OF_WEAR),)),
)  # fmt: skip


def _orders(material: Material) -> Iterator[Block]:
    """Yield the table of the free forces of each order."""
    words, summary = material.words, material.summary
    orders = named(summary, "free_force")
    if not any(summary[key] for key in named(summary, "free_force", "shaking_moment_amplitude")):
        yield words.paragraph("no_free_forces", count=key_of(orders[-1]).owner)
        return
    yield words.paragraph("free_forces", table=Reference("t:orders"))
    kinds = [kind for kind in ("free_force", "shaking_moment_amplitude") if named(summary, kind)]
    sizes = [
        words.column_texts(
            in_display_unit(kind, [summary[key] for key in named(summary, kind)]), digits=material.digits
        )
        for kind in kinds
    ]
    rows = list(zip((key_of(key).owner for key in orders), *sizes, strict=True))
    titles: list[str | Runs] = ["order_of_turn", *(words.titled(kind) for kind in kinds)]
    yield words.table("linkage_orders", titles, rows, "c" + "r" * len(kinds), "t:orders")


def _counterweight(material: Material) -> Iterator[Block]:
    """Yield the best counterweight from the first harmonic of the shaking force, and where it stands."""
    words, results = material.words, material.results
    key, driver = "counterweight_moment", material.machine.mechanism.driver
    node, angle = results.trace[key].node, results.summary.get("counterweight_angle")
    if angle is None or not isinstance(node, ProcedureValue) or node.by is None or not isinstance(driver, Crank):
        return
    yield words.paragraph("counterweight", value=words.amount(angle, "deg", digits=material.digits))
    waves = {
        f"{wave.node.operands[0].key[-1]},{wave.node.part[0]}": wave.value
        for wave in in_order([node.by])
        if isinstance(wave.node, HarmonicCoefficient)
    }
    letters, numbers = list[layout.Box](), list[layout.Box]()
    for first, second, sign in (("x,c", "y,s", driver.direction), ("y,c", "x,s", -driver.direction)):
        names = [symbol_box(f"{words.symbol('shaking_force')},{name}") for name in (first, second)]
        letters.append(layout.Fence(layout.row(names[0], layout.Sign("+" if sign > 0 else "−"), names[1])))
        numbers.append(number_box(abs(waves[first] + sign * waves[second]), words.language, material.digits + 1)[0])
    name, value, rate = symbol_box(words.symbol(key)), results.summary[key], symbol_box(words.symbol("speed"))
    speed = number_box(results.solved.speed, words.language, material.digits + 1)[0]
    shown = value_box(value, "kg*m", words.language, material.digits)
    formula = layout.row(name, layout.EQUALS, _of_harmonic(letters, layout.PRODUCT, rate))
    worked = layout.row(layout.EQUALS, _of_harmonic(numbers, layout.DOT, speed), layout.EQUALS, shown)
    text = f"{words.symbol(key)} = {words.amount(value, 'kg*m', digits=material.digits)}"
    yield Equation(ValueLine(key, value), printed=layout.PrintedEquation((formula, worked), text))


def _of_harmonic(parts: list[layout.Box], times: layout.Box, rate: layout.Box) -> layout.Box:
    """Return half the magnitude of two parts over the square of a speed."""
    first, second, below = (layout.Script(box, None, layout.Upright("2")) for box in (*parts, rate))
    top = layout.Root(layout.row(first, layout.Sign("+"), second))
    return layout.Fraction(top, layout.row(layout.Digits("2"), times, below))


def _worked(material: Material) -> list[Block]:
    """Return the equations of the orders; in a short one neither moments that vanish nor the mass that rotates."""
    left = () if material.full else ("rotating_mass", *(() if material.has_free_moments else ("free_moment",)))
    return material.equations("balance", *(kind for kind in _OF_ORDERS if kind not in left))


def _drawn_orders(material: Material) -> Iterator[Block]:
    """Yield the free forces, drawn where those of several orders are seen."""
    sizes = [np.abs(np.nan_to_num(values)) for key, values in material.results.listings["balance"].columns.items()
             if key in ("free_force", "free_moment")]  # fmt: skip
    # what counterweights leave may be all of it
    seen = sum(len(np.unique(np.round(size[size > _SEEN * size.max()] / size.max(), 3))) for size in sizes)
    table = listing_table(material, "balance", "balance" if material.has_free_moments else "balance_forces")
    figures = ("balance_orders", "balance_ellipses") if material.full or seen > 1 else ()
    return material.presented([table], figures)


_CRANKPIN = Over("crankpin", lambda material: [key for key in _columns(material) if key.startswith("crankpin_")])

SECTIONS = (
    # polar, unrolled and wear in one
    Section("crankpin", (
        Head("crankpin"), *_PIN, *_OF_ROD, _STATED,
        When(lacks(full), (_oil_hole,)),
        Shown((), (_LOADS,)),
        Shown(("crankpin_polar", "crankpin_load", "big_end_polar", "small_end_polar"),
              (Over("crankpin", _of_pin_and_rod),), ("crankpin_wear",)),
        When(full, (Head("wear", 2), *_WEAR)),
    ), _has_pin),
    Section("polar", (
        Head("crankpin"), *_PIN, Shown(("crankpin_polar",), (_CRANKPIN,)),
    ), _has_pin),
    Section("unrolled", (Head("unrolled"), _STATED, Shown(("crankpin_load",), (_LOADS,))), _has_pin),
    Section("big_end", (
        Head("big_end"), Text("big_end"), At("bearings"), _on_big_end, *_OF_ROD,
        Shown(("big_end_polar", "small_end_polar"), (Over("rods", ("big_end_load", "small_end_load")),)),
    ), has("piston_displacement", "big_end_load")),
    Section("wear", (Head("wear"), *_WEAR), has("piston_displacement", "crankpin_wear")),
    # main journals, and the torque along the shaft
    Section("mains", (
        Head("mains"), Text("mains", {"source": Citation(_MAINS)}), At("bearings"), _on_journal,
        When(full, (Lines("bearings", _ON_MAINS),)),
        Shown(("main_journal_polar",), (Over("mains", _group("main_journals")),)),
        When(full, (
            Shown(("main_wear",), (Rows("main_wear", "main_wear"),)), Lines("engine_torque"),
            When(
                lambda material: bool(material.results.groups.get("accumulated_torque")),
                (Head("accumulated", 2), Text("accumulated")),
            ),
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
    Section("planes", (
        Head("planes"), Text("planes", {"source": Citation("khurmi_gupta_2005, ch. 21")}), Lines("planes"),
        Shown(("balance_polygons",), (Rows("planes", "planes"),)),
        When(works("rotor_forces"), (
            Head("rotor_forces", 2), Text("rotor_forces"), At("rotor_columns"), Lines("rotor_columns"),
            Lines("rotor_forces"), Shown(("unbalanced",)),
        )),
    ), machine_has("rotor")),
    Section("balance", (
        Head("balance"), Text("balance"), _worked,
        _drawn_orders,
    ), has("piston_displacement", "balance")),
    Section("balance", (
        Head("linkage_balance"), Text("shaking", {"source": Citation(_BALANCE)}), At("shaking"), Lines("shaking"),
        When(full, (Places("shaking", _SHAKING, "shaking", filled=True),)),
        When(lambda material: bool(named(material.results.summary, "free_force")), (_orders, _counterweight)),
    ), every(turning, has("shaking_force"))),
)  # fmt: skip
