// The page: reads the case, builds the parts, connects them. window.ramus is for scripts and tests.

import { cameraFrom, centredOn, kViews, turned, withProjection, zoomedAbout } from "./camera.js";
import { decodeCase } from "./decode.js";
import { button, by, made } from "./dom.js";
import { Renderer } from "./draw.js";
import { branchesInside, Input } from "./input.js";
import { Looks } from "./looks.js";
import { diameterMeasurement, distanceMeasurement, kMeasuring, Measuring, pathMeasurement } from "./measuring.js";
import { kStates, Model } from "./model.js";
import { Overlay } from "./overlay.js";
import { Panel } from "./panel.js";
import { shapesOf } from "./shapes.js";
import { counted, plain } from "./text.js";
import { kSavedKeys, savedViews, viewNamed } from "./views.js";
import { Viewport } from "./viewport.js";

const kTurn = 15, kZoom = 1.25; // degrees, factor: of keys

function start(kase) {
  const { json } = kase, shapes = shapesOf(kase), model = new Model(kase, shapes);
  document.documentElement.classList.add("live");
  by("live").hidden = false;
  const renderer = new Renderer(by("picture"), { surface: kase.surface, centerlines: kase.centerlines, shapes: shapes.map((shape) => shape.mesh), branchCount: model.branches.length });
  const looks = new Looks(model, renderer, kase);
  const viewport = new Viewport(by("picture"), new Overlay(by("overlay")), renderer, looks, model);

  const say = (text) => { by("status").textContent = text; };
  const draft = (one) => {
    viewport.extra.draft = one;
    viewport.redrawOverlay();
  };
  const measuring = new Measuring(model, { done: (one) => model.addMeasurement(one), say, draft });
  const selected = () => model.state.selection;
  const actions = {
    select(pick, options) {
      if (!pick || pick.branch === null) {
        if (pick) say(plain(shapes[pick.shape].name));
        else if (!options.add && !options.toggle) model.select([]);
        return;
      }
      model.select(options.dependents ? model.tree.subtree([pick.branch]) : [pick.branch], options);
    },
    measureAt: (pick) => measuring.click(pick),
    lassoed(polygon, event) {
      const ids = branchesInside(polygon, model, viewport.camera, viewport.size, renderer.layerBytes);
      model.select(event.altKey ? selected().filter((id) => !ids.includes(id)) : ids, { add: event.ctrlKey });
      say(`${counted(ids.length, "branch", "branches")} inside the lasso`);
    },
    hovered(pick, x, y) {
      const id = !pick ? -1 : pick.branch !== null ? pick.branch : model.branches.length + pick.shape;
      if (looks.hover(viewport.slow ? -1 : id)) viewport.redraw();
      const tip = by("tip");
      tip.hidden = id < 0;
      if (id < 0) return;
      tip.replaceChildren(...(pick.branch !== null ? model.summary(id) : [plain(shapes[pick.shape].name)]).map((text, i) => made(i ? "span" : "b", {}, text)));
      const right = x > viewport.size[0] - 220;
      tip.style.left = right ? "" : `${x + 16}px`;
      tip.style.right = right ? `${viewport.size[0] - x + 12}px` : "";
      tip.style.top = `${Math.min(y + 16, viewport.size[1] - 110)}px`;
    },
    dependents: () => model.select(model.tree.subtree(selected())),
    upstream: () => model.select(model.tree.upstream(selected())),
    highlight: () => model.setState(selected(), "highlighted"),
    defocus: () => model.setState(selected(), "defocused"),
    defocusOthers: () => model.defocusOthers(selected()),
    hide: () => model.setState(selected(), "hidden"),
    show: () => model.setState(selected(), "normal"),
    showAll: () => model.showAll(),
    invert: () => model.selectInverse(),
    parent: () => model.select(selected().map((id) => model.branches[id].parent).filter((id) => id != null)),
    children: () => model.select(selected().length ? selected().flatMap((id) => model.branches[id].children) : model.tree.roots.slice(0, 1)),
    path() {
      const [a, b] = selected();
      const made = pathMeasurement(model, { branch: a, fraction: 0.5 }, { branch: b, fraction: 0.5 });
      if (!made) return say("No vessels connect these two.");
      model.addMeasurement(made);
      say(`${made.name}, from middle to middle: ${made.text}`);
    },
    savedView(i) {
      const view = savedViews(json)[i];
      viewport.goTo(viewport.saved(view.camera));
      say(`View: ${view.shown}`);
    },
    lookAt(point, text) {
      viewport.extra.marked = { point, text };
      viewport.goTo(centredOn(viewport.camera, point));
    },
    view: (name) => viewport.setView(name),
    fit: () => viewport.fit(selected()),
    projection: () => viewport.goTo(withProjection(viewport.camera, !viewport.camera.orthographic)),
    turn: (azimuth, elevation) => viewport.setCamera(turned(viewport.camera, viewport.camera.focal_point, azimuth, elevation), { moving: true }),
    zoom: (by) => viewport.setCamera(zoomedAbout(viewport.camera, viewport.camera.focal_point, by, 1e-3 * renderer.ball.radius), { moving: true }),
    tool(name) {
      input.tool = name;
      for (const one of by("tools").querySelectorAll("[aria-pressed]")) one.setAttribute("aria-pressed", String(one.id === `tool-${name}`));
      measuring.begin(name);
      if (name === "lasso") say("Draw around vessels: those with at least half their length inside are selected. Ctrl adds, Alt removes.");
      if (name === "select") say("");
    },
    theme() {
      viewport.ground = viewport.ground === "dark" ? "light" : "dark";
      showTheme();
      viewport.redraw();
    },
    async copy() {
      const canvas = viewport.picture(), blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
      try {
        await navigator.clipboard.write([new ClipboardItem({ "image/png": blob })]);
        say("The picture is in the clipboard.");
      } catch {
        const link = made("a", { href: URL.createObjectURL(blob), download: `${(plain(json.title) || "vessels").replace(/[^\p{L}\p{N} _-]/gu, "")}.png` });
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 60000);
        say("The picture is saved as a file: this browser gives the page no clipboard.");
      }
    },
    print: () => window.print(),
    undo: () => model.undo(),
    redo: () => model.redo(),
    about: () => { panel.open("about", true); },
    search: () => {
      panel.open("explore");
      by("filter").focus();
    },
    escape() {
      if (input.tool !== "select") return actions.tool("select");
      model.select([]);
    },
  };
  const input = new Input(viewport, actions);
  const panel = new Panel(model, actions);

  function showTheme() {
    document.documentElement.dataset.theme = viewport.ground;
    by("theme").textContent = viewport.ground === "dark" ? "Light" : "Dark";
    by("theme").setAttribute("aria-label", viewport.ground === "dark" ? "Light background" : "Dark background");
  }
  const coloursOf = () => model.branches.map((branch, id) => looks.colours[id]);
  model.listen((what) => {
    looks.update();
    panel.update(what);
    if (what !== "selection") panel.recolour(coloursOf());
    const { selection } = model.state;
    if (what === "selection") say(selection.length === 0 ? "Nothing selected" : selection.length === 1 ? model.summary(selection[0]).join(", ") : `${counted(selection.length, "branch", "branches")} selected`);
    viewport.redraw();
  });

  buildTools(model, actions);
  by("theme").addEventListener("click", actions.theme);
  bindKeys(actions, savedViews(json).length);
  bindPrinting(model, viewport);
  actions.tool("select");
  showTheme();
  panel.recolour(coloursOf());
  by("picture").setAttribute("aria-label", `${counted(model.branches.length, "vessel branch", "vessel branches")}${(json.lesions || []).length ? `, ${counted(json.lesions.length, "lesion")}` : ""}`);
  say("Drag to turn, wheel or pinch to zoom, click to select.");
  return { model, viewport, looks, renderer, actions, panel };
}

