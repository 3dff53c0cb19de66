// SPDX-License-Identifier: GPL-3.0-or-later
// What stands around the stage: objects, colours and legend, probe, results, events, script.
import { h, iconButton } from "./dom.js";
import { format, knownQuantities } from "./model.js";
import { RUNS } from "./colours.js";

const GROUPS = [["wire", "Wires"], ["particles", "Particles"], ["gripper", "Grippers"], ["hold", "Holds"],
  ["pad", "Grippers' parts"], ["clip", "Clips"], ["obstacle", "Obstacles"], ["zone", "Zones"]];

const groupOf = (actor) => (actor.kind !== "obstacle" ? actor.kind : actor.fixed ? "clip" : actor.given.part ? "pad"
  : actor.kind);

/** The tree of objects: to hide and to pick; what is not there now is paler. Returns what ends it. */
export function objectTree(host, view, data, state) {
  const rows = new Map();
  const toggle = (ids, on) => {
    const hidden = new Set(state.get("hidden"));
    for (const id of ids) if (on) hidden.delete(id); else hidden.add(id);
    state.set({ hidden });
  };
  for (const run of data.runs) {
    const list = h("div.tree", { role: "group", "aria-label": `Objects of ${run.name}` });
    if (data.runs.length > 1) {
      list.append(h("h3.run-name", {}, h("span.swatch", { style: { background: RUNS[run.index % RUNS.length] } }),
        `${run.index + 1}  ${run.name}`));
    }
    for (const [kind, words] of GROUPS) {
      const own = view.actors.filter((a) => a.run === run && groupOf(a) === kind);
      if (!own.length) continue;
      const all = h("input", { type: "checkbox", checked: true, "aria-label": `Show all: ${words}`,
        onchange: () => toggle(own.map((a) => a.id), all.checked) });
      list.append(h("div.tree-head", {}, h("span", {}, words), all));
      for (const actor of own) {
        const box = h("input", { type: "checkbox", checked: true, "aria-label": `Show ${actor.name}`,
          onchange: () => toggle([actor.id], box.checked) });
        const name = h("button.tree-name", { type: "button", title: `${actor.name} (${actor.detail || kind})`,
          onclick: () => state.set({ selected: actor.id,
            probe: actor.kind === "wire" ? { id: actor.id, s: (actor.wire.length || 0) / 2 } : null }) },
        h("span", {}, actor.name), h("small", {}, actor.detail || ""));
        const row = h("div.tree-row", {}, name, box);
        rows.set(actor.id, { row, box, all, own, actor, name });
        list.append(row);
      }
    }
    host.append(list);
  }
  const away = () => {
    for (const { row, actor, name } of rows.values()) {
      if (row.classList.toggle("away", !actor.there) === (name.ariaDescription === "not there now")) continue;
      name.ariaDescription = actor.there ? "" : "not there now";
    }
  };
  const later = state.watch(["time", "tick", "hidden"], () => queueMicrotask(away)); // after the view
  const chosen = state.watch(["hidden", "selected"], ({ hidden, selected }) => {
    for (const [id, { row, box, all, own }] of rows) {
      box.checked = !hidden.has(id);
      row.classList.toggle("selected", id === selected);
      all.checked = own.some((a) => !hidden.has(a.id));
      all.indeterminate = all.checked && own.some((a) => hidden.has(a.id));
    }
  });
  return () => { later(); chosen(); };
}

