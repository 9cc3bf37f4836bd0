"""ToBI's labels of American English intonation (Beckman and Ayers Elam 1997, after Pierrehumbert 1980)."""

from __future__ import annotations

from ...errors import ParameterError, unknown

UNKNOWN_ACCENT, UNKNOWN_BOUNDARY = "*", "%"
PITCH_ACCENTS = ("H*", "L*", "L+H*", "L*+H", "H+!H*", "!H*", "L+!H*", "L*+!H")
# A phrase accent alone ends an intermediate phrase; with a boundary tone, an intonational one.
PHRASE_ACCENTS = ("L-", "H-", "!H-")
BOUNDARY_TONES = (*PHRASE_ACCENTS, "L-L%", "L-H%", "H-H%", "H-L%", "!H-L%", "!H-H%")


def pitch_accent(text: str) -> str:
    """Return a pitch accent's label, or "*"; raise ParameterError with the nearest label for others."""
    label = text.strip().upper()
    if label not in (*PITCH_ACCENTS, UNKNOWN_ACCENT):
        raise ParameterError(unknown("pitch accent", text, PITCH_ACCENTS))
    return label


def boundary_tone(text: str) -> str:
    """Return a boundary's label; raise ParameterError with the nearest label for others.

    The spelling of Pierrehumbert and Hirschberg, which paper B uses, lacks the hyphen: "LH%" is ToBI's
    "L-H%".
    """
    label = text.strip().upper()
    label = next((tone for tone in BOUNDARY_TONES if label == tone.replace("-", "", 1)), label)
    if label not in (*BOUNDARY_TONES, UNKNOWN_BOUNDARY):
        raise ParameterError(unknown("boundary tone", text, BOUNDARY_TONES))
    return label
