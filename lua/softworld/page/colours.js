// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of quantities, runs and curves. What is shaded wants linear light, legends sRGB.

const SEQUENCE = ["#3a5fcd", "#2196c8", "#21b59a", "#86c440", "#e6c229", "#f2871e", "#dc3522"];
const AROUND_ZERO = ["#2360c9", "#6f9bdc", "#c3cfdd", "#e0dcd6", "#e8c0a8", "#dd7d55", "#c9341c"];

/** Of runs laid over one another; the first is the usual one. */
export const RUNS = ["#e08a3c", "#4f8ff0", "#3fb58a", "#c76bd0", "#d9c23a", "#e0605e", "#7f8fa6", "#52b7c9"];
/** Of curves. */
export const CURVES = ["#2f8fd8", "#e07b39", "#2fa36b", "#c2529d", "#c9a227", "#7a6fd0", "#d1495b", "#3aa6b0",
  "#8d8d3a", "#6c7a89"];

const toLinear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

export function rgb(hex) {
  const n = parseInt(hex.slice(1), 16);
  return [(n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255];
}

export const linear = (hex) => rgb(hex).map(toLinear);

const SIZE = 256;
function table(stops) {
  const colours = stops.map(linear), out = new Float32Array(3 * SIZE);
  for (let i = 0; i < SIZE; i++) {
    const x = (i / (SIZE - 1)) * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(x));
    for (let c = 0; c < 3; c++) {
      out[3 * i + c] = colours[k][c] + (colours[k + 1][c] - colours[k][c]) * (x - k);
    }
  }
  return out;
}

const TABLES = { sequence: table(SEQUENCE), zero: table(AROUND_ZERO) };
const GREY = linear("#8a8f98");

/** A scale of colours for values from low to high; those on both sides of 0 have 0 in its middle. */
export function scaleOf(low, high) {
  const signed = low < 0 && high > 0 && -low > 0.05 * high;
  if (signed) {
    high = Math.max(high, -low);
    low = -high;
  }
  const values = signed ? TABLES.zero : TABLES.sequence;
  const span = high > low ? high - low : 1;
  return {
    low, high, signed, css: `linear-gradient(to right, ${(signed ? AROUND_ZERO : SEQUENCE).join(", ")})`,
    stops: signed ? AROUND_ZERO : SEQUENCE,
    put(x, out, at) {
      if (Number.isNaN(x)) {
        out[at] = GREY[0]; out[at + 1] = GREY[1]; out[at + 2] = GREY[2];
        return;
      }
      const i = 3 * Math.min(SIZE - 1, Math.max(0, Math.round(((x - low) / span) * (SIZE - 1))));
      out[at] = values[i]; out[at + 1] = values[i + 1]; out[at + 2] = values[i + 2];
    },
  };
}
