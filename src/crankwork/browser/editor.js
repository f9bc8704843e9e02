// The machine file as text: numbers of its lines, those that are refused marked.

export class Editor {
  /**
   * @param {HTMLTextAreaElement} source
   * @param {HTMLElement} lines
   * @param {(text: string, ends: boolean) => void} typed
   */
  constructor(source, lines, typed) {
    this.source = source;
    this.lines = lines;
    /** @type {Set<number>} */
    this.refused = new Set();
    let timer = 0;
    const ended = () => {
      if (timer) typed(source.value, true);
      timer = 0;
    };
    source.addEventListener("input", () => {
      this.number();
      typed(source.value, false);
      clearTimeout(timer);
      timer = window.setTimeout(ended, 800);
    });
    // whatever is clicked next is a gesture of its own
    source.addEventListener("blur", () => {
      clearTimeout(timer);
      ended();
    });
    source.addEventListener("scroll", () => (lines.scrollTop = source.scrollTop));
  }

  /** @param {string} text */
  show(text) {
    if (this.source.value === text) return;
    const { selectionStart, selectionEnd, scrollTop } = this.source;
    this.source.value = text;
    this.source.setSelectionRange(selectionStart, selectionEnd);
    this.source.scrollTop = scrollTop;
    this.number();
  }

  number() {
    const count = this.source.value.split("\n").length;
    const rows = Array.from({ length: count }, (_, k) => {
      const row = document.createElement("span");
      row.textContent = `${k + 1}\n`;
      row.classList.toggle("refused", this.refused.has(k + 1));
      return row;
    });
    this.lines.replaceChildren(...rows);
    this.lines.scrollTop = this.source.scrollTop;
  }

  /** @param {number[]} lines */
  blame(lines) {
    this.refused = new Set(lines);
    this.number();
  }

  /**
   * Go to a line.
   * @param {number} line
   */
  go(line) {
    const rows = this.source.value.split("\n");
    const start = rows.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
    this.source.focus();
    this.source.setSelectionRange(start, start + (rows[line - 1]?.length ?? 0));
    this.source.scrollTop = (line - 4) * (this.source.scrollHeight / rows.length);
  }
}
