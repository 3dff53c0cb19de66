// SPDX-License-Identifier: GPL-3.0-or-later
// The panel of a page that check:report wrote: pictures of the steps and of the places of rows, the rows with their limits, what
// to change. Numbers come as texts, as the terminal shows them; the exact ones are tips.
import { h } from "./dom.js";
import { format } from "./model.js";

const CLASSES = { PASS: "good", OPEN: "warn", FAIL: "bad" };
const ORDER = { FAIL: 0, OPEN: 1, PASS: 2 };
const MOST = 12;       // pictures
const NEAR = 0.004;    // of the time's span: moments so near are one picture
const WIDTH = 150, HEIGHT = 92; // of a picture [px]
const ZOOM = 1.7;      // of pictures of places

/** A row's name, which may go on in the next line after a dot or an underscore; the object's turns nothing else round. */
function nameOf({ name, object }, wraps = true) {
  const own = object && name.startsWith(`${object}.`) ? object : "";
  const breakable = (text) => (!wraps ? [text] : text.split(/(?<=[._])/).flatMap((part) => [part, h("wbr")]));
  return h("bdi", {}, own ? h("bdi", {}, ...breakable(own)) : null, ...breakable(name.slice(own.length)));
}

export const badge = (verdict) => h(`span.badge.${CLASSES[verdict] || "warn"}`, {}, verdict);

/** An exact number for a tip; files have those that JSON lacks as texts. */
const exact = (x, unit) => (x === undefined || x === null ? undefined : `${x}${unit && unit !== "-" ? ` ${unit}` : ""}`);

/** A limit as a curve of the chart that its values are in: { name, label, value }. */
export function limitsOf(data) {
  return (data.check?.rows || []).filter((row) => row.curve)
    .map((row) => ({ name: row.curve.name, value: row.curve.limit,
      label: `limit of ${row.name}${row.curve.of ? ` (${row.curve.of})` : ""}` }));
}

export class CheckPanel {
  constructor(host, data, state, view, span) {
    Object.assign(this, { host, data, state, view, span, check: data.check, lines: [] });
    const { check } = this;
    host.append(h("p.hint", {}, check.reason));
    if (check.no_numbers) {
      host.replaceChildren(h("p.failure", { role: "alert" }, h("strong", {}, "No numbers. "), h("bdi", {}, check.reason)),
        h("p.hint", {}, "Values of such a run would be wrong: none are given. The frames show how far it came."));
      return;
    }
    this.strip = h("div.strip", { role: "group", "aria-label": "Pictures of steps and of places" });
    host.append(this.strip, this.table());
    if (check.skipped.length) host.append(h("p.hint", {}, "Left out by the script: ", h("bdi", {}, check.skipped.join(", "))));
    if (check.change) host.append(this.change());
    state.watch(["time"], ({ time }) => this.mark(time));
  }

  /* --- the table --------------------------------------------------------------------------- */

  table() {
    const head = ["Verdict", "What", "Value", "Limit", "Margin", "Where"];
    const order = this.check.rows.map((row, i) => i).sort((a, b) => ORDER[this.check.rows[a].verdict] - ORDER[this.check.rows[b].verdict] || a - b);
    const groups = order.map((i) => this.line(this.check.rows[i], i));
    const cells = head.map((name) => h("th", { scope: "col", className: /Value|Margin/.test(name) ? "number" : "" }, name));
    return h("table.rows", {}, h("thead", {}, h("tr", {}, ...cells)), ...groups);
  }

  line(row, i) {
    const { shown } = row;
    const cells = h("tr", {}, h("td", {}, badge(row.verdict)),
      h("th", { scope: "row" }, nameOf(row), row.what && row.what !== row.name ? h("small", {}, row.what) : null),
      h("td.number", { title: exact(row.value, row.unit) }, shown.value || "–", row.error !== 0 && shown.error ? h("small", {}, `± ${shown.error}`) : null),
      h("td", { title: exact(row.limit, row.unit) }, shown.limit ? `${row.side === "max" ? "≤" : "≥"} ${shown.limit}` : "–",
        row.from ? h("small", {}, row.source && row.source !== row.from ? `${row.from}: ${row.source}` : row.from) : null),
      h("td.number", { title: exact(row.margin, row.unit) }, shown.margin || "–", this.bar(row)),
      h("td", {}, this.link(row, i), shown.s ? h("small", {}, `s = ${shown.s}`) : null, row.step ? h("small", {}, row.step) : null));
    const line = h("tbody", { id: `row-${i + 1}` }, cells,
      row.note ? h("tr.note", {}, h("td"), h("td", { colSpan: 5 }, h("bdi", {}, shown.note))) : null);
    line.classList.toggle("wrong", row.verdict === "FAIL");
    this.lines[i] = { row, line };
    return line;
  }

