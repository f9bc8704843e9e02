// Where a machine that is dragged comes to its limits: links that come into line, the other way on from there, a leash.
import { fixed } from "./numbers.js";
import { shape } from "./shape.js";

/** @typedef {import("./machine.js").Film} Film */
/** @typedef {[number, number]} Place */

/**
 * Links that go together in two ways: the joint at which they come into line, what they hang on, the crank angles at
 * which they pass from one way to the other; of a slider its way, of a lever its other joints.
 * @typedef {{kind: string, name: string, ends: string[], at: string, links: string[], way?: number[],
 *   others?: string[], branch: number, changes: number[]}} Dyad
 */

/** A dyad in a frame: how far it is from where its two ways meet [deg], and its links the other way. @typedef {{dyad: Dyad, apart: number, own: Place[], other: Place[]}} Seen */

// where links are seen to come into line [deg]
const IN_LINE = 15;
// of the width of the drawing, how far the pointer is from its part before a leash is seen
const LOOSE = 0.02;

/**
 * Return the dyads as they are in a frame, that which is nearest to where its ways meet first.
 * @param {Film} film
 * @param {Dyad[]} dyads
 * @param {number} frame
 * @returns {Seen[]}
 */
export function seenOf(film, dyads, frame) {
  const place = (/** @type {string} */ name) => film.place(`joint.${name}`, frame);
  const found = dyads.flatMap((dyad) => {
    const at = place(dyad.at);
    const [a, b] = dyad.ends.map(place);
    if (!at || !a) return [];
    if (dyad.kind === "RRR") {
      if (!b) return [];
      const angle = Math.abs(turned(at, a, b));
      return [{ dyad, apart: Math.min(angle, 180 - angle), own: [a, at, b], other: [a, mirrored(at, a, b), b] }];
    }
    if (dyad.kind === "RRP") {
      const [x, y] = dyad.way ?? [1, 0];
      const along = (a[0] - at[0]) * x + (a[1] - at[1]) * y;
      const apart = (Math.asin(Math.min(Math.abs(along) / (Math.hypot(a[0] - at[0], a[1] - at[1]) || 1), 1)) * 180) / Math.PI;
      return [{ dyad, apart, own: [a, at], other: [a, /** @type {Place} */ ([at[0] + 2 * along * x, at[1] + 2 * along * y])] }];
    }
    // a lever stands the other way round
    const end = (dyad.others ?? []).map(place).find(Boolean) ?? at;
    return [{ dyad, apart: Infinity, own: [a, end], other: [a, /** @type {Place} */ ([2 * a[0] - end[0], 2 * a[1] - end[1]])] }];
  });
  return found.sort((one, other) => one.apart - other.apart);
}

export class Limits {
  /** @param {Record<string, string>} words */
  constructor(words) {
    this.words = words;
    /** @type {SVGGElement | undefined} */
    this.layer = undefined;
  }

  /**
   * Show how near a frame is to a limit, and the pointer on its leash; return what is to be said of it.
   * @param {Film} film
   * @param {Dyad[]} dyads
   * @param {number} frame
   * @param {number} degrees crank angle of the frame
   * @param {number} sense in which the crank goes, 1 or -1
   * @param {Place} held where the part is that is dragged
   * @param {Place} at where the pointer is
   */
  show(film, dyads, frame, degrees, sense, held, at) {
    this.hide();
    this.layer = film.svg.appendChild(shape("g", { class: "limits" }));
    if (Math.hypot(held[0] - at[0], held[1] - at[1]) > LOOSE * film.svg.viewBox.baseVal.width) this.line([held, at], "leash");
    const change = changeNear(film, dyads, degrees);
    if (change) {
      // a little behind the change point the two ways part
      const beyond = film.frame(within(film, change.at + sense * IN_LINE));
      const seen = seenOf(film, [change.dyad], beyond);
      for (const { own, other } of seen) {
        this.line(own, "ghost");
        this.line(other, "ghost other");
      }
      return this.said(this.words.near_change, change.dyad, 0, within(film, change.at));
    }
    const lines = seenOf(film, dyads, frame);
    const near = lines.filter(({ apart }) => apart < IN_LINE);
    for (const { other } of near) this.line(other, "ghost");
    const [first] = lines;
    const { words } = this;
    const [back, close] = first?.dyad.kind === "RRP" ? [words.turns_back_square, words.near_square] : [words.turns_back_line, words.near_line];
    const isEnd = !film.data.turns && (frame <= 0 || frame >= film.last);
    const word = isEnd ? (near.length ? back : words.turns_back) : near.length ? close : "";
    return this.said(word, first?.dyad, first?.apart ?? 0, degrees);
  }

