/**
 * A head in the scene: its meshes, moved by the faces that the server sends.
 *
 * Lengths are mm in the head's frame as in the server's messages; the figure's group is scaled to metres.
 * The skin stays with the body by the share that belongs to the neck; all else turns with the head.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { Blood } from "./blood.js";
import { lighterOf, shade as shadeAnew } from "./coarse.js";
import { Cover } from "./cover.js";
import { eyeMaterial, placeLids, turnEye } from "./eye.js";
import { Folds } from "./folds.js";
import { MM, bloodOf, geometryOf, irisTexture, lightOf, neckColour, neckShare } from "./geometry.js";
import { readGlb } from "./glb.js";
import { HAIRS, hairMaterial } from "./hair.js";
import { findSlit } from "./lips.js";
import { mouthMaterial } from "./mouth.js";
import { lightingUniforms } from "./shading.js";
import { KeyShadow } from "./shadow.js";
import { groupTriangles, skinMaterials } from "./skin.js";
import { Order, asStrands, follow } from "./strands.js";
/** @import {FileMesh, HeadData, HeadFile, Mesh} from "../types.js" */
/** @import {StagePart, StageTable} from "../wire.js" */

/**
 * @param {HeadData} data of the head
 * @param {StageTable} packing how faces of this head are packed, as the server describes it
 * @param {boolean} coarse whether few triangles are drawn: for browsers without a graphics card
 */
export async function buildFigure(data, packing, coarse = false) {
  const glb = readGlb(data.head);
  return new Figure(glb, packing, data, await irisTexture(glb.images[0]), coarse);
}

export class Figure {
  /** The figure in the scene. */
  group = new THREE.Group();
  #packing;
  /** @type {Record<string, Mesh>} by name */
  #meshes = {};
  #head = new THREE.Group();
  #neck;
  /** @type {Mesh[]} */
  #eyes = [];
  /** @type {Record<string, import("./coarse.js").Lighter>} by the name of the mesh it replaces; empty if all triangles are drawn */
  #lighter = {};
  /** @type {{a: import("./faces.js").Face, b: import("./faces.js").Face, share: number} | null} */
  #shown = null;
  #waits = false; // whether the current face has not been applied yet: another may arrive before drawing
  /** @type {Set<string>} meshes whose points are elsewhere */
  #stale = new Set();
  /** @type {Map<Mesh, Order>} */
  #hairs = new Map();
  /** @type {Blood} */
  #blood;
  #folds;
  #shadow;
  /** Uniforms of skin and eyes. @type {Record<string, {value: any}>} */
  #uniforms;
  #shaded = false; // whether the shadow is that of the face

