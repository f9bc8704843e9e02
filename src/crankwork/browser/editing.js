// One machine file, whoever changes it: its text, and one entry of its history for each gesture.

/** A linkage as it was drawn. @typedef {{pins: any, links: any}} Drawn */

/**
 * An entry: what made it, its text, the file that it is saved to, what was drawn of it; the field whose slider made it, and when.
 * @typedef {{name: string, text: string, path: string, drawn?: Drawn, slid?: string, at?: number}} Entry
 */

const LONGEST = 200;
// between steps of one slider that are one gesture [ms]
const SOON = 3000;

export class Editing {
  /** @param {(editing: Editing) => void} changed */
  constructor(changed) {
    this.changed = changed;
    /** @type {Entry[]} */
    this.entries = [];
    this.at = -1;
    this.text = "";
    /** The file that this text is saved to, none for one that came from elsewhere. */
    this.path = "";
    /** What was drawn last of this text. @type {Drawn | undefined} */
    this.drawn = undefined;
    /** The text that was saved last, or opened from its file, by file. @type {Record<string, string>} */
    this.files = {};
  }

  /** What stands in the file of this text. */
  get kept() {
    return this.files[this.path] ?? "";
  }

  /** Whether something was done that is not in a file. */
  get unsaved() {
    return this.text !== this.kept && (this.at > 0 || Boolean(this.path));
  }

  /**
   * Remember what was saved.
   * @param {string} text
   * @param {string} path
   */
  keep(text, path) {
    this.files[path] = text;
    this.changed(this);
  }

  /**
   * Take a text that a gesture has made, which may go on.
   * @param {string} text
   */
  take(text) {
    this.text = text;
    this.changed(this);
  }

  /**
   * End a gesture: what it has made is one entry.
   * @param {string} name
   * @param {string} [slid] the field whose slider has made it
   */
  commit(name, slid) {
    const last = this.entries[this.at];
    if (last?.text === this.text) return;
    const goesOn = slid && last?.slid === slid && Date.now() - (last.at ?? 0) < SOON;
    const before = this.entries.slice(0, this.at + (goesOn ? 0 : 1));
    this.entries = [...before, { name, text: this.text, path: this.path, drawn: this.drawn, slid, at: Date.now() }].slice(-LONGEST);
    this.at = this.entries.length - 1;
    this.changed(this);
  }

  /** What would be undone, and done again. */
  get names() {
    return [this.at > 0 ? this.entries[this.at].name : "", this.entries[this.at + 1]?.name ?? ""];
  }

  /**
   * Go an entry back or on; return whether there is one.
   * @param {number} by
   */
  step(by) {
    const entry = this.entries[this.at + by];
    if (!entry) return false;
    this.at += by;
    Object.assign(this, { path: entry.path, drawn: entry.drawn });
    this.take(entry.text);
    return true;
  }
}
