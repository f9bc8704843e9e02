"""Options that commands share, and help of the commands in the requested language, instead of Click's English."""

from __future__ import annotations

import os
import re
import sys

import click

from crankwork.locale import LANGUAGES, Language, has_text, translate


def language_of_system() -> Language:
    """Return the language of the system if it has texts, otherwise English."""
    stated = (os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG"))
    own = re.split(r"[_.@]", next(filter(None, stated), ""))[0]
    return next((language for language in LANGUAGES if language == own), "en")


def requested_language() -> Language:
    """Return the language of the command line, even if its arguments are wrong, or that of the system."""
    requested = re.findall(r"(?<=\0)--lang[\0=](\w+)(?=\0)", "\0".join(["", *sys.argv[1:], ""]))
    return next((language for language in LANGUAGES if language in requested[-1:]), language_of_system())


def placeholder(words: str) -> str:
    """Return the placeholders of a usage, `-o FILE`, in the language; literal words are in lower case."""

    def stand_in(match: re.Match[str]) -> str:
        return translate(stand_in_key(match[0]), requested_language()).upper().replace(" ", "-")

    # formats of paper are no placeholders
    return re.sub(r"[A-Z]+(?!\d)", stand_in, words)


def stand_in_key(word: str) -> str:
    """Return the key of the text of a placeholder."""
    return {"OPTIONS": "help.options", "VALUE": "columns.value"}.get(word, f"help.value_{word.lower()}")


def option_key(command: str, option: click.Parameter) -> str:
    """Return the key of the help text of an option: that of its command, or that of all commands."""
    name = option.opts[-1].lstrip("-").replace("-", "_")
    own = f"help.{command}_{name}"
    return own if has_text(own) else f"help.{name}"


class LocalizedCommand(click.Command):
    """A command with help in the requested language."""

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the usage of the command."""
        words = placeholder(" ".join(self.collect_usage_pieces(ctx)))
        formatter.write_usage(ctx.command_path, words, prefix=f"{translate('help.usage', requested_language())}: ")

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the purpose of the command."""
        self.help = self._purpose(self)
        super().format_help_text(ctx, formatter)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the help of each option, and the purpose of each command of a group."""
        language = requested_language()
        rows = [
            (placeholder(record[0]), translate(option_key(str(self.name), option), language, default=option.default))
            for option in self.get_params(ctx)
            if isinstance(option, click.Option) and (record := option.get_help_record(ctx)) is not None
        ]
        with formatter.section(translate("help.options", language)):
            formatter.write_dl(rows)
        if isinstance(self, click.Group):
            with formatter.section(translate("help.commands", language)):
                purposes = [(name, self._purpose(command)) for name, command in sorted(self.commands.items())]
                formatter.write_dl(purposes)

    @staticmethod
    def _purpose(command: click.Command) -> str:
        return translate(f"help.command_{command.name}", requested_language())


class LocalizedGroup(LocalizedCommand, click.Group):
    """A group of commands with help in the requested language."""

    command_class = LocalizedCommand


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
