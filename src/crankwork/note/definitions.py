"""Definitions of values without a formula: integrals over the cycle, which are found numerically."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from crankwork.note.layout import SPACE, Box, Fence, Fraction, Row, Sign, Upright, row
from crankwork.note.symbols import symbol_box
from crankwork.quantities import QUANTITIES, Language
from crankwork.quantities.key import key_of

# mean over the cycle: of which quantity
_MEANS: Mapping[str, str] = MappingProxyType(
    {
        "mean_torque": "crank_torque",
        "mean_driving_torque": "static_torque",
        "mean_total_torque": "total_torque",
        "mean_crankpin_load": "crankpin_load",
        "mean_bearing_load": "bearing_load",
    }
)


def definition_box(key: str, language: Language) -> Box | None:
    """Return the definition of a value, None where there is none to print."""
    kind = key_of(key).quantity
    if kind == "indicated_work":
        return row(Upright("∮"), _over("diagram_pressure", "cylinder_volume", language))
    if key == "excess_work":
        energy = _symbol("kinetic_energy_change", language)
        return row(Upright("max"), SPACE, energy, Sign("−"), Upright("min"), SPACE, energy)
    if key == "excess_work.exact":
        return row(_tangent("max", language), Sign("−"), _tangent("min", language))
    if kind in _MEANS:
        share = Fraction(Upright("1"), _symbol("cycle_angle", language))
        return row(share, Upright("∫"), _over(_MEANS[kind], "crank_angle", language))
    return None


def definition_text(key: str, language: Language) -> str:
    """Return the definition as one line of text, empty where there is none."""
    kind = key_of(key).quantity
    named = (*_MEANS, *_MEANS.values(), "crank_angle", "cycle_angle", "kinetic_energy_change")
    names = {name: QUANTITIES[name].symbol(language) for name in named}
    if kind == "indicated_work":
        return f"∮ {QUANTITIES['diagram_pressure'].symbol(language)} d{QUANTITIES['cylinder_volume'].symbol(language)}"
    if key == "excess_work":
        return f"max {names['kinetic_energy_change']} − min {names['kinetic_energy_change']}"
    if key == "excess_work.exact":
        slope, inertia = (QUANTITIES[name].symbol(language) for name in ("wittenbauer_slope", "total_reduced_inertia"))
        return " − ".join(
            f"{end}({names['kinetic_energy_change']} − {inertia}·{slope}_{end})" for end in ("max", "min")
        )
    if kind in _MEANS:
        return f"1/{names['cycle_angle']}·∫ {names[_MEANS[kind]]} d{names['crank_angle']}"
    return ""


# of which torque the kinetic energy takes what is beyond the mean: its mean, and the sign that it has there
_BEYOND = {"total_torque": ("mean_total_torque", ""), "static_torque": ("mean_driving_torque", "−")}


def integral_text(torque_key: str, language: Language) -> str:
    """Return the integral of a torque beyond its mean over the crank angle, empty for other keys."""
    if torque_key not in _BEYOND:
        return ""
    mean, sign = _BEYOND[torque_key]
    torque, mean, phi = (QUANTITIES[name].symbol(language) for name in (torque_key, mean, "crank_angle"))
    return f"{sign}∫({torque} − {mean}) d{phi}"


def _tangent(end: str, language: Language) -> Row:
    """Return an end of what a tangent cuts off: max (ΔT − J tan ψ_max)."""
    tangent = symbol_box(f"{QUANTITIES['wittenbauer_slope'].symbol(language)}_{end}")
    energy, inertia = _symbol("kinetic_energy_change", language), _symbol("total_reduced_inertia", language)
    return row(Upright(end), SPACE, Fence(row(energy, Sign("−"), inertia, SPACE, tangent)))


def _over(key: str, variable: str, language: Language) -> Row:
    return row(SPACE, _symbol(key, language), SPACE, Upright("d"), _symbol(variable, language))


def _symbol(key: str, language: Language) -> Box:
    return symbol_box(QUANTITIES[key].symbol(language))
