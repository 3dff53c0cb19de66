// SPDX-License-Identifier: GPL-3.0-or-later
// The live page: the player fed while a run goes on. Time is the run's; what is changed is asked for over the
// link, and comes back as the line of Lua that did it.
import { h, icon, iconButton, download } from "./dom.js";
import { readThings, format } from "./model.js";
import { unpacked } from "./film.js";
import { LiveFilm } from "./livefilm.js";
import { Link } from "./link.js";
import { Hand, undoByHand } from "./hand.js";
import { Build } from "./build.js";
import { Handles } from "./handles.js";
import { rangeOf } from "./fields.js";
import { scriptPanel } from "./panels.js";

const SPEEDS = [["", "as fast as it can"], ["2", "2 ×"], ["1", "1 ×"], ["0.5", "0.5 ×"], ["0.25", "0.25 ×"], ["0.1", "0.1 ×"],
  ["0.05", "0.05 ×"], ["0.01", "0.01 ×"]];
const $ = (id) => document.getElementById(id);
const seconds = (t) => `${t.toFixed(3)} s`;

/** Time of a run under way: hold it, step, slow it down; look back at what was seen. */
export class LiveTransport {
  constructor(host, data, state, link) {
    Object.assign(this, { data, state, link, film: data.runs[0].film });
    this.play = iconButton("pause", "Hold the run (space)", () => this.toggle());
    this.play.classList.add("primary");
    this.next = iconButton("next", "One step (right arrow)", () => link.order("step"));
    this.end = iconButton("stop", "End the run", () => link.order("stop"));
    this.slider = h("input.slider", { type: "range", min: 0, max: 1, step: "any", value: 1, id: "time", "aria-label": "Time",
      oninput: () => this.go(Number(this.slider.value)) });
    this.marks = h("div.marks");
    this.clock = h("output.clock", { "aria-live": "off" });
    this.now = h("button.text-button.now", { type: "button", title: "Back to the present (End)", onclick: () => state.set({ follow: true }) },
      h("span.lamp"), "Live");
    this.speed = h("select", { "aria-label": "Speed of the run", title: "Speed of the run, of the clock's",
      onchange: () => link.order("speed", { value: this.speed.value ? Number(this.speed.value) : null }) },
    ...SPEEDS.map(([value, words]) => h("option", { value }, words)));
    host.append(h("div.buttons", {}, this.play, this.next, this.end), h("div.track", {}, this.marks, this.slider), this.clock,
      this.now, this.speed);
    this.slider.addEventListener("keydown", (e) => { if (/^(Arrow|Page|Home|End)/.test(e.key)) e.preventDefault(); });
    state.watch(["time", "follow"], () => this.show());
    state.watch(["run"], ({ run }) => {
      const held = !run.running || run.paused;
      this.play.replaceChildren(icon(held ? "play" : "pause"));
      this.play.title = run.draft && !run.running ? "Run (space)" : held ? "Go on (space)" : "Hold the run (space)";
      this.play.setAttribute("aria-label", this.play.title);
      this.play.disabled = !run.running && !run.draft;
      this.next.disabled = this.end.disabled = !run.running;
      if (document.activeElement !== this.speed) this.speed.value = run.speed ? String(run.speed) : "";
    });
    state.watch(["events"], () => this.showMarks());
  }

  get span() {
    const { times } = this.film;
    if (times.length > 1) return [times[0], times[times.length - 1]];
    return times[0] > 0 ? [times[0] - 1e-9, times[0]] : [0, 1e-9]; // a page that comes late begins at the end
  }
  toggle() {
    const run = this.state.get("run");
    if (run.draft && !run.running) this.start();
    else this.link.order(run.paused ? "go" : "pause");
  }
  go(time) { this.state.set({ follow: time >= this.span[1], time }); }
  step(by) {
    if (by > 0 && this.state.get("follow")) {
      this.link.order("step");
      return;
    }
    const { times } = this.film, now = this.state.get("time");
    let i = times.findIndex((t) => t >= now - 1e-12);
    if (i < 0) i = times.length - 1;
    this.go(times[Math.max(0, Math.min(times.length - 1, i + by))]);
  }
  faster(by) {
    const list = SPEEDS.map(([value]) => value), i = list.indexOf(this.speed.value);
    this.speed.value = list[Math.max(0, Math.min(list.length - 1, i - by))];
    this.speed.dispatchEvent(new Event("change"));
  }
  show() {
    const { time, follow } = this.state.values, [from, to] = this.span;
    Object.assign(this.slider, { min: from, max: to });
    this.slider.value = time;
    this.slider.style.setProperty("--part", `${(100 * (time - from)) / (to - from)}%`);
    this.slider.setAttribute("aria-valuetext", seconds(time));
    this.clock.textContent = follow ? seconds(time) : `${seconds(time)} / ${seconds(to)}`;
    this.now.setAttribute("aria-pressed", String(follow));
    if (to !== this.to) this.showMarks();
    this.to = to;
  }
  showMarks() {
    const [from, to] = this.span;
    this.marks.replaceChildren(...(this.state.get("events") || []).filter((e) => e.time >= from && e.time <= to).map((e) => {
      const words = `t = ${Number(e.time.toPrecision(4))} s: ${e.text}`;
      return h("button.mark", { type: "button", title: words, "aria-label": words, tabIndex: -1,
        style: { left: `${(100 * (e.time - from)) / (to - from)}%` }, onclick: () => this.go(e.time) });
    }));
  }
}

