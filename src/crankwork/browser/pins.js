// Variants that were pinned: their curves dashed behind those of now, at the scales of now; what values differ by.
import { Curve } from "./curves.js";
import { printed } from "./numbers.js";

/** @typedef {import("./figure.js").FigureData} FigureData */

/** @typedef {{text: string, fields: Record<string, string>, summary: Record<string, number>, curves: Record<string, {name: string, d: string, plot: import("./curves.js").Plot}[]>}} Pinned */

/** How many there may be. */
export const MOST_PINS = 4;

/**
 * Return the curves of the figures that are seen, to be kept.
 * @param {Iterable<SVGSVGElement>} figures
 * @param {Record<string, FigureData>} data
 */
export function curvesOf(figures, data) {
  /** @type {Pinned["curves"]} */
  const found = {};
  for (const svg of figures) {
    const name = svg.dataset.figure ?? "";
    const plots = data[name]?.plots ?? [];
    const paths = /** @type {SVGPathElement[]} */ ([...svg.querySelectorAll("path[data-curve]:not(.ghost)")]);
    found[name] = paths.flatMap((path) => {
      const { plot } = new Curve(path, plots);
      return plot && path.dataset.curve !== "legend" ? [{ name: path.dataset.curve ?? "", d: path.getAttribute("d") ?? "", plot }] : [];
    });
  }
  return found;
}

/**
 * Draw the curves of a variant behind those of now, where their quantities stand on the same graph, with its number.
 * @param {SVGSVGElement} svg
 * @param {Pinned} pinned
 * @param {FigureData} data
 * @param {number} number
 */
export function haunt(svg, pinned, data, number) {
  for (const { name, d, plot } of pinned.curves[svg.dataset.figure ?? ""] ?? []) {
    const now = data.plots.find((one) => one.t[0] === plot.t[0] && one.t[1] === plot.t[1]);
    if (!now) continue;
    const [across, right] = onto(plot.x, now.x, plot.box[0], plot.box[2], now.box[0], now.box[2]);
    const [down, below] = onto([plot.y[1], plot.y[0]], [now.y[1], now.y[0]], plot.box[1], plot.box[3], now.box[1], now.box[3]);
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    path.setAttribute("d", d);
    path.setAttribute("class", `ghost ghost-${number}`);
    path.dataset.curve = name;
    path.setAttribute("transform", `matrix(${across} 0 0 ${down} ${right} ${below})`);
    const [left, top, wide, tall] = now.box;
    const room = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    for (const [key, value] of Object.entries({ x: left, y: top, width: wide, height: tall, viewBox: `${left} ${top} ${wide} ${tall}` })) room.setAttribute(key, String(value));
    room.append(path);
    svg.prepend(room);
    // numbers stand apart from one another along the curves, where these are seen
    const places = [0, 0.06, -0.06, 0.12, 0.4, 0.6].map((more) => path.getPointAtLength(path.getTotalLength() * (0.1 + 0.15 * number + more)));
    const at = places.map(({ x, y }) => [x * across + right, y * down + below]).find(([x, y]) => x > left && x < left + wide && y > top && y < top + tall);
    if (!at) continue;
    const told = document.createElementNS("http://www.w3.org/2000/svg", "text");
    told.textContent = String(number);
    told.setAttribute("class", "ghost-number");
    told.setAttribute("x", String(at[0]));
    told.setAttribute("y", String(at[1]));
    svg.append(told);
  }
}

/**
 * Return in words which fields of a variant are not those of now.
 * @param {Record<string, string>} then
 * @param {Record<string, string>} now
 */
export function changed(then, now) {
  const keys = [...new Set([...Object.keys(then), ...Object.keys(now)])].filter((key) => then[key] !== now[key]);
  return keys.map((key) => `${key}: ${then[key] ?? "–"}`).join("\n");
}

/**
 * Return factor and shift that take a place of one scale to that of another.
 * @param {number[]} then ends of the scale that the place is told by
 * @param {number[]} now
 * @param {number} start where that scale begins [mm]
 * @param {number} length
 * @param {number} first
 * @param {number} wide
 */
function onto(then, now, start, length, first, wide) {
  const unit = ((then[1] - then[0]) / length) * (wide / (now[1] - now[0]));
  return [unit, first + ((then[0] - now[0]) * wide) / (now[1] - now[0]) - start * unit];
}

/**
 * Return what a value differs by from that of a variant: in per cent, but angles, and what was small, in their unit.
 * @param {number} now
 * @param {number | undefined} then
 * @param {[number, string]} scale the factor that shows it, and the unit
 */
export function differs(now, then, [factor, unit]) {
  if (then === undefined || Math.abs(now - then) <= 5e-4 * Math.abs(then)) return "";
  const [sign, apart] = [now > then ? "+" : "−", Math.abs(now - then)];
  if (unit === "°" || apart > Math.abs(then)) return `${sign}${printed(apart * factor, 3)}${unit === "°" ? "" : "\u00a0"}${unit}`;
  const percent = (100 * apart) / Math.abs(then);
  return `${sign}${printed(percent, percent < 1 ? 1 : 2)} %`;
}
