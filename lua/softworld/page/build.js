// SPDX-License-Identifier: GPL-3.0-or-later
// The panel in which a scene is put together: objects, steps, how it is to run. While a run goes on, or in the scene of a
// script, what is added is done at once; before, it is a line of the script that will be run.
import { h, icon, iconButton, download } from "./dom.js";
import { Form } from "./forms.js";
import { undoByHand } from "./hand.js";

const CLASSES = [["wire", "Wire"], ["particles", "Particles"], ["obstacle", "Obstacle"], ["hold", "Hold"], ["gripper", "Gripper"], ["force", "Force"],
  ["fixing", "Fixing"], ["contact", "Contact"], ["observer", "Observer"], ["check", "Check"]];

export class Build {
  constructor(host, state, link, forms, say) {
    Object.assign(this, { host, state, link, say, kinds: forms.kinds, cables: forms.cables, items: [], objects: [], made: [], forms: [], draft: null,
      script: null });
    this.undo = iconButton("back", "Undo", () => (this.planned ? this.order("undo") : undoByHand(this.link, this.say)), { disabled: true });
    this.redo = iconButton("redo", "Redo", () => this.order("redo"), { disabled: true });
    this.chips = h("div.chips", { role: "group", "aria-label": "What to add" }, ...CLASSES.filter(([name]) => this.kindsOf(name).length).map(([name, words]) =>
      h("button.chip", { type: "button", "data-class": name, "aria-pressed": "false", onclick: () => this.add(name) }, icon("plus"), words)));
    this.room = h("div.room");
    this.note = h("p.hint", { hidden: true });
    this.list = h("ul.things", { "aria-label": "Objects" });
    this.remarks = h("div");
    this.steps = h("ol.things", { "aria-label": "Steps" });
    this.stepRoom = h("div.room");
    this.noSteps = h("p.hint", {}, "Without steps the scene moves by itself, for as long as the run lasts.");
    this.stepPart = h("section.part", {}, h("h3", {}, "What happens", h("span.gap"),
      h("button.text-button.small", { type: "button", id: "add-step", onclick: () => this.addStep() }, icon("plus"), "Step")),
    this.noSteps, this.steps, this.stepRoom);
    this.runPart = h("section.part", {});
    this.save = h("button.text-button.small", { type: "button", onclick: () => this.saveScript() }, "Save as Lua");
    this.empty = h("p.hint", {}, "Nothing yet. Begin with a wire.");
    host.append(h("section.part", {}, h("h3", {}, "Add", h("span.gap"), this.undo, this.redo), this.note, this.chips, this.room),
      h("section.part", {}, h("h3", {}, "Objects", h("span.gap"), this.save), this.empty, this.list, this.remarks), this.stepPart, this.runPart);
    state.watch(["run"], () => {
      this.mode();
      this.canUndo();
    });
  }

  /** Is it a list of lines that will be run, and not a scene that moves already? */
  get planned() {
    const run = this.state.get("run");
    return Boolean(run.draft && !run.running);
  }

  mode() {
    const { run } = this.state.values, planned = this.planned, key = `${run.draft} ${planned} ${run.at_start}`;
    if (key === this.key) return;
    this.key = key;
    if (this.was !== planned) this.close();
    this.was = planned;
    this.stepPart.hidden = this.runPart.hidden = !run.draft;
    this.redo.hidden = !planned;
    this.canUndo();
    this.stepPart.inert = !planned;
    this.note.hidden = planned && run.at_start;
    this.note.textContent = planned ? "A change goes back to the start." : run.draft
      ? "A run is under way: what you add is done at once, by hand." : "What you add is done at once, and is told under Change.";
    if (run.draft && !this.run) this.makeRun();
    if (this.run) {
      this.run.ok.disabled = run.running;
      this.again.disabled = run.running || run.at_start;
    }
    this.fill();
  }

  things(kind) {
    const kinds = kind.split(" ");
    return this.objects.filter((o) => kinds.includes(o.kind) || kinds.includes(o.class)).map((o) => o.name);
  }

  /** What there is to be seen. */
  actors() { return []; }

  kindsOf(cls) { return this.kinds.filter((k) => k.class === cls); }
  kindOf(cls, kind) { return this.kinds.find((k) => k.class === cls && k.kind === kind); }

  async order(what, more = {}) {
    const words = await this.link.ask("draft", { what, ...more }).catch((error) => { this.say(error.message); throw error; });
    if (words) this.say(words);
  }

  /* --- forms -------------------------------------------------------------------------------- */

  close() {
    const inside = this.open?.box.contains(document.activeElement), { back } = this;
    this.open = this.back = null;
    for (const chip of this.chips.children) chip.setAttribute("aria-pressed", "false");
    this.room.replaceChildren();
    this.stepRoom.replaceChildren();
    for (const li of this.host.querySelectorAll(".things .form-box")) li.remove();
    if (inside) back?.()?.focus(); // keys go on where they were
  }

