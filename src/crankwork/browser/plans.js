// Plans of positions as the sliders have made them: lines between joints, and what stands beside one.

/**
 * Scale [mm/m] and origin [mm] of the paper; of each item its corners, or the joint that it stays beside: columns of the
 * place, crank angle, where it was [mm].
 * @typedef {{scale: number, origin: [number, number], items: Record<string, [string, string, number, number, number][]>}} Upon
 */

export class Plans {
  /**
   * @param {SVGSVGElement} svg
   * @param {Upon} data
   */
  constructor(svg, data) {
    this.data = data;
    this.items = Object.entries(data.items).flatMap(([mark, corners]) => {
      const group = svg.querySelector(`g[class="upon ${mark}"]`);
      const path = group?.querySelector("path");
      return group ? [{ group, corners, path, d: path?.getAttribute("d") ?? "" }] : [];
    });
  }

  /** @param {import("./calculation.js").Calculation} calculation */
  follow(calculation) {
    const { scale, origin } = this.data;
    const at = (/** @type {string} */ key, /** @type {number} */ degrees, /** @type {number} */ side, /** @type {number} */ was) => {
      const row = calculation.data.columns[key];
      if (row === undefined) return was;
      return origin[side] + (side ? -scale : scale) * calculation.cycle.at(calculation.nodesOf(row), degrees);
    };
    for (const { group, corners, path, d } of this.items) {
      const places = corners.map(([x, y, degrees, right, down]) => [at(x, degrees, 0, right), at(y, degrees, 1, down)]);
      if (path && corners.length > 1) {
        path.setAttribute("d", `M${places.map((one) => one.map((side) => side.toFixed(2)).join(" ")).join("L")}${/z$/i.test(d) ? "z" : ""}`);
      } else {
        const [[x, y], [, , , right, down]] = [places[0], corners[0]];
        group.setAttribute("transform", `translate(${(x - right).toFixed(2)} ${(y - down).toFixed(2)})`);
      }
    }
  }

  /** Go back to what the page was written with. */
  back() {
    for (const { group, path, d } of this.items) {
      group.removeAttribute("transform");
      path?.setAttribute("d", d);
    }
  }
}
