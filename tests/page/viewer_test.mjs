// What the viewer of `ramus page` computes, without a browser: node --test viewer_test.mjs.
import assert from "node:assert/strict";
import test from "node:test";
import * as cameras from "../../assets/page/camera.js";
import { found } from "../../assets/page/branches.js";
import { roundLength, scaleBar, insidePolygon } from "../../assets/page/overlay.js";
import { ball } from "../../assets/page/shapes.js";
import { barLabel, digits, lengthText, plain } from "../../assets/page/text.js";
import { Tree } from "../../assets/page/tree.js";
import { diameters, insideLost, lesionDistances } from "../../assets/page/values.js";
import { distance, dot, length } from "../../assets/page/vector.js";
import { savedViews, viewNamed } from "../../assets/page/views.js";

const size = [800, 600];
const tilted = cameras.cameraFrom({ position: [40, 200, 60], focal_point: [3, -2, 5], view_up: [0.1, 0, 1] });
const flat = { ...tilted, orthographic: true, scale: 70 };
const near = (a, b, within = 1e-9) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);
const same = (a, b, within = 1e-6) => a.forEach((value, k) => near(value, b[k], within));

for (const [name, camera] of [["perspective", tilted], ["parallel", flat]]) {
  test(`${name}: pixels and points are inverse`, () => {
    const point = [12, 20, -7], [x, y, depth] = cameras.projector(camera, size)(point);
    same(cameras.unproject(camera, size, [x, y], depth), point);
    const { start, direction } = cameras.rayThrough(camera, size, [x, y]);
    const way = point.map((value, k) => value - start[k]);
    near(length(way.map((value, k) => value - dot(way, direction) * direction[k])), 0, 1e-6);
  });

  test(`${name}: the matrix puts a point where the projector does`, () => {
    const point = [12, 20, -7], [x, y, depth] = cameras.projector(camera, size)(point), range = { near: 50, far: 400 };
    const { toClip } = cameras.matrices(camera, size, range);
    const clip = [0, 1, 2, 3].map((row) => [...point, 1].reduce((sum, value, k) => sum + toClip[4 * k + row] * value, 0));
    near((clip[0] / clip[3] + 1) * 400, x, 1e-3);
    near((1 - clip[1] / clip[3]) * 300, y, 1e-3);
    const value = 0.5 * clip[2] / clip[3] + 0.5; // of the depth buffer
    near(camera.orthographic ? 50 + value * 350 : 400 * 50 / (400 - value * 350), depth, 1e-2);
    const picked = cameras.matrices(camera, size, range, [0, 0], { x, y, size: 13 }).toClip;
    for (const row of [0, 1]) near([...point, 1].reduce((sum, number, k) => sum + picked[4 * k + row] * number, 0), 0, 1e-3);
  });

  test(`${name}: moves keep what was pointed at`, () => {
    const at = [12, 20, -7], pixel = (moved) => cameras.projector(moved, size)(at).slice(0, 2), here = pixel(camera);
    same(pixel(cameras.zoomedAbout(camera, at, 1.7, 0.1)), here, 1e-6);
    same(pixel(cameras.panned(camera, size, at, here, [here[0] + 30, here[1] - 9])), [here[0] + 30, here[1] - 9]);
    const turned = cameras.rotated(camera, size, at, [0, 0], [size[0], 0]);
    same(pixel(turned), here);
    // 200 degrees per width of the picture.
    near(dot(cameras.axesOf(turned).forward, cameras.axesOf(camera).forward), Math.cos(200 * Math.PI / 180), 1e-9);
    near(distance(turned.position, at), distance(camera.position, at));
  });

  test(`${name}: fitting fills the picture with the margin`, () => {
    const points = Array.from({ length: 90 }, (_, i) => 40 * Math.sin(i * i));
    const fitted = cameras.fitted(camera, points, size), at = cameras.projector(fitted, size);
    let reach = 0;
    for (let i = 0; i < points.length; i += 3) {
      const [x, y] = at(points.slice(i, i + 3));
      reach = Math.max(reach, Math.abs(x - 400) / 400, Math.abs(y - 300) / 300);
    }
    near(reach, 1 / 1.06, 1e-9);
  });
}

test("a change of projection keeps the size at the focal point", () => {
  const other = cameras.withProjection(tilted, true), point = cameras.unproject(tilted, size, [500, 200], distance(tilted.position, tilted.focal_point));
  same(cameras.projector(other, size)(point).slice(0, 2), [500, 200]);
  same(cameras.withProjection(other, false).position, tilted.position);
});

test("half way between two cameras is half of the turn", () => {
  const to = cameras.looking(tilted, "left"), half = cameras.between(tilted, to, 0.5);
  const angle = (a, b) => Math.acos(dot(cameras.axesOf(a).forward, cameras.axesOf(b).forward));
  near(angle(tilted, half), angle(half, to), 1e-9);
  assert.deepEqual(cameras.between(tilted, to, 1), to);
});

// A stem that forks; a ring behind it would have fewer dependents: `dependents` come from the exporter.
const json = {
  branches: [
    { parent: null, children: [1, 2], from: 0, to: 1, length_mm: 10 }, { parent: 0, children: [], from: 1, to: 2, length_mm: 6 },
    { parent: 0, children: [3], from: 1, to: 3, length_mm: 5 }, { parent: 2, children: [], from: 3, to: 2, length_mm: 1 },
    { parent: null, children: [], from: 9, to: 10, length_mm: 4 },
  ],
  order: [0, 1, 2, 3, 4], dependents: [3, 0, 0, 0, 0],
};
const lines = {
  points: new Float32Array([0, 0, 0, 2, 0, 0, 10, 1, 0, 0, 10, 1, 0, 0, 16, 1, 0, 0, 10, 1, 5, 0, 10, 1, 5, 0, 10, 1, 0, 0, 16, 1, 90, 0, 0, 1, 90, 0, 4, 1]),
  first: new Uint32Array([0, 2, 4, 6, 8, 10]),
};
const tree = new Tree(json, lines);

