// The studio: a machine file as form and as text, the machine, its diagrams, its values; all of one document.
import { Ahead } from "./ahead.js";
import { bar } from "./bar.js";
import { Commands } from "./commands.js";
import { Cursor } from "./cursor.js";
import { Drag } from "./drag.js";
import { Editing } from "./editing.js";
import { Editor } from "./editor.js";
import { Explanation } from "./explain.js";
import { FollowingFigure } from "./following.js";
import { Form } from "./form.js";
import { choose, Film } from "./machine.js";
import { columnsOf, fixed } from "./numbers.js";
import { changed, curvesOf, differs, MOST_PINS } from "./pins.js";
import { Sketch } from "./sketch.js";
import { bindMenus, bindTabs } from "./tabs.js";
import { Talk, UNKNOWN } from "./talk.js";
import { Trial } from "./trial.js";
import { Walk } from "./walk.js";

/** @typedef {import("./talk.js").Answer} Answer */
/** @typedef {import("./talk.js").Question} Question */

/**
 * @template {HTMLElement} T
 * @param {string} id
 * @returns {T}
 */
function room(id) {
  return /** @type {T} */ (document.getElementById(id));
}

// a machine as one word, of ours or of PMKS+
const SHARED = /^(crankwork:\S+|(https?:\/\/\S*\?)?[\w-]{1,4}\.[\w,-]+\.[\w,-]+\.\w+\.\w+,\S+)$/;

// between looks at the file on disk, and until it is said that something is under way [ms]
const LOOKS = 2000;
const PATIENCE = 700;

class StudioPage {
  constructor() {
    /** @type {Record<string, string>} */
    this.words = JSON.parse(room("words").textContent ?? "{}");
    /** Names of the diagrams that are seen, those of its own choice at first. @type {string[] | null} */
    this.wanted = null;
    /** @type {import("./pins.js").Pinned[]} */
    this.pins = [];
    /** @type {Cursor | undefined} */
    this.cursor = undefined;
    /** @type {Film | undefined} */
    this.film = undefined;
    /** @type {Answer} */
    this.seen = {};
    this.reads = false;
    /** What was told of the file on disk. */
    this.onDisk = "";
    /** Whether the machine ran before a reload. @type {boolean | undefined} */
    this.ran = undefined;
    /** How many machines were opened. */
    this.opened = 0;
    /** What follows the cursor, by where it stands. @type {Map<string, import("./cursor.js").Follower[]>} */
    this.followers = new Map();
    /** The figures that are seen, by name. @type {Map<string, FollowingFigure>} */
    this.drawnFigures = new Map();
    /** @type {Sketch | undefined} */
    this.sketch = undefined;
    this.barText = room("bar").innerHTML;
    this.hint = /** @type {HTMLElement} */ (room("machine").querySelector(".hint"));
    this.editing = new Editing((editing) => this.edited(editing));
    this.editor = new Editor(room("source"), room("lines"), (text, ends) => this.typed(text, ends));
    this.form = new Form(room("form"), this.words, {
      reach: (key) => this.talk.ask({ do: "reach", key }),
      typed: (key, value, ends, slid) => this.set(key, value, ends, slid),
      gone: (key) => this.talk.ask({ do: "without", key, of: this.opened, figures: this.wanted, named: `− ${key}` }),
      added: (fields) => this.talk.ask({ do: "set", fields, of: this.opened, figures: this.wanted, named: `+ ${Object.keys(fields).join(", ")}` }),
      more: (key, name) => this.talk.ask({ do: "add", key, of: this.opened, figures: this.wanted, named: `+ ${name}` }),
    });
    this.drag = new Drag(room("film"), this.words, {
      film: () => this.film,
      cursor: () => this.cursor,
      handles: () => this.seen.handles ?? [],
      dyads: () => this.seen.dyads ?? [],
      near: (key) => this.ahead.prepare(key),
      sized: (key, value, ends) => {
        this.set(key, value, ends);
        return this.least();
      },
      said: (text) => this.chip(text),
    });
    this.commands = new Commands(room("commands"), this.words, () => (this.seen.dyads ?? []).map((/** @type {{name: string}} */ { name }) => ({ name: this.swapped(name), act: () => this.swap(name) })));
    this.walk = new Walk(room("film"), this.words, {
      film: () => this.film,
      handles: () => this.seen.handles ?? [],
      said: (text) => this.say(text),
      turn: (count) => this.cursor?.step(count),
      card: (part) => this.commands.open(part),
      sized: (key, value) => this.set(key, value, true, true),
    });
    this.trial = new Trial(room("trial"), this.words, {
      rows: () => (this.seen.form ?? []).flatMap((/** @type {import("./form.js").Group} */ group) => group.rows),
      values: () => [.../** @type {NodeListOf<HTMLElement>} */ (room("results").querySelectorAll("tr [data-key]"))].map((one) => [one.dataset.key ?? "", one.closest("tr")?.querySelector("th")?.textContent ?? ""]),
      asked: () => this.document(),
    });
    this.ahead = new Ahead({
      beside: (key) => this.beside(key),
      from: () => this.seen.from,
      ask: (key, number) => this.aside.ask({ do: "ahead", text: this.seen.from, key, number, figures: this.wanted, ...this.form.reach(key) }),
      bound: (name, bind) => this.bound(name, bind),
      figure: (name, found, columns) => {
        const frame = /** @type {HTMLElement | null} */ (room("diagrams").querySelector(`.figures > [data-name="${name}"]`));
        return frame ? this.figure(frame, name, found, columns) : undefined;
      },
      film: (isStated) => {
        if (isStated && this.film?.data !== this.seen.data.film) {
          const stated = new DOMParser().parseFromString(this.seen.film, "text/html").querySelector("svg");
          if (stated) this.filmed(stated.outerHTML, this.seen.data.film);
        }
        return this.film;
      },
      filmed: (drawn, film) => this.filmed(drawn, film),
      cursor: () => this.cursor,
    });
    this.tab = bindTabs(document.querySelector("[role=tablist]"));
    this.bind();
    document.documentElement.classList.add("live");
    const now = () => ({ ...this.document(), wide: innerWidth });
    this.talk = new Talk(now, (answer, question) => this.heard(answer, question), "waits", (state) => this.answers(state));
    // what is asked for ahead keeps nobody waiting
    this.aside = new Talk(now, (answer, question) => {
      if (question?.do === "disk") this.watched(answer, question);
      else if (question?.do === "show") this.redrawn(answer, Number(question.pinned));
      else if (question) this.ahead.heard(Number(question.number), answer);
    }, "prepares");
    setInterval(() => this.watch(), LOOKS);
    setTimeout(() => !this.seen.data && !room("refusals").childElementCount && room("notice").hidden && this.notice(this.words.working), PATIENCE);
  }

