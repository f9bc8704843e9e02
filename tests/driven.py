"""Machines whose driver is no crank."""

from crankwork.mechanism.driver import Cylinder, Law, LinkMotor, Segment
from crankwork.mechanism.dyads import RRR
from crankwork.mechanism.mechanism import LinkPoint, Mechanism


def there_and_back(low, high):
    """Return a law from one value to another and back in 5 s."""
    return Law((Segment("3-4-5", high, 0.45), Segment("dwell", high, 0.15), Segment("cycloidal", low, 0.4)), 5.0, low)


BOOM = Mechanism(
    Cylinder("A", "B", there_and_back(0.8, 1.2)),
    (RRR("A", "O", "B", "cylinder", "boom", 0.8, 0.9, branch=-1),),
    ground={"O": (0.1, 0.5), "A": (0.4, -0.2)},
    points=(LinkPoint("T", "boom", 2.0, 0.1),),
)
ELBOW = Mechanism(
    # a motor in the pin C of two links; the second drives a rocker
    LinkMotor(("upper", "lower"), "C", (0.5, 0.4), 2.0, there_and_back(0.0, 0.5)),
    (RRR("O", "E", "D", "third_side", "rocker", 0.7, 0.6), RRR("O", "D", "C", "upper", "lower", 0.5, 0.4)),
    ground={"O": (0.0, 0.0), "E": (0.6, 0.1)},
    points=(LinkPoint("P", "upper", 0.3, 0.05),),
)
