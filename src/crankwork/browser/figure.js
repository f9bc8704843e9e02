// A diagram to read: cursor and dots, the numbers under them, zoom, curves shown and hidden by the legend.
import { Curve } from "./curves.js";
import { nearest, placeOf, told } from "./numbers.js";
import { shape } from "./shape.js";

/** @typedef {import("./curves.js").Plot} Plot */
/** @typedef {import("./cursor.js").Cursor} Cursor */
/** @typedef {import("./numbers.js").Column} Column */

/**
 * Graphs of a drawing, what each row of its legend tells of, names of curves, and what it shows in words; whether it
 * differs where sliders move, and cannot follow; where the cursor stands when a plan of one position is true, or places of
 * the cursor and what is drawn at each.
 * @typedef {{plots: Plot[], legend: string[][], told?: string, filed?: boolean, at?: number, places?: number[],
 *   shown?: string[]}} FigureData
 */

// from a curve, where the pointer still means it [mm]
const NEAR = 12;
// marks of extremes and means, which have their number beside them
const LEVELS = new Set(["max", "min", "mean", "m", "level_max", "level_min"]);

export class Figure {
  /**
   * @param {SVGSVGElement} svg
   * @param {FigureData} data
   * @param {Record<string, Column>} columns
   * @param {string} axis key of the column that the tables go by
   * @param {Cursor} cursor
   */
  constructor(svg, data, columns, axis, cursor) {
    this.svg = svg;
    this.data = data;
    this.columns = columns;
    this.axis = axis;
    this.cursor = cursor;
    const paths = /** @type {SVGPathElement[]} */ ([...svg.querySelectorAll("path[data-curve]")]);
    this.curves = paths.filter((one) => one.dataset.curve !== "legend").map((one) => new Curve(one, data.plots));
    this.moving = this.curves.filter((one) => one.angles);
    if (data.filed) svg.closest("figure")?.classList.add("filed");
    const { at } = data;
    // a plan is faint while the machine stands elsewhere, and a click takes the machine to it
    if (at !== undefined) {
      cursor.follow(() => svg.classList.toggle("apart", nearest(cursor.rows, at) !== cursor.row));
      svg.addEventListener("click", () => cursor.snap(at));
    }
    this.home = [svg.viewBox.baseVal.x, svg.viewBox.baseVal.y, svg.viewBox.baseVal.width, svg.viewBox.baseVal.height];
    // an image may hold nothing that is pressed
    svg.setAttribute("role", "group");
    if (data.told) svg.ariaLabel = data.told;
    this.legend();
    this.zoom();
    if (!this.moving.length) return;
    const layer = svg.appendChild(shape("g", { class: "cursor" }));
    this.layer = layer;
    this.lines = data.plots.map((plot) => (plot.over ? layer.appendChild(shape("line", { y1: plot.box[1], y2: plot.box[1] + plot.box[3] })) : null));
    this.dots = this.moving.map(() => layer.appendChild(shape("circle", { r: 1.1 })));
    this.reading = document.createElement("output");
    this.reading.className = "reading";
    this.reading.hidden = true;
    svg.after(this.reading);
    svg.addEventListener("pointermove", (event) => this.point(event));
    svg.addEventListener("pointerdown", (event) => this.point(event));
    for (const gone of ["pointerleave", "blur"]) svg.addEventListener(gone, () => this.tell(false));
    svg.addEventListener("focus", () => this.tell(true));
    svg.tabIndex = 0;
    cursor.follow(() => this.draw());
  }

  /**
   * Return an angle within a graph that shows fewer turns than the cycle has.
   * @param {Plot | undefined} plot
   */
  angleIn(plot) {
    const angle = this.cursor.at;
    if (!plot?.over || angle <= plot.x[1] || plot.x[0] !== 0 || plot.x[1] % 360) return angle;
    return angle % plot.x[1];
  }

  draw() {
    this.layer?.classList.toggle("fixed", this.cursor.fixed);
    this.data.plots.forEach((plot, k) => {
      const line = this.lines?.[k];
      if (!line) return;
      const share = (this.angleIn(plot) - plot.x[0]) / (plot.x[1] - plot.x[0]);
      const inside = share >= 0 && share <= 1;
      line.toggleAttribute("hidden", !inside);
      if (inside) for (const end of ["x1", "x2"]) line.setAttribute(end, String(plot.box[0] + share * plot.box[2]));
    });
    this.moving.forEach((curve, k) => {
      const place = curve.path.matches(".off") ? undefined : curve.place(this.angleIn(curve.plot));
      const dot = this.dots?.[k];
      dot?.toggleAttribute("hidden", !place);
      if (!place) return;
      dot?.setAttribute("cx", String(place[0]));
      dot?.setAttribute("cy", String(place[1]));
    });
    if (this.reading && !this.reading.hidden) this.read();
  }

  /** Write the numbers at the cursor: of columns those of the table, of other curves those of the scale. */
  read() {
    const { columns, cursor } = this;
    const axis = columns[this.axis];
    const parts = [`${axis.symbol} = ${cursor.beyond ? placeOf(cursor, axis) : told(axis, cursor.row)}`];
    /** @type {Set<string>} */
    const done = new Set();
    for (const curve of this.moving) {
      if (done.has(curve.name) || curve.path.matches(".off")) continue;
      const column = columns[curve.name];
      const place = curve.place(this.angleIn(curve.plot));
      if (column) {
        if (!cursor.beyond) parts.push(`${column.symbol} = ${told(column, cursor.row)}`);
      }
      else if (place && !LEVELS.has(curve.name)) parts.push(...curve.told(place, curve.plot?.over ? this.said(curve.name) : ""));
      else continue;
      done.add(curve.name);
    }
    if (this.reading) this.reading.innerHTML = parts.map((one) => `<span>${one}</span>`).join("");
  }

