// Curves of diagrams as the calculation has them: the nodes that are drawn, over the crank angle or over each other.
import { mixed } from "./between.js";

/** @typedef {import("./curves.js").Curve} Curve */
/** @typedef {import("./curves.js").Plot} Plot */

// points of a curve at most
const MOST = 481;
// of a column, how far from its line a node is seen
const SEEN = 2e-3;
// of degrees that a curve tells by tenths, or by where it stands on paper, what is the same
const NEAR_END = 0.1;

export class Lines {
  /**
   * @param {import("./calculation.js").Calculation} calculation
   * @param {number} degrees what a unit of the scale across is, where that is what tables go by
   */
  constructor(calculation, degrees) {
    this.calculation = calculation;
    this.degrees = degrees;
    const { count, panels } = calculation.cycle;
    const gaps = count - 1;
    // both ends of each panel, and evenly many between them
    const by = [1, 3, 5, gaps].find((one) => gaps % one === 0 && panels * (gaps / one + 1) <= MOST) ?? gaps;
    this.places = Array.from({ length: panels * count }, (_, k) => k).filter((k) => (k % count) % by === 0);
    this.angles = this.places.map((k) => calculation.degrees[k]);
    /** What machines weigh that other curves lie between. @type {number[]} */
    this.weights = [];
    /** Which nodes are drawn between two crank angles. @type {Map<string, {inside: number[], at: number[], isCut: boolean}>} */
    this.known = new Map();
  }

  /**
   * Return the nodes that are drawn between two crank angles, their angles, and whether the last is no node.
   * @param {number} first
   * @param {number} last
   */
  between(first, last) {
    const key = `${first} ${last}`;
    const known = this.known.get(key);
    if (known) return known;
    const inside = this.places.filter((_, k) => this.angles[k] >= first - NEAR_END && this.angles[k] <= last + NEAR_END);
    const at = inside.map((one) => this.calculation.degrees[one]);
    const isCut = at[at.length - 1] < last - NEAR_END;
    if (isCut) at.push(last);
    const found = { inside, at, isCut };
    this.known.set(key, found);
    return found;
  }

  /**
   * Return the points of a curve as values of the scales of its graph, and their crank angles.
   * @param {Curve} curve
   * @param {Plot} plot
   * @returns {{x: number[], y: number[], angles: number[] | undefined}}
   */
  of(curve, plot) {
    const { calculation, degrees } = this;
    const { x, y, level, between } = /** @type {import("./curves.js").Made} */ (curve.made);
    if (between) {
      const across = between.x.length === 1 ? between.x[0] : mixed(between.x, this.weights);
      const found = { x: across, y: mixed(between.y, this.weights), angles: plot.over ? across : between.at };
      const { at } = between;
      const [first, last] = [curve.home.angles?.[0] ?? -Infinity, curve.home.angles?.at(-1) ?? Infinity];
      // a curve with gaps is drawn by its parts
      const inside = (/** @type {number[]} */ of) => (at.length ? of.filter((_, k) => at[k] > first - NEAR_END && at[k] < last + NEAR_END) : of);
      return { x: inside(found.x), y: inside(found.y), angles: inside(found.angles) };
    }
    if (level) {
      const value = calculation.values[calculation.data.values[level[0]]] * level[1];
      const { x: across } = curve.values();
      return { x: across, y: across.map(() => value), angles: undefined };
    }
    const angles = curve.home.angles ?? [];
    const [first, last] = plot.over ? [angles[0] * degrees, angles[angles.length - 1] * degrees] : [angles[0], angles[angles.length - 1]];
    const { inside, at, isCut } = this.bent(this.between(first, last), [x, y]);
    const up = this.column(y, inside, isCut, last);
    const across = x ? this.column(x, inside, isCut, last) : degrees === 1 ? at : at.map((one) => one / degrees);
    return { x: across, y: up, angles: plot.over ? across : at };
  }

  /**
   * Return nodes with those between them where a column bends away from the line between two.
   * @param {{inside: number[], at: number[], isCut: boolean}} nodes
   * @param {([string, number] | undefined)[]} made
   */
  bent(nodes, made) {
    const { calculation } = this;
    const { degrees } = calculation;
    const { inside } = nodes;
    /** @type {Set<number>} */
    const more = new Set();
    for (const one of made) {
      if (!one) continue;
      const values = calculation.nodesOf(calculation.data.columns[one[0]]);
      const within = SEEN * (inside.reduce((most, k) => Math.max(most, values[k]), -Infinity) - inside.reduce((least, k) => Math.min(least, values[k]), Infinity));
      for (let j = 1; j < inside.length; j += 1) {
        const [a, b] = [inside[j - 1], inside[j]];
        const rate = (values[b] - values[a]) / (degrees[b] - degrees[a] || 1);
        for (let k = a + 1; k < b; k += 1) {
          if (Math.abs(values[k] - values[a] - rate * (degrees[k] - degrees[a])) > within) more.add(k);
        }
      }
    }
    if (!more.size) return nodes;
    const every = [...inside, ...more].sort((a, b) => a - b);
    const at = every.map((k) => degrees[k]);
    return { inside: every, at: nodes.isCut ? [...at, nodes.at[nodes.at.length - 1]] : at, isCut: nodes.isCut };
  }

  /**
   * Return a column at some of the nodes that are drawn, and where the curve ends if that is none of them.
   * @param {[string, number] | undefined} made
   * @param {number[]} inside
   * @param {boolean} isCut
   * @param {number} last
   */
  column(made, inside, isCut, last) {
    const [key, factor] = made ?? ["", 1];
    const values = this.calculation.nodesOf(this.calculation.data.columns[key]);
    const found = inside.map((k) => values[k] * factor);
    if (isCut) found.push(this.calculation.cycle.at(values, last) * factor);
    return found;
  }
}
