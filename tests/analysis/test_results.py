"""What results answer when they are asked for one value."""

from __future__ import annotations

import math

import pytest

import crankwork
from crankwork.errors import CrankworkError, MethodError, UnknownKeyError


@pytest.fixture(scope="module")
def engine():
    return crankwork.analyse(crankwork.read("examples/spark-engine.toml", ["method.kinematics=exact"]))


@pytest.fixture(scope="module")
def table():
    return crankwork.analyse(crankwork.read("examples/press.toml"))


def test_at_rows_of_the_table_and_between_them_a_value_is_that_of_the_crank_angle(engine):
    r, ratio = engine.value("crank_radius"), engine.value("rod_ratio")
    for at in (0.0, 33.337, 85.0, 390.0, 715.0):
        phi, beta = math.radians(at), math.asin(ratio * math.sin(math.radians(at)))
        place = r * (1 - math.cos(phi)) + r / ratio * (1 - math.cos(beta))
        assert engine.value("piston_displacement", at) == pytest.approx(place, rel=1e-14), at
        torque = r * engine.value("piston_force", at) * math.sin(phi + beta) / math.cos(beta)
        assert engine.value("crank_torque", at) == pytest.approx(torque, rel=1e-12, abs=1e-9), at
        if at != 33.337:
            row = engine.grid.degrees.tolist().index(at)
            assert engine["piston_displacement"][row] == engine.value("piston_displacement", at), at


def test_a_single_value_is_the_same_at_every_angle(engine):
    assert engine.value("stroke") == engine.value("stroke", 77.0) == pytest.approx(2 * engine["crank_radius"])


def test_an_unknown_key_names_the_nearest(engine):
    for ask in (engine.__getitem__, engine.value):
        with pytest.raises(UnknownKeyError, match="did you mean crank_torque, ") as refused:
            ask("crank_torqe")
        assert isinstance(refused.value, KeyError)
        with pytest.raises(UnknownKeyError, match="there is no result xyz; list them"):
            ask("xyz")


def test_a_column_is_asked_for_at_an_angle_of_the_cycle(engine):
    for at, sentence in (
        (None, "crank_torque varies with the crank angle; say where, for example at 360 deg: --at 360"),
        (720.5, "no crank angle of 720.5 deg in the cycle; take one from 0 to 720 deg"),
        (math.nan, "no crank angle of nan deg"),
    ):
        with pytest.raises(CrankworkError, match=sentence):
            engine.value("crank_torque", at)


def test_positions_of_a_table_have_nothing_between_them(table):
    assert table.value("reduced_inertia", 30.0) == table["reduced_inertia"][1]
    with pytest.raises(CrankworkError, match="stands at the angles of the table only, and 33 deg is none of them"):
        table.value("reduced_inertia", 33.0)


def test_keys_are_all_that_has_a_value(engine):
    assert {*engine.columns, *engine.summary} < set(engine.keys())
    assert all(math.isfinite(engine.value(key, 390.0)) for key in set(engine.keys()))


def test_a_method_that_a_machine_does_not_have_is_refused_however_it_is_asked_for():
    machine = crankwork.read_machine(crankwork.template("four-bar"))
    textbook = crankwork.with_method(machine, "textbook")
    for found, method in ((machine, textbook.method), (textbook, None)):
        with pytest.raises(MethodError, match="method textbook exists only for cranks with rods and pistons"):
            crankwork.analyse(found, method=method)
