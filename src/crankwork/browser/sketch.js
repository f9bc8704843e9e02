// A linkage drawn with the mouse, or by keys: a chain of pins from ground to ground, the first link of which drives.
import { fixed } from "./numbers.js";
import { shape } from "./shape.js";

/** @typedef {{name: string, x: number, y: number, ground?: boolean, slides?: number}} Pin */
/** A link keeps its name as long as it is there. @typedef {{name: string, pins: string[]}} Link */
/** What was typed of a length and a direction, as the calculation reads it. @typedef {{length?: number, angle?: number, refusal?: string}} Measured */

const WIDE = 240;
const TALL = 180;
// from what is drawn to the edge of the paper, where that grows [mm]
const EDGE = 25;
// how near a pin is meant [mm]
const NEAR_PIN = 5;
// what is moved less is clicked [mm]
const STILL = 1;
// a second press that belongs to a double click [ms]
const TWICE = 450;
const LETTERS = "ABCDEFGHIJKLMNPQRSTUVWXYZ";

export class Sketch {
  /**
   * @param {HTMLElement} room
   * @param {Record<string, string>} words
   * @param {{drawn: (pins: Pin[], links: Link[]) => void, asked: (pins: Pin[], links: Link[], typed: string[]) => void,
   *   said: (text: string, at: DOMPoint | undefined, up: boolean) => void}} tells
   * @param {Set<string>} taken names that the file has
   */
  constructor(room, words, tells, taken) {
    this.words = words;
    this.tells = tells;
    this.taken = taken;
    /** @type {Pin[]} */
    this.pins = [];
    /** @type {Link[]} */
    this.links = [];
    /** The pin that the next click goes on from. @type {Pin | undefined} */
    this.last = undefined;
    /** Where the pointer is. */
    this.at = [WIDE / 2, TALL / 2];
    /** What was typed of a length and of a direction, and which of them is being typed. */
    this.typed = ["", ""];
    this.part = 0;
    /** @type {Measured | undefined} */
    this.measured = undefined;
    /** What is to be done once it is known what was typed, and where the pointer was. @type {{what: "click" | "end", at: number[]}[]} */
    this.waits = [];
    /** The link that is pressed, from which a point is drawn off. @type {Link | undefined} */
    this.pressed = undefined;
    /** When and where was pressed last. */
    this.before = [0, 0, 0];
    /** The pin that is held, and where it was pressed. @type {Pin | undefined} */
    this.moved = undefined;
    /** The pin that keys carry. @type {Pin | undefined} */
    this.carried = undefined;
    this.from = this.at;
    /** The paper: left, top, width and height. [mm] */
    this.paper = [0, 0, WIDE, TALL];
    this.svg = shape("svg", { viewBox: this.paper.join(" "), class: "drawing sketch", role: "application", "aria-label": words.sketch });
    this.svg.tabIndex = 0;
    this.missing = document.createElement("output");
    this.missing.className = "missing";
    room.replaceChildren(this.svg, this.missing);
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
   * @param {Link[]} links
   */
  take(pins, links) {
    this.pins = pins;
    this.links = links;
    this.changed();
  }

  /** Draw what has changed, and ask what it is. */
  changed() {
    this.measured = undefined;
    this.fit();
    this.draw();
    this.tells.asked(this.pins, this.links, this.typed);
  }

  /** Let the paper grow until all that is drawn is on it. */
  fit() {
    const [left, top, width, height] = this.paper;
    const x = [this.at[0], ...this.pins.map((one) => one.x)];
    const y = [this.at[1], ...this.pins.map((one) => one.y)];
    const isOn = Math.min(...x) >= left && Math.max(...x) <= left + width && Math.min(...y) >= top && Math.max(...y) <= top + height;
    if (isOn) return;
    const [start, end] = [Math.min(left, ...x.map((one) => one - EDGE)), Math.max(left + width, ...x.map((one) => one + EDGE))];
    const [high, low] = [Math.min(top, ...y.map((one) => one - EDGE)), Math.max(top + height, ...y.map((one) => one + EDGE))];
    this.paper = [start, high, end - start, low - high];
    this.svg.setAttribute("viewBox", this.paper.join(" "));
  }

  /**
   * Hear what the sketch is as far as it goes, and what was typed.
   * @param {import("./talk.js").Answer} answer
   * @param {string[]} typed
   */
  heard(answer, typed) {
    this.missing.textContent = answer.missing ?? "";
    if (String(typed) === String(this.typed)) this.measured = answer.measured ?? {};
    if (this.measured) {
      const waited = this.waits;
      this.waits = [];
      for (const { what, at } of waited) {
        this.at = at;
        if (what === "end") this.end();
        else this.click();
      }
    }
    this.draw();
  }

  /** Where the next pin comes to stand: at what was typed, else where the pointer is. */
  target() {
    const { last, measured, at } = this;
    if (!last || !this.isTyped || !measured || measured.refusal) return at;
    const way = measured.angle === undefined ? Math.atan2(at[1] - last.y, at[0] - last.x) : (-measured.angle * Math.PI) / 180;
    const length = measured.length ?? Math.hypot(at[0] - last.x, at[1] - last.y);
    return [last.x + length * Math.cos(way), last.y + length * Math.sin(way)];
  }

  get isTyped() {
    return this.typed.some(Boolean);
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
    const [when, x, y] = this.before;
    this.before = [event.timeStamp, ...this.at];
    if (event.timeStamp - when < TWICE && Math.hypot(this.at[0] - x, this.at[1] - y) < STILL) return;
    const pin = this.near();
    // a pin that stands there is moved, or begun from where it is let go at once
    this.moved = this.last ? undefined : pin;
    this.from = this.at;
    this.pressed = pin || this.isTyped ? undefined : this.nearLink();
    if (!this.pressed && !this.moved) this.click();
    this.svg.setPointerCapture(event.pointerId);
    this.svg.focus();
  }

  /** @param {PointerEvent} event */
  point(event) {
    this.place(event);
    if (this.moved && this.apart() > STILL) [this.moved.x, this.moved.y] = this.at;
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
      const isClick = this.apart() <= STILL;
      this.moved = undefined;
      if (isClick) this.click();
      else if (this.links.length) this.tells.drawn(this.pins, this.links);
      return;
    }
    if (!this.pressed) return;
    const link = this.pressed;
    this.pressed = undefined;
    if (this.apart() > STILL) this.addPoint(link);
    else if (this.last) this.click();
    else {
      // a chain goes on from a pin of this link
      this.last = this.add(false);
      link.pins.push(this.last.name);
      this.changed();
    }
  }

