// Numbers of the machine varied: a map over one or two of them, or many designs, with how far it has come and a way to stop.
import { reach } from "./form.js";

/** @typedef {import("./form.js").Row} Row */

/** How many numbers may vary. */
const MOST_FIELDS = 3;

export class Trial {
  /**
   * @param {HTMLElement} room
   * @param {Record<string, string>} words
   * @param {{rows: () => Row[], values: () => [string, string][], asked: () => Record<string, unknown>}} tells
   */
  constructor(room, words, tells) {
    this.room = room;
    this.words = words;
    this.tells = tells;
    /** @type {AbortController | undefined} */
    this.running = undefined;
    this.form = room.appendChild(document.createElement("form"));
    this.told = Object.assign(document.createElement("pre"), { className: "told", tabIndex: 0, hidden: true });
    this.found = document.createElement("div");
    room.append(this.found, this.told);
    room.addEventListener("toggle", () => this.build());
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (this.running) this.running.abort();
      else void this.run();
    });
  }

  /** Offer the numbers and values that the machine has now. */
  build() {
    if (this.running) return;
    const { words } = this;
    const rows = this.tells.rows().filter(({ number }) => number !== undefined);
    const made = Array.from({ length: MOST_FIELDS }, () => {
      const field = choiceOf(words.trial_field, [["", ""], ...rows.map((row) => /** @type {[string, string]} */ ([row.key, row.key]))]);
      const over = fieldOf(words.trial_over);
      field.addEventListener("change", () => {
        const row = rows.find(({ key }) => key === field.value);
        const [low, high] = row ? reach(row.number ?? 0, row.low ?? -Infinity, row.high ?? Infinity, row.whole ?? false) : [];
        over.value = row ? `${low}..${high}${row.unit ? ` ${row.unit}` : ""}` : "";
      });
      const line = document.createElement("p");
      line.append(field, over);
      return line;
    });
    const values = this.tells.values();
    const names = values.map(([, name]) => name);
    // what is called alike is told apart by its key
    const apart = values.map(([key, name]) => [key, names.indexOf(name) === names.lastIndexOf(name) ? name : `${name} (${key})`]);
    const goals = apart.flatMap(([key, name]) => [
      /** @type {[string, string]} */ ([`minimise ${key}`, words.least.replace("{of}", name)]),
      /** @type {[string, string]} */ ([`maximise ${key}`, words.most.replace("{of}", name)]),
    ]);
    this.count = fieldOf(words.trial_count);
    this.goal = choiceOf(words.trial_goal, goals);
    this.button = document.createElement("button");
    this.button.textContent = words.trial_run;
    this.bar = Object.assign(document.createElement("progress"), { hidden: true, value: 0 });
    this.bar.ariaLabel = words.working;
    this.form.replaceChildren(...made, this.count, this.goal, this.button, this.bar);
  }

  async run() {
    if (!this.button || !this.bar) return;
    const lines = [...this.form.querySelectorAll("p")].map((one) => [.../** @type {NodeListOf<HTMLInputElement>} */ (one.querySelectorAll("select, input"))]);
    const over = Object.fromEntries(lines.map(([field, range]) => [field.value, range.value]).filter(([key]) => key));
    const [way, key] = (this.goal?.value ?? "").split(" ");
    const asked = { ...this.tells.asked(), over, count: this.count?.value.trim() ?? "", objectives: key ? { [key]: way } : {} };
    this.running = new AbortController();
    this.button.textContent = this.words.trial_stop;
    this.bar.hidden = false;
    this.say("");
    this.found.replaceChildren();
    try {
      const answer = await fetch(`trial${location.search}`, { method: "POST", body: JSON.stringify(asked), signal: this.running.signal });
      for await (const one of linesOf(answer)) this.heard(one);
    } catch (error) {
      this.say(this.running.signal.aborted ? this.words.stopped : String(error));
    }
    this.running = undefined;
    this.button.textContent = this.words.trial_run;
    this.bar.hidden = true;
  }

  /** @param {string} text */
  say(text) {
    this.told.textContent = text;
    this.told.hidden = !text;
  }

  /** @param {{done?: number, found?: {text?: string, figures?: Record<string, [string, string]>, refusals?: {text: string}[]}}} one */
  heard({ done, found }) {
    if (this.bar && done !== undefined) this.bar.value = done;
    if (!found) return;
    this.say(found.text ?? (found.refusals ?? []).map(({ text }) => text).join("\n"));
    const figures = Object.values(found.figures ?? {}).map(([title, drawn]) => {
      const made = document.createElement("details");
      made.appendChild(document.createElement("summary")).textContent = title;
      made.appendChild(document.createElement("div")).innerHTML = drawn;
      return made;
    });
    if (figures.length) figures[0].open = true;
    this.found.replaceChildren(...figures);
  }
}

/**
 * Yield the lines of an answer as they come.
 * @param {Response} answer
 */
async function* linesOf(answer) {
  const reader = answer.body?.pipeThrough(new TextDecoderStream()).getReader();
  let left = "";
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    const lines = (left + part.value).split("\n");
    left = lines.pop() ?? "";
    for (const line of lines) yield JSON.parse(line);
  }
}

/**
 * @param {string} name
 * @param {[string, string][]} options
 */
function choiceOf(name, options) {
  const made = document.createElement("select");
  made.ariaLabel = name;
  made.append(...options.map(([key, text]) => new Option(text, key)));
  return made;
}

/** @param {string} name */
function fieldOf(name) {
  const made = document.createElement("input");
  made.placeholder = name;
  made.ariaLabel = name;
  return made;
}
