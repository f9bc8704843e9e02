"""Machine files: from text to machine, with all mistakes reported at once, each on its line."""

from __future__ import annotations

import functools
import hashlib
import itertools
import json
import re
import textwrap
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from crankwork import files
from crankwork.description import keys as engine_files
from crankwork.description.build import SIZES, build_clutch, build_machine, build_test
from crankwork.description.keys import (
    CLUTCH_FILE,
    FORMATS,
    LOADED_SIZED_FILE,
    LOADING,
    METHOD,
    OWN_SIZES,
    PIPED_VALVES,
    SIZED_FILE,
    TEST_FILE,
    VALVES,
    stated_document,
)
from crankwork.description.links_keys import (
    DRIVEN_FILE,
    GIVEN_MOTION_FILE,
    LINKAGE_FILE,
    PRESS_FILE,
    ROTOR_FILE,
    STAGES_FILE,
    TORSION_FILE,
    TRANSFER_FILE,
    TURNING_FILE,
    UNIT_SPEED_FILE,
)
from crankwork.description.measured_build import add_questions, in_file
from crankwork.description.schema import (
    ListOf,
    MapOf,
    NameOr,
    Nested,
    NumberOr,
    OneForAll,
    OneOrMore,
    TableSpec,
    Values,
    file_inputs,
    mistaken_names,
    nearest_name,
)
from crankwork.description.table_file import resolve_file_columns
from crankwork.description.toml_edit import locate
from crankwork.description.value_types import Reader, is_one_line, look_alikes
from crankwork.errors import CrankworkError, InputError, Problem, UnknownKeyError
from crankwork.loads.indicator import DiagramError
from crankwork.locale import LANGUAGES, ErrorMessage, Language, translate
from crankwork.machine import FileInputs, Machine
from crankwork.preparation.cylinders import each_cylinder
from crankwork.preparation.prepared import PreparedCylinder, prepare
from crankwork.resources import read_resource, resource_names
from crankwork.units import TO_LATIN
from crankwork.working_cycle.schools import SCHOOLS

TEMPLATES = "description/templates"
_UNLOADED, _WITH_LOADS = zip(*engine_files.GIVEN_SPEED, *engine_files.UNIT_SPEED, strict=True)
_ENGINES = (*_UNLOADED, SIZED_FILE, engine_files.CYCLE_FILE, engine_files.SIZED_CYCLE_FILE)
_TABULATED = (TRANSFER_FILE, GIVEN_MOTION_FILE)
_LOADED = (*_WITH_LOADS, LOADED_SIZED_FILE)
_LINKAGES = (LINKAGE_FILE, UNIT_SPEED_FILE, DRIVEN_FILE, *_TABULATED)
_ALONE = (TURNING_FILE, ROTOR_FILE, PRESS_FILE, STAGES_FILE, TEST_FILE, TORSION_FILE, CLUTCH_FILE)
FILES = (*_ENGINES, *_LOADED, *_LINKAGES, *_ALONE)
_MAX_PARTS = 8
_LEAST_PRESSURE = 1.0
_OF_LINKAGES = ("links", "sliders", "guides", "fixed_points", "positions")
# tables that need no mechanism, tables of one, and the keys of a file that has none of these
_WITHOUT_MECHANISM: tuple[tuple[str, tuple[str, ...], TableSpec], ...] = (
    ("rotor", (*_OF_LINKAGES, "rod", "cylinder", "engine", "gas", "cycle"), ROTOR_FILE),
    ("clutch", (), CLUTCH_FILE),
    ("test", (*_OF_LINKAGES, "rod"), TEST_FILE),
    ("stages", (*_OF_LINKAGES, "rod", "cylinder", "gas", "cycle"), STAGES_FILE),
    ("torsion", (*_OF_LINKAGES, "rod", "piston", "cylinder", "engine", "gas", "cycle", "torque", "load"), TORSION_FILE),
)
# tables with another message than that they stand in another kind of file
_ELSEWHERE = {"load": ErrorMessage("unknown_table_near", nearest="[[loads]]"), "rotor": ErrorMessage("rotor_beside")}
OF_LIQUID = PIPED_VALVES.keys.keys() - VALVES.keys.keys()
# what needs a speed: inertia, damping, and work of the gas in a time
_OF_SPEED = frozenset((
    "mass", "crosshead_mass", "small_end_mass", "big_end_mass", "inertia", "pieces", "measured", "valves", "damping",
    "cycle", "engine", "charges", "stages", "vessels", "balance", "torsion", "motor", "motor_selection", "flywheel",
    "test", "angular_acceleration",
))  # fmt: skip
# a name, and numbers of entries where it is a list
_STEP = re.compile(r"[^\[\]]+(\[[0-9]{1,4}\])*")
# a text of a template by its key, and a comment that consists of it
_WORDS = re.compile(r"\{([a-z][\w.]*)\}")
_SCHOOL = re.compile(r'^(school = )"\w+"', re.MULTILINE)
_COMMENT = re.compile(rf"^# {_WORDS.pattern}$", re.MULTILINE)
# decimal commas in a list, without spaces after them, and more mistakes of syntax than are looked for
_PAIRS = re.compile(r"=\s*(\[\s*(?:\d+,\d+,\s+)*0,(?!0\s*\])\d+(?:,\s+\d+,\d+)*\s*\])")
_MOST_MISTAKES = 20
_STRINGS = re.compile(r"""\"(?:\\.|[^\"\\])*\"?|'[^']*'?""")


