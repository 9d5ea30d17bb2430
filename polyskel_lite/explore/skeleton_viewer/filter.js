// What a threshold leaves.
//
// What is shown follows from one number, the cut: how many simplices the threshold removes. Python sends the
// removal order of each hierarchy (rank) and the levels in that order, so the browser finds the cut by
// bisection in double precision and shows exactly what Hierarchy.skeleton(threshold) has. Polygons and edges
// are sorted by rank once; a threshold is then the length of a prefix, and nothing is sent to the GPU again
// but the few wires and facets that appear.

/** First position in a sorted array whose value is at least x. */
function bisect(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < x) low = middle + 1; else high = middle;
  }
  return low;
}

/** Numbers 0..n-1 sorted by a whole number each, largest first. */
function sortedDown(keys, largest) {
  const start = new Uint32Array(largest + 2), order = new Uint32Array(keys.length);
  for (const k of keys) start[largest - k + 1]++;
  for (let k = 0; k <= largest; k++) start[k + 1] += start[k];
  keys.forEach((k, i) => { order[start[largest - k]++] = i; });
  return order;
}

/** Which elements of a scene a hierarchy keeps. */
export class Filter {
  constructor(scene, header, rank, levels) {
    Object.assign(this, { scene, header, label: header.label, levels: levels ?? new Float64Array(0) });
    const { edges, corners, starts, sizes, sides, count } = scene;
    const last = this.levels.length; // the rank of what never goes
    this.rank = rank ?? new Uint8Array(count).fill(0);
    const E = edges.length / 2, P = sizes.length;
    this.edgeRank = new Uint32Array(E);
    for (let e = 0; e < E; e++) this.edgeRank[e] = Math.min(this.rank[edges[2 * e]], this.rank[edges[2 * e + 1]]);
    const polygonRank = new Uint32Array(P).fill(last);
    this.edgeCover = new Int32Array(E).fill(-1); // the rank of the longest-lived polygon on it
    this.vertexCover = new Int32Array(count).fill(-1);
    for (let p = 0; p < P; p++) {
      for (let i = starts[p]; i < starts[p + 1]; i++) polygonRank[p] = Math.min(polygonRank[p], this.rank[corners[i]]);
      for (let i = starts[p]; i < starts[p + 1]; i++) {
        const v = corners[i], e = sides[i], r = polygonRank[p];
        if (r > this.vertexCover[v]) this.vertexCover[v] = r;
        if (e >= 0 && r > this.edgeCover[e]) this.edgeCover[e] = r;
      }
    }
    this.polygonOrder = sortedDown(polygonRank, last);
    this.edgeOrder = sortedDown(this.edgeRank, last);
    const ascending = (order, ranks) => Uint32Array.from(order, (i) => ranks[i]).reverse();
    this.polygonSorted = ascending(this.polygonOrder, polygonRank);
    this.edgeSorted = ascending(this.edgeOrder, this.edgeRank);
    this.vertexSorted = Uint32Array.from(this.rank).sort();
    this.fans = null;
  }

  /** How many simplices a threshold removes. */
  cut(threshold) { return bisect(this.levels, threshold); }

  kept(sorted, cut) { return sorted.length - bisect(sorted, cut); }

  counts(cut) {
    const { edges, count } = this.scene;
    const E = this.kept(this.edgeSorted, cut), degree = new Uint8Array(count);
    for (let k = 0; k < E; k++) {
      const e = this.edgeOrder[k], a = edges[2 * e], b = edges[2 * e + 1];
      if (degree[a] < 3) degree[a]++;
      if (degree[b] < 3) degree[b]++;
    }
    let ends = 0, lone = 0;
    for (let v = 0; v < count; v++) {
      if (degree[v] > 1 || this.rank[v] < cut) continue;
      if (degree[v] === 0) lone++;
      else if (this.vertexCover[v] < cut) ends++;
    }
    return {
      vertices: this.kept(this.vertexSorted, cut), edges: E, polygons: this.kept(this.polygonSorted, cut), branches: ends, lone,
    };
  }

  /** Triangles of all polygons, the longest-lived first, and how many belong to the first k polygons. */
  triangles() {
    if (this.fans) return this.fans;
    const { corners, starts, sizes } = this.scene;
    let total = 0;
    for (const size of sizes) total += Math.max(size - 2, 0);
    const index = new Uint32Array(3 * total), upTo = new Uint32Array(sizes.length + 1);
    let at = 0;
    this.polygonOrder.forEach((p, k) => {
      for (let i = starts[p] + 1; i + 1 < starts[p + 1]; i++) {
        index[at++] = corners[starts[p]]; index[at++] = corners[i]; index[at++] = corners[i + 1];
      }
      upTo[k + 1] = at;
    });
    return (this.fans = { index, upTo });
  }

  /** Edges that are kept and bound no kept polygon. */
  wires(cut) {
    const out = [], E = this.kept(this.edgeSorted, cut);
    for (let k = 0; k < E; k++) {
      const e = this.edgeOrder[k];
      if (this.edgeCover[e] < cut) out.push(e);
    }
    return out;
  }

  /** Vertices that are kept without an edge; they would not be seen otherwise. */
  lone(cut) {
    const { edges, count } = this.scene, joined = new Uint8Array(count), E = this.kept(this.edgeSorted, cut);
    for (let k = 0; k < E; k++) { const e = this.edgeOrder[k]; joined[edges[2 * e]] = joined[edges[2 * e + 1]] = 1; }
    return Uint32Array.from({ length: count }, (_, v) => v).filter((v) => this.rank[v] >= cut && !joined[v]);
  }

  keptVertices(cut) {
    return Uint32Array.from({ length: this.scene.count }, (_, v) => v).filter((v) => this.rank[v] >= cut);
  }

  /** The ends of all edges, the longest-lived first. */
  sides() {
    const { edges } = this.scene, out = new Uint32Array(edges.length);
    this.edgeOrder.forEach((e, i) => { out[2 * i] = edges[2 * e]; out[2 * i + 1] = edges[2 * e + 1]; });
    return out;
  }

  /** Whether a simplex is in the simplified shape: always if it has no vertex, as the skeleton is not the shape's dual. */
  remains(simplex, cut) { return (this.rank[simplex] ?? Infinity) >= cut; }

  /** In the plane, the triangles of the simplified shape. */
  region(cut) {
    if (this.scene.fill) return this.scene.fill;
    return this.scene.simplices.filter((_, i) => this.remains(Math.floor(i / 3), cut));
  }

  /** Facets of the boundary of the simplified shape, flat, turned outward. */
  boundary(cut) {
    const { facets, owners, dimension: N, surface } = this.scene, out = [];
    if (surface) return surface;
    for (let f = 0; f < owners.length / 2; f++) {
      const a = owners[2 * f], b = owners[2 * f + 1];
      const first = this.remains(a, cut), second = b >= 0 && this.remains(b, cut);
      if (first === second) continue;
      for (let k = 0; k < N; k++) out.push(facets[N * f + (second && k < 2 ? 1 - k : k)]);
    }
    return Uint32Array.from(out);
  }
}
