// The page: one cursor over the machine, the diagrams and the tables.
import { bar } from "./bar.js";
import { Cursor } from "./cursor.js";
import { Explanation } from "./explain.js";
import { choose, Film } from "./machine.js";
import { columnsOf, nearest } from "./numbers.js";
import { bindMenus, bindTabs } from "./tabs.js";
import { showTables } from "./table.js";

/**
 * @typedef {{axis: string, rows: import("./numbers.js").Packed, columns: Record<string, import("./numbers.js").Packed>,
 *   figures: Record<string, import("./figure.js").FigureData>, tables?: import("./table.js").TableData[],
 *   memories?: import("./explain.js").Memories, film?: import("./machine.js").FilmData,
 *   sliders?: import("./sliders.js").SlidersData}} PageData
 */

/**
 * @typedef {import("./figure.js").Figure} Figure
 * What sliders move: what is stored, columns, diagrams and the machine, the table that is shown.
 * @typedef {{data: PageData, columns: Record<string, import("./numbers.js").Column>, cursor: Cursor, figures: Figure[],
 *   film: Film | undefined, explanation: Explanation | null, tables: HTMLElement | null, show: (() => void) | undefined}} Opened
 */

/**
 * Bring to life what the page holds.
 * @param {typeof import("./figure.js").Figure} kind of its diagrams
 * @param {(opened: Opened) => void} [slide] what binds its sliders
 */
export function openStored(kind, slide) {
  const store = document.getElementById("data");
  if (store) unfolded(store.textContent ?? "").then((text) => begin(JSON.parse(text), kind, slide));
}

/**
 * Return a text that was compressed and written in letters.
 * @param {string} letters
 */
function unfolded(letters) {
  const bytes = Uint8Array.from(atob(letters.trim()), (one) => one.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
}

/**
 * @param {PageData} data
 * @param {typeof import("./figure.js").Figure} kind
 * @param {(opened: Opened) => void} [slide]
 */
function begin(data, kind, slide) {
  document.documentElement.classList.add("live");
  const columns = columnsOf(data);
  const axis = columns[data.axis];
  const cursor = new Cursor(axis.values, data.film?.angles.map((one) => one / (data.film?.degrees ?? 1)));
  /** @type {Figure[]} */
  const figures = [];
  for (const svg of /** @type {NodeListOf<SVGSVGElement>} */ (document.querySelectorAll("svg.drawing[data-figure]"))) {
    const own = data.figures[svg.dataset.figure ?? ""];
    if (own) figures.push(new kind(svg, own, columns, data.axis, cursor));
    const { places, shown } = own ?? {};
    const inside = svg.querySelector("g.moving");
    if (places && shown && inside) {
      let last = "";
      cursor.follow(() => {
        const now = shown[nearest(places, cursor.at)];
        if (now !== last) inside.innerHTML = last = now;
      });
    }
  }
  const room = document.getElementById("explanation");
  const explanation = room && data.memories ? new Explanation(room, data.memories, columns, axis.symbol, cursor) : null;
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-key]"))) {
    button.addEventListener("click", () => explanation?.explain(button.dataset.key ?? ""));
  }
  const tables = document.getElementById("tables");
  const filed = new Set(data.sliders?.filed);
  const show = tables && data.tables && showTables(tables, data.tables, columns, cursor, (key) => explanation?.explain(key), filed);
  const machine = /** @type {SVGSVGElement | null} */ (document.querySelector('[data-figure="machine"]'));
  // where nothing has a course there is nothing to run
  if (!Object.keys(data.columns).length) for (const one of document.querySelectorAll("#play, #slider, #shown, #tables")) one.setAttribute("hidden", "");
  const motion = bar(cursor, axis, data.film?.seconds ?? 4, data.film?.turns ?? true);
  const film = machine && data.film ? new Film(machine, data.film, cursor) : undefined;
  if (film && motion) choose(film, motion);
  slide?.({ data, columns, cursor, figures, film, explanation, tables, show: show || undefined });
  bindPanels();
  reachWide();
  addEventListener("resize", reachWide);
  if (data.film && motion && !matchMedia("(prefers-reduced-motion: reduce)").matches) motion.start();
}

// diagrams of a tab that are open at a time
const MOST_OPEN = 6;

/** Show one tab at a time, that of a link too; of many diagrams some are closed. */
function bindPanels() {
  const show = bindTabs(document.querySelector("main > [role=tablist]"));
  bindMenus();
  for (const panel of document.querySelectorAll("[role=tabpanel]")) {
    const figures = [...panel.querySelectorAll(".figures > figure")];
    if (figures.length > MOST_OPEN) for (const [k, figure] of figures.entries()) bindFold(figure, figures, k >= MOST_OPEN);
  }
  const go = () => {
    const target = document.getElementById(location.hash.slice(1));
    const panel = target?.closest("[role=tabpanel]");
    if (!panel) return;
    show(panel.id);
    if (target?.matches(".shut")) target.querySelector("button")?.click();
    target?.scrollIntoView();
  };
  addEventListener("hashchange", go);
  go();
}

/**
 * Let the title of a diagram open and close it; where too many would be open, the first of the others closes.
 * @param {Element} figure
 * @param {Element[]} every
 * @param {boolean} isShut
 */
function bindFold(figure, every, isShut) {
  const caption = figure.querySelector("figcaption");
  const button = document.createElement("button");
  button.textContent = caption?.textContent ?? "";
  caption?.replaceChildren(button);
  const fold = () => {
    figure.classList.toggle("shut", isShut);
    button.ariaExpanded = String(!isShut);
  };
  button.addEventListener("click", () => {
    const open = every.filter((one) => !one.matches(".shut"));
    if (isShut && open.length >= MOST_OPEN) open[0].querySelector("button")?.click();
    isShut = !isShut;
    fold();
  });
  fold();
}

/** Let keys reach what is wider than its room, and nothing else. */
function reachWide() {
  for (const one of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("div.table, .lines"))) {
    if (one.scrollWidth > one.clientWidth) one.tabIndex = 0;
    else one.removeAttribute("tabindex");
  }
}
