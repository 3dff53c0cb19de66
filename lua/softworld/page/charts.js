// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of the runs' series: one for each unit, with one cursor that is the player's time.
import Dygraph from "dygraphs";
import { h } from "./dom.js";
import { format } from "./model.js";
import { CURVES } from "./colours.js";
import { limitsOf } from "./check.js";
import { robust } from "./scale.js";

const MANY = 8;       // curves of a unit beyond which components of vectors wait to be asked for
const ROUNDING = 1e-11; // moments up to this times the forces at 1 m are rounding
const LARGEST = 1e6;  // [m]; radii above it are rounding
const STRAIGHT = 100; // times the smallest bend radius: what is drawn of radii

/** Columns of all runs by unit; radii have a chart of their own. */
function groupsOf(data) {
  const groups = new Map();
  data.runs.forEach((run, r) => {
    if (!run.series) return;
    for (const column of run.series.columns) {
      const radius = /bend_radius$/.test(column.name);
      const key = radius ? "radius" : column.unit;
      if (!groups.has(key)) groups.set(key, { unit: column.unit, radius, curves: [] });
      if (!column.values.some((x) => (radius ? x < LARGEST : !Number.isNaN(x)))) continue;
      groups.get(key).curves.push({ ...column, run, r,
        label: data.runs.length > 1 ? `${r + 1}: ${column.name}` : column.name });
    }
  });
  const list = [...groups.values()].filter((g) => g.curves.length);
  const forces = (groups.get("N")?.curves ?? []).reduce((most, c) => c.values.reduce((m, x) => Math.max(m, Math.abs(x) || 0), most), 0);
  if (groups.has("N m")) groups.get("N m").rounding = ROUNDING * forces;
  for (const limit of limitsOf(data)) addLimit(list, limit);
  return list;
}

const FAR = 20; // times what a curve reaches: a limit beyond it is drawn when it is asked for, since the curve would be flat

/** A limit is a level curve of the chart in which what it limits is. */
function addLimit(groups, { name, value, label }) {
  const group = groups.find((g) => g.curves.some((c) => c.name === name));
  if (!group || !Number.isFinite(value)) return;
  const curve = group.curves.find((c) => c.name === name);
  const reached = Math.max(...curve.values.filter((x) => Number.isFinite(x)).map(Math.abs));
  group.curves.push({ ...curve, name: label, label, values: new Float64Array(curve.values.length).fill(value), limit: true,
    far: !group.radius && Math.abs(value) > FAR * reached });
}

/** Rows of all curves on the union of their times. */
function rowsOf(group) {
  const runs = [...new Set(group.curves.map((c) => c.run))];
  let top = Infinity;
  if (group.radius) {
    const least = Math.min(...group.curves.filter((c) => !c.limit).flatMap((c) => [Math.min(...c.values.filter((x) => !Number.isNaN(x)))]));
    top = Math.min(STRAIGHT * least, LARGEST);
  }
  const shown = (x) => (Number.isNaN(x) || !(x <= top) ? NaN : x);
  if (runs.length === 1) {
    const { time } = runs[0].series;
    return Array.from(time, (t, i) => [t, ...group.curves.map((c) => shown(c.values[i]))]);
  }
  const times = [...new Set(runs.flatMap((run) => [...run.series.time]))].sort((a, b) => a - b);
  const index = new Map(times.map((t, i) => [t, i]));
  const rows = times.map((t) => [t, ...group.curves.map(() => null)]);
  group.curves.forEach((c, k) => {
    c.run.series.time.forEach((t, i) => { rows[index.get(t)][k + 1] = shown(c.values[i]); });
  });
  return rows;
}

const title = (group) => (group.radius ? "Bend radius" : {
  N: "Forces", "N m": "Moments", J: "Energy", m: "Lengths", W: "Power", "-": "Ratios", Pa: "Stress",
}[group.unit] || "Series");

