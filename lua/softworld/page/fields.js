// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of forms, as rows of the scene's parameters tell them: name, type, unit, range, default, choices. A field gives
// back what was typed, as numbers; whether that may be, the core says.
import { h } from "./dom.js";

const KNOWN = { x: 0, y: 1, z: 2 };

export function rangeOf(row) {
  const short = (x) => Number(x.toPrecision(4)), low = row.min > -1e5, high = row.max < 1000;
  if (low && high) return `${short(row.min)} … ${short(row.max)}`;
  if (low) return `${row.above ? ">" : "≥"} ${short(row.min)}`;
  return high ? `≤ ${short(row.max)}` : "";
}

/** What was typed, as a number; raises what is no number. */
export function numberOf(text, name) {
  const x = Number(text.trim().replace("−", "-").replace(",", "."));
  if (text.trim() === "" || !Number.isFinite(x)) throw new Error(`${name}: '${text}' is no number`);
  return x;
}

const shown = (x) => (x === undefined || x === null ? "" : String(x));
const unitOf = (field) => (field.unit && field.unit !== "-" ? field.unit : "");

function textInput(field, id, value, label, hint) {
  return h("input.number", { type: "text", spellcheck: false, autocomplete: "off", id, value: shown(value), title: field.doc,
    "aria-label": label, placeholder: hint || "", inputMode: /number|integer|vector|rotation/.test(field.type) ? "decimal" : "text" });
}

function several(field, id, names, values, hints) {
  return names.map((n, i) => textInput(field, i ? undefined : id, values?.[i], `${field.name} ${n}`, shown(hints?.[i] ?? n)));
}

// Numbers of inputs; undefined: none was typed in.
function readAll(inputs, name) {
  const texts = inputs.map((i) => i.value.trim());
  if (texts.every((t) => t === "")) return undefined;
  return inputs.map((input, i) => {
    try {
      return numberOf(texts[i], name);
    } catch (error) {
      input.setAttribute("aria-invalid", "true");
      throw error;
    }
  });
}

