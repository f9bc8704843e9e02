// Extremes and integrals over the cycle: of polynomials through the nodes between the angles where laws break.

// how near to the top a place must be to be followed to its peak, of what a column spans
const NEAR_TOP = 0.05;
// of equal values, whatever rounding says, the first counts
const PLATEAU = 1e-13;
const EQUAL = 8 * Number.EPSILON;
const STEPS = 8;
// of the size of a column, what the mean of a root may miss; how often its panels are halved
const ROUNDING = 1e-12;
const HALVED = 40;

/** @typedef {{value: number, angle: number}} Peak */
/** @typedef {ArrayLike<number>} Column */

export class Cycle {
  /**
   * @param {number[]} edges of panels [deg]
   * @param {number[]} nodes from -1 to 1
   * @param {number[]} weights
   */
  constructor(edges, nodes, weights) {
    this.count = nodes.length;
    this.nodes = nodes;
    this.weights = weights;
    this.panels = edges.length - 1;
    /** @type {number[]} */
    this.degrees = [];
    this.half = new Float64Array(this.panels);
    this.middle = new Float64Array(this.panels);
    for (let panel = 0; panel < this.panels; panel += 1) {
      const [low, high] = [edges[panel], edges[panel + 1]];
      const [middle, half] = [(high + low) / 2, (high - low) / 2];
      this.degrees.push(low, ...nodes.slice(1, -1).map((one) => middle + half * one), high);
      this.half[panel] = (half * Math.PI) / 180;
      this.middle[panel] = (middle * Math.PI) / 180;
    }
    this.length = ((edges[this.panels] - edges[0]) * Math.PI) / 180;
    const last = this.count - 1;
    const at = nodes.map((one) => legendre(one, this.count + 1));
    /** What takes values at nodes to coefficients of Legendre polynomials. */
    this.toCoefficients = nodes.map((_, k) => nodes.map((_, i) => (k < last ? k + 0.5 : last / 2) * weights[i] * at[i][k]));
    /** Integrals of values at nodes from the left end of a panel to each node. */
    this.toIntegrals = nodes.map((x, i) =>
      nodes.map((_, j) => {
        let sum = this.toCoefficients[0][j] * (x + 1);
        for (let k = 1; k <= last; k += 1) sum += (this.toCoefficients[k][j] * (at[i][k + 1] - at[i][k - 1])) / (2 * k + 1);
        return sum;
      }),
    );
    /** @type {Map<string, Peak>} */
    this.found = new Map();
    /** What columns come to when a root is squared. @type {Map<number, Float64Array>} */
    this.smooth = new Map();
    this.leftOut = 0;
  }

  /** Forget what was found of the columns before. */
  begin() {
    this.found.clear();
    this.smooth.clear();
    this.leftOut = 0;
  }

  /**
   * Return a column, of a root its square, and look how far polynomials follow it.
   * @param {Float64Array} column
   * @param {boolean} isRoot
   */
  looked(column, isRoot) {
    const known = this.smooth.get(column.byteOffset);
    if (known) return known;
    const found = isRoot ? column.map((one) => one * one) : column;
    this.smooth.set(column.byteOffset, found);
    let [size, most] = [Number.MIN_VALUE, 0];
    for (let k = 0; k < found.length; k += 1) size = Math.max(size, Math.abs(found[k]));
    const last = this.toCoefficients.slice(-2);
    for (let panel = 0; panel < this.panels; panel += 1) {
      let rest = 0;
      for (const row of last) {
        let sum = 0;
        for (let i = 0; i < this.count; i += 1) sum += row[i] * found[panel * this.count + i];
        rest += Math.abs(sum);
      }
      most = Math.max(most, rest);
    }
    const rest = most / size;
    // where a machine cannot be assembled there is nothing to follow
    this.leftOut = Number.isNaN(rest) ? Infinity : Math.max(this.leftOut, rest);
    return found;
  }

  /**
   * Return what columns come to over the cycle.
   * @param {string[]} words what is wanted, and whether the first is a root
   * @param {Float64Array[]} columns
   * @returns {number}
   */
  reduced([word, root], columns) {
    const column = columns[0];
    const smooth = this.looked(column, Boolean(root));
    switch (word) {
      case "integral":
        return this.integral(column);
      case "mean": {
        const mean = (root ? this.integralOfRoot(smooth) : this.integral(column)) / this.length;
        const size = column.reduce((most, one) => Math.max(most, Math.abs(one)), 0);
        // what rounding leaves of nothing is nothing
        return Math.abs(mean) <= PLATEAU * size ? 0 : mean;
      }
      case "range": {
        const work = this.work(column);
        return this.largest(work, 1).value + this.largest(work, -1).value;
      }
      case "tangents":
        return this.tangents(columns);
    }
    const [kind, angle] = word.split("_");
    const sign = kind === "max" ? 1 : -1;
    const key = `${sign} ${column.byteOffset}`;
    const peak = this.found.get(key) ?? this.largest(smooth, sign);
    this.found.set(key, peak);
    if (angle) return peak.angle;
    return root ? Math.sqrt(Math.max(sign * peak.value, 0)) : sign * peak.value;
  }

