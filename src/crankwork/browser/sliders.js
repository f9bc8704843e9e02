// Numbers of the machine file that the reader moves; the calculation is done anew, and what shows it follows.
import { Calculation } from "./calculation.js";
import { printed } from "./numbers.js";

/** @typedef {import("./calculation.js").CalculationData} CalculationData */
/** @typedef {import("./calculation.js").Steps} Steps */
/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./numbers.js").Column} Column */

/**
 * Of each field what it is in the file [SI], and what takes a number in its unit to SI; the calculation; factors that
 * take columns to their units, factor and what is added of single values, and what of them is rounding [SI], keys that cannot be
 * calculated, which of the further crank angles are those of the tables, what polynomials may leave out where a machine hardly
 * moves any more, joints of a linkage.
 * @typedef {{fields: {now: number, scale: number, origin: number}[], calculation: CalculationData,
 *   columns: Record<string, number>, values: Record<string, [number, number, number]>, filed: string[], rows: number[], far: number,
 *   joints?: import("./joints.js").JointsData}} SlidersData
 */

/** What follows the sliders: told at each move, and where nothing is moved any more. */
export class Live {
  /**
   * @param {SlidersData} data
   * @param {Steps} steps
   * @param {Record<string, Column>} columns those of the tables
   */
  constructor(data, steps, columns) {
    this.data = data;
    this.columns = columns;
    this.filed = new Set(data.filed);
    this.calculation = new Calculation(data.calculation, steps);
    this.design = data.fields.map((one) => one.now);
    /** Whether anything is moved. */
    this.moved = false;
    this.home = new Map(Object.keys(data.columns).map((key) => [key, columns[key]]));
    this.shown = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("[data-value]")]).map((one) => ({ one, text: one.textContent }));
  }

  /**
   * Calculate a design; return whether there is such a machine.
   * @param {number[]} design
   */
  take(design) {
    const { calculation, data } = this;
    calculation.run(design);
    const finite = (/** @type {number} */ row) => Number.isFinite(calculation.values[row]);
    if (calculation.leftOut > data.far || !Object.keys(data.values).every((key) => finite(data.calculation.values[key]))) {
      // what is drawn later is of the machine that is shown
      calculation.run(this.design);
      return false;
    }
    this.design = design;
    this.moved = design.some((one, k) => one !== data.fields[k].now);
    for (const [key, factor] of Object.entries(data.columns)) {
      const home = /** @type {Column} */ (this.home.get(key));
      this.columns[key] = this.moved ? { ...home, ...rounded(this.rows(key), factor) } : home;
    }
    document.documentElement.classList.toggle("moved", this.moved);
    for (const { one, text } of this.shown) {
      const key = one.dataset.value ?? "";
      const [factor, added, rounding] = data.values[key];
      const value = calculation.values[data.calculation.values[key]];
      one.textContent = this.moved ? printed((Math.abs(value) <= rounding ? 0 : value) * factor + added, one.closest(".cards") ? 4 : 6) : text;
    }
    return true;
  }

  /**
   * Return a column at the rows of the tables. [SI]
   * @param {string} key
   */
  rows(key) {
    const { calculation, data } = this;
    const { columns, values } = data.calculation;
    if (columns[key] === undefined) return data.rows.map(() => calculation.values[values[key]]);
    const every = calculation.rowsOf(columns[key]);
    return data.rows.map((one) => every[one]);
  }
}

/**
 * Return numbers of a column with as many decimals as give the largest five digits.
 * @param {number[]} values
 * @param {number} factor
 */
function rounded(values, factor) {
  let largest = 0;
  for (const one of values) largest = Math.max(largest, Math.abs(one * factor));
  const decimals = Math.min(Math.max(largest ? 4 - Math.floor(Math.log10(largest)) : 4, 0), 12);
  return { values: values.map((one) => one * factor), decimals };
}

/**
 * Bind the sliders and their boxes.
 * @param {HTMLElement} room
 * @param {Live} live
 * @param {() => void} follow what is done after each move
 */
export function bindSliders(room, live, follow) {
  const tell = /** @type {HTMLElement} */ (room.querySelector("#told"));
  const fields = live.data.fields.map((field, k) => {
    const slider = /** @type {HTMLInputElement} */ (room.querySelector(`[data-field="${k}"]`));
    const box = /** @type {HTMLInputElement} */ (room.querySelector(`[data-box="${k}"]`));
    return { ...field, slider, box, unit: box.nextElementSibling?.textContent ?? "", home: Number(slider.getAttribute("value")) };
  });
  const shown = fields.map(({ home }) => home);
  const write = () =>
    fields.forEach(({ slider, box, unit }, k) => {
      slider.value = String(shown[k]);
      box.value = printed(shown[k]);
      box.removeAttribute("aria-invalid");
      slider.setAttribute("aria-valuetext", `${box.value} ${unit}`.trim());
    });
  /** @param {number[]} wanted */
  const move = (wanted) => {
    const design = wanted.map((one, k) => (one === fields[k].home ? fields[k].now : one * fields[k].scale + fields[k].origin));
    const isThere = live.take(design);
    tell.textContent = isThere ? "" : tell.dataset.none ?? "";
    wanted.forEach((one, k) => (shown[k] = one));
    write();
    if (isThere) follow();
  };
  fields.forEach(({ slider, box, home }, k) => {
    const [low, high] = [Number(slider.min), Number(slider.max)];
    const step = 10 ** Math.floor(Math.log10((high - low) / 200));
    // what is wrong is told at the field
    const here = () => tell.parentElement !== box.parentElement && box.parentElement?.append(tell);
    const to = (/** @type {number} */ value) => {
      here();
      move(shown.map((one, at) => (at === k ? value : one)));
    };
    slider.addEventListener("input", () => {
      const value = Number((Math.round(slider.valueAsNumber / step) * step).toPrecision(12));
      to(Math.abs(value - home) < step / 2 ? home : Math.min(Math.max(value, low), high));
    });
    box.addEventListener("change", () => {
      const value = Number(box.value.trim().replace(",", ".").replace("−", "-"));
      if (box.value.trim() && value >= low && value <= high) {
        to(value);
        return;
      }
      here();
      box.setAttribute("aria-invalid", "true");
      tell.textContent = (tell.dataset.wrong ?? "").replace("{low}", printed(low)).replace("{high}", printed(high));
    });
  });
  room.querySelector("#filed")?.addEventListener("click", () => move(fields.map(({ home }) => home)));
  write();
}
