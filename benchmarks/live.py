"""How soon a live face begins, and what its frames cost.

Run from the repository's root: `.venv/bin/python benchmarks/live.py`. All in one process, warm: the sentence
said first is not counted. The computing of a sentence is what its first frame costs; the other frames are
looked up.
"""

from __future__ import annotations

import resource
import statistics
import time
from itertools import islice
from typing import Any

from risorius import Live, speak
from risorius.live.hearing import hear_phrase
from risorius.live.voice import Known, VoicedPhrase
from risorius.speech.alignment.timed_words import TimedWord

SENTENCES = [
    f"The quick brown fox jumps over the lazy dog, for the {n} time." for n in ("first", "next", "last")
]
IDLE_MINUTES = 10
KNOWN = {"words with times": Known.TIMES, "its text": Known.TEXT, "nothing": Known.NOTHING}


def main() -> None:
    """Print the figures."""
    face = Live(fps=60)
    frames = face.frames()
    firsts, rest, count = [], 0.0, 0
    for sentence in ("Warm up.", *SENTENCES):
        next(frames)
        face.say(sentence)
        face.flush()
        start, computing = time.perf_counter(), time.process_time()
        frame = next(frames)
        while not frame.text:
            frame = next(frames)
        firsts.append(time.perf_counter() - start)
        own = time.process_time() - computing
        start, spoken = time.perf_counter(), 1
        while next(frames).text:
            spoken += 1
        rest, count = rest + time.perf_counter() - start, count + spoken
        after = f"first frame after {firsts[-1] * 1e3:6.0f} ms, {own * 1e3:.0f} ms of it own computing"
        print(f"{after}; the sentence lasts {spoken / 60:.2f} s")
    print(f"median of the warm ones: {statistics.median(firsts[1:]) * 1e3:.0f} ms")
    print(f"a frame that is not the first: {rest / count * 1e6:.0f} µs")
    voices()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    for _ in islice(frames, IDLE_MINUTES * 60 * 60):
        pass
    used = time.process_time() - start
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory
    share = used / IDLE_MINUTES / 60
    print(f"{IDLE_MINUTES} idle minutes at 60 fps: {share:.1%} of a core, {grown / 1024:.1f} MB more")


def voices() -> None:
    """Print how long a face takes for a voice made elsewhere, after the last sample of its phrase."""
    phrase = "She had your dark suit in greasy wash water all year."
    take = speak(phrase, text=True)
    assert take.audio is not None
    assert take.utterance is not None
    words = [(word.text, word.start, word.end) for word in take.utterance.words]
    sound, rate = take.audio.read(), take.audio.sample_rate
    ways: dict[str, dict[str, Any]] = {
        "words with times": {"words": words},
        "its text": {"text": phrase},
        "nothing": {},
    }
    for known, about in ways.items():
        spent = []
        for _ in range(4):
            face = Live(fps=60)
            frames = face.frames()
            next(frames)
            start = time.perf_counter()
            face.say(audio=sound, rate=rate, **about)
            face.flush()
            next(frames)
            spent.append(time.perf_counter() - start)
        hearing = []
        for _ in range(4):
            phrase_heard = VoicedPhrase(
                sound,
                rate,
                KNOWN[known],
                about.get("text", ""),
                tuple(TimedWord(*w) for w in about.get("words", ())),
            )
            start = time.perf_counter()
            hear_phrase(phrase_heard, "en-us")
            hearing.append(time.perf_counter() - start)
        whole, found = (1e3 * statistics.median(times[1:]) for times in (spent, hearing))
        after = f"first frame after {whole:.0f} ms, {found:.0f} ms of it to find the phones"
        print(f"a voice of {len(sound) / rate:.1f} s, {known} known: {after}")


if __name__ == "__main__":
    main()