/** How it is drawn: quantity, range, thickness, arrows, ways, glass. */
export function lookPanel(host, data, state) {
  const known = knownQuantities(data, "all", 0, null);
  const select = h("select", { id: "quantity", onchange: () => state.set({ quantity: select.value || null, custom: null }) },
    h("option", { value: "" }, "Plain"), ...known.map((q) => h("option", { value: q.key }, q.label)));
  const range = h("select", { id: "range", onchange: () => state.set({ range: range.value, custom: null }) },
    h("option", { value: "all" }, "Whole run"), h("option", { value: "most" }, "Without rare peaks"),
    h("option", { value: "frame" }, "This moment"));
  const thick = h("input", { type: "range", id: "thick", min: 1, max: 10, step: 0.5, value: 1,
    oninput: () => state.set({ thick: Number(thick.value) }) });
  const times = h("span.value", {});
  const check = (key, words) => {
    const box = h("input", { type: "checkbox", id: `look-${key}`, onchange: () => state.set({ [key]: box.checked }) });
    state.watch([key], (v) => { box.checked = v[key]; });
    return h("label.check", { for: `look-${key}` }, box, words);
  };
  const forces = data.runs.some((run) => run.ok);
  host.append(h("div.look", {},
    known.length ? h("label.field", {}, h("span", {}, "Colour"), select) : null,
    known.length ? h("label.field", {}, h("span", {}, "Range"), range) : null,
    h("label.field", {}, h("span", {}, "Thickness"), thick, times),
    forces ? check("arrows", "Forces") : null, check("ways", "Trajectories"), check("glass", "See through obstacles"),
    check("shadows", "Shadows")));
  state.watch(["quantity", "range", "thick"], (v) => {
    select.value = v.quantity || "";
    range.value = v.range;
    range.disabled = !v.quantity;
    thick.value = v.thick;
    times.textContent = `${v.thick} ×`;
  });
}

/** The colours' legend; its ends can be typed over. */
export class Legend {
  constructor(host, state) {
    this.bar = h("div.bar");
    this.name = h("span.legend-name");
    const end = (which) => h("input.end", { type: "text", inputMode: "decimal", spellcheck: false,
      "aria-label": which ? "Largest value of the colours" : "Least value of the colours",
      onchange: () => this.typed(which) });
    this.ends = [end(0), end(1)];
    this.element = h("div.legend", {}, this.name, this.bar, h("div.ends", {}, ...this.ends));
    this.state = state;
    host.append(this.element);
  }
  typed(which) {
    const x = Number(this.ends[which].value.replace("−", "-").replace(",", "."));
    const now = this.state.get("custom") || [this.scale.low, this.scale.high];
    const custom = which ? [now[0], x] : [x, now[1]];
    if (Number.isFinite(x) && custom[0] < custom[1]) this.state.set({ custom });
    else this.show(this.look);
  }
  show(look) {
    this.look = look;
    const { quantity, scale } = look;
    this.element.hidden = !quantity;
    if (!quantity) return;
    this.scale = scale;
    this.name.textContent = `${quantity.label} [${quantity.unit}]`;
    this.bar.style.background = scale.css;
    [scale.low, scale.high].forEach((x, i) => {
      const digits = !Number.isFinite(x) ? "–" : Math.abs(x) >= 1e5 || (x !== 0 && Math.abs(x) < 1e-3) ? x.toExponential(2).replace("e+", "e")
        : `${Number(x.toPrecision(4))}`;
      if (document.activeElement !== this.ends[i]) this.ends[i].value = digits.replace("-", "−");
    });
  }
}

/** Which way x, y and z go, and how wide the grid is. */
export function compass(host, stage) {
  const NS = "http://www.w3.org/2000/svg", svg = document.createElementNS(NS, "svg");
  svg.setAttribute("viewBox", "-32 -32 64 64");
  svg.setAttribute("class", "compass");
  svg.setAttribute("aria-hidden", "true");
  const axes = ["x", "y", "z"].map((name, i) => {
    const line = document.createElementNS(NS, "line"), text = document.createElementNS(NS, "text");
    text.textContent = name;
    svg.append(line, text);
    for (const part of [line, text]) part.setAttribute("class", `axis-${name}`);
    return { line, text, i };
  });
  const grid = h("span.grid-step");
  host.append(h("div.compass-box", {}, svg, grid));
  stage.after.push(() => {
    const m = stage.camera.matrixWorldInverse.elements;
    for (const { line, text, i } of axes) {
      const x = m[4 * i], y = -m[4 * i + 1];
      line.setAttribute("x2", 20 * x);
      line.setAttribute("y2", 20 * y);
      text.setAttribute("x", 27 * x);
      text.setAttribute("y", 27 * y);
    }
    const step = stage.grounds[0]?.step;
    grid.textContent = step ? `grid ${format(step, "m").replace(/\.?0+ /, " ")}` : "";
  });
}

