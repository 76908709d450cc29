// From the model to what is drawn: layers, colours and flags of branches, colour scales, backgrounds.

import { linear, srgb, toLinear } from "./gl.js";
import { kFlags } from "./shaders.js";
import { digits } from "./text.js";
import { diameters, insideLost, lesionDistances } from "./values.js";

// Of ramus, where the case does not say.
const kLook = { highlight: "#ffbd33", selection: "#5cccff", glass: "#a8b3c2", glass_opacity: 1, centerline: "#6f7680", lost: "#5c5785" };
const kUnknown = "#787f8a";
// Viridis by S. van der Walt and N. Smith (2015, CC0): nine colours, of which ramus leaves out the darkest eighth.
const kViridis = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const kDarkestLeftOut = 0.12;

const hex = (rgb) => "#" + rgb.map((c) => Math.round(255 * c).toString(16).padStart(2, "0")).join("");

/** The colour of viridis at t from 0 to 1, sRGB from 0 to 1. */
export function rampAt(t) {
  const place = (kDarkestLeftOut + (1 - kDarkestLeftOut) * Math.min(1, Math.max(0, t))) * (kViridis.length - 1);
  const i = Math.min(kViridis.length - 2, Math.floor(place)), a = srgb(kViridis[i]), b = srgb(kViridis[i + 1]);
  return a.map((c, k) => c + (place - i) * (b[k] - c));
}

/** How colours follow a column: { title, unit, low, high }, or null. */
export function scaleOf(model, key = model.state.colour) {
  const column = model.column(key);
  if (!column) return null;
  const numbers = column.values.filter((value) => Number.isFinite(value));
  if (!numbers.length) return null;
  let low = numbers.reduce((a, b) => Math.min(a, b)), high = numbers.reduce((a, b) => Math.max(a, b));
  if (key === "diameter") for (const branch of model.branches) {
    low = Math.min(low, branch.diameter_mm.min);
    high = Math.max(high, branch.diameter_mm.max);
  }
  return { title: column.label, unit: column.unit || "", low, high };
}

/** The legend: { title, bar: [colours], ticks: [[0 to 1, text]], stops: [[text, colour]] }, or null. */
export function legendOf(model) {
  const { colour } = model.state, { json } = model;
  if (model.state.bands && (json.bands || []).length && (json.lesions || []).length)
    return { title: "Distance from lesions", stops: json.bands.map((band) => [`within ${band.mm} ${model.claims.unit}`, band.colour]) };
  if (colour === "system") return { title: "Systems", stops: json.systems.map((one) => [one.name, one.colour]) };
  if (colour === "shown") {
    const legend = json.colour && json.colour.legend;
    return legend && legend.title && (legend.bar || legend.stops.length) ? legend : null;
  }
  const scale = scaleOf(model);
  if (!scale) return null;
  return {
    title: scale.title + (scale.unit ? `, ${scale.unit}` : ""), bar: Array.from({ length: 9 }, (_, i) => hex(rampAt(i / 8))),
    ticks: [0, 0.5, 1].map((at) => [at, digits(scale.low + at * (scale.high - scale.low))]), stops: [],
  };
}

/** Gives the renderer what the model shows. Returns the look without what depends on the theme. */
export class Looks {
  constructor(model, renderer, kase) {
    Object.assign(this, { model, renderer, kase });
    this.hovered = -1;
    this.cache = new Map();
    this.renew();
  }

  // Again after a lost context.
  renew() {
    this.renderer.setRamp(rampAt);
    this.layersOf = this.valuesOf = null;
    this.update();
  }

