"""How soon a live face begins, and what its frames cost.

Run from the repository's root: `.venv/bin/python benchmarks/live.py`; with `--hour` an hour of talk as well.
All in one process, warm: the sentences said first are not counted. The computing of a sentence is what its
first frame costs; the other frames are looked up. Times are of the clock, shares of a core of the processor:
those hold on a busy machine, too.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import resource
import statistics
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import chain, cycle, islice
from pathlib import Path
from typing import Any

from risorius import Live, speak
from risorius.live import hearing
from risorius.live.hearing import HeardPhrase
from risorius.live.voice import VoicedPhrase

SENTENCES = [
    f"The quick brown fox jumps over the {n} dog." for n in ("lazy", "sleepy", "old", "angry", "poor")
]
TALK = (
    "I went to the market this morning. They had no bread at all, so I came home. Do you know what I mean? "
)
IDLE_MINUTES = 10
HEADS = 10
# Seconds that they talk, and in which the processes that perform for them load.
TALKING, LOADING = 12, 4.0


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hour", action="store_true")
    options = parser.parse_args()
    face = Live(fps=60)
    frames = face.frames()
    firsts, rest, count = [], 0.0, 0
    owns = []
    for sentence in ("Warm up.", "It was never seen again in this little town of ours.", *SENTENCES):
        next(frames)
        face.say(sentence)
        face.flush()
        start, computing = time.perf_counter(), time.process_time()
        frame = next(frames)
        while not frame.text:
            frame = next(frames)
        firsts.append(time.perf_counter() - start)
        own = time.process_time() - computing
        owns.append(own)
        start, spoken = time.perf_counter(), 1
        while next(frames).text:
            spoken += 1
        rest, count = rest + time.perf_counter() - start, count + spoken
        after = f"first frame after {firsts[-1] * 1e3:6.0f} ms, {own * 1e3:.0f} ms of it own computing"
        print(f"{after}; the sentence lasts {spoken / 60:.2f} s")
    median, own = (statistics.median(seconds[2:]) * 1e3 for seconds in (firsts, owns))
    print(f"median of the warm ones: {median:.0f} ms, {own:.0f} ms of it own computing")
    print(f"a frame that is not the first: {rest / count * 1e6:.0f} µs")
    voices()
    weights()
    paced()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    for _ in islice(frames, IDLE_MINUTES * 60 * 60):
        pass
    used = time.process_time() - start
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory
    share = used / IDLE_MINUTES / 60
    print(f"{IDLE_MINUTES} idle minutes at 60 fps: {share:.1%} of a core, {grown / 1024:.1f} MB more")
    if options.hour:
        hour()


def weights() -> None:
    """Print what weights cost: one face at 60 frames a second, and many at 30."""
    for faces, fps, seconds in ((1, 60, 10), (HEADS, 30, 4)):
        talking = [Live(fps=fps, arkit=True) for _ in range(faces)]
        iterators = [face.frames() for face in talking]
        for face, frames in zip(talking, iterators, strict=True):
            face.say(TALK * 2)
            next(frames)
        start, computing = time.perf_counter(), time.process_time()
        for frames in iterators:
            for _ in islice(frames, fps * seconds):
                pass
        used, took = time.process_time() - computing, time.perf_counter() - start
        cores = f"{used / seconds:.0%} of a core, {took / seconds:.2f} s for a second in one thread"
        print(f"{faces} talking at {fps} fps with ARKit weights: {cores}")


def paced() -> None:
    """Print whether many faces that talk on and on keep the pace of the clock, each in a thread."""
    talking = [Live(fps=30, arkit=True) for _ in range(HEADS)]
    for face in talking:
        next(face.frames(waits=False))
    time.sleep(LOADING)
    for stagger, about in ((0.0, "at once"), (0.23, "one after the other")):
        start, before = time.perf_counter(), computing(os.getpid())
        with ThreadPoolExecutor(HEADS) as threads:
            waits = [stagger * k for k in range(HEADS)]
            late = list(chain(*threads.map(_lateness, waits)))
        used, took = computing(os.getpid()) - before, time.perf_counter() - start
        missed = sum(seconds > 1.0 / 30.0 for seconds in late) / len(late)
        print(
            f"{HEADS} faces that begin {about}, at 30 fps with ARKit weights: {missed:.1%} of the frames"
            f" are a frame late or more, at most {max(late) * 1e3:.0f} ms; {used / took:.0%} of a core"
        )


def _lateness(wait: float) -> list[float]:
    """Have a face talk, after so many seconds; return by how many its frames come later than they should."""
    time.sleep(wait)
    face, said, late = Live(fps=30, arkit=True), cycle(TALK.split(". ")), []
    face.say(TALK)
    for frame in islice(face.frames(paced=True), 30 * TALKING):
        late.append(time.perf_counter() - frame.time)
        if frame.index % 30 == 0 and face.waiting < 2:
            face.say(f"{next(said)}. ")
    return [seconds - late[0] for seconds in late]


def computing(process: int) -> float:
    """Return the processor time of a process and of those that it has started, in seconds."""
    parents = {process}
    ticks = 0
    for _, pid, parent, used in sorted(_processes()):
        if pid in parents or parent in parents:
            parents.add(pid)
            ticks += used
    return ticks / os.sysconf("SC_CLK_TCK")


def _processes() -> Iterator[tuple[int, int, int, int]]:
    """Yield the start, number, parent and ticks of all processes."""
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            parts = (folder / "stat").read_text().rpartition(")")[2].split()
            yield int(parts[19]), int(folder.name), int(parts[1]), int(parts[11]) + int(parts[12])


def hour() -> None:
    """Print the memory of a face that talks and listens for an hour, every ten minutes."""
    face = Live(fps=30)
    frames, said = face.frames(), cycle(TALK.split(". "))
    for minute in range(1, 61):
        for second in range(60):
            if second % 3 == 0 and face.waiting < 3:
                face.say(f"{next(said)}. ")
            if second % 20 == 19:
                face.interrupt()
            for _ in islice(frames, 30):
                pass
        if minute % 10 == 0:
            print(f"after {minute} minutes: {_resident():.0f} MB")


def _resident() -> float:
    """Return the memory that this process holds, in MB."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 1e6


