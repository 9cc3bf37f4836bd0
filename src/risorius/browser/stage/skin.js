/**
 * Skin, and the cloth below the neckline, as the library's renderer draws them: light that goes round the edges of
 * shadow, gloss, pores, fine wrinkles, the shadow of the key lamp, stitches.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { lighting } from "./shading.js";
import { DEVELOPED } from "./tone.js";
/** @import {StageTable} from "../wire.js" */

const EVEN = 0.01; // a vertex's share of the key lamp nearer than this to 0 or 1 is used for its whole triangles

// Inputs of a vertex. The share of each colour that added blood leaves is nearly exp( - 2 half_ ).
const KNOWN = `
attribute vec4 reach;
attribute vec4 surface; // each 0 to 1: visibility of the surroundings, roughness squared, strength of gloss, curvature
attribute vec2 worn; // mm into the cloth, share of mouth interior
attribute float gained;
attribute float lipsShare;
uniform vec3 skinAbsorbs;
uniform vec3 lipsAbsorb;
uniform float lipsGain;
vec3 perfused() {
  vec3 half_ = 0.5 * ( skinAbsorbs * gained + lipsAbsorb * lipsShare * lipsGain );
  return color * ( 1.0 - half_ ) / ( 1.0 + half_ );
}
`;

// Skin without pores and wrinkles. Colour that is mixed with the cloth's is replaced by the neck's.
const SMOOTH = `
uniform vec3 cloth;
uniform vec3 neck;
Skin smoothSkin( vec3 colour, vec4 surface, vec4 reach, float hem, vec3 normal, vec3 view ) {
  vec3 bare = mix( colour, neck, smoothstep( 0.0, 0.35, clamp( 0.5 + hem / HEM, 0.0, 1.0 ) ) );
  float free = surface.x * lib_collar_free( hem );
  return Skin( bare, normal, normal, view, reach, free, surface.y, surface.z * STRONGEST, surface.w * MAX_CURVATURE );
}
// Light on skin, and on the mouth's lining, which receives the light that passes the lips (skin.py).
vec3 litFlesh( Skin skin, vec3 place, float key, float inner ) {
  vec3 entered = vec3( 0.0 );
  if ( inner > INNER_MOUTH ) {
    vec2 past = pastLips( place );
    float seen = lib_spread_in_flesh( past.x );
    skin.free = mix( skin.free, seen, inner );
    key *= mix( 1.0, seen, inner );
    entered = skin.albedo * enteringLight() * seen * inner * past.y;
  }
  return litSkin( skin, key ) + entered;
}
`;

/**
 * Kinds of triangles: most have neither wrinkles nor cloth, and a shader without these is much faster
 * without a graphics card.
 * @typedef {{creased: boolean, clothed: boolean}} Kind
 * @type {Kind[]}
 */
const KINDS = [
  { creased: false, clothed: false },
  { creased: true, clothed: false },
  { creased: false, clothed: true }, // no wrinkle reaches the cloth
];
const CLOTH = -4; // mm into the cloth from which it is drawn: more than a pixel

/** @param {StageTable} packing @param {Kind} kind */
const carried = ({ folds }, { creased }) => `
varying vec3 tinted;
varying vec3 place;
varying vec3 facing;
varying vec4 lampReach;
varying vec4 surfaced;
varying vec3 within; // mm into the cloth, share of mouth interior, share of the key lamp
varying vec3 resting;
${creased ? `varying vec4 raised;
flat varying vec4 regions;
${each(folds, (slot) => `varying vec4 fold${slot};`)}` : ""}
`;

/** @param {StageTable} packing @param {Kind} kind */
const vertex = (packing, kind) => `
#include <common>
${lighting(packing)}
${KNOWN}${carried(packing, kind)}
attribute vec3 rest;
attribute vec4 foldHeight;
attribute vec4 foldRegion;
${each(packing.folds, (slot) => `attribute vec4 foldPlace${slot};`)}
void main() {
  tinted = perfused();
  place = position;
  facing = normal;
  lampReach = reach;
  surfaced = surface;
  within = vec3( worn, keyShare( position, 2, 2 ) ); // every second texel tells whether a shadow's edge is near
  resting = rest;
  ${kind.creased ? `raised = foldHeight * ${packing.folds.step};\n  regions = foldRegion;` : ""}
  ${kind.creased ? each(packing.folds, (slot) => `fold${slot} = foldPlace${slot};`) : ""}
  gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`;

