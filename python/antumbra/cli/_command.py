"""A verb for click: examples first, options in groups, settings from the one table."""

from __future__ import annotations

import shutil
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import click

from antumbra.settings import Setting, as_typed, table

GROUPS = ("Study", "Light", "Camera", "Sampling", "Looks", "Files", "Teaching", "Run")
_COLUMN = 25


class Option(click.Option):
    """An option that knows its group of the help and, if it stands for one, its setting; or says how a file is read."""

    def __init__(
        self,
        *names: str,
        group: str = "Run",
        setting: Setting | None = None,
        reading: bool = False,
        **rest: Any,
    ) -> None:
        """As click's, with the group."""
        super().__init__(list(names), **rest)
        self.group, self.setting, self.reading = group, setting, reading


class Verb(click.Command):
    """One verb. `examples`: (command, what it shows), three of them; `groups`: whose settings it takes."""

    def __init__(
        self,
        name: str,
        run: Callable[..., int],
        *,
        examples: Sequence[tuple[str, str]],
        arguments: Sequence[tuple[str, bool]],
        options: Iterable[Option] = (),
        groups: Iterable[str] = (),
        own_words: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        """`run` gets every argument and option by name, the settings given as one dict `settings`.

        What says how a file is read comes, where it was given, as one dict `reading`.

        `own_words`: of a setting with choices, those that make sense to this verb, its default first.
        """
        own = [click.Argument([place.lower()], metavar=place, required=needed) for place, needed in arguments]
        known = dict(table())
        for setting, words in (own_words or {}).items():
            known[setting] = known[setting]._replace(choices=list(words), default=words[0])
        settings = [_option_of(s) for s in known.values() if s.group in set(groups)]
        super().__init__(
            name,
            callback=run,
            params=[*own, *settings, *options, *_common()],
            help=run.__doc__,
            context_settings={"help_option_names": ["-h", "--help"]},
        )
        self.examples = examples
        self.has_settings = bool(settings)
        self.reads = any(isinstance(p, Option) and p.reading for p in self.params)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuses words that nothing takes."""
        ctx.allow_extra_args = True
        super().parse_args(ctx, args)
        if ctx.args:
            listed = " ".join(f'"{word}"' for word in ctx.args)
            wanted = " ".join(p.metavar or "" for p in self.params if isinstance(p, click.Argument))
            hint = "A name with spaces needs quotes around it."
            raise click.UsageError(f"{listed}: nothing takes this beside {wanted}\n{hint}", ctx)
        return ctx.args

    def invoke(self, ctx: click.Context) -> Any:
        """Gathers the settings that were given before the verb runs."""
        if self.has_settings:
            given = {}
            for param in self.params:
                if isinstance(param, Option) and param.setting:
                    value = ctx.params.pop(param.name or "")
                    if value is not None and value != ():
                        given[param.setting.name] = "\n".join(value) if param.multiple else value
            ctx.params["settings"] = given
        if self.reads:
            names = [p.name or "" for p in self.params if isinstance(p, Option) and p.reading]
            found = {name: ctx.params.pop(name) for name in names}
            ctx.params["reading"] = {name: value for name, value in found.items() if value is not None}
        return super().invoke(ctx)

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Usage, one sentence, examples, options in groups."""
        formatter.write(self.page(min(max(shutil.get_terminal_size((80, 24)).columns, 60), 100)))

    def places(self) -> str:
        """Its arguments, those that may be left out in brackets."""
        arguments = [p for p in self.params if isinstance(p, click.Argument)]
        return " ".join(f"{p.metavar}" if p.required else f"[{p.metavar}]" for p in arguments)

    def page(self, width: int) -> str:
        """The help at a width."""
        lines = [" ".join(f"Usage: antumbra {self.name} {self.places()} [OPTIONS]".split()), ""]
        lines += [
            *textwrap.wrap(_first_paragraph(self.help), width, initial_indent="  ", subsequent_indent="  "),
            "",
        ]
        column = max(len(command) for command, shows in self.examples if shows)
        lines += [f"  {command:<{column}}   {shows}".rstrip() for command, shows in self.examples]
        for group in GROUPS:
            options = [p for p in self.params if isinstance(p, Option) and p.group == group]
            if options:
                lines += ["", group, *(line for o in options for line in _option_lines(o, width))]
        if any(isinstance(p, Option) and p.setting for p in self.params):
            lines += ["", *textwrap.wrap(_TWICE, width, initial_indent="  ", subsequent_indent="  ")]
        return "\n".join(lines)


_TWICE = (
    "Of an option that is given twice, the last one counts, where it does not say that it may be repeated."
)


def output_option(metavar: str, text: str, default: str | None = None) -> Option:
    """`-o`: one file or folder, once; two would leave one out without a word."""

    def once(_: click.Context, __: click.Parameter, given: tuple[str, ...]) -> str | None:
        if len(given) > 1:
            raise click.UsageError(f"-o is given {len(given)} times ({', '.join(given)}): once is needed")
        return given[0] if given else default

    return Option(
        "-o", "--output", "output", group="Files", metavar=metavar, multiple=True, callback=once, help=text
    )


def _first_paragraph(text: str | None) -> str:
    return " ".join((text or "").strip().split("\n\n")[0].split())


def _option_of(setting: Setting) -> Option:
    return Option(
        setting.option,
        group=setting.group,
        setting=setting,
        metavar=setting.metavar,
        multiple=setting.repeats,
        help=_help_of(setting),
    )


def _help_of(setting: Setting) -> str:
    text = as_typed(setting.help)
    named = setting.metavar == "|".join(setting.choices) or all(f"{w}: " in text for w in setting.choices)
    if setting.choices and not named:
        listed = (f"{word} (default)" if word == setting.default else word for word in setting.choices)
        return f"{text}: {', '.join(listed)}"
    return f"{text} [{setting.default}]" if setting.default else text


def _option_lines(option: Option, width: int) -> list[str]:
    names = ", ".join([*sorted(option.opts, key=len)])
    head = f"  {names}" + ("" if option.is_flag or not option.metavar else f" {option.metavar}")
    text = textwrap.wrap(option.help or "", width - _COLUMN, break_on_hyphens=False)
    if len(head) > _COLUMN - 2:
        return [head, *(" " * _COLUMN + line for line in text)]
    return [head.ljust(_COLUMN) + text[0], *(" " * _COLUMN + line for line in text[1:])]


def _common() -> list[click.Parameter]:
    return [
        Option("--quiet", is_flag=True, help="only errors"),
        Option("--verbose", is_flag=True, help="the whole chain of an error"),
    ]
