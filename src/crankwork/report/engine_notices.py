"""Notices of engines and their working cycles, in three languages by code."""

from __future__ import annotations

# code: English, Russian, Vietnamese
ENGINE_NOTICES = {
    "articulated_big_ends": (
        "the big-end masses of the articulated rods are put at the crankpin, not at the knuckle pins",
        "массы нижних головок прицепных шатунов отнесены к оси шатунной шейки, а не к пальцам прицепных шатунов",
        "khối lượng đầu to của các thanh truyền phụ được đặt tại chốt khuỷu, không phải tại các chốt phụ",
    ),
    "no_spacing": (
        "no engine.spacing is given, so there are no moments along the shaft",
        "расстояние engine.spacing не задано, поэтому моменты вдоль вала не вычислены",
        "không cho engine.spacing nên không tính các mômen dọc trục",
    ),
    "motion_only": (
        "without masses or gas there is motion only: no torque, bearings, balance or flywheel",
        "без масс и давления газов вычислена только кинематика: без моментов, нагрузок, уравновешивания и маховика",
        "không có khối lượng và áp suất khí thể nên chỉ tính động học: không có mômen, phụ tải, cân bằng, bánh đà",
    ),
    "torque_of_cycle": (
        "the mean torque is {torque} N·m, by the calculation of the cycle {cycle} N·m: {percent} % apart",
        "средний момент {torque} Н·м, по тепловому расчёту {cycle} Н·м: расхождение {percent} %",
        "mômen trung bình {torque} N·m, theo tính toán nhiệt {cycle} N·m: sai lệch {percent} %",
    ),
    "articulated_two_mass": (
        "the articulated rods are taken as two masses; the inertia of the rod counts for the master rod only",
        "прицепные шатуны заменены двумя массами; момент инерции учтён только для главного шатуна",
        "thanh truyền phụ thay bằng hai khối lượng; mômen quán tính chỉ tính cho thanh truyền chính",
    ),
    "uneven_intervals": (
        "firing order {order} gives uneven intervals of {intervals}°; if they are meant, write engine.uneven = true",
        (
            "порядок работы {order} даёт неравномерные интервалы {intervals}°; если так задумано, укажите "
            "engine.uneven = true"
        ),
        (
            "thứ tự làm việc {order} cho góc lệch công tác không đều {intervals}°; nếu đúng ý định, hãy ghi "
            "engine.uneven = true"
        ),
    ),
    "cycle_assumed": (
        "not given, taken as usual for the kind of engine: {names}",
        "не задано и принято обычным для двигателей этого типа: {names}",
        "không cho, lấy theo giá trị thường gặp của loại động cơ: {names}",
    ),
    "cycle_rounded_size": (
        "bore {bore} mm and stroke {stroke} mm are rounded to {bore_taken} and {stroke_taken} mm; power follows",
        "диаметр {bore} мм и ход {stroke} мм округлены до {bore_taken} и {stroke_taken} мм; мощность пересчитана",
        (
            "đường kính {bore} mm và hành trình {stroke} mm được làm tròn thành {bore_taken} và "
            "{stroke_taken} mm; công suất tính lại theo đó"
        ),
    ),
    "cycle_excess_air": (
        "an excess air ratio of {value} is unusual: {low} to {high}",
        "коэффициент избытка воздуха {value} необычен: как правило, от {low} до {high}",
        "hệ số dư lượng không khí {value} là bất thường: thường từ {low} đến {high}",
    ),
    "cycle_flammability": (
        "with an excess air ratio of {value} a spark hardly lights the mixture, which burns from {low} to {high}",
        "при коэффициенте избытка воздуха {value} смесь вряд ли воспламенится от искры: пределы от {low} до {high}",
        "với hệ số dư lượng không khí {value} tia lửa khó đốt cháy hỗn hợp: giới hạn từ {low} đến {high}",
    ),
    "cycle_residual_fraction": (
        "a residual gas fraction of {value} is unusual: {low} to {high}",
        "коэффициент остаточных газов {value} необычен: как правило, от {low} до {high}",
        "hệ số khí sót {value} là bất thường: thường từ {low} đến {high}",
    ),
    "cycle_volumetric_efficiency": (
        "a volumetric efficiency of {value} is unusual: {low} to {high}",
        "коэффициент наполнения {value} необычен: как правило, от {low} до {high}",
        "hệ số nạp {value} là bất thường: thường từ {low} đến {high}",
    ),
    "cycle_compression_exponent": (
        "a compression exponent of {value} is unusual: {low} to {high}",
        "показатель политропы сжатия {value} необычен: как правило, от {low} до {high}",
        "chỉ số nén đa biến {value} là bất thường: thường từ {low} đến {high}",
    ),
    "cycle_expansion_exponent": (
        "an expansion exponent of {value} is unusual: {low} to {high}",
        "показатель политропы расширения {value} необычен: как правило, от {low} до {high}",
        "chỉ số giãn nở đa biến {value} là bất thường: thường từ {low} đến {high}",
    ),
    "cycle_compression_pressure": (
        "a pressure of {value} MPa at the end of compression is unusual: {low} to {high} MPa",
        "давление в конце сжатия {value} МПа необычно: как правило, от {low} до {high} МПа",
        "áp suất cuối quá trình nén {value} MPa là bất thường: thường từ {low} đến {high} MPa",
    ),
    "cycle_compression_temperature": (
        "a temperature of {value} K at the end of compression is unusual: {low} to {high} K",
        "температура в конце сжатия {value} К необычна: как правило, от {low} до {high} К",
        "nhiệt độ cuối quá trình nén {value} K là bất thường: thường từ {low} đến {high} K",
    ),
    "cycle_knock": (
        (
            "a compression ratio of {compression_ratio} with {temperature} K at the end of compression makes "
            "petrol knock; usual are ratios up to {limit} and temperatures up to {hottest} K"
        ),
        (
            "при степени сжатия {compression_ratio} и {temperature} К в конце сжатия вероятна детонация; "
            "обычны степени сжатия до {limit} и температуры до {hottest} К"
        ),
        (
            "tỉ số nén {compression_ratio} với nhiệt độ cuối nén {temperature} K dễ gây kích nổ; thường tỉ số "
            "nén đến {limit} và nhiệt độ đến {hottest} K"
        ),
    ),
    "cycle_combustion_temperature": (
        "a temperature of {value} K at the end of burning is unusual: {low} to {high} K",
        "температура в конце сгорания {value} К необычна: как правило, от {low} до {high} К",
        "nhiệt độ cuối quá trình cháy {value} K là bất thường: thường từ {low} đến {high} K",
    ),
    "cycle_combustion_pressure": (
        "a pressure of {value} MPa at the end of burning is unusual: {low} to {high} MPa",
        "давление в конце сгорания {value} МПа необычно: как правило, от {low} до {high} МПа",
        "áp suất cuối quá trình cháy {value} MPa là bất thường: thường từ {low} đến {high} MPa",
    ),
    "cycle_residual_temperature": (
        "a temperature of the residual gas of {value} K is unusual: {low} to {high} K",
        "температура остаточных газов {value} К необычна: как правило, от {low} до {high} К",
        "nhiệt độ khí sót {value} K là bất thường: thường từ {low} đến {high} K",
    ),
    "cycle_residual_check": (
        "the residual gas was taken at {assumed} K and comes out at {found} K, {percent} % off; take a nearer one",
        (
            "температура остаточных газов принята {assumed} К, а получена {found} К, расхождение {percent} %; "
            "примите более близкую"
        ),
        "nhiệt độ khí sót chọn {assumed} K nhưng tính lại được {found} K, sai lệch {percent} %; hãy chọn lại gần hơn",
    ),
    "cycle_heat_low": (
        "{value} °C at the end of compression lies outside the table of heats, 0 to {high} °C; its formula is used",
        "{value} °C в конце сжатия лежит вне таблицы теплоёмкостей, от 0 до {high} °C; применена её формула",
        "{value} °C ở cuối quá trình nén nằm ngoài bảng tỉ nhiệt, 0 đến {high} °C; vẫn dùng công thức của bảng",
    ),
    "cycle_heat_high": (
        "{value} °C at the end of burning lies outside the table of heats, {low} to {high} °C; its formula is used",
        "{value} °C в конце сгорания лежит вне таблицы теплоёмкостей, от {low} до {high} °C; применена её формула",
        "{value} °C ở cuối quá trình cháy nằm ngoài bảng tỉ nhiệt, {low} đến {high} °C; vẫn dùng công thức của bảng",
    ),
    "heat_shape": (
        "the Wiebe exponent {value} is outside the usual {low} to {high}",
        "показатель характера сгорания {value} вне обычных пределов {low}–{high}",
        "chỉ số đặc trưng cháy {value} nằm ngoài khoảng thường gặp {low}–{high}",
    ),
    "heat_duration": (
        "burning lasts {value}°, outside the usual {low}° to {high}°",
        "продолжительность сгорания {value}° вне обычных пределов {low}–{high}°",
        "thời gian cháy {value}° nằm ngoài khoảng thường gặp {low}–{high}°",
    ),
    "heat_ratio": (
        "the ratio of specific heats is {value}, outside the {low} to {high} of engine gases",
        "показатель адиабаты {value} вне пределов {low}–{high}, возможных для газов в двигателе",
        "chỉ số đoạn nhiệt {value} nằm ngoài khoảng {low}–{high} của khí trong động cơ",
    ),
    "heat_temperature": (
        "the gas reaches {temperature} K; above {limit} K dissociation takes heat that is not reckoned here",
        "температура газа достигает {temperature} К; выше {limit} К заметна диссоциация, здесь не учтённая",
        "nhiệt độ khí đạt {temperature} K; trên {limit} K có phân ly nhiệt, ở đây không tính đến",
    ),
    "heat_walls": (
        "the walls take {value} % of the heat released, outside the usual {low} to {high} %",
        "в стенки уходит {value} % выделившейся теплоты, обычно {low}–{high} %",
        "vách nhận {value} % nhiệt lượng toả ra, thường là {low}–{high} %",
    ),
    "heat_rough": (
        "the pressure rises by {rise} MPa/° at {angle}°; above {limit} MPa/° an engine runs harshly",
        "скорость нарастания давления {rise} МПа/° при {angle}°; выше {limit} МПа/° работа двигателя жёсткая",
        "tốc độ tăng áp suất {rise} MPa/° tại {angle}°; trên {limit} MPa/° động cơ làm việc cứng",
    ),
    "heat_knock": (
        "the pressure rises by {rise} MPa/° at {angle}°; above {limit} MPa/° it is that of knock",
        "скорость нарастания давления {rise} МПа/° при {angle}°; выше {limit} МПа/° – уровень детонации",
        "tốc độ tăng áp suất {rise} MPa/° tại {angle}°; trên {limit} MPa/° là mức kích nổ",
    ),
    "round_unreachable": (
        "no peak pressure gives the roundness factor {wanted}; {obtained} is obtained with the peak at {level} p_z",
        "коэффициент полноты {wanted} недостижим; при максимуме {level} p_z получено {obtained}",
        "không đạt được hệ số điền đầy {wanted}; với áp suất cực đại {level} p_z chỉ được {obtained}",
    ),
    "round_filling": (
        "the roundness factor of the diagram is {value}, outside the usual {low} to {high}",
        "коэффициент полноты диаграммы {value} вне обычных пределов {low}–{high}",
        "hệ số điền đầy đồ thị công {value} nằm ngoài khoảng thường gặp {low}–{high}",
    ),
    "round_peak": (
        "the greatest pressure is put {value}° after top dead centre; usual are {low}° to {high}°",
        "максимум давления принят через {value}° после ВМТ; обычно {low}–{high}°",
        "áp suất cực đại đặt ở {value}° sau ĐCT; thường là {low}–{high}°",
    ),
    "round_rise": (
        "the pressure at c'' is {value} times that at c; usual are {low} to {high}",
        "давление в точке c'' в {value} раза выше, чем в точке c; обычно в {low}–{high} раза",
        "áp suất tại điểm c'' gấp {value} lần tại điểm c; thường là {low}–{high} lần",
    ),
    "round_above": (
        "the rounded peak is {ratio} times the expansion line at its angle; put it earlier or lower",
        (
            "максимум скруглённой диаграммы в {ratio} раза выше линии расширения при том же угле; сместите "
            "его или уменьшите"
        ),
        "áp suất cực đại hiệu đính gấp {ratio} lần đường giãn nở tại góc đó; hãy đặt sớm hơn hoặc thấp hơn",
    ),
    "round_differs": (
        "{name} is given as {given}, but the lines of the diagram give {computed}; the lines are drawn",
        "{name} задано как {given}, а по линиям диаграммы получается {computed}; построено по линиям",
        "{name} cho là {given}, nhưng theo các đường của đồ thị là {computed}; đồ thị vẽ theo các đường",
    ),
}
