// The meshes of the scene next to the vessels: lesions (balls or meshes), context, territories, resections.

const kLesionOpacity = 0.6, kTerritoryOpacity = 0.4, kResectionOpacity = 0.6;

/** A closed ball. */
export function ball([x, y, z], radius, rings = 24) {
  const positions = [], normals = [], indices = [], round = 2 * rings;
  for (let i = 0; i <= rings; ++i)
    for (let j = 0; j <= round; ++j) {
      const up = Math.PI * i / rings, turn = 2 * Math.PI * j / round;
      const n = [Math.sin(up) * Math.cos(turn), Math.sin(up) * Math.sin(turn), Math.cos(up)];
      positions.push(x + radius * n[0], y + radius * n[1], z + radius * n[2]);
      normals.push(...n.map((value) => Math.round(127 * value)), 0);
      if (i === rings || j === round) continue;
      const a = i * (round + 1) + j, b = a + round + 1;
      indices.push(a, b, a + 1, a + 1, b, b + 1);
    }
  return { positions: new Float32Array(positions), normals: new Int8Array(normals), indices: new Uint32Array(indices) };
}

/** All shapes: { group, name, colour, opacity, mesh, picked, plan, figures }. */
export function shapesOf(kase) {
  const { json, meshes } = kase, shapes = [];
  const put = (group, one, opacity, mesh, more = {}) => {
    if (mesh) shapes.push({ group, name: one.name || group, colour: one.colour || "#9aa3b0", opacity: one.opacity ?? opacity, visible: one.visible !== false, mesh, ...more });
  };
  (json.lesions || []).forEach((one, i) => put("Lesions", { ...one, name: one.name || `Lesion ${i + 1}` }, kLesionOpacity,
    one.mesh === undefined ? ball(one.centre, one.radius) : meshes[one.mesh], { picked: true, lesion: i }));
  for (const one of json.context || []) put("Context", one, 0.25, meshes[one.mesh]);
  for (const one of json.territories || []) put("Territories", one, kTerritoryOpacity, meshes[one.mesh]);
  (json.plans || []).forEach((plan, i) => {
    for (const one of plan.resections || []) put("Resections", one, kResectionOpacity, meshes[one.mesh], { plan: i });
  });
  return shapes;
}