  /** What every question is asked of: the text, the file that it stands in, whether it may name others. */
  document() {
    return { text: this.editing.text, path: this.editing.path, reads: this.reads };
  }

  /**
   * Return what the file and the page have beside a number, nothing where it cannot be moved.
   * @param {string} key
   */
  beside(key) {
    const rows = (this.seen.form ?? []).flatMap((/** @type {any} */ group) => group.rows);
    const own = rows.find((/** @type {any} */ row) => row.key === key);
    if (own?.number === undefined || document.body.classList.contains("stale")) return "";
    const others = rows.filter((/** @type {any} */ row) => row !== own).map((/** @type {any} */ row) => [row.key, row.value]);
    return JSON.stringify([this.opened, this.wanted, Boolean(this.seen.turn), others]);
  }

  /** Return in words how near links come to a line, of a number that is held, where they come near. */
  least() {
    const least = this.ahead.least();
    return least ? ` · ${this.words.least_angle.replace("{joint}", least.joint).replace("{angle}", fixed(least.angle, 1))}` : "";
  }

  /**
   * Let something follow the cursor, in the place of what stood there before.
   * @param {string} name
   * @param {(cursor: Cursor) => void} bind
   */
  bound(name, bind) {
    const { cursor } = this;
    if (!cursor) return;
    const old = this.followers.get(name) ?? [];
    cursor.followers = cursor.followers.filter((one) => !old.includes(one));
    const count = cursor.followers.length;
    bind(cursor);
    this.followers.set(name, cursor.followers.slice(count));
  }

  /** @param {Editing} editing */
  edited(editing) {
    this.keep();
    this.editor.show(editing.text);
    this.headed();
    const [undo, redo] = editing.names;
    for (const [id, name] of [["undo", undo], ["redo", redo]]) {
      const button = /** @type {HTMLButtonElement} */ (room(id));
      button.disabled = !name;
      button.title = name;
    }
  }

  /**
   * Say that nothing is answered, and how what stands here comes to where it is.
   * @param {import("./talk.js").State} state
   */
  answers(state) {
    if (state === "lost") this.notice(this.words.lost, [this.words.share, () => room("share").click()]);
    else this.notice(state === "open" ? "" : this.words.restarted);
  }

  /** Say in the title what stands here, and whether it is as it was saved. */
  headed() {
    const { editing } = this;
    const title = this.seen.title || "crankwork";
    room("title").textContent = title;
    document.title = `${editing.unsaved ? "• " : ""}${title}`;
    const save = room("save");
    save.classList.toggle("unsaved", editing.unsaved);
    save.title = [editing.path, editing.unsaved ? this.words.unsaved : ""].filter(Boolean).join(": ");
  }

  /** Keep what is here beyond a reload: the document with its last steps, variants, diagrams. */
  keep() {
    const { text, path, files, entries, at } = this.editing;
    const first = Math.max(0, at - 30);
    const waiting = [this.talk.asked, ...this.talk.waiting].filter((one) => one?.named);
    const kept = { text, path, files, entries: entries.slice(first, at + 1), waiting, wanted: this.wanted, pins: this.pins, runs: this.cursor?.runs, language: document.documentElement.lang };
    // where there is no room for the steps without them, and nothing of what is longer than any machine
    for (const one of [kept, { ...kept, files: path ? { [path]: files[path] } : {}, entries: [], pins: [] }]) {
      try {
        return sessionStorage.setItem("studio", JSON.stringify(one));
      } catch {
        continue;
      }
    }
  }

