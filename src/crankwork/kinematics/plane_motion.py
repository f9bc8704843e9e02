"""Formulas of plane motion: directions, points that move with a link, points seen from a guide or sliding on it.

Transfer functions are derivatives by the crank angle; those of a line that does not turn have the form of the
positions, and one formula serves both.
"""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula

_MOTION = "artobolevsky_1988, ch. 4"


@formula("link_cos", _MOTION)
def cosine_of_direction(th: Value) -> Value:
    """Cosine of a direction."""
    return np.cos(th)


@formula("link_sin", _MOTION)
def sine_of_direction(th: Value) -> Value:
    """Sine of a direction."""
    return np.sin(th)


@formula("link_angle", _MOTION)
def direction_of_slope(sin_th: Value, cos_th: Value, k_turn: Value) -> Value:
    """Direction of a link from its sine and cosine."""
    return np.arctan(sin_th / cos_th) + np.pi * k_turn


@formula("link_cos", _MOTION)
def cosine_of_turned(cos_al: Value, cos_th: Value, sin_al: Value, sin_th: Value) -> Value:
    """Cosine of the direction of a line that a link carries at an angle."""
    return cos_al * cos_th - sin_al * sin_th


@formula("link_sin", _MOTION)
def sine_of_turned(sin_al: Value, cos_th: Value, cos_al: Value, sin_th: Value) -> Value:
    """Sine of the direction of a line that a link carries at an angle."""
    return sin_al * cos_th + cos_al * sin_th


@formula("arm_x", _MOTION)
def arm_along_x(u_P: Value, cos_th: Value, v_P: Value, sin_th: Value) -> Value:
    """Way along x from the origin of a link to one of its points."""
    return u_P * cos_th - v_P * sin_th


@formula("arm_y", _MOTION)
def arm_along_y(u_P: Value, sin_th: Value, v_P: Value, cos_th: Value) -> Value:
    """Way along y from the origin of a link to one of its points."""
    return u_P * sin_th + v_P * cos_th


@formula("point_x_1", _MOTION)
def carried_x_1(x_P1: Value, theta_1: Value, r_y: Value) -> Value:
    """First transfer function of x of a point that moves with a link, from that of the origin of the link."""
    return x_P1 - theta_1 * r_y


@formula("point_y_1", _MOTION)
def carried_y_1(y_P1: Value, theta_1: Value, r_x: Value) -> Value:
    """First transfer function of y of a point that moves with a link, from that of the origin of the link."""
    return y_P1 + theta_1 * r_x


@formula("point_x_2", _MOTION)
def carried_x_2(x_P2: Value, theta_2: Value, r_y: Value, theta_1: Value, r_x: Value) -> Value:
    """Second transfer function of x of a point that moves with a link, from that of the origin of the link."""
    return x_P2 - theta_2 * r_y - theta_1**2 * r_x


@formula("point_y_2", _MOTION)
def carried_y_2(y_P2: Value, theta_2: Value, r_x: Value, theta_1: Value, r_y: Value) -> Value:
    """Second transfer function of y of a point that moves with a link, from that of the origin of the link."""
    return y_P2 + theta_2 * r_x - theta_1**2 * r_y


@formula("stretch_x", _MOTION)
def stretched_x(l_2: Value, cos_th: Value, l_1: Value, theta_1: Value, sin_th: Value) -> Value:
    """Along x, what a link of changing length adds to the second derivative of its end, with its Coriolis part."""
    return l_2 * cos_th - 2 * l_1 * theta_1 * sin_th


@formula("stretch_y", _MOTION)
def stretched_y(l_2: Value, sin_th: Value, l_1: Value, theta_1: Value, cos_th: Value) -> Value:
    """Along y, what a link of changing length adds to the second derivative of its end, with its Coriolis part."""
    return l_2 * sin_th + 2 * l_1 * theta_1 * cos_th


@formula("guide_along", _MOTION)
def along_guide(dx: Value, cos_th: Value, dy: Value, sin_th: Value) -> Value:
    """Coordinate of a point along a guide."""
    return dx * cos_th + dy * sin_th


@formula("guide_across", _MOTION)
def across_guide(dy: Value, cos_th: Value, dx: Value, sin_th: Value) -> Value:
    """Distance of a point from a guide."""
    return dy * cos_th - dx * sin_th


@formula("guide_along_1", _MOTION)
def along_turning_1(dx_1: Value, cos_th: Value, dy_1: Value, sin_th: Value, theta_1: Value, n_g: Value) -> Value:
    """First transfer function of a point along a guide that turns, as seen from the guide."""
    return dx_1 * cos_th + dy_1 * sin_th + theta_1 * n_g


@formula("guide_across_1", _MOTION)
def across_turning_1(dy_1: Value, cos_th: Value, dx_1: Value, sin_th: Value, theta_1: Value, s_g: Value) -> Value:
    """First transfer function of a point across a guide that turns, as seen from the guide."""
    return dy_1 * cos_th - dx_1 * sin_th - theta_1 * s_g


