"""Movements that rules and habits make of a marked text."""

import json
from collections.abc import Callable, Sequence

from risorius.channels import ChannelInputs, compose
from risorius.core.movement import Movement
from risorius.core.speech.utterance import PauseKind, Utterance
from risorius.rules.rule_set import extended, shipped

Maker = Callable[..., Utterance]
LID = "orbicularis_oculi_palpebralis.left"
INNER, FROWN = "frontalis_medialis.left", "corrugator_supercilii.left"
SAID = "Well[H*], what about Julia[H*]? She likes popcorn[L+H*]. I am sure[H*], very sure[H*]!"
LONG = " ".join([SAID] * 12)
# Its first sentence is as long as one that is begun with a look away.
THOUGHT_OUT = f"I never know what one says[H*] to people who do not like popcorn[L+H*]. {LONG}"
PUNCTUATED = [
    ("One two. Three.", PauseKind.FULL_STOP, "punctuators.brows.full_stop", FROWN),
    ("Is it one? Three.", PauseKind.QUESTION, "punctuators.brows.question", INNER),
    ("You won? Three.", PauseKind.QUESTION, "punctuators.brows.unmarked", INNER),
    ("One! Three.", PauseKind.EXCLAMATION, "punctuators.brows.exclamation", INNER),
    ("One, three.", PauseKind.COMMA, "punctuators.brows.comma", INNER),
    ("Um… three.", PauseKind.HESITATION, "punctuators.brows.hesitation", FROWN),
]
"""A text with a pause of each kind, the rule that punctuates it, and a muscle that the rule contracts."""


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
