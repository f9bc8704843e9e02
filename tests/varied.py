"""A machine file some of whose fields vary: the analyses that a kernel of it is traced from."""

from __future__ import annotations

import numpy as np

import crankwork
from crankwork.description.document import numeric_field
from crankwork.kernel.compiled import Kernel
from crankwork.kinematics.crank_grid import CrankGrid


class Varied:
    """A machine file or template, the fields that vary, and analyses with each of them a little less and more."""

    def __init__(self, file, fields, part=0.02):
        self.description = crankwork.Description(file if "\n" in file else crankwork.template(file))
        self.fields, values = fields, self.description.values
        self.numbers = [numeric_field(values, key) for key in fields]
        self.middle = np.array([one.now for one in self.numbers])
        moved = [self.middle * (1 + sign * part * one) for one in np.eye(len(fields)) for sign in (-1, 1)]
        self.rows = np.array([self.middle, *moved])
        self.analysed = [self.results(one) for one in self.rows]
        self.traces = [one.trace for one in self.analysed]
        self.summary, self.cycle = self.analysed[0].summary, self.analysed[0].machine.cycle

    def results(self, design):
        """Return the analysis of a design."""
        pairs = zip(self.fields, self.numbers, design, strict=True)
        return crankwork.analyse(self.description.machine([f"{key}={one.written(float(x))}" for key, one, x in pairs]))

    def drawn(self, count, spread=0.02):
        """Return designs near the stated one, shape (fields, count)."""
        factors = np.random.default_rng(11).uniform(1 - spread, 1 + spread, (len(self.fields), count))
        return self.middle[:, None] * factors

    def kernel(self, keys, **asked):
        """Return what calculates single values of many designs."""
        return Kernel(self.traces, self.rows, keys, CrankGrid.from_degrees, cycle=self.cycle, **asked)
