"""The one table of quantities: key and display unit; name, symbol and definition in each language are in `locale`.

Tables, figures, notes, the studio and the nomenclature page all read it.
"""

from __future__ import annotations

from crankwork.locale import LANGUAGES, Language
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import Quantity, table

__all__ = ["LANGUAGES", "Language", "QUANTITIES", "Quantity", "SUBJECTS", "base_key", "derived_unit", "subject"]

# what a crank gear is: lengths, speed, masses
_MACHINE = table(
    # geometry
    crank_angle="deg", crank_radius="mm", stroke="mm", rod_length="mm", rod_ratio="", inverse_rod_ratio="", offset="mm",
    relative_offset="", bore="mm", piston_rod_diameter="mm", piston_area="cm2", clearance_volume="cm3",
    total_volume="cm3", swept_volume="cm3", compression_ratio="", cylinder_volume="cm3", cycle_angle="deg",
    inclination="deg", gravity="m/s2",
    # speed
    rotational_speed="rpm", speed="rad/s", angular_acceleration="rad/s2", mean_piston_speed="m/s",
    # masses
    mass_per_area="g/cm2", piston_mass="kg or g/cm2", rod_mass="kg or g/cm2", rod_small_end_mass="kg or g/cm2",
    rod_big_end_mass="kg or g/cm2", small_end_share="", rod_centre_distance="mm", rod_gyration_radius="mm",
    rod_inertia="kg*m2", swing_period="s", pendulum_length="mm", bore_diameter="mm", suspension_span="mm",
    suspension_distance="mm", equivalent_mass="kg", equivalent_distance="mm", rod_inertia_excess="kg*m2",
    crank_mass="kg or g/cm2", reciprocating_mass="kg or g/cm2", rotating_mass="kg or g/cm2",
)  # fmt: skip

# linkages: motion, reduction to the crank, joint forces, friction, springs
_LINKAGE = table(
    # structure
    mobility="", moving_links="", lower_pairs="", gear_meshes="",
    # reduction of a linkage to its crank
    reduced_inertia="kg*m2", total_reduced_inertia="kg*m2", total_reduced_inertia_1="kg*m2", reduced_inertia_1="kg*m2",
    reduced_torque="N*m", static_torque="N*m", dynamic_torque="N*m", driving_torque="N*m", balancing_torque="N*m",
    kinetic_energy="J", efficiency="", body_mass="kg", body_inertia="kg*m2", end_inertia="kg*m2", centre_share="",
    body_gyration_radius="mm", mass_per_length="kg/m", inertia_share="", centre_x="mm", centre_y="mm",
    centre_acceleration="m/s2", link_angle="deg", link_angular_acceleration="rad/s2", velocity_ratio="mm",
    rotation_ratio="",
    # forces in joints
    link_inertia_force="N", link_inertia_torque="N*m", link_torque="N*m", joint_force="N", axial_force="N",
    force_share="", normal_force="N", tooth_force="N", separating_force="N", normal_moment="N*m", pin_radius="mm",
    pin_friction="", friction_radius="mm", guide_friction="", friction_sense="", relative_speed="rad/s",
    constant_moment="N*m", constant_force="N", angular_damping="N*m*s/rad", piece_length="mm", piece_middle_x="mm",
    piece_middle_y="mm", friction_couple="N*m", friction_torque="N*m", friction_force="N", friction_power="W",
    mean_friction_power="W", tilting_force="N", pressing_force="N", joint_force_with_friction="N",
    joint_force_with_friction_x="N", joint_force_with_friction_y="N", normal_force_with_friction="N",
    normal_moment_with_friction="N*m", torque_with_friction="N*m", static_torque_with_friction="N*m",
    driver_force_with_friction="N", driver_torque_with_friction="N*m", instantaneous_efficiency="", mean_efficiency="",
    spring_stiffness="N/m", spring_length="mm", spring_force="N", damping="N*s/m", damper_length="mm",
    damper_velocity="m/s", damper_force="N",
    # motion of any linkage
    point_x="mm", point_y="mm", point_velocity="m/s", point_velocity_x="m/s", point_velocity_y="m/s",
    point_acceleration="m/s2", point_acceleration_x="m/s2", point_acceleration_y="m/s2", coriolis_acceleration="m/s2",
    link_angular_velocity="rad/s", slider_displacement="mm", slider_velocity="m/s", slider_acceleration="m/s2",
    point_x_1="mm", point_x_2="mm", point_y_1="mm", point_y_2="mm", link_angle_1="", link_angle_2="",
    slider_displacement_1="mm", slider_displacement_2="mm", link_cos="", link_sin="", line_angle="deg", line_cos="",
    line_sin="", link_length="mm", point_along="mm", point_across="mm", arm_x="mm", arm_y="mm", distance_x="mm",
    distance_y="mm", distance_x_1="mm", distance_x_2="mm", distance_y_1="mm", distance_y_2="mm",
    joint_distance_square="cm2", doubled_area="cm2", branch="", foot_ratio="", height_ratio="", closing_x="mm",
    closing_y="mm", guide_along="mm", guide_along_1="mm", guide_along_2="mm", guide_across="mm", guide_across_1="mm",
    guide_across_2="mm", guide_reach="mm", guide_reach_1="mm", guide_rate="", guide_rate_1="", slot_offset="mm",
    guide_sine="", crank_cos="", crank_sin="", half_turns="", slider_stroke="mm", path_width="mm", path_height="mm",
    link_swing="deg", joint_force_x="N", joint_force_y="N", link_force_x="N", link_force_y="N", link_moment="N*m",
    force_along="N", force_across="N", load_size="N", load_x="N", load_y="N", process_force="N", travel_share="",
    working_stroke="mm",
    steady_speed="rpm", transient_time="s", final_turn="rad", final_speed="rad/s", potential_energy="J",
    steady_fluctuation="", kinetic_energy_change="J", time_ratio="", transmission_angle="deg", transmission_cosine="",
    pressure_angle="deg", pressure_sine="", instant_centre_x="mm", instant_centre_y="mm",
)  # fmt: skip

