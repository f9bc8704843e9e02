// The calculation of a machine, carried out for what the sliders state: steps that the page was written with.
import { Cycle } from "./cycle.js";

/**
 * What is calculated with: edges of panels [deg], nodes and weights in each, crank angles of tables, places of angles
 * loop by loop and where angles earlier by each delay stand, functions of the crank angle by name or their numbers,
 * how many values, columns and functions of the angle are kept, rows of values and columns by key, and for each level
 * its reductions: word, row of the value, columns.
 * @typedef {{edges: number[], nodes: number[], weights: number[], rows: number[], order: number[], earlier: number[][],
 *   angles: ([string, number, number] | number[])[], sizes: [number, number, number], values: Record<string, number>,
 *   columns: Record<string, number>, reductions: [string, ...number[]][][]}} CalculationData
 */

/**
 * @typedef {(s: Float64Array, t: Float64Array, b: Float64Array, p: number[][], o: number[], n: number) => void} Loop
 * @typedef {{table: (q: number[][], t: Float64Array, n: number) => void,
 *   levels: {designs: (s: Float64Array) => void, loops: Loop[]}[]}} Steps
 */

export class Calculation {
  /**
   * @param {CalculationData} data
   * @param {Steps} steps
   */
  constructor(data, steps) {
    this.data = data;
    this.steps = steps;
    this.cycle = new Cycle(data.edges, data.nodes, data.weights);
    /** Crank angles: of nodes, an edge twice, then of the tables. */
    this.degrees = [...this.cycle.degrees, ...data.rows];
    this.nodes = this.cycle.degrees.length;
    const count = this.degrees.length;
    this.order = summed(data.order);
    this.earlier = data.earlier.map(summed);
    this.values = new Float64Array(data.sizes[0]);
    this.kept = new Float64Array(data.sizes[1] * count);
    /** Of columns that are reduced, what polynomials leave out. */
    this.leftOut = 0;
    this.table = new Float64Array(data.sizes[2] * count);
    steps.table(data.angles.map((one) => this.ofAngle(one)), this.table, count);
  }

  /**
   * Return a function of the crank angle at all angles.
   * @param {[string, number, number] | number[]} one
   * @returns {number[]}
   */
  ofAngle(one) {
    if (typeof one[0] === "number") return /** @type {number[]} */ (one);
    const [name, multiple, shift] = /** @type {[string, number, number]} */ (one);
    return this.degrees.map((degrees) => angleFunction(name, degrees * multiple + shift));
  }

  /**
   * Calculate everything for what the sliders state. [SI]
   * @param {number[]} design
   */
  run(design) {
    const count = this.degrees.length;
    this.values.set(design);
    this.steps.levels.forEach(({ designs, loops }, level) => {
      designs(this.values);
      for (const loop of loops) loop(this.values, this.table, this.kept, this.earlier, this.order, count);
      const reductions = this.data.reductions[level];
      if (!reductions.length) return;
      this.cycle.begin();
      for (const [words, row, ...columns] of reductions) {
        this.values[row] = this.cycle.reduced(words.split(" "), columns.map((one) => this.nodesOf(one)));
      }
      this.leftOut = Math.max(level ? this.leftOut : 0, this.cycle.leftOut);
    });
    // a design that is not as those that were compared
    const guard = this.data.values[""];
    if (guard !== undefined) this.leftOut = Math.max(this.leftOut, this.values[guard]);
  }

  /**
   * Return what was kept of a column at the nodes.
   * @param {number} row
   */
  nodesOf(row) {
    const start = row * this.degrees.length;
    return this.kept.subarray(start, start + this.nodes);
  }

  /**
   * Return a column at the further crank angles.
   * @param {number} row
   */
  rowsOf(row) {
    const count = this.degrees.length;
    return this.kept.subarray(row * count + this.nodes, (row + 1) * count);
  }
}

/** @param {number[]} steps */
function summed(steps) {
  let sum = 0;
  return steps.map((one) => (sum += one));
}

/**
 * Return a function of an angle, exact at every multiple of 90 degrees.
 * @param {string} name
 * @param {number} degrees
 */
function angleFunction(name, degrees) {
  if (name === "degrees") return degrees;
  if (name === "angle") return (degrees * Math.PI) / 180;
  const quarter = Math.round(degrees / 90);
  const rest = ((degrees - 90 * quarter) * Math.PI) / 180;
  const turn = ((quarter % 4) + 4) % 4;
  const [s, c] = [Math.sin(rest), Math.cos(rest)];
  const [sin, cos] = [[s, c], [c, -s], [-s, -c], [-c, s]][turn];
  if (name === "sin") return sin;
  if (name === "cos") return cos;
  // without cancellation where the sine comes near to one
  const small = (cos * cos) / (1 + Math.abs(sin));
  if (name === "one_minus_sin") return sin > 0 ? small : 1 - sin;
  if (name === "one_plus_sin") return sin < 0 ? small : 1 + sin;
  throw new Error(name);
}
