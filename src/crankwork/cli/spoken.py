"""The help of the commands, in the language that is asked for: what Click would say is said by texts."""

from __future__ import annotations

import os
import re
import sys

import click

from crankwork.locale import LANGUAGES, Language, has_text, say


def language_of_system() -> Language:
    """Return the language that the system is set to, if there are words in it; English otherwise."""
    stated = (os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG"))
    own = re.split(r"[_.@]", next((one for one in stated if one), ""))[0]
    return next((one for one in LANGUAGES if one == own), "en")


def language_asked() -> Language:
    """Return the language that the command line asks for, which may be what is wrong with it, or that of the system."""
    asked = re.findall(r"(?<=\0)--lang[\0=](\w+)(?=\0)", "\0".join(["", *sys.argv[1:], ""]))
    return next((one for one in LANGUAGES if one in asked[-1:]), language_of_system())


def placeholder(words: str) -> str:
    """Return what stands for values in a usage, `-o FILE`, in the language; what is typed as it stands is small."""

    def stand_in(found: re.Match[str]) -> str:
        return say(stand_in_key(found[0]), language_asked()).upper().replace(" ", "-")

    # formats of paper are no stand-ins
    return re.sub(r"[A-Z]+(?!\d)", stand_in, words)


def stand_in_key(word: str) -> str:
    """Return the key of the text for a stand-in."""
    return {"OPTIONS": "help.options", "VALUE": "columns.value"}.get(word, f"help.value_{word.lower()}")


def option_key(command: str, option: click.Parameter) -> str:
    """Return the key of the text that tells an option of a command: its own, or that of all commands."""
    name = option.opts[-1].lstrip("-").replace("-", "_")
    own = f"help.{command}_{name}"
    return own if has_text(own) else f"help.{name}"


class SpokenCommand(click.Command):
    """A command whose help is said in the language that is asked for."""

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write how the command is written."""
        words = placeholder(" ".join(self.collect_usage_pieces(ctx)))
        formatter.write_usage(ctx.command_path, words, prefix=f"{say('help.usage', language_asked())}: ")

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what the command is for."""
        self.help = self._purpose(self)
        super().format_help_text(ctx, formatter)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what each option does, and what each command of a group is for."""
        language = language_asked()
        told = [
            (placeholder(written[0]), say(option_key(str(self.name), one), language, default=one.default))
            for one in self.get_params(ctx)
            if isinstance(one, click.Option) and (written := one.get_help_record(ctx)) is not None
        ]
        with formatter.section(say("help.options", language)):
            formatter.write_dl(told)
        if isinstance(self, click.Group):
            with formatter.section(say("help.commands", language)):
                formatter.write_dl([(name, self._purpose(one)) for name, one in sorted(self.commands.items())])

    @staticmethod
    def _purpose(command: click.Command) -> str:
        return say(f"help.command_{command.name}", language_asked())


class SpokenGroup(SpokenCommand, click.Group):
    """A group of commands whose help is said in the language that is asked for."""

    command_class = SpokenCommand