class Setting(NamedTuple):
    """A value set by an option of the command line; messages name the option instead of a line."""

    option: str
    key: str
    value: Any


def read(path: str | Path, overrides: Sequence[str | Setting] = ()) -> Machine:
    """Return the machine that a file describes.

    Raises
    ------
    InputError
        With every mistake, each on its line.
    CrankworkError
        If the file cannot be read at all.
    """
    path = Path(path)
    advice = ErrorMessage("check_path_or_new", path=path)
    return read_machine(files.read_text(path, advice=advice), str(path), overrides, folder=path.parent)


def read_machine(
    source: str, name: str = "text", overrides: Sequence[str | Setting] = (), *, folder: Path | None = None
) -> Machine:
    """Return the machine that a text describes.

    Raises
    ------
    InputError
        With every mistake, each on its line.
    CrankworkError
        If the text is no TOML, or a setting is none.
    """
    source, values, mistakes = _mended(source, name)
    settings = apply_settings(values, overrides)
    reader = Reader.of(values, folder)
    machine = _build(values, reader)
    if mistakes or reader.problems or machine is None:
        for path, letters, latin in mistaken_names(values):
            mistake = Problem(path, ErrorMessage("key_look_alike", letters=letters, written=latin))
            reader.problems = [*(problem for problem in reader.problems if problem.key != path), mistake]
        raise input_error(source, name, reader, settings, mistakes)
    digest = hashlib.sha256("\0".join([source, *map(str, settings)]).encode("utf-8", "surrogatepass")).hexdigest()
    notices = (*machine.notices, *reader.notices)
    return replace(
        machine, notices=notices, units=values.get("units", "metric"), digest=digest, deviations=reader.deviations,
        tolerances=reader.tolerances,
    )  # fmt: skip


def _build(values: dict[str, Any], reader: Reader) -> Machine | None:
    """Return the machine of the values, or None after complaints."""
    if isinstance(stated := values.get("format"), int) and stated > FORMATS[-1]:
        # its keys may have other meanings
        reader.add_error("format", ErrorMessage("format_unknown", newest=str(FORMATS[-1])))
        return None
    keys, values = file_keys(values), with_first_sizes(values, reader)
    values = _without_strangers(values, keys, reader)
    reader.tables = keys.keys
    read_values = keys.read(resolve_file_columns(values, keys, reader), "", reader) or Values({}, keys)
    machine = _of_kind(keys, read_values, reader)
    weighs = any(code == "weight" for code, _ in reader.notices)
    for key, reason in idle_keys(keys, read_values).items():
        table, _, name = key.partition(".")
        if name in (read_values[table] or ()) and not (weighs and key == "method.gravity"):
            reader.add_error(key, reason)
    own_sizes = OWN_SIZES.keys() & read_values["engine"] if keys not in _LINKAGES and "engine" in read_values else ()
    for name in own_sizes:
        reader.notices = [notice for notice in reader.notices if notice[1]["path"] != ".".join(OWN_SIZES[name])]
        count, cylinders = len(read_values["engine"][name]), read_values["engine"]["cylinders"]
        if cylinders and count != cylinders:
            reader.add_error(f"engine.{name}", ErrorMessage("offsets_count", count=count, cylinders=int(cylinders)))
    if machine is not None and not reader.problems and (keys in _LOADED or own_sizes):
        machine = _loaded(machine, values, reader)
    elif machine is not None and keys in _ENGINES:
        machine = replace(machine, other_form=functools.partial(_linkage_form, machine, values, reader.options))
    if machine is None:
        return None
    return replace(machine, document=stated_document(read_values), inputs=functools.partial(_inputs, values))


