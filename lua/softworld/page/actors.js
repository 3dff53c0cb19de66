// SPDX-License-Identifier: GPL-3.0-or-later
// What is to be seen on the stage, and of it what bends: wires and objects of particles.
import * as THREE from "three";
import { ARC, CURVATURE, FORCE } from "./model.js";
import { RUNS, linear } from "./colours.js";
import { Tube, Skin } from "./tubes.js";

const SIDES = 14;

export const colour = (hex) => new THREE.Color(...linear(hex));

export const solid = (hex, more = {}) => new THREE.MeshPhongMaterial({ color: colour(hex), shininess: 18,
  specular: new THREE.Color(0.05, 0.05, 0.05), side: THREE.DoubleSide, ...more });

/** Numbers of a film, kept between pictures. */
export class Reader {
  constructor(film) {
    this.film = film;
    this.rooms = new Map();
  }
  /** Flat numbers of a track at a frame, or null. The list is the reader's own, longer than they are. */
  read(track, at) {
    if (!track || at.frame < 0) return null;
    const n = track.count(at.frame) * track.width;
    if (!n) return null;
    let room = this.rooms.get(track);
    if (!room || room.length < n) this.rooms.set(track, room = new Float32Array(n));
    track.sample(at.frame, at.part, room);
    return room;
  }
}

/** What is in the list of objects: a name, a kind, and whether it is to be seen. */
export class Actor {
  constructor(run, kind, index, name, detail) {
    Object.assign(this, { run, kind, index, name, detail, id: `${run.index} ${kind} ${index}` });
    this.group = new THREE.Group();
    this.there = false;
  }
  show(there, hidden) {
    this.there = there;
    this.group.visible = there && !hidden.has(this.id);
  }
}

const node = (x, i) => new THREE.Vector3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);

/** The length that bends at a clamp, of its edge and the next one [m]; csrc/state/plan.c has the same. */
function clampLength(first, second) {
  const b = first / second;
  return b < 0.45 ? first / 2 : (0.5 * b - 1 / (12 * b)) * second;
}

/** The direction of a line of nodes at one of them; csrc/body/line_at.c has the same. A bend at an end is that
 *  of a clamp, which goes on as the next one. */
function directionAt(i, x, arc, count, curvature) {
  const edge = (e) => node(x, e + 1).sub(node(x, e)).normalize(), long = (e) => arc[e + 1] - arc[e];
  if (count < 3) return edge(0);
  if (i > 0 && i + 1 < count) return edge(i - 1).multiplyScalar(long(i)).addScaledVector(edge(i), long(i - 1)).normalize();
  const [e, inner] = i === 0 ? [0, 1] : [count - 2, count - 3];
  const own = edge(e), bend = own.clone().sub(edge(inner)), k = curvature ? curvature[i] : 0;
  if (!(k > 0)) return own.addScaledVector(bend, (0.5 * long(e)) / (long(e) + long(inner))).normalize();
  const across = bend.addScaledVector(own, -bend.dot(own));
  if (!(across.length() > 1e-9)) return own;
  const angle = k * clampLength(long(e), long(inner));
  return own.multiplyScalar(Math.cos(angle)).addScaledVector(across.normalize(), Math.sin(angle));
}

