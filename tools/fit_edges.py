"""Learn how the aligner's edges are off, and what edges between phones sound like, from labelled speech.

Run from the repository's root: `python tools/fit_edges.py FOLDER [OUT]`, FOLDER in TIMIT's layout
(`benchmarks/timit.py`). It prints how far edges are from the labels, each speaker judged by what was learned
from the others, then learns from all and writes `edges.npz`, with its provenance beside it, to the folder OUT
(`src/risorius/speech/alignment/data`).
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

sys.path.insert(0, str(Path(__file__).parent.parent / "benchmarks"))
from headbuild.pack import write_npz
from timit import Label, Sentence, matched, sentences

from risorius.core.arrays import AnyArray, Array, BoolArray, Int64Array
from risorius.languages.phones import inventory
from risorius.speech.alignment.aligner import decoded
from risorius.speech.alignment.edges import CLASSES, FEATURES, FILE, REACH, candidate_features, model_of
from risorius.speech.alignment.lexicon import read_transcript
from risorius.speech.alignment.spectra import STEP_SECONDS, band_levels
from risorius.speech.alignment.speech_activity import Condensed
from risorius.speech.recordings.recording import read_recording
from risorius.speech.resampled import Resampled

DATA = Path("src/risorius/speech/alignment/data")
NUMBERS = {phone: CLASSES.index(sound) for phone, sound in inventory().sound_classes().items()}
Learned = dict[str, AnyArray]
"""The arrays of the file by name (`model_of`)."""
# A median of n errors is weighted n / (n + PRIOR_ERRORS).
PRIOR_ERRORS = 3
# Penalties on squared weights: common to all edges, and of one class.
COMMON_PENALTY, CLASS_PENALTY = 1.0, 10.0
# Seconds: the assumed accuracy of labels.
LABEL_SPREAD = 0.005
# Errors beyond this are other phones than those labelled.
MISMATCH = 0.15


@dataclass(frozen=True)
class Edges:
    """Edges of many sentences, shape (n,) each: classes, seconds before and as labelled; their sentences."""

    left: Int64Array
    right: Int64Array
    before: Array
    labelled: Array
    sentence: Int64Array

    def where(self, chosen: BoolArray) -> Edges:
        """Return some of the edges."""
        return Edges(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))


def collect(spoken: list[Sentence]) -> tuple[Edges, list[Array]]:
    """Return the decoder's edges with their labels, and each sentence's band levels."""
    rows: list[tuple[int, int, float, float, int]] = []
    levels: list[Array] = []
    for number, sentence in enumerate(spoken):
        resampled = Resampled(read_recording(sentence.sound))
        _, words = read_transcript(sentence.text)
        seconds = resampled.audio.duration
        whole = Condensed(resampled.audio, ((0.0, seconds),), seconds)
        found = decoded(whole, [word.readings for word in words]).rough
        levels.append(band_levels(resampled.read(0.0, resampled.audio.duration)))
        ours = [Label(f.symbol, f.start, f.end) for f in found]
        for i, j in matched(ours, sentence.labels):
            error = ours[i].start - sentence.labels[j].start
            if i and (ours[i].symbol == "") == (sentence.labels[j].symbol == "") and abs(error) < MISMATCH:
                pair = NUMBERS[ours[i - 1].symbol], NUMBERS[ours[i].symbol]
                rows.append((*pair, ours[i].start, sentence.labels[j].start, number))
    left, right, before, labelled, which = np.array(rows).T
    classes = left.astype(np.int64), right.astype(np.int64)
    return Edges(*classes, before, labelled, which.astype(np.int64)), levels


def fit(edges: Edges, levels: list[Array]) -> Learned:
    """Return the arrays that are learned from edges."""
    bias = median_errors(edges)
    steps = np.round((edges.before - bias[edges.left, edges.right]) / STEP_SECONDS).astype(np.int64)
    features = gathered(edges, steps, levels)
    times = (steps[:, None] + np.arange(-REACH, REACH + 1)) * STEP_SECONDS
    near = np.abs(edges.labelled - times[:, REACH]) < REACH * STEP_SECONDS
    wanted = np.exp(-0.5 * ((times - edges.labelled[:, None]) / LABEL_SPREAD) ** 2)[near]
    wanted /= wanted.sum(axis=1, keepdims=True)
    scale = features[near].std(axis=(0, 1)) + 1e-9
    weights = logit(features[near] / scale, wanted, edges.where(near)) / scale
    return tabulated(bias, weights)


def median_errors(edges: Edges) -> Array:
    """Return the decoder's median error by class to the left and right, drawn to 0 where edges are few."""
    count = len(CLASSES)
    bias = np.zeros((count, count))
    for pair in np.ndindex(count, count):
        errors = (edges.before - edges.labelled)[(edges.left == pair[0]) & (edges.right == pair[1])]
        if len(errors):
            bias[pair] = np.median(errors) * len(errors) / (len(errors) + PRIOR_ERRORS)
    return bias


def gathered(edges: Edges, steps: Int64Array, levels: list[Array]) -> Array:
    """Return the features of all candidates, shape (n, candidates, features)."""
    features = np.empty((len(steps), 2 * REACH + 1, len(FEATURES)))
    for number in np.unique(edges.sentence):
        inside = edges.sentence == number
        features[inside] = candidate_features(levels[number], steps[inside])
    return features