const KINDS = {
  number(field, id, value) {
    const hint = typeof field.default === "number" ? Number(field.default.toPrecision(5)) : (field.usual !== undefined ? field.usual : field.required ? "required" : "");
    const input = textInput(field, id, value, field.name, shown(hint));
    return { element: input, inputs: [input], read: () => readAll([input], field.name)?.[0] };
  },
  text(field, id, value) {
    const input = textInput(field, id, value, field.name, field.usual || "");
    input.classList.add("words");
    return { element: input, inputs: [input], read: () => input.value.trim() || undefined };
  },
  choice(field, id, value) {
    const none = field.required ? [] : [h("option", { value: "" }, field.usual ? `(${field.usual})` : "—")];
    const select = h("select", { id, title: field.doc, "aria-label": field.name }, ...none,
      ...field.choices.map((c) => h("option", { value: c, selected: c === value }, c)));
    return { element: select, inputs: [select], read: () => select.value || undefined };
  },
  boolean(field, id, value) {
    const select = h("select", { id, title: field.doc, "aria-label": field.name }, h("option", { value: "" }, "—"),
      h("option", { value: "1", selected: value === true }, "yes"), h("option", { value: "0", selected: value === false }, "no"));
    return { element: select, inputs: [select], read: () => (select.value ? select.value === "1" : undefined) };
  },
  vector(field, id, value) {
    const inputs = several(field, id, Object.keys(KNOWN), value, field.default);
    return { element: h("span.vector", {}, ...inputs), inputs, read: () => readAll(inputs, field.name) };
  },
  rotation(field, id, value) {
    const given = Array.isArray(value) ? value : value ? [...value.axis, value.angle] : null;
    const inputs = several({ ...field, doc: `${field.doc}: axis and angle` }, id, ["x", "y", "z", "rad"], given);
    const quaternion = Array.isArray(value);
    return { element: h("span.vector.four", {}, ...inputs), inputs,
      read: () => {
        const all = readAll(inputs, field.name);
        return all && (quaternion ? all : { axis: all.slice(0, 3), angle: all[3] });
      } };
  },
  points(field, id, value) {
    const area = h("textarea.number", { id, rows: 3, spellcheck: false, title: field.doc, placeholder: "x y z, a point a line",
      value: (value || []).map((p) => p.join("  ")).join("\n"), "aria-label": field.name });
    const read = () => {
      const lines = area.value.split("\n").map((l) => l.trim()).filter(Boolean);
      return lines.length ? lines.map((l) => l.split(/[\s;]+/).map((x) => numberOf(x, field.name))) : undefined;
    };
    return { element: area, inputs: [area], read };
  },
  numbers(field, id, value) {
    const input = textInput(field, id, value && value.join(" "), field.name, "1 2 3");
    return { element: input, inputs: [input],
      read: () => (input.value.trim() ? input.value.trim().split(/[\s;]+/).map((x) => numberOf(x, field.name)) : undefined) };
  },
  object(field, id, value, things) {
    const known = things(field.of), select = h("select", { id, title: field.doc, "aria-label": field.name },
      ...(field.required ? [] : [h("option", { value: "" }, field.usual ? `(${field.usual})` : "—")]),
      ...known.map((name) => h("option", { value: name, selected: name === value }, name)));
    if (field.required && !known.length) select.append(h("option", { value: "" }, `there is no ${field.of.replace(/ /g, ", ")} yet`));
    return { element: select, inputs: [select], read: () => select.value || undefined };
  },
  table(field, id, value, things) {
    const rows = field.rows.map((inner) => row(inner, `${id}-${inner.name}`, value?.[inner.name], things));
    const details = h("details.inner", { open: Boolean(value) }, h("summary", { title: field.doc }, field.name,
      h("small", {}, field.doc)), ...rows.map((r) => r.element));
    return { element: details, whole: true, inputs: rows.flatMap((r) => r.inputs),
      read: () => {
        const own = valuesOf(rows);
        return Object.keys(own).length ? own : undefined;
      } };
  },
};
/** A Lua function: what stands around its body is told, and the body typed. */
KINDS.function = (field, id, value) => {
  const area = h("textarea.code", { id, rows: 5, spellcheck: false, autocapitalize: "off", wrap: "off", title: field.doc,
    value: value || "", "aria-label": `${field.name}, the body of a Lua function` });
  const element = h("div.function", {}, h("label", { for: id, class: field.required ? "required" : "" }, field.name), h("small", {}, field.doc),
    h("code", {}, `function(${field.args})`), area, h("code", {}, "end"));
  return { element, whole: true, inputs: [area], read: () => (area.value.trim() ? area.value : undefined) };
};
KINDS.integer = KINDS.number;
KINDS.file = KINDS.text;

/** What all of them have that something was typed into. */
export function valuesOf(rows) {
  const values = {};
  for (const r of rows) {
    for (const i of r.inputs) i.removeAttribute("aria-invalid");
  }
  for (const r of rows) {
    const value = r.element.hidden ? undefined : r.read();
    if (value !== undefined) values[r.field.name] = value;
  }
  return values;
}

/** Select a line of a text that was typed, from 1. */
export function selectLine(area, line) {
  const lines = area.value.split("\n"), at = lines.slice(0, line - 1).reduce((n, l) => n + l.length + 1, 0);
  area.focus();
  area.setSelectionRange(at, at + (lines[line - 1] || "").length);
}

/** A field in its row: { field, element, inputs, read() }. things(class): names of what there is. */
export function row(field, id, value, things) {
  const made = KINDS[field.type](field, id, value, things);
  if (made.whole) return { ...made, field };
  const note = [unitOf(field), rangeOf(field)].filter(Boolean).join("  ");
  const name = h("label", { for: id, title: field.doc }, field.words || field.name);
  if (field.required) name.classList.add("required");
  return { ...made, field, element: h("div.row", {}, name, made.element, h("small", { title: field.doc }, note)) };
}