def _without_strangers(values: dict[str, Any], keys: TableSpec, reader: Reader) -> dict[str, Any]:
    """Return the values of a file without the tables of other kinds of files; report them with those that exclude them.

    A table that is missing then is not reported: it may be the other one that is meant.
    """
    kept = dict(values)
    for name in [name for name, value in values.items() if isinstance(value, dict) and name not in keys.keys]:
        kinds = [kind for kind in FILES if name in kind.keys]
        excluding = min(([item for item in values if item not in kind.keys] for kind in kinds), key=len, default=[])
        if excluding := [item for item in excluding if item in keys.keys]:
            stated = [f"[{item}]" for item in excluding]
            reader.add_error(name, _ELSEWHERE.get(name) or ErrorMessage("table_apart", others=stated))
            del kept[name]
            for absent in keys.keys.keys() - values.keys():
                reader.suspect(absent)
    return kept


def with_first_sizes(values: dict[str, Any], reader: Reader) -> dict[str, Any]:
    """Return the values of a file with the sizes of cylinder 1, where each cylinder has its own; report both stated."""
    engine = values.get("engine")
    if not isinstance(engine, dict):
        return values
    for name, (table, key) in OWN_SIZES.items():
        if isinstance(sizes := engine.get(name), list) and sizes and isinstance(values.get(table, {}), dict):
            if key in values.get(table, {}):
                reader.add_error(f"engine.{name}", ErrorMessage("same", others=[f"{table}.{key}"]))
            values = {**values, table: {**values.get(table, {}), key: sizes[0]}}
    return values


def idle_keys(keys: TableSpec, values: Values) -> dict[str, ErrorMessage]:
    """Return the keys that can never have an effect with the others, with the reason; in files of format 1 few."""
    idle = dict[str, ErrorMessage]()
    masses = (values["rotor"] or {}).get("masses") or () if keys is ROTOR_FILE else ()
    if keys is ROTOR_FILE and not any(mass.si("reciprocating") for mass in filter(None, masses)):
        idle["rotor.reciprocating_share"] = ErrorMessage("rotor_no_pistons")
    if values["format"] == 1:
        return idle
    if keys in (*_TABULATED, *_ALONE):
        return idle | {f"method.{name}": ErrorMessage("idle_method") for name in METHOD.keys if name != "pi"}
    if keys in _LINKAGES:
        return idle
    if "gas" not in values and "cycle" not in values:
        idle |= {f"cylinder.{name}": ErrorMessage("idle_volume") for name in ("compression_ratio", "clearance_volume")}
    if "ratio" not in (values["rod"] or ()):
        idle["rod.ratio_definition"] = ErrorMessage("only_beside", key="ratio", advice="ratio = 0.25")
    return idle


def _inputs(values: dict[str, Any]) -> FileInputs:
    """Return what the values of a file state, and their defaults."""
    keys = file_keys(values)
    return file_inputs(keys.read(values, "", Reader.of(values)) or Values({}, keys), values)


# what a linkage form is made of
_OF_FORM = (
    "mechanism", "speed", "angular_acceleration", "cylinder", "masses", "gas", "engine", "drive", "has_gravity",
    "chambers", "loads", "friction",
)  # fmt: skip


def _linkage_form(stated: Machine, values: dict[str, Any], options: dict[str, Any], machine: Machine) -> Machine | None:
    """Return the linkage that an engine is; None if it is no longer the stated one, or by an approximate method.

    `options`: of the reader of its file.
    """
    from crankwork.description.shorthand import linkage_values  # noqa: PLC0415 - loaded where it is needed

    if not _is_unchanged(machine, stated) or not machine.method.is_exact:
        return None
    method = {key: value for key, value in values.get("method", {}).items() if key != "kinematics"}
    reader = Reader(**options | {"gravity": machine.method.gravity})
    linkage = _build(linkage_values({**values, "method": method}, machine), reader)
    if linkage is None or reader.problems:
        return None
    return replace(linkage, units=machine.units, document=machine.document)


def _is_unchanged(machine: Machine, stated: Machine) -> bool:
    """Return whether a machine has the parts that its description states."""
    return all(getattr(machine, name) is getattr(stated, name) for name in _OF_FORM)