/** A wire: a tube around its nodes, or the surface of a mesh. */
export class Wire extends Actor {
  constructor(run, index, wire, reader) {
    super(run, "wire", index, wire.name, `${wire.model || ""}`);
    Object.assign(this, { wire, reader, track: run.film.get("wire", index), arcs: run.film.get("value", index, ARC),
      forces: run.film.get("value", index, FORCE), skin: run.film.get("surface", index),
      pressed: run.film.get("pressed", index) });
    this.material = new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, shininess: 34,
      specular: new THREE.Color(0.09, 0.09, 0.09), side: THREE.DoubleSide });
    this.tube = new Tube(this.material); // a mesh that is frozen between pads is a line for a while
    this.shell = this.skin ? new Skin(this.material) : null;
    for (const s of [this.tube, this.shell]) {
      if (!s) continue;
      s.mesh.userData.actor = this;
      this.group.add(s.mesh);
    }
    this.plain = linear(RUNS[run.index % RUNS.length]);
  }

  update(at, look, hidden) {
    const x = this.nodes = this.reader.read(this.track, at);
    this.count = x ? this.track.count(at.frame) : 0;
    this.at = at;
    this.show(this.count > 1, hidden);
    if (!this.group.visible) return;
    const q = look.quantity;
    const values = q && this.reader.read(this.run.film.get(q.kind || "value", this.index, q.channel), at);
    const each = q && q.kind === "pressed"; // a number for every point, not for every node
    const { scale } = look, { plain } = this;
    const paint = (node, C, c, point) => {
      if (!values || !scale || (each && point === undefined)) {
        C[c] = plain[0]; C[c + 1] = plain[1]; C[c + 2] = plain[2];
        return;
      }
      if (each) {
        scale.put(values[point], C, c);
        return;
      }
      const i = Math.floor(node), f = node - i;
      const v = f > 0 && i + 1 < this.count ? values[i] + (values[i + 1] - values[i]) * f : values[i];
      scale.put(v, C, c);
    };
    const points = this.skin ? this.reader.read(this.skin, at) : null;
    this.surface = points ? this.shell : this.tube;
    this.tube.mesh.visible = !points;
    if (this.shell) this.shell.mesh.visible = Boolean(points);
    if (points) this.shell.update(points, this.skin.count(at.frame), this.skin.line, paint);
    else {
      const radius = Math.max(this.wire.radius * look.thick, look.least);
      this.surface.update(x, this.count, radius, this.count > 2000 ? 6 : this.count > 300 ? 10 : SIDES, paint);
    }
  }

  /** Arc lengths of the nodes now [m]. */
  arc() { return this.reader.read(this.arcs, this.at); }

  /** The place at an arc length [m] of the wire now, and the node before it with the share of the way. */
  place(s) {
    const arc = this.arc(), x = this.nodes;
    if (!arc || !x || this.count < 2) return null;
    let low = 0, high = this.count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (arc[middle] <= s) low = middle; else high = middle;
    }
    const f = Math.min(1, Math.max(0, (s - arc[low]) / (arc[high] - arc[low] || 1)));
    const [a, b] = [node(x, low), node(x, high)];
    if (this.surface !== this.tube) return { point: a.lerp(b, f), node: low, share: f };
    // the run's own curve: a cubic through both nodes with their directions
    const curved = this.reader.read(this.run.film.get("value", this.index, CURVATURE), this.at);
    const l = a.distanceTo(b), g = 1 - f, along = (i) => directionAt(i, x, arc, this.count, curved);
    const point = a.multiplyScalar((1 + 2 * f) * g * g).addScaledVector(along(low), l * f * g * g)
      .addScaledVector(b, f * f * (3 - 2 * f)).addScaledVector(along(high), -l * f * f * g);
    return { point, node: low, share: f };
  }

  /** The value of a quantity at an arc length now. */
  value(channel, s) {
    const track = this.run.film.get("value", this.index, channel), at = this.place(s);
    const values = at && this.reader.read(track, this.at);
    if (!values) return NaN;
    const a = values[at.node], b = values[at.node + 1];
    return a + (b - a) * at.share;
  }

  /** The arc length that belongs to a corner of the surface. */
  arcAt(vertex) {
    const node = this.surface.nodeOf(vertex), arc = this.arc(), i = Math.min(this.count - 2, Math.floor(node));
    return arc ? arc[i] + (arc[i + 1] - arc[i]) * (node - i) : 0;
  }
}

/** An object of particles: balls, and edges of its surface. */
export class Particles extends Actor {
  constructor(run, index, given, reader) {
    super(run, "particles", index, given.name, "particles");
    Object.assign(this, { given, reader, track: run.film.get("particles", index) });
    const most = this.track ? Math.max(...this.track.counts) : 0;
    this.balls = new THREE.InstancedMesh(new THREE.SphereBufferGeometry(1, 10, 8),
      solid(RUNS[run.index % RUNS.length]), most);
    this.balls.castShadow = true;
    this.balls.frustumCulled = false;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: colour(RUNS[run.index % RUNS.length]) }));
    this.lines.frustumCulled = false;
    this.lines.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * most), 3));
    if (given.pairs) this.lines.geometry.setIndex(new THREE.BufferAttribute(given.pairs, 1));
    this.lines.visible = Boolean(given.pairs);
    this.cloth = new THREE.Mesh(new THREE.BufferGeometry(), solid(RUNS[run.index % RUNS.length],
      { flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.cloth.geometry.setAttribute("position", this.lines.geometry.attributes.position);
    this.cloth.geometry.setIndex(new THREE.BufferAttribute(trianglesOf(given.pairs || []), 1));
    this.cloth.frustumCulled = false;
    this.cloth.castShadow = true;
    this.cloth.visible = this.cloth.geometry.index.count > 0;
    for (const mesh of [this.balls, this.cloth]) mesh.userData.actor = this;
    this.group.add(this.cloth, this.balls, this.lines);
  }

  update(at, look, hidden) {
    const x = this.reader.read(this.track, at), n = x ? this.track.count(at.frame) : 0;
    this.show(n > 0, hidden);
    if (!this.group.visible) return;
    const radius = Math.max((this.given.radius || 0) * look.thick, look.least);
    const m = this.balls.instanceMatrix.array;
    m.fill(0);
    for (let i = 0; i < n; i++) {
      m[16 * i] = m[16 * i + 5] = m[16 * i + 10] = radius;
      m[16 * i + 12] = x[3 * i]; m[16 * i + 13] = x[3 * i + 1]; m[16 * i + 14] = x[3 * i + 2];
      m[16 * i + 15] = 1;
    }
    this.balls.instanceMatrix.needsUpdate = true;
    const p = this.lines.geometry.attributes.position;
    p.array.set(x.subarray(0, 3 * n));
    p.needsUpdate = true;
  }
}

/** Triangles that the edges of a surface enclose: pairs of numbers -> corners. */
function trianglesOf(pairs) {
  const beside = new Map(), out = [];
  for (let i = 0; i < pairs.length; i += 2) {
    const a = Math.min(pairs[i], pairs[i + 1]), b = Math.max(pairs[i], pairs[i + 1]);
    if (!beside.has(a)) beside.set(a, new Set());
    beside.get(a).add(b);
  }
  for (const [a, others] of beside) {
    for (const b of others) {
      for (const c of beside.get(b) || []) if (others.has(c)) out.push(a, b, c);
    }
  }
  return new Uint32Array(out);
}
