// SPDX-License-Identifier: GPL-3.0-or-later
// The player's page: reads its data, builds its parts, ties them together by the shared state.
import "./style.css";
import { h, icon, iconButton } from "./dom.js";
import { load, State, spanOf, frameTimes, knownQuantities } from "./model.js";
import { Transport } from "./transport.js";
import { Charts } from "./charts.js";
import { View } from "./view.js";
import { Legend, ProbeCard, compass, objectTree, lookPanel, resultsPanel, eventsPanel, scriptPanel } from "./panels.js";
import { startLive } from "./live.js";
import { CheckPanel, badge } from "./check.js";
import { savePicture, saveTable, saveFilm, linkOf, readLink } from "./exports.js";

const $ = (id) => document.getElementById(id);
const THEMES = {
  dark: { background: "#161a20", floor: "#1c2129", line: "#475162", shade: 0.55, bounce: "#2c3440", accent: "#2cc5bd", sky: 0.5, sun: 0.52 },
  light: { background: "#eef1f4", floor: "#f6f8fa", line: "#b9c2cd", shade: 0.24, bounce: "#b9bec6", accent: "#0b7f7a", sky: 0.62, sun: 0.62 },
};

function say(text) {
  const line = $("say");
  line.textContent = text;
  line.classList.add("on");
  clearTimeout(say.timer);
  say.timer = setTimeout(() => line.classList.remove("on"), 2600);
}

/* --- tabs ---------------------------------------------------------------------------------- */

function tabs(state, charts) {
  const all = [...document.querySelectorAll("[role=tab]")];
  const choose = (tab) => state.set({ tab: tab.dataset.tab });
  for (const tab of all) {
    tab.addEventListener("click", () => choose(tab));
    tab.addEventListener("keydown", (e) => {
      const by = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
      if (!by) return;
      e.preventDefault();
      e.stopPropagation();
      const next = all[(all.indexOf(tab) + by + all.length) % all.length];
      choose(next);
      next.focus();
    });
  }
  state.watch(["tab"], ({ tab }) => {
    for (const t of all) {
      const on = t.dataset.tab === tab;
      t.setAttribute("aria-selected", String(on));
      t.tabIndex = on ? 0 : -1;
      $(`panel-${t.dataset.tab}`).hidden = !on;
    }
    if (tab === "charts") charts.shown();
  });
}

/* --- the stage's tools -------------------------------------------------------------------- */

function viewButtons(view) {
  const host = $("views");
  for (const [name, key] of [["iso", 1], ["front", 2], ["right", 3], ["top", 4], ["left", 5], ["back", 6]]) {
    host.append(h("button", { type: "button", title: `View: ${name} (${key})`, onclick: () => view.look(name) },
      name[0].toUpperCase() + name.slice(1)));
  }
  host.append(iconButton("fit", "Show all (F)", () => view.look(null)));
}

function tools(view, state) {
  const host = $("tools");
  const measure = iconButton("measure", "Measure between two points (M)",
    () => state.set({ tool: state.get("tool") === "measure" ? null : "measure" }));
  const cut = iconButton("section", "Section plane (X)", () => state.set({ cut: state.get("cut") === null ? 0 : null }));
  host.append(measure, cut);
  const place = h("input", { type: "range", min: 0, max: 1, step: 0.002, value: 0.5, "aria-label": "Place of the section",
    oninput: () => state.set({ cutAt: Number(place.value) }) });
  const axis = h("select", { "aria-label": "Axis across the section", onchange: () => state.set({ cut: Number(axis.value) }) },
    ...["x", "y", "z"].map((name, i) => h("option", { value: i }, `across ${name}`)));
  const flip = h("button", { type: "button", onclick: () => state.set({ flip: !state.get("flip") }) }, "Flip");
  const panel = h("div.tool-panel", { hidden: true }, axis, place, flip);
  const hint = h("div.tool-panel", { hidden: true });
  host.after(h("div", { id: "tool-panels" }, panel, hint));
  state.watch(["cut", "cutAt", "flip"], ({ cut, cutAt, flip: other }) => {
    cut === null || (axis.value = cut);
    panel.hidden = cut === null;
    host.children[1].setAttribute("aria-pressed", String(cut !== null));
    view.stage.section(cut, cutAt, other);
  });
  view.onmeasure = (length, d, picked = 0) => {
    const on = state.get("tool") === "measure", numbers = view.data.runs.every((run) => run.ok);
    hint.hidden = !on;
    if (length !== null) {
      const mm = (x) => `${(1000 * x).toFixed(1).replace("-", "−")}`;
      const text = numbers ? `${mm(length)} mm` : "no numbers: the run failed";
      view.label.textContent = text;
      hint.textContent = numbers ? `${text}   (x ${mm(d.x)}, y ${mm(d.y)}, z ${mm(d.z)})` : text;
    } else hint.textContent = picked ? "Pick the second point." : "Pick two points on wires or obstacles.";
  };
  state.watch(["tool"], ({ tool }) => {
    measure.setAttribute("aria-pressed", String(tool === "measure"));
    view.host.classList.toggle("measuring", tool === "measure");
    view.forgetMeasure();
  });
}

