// The page: one cursor over the machine, the diagrams and the tables.
import { bar } from "./bar.js";
import { Cursor } from "./cursor.js";
import { Explanation } from "./explain.js";
import { Figure } from "./figure.js";
import { Joints } from "./joints.js";
import { Lines } from "./lines.js";
import { choose, Film } from "./machine.js";
import { unpacked } from "./numbers.js";
import { bindSliders, Live } from "./sliders.js";
import { showTables } from "./table.js";

/**
 * @typedef {{axis: string, rows: import("./numbers.js").Packed, columns: Record<string, import("./numbers.js").Packed>,
 *   figures: Record<string, import("./figure.js").FigureData>, tables?: import("./table.js").TableData[],
 *   memories?: import("./explain.js").Memories, film?: import("./machine.js").FilmData,
 *   sliders?: import("./sliders.js").SlidersData}} PageData
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
  const figures = [];
  for (const svg of /** @type {NodeListOf<SVGSVGElement>} */ (document.querySelectorAll("svg.drawing[data-figure]"))) {
    const own = data.figures[svg.dataset.figure ?? ""];
    if (own) figures.push(new Figure(svg, own, columns, data.axis, cursor));
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
  const motion = bar(cursor, axis, data.film?.seconds ?? 4, data.film?.turns ?? true);
  const film = machine && data.film ? new Film(machine, data.film, cursor) : undefined;
  if (film && motion) choose(film, motion);
  const moves = document.getElementById("sliders");
  // a page with sliders has the steps of its calculation before this script
  const { steps } = /** @type {{steps?: import("./calculation.js").Steps}} */ (globalThis);
  if (moves && data.sliders && steps) {
    const live = new Live(data.sliders, steps, columns);
    const lines = new Lines(live.calculation, data.film?.degrees ?? 1);
    const late = whenSeen([
      ...figures.filter((one) => one.follows).map((one) => ({ at: one.svg, show: () => (live.moved ? one.follow(lines) : one.back()) })),
      ...(tables && show ? [{ at: tables, show }] : []),
    ]);
    const joints = film && data.sliders.joints ? new Joints(film, live, data.sliders.joints) : undefined;
    cursor.follow(() => joints?.draw(cursor.at * (data.film?.degrees ?? 1)));
    bindSliders(moves, live, () => {
      late();
      joints?.fit();
      explanation?.follow(live);
      if (!cursor.runs) cursor.move(cursor.at);
    });
  }
  reachWide();
  addEventListener("resize", reachWide);
  if (data.film && motion && !matchMedia("(prefers-reduced-motion: reduce)").matches) motion.start();
}

/**
 * Return what shows things anew: those that are seen at once, others when they come into view.
 * @param {{at: Element, show: () => void}[]} every
 */
function whenSeen(every) {
  const late = new Set(every);
  const seen = new Set();
  const watch = new IntersectionObserver((found) => {
    for (const { target, isIntersecting } of found) {
      const one = every.find(({ at }) => at === target);
      if (!one) continue;
      if (!isIntersecting) seen.delete(one);
      else {
        seen.add(one);
        if (late.delete(one)) one.show();
      }
    }
  }, { rootMargin: "200px" });
  late.clear();
  for (const { at } of every) watch.observe(at);
  addEventListener("beforeprint", () => {
    for (const one of late) one.show();
    late.clear();
  });
  return () => {
    for (const one of every) {
      if (seen.has(one)) one.show();
      else late.add(one);
    }
  };
}

/** Let keys reach what is wider than its room, and nothing else. */
function reachWide() {
  for (const one of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("div.table, .lines"))) {
    if (one.scrollWidth > one.clientWidth) one.tabIndex = 0;
    else one.removeAttribute("tabindex");
  }
}
