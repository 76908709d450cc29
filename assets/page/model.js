// What the page shows, as data: selection, states of branches, colouring, plan, visible objects, measurements. Every
// change goes through a method, is one step of undo, and tells the listeners. The camera is not part of it.

import { Tree } from "./tree.js";
import { lengthText, plain, whole } from "./text.js";

export const kStates = ["normal", "highlighted", "defocused", "hidden"];
const kMostSteps = 100;

export class Model {
  /** `kase`: of decode.js; `shapes`: see shapes.js. */
  constructor(kase, shapes) {
    this.json = kase.json;
    this.branches = kase.json.branches;
    this.claims = kase.json.claims || { unit: "unit", letters: false };
    this.tree = new Tree(kase.json, kase.centerlines);
    this.shapes = shapes;
    this.listeners = [];
    this.past = [];
    this.future = [];
    const plans = kase.json.plans || [];
    this.start = {
      selection: kase.json.selection || [],
      states: Uint8Array.from(this.branches, (branch) => Math.max(0, kStates.indexOf(branch.state))),
      colour: "shown",
      bands: (kase.json.colour || {}).by === "lesion",
      plan: plans.findIndex((plan) => plan.current),
      planView: "marked", // before, marked, after
      visible: shapes.map((shape) => shape.visible !== false),
      measurements: (kase.json.measurements || []).filter((one) => one.visible !== false),
    };
    this.state = this.start;
  }

  listen(listener) { this.listeners.push(listener); }
  tell(what) { for (const listener of this.listeners) listener(what); }

  /** Changes members of the state; one step of undo. */
  change(members, what = "state") {
    this.past.push(this.state);
    if (this.past.length > kMostSteps) this.past.shift();
    this.future = [];
    this.state = { ...this.state, ...members };
    this.tell(what);
  }
  undo() { this.#step(this.past, this.future); }
  redo() { this.#step(this.future, this.past); }
  #step(from, to) {
    if (!from.length) return;
    to.push(this.state);
    this.state = from.pop();
    this.tell("state");
  }

  #valid(ids) {
    return [...new Set(typeof ids === "number" ? [ids] : ids)].map(Number)
      .filter((id) => Number.isInteger(id) && id >= 0 && id < this.branches.length).sort((a, b) => a - b);
  }

  select(ids, { add = false, toggle = false } = {}) {
    let next = this.#valid(ids);
    if (add) next = this.#valid([...this.state.selection, ...next]);
    if (toggle) {
      const now = new Set(this.state.selection);
      for (const id of next) now.delete(id) || now.add(id);
      next = this.#valid(now);
    }
    if (String(next) !== String(this.state.selection)) this.change({ selection: next }, "selection");
  }
  get everything() { return this.branches.map((_, id) => id); }
  selectInverse() {
    const now = new Set(this.state.selection);
    this.select(this.everything.filter((id) => !now.has(id)));
  }

  /** Gives branches one of kStates. */
  setState(ids, name) {
    const states = this.state.states.slice();
    for (const id of this.#valid(ids)) states[id] = kStates.indexOf(name);
    this.change({ states });
  }
  defocusOthers(ids) {
    const kept = new Set(this.#valid(ids));
    this.change({ states: this.state.states.map((state, id) => kept.has(id) ? (state === 2 ? 0 : state) : state === 3 ? 3 : 2) });
  }
  showAll() { this.change({ states: new Uint8Array(this.branches.length), visible: this.shapes.map((shape) => shape.visible !== false) }); }

  setSystemState(system, name) {
    this.setState(this.everything.filter((id) => this.branches[id].system === system), name);
  }
  setVisible(number, visible) {
    this.change({ visible: this.state.visible.map((now, i) => i === number ? visible : now) });
  }

  /** Whether a shape is drawn: it is on, and it belongs to no other plan than the shown one. */
  isShown(number) {
    const { plan } = this.shapes[number];
    return this.state.visible[number] && (plan === undefined || (plan === this.state.plan && this.state.planView !== "before"));
  }

  get plan() { return (this.json.plans || [])[this.state.plan] || null; }
  /** Branches that the shown plan loses in part: [branch, from, to]. */
  get lostParts() { return this.plan && this.state.planView !== "before" ? this.plan.lost_in_part || [] : []; }
  /** The cuts that show: none before the operation. */
  get cuts() { return this.plan && this.state.planView !== "before" ? this.plan.cuts || [] : []; }
  get lost() {
    if (!this.plan || this.state.planView === "before") return new Set();
    return new Set(this.plan.lost || []);
  }

  /** The number that a branch has in a column, or null. */
  value(id, column) {
    const value = column.values[id];
    return typeof value === "number" && Number.isFinite(value) ? value : null;
  }
  column(key) { return (this.json.columns || []).find((one) => one.key === key); }

  isLegal(key) {
    return key === "shown" || (key === "system" && (this.json.systems || []).length > 0) || Boolean(this.column(key));
  }

  addMeasurement(one) { this.change({ measurements: [...this.state.measurements, { ...one, own: true }] }); }
  removeMeasurement(number) { this.change({ measurements: this.state.measurements.filter((_, i) => i !== number) }); }

  nameOf(id) {
    const name = plain(this.branches[id].name);
    return name || `Branch ${id}`;
  }
  /** One line about a branch, as the pointer shows it. */
  summary(id) {
    const branch = this.branches[id], below = this.tree.dependents[id];
    const d = branch.diameter_mm;
    return [this.nameOf(id), `⌀ ${lengthText(d.mean, this.claims)}`, lengthText(branch.length_mm, this.claims) + " long",
      `generation ${branch.generation}`, below ? `${whole(below)} ${below === 1 ? "depends" : "depend"} on it` : "nothing depends on it"];
  }
}
