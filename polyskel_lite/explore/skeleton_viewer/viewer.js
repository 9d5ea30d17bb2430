// A viewer: its parts, its state, and when it draws.

import { Camera, PI } from "./camera.js";
import { Controls } from "./controls.js";
import { make, ownName } from "./dom.js";
import { Buffers, renderer } from "./gl.js";
import { howTo, obey } from "./hand.js";
import { LEVELS, Picture } from "./picture.js";
import { followTheme, palette } from "./theme.js";
import { multiple } from "./threshold.js";

const PLURALS = { vertex: "vertices", branch: "branches", cavity: "cavities" };
const many = (n, word) => `${n.toLocaleString("en")} ${n === 1 ? word : PLURALS[word] ?? `${word}s`}`;

export class Viewer {
  constructor(model, element, scenes) {
    Object.assign(this, { model, element, scenes });
    this.header = model.get("scene");
    this.dimension = this.header.dimension;
    this.id = ownName();
    this.camera = new Camera(this.dimension, this.header.low, this.header.high, this.header.view);
    this.frames = 0;
    this.cost = []; // milliseconds of the last picture of each level
    this.gone = [];
    this.build();
    this.follow();
    this.update();
  }

  /** What the model says; the threshold is that of the strategy shown, for each has its own (none: null there). */
  get(name) {
    if (name !== "threshold") return this.model.get(name);
    const threshold = this.model.get("thresholds")?.[this.filter.label];
    return threshold === null ? -Infinity : threshold ?? 0;
  }

  set(name, value) {
    if (this.get(name) === value) return;
    if (name !== "threshold") this.model.set(name, value);
    else this.model.set("thresholds", { ...this.model.get("thresholds"), [this.filter.label]: value === -Infinity ? null : value });
    clearTimeout(this.saving);
    this.saving = setTimeout(() => this.model.save_changes(), 40);
  }

  get sceneNow() { return this.scenes.find((s) => s.label === this.get("variant")) ?? this.scenes[0]; }

  get filter() {
    const { hierarchies } = this.sceneNow;
    return hierarchies.find((h) => h.label === this.get("strategy")) ?? hierarchies[0];
  }

  get palette() { return palette(this.element, this.header.colors, this.scenes.some((s) => s.surface)); }

  build() {
    const { header, id, dimension, element } = this;
    this.canvas = make("canvas", {
      tabindex: "0", role: "application", "aria-roledescription": "interactive picture", "aria-label": header.alt,
      "aria-describedby": `${id}-hint`,
    });
    this.stage = make("div", { class: "psl-stage", style: `height:${header.height}px` }, this.canvas);
    this.status = make("p", { class: "psl-status", "aria-hidden": "true" });
    this.heard = make("p", { class: "psl-only-heard", role: "status", "aria-live": "polite" });
    this.controls = new Controls(this);
    element.classList.add("psl");
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", header.name);
    element.append(this.stage);
    if (header.look) element.append(make("p", { class: "psl-look" }, header.look));
    element.append(this.status, this.heard, this.controls.root);
    element.append(make("p", { class: "psl-hint", id: `${id}-hint` }, `${howTo(dimension === 3)} Branches are counted by their free ends.`));
    // JupyterLab's shortcuts would keep arrow keys and letters from the part that has the focus.
    for (const part of element.querySelectorAll("canvas, input, select, button, summary")) part.dataset.lmSuppressShortcuts = "true";
    obey(this.canvas, this.camera, dimension === 3, () => this.draw());
    const sizes = new ResizeObserver(() => this.draw());
    sizes.observe(this.stage);
    const inSight = new IntersectionObserver((entries) => {
      this.seen = entries[entries.length - 1].isIntersecting;
      if (this.seen) this.draw(); else this.rest();
    }, { rootMargin: "300px" });
    inSight.observe(this.stage);
    this.gone.push(() => sizes.disconnect(), () => inSight.disconnect(), followTheme(() => this.draw()));
  }

  follow() {
    const names = ["thresholds", "strategy", "variant", "opacity", "simplified", "color", "samples", "vertices", "edges", "polygons"];
    const changed = () => this.update();
    for (const name of names) {
      this.model.on(`change:${name}`, changed);
      this.gone.push(() => this.model.off(`change:${name}`, changed));
    }
  }

  // ------------------------------------------------------------ state

  update() {
    const { filter } = this, threshold = this.get("threshold");
    this.cut = filter.cut(threshold);
    this.shapeCut = Math.round(this.get("simplified") * this.cut);
    if (this.counted?.filter !== filter || this.counted.cut !== this.cut) {
      this.counted = { filter, cut: this.cut, ...filter.counts(this.cut) };
    }
    this.controls.refresh();
    const { vertices, edges, polygons, branches } = this.counted, { betti } = filter.header;
    const data = { threshold, strategy: filter.label, variant: this.sceneNow.label, vertices, edges, polygons, branches,
      betti: betti ? betti.join(",") : "", ready: true };
    for (const [key, value] of Object.entries(data)) this.element.dataset[key] = String(value);
    this.tell();
    this.draw();
  }