def _engine_form(stated: Machine, engine: Machine, machine: Machine) -> Machine | None:
    """Return an engine without its friction and its motor; None if its linkage is no longer the stated one."""
    return engine if _is_unchanged(machine, stated) else None


def _loaded(machine: Machine, values: dict[str, Any], reader: Reader) -> Machine | None:
    """Return an engine with loads or friction as the linkage that it is; report mistakes at the keys of its file."""
    # other files do not load it
    from crankwork.description.shorthand import has_other_forces, key_of_engine, linkage_values  # noqa: PLC0415 - loaded where it is needed

    if not machine.method.is_exact:
        stated = next((key for key in (*LOADING, "engine") if key in values), "gas.valves")
        reader.add_error("method.kinematics", ErrorMessage("loaded_exact", method=machine.method.name, key=stated))
        return None
    own = Reader(**reader.options)
    linkage = _build(linkage_values(values, machine), own)
    for problem in own.problems:
        reader.add_error(key_of_engine(problem.key, values), problem.message)
    if linkage is None:
        return None
    notices: list[tuple[str, Mapping[str, float | str]]] = [*linkage.notices]
    notices += machine.engine.notices if machine.engine is not None else ()
    if has_other_forces(values):
        notices += [("loaded_without", {"name": name}) for name in ("bearings", "balance", "torsion") if name in values]
        return replace(linkage, stated=machine.stated, notices=tuple(notices))
    linkage = replace(linkage, stated=machine.stated, notices=tuple(notices))
    return replace(linkage, other_form=functools.partial(_engine_form, linkage, machine))


def _of_kind(keys: TableSpec, read_values: Values, reader: Reader) -> Machine | None:
    """Return the machine of values that were read, or None after complaints."""
    if keys in (TORSION_FILE, TURNING_FILE, PRESS_FILE, ROTOR_FILE):
        from crankwork.description import torque_build  # noqa: PLC0415 - few files load it

        if keys is ROTOR_FILE:
            return torque_build.build_rotor(read_values, reader)
        build = torque_build.build_torsion_alone if keys is TORSION_FILE else torque_build.build_turning
        return build(read_values, reader)
    if keys == STAGES_FILE:
        from crankwork.description.stages_build import build_compressor  # noqa: PLC0415 - loaded where it is needed

        return build_compressor(read_values, reader)
    if keys in _LINKAGES:
        # an engine starts faster without these modules
        from crankwork.description import links_build  # noqa: PLC0415 - loaded where it is needed

        build = links_build.build_tabulated if keys in _TABULATED else links_build.build_linkage
        return build(read_values, reader)
    if keys in (TEST_FILE, CLUTCH_FILE):
        return (build_test if keys is TEST_FILE else build_clutch)(read_values, reader)
    return _solvable(build_machine(read_values, reader), read_values, reader)


def _solvable(machine: Machine | None, values: Values, reader: Reader) -> Machine | None:
    """Return a crank mechanism; report pressures that cannot be calculated."""
    if machine is None:
        return None
    try:
        first = prepare(machine, machine.method, PreparedCylinder)
        differ = machine.engine is not None and machine.engine.gases
        solved = each_cylinder(first) if differ or machine.test is not None else (first,)
        add_questions(itertools.chain.from_iterable(cylinder.notices for cylinder in solved), values, reader)
        if machine.gas is not None and machine.gas.combustion is not None and first.space is not None:
            breaks = first.space.diagram.breaks
            for angle in breaks[first.space.diagram.pressure(breaks, breaks) < _LEAST_PRESSURE].tolist()[:1]:
                message = in_file("gas.measured", ErrorMessage("burning_vacuum", angle=angle), values)
                reader.add_error("gas.measured", message)
        if machine.test is not None:
            from crankwork.preparation.test_bed import check_test  # noqa: PLC0415 - few engines have a test

            check_test(machine, solved)
    except DiagramError as error:
        reader.add_error(error.key, in_file(error.key, error.args[0], values))
    except CrankworkError as error:
        table = next((name for name in ("cycle", "test") if name in values), "")
        if not table:
            raise
        reader.add_error(table, error.args[0])
    return machine


