"""Every table that the page needs, from the library's own: the page holds no second copy."""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import cache
from typing import Any, get_args

import numpy as np

from .. import __version__
from ..blend.coarticulation import LIP_MODELS
from ..blend.conflict import POLICIES
from ..core.action_units import ACTION_UNITS, ActionUnit, resolve_targets
from ..core.functions import ONSET_FUNCTIONS
from ..core.look import COMPLEXIONS, FRAMINGS, HAIR_STYLES, LIGHTS, OVERLAYS, QUALITIES, STYLES
from ..core.movement import CHANNEL_PRIORITY
from ..core.parameters import ALIASES, PARAMETERS, RIVALS, Parameter
from ..face.head import load_head, shipped_heads
from ..ports.formats import FORMATS, FileFormat
from ..registry import Registry
from ..rules.book import shipped
from ..rules.emotions import Emotion, emotions
from ..rules.lips import lip_table
from ..rules.profiles import Profile, attitudes, profile_texts, profiles
from ..rules.rule import Rule
from ..rules.tuned import numbers_of
from ..settings import DYNAMICS, Settings
from ..speech.engines.voices import voices
from . import limits, tables
from .messages import encoded
from .wire import Choices, Format

ONSET_STEPS = 25


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
        languages=tuple(sorted({v.language for v in voices() if not v.name.startswith("+")})),
        heads=tuple(map(_head, shipped_heads())),
        channels=tuple(tables.ChannelRow(name, rank) for name, rank in CHANNEL_PRIORITY.items()),
        policies=_documented(POLICIES),
        lip_models=_documented(LIP_MODELS),
        onset_functions=tuple(map(_sampled, _documented(ONSET_FUNCTIONS))),
        manners=tuple(lip_table().manners),
        dynamics=DYNAMICS,
        formats=get_args(Format),
        rules=tuple(map(_rule, shipped())),
        outputs=tuple(_output(FORMATS.get(suffix)) for suffix in FORMATS),
        looks=_looks(),
        choices=Choices(),
        size="{}x{}".format(*Settings().size),
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
    asked = tuple(rule.when.asked())
    return tables.RuleRow(rule.id, rule.channel, str(rule.level), rule.probability, rule.comment, asked)


def _output(output: FileFormat) -> tables.OutputRow:
    return tables.OutputRow(output.suffix, output.description, tuple(sorted(map(str, output.needs))))


def _looks() -> tables.LooksTable:
    return tables.LooksTable(
        styles=STYLES,
        cameras=FRAMINGS,
        lights=LIGHTS,
        qualities=tuple(QUALITIES),
        hair=HAIR_STYLES,
        complexions=dict(COMPLEXIONS),
        overlays=OVERLAYS,
    )


def _documented(registry: Registry[Any]) -> tuple[tables.OptionRow, ...]:
    """Return the names of a registry with the first line on what stands behind each."""
    lines = ((name, (registry.get(name).__doc__ or "").strip().split("\n")[0]) for name in registry)
    return tuple(tables.OptionRow(name, line) for name, line in lines)


def _sampled(row: tables.OptionRow) -> tables.OnsetRow:
    """Return an onset function's row with its values, to be drawn."""
    values = ONSET_FUNCTIONS.get(row.name)(np.linspace(0.0, 1.0, ONSET_STEPS))
    return tables.OnsetRow(row.name, row.description, tuple(values.round(4).tolist()))
