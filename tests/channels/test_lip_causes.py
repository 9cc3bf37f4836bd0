"""Causes of timid lips that no single table shows (facts: lips-motion, 7 and 9)."""

from __future__ import annotations

import numpy as np
import pytest
from tests.profiles import everyday

from risorius import blend
from risorius.channels import ChannelInputs, Display
from risorius.channels import compose as compose_channels
from risorius.core.arkit import INDEX as SHAPE
from risorius.core.lips.articulators import JAW, PROTRUSION
from risorius.core.lips.lip_rig import gap_left
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX, NAMES
from risorius.core.score import Score
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.pipeline import compose
from risorius.rules.lips import lip_table
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

LINE = "*Sue* said six *wise* boys *push* *new* *maps* to *Boise* *zoo*."
HELD = ("S", "Z", "SH", "P", "B", "M", "W", "UW")


def test_an_accent_opens_the_jaw_by_one_mechanism() -> None:
    script = read_script(LINE, text=True)
    utterance, rig = synthesize_script(script), load_lip_rig()
    middles = np.array([(p.start + p.end) / 2.0 for p in utterance.phones if p.symbol in HELD])
    drops = []
    for without in ((), ("signals",)):
        score = compose(script, utterance, (), Settings(seed=1, without=without))
        jaw = blend.at(score, middles, rig)[:, INDEX["masseter"]]
        drops.append(rig.passive(JAW, {"jaw": jaw}))
    assert len(utterance.accents) >= 5
    assert len(middles) >= 12
    assert np.abs(drops[0] - drops[1]).max() < 0.3


def test_the_glide_of_you_begins_its_vowel(utterance_of) -> None:
    """A short /ju/ has time for two shapes of the lips, and the first is already half round."""
    found = {}
    for words in ("Y UW", "N UW", "Y IY"):
        utterance = utterance_of(words)
        found[words] = [s for s in compose_channels(ChannelInputs(2.0, utterance)).lips if s.phone]
    you, new, ye = found.values()
    assert [s.phone for s in you] == ["Y", "UW"]
    assert you[1].targets == new[2].targets
    assert 0.4 < you[0].targets["lip_protrusion"] / you[1].targets["lip_protrusion"] < 0.6
    assert PROTRUSION not in ye[0].targets
    assert ye[0].targets["lip_width"] > 0.0


def test_an_accent_hardly_opens_rounded_vowels() -> None:
    script = read_script("*Sue* saw *two* *new* *shoes*.", text=True)
    utterance, rig = synthesize_script(script), load_lip_rig()
    middles = np.array([(p.start + p.end) / 2.0 for p in utterance.phones if p.symbol in ("UW", "AO")])
    gaps = []
    for without in ((), ("signals",)):
        score = compose(script, utterance, (), Settings(seed=4, without=without))
        values = blend.at(score, middles, rig)
        curves = {name: values[:, INDEX[name]] for name in NAMES}
        gaps.append(gap_left(rig.gap(curves), curves["lip_seal"]))
    assert len(middles) >= 5
    assert np.abs(gaps[0] - gaps[1]).max() < 0.42


@pytest.mark.parametrize("phone", ["AA", "AE", "EH"])
def test_the_chin_gives_most_of_an_open_vowel_and_not_all(phone: str) -> None:
    targets = lip_table().shape(phone).targets
    assert 0.55 <= targets["jaw_drop"] / targets["lip_aperture"] <= 0.65


def test_arkit_puckers_closed_lips_and_funnels_open_ones() -> None:
    """Apple's Pucker rounds closed lips, its Funnel open ones (facts: lips-motion, 11)."""
    fit, solver = ArkitFit.of(load_head()), FaceSolver(load_head())

    def share_of_pucker(phone: str, **targets: float) -> float:
        held = LipSegment(phone, 0.5, 3.5, {**lip_table().shape(phone).targets, **targets})
        values = blend.at(Score(4.0, lips=(held,)), np.array([2.0]), load_lip_rig())[0]
        weights = fit.weights(solver.solve(values))
        pucker, funnel = (float(weights[SHAPE[f"mouth{name}"]]) for name in ("Pucker", "Funnel"))
        assert pucker + funnel > 0.3
        return pucker / (pucker + funnel)

    # Half a millimetre of gap lies on the slope from one to the other: .60 of Pucker. It was .84 while the
    # rounding muscle alone parted the lips further, so that the gap was less of its way.
    assert share_of_pucker("W") > 0.55
    assert max(share_of_pucker(phone) for phone in ("AO", "SH", "R")) < 0.5
    # One fades into the other at about a millimetre of gap.
    shut, near, ajar, apart = (share_of_pucker("UW", lip_aperture=gap) for gap in (0.0, 1.0, 1.5, 4.0))
    assert shut > 0.8
    assert 0.3 < near < 0.8
    assert apart < ajar < near
    assert apart < 0.3


