// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows: its runs with their films, series and shapes; and the state that its parts share.
import { blob, readFilm, locate } from "./film.js";

/** Quantities of wires: channel of the film, words, unit; signed ones are coloured around 0. noise: what is less everywhere
 * in a run is none. */
export const QUANTITIES = [
  { key: "curvature", channel: 1, label: "Curvature", unit: "1/m", noise: 1e-6 },
  { key: "tension", channel: 0, label: "Tension", unit: "N", noise: 1e-9 },
  { key: "contact", channel: 2, label: "Contact force", unit: "N", noise: 1e-9 },
  { key: "twist", channel: 3, label: "Twist moment", unit: "N m", noise: 1e-12 },
  { key: "stress", channel: 4, label: "Stress", unit: "Pa", noise: 1e-3 },
  { key: "pressed", channel: 0, kind: "pressed", label: "Surface contact", unit: "N", noise: 1e-9 }, // at the points of a mesh
];
export const CURVATURE = 1, FORCE = 5, ARC = 8;

async function readSeries(given) {
  if (!given) return null;
  const buffer = await blob(given.blob);
  const time = new Float64Array(buffer, 0, given.rows);
  const columns = given.columns.map((c, i) => ({
    ...c, values: new Float32Array(buffer, 8 * given.rows + 4 * given.rows * i, given.rows),
  }));
  return { ...given, time, columns };
}

async function readShape(cache, shape, read = blob) {
  if (shape.blob === undefined) return shape;
  if (!cache.has(shape.blob)) {
    const buffer = await read(shape.blob);
    cache.set(shape.blob, {
      points: new Float32Array(buffer, 0, 3 * shape.vertices),
      corners: new Uint32Array(buffer, 12 * shape.vertices, shape.indices),
    });
  }
  return { ...shape, ...cache.get(shape.blob) };
}

/** What a run has in its scene: shapes of obstacles, edges of particles; read(n): bytes of blob n. */
export async function readThings(run, shapes, read) {
  for (const o of [...run.obstacles, ...run.zones]) o.shape = await readShape(shapes, o.shape, read);
  for (const p of run.particles) {
    if (p.blob !== undefined) p.pairs = new Uint32Array(await read(p.blob));
  }
}

/** The page's data with all that is beside it. */
export async function load() {
  const data = JSON.parse(document.getElementById("data").textContent);
  const shapes = new Map();
  for (const [index, run] of data.runs.entries()) {
    run.index = index;
    if (run.film.blob !== undefined) Object.assign(run.film, readFilm(await blob(run.film.blob)));
    else Object.assign(run.film, { times: new Float64Array(0), tracks: new Map(), get: () => undefined });
    run.series = await readSeries(run.series);
    await readThings(run, shapes, blob);
  }
  return data;
}

/** Shared state: set({...}) tells those who listen which keys changed. */
export class State {
  constructor(values) {
    this.values = values;
    this.listeners = [];
  }
  get(key) { return this.values[key]; }
  set(changes) {
    const changed = new Set();
    for (const [key, value] of Object.entries(changes)) {
      if (this.values[key] === value) continue;
      this.values[key] = value;
      changed.add(key);
    }
    if (changed.size) for (const f of this.listeners) f(this.values, changed);
  }
  /** f(values, set of changed keys), now with all of them and then at each change. Returns what ends it. */
  watch(keys, f) {
    const wanted = new Set(keys);
    const call = (values, changed) => {
      for (const key of changed) if (wanted.has(key)) return f(values, changed);
      return undefined;
    };
    this.listeners.push(call);
    f(this.values, wanted);
    return () => { this.listeners = this.listeners.filter((one) => one !== call); };
  }
}

/** First and last time of all runs. */
export function spanOf(data) {
  let from = Infinity, to = -Infinity;
  for (const run of data.runs) {
    for (const list of [run.film.times, run.series ? run.series.time : []]) {
      if (!list.length) continue;
      from = Math.min(from, list[0]);
      to = Math.max(to, list[list.length - 1]);
    }
  }
  return from < to ? [from, to] : from === to ? [from, from + 1e-9] : [0, 1e-9];
}

/** Times of all frames, each once. */
export function frameTimes(data) {
  const all = [...new Set(data.runs.flatMap((run) => [...run.film.times]))];
  return all.sort((a, b) => a - b);
}

/** Which quantities some run knows and that are not the same everywhere, with their range. */
export function knownQuantities(data, mode, time, hidden) {
  const known = [];
  for (const q of QUANTITIES) {
    let low = Infinity, high = -Infinity;
    for (const run of data.runs) {
      run.wires.forEach((w, i) => {
        const track = run.film.get(q.kind || "value", i, q.channel);
        if (!track || (hidden && hidden.has(`${run.index} wire ${i}`))) return;
        const frame = mode === "frame" ? locate(run.film.times, time).frame : -1;
        const [a, b] = track.range(frame, mode === "most" ? 0.005 : 0);
        low = Math.min(low, a);
        high = Math.max(high, b);
      });
    }
    if (data.live && high - low < q.noise) high = low + q.noise;
    const some = high > low && Math.max(Math.abs(low), Math.abs(high)) > q.noise;
    if (low <= high && (some || mode === "frame" || data.live)) known.push({ ...q, low, high });
    else if (data.live?.draft && !q.kind) known.push({ ...q, low: 0, high: 1 }); // its wires are still to come
  }
  return known;
}

/** A number for people: four digits, a prefix where the unit takes one. */
export function format(x, unit = "") {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  let prefix = "";
  const scalable = /^(N|N m|J|Pa|W|N s|m|s|N\/m)$/.test(unit);
  if (scalable && x !== 0) {
    const power = Math.max(-4, Math.min(unit === "m" || unit === "s" ? 0 : 3,
      Math.floor(Math.log10(Math.abs(x) * 1.00005) / 3)));
    prefix = ["p", "n", "µ", "m", "", "k", "M", "G"][power + 4];
    x /= 10 ** (3 * power);
  }
  const size = Math.abs(x);
  let text;
  if (size === 0) text = "0";
  else if (size < 1e-3 || size >= 1e5) text = x.toExponential(2).replace("e+", "e");
  else text = x.toFixed(Math.max(0, 3 - Math.floor(Math.log10(size))));
  text = text.replace("-", "−");
  return unit === "" || unit === "-" ? text : `${text} ${prefix}${unit}`;
}
