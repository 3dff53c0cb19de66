// SPDX-License-Identifier: GPL-3.0-or-later
// Out of the page: picture, table, film, link.
import { download } from "./dom.js";

const safe = (name) => name.replace(/[^\w.-]+/g, "_").slice(0, 60) || "run";

/** The stage with title, time and legend, on a canvas of its own. */
function composed(view, data, state, look, target) {
  const from = view.stage.canvas, k = from.width / Math.max(1, view.host.clientWidth);
  const canvas = target || document.createElement("canvas");
  canvas.width = from.width;
  canvas.height = from.height;
  view.stage.draw();
  const c = canvas.getContext("2d"), styles = getComputedStyle(document.documentElement);
  c.drawImage(from, 0, 0);
  const ink = styles.getPropertyValue("--ink").trim(), font = (size, weight = 400) => `${weight} ${size * k}px system-ui, sans-serif`;
  c.fillStyle = ink;
  c.textBaseline = "top";
  c.font = font(15, 600);
  c.fillText(data.title, 18 * k, 16 * k);
  c.font = font(13);
  c.fillText(`t = ${state.get("time").toFixed(3)} s`, 18 * k, 38 * k);
  if (data.runs.some((run) => !run.ok)) {
    c.fillStyle = styles.getPropertyValue("--bad").trim();
    c.font = font(15, 700);
    c.fillText("FAILED RUN", 18 * k, 58 * k);
  }
  if (look.quantity) {
    const w = 190 * k, x = 18 * k, y = canvas.height - 40 * k;
    const fill = c.createLinearGradient(x, 0, x + w, 0);
    look.scale.stops.forEach((stop, i) => fill.addColorStop(i / (look.scale.stops.length - 1), stop));
    c.fillStyle = fill;
    c.fillRect(x, y, w, 9 * k);
    c.fillStyle = ink;
    c.font = font(12);
    c.fillText(`${look.quantity.label} [${look.quantity.unit}]`, x, y - 19 * k);
    c.fillText(Number(look.scale.low.toPrecision(4)), x, y + 13 * k);
    c.textAlign = "right";
    c.fillText(Number(look.scale.high.toPrecision(4)), x + w, y + 13 * k);
    c.textAlign = "left";
  }
  return canvas;
}

export function savePicture(view, data, state, look) {
  composed(view, data, state, look).toBlob((blob) => download(blob, `${safe(data.title)}.png`), "image/png");
}

/** A text as a cell, as softworld.output.sink writes it: a spreadsheet computes what begins like a formula, unless ' is in front. */
function cell(name) {
  let text = name.replace(/[\u0000-\u001f\u007f]/g, " ");
  if (/^\s*[=+@-]./.test(text)) text = `'${text}`;
  return /[",;#]|^\s|\s$/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** All series as CSV text: of one run its columns, of several one table after the other. */
export function tableText(data) {
  const parts = [];
  for (const run of data.runs) {
    if (!run.series) continue;
    const { time, columns } = run.series;
    const lines = [["t [s]", ...columns.map((c) => cell(c.unit ? `${c.name} [${c.unit}]` : c.name))].join(",")];
    for (let i = 0; i < time.length; i++) {
      const row = [time[i]];
      for (const c of columns) {
        const x = c.values[i];
        row.push(Number.isNaN(x) ? "nan" : Number.isFinite(x) ? Number(x.toPrecision(8)) : x > 0 ? "inf" : "-inf");
      }
      lines.push(row.join(","));
    }
    parts.push((data.runs.length > 1 ? `# ${run.name.replace(/[\u0000-\u001f\u007f]/g, " ")}\n` : "") + lines.join("\n"));
  }
  return `${parts.join("\n\n")}\n`;
}

export function saveTable(data) { download(tableText(data), `${safe(data.title)}.csv`, "text/csv"); }

/** Play from start to end once, recorded. done(message) when it is over. */
export function saveFilm(view, data, state, span, done) {
  if (!window.MediaRecorder || !HTMLCanvasElement.prototype.captureStream) {
    done("This browser cannot record films.");
    return null;
  }
  const target = document.createElement("canvas");
  composed(view, data, state, view.colouring(), target);
  const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((t) => MediaRecorder.isTypeSupported(t));
  const recorder = new MediaRecorder(target.captureStream(30), { mimeType: type, videoBitsPerSecond: 8e6 });
  const chunks = [], copy = () => composed(view, data, state, view.colouring(), target);
  const timer = setInterval(copy, 33);
  recorder.ondataavailable = (e) => chunks.push(e.data);
  recorder.onstop = () => {
    clearInterval(timer);
    download(new Blob(chunks, { type: "video/webm" }), `${safe(data.title)}.webm`);
    done("The film is saved.");
  };
  const loop = state.get("loop");
  recorder.start();
  state.set({ loop: false, time: span[0], playing: true });
  const wait = setInterval(() => {
    if (state.get("playing")) return;
    clearInterval(wait);
    copy();
    state.set({ loop });
    setTimeout(() => recorder.stop(), 200);
  }, 50);
  return recorder;
}

/** The page's address with time and camera. */
export function linkOf(state, view) {
  const t = Number(state.get("time").toPrecision(6));
  const camera = view ? `&camera=${view.stage.pose().map((x) => Number(x.toPrecision(5))).join(",")}` : "";
  const q = state.get("quantity");
  return `#t=${t}${camera}${q ? `&colour=${q}` : ""}`;
}

/** What an address says: { time, camera, quantity }. */
export function readLink(hash) {
  const given = new URLSearchParams(hash.replace(/^#/, "")), out = {};
  const t = Number(given.get("t"));
  if (given.has("t") && Number.isFinite(t)) out.time = t;
  const camera = (given.get("camera") || "").split(",").map(Number);
  if (camera.length === 6 && camera.every(Number.isFinite)) out.camera = camera;
  if (/^\d+$/.test(given.get("row") || "")) out.row = Number(given.get("row"));
  if (given.has("colour")) out.quantity = given.get("colour");
  return out;
}
