"""The door for programs: descriptions and results as Python, notebooks and other programs take them."""

from __future__ import annotations

import ast
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crankwork
from crankwork.loads.load import Spring, force_at
from linkages import LINKAGES

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="module")
def engine() -> crankwork.Results:
    return crankwork.analyse(crankwork.load(EXAMPLES / "petrol-four.toml"))


@pytest.fixture(scope="module")
def linkage() -> crankwork.Results:
    return crankwork.analyse(crankwork.load(EXAMPLES / "knuckle-press.toml"))


@pytest.mark.data
@pytest.mark.parametrize("name", sorted(one.name for one in EXAMPLES.glob("*.ipynb")))
def test_notebooks_run_from_top_to_bottom(name: str, tmp_path: Path) -> None:
    for one in EXAMPLES.glob("*.toml"):
        shutil.copy(one, tmp_path)
    book = json.loads((EXAMPLES / name).read_text("utf-8"))
    assert all(not cell.get("outputs") for cell in book["cells"])
    names: dict[str, Any] = {}
    for cell in book["cells"]:
        if cell["cell_type"] == "code":
            tree = ast.parse("".join(cell["source"]))
            last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
            exec(compile(tree, name, "exec"), names)  # noqa: S102 - a notebook of ours
            if last is not None:
                shown = eval(compile(ast.Expression(last.value), name, "eval"), names)  # noqa: S307
                for way in ("_repr_html_", "_repr_svg_", "__repr__"):
                    assert not hasattr(shown, way) or getattr(shown, way)()


@pytest.mark.slow
def test_results_are_shown_in_fifteen_lines(engine: crankwork.Results, linkage: crankwork.Results) -> None:
    for one in (engine, linkage):
        assert len(repr(one).splitlines()) <= 15
        assert len(repr(one)) < 2000
        page = one._repr_html_()
        assert (len(page) < 100_000, "<img" in page) == (True, True)


@pytest.mark.filterwarnings("ignore::crankwork.errors.RenamedKeyWarning")
def test_results_are_a_mapping_of_what_they_know(engine: crankwork.Results) -> None:
    assert set(engine.columns) | set(engine.summary) <= set(engine) == set(engine.keys())
    assert len(engine) == len(set(engine))
    assert "crank_torque.1" in engine._ipython_key_completions_()
    assert engine.get("crank_tork") is None
    with pytest.raises(KeyError, match=r"crank_torque\.1"):
        engine["crank_torqe.1"]
    for key in engine:
        value = engine[key]
        assert np.ndim(value) == 0 or np.shape(value) == (len(engine.grid),), key
        assert engine.unit(key) is not None
    assert hash(engine)


@pytest.mark.data
def test_exports_have_dimensions_of_the_field_and_units_that_are_true(linkage: crankwork.Results) -> None:
    engine = crankwork.analyse(crankwork.load(EXAMPLES / "v8-diesel.toml"))
    plain, shown, other = engine.to_xarray(), engine.to_xarray(shown=True), linkage.to_xarray()
    assert {"crank_angle", "cylinder", "crankpin", "journal", "order", "ray"} <= set(plain.dims)
    assert {"point", "link", "joint", "slider"} <= set(other.dims)
    assert np.array_equal(plain["crank_torque"].sel(cylinder=3), engine["crank_torque.3"])
    assert np.array_equal(other["joint_force"].sel(joint="B_upper"), linkage["joint_force.B_upper"])
    assert float(plain["mean_crankpin_load"].sel(crankpin=4)) == engine["mean_crankpin_load.4"]
    for one in (plain, other):
        assert all(variable.attrs.get("units") is not None for variable in one.data_vars.values())
    assert (plain["gas_pressure"].attrs["units"], shown["gas_pressure"].attrs["units"]) == ("Pa", "MPa")
    assert np.allclose(plain["gas_pressure"], 1e6 * shown["gas_pressure"], rtol=1e-15)
    frame, table = engine.to_dataframe(), engine.to_dataframe(shown=True)
    assert np.allclose(frame["piston_displacement"], 1e-3 * table["piston_displacement [mm]"], rtol=1e-12)
    assert frame.attrs["units"]["gas_pressure"] == "Pa"


