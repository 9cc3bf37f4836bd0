#!/bin/sh
# pocketsphinx's Decoder.seg() gives acoustic scores on two scales: the option bestpath=False divides their logarithms by 1,024, so that
# right and wrong words of a forced grammar all score about 0.9.
# Expected (put down after the run): segments with the same frames have the same ascore with and without bestpath. That ascore does
# not separate right from wrong words had been met by chance; the factor had not.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pocketsphinx==5.1.1 espeakng-loader==0.2.4 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import ctypes
import math
import sys

import espeakng_loader
import numpy as np
import pocketsphinx

pieces = []


@ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p)
def take(samples, count, events):
    if count > 0:
        pieces.append(ctypes.string_at(samples, 2 * count))
    return 0


def speech(text):
    espeak = ctypes.CDLL(espeakng_loader.get_library_path())
    rate = espeak.espeak_Initialize(1, 0, espeakng_loader.get_data_path().encode(), 0)
    espeak.espeak_SetSynthCallback(take)
    espeak.espeak_SetVoiceByName(b"en-us")
    espeak.espeak_Synth(text, len(text) + 1, 0, 1, 0, 1, None, None)
    espeak.espeak_Synchronize()
    sound = np.frombuffer(b"".join(pieces), "<i2")
    times = np.arange(int(len(sound) * 16000 / rate)) * rate / 16000
    return np.interp(times, np.arange(len(sound)), sound).astype("<i2").tobytes()


def scores(words, bestpath):
    decoder = pocketsphinx.Decoder(lm=None, samprate=16000, loglevel="FATAL", bestpath=bestpath)
    decoder.set_align_text(words)
    decoder.start_utt()
    decoder.process_raw(sound, full_utt=True)
    decoder.end_utt()
    return {(s.word, s.start_frame, s.end_frame): s.ascore for s in decoder.seg() if 0 < s.ascore < 1}


sound = speech(b"the old man walked his dog along the river before breakfast")
wrong = "the old man walked his elephant along the mountain before breakfast"
whole, scaled = (scores(wrong, bestpath) for bestpath in (True, False))
# A new word after the first has another context; the first words' spans and scores are those of one search.
first = next(segment for segment in whole if segment in scaled)
factor = math.log(whole[first]) / math.log(scaled[first])
of_word = {word: score for (word, _, _), score in scaled.items()}
print("version: pocketsphinx 5.1.1")
print(f"behaviour: '{first[0]}' of frames {first[1]} to {first[2]} scores {whole[first]:.3g} with bestpath, {scaled[first]:.3g} without:")
print(f"           the logarithms stand {factor:.1f} to 1. Without it the wrong words elephant {of_word['elephant']:.3f} and mountain")
print(f"           {of_word['mountain']:.3f} stand beside the right ones along {of_word['along']:.3f} and man {of_word['man']:.3f}")
print("expected: one scale, whatever the option")
same = abs(factor - 1024) < 5 and of_word["elephant"] > 0.5 and of_word["mountain"] > 0.5
sys.exit(0 if same else "the behaviour has changed")
PY