class Chart {
  constructor(group, state, all) {
    Object.assign(this, { group, state, all });
    const many = group.curves.length > MANY;
    group.curves.forEach((c, k) => {
      c.colour = CURVES[(data_index(group, c)) % CURVES.length];
      if (c.limit) c.colour = "#d1495b";
      c.on = !c.far && !(many && /_[xyz]$/.test(c.name)) && !(many && k > 24);
    });
    this.plot = h("div.plot");
    this.cursor = h("div.cursor", { "aria-hidden": "true" });
    this.chips = h("div.chips");
    this.marks = h("div.peaks");
    this.whole = false; // the scale holds the highest peaks
    this.scale = h("button.link.scale", { type: "button", "aria-pressed": "false", hidden: true,
      onclick: () => { this.whole = !this.whole; this.fit(); } });
    this.element = h("section.chart", { "aria-label": `Chart of ${title(group).toLowerCase()}` },
      h("h3", {}, title(group), h("span.unit", {}, group.unit && group.unit !== "-" ? ` ${group.unit}` : ""), this.scale),
      h("div.plot-box", {}, this.plot, this.marks, this.cursor), this.chips);
    for (const c of group.curves) this.addChip(c);
  }

  addChip(curve) {
    curve.reading = h("span.reading");
    curve.chip = h("button.chip", { type: "button", "aria-pressed": String(curve.on), title: `Show or hide ${curve.label}`,
      onclick: () => {
        curve.on = !curve.on;
        curve.chip.setAttribute("aria-pressed", String(curve.on));
        this.graph?.setVisibility(this.group.curves.indexOf(curve), curve.on);
        this.fit();
        this.read(this.state.get("time"));
      } },
    h("span.swatch", { style: { background: curve.colour } }), h("span.name", {}, curve.label), curve.reading);
    this.chips.append(curve.chip);
  }

  /** Once it is on the page. */
  draw() {
    const { group } = this;
    this.graph = new Dygraph(this.plot, rowsOf(group), {
      labels: ["t", ...group.curves.map((c, i) => `${c.label}${" ".repeat(i)}`)], // names may be the same
      colors: group.curves.map((c) => c.colour),
      visibility: group.curves.map((c) => c.on),
      legend: "never", strokeWidth: 1.4, highlightCircleSize: 2.5, rangeSelectorHeight: 0,
      connectSeparatedPoints: this.all.runs > 1, logscale: group.radius, digitsAfterDecimal: 4,
      axisLabelWidth: 52, gridLineColor: "#80808038", axisLineColor: "#80808066", xRangePad: 2, yRangePad: 6, labelsKMB: false, gridLineWidth: 1,
      series: Object.fromEntries(group.curves.map((c, i) => [`${c.label}${" ".repeat(i)}`,
        c.limit ? { strokePattern: [6, 4], strokeWidth: 1.8 } : c.r ? { strokePattern: [[7, 3], [2, 2], [9, 3, 2, 3]][(c.r - 1) % 3] } : {}])),
      axes: { x: { axisLabelFormatter: (t) => `${Number(t.toPrecision(6))}`, pixelsPerLabel: 56 },
        y: { axisLabelFormatter: (y, _, __, graph) => short(y, graph.yAxisRange()), pixelsPerLabel: 19 } },
      clickCallback: (e, t) => this.state.set({ time: t, playing: false }),
      drawCallback: (g, first) => {
        this.place(this.state.get("time"));
        if (first) return;
        this.all.zoomed(this, g.xAxisRange());
        this.fit();
      },
    });
    this.fit();
    this.read(this.state.get("time"));
  }

  /** Scales the values in view so that a blow does not make the rest flat; marks the peaks beyond. */
  fit() {
    if (!this.graph || this.fitting || this.group.radius) return;
    const window = this.graph.xAxisRange();
    const found = robust(this.group.curves.filter((c) => c.on), window);
    const { rounding = 0 } = this.group, rounded = rounding > 0 && this.group.curves.every((c) => !c.on || c.values.every((x) => !(Math.abs(x) > rounding)));
    const range = rounded ? [-rounding, rounding] : found && !this.whole ? found.range : null;
    if (String(range) !== String(this.range ?? null)) {
      this.range = range;
      this.fitting = true; // it draws
      this.graph.updateOptions({ axes: { y: { valueRange: range } } });
      this.fitting = false;
    }
    this.scale.hidden = !found || rounded;
    this.scale.setAttribute("aria-pressed", String(this.whole));
    this.scale.textContent = this.whole ? "Cut the peaks" : "Show whole peaks";
    this.mark(range && !rounded ? found.peaks : []);
  }