  /** How much of the limit is used. */
  bar(row) {
    if (typeof row.value !== "number" || typeof row.limit !== "number" || row.limit <= 0) return null;
    const used = row.side === "max" ? row.value / row.limit : row.limit / Math.max(row.value, 1e-300);
    if (!(used >= 0)) return null;
    return h("span.used", { role: "img", "aria-label": `${Math.round(100 * Math.min(used, 99))} % of the limit`,
      title: `${Number((100 * used).toPrecision(3))} % of the limit` },
    h("span", { className: CLASSES[row.verdict], style: { width: `${Math.min(100, 100 * used)}%` } }));
  }

  link(row, i) {
    if (typeof row.time !== "number") return null;
    return h("a.link", { href: `#t=${row.time}&row=${i + 1}`, title: "Show it: this time, this place",
      onclick: (e) => {
        e.preventDefault();
        window.history.replaceState(null, "", e.currentTarget.getAttribute("href"));
        this.go(i + 1);
      } }, `t = ${row.shown.time}`);
  }

  /** Show the row of this number, from 1: its time, its place. */
  go(number, scroll = true) {
    const row = this.check.rows?.[number - 1];
    if (!row) return;
    this.chosen = number - 1;
    if (typeof row.time === "number") this.state.set({ time: this.inside(row.time), playing: false });
    this.state.set(this.place(row));
    this.mark(this.state.get("time"));
    if (scroll) this.lines[number - 1].line.scrollIntoView({ block: "nearest" });
  }

  /** Begin with the worst that has a time. */
  begin() {
    const worst = this.moments?.().filter((m) => m.verdict === "FAIL").sort((a, b) => a.number - b.number)[0];
    if (worst) this.go(worst.number, false);
  }

  inside(t) { return Math.min(this.span[1], Math.max(this.span[0], t)); }

  /** What the state has to be for the place of a row to be seen. */
  place(row) {
    const wires = this.view ? this.view.actors.filter((a) => a.kind === "wire") : [];
    const wire = wires.find((a) => a.name === row.object) || (wires.length === 1 && !row.object ? wires[0] : null);
    if (wire && typeof row.s === "number") return { selected: wire.id, probe: { id: wire.id, s: row.s } };
    const actor = row.object && this.view?.actors.find((a) => a.name === row.object);
    return { selected: actor ? actor.id : null, probe: null };
  }

  /** The chosen row, as long as its time is shown; pictures of this moment. */
  mark(time) {
    this.lines.forEach(({ row, line }, i) => {
      const on = i === this.chosen && (typeof row.time !== "number" || this.inside(row.time) === time);
      line.classList.toggle("chosen", on);
      if (on) line.setAttribute("aria-current", "true"); else line.removeAttribute("aria-current");
    });
    for (const { button, t } of this.pictures || []) button.setAttribute("aria-pressed", String(Math.abs(t - time) < 1e-9));
  }

  /* --- pictures ------------------------------------------------------------------------------ */

  /** Moments worth a picture: where rows are, the worst first, and the ends of steps; in the order of time. */
  moments() {
    const list = [], near = NEAR * (this.span[1] - this.span[0]);
    const rows = this.check.rows.map((row, i) => ({ row, i })).filter(({ row }) => typeof row.time === "number" && row.verdict);
    rows.sort((a, b) => ORDER[a.row.verdict] - ORDER[b.row.verdict] || a.i - b.i);
    for (const { row, i } of rows) {
      const t = this.inside(row.time), known = list.find((m) => Math.abs(m.t - t) <= near);
      if (known) known.rows.push(row);
      else if (list.length < MOST) list.push({ t, rows: [row], verdict: row.verdict, row, number: i + 1, step: row.step });
    }
    for (const step of this.check.steps) {
      const t = this.inside(step.to ?? this.span[1]), known = list.some((m) => Math.abs(m.t - t) <= near);
      if (!known && step.to !== step.from && list.length < MOST) list.push({ t, rows: [], step: step.name });
    }
    return list.sort((a, b) => a.t - b.t);
  }

