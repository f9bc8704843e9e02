"""The end of a note: comparison with others, checks, main results, what stands nowhere else, sources."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.locale import capital, translate
from crankwork.note.captions import printed_unit
from crankwork.note.data import GEAR, cycle_keys, fixed_distances, link_lengths
from crankwork.note.document import Bibliography, Block, Cell, Figure, ItemList, Math, Paragraph, Reference, Runs, Table
from crankwork.note.gas import two_bases
from crankwork.note.material import Material
from crankwork.note.parts import Head, Section, Shown, drawn, every, full, has
from crankwork.note.readings import agree, concluded, concluded_of_linkage
from crankwork.note.table_width import SIZES, fits
from crankwork.note.tables import position_tables, quantity_columns, value_row, value_table
from crankwork.note.wording import Words, named
from crankwork.preparation.prepared import Notice
from crankwork.quantities.key import key_of
from crankwork.report.display import display_key, displayed, key_unit, label
from crankwork.report.drawing import dimensioned, film_of
from crankwork.report.look import kind_of
from crankwork.report.notices import notice_text, plain_assumptions
from crankwork.report.summary import warning_text
from crankwork.report.tables import any_nonzero, comparison_rows, shown_names

_OF_ENGINES = (
    "displacement", "mean_torque.1", "indicated_power.1", "total_torque_max", "total_torque_min", "cylinder_count",
)  # fmt: skip
# what a comparison and a table of main results leave out: where extremes are reached stands beside them
_PLACES = ("_max_angle", "_min_angle", "_max_time", "_min_time")
# main results of linkages; the others are in the full note
_OF_LINKAGES = frozenset((
    "slider_stroke", "time_ratio", "slider_velocity_max", "slider_velocity_min", "slider_acceleration_max",
    "slider_acceleration_min",
    "normal_force_max", "transmission_angle_min", "reduced_inertia_max",
    "static_torque_max", "driving_torque_max", "driving_torque_min", "mean_torque", "mean_driving_torque",
    "efficiency", "mean_efficiency", "motor_power", "standard_motor_power", "shaft_power",
    "driver_force_max", "driver_force_min",
    "shaking_force_max", "excess_work", "flywheel_inertia", "speed_fluctuation", "indicated_work", "indicated_power",
    "plane_mass", "plane_angle", "tractive_effort_variation", "swaying_couple", "hammer_blow", "lifting_speed",
    "crank_speed_max", "crank_speed_min", "steady_speed", "steady_fluctuation", "counterweight_moment",
    "stage_power", "stage_saving", "heat_removed", "overall_isothermal_efficiency", "crosshead_load_tension",
    "crosshead_load_compression", "mean_flow", "flow_pulsation", "vessel_volume_change", "vessel_saving",
    "bearing_load_max", "mean_bearing_load", "natural_frequency", "vibration_stress",
    "clutch_torque", "clutch_force", "slip_time", "engaged_speed", "slip_heat",
    "shearing_force", "rim_mass", "recovery_torque", "motor_ratio",
))  # fmt: skip
# digits of differences, and what of a residual is rounding
_DIGITS, _ROUNDING = 3, 1e-9
# in their order; of what links, joints and cylinders have the largest is before
_NUMBERS = (
    "effective_power", "indicated_power", "motor_power", "shaft_power", "stage_power", "stage_saving",
    "clutch_torque", "clutch_force", "slip_time", "engaged_speed", "slip_heat",
    "overall_isothermal_efficiency", "heat_removed", "mean_flow",
    "mean_torque", "total_torque_max", "total_torque_min", "driving_torque_max",
    "driving_torque_min", "driver_force_max", "driver_force_min", "piston_force_max", "piston_force_min",
    "slider_stroke", "joint_force_max", "slider_velocity_max", "slider_acceleration_max",
    "crankpin_load_max", "excess_work", "flywheel_inertia",
    "flywheel_inertia.exact", "speed_fluctuation", "standard_motor_power", "piston_velocity_max",
    "piston_acceleration_max", "piston_acceleration_min", "natural_frequency", "vibration_stress",
)  # fmt: skip
_OF_TESTS = (
    "effective_power", "indicated_power", "mechanical_efficiency", "fuel_rate", "effective_fuel_consumption",
    "effective_efficiency", "volumetric_efficiency", "air_fuel_ratio",
)  # fmt: skip
# what another makes needless: a flywheel may follow from another excess work than that of the shaft
_SAME = {
    "shaft_power": ("motor_power",), "excess_work": ("flywheel_inertia",), "indicated_power": ("effective_power",),
    "flywheel_inertia.exact": ("flywheel_inertia",),
}  # fmt: skip
# rows of the first table, and sentences of a conclusion that needs no table
_GLANCE, _FEWEST = 10, 3
# bore and stroke
_BOTH = 2
# the machine and its main results stand on one page [mm]
_HIGHEST = 85.0

# the label of the heading that a list of the symbols follows
NOMENCLATURE = "nomenclature"
_DYNAMICS = (
    "reduced_inertia", "reduced_inertia_1", "static_torque", "dynamic_torque", "balancing_torque", "driving_torque",
    "kinetic_energy_change", "crank_speed",
)  # fmt: skip
_MOTION = (
    "slider_displacement", "slider_velocity", "slider_acceleration",
    "link_angle", "link_angular_velocity", "link_angular_acceleration",
)  # fmt: skip


def _is_place(key: str) -> bool:
    return key_of(key).quantity.endswith(_PLACES)


def _compared(material: Material) -> Iterator[Block]:
    """Yield the single values by each name."""
    words, results, compared = material.words, material.results, material.results.compared
    if compared is None:
        return
    # two machines have pistons of their own
    per_area = material.per_area and compared.is_of_methods
    own, *other_names = shown_names(compared, words.language)
    key = "compared_methods" if compared.is_of_methods else "compared_machines"
    yield words.paragraph(key, table=Reference("t:compared"), own=own)
    titles: list[Runs] = [(words.column("quantity"),), (words.column("unit"),), (own,)]
    for other in other_names:
        titles += [(other,), ("Δ",)]
    rows = [
        (
            label(display_key(key, results) if key in results.trace else key, words.language),
            printed_unit(key_unit(key, per_area=per_area), words.language) or "–",
            words.number(values[0]),
            # after the own value come another and how far it is above it
            *(words.number(value, digits=_DIGITS if index % 2 else 6) for index, value in enumerate(values[1:])),
        )
        for key, values in comparison_rows(results, per_area=per_area).items()
        if not _is_place(key)
    ]
    align = "lc" + "r" * (len(titles) - 2)
    table = words.table("comparison", titles, rows, align, "t:compared")
    yield replace(table, wide=not fits(titles, rows, SIZES[-1]))


def errors(material: Material) -> dict[str, tuple[float, float]]:
    """Return the largest errors against exact [SI], and their shares of the largest value, by key."""
    largest_errors = {}
    for key in (name for name in material.summary if name.endswith("_error")):
        values = material.results.columns.get(key.removesuffix("_error"))
        if values is not None and np.any(values):
            largest_errors[key] = (material.summary[key], material.summary[key] / float(np.max(np.abs(values))))
    return largest_errors


def _checks(material: Material) -> Iterator[Block]:
    """Yield the identities that were checked, the errors of the method, and what the reader should know."""
    words, results = material.words, material.results
    largest_errors = errors(material)
    if results.checks and not material.full and not results.unmet and (material.has_piston or agree(results.checks)):
        names = tuple(run for key in results.checks for run in ("; ", _identity(key, words)))
        yield words.paragraph("agreeing" if agree(results.checks) else "checked", names=names[1:])
    elif results.checks:
        before = () if material.has_piston else (*words.sentence("identities"), " ")
        yield Paragraph((*before, *words.sentence("checks", table=Reference("t:identities"))))
        rows = [(_identity(key, words), words.number(100.0 * check, digits=2)) for key, check in results.checks.items()]
        yield words.table("identities", ("identity", "residual"), rows, "lr", "t:identities")
    elif results.has_positions:
        yield words.paragraph("no_checks")
    if largest_errors:
        yield words.paragraph("errors", table=Reference("t:errors"))
        yield _errors(material, largest_errors)
    # why two powers differ stands beside the diagram
    notices = [notice for notice in results.notices if notice is not two_bases(material)]
    if notices:
        yield words.paragraph("notices")
        yield ItemList(tuple((_notice(notice, words),) for notice in notices))
    if assumed := plain_assumptions(results, words.language):
        is_list = material.full or not material.has_piston
        yield Paragraph((*words.sentence("assumptions"), "" if is_list else f" {'; '.join(assumed)}."))
        yield from [ItemList(tuple((text,) for text in assumed))] if is_list else ()


def _identity(key: str, words: Words) -> Cell:
    """Return the identity that a check tests: in words, or symbols where it is an equation."""
    text = translate(f"report.{key}", words.language)
    return Math(text) if "²" in text else text


def _notice(notice: Notice, words: Words) -> str:
    """Return the sentence of a notice; keys of the machine file that it names become what they mean."""
    values = {
        name: ", ".join(map(words.meaning, value.split(", "))) if name in ("name", "names") else words.part(value)
        for name, value in notice.values.items()
        if isinstance(value, str)
    }
    text = notice_text(notice.code, {**notice.values, **values}, words.language)
    # a note has no keys of the file
    return text.removeprefix(f"{notice.values.get('path', '')}: ")


def _errors(material: Material, largest_errors: dict[str, tuple[float, float]]) -> Table:
    """Return the errors of the method, each also as a share of the largest value."""
    words = material.words
    rows = [
        (
            label(key.removesuffix("_error"), words.language),
            words.number(displayed(key, error, per_area=material.area(key)), digits=4),
            printed_unit(key_unit(key, per_area=material.area(key) is not None), words.language) or "–",
            words.number(100 * share, digits=2),
        )
        for key, (error, share) in largest_errors.items()
    ]
    return words.table("errors", ("quantity", "value", "unit", "relative"), rows, "lrcr", "t:errors")


def _of(kind: str, summary: Mapping[str, float]) -> list[str]:
    """Return the key of a quantity, or of the largest of those that links, joints and cylinders have."""
    if kind in summary or "." in kind:
        return [kind] if kind in summary else []
    # of a slider that goes both ways the larger by size counts
    kinds = (kind, f"{kind.removesuffix('_max')}_min") if kind.startswith("slider_") else (kind,)
    if kind == "natural_frequency":
        # of the lowest modes
        return [key for key in (f"{kind}.{mode}" for mode in (1, 2)) if key in summary]
    is_part = kind.endswith(("_max", "_stroke", "_stress"))
    parts = [key for key in summary if is_part and key_of(key).owner and key_of(key).quantity in kinds]
    return [max(parts, key=lambda key: abs(summary[key]))] if parts else []


def main_keys(results: Results) -> list[str]:
    """Return the keys of the single values that matter most, in their order."""
    summary = results.summary
    if results.machine.rotor is not None:
        keys = [key for key in summary if not _is_place(key) and key_of(key).quantity in _OF_LINKAGES]
        return keys or list(summary)
    if results.machine.alone == "test":
        return [key for key in _OF_TESTS if key in summary]
    # a linkage has a joint there
    numbers = [kind for kind in _NUMBERS if "piston_displacement" in results.columns or kind != "crankpin_load_max"]
    return [key for kind in numbers for key in _of(kind, summary)
            if not any(same in summary for same in _SAME.get(kind, ()))]  # fmt: skip


def _at_a_glance(material: Material) -> Iterator[Block]:
    """Yield the machine as it stands, the results that matter most, and whether the checks hold."""
    results, words, summary = material.results, material.words, material.summary
    film = film_of(results, language=words.language) if material.options.figures else None
    lengths = link_lengths(material) if drawn(material) else []
    if film is not None and lengths:
        measured = [*lengths, *fixed_distances(material)]
        film = film_of(results, language=words.language, still=film.rest, lengths=measured)
    if film is not None:
        title = translate("subjects.machine", words.language)
        place = words.place_text(float(film.angles[film.rest]))
        sentences = words.sentence("machine_drawn", figure=Reference("f:machine"), value=place)
        if lengths:
            texts = "; ".join(f"{length.start}{length.end} {length.text}" for length in lengths)
            sentences += (" ", *words.sentence("machine_lengths", unit=words.unit("point_x"), lengths=texts))
        yield Paragraph((*sentences, " ", *words.sentence("main_results", table=Reference("t:glance"))))
        sizes = ("bore", "stroke", "crank_radius", "rod_length") if material.has_piston else ()
        known = [
            f"{words.symbol(key)} = {words.amount(summary[key], 'mm', digits=4)}" for key in sizes if key in summary
        ]
        caption = ", ".join((f"{title}: {known[0]}", *known[1:])) if known else title
        caption = words.phrase("machine_measured", unit=words.unit("point_x")) if lengths else caption
        own = [
            f"/{{{words.symbol(key)}}} {words.shown(key, summary[key], digits=4)}"
            for key in sizes[:2]
            if key in summary
        ]
        still = dimensioned(film, *own) if len(own) == _BOTH else film.still()
        yield Figure(still, caption, film.about or title, label="f:machine", high=_HIGHEST)
    if film is None:
        yield words.paragraph("main_results", table=Reference("t:glance"))
    yield value_table("glance", [_row(material, key) for key in main_keys(results)[:_GLANCE]], words)
    if results.unmet:
        yield Paragraph((capital(warning_text(results, words.language)),))
    else:
        yield from _all_hold(material)


def _all_hold(material: Material) -> Iterator[Block]:
    """Yield that all checks hold, where there are any."""
    checks, words = material.results.checks, material.words
    if checks:
        key, residual = (
            "all_agree" if agree(checks) else "all_hold",
            words.number(100.0 * max(checks.values()), digits=2),
        )
        yield words.paragraph(key, count=str(len(checks)), residual=residual)


def _conclusion(material: Material) -> Iterator[Block]:
    """Yield what the results mean; where few sentences say it, and in the full note of a linkage, a table as well."""
    read = concluded(material) if material.has_piston else concluded_of_linkage(material)
    sentences = tuple(paragraph.runs for paragraph in read)
    keys = () if material.has_piston else _main_keys(material)
    shown = {*main_keys(material.results)[:_GLANCE]} if not material.full else set[str]()
    # the first page has most of them
    left = [key for key in keys if key not in shown]
    fewest = 1 if material.machine.alone else _FEWEST
    if left and (material.full or len(sentences) < fewest):
        yield material.words.paragraph("conclusion", table=Reference("t:summary"))
        yield value_table("summary", [_row(material, key) for key in left], material.words)
    elif not sentences:
        yield material.words.paragraph("conclusion", table=Reference("t:glance"))
    if sentences:
        yield ItemList(sentences)


def _main_keys(material: Material) -> list[str]:
    """Return the keys of the main results of a linkage in order."""
    keys = [key for key in material.summary if not _is_place(key)]
    return keys if material.full else [key for key in keys if key_of(key).quantity in _OF_LINKAGES]


def _row(material: Material, key: str) -> tuple[Cell, ...]:
    """Return name, symbol, value and unit of a single value, and the crank angle or time where it is reached."""
    words, summary = material.words, material.summary
    area = summary["piston_area"] if material.per_area else None
    kind = key_of(key).quantity
    angle, time = (summary.get(key_of(key).derived(f"_{over}")) for over in ("angle", "time"))
    if not kind.endswith(("_max", "_min")) or (angle is None and time is None):
        reached = "–"
    else:
        reached = words.amount(time or 0.0, "s", digits=4) if angle is None else words.angle(angle)
    row = value_row(display_key(key, material.results), summary[key], words, area=area, digits=material.digits)
    return (*row, reached)


def _further(material: Material) -> Iterator[Block]:
    """Yield single values that are not among the main results, and figures that no section has."""
    words, summary = material.words, material.summary
    main = {*(() if material.has_piston else _main_keys(material)), *(() if material.has_engine else _OF_ENGINES)}
    main |= {*GEAR, "bore", *(cycle_keys(material) if material.cycle else ())}
    left = [
        key
        for key in summary
        if key not in main
        and not material.is_shown(key)
        and not _is_place(key)
        and not key_of(key).quantity.endswith("_error")
    ]
    if left:
        yield words.paragraph("more", table=Reference("t:more"))
        yield value_table("more", [_row(material, key) for key in left], words)
    yield from material.presented((), dict.fromkeys(map(kind_of, material.remaining_figures())))


def _rest(material: Material) -> Iterator[Block]:
    """Yield what no section has: further values, figures."""
    rest = [*material.intro("further", material.remaining_lines()), *_further(material)]
    if rest:
        yield material.words.heading("appendix")
        yield material.words.heading("more", 2, numbered=False)
        yield from rest


def _all_columns(material: Material) -> Iterator[Block]:
    """Yield all columns at the step of the tables, where the sections before have not the same tables."""
    words, results = material.words, material.results
    columns, degrees = without_rounding(results.columns, results.machine.speed), results.grid.degrees
    if len(degrees) == len(material.positions) and np.allclose(degrees, material.positions):
        return
    over = "period" if words.period else "partial" if words.is_partial else "turn"
    yield words.heading(f"appendix_{over}")
    tables = {
        "torques_all": any_nonzero(_DYNAMICS, results.columns),
        "driver_all": [key for key in columns if key.startswith("driver_")],
        "motion_all": named(columns, *_MOTION),
        f"reactions_{over}": material.nonzero("joint_force", "axial_force", "normal_force", "normal_moment"),
    }
    for caption, keys in tables.items():
        yield from position_tables(caption, degrees, quantity_columns(material, keys, columns), words, first=None)


def _has_checks(material: Material) -> bool:
    results = material.results
    return bool(results.checks or results.notices or results.has_positions or errors(material))


SECTIONS = (
    Section("comparison", (Head("comparison"), _compared, Shown(("comparison",))),
            lambda material: material.results.compared is not None),
    Section("checks", (Head("checks"), _checks), _has_checks),
    Section("summary", (Head("results"), _at_a_glance)),
    Section("conclusion", (Head("conclusion"), _conclusion)),
    Section("nomenclature", (lambda material: [material.words.heading("nomenclature", label=NOMENCLATURE)],)),
    Section("sources", (Head("sources"), lambda _: (Bibliography(),))),
    Section("appendix", (_rest,), every(full, has("piston_displacement"))),
    Section("appendix", (_all_columns,), every(full, drawn)),
)  # fmt: skip