function buildTools(model, actions) {
  const title = (name) => model.claims.letters ? name[0].toUpperCase() + name.slice(1) : `From ${kViews[name].axis}`;
  by("views").append(...Object.entries(kViews).map(([name, view]) => button(model.claims.letters ? view.key : view.axis,
    () => actions.view(name), { title: `${title(name)} (${view.key})`, "aria-label": title(name) })),
    button("Fit", actions.fit, { title: "Everything, or the selected branches (F)" }),
      button("Parallel", actions.projection, { title: "Parallel or perspective projection (O)" }));
  const tool = (name, text, hint) => button(text, () => actions.tool(name), { id: `tool-${name}`, "aria-pressed": "false", title: hint });
  by("tools").append(tool("select", "Select", "Click vessels"), tool("lasso", "Lasso", "Draw around vessels (W)"),
    ...Object.entries(kMeasuring).map(([name, one]) => tool(name, one.label, one.hint)),
    made("span", { class: "gap" }), button("Undo", actions.undo, { title: "Ctrl+Z" }), button("Redo", actions.redo, { title: "Ctrl+Shift+Z" }),
    button("Copy picture", actions.copy), button("Print", actions.print));
  for (const bar of [by("tools"), by("views")]) arrowKeys(bar);
}

// One stop of the Tab key per toolbar; arrows go from button to button.
function arrowKeys(bar) {
  const buttons = [...bar.querySelectorAll("button")];
  const take = (one) => buttons.forEach((each) => { each.tabIndex = each === one ? 0 : -1; });
  take(buttons[0]);
  bar.addEventListener("focusin", (event) => take(event.target));
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    buttons[(buttons.indexOf(document.activeElement) + step + buttons.length) % buttons.length].focus();
  });
}

