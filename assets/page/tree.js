// Questions about the tree: what depends on a branch, the way to the root, paths along vessels, places on centerlines.
// The answers are those of ramus (core/tree/dependency.h, core/measure/tree_measure.h). Branches are numbers; lengths mm.

import { along, mixed, nearestOnLine, subtract, unit } from "./vector.js";

export class Tree {
  /**
   * `json`: branches with parent, children, length_mm and the nodes that they go from and to; order, in which the dependents
   * of a branch follow it; dependents, how many, in that order. `lines`: centerlines as decode.js has them.
   */
  constructor({ branches, order, dependents }, lines) {
    Object.assign(this, { branches, order, lines });
    this.nodes = branches.map(({ from, to }) => [from, to]);
    this.rank = new Uint32Array(order.length);
    this.dependents = new Uint32Array(order.length); // by branch
    order.forEach((id, rank) => {
      this.rank[id] = rank;
      this.dependents[id] = dependents[rank];
    });
    this.roots = branches.map((_, id) => id).filter((id) => branches[id].parent == null);
  }

  /** The branches and all that depends on them, ascending. In networks these can be reached only through the branches. */
  subtree(ids) {
    const inside = new Uint8Array(this.branches.length);
    for (const id of ids) for (const one of this.order.slice(this.rank[id], this.rank[id] + 1 + this.dependents[id])) inside[one] = 1;
    return listed(inside);
  }

  /** The branches and their way to the root, ascending. */
  upstream(ids) {
    const inside = new Uint8Array(this.branches.length);
    for (let id of ids) for (; id != null && !inside[id]; id = this.branches[id].parent) inside[id] = 1;
    return listed(inside);
  }

  /**
   * The shortest way along vessels between two places { branch, fraction }: { branches, length_mm, points }, or null if
   * no vessels connect them.
   */
  path(from, to) {
    const long = (b) => this.branches[b].length_mm;
    const meets = new Map(); // branches by node
    this.nodes.forEach((ends, b) => ends.forEach((node) => meets.has(node) ? meets.get(node).push(b) : meets.set(node, [b])));
    const best = new Map(), queue = new Queue();
    const offer = (node, far, via, before) => {
      if (best.has(node) && best.get(node).far <= far) return;
      best.set(node, { far, via, before });
      queue.push(far, node);
    };
    const [start, end] = this.nodes[from.branch];
    offer(start, from.fraction * long(from.branch), from.branch, null);
    offer(end, (1 - from.fraction) * long(from.branch), from.branch, null);
    let goal = from.branch === to.branch ? { far: Math.abs(from.fraction - to.fraction) * long(to.branch), direct: true } : null;
    const [first, last] = this.nodes[to.branch];
    for (let item = queue.pop(); item; item = queue.pop()) {
      const [far, node] = item;
      if (goal && far >= goal.far) break;
      if (best.get(node).far < far) continue;
      for (const [at, rest] of [[first, to.fraction], [last, 1 - to.fraction]])
        if (node === at && (!goal || far + rest * long(to.branch) < goal.far)) goal = { far: far + rest * long(to.branch), node, start: at === first ? 0 : 1 };
      for (const b of meets.get(node)) {
        if (b === from.branch || b === to.branch) continue;
        const [p, q] = this.nodes[b];
        offer(p === node ? q : p, far + long(b), b, node);
      }
    }
    if (!goal) return null;
    if (goal.direct) return { branches: [to.branch], length_mm: goal.far, points: this.stretch(to.branch, from.fraction, to.fraction) };
    const steps = [];
    for (let node = goal.node; node !== null; node = best.get(node).before) steps.unshift({ node, ...best.get(node) });
    const branches = steps.map((step) => step.via).concat(to.branch);
    const points = [];
    steps.forEach((step, i) => points.push(...(i === 0
      ? this.stretch(step.via, from.fraction, this.nodes[step.via][0] === step.node ? 0 : 1)
      : this.stretch(step.via, ...(this.nodes[step.via][1] === step.node ? [0, 1] : [1, 0])))));
    points.push(...this.stretch(to.branch, goal.start, to.fraction));
    return { branches, length_mm: goal.far, points };
  }

