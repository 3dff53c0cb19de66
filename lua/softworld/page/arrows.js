// SPDX-License-Identifier: GPL-3.0-or-later
// Forces as arrows: at the nodes of wires, and of grippers and holds.
import * as THREE from "three";
import { linear } from "./colours.js";

const MOST = 4000;      // arrows
const LEAST = 0.02;     // share of the largest force below which there is none

/** An arrow along y, of length 1. */
function shape() {
  const shaft = new THREE.CylinderBufferGeometry(0.018, 0.018, 0.78, 8).translate(0, 0.39, 0);
  const head = new THREE.ConeBufferGeometry(0.06, 0.22, 12).translate(0, 0.89, 0);
  const g = new THREE.BufferGeometry(), index = [];
  for (const name of ["position", "normal"]) {
    const a = shaft.attributes[name].array, b = head.attributes[name].array, all = new Float32Array(a.length + b.length);
    all.set(a);
    all.set(b, a.length);
    g.setAttribute(name, new THREE.BufferAttribute(all, 3));
  }
  index.push(...shaft.index.array);
  for (const i of head.index.array) index.push(i + shaft.attributes.position.count);
  g.setIndex(index);
  return g;
}

export class Arrows {
  constructor(hex) {
    this.mesh = new THREE.InstancedMesh(shape(), new THREE.MeshPhongMaterial({ color: new THREE.Color(...linear(hex)),
      shininess: 20, specular: new THREE.Color(0.05, 0.05, 0.05) }), MOST);
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
    this.turn = new THREE.Quaternion();
    this.up = new THREE.Vector3(0, 1, 0);
    this.matrix = new THREE.Matrix4();
  }
  begin() { this.count = 0; }
  add(point, force, largest, longest, thick = 1) {
    const size = force.length();
    if (!(size > LEAST * largest) || this.count >= MOST) return;
    const length = (size / largest) * longest;
    this.turn.setFromUnitVectors(this.up, force.clone().divideScalar(size));
    const wide = thick * Math.max(0.35 * longest, Math.min(longest, length * 1.6));
    this.matrix.compose(point, this.turn, new THREE.Vector3(wide, length, wide));
    this.mesh.setMatrixAt(this.count++, this.matrix);
  }
  end() {
    this.mesh.count = this.count;
    this.mesh.visible = this.count > 0;
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
