// A diagram whose curves, or plans, follow the sliders.
import { Figure } from "./figure.js";
import { Frame, span } from "./frame.js";
import { ghostsOf } from "./pins.js";
import { printed } from "./numbers.js";
import { Plans } from "./plans.js";

/** @typedef {import("./numbers.js").Column} Column */

/**
 * A number in a legend: row, number, key of the single value it is, if any, factor and what is added that take this to its unit.
 * @typedef {[number, string, string, number, number]} Told
 */

export class FollowingFigure extends Figure {
  /**
   * @param {SVGSVGElement} svg
   * @param {import("./figure.js").FigureData} data
   * @param {Record<string, Column>} columns
   * @param {string} axis
   * @param {import("./cursor.js").Cursor} cursor
   */
  constructor(svg, data, columns, axis, cursor) {
    super(svg, data, columns, axis, cursor);
    this.frames = data.plots.map((plot, k) => {
      const group = /** @type {SVGGElement | null} */ (svg.querySelector(`g.frame[class$=" ${k}"]`));
      return group ? new Frame(group, plot) : undefined;
    });
    this.told = data.plots.flatMap(({ told: rows }) => (rows ?? []).flatMap((row) => toldIn(svg, row)));
    this.plans = data.plots.flatMap(({ upon }) => (upon ? [new Plans(svg, upon)] : []));
    /** Curves of variants that are pinned. @type {import("./pins.js").Ghost[]} */
    this.ghosts = [];
    /** What moves marks and numbers with the scales. @type {(() => void)[]} */
    this.loose = [];
  }

  /**
   * Let variants that are pinned stand behind the curves, in scales that hold both.
   * @param {import("./pins.js").Pinned[]} pins
   */
  haunt(pins) {
    this.ghosts = ghostsOf(this.svg, pins, this.data.plots);
    const haunted = new Set(this.ghosts.map(({ now }) => now));
    this.loose = this.data.plots.flatMap((plot) => (haunted.has(plot) ? looseOf(this.svg, plot) : []));
    this.stand();
  }

  /** Draw the graphs that variants stand on as they were written, in scales that hold these too. */
  stand() {
    for (const [k, plot] of this.data.plots.entries()) {
      const ghosts = this.ghosts.filter(({ now }) => now === plot);
      const { x, y } = plot;
      const frame = this.frames[k];
      if (!ghosts.length || !frame?.moves) continue;
      frame.fit(...held(ghosts, [x], [y]));
      if (plot.x === x && plot.y === y) continue;
      for (const one of this.curves.filter((other) => other.plot === plot)) {
        const values = one.values();
        one.through(values.x, values.y);
      }
    }
    this.settle();
  }

  /** Let what stands beside the curves be where the scales of now put it. */
  settle() {
    for (const one of this.ghosts) one.place();
    for (const move of this.loose) move();
    if (this.moving.length) this.draw();
  }

  /** Whether any of it lies between machines. */
  get between() {
    return this.curves.some((one) => one.made?.between);
  }

  /** Whether any of it follows the sliders. */
  get follows() {
    return this.plans.length > 0 || this.curves.some((one) => one.made);
  }

  /** Go back to what the page was written with. */
  back() {
    for (const one of this.frames) one?.back();
    for (const one of this.curves) if (one.plot) one.back();
    for (const one of this.plans) one.back();
    for (const one of this.told) one.back();
    this.stand();
  }

  /**
   * Draw the curves that follow the sliders, in scales that hold them, and the others where they are in these.
   * @param {import("./lines.js").Lines} lines
   */
  follow(lines) {
    this.data.plots.forEach((plot, k) => {
      const own = this.curves.filter((one) => one.plot === plot);
      if (!own.some((one) => one.made)) return;
      const drawn = own.map((one) => ({ one, ...(one.made ? lines.of(one, plot) : { ...one.values(), angles: undefined }) }));
      const frame = this.frames[k];
      const ghosts = this.ghosts.filter(({ now }) => now === plot);
      if (frame?.moves) frame.fit(...held(ghosts, drawn.map(({ x }) => x), drawn.map(({ y }) => y)));
      for (const { one, x, y, angles } of drawn) one.through(x, y, angles);
    });
    for (const one of this.plans) one.follow(lines.calculation);
    for (const one of this.told) one.write(lines.calculation);
    this.settle();
  }
}

/**
 * Return where a legend has a number, and what writes it.
 * @param {SVGSVGElement} svg
 * @param {Told} row
 */
function toldIn(svg, [row, stated, key, factor, added]) {
  const legend = svg.querySelectorAll("[data-curve=legend] + *")[row];
  if (!legend) return [];
  const walker = document.createTreeWalker(legend, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = /** @type {Text} */ (walker.currentNode);
    const text = node.data;
    if (!text.includes(stated)) continue;
    const write = (/** @type {import("./calculation.js").Calculation} */ { values, data }) => {
      const value = values[data.values[key]] * factor + added;
      node.data = text.replace(stated, key ? printed(Number(value.toPrecision(4)), 9) : "…");
    };
    return [{ write, back: () => (node.data = text) }];
  }
  return [];
}

/**
 * Return the ends of values with those of variants.
 * @param {import("./pins.js").Ghost[]} ghosts
 * @param {ArrayLike<number>[]} x
 * @param {ArrayLike<number>[]} y
 * @returns {[[number, number], [number, number]]}
 */
function held(ghosts, x, y) {
  return [span(...x, ...ghosts.map(({ curve }) => curve.reach[0])), span(...y, ...ghosts.map(({ curve }) => curve.reach[1]))];
}

/**
 * Return what moves each thing that stands within a graph beside its curves, a mark or a number, with the scales.
 * @param {SVGSVGElement} svg
 * @param {import("./curves.js").Plot} plot
 */
function looseOf(svg, plot) {
  const { box: [left, top, wide, tall], x: across, y: up } = plot;
  const others = [...svg.children].filter((one) => !one.matches("svg, g.frame, g.cursor, [data-curve], [data-curve=legend] + *, text.dh, .ghost-number"));
  return /** @type {SVGGraphicsElement[]} */ (others).flatMap((one) => {
    const { x, y, width, height } = one.getBBox();
    const [right, down] = [x + width / 2 - left, y + height / 2 - top];
    if (right < 0 || right > wide || down < 0 || down > tall) return [];
    const values = [across[0] + (right / wide) * (across[1] - across[0]), up[1] + (down / tall) * (up[0] - up[1])];
    const before = one.getAttribute("transform") ?? "";
    return () => {
      const to = [((values[0] - plot.x[0]) / (plot.x[1] - plot.x[0])) * wide, ((values[1] - plot.y[1]) / (plot.y[0] - plot.y[1])) * tall];
      one.setAttribute("transform", `translate(${to[0] - right} ${to[1] - down})${before}`);
    };
  });
}