def file_keys(values: Mapping[str, Any]) -> TableSpec:
    """Return the keys for the kind of machine in a file: engine, linkage, table, shaft, or stages of a compressor."""
    if "transfer" in values:
        return TRANSFER_FILE
    if isinstance(table := values.get("table"), dict) and "angles" in table and "rod" not in values:
        return GIVEN_MOTION_FILE
    for name, excluded, keys in _WITHOUT_MECHANISM:
        if name in values and values.keys().isdisjoint(excluded):
            return keys
    if "torque" in values or ("load" in values and values.keys().isdisjoint((*_OF_LINKAGES, "rod"))):
        return TURNING_FILE if "torque" in values else PRESS_FILE
    crank = values.get("crank")
    has_no_speed = isinstance(crank, dict) and "speed" not in crank and ("transient" in values or _is_massless(values))
    if any(name in values for name in _OF_LINKAGES):
        return DRIVEN_FILE if "driver" in values else UNIT_SPEED_FILE if has_no_speed else LINKAGE_FILE
    cycle, cylinder, is_loaded = values.get("cycle"), values.get("cylinder"), not LOADING.keys().isdisjoint(values)
    gas = values.get("gas")
    if isinstance(gas, dict) and isinstance(valves := gas.get("valves"), dict):
        # a liquid is that of a chamber
        is_loaded = is_loaded or not OF_LIQUID.isdisjoint(valves)
    is_calculated = isinstance(cycle, dict) and cycle.get("kind") in ("petrol", "diesel")
    is_alone = is_calculated and not is_loaded and {"rod", "piston"}.isdisjoint(values)
    stated = cylinder if isinstance(cylinder, dict) else ()
    # a misspelt displacement counts too: the bore is not missing then
    has_sizes = not SIZES.isdisjoint(name if name in SIZES else nearest_name(name, SIZES) for name in stated)
    if (isinstance(cycle, dict) and "power" in cycle) or has_sizes:
        return engine_files.SIZED_CYCLE_FILE if is_alone else LOADED_SIZED_FILE if is_loaded else SIZED_FILE
    if is_alone:
        return engine_files.CYCLE_FILE
    kinds = engine_files.UNIT_SPEED if has_no_speed else engine_files.GIVEN_SPEED
    return kinds[set(stated) == {"offset"}][is_loaded]


def _is_massless(values: object) -> bool:
    """Return whether no force and no power of a mechanism depends on its speed: there are only lengths and loads."""
    if isinstance(values, dict):
        return values.keys().isdisjoint(_OF_SPEED) and all(map(_is_massless, values.values()))
    return all(map(_is_massless, values)) if isinstance(values, list) else True


def parse(source: str, name: str) -> dict[str, Any]:
    """Return the values of a TOML text; raise with all mistakes of its syntax, and for texts that take too long."""
    _, values, mistakes = _mended(source, name)
    if mistakes:
        raise _syntax_error(mistakes)
    return values


def _syntax_error(mistakes: Sequence[ErrorMessage]) -> CrankworkError:
    """Return the error with all mistakes of syntax."""
    return InputError([Problem("", message) for message in mistakes], [""] * len(mistakes))


def _mended(source: str, name: str) -> tuple[str, dict[str, Any], list[ErrorMessage]]:
    """Return a TOML text with mistakes of its syntax mended where it is plain how, its values, and the mistakes.

    Raises if one of them cannot be mended, with all of them.
    """
    lines = source.split("\n")
    _check_lines(lines, name)
    mistakes, is_whole, last = [*_list_commas(lines, name)], True, 0
    while True:
        try:
            values = tomllib.loads("\n".join(lines))
        except tomllib.TOMLDecodeError as error:
            match = re.search(r"\(at line (\d+), column \d+\)", str(error))
            number, mended = int(match[1]) if match else len(lines), ""
            if number > last:
                mistakes.append(_syntax_message("\n".join(lines), name, str(error)))
                mended = str(mistakes[-1].values.get("mended", ""))
            # without a heading the keys below it belong to another table
            is_lost = not match or number > len(lines) or not lines[number - 1] or lines[number - 1].startswith("[")
            if len(mistakes) > _MOST_MISTAKES or (is_lost and not mended):
                raise _syntax_error(mistakes) from None
            lines[number - 1], last, is_whole = mended, max(last, number), is_whole and bool(mended)
        except RecursionError:
            raise CrankworkError(ErrorMessage("nested", place=f"{name}:{_deepest(source)}")) from None
        except ValueError:
            # an integer of thousands of digits, or a date that no calendar has
            raise CrankworkError(ErrorMessage("cannot_be", place=f"{name}:1")) from None
        else:
            break
    if not is_whole:
        raise _syntax_error(mistakes)
    return "\n".join(lines), values, mistakes


