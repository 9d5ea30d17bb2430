// Questions before pictures. Until one is answered, the controls of the picture that it belongs to are inert, and the
// sentence that says what to look for is hidden. Without this script the page has question, options and answer as text.

import { make } from "../skeleton_viewer/dom.js";

const LOCKABLE = ".psl-controls, .psl-knobs, .psl-handle, canvas";
const MOVING = ".psl-viewer, .psl-toy";
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const SEEN = /^(What you saw|Reading)\b/; // how a text begins that tells what the picture shows
const locks = new Map(); // picture -> the questions that it waits for, and what opens it

/** The picture that a question is about: the next one in its section, and none beyond another question. */
function pictureOf(asked, reach) {
  if (reach === "none") return null;
  const section = asked.closest("section") ?? document.body;
  // The still picture of an explorer ends the reach: what comes after it belongs to something else.
  const next = [...section.querySelectorAll(`${MOVING}, .psl-explorer, .psl-predict`)].find((other) =>
    (asked.compareDocumentPosition(other) & Node.DOCUMENT_POSITION_FOLLOWING) && !(reach && other.matches(".psl-predict")));
  return next?.matches(MOVING) ? next : next?.querySelector(MOVING) ?? null;
}

/** Does something now and whenever parts of a picture come: they are made when the reader comes near. */
function withParts(picture, act) {
  const seen = new MutationObserver(act);
  seen.observe(picture, { childList: true, subtree: true });
  act();
  return () => seen.disconnect();
}

/** The text below a picture that gives the answer away. */
function readingOf(picture) {
  let next = picture.closest(".cell");
  do next = next?.nextElementSibling; while (next && !next.matches("p, section, .cell, .psl-predict"));
  return next?.matches("p") && SEEN.test(next.querySelector("strong")?.textContent ?? "") ? next : null;
}

function lock(picture, asked) {
  if (locks.has(picture)) return locks.get(picture).questions.add(asked);
  const link = make("a", { href: `#${asked.id}` }, "Answer the question above"), reading = readingOf(picture);
  const note = make("p", { class: "psl-locked" }, link, " to open the controls.");
  reading?.classList.add("psl-told");
  const inert = (on) => { for (const one of picture.querySelectorAll(LOCKABLE)) one.inert = on; };
  const stop = withParts(picture, () => {
    inert(true);
    const controls = picture.querySelector(".psl-controls, .psl-knobs");
    if (!controls && !note.isConnected) picture.prepend(note);
    if (controls && note.nextElementSibling !== controls) controls.before(note);
  });
  const open = () => {
    stop();
    note.remove();
    reading?.classList.remove("psl-told");
    delete picture.dataset.locked;
    inert(false);
  };
  picture.dataset.locked = "true";
  return locks.set(picture, { questions: new Set([asked]), link, open });
}

function unlock(picture, asked) {
  const { questions, link, open } = locks.get(picture);
  questions.delete(asked);
  if (questions.size) link.href = `#${[...questions][0].id}`;
  else open();
}

/** A ring in the picture that stands where the reader clicked, and goes where the arrow keys say. */
function markIn(stage, [left, bottom, right, top]) {
  const ring = make("div", { class: "psl-guess", role: "slider", tabindex: "0", "aria-label": "your mark",
    "aria-roledescription": "mark with two directions", "aria-valuemin": left, "aria-valuemax": right });
  const mark = { ring };
  const put = (x, y) => {
    mark.at = [Math.min(Math.max(x, left), right), Math.min(Math.max(y, bottom), top)];
    const [u, v] = mark.at.map((number) => Number(number.toPrecision(3)));
    ring.style.left = `${(100 * (mark.at[0] - left)) / (right - left)}%`;
    ring.style.top = `${(100 * (top - mark.at[1])) / (top - bottom)}%`;
    ring.setAttribute("aria-valuenow", u);
    ring.setAttribute("aria-valuetext", `x ${u}, y ${v}`);
  };
  const click = (event) => {
    const area = stage.querySelector("svg").getBoundingClientRect();
    mark.moved = true;
    put(left + ((event.clientX - area.left) / area.width) * (right - left), top - ((event.clientY - area.top) / area.height) * (top - bottom));
    ring.focus({ preventScroll: true });
  };
  ring.addEventListener("keydown", (event) => {
    const way = ARROWS[event.key], step = ((right - left) / 100) * (event.shiftKey ? 10 : 1);
    if (!way || mark.closed) return;
    event.preventDefault();
    mark.moved = true;
    put(mark.at[0] + step * way[0], mark.at[1] + step * way[1]);
  });
  stage.addEventListener("click", click);
  put(left + 0.1 * (right - left), top - 0.1 * (top - bottom));
  stage.append(ring);
  mark.close = () => {
    mark.closed = true;
    stage.removeEventListener("click", click);
    for (const name of ring.getAttributeNames()) if (name !== "class" && name !== "style") ring.removeAttribute(name);
    if (!mark.moved) ring.remove();
  };
  return mark;
}