function bindKeys(actions, savedCount) {
  const plainKeys = {
    ArrowLeft: () => actions.turn(kTurn, 0), ArrowRight: () => actions.turn(-kTurn, 0), ArrowUp: () => actions.turn(0, -kTurn), ArrowDown: () => actions.turn(0, kTurn),
    "+": () => actions.zoom(kZoom), "=": () => actions.zoom(kZoom), "-": () => actions.zoom(1 / kZoom), f: actions.fit, 0: actions.fit, o: actions.projection,
    d: actions.dependents, u: actions.upstream, h: actions.highlight, g: actions.defocus, G: actions.defocusOthers, x: actions.hide, Delete: actions.hide,
    n: actions.show, N: actions.showAll, "[": actions.parent, "]": actions.children, w: () => actions.tool("lasso"), m: () => actions.tool("distance"),
    Escape: actions.escape, "/": actions.search, "?": actions.about, F1: actions.about,
  };
  for (const [name, view] of Object.entries(kViews)) plainKeys[view.key.toLowerCase()] = () => actions.view(name);
  for (let i = 0; i < Math.min(savedCount, kSavedKeys); ++i) plainKeys[i + 1] = () => actions.savedView(i);
  const withControl = { z: actions.undo, Z: actions.redo, y: actions.redo, i: actions.invert };
  document.addEventListener("keydown", (event) => {
    if (event.target.closest("input:not([type=checkbox]):not([type=radio]), select, textarea") && event.key !== "Escape") return;
    if (event.target.closest(".scroll, [role=tabpanel]") && /^Arrow|^\/$/.test(event.key) && event.key !== "/") return; // scrolls, or goes along radio buttons
    if (event.altKey) return;
    const action = (event.ctrlKey || event.metaKey ? withControl : plainKeys)[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

function bindPrinting(model, viewport) {
  window.addEventListener("beforeprint", () => {
    by("print-image").src = viewport.picture({ ground: "light", factor: 2 }).toDataURL("image/png");
    by("print-caption").textContent = model.claims.unit === "mm" ? "" : "Lengths are in unknown units.";
    by("print-picture").hidden = false;
    by("print-about").replaceChildren(...(by("report").querySelector("table") ? [] : [...by("tables").children].map((one) => one.cloneNode(true))), ...[...by("about").children].slice(1, -3).map((one) => one.cloneNode(true)));
  });
  window.addEventListener("afterprint", () => {
    by("print-picture").hidden = true;
    by("print-about").replaceChildren();
  });
}

/** What scripts and tests use; see the head of this file. */
function api({ model, viewport, looks, renderer, actions }) {
  const list = (ids) => typeof ids === "number" ? [ids] : [...ids];
  const place = (at) => typeof at === "number" ? { branch: at, fraction: 0.5 } : at;
  return {
    select: (ids, options) => model.select(list(ids), options),
    subtree: (ids) => model.tree.subtree(list(ids)),
    upstream: (ids) => model.tree.upstream(list(ids)),
    path(a, b) {
      const found = model.tree.path(place(a), place(b));
      return found && { branches: found.branches, length_mm: found.length_mm };
    },
    distance: (p, q) => distanceMeasurement(model, p, q).length_mm,
    diameter: (branch, point) => diameterMeasurement(model, branch, point).length_mm,
    hide: (ids) => model.setState(list(ids), "hidden"),
    defocus: (ids) => model.setState(list(ids), "defocused"),
    highlight: (ids) => model.setState(list(ids), "highlighted"),
    show: (ids) => model.setState(list(ids), "normal"),
    showAll: () => model.showAll(),
    camera(given) {
      if (given) viewport.setCamera(cameraFrom(given, viewport.camera));
      return structuredClone(viewport.camera);
    },
    colourBy(key) {
      if (!model.isLegal(key)) throw new Error(`nothing is coloured by ${key}`);
      model.change({ colour: key });
    },
    view(name) {
      const meant = viewNamed(model.json, name);
      if (!meant) throw new Error(`no view is called ${name}`);
      if (meant.anatomical) viewport.setView(name);
      else actions.savedView(meant.saved);
    },
    views: () => savedViews(model.json).map(({ name }) => name),
    plan: (plan, planView = "marked") => model.change({ plan, planView }),
    state: () => ({
      selection: [...model.state.selection], states: Array.from(model.state.states, (state) => kStates[state]), camera: structuredClone(viewport.camera),
      colour: model.state.colour, bands: model.state.bands, plan: model.state.plan, planView: model.state.planView, frames: viewport.frames, webgl: true,
      measurements: model.state.measurements.map(({ kind, text, length_mm }) => ({ kind, text, length_mm })), ground: viewport.ground, size: viewport.size, float: renderer.float,
    }),
    branch: (id) => model.branches[id],
    place: (id, fraction = 0.5) => model.tree.place(id, fraction).at,
    pick: (x, y) => viewport.pick(x, y),
    project: (point) => viewport.project(point),
    picture: (options) => viewport.picture(options).toDataURL("image/png"),
    timeOfMoving: () => viewport.timeOfMoving(),
    hovered: () => looks.hovered,
  };
}

function failed(error) {
  document.documentElement.classList.remove("live");
  by("live").hidden = true;
  by("trouble").hidden = false;
  by("trouble").textContent = `The vessels cannot be shown in three dimensions here: ${error.message}. The pictures and tables of the report follow.`;
}

window.ramus = {
  ready: (async () => {
    try {
      const kase = await decodeCase();
      const parts = start(kase);
      Object.assign(window.ramus, api(parts));
      parts.viewport.drawOverlay();
      return true;
    } catch (error) {
      failed(error);
      window.ramus.state = () => ({ webgl: false, error: error.message });
      return false;
    }
  })(),
};
