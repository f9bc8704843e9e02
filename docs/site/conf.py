"""Sphinx's settings of the documentation site, whose pages `docs/generate/make_site.py` brings together."""

from pathlib import Path

project = "crankwork"
author = "crankwork contributors"
html_title = "crankwork"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "markdown"}
# what pages show or include
exclude_patterns = ["examples", "README.md", "guide/conventions.md"]
html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "native"
myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence"]
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_format = "short"
napoleon_numpy_docstring = True
napoleon_google_docstring = False
nitpicky = False

# what the theme leaves out for those who cannot see the page, or have no mouse
_NAMED = {
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="Pages">',
    '<aside class="toc-drawer">': '<aside class="toc-drawer" aria-label="On this page">',
    '<p class="caption" role="heading">': '<p class="caption" role="heading" aria-level="2">',
    "<pre>": '<pre tabindex="0">',
}


def _named(app: object, error: Exception | None) -> None:
    for page in Path(app.outdir).rglob("*.html") if error is None else ():
        written = page.read_text(encoding="utf-8")
        for left_out, named in _NAMED.items():
            written = written.replace(left_out, named)
        page.write_text(written, encoding="utf-8")


def setup(app: object) -> None:
    """Name the parts of every page that has been written."""
    app.connect("build-finished", _named)
