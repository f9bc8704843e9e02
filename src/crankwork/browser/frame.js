// The frame of a graph: scales that hold what the curves have become, ticks, grid and numbers.
import { printed } from "./numbers.js";

/** @typedef {import("./curves.js").Plot} Plot */
/** @typedef {[number, number]} Ends */

// of the range, room beyond the largest and the least; what of a scale curves fill at least
const ROOM = 0.06;
const FILLED = 0.4;
// marks on the axes [mm]
const MARK = 0.9;

export class Frame {
  /**
   * @param {SVGGElement} group what the page was written with
   * @param {Plot} plot
   */
  constructor(group, plot) {
    this.group = group;
    this.plot = plot;
    this.home = { x: plot.x, y: plot.y };
    /** The lines of the grid. @type {SVGPathElement | null} */
    this.grid = null;
    /** @type {SVGPathElement | null} */
    this.axes = null;
    this.find();
    this.inside = group.innerHTML;
    const texts = [...group.querySelectorAll("text")];
    this.across = texts.find((one) => one.classList.contains("dm"));
    this.upward = texts.find((one) => one.classList.contains("de"));
  }

  /** Whether it can be drawn anew. */
  get moves() {
    return Boolean(this.grid && this.axes && this.plot.ticks);
  }

  /** Go back to what the page was written with. */
  back() {
    if (this.plot.x === this.home.x && this.plot.y === this.home.y) return;
    [this.plot.x, this.plot.y] = [this.home.x, this.home.y];
    this.group.innerHTML = this.inside;
    this.find();
  }

  /** Find the lines. */
  find() {
    [this.grid, this.axes] = ["[stroke]", ":not([stroke])"].map((kind) => /** @type {SVGPathElement | null} */ (this.group.querySelector(`path${kind}`)));
  }

  /**
   * Take scales that hold values, where those there are do not, or are far too large.
   * @param {Ends} x least and largest of what stands across, where that may change
   * @param {Ends} y
   */
  fit(x, y) {
    const { plot } = this;
    const isRound = !plot.over && plot.x[0] === -plot.x[1] && plot.y[0] === -plot.y[1];
    if (isRound) {
      const reach = Math.max(...[...x, ...y].map(Math.abs)) * (1 + 2 * ROOM);
      const now = Math.min(Math.abs(plot.x[1]), Math.abs(plot.y[1]));
      if (reach <= now && reach >= FILLED * now) return;
      const by = reach / now;
      this.take(/** @type {Ends} */ (plot.x.map((one) => one * by)), /** @type {Ends} */ (plot.y.map((one) => one * by)));
      return;
    }
    const [across, up] = [plot.over ? plot.x : fitted(plot.x, x), fitted(plot.y, y)];
    if (!this.isEqual) this.take(across, up);
    else if (!hasRoomFor(plot.x, x) || !hasRoomFor(plot.y, y) || Math.max(filledBy(plot.x, x), filledBy(plot.y, y)) < FILLED) this.take(...inOneScale(plot.box, across, up));
  }

  /** Whether both scales are one, as of a diagram of vectors. */
  get isEqual() {
    const { over, box } = this.plot;
    const [a, b] = [box[2] / Math.abs(this.home.x[1] - this.home.x[0]), box[3] / Math.abs(this.home.y[1] - this.home.y[0])];
    return !over && Math.abs(a - b) < 1e-3 * a;
  }

  /**
   * @param {Ends} x
   * @param {Ends} y
   */
  take(x, y) {
    const { plot } = this;
    if (same(x, plot.x) && same(y, plot.y)) return;
    const height = plot.box[3] * 72 / 25.4;
    const ticks = [
      same(x, this.home.x) || !plot.ticks?.[0].length ? plot.ticks?.[0] ?? [] : roundTicks(x, 8),
      roundTicks(y, Math.max(4, Math.round(height / 24))),
    ];
    [plot.x, plot.y] = [x, y];
    this.draw(ticks[0], ticks[1]);
  }

  /**
   * @param {number[]} xTicks
   * @param {number[]} yTicks
   */
  draw(xTicks, yTicks) {
    const { plot } = this;
    const [left, top, width, height] = plot.box;
    const [right, bottom] = [left + width, top + height];
    const across = xTicks.map((one) => placed(one, plot.x, left, width));
    const down = yTicks.map((one) => bottom - (placed(one, plot.y, 0, height)));
    const isInside = Math.min(...plot.y) < 0 && Math.max(...plot.y) > 0;
    const level = isInside ? bottom - placed(0, plot.y, 0, height) : bottom;
    const lines = (/** @type {number[][]} */ ends) => ends.map((one) => `M${shown(one[0])} ${shown(one[1])}L${shown(one[2])} ${shown(one[3])}`).join("");
    this.grid?.setAttribute("d", lines([...across.map((x) => [x, top, x, bottom]), ...down.map((y) => [left, y, right, y])]));
    const marks = [...across.map((x) => [x, level - MARK, x, level + MARK]), ...down.map((y) => [left - 1.4 * MARK, y, left, y])];
    this.axes?.setAttribute("d", lines([[left, top, left, bottom], [left, level, right, level], ...marks]));
    for (const one of this.group.querySelectorAll("text")) one.remove();
    const labels = plot.labels ?? [true, true];
    const powers = plot.powers ?? [0, 0];
    if (labels[0]) xTicks.forEach((one, k) => this.write(this.across, one / 10 ** powers[0], across[k], undefined));
    if (labels[1]) yTicks.forEach((one, k) => this.write(this.upward, one / 10 ** powers[1], undefined, down[k] + 1.06));
  }

