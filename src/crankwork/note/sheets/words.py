"""Words that only sheets use, in three languages; numbers, units and symbols as all reports print them."""

from __future__ import annotations

import re
from typing import NamedTuple

from crankwork.note.sheets.scene import indexed
from crankwork.quantities import LANGUAGES, Language
from crankwork.report.language import key_unit, label, number, symbol, unit_name

# word: English, Russian, Vietnamese
_WORDS = {
    "indicator": ("Indicator diagram p–V", "Индикаторная диаграмма p–V", "Đồ thị công p–V"),
    "developed": ("Gas pressure over the crank angle", "Развёрнутая индикаторная диаграмма p–φ",
                  "Đồ thị công khai triển p–α"),
    "brix": ("Brix semicircle", "Бицентровая диаграмма Ф. А. Брикса", "Vòng tròn Brick"),
    "tolle": ("Acceleration over displacement (Tolle)", "Ускорение поршня j = f(S) по методу Толле",
              "Đồ thị gia tốc j = f(x) theo phương pháp Tôlê"),
    "piston_displacement": ("Piston displacement", "Перемещение поршня", "Chuyển vị của piston"),
    "piston_velocity": ("Piston velocity", "Скорость поршня", "Vận tốc của piston"),
    "piston_acceleration": ("Piston acceleration", "Ускорение поршня", "Gia tốc của piston"),
    "piston_forces": ("Forces along the cylinder axis", "Силы, действующие по оси цилиндра",
                      "Các lực dọc trục xylanh"),
    "rod_forces": ("Force along the rod and side force", "Сила вдоль шатуна и боковая сила",
                   "Lực dọc tâm thanh truyền và lực ngang"),
    "crankpin_forces": ("Radial and tangential force", "Радиальная и тангенциальная силы",
                        "Lực pháp tuyến và lực tiếp tuyến"),
    "torque": ("Torque", "Крутящий момент", "Mômen quay"),
    "polar": ("Polar diagram of the load on the crankpin", "Полярная диаграмма нагрузки на шатунную шейку",
              "Đồ thị phụ tải tác dụng lên chốt khuỷu"),
    "unrolled": ("Unrolled diagram of the load on the crankpin", "Развёрнутая диаграмма нагрузки на шатунную шейку",
                 "Đồ thị khai triển phụ tải tác dụng lên chốt khuỷu"),
    "wear": ("Wear diagram of the crankpin", "Условная диаграмма износа шатунной шейки",
             "Đồ thị mài mòn chốt khuỷu"),
    "oil_hole": ("oil hole", "масляное отверстие", "lỗ dầu"),
    "load_symbol": ("R", "R_шш", "Q"),
    "total_torque": ("total torque", "суммарный крутящий момент", "tổng mômen quay"),
    "cylinder_torque": ("one cylinder", "один цилиндр", "một xylanh"),
    "mean_mark": ("m", "ср", "tb"),
    "mean": ("mean value", "среднее значение", "giá trị trung bình"),
    "force": ("F", "P", "P"),
    "big_end": ("F_cr", "K_Rш", "P_k0"),
    "tdc": ("TDC", "ВМТ", "ĐCT"),
    "bdc": ("BDC", "НМТ", "ĐCD"),
    "first_sheet": ("Indicator diagram and piston motion", "Индикаторная диаграмма и кинематика поршня",
                    "Đồ thị công và động học piston"),
    "second_sheet": ("Dynamics of the crank gear", "Динамика кривошипно-шатунного механизма",
                     "Động lực học cơ cấu khuỷu trục thanh truyền"),
    "linkage_kinematics": ("Kinematics of the mechanism", "Кинематика механизма", "Động học cơ cấu"),
    "linkage_dynamics": ("Dynamics of the machine", "Динамика машины", "Động lực học máy"),
    "data": ("Data", "Исходные данные", "Số liệu"),
    "method": ("method", "метод", "phương pháp"),
    "position_plans": ("Position plans of the mechanism", "Планы положений механизма", "Họa đồ vị trí của cơ cấu"),
    "velocity_plans": ("Velocity plans", "Планы скоростей", "Họa đồ vận tốc"),
    "acceleration_plans": ("Acceleration plans", "Планы ускорений", "Họa đồ gia tốc"),
    "position": ("position", "положение", "vị trí"),
    "slider_displacement": ("Displacement", "Перемещение", "Chuyển vị"),
    "slider_velocity": ("Velocity", "Скорость", "Vận tốc"),
    "slider_acceleration": ("Acceleration", "Ускорение", "Gia tốc"),
    "link_angle": ("Direction of links", "Углы поворота звеньев", "Góc quay của khâu"),
    "link_angular_velocity": ("Angular velocity", "Угловая скорость", "Vận tốc góc"),
    "link_angular_acceleration": ("Angular acceleration", "Угловое ускорение", "Gia tốc góc"),
    "torques": ("Torques on the crank", "Приведённые моменты", "Mômen thu gọn"),
    "reduced_inertia": ("Reduced moment of inertia", "Приведённый момент инерции", "Mômen quán tính thu gọn"),
    "reduced_inertia_1": ("Derivative of the reduced inertia", "Производная приведённого момента инерции",
                          "Đạo hàm của mômen quán tính thu gọn"),
    "joint_forces": ("Joint forces", "Реакции в кинематических парах", "Phản lực khớp"),
    "wittenbauer": ("Energy–mass diagram (Wittenbauer)", "Диаграмма энергомасс (Виттенбауэра)",
                    "Đồ thị Wittenbauer"),
    "kinetic_energy_change": ("Change of kinetic energy", "Изменение кинетической энергии",
                              "Độ biến thiên động năng"),
    "crank_speed": ("Angular speed of the crank", "Угловая скорость кривошипа", "Vận tốc góc của khâu dẫn"),
    "anticlockwise": ("ω and ε are positive anticlockwise", "ω и ε положительны против часовой стрелки",
                      "ω và ε dương khi ngược chiều kim đồng hồ"),
    "beneath": ("{}: point of link {} under {}", "{} – точка звена {}, совпадающая с {}",
                "{}: điểm thuộc khâu {} trùng với {}"),
    # title block
    "change": ("Rev.", "Изм.", "Sửa"),
    "sheet": ("Sheet", "Лист", "Tờ"),
    "sheets": ("Sheets", "Листов", "Số tờ"),
    "document": ("Doc. no.", "№ докум.", "Số tài liệu"),
    "signature": ("Sign.", "Подп.", "Ký"),
    "date": ("Date", "Дата", "Ngày"),
    "drawn": ("Drawn", "Разраб.", "Vẽ"),
    "checked": ("Checked", "Пров.", "Kiểm tra"),
    "technology": ("Techn.", "Т. контр.", "Công nghệ"),
    "standards": ("Stand.", "Н. контр.", "Tiêu chuẩn"),
    "approved": ("Approved", "Утв.", "Duyệt"),
    "letter": ("Stage", "Лит.", "Loại"),
    "mass": ("Mass", "Масса", "Khối lượng"),
    "scale": ("Scale", "Масштаб", "Tỉ lệ"),
}  # fmt: skip


