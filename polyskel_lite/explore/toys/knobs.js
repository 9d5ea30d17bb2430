// Controls of an explorer on a page: sliders, boxes, choices and buttons, each with its label.

import { make } from "../skeleton_viewer/dom.js";

let knobs = 0;

/** A value that a reader sets; `changed` hears of it. Setting `value` or `max` from here calls nobody. */
export class Knob {
  constructor(about, changed) {
    Object.assign(this, about);
    const id = `psl-knob-${++knobs}`;
    const name = make("label", { for: id }, this.label);
    const heard = () => { this.read(); changed(this); };
    if (this.kind === "button") {
      this.input = make("button", { type: "button", id, onclick: () => changed(this) }, this.label);
      this.part = this.input;
    } else if (this.kind === "check") {
      this.input = make("input", { type: "checkbox", id, onchange: heard });
      this.part = make("span", { class: "psl-part" }, this.input, name);
    } else if (this.kind === "choice") {
      this.input = make("select", { id, onchange: heard });
      this.part = make("span", { class: "psl-part" }, name, this.input);
      this.fill(this.options);
    } else {
      const { min, max, step } = this;
      this.input = make("input", { type: "range", id, min, max, step, oninput: heard });
      // The number beside it can be typed; it is the slider's own, so it needs no second label to be heard.
      this.number = make("input", { type: "number", min, max, step, "aria-label": this.label, onchange: () => {
        this.input.value = this.number.value === "" ? this.value : this.number.value;
        heard();
      } });
      this.part = make("span", { class: "psl-part psl-slider" }, name, this.input, this.number);
    }
    this.input.dataset.control = this.name;
    this.show();
  }

  read() {
    if (this.kind === "check") this.value = this.input.checked;
    else if (this.kind === "choice") this.value = this.options[this.input.selectedIndex][1];
    else this.value = Number(this.input.value);
    this.show();
  }

  set(value) {
    if (this.kind === "slider") value = this.onStep(value);
    this.value = value;
    this.show();
  }

  /** The nearest value that the slider has. */
  onStep(value) {
    const { min, max, step } = this, steps = Math.round((Math.min(Math.max(value, min), max) - min) / step);
    return Number(Math.min(min + steps * step, max).toPrecision(12));
  }

  /** Another end of the slider. */
  reach(max) {
    this.max = max;
    this.input.max = this.number.max = String(max);
    this.set(this.value);
  }

  /** Other options of a choice: pairs of words and value. */
  fill(options) {
    this.options = options;
    this.input.replaceChildren(...options.map(([words]) => make("option", {}, words)));
  }

  show() {
    if (this.kind === "check") this.input.checked = this.value;
    if (this.kind === "choice") this.input.selectedIndex = this.options.findIndex(([, value]) => value === this.value);
    if (this.kind === "slider") {
      this.input.value = String(this.value);
      this.number.value = String(Number(this.value.toPrecision(6)));
    }
  }
}

/** The controls in rows: what is needed first, the rest folded. */
export function panel(parts) {
  const [first] = parts;
  const leading = first?.kind === "check" ? parts.findIndex(({ kind }) => kind !== "check") : 1;
  const count = leading < 0 ? parts.length : leading;
  const rows = make("div", { class: "psl-knobs" }, ...parts.slice(0, count).map(({ part }) => part));
  if (parts.length > count) {
    const rest = make("div", {}, ...parts.slice(count).map(({ part }) => part));
    rows.append(make("details", { class: "psl-more" }, make("summary", {}, "More controls"), rest));
  }
  return rows;
}