  /** @param {HeadFile} glb @param {StageTable} packing @param {HeadData} data @param {THREE.Texture} iris @param {boolean} coarse */
  constructor(glb, packing, data, iris, coarse) {
    const shade = new Uint8Array(data.shade);
    this.#packing = packing;
    this.pivot = new THREE.Vector3(...packing.pivot);
    this.#head.position.copy(this.pivot);
    this.group.add(this.#head);
    this.#neck = neckShare(glb.meshes.skin);
    this.group.scale.setScalar(1 / MM);
    const places = Object.fromEntries(glb.nodes.map((node) => [node.name, node.translation]));
    this.#uniforms = lightingUniforms(packing, new Uint8Array(data.skin));
    for (const [name, mesh] of Object.entries(glb.meshes)) this.#add(name, mesh, places[name], iris);
    this.#light(shade);
    const { geometry } = this.#meshes.skin;
    geometry.setAttribute("rest", geometry.attributes.position.clone());
    this.#folds = new Folds(geometry, data.folds, packing.folds);
    this.#shadow = new KeyShadow(packing.shadow, this.#uniforms.shadowRows.value);
    this.#uniforms.shadowMap.value = this.#shadow.map;
    this.#blood = this.#perfuse(shade);
    this.#partLips(this.#points);
    if (coarse) this.#coarsen();
    this.#order();
    groupTriangles(geometry);
  }

  /** The shown points of the skin in mm in the head's frame: x, y, z, x, … */
  get skin() {
    this.#takeFace();
    return this.#points;
  }

  /** Uniforms of the skin alone. */
  get #ownUniforms() {
    return /** @type {any} */ (this.#meshes.skin.material)[0].uniforms;
  }

  get #points() {
    return pointsOf(this.#meshes.skin);
  }

  /**
   * Prepare for drawing.
   * @param {THREE.Camera} camera @param {number} height of the picture, in pixels
   * @param {THREE.WebGLRenderer} renderer that draws it
   */
  ready(camera, height, renderer) {
    this.#takeFace();
    for (const name of this.#stale) this.#moved(name);
    this.#stale.clear();
    this.group.updateMatrixWorld(true);
    this.#ownUniforms.millimetres.value = (2 * MM * camera.position.length()) / (height * camera.projectionMatrix.elements[5]);
    if (!this.#shaded) this.#shadow.draw(renderer, this.#lighter.skin?.mesh ?? this.#meshes.skin);
    this.#shaded = true;
    for (const mesh of this.#hairs.keys()) this.#comb(mesh, camera, height);
  }

  /** The number of values in a face of this head. */
  get coordinates() {
    return 3 * this.#packing.vertices;
  }

  /**
   * Show a face, or a blend of two.
   * @param {import("./faces.js").Face} a @param {import("./faces.js").Face} b
   * @param {number} share 0 shows `a`, 1 shows `b`
   * @returns {boolean} whether that is another face than the one shown before
   */
  show(a, b, share) {
    if (this.#shown?.a === a && this.#shown.b === b && this.#shown.share === share) return false;
    this.#shown = { a, b, share };
    this.#waits = true;
    return true;
  }

  /** Free the graphics card's memory. */
  dispose() {
    this.#shadow.dispose();
    for (const name of ["grainTile", "leaving"]) this.#uniforms[name].value.dispose();
    for (const { geometry, material } of this.#drawn()) {
      geometry.dispose();
      for (const one of [material].flat()) one.dispose();
    }
    this.group.removeFromParent();
  }

  /**
   * @param {string} name @param {FileMesh} data @param {number[] | undefined} translation @param {THREE.Texture} iris
   */
  #add(name, data, translation, iris) {
    const moves = this.#packing.parts.some((part) => part.name === name);
    const geometry = geometryOf(data, moves);
    const material = this.#materialOf(data.material.name, iris);
    const mesh = new THREE.Mesh(geometry, /** @type {any} */ (material));
    mesh.frustumCulled = false;
    mesh.renderOrder = name === "skin" ? 0 : name === "hair" ? 2 : 1; // the skin comes first, so that nothing behind it is shaded; hair comes last
    this.#meshes[name] = mesh;
    if (HAIRS.includes(name)) asStrands(mesh);
    (name === "skin" ? this.group : this.#head).add(mesh);
    if (translation) {
      mesh.position.fromArray(translation).multiplyScalar(MM);
      this.#eyes.push(mesh);
    }
  }

  /** @param {string} name of the file's material @param {THREE.Texture} iris */
  #materialOf(name, iris) {
    if (name === "skin") return skinMaterials(this.#packing, this.#uniforms);
    if (name === "eye") return eyeMaterial(this.#packing, this.#uniforms, iris, this.#eyes.length);
    return HAIRS.includes(name) ? hairMaterial(this.#packing, this.#uniforms) : mouthMaterial(this.#packing, this.#uniforms, name);
  }

  #takeFace() {
    if (!this.#waits || !this.#shown) return;
    this.#waits = false;
    const { a, b, share } = this.#shown;
    turn(this.#head.quaternion, a.head, b.head, share);
    for (const part of this.#packing.parts) this.#place(part, a.points, b.points, share);
    this.#folds.raise(a.folds, b.folds, share);
    this.#ownUniforms.lipsGain.value = a.lips + share * (b.lips - a.lips);
    this.#uniforms.headTurn.value.setFromMatrix4(TURNED.makeRotationFromQuaternion(this.#head.quaternion));
    this.#eyes.forEach((eye, side) => turn(eye.quaternion, a.eyes[side], b.eyes[side], share));
    this.#eyes.forEach(({ quaternion, material }, side) => {
      const turned = TURNED.makeRotationFromQuaternion(TARGET.multiplyQuaternions(this.#head.quaternion, quaternion));
      turnEye(/** @type {any} */ (material), this.#packing.eyes[side], turned);
    });
  }

  /** @param {Uint8Array} shade */
  #light(shade) {
    const { geometry } = this.#meshes.skin;
    for (const [name, attribute] of Object.entries(lightOf(shade, geometry.attributes.position.count))) {
      geometry.setAttribute(name, attribute);
    }
    this.#ownUniforms.neck.value.copy(neckColour(/** @type {Record<string, THREE.BufferAttribute>} */ (geometry.attributes)));
  }

  /** Set the skin's attributes for blood. @param {Uint8Array} shade */
  #perfuse(shade) {
    const { geometry } = this.#meshes.skin;
    const shown = bloodOf(shade, geometry.attributes.position.count);
    geometry.setAttribute("lipsShare", new THREE.BufferAttribute(shown.lips, 1));
    const gained = new THREE.BufferAttribute(new Float32Array(shown.lips.length), 1);
    geometry.setAttribute("gained", gained.setUsage(THREE.DynamicDrawUsage));
    const index = /** @type {Uint32Array} */ (/** @type {THREE.BufferAttribute} */ (geometry.index).array);
    return new Blood(index, this.#points, shown, this.#packing.blood);
  }

  /** @param {StagePart} part @param {Int16Array} a @param {Int16Array} b @param {number} share */
  #place({ name, first, count, about }, a, b, share) {
    const { step, origin } = this.#packing;
    const points = pointsOf(this.#meshes[name]);
    const [u, v] = [step * (1 - share), step * share];
    for (let axis = 0; axis < 3; axis++) {
      const shift = origin[axis] - about[axis];
      for (let k = axis, from = 3 * first + axis; k < 3 * count; k += 3, from += 3) {
        points[k] = u * a[from] + v * b[from] + shift;
      }
    }
    if (name === "skin") {
      this.#eyes.forEach(({ material }, side) => placeLids(/** @type {any} */ (material), this.#packing.eyes[side], points));
      this.#partLips(points);
      this.#blood.flow(points, /** @type {Float32Array} */ (this.#meshes.skin.geometry.attributes.gained.array));
      this.#bendNeck(points);
    }
    if (HAIRS.includes(name)) follow(this.#meshes[name].geometry);
    this.#stale.add(name);
  }

  /**
   * Set the visible width of hairs, and sort them.
   * @param {Mesh} mesh @param {THREE.Camera} camera @param {number} height
   */
  #comb(mesh, camera, height) {
    const { uniforms } = /** @type {THREE.ShaderMaterial} */ (mesh.material);
    uniforms.pixels.value = 0.5 * height * camera.projectionMatrix.elements[5];
    uniforms.millimetres.value = this.#ownUniforms.millimetres.value;
    const sight = camera.getWorldDirection(SIGHT).transformDirection(INVERSE.copy(mesh.matrixWorld).invert());
    this.#hairs.get(mesh)?.sort(sight);
  }

  /** Update a mesh after its vertices moved: its drawn version, and its normals unless it is hair. @param {string} name */
  #moved(name) {
    const { geometry } = this.#meshes[name];
    this.#shaded &&= name !== "skin";
    const lighter = this.#lighter[name] ?? null;
    for (const moving of MOVING[name] ?? ["position"]) {
      lighter?.take(moving);
      geometry.attributes[moving].needsUpdate = !lighter;
    }
    if (!HAIRS.includes(name)) shadeAnew(lighter ? lighter.mesh.geometry : geometry);
  }

  /**
   * Turn the skin with the head by each vertex's share: done here because a shader without a graphics card is slow.
   * @param {Float32Array} points
   */
  #bendNeck(points) {
    const [m0, m1, m2, , m4, m5, m6, , m8, m9, m10] = this.#turned();
    const { x: px, y: py, z: pz } = this.pivot;
    for (let k = 0, vertex = 0; k < points.length; k += 3, vertex++) {
      const share = this.#neck[vertex];
      if (share === 0) continue;
      const [x, y, z] = [points[k] - px, points[k + 1] - py, points[k + 2] - pz];
      points[k] += share * (m0 * x + m4 * y + m8 * z - x);
      points[k + 1] += share * (m1 * x + m5 * y + m9 * z - y);
      points[k + 2] += share * (m2 * x + m6 * y + m10 * z - z);
    }
  }

  #turned() {
    return TURNED.makeRotationFromQuaternion(this.#head.quaternion).elements;
  }

  /** Update the light that enters the mouth between the lips. @param {Float32Array} points of the skin, before the head turns */
  #partLips(points) {
    findSlit(this.#packing.lips, points, this.#uniforms.lipSpan.value, this.#uniforms.lips.value);
  }

  /** Replace each mesh of many triangles by a coarser one. */
  #coarsen() {
    const teeth = this.#meshes.teeth_upper.geometry;
    teeth.computeBoundingBox();
    const { min, max } = /** @type {THREE.Box3} */ (teeth.boundingBox);
    const mouth = new THREE.Vector3(0, (min.y + max.y) / 2, max.z).add(this.pivot);
    const { eyes } = this.#packing;
    const edges = eyes.flatMap(({ lids }) => lids.flat());
    const spots = {
      eyes: eyes.map(({ centre }) => centre),
      edges: edges.map((vertex) => [...this.#points.subarray(3 * vertex, 3 * vertex + 3)]),
      mouth: mouth.toArray(),
    };
    for (const [name, mesh] of Object.entries(this.#meshes)) {
      const lighter = lighterOf(name, mesh, spots);
      if (!lighter) continue;
      this.#lighter[name] = lighter;
      mesh.visible = false;
      mesh.parent?.add(lighter.mesh);
    }
  }

  /** Sort the drawn hairs. */
  #order() {
    const cover = new Cover(turningPoints(this.#points, this.#neck, this.pivot), this.#meshes.hair ? pointsOf(this.#meshes.hair) : []);
    for (const name of HAIRS) {
      const mesh = this.#lighter[name]?.mesh ?? this.#meshes[name];
      const covered = this.#packing.parts.some((part) => part.name === name) ? null : cover;
      if (mesh) this.#hairs.set(mesh, new Order(mesh.geometry, covered));
    }
  }

  #drawn() {
    return [...Object.values(this.#meshes), ...Object.values(this.#lighter).map(({ mesh }) => mesh)];
  }
}

/** @param {Mesh} mesh @returns {Float32Array} x, y, z, x, … */
function pointsOf(mesh) {
  return /** @type {Float32Array} */ (mesh.geometry.attributes.position.array);
}

/**
 * Return the skin's points that turn with the head, about its pivot.
 * @param {Float32Array} points @param {Float32Array} shares by which they turn @param {THREE.Vector3} pivot
 */
function turningPoints(points, shares, { x, y, z }) {
  const turning = [];
  for (let vertex = 0, k = 0; vertex < shares.length; vertex++, k += 3) {
    if (shares[vertex] > 0.5) turning.push(points[k] - x, points[k + 1] - y, points[k + 2] - z);
  }
  return Float32Array.from(turning);
}

/** The attributes of meshes that change with their points. @type {Record<string, string[]>} */
const MOVING = { skin: ["position", "gained"], ...Object.fromEntries(HAIRS.map((name) => [name, ["position", "along"]])) };
const [SIGHT, INVERSE] = [new THREE.Vector3(), new THREE.Matrix4()];
const TARGET = new THREE.Quaternion();
const TURNED = new THREE.Matrix4();

/** @param {THREE.Quaternion} quaternion @param {Float32Array} a @param {Float32Array} b @param {number} share */
function turn(quaternion, a, b, share) {
  quaternion.fromArray(a).slerp(TARGET.fromArray(b), share);
}
