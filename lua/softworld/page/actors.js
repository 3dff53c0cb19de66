// SPDX-License-Identifier: GPL-3.0-or-later
// What moves on the stage: wires, particles, obstacles, holds, grippers, their ways and forces.
import * as THREE from "three";
import { locate } from "./film.js";
import { ARC, FORCE } from "./model.js";
import { RUNS, linear } from "./colours.js";
import { Tube, Skin } from "./tubes.js";

const SIDES = 14;
const NEUTRAL = { wall: "#aeb6c2", pad: "#8c99ab", clip: "#9a8fb5", hold: "#5d6b7e", grip: "#4c8b86" };

const colour = (hex) => new THREE.Color(...linear(hex));

const solid = (hex, more = {}) => new THREE.MeshPhongMaterial({ color: colour(hex), shininess: 18,
  specular: new THREE.Color(0.05, 0.05, 0.05), side: THREE.DoubleSide, ...more });

/** Numbers of a film, kept between pictures. */
class Reader {
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
class Actor {
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
    const channel = look.quantity ? this.run.film.get("value", this.index, look.quantity.channel) : null;
    const values = this.reader.read(channel, at);
    const { scale } = look, { plain } = this;
    const paint = (node, C, c) => {
      if (!values || !scale) {
        C[c] = plain[0]; C[c + 1] = plain[1]; C[c + 2] = plain[2];
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
    const point = new THREE.Vector3(...[0, 1, 2].map((c) => x[3 * low + c] + (x[3 * high + c] - x[3 * low + c]) * f));
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

/** What has a pose: kind and number of its tracks. */
class Posed extends Actor {
  constructor(run, kind, index, name, detail, track, slot, reader) {
    super(run, kind, index, name, detail);
    Object.assign(this, { reader, places: run.film.get(track, slot), turns: run.film.get(track, slot, 1),
      forces: run.film.get(track, slot, 2) });
  }
  /** Takes its place; false: it is not there. */
  move(at) {
    const p = this.reader.read(this.places, at), q = this.reader.read(this.turns, at);
    if (!p || !q) return false;
    this.group.position.set(p[0], p[1], p[2]);
    this.group.quaternion.set(q[1], q[2], q[3], q[0]).normalize();
    return true;
  }
  force(at) {
    const f = this.reader.read(this.forces, at);
    return f ? new THREE.Vector3(f[0], f[1], f[2]) : null;
  }
}

function shapeMesh(shape, material) {
  const g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.BufferAttribute(shape.points, 3));
  g.setIndex(new THREE.BufferAttribute(shape.corners, 1));
  const crisp = g.toNonIndexed(); // flat faces keep their edges, round ones are smoothed below
  crisp.computeVertexNormals();
  const mesh = new THREE.Mesh(shape.corners.length > 36 ? smoothed(g, crisp) : crisp, material);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** Normals that are shared across edges of less than 35 degrees. */
function smoothed(indexed, crisp) {
  const corners = indexed.index.array, flat = crisp.attributes.normal.array, points = indexed.attributes.position.array;
  const keys = new Map(), out = new Float32Array(flat.length), limit = Math.cos((35 * Math.PI) / 180);
  const at = (i) => `${points[3 * corners[i]]},${points[3 * corners[i] + 1]},${points[3 * corners[i] + 2]}`;
  for (let i = 0; i < corners.length; i++) {
    const key = at(i);
    if (!keys.has(key)) keys.set(key, []);
    keys.get(key).push(i);
  }
  for (const same of keys.values()) {
    for (const i of same) {
      let x = 0, y = 0, z = 0;
      for (const j of same) {
        const d = flat[3 * i] * flat[3 * j] + flat[3 * i + 1] * flat[3 * j + 1] + flat[3 * i + 2] * flat[3 * j + 2];
        if (d < limit) continue;
        x += flat[3 * j]; y += flat[3 * j + 1]; z += flat[3 * j + 2];
      }
      const l = Math.hypot(x, y, z) || 1;
      out[3 * i] = x / l; out[3 * i + 1] = y / l; out[3 * i + 2] = z / l;
    }
  }
  crisp.setAttribute("normal", new THREE.BufferAttribute(out, 3));
  return crisp;
}

/** An obstacle, a gripper's pad, a clip. */
export class Obstacle extends Posed {
  constructor(run, index, given, reader, stage) {
    super(run, "obstacle", index, given.name || given.kind, given.kind, "obstacle", given.slot, reader);
    this.given = given;
    this.plane = Boolean(given.shape.normal);
    this.fixed = given.slot === undefined;
    if (this.plane) {
      this.normal = new THREE.Vector3(...given.shape.normal);
      this.stage = stage;
    } else {
      const kind = this.fixed ? "clip" : given.part ? "pad" : "wall";
      const mesh = shapeMesh(given.shape, solid(NEUTRAL[kind]));
      mesh.userData.actor = this;
      this.mesh = mesh;
      const edges = new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry, 35),
        new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.22 }));
      this.group.add(mesh, edges);
    }
  }

