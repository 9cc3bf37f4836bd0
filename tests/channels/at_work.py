"""Movements that rules and habits make of a marked text."""

import json
from collections.abc import Callable, Sequence

from risorius.channels import ChannelInputs, compose
from risorius.core.movement import Movement
from risorius.core.utterance import Utterance
from risorius.rules.rule_set import extended, shipped

Maker = Callable[..., Utterance]
LID = "orbicularis_oculi_palpebralis.left"
SAID = "Well[H*], what about Julia[H*]? She likes popcorn[L+H*]. I am sure[H*], very sure[H*]!"
LONG = " ".join([SAID] * 12)
# Its first sentence is as long as one that is begun with a look away.
THOUGHT_OUT = f"I never know what one says[H*] to people who do not like popcorn[L+H*]. {LONG}"


def certain(prefix: str) -> str:
    """Return a file that makes our rules under a prefix fire wherever they can."""
    texts = [e.text for e in shipped().entries.values() if e.rule.id.startswith(prefix)]
    lines = [line for text in texts for line in text.splitlines() if not line.startswith("probability")]
    return "\n".join(lines)


def movements(said: Utterance, *prefixes: str, seed: int = 0, **inputs: object) -> tuple[Movement, ...]:
    """Return what is composed with only our rules under the prefixes, which fire wherever they can."""
    others = [r.id for r in shipped() if not r.id.startswith(prefixes)]
    text = f"delete = {json.dumps(others)}\n" + "\n".join(certain(p) for p in prefixes)
    rule_set = extended(shipped(), text, "my.toml")
    return compose(ChannelInputs(said.duration, said, rules=rule_set, **inputs), seed=seed).movements  # type: ignore[arg-type]


def by_rule(found: Sequence[Movement], rule: str) -> list[Movement]:
    return [m for m in found if m.cause.rule == rule]
