// The drawing board in the browser: shows the layers that Python drew, and tells Python where the handles are.
// Python makes the SVG of each layer (one synced trait each), so nothing about colours or lines is said here.

const SVG = "http://www.w3.org/2000/svg";

function element(tag, parent, attributes = {}) {
  const node = tag === "svg" || tag === "g" || tag === "rect"
    ? document.createElementNS(SVG, tag) : document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  parent.append(node);
  return node;
}

const short = (number) => String(Number(number.toPrecision(3)));

export function render({ model, el }) {
  const root = element("div", el, { class: "psl-board", "data-busy": "false", "data-answers": "0",
    "data-lm-suppress-shortcuts": "true" });
  const stage = element("div", root, { class: "psl-stage" });
  const picture = element("svg", stage, { role: "img" });
  element("rect", picture, { width: "100%", height: "100%", fill: "#ffffff" });
  const legend = element("div", root, { class: "psl-legend" });
  // One paragraph for good: readers of the screen are told when its text changes.
  const status = element("p", root, { class: "psl-text", role: "status", "aria-live": "polite" });

  const groups = new Map(); // name of a layer -> its <g>
  const watched = new Set(); // layers whose changes are listened to
  const stale = new Set(); // layers to draw in the next frame
  let knobs = []; // the elements of the handles
  let places = []; // where they are on the screen, in coordinates of the shape
  let held = -1; // the handle under the pointer
  let moved = false; // a move the kernel has not been told of
  let sent = 0; // when the last one was sent; 0: the kernel has answered
  let answered = 0; // when the move was sent whose answer the next frame shows
  let serial = 0;
  let frame = 0;

  const view = () => model.get("_view");
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  function schedule() {
    if (!frame) frame = requestAnimationFrame(paint);
  }

  function paint() {
    frame = 0;
    for (const name of stale) groups.get(name).innerHTML = model.get("_svg_" + name) || "";
    stale.clear();
    knobs.forEach(showHandle);
    if (answered) {
      root.dataset.latency = (performance.now() - answered).toFixed(1);
      root.dataset.answers = String(Number(root.dataset.answers) + 1);
      answered = 0;
    }
    settle();
    nameSliders();
    root.dataset.busy = String(Boolean(sent || moved));
  }

  // The controls' sliders come without a name for readers of the screen: give them the label beside them. And
  // JupyterLab's shortcuts (arrows, x for "cut the cell" ...) are not for the part that has the focus.
  function nameSliders() {
    const whole = root.closest(".psl-explorer");
    for (const part of whole?.querySelectorAll(".psl-handle, .noUi-handle, input, select, button") ?? []) {
      part.dataset.lmSuppressShortcuts = "true";
    }
    for (const slider of whole?.querySelectorAll(".widget-slider") ?? []) {
      const handle = slider.querySelector(".noUi-handle:not([aria-label])");
      handle?.setAttribute("aria-label", slider.querySelector(".widget-label")?.textContent || "value");
    }
  }

  // The newest place only, and only when the kernel is done with the one before: moves never queue up.
  function tell() {
    if (sent || !moved) return;
    moved = false;
    sent = performance.now();
    serial += 1;
    model.send({ type: "move", handles: places, serial });
  }

  function hear(message) {
    if (message.type !== "answer" || message.serial !== serial || !sent) return;
    root.dataset.reply = (performance.now() - sent).toFixed(1);
    answered = sent;
    sent = 0;
    tell();
    schedule();
  }

  function arrange() {
    const names = model.get("_layers");
    for (const [name, group] of groups) {
      if (names.includes(name)) continue;
      group.remove();
      groups.delete(name);
      stale.delete(name);
    }
    for (const name of names) {
      if (!groups.has(name)) {
        groups.set(name, element("g", picture, { "data-layer": name }));
        stale.add(name);
        if (!watched.has(name)) {
          watched.add(name);
          model.on("change:_svg_" + name, () => { if (groups.has(name)) { stale.add(name); schedule(); } });
        }
      }
      picture.append(groups.get(name)); // in the order of drawing
    }
    schedule();
  }

  function resize() {
    const [width, height] = view().size;
    picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
    stage.style.maxWidth = width / 10 + "px";
    for (const name of groups.keys()) stale.add(name);
    schedule();
  }

  function describe() {
    picture.setAttribute("aria-label", model.get("alt"));
    legend.innerHTML = model.get("_legend");
    status.textContent = model.get("text");
  }

  function adopt() {
    places = model.get("handles").map((place) => [...place]);
    const labels = model.get("handle_labels");
    while (knobs.length > places.length) knobs.pop().remove();
    while (knobs.length < places.length) knobs.push(makeHandle(knobs.length));
    knobs.forEach((knob, i) => {
      knob.setAttribute("aria-label", labels[i] || `point ${i + 1}`);
      knob.title = `${labels[i] || `point ${i + 1}`}: drag, or use the arrow keys`;
      showHandle(knob, i);
    });
  }

  function showHandle(knob, i) {
    const [x, y] = places[i];
    const [left, bottom, right, top] = view().box;
    knob.style.left = (100 * (x - left)) / (right - left) + "%";
    knob.style.top = (100 * (top - y)) / (top - bottom) + "%";
    knob.dataset.x = x;
    knob.dataset.y = y;
    knob.setAttribute("aria-valuenow", short(x));
    knob.setAttribute("aria-valuetext", `x ${short(x)}, y ${short(y)}`);
  }

  function move(i, x, y) {
    const [left, bottom, right, top] = view().box;
    places[i] = [clamp(x, left, right), clamp(y, bottom, top)];
    moved = true;
    root.dataset.busy = "true";
    tell();
    schedule();
  }

  function makeHandle(i) {
    const knob = element("div", stage, { class: "psl-handle", role: "slider", tabindex: "0",
      "aria-roledescription": "handle with two directions", "data-handle": i });
    const [left, , right] = view().box;
    knob.setAttribute("aria-valuemin", short(left));
    knob.setAttribute("aria-valuemax", short(right));
    let grip = [0, 0]; // from the pointer to the middle of the handle
    const under = (event) => {
      const area = picture.getBoundingClientRect();
      const [x0, y0, x1, y1] = view().box;
      return [x0 + ((event.clientX - area.left) / area.width) * (x1 - x0),
        y1 - ((event.clientY - area.top) / area.height) * (y1 - y0)];
    };
    knob.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      const [x, y] = under(event);
      grip = [places[i][0] - x, places[i][1] - y];
      held = i;
      knob.setPointerCapture(event.pointerId);
      knob.focus();
      event.preventDefault();
    });
    knob.addEventListener("pointermove", (event) => {
      if (held !== i) return;
      const [x, y] = under(event);
      move(i, x + grip[0], y + grip[1]);
    });
    const release = () => { held = -1; schedule(); };
    knob.addEventListener("pointerup", release);
    knob.addEventListener("pointercancel", release);
    knob.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way) return;
      event.preventDefault(); // neither the page nor the notebook's cells move
      event.stopPropagation();
      const step = model.get("step") * (event.shiftKey ? 10 : 1);
      move(i, places[i][0] + step * way[0], places[i][1] + step * way[1]);
    });
    return knob;
  }

  const settle = () => { if (held < 0 && !moved && !sent) adopt(); };
  const events = [["change:_layers", arrange], ["change:_view", resize], ["change:alt change:_legend change:text", describe],
    ["change:handles change:handle_labels", settle],
    ["msg:custom", hear]];
  for (const [names, call] of events) model.on(names, call);
  describe();
  resize();
  arrange();
  adopt();

  return () => cancelAnimationFrame(frame); // anywidget itself takes the listeners off
}

export default { render };
