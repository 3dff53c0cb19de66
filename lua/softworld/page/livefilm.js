// SPDX-License-Identifier: GPL-3.0-or-later
// A film that grows: one frame after the other comes from a run under way. It is read like one of the player.
import { readFilm, inflated } from "./film.js";

const MOST = 40e6; // numbers that are kept; when there are more, every second frame goes

/** Numbers of one kind, of one object; frames in which it was not there have none. */
class LiveTrack {
  constructor(film, kind, object, channel) {
    Object.assign(this, { film, kind, object, channel, width: 1, line: 1, frames: [], low: Infinity, high: -Infinity });
  }
  get counts() { return this.frames.map((x) => (x ? x.length / this.width : 0)); }

  add(f, track) {
    this.fill(f);
    if (!track || !track.count(0)) return 0;
    this.width = track.width;
    this.line = track.line;
    const own = new Float32Array(track.count(0) * track.width);
    track.sample(0, 0, own);
    this.frames[f] = own;
    for (const x of own) {
      if (x < this.low) this.low = x;
      if (x > this.high) this.high = x;
    }
    return own.length;
  }
  fill(f) { while (this.frames.length <= f) this.frames.push(null); }
  count(f) { return this.frames[f] ? this.frames[f].length / this.width : 0; }

  sample(f, part, out) {
    const a = this.frames[f];
    if (!a) return 0;
    let b = part > 0 && this.frames[f + 1];
    if (!b || b.length !== a.length) b = a;
    if (b !== a && this.width === 4 && a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0) b = a;
    for (let i = 0; i < a.length; i++) out[i] = a[i] + (b[i] - a[i]) * part;
    return a.length / this.width;
  }

  range(frame = -1) {
    if (frame < 0) return [this.low, this.high];
    let low = Infinity, high = -Infinity;
    for (const x of this.frames[frame] || []) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
    return [low, high];
  }
}

export class LiveFilm {
  constructor() {
    Object.assign(this, { times: [], tracks: new Map(), numbers: 0, version: 0, every: 1, come: 0 });
  }

  /** A track; one that has come in no frame yet is there too, and empty. Surfaces are of meshes only. */
  get(kind, object, channel = 0) {
    const key = `${kind} ${object} ${channel}`;
    if (!this.tracks.has(key)) {
      if (kind === "surface" || kind === "pressed") return undefined;
      this.tracks.set(key, new LiveTrack(this, kind, object, channel));
    }
    return this.tracks.get(key);
  }

  /** A frame's bytes, deflated. */
  async take(bytes) {
    const one = readFilm(await inflated(bytes));
    const t = one.times[0];
    let last = this.times.length - 1;
    while (last >= 0 && this.times[last] >= t - 1e-12) last -= 1; // it went back
    this.cut(last + 1);
    const f = this.times.push(t) - 1;
    for (const [key, track] of one.tracks) {
      if (!this.tracks.has(key)) this.tracks.set(key, new LiveTrack(this, track.kind, track.object, track.channel));
      this.numbers += this.tracks.get(key).add(f, track);
    }
    for (const track of this.tracks.values()) track.fill(f);
    this.version += 1;
    if (this.numbers > MOST) this.thin();
    return t;
  }

  cut(count) {
    if (count >= this.times.length) return;
    this.times.length = count;
    for (const track of this.tracks.values()) {
      track.frames.length = Math.min(track.frames.length, count);
      if (!count) Object.assign(track, { low: Infinity, high: -Infinity });
    }
    this.count();
  }

  thin() {
    const kept = (list) => list.filter((_, i) => i % 2 === (list.length - 1) % 2);
    this.times = kept(this.times);
    for (const track of this.tracks.values()) track.frames = kept(track.frames);
    this.count();
  }

  count() {
    this.numbers = 0;
    for (const track of this.tracks.values()) for (const x of track.frames) this.numbers += x ? x.length : 0;
  }
}
