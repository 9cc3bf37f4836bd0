import numpy as np
import pytest

from risorius.ports.mesh.basis import ClipBasis, nonnegative


def test_a_clip_that_rests_needs_no_shape() -> None:
    rest = np.zeros((5, 3))
    basis = ClipBasis(rest)
    for _ in range(3):
        basis.show(rest)
    shapes, weights = basis.finish()
    assert shapes.shape == (0, 5, 3)
    assert weights.shape == (3, 0)
    assert basis.residual == (0.0, 0.0)


def test_three_movements_need_three_shapes() -> None:
    rng = np.random.default_rng(1)
    rest, movements = rng.normal(size=(50, 3)), rng.normal(size=(3, 50, 3))
    amounts = rng.normal(size=(40, 3))
    basis = ClipBasis(rest, tolerance=1e-3)
    frames = rest + np.einsum("fk,knc->fnc", amounts, movements)
    for frame in frames:
        basis.show(frame)
    shapes, weights = basis.finish()
    assert len(shapes) == 3
    assert np.abs(rest + np.einsum("fk,knc->fnc", weights, shapes) - frames).max() < 1e-4
    assert np.abs(weights).max() <= 1.0 + 1e-12


def test_the_residual_is_what_is_left_over() -> None:
    rng = np.random.default_rng(2)
    rest, frames = np.zeros((20, 3)), rng.normal(size=(12, 20, 3))
    basis = ClipBasis(rest, tolerance=0.1, most=4)
    for frame in frames:
        basis.show(frame)
    shapes, weights = basis.finish()
    distance = np.linalg.norm(np.einsum("fk,knc->fnc", weights, shapes) - frames, axis=2)
    assert basis.residual == pytest.approx((np.sqrt((distance**2).mean()), distance.max()), rel=1e-4)


def test_points_that_begin_to_move_later_join_the_shapes() -> None:
    rng = np.random.default_rng(3)
    rest, movements = rng.normal(size=(30, 3)), np.zeros((2, 30, 3))
    movements[0, 20:25], movements[1, 5:10] = rng.normal(size=(2, 5, 3))
    amounts = np.stack([np.linspace(-1.0, 1.0, 80), np.maximum(np.linspace(-3.0, 1.0, 80), 0.0)], axis=1)
    frames = rest.astype(np.float32) + np.einsum("fk,knc->fnc", amounts, movements)
    basis = ClipBasis(rest, tolerance=1e-3)
    for frame in frames:
        basis.show(frame)
    shapes, weights = basis.finish()
    assert len(shapes) == 2
    assert np.abs(rest + np.einsum("fk,knc->fnc", weights, shapes) - frames).max() < 1e-4
    assert not shapes[:, :5].any()


def test_important_points_are_nearer_than_others() -> None:
    rng = np.random.default_rng(4)
    rest, frames = np.zeros((20, 3)), rng.normal(size=(60, 20, 3))
    importance = np.where(np.arange(20) < 5, 8.0, 1.0)
    found = []
    for each in (None, importance):
        basis = ClipBasis(rest, tolerance=1.5, most=60, importance=each)
        for frame in frames:
            basis.show(frame)
        shapes, weights = basis.finish()
        distance = np.linalg.norm(np.einsum("fk,knc->fnc", weights, shapes) - frames, axis=2)
        assert distance.max() < 1.5 + 1e-4
        assert basis.residual == pytest.approx((np.sqrt((distance**2).mean()), distance.max()), rel=1e-4)
        found.append(distance[:, :5].max())
    assert found[0] > 0.5
    assert found[1] < 1.5 / 8.0 + 1e-4


def test_weights_can_all_be_positive() -> None:
    rng = np.random.default_rng(5)
    shapes, weights = rng.normal(size=(4, 7, 3)), rng.uniform(-1.0, 1.0, size=(30, 4))
    made = np.einsum("fk,knc->fnc", weights, shapes)
    shapes, weights = nonnegative(shapes, weights)
    assert len(shapes) == 5
    assert weights.min() >= 0.0
    assert weights.max() <= 1.0
    assert np.abs(np.einsum("fk,knc->fnc", weights, shapes) - made).max() < 1e-12
    assert np.abs(shapes.sum(axis=0)).max() < 1e-12


def test_without_shapes_there_is_nothing_to_take_back() -> None:
    shapes, weights = nonnegative(np.zeros((0, 7, 3)), np.zeros((9, 0)))
    assert shapes.shape == (0, 7, 3)
    assert weights.shape == (9, 0)
