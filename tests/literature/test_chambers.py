"""Published machines with gas in chambers: a Ross D-90 by Schmidt's analysis, compressors, a steam engine, rod loads.

Values with more digits than a source prints are from an independent recalculation of its formulas.
"""

import math

import pytest

import crankwork
from crankwork.kinematics.crank_grid import CrankGrid
from each import for_each


def at(machine, *degrees):
    """Return the results with columns at some crank angles."""
    return crankwork.analyse(machine, CrankGrid.from_degrees(degrees))


GEAR = """
    fixed_points.O = ["0 mm", "0 mm"]
    crank = {{ pivot = "O", pin = "A", radius = "{radius}", speed = "{speed}", start = "180 deg" }}
    links.rod = {{ joins = ["A", "B"], length = "{length}" }}
    guides.bed = {{ through = "O" }}
    sliders.piston = {{ guide = "bed", pin = "B"{mass} }}
    branch.B = -1
"""


class TestRossD90:
    """The data set ross90.dat of the program of I. Urieli, Stirling cycle machine analysis, 2002.

    http://www.ent.ohiou.edu/~urieli/stirling/adiabatic/adiab_Ross.html, in github.com/flash3780/stirling_analysis
    at commit d1f4b8607707a4884a9037c4e99fb1a8025132ce. No output is stored there: expected are its closed forms,
    and a spectral quadrature of its volumes, which agree to 1e-12.
    """

    REST = """
        chambers.cold = {{ slider = "cold_{piece}", bore = "55.9 mm", clearance_volume = "{cold} cm3",\
            temperature = "300 K" }}
        chambers.hot = {{ slider = "hot_{piece}", bore = "55.9 mm", clearance_volume = "{hot} cm3",\
            temperature = "923 K" }}
        charges.air.chambers = ["hot", "cold"]
        charges.air.mean_pressure = "200 kPa"
        charges.air.gas_constant = "287 J/(kg*K)"
        charges.air.dead_volumes = [{{ volume = "28.396768708 cm3", temperature = "923 K" }},
            {{ volume = "35.9737401528 cm3", temperature = "554.34603921 K" }},
            {{ volume = "33.0228238704 cm3", temperature = "300 K" }}]
    """

    def test_schmidts_analysis(self):
        """Both volumes as cosines: Scotch yokes with the swept volume and the phase angle of the program."""
        bore, swept, phase = 0.0559, 61.0451332132e-6, math.radians(95.5898963542)
        radius = 2e3 * swept / (math.pi * bore**2)
        machine = crankwork.read_machine(f"""
            fixed_points.O = ["0 mm", "0 mm"]
            crank = {{ pivot = "O", pin = "C", radius = "{radius!r} mm", speed = "50 rev/s",\
                points.H = ["{radius * math.cos(phase)!r} mm", "{radius * math.sin(phase)!r} mm"] }}
            guides.cold_bore.through = "O"
            guides.hot_bore.through = "O"
            guides.cold_slot = {{ link = "cold_yoke", angle = "90 deg" }}
            guides.hot_slot = {{ link = "hot_yoke", angle = "90 deg" }}
            sliders.cold_yoke.guide = "cold_bore"
            sliders.hot_yoke.guide = "hot_bore"
            sliders.cold_block = {{ pin = "C", guide = "cold_slot" }}
            sliders.hot_block = {{ pin = "H", guide = "hot_slot" }}
            {self.REST.format(piece="yoke", cold=8, hot=10)}
        """)
        results = crankwork.analyse(machine)
        assert results["gas_mass.air"] == pytest.approx(0.253308323112e-3, rel=1e-10)
        assert results["indicated_work.cold"] == pytest.approx(-1.70232556133, rel=1e-10)
        assert results["indicated_work.hot"] == pytest.approx(5.23748831035, rel=1e-10)
        assert results["indicated_power"] == pytest.approx(176.758137451, rel=1e-10)
        assert results["gas_pressure_max.cold"] + 101325 == pytest.approx(265157.325829, rel=1e-10)
        assert not results.unmet

    def test_the_yoke_drive(self):
        """The pistons follow the ends of the yoke, whose middle slides on the line through the shaft.

        The program counts volumes from a dead centre that does not belong to its yoke: 21.7793 mm for 22.8209 mm.
        """
        area = math.pi * 5.59**2 / 4
        more = area * (2.28209065544 - 2.17792625716)
        machine = crankwork.read_machine(f"""
            fixed_points.O = ["0 mm", "0 mm"]
            crank = {{ pivot = "O", pin = "A", radius = "8.5 mm", speed = "50 rev/s" }}
            links.yoke = {{ joins = ["A", "M"], length = "35.4 mm",\
                points = {{ E = ["35.4 mm", "-35.4 mm"], C = ["35.4 mm", "35.4 mm"] }} }}
            guides.middle = {{ through = "O", angle = "90 deg" }}
            guides.hot_bore = {{ through = ["35.4 mm", "0 mm"], angle = "90 deg" }}
            guides.hot_slot = {{ link = "hot_piston", angle = "90 deg" }}
            guides.cold_bore = {{ through = ["-35.4 mm", "0 mm"], angle = "90 deg" }}
            guides.cold_slot = {{ link = "cold_piston", angle = "90 deg" }}
            sliders.shoe = {{ guide = "middle", pin = "M" }}
            sliders.hot_piston.guide = "hot_bore"
            sliders.hot_end = {{ pin = "E", guide = "hot_slot" }}
            sliders.cold_piston.guide = "cold_bore"
            sliders.cold_end = {{ pin = "C", guide = "cold_slot" }}
            {self.REST.format(piece="piston", cold=8 + more, hot=10 + more)}
        """)
        results = crankwork.analyse(machine)
        assert results["swept_volume.hot"] == pytest.approx(59.2203892402e-6, rel=1e-9)
        assert results["indicated_work.cold"] == pytest.approx(-1.54333137999, rel=1e-9)
        assert results["indicated_work.hot"] == pytest.approx(4.74831621243, rel=1e-9)
        assert results["indicated_power"] == pytest.approx(160.249241622, rel=1e-9)
        assert results["gas_mass.air"] == pytest.approx(0.258741888584e-3, rel=1e-9)
        assert results["gas_pressure_max.hot"] + 101325 == pytest.approx(
            260787.976719, rel=1e-8
        )  # the best of 4096 angles