@pytest.mark.data
def test_results_of_every_kind_of_machine_are_written_as_data(
    engine: crankwork.Results, linkage: crankwork.Results
) -> None:
    import pandas as pd
    import xarray as xr
    from scipy.io import loadmat

    names = ("slider-crank", "excavator-boom", "punching-machine")
    others = {name: crankwork.analyse(crankwork.load(EXAMPLES / f"{name}.toml")) for name in names}
    for name, results in {"petrol-four": engine, "knuckle-press": linkage, **others}.items():
        key = next(key for key in results.columns if "." not in key and key not in ("crank_angle", "time"))
        for ending in ("nc", "parquet", "mat"):
            results.write(f"{name}.{ending}")
        matlab = loadmat(f"{name}.mat", simplify_cells=True)
        assert matlab["units"][key] == results.unit(key), name
        with xr.open_dataset(f"{name}.nc") as data:
            for found in (data[key], pd.read_parquet(f"{name}.parquet")[key], matlab[key]):
                assert np.array_equal(found, results[key], equal_nan=True), name
            assert data[key].attrs["units"] == results.unit(key)
            assert data.attrs["source"].startswith("crankwork ")
            assert len(data.attrs["machine_file_sha256"]) == 64
    with pytest.raises(crankwork.CrankworkError, match=r"is there already|exists"):
        engine.write("petrol-four.nc")
    with pytest.raises(crankwork.CrankworkError, match=r"\.nc, \.parquet, \.mat"):
        engine.write("my.csv")


def test_a_figure_displays_and_is_saved(engine: crankwork.Results) -> None:
    picture = engine.figure("indicator", "ru")
    assert picture._repr_svg_().lstrip().startswith(("<?xml", "<svg"))
    picture.save("indicator.svg")
    assert Path("indicator.svg").read_text("utf-8") == picture.svg
    with pytest.raises(KeyError, match="indicator"):
        engine.figure("indicater")


def test_a_machine_of_plain_values_is_checked_as_a_file() -> None:
    values = {"title": "Pump", "crank": {"radius": "45 mm", "speed": "300 rpm"}, "rod": {"length": "180 mm"}}
    text = 'title = "Pump"\n[crank]\nradius = "45 mm"\nspeed = "300 rpm"\n[rod]\nlength = "180 mm"\n'
    made, read = crankwork.analyse(crankwork.Description(values)), crankwork.analyse(crankwork.Description(text))
    assert np.array_equal(made["piston_velocity"], read["piston_velocity"])
    values["rod"] = {"length": "20 mm"}
    with pytest.raises(crankwork.InputError, match="rod"):
        crankwork.analyse(crankwork.Description(values))


@pytest.mark.elsewhere
def test_a_mechanism_of_the_catalogue_is_a_machine() -> None:
    """The rocker by Freudenstein's equation (1955), the yoke with an inclined slot by the law of sines."""
    crank, coupler, rocker, ground = 0.05, 0.2, 0.12, 0.18
    results = crankwork.analyse(crankwork.Machine(crankwork.four_bar(crank, coupler, rocker, ground), 10.0))
    phi, psi = results["crank_angle"], results["link_angle.rocker"]
    third = (crank**2 - coupler**2 + rocker**2 + ground**2) / (2 * crank * rocker)
    freudenstein = ground / crank * np.cos(psi) - ground / rocker * np.cos(phi) + third
    assert np.allclose(freudenstein, np.cos(phi - psi), rtol=0, atol=1e-12)
    yoke = crankwork.analyse(crankwork.Machine(crankwork.scotch_yoke(crank, 1.1), 10.0))
    moved, speed = (trigonometry(phi) / np.sin(1.1) * crank for trigonometry in
                    (lambda angle: np.sin(1.1 - angle), lambda angle: -10.0 * np.cos(1.1 - angle)))  # fmt: skip
    assert np.allclose(yoke["slider_displacement.yoke"], moved, rtol=0, atol=1e-15)
    assert np.allclose(yoke["slider_velocity.yoke"], speed, rtol=0, atol=1e-13)


