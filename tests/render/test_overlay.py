from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from risorius.core.action_units import ACTION_UNITS
from risorius.core.look import OVERLAYS
from risorius.core.movement import Cause, Movement
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.core.performance import Performance
from risorius.core.score import Score
from risorius.core.speech.utterance import Word
from risorius.render.overlay import Overlays, Subject
from risorius.render.overlay.bars import unit_values
from risorius.render.overlay.caption import Caption, lines_of
from risorius.render.overlay.lanes import Lanes, lane_blocks
from risorius.render.overlay.phones import Phones

SIZE = (240, 200)
SMILE = Movement("emotion", 0.2, 1.0, 0.1, 0.1, {"zygomatic_major.left": 1.0}, cause=Cause("rule", "a joke"))
NOD = Movement("head", 0.4, 0.8, 0.1, 0.1, {"head_pitch": 5.0})


@pytest.fixture
def subject(utterance_of):
    utterance = utterance_of("M AA M", lead=0.3, tail=0.4)
    score = Score(utterance.duration, (SMILE, NOD))
    values = np.tile(NEUTRAL, (round(utterance.duration * 30) + 1, 1))
    values[:, INDEX["zygomatic_major.left"]] = 0.8
    return Subject(Performance(score, Fraction(30), values), utterance)


def written(monkeypatch):
    """Return a list that is filled with the place, the letters and the width of each text that is drawn."""
    texts = []
    monkeypatch.setattr(
        "PIL.ImageDraw.ImageDraw.text",
        lambda pen, at, text, font, **_: texts.append((at[0], text, font.getlength(text))),
    )
    return texts


def drawn(subject, names, frame, channels=3):
    overlays = Overlays(names, subject, SIZE)
    width, height = overlays.picture_size
    return overlays.draw(np.full((height, width, channels), 90, np.uint8), frame)


def test_nothing_asked_for_leaves_the_picture_as_it_is(subject):
    picture = np.zeros((200, 240, 3), np.uint8)
    overlays = Overlays((), subject, SIZE)
    assert overlays.picture_size == SIZE
    assert overlays.draw(picture, 0) is picture


@pytest.mark.parametrize("name", OVERLAYS)
@pytest.mark.parametrize("channels", [3, 4])
def test_every_overlay_is_drawn_at_the_size_asked_for(subject, name, channels):
    picture = drawn(subject, (name,), 12, channels)
    assert picture.shape == (200, 240, channels)
    assert (picture[..., :3] != 90).any()


@pytest.mark.parametrize("name", OVERLAYS)
def test_nothing_said_is_no_fault(subject, name):
    silent = Subject(subject.performance, None)
    assert drawn(silent, (name,), 3).shape == (200, 240, 3)


def test_the_picture_is_lower_where_lanes_stand_below_it(subject):
    width, height = Overlays(("lanes",), subject, SIZE).picture_size
    assert width == 240
    assert 100 < height < 190


def test_the_line_for_now_moves_with_time(subject):
    places = []
    for frame in (3, 20):
        lanes = drawn(subject, ("lanes",), frame)[-3].astype(int)
        places.append(np.argmax(lanes[:, 0] - lanes[:, 2]))
    assert places[1] > places[0] + 20


def test_the_current_phone_is_bright(subject):
    first, later = (drawn(subject, ("phones",), frame) for frame in (0, 12))
    assert not np.array_equal(first, later)


def test_names_of_phones_do_not_run_into_each_other(clip, monkeypatch):
    strip = Phones(Subject(clip.performance, clip.utterance), (480, 480))
    texts = written(monkeypatch)
    for frame in range(len(clip.times)):
        texts.clear()
        strip.draw(Image.new("RGB", (480, 480)), 480, frame)
        edges = [(x - 0.5 * width, x + 0.5 * width) for x, _, width in texts]
        # The current one is named though it be short: only it may reach out of its room.
        assert sum(b[0] < a[1] for a, b in pairwise(edges)) <= 1


def test_units_are_the_mean_of_their_muscles(subject):
    units = [ACTION_UNITS[12], ACTION_UNITS[4]]
    values = unit_values(subject.performance, units)
    assert values.shape == (len(subject.performance.values), 2)
    assert values[5] == pytest.approx([0.4, 0.0])


def test_captions_have_the_marks_of_the_text(clip, monkeypatch):
    texts = written(monkeypatch)
    Caption(Subject(clip.performance, clip.utterance), SIZE).draw(
        Image.new("RGB", SIZE), SIZE[1], len(clip.times) // 2
    )
    assert [text for _, text, _ in texts] == ["Oh,", "my", "mother!"]


def test_names_and_labels_of_lanes_stand_whole(subject, monkeypatch):
    later = [
        Movement("emotion", start, 1.1, 0.1, 0.1, {}, cause=Cause("rule", "later")) for start in (0.7, 0.74)
    ]
    score = Score(subject.performance.duration, (SMILE, NOD, *later))
    lanes = Lanes(Subject(replace(subject.performance, score=score), None), (720, 720))
    texts = written(monkeypatch)
    lanes.draw(Image.new("RGB", (720, 720 + lanes.below)), 720, 3)
    places = {text: (x, x + width) for x, text, width in texts}
    assert places["later"][0] > places["a joke"][1]
    assert min(places[text][0] for text in ("a joke", "later")) > max(
        places[name][1] for name in ("emotion", "head")
    )
    assert [text for _, text, _ in texts].count("later") == 1


def test_blocks_go_by_channel_and_say_their_cause(subject):
    blocks = lane_blocks(subject.performance.score)
    assert [tuple(block) for block in blocks["emotion"]] == [(0.2, 1.0, "a joke")]
    assert [block.label for block in blocks["head"]] == [NOD.label]
    assert blocks["gaze"] == []


def test_lines_end_at_pauses_and_where_they_are_full():
    words = [
        Word(text, start, start + 0.2, 0, 1, 0, 1)
        for text, start in (("one", 0.0), ("two", 0.2), ("three", 0.4), ("four", 2.0))
    ]
    lines = lines_of(words, 8.0, lambda word: len(word.text), 1.0)
    assert [[w.text for w in line] for line in lines] == [["one", "two"], ["three"], ["four"]]


@pytest.mark.parametrize("size", [(64, 64), (96, 64), (160, 160), (720, 720)])
def test_movements_of_any_length_are_drawn(size):
    lengths = [0.01 * k for k in range(1, 120)]
    starts = np.cumsum([0.0, *lengths])
    moves = tuple(
        Movement("signals", float(start), float(start) + length, 0.0, 0.0, {})
        for start, length in zip(starts, lengths, strict=False)
    )
    score = Score(float(starts[-1]), moves)
    performance = Performance(score, Fraction(1), np.tile(NEUTRAL, (2, 1)))
    overlays = Overlays(("lanes",), Subject(performance, None), size)
    overlays.draw(np.zeros((size[1], size[0], 3), np.uint8), 0)