# drivers and the laws by which they move
_DRIVER = table(
    time="s", period="s", start_time="s", segment_time="s", time_share="", way_share="", way_share_1="", way_share_2="",
    law_coefficient="", law_amplitude="", law_frequency="", law_phase="", driver_way="mm", driver_turn="deg",
    driver_displacement="mm", driver_velocity="m/s", driver_acceleration="m/s2", driver_angle="deg",
    driver_speed="rad/s", driver_angular_acceleration="rad/s2", way_share_3="", driver_jerk="m/s3",
    driver_angular_jerk="rad/s3", link_length_1="mm", link_length_2="mm", stretch_x="mm", stretch_y="mm",
    driver_force="N", driver_torque="N*m", driver_power="kW",
)  # fmt: skip

# chambers of gas and what is sealed in them
_CHAMBERS = table(
    face_sense="", face_volume="cm3", cylinder_volume_1="cm3", cylinder_volume_2="cm3", gas_mass="g", dead_volume="cm3",
    reduced_volume="cm3/K", rod_load="N", rod_load_tension="N", rod_load_compression="N", mean_rod_load="N",
    crosshead_mass="kg", piston_rod_load="N", piston_rod_load_tension="N", piston_rod_load_compression="N",
    crosshead_load="N", crosshead_load_tension="N", crosshead_load_compression="N", suction_pressure="MPa",
    discharge_pressure="MPa", suction_temperature="K", discharge_temperature="K", free_air_pressure="MPa",
    free_air_temperature="K", expanded_volume="cm3", induced_volume="cm3", clearance_volumetric_efficiency="",
    inlet_flow="m3/min", gas_mass_flow="kg/h", free_air_delivery="m3/min", isothermal_power="kW",
    isothermal_efficiency="", stage_count="", needed_stages="", limit_ratio="", limit_temperature="K",
    stage_pressure_ratio="", cooler_pressure_loss="MPa", stage_flow="m3/min", clearance_ratio="", piston_sides="",
    swept_flow="m3/min", filled_flow="m3/min", free_volumetric_efficiency="", stage_power="kW", returned_power="kW",
    single_stage_power="kW", stage_saving="", overall_isothermal_efficiency="", specific_work="kJ/kg",
    gas_heat_capacity="J/(kg*K)", cylinder_heat="kW", cooler_heat="kW", specific_cooler_heat="kJ/kg", heat_removed="kW",
    water_heat_capacity="J/(kg*K)", water_flow="kg/h", water_rise="K", stage_flow_error="", delivered_flow="m3/min",
    discharge_coefficient="", pump_slip="", liquid_density="kg/m3", suction_height="m", discharge_height="m",
    vapour_pressure="MPa", acceleration_head="m", friction_head="m", pressure_head="m", separation_margin="MPa",
    separation_speed="rpm", chamber_flow="l/s", vessel_flow="l/s", vessel_inflow="l/s", pipe_power="kW",
    mean_flow="l/s", flow_pulsation="", flow_ratio="", vessel_volume_change="l", mean_pipe_power="kW",
    even_pipe_power="kW", vessel_saving="", pipe_length="m", pipe_diameter="mm", pipe_area="cm2", pipe_friction="",
    pipe_pressure="MPa", acceleration_pressure="MPa", friction_pressure="MPa",
)  # fmt: skip

