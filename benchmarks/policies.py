"""Against the others' way: what each conflict policy does to speech under strong emotions.

Twelve sentences rich in /p b m f v w/ are performed under each of the six emotions at full strength, by each
policy, with the lips' limits and contact goals and without. A second set has no rounded and no closed phone:
there nothing inhibits a smile.
Run from the repository (about two minutes):
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/policies.py [--markdown] [--emotions happiness …]
`--markdown` writes the tables into docs/combination.md, between its markers.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from policy_measures import HAIR, Result, cases, measure

from risorius.core.parameters import BASES, INDEX

POLICIES = ("inhibit", "graded", "attenuate", "sum")
EMOTIONS = ("anger", "disgust", "fear", "happiness", "sadness", "surprise")
SENTENCES = (
    "My baby brother put the map by the beam.",
    "We have five more waves before we move the boat.",
    "Please bring the book back to Mom by Monday.",
    "Why would Peter ever buy a broken van?",
    "Maybe the problem will vanish, but I believe we must wait for proof.",
    "Bob proved Pam was wrong about the whole movie.",
    "Papa may swim above the white boulder.",
    "A few brave women and five puppies won the match.",
    "Warm wool, fine velvet, and a pair of brown mittens.",
    "Move the lamp, if you please, over to the front window.",
    "Both of them wept when the ambulance left for Vermont.",
    "The pompous bishop swept by, and nobody ever waved.",
)
OPEN_SENTENCES = (
    "It is easy in this city.",
    "Nancy gets ten nickels.",
    "Did Dan hide the candy?",
    "Let the cat in again.",
    "Then Annie ate his cake.",
    "I can sit still in the high hat.",
    "Hannah takes the night east.",
    "Ken needs a day in the sand.",
    "The kitten tickles Dinah's heel.",
    "That gang had nice things.",
)
SMILE = [INDEX[p.name] for base in ("zygomatic_major", "zygomatic_minor") for p in BASES[base]]

Found = dict[tuple[str, bool], dict[str, Result]]
"""Results by policy and whether limits and goals hold, then by emotion."""


@dataclass(frozen=True)
class Smile:
    """What is left of a smile, at least, in speech without rounded or closed phones."""

    policy: str
    sentences: int
    least_kept: float


def smiles(policies: Sequence[str]) -> Iterator[Smile]:
    """Yield for each policy the least share that any sentence leaves of a smile's zygomatics."""
    found = cases(OPEN_SENTENCES, "happiness")
    for policy in policies:
        least = 1.0
        for case in found:
            values, level = case.combined(policy).at(case.times)[:, SMILE], case.display[:, SMILE]
            shown = level > HAIR
            least = min(least, float((values[shown] / level[shown]).min()))
        yield Smile(policy, len(found), least)


def bench(emotions: Sequence[str], policies: Sequence[str]) -> Found:
    """Return the results of all performances."""
    found: Found = {(policy, guarded): {} for guarded in (True, False) for policy in policies}
    for emotion in emotions:
        for case in cases(SENTENCES, emotion):
            for policy, guarded in found:
                total = found[policy, guarded].setdefault(emotion, Result())
                total.add(measure(case, emotion, policy, guarded))
    return found


def _total(results: Iterable[Result]) -> Result:
    total = Result()
    for result in results:
        total.add(result)
    return total


def _percent(share: float) -> str:
    """Return a share in percent; 100 % and 0 % only where they are exact."""
    if 0.0 < share < 1.0:
        return f"{min(max(100.0 * share, 0.1), 99.9):.1f} %"
    return f"{100.0 * share:.0f} %"


HEADER = (
    "policy", "limits and goals", "closures held", "widest gap", "rivals shown", "both above 0.3",
    "rounding lost", "cycles per s", "of a muscle", "of any muscle", "largest step",
    "kept speaking", "of the mouth", "kept in silence",
)  # fmt: skip


def policy_rows(found: Found) -> Iterator[tuple[str, ...]]:
    """Yield the main table: one row per policy, with limits and goals and without."""
    yield HEADER
    for (policy, guarded), by_emotion in found.items():
        total = _total(by_emotion.values())
        yield (
            f"`{policy}`",
            "yes" if guarded else "no",
            _percent(total.held / total.closures),
            f"{total.worst_gap_mm:.2f} mm",
            _percent(total.conflicting / total.frames),
            _percent(total.strongly / total.frames),
            f"{total.widened_mm / total.rounded:.2f} mm",
            f"{total.display_flutter()[0]:.2f}",
            f"{total.flutter()[0]:.2f}",
            f"{total.flutter(everything=True)[0]:.2f}",
            f"{total.largest_jump:.2f}",
            *(_percent(total.share(what)) for what in ("speaking", "mouth speaking", "silent")),
        )


def emotion_rows(found: Found) -> Iterator[tuple[str, ...]]:
    """Yield by emotion, under limits and goals: cycles per second, and what the mouth keeps in speech."""
    policies = [policy for policy, guarded in found if guarded]
    yield ("emotion", *(f"`{policy}`" for policy in policies))
    for emotion in found[policies[0], True]:
        results = [found[policy, True][emotion] for policy in policies]
        yield (
            emotion,
            *(f"{r.display_flutter()[0]:.2f} · {_percent(r.share('mouth speaking'))}" for r in results),
        )


def smile_rows(found: Iterable[Smile]) -> Iterator[tuple[str, ...]]:
    """Yield what is left of a smile in open speech."""
    yield ("policy", "sentences", "least that a smile keeps")
    for smile in found:
        yield (f"`{smile.policy}`", str(smile.sentences), _percent(smile.least_kept))


def markdown(rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table."""
    header, *body = rows
    lines = [header, ("---",) * len(header), *body]
    return "\n".join(f"| {' | '.join(row)} |" for row in lines)


def write_between(page: Path, marker: str, text: str) -> None:
    """Replace what stands between `<!-- marker -->` and `<!-- /marker -->` in a page."""
    opening, closing = f"<!-- {marker} -->", f"<!-- /{marker} -->"
    before, _, rest = page.read_text().partition(opening)
    _, found, after = rest.partition(closing)
    if not found:
        raise SystemExit(f"{page}: no {opening} … {closing}")
    page.write_text(f"{before}{opening}\n{text}\n{closing}{after}")


def main() -> None:
    """Measure, print the tables, and write them where asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--markdown", action="store_true", help="write the tables into docs/combination.md")
    parser.add_argument("--emotions", nargs="+", choices=EMOTIONS, default=EMOTIONS)
    parser.add_argument("--policies", nargs="+", choices=POLICIES, default=POLICIES)
    options = parser.parse_args()
    found = bench(options.emotions, options.policies)
    tables = {
        "policies": markdown(policy_rows(found)),
        "policies by emotion": markdown(emotion_rows(found)),
        "open speech": markdown(smile_rows(smiles(options.policies))),
    }
    for name, table in tables.items():
        print(f"{name}\n{table}\n")
        if options.markdown:
            page = Path(__file__).parent.parent / "docs" / "combination.md"
            write_between(page, name, table)
    for (policy, guarded), by_emotion in found.items():
        total = _total(by_emotion.values())
        for everything in (False, True):
            rate, name = total.flutter(everything)
            print(f"{policy}, {'with' if guarded else 'without'} limits: {rate:.2f} cycles/s of {name}")
    spoken = _total(found[options.policies[0], True].values())
    print(f"{spoken.closures} closures, {spoken.speech_s:.0f} s of speech")


if __name__ == "__main__":
    main()
