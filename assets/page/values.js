// Numbers per vertex that colours follow: the diameter along a vessel, the distance from lesions, mm beyond a cut.

/** The share of a branch's length at each of its vertices, and the radius there; for the branches in `wanted`. */
function alongLines(surface, lines, wanted, put) {
  const { positions, branches } = surface, { points, first } = lines;
  const far = new Float32Array(points.length / 4); // mm from the branch's start
  for (let b = 0; b + 1 < first.length; ++b)
    for (let i = first[b] + 1; i < first[b + 1]; ++i)
      far[i] = far[i - 1] + Math.hypot(points[4 * i] - points[4 * i - 4], points[4 * i + 1] - points[4 * i - 3], points[4 * i + 2] - points[4 * i - 2]);
  for (let v = 0; v < branches.length; ++v) {
    const b = branches[v];
    if (!wanted(b) || first[b + 1] - first[b] < 2) continue;
    const x = positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2];
    let least = Infinity, at = first[b], share = 0;
    for (let i = first[b]; i + 1 < first[b + 1]; ++i) {
      const k = 4 * i, dx = points[k + 4] - points[k], dy = points[k + 5] - points[k + 1], dz = points[k + 6] - points[k + 2];
      const px = x - points[k], py = y - points[k + 1], pz = z - points[k + 2];
      const t = Math.min(1, Math.max(0, (px * dx + py * dy + pz * dz) / Math.max(dx * dx + dy * dy + dz * dz, 1e-12)));
      const ex = px - t * dx, ey = py - t * dy, ez = pz - t * dz, squared = ex * ex + ey * ey + ez * ez;
      if (squared < least) [least, at, share] = [squared, i, t];
    }
    const mix = (list, stride, offset) => list[stride * at + offset] + share * (list[stride * at + stride + offset] - list[stride * at + offset]);
    put(v, b, mix(far, 1, 0), mix(points, 4, 3), far[first[b + 1] - 1]);
  }
}

/** The diameter at each vertex, mm. */
export function diameters(surface, lines) {
  const values = new Float32Array(surface.branches.length);
  alongLines(surface, lines, () => true, (v, b, mm, radius) => { values[v] = 2 * radius; });
  return values;
}

/** mm inside the lost part of the vertex' branch; negative outside it. `parts`: [branch, from, to], fractions of its length. */
export function insideLost(surface, lines, parts) {
  const values = new Float32Array(surface.branches.length).fill(-1e4), of = new Map(parts.map(([branch, from, to]) => [branch, { from, to }]));
  alongLines(surface, lines, (b) => of.has(b), (v, b, mm, radius, whole) => {
    const { from, to } = of.get(b);
    values[v] = Math.min(from > 0 ? mm - from * whole : 1e4, to < 1 ? to * whole - mm : 1e4);
  });
  return values;
}

/**
 * The distance of each vertex from the nearest lesion, mm, negative inside; 1e4 beyond `most`. `lesions`: { centre,
 * radius, mesh }, where a mesh { positions, normals, indices } replaces the ball.
 */
