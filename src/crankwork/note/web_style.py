"""The look of a note in a browser, on the screen and on paper."""

from __future__ import annotations

STYLE = """
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #000; font: 17px/1.45 "Libertinus Serif", "Times New Roman", Tinos,
  "Liberation Serif", "Noto Serif", "DejaVu Serif", serif; }
main { max-width: 50rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
math { font-family: "Libertinus Math", "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre",
  math, serif; font-size: 1em; }
mi.slanted { font-style: italic; }
h1 { font-size: 1.9rem; line-height: 1.2; }
h2 { font-size: 1.35rem; margin: 2.2em 0 .6em; }
h3 { font-size: 1.12rem; margin: 1.8em 0 .5em; }
h4 { font-size: 1rem; margin: 1.5em 0 .4em; }
h2, h3, h4 { break-after: avoid; }
header.title { text-align: center; padding: 12vh 0 8vh; }
header.title p { margin: .3em 0; }
.subtitle { font-size: 1.2rem; }
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
.table th, .table td { border: 1px solid #444; padding: .15em .45em; text-align: right; white-space: nowrap; }
.table td.left { text-align: left; white-space: normal; }
.table td.centre { text-align: center; }
.table th { text-align: center; font-weight: normal; background: #f2f2f2; }
figure { margin: 1.6em 0; text-align: center; break-inside: avoid; }
figure svg { max-width: 100%; height: auto; }
figcaption { margin-top: .5em; }
@media screen {
  .table thead th { position: sticky; top: 0; box-shadow: inset 0 1px #444, inset 0 -1px #444; }
  .wide { position: relative; left: 50%; width: max-content; max-width: 96vw; transform: translateX(-50%); }
}
/* a narrow screen: the number below its formula, which has the whole width and scrolls, a shadow at the edge behind
   which it goes on; tables scroll too */
@media screen and (max-width: 44rem) {
  .equation { flex-wrap: wrap; gap: 0 1rem; }
  .lines { flex: 1 0 100%; max-width: 100%; background:
    linear-gradient(90deg, #fff 50%, #fff0) 0 0 / 2.5rem 100% no-repeat local,
    linear-gradient(270deg, #fff 50%, #fff0) 100% 0 / 2.5rem 100% no-repeat local,
    linear-gradient(90deg, #0003, #0000) 0 0 / .6rem 100% no-repeat scroll,
    linear-gradient(270deg, #0003, #0000) 100% 0 / .6rem 100% no-repeat scroll; }
  .lines math { font-size: .82em; }
  .mark { margin-left: auto; }
  .table, .wide { position: static; width: auto; max-width: 100%; transform: none; overflow-x: auto; }
  .table thead th { position: static; box-shadow: none; }
}
@page { size: A4; margin: 20mm 15mm 20mm 25mm; }
@page wide { size: A4 landscape; margin: 25mm 20mm 15mm; }
@media print {
  body { font-size: 12pt; }
  main { max-width: none; padding: 0; }
  header.title { padding: 30vh 0 0; break-after: page; }
  .page { break-after: page; }
  .wide { page: wide; }
  .wide table { font-size: 8pt; }
  thead { display: table-header-group; }
  tr { break-inside: avoid; }
  .table caption { break-after: avoid; }
}
"""
