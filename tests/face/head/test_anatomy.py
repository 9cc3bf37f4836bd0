"""The anatomical mode: fields from lines of pull, as near to the sculpts as what was tried before."""

from __future__ import annotations

import shutil
from dataclasses import replace

import numpy as np
import pytest

from risorius.errors import HeadError
from risorius.face.head.anatomy import FILE, Skin, anatomical_fields, from_line, load_pulls
from risorius.face.head.head import load_head, required_fields, shipped_heads
from risorius.face.head.muscle_table import Force, load_muscles
from risorius.face.solve import FaceSolver
from tests.profiles import everyday

from ..conftest import EMOTIONS, values_of

BASES = tuple(dict.fromkeys(name.partition(".")[0] for name in required_fields()))
# R² against the calibrated fields, as tools/fit_anatomy.py prints them, and a little less. Weights along the
# line of pull alone reach .74 (frontalis) to .99 (presser), and fail for funneler and blink.
FLOORS = {
    "zygomatic_major": 0.99,
    "zygomatic_minor": 0.98,
    "triangularis": 0.985,
    "risorius": 0.985,
    "depressor_labii": 0.975,
    "mentalis": 0.975,
    "orbicularis_oris_funneler": 0.99,
    "orbicularis_oris_presser": 0.99,
    "frontalis_medialis": 0.955,
    "frontalis_lateralis": 0.97,
    "levator_labii_nasi": 0.96,
    "levator_labii_superioris": 0.985,
    "depressor_supercilii": 0.975,
    "corrugator_supercilii": 0.98,
    "depressor_glabellae": 0.955,
    "levator_palpebrae": 0.965,
    "orbicularis_oculi_palpebralis": 0.915,
    "orbicularis_oculi_orbitalis": 0.99,
    "lip_tuck": 0.98,
}


@pytest.fixture(scope="module")
def fields(head):
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    muscles, pulls = load_muscles(head.folder), load_pulls(head.folder, BASES)
    return anatomical_fields(skin, head.mirror, muscles, pulls, required_fields())


@pytest.mark.parametrize("name", ["orbicularis_oris_funneler", "lip_tuck"])
def test_a_type_that_the_weights_do_not_fit_is_named(head, name):
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    muscles, pulls = load_muscles(head.folder), load_pulls(head.folder, (name,))
    muscles[name] = replace(muscles[name], type="sphincter")
    with pytest.raises(
        HeadError, match=rf"muscles\.toml.*'{name}': type 'sphincter' pulls in 3 .* expected .* 4"
    ):
        anatomical_fields(skin, head.mirror, muscles, pulls, (name,))


def dense(head, field):
    whole = np.zeros_like(head.rest)
    whole[field[0]] = field[1]
    return whole


def test_a_file_of_weights_that_is_not_there_or_lacks_a_muscle(head, tmp_path):
    with pytest.raises(HeadError, match=r"anatomy\.npz: not a file of muscle weights"):
        load_pulls(tmp_path, BASES)
    with pytest.raises(HeadError, match="platysma"):
        load_pulls(head.folder, ("platysma",))
    (tmp_path / FILE).write_bytes(b"nonsense")
    with pytest.raises(HeadError, match="not a file of muscle weights"):
        load_pulls(tmp_path, BASES)


@pytest.mark.parametrize("base", BASES)
def test_fields_are_near_the_calibrated_ones(head, fields, base):
    name = base if base in fields else f"{base}.left"
    sculpt, found = dense(head, head.fields[name]), dense(head, fields[name])
    assert 1.0 - ((sculpt - found) ** 2).sum() / (sculpt**2).sum() >= FLOORS[base]


def test_left_and_right_are_mirror_images(head, fields):
    left, right = (dense(head, fields[f"zygomatic_major.{side}"]) for side in ("left", "right"))
    np.testing.assert_allclose(right[head.mirror] * [-1.0, 1.0, 1.0], left, atol=0.05)


def test_distance_from_a_line(head):
    row = load_muscles(head.folder)["zygomatic_major"]
    ends = np.array(row.line)
    np.testing.assert_allclose(from_line(row, ends), 0.0, atol=1e-12)
    beyond = ends[1] + 7.0 * (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    np.testing.assert_allclose(from_line(row, beyond[None]), 7.0)


def test_a_head_without_sculpts_performs(head, tmp_path):
    with np.load(head.folder / "head.npz") as archive:
        arrays = {name: archive[name] for name in archive.files if not name.startswith("field/")}
    np.savez(tmp_path / "head.npz", **arrays)
    plain = load_head(tmp_path)
    assert set(plain.fields) == set(head.fields)
    one, other = FaceSolver(head), FaceSolver(plain)
    rest = head.skin.matrix @ head.rest
    for targets in EMOTIONS.values():
        wanted, found = (s.solve(values_of(targets)).skin - rest for s in (one, other))
        assert ((wanted - found) ** 2).sum() < 0.1 * (wanted**2).sum()


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard", "olaf"]))
def test_every_head_can_be_moved_by_lines_of_pull(name):
    sculpted, pulled = load_head(name), load_head(name, muscles="lines")
    smile = dense(sculpted, sculpted.fields["zygomatic_major.left"])
    found = dense(pulled, pulled.fields["zygomatic_major.left"])
    assert (smile * found).sum() > 0.9 * np.linalg.norm(smile) * np.linalg.norm(found)
    assert np.abs(smile - found).max() > 0.01


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('type = "linear"\nline = [[50.0, -30.0, -8.0]', 'type = "sheet"\nline = [[50.0, -30.0, -8.0]'),
        ("line = [[50.0, -30.0, -8.0]", "line = [[50.0, -10.0, -8.0]"),
        ("[23.0, -64.0, 15.0]]\nzone = 30.0", "[23.0, -64.0, 15.0]]\nzone = 6.0"),
    ],
)
def test_types_lines_and_zones_of_a_table_act(head, tmp_path, old, new):
    for file in head.folder.glob("*.*"):
        if file.name in {"head.npz", "muscles.toml", "identity.toml"}:
            shutil.copy(file, tmp_path)
    table = tmp_path / "muscles.toml"
    text = table.read_text()
    assert text.count(old) == 1
    table.write_text(text.replace(old, new))
    usual, changed = load_head(muscles="lines"), load_head(tmp_path, muscles="lines")
    before, after = (dense(h, h.fields["zygomatic_major.left"]) for h in (usual, changed))
    assert np.linalg.norm(after - before, axis=1).max() > 0.5
    same = (dense(h, h.fields["mentalis.left"]) for h in (usual, changed))
    np.testing.assert_array_equal(*same)


