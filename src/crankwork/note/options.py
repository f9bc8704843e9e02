"""Options of a note."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from crankwork.quantities import Language


@dataclass(frozen=True)
class NoteOptions:
    """How a note is to be written.

    Parameters
    ----------
    language : str
        `en`, `ru` or `vi`.
    school : str
        Whose order of sections and symbols: `en`, `ru` or `vi`; that of the language if empty.
    per_area : bool
        Divide forces by the piston area.
    title : str
        Instead of the title of the machine.
    author : str
        Who hands it in.
    full : bool
        Every formula, and the tables at their own step, as a school requires; else the main course alone.
    figures : bool
        Draw figures.
    sheets : bool
        Whether drawing sheets are written beside the note.
    paper : str
        Format of the sheets, `A0` to `A3`.
    grid : bool
        Whether the sheets are millimetre paper.
    """

    language: Language = "en"
    school: str = ""
    per_area: bool = False
    title: str = ""
    author: str = ""
    full: bool = False
    figures: bool = True
    sheets: bool = False
    paper: Literal["A0", "A1", "A2", "A3"] = "A1"
    grid: bool = False

    @property
    def order(self) -> str:
        """The school whose order of sections is followed: `en`, `ru` or `vi`."""
        return self.school or self.language
