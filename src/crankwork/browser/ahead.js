// What the studio calculates by itself while a number is held: asked for before the first move, and drawn at each.
import { Between, weightsOf } from "./between.js";
import { FollowingFigure } from "./following.js";
import { Joints } from "./joints.js";
import { Lines } from "./lines.js";
import { columnsOf } from "./numbers.js";
import { Live } from "./sliders.js";

/** @typedef {import("./calculation.js").Steps} Steps */
/** @typedef {import("./talk.js").Answer} Answer */

/**
 * What is asked for: a number, what the file says beside it, the whole file.
 * @typedef {{key: string, beside: string, from: string}} Wanted
 */

/**
 * A number that may be held: what was answered, and the steps of its calculation.
 * @typedef {Wanted & {ahead: any, steps: Steps | undefined}} Ready
 */

/**
 * What is bound while a number is held: the calculation, its curves, figures that may follow and those that do, joints of the
 * machine or films of it.
 * @typedef {{live: Live, lines: Lines, every: Record<string, FollowingFigure>, figures: FollowingFigure[], joints: Joints | undefined, films: Between, degrees: number}} Bound
 */

// numbers that are kept ready
const MOST_READY = 6;
// below it a mechanism transmits poorly [deg]
const POOR = 40;

export class Ahead {
  /**
   * @param {{beside: (key: string) => string, from: () => string, ask: (key: string, number: number) => void,
   *   bound: (name: string, bind: (cursor: import("./cursor.js").Cursor) => void) => void,
   *   figure: (name: string, ahead: any, columns: Record<string, import("./numbers.js").Column>) => FollowingFigure | undefined,
   *   film: (isStated?: boolean) => import("./machine.js").Film | undefined, filmed: (drawn: string, film: import("./machine.js").FilmData) => void, cursor: () => import("./cursor.js").Cursor | undefined}} page
   */
  constructor(page) {
    this.page = page;
    /** @type {Map<string, Ready>} */
    this.ready = new Map();
    /** What was asked for and not answered yet, by its number. @type {Map<number, Wanted>} */
    this.asked = new Map();
    this.number = 0;
    /** The number that is held, and what is bound to it. @type {{ready: Ready, bound: Bound} | undefined} */
    this.held = undefined;
  }

  /**
   * Ask for what a number takes that may soon be moved.
   * @param {string} key
   */
  prepare(key) {
    const wanted = { key, beside: this.page.beside(key), from: this.page.from() };
    const last = [...this.asked.values()].pop();
    if (!wanted.beside || [this.ready.get(key), last].some((one) => one && isFor(one, wanted))) return;
    this.number += 1;
    this.asked.set(this.number, wanted);
    this.page.ask(key, this.number);
  }

  /**
   * Take what was asked for; its script comes from the server, since no text may become one here.
   * @param {number} number
   * @param {Answer} answer
   */
  heard(number, answer) {
    const asked = this.asked.get(number);
    // what was asked before it and has no answer gave way to it
    for (const one of this.asked.keys()) if (one <= number) this.asked.delete(one);
    if (!asked) return;
    const take = (/** @type {Steps | undefined} */ steps) => {
      this.ready.delete(asked.key);
      this.ready.set(asked.key, { ...asked, ahead: answer.ahead, steps });
      for (const old of [...this.ready.keys()].slice(0, -MOST_READY)) this.ready.delete(old);
    };
    if (!answer.ahead) return take(undefined);
    const script = document.createElement("script");
    script.src = `steps/${answer.steps}.js`;
    script.addEventListener("load", () => {
      script.remove();
      take(/** @type {{steps?: Steps}} */ (globalThis).steps);
    });
    document.head.append(script);
  }