def voices() -> None:
    """Print how long a face takes for a voice made elsewhere, after the last sample of its phrase."""
    phrase = "She had your dark suit in greasy wash water all year."
    take = speak(phrase, text=True)
    assert take.utterance is not None
    first, last = take.utterance.words[0].start, take.utterance.words[-1].end
    audio = take.utterance.audio
    sound, rate = audio.read()[round((first - 0.1) * audio.sample_rate) :], audio.sample_rate
    sound = sound[: round((last - first + 0.2) * rate)]
    words = [(word.text, word.start - first + 0.1, word.end - first + 0.1) for word in take.utterance.words]
    ways: dict[str, dict[str, Any]] = {
        "words with times": {"words": words},
        "its text": {"text": phrase},
        "nothing": {},
    }
    hear, found = hearing.hear_phrase, []

    def timed(voiced: VoicedPhrase, language: str) -> HeardPhrase:
        start = time.perf_counter()
        heard = hear(voiced, language)
        found.append(time.perf_counter() - start)
        return heard

    hearing.hear_phrase = timed
    for known, about in ways.items():
        beyond = []
        found.clear()
        for _ in range(6):
            face = Live(fps=60)
            frames = face.frames()
            next(frames)
            start = time.perf_counter()
            face.say(audio=sound, rate=rate, **about)
            face.flush()
            next(frames)
            beyond.append(time.perf_counter() - start - found[-1])
        hearing_ms, rest = (1e3 * statistics.median(times[1:]) for times in (found, beyond))
        after = f"its phones found in {hearing_ms:.0f} ms, first frame {rest:.0f} ms later"
        print(f"a voice of {len(sound) / rate:.1f} s, {known} known: {after}")
    hearing.hear_phrase = hear


if __name__ == "__main__":
    main()
