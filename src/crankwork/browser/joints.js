// A linkage as the sliders have made it: joints where the calculation has them, links between, labels beside.

/** @typedef {import("./machine.js").Film} Film */
/** @typedef {import("./sliders.js").Live} Live */

/**
 * Scale [mm/m] and origin [mm] of the paper, columns of joints that move by parts of the film, joints of each link,
 * of each label its joint and how far to the right and down it stands.
 * @typedef {{scale: number, origin: [number, number], joints: Record<string, [string, string]>,
 *   links: Record<string, string[]>, labels: Record<string, [string, number, number]>}} JointsData
 */

// room around what moves [mm]
const AROUND = 8;

export class Joints {
  /**
   * @param {Film} film
   * @param {Live} live
   * @param {JointsData} data
   */
  constructor(film, live, data) {
    this.film = film;
    this.live = live;
    this.data = data;
    const part = (/** @type {string} */ name) => /** @type {SVGGElement} */ (film.svg.querySelector(`[data-part="${CSS.escape(name)}"]`));
    this.links = Object.entries(data.links).map(([name, joints]) => {
      const group = part(name);
      const used = group.querySelector("use")?.getAttribute("href");
      const path = (used ? film.svg.querySelector(used) : group)?.querySelector("path");
      const own = /** @type {SVGPathElement} */ (path?.cloneNode());
      const end = /z$/i.test(own.getAttribute("d") ?? "") ? "z" : "";
      return { group, joints, own, end, home: [group.innerHTML, group.getAttribute("transform") ?? ""] };
    });
    const named = (/** @type {string} */ start) => [...film.svg.querySelectorAll(`[data-part^="${start}"]`)];
    this.groups = new Map([...named("joint."), ...named("text."), ...named("block.")].map((one) => [/** @type {SVGGElement} */ (one).dataset.part ?? "", one]));
    this.homes = [...this.groups.values()].map((one) => ({ one, at: one.getAttribute("transform") ?? "" }));
    // circles of cranks are those of the file
    for (const one of film.svg.querySelectorAll(":scope > path[stroke-dasharray]")) one.classList.add("gone");
    this.box = film.svg.getAttribute("viewBox") ?? "";
    /** Whether links are drawn between joints. */
    this.drawn = false;
  }

  /**
   * Return where a joint is at a crank angle. [mm]
   * @param {string} name
   * @param {number} degrees
   * @returns {[number, number]}
   */
  place(name, degrees) {
    const { calculation } = this.live;
    const [x, y] = this.film.place(name, this.film.frame(degrees)) ?? [0, 0];
    const keys = this.data.joints[name];
    if (!keys) return [x, y];
    const rows = keys.map((key) => calculation.data.columns[key]);
    const at = (/** @type {number} */ side) => calculation.cycle.at(calculation.nodesOf(rows[side]), degrees) * this.data.scale;
    return [rows[0] === undefined ? x : this.data.origin[0] + at(0), rows[1] === undefined ? y : this.data.origin[1] - at(1)];
  }

  /** Make room for where the joints go. */
  fit() {
    const { svg } = this.film;
    if (!this.live.moved) {
      svg.setAttribute("viewBox", this.box);
      return;
    }
    const { calculation } = this.live;
    let [left, top, right, bottom] = this.box.split(" ").map(Number);
    [right, bottom] = [left + right, top + bottom];
    for (const keys of Object.values(this.data.joints)) {
      const [x, y] = keys.map((key) => calculation.data.columns[key]).map((row) => (row === undefined ? [] : calculation.nodesOf(row)));
      for (const one of x) {
        const at = this.data.origin[0] + one * this.data.scale;
        [left, right] = [Math.min(left, at - AROUND), Math.max(right, at + AROUND)];
      }
      for (const one of y) {
        const at = this.data.origin[1] - one * this.data.scale;
        [top, bottom] = [Math.min(top, at - AROUND), Math.max(bottom, at + AROUND)];
      }
    }
    svg.setAttribute("viewBox", [left, top, right - left, bottom - top].map((one) => one.toFixed(1)).join(" "));
  }

  /** @param {number} degrees */
  draw(degrees) {
    if (!this.live.moved) {
      if (this.drawn) this.back(degrees);
      return;
    }
    this.drawn = true;
    const places = new Map([...this.groups.keys()].filter((one) => one.startsWith("joint.")).map((one) => [one, this.place(one, degrees)]));
    for (const [name, [x, y]] of places) this.groups.get(name)?.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
    for (const [name, group] of this.groups) {
      if (name.startsWith("joint.")) continue;
      const [joint, right, down] = this.data.labels[name] ?? ["", 0, 0];
      const place = places.get(joint);
      group.toggleAttribute("hidden", !place);
      // its own direction stays
      const turned = group.getAttribute("transform")?.match(/rotate.*/)?.[0] ?? "";
      if (place) group.setAttribute("transform", `translate(${(place[0] + right).toFixed(2)} ${(place[1] + down).toFixed(2)})${turned}`);
    }
    for (const { group, joints, own, end } of this.links) {
      own.setAttribute("d", `M${joints.map((one) => places.get(one)?.map((at) => at.toFixed(2)).join(" ")).join("L")}${end}`);
      group.removeAttribute("transform");
      if (group.firstChild !== own) group.replaceChildren(own);
    }
  }

  /**
   * Go back to what the page was written with.
   * @param {number} degrees
   */
  back(degrees) {
    this.drawn = false;
    for (const { one, at } of this.homes) {
      one.removeAttribute("hidden");
      one.setAttribute("transform", at);
    }
    for (const { group, home } of this.links) {
      group.innerHTML = home[0];
      group.setAttribute("transform", home[1]);
    }
    this.film.draw(this.film.frame(degrees));
  }
}
