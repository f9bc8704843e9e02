"""Mistakes in the file of a linkage: each is told on its line, with what to write instead."""

from __future__ import annotations

import itertools
import json
import re
import resource
from pathlib import Path

import pytest

from crankwork.analysis import analyse
from crankwork.description.machine_file import read, template
from each import for_each

EXAMPLES = Path(__file__).parents[2] / "examples"
DYAD = 'rocker  = { joins = ["C", "B"]'
ROCKER = 'length = "112.5 mm"'
LINKS = "[links]\n{}\n"
AT = 'at = ["11 mm", "21 mm", "31 mm"]'
PARTIAL = (
    "my.toml: the linkage moves from {} only; the results are those of this range: change a length if the crank shall "
    "turn fully\n"
)
MOTOR = '[motor]\nrated_power = "2.2 kW"\nrated_speed = "{}"\noverload = {}\npole_pairs = {}\n[table]'

# template or example, the original text, what a user writes, the key blamed, and words of the advice
MISTAKES = {
    "two cranks": ("four-bar", "[crank]", '[[crank]]\npin = "Z"\n[[crank]]', "crank", "a list of 2; there is only one"),
    "floating link": ("four-bar", "[links]", LINKS.format('z = { joins = ["X", "Y"], length = "1 m" }'), "links.z",
                      "hangs on nothing else; a link needs two joints"),
    "hanging link": ("four-bar", "[links]", LINKS.format('z = { joins = ["B", "Y"], length = "1 m" }'), "links.z",
                     "hangs only on B, and nothing else is joined at Y"),
    "joint twice": ("four-bar", '["A", "B"]', '["A", "A"]', "links.coupler.joins", "names a joint twice: A, A"),
    "joint as a point": ("four-bar", "points = { P =", 'points = { B = ["1 mm", "2 mm"], P =',
                         "links.coupler.points.B", "leave it out"),
    "over-constrained": ("four-bar", "[branch]", 'z = { joins = ["P", "C"], length = "150 mm" }\n[branch]', "links.z",
                         "(mobility 0) and does not fit: where the others move"),
    "mobility 2": ("four-bar", DYAD, f'z = {{ joins = ["B", "D"], length = "1 m" }}\n{DYAD.replace("B", "D")}',
                   "links", "2 degrees of freedom with one driver: coupler, z, rocker can move on their own; add"),
    "locked slider": ("scotch-yoke", '{ through = "O", angle = "0 deg" }', '{ link = "crank", angle = "90 deg" }',
                      "sliders.yoke", "cannot slide, because yoke and block are held by crank alone; join one of them"),
    "zero length": ("four-bar", "175 mm", "0 mm", "links.coupler.length", 'write at least "0.001 mm"'),
    "branch 2": ("four-bar", "B = 1 ", "B = 2 ", "branch.B", "2 is not possible here; write 1 or -1"),
    "branch of no joint": ("four-bar", "B = 1 ", "Z = 1 ", "branch.Z", "Z has no branch; there is one for: B"),
    "nowhere": ("toggle-press", 'through = "E"', 'through = ["900 mm", "0 mm"]', "links.lower",
                "543.6 mm too short; lengthen it by more than that or move the guide"),
    "unknown pivot": ("four-bar", 'pivot = "O"', 'pivot = "Q"', "crank.pivot", "give it in [fixed_points]"),
    "unknown centre": ("four-bar", 'centre = "P"', 'centre = "Q"', "links.coupler.centre", "Q is not a point of"),
    "unknown guide": ("toggle-press", 'guide = "bed"', 'guide = "bad"', "sliders.ram.guide", "give it in [guides.bad]"),
    "unknown carrier": ("toggle-press", 'through = "E"', 'link = "zz"', "guides.bed.link", "neither a link nor"),
    "unknown slider": ("toggle-press", 'slider = "ram"', 'slider = "rm"', "loads[1].slider", "there is ram"),
    "unknown load": ("toggle-press", '"process"', '"proces"', "loads[1].kind", 'write "process", "force"'),
    "key of another kind": ("toggle-press", '"process"', '"process"\npoint = "D"', "loads[1].point", "leave it out"),
    "no kind": ("toggle-press", 'kind = "process"', "", "loads[1].kind", 'write kind = "process"'),
    "not rising": ("toggle-press", AT, AT.replace("31", "15"), "loads[1].at", "must rise from value to value"),
    "too few": ("toggle-press", AT, 'at = ["1 mm", "2 mm"]', "loads[1].at", "has 2 values for 3 of force"),
    "no column": ("toggle-press", AT, "", "loads[1].at", "3 values of force need as many"),
    "angles for a stroke": ("toggle-press", AT, 'at = ["1 deg", "2 deg", "3 deg"]', "loads[1].at", 'add against = "an'),
    "spring of nothing": ("four-bar", "[table]", '[[loads]]\nkind = "spring"\nstiffness = "1 N/m"\n[table]',
                          "loads[1].between", "give between or slider"),
    "spring of one point": ("four-bar", "[table]",
                            '[[loads]]\nkind = "spring"\nstiffness = "1 N/m"\nbetween = ["B", "B"]\n[table]',
                            "loads[1].between", "joins two different points"),
    "damper of nothing": ("four-bar", "[table]", '[[loads]]\nkind = "damper"\ndamping = "1 N*s/m"\n[table]',
                          "loads[1].between", "a damper joins two points or holds a slider; give between or slider"),
    "damper of one point": ("four-bar", "[table]",
                            '[[loads]]\nkind = "damper"\ndamping = "1 N*s/m"\nbetween = ["B", "B"]\n[table]',
                            "loads[1].between", "a damper joins two different points"),
    "rubbing pin of nothing": ("four-bar", "[table]", "[friction.pins]\nZ = { moment = '1 N*m' }\n[table]",
                               "friction.pins.Z", 'there is no pin "Z"; there is O, A, B, C'),
    "rubbing slider of nothing": ("four-bar", "[table]", "[friction.sliders]\nZ = { force = '1 N' }\n[table]",
                                  "friction.sliders.Z", 'nothing slides by the name "Z"'),
    "rubbing too much": ("four-bar", "[table]", "[friction.pins]\nA = { coefficient = 20, radius = '1 mm' }\n[table]",
                         "friction.pins.A.coefficient", "a coefficient of friction is a ratio"),
    "rubbing pin without a size": ("four-bar", "[table]", "[friction.pins]\nA = { coefficient = 0.1 }\n[table]",
                                   "friction.pins.A.radius", "write radius"),
    "efficiency 0": ("four-bar", "[table]", "[efficiency]\nchain = [0]\n[table]", "efficiency.chain[1]", "from 0.001"),
    "efficiency 1.2": ("four-bar", "[table]", "[efficiency]\nchain = [1.2]\n[table]", "efficiency.chain[1]", "to 1"),
    "efficiency of nothing": ("four-bar", "[table]", "[efficiency]\nchain = [0.01, [0.02, 0.03], 0.1]\n[table]",
                              "efficiency.chain", "comes to 2.5e-05 only; leave out"),
    "efficiency rounded away": ("four-bar", "[table]", "[efficiency]\nchain = [0.01]\ndecimals = 1\n[table]",
                                "efficiency.decimals", "rounds an efficiency of 0.01 to 0"),
    "motor too quick": ("four-bar", "[table]", MOTOR.format("1600 rpm", 2.2, 2), "motor.rated_speed", "must be below"),
    "motor of no overload": ("four-bar", "[table]", MOTOR.format("1430 rpm", 1, 2), "motor.overload", "from 1.01"),
    "half a pair of poles": ("four-bar", "[table]", MOTOR.format("1430 rpm", 2, 1.5), "motor.pole_pairs", "whole"),
    "fluctuation 0": ("four-bar", "[table]", "[flywheel]\nfluctuation = 0\n[table]", "flywheel.fluctuation", "1e-06"),
    "fluctuation 3": ("four-bar", "[table]", "[flywheel]\nfluctuation = 3\n[table]", "flywheel.fluctuation", "to 1"),
    "let go by no motor": ("andrews-squeezer", "[transient]", "[transient]\nmotor = true", "transient.motor",
                           "describe one, or give a torque"),
    "let go beyond its stops": ("andrews-squeezer", "[transient]", '[transient]\nstops = ["10 deg", "20 deg"]',
                                "transient.stops", "transient.start is between them"),
    "a stop gives back more": ("andrews-squeezer", "[transient]",
                               '[transient]\nstops = ["-10 deg", "20 deg"]\nrestitution = 1.5',
                               "transient.restitution", "to 1"),
    "positions short of one": ("press", '"0.028 m", "0.042 m"', '"0.028 m"', "transfer.bodies.punch.velocity",
                               "has 11 values for 12 positions"),
    "positions not rising": ("press", '"60 deg", "90 deg"', '"90 deg", "60 deg"', "transfer.angles", "must rise"),
    "long name": ("stephenson-six-bar", "output ", f"{'x' * 61} ", f"links.{'x' * 61}", "write 1 to 60 characters"),
    "name of two lines": ("stephenson-six-bar", "output ", '"a\\nb" ', "links.a\\nb", "without line breaks"),
}  # fmt: skip


