"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""

from crankwork.note.sheets.drawn import drawn_sheets
from crankwork.note.sheets.engine_whole import whole_engine_extra
from crankwork.note.sheets.sheet import Paper, Sheet
from crankwork.note.sheets.title_block import TitleBlock

__all__ = [
    "Paper",
    "Sheet",
    "TitleBlock",
    "drawn_sheets",
    "whole_engine_extra",
]
