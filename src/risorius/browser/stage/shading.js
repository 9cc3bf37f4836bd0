/**
 * GLSL that lights skin and cloth as the library's renderer does (`render/materials`), from the library's own formulas,
 * constants and tables, which the server sends. Places are mm and all directions those of the world.
 */

import * as THREE from "../vendor/three/three.module.min.js";
import { LAMPS, MM } from "./geometry.js";
/** @import {StageTable} from "../wire.js" */

/**
 * The text for both shaders: `litSkin`, `litCloth`, `keyShare`, `pastLips`, `enteringLight`, `grain`, `towards`.
 * @param {StageTable} packing
 */
export function lighting({ shading, light }) {
  return `
${shading.formulas}
uniform highp sampler3D grainTile;
uniform highp sampler2D leaving;
uniform highp sampler2D shadowMap;
uniform vec4 shadowRows[ 3 ];
uniform float shadowDepth;
uniform float shadowBias;
uniform vec3 lampWays[ ${LAMPS} ];
uniform vec3 lampColours[ ${LAMPS} ];
uniform vec4 softness;
uniform vec3 ambient[ 2 ];
uniform mat3 headTurn;
uniform vec3 pivot;
uniform vec2 lipSpan;
uniform vec4 lips[ ${shading.lips} ]; // height and depth of the upper and of the lower lip from one corner to the other
struct Skin { vec3 albedo; vec3 soft; vec3 bumpy; vec3 view; vec4 reach; float free; float roughness; float strength; float curvature; };

float heightAt( ivec3 cell ) {
  return ( texelFetch( grainTile, cell & ${shading.grain - 1}, 0 ).r * 255.0 - 128.0 ) * ${shading.highest / 127};
}
// Height and slope of the grain (grain.py): interpolated between the corners of a cell.
vec4 grain( vec3 place, vec3 cells ) {
  vec3 at = place * cells;
  ivec3 low = ivec3( floor( at ) );
  vec3 way = at - vec3( low );
  vec4 near, far; // the corners x, y of a layer: 00, 10, 01, 11
  for ( int k = 0; k < 4; k ++ ) {
    ivec3 corner = low + ivec3( k & 1, k >> 1, 0 );
    near[ k ] = heightAt( corner );
    far[ k ] = heightAt( corner + ivec3( 0, 0, 1 ) );
  }
  vec4 flat_ = mix( near, far, way.z ), rise = far - near;
  vec2 rows = mix( flat_.xz, flat_.yw, way.x ), rises = mix( rise.xz, rise.yw, way.x );
  float right = mix( flat_.y - flat_.x, flat_.w - flat_.z, way.y );
  return vec4( mix( rows.x, rows.y, way.y ), vec3( right, rows.y - rows.x, mix( rises.x, rises.y, way.y ) ) * cells );
}
// The share of the key lamp that reaches a place (shadow.py): a tent filter over the texels around it, "reach" of them to either
// side and one more, or every "stride"-th of these.
float keyShare( vec3 place, int reach, int stride ) {
  vec4 p = vec4( place, 1.0 );
  vec2 at = vec2( dot( shadowRows[ 0 ], p ), dot( shadowRows[ 1 ], p ) ) - 0.5;
  float near = dot( shadowRows[ 2 ], p ) + shadowBias;
  ivec2 texel = ivec2( floor( at ) ), size = textureSize( shadowMap, 0 );
  int taps = int( TAPS );
  if ( any( lessThan( texel, ivec2( taps ) ) ) || any( greaterThanEqual( texel, size - taps - 1 ) ) ) return 1.0;
  vec2 way = at - vec2( texel );
  float total = 0.0, weights = 0.0, wide = TAPS + 1.0;
  for ( int row = - reach; row <= reach + 1; row += stride ) {
    for ( int column = - reach; column <= reach + 1; column += stride ) {
      float there = ( 1.0 - texelFetch( shadowMap, texel + ivec2( column, row ), 0 ).r ) * shadowDepth;
      float blocked = clamp( ( there - near ) * RAMP, 0.0, 1.0 );
      float weight = max( wide - abs( float( column ) - way.x ), 0.0 ) * max( wide - abs( float( row ) - way.y ), 0.0 );
      total += ( 1.0 - blocked ) * weight;
      weights += weight;
    }
  }
  return total / weights;
}
float pastStrip( float x, float y, float z ) {
  float along = clamp( ( x - lipSpan.x ) / ( lipSpan.y - lipSpan.x ), 0.0, 1.0 ) * ${(shading.lips - 1.001).toFixed(3)};
  vec4 edges = mix( lips[ int( along ) ], lips[ int( along ) + 1 ], fract( along ) );
  return lib_strip_share( x, y, z, lipSpan.x, lipSpan.y, edges.x, edges.y, edges.z, edges.w );
}
// The share of light that comes past the lips to a place in the mouth, and the share of the lamps' light that reaches that depth (mouth.py).
vec2 pastLips( vec3 place ) {
  vec3 p = ( place - pivot ) * headTurn + pivot;
  float front = lips[ ${shading.lips / 2} ].y, z = max( p.z, front - FAUCES );
  return vec2( lib_past_strips( pastStrip( p.x, p.y, z ), pastStrip( 0.5 * p.x, p.y, z ), front - z ), lib_lamps_behind( front - p.z ) );
}
vec3 enteringLight() {
  vec3 total = vec3( 0.0 );
  for ( int k = 0; k < int( FRONT ); k ++ ) total += lampColours[ k ] * clamp( dot( headTurn[ 2 ], lampWays[ k ] ), 0.0, 1.0 );
  return total * WARM;
}
float keyShare( vec3 place ) {
  return keyShare( place, int( TAPS ), 1 );
}
float keyShareQuick( vec3 place ) {
  return keyShare( place, 0, 1 );
}
vec3 towards( vec3 place ) {
  return normalize( cameraPosition * ${MM.toFixed(1)} - place );
}
// Diffuse light of each lamp that leaves the skin, specular reflection, and ambient light (skin.py, skin_lamps.py).
vec3 litSkin( Skin skin, float key ) {
  vec3 total = skin.albedo * lib_ambient_on( ambient, skin.soft, skin.free );
  for ( int k = 0; k < ${light.lamps.length}; k ++ ) {
    float share = skin.reach[ k ];
    if ( k == 0 ) share *= key;
    else if ( float( k ) >= FRONT ) share *= share;
    vec2 at = vec2( lib_curvature_place( skin.curvature ), lib_angle_place( dot( skin.soft, lampWays[ k ] ) ) );
    vec3 below = textureLod( leaving, ( at + 0.5 ) / vec2( CURVATURES, ANGLES ), 0.0 ).rgb;
    total += skin.albedo * lampColours[ k ] * below * lib_warm_edge( share );
    vec3 between = skin.view + lampWays[ k ];
    float lit = dot( skin.bumpy, lampWays[ k ] ), aligned = dot( skin.bumpy, between ), apart = dot( between, between );
    float wide = skin.roughness + softness[ k ];
    float glint = lib_mirrored( lit, aligned, apart, wide, FACING );
    if ( k == 0 ) glint = SHARP * glint + ( 1.0 - SHARP ) * lib_mirrored( lit, aligned, apart, wide * BROAD, FACING );
    else if ( float( k ) >= FRONT ) glint *= GRAZED;
    total += lampColours[ k ] * glint * share * skin.strength;
  }
  float edge = lib_edge_share( dot( skin.soft, skin.view ), skin.soft.y ) * skin.free * skin.strength;
  return total + lib_ambient_on( ambient, skin.soft, 1.0 ) * edge;
}
vec3 litCloth( vec3 albedo, vec3 normal, vec3 view, vec4 reach, float free, float key ) {
  vec3 around = lib_ambient_on( ambient, normal, free );
  vec3 total = albedo * around;
  for ( int k = 0; k < ${light.lamps.length}; k ++ ) {
    float share = reach[ k ] * ( k == 0 ? key : 1.0 );
    total += albedo * lampColours[ k ] * lib_cloth_share( dot( normal, lampWays[ k ] ) ) * share;
  }
  return total + around * lib_sheen( dot( normal, view ) );
}
`;
}

