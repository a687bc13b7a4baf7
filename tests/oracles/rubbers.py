#!/usr/bin/env python3
"""Cauchy stresses and principal stiffnesses of rubbers from their strain energies alone, by differences of the energy.

For symmetric stretches U (no rotation): sigma = dW/dF F^T / J by central differences, stiffness = the largest of
lambda_i^2 d2W/dlambda_i^2. Writes rubbers.csv: law, the six entries of U (xx yy zz xy yz zx), the six stresses, the stiffness.
The constants are repeated in tests/materials/rubber_test.cpp."""
import csv
import math
import pathlib
import random

I3 = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transpose(a):
    return [list(r) for r in zip(*a)]


def determinant(a):
    return (a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0])
            + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]))


def eigenvalues(a):
    """Of a symmetric matrix, by the classical rotations of Jacobi about its largest entry."""
    a = [r[:] for r in a]
    for _ in range(60):
        p, q = max(((0, 1), (1, 2), (0, 2)), key=lambda k: abs(a[k[0]][k[1]]))
        if abs(a[p][q]) < 1e-18:
            break
        angle = 0.5 * math.atan2(2 * a[p][q], a[p][p] - a[q][q])
        r = [row[:] for row in I3]
        r[p][p] = r[q][q] = math.cos(angle)
        r[p][q], r[q][p] = -math.sin(angle), math.sin(angle)
        a = product(transpose(r), product(a, r))
    return [a[i][i] for i in range(3)]


def invariants(l2):
    return sum(l2), l2[0] * l2[1] + l2[1] * l2[2] + l2[2] * l2[0], math.prod(l2)


def blatz_ko(l2, g=1.3):
    q = 0.463 / (1 - 2 * 0.463)
    return g / 2 * (sum(l2) - 3 + (math.prod(l2) ** -q - 1) / q)


def mooney_rivlin(l2, a=0.8, b=0.25, nu=0.49):
    i, ii, iii = invariants(l2)
    c, d = 0.5 * a + b, (a * (5 * nu - 2) + b * (11 * nu - 5)) / (2 * (1 - 2 * nu))
    return a * (i - 3) + b * (ii - 3) + c * (iii ** -2 - 1) + d * (iii - 1) ** 2


def hyperelastic(l2, c10=0.5, c01=0.2, c11=0.03, c20=-0.02, c02=0.01, c30=0.004, nu=0.48):
    i, ii, iii = invariants(l2)
    m, n, j = i * iii ** (-1 / 3) - 3, ii * iii ** (-2 / 3) - 3, iii ** 0.5
    mu = 2 * (c10 + c01)
    bulk = 2 * mu * (1 + nu) / (3 * (1 - 2 * nu))
    return c10 * m + c01 * n + c11 * m * n + c20 * m**2 + c02 * n**2 + c30 * m**3 + bulk / 2 * (j - 1) ** 2


def ogden(l2, mu=(0.63, 0.0012, -0.01), alpha=(1.3, 5.0, -2.0), nu=0.48):
    j = math.prod(l2) ** 0.5
    bulk = sum(m * a for m, a in zip(mu, alpha)) * (1 + nu) / (3 * (1 - 2 * nu))
    star = [math.sqrt(x) * j ** (-1 / 3) for x in l2]
    return sum(m / a * (sum(x**a for x in star) - 3) for m, a in zip(mu, alpha)) + bulk * (j - 1 - math.log(j))


def frazer_nash(l2, c100=1.1, c200=0.05, c300=-0.03, c400=0.01, c110=0.04, c210=-0.02, c010=-0.3, c020=0.06, nu=0.48):
    j = math.prod(l2) ** 0.5
    e = [(x * j ** (-2 / 3) - 1) / 2 for x in l2]
    i, ii = sum(e), e[0] * e[1] + e[1] * e[2] + e[2] * e[0]
    bulk = 2 * (c100 - c010 / 2) * (1 + nu) / (3 * (1 - 2 * nu))
    return (c100 * i + c200 * i**2 + c300 * i**3 + c400 * i**4 + c110 * i * ii + c210 * i**2 * ii + c010 * ii + c020 * ii**2
            + bulk / 2 * (j - 1) ** 2)


def energy(law, f):
    return law(eigenvalues(product(f, transpose(f))))


def stress(law, f, h=1e-3):
    p = [[0.0] * 3 for _ in range(3)]
    for i in range(3):
        for j in range(3):
            at = {}
            for k in (-3, -2, -1, 1, 2, 3):
                moved = [r[:] for r in f]
                moved[i][j] += k * h
                at[k] = energy(law, moved)
            p[i][j] = (45 * (at[1] - at[-1]) - 9 * (at[2] - at[-2]) + at[3] - at[-3]) / (60 * h)
    s = product(p, transpose(f))
    return [[x / determinant(f) for x in r] for r in s]


def stiffness(law, stretches, h=1e-3):
    worst = 0.0
    for i in range(3):
        at = []
        for k in (-2, -1, 0, 1, 2):
            moved = list(stretches)
            moved[i] *= 1 + k * h
            at.append(law([x * x for x in moved]))
        worst = max(worst, (-at[0] + 16 * at[1] - 30 * at[2] + 16 * at[3] - at[4]) / (12 * h * h))
    return worst


def rotation(rng):
    a, b, c, d = (rng.gauss(0, 1) for _ in range(4))
    n = math.sqrt(a * a + b * b + c * c + d * d)
    a, b, c, d = a / n, b / n, c / n, d / n
    return [[1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)]]


def main():
    rng = random.Random(27)
    rows = []
    for law in (blatz_ko, mooney_rivlin, hyperelastic, ogden, frazer_nash):
        cases = [(I3, l) for l in ([1, 1, 1], [2, 0.71, 0.71], [0.5, 1.4, 1.4], [1.5, 1.5, 0.45], [1.02, 1.02, 1.02])]
        for _ in range(12):
            l = [math.exp(rng.uniform(-0.6, 0.6)) for _ in range(3)]
            scale = (math.exp(rng.uniform(-0.05, 0.05)) / math.prod(l)) ** (1 / 3)
            cases.append((rotation(rng), [x * scale for x in l]))
        for q, l in cases:
            u = product(q, product([[l[i] if i == j else 0.0 for j in range(3)] for i in range(3)], transpose(q)))
            s = stress(law, u)
            entries = lambda t: [t[0][0], t[1][1], t[2][2], t[0][1], t[1][2], t[2][0]]
            rows.append([law.__name__] + [f"{x:.17g}" for x in entries(u)] + [f"{x:.12g}" for x in entries(s)] + [f"{stiffness(law, l):.9g}"])
    with open(pathlib.Path(__file__).with_suffix(".csv"), "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
