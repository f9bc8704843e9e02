"""Engines whose rods hang on a master rod, against the linkage that a throw of them is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.cylinder_balance import engine_balance
from crankwork.analysis.cylinder_forces import traced_cylinder
from crankwork.analysis.cylinders import multi_cylinder_engine
from crankwork.cylinders.articulated import throw_mechanism
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.mechanism import Body, body_at

ROOT = Path(__file__).parents[2]
RADIAL = crankwork.read(ROOT / "examples/radial-five.toml")
# rods of two masses, so that each body stands where its masses are
OWN = CrankGearMasses(rod_small_end=0.4, rod_big_end=0.7)


@pytest.mark.elsewhere
def test_free_forces_are_what_the_throw_as_a_linkage_puts_on_the_frame():
    """Bodies of the throw move alone; the fixed pivot and the walls must take what accelerates them."""
    machine = replace(RADIAL, gas=None, engine=replace(RADIAL.engine, articulated_masses=OWN, rotating_share=0.0,
                                                       reciprocating_share=0.0))  # fmt: skip
    whole = multi_cylinder_engine(traced_cylinder(machine, machine.method))
    mechanism = throw_mechanism(whole.layout, whole.master.lengths, whole.engine.articulated_rods)
    bodies = [body_at("crank", machine.masses.crank, 0.0, "A")]
    for number, rod in enumerate(mechanism.dyads, start=1):
        one = machine.masses if number == 1 else OWN
        mass, share = one.rod_small_end + one.rod_big_end, one.rod_small_end / (one.rod_small_end + one.rod_big_end)
        bodies += [body_at(rod.slider, machine.masses.piston, 0.0, rod.slider)]
        bodies += [Body(rod.link, mass, mass * share * (1 - share) * rod.length**2, rod.joint, rod.slider, share)]
    grid = CrankGrid.from_degrees(np.arange(720) / 2)
    moving = replace(mechanism, bodies=tuple(bodies))
    motion = linkage_motion(moving, grid)
    found = system_joint_forces(OperatingState(moving, motion, whole.master.speed))
    x, y = -found.pins["crank_pivot"].x, -found.pins["crank_pivot"].y
    for name, guide in found.guides.items():
        x, y = x + motion.frames[name].sin * guide.normal, y - motion.frames[name].cos * guide.normal
    # the reference direction of the engine stands upright and the crank turns clockwise
    spectrum = np.fft.fft(y + 1j * x) / 720
    for one in engine_balance(whole).residual:
        assert one.force.forward == pytest.approx(spectrum[one.order], abs=1e-12 * np.abs(spectrum).max())
        assert one.force.backward == pytest.approx(spectrum[-one.order], abs=1e-12 * np.abs(spectrum).max())


def test_orders_are_those_of_the_inertia_forces_where_a_document_has_its_own_rod_ratio():
    method = replace(RADIAL.method, kinematics="textbook", inertia_rod_ratio=0.34)
    results = crankwork.analyse(replace(RADIAL, method=method))
    assert results.checks["free_forces"] < 1e-13


def test_a_valve_may_close_at_dead_centre_but_for_rounding():
    text = (ROOT / "examples/radial-five.toml").read_text("utf-8")
    shut = crankwork.read_machine(text.replace('intake_closes = "50 deg"', 'intake_closes = "0.000001 deg"'))
    assert not crankwork.analyse(shut).unmet
