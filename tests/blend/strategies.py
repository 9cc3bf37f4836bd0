"""Random scores for the laws."""

from __future__ import annotations

from itertools import combinations

from hypothesis import strategies as st

from risorius.core.movement import Dominance, LipSegment, Movement
from risorius.core.parameters import RIVALS
from risorius.core.score import BlendSettings, Score

MUSCLES = (
    "zygomatic_major.left",
    "zygomatic_major.right",
    "triangularis.left",
    "orbicularis_oris_funneler",
    "orbicularis_oris_presser",
    "depressor_labii.left",
    "levator_labii_nasi.left",
    "levator_labii_nasi.right",
    "levator_palpebrae.left",
    "orbicularis_oculi_palpebralis.left",
    "masseter",
)
DIRECTIONS = ("head_pitch", "gaze_yaw", "gaze_distance")
DURATION = 6.0

# Multiples of 1/64 s: exact in binary, so that a shift by whole seconds changes no bit.
ticks = st.integers(0, 5 * 64).map(lambda k: k / 64)
phases = st.integers(4, 64).map(lambda k: k / 64)
levels = st.floats(0.05, 1.0)


@st.composite
def targets(draw: st.DrawFn, directions: bool = True) -> dict[str, float]:
    names = draw(st.lists(st.sampled_from(MUSCLES), min_size=1, max_size=4, unique=True))
    chosen = {name: draw(levels) for name in names}
    # Rivals of one movement sum to 1 at most; what happens to others is tested by itself
    # (test_layer_priority).
    for one, other in combinations(names, 2):
        if other in RIVALS[one] and chosen[one] + chosen[other] > 1.0:
            chosen[one], chosen[other] = 0.5 * chosen[one], 0.5 * chosen[other]
    if directions and draw(st.booleans()):
        chosen["head_pitch"] = draw(st.floats(-20, 20))
        chosen["gaze_distance"] = draw(st.floats(0.2, 3))
    return chosen


@st.composite
def movements(
    draw: st.DrawFn,
    channels: tuple[str, ...] = ("signals", "emotion", "manipulators"),
    most: int = 4,
    priorities: bool = False,
    directions: bool = True,
    shortest: int = 8,
    layers: tuple[str, ...] = ("", "brow"),
) -> tuple[Movement, ...]:
    """Movements of positive onset and offset in some channels, in some layers each."""
    found = []
    for channel in channels:
        for layer in layers:
            starts = draw(st.lists(ticks, max_size=most, unique=True))
            for start in starts:
                length = draw(st.integers(shortest, 3 * 64)) / 64
                own = draw(st.sampled_from((None, None, 5.0, 45.0, 65.0))) if priorities else None
                after = draw(st.sampled_from((None, None, 5.0))) if priorities else None
                found.append(
                    Movement(
                        channel, start, start + length, draw(phases), draw(phases),
                        draw(targets(directions)), layer=layer, priority=own, release_priority=after,
                    )
                )  # fmt: skip
    return tuple(found)


PHONES: dict[str, LipSegment] = {
    "AA": LipSegment("AA", 0, 1, {"masseter": 0.6}, {"orbicularis_oris_presser": (0.0, 0.1)}),
    "UW": LipSegment(
        "UW", 0, 1, {"orbicularis_oris_funneler": 0.9, "masseter": 0.2}, {"masseter": (0.0, 0.7)},
    ),
    "M": LipSegment(
        "M", 0, 1, {"lip_seal": 1.0, "masseter": 0.05, "orbicularis_oris_presser": 0.3},
        {"masseter": (0.0, 0.1), "levator_labii_nasi.left": (0.0, 0.1), "depressor_labii.left": (0.0, 0.05)},
        {"*": Dominance(4.0, 0.03, 0.03), "masseter": Dominance(3.0, 0.03, 0.03)},
    ),
    "F": LipSegment(
        "F", 0, 1, {"lip_tuck": 1.0, "masseter": 0.1}, {"depressor_labii.left": (0.0, 0.1)},
        {"*": Dominance(2.0, 0.03, 0.03)},
    ),
    "": LipSegment("", 0, 1, {}, {}, {"*": Dominance(1.0, 0.08, 0.08)}),
}  # fmt: skip


@st.composite
def speech(draw: st.DrawFn) -> tuple[LipSegment, ...]:
    """Phones that follow one another, perhaps with gaps."""
    start = draw(st.integers(0, 64)) / 64
    found = []
    for phone in draw(st.lists(st.sampled_from(tuple(PHONES)), max_size=14)):
        length = draw(st.integers(2, 16)) / 64
        model = PHONES[phone]
        found.append(LipSegment(phone, start, start + length, model.targets, model.limits, model.dominance))
        start += length + draw(st.sampled_from((0, 0, 0, 1 / 16)))
    return tuple(found)


@st.composite
def scores(draw: st.DrawFn, conflict: str = "inhibit", priorities: bool = True) -> Score:
    """Speech and movements together."""
    return Score(
        DURATION,
        draw(movements(priorities=priorities)),
        draw(speech()),
        settings=BlendSettings(conflict=conflict),
    )
