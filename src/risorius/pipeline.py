"""The pipeline on one page: Script → Utterance → Score → Performance → vertices → outputs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from .blend import Plan, changed_span
from .channels import Brief, Display, compose
from .core.action_units import resolve_targets
from .core.arrays import Array
from .core.movement import Cause, ManualCurve
from .core.parameters import INDEX, NEUTRAL
from .core.performance import Performance
from .core.progress import Progress, quiet
from .core.score import BlendSettings, Score
from .core.utterance import Utterance
from .errors import InputError, Place
from .ports.performance_json import read_performance_file
from .ports.score_json import read_score_file
from .ports.targets import check_targets as check_outputs
from .rules.book import book_of
from .rules.emotions import emotion_key
from .rules.fuzzy import blended
from .rules.profiles import Profile, attitude, profile_of
from .script import Script, felt_in, listening_in, movements_of, read_script
from .settings import PLANNED, BlendChoices, Settings
from .speech import feelings, say
from .speech.from_recording import holds_labels, listen
from .speech.recordings.recording import read_recording
from .take import Take, lip_rig
from .unread import (
    CAPTURED,
    HELD,
    MEASURED,
    PERFORMED,
    PLANNING,
    RECORDED,
    SCHEDULED,
    SCORE,
    SILENT,
    TIMED,
    Stage,
    refuse,
    refuse_all_but,
    refuse_stages,
)

if TYPE_CHECKING:
    from .ports.rig import Rig, Shown
    from .stream import Options
    from .stream.send import Sent

__all__ = ["align", "check_outputs", "load", "mix", "perform", "play", "pose", "rig", "speak", "stream"]

# Seconds to wait for a greeting.
PATIENCE = 60.0
# Seconds that a script without speech lasts at least.
SILENT_DURATION = 1.0
Emotions = Mapping[str, float] | Iterable[Display]


def speak(
    given: str | None = None,
    *,
    audio: str | PathLike[str] | None = None,
    transcript: str | None = None,
    text: bool = False,
    source: str = "text",
    emotion: Emotions = (),
    settings: Settings | None = None,
    progress: Progress = quiet,
) -> Take:
    """Perform a text or file (`.txt`, `.xml`, `.TextGrid`, `.score.json`); `text` forces text, `source` names
    it.

    With the recording `audio` its voice is heard instead of a synthesized one: it says the text, or the words
    of `transcript` (a text, or the name of a file with it), or is labelled by the TextGrid; given none of
    these, it is recognized, which is weaker. `emotion`: intensities 0..1 by name, or displays with their
    spans. Raises RisoriusError with one line on what is wrong and where.
    """
    settings, displays = settings or Settings(), _displays(emotion)
    if given is not None and given.lower().endswith(".json") and not text:
        arguments = {"emotion": displays, "audio": audio, "transcript": transcript}
        refuse_stages(settings, PLANNING, SCORE, Place(given), **arguments)
        return mix(given, settings=settings)
    settings = looking_like(profile_of(settings.profile), settings)
    utterance: Utterance | None
    if given is None or audio is not None or transcript is not None or holds_labels(given, text):
        recorded = TIMED if audio is None else RECORDED
        refuse_stages(settings, [Stage.VOICE], recorded, Place(str(audio or given)))
        script, utterance = listen(given, audio, transcript, progress, text=text, source=source)
    else:
        script = read_script(given, text=text, source=source)
        _check_voice_is_heard(script, settings)
        progress("Speaking …")
        utterance = spoken(script, displays, settings) if script.lines else None
    score = plan(script, utterance, displays, settings)
    return perform(score, settings, utterance)


def _check_voice_is_heard(script: Script, settings: Settings) -> None:
    """Raise UnreadError for settings of a voice that says nothing, and of silence that no voice has."""
    if not script.lines:
        refuse_stages(settings, [Stage.VOICE], SILENT)
    if script.timed:
        refuse(settings, ("lead", "tail"), SCHEDULED)


def looking_like(speaker: Profile, settings: Settings) -> Settings:
    """Return settings with the speaker's skin where they leave it open."""
    age = speaker.age if settings.age is None else settings.age
    return replace(settings, age=age, wrinkles={**speaker.wrinkles, **settings.wrinkles})


def spoken(script: Script, displays: tuple[Display, ...], settings: Settings) -> Utterance:
    """Speak a script's lines as the settings want it, the voice coloured by emotions."""
    return say(
        script,
        voice=settings.voice,
        language=settings.language,
        rate=settings.rate,
        lead=settings.lead,
        tail=settings.tail,
        felt=feelings(script, displays) if settings.voice_emotion else (),
    )