  /**
   * Return what the legend says of a curve.
   * @param {string} name
   */
  said(name) {
    const row = this.data.legend.findIndex((names) => names.includes(name));
    return row < 0 ? "" : textBeside(this.rows()[row])?.textContent ?? "";
  }

  rows() {
    return [...this.svg.querySelectorAll('path[data-curve="legend"]')];
  }

  /** @param {boolean} shown */
  tell(shown) {
    if (!this.reading) return;
    this.reading.hidden = !shown;
    if (shown) this.read();
  }

  /** @param {PointerEvent} event */
  point(event) {
    const at = this.place(event);
    const [width, height] = [this.home[2], this.home[3]];
    this.tell(at.x >= 0 && at.x <= width && at.y >= 0 && at.y <= height);
    const isPassing = event.type === "pointermove";
    // a machine that runs is not stopped in passing
    if (isPassing && (this.cursor.runs || (this.cursor.fixed && !event.buttons))) return;
    const angle = this.angleAt(at);
    if (angle === undefined) return;
    const before = this.cursor.at;
    this.cursor.snap(angle);
    if (isPassing) return;
    this.cursor.fixed = !this.cursor.fixed || this.cursor.at !== before;
    this.cursor.move(this.cursor.at);
  }

  /**
   * Return the crank angle that is meant at a place of the paper, if any.
   * @param {DOMPoint} at
   */
  angleAt(at) {
    const plot = this.data.plots.find(({ box: [left, top, wide, tall] }) => at.x >= left && at.x <= left + wide && at.y >= top && at.y <= top + tall);
    if (plot?.over) return plot.x[0] + ((at.x - plot.box[0]) / plot.box[2]) * (plot.x[1] - plot.x[0]);
    let [best, angle] = [NEAR, /** @type {number | undefined} */ (undefined)];
    for (const curve of this.moving) {
      if (curve.plot?.over || !curve.angles) continue;
      for (let k = 0; k < curve.x.length; k += 1) {
        const apart = Math.hypot(curve.x[k] - at.x, curve.y[k] - at.y);
        if (apart < best) [best, angle] = [apart, curve.angles[k]];
      }
    }
    return angle;
  }

  /**
   * Return where an event lies on the paper. [mm]
   * @param {MouseEvent} event
   */
  place(event) {
    const matrix = this.svg.getScreenCTM();
    return matrix ? new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()) : new DOMPoint();
  }

  /** Let each row of the legend show and hide its curves. */
  legend() {
    this.rows().forEach((row, k) => {
      const names = this.data.legend[k] ?? [];
      const own = this.curves.filter((one) => names.includes(one.name));
      const text = textBeside(row);
      if (!own.length || !(text instanceof SVGTextElement)) return;
      text.setAttribute("role", "button");
      text.setAttribute("tabindex", "0");
      text.ariaPressed = "true";
      const toggle = () => {
        const off = own[0].path.classList.contains("off");
        for (const one of this.svg.querySelectorAll("path[data-curve]")) if (names.includes(/** @type {SVGElement} */ (one).dataset.curve ?? "")) one.classList.toggle("off", !off);
        for (const one of [row, text]) one.classList.toggle("faint", !off);
        text.ariaPressed = String(off);
        this.draw();
      };
      text.addEventListener("click", toggle);
      text.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        event.stopPropagation();
        toggle();
      });
    });
  }

  /** Ctrl and wheel, or + and −, come nearer; dragging moves what is near; a double click or 0 goes back. */
  zoom() {
    const svg = this.svg;
    svg.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      const at = this.place(event);
      this.scale(event.deltaY > 0 ? 1.25 : 0.8, at.x, at.y);
    }, { passive: false });
    svg.addEventListener("dblclick", () => this.view(this.home));
    svg.addEventListener("keydown", (event) => {
      const [left, top, width, height] = this.now();
      const middle = /** @type {const} */ ([left + width / 2, top + height / 2]);
      if (event.key === "+" || event.key === "=") this.scale(0.8, ...middle);
      else if (event.key === "-") this.scale(1.25, ...middle);
      else if (event.key === "0") this.view(this.home);
      else return;
      event.preventDefault();
    });
    svg.addEventListener("pointermove", (event) => {
      const [left, top, width, height] = this.now();
      if (!event.buttons || width >= this.home[2]) return;
      const scale = width / svg.clientWidth;
      this.view([left - event.movementX * scale, top - event.movementY * scale, width, height]);
    });
  }

  now() {
    const { x, y, width, height } = this.svg.viewBox.baseVal;
    return [x, y, width, height];
  }

  /**
   * @param {number} by
   * @param {number} x
   * @param {number} y
   */
  scale(by, x, y) {
    const [left, top, width, height] = this.now();
    if (width * by >= this.home[2]) this.view(this.home);
    else if (width * by > this.home[2] / 40) this.view([x - (x - left) * by, y - (y - top) * by, width * by, height * by]);
  }

  /** @param {number[]} box */
  view(box) {
    this.svg.setAttribute("viewBox", box.map((one) => one.toFixed(3)).join(" "));
    this.svg.classList.toggle("near", box[2] < this.home[2]);
  }
}

/**
 * Return the text beside the sample of a legend.
 * @param {Element | undefined} row
 */
function textBeside(row) {
  const next = row?.nextElementSibling;
  return next instanceof SVGGElement ? next.firstElementChild : next;
}
