#!/usr/bin/env python3
"""Strain paths of one point of metals that differ in their yield stress, for tests/materials/metals_test.cpp.

Independent of the program's algorithm, as j2_plane_stress.py: radial return in three dimensions, the plastic multiplier by bisection,
and for shells the thickness strain increment by bisection too. Backward Euler in both, so that the numbers agree step by step.
Writes CSV, a row a step; solids have the strains and stresses xx, yy, zz, xy, yz, zx (engineering shears), shells zz strain as a result.

usage: python3 j2_metals.py > j2_metals.csv
"""
import math
import random

E, NU = 210.0, 0.3
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
DT = 1e-3


def bisect(f, low, high):
    """Root of an ascending function."""
    for _ in range(300):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if f(middle) > 0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def linear(x, y, at, beyond):
    """Piecewise linear; beyond the last point its slope goes on (beyond = True) or its value holds."""
    if not beyond and at <= x[0]:
        return y[0]
    if not beyond and at >= x[-1]:
        return y[-1]
    i = 0
    while i + 2 < len(x) and at > x[i + 1]:
        i += 1
    return y[i] + (y[i + 1] - y[i]) * (at - x[i]) / (x[i + 1] - x[i])


STRAIN = [0.0, 0.002, 0.01, 0.03, 0.08, 0.2, 0.5, 1.0]
STRESS = [0.25, 0.30, 0.36, 0.42, 0.47, 0.52, 0.58, 0.60]


def hardening(p):
    return linear(STRAIN, STRESS, p, True)


def deviatoric(e):
    third = sum(e[:3]) / 3
    return [e[0] - third, e[1] - third, e[2] - third, *e[3:]]


def square(e):
    """e_ij e_ij of engineering shears."""
    return e[0] ** 2 + e[1] ** 2 + e[2] ** 2 + 0.5 * (e[3] ** 2 + e[4] ** 2 + e[5] ** 2)


def total_rate(e):
    return math.sqrt(square(e)) / DT


class Metal:
    """One point's own values; the yield stress of this step as a function of the plastic increment."""

    def __init__(self):
        self.p = 0.0
        self.extra = (0.0, 0.0)  # temperature and damage

    def yield_stress(self, e):
        raise NotImplementedError

    def finish(self, e, dp, q, mean):
        self.p += dp


class Softening(Metal):
    """LCSS that rises and falls; past the last point its value holds."""

    def yield_stress(self, e):
        return lambda dp: linear([0, 0.05, 0.2, 0.5], [0.25, 0.4, 0.3, 0.1], self.p + dp, False)


class Tabulated(Metal):
    """A table of curves by rate: linear or logarithmic interpolation, total or plastic rate."""
    RATES = [0.1, 2.0, 50.0]
    SCALE = [1.0, 1.3, 1.9]

    def __init__(self, logarithmic, viscoplastic):
        super().__init__()
        self.logarithmic, self.viscoplastic = logarithmic, viscoplastic

    def at(self, p, rate):
        curves = [hardening(p), 1.3 * hardening(p) + 0.05 * p, linear([0, 0.1, 0.4], [0.6, 0.8, 0.7], p, False)]
        if self.logarithmic:
            return linear([math.log(r) for r in self.RATES], curves, math.log(max(rate, 1e-300)), False)
        return linear(self.RATES, curves, rate, False)

    def yield_stress(self, e):
        if self.viscoplastic:
            return lambda dp: self.at(self.p + dp, dp / DT)
        return lambda dp: self.at(self.p + dp, total_rate(e))


