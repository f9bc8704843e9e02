"""Every symbol of every printed formula is explained before it comes or where it comes first."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import crankwork
from crankwork.formula.expression import symbol
from crankwork.formula.lines import FormulaLine, symbols_of
from crankwork.notation import ARGUMENTS
from crankwork.note.contents import note_of
from crankwork.note.document import Equation, Note, Table
from crankwork.note.equations import equation_symbol, own_key, printed_equation, value_symbol
from crankwork.note.options import NoteOptions
from crankwork.quantities import QUANTITIES
from crankwork.report.language import symbol as key_symbol

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
CONSTANTS = ("pi",)


@cache
def results(path: Path):
    return crankwork.analyse(crankwork.read(path))


def note(path: Path, language: str) -> Note:
    return note_of(results(path), NoteOptions(language=language, figures=False))


def needed(step: FormulaLine, language: str) -> dict[str, tuple[str, ...]]:
    """Return the symbols that must be known by the symbols of a formula as they are printed."""
    named = dict(step.named)
    found: dict[str, tuple[str, ...]] = {}
    for name in symbols_of(step.expression):
        if name in CONSTANTS:
            continue
        if name in named:
            found[value_symbol(named[name], language)] = (key_symbol(own_key(named[name]).partition(".")[0], language),)
            continue
        entry = ARGUMENTS[name]
        if any(mark in entry.pattern for mark in ("sin", "cos")):
            bases = [QUANTITIES[key].symbol(language) for key in (entry.quantity, entry.extra) if key]
            found[symbol(name, language)] = tuple(bases)
        else:
            found[symbol(name, language)] = (symbol(name, language),)
    return found


def unexplained(one: Note, language: str) -> list[str]:
    known: set[str] = set()
    missing: list[str] = []
    for block in one.blocks:
        if not isinstance(block, Equation):
            continue
        known |= {entry.symbol for entry in block.legend}
        kind = getattr(block.step, "key", "").partition(".")[0]
        known |= {QUANTITIES[kind].symbol(language)} if kind in QUANTITIES and block.symbol in known else set()
        if isinstance(block.step, FormulaLine):
            symbols = needed(block.step, language)
            # one of a kind is explained for all of them
            known |= {base for printed, wanted in symbols.items() for base in wanted if printed in known}
            for printed, wanted in symbols.items():
                if not ({printed} <= known or set(wanted) <= known):
                    missing.append(f"{printed} in {printed_equation(block, language).text}")
        known.add(block.symbol or equation_symbol(block.step, language))
    return missing


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda one: one.stem)
def test_every_symbol_of_every_formula_is_explained(path, language):
    assert not unexplained(note(path, language), language)


def test_a_symbol_without_explanation_is_found():
    one = note(EXAMPLES[0], "en")
    bare = [Equation(block.step) if isinstance(block, Equation) else block for block in one.blocks]
    assert unexplained(Note(one.title, "en", tuple(bare)), "en")


def printed(name: str, language: str = "ru") -> list[str]:
    path = next(one for one in EXAMPLES if one.stem == name)
    blocks = note(path, language).blocks
    return [printed_equation(one, language).text for one in blocks if isinstance(one, Equation)]


@pytest.mark.parametrize(
    ("name", "line"),
    [
        # a volume at a point of the diagram is not the clearance volume, nor an exponent a rotational speed
        ("spark-engine", "V_(c1) = V_c + F_п·S_x = "),
        ("spark-engine", "p_(c1) = p_(a)·(V_(a)/V_(c1))^n_1 = "),
        # the inertia force has a rod ratio of its own
        ("spark-engine", "j_ин = R·ω²·(cos φ + λ_ин·cos 2φ) = "),
        ("spark-engine", "P_j = −m_j·j_ин = "),
        ("v8-diesel", "T_5 = T(300°) = "),
        ("v8-diesel", "M_кр,5 = T_5·R = "),
        ("v8-diesel", "δ = L_изб/(J_Σ·ω²) = "),
        ("petrol-four", "Q_r = 1000·G_т·(M_2·h_μ,r − M_1·h_μ,0) = "),
        ("petrol-four", "M_кш,3 = M_кш,2 + M_кр,2 = "),
        # integrals say what they are
        ("spark-engine", "L_i = ∮ p dV = 905,655"),
        ("spark-engine", "M_ср = 1/φ_ц·∫ M_кр dφ = 72,1365"),
        ("petrol-four", "L_изб = max ∫(M_Σ − M_Σср) dφ − min ∫(M_Σ − M_Σср) dφ = "),
    ],
)
def test_a_value_has_a_symbol_of_its_own(name, line):
    assert any(one.startswith(line) for one in printed(name))


@pytest.mark.parametrize("name", ["petrol-four", "radial-five"])
def test_what_is_put_into_the_cycle_stands_in_the_table_of_its_data(name):
    path = next(one for one in EXAMPLES if one.stem == name)
    table = next(one for one in note(path, "ru").blocks if isinstance(one, Table) and one.label == "t:cycle_data")
    symbols = {row[1].content: row for row in table.rows}
    assert {"C", "H", "O", "a_m", "b_m", "c", "m", "m_r"} <= symbols.keys()
    assert (symbols["C"][2], symbols["a_m"][2:]) == ("0,855", ("0,034", "МПа"))
    assert "принято" in symbols["C"][0]
    assert ("ξ_вп" in symbols) == (name == "radial-five")
