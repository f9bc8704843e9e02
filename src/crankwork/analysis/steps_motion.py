"""Worked steps of the motion of piston and rod at one crank angle, by the method of the results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

from crankwork.analysis.solved import Solved
from crankwork.analysis.state import columns
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics import rod_functions, series_terms, slider_crank, textbook
from crankwork.kinematics.crank_grid import CrankGrid, cos_multiple, sin_multiple
from crankwork.kinematics.piston import PistonMotion, piston_motion
from crankwork.kinematics.series import acceleration_harmonics
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.steps import AnyStep, Step, named_step, renamed, sum_step

Function = Callable[..., Any]


@dataclass(frozen=True)
class EngineMoment:
    """An engine at one crank angle.

    Parameters
    ----------
    solved : Solved
        Machine and method.
    grid : CrankGrid, shape (1,)
        The crank angle. [rad]
    lengths : SliderCrank
        Crank, rod and offset; other than those of the machine where a document mixes two rod ratios. [m]
    """

    solved: Solved
    grid: CrankGrid
    lengths: SliderCrank

    @classmethod
    def at(cls, solved: Solved, degrees: float) -> Self:
        """Return the engine at a crank angle.

        Parameters
        ----------
        solved : Solved
            Machine and method.
        degrees : float
            Crank angle. [deg]
        """
        return cls(solved, CrankGrid.from_degrees([degrees]), solved.lengths)

    def with_rod_ratio(self, ratio: float) -> Self:
        """Return it with another rod.

        Parameters
        ----------
        ratio : float
            Crank radius over rod length. [-]
        """
        return replace(self, lengths=self.lengths._replace(rod_length=self.lengths.crank_radius / ratio))

    @cached_property
    def known(self) -> Mapping[str, float]:
        """The columns of the results at this angle. [SI]"""
        return {key: float(column[0]) for key, column in columns(self.solved, self.grid).items()}

    @cached_property
    def motion(self) -> PistonMotion:
        """The motion of piston and rod, arrays of shape (1,)."""
        return piston_motion(self.lengths, self.grid, self.solved.method)

    @cached_property
    def functions(self) -> Mapping[str, float]:
        """What the formulas of motion take, by name of the argument. [SI]"""
        r, l, e = self.lengths  # noqa: E741
        grid, swing = self.grid, self.motion.swing
        arrays = {
            "sin_phi": grid.sin, "cos_phi": grid.cos, "sin_2phi": grid.sin_2, "cos_2phi": grid.cos_2,
            "sin_beta": swing.sin, "cos_beta": swing.cos, "sin_phi_beta": swing.sin_sum, "cos_phi_beta": swing.cos_sum,
            "x_1": self.motion.piston.position_1, "x_2": self.motion.piston.position_2,
            "beta_1": self.motion.rod.position_1, "beta_2": self.motion.rod.position_2,
        }  # fmt: skip
        single = {"r": r, "l": l, "e": e, "lam": self.lengths.rod_ratio, "w": self.solved.speed, "eps": self.eps}
        return {key: float(value) for key, value in single.items()} | {
            key: float(array[0]) for key, array in arrays.items()
        }

    @property
    def eps(self) -> float:
        """Angular acceleration of the crank. [rad/s2]"""
        return self.solved.machine.angular_acceleration


def motion_steps(moment: EngineMoment) -> Iterator[AnyStep]:
    """Yield the motion of piston and rod: angles, transfer functions, velocities, accelerations.

    Parameters
    ----------
    moment : EngineMoment
        The engine at a crank angle.
    """
    known = moment.functions
    yield from swing_steps(known)
    yield named_step(rod_functions.rod_angle_of_functions, known)
    yield from piston_steps(moment)
    yield named_step(forces.piston_velocity, known)
    yield acceleration_step(known)
    approximate = moment.solved.method.kinematics == "textbook"
    rates = (
        (textbook.textbook_rod_transfer_1, textbook.textbook_rod_transfer_2)
        if approximate
        else (slider_crank.rod_transfer_1, slider_crank.rod_transfer_2)
    )
    yield named_step(rates[0], known, key="rod_transfer_1")
    yield named_step(rates[1], known, key="rod_transfer_2")
    yield named_step(rod_functions.rod_angular_velocity, known)
    if known["eps"]:
        yield named_step(rod_functions.rod_angular_acceleration_unsteady, known)
    else:
        yield named_step(rod_functions.rod_angular_acceleration, known)


def swing_steps(known: Mapping[str, float]) -> Iterator[Step]:
    """Yield the functions of the rod angle.

    Parameters
    ----------
    known : mapping of str to float
        Values by name of the argument. [SI]
    """
    sine = slider_crank.rod_angle_sine if known["e"] else rod_functions.rod_sine_central
    yield named_step(sine, known, key="rod_sine")
    yield named_step(rod_functions.rod_cosine, known)
    yield named_step(rod_functions.crank_rod_sine, known)
    yield named_step(rod_functions.crank_rod_cosine, known)


def piston_steps(moment: EngineMoment) -> Iterator[AnyStep]:
    """Yield displacement and transfer functions of the piston by the method.

    Parameters
    ----------
    moment : EngineMoment
        The engine at a crank angle.
    """
    match moment.solved.method.kinematics:
        case "textbook":
            yield from _textbook_steps(moment)
        case "series":
            yield from _series_steps(moment)
        case _:
            known, offset = moment.functions, moment.lengths.offset
            yield named_step(
                slider_crank.piston_displacement_offset if offset else slider_crank.piston_displacement, known
            )
            yield named_step(slider_crank.piston_transfer_1, known, key="piston_transfer_1")
            yield named_step(slider_crank.piston_transfer_2, known, key="piston_transfer_2")


def acceleration_step(known: Mapping[str, float], key: str = "") -> Step:
    """Return the piston acceleration, with the part of an angular acceleration if there is one.

    Parameters
    ----------
    known : mapping of str to float
        Values by name of the argument. [SI]
    key : str
        Key of the value, by default `piston_acceleration`.
    """
    function = forces.piston_acceleration_unsteady if known["eps"] else forces.piston_acceleration
    return named_step(function, known, key=key)


_TEXTBOOK = (
    ("piston_displacement", textbook.textbook_displacement, textbook.textbook_displacement_offset),
    ("piston_transfer_1", textbook.textbook_transfer_1, textbook.textbook_transfer_1_offset),
    ("piston_transfer_2", textbook.textbook_transfer_2, textbook.textbook_transfer_2_offset),
)


def _textbook_steps(moment: EngineMoment) -> Iterator[AnyStep]:
    known = moment.functions
    for key, central, offset in _TEXTBOOK:
        if moment.lengths.offset:
            parts = (named_step(central, known, key=f"{key}.central"), named_step(offset, known, key=f"{key}.offset"))
            yield sum_step(key, parts)
        else:
            yield named_step(central, known, key=key)


def _series_steps(moment: EngineMoment) -> Iterator[AnyStep]:
    orders = [
        (order, _order_values(moment, order, a, b, moment.lengths.top_dead_centre))
        for order, (a, b) in enumerate(_coefficients(moment, moment.solved.method.order), start=1)
        if a or b
    ]
    displacement = (
        series_terms.series_displacement_term_offset if moment.lengths.offset else series_terms.series_displacement_term
    )
    for key, function in (
        ("piston_displacement", displacement),
        ("piston_transfer_1", series_terms.series_transfer_1_term),
        ("piston_transfer_2", series_terms.series_transfer_2_term),
    ):
        yield sum_step(key, [named_step(function, known, key=f"{key}.order_{order}") for order, known in orders])


def _coefficients(moment: EngineMoment, order: int) -> list[tuple[float, float]]:
    found = acceleration_harmonics(moment.lengths, order)
    return [(float(a), float(b)) for a, b in zip(*found, strict=True)]


def _order_values(moment: EngineMoment, order: int, a: float, b: float, start: float) -> dict[str, float]:
    """Return what the terms of one order take; the displacement counts from the crank angle `start`."""
    return {
        "a_k": a,
        "b_k": b,
        "k_h": float(order),
        "cos_kphi": float(cos_multiple(moment.grid, order)[0]),
        "sin_kphi": float(sin_multiple(moment.grid, order)[0]),
        "cos_kphi_0": math.cos(order * start),
        "sin_kphi_0": math.sin(order * start),
    }


def harmonic_steps(moment: EngineMoment) -> Iterator[Step]:
    """Yield first- and second-order parts of displacement, velocity and acceleration, as `state.harmonic_columns`.

    Parameters
    ----------
    moment : EngineMoment
        The engine at a crank angle.
    """
    known = moment.functions
    parts = _textbook_parts(known)
    if moment.solved.method.kinematics != "textbook" or moment.lengths.offset:
        parts = _true_parts(moment)
    for order, (displacement, first, second) in zip(("first", "second"), parts, strict=True):
        yield displacement._replace(key=f"piston_displacement_{order}_order")
        yield first._replace(key=f"piston_transfer_1_{order}_order")
        velocity = named_step(forces.piston_velocity, known, key=f"piston_velocity_{order}_order", x_1=first.value)
        names = {"x_1": f"piston_transfer_1_{order}_order", "x_2": f"piston_transfer_2_{order}_order"}
        yield _named(velocity, names)
        yield second._replace(key=f"piston_transfer_2_{order}_order")
        changed = {**known, "x_1": first.value, "x_2": second.value}
        yield _named(acceleration_step(changed, f"piston_acceleration_{order}_order"), names)


def _named(step: Step, names: Mapping[str, str]) -> Step:
    return renamed(step, **{name: key for name, key in names.items() if name in step.formula.arguments})


def _textbook_parts(known: Mapping[str, float]) -> list[tuple[Step, Step, Step]]:
    first = (
        textbook.textbook_displacement_first,
        textbook.textbook_transfer_1_first,
        textbook.textbook_transfer_2_first,
    )
    second = (
        textbook.textbook_displacement_second,
        textbook.textbook_transfer_1_second,
        textbook.textbook_transfer_2_second,
    )
    return [_three(functions, known) for functions in (first, second)]


def _true_parts(moment: EngineMoment) -> list[tuple[Step, Step, Step]]:
    functions = (
        series_terms.series_displacement_term_offset
        if moment.lengths.offset
        else series_terms.series_displacement_term,
        series_terms.series_transfer_1_term,
        series_terms.series_transfer_2_term,
    )
    orders = enumerate(_coefficients(moment, 2), start=1)
    return [_three(functions, _order_values(moment, order, a, b, 0.0)) for order, (a, b) in orders]


def _three(functions: tuple[Function, Function, Function], known: Mapping[str, float]) -> tuple[Step, Step, Step]:
    one, two, three = (named_step(function, known) for function in functions)
    return one, two, three