  update(at, look, hidden) {
    if (this.plane) {
      const there = Boolean(this.reader.read(this.places, at));
      if (there && !this.ground) {
        this.move(at);
        this.ground = this.stage.addGround(this.group.position,
          this.normal.clone().applyQuaternion(this.group.quaternion));
        this.group.position.set(0, 0, 0);
        this.group.quaternion.set(0, 0, 0, 1);
        this.group.add(this.ground);
      }
      this.show(there, hidden);
      return;
    }
    const there = this.fixed || this.move(at);
    this.show(there, hidden);
    if (this.mesh) {
      const glass = look.glass && !this.given.part;
      Object.assign(this.mesh.material, { transparent: glass, opacity: glass ? 0.35 : 1, depthWrite: !glass });
    }
  }
}

/** Along the wire nearest to a point in the first frame in which something holds it. */
function directionNear(run, reader, frame, point) {
  const best = new THREE.Vector3(1, 0, 0), a = new THREE.Vector3(), b = new THREE.Vector3();
  let least = Infinity;
  run.wires.forEach((_, i) => {
    const track = run.film.get("wire", i), x = reader.read(track, { frame, part: 0 });
    const n = x ? track.count(frame) : 0;
    for (let k = 0; k + 1 < n; k++) {
      a.fromArray(x, 3 * k);
      b.fromArray(x, 3 * k + 3);
      const d = a.clone().lerp(b, 0.5).distanceTo(point);
      if (d < least) {
        least = d;
        best.copy(b).sub(a).normalize();
      }
    }
  });
  return best;
}

/** Turned so that x goes along the wire and z up. */
function facing(along, up) {
  const y = new THREE.Vector3().crossVectors(up, along);
  if (y.lengthSq() < 1e-8) y.set(0, 1, 0);
  y.normalize();
  const z = new THREE.Vector3().crossVectors(along, y);
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(along, y, z));
}

/** How a thing on the wire leans against its pose: as it lies on the wire when it takes hold of it. */
class OnWire extends Posed {
  constructor(...args) {
    super(...args);
    this.leans = new Map();
  }
  lean(places, turns, key, first, up) {
    if (!this.leans.has(key)) {
      const p = this.reader.read(places, { frame: first, part: 0 }), q = this.reader.read(turns, { frame: first, part: 0 });
      const turn = new THREE.Quaternion(q[1], q[2], q[3], q[0]).normalize();
      const point = new THREE.Vector3(p[0], p[1], p[2]);
      this.leans.set(key, turn.inverse().multiply(facing(directionNear(this.run, this.reader, first, point), up)));
    }
    return this.leans.get(key);
  }
}

const block = (x, y, z, material, at = [0, 0, 0]) => {
  const mesh = new THREE.Mesh(new THREE.BoxBufferGeometry(x, y, z), material);
  mesh.position.set(...at);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
};

/** A clamp, pin or feed. */
export class Hold extends OnWire {
  constructor(run, index, given, reader, radius, up) {
    super(run, "hold", index, given.name, given.kind, "hold", given.slot, reader);
    this.up = up;
    const r = radius, material = solid(NEUTRAL.hold);
    if (given.kind === "pin") this.group.add(new THREE.Mesh(new THREE.SphereBufferGeometry(2.2 * r, 24, 16), material));
    else if (given.kind === "feed") {
      const tube = new THREE.Mesh(new THREE.CylinderBufferGeometry(2.4 * r, 2.4 * r, 8 * r, 28, 1, true), material);
      tube.rotation.z = Math.PI / 2;
      this.group.add(tube);
    } else this.group.add(block(given.width || 5 * r, 5 * r, 5 * r, material));
    for (const c of this.group.children) c.userData.actor = this;
  }
  update(at, look, hidden) {
    const there = this.move(at);
    if (there) {
      let first = 0;
      while (!this.places.count(first)) first++;
      this.group.quaternion.multiply(this.lean(this.places, this.turns, 0, first, this.up));
      this.group.scale.setScalar(Math.max(1, look.thick * 0.7));
    }
    this.show(there, hidden);
  }
}