_POWER = re.compile(r"10\^(−?\d+)")


class Words(NamedTuple):
    """How a sheet says things: its language, and whether forces are per piston area."""

    language: Language
    per_area: bool = False

    def say(self, key: str) -> str:
        """Return a word of the sheets."""
        return _WORDS[key][LANGUAGES.index(self.language)]

    def symbol(self, key: str) -> str:
        """Return the symbol of a quantity, its index marked."""
        return indexed(symbol(key, self.language))

    def label(self, key: str) -> str:
        """Return the name of a quantity."""
        return label(key, self.language)

    def unit(self, unit: str) -> str:
        """Return a unit as the language prints it."""
        return unit_name(unit, self.language)

    def unit_of(self, key: str) -> str:
        """Return the display unit of a quantity, per piston area where forces are."""
        return key_unit(key, per_area=self.per_area)

    def number(self, value: float, digits: int = 4) -> str:
        """Return a number as the language prints it."""
        shown = number(float(f"{value:.{digits}g}"), self.language, digits=7)
        return _POWER.sub(r"10^{\1}", shown)

    def scale(self, sign: str, value: float, unit: str) -> str:
        """Return a scale as drawings state it, `μ_p = 0.02 MPa/mm`.

        Parameters
        ----------
        sign : str
            Symbol of the quantity, its index marked or none.
        value : float
            How much of it a millimetre of paper is. [unit/mm]
        unit : str
            Display unit of the quantity.
        """
        name = self.unit(unit)
        name = f"({name})" if "/" in name else name
        index = sign.replace("_{", "").replace("}", "")
        head = f"μ_{{{index}}} = {self.number(value, 5)}"
        return f"{head} {name}/{self.unit('mm')}" if name else f"{head} {self.unit('mm')}⁻¹"
