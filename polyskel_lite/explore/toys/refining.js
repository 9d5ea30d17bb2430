// Refinement step by step, as Python recorded it; mirrors explorers/refining.py.

import { Toy } from "./toy.js";

export class Refinement extends Toy {
  redraw() {
    const { points, stages } = this.given.rounds[this.value("graph")];
    this.controls.step.reach(stages.length - 1);
    const step = this.value("step"), stage = stages[step], old = stages[Math.max(step - 1, 0)].samples;
    const gone = new Set(stage.missing), side = (row) => stage.facets[row].map((v) => points[v]);
    const missing = stage.missing.map(side);
    const middle = ([p, q]) => [[(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], Math.hypot(q[0] - p[0], q[1] - p[1]) / 2];
    this.draw("balls", { circles: missing.map(middle) }, this.value("balls"));
    this.draw("there", { lines: stage.facets.flatMap((_, row) => (gone.has(row) ? [] : [side(row)])) });
    this.draw("missing", { lines: missing });
    this.draw("samples", { points: points.slice(0, old) });
    this.draw("added", { points: points.slice(old, stage.samples) });
    this.draw("intruders", { points: stage.intruders.map((v) => points[v]) });
    this.say(stage.text, { step });
  }
}
