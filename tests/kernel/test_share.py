"""Which single values of the machines at hand compile for a sweep over two lengths and the speed."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

import crankwork
from crankwork.description.document import Description
from crankwork.kernel import compiled

CAMPAIGN = runpy.run_path(str(Path(__file__).with_name("campaign.py")))
compared, numbers = CAMPAIGN["compared"], CAMPAIGN["numbers"]
TEMPLATES = Path(crankwork.__file__).parent / "description" / "templates"
EXAMPLES = Path(__file__).parents[2] / "examples"
FILES = sorted(EXAMPLES.glob("*.toml")) + sorted(TEMPLATES.glob("*.toml"))
LENGTHS = (".radius", ".stroke", ".length", ".ratio", ".bore")
# Of these a part does not compile, by the reason.
# The list may only get shorter.
NOT_COMPILED: dict[str, tuple[int, set[str]]] = {
    "examples-narrow-v6": (2, {"procedure"}),
    "examples-press-start": (4, {"procedure"}),
    "examples-punching-machine": (26, {"ways"}),
    "examples-radial-five": (6, {"procedure"}),
    "examples-triplex-pump": (3, {"differs", "procedure"}),
    "examples-two-stroke": (58, {"procedure"}),
    "templates-chebyshev": (1, {"direction"}),
    "templates-klann": (1, {"direction"}),
    "templates-press": (1, {"differs"}),
    "templates-toggle-press": (1, {"differs"}),
    "templates-watt-straight-line": (5, {"direction"}),
}


@pytest.fixture(autouse=True)
def by_arrays(monkeypatch):
    monkeypatch.setattr(compiled, "compiles", lambda: False)


def fields_of(path):
    """Return two lengths and the speed of a machine, as far as it has them."""
    keys = [key for key, _ in numbers(Description(path.read_text(encoding="utf-8")))]
    lengths = [key for key in keys if key.endswith(LENGTHS) and not key.startswith(("flywheel", "friction", "table"))]
    return [*lengths[:2], *(key for key in keys if key == "crank.speed")]


@pytest.mark.slow
@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_single_values_compile_but_for_a_list_that_shrinks(path):
    found = compared(path.stem, path.read_text(encoding="utf-8"), 1, fields_of(path))
    reasons = {reason.partition(":")[0] for reason in found.reasons.values()}
    assert (len(found.reasons), reasons) == NOT_COMPILED.get(f"{path.parent.name}-{path.stem}", (0, set()))
