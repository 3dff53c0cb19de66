// SPDX-License-Identifier: GPL-3.0-or-later
// Time: play, step, slider with marks of events, speed, loop; and the keys for all of it.
import { h, icon, iconButton } from "./dom.js";

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8];

export class Transport {
  constructor(host, data, state, span, times) {
    Object.assign(this, { data, state, span, times });
    this.play = iconButton("play", "Play (space)", () => state.set({ playing: !state.get("playing") }));
    this.play.classList.add("primary");
    this.slider = h("input.slider", { type: "range", min: span[0], max: span[1], step: "any", value: span[0],
      "aria-label": "Time", oninput: () => state.set({ time: Number(this.slider.value), playing: false }) });
    this.slider.id = "time";
    this.marks = h("div.marks");
    this.clock = h("output.clock", { "aria-live": "off" });
    this.speed = h("select", { "aria-label": "Speed", title: "Speed",
      onchange: () => state.set({ speed: Number(this.speed.value) }) },
    ...SPEEDS.map((s) => h("option", { value: s, selected: s === 1 }, `${s} ×`)));
    this.loop = iconButton("loop", "Repeat (L)", () => state.set({ loop: !state.get("loop") }));
    host.append(
      h("div.buttons", {},
        iconButton("first", "To the start (Home)", () => this.go(span[0])),
        iconButton("previous", "One frame back (left arrow)", () => this.step(-1)), this.play,
        iconButton("next", "One frame on (right arrow)", () => this.step(1)),
        iconButton("last", "To the end (End)", () => this.go(span[1]))),
      h("div.track", {}, this.marks, this.slider), this.clock, this.speed, this.loop);
    this.addMarks();
    this.slider.addEventListener("keydown", (e) => {
      if (/^(Arrow|Page|Home|End)/.test(e.key)) e.preventDefault(); // the page's own keys
    });
    this.watch();
  }

  addMarks() {
    const [from, to] = this.span, several = this.data.runs.length > 1;
    for (const run of this.data.runs) {
      for (const e of run.events) {
        if (!(e.time >= from && e.time <= to)) continue;
        const words = `${several ? `${run.name}: ` : ""}t = ${Number(e.time.toPrecision(4))} s: ${e.text}`;
        this.marks.append(h("button.mark", { type: "button", title: words, "aria-label": words, tabIndex: -1,
          style: { left: `${(100 * (e.time - from)) / (to - from)}%` }, onclick: () => this.go(e.time) }));
      }
      if (!run.ok) {
        const left = (100 * (Math.min(to, Math.max(from, run.time)) - from)) / (to - from);
        this.marks.append(h("span.mark.failed", { title: `${run.name} failed here`, style: { left: `${left}%` } }));
      }
    }
  }

  go(time) { this.state.set({ time, playing: false }); }

  step(by) {
    const { times } = this, now = this.state.get("time");
    if (!times.length) return;
    let i = times.findIndex((t) => t > now + 1e-9); // the first one after now
    if (i < 0) i = times.length;
    const at = i > 0 && Math.abs(times[i - 1] - now) < 1e-9 ? i - 1 : null;
    const next = at !== null ? at + by : by > 0 ? i + by - 1 : i + by;
    this.go(times[Math.max(0, Math.min(times.length - 1, next))]);
  }

  watch() {
    const digits = Math.max(2, Math.min(6, 3 - Math.floor(Math.log10(this.span[1] - this.span[0]))));
    this.state.watch(["time"], ({ time }) => {
      this.slider.value = time;
      const part = (time - this.span[0]) / (this.span[1] - this.span[0]);
      this.slider.style.setProperty("--part", `${100 * part}%`);
      const text = `${time.toFixed(digits)} s`;
      this.slider.setAttribute("aria-valuetext", text);
      this.clock.textContent = `${text} / ${this.span[1].toFixed(digits)} s`;
    });
    this.state.watch(["playing"], ({ playing }) => {
      this.play.replaceChildren(icon(playing ? "pause" : "play"));
      this.play.title = playing ? "Pause (space)" : "Play (space)";
      this.play.setAttribute("aria-label", this.play.title);
      if (playing) this.run();
    });
    this.state.watch(["speed"], ({ speed }) => { this.speed.value = speed; });
    this.state.watch(["loop"], ({ loop }) => this.loop.setAttribute("aria-pressed", String(loop)));
  }

  /** Go on with the clock until somebody stops it. */
  run() {
    const [from, to] = this.span;
    if (this.state.get("time") >= to - 1e-9) this.state.set({ time: from });
    let before = performance.now();
    const tick = (now) => {
      const { playing, time, speed, loop } = this.state.values;
      if (!playing) return;
      let next = time + (Math.min(250, now - before) / 1000) * speed;
      before = now;
      if (next >= to) {
        if (loop) next = from;
        else {
          this.state.set({ time: to, playing: false });
          return;
        }
      }
      this.state.set({ time: next });
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  faster(by) {
    const i = SPEEDS.indexOf(this.state.get("speed"));
    this.state.set({ speed: SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, i + by))] });
  }
}