  /**
   * Write a number as the first one of its axis was.
   * @param {SVGTextElement | undefined} like
   * @param {number} value
   * @param {number | undefined} x
   * @param {number | undefined} y
   */
  write(like, value, x, y) {
    if (!like) return;
    const text = /** @type {SVGTextElement} */ (like.cloneNode());
    text.textContent = printed(value, 10);
    if (x !== undefined) text.setAttribute("x", shown(x));
    if (y !== undefined) text.setAttribute("y", shown(y));
    this.group.append(text);
  }
}

/**
 * Return ends of a scale: those there are, if values lie within them and fill enough.
 * @param {Ends} now
 * @param {Ends} values
 * @returns {Ends}
 */
function fitted(now, [least, largest]) {
  const [low, high] = [Math.min(...now), Math.max(...now)];
  const [reachLow, reachHigh] = low > 0 || high < 0 ? [least, largest] : [Math.min(least, 0), Math.max(largest, 0)];
  const room = ROOM * (reachHigh - reachLow) || 1;
  // places of what was drawn are rounded
  const isZero = (/** @type {number} */ one) => Math.abs(one) <= 3e-4 * (reachHigh - reachLow);
  const slack = 1e-9 * (high - low);
  if (reachLow >= low - slack && reachHigh <= high + slack && reachHigh - reachLow >= FILLED * (high - low)) return now;
  const ends = /** @type {Ends} */ ([isZero(reachLow) ? 0 : reachLow - room, isZero(reachHigh) ? 0 : reachHigh + room]);
  return now[0] > now[1] ? [ends[1], ends[0]] : ends;
}

/**
 * Return whether a scale holds values.
 * @param {Ends} scale
 * @param {Ends} values
 */
function hasRoomFor(scale, [least, largest]) {
  return least >= Math.min(...scale) && largest <= Math.max(...scale);
}

/**
 * Return what of a scale values fill.
 * @param {Ends} scale
 * @param {Ends} values
 */
function filledBy(scale, [least, largest]) {
  return (largest - least) / Math.abs(scale[1] - scale[0]);
}

/**
 * Return scales that are one: that which has less room goes on, and the other reaches further both ways.
 * @param {number[]} box
 * @param {Ends} x
 * @param {Ends} y
 * @returns {[Ends, Ends]}
 */
function inOneScale([, , width, height], x, y) {
  const length = Math.max(Math.abs(x[1] - x[0]) / width, Math.abs(y[1] - y[0]) / height);
  const around = (/** @type {Ends} */ [start, end], /** @type {number} */ size) => {
    const [middle, half] = [(start + end) / 2, (Math.sign(end - start) * length * size) / 2];
    return /** @type {Ends} */ ([middle - half, middle + half]);
  };
  return [around(x, width), around(y, height)];
}

/**
 * Return round numbers within a range.
 * @param {Ends} ends
 * @param {number} most
 */
function roundTicks(ends, most) {
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  const span = high - low || 1;
  const power = 10 ** Math.floor(Math.log10(span / most));
  const step = ([1, 2, 2.5, 5, 10, 20].find((one) => span / (one * power) <= most) ?? 20) * power;
  const found = [];
  for (let at = Math.ceil(low / step - 1e-9); at <= Math.floor(high / step + 1e-9); at += 1) found.push(Number((at * step).toPrecision(10)));
  return found;
}

/**
 * Return where a value stands on a length.
 * @param {number} value
 * @param {Ends} ends
 * @param {number} start
 * @param {number} length
 */
function placed(value, ends, start, length) {
  return start + (length * (value - ends[0])) / (ends[1] - ends[0]);
}

/** @param {number} place */
function shown(place) {
  return String(Math.round(place * 100) / 100);
}

/**
 * @param {Ends} one
 * @param {Ends} other
 */
function same(one, other) {
  return one[0] === other[0] && one[1] === other[1];
}

/**
 * Return the least and the largest of numbers.
 * @param {...ArrayLike<number>} values
 * @returns {[number, number]}
 */
export function span(...values) {
  let [low, high] = [Infinity, -Infinity];
  for (const some of values) {
    for (let k = 0; k < some.length; k += 1) {
      if (some[k] < low) low = some[k];
      if (some[k] > high) high = some[k];
    }
  }
  return [low, high];
}