  /**
   * @param {string} text
   * @param {Dyad | undefined} dyad
   * @param {number} apart
   * @param {number} degrees
   */
  said(text, dyad, apart, degrees) {
    const filled = { joint: dyad?.at ?? "", links: dyad?.links.join(", ") ?? "", apart: fixed(apart, 1), angle: fixed(degrees, 1) };
    return Object.entries(filled).reduce((told, [name, value]) => told.replace(`{${name}}`, value), text);
  }

  /**
   * @param {Place[]} points
   * @param {string} kind
   */
  line(points, kind) {
    this.layer?.append(shape("path", { d: `M${points.map((one) => one.map((side) => side.toFixed(2)).join(" ")).join("L")}`, class: kind }));
  }

  hide() {
    this.layer?.remove();
    this.layer = undefined;
  }
}

/**
 * Return the dyad that a reader means to put together the other way: that of a change point, or nearest to its limit.
 * @param {Film} film
 * @param {Dyad[]} dyads
 * @param {number} degrees
 */
export function meant(film, dyads, degrees) {
  return changeNear(film, dyads, degrees)?.dyad ?? seenOf(film, dyads, film.frame(degrees))[0]?.dyad;
}

/**
 * Return the change point to which a crank angle is near, and the dyad that passes it.
 * @param {Film} film
 * @param {Dyad[]} dyads
 * @param {number} degrees
 * @returns {{dyad: Dyad, at: number} | undefined}
 */
function changeNear(film, dyads, degrees) {
  const period = film.data.turns ? Math.max(...film.data.angles) : Infinity;
  const away = (/** @type {number} */ at) => Math.min(...[-1, 0, 1].map((k) => Math.abs(at - degrees + (k && k * period))));
  const found = dyads.flatMap((dyad) => dyad.changes.map((at) => ({ dyad, at }))).sort((one, other) => away(one.at) - away(other.at));
  return found.length && away(found[0].at) < IN_LINE ? found[0] : undefined;
}

/**
 * Return an angle within those of a film. [deg]
 * @param {Film} film
 * @param {number} degrees
 */
function within(film, degrees) {
  const { angles, turns } = film.data;
  const [low, high] = [Math.min(...angles), Math.max(...angles)];
  return turns ? ((degrees % high) + high) % high : Math.min(Math.max(degrees, low), high);
}

/**
 * Return the angle at a place from one other to another. [deg]
 * @param {Place} at
 * @param {Place} a
 * @param {Place} b
 */
function turned(at, a, b) {
  const [x, y, u, v] = [a[0] - at[0], a[1] - at[1], b[0] - at[0], b[1] - at[1]];
  return (Math.atan2(x * v - y * u, x * u + y * v) * 180) / Math.PI;
}

/**
 * Return a place on the other side of the line through two others.
 * @param {Place} at
 * @param {Place} a
 * @param {Place} b
 * @returns {Place}
 */
function mirrored(at, a, b) {
  const [x, y] = [b[0] - a[0], b[1] - a[1]];
  const share = ((at[0] - a[0]) * x + (at[1] - a[1]) * y) / (x * x + y * y || 1);
  return [2 * (a[0] + share * x) - at[0], 2 * (a[1] + share * y) - at[1]];
}
