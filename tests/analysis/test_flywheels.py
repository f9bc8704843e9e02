"""A flywheel that is found is given back, in every way in which one can be given, to every kind of machine."""

from __future__ import annotations

import pytest

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import Setting, read_machine, template
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.web import web
from crankwork.report.figures import figures

KINDS = ("crank-shaper", "turning-moment", "whole-engine")


def analysed(kind: str, **flywheel: object) -> Results:
    return analyse(read_machine(template(kind), "text", [Setting("--set", "flywheel", flywheel)]))


def found_inertia(results: Results) -> float:
    return results.summary.get("flywheel_inertia.exact") or results["flywheel_inertia"]


@pytest.mark.slow
def test_a_flywheel_is_given_back() -> None:
    """By its inertia, by mass and radius of gyration, by its rim, and by two speeds."""
    rim = {"stress": "2 MPa", "density": "7200 kg/m3", "ratio": 2, "share": 0.9}
    found: dict[str, dict[str, float]] = {}
    for kind in KINDS:
        wanted = analysed(kind, fluctuation=0.02, rim=rim)
        inertia = found_inertia(wanted)
        by_mass = analysed(kind, percent=1, radius_of_gyration="0.4 m")
        mass = analysed(kind, mass=f"{by_mass['flywheel_mass']!r} kg", radius_of_gyration="0.4 m")
        assert "flywheel_mass" not in mass.summary
        sizes = {key: f"{wanted[f'rim_{key}']!r} m" for key in ("diameter", "width", "thickness")}
        again = analysed(kind, rim={"density": "7200 kg/m3", "share": 0.9, **sizes})
        mean = wanted["rotational_speed"] * 9.549296585513721
        speeds = analysed(kind, speeds=[f"{mean * 1.01} rpm", f"{mean * 0.99} rpm"])
        found[kind] = {
            "inertia": analysed(kind, inertia=f"{inertia!r} kg*m2")["speed_fluctuation"] / 0.02,
            "mass of a radius": by_mass["flywheel_mass"] * 0.16 / found_inertia(by_mass),
            "mass": mass["speed_fluctuation"] / 0.02,
            "rim": again["speed_fluctuation"] / 0.02,
            "stress of the rim": again["rim_stress"] / 2e6,
            "mass of the rim": again["rim_mass"] / wanted["rim_mass"],
            "speeds": found_inertia(speeds) / inertia,
        }
    assert found == {kind: pytest.approx(dict.fromkeys(found[kind], 1.0), rel=1e-9) for kind in KINDS}


@pytest.mark.slow
def test_it_is_shown() -> None:
    wheels = {"mass": "300 kg", "rim": {"diameter": "1 m"}}, {"percent": 2, "rim": {"diameter": "1 m"}}
    for kind, wheel in zip(KINDS, (*wheels, wheels[0]), strict=True):
        results = analysed(kind, **wheel)
        assert {"speed", "crank_speed"} & set(figures(results)), kind
        page = web(note_of(results, NoteOptions(full=True, figures=False))).decode()
        assert "<table" in page, kind
        assert results.explain("rim_mass"), kind
