// SPDX-License-Identifier: GPL-3.0-or-later
// A hand in the scene: what the pointer takes hold of on a wire is pulled, by a spring of limited force, to
// where the pointer is, in the plane of the picture. A gripper is led there, no faster than it may go.
import * as THREE from "three";
import { linear } from "./colours.js";

const GAP = 33; // between two orders [ms]
const rounded = (v) => v.toArray().map((x) => Number(x.toFixed(5))); // hands are no finer [m]

/** Undo what was done by hand last, and say what that did. */
export function undoByHand(link, say) {
  return link.ask("undo").then((words) => say(words || "undone"), (error) => say(error.message));
}

export class Hand {
  constructor(view, state, link) {
    Object.assign(this, { view, state, link, held: null });
    const colour = new THREE.Color(...linear("#f0a020")), { stage } = view;
    const more = { color: colour, depthTest: false, transparent: true };
    this.ball = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 20, 14), new THREE.MeshBasicMaterial(more));
    this.line = new THREE.Line(new THREE.BufferGeometry().setAttribute("position",
      new THREE.BufferAttribute(new Float32Array(6), 3)), new THREE.LineBasicMaterial(more));
    for (const o of [this.ball, this.line]) {
      o.renderOrder = 6;
      o.visible = o.frustumCulled = false;
      o.userData.whole = true;
      stage.scene.add(o);
    }
    stage.before.push(() => this.place());
    stage.canvas.addEventListener("pointerdown", (e) => this.grab(e));
    stage.canvas.addEventListener("pointermove", (e) => this.hover(e));
    addEventListener("pointermove", (e) => this.drag(e));
    addEventListener("pointerup", () => this.let());
    addEventListener("pointercancel", () => this.let());
    addEventListener("blur", () => this.let());
  }

  can() { return this.state.get("hand") && !this.view.busy && !this.state.get("run").at_start && !this.state.get("tool") && !this.state.get("over"); }

  hover(e) {
    if (this.held || e.buttons) return;
    const hit = this.can() && this.view.hitAt(e.clientX, e.clientY);
    this.view.host.classList.toggle("grabbing", Boolean(hit && (hit.actor.kind === "wire" || this.gripperOf(hit.actor))));
  }

  /** The gripper that this is, or is a part of; not while its place in a form is chosen by handles. */
  gripperOf(actor) {
    if (actor.kind === "gripper") return actor;
    const part = actor.kind === "obstacle" && actor.given.part;
    return part ? this.view.actors.find((a) => a.kind === "gripper" && a.name === part) : null;
  }

  grab(e) {
    if (e.button !== 0 || e.shiftKey || e.ctrlKey || !this.can()) return;
    const hit = this.view.hitAt(e.clientX, e.clientY);
    const { stage } = this.view, gripper = hit && this.gripperOf(hit.actor);
    if (!hit || (hit.actor.kind !== "wire" && !gripper)) return;
    const s = gripper ? null : hit.actor.arcAt(hit.vertex), actor = gripper || hit.actor;
    const normal = stage.camera.getWorldDirection(new THREE.Vector3());
    const at = gripper ? gripper.group.position.clone() : hit.actor.place(s)?.point || hit.point;
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, at);
    this.held = { actor: actor.id, name: actor.name, gripper: Boolean(gripper), s, to: at.clone(), started: false,
      from: [e.clientX, e.clientY], plane };
    const first = gripper && this.aim(e.clientX, e.clientY); // it may be taken beside its centre
    this.held.beside = first ? at.sub(first) : null;
    stage.controls.enabled = false;
    this.state.set({ follow: true });
  }

  /** Where the pointer is, in the plane through what it took hold of. */
  aim(x, y) {
    const { stage } = this.view, box = stage.canvas.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2), stage.camera);
    return ray.ray.intersectPlane(this.held.plane, new THREE.Vector3());
  }

  drag(e) {
    const { held } = this;
    if (!held) return;
    if (!held.started && Math.hypot(e.clientX - held.from[0], e.clientY - held.from[1]) < 4) return; // still a click
    const to = this.aim(e.clientX, e.clientY);
    if (!to) return;
    held.to.copy(held.beside ? to.add(held.beside) : to);
    this.view.stage.touch();
    if (!held.started && held.gripper) {
      held.started = true;
      this.tell();
      return;
    }
    if (!held.started) {
      const { force, stiffness } = this.state.get("grip");
      held.started = this.link.order("pull", { wire: held.name, s: Number(held.s.toPrecision(4)), to: rounded(to), force, stiffness });
      held.told = performance.now();
      return;
    }
    clearTimeout(held.timer);
    const left = GAP - (performance.now() - held.told);
    if (left > 0) held.timer = setTimeout(() => this.tell(), left); else this.tell();
  }

  tell() {
    if (!this.held) return;
    const { held } = this, to = rounded(held.to);
    held.told = performance.now();
    if (held.gripper) this.link.order("lead", { gripper: held.name, to, speed: this.state.get("lead") });
    else this.link.order("reach", { to });
  }

  let() {
    const { held } = this;
    if (!held) return;
    clearTimeout(held.timer);
    if (held.started && held.gripper) this.link.order("leave", { gripper: held.name });
    else if (held.started) {
      this.tell();
      this.link.order("let");
    }
    this.held = null;
    this.view.stage.controls.enabled = true;
    this.view.stage.touch();
  }

  place() {
    const { held } = this, actor = held?.started && this.view.find(held.actor);
    const at = actor && (held.gripper ? actor.group.position : actor.place(held.s)?.point);
    this.ball.visible = this.line.visible = Boolean(at);
    if (!at) return;
    this.ball.position.copy(held.to);
    this.ball.scale.setScalar(0.006 * this.view.stage.camera.position.distanceTo(held.to));
    const p = this.line.geometry.attributes.position;
    at.toArray(p.array, 0);
    held.to.toArray(p.array, 3);
    p.needsUpdate = true;
  }
}
