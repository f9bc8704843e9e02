// The machine by keys: one stop of the tabulator, arrows go from pin to link, Enter offers what can be done, M moves.

/** @typedef {import("./machine.js").Film} Film */
/** @typedef {import("./drag.js").Handle} Handle */

const ARROWS = /** @type {Record<string, number>} */ ({ ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 });

export class Walk {
  /**
   * @param {HTMLElement} room where the machine stands
   * @param {Record<string, string>} words
   * @param {{film: () => Film | undefined, handles: () => Handle[], said: (text: string) => void, turn: (count: number) => void,
   *   card: (part: string) => void, sized: (key: string, value: string) => void}} tells
   */
  constructor(room, words, tells) {
    this.room = room;
    this.words = words;
    this.tells = tells;
    /** The part that is chosen. */
    this.part = "";
    this.moves = false;
    room.addEventListener("keydown", (event) => this.key(event));
    room.addEventListener("focusin", (event) => this.part && this.isOn(event) && this.say());
    room.addEventListener("focusout", (event) => this.isOn(event) && this.tells.said(""));
  }

  /** @param {Event} event */
  isOn(event) {
    return Boolean(this.tells.film()) && event.target === this.room.querySelector("svg");
  }

  /** Choose nothing, since another machine comes. */
  fresh() {
    this.part = "";
    this.moves = false;
  }

  /** Let keys come to a machine that was drawn anew. @param {boolean} focused */
  take(focused) {
    const film = this.tells.film();
    if (!film) return;
    film.svg.tabIndex = 0;
    film.svg.setAttribute("role", "application");
    film.svg.setAttribute("aria-description", this.words.walk);
    if (focused) film.svg.focus();
    this.mark();
  }

  /** Names of pins and links, with the groups that draw each. @returns {Map<string, Element[]>} */
  parts() {
    /** @type {Map<string, Element[]>} */
    const found = new Map();
    for (const one of this.tells.film()?.svg.querySelectorAll("[data-part]") ?? []) {
      const [, joint, link, piece] = /^(?:joint\.([^.]+)|link\.(.+)\.\d+|side\.(piston|rod|crank)\.\d+)$/.exec(/** @type {SVGElement} */ (one).dataset.part ?? "") ?? [];
      const name = joint ?? link ?? piece;
      if (name) found.set(name, [...(found.get(name) ?? []), one]);
    }
    return found;
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (!this.isOn(event) || event.ctrlKey || event.altKey || event.metaKey) return;
    const by = ARROWS[event.key];
    if (by && this.moves) this.move(by * (event.shiftKey ? 10 : 1));
    else if (by) this.go(by);
    else if (event.key === "Enter" && this.part) this.tells.card(this.part);
    else if (event.key.toLowerCase() === "m" && this.part) this.move(0);
    else if (event.key === "Escape" && this.part) this.leave();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {number} by */
  go(by) {
    const names = [...this.parts().keys()];
    const at = names.indexOf(this.part);
    this.part = names[at < 0 ? (by > 0 ? 0 : names.length - 1) : (at + by + names.length) % names.length] ?? "";
    this.mark();
    this.say();
  }

  /** Move no more, or choose nothing. */
  leave() {
    if (!this.moves) this.part = "";
    this.moves = false;
    this.mark();
    this.say();
  }

  /**
   * Begin or end to move, by 0; then a link becomes longer by per cents, and a pin turns the machine.
   * @param {number} by
   */
  move(by) {
    if (!by) {
      this.moves = !this.moves;
      this.say();
      return;
    }
    const handle = this.handle();
    if (!handle) {
      this.tells.turn(by);
      return;
    }
    const number = handle.number * (1 + by / 100) ** handle.power;
    const text = `${Number(number.toPrecision(4))}${handle.unit ? ` ${handle.unit}` : ""}`;
    this.tells.sized(handle.key, text);
    this.tells.said(`${handle.key} = ${text}`);
  }

  /** The length of the link that is chosen. */
  handle() {
    return this.tells.handles().find(({ key }) => key.split(".").slice(0, -1).pop() === this.part);
  }

  mark() {
    for (const [name, groups] of this.parts()) for (const one of groups) one.classList.toggle("chosen", name === this.part);
  }

  say() {
    const { part, words } = this;
    if (!part) {
      this.tells.said("");
      return;
    }
    const joint = `joint.${part}`;
    const named = ({ key = "" }) => key.split(".").slice(0, -1).pop() ?? "";
    const ends = this.tells.handles().filter(({ from, to }) => from === joint || to === joint).map(named);
    const own = this.handle();
    const spans = own?.from.startsWith("joint.") ? words.spans.replace("{from}", own.from.slice(6)).replace("{to}", own.to.slice(6)) : "";
    const told = [part, ends.length ? words.joins.replace("{of}", ends.join(", ")) : spans, this.moves ? (own ? words.walk_size : words.walk_turn) : ""];
    this.tells.said(told.filter(Boolean).join(", "));
  }
}
