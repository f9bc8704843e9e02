"""The page with sliders: what the browser calculates is what an analysis gives, and what is seen follows."""

from __future__ import annotations

import difflib
import math
import re

import numpy as np
import pytest

import crankwork
from crankwork.locale.numbers import number
from crankwork.page.document import page as written
from crankwork.report.display import displayed
from crankwork.study.sliders import moved
from crankwork.units import to_si
from page.slid import EXAMPLES, described, design, document, live, move, results, rules_broken, shown

# settings that are compared with analyses, which take their time
SETTINGS = {"engine": 24, "four-bar": 24, "V8": 5, "six-bar": 12, "spark-engine": 12}
# what polynomials may leave out where extremes are to be exact
FOLLOWED = 2e-13
CALCULATED = """async (designs) => {
  const { sliders } = JSON.parse(await unfolded(document.getElementById("data").textContent));
  const live = new Live(sliders, steps, {});
  return designs.map((design) => {
    const { calculation } = live;
    calculation.run(design);
    const columns = Object.keys(sliders.columns).map((key) => [key, live.rows(key)]);
    const values = Object.keys(sliders.values).map((key) => [key, calculation.values[sliders.calculation.values[key]]]);
    const found = { columns: Object.fromEntries(columns), values: Object.fromEntries(values) };
    return { ...found, leftOut: calculation.leftOut };
  });
}"""


def sizes(columns, summary):
    """Return what each value is judged beside: the largest of its quantity, of an angle a turn."""
    largest = {key: float(np.max(np.abs(column))) for key, column in columns.items()}
    largest |= {key: abs(value) for key, value in summary.items()}
    found = {}
    for key in [*columns, *summary]:
        word = key.partition(".")[0].removesuffix("_max").removesuffix("_min").rpartition("_")[2]
        same = [value for other, value in largest.items() if word in other.partition(".")[0] and "_angle" not in other]
        found[key] = 2 * math.pi if "_angle" in key and key in summary else max([*same, largest[key]])
    return found


@pytest.mark.parametrize("name", SETTINGS)
def test_the_browser_calculates_what_analyses_give(slid, name):
    page, sliders = slid(name), live(name).sliders
    draw = np.random.default_rng(5)
    low, high = (np.array([getattr(one, end) for one in sliders]) for end in ("low", "high"))
    designs = low + (high - low) * draw.uniform(0, 1, (SETTINGS[name], len(sliders)))
    # in the units that the file takes, so that both work with the same numbers
    designs = [[one.shown(at) for one, at in zip(sliders, row, strict=True)] for row in designs.tolist()]
    compared = 0
    stated = [
        [float(to_si(at, one.unit)) if one.unit else at for at, one in zip(row, sliders, strict=True)]
        for row in designs
    ]
    for row, found in zip(designs, page.evaluate(CALCULATED, stated), strict=True):
        try:
            expected = results(name, row)
            if "crank_range" in expected.summary:
                raise crankwork.GeometryError("no full turn")
        except crankwork.CrankworkError:
            # lengths that no machine has together
            assert found["leftOut"] > 1e-6 or not all(map(math.isfinite, found["values"].values()))
            continue
        if found["leftOut"] > FOLLOWED:
            # a machine that hardly moves any more
            continue
        size = sizes(expected.columns_at(expected.grid, list(found["columns"])), expected.summary)
        for key, value in found["values"].items():
            limit = 1e-7 if "_angle" in key or key.startswith("time_ratio") else 1e-12
            apart = abs(value - expected.summary[key]) / (size[key] or 1.0)
            assert apart <= limit, (key, row, value, expected.summary[key])
        columns = expected.columns_at(expected.grid, list(found["columns"]))
        for key, column in found["columns"].items():
            apart = np.max(np.abs(np.array(column) - columns[key])) / max(size[key], 1e-9)
            assert apart <= 1e-12, (key, row)
        compared += 1
    assert compared > 0.7 * len(stated)
    assert len(found["columns"]) >= 5


def printed(page, key):
    return page.locator(f'#values [data-value="{key}"]').inner_text()


