"""What the package offers by name."""

from __future__ import annotations

import importlib
from pathlib import Path

import crankwork
from each import for_each


@for_each("name", crankwork.__all__)
def test_a_public_name_is_that_of_its_room(name):
    found, home = getattr(crankwork, name), crankwork._HOMES[name]
    assert found is getattr(importlib.import_module(f"crankwork.{home}"), name)
    assert name in dir(crankwork)


def test_every_name_has_one_home():
    assert sorted(crankwork.__all__) == sorted(crankwork._HOMES)


def test_what_refuses_can_be_caught_by_name():
    from crankwork import errors

    kinds = {name for name, one in vars(errors).items() if isinstance(one, type) and issubclass(one, Exception)}
    assert kinds <= set(crankwork.__all__)


def test_modules_are_named_after_subjects_not_after_kinds_of_machines():
    """Analysis, notes and figures ask for keys of results and for parts of machines, not for the kind of machine."""
    kinds = ("engine", "whole_engine", "moving_engine", "linkage", "turning", "tabulated")
    packages = ("analysis", "description", "note", "report")
    modules = [path for package in packages for path in (Path(crankwork.__file__).parent / package).rglob("*.py")]
    assert len(modules) > 100
    assert [path.name for path in modules if path.stem.startswith(kinds)] == []
