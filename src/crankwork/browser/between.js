// What lies between machines that were calculated, by polynomials through them: curves, and the machine as it moves.
import { smooth } from "./machine.js";

/** @typedef {import("./machine.js").FilmData} FilmData */

/** A film of a machine. @typedef {{drawn: string, film: FilmData}} Filmed */

/** What is written, and the numbers in it by film. @typedef {{words: string[], numbers: number[][]}} Written */

const PIECES = /<[^>]*>|[^<]+/g;
const NUMBERS = /-?(?:\d+\.?\d*|\.\d+)/g;
// where a part stands that a film says nothing of
const USUAL = /** @type {Record<string, number>} */ ({ stretch: 1, tint: 1 });

/**
 * Return what each of some values weighs in a polynomial through them, nothing beyond them.
 * @param {number[]} values rising
 * @param {number} at
 * @returns {number[] | undefined}
 */
export function weightsOf(values, at) {
  if (values.length < 3 || !(at >= values[0] && at <= values[values.length - 1])) return undefined;
  return values.map((one, k) => values.reduce((product, other, j) => (j === k ? product : (product * (at - other)) / (one - other)), 1));
}

/**
 * Return the sum of rows, each weighed.
 * @param {ArrayLike<number>[]} rows
 * @param {number[]} weights
 * @returns {number[]}
 */
export function mixed(rows, weights) {
  return Array.from(rows[0], (_, k) => rows.reduce((sum, row, j) => sum + weights[j] * row[k], 0));
}

export class Between {
  /** @param {Filmed[]} films in the order of their numbers */
  constructor(films) {
    this.films = films;
    const pieces = films.map(({ drawn }) => drawn?.match(PIECES) ?? []);
    this.parts = Object.keys(films[0]?.film?.parts ?? {});
    /** Whether the films show the same things. */
    this.fits = films.length > 2 && pieces.every((one) => one.length && one.length === pieces[0].length)
      && films.every(({ film }) => film?.angles.length === films[0].film.angles.length && this.parts.every((name) => film.parts[name]));
    this.known = films.map(({ film }) => film?.tracks.map(smooth) ?? []);
    this.pieces = this.fits ? pieces[0].map((_, k) => written(pieces.map((one) => one[k]))) : [];
  }

  /**
   * Return the machine where films weigh so much.
   * @param {number[]} weights
   * @returns {Filmed}
   */
  at(weights) {
    const nearest = weights.indexOf(Math.max(...weights));
    const drawn = this.pieces.map((one) => (Array.isArray(one) ? one[nearest] : rewritten(one, weights)));
    return { drawn: drawn.join(""), film: this.tracked(weights) };
  }

  /**
   * Return how the parts move.
   * @param {number[]} weights
   * @returns {FilmData}
   */
  tracked(weights) {
    const known = this.known;
    const { angles } = this.films[0].film;
    /** @type {number[][]} */
    const tracks = [];
    /** @type {Map<string, number>} */
    const places = new Map();
    const parts = Object.fromEntries(this.parts.map((name) => {
      const every = this.films.map(({ film }) => film.parts[name]);
      const keys = new Set(every.flatMap((one) => Object.keys(one)));
      return [name, Object.fromEntries([...keys].map((key) => {
        const values = every.map((one) => one[key] ?? USUAL[key] ?? 0);
        if (values.every((one) => one === values[0])) return [key, values[0]];
        const mark = JSON.stringify(values);
        if (!places.has(mark)) {
          places.set(mark, tracks.length);
          tracks.push(mixed(values.map((one, k) => (Array.isArray(one) ? known[k][one[0]] : angles.map(() => one))), weights));
        }
        return [key, [places.get(mark)]];
      }))];
    }));
    return /** @type {FilmData} */ ({ ...this.films[0].film, parts, tracks });
  }
}

/**
 * Return a piece of what is drawn as the films have it: as one text, as texts of which the nearest counts, or by its numbers.
 * @param {string[]} pieces
 * @returns {Written | string[]}
 */
function written(pieces) {
  if (pieces.every((one) => one === pieces[0])) return { words: [pieces[0]], numbers: [] };
  if (!/^<(?!svg)/.test(pieces[0])) return pieces;
  return byNumbers(pieces) ?? byNumbers(shortened(pieces)) ?? pieces;
}

/**
 * Return pieces that are the same but for their numbers.
 * @param {string[]} pieces
 * @returns {Written | undefined}
 */
function byNumbers(pieces) {
  const words = pieces.map((one) => one.split(NUMBERS).map((word) => word.trim()));
  if (words.some((one) => one.join("\n") !== words[0].join("\n"))) return undefined;
  const every = pieces.map((one) => one.match(NUMBERS) ?? []);
  const spaced = pieces[0].split(NUMBERS);
  /** @type {Written} */
  const found = { words: [spaced[0]], numbers: [] };
  every[0].forEach((first, k) => {
    const last = found.words.length - 1;
    if (every.every((one) => one[k] === first)) {
      // what stood apart by its point alone
      const apart = /^\./.test(first) && !found.words[last] ? " " : "";
      found.words[last] += apart + first + spaced[k + 1];
      return;
    }
    found.words.push(spaced[k + 1]);
    found.numbers.push(every.map((one) => Number(one[k])));
  });
  return found;
}

/**
 * Return lines of which some films have more, as the strokes of a hatching, with as many as all have.
 * @param {string[]} pieces
 */
function shortened(pieces) {
  const split = pieces.map((one) => /^(<path d="?)([^">]*)(.*)$/s.exec(one));
  const strokes = split.map((one) => one?.[2].match(/M[^M]*/g) ?? []);
  const count = Math.min(...strokes.map((one) => one.length));
  return split.map((one, k) => (one ? one[1] + strokes[k].slice(0, count).join("") + one[3] : ""));
}

/**
 * Return a piece with other numbers.
 * @param {Written} piece
 * @param {number[]} weights
 */
function rewritten({ words, numbers }, weights) {
  let text = words[0];
  numbers.forEach((of, k) => {
    const number = String(Number(mixed(of.map((one) => [one]), weights)[0].toFixed(3)));
    // what stood apart by its sign or its point alone
    text += (/[\d.]$/.test(text) && !number.startsWith("-") ? " " : "") + number + words[k + 1];
  });
  return text;
}
