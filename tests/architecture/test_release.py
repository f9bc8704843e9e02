"""The version stands once, in the package; what repeats it for readers agrees with it."""

from __future__ import annotations

import re
import tomllib

import crankwork
from crankwork.quantities.key import MOVED, RENAMED


def test_version_and_date_are_the_same_everywhere(root):
    settings = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))
    assert "version" in settings["project"]["dynamic"]
    assert settings["tool"]["hatch"]["version"] == {"path": "src/crankwork/version.py"}
    released = re.search(r"^## \[(\d+\.\d+\.\d+)\] - (\S+)$", (root / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    cited = re.search(
        r'^version: (\S+)\ndate-released: "(\S+)"$', (root / "CITATION.cff").read_text("utf-8"), re.MULTILINE
    )
    assert released is not None
    assert cited is not None
    assert released.groups() == cited.groups()
    assert released[1] == crankwork.__version__


def test_the_changelog_names_every_key_that_means_something_else_now(root):
    text = (root / "CHANGELOG.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+(?:\.\w+)?)`(.*) \| `(\S+)` \|$", text, re.MULTILINE)
    assert {old: new for old, owner, new in rows if not owner} == dict(RENAMED)
    assert {old: new for old, owner, new in rows if owner == " of cylinder 1"} == dict(MOVED)