function menu(view, data, state, span) {
  const host = $("menu"), list = h("div.menu-list", { role: "menu", hidden: true });
  const open = h("button.text-button", { type: "button", "aria-haspopup": "menu", "aria-expanded": "false",
    onclick: () => toggle(list.hidden) }, icon("share"), h("span.wide", {}, "Export"));
  const toggle = (on) => {
    list.hidden = !on;
    open.setAttribute("aria-expanded", String(on));
    if (on) list.querySelector("button")?.focus();
  };
  const item = (words, action) => list.append(h("button", { type: "button", role: "menuitem",
    onclick: () => { toggle(false); action(); } }, words));
  if (view) item("Picture (PNG)", () => savePicture(view, data, state, view.colouring()));
  if (data.runs.some((run) => run.series)) item("Series (CSV)", () => saveTable(data));
  if (view && !data.live) item("Film (WebM)", () => { say("Recording: the run is played once."); saveFilm(view, data, state, span, say); });
  if (!data.live) item("Link to this moment", () => {
    history.replaceState(null, "", linkOf(state, view));
    navigator.clipboard?.writeText(location.href).then(() => say("The link is copied."), () => say("The link is in the address line."));
  });
  host.append(open, list);
  document.addEventListener("click", (e) => { if (!host.contains(e.target)) toggle(false); });
  host.addEventListener("keydown", (e) => {
    if (e.key !== "Escape" || list.hidden) return;
    e.stopPropagation();
    toggle(false);
    open.focus();
  });
}

/* --- keys ----------------------------------------------------------------------------------- */

const KEYS = [["Space", "play, pause"], ["← →", "one frame back, on; with shift ten"], ["Home End", "start, end"],
  ["+ −", "faster, slower"], ["L", "repeat"], ["1 … 6", "iso, front, right, top, left, back"], ["F", "show all"],
  ["W A S D", "turn the view"], ["Q E", "nearer, farther"], ["C", "next quantity"], ["V", "forces"], ["M", "measure"],
  ["X", "section plane"], ["[ ]", "hide objects, charts"], ["T", "dark, light"], ["?", "these keys"]];

const LIVE_KEYS = [["Space", "hold the run, go on"], ["→", "one step"], ["← →", "look back, frame by frame"], ["End", "to the present"],
  ["+ −", "faster, slower"], ["K", "keep this state"], ["H", "pull wires and lead grippers, or only turn the view"]];

function keys(state, transport, view, data, more = {}) {
  const help = $("help");
  const quantities = [null, ...knownQuantities(data, "all", 0, null).map((q) => q.key)];
  const flip = (key) => state.set({ [key]: !state.get(key) });
  const actions = {
    " ": () => flip("playing"), ArrowLeft: (e) => transport.step(e.shiftKey ? -10 : -1),
    ArrowRight: (e) => transport.step(e.shiftKey ? 10 : 1), Home: () => transport.go(transport.span[0]),
    End: () => transport.go(transport.span[1]), "+": () => transport.faster(1), "=": () => transport.faster(1),
    "-": () => transport.faster(-1), l: () => flip("loop"), t: () => state.set({ theme: state.get("theme") === "dark" ? "light" : "dark" }),
    "[": () => flip("left"), "]": () => flip("right"), "?": () => (help.open ? help.close() : help.showModal()),
    Escape: () => state.set({ tool: null, probe: null, selected: null }),
  };
  if (view) {
    ["iso", "front", "right", "top", "left", "back"].forEach((name, i) => { actions[i + 1] = () => view.look(name); });
    Object.assign(actions, { f: () => view.look(null), v: () => flip("arrows"),
      m: () => state.set({ tool: state.get("tool") === "measure" ? null : "measure" }),
      x: () => state.set({ cut: state.get("cut") === null ? 0 : null }),
      c: () => state.set({ custom: null, quantity: quantities[(quantities.indexOf(state.get("quantity")) + 1) % quantities.length] }),
      a: () => view.stage.turn(-0.12, 0), d: () => view.stage.turn(0.12, 0), w: () => view.stage.turn(0, -0.1),
      s: () => view.stage.turn(0, 0.1), q: () => view.stage.zoom(0.9), e: () => view.stage.zoom(1.11) });
  }
  Object.assign(actions, more);
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || help.open) return;
    const { target } = e, typing = target.matches("input:not([type=range]):not([type=checkbox]), select, textarea");
    if (typing || (target.matches("input[type=range]") && target.id !== "time" && /^(Arrow|Home|End)/.test(e.key))) return;
    if (e.key === " " && target.matches("button, input[type=checkbox], a")) return;
    const action = actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (!action) return;
    e.preventDefault();
    action(e);
  });
  const list = $("keys");
  const known = data.live ? [...LIVE_KEYS, ...KEYS.slice(KEYS.findIndex(([key]) => key === "1 … 6"))] : KEYS;
  for (const [key, words] of known) list.append(h("dt", {}, ...key.split(" ").map((k) => h("kbd", {}, k))), h("dd", {}, words));
  $("help-button").append(icon("help"));
  $("help-button").addEventListener("click", () => help.showModal());
  $("help-close").append(icon("close"));
  $("help-close").addEventListener("click", () => help.close());
}

