// Delaunay, Voronoi and Gabriel graph over points that the reader moves; mirrors explorers/moving_samples.py.

import { circumballs, delaunay, facetTable, gabrielMask, voronoiEdges } from "./plane.js";
import { fill, Toy } from "./toy.js";

export class Graphs extends Toy {
  redraw() {
    const t = delaunay(this.handles);
    if (!t) {
      for (const name of Object.keys(this.pens)) this.draw(name, {});
      const places = this.handles.map(String), twice = places.findIndex((place, k) => places.indexOf(place) < k);
      const [i, j] = [places.indexOf(places[twice]), twice];
      this.say(twice < 0 ? this.words.in_line : fill(this.words.twice, { i, j }));
      return;
    }
    const table = facetTable(t), balls = circumballs(t), gabriel = gabrielMask(t, table), { points } = t;
    const remark = this.follow(t);
    const sides = (rows) => rows.map(({ ends: [a, b] }) => [points[a], points[b]]);
    const lines = {
      delaunay: sides(table),
      voronoi: voronoiEdges(t, balls, table),
      gabriel: sides(table.filter((_, i) => gabriel[i])),
    };
    const chosen = Object.keys(lines).filter((name) => this.value(name));
    for (const name of Object.keys(lines)) this.draw(name, { lines: lines[name] }, this.value(name));
    const number = this.value("triangle"), ball = number < 0 ? null : balls[this.rows[number].row];
    this.draw("ball", { circles: ball ? [[ball.center, ball.r]] : [] });
    this.draw("center", { points: ball ? [ball.center] : [] });
    const graphs = chosen.map((name) => this.given.graphs[name]).join(", ") || this.words.none;
    this.model.set("alt", fill(this.words[ball ? "alt_with_ball" : "alt"], { n: points.length, graphs, number }));
    this.tell(remark, {
      samples: points.length,
      triangles: t.simplices.length,
      Delaunay_segments: table.length,
      Gabriel_segments: lines.gabriel.length,
      Voronoi_vertices: t.simplices.length,
      ...(ball ? { radius_of_the_ball: ball.r } : {}),
    });
  }

  /** Keep the ball on its triangle while samples move; a sentence when that triangle is gone. */
  follow({ simplices }) {
    const slider = this.controls.triangle;
    this.rows = simplices.map((corners, row) => ({ row, corners: [...corners].sort((a, b) => a - b) }));
    this.rows.sort(({ corners: a }, { corners: b }) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2]);
    const moved = slider.value !== this.number; // by the reader's hand
    slider.reach(this.rows.length - 1);
    if (slider.value < 0) {
      this.number = -1;
      return "";
    }
    let lost = "";
    if (!moved) {
      const now = this.rows.findIndex(({ corners }) => String(corners) === String(this.corners));
      if (now >= 0) slider.set(now);
      else lost = fill(this.words.lost, { rest: this.corners.slice(0, -1).join(", "), last: this.corners.at(-1) });
    }
    this.number = slider.value;
    this.corners = this.rows[slider.value].corners;
    return lost;
  }
}
