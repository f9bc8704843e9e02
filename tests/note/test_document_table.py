"""The table [document] of a machine file: the cover of a note, and the sections that it has."""

import re
import shutil
import subprocess

import pytest

import crankwork
import notes
from crankwork.description.document import Description
from crankwork.description.keys import CLUTCH_FILE, MACHINE_FILE
from crankwork.description.links_keys import LINKAGE_FILE, ROTOR_FILE, TRANSFER_FILE, TURNING_FILE
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import InputError
from crankwork.note.document import Heading, TitlePage
from crankwork.note.material import Material
from crankwork.note.options import NoteOptions
from crankwork.note.sections import SECTIONS, WRITERS, note_of, sections_of, written_note
from crankwork.quantities import LANGUAGES
from each import for_each

MACHINE = template("slider-crank")
FULL = """
[document]
ministry = "Министерство образования"
institution = "Казанский университет"
faculty = "Факультет двигателей"
department = "Кафедра теории механизмов и машин"
work = "Курсовой проект"
subject = "Теория механизмов и машин"
variant = "5"
designation = "ТММ.01.05.00.000 ПЗ"
author = ["Иванов И. И.", "Nguyễn Văn An"]
student_number = "103210001"
group = "3142"
supervisor = "Петров П. П."
checked_by = "Сидоров С. С."
standards_by = "Козлов К. К."
approved_by = "Волков В. В."
city = "Казань"
year = 2026
"""


def _note(document: str, language: str = "ru", source: str = MACHINE):
    results = crankwork.analyse(read_machine(f"{source}\n{document}"))
    return note_of(results, NoteOptions(full=True, language=language, figures=False))


def _plain(data: bytes) -> str:
    return re.sub(r"<[^>]*>", " ", data.decode("utf-8"))


def _cover(note) -> TitlePage:
    (page,) = (block for block in note.blocks if isinstance(block, TitlePage))
    return page


@for_each("language", LANGUAGES)
def test_what_the_table_says_stands_on_the_cover(language):
    one = _note(FULL, language)
    assert one.authors == ("Иванов И. И.", "Nguyễn Văn An")
    shown = _plain(written_note(one, "a.html")).partition(one.title)
    said = shown[0] + shown[2].partition("cover")[0]
    assert [stated for stated in re.findall(r'"([^"]*)"', FULL) if stated not in said] == []
    people = _cover(one).people
    assert people[0].names == (("Петров П. П.",) if language == "vi" else ("Иванов И. И.", "Nguyễn Văn An"))
    assert {person.signs for person in people} == ({True, False} if language == "ru" else {False})


def test_a_cover_without_a_table_says_what_the_note_is():
    # the title of the file is in English
    below = ("Slider-crank mechanism", "Кинематический и динамический расчёт. Расчётно-пояснительная записка")
    assert _cover(_note("")) == TitlePage(below=below)
    # an option goes before the author of the file
    results = crankwork.analyse(read_machine(MACHINE + FULL))
    assert note_of(results, NoteOptions(full=True, author="Another", figures=False)).authors == ("Another",)


@for_each(("language", "place"), [("en", "Hanoi, 2026-05-31"), ("ru", "Hanoi 2026"), ("vi", "Hanoi, 2026")])
def test_a_day_gives_the_year(language, place):
    for written in ("2026-05-31", '"2026-05-31"'):
        found = _note(f'[document]\ncity = "Hanoi"\ndate = {written}', language)
        assert (_cover(found).place, str(found.date)) == (place, "2026-05-31")


REFUSED = {
    'sections = ["kinematic"]': 'sections[1]: "kinematic" is no section of this note; write "kinematics"',
    'sections = ["qq"]': '"qq" is no section of this note; write one of summary, preface, data',
    "sections = []": "sections: has 0 entries",
    'sheets = ["To"]': 'sheets[1]: "To" is no name of a figure; write small letters, digits and _',
    'figures.one = ["piston_fource"]': 'of the tables, such as "piston_force"',
    'figures.one = ["qqq"]': 'figures.one[1]: "qqq" is no quantity; write the key of a column',
    'figures."a/b" = ["piston_force"]': 'figures.a/b: "a/b" is no name of a figure',
    'date = "31.05.2026"': 'date: "31.05.2026" is no day; write year, month and day, "2026-05-31"',
    "date = 2026-05-31T10:00:00": "date: 2026-05-31 10:00:00 is no day",
    "date = 2026-05-31\nyear = 2026": "document.year: says the same as date",
    "year = 2026.5": "year: 2026.5",
    "author = 3": "author: 3 must be text in quotes",
    'author = ["a", "b\\nc"]': "author[2]: ",
    f'institution = "{"ы" * 301}"': "is too long, 301 characters; write at most 300",
    'departmant = "x"': "departmant: unknown key; did you mean department?",
}


