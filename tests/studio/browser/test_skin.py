"""The page's skin beside the library's, in the browser that draws it."""

from __future__ import annotations

import base64
from dataclasses import replace

import numpy as np
import pytest

from risorius.face.solve import FaceSolver
from risorius.looks.attributes import ALBEDO
from risorius.looks.head_model import head_model
from risorius.looks.perfusion import LIPS_ABSORB, SKIN_ABSORBS, Perfusion
from risorius.ports.page.face_packer import DIALLED
from risorius.render.camera import Camera
from risorius.render.software_renderer import SoftwareRenderer
from risorius.rules.poses import pose_values
from risorius.studio.faces.solvers import stage_of

from .driving import Page

FIGURE = """
  const { Heads } = await import("/web/studio/heads.js");
  const { unpackFaces } = await import("/web/stage/faces.js");
  const figure = await new Heads().get({ head: "standard" });
  const { faces } = unpackFaces(Uint8Array.from(atob(arguments[0]), (c) => c.charCodeAt(0)).buffer);
  figure.show(faces[0], faces[0], 0);
"""
"""The figure of the standard head with the face whose message is given."""

# Pictures of the face as it is and without its fine wrinkles: sRGB bytes as base64, the lowest row first.
DRAWN = """
  const THREE = await import("/web/vendor/three/three.module.min.js");
  const { developAsFilm } = await import("/web/stage/tone.js");
  const [, side, eye, target, field] = arguments;
  const renderer = new THREE.WebGLRenderer({ canvas: new OffscreenCanvas(side, side) });
  developAsFilm(renderer);
  const scene = new THREE.Scene();
  scene.add(figure.group);
  const camera = new THREE.PerspectiveCamera(field, 1, 0.1, 10);
  camera.position.fromArray(eye).divideScalar(1000);
  camera.lookAt(...target.map((mm) => mm / 1000));
  camera.updateMatrixWorld();
  const gl = renderer.getContext();
  const picture = () => {
    figure.ready(camera, side, renderer);
    renderer.render(scene, camera);
    const bytes = new Uint8Array(4 * side * side);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return btoa(bytes.reduce((text, byte) => text + String.fromCharCode(byte), ""));
  };
  const pictures = [picture()];
  faces[0].folds.fill(0);
  const smooth = { ...faces[0] };
  figure.show(smooth, smooth, 0);
  pictures.push(picture());
  figure.dispose();
  renderer.forceContextLoss();
  return pictures;
"""


def test_the_page_shades_the_head_as_the_library_does(performed: Page) -> None:
    """A turned face with raised brows and bared teeth: wrinkles and shadow lie where the library's do."""
    stage, side = stage_of("standard"), 240
    targets = {"AU1": 1.0, "AU2": 1.0, "AU12": 0.5, "AU25": 1.0, "AU26": 0.4, "head_yaw": -15.0}
    face = FaceSolver(stage.head, age=60.0).solve(pose_values(targets, {}))
    camera = Camera((-20.0, 0.0, 900.0), (-20.0, 0.0, 30.0), 11.0)
    packed = base64.b64encode(stage.packed(DIALLED, 1, 0, [face])).decode()
    given = packed, side, camera.eye, camera.target, camera.field_of_view
    encoded = performed.run(FIGURE + DRAWN, *given)
    bytes_of = [np.frombuffer(base64.b64decode(text), np.uint8) for text in encoded]
    own = [found.reshape(side, side, 4)[::-1, :, :3].astype(float) for found in bytes_of]
    renderer = SoftwareRenderer(head_model(stage.head), (side, side), camera=camera)
    smooth = replace(face, wrinkles=np.zeros_like(face.wrinkles))
    theirs = [renderer.render(one).astype(float) for one in (face, smooth)]
    folds, expected = (pictures[0].sum(axis=2) - pictures[1].sum(axis=2) for pictures in (own, theirs))
    raised = np.abs(expected) > 4.0
    assert 400 < raised.sum() < 0.3 * side * side
    assert np.corrcoef(folds[raised], expected[raised])[0, 1] > 0.9
    assert np.abs(folds[raised]).sum() == pytest.approx(np.abs(expected[raised]).sum(), rel=0.15)
    # Skin from the forehead to the neck, lit and in the shadow, without eyes, brows and hair.
    red, green, blue = np.moveaxis(theirs[1], 2, 0)
    even = np.hypot(*np.gradient(green)) < 12.0
    skin = even & (red > 70.0) & (red > blue + 20.0)
    assert skin.sum() > 0.1 * side * side
    apart = np.abs(own[1] - theirs[1]).max(axis=2)
    assert np.median(apart[skin]) <= 2.0
    assert np.percentile(apart[skin], 75.0) <= 4.0
    # Teeth in the light past the lips.
    teeth = (blue > 110.0) & (red < blue + 45.0)
    teeth[:190], teeth[:, :75], teeth[:, 155:] = False, False, False
    assert teeth.sum() > 250
    assert np.median(apart[teeth]) <= 4.0
    # Hair on the side that is turned from the key lamp: the mean of many, for no two are alike.
    blocks = [picture.reshape(30, 8, 30, 8, 3).mean(axis=(1, 3))[:, 20:] for picture in (own[1], theirs[1])]
    hair = (blocks[1][..., 0] < 125.0) & (blocks[1][..., 0] > blocks[1][..., 2] + 15.0)
    assert hair.sum() > 80
    assert np.percentile(np.abs(blocks[0] - blocks[1]).max(axis=2)[hair], 90.0) <= 12.0


def test_the_page_moves_blood_as_the_library_does(performed: Page) -> None:
    """A smile's cheeks, raised brows and pressed lips have the colours of the library's own pictures."""
    stage = stage_of("standard")
    face = FaceSolver(stage.head).solve(
        pose_values({"AU1": 1.0, "AU2": 1.0, "AU6": 1.0, "AU12": 0.5, "AU24": 0.8}, {})
    )
    gained, share, lips = performed.run(
        f"""
        {FIGURE}
        const moved = figure.skin.length;
        const skin = figure.group.children.find((mesh) => mesh.geometry?.attributes.gained);
        const {{ geometry: {{ attributes: {{ gained, lipsShare }} }}, material }} = skin;
        return moved && [[...gained.array], [...lipsShare.array], material[0].uniforms.lipsGain.value];
        """,
        base64.b64encode(stage.packed(DIALLED, 1, 0, [face])).decode(),
    )
    skin = head_model(stage.head).solids["skin"].attributes
    painted = skin.copy()
    Perfusion(stage.head, stage.head.identity.looks, skin[:, ALBEDO : ALBEDO + 3]).colour(face, painted)
    expected = painted[:, ALBEDO : ALBEDO + 3] / skin[:, ALBEDO : ALBEDO + 3]
    half = 0.5 * (np.outer(gained, SKIN_ABSORBS) + np.outer(np.array(share) * lips, LIPS_ABSORB))
    assert expected.min() < 0.95
    assert expected.max() > 1.1
    np.testing.assert_allclose((1.0 - half) / (1.0 + half), expected, atol=0.012)