def _source(name):
    path = EXAMPLES / f"{name}.toml"
    return path.read_text("utf-8") if name in ("andrews-squeezer", "press") else None


@for_each("mistake", MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake_is_told_once_on_its_line_with_what_to_write(
    crankwork, machine_file, check_mistakes, mistake
) -> None:
    name, old, new, key, advice = mistake
    file = machine_file((old, new), name=name, text=_source(name))
    answer = crankwork("check", file)
    check_mistakes(answer)
    assert len(answer.mistakes) == 1, answer.err
    told = re.fullmatch(r"my\.toml:(\d+): ([^:]+): (.+)", answer.mistakes[0])
    assert told, answer.err
    assert (told[2], advice in told[3]) == (key, True), answer.err
    line = Path(file).read_text("utf-8").split("\n")[int(told[1]) - 1]
    assert any(part in line for part in re.sub(r"\[\d+\]", "", key).split(".")) or "\\n" in key


SETTINGS = {
    ("--set", "links.copler.length=1 m"): "--set links.copler.joins: is missing",
    ("--set", "links.coupler.lenght=1 m"): "--set links.coupler.lenght: unknown key; did you mean length?",
    ("--set", "links.coupler.length=1"): "--set links.coupler.length: 1 has no unit",
    ("--set", "links=1"): "--set links: must be a table",
    ("--set", "branch.B=2"): "--set branch.B: 2 is not possible here; write 1 or -1",
    (
        "--set",
        "method.kinematics=textbook",
    ): "--set method.kinematics: method textbook exists only for cranks with rods and pistons",
    ("--method", "textbook"): "--method: method textbook exists only for cranks with rods and pistons",
    ("--method", "series:3"): "--method: method series:3 exists only for cranks with rods and pistons",
}


@for_each("setting", SETTINGS)
def test_a_wrong_setting_is_named(crankwork, machine_file, check_mistakes, setting) -> None:
    answer = crankwork("run", machine_file(name="four-bar"), *setting)
    check_mistakes(answer)
    assert answer.mistakes[0].startswith(SETTINGS[setting])


def test_a_step_is_refused_where_the_document_gives_the_positions(crankwork, check_mistakes) -> None:
    answer = crankwork("run", str(EXAMPLES / "press.toml"), "--step", "5")
    check_mistakes(answer)
    assert "the positions are those of transfer.angles" in answer.err


def test_a_motor_weaker_than_the_load_is_told_with_the_angle_where_it_stalls(crankwork, machine_file) -> None:
    motor = MOTOR.format("1430 rpm", 2.2, 2).replace("2.2 kW", "0.1 kW").replace("[table]", "ratio = 24\n[table]")
    answer = crankwork("run", machine_file(("[table]", motor), name="toggle-press"))
    assert answer.code == 0
    assert "35.257 N·m on the crank" in answer.out
    assert "stalls at 247.58°" in answer.out


def test_results_up_to_a_position_that_cannot_be_reached_are_kept(crankwork, machine_file) -> None:
    answer = crankwork("run", machine_file((ROCKER, 'length = "75 mm"'), name="four-bar"))
    assert answer.code == 1
    assert answer.err == PARTIAL.format("−138.05° to 138.05°")
    assert "the linkage moves from −138.05° to 138.05° only: links coupler and rocker do not meet at B" in answer.out
    assert analyse(read("my.toml")).grid.degrees.tolist() == [10.0 * number for number in range(-13, 14)]
    nothing_else = crankwork("run", "my.toml", "--step", "180", "--set", "links.rocker.length=10 mm")
    assert nothing_else.err == PARTIAL.format("48.145° to 67.217°")
    assert "moves from 48.145° to 67.217° only" in nothing_else.out


def test_change_points_on_the_way_are_passed_and_told(crankwork, machine_file) -> None:
    """A parallelogram: at half a turn all links lie in line."""
    changes = (('"62.5 mm"', '"100 mm"'), ('"175 mm"', '"200 mm"'), (ROCKER, 'length = "100 mm"'))
    answer = crankwork("run", machine_file(*changes, ('# start = "0 deg" ', 'start = "30 deg" '), name="four-bar"))
    assert answer.code == 0
    assert "not met" not in answer.out
    assert "change points at 150°, 330° are passed straight on" in answer.out


def _chain_of_dyads(stages):
    fixed, links, joints, last = ['O = ["0 mm", "0 mm"]'], [], [], "A"
    body = 'mass = "1 kg", inertia = "0.003 kg*m2", centre = ["50 mm", "0 mm"]'
    for number in range(stages):
        fixed.append(f'F{number} = ["{200 * (number + 1)} mm", "0 mm"]')
        joints.append(f'B{number} = ["{200 * (number + 1)} mm", "100 mm"]')
        links.append(f'c{number} = {{ joins = ["{last}", "B{number}"], length = "200 mm", {body} }}')
        links.append(f'r{number} = {{ joins = ["F{number}", "B{number}"], length = "100 mm", {body} }}')
        last = f"B{number}"
    crank = '[crank]\npivot = "O"\npin = "A"\nradius = "20 mm"\nspeed = "60 rpm"\nstart = "90 deg"'
    return "\n".join(["[fixed_points]", *fixed, crank, "[links]", *links, "[positions]", *joints])


@pytest.mark.slow
def test_a_chain_of_two_hundred_stages_is_computed_in_less_than_a_gigabyte(crankwork, machine_file) -> None:
    path = machine_file(text=_chain_of_dyads(200))
    # beyond what the tests before have left
    held = int(re.search(r"VmData:\s+(\d+)", Path("/proc/self/status").read_text()).group(1)) << 10
    limit = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (held + (1 << 30), limit[1]))
    try:
        answer = crankwork("check", path)
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, limit)
    assert answer.code == 0, answer.err


