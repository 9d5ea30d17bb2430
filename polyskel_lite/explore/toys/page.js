// Explorers and questions on a page without a kernel. A page gets this with the explorers that it has, see bundle.py.

import { render } from "../drawing_board/board.js";
import { make, whenNear } from "../skeleton_viewer/dom.js";
import { panel } from "./knobs.js";
import { predictions } from "./predict.js";
import { said } from "./toy.js";

/** Words of the text that are tied to the explorer above them, or to the first one: see notebooks/states.py. */
function tied(root, kind) {
  const all = [...document.querySelectorAll(".psl-toy")];
  const above = (words) => all.findLast((toy) => toy.compareDocumentPosition(words) & Node.DOCUMENT_POSITION_FOLLOWING);
  return [...document.querySelectorAll(`.psl-${kind}`)].filter((words) => (above(words) ?? all[0]) === root);
}

function tie(root, toy) {
  const open = () => !("locked" in root.dataset);
  for (const words of tied(root, "state")) {
    const onclick = () => {
      if (open()) toy.set(JSON.parse(words.dataset.to), true);
      (open() ? root : root.querySelector(".psl-locked") ?? root).scrollIntoView({ block: "nearest" });
    };
    const title = "Show this in the picture";
    words.replaceChildren(make("button", { type: "button", title, onclick }, words.textContent));
  }
  const knobs = tied(root, "knob").map((words) => {
    const name = words.dataset.to, { min, max, step, label } = toy.controls[name];
    const input = make("input", { type: "number", "aria-label": label });
    Object.assign(input, { min, max, step });
    input.addEventListener("input", () => {
      if (open() && input.value !== "") toy.set({ [name]: Number(input.value) });
      if (!open()) root.querySelector(".psl-locked")?.scrollIntoView({ block: "nearest" });
    });
    input.addEventListener("change", () => { input.value = String(toy.value(name)); }); // what the slider made of it
    words.replaceChildren(input);
    return [name, input];
  });
  const readings = tied(root, "reading");
  toy.drawn = () => {
    for (const [name, input] of knobs) if (document.activeElement !== input) input.value = String(toy.value(name));
    for (const words of readings) words.textContent = said(toy.numbers[words.dataset.to] ?? "-");
  };
}

/** Put what moves in the place of the picture that stands still. */
function mount(root, toy) {
  const explorer = make("div", { class: "psl-explorer" }, panel(Object.values(toy.controls)));
  tie(root, toy);
  toy.update();
  render({ model: toy.model, el: explorer });
  explorer.append(make("p", { class: "psl-look" }, toy.look));
  root.querySelector("figure").replaceWith(explorer);
  root.toy = toy;
  root.dataset.ready = "true";
}

/** `toys` are the explorers of this page by name. */
export function start(toys) {
  predictions();
  whenNear(document.querySelectorAll(".psl-toy"), (root, told) => mount(root, new toys[told.toy](told)));
}