class Factor(Metal):
    """Cowper and Symonds, C = 40, P = 5, or a curve LCSR."""

    def __init__(self, form):
        super().__init__()
        self.form, self.rate = form, 0.0

    @staticmethod
    def cowper_symonds(rate):
        return 1 + (rate / 40.0) ** 0.2

    @staticmethod
    def curve(rate):
        return linear([0.5, 3.0, 40.0], [1.0, 1.5, 1.6], rate, False)

    def yield_stress(self, e):
        if self.form == "plastic":
            return lambda dp: hardening(self.p + dp) * self.cowper_symonds(dp / DT)
        if self.form == "added":
            return lambda dp: hardening(self.p + dp) + 0.25 * (self.cowper_symonds(dp / DT) - 1)
        if self.form == "deviatoric":
            return lambda dp: hardening(self.p + dp) * self.cowper_symonds(total_rate(deviatoric(e)))
        if self.form == "filtered":
            return lambda dp: hardening(self.p + dp) * self.cowper_symonds(0.8 * self.rate + 0.2 * total_rate(e))
        if self.form == "curve":
            return lambda dp: hardening(self.p + dp) * self.curve(total_rate(e))
        return lambda dp: hardening(self.p + dp) * self.curve(dp / DT)

    def finish(self, e, dp, q, mean):
        super().finish(e, dp, q, mean)
        self.rate = 0.8 * self.rate + 0.2 * total_rate(e)


class Power(Metal):
    """*MAT_ISOTROPIC_ELASTIC_PLASTIC, *MAT_POWER_LAW_PLASTICITY, *MAT_SIMPLIFIED_JOHNSON_COOK."""

    def __init__(self, form):
        super().__init__()
        self.form = form

    def johnson_cook(self, p, rate, capped=None):
        y = 0.3 + 0.4 * p ** 0.26
        y = min(y, capped or y)
        return y * (1 + 0.05 * math.log(max(rate / 0.2, 1.0)))

    def yield_stress(self, e):
        effective = math.sqrt(2 / 3) * total_rate(deviatoric(e))
        if self.form == "line":
            return lambda dp: 0.25 + E * 2.0 / (E - 2.0) * (self.p + dp)
        if self.form == "power":
            return lambda dp: 0.6 * ((E / 0.6) ** (1 / (0.2 - 1)) + self.p + dp) ** 0.2 * Factor.cowper_symonds(total_rate(e))
        if self.form == "power_vp":
            return lambda dp: 0.6 * ((0.3 / 0.6) ** (1 / 0.2) + self.p + dp) ** 0.2 * Factor.cowper_symonds(dp / DT)
        if self.form == "simplified":
            return lambda dp: min(self.johnson_cook(self.p + dp, effective, 0.55), 0.62)
        return lambda dp: self.johnson_cook(self.p + dp, dp / DT)


class JohnsonCook(Metal):
    """Heating from the step's end, damage; RATEOP 0 and 1."""
    RHO, CP, TR, TM, M = 7.8e-6, 4.5e2, 293.0, 1793.0, 1.03
    D = (0.5, 3.44, -2.12, 0.02, 0.61)

    def __init__(self, rateop, viscoplastic):
        super().__init__()
        self.t, self.damage, self.rateop, self.viscoplastic = self.TR, 0.0, rateop, viscoplastic

    def relative(self):
        return min(max((self.t - self.TR) / (self.TM - self.TR), 0.0), 1.0)

    def factor(self, rate):
        log = math.log(max(rate / 0.2, 1.0))
        return [1 + 0.05 * log, 1 + 0.05 * log + 0.01 * log ** 2, math.exp(0.05 * log)][self.rateop]

    def rate(self, e, dp):
        return dp / DT if self.viscoplastic else math.sqrt(2 / 3) * total_rate(deviatoric(e))

    def yield_stress(self, e):
        soft = 1 - self.relative() ** self.M
        return lambda dp: (0.3 + 0.4 * (self.p + dp) ** 0.26) * self.factor(self.rate(e, dp)) * soft

    def finish(self, e, dp, q, mean):
        if dp > 0:
            d = self.D
            fracture = (d[0] + d[1] * math.exp(d[2] * mean / q)) * (1 + d[3] * math.log(max(self.rate(e, dp) / 0.2, 1.0)))
            self.damage += dp / (fracture * (1 + d[4] * self.relative()))
        self.t += q * dp / (self.RHO * self.CP)
        super().finish(e, dp, q, mean)
        self.extra = (self.t, self.damage)


