// Views with names: the six anatomical ones, and those that the case has saved.

import { kViews } from "./camera.js";
import { plain } from "./text.js";

export const kSavedKeys = 9; // saved views that have a key: 1 to 9

/** Saved views of a case, in their order: `name` as it was typed, `shown` as text on the page, `camera` as in the file. */
export const savedViews = (json) => (json.views || []).map(({ name, camera }, i) => ({ name, camera, shown: plain(name) || `View ${i + 1}` }));

/** What a name means: { anatomical } or { saved }, the index of a saved view; null where nothing has the name. */
export function viewNamed(json, name) {
  if (Object.keys(kViews).includes(name)) return { anatomical: name };
  const views = savedViews(json), typed = views.findIndex((view) => view.name === name);
  const saved = typed < 0 ? views.findIndex((view) => view.shown === name) : typed;
  return saved < 0 ? null : { saved };
}
