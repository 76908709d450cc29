// The tools that measure: a distance of two points on the surface, a path along vessels, a diameter.

import { distance, mixed } from "./vector.js";
import { lengthText } from "./text.js";

export const kMeasuring = {
  distance: { label: "Distance", hint: "Click two points." },
  path: { label: "Path", hint: "Click two vessels: the way along the centerlines between them is measured." },
  diameter: { label: "Diameter", hint: "Click a vessel." },
};

/** A path between two places { branch, fraction } as a measurement; null if no vessels connect them. */
export function pathMeasurement(model, from, to) {
  const path = model.tree.path(from, to);
  if (!path) return null;
  return {
    kind: "path", name: `Path ${model.nameOf(from.branch)} to ${model.nameOf(to.branch)}`, length_mm: path.length_mm, branches: path.branches,
    points: [path.points[0], path.points[path.points.length - 1]], lines: [path.points], label_at: path.points[path.points.length >> 1], text: lengthText(path.length_mm, model.claims),
  };
}

/** The straight distance of two points (mm). */
export const distanceMeasurement = (model, p, q) =>
  ({ kind: "distance", name: "Distance", points: [p, q], lines: [[p, q]], label_at: mixed(p, q, 0.5), length_mm: distance(p, q), text: lengthText(distance(p, q), model.claims) });

/** The diameter of a branch at a point on or near its surface. */
export function diameterMeasurement(model, branch, point) {
  const fraction = model.tree.nearestFraction(branch, point), place = model.tree.place(branch, fraction);
  if (!place) return null;
  return { kind: "diameter", name: `Diameter of ${model.nameOf(branch)}`, points: [place.at], lines: [model.tree.ring(branch, fraction, 1)], label_at: place.at,
    length_mm: 2 * place.radius, text: `⌀ ${lengthText(2 * place.radius, model.claims)}` };
}

/** Collects the clicks of a tool. `done(measurement)`, `say(text)`. */
export class Measuring {
  constructor(model, { done, say, draft }) {
    Object.assign(this, { model, done, say, draft });
    this.clicks = [];
  }

  begin(kind) {
    this.kind = kind;
    this.clicks = [];
    this.draft(null);
    if (kMeasuring[kind]) this.say(kMeasuring[kind].hint);
  }

  /** A click on `pick` of viewport.js. */
  click(pick) {
    if (!pick || !pick.point) return this.say("Nothing is there. " + kMeasuring[this.kind].hint);
    if (this.kind !== "distance" && pick.branch === null) return this.say("That is no vessel. " + kMeasuring[this.kind].hint);
    if (this.kind === "diameter") return this.#finish(diameterMeasurement(this.model, pick.branch, pick.point));
    this.clicks.push(pick);
    if (this.clicks.length < 2) {
      this.draft({ points: [pick.point] });
      return this.say("Now the second point.");
    }
    const [a, b] = this.clicks, place = (one) => ({ branch: one.branch, fraction: this.model.tree.nearestFraction(one.branch, one.point) });
    const made = this.kind === "distance" ? distanceMeasurement(this.model, a.point, b.point) : pathMeasurement(this.model, place(a), place(b));
    if (!made) {
      this.begin(this.kind);
      return this.say("No vessels connect these two.");
    }
    this.#finish(made);
  }

  #finish(made) {
    this.clicks = [];
    this.draft(null);
    if (!made) return;
    this.done(made);
    this.say(`${made.name}: ${made.text}`);
  }
}