  /**
   * Draw what follows a number; return what stays behind, nothing where it is not calculated here.
   * @param {string} key
   * @param {string} text the number as typed, with its unit
   * @returns {{figures: string[], machine: boolean} | undefined}
   */
  move(key, text) {
    const ready = this.ready.get(key);
    const [, number, unit] = /^(\S+)\s*(.*)$/.exec(text) ?? [];
    if (!ready?.steps || ready.beside !== this.page.beside(key) || unit !== ready.ahead.unit) {
      this.prepare(key);
      return undefined;
    }
    const isOfNow = ready.from === this.page.from();
    if (!isOfNow) this.prepare(key);
    if (this.held?.ready !== ready) this.hold(ready, isOfNow);
    const { data, behind, stays } = ready.ahead;
    const { bound } = /** @type {{ready: Ready, bound: Bound}} */ (this.held);
    const { live, lines, figures, joints, films, degrees } = bound;
    const [field] = data.sliders.fields;
    const value = Number(number) * field.scale + field.origin;
    const [low, high] = ready.ahead.trusted;
    if (value < low || value > high || !live.take([value])) return undefined;
    const weights = weightsOf(ready.ahead.values, value);
    lines.weights = weights ?? [];
    // what the server has drawn once is drawn by it until the number is let go
    if (!weights) bound.figures = figures.filter((one) => !one.between);
    for (const one of bound.figures) {
      if (live.moved) one.follow(lines);
      else one.back();
    }
    const cursor = this.page.cursor();
    if (joints && cursor) joints.draw(cursor.at * degrees);
    const film = stays && films.fits && weights ? films.at(weights) : undefined;
    if (film) this.page.filmed(film.drawn, film.film);
    const followed = new Set(bound.figures);
    const left = Object.keys(bound.every).filter((name) => bound.every[name].between && !followed.has(bound.every[name]));
    return { figures: [...behind, ...left], machine: (stays && !film) || Boolean(data.sliders.joints && !joints) };
  }

  /**
   * Let figures, values and the machine follow a number.
   * @param {Ready} ready
   * @param {boolean} isOfNow whether it was asked of the file as it stands
   */
  hold(ready, isOfNow) {
    const { data, figures, behind } = ready.ahead;
    const { sliders } = data;
    for (const one of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("main [data-key]"))) {
      const key = one.dataset.key ?? "";
      if (sliders.values[key]) one.dataset.value = key;
      one.closest("tr, div")?.classList.toggle("filed", sliders.filed.includes(key));
    }
    const columns = columnsOf(data);
    // joints stand upon the paper of the machine that was asked of
    const film = this.page.film(isOfNow && Boolean(sliders.joints));
    const degrees = film?.data.degrees ?? 1;
    const live = new Live(sliders, /** @type {Steps} */ (ready.steps), columns);
    /** @type {Record<string, FollowingFigure>} */
    const every = {};
    for (const name of Object.keys(figures)) {
      const one = behind.includes(name) ? undefined : this.page.figure(name, ready.ahead, columns);
      if (one?.follows) every[name] = one;
    }
    const joints = film && sliders.joints && isOfNow ? new Joints(film, live, sliders.joints) : undefined;
    this.page.bound("joints", (cursor) => joints && cursor.follow(() => joints.draw(cursor.at * degrees)));
    const films = new Between(ready.ahead.films);
    this.held = { ready, bound: { live, films, lines: new Lines(live.calculation, degrees), every, figures: Object.values(every), joints, degrees } };
  }

  /**
   * Return the joint whose transmission angle becomes the worst, if it becomes poor. [deg]
   * @returns {{joint: string, angle: number} | undefined}
   */
  least() {
    if (!this.held) return undefined;
    const { calculation, data } = this.held.bound.live;
    const found = Object.entries(data.values).flatMap(([key, [factor, added]]) => {
      const joint = /^transmission_angle_(?:min|max)\.(.+)$/.exec(key)?.[1];
      const angle = calculation.values[data.calculation.values[key]] * factor + added;
      return joint ? [{ joint, angle: Math.min(angle, 180 - angle) }] : [];
    });
    return found.filter(({ angle }) => angle < POOR).sort((one, other) => one.angle - other.angle)[0];
  }

  /**
   * Return whether a figure, or else the machine, is drawn here, so that no answer to an earlier move may take its place.
   * @param {string} [figure]
   */
  draws(figure) {
    const bound = this.held?.bound;
    return Boolean(figure === undefined ? bound?.joints : bound?.figures.includes(bound.every[figure]));
  }

  /** Leave what is drawn to what the server has answered; return the number that was held. */
  release() {
    if (!this.held) return "";
    const { key } = this.held.ready;
    this.held = undefined;
    this.page.bound("joints", () => {});
    document.documentElement.classList.remove("moved");
    return key;
  }
}

/**
 * Return whether two are asked of the same.
 * @param {Wanted} one
 * @param {Wanted} other
 */
function isFor(one, other) {
  return one.key === other.key && one.beside === other.beside && one.from === other.from;
}
