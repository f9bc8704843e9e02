// Where a machine that is dragged comes to its limits: links that come into line, the other way on from there, a leash.
import { fixed } from "./numbers.js";

/** @typedef {import("./drag.js").Handle} Handle */
/** @typedef {import("./machine.js").Film} Film */
/** @typedef {[number, number]} Place */

/** Two links at a joint: how far they are from one line [deg], and where they would be the other way. @typedef {{joint: string, links: string[], apart: number, other: Place[]}} Line */

// where links are seen to come into line [deg]
const IN_LINE = 15;
// of the width of the drawing, how far the pointer is from its part before a leash is seen
const LOOSE = 0.02;

/**
 * Return the two links of each joint that no crank leads, the pair that is nearest to a line first.
 * @param {Film} film
 * @param {Handle[]} handles
 * @param {number} frame
 * @returns {Line[]}
 */
export function pairsOf(film, handles, frame) {
  const joints = new Set(handles.flatMap(({ from, to }) => [from, to]));
  const found = [...joints].flatMap((joint) => {
    const own = handles.filter(({ from, to }) => from === joint || to === joint);
    const at = film.place(joint, frame);
    const ends = own.map(({ from, to }) => film.place(from === joint ? to : from, frame));
    const [a, b] = ends;
    if (own.length !== 2 || own.some(({ key }) => !key.startsWith("links.")) || !at || !a || !b) return [];
    const angle = Math.abs(turned(at, a, b));
    const links = own.map(({ key }) => key.split(".")[1]);
    return [{ joint: joint.replace("joint.", ""), links, apart: Math.min(angle, 180 - angle), other: [a, mirrored(at, a, b), b] }];
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
   * @param {Handle[]} handles
   * @param {number} frame
   * @param {number} degrees crank angle of the frame
   * @param {Place} held where the part is that is dragged
   * @param {Place} at where the pointer is
   */
  show(film, handles, frame, degrees, held, at) {
    this.hide();
    this.layer = film.svg.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "g"));
    this.layer.classList.add("limits");
    if (Math.hypot(held[0] - at[0], held[1] - at[1]) > LOOSE * film.svg.viewBox.baseVal.width) this.line([held, at], "leash");
    const lines = pairsOf(film, handles, frame);
    const near = lines.filter(({ apart }) => apart < IN_LINE);
    for (const { other } of near) this.line(other, "ghost");
    const [first] = lines;
    const said = (/** @type {string} */ text) =>
      text.replace("{joint}", first?.joint ?? "").replace("{links}", first?.links.join(", ") ?? "").replace("{apart}", fixed(first?.apart ?? 0, 1)).replace("{angle}", fixed(degrees, 1));
    const isEnd = !film.data.turns && (frame <= 0 || frame >= film.last);
    if (isEnd) return said(first && first.apart < IN_LINE ? this.words.turns_back_line : this.words.turns_back);
    return near.length ? said(this.words.near_line) : "";
  }

  /**
   * @param {Place[]} points
   * @param {string} kind
   */
  line(points, kind) {
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    path.setAttribute("d", `M${points.map((one) => one.map((side) => side.toFixed(2)).join(" ")).join("L")}`);
    path.setAttribute("class", kind);
    this.layer?.append(path);
  }

  hide() {
    this.layer?.remove();
    this.layer = undefined;
  }
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