def test_a_mechanism_that_no_dyads_make_is_refused_with_the_way_that_works() -> None:
    with pytest.raises(crankwork.CrankworkError, match="from its machine file only"):
        crankwork.analyse(crankwork.Machine(LINKAGES["class III"], 10.0))


def test_objects_are_refused_as_files_are() -> None:
    for text in (crankwork.template("engine"), (EXAMPLES / "knuckle-press.toml").read_text("utf-8")):
        machine = crankwork.read_machine(text)
        for key, wrong in {
            "speed": (-100.0, 0.0, float("nan"), float("inf"), "100 rpm"),
            "angular_acceleration": (float("nan"),),
            "table_step": (0.0, -5.0),
            "loads": ((3,),),
        }.items():
            for value in wrong:
                with pytest.raises(crankwork.CrankworkError, match=key.replace("loads", "load")):
                    replace(machine, **{key: value})


def test_lengths_languages_and_areas_that_there_are_not_are_refused(linkage: crankwork.Results) -> None:
    for lengths in ((-0.1, 0.3, 0.25, 0.2), (0.1, -0.3, 0.25, 0.3), (0.1, 0.3, float("nan"), 0.3)):
        with pytest.raises(crankwork.CrankworkError, match="is a number greater than zero"):
            crankwork.Machine(crankwork.four_bar(*lengths), speed=10.0)
    assert crankwork.Machine(crankwork.four_bar(*np.float32([0.1, 0.3, 0.25, 0.3])), speed=np.int64(10)).speed == 10
    with pytest.raises(crankwork.CrankworkError, match="piston_area"):
        crankwork.summary_text(linkage, per_area=True)
    with pytest.raises(ValueError, match="language: de is not possible; write en, ru or vi"):
        crankwork.summary_text(linkage, language="de")  # type: ignore[arg-type]


def test_angles_and_methods_are_plain_and_what_is_none_is_told() -> None:
    engine = crankwork.Description(crankwork.template("engine"))
    found = crankwork.analyse(engine, [0, 33, 720], method="series:4")
    assert found.method.name == "series:4"
    assert found.grid.degrees.tolist() == [0, 33, 720]
    for angles in ([0, 90, float("nan")], [90, 0], [0, 90, 900], "x", [], [[0, 90]]):
        with pytest.raises(crankwork.CrankworkError, match="720 deg"):
            crankwork.analyse(engine, angles)
    for wrong in ("my.toml", None, 3):
        with pytest.raises(crankwork.CrankworkError, match=r"is no machine; read one first: crankwork\.analyse"):
            crankwork.analyse(wrong)
    with pytest.raises(crankwork.CrankworkError, match='int is no method; write method="exact"'):
        crankwork.analyse(engine, method=3)
    with pytest.raises(crankwork.CrankworkError, match="de: no language of this program; take one of en, ru, vi"):
        crankwork.template("engine", "de")


class Tether:
    """Pulls point B towards a place."""

    def __init__(self, x: float, y: float, stiffness: float) -> None:
        self.x, self.y, self.stiffness = x, y, stiffness

    def forces(self, mechanism: Any, motion: Any, speed: Any) -> Any:  # noqa: ARG002 - asked of every load
        at = motion.points["B"]
        pull = [(at.x.position - self.x) * -self.stiffness, (at.y.position - self.y) * -self.stiffness]
        return force_at(mechanism, motion, "B", (pull[0], pull[1]))


def test_a_load_of_ones_own_is_a_load() -> None:
    """As a spring without a free length, which is one of ours."""
    machine = crankwork.read_machine(crankwork.template("four-bar"))
    ground = next(iter(machine.mechanism.ground))
    x, y = machine.mechanism.ground[ground]
    own = crankwork.analyse(replace(machine, loads=(Tether(x, y, 250.0),)))
    ours = crankwork.analyse(replace(machine, loads=(Spring(ground, "B", 250.0, 0.0),)))
    assert own["static_torque"] == pytest.approx(ours["static_torque"], abs=1e-12 * np.abs(ours["static_torque"]).max())
    assert max(own.checks.values()) < 1e-12
    assert crankwork.note_of(own).blocks


