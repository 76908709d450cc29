// Draws the case with WebGL 2. A picture is the mean of several views that are shifted by less than a pixel. Each view:
// visible surfaces as ids and normals, occlusion, centerlines inside glass, glass as sums that do not depend on the order
// of layers, then one pass that shades. The camera and the looks are values; nothing here knows the page.

import { axesOf, depthRange, matrices, rayThrough } from "./camera.js";
import { linear, makeBuffer, makeProgram, makeTarget, makeTexture, toLinear } from "./gl.js";
import * as shaders from "./shaders.js";
import { dot, scaled, add, subtract, length } from "./vector.js";

const kRow = 1024; // records per row of their texture
const kOcclusionShare = 0.055, kOcclusionTaps = 20, kMovingTaps = 7;
const kLineWidth = 1.6; // of centerlines inside glass, points
const kPickRadius = 6; // points by which a click may miss a vessel
export const kViewsOfPicture = 8;
// Places in the pixel, in sixteenths: eight rooks.
const kShifts = [[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]];

export class Renderer {
  /** `surface`, `centerlines`: of the case. `shapes`: meshes { positions, normals, indices }. Throws without WebGL 2. */
  constructor(canvas, { surface, centerlines, shapes, branchCount }) {
    this.canvas = canvas;
    Object.assign(this, { surface, centerlines, shapes, branchCount });
    const options = { antialias: false, alpha: false, depth: false, stencil: false, powerPreference: "high-performance" };
    this.gl = canvas.getContext("webgl2", options);
    if (!this.gl) throw new Error("this browser has no WebGL 2");
    this.#bounds();
    this.build();
  }

