// A ball grows from a centre that the reader drags until it is maximal; mirrors explorers/growing_ball.py.

import { contacts, grow } from "./boundary.js";
import { distance, locate } from "./inside.js";
import { fill, said, sidesOf, Toy } from "./toy.js";

export class MaximalBall extends Toy {
  redraw() {
    const segments = (this.segments ??= sidesOf(this.given.rings)), [start] = this.handles, { box } = this.view;
    const width = box[2] - box[0];
    if (!this.value("trace")) this.seen = [];
    this.show("skeleton", this.value("skeleton"));
    if (locate(segments, start) < 0 || Math.min(...segments.map((s) => distance(start, s))) < this.given.edge * width) {
      this.drawBall(start, 0, []);
      this.model.set("alt", this.words.alt_outside);
      this.say(this.words.outside);
      return;
    }
    const { radius, center, full } = grow(segments, start);
    const moved = Math.hypot(center[0] - start[0], center[1] - start[1]);
    const there = moved <= this.given.snap * width, share = there ? 1 : this.value("growth");
    if (this.value("trace")) this.seen = [...this.seen.slice(-1999), center];
    const size = radius + share * (full - radius);
    const at = [0, 1].map((k) => start[k] + share * (center[k] - start[k]));
    const touched = contacts(segments, at, size);
    this.drawBall(at, size, touched);
    const values = { radius: said(size), contacts: touched.length, kept: this.seen.length };
    this.model.set("alt", fill(this.words[this.seen.length ? "alt_with_trace" : "alt"], values));
    this.tell(this.words[there ? "there" : share === 1 ? "grown" : "growing"], {
      contacts: touched.length,
      radius: size,
      radius_at_the_dot: radius,
      distance_from_the_dot_to_the_skeleton: moved,
    });
  }

  drawBall(center, radius, touched) {
    this.draw("ball", { circles: radius ? [[center, radius]] : [] });
    this.draw("contacts", { points: touched });
    this.draw("way", { lines: radius ? [[this.handles[0], center]] : [] });
    this.draw("trace", { points: this.seen });
  }
}