/** The options as radio buttons under the question. */
function choice(asked, list) {
  const labels = [...list.children].map((item, k) => make("label", {},
    make("input", { type: "radio", name: `${asked.id}-answer`, value: k }), make("span", {}, ...item.querySelector("p").childNodes)));
  const question = asked.querySelector(".psl-question");
  const fieldset = make("fieldset", {}, make("legend", { class: "psl-question" }, ...question.childNodes), ...labels);
  question.remove();
  list.replaceWith(fieldset);
  return fieldset;
}

function ask(asked) {
  const { right, place, opens } = asked.dataset, folded = asked.querySelector("details"), summary = folded.firstElementChild;
  const picture = pictureOf(asked, opens);
  asked.dataset.ready = "true";
  if (place && !picture) return; // nothing to point at: question and answer stay as text
  const [x, y, tolerance] = (place ?? "").split(" ").map(Number);
  const set = place ? make("p", {}, "Click in the picture, or move the ring there with the arrow keys.") : choice(asked, asked.querySelector("ul"));
  const told = make("p", { class: "psl-said", role: "status" });
  const button = make("button", { type: "button" }, "Lock it in"), skip = make("button", { type: "button" }, picture ? "Open without one" : "Show the answer");
  const bar = make("div", {}, button, skip);
  let mark = null;
  if (picture) lock(picture, asked);
  const stop = place && withParts(picture, () => {
    const stage = picture.querySelector(".psl-stage"), view = picture.toy?.model.get("_view");
    if (view && stage && !stage.contains(mark?.ring)) mark = markIn(stage, view.box);
  });

  const done = (verdict) => {
    stop?.();
    mark?.close();
    if (picture) unlock(picture, asked);
    bar.remove();
    if (place) set.remove(); else set.disabled = true;
    folded.hidden = false;
    if (verdict) {
      summary.textContent = "Verdict";
      folded.querySelector("p").prepend(make("strong", {}, verdict), " ");
    }
    summary.focus({ preventScroll: true }); // the verdict comes before the controls, and is in sight
  };
  button.addEventListener("click", () => {
    const chosen = place ? mark?.moved : set.querySelector("input:checked");
    if (!chosen) {
      told.textContent = place ? "Set your mark in the picture first." : "Choose one first; a wrong one teaches most.";
    } else if (place) {
      const { at } = mark, shown = at.map((number) => Number(number.toPrecision(3)));
      told.textContent = `You said: x ${shown[0]}, y ${shown[1]}; your ring stays in the picture.`;
      done(Math.hypot(at[0] - x, at[1] - y) <= tolerance ? "Near." : "Far.");
    } else {
      told.replaceChildren("You said: ", ...[...chosen.nextSibling.childNodes].map((one) => one.cloneNode(true)));
      done(right === undefined ? "" : right.split(" ").includes(chosen.value) ? "As you said:" : "Not what you said:");
    }
  });
  skip.addEventListener("click", () => { told.remove(); done(""); });
  folded.hidden = true;
  folded.before(...(place ? [set] : []), bar, told);
}

/** Wires every question of a page. */
export function predictions(page = document) {
  page.querySelectorAll(".psl-predict:not([data-ready])").forEach(ask);
}
