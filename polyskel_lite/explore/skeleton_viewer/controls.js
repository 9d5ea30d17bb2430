// The controls under the picture: what the reader can set, and what says how it is set.

import { make, say } from "./dom.js";
import { STEPS, TICKS, Track, multiple, typed } from "./threshold.js";

/** All controls of a viewer: the threshold, the variant and the strategy open, the others folded. */
export class Controls {
  constructor(viewer) {
    this.viewer = viewer;
    this.refreshers = [];
    this.more = make("div", { class: "psl-grid" });
    this.place = this.root = make("div", { class: "psl-controls psl-grid" });
    if (viewer.header.filters) this.threshold();
    if (viewer.scenes.length > 1) this.variant();
    if (viewer.scenes[0].hierarchies.length > 1) this.strategy();
    this.root.append(make("details", { class: "psl-wide" }, make("summary", {}, "More controls"), this.more));
    this.place = this.more;
    if (viewer.header.shape) this.shape();
    this.color();
    this.show();
    this.buttons();
  }

  refresh() { this.refreshers.forEach((refresh) => refresh()); }

  /** What the reader has set; the picture follows. */
  set(name, value) { this.viewer.set(name, value); this.viewer.update(); }

  row(text, control, output = "", wide = false) {
    const row = make("div", { class: wide ? "psl-row psl-wide" : "psl-row" }, make("label", { for: control.id }, text), control, output);
    this.place.append(row);
    return row;
  }

  slider(key, text, options, { shown, value, position, wide }) {
    const { viewer } = this;
    const input = make("input", { type: "range", id: `${viewer.id}-${key}`, "data-control": key, "aria-label": text, ...options });
    const output = make("output", { for: input.id });
    input.addEventListener("input", () => this.set(key, value(Number(input.value))));
    this.row(text, input, output, wide);
    this.refreshers.push(() => {
      const now = viewer.get(key), words = shown(now);
      input.value = String(position(now));
      say(input, "aria-valuetext", words);
      if (output.textContent !== words) output.textContent = words;
    });
  }

  group(name) { const set = make("fieldset", { class: "psl-wide" }, make("legend", {}, name)); this.place.append(set); return set; }

  /** A slider, a field that takes any number, and buttons for round angles. The slider's first step can be "none". */
  threshold() {
    const { viewer } = this, { id } = viewer, now = () => viewer.get("threshold");
    const words = (t) => (t === -Infinity ? "nothing removed" : multiple(t));
    const input = make("input", { type: "range", id: `${id}-threshold`, "data-control": "threshold", min: "0",
      max: String(STEPS), step: "1" });
    const field = make("input", { type: "text", "data-control": "threshold-number", placeholder: "none", autocomplete: "off",
      spellcheck: "false", "aria-label": "Threshold in multiples of π, such as 1.5 or pi/3", "aria-describedby": `${id}-problem` });
    const problem = make("p", { class: "psl-problem", id: `${id}-problem`, role: "status" });
    const ticks = make("div", { class: "psl-ticks", role: "group", "aria-label": "Round thresholds" });
    let filter = null, track = null, step = 0, refused = null;
    input.addEventListener("input", () => {
      // Steps that round to the same threshold would be steps that do nothing.
      let k = Number(input.value), t = track.at(k);
      const up = k > step;
      while (t === now() && k !== step && k > 0 && k < STEPS) { k += up ? 1 : -1; t = track.at(k); }
      input.value = String(k);
      this.set("threshold", t);
    });
    field.addEventListener("change", () => {
      const { threshold, problem: why } = typed(field.value);
      refused = why ? { filter, at: now(), why: `${why} The threshold is still ${words(now())}.` } : null;
      if (why) this.refresh(); else this.set("threshold", threshold);
    });
    this.row("Threshold, in multiples of π", input, make("span", {}, field, " π"), true).append(ticks, problem);
    this.refreshers.push(() => {
      const t = now();
      if (filter !== viewer.filter) {
        ({ filter } = viewer);
        track = new Track(filter.header);
        const top = filter.levels[filter.levels.length - 1];
        ticks.replaceChildren(...TICKS.filter(([, tick]) => tick < top).map(([name, tick]) => make("button", {
          type: "button", "aria-label": `Threshold ${name}`, "data-tick": name, style: `--at:${track.share(tick).toFixed(4)}`,
          onclick: () => this.set("threshold", tick) }, name)));
        for (const button of ticks.children) button.dataset.lmSuppressShortcuts = "true";
      }
      if (track.at(Number(input.value)) !== t) input.value = String(track.step(t));
      step = Number(input.value);
      say(input, "aria-valuetext", words(t));
      for (const button of ticks.children) {
        const [, tick] = TICKS.find(([name]) => name === button.dataset.tick);
        say(button, "aria-pressed", String(tick === t));
      }
      // What was refused stays in the field, to be mended, until the threshold changes.
      if (refused && (refused.at !== t || refused.filter !== filter)) refused = null;
      say(field, "aria-invalid", String(Boolean(refused)));
      const why = refused?.why ?? "";
      if (problem.textContent !== why) problem.textContent = why;
      if (!refused) field.value = t === -Infinity ? "" : multiple(t).replace(" π", "");
    });
  }

