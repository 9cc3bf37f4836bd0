"""Options of the commands: those of settings are derived from the table, and shown in its groups."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

from ..core.names import Names
from ..errors import InputError, ParameterError, Place, unknown
from ..settings import Settings
from ..settings.declare import Group, Row, Stage, ValueKind, rows
from .messages import JSON, QUIET

F = TypeVar("F", bound=Callable[..., Any])
SHOWN = (Stage.FRAMES, Stage.HEAD, Stage.SHAPE, Stage.SKIN, Stage.APPEARANCE, Stage.PICTURE, Stage.OUTPUT)
"""Stages after all movements are combined."""


class Command(click.Command):
    """A command that says how it goes in the form that is wanted; help has options in their groups.

    Without arguments, a command that takes some prints its help.
    """

    def __init__(self, *arguments: Any, **about: Any) -> None:
        takes_some = any(isinstance(p, click.Argument) for p in about.get("params") or ())
        super().__init__(*arguments, **{"no_args_is_help": takes_some, **about})

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments; raise InputError for one too many, as of a text without quotation marks."""
        ctx.allow_extra_args = True
        rest = super().parse_args(ctx, args)
        if rest and not ctx.resilient_parsing:
            takes_some = any(isinstance(p, click.Argument) for p in self.params)
            expected = "quotation marks around a text with blanks" if takes_some else "options alone"
            raise InputError(f"'{rest[0]}' is one argument too many; expected {expected}")
        return rest

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return the parameters; those of messages, which `messages` reads, stand before `--help`."""
        *own, last = super().get_params(ctx)
        return [*own, *_MESSAGES, last]

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, group by group in the order in which the groups come first."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is not None and isinstance(parameter, click.Option):
                groups.setdefault(getattr(parameter, "group", "Options"), []).append(record)
        for title, records in groups.items():
            with formatter.section(title):
                formatter.write_dl(records)


class CommandGroup(click.Group):
    """Commands under one name; a name that no command has is answered as every unknown name is."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the name of the command, the command and its arguments; fail for an unknown command."""
        if args and not args[0].startswith("-") and self.get_command(ctx, args[0]) is None:
            ctx.fail(unknown("command", args[0], self.commands))
        return super().resolve_command(ctx, args)


class Option(click.Option):
    """An option that stands under a heading in help."""

    def __init__(self, *arguments: Any, group: str = "Options", **about: Any) -> None:
        super().__init__(*arguments, **about)
        self.group = group


_MESSAGES = (
    Option(["-q", QUIET], is_flag=True, expose_value=False, help="Print only warnings and errors."),
    Option([JSON], is_flag=True, expose_value=False, help="Print messages as JSON, one object per line."),
)


class KnownName(click.Choice[str]):
    """One of some names; an unknown one is told the nearest."""

    def __init__(self, kind: str, names: Sequence[str]) -> None:
        super().__init__(names)
        self._kind = kind

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name; raise ParameterError for one that is not known."""
        if value not in self.choices:
            raise ParameterError(unknown(self._kind, str(value), self.choices))
        return super().convert(value, param, ctx)


class NumberIn(click.ParamType[float]):
    """A number from `low` to `high`, read by `kind`, int or float."""

    name = "number"

    def __init__(self, low: float, high: float = math.inf, *, kind: type[int] | type[float] = int) -> None:
        self._low, self._high, self._kind = low, high, kind
        self._expected = f"expected {low:g} or more" if high == math.inf else f"expected {low:g} to {high:g}"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number; raise ParameterError if the text is not a number or is out of range."""
        flag = "" if param is None else f"{param.opts[0]} "
        try:
            number = self._kind(value)
        except ValueError:
            kind = "a whole number" if self._kind is int else "a number"
            raise ParameterError(f"{flag}'{value}' is not {kind}; {self._expected}") from None
        if not self._low <= number <= self._high:
            raise ParameterError(f"{flag}{value} is out of range; {self._expected}")
        return number


class Named(click.ParamType[str]):
    """A text that begins with a name: the names complete it, several if commas separate them."""

    def __init__(self, names: Names, *, after: str = "", separator: str = "") -> None:
        self.name, self._names, self._after, self._separator = "text", names, after, separator

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Return the names that begin with the text so far."""
        before, comma, begun = "", "", incomplete
        if self._separator:
            before, comma, begun = incomplete.rpartition(self._separator)
        return [
            CompletionItem(f"{before}{comma}{choice.name}{self._after}", help=choice.description or None)
            for choice in self._names.choices()
            if choice.name.startswith(begun)
        ]


def option(*names: str, group: str, **about: Any) -> Callable[[F], F]:
    """Return the decorator of an option that is not a setting."""
    return click.option(*names, cls=Option, group=group, **about)


def setting_options(
    stages: Collection[Stage] = (),
    names: Collection[str] = (),
    *,
    defaults: Mapping[Stage, str] = MappingProxyType({}),
    words: Mapping[str, str] = MappingProxyType({}),
) -> Callable[[F], F]:
    """Return a decorator that gives a command the options of the settings that `stages` read, and `names`.

    `defaults`: in words, where settings of a stage come from that are not chosen, if not from their defaults;
    help adds what they are if they are not there either.
    `words`: the help of settings that mean less to the command than to others.
    """

    def decorate(command: F) -> F:
        # Options are listed in the reverse order of their decorators.
        for row in [row for group in Group for row in _rows_in(group)][::-1]:
            if row.flag is not None and (row.entry.stage in stages or row.name in names):
                said = words.get(row.name, row.entry.help)
                command = _option(row, said, defaults.get(row.entry.stage))(command)
        return config_option(preset_option(command)) if stages else command

    return decorate


def _rows_in(group: Group) -> list[Row]:
    return [row for row in rows(Settings).values() if row.entry.group is group]


def settings_from(chosen: Mapping[str, Any]) -> Settings:
    """Return the settings that a command's options chose; raise RisoriusError for an invalid value."""
    from ..settings.presets import load_settings

    table, kept = rows(Settings), {**chosen}
    for name in kept.get("configs", ()):
        if not name.endswith(".toml"):
            raise InputError("is not a .toml file; expected one for --config", Place(name))
    names = (*kept.pop("presets", ()), *kept.pop("configs", ()))
    values = {name: _value(table[name], value) for name, value in kept.items() if _is_given(value)}
    return load_settings(*names, **values)


