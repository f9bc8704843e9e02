"""Headings, captions and column titles of the note of a linkage: English, Russian, Vietnamese."""

from __future__ import annotations

from crankwork.note.texts.said import Said

HEADINGS = {
    "subtitle": Said("Kinematic and dynamic analysis: calculation note",
                 "Кинематический и динамический анализ. Расчётно-пояснительная записка",
                 "Phân tích động học và động lực học: thuyết minh tính toán"),
    "linkage": Said("Planar linkage", "Плоский рычажный механизм", "Cơ cấu phẳng khớp thấp"),
    "tabulated": Said("Mechanism given by its transfer functions", "Механизм, заданный передаточными функциями",
                  "Cơ cấu cho bằng các hàm truyền"),
    "task": Said("Task and data", "Задание и исходные данные", "Nhiệm vụ và số liệu cho trước"),
    "structure": Said("Structure", "Структурный анализ механизма", "Phân tích cấu trúc cơ cấu"),
    "kinematics": Said("Kinematics", "Кинематический анализ механизма", "Phân tích động học cơ cấu"),
    "plans": Said("Position plans", "Планы положений", "Họa đồ vị trí"),
    "transfer": Said("Transfer functions", "Кинематические передаточные функции", "Các hàm truyền động học"),
    "worked_motion": Said("Velocities and accelerations at one position", "Скорости и ускорения в расчётном положении",
                      "Vận tốc và gia tốc tại vị trí tính"),
    "polygons": Said("Velocity and acceleration plans", "Планы скоростей и ускорений", "Họa đồ vận tốc và gia tốc"),
    "forces": Said("Forces in the joints", "Силовой расчёт механизма", "Phân tích lực cơ cấu"),
    "inertia_loads": Said("Inertia forces", "Силы и моменты сил инерции звеньев", "Lực quán tính và mômen lực"
    " quán tính"),
    "reactions": Said("Joint forces", "Реакции в кинематических парах", "Phản lực khớp động"),
    "lever": Said("Balancing torque by Zhukovsky's lever and by other routes",
              "Уравновешивающий момент. Рычаг Жуковского и сравнение способов",
              "Mômen cân bằng: đòn Giucôpxki và so sánh các phương pháp"),
    "reduction": Said("Reduced masses and forces", "Приведение масс и сил", "Thu gọn khối lượng và lực"),
    "torques": Said("Static, dynamic and driving torque", "Статический, динамический и суммарный движущий моменты",
                "Mômen tĩnh, mômen động và mômen dẫn động"),
    "static": Said("Static torque", "Статический момент", "Mômen tĩnh"),
    "dynamic": Said("Reduced moment of inertia and dynamic torque",
                "Приведённый момент инерции и динамический момент",
                "Mômen quán tính thu gọn và mômen động"),
    "efficiency": Said("Efficiency", "Расчёт КПД механизма", "Hiệu suất của cơ cấu"),
    "driving": Said("Driving torque", "Расчёт суммарного движущего момента", "Mômen dẫn động tổng"),
    "motor": Said("Choice of the motor", "Выбор двигателя", "Chọn động cơ"),
    "flywheel": Said("Flywheel", "Расчёт маховика", "Tính bánh đà"),
    "law": Said("Law of motion", "Закон движения кривошипа", "Quy luật chuyển động của tay quay"),
    "checks": Said("Checks", "Проверка результатов", "Kiểm tra kết quả"),
    "conclusion": Said("Main results", "Заключение", "Kết luận"),
    "sources": Said("References", "Список литературы", "Tài liệu tham khảo"),
    "appendix": Said("Appendix: results over the whole turn", "Приложение. Результаты расчёта за оборот кривошипа",
                 "Phụ lục: kết quả tính trong một vòng quay"),
}  # fmt: skip