def logit(features: Array, wanted: Array, edges: Edges) -> Array:
    """Return weights (1 + 2 classes, features) of a conditional logit: common, by left, by right class."""
    count = len(CLASSES)
    shape = (1 + 2 * count, len(FEATURES))
    penalty = np.full((shape[0], 1), CLASS_PENALTY)
    penalty[0] = COMMON_PENALTY

    def loss(flat: Array) -> tuple[float, Array]:
        weights = flat.reshape(shape)
        own = weights[0] + weights[1 + edges.left] + weights[1 + count + edges.right]
        scores = np.einsum("ecf,ef->ec", features, own)
        scores -= scores.max(axis=1, keepdims=True)
        total = np.exp(scores).sum(axis=1, keepdims=True)
        slope = np.einsum("ec,ecf->ef", np.exp(scores) / total - wanted, features)
        gradient = penalty * weights
        gradient[0] += slope.sum(axis=0)
        np.add.at(gradient, 1 + edges.left, slope)
        np.add.at(gradient, 1 + count + edges.right, slope)
        surprise = -float((wanted * (scores - np.log(total))).sum())
        return surprise + 0.5 * float((penalty * weights**2).sum()), gradient.ravel()

    start = np.zeros(shape[0] * shape[1])
    found = minimize(loss, start, jac=True, method="L-BFGS-B", options={"maxiter": 200})
    return np.asarray(found.x.reshape(shape))


def tabulated(bias: Array, weights: Array) -> Learned:
    """Return what was learned as the arrays of the file, rounded."""
    count, rounded = len(CLASSES), weights.round(3)
    return {
        "classes": np.array([str(name) for name in CLASSES]),
        "features": np.array(FEATURES),
        "bias": bias.round(4),
        "common": rounded[0],
        "left": rounded[1 : 1 + count],
        "right": rounded[1 + count :],
    }


def errors(edges: Edges, levels: list[Array], learned: Learned) -> dict[str, Array]:
    """Return the errors in seconds of the decoder's edges, of those less their bias, and of those placed."""
    model = model_of(learned)
    corrected = edges.before - model.bias[edges.left, edges.right]
    steps = np.round(corrected / STEP_SECONDS).astype(np.int64)
    weights = model.left[edges.left] + model.right[edges.right]
    scores = np.einsum("ecf,ef->ec", gathered(edges, steps, levels), weights)
    chosen = (steps + scores.argmax(axis=1) - REACH) * STEP_SECONDS
    found = {"decoder": edges.before, "less bias": corrected, "placed": chosen}
    return {name: times - edges.labelled for name, times in found.items()}


def cross_validated(edges: Edges, levels: list[Array], speakers: npt.NDArray[np.str_]) -> Iterator[str]:
    """Yield lines on how well edges are placed for speakers from whom nothing was learned."""
    found: dict[str, list[Array]] = {}
    for speaker in np.unique(speakers):
        held_out = speakers[edges.sentence] == speaker
        learned = fit(edges.where(~held_out), levels)
        for name, values in errors(edges.where(held_out), levels, learned).items():
            found.setdefault(name, []).append(np.abs(values))
    for name, parts in found.items():
        away = np.concatenate(parts)
        within = "  ".join(f"{100 * (away <= ms / 1000).mean():.1f} % in {ms} ms" for ms in (10, 20, 30, 50))
        yield f"{name:10s} {within}  median {1000 * np.median(away):.1f} ms  ({len(away)} edges)"


def provenance(speakers: int, count: int) -> str:
    """Return the text that stands beside the file."""
    return f"""# Edges between phones: where they come from
Licence: CC0 1.0. Author: the Risorius project.

`{FILE}` was learned by `tools/fit_edges.py` from {count} edges in hand-labelled sentences of {speakers}
speakers of TIMIT (Garofolo et al. 1993): statistics only, nothing of the recordings. Its arrays:

| array | shape | |
|---|---|---|
| `classes` | ({len(CLASSES)},) | classes of phones, `SoundClass` of `languages/phones.py` |
| `features` | ({len(FEATURES)},) | the step of the levels in 12 bands at the edge, the levels before and \
after, their sum from the corrected edge on; the size of the step, near and far; the distance moved, plain \
and squared |
| `bias` | (classes, classes) | seconds by which the decoder's edges are late, by class to left and right |
| `common` | (features,) | weights common to all edges |
| `left`, `right` | (classes, features) | weights of the class to the left and to the right |
"""


def main(folder: Path, out: Path) -> None:
    """Print the cross-validated figures and write what is learned to the folder `out`."""
    spoken = list(sentences(folder))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        edges, levels = collect(spoken)
    speakers = np.array([sentence.speaker for sentence in spoken])
    for line in cross_validated(edges, levels, speakers):
        print(line)
    out.mkdir(parents=True, exist_ok=True)
    write_npz(out / FILE, fit(edges, levels))
    text = provenance(len(np.unique(speakers)), len(edges.before))
    (out / "PROVENANCE.md").write_text(text, encoding="utf-8")
    print(f"Wrote {out / FILE}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else DATA)