@pytest.mark.parametrize("name", ["engine", "four-bar"])
def test_values_tables_and_explanations_follow_and_go_back(slid, name):
    page, one = slid(name), live(name)
    speed = [slider.key for slider in one.sliders].index("crank.speed")
    shown(page, "values")
    state = "[document.querySelector('main').innerHTML, document.documentElement.className]"
    drawn = "dispatchEvent(new Event('beforeprint'))"
    page.evaluate(drawn)
    before = page.evaluate(state)
    value = round(one.sliders[speed].shown(0.7 * one.sliders[speed].low + 0.3 * one.sliders[speed].high))
    move(page, speed, value)
    expected = results(name, design(name, crank_speed=value))
    keys = page.locator("#values [data-value]").evaluate_all("all => all.map((one) => one.dataset.value)")
    assert len(keys) > 10
    changed = 0
    for key in keys:
        wanted, stated = (displayed(key, found.summary[key]) for found in (expected, one.results[0]))
        text = printed(page, key)
        if "_angle" not in key:
            near = float(
                text.replace("−", "-").replace("·10", "e").translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-"))
            )
            assert near == pytest.approx(wanted, rel=2e-5, abs=1e-9), key
            changed += abs(wanted - stated) > 1e-3 * abs(stated)
    assert changed >= 3
    key = next(key for key in keys if key.endswith("_max") and not key.startswith("gas"))
    shown(page, "values").locator(f'[data-value="{key}"]').click()
    assert printed(page, key) in page.locator("#explanation .equation").first.inner_text()
    page.keyboard.press("Escape")
    page.locator("#tables").scroll_into_view_if_needed()
    page.wait_for_function("(at) => document.documentElement.classList.contains('moved')", arg=0)
    page.locator("#filed").click()
    # what is not seen waits until it is, or is printed
    # a busy machine goes back a little later
    for _ in range(40):
        page.evaluate(drawn)
        after = page.evaluate(state)
        plain = [re.sub(r'<g class="cursor">.*?</g>|<output.*?</output>', "", one[0]) for one in (before, after)]
        if plain[0] == plain[1]:
            break
        page.wait_for_timeout(100)
    assert before[1] == after[1]
    assert [*difflib.unified_diff(*(re.split("(?=<)", one) for one in plain), n=0)] == []


def test_the_mean_of_what_is_nothing_but_for_rounding_is_nothing(slid):
    mean = """(order) => {
      const cycle = new Cycle([0, 90, 200, 360], live.nodes, live.weights);
      const column = Float64Array.from(cycle.degrees, (one) => 1e3 * Math.sin((one * Math.PI) / 180) ** order);
      return cycle.reduced(["mean"], [column]);
    }""".replace("live.", "data.calculation.")
    read = "const data = JSON.parse(await unfolded(document.getElementById('data').textContent)).sliders;"
    page = slid("four-bar")
    means = [page.evaluate(f"async () => {{ {read} return ({mean})({order}); }}") for order in (1, 2)]
    assert means == [0, pytest.approx(500, abs=1e-9)]


def test_a_row_at_a_jump_follows_the_law_that_an_analysis_takes_there(slid):
    expected = results("steam", [1.1])
    (found,) = slid("steam").evaluate(CALCULATED, [[1.1]])
    assert {"joint_force.O", "driving_torque"} <= found["columns"].keys()
    for key, column in found["columns"].items():
        wanted = expected[key]
        assert column == pytest.approx(wanted.tolist(), rel=1e-9, abs=1e-9 * np.max(np.abs(wanted))), key


def test_sliders_are_moved_by_keys_and_boxes_take_numbers(slid):
    page = slid("four-bar", "ru")
    slider, box, tell = page.locator('[data-field="1"]'), page.locator('[data-box="1"]'), page.locator("#told")
    home = box.input_value()
    slider.press("ArrowRight")
    assert box.input_value() != home
    assert slider.get_attribute("aria-valuetext").startswith(box.input_value())
    box.fill("77,5")
    box.press("Enter")
    assert (box.input_value(), float(slider.input_value())) == ("77,5", 77.5)
    for wrong in ("100000", "-3", "fast", ""):
        box.fill(wrong)
        box.press("Tab")
        assert box.input_value() == wrong
        assert box.get_attribute("aria-invalid") == "true"
        # it is told at the field
        assert "Напишите число от" in box.locator("xpath=..").inner_text()
    page.locator("#filed").click()
    assert (box.input_value(), tell.inner_text()) == (home, "")


def test_lengths_without_a_machine_keep_the_last_one(slid):
    page = slid("four-bar")
    ends = [live("four-bar").sliders[at] for at in (0, 2)]
    move(page, 2, ends[1].shown(ends[1].high))
    before = page.locator("[data-value]").all_inner_texts()
    move(page, 0, ends[0].shown(ends[0].high))
    assert page.locator("#told").inner_text()
    assert page.locator("[data-value]").all_inner_texts() == before
    # nor is what was not seen yet drawn of lengths that no machine has
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.locator("path[d*=NaN]").count() == 0
    shown(page, "values").locator('[data-value="joint_force_max.A"]').click()
    assert printed(page, "joint_force_max.A") in page.locator("#explanation .equation").first.inner_text()
    move(page, 2, ends[1].shown(ends[1].now))
    assert page.locator("#told").inner_text() == ""


