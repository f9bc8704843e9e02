// The machine as it moves, by the cursor or by itself.
import { shape } from "./shape.js";

/** @typedef {import("./cursor.js").Cursor} Cursor */

/**
 * A movement: a value for each frame, or one for all of them; as SVG counts, downward and clockwise.
 * @typedef {number | number[]} Track
 */

/** @typedef {{x: Track, y: Track, turn?: Track, stretch?: Track, tint?: Track}} Tracks */

/**
 * A film: crank angle of each frame, how many degrees a unit of the cursor is, whether the crank turns fully; values of
 * parts, or in brackets the number of a track: its values, or hundredths by their second differences.
 * @typedef {{angles: number[], degrees: number, turns: boolean, seconds: number, tracks: (string | number[])[],
 *   parts: Record<string, Record<string, number | [number]>>}} FilmData
 */

export class Film {
  /**
   * @param {SVGSVGElement} svg
   * @param {FilmData} data
   * @param {Cursor} cursor
   */
  constructor(svg, data, cursor) {
    this.data = data;
    this.svg = svg;
    const known = data.tracks.map(smooth);
    /** Where every part is, also those that stand still. @type {Map<string, Tracks>} */
    this.placed = new Map();
    this.parts = Object.entries(data.parts).flatMap(([name, own]) => {
      const values = Object.entries(own).map(([key, one]) => [key, Array.isArray(one) ? known[one[0]] : one]);
      const tracks = /** @type {Tracks} */ (Object.fromEntries(values));
      this.placed.set(name, tracks);
      const group = svg.querySelector(`[data-part="${CSS.escape(name)}"]`);
      return group && Object.values(tracks).some(Array.isArray) ? [{ name, group, tracks }] : [];
    });
    cursor.follow(() => this.draw(this.frame(cursor.at * data.degrees)));
  }

  /**
   * Return which frame shows a crank angle, the part of one after it as a fraction.
   * @param {number} angle
   */
  frame(angle) {
    const angles = this.data.angles;
    const last = this.last;
    const step = angles.findIndex((one, k) => k > 0 && k <= last && one >= angle);
    if (step < 0) return last;
    return step - 1 + Math.max(0, (angle - angles[step - 1]) / (angles[step] - angles[step - 1] || 1));
  }

  /** The last frame on the way there. */
  get last() {
    const angles = this.data.angles;
    return this.data.turns ? angles.length - 1 : angles.indexOf(Math.max(...angles));
  }

  /**
   * Return where a part is in a frame. [mm]
   * @param {string} name
   * @param {number} frame
   * @returns {[number, number] | undefined}
   */
  place(name, frame) {
    const part = this.placed.get(name);
    return part && [along(part.x, frame, 0), along(part.y, frame, 0)];
  }

  /** Draw the paths of joints; of an engine those of piston pins and of the middles of rods. */
  trace() {
    const place = (/** @type {Tracks} */ { x, y }, /** @type {number} */ k) => [x, y].map((one) => (Array.isArray(one) ? one[k] : one));
    const frames = this.data.angles.map((_, k) => k);
    this.traces = shape("g", { class: "traces" });
    for (const { name, tracks } of this.parts) {
      const pin = this.parts.find((one) => name.startsWith("side.rod.") && one.name === name.replace("rod", "piston"));
      if (!pin && !name.startsWith("joint.")) continue;
      const ways = pin ? [[tracks, pin.tracks], [pin.tracks, pin.tracks]] : [[tracks, tracks]];
      for (const [one, other] of ways) {
        const points = frames.map((k) => place(one, k).map((at, side) => ((at + place(other, k)[side]) / 2).toFixed(2)).join(" "));
        this.traces.append(shape("path", { d: `M${points.join("L")}` }));
      }
    }
    this.svg.append(this.traces);
  }

  /** @param {number} frame */
  draw(frame) {
    const at = (/** @type {Track | undefined} */ track, /** @type {number} */ usual) => along(track, frame, usual);
    for (const { group, tracks } of this.parts) {
      const [x, y, turn, stretch] = [at(tracks.x, 0), at(tracks.y, 0), at(tracks.turn, 0), at(tracks.stretch, 1)];
      group.setAttribute("transform", `translate(${x} ${y})rotate(${turn})scale(${stretch} 1)`);
      if (tracks.tint !== undefined) group.setAttribute("opacity", String(at(tracks.tint, 1)));
    }
  }
}

