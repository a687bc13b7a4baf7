#!/usr/bin/python3
"""Writes mesh.k, the hexahedra of the slider-crank example: what the rigid parts look like. Their masses and inertias stand
in slider_crank.k (*PART_INERTIA), so the mesh is for the eye only; units m.

  make_mesh.py > mesh.k
"""
import math

import numpy as np

A = np.array([0.1, 0.0, 0.0])                                # crank pin
B = np.array([0.37838821814150103, 0.05, 0.1])               # centre of the slider
nodes, solids = [], []


def grid(shape, place, part):
    """Hexahedra on a grid of shape (i, j, k) cells; `place` maps unit coordinates to points."""
    first = len(nodes)
    ni, nj, nk = shape
    for k in range(nk + 1):
        for j in range(nj + 1):
            for i in range(ni + 1):
                nodes.append(place(i / ni, j / nj, k / nk))
    number = lambda i, j, k: first + 1 + i + (ni + 1) * (j + (nj + 1) * k)
    for k in range(nk):
        for j in range(nj):
            for i in range(ni):
                solids.append((part, [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k),
                                      number(i, j, k + 1), number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1),
                                      number(i, j + 1, k + 1)]))


def box(low, high, shape, part):
    low, high = np.array(low), np.array(high)
    grid(shape, lambda u, v, w: low + np.array([u, v, w]) * (high - low), part)


def disc(u, v):
    """The square [-1, 1]^2 onto the unit disc, squares onto circles near the rim."""
    a, b = 2 * u - 1, 2 * v - 1
    return np.array([a * math.sqrt(1 - b * b / 2), b * math.sqrt(1 - a * a / 2)])


def rod(start, end, radius, cells, length_cells, part):
    """A round bar."""
    axis = (end - start) / np.linalg.norm(end - start)
    y = np.cross([0, 0, 1.0], axis) if abs(axis[2]) < 0.9 else np.array([0, 1.0, 0])
    y /= np.linalg.norm(y)
    z = np.cross(axis, y)

    def place(u, v, w):
        a, b = radius * disc(u, v)
        return start + w * (end - start) + a * y + b * z
    grid((cells, cells, length_cells), place, part)


def ball(center, radius, cells, part):
    def place(u, v, w):
        x, y, z = 2 * u - 1, 2 * v - 1, 2 * w - 1
        return center + radius * np.array([
            x * math.sqrt(1 - y * y / 2 - z * z / 2 + y * y * z * z / 3),
            y * math.sqrt(1 - z * z / 2 - x * x / 2 + z * z * x * x / 3),
            z * math.sqrt(1 - x * x / 2 - y * y / 2 + x * x * y * y / 3)])
    grid((cells, cells, cells), place, part)


# Part 1, crank: hub, web and pin. It turns below the coupler's ball.
rod(np.array([0, 0, -0.030]), np.array([0, 0, -0.016]), 0.022, 6, 2, 1)
box((0.012, -0.011, -0.030), (0.112, 0.011, -0.018), (14, 4, 2), 1)
rod(np.array([0.1, 0, -0.018]), np.array([0.1, 0, -0.004]), 0.006, 4, 2, 1)
# Part 2, coupler: a rod with a ball at each end.
along = (B - A) / np.linalg.norm(B - A)
rod(A + 0.009 * along, B - 0.009 * along, 0.0055, 4, 30, 2)
ball(A, 0.011, 6, 2)
ball(B, 0.011, 6, 2)
# Part 3, slider: two cheeks and two end plates around the coupler's ball.
for side in (-1, 1):
    box(B + [-0.035, min(side * 0.014, side * 0.024), -0.016], B + [0.035, max(side * 0.014, side * 0.024), 0.016],
        (10, 2, 5), 3)
box(B + [0.027, -0.014, -0.016], B + [0.035, 0.014, 0.016], (2, 4, 5), 3)
box(B + [-0.035, -0.014, -0.016], B + [-0.027, 0.014, -0.010], (2, 4, 1), 3)
# Part 4, frame: bearing of the crank and the rails of the slider.
rod(np.array([0, 0, -0.075]), np.array([0, 0, -0.032]), 0.016, 6, 5, 4)
box((-0.05, -0.05, -0.087), (0.05, 0.05, -0.075), (8, 8, 2), 4)
for side in (-1, 1):
    y = sorted((0.05 + side * 0.026, 0.05 + side * 0.034))
    box((0.12, y[0], 0.094), (0.46, y[1], 0.106), (34, 1, 2), 4)

print("$ Written by make_mesh.py. Nodes 1 to %d, solids 1 to %d." % (len(nodes), len(solids)))
print("*NODE")
for number, point in enumerate(nodes, 1):
    print("%8d%16.9f%16.9f%16.9f" % (number, *point))
print("*ELEMENT_SOLID")
for number, (part, corners) in enumerate(solids, 1):
    print("%8d%8d" % (number, part) + "".join("%8d" % c for c in corners))
print("*END")