@pytest.mark.parametrize(
    ("name", "value", "live_column"),
    [
        ("press", 14.8, "driving_torque"),
        ("parallelogram", 130, "shaking_force"),
        ("parallelogram's mass", 240, "shaking_force"),
    ],
)
def test_what_polynomials_do_not_follow_is_pale_and_all_else_follows(slid, name, value, live_column):
    page, expected = slid(name), results(name, [value])
    move(page, 0, value)
    assert page.locator("#told").inner_text() == ""
    keys = page.locator("#values [data-value]").evaluate_all("all => all.map((one) => one.dataset.value)")
    assert {key: printed(page, key) for key in keys} == {
        key: number(displayed(key, expected.summary[key]), "en") for key in keys
    }
    pale = set(page.locator("tr.filed [data-key]").evaluate_all("all => all.map((one) => one.dataset.key)"))
    assert {"dynamic_torque_max", "dynamic_torque_min"} <= pale
    for key in expected.summary.keys() - pale - set(keys):
        assert expected.summary[key] == pytest.approx(live(name).results[0].summary[key], rel=1e-9, abs=1e-12), key
    (found,) = page.evaluate(CALCULATED, [[float(to_si(value, live(name).sliders[0].unit))]])
    column = expected[live_column]
    assert found["columns"][live_column] == pytest.approx(column.tolist(), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "crank", "ratio", "ends"),
    [("four-bar", 80, 175 / 80, ("A", "B")), ("six-bar", 80, None, ("A", "B"))],
)
def test_the_machine_moves_with_its_lengths_and_back(slid, name, crank, ratio, ends):
    page = slid(name)
    page.keyboard.press("Home")
    before = page.locator("#machine svg").evaluate("one => [one.innerHTML, one.getAttribute('viewBox')]")
    move(page, 0, crank)
    lengths = []
    for _ in range(3):
        places = {
            name: page.locator(f'[data-part="joint.{name}"]').evaluate(
                "one => { const m = one.transform.baseVal.consolidate().matrix; return [m.e, m.f] }"
            )
            for name in ("O", *ends)
        }
        lengths.append((math.dist(places["O"], places["A"]), math.dist(places["A"], places["B"])))
        page.keyboard.press("ArrowRight")
    stated = results(name, design(name, crank_radius=crank))
    points = [np.array([stated[f"point_{axis}.{end}"][0] for axis in "xy"]) for end in ends]
    wanted = float(np.hypot(*(points[1] - points[0]))) / (crank / 1000)
    assert ratio is None or wanted == pytest.approx(ratio, rel=1e-9)
    for radius, coupler in lengths:
        assert coupler / radius == pytest.approx(wanted, rel=2e-3)
    corners = page.locator('[data-part="link.crank.1"] path').get_attribute("d")
    assert corners.startswith("M")
    page.keyboard.press("Home")
    page.locator("#filed").click()
    after = page.locator("#machine svg").evaluate("one => [one.innerHTML, one.getAttribute('viewBox')]")
    parts = [re.split("(?=<)", one[0]) + one[1:] for one in (before, after)]
    assert [one for one in zip(*parts, strict=True) if one[0] != one[1]] == []


def test_everybody_can_use_the_sliders(slid):
    found = {}
    for language, width, scheme in (("en", 1280, "light"), ("ru", 360, "dark")):
        page = slid("engine", language, color_scheme=scheme, viewport={"width": width, "height": 800})
        move(page, 2, 3000)
        found[language] = rules_broken(page), page.evaluate("document.documentElement.scrollWidth")
    assert found == {"en": ([], 1280), "ru": ([], 360)}


def test_the_numbers_of_the_browser_are_those_of_the_tables(slid):
    page = slid("four-bar")
    values = [
        *np.random.default_rng(3).normal(0, 1, 40) * 10.0 ** np.arange(-20, 20),
        0.0,
        1e6,
        999999.5,
        123456.0,
        1e-5,
    ]
    shown = page.evaluate("values => values.map((one) => printed(one))", [float(one) for one in values])
    assert shown == [number(float(one), "en") for one in values]


REFUSED = [
    (["crank.sped"], "did you mean speed"),
    (["title"], "--slider title: is not a single number"),
    (["crank.speed", "crank.speed=1..9000rpm"], "stands twice"),
    (["crank.speed=9..3rpm"], "write the smaller number first"),
    (["crank.speed=4000..6000rpm"], "take a range around it"),
    (["crank.speed=fast..slow"], "--slider crank.speed"),
    (["crank.speed=1..2..3"], "--slider"),
    (["rod.ratio"], "the file does not state it"),
    (["crank.speed="], "write a key"),
]


