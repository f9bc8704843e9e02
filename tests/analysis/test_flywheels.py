"""A flywheel that is found is given back, in every way in which one can be given, to every kind of machine."""

from __future__ import annotations

import pytest

from crankwork.analysis import Results, analyse
from crankwork.description.machine_file import Setting, read_machine, template
from crankwork.note.contents import note_of
from crankwork.note.options import NoteOptions
from crankwork.note.web import web
from crankwork.report.figures import figures

KINDS = ("crank-shaper", "turning-moment", "whole-engine")


def analysed(kind: str, **flywheel: object) -> Results:
    return analyse(read_machine(template(kind), "text", [Setting("--set", "flywheel", flywheel)]))


def found_inertia(results: Results) -> float:
    return results.value(
        "flywheel_inertia.exact" if "flywheel_inertia.exact" in results.summary else "flywheel_inertia"
    )


@pytest.mark.parametrize("kind", KINDS)
class TestGivenBack:
    def test_by_its_inertia(self, kind: str) -> None:
        wanted = analysed(kind, fluctuation=0.02)
        again = analysed(kind, inertia=f"{found_inertia(wanted)!r} kg*m2")
        assert again["speed_fluctuation"] == pytest.approx(0.02, rel=1e-9)

    def test_by_mass_and_radius_of_gyration(self, kind: str) -> None:
        wanted = analysed(kind, percent=1, radius_of_gyration="0.4 m")
        assert wanted["flywheel_mass"] == pytest.approx(found_inertia(wanted) / 0.16, rel=1e-12)
        again = analysed(kind, mass=f"{wanted['flywheel_mass']!r} kg", radius_of_gyration="0.4 m")
        assert again["speed_fluctuation"] == pytest.approx(0.02, rel=1e-9)
        assert "flywheel_mass" not in again.summary

    def test_by_its_rim(self, kind: str) -> None:
        rim = {"stress": "2 MPa", "density": "7200 kg/m3", "ratio": 2, "share": 0.9}
        wanted = analysed(kind, fluctuation=0.02, rim=rim)
        sizes = {key: f"{wanted[f'rim_{key}']!r} m" for key in ("diameter", "width", "thickness")}
        again = analysed(kind, rim={"density": "7200 kg/m3", "share": 0.9, **sizes})
        assert again["speed_fluctuation"] == pytest.approx(0.02, rel=1e-9)
        assert again["rim_stress"] == pytest.approx(2e6, rel=1e-12)
        assert again["rim_mass"] == pytest.approx(wanted["rim_mass"], rel=1e-12)

    def test_by_two_speeds(self, kind: str) -> None:
        one = analysed(kind, fluctuation=0.02)
        mean = one["rotational_speed"] * 9.549296585513721
        other = analysed(kind, speeds=[f"{mean * 1.01} rpm", f"{mean * 0.99} rpm"])
        assert found_inertia(other) == pytest.approx(found_inertia(one), rel=1e-9)

    def test_it_is_shown(self, kind: str) -> None:
        for wheel in ({"mass": "300 kg", "rim": {"diameter": "1 m"}}, {"percent": 2, "rim": {"diameter": "1 m"}}):
            results = analysed(kind, **wheel)
            assert {"speed", "crank_speed"} & set(figures(results))
            assert "<table" in web(note_of(results, NoteOptions(figures=False))).decode()
            assert results.explain("rim_mass")
