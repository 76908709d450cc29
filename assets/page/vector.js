// Vectors of three numbers, as arrays. No function changes its arguments.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, by) => [a[0] * by, a[1] * by, a[2] * by];
export const along = (a, direction, by) => [a[0] + direction[0] * by, a[1] + direction[1] * by, a[2] + direction[2] * by];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const distance = (a, b) => length(subtract(a, b));
export const mixed = (a, b, share) => [0, 1, 2].map((k) => a[k] + (b[k] - a[k]) * share);

export function unit(a) {
  const long = length(a);
  return long > 0 ? scaled(a, 1 / long) : [0, 0, 0];
}

/** `v` turned about the unit vector `axis` by `angle` radians. */
export function turned(v, axis, angle) {
  const c = Math.cos(angle);
  return add(add(scaled(v, c), scaled(cross(axis, v), Math.sin(angle))), scaled(axis, dot(axis, v) * (1 - c)));
}

/** The nearest point of the line from `a` to `b`: its share of the way, and its distance from `p`. */
export function nearestOnLine(p, a, b) {
  const way = subtract(b, a);
  const share = Math.min(1, Math.max(0, dot(subtract(p, a), way) / Math.max(dot(way, way), 1e-12)));
  return { share, distance: distance(p, along(a, way, share)) };
}
