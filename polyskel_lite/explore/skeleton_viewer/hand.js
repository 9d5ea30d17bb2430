// The reader's hand on the picture: fingers, mouse, wheel and keys.

import { clamp } from "./camera.js";

/** What moves the picture, in words. */
export const howTo = (solid) => (solid
  ? "Drag sideways to turn, with a mouse in any direction; Shift and drag moves. Two fingers, or Ctrl (Cmd) and the wheel, zoom. "
    + "Keys: arrows turn, Shift and arrows move, + and − zoom, Home resets."
  : "Drag sideways to move, with a mouse in any direction. Two fingers move and zoom; Ctrl (Cmd) and the wheel zoom. "
    + "Keys: arrows move, + and − zoom, Home resets.");

/** Let the hand move the camera. Swiping up or down and the wheel alone stay with the page, which scrolls. */
export function obey(canvas, camera, solid, draw) {
  const held = new Map(); // where fingers and mouse were last
  let before = null; // where the camera stood when the first came
  const at = (event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
  const relative = (x, y) => [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
  const pan = (dx, dy) => { camera.x += (2 * dx) / canvas.clientWidth; camera.y -= (2 * dy) / canvas.clientHeight; };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (!held.size) before = camera.place();
    held.set(event.pointerId, at(event));
    canvas.focus({ preventScroll: true });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const now = at(event), dx = now[0] - last[0], dy = now[1] - last[1];
    if (held.size === 2) {
      const [, other] = [...held].find(([key]) => key !== event.pointerId);
      const distance = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
      pan(dx / 2, dy / 2);
      camera.scale(distance(now) / distance(last), ...relative((now[0] + other[0]) / 2, (now[1] + other[1]) / 2));
    } else if (!solid || event.shiftKey || event.buttons & 6) pan(dx, dy);
    else camera.turn(dx * 0.45, dy * 0.45);
    held.set(event.pointerId, now);
    draw();
  });
  canvas.addEventListener("pointerup", (event) => held.delete(event.pointerId));
  canvas.addEventListener("pointercancel", (event) => {
    // The page scrolls: what the finger did until the browser saw that was not meant for the picture.
    if (held.delete(event.pointerId) && !held.size) { camera.stand(before); draw(); }
  });
  const two = (event) => { if (event.touches.length > 1 && event.cancelable) event.preventDefault(); };
  for (const name of ["touchstart", "touchmove"]) canvas.addEventListener(name, two, { passive: false });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    camera.scale(Math.exp(-clamp(event.deltaY * (event.deltaMode ? 20 : 1), -120, 120) * 0.0025), ...relative(...at(event)));
    draw();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (step && (!solid || event.shiftKey)) pan(24 * step[0], 24 * step[1]);
    else if (step) camera.turn(6 * step[0], 6 * step[1]);
    else if (event.key === "+" || event.key === "=") camera.scale(1.15);
    else if (event.key === "-" || event.key === "_") camera.scale(1 / 1.15);
    else if (event.key === "Home" || event.key === "0") camera.reset();
    else return;
    event.preventDefault();
    event.stopPropagation();
    draw();
  });
}
