// SPDX-License-Identifier: GPL-3.0-or-later
// What moves as a whole: obstacles, holds, grippers, and the ways they go.
import * as THREE from "three";
import { locate } from "./film.js";
import { Actor, solid } from "./actors.js";

const NEUTRAL = { wall: "#aeb6c2", pad: "#8c99ab", clip: "#9a8fb5", hold: "#5d6b7e", grip: "#4c8b86" };

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

/** A part of space that is watched: to be kept out of, or with a temperature. Seen through, and never in the way. */
export class Zone extends Posed {
  constructor(run, index, given, reader) {
    super(run, "zone", index, given.name, given.temperature === undefined ? "to be kept out of" : `${given.temperature} °C`,
      "obstacle", given.on ? given.on.slot : -1, reader);
    const color = given.temperature === undefined ? "#d63d3d" : "#e6941a";
    const mesh = shapeMesh(given.shape, solid(color));
    Object.assign(mesh.material, { transparent: true, opacity: 0.13, depthWrite: false, side: THREE.DoubleSide });
    mesh.castShadow = mesh.receiveShadow = false;
    this.group.add(mesh, new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry, 35),
      new THREE.LineBasicMaterial({ color: new THREE.Color(color).convertSRGBToLinear(), transparent: true, opacity: 0.7 })));
    const { at, rotation: [w, a, b, c] } = given.on || given;
    this.at = new THREE.Vector3(...at);
    this.turn = new THREE.Quaternion(a, b, c, w).normalize();
    this.group.position.copy(this.at);
    this.group.quaternion.copy(this.turn);
    this.carried = Boolean(given.on);
    this.forces = undefined; // those are the obstacle's
  }
  /** With its obstacle, where it has one. */
  update(at, look, hidden) {
    const there = !this.carried || this.move(at);
    if (there && this.carried) {
      this.group.position.add(this.at.clone().applyQuaternion(this.group.quaternion));
      this.group.quaternion.multiply(this.turn);
    }
    this.show(there, hidden);
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

  /** Where it let go of its last wire before this frame, if nothing has carried it since: [place, turn]. */
  leftAt(at) {
    const over = (this.given.tool ?? this.given.carrier) !== undefined ? null : this.spans.filter((s) => s.to <= at.time + 1e-9).pop();
    for (let f = at.frame; over && f >= 0; f--) {
      const then = { frame: f, part: 0 }, p = this.reader.read(over.places, then);
      if (p) return [p, this.reader.read(over.turns, then)];
    }
    return [];
  }

  update(at, look, hidden) {
    const t = at.time, i = this.spanAt(t), span = this.spans[i];
    if (t > this.given.left + 1e-9) { // it was taken away
      this.show(false, hidden);
      return;
    }
    let { places, turns } = this;
    this.holding = span;
    if (this.given.tool === undefined && span && !(span.carried !== undefined && t >= span.carried)) ({ places, turns } = span);
    let p = this.reader.read(places, at), q = this.reader.read(turns, at);
    if (!p && span) { // it takes hold between two frames
      const next = { frame: Math.min(at.frame + 1, this.run.film.times.length - 1), part: 0 };
      p = this.reader.read(places, next);
      q = this.reader.read(turns, next);
    }
    if (!p) [p, q] = this.leftAt(at);
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