def align(audio: str | PathLike[str], transcript: str | None = None, *, progress: Progress = quiet) -> Take:
    """Return what is said when, and how, in a recording of `transcript` (a text, or the name of its file).

    The take's `utterance` has it; the face rests. Raises RisoriusError with one line on what is wrong and
    where.
    """
    _, utterance = listen(None, audio, transcript, progress)
    return perform(Score(utterance.duration, text=utterance.text), utterance=utterance)


def plan(
    script: Script, utterance: Utterance | None, emotions: tuple[Display, ...], settings: Settings
) -> Score:
    """Derive all movements from what is said, if anything is, and marked."""
    words, spoken = (utterance.words, utterance.duration) if utterance else ((), SILENT_DURATION)
    duration = script.lasting(words, spoken)
    marks = movements_of(script, words, duration)
    brief = Brief(
        duration=max([duration, *(m.end for m in marks)]),
        utterance=utterance,
        marks=marks,
        emotions=emotions,
        felt=felt_in(script, words, duration),
        listening=listening_in(script, words, duration),
        opens=not script.timed,
        articulation=settings.articulation,
        manner=settings.manner,
        lively=settings.lively,
        profile=profile_of(settings.profile),
        attitudes=tuple(attitude(name) for name in settings.attitudes),
        book=book_of(settings.rules),
    )
    return compose(brief, seed=settings.seed, without=settings.without, settings=settings.blend.over(PLANNED))


def perform(
    score: Score,
    settings: Settings | None = None,
    utterance: Utterance | None = None,
    *,
    like: Take | None = None,
) -> Take:
    """Combine a score's movements into curves; `like` is a take whose work on the same lips is taken over."""
    settings = settings or Settings()
    before = None if like is None else like.planned
    made = Plan(score, lip_rig(score, settings.head), before)
    return Take(_performed(made, settings, like), settings, utterance, planned=made)


def _performed(made: Plan, settings: Settings, like: Take | None) -> Performance:
    """Return the performance of a plan; of one that is like it only what is other is worked anew."""
    if like is not None and like.planned is not None and like.performance.fps == settings.fps:
        span = changed_span(like.planned, made)
        if span is not None:
            return made.performance_like(like.performance, span)
    return made.performance(settings.fps)


def mix(
    score: str | PathLike[str],
    *,
    settings: Settings | None = None,
    conflict: str | None = None,
    onset_function: str | None = None,
) -> Take:
    """Combine the movements of a score file; `conflict`, `onset_function` and what `settings.blend` chooses
    override the score's own.

    Raises RisoriusError; UnreadError for settings of a voice or a plan, which a score has behind it.
    """
    settings = settings or Settings()
    refuse_stages(settings, PLANNING, SCORE, Place(str(score)))
    file = read_score_file(Path(score))
    blend = settings.blend.over(file.score.settings)
    blend = BlendChoices(conflict=conflict, onset_function=onset_function).over(blend)
    return perform(replace(file.score, settings=blend), settings, file.utterance)


def load(performance: str | PathLike[str], *, settings: Settings | None = None) -> Take:
    """Read a `.performance.json` back, with its curves as they were written.

    Raises RisoriusError; UnreadError for settings that would change the curves.
    """
    settings, place = settings or Settings(), Place(str(performance))
    refuse_stages(settings, [*PLANNING, Stage.COMBINE], PERFORMED, place)
    file = read_performance_file(Path(performance))
    if settings.fps != file.performance.fps:
        refuse(settings, ("fps",), PERFORMED, place)
    settings = replace(settings, fps=file.performance.fps)
    return Take(file.performance, settings, file.utterance)


def play(
    capture: str | PathLike[str],
    *,
    audio: str | PathLike[str] | None = None,
    settings: Settings | None = None,
    progress: Progress = quiet,
) -> Take:
    """Perform a captured face: `.arkit.csv` (or any CSV of Live Link Face), `.fap`, `.au.csv`, or a score.

    `audio` is a recording that is heard with it. Raises InputError for a file that cannot be used, and for
    settings that nothing reads (UnreadError).
    """
    from .face.head import head_of
    from .ports.formats import format_read
    from .ports.readable import ReadOptions

    settings, path = settings or Settings(), Path(capture)
    kind = format_read(path)
    if kind.suffix == ".performance.json":
        take = load(path, settings=settings)
    elif kind.suffix == ".score.json":
        take = mix(path, settings=settings)
    else:
        refuse_stages(settings, [*PLANNING, Stage.COMBINE], CAPTURED, Place(str(capture)))
        file = kind.read(path, ReadOptions(partial(head_of, settings), progress))
        take = perform(file.score, settings, file.utterance)
    return take if audio is None else replace(take, sound=read_recording(audio))


