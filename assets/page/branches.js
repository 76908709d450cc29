// The table of branches: sorted, filtered, with a check box per row. Long lists are shown in parts.

import { by, button, made } from "./dom.js";
import { counted, digits, plain, whole } from "./text.js";
import { kStates } from "./model.js";

const kRowsAtOnce = 150;
const kFigures = {
  d: (m, id) => m.branches[id].diameter_mm.mean, len: (m, id) => m.branches[id].length_mm, gen: (m, id) => m.branches[id].generation,
  str: (m, id) => m.branches[id].strahler, deps: (m, id) => m.tree.dependents[id], id: (m, id) => id,
};

/**
 * The branches that a text asks for: words of names, systems and states, numbers of branches, and figures like "d>3",
 * "gen<=5", "len>20", "str=2", "deps>10".
 */
export function found(model, text) {
  const tests = text.trim().toLowerCase().split(/\s+/).filter(Boolean).map((word) => {
    const figure = /^(d|len|gen|str|deps|id)(<=|>=|<|>|=)(-?[\d.]+)$/.exec(word);
    if (figure) {
      const of = kFigures[figure[1]], limit = Number(figure[3]);
      return (id) => ({ "<": (v) => v < limit, ">": (v) => v > limit, "<=": (v) => v <= limit, ">=": (v) => v >= limit, "=": (v) => v === limit })[figure[2]](of(model, id));
    }
    if (/^\d+$/.test(word)) return (id) => id === Number(word) || plain(model.branches[id].name).toLowerCase().includes(word);
    return (id) => [model.branches[id].name, (model.json.systems || [])[model.branches[id].system]?.name, kStates[model.state.states[id]]]
      .some((name) => plain(name).toLowerCase().includes(word));
  });
  return model.everything.filter((id) => tests.every((test) => test(id)));
}

export class BranchTable {
  /** `chosen(ids, options)`: a person selected rows. */
  constructor(model, chosen) {
    Object.assign(this, { model, chosen, sort: "id", down: false, limit: kRowsAtOnce });
    const { unit } = model.claims;
    this.columns = [["id", "Branch", "Number or name"], ["gen", "Gen", "Generation"], ["str", "Str", "Strahler order"],
      ["d", `⌀ ${unit}`, "Mean diameter"], ["len", `Len ${unit}`, "Length"], ["deps", "Deps", "How many branches depend on it"]];
    by("filter").addEventListener("input", () => {
      this.limit = kRowsAtOnce;
      this.fill();
    });
    by("filter").addEventListener("keydown", (event) => { if (event.key === "Enter") by("select-found").click(); });
    by("select-found").addEventListener("click", () => this.chosen(found(model, by("filter").value)));
    by("more").addEventListener("click", () => {
      this.limit += 10 * kRowsAtOnce;
      this.fill();
    });
    this.fill();
  }

  #header() {
    by("branches").tHead.replaceChildren(made("tr", {}, ...this.columns.map(([key, text, title], i) => made("th", {
      scope: "col", class: i ? "number" : null, "aria-sort": this.sort === key ? (this.down ? "descending" : "ascending") : null,
    }, button(text + (this.sort === key ? (this.down ? " ▾" : " ▴") : ""), () => {
      this.down = this.sort === key ? !this.down : key !== "id";
      this.sort = key;
      this.fill();
      by("branches").tHead.querySelectorAll("button")[i].focus();
    }, { title, "aria-label": `${title}, sort` })))));
  }

  /** Builds the rows again. */
  fill() {
    const { model } = this;
    this.#header();
    const of = kFigures[this.sort], list = found(model, by("filter").value);
    list.sort((a, b) => (of(model, a) - of(model, b)) * (this.down ? -1 : 1) || a - b);
    this.rows = new Map();
    by("branches").tBodies[0].replaceChildren(...list.slice(0, this.limit).map((id) => this.#row(id)));
    by("found").textContent = by("filter").value.trim() ? `${counted(list.length, "branch", "branches")} found` : counted(list.length, "branch", "branches");
    by("more").hidden = list.length <= this.limit;
    by("more").textContent = `Show more (${(list.length - this.limit).toLocaleString("en-US")})`;
    this.update();
  }

  #row(id) {
    const { model } = this, branch = model.branches[id];
    const box = made("input", { type: "checkbox", "aria-label": model.nameOf(id) });
    box.addEventListener("change", () => this.chosen([id], { toggle: true }));
    const name = plain(branch.name);
    const row = made("tr", {}, made("th", { scope: "row" }, made("label", {}, box, made("i", { class: "swatch", "aria-hidden": "true" }), name
      ? made("bdi", { title: name }, name) : String(id))),
      ...[branch.generation, branch.strahler, digits(branch.diameter_mm.mean), digits(branch.length_mm), whole(model.tree.dependents[id])]
        .map((text) => made("td", { class: "number" }, String(text))));
    row.addEventListener("click", (event) => {
      if (event.target.closest("label")) return;
      this.chosen([id], { toggle: event.ctrlKey || event.metaKey, add: event.shiftKey });
    });
    this.rows.set(id, { row, box, swatch: row.querySelector("i") });
    return row;
  }

  /** Selection, states and colours of the rows. */
  update(colours = this.colours) {
    this.colours = colours;
    const { state } = this.model, selected = new Set(state.selection);
    for (const [id, { row, box, swatch }] of this.rows) {
      box.checked = selected.has(id);
      row.className = (selected.has(id) ? "selected " : "") + kStates[state.states[id]];
      if (colours) swatch.style.background = colours[id];
    }
  }

  /** Scrolls to a branch, if its row is there. */
  reveal(id) {
    const found = this.rows.get(id);
    if (!found) return;
    // Not scrollIntoView, which would also scroll the panel away from the figures of the selection.
    const box = by("branches").parentElement, top = found.row.offsetTop, head = by("branches").tHead.offsetHeight;
    if (top < box.scrollTop + head) box.scrollTop = top - head;
    else if (top + found.row.offsetHeight > box.scrollTop + box.clientHeight) box.scrollTop = top + found.row.offsetHeight - box.clientHeight;
  }
}