/* --- the panel: what can be changed, states, what was done ------------------------------------ */

/** One row of a form; tell(value) when it was changed. */
function rowField(row, id, tell) {
  const unit = row.unit && row.unit !== "-" ? row.unit : "", note = [unit, rangeOf(row)].filter(Boolean).join("  ");
  const label = (input) => h("div.row", {}, h("label", { for: id, title: row.doc }, row.name), input, h("small", {}, note));
  if (row.choices) {
    const select = h("select", { id, title: row.doc, onchange: () => tell(select.value) },
      ...row.choices.map((c) => h("option", { value: c, selected: c === row.value }, c)));
    return label(select);
  }
  const vector = row.type === "vector", values = vector ? row.value || [0, 0, 0] : [row.value];
  const shown = (x) => (typeof x === "number" ? String(Number(x.toPrecision(6))) : "");
  const fields = values.map((x, i) => h("input.number", { type: "text", inputMode: "decimal", spellcheck: false, value: shown(x),
    id: i ? undefined : id, title: row.doc, "aria-label": vector ? `${row.name} ${"xyz"[i]}` : row.name,
    onchange: () => {
      const given = fields.map((f, k) => (f.value === shown(values[k]) ? values[k] : Number(f.value.replace("−", "-").replace(",", "."))));
      const wrong = given.some((y) => !Number.isFinite(y));
      fields[i].setAttribute("aria-invalid", String(wrong));
      if (!wrong) tell(vector ? given : given[0]);
    } }));
  return label(vector ? h("span.vector", {}, ...fields) : fields[0]);
}

class Forms {
  constructor(host, link) {
    Object.assign(this, { link, chosen: "" });
    this.select = h("select", { id: "what", "aria-label": "What to change", onchange: () => { this.chosen = this.select.value; this.fill(); } });
    this.body = h("div.rows");
    host.append(h("section.part", {}, h("h3", {}, "Change", this.select), this.body));
  }
  show(forms) {
    this.forms = forms;
    if (!forms.some((f) => f.name === this.chosen)) this.chosen = "";
    this.select.replaceChildren(...forms.map((f) => h("option", { value: f.name, selected: f.name === this.chosen },
      f.name === "" ? "the scene" : `${f.name} (${f.kind})`)));
    if (!this.body.contains(document.activeElement)) this.fill(); // nothing goes away under somebody's hands
    else this.late = true;
  }
  fill() {
    const form = this.forms.find((f) => f.name === this.chosen);
    this.body.replaceChildren(...(form ? form.rows : []).map((row) => rowField(row, `row-${row.name}`,
      (value) => {
        this.link.order("set", { object: form.name, values: { [row.name]: value } });
        document.activeElement?.blur();
      })));
  }
}

/** What was done, as lines of Lua. */
class Lines {
  constructor(host, state, link, say) {
    this.say = say;
    this.undo = iconButton("back", "Undo the last change", () => undoByHand(link, say), { disabled: true });
    state.watch(["run"], ({ run }) => {
      this.undo.disabled = !run.undo;
      this.undo.title = run.undo ? "Undo the last change" : run.no_undo || "There is nothing to undo";
    });
    this.save = h("button.text-button.small", { type: "button", disabled: true, onclick: () => download(this.script, "by_hand.lua", "text/x-lua") }, "Save script");
    this.list = h("ol.lines", { "aria-live": "polite", "aria-label": "What was done" });
    this.empty = h("p.hint", {}, "Pull a wire or lead a gripper in the picture, or change a value above: what you do is shown here as the Lua that does it.");
    host.append(h("section.part", {}, h("h3", {}, "Done by hand", h("span.gap"), this.undo, this.save), this.empty, this.list));
  }
  show({ lines, script }) {
    this.script = script;
    this.save.disabled = !script;
    this.empty.hidden = lines.length > 0;
    this.list.replaceChildren(...lines.slice().reverse().map((line) => h("li", { class: line.ok ? undefined : "wrong" },
      h("span.when", {}, seconds(line.time)), line.text ? h("code", {}, line.text) : null,
      line.count > 1 ? h("small", {}, `${line.count} times`) : null, line.undone ? h("small", {}, "undone") : null,
      line.ok ? null : h("span.why", {}, line.error))));
    const last = lines[lines.length - 1];
    const form = document.querySelector(".form-box"); // tells it itself
    if (last && !last.ok && last.error !== this.told && !form) this.say(last.error);
    this.told = last && !last.ok ? last.error : null;
  }
}

