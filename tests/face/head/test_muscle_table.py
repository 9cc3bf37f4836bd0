from __future__ import annotations

import re
import shutil

import pytest

from risorius.core.parameters import MUSCLES
from risorius.errors import HeadError, InputError
from risorius.face.head.muscle_table import NAMES, ForceType, load_muscles


@pytest.fixture
def changed(head, tmp_path):
    """A function that loads the table with a pattern replaced."""

    def load(pattern, replacement):
        text = (head.folder / "muscles.toml").read_text(encoding="utf-8")
        (tmp_path / "muscles.toml").write_text(re.sub(pattern, replacement, text, count=1), encoding="utf-8")
        return load_muscles(tmp_path)

    return load


@pytest.mark.parametrize(
    ("pattern", "replacement", "error", "message"),
    [
        (r"\[mentalis\]", "[mentalus]", HeadError, "unknown muscle 'mentalus'; did you mean 'mentalis'"),
        (r'type = "bulge"', 'type = "swell"', InputError, "expected one of linear, sheet, sphincter"),
        (r"zone = 30.0", "zone = -3", InputError, "zone = -3"),
        (r"zone = 30.0", "zones = 30.0", InputError, "zones"),
        (r"line = .*", "line = [[0, 0, 0], [0, 0]]", InputError, "line"),
        (r"line = .*", "line = [[1, 2, 3], [1, 2, 3]]", InputError, "no length"),
        (r"\[risorius\]\n(?:.+\n)*", "", HeadError, "muscle 'risorius' is missing"),
    ],
)
def test_a_table_that_does_not_fit_is_named(changed, pattern, replacement, error, message):
    with pytest.raises(error, match=re.escape(message)):
        changed(pattern, replacement)


def test_a_table_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match=r"muscles\.toml: cannot be read"):
        load_muscles(tmp_path)


def test_every_muscle_has_its_row_and_every_type_a_muscle(head):
    table = head.muscles()
    assert set(table) == {m.base for m in MUSCLES} | {"lip_tuck"} == set(NAMES)
    assert {row.type for row, _ in table.values()} == set(ForceType.__args__)
    assert all(row.source and row.origin and row.insertion and row.action for row, _ in table.values())


def test_lines_lie_on_the_subjects_left(head):
    for row, _ in head.muscles().values():
        assert all(point[0] >= 0.0 for point in row.line)


def test_rows_know_their_links(head):
    links = head.muscles()["levator_labii_superioris"][1]
    assert 0.0 < links["levator_labii_nasi"] < 1.0
    assert "corrugator_supercilii (other side)" in head.muscles()["corrugator_supercilii"][1]


def test_a_head_without_tables_has_those_of_the_standard_one(head, tmp_path):
    from risorius.face.head.head import load_head

    shutil.copy(head.folder / "head.npz", tmp_path)
    plain = load_head(tmp_path)
    assert plain.links_file is None
    assert plain.muscles() == head.muscles()
