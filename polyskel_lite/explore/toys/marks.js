// Layers of a picture as SVG with the pens that Python hands over; mirrors drawing_board/marks.py.

export class View {
  constructor({ box, size }) {
    this.box = box;
    this.scale = size[0] / (box[2] - box[0]);
    const room = 0.1 * (box[2] - box[0]);
    this.low = [box[0] - room, box[1] - room];
    this.high = [box[2] + room, box[3] + room];
  }

  place([x, y]) {
    const unit = (value) => Math.round(Math.min(Math.max(value * this.scale, -1e7), 1e7)) || 0;
    return `${unit(x - this.box[0])} ${unit(this.box[3] - y)}`;
  }

  length(length) { return Math.round(Math.min(Math.max(length * this.scale, 0), 1e7)); }

  /** A segment cut to what is in sight, or null: browsers draw lines of a million pixels slowly. */
  cut([p, q]) {
    let enter = 0, leave = 1;
    if (![...p, ...q].every(Number.isFinite)) return null;
    for (const k of [0, 1]) {
      const step = q[k] - p[k];
      if (step === 0 && (p[k] < this.low[k] || p[k] > this.high[k])) return null;
      if (step === 0) continue;
      const [u, v] = [(this.low[k] - p[k]) / step, (this.high[k] - p[k]) / step];
      enter = Math.max(enter, Math.min(u, v));
      leave = Math.min(leave, Math.max(u, v));
    }
    const at = (t) => [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
    return enter < leave ? [at(enter), at(leave)] : null;
  }
}

/** SVG elements of one layer: { polygons, circles, lines, arcs, points, text }, one or more of them. */
export function fragment(contents, pen, view) {
  const { polygons = [], circles = [], lines = [], arcs = [], points = [], text = [] } = contents;
  const at = (p) => view.place(p);
  const disc = ([[x, y], radius]) => {
    const r = view.length(radius);
    const [left, top] = at([x, y]).split(" ");
    return `M${left - r} ${top}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
  };
  // In two halves: SVG draws no arc whose ends are one point.
  const arc = ([[x, y], radius, start, end]) => {
    const stops = [start, (start + end) / 2, end].map((t) => at([x + radius * Math.cos(t), y + radius * Math.sin(t)]));
    const r = view.length(radius);
    return `M${stops[0]}A${r} ${r} 0 0 0 ${stops[1]}A${r} ${r} 0 0 0 ${stops[2]}`;
  };
  const segments = lines.map((line) => view.cut(line)).filter(Boolean);
  const paths = {
    polygons: polygons.map((ring) => `M${ring.map(at).join(" ")}z`).join(""),
    circles: circles.map(disc).join(""),
    lines: segments.map(([p, q]) => `M${at(p)}L${at(q)}`).join("") + arcs.map(arc).join(""),
    points: points.map((p) => `M${at(p)}${pen.mark}`).join(""),
  };
  const written = text.map(([x, y, words]) => {
    const [left, top] = at([x, y]).split(" ");
    return `<text x="${left}" y="${top}" ${pen.text}>${words}</text>`;
  });
  const body = Object.entries(paths).filter(([, d]) => d).map(([name, d]) => `<path d="${d}" ${pen[name]}/>`);
  if (pen.core && paths.lines) body.push(`<path d="${paths.lines}" ${pen.core}/>`);
  const all = body.join("") + written.join("");
  return all && pen.opacity !== "1" ? `<g opacity="${pen.opacity}">${all}</g>` : all;
}
