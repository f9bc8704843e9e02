"""What the reader of results should know, as sentences in three languages by the code of a notice."""

from __future__ import annotations

from collections.abc import Mapping

from crankwork.quantities import LANGUAGES, QUANTITIES, Language
from crankwork.report.engine_notices import ENGINE_NOTICES
from crankwork.report.engine_words import FILE_KEYS
from crankwork.report.language import has_word, label, number

_NOTICES = {
    "pi": ("computed with π = {pi}", "расчёт выполнен с π = {pi}", "tính với π = {pi}"),
    "inertia_rod_ratio": (
        "the inertia force uses r/l = {used}, everything else {rod_ratio}: the document mixes two ratios",
        "сила инерции вычислена при λ = {used}, всё остальное при λ = {rod_ratio}: в документе смешаны два значения",
        "lực quán tính tính với λ = {used}, phần còn lại với λ = {rod_ratio}: tài liệu dùng lẫn hai giá trị",
    ),
    "cycles_averaged": ("mean of {cycles} measured cycles", "среднее по {cycles} измеренным циклам",
                        "trung bình của {cycles} chu trình đo"),
    "wrap": (
        "measured pressure jumps by {step} MPa from the end of the cycle to its start",
        "измеренное давление меняется скачком на {step} МПа между концом и началом цикла",
        "áp suất đo nhảy {step} MPa giữa cuối và đầu chu trình",
    ),
    "jump": (
        "pressure jumps by {step} MPa at point {point}, {angle}°",
        "скачок давления {step} МПа в точке {point}, {angle}°",
        "áp suất nhảy {step} MPa tại điểm {point}, {angle}°",
    ),
    "partial": (
        "the linkage moves from {from}° to {to}° only: {message}",
        "механизм движется только от {from}° до {to}°: {message}",
        "cơ cấu chỉ chuyển động từ {from}° đến {to}°: {message}",
    ),
    "positions": ("{count} positions, as the document tabulates them", "{count} положений, как в таблице документа",
                  "{count} vị trí như trong bảng của tài liệu"),
    "given_derivative": (
        "the derivative of the reduced inertia is the document's own",
        "производная приведённого момента инерции взята из документа",
        "đạo hàm mômen quán tính thu gọn lấy từ tài liệu",
    ),
    "differences": ("derivative of the reduced inertia by {scheme} differences",
                    "производная приведённого момента инерции по конечным разностям ({scheme})",
                    "đạo hàm mômen quán tính thu gọn theo sai phân ({scheme})"),
    "rounded_efficiency": ("efficiency {used} instead of {exact}: rounded as in the document",
                           "КПД {used} вместо {exact}: округлён, как в документе",
                           "hiệu suất {used} thay vì {exact}: làm tròn như tài liệu"),
    "no_flywheel": (
        "no flywheel: {message}",
        "маховик не найден: проверьте заданную неравномерность (от 0 до 2) и скорость",
        "không tìm được bánh đà: hãy kiểm tra hệ số không đều yêu cầu (từ 0 đến 2) và tốc độ",
    ),
    "overloaded": (
        "the load needs {needed} kW, the motor is rated for {rated} kW; take a stronger one",
        "нагрузке нужно {needed} кВт, номинальная мощность двигателя {rated} кВт; возьмите более мощный",
        "tải cần {needed} kW, động cơ định mức {rated} kW; hãy chọn động cơ mạnh hơn",
    ),
    "stalls": (
        "the motor gives at most {torque} N·m on the crank and stalls at {angle}°; take a larger ratio",
        "двигатель даёт не более {torque} Н·м и остановится при {angle}°; увеличьте передаточное отношение",
        "động cơ cho tối đa {torque} N·m trên tay quay và dừng tại {angle}°; hãy tăng tỉ số truyền hoặc công suất",
    ),
    "no_steady_speed": (
        "no steady speed: {message}",
        "нет установившегося движения: машина остановится; нужен больший маховик, двигатель или скорость",
        "không có chế độ ổn định: máy sẽ dừng; cần bánh đà, động cơ hoặc tốc độ lớn hơn",
    ),
    "ambient": ("no ambient pressure given: {pressure} MPa is taken",
                "давление среды не задано: принято {pressure} МПа",
                "không cho áp suất khí trời: lấy {pressure} MPa"),
    "no_couple": (
        "the rod is taken as two masses; its own moment of inertia is left out (method.rod = rigid brings it in)",
        "шатун заменён двумя массами, его момент инерции не учтён (учитывает method.rod = rigid)",
        "thanh truyền thay bằng hai khối lượng, bỏ qua mômen quán tính (tính đến khi method.rod = rigid)",
    ),
    **ENGINE_NOTICES,
}  # fmt: skip


def notice_text(code: str, values: Mapping[str, float | str], language: Language) -> str:
    """Return the sentence of a notice with its numbers printed."""
    shown = {}
    for key, value in values.items():
        if key == "names":
            shown[key] = _meanings(str(value), language)
        elif isinstance(value, str):
            shown[key] = value
        else:
            # pressure steps are the only values with a unit of their own, MPa
            shown[key] = number(value / 1e6 if key == "step" else value, language, digits=5)
    return _NOTICES[code][LANGUAGES.index(language)].format(**shown)


def _meanings(names: str, language: Language) -> str:
    """Return keys of the machine file with what they mean, in a language that is not theirs."""
    if language == "en":
        return names
    meant = {name: FILE_KEYS.get(name, name) for name in names.split(", ")}
    return ", ".join(
        f"{label(key, language)} ({name})" if key in QUANTITIES or has_word(key) else name
        for name, key in meant.items()
    )
