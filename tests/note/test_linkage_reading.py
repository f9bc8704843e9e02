"""What the short note of a linkage says beside its numbers: what repeats, how large forces are, what follows."""

import re

import numpy as np
import pytest

import crankwork
from crankwork.analysis.vector_polygons import worked_position
from crankwork.note.document import Equation, Figure, Heading, Paragraph
from crankwork.note.layout import Digits, Fence, Fraction, Root, Row, Script, Sign, Upright
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.report.display import link_label
from crankwork.show import scene
from each import for_each
from notes import blocks, note, printed, results, tables, words

NUMBER = re.compile(r"−?\d+(?:,\d+)?")


def short(name):
    return note(name, "ru", full=False, figures=True)


def numbers(text):
    return [float(one.replace("−", "-").replace(",", ".")) for one in NUMBER.findall(text)]


def computed(box) -> str:
    """Return what boxes of numbers say as an expression of Python."""
    match box:
        case Row(parts):
            return "".join(map(computed, parts))
        case Fraction(top, bottom):
            return f"({computed(top)})/({computed(bottom)})"
        case Root(inside):
            return f"({computed(inside)})**0.5"
        case Fence(inside):
            return f"({computed(inside)})"
        case Script(base, None, above):
            return f"({computed(base)})**{computed(above)}"
        case Sign(text, _):
            return {"−": "-", "=": "==", "·": "*"}.get(text, text)
        case Digits(text):
            return text.replace(",", ".")
    return box.text if isinstance(box, Upright) and box.text.isdigit() else ""


def sentences(name, word):
    """Return the paragraphs in which a word stands."""
    paragraphs = blocks(short(name), Paragraph)
    found = [
        "".join(getattr(run, "content", run if isinstance(run, str) else "") for run in one.runs) for one in paragraphs
    ]
    return [text for text in found if word in text]


def conclusion(name):
    found = short(name).blocks
    start = next(at for at, block in enumerate(found) if block == Heading(1, "Заключение", numbered=False))
    return ["".join(getattr(run, "content", run) for run in item) for item in found[start + 1].items]


def test_no_column_of_a_table_over_positions_is_constant_or_another_one():
    for label in ("reactions", "torque"):
        rows = tables(short("press-geometry"))[label].rows
        columns = list(zip(*(row[2:] for row in rows), strict=True))
        assert len(columns) > 1
        assert len({*columns}) == len(columns)
        assert all(len({*values}) > 1 for values in columns)
    said = sentences("press-geometry", "Во всех положениях")
    assert any("R_O = R_A" in text for text in said), said
    assert any("M_дин = M_ур" in text for text in said), said
    assert any("v_A = 0,7325" in text for text in said), said


def test_the_conclusion_states_results_with_their_positions():
    summary = results("press-geometry").summary
    moved, loaded, torque, agreement = conclusion("press-geometry")
    degrees = {
        key: np.degrees(summary[f"{key}_angle.punch"]) for key in ("slider_velocity_min", "slider_acceleration_min")
    }
    expected = [5, 1e3 * summary["slider_stroke.punch"], -summary["slider_velocity_min.punch"],
                degrees["slider_velocity_min"], -summary["slider_acceleration_min.punch"],
                degrees["slider_acceleration_min"]]  # fmt: skip
    assert numbers(moved) == pytest.approx(expected, rel=5e-4)
    load, angle = numbers(loaded)
    assert load == pytest.approx(summary["joint_force_max.O"], rel=5e-4)
    # angles are written to a tenth of a degree
    assert angle == pytest.approx(np.degrees(summary["joint_force_max_angle.O"]), abs=0.05)
    assert numbers(torque)[0] == pytest.approx(summary["driving_torque_max"], rel=5e-4)
    # losses take power, though nothing resists: the mean torque is not zero
    assert not any("равен нулю" in text for text in conclusion("press-geometry"))
    rows = [row for kind in ("velocities", "accelerations")
            for row in tables(short("press-geometry"))[f"compared_{kind}"].rows if row[1] != "–"]  # fmt: skip
    shares = [abs(numbers(row[6])[0]) for row in rows if numbers(row[2])[0] > 10.5]
    assert numbers(agreement)[0] == pytest.approx(max(shares), abs=0.06)


