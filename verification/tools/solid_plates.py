"""f6 and f8 of verification/deformable with hexahedra, and the elastic-plastic plate."""
import math

import mesh
import shell_oracles
from shell_cases import IMPERIAL, ROOT, displacement, energy, frequencies, oracles, peak, quarter
from structure import Structure, elastic, plastic, shell_section, solid_section, write_case


def solid_run(deck, sample, end, size, e, nu, rho, share, slow):
    """A run at `share` of the time a pressure wave takes through `size`."""
    c = math.sqrt(e * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho))
    entry = {"deck": deck, "sample": sample, "steps": math.ceil(sample / (share * size / c)), "end": sample * math.ceil(end / sample - 1e-9)}
    return {**entry, "long": True} if slow else entry


def push(s, base, pressure):
    """Pressure on the upper face as forces of its nodes, upwards."""
    s.step()
    top = max(z for _, _, z in s.mesh.nodes)
    s.forces(3, {s.mesh.node(*base.nodes[n - 1][:2], top): pressure * area for n, area in base.corner_areas().items()})


def square_plate(n, layers, elform, hourglass, title, about, material):
    """A quarter of the plate f8, simply supported as Navier's series is: along the edge nothing moves in its direction nor across the plate."""
    o = oracles()["f8_square_plate"]
    base = mesh.rectangle(n, n, o["a"] / 2, o["a"] / 2)
    s = quarter(Structure(title, about, IMPERIAL, 0.006, mesh.extruded(base, layers, o["h"]), solid_section(elform), material))
    s.hourglass = hourglass
    s.hold(lambda x, y, z: x == o["a"] / 2, "yz")
    s.hold(lambda x, y, z: y == o["a"] / 2, "xz")
    return s, base


def square_plate_of_solids():
    """f8 under 3 psi with hexahedra: assumed strains on one layer and two, one-point elements on eight, full integration on four."""
    o = oracles()["f8_square_plate"]
    a, h, e, nu, rho = (o[k] for k in ("a", "h", "E", "nu", "rho"))
    folder, pressure, runs, figures = ROOT / "square_plate_of_solids", 3.0, {}, []
    oracle = {"file": "../square_plate/f8_square_plate_linear_step.csv", "columns": ["w_centre_mindlin"], "factor": pressure / o["p"]}
    f1 = shell_oracles.mindlin_first_frequency(a, h, e, nu, rho)
    # what of ELFORM 2 and 3 does not hold the limits of 1 % and 2 % has its own
    for key, n, layers, elform, hourglass, limits, slow in (("assumed_8", 8, 1, 1, (6, 1.0), (0.01, 0.02), False), ("assumed_16", 16, 2, 1, (6, 1.0), (0.01, 0.02), True),
                                                            ("viscous_10", 10, 8, 1, (2, 0.1), (0.01, 0.02), True), ("full_16", 16, 4, 2, None, (0.02, 0.05), True),
                                                            ("quadratic_8", 8, 4, 3, None, (0.01, 0.02), True)):
        what = {"assumed": "ELFORM 1, IHQ 6, QM 1", "viscous": "ELFORM 1, IHQ 2", "full": "ELFORM 2", "quadratic": "ELFORM 3"}[key.split("_")[0]]
        what += f", {n} x {n} x {layers}"
        s, base = square_plate(n, layers, elform, hourglass, "Simply supported square plate under a step of pressure", f"A quarter, hexahedra: {what}.",
                               elastic(rho, e, nu))
        push(s, base, pressure)
        s.write(folder / f"{key}.k")
        runs[key] = solid_run(f"{key}.k", 5e-6, 0.006, min(h / layers, a / 2 / n), e, nu, rho, 0.4 if elform == 3 else 0.8, slow)
        centre = s.mesh.at(0, 0, h / 2)
        figures += [frequencies(what, key, centre, [f1], limits[0]), peak(what, key, centre, oracle, 1e-3, limits[1]), energy(what, key)]
    write_case(folder, "Square plate of solids, linear", "Bending of hexahedra in two directions, a/h = 20: how many layers a formulation needs.",
               "modal sum of Mindlin's plate, shear factor 5/6", runs, figures)


