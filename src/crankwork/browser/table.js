// Tables over the crank angle: the row of the cursor is marked, a click goes to its point and explains the value; so does
// Enter in a cell, to which arrow keys go.
import { fixed } from "./numbers.js";

/** @typedef {import("./numbers.js").Column} Column */
/** @typedef {import("./cursor.js").Cursor} Cursor */

/** @typedef {{n: string, k: string[]}} TableData */

/** Columns and rows that a key goes on. @type {Record<string, [number, number]>} */
const NEAR_CELL = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

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

  /** Let the tabulator come to a cell, and to no other. @param {HTMLTableCellElement | undefined} cell */
  function reach(cell) {
    if (!cell) return;
    table.querySelector("td[tabindex]")?.removeAttribute("tabindex");
    cell.tabIndex = 0;
  }

  function show() {
    const chosen = tables[Number(choice.value)];
    if (!chosen) return;
    const keys = chosen.k;
    const heads = keys.map((key) => {
      const { symbol, name, unit } = columns[key];
      return `<th scope="col"><button type="button" title="${name}">${symbol}${unit ? `, ${unit}` : ""}</button></th>`;
    });
    const rows = cursor.rows.map((_, row) => {
      const cells = keys.map((key) => `<td${filed.has(key) ? ' class="filed"' : ""}>${fixed(columns[key].values[row], columns[key].decimals)}</td>`);
      return `<tr>${cells.join("")}</tr>`;
    });
    table.innerHTML = `<thead><tr>${heads.join("")}</tr></thead><tbody>${rows.join("")}</tbody>`;
    table.ariaLabel = chosen.n;
    mark();
    reach(table.tBodies[0]?.rows[cursor.row]?.cells[0]);
  }

  choice.addEventListener("change", show);
  table.addEventListener("keydown", (event) => {
    const cell = event.target, step = NEAR_CELL[event.key];
    if (!(cell instanceof HTMLTableCellElement)) return;
    if (event.key === "Enter" || event.key === " ") cell.click();
    else if (!step) return;
    else {
      const row = /** @type {HTMLTableRowElement} */ (cell.parentElement).sectionRowIndex + step[1];
      const next = table.tBodies[0].rows[row]?.cells[cell.cellIndex + step[0]];
      reach(next);
      next?.focus();
    }
    event.preventDefault();
    event.stopPropagation();
  });
  table.addEventListener("click", (event) => {
    const cell = /** @type {Element} */ (event.target).closest("td, th");
    const row = cell?.parentElement;
    if (!(cell instanceof HTMLTableCellElement) || !(row instanceof HTMLTableRowElement)) return;
    if (cell.matches("td")) cursor.snap(cursor.rows[row.sectionRowIndex]);
    explain(tables[Number(choice.value)].k[cell.cellIndex]);
  });
  show();
  cursor.follow(mark);
  return show;
}
