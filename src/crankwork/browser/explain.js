// How a value came about: its formula, what was put in, and what that came from, as deep as the reader opens it.
import { firstFrom, fixed, nearest, printed, told, unpacked } from "./numbers.js";

/** @typedef {import("./numbers.js").Column} Column */
/** @typedef {import("./numbers.js").Packed} Packed */
/** @typedef {import("./cursor.js").Cursor} Cursor */

/**
 * A value that is remembered: symbol, name, formula in MathML, words in place of one, value as text or by rows, what it
 * was made of; the column of the tables that has it, and its numbers at other rows; laws with the angles where they end; another column with how much earlier, within which cycle; the angle
 * where it was found; where it is given, and the source of its formula.
 * `m`: where the calculation has it, what takes it to its unit, and that unit; `z`: the single value that is the angle where it is found.
 * @typedef {{s?: string, m?: [string, number, number, string], n?: string, f?: number, w?: string, t?: string, c?: Packed, o?: number[], p?: [number, number][], z?: string,
 *   k?: string, e?: [number, number][], y?: [number, number], a?: number, g?: string, q?: number}} Memory
 */

/**
 * @typedef {{nodes: Memory[], formulas: string[], keys: Record<string, number>, where: string,
 *   rows: number[], sources: string[]}} Memories
 */