# circuits: how far a crank gets that does not turn fully, and what it drives
_CIRCUITS = table(
    crank_range="deg", crank_range_start="deg", crank_range_end="deg", link_swing_circuit="deg",
    slider_stroke_circuit="mm",
)  # fmt: skip

# many cylinders on one shaft
_CYLINDERS = table(
    # layout
    firing_interval="deg", firing_angle="deg", cylinder_number="", bank_axis="deg", crankpin_angle="deg",
    crankpin_sine="", crankpin_cosine="",
    # torque along the shaft
    engine_indicated_power="kW", total_torque="N*m", total_tangential_force="N or MPa", mean_total_torque="N*m",
    throw_torque="N*m", journal_torque="N*m", crankpin_torque="N*m",
    # harmonics
    harmonic_order="", harmonic_cosine="N*m", harmonic_sine="N*m", harmonic_amplitude="N*m", harmonic_phase="deg",
    phase_sum="", total_harmonic_cosine="N*m", total_harmonic_sine="N*m", total_harmonic_amplitude="N*m",
    total_harmonic_phase="deg",
    # articulated rods
    articulated_rod_length="mm", knuckle_radius="mm", knuckle_angle="deg", knuckle_direction="deg", knuckle_x="mm",
    knuckle_y="mm", knuckle_sine="", knuckle_cosine="", knuckle_direction_1="", knuckle_direction_2="",
    knuckle_x_1="mm", knuckle_x_2="mm", knuckle_y_1="mm", knuckle_y_2="mm", articulated_axis="deg", axis_sine="",
    axis_cosine="", master_sine="", master_cosine="", articulated_rod_angle="deg", knuckle_mass="kg",
    knuckle_acceleration_x="m/s2", knuckle_acceleration_y="m/s2", knuckle_force_x="N", knuckle_force_y="N",
    knuckle_couple="N*m", knuckle_side_force="N",
)  # fmt: skip

