// Numbers as the tables of the page have them.

/**
 * A column: symbol and name, unit, decimals, and its values as whole numbers, each as what it adds to the one before.
 * @typedef {{s: string, n: string, u: string, d: number, v: string}} Packed
 */

/** @typedef {{symbol: string, name: string, unit: string, decimals: number, values: number[]}} Column */

/**
 * Return a column with its values; one that is not known is not a number.
 * @param {Packed} packed
 * @returns {Column}
 */
export function unpacked(packed) {
  const scale = 10 ** packed.d;
  let sum = 0;
  const values = packed.v.split(" ").map((step) => (step === "x" ? NaN : (sum += Number(step)) / scale));
  return { symbol: packed.s, name: packed.n, unit: packed.u, decimals: packed.d, values };
}

/**
 * Return the columns that are stored, with that which the tables go by.
 * @param {{axis: string, rows: Packed, columns: Record<string, Packed>}} data
 * @returns {Record<string, Column>}
 */
export function columnsOf({ axis, rows, columns }) {
  return Object.fromEntries([...Object.entries(columns), [axis, rows]].map(([key, one]) => [key, unpacked(/** @type {Packed} */ (one))]));
}

/**
 * Return a number with a fixed count of decimals, as the language of the page writes it.
 * @param {number} value
 * @param {number} decimals
 */
export function fixed(value, decimals) {
  if (Number.isNaN(value)) return "–";
  const comma = document.documentElement.lang === "en" ? "." : ",";
  const digits = Math.abs(value).toFixed(decimals);
  return (value < 0 && Number(digits) !== 0 ? "−" : "") + digits.replace(".", comma);
}

/**
 * Return the number of a column in a row, with its unit.
 * @param {Column} column
 * @param {number} row
 */
export function told({ values, decimals, unit }, row) {
  const gap = unit === "" || unit === "°" || unit === "%" ? "" : "\u00a0";
  return fixed(values[row], decimals) + gap + unit;
}

/**
 * Return a number with some significant digits.
 * @param {number} value
 * @param {number} digits
 */
export function significant(value, digits = 4) {
  const power = value ? Math.floor(Math.log10(Math.abs(value))) : 0;
  return fixed(value, Math.max(0, digits - 1 - power));
}

/**
 * Return where a cursor stands: its row, or beside the rows the place itself.
 * @param {import("./cursor.js").Cursor} cursor
 * @param {Column} axis
 */
export function placeOf(cursor, axis) {
  const { rows, row, at } = cursor;
  if (Math.abs(rows[row] - at) <= 1e-6 * (rows[rows.length - 1] - rows[0])) return told(axis, row);
  return told({ ...axis, decimals: axis.decimals + 1, values: [cursor.at] }, 0);
}

/**
 * Return a number with up to some significant digits, as the language of the page writes it.
 * @param {number} value
 * @param {number} digits
 */
export function printed(value, digits = 6) {
  if (!Number.isFinite(value)) return "–";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e").map(Number);
  const isPlain = exponent >= -4 && exponent < digits;
  const comma = document.documentElement.lang === "en" ? "." : ",";
  const text = String(isPlain ? Number(value.toPrecision(digits)) : mantissa).replace("-", "−").replace(".", comma);
  if (isPlain) return text;
  const raised = String(exponent).replace(/./g, (one) => "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"["0123456789-".indexOf(one)]);
  return `${Math.abs(mantissa) === 1 ? text.replace("1", "") : `${text}·`}10${raised}`;
}

/**
 * Return the place of the number that lies nearest among rising ones.
 * @param {number[]} rising
 * @param {number} value
 */
export function nearest(rising, value) {
  const after = firstFrom(rising, value);
  if (after === 0) return 0;
  if (after === rising.length) return rising.length - 1;
  return value - rising[after - 1] < rising[after] - value ? after - 1 : after;
}

/**
 * Return the place of the first of rising numbers that is not less than a value.
 * @param {ArrayLike<number>} rising
 * @param {number} value
 */
export function firstFrom(rising, value) {
  let low = 0;
  let high = rising.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rising[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}
