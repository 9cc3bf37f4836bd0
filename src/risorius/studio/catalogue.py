"""Every table that the page needs, from the library's own: the page holds no second copy."""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import cache
from typing import Any

import numpy as np

from .. import __version__
from ..blend.coarticulation import LIP_MODELS
from ..blend.conflict import POLICIES
from ..core.action_units import ACTION_UNITS, resolve_targets
from ..core.functions import ONSET_FUNCTIONS
from ..core.look import COMPLEXIONS, FRAMINGS, HAIR_STYLES, LIGHTS, OVERLAYS, QUALITIES, STYLES
from ..core.movement import CHANNEL_PRIORITY
from ..core.parameters import ALIASES, PARAMETERS, RIVALS
from ..face.head import load_head, shipped_heads
from ..out import OUTPUTS
from ..rules.book import shipped
from ..rules.emotions import emotions
from ..rules.lips import lip_table
from ..rules.profiles import attitudes, profile_texts, profiles
from ..rules.tuned import numbers_of
from ..settings import DYNAMICS, Settings
from ..speech.voices import voices
from . import limits
from .messages import encoded
from .wire import Choices, Format

ONSET_STEPS = 25


@cache
def catalogue() -> dict[str, Any]:
    """Return all tables as JSON can hold them; `web/wire.js` describes them as Catalogue."""
    return {
        "version": __version__,
        "parameters": [_parameter(p) for p in PARAMETERS],
        "aliases": dict(ALIASES),
        "action_units": [_unit(u) for u in ACTION_UNITS.values()],
        "emotions": [_emotion(e) for e in emotions().values()],
        "profiles": [_profile(name) for name in profiles()],
        "attitudes": [_named(a) for a in attitudes().values()],
        "voices": [{"name": v.name, "language": v.language, "title": v.description} for v in voices()],
        "languages": sorted({v.language for v in voices() if not v.name.startswith("+")}),
        "heads": [_head(name) for name in shipped_heads()],
        "channels": [{"name": n, "priority": p} for n, p in CHANNEL_PRIORITY.items()],
        "policies": _documented(POLICIES),
        "lip_models": _documented(LIP_MODELS),
        "onset_functions": [_sampled(row) for row in _documented(ONSET_FUNCTIONS)],
        "manners": list(lip_table().manners),
        "dynamics": list(DYNAMICS),
        "formats": list(Format.__args__),  # type: ignore[attr-defined]
        "rules": [_rule(rule) for rule in shipped()],
        "outputs": [_output(OUTPUTS.get(suffix)) for suffix in OUTPUTS],
        "looks": {
            "styles": list(STYLES),
            "cameras": list(FRAMINGS),
            "lights": list(LIGHTS),
            "qualities": list(QUALITIES),
            "hair": list(HAIR_STYLES),
            "complexions": dict(COMPLEXIONS),
            "overlays": list(OVERLAYS),
        },
        "choices": encoded(Choices()),
        "size": "{}x{}".format(*Settings().size),
        "limits": limits.described(),
    }


@cache
def catalogue_json() -> bytes:
    """Return the catalogue as it is sent."""
    return json.dumps(catalogue(), ensure_ascii=False, separators=(",", ":")).encode()


def _parameter(p: Any) -> dict[str, Any]:
    row = asdict(p)
    row["kind"] = str(p.kind)
    return {**row, "signed": p.signed, "rivals": list(RIVALS[p.name])}


def _unit(unit: Any) -> dict[str, Any]:
    return {
        "name": f"AU{unit.number}",
        "number": unit.number,
        "title": unit.name,
        "approximate": unit.approximate,
        "targets": resolve_targets({f"AU{unit.number}": 1.0}),
    }


def _emotion(emotion: Any) -> dict[str, Any]:
    return {
        "name": emotion.name,
        "aliases": list(emotion.aliases),
        "description": emotion.description,
        "units": dict(emotion.units),
        "targets": emotion.targets(1.0),
        "onset": emotion.onset,
        "offset": emotion.offset,
    }


def _profile(name: str) -> dict[str, Any]:
    profile = profiles()[name]
    numbers = {f.key: asdict(f) for f in numbers_of(profile)}
    return {**_named(profile), "numbers": numbers, "text": profile_texts()[name]}


def _named(item: Any) -> dict[str, Any]:
    return {"name": item.name, "description": item.description, "source": item.source}


def _head(name: str) -> dict[str, Any]:
    who = load_head(name).identity
    return {"name": name, "title": who.title, "age": who.age, "hair": who.looks.hair_style}


def _rule(rule: Any) -> dict[str, Any]:
    return {
        "id": rule.id,
        "channel": rule.channel,
        "level": str(rule.level),
        "probability": rule.probability,
        "comment": rule.comment,
        "conditions": list(rule.when.asked()),
    }


def _output(output: Any) -> dict[str, Any]:
    needs = sorted(str(need) for need in output.needs)
    return {"suffix": output.suffix, "description": output.description, "needs": needs}


def _documented(registry: Any) -> list[dict[str, str]]:
    """Return the names of a registry with the first sentence of what stands behind each."""
    return [{"name": name, "description": _first_line(registry.get(name))} for name in registry]


def _sampled(row: dict[str, str]) -> dict[str, Any]:
    """Return an onset function's row with its values at even steps from 0 to 1, to be drawn."""
    steps = np.linspace(0.0, 1.0, ONSET_STEPS)
    return {**row, "samples": ONSET_FUNCTIONS.get(row["name"])(steps).round(4).tolist()}


def _first_line(thing: Any) -> str:
    return (thing.__doc__ or "").strip().split("\n")[0]