def _check_lines(lines: Sequence[str], name: str) -> None:
    """Raise for lines that would take the parser too long."""
    for number, line in enumerate(lines, start=1):
        if len(line) > files.MAX_LINE:
            raise CrankworkError(ErrorMessage("line_long", place=f"{name}:{number}", most=files.MAX_LINE))
        if line.count(".") >= _MAX_PARTS and _most_parts(line) > _MAX_PARTS:
            raise CrankworkError(ErrorMessage("key_parts", place=f"{name}:{number}", most=_MAX_PARTS))


def _list_commas(lines: list[str], name: str) -> Iterator[ErrorMessage]:
    """Replace decimal commas in lists of numbers by points; yield a mistake for each list."""
    for number, line in enumerate(lines, start=1):
        if pairs := _PAIRS.search(line):
            written = re.sub(r"(\d),(?=\d)", r"\1.", pairs[1])
            lines[number - 1] = line.replace(pairs[1], written)
            yield ErrorMessage("list_commas", place=f"{name}:{number}", line=pairs[1], written=written)


def _most_parts(line: str) -> int:
    """Return how many parts the longest dotted key of a line has."""
    plain = _STRINGS.sub("s", line).partition("#")[0]
    plain = re.sub(r"\s*\.\s*", ".", plain)
    return max(sum(1 for part in key.split(".") if part) for key in re.split(r"[^\w.-]", plain))


def _deepest(source: str) -> int:
    """Return the line on which brackets are nested most deeply, roughly."""
    depth, deepest, line = 0, 0, 1
    for number, text in enumerate(source.split("\n"), start=1):
        depth += sum(text.count(mark) for mark in "[{") - sum(text.count(mark) for mark in "]}")
        if depth > deepest:
            deepest, line = depth, number
    return line


def _is_toml(line: str) -> bool:
    try:
        tomllib.loads(line)
    except ValueError:
        return False
    return True


# quotation marks of word processors
_CURLY = "“”„‟«»‘’‚‛"


def _syntax_message(source: str, name: str, text: str) -> ErrorMessage:
    """Return the message for a syntax error, with the line and a likely fix."""
    match = re.search(r"\(at line (\d+), column (\d+)\)", text)
    lines = source.split("\n")
    number = int(match[1]) if match else len(lines)
    place = f"{name}:{number}"
    line = _printable(lines[number - 1].strip()[:60]) if number <= len(lines) else ""
    if any(word in text for word in ("overwrite", "twice", "already", "mutate", "Duplicate", "immutable")):
        return ErrorMessage("stands_twice", place=place, line=line)
    written = re.sub(f"[{_CURLY}]", '"', line)
    if written != line and _is_toml(written):
        return ErrorMessage("curly_quotes", place=place, line=line, written=written, mended=written)
    spaced = re.match(r"(\[{1,2})([^\]\"']*\s[^\]\"']*)\]", line)
    if spaced is not None:
        written = f'{spaced[1]}"{spaced[2].strip()}"{"]" * len(spaced[1])}'
        return ErrorMessage("letters_need_quotes", place=place, line=line, written=written)
    comma = re.match(r"(.*?=\s*\[?(?:.*,\s)?)([+-]?\d+),(\d+)\s*(?:[\],#}]|$)", line)
    dotted = re.match(r"(\[{1,2})([^\]\"'#]*[^\x00-\x7f][^\]\"'#]*)\]", line)
    if dotted is not None and "." in dotted[2] and not look_alikes(dotted[2]):
        parts = (part.strip() for part in dotted[2].split("."))
        named = ".".join(part if part.isascii() else f'"{part}"' for part in parts)
        written = f"{dotted[1]}{named}{']' * len(dotted[1])}"
        return ErrorMessage("letters_need_quotes", place=place, line=line, written=written, mended=written)
    key = re.match(r"(\[{0,2})\s*([^=\[\]\"'#.]*[^\x00-\x7f][^=\[\]\"'#.]*)", line)
    if key is not None and (letters := look_alikes(key[2].strip())):
        written = key[2].strip().translate(TO_LATIN)
        # keys of files are in small letters
        written = written.lower() if written[1:].islower() else written
        values = {"place": place, "letters": letters, "written": written}
        return ErrorMessage("letters_look_alike", **values, mended=line.replace(key[2].strip(), written, 1))
    if key is not None:
        written = f'"{key[2].strip()}"'
        written = f"{key[1]}{written}{']' * len(key[1])}" if key[1] else f"{written} = ..."
        return ErrorMessage("letters_need_quotes", place=place, line=line, written=written)
    if comma is not None:
        point = f"{comma[2]}.{comma[3]}"
        mended = line.replace(f"{comma[2]},{comma[3]}", point) if _is_toml(f"{comma[1]}{point}") else ""
        return ErrorMessage("number_comma", place=place, line=line, point=point, mended=mended)
    bare = re.match(r"([\w.\-]+)\s*=\s*([+-]?[\d.,]+\s*(?:[^\W\d_]|/\s*\d)[^#\"]*)", line)
    if bare is not None:
        written = f'{bare[1]} = "{bare[2].strip().replace(",", ".")}"'
        return ErrorMessage("needs_quotes", place=place, line=line, written=written, mended=written)
    return ErrorMessage("not_toml", place=place, line=line or ErrorMessage("ends_early"))


