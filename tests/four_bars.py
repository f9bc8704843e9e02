"""Four-bars by their lengths, as machine files state them."""

import crankwork


def four_bar_of(*lengths, start=0.0, more="", of_crank="", mass=None):
    """Return the machine of a four-bar: crank, coupler, rocker and ground in mm, and what is stated more."""
    crank, coupler, rocker, ground = lengths
    centre = f'mass = "{mass}"\ncentre = ["40 mm", "0 mm"]' if mass else ""
    return crankwork.read_machine(f"""
fixed_points = {{ O = ["0 mm", "0 mm"], B = ["{ground} mm", "0 mm"] }}
crank = {{ pivot = "O", pin = "A", radius = "{crank} mm", speed = "60 rpm", start = "{start} deg"{of_crank} }}
[links.coupler]
joins = ["A", "C"]
length = "{coupler} mm"
{centre}
[links.rocker]
joins = ["B", "C"]
length = "{rocker} mm"
{more}
""")
