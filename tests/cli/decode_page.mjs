// Decodes a page as a browser does: node decode_page.mjs PAGE.html FOLDER. Writes FOLDER/NAME.bin for each array, 32-bit
// numbers, low byte first.
import fs from "node:fs";
import path from "node:path";
import { decodeCase } from "../../assets/page/decode.js";

const [page, folder] = process.argv.slice(2);
const html = fs.readFileSync(page, "utf8");
const root = {
  querySelector(selector) {
    const begin = html.indexOf(">", html.indexOf(`id="${selector.slice(1)}"`)) + 1;
    return { textContent: html.slice(begin, html.indexOf("</script>", begin)) };
  },
};
const { json, surface, meshes, centerlines } = await decodeCase(root);
const write = (name, numbers) => fs.writeFileSync(path.join(folder, `${name}.bin`), numbers);
fs.writeFileSync(path.join(folder, "case.json"), JSON.stringify(json));
write("positions", surface.positions);
write("normals", Int32Array.from(surface.normals));
write("branches", Int32Array.from(surface.branches));
for (const name of ["indices", "first", "rank", "subtreeEnd"]) write(name, surface[name]);
if (surface.coarse) write("coarse", surface.coarse.indices);
if (surface.coarse) write("coarse_first", surface.coarse.first);
write("line_points", centerlines.points);
write("line_first", centerlines.first);
meshes.forEach((mesh, number) => {
  write(`mesh${number}_positions`, mesh.positions);
  write(`mesh${number}_indices`, mesh.indices);
});