def apply_settings(values: dict[str, Any], overrides: Sequence[str | Setting]) -> list[Setting]:
    """Apply the settings of options to the values, those that follow other numbers last; return them as applied."""
    from crankwork.description.document import following, follows_another  # noqa: PLC0415 - needs this module

    settings = [override if isinstance(override, Setting) else _setting(override) for override in overrides]
    settings.sort(key=lambda setting: follows_another(setting.value))
    for index, setting in enumerate(settings):
        if follows_another(setting.value):
            settings[index] = setting._replace(value=following(values, setting.key, setting.value))
        apply_override(values, settings[index])
    return settings


def _setting(text: str) -> Setting:
    """Return the setting that `KEY=VALUE` means, its value as TOML reads it or as the plain text it is."""
    key, sign, value = (part.strip() for part in text.partition("="))
    names = key.split(".")
    if not sign or not all(_STEP.fullmatch(name) for name in names) or len(names) > _MAX_PARTS:
        raise CrankworkError(ErrorMessage("setting_form", setting=_printable(text[:60])))
    if len(value) > files.MAX_LINE:
        raise CrankworkError(ErrorMessage("setting_long", setting=_printable(key[:60])))
    try:
        return Setting("--set", key, tomllib.loads(f"value = {value}")["value"] if "\n" not in value else value)
    except (ValueError, RecursionError):
        return Setting("--set", key, value)


def apply_override(values: dict[str, Any], setting: Setting) -> tuple[str, ...]:
    """Apply a setting to the values; return the keys that it excludes, which are removed."""
    if setting.option == "--step" and file_keys(values) in _TABULATED:
        raise CrankworkError(ErrorMessage("step_of_table"))
    *path, last = steps_of(setting.key)
    table: Any = values
    entry: Any = file_keys(values)
    shown = f"{setting.option} {_printable(setting.key[:60])}"
    for step, following in itertools.pairwise([*path, last]):
        entry = entry_at(entry, step)
        table = _entry_of(table, step, shown) if isinstance(step, int) else table.setdefault(step, {})
        if not isinstance(table, list if isinstance(following, int) else dict):
            name = step if isinstance(step, str) else f"[{step}]"
            code = "setting_no_list" if isinstance(following, int) else "setting_no_table"
            code = "setting_of_list" if isinstance(table, list) and isinstance(following, str) else code
            raise CrankworkError(ErrorMessage(code, setting=shown, name=_printable(name[:40])))
    if isinstance(last, int):
        _entry_of(table, last, shown)
        table[last - 1] = setting.value
        return ()
    known = entry.keys.get(last) if isinstance(entry, TableSpec) else None
    gives_way = known.instead_of if known else ()
    for other in gives_way:
        table.pop(other, None)
    table[last] = setting.value
    return gives_way


def steps_of(key: str) -> Iterator[str | int]:
    """Yield names, and the numbers of entries of lists, that lead to a key such as `loads[2].stiffness`."""
    parts = key.split(".")
    for part in parts:
        if not _STEP.fullmatch(part) or len(parts) > _MAX_PARTS:
            raise UnknownKeyError(ErrorMessage("key_form", key=_printable(key[:60])))
        name, *entries = part.replace("]", "").split("[")
        yield name
        yield from map(int, entries)


def _entry_of(table: list[Any], number: int, shown: str) -> Any:  # noqa: ANN401 - what the file has there
    """Return an entry of a list by its number from 1."""
    if not 1 <= number <= len(table):
        raise CrankworkError(ErrorMessage("setting_no_entry", setting=shown, number=number, count=len(table)))
    return table[number - 1]