def test_two_hundred_links_and_a_loose_chain_are_refused_for_the_loose_chain(
    crankwork, machine_file, check_mistakes
) -> None:
    text = _chain_of_dyads(100)
    joints = ["B99", *(f"L{number}" for number in range(30)), "F0"]
    loose = [f'{a}{b} = {{ joins = ["{a}", "{b}"], length = "1 m" }}' for a, b in itertools.pairwise(joints)]
    answer = crankwork("check", machine_file(text=text.replace("[links]", "\n".join(["[links]", *loose]))))
    check_mistakes(answer)
    assert "30 degrees of freedom" in answer.err


def test_a_slot_all_but_along_its_guide_has_no_second_position(crankwork, machine_file) -> None:
    change = ('link = "yoke", angle = "90 deg"', 'link = "yoke", angle = "9e-05 deg"')
    answer = crankwork("check", machine_file(change, name="scotch-yoke"))
    assert answer.code == 2
    assert "yoke" in answer.err


@for_each(
    ("name", "stated", "better", "longer"),
    [
        ("watt-six-bar", "B = -1", "B = 1", "lengthen one of them"),
        ("crank-shaper", "lever = -1", "lever = 1", "lengthen it"),
    ],
)
def test_another_branch_is_proposed_before_a_longer_link(crankwork, machine_file, name, stated, better, longer) -> None:
    text = template(name).replace("[table]", f"[branch]\n{stated}\n[table]")
    answer = crankwork("check", machine_file(text=text))
    assert answer.code > 0
    told = answer.out + answer.err
    assert f"write {better} below [branch]" in told.partition(longer)[0]
    assert longer in told
    assert crankwork("check", machine_file(text=text.replace(stated, better))).code == 0


