/** The key lamp's shadow map: the skin as that lamp sees it, redrawn when the face has moved (`render/shadow.py`). */

import * as THREE from "../vendor/three/three.module.min.js";
/** @import {StageShadow} from "../wire.js" */
/** @import {Mesh} from "../types.js" */

const NOTHING = "void main() { gl_FragColor = vec4( 0.0 ); }";

/** @param {StageShadow} shadow */
const FROM_LAMP = ({ size, depth }) => `
uniform vec4 rows[ 3 ];
void main() {
  vec4 p = vec4( position, 1.0 );
  vec2 texel = vec2( dot( rows[ 0 ], p ), dot( rows[ 1 ], p ) );
  gl_Position = vec4( texel * ${2 / size} - 1.0, 1.0 - dot( rows[ 2 ], p ) * ${2 / depth}, 1.0 );
}`;

export class KeyShadow {
  #scene = new THREE.Scene();
  #camera = new THREE.Camera();
  #target;
  #mesh;

  /** @param {StageShadow} shadow as the server describes it @param {THREE.Vector4[]} rows of its matrix */
  constructor(shadow, rows) {
    const { size } = shadow;
    this.#target = new THREE.WebGLRenderTarget(size, size, { depthTexture: new THREE.DepthTexture(size, size) });
    // The map's rows go down, so that triangles facing the lamp are wound the other way in it.
    const material = new THREE.ShaderMaterial({
      side: THREE.BackSide,
      uniforms: { rows: { value: rows } },
      vertexShader: FROM_LAMP(shadow),
      fragmentShader: NOTHING,
    });
    this.#mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.#mesh.frustumCulled = false;
    this.#scene.add(this.#mesh);
  }

  /** The depth map of the lamp: distance of the nearest surface, 1 if there is none. */
  get map() {
    return this.#target.depthTexture;
  }

  /** Draw the map. @param {THREE.WebGLRenderer} renderer @param {Mesh} skin */
  draw(renderer, { geometry }) {
    const before = renderer.getRenderTarget();
    this.#mesh.geometry = geometry;
    renderer.setRenderTarget(this.#target);
    renderer.clear();
    renderer.render(this.#scene, this.#camera);
    renderer.setRenderTarget(before);
  }

  dispose() {
    this.#target.dispose();
    this.#mesh.material.dispose();
  }
}
