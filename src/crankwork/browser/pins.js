// Variants that were pinned: their curves dashed behind those of now, at the scales of now; what values differ by.
import { span } from "./frame.js";
import { printed } from "./numbers.js";
import { shape } from "./shape.js";

/** @typedef {import("./curves.js").Plot} Plot */

/** A curve as it was written, its graph, and the least and the largest of its values. @typedef {{name: string, d: string, plot: Plot, reach: [number, number][]}} PinnedCurve */

/** @typedef {{text: string, fields: Record<string, string>, summary: Record<string, number>, curves: Record<string, PinnedCurve[]>}} Pinned */

/** How many there may be. */
export const MOST_PINS = 4;

/**
 * Return the curves of figures as they were written, to be kept.
 * @param {Iterable<import("./figure.js").Figure>} figures
 */
export function curvesOf(figures) {
  /** @type {Pinned["curves"]} */
  const found = {};
  for (const { svg, curves } of figures) {
    found[svg.dataset.figure ?? ""] = curves.flatMap((one) => {
      const { x, y } = one.values();
      return one.plot && one.ends ? [{ name: one.name, d: one.d, plot: { ...one.plot, ...one.ends }, reach: [span(x), span(y)] }] : [];
    });
  }
  return found;
}

/** A curve of a variant behind those of now, with its number; it stands in the scales of its graph. */
export class Ghost {
  /**
   * @param {SVGSVGElement} svg
   * @param {PinnedCurve} curve
   * @param {Plot} now
   * @param {number} number
   */
  constructor(svg, curve, now, number) {
    this.curve = curve;
    this.now = now;
    this.number = number;
    this.path = shape("path", { d: curve.d, class: `ghost ghost-${number}`, "data-curve": curve.name });
    const [left, top, wide, tall] = now.box;
    const room = shape("svg", { x: left, y: top, width: wide, height: tall, viewBox: `${left} ${top} ${wide} ${tall}` });
    room.append(this.path);
    svg.prepend(room);
    this.label = shape("text", { class: "ghost-number" });
    this.label.textContent = String(number);
    svg.append(this.label);
    // numbers stand apart from one another along the curves
    const long = this.path.getTotalLength();
    this.places = [0, 0.06, -0.06, 0.12, 0.4, 0.6].map((more) => this.path.getPointAtLength(long * (0.1 + 0.15 * number + more)));
    /** @type {number[][]} */
    this.scales = [];
    this.place();
  }

  /** Stand where the scales of now put it. */
  place() {
    const { path, label, places, now, curve: { plot: then } } = this;
    if (this.scales[0] === now.x && this.scales[1] === now.y) return;
    this.scales = [now.x, now.y];
    const [left, top, wide, tall] = now.box;
    const [across, right] = onto(then.x, now.x, then.box[0], then.box[2], left, wide);
    const [down, below] = onto([then.y[1], then.y[0]], [now.y[1], now.y[0]], then.box[1], then.box[3], top, tall);
    path.setAttribute("transform", `matrix(${across} 0 0 ${down} ${right} ${below})`);
    const at = places.map(({ x, y }) => [x * across + right, y * down + below]).find(([x, y]) => x > left && x < left + wide && y > top && y < top + tall);
    label.toggleAttribute("hidden", !at);
    for (const [k, key] of ["x", "y"].entries()) label.setAttribute(key, String(at?.[k] ?? 0));
  }
}

/**
 * Return the curves of variants whose quantities stand on graphs of a figure.
 * @param {SVGSVGElement} svg
 * @param {Pinned[]} pins
 * @param {Plot[]} plots
 */
export function ghostsOf(svg, pins, plots) {
  return pins.flatMap(({ curves }, k) => (curves[svg.dataset.figure ?? ""] ?? []).flatMap((curve) => {
    const now = plots.find(({ t }) => t[0] === curve.plot.t[0] && t[1] === curve.plot.t[1]);
    return now ? [new Ghost(svg, curve, now, k + 1)] : [];
  }));
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
