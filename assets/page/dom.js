// Elements made with text alone, never from HTML: names come from files.

/** An element; attributes that begin with "on" are listeners, null and false are left out. */
export function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false && value !== undefined) element.setAttribute(name, value === true ? "" : value);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}
export const by = (id) => document.getElementById(id);
export const button = (text, onclick, attributes = {}) => made("button", { type: "button", onclick, ...attributes }, text);

/** A name from a file: isolated, so that its direction of writing stays its own. */
export const named = (text) => made("bdi", {}, text);

/** A table with a header row; `rows` of texts. Numbers are right-aligned. */
export function table(columns, rows, caption = null) {
  const numeric = columns.map((_, i) => rows.length > 0 && rows.every((row) => /^[-−+]?[\d.,  ]*\d[\d.,]*( ?(mm|cm|m|ml|%|°|mm²|mm³|units))?$|^$|^[-–—]$/.test(String(row[i] ?? ""))));
  const cell = (tag, text, i, more = {}) => made(tag, { class: numeric[i] ? "number" : null, ...more }, named(String(text ?? "")));
  return made("table", {}, caption ? made("caption", {}, named(caption)) : null,
    made("thead", {}, made("tr", {}, ...columns.map((text, i) => cell("th", text, i, { scope: "col" })))),
    made("tbody", {}, ...rows.map((row) => made("tr", {}, ...columns.map((_, i) => i ? cell("td", row[i], i) : cell("th", row[i], i, { scope: "row" }))))));
}

/** A list of terms and texts. */
export const facts = (pairs) => made("dl", { class: "facts" }, ...pairs.flatMap(([term, text]) =>
  [made("dt", {}, named(term)), made("dd", {}, text instanceof Node ? text : named(text))]));

/** Radio buttons that look like a row of buttons. */
export function choice(name, label, options, chosen, onchoose) {
  return made("fieldset", { class: "choice" }, made("legend", {}, label), ...options.map(([value, text]) => {
    const input = made("input", { type: "radio", name, value, onchange: () => onchoose(value) });
    input.checked = value === chosen;
    return made("label", {}, input, made("span", {}, named(text)));
  }));
}
