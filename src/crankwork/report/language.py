"""Words, units and numbers as each language prints them."""

from __future__ import annotations

import math
from collections.abc import Mapping

from crankwork.quantities import LANGUAGES, QUANTITIES, Language, base_key
from crankwork.report.engine_words import ENGINE_WORDS
from crankwork.units import from_si

_RUSSIAN_UNITS = {
    "m": "м", "mm": "мм", "cm2": "см²", "cm3": "см³", "deg": "°", "rad/s": "рад/с", "rad/s2": "рад/с²", "m/s": "м/с",
    "m/s2": "м/с²", "kg": "кг", "g/cm2": "г/см²", "kg*m2": "кг·м²", "MPa": "МПа", "N": "Н", "N*m": "Н·м",
    "J": "Дж", "kW": "кВт", "W": "Вт", "Hz": "Гц", "N/m": "Н/м", "rpm": "мин⁻¹",
    "kg/m3": "кг/м³", "kmol/kg": "кмоль/кг", "kg/kmol": "кг/кмоль", "kJ/kmol": "кДж/кмоль", "K": "К",
    "kJ/(kmol*K)": "кДж/(кмоль·К)", "g/(kW*h)": "г/(кВт·ч)", "kg/h": "кг/ч", "kW/l": "кВт/л", "l": "л",
    "MJ/kg": "МДж/кг", "kJ/kg": "кДж/кг", "g": "г",
    "MPa/deg": "МПа/°", "W/(m2*K)": "Вт/(м²·К)", "J/(kg*K)": "Дж/(кг·К)", "1/K": "К⁻¹", "m/(s*K)": "м/(с·К)",
}  # fmt: skip
_LATIN_UNITS = {
    "cm2": "cm²", "cm3": "cm³", "deg": "°", "rad/s2": "rad/s²", "m/s2": "m/s²", "g/cm2": "g/cm²",
    "kg*m2": "kg·m²", "N*m": "N·m",
    "kg/m3": "kg/m³", "kJ/(kmol*K)": "kJ/(kmol·K)", "g/(kW*h)": "g/(kW·h)",
    "MPa/deg": "MPa/°", "W/(m2*K)": "W/(m²·K)", "J/(kg*K)": "J/(kg·K)", "1/K": "K⁻¹", "m/(s*K)": "m/(s·K)",
}  # fmt: skip
_VIETNAMESE_UNITS = {**_LATIN_UNITS, "rpm": "vg/ph"}
_UNITS: Mapping[Language, Mapping[str, str]] = {"en": _LATIN_UNITS, "ru": _RUSSIAN_UNITS, "vi": _VIETNAMESE_UNITS}

# word: English, Russian, Vietnamese
_WORDS = {
    "max": ("largest {}", "{}: наибольшее значение", "{}: giá trị lớn nhất"),
    "min": ("smallest {}", "{}: наименьшее значение", "{}: giá trị nhỏ nhất"),
    "max_angle": ("at crank angle", "при угле поворота", "tại góc quay"),
    "error": ("largest error against exact, {}", "{}: наибольшая погрешность относительно точного решения",
              "{}: sai số lớn nhất so với kết quả chính xác"),
    "top_dead_centre": ("top dead centre", "верхняя мёртвая точка", "điểm chết trên"),
    "bottom_dead_centre": ("bottom dead centre", "нижняя мёртвая точка", "điểm chết dưới"),
    "method": ("method", "метод", "phương pháp"),
    "summary": ("Summary", "Сводка", "Tóm tắt"),
    "checks": ("Checks (relative residual)", "Проверки (относительная невязка)", "Kiểm tra (sai lệch tương đối)"),
    "not_met": ("not met", "не выполнено", "không đạt"),
    "notices": ("Notes", "Примечания", "Ghi chú"),
    "written": ("Written to", "Записано в", "Đã ghi vào"),
    "exact": ("exact", "точный", "chính xác"),
    "textbook": ("textbook, two terms", "приближённый, два члена ряда", "gần đúng, hai số hạng"),
    "series": ("series to order {}", "ряд до порядка {}", "chuỗi đến bậc {}"),
    "rigid": ("rigid rod", "шатун – твёрдое тело", "thanh truyền là vật rắn"),
    "two-mass": ("two-mass rod", "двухмассовый шатун", "thanh truyền hai khối lượng"),
    "mean": ("mean", "среднее", "trung bình"),
    "per_area": (
        "forces per piston area", "силы на единицу площади поршня", "lực trên một đơn vị diện tích đỉnh piston"
    ),
    "crankpin_resultant": ("T² + K² = S²", "T² + K² = S²", "T² + Z² = Ptt²"),
    "crankpin_resultant_rigid": ("T² + K² = S² + S_n²", "T² + K² = S² + S_n²", "T² + Z² = Ptt² + Pn²"),
    "pin_resultant_rigid": ("F_P² + F_N² = F_Q² + F_q²", "P² + N² = S² + S_n²", "P1² + N² = Ptt² + Pn²"),
    "pin_resultant": ("F_P² + F_N² = F_Q²", "P² + N² = S²", "P1² + N² = Ptt²"),
    "overturning": ("torque = overturning moment", "крутящий момент = опрокидывающий момент", "mômen quay = mômen lật"),
    "work": ("work by p–V = work by torque", "работа по p–V = работа по моменту", "công theo p–V = công theo mômen"),
    "flywheel": ("simulated fluctuation = wanted", "расчётная неравномерность = заданная",
                 "hệ số không đều mô phỏng = yêu cầu"),
    "speed": ("Speed", "Скорость кривошипа", "Vận tốc tay quay"),
    "whole_system": ("joint forces: group by group = all at once", "реакции: по группам = общей системой",
                     "phản lực: theo nhóm = toàn hệ"),
    "zhukovsky": ("joint forces = Zhukovsky's lever", "реакции = рычаг Жуковского", "phản lực = đòn Giucôpxki"),
    "virtual_work": ("joint forces = virtual work", "реакции = возможные мощности", "phản lực = công khả dĩ"),
    "energy": ("joint forces = derivative of energy", "реакции = производная энергии", "phản lực = đạo hàm năng lượng"),
    "tabulated": ("transfer functions of the document", "передаточные функции из документа",
                  "hàm truyền của tài liệu"),
    "dynamics": ("Reduced inertia and torques", "Приведённый момент инерции и моменты", "Mômen thu gọn"),
    "points": ("Points", "Точки", "Các điểm"),
    "links": ("Links and sliders", "Звенья и ползуны", "Khâu và con trượt"),
    "joint_forces": ("Joint forces", "Реакции в кинематических парах", "Phản lực khớp"),
    "kinematics": ("Piston motion", "Кинематика поршня", "Động học piston"),
    "harmonics": ("First and second order", "Первый и второй порядки", "Cấp một và cấp hai"),
    "forces": ("Forces and torque", "Силы и крутящий момент", "Lực và mômen"),
    **ENGINE_WORDS,
}  # fmt: skip


