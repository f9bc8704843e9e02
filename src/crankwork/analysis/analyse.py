"""The one function that analyses any machine, and the shorter one for single values at a crank angle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.cylinder_forces import traced_cylinder
from crankwork.analysis.one_cylinder import analyse_engine, own_key, with_measured
from crankwork.analysis.plausibility import implausible
from crankwork.analysis.results import Results
from crankwork.errors import CrankworkError, MethodError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.decomposition import linkage_of
from crankwork.method import EXACT, Method
from crankwork.preparation.prepared import Notice

_IN_JOINTS = ("joint_force", "normal_force")


class Described(Protocol):
    """What describes a machine, as `Description` does."""

    def machine(self) -> Machine:
        """Return the machine."""


def analyse(
    machine: Machine | Described,
    angles: CrankGrid | ArrayLike | None = None,
    *,
    method: Method | str | None = None,
    progress: Callable[[float], None] | None = None,
) -> Results:
    """Return everything a machine does over one cycle.

    Parameters
    ----------
    machine : Machine or Description
        What to compute.
    angles : array, shape (n,), or CrankGrid, optional
        Ascending crank angles for the columns, within one cycle; the machine's own table otherwise. [deg]
    method : Method or str, optional
        Instead of the machine's own: `exact`, `textbook` or `series:N`.
    progress : callable, optional
        Told, now and again, the part of the time that a machine let go has been followed. [-]

    Returns
    -------
    Results
        Columns, summary, checks and notices.

    Raises
    ------
    CrankworkError
        If the mechanism cannot be assembled or cannot turn, or the diagram does not hang together.
    MethodError
        If a method is asked for that the machine does not have.

    Examples
    --------
    >>> import crankwork as cw
    >>> engine = cw.Description(cw.template("engine"))
    >>> cw.analyse(engine, [0, 90, 180], method="textbook")["piston_displacement"].round(6).tolist()
    [0.0, 0.051328, 0.09]
    """
    if not isinstance(machine, Machine) and not hasattr(machine, "machine"):
        raise CrankworkError(ErrorMessage("object_machine", value=type(machine).__name__))
    if not isinstance(method, Method | str | None):
        raise CrankworkError(ErrorMessage("object_method", value=type(method).__name__))
    machine = _with_linkage(machine if isinstance(machine, Machine) else machine.machine())
    grid = angles if angles is None or isinstance(angles, CrankGrid) else _grid(angles, machine.cycle)
    method = machine.method.named(method) if isinstance(method, str) else method
    used = method or machine.method
    engine = _engine_of(machine, used)
    results = _analysed(engine or machine, grid, method, progress)
    results = results if engine is None else _located(results, machine)
    stated = tuple(Notice(*notice) for notice in machine.notices)
    other = partial(_in_other_form, machine, results.grid, used, is_engine=engine is not None)
    notices = (*stated, *results.notices, *implausible(results, machine.stated))
    notices = notices if engine is None else tuple(_moved(notice, machine) for notice in notices)
    return replace(results, notices=notices, in_other_form=other)


def _with_linkage(machine: Machine) -> Machine:
    """Return a machine, made of a mechanism alone, with the linkage that this is."""
    if machine.moves or machine.transfer is not None or machine.alone:
        return machine
    return replace(machine, linkage=linkage_of(machine.mechanism))


def _engine_of(machine: Machine, method: Method) -> Machine | None:
    """Return the engine that a linkage with gas is analysed as, None for other machines.

    MethodError if the method is approximate, which only engines have, and the machine is none.
    """
    if machine.lengths is not None or (method.is_exact and not machine.chambers):
        return None
    # most linkages are no engines
    from crankwork.preparation.cylinder_form import engine_form_or_reason  # noqa: PLC0415

    form = engine_form_or_reason(machine, has_all=True)
    if isinstance(form, Machine):
        return replace(form, inputs=machine.inputs)
    if method.is_exact:
        return None
    raise MethodError(ErrorMessage("method_of_engines", method=method.name, reason=form.message))


def is_engine(machine: Machine) -> bool:
    """Return whether a machine is analysed as an engine by every method."""
    return machine.lengths is not None or _engine_of(machine, EXACT) is not None


def _located(results: Results, machine: Machine) -> Results:
    """Return results of the engine that a linkage is, their inputs where the linkage states them."""
    from crankwork.preparation.cell_gas import linkage_paths, relocate  # noqa: PLC0415 - loaded where it is needed

    relocate(results.trace.values(), linkage_paths(machine))
    return results


def _moved(notice: Notice, machine: Machine) -> Notice:
    """Return a notice of the engine that a linkage is, with the path at which the linkage states what it names."""
    from crankwork.preparation.cell_gas import linkage_paths, relocated  # noqa: PLC0415 - loaded where it is needed

    if "path" not in notice.values:
        return notice
    path = relocated(str(notice.values["path"]), linkage_paths(machine))
    # a chamber with one face may state the keys of the face itself
    flat = path.replace(".faces[1]", "")
    return notice._replace(values={**notice.values, "path": flat if flat in machine.stated else path})


def _in_other_form(machine: Machine, grid: CrankGrid, method: Method, *, is_engine: bool) -> Results | None:
    """Return the results of an engine as the linkage that it is, or of a linkage as an engine; None if it is none.

    `is_engine`: whether a linkage is analysed as an engine.
    """
    if is_engine:
        return _analysed(machine, grid, None, None) if method.is_exact else None
    form = None if machine.other_form is None else machine.other_form(replace(machine, method=method))
    if form is not None or machine.linkage is None:
        return None if form is None else _analysed(form, grid, None, None)
    # few linkages are engines
    from crankwork.preparation.cylinder_form import engine_form  # noqa: PLC0415 - loaded where it is needed

    form = engine_form(machine)
    return None if form is None else _located(_analysed(form, grid, None, None), machine)


def _grid(angles: ArrayLike, cycle: float) -> CrankGrid:
    """Return crank angles within one cycle that a program asks for. [deg]"""
    try:
        degrees = np.atleast_1d(np.asarray(angles, dtype=float))
    except (TypeError, ValueError):
        degrees = np.empty(0)
    is_row = degrees.ndim == 1 and degrees.size > 0 and bool(np.all(np.isfinite(degrees)))
    if not is_row or np.any(np.diff(degrees) <= 0) or degrees[0] < -cycle or degrees[-1] > cycle:
        raise CrankworkError(ErrorMessage("angles_wrong", cycle=f"{cycle:g}"))
    return CrankGrid.from_degrees(degrees)


def _analysed(
    machine: Machine, grid: CrankGrid | None, method: Method | None, progress: Callable[[float], None] | None
) -> Results:
    results = _of_kind(machine, grid, method, progress)
    if machine.torsion is None:
        return results
    from crankwork.analysis.torsion import with_torsion  # noqa: PLC0415 - few machines vibrate

    return with_torsion(results)


def _of_kind(
    machine: Machine, grid: CrankGrid | None, method: Method | None, progress: Callable[[float], None] | None
) -> Results:
    # imported by kind of machine, since loading the other packages would take longer than the analysis
    if machine.alone:
        return _without_mechanism(machine, grid)
    if machine.transfer is not None:
        from crankwork.analysis.given_motion import analyse_tabulated  # noqa: PLC0415 - loaded where it is needed

        return analyse_tabulated(machine, machine.transfer)
    if machine.linkage is not None:
        from crankwork.analysis.mechanism import analyse_linkage  # noqa: PLC0415 - loaded where it is needed

        return analyse_linkage(machine, grid, progress)
    return with_measured(analyse_engine(machine, grid, method=method))


def _without_mechanism(machine: Machine, grid: CrankGrid | None) -> Results:
    """Return the results of what stands in the place of a mechanism; its modules are loaded where they are needed."""
    if machine.turning is not None and machine.turning.diagrams:
        from crankwork.analysis.given_torques import analyse_turning  # noqa: PLC0415

        return analyse_turning(machine, machine.turning, grid)
    if machine.turning is not None:
        from crankwork.analysis.torsion import shaft_alone  # noqa: PLC0415

        return shaft_alone(machine, grid)
    if machine.stages is not None:
        from crankwork.analysis.stages import analyse_stages  # noqa: PLC0415

        return analyse_stages(machine, machine.stages, grid)
    if machine.rotor is not None:
        from crankwork.analysis.rotor_balance import analyse_rotor  # noqa: PLC0415

        return analyse_rotor(machine, machine.rotor, grid)
    from crankwork.analysis.test_bed import analyse_test  # noqa: PLC0415

    return analyse_test(machine)


def columns_only(machine: Machine) -> Results:
    """Return results that give values at a crank angle, and none that needs a calculation over a whole cycle.

    Faster than `analyse`.
    """
    is_burning = machine.gas is not None and machine.gas.combustion is not None
    if is_burning or not machine.moves:
        return analyse(machine)
    engine = None if machine.method.is_exact else _engine_of(machine, machine.method)
    if engine is not None:
        return _located(columns_only(engine), machine)
    if machine.linkage is not None:
        from crankwork.analysis.mechanism import linkage_columns  # noqa: PLC0415 - loaded where it is needed

        return linkage_columns(machine)
    solved = traced_cylinder(machine, machine.method)
    grid = CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    # in the joints of an engine there are the forces of other cylinders too
    of_all = _IN_JOINTS if machine.engine is not None else ()
    trace = {own_key(machine, key): known for key, known in solved.trace.items() if not key.startswith(of_all)}
    return Results(solved, grid, {}, {}, {}, (), {}, trace=trace)


def value_only(machine: Machine, key: str) -> Results:
    """Return results that give a single value, and maybe no others; they take a part of the time of `analyse`."""
    if machine.linkage is None or not machine.method.is_exact:
        return analyse(machine)
    from crankwork.analysis.mechanism import linkage_value  # noqa: PLC0415 - loaded where it is needed

    return linkage_value(machine, key)


def with_method(machine: Machine, name: str) -> Machine:
    """Return the machine with another method by name, constants kept.

    Parameters
    ----------
    machine : Machine
        Any machine.
    name : str
        `exact`, `textbook` or `series:N`.

    Returns
    -------
    Machine
        The same machine, computed that way.
    """
    return replace(machine, method=machine.method.named(name))