/**
 * Return the value of a track in a frame, or between two.
 * @param {Track | undefined} track
 * @param {number} frame
 * @param {number} usual
 */
function along(track, frame, usual) {
  if (!Array.isArray(track)) return track ?? usual;
  const first = Math.floor(frame);
  const next = track[Math.min(first + 1, track.length - 1)];
  return track[first] + (frame - first) * (next - track[first]);
}

/**
 * Return the values of a track.
 * @param {string | number[]} packed
 * @returns {number[]}
 */
export function smooth(packed) {
  if (Array.isArray(packed)) return packed;
  let [step, sum] = [0, 0];
  return packed.split(" ").map((one) => (sum += step += Number(one)) / 100);
}

/**
 * Bind what stands beneath the machine: which view and which forces are seen, how fast it runs, paths of points.
 * @param {Film} film
 * @param {Motion} motion
 */
export function choose(film, motion) {
  const { svg } = film;
  const [view, rate] = ["view", "rate"].map((id) => /** @type {HTMLSelectElement | null} */ (document.getElementById(id)));
  const close = svg.getAttribute("viewBox") ?? "";
  const boxes = /** @type {HTMLInputElement[]} */ ([...(svg.parentElement?.querySelectorAll("[data-choice]") ?? [])]);
  const see = () => {
    for (const { dataset, checked } of boxes) svg.querySelectorAll(`[data-part^="${dataset.choice}"]`).forEach((one) => one.classList.toggle("on", checked));
    const some = boxes.some(({ checked }) => checked);
    svg.querySelector('[data-part="force.scale"]')?.classList.toggle("on", some);
    svg.setAttribute("viewBox", view?.value || (some && svg.dataset.whole) || close);
  };
  for (const one of [view, ...boxes]) one?.addEventListener("change", see);
  see();
  const run = () => (motion.rate = Number(rate?.value ?? 1));
  rate?.addEventListener("change", run);
  run();
  const traces = /** @type {HTMLInputElement | null} */ (document.getElementById("traces"));
  const trace = () => {
    if (!film.traces) film.trace();
    film.traces?.toggleAttribute("hidden", !traces?.checked);
  };
  traces?.addEventListener("change", trace);
  if (traces?.checked) trace();
}

/** Let the cursor run, round and round or to and fro, in so many seconds from end to end, until it is stopped. */
export class Motion {
  /**
   * @param {Cursor} cursor
   * @param {HTMLButtonElement} button
   * @param {number} seconds
   * @param {boolean} turns
   */
  constructor(cursor, button, seconds, turns) {
    this.cursor = cursor;
    this.button = button;
    this.seconds = seconds;
    this.turns = turns;
    this.last = 0;
    this.rate = 1;
    this.way = 1;
    cursor.stop = () => this.stop();
    button.addEventListener("click", () => (cursor.runs ? this.stop() : this.start()));
  }

  start() {
    this.cursor.runs = true;
    this.button.ariaPressed = "true";
    requestAnimationFrame((time) => {
      this.last = time;
      this.frame(time);
    });
  }

  stop() {
    this.cursor.runs = false;
    this.button.ariaPressed = "false";
    this.cursor.snap(this.cursor.at);
  }

  /** @param {number} time */
  frame(time) {
    if (!this.cursor.runs) return;
    const { stops, at } = this.cursor;
    const [start, end] = [stops[0], stops[stops.length - 1]];
    const next = at + (this.way * (end - start) * Math.min(time - this.last, 100) * this.rate) / 1000 / this.seconds;
    this.last = time;
    if (next >= start && next <= end) this.cursor.move(next);
    else if (this.turns) this.cursor.move(start + ((next - start) % (end - start)));
    else {
      this.way = -this.way;
      this.cursor.move(next > end ? end : start);
    }
    requestAnimationFrame((later) => this.frame(later));
  }
}
