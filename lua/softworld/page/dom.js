// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page. Text is only ever set as text: names cannot become markup.

/** h("button.icon", { title: "Play", onclick: f }, children...) */
export function h(name, properties = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const element = document.createElement(tag || "div");
  if (classes.length) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "style") Object.assign(element.style, value);
    else if (key in element && key !== "list" && !key.startsWith("aria")) element[key] = value;
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined && c !== false));
  return element;
}

const SHAPES = {
  play: "M7 4.5v15l12-7.5z", pause: "M7 5h3.5v14H7zM13.5 5H17v14h-3.5z",
  next: "M6 5v14l9-7zM16 5h2.5v14H16z", previous: "M18 5v14l-9-7zM5.5 5H8v14H5.5z",
  first: "M19 5v14l-7-7zM12 5v14l-7-7zM4 5h1.5v14H4z", last: "M5 5v14l7-7zM12 5v14l7-7zM18.5 5H20v14h-1.5z",
};
const LINES = {
  loop: "M17 3l3 3-3 3M4 11V9a3 3 0 0 1 3-3h13M7 21l-3-3 3-3M20 13v2a3 3 0 0 1-3 3H4",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5", eye: "M2 12s3.6-6 10-6 10 6 10 6-3.6 6-10 6-10-6-10-6z M12 9.5a2.5 2.5 0 1 1 0 5a2.5 2.5 0 0 1 0-5",
  measure: "M3 16L16 3l5 5L8 21zM7 12l2 2M10 9l2.5 2.5M13 6l2 2", section: "M4 4h7v16H4zM15 4v16M19 4v2M19 10v4M19 18v2",
  sun: "M12 7.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 0 1 0-9M12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.4 1.4M17.6 17.6L19 19M5 19l1.4-1.4M17.6 6.4L19 5",
  moon: "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.500 10.500z", share: "M12 15V3M8 7l4-4 4 4M5 13v6a2 2 0 0 0 2 2h10a2 2 0 0 0 2-2v-6",
  help: "M9 9a3 3 0 1 1 4.200 2.700c-.8.4-1.200 1-1.200 1.800v.5M12 17.500v.5", close: "M6 6l12 12M18 6L6 18",
  hand: "M8 12V6.500a1.500 1.500 0 0 1 3 0V11M11 10.500V5a1.500 1.500 0 0 1 3 0v5.500M14 10.500V6.500a1.500 1.500 0 0 1 3 0V14c0 4-2 6.500-5.500 6.500-3 0-4.200-1.500-5.700-4.200L4.300 13.600c-.6-1.100.9-2.300 1.900-1.300L8 14",
  keep: "M6 4h12v16l-6-4-6 4z", back: "M9 14L4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3", redo: "M15 14l5-5-5-5M20 9H10a6 6 0 0 0 0 12h3", plus: "M12 5v14M5 12h14", up: "M6 14l6-6 6 6", down: "M6 10l6 6 6-6", stop: "M6.500 6.500h11v11h-11z",
  panel: "M4 5h16v14H4zM15 5v14", tree: "M4 5h16v14H4zM9 5v14", arrow: "M5 19L19 5M10 5h9v9",
};

/** A small picture for a button. */
export function icon(name) {
  const NS = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(NS, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(NS, "path");
  path.setAttribute("d", SHAPES[name] || LINES[name]);
  svg.setAttribute("class", SHAPES[name] ? "icon solid" : "icon");
  svg.append(path);
  return svg;
}

/** A button with a picture; words are its label and its tip. */
export function iconButton(name, words, onclick, more = {}) {
  return h("button.icon-button", { type: "button", title: words, "aria-label": words, onclick, ...more },
    icon(name));
}

/** Let the user save bytes or text as a file. */
export function download(content, name, type) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
