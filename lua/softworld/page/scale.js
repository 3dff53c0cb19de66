// SPDX-License-Identifier: GPL-3.0-or-later
// The vertical range of a chart: one blow of some steps must not make all the rest flat.

const SHARE = 0.01; // of the time in view may be beyond the range, above it and below it
const MANY = 3;     // times the range: peaks that reach less far are shown whole
const ROOM = 0.25;  // of the range is added on a side that is cut

/** Values of a curve in a window of time with the time that each stands for, sorted by value. */
function weighted({ values, run: { series: { time } } }, [from, to]) {
  const list = [];
  for (let i = 0; i < time.length; i++) {
    if (time[i] < from || time[i] > to || !Number.isFinite(values[i])) continue;
    const before = time[Math.max(0, i - 1)], after = time[Math.min(time.length - 1, i + 1)];
    list.push({ t: time[i], value: values[i], weight: (after - before) / 2 });
  }
  return list.sort((a, b) => a.value - b.value);
}

/** The value below which the curve is for a share of the time. */
function quantile(list, share) {
  const total = list.reduce((sum, x) => sum + x.weight, 0);
  let sum = 0;
  for (const x of list) {
    sum += x.weight;
    if (sum >= share * total) return x.value;
  }
  return list[list.length - 1].value;
}

/** { range: [low, high], peaks: [{ curve, t, value, up }] }, peaks beyond it, the largest first; null: all of it fits. */
export function robust(curves, window) {
  let low = Infinity, high = -Infinity, least = Infinity, most = -Infinity;
  const ends = [];
  for (const curve of curves) {
    const list = weighted(curve, window);
    if (!list.length) continue;
    const first = list[0], last = list[list.length - 1];
    low = Math.min(low, curve.limit ? first.value : quantile(list, SHARE));
    high = Math.max(high, curve.limit ? last.value : quantile(list, 1 - SHARE));
    least = Math.min(least, first.value);
    most = Math.max(most, last.value);
    ends.push({ curve, t: last.t, value: last.value, up: true }, { curve, t: first.t, value: first.value, up: false });
  }
  const span = high - low;
  if (!(span > 0 && most - least > MANY * span)) return null;
  const range = [least < low - ROOM * span ? low - ROOM * span : least, most > high + ROOM * span ? high + ROOM * span : most];
  const peaks = ends.filter(({ value, up }) => (up ? value > range[1] : value < range[0]));
  return { range, peaks: peaks.sort((a, b) => Math.abs(b.value) - Math.abs(a.value)) };
}
