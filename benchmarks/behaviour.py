"""Ten minutes of speech per profile, measured as studies measure people, beside what they published.

Also a shuffle test: where accents are permuted among the words, brows and head meet them by chance alone. Run
from the repository:
    PYTHONPATH=src python benchmarks/behaviour.py [--minutes 10] [--profile neutral …]
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from behaviour_measures import (
    NEAR,
    STILL,
    Clip,
    accent_peaks,
    accent_speeds,
    accented,
    aligned,
    blinks,
    brow_raises,
    head_power,
    head_speed,
    inner_pause_speeds,
    main_sequence,
    nods,
    saccades,
    sampled,
    sentence_ranges,
    visits,
)

from risorius.channels import ChannelInputs, compose
from risorius.core.speech.utterance import Utterance
from risorius.rules.profiles import profile, profiles
from risorius.script import read_script
from risorius.speech import synthesize_script

BANDS = Path(__file__).parent / "bands.toml"
SHUFFLES = 200
TEXT = """
Good morning, and thank you for coming. I want to tell you about the harbour, because it nearly was not built.
In the spring of that year a storm took the old pier, and nobody had the money for another one.
Who would pay for it? The town was small, the fishermen were poor, and the council, well, the council waited.
Then a woman called Marta Lind walked into the meeting. She had a drawing under her arm!
She said that stone was too expensive, but that timber was not, and that they could begin on Monday.
Can you imagine the silence? Forty people looked at the paper. Somebody laughed, somebody else did not.
It took eleven months, three hundred oak trunks and more patience than anybody had expected.
The second winter was harder. Ice came down the river, the engines froze, and the work stopped for weeks.
Marta wrote letters. She wrote to the bank, to the minister, to her brother in Boston.
Um, most of them never answered. You know how it is with letters.
But one did, and that was enough. A small cheque arrived in March, with a note that said only: continue.
So they continued. When the first ship came in, the children rang every bell they could find.
I was one of those children. I still remember the sound, and the smell of wet rope.
Why am I telling you this today? Because the harbour needs us again, and because we still have the drawing.
"""


def speech(minutes: float) -> Iterator[tuple[int, Utterance]]:
    """Yield stretches of speech of a minute or so, until there is enough."""
    said = synthesize_script(read_script(" ".join(TEXT.split()), text=True))
    for seed in range(round(minutes * 60.0 / said.duration + 0.49)):
        yield seed, said


def clips(name: str, minutes: float) -> list[Clip]:
    """Return the performances of a profile."""
    found = []
    for seed, said in speech(minutes):
        inputs = ChannelInputs(said.duration, said, profile=profile(name))
        found.append(sampled(compose(inputs, seed=seed, without=("lips",)), said))
    return found


def measured(found: list[Clip]) -> dict[str, float]:
    """Return all measures, by the names of the table of bands."""
    seconds = sum(clip.said.duration for clip in found)
    shut = [blink for clip in found for blink in blinks(clip)]
    gaps = np.concatenate([np.diff([b[0] for b in blinks(clip)]) for clip in found])
    mutual, away = ([s for clip in found for s in visits(clip)[i]] for i in (0, 1))
    jumps = np.concatenate([saccades(clip) for clip in found])
    slope, base = np.polyfit(jumps[:, 0], jumps[:, 1], 1)
    speeds = np.array([accent_speeds(clip) for clip in found]).mean(axis=0)
    paused = np.concatenate([head_speed(clip)[clip.pausing] for clip in found])
    still = [head_speed(clip) < STILL for clip in found]
    raises = [brow_raises(clip) for clip in found]
    leads = np.concatenate([_leads(r, accented(clip.said)) for r, clip in zip(raises, found, strict=True)])
    moving = {
        "speaking": np.mean([1.0 - s[c.speaking].mean() for s, c in zip(still, found, strict=True)]),
        "pauses": np.mean([1.0 - s[c.pausing].mean() for s, c in zip(still, found, strict=True)]),
    }
    return {
        "blinks_per_minute": 60.0 * len(shut) / seconds,
        "blink_seconds": float(np.median([b[2] for b in shut])),
        "blink_closing_share": float(np.median([b[1] / b[2] for b in shut])),
        "complete_blinks": float(np.mean([b[3] > 0.97 for b in shut])),
        "blink_depth": float(np.mean([b[3] for b in shut])),
        "blink_interval_median": float(np.median(gaps)),
        "blink_interval_variation": float(gaps.std() / gaps.mean()),
        "mutual_gaze": sum(mutual) / (sum(mutual) + sum(away)),
        "mutual_seconds": float(np.mean(mutual)),
        "away_seconds": float(np.mean(away)),
        "saccade_base": float(base),
        "saccade_per_degree": float(slope),
        "saccade_degrees": float(jumps[:, 0].mean()),
        "saccade_speed": float(np.mean(jumps[:, 2] / main_sequence(jumps[:, 0]))),
        "head_speed_accents": float(speeds[0]),
        "head_speed_elsewhere": float(speeds[1]),
        "head_speed_ratio": float(speeds[0] / speeds[1]),
        "head_speed_pauses": float(paused.mean()),
        **_inner_pauses(found),
        **{
            f"head_{axis}_deviation": float(np.mean([c.curves[f"head_{axis}"].std() for c in found]))
            for axis in ("pitch", "yaw", "roll")
        },
        "head_pitch_range": float(np.mean([r for c in found for r in sentence_ranges(c)])),
        "head_moving_speaking": float(moving["speaking"]),
        "head_moving_pauses": float(moving["pauses"]),
        "head_slow": float(np.mean([head_power(c, 0.2, 1.85) for c in found])),
        "head_ordinary": float(np.mean([head_power(c, 1.85, 3.65) for c in found])),
        "head_rapid": float(np.mean([head_power(c, 3.65, 7.0) for c in found])),
        "brow_raises_per_accent": float(
            np.mean([aligned(r, accented(c.said), NEAR) for r, c in zip(raises, found, strict=True)])
        ),
        "brow_lead": float(np.median(leads[np.abs(leads) < NEAR])),
        "brows_near_accents": float(np.mean(np.abs(leads) <= NEAR)),
    }


def _inner_pauses(found: list[Clip]) -> dict[str, float]:
    """Return how fast the head is in pauses between words, and as shares of its speed in speech."""
    pauses = [inner_pause_speeds(clip) for clip in found]
    speech = [head_speed(clip)[clip.speaking].mean() for clip in found]
    shares = np.concatenate([p[:, 0] / s for p, s in zip(pauses, speech, strict=True)])
    peaks = np.concatenate([p[:, 1] / accent_peaks(c).mean() for p, c in zip(pauses, found, strict=True)])
    return {
        "head_speed_inner_pauses": float(np.concatenate(pauses)[:, 0].mean()),
        "head_pause_share": float(shares.mean()),
        "head_slow_pauses": float(np.mean((shares < 0.5) & (peaks < 1.0))),
    }


def _leads(raises: list[float], accents: np.ndarray) -> np.ndarray:
    """Return by how many seconds each rise begins before the accent nearest to it."""
    if not raises:
        return np.empty(0)
    differences = np.subtract.outer(accents, np.array(raises))
    return differences[np.abs(differences).argmin(axis=0), np.arange(len(raises))]


def shuffled(found: list[Clip]) -> dict[str, tuple[float, float, float]]:
    """Return how well brows and nods meet the accents, and mean and deviation where accents are permuted."""
    rng = np.random.default_rng(0)
    result = {}
    for name, detect in (("brows", brow_raises), ("nods", nods)):
        events = [detect(clip) for clip in found]
        true = np.mean([aligned(e, accented(c.said), 0.12) for e, c in zip(events, found, strict=True)])
        chance = [
            np.mean([aligned(e, _permuted(c.said, rng), 0.12) for e, c in zip(events, found, strict=True)])
            for _ in range(SHUFFLES)
        ]
        result[name] = (float(true), float(np.mean(chance)), float(np.std(chance)))
    return result


def _permuted(said: Utterance, rng: np.random.Generator) -> np.ndarray:
    """Return accents on as many syllables, of words drawn at random."""
    words = rng.choice(len(said.words), size=len(said.accents), replace=False)
    first = {s.word: i for i, s in reversed(list(enumerate(said.syllables)))}
    accents = [
        replace(a, word=int(w), syllable=first[int(w)]) for a, w in zip(said.accents, words, strict=True)
    ]
    return accented(replace(said, accents=tuple(accents)))


def report(name: str, minutes: float) -> bool:
    """Print a profile's table; return whether all that is judged lies within its band."""
    found = clips(name, minutes)
    values, bands = measured(found), tomllib.loads(BANDS.read_text())
    print(f"\n{name}: {sum(c.said.duration for c in found) / 60:.1f} minutes")
    inside = True
    for key, value in values.items():
        band = bands[key].get("band")
        verdict = "" if band is None else "in" if band[0] <= value <= band[1] else "OUT"
        inside &= verdict != "OUT"
        print(f"  {key:26}{value:8.4g}  {verdict:4} {bands[key]['published']} ({bands[key]['source']})")
    for part, (true, chance, deviation) in shuffled(found).items():
        print(
            f"  {part} begin within 120 ms of {true:.1%} of accents; of permuted ones {chance:.1%} ± "
            f"{deviation:.1%}: {(true - chance) / deviation:.1f} deviations above chance"
        )
    return inside


def main() -> None:
    """Print a table for each profile."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=10.0)
    options.add_argument("--profile", action="append", choices=list(profiles()))
    chosen = options.parse_args()
    for name in chosen.profile or profiles():
        print("all within bands" if report(name, chosen.minutes) else "NOT all within bands")


if __name__ == "__main__":
    main()
