// What is drawn over the picture, on a canvas of its own: scale bar, orientation cube, measurements, notes, pins, cuts,
// contacts, lasso. Points of the page, not pixels.

import { axesOf, depthOf, mmPerPixel, projector } from "./camera.js";
import { dot } from "./vector.js";
import { barLabel, plain } from "./text.js";

const kMostShare = 1 / 3, kUnspoken = 0.02; // of the scale bar in perspective, as in ramus
const kFoot = 100; // points that the bar and the cube need
const kFont = "system-ui, 'Segoe UI', 'Open Sans', sans-serif";

/** The faces of the cube: outward direction, right and up of its letter, colour. */
const kFaces = [
  { view: "right", letter: "R", axis: "+x", normal: [1, 0, 0], right: [0, 1, 0], up: [0, 0, 1], colour: [109, 87, 84] },
  { view: "left", letter: "L", axis: "-x", normal: [-1, 0, 0], right: [0, -1, 0], up: [0, 0, 1], colour: [109, 87, 84] },
  { view: "anterior", letter: "A", axis: "+y", normal: [0, 1, 0], right: [-1, 0, 0], up: [0, 0, 1], colour: [84, 100, 88] },
  { view: "posterior", letter: "P", axis: "-y", normal: [0, -1, 0], right: [1, 0, 0], up: [0, 0, 1], colour: [84, 100, 88] },
  { view: "superior", letter: "S", axis: "+z", normal: [0, 0, 1], right: [1, 0, 0], up: [0, 1, 0], colour: [82, 92, 111] },
  { view: "inferior", letter: "I", axis: "-z", normal: [0, 0, -1], right: [1, 0, 0], up: [0, -1, 0], colour: [82, 92, 111] },
];

/** A length of 1, 2 or 5 times a power of ten, at most `longest`. */
export function roundLength(longest) {
  const power = 10 ** Math.floor(Math.log10(longest));
  return [5, 2, 1].map((step) => step * power).find((length) => length <= longest * (1 + 1e-9)) || power;
}

/**
 * The scale bar: { length (mm), pixels, place }, or null where no one length holds for the picture. `visible`: the middle
 * of what is seen and half its depth, mm.
 */
export function scaleBar(camera, size, visible, most) {
  let mm = 0, place = "";
  if (camera.orthographic) mm = mmPerPixel(camera, size, 0);
  else {
    const depth = visible ? depthOf(camera, visible.middle) : 0;
    if (!(depth > 0)) return null;
    const share = visible.halfDepth / depth;
    if (!(share <= kMostShare)) return null;
    mm = mmPerPixel(camera, size, depth);
    place = "at the middle" + (share > kUnspoken ? `, ±${Math.ceil(100 * share)} %` : "");
  }
  if (!(mm > 1e-9 && mm < 1e9)) return null;
  const length = roundLength(mm * most);
  return { length, pixels: length / mm, place };
}

export class Overlay {
  constructor(canvas) {
    this.canvas = canvas;
    this.cubeFaces = [];
  }

  /**
   * `scene`: camera, size (points), visible, model, ink ("light" or "dark"), lasso, draft (a measurement), narrow. Without
   * marks the canvas covers only the bar and the cube, at the bottom: putting a clear canvas over the whole picture costs a
   * software renderer a third of its time.
   */
  draw(scene, ratio) {
    const { canvas } = this, [width, height] = scene.size, { model } = scene;
    const marks = [model.cuts, model.state.measurements, model.json.pins || []].some((list) => list.length > 0) || scene.draft || scene.marked || scene.lasso;
    const top = marks ? 0 : Math.max(0, height - kFoot), pixels = [width, height - top].map((points) => Math.max(1, Math.round(points * ratio)));
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    canvas.style.top = `${top}px`;
    canvas.style.height = `${height - top}px`;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.setTransform(ratio, 0, 0, ratio, 0, -top * ratio);
    context.clearRect(0, 0, width, height);
    this.paint(context, scene);
  }