def entry_at(entry: object, step: str | int) -> object:
    """Return the type of an entry of a table or list."""
    match entry:
        case TableSpec():
            return entry.keys[step].kind if isinstance(step, str) and step in entry.keys else None
        case MapOf() | ListOf() | Nested() | OneForAll() | OneOrMore():
            return entry.entry
        case NameOr():
            return entry_at(entry.other, step)
        case NumberOr():
            return entry_at(entry.quantity, step)
    return None


def input_error(
    source: str, name: str, reader: Reader, settings: Sequence[Setting] = (), syntax: Sequence[ErrorMessage] = ()
) -> InputError:
    """Return the error with all problems, those of the syntax first, in the order of the lines."""
    lines = locate(source)
    located = [(0, "", Problem("", message)) for message in syntax]
    for problem in reader.problems:
        message = problem.message
        message = message.cleaned(_printable) if isinstance(message, ErrorMessage) else _printable(message)
        setting = next((candidate for candidate in settings if _concerns(problem.key, candidate.key, lines)), None)
        if setting is not None:
            key = f" {_printable(problem.key)}" if setting.option == "--set" else ""
            located.append((0, f"{setting.option}{key}", Problem("", message)))
            continue
        key = problem.key
        while key and key not in lines:
            key = key[: max(key.rfind("."), key.rfind("["), 0)]
        line = lines[key] if key else 1
        located.append((line, f"{name}:{line}", Problem(_printable(problem.key), message)))
    located.sort(key=lambda item: item[0])
    if reader.more:
        located.append((0, name, Problem("", ErrorMessage("more_mistakes", count=reader.more))))
    return InputError([problem for _, _, problem in located], [position for _, position, _ in located])


def _concerns(blamed: str, key: str, lines: Mapping[str, int]) -> bool:
    """Return whether a problem is of a setting: its key, a key inside its value, or a table that it created."""
    made = [blamed, *(blamed[:index] for index, mark in enumerate(blamed) if mark == ".")]
    return (
        blamed == key
        or blamed.startswith((f"{key}.", f"{key}["))
        or any(key.startswith(f"{key_part}.") and key_part not in lines for key_part in made)
    )


def _printable(text: str) -> str:
    """Return a text of the user for a message: one line, no control characters, not too long."""
    # the end says what to write instead
    text = text if len(text) <= 400 else f"{text[:240]} ... {text[-155:]}"
    return "".join(letter if is_one_line(letter) else ascii(letter)[1:-1] for letter in text)


def json_schema(language: Language = "en") -> str:
    """Return the JSON Schema of the machine file, for editors, its descriptions in a language."""
    return schema_text("crankwork machine file", {"anyOf": [keys.schema(language) for keys in FILES]})


def schema_text(title: str, schema: dict[str, Any]) -> str:
    """Return a JSON Schema as a file of its own."""
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": title}
    return json.dumps(head | schema, indent=2, ensure_ascii=False)


def template_names() -> list[str]:
    """Return the names of the templates."""
    return resource_names(TEMPLATES, ".toml")


def template(name: str, language: Language = "en") -> str:
    """Return the commented machine file to start from: title and comments in a language, the school that of its books.

    Raises
    ------
    CrankworkError
        If there is none of that name.
    """
    if language not in LANGUAGES:
        raise CrankworkError(ErrorMessage("language_unknown", name=str(language)[:20], known=", ".join(LANGUAGES)))
    if name not in template_names():
        shown, known = _printable(name[:40]), ", ".join(template_names())
        if near := nearest_name(name, template_names()):
            raise CrankworkError(ErrorMessage("no_template_near", name=shown, nearest=near))
        raise CrankworkError(ErrorMessage("no_template", name=shown, known=known))

    def text_of(match: re.Match[str]) -> str:
        return translate(match[1] if "." in match[1] else f"templates.{match[1]}", language)

    def comment(match: re.Match[str]) -> str:
        return textwrap.fill(text_of(match), 116, initial_indent="# ", subsequent_indent="# ", break_on_hyphens=False)

    text = _WORDS.sub(text_of, _COMMENT.sub(comment, read_resource(*TEMPLATES.split("/"), f"{name}.toml")))
    return _SCHOOL.sub(f'\\1"{language}"', text) if language in SCHOOLS else text


def template_title(name: str, language: Language = "en") -> str:
    """Return the title of a template in a language."""
    return str(tomllib.loads(template(name, language))["title"])
