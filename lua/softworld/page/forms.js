// SPDX-License-Identifier: GPL-3.0-or-later
// A form of one kind of object or step: its fields, the cable's values where it has one, and what the core says to it.
import { h } from "./dom.js";
import { row, selectLine, valuesOf } from "./fields.js";
import { format } from "./model.js";

const OF_SOLID = ["E", "nu", "density"]; // what a cable has instead
let count = 0;

const text = (x) => format(x).replace(/(\.\d*?)0+($|e)/, "$1$2").replace(/\.($|e)/, "$1");

/** Values of a cable, how far they are sure, and where they are from. */
function sheet(cable) {
  return h("div.sheet", {}, h("p.hint", {}, cable.doc), h("dl", {}, ...cable.rows.flatMap((r) => [
    h("dt", {}, r.name), h("dd", {}, h("b", { title: `${text(r.low)} … ${text(r.high)}` }, `${text(r.value)} ${r.unit === "-" ? "" : r.unit}`),
      h("span", { class: `flag ${r.flag}` }, r.flag), h("small", {}, r.source))])));
}

export class Form {
  /** kind: as the page has it; values: of its fields; things(class): names of what there is; word: of the button;
   * send(kind, values) gives a promise that fails with what is wrong; cancel() closes it, if it can be closed. */
  constructor(kind, values, { things, cables, word, send, cancel, more }) {
    Object.assign(this, { kind, cables, send, cancel });
    this.id = `form${count += 1}`;
    const given = values || kind.start || {};
    const before = [];
    if (kind.self === "gripper") before.push({ name: "_by", words: "gripper", type: "object", of: "gripper", required: true, unit: "-", doc: "that does it" });
    if (kind.on) before.push({ name: "_on", words: kind.on === "feed" ? "feed" : kind.on === "particles" ? "object" : "wire", type: "object", of: kind.on, required: true, unit: "-", doc: "on which" });
    this.rows = [...before, ...kind.fields].map((f) => row(f, `${this.id}-${f.name}`, given[f.name], things));
    for (const r of this.rows) for (const i of r.inputs) i.dataset.given = i.value;
    const folded = this.rows.filter((r) => r.field.more), open = folded.some((r) => given[r.field.name] !== undefined);
    this.why = h("p.why", { role: "alert", hidden: true });
    this.sheet = h("div");
    this.ok = h("button.text-button.main", { type: "submit" }, word);
    this.element = h("form.form", { noValidate: true, "aria-label": `${kind.class} ${kind.kind}`,
      onsubmit: (e) => { e.preventDefault(); this.go(); },
      onkeydown: (e) => { if (e.key === "Escape" && cancel) { e.stopPropagation(); cancel(); } } },
    h("p.hint", { hidden: kind.class === "run" }, kind.doc || ""), ...this.rows.filter((r) => !r.field.more).map((r) => r.element), this.sheet,
    folded.length ? h("details.more", { open }, h("summary", {}, `${folded.length} more`), ...folded.map((r) => r.element)) : null,
    this.why, h("div.form-end", {}, this.ok, more || null,
      cancel ? h("button.text-button", { type: "button", onclick: cancel }, "Cancel") : null));
    const cable = this.rows.find((r) => r.field.name === "cable");
    if (cable) {
      cable.inputs[0].addEventListener("change", () => this.showCable(cable.inputs[0].value));
      this.showCable(cable.inputs[0].value);
    }
  }

  showCable(name) {
    const cable = this.cables.find((c) => c.name === name), value = (key) => cable?.rows.find((r) => r.name === key)?.value;
    this.sheet.replaceChildren(...(cable ? [sheet(cable)] : []));
    for (const r of this.rows) {
      const { name: key } = r.field;
      if (OF_SOLID.includes(key)) r.element.hidden = Boolean(cable);
      if (key === "radius") r.inputs[0].placeholder = cable ? text(value("outer_diameter") / 2) : "required";
      if (/^(EA|EI|GJ|mass_per_length|breaking_load)$/.test(key)) r.inputs[0].placeholder = cable ? text(value(key) ?? "") : "";
      if (key === "stiffness" || key === "use") r.element.hidden = !cable;
    }
  }

  /** What was typed so far, as far as it can be read: for a form of another kind. */
  typed() {
    try {
      return valuesOf(this.rows.filter((r) => r.inputs.some((i) => i.dataset.given !== i.value)));
    } catch {
      return {};
    }
  }

  say(words) {
    this.why.hidden = !words;
    this.why.textContent = words || "";
    if (words) this.why.scrollIntoView({ block: "nearest" });
  }

  /** Where a function that was typed is wrong. */
  showLine(words) {
    for (const { field, inputs } of this.rows) {
      const line = field.type === "function" && new RegExp(`\\.${field.name}: line (\\d+):`).exec(words);
      if (line) selectLine(inputs[0], Number(line[1]));
    }
  }

  async go() {
    let values;
    this.say(null);
    try {
      values = valuesOf(this.rows);
    } catch (error) {
      this.say(error.message);
      return;
    }
    this.ok.disabled = true;
    try {
      await this.send(this.kind, values);
    } catch (error) {
      this.say(error.message);
      this.showLine(error.message);
    }
    this.ok.disabled = false;
  }

  focus() { this.element.querySelector("input, select, textarea")?.focus(); }
}
