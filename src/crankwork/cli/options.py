"""Options that commands share; their help texts are in the text file `help`."""

from __future__ import annotations

import click

from crankwork.cli.spoken import language_of_system
from crankwork.locale import LANGUAGES

LANGUAGE = click.Choice(LANGUAGES)

LANG = click.option("--lang", "language", type=LANGUAGE, default=language_of_system)
SYSTEM = click.option("--units", type=click.Choice(["metric", "si", "imperial"]))
SET = click.option("--set", "settings", multiple=True, metavar="KEY=VALUE")
METHOD = click.option("--method", metavar="NAME")
STEP = click.option("--step", metavar="DEG")
PER_AREA = click.option("--per-area", is_flag=True)
NO_FIGURES = click.option("--no-figures", is_flag=True)
FORMAT = click.option("--format", "formats", default="svg", metavar="FORMATS")
THEME = click.option("--theme", type=click.Choice(["print", "colour", "dark"]), default="print")
COMPARE = click.option("--compare", metavar="METHODS|FILE")
JSON = click.option("--json", "as_json", is_flag=True)
OVERWRITE = click.option("--overwrite", is_flag=True)
