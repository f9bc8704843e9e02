// The bar of the cursor: what starts and stops, the slider, its number, the choice of colours; keys that move it.
import { Motion } from "./machine.js";
import { nearest, placeOf } from "./numbers.js";

/** @typedef {import("./cursor.js").Cursor} Cursor */

/**
 * Bind what stands on the bar: the button that starts and stops, the slider, its number, the choice of colours.
 * @param {Cursor} cursor
 * @param {import("./numbers.js").Column} axis
 * @param {number} seconds
 * @param {boolean} turns
 */
export function bar(cursor, axis, seconds, turns) {
  const slider = /** @type {HTMLInputElement | null} */ (document.getElementById("slider"));
  const shown = document.getElementById("shown");
  const play = /** @type {HTMLButtonElement | null} */ (document.getElementById("play"));
  if (!slider || !shown || !play) return undefined;
  const motion = new Motion(cursor, play, seconds, turns);
  slider.max = String(cursor.stops.length - 1);
  slider.addEventListener("input", () => cursor.snap(cursor.stops[Number(slider.value)]));
  cursor.follow(() => {
    slider.value = String(nearest(cursor.stops, cursor.at));
    const text = placeOf(cursor, axis);
    shown.innerHTML = `${axis.symbol} = ${text}`;
    slider.setAttribute("aria-valuetext", text);
  });
  const keyed = (/** @type {KeyboardEvent} */ event) => {
    // another bar stands in its place
    if (!play.isConnected) return document.removeEventListener("keydown", keyed);
    const target = /** @type {Element} */ (event.target);
    if (event.ctrlKey || event.altKey || event.metaKey || target.closest("input, select, textarea, button, summary, [role=button]")) return;
    if (event.key === "ArrowRight") cursor.step(1);
    else if (event.key === "ArrowLeft") cursor.step(-1);
    else if (event.key === "Home") cursor.snap(cursor.stops[0]);
    else if (event.key === " " && !target.closest("a")) play.click();
    else return;
    event.preventDefault();
  };
  document.addEventListener("keydown", keyed);
  const look = document.getElementById("look");
  look?.addEventListener("click", () => {
    const root = document.documentElement;
    const dark = root.dataset.look ? root.dataset.look === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.look = dark ? "light" : "dark";
  });
  return motion;
}