def _is_given(value: Any) -> bool:
    return value is not None and value is not False and value != ()


def flag(name: str) -> str:
    """Return the option that gives a setting, or another argument of the library's functions."""
    row = rows(Settings).get(name)
    return (row.flag if row is not None else None) or f"--{name.replace('_', '-')}"


def _option(row: Row, said: str, default: str | None) -> Callable[[F], F]:
    about: dict[str, Any] = {"metavar": row.entry.metavar, "type": _type(row)}
    shown = "" if row.is_flag else _shown_default(row, default)
    if row.is_flag:
        about = {"is_flag": True}
    elif row.several:
        about["multiple"] = True
    words = f"{said}  [default: {shown}]" if shown else said
    return option(row.flag or "", row.name, group=str(row.entry.group), help=words, **about)


def _shown_default(row: Row, source: str | None) -> str:
    """Return what a setting has that is not chosen, in words."""
    if source is None:
        return row.text(row.usual)
    return f"{source}, or {row.entry.scored}" if row.entry.scored else source


def _type(row: Row) -> Any:
    if row.kind is ValueKind.SWITCH:
        return KnownName(row.called, ["on", "off"])
    if row.kind is ValueKind.FILE:
        return click.Path(path_type=Path, dir_okay=True)
    if row.entry.names is not None:
        separator = "," if row.kind is ValueKind.SEVERAL and not row.several else ""
        return Named(row.entry.names, after=":" if row.kind is ValueKind.AMOUNTS else "", separator=separator)
    return str  # numbers, too: settings read them, and say what was expected


def _value(row: Row, given: Any) -> Any:
    if row.kind is ValueKind.SWITCH:
        return not row.usual if row.is_flag else given == "on"
    if row.kind is ValueKind.AMOUNTS:
        return dict(row.read(text) for text in given)
    return given


preset_option = option(
    "--preset",
    "presets",
    group="Settings",
    multiple=True,
    metavar="NAME",
    type=Named(Names(path="settings.presets:presets")),
    help="Settings that go together ('risorius list presets'). Options override them. May be given several "
    "times.",
)
config_option = option(
    "--config",
    "configs",
    group="Settings",
    multiple=True,
    metavar="FILE",
    help="A .toml file with your settings, such as fps = 60. It overrides presets; options override it. "
    "May be given several times.",
)
output_option = option(
    "-o",
    "--output",
    "outputs",
    group="Output",
    multiple=True,
    type=click.Path(path_type=Path, dir_okay=True),
    help="File to write. Its suffix chooses the format ('risorius list outputs'); -.SUFFIX writes to "
    "standard output. May be given several times.",
)
rules_option = setting_options(names=("rules",))
LINKS_ALONE = {"rules": "A file of rules that changes links between muscles alone: [[entry]] links.*"}
emotion_option = option(
    "--emotion",
    "emotions",
    group="Input",
    multiple=True,
    metavar="NAME:INTENSITY[@START[-END]][/PRIORITY]",
    type=Named(Names(path="rules.emotions:emotions"), after=":"),
    help="Show an emotion, 0 to 1: happiness:0.7, or anger:1@0.5-2 from 0.5 to 2 s. A priority above 60, "
    "that of the lips, lets it win over speech. May be given several times.",
)


def check_outputs(
    outputs: Collection[Path],
    settings: Settings | None = None,
    available: Collection[str] | None = None,
    read_by: Mapping[str, Stage] = MappingProxyType({}),
) -> None:
    """Raise RisoriusError for outputs that cannot be made of the `available` stages, and for settings that
    change none of them; `read_by` as `reject_unwritten` has it.
    """
    from ..ports.formats import Need
    from ..ports.output_files import check_targets
    from ..unused_settings import reject_unwritten

    alpha = settings is not None and settings.look.transparent
    targets = check_targets(outputs, tuple(Need) if available is None else available, alpha=alpha)
    if settings is not None:
        reject_unwritten(settings, [target.format for target in targets], read_by)