/** @param {StageTable} packing */
const creases = (packing) => `
uniform vec4 foldStyles[ ${packing.folds.styles.length} ]; // kind, furrow, shadow, share
// Adds the slope of one region's folds at rest, and the depth of the place in a crease (folds.py).
void fold( inout vec3 slope, inout float deep, float height, float region, vec4 where, float blur ) {
  if ( region < 0.5 ) return;
  vec4 style = foldStyles[ int( region ) - 1 ];
  height *= style.w;
  if ( height <= FAINT ) return;
  vec2 found;
  if ( style.x == DIMPLES ) {
    vec4 pits = grain( resting, vec3( PIT_CELLS / style.y ) );
    found = lib_pit( pits.x, style.y, blur );
    slope += pits.yzw * height * found.x;
  } else {
    float steep = length( where.yzw ) + 1e-6;
    if ( style.x == FOLD ) found = lib_overhang( where.x / steep, style.y, blur );
    else found = lib_ridge( ( where.x - floor( where.x + 0.5 ) ) / steep, 1.0 / steep, style.y, blur );
    slope += where.yzw * height * found.x / steep;
  }
  deep += found.y * lib_darkened( style.z, height );
}
void crease( inout Skin skin, vec3 normal ) {
  if ( ! any( greaterThan( raised, vec4( FAINT ) ) ) ) return;
  vec3 slope = vec3( 0.0 );
  float deep = 0.0, blur = lib_covered_skin( millimetres, dot( normal, skin.view ) );
  ${each(packing.folds, (slot) => `fold( slope, deep, raised[ ${slot} ], regions[ ${slot} ], fold${slot}, blur );`)}
  slope = headTurn * slope;
  slope -= normal * dot( slope, normal );
  deep = min( deep, 1.0 );
  skin.soft = lib_bent( skin.soft, slope, FLESH );
  skin.bumpy = lib_bent( skin.bumpy, slope, 1.0 );
  skin.free *= 1.0 - FOLD_SHADES * deep;
  skin.strength *= 1.0 - FOLD_DULLS * deep;
  skin.albedo *= lib_fold_colour( deep );
}
`;