  /**
   * Return a column at a crank angle, by the polynomial there. [deg]
   * @param {Column} column
   * @param {number} degrees
   */
  at(column, degrees) {
    const angle = (degrees * Math.PI) / 180;
    let panel = this.middle.findIndex((one, k) => angle <= one + this.half[k] * (1 + 1e-12));
    if (panel < 0) panel = this.panels - 1;
    return evaluated(this.coefficients(column, panel), (angle - this.middle[panel]) / this.half[panel])[0];
  }

  /** @param {Column} column */
  integral(column) {
    let sum = 0;
    for (let panel = 0; panel < this.panels; panel += 1) {
      let inner = 0;
      for (let i = 0; i < this.count; i += 1) inner += this.weights[i] * column[panel * this.count + i];
      sum += this.half[panel] * inner;
    }
    return sum;
  }

  /**
   * Return the integral of a column that is a root, by its square, which has no corner where it vanishes.
   * @param {Float64Array} squares
   */
  integralOfRoot(squares) {
    const limit = ROUNDING * Math.sqrt(squares.reduce((most, one) => Math.max(most, one), 0));
    let sum = 0;
    for (let panel = 0; panel < this.panels; panel += 1) {
      sum += 2 * this.half[panel] * this.meanOfRoot(this.coefficients(squares, panel), limit, -1, 1, 0);
    }
    return sum;
  }

  /**
   * Return the share of a part of a panel in the mean of the root of a polynomial.
   * @param {Float64Array} square
   * @param {number} limit
   * @param {number} low
   * @param {number} high
   * @param {number} cut
   * @returns {number}
   */
  meanOfRoot(square, limit, low, high, cut) {
    const [middle, half] = [(low + high) / 2, (high - low) / 2];
    const roots = this.nodes.map((one) => Math.sqrt(Math.max(evaluated(square, middle + half * one)[0], 0)));
    const fitted = this.coefficients(roots, 0);
    const rest = Math.abs(fitted[this.count - 1]) + Math.abs(fitted[this.count - 2]);
    // of lengths that no machine has nothing is a number
    if (!(rest * half > limit) || cut === HALVED) return half * fitted[0];
    return this.meanOfRoot(square, limit, low, middle, cut + 1) + this.meanOfRoot(square, limit, middle, high, cut + 1);
  }

  /**
   * Return the integral of a column from the start of the cycle to each node.
   * @param {Column} column
   * @param {number} less what is taken away from it
   */
  running(column, less) {
    const found = new Float64Array(column.length);
    let before = 0;
    for (let panel = 0; panel < this.panels; panel += 1) {
      const start = panel * this.count;
      for (let i = 0; i < this.count; i += 1) {
        let sum = 0;
        for (let j = 0; j < this.count; j += 1) sum += this.toIntegrals[i][j] * (column[start + j] - less);
        found[start + i] = before + this.half[panel] * sum;
      }
      before = found[start + this.count - 1];
    }
    return found;
  }

  /**
   * Return the integral of a column about its mean.
   * @param {Column} column
   */
  work(column) {
    return this.running(column, this.integral(column) / this.length);
  }

  /**
   * Return what tangents of the mass-energy curve cut off its axis; the work of a load is negative.
   * @param {Float64Array[]} columns torque, reduced inertia, slopes of either tangent
   */
  tangents([torque, inertia, upper, lower]) {
    const work = this.work(torque);
    const above = work.map((one, k) => -one - upper[k] * inertia[k]);
    const below = work.map((one, k) => one + lower[k] * inertia[k]);
    return this.largest(above, 1).value + this.largest(below, 1).value;
  }

  /**
   * Return the coefficients of the polynomial in a panel.
   * @param {Column} column
   * @param {number} panel
   */
  coefficients(column, panel) {
    const found = new Float64Array(this.count);
    for (let k = 0; k < this.count; k += 1) {
      const row = this.toCoefficients[k];
      let sum = 0;
      for (let i = 0; i < this.count; i += 1) sum += row[i] * column[panel * this.count + i];
      found[k] = sum;
    }
    return found;
  }

