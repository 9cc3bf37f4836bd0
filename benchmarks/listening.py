"""How fast recordings are aligned and their prosody measured, and how memory grows with their length.

Run from the repository's root: `.venv/bin/python benchmarks/listening.py`. The voice is synthesized: speed
does not depend on whose it is. Targets: alignment 10x and prosody 50x real time of one core, memory bounded.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
import warnings

from risorius.speech import synthesize_line
from risorius.speech.alignment import align
from risorius.speech.prosody import measured

SENTENCE = "Oh, really? I like it very much. My baby brother put the map by the beam. "
PER_MINUTE = 11
MINUTES = (1, 5, 20)


def measure(minutes: int) -> None:
    """Print the figures for one length; memory is that of this whole process."""
    text = SENTENCE * PER_MINUTE * minutes
    audio = synthesize_line(text).audio
    before = time.process_time()
    utterance = align(audio, text)
    between = time.process_time()
    measured(utterance)
    after = time.process_time()
    print(
        f"{audio.duration / 60:5.1f} min: alignment {audio.duration / (between - before):.0f}x, "
        f"prosody {audio.duration / (after - between):.0f}x real time, "
        f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB"
    )


if __name__ == "__main__":
    if len(sys.argv) > 1:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            measure(int(sys.argv[1]))
    else:
        for minutes in MINUTES:
            subprocess.run([sys.executable, __file__, str(minutes)], check=True)