def three_dimensional(s, d, limit):
    """s, d: xx, yy, zz, xy, yz, zx (engineering shears). Stress, plastic increment, effective stress after radial return."""
    volume = d[0] + d[1] + d[2]
    trial = [s[i] + K * volume + 2 * G * (d[i] - volume / 3) for i in range(3)] + [s[i] + G * d[i] for i in range(3, 6)]
    mean = sum(trial[:3]) / 3
    dev = [trial[i] - mean for i in range(3)] + trial[3:]
    q = math.sqrt(1.5 * square([*dev[:3], *(2 * x for x in dev[3:])]))
    if q <= limit(0.0):
        return trial, 0.0, q
    dp = bisect(lambda x: 3 * G * x + limit(x) - q, 0.0, q / (3 * G))
    scale = 1 - 3 * G * dp / q
    return [mean + scale * dev[i] for i in range(3)] + [scale * x for x in dev[3:]], dp, scale * q


def solid_step(metal, s, d):
    limit = metal.yield_stress(d)
    stress, dp, q = three_dimensional(s, d, limit)
    metal.finish(d, dp, q, sum(stress[:3]) / 3)
    return stress, d[2]


def shell_step(metal, s, d):
    rated = [d[0], d[1], -(d[0] + d[1]), *d[3:]]
    limit = metal.yield_stress(rated)
    reach = 4 * (abs(d[0]) + abs(d[1])) + 1e-3

    def full(zz):
        return three_dimensional([s[0], s[1], 0.0, *s[3:]], [d[0], d[1], zz, *d[3:]], limit)

    zz = bisect(lambda x: full(x)[0][2], -reach, reach)
    stress, dp, q = full(zz)
    metal.finish(rated, dp, q, sum(stress[:3]) / 3)
    return stress, zz


def metals():
    yield "softening", Softening
    yield "table", lambda: Tabulated(False, False)
    yield "table_log", lambda: Tabulated(True, False)
    yield "table_vp", lambda: Tabulated(False, True)
    yield "table_log_vp", lambda: Tabulated(True, True)
    for form in ("plastic", "added", "deviatoric", "filtered", "curve", "curve_vp"):
        yield "factor_" + form, lambda form=form: Factor(form)
    for form in ("line", "power", "power_vp", "simplified", "simplified_vp"):
        yield form, lambda form=form: Power(form)
    for rateop, viscoplastic in ((0, False), (0, True), (1, True), (2, True)):
        yield f"johnson_cook_{rateop}{'_vp' if viscoplastic else ''}", lambda a=rateop, b=viscoplastic: JohnsonCook(a, b)


def paths():
    rng = random.Random(24)
    yield [(0.0005 * (1 + i % 4), 0, 0, 0, 0, 0) for i in range(12)] + [(0.02, -0.01, -0.008, 0, 0, 0)] * 8
    yield [(0, 0, 0, 0.004, 0, 0.001)] * 8 + [(0, 0, 0, 0.0001, -0.03, 0)] * 8
    yield [tuple(rng.uniform(-0.01, 0.01) for _ in range(6)) for _ in range(25)]
    yield [(0.1, -0.04, -0.05, 0.06, 0.02, 0), (-0.3, 0.4, -0.1, 0, 0, 0.2)]


def main():
    print("law,use,path,dxx,dyy,dzz,dxy,dyz,dzx,sxx,syy,szz,sxy,syz,szx,plastic_strain,temperature,damage")
    for name, make in metals():
        for use, step in (("solid", solid_step), ("shell", shell_step)):
            for number, increments in enumerate(paths()):
                metal, s = make(), [0.0] * 6
                for d in increments:
                    s, zz = step(metal, s, d)
                    numbers = ",".join(f"{x:.13g}" for x in (d[0], d[1], zz, *d[3:], *s, metal.p, *metal.extra))
                    print(f"{name},{use},{number},{numbers}")


if __name__ == "__main__":
    main()