  // A form with a choice of its kind before it, in a place of the panel.
  put(cls, kind, values, { word, send, more, into }) {
    const own = this.kindsOf(cls), box = h("div.form-box");
    const show = (name, given) => {
      const def = this.kindOf(cls, name);
      const form = new Form(def, given, { things: (k) => this.things(k), cables: this.cables, word, send, more, cancel: () => this.close() });
      box.replaceChildren(...(own.length > 1 ? [h("div.row.choose", {}, h("label", { for: `${form.id}-kind` }, cls === "wire" ? "model"
        : cls === "step" ? "step" : cls === "obstacle" ? "shape" : "kind"), h("select", { id: `${form.id}-kind`, onchange: (e) => {
        show(e.target.value, { ...this.kindOf(cls, e.target.value).start, ...form.typed() });
        box.querySelector("select").focus();
      } }, ...own.map((k) => h("option", { value: k.kind, selected: k.kind === name, title: k.doc }, k.kind.replace(/_/g, " ")))))] : []),
      form.element);
      this.form = form;
    };
    show(kind || own[0].kind, values);
    into.append(box);
    this.open = { box };
    const from = document.activeElement, id = into.dataset.item;
    this.back = () => (id ? this.host.querySelector(`[data-item="${id}"] .thing-name`) : from);
    box.scrollIntoView({ block: "nearest" });
    this.form.focus();
  }

  add(cls) {
    const again = this.open && this.chips.querySelector(`[data-class=${cls}]`).getAttribute("aria-pressed") === "true";
    this.close();
    if (again) return;
    this.chips.querySelector(`[data-class=${cls}]`).setAttribute("aria-pressed", "true");
    const first = { obstacle: "plane" }[cls];
    this.put(cls, first, null, { word: "Add", into: this.room, send: async (kind, values) => {
      const more = { class: kind.class, kind: kind.kind, values };
      if (this.planned) await this.link.ask("draft", { what: "add", ...more });
      else await this.link.ask("add", more);
      this.close();
    } });
  }

  addStep(kind) {
    this.close();
    this.put("step", kind, null, { word: "Add", into: this.stepRoom, more: this.processChoice(1), send: async (def, values) => {
      await this.link.ask("draft", { what: "add", class: "step", kind: def.kind, values, process: this.process() });
      this.close();
    } });
  }

  // Steps of one process follow one another; several processes go on at once.
  processChoice(chosen) {
    this.processSelect = h("select", { "aria-label": "Process", title: "Steps of a process follow one another; several go on at once" },
      ...Array.from({ length: this.draft?.processes || 1 }, (_, i) => h("option", { value: i + 1, selected: i + 1 === chosen }, `process ${i + 1}`)));
    return this.processSelect;
  }
  process() { return Number(this.processSelect.value); }

  edit(item, li) {
    const same = this.open?.item === item.id;
    this.close();
    if (same) return;
    const step = item.class === "step", actor = this.actors().find((a) => a.kind === item.class && a.name === item.name);
    if (actor) this.state.set({ selected: actor.id, probe: null }); // with its handles
    this.put(item.class, item.kind, item.values, { word: "Change", into: li, more: step ? this.processChoice(item.process) : null,
      send: async (def, values) => {
        await this.link.ask("draft", { what: "change", id: item.id, class: def.class, kind: def.kind, values,
          ...(step ? { process: this.process() } : {}) });
        this.close();
      } });
    this.open.item = item.id;
  }

  editScene(li) {
    const same = this.open?.item === "scene";
    this.close();
    if (same) return;
    this.put("scene", "scene", this.draft.scene, { word: "Change", into: li, send: async (def, values) => {
      await this.link.ask("draft", { what: "scene", values });
      this.close();
    } });
    this.open.item = "scene";
  }

  /* --- places, from the picture ------------------------------------------------------------------ */

  itemOf(actor) { return this.items.find((i) => i.class === actor.kind && i.name === actor.name); }

  /** Can it be put elsewhere now? Obstacles while nothing moves, grippers before they have begun. */
  canPlace(actor) {
    const { run, over } = this.state.values;
    if (over || !this.state.get("follow")) return false;
    const solid = actor.kind === "obstacle" && !actor.plane && !actor.fixed && !actor.given.part;
    if (run.draft && run.at_start) return Boolean((solid || actor.kind === "gripper") && this.itemOf(actor));
    return solid && (!run.running || run.paused);
  }

  /** Component k of its place is to be x [m]; the others stay as they were given, which pictures know less exactly. */
  place(actor, k, x) {
    const item = this.planned && this.state.get("run").at_start ? this.itemOf(actor) : null;
    const form = this.forms.find((f) => f.name === actor.name), known = item ? item.values.at : form?.rows.find((r) => r.name === "at")?.value;
    const at = [...(known || [0, 0, 0])];
    at[k] = x;
    if (item) return this.link.ask("draft", { what: "put", id: item.id, values: { at } });
    return this.link.ask("set", { object: actor.name, values: { at } });
  }

  /* --- the run ------------------------------------------------------------------------------ */