  /** Draw the strip, with the stage itself: at each moment, the place of its row marked. */
  draw() {
    if (!this.view || !this.strip) return;
    const { state, view } = this, { time, selected, probe } = state.values;
    const shown = this.strip.scrollLeft;
    this.pictures = this.moments().map((m) => {
      state.set({ time: m.t, ...(m.row ? this.place(m.row) : { selected: null, probe: null }) });
      return { ...m, ...this.picture(m) };
    });
    state.set({ time, selected, probe });
    view.stage.draw();
    this.strip.replaceChildren(...this.pictures.map((p) => p.button));
    this.strip.hidden = !this.pictures.length;
    const worst = this.pictures.find((p) => p.verdict === "FAIL");
    this.strip.scrollLeft = shown || (worst && Math.max(0, worst.button.offsetLeft - this.strip.offsetLeft - WIDTH)) || 0;
    this.mark(time);
  }

  picture(m) {
    const { stage } = this.view, from = stage.canvas, k = 2;
    const canvas = h("canvas", { width: WIDTH * k, height: HEIGHT * k, "aria-hidden": "true" });
    stage.draw();
    this.copy(canvas, from, m.row ? this.spot() : null);
    const t = format(m.t, "s");
    const words = m.rows.length ? m.rows.map((row) => row.name).join(", ") : `end of ${m.step}`;
    const shown = m.rows.length ? m.rows.flatMap((row, i) => [i ? ", " : null, nameOf(row, false)]) : ["end of ", h("bdi", {}, m.step)];
    const button = h("button.picture", { type: "button", "aria-pressed": "false", title: `${t}: ${words}`,
      onclick: () => (m.number ? this.go(m.number) : this.state.set({ time: m.t, playing: false, probe: null, selected: null })) },
    canvas, h("span.when", {}, t, m.verdict ? badge(m.verdict) : null), h("span.words", {}, ...shown));
    return { button };
  }

  /** Where the place that is chosen is on the stage, from 0 to 1; null where there is none. */
  spot() {
    const { view } = this, { probe, selected } = this.state.values;
    const mark = probe && view.probeMark.visible ? view.probeMark : view.find(selected)?.group;
    if (!mark || !mark.position.lengthSq) return null;
    const at = mark.position.clone().project(view.stage.camera);
    return Math.abs(at.x) < 1 && Math.abs(at.y) < 1 ? [(1 + at.x) / 2, (1 - at.y) / 2] : null;
  }

  /** The stage's middle, or nearer what is about a spot, with a ring. */
  copy(canvas, from, spot) {
    const c = canvas.getContext("2d"), { width, height } = canvas;
    const scale = Math.max(width / from.width, height / from.height) * (spot ? ZOOM : 1), w = from.width * scale, tall = from.height * scale;
    const clamp = (x, least) => Math.min(0, Math.max(least, x));
    const x = spot ? clamp(width / 2 - spot[0] * w, width - w) : (width - w) / 2;
    const y = spot ? clamp(height / 2 - spot[1] * tall, height - tall) : (height - tall) / 2;
    c.drawImage(from, x, y, w, tall);
    if (!spot) return;
    c.lineWidth = 4;
    c.strokeStyle = "#d1495b";
    c.beginPath();
    c.arc(x + spot[0] * w, y + spot[1] * tall, 22, 0, 2 * Math.PI);
    c.stroke();
  }

  /* --- what to change -------------------------------------------------------------------------- */

  change() {
    const list = h("ul.change");
    for (const line of this.check.change.lines) list.append(h("li", { className: line.level ? "inner" : "" }, h("bdi", {}, line.text)));
    return h("section.what", { "aria-label": "What to change" }, h("h3", {}, "What to change"), h("p", {}, h("bdi", {}, this.check.change.reason)), list);
  }
}
