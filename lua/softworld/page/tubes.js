// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of wires, made anew for every picture: a tube around a line of nodes, or the sections of a mesh.
import * as THREE from "three";

const MOST_RINGS = 1200; // up to which curves are drawn finer than their nodes

/** How many pieces to draw for each segment. */
export function fineness(nodes) {
  return Math.max(1, Math.min(5, Math.floor(MOST_RINGS / Math.max(1, nodes - 1) / 2)));
}

class Surface {
  constructor(material) {
    this.geometry = new THREE.BufferGeometry();
    this.geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
    this.mesh = new THREE.Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    this.vertices = -1;
  }

  /** Room for so many vertices, with corners of triangles made by f(write). */
  fit(vertices, indices, f) {
    const g = this.geometry;
    for (const name of ["position", "normal", "color"]) {
      const attribute = new THREE.BufferAttribute(new Float32Array(3 * vertices), 3);
      attribute.setUsage(THREE.DynamicDrawUsage);
      g.setAttribute(name, attribute);
    }
    const list = vertices > 65535 ? new Uint32Array(indices) : new Uint16Array(indices);
    let n = 0;
    f((a, b, c) => { list[n++] = a; list[n++] = b; list[n++] = c; });
    g.setIndex(new THREE.BufferAttribute(list, 1));
    this.vertices = vertices;
  }

  changed() {
    const a = this.geometry.attributes;
    a.position.needsUpdate = a.normal.needsUpdate = a.color.needsUpdate = true;
  }

  dispose() { this.geometry.dispose(); }
}

/** Around a line of nodes. */
export class Tube extends Surface {
  constructor(material) {
    super(material);
    this.nodes = 0;
  }

  layout(nodes, sides, fine) {
    if (nodes === this.nodes && sides === this.sides && fine === this.fine) return;
    Object.assign(this, { nodes, sides, fine, rings: (nodes - 1) * fine + 1 });
    const { rings } = this, ends = rings * sides;
    this.centre = new Float32Array(3 * rings);
    this.along = new Float32Array(3 * rings);
    this.circle = new Float32Array(2 * sides);
    for (let k = 0; k < sides; k++) {
      this.circle[2 * k] = Math.cos((2 * Math.PI * k) / sides);
      this.circle[2 * k + 1] = Math.sin((2 * Math.PI * k) / sides);
    }
    this.fit((rings + 2) * sides, 6 * (rings - 1) * sides + 6 * (sides - 2), (triangle) => {
      for (let r = 0; r + 1 < rings; r++) {
        for (let k = 0; k < sides; k++) {
          const a = r * sides + k, b = r * sides + ((k + 1) % sides);
          triangle(a, b, a + sides);
          triangle(b, b + sides, a + sides);
        }
      }
      for (let k = 1; k + 1 < sides; k++) {
        triangle(ends, ends + k + 1, ends + k);
        triangle(ends + sides, ends + sides + k, ends + sides + k + 1);
      }
    });
  }

  /** A smooth line through the nodes (Catmull and Rom), and its directions. */
  trace(x) {
    const { nodes, fine, centre, along, rings } = this;
    for (let i = 0; i + 1 < nodes; i++) {
      for (let c = 0; c < 3; c++) {
        const p1 = x[3 * i + c], p2 = x[3 * i + 3 + c];
        const p0 = i > 0 ? x[3 * i - 3 + c] : 2 * p1 - p2, p3 = i + 2 < nodes ? x[3 * i + 6 + c] : 2 * p2 - p1;
        const m1 = 0.5 * (p2 - p0), m2 = 0.5 * (p3 - p1);
        for (let k = 0; k < fine; k++) {
          const f = k / fine, g = 1 - f, at = 3 * (i * fine + k) + c;
          centre[at] = g * g * (1 + 2 * f) * p1 + f * g * g * m1 + f * f * (3 - 2 * f) * p2 - f * f * g * m2;
        }
      }
    }
    for (let c = 0; c < 3; c++) centre[3 * (rings - 1) + c] = x[3 * (nodes - 1) + c];
    for (let r = 0; r < rings; r++) {
      const a = 3 * Math.max(0, r - 1), b = 3 * Math.min(rings - 1, r + 1);
      const dx = centre[b] - centre[a], dy = centre[b + 1] - centre[a + 1], dz = centre[b + 2] - centre[a + 2];
      const l = Math.hypot(dx, dy, dz) || 1;
      along[3 * r] = dx / l; along[3 * r + 1] = dy / l; along[3 * r + 2] = dz / l;
    }
  }

