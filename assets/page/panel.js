// The panel next to the picture: selection, colours, objects, plans, tables, and what the page is.

import { BranchTable } from "./branches.js";
import { kViews } from "./camera.js";
import { button, by, choice, facts, made, named, table } from "./dom.js";
import { legendOf } from "./looks.js";
import { counted, digits, lengthText, plain, whole } from "./text.js";
import { kSavedKeys, savedViews } from "./views.js";

const kTabs = [["explore", "Explore"], ["plan", "Plan"], ["tables", "Tables"], ["about", "About"]];
const kMostPlaces = 200; // of a list
const kWarning = "Not a medical device. For information and planning by qualified people only; check every figure against the source data.";

export class Panel {
  /** `actions`: of main.js. */
  constructor(model, actions) {
    Object.assign(this, { model, actions });
    this.#tabs();
    this.table = new BranchTable(model, (ids, options) => {
      this.fromTable = true;
      model.select(ids, options);
      this.fromTable = false;
    });
    this.#selectionActions();
    this.#colours();
    this.#views();
    this.#tables();
    this.#about();
    this.update();
  }

  #tabs() {
    const select = (name, focus) => {
      for (const [id] of kTabs) {
        const tab = by(`tab-${id}`);
        by(id).hidden = id !== name;
        tab.setAttribute("aria-selected", String(id === name));
        tab.tabIndex = id === name ? 0 : -1;
        if (id === name && focus) tab.focus();
      }
    };
    this.open = select;
    by("tabs").append(...kTabs.map(([id, text], i) => made("button", {
      type: "button", role: "tab", id: `tab-${id}`, "aria-controls": id, onclick: () => select(id),
      onkeydown: (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        event.stopPropagation();
        select(kTabs[(i + step + kTabs.length) % kTabs.length][0], true);
      },
    }, text)));
    select("explore");
  }

  #selectionActions() {
    const { actions } = this;
    by("selection-actions").append(...[
      ["Dependents", "dependents", "Also all that depends on the selected branches (D)"], ["Upstream", "upstream", "Also the way to the root (U)"],
      ["Highlight", "highlight", "H"], ["Defocus", "defocus", "Grey glass with the centerline inside (G)"],
      ["Focus only", "defocusOthers", "All others become glass (Shift+G)"], ["Hide", "hide", "X"], ["Show", "show", "Shown normally again (N)"],
      ["Show all", "showAll", "Everything normal (Shift+N)"], ["Path", "path", "Path along the vessels between the two selected branches"],
    ].map(([text, name, title]) => button(text, () => actions[name](), { title, id: `do-${name}` })));
  }

  #colours() {
    const { model } = this, { json } = model;
    const options = [["shown", json.colour && json.colour.by ? `As saved (${plain(json.colour.by)})` : "As saved"]];
    if ((json.systems || []).length) options.push(["system", "System"]);
    for (const column of json.columns || []) options.push([column.key, column.label]);
    by("colour-by").append(...options.map(([key, text]) => made("option", { value: key }, plain(text))));
    by("colour-by").addEventListener("change", (event) => model.change({ colour: event.target.value }));
    if ((json.bands || []).length && (json.lesions || []).length) {
      this.bands = made("input", { type: "checkbox", onchange: (event) => model.change({ bands: event.target.checked }) });
      by("bands").append(made("label", { class: "check" }, this.bands, "Distance from lesions, in bands"));
    }
  }

  #views() {
    const views = savedViews(this.model.json);
    by("saved-views").hidden = views.length === 0;
    by("view-list").append(...views.map(({ shown }, i) => made("li", {}, button(named(shown), () => this.actions.savedView(i),
      { title: i < kSavedKeys ? `${shown} (${i + 1})` : shown, "aria-label": shown }))));
  }

  #tables() {
    const { json } = this.model, list = json.tables || [];
    by("tables").append(...(list.length ? list.map((one) => made("section", {}, made("h2", {}, named(plain(one.title))),
      made("div", { class: "scroll wide", tabindex: 0, role: "region", "aria-label": plain(one.title) },
        table(one.columns.map(plain), one.rows.map((row) => row.map(plain)))))) : [made("p", { class: "quiet" }, "This page has no tables.")]));
  }

  #about() {
    const { json, claims } = this.model, pairs = [];
    const put = (term, text) => { if (text) pairs.push([term, plain(text)]); };
    put("File", json.file);
    put("Written", json.made);
    put("By", json.ramus ? `ramus ${json.ramus}` : "");
    put("Unit", claims.unit === "mm" ? `mm, ${claims.unit_note || ""}` : claims.unit_note || "not known");
    put("Orientation", claims.letters ? `R, A, S, ${claims.orientation_note || ""}` : claims.orientation_note || "not known: axes have no letters");
    for (const [term, text] of json.settings || []) put(term, text);
    if (json.checksum) pairs.push(["SHA-256 of the file", made("code", {}, plain(json.checksum))]);
    const keys = [["Drag, arrow keys", "turn"], ["Shift+drag, middle button, two fingers", "move"], ["Wheel, right button, + −, pinch", "zoom"],
      ["Double click", "bring to the middle"], ["Click, tap", "select a branch"], ["Ctrl+click", "add or remove"],
        ["Alt+click, long press", "a branch with all that depends on it"],
      [Object.values(kViews).map((view) => view.key).join(" "), "views"], ["F, 0", "fit"], ...(savedViews(json).length ? [["1 to 9", "saved views"]] : []), ["O", "parallel projection"],
        ["[ ]", "parent, children"], ["D U Ctrl+I", "dependents, upstream, all others"],
      ["H G X N", "highlight, glass, hide, show"], ["Shift+G, Shift+N", "focus only the selected, show all"], ["W M", "lasso, measure"],
        ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"], ["Escape", "end a tool; select nothing"], ["/", "search"]];
    by("about").append(
      made("p", { class: "notice" }, kWarning),
      json.simplified ? made("p", {}, plain(json.simplified)) : null,
      ...[["What ramus assumed", json.assumed], ["What ramus repaired", json.repaired]].flatMap(([title, list]) => (list || []).length
        ? [made("h2", {}, title), made("ul", {}, ...list.slice(0, kMostPlaces).map((text) => made("li", {}, named(plain(text)))))] : []),
      made("h2", {}, "This page"), facts(pairs),
      made("h2", { id: "keys" }, "Mouse, touch and keys"), facts(keys),
      made("p", { class: "quiet" }, "The page needs no network and sends nothing."));
  }

  /** Everything that follows the model. */
  update(what = "state") {
    const { model } = this;
    this.#selection();
    if (what === "selection") this.table.update();
    else {
      by("colour-by").value = model.state.colour;
      if (this.bands) this.bands.checked = model.state.bands;
      this.#objects();
      this.#plan();
      this.#legend();
    }
    const [first] = model.state.selection;
    if (first !== undefined && !this.fromTable) this.table.reveal(first);
  }

  /** New colours of branches, for the marks in the table. */
  recolour(colours) { this.table.update(colours); }

  #selection() {
    const { model } = this, { selection } = model.state, { claims } = model;
    for (const name of ["dependents", "upstream", "highlight", "defocus", "defocusOthers", "hide", "show"]) by(`do-${name}`).disabled = selection.length === 0;
    by("do-path").disabled = selection.length !== 2;
    if (!selection.length) return by("selection").replaceChildren(made("p", { class: "quiet" }, "Click a vessel to select it; Alt+click or a long press takes all that depends on it."));
    if (selection.length > 1) {
      const length = selection.reduce((sum, id) => sum + model.branches[id].length_mm, 0);
      const widths = selection.map((id) => model.branches[id].diameter_mm);
      return by("selection").replaceChildren(facts([["Selected", counted(selection.length, "branch", "branches")], ["Length", lengthText(length, claims)],
        ["Diameter", `${digits(widths.reduce((least, d) => Math.min(least, d.min), Infinity))} – ${lengthText(widths.reduce((most, d) => Math.max(most, d.max), 0), claims)}`]]));
    }
    const [id] = selection, branch = model.branches[id], d = branch.diameter_mm, system = (model.json.systems || [])[branch.system];
    const pairs = [["Branch", String(id)]];
    if (plain(branch.name)) pairs.push(["Name", plain(branch.name)]);
    if (system) pairs.push(["System", plain(system.name)]);
    pairs.push(["Diameter, mean", lengthText(d.mean, claims)], ["Diameter, range", `${digits(d.min)} – ${lengthText(d.max, claims)}`],
      ["Length", lengthText(branch.length_mm, claims)],
      ["Generation", String(branch.generation)], ["Strahler order", String(branch.strahler)],
      ["Depend on it", model.tree.dependents[id] ? counted(model.tree.dependents[id], "branch", "branches") : "none"],
        ["Parent", branch.parent == null ? "none, a root" : model.nameOf(branch.parent)]);
    for (const column of model.json.columns || []) {
      const value = model.value(id, column);
      if (value !== null && !["diameter", "length", "generation", "strahler", "dependents"].includes(column.key)) pairs.push([plain(column.label), `${column.whole ? whole(value) : digits(value)} ${plain(column.unit)}`.trim()]);
    }
    if (model.lost.has(id)) pairs.push(["Plan", "lost beyond a cut"]);
    by("selection").replaceChildren(facts(pairs));
  }

  #objects() {
    const { model } = this, { json, state } = model, list = [];
    (json.systems || []).forEach((system, i) => {
      const ids = model.everything.filter((id) => model.branches[id].system === i), states = new Set(ids.map((id) => state.states[id]));
      const now = states.size === 1 ? [...states][0] : -1;
      const select = made("select", { "aria-label": `How ${plain(system.name)} is shown`, onchange: (event) => model.setSystemState(i, event.target.value) },
        ...(now < 0 ? [made("option", { value: "", selected: true, disabled: true }, "mixed")] : []),
        ...[["normal", "shown"], ["highlighted", "highlighted"], ["defocused", "glass"],
          ["hidden", "hidden"]].map(([value, text], k) => made("option", { value, selected: k === now }, text)));
      list.push(made("div", { class: "row" }, this.#swatch(system.colour), named(plain(system.name)),
        made("span", { class: "quiet push" }, counted(ids.length, "branch", "branches")), select));
    });
    model.shapes.forEach((shape, i) => {
      if (shape.plan !== undefined && shape.plan !== state.plan) return;
      const box = made("input", { type: "checkbox", onchange: (event) => model.setVisible(i, event.target.checked) });
      box.checked = state.visible[i];
      list.push(made("label", { class: "check" }, box, this.#swatch(shape.colour), named(plain(shape.name)),
        made("span", { class: "quiet push" }, shape.group)));
    });
    by("objects").hidden = list.length === 0;
    const focused = document.activeElement && by("object-list").contains(document.activeElement)
      ? [...by("object-list").querySelectorAll("select, input")].indexOf(document.activeElement) : -1;
    by("object-list").replaceChildren(...list);
    if (focused >= 0) by("object-list").querySelectorAll("select, input")[focused]?.focus();
  }

  #swatch(colour) {
    const mark = made("i", { class: "swatch", "aria-hidden": "true" });
    mark.style.background = colour;
    return mark;
  }

  #legend() {
    const legend = legendOf(this.model), box = by("legend");
    box.hidden = !legend;
    if (!legend) return;
    const parts = [made("b", {}, named(plain(legend.title))), legend.subtitle ? made("span", { class: "quiet" }, named(plain(legend.subtitle))) : ""];
    if (legend.bar) {
      const bar = made("i", { class: "ramp", "aria-hidden": "true" }), ticks = made("span", { class: "ticks" });
      bar.style.background = `linear-gradient(to right, ${legend.bar.join(", ")})`;
      let free = -1; // where the next tick has room
      for (const [at, text] of [...(legend.ticks || [])].sort((a, b) => a[0] - b[0])) {
        const tick = made("span", {}, plain(text)), half = 0.018 * (plain(text).length + 1);
        if (at - half < free) continue;
        free = at + half;
        tick.style.left = `${100 * at}%`;
        ticks.append(tick);
      }
      parts.push(bar, ticks);
    }
    box.replaceChildren(...parts, ...legend.stops.map(([text, colour]) => made("span", { class: "line" }, this.#swatch(colour), named(plain(text)))));
  }

  #plan() {
    const { model, actions } = this, { json, state, claims } = model, plans = json.plans || [], parts = [];
    if (plans.length) {
      parts.push(made("h2", {}, "Plan"),
        choice("plan", "Which plan", [["-1", "None"], ...plans.map((plan, i) => [String(i), plain(plan.name) || `Plan ${i + 1}`])], String(state.plan), (value) => model.change({ plan: Number(value) })),
        choice("plan-view", "Show", [["before", "Before"], ["marked", "Lost marked"],
          ["after", "After"]], state.planView, (value) => model.change({ planView: value })));
      const labels = [...new Set(plans.flatMap((plan) => (plan.figures || []).map(([label]) => label)))];
      if (labels.length) parts.push(made("div", { class: "scroll wide", tabindex: 0, role: "region", "aria-label": "Figures of the plans" },
        table(["", ...plans.map((plan, i) => plain(plan.name) || `Plan ${i + 1}`)], labels.map((label) => [plain(label), ...plans.map((plan) => plain(((plan.figures || []).find(([name]) => name === label) || [])[1]))]))));
      const plan = model.plan;
      for (const one of (plan && plan.resections) || []) if ((one.figures || []).length) parts.push(made("h3", {},
        named(plain(one.name))), facts(one.figures.map((pair) => pair.map(plain))));
      if (plan && (plan.cuts || []).length) parts.push(made("h3", {}, "Cuts"), made("ul", { class: "plain" }, ...plan.cuts.map((cut) => made("li", {},
        button(named(`${model.nameOf(cut.branch)} at ${Math.round(100 * cut.fraction)} %${cut.reconstruct ? ", to be reconstructed" : ""}`),
          () => model.select([cut.branch])), cut.text ? made("span", { class: "quiet line" }, plain(cut.text)) : null))),
      button("Select what is lost", () => model.select([...new Set([...plan.lost, ...plan.cuts.map((cut) => cut.branch)])])));
    }
    if ((json.territories || []).length) parts.push(made("h2", {}, "Territories"), made("div", { class: "scroll wide" },
      table(["", "ml", "%"], json.territories.map((one) => [plain(one.name), digits(one.volume_ml), digits(one.percent)]))));
    parts.push(made("h2", {}, "Measurements"), state.measurements.length
      ? made("ul", { class: "plain" }, ...state.measurements.map((one, i) => made("li", { class: "row" },
      named(plain(one.name || one.kind)), made("b", { class: "push" }, named(plain(one.text))), button("Remove",
        () => model.removeMeasurement(i), { "aria-label": `Remove ${plain(one.name || one.kind)} ${plain(one.text)}` }))))
      : made("p", { class: "quiet" }, "None yet: choose Distance, Path or Diameter above the picture, then click vessels."));
    const contact = (one) => `${one.branches.map((id) => model.nameOf(id)).join(" and ")}: ${one.text || `${one.gap_mm < 0 ? "overlap " : "gap "}${lengthText(Math.abs(one.gap_mm), claims)}`}`;
    for (const [title, list, line] of [["Pins", json.pins, (one) => one.name], ["Contacts of vessels", json.contacts, contact],
      ["Notes on the tree", json.notes, (one) => one.text]])
      if ((list || []).length) parts.push(made("h2", {}, title),
        made("ul", { class: "plain" }, ...list.slice(0, kMostPlaces).map((one) => made("li", {}, one.point ? button(named(plain(line(one))),
        () => actions.lookAt(one.point, plain(line(one)))) : named(plain(line(one)))))),
        list.length > kMostPlaces ? made("p", { class: "quiet" }, `and ${whole(list.length - kMostPlaces)} more`) : "");
    const focused = document.activeElement && by("plan").contains(document.activeElement) ? `input[name="${document.activeElement.name}"][value="${document.activeElement.value}"]` : null;
    by("plan").replaceChildren(...parts);
    if (focused && /^input\[name="[a-z-]+"\]/.test(focused)) by("plan").querySelector(focused)?.focus();
  }
}
