"""Results of a machine as the sections of its note tell them."""

from __future__ import annotations

import math
import operator
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.cylinder_forces import force_functions
from crankwork.analysis.rounding_noise import summary_without_rounding, without_rounding
from crankwork.analysis.vector_polygons import position_step, positions, worked_position
from crankwork.formula.calculation_lines import DelayedLine, FormulaLine, Line, ValueLine
from crankwork.formula.expression import Expression, Number, Operation, Symbol
from crankwork.locale import capital, has_text, translate
from crankwork.machine import Machine
from crankwork.mechanism.structure import Structure, structure
from crankwork.note.document import Block, Equation, Figure, Paragraph, Run, Runs, Table, listed
from crankwork.note.equations import with_area
from crankwork.note.lines import Group, cycle_lines, lines_of
from crankwork.note.options import NoteOptions
from crankwork.note.readings import reading
from crankwork.note.table_width import is_narrow
from crankwork.note.wording import Words, named
from crankwork.quantities.key import key_of
from crankwork.report.display import is_per_area, key_unit, label
from crankwork.report.figures import drawings, figure_names
from crankwork.report.look import figure_title, kind_of
from crankwork.report.tables import any_nonzero
from crankwork.show.canvas import ChartLayout, use_layout
from crankwork.show.scene import Drawing
from crankwork.units import from_si

# figures that are no curves
_CONSTRUCTED = (
    "position_plans", "velocity_plan", "acceleration_plan", "force_plans", "zhukovsky_lever", "centrodes",
    "wittenbauer",
)  # fmt: skip
# what a note shows the formula of when it is not to show all
ESSENTIAL = frozenset((
    "disc_inertia", "polar_moment", "equivalent_length", "torsional_stiffness", "shaft_inertia", "equivalent_inertia",
    "equivalent_node_distance", "damper_inertia_ratio", "optimum_tuning", "optimum_damping_ratio", "optimum_damping",
    "optimum_stiffness", "least_magnification",
    "mobility", "bearing_force_x", "bearing_force_y", "small_end_load", "big_end_inertia_force", "piston_pin_force",
    "rod_centre_distance", "rod_length", "rod_ratio", "rod_small_end_mass", "rod_big_end_mass", "diagram_pressure",
    "speed", "mean_piston_speed", "piston_displacement", "piston_velocity", "piston_acceleration", "rod_angle",
    "residual_fraction", "intake_temperature", "volumetric_efficiency", "compression_pressure", "air_amount_needed",
    "fresh_charge_amount", "fresh_charge_heat", "molar_change_ideal", "molar_change", "working_mixture_heat",
    "mixture_heat", "product_heat_constant", "product_heat_slope", "product_heat_constant_pressure",
    "combustion_energy", "combustion_temperature", "compression_temperature", "combustion_celsius",
    "combustion_pressure", "pressure_rise_ratio", "afterexpansion", "expansion_pressure", "expansion_temperature",
    "theoretical_mean_pressure", "indicated_mean_pressure", "effective_mean_pressure", "effective_power",
    "effective_torque", "burnt_fraction", "pressure_rise", "swept_volume", "clearance_volume", "indicated_work",
    "indicated_power", "reciprocating_mass", "rotating_mass", "gas_force", "inertia_force", "piston_force",
    "side_force", "rod_force", "radial_force", "tangential_force", "crank_torque", "total_torque",
    "mean_total_torque", "mean_driving_torque", "mean_torque", "firing_interval", "crankpin_radial_force",
    "crankpin_tangential_force", "crankpin_load", "mean_crankpin_load", "main_journal_load", "bearing_pressure_max",
    "plane_moment", "plane_moment_x", "plane_moment_y", "plane_angle", "plane_mass", "plane_radius", "sector_angle",
    "rotor_unbalance_x", "rotor_couple_x", "unbalanced_force_along", "unbalanced_force_across", "unbalanced_couple",
    "tractive_effort_variation",
    "swaying_couple", "reciprocating_moment", "hammer_blow", "lifting_rotation", "lifting_speed",
    "order_inertia_force", "free_force", "free_moment", "counterweight_moment", "excess_work", "flywheel_inertia",
    "speed_fluctuation", "point_x", "point_y", "point_velocity", "point_acceleration", "link_angle",
    "link_angular_velocity", "link_angular_acceleration", "slider_displacement", "slider_velocity",
    "slider_acceleration", "link_inertia_force", "link_inertia_torque", "joint_force", "normal_force", "driver_force",
    "driver_displacement", "driver_velocity", "reduced_inertia", "reduced_inertia_1", "reduced_torque",
    "static_torque", "dynamic_torque", "balancing_torque", "driving_torque", "shaking_force", "motor_power",
    "motor_ratio", "gas_pressure", "cylinder_volume", "shaft_power", "work_per_cycle",
    "turning_moment", "stroke_work", "shearing_force", "rim_mass", "efficiency", "free_air_delivery",
    "clearance_volumetric_efficiency",
    "needed_stages", "stage_pressure_ratio", "stage_flow", "stage_power", "stage_saving", "cylinder_heat",
    "cooler_heat", "water_flow", "clearance_ratio", "swept_flow", "returned_power", "piston_rod_load",
    "crosshead_load", "mean_rod_load", "vessel_flow", "flow_pulsation", "vessel_volume_change", "vessel_saving",
))  # fmt: skip
# groups that every note shows all of
_WHOLE = ("test", "burning", "clutch")
# masses of a rod, which stand with those that they are parts of
_OF_ROD = ("rod_small_end_mass", "rod_big_end_mass", "rod_centre_distance")
# height of the figures of a linkage over that elsewhere
_LOWER = 0.62
# significant digits of the values of a note that does not show all
_DIGITS = 4
# figures of a note that does not show all, and those that a school adds to them
_MAIN_FIGURES = frozenset((
    "kinematics", "indicator", "pressure", "piston_forces", "crankpin_forces", "total_torque", "crankpin_polar",
    "crankpin_wear", "main_journal_polar", "balance_orders", "excess_work", "position_plans", "velocity_plan",
    "acceleration_plan", "torques", "joint_forces", "force_plans", "reduced_inertia", "wittenbauer", "comparison",
    "turning_moment", "driver", "chambers", "speed", "sliders", "balance_polygons", "unbalanced", "stage_indicator",
    "rod_loads", "torsional_modes", "campbell", "torsional_response", "pump_flow", "log_indicator",
    "combustion", "recorded_cycles", "zhukovsky_lever", "willans",
))  # fmt: skip
_OF_SCHOOL = {"vi": frozenset(("brix", "tolle", "indicator", "big_end_polar", "crankpin_load")),
              "ru": frozenset(("indicator", "crankpin_load"))}  # fmt: skip
