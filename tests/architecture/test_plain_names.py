"""Names of the source are plain: private words and variables that say nothing become fewer in every package."""

from __future__ import annotations

from architecture.plain_names import counts, listed


def test_plain_names_become_no_fewer() -> None:
    """No package has more names that should change than the list says, and the list is as low as it can be."""
    found, allowed = counts(), listed()
    assert {package: count for package, count in found.items() if count > allowed.get(package, 0)} == {}
    assert {package: count for package, count in allowed.items() if count != found[package]} == {}, (
        "write what `PYTHONPATH=tests python tests/architecture/plain_names.py` prints into plain_names.txt"
    )