def test_a_branch_that_would_not_help_is_not_proposed(crankwork, machine_file) -> None:
    told = crankwork("check", machine_file(("112.5 mm", "75 mm"), name="four-bar"))
    assert "[branch]" not in told.out + told.err


def test_a_link_between_two_fixed_points_is_told_as_one_too_many(crankwork, machine_file) -> None:
    bar = '[links]\nbar = {{ joins = ["O", "C"], length = "{} mm" }}'
    plain = json.loads(crankwork("run", machine_file(name="four-bar"), "--json").out)["summary"]
    answer = crankwork("run", machine_file(("[links]", bar.format(200)), name="four-bar"), "--json")
    # what bar and ground pass on to each other nobody knows
    of_joints = ("joint_force", "crankpin_", "mean_crankpin_load", "oil_hole_angle")
    known = {key: one for key, one in plain.items() if not key.startswith(of_joints)}
    assert (answer.code, json.loads(answer.out)["summary"] == known) == (0, True)
    assert "bar is one link too many" in crankwork("run", "my.toml").out
    answer = crankwork("check", machine_file(("[links]", bar.format(150)), name="four-bar"))
    assert answer.code == 2
    assert "its joints are 200 to 200 mm apart, and it is 150 mm long; leave it out" in answer.err


def test_a_forgotten_centre_is_told_as_missing(crankwork, check_mistakes) -> None:
    text = re.sub(r", centre = [^}]*\}", " }", template("four-bar"), count=1)
    Path("a.toml").write_text(text, encoding="utf-8")
    answer = crankwork("check", "a.toml")
    check_mistakes(answer)
    fix = 'give a share of the length, as 0.5 for the middle, or two coordinates, like ["50 mm", "0 mm"]'
    assert f"links.coupler.centre: is missing; {fix}" in answer.err
