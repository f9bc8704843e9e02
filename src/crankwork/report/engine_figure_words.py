"""Titles and words of the figures of a whole engine in three languages."""

from __future__ import annotations

from crankwork.quantities import LANGUAGES, Language

ENGINE_TITLES = {
    "brix": ("Brix diagram of the piston displacement", "Диаграмма Брикса перемещения поршня",
             "Đồ thị Brick xác định chuyển vị của piston"),
    "tolle": ("Piston acceleration over the displacement by Tolle's construction",
              "Ускорение поршня по его перемещению, построение Толле", "Đồ thị gia tốc theo phương pháp Tôlê"),
    "total_torque": ("Torque of the cylinders and total torque",
                     "Крутящий момент цилиндров и суммарный крутящий момент",
                     "Mômen quay của các xylanh và mômen tổng"),
    "accumulated_torque": ("Torque on the main journals", "Набегающие моменты на коренных шейках",
                           "Mômen xoắn tích luỹ tại các cổ trục"),
    "torque_harmonics": ("Amplitudes of the torque harmonics", "Амплитуды гармоник крутящего момента",
                         "Biên độ các điều hoà của mômen quay"),
    "phase_stars": ("Phase stars of the torque harmonics", "Фазовые диаграммы гармоник крутящего момента",
                    "Hình sao pha của các điều hoà mômen"),
    "excess_work": ("Excess work of the total torque", "Избыточная работа суммарного крутящего момента",
                    "Công dư của mômen tổng"),
    "crank_speed": ("Angular speed of the crankshaft over one cycle", "Угловая скорость коленчатого вала за цикл",
                    "Vận tốc góc của trục khuỷu trong một chu trình"),
    "crankpin_load": ("Load on the crankpin over the crank angle", "Развёрнутая диаграмма нагрузки на шатунную шейку",
                      "Đồ thị khai triển phụ tải tác dụng lên chốt khuỷu"),
    "big_end_polar": ("Polar diagram of the load on the big-end bearing",
                      "Полярная диаграмма нагрузки на шатунный подшипник",
                      "Đồ thị phụ tải tác dụng lên đầu to thanh truyền"),
    "small_end_polar": ("Polar diagram of the load on the small-end bearing",
                        "Полярная диаграмма нагрузки на подшипник верхней головки шатуна",
                        "Đồ thị phụ tải tác dụng lên đầu nhỏ thanh truyền"),
    "main_journal_polar": ("Polar diagrams of the loads on the main journals",
                           "Полярные диаграммы нагрузок на коренные шейки",
                           "Đồ thị phụ tải tác dụng lên các cổ trục khuỷu"),
    "crankpin_wear": ("Wear diagram of the crankpin", "Диаграмма износа шатунной шейки", "Đồ thị mài mòn chốt khuỷu"),
    "main_wear": ("Wear diagrams of the main journals", "Диаграммы износа коренных шеек",
                  "Đồ thị mài mòn các cổ trục khuỷu"),
    "balance_orders": ("Free forces and moments by order", "Неуравновешенные силы и моменты по порядкам",
                       "Lực và mômen tự do theo bậc"),
    "balance_ellipses": ("Loci of the free forces of each order", "Годографы неуравновешенных сил по порядкам",
                         "Quỹ tích của lực tự do theo từng bậc"),
}  # fmt: skip

_WORDS = {
    "cylinder": ("cylinder {}", "цилиндр {}", "xylanh {}"),
    "cylinders": ("cylinders 1–{}", "цилиндры 1–{}", "các xylanh 1–{}"),
    "crankpin": ("crankpin {}", "шатунная шейка {}", "chốt khuỷu {}"),
    "main_journal": ("main journal {}", "коренная шейка {}", "cổ trục {}"),
    "order": ("order {}", "порядок {}", "bậc {}"),
    "one_cylinder": ("one cylinder", "один цилиндр", "một xylanh"),
    "all_cylinders": ("all cylinders", "все цилиндры", "tất cả các xylanh"),
    "pole_rods": ("pole of the load: all rods on the crankpin", "полюс нагрузки от всех шатунов шейки",
                  "gốc của phụ tải do các thanh truyền trên chốt"),
    "pole": ("pole of the force on the crankpin", "полюс силы, действующей на шатунную шейку",
             "gốc của lực tác dụng lên chốt khuỷu"),
    "oil_hole": ("oil hole, {}°", "масляное отверстие, {}°", "lỗ khoan dầu, {}°"),
    "worn": ("hatched: wear, proportional to the sum of the loads", "заштриховано: износ, пропорциональный сумме сил",
             "phần gạch chéo: độ mòn, tỉ lệ với tổng phụ tải"),
    "largest": ("largest: {}", "наибольшая: {}", "lớn nhất: {}"),
    "crank_one": ("frame of the shaft, crank 1 upward", "система вала, кривошип 1 направлен вверх",
                  "hệ trục gắn với trục khuỷu, khuỷu 1 hướng lên"),
    "crank_up": ("crank arm upward, rotation clockwise", "кривошип направлен вверх, вращение по часовой стрелке",
                 "má khuỷu hướng lên, quay theo chiều kim đồng hồ"),
    "rod_up": ("frame of the rod, piston pin upward", "система шатуна, поршневой палец вверху",
               "hệ trục gắn với thanh truyền, chốt piston ở phía trên"),
    "reciprocating": ("reciprocating masses", "поступательные массы", "khối lượng tịnh tiến"),
    "rotating": ("rotating masses", "вращающиеся массы", "khối lượng quay"),
    "counterweights": ("counterweights", "противовесы", "đối trọng"),
    "balance_shafts": ("balance shafts", "уравновешивающие валы", "trục cân bằng"),
    "residual": ("left over", "остаток", "còn dư"),
    "before": ("cylinders and cranks", "цилиндры и кривошипы", "xylanh và khuỷu trục"),
    "after": ("with counterweights and balance shafts", "с противовесами и уравновешивающими валами",
              "có đối trọng và trục cân bằng"),
    "across_rod": ("across the rod", "поперёк шатуна", "vuông góc với thanh truyền"),
    "along_rod": ("along the rod", "вдоль шатуна", "dọc thanh truyền"),
    "brix_circle": ("Brix circle, pole shifted by", "окружность Брикса, полюс смещён на",
                    "vòng tròn Brick, gốc dời một đoạn"),
    "free_moment": ("free moment", "неуравновешенный момент", "mômen tự do"),
    "free_force": ("free force", "неуравновешенная сила", "lực tự do"),
    "star_sum": ("thick: sum of the unit vectors, its length in brackets",
                 "толстая линия: сумма единичных векторов, её длина в скобках",
                 "nét đậm: tổng các véctơ đơn vị, độ dài trong ngoặc"),
    "brix_error": ("largest deviation of the construction from {}: {}", "наибольшее отклонение построения от {}: {}",
                   "sai lệch lớn nhất của phép dựng so với {}: {}"),
    "tangents": ("Tolle's construction: tangents of the parabola", "построение Толле: касательные к параболе",
                 "phép dựng Tôlê: các tiếp tuyến của parabol"),
    "parabola": ("two terms of the series", "два члена ряда", "hai số hạng của chuỗi"),
}  # fmt: skip


def engine_word(key: str, language: Language, *values: str) -> str:
    """Return a word of the figures of an engine, with values put in.

    Parameters
    ----------
    key : str
        Which word.
    language : str
        Its language.
    *values : str
        What stands where the word has a place for it.

    Returns
    -------
    str
        The word.
    """
    return _WORDS[key][LANGUAGES.index(language)].format(*values)
