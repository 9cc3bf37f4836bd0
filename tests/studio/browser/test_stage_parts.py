"""What the stage is made of, by itself, in the browser that runs it."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.face.solve import FaceSolver
from risorius.render.aperture import lip_edges
from risorius.render.materials.mouth import LIP_STEPS
from risorius.rules.poses import pose_values
from risorius.studio.faces.solvers import stage_of

from .driving import Page


@pytest.fixture
def page(any_page: Page) -> Page:
    return any_page


def test_the_slit_of_the_lips_is_that_of_the_library(page: Page) -> None:
    stage = stage_of("standard")
    face = FaceSolver(stage.head).solve(pose_values({"AU12": 0.5, "AU25": 1.0, "AU26": 0.6}, {}))
    pairs = face.skin[stage.head.lip_pairs].astype(np.float64)
    found = page.run(
        """
        const THREE = await import("/web/vendor/three/three.module.min.js");
        const { findSlit } = await import("/web/stage/lips.js");
        const [points, steps] = arguments;
        const pairs = Array.from({ length: points.length / 6 }, (_, k) => [2 * k, 2 * k + 1]);
        const [span, edges] = [new THREE.Vector2(), Array.from({ length: steps }, () => new THREE.Vector4())];
        findSlit(pairs, points, span, edges);
        return [span.toArray(), edges.map((edge) => edge.toArray())];
        """,
        pairs.ravel().tolist(),
        LIP_STEPS,
    )
    for own, expected in zip(found, lip_edges(pairs), strict=True):
        np.testing.assert_allclose(own, expected, atol=1e-9)