  variant() {
    const labels = this.viewer.scenes.map((scene) => scene.label);
    this.slider("variant", this.viewer.header.variant, { min: "0", max: String(labels.length - 1), step: "1" }, {
      shown: (name) => name, value: (k) => labels[k], position: (name) => Math.max(labels.indexOf(name), 0), wide: true });
  }

  strategy() {
    const { viewer } = this, set = this.group(viewer.header.strategy);
    for (const { label } of viewer.scenes[0].hierarchies) {
      const input = make("input", { type: "radio", name: `${viewer.id}-strategy`, value: label, "data-control": "strategy",
        onchange: () => this.set("strategy", label) });
      set.append(make("label", {}, input, label));
      this.refreshers.push(() => { input.checked = viewer.filter.label === label; });
    }
  }

  shape() {
    const range = { min: "0", max: "100", step: "1" };
    const percent = { shown: (v) => `${Math.round(100 * v)} %`, value: (k) => k / 100, position: (v) => Math.round(100 * v) };
    const ends = { ...percent, shown: (v) => (v <= 0 ? "whole" : v >= 1 ? "simplified" : percent.shown(v)) };
    if (this.viewer.header.filters) this.slider("simplified", "Simplify shape", range, ends);
    this.slider("opacity", "Shape opacity", range, percent);
  }

  color() {
    const { viewer } = this, names = { radius: "radius", level: "level", none: "one colour" };
    const known = Object.keys(names).filter((color) => color !== "level" || viewer.header.filters);
    const select = make("select", { id: `${viewer.id}-color`, "data-control": "color",
      onchange: () => this.set("color", select.value) },
    ...known.map((color) => make("option", { value: color }, names[color])));
    this.row("Colour", select);
    this.refreshers.push(() => { select.value = viewer.get("color"); });
  }

  show() {
    const { viewer } = this, set = this.group("Show");
    for (const key of ["samples", "vertices", "edges", ...(viewer.dimension === 3 ? ["polygons"] : [])]) {
      if (key === "samples" && !viewer.header.samples) continue;
      const input = make("input", { type: "checkbox", "data-control": key, onchange: () => this.set(key, input.checked) });
      set.append(make("label", {}, input, key));
      this.refreshers.push(() => { input.checked = viewer.get(key); });
    }
  }

  buttons() {
    const { viewer } = this, { camera } = viewer;
    const button = (text, label, act, key) => make("button", { type: "button", "aria-label": label, "data-control": key,
      onclick: () => { act(); viewer.draw(); } }, text);
    this.place.append(make("div", { class: "psl-bar" },
      button("+", "Zoom in", () => camera.scale(1.25), "in"), button("−", "Zoom out", () => camera.scale(0.8), "out"),
      button("Reset view", "Reset view", () => camera.reset(), "reset"),
      button("Save picture", "Save picture as PNG", () => viewer.save(), "save")));
  }
}
