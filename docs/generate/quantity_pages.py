"""The reference of results: every quantity with symbol, unit, sign, owner, formula and source."""

from __future__ import annotations

import functools
import importlib
import pkgutil
import re
from collections.abc import Iterator, Mapping

import crankwork
from crankwork.formula.expression import FORMULAS, Formula, record
from crankwork.locale import LANGUAGES, Language, capital, translate
from crankwork.note.captions import printed_unit
from crankwork.note.layout import EQUALS, row
from crankwork.note.math import formula_box, mathml_box
from crankwork.note.symbols import symbol_box
from crankwork.quantities import SUBJECTS, Quantity
from crankwork.quantities.key import key_of
from crankwork.sources import cite, school_source
from html_text import code, entry, raw, sentence, text
from key_pages import WORDS


@functools.cache
def formulas() -> Mapping[str, tuple[Formula, ...]]:
    """Return the registered formulas by quantity; a module that needs a package that is not installed has none."""
    for module in pkgutil.walk_packages(crankwork.__path__, "crankwork."):
        if not module.name.endswith("__main__"):
            try:
                importlib.import_module(module.name)
            except ModuleNotFoundError as absent:
                if (absent.name or "crankwork").startswith("crankwork"):
                    raise
    found: dict[str, tuple[Formula, ...]] = {}
    for name in sorted(FORMULAS):
        found[FORMULAS[name].quantity] = (*found.get(FORMULAS[name].quantity, ()), FORMULAS[name])
    return found


def math(box: object) -> str:
    """Return a box as mathematics of a web page."""
    return f"<math>{mathml_box(box)}</math>"  # type: ignore[arg-type]


def formula_html(formula: Formula, language: Language) -> str:
    """Return a formula with its source."""
    left = symbol_box(crankwork.QUANTITIES[formula.quantity].symbol(language))
    equation = math(row(left, EQUALS, formula_box(record(formula.shown), None, language)))
    source = school_source(formula.source, language, formula.quantity)
    return f'{equation} <span class="entry-source">{text(cite(source)) if source else ""}</span>'


def quantity_entry(quantity: Quantity, language: Language, owners: Mapping[str, tuple[str, str]]) -> str:
    """Return the entry of a quantity; `owners`: a key of each, and the machine whose results have it."""
    words = WORDS[language]
    key, example = owners.get(quantity.key, ("", ""))
    owner = words["of_machine"] if key and not key_of(key).owner else ""
    shown = text(words["owner_example"].format(example=f"`{key}`", file=f"`{example}`")) if key else ""
    definition = quantity.definition(language)
    sign = re.search(words["sign_in_definition"], definition)
    said = f"<strong>{text(capital(quantity.label(language)))}.</strong> {text(sentence(definition))}"
    equations = [formula_html(one, language) for one in formulas().get(quantity.key, ())]
    facts = [
        (words["symbol"], math(symbol_box(quantity.symbol(language)))),
        (words["unit_shown"], text(printed_unit(quantity.unit, language) or "–")),
        (words["si"], text(printed_unit(quantity.si_unit, language) or "–")),
        (words["per_area"], text(printed_unit(quantity.per_area_unit, language)) if quantity.metric_per_area else ""),
        (words["sign"], text(sign[0]) if sign else ""),
        (words["owner"], owner),
        (words["example"], shown),
        (words["formula"], "<br>".join(equations) or text(words["no_formula"])),
    ]
    return entry(quantity.key, quantity.key, said, facts)


def pages(language: Language, owners: Mapping[str, tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Yield the name of each page of a language, without its ending, and its text."""
    words = WORDS[language]
    toctree = "\n".join(["```{toctree}", ":maxdepth: 1", "", *SUBJECTS, "```"])
    yield "index", f"# {words['results_title']}\n\n{words['results_intro']}\n\n{toctree}\n"
    for name, quantities in SUBJECTS.items():
        title = f"# {translate(f'subjects.{name}', language)}\n"
        yield name, "\n".join([title, raw(quantity_entry(quantity, language, owners) for quantity in quantities)])


def nomenclature(language: Language) -> str:
    """Return the page of symbols."""
    words = WORDS[language]
    by_letter = sorted(
        {(quantity.symbol(language), quantity.label(language)): code(quantity.key) for rows in SUBJECTS.values()
         for quantity in rows}.items(),
        key=lambda item: (item[0][0].lower(), item[0]),
    )  # fmt: skip
    lines = [
        f"<tr><td>{math(symbol_box(symbol))}</td><td>{text(name)}</td><td>{key}</td></tr>"
        for (symbol, name), key in by_letter
    ]
    head = f"<thead><tr><th>{words['symbol']}</th><th>{words['quantity']}</th><th></th></tr></thead>"
    table = ['<div class="wide-table"><table class="symbols">', head, "<tbody>", *lines, "</tbody></table></div>"]
    terms = f"[{words['terms']}](../terms.md)"
    return f"# {words['nomenclature_title']}\n\n{words['nomenclature_intro']} {terms}.\n\n{raw(table)}\n"


def without_name() -> list[str]:
    """Return the quantities without a sentence, or without a name or a symbol in some language."""
    return [
        f"{language}: {quantity.key}"
        for rows in SUBJECTS.values()
        for quantity in rows
        for language in LANGUAGES
        if len(quantity.definition(language).split()) < 2
        or not quantity.definition(language).endswith(".")
        or not quantity.symbol(language)
        or not quantity.label(language)
    ]
