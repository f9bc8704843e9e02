// The machine file as a form: a field for each number, a slider where it is one, what may be added.

/**
 * A field: key, name and meaning, what stands in it; a choice has options, a number what a slider goes by, and what of it
 * is shown before its unit.
 * @typedef {{key: string, name: string, label: string, value: string, also?: Record<string, string>, means?: string, options?: string[], number?: number, unit?: string, after?: string,
 *   low?: number, high?: number, whole?: boolean, shown?: string, suffix?: string}} Row
 */

/** @typedef {{path: string, means: string, label: string, rows: Row[], more: Row[]}} Group */

/**
 * What a form tells: a field as typed, whether its gesture has ended; a field that goes; fields that come.
 * @typedef {{typed: (key: string, value: string, ends: boolean, slid?: boolean) => void, gone: (key: string) => void,
 *   added: (fields: Record<string, string>) => void, reach: (key: string) => void, more: (addition: string, name: string) => void}} Tells
 */

export class Form {
  /**
   * @param {HTMLElement} room
   * @param {Record<string, string>} words
   * @param {Tells} tells
   */
  constructor(room, words, tells) {
    this.room = room;
    this.words = words;
    this.tells = tells;
    this.shape = "";
    /** What stands in the file, by key. @type {Map<string, string>} */
    this.stated = new Map();
    /** The largest number of each unit, which a slider reaches whose own is 0. @type {Map<string, number>} */
    this.sizes = new Map();
    /** The field whose slider is held. */
    this.held = "";
  }

  /**
   * @param {Group[]} groups
   * @param {[string, string][]} additions what may be added to the machine: keys and names
   */
  show(groups, additions) {
    const shape = JSON.stringify(groups.map(({ path, rows, more }) => [path, rows.map(({ key, options, number }) => [key, options, number === undefined]), more.map(({ key }) => key)])) + additions;
    const fresh = shape !== this.shape;
    if (fresh) this.build(groups, additions);
    this.shape = shape;
    const rows = groups.flatMap((group) => group.rows);
    this.sizes.clear();
    for (const { unit, number } of rows) if (unit && number) this.sizes.set(unit, Math.max(Math.abs(number), this.sizes.get(unit) ?? 0));
    for (const row of rows) this.fill(row, fresh);
  }

  /**
   * @param {Group[]} groups
   * @param {[string, string][]} additions
   */
  build(groups, additions) {
    const active = /** @type {HTMLElement | null} */ (document.activeElement)?.dataset.of;
    const more = this.choice(this.words.adds, additions, (key, name) => this.tells.more(key, name));
    this.room.replaceChildren(...(additions.length ? [more] : []), ...groups.map((group) => this.group(group)));
    if (active) this.field(active)?.focus();
  }

  /**
   * Return a list to choose from, which does not keep what was chosen.
   * @param {string} words
   * @param {[string, string][]} options
   * @param {(key: string, name: string) => void} act
   */
  choice(words, options, act) {
    const made = document.createElement("select");
    made.className = "more";
    made.ariaLabel = words;
    made.append(new Option(words, ""), ...options.map(([key, name]) => new Option(name, key)));
    made.addEventListener("change", () => {
      const { value, selectedOptions } = made;
      const name = selectedOptions[0].text;
      made.value = "";
      if (value) act(value, name);
    });
    return made;
  }

  /**
   * Go from a field to the next one, or back.
   * @param {Element} field
   * @param {number} by
   */
  step(field, by) {
    const every = /** @type {HTMLElement[]} */ ([...this.room.querySelectorAll("[data-of]")]);
    every[every.findIndex((one) => one === field) + by]?.focus();
  }

  /** @param {string} key */
  field(key) {
    return /** @type {HTMLInputElement | HTMLSelectElement | null} */ (this.room.querySelector(`[data-of="${CSS.escape(key)}"]`));
  }

  /** @param {Group} group */
  group(group) {
    const made = document.createElement("fieldset");
    const legend = made.appendChild(document.createElement("legend"));
    legend.textContent = group.label || this.words.whole;
    legend.title = group.means;
    made.append(...group.rows.map((row) => this.row(row)));
    if (group.more.length) {
      const more = this.choice(this.words.more, group.more.map((one) => [one.key, one.label]), (chosen) => {
        const one = group.more.find((other) => other.key === chosen);
        if (one) this.tells.added({ ...one.also, [one.key]: one.value });
      });
      more.ariaLabel = `${this.words.more}: ${legend.textContent}`;
      made.append(more);
    }
    return made;
  }

