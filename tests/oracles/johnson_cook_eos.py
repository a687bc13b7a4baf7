#!/usr/bin/env python3
"""Strain paths of one point of *MAT_JOHNSON_COOK with an equation of state, for tests/materials/johnson_cook_eos_test.cpp.

Independent of the program's algorithm: the plastic multiplier by bisection (j2_metals.py), and the pressure by bisection on the balance of
the internal energy, E_n - E_(n-1) = V_mid s_mid:de - dV (p_(n-1) + p_n)/2 with p_n = p(mu_n, E_n); both formulas of the pressure as the
manual prints them. Writes CSV, a row a step: law, path, strains (engineering shears), V/V0, stresses, plastic strain, temperature, damage,
E, pressure.

usage: python3 johnson_cook_eos.py > johnson_cook_eos.csv
"""
import random

from j2_metals import JohnsonCook, bisect, three_dimensional


def polynomial(mu, energy):
    c0, c1, c2, c3, c4, c5, c6 = 0.0, 140.0, 180.0, 90.0, 1.9, 0.6, 0.3
    squeezed = max(mu, 0.0)
    return c0 + c1 * mu + c2 * squeezed ** 2 + c3 * mu ** 3 + (c4 + c5 * mu + c6 * squeezed ** 2) * energy


def gruneisen(mu, energy, rho=7.8e-6, c=4600.0, s1=1.4, s2=0.02, s3=0.01, g=2.0, a=0.46):
    bulk = rho * c * c
    if mu <= 0:
        return bulk * mu + (g + a * mu) * energy
    below = 1 - (s1 - 1) * mu - s2 * mu ** 2 / (mu + 1) - s3 * mu ** 3 / (mu + 1) ** 2
    return bulk * mu * (1 + (1 - g / 2) * mu - a / 2 * mu ** 2) / below ** 2 + (g + a * mu) * energy


def paths():
    rng = random.Random(15)
    yield [(-0.01, 0, 0, 0, 0, 0)] * 15 + [(0.01, 0, 0, 0.002, 0, 0)] * 15
    yield [tuple(rng.uniform(-0.01, 0.01) for _ in range(6)) for _ in range(30)]
    yield [(-0.02, -0.015, -0.01, 0.02, 0.01, -0.01)] * 8 + [(0.004, 0.006, 0.005, 0, 0.03, 0)] * 10


def main():
    print("law,path,dxx,dyy,dzz,dxy,dyz,dzx,volume,sxx,syy,szz,sxy,syz,szx,plastic_strain,temperature,damage,energy,pressure")
    for law, initial in ((polynomial, 0.02), (gruneisen, 0.0)):
        for number, increments in enumerate(paths()):
            metal, dev, volume, energy, pressure = JohnsonCook(0, False), [0.0] * 6, 1.0, initial, 0.0
            for d in increments:
                third = sum(d[:3]) / 3
                de = [d[0] - third, d[1] - third, d[2] - third, *d[3:]]
                new, dp, q = three_dimensional(dev, de, metal.yield_stress(d))
                metal.finish(d, dp, q, -pressure)
                grown = volume * (1 + sum(d[:3]) / 2) / (1 - sum(d[:3]) / 2)
                mean_volume, change = 0.5 * (volume + grown), grown - volume
                work = mean_volume * sum(0.5 * (a + b) * e for a, b, e in zip(dev, new, de))
                mu = 1 / grown - 1

                def excess(e):
                    return e - energy - work + change * 0.5 * (pressure + law(mu, e))

                energy = bisect(excess, energy - 10.0, energy + 10.0)
                pressure, dev, volume = law(mu, energy), new, grown
                stress = [dev[i] - pressure for i in range(3)] + dev[3:]
                print(",".join([law.__name__, str(number)] + [f"{v:.15g}" for v in
                      [*d, volume, *stress, metal.p, *metal.extra, energy, pressure]]))


if __name__ == "__main__":
    main()
