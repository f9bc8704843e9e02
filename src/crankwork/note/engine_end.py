"""The end of the note of an engine: checks, main results, sources and appendix."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.solved import Notice
from crankwork.locale import say
from crankwork.note.comparison import comparison_blocks, main_numbers
from crankwork.note.document import Bibliography, Block, Cell, ItemList, Math, Reference, Table
from crankwork.note.engine_data import GEAR, cycle_keys
from crankwork.note.engine_material import Material
from crankwork.note.engine_motion import errors
from crankwork.note.engine_shaft import balance, evenness, mains
from crankwork.note.engine_tables import value_row, value_table
from crankwork.note.printed_units import printed_unit
from crankwork.note.words import EngineWords
from crankwork.report.language import displayed, key_unit, label
from crankwork.report.notices import notice_text

_MAIN = (
    "mean_piston_speed", "piston_velocity_max", "piston_velocity_min", "piston_acceleration_max",
    "piston_acceleration_min", "gas_pressure_max", "inertia_force_max", "inertia_force_min", "piston_force_max",
    "piston_force_min", "side_force_max", "side_force_min", "tangential_force_max", "tangential_force_min",
    "rotating_inertia_force", "crank_torque_max", "crank_torque_min", "mean_torque", "indicated_work",
    "indicated_mean_pressure", "indicated_power", "effective_mean_pressure", "effective_power", "effective_torque",
    "effective_efficiency", "effective_fuel_consumption", "displacement", "mean_total_torque", "total_torque_max",
    "total_torque_min", "excess_work", "flywheel_inertia", "speed_fluctuation", "mean_crankpin_load",
    "crankpin_load_max", "oil_hole_angle",
)  # fmt: skip
_OF_ENGINES = ("displacement", "mean_total_torque", "total_torque_max", "total_torque_min", "cylinder_count")


def checks(material: Material) -> Iterator[Block]:
    """Yield the identities that were checked, the errors of the method, and what the reader should know."""
    words, results = material.words, material.results
    largest_errors = errors(material)
    if not (results.checks or largest_errors or results.notices):
        return
    yield words.heading("checks")
    if results.checks:
        yield words.paragraph("checks", table=Reference("t:identities"))
        rows = [(_identity(key, words), words.number(100.0 * check, digits=2)) for key, check in results.checks.items()]
        yield words.table("identities", ("identity", "residual"), rows, "lr", "t:identities")
    if largest_errors:
        yield words.paragraph("errors", table=Reference("t:errors"))
        yield _errors(material, largest_errors)
    if results.notices:
        yield words.paragraph("notices")
        yield ItemList(tuple((_notice(notice, words),) for notice in results.notices))


def comparison(material: Material) -> Iterator[Block]:
    """Yield the values and curves by other methods, or of another machine, beside those of this one."""
    words = material.words
    heading = words.heading("comparison")
    # two machines have pistons of their own
    compared = material.results.compared
    per_area = material.per_area and compared is not None and compared.is_of_methods
    caption = words.caption("comparison")
    yield from comparison_blocks(material.results, words, heading, caption, per_area=per_area)
    yield from material.presented((), ("comparison",))


def _identity(key: str, words: EngineWords) -> Cell:
    """Return the identity that a check tests: in words, or symbols where it is an equation."""
    text = say(f"report.{key}", words.language)
    return Math(text) if "²" in text else text


def _notice(notice: Notice, words: EngineWords) -> str:
    """Return the sentence of a notice; keys of the machine file that it names become what they mean."""
    values = {
        name: ", ".join(map(words.meaning, value.split(", "))) if name in ("name", "names") else value
        for name, value in notice.values.items()
        if isinstance(value, str)
    }
    return notice_text(notice.code, {**notice.values, **values}, words.language)


def _errors(material: Material, largest_errors: dict[str, tuple[float, float]]) -> Table:
    """Return the errors of the method, each also as a share of the largest value."""
    words = material.words
    rows = [
        (
            label(key.removesuffix("_error"), words.language),
            words.number(displayed(key, error), digits=4),
            printed_unit(key_unit(key), words.language) or "–",
            words.number(100 * share, digits=2),
        )
        for key, (error, share) in largest_errors.items()
    ]
    return words.table("errors", ("quantity", "value", "unit", "relative"), rows, "lrcr", "t:errors")


def conclusion(material: Material) -> Iterator[Block]:
    """Yield the main results as a table."""
    words = material.words
    yield words.heading("results" if material.order == "en" else "conclusion")
    yield from main_numbers(material.results, words)
    yield words.paragraph("conclusion", table=Reference("t:summary"))
    yield value_table("summary", [_row(material, key) for key in _main_keys(material)], words)


def _main_keys(material: Material) -> list[str]:
    """Return the keys of the main results, in order; for one cylinder those of its own torque only."""
    kinds = [kind for kind in _MAIN if material.has_engine or kind not in _OF_ENGINES]
    # those of each method have a table of their own
    alone = ("excess_work", "flywheel_inertia")
    return [
        key
        for kind in kinds
        for key in material.summary
        if key == kind or (key.startswith(f"{kind}.") and kind not in alone)
    ]


def _row(material: Material, key: str) -> tuple[Cell, ...]:
    """Return name, symbol, value and unit of a single value, and the crank angle where it is reached."""
    words, summary = material.words, material.summary
    area = summary["piston_area"] if material.per_area else None
    kind, dot, name = key.partition(".")
    angle = summary.get(f"{kind}_angle{dot}{name}") if kind.endswith(("_max", "_min")) else None
    row = value_row(key, summary[key], words, area=area)
    return (*row, "–" if angle is None else words.amount(angle, "deg", digits=4))


def sources(material: Material) -> Iterator[Block]:
    """Yield the bibliography."""
    yield material.words.heading("sources")
    yield Bibliography()


def appendix(material: Material) -> Iterator[Block]:
    """Yield what no section has given: journals, balance and flywheel in Vietnamese notes, further values, figures."""
    blocks: list[Block] = []
    if material.order == "vi":
        blocks += [*mains(material), *balance(material), *evenness(material)]
    rest = [*material.intro("further", material.remaining_lines()), *_further(material)]
    if rest:
        blocks += [material.words.heading("more", 2, numbered=False), *rest]
    if blocks:
        yield material.words.heading("appendix")
        yield from blocks


def _further(material: Material) -> Iterator[Block]:
    """Yield single values that are not among the main results, and figures that no section has."""
    words, summary = material.words, material.summary
    main = {*_main_keys(material), *(() if material.has_engine else _OF_ENGINES)}
    main |= {*GEAR, "bore", *(cycle_keys(material) if material.cycle else ())}
    left = [
        key
        for key in summary
        if key not in main
        and not material.is_shown(key)
        and not key.partition(".")[0].endswith(("_max_angle", "_min_angle", "_error"))
    ]
    if left:
        yield words.paragraph("more", table=Reference("t:more"))
        yield value_table("more", [_row(material, key) for key in left], words)
    yield from material.presented((), material.remaining_figures())
