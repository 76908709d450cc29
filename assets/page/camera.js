// The camera as a plain value with the names of session files: position, focal_point, view_up (mm, RAS), view_angle
// (degrees), orthographic, scale (half the height of the picture in mm). Every move returns a new camera. Pixels count
// from the top left of a picture of `size` = [width, height]. The moves are those of ramus' own window: a point `at`
// that a person points at keeps its place while the view turns about it or zooms to it.

import { add, subtract, scaled, along, dot, cross, length, distance, unit, turned as turnedVector } from "./vector.js";

const kDegreesPerPicture = 200; // rotation over one picture width
const kMargin = 1.06; // room around the tree
const kFarthest = 1e8; // mm
const radians = (degrees) => degrees * Math.PI / 180;
const tanHalf = (camera) => Math.tan(radians(0.5 * camera.view_angle));

/** The six views: where the viewer stands, what is up. RAS: +x is the patient's right side. */
export const kViews = {
  anterior: { axis: "+y", key: "A", towards: [0, 1, 0], up: [0, 0, 1] },
  posterior: { axis: "-y", key: "P", towards: [0, -1, 0], up: [0, 0, 1] },
  left: { axis: "-x", key: "L", towards: [-1, 0, 0], up: [0, 0, 1] },
  right: { axis: "+x", key: "R", towards: [1, 0, 0], up: [0, 0, 1] },
  superior: { axis: "+z", key: "S", towards: [0, 0, 1], up: [0, 1, 0] },
  inferior: { axis: "-z", key: "I", towards: [0, 0, -1], up: [0, 1, 0] },
};

/** A complete camera that can be drawn; names that are missing in `given` come from `base`. */
export function cameraFrom(given, base = {}) {
  const all = { position: [0, 500, 0], focal_point: [0, 0, 0], view_up: [0, 0, 1], view_angle: 30, orthographic: false, scale: 100, ...base, ...given };
  const camera = {};
  for (const name of ["position", "focal_point", "view_up"]) camera[name] = all[name].map(Number);
  camera.view_angle = Math.min(170, Math.max(1, Number(all.view_angle) || 30));
  camera.orthographic = Boolean(all.orthographic);
  camera.scale = Number(all.scale) > 0 ? Number(all.scale) : 100;
  if (!(distance(camera.position, camera.focal_point) > 0)) camera.position = add(camera.focal_point, [0, 1, 0]);
  return camera;
}

