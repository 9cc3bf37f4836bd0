"""The whole pipeline on real sentences, with the real speech engine, face and encoder."""

from __future__ import annotations

import gc
import tracemalloc
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import risorius
import risorius.pipeline
from risorius import blend
from risorius.core.movement import Cause
from risorius.core.parameters import INDEX, NEUTRAL, PARAMETERS, Kind
from risorius.errors import InputError
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.fit.measure import Gauge
from risorius.face.solve import FaceSolver
from risorius.rules.emotions import emotions
from risorius.settings import BlendChoices, Settings
from tests.profiles import everyday, samples

ROOT = Path(__file__).parent.parent
DEMO = str(ROOT / "examples" / "demo.xml")
LABIALS = "My baby brother put the map by the beam."
PAPER_A = Settings(blend=BlendChoices(conflict="inhibit"))
SMALL = Settings(size=(96, 96), fps=Fraction(samples(30, everyday=10)))
SMILE, FUNNELER = "zygomatic_major.left", "orbicularis_oris_funneler"


@pytest.fixture(scope="module")
def demo() -> risorius.Take:
    return risorius.speak(DEMO, settings=PAPER_A)


def test_the_demonstration_lasts_until_the_smile_has_gone(demo: risorius.Take) -> None:
    assert demo.duration == 4.0
    assert len(demo.times) == 121


def test_surprise_gives_way_to_the_smile_without_a_jump(demo: risorius.Take) -> None:
    fine = risorius.speak(DEMO, settings=replace(PAPER_A, fps=Fraction(240)))
    for name in ("frontalis_medialis.left", SMILE, "masseter"):
        steps = [np.abs(np.diff(take.curves[name])).max() for take in (demo, fine)]
        assert steps[1] < 0.35 * steps[0]
    assert demo.curves["frontalis_medialis.left"][30] == pytest.approx(1.0, abs=1e-3)
    assert demo.curves[SMILE][10] < 0.1
    assert demo.curves[SMILE][45] > 0.5


def test_the_smile_yields_before_the_rounded_lips_of_very_and_returns(demo: risorius.Take) -> None:
    very = next(w for w in demo.utterance.words if w.text == "very")  # type: ignore[union-attr]
    smile, rounded = demo.curves[SMILE], demo.curves[FUNNELER] > 0.1
    during = (demo.times > very.start) & (demo.times < very.end) & rounded
    assert during.any()
    # What is left there is the lips' own: an /EH/ is a little spread.
    (shown,) = (trace.applied for trace in demo.traces(SMILE) if trace.channel == "emotion")
    assert (shown[during] < 0.05).all()
    assert (smile[during] < 0.15).all()
    first = np.flatnonzero(during)[0]
    assert smile[first - 3] > smile[first - 1], "the smile gives way over several frames"
    assert smile[demo.times > 2.9].max() > 0.85


def test_by_default_the_smile_gives_way_by_degrees_and_returns() -> None:
    take = risorius.speak("You would really love the moon.", emotion={"happiness": 1.0})
    assert take.score.settings.conflict == "graded"
    smile, rounded = take.curves[SMILE], take.curves[FUNNELER]
    level = smile.max()
    roundest = int(np.argmax(rounded))
    speech = blend.at(replace(take.score, movements=()), take.times[[roundest]], load_lip_rig())
    assert smile[roundest] == pytest.approx(speech[0, INDEX[SMILE]], abs=0.01 * level)
    assert np.abs(np.diff(smile)).max() < 0.2
    love = next(w for w in take.utterance.words if w.text == "love")  # type: ignore[union-attr]
    assert smile[(take.times > love.start) & (take.times < love.end)].max() > 0.85 * level


def test_both_eyes_blink(demo: risorius.Take) -> None:
    for side in ("left", "right"):
        assert demo.curves[f"orbicularis_oculi_palpebralis.{side}"].max() > 0.7


def test_every_movement_has_a_cause(demo: risorius.Take) -> None:
    assert all(m.cause != Cause() for m in (*demo.score.movements, *demo.score.lips))
    # In four seconds the blinks may all be those of accents and pauses.
    assert {"lips", "emotion", "gaze", "head"} <= {
        *(m.channel for m in demo.score.movements),
        "lips",
    }


@pytest.mark.parametrize("emotion", everyday([None, *emotions()], [None, "happiness", "surprise"]))
def test_closures_are_closed_under_every_emotion(emotion: str | None) -> None:
    take = risorius.speak(LABIALS, emotion={emotion: 1.0} if emotion else {})
    closed = [s for s in take.score.lips if "lip_seal" in s.targets]
    assert [s.phone for s in closed] == ["M", "B", "B", "B", "P", "M", "P", "B", "B", "M"]
    inside = [i for i, t in enumerate(take.times) if any(s.start <= t <= s.end for s in closed)]
    assert len(inside) >= len(closed)
    gauge = Gauge(take.head)
    gaps = [gauge.measure(face).lip_gap_mm for face in take.faces(inside)]
    assert max(gaps) <= 0.05
    assert take.curves["masseter"][inside].max() <= 0.2 + 1e-9


