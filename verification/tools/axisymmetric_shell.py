"""An explicit program for shells of revolution under pressure, written apart from Kardan: an oracle for its shells.

Conical two-node elements with one point along the meridian, transverse shear (factor 5/6, elastic), Gauss points through the thickness,
Mises plasticity with linear isotropic hardening, central differences. Axes of an element: s along it, n = its normal. With the
velocities v, and w the rate at which the director tilts towards s:
  e_s = dv_s/ds + z dw/ds,  e_t = (v_r + z w cos a)/r,  g = dv_n/ds + w,  a the angle of s to the radius.
Nodal forces follow from the virtual power 2 pi r L (N_s e_s + N_t e_t + M_s k_s + M_t k_t + Q g).
"""
import math

GAUSS = {5: ((-0.9061798459386640, 0.2369268850561891), (-0.5384693101056831, 0.4786286704993665), (0.0, 0.5688888888888889),
             (0.5384693101056831, 0.4786286704993665), (0.9061798459386640, 0.2369268850561891))}


class Steel:
    """Elastic-plastic law in plane stress, principal axes s and t: return mapping of Simo and Taylor 1986 in the sum and the difference of
    the stresses, p = s + t and d = s - t: Mises stress^2 = p^2/4 + 3 d^2/4."""

    def __init__(self, e, nu, yield_stress=math.inf, tangent=0.0):
        self.e, self.nu, self.yield_stress = e, nu, yield_stress
        self.hardening = e * tangent / (e - tangent)

    def update(self, s, t, plastic, ds, dt):
        c = self.e / (1 - self.nu ** 2)
        s, t = s + c * (ds + self.nu * dt), t + c * (dt + self.nu * ds)
        p, d = s + t, s - t
        f = lambda p, d: math.sqrt(p * p / 4 + 0.75 * d * d)
        if f(p, d) <= self.yield_stress + self.hardening * plastic:
            return s, t, plastic
        # Flow: d(e_s) = x (2 s - t)/2 and so on, so p shrinks by 1 + x E/(1-nu)/2, d by 1 + x 3 G; x = d(plastic)/Mises.
        kp, kd = self.e / (1 - self.nu) / 2, 1.5 * self.e / (1 + self.nu)
        x = 0.0
        for _ in range(50):
            pn, dn = p / (1 + kp * x), d / (1 + kd * x)
            m = f(pn, dn)
            miss = m - self.yield_stress - self.hardening * (plastic + x * m)
            if abs(miss) < 1e-10 * self.yield_stress:
                break
            slope = -(kp * pn * pn / 4 / (1 + kp * x) + 0.75 * kd * dn * dn / (1 + kd * x)) / m
            x -= miss / (slope * (1 - self.hardening * x) - self.hardening * m)
        pn, dn = p / (1 + kp * x), d / (1 + kd * x)
        return (pn + dn) / 2, (pn - dn) / 2, plastic + x * f(pn, dn)


def respond(points, thickness, density, law, pressure, end, points_through=5, safety=0.5):
    """(t, axial displacement of the first node) over time. `points`: (r, z) from the axis to the clamped edge; the pressure acts along the
    normal that is on the left of the meridian."""
    n = len(points)
    r, z = [p[0] for p in points], [p[1] for p in points]
    v = [[0.0, 0.0, 0.0] for _ in range(n)]  # v_r, v_z, w at half steps
    shear = 5 / 6 * law.e / 2 / (1 + law.nu)
    rule = [(0.5 * thickness * x, 0.5 * thickness * w) for x, w in GAUSS[points_through]]
    state = [[(0.0, 0.0, 0.0)] * len(rule) for _ in range(n - 1)]
    shear_stress = [0.0] * (n - 1)
    mass = [0.0] * n
    shortest = math.inf
    for i in range(n - 1):
        length = math.hypot(r[i + 1] - r[i], z[i + 1] - z[i])
        shortest = min(shortest, length)
        for a, b in ((i, i + 1), (i + 1, i)):  # a third of the other radius: the shape function's share of the ring
            mass[a] += 2 * math.pi * density * thickness * length * (2 * r[a] + r[b]) / 6
    inertia = [m * (thickness ** 2 / 12 + shortest ** 2 / 12) for m in mass]
    dt = safety * shortest / math.sqrt(law.e / density / (1 - law.nu ** 2))
    z0, t, history = z[0], 0.0, [(0.0, 0.0)]
    first = True
    while t < end:
        force = [[0.0, 0.0, 0.0] for _ in range(n)]
        for i in range(n - 1):
            dr, dz = r[i + 1] - r[i], z[i + 1] - z[i]
            length, radius = math.hypot(dr, dz), 0.5 * (r[i] + r[i + 1])
            c, s = dr / length, dz / length
            (ur, uz, uw), (wr, wz, ww) = v[i], v[i + 1]
            e_s, k_s = ((wr - ur) * c + (wz - uz) * s) / length, (ww - uw) / length
            w = 0.5 * (uw + ww)
            e_t, k_t = 0.5 * (ur + wr) / radius, w * c / radius
            g = (-(wr - ur) * s + (wz - uz) * c) / length + w
            shear_stress[i] += shear * g * dt if not first else 0.0
            n_s = n_t = m_s = m_t = 0.0
            if not first:
                state[i] = [law.update(*old, (e_s + h * k_s) * dt, (e_t + h * k_t) * dt) for old, (h, _) in zip(state[i], rule)]
            for (ss, st, _), (h, weight) in zip(state[i], rule):
                n_s, n_t, m_s, m_t = n_s + weight * ss, n_t + weight * st, m_s + weight * h * ss, m_t + weight * h * st
            q = shear_stress[i] * thickness
            ring = 2 * math.pi * radius
            for a, sign in ((i, -1.0), (i + 1, 1.0)):
                force[a][0] -= ring * (sign * (n_s * c - q * s) + n_t * length / 2 / radius)
                force[a][1] -= ring * sign * (n_s * s + q * c)
                force[a][2] -= ring * (sign * m_s + length / 2 * (m_t * c / radius + q))
            for a, b in ((i, i + 1), (i + 1, i)):
                push = pressure * 2 * math.pi * length * (2 * r[a] + r[b]) / 6
                force[a][0] -= push * s
                force[a][1] += push * c
        kick = dt / 2 if first else dt
        first = False
        for a in range(n - 1):
            v[a][0] += kick * force[a][0] / mass[a] if a > 0 else 0.0
            v[a][1] += kick * force[a][1] / mass[a]
            v[a][2] += kick * force[a][2] / inertia[a] if a > 0 else 0.0
            r[a] += dt * v[a][0]
            z[a] += dt * v[a][1]
        t += dt
        history.append((t, z[0] - z0))
    return history