  /** A triangle at the edge for each curve that goes beyond it; the largest has its value beside it. */
  mark(peaks) {
    const area = this.graph.getArea();
    this.marks.replaceChildren(...peaks.map(({ curve, t, value, up }) => {
      const x = this.graph.toDomXCoord(t), first = peaks.find((p) => p.up === up).curve === curve;
      const words = `${curve.label}: ${format(value, curve.unit)} at ${format(t, "s")}`;
      const mark = h(`button.peak.${up ? "up" : "down"}`, { type: "button", title: words, "aria-label": words,
        onclick: () => this.state.set({ time: t, playing: false }) },
      first && h(x > area.x + area.w / 2 ? "span.left" : "span", {}, format(value, curve.unit)));
      Object.assign(mark.style, { color: curve.colour, left: `${x}px`, top: `${up ? area.y : area.y + area.h}px` });
      return mark;
    }).reverse()); // the largest is on top
  }

  place(t) {
    if (!this.graph) return;
    const x = this.graph.toDomXCoord(t), area = this.graph.getArea();
    const inside = x >= area.x - 0.5 && x <= area.x + area.w + 0.5;
    this.cursor.hidden = !inside;
    this.cursor.style.transform = `translateX(${x}px)`;
    Object.assign(this.cursor.style, { top: `${area.y}px`, height: `${area.h}px` });
  }

  /** Numbers of the curves at the cursor. */
  read(t) {
    for (const c of this.group.curves) {
      if (!c.on) {
        c.reading.textContent = "";
        continue;
      }
      const { time } = c.run.series;
      let low = 0, high = time.length - 1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (time[middle] <= t) low = middle; else high = middle;
      }
      const i = t - time[low] <= time[high] - t ? low : high;
      c.reading.textContent = format(c.values[i], c.unit);
    }
  }

  resize() {
    this.graph?.resize();
    this.fit(); // its marks are in pixels
    this.place(this.state.get("time"));
  }
}

function data_index(group, curve) {
  const names = [...new Set(group.curves.map((c) => c.name))];
  return names.indexOf(curve.name); // the same colour in all runs
}

/** A label on an axis with this range [low, high]: with as many digits as tell it from its neighbours. */
function short(y, range) {
  if (y === 0) return "0";
  const a = Math.abs(y), wide = range ? range[1] - range[0] : 0;
  const digits = wide > 0 ? Math.min(12, Math.max(1, Math.ceil(Math.log10(a / wide)) + 2)) : 1;
  return a >= 1e4 || a < 1e-3 ? y.toExponential(digits - 1).replace("e+", "e").replace(/\.?0+e/, "e")
    : `${Number(y.toPrecision(Math.max(3, digits)))}`;
}

export class Charts {
  constructor(host, data, state) {
    this.host = host;
    this.state = state;
    this.runs = data.runs.filter((r) => r.series).length;
    this.list = groupsOf(data).map((g) => new Chart(g, state, this));
    const few = data.runs.find((r) => r.series?.thinned);
    if (this.list.length) {
      host.append(h("p.hint", {}, "Click sets the time, drag zooms, double click shows all.",
        few ? ` Of ${few.series.of} rows, those with the least and the largest values are shown.` : ""));
    }
    host.append(...this.list.map((c) => c.element));
    if (!this.list.length) host.append(h("p.empty", {}, "This run has no series."));
    state.watch(["time"], ({ time }) => {
      for (const c of this.list) {
        c.place(time);
        if (c.graph) c.read(time);
      }
    });
  }

  /** Called when the charts can be seen. */
  shown() {
    for (const c of this.list) if (c.graph) c.resize(); else c.draw();
  }

  /** One has been zoomed: the others follow. */
  zoomed(chart, window) {
    if (this.following) return;
    this.following = true;
    for (const c of this.list) {
      if (c === chart || !c.graph) continue;
      const now = c.graph.xAxisRange();
      if (Math.abs(now[0] - window[0]) + Math.abs(now[1] - window[1]) > 1e-9) c.graph.updateOptions({ dateWindow: window });
    }
    this.following = false;
  }
}