# flywheel, motor and speed
_SHAFT = table(
    # speed, flywheel, motor
    turning_moment="N*m", excess_torque="N*m", crank_torque_sum="N*m", load_torque="N*m", mean_driving_torque="N*m",
    excess_work="J", speed_fluctuation="", crank_speed="rad/s", work_per_cycle="J", energy_fluctuation="",
    wittenbauer_slope="J", whole_inertia="kg*m2", clutch_outer_diameter="mm", clutch_inner_diameter="mm",
    clutch_radius="mm", friction_faces="", clutch_friction="", cone_angle="deg", clutch_force="N",
    clutch_pressure="MPa", clutch_torque="N*m", clutch_power="kW", driving_mass="kg", driven_mass="kg",
    driving_gyration_radius="mm", driven_gyration_radius="mm", driving_inertia="kg*m2", driven_inertia="kg*m2",
    driving_speed="rpm", driven_speed="rpm", driving_load="N*m", driven_load="N*m", closing_acceleration="rad/s2",
    slip_time="s", engaged_speed="rpm", slip_heat="J", flywheel_inertia="kg*m2", half_fluctuation="",
    flywheel_mass="kg", gyration_radius="mm", rim_inertia="kg*m2", rim_share="", rim_mass="kg", rim_diameter="mm",
    rim_speed="m/s", rim_stress="MPa", rim_density="kg/m3", rim_section="cm2", rim_ratio="", rim_width="mm",
    rim_thickness="mm", recovery_time="s", recovery_torque="N*m", shaft_power="kW", loop_work="J", loop_number="",
    drawn_area="mm2", work_scale="J/mm2", torque_scale="N*m/mm", angle_scale="deg/mm", stroke_work="J",
    stroke_angle="deg", stroke_share="", peak_share="", stroke_time="s", shear_energy="J/mm2",
    sheared_area="mm2", hole_diameter="mm", shear_strength="MPa", shearing_force="N", flat_shearing_force="N",
    penetration="", sheared_depth="mm", punch_slope="mm", plate_thickness="mm", cut_width="mm", punch_stroke="mm",
    inertia_on_crank="kg*m2", gear_ratio="", mains_frequency="Hz", pole_pairs="", synchronous_speed="rad/s", slip="",
    rated_slip="", breakdown_slip="", overload_capacity="", breakdown_torque="N*m", motor_torque="N*m",
    motor_power="kW", motor_ratio="", standard_motor_power="kW", power_reserve="",
)  # fmt: skip

# torsional vibration: discs, shafts, natural modes, dampers
_TORSION = table(
    disc_inertia="kg*m2", disc_mass="kg", disc_gyration_radius="mm", speed_ratio="", teeth="",
    equivalent_inertia="kg*m2", shear_modulus="MPa", shaft_length="mm", shaft_diameter="mm", shaft_bore="mm",
    shaft_density="kg/m3", shaft_inertia="kg*m2", polar_moment="cm4", torsional_stiffness="N*m/rad",
    equivalent_length="mm", reference_diameter="mm", journal_length="mm", journal_diameter="mm", journal_bore="mm",
    pin_length="mm", pin_diameter="mm", pin_bore="mm", web_thickness="mm", web_width="mm", natural_frequency="Hz",
    angular_frequency="rad/s", mode_number="", relative_amplitude="", node_distance="mm", equivalent_node_distance="mm",
    damping_ratio="", damped_frequency="Hz", loss_factor="", disc_torque="N*m", holzer_sum="N*m", shaft_twist="rad",
    holzer_remainder="N*m", critical_speed="rpm", mode_phase_sum="", excitation_torque="N*m", resonance_amplitude="deg",
    vibration_amplitude="deg", vibration_torque="N*m", vibration_stress="MPa", effective_inertia="kg*m2",
    damper_inertia_ratio="", optimum_tuning="", optimum_damping_ratio="", optimum_damping="N*m*s/rad",
    optimum_stiffness="N*m/rad", least_magnification="",
)  # fmt: skip

# bearing loads
_BEARINGS = table(
    # crankpin and big end
    big_end_weight="N", big_end_tangential_force="N", big_end_inertia_force="N or MPa",
    crankpin_radial_force="N or MPa", crankpin_tangential_force="N or MPa", mean_crankpin_load="N or MPa",
    crankpin_load="N or MPa", big_end_load="N or MPa",
    # piston pin and small end
    piston_pin_force="N or MPa", small_end_load="N or MPa", reversal_duration="deg", reversal_ratio="",
    # main journals
    shaft_unbalance="kg*m", unbalance_force="N", unbalance_weight="N", unbalance_tangential_force="N",
    shaft_position="mm", journal_share="", main_journal_load="N or MPa",
    # what a load comes to
    bearing_load="N or MPa", bearing_force_x="N or MPa", bearing_force_y="N or MPa",
    mean_bearing_load="N or MPa", bearing_load_ratio="", bearing_pressure="MPa", bearing_diameter="mm",
    bearing_length="mm",
    # wear
    wear_ray_angle="deg", wear_sum="N or MPa", oil_hole_angle="deg",
)  # fmt: skip

