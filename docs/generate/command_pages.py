"""The reference of the command line: every command with its arguments and options, from click."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path

import click

from crankwork.cli import commands
from crankwork.cli.options import option_key
from crankwork.locale import LANGUAGES, Language, translate
from html_text import code, entry, raw, sentence, text
from key_pages import WORDS


def examples(command: str = "") -> list[str]:
    """Return the lines that show commands at work, in the order in which they can be carried out."""
    lines = (Path(__file__).parent / "command_examples.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line.startswith(f"crankwork {command}")]


def options_of(line: str) -> set[str]:
    """Return the options that a line of a command has, by their longest names."""
    _, name, *words = shlex.split(line)
    command = commands.commands[name]
    *_, given = command.make_parser(click.Context(command)).parse_args(words)
    return {parameter.opts[-1] for parameter in given if isinstance(parameter, click.Option)}


def options(command: click.Command) -> Iterator[click.Option]:
    """Yield the options of a command, `--help` among them."""
    for parameter in command.get_params(click.Context(command)):
        if isinstance(parameter, click.Option):
            yield parameter


def option_text(command: str, option: click.Option, language: Language) -> str:
    """Return what an option does."""
    default = option.default() if callable(option.default) else option.default
    return translate(option_key(command, option), language, default=default)


def _usage(command: click.Command) -> str:
    context = click.Context(command, info_name=f"crankwork {command.name}")
    return " ".join([context.command_path, *command.collect_usage_pieces(context)])


def _option_entry(command: str, option: click.Option, language: Language) -> str:
    words = WORDS[language]
    name = ", ".join(option.opts) + (f" {option.make_metavar(click.Context(commands))}" if not option.is_flag else "")
    shown = option.default if isinstance(option.default, str | int) and not isinstance(option.default, bool) else ""
    choices = option.type.choices if isinstance(option.type, click.Choice) else ()
    example = next((line for line in examples(command) if option.opts[-1] in options_of(line)), "")
    facts = [
        (words["option_values"], ", ".join(map(code, choices))),
        (words["default"], code(shown) if shown != "" else ""),
        (words["example"], code(example) if example else ""),
    ]
    said = text(sentence(option_text(command, option, language)))
    return entry(f"{command}{option.opts[-1]}", name, said, facts, words["required"] if option.required else "")


def page(language: Language) -> str:
    """Return the page of a language."""
    words = WORDS[language]
    parts = [f"# {words['commands_title']}\n\n{words['commands_intro']}\n"]
    for name, command in sorted(commands.commands.items()):
        parts.append(f"## `crankwork {name}`\n\n{translate(f'help.command_{name}', language)}\n")
        entries = (_option_entry(name, option, language) for option in options(command))
        parts.append(raw([f"<p>{words['usage']}: {code(_usage(command))}</p>"]))
        parts.append("```sh\n" + "\n".join(examples(name)) + "\n```\n")
        parts.append(raw(entries))
    return "\n".join(parts)


def without_sentence() -> list[str]:
    """Return the commands and options that some language says nothing of."""
    said = {
        f"{language}: {name} {option.opts[-1]}": option_text(name, option, language)
        for language in LANGUAGES
        for name, command in commands.commands.items()
        for option in options(command)
    } | {
        f"{language}: {name}": translate(f"help.command_{name}", language)
        for language in LANGUAGES
        for name in commands.commands
    }
    return [place for place, words in said.items() if len(words.split()) < 2]
