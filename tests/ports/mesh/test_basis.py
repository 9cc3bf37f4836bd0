import numpy as np
import pytest

from risorius.ports.mesh.basis import ClipBasis


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
