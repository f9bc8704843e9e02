"""Arguments of the formulas of bearing loads."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "K": Argument("radial_force"),
    "K_Rb": Argument("big_end_inertia_force"),
    "P_p": Argument("piston_pin_force"),
    "F_wp": Argument(
        "",
        "G_p",
        meaning="weight of the piston group along the axis | вес поршневой группы вдоль оси"
        " | trọng lượng nhóm piston dọc trục",
    ),
    "Q_u": Argument("shaft_unbalance"),
    "z_b": Argument("shaft_position"),
    "z_left": Argument(
        "shaft_position",
        "{}₁",
        meaning="position of the journal before the rod | координата коренной шейки перед шатуном"
        " | toạ độ cổ trục phía trước thanh truyền",
    ),
    "z_right": Argument(
        "shaft_position",
        "{}₂",
        meaning="position of the journal behind the rod | координата коренной шейки за шатуном"
        " | toạ độ cổ trục phía sau thanh truyền",
    ),
    "R_b": Argument("bearing_load"),
    "R_max": Argument(
        "bearing_load",
        "{}_max",
        meaning="largest load of the bearing | наибольшая нагрузка на подшипник | phụ tải lớn nhất của ổ",
    ),
    "R_mean": Argument("mean_bearing_load"),
    "d_b": Argument("bearing_diameter"),
    "l_b": Argument("bearing_length"),
}
