// The skeleton viewer in JupyterLab (an anywidget) and on pages without a kernel. A page gets this module and
// all that it imports as one, from ../bundle.py.

import { bytesOf, unpacked } from "./data.js";
import { make } from "./dom.js";
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

/** The data of a viewer: those in the page, or those of a script that the page names and that is fetched now. */
async function dataOf(root) {
  const { textContent, dataset: { from, name } } = root.querySelector("script[type='application/json']");
  if (!from) return JSON.parse(textContent);
  await new Promise((fetched, failed) => {
    const script = make("script", { src: from });
    script.onload = fetched;
    script.onerror = () => failed(new Error(`${from} is not there`));
    document.head.append(script);
  });
  return globalThis.pslData[name];
}

/** Mount every viewer of a page that holds its data. Data far down the page wait until the reader comes near. */
function mount(page = document) {
  const near = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
    if (!isIntersecting) return;
    near.unobserve(target);
    dataOf(target).then((data) => render({ model: new PageModel(data), el: target }))
      .catch((error) => { target.dataset.error = String(error); console.warn("skeleton viewer:", error); });
  }), { rootMargin: "600px" });
  page.querySelectorAll(".psl-viewer").forEach((root) => {
    if (root.querySelector("script[type='application/json']") && !root.dataset.found) { root.dataset.found = "true"; near.observe(root); }
  });
}

if (typeof document !== "undefined") {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => mount());
  else mount();
}

export default { render };
