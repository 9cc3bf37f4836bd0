/**
 * Normals of a mesh that moves: the sum of its triangles' area vectors at each vertex, made unit length.
 *
 * @param {Float32Array} points (3n,) @param {Uint32Array} index (3m,) @param {Float32Array} normals (3n,) filled
 */
export function computeNormals(points, index, normals) {
  normals.fill(0);
  for (let k = 0; k < index.length; k += 3) {
    const a = 3 * index[k];
    const b = 3 * index[k + 1];
    const c = 3 * index[k + 2];
    const ux = points[b] - points[a];
    const uy = points[b + 1] - points[a + 1];
    const uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a];
    const vy = points[c + 1] - points[a + 1];
    const vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    normals[a] += x;
    normals[a + 1] += y;
    normals[a + 2] += z;
    normals[b] += x;
    normals[b + 1] += y;
    normals[b + 2] += z;
    normals[c] += x;
    normals[c + 1] += y;
    normals[c + 2] += z;
  }
  for (let k = 0; k < normals.length; k += 3) {
    const length = Math.sqrt(normals[k] ** 2 + normals[k + 1] ** 2 + normals[k + 2] ** 2) || 1;
    normals[k] /= length;
    normals[k + 1] /= length;
    normals[k + 2] /= length;
  }
}
