"""The lips' table: names that do not fit are refused, and what the classes leave out is derived."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from risorius.errors import InputError, ParameterError, RisoriusError
from risorius.rules.lips import lip_table, lip_table_of, lip_table_text


def tables() -> dict[str, Any]:
    return tomllib.loads(lip_table_text())


def changed(path: str, value: Any) -> dict[str, Any]:
    whole = tables()
    *parts, last = path.split("/")
    table = whole
    for part in parts:
        table = table[part]
    table[last] = value
    return whole


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("class/labial/precision", {"jaw": 1.0}, "unknown articulator 'jaw'; did you mean"),
        ("class/labial/precision", {"jaw_drop": -1.0}, "jaw_drop"),
        ("phone/B/class", "labal", "unknown class of phones 'labal'; did you mean 'labial'"),
        ("phone/B/targets", {"jaw_dorp": 1.0}, "jaw_dorp"),
        ("onset/Q", {"class": "labial", "targets": {}}, "unknown phone 'Q'"),
        ("diphthong/AY/parts", ["AA", "QQ"], "unknown phone 'QQ'"),
        ("manner/whisper/factors", {"jaw": 1.0}, "unknown articulator 'jaw'"),
    ],
)
def test_names_that_do_not_fit_are_refused(path: str, value: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        lip_table_of(changed(path, value))


def test_a_phone_or_manner_that_the_table_lacks_is_told_the_nearest() -> None:
    with pytest.raises(InputError, match="the diphthong 'AY' has two shapes; expected 'AA' or 'IH'"):
        lip_table().shape("AY")
    with pytest.raises(InputError, match="unknown phone 'QQ'"):
        lip_table().shape("QQ")
    with pytest.raises(ParameterError, match="unknown manner of speech 'wisper'; did you mean 'whisper'"):
        lip_table().factors("wisper", 1.0)


def test_precision_is_the_magnitude_unless_it_is_given() -> None:
    labial = lip_table().holdings["labial"]
    magnitude = {name: held.magnitude for name, held in labial.dominance.items()}
    assert dict(labial.precision) == {**magnitude, "lip_aperture": 6.0}
    without = tables()
    del without["class"]["labial"]["precision"]
    assert dict(lip_table_of(without).holdings["labial"].precision) == magnitude


def test_the_table_lists_only_precisions_that_differ_from_the_magnitude() -> None:
    same = [
        f"{name}.{articulator}"
        for name, values in tables()["class"].items()
        for articulator, precision in values.get("precision", {}).items()
        if values["magnitude"].get(articulator) == precision
    ]
    assert same == []


def test_an_unknown_key_is_refused() -> None:
    with pytest.raises(RisoriusError, match="presision"):
        lip_table_of(changed("class/labial/presision", {}))
