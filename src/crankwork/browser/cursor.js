// Where the reader looks: one crank angle, or time, for all diagrams, tables and the machine.
import { nearest } from "./numbers.js";

/** @typedef {(cursor: Cursor) => void} Follower */

export class Cursor {
  /**
   * @param {number[]} rows values of the first column of the tables, rising
   * @param {number[]} [film] what the frames of the machine stand at, which may go on to where it turns back
   */
  constructor(rows, film = []) {
    this.rows = rows;
    this.at = rows[0];
    const slack = 1e-6 * (rows[rows.length - 1] - rows[0]);
    /** Where steps stop. */
    this.stops = [
      ...film.filter((one) => one < rows[0] - slack).sort((one, other) => one - other).slice(0, 1),
      ...rows,
      ...film.filter((one) => one > rows[rows.length - 1] + slack).sort((one, other) => other - one).slice(0, 1),
    ];
    /** @type {Follower[]} */
    this.followers = [];
    /** Whether it runs by itself; whoever moves it by hand stops it first. */
    this.runs = false;
    /** Whether a click holds it, so that no pointer in passing moves it. */
    this.fixed = false;
    /** What stops it. */
    this.stop = () => {};
  }

  /** The row that lies nearest. */
  get row() {
    return nearest(this.rows, this.at);
  }

  /** Whether it is beyond the rows, where no numbers are told. */
  get beyond() {
    return this.at < this.rows[0] || this.at > this.rows[this.rows.length - 1];
  }

  /** @param {Follower} follower */
  follow(follower) {
    this.followers.push(follower);
    follower(this);
  }

  /**
   * Go to a place between the ends.
   * @param {number} at
   */
  move(at) {
    this.at = Math.min(Math.max(at, this.stops[0]), this.stops[this.stops.length - 1]);
    for (const follower of this.followers) follower(this);
  }

  /**
   * Go to the stop nearest to a place.
   * @param {number} at
   */
  snap(at) {
    if (this.runs) this.stop();
    this.move(this.stops[nearest(this.stops, at)]);
  }

  /**
   * Go some stops on, round and round.
   * @param {number} count
   */
  step(count) {
    if (this.runs) this.stop();
    const { stops } = this;
    this.move(stops[(nearest(stops, this.at) + count + stops.length) % stops.length]);
  }
}
