"""Draws the pictures of the README and the guide from the files that these show."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import crankwork
from campaigns.marked import ROOT
from crankwork.report.drawing import drawn

IMAGES = ROOT / "docs" / "images"


def first_file(page: str) -> str:
    """Return the first machine file that a page shows."""
    text = re.search(r"```toml\n(.*?)```", (ROOT / page).read_text("utf-8"), re.DOTALL)
    assert text is not None, page
    return text[1]


def draw(folder: Path) -> None:
    """Draw all of them into a folder."""
    engine = crankwork.analyse(crankwork.read_machine(first_file("README.md")))
    shaper = crankwork.analyse(crankwork.read_machine(first_file("docs/guide/linkages.md")))
    (folder / "machine.svg").write_bytes(drawn(engine, "svg", "colour", forces=False))
    (folder / "machine-dark.svg").write_bytes(drawn(engine, "svg", "dark", forces=False))
    (folder / "shaper.svg").write_bytes(drawn(shaper, "svg", "colour", forces=False))
    shaper.figure("position_plans").save(folder / "shaper-positions.svg", overwrite=True)
    spark = crankwork.analyse(crankwork.read(ROOT / "examples" / "spark-engine.toml"))
    for name in ("piston_forces", "torque", "crankpin_polar"):
        spark.figure(name).save(folder / f"{name}.svg", overwrite=True)


def main(arguments: list[str]) -> int:
    """Draw into the folder of the images, or another one, and replace what is there."""
    target = Path(arguments[0]) if arguments else IMAGES
    with TemporaryDirectory() as folder:
        draw(Path(folder))
        for picture in Path(folder).iterdir():
            (target / picture.name).write_bytes(picture.read_bytes())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
