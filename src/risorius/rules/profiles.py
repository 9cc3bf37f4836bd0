"""Profiles of speakers, and attitudes that modify them (paper B, section 3.2.1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, cast

from ..core.action_units import resolve_targets
from ..core.choices import BLINK_MODELS
from ..core.parameters import INDEX, PARAMETERS, Kind
from ..core.units import DeviationDegrees, HabitSeconds, Share, SignedShare
from ..errors import InputError, ParameterError, unknown
from ..reading.frozen import FrozenDict
from ..reading.hints import Range
from ..reading.schema import build
from ..reading.source_text import SourceText
from ..reading.toml import read_tables, read_text
from .load import DATA, load_folder
from .modulation import Modulation, ModulationFactor
from .rule import Rule

NEUTRAL = "neutral"
Normal = tuple[HabitSeconds, HabitSeconds]
"""Mean and standard deviation."""


@dataclass(frozen=True, slots=True)
class BlinkHabits:
    """The habits of blinking. Seconds.

    `model`: one of `BLINK_MODELS`. `interval`: of the log-normal distribution of "natural" times from the end
    of a blink to the next, the median and the standard deviation of the logarithm. `wait`: the typical wait
    of "itti" after a saccade or blink. `period`: from blink to blink of "pelachaud". `closing`, `closed` and
    `opening` of a natural blink; the others' are printed in their sources. `incomplete`: the share of blinks
    that close only in part, within `depth`. `shift`: the probability that a shift of gaze by 33 degrees
    brings a blink.
    """

    model: Literal["natural", "itti", "pelachaud", "none"]
    interval: tuple[Annotated[float, Range(0.2, 60.0)], Annotated[float, Range(0.0, 2.0)]]
    wait: Annotated[float, Range(0.2, 60.0)]
    period: Annotated[float, Range(0.5, 60.0)]
    closing: Annotated[float, Range(0.04, 1.0)]
    closed: HabitSeconds
    opening: Annotated[float, Range(0.04, 1.0)]
    incomplete: Share
    depth: tuple[Share, Share]
    shift: Share


@dataclass(frozen=True, slots=True)
class Aversion:
    """Looking away: mean and deviation of the seconds that it lasts and that pass before the next."""

    length: Normal
    gap: Normal


@dataclass(frozen=True, slots=True)
class GazeHabits:
    """The habits of the eyes when no rule directs them.

    `speaking`, `listening`: how the eyes leave the listener; `directions`: weights of up, down and side;
    `pitch`, `yaw`: mean and deviation of how far they go, degrees; `scan`: mean seconds of a fixation on the
    listener's face, and its deviations in pitch and yaw; `zone`: degrees of a shift that the eyes make alone.
    """

    speaking: Aversion
    listening: Aversion
    directions: Mapping[str, Share]
    pitch: tuple[DeviationDegrees, DeviationDegrees]
    yaw: tuple[DeviationDegrees, DeviationDegrees]
    scan: HabitSeconds
    scan_pitch: DeviationDegrees
    scan_yaw: DeviationDegrees
    zone: DeviationDegrees


@dataclass(frozen=True, slots=True)
class HeadHabits:
    """The smooth noise of a living head: deviations in degrees, seconds from one target to the next.

    `comma`, `final`: what is left of it in such pauses; `listening`: while another speaks. `melody`: degrees
    of pitch by standard deviation of a syllable's pitch, if the sound was measured.
    """

    pitch: DeviationDegrees
    yaw: DeviationDegrees
    roll: DeviationDegrees
    dwell: tuple[HabitSeconds, HabitSeconds]
    comma: Share
    final: Share
    listening: Share
    melody: DeviationDegrees


def _check_posture(posture: Mapping[str, float]) -> None:
    for name in resolve_targets(posture):
        if PARAMETERS[INDEX[name]].kind not in (Kind.MUSCLE, Kind.HEAD):
            raise ParameterError(f"{name} cannot be held as a posture; expected muscles or the head")


def _check_rules(rules: Sequence[Rule]) -> None:
    names = [rule.id for rule in rules]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InputError(f"rule '{twice}' is given twice; expected it once")


@dataclass(frozen=True, slots=True)
class Profile:
    """A speaker. `side`: how much the left is preferred, -1 to 1. `posture`: targets held throughout.

    `rates`, `sizes`: as in `Modulation`. `age`, `wrinkles`: the skin's, unless the user chooses; the
    head's own if None. `rule`, `delete`: as in a file of rules, for this speaker.
    """

    name: str
    description: str
    source: str
    blinks: BlinkHabits
    gaze: GazeHabits
    head: HeadHabits
    side: SignedShare = 0.0
    rates: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)
    sizes: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)
    posture: Mapping[str, float] = field(default_factory=FrozenDict)
    age: Annotated[float, Range(0.0, 100.0)] | None = None
    wrinkles: Mapping[str, Annotated[float, Range(0.0, 2.0)]] = field(default_factory=FrozenDict)
    rule: tuple[Rule, ...] = ()
    delete: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _check_posture(self.posture)
        _check_rules(self.rule)
        for name in self.gaze.directions:
            if name not in ("up", "down", "side"):
                raise ParameterError(unknown("direction", name, ("up", "down", "side")))
        if not sum(self.gaze.directions.values()) > 0.0:
            raise InputError("all directions of gaze have weight 0; expected at least one above 0")

    @property
    def modulation(self) -> Modulation:
        """The modulation of the speaker's rules."""
        return Modulation(self.rates, self.sizes)