class States {
  constructor(host, state, link, say) {
    this.keep = h("button.text-button.small", { type: "button", title: "Keep the state as it is now (K)", onclick: () => link.order("keep") }, icon("keep"), "Keep");
    this.list = h("div.states");
    this.why = h("p.hint", {}, "A process has gone on since, and a Lua function has no way back.");
    const more = h("input.number", { type: "text", inputMode: "decimal", value: "1", id: "more", "aria-label": "How long to run on [s]" });
    this.more = h("div.row", {}, h("label", { for: "more" }, "Run on for"), more, h("button.text-button.small", { type: "button",
      onclick: () => link.order("run", { duration: Number(more.value.replace(",", ".")) }) }, icon("play"), "s"));
    host.append(h("section.part", {}, h("h3", {}, "States", h("span.gap"), this.keep), this.list, this.why, this.more));
    state.watch(["run"], ({ run }) => {
      this.why.hidden = run.snapshots.every((s) => s.back);
      this.more.hidden = run.running || !run.done || !run.ok || !run.back;
      this.list.replaceChildren(...run.snapshots.map((s) => h("button.chip", { type: "button", disabled: !s.back,
        title: `Back to t = ${seconds(s.time)}`, onclick: () => link.ask("back", { id: s.id }).then(say, (e) => say(e.message)) }, icon("back"), seconds(s.time))));
    });
  }
}

function handPart(host, state) {
  const limit = h("input.number", { type: "text", inputMode: "decimal", id: "limit", "aria-label": "Largest force of the hand",
    onchange: () => {
      const force = Number(limit.value.replace(",", ".")), { grip } = state.values;
      if (force > 0 && Number.isFinite(force)) state.set({ grip: { force, stiffness: (grip.stiffness * force) / grip.force } });
      else limit.value = state.get("grip").force;
    } });
  const lead = h("input.number", { type: "text", inputMode: "decimal", id: "lead", "aria-label": "Largest speed of a gripper that is led by hand",
    value: String(state.get("lead")), onchange: () => {
      const speed = Number(lead.value.replace(",", "."));
      if (speed > 0 && Number.isFinite(speed)) state.set({ lead: speed }); else lead.value = String(state.get("lead"));
    } });
  host.append(h("section.part", {}, h("div.row", {}, h("label", { for: "limit", title: "A pull grows with the way, up to this" },
    "Hand, up to"), limit, h("small", {}, "N")),
  h("div.row", {}, h("label", { for: "lead", title: "A gripper that is dragged goes to the pointer no faster than this" }, "Gripper, up to"),
    lead, h("small", {}, "m/s"))));
  state.watch(["grip"], ({ grip }) => { limit.value = Number(grip.force.toPrecision(4)); });
}

function liveEvents(host, state) {
  state.watch(["events"], ({ events }) => {
    const list = h("ol.events", {}, ...events.slice().reverse().map((e) => h("li", {},
      h("button.link", { type: "button", title: "Look at this time", onclick: () => state.set({ follow: false, time: e.time }) },
        `${Number(e.time.toPrecision(4))} s`), h("span.kind", {}, e.kind), h("span", {}, e.text))));
    host.replaceChildren(events.length ? list : h("p.empty", {}, "Nothing out of the ordinary has happened."));
  });
}

/* --- the whole --------------------------------------------------------------------------------- */

function badge(state) {
  state.watch(["run", "over", "linked"], ({ run, over, linked }) => {
    const [words, kind] = !linked ? ["not connected", "warn"] : run.running ? (run.again !== undefined ? ["going back", "warn"] : run.paused ? ["held", "warn"] : ["running", "good"])
      : over ? ["FAILED", "bad"] : run.at_start ? ["at the start", "good"] : run.done ? ["ended", "good"] : ["not begun", "warn"];
    $("status").textContent = words;
    $("status").className = `badge ${kind}`;
    $("status").title = run.reason || "";
    $("banner").hidden = !over;
    $("banner").textContent = over ? `The run failed. ${run.reason || ""}` : "";
    document.body.classList.toggle("failed", Boolean(over));
  });
}