@pytest.mark.parametrize("text", [LINE, "The fox ran over the wooden fence and vanished."])
def test_tongue_and_head_have_no_corners_in_speech(text: str) -> None:
    script = read_script(text, text=True)
    plan = blend.Plan(compose(script, synthesize_script(script), (), Settings(seed=1)), load_lip_rig())
    names = ("tongue_up", "tongue_back", "tongue_out", "head_yaw", "head_roll", "head_pitch")
    _check_corners(plan, names)


@pytest.mark.parametrize(
    "text",
    [
        "My baby brother put the map by the beam.",
        "Why would Peter ever buy a broken van?",
        "Prove both of them!",
    ],
)
def test_jaw_and_contacts_have_no_corners_in_speech(text: str) -> None:
    script = read_script(text, text=True)
    plan = blend.Plan(compose(script, synthesize_script(script), (), Settings(seed=1)), load_lip_rig())
    _check_corners(plan, ("masseter", "lip_seal", "lip_tuck"))


UNDER_DISPLAYS = (
    ("surprise", "Map, mop, pope, babe."),
    ("happiness", "Map, mop, pope, babe."),
    ("anger", "Map, mop, pope, babe."),
    ("disgust", "Bob proved Pam was wrong about the whole movie."),
    ("fear", "A few brave women and five puppies won the match."),
)


@pytest.mark.parametrize("shown", everyday(UNDER_DISPLAYS, (UNDER_DISPLAYS[0], UNDER_DISPLAYS[-1])))
def test_jaw_and_contacts_have_no_corners_under_a_display(shown: tuple[str, str]) -> None:
    emotion, text = shown
    script = read_script(text, text=True)
    displays = (Display(emotion, 1.0),)
    plan = blend.Plan(compose(script, synthesize_script(script), displays, Settings(seed=2)), load_lip_rig())
    _check_corners(plan, ("masseter", "lip_seal"))


def test_between_closures_a_surprise_has_the_jaw_that_time_allows() -> None:
    """A third of the range takes a third of the jaw's .12 s either way; closures are 150 ms apart.

    Of these the knots beside the closures are closed, too: the limit turns about them.
    """
    closed, times = lip_table().shape("M").targets, np.arange(1.0, 1.15, 0.005)
    lips = tuple(
        LipSegment(phone, start, end, targets, {"masseter": (0.0, 0.05)} if phone == "M" else {})
        for phone, start, end, targets in (
            ("M", 0.9, 1.0, closed),
            ("AH", 1.0, 1.15, lip_table().shape("AH").targets),
            ("M", 1.15, 1.25, closed),
        )
    )
    shown = Movement("emotion", 0.0, 2.0, 0.3, 0.3, {"masseter": 0.35})
    jaws = [
        blend.at(Score(2.0, movements, lips), times, load_lip_rig())[:, INDEX["masseter"]]
        for movements in ((), (shown,))
    ]
    assert (jaws[1] - jaws[0]).mean() > 0.44 * 0.35


def _check_corners(plan: blend.Plan, names: tuple[str, ...]) -> None:
    """Four times as often sampled, the largest second difference falls 16-fold; beside a corner, 4-fold."""
    columns = [INDEX[name] for name in names]
    bends = []
    for fps in (100, 400):
        curves = plan.at(np.arange(0.0, plan.score.duration, 1.0 / fps))[:, columns]
        bends.append(np.abs(np.diff(curves, 2, axis=0)).max(axis=0))
    assert (bends[0] >= 8.0 * bends[1]).all(), dict(zip(names, zip(*bends, strict=True), strict=True))


def test_a_dropped_jaw_gives_way_to_rounded_lips() -> None:
    """Lips that reach for each other over a low jaw would hang: an M for an upper edge."""
    script = read_script("Who knew you would show up too?", text=True)
    utterance = synthesize_script(script)
    score = compose(script, utterance, (Display("surprise", 1.0),), Settings(seed=1))
    middles = np.array([(p.start + p.end) / 2.0 for p in utterance.phones if p.symbol in ("UW", "OW")])
    values = blend.at(score, middles, load_lip_rig())
    assert len(middles) >= 4
    assert values[:, INDEX["masseter"]].max() < 0.23
    assert values[:, INDEX["lip_seal"]].max() < 0.9
