"""The look of a note in a browser, on the screen and on paper."""

from __future__ import annotations

STYLE = """
body { margin: 0; background: var(--ground); color: var(--ink); font: 17px/1.45 "Libertinus Serif", "Times New Roman",
  Tinos, "Liberation Serif", "Noto Serif", "DejaVu Serif", serif; }
main { max-width: 50rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
math { font-family: "Libertinus Math", "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre",
  math, serif; font-size: 1em; }
mi.slanted { font-style: italic; }
h1 { font-size: 1.9rem; line-height: 1.2; }
h2 { font-size: 1.35rem; margin: 2.2em 0 .6em; }
h3 { font-size: 1.12rem; margin: 1.8em 0 .5em; }
h4 { font-size: 1rem; margin: 1.5em 0 .4em; }
h2, h3, h4 { break-after: avoid; }
header.title { text-align: center; display: flex; flex-direction: column; justify-content: space-between; gap: 3rem;
  min-height: 80vh; padding: 4vh 0; overflow-wrap: anywhere; }
header.title:not(:has(.institution)) { justify-content: space-around; min-height: 0; }
header.title p { margin: .3em 0; }
.institution, .above, .subtitle { font-size: 1.2rem; }
.people { align-self: flex-end; text-align: left; width: 75%; border-spacing: .7em .5em; }
.people td { vertical-align: bottom; }
.people td:first-child { white-space: nowrap; }
.people .sign { min-width: 7em; border-bottom: 1px solid #444; }
nav .contents { font-size: 1.35rem; font-weight: bold; margin: 0 0 .5em; }
nav ul { list-style: none; padding: 0; }
nav .level2 { padding-left: 1.2em; }
nav a { color: inherit; text-decoration: none; }
nav a:hover, nav a:focus { text-decoration: underline; }
ul { list-style: "–  "; padding-left: 1.4em; }
.equation { display: flex; align-items: center; gap: 1rem; margin: .9em 0; break-inside: avoid; }
.lines { flex: 1; overflow-x: auto; overflow-y: hidden; padding: .15em 0; }
.lines math { margin: .35em 0; }
.mark { white-space: nowrap; }
.lines:has(math + math) + .mark { align-self: flex-end; padding-bottom: .5em; }
.legend { border-spacing: 0; margin: .3em 0 .9em; }
.legend td { padding: 0 .5em 0 0; vertical-align: baseline; }
.table { margin: 1.6em 0; }
.table table { border-collapse: collapse; margin: 0 auto; font-size: .82rem; line-height: 1.25;
  font-variant-numeric: lining-nums tabular-nums; }
.table caption { text-align: left; font-size: 1rem; padding-bottom: .4em; }
.table th, .table td { border: 1px solid var(--g6); padding: .15em .45em; text-align: right; white-space: nowrap; }
.table td.left { text-align: left; white-space: normal; }
.table td.centre { text-align: center; }
.table th { text-align: center; font-weight: normal; background: var(--g19); }
figure { margin: 1.6em 0; text-align: center; break-inside: avoid; }
figure svg { max-width: 100%; height: auto; }
figcaption { margin-top: .5em; }
@media screen {
  .table thead th { position: sticky; top: 0; box-shadow: inset 0 1px var(--g6), inset 0 -1px var(--g6); }
  .wide { position: relative; left: 50%; width: max-content; max-width: 96vw; transform: translateX(-50%); }
}
/* a narrow screen: the number below its formula, which has the whole width and scrolls, a shadow at the edge behind
   which it goes on; tables scroll too */
@media screen and (max-width: 44rem) {
  .equation { flex-wrap: wrap; gap: 0 1rem; }
  .lines { flex: 1 0 100%; max-width: 100%; background:
    linear-gradient(90deg, var(--ground) 50%, transparent) 0 0 / 2.5rem 100% no-repeat local,
    linear-gradient(270deg, var(--ground) 50%, transparent) 100% 0 / 2.5rem 100% no-repeat local,
    linear-gradient(90deg, #0003, #0000) 0 0 / .6rem 100% no-repeat scroll,
    linear-gradient(270deg, #0003, #0000) 100% 0 / .6rem 100% no-repeat scroll; }
  .lines math { font-size: .82em; }
  .mark { margin-left: auto; }
  .table, .wide { position: static; width: auto; max-width: 100%; transform: none; overflow-x: auto; }
  .table thead th { position: static; box-shadow: none; }
}
@media screen {
  h2, h3, h4, figure { scroll-margin-top: 3.5rem; }
  .live .table thead th { top: 2.9rem; }
  #machine .drawing { max-height: 70vh; }
}
/* the contents stand beside where there is room */
@media screen and (min-width: 82rem) {
  .live nav { position: fixed; inset: 3rem auto 0 0; width: 17rem; overflow: auto; padding: 0 1rem; font-size: .85rem; }
  .live main { margin-left: max(19rem, calc(50vw - 25rem)); }
}
@page { size: A4; margin: 20mm 15mm 20mm 25mm; }
@page wide { size: A4 landscape; margin: 25mm 20mm 15mm; }
@media print {
  body { font-size: 12pt; }
  main { max-width: none; padding: 0; }
  header.title { min-height: 250mm; padding: 0; break-after: page; }
  .page { break-after: page; }
  .wide { page: wide; }
  .wide table { font-size: 8pt; }
  thead { display: table-header-group; }
  tr { break-inside: avoid; }
  .table caption { break-after: avoid; }
}
"""
