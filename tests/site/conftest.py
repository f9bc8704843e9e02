"""The generators of the documentation site, which stand outside the package."""

import sys
from pathlib import Path

GENERATORS = Path(__file__).parents[2] / "docs" / "generate"
sys.path.insert(0, str(GENERATORS))