  /** Take up what was here before a reload; return whether there was something. */
  resume() {
    const kept = JSON.parse(sessionStorage.getItem("studio") ?? "null");
    if (!kept?.text) return false;
    // where nothing was done yet, another language begins anew
    const isUntouched = kept.text === kept.entries[0]?.text && !kept.waiting?.length;
    if (isUntouched && kept.entries.length < 2 && kept.language !== document.documentElement.lang) return false;
    Object.assign(this, { wanted: kept.wanted, pins: kept.pins, ran: kept.runs });
    Object.assign(this.editing, { entries: kept.entries, at: kept.entries.length - 1, path: kept.path, files: kept.files, drawn: kept.entries.at(-1)?.drawn });
    this.editing.take(kept.text);
    this.editing.commit(this.words.text);
    this.listPins();
    if (kept.language !== document.documentElement.lang) this.redraw(0);
    this.show();
    // what nobody answered yet
    for (const one of kept.waiting ?? []) this.talk.ask({ ...one, of: this.opened });
    return true;
  }

  /**
   * @param {string} key
   * @param {string} value
   * @param {boolean} ends
   * @param {boolean} [slid]
   */
  set(key, value, ends, slid) {
    const behind = ends ? undefined : this.ahead.move(key, value);
    if (behind && !behind.machine && !behind.figures.length) return;
    const figures = behind ? behind.figures : this.wanted;
    const named = ends ? `${key} = ${value}` : "";
    this.talk.ask({ do: "set", fields: { [key]: value }, of: this.opened, figures, held: Boolean(behind), machine: behind?.machine, named, slid: slid ? key : "" });
  }

  /**
   * @param {string} text
   * @param {boolean} ends
   */
  typed(text, ends) {
    this.editing.text = text;
    this.keep();
    if (ends) this.editing.commit(this.words.text);
    this.show();
  }

  show() {
    this.talk.ask({ do: "show", figures: this.wanted });
  }

  /**
   * Take a text that comes from elsewhere.
   * @param {string} text
   * @param {string} name
   * @param {string} path the file that it is saved to
   */
  open(text, name, path = "") {
    this.fresh();
    this.editing.path = path;
    if (path) this.editing.files[path] = text;
    this.editing.take(text);
    this.editing.commit(name);
    this.show();
  }

  /** Let all variants go: of another machine they say nothing. */
  unpin() {
    this.pins = [];
    this.listPins();
  }

  /**
   * @param {Answer} answer
   * @param {Question | undefined} question
   */
  heard(answer, question) {
    if (answer.recent) this.recent(answer.recent);
    if (answer.n === undefined) {
      // what this page had when it was left comes before the file
      if (this.editing.at >= 0) this.show();
      else if (!this.resume()) this.open(answer.text ?? "", this.words.open, answer.path);
      return;
    }
    if (question?.do === "explain" && answer.memories) return this.explain(answer);
    if (question?.do === "missing") return this.sketch?.heard(answer, /** @type {string[]} */ (question.typed));
    if (question?.do === "reach" && answer.reach) return this.light(answer);
    if (question?.do === "save") return this.saved(answer, question);
    if (question?.do === "disk") return this.disk(answer);
    if (question?.do === "recent") {
      if (answer.text === undefined) this.notice(answer.refusals?.[0]?.text ?? "");
      else {
        this.unpin();
        this.open(answer.text, this.words.open, answer.path);
      }
      return;
    }
    if (answer.long) return this.refused([{ key: "", line: 0, text: this.words.long }]);
    if (question && ["set", "without", "sketch", "add", "swap"].includes(question.do) && question.base !== this.editing.text) {
      // the text went on meanwhile: what was asked for is done to what it is now, if it is the same machine
      if (question.named && question.of === this.opened) this.talk.ask(question);
      return;
    }
    if (answer.text !== undefined) this.editing.take(answer.text);
    if (["template", "shared"].includes(question?.do ?? "") && answer.text !== undefined) this.unpin();
    if (question?.do === "sketch" && answer.data) this.drawing(false);
    if (question?.named) this.editing.commit(String(question.named), String(question.slid ?? ""));
    if (answer.form) this.form.show(answer.form, answer.additions ?? []);
    if (answer.added?.length) this.form.field(answer.added[0])?.focus();
    this.refused(answer.refusals ?? []);
    if (room("notice").textContent?.startsWith(this.words.working)) this.notice("");
    this.named(answer.named);
    document.body.classList.toggle("stale", !answer.data);
    if (answer.data && question?.held) this.drawHeld(answer);
    else if (answer.data) this.draw({ ...answer, from: answer.text ?? question?.base });
    if (answer.brought) room("diagrams").querySelector(`[data-name="${answer.brought}"]`)?.scrollIntoView({ block: "nearest" });
    if (question?.do === "sketch" && answer.data) this.run();
    const told = answer.refusals?.[0]?.text ?? answer.doubt ?? "";
    if (room("told").textContent !== told) room("told").textContent = told;
    if (told && this.drag.size) this.chip(told);
  }

  /** @param {{key: string, text: string, line: number}[]} refusals */
  refused(refusals) {
    this.form.blame(refusals);
    this.editor.blame(refusals.map(({ line }) => line));
    room("refusals").replaceChildren(
      ...refusals.map(({ text, line }) => {
        const item = document.createElement("li");
        const button = item.appendChild(document.createElement("button"));
        button.textContent = text;
        button.addEventListener("click", () => {
          this.tab("text");
          this.editor.go(line || 1);
        });
        return item;
      }),
    );
  }

  /**
   * Ask whether files may be read that a text from elsewhere names.
   * @param {string[] | undefined} names
   */
  named(names) {
    if (!names?.length) return;
    const allow = () => {
      this.reads = true;
      this.show();
    };
    this.notice(`${this.words.named} ${names.join(", ")}`, [this.words.allow, allow]);
  }