  /**
   * Put a point of a link where the pointer is.
   * @param {Link} link
   */
  addPoint(link) {
    link.pins.push(this.add(false).name);
    this.changed();
    if (!this.last) this.tells.drawn(this.pins, this.links);
  }

  /** Put a pin where the pointer is, or take the one that is there, and join it to the one before. */
  click() {
    const { isTyped, last: before } = this;
    if (isTyped && this.waitsFor("click")) return;
    this.at = this.target();
    this.forget();
    const there = this.near(isTyped ? STILL : NEAR_PIN);
    if (there && there === before) return;
    const pin = there ?? this.add(!before);
    if (before) this.links.push({ name: String(this.free()), pins: [before.name, pin.name] });
    this.last = pin;
    if (there && before && this.links.length > 1) this.finish();
    else this.changed();
  }

  /**
   * Return whether something has to wait until it is known what was typed, or cannot be done as that is refused.
   * @param {"click" | "end"} what
   */
  waitsFor(what) {
    if (!this.measured) this.waits.push({ what, at: this.at });
    return !this.measured || Boolean(this.measured.refusal);
  }

  /** Forget what was typed. */
  forget() {
    this.typed = ["", ""];
    this.part = 0;
    this.waits = [];
  }

  /** Return the number of a link that no link ever had. */
  free() {
    const numbers = [...this.taken, ...this.links.map(({ name }) => name)].map(Number).filter(Number.isInteger);
    return Math.max(0, ...numbers) + 1;
  }

  /** End a chain: its last pin stands on the ground. */
  end() {
    if (this.isTyped) {
      if (this.waitsFor("end")) return;
      this.click();
    }
    if (!this.last) return;
    this.last.ground = true;
    this.finish();
  }