# balance
_BALANCE = table(
    # free forces and moments
    acceleration_coefficient="", order_inertia_force="N or MPa", force_factor="", moment_factor="", balance_pitch="mm",
    free_force="N", free_force_direction="deg", free_moment="N*m", shaking_force="N", shaking_force_x="N",
    shaking_force_y="N", shaking_moment="N*m", shaking_moment_amplitude="N*m",
    # counterweights
    counterweight_angle="deg", balanced_share="", counterweight_moment="kg*m", best_balanced_share="",
    best_counterweight_moment="kg*m",
    # masses in planes of a shaft
    plane_mass="kg", plane_reciprocating="kg", plane_radius="mm", plane_moment="kg*m", plane_moment_x="kg*m",
    plane_moment_y="kg*m", plane_angle="deg", plane_position="mm", plane_arm="mm", plane_couple="kg*m2",
    secondary_moment_x="kg*m", secondary_moment_y="kg*m", reciprocating_moment="kg*m", reciprocating_moment_x="kg*m",
    reciprocating_moment_y="kg*m", rotor_unbalance="kg*m", rotor_unbalance_x="kg*m", rotor_unbalance_y="kg*m",
    rotor_couple="kg*m2", rotor_couple_x="kg*m2", rotor_couple_y="kg*m2", unbalanced_force_along="N",
    unbalanced_force_across="N", unbalanced_force="N", unbalanced_couple="N*m", coupled_axles="",
    tractive_effort_variation="N", swaying_couple="N*m", hammer_blow="N", wheel_diameter="mm", wheel_load="N",
    rail_load="N", lifting_rotation="rad/s", lifting_speed="km/h", train_speed="km/h", sector_density="kg/m3",
    sector_width="mm", sector_outer_radius="mm", sector_inner_radius="mm", sector_count="", sector_angle="deg",
    # balance shafts
    balance_shaft_moment="kg*m",
)  # fmt: skip

# the slider-crank: its motion, gas and forces
_ENGINE = table(
    # motion
    piston_displacement="mm", piston_velocity="m/s", piston_acceleration="m/s2", inertia_acceleration="m/s2",
    piston_displacement_first_order="mm", piston_displacement_second_order="mm", piston_velocity_first_order="m/s",
    piston_velocity_second_order="m/s", piston_acceleration_first_order="m/s2", piston_acceleration_second_order="m/s2",
    rod_angle="deg", rod_angular_velocity="rad/s", rod_angular_acceleration="rad/s2", rod_sine="", rod_cosine="",
    crank_rod_sine="", crank_rod_cosine="", side_factor="", rod_factor="", radial_factor="", tangential_factor="",
    piston_transfer_1="mm", piston_transfer_2="mm", piston_transfer_1_first_order="mm",
    piston_transfer_1_second_order="mm", piston_transfer_2_first_order="mm", piston_transfer_2_second_order="mm",
    series_cosine="mm", series_sine="mm", rod_transfer_1="", rod_transfer_2="", pin_distance="mm", travel_down="deg",
    travel_up="deg", top_dead_centre_angle="deg", bottom_dead_centre_angle="deg",
    # gas
    gas_pressure="MPa", curve_share="", diagram_pressure="MPa", listed_pressure="", listed_pressure_unit="MPa",
    polytropic_exponent="", ambient_pressure="MPa",
    pressure_factor="", back_pressure="MPa", indicated_work="J", indicated_mean_pressure="MPa", indicated_power="kW",
    # forces
    gas_force="N or MPa", inertia_force="N or MPa", weight_force="N or MPa", transverse_weight="N or MPa",
    piston_force="N or MPa", side_force="N or MPa", rod_force="N or MPa", rod_transverse_force="N or MPa",
    radial_force="N or MPa", tangential_force="N or MPa", rotating_inertia_force="N or MPa", crank_torque="N*m",
    mean_torque="N*m", rotating_torque="N*m", overturning_moment="N*m", correction_couple="N*m",
)  # fmt: skip

