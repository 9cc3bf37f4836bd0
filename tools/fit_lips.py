"""Fit what the lips' controls do on every head that comes with Risorius, and print how well the fit holds.

Run from the repository's root after a head has been rebuilt, about five seconds for each:
`PYTHONPATH=src python tools/fit_lips.py [NAME …]`. Writes `lips.npz` beside each `head.npz`.
"""

from __future__ import annotations

import argparse

import numpy as np

from risorius.core.lips.articulators import FITTED
from risorius.core.lips.lip_rig import MEASURES
from risorius.face.fit.lip_file import FILE
from risorius.face.fit.lip_fit import AT_REST, LARGEST, MeasuredMouth, fit
from risorius.face.head.head import FORMAT, load_head, shipped_heads

CHECKS = 200


def main() -> None:
    """Fit the heads that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*", default=shipped_heads(), metavar="NAME")
    for name in parser.parse_args().heads:
        head = load_head(name)
        rig, mouth = fit(head), MeasuredMouth(head)
        draw = np.random.default_rng(1)
        settings = draw.random((CHECKS, len(FITTED))) * [LARGEST[control] for control in FITTED]
        settings[draw.random(settings.shape) < AT_REST] = 0.0
        rows = [dict(zip(FITTED, row, strict=True)) for row in settings.tolist()]
        expected = dict(zip(FITTED, settings.T, strict=True))
        measured = np.array([mouth.measure(row) for row in rows]).T
        errors = (
            float(np.abs(rig.passive(measure, expected) - column).max())
            for measure, column in zip(MEASURES, measured, strict=True)
        )
        arrays = {"terms": rig.terms.astype(np.int16), "coefficients": rig.coefficients.astype(np.float32)}
        np.savez_compressed(head.folder / FILE, format=np.int64(FORMAT), **arrays)  # type: ignore[arg-type]
        found = "  ".join(f"{m} {e:.2f}" for m, e in zip(MEASURES, errors, strict=True))
        print(f"{name:10s} largest error of the fit, mm: {found}")


if __name__ == "__main__":
    main()
