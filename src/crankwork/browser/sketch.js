// A linkage drawn with the mouse, or by keys: a chain of pins from ground to ground, the first link of which drives.

/** @typedef {{name: string, x: number, y: number, ground?: boolean, slides?: number}} Pin */

const SPACE = "http://www.w3.org/2000/svg";
const WIDE = 240;
const TALL = 180;
// how near a pin is meant [mm]
const NEAR_PIN = 5;
const LETTERS = "ABCDEFGHIJKLMNPQRSTUVWXYZ";

export class Sketch {
  /**
   * @param {HTMLElement} room
   * @param {Record<string, string>} words
   * @param {(pins: Pin[], links: string[][]) => void} drawn
   * @param {(text: string) => void} said
   */
  constructor(room, words, drawn, said) {
    this.words = words;
    this.drawn = drawn;
    this.said = said;
    /** @type {Pin[]} */
    this.pins = [];
    /** @type {string[][]} */
    this.links = [];
    /** The pin that the next click goes on from. @type {Pin | undefined} */
    this.last = undefined;
    /** Where the pointer is. */
    this.at = [WIDE / 2, TALL / 2];
    /** What was typed of a length. */
    this.typed = "";
    /** The link that is pressed, from which a point is drawn off. @type {string[] | undefined} */
    this.pressed = undefined;
    /** The pin that is held, and where it was pressed. @type {Pin | undefined} */
    this.moved = undefined;
    this.from = this.at;
    this.svg = document.createElementNS(SPACE, "svg");
    this.svg.setAttribute("viewBox", `0 0 ${WIDE} ${TALL}`);
    this.svg.setAttribute("class", "drawing sketch");
    this.svg.setAttribute("role", "application");
    this.svg.setAttribute("aria-label", words.sketch);
    this.svg.tabIndex = 0;
    room.replaceChildren(this.svg);
    this.svg.addEventListener("pointerdown", (event) => this.press(event));
    this.svg.addEventListener("pointermove", (event) => this.point(event));
    this.svg.addEventListener("pointerup", (event) => this.release(event));
    this.svg.addEventListener("dblclick", () => this.end());
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.draw();
  }

  /**
   * Take what was drawn before.
   * @param {Pin[]} pins
   * @param {string[][]} links
   */
  take(pins, links) {
    this.pins = pins;
    this.links = links;
    this.draw();
  }

