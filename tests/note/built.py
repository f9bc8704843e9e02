"""Machines whose notes the tests read: each is analysed once, and its steps and its notes are written once."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import pytest

import crankwork
import notes
from crankwork.cylinders.arrangement import boxer, inline, radial, vee
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import TracedValue
from crankwork.machine import Bearings, Drive, Engine
from crankwork.note.document import Note
from crankwork.note.lines import Group, lines_of
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.quantities import Language
from machine_texts import POINTS_ENGINE

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
TEMPLATES = Path(crankwork.__file__).parent / "description" / "templates"

# --- machines, each with the method of its file or another one: "engine template: textbook"

# one of a kind: an engine as in textbooks, four cylinders with a working cycle, steam on both sides, joint forces,
# a table of torques, a turning moment, motion alone
SOME = (
    "spark-engine", "petrol-four", "double-acting-steam", "press-geometry", "press", "punching-machine", "slider-crank",
)  # fmt: skip
ENGINES = (
    "spark-engine: exact", "petrol-four: textbook", "v8-diesel", "radial-five", "narrow-v6: textbook", "two-stroke",
    "compressor template",
)  # fmt: skip
LINKAGES = (
    "atkinson", "beta-stirling", "opposed-pistons", "excavator-boom", "parallelogram",
    "press-start", "scotch-yoke template",
    "slider-crank template: exact",
)  # fmt: skip
LOADS = """
[[loads]]
kind = "force"
point = "P"
x = "-100 N"
[[loads]]
kind = "torque"
link = "rocker"
at = ["0 deg", "360 deg"]
torque = ["3 N*m", "3 N*m"]
[table]
"""
FLYWHEEL = "[flywheel]\nfluctuation = 0.04\n"
MOTOR = '[motor]\nrated_power = "2.2 kW"\nrated_speed = "1430 rpm"\noverload = 2.2\npole_pairs = 2\nratio = 24\n'
RIGID = ('# inertia = "0.0042 kg*m2"', 'inertia = "0.0042 kg*m2"')
OFFSET = ('# offset = "0 mm"', 'offset = "7 mm"')
LEANING = ('# inclination = "0 deg"', 'inclination = "35 deg"')
WEIGHTS = ("# weights = true", "weights = true")
UNSTEADY = ('# angular_acceleration = "0 rad/s2"', 'angular_acceleration = "900 rad/s2"')
# a template and what is changed in it
CHANGED = {
    "rigid rod": ("engine", RIGID),
    "negative offset": ("engine", ('# offset = "0 mm"', 'offset = "-7 mm"')),
    "weight": ("engine", WEIGHTS),
    "everything": ("engine", RIGID, OFFSET, LEANING, WEIGHTS, UNSTEADY),
    "two rod ratios": ("engine", ("# inertia_rod_ratio", "inertia_rod_ratio"), UNSTEADY),
    "long crank": ("engine", ('length = "160 mm"', 'length = "120 mm"')),
    "double acting": (
        "compressor", ('# piston_rod_diameter = "25 mm"', 'piston_rod_diameter = "25 mm"'),
        ("[gas]", '[gas]\nback_pressure = "0.4 bar"'),
    ),
    "flywheel and motor": ("toggle-press", ("[table]", f"{FLYWHEEL}{MOTOR}[table]")),
    "heavy rotor": ("crank-shaper", ("[table]", f'{FLYWHEEL}{MOTOR}inertia = "0.01 kg*m2"\n[table]')),
    "unsteady linkage": (
        "four-bar",
        ('speed = "100 rpm"', 'speed = "100 rpm"\nangular_acceleration = "40 rad/s2"\ninertia = "0.1 kg*m2"'),
        ("[table]", LOADS),
    ),
}  # fmt: skip
VARIANTS = (*CHANGED, "gas alone", "press, forward", "press, central", "press, spectral")

LAYOUTS = {
    "I1": inline(1, (1,))[0],
    "I4": inline(4, (1, 3, 4, 2), spacing=0.12)[0],
    "V6": vee(6, (1, 4, 2, 5, 3, 6), 90.0, spacing=0.12, bank_stagger=0.03, throws=(0, 120, 240), uneven=True)[0],
    "V8": vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0, spacing=0.12)[0],
    "B4": boxer(4, (1, 4, 3, 2), spacing=0.12)[0],
    "R7": radial(7, master=0)[0],
}
SIZED = {"bearings": Bearings(0.06, 0.03, 0.07, 0.03, 0.025, 0.03), "counterweight": 0.02, "rotating_share": 0.4}


def laid_out(layout: str, **changes) -> crankwork.Machine:
    """Return the spark engine with as many cylinders as a layout has."""
    petrol = machine("spark-engine")
    method = replace(petrol.method.named("exact"), inertia_rod_ratio=None)
    return replace(petrol, method=method, engine=Engine(LAYOUTS[layout], **changes))


BUILT = {
    **{name: partial(laid_out, name) for name in LAYOUTS},
    "weights": lambda: replace(laid_out("V8", **SIZED), has_gravity=True),
    "unsteady": lambda: replace(laid_out("I4"), drive=Drive(fluctuation=0.02, inertia=0.1), angular_acceleration=900.0),
    "radial with weights": lambda: replace(machine("radial-five"), has_gravity=True),
    "four without masses": lambda: replace(laid_out("I4"), masses=None),
    "four without gas": lambda: replace(laid_out("I4"), masses=None, gas=None),
    "enough": lambda: replace(laid_out("I4"), drive=Drive(fluctuation=0.02, inertia=1e3)),
    "shafts": lambda: laid_out("I4", balance_shafts=(2,), **SIZED),
}


@cache
def machine(name: str) -> crankwork.Machine:
    if name in BUILT:
        return BUILT[name]()
    return crankwork.read(path(name)) if path(name).exists() else crankwork.read_machine(source(name))


def path(name: str) -> Path:
    """Return the file of an example or a template."""
    kind, is_template, _ = name.partition(" template")
    return (TEMPLATES if is_template else EXAMPLES) / f"{kind}.toml"


@cache
def source(name: str) -> str:
    """Return what a machine is read from."""
    if name in CHANGED:
        kind, *changes = CHANGED[name]
        text = crankwork.template(kind)
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        return text
    if name == "engine of points":
        return POINTS_ENGINE
    if name == "gas alone":
        lines = crankwork.template("engine").splitlines()
        return "\n".join(one for one in lines if "mass" not in one and "small_end_share" not in one)
    if name.startswith("press, "):
        text, count = re.subn(r"reduced_inertia_1 = .*\n", f'differences = "{name[7:]}"\n', source("press"))
        assert count == 1
        return text
    return path(name).read_text("utf-8")


@cache
def results(case: str) -> crankwork.Results:
    """Return the results of a machine by the method of its file or another one."""
    name, _, method = case.partition(": ")
    if not method and (EXAMPLES / f"{name}.toml").exists():
        return notes.results(name)
    one = machine(name)
    return crankwork.analyse(crankwork.with_method(one, method) if method else one)


@cache
def groups(case: str, *degrees: float) -> tuple[Group, ...]:
    """Return the groups of steps that a note shows, at chosen crank angles."""
    shown = results(case)
    return lines_of(shown, *degrees)


def lines(case: str, group: str, *degrees: float) -> dict:
    """Return the steps of a group by their keys, none where there is no such group."""
    return {line.key: line for one in groups(case, *degrees) if one.name == group for line in one.lines}


@cache
def note(case: str, language: Language = "en") -> Note:
    return note_of(results(case), NoteOptions(full=True, language=language, figures=False))


def key_of(shown: crankwork.Results, name: str) -> str:
    """Return the key in results of a value that has a name in lines: of an engine that of cylinder 1 or of all."""
    keys = [key for key, known in shown.trace.items() if known.key == name and key in {*shown.summary, *shown.columns}]
    return name if name in keys or not keys else keys[0]


def traced(shown: crankwork.Results) -> Iterator[TracedValue]:
    """Yield everything that results remember under each of its names."""
    stack, seen = [one for key, known in shown.trace.items() for one in (known.named(key), known)], set()
    while stack:
        one = stack.pop()
        if (id(one.node), one.key) not in seen:
            seen.add((id(one.node), one.key))
            yield one
            stack.extend(one.node.operands)


def schools(case: str) -> tuple[Language, Language]:
    """Return the languages in which the note of a machine is read where not all three are: notes differ by school."""
    return "en", "ru" if len(case) % 2 else "vi"


# --- rules that hold for every machine


def looked_at(*parts: Iterable[str]) -> pytest.MarkDecorator:
    """Return a parameter `cases`: the first part of the machines is always looked at, others where there is time."""
    first, *others = map(tuple, parts)
    late = [pytest.param(one, id=f"more-{at}", marks=pytest.mark.slow) for at, one in enumerate(others, start=1)]
    return pytest.mark.parametrize("cases", [pytest.param(first, id="some"), *late])


every_machine = looked_at(SOME, ENGINES, LINKAGES)


def broken(rule: Callable[..., object], cases: Iterable) -> dict[str, object]:
    """Return what a rule says is wrong with each of the cases, of those with which something is wrong."""
    found = {}
    for case in cases:
        try:
            said = rule(*case) if isinstance(case, tuple) else rule(case)
        except (AssertionError, CrankworkError, LookupError, ValueError) as error:
            said = f"{type(error).__name__}: {error}"
        if said:
            found[case] = said
    return found