SCRIPT = """
import numpy as np
import crankwork as cw


class Pull:
    def forces(self, mechanism: cw.Mechanism, motion: cw.Motion, speed: object) -> cw.AppliedLoads:
        return cw.force_at(mechanism, motion, "B", (-10.0, 0.0))


def largest(path: str) -> float:
    description = cw.load(path)
    description["crank.speed"] = "1200 rpm"
    results = cw.analyse(description, np.arange(0, 720, 2), method="textbook")
    column = results.column("crank_torque")
    dataset = results.to_xarray()
    assert dataset.attrs["method"] == "textbook"
    text: str = results.explain("crank_torque", at=390.0)
    picture = results.figure("indicator")
    picture.save("indicator.svg")
    for key, value in results.items():
        print(key, np.asarray(value).shape, results.unit(key), text[:10])
    try:
        results["no such key"]
    except cw.UnknownKeyError as error:
        print(error)
    return float(np.max(column)) + results.value("mean_torque")
"""


@pytest.mark.slow
def test_a_users_script_passes_strict_mypy(tmp_path: Path, pytestconfig: pytest.Config) -> None:
    script, kept = tmp_path / "script.py", pytestconfig.cache.mkdir("mypy")
    script.write_text(SCRIPT, encoding="utf-8")
    options = ["--strict", "--config-file", os.devnull, "--cache-dir", str(kept)]
    words = [sys.executable, "-m", "mypy", *options, str(script)]
    paths = os.environ | {"MYPYPATH": str(ROOT / "src")}
    done = subprocess.run(words, capture_output=True, text=True, env=paths, timeout=300, check=False)
    assert done.returncode == 0, done.stdout
    assert re.search("no issues found", done.stdout)


def test_a_description_tells_its_keys_as_a_mapping_does():
    d = crankwork.Description(
        '[crank]\nradius = "50 mm"\n[gas]\npieces = [{ law = "constant", points = ["a", "b"] }]\n'
    )
    assert list(d) == ["crank.radius", "gas.pieces[1].law", "gas.pieces[1].points"] == list(d.keys())
    assert [d[key] for key in d] == ["50 mm", "constant", ["a", "b"]]
    assert d.get("crank.radius") == "50 mm"
    assert (d.get("crank.offset"), d.get("crank.offset", "nothing")) == (None, "nothing")
    assert all(key in d for key in d)


@pytest.mark.parametrize("value", [None, object(), 3 + 4j, b"5 mm", {1}, float("nan"), [None]])
def test_a_value_that_no_file_holds_is_refused_with_what_to_write(value):
    description = crankwork.Description(crankwork.template("engine"))
    before = str(description)
    with pytest.raises(crankwork.CrankworkError, match=r'crank\.radius: must be a text with a unit.*"45 mm"'):
        description["crank.radius"] = value
    assert str(description) == before


def test_tuples_and_numbers_of_numpy_are_values_of_a_file():
    description = crankwork.Description('gas.pieces = [{ law = "constant", points = ["a", "b"] }]\nrod.ratio = 0.25')
    description["gas.pieces[1].points"] = ("b", "c")
    description["rod.ratio"] = np.float32(0.5)
    description["engine.cylinders"] = np.int64(4)
    changed = [description[key] for key in ("gas.pieces[1].points", "rod.ratio", "engine.cylinders")]
    assert changed == [["b", "c"], 0.5, 4]


@pytest.mark.parametrize("angle", [np.inf, np.nan])
def test_columns_are_asked_for_at_finite_angles(engine, angle):
    with pytest.raises(crankwork.CrankworkError, match="crank angles must be finite numbers"):
        engine.columns_at([10.0, angle])