  paint(c, scene) {
    const { camera, size, model } = scene, at = projector(camera, size);
    this.ink = scene.ink === "dark" ? { text: "#14171b", halo: "rgba(255,255,255,.85)", plate: "rgba(255,255,255,.9)", cut: "#14171b", again: "#b35900", measure: "#00678f" }
      : { text: "#f2f4f7", halo: "rgba(0,0,0,.75)", plate: "rgba(20,23,27,.85)", cut: "#f0f2f7", again: "#ff9e33", measure: "#7fe0ff" };
    c.lineJoin = c.lineCap = "round";
    for (const cut of model.cuts)
      this.#line(c, model.tree.ring(cut.branch, cut.fraction, 1.35).map(at), cut.reconstruct ? this.ink.again : this.ink.cut, 2.2);
    for (const one of [...model.state.measurements, ...(scene.draft ? [scene.draft] : [])]) {
      for (const line of one.lines || []) this.#line(c, line.map(at), this.ink.measure, 1.8);
      for (const point of one.points) this.#spot(c, at(point), this.ink.measure, 3.5);
      const label = one.label_at && at(one.label_at);
      if (label && one.text) this.#label(c, label[0], label[1] - 12, plain(one.text));
    }
    for (const one of model.json.pins || []) this.#mark(c, at(one.point), plain(one.name));
    if (scene.marked) this.#mark(c, at(scene.marked.point), plain(scene.marked.text).slice(0, 60));
    if (scene.lasso) this.#lasso(c, scene.lasso);
    if (scene.legend) this.#legend(c, scene.legend);
    this.#bar(c, scene);
    this.#cube(c, scene);
  }

