const film = document.documentElement, moves = film.getAnimations({subtree: true});
let runs = !matchMedia("(prefers-reduced-motion: reduce)").matches;
const play = on => {
  const now = moves[0].currentTime;
  runs = on;
  // a time that is set holds at once
  moves.forEach(one => { if (on) one.play(); else { one.pause(); one.currentTime = now; } });
};
const share = () => (moves[0].currentTime / TIME + REST) % 1;
const go = to => { play(false); moves.forEach(one => { one.currentTime = (to - REST + 2) * TIME; }); };
const step = by => go((Math.round(share() * FRAMES) + by) / FRAMES);
const box = film.viewBox.baseVal, foot = box.height, left = 13, wide = box.width - 21;
const add = (name, of) => {
  const one = film.appendChild(document.createElementNS(film.namespaceURI, name));
  Object.entries(of).forEach(pair => one.setAttribute(...pair));
  return one;
};
film.setAttribute("viewBox", `0 0 ${box.width} ${foot + 9}`);
film.setAttribute("height", `${foot + 9}mm`);
film.setAttribute("style", "max-width:100vw;max-height:100vh;user-select:none");
const ground = film.appendChild(film.querySelector("rect").cloneNode());
ground.setAttribute("y", foot);
ground.setAttribute("height", 9);
const button = add("path", {id: "play", style: "cursor:pointer", "pointer-events": "bounding-box"});
const track = {x: left, width: wide, style: "cursor:pointer"};
add("rect", {...track, y: foot + 4.2, height: 0.6});
const knob = add("circle", {cy: foot + 4.5, r: 1.6});
const slide = add("rect", {...track, id: "slide", y: foot + 1, height: 7, "fill-opacity": 0});
const shown = () => {
  button.setAttribute("d", `M6 ${foot + 2}` + (runs ? "h1.6v5h-1.6zm3 0h1.6v5h-1.6z" : "v5l4.4-2.5z"));
  knob.setAttribute("cx", left + share() * wide);
  requestAnimationFrame(shown);
};
shown();
const scrub = event => {
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(film.getScreenCTM().inverse());
  go(Math.min(Math.max((at.x - left) / wide, 0), 1 - 1 / FRAMES));
};
slide.addEventListener("pointerdown", event => { slide.setPointerCapture(event.pointerId); scrub(event); });
slide.addEventListener("pointermove", event => event.buttons && scrub(event));
slide.addEventListener("click", event => event.stopPropagation());
addEventListener("click", () => play(!runs));
addEventListener("keydown", event => {
  const by = {ArrowRight: 1, ArrowLeft: -1, ArrowUp: 10, ArrowDown: -10}[event.key];
  if (event.key === " ") play(!runs); else if (by) step(by); else return;
  event.preventDefault();
});