test("dependents, upstream and paths", () => {
  assert.deepEqual(tree.subtree([0]), [0, 1, 2, 3]);
  assert.deepEqual(tree.subtree([2, 4]), [2, 4]);
  assert.deepEqual(tree.upstream([3]), [0, 2, 3]);
  // Around the ring: half of 0, branch 1, half of 3 is longer than by branch 2.
  const path = tree.path({ branch: 0, fraction: 0.5 }, { branch: 3, fraction: 0.5 });
  assert.deepEqual(path.branches, [0, 2, 3]);
  near(path.length_mm, 5 + 5 + 0.5);
  assert.equal(tree.path({ branch: 0, fraction: 0.5 }, { branch: 4, fraction: 0.5 }), null);
  near(tree.path({ branch: 1, fraction: 0.25 }, { branch: 1, fraction: 0.75 }).length_mm, 3);
  same(tree.place(0, 0.25).at, [0, 0, 2.5]);
  near(tree.place(0, 0.25).radius, 1.75);
  near(tree.nearestFraction(0, [3, 0, 7]), 0.7);
  for (const point of tree.ring(0, 0.25, 1)) near(distance(point, [0, 0, 2.5]), 1.75, 1e-6);
});

test("values of vertices", () => {
  const surface = { positions: new Float32Array([2, 0, 0, 1.5, 0, 5, 3, 0, 9]), branches: new Uint16Array([0, 0, 0]) };
  same([...diameters(surface, lines)], [4, 3, 2.2]);
  same([...insideLost(surface, lines, [[0, 0.5, 1]])], [-5, 0, 4], 1e-5);
  same([...insideLost(surface, lines, [[1, 0.5, 1]])], [-1e4, -1e4, -1e4]);
  const round = { centre: [0, 0, 5], radius: 3 };
  const exact = lesionDistances(surface, [{ ...round, mesh: null }], 20), meshed = lesionDistances(surface, [{ ...round, mesh: ball(round.centre, 3, 48) }], 20);
  same([...exact], [Math.sqrt(29) - 3, -1.5, 2]);
  same([...meshed], [...exact], 0.02);
});

test("words", () => {
  assert.equal(digits(0.87123), "0.871");
  assert.equal(digits(12), "12.0");
  assert.equal(digits(1234.5), "1,235");
  assert.equal(lengthText(10908, { unit: "mm" }), "10.9 m");
  assert.equal(lengthText(10908, { unit: "units" }), "10,908 units");
  assert.equal(plain("a\u202eb\u0000<i>"), "ab<i>");
  assert.equal(barLabel(0.5, { unit: "mm" }), "500 µm");
  assert.equal(barLabel(200, { unit: "mm" }), "20 cm");
});

test("views are found by name, anatomical ones first", () => {
  const camera = { position: [0, 1, 0] }, hostile = "<b>\u202ea";
  const json = { views: [{ name: "behind the vein", camera }, { name: hostile, camera }, { name: "\u202e", camera }, { name: "__proto__", camera }] };
  assert.deepEqual(savedViews(json).map(({ shown }) => shown), ["behind the vein", "<b>a", "View 3", "__proto__"]);
  assert.deepEqual(savedViews({}), []);
  assert.deepEqual(viewNamed(json, "anterior"), { anatomical: "anterior" });
  assert.deepEqual(viewNamed(json, "behind the vein"), { saved: 0 });
  assert.deepEqual(viewNamed(json, hostile), { saved: 1 });
  assert.deepEqual(viewNamed(json, "<b>a"), { saved: 1 });
  assert.deepEqual(viewNamed(json, "View 3"), { saved: 2 });
  assert.deepEqual(viewNamed(json, "__proto__"), { saved: 3 });
  for (const none of ["constructor", "", "Anterior", undefined]) assert.equal(viewNamed(json, none), null);
});

test("the scale bar is honest", () => {
  near(roundLength(49.9), 20);
  near(roundLength(50), 50);
  const deep = { middle: tilted.focal_point, halfDepth: 100 }, shallow = { middle: tilted.focal_point, halfDepth: 21 };
  assert.equal(scaleBar(tilted, size, deep, 120), null);
  assert.match(scaleBar(tilted, size, shallow, 120).place, /^at the middle, ±\d+ %$/);
  assert.equal(scaleBar(flat, size, null, 120).place, "");
  near(scaleBar(flat, size, null, 120).pixels, 20 * 600 / 140);
});

test("searching", () => {
  const model = {
    tree: { dependents: [3, 0] }, json: { systems: [{ name: "Portal vein" }] }, state: { states: [0, 3] }, everything: [0, 1],
    branches: [{ name: "Stem", system: 0, diameter_mm: { mean: 8 }, length_mm: 20, generation: 0, strahler: 2 }, { diameter_mm: { mean: 2 }, length_mm: 9, generation: 1, strahler: 1 }],
  };
  assert.deepEqual(found(model, "d>3"), [0]);
  assert.deepEqual(found(model, "gen<=1 len<10"), [1]);
  assert.deepEqual(found(model, "portal"), [0]);
  assert.deepEqual(found(model, "hidden"), [1]);
  assert.deepEqual(found(model, ""), [0, 1]);
  assert.ok(insidePolygon([1, 1], [[0, 0], [3, 0], [0, 3]]) && !insidePolygon([2, 2], [[0, 0], [3, 0], [0, 3]]));
});