  makeRun() {
    this.again = h("button.text-button", { type: "button", id: "again", title: "Back to the start, to change it and run again",
      onclick: () => this.link.ask("again").catch((e) => this.say(e.message)) }, icon("back"), "Back to start");
    const given = this.draft && Object.keys(this.draft.run).length ? this.draft.run : null;
    this.run = new Form(this.kindOf("run", "run"), given, { things: () => [], cables: [], word: "Run", more: this.again,
      send: (kind, values) => this.link.ask("start", { values }) });
    this.run.ok.prepend(icon("play"));
    this.run.ok.id = "run";
    const judged = h("ul.judged", { "aria-label": "What the checks found", hidden: true });
    this.state.watch(["run"], ({ run }) => {
      judged.hidden = !run.check;
      judged.replaceChildren(...(run.check?.rows || []).map((r) => h("li", {}, h("b", { class: r.verdict.toLowerCase() }, r.verdict), ` ${r.name}`,
        typeof r.value !== "number" ? "" : ` ${Number(r.value.toPrecision(4))} ${r.unit === "-" ? "" : r.unit}`, r.note ? h("small", {}, r.note) : null)));
    });
    this.runPart.replaceChildren(h("h3", {}, "Run"), this.run.element, judged);
  }

  saveScript() { if (this.script) download(this.script, this.state.get("run").draft ? "scene.lua" : "again.lua", "text/x-lua"); }

  /* --- lists ---------------------------------------------------------------------------------- */

  show(m) { // the draft
    this.draft = m;
    this.items = m.items;
    this.redo.disabled = !m.redo;
    this.canUndo();
    this.remarks.replaceChildren(...(m.remarks || []).map((words) => h("p.warning", {}, words)));
    this.mode();
    this.fill();
  }
  showObjects({ objects, made, forms }) {
    this.objects = objects;
    this.forms = forms;
    this.made = made || [];
    this.fill();
  }
  canUndo() {
    const run = this.state.get("run"), can = this.planned ? this.draft?.undo : run.undo;
    this.undo.disabled = !can;
    this.undo.title = can ? "Undo" : (!this.planned && run.no_undo) || "There is nothing to undo";
  }
  showScript(script, why) {
    this.script = script;
    this.save.disabled = !script;
    this.save.title = script ? "The script that does all this again" : why || "";
  }

  fill() {
    const focus = document.activeElement, box = this.open?.item !== undefined ? this.open.box : null, { planned } = this;
    const objects = planned ? this.items.filter((i) => i.class !== "step").map((item) => this.planItem(item)) : this.liveItems();
    if (planned && this.draft) objects.push(this.sceneItem());
    this.list.replaceChildren(...objects);
    const steps = this.items.filter((i) => i.class === "step"), several = new Set(steps.map((s) => s.process)).size > 1;
    steps.sort((a, b) => a.process - b.process);
    this.steps.replaceChildren(...steps.map((item) => this.planItem(item, several)));
    this.empty.hidden = objects.length > (planned ? 1 : 0);
    this.noSteps.hidden = steps.length > 0;
    if (box) {
      const li = this.host.querySelector(`[data-item="${this.open.item}"]`);
      if (li) li.append(box); else this.open = null;
      if (box.contains(focus)) focus.focus();
    }
  }

  planItem(item, several) {
    const step = item.class === "step", li = h("li", { "data-item": item.id });
    const name = step ? item.kind.replace(/_/g, " ") : item.name || item.kind;
    const shift = (by, words, picture) => iconButton(picture, words, () => this.order("shift", { id: item.id, by }).catch(() => {}));
    li.append(h("div.thing", {}, h("button.thing-name", { type: "button", title: "Change it", onclick: () => this.edit(item, li) },
      h("span", {}, name), h("small", {}, step ? (several ? `process ${item.process}` : "") : item.name ? item.kind : item.class),
      h("code", { title: item.text.slice(0, 600) }, item.text.slice(0, 200))),
    step ? shift(-1, "Earlier", "up") : null, step ? shift(1, "Later", "down") : null,
    iconButton("close", `Remove ${name}`, () => this.order("remove", { id: item.id }).catch(() => {}))));
    return li;
  }

  sceneItem() {
    const li = h("li", { "data-item": "scene" }), g = this.draft.scene.gravity;
    li.append(h("div.thing", {}, h("button.thing-name", { type: "button", title: "Change it", onclick: () => this.editScene(li) },
      h("span", {}, "the scene"), h("small", {}, g ? `gravity ${g.join(", ")} m/s2` : "usual gravity"))));
    return li;
  }

  liveItems() {
    const remove = (more) => this.link.ask("remove", more).catch((error) => this.say(error.message));
    const line = (name, kind, more, leaves, why) => h("li", {}, h("div.thing", {}, h("span.thing-name", {}, h("span", {}, name), h("small", {}, kind),
      why ? h("em", {}, why) : null), leaves ? iconButton("close", `Remove ${name}`, () => remove(more)) : null));
    return [...this.objects.map((o) => line(o.name, o.kind, o.force ? { force: o.force } : { object: o.name }, o.leaves, o.why)),
      ...this.made.map((f) => line(f.kind, "force", { made: f.made }, true))];
  }
}
