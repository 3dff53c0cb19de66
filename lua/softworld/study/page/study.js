// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a study: cross plots and a table of its evaluations; one of them is chosen by a click.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);

/** An element: h("td", { class: "text" }, "words", more). */
function h(tag, attributes, ...children) {
  const e = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes ?? {})) {
    if (key.startsWith("on")) e.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) e.setAttribute(key, value);
  }
  e.append(...children);
  return e;
}

// --- data -----------------------------------------------------------------------------------------

const columns = [...data.parameters.map((p) => ({ ...p, parameter: true })), ...data.results];
columns.forEach((c, i) => {
  c.at = i;
  c.numeric = c.kind !== "choice";
});
// A row: part, number, values of the columns, 1 meets the constraints, 0 not, null failed, and why; else an
// event of its runs, if there is one.
const rows = data.rows.map((r) => ({ part: r[0], number: r[1], values: r[2], pass: r[3], why: r[4] }));
const state = { x: 0, y: 0, colour: -1, part: 0, only: false, selected: null, sort: null, down: false };

const unit = (c) => (c.unit && c.unit !== "-" ? ` [${c.unit}]` : "");
const format = (v, c) => {
  if (v === null || v === undefined) return "";
  if (c && !c.numeric) return String(c.choices[v - 1]);
  return typeof v === "number" ? String(+v.toPrecision(5)) : String(v);
};
// A label of an axis: with as many digits as tell it from its neighbours.
const label = (v, list) => {
  const step = list.length > 1 ? Math.abs(list[1][1] - list[0][1]) : 0;
  const digits = step > 0 && v !== 0 ? Math.ceil(Math.log10(Math.abs(v) / step)) + 2 : 5;
  return String(+v.toPrecision(Math.min(15, Math.max(5, digits))));
};
const shown = () => rows.filter((r) => (!state.part || r.part === state.part) && (!state.only || r.pass === 1));

// --- axes -----------------------------------------------------------------------------------------

function axis(column, list) {
  let low = Infinity, high = -Infinity;
  for (const r of list) {
    const v = r.values[column.at];
    if (typeof v === "number") { low = Math.min(low, v); high = Math.max(high, v); }
  }
  if (low > high) [low, high] = [0, 1];
  const log = column.log && low > 0;
  let [a, b] = log ? [Math.log10(low), Math.log10(high)] : [low, high];
  const room = (b - a) * 0.04 || Math.abs(a) * 0.04 || 0.5;
  a -= room;
  b += room;
  return { log, a, b, place: (v) => ((log ? Math.log10(v) : v) - a) / (b - a) };
}

function ticks(scale, most) {
  const list = [];
  if (scale.log) {
    for (let k = Math.floor(scale.a); k <= scale.b; k++) {
      for (const m of scale.b - scale.a > 2 ? [1] : [1, 2, 5]) {
        const v = m * 10 ** k, at = scale.place(v);
        if (at >= 0 && at <= 1) list.push([at, v]);
      }
    }
    return list;
  }
  const raw = (scale.b - scale.a) / most, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw);
  for (let k = Math.ceil(scale.a / step); k * step <= scale.b; k++) list.push([scale.place(k * step), k * step]);
  return list;
}

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function colourOf(row, scale) {
  if (scale) {
    const v = row.values[state.colour];
    if (typeof v !== "number") return null;
    return `hsl(${250 - 210 * scale.place(v)} 70% ${document.documentElement.dataset.theme === "dark" ? 62 : 45}%)`;
  }
  return row.pass === 1 ? style("--accent") : style("--broken");
}

// --- plots ----------------------------------------------------------------------------------------

function prepare(canvas) {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.max(1, Math.round(w * ratio));
  canvas.height = Math.max(1, Math.round(height * ratio));
  const c = canvas.getContext("2d");
  c.scale(ratio, ratio);
  c.clearRect(0, 0, w, height);
  return [c, w, height];
}