/** Numbers at a picked place of a wire, or of what else is picked. */
export class ProbeCard {
  constructor(host, view, state) {
    Object.assign(this, { view, state, known: knownQuantities(view.data, "all", 0, null) });
    this.title = h("strong");
    this.slider = h("input", { type: "range", min: 0, step: "any", "aria-label": "Place along the wire",
      oninput: () => this.move(Number(this.slider.value)) });
    this.field = h("input.number", { type: "number", min: 0, step: "any", "aria-label": "Arc length s in metres",
      onchange: () => this.move(Number(this.field.value)) });
    this.values = h("dl");
    this.along = h("div.along", {}, h("label", {}, "s", this.field, "m"), this.slider);
    this.element = h("section.card", { "aria-label": "Probe", hidden: true },
      h("header", {}, this.title, iconButton("close", "Close the probe", () => state.set({ probe: null, selected: null }))),
      this.along, this.values);
    host.append(this.element);
  }
  move(s) {
    const probe = this.state.get("probe");
    if (probe && Number.isFinite(s)) this.state.set({ probe: { ...probe, s: Math.max(0, s) } });
  }
  row(name, text) { this.values.append(h("dt", {}, name), h("dd", {}, text)); }

  show(actor, at, probe) {
    const picked = actor || this.view.find(this.state.get("selected"));
    this.element.hidden = !picked || picked.plane === true && !picked.forces;
    if (this.element.hidden) return;
    this.title.textContent = picked.run.index || this.view.data.runs.length > 1 ? `${picked.run.name}: ${picked.name}` : picked.name;
    this.along.hidden = picked.kind !== "wire";
    this.values.replaceChildren();
    if (picked.kind === "wire") this.showWire(picked, at, probe);
    else {
      const p = picked.group.position, f = picked.run.ok && picked.force ? picked.force(picked.run.at) : null;
      if (!picked.there) this.row("", "not there now");
      else if (!picked.plane) this.row("Place", vector(p.toArray(), "m"));
      if (f) this.row(picked.kind === "obstacle" ? "Force on it" : "Force on the wire", format(f.length(), "N"));
      if (f) this.row("", vector(f.toArray(), "N"));
    }
  }

  showWire(wire, at, probe) {
    const arc = wire.arc(), length = arc ? arc[wire.count - 1] : 0;
    this.slider.max = length;
    this.slider.value = probe?.s ?? 0;
    if (document.activeElement !== this.field) this.field.value = Number((probe?.s ?? 0).toPrecision(5));
    if (!at) {
      this.row("", "not there now");
      return;
    }
    if (!wire.run.ok) { // a run that failed has no numbers
      this.row("", "The run failed: no numbers");
      return;
    }
    this.row("Place", vector(at.point.toArray(), "m"));
    for (const q of this.known) {
      if (q.kind) continue;
      const x = wire.value(q.channel, Math.min(probe.s, length));
      if (Number.isNaN(x)) continue;
      this.row(q.label, format(x, q.unit));
      if (q.key === "curvature") this.row("Bend radius", x > 1e-9 ? format(1 / x, "m") : "∞");
    }
  }
}

/** Components as far as the largest of them has four digits. */
function vector(v, unit) {
  const largest = Math.max(...v.map(Math.abs));
  const digits = largest > 0 ? Math.max(0, Math.min(9, 3 - Math.floor(Math.log10(largest)))) : 0;
  return `${v.map((x) => Number(x.toFixed(digits)).toString().replace("-", "−")).join(", ")} ${unit}`;
}

