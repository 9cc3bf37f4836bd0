from itertools import pairwise

import numpy as np
import pytest

from risorius.core.look import COMPLEXIONS
from risorius.face.head.identity import Looks
from risorius.looks.apply_look import apply_look
from risorius.settings import Look


def test_nothing_chosen_changes_nothing():
    assert apply_look(Looks(), Look()) == Looks()


def test_complexions_darken_steadily():
    light = [sum(apply_look(Looks(), Look(complexion=value)).skin) for value in np.linspace(0, 1, 9)]
    assert all(a > b for a, b in pairwise(light))
    assert light[0] > 2.5 * light[-1]


@pytest.mark.parametrize("value", COMPLEXIONS.values())
def test_skin_is_warm_and_lips_are_redder(value):
    looks = apply_look(Looks(), Look(complexion=value))
    assert looks.skin[0] > looks.skin[1] > looks.skin[2]
    assert looks.lips[0] / looks.lips[1] > looks.skin[0] / looks.skin[1]


@pytest.mark.parametrize("style", ["clay", "muscles", "wireframe"])
def test_plain_matter_is_all_one_and_bald_unless_told(style):
    plain = apply_look(Looks(hair_style="medium"), Look(style=style))
    assert plain.skin == plain.lips == plain.lining == plain.cloth
    assert plain.flush == 0.0
    assert plain.hair_style == "bald"
    assert apply_look(Looks(), Look(style=style, hair="short")).hair_style == "short"
