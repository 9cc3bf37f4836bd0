/**
 * A head in the scene: its meshes, and how a frame of the server moves them.
 *
 * Lengths are mm in the head's frame as in the server's frames; the figure's group is scaled to metres.
 * The skin stays with the body by the share that the neck keeps, all else turns with the head.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { readGlb } from "./glb.js";
import { materialOf } from "./materials.js";
import { computeNormals } from "./normals.js";

const MM = 1000;
const FROM_SKIN = ["brows", "lashes"];

/**
 * @param {ArrayBuffer} file the head as binary glTF
 * @param {THREE.Texture} surroundings what the eyes mirror
 */
export async function buildFigure(file, surroundings) {
  const glb = readGlb(file);
  const iris = await irisTexture(glb.images[0]);
  return new Figure(glb, { iris, surroundings });
}

export class Figure {
  /** The figure in the scene. @type {THREE.Group} */
  group = new THREE.Group();
  /** Vertices that each frame brings, in this order. @type {Record<string, number>} */
  moving = {};
  #meshes = {};
  #head = new THREE.Bone();
  #body = new THREE.Bone();
  #eyes = [];
  #riders = [];

  constructor(glb, pictures) {
    const places = Object.fromEntries(glb.nodes.map((node) => [node.name, node]));
    this.pivot = new THREE.Vector3(...places.head.translation).multiplyScalar(MM);
    this.#head.position.copy(this.pivot);
    this.#body.add(this.#head);
    this.group.add(this.#body);
    this.group.scale.setScalar(1 / MM);
    for (const [name, mesh] of Object.entries(glb.meshes)) this.#add(name, mesh, places[name], pictures);
    for (const name of ["skin", "tongue", "teeth_lower"]) {
      this.moving[name] = this.#meshes[name].geometry.attributes.position.count;
    }
    this.#placeMouth();
  }

  /** Points of the skin in mm, as last shown. */
  get skin() {
    return this.#meshes.skin.geometry.attributes.position.array;
  }

  /** Triangles of the skin. */
  get triangles() {
    return this.#meshes.skin.geometry.index.array;
  }

  /**
   * Show a frame, or what lies between two.
   * @param {Face} a @param {Face} b @param {number} share 0 shows `a`, 1 shows `b`
   * @typedef {{points: Int16Array | Float32Array, scale: number, head: number[], eyes: number[][]}} Face
   */
  show(a, b, share) {
    let from = 0;
    for (const [name, count] of Object.entries(this.moving)) {
      const about = name === "skin" ? null : this.pivot;
      this.#place(this.#meshes[name].geometry, from, count, a, b, share, about);
      from += 3 * count;
    }
    this.#ride();
    turn(this.#head.quaternion, a.head, b.head, share);
    this.#eyes.forEach((eye, side) => turn(eye.quaternion, a.eyes[side], b.eyes[side], share));
  }

  dispose() {
    for (const mesh of Object.values(this.#meshes)) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.removeFromParent();
  }

  #add(name, data, place, pictures) {
    const geometry = new THREE.BufferGeometry();
    const still = !(name in { skin: 0, tongue: 0, teeth_lower: 0, brows: 0, lashes: 0 });
    for (const [key, attribute] of Object.entries(attributesOf(data, name))) {
      if (!still && key !== "color") attribute.setUsage(THREE.DynamicDrawUsage);
      geometry.setAttribute(key, attribute);
    }
    geometry.setIndex(new THREE.BufferAttribute(data.index, 1));
    const material = materialOf(data.material.name, pictures);
    const mesh = name === "skin" ? this.#skinned(geometry, material) : new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.castShadow = name === "skin" || name === "hair";
    mesh.receiveShadow = name !== "lashes" && name !== "brows";
    this.#meshes[name] = mesh;
    if (name === "skin") {
      this.group.add(mesh);
      return;
    }
    this.#head.add(mesh);
    if (place.translation) {
      mesh.position.set(...place.translation).multiplyScalar(MM);
      this.#eyes.push(mesh);
    }
    if (FROM_SKIN.includes(name) && data.attributes._ROOTS) this.#riders.push(rider(geometry, data, this.pivot));
  }

  #skinned(geometry, material) {
    const mesh = new THREE.SkinnedMesh(geometry, material);
    const inverse = [new THREE.Matrix4(), new THREE.Matrix4().makeTranslation(this.pivot.clone().negate())];
    mesh.bind(new THREE.Skeleton([this.#body, this.#head], inverse), new THREE.Matrix4());
    return mesh;
  }

  #place(geometry, from, count, a, b, share, about) {
    const { position, normal } = geometry.attributes;
    const points = position.array;
    const [p, q] = [a.points, b.points];
    const [u, v] = [a.scale * (1 - share), b.scale * share];
    for (let k = 0; k < 3 * count; k++) points[k] = u * p[from + k] + v * q[from + k];
    if (about) {
      for (let k = 0; k < 3 * count; k += 3) {
        points[k] -= about.x;
        points[k + 1] -= about.y;
        points[k + 2] -= about.z;
      }
    }
    computeNormals(points, geometry.index.array, normal.array);
    position.needsUpdate = true;
    normal.needsUpdate = true;
  }

  #ride() {
    const skin = this.skin;
    for (const { position, offsets, roots, weights } of this.#riders) {
      const points = position.array;
      for (let k = 0; k < points.length; k += 3) {
        let [x, y, z] = [offsets[k], offsets[k + 1], offsets[k + 2]];
        for (let r = k; r < k + 3; r++) {
          const [at, weight] = [3 * roots[r], weights[r]];
          x += weight * skin[at];
          y += weight * skin[at + 1];
          z += weight * skin[at + 2];
        }
        points[k] = x;
        points[k + 1] = y;
        points[k + 2] = z;
      }
      position.needsUpdate = true;
    }
  }

  /** Tell the mouth's materials where its front and back are. */
  #placeMouth() {
    const { geometry } = this.#meshes.teeth_upper;
    geometry.computeBoundingBox();
    const front = geometry.boundingBox.max.z;
    for (const name of ["teeth_upper", "teeth_lower", "tongue"]) {
      this.#meshes[name].material.userData.mouth.value.set(front - 26, front - 2);
    }
  }
}

function attributesOf(data, name) {
  const names = { POSITION: "position", NORMAL: "normal", TEXCOORD_0: "uv", COLOR_0: "color" };
  if (name === "skin") Object.assign(names, { JOINTS_0: "skinIndex", WEIGHTS_0: "skinWeight" });
  const attributes = {};
  for (const [theirs, ours] of Object.entries(names)) {
    const found = data.attributes[theirs];
    if (!found) continue;
    const array = found.array.slice();
    if (ours === "position") for (let k = 0; k < array.length; k++) array[k] *= MM;
    attributes[ours] = new THREE.BufferAttribute(array, found.width, found.normalized);
  }
  return attributes;
}

/** What a hair needs to go along with the skin: where it stands off its roots at rest. */
function rider(geometry, data, pivot) {
  const [roots, weights] = [data.attributes._ROOTS.array, data.attributes._WEIGHTS.array];
  const skin = data.attributes._HOME.array;
  const { position } = geometry.attributes;
  const offsets = position.array.map((value, k) => value - skin[k] * MM);
  void pivot;
  return { position, offsets, roots, weights };
}

function turn(quaternion, a, b, share) {
  quaternion.fromArray(a).slerp(TARGET.fromArray(b), share);
}
const TARGET = new THREE.Quaternion();

async function irisTexture(blob) {
  const texture = new THREE.Texture(await createImageBitmap(blob));
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.flipY = false;
  texture.anisotropy = 4;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}