  /**
   * Say something above all, with the ways out.
   * @param {string} text
   * @param {...[string, () => void]} ways
   */
  notice(text, ...ways) {
    const place = room("notice");
    place.hidden = !text;
    place.textContent = text;
    const add = (/** @type {string} */ name, /** @type {() => void} */ act) => {
      const button = place.appendChild(document.createElement("button"));
      button.textContent = name;
      button.addEventListener("click", () => {
        place.hidden = true;
        act();
      });
      return button;
    };
    for (const [name, act] of ways) add(name, act);
    add("×", () => {}).ariaLabel = this.words.dismiss;
  }

  /**
   * Draw what does not follow a number by itself while that is held.
   * @param {Answer} answer
   */
  drawHeld(answer) {
    const columns = columnsOf(answer.data);
    if (answer.film && !this.ahead.draws()) this.filmed(answer.film, answer.data.film);
    for (const one of /** @type {NodeListOf<HTMLElement>} */ (room("diagrams").querySelectorAll(".figures > figure"))) {
      const name = one.dataset.name ?? "";
      if (answer.figures[name] && !this.ahead.draws(name)) this.figure(one, name, answer, columns);
    }
  }

  /**
   * Show the machine as it is while a number is held.
   * @param {string} drawn
   * @param {import("./machine.js").FilmData} film
   */
  filmed(drawn, film) {
    const before = room("film").querySelector("svg");
    if (!before || this.sketch) return;
    const view = before.getAttribute("viewBox") ?? "";
    const focused = before === document.activeElement;
    before.outerHTML = drawn;
    const svg = /** @type {SVGSVGElement} */ (room("film").querySelector("svg"));
    // what is seen stands still under the pointer
    svg.setAttribute("viewBox", view);
    this.bound("machine", (cursor) => (this.film = new Film(svg, film, cursor)));
    this.walk.take(focused);
    if (/** @type {HTMLInputElement | null} */ (document.getElementById("traces"))?.checked) this.film?.trace();
  }

  /** @param {Answer} answer */
  draw(answer) {
    const held = this.ahead.release();
    this.unlight();
    this.seen = answer;
    const { data } = answer;
    const columns = columnsOf(data);
    const axis = columns[data.axis];
    this.headed();
    this.follow(axis, data);
    if (!this.sketch) this.machine(answer.film, data.film);
    this.figures(answer, columns);
    this.values(answer);
    this.turn(answer.turn);
    this.columns = columns;
    // whoever held a number may hold it again
    if (held) this.ahead.prepare(held);
  }

  /**
   * Bind the bar to the rows of now; the place on it stays.
   * @param {import("./numbers.js").Column} axis
   * @param {any} data
   */
  follow(axis, data) {
    const { cursor } = this;
    const found = new Cursor(axis.values, data.film?.angles.map((/** @type {number} */ one) => one / data.film.degrees));
    const same = cursor && String(cursor.stops) === String(found.stops);
    if (!cursor || !same) {
      const was = cursor?.at;
      const runs = cursor ? cursor.runs : this.ran;
      cursor?.stop();
      const own = room("bar");
      own.innerHTML = this.barText;
      this.cursor = found;
      this.motion = bar(this.cursor, axis, data.film?.seconds ?? 4, data.film?.turns ?? true);
      this.followers.clear();
      if (was !== undefined) this.cursor.move(was);
      if (data.film && (runs ?? true)) this.run();
    }
  }