def circular_plate_of_solids():
    """f6, two fifths as thick, with one layer of hexahedra of assumed strains in a mesh that is not regular."""
    o = oracles()["f6_circular_plate"]
    radius, e, nu, rho = (o[k] for k in ("R", "E", "nu", "rho"))
    thinner, pressure = 2.5, 0.002
    h, folder, runs, figures = o["h"] / thinner, ROOT / "circular_plate_of_solids", {}, []
    oracle = {"file": "../circular_plate/f6_circular_plate_linear_step.csv", "columns": ["w_centre"], "time_factor": thinner,
              "factor": pressure / o["p"] * thinner ** 3}
    for n, limits, slow in ((6, (0.03, 0.06), False), (24, (0.01, 0.03), True)):
        base = mesh.quarter_disk(n, radius)
        s = quarter(Structure("Clamped circular plate under a step of pressure", f"A quarter, 3 x {n} x {n} hexahedra; thickness {h}.", IMPERIAL, 0.064,
                              mesh.extruded(base, 1, h), solid_section(), elastic(rho, e, nu)))
        s.hourglass = (6, 1.0)
        s.hold(lambda x, y, z: math.hypot(x, y) > radius * (1 - 1e-9), "xyz")
        push(s, base, pressure)
        s.write(folder / f"n{n}.k")
        runs[f"n{n}"] = solid_run(f"n{n}.k", 40e-6, 0.062, min(h, base.characteristic_length()), e, nu, rho, 0.8, slow)
        name, centre = f"ELFORM 1, IHQ 6, QM 1, 3 x {n} x {n} x 1", s.mesh.at(0, 0, h / 2)
        figures += [frequencies(name, f"n{n}", centre, [o["f_Hz"][0] / thinner], limits[0]), peak(name, f"n{n}", centre, oracle, 0.0202, limits[1]),
                    energy(name, f"n{n}")]
    write_case(folder, "Circular plate of solids, linear", "Bending of one layer of hexahedra with assumed strains whose faces are not rectangles; R/h = 50.",
               "modal sum of Kirchhoff's plate", runs, figures)


def square_plate_plastic():
    """The plate of Belytschko and Tsay (1983): f8 under 300 psi with a yield stress of 30,000 psi, ideally plastic. Its published histories are
    curves in figures, of which no number could be had: three families of elements against each other instead."""
    o = oracles()["f8_square_plate"]
    a, h, e, nu, rho = (o[k] for k in ("a", "h", "E", "nu", "rho"))
    folder, pressure, end, runs, figures, centre = ROOT / "square_plate_plastic", 300.0, 2e-3, {}, [], {}
    title, material = "Simply supported square plate, ideally plastic, under 300 psi", plastic(rho, e, nu, 30000.0)

    def add(key, s, slow, node):
        s.write(folder / f"{key}.k")
        runs[key] = {"deck": f"{key}.k", "sample": 5e-6, "end": end, **({"long": True} if slow else {})}
        centre[key] = displacement(node)
        figures.append(energy(key, key))

    for key, n, elform, slow in (("elform2_16", 16, 2, False), ("elform2_32", 32, 2, False), ("elform16_32", 32, 16, True)):
        m = mesh.rectangle(n, n, a / 2, a / 2)
        s = quarter(Structure(title, f"A quarter, {n} x {n} shells of ELFORM {elform}.", IMPERIAL, end, m, shell_section(h, 10, elform), material))
        s.hold(lambda x, y, z: x == a / 2, "yz", "x")
        s.hold(lambda x, y, z: y == a / 2, "xz", "y")
        s.step()
        s.forces(3, {k: pressure * area for k, area in m.corner_areas().items()})
        add(key, s, slow, 1)
    s, base = square_plate(16, 8, 1, (2, 0.1), title, "A quarter, 16 x 16 x 8 one-point hexahedra.", material)
    for k, (t, r) in s.held.items():  # across the plate only its middle surface: an edge of some thickness could not turn freely
        if abs(s.mesh.nodes[k - 1][2] - h / 2) > 1e-9:
            s.held[k] = (t.replace("z", ""), r)
    push(s, base, pressure)
    add("solids_16", s, True, s.mesh.at(0, 0, h / 2))
    for key, of, limit in (("elform2_16", "elform2_32", 0.01), ("elform16_32", "elform2_32", 0.02), ("solids_16", "elform2_32", 0.06)):
        figures.append({"figure": f"first peak in the centre, {key} against {of}, relative", "run": key, "signal": centre[key],
                        "oracle": {"run": of, "signal": centre[of]}, "measure": "peak_error", "scale": "peak", "until": 1e-3, "limit": limit})
    figures.append({"figure": "first peak in the centre, elform2_32, of 0.2825 in, which is Kardan's own", "run": "elform2_32", "signal": centre["elform2_32"],
                    "oracle": {"value": [0.2825]}, "measure": "peak_error", "scale": "peak", "until": 1e-3, "limit": 0.01})
    write_case(folder, "Square plate, ideally plastic", "Elastic-plastic bending with some membrane action, of which no number is published: shells of two "
               "formulations and solids agree. That the elastic response is right is shown by square_plate and square_plate_of_solids.",
               "none outside Kardan: converged runs with other elements", runs, figures)


def write_all():
    square_plate_of_solids()
    circular_plate_of_solids()
    square_plate_plastic()
