"""Result keys of earlier versions: what they are called today, for one release."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

# the same value under another key
RENAMED: Mapping[str, str] = MappingProxyType(
    {
        "mean_total_torque": "mean_torque",
        "mean_total_torque.indicated": "mean_torque.indicated",
        "engine_indicated_power": "indicated_power",
        "total_reduced_inertia": "reduced_inertia",
        "total_reduced_inertia_1": "reduced_inertia_1",
    }
)
# keys that were those of cylinder 1 in an engine and are those of the machine; the key of the cylinder's value
MOVED: Mapping[str, str] = MappingProxyType(
    {key: f"{key}.1" for key in ("mean_torque", "indicated_power", "reduced_inertia", "reduced_inertia_1")}
)
