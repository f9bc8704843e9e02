// Where the reader looks: one crank angle, or time, for all diagrams, tables and the machine.
import { nearest } from "./numbers.js";

/** @typedef {(cursor: Cursor) => void} Follower */

export class Cursor {
  /** @param {number[]} rows values of the first column of the tables, rising */
  constructor(rows) {
    this.rows = rows;
    this.at = rows[0];
    /** @type {Follower[]} */
    this.followers = [];
    /** Whether it runs by itself; whoever moves it by hand stops it first. */
    this.runs = false;
    /** What stops it. */
    this.stop = () => {};
  }

  /** The row that lies nearest. */
  get row() {
    return nearest(this.rows, this.at);
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
    this.at = Math.min(Math.max(at, this.rows[0]), this.rows[this.rows.length - 1]);
    for (const follower of this.followers) follower(this);
  }

  /**
   * Go to the row nearest to a place.
   * @param {number} at
   */
  snap(at) {
    if (this.runs) this.stop();
    this.move(this.rows[nearest(this.rows, at)]);
  }

  /**
   * Go some rows on, round and round.
   * @param {number} count
   */
  step(count) {
    if (this.runs) this.stop();
    const rows = this.rows.length;
    this.move(this.rows[(this.row + count + rows) % rows]);
  }
}
