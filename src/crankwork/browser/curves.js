// Curves of a drawing: their points, and where one stands at a crank angle.
import { firstFrom, significant } from "./numbers.js";

/**
 * A curve that follows the sliders: columns across and upward, or the single value where it is level, each with a factor;
 * or its points in machines that it lies between, across the same or one for each, and their crank angles.
 * @typedef {{x?: [string, number], y?: [string, number], level?: [string, number],
 *   between?: {x: number[][], y: number[][], at: number[]}}} Made
 */

/**
 * A graph on a drawing: left, top, width and height [mm], ends of its scales, what stands across, titles of its axes;
 * where it follows sliders its curves, ticks, which of these have numbers, and powers of ten that the numbers lack;
 * of a plan of positions what stands upon joints; numbers in the legend.
 * @typedef {{box: [number, number, number, number], x: [number, number], y: [number, number], over: string,
 *   t: [string, string], curves?: Record<string, Made>, ticks?: [number[], number[]], labels?: [boolean, boolean],
 *   powers?: [number, number], upon?: import("./plans.js").Upon, told?: import("./following.js").Told[]}} Plot
 */

export class Curve {
  /**
   * @param {SVGPathElement} path
   * @param {Plot[]} plots
   */
  constructor(path, plots) {
    this.path = path;
    this.name = path.dataset.curve ?? "";
    const { x, y } = points(path.getAttribute("d") ?? "");
    this.x = x;
    this.y = y;
    const [around, ...within] = plots.filter((plot) => holds(plot.box, x, y));
    // a graph may stand within another
    this.plot = within.find(({ box }) => contains(box, x, y)) ?? around;
    this.d = path.getAttribute("d") ?? "";
    this.home = { x, y, angles: /** @type {number[] | undefined} */ (undefined) };
    this.made = this.plot?.curves?.[this.name];
    /** Crank angles of the points, or nothing. @type {number[] | undefined} */
    this.angles = undefined;
    const plot = this.plot;
    if (path.dataset.at) {
      let sum = 0;
      const steps = path.dataset.at.match(/[a-z]|[^a-z ]+/g) ?? [];
      this.angles = steps.map((step) => (sum += step < "a" ? Math.round(10 * Number(step)) : 10 * (step.charCodeAt(0) - 96)) / 10);
    } else if (plot?.over) {
      this.angles = x.map((one) => plot.x[0] + ((one - plot.box[0]) / plot.box[2]) * (plot.x[1] - plot.x[0]));
    }
    this.home.angles = this.angles;
    this.ends = plot ? { x: plot.x, y: plot.y } : undefined;
  }

  /** Go back to what the page was written with. */
  back() {
    ({ x: this.x, y: this.y, angles: this.angles } = this.home);
    this.path.setAttribute("d", this.d);
  }

  /** Return what the page was written with as values of its scales. */
  values() {
    const { plot, ends } = this;
    if (!plot || !ends) return { x: this.home.x, y: this.home.y };
    const [left, top, width, height] = plot.box;
    const x = this.home.x.map((one) => ends.x[0] + ((one - left) / width) * (ends.x[1] - ends.x[0]));
    const y = this.home.y.map((one) => ends.y[1] + ((one - top) / height) * (ends.y[0] - ends.y[1]));
    return { x, y };
  }

  /**
   * Draw it through values of its scales.
   * @param {ArrayLike<number>} across
   * @param {ArrayLike<number>} upward
   * @param {number[]} [angles]
   */
  through(across, upward, angles) {
    const { plot } = this;
    if (!plot) return;
    const [left, top, width, height] = plot.box;
    const [a, b] = [width / (plot.x[1] - plot.x[0]), height / (plot.y[0] - plot.y[1])];
    const [x, y] = [new Array(across.length), new Array(across.length)];
    let d = "";
    for (let k = 0; k < across.length; k += 1) {
      x[k] = Math.round((left + (across[k] - plot.x[0]) * a) * 100) / 100;
      y[k] = Math.round((top + (upward[k] - plot.y[1]) * b) * 100) / 100;
      d += `${k ? "L" : "M"}${x[k]} ${y[k]}`;
    }
    this.x = x;
    this.y = y;
    this.angles = angles ?? this.home.angles;
    this.path.setAttribute("d", d);
  }

  /**
   * Return where the curve is at a crank angle.
   * @param {number} angle
   * @returns {[number, number] | undefined}
   */
  place(angle) {
    const angles = this.angles;
    if (!angles || angles.length < 2) return undefined;
    const slack = 1e-3 * Math.abs(angles[angles.length - 1] - angles[0]);
    if (angle < angles[0] - slack || angle > angles[angles.length - 1] + slack) return undefined;
    const after = Math.min(Math.max(firstFrom(angles, angle), 1), angles.length - 1);
    const gap = angles[after] - angles[after - 1];
    const share = gap > 0 ? Math.min(Math.max((angle - angles[after - 1]) / gap, 0), 1) : 1;
    const between = (/** @type {number[]} */ one) => one[after - 1] + share * (one[after] - one[after - 1]);
    return [between(this.x), between(this.y)];
  }

  /**
   * Return what the scales say at a place of the drawing, each with its title, in words. [mm]
   * @param {[number, number]} place
   * @param {string} name what is told instead of the title of the vertical scale
   */
  told([x, y], name) {
    if (!this.plot) return [];
    const { box, x: across, y: up, over, t: titles } = this.plot;
    const values = [across[0] + ((x - box[0]) / box[2]) * (across[1] - across[0]), up[1] + ((y - box[1]) / box[3]) * (up[0] - up[1])];
    return [over ? "" : titles[0], name || titles[1]].flatMap((title, k) => {
      if (!title) return [];
      const [, words, unit] = /^(.*?)(?:, ([^,]*))?$/.exec(title) ?? ["", title, ""];
      return [`${words}: ${significant(values[k])}${unit ? `\u00a0${unit}` : ""}`];
    });
  }
}

/**
 * Return the points of a path that goes to one and on by steps.
 * @param {string} d
 */
function points(d) {
  const straight = /^M(-?[\d.]+)[ ]?(-?[\d.]+)([hv])(-?[\d.]+)$/.exec(d);
  if (straight) {
    const [x, y, by] = [straight[1], straight[2], straight[4]].map(Number);
    return { x: [x, straight[3] === "h" ? x + by : x], y: [y, straight[3] === "v" ? y + by : y] };
  }
  const numbers = (d.match(/-?(\d+\.?\d*|\.\d+)/g) ?? []).map(Number);
  const x = [numbers[0]];
  const y = [numbers[1]];
  for (let k = 2; k + 1 < numbers.length; k += 2) {
    x.push(x[x.length - 1] + numbers[k]);
    y.push(y[y.length - 1] + numbers[k + 1]);
  }
  return { x, y };
}

/**
 * Return whether all of a curve lies in a box.
 * @param {number[]} box
 * @param {number[]} x
 * @param {number[]} y
 */
function contains([left, top, width, height], x, y) {
  return x.every((one) => one > left - 1 && one < left + width + 1) && y.every((one) => one > top - 1 && one < top + height + 1);
}

/**
 * Return whether the middle of a curve lies in a box.
 * @param {number[]} box
 * @param {number[]} x
 * @param {number[]} y
 */
function holds([left, top, width, height], x, y) {
  const middle = (/** @type {number[]} */ one) => (Math.min(...one) + Math.max(...one)) / 2;
  const [a, b] = [middle(x), middle(y)];
  return a > left - 1 && a < left + width + 1 && b > top - 1 && b < top + height + 1;
}