# figures of a piston that are read at half the width of the text; charts of notes, lower than elsewhere, and these
_SMALL = frozenset((
    "indicator", "pressure", "kinematics", "tolle", "piston_forces", "rod_forces", "crankpin_forces", "torque",
    "crankpin_polar", "crankpin_load", "big_end_polar", "small_end_polar", "crankpin_wear", "balance_orders",
    "excess_work", "wittenbauer", "brix",
))  # fmt: skip
# those that are large enough where nothing stands beside them either
_ROUND = frozenset(("crankpin_wear",))
_LOW, _HALF = ChartLayout(tall=0.65), ChartLayout(width=267.0, left=64.0, right=10.0, tall=0.6)
# what a crank gear of its own has no need of
_OF_ENGINES = ("total_torque", "main_journal", "journal_share")
# values without a formula that a table of their own gives
_TABLED = ("free_force", "free_moment", "firing_angle", "cylinder_count", "bearing_load_max", "mean_bearing_load")
# what follows from a transfer function, which stands before it
_OF_TRANSFER = {
    f"{key}{order}": f"{transfer}{order}"
    for key, transfer in (("piston_velocity", "piston_transfer_1"), ("piston_acceleration", "piston_transfer_2"))
    for order in ("", "_first_order", "_second_order")
} | {"inertia_acceleration": "piston_transfer_2.inertia"}
TRANSFER = tuple(_OF_TRANSFER.values())


