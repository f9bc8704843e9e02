"""The version is the same wherever it stands."""

from __future__ import annotations

import re
import tomllib

import crankwork


def test_version_is_the_same_everywhere(root):
    project = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]
    released = re.search(r"^## \[?(\d+\.\d+\.\d+)", (root / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    cited = re.search(r"^version: (\S+)$", (root / "CITATION.cff").read_text("utf-8"), re.MULTILINE)
    assert released is not None
    assert cited is not None
    assert {project["version"], released[1], cited[1]} == {crankwork.__version__}