@pytest.mark.parametrize("emotion", [None, "surprise"])
def test_a_closure_is_closed_from_its_first_moment_to_its_last(emotion: str | None) -> None:
    take = risorius.speak("Bob may bump a member.", emotion={emotion: 1.0} if emotion else {})
    plan = blend.Plan(take.score, load_lip_rig())
    closed = [(s.start, s.end) for s in take.score.lips if s.targets.get("lip_seal", 0.0) == 1.0]
    assert len(closed) >= 8
    solver, gauge = FaceSolver(take.head), Gauge(take.head)
    faces = [solver.solve(values) for span in closed for values in plan.at(np.linspace(*span, 4))]
    assert max(gauge.measure(face).lip_gap_mm for face in faces) <= 0.05


@pytest.mark.parametrize("emotion", everyday([None, "happiness", "surprise"], ["surprise"]))
def test_no_curve_has_a_corner(emotion: str | None) -> None:
    """A corner's second difference falls 4-fold with the step, a bend's 16-fold."""
    shown = {emotion: 0.8} if emotion else {}
    take = risorius.speak(
        "Maybe five wolves swam over to the boat?", emotion=shown, settings=Settings(seed=1)
    )
    assert take.planned is not None
    coarse, fine, quick = (
        np.abs(np.diff(take.planned.at(np.arange(0.0, take.duration, 1.0 / fps)), 2, axis=0)).max(axis=0)
        for fps in (100, 400, 1600)
    )
    for k, parameter in enumerate(PARAMETERS):
        if coarse[k] < 1e-5:
            continue
        eyes = parameter.group == "lids" or parameter.kind is Kind.GAZE
        few, many = (fine[k], quick[k]) if eyes else (coarse[k], fine[k])
        assert few > 8.0 * many, parameter.name


def test_a_display_is_kept_where_nothing_conflicts() -> None:
    take = risorius.speak("As I said, it is easy.", emotion={"happiness": 1.0})
    said = (take.times > 0.6) & (take.times < take.duration - 1.0)
    assert take.curves[SMILE][said].min() > 0.5


def test_a_score_read_back_gives_the_same_performance(demo: risorius.Take, tmp_path: Path) -> None:
    demo.write(tmp_path / "a.score.json", tmp_path / "a.muscles.csv")
    for take in (risorius.mix(tmp_path / "a.score.json"), risorius.speak(str(tmp_path / "a.score.json"))):
        np.testing.assert_array_equal(take.performance.values, demo.performance.values)
    take.write(tmp_path / "b.muscles.csv")
    assert (tmp_path / "a.muscles.csv").read_bytes() == (tmp_path / "b.muscles.csv").read_bytes()


def test_same_input_same_bytes(tmp_path: Path) -> None:
    names = ["x.muscles.csv", "x.landmarks.csv", "x.score.json", "x.TextGrid", "x.wav", "x.png", "x.mp4"]
    written = []
    for folder in (tmp_path / "a", tmp_path / "b"):
        folder.mkdir()
        take = risorius.speak("Hi, mum!", emotion={"joy": 0.5}, settings=SMALL)
        take.write(*(folder / name for name in names))
        written.append([(folder / name).read_bytes() for name in names])
    for name, first, second in zip(names, *written, strict=True):
        assert first == second, name


@pytest.mark.full
def test_a_minute_more_keeps_less_than_two_megabytes_more() -> None:
    sentence = "Oh, really? I like it very much. My baby brother put the map by the beam. "
    risorius.speak(sentence, text=True)
    tracemalloc.start()
    try:
        # All blocks of time that are kept are full from the first length on.
        kept = [_kept(sentence * 48), _kept(sentence * 72)]
    finally:
        tracemalloc.stop()
    (before, short), (after, long) = kept
    assert (after - before) / (long - short) < 2e6


def _kept(text: str) -> tuple[int, float]:
    """Return how many bytes a take keeps, and its minutes."""
    gc.collect()
    empty = tracemalloc.get_traced_memory()[0]
    take = risorius.speak(text, text=True)
    gc.collect()
    return tracemalloc.get_traced_memory()[0] - empty, take.duration / 60.0


def test_another_seed_moves_the_blinks_but_not_the_lips() -> None:
    one, two = (risorius.speak("Hello there.", settings=Settings(seed=seed)) for seed in (1, 2))
    assert one.score.lips == two.score.lips
    assert one.score.movements != two.score.movements