  /** Points of a branch's centerline with the fraction of its length at each: { at, radius, fraction }. */
  line(branch) {
    const { points, first } = this.lines, list = [];
    let far = 0;
    for (let i = first[branch]; i < first[branch + 1]; ++i) {
      const at = [points[4 * i], points[4 * i + 1], points[4 * i + 2]];
      if (list.length) far += Math.hypot(...subtract(at, list[list.length - 1].at));
      list.push({ at, radius: points[4 * i + 3], fraction: far });
    }
    for (const point of list) point.fraction /= far || 1;
    return list;
  }

  /** The place at a fraction of a branch: its point, radius and direction away from the parent. */
  place(branch, fraction) {
    const list = this.line(branch);
    if (list.length < 2) return null;
    let i = 1;
    while (i < list.length - 1 && list[i].fraction < fraction) ++i;
    const a = list[i - 1], b = list[i];
    const share = Math.min(1, Math.max(0, (fraction - a.fraction) / Math.max(b.fraction - a.fraction, 1e-12)));
    return { at: mixed(a.at, b.at, share), radius: a.radius + share * (b.radius - a.radius), direction: unit(subtract(b.at, a.at)) };
  }

  /** The fraction of a branch whose centerline point is nearest to `at`. */
  nearestFraction(branch, at) {
    const list = this.line(branch);
    let best = { distance: Infinity, fraction: 0.5 };
    for (let i = 1; i < list.length; ++i) {
      const near = nearestOnLine(at, list[i - 1].at, list[i].at);
      const fraction = list[i - 1].fraction + near.share * (list[i].fraction - list[i - 1].fraction);
      if (near.distance < best.distance) best = { distance: near.distance, fraction };
    }
    return best.fraction;
  }

  /** The centerline of a branch between two fractions, in that order. */
  stretch(branch, from, to) {
    const list = this.line(branch);
    if (list.length < 2) return [];
    const low = Math.min(from, to), high = Math.max(from, to);
    const inside = list.filter((point) => point.fraction > low && point.fraction < high).map((point) => point.at);
    const all = [this.place(branch, low).at, ...inside, this.place(branch, high).at];
    return from <= to ? all : all.reverse();
  }

  /** A ring around the vessel at a place, for cuts: points. */
  ring(branch, fraction, radii) {
    const place = this.place(branch, fraction);
    if (!place) return [];
    const { direction } = place, other = Math.abs(direction[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
    const u = unit([direction[1] * other[2] - direction[2] * other[1], direction[2] * other[0] - direction[0] * other[2], direction[0] * other[1] - direction[1] * other[0]]);
    const v = [direction[1] * u[2] - direction[2] * u[1], direction[2] * u[0] - direction[0] * u[2], direction[0] * u[1] - direction[1] * u[0]];
    return Array.from({ length: 49 }, (_, i) => along(along(place.at, u, radii * place.radius * Math.cos(i * Math.PI / 24)), v, radii * place.radius * Math.sin(i * Math.PI / 24)));
  }
}

const listed = (inside) => Array.from(inside.keys()).filter((b) => inside[b]);

// A binary heap of [key, value], the smallest key first.
class Queue {
  #items = [];
  push(key, value) {
    const items = this.#items;
    let i = items.push([key, value]) - 1;
    for (let up = (i - 1) >> 1; i > 0 && items[up][0] > items[i][0]; i = up, up = (i - 1) >> 1)
      [items[up], items[i]] = [items[i], items[up]];
  }
  pop() {
    const items = this.#items, top = items[0], last = items.pop();
    if (items.length === 0) return top;
    items[0] = last;
    for (let i = 0; ;) {
      let down = 2 * i + 1;
      if (down >= items.length) return top;
      if (down + 1 < items.length && items[down + 1][0] < items[down][0]) ++down;
      if (items[i][0] <= items[down][0]) return top;
      [items[i], items[down]] = [items[down], items[i]];
      i = down;
    }
  }
}
