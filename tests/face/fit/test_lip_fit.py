"""Articulators in millimetres are what the mesh measures, on every head."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from risorius.core.lips.articulators import ARTICULATORS, FITTED
from risorius.core.lips.lip_rig import MEASURES, RAISER, LipRig, rig_of_fit
from risorius.core.parameters import DEFAULT_THRESHOLD, INDEX, NEUTRAL, RIVALS
from risorius.errors import HeadError
from risorius.face.fit.lip_file import FILE, load_lip_rig
from risorius.face.fit.lip_fit import MeasuredMouth
from risorius.face.fit.measure import Gauge
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.solve import FaceSolver
from risorius.rules.lips import lip_table
from tests.profiles import everyday

CLOSE_MM = 0.6
UPPER_EDGE = 62  # iBUG: the middle of the upper lip's inner edge
ROUNDED = {"jaw_drop": 3.0, "lip_aperture": 6.0, "lip_width": -3.0, "lip_protrusion": 2.0}
POSES = (
    ROUNDED,
    {"jaw_drop": 2.0, "lip_aperture": 4.0},
    {"jaw_drop": 9.0, "lip_aperture": 13.0},
    {"jaw_drop": 1.0, "lip_aperture": 2.0},
    {"jaw_drop": 6.0, "lip_aperture": 7.0},
    {"jaw_drop": 3.0, "lip_aperture": 5.0, "lip_width": 2.0},
    {"jaw_drop": 2.0, "lip_aperture": 4.0, "lip_width": -13.0, "lip_protrusion": 4.0},
    {"jaw_drop": 4.0, "lip_aperture": 6.0, "lip_width": -7.0, "lip_protrusion": 1.5},
    {"jaw_drop": 1.4, "lip_aperture": 4.2, "lip_width": -8.0, "lip_protrusion": 2.7},
    {"jaw_drop": 1.4, "lip_aperture": 4.2, "upper_lip": 0.5},
    {"jaw_drop": 1.0, "lip_aperture": 2.0, "lip_corners": 1.5},
    {"jaw_drop": 1.0, "lip_aperture": 2.0, "lip_corners": -1.5},
)


def muscles(rig: LipRig, targets: Mapping[str, float]) -> dict[str, float]:
    (held,) = rig.actives([targets])
    made = rig.parameters(lambda name: np.array([held.get(name, 0.0)]), held)
    return {name: float(value[0]) for name, value in made.items()}


def values(made: Mapping[str, float]) -> np.ndarray:
    found = NEUTRAL.copy()
    for name, value in made.items():
        found[INDEX[name]] = value
    return found


def conflicting(muscle: str) -> list[str]:
    """Return its rivals, without those that the lips' own opening moves (`CompiledLips.harmless`)."""
    return [rival for rival in RIVALS[muscle] if not rival.startswith(RAISER)]


def test_a_broken_file_is_named(tmp_path: Path) -> None:
    head = tmp_path / "broken"
    shutil.copytree(load_head().folder, head)
    np.savez(head / FILE, format=np.int64(1), terms=np.zeros((2, 3), np.int16))
    with pytest.raises(HeadError, match="coefficients"):
        load_lip_rig(str(head))


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard"]))
def test_targets_are_what_the_mesh_measures(name: str) -> None:
    rig, mouth = load_lip_rig(name), MeasuredMouth(load_head(name))
    for pose in POSES:
        measured = dict(zip(MEASURES, mouth.measure_values(values(muscles(rig, pose))), strict=True))
        for articulator in ("lip_aperture", "lip_width", "lip_protrusion", "lip_corners"):
            if articulator in pose:
                assert measured[articulator] == pytest.approx(pose[articulator], abs=CLOSE_MM), pose


@pytest.mark.parametrize("gap", [9.0, 14.0, 20.0])
def test_a_wide_mouth_without_a_jaw_inhibits_no_smile(gap: float) -> None:
    made = muscles(load_lip_rig(), {"jaw_drop": 2.0, "lip_aperture": gap})
    assert made["depressor_labii.left"] > 0.3
    assert max(made.get(rival, 0.0) for rival in conflicting("zygomatic_major.left")) <= DEFAULT_THRESHOLD


@pytest.mark.parametrize("phone", ["IY", "IH", "EH", "AE", "AA", "AH", "S", "T", "K", "N", "TH"])
def test_unrounded_phones_have_no_funneler_and_inhibit_no_smile(phone: str) -> None:
    made = muscles(load_lip_rig(), lip_table().shape(phone).targets)
    assert made.get("orbicularis_oris_funneler", 0.0) == 0.0
    for rival in conflicting("zygomatic_major.left"):
        assert made.get(rival, 0.0) < DEFAULT_THRESHOLD


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard", "kwame"]))
@pytest.mark.parametrize("phone", ["AA", "AE", "EH"])
def test_the_upper_lip_takes_a_third_of_what_an_open_vowel_opens(name: str, phone: str) -> None:
    """Beyond the chin's drop (facts: lips-motion, 9), at the lips' inner edges."""
    targets = lip_table().shape(phone).targets
    face, gauge = FaceSolver(load_head(name)), Gauge(load_head(name))
    shown, rest = (
        gauge.landmarks(face.solve(v))[UPPER_EDGE, 1]
        for v in (values(muscles(load_lip_rig(name), targets)), NEUTRAL)
    )
    opened = targets["lip_aperture"] - targets["jaw_drop"]
    assert 0.28 < (shown - rest) / opened < 0.40


def test_a_fit_s_variables_are_separated() -> None:
    """What a fit's `open` raises by itself is `upper` in the rig, which moves one muscle by each control."""
    terms = load_lip_rig().terms
    made = LipRig(terms, np.random.default_rng(3).normal(size=(len(terms), len(MEASURES))))
    rig = rig_of_fit(made.terms, made.coefficients)
    own = {"jaw": 0.3, "open": 0.4, "upper": 0.25, "round": 0.2}
    fitted = own | {"upper": own["upper"] - FITTED["open"]["levator_labii_superioris"] * own["open"]}
    for measure in MEASURES:
        controls = ({n: np.array(v) for n, v in c.items()} for c in (own, fitted))
        separated, together = (r.passive(measure, c) for r, c in zip((rig, made), controls, strict=True))
        assert separated == pytest.approx(float(together))


def test_a_vowel_keeps_its_width_beside_lowered_corners() -> None:
    mouth, sad = MeasuredMouth(load_head()), {"triangularis.left": 0.85, "triangularis.right": 0.85}
    vowel = muscles(load_lip_rig(), lip_table().shape("IY").targets)
    open_alone = {name: value for name, value in vowel.items() if not name.startswith(("zygo", "riso"))}
    wide = MEASURES.index("lip_width")
    shown = [mouth.measure_values(values(made | sad))[wide] for made in (vowel, open_alone)]
    alone = [mouth.measure_values(values(made))[wide] for made in (vowel, open_alone)]
    assert alone[0] - alone[1] > 1.5
    assert shown[0] - shown[1] == pytest.approx(alone[0] - alone[1], abs=0.3)


def test_a_closed_mouth_is_sealed_and_pressed() -> None:
    made = muscles(load_lip_rig(), {"jaw_drop": 1.2, "lip_aperture": -2.0})
    assert 0.4 < made["lip_seal"] <= 1.0
    assert made["orbicularis_oris_presser"] > 0.1
    assert made["depressor_labii.left"] == 0.0


def test_rest_moves_nothing() -> None:
    made = muscles(load_lip_rig(), dict.fromkeys(ARTICULATORS, 0.0))
    assert max(made.values()) == 0.0
