// Reads the case that `ramus page` puts into the page: JSON in the element #case, compressed buffers as base64 in
// #geometry. The counterpart is app/reports/page/packed_mesh.cpp, which describes how surfaces are packed.

const EXPLICIT = 15; // code of a vertex whose number is written out
const NO_EDGE = 15;
const RECENT = 16; // recent edges, and recent vertices

/**
 * Bytes of a part of base64 text.
 * @param {string} text base64 without blanks
 * @returns {Uint8Array}
 */
function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/**
 * @param {Uint8Array} bytes in zlib format
 * @returns {Promise<Uint8Array>}
 */
async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The place of each list's first entry in a list of all entries. */
function sums(counts) {
  const first = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) first[i + 1] = first[i] + counts[i];
  return first;
}

/** Reads numbers of seven bits a byte; differences to the number before. */
class Differences {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next(last) {
    let value = 0;
    let shift = 0;
    let byte = 0;
    do {
      byte = this.bytes[this.at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return last + ((value >>> 1) ^ -(value & 1));
  }
}

/**
 * Decodes triangles.
 * @param {Uint8Array} gates a byte or two for each triangle
 * @param {Uint8Array} extras numbers of vertices
 * @param {number} count of triangles
 * @param {(function(number, number, number, number): number)} addVertex called for each vertex at its first use, with the edge
 *     before it and the vertex opposite of it (-1: none) and the number of the triangle; returns the vertex' number.
 *     Null: the numbers of new vertices are written among `extras`
 * @returns {Uint32Array} three corners for each triangle
 */
function decodeTriangles(gates, extras, count, addVertex) {
  const indices = new Uint32Array(3 * count);
  const edgeFrom = new Int32Array(RECENT).fill(-1);
  const edgeTo = new Int32Array(RECENT).fill(-1);
  const edgeOpposite = new Int32Array(RECENT).fill(-1);
  const recent = new Int32Array(RECENT).fill(-1);
  const numbers = new Differences(extras);
  let nextEdge = 0;
  let nextRecent = 0;
  let lastExplicit = 0;
  let lastNew = 0;
  let at = 0;

  const remember = (from, to, opposite) => {
    const place = nextEdge++ & (RECENT - 1);
    edgeFrom[place] = from;
    edgeTo[place] = to;
    edgeOpposite[place] = opposite;
  };
  const vertex = (code, from, to, opposite, triangle) => {
    if (code > 0 && code < EXPLICIT) return recent[(nextRecent - code) & (RECENT - 1)];
    let number;
    if (code === EXPLICIT) number = lastExplicit = numbers.next(lastExplicit);
    else if (addVertex) number = addVertex(from, to, opposite, triangle);
    else number = lastNew = numbers.next(lastNew);
    recent[nextRecent++ & (RECENT - 1)] = number;
    return number;
  };

  for (let t = 0; t < count; ++t) {
    const gate = gates[at++];
    let a;
    let b;
    let c;
    if (gate >> 4 === NO_EDGE) {
      const codes = gates[at++];
      a = vertex(gate & 15, -1, -1, -1, t);
      b = vertex(codes >> 4, -1, -1, -1, t);
      c = vertex(codes & 15, -1, -1, -1, t);
      remember(a, b, c);
      remember(b, c, a);
      remember(c, a, b);
    } else {
      const edge = (nextEdge - 1 - (gate >> 4)) & (RECENT - 1);
      a = edgeTo[edge];
      b = edgeFrom[edge];
      c = vertex(gate & 15, b, a, edgeOpposite[edge], t);
      remember(b, c, a);
      remember(c, a, b);
    }
    indices[3 * t] = a;
    indices[3 * t + 1] = b;
    indices[3 * t + 2] = c;
  }
  return indices;
}

/** The places of vertices on the grid, each from its prediction and its correction. */
class GridVertices {
  constructor(count, corrections, shifts, first) {
    this.at = new Int32Array(3 * count);
    this.count = count;
    this.corrections = corrections;
    this.shifts = shifts;
    this.first = first;
    this.group = 0;
    this.made = 0;
  }

