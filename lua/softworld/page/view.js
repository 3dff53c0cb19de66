// SPDX-License-Identifier: GPL-3.0-or-later
// The view: all runs' actors on one stage, in step with the shared state; probe and measure.
import * as THREE from "three";
import { locate } from "./film.js";
import { knownQuantities } from "./model.js";
import { scaleOf, linear } from "./colours.js";
import { Stage } from "./stage.js";
import { Wire, Particles, Reader } from "./actors.js";
import { Obstacle, Zone, Hold, Gripper, Way } from "./bodies.js";
import { Arrows } from "./arrows.js";

/** The box around all wires at all times, and some of their points. */
function boundsOf(data) {
  const box = new THREE.Box3(), points = [], room = [];
  const see = (track, frames) => {
    const step = Math.max(1, Math.floor(frames / 80));
    for (let f = 0; f < frames; f += step) {
      const n = track.sample(f, 0, room), skip = Math.max(1, Math.floor((n - 1) / 40));
      for (let i = 0; i < n; i += skip) {
        const point = new THREE.Vector3().fromArray(room, 3 * i);
        points.push(point);
        box.expandByPoint(point);
      }
    }
  };
  for (const run of data.runs) {
    for (const track of run.film.tracks.values()) {
      if (track.kind === "wire" || track.kind === "surface" || track.kind === "particles"
        || (track.kind === "tool" && track.channel === 0)) see(track, run.film.times.length);
    }
  }
  if (box.isEmpty()) box.set(new THREE.Vector3(-0.5, -0.5, -0.5), new THREE.Vector3(0.5, 0.5, 0.5));
  const size = box.getSize(new THREE.Vector3()).length();
  return { box, size, points };
}

/** The same with obstacles, as far as they are near. */
function withObstacles(data, { box, size, points }) {
  const corners = (b) => {
    for (let k = 0; k < 8; k++) {
      points.push(new THREE.Vector3(k & 1 ? b.max.x : b.min.x, k & 2 ? b.max.y : b.min.y, k & 4 ? b.max.z : b.min.z));
    }
  };
  for (const run of data.runs) {
    for (const grip of run.grips) {
      const at = !grip.spans.length && grip.first_at && new THREE.Vector3(...grip.first_at);
      if (!at) continue;
      points.push(at);
      box.expandByPoint(at);
    }
  }
  const whole = box.clone(), reach = box.clone().expandByScalar(0.25 * size), room = [];
  for (const run of data.runs) {
    for (const o of run.obstacles) {
      if (!o.shape.points) continue;
      const own = new THREE.Box3().setFromArray(o.shape.points);
      const places = o.slot === undefined ? null : run.film.get("obstacle", o.slot);
      const turns = o.slot === undefined ? null : run.film.get("obstacle", o.slot, 1);
      for (const f of places ? [0, run.film.times.length - 1] : [0]) {
        const there = own.clone();
        if (places && places.sample(f, 0, room)) {
          const p = new THREE.Vector3(...room.slice(0, 3));
          turns.sample(f, 0, room);
          there.applyMatrix4(new THREE.Matrix4().compose(p, new THREE.Quaternion(room[1], room[2], room[3], room[0]),
            new THREE.Vector3(1, 1, 1)));
        } else if (places) continue;
        if (!there.intersectsBox(reach)) continue;
        whole.union(there.intersect(reach));
        corners(there);
      }
    }
  }
  if (!points.length) corners(whole);
  return { box: whole, points };
}