  /** Let the machine run, unless the reader wants nothing to move by itself. */
  run() {
    if (!this.cursor?.runs && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.motion?.start();
  }

  /**
   * @param {string} drawn
   * @param {any} data
   */
  machine(drawn, data) {
    const own = room("film");
    const states = [...own.querySelectorAll("input, select")].map((one) => [one.id || /** @type {HTMLElement} */ (one).dataset.choice, one]);
    const focused = own.querySelector("svg") === document.activeElement;
    own.innerHTML = drawn;
    for (const [name, was] of states) {
      const now = own.querySelector(`#${CSS.escape(String(name))}, [data-choice="${CSS.escape(String(name))}"]`);
      if (was instanceof HTMLInputElement && now instanceof HTMLInputElement) now.checked = was.checked;
      if (was instanceof HTMLSelectElement && now instanceof HTMLSelectElement && now.options[was.selectedIndex]) now.selectedIndex = was.selectedIndex;
    }
    const svg = own.querySelector("svg");
    this.film = undefined;
    this.bound("machine", (cursor) => {
      this.film = svg && data ? new Film(svg, data, cursor) : undefined;
    });
    if (this.film && this.motion) choose(this.film, this.motion);
    this.walk.take(focused);
    this.hint.hidden = !this.film;
  }

  /**
   * @param {Answer} answer
   * @param {Record<string, import("./numbers.js").Column>} columns
   */
  figures(answer, columns) {
    const own = /** @type {HTMLElement} */ (room("diagrams").querySelector(".figures"));
    const names = Object.keys(answer.figures);
    this.wanted = names;
    /** @type {Map<string, Element>} */
    const there = new Map([...own.children].map((one) => [/** @type {HTMLElement} */ (one).dataset.name ?? "", one]));
    own.replaceChildren(...names.map((name) => there.get(name) ?? this.frame(name, answer.names[name])));
    for (const gone of there.keys()) if (!names.includes(gone)) this.bound(gone, () => {});
    this.drawnFigures.clear();
    for (const [k, name] of names.entries()) this.figure(/** @type {HTMLElement} */ (own.children[k]), name, answer, columns);
    const add = /** @type {HTMLSelectElement} */ (room("add"));
    const others = Object.entries(answer.names).filter(([name]) => !names.includes(name));
    add.replaceChildren(new Option(this.words.add, ""), ...others.map(([name, title]) => new Option(String(title), name)));
    const files = room("export");
    for (const one of files.querySelectorAll("optgroup")) one.remove();
    for (const name of names) {
      const group = Object.assign(document.createElement("optgroup"), { label: answer.names[name] });
      group.append(...(files.dataset.formats ?? "").split(" ").map((ending) => new Option(`${name}.${ending}`)));
      files.append(group);
    }
  }

  /**
   * @param {string} name
   * @param {string} title
   */
  frame(name, title) {
    const made = document.createElement("figure");
    made.dataset.name = name;
    const close = document.createElement("button");
    close.className = "gone";
    close.textContent = "×";
    close.ariaLabel = `${this.words.without} ${title}`;
    close.addEventListener("click", () => {
      this.wanted = (this.wanted ?? []).filter((one) => one !== name);
      made.remove();
      this.show();
    });
    const drawn = document.createElement("div");
    made.append(close, drawn, Object.assign(document.createElement("figcaption"), { textContent: title }));
    return made;
  }

  /**
   * @param {HTMLElement} frame
   * @param {string} name
   * @param {Answer} answer
   * @param {Record<string, import("./numbers.js").Column>} columns
   * @returns {FollowingFigure | undefined}
   */
  figure(frame, name, answer, columns) {
    const drawn = /** @type {HTMLElement} */ (frame.querySelector("div"));
    const before = drawn.querySelector("svg");
    const off = [...drawn.querySelectorAll('[aria-pressed="false"]')].map((one) => one.textContent);
    const view = before?.classList.contains("near") ? before.getAttribute("viewBox") : null;
    const focused = before === document.activeElement;
    drawn.innerHTML = answer.figures[name];
    const svg = drawn.querySelector("svg");
    if (!svg || !this.cursor) return undefined;
    /** @type {FollowingFigure | undefined} */
    let made;
    // scales change, and what was told stays
    this.bound(name, (cursor) => (made = new FollowingFigure(svg, structuredClone(answer.data.figures[name]), columns, answer.data.axis, cursor)));
    made?.haunt(this.pins);
    if (made) this.drawnFigures.set(name, made);
    if (view) svg.setAttribute("viewBox", view);
    svg.classList.toggle("near", Boolean(view));
    for (const one of svg.querySelectorAll("[aria-pressed]")) if (off.includes(one.textContent)) one.dispatchEvent(new Event("click"));
    if (focused) svg.focus();
    return made;
  }

  /** @param {Answer} answer */
  values(answer) {
    const own = room("results");
    const [met, all] = answer.checks;
    own.innerHTML = answer.values;
    room("cards").innerHTML = answer.cards;
    const head = document.createElement("p");
    head.textContent = [answer.method, ...(all ? [`${this.words.checks} ${met}/${all}`] : [])].join(" · ");
    own.prepend(head);
    if (answer.doubt) own.prepend(Object.assign(document.createElement("p"), { className: "doubt", textContent: answer.doubt }));
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("main [data-key]"))) {
      const key = button.dataset.key ?? "";
      const pinned = this.pins[this.pins.length - 1];
      const change = pinned ? differs(answer.summary[key], pinned.summary[key], answer.scales[key]) : "";
      if (change) button.after(Object.assign(document.createElement("ins"), { textContent: ` ${change}` }));
    }
  }

  /**
   * Say what a crank needs to turn fully, with a way to have it.
   * @param {{text: string, use: string, key: string, value: string} | undefined} needed
   */
  turn(needed) {
    const place = room("turn");
    place.hidden = !needed;
    place.textContent = needed ? `${needed.text} ` : "";
    if (!needed) return;
    const button = place.appendChild(document.createElement("button"));
    button.textContent = needed.use;
    button.addEventListener("click", () => this.set(needed.key, needed.value, true));
  }

  /** @param {Answer} answer */
  explain(answer) {
    if (!this.cursor || !this.columns) return;
    const shown = new Explanation(room("explanation"), answer.memories, this.columns, this.columns[this.seen.data.axis].symbol, this.cursor);
    shown.explain(answer.key);
  }

  /**
   * Say something above the machine, or beside a place on the screen.
   * @param {string} text
   * @param {DOMPoint} [at]
   * @param {boolean} [up] whether above that place
   */
  chip(text, at, up) {
    const chip = room("chip");
    chip.hidden = !text;
    chip.textContent = text;
    const { left, top, width, right, bottom } = room("machine").getBoundingClientRect();
    const isRight = at !== undefined && at.x - left > width / 2;
    chip.classList.toggle("beside", Boolean(at));
    // it has the wider side to stand on
    chip.style.left = at ? (isRight ? "auto" : `${at.x - left + 14}px`) : "";
    chip.style.right = at && isRight ? `${right - at.x + 14}px` : "";
    chip.style.maxWidth = at ? `${(isRight ? at.x - left : right - at.x) - 20}px` : "";
    const isUp = at !== undefined && up && at.y - top > chip.offsetHeight + 14;
    chip.style.top = at ? (isUp ? "auto" : `${at.y - top + 14}px`) : "";
    chip.style.bottom = at && isUp ? `${bottom - at.y + 14}px` : "";
  }

  /** Return the names that links and pins of the file have. */
  taken() {
    const groups = /** @type {import("./form.js").Group[]} */ (this.seen.form ?? []);
    const own = groups.flatMap(({ rows }) => rows).filter(({ key }) => /^(links|sliders|fixed_points|guides|positions|crank)\./.test(key));
    return new Set(own.flatMap(({ key, value }) => [...key.replace(/\[.*/, "").split("."), ...(/\.(joins|pin)$/.test(key) ? String(value).match(/\w+/g) ?? [] : [])]));
  }

  /**
   * Light what a number reaches, until something else is drawn or pressed.
   * @param {Answer} answer
   */
  light({ reach: { values, columns }, key }) {
    const rows = /** @type {HTMLElement[]} */ ([...room("results").querySelectorAll("tr [data-key]")]);
    const curves = /** @type {SVGElement[]} */ ([...room("diagrams").querySelectorAll("[data-curve]:not(.ghost)")]);
    document.body.classList.add("lit");
    for (const one of rows) one.closest("tr")?.classList.toggle("reached", values.includes(one.dataset.key));
    for (const one of curves) one.classList.toggle("reached", columns.includes(one.dataset.curve));
    this.say(this.words.reaches.replace("{key}", key).replace("{count}", String(rows.filter((one) => one.closest(".reached")).length)));
    room("results").querySelector(".reached")?.closest("table")?.scrollIntoView({ block: "nearest" });
  }

  unlight() {
    if (!document.body.classList.contains("lit")) return;
    document.body.classList.remove("lit");
    this.say("");
  }

  /** Say at the machine, and aloud. @param {string} text */
  say(text) {
    this.chip(text);
    room("told").textContent = text;
  }

  /**
   * @param {Answer} answer
   * @param {Question} question
   */
  saved(answer, question) {
    if (answer.saved) {
      this.editing.keep(question.base ?? "", answer.saved);
      const isRefused = room("refusals").childElementCount > 0;
      this.notice(`${this.words.saved} ${answer.saved}${isRefused ? `; ${this.words.saved_refused}` : ""}`);
      setTimeout(() => room("notice").textContent?.startsWith(this.words.saved) && this.notice(""), 4000);
    } else if (answer.gone) this.disk(answer);
    else if (answer.conflict) {
      this.notice(`${answer.conflict}: ${this.words.conflict}`, [this.words.reread, () => this.reread()], [this.words.anyway, () => this.save(true)]);
    } else if (answer.handed) {
      // what the server does not know as a file is handed over
      if (this.editing.path) this.hand();
    } else this.notice(answer.refusals?.[0]?.text ?? "");
  }

  /** @param {Answer} answer */
  disk(answer) {
    const { path } = this.editing;
    if (answer.text !== undefined) this.open(answer.text, this.words.reread, path);
    else if (answer.gone) this.notice(`${path}: ${this.words.gone}`, [this.words.save, () => this.save(true)]);
    else if (answer.changed) this.notice(`${path}: ${this.words.changed}`, [this.words.reread, () => this.reread()]);
  }

  /** Take what stands in the file now. */
  reread() {
    this.talk.ask({ do: "disk", take: true, kept: this.editing.kept });
  }

  /** Look whether somebody else has changed the file; what was told of it once is not told again. */
  watch() {
    const { path, kept } = this.editing;
    if (path && !document.hidden && this.aside.idle) this.aside.ask({ do: "disk", kept });
  }

  /**
   * Hear of the file, unless it was saved from here meanwhile.
   * @param {Answer} answer
   * @param {Question} question
   */
  watched(answer, question) {
    if (question.kept !== this.editing.kept || this.talk.asked?.do === "save") return;
    const state = answer.gone ? "gone" : answer.changed ? "changed" : "";
    if (state !== this.onDisk) this.disk(answer);
    this.onDisk = state;
  }

  /**
   * Begin or end to draw a linkage; what was drawn stays.
   * @param {boolean} begins
   */
  drawing(begins) {
    room("draw").ariaPressed = String(begins);
    this.hint.hidden = false;
    const isNew = begins && !this.editing.drawn && Boolean(this.film);
    this.hint.textContent = begins ? `${isNew ? `${this.words.sketch_new} ` : ""}${this.words.sketch}` : `${this.words.hint} ${this.editing.drawn ? this.words.sketch_again : ""}`;
    if (!begins) {
      this.sketch = undefined;
      this.chip("");
      if (this.seen.data) this.machine(this.seen.film, this.seen.data.film);
      return;
    }
    this.motion?.stop();
    this.film = undefined;
    if (this.editing.drawn) this.editing.drawn.pins = standing(this.editing.drawn.pins, this.seen.places ?? {});
    const ask = (/** @type {any} */ pins, /** @type {any} */ links) => {
      const before = this.editing.drawn;
      // what goes on there changes in place
      this.editing.drawn = structuredClone({ pins, links });
      this.talk.ask({ do: "sketch", ...this.editing.drawn, before, of: this.opened, figures: before ? this.wanted : null, named: this.words.draw });
    };
    const tells = {
      drawn: ask,
      asked: (/** @type {any} */ pins, /** @type {any} */ links, /** @type {string[]} */ typed) => this.talk.ask({ do: "missing", ...structuredClone({ pins, links, typed }) }),
      said: (/** @type {string} */ text, /** @type {DOMPoint | undefined} */ at, /** @type {boolean} */ up) => this.chip(text, at, up),
    };
    this.sketch = new Sketch(room("film"), this.words, tells, this.editing.drawn ? this.taken() : new Set());
    if (this.editing.drawn) this.sketch.take(structuredClone(this.editing.drawn.pins), structuredClone(this.editing.drawn.links));
    this.sketch.svg.focus();
  }

  /**
   * Go back in the history, or on; what is being drawn goes with it.
   * @param {number} by
   */
  step(by) {
    if (!this.editing.step(by)) return;
    if (this.sketch) this.drawing(Boolean(this.editing.drawn));
    this.show();
  }

  /**
   * @param {string} name
   * @param {Blob} data
   */
  download(name, data) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(data);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  /** Write the text to its file; one without a file stays among those that were opened last. */
  save(anyway = false) {
    this.talk.ask({ do: "save", anyway, kept: this.editing.kept, name: this.seen.title || "machine.toml" });
  }

  /** Hand the text to the browser. */
  hand() {
    this.editing.path = "";
    this.download("machine.toml", new Blob([this.editing.text]));
    this.editing.keep(this.editing.text, "");
  }

  /**
   * List the machines that were opened last: names, and the folders of files.
   * @param {string[][]} found
   */
  recent(found) {
    const own = /** @type {HTMLOptGroupElement} */ (room("template").querySelector("optgroup"));
    own.hidden = !found.length;
    own.replaceChildren(
      ...found.map(([name, folder]) => {
        const option = new Option(folder ? `${name.slice(folder.length).replace(/^[\\/]/, "")} – ${folder}` : name, name);
        option.dataset.recent = "true";
        return option;
      }),
    );
  }

  /** @param {string} name */
  async export(name) {
    this.notice(this.words.working);
    const answer = await fetch(`export${location.search}`, { method: "POST", body: JSON.stringify({ ...this.document(), name }) }).catch(() => undefined);
    if (!answer) return this.notice(this.words.lost);
    if (answer.ok) {
      this.notice("");
      this.download(name, await answer.blob());
    } else this.notice(answer.status === UNKNOWN ? this.words.restarted : await answer.text());
  }

  /** Return the text as one word, as the command line opens it. */
  async shared() {
    const squeezed = new Blob([this.editing.text]).stream().pipeThrough(new CompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(squeezed).arrayBuffer());
    const letters = Array.from(bytes, (one) => String.fromCharCode(one)).join("");
    return `crankwork:${btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
  }

  /** @param {string} joint */
  swapped(joint) {
    return this.words.swapped.replace("{joint}", joint);
  }

  /**
   * Put the links together the other way at a joint.
   * @param {string} joint
   */
  swap(joint) {
    this.talk.ask({ do: "swap", key: joint, of: this.opened, figures: this.wanted, reads: this.reads, named: this.swapped(joint) });
  }

  pin() {
    if (!this.seen.data) return;
    const pinned = { text: this.editing.text, fields: this.fields(), summary: this.seen.summary, curves: curvesOf(this.drawnFigures.values()) };
    this.pins = [...this.pins, pinned].slice(-MOST_PINS);
    this.keep();
    this.listPins();
    this.draw(this.seen);
  }

  /**
   * Ask for a variant in the words of this language, by which its curves find their graphs.
   * @param {number} pinned
   */
  redraw(pinned) {
    if (this.pins[pinned]) this.aside.ask({ do: "show", text: this.pins[pinned].text, figures: this.wanted, pinned });
    else if (this.seen.data) this.draw(this.seen);
  }

  /**
   * @param {Answer} answer
   * @param {number} pinned
   */
  redrawn({ data, figures }, pinned) {
    const columns = data ? columnsOf(data) : {};
    const drawn = Object.entries(figures ?? {}).map(([name, text]) => {
      const svg = /** @type {SVGSVGElement} */ (Object.assign(document.createElement("div"), { innerHTML: text }).querySelector("svg"));
      return new FollowingFigure(svg, data.figures[name], columns, data.axis, new Cursor(columns[data.axis].values));
    });
    if (data) this.pins[pinned].curves = curvesOf(drawn);
    this.redraw(pinned + 1);
  }

  /** What the form has now, by key. @returns {Record<string, string>} */
  fields() {
    return Object.fromEntries(this.form.stated);
  }

  /** Let each variant that is pinned be taken again or let go. */
  listPins() {
    const own = room("pins");
    own.replaceChildren(
      ...this.pins.flatMap((one, k) => {
        const take = document.createElement("button");
        take.textContent = String(k + 1);
        take.ariaLabel = `${this.words.pinned} ${k + 1}`;
        take.className = `pin-${k + 1}`;
        take.addEventListener("pointerenter", () => (take.title = changed(one.fields ?? {}, this.fields()) || this.words.same));
        take.addEventListener("click", () => this.open(one.text, `${this.words.pinned} ${k + 1}`));
        const gone = document.createElement("button");
        gone.textContent = "×";
        gone.ariaLabel = `${this.words.without} ${this.words.pinned} ${k + 1}`;
        gone.addEventListener("click", () => {
          this.pins = this.pins.filter((other) => other !== one);
          this.keep();
          this.listPins();
          if (this.seen.data) this.draw(this.seen);
        });
        return [take, gone];
      }),
    );
  }

  bind() {
    const on = (/** @type {string} */ id, /** @type {() => void} */ act) => room(id).addEventListener("click", act);
    on("undo", () => this.step(-1));
    on("redo", () => this.step(1));
    on("save", () => {
      if (!this.editing.path) this.hand();
      this.save();
    });
    on("pin", () => this.pin());
    on("all", () => this.commands.open());
    document.addEventListener("pointerdown", () => this.unlight());
    on("draw", () => this.drawing(!this.sketch));
    on("share", async () => {
      const word = await this.shared();
      const copied = await navigator.clipboard?.writeText(word).then(() => true, () => false);
      this.notice(copied ? this.words.copied : `${this.words.share}: ${word}`);
    });
    bindMenus();
    document.addEventListener("click", ({ target }) => {
      const { key } = /** @type {HTMLElement} */ (target).dataset;
      if (key) this.talk.ask({ do: "explain", key });
    });
    for (const kind of ["pointerover", "pointerdown", "focusin"]) {
      room("form").addEventListener(kind, (event) => {
        const { slides } = /** @type {HTMLElement} */ (event.target).dataset;
        if (slides) this.ahead.prepare(slides);
      });
    }
    this.bindChoices();
    document.addEventListener("keydown", (event) => {
      const inField = /** @type {Element} */ (event.target).matches("textarea, input, select");
      if (event.key === "/" && !inField && !this.sketch) {
        this.commands.open();
        event.preventDefault();
      }
      if (event.key === "Escape") this.unlight();
      const dyad = event.key.toLowerCase() === "b" && !inField && !this.sketch ? this.drag.meant() : undefined;
      if (!(event.ctrlKey || event.metaKey) && dyad) this.swap(dyad.name);
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      const typing = /** @type {HTMLElement} */ (event.target).matches("textarea, input:not([type=range])");
      if (typing && key !== "s") return;
      // what is typed in a field counts
      if (typing) /** @type {HTMLElement} */ (event.target).blur();
      if (key === "z") room(event.shiftKey ? "redo" : "undo").click();
      else if (key === "y") room("redo").click();
      else if (key === "s") room("save").click();
      else return;
      event.preventDefault();
    });
    addEventListener("pagehide", () => this.keep());
    addEventListener("focus", () => this.editing.path && this.talk.ask({ do: "disk", kept: this.editing.kept }));
    document.addEventListener("paste", (event) => {
      const word = event.clipboardData?.getData("text").trim() ?? "";
      const inside = /** @type {Element} */ (event.target).closest("input, textarea");
      if (!SHARED.test(word) || inside) return;
      event.preventDefault();
      this.take({ do: "shared", word });
    });
  }

  /** @param {Question} question a text from elsewhere, whose files are not read unasked */
  take(question) {
    this.fresh();
    this.editing.path = "";
    this.talk.ask({ ...question, named: this.words.open });
  }

  /** Forget what belongs to the machine before: choices, what was drawn, what may be read. */
  fresh() {
    this.opened += 1;
    this.reads = false;
    this.wanted = null;
    this.editing.drawn = undefined;
    this.form.shape = "";
    this.walk.fresh();
    for (const id of ["form", "results", "diagrams"]) room(id).scrollTo(0, 0);
    if (this.sketch) this.drawing(false);
  }

  bindChoices() {
    const chosen = (/** @type {string} */ id, /** @type {(value: string, option: HTMLOptionElement) => void} */ act, stays = false) => {
      const select = /** @type {HTMLSelectElement} */ (room(id));
      select.addEventListener("change", () => {
        const { value, selectedOptions } = select;
        const [option] = selectedOptions;
        if (!stays) select.value = "";
        if (value) act(value, option);
      });
    };
    chosen("template", (name, option) => (option.dataset.recent ? this.talk.ask({ do: "recent", name }) : this.take({ do: "template", name })));
    chosen("export", (name) => void this.export(name));
    chosen("language", (language) => location.assign(`/?lang=${language}`), true);
    chosen("add", (name) => {
      this.wanted = [...(this.wanted ?? []), name];
      this.show();
    });
    const open = /** @type {HTMLInputElement} */ (room("open"));
    open.addEventListener("change", async () => {
      const file = open.files?.[0];
      const text = (await file?.text()) ?? "";
      if (SHARED.test(text.trim())) this.take({ do: "shared", word: text });
      else if (file) {
        this.unpin();
        this.open(text, file.name);
        this.talk.ask({ do: "save", kept: "", name: file.name });
      }
      open.value = "";
    });
  }
}

/**
 * Return pins where the machine of now has them, the first of them on the ground where it was drawn. [mm]
 * @param {import("./sketch.js").Pin[]} pins
 * @param {Record<string, [number, number]>} places
 */
function standing(pins, places) {
  const origin = pins.find(({ name, ground }) => ground && places[name]);
  if (!origin) return pins;
  const [x, y] = places[origin.name];
  return pins.map((one) => {
    const at = places[one.name];
    return at ? { ...one, x: origin.x + at[0] - x, y: origin.y - at[1] + y } : one;
  });
}

new StudioPage();