/* --- frame of the page ---------------------------------------------------------------------- */

function header(data, state) {
  const failed = data.runs.filter((run) => !run.ok);
  $("title").textContent = data.title;
  $("status").textContent = failed.length ? "FAILED" : data.runs.some((run) => run.unmet) ? "not as exact as asked" : "ok";
  $("status").className = `badge ${failed.length ? "bad" : data.runs.some((run) => run.unmet) ? "warn" : "good"}`;
  if (data.check) {
    const mark = badge(data.check.verdict);
    $("status").textContent = mark.textContent;
    $("status").className = mark.className;
    document.body.classList.add("checked");
  }
  for (const run of failed) {
    $("banner").append(h("p", {}, h("strong", {}, h("bdi", {}, run.name), " failed. "), run.reason || "No reason is given."));
  }
  $("banner").hidden = !failed.length;
  document.body.classList.toggle("failed", failed.length > 0);
  const notes = data.runs.flatMap((run) => [
    run.film.broken ? `${run.film.broken} frames of ${run.name} have places that are no numbers; they are left out.` : null,
    run.film.thinned > 1 ? `Of the frames of ${run.name} one of ${run.film.thinned} was kept.` : null]).filter(Boolean);
  $("notes").textContent = notes.join(" ");
  $("notes").hidden = !notes.length;
  frame(state);
}

/** Theme, and the sides that can be hidden. */
function frame(state) {
  const button = $("theme");
  button.addEventListener("click", () => state.set({ theme: state.get("theme") === "dark" ? "light" : "dark" }));
  const side = (id, key) => {
    $(id).addEventListener("click", () => state.set({ [key]: !state.get(key) }));
    $(id).append(icon(key === "left" ? "tree" : "panel"));
  };
  side("left-button", "left");
  side("right-button", "right");
  state.watch(["left", "right"], ({ left, right }) => {
    document.body.classList.toggle("no-left", !left);
    document.body.classList.toggle("no-right", !right);
    $("left-button").setAttribute("aria-pressed", String(left));
    $("right-button").setAttribute("aria-pressed", String(right));
  });
  state.watch(["theme"], ({ theme }) => {
    document.documentElement.dataset.theme = theme;
    button.replaceChildren(icon(theme === "dark" ? "sun" : "moon"));
    try { localStorage.setItem("softworld.theme", theme); } catch { /* not kept from a file in some browsers */ }
  });
}

