"""The note as it is without being asked for everything: the main course, its figures read, nothing unexplained."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

import crankwork
from crankwork.analysis.all_cylinders import with_engine_results
from crankwork.locale import capital, translate
from crankwork.note.document import Contents, Equation, Figure, Heading, Note, Paragraph, TitlePage, side_by_side
from crankwork.note.numbering import equation_source, numbering
from crankwork.note.options import NoteOptions
from crankwork.note.readings import reading
from crankwork.note.sections import note_of, written_note
from crankwork.note.wording import Words
from crankwork.quantities import LANGUAGES, Language
from crankwork.report.display import is_per_area, key_unit
from crankwork.report.drawing import film_of
from crankwork.report.summary import warning_text
from crankwork.units import from_si
from each import failing
from note.test_symbols_of_notes import unexplained
from notes import blocks, note, results

MACHINES = ("petrol-four", "spark-engine", "press-geometry", "slider-crank", "press")
CASES = {f"{name}-{language}": (name, language) for name in MACHINES for language in LANGUAGES}
# columns whose largest and least values a figure's sentence tells, and what it tells beside them
EXTREMES = {
    "pressure": (("gas_pressure", "max"),),
    "kinematics": (("piston_velocity", "max"), ("piston_acceleration", "max")),
    "piston_forces": (("piston_force", "max"), ("piston_force", "min")),
    "crankpin_forces": (("tangential_force", "max"), ("tangential_force", "min")),
    "total_torque": (("total_torque", "min"), ("total_torque", "max")),
    "crankpin_polar": (("crankpin_load", "max"),),
    "torques": (("driving_torque", "max"), ("driving_torque", "min")),
    "reduced_inertia": (("reduced_inertia", "max"), ("reduced_inertia", "min")),
    "tolle": (("piston_acceleration", "max"), ("piston_acceleration", "min")),
    "crankpin_load": (("crankpin_load", "max"), ("crankpin_load", "min")),
    "big_end_polar": (("big_end_load", "max"), ("big_end_load", "min")),
}
OTHERS = {"joint_forces", "indicator", "brix", "crankpin_wear", "main_journal_polar", "balance_orders", "excess_work"}
OF_PISTONS = {"indicator", "pressure", "kinematics", "piston_forces", "crankpin_forces", "crankpin_polar"}
READ = {
    "petrol-four": OF_PISTONS | {"total_torque", "crankpin_wear", "main_journal_polar"},
    "spark-engine": OF_PISTONS | {"crankpin_wear", "balance_orders", "excess_work"},
    "press-geometry": {"torques", "reduced_inertia", "joint_forces"},
    "slider-crank": {"kinematics"},
    "press": {"torques", "reduced_inertia"},
}  # fmt: skip
# what the figures of a school add
OF_SCHOOL = {
    "en": dict[str, set[str]](),
    "ru": {name: {"crankpin_load"} for name in ("petrol-four", "spark-engine")},
    "vi": {name: {"crankpin_load", "big_end_polar", "brix", "tolle"} for name in ("petrol-four", "spark-engine")}
    | {"slider-crank": {"brix", "tolle"}},
}
# pages of the PDF in each language
PAGES = {
    "petrol-four": (15, 16, 17), "spark-engine": (10, 10, 11), "press-geometry": (15, 17, 16),
    "slider-crank": (3, 3, 4), "press": (6, 6, 6),
}  # fmt: skip
NUMBER = re.compile(r"(−?\d+(?:[.,]\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?")
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
STEP = 0.1


@cache
def short(name: str, language: Language) -> Note:
    return note(name, language, full=False, figures=True)


def whole(name: str, language: Language) -> Note:
    return note(name, language, figures=True)


@cache
def analysed(name: str) -> crankwork.Results:
    """Return results, a crank gear as an engine of one cylinder."""
    return with_engine_results(results(name))


def test_a_short_note_has_fewer_than_half_of_the_equations():
    def check(case):
        few, many = (len(blocks(one(*case), Equation)) for one in (short, whole))
        # of the press hardly anything but its main course is known
        assert few < (0.5 * many if case[0] != "press" else 0.7 * many), (few, many)

    assert failing(CASES, check) == {}


def test_the_main_results_stand_first_with_the_machine():
    def check(case):
        one = short(*case).blocks
        assert isinstance(one[0], TitlePage)
        heads = [at for at, block in enumerate(one) if isinstance(block, Heading)]
        first = [block for block in one[: heads[1]] if not isinstance(block, TitlePage | Contents)]
        assert first[0] == Heading(1, translate("headings.results", case[1]))
        drawn = [block.label for block in first if isinstance(block, Figure)]
        # a table of transfer functions has no links to draw
        assert drawn == (["f:machine"] if film_of(results(case[0])) is not None else [])
        assert ("f:machine" in drawn) == (case[0] != "press")
        assert "t:glance" in [getattr(block, "label", "") for block in first]

    assert failing(CASES, check) == {}


def test_the_sources_of_all_formulas_are_cited():
    def check(case):
        one, marks = short(*case), list[str]()
        numbers = numbering(one)
        for block, number in zip(one.blocks, numbers.blocks, strict=True):
            if not isinstance(block, Equation):
                continue
            marks += [mark] if (mark := numbers.mark(block, "")) else []
            if source := equation_source(block, one.language):
                # beside it, or beside one before it
                assert numbers.citation(source) in marks, number
        # each once
        assert len(marks) == len(set(marks))

    assert failing(CASES, check) == {}


def test_the_symbols_of_all_equations_are_listed():
    assert failing(CASES, lambda case: _none(unexplained(short(*case)))) == {}


def _none(wrong: list[str]) -> None:
    assert wrong == []


# --- numbers that are read from figures


def numbers_of(block: Paragraph) -> list[float]:
    """Return the numbers of a sentence."""
    said = "".join(run for run in block.runs if isinstance(run, str)).replace("\u00a0", " ")
    return [
        float(digits.replace("−", "-").replace(",", ".")) * 10.0 ** int((power or "0").translate(RAISED))
        for digits, power in NUMBER.findall(said)
    ]


def extremes(name: str, key: str, end: str) -> tuple[float, list[float]]:
    """Return the largest or least value of a column [SI], and all angles where it is reached [deg]."""
    found, sign = analysed(name), 1.0 if end == "max" else -1.0
    last = float(found.grid.degrees[-1])
    # a table has its angles only
    grid = found.grid.degrees if name == "press" else np.linspace(0.0, last, round(last / STEP) + 1)
    values = sign * found.columns_at(grid, (key,))[key]
    near = np.flatnonzero(values >= values.max() - 1e-4 * np.ptp(values))
    peaks = [at for at in near if values[at] >= values[max(at - 1, 0)] and values[at] >= values[(at + 1) % len(grid)]]
    reached = {at: (float(values[at]), float(grid[at])) for at in peaks}
    if name != "press":
        for at in peaks:
            centre = grid[at]
            for width in (STEP, STEP / 100):
                finer = np.clip(np.linspace(centre - width, centre + width, 201), 0.0, last)
                fine = sign * found.columns_at(finer, (key,))[key]
                centre = finer[np.argmax(fine)]
            reached[at] = float(fine.max()), float(centre)
    best = max(value for value, _ in reached.values())
    return sign * best, [angle for value, angle in reached.values() if value >= best - 1e-9 * np.ptp(values)]


def own_key(name: str, key: str) -> str:
    """Return the column of a quantity, of the first crankpin where each has one."""
    return next(column for column in analysed(name).columns if column.partition(".")[0] == key)


def expected(name: str, kind: str, *, per_area: bool) -> list[tuple[float, list[float]]]:
    """Return the values that a sentence is to tell, in the units of figures, with the angles of each."""
    found = analysed(name)
    told: list[tuple[float, list[float]]] = []

    def shown(key: str, value: float) -> float:
        divided = per_area and is_per_area(key) and key != "joint_force"
        area = found.summary["piston_area"] if divided else 1.0
        return float(from_si(value / area, key_unit(key, per_area=divided)))

    if kind == "joint_forces":
        pins = [key for key in found.columns if key.startswith("joint_force.")]
        value, angles = max((extremes(name, key, "max") for key in pins), key=lambda pair: pair[0])
        return [(shown("joint_force", value), angles)]
    if kind in OTHERS:
        return other_values(found, kind, shown)
    for key, end in EXTREMES[kind]:
        value, angles = extremes(name, own_key(name, key), end)
        told.append((shown(key, value), angles))
        if kind == "piston_forces":
            parts = found.columns_at(np.array(angles[:1]), ("gas_force", "inertia_force"))
            told += [(shown(part, float(values[0])), []) for part, values in parts.items()]
    turn = np.arange(0.0, float(found.grid.degrees[-1]), STEP)
    if kind == "crankpin_load":
        told.append((1.0, []))
    if kind == "tolle":
        told.append((extremes(name, "piston_velocity", "max")[1][0], []))
    if kind == "crankpin_polar":
        # finer, as the load jumps
        load = found.columns_at(np.arange(0.0, turn[-1], STEP / 8), (own_key(name, "crankpin_load"),))
        told.append((shown("crankpin_load", float(np.mean(next(iter(load.values()))))), []))
    if kind == "total_torque":
        mean = float(np.mean(found.columns_at(turn, ("total_torque",))["total_torque"]))
        told += [(mean, []), (max(abs(value) for value, _ in told) / mean, [])]
    return told


def other_values(
    found: crankwork.Results, kind: str, shown: Callable[[str, float], float]
) -> list[tuple[float, list[float]]]:
    """Return the values of a sentence that are no extremes of a column, with the angles of each."""
    degrees = np.linspace(0.0, float(found.grid.degrees[-1]), round(float(found.grid.degrees[-1]) * 20) + 1)

    def column(key: str) -> np.ndarray:
        return found.columns_at(degrees, (key,))[key]

    if kind == "indicator":
        volume = column("cylinder_volume")
        work = float(np.trapezoid(column("gas_pressure"), volume))
        return [(work, []), (shown("indicated_mean_pressure", work / float(np.ptp(volume))), [])]
    if kind == "brix":
        radius, rod = found.summary["crank_radius"], found.summary["rod_length"]
        # books stop after the second harmonic
        is_exact = found.machine.method.kinematics == "exact"
        way = radius + (rod - math.sqrt(rod**2 - radius**2) if is_exact else 0.5 * radius**2 / rod)
        return [(90.0, []), (shown("piston_displacement", way), []), (50.0 * way / radius, [])]
    if kind == "excess_work":
        torque = column("total_torque" if "total_torque" in found.columns else "crank_torque")
        surplus = np.radians(np.diff(degrees)) * (0.5 * (torque[1:] + torque[:-1]) - np.mean(torque[:-1]))
        return [(float(np.ptp(np.cumsum(surplus))), [])]
    if kind == "crankpin_wear":
        wear = found.listings["crankpin_wear"].columns
        (sums,) = (values for key, values in wear.items() if key.startswith("wear_sum"))
        return [(1.0, []), (float(np.degrees(wear["wear_ray_angle"][np.argmax(sums)])), [])]
    if kind == "main_journal_polar":
        loads = {key: column(key) for key in found.columns if key.startswith("main_journal_load.")}
        largest = max(float(values.max()) for values in loads.values())
        equal = {key: values for key, values in loads.items() if values.max() > (1 - 1e-9) * largest}
        journals = [(float(key.rpartition(".")[2]), list[float]()) for key in equal]
        reached = degrees[np.argmax(next(iter(equal.values())))]
        return [*journals, (shown("main_journal_load", largest), [float(reached)])]
    rows = found.listings["balance"]
    sizes = zip(rows.names, rows.columns["free_force"], strict=True)
    free = {name.rpartition(".")[2]: abs(float(size)) for name, size in sizes if name.startswith("residual")}
    order = max(free, key=free.__getitem__)
    return [(float(order), []), (shown("free_force", free[order]), [])]


def test_figures_are_followed_by_what_is_read_from_them():
    def check(case):
        name, language = case
        read = {}
        one = short(*case).blocks
        for row in side_by_side(one):
            told = iter(one[row[-1] + 1 :])
            for block in (one[place] for place in row):
                if isinstance(block, Figure) and block.name in {*EXTREMES, *OTHERS}:
                    after = next(told)
                    assert isinstance(after, Paragraph), block.name
                    read[block.name] = numbers_of(after)
        assert read.keys() == READ[name] | OF_SCHOOL[language].get(name, set()), read.keys()
        for kind, printed in read.items():
            wanted = expected(name, kind, per_area=language == "vi" and name != "press-geometry")
            for value, angles in wanted:
                # a ratio of two digits, an angle of one decimal
                digits = 0.051 if (kind == "total_torque" and value < 50) or (kind == "tolle" and not angles) else 0.0
                # kN where N would be long
                values = [number * factor for number in printed for factor in (1.0, 1e3)]
                matching = [number for number in values if abs(number - value) <= max(digits, 5.1e-4 * abs(value))]
                assert matching, (kind, value, printed)
                # what repeats in every turn is reached at more angles than one
                turned = [abs(number - angle) % 360.0 for number in printed for angle in angles]
                assert not angles or min(min(angle, 360.0 - angle) for angle in turned) < 0.051, (kind, angles, printed)
            count = sum(1 + bool(angles) for _, angles in wanted)
            assert len(printed) == count, (kind, printed)

    assert failing(CASES, check) == {}


def test_the_peak_of_a_torque_that_is_mostly_negative_is_its_least_value():
    # as of a compressor, whose driver gives the mean
    results = crankwork.analyse(crankwork.read_machine(crankwork.template("compressor")))
    assert results.summary["mean_torque"] > 0
    summary = {"total_torque_max": 10.0, "total_torque_min": -30.0, "mean_torque": 5.0}
    summary |= {"total_torque_max_angle": 1.0, "total_torque_min_angle": 2.0}
    for language in LANGUAGES:
        told = reading("total_torque", SimpleNamespace(
            words=Words(language), summary=summary, area=lambda _: None, results=results))  # fmt: skip
        assert numbers_of(told)[-1] == 6.0
        assert numbers_of(told)[-2] == -5.0


# --- what a file asks for, and what is written


def test_a_cover_and_contents_stand_where_the_file_names_an_institution():
    for language in LANGUAGES:
        options, machine = NoteOptions(language=language, figures=False), crankwork.template("slider-crank")
        plain, named = (
            note_of(crankwork.analyse(crankwork.read_machine(text)), options).blocks
            for text in (machine, f'{machine}\n[document]\ninstitution = "University"\n')
        )
        assert [block.is_plain for block in (plain[0], named[0])] == [True, False]
        assert [sum(isinstance(block, Contents) for block in one) for one in (plain, named)] == [0, 1]


def written(name: str, language: Language) -> None:
    one = short(name, language)
    page, word, pdf = (written_note(one, f"note{ending}") for ending in (".html", ".docx", ".pdf"))
    assert page.startswith(b"<!DOCTYPE html>")
    assert page.count(b"<svg") >= len(blocks(one, Figure))
    assert word.startswith(b"PK")
    pages = pdf.count(b"/Type/Page/")
    assert 0 < pages <= PAGES[name][LANGUAGES.index(language)], pages


@pytest.mark.parametrize(
    "names", [pytest.param(("press",), id="some"), pytest.param(MACHINES[:-1], id="more", marks=pytest.mark.slow)]
)
def test_short_notes_are_written_in_every_format_on_few_pages(names):
    cases = {case: named for case, named in CASES.items() if named[0] in names}
    assert failing(cases, lambda case: written(*case)) == {}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_check_that_fails_is_said_on_the_first_page(language):
    right = analysed("slider-crank")
    wrong = replace(right, checks={**right.checks, "work": 0.5})
    said = [block.runs[0] for block in blocks(note_of(wrong, NoteOptions(language=language)), Paragraph)]
    (warning,) = [text for text in said if isinstance(text, str) and translate("report.work", language) in text]
    assert warning == capital(warning_text(wrong, language))
    holds = translate("sentences.all_hold", language, count="", residual="").partition("(")[0]
    assert not any(isinstance(text, str) and text.startswith(holds) for text in said)
