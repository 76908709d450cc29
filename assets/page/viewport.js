// The picture on the page: its size, when it is drawn and how finely, moves of the camera, picking.
// Nothing is drawn while nothing changes. While the view moves, one coarse view is drawn; at rest, more views follow
// until the picture is smooth.

import * as cameras from "./camera.js";
import { kViewsOfPicture } from "./draw.js";
import { legendOf } from "./looks.js";
import { dot, subtract } from "./vector.js";

const kRestAfter = 180; // ms without a move
const kSlow = 60, kFast = 20; // ms for one view
const kLeastScale = 0.34;
const kSavedAspect = 4 / 3; // of ramus' pictures, at least
const kAnimation = 260; // ms of a change of view

export class Viewport {
  constructor(canvas, overlay, renderer, looks, model) {
    Object.assign(this, { canvas, overlay, renderer, looks, model });
    this.factor = 1; // of saved pictures: pixels per pixel of the page
    this.ground = model.json.ground === "light" ? "light" : "dark";
    this.frames = 0; // pictures that were shown
    this.pace = { scale: 0.5, fine: false, views: 1 }; // while the view moves: pixels drawn per pixel, all triangles, views
    this.cost = 2 * kSlow; // ms of one view while it moves; not known yet
    this.view = 0; // the next view of the picture
    this.moving = true; // a person moves the view; the first picture is a coarse one, too
    this.extra = {}; // lasso, draft
    this.moves = []; // listeners
    this.size = [1, 1];
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      renderer.build();
      looks.renew();
      this.redraw();
    });
    this.camera = cameras.cameraFrom({});
    this.resize();
    this.camera = model.json.camera ? this.saved(model.json.camera) : this.seeing("anterior");
    this.#ask();
  }

  /** A camera of the file. On an upright screen it steps back, so that what it showed stays in the picture. */
  saved(given) {
    const camera = cameras.cameraFrom(given), narrow = this.size[0] / this.size[1] / kSavedAspect;
    return narrow < 1 ? cameras.zoomedAbout(camera, camera.focal_point, narrow, 0) : camera;
  }

  get ratio() { return this.factor * Math.min(2, window.devicePixelRatio || 1); }

  resize() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    this.size = [Math.max(1, Math.round(box.width)), Math.max(1, Math.round(box.height))];
    this.narrow = this.size[0] < 560;
    this.redraw();
  }

  get pixels() { return this.size.map((points) => Math.max(1, Math.round(points * this.ratio))); }

  // The canvas has as many pixels as were drawn: the browser enlarges them.
  #present() {
    const { canvas } = this, [width, height] = this.renderer.used;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    this.renderer.present();
  }

  /** Sets the camera; `moving`: a person moves it, so that speed counts. */
  setCamera(camera, { moving = false } = {}) {
    this.camera = camera;
    if (moving) this.moving = true;
    this.redraw();
    for (const listener of this.moves) listener();
  }

  /** Goes to a camera within a quarter of a second. */
  goTo(camera) {
    cancelAnimationFrame(this.going);
    if (this.still.matches || this.slow) return this.setCamera(camera);
    const from = cameras.withProjection(this.camera, camera.orthographic), start = performance.now();
    const step = () => {
      const share = Math.min(1, (performance.now() - start) / kAnimation);
      this.setCamera(cameras.between(from, camera, share * share * (3 - 2 * share)), { moving: true });
      if (share < 1) this.going = requestAnimationFrame(step);
    };
    step();
  }

  stop() { cancelAnimationFrame(this.going); }

  /** The picture is no longer right: draws it again, in the next frame of the browser. */
  redraw() {
    if (this.slow) this.moving = true; // a coarse answer at once, the fine one when nothing more comes
    this.view = 0;
    this.visibleOf = null;
    this.#ask();
  }
  redrawOverlay() {
    this.overlayOnly = true;
    this.#ask();
  }
  #ask() { this.asked ||= requestAnimationFrame(() => this.#frame()); }

  #frame() {
    this.asked = 0;
    const { moving } = this;
    this.#draw(moving);
    clearTimeout(this.resting);
    // From the end of the frame, so that input which came during a slow frame counts.
    if (moving) this.resting = setTimeout(() => this.#rest(), kRestAfter);
    else if (this.view < this.#viewsAtRest) {
      // A slow renderer must not be busy with details when the next move comes.
      if (this.slow) this.resting = setTimeout(() => this.#ask(), this.view === 1 ? 500 : 100);
      else this.#ask();
    }
    this.drawOverlay();
  }

  /** Whether one view takes long, as without a graphics card. */
  get slow() { return this.cost > kSlow; }
  get #viewsAtRest() { return this.slow ? kViewsOfPicture / 2 : kViewsOfPicture; }
  #rest() {
    this.moving = false;
    this.view = 0;
    this.#ask();
  }

  #draw(moving) {
    if (this.view >= (moving ? 1 : this.#viewsAtRest)) return;
    const start = performance.now(), rounds = moving ? this.pace.views : 1;
    for (let round = 0; round < rounds; ++round) this.#drawView(moving ? round : this.view, moving);
    this.#present();
    if (moving || this.slow) {
      this.renderer.finish();
      // The first frame also compiles.
      if (moving && this.frames > 0) this.#keepPace(performance.now() - start);
    }
    this.frames += 1;
    this.view = moving ? 0 : this.view + 1;
  }

  // While the view moves: fewer pixels where drawing is slow; all pixels, then all triangles and several views where it is
  // fast.
  #keepPace(took) {
    const { pace } = this;
    this.cost = took;
    if (took > kSlow) this.pace = { scale: Math.max(kLeastScale, pace.scale * Math.max(0.6, Math.sqrt(kSlow / took))), fine: false, views: 1 };
    else if (took > kFast) this.pace = { ...pace, views: Math.max(1, pace.views >> 1) };
    else if (pace.scale < 1) pace.scale = Math.min(1, pace.scale * 1.2);
    else if (!pace.fine) pace.fine = took < kFast / 4;
    else if (took < kFast / 2) pace.views = Math.min(4, 2 * pace.views);
  }

  #drawView(view, moving, camera = this.camera) {
    this.renderer.drawView({
      camera, size: this.pixels, look: this.looks.look(this.ground), view,
      scale: moving ? this.pace.scale : 1, coarse: moving && !this.pace.fine, point: this.ratio,
    });
  }

  drawOverlay() {
    this.overlay.draw(this.#scene(), this.ratio);
  }
  #scene() {
    return {
      camera: this.camera, size: this.size, visible: this.visible, model: this.model, narrow: this.narrow,
      ink: this.ground === "light" ? "dark" : "light", ...this.extra,
    };
  }

  /** Draws everything at once, fine; for pictures and for measuring. */
  drawNow() {
    for (let view = 0; view < kViewsOfPicture; ++view) this.#drawView(view, false);
    this.#present();
    this.view = kViewsOfPicture;
    this.frames += 1;
  }

  /** Draws one view as while the view moves; returns ms. */
  timeOfMoving() {
    const start = performance.now();
    this.#drawView(0, true);
    this.#present();
    this.renderer.finish();
    const took = performance.now() - start;
    this.redraw();
    return took;
  }

  /** The picture with what is drawn over it and its legend, as a canvas; `bare`: without. */
  picture({ bare = false, ground = this.ground, factor = 1 } = {}) {
    const now = this.ground;
    this.ground = ground;
    this.factor = factor;
    this.drawNow();
    const all = document.createElement("canvas");
    all.width = this.canvas.width;
    all.height = this.canvas.height;
    const context = all.getContext("2d");
    context.drawImage(this.canvas, 0, 0);
    if (!bare) {
      context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
      this.overlay.paint(context, { ...this.#scene(), legend: legendOf(this.model) });
    }
    this.ground = now;
    this.factor = 1;
    this.redraw();
    return all;
  }

  /** The middle of what the picture shows, and half its depth: mm. From the centerlines that are drawn, or null. */
  get visible() {
    if (this.visibleOf === this.camera) return this.visibleNow;
    this.visibleOf = this.camera;
    const { points, first } = this.renderer.centerlines, layers = this.renderer.layerBytes;
    const { right, up, forward } = cameras.axesOf(this.camera), [width, height] = this.size, at = cameras.projector(this.camera, this.size);
    const step = Math.max(1, Math.floor(points.length / 4 / 3000)), found = [[], [], []];
    for (let b = 0; b + 1 < first.length; ++b) {
      if (layers[b] === 2) continue;
      for (let i = first[b]; i < first[b + 1]; i += step) {
        const p = [points[4 * i], points[4 * i + 1], points[4 * i + 2]], pixel = at(p);
        if (!pixel || pixel[0] < 0 || pixel[1] < 0 || pixel[0] > width || pixel[1] > height) continue;
        const v = subtract(p, this.camera.position);
        found[0].push(dot(v, right));
        found[1].push(dot(v, up));
        found[2].push(dot(v, forward));
      }
    }
    this.visibleNow = null;
    if (!found[0].length) return null;
    const ranges = found.map((list) => {
      list.sort((a, b) => a - b);
      const out = Math.floor(0.02 * list.length);
      return [list[out], list[list.length - 1 - out]];
    });
    const [x, y, z] = ranges.map(([low, high]) => 0.5 * (low + high)), { position } = this.camera;
    this.visibleNow = { middle: position.map((value, k) => value + x * right[k] + y * up[k] + z * forward[k]), halfDepth: 0.5 * (ranges[2][1] - ranges[2][0]) };
    return this.visibleNow;
  }

  /** What is at a point of the page: { branch, shape, point (mm), exact }, or null. `quick`: for hovering. */
  pick(x, y, quick = false) {
    const found = this.renderer.pick(this.camera, this.size, x, y, this.looks.look(this.ground), quick);
    if (!found) return null;
    const count = this.model.branches.length, shape = found.id >= count ? found.id - count : -1;
    const pick = { branch: shape < 0 ? found.id : null, shape: shape < 0 ? null : shape, exact: found.exact };
    if (!quick) pick.point = shape < 0 ? this.renderer.pointOn(found.id, this.camera, this.size, [x, y])
      : this.renderer.pointOnShape(shape, this.camera, this.size, [x, y]);
    return pick;
  }

  /** What a move of the mouse is about: the point under the pointer, or the middle of what is visible; zooms go to `goal`. */
  aim(x, y) {
    const pick = this.pick(x, y), middle = this.visible ? this.visible.middle : this.camera.focal_point;
    // No nearer than a part of the vessel's radius.
    const least = pick && pick.branch !== null ? 0.5 * this.model.branches[pick.branch].diameter_mm.min : 1e-3 * this.renderer.ball.radius;
    const goal = pick && pick.point ? pick.point : cameras.unproject(this.camera, this.size, [x, y], cameras.depthOf(this.camera, middle));
    return { point: pick && pick.point ? pick.point : middle, goal, least: Math.max(least, 1e-4 * this.renderer.ball.radius) };
  }

  /** Where a point (mm) is on the page: [x, y, depth], or null. */
  project(point) { return cameras.projector(this.camera, this.size)(point); }

  fit(ids = null) {
    const { surface } = this.renderer;
    if (!ids || !ids.length) return this.goTo(cameras.fitted(this.camera, surface.positions, this.size));
    const points = [];
    for (const id of ids)
      for (const { at, radius } of this.model.tree.line(id))
        for (let k = 0; k < 6; ++k) points.push(...at.map((value, i) => value + (i === k >> 1 ? (k & 1 ? radius : -radius) : 0)));
    this.goTo(cameras.fitted(this.camera, points, this.size));
  }

  /** The camera of a named view, with everything in the picture. */
  seeing(name) { return cameras.fitted(cameras.looking(this.camera, name), this.renderer.surface.positions, this.size); }
  setView(name) { this.goTo(this.seeing(name)); }
}