export class View {
  constructor(host, data, state) {
    Object.assign(this, { host, data, state });
    const wires = boundsOf(data), g = data.runs[0].gravity || [0, 0, 0];
    const up = new THREE.Vector3(-g[0], -g[1], -g[2]);
    if (up.lengthSq() < 1e-12) up.set(0, 0, 1);
    const all = withObstacles(data, wires);
    this.stage = new Stage(host, all.box, all.points, up.normalize());
    this.radius = Math.min(...data.runs.flatMap((r) => r.wires.map((w) => w.radius)).filter((r) => r > 0), this.stage.size / 40);
    this.actors = [];
    this.ways = [];
    this.accent = new THREE.Color("#20a39e");
    for (const run of data.runs) this.addRun(run);
    this.contacts = new Arrows("#e0433b");
    this.held = new Arrows("#20a39e");
    this.stage.scene.add(this.contacts.mesh, this.held.mesh);
    this.addMarks();
    this.stage.before.push(() => this.scaleMarks());
    this.stage.after.push(() => this.placeLabels());
    this.listen();
  }

  addRun(run) {
    const reader = new Reader(run.film), { up } = this.stage, add = (actor) => {
      this.actors.push(actor);
      this.stage.scene.add(actor.group);
      return actor;
    };
    run.wires.forEach((w, i) => add(new Wire(run, i, w, reader)));
    run.particles.forEach((p, i) => add(new Particles(run, i, p, reader)));
    run.obstacles.forEach((o, i) => {
      const actor = add(new Obstacle(run, i, o, reader, this.stage));
      if (!actor.plane && !actor.fixed && !o.part) this.addWay(actor, () => [actor.places]);
    });
    run.zones.forEach((zone, i) => add(new Zone(run, i, zone, reader)));
    run.holds.forEach((hold, i) => {
      const actor = add(new Hold(run, i, hold, reader, this.radius, up));
      this.addWay(actor, () => [actor.places]);
    });
    run.grips.forEach((grip, i) => {
      const actor = add(new Gripper(run, i, grip, reader, this.radius, up));
      this.addWay(actor, (t) => [actor.spans[actor.spanAt(t)]?.places, actor.places]);
    });
  }

  /** What is in the scene has changed: everything is made anew, the camera stays where it is. */
  renew() {
    const { scene, grounds } = this.stage;
    for (const a of [...this.actors, ...this.ways]) scene.remove(a.group);
    this.actors = [];
    this.ways = [];
    grounds.length = 0;
    this.colourKey = null;
    for (const run of this.data.runs) this.addRun(run);
    this.stage.shadows(this.state.get("shadows"));
    this.update();
    const { cut, cutAt, flip } = this.state.values;
    this.stage.section(cut, cutAt, flip);
  }

  /** The scene is another one: its bounds and the thinnest wire. Returns whether the camera had to go elsewhere. */
  refit(always) {
    const all = withObstacles(this.data, boundsOf(this.data)), moved = this.stage.fit(all.box, all.points, always);
    this.radius = Math.min(...this.data.runs.flatMap((r) => r.wires.map((w) => w.radius)).filter((r) => r > 0), this.stage.size / 40);
    return moved;
  }

  /** From a standard side; null: from where the camera is. A run under way has gone on meanwhile. */
  look(name) {
    if (this.data.live) this.refit(true);
    this.stage.look(name);
  }

  addWay(actor, lists) {
    if (this.data.live) return; // where it will go is not known
    const way = new Way(actor, lists, this.accent);
    if (!way.moves) return;
    this.ways.push(way);
    this.stage.scene.add(way.group);
  }

