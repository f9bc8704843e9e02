// Tables over the crank angle: the row of the cursor is marked, a click goes to its point and explains the value.
import { fixed } from "./numbers.js";

/** @typedef {import("./numbers.js").Column} Column */
/** @typedef {import("./cursor.js").Cursor} Cursor */

/** @typedef {{n: string, k: string[]}} TableData */

/**
 * Show one of some tables, chosen from a list.
 * @param {HTMLElement} room
 * @param {TableData[]} tables
 * @param {Record<string, Column>} columns
 * @param {Cursor} cursor
 * @param {(key: string) => void} explain
 * @param {Set<string>} filed columns that do not follow the sliders
 * @returns {() => void} what shows the table anew
 */
export function showTables(room, tables, columns, cursor, explain, filed) {
  const choice = /** @type {HTMLSelectElement} */ (room.querySelector("select"));
  const table = /** @type {HTMLTableElement} */ (room.querySelector("table"));
  choice.append(...tables.map((one, k) => new Option(one.n, String(k))));
  /** @type {Element | null} */
  let marked = null;

  function mark() {
    marked?.classList.remove("here");
    marked = table.tBodies[0]?.rows[cursor.row] ?? null;
    marked?.classList.add("here");
  }

  function show() {
    const keys = tables[Number(choice.value)].k;
    const heads = keys.map((key) => {
      const { symbol, name, unit } = columns[key];
      return `<th scope="col"><button type="button" title="${name}">${symbol}${unit ? `, ${unit}` : ""}</button></th>`;
    });
    const rows = cursor.rows.map((_, row) => {
      const cells = keys.map((key) => `<td${filed.has(key) ? ' class="filed"' : ""}>${fixed(columns[key].values[row], columns[key].decimals)}</td>`);
      return `<tr>${cells.join("")}</tr>`;
    });
    table.innerHTML = `<thead><tr>${heads.join("")}</tr></thead><tbody>${rows.join("")}</tbody>`;
    table.setAttribute("aria-label", tables[Number(choice.value)].n);
    mark();
  }

  choice.addEventListener("change", show);
  table.addEventListener("click", (event) => {
    const cell = /** @type {Element} */ (event.target).closest("td, th");
    const row = cell?.parentElement;
    if (!(cell instanceof HTMLTableCellElement) || !(row instanceof HTMLTableRowElement)) return;
    if (cell.matches("td")) cursor.snap(cursor.rows[row.sectionRowIndex]);
    explain(tables[Number(choice.value)].k[cell.cellIndex]);
  });
  if (tables.length) show();
  cursor.follow(mark);
  return show;
}