def compressor(size, pressures, exponents, speed="600 rpm", rod=""):
    """Return a double-acting compressor, or with `rod` None a single-acting one, as its file.

    `size`: bore, crank radius, clearance over swept volume.
    """
    (bore, radius, clearance), (low, high) = size, pressures
    text = GEAR.format(radius=radius, speed=speed, length="1 m", mass="")
    points = f"""
        compressed = {{ stroke = 0.0, pressure = "{high}" }}
        expanded = {{ pressure = "{low}" }}
        filled = {{ stroke = 1.0 }}
        opened = {{ pressure = "{high}" }}
        delivered = {{ stroke = 0.0 }}
    """
    turned = f"""
        filled = {{ stroke = 1.0, pressure = "{low}" }}
        opened = {{ pressure = "{high}" }}
        delivered = {{ stroke = 0.0 }}
        expanded = {{ pressure = "{low}" }}
        refilled = {{ stroke = 1.0 }}
    """
    laws = [("polytropic", "compressed", "expanded", exponents[1]), ("constant", "expanded", "filled", None),
            ("polytropic", "filled", "opened", exponents[0]), ("constant", "opened", "delivered", None)]  # fmt: skip
    laws_turned = [laws[2], laws[3], ("polytropic", "delivered", "expanded", exponents[1]),
                   ("constant", "expanded", "refilled", None)]  # fmt: skip
    sides = [("head", 1, points, laws, "")]
    sides += [] if rod is None else [("crank", -1, turned, laws_turned, rod)]
    for name, sense, own, pieces, less in sides:
        text += f"""
            [chambers.{name}]
            slider = "piston"
            bore = "{bore}"
            sense = {sense}
            {less}
            compression_ratio = {1 + 1 / clearance!r}
            pressures = "absolute"
            ambient = "0 MPa"
            [chambers.{name}.points]{own}
        """
        for law, start, end, exponent in pieces:
            text += f'[[chambers.{name}.pieces]]\nlaw = "{law}"\npoints = ["{start}", "{end}"]\n'
            text += f"exponent = {exponent}\n" if exponent else ""
    return crankwork.read_machine(text)


