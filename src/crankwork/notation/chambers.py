"""Arguments of the formulas of chambers of gas."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "sigma": Argument("face_sense"),
    "s_x": Argument("slider_displacement"),
    "s_x0": Argument("slider_displacement", "{}₀"),
    "Z": Argument("reduced_volume"),
    "Z_1": Argument("reduced_volume", "{}₁"),
    "p_suc": Argument("suction_pressure"),
    "p_dis": Argument("discharge_pressure"),
    "T_suc": Argument("suction_temperature"),
    "T_dis": Argument("discharge_temperature"),
    "p_free": Argument("free_air_pressure"),
    "T_free": Argument("free_air_temperature"),
    "V_exp": Argument("expanded_volume"),
    "V_in": Argument("induced_volume"),
    "Q_in": Argument("inlet_flow"),
    "Q_del": Argument("delivered_flow"),
    "C_dis": Argument("discharge_coefficient"),
    "rho_liq": Argument("liquid_density"),
    "l_pipe": Argument("pipe_length"),
    "d_pipe": Argument("pipe_diameter"),
    "A_pipe": Argument("pipe_area"),
    "f_pipe": Argument("pipe_friction"),
    "V_rate": Argument("cylinder_volume_1"),
    "V_rate_2": Argument("cylinder_volume_2"),
    "P_iso": Argument("isothermal_power"),
    "P_ind": Argument("indicated_power"),
    "p_ref": Argument("diagram_pressure", "{}₁"),
}
