// The page: one cursor over the machine, the diagrams and the tables.
import { Cursor } from "./cursor.js";
import { Explanation } from "./explain.js";
import { Figure } from "./figure.js";
import { choose, Film, Motion } from "./machine.js";
import { told, unpacked } from "./numbers.js";
import { showTables } from "./table.js";

/**
 * @typedef {{axis: string, rows: import("./numbers.js").Packed, columns: Record<string, import("./numbers.js").Packed>,
 *   figures: Record<string, import("./figure.js").FigureData>, tables?: import("./table.js").TableData[],
 *   memories?: import("./explain.js").Memories, film?: import("./machine.js").FilmData}} PageData
 */

const store = document.getElementById("data");
if (store) unfolded(store.textContent ?? "").then((text) => begin(JSON.parse(text)));

/**
 * Return a text that was compressed and written in letters.
 * @param {string} letters
 */
function unfolded(letters) {
  const bytes = Uint8Array.from(atob(letters.trim()), (one) => one.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
}

/** @param {PageData} data */
function begin(data) {
  document.documentElement.classList.add("live");
  const columns = Object.fromEntries(Object.entries(data.columns).map(([key, one]) => [key, unpacked(one)]));
  const axis = unpacked(data.rows);
  columns[data.axis] = axis;
  const cursor = new Cursor(axis.values);
  for (const svg of /** @type {NodeListOf<SVGSVGElement>} */ (document.querySelectorAll("svg.drawing[data-figure]"))) {
    const own = data.figures[svg.dataset.figure ?? ""];
    if (own) new Figure(svg, own, columns, data.axis, cursor);
  }
  const room = document.getElementById("explanation");
  const explanation = room && data.memories ? new Explanation(room, data.memories, columns, axis.symbol, cursor) : null;
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-key]"))) {
    button.addEventListener("click", () => explanation?.explain(button.dataset.key ?? ""));
  }
  const tables = document.getElementById("tables");
  if (tables && data.tables) showTables(tables, data.tables, columns, cursor, (key) => explanation?.explain(key));
  const machine = /** @type {SVGSVGElement | null} */ (document.querySelector('[data-figure="machine"]'));
  const motion = bar(cursor, axis, data.film?.seconds ?? 4, data.film?.turns ?? true);
  if (machine && data.film && motion) choose(new Film(machine, data.film, cursor), motion);
  reachWide();
  addEventListener("resize", reachWide);
  if (data.film && motion && !matchMedia("(prefers-reduced-motion: reduce)").matches) motion.start();
}

/** Let keys reach what is wider than its room, and nothing else. */
function reachWide() {
  for (const one of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("div.table, .lines"))) {
    if (one.scrollWidth > one.clientWidth) one.tabIndex = 0;
    else one.removeAttribute("tabindex");
  }
}

/**
 * Bind what stands on the bar: the button that starts and stops, the slider, its number, the choice of colours.
 * @param {Cursor} cursor
 * @param {import("./numbers.js").Column} axis
 * @param {number} seconds
 * @param {boolean} turns
 */
function bar(cursor, axis, seconds, turns) {
  const slider = /** @type {HTMLInputElement | null} */ (document.getElementById("slider"));
  const shown = document.getElementById("shown");
  const play = /** @type {HTMLButtonElement | null} */ (document.getElementById("play"));
  if (!slider || !shown || !play) return undefined;
  const motion = new Motion(cursor, play, seconds, turns);
  slider.max = String(cursor.rows.length - 1);
  slider.addEventListener("input", () => cursor.snap(cursor.rows[Number(slider.value)]));
  cursor.follow(() => {
    slider.value = String(cursor.row);
    const text = told(axis, cursor.row);
    shown.innerHTML = `${axis.symbol} = ${text}`;
    slider.setAttribute("aria-valuetext", text);
  });
  document.addEventListener("keydown", (event) => {
    const target = /** @type {Element} */ (event.target);
    if (event.ctrlKey || event.altKey || event.metaKey || target.closest("input, select, button, summary, [role=button]")) return;
    if (event.key === "ArrowRight") cursor.step(1);
    else if (event.key === "ArrowLeft") cursor.step(-1);
    else if (event.key === "Home") cursor.snap(cursor.rows[0]);
    else if (event.key === " " && !target.closest("a")) play.click();
    else return;
    event.preventDefault();
  });
  const look = document.getElementById("look");
  look?.addEventListener("click", () => {
    const root = document.documentElement;
    const dark = root.dataset.look ? root.dataset.look === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.look = dark ? "light" : "dark";
  });
  return motion;
}
