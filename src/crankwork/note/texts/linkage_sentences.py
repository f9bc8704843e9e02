"""Sentences of the note of a linkage: English, Russian, Vietnamese.

What stands in braces is put in; a key of the table of quantities becomes its symbol.
"""

from __future__ import annotations

from crankwork.note.texts.said import Said

SENTENCES = {
    # task
    "task": Said(
        "The linkage is to be analysed over one turn of its crank: structure, motion, forces in the joints, torque on"
        " the crank.",
        "Требуется выполнить структурный, кинематический и силовой анализ механизма за один оборот кривошипа и найти"
        " момент на кривошипе.",
        "Yêu cầu phân tích cấu trúc, động học và lực của cơ cấu trong một vòng quay của tay quay và xác định mômen trên"
        " tay quay.",
    ),
    "task_table": Said(
        "The torque of the motor on the crank is to be found from the transfer functions of the mechanism at its"
        " positions.",
        "Требуется по кинематическим передаточным функциям механизма определить момент движущих сил на кривошипе во"
        " всех положениях.",
        "Yêu cầu xác định mômen dẫn động trên tay quay tại các vị trí từ các hàm truyền động học của cơ cấu.",
    ),
    "crank": Said(
        "The crank, length {radius}, turns {direction}. Its direction at {crank_angle} = 0 is {start} from the x axis;"
        " {speed} = {value}.",
        "Кривошип длиной {radius} вращается {direction}. При {crank_angle} = 0 он составляет с осью x угол {start};"
        " {speed} = {value}.",
        "Tay quay dài {radius} quay {direction}. Khi {crank_angle} = 0, tay quay hợp với trục x góc {start};"
        " {speed} = {value}.",
    ),
    "clockwise": Said("clockwise", "по часовой стрелке", "thuận chiều kim đồng hồ"),
    "anticlockwise": Said("anticlockwise", "против часовой стрелки", "ngược chiều kim đồng hồ"),
    "acceleration": Said("Angular acceleration of the crank: {value}.", "Угловое ускорение кривошипа: {value}.",
                     "Gia tốc góc của tay quay: {value}."),
    "table_speed": Said("Angular speed of the crank: {speed} = {value}.", "Угловая скорость кривошипа: {speed}"
    " = {value}.",
                    "Vận tốc góc của tay quay: {speed} = {value}."),
    "bodies": Said("Masses and moments of inertia of the links:", "Массы и моменты инерции звеньев:",
               "Khối lượng và mômen quán tính của các khâu:"),
    "loads": Said("Loads:", "Внешние силы:", "Ngoại lực:"),
    "no_loads": Said("There are no loads but the inertia of the links.",
                 "Внешних сил, кроме сил инерции звеньев, нет.", "Không có ngoại lực, chỉ có lực quán tính của"
                 " các khâu."),
    "load_slider": Said("process force on {name}, up to {force}", "сила полезного сопротивления на звене"
    " {name}, до {force}",
                    "lực cản có ích trên {name}, lớn nhất {force}"),
    "load_point": Said("process force at point {name}, up to {force}",
                   "сила полезного сопротивления в точке {name}, до {force}",
                   "lực cản có ích tại điểm {name}, lớn nhất {force}"),
    "load_force": Said("force at point {name}: {x} along x, {y} along y", "сила в точке {name}: {x} вдоль x,"
    " {y} вдоль y",
                   "lực tại điểm {name}: {x} theo x, {y} theo y"),
    "load_torque": Said("torque on {name}, up to {torque}", "момент на звене {name}, до {torque}",
                    "mômen trên khâu {name}, lớn nhất {torque}"),
    "load_spring": Said("spring between {name} and {other}: stiffness {stiffness}, free length {free}",
                    "пружина между {name} и {other}: жёсткость {stiffness}, длина без нагрузки {free}",
                    "lò xo giữa {name} và {other}: độ cứng {stiffness}, chiều dài tự do {free}"),
    "load_slider_spring": Said("spring on {name}: stiffness {stiffness}", "пружина на ползуне {name}: жёсткость"
    " {stiffness}",
                           "lò xo trên {name}: độ cứng {stiffness}"),
    "load_weight": Said("weights of the links, g = {gravity}", "силы тяжести звеньев, g = {gravity}",
                    "trọng lượng các khâu, g = {gravity}"),
    "drive_inertia": Said("Moment of inertia that turns with the crank: {value}.",
                      "Момент инерции, вращающийся с кривошипом: {value}.",
                      "Mômen quán tính quay cùng tay quay: {value}."),
    "fluctuation": Said("Wanted fluctuation of the speed: {speed_fluctuation} = {value}.",
                    "Допустимая неравномерность хода: {speed_fluctuation} = {value}.",
                    "Hệ số không đều cho phép: {speed_fluctuation} = {value}."),
    "method": Said(
        "All values are computed, not measured on drawings. Method: {method}; π = {pi}. Every formula stands first in"
        " letters, then with the numbers put in; the last digit shown is rounded, the calculation keeps all digits.",
        "Все величины вычислены аналитически, а не сняты с чертежа. Метод: {method}; π = {pi}. Каждая формула дана"
        " сначала в буквенном виде, затем с подстановкой чисел; округлён только показанный результат, расчёт ведётся"
        " со всеми знаками.",
        "Mọi đại lượng được tính bằng giải tích, không đo trên hình vẽ. Phương pháp: {method}; π = {pi}. Mỗi công thức"
        " viết dạng chữ trước, sau đó thay số; chỉ kết quả in ra được làm tròn, phép tính giữ mọi chữ số.",
    ),
    # structure
    "structure": Said(
        "The linkage has {n} moving links and {p} joints of one freedom; link 0 is the ground.",
        "Механизм содержит {n} подвижных звеньев и {p} кинематических пар пятого класса; стойка – звено 0.",
        "Cơ cấu có {n} khâu động và {p} khớp loại năm; giá là khâu 0.",
    ),
    "chebyshev": Said("Degrees of freedom by the formula of Chebyshev:", "Степень подвижности по формуле Чебышёва:",
                  "Bậc tự do theo công thức Trebưsep:"),
    "one_drive": Said(
        "One crank drives the linkage, so that its motion is determined.",
        "Механизм имеет одно начальное звено – кривошип, его движение вполне определено.",
        "Cơ cấu có một khâu dẫn là tay quay nên chuyển động hoàn toàn xác định.",
    ),
    "formula": Said("Formula of structure: {formula}. The linkage is of class {number}.",
                "Формула строения механизма: {formula}. Механизм относится к {number} классу.",
                "Công thức cấu tạo cơ cấu: {formula}. Cơ cấu thuộc loại {number}."),
    "grashof": Said("Type of the four-bar linkage by Grashof: {type}.", "Тип шарнирного четырёхзвенника по"
    " Грасгофу: {type}.",
                "Loại cơ cấu bốn khâu bản lề theo Grashof: {type}."),
    # motion
    "positions": Said(
        "Position 0 is at {crank_angle} = 0; the positions follow at every 30°. Coordinates and transfer functions"
        " are found group by group in closed form.",
        "Нулевое положение соответствует {crank_angle} = 0, следующие – через 30°. Координаты и передаточные функции"
        " найдены последовательно по структурным группам в замкнутом виде.",
        "Vị trí 0 ứng với {crank_angle} = 0, các vị trí tiếp theo cách nhau 30°. Tọa độ và hàm truyền được tính lần"
        " lượt theo từng nhóm bằng công thức giải tích.",
    ),
    "transfer": Said(
        "Transfer functions depend on the position only: the velocity of a point and the angular velocity of a link,"
        " over that of the crank {source}.",
        "Передаточные функции зависят только от положения механизма: это отношения скорости точки и угловой скорости"
        " звена к угловой скорости кривошипа {source}.",
        "Hàm truyền chỉ phụ thuộc vị trí cơ cấu: tỉ số giữa vận tốc điểm hoặc vận tốc góc của khâu và vận tốc góc của"
        " tay quay {source}.",
    ),
    "worked_at": Said("Worked at {crank_angle} = {value}:", "Расчёт для положения {crank_angle} = {value}:",
                  "Tính tại vị trí {crank_angle} = {value}:"),
    # forces
    "inertia": Said(
        "The inertia of each link is a force in its centre of mass and a couple. They are put on the links as loads"
        " (d'Alembert), and the links are then in equilibrium {source}.",
        "Силы инерции каждого звена приведены к силе в центре масс и паре. По принципу Даламбера они приложены к"
        " звеньям вместе с внешними силами, и звенья рассматриваются в равновесии {source}.",
        "Lực quán tính của mỗi khâu thu về lực đặt tại khối tâm và ngẫu lực. Theo nguyên lý Đalămbe, đặt chúng lên khâu"
        " cùng ngoại lực thì khâu ở trạng thái cân bằng {source}.",
    ),
    "reactions": Said(
        "The joint forces are found group by group, from the last group to the crank. {joint_force} is the magnitude,"
        " {normal_force} the force of a guide and {normal_moment} its moment about the pin of the piece.",
        "Реакции определены по структурным группам, от последней группы к кривошипу. {joint_force} – модуль реакции в"
        " шарнире, {normal_force} – реакция направляющей, {normal_moment} – её момент относительно шарнира ползуна.",
        "Phản lực được tính theo từng nhóm, từ nhóm cuối về tay quay. {joint_force} là độ lớn phản lực khớp quay,"
        " {normal_force} là phản lực của rãnh, {normal_moment} là mômen của nó đối với chốt con trượt.",
    ),
    "lever": Said(
        "On Zhukovsky's lever the velocity plan is turned by a right angle, and all forces stand at the ends of the"
        " velocities of their points; the sum of their moments about the pole gives {balancing_torque} {source}. The"
        " routes are computed apart; their largest difference is {difference} %.",
        "По методу Жуковского к повёрнутому на 90° плану скоростей приложены все силы в концах векторов скоростей точек"
        " их приложения; сумма их моментов относительно полюса даёт {balancing_torque} {source}. Способы независимы;"
        " наибольшее расхождение {difference} %.",
        "Theo phương pháp Giucôpxki, quay họa đồ vận tốc 90°, đặt mọi lực vào mút vectơ vận tốc của điểm đặt lực; tổng"
        " mômen đối với gốc họa đồ cho {balancing_torque} {source}. Các cách tính độc lập; sai lệch lớn nhất"
        " {difference} %.",
    ),
    # reduction and torque
    "reduction": Said(
        "The mechanism is replaced by its crank with the reduced moment of inertia {reduced_inertia}, which has the"
        " same kinetic energy, and the reduced torque {reduced_torque}, which does the same work {source}.",
        "Механизм заменён кривошипом с приведённым моментом инерции {reduced_inertia}, обладающим той же кинетической"
        " энергией, и приведённым моментом сил {reduced_torque}, совершающим ту же работу {source}.",
        "Thay cơ cấu bằng tay quay có mômen quán tính thu gọn {reduced_inertia} với cùng động năng, và mômen thu gọn"
        " {reduced_torque} sinh cùng công {source}.",
    ),
    "table_reduction": Said(
        "With the transfer functions of table {table} the reduced moment of inertia is the sum over the links"
        " {source}:",
        "По передаточным функциям таблицы {table} приведённый момент инерции складывается по звеньям {source}:",
        "Từ các hàm truyền ở bảng {table}, mômen quán tính thu gọn là tổng theo các khâu {source}:",
    ),
    "torques": Said(
        "The static torque {static_torque} balances the loads, the dynamic torque {dynamic_torque} changes the speed"
        " of the masses; their sum is {balancing_torque}.",
        "Статический момент {static_torque} уравновешивает внешние силы, динамический {dynamic_torque} изменяет"
        " скорости масс; их сумма – {balancing_torque}.",
        "Mômen tĩnh {static_torque} cân bằng ngoại lực, mômen động {dynamic_torque} làm thay đổi vận tốc các khối"
        " lượng; tổng của chúng là {balancing_torque}.",
    ),
    "given_derivative": Said(
        "The derivative {reduced_inertia_1} is taken from the data.", "Производная {reduced_inertia_1} взята из"
        " исходных данных.", "Đạo hàm {reduced_inertia_1} lấy từ số liệu cho trước.",
    ),
    "given_balancing": Said(
        "The sum of static and dynamic torque {balancing_torque} is given; the static torque {static_torque} is what"
        " the dynamic torque leaves of it.",
        "Сумма статического и динамического моментов {balancing_torque} задана; статический момент {static_torque}"
        " получен вычитанием динамического.",
        "Tổng mômen tĩnh và mômen động {balancing_torque} đã cho; mômen tĩnh {static_torque} là phần còn lại sau khi"
        " trừ mômen động.",
    ),
    "efficiency": Said(
        "Losses are counted by the efficiency of the joints between motor and process: in series the efficiencies"
        " multiply, in parallel they are averaged {source}. Here {efficiency} = {value}.",
        "Потери на трение учитывает КПД: при последовательном соединении кинематических пар их КПД перемножаются, при"
        " параллельном – усредняются {source}. Здесь {efficiency} = {value}.",
        "Tổn thất ma sát tính bằng hiệu suất: các khớp nối tiếp thì nhân hiệu suất, nối song song thì lấy trung bình"
        " {source}. Ở đây {efficiency} = {value}.",
    ),
    "efficiency_rounded": Said("The exact value is {exact}; {used} is used, as the data ask.",
                           "Точное значение {exact}; в расчёте принято {used}.",
                           "Giá trị chính xác {exact}; tính với {used}."),
    "no_losses": Said(
        "No efficiency is given: joints are taken without friction, {efficiency} = 1.",
        "КПД не задан: кинематические пары считаются идеальными, {efficiency} = 1.",
        "Không cho hiệu suất: coi các khớp không ma sát, {efficiency} = 1.",
    ),
    "driving": Said(
        "Where the sum of the torques is positive the motor drives, and the sum is divided by {efficiency}; where it"
        " is negative the motor brakes, and the sum is multiplied by it.",
        "Если сумма моментов положительна, привод работает двигателем и сумма делится на {efficiency}; если"
        " отрицательна, привод тормозит и сумма умножается на {efficiency}.",
        "Khi tổng mômen dương, động cơ dẫn động và chia tổng cho {efficiency}; khi âm, động cơ hãm và nhân tổng với"
        " {efficiency}.",
    ),
    # shaft
    "motor": Said(
        "The mean power of the loads at the wanted speed must not exceed the rated power of the motor, {rated}.",
        "Средняя мощность сил сопротивления при заданной скорости не должна превышать номинальной мощности"
        " двигателя {rated}.",
        "Công suất trung bình của lực cản ở vận tốc đã cho không được vượt quá công suất định mức của động cơ {rated}.",
    ),
    "steady": Said("With this motor the crank settles at {speed}, with a fluctuation of {fluctuation}.",
               "С этим двигателем устанавливается частота вращения {speed}, неравномерность {fluctuation}.",
               "Với động cơ này, tay quay ổn định ở {speed}, hệ số không đều {fluctuation}."),
    "flywheel": Said(
        "The flywheel is to keep the fluctuation of the speed at {speed_fluctuation} = {value}. Extremes of work and"
        " energy are found on the curves; each method sees the machine in its own way.",
        "Маховик должен обеспечить неравномерность {speed_fluctuation} = {value}. Экстремумы работы и энергии найдены"
        " по кривым; каждый метод учитывает инерцию механизма по-своему.",
        "Bánh đà phải bảo đảm hệ số không đều {speed_fluctuation} = {value}. Các cực trị của công và động năng tìm trên"
        " đường cong; mỗi phương pháp kể đến quán tính cơ cấu theo cách riêng.",
    ),
    "law": Said("With the flywheel found exactly, the speed of the crank follows from the energy of the whole machine.",
            "С маховиком, найденным точным методом, угловая скорость кривошипа определена из энергии всей машины.",
            "Với bánh đà tính chính xác, vận tốc góc tay quay suy ra từ động năng của toàn máy."),
    "transient": Said(
        "Driven from a crank angle of zero by a constant torque of {torque}, the crank has after {time} turned by"
        " {turn} and reached {speed}.",
        "Под действием постоянного момента {torque} кривошип от нулевого положения за {time} поворачивается на {turn}"
        " и достигает {speed}.",
        "Dưới tác dụng của mômen không đổi {torque}, từ góc quay bằng không, sau {time} tay quay quay được {turn} và "
        "đạt {speed}.",
    ),
    # checks
    "checks": Said(
        "What must be equal is computed apart and compared over the whole turn; a residual is relative to the largest"
        " value.",
        "Величины, которые должны совпадать, вычислены независимо и сравнены за весь оборот; невязка отнесена к"
        " наибольшему значению.",
        "Các đại lượng phải bằng nhau được tính độc lập và so sánh trong cả vòng quay; sai lệch lấy so với giá trị lớn"
        " nhất.",
    ),
    "no_checks": Said("A table of transfer functions leaves nothing to be compared with.",
                  "Для таблицы передаточных функций независимых проверок нет.",
                  "Với bảng hàm truyền không có phép kiểm tra độc lập."),
    "notices": Said("To be kept in mind:", "Замечания:", "Ghi chú:"),
    "conclusion": Said("The main results are in table {table}.", "Основные результаты расчёта сведены в таблицу"
    " {table}.",
                   "Các kết quả chính cho trong bảng {table}."),
    "sheets": Said("The drawing sheets are beside this note, in files whose names begin with that of the note.",
               "Листы графической части приложены к записке отдельными файлами.",
               "Các bản vẽ kèm theo thuyết minh này ở các tệp riêng."),
}  # fmt: skip
