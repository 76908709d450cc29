// Mouse, touch and keys on the picture. Mouse as in ramus: left-drag turns about the point under the pointer, Shift or the
// middle button pans, wheel and right button zoom to it, a double click centres. One finger turns, two pan and zoom.

import * as cameras from "./camera.js";
import { insidePolygon } from "./overlay.js";

const kDrag = 4; // points before a press becomes a drag
const kTouchDrag = 8;
const kWheelStep = 1.15, kNotch = 100;
const kLongPress = 550; // ms
const kSlowHover = 200; // ms that the pointer rests before a slow renderer looks what is there

export class Input {
  /** `actions`: select(pick, modifiers), measureAt(pick, point), lassoed(polygon, event), hovered(pick, x, y), menu. */
  constructor(viewport, actions) {
    Object.assign(this, { viewport, actions });
    this.tool = "select"; // select, lasso, distance, path, diameter
    this.fingers = new Map();
    const { canvas } = viewport;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#cancel(event));
    canvas.addEventListener("pointerleave", () => {
      clearTimeout(this.hovering);
      this.hovering = 0;
      actions.hovered(null);
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => this.#double(event));
  }

  #at(event) {
    const box = this.viewport.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #down(event) {
    const at = this.#at(event), { viewport } = this;
    viewport.canvas.focus({ preventScroll: true });
    viewport.canvas.setPointerCapture(event.pointerId);
    viewport.stop();
    this.fingers.set(event.pointerId, at);
    this.actions.hovered(null);
    if (this.fingers.size === 2) return this.#beginPinch();
    if (this.fingers.size > 2) return;
    const face = event.button === 0 ? viewport.overlay.faceAt(...at) : null;
    this.press = { at, last: at, button: event.button, shift: event.shiftKey, face, dragging: false, touch: event.pointerType === "touch" };
    if (face) return;
    this.press.aim = viewport.aim(...at);
    if (this.tool === "lasso" && event.button === 0 && !event.shiftKey) this.press.lasso = [at];
    if (event.pointerType === "touch") this.press.long = setTimeout(() => this.#longPress(), kLongPress);
  }

  // A long press takes all that depends on a branch, as Alt+click does.
  #longPress() {
    const { press } = this;
    if (!press || press.dragging || this.tool !== "select") return;
    press.done = true;
    this.actions.select(this.viewport.pick(...press.at), { dependents: true });
  }

  #beginPinch() {
    const [a, b] = [...this.fingers.values()], middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    if (this.press) clearTimeout(this.press.long);
    this.press = null;
    this.viewport.extra.lasso = null;
    this.pinch = { apart: Math.hypot(a[0] - b[0], a[1] - b[1]), middle, aim: this.viewport.aim(...middle), turn: Math.atan2(b[1] - a[1], b[0] - a[0]) };
  }