CAPTIONS = {
    "links": Said("Links", "Звенья механизма", "Các khâu của cơ cấu"),
    "pivots": Said("Fixed points", "Неподвижные точки", "Các điểm cố định"),
    "guides": Said("Guides", "Направляющие", "Các rãnh trượt"),
    "pairs": Said("Joints", "Кинематические пары", "Các khớp động"),
    "groups": Said("Assur groups", "Структурные группы (группы Ассура)", "Các nhóm Axua"),
    "positions": Said("Coordinates of the points", "Координаты точек механизма по положениям",
                  "Tọa độ các điểm theo vị trí"),
    "transfer": Said("First transfer functions", "Кинематические передаточные функции", "Các hàm truyền động học"),
    "velocities": Said("Velocities", "Скорости точек и звеньев", "Vận tốc các điểm và các khâu"),
    "accelerations": Said("Accelerations", "Ускорения точек и звеньев", "Gia tốc các điểm và các khâu"),
    "reactions": Said("Joint forces", "Реакции в кинематических парах", "Phản lực khớp động"),
    "routes": Said("Balancing torque by five routes, and their largest difference",
               "Уравновешивающий момент, найденный пятью способами, и наибольшее расхождение",
               "Mômen cân bằng theo năm cách và sai lệch lớn nhất"),
    "reduced": Said("Reduced moment of inertia and its derivative",
                "Приведённый момент инерции и его производная", "Mômen quán tính thu gọn và đạo hàm"),
    "table_transfer": Said("Positions and transfer functions", "Положения и кинематические передаточные функции",
                       "Vị trí và các hàm truyền động học"),
    "table_static": Said("Static torque", "Статический момент", "Mômen tĩnh"),
    "table_torque": Said("Driving torque and its parts", "Результаты расчёта момента движущих сил и его составляющих",
                     "Mômen dẫn động và các thành phần"),
    "flywheels": Said("Moment of inertia of the flywheel in four ways", "Момент инерции маховика, найденный четырьмя"
                  " методами", "Mômen quán tính bánh đà theo bốn phương pháp"),
    "speeds": Said("Speed of the crank", "Угловая скорость кривошипа по положениям", "Vận tốc góc tay quay theo"
    " vị trí"),
    "checks": Said("Identities and their residuals", "Контрольные тождества и их невязки",
               "Các đẳng thức kiểm tra và sai lệch"),
    "summary": Said("Main results", "Основные результаты расчёта", "Các kết quả chính"),
    "motion_all": Said("Motion of sliders and links", "Движение ползунов и звеньев", "Chuyển động của con trượt"
    " và khâu"),
    "torques_all": Said("Reduced inertia and torques", "Приведённый момент инерции и моменты",
                    "Mômen quán tính thu gọn và các mômen"),
    "reactions_all": Said("Joint forces over the turn", "Реакции за оборот кривошипа",
                      "Phản lực khớp trong một vòng quay"),
    "continued": Said("{caption} (continued {part})", "{caption} (продолжение {part})", "{caption} (tiếp theo {part})"),
}  # fmt: skip

# caption, and what a reader who cannot see the figure is told
FIGURES = {
    "position_plans": (
        Said("Position plans", "Планы положений механизма", "Họa đồ vị trí của cơ cấu"),
        Said("The linkage drawn at twelve crank positions, with the paths of its points",
         "Механизм в двенадцати положениях кривошипа, с траекториями точек",
         "Cơ cấu vẽ tại mười hai vị trí của tay quay, có quỹ đạo các điểm"),
    ),
    "velocity_plan": (
        Said("Velocity plan", "План скоростей", "Họa đồ vận tốc"),
        Said("Velocities of the points as vectors from one pole", "Скорости точек – векторы из одного полюса",
         "Vận tốc các điểm là các vectơ xuất phát từ một gốc"),
    ),
    "acceleration_plan": (
        Said("Acceleration plan", "План ускорений", "Họa đồ gia tốc"),
        Said("Accelerations of the points as vectors from one pole", "Ускорения точек – векторы из одного полюса",
         "Gia tốc các điểm là các vectơ xuất phát từ một gốc"),
    ),
    "sliders": (
        Said("Displacement, velocity and acceleration of the sliders", "Диаграммы перемещений, скоростей и ускорений"
         " ползунов", "Đồ thị chuyển vị, vận tốc và gia tốc của con trượt"),
        Said("Curves over one turn of the crank, one panel each", "Кривые за оборот кривошипа, одна под другой",
         "Các đường cong trong một vòng quay, lần lượt từ trên xuống"),
    ),
    "joint_forces": (
        Said("Joint forces", "Реакции в кинематических парах", "Phản lực khớp động"),
        Said("Magnitude of the force in each joint over one turn", "Модули реакций в шарнирах за оборот кривошипа",
         "Độ lớn phản lực ở từng khớp trong một vòng quay"),
    ),
    "reduced_inertia": (
        Said("Reduced moment of inertia and its derivative by the crank angle",
         "Зависимости приведённого момента инерции и его первой производной от угла поворота кривошипа",
         "Mômen quán tính thu gọn và đạo hàm theo góc quay tay quay"),
        Said("Two curves over one turn of the crank", "Две кривые за оборот кривошипа",
         "Hai đường cong trong một vòng quay"),
    ),
    "torques": (
        Said("Static, dynamic and driving torque", "Зависимости статического, динамического и суммарного движущего"
         " моментов от угла поворота кривошипа", "Mômen tĩnh, mômen động và mômen dẫn động theo góc quay tay quay"),
        Said("Torques on the crank over one turn", "Моменты на кривошипе за оборот", "Các mômen trên tay quay trong một"
         " vòng quay"),
    ),
    "wittenbauer": (
        Said("Wittenbauer's mass-energy diagram", "Диаграмма энергомасс (Виттенбауэра)",
         "Đồ thị Vittenbao (động năng – mômen quán tính)"),
        Said("Closed curve of energy over reduced inertia with its two tangents",
         "Замкнутая кривая «энергия – приведённый момент инерции» и две касательные к ней",
         "Đường cong kín của động năng theo mômen quán tính thu gọn và hai tiếp tuyến"),
    ),
    "speed": (
        Said("Speed of the crank with the flywheel", "Угловая скорость кривошипа с маховиком",
         "Vận tốc góc tay quay khi có bánh đà"),
        Said("Angular speed over one turn", "Угловая скорость за оборот", "Vận tốc góc trong một vòng quay"),
    ),
}  # fmt: skip