/** Unit axes of the picture: right, up, and forward into it. */
export function axesOf(camera) {
  const forward = unit(subtract(camera.focal_point, camera.position));
  let right = cross(forward, camera.view_up);
  if (length(right) < 1e-9 * Math.max(1e-300, length(camera.view_up)))
    right = cross(forward, Math.abs(forward[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0]);
  right = unit(right);
  return { right, up: cross(right, forward), forward };
}

/** mm from the eye along the line of sight. */
export const depthOf = (camera, at) => dot(subtract(at, camera.position), axesOf(camera).forward);

/** The mm that one pixel spans at a depth. */
export const mmPerPixel = (camera, size, depth) =>
  2 * (camera.orthographic ? camera.scale : depth * tanHalf(camera)) / Math.max(size[1], 1);

/** A function from points (mm) to [x, y, depth], or null behind the eye. */
export function projector(camera, size) {
  const { right, up, forward } = axesOf(camera), eye = camera.position;
  const half = camera.orthographic ? camera.scale : tanHalf(camera);
  return (point) => {
    const x = point[0] - eye[0], y = point[1] - eye[1], z = point[2] - eye[2];
    const depth = x * forward[0] + y * forward[1] + z * forward[2];
    if (!camera.orthographic && !(depth > 0)) return null;
    const per = 0.5 * size[1] / (camera.orthographic ? half : depth * half);
    return [0.5 * size[0] + (x * right[0] + y * right[1] + z * right[2]) * per,
      0.5 * size[1] - (x * up[0] + y * up[1] + z * up[2]) * per, depth];
  };
}

/** The point at a pixel, `depth` mm along the line of sight. */
export function unproject(camera, size, pixel, depth) {
  const { right, up, forward } = axesOf(camera), mm = mmPerPixel(camera, size, depth);
  const middle = along(camera.position, forward, depth);
  return along(along(middle, right, (pixel[0] - 0.5 * size[0]) * mm), up, (0.5 * size[1] - pixel[1]) * mm);
}

/** The ray through a pixel: a start and a unit direction. */
export function rayThrough(camera, size, pixel) {
  if (camera.orthographic) return { start: unproject(camera, size, pixel, 0), direction: axesOf(camera).forward };
  return { start: camera.position, direction: unit(subtract(unproject(camera, size, pixel, 1), camera.position)) };
}

/** Near and far distance around a ball, such that depths keep their precision with the eye among vessels. */
export function depthRange(camera, centre, radius) {
  const middle = depthOf(camera, centre);
  let near = middle - 1.01 * radius, far = middle + 1.01 * radius;
  if (!camera.orthographic) {
    far = Math.max(far, 1e-3 * radius);
    near = Math.max(near, Math.min(0.02 * distance(camera.position, camera.focal_point), 1e-3 * far));
  }
  return { near, far };
}

/**
 * The matrix from mm to clip space, by columns, and the rotation to eye space (x right, y up, z towards the eye).
 * `shift`: of the picture, in pixels. `window`: the part of the picture that fills clip space: its middle, and its size.
 */
export function matrices(camera, size, range, shift = [0, 0], window = null) {
  const { right, up, forward } = axesOf(camera), { near, far } = range;
  const half = camera.orthographic ? camera.scale : tanHalf(camera), aspect = size[0] / size[1];
  const wide = window ? window.size : size[0], high = window ? window.size : size[1];
  const sx = size[0] / wide / (half * aspect), sy = size[1] / high / half;
  // The middle of the picture in clip space.
  const ox = window ? (size[0] - 2 * window.x) / wide : 2 * shift[0] / size[0];
  const oy = window ? (2 * window.y - size[1]) / high : 2 * shift[1] / size[1];
  const w = camera.orthographic ? [0, 0, 0, 1] : [...forward, -dot(forward, camera.position)];
  const row = (axis, by, offset) => [0, 1, 2, 3].map((k) =>
    by * (k < 3 ? axis[k] : -dot(axis, camera.position)) + offset * w[k]);
  const depth = camera.orthographic ? [2 / (far - near), -(far + near) / (far - near)]
    : [(far + near) / (far - near), -2 * far * near / (far - near)];
  const deep = row(forward, depth[0], 0);
  deep[3] += depth[1];
  const rows = [row(right, sx, ox), row(up, sy, oy), deep, w];
  const toClip = new Float32Array(16), toEye = new Float32Array(9);
  for (let column = 0; column < 4; ++column)
    for (let line = 0; line < 4; ++line) toClip[4 * column + line] = rows[line][column];
  [right, up, scaled(forward, -1)].forEach((axis, line) => axis.forEach((value, k) => { toEye[3 * k + line] = value; }));
  return { toClip, toEye };
}

// Moves the focal point along the line of sight to the depth of `at`.
function focused(camera, at) {
  const depth = depthOf(camera, at);
  return depth > 0 ? { ...camera, focal_point: along(camera.position, axesOf(camera).forward, depth) } : camera;
}
const shifted = (camera, by) =>
  ({ ...camera, position: add(camera.position, by), focal_point: add(camera.focal_point, by) });

/** Turns about a point; degrees: the viewer goes to the right, then upward. */
export function turned(camera, at, azimuth, elevation) {
  const { right, up } = axesOf(camera);
  const axis = turnedVector(right, up, radians(azimuth));
  const turn = (v) => turnedVector(turnedVector(v, up, radians(azimuth)), axis, radians(-elevation));
  const about = (point) => add(at, turn(subtract(point, at)));
  return focused({ ...camera, position: about(camera.position), focal_point: about(camera.focal_point), view_up: unit(turn(up)) }, at);
}

/** Turns by a drag: 200 degrees per picture width. */
export const rotated = (camera, size, at, from, to) => turned(camera, at,
  -kDegreesPerPicture * (to[0] - from[0]) / size[0], kDegreesPerPicture * (to[1] - from[1]) / size[0]);

/** What was under `from`, at the depth of `at`, comes under `to`. */
export function panned(camera, size, at, from, to) {
  const depth = depthOf(camera, at);
  if (!camera.orthographic && !(depth > 0)) return camera;
  return focused(shifted(camera, subtract(unproject(camera, size, from, depth), unproject(camera, size, to, depth))), at);
}

/** Zooms about a point, which comes no nearer than `least` mm. */
export function zoomedAbout(camera, at, factor, least) {
  const { forward } = axesOf(camera), way = subtract(at, camera.position), depth = dot(way, forward);
  const now = camera.orthographic ? camera.scale / tanHalf(camera) : depth;
  const then = Math.min(factor > 1 ? Math.max(now / factor, Math.min(now, least)) : now / factor, Math.max(now, kFarthest));
  if (!(now > 0) || !(factor > 0) || then === now) return camera;
  const share = 1 - then / now;
  if (!camera.orthographic) return focused(shifted(camera, scaled(way, share)), at);
  return focused(shifted({ ...camera, scale: camera.scale * then / now }, scaled(along(way, forward, -depth), share)), at);
}

/** The zoom of a drag with the right button. */
export const zoomOfDrag = (size, from, to) => 1.1 ** (10 * (from[1] - to[1]) / Math.max(0.5 * size[1], 1));

/** `at` becomes the middle of the picture. */
export const centredOn = (camera, at) => ({ ...shifted(camera, subtract(at, camera.focal_point)), focal_point: at });

/** Direction and up of a named view; the focal point and the distance stay. */
export function looking(camera, name) {
  const view = kViews[name];
  return { ...camera, position: along(camera.focal_point, view.towards, distance(camera.position, camera.focal_point)), view_up: view.up };
}

/** Same direction; the points (x, y, z of each) fill the picture. */
export function fitted(camera, points, size) {
  const { right, up, forward } = axesOf(camera), wide = size[0] / size[1];
  const t = camera.orthographic ? 0 : tanHalf(camera) / kMargin;
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  if (!points.length) return camera;
  const centre = scaled(add(low, high), 0.5), radius = 0.5 * distance(low, high);
  let [r, l, u, d] = [-Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    const v = [points[i] - centre[0], points[i + 1] - centre[1], points[i + 2] - centre[2]];
    const x = dot(v, right), y = dot(v, up), z = t * dot(v, forward);
    r = Math.max(r, x - wide * z);
    l = Math.max(l, -x - wide * z);
    u = Math.max(u, y - z);
    d = Math.max(d, -y - z);
  }
  const half = Math.max(0.5 * (u + d), 0.5 * (r + l) / wide, 0.05 * radius, 1e-6);
  const focal = along(along(centre, right, 0.5 * (r - l)), up, 0.5 * (u - d));
  const away = camera.orthographic ? Math.max(half / (tanHalf(camera) / kMargin), 1.5 * radius) : half / t;
  return { ...camera, scale: kMargin * half, focal_point: focal, position: along(focal, forward, -away), view_up: up };
}

/** Parallel or perspective; what is at the focal point keeps its size. */
export function withProjection(camera, orthographic) {
  if (camera.orthographic === orthographic) return camera;
  const half = camera.orthographic ? camera.scale : distance(camera.position, camera.focal_point) * tanHalf(camera);
  const result = { ...camera, orthographic, scale: half };
  if (!orthographic) result.position = along(camera.focal_point, axesOf(camera).forward, -half / tanHalf(camera));
  return result;
}

/** Between two cameras, for a change of view that the eye can follow; share 0 to 1. */
export function between(from, to, share) {
  if (share >= 1) return to;
  const a = axesOf(from), b = axesOf(to);
  const turn = (p, q) => {
    const angle = Math.acos(Math.min(1, Math.max(-1, dot(p, q))));
    let axis = cross(p, q);
    if (length(axis) < 1e-6) axis = Math.abs(dot(p, a.up)) < 0.9 ? a.up : a.right;
    return turnedVector(p, unit(axis), share * angle);
  };
  const geometric = (p, q) => Math.exp((1 - share) * Math.log(p) + share * Math.log(q));
  const away = geometric(distance(from.position, from.focal_point), distance(to.position, to.focal_point));
  const focal = from.focal_point.map((value, k) => value + share * (to.focal_point[k] - value));
  return { ...to, focal_point: focal, position: along(focal, turn(a.forward, b.forward), -away), view_up: turn(a.up, b.up),
    scale: geometric(from.scale, to.scale), view_angle: from.view_angle + share * (to.view_angle - from.view_angle) };
}
