// The page of a machine with sliders: what they move follows, what is seen first.
import { FollowingFigure } from "./following.js";
import { Joints } from "./joints.js";
import { Lines } from "./lines.js";
import { openStored } from "./opened.js";
import { bindSliders, Live } from "./sliders.js";

openStored(FollowingFigure, slide);

/** @param {import("./opened.js").Opened} opened */
function slide({ data, columns, cursor, figures, film, explanation, tables, show }) {
  const moves = document.getElementById("sliders");
  // a page with sliders has the steps of its calculation before this script
  const { steps } = /** @type {{steps?: import("./calculation.js").Steps}} */ (globalThis);
  if (moves && data.sliders && steps) {
    const live = new Live(data.sliders, steps, columns);
    const lines = new Lines(live.calculation, data.film?.degrees ?? 1);
    const late = whenSeen([
      ...figures.filter((one) => one instanceof FollowingFigure).filter((one) => one.follows).map((one) => ({ at: one.svg, show: () => (live.moved ? one.follow(lines) : one.back()) })),
      ...(tables && show ? [{ at: tables, show }] : []),
    ]);
    const joints = film && data.sliders.joints ? new Joints(film, live, data.sliders.joints) : undefined;
    cursor.follow(() => joints?.draw(cursor.at * (data.film?.degrees ?? 1)));
    bindSliders(moves, live, () => {
      late();
      joints?.fit();
      explanation?.follow(live);
      if (!cursor.runs) cursor.move(cursor.at);
    });
  }
}

/**
 * Return what shows things anew: those that are seen at once, others when they come into view.
 * @param {{at: Element, show: () => void}[]} every
 */
function whenSeen(every) {
  const late = new Set(every);
  const seen = new Set();
  const watch = new IntersectionObserver((found) => {
    for (const { target, isIntersecting } of found) {
      const one = every.find(({ at }) => at === target);
      if (!one) continue;
      if (!isIntersecting) seen.delete(one);
      else {
        seen.add(one);
        if (late.delete(one)) one.show();
      }
    }
  }, { rootMargin: "200px" });
  late.clear();
  for (const { at } of every) watch.observe(at);
  addEventListener("beforeprint", () => {
    for (const one of late) one.show();
    late.clear();
  });
  return () => {
    for (const one of every) {
      if (seen.has(one)) one.show();
      else late.add(one);
    }
  };
}