  finish() {
    this.last = undefined;
    this.changed();
    this.tells.drawn(this.pins, this.links);
  }

  /** @param {boolean} ground */
  add(ground) {
    const used = new Set([...this.taken, ...this.pins.map(({ name }) => name)]);
    const free = ground && !used.has("O") ? "O" : [...LETTERS].find((one) => !used.has(one)) ?? `P${this.pins.length}`;
    const pin = { name: free, x: this.at[0], y: this.at[1], ground };
    this.pins.push(pin);
    return pin;
  }

  near(reach = NEAR_PIN) {
    return this.pins.find(({ x, y }) => Math.hypot(x - this.at[0], y - this.at[1]) < reach);
  }

  nearLink() {
    return this.links.find(({ pins: [one, other] }) => {
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
    if (moves[event.key]) {
      this.at = this.at.map((one, k) => one + moves[event.key][k]);
      if (this.carried) [this.carried.x, this.carried.y] = this.at;
      this.fit();
    } else if (this.carried && /^(m|enter|escape)$/i.test(event.key)) this.lay(event.key === "Escape");
    else if (pin && !this.last && /^m$/i.test(event.key)) [this.carried, this.from] = [pin, [pin.x, pin.y]];
    else if (event.key === "Enter") {
      const ends = event.ctrlKey || (pin && pin === this.last && !this.isTyped);
      if (!ends || (!this.isTyped && pin !== this.last)) this.click();
      if (ends) this.end();
    } else if (this.last && this.types(event, pin)) this.changed();
    else if (event.key === "Delete" && pin && !this.last) this.without(pin);
    else if (["Escape", "Backspace", "Delete"].includes(event.key) || (event.ctrlKey && event.key === "z")) this.back();
    else if (pin && /^[gs]$/i.test(event.key)) this.change(pin, event.key.toLowerCase());
    else if (/^p$/i.test(event.key) && this.links.length) this.addPoint(this.nearLink() ?? this.links[this.links.length > 1 ? 1 : 0]);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.draw();
  }

  /**
   * Let the pin that keys carry stand where it is, or where it was.
   * @param {boolean} back
   */
  lay(back) {
    const pin = /** @type {Pin} */ (this.carried);
    this.carried = undefined;
    if (back) [pin.x, pin.y] = this.at = this.from;
    else if (this.links.length) this.tells.drawn(this.pins, this.links);
  }

  /**
   * Take a key as part of a length or a direction, a letter too that does nothing else; return whether it is one.
   * @param {KeyboardEvent} event
   * @param {Pin | undefined} pin where the cross stands
   */
  types({ key, ctrlKey, metaKey, shiftKey }, pin) {
    const { typed, part } = this;
    if (ctrlKey || metaKey) return false;
    const acts = (pin && /^[gs]$/i.test(key)) || (this.links.length > 0 && /^p$/i.test(key));
    if (this.isTyped && key === "Tab" && !shiftKey) this.part = 1 - part;
    else if (this.isTyped && key === "Escape") this.forget();
    else if (this.isTyped && key === "Backspace") typed[part] = typed[part].slice(0, -1);
    else if (key.length === 1 && (this.isTyped || this.part || (!acts && /[\p{L}\d.,+-]/u.test(key)))) typed[part] += key;
    else return false;
    return true;
  }

  /**
   * Let a pin stand on the ground or slide along the way from the pin before, or neither.
   * @param {Pin} pin
   * @param {string} kind
   */
  change(pin, kind) {
    if (kind === "s" && this.drives(pin)) return;
    if (kind === "g") pin.ground = !pin.ground;
    else {
      const [origin] = this.pins;
      const across = Math.abs(pin.x - origin.x) >= Math.abs(pin.y - origin.y);
      pin.slides = pin.slides === undefined ? (across ? 0 : 90) : undefined;
      pin.ground = false;
    }
    if (this.last && kind === "s") return this.finish();
    this.changed();
    if (!this.last) this.tells.drawn(this.pins, this.links);
  }

  /**
   * Return whether a pin ends the first link, which drives and turns about the other end.
   * @param {Pin} pin
   */
  drives(pin) {
    return this.links.length > 0 && this.links[0].pins.includes(pin.name);
  }

  /**
   * Take a pin out, with the links that it leaves alone.
   * @param {Pin} pin
   */
  without(pin) {
    this.links = this.links.map(({ name, pins }) => ({ name, pins: pins.filter((one) => one !== pin.name) })).filter(({ pins }) => pins.length > 1);
    const held = this.held();
    this.pins = this.pins.filter((one) => one !== pin && held.has(one.name));
    this.changed();
    if (this.links.length) this.tells.drawn(this.pins, this.links);
  }

  /** Return the names of the pins that links join. */
  held() {
    return new Set(this.links.flatMap(({ pins }) => pins));
  }

  /** Take the last click back. */
  back() {
    if (this.last) {
      const pin = this.last;
      const link = this.links[this.links.length - 1];
      const [start, end] = link?.pins ?? [];
      const own = end === pin.name && this.links.pop();
      // a chain that went on from a link had a pin there
      if (!own) for (const { pins } of this.links) if (pins.indexOf(pin.name) > 1) pins.splice(pins.indexOf(pin.name), 1);
      if (!this.held().has(pin.name)) this.pins = this.pins.filter((one) => one !== pin);
      this.last = own && this.pins.length ? this.pin(start) : undefined;
    } else {
      // a link goes with the pins that it leaves alone
      this.links.pop();
      const held = this.held();
      this.pins = this.links.length ? this.pins.filter(({ name }) => held.has(name)) : [];
    }
    this.changed();
  }

  /** Say beside the pointer what the next click does. */
  tell() {
    const { last, words } = this;
    const near = this.near();
    if (last && this.isTyped) {
      const [length, angle] = this.typed.map((one, k) => (/^[-+\d.,]+$/.test(one) ? `${one}${[" mm", "°"][k]}` : one));
      return `${last.name}: ${[length, angle && `∠ ${angle}`].filter(Boolean).join(" ")} · ${this.measured?.refusal ?? words.sketch_typed}`;
    }
    if (!near && this.nearLink()) return words.sketch_point;
    if (!last) return near ? words.sketch_on : words.sketch_begin;
    if (near) return near === last ? (this.drives(near) ? words.sketch_drives : words.sketch_go) : words.sketch_join.replace("{of}", near.name);
    const [x, y] = [this.at[0] - last.x, last.y - this.at[1]];
    const of = `${last.name} ${fixed(Math.hypot(x, y), 1)} mm ∠ ${fixed((Math.atan2(y, x) * 180) / Math.PI, 0)}°`;
    return words.sketch_link.replace("{of}", of);
  }

  draw() {
    const lines = this.links.flatMap(({ pins }) => {
      const [start, ...others] = pins.map((name) => this.pin(name));
      return others.map((end) => line(start.x, start.y, end.x, end.y, "link"));
    });
    const [to, down] = this.target();
    if (this.last) lines.push(line(this.last.x, this.last.y, to, down, "next"));
    const pins = this.pins.flatMap((pin) => {
      const circle = shape("circle", { cx: pin.x, cy: pin.y, r: 2 });
      const name = shape("text", { x: pin.x + 3, y: pin.y - 3 });
      name.textContent = pin.name;
      const ground = shape("path", { d: `M${pin.x} ${pin.y}l-4 7h8z` });
      const guide = shape("path", { d: `M${pin.x - 7} ${pin.y + 4}h14M${pin.x - 5} ${pin.y - 3}h10v6h-10z`, transform: `rotate(${-(pin.slides ?? 0)} ${pin.x} ${pin.y})` });
      return [...(pin.ground ? [ground] : []), ...(pin.slides === undefined ? [] : [guide]), circle, name];
    });
    const [x, y] = this.at;
    const cross = shape("path", { d: `M${x - 3} ${y}h6M${x} ${y - 3}v6`, class: "cross" });
    this.svg.replaceChildren(...lines, ...pins, cross);
    const matrix = this.svg.getScreenCTM();
    // what is drawn from stays to be seen
    this.tells.said(this.tell(), matrix ? new DOMPoint(x, y).matrixTransform(matrix) : undefined, this.last !== undefined && this.last.y > y);
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
  return shape("line", { x1, y1, x2, y2, class: kind });
}