@dataclass
class Material:
    """Results and what is chosen, and what follows from both; remembers what the note has shown already."""

    results: Results  # A crank gear as an engine of one cylinder
    options: NoteOptions  # Language and what else is chosen
    has_engine: bool = True  # Whether the machine says what engine it is, and not only its crank gear is known
    plan_difference: float | None = None  # The largest of what was read on plans, once they stand in the note
    _shown: set[tuple[object, ...]] = field(default_factory=set)
    _shown_figures: set[str] = field(default_factory=set)
    _keys: set[str] = field(default_factory=set)
    _formulas: set[str] = field(default_factory=set)

    @property
    def machine(self) -> Machine:
        """The machine."""
        return self.results.machine

    @property
    def full(self) -> bool:
        """Whether every formula is shown, and tables have the step of the machine."""
        return self.options.full

    @property
    def digits(self) -> int:
        """Significant digits of values."""
        return 6 if self.full else _DIGITS

    @property
    def order(self) -> str:
        """The school whose order of sections is followed."""
        return self.options.order

    @property
    def has_free_moments(self) -> bool:
        """Whether inertia forces of the cylinders make a moment."""
        listing = self.results.listings.get("balance")
        moments = None if listing is None else listing.columns.get("free_moment")
        return moments is not None and bool(np.any(np.nan_to_num(moments)))

    @property
    def has_piston(self) -> bool:
        """Whether the motion of a piston is known, which has formulas of its own."""
        return "piston_displacement" in self.results.columns

    def has(self, key: str) -> bool:
        """Return whether the results have a column, a single value, a table or a listing of this name."""
        results = self.results
        return any(key in known for known in (results.columns, results.summary, results.tables, results.listings))

    @cached_property
    def summary(self) -> Mapping[str, float]:
        """Single values by key, as tables print them. [SI]"""
        return summary_without_rounding(self.results)

    @property
    def per_area(self) -> bool:
        """Whether forces are divided by the piston area; notes of the Vietnamese school do so where they can."""
        return self.has_piston and (self.options.per_area or (self.order == "vi" and "piston_area" in self.summary))

    def area(self, key: str) -> float | None:
        """Return the piston area by which tables divide a quantity, None where they do not. [m2]"""
        return self.summary["piston_area"] if self.per_area and is_per_area(key) else None

    @cached_property
    def words(self) -> Words:
        """The words of the language."""
        return Words(
            self.options.language,
            per_area=self.per_area,
            period=self.results.period,
            is_partial="crank_range" in self.results.summary,
            has_names=not self.has_piston,
            digits=5 if self.has_piston and self.full else 4,
        )

    @cached_property
    def structure(self) -> Structure | None:
        """Mobility and groups of a linkage that was drawn."""
        return structure(self.machine.drawn)[0]

    @cached_property
    def positions(self) -> Array:
        """Where tables between the text have rows: the positions of plans as far as they are reached. [deg]"""
        return self.results.grid.degrees if self.has_piston else positions(self.machine)

    @property
    def first(self) -> int | None:
        """Number of the first position, counted from a crank angle of zero; none where they have no numbers."""
        numbers = self.positions / position_step(self.machine)
        return round(float(numbers[0])) if np.allclose(numbers, np.round(numbers)) else None

    def shown(self, key: str, values: Array) -> Array:
        """Return values [SI] in the unit in which tables show their key."""
        unit = key_unit(key, per_area=self.per_area)
        if self.per_area and unit != key_unit(key):
            values = values / self.summary["piston_area"]
        # adding zero turns -0.0 into 0.0
        return np.asarray(from_si(values, unit) + 0.0)

    @cached_property
    def columns(self) -> Mapping[str, Array]:
        """All columns at the positions, as tables print them. [SI]"""
        if not self.has_piston:
            return without_rounding(self.results.columns_at(self.positions), self.machine.speed)
        # rod functions belong to forces: a machine of which only the motion is known does not need them
        has_forces = "piston_force" in self.results.columns
        functions = force_functions(self.results) if has_forces else {}
        return {**without_rounding(self.results.columns, self.machine.speed), **functions}

    @cached_property
    def groups(self) -> dict[str, Group]:
        """Lines of the trace by the name of their group, those of a linkage worked where its plans are drawn."""
        is_drawn = self.machine.linkage is not None and not self.has_piston
        position = worked_position(self.results) if is_drawn else None
        return {group.name: group for group in lines_of(self.results, position)}

    @cached_property
    def cycle(self) -> tuple[Line, ...]:
        """Lines of the calculation of the cycle."""
        return cycle_lines(self.results) if self.has_piston else ()

    @property
    def position_plan(self) -> Drawing:
        """The positions of a linkage, drawn whether figures are left out or not."""
        return (self.drawn or self._drawings(only=["position_plans"]))["position_plans"]

    def _drawings(
        self, layout: ChartLayout | None = None, only: Collection[str] | None = None
    ) -> Mapping[str, Drawing]:
        """Return the figures of these names, all without names; in a layout, or in that of the text."""
        if layout is None:
            # the curves of a linkage are many
            tall = _LOWER if self.machine.linkage is not None else 1.0
            layout = _LOW if self.has_piston else ChartLayout(tall=tall)
        with use_layout(layout):
            return drawings(self.results, language=self.options.language, per_area=self.per_area, only=only)

    @cached_property
    def drawn(self) -> Mapping[str, Drawing]:
        """Figures that this note may show, by name; none if they are left out."""
        names = figure_names(self.results, self.options.language) if self.options.figures else []
        return self._drawings(only=[name for name in names if self.full or kind_of(name) in self._figures])

    @cached_property
    def _small(self) -> Mapping[str, Drawing]:
        """Figures by name that are half as wide as the text."""
        return self._drawings(_HALF, [name for name in self.drawn if kind_of(name) in _SMALL and self.has_piston])

    def leave_out(self, *names: str) -> None:
        """Show no figures of these names any more: others hold what they show."""
        self._shown_figures |= set(names)

    def lines(self, group: str, *kinds: str) -> list[Line]:
        """Return the lines of a group, or those of it that give some quantities; none if there is no such group."""
        lines = self.groups[group].lines if group in self.groups else ()
        return [line for line in lines if not kinds or key_of(line.key).quantity in kinds]

    def equations(self, group: str, *kinds: str, first: bool = False) -> list[Block]:
        """Return equations of the lines of a group that the note has not shown yet.

        Lines without a formula that are in a table are left to the table.
        """
        selected = self.lines(group, *kinds)
        if self.has_piston:
            selected = [row for row in selected if not isinstance(row, ValueLine) or _kind(row) not in _TABLED]
        if not self.full and group not in _WHOLE:
            selected = list(in_one_formula(selected)) if self.has_piston else selected
            # places of points stand with the motion, masses of the rod with the others
            places = () if group in ("motion", "driver") else ("point_x", "point_y")
            elsewhere = (*places, *(() if group == "masses" else _OF_ROD))
            selected = [row for row in selected if _kind(row) in ESSENTIAL and _kind(row) not in elsewhere]
            # the derivative of a sum is that of its terms
            selected = [row for row in selected if not row.key.startswith("reduced_inertia_1.")]
        # of families, such as the journals of a shaft, a table has the others
        if group in _WHOLE:
            return self.worked(selected)
        if first or not self.full:
            return self.worked(_first(selected))
        return self.worked(_first(selected, by_part=True) if self.has_piston else selected)

    def worked(
        self, lines: Iterable[Line], marks: Mapping[str, str] | None = None, *, again: bool = False
    ) -> list[Block]:
        """Return equations of lines that the note has not shown yet; `marks`: symbols that some keys have here.

        `again`: also of lines that were shown before.
        """
        blocks: list[Block] = []
        if self.results.method.kinematics == "textbook":
            lines = list(lines)
            self._formulas |= {_formula_name(step) for step in lines if step.key in TRANSFER}
            lines = in_one_formula(lines)
        for line in map(self._plain, lines):
            mark = _identity(line, by_name=self.full) if self.has_piston else (line.key, line.value)
            if mark in self._shown and not again:
                continue
            self._shown.add(mark)
            has_definition = (self.has_piston or _kind(line) == "plane_angle") and (
                not again or line.key == "excess_work.exact"
            )
            defined = line.key if isinstance(line, ValueLine) and has_definition else ""
            area = self.area(line.key) or 0.0
            step: Line = line
            if self.per_area and not area and isinstance(line, FormulaLine):
                step = with_area(line, self.summary["piston_area"])
            symbol = (marks or {}).get(line.key) or self.words.symbol(line.key)
            blocks.append(Equation(step, symbol=symbol, defined=defined, area=area, digits=self.digits))
            self._keys.add(line.key)
            self._formulas.add(_formula_name(line))
        return blocks

    def _plain(self, line: Line) -> Line:
        """Return a line of the cycle, values without the mark of the cycle where the diagram gives the same."""
        if isinstance(line, FormulaLine):
            named = [(name, kind) for name, key in line.named if (kind := self.of_cycle(key)) != key]
            if named:
                line = line._replace(named=tuple({**dict(line.named), **dict(named)}.items()))
        elif isinstance(line, ValueLine) and not self.summary.get(line.key, line.value):
            line = line._replace(value=0.0)
        return line._replace(key=self.of_cycle(line.key))

    def of_cycle(self, key: str) -> str:
        """Return a key without the mark of the cycle where the value is the same without it."""
        kind, name = key_of(key)
        same = name == "cycle" and math.isclose(self.summary.get(key, math.inf), self.summary.get(kind, math.nan))
        return kind if same else key

    def is_shown(self, key: str) -> bool:
        """Return whether an equation has given a value."""
        return key in self._keys

    def intro(self, key: str, equations: list[Block], **values: Run | Runs) -> Iterator[Block]:
        """Yield a sentence and the equations that it leads to; nothing if there are none."""
        if equations:
            yield self.words.paragraph(key, **values)
            yield from equations

    def worked_at(self, group: str) -> Iterator[Block]:
        """Yield the sentence that says at which crank angle, or when, a group is worked."""
        degrees = self.groups[group].degrees if group in self.groups else None
        if degrees is not None:
            key = "worked_time" if self.words.period else "worked_at" if self.has_piston else "worked_position"
            sentence = self.words.sentence(key, value=self.words.place_text(degrees))
            if key == "worked_at" and ("row", degrees) not in self._shown and degrees in self.results.grid.degrees:
                self._shown.add(("row", degrees))
                sentence += (" ", *self.words.sentence("worked_row"))
            yield Paragraph(sentence)

    def nonzero(self, *kinds: str) -> list[str]:
        """Return the columns of some kinds that are not zero throughout."""
        return any_nonzero(named(self.columns, *kinds), self.results.columns)

    def of_axes(self, kind: str) -> list[str]:
        """Return the columns of a place, x and y of one point after the other."""
        names = (key_of(key).owner for key in named(self.columns, f"{kind}_x"))
        return [f"{kind}_{axis}.{name}" for name in names for axis in "xy"]

    def presented(self, tables: Iterable[Table | None] = (), names: Iterable[str] = ()) -> Iterator[Block]:
        """Yield tables and figures after sentences that refer to them by number; `names`: kinds of figures."""
        shown_tables = [table for table in tables if table is not None]
        drawn = [
            name
            for kind in names
            for name in self.drawn
            if kind_of(name) == kind and name not in self._shown_figures and (self.full or kind in self._figures)
        ]
        if not self.full:
            # of crankpins that differ the first
            firsts = {kind_of(name): name for name in reversed(drawn)}
            drawn = [name for name in drawn if kind_of(name) not in _OF_CRANKPINS or name in firsts.values()]
        sentences = [*self._referring([table.label for table in shown_tables if table.label], drawn)]
        if sentences:
            yield Paragraph(tuple(run for sentence in sentences for run in (" ", *sentence))[1:])
        for row in self._rows(drawn, shown_tables):
            yield from row
            for name in (block.name for block in row if isinstance(block, Figure)):
                read = reading(kind_of(name), self, *self._owners(name)[:1])
                if read is not None:
                    yield read

    def _owners(self, name: str) -> Sequence[str]:
        """Return the crankpins that a figure shows, or the sliding piece or vessel that one of several shows."""
        key, number = _OF_EACH.get(kind_of(name)), name.rpartition("_")[2]
        if key is None:
            return crankpins(name, self.results.columns)
        owners = [key_of(column).owner for column in named(self.columns, key)]
        return owners[int(number) - 1 if number.isdecimal() else 0 :]

    def _referring(self, tables: Sequence[str], names: Sequence[str]) -> Iterator[Runs]:
        """Yield the sentences that refer to tables by label and to figures by name; a linkage has many kinds."""
        labels: dict[str, list[str]] = {"tables": [*tables]}
        for name in names if self.has_piston else ():
            is_alone = name in _CONSTRUCTED and not tables
            labels.setdefault("constructions" if is_alone else "figures", []).append(f"f:{name}")
        references = {what: self._reference(what, shown) for what, shown in labels.items() if shown}
        if {"tables", "figures"} <= references.keys():
            yield self.words.sentence("see_both", **references)
        else:
            yield from (self.words.sentence(f"see_{what}", **references) for what in references)
        for name in () if self.has_piston else names:
            yield self.words.sentence("figure_shows", what=self._title(name), figure=listed([f"f:{name}"]))

    def _reference(self, what: str, labels: list[str]) -> Runs:
        """Return how a sentence names tables or figures: `figures 3, 4`."""
        kind = "table" if what == "tables" else "figure"
        return self.words.sentence(f"{kind}{'s' * (len(labels) > 1)}_named", **{f"{kind}s": listed(labels)})

    def _rows(self, names: Sequence[str], tables: Sequence[Table]) -> Iterator[tuple[Figure | Table, ...]]:
        """Yield figures and tables, small ones in pairs side by side."""
        small = [name for name in names if name in self._small]
        narrow = [table.label for table in tables if self.has_piston and is_narrow(table)]
        halves = [*small, *narrow][: len(small + narrow) // 2 * 2]
        left: tuple[Figure | Table, ...] = ()
        blocks: tuple[Figure | Table, ...] = (*(self._figure(name, half=name in halves) for name in names),
                  *(replace(table, half=table.label in halves) for table in tables))  # fmt: skip
        for block in blocks:
            if not block.half:
                yield (block,)
            elif left:
                yield (*left, block)
                left = ()
            else:
                left = (block,)

    @cached_property
    def _figures(self) -> frozenset[str]:
        """Kinds of figures that a note shows when it is not to show all."""
        return _MAIN_FIGURES | _OF_SCHOOL.get(self.order, frozenset())

    def remaining_figures(self) -> list[str]:
        """Return the names of figures that no section has shown."""
        left = [name for name in self.drawn if name not in self._shown_figures]
        # a crank gear without an engine has no journals of its own
        return [name for name in left if self.has_engine or not self.has_piston or not name.startswith("main_")]

    def remaining_lines(self) -> list[Block]:
        """Return equations of lines that no section has shown: single values, and formulas that are new."""
        all_lines = (line for group in self.groups.values() for line in group.lines)
        # a table adds up the forces on a shaft
        lines = [line for line in all_lines if not isinstance(line, ValueLine | DelayedLine)
                 and not line.key.startswith("bearing_force_")]  # fmt: skip
        if not self.has_engine:
            lines = [line for line in lines if not line.key.startswith(_OF_ENGINES)]
        return self.worked(
            line for line in lines if line.key not in self._keys and _formula_name(line) not in self._formulas
        )

    def _title(self, name: str) -> str:
        """Return the caption of a figure, of a shaft with several crankpins also which of them."""
        pins = crankpins(name, self.results.columns)
        engine = self.machine.engine
        several = engine is not None and len({place.throw for place in engine.layout.places}) > 1
        if name == "balance_orders" and not self.has_free_moments:
            return capital(translate("figures.balance_forces", self.words.language))
        if not pins or not several:
            return capital(figure_title(name, self.words.language))
        title = figure_title(kind_of(name), self.words.language)
        return self.words.phrase("of_pin" if len(pins) == 1 else "of_pins", title=title, pins=", ".join(pins))

    def _figure(self, name: str, *, half: bool) -> Figure:
        """Return a figure with its caption, and what who cannot see it is told."""
        self._shown_figures.add(name)
        kind, title = kind_of(name), self._title(name)
        drawing = (self._small if half or kind in _ROUND & self._small.keys() else self.drawn)[name]
        if kind == "crankpin_polar" and self.machine.engine is None and self.words.has_names:
            # the crankpin has a name
            title = capital(drawing.title)
        text = seen(name, self)
        alt = f"{title}. {text}".rstrip(". ") + "."
        if not text and has_text(f"seen.{kind}"):
            alt = translate(f"seen.{kind}", self.words.language)
        return Figure(drawing, title, alt, f"f:{name}", half=half, to_scale=kind in _CONSTRUCTED)


def _kind(line: Line) -> str:
    return key_of(line.key).quantity


def _identity(line: Line, *, by_name: bool) -> tuple[object, ...]:
    """Return the mark that equal lines share; `by_name`: also those of two quantities with one formula differ."""
    if not isinstance(line, FormulaLine):
        return (line.key, line.value)
    if not by_name:
        return (str(line.expression), *line.values.values())
    mark = key_of(line.key).owner
    return (line.formula.name, *line.values.values(), "" if mark == "cycle" else mark)


def _formula_name(line: Line) -> str:
    """Return the name of the formula of a line; of a sum what it sums, of arithmetic in place what it gives."""
    if not isinstance(line, FormulaLine):
        return key_of(line.key).quantity
    return line.formula.name if line.formula.source else "".join(letter for letter in line.key if not letter.isdigit())


def _family(line: Line) -> str:
    """Return what lines of one formula share, of arithmetic in place how it is written."""
    in_place = isinstance(line, FormulaLine) and not line.formula.source
    return str(line.expression) if isinstance(line, FormulaLine) and in_place else _formula_name(line)


def _first(lines: list[Line], *, by_part: bool = False) -> Iterator[Line]:
    """Yield the first line of each formula that is not zero, and for each quantity the first value without one.

    `by_part`: also of each kind of part, such as the masses that rotate, whatever its number is.
    """
    first: dict[tuple[str, str, str], Line] = {}
    for line in lines:
        kind, owner = key_of(line.key)
        part = "".join(letter for letter in owner if letter.isalpha()) if by_part else ""
        mark = (_family(line), kind, part)
        if mark not in first or (line.value and not first[mark].value):
            first[mark] = line
    yield from first.values()


_SHOWN: Mapping[str, tuple[str, ...]] = {
    "log_indicator": ("cylinder_volume", "diagram_pressure"),
    "combustion": ("gross_heat_rate", "gross_heat", "burnt_fraction"),
    "kinematics": ("piston_displacement", "piston_velocity", "piston_acceleration"),
    "pressure": ("gas_pressure",),
    "indicator": ("gas_pressure",),
    "piston_forces": ("gas_force", "inertia_force", "piston_force"),
    "rod_forces": ("rod_force", "side_force"),
    "crankpin_forces": ("tangential_force", "radial_force", "side_force"),
    "torque": ("crank_torque",),
    "crankpin_polar": ("crankpin_tangential_force", "crankpin_radial_force"),
    "brix": ("piston_displacement",),
    "tolle": ("piston_displacement", "piston_acceleration"),
    "process_force": ("process_force",),
    "total_torque": ("total_torque",),
    "total_tangential_force": ("total_tangential_force",),
    "crankpin_load": ("crankpin_load",),
    "big_end_polar": ("big_end_load",),
    "small_end_polar": ("small_end_load",),
    "excess_work": ("kinetic_energy_change",),
    "crank_speed": ("crank_speed",),
    "crankpin_wear": ("wear_sum",),
    "balance_orders": ("free_force", "free_moment"),
    "torque_harmonics": ("harmonic_amplitude", "total_harmonic_amplitude"),
}
# columns of which each has a figure
_OF_EACH = {"rod_loads": "crosshead_load", "pump_flow": "vessel_flow"}
# figures that show each crankpin whose load is another
_OF_CRANKPINS = ("crankpin_polar", "crankpin_load", "crankpin_wear")
_OVER_CYCLE = {"accumulated_torque": "accumulated_torque", "main_journal_polar": "main_journals"}


def seen(name: str, shown: Material) -> str:
    """Return the quantities of a figure with their extreme values."""
    keys = _SHOWN.get(kind_of(name), ())
    pins = crankpins(name, shown.results.columns)
    if pins:
        keys = tuple(f"{key}.{pin}" for pin in pins for key in keys)
    if name in _OVER_CYCLE:
        keys = shown.results.groups.get(_OVER_CYCLE[name], ())
    return "; ".join(text for text in (_range(key, shown) for key in keys) if text)


def crankpins(name: str, columns: Iterable[str]) -> tuple[str, ...]:
    """Return the numbers of the crankpins that a figure shows: of a polar diagram one, none of other figures."""
    kind = kind_of(name)
    pins = tuple(key_of(key).owner for key in columns if key.startswith("crankpin_load."))
    if kind not in _OF_CRANKPINS or not pins:
        return ()
    if kind != "crankpin_polar":
        return pins
    return (name.rpartition("_")[2],) if name != kind else pins[:1]


def _range(key: str, shown: Material) -> str:
    """Return the least and the largest value of a column or listing, in words."""
    words, values = shown.words, shown.columns.get(key)
    if values is None:
        listings = (listing.columns for listing in shown.results.listings.values())
        values = next((columns[key] for columns in listings if key in columns), None)
    if values is None or not len(values):
        return ""
    values = shown.shown(key, values)
    low, high = (words.number(float(value), digits=4) for value in (values.min(), values.max()))
    named = label(key, words.language)
    return words.phrase("seen", quantity=named, low=low, high=f"{high}\u00a0{words.unit(key)}".rstrip())


def in_one_formula(lines: Iterable[Line]) -> Iterator[Line]:
    """Yield lines, what they only pass on put into them: v = R ω (sin φ + ...), β = arcsin(λ sin φ)."""
    all_lines = list(lines)
    known = {item.key: item for item in all_lines if isinstance(item, FormulaLine)}
    joined: dict[str, FormulaLine | None] = {}
    if "rod_angle" in known and "rod_sine" in known:
        sine = known["rod_sine"]
        tree = Operation(np.arcsin, (sine.expression,))
        joined["rod_angle"] = known["rod_angle"]._replace(values=sine.values, tree=tree, named=sine.named)
    for key, factor in _OF_TRANSFER.items():
        line, transfer = known.get(key), known.get(factor)
        if line is not None and transfer is not None and (product := _joined(line, transfer)) is not None:
            joined[key], joined[factor] = product, None
    for each in all_lines:
        replaced = joined.get(each.key, each)
        if replaced is not None:
            yield replaced


def _joined(line: FormulaLine, transfer: FormulaLine) -> FormulaLine | None:
    """Return a product with a transfer function as a product with what that is a product of."""
    match line.expression, transfer.expression:
        case (
            Operation(operator.mul, (Symbol(name), speed)),
            Operation(operator.mul, (first, second))
            | Operation(operator.truediv, (Operation(operator.mul, (first, second)), _)) as whole,
        ):
            factor: Expression = Operation(operator.mul, (first, speed))
            divided = whole.function is operator.truediv
            if divided and isinstance(whole.operands[1], Number):
                factor, divided = Operation(operator.truediv, (factor, whole.operands[1])), False
            tree = Operation(operator.mul, (factor, second))
            if divided:
                tree = Operation(operator.truediv, (tree, whole.operands[1]))
            values = {key: value for key, value in line.values.items() if key != name}
            named = (*transfer.named, *(symbol for symbol in line.named if symbol[0] != name))
            return line._replace(values={**transfer.values, **values}, tree=tree, named=named)
    return None