@for_each("name", ["press-geometry", "knuckle-press"])
def test_rounding_of_the_computer_is_no_number_of_a_short_note(name):
    assert [text for text in (*words(short(name)), *printed(short(name))) if re.search("10⁻¹[¹²³⁴⁵⁶]", text)] == []


@for_each("name", ["press-geometry", "knuckle-press", "four-bar"])
def test_the_counterweight_can_be_followed_with_a_calculator(name):
    (shown,) = [
        block for block in blocks(short(name), Equation) if getattr(block.step, "key", "") == "counterweight_moment"
    ]
    left, value = computed(shown.printed.lines[1]).strip("=").split("==")
    assert eval(left) == pytest.approx(float(value), rel=1e-3)  # noqa: S307 - numbers of a printed line
    assert float(value) == pytest.approx(results(name).summary["counterweight_moment"], rel=1e-3)


def test_weights_are_compared_with_the_other_forces():
    mass = 255.1 + 153.1 + 81.6 + 102
    (said,) = sentences("press-geometry", "вес звеньев")
    assert numbers(said)[:2] == pytest.approx(
        [results("press-geometry").summary["shaking_force_max"], mass * 9.80665], rel=5e-4
    )
    assert "не введены" in said
    (said,) = sentences("knuckle-press", "вес звеньев")
    assert "сила полезного сопротивления до 200" in said


@for_each("name", ["press-geometry", "knuckle-press", "watt-six-bar", "whitworth"])
def test_reactions_read_on_force_plans_are_those_of_the_calculation(name):
    """On a plan whose longest force is some 80 mm long, a reading to 0.5 mm is right to about a millimetre."""
    degrees = worked_position(results(name))
    columns = {key: float(values[0]) for key, values in results(name).columns_at(np.array([degrees])).items()}
    sizes = [abs(value) for key, value in columns.items() if key.startswith(("joint_force.", "normal_force."))]
    rows = tables(short(name))["compared_forces"].rows
    read_off = [row for row in rows if row[3] != "–"]
    # what is known is laid off, and the table has its length too
    assert len(read_off) >= 4
    assert any("P_и" in row[1].content for row in rows if row[3] == "–")
    for row in read_off:
        length, read, size, share = (numbers(row[index])[0] for index in (2, 3, 4, 6))
        unit = {"Н": 1.0, "кН": 1e3}[row[5]]
        assert any(size * unit == pytest.approx(one, rel=1e-3) for one in sizes), size
        assert abs(read - size) <= 1.5 * read / length
        assert share == pytest.approx(100 * (read / size - 1), abs=0.1)


def test_the_first_drawing_has_the_lengths_of_its_links():
    (said,) = sentences("press-geometry", "Размеры в")
    assert "OA 50; AB 600; CB 210." in said


@for_each("name", ["press-geometry", "knuckle-press"])
def test_inertia_forces_are_masses_times_accelerations(name):
    """Masses and moments of inertia are those of the file; a negative torque goes with a positive acceleration."""
    found = tables(short(name))
    masses = {row[0]: [numbers(cell)[0] if cell != "–" else 0.0 for cell in row[4:6]] for row in found["links"].rows}
    for row in found["inertia_loads"].rows:
        mass, inertia = masses[row[0].partition(" ")[0]]
        acceleration, force, torque = (numbers(row[index])[0] if row[index] != "–" else 0.0 for index in (1, 2, 5))
        assert force * (1e3 if name == "knuckle-press" else 1.0) == pytest.approx(mass * acceleration, rel=2e-3)
        rate = numbers(row[4])[0] if row[4] != "–" else 0.0
        assert torque == pytest.approx(-inertia * rate, rel=2e-3)