COLUMNS = {
    "number": Said("No.", "№", "TT"),
    "link": Said("Link", "Звено", "Khâu"),
    "joints": Said("Joints", "Шарниры", "Các khớp"),
    "length": Said("Length, {unit}", "Длина, {unit}", "Chiều dài, {unit}"),
    "centre": Said("Centre of mass, {unit}", "Центр масс, {unit}", "Khối tâm, {unit}"),
    "point": Said("Point", "Точка", "Điểm"),
    "guide": Said("Guide", "Направляющая", "Rãnh"),
    "carrier": Said("Carried by", "На звене", "Trên khâu"),
    "angle": Said("Angle, °", "Угол, °", "Góc, °"),
    "pair": Said("Joint", "Обозначение", "Khớp"),
    "between": Said("Links", "Соединяемые звенья", "Nối các khâu"),
    "kind": Said("Kind", "Вид пары", "Loại khớp"),
    "turning": Said("revolute", "вращательная", "khớp quay"),
    "sliding": Said("sliding", "поступательная", "khớp trượt"),
    "group": Said("Group", "Группа", "Nhóm"),
    "members": Said("Links", "Звенья", "Các khâu"),
    "class": Said("Class", "Класс", "Loại"),
    "species": Said("Kind", "Вид", "Dạng"),
    "position": Said("Pos.", "Пол.", "Vị trí"),
    "ground": Said("ground (0)", "стойка (0)", "giá (0)"),
    "by_groups": Said("by groups", "по группам", "theo nhóm"),
    "whole_system": Said("all at once", "общей системой", "toàn hệ"),
    "zhukovsky": Said("lever", "рычаг", "đòn"),
    "virtual_work": Said("virtual work", "мощности", "công khả dĩ"),
    "energy": Said("energy", "энергия", "năng lượng"),
    "difference": Said("Difference, %", "Расхождение, %", "Sai lệch, %"),
    "way": Said("Way", "Метод", "Phương pháp"),
    "quantity": Said("Quantity", "Величина", "Đại lượng"),
    "value": Said("Value", "Значение", "Giá trị"),
    "unit": Said("Unit", "Единица", "Đơn vị"),
    "at": Said("at φ, °", "при φ, °", "tại α, °"),
    "identity": Said("Identity", "Тождество", "Đẳng thức"),
}  # fmt: skip

WAYS = {
    "energy": Said("work alone, reduced inertia constant", "по избыточной работе (J = const)",
               "theo công dư (J = const)"),
    "mertsalov": Said("Mertsalov", "метод Мерцалова", "phương pháp Mertsalov"),
    "wittenbauer": Said("Wittenbauer", "метод Виттенбауэра", "phương pháp Vittenbao"),
    "exact": Said("exact", "точный", "chính xác"),
}  # fmt: skip

FOUR_BAR = {
    "crank-rocker": Said("crank and rocker", "кривошипно-коромысловый", "tay quay – cần lắc"),
    "double crank": Said("double crank", "двухкривошипный", "hai tay quay"),
    "double rocker": Said("double rocker", "двухкоромысловый", "hai cần lắc"),
    "rocker-crank": Said("driven at its rocker", "коромыслово-кривошипный", "cần lắc – tay quay"),
    "triple rocker": Said("triple rocker", "трёхкоромысловый", "ba cần lắc"),
    "change point": Said("change point", "предельный (складывающийся)", "có vị trí chập"),
}  # fmt: skip

# kinds of dyads: letters of the joints, and the number that Artobolevsky gives them
SPECIES = {
    "RRR": Said("RRR", "1-й вид (ВВВ)", "RRR (3 khớp quay)"),
    "RRP": Said("RRP", "2-й вид (ВВП)", "RRT (2 quay, 1 trượt)"),
    "RPR": Said("RPR", "3-й вид (ВПВ)", "RTR (quay – trượt – quay)"),
    "PRP": Said("PRP", "4-й вид (ПВП)", "TRT (trượt – quay – trượt)"),
    "RPP": Said("RPP", "5-й вид (ВПП)", "RTT (quay – trượt – trượt)"),
}  # fmt: skip
