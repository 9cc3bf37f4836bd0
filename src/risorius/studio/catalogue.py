"""Every table that the page needs, from the library's own: the page holds no second copy."""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import cache
from typing import get_args

import numpy as np

from .. import __version__
from ..core.action_units import ACTION_UNITS, ActionUnit, resolve_targets
from ..core.channels import CHANNELS
from ..core.functions import ONSET_FUNCTIONS
from ..core.parameters import ALIASES, PARAMETERS, RIVALS, Parameter
from ..face.head.head import load_head, shipped_heads
from ..ports.formats import FORMATS, FileFormat
from ..rules.emotions import Emotion, emotions
from ..rules.profiles import Profile, attitudes, profile_texts, profiles
from ..rules.rule import Rule
from ..rules.rule_set import shipped
from ..rules.tuned import numbers_of
from ..settings.declare import Row, ValueKind
from ..speech.engines.voices import voices
from . import limits
from .wire import tables
from .wire.choices import EXPORTED, LARGEST_WHOLE, chosen_rows, exported_rows, on_wire
from .wire.messages import encoded
from .wire.shared import Choices, Format

ONSET_STEPS = 25
MOST_STEPS = 100


def catalogue() -> tables.Catalogue:
    """Return all tables."""
    return tables.Catalogue(
        version=__version__,
        parameters=tuple(map(_parameter, PARAMETERS)),
        aliases=dict(ALIASES),
        action_units=tuple(map(_unit, ACTION_UNITS.values())),
        emotions=tuple(map(_emotion, emotions().values())),
        profiles=tuple(_profile(p) for p in profiles().values()),
        attitudes=tuple(tables.AttitudeRow(a.name, a.description, a.source) for a in attitudes().values()),
        voices=tuple(tables.VoiceRow(v.name, v.language, v.description) for v in voices()),
        heads=tuple(map(_head, shipped_heads())),
        channels=tuple(tables.ChannelRow(name, CHANNELS.get(name).priority) for name in CHANNELS),
        onset_functions=tuple(map(_sampled, ONSET_FUNCTIONS)),
        settings=tuple(map(_setting, (*chosen_rows(), *exported_rows()))),
        formats=get_args(Format),
        rules=tuple(map(_rule, shipped())),
        outputs=tuple(_output(FORMATS.get(suffix)) for suffix in FORMATS),
        choices=Choices(),
        limits=limits.described(),
    )


@cache
def catalogue_json() -> bytes:
    """Return the catalogue as it is sent."""
    return json.dumps(encoded(catalogue()), ensure_ascii=False, separators=(",", ":")).encode()


def _parameter(p: Parameter) -> tables.ParameterRow:
    fields = {**asdict(p), "kind": str(p.kind)}
    return tables.ParameterRow(**fields, signed=p.signed, rivals=RIVALS[p.name])


def _unit(unit: ActionUnit) -> tables.UnitRow:
    name = f"AU{unit.number}"
    return tables.UnitRow(name, unit.number, unit.name, unit.approximate, resolve_targets({name: 1.0}))


def _emotion(e: Emotion) -> tables.EmotionRow:
    return tables.EmotionRow(
        e.name, e.aliases, e.description, dict(e.units), e.targets(1.0), e.onset, e.offset
    )


def _profile(p: Profile) -> tables.ProfileRow:
    numbers = {n.key: tables.NumberRow(n.key, n.value, n.low, n.high) for n in numbers_of(p)}
    return tables.ProfileRow(p.name, p.description, p.source, numbers, profile_texts()[p.name])


def _head(name: str) -> tables.HeadRow:
    who = load_head(name).identity
    return tables.HeadRow(name, who.title, who.age, who.looks.hair_style)


def _rule(rule: Rule) -> tables.RuleRow:
    conditions = tuple(rule.when.asked())
    return tables.RuleRow(rule.id, rule.channel, str(rule.level), rule.probability, rule.comment, conditions)


def _output(output: FileFormat) -> tables.OutputRow:
    return tables.OutputRow(output.suffix, output.description, tuple(sorted(map(str, output.needs))))


def _setting(row: Row) -> tables.SettingRow:
    entry = row.entry
    choices = () if entry.names is None else entry.names.choices()
    return tables.SettingRow(
        key=row.name,
        label=entry.label,
        group=str(entry.group),
        control=_control(row),
        exported=entry.stage in EXPORTED,
        help=entry.help,
        low=entry.low,
        high=None if entry.high is None else min(entry.high, LARGEST_WHOLE),
        step=entry.step,
        optional=row.optional and row.usual is None,
        unset=entry.unset,
        default=on_wire(row, row.usual),
        choices=tuple(
            tables.ChoiceRow(c.name, c.description, c.name if row.kind is not ValueKind.NUMBER else c.number)
            for c in choices
        ),
    )


def _control(row: Row) -> str:
    """Return the control of a setting: a slider only if it has few steps."""
    entry = row.entry
    if row.kind is ValueKind.SWITCH:
        return "check"
    if row.kind is ValueKind.SEVERAL:
        return "several"
    if entry.names is not None:
        return "choice"
    if row.kind not in (ValueKind.NUMBER, ValueKind.WHOLE):
        return "text"
    few = entry.step is not None and entry.high is not None and entry.high / entry.step <= MOST_STEPS
    return "slider" if few and not row.optional else "number"


def _sampled(name: str) -> tables.OnsetRow:
    """Return an onset function's row with its values, to be drawn."""
    function = ONSET_FUNCTIONS.get(name)
    line = (function.__doc__ or "").strip().split("\n")[0]
    values = function(np.linspace(0.0, 1.0, ONSET_STEPS))
    return tables.OnsetRow(name, line, tuple(values.round(4).tolist()))