  /** The line of numbers: seen at once, read aloud when the hand rests. */
  tell() {
    const { betti } = this.filter.header, threshold = this.get("threshold"), filters = this.header.filters;
    const kinds = { vertex: "vertices", edge: "edges", ...(this.dimension === 3 && { polygon: "polygons" }), branch: "branches" };
    const parts = Object.entries(kinds).map(([word, name]) => many(this.counted[name], word));
    const head = !filters ? "" : threshold === -Infinity ? "Nothing removed: " : `Threshold ${multiple(threshold)}: `;
    let text = `${head}${parts.join(", ")}.`;
    if (betti) {
      const words = betti.map((b, k) => many(b, ["piece", "loop", "cavity"][k])).join(", ");
      text += ` Betti numbers ${betti.join(", ")}: ${words}${filters ? ", whatever the threshold" : ""}.`;
    }
    this.status.textContent = text;
    clearTimeout(this.telling);
    this.telling = setTimeout(() => { this.heard.textContent = text; }, 500);
  }

  // ------------------------------------------------------------ picture

  /** Ask for a picture. While pictures follow each other they may be coarser; a fine one follows at rest. */
  draw() {
    this.resting = false;
    clearTimeout(this.rested);
    this.ask();
  }

  ask() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = null; if (this.seen) this.paint(); });
  }

  /** The best of LEVELS that takes 40 ms; at rest a better one may take longer. */
  level() {
    const { cost } = this;
    if (this.resting) return cost[0] > 500 ? 1 : 0;
    // Before anything is known, many polygons are tried at a coarse level first.
    const untried = this.counted.polygons > 12000 ? (this.view.fast ? 1 : 2) : 0;
    const fits = LEVELS.findIndex((_, k) => (cost[k] === undefined ? k >= untried : cost[k] <= 40));
    return fits < 0 ? LEVELS.length - 1 : fits;
  }

  paint() {
    const shown = this.canvas, ratio = Math.min(globalThis.devicePixelRatio || 1, 2);
    const width = Math.round(shown.clientWidth * ratio), height = Math.round(shown.clientHeight * ratio);
    if (!width || !height) return;
    const view = (this.view = renderer());
    view.users.add(this);
    if (view.gl.isContextLost()) return;
    if (shown.width !== width || shown.height !== height) Object.assign(shown, { width, height });
    this.buffers ??= new Buffers(view.gl);
    const level = this.level(), { name, scale, samples } = LEVELS[level];
    const w = Math.round(width * scale), h = Math.round(height * scale);
    view.resize(w, h);
    view.begin(samples > 1, w, h);
    new Picture(this, w, h, ratio * scale, level).draw();
    view.end(samples > 1, w, h);
    const context = shown.getContext("2d", { willReadFrequently: !view.fast });
    context.drawImage(view.canvas, 0, view.canvas.height - h, w, h, 0, 0, width, height);
    this.colorBar(context, width, height, ratio);
    this.element.dataset.frames = String(++this.frames);
    this.element.dataset.quality = name;
    if (this.frames === 1) this.element.dataset.firstPicture = performance.now().toFixed(1);
    else view.timed((cost) => { this.cost[level] = cost; this.element.dataset.frameMs = cost.toFixed(1); });
    if (!this.resting && level > 0) {
      this.rested = setTimeout(() => { this.resting = true; this.ask(); }, 250);
    }
  }

  /** Give the memory back while out of sight. */
  rest() { this.buffers?.free(); this.buffers = null; }

  restart() { this.buffers = null; this.draw(); }

  /** The points that the first view must show: samples, or other points of the shape, or the skeleton in its box. */
  outline() {
    if (this.outlined) return this.outlined;
    const places = [], { center, half } = this.camera;
    for (const scene of this.scenes) {
      const source = scene.points.length ? scene.points : scene.vertices;
      const rows = scene.samples ?? Uint32Array.from({ length: source.length / 3 }, (_, i) => i);
      for (const v of rows) {
        const p = [source[3 * v], source[3 * v + 1], source[3 * v + 2]];
        if (scene.points.length || p.every((x, k) => Math.abs(x - center[k]) <= 1.001 * half[k])) places.push(...p);
      }
    }
    return (this.outlined = Float32Array.from(places));
  }

  /** A scale of colours with three numbers, part of the picture so that it is saved with it. */
  colorBar(context, width, height, ratio) {
    const color = this.get("color"), { header, filter, palette: { ramp, ground, ink } } = this;
    if (color === "none") return;
    const w = Math.min(150 * ratio, width * 0.4), h = 9 * ratio, x = 14 * ratio, y = height - 34 * ratio;
    const gradient = context.createLinearGradient(x, 0, x + w, 0);
    ramp.forEach((hex, k) => gradient.addColorStop(k / (ramp.length - 1), hex));
    context.fillStyle = `${ground}bf`;
    context.fillRect(x - 10 * ratio, y - 18 * ratio, w + 24 * ratio, 50 * ratio);
    context.fillStyle = gradient;
    context.fillRect(x, y, w, h);
    context.fillStyle = ink;
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.fillText(color === "radius" ? "radius of the ball" : "level: goes above this threshold", x, y - 6 * ratio);
    const { largest, power } = filter.header;
    const number = (share) => (color === "radius" ? String(Number((share * header.radius).toPrecision(2)))
      : share === 1 ? `≥ ${Number((largest / PI).toPrecision(2))} π` : `${Number(((largest * share ** power) / PI).toPrecision(2))} π`);
    [0, 0.5, 1].forEach((share) => {
      context.textAlign = ["left", "center", "right"][2 * share];
      context.fillText(number(share), x + share * w, y + h + 13 * ratio);
    });
  }

  save() {
    this.resting = true;
    this.paint();
    this.canvas.toBlob((blob) => {
      const link = make("a", { href: URL.createObjectURL(blob), download: "skeleton.png" });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }

  close() {
    this.gone.forEach((stop) => stop());
    cancelAnimationFrame(this.waiting);
    clearTimeout(this.telling);
    this.view?.users.delete(this);
    this.rest();
  }
}