export class Explanation {
  /**
   * @param {HTMLElement} room
   * @param {Memories} memories
   * @param {Record<string, Column>} tables
   * @param {string} axis symbol of what the tables go by
   * @param {Cursor} cursor
   */
  constructor(room, memories, tables, axis, cursor) {
    this.room = room;
    this.body = /** @type {HTMLElement} */ (room.querySelector(".body"));
    this.memories = memories;
    this.tables = tables;
    for (const node of memories.nodes) {
      if (node.k === undefined) continue;
      node.s ??= tables[node.k].symbol;
      node.n ??= tables[node.k].name;
    }
    this.axis = axis;
    this.cursor = cursor;
    /** What the sliders have made of the values. @type {import("./sliders.js").Live | undefined} */
    this.live = undefined;
    /** @type {Map<number, Column>} */
    this.columns = new Map();
    /** @type {number | undefined} */
    this.shown = undefined;
    this.row = -1;
    /** What is open, by the way to it. @type {Set<string>} */
    this.open = new Set();
    room.querySelector("button")?.addEventListener("click", () => this.close());
    room.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.close();
    });
    cursor.follow(() => {
      if (this.shown !== undefined && cursor.row !== this.row && this.varies(this.shown)) this.draw();
    });
  }

  /**
   * Show values as the sliders have made them.
   * @param {import("./sliders.js").Live} live
   */
  follow(live) {
    this.live = live.moved ? live : undefined;
    this.draw();
  }

  /** @param {string} key */
  explain(key) {
    const node = this.memories.keys[key];
    if (node === undefined) return;
    this.back = document.activeElement;
    this.shown = node;
    this.open.clear();
    this.room.hidden = false;
    this.draw();
    this.back?.scrollIntoView({ block: "nearest" });
    this.room.focus({ preventScroll: true });
  }

  close() {
    this.room.hidden = true;
    this.shown = undefined;
    if (this.back instanceof HTMLElement || this.back instanceof SVGElement) this.back.focus();
  }

  /** @param {number} id */
  varies(id) {
    const node = this.memories.nodes[id];
    return Boolean(node.c || node.k || node.p || node.y);
  }

  draw() {
    if (this.shown === undefined) return;
    this.row = this.cursor.row;
    const at = this.cursor.rows[this.row];
    this.body.replaceChildren(...this.parts(this.shown, at, "", true));
  }

  /**
   * Return what is said of a value at an angle.
   * @param {number} id
   * @param {number} at
   * @param {string} way
   * @param {boolean} named
   * @returns {Node[]}
   */
  parts(id, at, way, named = false) {
    const node = this.law(id, at);
    const found = [];
    if (named) found.push(element("p", `<b>${node.n ?? ""}</b>${this.varies(id) ? ` · ${this.axis} = ${this.angle(at)}` : ""}`));
    const formula = node.f === undefined ? "" : ` = <math>${this.memories.formulas[node.f]}</math>`;
    const source = node.q === undefined ? "" : this.memories.sources[node.q];
    const words = [node.w, node.g, source].filter(Boolean).join(" · ");
    // of what the sliders cannot make anew the file's value is told, pale
    const kind = this.live && !node.m && this.varies(id) ? "equation filed" : "equation";
    if (named || formula) found.push(element("p", `${node.s}${formula} = ${this.value(id, at)}`, kind));
    if (words) found.push(element("p", words, "words"));
    const list = document.createElement("ul");
    if (node.y) list.append(this.item(node.y[0], this.earlier(at, node.y[1]), `${way}/d`));
    const place = this.placeOf(node, at);
    for (const one of node.o ?? []) list.append(this.item(one, place, `${way}/${one}`));
    if (list.childElementCount) found.push(list);
    return found;
  }

  /**
   * Return where the operands of a value are looked at: where it was found, nowhere if the sliders have moved that unseen.
   * @param {Memory} node
   * @param {number} at
   */
  placeOf(node, at) {
    if (node.a === undefined || !this.live) return node.a ?? at;
    const { data, calculation } = this.live;
    const [factor, added] = data.values[node.z ?? ""] ?? [NaN, NaN];
    return calculation.values[data.calculation.values[node.z ?? ""]] * factor + added;
  }

  /**
   * Return a line for what a value was made of, which opens where that was made of something too.
   * @param {number} id
   * @param {number} at
   * @param {string} way
   */
  item(id, at, way) {
    const node = this.law(id, at);
    const item = document.createElement("li");
    const isLost = this.varies(id) && Number.isNaN(at);
    const where = this.varies(id) && !isLost && at !== this.cursor.rows[this.row] ? `(${this.angle(at)})` : "";
    const value = isLost ? "" : this.value(id, at);
    const line = `${node.s}${where}${value && ` = ${value}`}${node.n ? ` <span class="name">${node.n}</span>` : ""}`;
    const deep = node.f !== undefined || node.o?.length || node.y || node.w || node.g;
    if (!deep || isLost || (where && this.rowAt(at) === undefined)) {
      item.innerHTML = line;
      return item;
    }
    const details = document.createElement("details");
    details.append(element("summary", line));
    const fill = () => {
      if (details.childElementCount === 1) details.append(...this.parts(id, at, way));
    };
    details.open = this.open.has(way);
    if (details.open) fill();
    details.addEventListener("toggle", () => {
      if (details.open) {
        this.open.add(way);
        fill();
      } else this.open.delete(way);
    });
    item.append(details);
    return item;
  }

  /**
   * Return the law that holds of a value at an angle.
   * @param {number} id
   * @param {number} at
   * @returns {Memory}
   */
  law(id, at) {
    const node = this.memories.nodes[id];
    if (!node.p) return node;
    const law = node.p[Math.min(firstFrom(node.p.map(([end]) => end), at - 1e-9), node.p.length - 1)][1];
    const own = this.memories.nodes[law];
    return { ...own, s: node.s, n: node.n, c: node.c, k: node.k, e: node.e };
  }

  /**
   * Return a value with its unit, empty where the page has none.
   * @param {number} id
   * @param {number} at
   */
  value(id, at) {
    const node = this.memories.nodes[id];
    if (this.live && node.m) return this.calculated(this.live, node.m, at);
    if (node.t !== undefined) return node.t;
    if (node.k !== undefined) return this.listed(this.tables[node.k], node.e ?? [], at);
    if (!node.c) return "–";
    const column = this.columns.get(id) ?? unpacked(node.c);
    this.columns.set(id, column);
    const row = this.rowAt(at);
    return row === undefined ? "" : told(column, row);
  }

  /**
   * Return a value as the sliders have made it, with its unit.
   * @param {import("./sliders.js").Live} live
   * @param {[string, number, number, string]} made
   * @param {number} at
   */
  calculated(live, [key, factor, added, unit], at) {
    const { values, columns } = live.data.calculation;
    const row = nearest(this.cursor.rows, at);
    const isRow = Math.abs(this.cursor.rows[row] - at) < 1e-6;
    // of a machine that goes by time the nodes do not
    if (columns[key] !== undefined && !isRow && this.memories.where !== "°") return "";
    const beside = () => live.calculation.cycle.at(live.calculation.nodesOf(columns[key]), at);
    const value = columns[key] === undefined ? live.calculation.values[values[key]] : isRow ? live.rows(key)[row] : beside();
    return printed(value * factor + added) + (["", "°", "%"].includes(unit) ? "" : "\u00a0") + unit;
  }

  /**
   * Return a number of the tables, or one beside their rows.
   * @param {Column} column
   * @param {[number, number][]} beside
   * @param {number} at
   */
  listed(column, beside, at) {
    const row = nearest(this.cursor.rows, at);
    if (Math.abs(this.cursor.rows[row] - at) < 1e-6) return told(column, row);
    const one = beside.find(([row]) => Math.abs(this.memories.rows[row] - at) < 1e-6);
    return one ? told({ ...column, values: [one[1] / 10 ** column.decimals] }, 0) : "";
  }

  /**
   * Return the row at an angle, if there is one.
   * @param {number} at
   */
  rowAt(at) {
    const rows = this.memories.rows;
    const row = nearest(rows, at);
    return Math.abs(rows[row] - at) < 1e-6 ? row : undefined;
  }

  /**
   * @param {number} at
   * @param {number} by
   */
  earlier(at, by) {
    const cycle = this.cursor.rows[this.cursor.rows.length - 1];
    return (at - by + 2 * cycle) % cycle;
  }

  /** @param {number} at */
  angle(at) {
    const whole = Math.abs(at - Math.round(at)) < 1e-9;
    return `${fixed(at, whole ? 0 : 2)}${this.memories.where}`;
  }
}

/**
 * @param {string} name
 * @param {string} inside
 * @param {string} kind
 */
function element(name, inside, kind = "") {
  const made = document.createElement(name);
  made.innerHTML = inside;
  if (kind) made.className = kind;
  return made;
}