  #cached(key, make) {
    if (!this.cache.has(key)) this.cache.set(key, make());
    return this.cache.get(key);
  }

  #layers() {
    const { model } = this, { lost } = model, after = model.state.planView === "after";
    return model.state.states.map((state, id) => state === 3 || (after && lost.has(id)) ? 2 : state === 2 ? 1 : 0);
  }

  #colours(along) {
    const { model } = this, { colour } = model.state, scale = scaleOf(model);
    return model.branches.map((branch) => {
      if (colour === "system") return branch.system === undefined ? kUnknown : (model.json.systems[branch.system] || {}).colour;
      if (scale && !along) {
        const value = model.value(id, column);
        return value === null ? kUnknown : hex(rampAt((value - scale.low) / Math.max(scale.high - scale.low, 1e-12)));
      }
      return branch.colour;
    });
  }

  /** Sends what changed. */
  update() {
    const { model, renderer, kase } = this, { surface, centerlines } = kase, { state, json } = model;
    const layers = this.#layers();
    if (String(layers) !== this.layersOf) renderer.setLayers(layers);
    this.layersOf = String(layers);
    this.bands = state.bands && renderer.float && (json.lesions || []).length ? (json.bands || []).slice().sort((a, b) => a.mm - b.mm) : [];
    const along = state.colour === "diameter" && renderer.float && !this.bands.length;
    const { lostParts } = model;
    const wanted = JSON.stringify([along, this.bands, lostParts]);
    if (wanted !== this.valuesOf) {
      const lesions = (json.lesions || []).map((one) => ({ ...one, mesh: one.mesh === undefined ? null : kase.meshes[one.mesh] }));
      const first = this.bands.length ? this.#cached("lesions", () => lesionDistances(surface, lesions, this.bands[this.bands.length - 1].mm))
        : along ? this.#cached("diameters", () => diameters(surface, centerlines)) : null;
      const second = lostParts.length ? insideLost(surface, centerlines, lostParts) : null;
      const count = surface.branches.length, values = first || second ? new Float32Array(2 * count) : null;
      for (let v = 0; values && v < count; ++v) {
        values[2 * v] = first ? first[v] : 0;
        values[2 * v + 1] = second ? second[v] : -1e4;
      }
      renderer.setValues(values);
      this.valuesOf = wanted;
    }
    this.#records(along);
    const scale = scaleOf(model);
    this.scale = along && scale ? [scale.low, 1 / Math.max(scale.high - scale.low, 1e-12), 0, 1] : null;
  }

  #records(along) {
    const { model } = this, { state, shapes, lost } = model;
    const { highlight } = { ...kLook, ...model.json.look };
    const selected = new Set(state.selection), cut = new Set(model.lostParts.map(([branch]) => branch));
    const glowing = new Set(this.hovered >= 0 && this.hovered < model.branches.length ? model.tree.subtree([this.hovered]) : []);
    const bright = state.states.includes(1), colours = this.#colours(along);
    this.outlined = false;
    const flags = state.states.map((one) => bright ? (one === 1 ? kFlags.highlighted : kFlags.calm) : 0);
    const all = Array.from(flags, (flag, id) => {
      if (state.states[id] === 1) colours[id] = highlight;
      if (id === this.hovered) flag |= kFlags.hovered;
      else if (glowing.has(id)) flag |= kFlags.glowing;
      if (lost.has(id)) flag |= kFlags.lost;
      if (cut.has(id)) flag |= kFlags.cut;
      if (selected.has(id) && state.states[id] !== 3) {
        flag = (flag & ~kFlags.calm) | kFlags.selected;
        this.outlined = true;
      }
      return flag;
    });
    shapes.forEach((shape, i) => {
      colours.push(shape.colour);
      all.push(kFlags.fixed | (this.hovered === model.branches.length + i ? kFlags.hovered : 0));
    });
    this.colours = colours;
    this.renderer.setRecords(colours, all);
  }

  /** The hovered branch, or a shape by its number after the branches; -1: none. */
  hover(id) {
    if (id === this.hovered) return false;
    this.hovered = id;
    this.update();
    return true;
  }

  /** The whole look, for a light or a dark ground. */
  look(ground) {
    const { json } = this.model, own = json.background && json.ground === ground ? json.background : null;
    const white = ground === "light";
    const top = own ? srgb(own.top) : white ? [1, 1, 1] : [0.105, 0.115, 0.130];
    const bottom = own ? srgb(own.bottom) : white ? [1, 1, 1] : [0.045, 0.050, 0.060];
    const colours = { ...kLook, ...json.look };
    return {
      top, bottom, far: top.map((c, k) => toLinear(0.5 * (c + bottom[k]))), depthCue: white ? 0.35 : 1,
      glass: linear(colours.glass), line: linear(colours.centerline), glassOpacity: colours.glass_opacity,
      lost: linear(colours.lost), selection: linear(colours.selection),
      bands: this.bands, scale: this.scale, outlined: this.outlined, drop: this.model.state.planView === "after" && this.model.lostParts.length > 0,
      shapes: this.model.shapes.map((shape, i) => ({ opacity: shape.opacity, visible: this.model.isShown(i), picked: Boolean(shape.picked) && this.model.isShown(i) })),
    };
  }
}