def stream(
    take: Take,
    protocol: str,
    to: str = "127.0.0.1",
    *,
    listen: str | None = None,
    patience: float = PATIENCE,
    options: Options | None = None,
    sound: bool = False,
    progress: Progress = quiet,
) -> Sent:
    """Send a take to another program in real time; return how many frames were sent and dropped.

    `protocol` is livelink, vmc, ifacialmocap or ifacialmocap-tcp, `to` HOST or HOST:PORT. With `listen`, HOST
    or HOST:PORT of this machine, it is sent to who greets there within `patience` seconds, as receivers of
    iFacialMocap do, by datagrams or TCP as they ask.
    With `sound` the voice is played here and is the clock. Raises InputError for a wrong protocol or address,
    OutputError where nothing listens or nobody greets.
    """
    from .stream import PROTOCOLS, Address, Options, check_options, parse_address, send, wait_for_greeting
    from .stream.clock import MachineClock, SoundClock
    from .stream.line import check_host

    chosen = PROTOCOLS.get(protocol)
    options = options or Options()
    address = parse_address(listen or to, chosen.port)
    if listen is not None and not chosen.greetings:
        greeted = ", ".join(name for name in PROTOCOLS if PROTOCOLS.get(name).greetings)
        raise InputError(f"no greeting asks for {protocol} first; expected --to, or one of {greeted}")
    check_options(protocol, options)
    if listen is None:
        check_host(address)
    clock = SoundClock(take.audio) if sound and take.audio is not None else MachineClock()
    progress("Fitting weights …")
    track = take.arkit
    if listen is not None:
        progress(f"Waiting for a greeting at {address} …")
        host, asked = wait_for_greeting(address, chosen.greetings, patience)
        chosen, options = PROTOCOLS.get(asked.protocol), replace(options, dialect=asked.dialect)
        address = Address(host, chosen.port)
    packets = chosen.make(track, take.performance.fps, options)
    progress(f"Sending to {address} …")
    frames, fps = len(take.performance.values), take.performance.fps
    return send(packets, frames, fps, address, clock, tcp=chosen.tcp)


def rig(
    character: str | PathLike[str],
    *,
    map_file: str | PathLike[str] | None = None,
    take: Take | Callable[[], Take] | None = None,
    output: str | PathLike[str] | None = None,
    settings: Settings | None = None,
) -> tuple[Rig, list[Shown]]:
    """Return what a character (`.glb` with blend shapes) has and how well it shows each of our muscles.

    With `take` (or what makes it, once the files are known to be right) and `output`, a `.glb`, the character
    is written with the take's animation. Of `settings`, the head is read, which performs and measures. Raises
    RisoriusError.
    """
    from .face.arkit_fit import ArkitFit
    from .face.head import head_of
    from .ports.atomic import replacing
    from .ports.glb_file import save_glb
    from .ports.rig import animated, check_performable, read_rig, report

    settings = settings or Settings()
    refuse_all_but(settings, [Stage.HEAD], MEASURED, Place(str(character)))
    found = read_rig(Path(character), None if map_file is None else Path(map_file))
    if take is not None and output is not None:
        (target,) = check_outputs((output,))
        if target.format.suffix not in (".glb", ".rig.glb"):
            raise InputError("is no .glb; expected one for the character", Place(str(output)))
        check_performable(found)
        take = take if isinstance(take, Take) else take()
        track = ArkitFit(take.head, found.shapes).track(take.faces())
        with replacing(Path(output)) as path:
            save_glb(animated(found, track, take.times), path)
    return found, report(found, head_of(settings))


def pose(targets: Mapping[str, float], *, emotion: Emotions = (), settings: Settings | None = None) -> Take:
    """Hold one face: values by muscle, action unit, alias or other parameter, and emotions on top."""
    shown = {display.emotion: display.intensity for display in _displays(emotion)}
    keys = {name: ((0.0, value),) for name, value in _posed(targets, shown).items()}
    held = ManualCurve(keys, Cause("pose", "command"))
    score = Score(0.001, manual=(held,), settings=BlendSettings(contact=False))
    settings = settings or Settings()
    refuse_all_but(settings, [Stage.HEAD, Stage.SKIN, Stage.LOOK], HELD)
    return perform(score, settings)


def pose_values(targets: Mapping[str, float], emotion: Mapping[str, float]) -> Array:
    """Return all parameters of a pose, shape (46,), as `pose` holds them. Raises ParameterError."""
    values = NEUTRAL.copy()
    for name, value in _posed(targets, emotion).items():
        values[INDEX[name]] = value
    return values


def _posed(targets: Mapping[str, float], emotion: Mapping[str, float]) -> dict[str, float]:
    """Return targets with emotions on top, by parameter."""
    units = dict(targets)
    for name, value in blended({emotion_key(name): value for name, value in emotion.items()}).items():
        units[name] = max(units.get(name, 0.0), value, key=abs)
    return resolve_targets(units)


def _displays(emotion: Emotions) -> tuple[Display, ...]:
    if isinstance(emotion, Mapping):
        return tuple(Display(name, intensity) for name, intensity in emotion.items())
    return tuple(emotion)
