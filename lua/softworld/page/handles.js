// SPDX-License-Identifier: GPL-3.0-or-later
// Handles of what is chosen in the picture: three arrows by which an obstacle or a gripper is taken along an axis. Where it
// is let go it is put, by the same line as its form's `at`.
import * as THREE from "three";
import { linear } from "./colours.js";

const AXES = [["x", "#d1495b", [1, 0, 0]], ["y", "#2fa36b", [0, 1, 0]], ["z", "#3f7fe0", [0, 0, 1]]];
const STEP = 1e-3; // places are whole steps from the origin [m]

function arrow(hex, way) {
  const paint = { color: new THREE.Color(...linear(hex)), depthTest: false, transparent: true };
  const group = new THREE.Group(), material = new THREE.MeshBasicMaterial(paint);
  const shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.018, 0.018, 0.8, 12), material);
  const head = new THREE.Mesh(new THREE.ConeBufferGeometry(0.065, 0.22, 18), material);
  const grip = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.11, 0.11, 0.95, 8), // what the pointer takes
    new THREE.MeshBasicMaterial({ visible: false }));
  shaft.position.y = 0.45;
  head.position.y = 0.92;
  grip.position.y = 0.6;
  for (const o of [shaft, head, grip]) {
    o.renderOrder = 7;
    o.userData.whole = true;
    group.add(o);
  }
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), way);
  return { group, grip, material };
}

export class Handles {
  /** may(actor): can it be moved now? put(actor, k, x): component k of its place is to be x [m], a promise that fails with what is wrong. */
  constructor(view, state, { may, put, say }) {
    Object.assign(this, { view, state, may, put, say, held: null });
    this.group = new THREE.Group();
    this.group.visible = false;
    this.arrows = AXES.map(([name, hex, way]) => {
      const axis = new THREE.Vector3(...way), one = arrow(hex, axis);
      this.group.add(one.group);
      return { ...one, name, axis };
    });
    view.stage.scene.add(this.group);
    this.label = document.createElement("div");
    this.label.className = "stage-label";
    this.label.hidden = true;
    view.host.append(this.label);
    view.stage.before.push(() => this.follow());
    view.stage.canvas.addEventListener("pointerdown", (e) => this.take(e), { capture: true });
    view.stage.canvas.addEventListener("pointermove", (e) => this.hover(e));
    addEventListener("pointermove", (e) => this.drag(e));
    addEventListener("pointerup", () => this.let());
    addEventListener("pointercancel", () => this.let(true));
    addEventListener("keydown", (e) => { if (e.key === "Escape" && this.held) { e.stopImmediatePropagation(); this.let(true); } }, { capture: true });
    state.watch(["selected", "run"], () => view.stage.touch());
  }

  get actor() {
    const actor = this.view.find(this.state.get("selected"));
    return actor && actor.group.visible && this.may(actor) ? actor : null;
  }

  follow() {
    const actor = this.held?.actor || this.actor;
    this.group.visible = Boolean(actor);
    if (!actor) return;
    this.group.position.copy(actor.group.position);
    this.group.scale.setScalar(0.13 * this.view.stage.camera.position.distanceTo(this.group.position));
  }

  under(e) {
    if (!this.group.visible || this.state.get("tool")) return null;
    this.group.updateMatrixWorld(true);
    const hit = this.view.stage.pick(e.clientX, e.clientY, this.arrows.map((a) => a.grip))[0];
    return hit ? this.arrows.find((a) => a.grip === hit.object) : null;
  }

  hover(e) {
    if (this.held || e.buttons) return;
    const over = this.under(e);
    for (const a of this.arrows) a.material.opacity = !over || a === over ? 1 : 0.45;
    this.view.host.classList.toggle("handling", Boolean(over));
    if (this.group.visible) this.view.stage.touch();
  }

  /** How far along the axis the pointer is [m]. */
  along(e) {
    const { stage } = this.view, box = stage.canvas.getBoundingClientRect(), caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(((e.clientX - box.left) / box.width) * 2 - 1, 1 - ((e.clientY - box.top) / box.height) * 2), stage.camera);
    const { axis, from } = this.held, { origin, direction } = caster.ray, b = axis.dot(direction), gap = from.clone().sub(origin);
    const across = 1 - b * b; // of two lines the nearest places
    return across < 1e-4 ? null : (b * gap.dot(direction) - gap.dot(axis)) / across;
  }

  take(e) {
    const over = e.button === 0 && this.under(e), { actor } = this;
    if (!over || !actor) return;
    this.held = { actor, axis: over.axis, name: over.name, from: actor.group.position.clone() };
    this.held.start = this.along(e);
    this.view.busy = true;
    this.view.stage.controls.enabled = false;
  }

  drag(e) {
    const { held } = this;
    if (!held) return;
    const t = this.along(e);
    if (t === null || held.start === null) return;
    const k = AXES.findIndex(([name]) => name === held.name), to = held.from.clone();
    to.setComponent(k, Math.round((held.from.getComponent(k) + t - held.start) / STEP) * STEP);
    held.to = to;
    held.actor.group.position.copy(to);
    const at = this.view.stage.onScreen(to);
    this.label.hidden = !at;
    this.label.textContent = `${held.name} = ${to.getComponent(k).toFixed(3).replace("-", "−")} m`;
    if (at) Object.assign(this.label.style, { left: `${at[0]}px`, top: `${at[1]}px` });
    this.view.stage.touch();
  }

  async let(never) {
    const { held } = this;
    if (!held) return;
    this.held = null;
    this.label.hidden = true;
    this.view.stage.controls.enabled = true;
    setTimeout(() => { this.view.busy = false; }, 0);
    if (!never && held.to && held.to.distanceTo(held.from) > STEP / 2) {
      const k = AXES.findIndex(([name]) => name === held.name);
      await this.put(held.actor, k, Number(held.to.getComponent(k).toFixed(6))).catch((error) => {
        this.say(error.message);
        this.view.update();
      });
    } else this.view.update();
  }
}
