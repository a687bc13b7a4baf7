#!/usr/bin/env python3
"""Strain paths of one point of J2 plasticity in plane stress, for tests/materials/plastic_plane_stress_test.cpp.

Independent of the program's algorithm: radial return in THREE dimensions (Krieg and Key 1976), with the thickness strain increment
searched by bisection until sigma_zz = 0, and the plastic multiplier of each trial searched by bisection too. Backward Euler in both,
so that the numbers agree step by step. Transverse shear correction 1. Writes CSV: a row a step.

usage: python3 j2_plane_stress.py > j2_plane_stress.csv
"""
import math
import random

E, NU = 210.0, 0.3
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
STRAIN = [0.0, 0.002, 0.01, 0.03, 0.08, 0.2, 0.5, 1.0]
STRESS = [0.25, 0.30, 0.36, 0.42, 0.47, 0.52, 0.58, 0.60]
C, P, DT = 40.0, 5.0, 1e-3


def table(p):
    """Piecewise linear, the last piece going on."""
    i = 0
    while i + 2 < len(STRAIN) and p > STRAIN[i + 1]:
        i += 1
    return STRESS[i] + (STRESS[i + 1] - STRESS[i]) * (p - STRAIN[i]) / (STRAIN[i + 1] - STRAIN[i])


def line(p):
    etan = 2.0
    return 0.25 + E * etan / (E - etan) * p


def bisect(f, low, high):
    """Root of an ascending function."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if f(middle) > 0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def three_dimensional(s, p, d, hardening, factor):
    """s, d: xx, yy, zz, xy, yz, zx (engineering shears). Stress and plastic strain after radial return."""
    volume = d[0] + d[1] + d[2]
    trial = [s[i] + K * volume + 2 * G * (d[i] - volume / 3) for i in range(3)] + [s[i] + G * d[i] for i in range(3, 6)]
    mean = sum(trial[:3]) / 3
    dev = [trial[i] - mean for i in range(3)] + trial[3:]
    q = math.sqrt(1.5 * (dev[0] ** 2 + dev[1] ** 2 + dev[2] ** 2 + 2 * (dev[3] ** 2 + dev[4] ** 2 + dev[5] ** 2)))
    if q <= factor * hardening(p):
        return trial, p
    dp = bisect(lambda x: 3 * G * x + factor * hardening(p + x) - q, 0.0, q / (3 * G))
    scale = 1 - 3 * G * dp / q
    return [mean + scale * dev[i] for i in range(3)] + [scale * x for x in dev[3:]], p + dp


def step(s, p, d, hardening, rate):
    """s, d: xx, yy, xy, yz, zx."""
    factor = 1.0
    if rate:
        zz = -(d[0] + d[1])
        speed = math.sqrt(d[0] ** 2 + d[1] ** 2 + zz ** 2 + 0.5 * (d[2] ** 2 + d[3] ** 2 + d[4] ** 2)) / DT
        factor = 1 + (speed / C) ** (1 / P)

    def full(zz):
        return three_dimensional([s[0], s[1], 0.0, *s[2:]], p, [d[0], d[1], zz, *d[2:]], hardening, factor)

    reach = 4 * (abs(d[0]) + abs(d[1])) + 1e-3
    zz = bisect(lambda x: full(x)[0][2], -reach, reach)
    stress, strain = full(zz)
    return [stress[0], stress[1], stress[3], stress[4], stress[5]], strain


def paths():
    rng = random.Random(24)
    yield "uniaxial", table, False, [(0.003, 0, 0, 0, 0)] * 25
    yield "biaxial", table, False, [(0.002, 0.002, 0, 0, 0)] * 15 + [(-0.001, 0.003, 0, 0, 0)] * 15
    yield "shear", table, False, [(0, 0, 0.004, 0, 0)] * 15 + [(0, 0, 0, 0.004, 0.002)] * 15
    yield "cyclic", line, False, ([(0.0015, -0.0005, 0, 0, 0)] * 10 + [(-0.0015, 0.0005, 0, 0, 0)] * 20) * 2
    yield "large", table, False, [(0.05, -0.02, 0.03, 0.01, 0)] * 10 + [(-0.2, 0.3, 0, 0, 0.1)] * 4
    yield "rate", table, True, [(0.001, 0, 0, 0, 0)] * 15 + [(0.02, -0.005, 0.01, 0, 0)] * 10
    yield "random", table, False, [tuple(rng.uniform(-0.006, 0.006) for _ in range(5)) for _ in range(80)]


def main():
    print("path,law,rate,dxx,dyy,dxy,dyz,dzx,sxx,syy,sxy,syz,szx,plastic_strain")
    for name, hardening, rate, increments in paths():
        s, p = [0.0] * 5, 0.0
        for d in increments:
            s, p = step(s, p, d, hardening, rate)
            numbers = ",".join(f"{x:.17g}" for x in (*d, *s, p))
            print(f"{name},{hardening.__name__},{int(rate)},{numbers}")


if __name__ == "__main__":
    main()