def test_dimension_lines_of_the_first_drawing_have_the_lengths_of_the_file():
    """Rod 600 mm, rocker 210 mm, pivots 632 mm apart; of a crank of 50 mm no line is drawn, it would be too short."""
    drawing = next(block.drawing for block in blocks(short("press-geometry"), Figure) if block.label == "f:machine")
    said = {item.text for item in drawing.items if isinstance(item, scene.Text)}
    assert {"600", "210", "632"} <= said


TRIAD = """
[fixed_points]
O = ["0 mm", "0 mm"]
E = ["200 mm", "500 mm"]
F = ["260 mm", "400 mm"]

[crank]
pivot = "O"
pin = "A"
radius = "30 mm"
speed = "60 rpm"

[links]
rod = { joins = ["A", "B"], length = "123.69 mm" }
plate = { joins = ["B", "C"], length = "86.02 mm", points = { D = ["-36.04 mm", "-87.19 mm"] } }
arm = { joins = ["C", "E"], length = "400 mm" }
leg = { joins = ["D", "F"], length = "453.98 mm" }

[positions]
B = ["150 mm", "30 mm"]
C = ["200 mm", "100 mm"]
D = ["200 mm", "-50 mm"]
"""


def test_a_group_of_class_iii_has_its_equations():
    triad = crankwork.analyse(crankwork.read_machine(TRIAD))
    found = note_of(triad, NoteOptions(language="ru", figures=False))
    said = ["".join(run for run in one.runs if isinstance(run, str)) for one in blocks(found, Paragraph)]
    assert any("x₁ + ξ₁ cos φ₁ − η₁ sin φ₁ = x₂ + ξ₂ cos φ₂ − η₂ sin φ₂" in text for text in said)
    assert not any("x₁ + ξ₁" in text for text in sentences("press-geometry", ""))


def test_links_with_a_number_have_words_of_the_language():
    assert [link_label("rod_1", language) for language in ("en", "ru", "vi")] == ["rod 1", "шатун 1", "thanh truyền 1"]
    assert link_label("rod_of_mine", "ru") == "rod_of_mine"


@for_each("name", ["press-geometry", "crank-shaper", "four-bar"])
def test_equations_of_moments_can_be_followed_with_a_calculator(name):
    """Each has its numbers put in, and what they come to is printed beside them."""
    equations = [block.printed for block in blocks(short(name), Equation) if block.printed is not None]
    lines = [line for equation in equations if "… = 0" in equation.text for line in equation.lines]
    worked = [computed(line) for line in lines if "Fraction" in repr(line)]
    assert len(worked) >= 1
    for text in (one.text for one in equations if "^τ" in one.text):
        moments, _, forces = text.rpartition("; ")
        assert set(re.findall(r"(R_\w+)\^τ", moments)) <= set(forces.split(" "))
    for line in worked:
        *_, left, value = line.split("==")
        assert eval(left) == pytest.approx(float(value), rel=5e-3)  # noqa: S307 - numbers of a printed line


def test_gravity_left_out_is_said_where_the_forces_begin():
    runs = [block for block in short("press-geometry").blocks if isinstance(block, Heading | Paragraph)]
    place = next(k for k, block in enumerate(runs) if getattr(block, "text", "") == "Силовой расчёт механизма")
    assert "Силы тяжести в задании не заданы" in str(runs[place + 1])


def test_nothing_is_announced_that_is_not_there():
    """No static torque where none acts, no section on an efficiency that nobody gave."""
    for name in ("whitworth", "press-geometry"):
        said = " ".join(words(short(name)))
        assert ("КПД механизма" in said) == (name == "press-geometry")
        assert "Не изображено" not in said
        assert "статический момент равен нулю" in said