  /** @param {PointerEvent} event */
  place(event) {
    const matrix = this.svg.getScreenCTM();
    const point = matrix ? new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()) : new DOMPoint();
    this.at = [point.x, point.y].map((one) => Math.round(one * 2) / 2);
  }

  /** @param {PointerEvent} event */
  press(event) {
    this.place(event);
    // a pin that stands there is moved, or begun from where it is let go at once
    this.moved = this.last ? undefined : this.near();
    this.from = this.at;
    this.pressed = this.last || this.moved ? undefined : this.nearLink();
    if (!this.pressed && !this.moved) this.click();
    this.svg.setPointerCapture(event.pointerId);
    this.svg.focus();
  }

  /** @param {PointerEvent} event */
  point(event) {
    this.place(event);
    if (this.moved && this.apart() > 1) [this.moved.x, this.moved.y] = this.at;
    this.draw();
  }

  /** How far the pointer is from where it was pressed. [mm] */
  apart() {
    return Math.hypot(this.at[0] - this.from[0], this.at[1] - this.from[1]);
  }

  /** @param {PointerEvent} event */
  release(event) {
    this.place(event);
    if (this.moved) {
      const isClick = this.apart() <= 1;
      this.moved = undefined;
      if (isClick) this.click();
      else if (this.links.length) this.drawn(this.pins, this.links);
      return;
    }
    if (!this.pressed) return;
    const link = this.pressed;
    this.pressed = undefined;
    const pin = this.add(false);
    link.push(pin.name);
    this.draw();
    this.drawn(this.pins, this.links);
  }

  /** Put a pin where the pointer is, or take the one that is there, and join it to the one before. */
  click() {
    const typed = this.last && Number.parseFloat(this.typed.replace(",", "."));
    if (this.last && typed) {
      const way = Math.atan2(this.at[1] - this.last.y, this.at[0] - this.last.x);
      this.at = [this.last.x + typed * Math.cos(way), this.last.y + typed * Math.sin(way)];
    }
    this.typed = "";
    const there = this.near();
    const before = this.last;
    if (there && there === before) return;
    const pin = there ?? this.add(!before);
    if (before) this.links.push([before.name, pin.name]);
    this.last = pin;
    if (there && before && this.links.length > 1) this.finish();
    this.draw();
  }

  /** End a chain: its last pin stands on the ground. */
  end() {
    if (!this.last) return;
    this.last.ground = true;
    this.finish();
  }

  finish() {
    this.last = undefined;
    this.draw();
    this.drawn(this.pins, this.links);
  }

  /** @param {boolean} ground */
  add(ground) {
    const used = new Set(this.pins.map(({ name }) => name));
    const free = ground && !used.has("O") ? "O" : [...LETTERS].find((one) => !used.has(one)) ?? `P${this.pins.length}`;
    const pin = { name: free, x: this.at[0], y: this.at[1], ground };
    this.pins.push(pin);
    return pin;
  }

  near() {
    return this.pins.find(({ x, y }) => Math.hypot(x - this.at[0], y - this.at[1]) < NEAR_PIN);
  }

  nearLink() {
    return this.links.find(([one, other]) => {
      const [start, end] = [this.pin(one), this.pin(other)];
      const [x, y] = [end.x - start.x, end.y - start.y];
      const share = ((this.at[0] - start.x) * x + (this.at[1] - start.y) * y) / (x * x + y * y);
      return share > 0 && share < 1 && Math.hypot(this.at[0] - start.x - share * x, this.at[1] - start.y - share * y) < NEAR_PIN;
    });
  }

  /** @param {string} name */
  pin(name) {
    return /** @type {Pin} */ (this.pins.find((one) => one.name === name));
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const by = event.shiftKey ? 1 : 5;
    const moves = /** @type {Record<string, number[]>} */ ({ ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] });
    const pin = this.near();
    if (moves[event.key]) this.at = this.at.map((one, k) => one + moves[event.key][k]);
    else if (event.key === "Enter") {
      if (pin !== this.last || !pin) this.click();
      if (event.ctrlKey || pin === this.last) this.end();
    } else if (event.key === "Backspace" && this.typed) this.typed = this.typed.slice(0, -1);
    else if (event.key === "Delete" && pin && !this.last) this.without(pin);
    else if (["Escape", "Backspace", "Delete"].includes(event.key) || (event.ctrlKey && event.key === "z")) this.back();
    else if (/^[\d.,]$/.test(event.key)) this.typed += event.key;
    else if (pin && /^[gs]$/i.test(event.key)) this.change(pin, event.key.toLowerCase());
    else if (/^p$/i.test(event.key) && this.links.length && !this.last) {
      const link = this.nearLink() ?? this.links[this.links.length > 1 ? 1 : 0];
      link.push(this.add(false).name);
      this.drawn(this.pins, this.links);
    } else return;
    event.preventDefault();
    event.stopPropagation();
    this.draw();
  }

  /**
   * Let a pin stand on the ground or slide along the way from the pin before, or neither.
   * @param {Pin} pin
   * @param {string} kind
   */
  change(pin, kind) {
    if (kind === "g") pin.ground = !pin.ground;
    else {
      const [origin] = this.pins;
      const across = Math.abs(pin.x - origin.x) >= Math.abs(pin.y - origin.y);
      pin.slides = pin.slides === undefined ? (across ? 0 : 90) : undefined;
      pin.ground = false;
    }
    if (!this.last) this.drawn(this.pins, this.links);
    else if (kind === "s") this.finish();
  }

  /**
   * Take a pin out, with the links that it leaves alone.
   * @param {Pin} pin
   */
  without(pin) {
    this.links = this.links.map((link) => link.filter((name) => name !== pin.name)).filter((link) => link.length > 1);
    const held = new Set(this.links.flat());
    this.pins = this.pins.filter((one) => one !== pin && held.has(one.name));
    if (this.links.length) this.drawn(this.pins, this.links);
  }

  /** Take the last click back. */
  back() {
    if (this.last) {
      const pin = this.last;
      const link = this.links[this.links.length - 1];
      if (link?.includes(pin.name)) this.links.pop();
      if (!this.links.some((one) => one.includes(pin.name))) this.pins = this.pins.filter((one) => one !== pin);
      this.last = link && this.pins.length ? this.pin(link[0] === pin.name ? link[1] : link[0]) : undefined;
    } else {
      // a link goes with the pins that it leaves alone
      this.links.pop();
      const held = new Set(this.links.flat());
      this.pins = this.links.length ? this.pins.filter(({ name }) => held.has(name)) : [];
    }
    this.draw();
  }

  /** Say beside the pointer what the next click does. */
  tell() {
    const near = this.near();
    if (this.last && this.typed) return `${this.last.name}: ${this.typed} mm`;
    if (!this.last) return near ? this.words.sketch_on : this.pins.length && this.nearLink() ? this.words.sketch_point : this.words.sketch_begin;
    const length = Math.hypot(this.at[0] - this.last.x, this.at[1] - this.last.y);
    return `${this.last.name}–${near?.name ?? ""} ${length.toPrecision(3)} mm · ${this.words.sketch_end}`;
  }

  draw() {
    const lines = this.links.flatMap((link) => {
      const [start, ...others] = link.map((name) => this.pin(name));
      return others.map((end) => line(start.x, start.y, end.x, end.y, "link"));
    });
    if (this.last) lines.push(line(this.last.x, this.last.y, this.at[0], this.at[1], "next"));
    const pins = this.pins.flatMap((pin) => {
      const circle = mark("circle", { cx: pin.x, cy: pin.y, r: 2 });
      const name = mark("text", { x: pin.x + 3, y: pin.y - 3 });
      name.textContent = pin.name;
      const ground = mark("path", { d: `M${pin.x} ${pin.y}l-4 7h8z` });
      const guide = mark("path", { d: `M${pin.x - 7} ${pin.y + 4}h14M${pin.x - 5} ${pin.y - 3}h10v6h-10z`, transform: `rotate(${-(pin.slides ?? 0)} ${pin.x} ${pin.y})` });
      return [...(pin.ground ? [ground] : []), ...(pin.slides === undefined ? [] : [guide]), circle, name];
    });
    const [x, y] = this.at;
    const cross = mark("path", { d: `M${x - 3} ${y}h6M${x} ${y - 3}v6`, class: "cross" });
    this.svg.replaceChildren(...lines, ...pins, cross);
    this.said(this.tell());
  }
}

/**
 * @param {number} x1
 * @param {number} y1
 * @param {number} x2
 * @param {number} y2
 * @param {string} kind
 */
function line(x1, y1, x2, y2, kind) {
  return mark("line", { x1, y1, x2, y2, class: kind });
}

/**
 * @param {string} kind
 * @param {Record<string, number | string>} where
 */
function mark(kind, where) {
  const made = document.createElementNS(SPACE, kind);
  for (const [name, value] of Object.entries(where)) made.setAttribute(name, String(value));
  return made;
}