# the working cycle
_CYCLE = table(
    # fuel and mixture
    fuel_carbon="", fuel_hydrogen="", fuel_oxygen="", fuel_molar_mass="kg/kmol", air_mass_needed="",
    air_amount_needed="kmol/kg", excess_air="", fresh_charge_amount="kmol/kg", hydrogen_share="", product_co2="kmol/kg",
    product_co="kmol/kg", product_h2o="kmol/kg", product_h2="kmol/kg", product_o2="kmol/kg", product_n2="kmol/kg",
    product_amount="kmol/kg", molar_change_ideal="", molar_change="", heat_lost_incomplete="MJ/kg",
    # intake and residual gas
    ambient_temperature="K", charge_pressure="MPa", charge_temperature="K", compressor_exponent="",
    compressor_temperature="K", cooler_drop="K", charge_density="kg/m3", intake_loss_factor="", intake_speed="m/s",
    intake_pressure_loss="MPa", intake_pressure="MPa", residual_pressure="MPa", residual_temperature="K",
    charge_heating="K", charge_up="", scavenging="", heat_correction="", residual_fraction="", intake_temperature="K",
    volumetric_efficiency="", lost_stroke="", geometric_compression_ratio="",
    # compression
    compression_exponent="", compression_pressure="MPa", compression_temperature="K", gas_celsius="",
    compression_celsius="",
    # heat capacities
    molar_gas_constant="kJ/(kmol*K)", heat_zero_temperature="K", fresh_charge_heat="kJ/(kmol*K)",
    product_heat="kJ/(kmol*K)", mixture_heat="kJ/(kmol*K)", product_heat_constant="kJ/(kmol*K)", product_heat_slope="",
    product_heat_constant_pressure="kJ/(kmol*K)",
    # combustion
    heat_use="", working_mixture_heat="kJ/kmol", combustion_energy="kJ/kmol", combustion_celsius="",
    combustion_temperature="K", pressure_rise_ratio="", combustion_pressure="MPa", combustion_pressure_real="MPa",
    cut_off="", afterexpansion="",
    # expansion and exhaust
    expansion_exponent="", expansion_pressure="MPa", expansion_temperature="K", exhaust_exponent="",
    residual_temperature_found="K", residual_temperature_deviation="",
    # results of the cycle
    theoretical_mean_pressure="MPa", indicated_efficiency="", relative_efficiency="",
    indicated_fuel_consumption="g/(kW*h)", mechanical_loss_pressure="MPa", mechanical_loss_constant="MPa",
    mechanical_loss_slope="MPa*s/m", effective_mean_pressure="MPa", mechanical_efficiency="", effective_efficiency="",
    effective_fuel_consumption="g/(kW*h)",
    # size
    strokes_per_cycle="", cylinder_count="", stroke_bore_ratio="", displacement="l", effective_power="kW",
    effective_torque="N*m", fuel_rate="kg/h", power_per_litre="kW/l",
    # test bed
    brake_load="N", brake_spring_load="N", brake_arm="mm", brake_drum_diameter="mm", brake_rope_diameter="mm",
    brake_circumference="mm", card_area="mm2", card_loop_area="mm2", card_length="mm", card_spring="MPa/mm",
    crank_side_pressure="MPa", rod_area="cm2", working_cycle_rate="rpm", power_with_one_cut="kW",
    mechanical_loss_power="kW", load_fuel_slope="g/(kW*h)", idle_fuel_rate="kg/h", willans_loss_power="kW",
    mechanical_loss_square="Pa*s2/m2", mechanical_loss_share="", fuel_flow="m3/min", fuel_density="kg/m3",
    orifice_diameter="mm", orifice_coefficient="", orifice_drop="MPa", air_fuel_ratio="", coolant_rate="kg/h",
    coolant_rise="K", coolant_heat="J/(kg*K)", exhaust_rise="K", exhaust_heat="J/(kg*K)", idle_speed="rpm",
    speed_droop="",
    # heat balance
    molar_enthalpy="kJ/kmol", cooling_factor="", cooling_exponent="", heat_supplied="kW", heat_to_coolant="kW",
    heat_to_exhaust="kW", heat_unburnt="kW", heat_rest="kW", heat_share="",
    # ideal cycles
    state_pressure="MPa", state_temperature="K", isochoric_heat="J/(kg*K)", heat_added="kJ/kg", heat_rejected="kJ/kg",
    ideal_work="kJ/kg", thermal_efficiency="", ideal_mean_pressure="MPa",
    # heat release
    burning_progress="", burning_advance="deg", burning_start="deg", burning_duration="deg", burning_shape="",
    burnt_fraction="", burning_rate="", burning_efficiency="", net_heat_rate="J/deg", gross_heat_rate="J/deg",
    net_heat="J", gross_heat="J", burnt_angle="deg", fit_scatter="", window_start="deg", window_end="deg",
    cycle_number="", mean_pressure_variation="", peak_pressure_variation="", fuel_per_cycle="g",
    fuel_heating_value="MJ/kg", fuel_heat="J", heat_released="J", cylinder_pressure="MPa", motored_pressure="MPa",
    cylinder_temperature="K", specific_gas_constant="J/(kg*K)", gas_heat_ratio="", gas_heat_ratio_slope="1/K",
    pressure_rise="MPa/deg", wall_temperature="K", wall_area="cm2", head_area="cm2", crown_area="cm2",
    wall_gas_speed="m/s", gas_speed_factor="", burning_speed_factor="m/(s*K)", heat_transfer_coefficient="W/(m2*K)",
    wall_heat_rate="J", wall_heat="J", internal_energy_change="J", closed_work="J", filling_factor="",
)  # fmt: skip