/* --- results ---------------------------------------------------------------------------- */

function timeLink(t, state) {
  return h("button.link", { type: "button", title: "Go to this time", onclick: () => state.set({ time: t, playing: false }) },
    format(t, "s"));
}

export function resultsPanel(host, data, state) {
  for (const run of data.runs) {
    const box = h("section.results", {}, h("h3", {}, run.name));
    if (!run.ok) {
      box.append(h("p.failure", { role: "alert" }, h("strong", {}, "This run failed. "), run.reason || "No reason is given."),
        h("p.hint", {}, "Its results would be wrong: none are given. The frames show how far it came."));
      host.append(box);
      continue;
    }
    box.append(h("p.hint", {}, [run.reason, format(run.time, "s"), run.steps ? `${run.steps} step${run.steps === 1 ? "" : "s"}` : null,
      run.cpu !== undefined ? `${format(run.cpu, "s")} of computing` : null].filter(Boolean).join(" · ")));
    if (run.unmet) box.append(h("p.warning", {}, run.unmet));
    const body = h("tbody");
    for (const row of run.summary || []) {
      body.append(h("tr", { class: row.wrong ? "wrong" : undefined },
        h("th", { scope: "row" }, row.label, row.where ? h("small", {}, row.where) : null),
        h("td.number", {}, row.value), h("td.unit", {}, row.unit === "-" ? "" : row.unit),
        h("td.when", {}, row.when !== undefined && row.when !== null ? timeLink(row.when, state) : "")));
    }
    box.append(h("table", {}, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Result"), h("th.number", { scope: "col" }, "Value"),
      h("th", { scope: "col" }, "Unit"), h("th.when", { scope: "col" }, "When"))), body));
    if (run.quantities) box.append(asked(run));
    if (run.model) box.append(h("h4", {}, "Why this model"), ...run.model.split("\n").map((line) =>
      h(/^ {6}/.test(line) ? "p.hint" : "p", {}, line.trim())));
    host.append(box);
  }
}

/** Quantities whose accuracy was asked for. */
function asked(run) {
  const body = h("tbody");
  for (const q of run.quantities) {
    body.append(h("tr", { class: q.met === false ? "wrong" : undefined }, h("th", { scope: "row" }, q.name),
      h("td.number", {}, format(q.value, q.unit)), h("td.number", {}, `± ${format(q.error, q.unit)}`),
      h("td", {}, q.met === false ? "not as asked" : "as asked")));
  }
  return h("table", {}, h("caption", {}, "Accuracy"), body);
}

export function eventsPanel(host, data, state) {
  const list = h("ol.events");
  const all = data.runs.flatMap((run) => run.events.map((e) => ({ ...e, run }))).sort((a, b) => a.time - b.time);
  for (const e of all) {
    list.append(h("li", {}, timeLink(e.time, state), h("span.kind", {}, e.kind),
      h("span", {}, (data.runs.length > 1 ? `${e.run.name}: ` : "") + e.text
        + (e.count > 1 ? ` (${e.count} times until ${Number(e.last.toPrecision(4))} s)` : ""))));
  }
  host.append(all.length ? list : h("p.empty", {}, "Nothing out of the ordinary happened."));
}

export function scriptPanel(host, data) {
  const { script } = data;
  host.append(h("p.hint", {}, `SoftWorld ${data.version} · written ${data.made} · SI units`));
  if (!script) {
    host.append(h("p.empty", {}, "The script is not known: the run came from a prompt."));
    return;
  }
  host.append(h("h3", {}, script.name));
  const code = h("pre.code", { tabIndex: 0, "aria-label": "Script" });
  script.text.replace(/\n$/, "").split("\n").forEach((line) => {
    const comment = line.match(/^(\s*)(--.*)$/);
    code.append(h("span.line", {}, comment ? h("span.comment", {}, line) : line || " "), "\n");
  });
  host.append(code);
}
