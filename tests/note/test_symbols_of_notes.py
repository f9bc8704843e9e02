"""Every symbol of a note is explained in its nomenclature, stands for one thing, and is set alike."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from dataclasses import replace
from pathlib import Path

import pytest

import crankwork
from crankwork.formula.calculation_lines import FormulaLine, symbols_of
from crankwork.formula.expression import Formula, symbol
from crankwork.formula.traced_value import in_order
from crankwork.notation import ARGUMENTS
from crankwork.note.document import Equation, Math, Note, Table
from crankwork.note.equations import equation_symbol, own_key, printed_equation, value_symbol
from crankwork.note.layout import Upright
from crankwork.note.symbols import symbol_box
from crankwork.note.wording import Words
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import use_numbers
from crankwork.report.display import link_numbers
from crankwork.report.display import symbol as key_symbol
from each import for_each
from note.built import SOME, broken, looked_at, note, schools, source
from notes import as_numbered, blocks, nomenclature, printed, value_rows

ROOT = Path(__file__).parents[2]
OTHERS = (
    "spark-engine: exact", "v8-diesel", "radial-five", "narrow-v6: textbook", "two-stroke", "atkinson", "beta-stirling",
    "opposed-pistons", "excavator-boom", "parallelogram", "press-start",
)  # fmt: skip
# what may stand flat: units after a comma, and names that the file gives; z is also the point where burning ends
UNIT = re.compile(r"^, [^,]+$")
FLAT = {"–", "", "z"}
# letters that books of a school give two things: moving links and revolutions; pressure in the cylinder by two ways,
# and transfer functions by two names
SCHOOL = {"en": "n", "ru": "n", "vi": "n"}
SAME = {"p", "p₁", "V", "x′", "x″", "S_x′", "S_x″"}
VALUES = ("data", "cycle_data", "cycle_results")
# what is found in several ways
WAYS = ("flywheel_inertia", "whole_inertia", "wittenbauer_slope", "excess_work")
# wanted and reached
SPEED = {"δ"}


def every_note(rule):
    """Return a rule of notes as a test: of some machines in every language, of more in two."""
    some = [(case, language) for case in SOME for language in LANGUAGES]
    more = [(case, language) for case in OTHERS for language in schools(case)]

    def checked(case, language):
        whole = note(case, language)
        with use_numbers(link_numbers(whole.results)):
            return rule(case, whole)

    @pytest.mark.parametrize(
        "notes", [pytest.param(some, id="some"), pytest.param(more, id="more", marks=pytest.mark.slow)]
    )
    def test(notes):
        assert broken(checked, notes) == {}

    return test


def needed(step: FormulaLine, language: str) -> dict[str, tuple[str, ...]]:
    """Return the symbols that must be known by the symbols of a formula as they are printed."""
    named = dict(step.named)
    found: dict[str, tuple[str, ...]] = {}
    for name in symbols_of(step.expression):
        if name in named:
            found[value_symbol(named[name], language)] = (key_symbol(own_key(named[name]).partition(".")[0], language),)
        elif name != "pi":
            entry = ARGUMENTS[name]
            of_angles = any(mark in entry.pattern for mark in ("sin", "cos"))
            bases = [QUANTITIES[key].symbol(language) for key in (entry.quantity, entry.extra) if key]
            found[symbol(name, language)] = tuple(bases) if of_angles else (symbol(name, language),)
    return found


@as_numbered
def unexplained(one: Note) -> list[str]:
    """Return the symbols of equations that nothing explains."""
    known = {row[0].content for row in nomenclature(one)}
    # the tables of values name their symbols
    known |= {row[1].content for row in value_rows(one, *VALUES) if isinstance(row[1], Math)}
    worked = blocks(one, Equation)
    needs = [(block, needed(block.step, one.language)) for block in worked if isinstance(block.step, FormulaLine)]
    # one of a kind is explained for all of them
    kinds = {
        QUANTITIES[kind].symbol(one.language)
        for block in worked
        if block.symbol in known and (kind := getattr(block.step, "key", "").partition(".")[0]) in QUANTITIES
    }
    kinds |= {base for _, symbols in needs for shown, wanted in symbols.items() for base in wanted if shown in known}
    known |= kinds
    return [
        f"{shown} in {printed_equation(block, one.language).text}"
        for block, symbols in needs
        for shown, wanted in symbols.items()
        if not ({shown} <= known or set(wanted) <= known)
    ]


def ambiguous(one: Note) -> set[str]:
    """Return the symbols of equations that stand for two things, but for those of the school."""
    meanings, values = defaultdict(set), defaultdict(set)
    for shown, meaning in nomenclature(one):
        meanings[shown.content].add(meaning)
    for block in blocks(one, Equation):
        if not isinstance(block.step, Formula) and not block.step.key.startswith(WAYS):
            values[block.symbol or equation_symbol(block.step, one.language)].add(block.step.key)
    twice = {shown for found in (meanings, values) for shown, of in found.items() if len(of) > 1}
    return twice - {*SCHOOL[one.language], *SAME}


def flat(one: Note, text: str) -> set[str]:
    """Return the symbols of equations that stand flat in a table, but what a file has."""
    worked, found = blocks(one, Equation), set()
    known = {block.symbol or equation_symbol(block.step, one.language) for block in worked}
    known |= {row[0].content for row in nomenclature(one)}
    for table in blocks(one, Table):
        runs = [run for heading in table.headings for run in heading]
        # names and symbols stand in the first two columns
        runs += [cell for row in table.rows for cell in row[:2]]
        for run in runs:
            if isinstance(run, str) and not UNIT.match(run):
                found |= {
                    word
                    for word in re.split(r"[\s,;()=]+", re.sub(r", \S+$", "", run))
                    if word in known and word not in text
                }
    return found - FLAT


def upright(one: Note) -> list[str]:
    """Return the symbols above columns whose letters do not slant."""
    runs = [run for table in blocks(one, Table) for heading in table.headings for run in heading]
    shown = [run.content for run in runs if isinstance(run, Math) and isinstance(run.content, str)]
    return [content for content in shown if symbol_box(content) == Upright(content)]


def repeated(one: Note) -> set[str]:
    """Return the symbols that two rows of the tables of values have."""
    rows = [row for table in blocks(one, Table) if table.label in ("t:data", "t:summary") for row in table.rows]
    shown = Counter(row[1].content for row in rows if isinstance(row[1], Math))
    return {content for content, count in shown.items() if count > 1} - SPEED


test_every_symbol_of_every_formula_is_explained = every_note(lambda _, one: unexplained(one))
test_a_symbol_of_an_equation_stands_for_one_thing = every_note(lambda _, one: ambiguous(one))
test_no_symbol_of_an_equation_stands_flat_in_a_table = every_note(
    lambda case, one: flat(one, source(case.partition(": ")[0]))
)
test_every_symbol_of_a_table_has_letters_that_slant = every_note(lambda _, one: upright(one))
test_a_symbol_of_a_table_of_values_stands_for_one_row = every_note(lambda _, one: repeated(one))


def test_a_symbol_without_explanation_is_found():
    one = note("slider-crank")
    (table,) = (block for block in one.blocks if getattr(block, "label", "") == "t:nomenclature")
    for missing in ("ω", "φ"):
        rows = [(*row, "", "") for row in nomenclature(one) if row[0].content != missing]
        shown = tuple(replace(table, rows=rows) if block is table else block for block in one.blocks)
        assert len(rows) == len(nomenclature(one)) - 1
        assert unexplained(replace(one, blocks=shown)), missing


@for_each(
    ("name", "language", "letter", "both"),
    [
        ("petrol-four", "ru", "S", {"ход поршня, мм"}),
        ("petrol-four", "vi", "α", {"góc quay trục khuỷu"}),
        ("petrol-four", "vi", "β", {"góc lắc thanh truyền"}),
        ("double-acting-steam", "en", "n", {"moving links", "rotational speed, rpm"}),
        # a derivative and the transfer function that it is are one thing
        ("spark-engine", "en", "x″", {"second transfer function of the piston, m"}),
    ],
)
def test_a_letter_that_books_give_two_things_is_listed_with_both(name, language, letter, both):
    listed = [row[1] for row in nomenclature(note(name, language)) if row[0].content == letter]
    assert sorted(listed) == sorted(both)


def test_the_numbers_of_a_substance_stay_at_their_letters():
    box = symbol_box("M_H₂O")
    assert [type(part).__name__ for part in box.below.parts] == ["Script", "Upright"]


# equations of notes as they begin
PRINTED = {
    # a volume at a point of the diagram is not the clearance volume, nor an exponent a rotational speed
    ("spark-engine", "ru"): (
        "V_(c1) = V_c + F_п·S_x = ",
        "p_(c1) = p_(a)·(V_(a)/V_(c1))^n_1 = ",
        # the inertia force has a rod ratio of its own
        "j_ин = R·ω²·(cos φ + λ_ин·cos 2φ) = ",
        "P_j = −m_j·j_ин = ",
        # integrals say what they are
        "L_i = ∮ p dV = 905,655",
        "M_ср = 1/φ_ц·∫ M_кр dφ = 72,1365",
    ),
    ("v8-diesel", "ru"): ("T = P·sin(φ + β)/cos β + N_ш·cos φ = ", "M_кр = T·R = "),
    ("petrol-four", "ru"): (
        "Q_r = 1000·G_т·(M_2·h_μ,r − M_1·h_μ,0) = ",
        "L_изб = max ΔT − min ΔT = ",
    ),
    # the first two orders of the motion as textbooks have them
    ("slider-crank", "en"): (
        "x_I = r − r·cos φ = ",
        "v_I = r·ω·sin φ = ",
        "a_I = r·ω²·cos φ = ",
        "x_II = (r·λ − r·λ·cos 2φ)/4 = ",
        "v_II = r·λ·ω/2·sin 2φ = ",
        "a_II = r·λ·ω²·cos 2φ = ",
    ),
    # each order from the transfer function of its own order
    ("v8-diesel", "en"): ("v_I = x′_I·ω = ", "v_II = x′_II·ω = ", "a_I = x″_I·ω² = ", "a_II = x″_II·ω² = "),
}


def not_printed(case: str, language: str) -> list[str]:
    shown = printed(note(case, language))
    return [begins for begins in PRINTED[case, language] if not any(one.startswith(begins) for one in shown)]


@looked_at(*([one for one in PRINTED if (one[0] == "v8-diesel") == late] for late in (False, True)))
def test_equations_read_as_those_of_books(cases):
    assert broken(not_printed, cases) == {}


@pytest.mark.parametrize("name", ["petrol-four", pytest.param("radial-five", marks=pytest.mark.slow)])
def test_what_is_put_into_the_cycle_stands_in_the_table_of_its_data(name):
    rows = {row[1].content: row for row in value_rows(note(name, "ru"), "cycle_data") if isinstance(row[1], Math)}
    assert {"C", "H", "O", "a_m", "b_m", "c", "m", "m_r"} <= rows.keys()
    assert (rows["C"][2], rows["a_m"][2:]) == ("0,855", ("0,034", "МПа"))
    assert rows["C"][0].endswith("*")
    assert ("ξ_вп" in rows) == (name == "radial-five")


@pytest.mark.elsewhere
@for_each("path", [
    "examples/compressor-stages", "examples/triplex-pump", "examples/vibrating-crankshaft", "tests/machines/burning",
    "tests/machines/engine-test", "tests/machines/card-test", "tests/machines/stages-by-size",
])  # fmt: skip
def test_no_english_word_of_an_owner_stands_in_a_symbol(path):
    file = ROOT / f"{path}.toml"
    results, text = crankwork.analyse(crankwork.load(file)), file.read_text("utf-8")
    is_named = "piston_displacement" not in results.columns
    keys = {known.key for known in in_order(results.trace.values()) if known.key}
    # pins of a piston have their names at all times
    keys = {key for key in keys if not key.endswith("_pin")}
    for language in ("ru", "vi"):
        words = Words(language)
        for key in keys:
            for word in re.findall(r"[A-Za-z]{3,}", key_of(key).owner):
                shown = {value_symbol(key, language)} | ({words.symbol(key)} - {""} if is_named else set())
                below = ",".join(one.partition("_")[2] for one in shown)
                assert word in text or word in ("min", "max") or word not in below, (language, key, shown)