  #line(c, points, colour, wide) {
    for (const [style, more] of [[this.ink.halo, 2.2], [colour, 0]]) {
      c.strokeStyle = style;
      c.lineWidth = wide + more;
      c.beginPath();
      let open = false;
      for (const point of points) {
        if (!point) open = false;
        else if (open) c.lineTo(point[0], point[1]);
        else {
          c.moveTo(point[0], point[1]);
          open = true;
        }
      }
      c.stroke();
    }
  }
  #spot(c, point, colour, radius) {
    if (!point) return;
    c.beginPath();
    c.arc(point[0], point[1], radius, 0, 2 * Math.PI);
    c.fillStyle = colour;
    c.strokeStyle = this.ink.halo;
    c.lineWidth = 1.5;
    c.fill();
    c.stroke();
  }
  #mark(c, point, text) {
    if (!point) return;
    this.#spot(c, point, "#ffbd33", 4);
    if (text) this.#label(c, point[0], point[1] - 16, text);
  }
  #label(c, x, y, text) {
    c.font = `600 12.5px ${kFont}`;
    const wide = c.measureText(text).width + 12;
    c.fillStyle = this.ink.plate;
    c.beginPath();
    c.rect(x - wide / 2, y - 10, wide, 20);
    c.fill();
    this.#text(c, text, x, y + 0.5, "center", false);
  }
  #text(c, text, x, y, align, halo = true) {
    c.textAlign = align;
    c.textBaseline = "middle";
    c.lineWidth = 3;
    c.strokeStyle = this.ink.halo;
    if (halo) c.strokeText(text, x, y);
    c.fillStyle = this.ink.text;
    c.fillText(text, x, y);
  }
  #lasso(c, points) {
    c.fillStyle = "rgba(92,204,255,.15)";
    c.strokeStyle = "#5cccff";
    c.lineWidth = 1.6;
    c.setLineDash([5, 4]);
    c.beginPath();
    points.forEach((p, i) => i ? c.lineTo(p[0], p[1]) : c.moveTo(p[0], p[1]));
    c.closePath();
    c.fill();
    c.stroke();
    c.setLineDash([]);
  }

  // For saved pictures; the page has its own.
  #legend(c, { title, bar, ticks = [], stops }) {
    let y = 22;
    c.font = `600 13px ${kFont}`;
    this.#text(c, plain(title), 18, y, "left");
    c.font = `500 12px ${kFont}`;
    if (bar) {
      const ramp = c.createLinearGradient(18, 0, 208, 0);
      bar.forEach((colour, i) => ramp.addColorStop(i / Math.max(bar.length - 1, 1), colour));
      c.fillStyle = ramp;
      c.fillRect(18, y + 12, 190, 10);
      const shown = [ticks[0], ...ticks.slice(1, -1).filter(([at]) => Math.abs(at - 0.5) < 0.15).slice(0, 1), ticks[ticks.length - 1]];
      for (const [at, text] of shown.filter(Boolean)) this.#text(c, plain(text), 18 + 190 * at, y + 33, at < 0.1 ? "left" : at > 0.9 ? "right" : "center");
      y += 36;
    }
    for (const [text, colour] of stops) {
      y += 18;
      c.fillStyle = colour;
      c.fillRect(18, y - 5, 10, 10);
      this.#text(c, plain(text), 34, y, "left");
    }
  }

  #bar(c, { camera, size, visible, model, narrow }) {
    const bar = scaleBar(camera, size, visible, narrow ? 90 : 120);
    if (!bar) return;
    const left = 18, y = size[1] - (bar.place ? 28 : 18);
    this.#line(c, [[left, y - 5], [left, y], [left + bar.pixels, y], [left + bar.pixels, y - 5]], this.ink.text, 1.6);
    c.font = `600 13px ${kFont}`;
    this.#text(c, barLabel(bar.length, model.claims), left + bar.pixels / 2, y - 14, "center");
    if (!bar.place) return;
    c.font = `500 11px ${kFont}`;
    this.#text(c, bar.place, left, y + 14, "left");
  }

  #cube(c, { camera, size, model, narrow }) {
    const { right, up, forward } = axesOf(camera), half = narrow ? 17 : 22, x0 = size[0] - (narrow ? 38 : 52), y0 = size[1] - (narrow ? 38 : 52);
    this.cubeFaces = [];
    const flat = (v) => [half * dot(v, right), -half * dot(v, up)];
    for (const face of kFaces) {
      const towards = -dot(face.normal, forward);
      if (towards <= 1e-3) continue;
      const u = flat(face.right), v = flat(face.up.map((value) => -value)), n = flat(face.normal);
      c.save();
      c.transform(u[0] / 50, u[1] / 50, v[0] / 50, v[1] / 50, x0 + n[0], y0 + n[1]);
      const lit = 0.72 + 0.38 * towards;
      c.fillStyle = `rgb(${face.colour.map((value) => Math.round(value * lit)).join(",")})`;
      c.fillRect(-50, -50, 100, 100);
      c.lineWidth = 4;
      c.strokeStyle = "rgba(225,230,240,.45)";
      c.strokeRect(-48, -48, 96, 96);
      const letter = model.claims.letters ? face.letter : face.axis;
      c.fillStyle = "#e9edf3";
      c.textAlign = "center";
      c.textBaseline = "middle";
      c.font = `600 ${letter.length > 1 ? 50 : 68}px ${kFont}`;
      c.fillText(letter, 0, 4);
      c.restore();
      const corner = (a, b) => [x0 + n[0] + a * u[0] + b * v[0], y0 + n[1] + a * u[1] + b * v[1]];
      this.cubeFaces.push({ view: face.view, corners: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)] });
    }
  }

  /** The view whose face of the cube is at a point, or null. */
  faceAt(x, y) {
    const found = this.cubeFaces.find(({ corners }) => insidePolygon([x, y], corners));
    return found ? found.view : null;
  }
}

/** Whether a point is inside a polygon (even-odd rule). */
export function insidePolygon([x, y], corners) {
  let inside = false;
  for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
    const [ax, ay] = corners[i], [bx, by] = corners[j];
    if (ay > y !== by > y && x < ax + (bx - ax) * (y - ay) / (by - ay)) inside = !inside;
  }
  return inside;
}
