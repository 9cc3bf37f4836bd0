"""Appended text changes nothing up to the horizon before the end of the last sentence."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.channels import HORIZON, ChannelInputs, Display, compose
from risorius.core.choices import BLINK_MODELS
from risorius.core.movement import LipSegment, Movement
from risorius.core.progress import quiet
from risorius.core.speech.utterance import Utterance
from risorius.pipeline import speak
from risorius.rules.profiles import Profile, profile_of, profiles
from risorius.script import read_script
from risorius.settings import Settings

Maker = Callable[..., Utterance]
Moved = tuple[list[Movement], list[LipSegment]]
# Later than all that is looked at.
LATER = 1e6
SPOKEN = "well no yes I don't know very sad really what do you like popcorn here she never um it big"
WORDS = st.builds(
    "{}{}{}".format,
    st.sampled_from(SPOKEN.split()),
    st.sampled_from(["", "", "[H*]", "[L+H*]", "[L*]"]),
    st.sampled_from(["", "", "", "", ",", "…"]),
)
ENDS = st.sampled_from([".", ".", "?", "!", ".\n\n"])


def sentences(words: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    said = st.lists(words, min_size=1, max_size=10).map(" ".join).map(lambda text: text.rstrip(",…"))
    return st.builds("{}{}".format, said, ENDS)


TEXTS = st.lists(sentences(WORDS), min_size=1, max_size=7).map(" ".join)
SPANS = st.tuples(st.floats(0.0, 20.0), st.floats(0.5, 10.0)).map(lambda s: (s[0], s[0] + s[1]))
DISPLAYS = st.builds(
    lambda name, intensity, span: Display(name, intensity, *span),
    st.sampled_from(["happiness", "anger", "sadness", "fear"]),
    st.floats(0.0, 1.0),
    st.one_of(st.just((None, None)), SPANS),
)


@st.composite
def speakers(draw: st.DrawFn) -> Profile:
    """Draw one of the package's profiles, with one of the models of blinks."""
    return profile_of(draw(st.sampled_from(sorted(profiles()))), draw(st.sampled_from(BLINK_MODELS)))


def moved_before(time: float, said: Utterance, seed: int, **inputs: object) -> Moved:
    """Return what is composed for an utterance, as far as it is seen before a time."""
    score = compose(ChannelInputs(said.duration, said, **inputs), seed=seed)  # type: ignore[arg-type]
    movements = [seen_before(time, m) for m in score.movements if m.start < time]
    return movements, [s for s in score.lips if s.end < time]


def seen_before(time: float, m: Movement) -> Movement:
    """Return a movement without how it subsides, if that begins at a time or later."""
    return replace(m, end=LATER, offset=0.0) if m.end - m.offset >= time else m


@given(
    text=TEXTS,
    appended=TEXTS,
    seed=st.integers(0, 2**32),
    speaker=speakers(),
    emotions=st.lists(DISPLAYS, max_size=2).map(tuple),
    listening=st.lists(SPANS, max_size=1).map(tuple),
    phone=st.sampled_from([0.06, 0.1, 0.2]),
)
def test_appended_text_changes_nothing_before_the_horizon(
    text: str,
    appended: str,
    seed: int,
    speaker: Profile,
    emotions: tuple[Display, ...],
    listening: tuple[tuple[float, float], ...],
    phone: float,
    sentence_of: Maker,
) -> None:
    before, after = (sentence_of(t, phone=phone) for t in (text, f"{text} {appended}"))
    settled = before.words[-1].end - HORIZON
    # Who listens while the appended text is said begins a turn of which it is known before.
    listening = tuple(span for span in listening if span[1] < before.words[-1].end)
    short, long = (
        moved_before(settled, said, seed, profile=speaker, emotions=emotions, listening=listening)
        for said in (before, after)
    )
    assert short == long


# Each ends in a way that the end of a turn, and so more text, changes how one looks and blinks.
ENDINGS = {
    "long": "I like[H*] it very much here, and she likes[L+H*] big popcorn very well.",
    "short": "Well[H*].",
    "question": "What do you like[L*] here?",
    "hesitation": "I um… don't know[H*].",
    "exclamation": "Never[H*]!",
}
OPENING = "She knows[H*] it all, well, and likes popcorn[L+H*]. No[H*], I don't know[H*]. Really? Yes. " * 4


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("seed", range(4))
def test_a_script_that_goes_on_begins_as_before(ending: str, seed: int, sentence_of: Maker) -> None:
    text = OPENING + ENDINGS[ending]
    before, after = sentence_of(text), sentence_of(f"{text} What do you like? I know it.")
    settled = before.words[-1].end - HORIZON
    movements, lips = moved_before(settled, before, seed)
    assert (movements, lips) == moved_before(settled, after, seed)
    assert {m.channel for m in movements} >= {"signals", "gaze", "head", "manipulators"}
    assert len(movements) > 100


def test_where_nothing_is_said_a_longer_clip_begins_as_a_shorter_one() -> None:
    """A look away that the clip's end would break up is left out."""
    short, long = (compose(ChannelInputs(duration), seed=2).movements for duration in (60.0, 90.0))
    settled = 60.0 - 4.0
    assert [m for m in short if m.end < settled] == [m for m in long if m.end < settled]


def spoken(text: str) -> Utterance:
    """Return a text as the voice says it, measured."""
    said = speak(read_script(text, text=True), (), Settings(), quiet, None)
    assert said is not None
    return said


@pytest.mark.parametrize(
    "text",
    [
        "Oh, really? I like it very much. My baby brother put the map by the beam. What do you think about "
        "that? I never know what to say, you see, but I try. No, I do not believe a word of it!",
        "She said that nobody in the whole house, neither the children nor their parents, had seen a thing. "
        "Is it true? Well, who knows. You may ask her yourself when she comes back on Monday. Everybody else "
        "has gone away for the summer, or so it seems.",
    ],
)
@pytest.mark.parametrize("seed", [0, 1])
def test_a_spoken_text_that_goes_on_begins_as_before(text: str, seed: int) -> None:
    before, after = spoken(text), spoken(f"{text} That is all I know. Would you like some more?")
    settled = before.words[-1].end - HORIZON
    assert settled > 0.0
    movements, lips = moved_before(settled, before, seed)
    assert (movements, lips) == moved_before(settled, after, seed)
    assert len(movements) > 20
    assert len(lips) > 20
