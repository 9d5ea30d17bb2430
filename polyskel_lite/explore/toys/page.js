// Explorers and questions on a page without a kernel. A page gets this with the explorers that it has, see bundle.py.

import { render } from "../drawing_board/board.js";
import { make } from "../skeleton_viewer/dom.js";
import { panel } from "./knobs.js";
import { predictions } from "./predict.js";

/** Put what moves in the place of the picture that stands still. */
function mount(root, toys) {
  const told = JSON.parse(root.querySelector("script[type='application/json']").textContent);
  const toy = new toys[told.toy](told);
  const explorer = make("div", { class: "psl-explorer" }, panel(Object.values(toy.controls)));
  toy.update();
  render({ model: toy.model, el: explorer });
  explorer.append(make("p", { class: "psl-look" }, toy.look));
  root.querySelector("figure").replaceWith(explorer);
  root.toy = toy;
  root.dataset.ready = "true";
}

/** Words in the text become a button that brings the explorer above them, or the first one, to a state. */
function wire(words) {
  const all = [...document.querySelectorAll(".psl-toy")];
  const follows = (toy) => toy.compareDocumentPosition(words) & Node.DOCUMENT_POSITION_FOLLOWING;
  const root = all.findLast(follows) ?? all[0];
  const onclick = () => {
    if (!("locked" in root.dataset)) root.toy?.set(JSON.parse(words.dataset.set));
    root.scrollIntoView({ block: "nearest" });
  };
  if (root) words.replaceChildren(make("button", { type: "button", title: "Show this in the picture", onclick }, words.textContent));
}

/** `toys` are the explorers of this page by name. What is far down waits until the reader comes near. */
export function start(toys) {
  predictions();
  const near = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
    if (!isIntersecting) return;
    near.unobserve(target);
    try { mount(target, toys); } catch (error) {
      target.dataset.error = String(error);
      console.warn("explorer:", error);
    }
  }), { rootMargin: "600px" });
  document.querySelectorAll(".psl-toy").forEach((root) => near.observe(root));
  document.querySelectorAll(".psl-set").forEach(wire);
}
