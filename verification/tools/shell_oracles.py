"""Solutions that the shells of verification/deformable are held against and that are short enough to stand here."""
import math


def cantilever_step(force, mass, frequencies, t):
    """Deflection of the end of a beam at t under a force there from t = 0 on: sum over modes, 4 F/(m w^2) (1 - cos w t). The modes of Euler
    and Bernoulli's beam have the value 2 at the end where their mean square is 1; frequencies are Timoshenko's."""
    return sum(4 * force / (mass * w * w) * (1 - math.cos(w * t)) for w in (2 * math.pi * f for f in frequencies))


def timoshenko_first_frequency(e, g, rho, length, b, h):
    """First frequency [1/time] of a clamped Timoshenko beam of section b by h, shear factor 5/6: the root of Huang's equation (1961, J. Appl.
    Mech. 28, 579-584), with p^2 = rho A L^4 w^2/(E I), r^2 = I/(A L^2), s^2 = E I/(k A G L^2); it lies a little below Euler's."""
    area, inertia = b * h, b * h ** 3 / 12
    r2, s2 = inertia / (area * length ** 2), e * inertia / (5 / 6 * area * g * length ** 2)

    def value(p):
        root = math.sqrt((r2 - s2) ** 2 + 4 / p ** 2)
        alpha, beta = (math.sqrt((root - (r2 + s2)) / 2), math.sqrt((root + r2 + s2) / 2))
        return (2 + (p ** 2 * (r2 - s2) ** 2 + 2) * math.cosh(p * alpha) * math.cos(p * beta)
                - p * (r2 + s2) / math.sqrt(1 - p ** 2 * r2 * s2) * math.sinh(p * alpha) * math.sin(p * beta))

    euler = 1.8751040687 ** 2
    low, high = 0.9 * euler, 1.0001 * euler
    while high - low > 1e-12:
        middle = (low + high) / 2
        low, high = (middle, high) if value(low) * value(middle) > 0 else (low, middle)
    return low * math.sqrt(e * inertia / (rho * area)) / length ** 2 / (2 * math.pi)


def mindlin_first_frequency(a, h, e, nu, rho):
    """First flexural frequency of a simply supported square plate with shear (factor 5/6) and rotary inertia (Mindlin 1951): deflection
    W sin kx sin ky, rotations X cos kx sin ky and X sin kx cos ky.
      m w^2 W = 2 k shear (k W + X),   i w^2 X = k shear W + (2 k^2 bend + shear) X"""
    shear, bend, k = 5 / 6 * e / 2 / (1 + nu) * h, e * h ** 3 / 12 / (1 - nu * nu), math.pi / a
    m, i = rho * h, rho * h ** 3 / 12
    p, q, r, s = 2 * k * k * shear, 2 * k * shear, k * shear, 2 * k * k * bend + shear
    half = (p / m + s / i) / 2
    return math.sqrt(half - math.sqrt(half * half - (p * s - q * r) / (m * i))) / (2 * math.pi)


def solve(matrix, right):
    """Gaussian elimination of a small positive definite system."""
    a = [row + [b] for row, b in zip(matrix, right)]
    n = len(a)
    for k in range(n):
        for i in range(k + 1, n):
            f = a[i][k] / a[k][k]
            if f:
                a[i] = [x - f * y for x, y in zip(a[i], a[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (a[k][n] - sum(a[k][j] * x[j] for j in range(k + 1, n))) / a[k][k]
    return x


def pinched_cylinder(radius, length, h, e, nu, force, patch=(0.0, 0.0), twist=True, shear_factor=5 / 6, terms=(100, 100)):
    """Deflection in the middle of one of two opposite forces on a cylinder between diaphragms, each spread evenly over a patch of half
    length patch[0] and half angle patch[1]; Fourier series of Sanders' shell (1959) with shear; without stiffness against twist if not `twist`.

    u = U cos(lx) cos(nt), v = V sin(lx) sin(nt), w = W sin(lx) cos(nt), rotations X cos(lx) cos(nt), Y sin(lx) sin(nt), l = m pi/length:
      e_x = -l U,  e_t = (n V + W)/R,  g = l V - n U/R,  k_x = -l X,  k_t = n Y/R,  2 k_xt = l Y - n X/R + (l V + n U/R)/(2 R),
      g_xz = X + l W,  g_tz = Y - (n W + V)/R."""
    c, d, s = e * h / (1 - nu * nu), e * h ** 3 / 12 / (1 - nu * nu), shear_factor * e / 2 / (1 + nu) * h
    sinc = lambda x: math.sin(x) / x if x else 1.0
    r, w = radius, 0.0
    for m in range(1, 2 * terms[0], 2):
        l = m * math.pi / length
        for n in range(0, 2 * terms[1], 2):
            ex, et, g = [-l, 0, 0, 0, 0], [0, n / r, 1 / r, 0, 0], [-n / r, l, 0, 0, 0]
            kx, kt, kxt = [0, 0, 0, -l, 0], [0, 0, 0, 0, n / r], [n / (2 * r * r), l / (2 * r), 0, -n / r, l]
            gxz, gtz = [0, 0, l, 1, 0], [0, -1 / r, -n / r, 0, 1]
            free = [0, 2, 3] if n == 0 else range(5)  # V and Y do not exist at n = 0
            stiff = [[c * (ex[i] * ex[j] + et[i] * et[j] + nu * (ex[i] * et[j] + et[i] * ex[j]) + (1 - nu) / 2 * g[i] * g[j]) +
                      d * (kx[i] * kx[j] + kt[i] * kt[j] + nu * (kx[i] * kt[j] + kt[i] * kx[j]) + twist * (1 - nu) / 2 * kxt[i] * kxt[j]) +
                      s * (gxz[i] * gxz[j] + gtz[i] * gtz[j]) for j in free] for i in free]
            sign = math.sin(m * math.pi / 2)
            load = 2 * force / (math.pi * radius * length) * sign * (1 if n == 0 else 2)
            load *= sinc(l * patch[0]) * sinc(n * patch[1])
            w += sign * solve(stiff, [load if i == 2 else 0.0 for i in free])[1 if n == 0 else 2]
    return w