# by subject, as a reader wants them: the whole before one cylinder, and last what its cycle was calculated with
SUBJECTS: dict[str, tuple[Quantity, ...]] = {
    "machine": _MACHINE, "linkage": _LINKAGE, "driver": _DRIVER, "chambers": _CHAMBERS, "circuits": _CIRCUITS,
    "cylinders": _CYLINDERS, "shaft": _SHAFT, "torsion": _TORSION, "bearings": _BEARINGS, "balance": _BALANCE,
    "engine": _ENGINE, "cycle": _CYCLE,
}  # fmt: skip
QUANTITIES: dict[str, Quantity] = {row.key: row for rows in SUBJECTS.values() for row in rows}
_SUBJECT = {row.key: name for name, rows in SUBJECTS.items() for row in rows}


def base_key(key: str) -> str:
    """Return the key of the table row behind a derived key.

    `piston_velocity_max_angle` is derived from `piston_velocity`, and `joint_force_max.A` from `joint_force`.
    """
    key = key_of(key).quantity
    for suffix in ("_angle", "_time", "_max", "_min", "_error", "_difference"):
        if key not in QUANTITIES:
            key = key.removesuffix(suffix)
    return key


def derived_unit(key: str) -> str:
    """Return the unit of a derived key that is the crank angle or the time of something, empty for another key."""
    kind = key_of(key).quantity
    if kind in QUANTITIES:
        return ""
    return "deg" if kind.endswith("_angle") else "s" if kind.endswith("_time") else ""


def subject(key: str) -> str:
    """Return the subject, of `SUBJECTS`, that a key of results belongs to: `piston_area.cycle` to the cycle."""
    owner = key_of(key).owner
    return owner if owner in SUBJECTS else _SUBJECT[base_key(key)]
