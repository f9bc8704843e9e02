"""Errors of crankwork go from one process to another as they are."""

from __future__ import annotations

import copy
import importlib
import inspect
import multiprocessing
import pickle
import pkgutil
from pathlib import Path

import pytest

import crankwork
from crankwork.errors import Problem
from crankwork.locale import ErrorMessage

REFUSAL = ErrorMessage("check_path")
# what the classes are made of that take more than a text
ARGUMENTS = {
    "InputError": ([Problem("crank.radius", REFUSAL), Problem("speed", "no unit")], ["my.toml:3", "--set"]),
    "MissingExtraError": (REFUSAL, "fast", "data"),
    "LayoutError": ("firing_order", REFUSAL),
    "DiagramError": ("gas.points", REFUSAL),
    "NotCompiledError": ("procedure", "joint_force.A"),
}


def _classes() -> dict[str, type[BaseException]]:
    found = {}
    for one in pkgutil.walk_packages(crankwork.__path__, "crankwork."):
        # what is compiled is imported only where Numba is installed, and has no errors of its own
        if not one.name.endswith(("__main__", "kernel.elementary", "shaft.compiled_steps")):
            module = importlib.import_module(one.name)
            classes = inspect.getmembers(module, lambda one: inspect.isclass(one) and issubclass(one, BaseException))
            found |= {name: kind for name, kind in classes if kind.__module__.startswith("crankwork.")}
    return found


def test_every_error_comes_back_from_a_pickle_and_a_copy() -> None:
    classes = _classes()
    assert ARGUMENTS.keys() <= classes.keys()
    changed = {}
    for name, kind in classes.items():
        error = kind(*ARGUMENTS.get(name, (REFUSAL,)))
        for way in (lambda one: pickle.loads(pickle.dumps(one)), copy.copy, copy.deepcopy):  # noqa: S301 - ours
            back = way(error)
            if (type(back), str(back), vars(back), back.args) != (kind, str(error), vars(error), error.args):
                changed[name] = repr(back)
    assert changed == {}
    assert len(classes) >= 12


@pytest.mark.parametrize("start", ["spawn"])
def test_a_refusal_of_a_worker_process_reaches_who_asked(tmp_path: Path, start: str) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('format = 2\n[crank]\nradius = "5 kg"\n', "utf-8")
    with pytest.raises(crankwork.InputError) as here:
        crankwork.read(path)
    with multiprocessing.get_context(start).Pool(1) as pool:
        asked = pool.apply_async(crankwork.read, [path])
        with pytest.raises(crankwork.InputError) as there:
            asked.get(timeout=60)
    assert str(there.value) == str(here.value)
    assert there.value.problems == here.value.problems
    assert there.value.places == here.value.places