def word(key: str, language: Language) -> str:
    """Return a word or phrase of the report in a language."""
    return _WORDS[key][LANGUAGES.index(language)]


def has_word(key: str) -> bool:
    """Return whether the report has a phrase of its own for a key."""
    return key in _WORDS


def unit_name(unit: str, language: Language) -> str:
    """Return a unit as that language prints it."""
    return _UNITS[language].get(unit, unit)


def number(value: float, language: Language, *, digits: int = 6) -> str:
    """Return a number with up to `digits` significant digits, the language's decimal mark and a true minus sign."""
    text = f"{value + 0.0:.{digits}g}"
    if "e" not in text and abs(value) >= 10**digits:
        text = f"{value:.0f}"
    if text in ("-0", "0"):
        return "0"
    if "e" in text:
        mantissa, _, exponent = text.partition("e")
        text = f"{mantissa}·10^{int(exponent)}" if mantissa not in ("1", "-1") else f"{mantissa[:-1]}10^{int(exponent)}"
    if language != "en":
        text = text.replace(".", ",")
    return text.replace("-", "−")


def _is_angle(key: str) -> bool:
    """Return whether a derived key is the crank angle of something."""
    kind = key.partition(".")[0]
    return kind.endswith("_angle") and kind not in QUANTITIES


def key_unit(key: str, *, per_area: bool = False) -> str:
    """Return the display unit of a key, a derived one such as `piston_force_max_angle` included."""
    if _is_angle(key):
        return "deg"
    row = QUANTITIES[base_key(key)]
    return row.per_area_unit if per_area and row.per_area_unit else row.unit


def displayed(key: str, value: float, *, per_area: float | None = None) -> float:
    """Return an SI value in the display unit of its key; `per_area` is the piston area to divide by. [m2]"""
    if per_area is not None and QUANTITIES.get(base_key(key), None) and _is_per_area(key):
        value = value / per_area
    return float(from_si(value, key_unit(key, per_area=per_area is not None)))


def _is_per_area(key: str) -> bool:
    return not _is_angle(key) and bool(QUANTITIES[base_key(key)].per_area_unit)


def label(key: str, language: Language) -> str:
    """Return the name of a key: `largest piston velocity`, and with its own name `joint force, A`."""
    kind, dot, name = key.partition(".")
    return _label(kind, language) + (f", {word(name, language) if has_word(name) else name}" if dot else "")


def _label(key: str, language: Language) -> str:
    if key in QUANTITIES:
        return QUANTITIES[key].label(language)
    if key.endswith(("_max_angle", "_min_angle")):
        return word("max_angle", language)
    for suffix in ("max", "min", "error"):
        if key.endswith(f"_{suffix}"):
            return word(suffix, language).format(_label(key.removesuffix(f"_{suffix}"), language))
    return word(key.removesuffix("_angle"), language)


def symbol(key: str, language: Language) -> str:
    """Return the symbol of a key; derived keys get the mark of what they are."""
    if _is_angle(key):
        return QUANTITIES["crank_angle"].symbol(language)
    kind = key.partition(".")[0]
    if kind in QUANTITIES:
        return QUANTITIES[kind].symbol(language)
    base = QUANTITIES[base_key(kind.removesuffix("_error"))].symbol(language)
    if kind.endswith("_error"):
        return f"Δ{base}"
    return f"{base}{',' if '_' in base else '_'}{kind[-3:]}"


def method_name(kinematics: str, order: int, rod: str, language: Language) -> str:
    """Return how a result was made, in words; `rod` is empty for a machine without one."""
    name = word(kinematics, language).format(order)
    return f"{name}; {word(rod, language)}" if rod else name


def rounded(value: float, digits: int = 15) -> float:
    """Return a number without the noise of its last bit, for printing as data."""
    return float(f"{value:.{digits}g}") if math.isfinite(value) else value