function drawAxes(c, box, sx, sy, cx, cy) {
  c.strokeStyle = style("--edge");
  c.fillStyle = style("--dim");
  c.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  c.textAlign = "center";
  const across = ticks(sx, 8), up = ticks(sy, 6);
  for (const [at, v] of across) {
    const x = box.x + at * box.w;
    c.beginPath(); c.moveTo(x, box.y); c.lineTo(x, box.y + box.h); c.stroke();
    c.fillText(cx.numeric ? label(v, across) : Number.isInteger(v) ? format(v, cx) : "", x, box.y + box.h + 14);
  }
  c.textAlign = "right";
  for (const [at, v] of up) {
    const y = box.y + (1 - at) * box.h;
    c.beginPath(); c.moveTo(box.x, y); c.lineTo(box.x + box.w, y); c.stroke();
    c.fillText(cy.numeric ? label(v, up) : Number.isInteger(v) ? format(v, cy) : "", box.x - 6, y + 4);
  }
  c.fillStyle = style("--ink");
  c.textAlign = "center";
  c.fillText(cx.name + unit(cx), box.x + box.w / 2, box.y + box.h + 30);
  c.textAlign = "left";
  c.fillText(cy.name + unit(cy), box.x, box.y - 8);
}

function drawLimits(c, box, sx, sy, cx, cy) {
  c.strokeStyle = style("--bad");
  c.setLineDash([5, 4]);
  for (const key of ["min", "max"]) {
    const x = box.x + sx.place(cx[key]) * box.w, y = box.y + (1 - sy.place(cy[key])) * box.h;
    c.beginPath();
    if (x >= box.x && x <= box.x + box.w) { c.moveTo(x, box.y); c.lineTo(x, box.y + box.h); }
    if (y >= box.y && y <= box.y + box.h) { c.moveTo(box.x, y); c.lineTo(box.x + box.w, y); }
    c.stroke();
  }
  c.setLineDash([]);
}

let placed = []; // of the large plot: [row, x, y]

function drawPlot() {
  const [c, w, height] = prepare($("plot"));
  const cx = columns[state.x], cy = columns[state.y], list = shown();
  const drawn = list.filter((r) => typeof r.values[cx.at] === "number" && typeof r.values[cy.at] === "number");
  const sx = axis(cx, list), sy = axis(cy, drawn);
  const up = ticks(sy, 6), left = Math.max(70, ...(cy.numeric ? up.map(([, v]) => 12 + 6.6 * label(v, up).length) : []));
  const box = { x: left, y: 26, w: Math.max(10, w - left - 20), h: Math.max(10, height - 66) };
  const scale = state.colour >= 0 ? axis(columns[state.colour], drawn) : null;
  drawAxes(c, box, sx, sy, cx, cy);
  drawLimits(c, box, sx, sy, cx, cy);
  placed = drawn.map((r) => [r, box.x + sx.place(r.values[cx.at]) * box.w,
    box.y + (1 - sy.place(r.values[cy.at])) * box.h]);
  const size = drawn.length > 5000 ? 1.5 : drawn.length > 800 ? 2.2 : 3.4;
  for (const [r, x, y] of placed) {
    const colour = colourOf(r, scale);
    if (!colour) continue;
    c.globalAlpha = scale && r.pass !== 1 ? 0.45 : 0.85;
    c.fillStyle = colour;
    c.beginPath(); c.arc(x, y, size, 0, 7); c.fill();
  }
  c.globalAlpha = 1;
  // Failed ones have no results: marks at the bottom, where their parameter was.
  c.fillStyle = style("--bad");
  if (cx.parameter) {
    for (const r of list) {
      if (r.pass !== null) continue;
      const x = box.x + sx.place(r.values[cx.at]) * box.w;
      c.fillRect(x - 1, box.y + box.h - 6, 2, 6);
      placed.push([r, x, box.y + box.h - 3]);
    }
  }
  const chosen = placed.find(([r]) => r === state.selected);
  if (chosen) {
    c.strokeStyle = style("--ink");
    c.lineWidth = 2;
    c.beginPath(); c.arc(chosen[1], chosen[2], 7, 0, 7); c.stroke();
  }
}

