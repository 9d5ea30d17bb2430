// The skeleton viewer in JupyterLab (an anywidget) and on pages without a kernel. A page gets this module and
// all that it imports as one, from ../bundle.py.

import { bytesOf, unpacked } from "./data.js";
import { make, whenNear } from "./dom.js";
import { renderer } from "./gl.js";
import { Scene } from "./scene.js";
import { STYLE } from "./style.js";
import { Viewer } from "./viewer.js";

/** Whether this browser can show the viewer at all. */
function able() {
  if (typeof DecompressionStream === "undefined") return false;
  try { return Boolean(renderer()); } catch { return false; }
}

function styled() {
  if (document.getElementById("psl-style")) return;
  document.head.append(make("style", { id: "psl-style" }, STYLE));
}

async function render({ model, el }) {
  const root = el.classList.contains("psl-viewer") ? el : el.appendChild(make("div", { class: "psl-viewer" }));
  if (!able()) {
    if (root === el) return undefined;
    root.innerHTML = model.get("strip") ?? "";
    root.append(make("p", {}, "This browser has no WebGL2, so the picture cannot be moved."));
    return undefined;
  }
  styled();
  const header = model.get("scene"), blob = model.get("blob");
  const bytes = typeof blob === "string" ? bytesOf(blob) : new Uint8Array(blob.buffer, blob.byteOffset, blob.byteLength);
  const buffer = await unpacked(bytes);
  const scenes = header.variants.map((variant) => new Scene(buffer, variant, header.dimension));
  root.querySelectorAll(".psl-strip").forEach((strip) => strip.remove());
  const viewer = new Viewer(model, root, scenes);
  return () => viewer.close();
}

/** Stands in for the model of a kernel on a page that has none. */
class PageModel {
  constructor(data) { this.data = data; this.heard = {}; }
  get(name) { return this.data[name]; }
  set(name, value) { this.data[name] = value; (this.heard[`change:${name}`] ?? []).forEach((f) => f()); }
  on(name, f) { (this.heard[name] ??= []).push(f); }
  off(name, f) { this.heard[name] = (this.heard[name] ?? []).filter((g) => g !== f); }
  save_changes() {}
}

/** Mount every viewer of a page that holds its data. */
function mount(page = document) {
  const holding = (root) => root.querySelector("script[type='application/json']") && !root.dataset.found;
  const roots = [...page.querySelectorAll(".psl-viewer")].filter(holding);
  for (const root of roots) root.dataset.found = "true";
  whenNear(roots, (root, data) => render({ model: new PageModel(data), el: root }));
}

if (typeof document !== "undefined") {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => mount());
  else mount();
}

export default { render };
