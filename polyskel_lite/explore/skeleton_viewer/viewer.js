// A viewer: its controls, what they show, and when it draws.

import { Camera, PI, clamp } from "./camera.js";
import { make, ownName } from "./dom.js";
import { Buffers, renderer } from "./gl.js";
import { LEVELS, Picture } from "./picture.js";

const STEPS = 400; // of the threshold slider
const PLURALS = { vertex: "vertices", branch: "branches", cavity: "cavities" };
const many = (n, word) => `${n.toLocaleString("en")} ${n === 1 ? word : PLURALS[word] ?? `${word}s`}`;
const multiple = (t) => (t === -Infinity ? "none" : `${Number((t / PI).toFixed(3))} π`);

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

  get(name) { const value = this.model.get(name); return name === "threshold" && value === null ? -Infinity : value; }

  set(name, value) {
    if (this.get(name) === value) return;
    this.model.set(name, value === -Infinity ? null : value);
    clearTimeout(this.saving);
    this.saving = setTimeout(() => this.model.save_changes(), 40);
  }

  get sceneNow() { return this.scenes.find((s) => s.label === this.get("variant")) ?? this.scenes[0]; }

  get filter() {
    const { hierarchies } = this.sceneNow;
    return hierarchies.find((h) => h.label === this.get("strategy")) ?? hierarchies[0];
  }

  // ------------------------------------------------------------ controls

  build() {
    const { header, id, dimension } = this;
    const solid = dimension === 3;
    this.canvas = make("canvas", {
      tabindex: "0", role: "application", "aria-roledescription": "interactive picture", "aria-label": header.alt,
      "aria-describedby": `${id}-hint`,
    });
    this.stage = make("div", { class: "psl-stage", style: `height:${header.height}px` }, this.canvas);
    this.status = make("p", { class: "psl-status", "aria-hidden": "true" });
    this.heard = make("p", { class: "psl-only-heard", role: "status", "aria-live": "polite" });
    this.controls = make("div", { class: "psl-controls" });
    const hint = make("p", { class: "psl-hint", id: `${id}-hint` },
      `${solid ? "Drag to turn, Shift and drag to move" : "Drag to move"}; after a click the wheel zooms. `
      + `Keys: arrows ${solid ? "turn, Shift and arrows move" : "move"}, + and − zoom, Home resets.`);
    this.rows();
    this.element.classList.add("psl");
    this.element.setAttribute("role", "group");
    this.element.setAttribute("aria-label", header.name);
    if (header.look) this.element.append(make("p", { class: "psl-look" }, header.look));
    this.element.append(this.stage, this.status, this.heard, this.controls, hint);
    // JupyterLab's shortcuts would keep arrow keys and letters from the part that has the focus.
    for (const part of this.element.querySelectorAll("canvas, input, select, button")) part.dataset.lmSuppressShortcuts = "true";
    this.pointer();
    const sizes = new ResizeObserver(() => this.draw());
    sizes.observe(this.stage);
    const inSight = new IntersectionObserver((entries) => {
      this.seen = entries[entries.length - 1].isIntersecting;
      if (this.seen) this.draw(); else this.rest();
    }, { rootMargin: "300px" });
    inSight.observe(this.stage);
    this.gone.push(() => sizes.disconnect(), () => inSight.disconnect());
  }

  row(text, control, output = "", wide = false) {
    const label = make("label", { for: control.id }, text);
    this.controls.append(make("div", { class: wide ? "psl-row psl-wide" : "psl-row" }, label, control, output));
  }

  slider(key, name, text, options, { shown, value, wide }) {
    const input = make("input", { type: "range", id: `${this.id}-${key}`, "data-control": key, "aria-label": text, ...options });
    const output = make("output", { for: input.id });
    input.addEventListener("input", () => { this.set(name, value(Number(input.value))); this.update(); });
    this.row(text, input, output, wide);
    this.refreshers.push(() => {
      const now = this.get(name), words = shown(now);
      if (output.textContent !== words) { output.textContent = words; input.setAttribute("aria-valuetext", words); }
    });
    return input;
  }

  rows() {
    const { header, id } = this;
    const first = this.scenes[0], solid = this.dimension === 3;
    this.refreshers = [];
    if (header.filters) this.thresholdRow();
    if (this.scenes.length > 1) {
      const labels = this.scenes.map((s) => s.label);
      const input = this.slider("variant", "variant", header.variant, { min: "0", max: String(labels.length - 1), step: "1" },
        { shown: (v) => v, value: (i) => labels[i], wide: true });
      this.refreshers.push(() => { input.value = String(Math.max(labels.indexOf(this.get("variant")), 0)); });
    }
    const strategies = first.hierarchies.map((h) => h.label);
    if (strategies.length > 1) {
      const set = make("fieldset", { class: "psl-wide" }, make("legend", {}, header.strategy));
      for (const name of strategies) {
        const input = make("input", { type: "radio", name: `${id}-strategy`, value: name, "data-control": "strategy",
          onchange: () => { this.set("strategy", name); this.update(); } });
        set.append(make("label", {}, input, name));
        this.refreshers.push(() => { input.checked = this.filter.label === name; });
      }
      this.controls.append(set);
    }
    const share = { min: "0", max: "100", step: "1" };
    const percent = { shown: (v) => `${Math.round(100 * v)} %`, value: (v) => v / 100 };
    if (header.shape) {
      if (header.filters) {
        const ends = { ...percent, shown: (v) => (v <= 0 ? "whole" : v >= 1 ? "simplified" : percent.shown(v)) };
        const input = this.slider("simplified", "simplified", "Simplify shape", share, ends);
        this.refreshers.push(() => { input.value = String(Math.round(100 * this.get("simplified"))); });
      }
      const input = this.slider("opacity", "opacity", "Shape opacity", share, percent);
      this.refreshers.push(() => { input.value = String(Math.round(100 * this.get("opacity"))); });
    }
    const names = { radius: "radius", level: "level", none: "one colour" };
    const colors = Object.keys(names).filter((c) => c !== "level" || header.filters);
    const select = make("select", { id: `${id}-color`, "data-control": "color",
      onchange: () => { this.set("color", select.value); this.update(); } },
    ...colors.map((c) => make("option", { value: c }, names[c])));
    this.row("Colour", select);
    this.refreshers.push(() => { select.value = this.get("color"); });
    const set = make("fieldset", { class: "psl-wide" }, make("legend", {}, "Show"));
    for (const key of ["samples", "vertices", "edges", ...(solid ? ["polygons"] : [])]) {
      if (key === "samples" && !header.samples) continue;
      const input = make("input", { type: "checkbox", "data-control": key,
        onchange: () => { this.set(key, input.checked); this.update(); } });
      set.append(make("label", {}, input, key));
      this.refreshers.push(() => { input.checked = this.get(key); });
    }
    const button = (text, label, act, key) => make("button", { type: "button", "aria-label": label, "data-control": key, onclick: act }, text);
    this.controls.append(set, make("div", { class: "psl-bar" },
      button("+", "Zoom in", () => { this.camera.scale(1.25); this.draw(); }, "in"),
      button("−", "Zoom out", () => { this.camera.scale(0.8); this.draw(); }, "out"),
      button("Reset view", "Reset view", () => { this.camera.reset(); this.draw(); }, "reset"),
      button("Save picture", "Save picture as PNG", () => this.save(), "save")));
  }

  /** The slider is finer where most elements go; the field takes any number. Its first step can be "none". */
  thresholdRow() {
    const input = make("input", { type: "range", id: `${this.id}-threshold`, "data-control": "threshold", min: "0",
      max: String(STEPS), step: "1" });
    const field = make("input", { type: "number", min: "0", step: "0.05", "data-control": "threshold-number",
      "aria-label": "Threshold as a multiple of π", placeholder: "none" });
    const scale = () => this.filter.header;
    const first = () => (scale().systematic ? 1 : 0);
    const valueAt = (k) => {
      const share = (k - first()) / (STEPS - first());
      return share < 0 ? -Infinity : (Math.round(1000 * ((scale().largest / PI) * share ** scale().power)) / 1000) * PI;
    };
    const placeOf = (t) => (t === -Infinity ? 0
      : first() + Math.round((STEPS - first()) * clamp(t / scale().largest, 0, 1) ** (1 / scale().power)));
    input.addEventListener("input", () => {
      // Steps that round to the same multiple of π / 1000 would be steps that do nothing.
      let k = Number(input.value), t = valueAt(k);
      const now = this.get("threshold"), up = k > this.place;
      while (t === now && k !== this.place && k > 0 && k < STEPS) { k += up ? 1 : -1; t = valueAt(k); }
      input.value = String(k);
      this.place = k;
      this.set("threshold", t);
      this.update();
    });
    const typed = () => {
      const t = field.value === "" ? -Infinity : Number(field.value) * PI;
      if (Number.isFinite(t) || field.value === "") { this.set("threshold", t); this.update(); }
    };
    field.addEventListener("change", typed);
    this.row("Threshold", input, make("span", {}, field, " π"), true);
    this.refreshers.push(() => {
      const t = this.get("threshold");
      if (valueAt(Number(input.value)) !== t) input.value = String(placeOf(t));
      this.place = Number(input.value);
      input.setAttribute("aria-valuetext", t === -Infinity ? "nothing removed" : multiple(t));
      if (document.activeElement !== field || Number(field.value) * PI !== t) {
        field.value = t === -Infinity ? "" : String(Number((t / PI).toFixed(3)));
      }
    });
  }

  pointer() {
    const canvas = this.canvas, held = new Map();
    const at = (event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
    const relative = (x, y) => [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
    const pan = (dx, dy) => { this.camera.x += (2 * dx) / canvas.clientWidth; this.camera.y -= (2 * dy) / canvas.clientHeight; };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, at(event));
      canvas.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const now = at(event), dx = now[0] - before[0], dy = now[1] - before[1];
      if (held.size === 2) {
        const [, other] = [...held].find(([key]) => key !== event.pointerId);
        const distance = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
        pan(dx / 2, dy / 2);
        this.camera.scale(distance(now) / distance(before), ...relative((now[0] + other[0]) / 2, (now[1] + other[1]) / 2));
      } else if (this.dimension === 2 || event.shiftKey || event.buttons & 6) pan(dx, dy);
      else this.camera.turn(dx * 0.45, dy * 0.45);
      held.set(event.pointerId, now);
      this.draw();
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => held.delete(event.pointerId));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return; // the page scrolls on
      event.preventDefault();
      this.camera.scale(Math.exp(-clamp(event.deltaY * (event.deltaMode ? 20 : 1), -120, 120) * 0.0025), ...relative(...at(event)));
      this.draw();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (step && (this.dimension === 2 || event.shiftKey)) pan(24 * step[0], 24 * step[1]);
      else if (step) this.camera.turn(6 * step[0], 6 * step[1]);
      else if (event.key === "+" || event.key === "=") this.camera.scale(1.15);
      else if (event.key === "-" || event.key === "_") this.camera.scale(1 / 1.15);
      else if (event.key === "Home" || event.key === "0") this.camera.reset();
      else return;
      event.preventDefault();
      event.stopPropagation();
      this.draw();
    });
  }

  follow() {
    const names = ["threshold", "strategy", "variant", "opacity", "simplified", "color", "samples", "vertices", "edges", "polygons"];
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
    this.refreshers.forEach((refresh) => refresh());
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
    const color = this.get("color"), { header, filter } = this;
    if (color === "none") return;
    const w = Math.min(150 * ratio, width * 0.4), h = 9 * ratio, x = 14 * ratio, y = height - 34 * ratio;
    const gradient = context.createLinearGradient(x, 0, x + w, 0);
    header.ramp.forEach((hex, k) => gradient.addColorStop(k / (header.ramp.length - 1), hex));
    context.fillStyle = "rgba(255,255,255,0.75)";
    context.fillRect(x - 10 * ratio, y - 18 * ratio, w + 24 * ratio, 50 * ratio);
    context.fillStyle = gradient;
    context.fillRect(x, y, w, h);
    context.fillStyle = "#222";
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