function drawSmall() {
  const list = shown(), cy = columns[state.y];
  $("small").replaceChildren();
  for (const p of columns.filter((k) => k.parameter).slice(0, 24)) {
    const canvas = h("canvas");
    $("small").append(h("button", { type: "button", "aria-pressed": String(p.at === state.x), "data-name": p.name,
      title: `${cy.name} over ${p.name}`, onclick: () => choose("x", p.at) }, canvas, h("span", {}, p.name + unit(p))));
    const [c, w, height] = prepare(canvas), sx = axis(p, list), sy = axis(cy, list);
    for (const r of list) {
      if (typeof r.values[cy.at] !== "number") continue;
      c.fillStyle = r.pass === 1 ? style("--accent") : style("--broken");
      c.fillRect(sx.place(r.values[p.at]) * w - 1, (1 - sy.place(r.values[cy.at])) * height - 1, 2, 2);
    }
  }
}

function drawLegend() {
  const entry = (colour, text) => h("span", {}, h("i", { style: `background: ${colour}` }), text);
  const list = [];
  if (state.colour >= 0) list.push(h("span", {}, `colour: ${columns[state.colour].name}, blue low, orange high`));
  else if (data.constraints) list.push(entry(style("--accent"), "meets the constraints"), entry(style("--broken"), "breaks them"));
  if (rows.some((r) => r.pass === null)) list.push(entry(style("--bad"), "failed"));
  $("legend").replaceChildren(...list);
}

// --- one evaluation -------------------------------------------------------------------------------

function valuesOf(list, row) {
  const dl = h("dl");
  for (const c of list) {
    const v = row.values[c.at];
    const over = typeof v === "number" && ((c.max !== undefined && v > c.max) || (c.min !== undefined && v < c.min));
    const limits = [c.min !== undefined ? `at least ${c.min}` : "", c.max !== undefined ? `at most ${c.max}` : ""];
    dl.append(h("dt", { title: limits.filter(Boolean).join(", ") }, c.name + unit(c)),
      h("dd", over ? { class: "over" } : {}, format(v, c) + (over ? ` (${limits.filter(Boolean).join(", ")})` : "")));
  }
  return dl;
}

function drawDetail() {
  const r = state.selected;
  if (!r) {
    $("detail").replaceChildren(h("p", { class: "hint" }, "Click a point or a row: its parameters, its results, and how to see it run."));
    return;
  }
  const line = `local _, run = study:again(${r.number}, ${r.part})\nrun:report "again.html"`;
  const parts = [h("h2", {}, `Evaluation ${r.part}.${r.number}`)];
  if (r.pass === null) parts.push(h("p", { class: "wrong" }, `failed: ${r.why}`));
  else if (data.constraints) parts.push(h("p", { class: r.pass ? "" : "wrong" }, r.pass ? "meets the constraints" : "breaks constraints"));
  if (r.pass !== null && r.why) parts.push(h("p", { class: "wrong" }, `its run had an event: ${r.why}`));
  parts.push(h("h3", {}, "Parameters"), valuesOf(columns.filter((c) => c.parameter), r));
  if (r.pass !== null) parts.push(h("h3", {}, "Results"), valuesOf(columns.filter((c) => !c.parameter), r));
  const player = data.players[`${r.part}.${r.number}`];
  parts.push(h("h3", {}, "See it run"));
  if (player) parts.push(h("p", {}, h("a", { id: "play", class: "play", href: encodeURIComponent(player) }, "Play it")));
  else parts.push(h("p", { class: "hint" }, "Put this at the end of the script and run it: with its journal nothing else "
    + "is computed, and this one comes with the same bits."), h("pre", { id: "line" }, line));
  $("detail").replaceChildren(...parts);
}

// --- table ----------------------------------------------------------------------------------------

const MOST = 500;

function sorted() {
  const list = shown(), key = state.sort;
  if (key === null) return list;
  const value = (r) => (key === "number" ? r.part * 1e9 + r.number : r.values[key]);
  const sign = state.down ? -1 : 1;
  return list.sort((a, b) => {
    const [p, q] = [value(a), value(b)];
    if (typeof p !== "number" || typeof q !== "number") return (typeof p === "number" ? 0 : 1) - (typeof q === "number" ? 0 : 1);
    return sign * (p - q);
  });
}

