// The machine between films of it: drawn anew for a number that was not filmed, by polynomials through those that were.
import { smooth } from "./machine.js";

/** @typedef {import("./machine.js").FilmData} FilmData */

/**
 * A film of a machine that differs from others in one number.
 * @typedef {{value: number, drawn: string, film: FilmData}} Filmed
 */

/** What is written, and the numbers in it by film. @typedef {{words: string[], numbers: number[][]}} Written */

const PIECES = /<[^>]*>|[^<]+/g;
const NUMBERS = /-?(?:\d+\.?\d*|\.\d+)/g;
// where a part stands that a film says nothing of
const USUAL = /** @type {Record<string, number>} */ ({ stretch: 1, tint: 1 });

export class Between {
  /**
   * @param {Filmed[]} films in the order of their numbers
   */
  constructor(films) {
    this.films = films;
    this.values = films.map(({ value }) => value);
    /** What weighs each film beside the others. */
    this.own = this.values.map((one, k) => 1 / this.values.reduce((product, other, j) => (j === k ? product : product * (one - other)), 1));
    const pieces = films.map(({ drawn }) => drawn.match(PIECES) ?? []);
    /** Whether the films show the same things. */
    this.fits = films.length > 2 && pieces.every((one) => one.length === pieces[0].length);
    this.pieces = this.fits ? pieces[0].map((_, k) => written(pieces.map((one) => one[k]))) : [];
    this.parts = Object.keys(films[0]?.film.parts ?? {});
    this.fits &&= films.every(({ film }) => film.angles.length === films[0].film.angles.length && this.parts.every((name) => film.parts[name]));
  }

  /**
   * Return what each film weighs at a number, nothing beyond them.
   * @param {number} value
   * @returns {number[] | undefined}
   */
  weights(value) {
    const { values } = this;
    if (!this.fits || !(value >= values[0] && value <= values[values.length - 1])) return undefined;
    if (values.includes(value)) return values.map((one) => Number(one === value));
    const every = values.map((one, k) => this.own[k] / (value - one));
    const sum = every.reduce((a, b) => a + b);
    return every.map((one) => one / sum);
  }

  /**
   * Return the machine as a film of a number would show it, nothing where it lies beyond those that were filmed.
   * @param {number} value
   * @returns {{drawn: string, film: FilmData} | undefined}
   */
  at(value) {
    const weights = this.weights(value);
    if (!weights) return undefined;
    const nearest = weights.indexOf(Math.max(...weights));
    const mixed = (/** @type {number[]} */ of) => of.reduce((sum, one, k) => sum + weights[k] * one, 0);
    const drawn = this.pieces.map((one) => (Array.isArray(one) ? one[nearest] : rewritten(one, mixed)));
    return { drawn: drawn.join(""), film: this.tracked(weights) };
  }

  /**
   * Return how the parts move.
   * @param {number[]} weights
   * @returns {FilmData}
   */
  tracked(weights) {
    this.tracks ??= this.films.map(({ film }) => film.tracks.map(smooth));
    const known = this.tracks;
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
          const of = values.map((one, k) => (Array.isArray(one) ? known[k][one[0]] : one));
          tracks.push(this.films[0].film.angles.map((_, frame) => of.reduce((/** @type {number} */ sum, one, k) => sum + weights[k] * (Array.isArray(one) ? one[frame] : one), 0)));
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
 * @param {(of: number[]) => number} mixed
 */
function rewritten({ words, numbers }, mixed) {
  let text = words[0];
  numbers.forEach((of, k) => {
    const number = String(Number(mixed(of).toFixed(3)));
    // what stood apart by its sign or its point alone
    text += (/[\d.]$/.test(text) && !number.startsWith("-") ? " " : "") + number + words[k + 1];
  });
  return text;
}