def test_what_cannot_be_moved_is_refused():
    stated = crankwork.analyse(described("engine").machine())
    for asked, told in REFUSED:
        with pytest.raises(crankwork.CrankworkError, match=told):
            moved(described("engine"), asked, (), stated)


@pytest.mark.parametrize(
    ("file", "key"),
    [
        ("examples/excavator-boom.toml", "table.step"),
        ("examples/parallelogram.toml", "table.step"),
        pytest.param("tests/machines/wiebe.toml", "cycle.shape", marks=pytest.mark.slow),
    ],
)
def test_what_moves_rows_of_tables_alone_or_no_browser_follows_is_refused(file, key):
    description = crankwork.Description((EXAMPLES.parent / file).read_text("utf-8"))
    stated = crankwork.analyse(description.machine())
    one = moved(description, [key], (), stated)
    with pytest.raises(crankwork.CrankworkError, match="a browser cannot calculate"):
        written(stated, "en", None, one)


def test_a_slider_stops_where_the_machine_does_and_says_why():
    crank = live("crank").sliders[0]
    assert crank.high < 1.5 * crank.now
    assert "no longer turn fully" in str(crank.stop)
    assert "tay quay sẽ không quay trọn vòng nữa" in document("crank", "vi")
    assert len(document("loop", "vi").encode()) < 400_000


def test_work_that_is_rounding_keeps_no_slider_from_moving():
    # a pressure that does not change does no work in a cycle
    description = crankwork.Description({
        "crank": {"radius": "50 mm", "speed": "300 rpm"}, "rod": {"length": "200 mm"},
        "cylinder": {"bore": "100 mm"}, "gas": {"pressure": "20 bar"},
    })  # fmt: skip
    stated = crankwork.analyse(description.machine())
    both = moved(description, ["gas.pressure", "crank.radius"], (), stated)
    assert written(stated, "en", None, both)


def test_a_machine_that_turns_back_is_refused():
    swings = crankwork.Description(crankwork.template("four-bar").replace('"62.5 mm"', '"100 mm"'))
    with pytest.raises(crankwork.CrankworkError, match="turns back at dead positions"):
        moved(swings, ["crank.speed"], (), crankwork.analyse(swings.machine()))


def test_an_extreme_is_explained_where_it_is_now(slid):
    page = slid("six-bar")
    move(page, 0, 55)
    wanted = results("six-bar", design("six-bar", crank_radius=55))
    compared = 0
    for key in ("joint_force_max.A", "joint_force_max.B"):
        shown(page, "values").locator(f'[data-value="{key}"]').click()
        place = key.replace("_max", "_max_angle")
        angle, stated = (displayed(place, one.summary[place]) for one in (wanted, live("six-bar").results[0]))
        line = page.locator("#explanation li").first.inner_text()
        assert f"({angle:.2f}°) = {printed(page, key)}" in line
        compared += abs(angle - stated) > 1
    assert compared


BAR = """
fixed_points = { O2 = ["0 in", "0 in"], O4 = ["10 in", "-20 deg"] }
crank = { pivot = "O2", pin = "A", radius = "4 in", speed = "60 rpm" }
links.coupler = { joins = ["A", "B"], length = "9 in", mass = "2 kg", centre = ["4 in", "10 deg"] }
links.rocker = { joins = ["B", "O4"], length = "6 in" }
branch.B = 1
"""


def test_a_field_has_the_name_of_what_it_is_itself():
    """A distance and a direction give two coordinates, and are neither of them."""
    description = crankwork.Description(BAR)
    options = ("crank.radius=3.9..4.1in", "fixed_points.O4[1]=9.5..10.5in", "links.coupler.centre[2]=0..20deg")
    page = written(*_of(description, options)).decode()
    names = re.findall(r'<label for="move\d" title="([^"]+)">([^<]+)<', page)
    assert names == [("crank.radius", "Crank radius"), *((key.split("=")[0],) * 2 for key in options[1:])]
    # what does not follow its centre is pale, among the main results too
    assert re.search(r'<div class="filed"><dt>[^<]+</dt><dd><button data-key=driving_torque_max>', page)


def _of(description, options):
    results = crankwork.analyse(description.machine())
    return results, "en", None, moved(description, options, (), results)


def test_a_clutch_follows_though_nothing_is_tabulated(slid):
    """The heat goes with the square of the speed; what fails in the page is told by its fixture."""
    page = slid("clutch")
    move(page, 0, 1100)
    # what is not seen follows when it is printed
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert printed(page, "slip_heat") == number(results("clutch", [1100])["slip_heat"], "en")