UPPER = Force("sheet", ((24.0, 28.0, 20.0), (23.0, -64.0, 15.0)), 12.0, 3.0)
OUTWARD = Force("bulge", ((50.0, -30.0, -8.0), (23.0, -64.0, 15.0)), 15.0, 2.0)
ROUND = Force("sphincter", ((33.0, -5.0, 15.0), (45.0, -5.0, 10.0)), 16.0, 1.5)


@pytest.mark.parametrize("forces", [(UPPER,), (OUTWARD,), (ROUND,), (UPPER, OUTWARD, ROUND)])
def test_a_muscle_gathers_forces_of_several_lines_and_types(head, fields, forces):
    """Paper B, section 6.1: each moves the skin by its own; together they add up."""
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    muscles, pulls = load_muscles(head.folder), load_pulls(head.folder, ("zygomatic_major",))
    names = ("zygomatic_major.left", "zygomatic_major.right")

    def moved(gathered):
        table = {"zygomatic_major": replace(muscles["zygomatic_major"], gathered=gathered)}
        found = anatomical_fields(skin, head.mirror, table, pulls, names)
        return [dense(head, found[name]) for name in names]

    own, right = moved(())
    np.testing.assert_array_equal(own, dense(head, fields[names[0]]))
    added, mirrored = moved(forces)
    alone = [moved((force,))[0] - own for force in forces]
    # Small displacements are left out of a field, so that sums differ by as much.
    np.testing.assert_allclose(added - own, sum(alone), atol=0.1)
    for force, field in zip(forces, alone, strict=True):
        assert np.linalg.norm(field, axis=1).max() == pytest.approx(force.moves, abs=0.1)
    np.testing.assert_allclose(mirrored[head.mirror] * [-1.0, 1.0, 1.0], added, atol=0.06)
    assert np.abs(mirrored - right).max() > 0.5


def test_each_type_of_a_gathered_force_moves_the_skin_its_way(head):
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    row, pull = load_muscles(head.folder)["mentalis"], load_pulls(head.folder, ("mentalis",))["mentalis"]
    origin, end = np.array([30.0, -20.0, 18.0]), np.array([30.0, -45.0, 18.0])
    own = skin.displaced(row, pull)
    middle = np.linalg.norm(head.rest - (origin + end) / 2.0, axis=1).argmin()
    for kind, direction in {
        "linear": (0, 1, 0), "sheet": (0, 1, 0), "protrusion": (0, -1, 0), "bulge": (0, 1, 1),
        "sphincter": (0, 1, 0), "rotation": (0, 0, 1),
    }.items():  # fmt: skip
        force = Force(kind, (tuple(origin), tuple(end)), 20.0, 2.0)
        way = (skin.displaced(replace(row, gathered=(force,)), pull) - own)[middle]
        assert abs(way @ direction) > 0.8 * np.linalg.norm(way) * np.linalg.norm(direction) > 0.0, kind


def test_a_gathered_force_off_the_skin_is_named(head):
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    muscles, pulls = load_muscles(head.folder), load_pulls(head.folder, ("mentalis",))
    far = Force("linear", ((500.0, 0.0, 0.0), (510.0, 0.0, 0.0)), 5.0, 1.0)
    muscles["mentalis"] = replace(muscles["mentalis"], gathered=(far,))
    with pytest.raises(HeadError, match=r"muscles\.toml: muscle 'mentalis': no skin lies within 5 mm"):
        anatomical_fields(skin, head.mirror, muscles, pulls, ("mentalis.left",))


def test_gathered_forces_of_a_table_act(head, tmp_path):
    for file in head.folder.glob("*.*"):
        if file.name in {"head.npz", "muscles.toml", "identity.toml"}:
            shutil.copy(file, tmp_path)
    table = tmp_path / "muscles.toml"
    force = '{ type = "sheet", line = [[24.0, 28.0, 20.0], [23.0, -64.0, 15.0]], zone = 12.0, moves = 3.0 }'
    table.write_text(table.read_text().replace("[mentalis]\n", f"[mentalis]\ngathered = [{force}]\n", 1))
    usual, changed = load_head(muscles="lines"), load_head(tmp_path, muscles="lines")
    before, after = (dense(h, h.fields["mentalis.left"]) for h in (usual, changed))
    assert np.linalg.norm(after - before, axis=1).max() == pytest.approx(3.0, abs=0.1)


def test_a_head_that_lacks_one_field_only_is_refused(head, tmp_path):
    with np.load(head.folder / "head.npz") as archive:
        arrays = {name: archive[name] for name in archive.files if not name.startswith("field/mentalis.left")}
    np.savez(tmp_path / "head.npz", **arrays)
    with pytest.raises(HeadError, match=r"field/mentalis\.left/vertices' is missing"):
        load_head(tmp_path)
