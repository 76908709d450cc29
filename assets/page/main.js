import { decodeCase } from "./decode.js";

const state = document.getElementById("state");
decodeCase().then(({ json, surface, meshes }) => {
  const triangles = surface ? surface.indices.length / 3 : 0;
  state.textContent = `${json.branches.length} branches, ${triangles} triangles, ${meshes.length} other surfaces`;
}, (error) => {
  state.textContent = `The case cannot be read: ${error.message}`;
});
