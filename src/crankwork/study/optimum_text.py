"""What is found of a search for the best design: its machine file, in words, as plain data and as tables."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path, PurePath
from typing import Any

import numpy as np

from crankwork.description.document import Description
from crankwork.description.machine_file import settings_of
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, say
from crankwork.locale.numbers import aligned, number, unit_name
from crankwork.report.language import displayed, displayed_column, displayed_size, key_unit, label, plain, rounded
from crankwork.report.tables import Sheet, csv_of_sheet
from crankwork.study.optimise import Holding, Optimum
from crankwork.study.study_file import Study
from crankwork.study.varied import Varied
from crankwork.units import from_si, use_units

_DIGITS = 8
# of what the machine file states of the best design
_WRITTEN = 10
# what limits and bounds may leave of a gradient
_EXPLAINED = 1e-3


def optimum_files(study: Study, found: Optimum, folder: str | PurePath) -> dict[str, bytes]:
    """Return what goes into a folder: the machine file of the best design, how it was found, and the summary."""
    data = json.dumps(optimum_data(study, found), ensure_ascii=False, indent=1)
    with use_units(study.units):
        tables = {f"tables/{name}.csv": csv_of_sheet(sheet) for name, sheet in _sheets(study, found).items()}
    machine = _machine(study, found, folder).dump()
    return {"machine.toml": machine.encode(), "summary.json": f"{data}\n".encode(), **tables}


def _machine(study: Study, found: Optimum, folder: str | PurePath) -> Description:
    """Return the machine file with the numbers of the best design, that finds its tables from another folder."""
    own = study.machine
    best = Description(own.dump(), own.name, folder=own.folder)
    settings = {one.key: one.value for one in settings_of(study.overrides)}
    tables = {
        key: Path(os.path.relpath((own.folder or Path()) / own[key], folder)).as_posix()
        for key in own
        if key.rpartition(".")[2] == "file" and isinstance(own[key], str)
    }
    for key, value in (settings | tables | _written(study, found)).items():
        best[key] = value
    return best


def _written(study: Study, found: Optimum) -> dict[str, str | float]:
    """Return what the machine file states of the best design."""
    return {
        one.key: f"{_of_field(one, value):.{_WRITTEN}g} {one.unit}" if one.unit else rounded(value, _WRITTEN)
        for one, value in zip(study.varied, found.fields.values(), strict=True)
    }


def _of_field(one: Varied, value: float) -> float:
    return float(from_si(value, one.unit))


def _sheets(study: Study, found: Optimum) -> dict[str, Sheet]:
    """Return every design that was looked at, and where the search from each start has come to."""
    places = {key: np.array([one[key] for one in found.places]) for key in found.places[0]}
    return {
        "course": _sheet(study, {**found.history.fields, **found.history.values}),
        "starts": _sheet(study, places),
    }


def _sheet(study: Study, columns: dict[str, Array]) -> Sheet:
    units = {one.key: one.unit for one in study.varied}
    shown = {
        key: np.asarray(from_si(of, units[key])) if key in units else displayed_column(key, of)
        for key, of in columns.items()
    }
    return Sheet((), shown, {key: units[key] if key in units else key_unit(key) for key in columns})


def optimum_text(study: Study, found: Optimum, language: Language = "en") -> str:
    """Return the best design in words: what it states, what it gives and what holds it."""
    with use_units(study.units):
        return "\n".join(_lines(study, found, language))


def _lines(study: Study, found: Optimum, language: Language) -> Iterator[str]:
    if study.title:
        yield study.title
    of = label(found.objective, language)
    value = _value(found.objective, found.value, language)
    before = _value(found.objective, study.stated[found.objective], language)
    yield say(f"study.best_{found.sense}", language, name=capital(of), value=value, stated=before)
    yield from ("", say("study.best_design", language))
    yield from aligned([
        (one.key, _field(one, found.fields[one.key], language), _stated(one, language)) for one in study.varied
    ])  # fmt: skip
    if others := [(label(key, language), _value(key, of, language)) for key, of in found.values.items()][1:]:
        yield from ("", say("study.best_values", language), *aligned(others))
    yield ""
    yield say("study.held_by" if found.holding else "study.held_by_nothing", language, name=of)
    yield from aligned([_held(study, found, one, language) for one in found.holding])
    if found.rest > _EXPLAINED:
        yield say("study.unexplained", language, share=number(100 * found.rest, language, digits=2))


def _value(key: str, value: float, language: Language) -> str:
    return f"{number(displayed(key, value), language, digits=_DIGITS)} {unit_name(key_unit(key), language)}".rstrip()


def _field(one: Varied, value: float, language: Language) -> str:
    return f"{number(_of_field(one, value), language, digits=_DIGITS)} {unit_name(one.unit, language)}".rstrip()


def _stated(one: Varied, language: Language) -> str:
    now = None if one.number is None else one.number.now
    return "" if now is None else f"({_field(one, now, language)})"


def _held(study: Study, found: Optimum, one: Holding, language: Language) -> tuple[str, str, str]:
    """Return a limit or a bound, and what the objective changes by with it."""
    fields = {field.key: field for field in study.varied}
    is_field = one.key in fields
    level = _field(fields[one.key], one.level, language) if is_field else _value(one.key, one.level, language)
    unit = fields[one.key].unit if is_field else key_unit(one.key)
    price = number(_price(study, found, one), language, digits=4)
    units = (unit_name(key_unit(found.objective), language) or "1", unit_name(unit, language) or "1")
    return one.key if is_field else label(one.key, language), f"{one.sense} {level}", f"{price} {units[0]}/{units[1]}"


def _price(study: Study, found: Optimum, one: Holding) -> float:
    """Return what the objective changes by with a level, in units of tables and of the file."""
    fields = {field.key: field for field in study.varied}
    of = _in_file(fields[one.key], 1.0) if one.key in fields else displayed_size(one.key, 1.0)
    return displayed_size(found.objective, one.price) / of


def _now(study: Study) -> dict[str, float | None]:
    """Return what the machine file states of each field that varies. [SI]"""
    return {one.key: one.number.now if one.number else None for one in study.varied}


def _in_file(one: Varied, size: float) -> float:
    return _of_field(one, size) - _of_field(one, 0.0)


def optimum_data(study: Study, found: Optimum) -> dict[str, Any]:
    """Return the best design as plain data, in the units of the file and the tables."""
    with use_units(study.units):
        return _data(study, found)


def _data(study: Study, found: Optimum) -> dict[str, Any]:
    fields = {one.key: one for one in study.varied}
    size = displayed_size(found.objective, 1.0)

    def shown(key: str, value: float) -> object:
        return plain(_of_field(fields[key], value) if key in fields else displayed(key, value))

    return {
        "title": study.title,
        "objective": found.objective,
        "sense": found.sense,
        "units": {key: fields[key].unit if key in fields else key_unit(key) for key in (*fields, *found.values)},
        "fields": {key: shown(key, value) for key, value in found.fields.items()},
        "written": _written(study, found),
        "stated": {key: None if now is None else shown(key, now) for key, now in _now(study).items()},
        "values": {key: shown(key, value) for key, value in found.values.items()},
        "gradient": {key: plain(size * by / _in_file(fields[key], 1.0)) for key, by in found.gradient.items()},
        "holding": [
            {"key": one.key, "sense": one.sense, "level": shown(one.key, one.level),
             "price": plain(_price(study, found, one))}
            for one in found.holding
        ],
        "rest": plain(found.rest),
        "places": [{key: shown(key, value) for key, value in one.items()} for one in found.places],
        "designs": len(found.history),
        "way": found.way,
        "seed": found.seed,
        "not_compiled": found.reason,
    }  # fmt: skip
