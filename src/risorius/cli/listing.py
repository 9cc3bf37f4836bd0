"""`risorius list` and its tables."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..errors import ParameterError, unknown
from .messages import print_table
from .options import Command, KnownName

if TYPE_CHECKING:
    from ..languages import Language

Listing = tuple[Sequence[str], list[Sequence[str]]]


def muscles() -> Listing:
    """The muscles of paper A, Table 1, and the other parameters."""
    from ..core.action_units import ACTION_UNITS
    from ..core.parameters import BASES, CONFLICTING_NUMBERS

    rows: list[Sequence[str]] = []
    for base, sides in BASES.items():
        number = sides[0].number
        units = [f"AU{u.number}" for u in ACTION_UNITS.values() if base in u.weights and not u.approximate]
        rivals = sorted({b if a == number else a for a, b in CONFLICTING_NUMBERS if number in (a, b)})
        p = sides[0]
        rows.append(
            (
                f"{number:02}" if number else "",
                base,
                "left, right" if p.side else "",
                f"{p.low:g} to {p.high:g}{f' {p.unit}' if p.unit else ''}",
                " ".join(units),
                " ".join(f"{r:02}" for r in rivals),
            )
        )
    return ("no", "name", "sides", "range", "action units", "conflicts with"), rows


def channels() -> Listing:
    """The channels with their priorities."""
    from ..core.channels import CHANNELS

    return ("channel", "priority"), [(name, f"{CHANNELS.get(name).priority:g}") for name in CHANNELS]


def emotions() -> Listing:
    """The emotions, their other names, and their action units."""
    from ..rules.emotions import emotions as all_emotions

    return ("emotion", "also", "action units"), [
        (e.name, ", ".join(e.aliases), " ".join(f"{unit}={value:g}" for unit, value in e.units.items()))
        for e in all_emotions().values()
    ]


def voices() -> Listing:
    """The voices that come with Risorius, the default first."""
    from ..speech.engines.voices import voices as all_voices

    return ("voice", "language", "name"), [
        (v.name, v.language or "any", v.description if v.language else f"a timbre: en-us{v.name}")
        for v in all_voices()
    ]


def languages() -> Listing:
    """The languages, with the data that each has beside its sounds."""
    from ..languages import language_of
    from ..languages import languages as all_languages
    from ..languages.load import has_readings
    from ..speech.engines.voices import speaking

    names: dict[str, list[str]] = {code: [] for code in all_languages() if code != "und"}
    for voice in speaking().values():
        names.setdefault(voice.language.split("-")[0], []).append(voice.description)
    rows: list[Sequence[str]] = []
    for code, voices in sorted(names.items()):
        known = language_of(code)
        own = known.code == code
        tables = (known.function_words, known.abbreviations.titles, _tells_questions(known))
        told = (*tables, has_readings(code), known.tested)
        name = known.name if own else voices[0]
        rows.append((code, name, str(len(voices)), *("yes" if own and it else "" for it in told)))
    columns = ("function words", "abbreviations", "questions", "numbers and dates", "tested")
    return ("language", "name", "voices", *columns), rows


def _tells_questions(language: Language) -> bool:
    table = language.questions
    return bool(table.wh or table.anywhere or table.last)


def outputs() -> Listing:
    """The files that can be written, by suffix."""
    from ..ports.formats import FORMATS

    return ("suffix", "content"), [(suffix, FORMATS.get(suffix).description) for suffix in FORMATS]


def heads() -> Listing:
    """The heads that come with Risorius."""
    from ..face.head.head import load_head, shipped_heads

    identities = {name: load_head(name).identity for name in shipped_heads()}
    return ("head", "age", "who"), [(name, f"{who.age:g}", who.title) for name, who in identities.items()]


def sliders() -> Listing:
    """The sliders of a head's shape (--shape NAME:VALUE)."""
    import numpy as np

    from ..face.head.sliders import load_sliders

    table = load_sliders()
    most = np.linalg.norm(table.skin, axis=-1).max(axis=-1)
    rows: list[Sequence[str]] = [
        (name, f"{down:.1f}", f"{up:.1f}")
        for name, (up, down) in zip(table.names, most.tolist(), strict=True)
    ]
    return ("slider", "mm at -1", "mm at 1"), rows


def profiles() -> Listing:
    """The profiles of speakers (--profile NAME)."""
    from ..rules.profiles import profiles as all_profiles

    return ("profile", "description"), [(p.name, p.description) for p in all_profiles().values()]


def attitudes() -> Listing:
    """The attitudes that change a profile (--attitude NAME)."""
    from ..rules.profiles import attitudes as all_attitudes

    return ("attitude", "description"), [(a.name, a.description) for a in all_attitudes().values()]


def presets() -> Listing:
    """The presets: settings that go together (--preset NAME)."""
    from ..settings.presets import presets as all_presets

    return ("preset", "description"), list(all_presets().items())


def rule_rows(file: Path | None, prefix: str | None) -> Listing:
    """The rules that hold, or those whose id is `prefix` or begins with it; ParameterError if none does."""
    from ..rules.modulation import is_under
    from ..rules.rule_set import rule_set_of

    rule_set = rule_set_of(file)
    chosen = [rule for rule in rule_set if prefix is None or is_under(rule.id, prefix)]
    if not chosen:
        raise ParameterError(unknown("rule", str(prefix), rule_set.entries))
    rows = [(r.id, str(r.level), f"{r.probability:g}", ", ".join(r.when.asked()), r.comment) for r in chosen]
    return ("rule", "level", "probability", "conditions", "comment"), list(rows)


def rule_lines(name: str, file: Path | None) -> list[str]:
    """A rule as it stands in its file, after the place."""
    from ..rules.rule_set import rule_set_of

    entry = rule_set_of(file).get(name)
    return [f"# {entry.place}", *entry.text.splitlines()]


LISTINGS: dict[str, Callable[[], Listing]] = {
    "muscles": muscles,
    "channels": channels,
    "emotions": emotions,
    "voices": voices,
    "languages": languages,
    "outputs": outputs,
    "heads": heads,
    "sliders": sliders,
    "profiles": profiles,
    "attitudes": attitudes,
    "presets": presets,
}


def _help() -> str:
    """Return the help of `list`: the content of each list."""
    width = max(map(len, LISTINGS))
    lines = [f"{name:{width}}  {inspect.getdoc(rows)}" for name, rows in LISTINGS.items()]
    return "\n".join(["List the names that can be used.", "", "\b", *lines])


@click.command(
    name="list",
    cls=Command,
    help=_help(),
    short_help="List names: voices, languages, heads, emotions …",
)
@click.argument("what", metavar="WHAT", type=KnownName("list", list(LISTINGS)))
def list_(what: str) -> None:
    """Print one of the lists."""
    header, rows = LISTINGS[what]()
    print_table(header, rows)
