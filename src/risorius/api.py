"""The public functions: speak, align, mix, load, play, pose, rig. They convert arguments and call stages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from .core.movement import Cause, ManualCurve
from .core.performance import announced
from .core.progress import Progress, quiet
from .core.score import BlendSettings, Score
from .errors import InputError, Place, UnusedSettingError, check_number
from .machine.paths import is_file, path_of
from .pipeline import combine, perform
from .ports.curves.performance_json import read_performance_file
from .ports.output_files import check_targets
from .ports.score.score_json import read_score_file
from .rules.emotions import Display, Displays, parse_display
from .rules.poses import posed
from .rules.rule_set import emotions_of
from .settings import BlendChoices, Settings
from .speech import Input, Recording, align_recording, read, read_transcript
from .speech.recordings.recording import read_recording
from .take import Take
from .unused_settings import CAPTURE, CHARACTER, PERFORMANCE, POSE, RECOGNIZED, SCORE, reject, reject_unused

if TYPE_CHECKING:
    from .ports.mesh.rig import MuscleCoverage, Rig

FileName = str | PathLike[str]
Emotions = Mapping[str, float] | str | Iterable[Display | str]
"""Intensities by name, or texts such as "happiness:0.7@1-3", or displays."""


def speak(
    script: FileName | None = None,
    *,
    audio: FileName | None = None,
    transcript: FileName | None = None,
    text: bool = False,
    source: str = "text",
    emotion: Emotions = (),
    settings: Settings | None = None,
    progress: Progress = quiet,
) -> Take:
    """Perform a text or a file (`.txt`, `.xml`, `.TextGrid`, `.score.json` …); `text` forces text, `source`
    names it in messages.

    With the recording `audio` its voice is heard instead of a synthesized one: it says the text, or the words
    of `transcript` (a text, or the name of a file with it), or is labelled by the TextGrid; without any of
    these, it is recognized, which is less exact. `emotion`: intensities 0..1 by name, or "happiness:0.7@1-3"
    as on the command line, or displays. Raises RisoriusError with one line on what is wrong and where.
    """
    settings = checked(settings)
    script, transcript = _text_or_file(script), _text_or_file(transcript)
    audio = None if audio is None else path_of(audio)
    is_score = script is not None and script.lower().endswith(".json") and not text
    if script is not None and is_score:
        choices = {"emotion": emotion or (), "audio": audio, "transcript": transcript}
        return _mix(script, settings, BlendChoices(), progress, **choices)
    displays = displays_of(emotion, settings)
    named = Input(script, audio, transcript, text, source, language=settings.language)
    return perform_input(named, displays, settings, progress)


def perform_input(given: Input, emotions: Displays, settings: Settings, progress: Progress = quiet) -> Take:
    """Read a text, a script or a recording and perform it, showing `emotions` beside those that it marks.

    Raises RisoriusError; UnusedSettingError for settings of a voice where nothing is to be synthesized.
    """
    with emotions_of(settings.rules, settings.expression):  # a fault in it is told before anything is spoken
        source = read(given)
    reject_unused(source, settings)
    return perform(source, emotions, settings, progress)


def align(
    audio: FileName,
    transcript: FileName | None = None,
    *,
    language: str | None = None,
    progress: Progress = quiet,
) -> Take:
    """Return the timed utterance of a recording of `transcript` (a text, or the name of its file).

    `language` is that of the transcript, by default English; without one the words are recognized as English.
    The take's `utterance` has it; the face rests. Raises RisoriusError with one line on what is wrong and
    where.
    """
    if transcript is None and language is not None:
        raise UnusedSettingError(["language"], RECOGNIZED, Place(str(audio)))
    words = read_transcript(_text_or_file(transcript))
    _, utterance = align_recording(Recording(path_of(audio), words, language=language), progress)
    return combine(Score(utterance.duration, text=utterance.text), Settings(), utterance)


def mix(
    score: FileName,
    *,
    settings: Settings | None = None,
    conflict: str | None = None,
    onset_function: str | None = None,
    progress: Progress = quiet,
) -> Take:
    """Combine the movements of a score file; `conflict`, `onset_function` and the choices of `settings.blend`
    override the score's own.

    Raises RisoriusError; UnusedSettingError for settings of a voice or a plan, which a score has behind it.
    """
    settings, choices = checked(settings), BlendChoices(conflict=conflict, onset_function=onset_function)
    return _mix(score, settings, choices, progress)


def _mix(
    score: FileName, settings: Settings, choices: BlendChoices, progress: Progress, **arguments: object
) -> Take:
    """Combine the movements of a score file, after a check of the settings, and of other `arguments`."""
    path = path_of(score)
    reject(settings, SCORE, Place(str(score)), **arguments)
    file = read_score_file(path)
    blend = choices.over(settings.blend.over(file.score.settings))
    movements = announced(replace(file.score, settings=blend), settings.fps, progress)
    return combine(movements, settings, file.utterance)


def load(performance: FileName, *, settings: Settings | None = None) -> Take:
    """Read a `.performance.json` back, with its curves as they were written.

    Raises RisoriusError; UnusedSettingError for settings that would change the curves.
    """
    settings = checked(settings)
    file = read_performance_file(path_of(performance))
    # The file's own frame rate does not count as a change.
    compared = replace(settings, fps=Settings().fps) if settings.fps == file.performance.fps else settings
    reject(compared, PERFORMANCE, Place(str(performance)))
    return Take(file.performance, replace(settings, fps=file.performance.fps), file.utterance)


def play(
    capture: FileName,
    *,
    audio: FileName | None = None,
    settings: Settings | None = None,
    progress: Progress = quiet,
) -> Take:
    """Perform a captured face: `.arkit.csv` (or any CSV of Live Link Face), `.fap`, `.au.csv`, or a score.

    `audio` is a recording that is heard with it. Raises InputError for a file that cannot be used, and for
    settings that nothing reads (UnusedSettingError).
    """
    from .face.head.head import head_of
    from .ports.formats import format_read
    from .ports.import_result import ReadOptions

    settings, path = checked(settings), path_of(capture)
    kind = format_read(path)
    if kind.suffix == ".performance.json":
        take = load(path, settings=settings)
    elif kind.suffix == ".score.json":
        take = mix(path, settings=settings, progress=progress)
    else:
        reject(settings, CAPTURE, Place(str(capture)))
        file = kind.read(path, ReadOptions(partial(head_of, settings), progress))
        take = combine(announced(file.score, settings.fps, progress), settings, file.utterance)
    return take if audio is None else replace(take, sound=read_recording(path_of(audio)))


def pose(targets: Mapping[str, float], *, emotion: Emotions = (), settings: Settings | None = None) -> Take:
    """Hold one face: values by muscle, action unit, alias or other parameter, and emotions on top.

    Raises RisoriusError.
    """
    if not isinstance(targets, Mapping):
        raise InputError(f"{type(targets).__name__} is not a pose; expected values by name: {{'AU12': 0.7}}")
    for name, value in targets.items():
        if not isinstance(name, str):
            raise InputError(f"{type(name).__name__} is not the name of a muscle; expected e.g. 'AU12'")
        check_number(name, value)
    settings = checked(settings)
    reject(settings, POSE)
    displays = displays_of(emotion, settings)
    if any((display.start, display.end, display.priority) != (None, None, None) for display in displays):
        raise UnusedSettingError(
            ["emotion"], "a pose has no times and no priorities; expected NAME:INTENSITY"
        )
    shown = {display.emotion: display.intensity for display in displays}
    keys = {name: ((0.0, value),) for name, value in posed(targets, shown).items()}
    pose_curve = ManualCurve(keys, Cause("pose", "command"))
    score = Score(0.001, manual=(pose_curve,), settings=BlendSettings(contact=False))
    return combine(score, settings)


def rig(
    character: FileName,
    *,
    map_file: FileName | None = None,
    take: Take | Callable[[], Take] | None = None,
    output: FileName | None = None,
    settings: Settings | None = None,
) -> tuple[Rig, list[MuscleCoverage]]:
    """Return a character's (`.glb`) blend shapes, and how well it shows each of our muscles.

    With `take` (or what makes it, once the files are known to be right) and `output`, a `.glb`, the character
    is written with the take's animation. Of `settings`, the head is read, which performs and measures. Raises
    RisoriusError.
    """
    from .face.fit.arkit_fit import ArkitFit
    from .face.head.head import head_of
    from .machine.atomic import replacing
    from .ports.mesh.glb_file import save_glb
    from .ports.mesh.gltf import clip_times
    from .ports.mesh.rig import animated, check_performable, read_rig, report

    settings, path = checked(settings), path_of(character)
    reject(settings, CHARACTER, Place(str(character)))
    rig = read_rig(path, None if map_file is None else path_of(map_file))
    if take is not None and output is not None:
        (target,) = check_targets((output,))
        if target.format.suffix not in (".glb", ".rig.glb"):
            raise InputError("is not a .glb file; expected one for the character", Place(str(output)))
        check_performable(rig)
        take = take if isinstance(take, Take) else take()
        track = ArkitFit(take.head, rig.shapes).track(take.faces())
        with replacing(Path(output)) as path:
            save_glb(animated(rig, track, clip_times(take)), path)
    return rig, report(rig, head_of(settings))


def displays_of(emotion: Emotions, settings: Settings) -> Displays:
    """Return the displays that a user asks for, of our emotions and those of the settings' rules.

    Raises InputError for an invalid display.
    """
    if isinstance(emotion, Mapping):
        emotion = [Display(name, intensity) for name, intensity in emotion.items()]
    elif isinstance(emotion, str):
        emotion = [emotion]
    elif not isinstance(emotion, Iterable):
        raise InputError(_no_emotion(emotion))
    with emotions_of(settings.rules, settings.expression):
        return tuple(map(_display, emotion))


def _display(emotion: object) -> Display:
    if isinstance(emotion, str):
        return parse_display(emotion)
    if not isinstance(emotion, Display) or not isinstance(emotion.emotion, str):
        raise InputError(_no_emotion(emotion))
    check_number(emotion.emotion, emotion.intensity)
    return emotion


def _no_emotion(value: object) -> str:
    kind = type(value).__name__
    return f"{kind} is not an emotion; expected {{'happiness': 0.7}}, 'happiness:0.7@1-3' or a Display"


def _text_or_file(words: object) -> str | None:
    """Return a text, or the name of a file; raise InputError for anything else, and for a missing path."""
    if words is None or isinstance(words, str):
        return words
    if not isinstance(words, PathLike):
        raise InputError(f"{type(words).__name__} cannot be performed; expected a text, or a file's name")
    if not is_file(path := path_of(words)):
        raise InputError("there is no such file", Place(str(path)))
    return str(path)


def checked(settings: Settings | None) -> Settings:
    """Return the settings, by default the usual ones.

    Raises InputError for invalid settings, and for a background that would fail only after all else is done.
    """
    if settings is None:
        return Settings()
    if not isinstance(settings, Settings):
        raise InputError(f"settings are {type(settings).__name__}; expected risorius.Settings(…)")
    if settings.look.background is not None and not settings.look.transparent:
        from .render.backdrop import check_background

        check_background(settings.look.background)
    return settings