/** Begin: wait for the scene and its first frame, then build the page. page: parts that the player has too. */
export function startLive(data, page) {
  for (const name of ["charts", "results"]) {
    $(`tab-${name}`).remove();
    $(`panel-${name}`).remove();
  }
  const film = new LiveFilm(), run = { index: 0, film };
  let state = null, view = null, outline = 0, session = null, panel = null, ready = null, renew = false, link = null;
  const waiting = { run: { running: false, snapshots: [], ok: true }, events: [], lines: null };
  const put = (changes) => { if (state) state.set(changes); else Object.assign(waiting, changes); };
  const handlers = {
    connected(on) { put({ linked: on }); },
    async scene(m) {
      if (session !== null && m.session !== session) { window.location.reload(); return; } // another scene
      session = m.session;
      await readThings(m.run, new Map(), (n) => unpacked(m.blobs[n]));
      Object.assign(run, m.run, { index: 0, film });
      outline = m.outline;
      if (state && state.get("grip") === waiting.grip) state.set({ grip: m.hand }); // nobody has chosen another one
      waiting.grip = m.hand;
      $("title").textContent = m.run.name;
      renew = true;
    },
    async frame(bytes, of, from) {
      if (of !== outline || from !== session) return;
      const t = await film.take(bytes);
      if (!state) ready();
      else if (renew && view) page.renew(view, data, state, data.live.draft);
      renew = false;
      state.set(state.get("follow") ? { time: t, tick: film.version } : { tick: film.version });
      await new Promise((resolve) => { requestAnimationFrame(resolve); setTimeout(resolve, 200); }); // hidden pages draw nothing
    },
    state(m) { put({ run: m, over: m.done && m.ok === false ? true : null }); },
    lines(m) {
      waiting.lines = m;
      if (panel) showLines(m);
    },
    forms(m) {
      waiting.forms = m;
      if (panel) showForms(m);
    },
    draft(m) {
      waiting.draft = m;
      if (panel) panel.build.show(m);
    },
    answers(m) { link.answered(m.answers); },
    events(m) { put({ events: m.events }); },
  };
  const showLines = (m) => {
    panel.lines.show(m);
    panel.build.showScript(m.script, m.unsaved);
    $("panel-script").replaceChildren();
    scriptPanel($("panel-script"), { ...data, script: m.script && { name: data.live.draft ? "scene.lua" : "again.lua", text: m.script } });
  };
  const showForms = (m) => {
    panel.forms.show(m.forms);
    panel.build.showObjects(m);
  };
  const build = () => {
    data.runs = [run];
    state = page.newState(data, { ...waiting, time: film.times[0], follow: true, hand: true, lead: 0.2, tab: data.live.draft ? "build" : "live",
      tick: 0, linked: true, ...(data.live.draft ? { quantity: "curvature" } : {}) });
    badge(state);
    page.frame(state);
    const transport = new LiveTransport($("transport"), data, state, link);
    view = page.openView(data, state);
    const host = $("panel-live");
    if (view) {
      state.watch(["tick"], () => view.update());
      const hand = iconButton("hand", "Pull wires, lead grippers (H)", () => state.set({ hand: !state.get("hand") }), { id: "hand" });
      $("tools").append(hand);
      state.watch(["hand"], ({ hand: on }) => hand.setAttribute("aria-pressed", String(on)));
      new Handles(view, state, { say: page.say, may: (actor) => panel?.build.canPlace(actor), put: (actor, k, x) => panel.build.place(actor, k, x) });
      window.hand = new Hand(view, state, link);
      handPart(host, state);
    }
    const idle = h("p.hint", {}, "Nothing runs yet: objects are changed under Build. Here is what can be changed while they move.");
    host.prepend(idle);
    const nothing = h("p.empty", {}, "Nothing is here yet. Add a wire, an obstacle, a clamp; then let it run.");
    $("stage").append(nothing);
    state.watch(["tick", "run"], () => { nothing.hidden = !data.live.draft || run.wires.length + run.obstacles.length + run.grips.length > 0; });
    state.watch(["run"], ({ run: now }) => {
      idle.hidden = !now.at_start;
      for (const part of host.querySelectorAll(".part")) part.hidden = Boolean(now.at_start);
    });
    panel = { forms: new Forms(host, link), states: new States(host, state, link, page.say), lines: new Lines(host, state, link, page.say),
      build: new Build($("panel-build"), state, link, data.live.forms, page.say) };
    panel.build.actors = () => (view ? view.actors : []);
    transport.start = () => panel.build.run?.go();
    state.set({ run: { ...state.get("run") } });
    if (waiting.forms) showForms(waiting.forms);
    if (waiting.lines) showLines(waiting.lines);
    if (waiting.draft) panel.build.show(waiting.draft);
    liveEvents($("panel-events"), state);
    page.finish(data, state, view, transport, { k: () => link.order("keep"), h: () => state.set({ hand: !state.get("hand") }),
      " ": () => transport.toggle(), End: () => state.set({ follow: true }) });
    window.player = { state, view, transport, data, link, panel, format };
  };
  return new Promise((resolve) => {
    link = new Link(handlers);
    ready = () => {
      ready = () => {};
      build();
      resolve();
    };
  });
}
