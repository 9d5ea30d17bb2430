// The union of balls that the reader adds, moves and grows; mirrors explorers/moving_balls.py.

import { ballSkeleton } from "./discs.js";
import { circumballs, delaunay, facetTable, voronoiEdges } from "./plane.js";
import { fill, Toy } from "./toy.js";

export class Balls extends Toy {
  constructor(told) {
    super(told);
    const { centers, radii } = this.given;
    this.balls = centers.map((c, i) => ({ c, r: radii[i], angle: Math.PI / 4 }));
    this.placed = [];
    this.shown = [0, radii[0]];
  }

  pressed(name) {
    const { ball } = this.controls, [left, bottom, right, top] = this.view.box;
    if (name === "add") {
      if (this.balls.length >= this.given.most) { this.say(this.words.full); return false; }
      const aside = 0.06 * (top - bottom) * ((this.balls.length % 5) - 2); // beside the last one that was added
      const c = [(left + right) / 2 + aside, (bottom + top) / 2 + aside];
      this.balls.push({ c, r: 0.12 * (top - bottom), angle: Math.PI / 4 });
      this.choose(this.balls.length - 1);
    } else if (name === "remove") {
      if (this.balls.length === 1) { this.say(this.words.last); return false; }
      this.balls.splice(ball.value, 1);
      this.choose(Math.min(ball.value, this.balls.length - 1));
    }
    return true;
  }

  choose(index) {
    const { ball } = this.controls;
    this.placed = [];
    ball.fill(this.balls.map((_, i) => [fill(this.words.ball, { i: i + 1 }), i]));
    ball.set(index);
  }

  redraw() {
    this.takeOver();
    const { balls } = this, found = ballSkeleton(balls.map(({ c, r }) => ({ c, r })));
    this.placeHandles();
    this.draw("spokes", { lines: balls.map((_, i) => [this.placed[2 * i], this.placed[2 * i + 1]]) });
    const circles = balls.map(({ c, r }) => [c, r]);
    this.draw("balls", { circles });
    this.draw("rims", { circles });
    this.draw("boundary", { arcs: found.arcs.map(([i, start, end]) => [balls[i].c, balls[i].r, start, end]) });
    this.draw("voronoi", { lines: this.voronoi(found.singular) }, this.value("voronoi"));
    this.draw("singular", { points: found.singular });
    if (found.refused) {
      this.draw("skeleton", {});
      const pairs = found.touching.map((pair) => pair.map((k) => k + 1).sort((a, b) => a - b));
      const [first] = pairs.sort((p, q) => p[0] - q[0] || p[1] - q[1]);
      this.say(first ? fill(this.words.tangent, { i: first[0], j: first[1] }) : this.words.crowded);
      return;
    }
    this.draw("skeleton", { lines: found.segments, points: found.dots });
    this.tell("", {
      balls: balls.length,
      needed: found.needed,
      area: found.area,
      singular_points: found.singular.length,
      disconnected_balls: found.disconnected,
      quasi_disconnected_pairs: found.quasiDisconnected,
      Betti_numbers: found.betti,
    });
  }

  voronoi(points) {
    const t = delaunay(points);
    if (!t) return [];
    return voronoiEdges(t, circumballs(t), facetTable(t));
  }

  /** Read the handle that was dragged, or the slider that was moved. */
  takeOver() {
    const { ball, radius } = this.controls, { handles, placed } = this;
    if (handles.length === placed.length) {
      handles.forEach((place, k) => {
        if (String(place) === String(placed[k])) return;
        const i = k >> 1, moved = this.balls[i];
        if (k % 2) {
          const way = [place[0] - moved.c[0], place[1] - moved.c[1]];
          moved.angle = Math.atan2(way[1], way[0]);
          moved.r = Math.max(Math.hypot(...way), radius.min);
        } else moved.c = [...place];
        ball.set(i);
      });
    }
    const i = ball.value, chosen = this.balls[i];
    // The slider moves to the nearest of its steps by itself: that is not the reader's hand.
    if (this.shown[0] === i && Math.abs(radius.value - this.shown[1]) > 0.51 * radius.step) chosen.r = radius.value;
    else if (this.shown[0] !== i || chosen.r !== this.shown[1]) radius.set(chosen.r);
    this.shown = [i, Math.min(Math.max(chosen.r, radius.min), radius.max)];
  }

  /** Centre and rim of every ball; a rim whose place is off the board is turned to where it is on it. */
  placeHandles() {
    const [left, bottom, right, top] = this.view.box, labels = [], places = [];
    this.balls.forEach(({ c, r, angle }, k) => {
      const rims = Array.from({ length: 8 }, (_, turn) => angle + (turn * Math.PI) / 4);
      const spots = rims.map((a) => [c[0] + r * Math.cos(a), c[1] + r * Math.sin(a)]);
      const seen = spots.find(([x, y]) => x >= left && x <= right && y >= bottom && y <= top);
      places.push([...c], seen ?? spots[0]);
      labels.push(...["centre", "rim"].map((part) => fill(this.words[part], { i: k + 1 })));
    });
    this.placed = places.map(([x, y]) => [Math.min(Math.max(x, left), right), Math.min(Math.max(y, bottom), top)]);
    this.model.set("handle_labels", labels);
    this.model.set("handles", this.placed.map((place) => [...place]));
  }
}
