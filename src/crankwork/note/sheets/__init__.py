"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""

from crankwork.note.sheets.drawn import drawn_sheets
from crankwork.note.sheets.dxf import sheet_dxf
from crankwork.note.sheets.engine_whole import whole_engine_extra
from crankwork.note.sheets.pdf import sheet_pdf
from crankwork.note.sheets.sheet import Paper, Sheet
from crankwork.note.sheets.svg import sheet_svg
from crankwork.note.sheets.title_block import TitleBlock

__all__ = [
    "Paper",
    "Sheet",
    "TitleBlock",
    "drawn_sheets",
    "sheet_dxf",
    "sheet_pdf",
    "sheet_svg",
    "whole_engine_extra",
]