  /**
   * Return the largest of a column, or of what it is below zero: at a node, or on the polynomial beside it.
   * @param {Column} column
   * @param {number} sign
   * @returns {Peak}
   */
  largest(column, sign) {
    let [top, least] = [-Infinity, Infinity];
    for (let k = 0; k < column.length; k += 1) {
      const value = sign * column[k];
      if (!Number.isFinite(value)) return { value: NaN, angle: NaN };
      if (value > top) top = value;
      if (value < least) least = value;
    }
    const near = top - NEAR_TOP * (top - least);
    const unsure = EQUAL * Math.max(Math.abs(top), Math.abs(least));
    /** @type {Peak[]} */
    const found = [];
    for (let panel = 0; panel < this.panels; panel += 1) {
      const start = panel * this.count;
      for (let i = 0; i < this.count; i += 1) {
        const value = sign * column[start + i];
        if (!(value >= near)) continue;
        const before = i > 0 ? sign * column[start + i - 1] : -Infinity;
        const after = i < this.count - 1 ? sign * column[start + i + 1] : -Infinity;
        if (before > value || after > value) continue;
        // a level stretch has nothing beside its nodes
        const isLevel = (before === value || i === 0) && (after === value || i === this.count - 1);
        found.push(isLevel ? this.node(value, panel, i) : this.peak(column, sign, panel, i, unsure));
      }
    }
    const best = found.reduce((most, one) => Math.max(most, one.value), -Infinity);
    const enough = best - PLATEAU * (Math.abs(best) + best - least);
    const first = found.filter((one) => one.value >= enough).reduce((a, b) => (b.angle < a.angle ? b : a));
    return { ...first, value: best };
  }

  /**
   * Return the peak beside a node.
   * @param {Column} column
   * @param {number} sign
   * @param {number} panel
   * @param {number} i
   * @param {number} unsure
   * @returns {Peak}
   */
  peak(column, sign, panel, i, unsure) {
    const polynomial = this.coefficients(column, panel);
    let [low, high, u] = [this.nodes[Math.max(i - 1, 0)], this.nodes[Math.min(i + 1, this.count - 1)], this.nodes[i]];
    for (let step = 0; step < STEPS; step += 1) {
      const [, slope, bend] = evaluated(polynomial, u).map((one) => sign * one);
      if (slope > 0) low = u;
      else high = u;
      const moved = u - slope / bend;
      if (bend < 0 && moved >= low && moved <= high) u = moved;
      else if (slope !== 0) u = (low + high) / 2;
    }
    const atNode = sign * column[panel * this.count + i];
    const atPeak = sign * evaluated(polynomial, u)[0];
    // at the end of a panel the column itself counts, and where only rounding tells a peak from it
    const isNode = atNode >= atPeak - unsure;
    if (isNode) return this.node(atNode, panel, i);
    return { value: atPeak, angle: this.middle[panel] + this.half[panel] * u };
  }

  /**
   * Return a node as a peak.
   * @param {number} value
   * @param {number} panel
   * @param {number} i
   * @returns {Peak}
   */
  node(value, panel, i) {
    return { value, angle: this.middle[panel] + this.half[panel] * this.nodes[i] };
  }
}

/**
 * Return the first Legendre polynomials at a place.
 * @param {number} x
 * @param {number} count
 */
function legendre(x, count) {
  const found = [1, x];
  for (let k = 1; k + 1 < count; k += 1) found.push(((2 * k + 1) * x * found[k] - k * found[k - 1]) / (k + 1));
  return found;
}

/**
 * Return a polynomial at a place, its slope and its bend.
 * @param {Column} coefficients
 * @param {number} u
 * @returns {[number, number, number]}
 */
function evaluated(coefficients, u) {
  let [p, q, p1, q1, p2, q2] = [1, u, 0, 1, 0, 0];
  let [value, slope, bend] = [coefficients[0] + coefficients[1] * u, coefficients[1], 0];
  for (let k = 1; k + 1 < coefficients.length; k += 1) {
    const next = ((2 * k + 1) * u * q - k * p) / (k + 1);
    const next1 = p1 + (2 * k + 1) * q;
    const next2 = p2 + (2 * k + 1) * q1;
    [p, p1, p2, q, q1, q2] = [q, q1, q2, next, next1, next2];
    value += coefficients[k + 1] * q;
    slope += coefficients[k + 1] * q1;
    bend += coefficients[k + 1] * q2;
  }
  return [value, slope, bend];
}
