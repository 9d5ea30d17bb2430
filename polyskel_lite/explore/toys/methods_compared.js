// The four skeletons side by side, and their numbers; mirrors explorers/methods_compared.py.

import { polygonCrosses, sampleRings } from "./boundary.js";
import { sk0, voronoiInShape } from "./inside.js";
import { bettiOf, circumballs, delaunay } from "./plane.js";
import { fill, sidesOf, Toy } from "./toy.js";

export class FourMethods extends Toy {
  redraw() {
    const { rings, offsets, heading, betti } = this.given;
    this.segments ??= sidesOf(rings);
    const polygons = sampleRings(rings, this.value("n"), this.value("start")), E = polygons.flat();
    const found = this.skeletons(E, polygons);
    const shifted = (name) => ([x, y]) => [x + offsets[name][0], y + offsets[name][1]];
    this.draw("samples", { points: Object.keys(offsets).flatMap((name) => E.map(shifted(name))) });
    const said = Object.keys(offsets).map((name) => {
      const { lines = [], points = [], missing, counts } = found[name], at = shifted(name);
      this.draw(name, { lines: lines.map((line) => line.map(at)), points: points.map(at) });
      const sentence = counts ? "counts" : !missing ? "crosses" : missing === 1 ? "missing_1" : "missing";
      const words = fill(this.words[sentence], { name: `Sk${name[2]}`, missing, ...counts });
      this.draw(`heading_${name}`, { text: [[...at(heading), words]] });
      return words;
    });
    this.draw("missing", { lines: found.sides.map((side) => side.map(shifted("sk0"))) });
    this.model.set("alt", fill(this.words.alt, { n: E.length, all: said.join("; ") }));
    this.say(fill(this.words.line, { betti, all: said.join(" · ") }), found);
  }

  skeletons(E, polygons) {
    const { balls, inside, edges, pieces } = voronoiInShape(this.segments, delaunay(E));
    const used = balls.flatMap((_, i) => (inside[i] ? [i] : [])), number = new Map(used.map((i, k) => [i, k]));
    const between = ([a, b]) => [balls[a].center, balls[b].center];
    const counted = (vertices, pairs) => ({ vertices, edges: pairs.length, betti: bettiOf(vertices, pairs) });
    const inner = edges.map((pair) => pair.map((i) => number.get(i)));
    // Where the boundary cuts an edge, a vertex is added.
    let cuts = used.length;
    const cut = pieces.map(({ ends }) => ends.map((end) => (end < 0 ? cuts++ : number.get(end))));
    const found = {
      sk1: { points: used.map((i) => balls[i].center), counts: counted(used.length, []) },
      sk2: { lines: edges.map(between), counts: counted(used.length, inner) },
      sk3: {
        lines: [...edges.map(between), ...pieces.map(({ line }) => line)],
        counts: counted(cuts, [...inner, ...cut]),
      },
      sk0: {},
      sides: [],
    };
    let first = 0;
    const facets = polygons.flatMap(({ length }) => {
      const start = first;
      first += length;
      return Array.from({ length }, (_, k) => [start + k, start + ((k + 1) % length)]);
    });
    if (polygonCrosses(E, facets)) return found;
    const dual = sk0(E, facets);
    found.sides = dual.missing.map(([a, b]) => [E[a], E[b]]);
    if (found.sides.length) found.sk0 = { missing: found.sides.length };
    else {
      const kept = dual.inner.flatMap((is, i) => (is ? [i] : [])), row = new Map(kept.map((i, k) => [i, k]));
      const own = circumballs(dual.tessellation);
      found.sk0 = {
        lines: dual.edges.map(([a, b]) => [own[a].center, own[b].center]),
        counts: counted(kept.length, dual.edges.map((pair) => pair.map((i) => row.get(i)))),
      };
    }
    return found;
  }
}