@for_each("stated", REFUSED)
def test_what_no_cover_can_say_is_refused_on_its_line(stated):
    with pytest.raises(InputError, match=re.escape(REFUSED[stated])) as refusal:
        read_machine(f"{MACHINE}\n[document]\n{stated}\n")
    assert refusal.value.places == [f"text:{len(MACHINE.splitlines()) + 3 + stated.count(chr(10))}"]


LONG = " ".join(["слово"] * 50)


@pytest.fixture(scope="module")
def long_note():
    """A note in whose table every field is as long as it may be."""
    fields = [
        one
        for one in MACHINE_FILE.keys["document"].kind.keys
        if one not in ("year", "date", "sections", "sheets", "figures", "scale")
    ]
    assert len(LONG) == 299
    fields = [one for one in fields if not one.startswith("title_")]
    return _note("[document]\nsections = 'data'\n" + "\n".join(f'{one} = "{LONG}"' for one in fields))


def test_long_fields_are_written_in_every_format(long_note):
    assert [ending for ending in WRITERS if not written_note(long_note, f"a{ending}")] == []


@pytest.mark.programs
def test_long_fields_wrap_and_stay_on_the_cover(long_note, tmp_path):
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is not installed")
    path = tmp_path / "note.pdf"
    path.write_bytes(written_note(long_note, "note.pdf"))
    first, second = (
        subprocess.run(["pdftotext", *page, str(path), "-"], capture_output=True, text=True, check=True).stdout
        for page in (("-l", "1"), ("-f", "2"))
    )
    assert first.count("слово") == 17 * 50
    assert "слово" not in second


FILES = (
    (MACHINE_FILE, ("spark-engine", "v8-diesel", "radial-five", "slider-crank")),
    (LINKAGE_FILE, ("atkinson", "excavator-boom", "parallelogram", "beta-stirling")),
    (TRANSFER_FILE, ("press",)),
    (TURNING_FILE, ("punching-machine",)),
    (ROTOR_FILE, ("balancing",)),
    (CLUTCH_FILE, ()),
)


def test_sections_that_a_file_may_name_are_those_of_its_note():
    for file, machines in FILES:
        made = {name for one in machines for name in sections_of(Material(notes.results(one), NoteOptions(full=True)))}
        # results of few machines have every section
        assert made <= set(_sections(file)), machines
    assert {section.name for section in SECTIONS} == {name for file, _ in FILES for name in _sections(file)}


def _sections(file):
    return file.keys["document"].kind.keys["sections"].kind.entry.options


def test_sections_stand_in_the_order_in_which_they_are_named():
    one = _note('[document]\nsections = ["checks", "kinematics", "data"]', "en")
    assert [block.text for block in one.blocks if isinstance(block, Heading) and block.level == 1] == [
        "Checks", "Kinematics of the crank gear", "Input data", "Nomenclature", "References",
    ]  # fmt: skip


@pytest.mark.slow
@for_each(
    ("name", "file"),
    [("engine", MACHINE_FILE), ("four-bar", LINKAGE_FILE), ("turning-moment", TURNING_FILE), ("balancing", ROTOR_FILE)],
)
def test_every_section_stands_alone(name, file):
    values = Description(template(name))
    lengths = {}
    for section in _sections(file):
        values["document.sections"] = [section]
        found = note_of(crankwork.analyse(values.machine()), NoteOptions(full=True, figures=False))
        assert written_note(found, "a.html"), section
        lengths[section] = len(found.blocks)
        titles = [block for block in found.blocks if isinstance(block, Heading) and block.level == 1]
        # itself, the symbols of its equations and its sources
        assert len(titles) <= 3, section
    assert max(lengths.values()) > min(lengths.values())
