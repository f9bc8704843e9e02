"""Compares what pages with sliders calculate in a browser with analyses, for many designs of each page.

The comparison is that of `tests/page/test_sliders.py`, which takes a few designs.
"""

from __future__ import annotations

import argparse
import os
import sys

import pytest

from campaigns.marked import ROOT

TEST = "test_the_browser_calculates_what_analyses_give"


class MoreDesigns:
    """A plugin that lets the test draw more designs."""

    def __init__(self, count: int) -> None:
        self.count = count

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Change the number that the test reads."""
        for item in session.items:
            settings = item.module.SETTINGS  # type: ignore[attr-defined]
            settings.update(dict.fromkeys(settings, self.count))


def main() -> int:
    """Run the comparison."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="designs of each page")
    arguments = parser.parse_args()
    # without a browser nothing is compared, which is no success
    os.environ["CI"] = "true"
    words = [str(ROOT / "tests/page/test_sliders.py"), "-k", TEST, "-n", "0", "-v", "-p", "no:cacheprovider"]
    return int(pytest.main(words, plugins=[MoreDesigns(arguments.count)]))


if __name__ == "__main__":
    sys.exit(main())