class TestRajput13:
    """R. K. Rajput, A textbook of internal combustion engines, example 20.13, page 759: double-acting compressor.

    github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, file
    A_textbook_of_Internal_Combustion_Engines_by_R._K._Rajput/CHAPTER20_3.ipynb. Compression and re-expansion have
    different exponents, so that the work of the gas left in the clearance does not cancel.
    """

    @pytest.fixture(scope="class")
    @classmethod
    def results(cls):
        diameter = 17.978573864
        machine = compressor(
            (f"{diameter} cm", f"{diameter / 2} cm", 0.05), ("1 bar", "7.5 bar"), (1.25, 1.3), "310 rpm"
        )
        return crankwork.analyse(machine)

    def test_power(self, results):
        work = results["indicated_work.head"] + results["indicated_work.crank"]
        assert work == pytest.approx(-1826.73836147, rel=1e-9)
        assert -results["indicated_power"] == pytest.approx(9438.14820093, rel=1e-9)
        assert round(-results["indicated_power"] / 0.85 / 1e3, 1) == 11.1

    def test_volumetric_efficiency(self, results):
        """What is drawn in, and how much free air at 1.03 bar and 293 K that is of air at 1 bar and 298 K."""
        pressure = results.trace["diagram_pressure.head"]
        expanded = pressure.node.ends[0]
        full, left = (results.value("cylinder_volume.head", one) for one in (180.0, expanded))
        drawn = (full - left) / results["swept_volume.head"]
        assert 100 * drawn == pytest.approx(81.4444063901, rel=1e-9)
        free = 2 * drawn * results["swept_volume.head"] * 310 * 1 / 1.03 * 293 / 298
        assert free == pytest.approx(2.2, rel=1e-9)


class TestNag3:
    """P. K. Nag, Basic and applied thermodynamics, example 19.3, page 819: single-acting, 2 litres, 5 % clearance.

    The same repository, file Basic_And_Applied_Thermodynamics_by_P._K._Nag/Chapter19.ipynb.
    """

    def test_power(self):
        radius = 1e3 * (2e-3 / (math.pi * 0.1**2 / 4)) / 2
        machine = compressor(
            ("100 mm", f"{radius!r} mm", 0.05), ("101.3 kPa", "810.4 kPa"), (1.25, 1.25), "800 rpm", rod=None
        )
        power = crankwork.analyse(machine)["indicated_power.head"]
        assert -power == pytest.approx(5475.65638255, rel=1e-9)


def test_rod_load_of_a_double_acting_cylinder():
    """Bloch and Hoefner, Reciprocating compressors: operation and maintenance, page 85: Fc = pd Ahe - ps Ace.

    The formulas are printed, the numbers chosen: 10 in bore, 2.5 in rod, 215 to 515 psi.
    """
    machine = compressor(("10 in", "5 in", 0.15), ("215 psi", "515 psi"), (1.3, 1.3), rod='rod_diameter = "2.5 in"')
    results = crankwork.analyse(machine)
    # along the guide towards the shaft: the rod is pressed
    assert results["rod_load_max.piston"] / 4.4482216152605 == pytest.approx(24617.323684, rel=1e-11)
    assert results["rod_load_min.piston"] / 4.4482216152605 == pytest.approx(-21033.9445635, rel=1e-11)
    assert -results["rod_load_min.piston"] / results["rod_load_max.piston"] == pytest.approx(0.85443668993, rel=1e-11)