  /** @param {Row} row */
  row(row) {
    const made = document.createElement("div");
    made.className = "field";
    const label = made.appendChild(document.createElement("label"));
    label.textContent = row.label;
    label.title = row.means ?? "";
    const id = `field-${row.key}`;
    label.htmlFor = id;
    const input = row.options ? document.createElement("select") : document.createElement("input");
    if (input instanceof HTMLSelectElement) input.append(...(row.options ?? []).map((one) => new Option(one, one)));
    input.id = id;
    input.dataset.of = row.key;
    made.append(input);
    input.addEventListener("change", () => this.tells.typed(row.key, input.value, true));
    if (row.number !== undefined) made.append(document.createElement("span"), ...this.slider(row));
    const gone = document.createElement("button");
    gone.className = "gone";
    gone.textContent = "×";
    // fields follow one another; keys take one away from within
    gone.tabIndex = -1;
    gone.title = "Ctrl+Delete";
    made.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && event.altKey) this.tells.reach(row.key);
      else if (event.key === "Delete" && event.ctrlKey) this.tells.gone(row.key);
      else if (event.target === input && input instanceof HTMLInputElement && /^Arrow(Up|Down)$/.test(event.key)) this.step(input, event.key === "ArrowDown" ? 1 : -1);
      else if (event.key === "Escape" && input instanceof HTMLInputElement) input.value = input.dataset.shown ?? this.stated.get(row.key) ?? "";
    });
    made.addEventListener("click", (event) => {
      if (!event.altKey) return;
      event.preventDefault();
      this.tells.reach(row.key);
    });
    gone.ariaLabel = `${this.words.without} ${row.key}`;
    gone.addEventListener("click", () => this.tells.gone(row.key));
    made.append(gone);
    if (row.means) {
      const means = made.appendChild(document.createElement("small"));
      means.textContent = row.means;
      means.id = `means-${row.key}`;
      input.setAttribute("aria-describedby", means.id);
    }
    made.append(document.createElement("em"));
    return made;
  }

  /** @param {Row} row */
  slider(row) {
    const slider = document.createElement("input");
    slider.type = "range";
    slider.dataset.slides = row.key;
    slider.ariaLabel = `${row.label}${row.unit ? `, ${row.unit}` : ""}`;
    slider.addEventListener("input", () => {
      this.held = row.key;
      const field = this.field(row.key);
      if (field) field.value = local(slider.value);
      this.tells.typed(row.key, `${slider.value}${slider.dataset.after ?? ""}`, false);
    });
    slider.addEventListener("change", () => {
      this.held = "";
      this.tells.typed(row.key, `${slider.value}${slider.dataset.after ?? ""}`, true, true);
    });
    const [low, high] = ["low", "high"].map((kind) => Object.assign(document.createElement("small"), { className: kind }));
    return [low, slider, high];
  }

  /**
   * Return from where to where the slider of a field goes, as written.
   * @param {string} key
   */
  reach(key) {
    const slider = /** @type {HTMLInputElement | null} */ (this.room.querySelector(`[data-slides="${CSS.escape(key)}"]`));
    return slider ? { low: `${slider.min}${slider.dataset.after ?? ""}`, high: `${slider.max}${slider.dataset.after ?? ""}` } : {};
  }

  /**
   * @param {Row} row
   * @param {boolean} fresh
   */
  fill(row, fresh) {
    this.stated.set(row.key, row.value);
    const field = this.field(row.key);
    if (field && this.held !== row.key && (fresh || field !== document.activeElement || field instanceof HTMLSelectElement)) field.value = row.shown ?? row.value;
    const slider = /** @type {HTMLInputElement | null} */ (this.room.querySelector(`[data-slides="${CSS.escape(row.key)}"]`));
    if (!slider || this.held === row.key || row.number === undefined) return;
    if (field) field.dataset.shown = row.shown;
    const unit = slider.parentElement?.querySelector("span");
    if (unit) unit.textContent = row.suffix ?? "";
    slider.dataset.after = row.after ?? "";
    slider.dataset.unit ??= row.unit ?? "";
    // a thumb stays where it was left
    if (slider.min && slider.dataset.unit === (row.unit ?? "") && row.number >= Number(slider.min) && row.number <= Number(slider.max)) {
      slider.value = String(row.number);
      return;
    }
    const [low, high, step] = reach(row.number, row.low ?? -Infinity, row.high ?? Infinity, row.whole ?? false, this.sizes.get(row.unit ?? ""));
    [slider.min, slider.max, slider.step] = [low, high, step].map(String);
    slider.value = String(row.number);
    slider.dataset.unit = row.unit ?? "";
    const ends = [slider.previousElementSibling, slider.nextElementSibling];
    ends.forEach((one, at) => one && (one.textContent = local(at ? slider.max : slider.min).replace("-", "−")));
  }

  /**
   * Mark the fields that are refused.
   * @param {{key: string, text: string}[]} refusals
   */
  blame(refusals) {
    for (const one of /** @type {NodeListOf<HTMLElement>} */ (this.room.querySelectorAll("[data-of]"))) {
      const own = refusals.find(({ key }) => key && (key === one.dataset.of || key.startsWith(`${one.dataset.of}.`) || key.startsWith(`${one.dataset.of}[`) || one.dataset.of?.startsWith(`${key}[`)));
      one.toggleAttribute("aria-invalid", Boolean(own));
      if (own) one.setAttribute("aria-invalid", "true");
      const told = one.parentElement?.querySelector("em");
      // what stands before the key is its place
      if (told) told.textContent = own?.text.split(`${own.key}: `).pop() ?? "";
    }
  }
}

/**
 * Return a number with the decimal mark of the page.
 * @param {string} text
 */
function local(text) {
  return document.documentElement.lang === "en" ? text : text.replace(".", ",");
}

/**
 * Return from where to where a slider goes, and its steps: half of a number to both sides, to round ends, within what it may be.
 * @param {number} number
 * @param {number} low
 * @param {number} high
 * @param {boolean} whole
 * @param {number} [size] how far it goes both ways from 0
 */
export function reach(number, low, high, whole, size = 1) {
  size = Math.abs(number) || Math.min(size, Math.abs(high), Math.abs(low) || Infinity);
  const power = 10 ** Math.floor(Math.log10(size));
  const step = whole ? 1 : power / 100;
  const wide = number ? size / 2 : size;
  // ends are tenths, fifths or halves of a power of ten
  const grain = Math.max(([5, 2].find((one) => one * power <= size) ?? 1) * power / 10, step);
  const from = Math.max(Math.round((number - wide) / grain) * grain, low);
  const to = Math.min(Math.round((number + wide) / grain) * grain, high);
  return [from, to, step].map((one) => Number(one.toPrecision(9)));
}