  add(from, to, opposite, triangle) {
    while (triangle >= this.first[this.group + 1]) ++this.group;
    const { at, count, corrections, made } = this;
    const shift = this.shifts[this.group];
    const half = (1 << shift) >> 1;
    for (let axis = 0; axis < 3; ++axis) {
      let predicted = 0;
      if (from >= 0) predicted = at[3 * from + axis] + at[3 * to + axis] - at[3 * opposite + axis];
      else if (made > 0) predicted = at[3 * made - 3 + axis];
      const place = axis * count + made;
      const code = corrections[place] | (corrections[place + 3 * count] << 8) | (corrections[place + 6 * count] << 16);
      const correction = (code >>> 1) ^ -(code & 1);
      at[3 * made + axis] = (((predicted + half) >> shift) + correction) << shift;
    }
    return this.made++;
  }
}

/**
 * Unit normals of vertices: of their triangles, weighted by the angles there.
 * @param {Float32Array} positions x, y, z of each vertex
 * @param {Uint32Array} indices
 * @returns {Int8Array} x, y, z, 0 of each vertex, 127 is 1
 */
function normalsOf(positions, indices) {
  const sum = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const a = 3 * indices[i];
    const b = 3 * indices[i + 1];
    const c = 3 * indices[i + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const area = Math.sqrt(nx * nx + ny * ny + nz * nz);
    if (!(area > 0)) continue;
    const uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz, uv = ux * vx + uy * vy + uz * vz;
    const atA = Math.atan2(area, uv) / area;
    const atB = Math.atan2(area, uu - uv) / area;
    const atC = Math.atan2(area, vv - uv) / area;
    sum[a] += nx * atA, sum[a + 1] += ny * atA, sum[a + 2] += nz * atA;
    sum[b] += nx * atB, sum[b + 1] += ny * atB, sum[b + 2] += nz * atB;
    sum[c] += nx * atC, sum[c + 1] += ny * atC, sum[c + 2] += nz * atC;
  }
  const normals = new Int8Array((positions.length / 3) * 4);
  for (let v = 0, n = 0; v < sum.length; v += 3, n += 4) {
    const scale = 127 / (Math.sqrt(sum[v] * sum[v] + sum[v + 1] * sum[v + 1] + sum[v + 2] * sum[v + 2]) || 1);
    normals[n] = Math.round(sum[v] * scale);
    normals[n + 1] = Math.round(sum[v + 1] * scale);
    normals[n + 2] = Math.round(sum[v + 2] * scale);
  }
  return normals;
}

/**
 * Gives each group of triangles vertices of its own: those on the border of two groups are repeated.
 * @param {{positions: Float32Array, normals: Int8Array, indices: Uint32Array, first: Uint32Array}} mesh of shared
 *     vertices; `first`: triangle at which each group begins
 * @param {?{indices: Uint32Array, first: Uint32Array}} coarse of the same vertices
 * @returns {{positions: Float32Array, normals: Int8Array, groups: Uint32Array, indices: Uint32Array, coarse: ?Uint32Array}}
 *     `groups`: the group of each vertex
 */
function separated(mesh, coarse) {
  const count = mesh.positions.length / 3;
  const owner = new Uint32Array(count).fill(0xffffffff);
  const sources = []; // of the repeated vertices
  const owners = [];
  const repeated = new Map(); // group * count + vertex
  const take = (indices, first) => {
    for (let group = 0; group + 1 < first.length; ++group) {
      for (let i = 3 * first[group]; i < 3 * first[group + 1]; ++i) {
        const vertex = indices[i];
        if (owner[vertex] === 0xffffffff) owner[vertex] = group;
        if (owner[vertex] === group) continue;
        const key = group * count + vertex;
        let number = repeated.get(key);
        if (number === undefined) {
          number = count + sources.length;
          repeated.set(key, number);
          sources.push(vertex);
          owners.push(group);
        }
        indices[i] = number;
      }
    }
  };
  take(mesh.indices, mesh.first);
  if (coarse) take(coarse.indices, coarse.first);
  const total = count + sources.length;
  const positions = new Float32Array(3 * total);
  const normals = new Int8Array(4 * total);
  const groups = new Uint32Array(total);
  positions.set(mesh.positions);
  normals.set(mesh.normals);
  groups.set(owner);
  for (let i = 0; i < sources.length; ++i) {
    const from = sources[i];
    const to = count + i;
    positions.set(mesh.positions.subarray(3 * from, 3 * from + 3), 3 * to);
    normals.set(mesh.normals.subarray(4 * from, 4 * from + 4), 4 * to);
    groups[to] = owners[i];
  }
  return { positions, normals, groups, indices: mesh.indices, coarse: coarse && coarse.indices };
}

/**
 * @param {object} packed as in the JSON: origin, step, vertices, triangles, numbers of buffers
 * @param {function(number): Promise<Uint8Array>} buffer
 * @returns {Promise<{positions: Float32Array, normals: Int8Array, indices: Uint32Array, first: Uint32Array,
 *     coarse: ?{indices: Uint32Array, first: Uint32Array}}>} `first` in triangles
 */
async function decodeMesh(packed, buffer) {
  const names = ["counts", "shifts", "gates", "extras", "corrections"];
  const [counts, shifts, gates, extras, corrections] = await Promise.all(names.map((name) => buffer(packed[name])));
  const first = sums(new Uint32Array(counts.buffer));
  const grid = new GridVertices(packed.vertices, corrections, shifts, first);
  const indices = decodeTriangles(gates, extras, packed.triangles, (from, to, opposite, t) =>
    grid.add(from, to, opposite, t));
  const positions = new Float32Array(grid.at.length);
  for (let i = 0; i < positions.length; ++i) positions[i] = packed.origin[i % 3] + packed.step * grid.at[i];
  let coarse = null;
  if (packed.coarse) {
    const [fewer, coarseGates, coarseExtras] = await Promise.all(
      ["counts", "gates", "extras"].map((name) => buffer(packed.coarse[name])));
    coarse = {
      indices: decodeTriangles(coarseGates, coarseExtras, packed.coarse.triangles, null),
      first: sums(new Uint32Array(fewer.buffer)),
    };
  }
  return { positions, normals: normalsOf(positions, indices), indices, first, coarse };
}

/** The surface of the tree: branches by rank. Ranks follow `json.order`, in which dependents follow their branch. */
async function decodeSurface(json, buffer) {
  const count = json.order.length;
  const rank = new Uint32Array(count);
  json.order.forEach((id, place) => {
    rank[id] = place;
  });
  const subtreeEnd = new Uint32Array(json.dependents.map((dependents, place) => place + 1 + dependents));
  const mesh = await decodeMesh(json.surface, buffer);
  const made = separated(mesh, mesh.coarse);
  const branches = count > 65536 ? made.groups : new Uint16Array(made.groups.length);
  for (let v = 0; v < branches.length; ++v) branches[v] = json.order[made.groups[v]];
  const inIndices = (first) => first.map((triangle) => 3 * triangle);
  return {
    positions: made.positions,
    normals: made.normals,
    branches,
    indices: made.indices,
    first: inIndices(mesh.first),
    rank,
    subtreeEnd,
    coarse: made.coarse && { indices: made.coarse, first: inIndices(mesh.coarse.first) },
  };
}

/**
 * Decodes the whole case.
 * @param {Document|DocumentFragment} root has the elements #case and #geometry
 * @returns {Promise<object>} json: as `ramus page` wrote it (lengths in mm, places in mm, RAS);
 *     surface: null, or positions (3 a vertex), normals (4 a vertex, 127 is 1), branches (id of each vertex), indices
 *     (in the order of ranks), first (by rank: index at which the branch begins, and the end), rank (by id),
 *     subtreeEnd (by rank: the rank behind its last dependent), coarse (null, or indices and first with fewer triangles);
 *     meshes: positions, normals, indices of other surfaces;
 *     centerlines: points (x, y, z, radius), first (by branch: its first point, and the end), from the parent's end
 */
export async function decodeCase(root = document) {
  const json = JSON.parse(root.querySelector("#case").textContent);
  const text = root.querySelector("#geometry").textContent.trim();
  const buffer = (number) => {
    const [start, bytes] = json.buffers[number]; // starts are multiples of three bytes: whole groups of base64
    return inflated(bytesOf(text.slice((start / 3) * 4, Math.ceil((start + bytes) / 3) * 4)).subarray(0, bytes));
  };
  const surface = json.surface ? await decodeSurface(json, buffer) : null;
  const meshes = [];
  for (const packed of json.meshes || []) {
    const { positions, normals, indices } = await decodeMesh(packed, buffer);
    meshes.push({ positions, normals, indices });
  }
  let centerlines = null;
  if (json.centerlines) {
    const [points, counts] = await Promise.all([buffer(json.centerlines.points), buffer(json.centerlines.counts)]);
    centerlines = { points: new Float32Array(points.buffer), first: sums(new Uint32Array(counts.buffer)) };
  }
  return { json, surface, meshes, centerlines };
}