  #bounds() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const include = (positions) => {
      for (let i = 0; i < positions.length; i += 3)
        for (let k = 0; k < 3; ++k) {
          if (positions[i + k] < low[k]) low[k] = positions[i + k];
          if (positions[i + k] > high[k]) high[k] = positions[i + k];
        }
    };
    include(this.surface.positions);
    this.box = { centre: scaled(add(low, high), 0.5), half: scaled(subtract(high, low), 0.5) };
    for (const shape of this.shapes) include(shape.positions);
    const centre = scaled(add(low, high), 0.5);
    this.ball = { centre, radius: Math.max(0.5 * length(subtract(high, low)), 1e-3) };
  }

  /** Builds everything on the card; again after a lost context. */
  build() {
    const { gl, surface } = this;
    this.float = Boolean(gl.getExtension("EXT_color_buffer_float") || gl.getExtension("EXT_color_buffer_half_float"));
    gl.getExtension("EXT_float_blend");
    const program = (vertex, fragment) => makeProgram(gl, vertex, fragment);
    this.programs = {
      surface: program(shaders.kSurfaceVertex, shaders.kSurfaceFragment), line: program(shaders.kLineVertex, shaders.kSurfaceFragment),
      id: program(shaders.kSurfaceVertex, shaders.kIdFragment), glass: program(shaders.kSurfaceVertex, shaders.kGlassFragment),
      occlusion: program(shaders.kScreenVertex, shaders.kOcclusionFragment), blur: program(shaders.kScreenVertex, shaders.kBlurFragment),
      shade: program(shaders.kScreenVertex, shaders.kShadeFragment), present: program(shaders.kScreenVertex, shaders.kPresentFragment),
    };
    gl.vertexAttribI4ui(2, 0, 0, 0, 0); // shapes have no branches
    this.nothing = gl.createVertexArray();
    this.vessels = this.#arrays(surface);
    this.values = null;
    this.bodies = this.shapes.map((shape) => {
      const body = this.#arrays(shape);
      gl.bindVertexArray(body.arrays);
      makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, shape.indices);
      return { ...body, count: shape.indices.length };
    });
    gl.bindVertexArray(null);
    this.lists = {};
    for (const name of ["solid", "glass", "solidCoarse", "glassCoarse"]) this.lists[name] = { buffer: gl.createBuffer(), count: 0 };
    const rows = Math.ceil((this.branchCount + this.shapes.length + 1) / kRow);
    this.records = makeTexture(gl, gl.RGBA16UI, kRow, rows);
    this.layers = makeTexture(gl, gl.R8UI, kRow, rows);
    this.recordRows = rows;
    for (const name of ["ramp", "sky"]) this[name] = makeTexture(gl, this.float ? gl.RGBA16F : gl.RGBA8, 64, 1, gl.LINEAR);
    this.skyOf = null;
    this.blank = makeTexture(gl, gl.RGBA8, 1, 1);
    this.#lines();
    const size = 2 * kPickRadius + 1;
    this.pickTarget = makeTarget(gl, [makeTexture(gl, gl.RG32UI, size, size)], makeTexture(gl, gl.DEPTH_COMPONENT24, size, size));
    this.targets = null;
    this.summed = 0;
  }

  #arrays({ positions, normals, branches }) {
    const { gl } = this, arrays = gl.createVertexArray();
    gl.bindVertexArray(arrays);
    makeBuffer(gl, gl.ARRAY_BUFFER, positions);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    makeBuffer(gl, gl.ARRAY_BUFFER, normals);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.BYTE, true, 0, 0);
    if (branches) {
      makeBuffer(gl, gl.ARRAY_BUFFER, branches);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribIPointer(2, 1, branches.BYTES_PER_ELEMENT === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, 0, 0);
    }
    return { arrays };
  }

  #lines() {
    const { gl } = this, { points, first } = this.centerlines;
    const ends = [], ids = [];
    for (let b = 0; b < this.branchCount; ++b)
      for (let i = first[b]; i + 1 < first[b + 1]; ++i) {
        for (const at of [i, i + 1]) ends.push(points[4 * at], points[4 * at + 1], points[4 * at + 2]);
        ids.push(b);
      }
    const arrays = gl.createVertexArray();
    gl.bindVertexArray(arrays);
    makeBuffer(gl, gl.ARRAY_BUFFER, new Float32Array(ends));
    [0, 12].forEach((offset, place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, offset);
      gl.vertexAttribDivisor(place, 1);
    });
    makeBuffer(gl, gl.ARRAY_BUFFER, new Uint32Array(ids));
    gl.enableVertexAttribArray(2);
    gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_INT, 0, 0);
    gl.vertexAttribDivisor(2, 1);
    this.segments = { arrays, count: ids.length };
  }

  /** Which branches are solid (0), glass (1) or not drawn (2): a byte per branch. */
  setLayers(layers) {
    const { gl, surface } = this;
    this.layerBytes = layers;
    for (const [suffix, list] of [["", surface], ["Coarse", surface.coarse]])
      for (const [name, wanted] of [["solid", 0], ["glass", 1]]) {
        const target = this.lists[name + suffix];
        target.count = 0;
        if (!list) continue;
        const runs = []; // of neighbouring ranks
        for (let id = 0; id < this.branchCount; ++id) if (layers[id] === wanted) runs.push(surface.rank[id]);
        runs.sort((a, b) => a - b);
        gl.bindVertexArray(null);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, target.buffer);
        const total = runs.reduce((sum, rank) => sum + list.first[rank + 1] - list.first[rank], 0);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, 4 * total, gl.DYNAMIC_DRAW);
        for (let i = 0; i < runs.length;) {
          let end = i + 1;
          while (end < runs.length && runs[end] === runs[end - 1] + 1) ++end;
          const part = list.indices.subarray(list.first[runs[i]], list.first[runs[end - 1] + 1]);
          gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 4 * target.count, part);
          target.count += part.length;
          i = end;
        }
      }
    const bytes = new Uint8Array(kRow * this.recordRows);
    bytes.set(layers);
    gl.bindTexture(gl.TEXTURE_2D, this.layers);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, kRow, this.recordRows, gl.RED_INTEGER, gl.UNSIGNED_BYTE, bytes);
  }

  /** Colours ("#rrggbb") and flags of branches, then of shapes. */
  setRecords(colours, flags) {
    const { gl } = this, words = new Uint16Array(4 * kRow * this.recordRows), known = new Map();
    colours.forEach((colour, i) => {
      if (!known.has(colour)) known.set(colour, linear(colour).map((c) => Math.round(65535 * c)));
      words.set(known.get(colour), 4 * i);
      words[4 * i + 3] = flags[i];
    });
    gl.bindTexture(gl.TEXTURE_2D, this.records);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, kRow, this.recordRows, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, words);
  }

  /** Two numbers per vertex: the value that colours follow, and mm beyond a cut. Null: none. */
  setValues(values) {
    const { gl } = this;
    gl.bindVertexArray(this.vessels.arrays);
    if (values && this.float) {
      this.values ||= gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, this.values);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(3);
      gl.vertexAttribPointer(3, 2, gl.FLOAT, false, 0, 0);
    } else gl.disableVertexAttribArray(3);
    gl.bindVertexArray(null);
    this.hasValues = Boolean(values && this.float);
  }

  /** 64 sRGB colours: of the scale that colours follow, or of the background from below. */
  #fillRow(texture, colourAt) {
    const { gl } = this, list = Array.from({ length: 64 }, (_, i) => [...colourAt(i / 63).map(toLinear), 1]).flat();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 64, 1, gl.RGBA, this.float ? gl.FLOAT : gl.UNSIGNED_BYTE,
      this.float ? new Float32Array(list) : Uint8Array.from(list, (c) => Math.round(255 * c)));
  }
  setRamp(colourAt) { this.#fillRow(this.ramp, colourAt); }
  #setSky({ top, bottom }) {
    const key = String([top, bottom]);
    if (this.skyOf === key) return;
    this.skyOf = key;
    this.#fillRow(this.sky, (t) => top.map((c, k) => bottom[k] + t * t * (3 - 2 * t) * (c - bottom[k])));
  }

  #resize(width, height) {
    const { gl } = this;
    if (this.targets && this.targets.width === width && this.targets.height === height) return;
    if (this.targets) {
      for (const texture of this.targets.textures) gl.deleteTexture(texture);
      for (const target of this.targets.all) gl.deleteFramebuffer(target);
    }
    const textures = [], texture = (format, filter) => {
      textures.push(makeTexture(gl, format, width, height, filter));
      return textures[textures.length - 1];
    };
    const sums = this.float ? gl.RGBA16F : gl.RGBA8;
    const t = { width, height, textures };
    t.surface = texture(gl.RG32UI);
    t.depth = texture(gl.DEPTH_COMPONENT24);
    t.values = this.float ? texture(gl.RG16F) : null;
    t.hidden = [texture(gl.R8), texture(gl.R8)];
    t.light = texture(sums);
    t.weight = texture(sums);
    t.sum = texture(sums, gl.LINEAR);
    t.surfaceTarget = makeTarget(gl, t.values ? [t.surface, t.values] : [t.surface], t.depth);
    t.hiddenTargets = t.hidden.map((one) => makeTarget(gl, [one]));
    t.glassTarget = makeTarget(gl, [t.light, t.weight], t.depth);
    t.sumTarget = makeTarget(gl, [t.sum]);
    t.all = [t.surfaceTarget, ...t.hiddenTargets, t.glassTarget, t.sumTarget];
    this.targets = t;
  }

  // Uniforms that all passes of a view share.
  #common(camera, size, look, shift) {
    const range = depthRange(camera, this.ball.centre, this.ball.radius), { forward } = axesOf(camera);
    const tan = Math.tan(camera.view_angle * Math.PI / 360);
    const mm = 2 * (camera.orthographic ? camera.scale : tan) / size[1];
    const middle = dot(subtract(this.box.centre, camera.position), forward);
    const deep = Math.max(this.box.half.reduce((sum, value, k) => sum + value * Math.abs(forward[k]), 0), 1e-3 * this.ball.radius);
    const reach = Math.max(4, kOcclusionShare * size[1]);
    return {
      ...matrices(camera, size, range, shift), range: [range.near, range.far],
      picture: [size[0], size[1], camera.orthographic ? 1 : 0],
      eye: [0.5 * size[0] + shift[0], 0.5 * size[1] + shift[1], mm],
      tree: [middle - deep, middle + deep, reach, reach * mm], mesh: 0, records: this.records,
      glass_colour: look.glass, lost_colour: look.lost, line_colour: look.line, selection_colour: look.selection,
      far_colour: look.far, strength: [look.depthCue, look.glassOpacity], drop: look.drop ? 1 : 0,
    };
  }

  /**
   * Draws one view and adds it to the sum. `size`: pixels of the canvas. `look`: see looks.js. `view`: its number;
   * 0 begins a new picture. `scale`: pixels drawn per pixel of the canvas, 1 or less.
   */
  drawView({ camera, size, look, view = 0, scale = 1, coarse = false, point = 1 }) {
    const { gl } = this;
    this.#resize(...size);
    const t = this.targets, used = size.map((n) => Math.max(1, Math.round(n * scale)));
    const shift = scale < 1 ? [0, 0] : kShifts[view % kShifts.length].map((n) => n / 16);
    const common = this.#common(camera, used, look, shift);
    const uniforms = { ...common, to_clip: common.toClip, to_eye: common.toEye };
    this.uniforms = uniforms;
    this.#setSky(look);
    const fast = coarse && this.surface.coarse ? "Coarse" : "";
    const clearing = !view;
    gl.viewport(0, 0, ...used);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.depthMask(true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, t.surfaceTarget);
    const both = this.hasValues && t.values;
    gl.drawBuffers(t.values ? [gl.COLOR_ATTACHMENT0, both ? gl.COLOR_ATTACHMENT1 : gl.NONE] : [gl.COLOR_ATTACHMENT0]);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    this.#drawList("surface", "solid" + fast, uniforms);
    this.#drawBodies("surface", look.shapes, (shape) => shape.opacity >= 0.999, uniforms);
    this.#occlusion(uniforms, used, look, scale < 1 || coarse ? kMovingTaps : kOcclusionTaps, view);
    const clear = look.shapes.some((shape) => shape.visible && shape.opacity > 0 && shape.opacity < 0.999);
    const glass = this.lists["glass" + fast].count > 0;
    if (glass) this.#centerlines(uniforms, used, point * scale);
    if (glass || clear) this.#glass(uniforms, "glass" + fast, look);
    gl.disable(gl.DEPTH_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, t.sumTarget);
    gl.bindVertexArray(this.nothing);
    if (!clearing && this.float) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE);
    }
    this.programs.shade({
      ...uniforms, surface: t.surface, depths: t.depth, occlusion: t.hidden[0], values: both ? t.values : this.blank,
      glass_light: t.light, glass_weight: t.weight, glass: glass || clear ? 1 : 0, ramp: this.ramp, sky: this.sky,
      scale: look.scale && both ? look.scale : [0, 0, 0, 0], bands: both ? look.bands.length : 0, band: this.#bandsOf(look),
      outline: look.outlined ? Math.max(1, 1.6 * point * scale) : 0, point: Math.max(1, point * scale),
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.BLEND);
    this.summed = clearing || !this.float ? 1 : this.summed + 1;
    this.used = used;
  }

  #bandsOf(look) {
    const bands = new Float32Array(32);
    look.bands.slice(0, 8).forEach((band, i) => bands.set([...linear(band.colour), band.mm], 4 * i));
    return bands;
  }

  #drawList(program, name, uniforms) {
    const { gl } = this, list = this.lists[name];
    if (!list.count) return;
    this.programs[program](uniforms);
    gl.bindVertexArray(this.vessels.arrays);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, list.buffer);
    gl.drawElements(gl.TRIANGLES, list.count, gl.UNSIGNED_INT, 0);
  }

  #drawBodies(program, shapes, which, uniforms) {
    const { gl } = this;
    shapes.forEach((shape, i) => {
      if (!shape.visible || !which(shape)) return;
      this.programs[program]({ ...uniforms, mesh: this.branchCount + i + 1, opacity: shape.opacity });
      gl.bindVertexArray(this.bodies[i].arrays);
      gl.drawElements(gl.TRIANGLES, this.bodies[i].count, this.shapes[i].indices.BYTES_PER_ELEMENT === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, 0);
    });
  }

  #occlusion(uniforms, used, look, taps, view) {
    const { gl, targets: t } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.nothing);
    gl.bindFramebuffer(gl.FRAMEBUFFER, t.hiddenTargets[0]);
    this.programs.occlusion({ ...uniforms, surface: t.surface, depths: t.depth, taps, turn: (view % kViewsOfPicture) / kViewsOfPicture });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    [[1, 0], [0, 1]].forEach((step, i) => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, t.hiddenTargets[1 - i]);
      this.programs.blur({ ...uniforms, occlusion: t.hidden[i], depths: t.depth, step_by: step });
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    });
    gl.enable(gl.DEPTH_TEST);
  }

  #centerlines(uniforms, used, point) {
    const { gl, targets: t } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, t.surfaceTarget);
    this.programs.line({ ...uniforms, half_picture: [0.5 * used[0], 0.5 * used[1], 0.5 * Math.max(kLineWidth * point, 1)], layers: this.layers });
    gl.bindVertexArray(this.segments.arrays);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.segments.count);
  }

  #glass(uniforms, list, look) {
    const { gl, targets: t } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, t.glassTarget);
    gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 1]);
    gl.clearBufferfv(gl.COLOR, 1, [0, 0, 0, 0]);
    gl.depthMask(false);
    gl.enable(gl.CULL_FACE);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.ONE, gl.ONE, gl.ZERO, gl.ONE_MINUS_SRC_ALPHA);
    const shared = { ...uniforms, opacity: 0, weight_unit: this.float ? 1 : 0.2 };
    this.#drawList("glass", list, shared);
    this.#drawBodies("glass", look.shapes, (shape) => shape.opacity > 0 && shape.opacity < 0.999, shared);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
  }

  /** Brings the sum of views to the canvas. */
  present() {
    const { gl, targets: t } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.bindVertexArray(this.nothing);
    gl.disable(gl.DEPTH_TEST);
    this.programs.present({
      picture: t.sum, share: 1 / this.summed,
      scale: [this.used[0] / t.width / this.canvas.width, this.used[1] / t.height / this.canvas.height],
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Waits until the card is done; for measuring. */
  finish() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /**
   * The branch or shape at a pixel (points from the top left; `size` of the picture in points), or next to it:
   * { id, exact } with ids as in the records, or null. Solid before glass; shapes only if they may be picked.
   */
  pick(camera, size, x, y, look, coarse = false) {
    const { gl } = this, wide = 2 * kPickRadius + 1, fast = coarse && this.surface.coarse ? "Coarse" : "";
    const range = depthRange(camera, this.ball.centre, this.ball.radius);
    const { toClip, toEye } = matrices(camera, size, range, [0, 0], { x, y, size: wide });
    const uniforms = { to_clip: toClip, to_eye: toEye, mesh: 0, drop: look.drop ? 1 : 0 };
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    gl.viewport(0, 0, wide, wide);
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    for (const name of ["solid", "glass"]) {
      gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
      gl.clearBufferfv(gl.DEPTH, 0, [1]);
      this.#drawList("id", name + fast, uniforms);
      this.#drawBodies("id", look.shapes, (shape) => shape.picked, uniforms);
      const pixels = new Uint32Array(4 * wide * wide);
      gl.readPixels(0, 0, wide, wide, gl.RGBA_INTEGER, gl.UNSIGNED_INT, pixels);
      let best = null;
      for (let i = 0; i < wide * wide; ++i) {
        if (!pixels[4 * i]) continue;
        const away = Math.hypot(i % wide - kPickRadius, Math.floor(i / wide) - kPickRadius);
        if (away <= kPickRadius && (!best || away < best.away)) best = { away, id: pixels[4 * i] - 1 };
      }
      if (best) return { id: best.id, exact: best.away === 0 };
    }
    return null;
  }

  /** The point of a branch's surface under a pixel, or the nearest to the ray through it: mm. */
  pointOn(branch, camera, size, pixel) {
    const { surface } = this, rank = surface.rank[branch];
    return nearestAlong(rayThrough(camera, size, pixel), surface.positions, surface.indices, surface.first[rank], surface.first[rank + 1]);
  }

  /** The same for a shape. */
  pointOnShape(number, camera, size, pixel) {
    const { positions, indices } = this.shapes[number];
    return nearestAlong(rayThrough(camera, size, pixel), positions, indices, 0, indices.length);
  }
}

// The first hit of a ray with triangles; without a hit, the vertex that is nearest to the ray.
function nearestAlong({ start, direction }, positions, indices, from, to) {
  let best = Infinity, miss = Infinity, point = null;
  const at = (i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
  for (let i = from; i < to; i += 3) {
    const a = at(indices[i]), ab = subtract(at(indices[i + 1]), a), ac = subtract(at(indices[i + 2]), a), s = subtract(start, a);
    const n = [direction[1] * ac[2] - direction[2] * ac[1], direction[2] * ac[0] - direction[0] * ac[2], direction[0] * ac[1] - direction[1] * ac[0]];
    const det = dot(ab, n);
    if (Math.abs(det) > 1e-14) {
      const u = dot(s, n) / det;
      const q = [s[1] * ab[2] - s[2] * ab[1], s[2] * ab[0] - s[0] * ab[2], s[0] * ab[1] - s[1] * ab[0]];
      const v = dot(direction, q) / det, t = dot(ac, q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < best) {
        best = t;
        point = add(start, scaled(direction, t));
      }
    }
    if (best < Infinity) continue;
    const far = -dot(s, direction), away = length(add(s, scaled(direction, far)));
    if (far > 0 && away < miss) {
      miss = away;
      point = a;
    }
  }
  return point;
}
