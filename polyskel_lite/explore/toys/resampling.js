// How number, place and noise of the samples change the skeleton; mirrors explorers/resampling.py.

import { coveringRadius, sampleRings } from "./boundary.js";
import { voronoiInShape } from "./inside.js";
import { bettiOf, delaunay } from "./plane.js";
import { fill, sidesOf, Toy } from "./toy.js";

export class Sampling extends Toy {
  samples() {
    const [n, start, noise] = ["n", "start", "noise"].map((name) => this.value(name));
    const { rings, size, shifts } = this.given;
    const shift = (i, k) => (noise ? 0.01 * noise * size * shifts[i][k] : 0);
    return sampleRings(rings, n, start).flat().map(([x, y], i) => [x + shift(i, 0), y + shift(i, 1)]);
  }

  redraw() {
    this.segments ??= sidesOf(this.given.rings);
    const E = this.samples(), polyball = this.value("polyball");
    const { balls, inside, edges } = voronoiInShape(this.segments, delaunay(E));
    const used = balls.flatMap((_, i) => (inside[i] ? [i] : [])), radius = coveringRadius(this.segments, E);
    const number = new Map(used.map((i, k) => [i, k])), degree = new Uint8Array(used.length);
    const pairs = edges.map((pair) => pair.map((i) => number.get(i)));
    for (const v of pairs.flat()) degree[v] += 1;
    const betti = bettiOf(used.length, pairs);
    this.draw("samples", { points: E });
    this.draw("skeleton", { lines: edges.map(([a, b]) => [balls[a].center, balls[b].center]) });
    this.draw("polyball", { circles: polyball ? used.map((i) => [balls[i].center, balls[i].r]) : [] });
    const values = { n: E.length, pieces: betti[0], loops: betti[1] };
    this.model.set("alt", fill(this.words[polyball ? "alt_with_balls" : "alt"], values));
    this.tell("", {
      n: E.length,
      covering_radius: radius,
      density_w: 1 / radius,
      vertices: used.length,
      edges: edges.length,
      ends: degree.filter((count) => count === 1).length,
      Betti_numbers_of_Sk2: betti,
      those_of_the_shape: this.given.betti,
    });
  }
}