  #move(event) {
    const at = this.#at(event), { viewport, press } = this;
    if (!this.fingers.has(event.pointerId)) {
      if (event.pointerType !== "touch") this.#hover(at);
      return;
    }
    this.fingers.set(event.pointerId, at);
    if (this.pinch) return this.#movePinch();
    if (!press || press.done) return;
    if (!press.dragging && Math.hypot(at[0] - press.at[0], at[1] - press.at[1]) < (press.touch ? kTouchDrag : kDrag)) return;
    if (!press.dragging) clearTimeout(press.long);
    press.dragging = true;
    if (press.face) return;
    if (press.lasso) {
      press.lasso.push(at);
      viewport.extra.lasso = press.lasso;
      return viewport.redrawOverlay();
    }
    const from = press.last, { camera, size } = viewport, { point, goal, least } = press.aim;
    press.last = at;
    const next = press.button === 2 ? cameras.zoomedAbout(camera, goal, cameras.zoomOfDrag(size, from, at), least)
      : press.button === 1 || press.shift ? cameras.panned(camera, size, point, from, at)
        : cameras.rotated(camera, size, point, from, at);
    viewport.setCamera(next, { moving: true });
  }

  #movePinch() {
    const [a, b] = [...this.fingers.values()], { pinch, viewport } = this;
    const apart = Math.max(10, Math.hypot(a[0] - b[0], a[1] - b[1])), middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    let camera = cameras.panned(viewport.camera, viewport.size, pinch.aim.point, pinch.middle, middle);
    camera = cameras.zoomedAbout(camera, pinch.aim.goal, apart / Math.max(10, pinch.apart), pinch.aim.least);
    pinch.apart = apart;
    pinch.middle = middle;
    viewport.setCamera(camera, { moving: true });
  }

  #up(event) {
    this.fingers.delete(event.pointerId);
    if (this.pinch) {
      if (this.fingers.size < 2) this.pinch = null;
      return;
    }
    const { press, viewport } = this;
    this.press = null;
    if (!press) return;
    clearTimeout(press.long);
    if (press.done) return;
    const at = this.#at(event);
    if (press.lasso && press.dragging) {
      viewport.extra.lasso = null;
      viewport.redrawOverlay();
      if (press.lasso.length > 2) this.actions.lassoed(press.lasso, event);
      return;
    }
    if (press.dragging) return;
    if (press.face) return viewport.setView(press.face);
    if (press.button !== 0) return;
    const pick = viewport.pick(...at);
    if (["distance", "path", "diameter"].includes(this.tool)) return this.actions.measureAt(pick);
    this.actions.select(pick, {
      dependents: event.altKey || (event.ctrlKey && event.shiftKey), toggle: event.ctrlKey || event.metaKey, add: event.shiftKey,
    });
  }

  #cancel(event) {
    this.fingers.delete(event.pointerId);
    if (this.press) clearTimeout(this.press.long);
    this.press = this.pinch = null;
    this.viewport.extra.lasso = null;
    this.viewport.redrawOverlay();
  }

  #hover(at) {
    this.hoverAt = at;
    const wait = this.viewport.slow ? kSlowHover : 0; // picking draws, too
    if (wait) {
      clearTimeout(this.hovering);
      this.hovering = 0;
    }
    this.hovering ||= setTimeout(() => {
      this.hovering = 0;
      if (this.fingers.size) return;
      const [x, y] = this.hoverAt;
      const face = this.viewport.overlay.faceAt(x, y);
      this.viewport.canvas.style.cursor = face ? "pointer" : this.tool === "select" ? "default" : "crosshair";
      this.actions.hovered(face ? null : this.viewport.pick(x, y, true), x, y);
    }, wait || 16);
  }

  #wheel(event) {
    event.preventDefault();
    const { viewport } = this, at = this.#at(event), now = performance.now();
    if (!this.wheelAim || now - this.wheelAt > 400 || Math.hypot(at[0] - this.wheelPlace[0], at[1] - this.wheelPlace[1]) > 2) {
      this.wheelAim = viewport.aim(...at);
      this.wheelPlace = at;
    }
    this.wheelAt = now;
    const lines = event.deltaMode === 1 ? event.deltaY * 33 : event.deltaMode === 2 ? event.deltaY * 300 : event.deltaY;
    const notches = -Math.max(-3, Math.min(3, lines / kNotch));
    viewport.setCamera(cameras.zoomedAbout(viewport.camera, this.wheelAim.goal, kWheelStep ** notches, this.wheelAim.least), { moving: true });
  }

  #double(event) {
    const pick = this.tool === "select" ? this.viewport.pick(...this.#at(event)) : null;
    if (pick && pick.point) this.viewport.goTo(cameras.centredOn(this.viewport.camera, pick.point));
  }
}

/** The branches with at least half of their centerline inside a polygon of points of the page. */
export function branchesInside(polygon, model, camera, size, layers) {
  const at = cameras.projector(camera, size), found = [];
  for (let id = 0; id < model.branches.length; ++id) {
    if (layers[id] === 2) continue;
    const line = model.tree.line(id);
    let inside = 0, all = 0, last = null;
    for (const point of line) {
      const pixel = at(point.at), within = pixel ? insidePolygon(pixel, polygon) : false;
      if (last) {
        const long = point.fraction - last.fraction;
        all += long;
        inside += long * (within + last.within) / 2;
      }
      last = { fraction: point.fraction, within };
    }
    if (all > 0 && inside >= 0.5 * all) found.push(id);
  }
  return found;
}
