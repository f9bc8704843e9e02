"""Drawing sheets in millimetres: graphs with their scales, as students hand them in, as SVG, PDF and DXF."""

from crankwork.note.sheets.drawn import drawn_sheets
from crankwork.note.sheets.sheet import Paper, Sheet
from crankwork.note.sheets.title_block import TitleBlock, block_of

__all__ = [
    "Paper",
    "Sheet",
    "TitleBlock",
    "block_of",
    "drawn_sheets",
]