@formula("guide_along_2", _MOTION)
def along_turning_2(  # noqa: PLR0913 - an acceleration with its Coriolis and guiding parts
    dx_2: Value, cos_th: Value, dy_2: Value, sin_th: Value, theta_1: Value, n_g1: Value, theta_2: Value, n_g: Value,
    s_g: Value,
) -> Value:  # fmt: skip
    """Second transfer function of a point along a guide that turns, as seen from the guide."""
    return dx_2 * cos_th + dy_2 * sin_th + 2 * theta_1 * n_g1 + theta_2 * n_g + theta_1**2 * s_g


@formula("guide_across_2", _MOTION)
def across_turning_2(  # noqa: PLR0913 - an acceleration with its Coriolis and guiding parts
    dy_2: Value, cos_th: Value, dx_2: Value, sin_th: Value, theta_1: Value, s_g1: Value, theta_2: Value, s_g: Value,
    n_g: Value,
) -> Value:  # fmt: skip
    """Second transfer function of a point across a guide that turns, as seen from the guide."""
    return dy_2 * cos_th - dx_2 * sin_th - 2 * theta_1 * s_g1 - theta_2 * s_g + theta_1**2 * n_g


@formula("point_x", _MOTION)
def slid_x(x_P: Value, cos_th: Value, s_s: Value) -> Value:
    """Coordinate x of a point at a distance along a guide, or its transfer function where the guide does not turn."""
    return x_P + cos_th * s_s


@formula("point_y", _MOTION)
def slid_y(y_P: Value, sin_th: Value, s_s: Value) -> Value:
    """Coordinate y of a point at a distance along a guide, or its transfer function where the guide does not turn."""
    return y_P + sin_th * s_s


@formula("point_x_1", _MOTION)
def slid_x_1(x_P1: Value, cos_th: Value, s_1: Value, sin_th: Value, s_s: Value, theta_1: Value) -> Value:
    """First transfer function of x of a point that slides along a guide that turns."""
    return x_P1 + cos_th * s_1 - sin_th * (s_s * theta_1)


@formula("point_y_1", _MOTION)
def slid_y_1(y_P1: Value, sin_th: Value, s_1: Value, cos_th: Value, s_s: Value, theta_1: Value) -> Value:
    """First transfer function of y of a point that slides along a guide that turns."""
    return y_P1 + sin_th * s_1 + cos_th * (s_s * theta_1)


@formula("point_x_2", _MOTION)
def slid_x_2(  # noqa: PLR0913 - what slides, what is carried, and Coriolis
    x_P2: Value, cos_th: Value, s_2: Value, s_s: Value, theta_1: Value, sin_th: Value, s_1: Value, theta_2: Value
) -> Value:
    """Second transfer function of x of a point that slides along a guide that turns."""
    return x_P2 + cos_th * (s_2 - s_s * theta_1**2) - sin_th * (2 * s_1 * theta_1 + s_s * theta_2)


@formula("point_y_2", _MOTION)
def slid_y_2(  # noqa: PLR0913 - what slides, what is carried, and Coriolis
    y_P2: Value, sin_th: Value, s_2: Value, s_s: Value, theta_1: Value, cos_th: Value, s_1: Value, theta_2: Value
) -> Value:
    """Second transfer function of y of a point that slides along a guide that turns."""
    return y_P2 + sin_th * (s_2 - s_s * theta_1**2) + cos_th * (2 * s_1 * theta_1 + s_s * theta_2)


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_angle(cos_th: Value, cos_thk: Value, sin_th: Value, sin_thk: Value) -> Value:
    """Angle between the links of a dyad, from difference and sum of their directions.

    Notes
    -----
    The cosine has no digits left where links come into line.
    """
    return 2 * np.arctan(
        np.sqrt(
            ((cos_th - cos_thk) ** 2 + (sin_th - sin_thk) ** 2) / ((cos_th + cos_thk) ** 2 + (sin_th + sin_thk) ** 2)
        )
    )


@formula("transmission_cosine", "norton_2012, ch. 4")
def transmission_cosine(cos_th: Value, cos_thk: Value, sin_th: Value, sin_thk: Value) -> Value:
    """Cosine of the angle between the links of a dyad."""
    return cos_th * cos_thk + sin_th * sin_thk


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_of_cosine(cos_mu: Value) -> Value:
    """Angle between the links of a dyad from its cosine."""
    return np.arccos(cos_mu)


@formula("pressure_angle", "norton_2012, ch. 4")
def pressure_angle(sin_th: Value, cos_thk: Value, cos_th: Value, sin_thk: Value) -> Value:
    """Angle from a guide to the line of the link that moves its piece."""
    return np.arctan((sin_th * cos_thk - cos_th * sin_thk) / (cos_th * cos_thk + sin_th * sin_thk))


@formula("pressure_sine", "norton_2012, ch. 4")
def pressure_sine(sin_th: Value, cos_thk: Value, cos_th: Value, sin_thk: Value) -> Value:
    """Sine of the angle from a guide to the link that moves its piece."""
    return sin_th * cos_thk - cos_th * sin_thk


@formula("pressure_angle", "norton_2012, ch. 4")
def pressure_of_sine(sin_mu: Value) -> Value:
    """Angle between a guide and the line of the link that moves its piece, from its sine."""
    return np.arcsin(sin_mu)


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_of_pressure(mu_p: Value) -> Value:
    """Angle between a link and the normal of the guide of its piece."""
    return np.pi / 2 - mu_p