/** A gripper: with pads these are seen; without, two jaws that hold the wire. */
export class Gripper extends OnWire {
  constructor(run, index, given, reader, radius, up) {
    super(run, "gripper", index, given.name, "gripper", "tool", given.tool ?? given.carrier ?? -1, reader);
    Object.assign(this, { given, up });
    const r = radius, w = given.width, material = solid(NEUTRAL.grip), y = 1.9 * r, tall = 9 * r;
    this.jaws = new THREE.Group();
    this.jaws.add(block(w, 1.4 * r, tall, material, [0, y, 2.2 * r]), block(w, 1.4 * r, tall, material, [0, -y, 2.2 * r]),
      block(w, 2 * y + 1.4 * r, 2 * r, material, [0, 0, 2.2 * r + tall / 2 + r]),
      block(0.5 * w, 2 * r, 9 * r, material, [0, 0, 7.2 * r + tall / 2]));
    for (const c of this.jaws.children) c.userData.actor = this;
    this.group.add(this.jaws);
    this.spans = given.spans.map((span) => ({ ...span, places: run.film.get("hold", span.hold),
      turns: run.film.get("hold", span.hold, 1), forces: run.film.get("hold", span.hold, 2) }));
  }

  /** The grasp that a time belongs to. */
  spanAt(t) {
    for (let i = this.spans.length - 1; i >= 0; i--) {
      const span = this.spans[i];
      if (t >= span.from - 1e-9 && (span.to === undefined || t <= span.to + 1e-9)) return i;
    }
    return -1;
  }

  update(at, look, hidden) {
    const t = at.time, i = this.spanAt(t), span = this.spans[i];
    let { places, turns } = this;
    this.holding = span;
    if (this.given.tool === undefined && span && !(span.carried !== undefined && t >= span.carried)) ({ places, turns } = span);
    let p = this.reader.read(places, at), q = this.reader.read(turns, at);
    if (!p && span) { // it takes hold between two frames
      const next = { frame: Math.min(at.frame + 1, this.run.film.times.length - 1), part: 0 };
      p = this.reader.read(places, next);
      q = this.reader.read(turns, next);
    }
    if (p && q) {
      this.group.position.set(p[0], p[1], p[2]);
      this.group.quaternion.set(q[1], q[2], q[3], q[0]).normalize();
      this.last = i >= 0 ? i : this.last ?? 0;
      this.pose(i >= 0 ? i : this.last);
    } else if (!this.seen && this.given.first_at) this.group.position.set(...this.given.first_at);
    this.seen = Boolean(p);
    this.jaws.scale.set(Math.max(1, look.thick / 2), look.thick, look.thick);
    this.jaws.visible = this.given.tool === undefined || !this.reader.read(this.run.film.get("tool", this.given.tool), at);
    this.show(Boolean(p) || Boolean(this.given.first_at && t <= (this.spans[0]?.from ?? 0)), hidden);
  }

  pose(i) {
    const span = this.spans[i];
    if (!span || !span.places || !this.jaws.visible) return;
    let first = 0;
    while (first < this.run.film.times.length && !span.places.count(first)) first++;
    if (first === this.run.film.times.length) return;
    this.group.quaternion.multiply(this.lean(span.places, span.turns, i, first, this.up));
  }

  force(at) {
    const own = this.reader.read(this.forces, at);
    const held = this.holding ? this.reader.read(this.holding.forces, at) : null;
    const f = this.given.tool !== undefined || !held ? own : held;
    return f ? new THREE.Vector3(f[0], f[1], f[2]) : null;
  }
}

/** Where a gripper or obstacle goes: its whole way faintly, what is behind it clearly. */
export class Way {
  constructor(actor, lists, accent) {
    const points = [], times = [], film = actor.run.film;
    for (let f = 0; f < film.times.length; f++) {
      for (const track of lists(film.times[f])) {
        const p = track && actor.reader.read(track, { frame: f, part: 0 });
        if (!p) continue;
        points.push(p[0], p[1], p[2]);
        times.push(film.times[f]);
        break;
      }
    }
    this.actor = actor;
    this.times = times;
    this.moves = points.some((x, i) => i > 2 && Math.abs(x - points[i % 3]) > 1e-6);
    const g = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
    const whole = new THREE.Line(g, new THREE.LineBasicMaterial({ color: accent, transparent: true, opacity: 0.3 }));
    this.behind = new THREE.Line(g.clone(), new THREE.LineBasicMaterial({ color: accent }));
    this.group = new THREE.Group();
    this.group.add(whole, this.behind);
    for (const line of this.group.children) {
      line.frustumCulled = false;
      line.userData.whole = true;
    }
  }
  update(at, look, hidden) {
    this.group.visible = this.moves && look.ways && !hidden.has(this.actor.id);
    const { frame } = locate(this.times, at.time);
    this.behind.geometry.setDrawRange(0, frame + 1);
  }
  paint(accent) { for (const line of this.group.children) line.material.color.copy(accent); }
}

export { Reader };
