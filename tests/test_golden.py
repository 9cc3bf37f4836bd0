"""Curves, vertices and pictures stay what they were (tests/golden)."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from .golden.cases import CURVES, FOLDER, PICTURES, SKINS, stored_arrays
from .golden.similarity import structural_similarity

RENEW = "if that is meant, run tools/renew_goldens.py"


def test_pictures_of_different_shapes_are_not_compared() -> None:
    with pytest.raises(ValueError, match="expected the same shape"):
        structural_similarity(np.zeros((9, 9, 3), np.uint8), np.zeros((9, 10, 3), np.uint8))


def test_a_duller_highlight_is_seen() -> None:
    """The measure notices a change that a viewer would: here a patch of 12 × 12 pixels at half its value."""
    picture = np.asarray(Image.open(FOLDER / "happiness.png"))
    duller = picture.copy()
    duller[60:72, 60:72] //= 2
    assert structural_similarity(picture, picture) == pytest.approx(1.0)
    assert structural_similarity(picture, duller) < 0.999


@pytest.mark.parametrize("name", CURVES)
def test_curves_agree(name: str) -> None:
    np.testing.assert_allclose(CURVES[name](), stored_arrays(name), rtol=0, atol=1e-6, err_msg=RENEW)


@pytest.mark.parametrize("name", SKINS)
def test_vertices_agree(name: str) -> None:
    np.testing.assert_allclose(SKINS[name](), stored_arrays(name), rtol=0, atol=1e-4, err_msg=RENEW)


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_agree(name: str) -> None:
    golden = np.asarray(Image.open(FOLDER / f"{name}.png"))
    assert structural_similarity(PICTURES[name](), golden) >= 0.999, RENEW


def test_every_golden_file_belongs_to_a_case() -> None:
    files = {path.stem for path in FOLDER.iterdir() if path.suffix in (".npz", ".png")}
    assert files == {*CURVES, *SKINS, *PICTURES}