function firstTheme() {
  let kept = null;
  try { kept = localStorage.getItem("softworld.theme"); } catch { /* as above */ }
  return kept === "dark" || kept === "light" ? kept : matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/** Thin wires are drawn thicker at first, so that they can be seen. */
function thicken(view, state) {
  state.set({ thick: Math.min(10, Math.max(1, Math.round((2 * view.stage.size) / 420 / view.radius) / 2)) });
}

function openView(data, state, span) {
  if (!data.runs.some((run) => run.film.times.length)) {
    document.body.classList.add("no-frames");
    $("stage").append(h("p.empty", {}, "No frames were stored in this run: there are charts and numbers only."));
    return null;
  }
  try {
    const view = new View($("stage"), data, state);
    const legend = new Legend($("stage"), state), card = new ProbeCard($("stage"), view, state);
    view.onupdate = (look) => legend.show(look);
    view.onprobe = (actor, at, probe) => card.show(actor, at, probe);
    state.watch(["selected"], () => view.updateProbe());
    state.watch(["theme"], ({ theme }) => view.paint(THEMES[theme]));
    state.set({ shadows: !view.stage.isSoftware() });
    state.watch(["shadows"], ({ shadows }) => view.stage.shadows(shadows));
    viewButtons(view);
    compass($("stage"), view.stage);
    tools(view, state);
    endTree = objectTree($("objects"), view, data, state);
    thicken(view, state);
    view.update();
    return view;
  } catch (error) {
    console.warn(error);
    document.body.classList.add("no-frames");
    $("stage").replaceChildren(h("p.empty", {}, "This browser gives no WebGL: there are charts and numbers only."));
    return null;
  }
}

const usual = (data) => ({ playing: false, speed: 1, loop: false, theme: firstTheme(), left: true, right: true, range: "all",
  custom: null, thick: 1, arrows: false, ways: true, glass: false, shadows: true, hidden: new Set(), selected: null, probe: null,
  tool: null, cut: null, cutAt: 0.5, flip: false, quantity: data.runs.length === 1 && knownQuantities(data, "all", 0, null)[0]?.key || null });

let endTree = null; // of the tree of objects that is shown

/** What the live page takes of the player. */
const shared = {
  say, frame,
  openView: (data, state) => openView(data, state),
  newState: (data, more) => new State({ ...usual(data), ...more }),
  renew(view, data, state, fit) {
    if (fit && view.refit()) thicken(view, state);
    view.renew();
    $("objects").replaceChildren();
    endTree?.();
    endTree = objectTree($("objects"), view, data, state);
  },
  finish(data, state, view, transport, more) {
    $("title").textContent = data.title;
    if (view) view.stage.draw();
    lookPanel($("look"), data, state);
    tabs(state, { shown() {} });
    menu(view, data, state, null);
    keys(state, transport, view, data, more);
    document.body.dataset.picture = document.body.dataset.ready = String(Math.round(performance.now()));
    document.body.classList.add("ready", "live");
  },
};

async function start() {
  if (!window.DecompressionStream) throw new Error("this browser is too old: it knows no DecompressionStream");
  const data = await load();
  if (!data.check) for (const name of ["tab", "panel"]) $(`${name}-check`).remove();
  if (data.live) {
    await startLive(data, shared);
    return;
  }
  for (const name of ["live", "build"]) {
    $(`tab-${name}`).remove();
    $(`panel-${name}`).remove();
  }
  const span = spanOf(data), given = readLink(location.hash);
  const known = knownQuantities(data, "all", 0, null).map((q) => q.key);
  const state = new State({ ...usual(data), time: span[0], tab: data.check ? "check" : data.runs.every((run) => run.series) ? "charts" : "results",
    left: !data.check });
  if (known.includes(given.quantity)) state.set({ quantity: given.quantity });
  header(data, state);
  const transport = new Transport($("transport"), data, state, span, frameTimes(data));
  const view = openView(data, state, span);
  if (view) { // the scene first, charts when there is time
    view.stage.draw();
    document.body.dataset.picture = String(Math.round(performance.now()));
    await new Promise((resolve) => { setTimeout(resolve, 0); });
  }
  lookPanel($("look"), data, state);
  const check = data.check ? new CheckPanel($("panel-check"), data, state, view, span) : null;
  const charts = new Charts($("panel-charts"), data, state);
  resultsPanel($("panel-results"), data, state);
  eventsPanel($("panel-events"), data, state);
  scriptPanel($("panel-script"), data);
  tabs(state, charts);
  menu(view, data, state, span);
  keys(state, transport, view, data);
  new ResizeObserver(() => { if (state.get("tab") === "charts") charts.shown(); }).observe($("panel-charts"));
  const follow = ({ time, camera, row }) => {
    if (time !== undefined) state.set({ time: Math.min(span[1], Math.max(span[0], time)), playing: false });
    if (camera && view) view.stage.setPose(camera);
    if (row !== undefined) check?.go(row);
  };
  if (check) state.watch(["theme"], () => check.draw());
  if (given.time === undefined && given.row === undefined) check?.begin();
  follow(given);
  addEventListener("hashchange", () => follow(readLink(location.hash)));
  window.player = { state, view, charts, transport, data, check };
  document.body.dataset.ready = String(Math.round(performance.now()));
  document.body.classList.add("ready");
}

start().catch((error) => {
  document.body.classList.add("ready");
  $("banner").hidden = false;
  $("banner").textContent = `This page cannot be shown: ${error.message}`;
  console.error(error);
});
