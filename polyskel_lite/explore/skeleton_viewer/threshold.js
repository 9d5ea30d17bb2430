// Thresholds: how they are written and read, and where they stand along the slider.

import { PI, clamp } from "./camera.js";

export const STEPS = 400; // of the slider
/** The round angles that paper and book speak of. */
export const TICKS = [["π/3", PI / 3], ["2π/3", (2 * PI) / 3], ["π", PI], ["2π", 2 * PI]];
const LINEAR = 0.8; // the share of the slider up to its knee

export const multiple = (t) => (t === -Infinity ? "none" : `${Number((t / PI).toFixed(3))} π`);

/** What was typed, as a threshold, or why it is none. The π may be left out; nothing at all removes nothing. */
export function typed(text) {
  const plain = text.trim().toLowerCase().replace(/\s/g, "").replace(/π/g, "pi").replace(/[−–]/g, "-");
  if (plain === "" || plain === "none") return { threshold: -Infinity };
  const number = String.raw`(\d+\.?\d*|\.\d+)`;
  const [all, minus, times, pi, over] = plain.match(new RegExp(`^(-?)${number}?\\*?(pi)?(?:/${number})?$`)) ?? [];
  const threshold = (Number(times ?? 1) * PI) / Number(over ?? 1);
  if (all === undefined || (times === undefined && !pi) || !Number.isFinite(threshold)) {
    return { problem: `“${text.trim()}” cannot be read. Type a multiple of π, such as 1.5, or pi/3, 2pi/3, 2π.` };
  }
  if (minus && threshold > 0) {
    return { problem: "A threshold is never negative. Type 0 or more, such as 1.5 or pi/3; an empty field removes nothing." };
  }
  return { threshold };
}

/** The slider: even up to the knee, on most of its length; from there to the largest level by factors. */
export class Track {
  constructor({ largest, knee, systematic }) {
    const bent = largest > knee / LINEAR;
    Object.assign(this, { largest, bent, knee: bent ? knee : largest, linear: bent ? LINEAR : 1 });
    this.first = systematic ? 1 : 0; // the step before removes not even what goes without a threshold
  }

  /** Where a threshold stands, from 0 to 1. */
  share(t) {
    const { knee, largest, linear } = this, inside = clamp(t, 0, largest);
    if (inside <= knee) return (linear * inside) / knee;
    return linear + (1 - linear) * (Math.log(inside / knee) / Math.log(largest / knee));
  }

  /** The step of a threshold. */
  step(t) { return t === -Infinity ? 0 : this.first + Math.round((STEPS - this.first) * this.share(t)); }

  /** The threshold of a step: a round angle if that is the nearest, else a multiple of π / 1000. */
  at(step) {
    const { knee, largest, linear, first } = this, share = (step - first) / (STEPS - first);
    if (share < 0) return -Infinity;
    const round = TICKS.find(([, t]) => t < largest && this.step(t) === step);
    if (round) return round[1];
    const t = share <= linear ? (knee * share) / linear : knee * (largest / knee) ** ((share - linear) / (1 - linear));
    return (Math.round((1000 * t) / PI) / 1000) * PI;
  }
}