function drawTable() {
  const list = sorted(), head = h("tr");
  const title = (key, words) => head.append(h("th", { "aria-sort": state.sort === key ? (state.down ? "descending" : "ascending") : "none" },
    h("button", { type: "button", onclick: () => {
      state.down = state.sort === key && !state.down;
      state.sort = key;
      drawTable();
    } }, words + (state.sort === key ? (state.down ? " ↓" : " ↑") : ""))));
  title("number", "number");
  for (const c of columns) title(c.at, c.name + unit(c));
  head.append(h("th", {}, h("button", { type: "button" }, "")));
  const body = h("tbody");
  let cut = list.slice(0, MOST);
  if (state.selected && list.includes(state.selected) && !cut.includes(state.selected)) cut = [state.selected, ...cut];
  for (const r of cut) {
    body.append(h("tr", { class: r === state.selected ? "selected" : undefined, "data-at": `${r.part}.${r.number}`,
      onclick: () => select(r) }, h("td", {}, `${r.part}.${r.number}`), ...columns.map((c) => h("td", {}, format(r.values[c.at], c))),
    h("td", { class: "text wrong" }, r.pass === null ? r.why : r.pass ? "" : "breaks constraints")));
  }
  $("table").replaceChildren(h("thead", {}, head), body);
  $("more").textContent = list.length > MOST ? `${MOST} of ${list.length} are shown; sort by another column to see others.` : "";
}

// --- what the user does ------------------------------------------------------------------------------

function draw() {
  drawSmall();
  drawLegend();
  drawDetail();
  drawTable();
  drawPlot(); // last: the others tell how much room it has
}

function select(row) {
  state.selected = row;
  drawPlot();
  drawDetail();
  drawTable();
}

function choose(name, value) {
  state[name] = value;
  const box = $(name);
  if (box.type === "checkbox") box.checked = value;
  else box.value = value;
  if (state.selected && !shown().includes(state.selected)) state.selected = null;
  draw();
}

function fill(id, entries) {
  $(id).replaceChildren(...entries.map(([value, words]) => h("option", { value }, words)));
  $(id).addEventListener("change", () => choose(id, Number($(id).value)));
}

$("plot").addEventListener("click", (event) => {
  let best = null, least = 14 ** 2;
  for (const [row, x, y] of placed) {
    const d = (x - event.offsetX) ** 2 + (y - event.offsetY) ** 2;
    if (d < least) { best = row; least = d; }
  }
  if (best) select(best);
});
$("plot").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const list = sorted(), at = list.indexOf(state.selected);
  if (list.length) select(list[(at + step + list.length + (at < 0 && step < 0 ? 1 : 0)) % list.length]);
});
$("only").addEventListener("change", () => choose("only", $("only").checked));
$("theme").addEventListener("click", () => {
  document.documentElement.dataset.theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  draw();
});
window.addEventListener("resize", draw);

$("title").textContent = data.title;
$("count").textContent = `${data.count} evaluation${data.count === 1 ? "" : "s"}`;
$("passed").textContent = data.constraints ? `${data.passed} meet${data.passed === 1 ? "s" : ""} the constraints` : "";
$("passed").hidden = !data.constraints;
$("failed").textContent = `${data.failed} failed`;
$("failed").hidden = data.failed === 0;
if (data.note) { $("note").textContent = data.note; $("note").hidden = false; }
const names = columns.map((c) => [c.at, c.name + unit(c)]);
fill("x", names);
fill("y", names);
fill("colour", [[-1, data.constraints ? "constraints" : "one"], ...columns.filter((c) => c.numeric).map((c) => [c.at, c.name + unit(c)])]);
fill("part", [[0, "all"], ...data.parts]);
state.y = columns.length > data.parameters.length ? data.parameters.length : 0;
$("x").value = state.x;
$("y").value = state.y;
if (matchMedia("(prefers-color-scheme: dark)").matches) document.documentElement.dataset.theme = "dark";
draw();
document.body.classList.add("ready");
