// What the studio asks of the calculation: one question under way, the newest of those that wait.

/** A question; its base is the text that it was asked of. @typedef {{do: string, fields?: Record<string, string>, base?: string, [key: string]: unknown}} Question */
/** @typedef {{n?: number, text?: string, [key: string]: any}} Answer */

// what the server takes [bytes]; a machine file is far shorter
const LONGEST_MESSAGE = 1_000_000;
/** What is answered to a page that has the token of a server before. */
export const UNKNOWN = 401;

/** Answered, by nobody, or by a server that does not know this page. @typedef {"open" | "lost" | "restarted"} State */

export class Talk {
  /**
   * @param {() => {text: string, path: string, reads: boolean, wide: number}} now what a question is asked of when it goes out
   * @param {(answer: Answer, question: Question | undefined) => void} heard
   * @param {string} name of what it says of itself at the page: whether something is under way
   * @param {(state: State) => void} [state] hears whether it is answered, each time that this changes
   */
  constructor(now, heard, name, state) {
    this.now = now;
    this.heard = heard;
    this.name = name;
    this.state = state;
    /** @type {State} */
    this.stands = "open";
    this.number = 0;
    /** @type {Question | undefined} */
    this.asked = undefined;
    /** @type {Question[]} */
    this.waiting = [];
    this.open();
  }

  open() {
    const { protocol, host, search } = location;
    this.socket = new WebSocket(`${protocol === "https:" ? "wss" : "ws"}://${host}/talk${search}`);
    this.socket.addEventListener("open", () => this.told("open"));
    this.socket.addEventListener("message", (event) => this.answered(JSON.parse(event.data)));
    this.socket.addEventListener("close", () => {
      if (this.asked) this.waiting.unshift(this.asked);
      this.asked = undefined;
      this.told(this.stands === "open" ? "lost" : this.stands);
      setTimeout(() => this.again(), 1000);
    });
  }

  /** Try again; a socket does not tell what refused it, a page does. */
  async again() {
    const answer = this.state && (await fetch("/", { method: "HEAD" }).catch(() => undefined));
    if (answer?.status === UNKNOWN) this.told("restarted");
    this.open();
  }

  /** @param {State} state */
  told(state) {
    if (state !== this.stands) this.state?.(state);
    this.stands = state;
  }

  /**
   * Ask; what changes the same thing as the one before that waits takes its place.
   * @param {Question} question
   */
  ask(question) {
    const last = this.waiting[this.waiting.length - 1];
    if (question.do === "set" && last?.do === "set") this.waiting.pop();
    if (["show", "ahead", "missing"].includes(question.do)) this.waiting = this.waiting.filter((one) => one.do !== question.do);
    const fields = question.do === "set" && last?.do === "set" ? { ...last.fields, ...question.fields } : question.fields;
    this.waiting.push({ ...question, fields });
    this.next();
  }

  /** Whether nothing is under way. */
  get idle() {
    return !this.asked && !this.waiting.length;
  }

  next() {
    document.body.dataset[this.name] = String(Boolean(this.asked || this.waiting.length));
    if (this.asked || this.socket?.readyState !== WebSocket.OPEN) return;
    this.asked = this.waiting.shift();
    if (!this.asked) return;
    this.number += 1;
    const now = this.now();
    this.asked.base = now.text;
    const message = JSON.stringify({ ...now, ...this.asked, base: undefined, n: this.number });
    if (new Blob([message]).size < LONGEST_MESSAGE) this.socket.send(message);
    else this.answered({ n: this.number, long: true });
  }

  /** @param {Answer} answer */
  answered(answer) {
    const question = answer.n === this.number ? this.asked : undefined;
    if (answer.n !== undefined) this.asked = undefined;
    this.heard(answer, question);
    this.next();
  }
}