@dataclass(frozen=True, slots=True)
class Attitude:
    """An attitude that the speaker conveys: a modulation of the rules, and targets held throughout.

    `rule`, `delete`: as in a file of rules, for one who has the attitude.
    """

    name: str
    description: str
    source: str
    rates: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)
    sizes: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)
    posture: Mapping[str, float] = field(default_factory=FrozenDict)
    rule: tuple[Rule, ...] = ()
    delete: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _check_posture(self.posture)
        _check_rules(self.rule)

    @property
    def modulation(self) -> Modulation:
        """The modulation of the speaker's rules."""
        return Modulation(self.rates, self.sizes)


@cache
def profiles() -> Mapping[str, Profile]:
    """Return the package's profiles by name."""
    texts = profile_texts()
    return FrozenDict(
        {name: profile_from(text, f"profiles/{name}.toml", texts) for name, text in texts.items()}
    )


@cache
def profile_texts() -> Mapping[str, str]:
    """Return the texts of the package's profiles by name."""
    folder = DATA / "profiles"
    names = sorted(entry.name for entry in folder.iterdir() if entry.name.endswith(".toml"))
    return FrozenDict(
        {name.removesuffix(".toml"): (folder / name).read_text(encoding="utf-8") for name in names}
    )


def profile_from(text: str, name: str, bases: Mapping[str, str]) -> Profile:
    """Return the profile of TOML `text`; keys that it leaves out come from its base, one of `bases`.

    Raises InputError, with its place, if it does not fit.
    """
    source = SourceText(name, text)
    data = read_tables(text, name)
    seen = [data.get("name")]
    while (base := data.get("base")) is not None:
        if not isinstance(base, str) or base not in bases:
            raise source.error(("base",), unknown("profile", str(base), bases))
        if base in seen:
            raise source.error(("base",), f"profile '{base}' is based on itself; expected another base")
        seen.append(base)
        under = read_tables(bases[base], base)
        data = {**_merged(under, data), "base": under.get("base")}
    data.pop("base", None)
    return build(Profile, data, source)


def _merged(under: dict[str, Any], over: dict[str, Any]) -> dict[str, Any]:
    both = {**under, **over}
    if isinstance(under.get("rule"), list) and isinstance(over.get("rule"), list):
        own = {rule.get("id") for rule in over["rule"] if isinstance(rule, dict)}
        both["rule"] = [*(rule for rule in under["rule"] if rule.get("id") not in own), *over["rule"]]
    for key in under.keys() & over.keys():
        if isinstance(under[key], dict) and isinstance(over[key], dict):
            both[key] = _merged(under[key], over[key])
    return both


@cache
def attitudes() -> Mapping[str, Attitude]:
    """Return the package's attitudes by name."""
    return FrozenDict({a.name: a for a in load_folder(Attitude, "attitudes").values()})


def profile_of(name: str, blinks: str | None = None) -> Profile:
    """Return the profile of that name, or of a file (`.toml`) whose base, if any, is one of ours.

    `blinks`: a model of blinks in place of the profile's own, one of `BLINK_MODELS`.
    """
    if name.endswith(".toml"):
        chosen = profile_from(read_text(Path(name)), name, profile_texts())
    else:
        chosen = profile(name)
    if blinks is None:
        return chosen
    if blinks not in BLINK_MODELS:
        raise ParameterError(unknown("model of blinks", blinks, BLINK_MODELS))
    return replace(chosen, blinks=replace(chosen.blinks, model=cast(Any, blinks)))


def profile(name: str) -> Profile:
    """Return the profile `name`; raise ParameterError, with the nearest one, if it is unknown."""
    if name not in profiles():
        raise ParameterError(unknown("profile", name, profiles()))
    return profiles()[name]


def attitude(name: str) -> Attitude:
    """Return the attitude `name`; raise ParameterError, with the nearest one, if it is unknown."""
    if name not in attitudes():
        raise ParameterError(unknown("attitude", name, attitudes()))
    return attitudes()[name]
