// Elementary removals one at a time; mirrors explorers/removing.py and simplification/removals.py.

import { bettiOf } from "./plane.js";
import { fill, said, Toy } from "./toy.js";

export class Removals extends Toy {
  redraw() {
    const { order, points, corners, centers, radii, simplices, aside } = this.given;
    const step = this.value("step"), chosen = this.value("triangle");
    const { left, lengths } = this.stateAt(step);
    const marked = chosen < 0 ? order[step] ?? -1 : simplices.indexOf(chosen);
    const removal = marked >= 0 && left[marked] ? this.tryRemoval(marked, left, lengths) : null;
    const beside = ([x, y]) => [x + aside[0], y + aside[1]];
    const triangle = (v) => corners[v].map((k) => points[k]);
    const alive = left.flatMap((is, v) => (is ? [v] : [])), row = removal ? [marked] : [];
    const pairs = this.edgesOf(left), line = (pair) => pair.map((v) => beside(centers[v]));
    this.draw("triangles", { polygons: alive.map(triangle) });
    this.draw("marked", { polygons: row.map(triangle) });
    this.draw("ball", { circles: row.map((v) => [centers[v], radii[v]]) });
    this.draw("skeleton", { lines: pairs.map(line), points: alive.map((v) => beside(centers[v])) });
    const going = pairs.filter((pair) => removal && pair.includes(marked));
    this.draw("goes", { lines: going.map(line), points: row.map((v) => beside(centers[v])) });
    this.say(this.sentence(step, chosen, removal), { gone: step, left: alive.length, ...removal });
  }

  /** Which triangles are left after the first removals, and the boundary length each stands for. */
  stateAt(step) {
    const { near, order } = this.given, left = near.map(() => true), lengths = [...this.given.lengths];
    for (const v of order.slice(0, step)) {
      left[v] = false;
      const heir = near[v].find((w) => w >= 0 && left[w]); // a hat has one neighbour left
      if (heir !== undefined) lengths[heir] += lengths[v];
    }
    return { left, lengths };
  }

  edgesOf(left) {
    return this.given.near.flatMap((row, v) => row.flatMap((w) => (w > v && left[v] && left[w] ? [[v, w]] : [])));
  }

  tryRemoval(v, left, lengths) {
    const { near, radii, simplices, level } = this.given, without = left.map((is, w) => is && w !== v);
    const shared = near[v].filter((w) => w >= 0 && left[w]).length;
    const value = lengths[v] / radii[v];
    return { triangle: simplices[v], shared, length: lengths[v], radius: radii[v], value, level: level[v],
      before: this.betti(left), after: this.betti(without) };
  }

  betti(left) {
    const number = new Map(left.flatMap((is, v) => (is ? [v] : [])).map((v, k) => [v, k]));
    return bettiOf(number.size, this.edgesOf(left).map((pair) => pair.map((v) => number.get(v))));
  }

  sentence(step, chosen, removal) {
    const { words } = this, parts = [fill(words.gone, { step, all: this.given.order.length })];
    if (!removal) {
      return [...parts, fill(words[chosen < 0 ? "no_hat" : "not_there"], { triangle: chosen })].join(" ");
    }
    const { shared, length, radius, value, level, before, after } = removal, turns = (x) => (x / Math.PI).toFixed(2);
    parts.push(fill(words[shared === 1 ? "may" : "must"], { ...removal, kind: words[`kind_${shared}`] }));
    if (shared === 1) {
      const ratio = fill(words.value, { length: said(length, 3), radius: said(radius, 3), value: turns(value) });
      parts.push(fill(words[level > value * (1 + 1e-9) ? "waited" : "goes"], { value: ratio, level: turns(level) }));
    }
    const verdict = words[String(before) === String(after) ? "stays" : "changes"];
    return [...parts, fill(words.betti, { before, after, verdict })].join(" ");
  }
}
