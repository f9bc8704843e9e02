"""Figures of a Word note stand where they leave no large part of a page empty."""

from __future__ import annotations

from crankwork.formula.calculation_lines import ValueLine
from crankwork.note.document import Equation, Figure, Heading, PageBreak, Paragraph, Table
from crankwork.note.numbering import PAGE, flow, leads
from crankwork.show.scene import Drawing

FIGURE = Figure(Drawing("t", "en", 160.0, 100.0, ()), "Figure", "a figure")
TEXT, HEADING, BREAK = Paragraph(("text",)), Heading(1, "heading"), PageBreak()
TABLE = Table("table", (("x",),), [["1"]])


def _order(*placed: tuple[object, float]) -> list[int]:
    return list(flow([one for one, _ in placed], [height for _, height in placed], 0.03))


def test_a_figure_without_room_waits_until_text_has_filled_the_page():
    assert _order((TEXT, 100.0), (FIGURE, 300.0), (TEXT, 100.0)) == [0, 1, 2]
    placed = (TEXT, 400.0), (FIGURE, 400.0), (TEXT, 150.0), (TEXT, 150.0), (TEXT, 100.0)
    assert _order(*placed) == [0, 2, 3, 1, 4]
    # a page that begins anew waits for no figure
    assert _order((TEXT, 400.0), (FIGURE, 400.0), (BREAK, 0.0), (TEXT, 10.0)) == [0, 1, 2, 3]


def test_no_derivation_is_divided_by_a_table():
    line = Equation(ValueLine("speed", 1.0))
    placed = (TEXT, 600.0), (TABLE, 200.0), (line, 60.0), (line, 60.0), (line, 60.0), (TEXT, 30.0)
    assert _order(*placed) == [0, 2, 3, 4, 1, 5]


def test_figures_keep_their_order_and_no_heading_is_parted_from_its_text():
    placed = (TEXT, 400.0), (FIGURE, 400.0), (FIGURE, 100.0), (TEXT, 290.0), (TEXT, 100.0)
    assert _order(*placed) == [0, 3, 1, 2, 4]
    order = _order((TEXT, 400.0), (FIGURE, 400.0), (HEADING, 300.0), (TEXT, 100.0), (TEXT, 100.0))
    assert order.index(2) + 1 == order.index(3)


def test_a_figure_does_not_leave_its_section():
    assert _order((TEXT, 450.0), (FIGURE, 400.0), (TEXT, 170.0), (HEADING, 46.0), (TEXT, 50.0)) == [0, 2, 1, 3, 4]
    assert _order((TEXT, 350.0), (FIGURE, 500.0), (HEADING, 46.0), (TEXT, 300.0), (TEXT, 50.0)) == [0, 1, 2, 3, 4]


def test_what_has_room_stands_before_what_would_leave_the_page_empty():
    assert _order((TEXT, 550.0), (FIGURE, 400.0), (TABLE, 100.0), (HEADING, 46.0), (TEXT, 50.0)) == [0, 2, 1, 3, 4]


def test_nothing_is_lost():
    for last in (BREAK, TABLE, HEADING):
        placed = [(TEXT, 600.0), (FIGURE, 500.0), (FIGURE, 700.0), (last, 40.0), (FIGURE, 720.0)]
        assert sorted(_order(*placed)) == list(range(5))
    assert PAGE > 700


def test_a_figure_that_almost_fits_is_made_smaller_and_one_that_does_not_is_left():
    for height, share in ((300.0, 0.84), (500.0, None)):
        smaller: dict[int, float] = {}
        placed = (TEXT, 450.0), (FIGURE, height), (HEADING, 46.0), (TEXT, 50.0)
        order = list(flow([one for one, _ in placed], [high for _, high in placed], 0.03, smaller))
        assert order == [0, 1, 2, 3]
        assert {place: round(kept, 2) for place, kept in smaller.items()} == ({1: share} if share else {})


def test_a_line_that_leads_to_an_equation_goes_with_it_to_the_next_page():
    assert leads(Paragraph(("Worked at 30°:",)))
    assert not leads(Paragraph(("Worked at 30°.",)))