class TestBalmer9:
    """R. T. Balmer, Modern engineering thermodynamics, example 13.9: a hot-air engine after Stirling.

    github.com/FOSSEE/Scilab-TBC-Uploads, 3831/CH13/EX13.9/Ex13_9.sce: 1 and 10 litres, 0.3 MPa hot and 0.1 MPa cold at
    the large volume, 30 degrees C cold, R = 0.286 kJ/(kg K). The file stores no output; the closed forms are exact.
    """

    def yoke(self, gas):
        return crankwork.read_machine(f"""
            fixed_points.O = ["0 mm", "0 mm"]
            crank = {{ pivot = "O", pin = "A", radius = "450 mm", speed = "60 rpm", start = "180 deg" }}
            guides = {{ bore = {{ through = "O" }}, slot = {{ link = "piston", angle = "90 deg" }} }}
            sliders = {{ piston = {{ guide = "bore" }}, block = {{ pin = "A", guide = "slot" }} }}
            chambers.gas.slider = "piston"
            chambers.gas.area = "100 cm2"
            chambers.gas.clearance_volume = "1 l"
            {gas}
        """)

    @for_each(("kelvin", "small", "large"), [(303.15, 1.0e6, 0.1e6), (909.45, 3.0e6, 0.3e6)])
    def test_the_isotherms_of_one_mass(self, kelvin, small, large):
        charge = f"""
            chambers.gas.temperature = "{kelvin} K"
            charges.air = {{ chambers = ["gas"], mass = "11.5339056457 g", gas_constant = "286 J/(kg*K)" }}
        """
        found = at(self.yoke(charge), 0.0, 180.0)["gas_pressure.gas"] + 101325
        assert found == pytest.approx([small, large], rel=1e-11)

    def test_work_of_the_cycle(self):
        machine = self.yoke("""
            chambers.gas.pressures = "absolute"
            chambers.gas.ambient = "0.1 MPa"
            chambers.gas.points.p4 = { stroke = 0.0, pressure = "3 MPa" }
            chambers.gas.points.p1 = { stroke = 1.0 }
            chambers.gas.points.p2 = { stroke = 1.0, pressure = "0.1 MPa" }
            chambers.gas.points.p3 = { stroke = 0.0, pressure = "3 MPa" }
            chambers.gas.pieces = [
                { law = "polytropic", points = ["p4", "p1"], exponent = 1.0 },
                { law = "polytropic", points = ["p2", "p3"], exponent = 1.0 },
            ]
        """)
        results = crankwork.analyse(machine)
        assert results["indicated_work.gas"] == pytest.approx(4605.17018599, rel=1e-11)
        (jump,) = [one for one in results.notices if one.code == "jump"]
        assert jump.values["step"] == pytest.approx(2.0e6)


class TestKhurmi8:
    """Khurmi and Gupta, Theory of machines, example 15.8, page 534: vertical double-acting steam engine at 125 degrees.

    As in `test_khurmi_forces`, but of two chambers on both sides of the piston, and with the exact inertia force: the
    book's two terms give 3019.894 N m with it.
    """

    def test_turning_moment(self):
        gear = GEAR.format(radius="225 mm", speed="200 rpm", length="1.2 m", mass=', mass = "225 kg"')
        gear = gear.replace('start = "180 deg"', 'start = "90 deg"').replace(
            'through = "O"', 'through = "O", angle = "-90 deg"'
        )
        machine = crankwork.read_machine(
            gear
            + """
            chambers.top = { slider = "piston", bore = "300 mm", pressure = "30 kPa" }
            chambers.bottom.slider = "piston"
            chambers.bottom.bore = "300 mm"
            chambers.bottom.rod_diameter = "50 mm"
            chambers.bottom.sense = -1
            chambers.bottom.pressure = "1.5 kPa"
            method = { weights = true, gravity = "9.81 m/s2" }
        """
        )
        results = at(machine, 125.0)
        area, less = math.pi * 0.3**2 / 4, math.pi * 0.05**2 / 4
        assert results["gas_force.top"] + results["gas_force.bottom"] == pytest.approx(
            30e3 * area - 1.5e3 * (area - less), rel=1e-12
        )
        # what the exact inertia force differs by from the two terms that the book takes
        phi, w, r, l = math.radians(125.0), 200 * math.pi / 30, 0.225, 1.2  # noqa: E741
        exact = results["slider_acceleration.piston"][0]
        terms = w**2 * r * (math.cos(phi) + math.cos(2 * phi) * r / l)
        sin = r / l * math.sin(phi)
        arm = r * (math.sin(phi) + math.cos(phi) * sin / math.sqrt(1 - sin**2))
        assert -results["balancing_torque"][0] + 225 * (exact - terms) * arm == pytest.approx(3019.894, rel=1e-6)
