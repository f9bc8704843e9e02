"""A small part of the campaigns of hostile and plausible files, and that they notice each kind of fault."""

from __future__ import annotations

import os
import runpy
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from crankwork.errors import CrankworkError
from machine_texts import POINTS_ENGINE

CAMPAIGN = runpy.run_path(str(Path(__file__).with_name("campaign.py")))
FAULTS, hostile_file, outcome = (CAMPAIGN[name] for name in ("FAULTS", "hostile_file", "outcome"))
plausible_file, plausible_outcome = (CAMPAIGN[name] for name in ("plausible_file", "plausible_outcome"))


def _divide(*_: object) -> None:
    raise ZeroDivisionError


def _warn(*_: object) -> None:
    warnings.warn("overflow encountered in multiply", RuntimeWarning, stacklevel=1)


def _wait(*_: object) -> None:
    ends = time.process_time() + 5
    while time.process_time() < ends:
        pass


def _fill(*_: object) -> None:
    raise MemoryError


def _refuse(*_: object) -> None:
    raise CrankworkError("that is not possible; write something else")


def _say_no_more(*_: object) -> None:
    raise CrankworkError("my.toml:7: crank.radius: is wrong")


@pytest.mark.parametrize("numbers", [range(20, 50), pytest.param(range(250), marks=pytest.mark.slow)], ids=len)
def test_hostile_files_are_refused_with_place_and_fix_or_computed(numbers) -> None:
    found = {number: outcome(hostile_file(4, number)) for number in numbers}
    assert {number: one for number, one in found.items() if one.kind in FAULTS} == {}
    assert {one.kind for one in found.values()} >= {"accepted", "refused"}


@pytest.mark.parametrize("numbers", [(2, 3, 6, 7, 8, 10), pytest.param(range(1, 49), marks=pytest.mark.slow)], ids=len)
def test_plausible_machines_are_computed_or_refused_with_the_part(numbers) -> None:
    found = {number: plausible_outcome(1, number) for number in numbers}
    assert {number: one for number, one in found.items() if one.kind in FAULTS} == {}
    assert {one.kind for one in found.values()} >= {"accepted", "refused"}


def test_a_linkage_that_is_held_or_loose_must_be_told_with_a_part(monkeypatch) -> None:
    spoilt = [number for number in range(300) if plausible_file(1, number).wrong]
    assert {plausible_file(1, number).wrong for number in spoilt} == {"locks", "floats"}
    monkeypatch.setitem(CAMPAIGN["_refused"].__globals__, "outcome", lambda *_, **__: CAMPAIGN["Outcome"]("accepted"))
    assert plausible_outcome(1, spoilt[0]).kind == "untold"


@pytest.mark.slow
def test_a_file_of_a_number_is_always_the_same() -> None:
    program = (
        "import runpy, sys\n"
        "made = runpy.run_path(sys.argv[1])\n"
        "print(ascii([(made['hostile_file'](3, at), made['plausible_file'](3, at)) for at in range(20)]))"
    )
    command = [sys.executable, "-c", program, str(Path(__file__).with_name("campaign.py"))]
    environments = (os.environ | {"PYTHONHASHSEED": one, "PYTHONPATH": os.pathsep.join(sys.path)} for one in "12")
    one, other = (subprocess.run(command, env=env, capture_output=True, check=True).stdout for env in environments)
    assert one == other


def test_no_list_of_a_file_gets_into_itself() -> None:
    """Of this file a list is repeated, and a part of one copy put into another."""
    assert outcome(hostile_file(20261122, 26335)).kind == "refused"


def test_each_kind_of_fault_is_noticed(monkeypatch) -> None:
    text = POINTS_ENGINE
    assert outcome(text).kind == "accepted"
    faults = {_divide: "traceback", _warn: "warning", _wait: "hang", _fill: "memory", _refuse: "message",
              _say_no_more: "message"}  # fmt: skip
    found = {}
    for fault in faults:
        monkeypatch.setitem(outcome.__globals__, "SECONDS", 0.2 if fault is _wait else 60.0)
        monkeypatch.setitem(outcome.__globals__, "description_text", fault)
        found[fault] = outcome(text).kind
    assert found == faults


def test_values_that_are_not_finite_are_noticed_where_nothing_is_said_of_them(monkeypatch) -> None:
    analyse = outcome.__globals__["analyse"]

    def spoilt(machine, **options):
        results = analyse(machine, **options)
        results.columns["piston_velocity"][1] = np.inf
        return results

    monkeypatch.setitem(outcome.__globals__, "analyse", spoilt)
    assert outcome(POINTS_ENGINE) == ("silent", "not finite: piston_velocity")