export function lesionDistances(surface, lesions, most) {
  const { positions } = surface, count = positions.length / 3, values = new Float32Array(count).fill(1e4);
  for (const lesion of lesions) {
    if (!lesion.mesh) {
      const [cx, cy, cz] = lesion.centre;
      for (let v = 0; v < count; ++v)
        values[v] = Math.min(values[v], Math.hypot(positions[3 * v] - cx, positions[3 * v + 1] - cy, positions[3 * v + 2] - cz) - lesion.radius);
      continue;
    }
    const near = meshDistance(lesion.mesh, most);
    for (let v = 0; v < count; ++v) values[v] = Math.min(values[v], near(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
  }
  return values;
}

// The distance from a closed mesh up to `most` mm, by the nearest of its triangles in a grid of cells.
function meshDistance({ positions, normals, indices }, most) {
  const cell = Math.max(most / 2, 1e-6), cells = new Map(), low = [1e30, 1e30, 1e30], high = [-1e30, -1e30, -1e30];
  const key = (x, y, z) => `${x},${y},${z}`, floor = (value) => Math.floor(value / cell);
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  for (let t = 0; t < indices.length; t += 3) {
    const corner = (k) => [0, 1, 2].map((j) => positions[3 * indices[t + j] + k]);
    const [x0, y0, z0] = [0, 1, 2].map((k) => floor(Math.min(...corner(k)))), [x1, y1, z1] = [0, 1, 2].map((k) => floor(Math.max(...corner(k))));
    for (let x = x0; x <= x1; ++x) for (let y = y0; y <= y1; ++y) for (let z = z0; z <= z1; ++z) {
      const at = key(x, y, z);
      cells.has(at) ? cells.get(at).push(t) : cells.set(at, [t]);
    }
  }
  return (x, y, z) => {
    const p = [x, y, z];
    const inBox = p.every((value, k) => value > low[k] && value < high[k]);
    if (p.some((value, k) => value < low[k] - most || value > high[k] + most)) return 1e4;
    let best = Infinity, sign = 1;
    const [cx, cy, cz] = p.map(floor), reach = inBox ? Math.ceil(Math.max(...low.map((value, k) => high[k] - value)) / cell) : 2;
    for (let ring = 0; ring <= reach && best > (ring - 1) * cell; ++ring)
      for (let i = -ring; i <= ring; ++i) for (let j = -ring; j <= ring; ++j) for (let k = -ring; k <= ring; ++k) {
        if (Math.max(Math.abs(i), Math.abs(j), Math.abs(k)) !== ring) continue;
        for (const t of cells.get(key(cx + i, cy + j, cz + k)) || []) {
          const found = triangleDistance(p, positions, indices, t);
          if (found.distance >= best) continue;
          best = found.distance;
          const n = indices[t], side = [0, 1, 2].reduce((sum, q) => sum + (p[q] - found.point[q]) * normals[4 * n + q], 0);
          sign = side < 0 ? -1 : 1;
        }
      }
    return best === Infinity ? 1e4 : sign * best;
  };
}

// The nearest point of a triangle (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
function triangleDistance(p, positions, indices, t) {
  const at = (i) => [positions[3 * indices[t + i]], positions[3 * indices[t + i] + 1], positions[3 * indices[t + i] + 2]];
  const a = at(0), b = at(1), c = at(2);
  const minus = (u, v) => [u[0] - v[0], u[1] - v[1], u[2] - v[2]], times = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const ab = minus(b, a), ac = minus(c, a), ap = minus(p, a), bp = minus(p, b), cp = minus(p, c);
  const d1 = times(ab, ap), d2 = times(ac, ap), d3 = times(ab, bp), d4 = times(ac, bp), d5 = times(ab, cp), d6 = times(ac, cp);
  const clamp = (value) => Math.min(1, Math.max(0, value || 0));
  const va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  let v, w; // barycentric
  if (d1 <= 0 && d2 <= 0) [v, w] = [0, 0];
  else if (d3 >= 0 && d4 <= d3) [v, w] = [1, 0];
  else if (d6 >= 0 && d5 <= d6) [v, w] = [0, 1];
  else if (vc <= 0 && d1 >= 0 && d3 <= 0) [v, w] = [clamp(d1 / (d1 - d3)), 0];
  else if (vb <= 0 && d2 >= 0 && d6 <= 0) [v, w] = [0, clamp(d2 / (d2 - d6))];
  else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    w = clamp((d4 - d3) / (d4 - d3 + d5 - d6));
    v = 1 - w;
  } else [v, w] = [vb / (va + vb + vc), vc / (va + vb + vc)];
  const point = [0, 1, 2].map((k) => a[k] + v * ab[k] + w * ac[k]);
  return { point, distance: Math.hypot(...minus(p, point)) };
}