def test_still_is_still() -> None:
    take = risorius.speak("Hello there.", settings=Settings(lively=False))
    assert not take.curves["orbicularis_oculi_palpebralis.left"].any()
    assert not take.curves["head_yaw"].any()


def test_the_video_has_all_frames_and_the_whole_sound(tmp_path: Path) -> None:
    import av

    take = risorius.speak("Hello there.", settings=SMALL)
    take.write(tmp_path / "x.mp4")
    with av.open(str(tmp_path / "x.mp4")) as video:
        frames = sum(1 for _ in video.decode(video=0))
    with av.open(str(tmp_path / "x.mp4")) as video:
        sound = sum(frame.samples / frame.sample_rate for frame in video.decode(audio=0))
    assert frames == len(take.times)
    assert sound == pytest.approx(take.duration, abs=0.1)


def test_a_pose_is_held_exactly() -> None:
    take = risorius.pose({"AU12.left": 0.8, "head_yaw": -10.0}, emotion={"surprise": 0.5})
    assert take.curves[SMILE][0] == 0.8
    assert take.curves["zygomatic_major.right"][0] == 0.0
    assert take.curves["head_yaw"][0] == -10.0
    assert take.curves["frontalis_medialis.left"][0] == pytest.approx(0.5)


def test_a_picture_shows_what_the_video_shows(demo: risorius.Take) -> None:
    some = list(demo.faces([40, 44]))
    whole = [face for i, face in enumerate(demo.faces()) if i in (40, 44)]
    assert [face.skin.tobytes() for face in some] == [face.skin.tobytes() for face in whole]


def test_the_skin_has_inertia_unless_it_is_static(demo: risorius.Take) -> None:
    rising = int(np.argmax(np.diff(demo.curves[SMILE]))) + 1
    still = risorius.Take(demo.performance, Settings(dynamics="static"))
    (moving,), (static,) = demo.faces([rising]), still.faces([rising])
    assert 0.05 < np.abs(moving.skin - static.skin).max() < 5.0


def test_faces_at_one_time_agree_at_all_frame_rates(demo: risorius.Take) -> None:
    times = (0.4, 1.2, 2.0)
    found = []
    for fps in samples((25, 30, 60, 120), everyday=(25, 60)):
        take = risorius.pipeline.combine(demo.score, Settings(fps=Fraction(fps)))
        found.append(np.stack([face.skin for face in take.faces([round(t * fps) for t in times])]))
    for other in found[1:]:
        assert np.abs(other - found[0]).max() <= 0.1


def test_an_unknown_dynamics_is_named() -> None:
    with pytest.raises(InputError, match="unknown skin 'spring'; did you mean 'springs'"):
        Settings(dynamics="spring")


def test_every_frame_of_the_demonstration_can_be_explained(demo: risorius.Take) -> None:
    for index, time in list(enumerate(demo.times))[:: samples(1, everyday=6)]:
        explained = {e.parameter: e for e in demo.explain(float(time))}
        for name, curve in demo.curves.items():
            if name in explained:
                assert explained[name].value == pytest.approx(curve[index], abs=1e-9), (name, time)
                assert all(part.reason for part in explained[name].losers), (name, time)
            else:
                assert curve[index] == pytest.approx(NEUTRAL[INDEX[name]], abs=5e-4), (name, time)


def test_the_smile_is_explained_by_the_rounded_r_of_very(demo: risorius.Take) -> None:
    (explanation,) = demo.explain(1.68, SMILE)
    assert explanation.winner is not None
    assert explanation.winner.cause.place.endswith("demo.xml:3:1")
    assert 'orbicularis_oris_funneler of /R/ of "very"' in explanation.winner.reason
    assert len(demo.explain(1.68, "zygomatic_major")) == 2


@pytest.mark.parametrize(
    ("time", "name"), [(-1.0, SMILE), (9.0, SMILE), (float("nan"), SMILE), (1.0, "smyle")]
)
def test_what_cannot_be_explained_is_refused(demo: risorius.Take, time: float, name: str) -> None:
    with pytest.raises(risorius.RisoriusError):
        demo.explain(time, name)


def test_a_performance_read_back_is_explained_alike(demo: risorius.Take, tmp_path: Path) -> None:
    demo.write(tmp_path / "x.performance.json")
    again = risorius.load(tmp_path / "x.performance.json")
    np.testing.assert_array_equal(again.performance.values, demo.performance.values)
    assert again.explain(1.68) == demo.explain(1.68)
    assert again.summary() == demo.summary()
    assert 0 < demo.summary()["emotion"].inhibited < demo.summary()["emotion"].active