  /** Balls at the probe and at the ends of what is measured, and a line between these. */
  addMarks() {
    const ball = (hex) => {
      const mesh = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 20, 14),
        new THREE.MeshBasicMaterial({ color: new THREE.Color(...linear(hex)), depthTest: false, transparent: true }));
      mesh.renderOrder = 5;
      mesh.userData.whole = true;
      mesh.visible = false;
      this.stage.scene.add(mesh);
      return mesh;
    };
    this.probeMark = ball("#20a39e");
    this.ends = [ball("#d9a520"), ball("#d9a520")];
    this.tape = new THREE.Line(new THREE.BufferGeometry().setAttribute("position",
      new THREE.BufferAttribute(new Float32Array(6), 3)),
    new THREE.LineBasicMaterial({ color: new THREE.Color(...linear("#d9a520")), depthTest: false, transparent: true }));
    this.tape.frustumCulled = false;
    this.tape.userData.whole = true;
    this.tape.renderOrder = 5;
    this.tape.visible = false;
    this.stage.scene.add(this.tape);
    this.measured = [];
    this.label = document.createElement("div");
    this.label.className = "stage-label";
    this.label.hidden = true;
    this.host.append(this.label);
  }

  scaleMarks() {
    for (const mark of [this.probeMark, ...this.ends]) {
      mark.scale.setScalar(0.0052 * this.stage.camera.position.distanceTo(mark.position));
    }
  }

  listen() {
    this.state.watch(["time", "quantity", "range", "thick", "arrows", "ways", "glass", "hidden", "theme", "probe",
      "custom"], () => this.update());
    let down = null;
    const { canvas } = this.stage;
    canvas.addEventListener("pointerdown", (e) => { down = [e.clientX, e.clientY]; });
    canvas.addEventListener("pointerup", (e) => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 4 && e.button === 0) this.click(e.clientX, e.clientY);
      down = null;
    });
  }

  /** The colours of the present quantity: { quantity, scale }. */
  colouring() {
    const { quantity, range, time, hidden, custom } = this.state.values;
    if (!quantity) return { quantity: null, scale: null };
    const key = `${quantity} ${range} ${range === "frame" ? time : ""} ${custom || ""} ${[...hidden].join()} ${this.data.runs[0].film.version || 0}`;
    if (this.colourKey !== key) {
      this.colourKey = key;
      const q = knownQuantities(this.data, range, time, hidden).find((k) => k.key === quantity);
      this.colours = q ? { quantity: q, scale: custom ? scaleOf(custom[0], custom[1]) : scaleOf(q.low, q.high) }
        : { quantity: null, scale: null };
    }
    return this.colours;
  }

  update() {
    const { time, thick, arrows, ways, glass, hidden } = this.state.values;
    const look = { ...this.colouring(), thick, ways, glass, least: 0 };
    for (const run of this.data.runs) run.at = { ...locate(run.film.times, time), time };
    for (const actor of this.actors) actor.update(actor.run.at, look, hidden);
    for (const way of this.ways) way.update(way.actor.run.at, look, hidden);
    this.updateArrows(arrows);
    this.updateProbe();
    this.updateMeasure();
    this.onupdate?.(look);
    this.stage.touch();
  }

  /** The largest force of a run's tracks, found once. */
  largest(kind) {
    const version = Math.floor((this.data.runs[0].film.version || 0) / 30);
    if (!this.most || this.version !== version) this.most = {};
    this.version = version;
    if (this.most[kind] === undefined) {
      let most = 0;
      for (const run of this.data.runs) {
        for (const track of run.film.tracks.values()) {
          const wanted = kind === "contact" ? track.kind === "value" && track.channel === 5
            : (track.kind === "hold" || track.kind === "tool") && track.channel === 2;
          if (!wanted) continue;
          // blows are rare and far larger: what is not exceeded in 99.8 % of the frames is shown in full
          const sizes = [], room = [], { counts } = track;
          for (let f = 0; f < counts.length; f++) {
            const n = 3 * track.sample(f, 0, room);
            let own = 0;
            for (let i = 0; i < n; i += 3) {
              const sum = room[i] ** 2 + room[i + 1] ** 2 + room[i + 2] ** 2;
              if (sum > own) own = sum; // what is no number is not
            }
            sizes.push(Math.sqrt(own));
          }
          sizes.sort((a, b) => a - b);
          most = Math.max(most, sizes[Math.floor(0.998 * (sizes.length - 1))] || 0);
        }
      }
      this.most[kind] = most;
    }
    return this.most[kind];
  }

  updateArrows(on) {
    this.contacts.begin();
    this.held.begin();
    if (on) {
      const longest = 0.14 * this.stage.size, point = new THREE.Vector3(), force = new THREE.Vector3();
      const most = this.largest("contact"), pull = this.largest("hold");
      for (const actor of this.actors) {
        if (!actor.group.visible) continue;
        if (actor.kind === "wire" && most > 0) {
          const f = actor.reader.read(actor.forces, actor.at);
          for (let i = 0; f && i < actor.count; i++) {
            force.fromArray(f, 3 * i);
            if (force.length() > most) force.setLength(most);
            this.contacts.add(point.fromArray(actor.nodes, 3 * i), force, most, longest, 0.7);
          }
        } else if ((actor.kind === "gripper" || actor.kind === "hold") && pull > 0) {
          const f = actor.force(actor.run.at);
          if (f) this.held.add(actor.group.position, f.length() > pull ? f.setLength(pull) : f, pull, longest, 1);
        }
      }
    }
    this.contacts.end();
    this.held.end();
  }

  /* --- probe and measure ------------------------------------------------------------ */

  find(id) { return this.actors.find((a) => a.id === id); }

  hitAt(x, y) {
    const list = [];
    for (const a of this.actors) {
      if (a.group.visible && !a.plane) a.group.traverse((o) => { if (o.isMesh && o.userData.actor) list.push(o); });
    }
    const hit = this.stage.pick(x, y, list)[0];
    return hit ? { point: hit.point, actor: hit.object.userData.actor, vertex: hit.face.a } : null;
  }

  click(x, y) {
    if (this.busy) return; // a handle was held
    const hit = this.hitAt(x, y);
    if (this.state.get("tool") === "measure") {
      if (!hit) return;
      if (this.measured.length > 1) this.measured = [];
      this.measured.push(hit.actor.kind === "wire" ? { actor: hit.actor, s: hit.actor.arcAt(hit.vertex) }
        : { actor: hit.actor, local: hit.actor.group.worldToLocal(hit.point.clone()) });
      this.update();
      return;
    }
    if (!hit) {
      this.state.set({ probe: null, selected: null });
      return;
    }
    this.state.set({ selected: hit.actor.id,
      probe: hit.actor.kind === "wire" ? { id: hit.actor.id, s: hit.actor.arcAt(hit.vertex) } : null });
  }

  updateProbe() {
    const probe = this.state.get("probe");
    const actor = probe && this.find(probe.id), at = actor && actor.group.visible ? actor.place(probe.s) : null;
    this.probeMark.visible = Boolean(at);
    if (at) this.probeMark.position.copy(at.point);
    this.onprobe?.(actor, at, probe);
  }

  placeOf(end) {
    if (!end.actor.group.visible) return null;
    if (end.s !== undefined) return end.actor.place(end.s)?.point || null;
    end.actor.group.updateMatrixWorld();
    return end.actor.group.localToWorld(end.local.clone());
  }

  updateMeasure() {
    const on = this.state.get("tool") === "measure";
    const places = on ? this.measured.map((end) => this.placeOf(end)) : [];
    this.ends.forEach((mark, i) => {
      mark.visible = Boolean(places[i]);
      if (places[i]) mark.position.copy(places[i]);
    });
    const both = places.length === 2 && places[0] && places[1];
    this.tape.visible = Boolean(both);
    this.tapeMiddle = null;
    if (both) {
      const p = this.tape.geometry.attributes.position;
      places[0].toArray(p.array, 0);
      places[1].toArray(p.array, 3);
      p.needsUpdate = true;
      this.tapeMiddle = places[0].clone().lerp(places[1], 0.5);
      const d = places[1].clone().sub(places[0]);
      this.onmeasure?.(d.length(), d);
    } else this.onmeasure?.(null, null, places.length);
  }

  forgetMeasure() {
    this.measured = [];
    this.updateMeasure();
    this.stage.touch();
  }

  placeLabels() {
    const at = this.tapeMiddle && this.stage.onScreen(this.tapeMiddle);
    this.label.hidden = !at;
    if (at) Object.assign(this.label.style, { left: `${at[0]}px`, top: `${at[1]}px` });
  }

  paint(theme) {
    this.accent.set(theme.accent);
    for (const way of this.ways) way.paint(this.accent);
    this.stage.paint(theme);
  }
}
