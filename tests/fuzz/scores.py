"""Small scores of every kind of movement, from which spoilt ones are made."""

from __future__ import annotations

import json

MOVEMENTS = [
    {"channel": "emotion", "start": 0.2, "end": 1.5, "onset": 0.3, "offset": 0.4, "targets": {"AU12": 0.7}},
    {"channel": "head", "start": 0.5, "end": 1.0, "onset": 0.1, "offset": 0.1, "targets": {"head_yaw": 9.0}}
    | {"priority": 20, "function": "linear", "cause": {"rule": "a.b.c", "trigger": "x", "place": "y:1"}},
    {"channel": "manual", "keys": {"jaw_open": [[0.0, 0.1], [1.0, 0.5], [1.7, 0.0]]}, "replaces": True},
    {"channel": "lips", "phone": "M", "start": 0.4, "end": 0.5, "targets": {"lip_seal": 1.0}}
    | {
        "limits": {"jaw_open": [0.0, 0.2]},
        "dominance": {"*": {"magnitude": 0.9, "before": 0.05, "after": 0.05}},
    },
]
SPEECH = {
    "language": "en-us",
    "phones": [
        {"symbol": "", "start": 0, "end": 0.4},
        {"symbol": "M", "start": 0.4, "end": 0.5, "word": 0},
        {"symbol": "", "start": 0.5, "end": 2.0},
    ],
    "words": [{"text": "m", "start": 0.4, "end": 0.5, "first_phone": 1, "last_phone": 2}
              | {"source_start": 0, "source_end": 1}],
    "pauses": [{"start": 0.5, "end": 2.0, "kind": "final"}],
}  # fmt: skip
SCORE = {
    "risorius": 1, "duration": 2.0, "text": "m", "seed": 3, "speech": SPEECH, "movements": MOVEMENTS,
    "settings": {"conflict": "graded", "activation_threshold": 0.1, "min_onset": 0.12, "lips": "dominance"},
}  # fmt: skip
MINIMAL = {"risorius": 1, "duration": 2.0, "movements": MOVEMENTS[:1]}


def as_json(data: object) -> bytes:
    return json.dumps(data).encode()
