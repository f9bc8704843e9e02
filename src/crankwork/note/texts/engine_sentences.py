"""Sentences of the note of an engine: English, Russian, Vietnamese.

What stands in braces is put in; a key of the table of quantities becomes its symbol.
"""

from __future__ import annotations

from crankwork.note.texts.said import Said

SENTENCES = {
    "preface": Said(
        "This report gives the calculation of the crank gear over a whole working cycle: motion, forces and torques."
        " Each quantity is written as its formula, the numbers put into it and the result; tables and graphs are made"
        " from these same results.",
        "В записке выполнен кинематический и динамический расчёт кривошипно-шатунного механизма за полный рабочий"
        " цикл. Для каждой величины приведены формула, подстановка чисел и результат; таблицы и графики построены по"
        " тем же результатам. В заключении сведены основные результаты расчёта.",
        "Bản thuyết minh này trình bày phần tính toán động học và động lực học của cơ cấu khuỷu trục – thanh truyền"
        " trong một chu trình làm việc. Mỗi đại lượng được viết theo thứ tự: công thức, thay số, kết quả; các bảng số"
        " liệu và đồ thị được lập từ chính các kết quả đó.",
    ),
    "data": Said(
        "Table {table} holds what is given.",
        "Исходные данные для расчёта сведены в таблицу {table}.",
        "Các thông số cho trước được ghi trong bảng {table}.",
    ),
    "cycle_data": Said(
        "What is given or chosen for the working cycle stands in table {table}.",
        "Величины, заданные или принятые для теплового расчёта, приведены в таблице {table}.",
        "Các thông số cho trước hoặc chọn cho tính toán nhiệt được ghi trong bảng {table}.",
    ),
    "method": Said(
        "Method: {method}; π = {pi}, g = {gravity} m/s². Numbers are carried with all their digits and rounded only"
        " where they are printed.",
        "Метод расчёта: {method}; π = {pi}, g = {gravity} м/с². Промежуточные значения не округляются, округлены"
        " только напечатанные числа.",
        "Phương pháp tính: {method}; π = {pi}, g = {gravity} m/s². Các giá trị trung gian không làm tròn, chỉ làm tròn"
        " khi in.",
    ),
    "two_ratios": Said(
        "The inertia force uses {rod_ratio} = {used}, volumes, angles and everything else {rod_ratio} = {ratio}.",
        "Сила инерции вычислена при {rod_ratio} = {used}; объёмы, углы и всё остальное – при {rod_ratio} = {ratio}.",
        "Lực quán tính tính với {rod_ratio} = {used}; thể tích, góc và các đại lượng khác tính với"
        " {rod_ratio} = {ratio}.",
    ),
    "one_ratio": Said(
        "All stages use the same {rod_ratio} = {ratio}.",
        "На всех этапах расчёта принято одно значение {rod_ratio} = {ratio}.",
        "Mọi bước tính đều dùng cùng một giá trị {rod_ratio} = {ratio}.",
    ),
    "references": Said(
        "Motion and forces follow {first}, the loads of bearings {second}.",
        "Кинематика и динамика рассчитаны по {first}, нагрузки на подшипники – по {second}.",
        "Động học và động lực học tính theo {first}, phụ tải ổ trục tính theo {second}.",
    ),
    "conventions": Said(
        "The crank angle {crank_angle} counts from top dead centre; forces along the cylinder axis are positive"
        " towards the crankshaft.",
        "Угол {crank_angle} отсчитывается от ВМТ; силы вдоль оси цилиндра положительны, если направлены к"
        " коленчатому валу.",
        "Góc {crank_angle} tính từ điểm chết trên; lực dọc trục xylanh lấy dấu dương khi hướng về tâm trục khuỷu.",
    ),
    # what a section is about
    "cycle": Said(
        "The working cycle is calculated stage by stage.",
        "Расчёт ведётся последовательно по процессам рабочего цикла.",
        "Chu trình làm việc được tính lần lượt theo từng quá trình.",
    ),
    "heat_release": Said(
        "The pressure is found by the first law from the heat released; the values below are those of one crank angle.",
        "Давление найдено из первого закона термодинамики по закону тепловыделения; ниже приведены значения при одном"
        " угле поворота.",
        "Áp suất được xác định theo định luật nhiệt động thứ nhất từ quy luật toả nhiệt; các giá trị dưới đây ứng với"
        " một góc quay.",
    ),
    "geometry": Said(
        "Dimensions and speed that follow from the data:",
        "Размеры и скорости, вытекающие из исходных данных:",
        "Các kích thước và tốc độ suy ra từ số liệu cho trước:",
    ),
    "volumes": Said("Areas and volumes of the cylinder:", "Площадь поршня и объёмы цилиндра:",
                "Diện tích đỉnh piston và các thể tích của xylanh:"),
    "polytropes": Said(
        "Pressures on the polytropes, with {polytrope}, stand in table {table} for multiples i of the clearance"
        " volume.",
        "Давления на политропах, {polytrope}, приведены в таблице {table} для объёмов, кратных объёму камеры сжатия"
        " (i – кратность).",
        "Áp suất trên đường nén và đường giãn nở, với {polytrope}, được tính trong bảng {table} theo bội số i của thể"
        " tích buồng cháy.",
    ),
    "measured": Said(
        "The pressure in the cylinder was measured and is read from the file {file}; samples: {samples}, cycles"
        " averaged: {cycles}. Table {table} gives it at a coarse step.",
        "Давление в цилиндре измерено; оно взято из файла {file}: число отсчётов {samples}, число осреднённых циклов"
        " {cycles}. Таблица {table} даёт его с крупным шагом.",
        "Áp suất trong xylanh là áp suất đo, lấy từ tệp {file}: số điểm đo {samples}, số chu trình lấy trung bình"
        " {cycles}. Bảng {table} ghi áp suất này với bước thưa.",
    ),
    "shifted": Said(
        "To the angles of the file {shift} was added, so that {crank_angle} = 0 is top dead centre.",
        "К углам файла прибавлено {shift}, чтобы {crank_angle} = 0 соответствовало ВМТ.",
        "Các góc trong tệp được cộng thêm {shift} để {crank_angle} = 0 ứng với điểm chết trên.",
    ),
    "resampled": Said(
        "The samples are resampled at a step of {step}.",
        "Отсчёты пересчитаны на шаг {step}.",
        "Các điểm đo được nội suy lại với bước {step}.",
    ),
    "exponents": Said("{polytropic_exponent} = {compression} and {polytropic_exponent} = {expansion}",
                      "{polytropic_exponent} = {compression} и {polytropic_exponent} = {expansion}",
                      "{polytropic_exponent} = {compression} và {polytropic_exponent} = {expansion}"),
    "exponent": Said(*("{polytropic_exponent} = {value}",) * 3),
    "work": Said("Work of the diagram:", "Работа и показатели по построенной диаграмме:", "Công của đồ thị:"),
    "worked_at": Said(
        "Worked at {crank_angle} = {value}; the other angles are calculated in the same way.",
        "Пример расчёта при {crank_angle} = {value}; при остальных углах расчёт ведётся так же.",
        "Tính mẫu tại {crank_angle} = {value}; các góc khác tính tương tự.",
    ),
    "repeats": Said(
        "The motion repeats with every turn, so one turn is tabulated.",
        "Движение повторяется каждый оборот, поэтому таблица дана для одного оборота.",
        "Chuyển động lặp lại sau mỗi vòng quay nên bảng chỉ ghi cho một vòng.",
    ),
    "orders": Said("The parts of first and second order:", "Составляющие первого и второго порядков:",
               "Các thành phần cấp một và cấp hai:"),
    "extremes": Said("The largest and the least values:", "Наибольшие и наименьшие значения:",
                 "Các giá trị lớn nhất và nhỏ nhất:"),
    "error": Said(
        "Against the exact motion the method errs by at most {share} % in the acceleration; the errors are given in"
        " table {table}.",
        "Погрешность метода относительно точного решения не более {share} % по ускорению; все погрешности приведены в"
        " таблице {table}.",
        "Sai số của phương pháp so với kết quả chính xác không quá {share} % đối với gia tốc; các sai số được ghi"
        " trong bảng {table}.",
    ),
    "force_error": Said(
        "The inertia force errs by at most {share} %, with the crank-to-rod ratio it is calculated with.",
        "Погрешность силы инерции при принятом для неё отношении радиуса кривошипа к длине шатуна не более {share} %.",
        "Sai số của lực quán tính với thông số kết cấu dùng cho nó không quá {share} %.",
    ),
    "masses": Said(
        "The rod is taken as a mass at the piston pin and a mass at the crankpin.",
        "Масса шатуна заменена двумя массами: на оси поршневого пальца и на оси шатунной шейки.",
        "Khối lượng thanh truyền được thay bằng hai khối lượng: tại chốt piston và tại chốt khuỷu.",
    ),
    "masses_rigid": Said(
        "The rod is a rigid body: besides the two masses the couple of its moment of inertia counts.",
        "Шатун рассматривается как твёрдое тело: кроме двух масс учтён момент пары от избытка его момента инерции.",
        "Thanh truyền được coi là vật rắn: ngoài hai khối lượng còn kể đến mômen hiệu chỉnh do mômen quán tính.",
    ),
    "per_area": Said(
        "In tables and graphs forces are divided by the piston area {piston_area} = {value} and given in {unit}.",
        "В таблицах и на графиках силы отнесены к площади поршня {piston_area} = {value} и даны в {unit}.",
        "Trong các bảng và đồ thị, lực được chia cho diện tích đỉnh piston {piston_area} = {value}, đơn vị {unit}.",
    ),
    "brix": Said(
        "The displacement is drawn by the construction of Brix: the centre of the angles is moved by R²/(2L)"
        " towards bottom dead centre.",
        "Перемещение строится по методу Брикса: центр отсчёта углов смещён на R²/(2L) в сторону НМТ.",
        "Chuyển vị được dựng theo phương pháp Brick: tâm chia góc dịch một đoạn R²/(2L) về phía điểm chết dưới.",
    ),
    "tolle": Said(
        "The acceleration over the displacement is enveloped by the tangents of Tolle.",
        "Кривая ускорения по перемещению строится методом касательных (Толле).",
        "Đồ thị gia tốc theo chuyển vị được dựng bằng phương pháp Tôlê.",
    ),
    "inertia": Said(
        "Inertia force of the reciprocating mass and of the rotating mass:",
        "Силы инерции поступательно движущихся и вращающихся масс:",
        "Lực quán tính của khối lượng chuyển động tịnh tiến và của khối lượng chuyển động quay:",
    ),
    "one_cylinder": Said(
        "The engine has one cylinder, so the total is that of the cylinder.",
        "Двигатель одноцилиндровый, поэтому суммарный момент равен моменту цилиндра.",
        "Động cơ có một xylanh nên mômen tổng bằng mômen của xylanh đó.",
    ),
    "tangential_sum": Said(
        "The sum of the tangential forces is ΣT = {total_torque}/{crank_radius}.",
        "Сумма тангенциальных сил ΣT = {total_torque}/{crank_radius}.",
        "Tổng lực tiếp tuyến ΣT = {total_torque}/{crank_radius}.",
    ),
    "total": Said(
        "The torques of the cylinders differ by their firing angles and add up.",
        "Моменты цилиндров сдвинуты по фазе на углы чередования рабочих ходов и складываются.",
        "Mômen của các xylanh lệch nhau theo góc công tác và được cộng lại.",
    ),
    "order": Said("Firing order: {order}.", "Порядок работы: {order}.", "Thứ tự làm việc: {order}."),
    "crankpin": Said(
        "On the crankpin act the forces of the rod and the inertia force of the rod mass at the crankpin.",
        "На шатунную шейку действуют силы шатуна и центробежная сила массы шатуна, отнесённой к оси шейки.",
        "Chốt khuỷu chịu lực của thanh truyền và lực quán tính ly tâm của khối lượng thanh truyền quy về đầu to.",
    ),
    "of_pin": Said("{title}, crankpin {pins}", "{title}, шейка {pins}", "{title}, chốt {pins}"),
    "of_pins": Said("{title}, crankpins {pins}", "{title}, шейки {pins}", "{title}, các chốt {pins}"),
    "wear": Said(
        "Each load counts on the rays within 60° to both sides of its direction; the oil hole lies in the middle of"
        " the least loaded arc, at {oil_hole_angle} = {value}.",
        "Каждая сила учитывается на лучах в пределах 60° по обе стороны от её направления; масляное отверстие"
        " располагают в середине наименее нагруженной дуги, {oil_hole_angle} = {value}.",
        "Mỗi lực được kể trên các tia trong phạm vi 60° về hai phía; lỗ khoan dầu đặt ở giữa cung chịu tải nhỏ nhất,"
        " {oil_hole_angle} = {value}.",
    ),
    "big_end": Said(
        "The load on the big end is that on the crankpin in the frame of the rod, turned by {crank_angle} + β.",
        "Нагрузка на нижнюю головку шатуна получается из нагрузки на шейку поворотом на угол {crank_angle} + β.",
        "Phụ tải tác dụng lên đầu to thanh truyền nhận được từ phụ tải trên chốt khuỷu bằng cách xoay góc"
        " {crank_angle} + β.",
    ),
    "harmonics": Said(
        "The torque is resolved into harmonics; the first of the orders that add up is worked here.",
        "Крутящий момент разложен в ряд Фурье; ниже приведён расчёт для первого из складывающихся порядков.",
        "Mômen quay được khai triển thành chuỗi Fourier; dưới đây tính cho bậc đầu tiên được cộng dồn.",
    ),
    "loads": Said(
        "Mean load, its ratio to the largest one and the specific load of the crankpin; other bearings likewise:",
        "Средняя нагрузка, её отношение к наибольшей и удельная нагрузка шатунной шейки; остальные – аналогично:",
        "Phụ tải trung bình, hệ số va đập và phụ tải riêng của chốt khuỷu; các ổ khác tính tương tự:",
    ),
    "mains": Said(
        "The load of a throw is shared by the two journals beside it; the torque grows along the shaft from its free"
        " end.",
        "Нагрузка колена распределяется между двумя соседними коренными шейками; набегающие моменты складываются от"
        " свободного конца вала.",
        "Phụ tải của mỗi khuỷu truyền lên hai cổ trục kề bên; mômen xoắn được cộng dồn từ đầu tự do của trục.",
    ),
    "balance": Said(
        "Inertia forces of each order of all cylinders are added as vectors.",
        "Силы инерции каждого порядка всех цилиндров складываются геометрически.",
        "Lực quán tính từng bậc của tất cả các xylanh được cộng véctơ.",
    ),
    "evenness": Said(
        "The excess work is that of the total torque over its mean.",
        "Избыточная работа определена по кривой суммарного крутящего момента относительно его среднего значения.",
        "Công dư được xác định từ đường mômen tổng so với giá trị trung bình.",
    ),
    "checks": Said(
        "Identities that must hold stand in table {table}.",
        "Контрольные тождества и их относительные невязки приведены в таблице {table}.",
        "Các đẳng thức kiểm tra và sai lệch tương đối được ghi trong bảng {table}.",
    ),
    "errors": Said(
        "Errors of the method against the exact motion stand in table {table}.",
        "Погрешности метода относительно точного решения приведены в таблице {table}.",
        "Sai số của phương pháp so với kết quả chính xác được ghi trong bảng {table}.",
    ),
    "notices": Said("To be noted:", "Примечания:", "Ghi chú:"),
    "conclusion": Said(
        "The main results are collected in table {table}.",
        "Основные результаты расчёта сведены в таблицу {table}.",
        "Các kết quả chính được tổng hợp trong bảng {table}.",
    ),
    "more": Said(
        "Table {table} holds what is not given elsewhere.",
        "В таблице {table} приведены остальные результаты.",
        "Bảng {table} ghi các kết quả còn lại.",
    ),
    "further": Said("Further values:", "Прочие величины:", "Các đại lượng khác:"),
    # tables and figures of a section
    "see_table": Said("The values are in table {tables}.", "Результаты приведены в таблице {tables}.",
                  "Kết quả được ghi trong bảng {tables}."),
    "see_figure": Said("The curves are in figure {figures}.", "График показан на рисунке {figures}.",
                   "Đồ thị được vẽ trên hình {figures}."),
    "see_tables": Said("The values are in tables {tables}.", "Результаты приведены в таблицах {tables}.",
                   "Kết quả được ghi trong các bảng {tables}."),
    "see_figures": Said("The curves are in figures {figures}.", "Графики показаны на рисунках {figures}.",
                    "Đồ thị được vẽ trên các hình {figures}."),
    # a figure for who cannot see it
    "seen": Said("{quantity} from {low} to {high}", "{quantity}: от {low} до {high}", "{quantity} từ {low} đến {high}"),
}  # fmt: skip
