// A diagram whose curves follow the sliders.
import { Figure } from "./figure.js";
import { Frame } from "./frame.js";

/** @typedef {import("./numbers.js").Column} Column */

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
  }

  /** Whether any of its curves follows the sliders. */
  get follows() {
    return this.curves.some((one) => one.made);
  }

  /** Go back to what the page was written with. */
  back() {
    for (const one of this.frames) one?.back();
    for (const one of this.curves) if (one.plot) one.back();
    if (this.moving.length) this.draw();
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
      if (frame?.moves) frame.fit(ends(drawn.map(({ x }) => x)), ends(drawn.map(({ y }) => y)));
      for (const { one, x, y, angles } of drawn) one.through(x, y, angles);
    });
    if (this.moving.length) this.draw();
  }
}

/**
 * Return the least and the largest of numbers.
 * @param {ArrayLike<number>[]} values
 * @returns {[number, number]}
 */
function ends(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const some of values) {
    for (let k = 0; k < some.length; k += 1) {
      if (some[k] < low) low = some[k];
      if (some[k] > high) high = some[k];
    }
  }
  return [low, high];
}