  /** x: nodes (flat); paint(share of a node, colours, at) gives the colour there. */
  update(x, nodes, radius, sides, paint) {
    this.layout(nodes, sides, fineness(nodes));
    this.trace(x);
    const { rings, centre, along, circle, fine } = this;
    const { position, normal, color } = this.geometry.attributes;
    const P = position.array, N = normal.array, C = color.array;
    // across the line, carried on from ring to ring without turning about it
    let ux = Math.abs(along[2]) < 0.9 ? 0 : 1, uy = 0, uz = Math.abs(along[2]) < 0.9 ? 1 : 0;
    for (let r = 0; r < rings; r++) {
      const tx = along[3 * r], ty = along[3 * r + 1], tz = along[3 * r + 2];
      const d = ux * tx + uy * ty + uz * tz;
      ux -= d * tx; uy -= d * ty; uz -= d * tz;
      let l = Math.hypot(ux, uy, uz);
      if (l < 1e-6) {
        ux = -ty; uy = tx; uz = 0;
        l = Math.hypot(ux, uy, uz) || 1;
      }
      ux /= l; uy /= l; uz /= l;
      const vx = ty * uz - tz * uy, vy = tz * ux - tx * uz, vz = tx * uy - ty * ux;
      const at = 3 * r * sides;
      paint(r / fine, C, at);
      for (let k = 0; k < sides; k++) {
        const a = circle[2 * k], b = circle[2 * k + 1], q = at + 3 * k;
        const nx = a * ux + b * vx, ny = a * uy + b * vy, nz = a * uz + b * vz;
        N[q] = nx; N[q + 1] = ny; N[q + 2] = nz;
        P[q] = centre[3 * r] + radius * nx; P[q + 1] = centre[3 * r + 1] + radius * ny;
        P[q + 2] = centre[3 * r + 2] + radius * nz;
        C[q] = C[at]; C[q + 1] = C[at + 1]; C[q + 2] = C[at + 2];
      }
    }
    this.close(P, N, C);
    this.changed();
  }

  /** Both ends: copies of their rings that face outwards. */
  close(P, N, C) {
    const { rings, sides, along } = this, n = 3 * sides;
    for (let e = 0; e < 2; e++) {
      const from = e ? (rings - 1) * n : 0, to = (rings + e) * n, t = e ? 3 * (rings - 1) : 0, sign = e ? 1 : -1;
      for (let i = 0; i < n; i++) {
        P[to + i] = P[from + i];
        C[to + i] = C[from + i];
        N[to + i] = sign * along[t + (i % 3)];
      }
    }
  }

  /** The node, with a share of the way to the next, that a corner of a triangle belongs to. */
  nodeOf(vertex) {
    const ring = Math.floor(vertex / this.sides);
    return ring < this.rings ? ring / this.fine : ring === this.rings ? 0 : this.nodes - 1;
  }
}

/** Sections of `around` points each. */
export class Skin extends Surface {
  layout(sections, around) {
    if (sections === this.sections && around === this.around) return;
    Object.assign(this, { sections, around });
    const n = sections * around;
    this.fit(n + 2 * around, 6 * (sections - 1) * around + 6 * (around - 2), (triangle) => {
      for (let r = 0; r + 1 < sections; r++) {
        for (let k = 0; k < around; k++) {
          const a = r * around + k, b = r * around + ((k + 1) % around);
          triangle(a, b, a + around);
          triangle(b, b + around, a + around);
        }
      }
      for (let k = 1; k + 1 < around; k++) {
        triangle(n, n + k + 1, n + k);
        triangle(n + around, n + around + k, n + around + k + 1);
      }
    });
  }

  update(x, points, around, paint) {
    this.layout(points / around, around);
    const { position, normal, color } = this.geometry.attributes, P = position.array, C = color.array;
    const n = 3 * points;
    for (let i = 0; i < n; i++) P[i] = x[i];
    for (let r = 0; r < this.sections; r++) {
      const at = 3 * r * around;
      for (let k = 0; k < around; k++) paint(r, C, at + 3 * k, r * around + k);
    }
    for (let i = 0; i < 3 * around; i++) {
      P[n + i] = P[i]; C[n + i] = C[i];
      P[n + 3 * around + i] = P[n - 3 * around + i]; C[n + 3 * around + i] = C[n - 3 * around + i];
    }
    this.normals(P, normal.array);
    this.changed();
  }

  /** Of every triangle its size and direction, summed at its corners. */
  normals(P, N) {
    const index = this.geometry.index.array;
    N.fill(0);
    for (let i = 0; i < index.length; i += 3) {
      const a = 3 * index[i], b = 3 * index[i + 1], c = 3 * index[i + 2];
      const ux = P[b] - P[a], uy = P[b + 1] - P[a + 1], uz = P[b + 2] - P[a + 2];
      const vx = P[c] - P[a], vy = P[c + 1] - P[a + 1], vz = P[c + 2] - P[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      N[a] += nx; N[a + 1] += ny; N[a + 2] += nz;
      N[b] += nx; N[b + 1] += ny; N[b + 2] += nz;
      N[c] += nx; N[c + 1] += ny; N[c + 2] += nz;
    }
    for (let i = 0; i < N.length; i += 3) {
      const l = Math.hypot(N[i], N[i + 1], N[i + 2]) || 1;
      N[i] /= l; N[i + 1] /= l; N[i + 2] /= l;
    }
  }

  nodeOf(vertex) {
    const r = Math.floor(vertex / this.around);
    return r < this.sections ? r : r === this.sections ? 0 : this.sections - 1;
  }
}
