// What all explorers on a page have in common; mirrors explorers/explorer.py and drawing_board/board.py.

import { Knob } from "./knobs.js";
import { fragment, View } from "./marks.js";

/** What board.js asks of a model, without a kernel. */
class PageModel {
  constructor(data, moved) {
    this.data = data;
    this.moved = moved;
    this.heard = new Map();
  }

  get(name) { return this.data[name]; }

  set(name, value) {
    if (this.data[name] === value) return;
    this.data[name] = value;
    this.tell(`change:${name}`);
  }

  tell(event, message) { (this.heard.get(event) ?? []).forEach((call) => call(message)); }

  on(names, call) {
    for (const name of names.split(" ")) this.heard.set(name, [...(this.heard.get(name) ?? []), call]);
  }

  off() {}

  // The board in JupyterLab waits for Python's answer to a move; here it comes at once.
  send({ handles, serial }) {
    this.data.handles = handles;
    try { this.moved(); } finally { this.tell("msg:custom", { type: "answer", serial }); }
  }
}

/** A number as it is read: four digits, yes or no, Betti numbers in brackets. */
export function said(value, digits = 4) {
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (Array.isArray(value)) return `(${value.map((entry) => said(entry)).join(", ")})`;
  // A count is never as large as that: then it is a length without a fraction.
  if (typeof value !== "number" || (Number.isInteger(value) && Math.abs(value) < 1e5)) return String(value);
  const rounded = Number(value.toPrecision(digits));
  const power = Math.floor(Math.log10(Math.abs(rounded)));
  if (power >= -4 && power < digits) return String(rounded);
  const [head, tail] = rounded.toExponential().split("e");
  return `${head}e${tail[0]}${tail.slice(1).padStart(2, "0")}`;
}

/** A sentence with values in the places of its braces, as Python's str.format. */
export const fill = (sentence, values) => sentence.replace(/\{(\w+)\}/g, (_, name) => said(values[name]));

/** A subclass says in `redraw` what is on the board for the present controls and handles. */
export class Toy {
  constructor(told) {
    const { look, words, given, pens, swatches, still } = told;
    Object.assign(this, { look, words, given, pens, swatches, still });
    this.numbers = {};
    this.hidden = new Set(told.hidden);
    this.model = new PageModel({ ...told.board }, () => this.update());
    this.view = new View(told.board._view);
    this.controls = {};
    for (const about of told.controls) {
      this.controls[about.name] = new Knob(about, ({ name }) => { if (this.pressed(name) !== false) this.update(); });
    }
    const valued = Object.values(this.controls).filter(({ value }) => value !== undefined);
    this.began = Object.fromEntries(valued.map(({ name, value }) => [name, value]));
    for (const [name, picture] of Object.entries(this.still)) this.show(name, !this.hidden.has(name), picture);
  }

  get handles() { return this.model.get("handles"); }

  value(name) { return this.controls[name].value; }

  /** Is told when the picture is drawn; what the text says of it follows. */
  drawn() {}

  /** Hears of a control, before the picture is drawn; false: it stays as it is. */
  pressed() {}

  /** Set several controls and draw once; `others`: those not named go back to where they began. */
  set(values, others = false) {
    if (others) values = { ...this.began, ...values };
    for (const [name, value] of Object.entries(values)) this.controls[name].set(value);
    this.update();
  }

  draw(name, contents, visible = true) {
    this.show(name, visible, fragment(contents, this.pens[name], this.view));
  }

  show(name, visible, picture = this.still[name]) { this.model.set(`_svg_${name}`, visible ? picture : ""); }

  tell(remark, numbers) {
    const line = Object.entries(numbers).map(([name, value]) => `${name.replaceAll("_", " ")} ${said(value)}`);
    this.say(`${remark} ${line.join(" · ")}`.trim(), numbers);
  }

  say(sentence, numbers = {}) {
    this.numbers = numbers;
    this.model.set("text", sentence);
  }

  update() {
    this.redraw();
    const shown = Object.entries(this.swatches).filter(([name, swatch]) => swatch && this.model.get(`_svg_${name}`));
    this.model.set("_legend", [...new Set(shown.map(([, swatch]) => swatch))].join(""));
    this.drawn();
  }
}

/** The sides of rings as segments. */
export const sidesOf = (rings) => rings.flatMap((ring) => ring.map((p, k) => [p, ring[(k + 1) % ring.length]]));
