// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes that a page has beside its data, and films: csrc/film/film.h tells their form.

const KINDS = ["wire", "value", "surface", "pressed", "particles", "obstacle", "hold", "tool"];

/** What was deflated, as it was. */
export function inflated(bytes) {
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/** The bytes of a text in base64, deflated. */
export function unpacked(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return inflated(bytes);
}

/** The bytes of blob number n of the page. */
export const blob = (n) => unpacked(document.getElementById(`blob-${n}`).textContent);

/** Numbers of one kind, of one object, in all frames. */
class Track {
  constructor(view, at, frames) {
    this.kind = KINDS[view.getUint8(at)];
    this.channel = view.getUint8(at + 1);
    this.width = view.getUint16(at + 2, true);
    this.object = view.getUint32(at + 4, true);
    this.line = view.getUint32(at + 8, true);
    this.scale = view.getFloat64(at + 12, true);
    this.offset = view.getFloat64(at + 20, true);
    this.gaps = this.kind === "value" || this.kind === "pressed"
      || (this.channel === 2 && ["obstacle", "hold", "tool"].includes(this.kind));
    this.counts = new Uint32Array(frames);
    this.starts = new Uint32Array(frames + 1);
  }

  /** Read counts and codes from bytes on; returns where they end. */
  read(bytes, at) {
    const { counts, starts, width } = this;
    const side = width * this.line;
    for (let f = 0; f < counts.length; f++) {
      let x = 0, shift = 0, b;
      do { b = bytes[at++]; x |= (b & 127) << shift; shift += 7; } while (b > 127);
      counts[f] = x;
      starts[f + 1] = starts[f] + x * width;
    }
    const codes = this.codes = new Int32Array(starts[counts.length]);
    for (let f = 0; f < counts.length; f++) {
      const base = starts[f], n = starts[f + 1] - base;
      const before = f > 0 && counts[f - 1] === counts[f] ? starts[f - 1] : -1;
      for (let i = 0; i < n; i++) {
        let z = bytes[at++];
        if (z > 127) {
          let shift = 7, b;
          z &= 127;
          do { b = bytes[at++]; z |= (b & 127) << shift; shift += 7; } while (b > 127);
        }
        let guess = before >= 0 ? codes[before + i] : 0;
        if (i >= side) guess += codes[base + i - side] - (before >= 0 ? codes[before + i - side] : 0);
        codes[base + i] = ((z >>> 1) ^ -(z & 1)) + guess;
      }
    }
    return at;
  }

  count(f) { return this.counts[f]; }

  /** Numbers at frame f, a share `part` on the way to the next one, into out; returns how many items. */
  sample(f, part, out) {
    const { codes, starts, scale, offset, gaps } = this;
    const base = starts[f], n = starts[f + 1] - base;
    if (part > 0 && this.width === 4 && n === 4) part = this.turned(f) ? 0 : part;
    const next = part > 0 && f + 1 < this.counts.length && this.counts[f + 1] === this.counts[f]
      ? starts[f + 1] : base;
    for (let i = 0; i < n; i++) {
      const a = codes[base + i], b = codes[next + i];
      out[i] = gaps && (a === 0 || b === 0) ? NaN : (a + (b - a) * part) * scale + offset;
    }
    return this.counts[f];
  }

  /** A rotation whose numbers change their sign towards the next frame: there is nothing between them. */
  turned(f) {
    const { codes, starts } = this, a = starts[f], b = starts[f + 1];
    if (b + 4 > codes.length) return false;
    let dot = 0;
    for (let k = 0; k < 4; k++) dot += codes[a + k] * codes[b + k];
    return dot < 0;
  }

  /** Least and largest of its numbers, over all frames or one; share: of those left out at the ends. */
  range(frame = -1, share = 0) {
    const from = frame < 0 ? 0 : this.starts[frame];
    const to = frame < 0 ? this.codes.length : this.starts[frame + 1];
    let low = Infinity, high = -Infinity;
    if (share > 0 && to - from > 100) {
      const step = Math.max(1, Math.floor((to - from) / 50000)), some = [];
      for (let i = from; i < to; i += step) if (!this.gaps || this.codes[i]) some.push(this.codes[i]);
      some.sort((a, b) => a - b);
      if (some.length) {
        low = some[Math.floor(share * (some.length - 1))];
        high = some[Math.ceil((1 - share) * (some.length - 1))];
      }
    } else {
      for (let i = from; i < to; i++) {
        const c = this.codes[i];
        if (this.gaps && c === 0) continue;
        if (c < low) low = c;
        if (c > high) high = c;
      }
    }
    return [low * this.scale + this.offset, high * this.scale + this.offset];
  }
}

/** { times, tracks, get(kind, object, channel) } of a film's bytes. */
export function readFilm(buffer) {
  const view = new DataView(buffer), bytes = new Uint8Array(buffer);
  if (String.fromCharCode(...bytes.subarray(0, 7)) !== "SWFILM1") throw new Error("no film");
  const frames = view.getUint32(8, true), count = view.getUint32(12, true);
  const times = new Float64Array(buffer.slice(16, 16 + 8 * frames));
  let at = 16 + 8 * frames;
  const tracks = new Map();
  for (let k = 0; k < count; k++) {
    const track = new Track(view, at, frames);
    at = track.read(bytes, at + 28);
    tracks.set(`${track.kind} ${track.object} ${track.channel}`, track);
  }
  return { times, tracks, get: (kind, object, channel = 0) => tracks.get(`${kind} ${object} ${channel}`) };
}

/** The frame at or before time t, and the share of the way to the next one. */
export function locate(times, t) {
  let low = 0, high = times.length - 1;
  if (high < 0) return { frame: -1, part: 0 };
  if (t >= times[high]) return { frame: high, part: 0 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return { frame: low, part: Math.min(1, Math.max(0, (t - times[low]) / (times[high] - times[low]))) };
}
