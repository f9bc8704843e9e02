// All that can be done in the studio as one list: what its words hold is found, Enter does it.

/** @typedef {{name: string, act: () => void}} Command */

// what a list shows at most
const MOST_LISTED = 80;

export class Commands {
  /**
   * @param {HTMLDialogElement} room
   * @param {Record<string, string>} words
   * @param {() => Command[]} more what nothing on the page offers
   */
  constructor(room, words, more) {
    this.room = room;
    this.words = words;
    this.more = more;
    this.input = /** @type {HTMLInputElement} */ (room.querySelector("input"));
    this.list = /** @type {HTMLElement} */ (room.querySelector("ul"));
    /** @type {Command[]} */
    this.every = [];
    /** @type {Command[]} */
    this.found = [];
    this.at = 0;
    this.input.addEventListener("input", () => this.find());
    this.input.addEventListener("keydown", (event) => this.key(event));
    this.list.addEventListener("click", (event) => {
      const item = /** @type {Element} */ (event.target).closest("li");
      if (item) this.go([...this.list.children].indexOf(item));
    });
    room.addEventListener("click", (event) => event.target === room && room.close());
  }

  /**
   * Open the list.
   * @param {string} [of] the part of the machine that commands are wanted of, all of them where there are none
   */
  open(of = "") {
    const parts = (/** @type {string} */ name) => name.split(/[^\p{L}\p{N}_]+/u);
    const every = [...commandsOf(this.words), ...this.more()];
    const own = of ? every.filter(({ name }) => parts(name).includes(of)) : [];
    this.every = own.length ? own : every;
    this.input.value = "";
    this.room.showModal();
    this.find();
  }

  find() {
    const words = this.input.value.toLocaleLowerCase().split(/\s+/).filter(Boolean);
    this.found = this.every.filter(({ name }) => words.every((one) => name.toLocaleLowerCase().includes(one))).slice(0, MOST_LISTED);
    this.list.replaceChildren(
      ...this.found.map(({ name }, k) => {
        const item = document.createElement("li");
        item.id = `command-${k}`;
        item.setAttribute("role", "option");
        item.textContent = name;
        return item;
      }),
    );
    this.choose(0);
  }

  /** @param {number} at */
  choose(at) {
    this.at = Math.min(Math.max(at, 0), this.found.length - 1);
    for (const [k, item] of [...this.list.children].entries()) item.ariaSelected = String(k === this.at);
    const chosen = this.list.children[this.at];
    chosen?.scrollIntoView({ block: "nearest" });
    this.input.setAttribute("aria-activedescendant", chosen?.id ?? "");
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.key === "ArrowDown") this.choose(this.at + 1);
    else if (event.key === "ArrowUp") this.choose(this.at - 1);
    else if (event.key === "Enter") this.go(this.at);
    else return;
    event.preventDefault();
  }

  /** @param {number} at */
  go(at) {
    const chosen = this.found[at];
    if (!chosen) return;
    this.room.close();
    chosen.act();
  }
}

/**
 * Return what the page offers now: fields, values, buttons, and what its lists have to choose from.
 * @param {Record<string, string>} words
 * @returns {Command[]}
 */
function commandsOf(words) {
  /** @type {(where: string) => any[]} */
  const all = (where) => [...document.querySelectorAll(where)];
  const name = (/** @type {HTMLElement} */ one) => one.getAttribute("aria-label") || (one.textContent ?? "").trim();
  const buttons = all(":is(header, .tools) button:not(:disabled, #all, #pins *)").map((one) => ({ name: name(one) || one.id, act: () => one.click() }));
  const files = all("header input[type=file]").map((one) => ({ name: name(one.closest("label")), act: () => one.click() }));
  const choices = all("header select, #add, #form select.more").flatMap((one) => [...one.options].filter(({ value, selected }) => value && !selected).map((option) => ({
    name: `${name(one).replace(/ *\.\.\. */, " ").trim()}: ${option.text}`,
    act: () => {
      one.value = option.value;
      one.dispatchEvent(new Event("change"));
    },
  })));
  const fields = all("#form [data-of]").map((one) => ({
    name: `${one.labels?.[0]?.firstChild?.textContent ?? ""} · ${one.dataset.of}`,
    act: () => {
      all("#form-tab")[0].click();
      one.focus();
    },
  }));
  const values = all("#results tr [data-key]").map((one) => ({ name: `${words.explain}: ${one.closest("tr").querySelector("th")?.textContent}`, act: () => one.click() }));
  return [...fields, ...buttons, ...files, ...choices, ...values];
}
