"""How schools round the corners of an indicator diagram: one record each, with its source."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

from crankwork.resources import read_resource

SCHOOLS: Mapping[str, Any] = tomllib.loads(read_resource("working_cycle", "schools.toml"))
# greatest pressure of a rounded diagram over that of the sharp one, by kind of engine
PEAK_LEVEL: Mapping[str, float] = SCHOOLS["peak_level"]
