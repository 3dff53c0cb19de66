// SPDX-License-Identifier: GPL-3.0-or-later
// The stage: renderer, lights, ground, camera with its views, section plane.
import * as THREE from "three";
import { OrbitControls } from "three-controls";
import { linear } from "./colours.js";

const FOV = 32; // of the picture's height [deg]

const GROUND = {
  vertex: `varying vec2 at;
    uniform float size;
    void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
  fragment: `varying vec2 at;
    uniform float size, step_length, strength;
    uniform vec3 colour, line_colour;
    float lines(vec2 p, float width) {
      vec2 g = abs(fract(p - 0.5) - 0.5) / fwidth(p);
      return 1.0 - min(min(g.x, g.y) / width, 1.0);
    }
    void main() {
      vec2 p = (at - 0.5) * size;
      float fade = 1.0 - smoothstep(0.25, 0.5, length(at - 0.5));
      float fine = lines(p / step_length, 1.0) * 0.35, wide = lines(p / step_length / 5.0, 1.2) * 0.75;
      float line = max(fine, wide) * strength;
      gl_FragColor = vec4(mix(colour, line_colour, line), fade * max(0.72, line));
    }`,
};

/** A length of 1, 2 or 5 times a power of ten, near a given one. */
export function roundLength(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * ([1, 2, 5, 10].find((k) => k * power >= x * 0.999) || 10);
}

export class Stage {
  constructor(host, bounds, points, up) {
    this.host = host;
    this.bounds = bounds;
    this.points = points; // some of what is to be seen, at all times
    this.up = up;
    this.size = Math.max(bounds.getSize(new THREE.Vector3()).length(), 1e-4);
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: false, preserveDrawingBuffer: false });
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.localClippingEnabled = true;
    this.planes = []; // of the section
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The scene in three dimensions");
    host.prepend(this.canvas);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(FOV, 1, this.size / 2000, this.size * 60);
    this.camera.up.copy(up);
    this.controls = new OrbitControls(this.camera, this.canvas);
    Object.assign(this.controls, { enableKeys: false, screenSpacePanning: true, rotateSpeed: 0.8,
      minDistance: this.size / 500, maxDistance: this.size * 20 });
    this.controls.addEventListener("change", () => this.touch());
    this.grounds = [];
    this.before = []; // called before each picture
    this.after = [];
    this.addLights();
    this.clip = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
    this.look("iso");
  }

  addLights() {
    this.sky = new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.62);
    this.sky.position.copy(this.up);
    this.sun = new THREE.DirectionalLight(0xffffff, 0.62);
    this.placeSun();
    this.lamp = new THREE.DirectionalLight(0xffffff, 0.2); // from beside the camera
    this.camera.add(this.lamp);
    this.scene.add(this.sky, this.sun, this.sun.target, this.camera);
  }

  placeSun() {
    const centre = this.bounds.getCenter(new THREE.Vector3());
    const side = new THREE.Vector3(1, 0, 0).cross(this.up);
    if (side.lengthSq() < 0.01) side.set(0, 1, 0);
    side.normalize();
    this.sun.position.copy(centre).addScaledVector(this.up, this.size).addScaledVector(side, this.size * 0.45)
      .addScaledVector(new THREE.Vector3().crossVectors(this.up, side), this.size * 0.35);
    this.sun.target.position.copy(centre);
    this.sun.castShadow = true;
    const s = this.sun.shadow, reach = this.size * 0.6;
    s.mapSize.set(2048, 2048);
    s.radius = 2;
    s.bias = -0.0004;
    Object.assign(s.camera, { left: -reach, right: reach, top: reach, bottom: -reach,
      near: this.size * 0.05, far: this.size * 2.4 });
    s.camera.updateProjectionMatrix();
  }

  /** Other bounds. Where they are much like the ones before the camera stays; else it goes there: true. */
  fit(bounds, points, always) {
    const size = Math.max(bounds.getSize(new THREE.Vector3()).length(), 1e-4);
    const like = this.bounds.clone().expandByScalar(0.2 * this.size).containsBox(bounds) && size > 0.45 * this.size;
    Object.assign(this, { points });
    if (like && !always) return false;
    Object.assign(this, { bounds, size });
    Object.assign(this.camera, { near: size / 2000, far: size * 60 });
    this.camera.updateProjectionMatrix();
    Object.assign(this.controls, { minDistance: size / 500, maxDistance: size * 20 });
    this.placeSun();
    if (!like) this.look(null);
    return true;
  }

  /** Without a graphics card shadows cost more than all the rest. */
  isSoftware() {
    const gl = this.renderer.getContext(), more = gl.getExtension("WEBGL_debug_renderer_info");
    return /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(more ? more.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  }

  shadows(on) {
    this.renderer.shadowMap.enabled = this.sun.castShadow = on;
    for (const g of this.grounds) g.shade.visible = on;
    this.scene.traverse((o) => { if (o.material) o.material.needsUpdate = true; });
    this.touch();
  }

  /** A piece of a plane: grid and shadows. */
  addGround(point, normal) {
    const n = normal.clone().normalize();
    const centre = this.bounds.getCenter(new THREE.Vector3());
    centre.addScaledVector(n, n.dot(point) - n.dot(centre));
    const size = this.size * 4, group = new THREE.Group();
    const step = roundLength(this.size / 25);
    const shape = new THREE.PlaneBufferGeometry(size, size);
    const floor = new THREE.Mesh(shape, new THREE.ShaderMaterial({
      vertexShader: GROUND.vertex, fragmentShader: GROUND.fragment, transparent: true, depthWrite: false,
      side: THREE.DoubleSide, extensions: { derivatives: true },
      uniforms: { size: { value: size }, step_length: { value: step }, strength: { value: 1 },
        colour: { value: new THREE.Color() }, line_colour: { value: new THREE.Color() } },
    }));
    floor.renderOrder = -2;
    const shade = new THREE.Mesh(shape, new THREE.ShadowMaterial({ opacity: 0.3, depthWrite: false }));
    shade.receiveShadow = true;
    shade.renderOrder = -1;
    floor.userData.whole = shade.userData.whole = true;
    group.add(floor, shade);
    group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), n);
    // lines of the grid go through the origin
    const inside = group.quaternion.clone().inverse();
    const local = centre.clone().applyQuaternion(inside);
    local.x = Math.round(local.x / step / 5) * step * 5;
    local.y = Math.round(local.y / step / 5) * step * 5;
    group.position.copy(local.applyQuaternion(group.quaternion));
    shade.visible = this.renderer.shadowMap.enabled;
    this.grounds.push({ group, floor, shade, step });
    this.paintGround();
    return group;
  }

  /** Colours of a theme: background, ground, lines (CSS colours). */
  paint(theme) {
    this.theme = theme;
    // a background is no lit colour: it is given as it is to be seen
    this.renderer.setClearColor(new THREE.Color(theme.background), 1);
    this.sky.groundColor.setRGB(...linear(theme.bounce));
    this.sky.intensity = theme.sky;
    this.sun.intensity = theme.sun;
    this.paintGround();
    this.touch();
  }

  paintGround() {
    if (!this.theme) return;
    for (const g of this.grounds) {
      g.floor.material.uniforms.colour.value.set(this.theme.floor);
      g.floor.material.uniforms.line_colour.value.set(this.theme.line);
      g.shade.material.opacity = this.theme.shade;
    }
  }

  resize() {
    const w = Math.max(2, this.host.clientWidth), height = Math.max(2, this.host.clientHeight);
    this.renderer.setSize(w, height, false);
    this.camera.aspect = w / height;
    this.camera.updateProjectionMatrix();
    this.touch();
  }

  /** Directions of the standard views. */
  directionOf(name) {
    const up = this.up, e1 = new THREE.Vector3(1, 0, 0);
    if (Math.abs(up.x) > 0.9) e1.set(0, 1, 0);
    e1.addScaledVector(up, -up.dot(e1)).normalize();
    const e2 = new THREE.Vector3().crossVectors(up, e1); // (y, where z is up)
    const size = this.bounds.getSize(new THREE.Vector3());
    const wide = Math.abs(size.dot(e1)) >= Math.abs(size.dot(e2)) * 0.8;
    const mix = (a, b, c) => new THREE.Vector3().addScaledVector(e1, a).addScaledVector(e2, b).addScaledVector(up, c);
    switch (name) {
      case "front": return mix(0, -1, 0);
      case "back": return mix(0, 1, 0);
      case "right": return mix(1, 0, 0);
      case "left": return mix(-1, 0, 0);
      case "top": return mix(0, -1e-4, 1);
      default: return (wide ? mix(0.5, -1, 0.42) : mix(1, -0.5, 0.42)).normalize();
    }
  }

  /** Look from a standard side, or from where the camera is, at all there is: as near as it may be. Each
   * bound of the picture is linear in the camera's coordinates. */
  look(name) {
    const away = name ? this.directionOf(name).normalize()
      : this.camera.position.clone().sub(this.controls.target).normalize();
    const right = new THREE.Vector3().crossVectors(this.up, away);
    if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
    right.normalize();
    const top = new THREE.Vector3().crossVectors(away, right);
    const ty = Math.tan((FOV / 2) * (Math.PI / 180)) * 0.84, tx = ty * this.camera.aspect;
    let [ax, bx, ay, by, nearest] = [-Infinity, Infinity, -Infinity, Infinity, -Infinity];
    for (const p of this.points) {
      const x = p.dot(right), y = p.dot(top), z = p.dot(away);
      ax = Math.max(ax, x + z * tx);
      bx = Math.min(bx, x - z * tx);
      ay = Math.max(ay, y + z * ty);
      by = Math.min(by, y - z * ty);
      nearest = Math.max(nearest, z);
    }
    const middle = this.bounds.getCenter(new THREE.Vector3()).dot(away);
    const z = Math.max((ax - bx) / (2 * tx), (ay - by) / (2 * ty), nearest + this.size / 1000);
    const place = (depth) => new THREE.Vector3().addScaledVector(right, (ax + bx) / 2)
      .addScaledVector(top, (ay + by) / 2).addScaledVector(away, depth);
    this.controls.target.copy(place(middle));
    this.camera.position.copy(place(z));
    this.controls.update();
    this.touch();
  }

  /** Where camera and target are, as six numbers. */
  pose() { return [...this.camera.position.toArray(), ...this.controls.target.toArray()]; }

  setPose(p) {
    this.camera.position.fromArray(p, 0);
    this.controls.target.fromArray(p, 3);
    this.controls.update();
    this.touch();
  }

  /** Turn about the target by keys [rad]. */
  turn(left, over) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.up, left);
    const side = new THREE.Vector3().crossVectors(this.up, offset).normalize();
    const turned = offset.clone().applyAxisAngle(side, over);
    const lean = turned.angleTo(this.up);
    if (lean > 0.02 && lean < Math.PI - 0.02) offset.copy(turned);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.touch();
  }

  zoom(by) {
    this.camera.position.sub(this.controls.target).multiplyScalar(by).add(this.controls.target);
    this.controls.update();
    this.touch();
  }

  /** Cut away what is beyond a plane across an axis at a share of the bounds; null: nothing. */
  section(axis, share, flip) {
    if (axis === null) {
      this.planes = [];
    } else {
      const at = this.bounds.min.getComponent(axis)
        + share * (this.bounds.max.getComponent(axis) - this.bounds.min.getComponent(axis));
      this.clip.normal.set(0, 0, 0).setComponent(axis, flip ? 1 : -1);
      this.clip.constant = flip ? -at : at;
      this.planes = [this.clip];
    }
    this.scene.traverse((o) => { // grounds, marks and ways stay whole
      if (!o.material || o.userData.whole) return;
      o.material.clippingPlanes = this.planes;
      o.material.needsUpdate = true;
    });
    this.touch();
  }

  /** What is under a point of the screen [px], nearest first. */
  pick(x, y, objects) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    const { planes } = this;
    return ray.intersectObjects(objects, true)
      .filter((hit) => planes.every((p) => p.distanceToPoint(hit.point) >= 0));
  }

  /** Where a place of the scene is on the stage [px]; null: behind the camera. */
  onScreen(place) {
    const p = place.clone().project(this.camera);
    if (p.z > 1) return null;
    return [(p.x + 1) / 2 * this.host.clientWidth, (1 - p.y) / 2 * this.host.clientHeight];
  }

  /** A picture is due. */
  touch() {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.draw();
    });
  }

  draw() {
    for (const f of this.before) f();
    this.lamp.position.set(0.3, 0.5, 1);
    this.renderer.render(this.scene, this.camera);
    for (const f of this.after) f();
  }
}
