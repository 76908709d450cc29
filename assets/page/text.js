// Numbers and names as ramus writes them. Names come from files: they are only ever set as text, and marks that turn the
// direction of writing are removed so that a name cannot change its surroundings.

/** Three significant digits; thousands are grouped. */
export function digits(value, significant = 3) {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return "?";
  if (Math.abs(value) >= 999.5) return Math.round(value).toLocaleString("en-US");
  const magnitude = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
  return value.toFixed(Math.min(9, Math.max(0, significant - 1 - magnitude)));
}

/** A length with its unit: "12.3 mm", or another word where nobody knows the unit. */
export function lengthText(mm, claims) {
  if (claims.unit !== "mm") return `${digits(mm)} ${claims.unit}`;
  return mm < 999.5 ? `${digits(mm)} mm` : `${digits(mm / 1000)} m`;
}

export const counted = (number, one, many = `${one}s`) => `${number.toLocaleString("en-US")} ${number === 1 ? one : many}`;

/** A name from a file, harmless as text. */
export const plain = (name) => String(name ?? "").replace(/[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff]/g, "");

/** "1e3" and "10.50" as people write them: the label of a scale bar. */
export function barLabel(mm, claims) {
  const text = (value) => String(Number(value.toPrecision(6)));
  if (claims.unit !== "mm") return `${text(mm)} ${claims.unit}`;
  if (mm < 0.99e-3) return `${text(1e6 * mm)} nm`;
  if (mm < 0.99) return `${text(1e3 * mm)} µm`;
  return mm > 150 ? `${text(0.1 * mm)} cm` : `${text(mm)} mm`;
}

/** A whole number with its thousands grouped. */
export const whole = (number) => Math.round(number).toLocaleString("en-US");