/**
 * Return the uniforms that `lighting` reads; the caller sets `shadowMap`, `headTurn` and the lips.
 * @param {StageTable} packing @param {Uint8Array} tables the grain and the light that leaves skin, as `skin_formulas.py` packs them
 * @returns {Record<string, {value: any}>}
 */
export function lightingUniforms({ light, shading, shadow, pivot }, tables) {
  /** @param {"direction" | "colour"} name */
  const each = (name) => Array.from({ length: LAMPS }, (_, k) => new THREE.Vector3(...(light.lamps[k]?.[name] ?? [0, 0, 0])));
  const { grainTile, leaving } = texturesOf(shading, tables);
  return {
    grainTile: { value: grainTile },
    leaving: { value: leaving },
    shadowMap: { value: null },
    shadowRows: { value: [0, 4, 8].map((from) => new THREE.Vector4(...shadow.matrix.slice(from, from + 4))) },
    shadowDepth: { value: shadow.depth },
    shadowBias: { value: shadow.bias },
    lampWays: { value: each("direction") },
    lampColours: { value: each("colour") },
    softness: { value: new THREE.Vector4(...light.lamps.map(({ softness }) => softness)) },
    headTurn: { value: new THREE.Matrix3() },
    pivot: { value: new THREE.Vector3(...pivot) },
    lipSpan: { value: new THREE.Vector2(-1, 1) },
    lips: { value: Array.from({ length: shading.lips }, () => new THREE.Vector4()) },
    ambient: { value: [new THREE.Vector3(...light.ground), new THREE.Vector3(...light.sky)] },
  };
}

/** @param {StageTable["shading"]} shading @param {Uint8Array} tables */
function texturesOf({ grain, angles, curvatures }, tables) {
  const cells = grain ** 3;
  const grainTile = new THREE.Data3DTexture(tables.slice(0, cells), grain, grain, grain);
  grainTile.format = THREE.RedFormat;
  grainTile.unpackAlignment = 1;
  const light = new Uint16Array(tables.slice(cells).buffer);
  const leaving = new THREE.DataTexture(light, curvatures, angles, THREE.RGBAFormat, THREE.HalfFloatType);
  leaving.magFilter = leaving.minFilter = THREE.LinearFilter;
  grainTile.needsUpdate = leaving.needsUpdate = true;
  return { grainTile, leaving };
}