/** @param {StageTable} packing @param {Kind} kind */
const pixel = (packing, kind) => `
#include <common>
${lighting(packing)}
${SMOOTH}${carried(packing, kind)}
uniform float millimetres; // to a pixel
vec3 tilted( vec3 normal, vec3 slope ) {
  return normalize( normal + slope );
}
void roughen( inout Skin skin, float inner ) {
  vec4 fine = grain( resting, vec3( PORES ) );
  vec3 slope = headTurn * fine.yzw;
  slope = ( slope - skin.soft * dot( slope, skin.soft ) ) * lib_pore_depth( millimetres ) * ( inner - 1.0 );
  skin.soft = tilted( skin.soft, slope * PORES_SOFT );
  skin.bumpy = tilted( skin.bumpy, slope );
  skin.albedo *= 1.0 + PORES_DARKEN * fine.x;
  skin.strength *= 1.0 + PORES_DULL * min( fine.x, 1.0 );
}
${kind.creased ? creases(packing) : ""}
vec3 worn( vec3 normal, vec3 view, float key ) {
  if ( within.x < COLLAR ) normal = lib_rolled( normal, within.x );
  float light = lib_knitted( grain( resting, STITCHES ).x, resting, within.x );
  return litCloth( cloth * light, normal, view, lampReach, surfaced.x, key );
}
void main() {
  vec3 normal = normalize( facing ), view = towards( place );
  float key = within.z;
  if ( key > ${EVEN} && key < ${1 - EVEN} ) key = keyShare( place );
  float covered = ${kind.clothed ? "smoothstep( - millimetres, millimetres, within.x )" : "0.0"};
  vec3 light = vec3( 0.0 );
  if ( covered < 1.0 ) {
    Skin skin = smoothSkin( tinted, surfaced, lampReach, within.x, normal, view );
    roughen( skin, within.y );
    ${kind.creased ? "crease( skin, normal );" : ""}
    light = litFlesh( skin, place, key, within.y );
  }
  ${kind.clothed ? "if ( covered > 0.0 ) light = mix( light, worn( normal, view, key ), covered );" : ""}
  gl_FragColor = vec4( light, 1.0 );
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

const SEAM = "20.0"; // mm about the neckline within which a vertex knows the colours of both
const QUICK = `
varying vec3 bare;
varying vec3 dressed;
varying float hem;
`;

// In motion and without a graphics card: lit at the vertices, which are few then.
/** @param {StageTable} packing */
const quickVertex = (packing) => `
#include <common>
${DEVELOPED}
${lighting(packing)}
${KNOWN}${SMOOTH}${QUICK}
void main() {
  hem = worn.x;
  vec3 view = towards( position );
  float key = keyShareQuick( position );
  bare = dressed = vec3( 0.0 );
  if ( hem < ${SEAM} ) {
    Skin skin = smoothSkin( perfused(), surface, reach, hem, normal, view );
    bare = developed( litFlesh( skin, position, key, worn.y ) );
  }
  if ( hem > - ${SEAM} ) dressed = developed( litCloth( cloth, normal, view, reach, surface.x, key ) );
  gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`;

/** @param {StageTable} packing */
const quickPixel = ({ shading }) => `
${shading.formulas}
${QUICK}
void main() {
  float width = clamp( fwidth( hem ), 0.15, 3.0 );
  gl_FragColor = vec4( hem > - width ? mix( bare, dressed * lib_collar_shade( hem ), smoothstep( - width, width, hem ) ) : bare, 1.0 );
}`;

/**
 * @param {StageTable} packing how the head is drawn @param {Record<string, {value: any}>} light what `lighting` reads
 * @returns {THREE.ShaderMaterial[]} by the kinds of triangles; they share their uniforms, with `userData.quick`, too, the
 *   material for motion
 */
export function skinMaterials(packing, light) {
  const { cloth, blood, folds } = packing;
  const uniforms = {
    ...light,
    cloth: { value: new THREE.Vector3(...cloth) },
    neck: { value: new THREE.Color() },
    skinAbsorbs: { value: new THREE.Vector3(...blood.skin) },
    lipsAbsorb: { value: new THREE.Vector3(...blood.lips) },
    lipsGain: { value: 0 },
    millimetres: { value: 0.3 },
    foldStyles: { value: folds.styles.map((style) => new THREE.Vector4(...style)) },
  };
  const shared = { uniforms, vertexColors: true };
  const quick = { vertexShader: quickVertex(packing), fragmentShader: quickPixel(packing), toneMapped: false };
  const userData = { quick: new THREE.ShaderMaterial({ ...shared, ...quick }) };
  return KINDS.map((kind) => {
    const shaders = { vertexShader: vertex(packing, kind), fragmentShader: pixel(packing, kind) };
    return Object.assign(new THREE.ShaderMaterial({ ...shared, ...shaders }), { userData });
  });
}

/**
 * Put the skin's triangles in groups by their kind.
 * @param {THREE.BufferGeometry} geometry of the skin, with its folds and its way to the cloth
 */
export function groupTriangles(geometry) {
  const { foldRegion, worn } = geometry.attributes;
  const index = /** @type {Uint32Array} */ (/** @type {THREE.BufferAttribute} */ (geometry.index).array);
  const kindOf = Uint8Array.from({ length: worn.count }, (_, place) => {
    const regions = foldRegion.array.subarray(foldRegion.itemSize * place, foldRegion.itemSize * (place + 1));
    return worn.getX(place) > CLOTH ? 2 : regions.some((region) => region > 0) ? 1 : 0;
  });
  /** @type {number[][]} */
  const groups = KINDS.map(() => []);
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = index.subarray(k, k + 3);
    groups[Math.max(kindOf[a], kindOf[b], kindOf[c])].push(a, b, c);
  }
  let start = 0;
  groups.forEach((triangles, kind) => {
    index.set(triangles, start);
    if (triangles.length > 0) geometry.addGroup(start, triangles.length, kind);
    start += triangles.length;
  });
}

/** @param {{slots: number}} folds @param {(slot: number) => string} line */
function each({ slots }, line) {
  return Array.from({ length: slots }, (_, slot) => line(slot)).join("\n  ");
}
