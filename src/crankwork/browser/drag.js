// Two drags of the machine, never confused: along its freedom, and, with Shift held, of a dimension.
import { Limits, meant } from "./limits.js";

/** @typedef {import("./machine.js").Film} Film */
/** @typedef {import("./cursor.js").Cursor} Cursor */

/**
 * A dimension that is dragged: its field, the joints at its ends, its number and unit,
 * and the power of the distance by which the number goes.
 * @typedef {{key: string, from: string, to: string, power: number, number: number, unit: string}} Handle
 */

// from a point of the machine, where the pointer still means it [of its width]
const CLOSE = 0.08;
// parts of the way from frame to frame, and how many of them a move goes at most
const PARTS = 4;
const FARTHEST = 40;

export class Drag {
  /**
   * @param {HTMLElement} room where the machine stands
   * @param {Record<string, string>} words
   * @param {{film: () => Film | undefined, cursor: () => Cursor | undefined, handles: () => Handle[], dyads: () => import("./limits.js").Dyad[],
   *   near: (key: string) => void, sized: (key: string, value: string, ends: boolean) => string, said: (text: string) => void}} tells
   */
  constructor(room, words, tells) {
    this.room = room;
    this.limits = new Limits(words);
    this.tells = tells;
    /** @type {string} */
    this.part = "";
    /** In which sense the crank went last. */
    this.sense = 1;
    /** @type {{handle: Handle, at: [number, number], way: [number, number], length: number, text: string} | undefined} */
    this.size = undefined;
    /** From the screen to the drawing, as it was when the drag began. @type {DOMMatrix | undefined} */
    this.matrix = undefined;
    room.addEventListener("pointerdown", (event) => this.start(event));
    room.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) room.addEventListener(end, () => this.end());
  }

  /**
   * Return where an event lies on the drawing. [mm]
   * @param {MouseEvent} event
   * @returns {[number, number]}
   */
  place(event) {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.matrix);
    return [x, y];
  }

  /** @param {PointerEvent} event */
  start(event) {
    const film = this.tells.film();
    if (event.button || !film || !(/** @type {Element} */ (event.target)).closest("svg")) return;
    this.matrix = film.svg.getScreenCTM()?.inverse();
    const at = this.place(event);
    if (event.shiftKey) this.startSize(film, at);
    else this.startFreedom(film, at);
    if (!this.part && !this.size) return;
    event.preventDefault();
    // keys are for the machine from now on
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    this.room.setPointerCapture(event.pointerId);
    this.tells.cursor()?.stop();
  }

  /**
   * @param {Film} film
   * @param {[number, number]} at
   */
  startFreedom(film, at) {
    const now = film.frame(this.angle(film));
    let best = CLOSE * film.svg.viewBox.baseVal.width;
    for (const one of film.parts) {
      if (!/^(joint\.|link\.|side\.(piston|rod|crank))/.test(one.name) || !moves(one.tracks)) continue;
      const place = film.place(one.name, now);
      const apart = place ? Math.hypot(place[0] - at[0], place[1] - at[1]) : Infinity;
      if (apart < best) [best, this.part] = [apart, one.name];
    }
  }

  /**
   * @param {Film} film
   * @param {[number, number]} at
   */
  startSize(film, at) {
    this.size = this.handle(film, at);
    if (this.size) this.tells.near(this.size.handle.key);
  }

  /**
   * Return the dimension that is meant at a place of the drawing.
   * @param {Film} film
   * @param {[number, number]} at
   * @returns {typeof this.size}
   */
  handle(film, at) {
    const now = film.frame(this.angle(film));
    let [best, found] = [CLOSE * film.svg.viewBox.baseVal.width, /** @type {typeof this.size} */ (undefined)];
    for (const handle of this.tells.handles()) {
      const [from, to] = [handle.from, handle.to].map((one) => film.place(one, now));
      if (!from || !to) continue;
      const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
      // of links that meet the one is meant that ends there
      const apart = beside(at, from, to) + 0.02 * Math.hypot(to[0] - at[0], to[1] - at[1]);
      if (apart >= best || !length) continue;
      best = apart;
      found = { handle, at, way: [(to[0] - from[0]) / length, (to[1] - from[1]) / length], length, text: "" };
    }
    return found;
  }

  /** @param {PointerEvent} event */
  move(event) {
    const film = this.tells.film();
    if (!film) return;
    if (event.shiftKey && !event.buttons) {
      this.matrix = film.svg.getScreenCTM()?.inverse();
      const near = this.handle(film, this.place(event));
      if (near) this.tells.near(near.handle.key);
    }
    const at = this.place(event);
    if (this.size) this.resize(at);
    else if (this.part) this.turn(film, at);
  }

  /**
   * Follow the machine from where it is as long as that brings the part nearer to the pointer, on as it went last if
   * both ways do: where a path crosses itself, or a rocker stands still, it never jumps.
   * @param {Film} film
   * @param {[number, number]} at
   */
  turn(film, at) {
    const { angles, degrees, turns } = film.data;
    const now = film.frame(this.angle(film));
    const last = film.last;
    const step = (/** @type {number} */ by) => (turns ? (now + by + last) % last : Math.min(Math.max(now + by, 0), last));
    const apart = (/** @type {number} */ frame) => {
      const [x, y] = film.place(this.part, frame) ?? at;
      return Math.hypot(x - at[0], y - at[1]);
    };
    let nearest = now;
    for (const sense of [this.sense, -this.sense]) {
      let [best, frame] = [apart(now), now];
      for (let k = 1; k <= FARTHEST; k += 1) {
        const next = step((sense * k) / PARTS);
        const further = apart(next);
        if (further >= best) break;
        [best, frame] = [further, next];
      }
      if (frame === now) continue;
      [nearest, this.sense] = [frame, sense];
      break;
    }
    const first = Math.floor(nearest);
    const angle = angles[first] + (nearest - first) * ((angles[Math.min(first + 1, last)] ?? angles[first]) - angles[first]);
    this.tells.cursor()?.move(angle / degrees);
    const held = film.place(this.part, nearest);
    if (held) this.tells.said(this.limits.show(film, this.tells.dyads(), nearest, angle, this.sense, held, at));
  }

  /** @param {[number, number]} at */
  resize(at) {
    if (!this.size) return;
    const { handle, at: start, way, length } = this.size;
    const more = (at[0] - start[0]) * way[0] + (at[1] - start[1]) * way[1];
    const number = handle.number * Math.max(1 + more / length, 0.02) ** handle.power;
    const text = `${Number(number.toPrecision(3))}${handle.unit ? ` ${handle.unit}` : ""}`;
    if (text === this.size.text) return;
    this.size.text = text;
    const least = this.tells.sized(handle.key, text, false);
    this.tells.said(`${handle.key}: ${Number(handle.number.toPrecision(6))} → ${text}${least}`);
  }

  end() {
    if (!this.part && !this.size) return;
    if (this.size?.text) this.tells.sized(this.size.handle.key, this.size.text, true);
    this.tells.said("");
    this.limits.hide();
    this.part = "";
    this.size = undefined;
  }

  /** Return the dyad that is meant to go together the other way. */
  meant() {
    const film = this.tells.film();
    return film && meant(film, this.tells.dyads(), this.angle(film));
  }

  /** @param {Film} film */
  angle(film) {
    return (this.tells.cursor()?.at ?? 0) * film.data.degrees;
  }
}

/** @param {import("./machine.js").Tracks} tracks */
function moves(tracks) {
  return Array.isArray(tracks.x) || Array.isArray(tracks.y);
}

/**
 * Return how far a point lies from a line between two others.
 * @param {number[]} at
 * @param {number[]} from
 * @param {number[]} to
 */
function beside(at, from, to) {
  const [x, y] = [to[0] - from[0], to[1] - from[1]];
  const share = Math.min(Math.max(((at[0] - from[0]) * x + (at[1] - from[1]) * y) / (x * x + y * y || 1), 0), 1);
  return Math.hypot(at[0] - from[0] - share * x, at[1] - from[1] - share * y);
}
