"""The cases f5 to f9 of verification/deformable with formulations that are not the default: fully integrated shells, solids in bending, a
rigid wall."""
import math

import mesh
import shell_oracles
from deck import card
from shell_cases import (IMPERIAL, ROOT, SI, energy, frequencies, oracles, peak, quarter, run, write_table)
from solid_cases import resampled
from structure import Structure, elastic, plastic, shell_section, solid_section, write_case


def fully_integrated_shells():
    """f5, f6, f7 and f8 with ELFORM 16: a strip, a mesh that is not regular, modes of a plate, a plate with shear."""
    folder, o = ROOT / "fully_integrated_shells", oracles()
    runs, figures = {}, []

    def add(key, s, sample, end, e, rho, nu, own):
        s.write(folder / f"{key}.k")
        runs[key] = run(f"{key}.k", sample, end, s.mesh.characteristic_length(), e, rho, nu, 0.8, key == "plate")
        figures.extend(own)

    p = o["f5_cantilever"]
    e, rho, nu, length, b, h = (p[k] for k in ("E", "rho", "nu", "L", "b", "h"))
    f1 = p["f_timoshenko_Hz"][0]
    m = mesh.rectangle(20, 1, length, b)
    s = Structure("Cantilever, first frequency", "20 shells of ELFORM 16.", SI, 0.1, m, shell_section(h, 3, 16), elastic(rho, e, nu))
    s.hold(lambda x, y, z: x == 0, "xyz", "xyz")
    tip = m.where(lambda x, y, z: x == length)
    s.step()
    s.forces(3, {k: 5.0 for k in tip})
    add("strip", s, 1 / f1 / 40, 0.1, e, rho, nu, [frequencies("cantilever, 20 elements", "strip", tip[0], [f1])])

    p = o["f6_circular_plate"]
    thinner, pressure = 5, 0.002
    radius, e, nu, rho = (p[k] for k in ("R", "E", "nu", "rho"))
    h, f1 = p["h"] / thinner, p["f_Hz"][0] / thinner
    m = mesh.quarter_disk(8, radius)
    s = quarter(Structure("Clamped circular plate under a step of pressure", "A quarter, 3 x 8 x 8 shells of ELFORM 16.", IMPERIAL, 0.032, m,
                          shell_section(h, 3, 16), elastic(rho, e, nu)))
    s.hold(lambda x, y, z: math.hypot(x, y) > radius * (1 - 1e-9), "xyz", "xyz")
    s.pressure(pressure)
    add("circular", s, 20e-6, 0.031, e, rho, nu,
        [frequencies("circular plate, 3 x 8 x 8 elements", "circular", 1, [f1]),
         peak("circular plate, 3 x 8 x 8 elements", "circular", 1,
              {"file": "../circular_plate/f6_circular_plate_linear_step.csv", "columns": ["w_centre"], "time_factor": thinner,
               "factor": pressure / p["p"] * thinner ** 3}, 0.0101)])

    p = o["f7_cantilever_plate"]
    a, h, e, nu, rho = (p[k] for k in ("a", "h", "E", "nu", "rho"))
    m = mesh.rectangle(16, 16, a, a)
    s = Structure("Square cantilever plate", "16 by 16 shells of ELFORM 16, a force on a free corner.", SI, 13.0, m, shell_section(h, 3, 16),
                  elastic(rho, e, nu))
    s.hold(lambda x, y, z: x == 0, "xyz", "xyz")
    s.step()
    s.forces(3, {m.at(a, a): 1.0})
    add("plate", s, 0.02, 13.0, e, rho, nu,
        [frequencies(f"cantilever plate, mode {k + 1}, 16 x 16", "plate", m.at(a, a), [f], 0.01 if k < 2 else 0.03)
         for k, f in enumerate(p["f_Hz"][:5])])

    p = o["f8_square_plate"]
    a, h, e, nu, rho = (p[k] for k in ("a", "h", "E", "nu", "rho"))
    m = mesh.rectangle(8, 8, a / 2, a / 2)
    s = quarter(Structure("Simply supported square plate under a step of pressure", "A quarter, 8 x 8 shells of ELFORM 16.", IMPERIAL, 0.006, m,
                          shell_section(h, 3, 16), elastic(rho, e, nu)))
    s.hold(lambda x, y, z: x == a / 2, "z", "x")
    s.hold(lambda x, y, z: y == a / 2, "z", "y")
    s.pressure(3.0)
    add("square", s, 5e-6, 0.006, e, rho, nu,
        [peak("square plate, 8 x 8 elements of a quarter", "square", 1,
              {"file": "../square_plate/f8_square_plate_linear_step.csv", "columns": ["w_centre_mindlin"], "factor": 3.0 / p["p"]}, 0.001)])
    figures.extend(energy(name, name) for name in ("strip", "circular", "plate", "square"))
    write_case(folder, "Fully integrated shells in bending", "Strip, circular plate, cantilever plate and plate with shear of ELFORM 16 shells.",
               "those of cantilever_beam, circular_plate, cantilever_plate and square_plate", runs, figures)


def cantilever_of_solids():
    """f5 with hexahedra: one element through the depth where the hourglass control bends exactly, four where it does not."""
    o = oracles()["f5_cantilever"]
    e, rho, nu, length, b, h = (o[k] for k in ("E", "rho", "nu", "L", "b", "h"))
    folder, f1, force = ROOT / "cantilever_of_solids", o["f_timoshenko_Hz"][0], 10.0
    sample = 1 / f1 / 40
    write_table(folder / "step.csv", ["t", "w_tip"],
                [(i * sample, shell_oracles.cantilever_step(force, rho * length * b * h, o["f_timoshenko_Hz"], i * sample)) for i in range(41)])
    runs, figures = {}, []
    for key, elform, hourglass, grid, what in (("assumed", 1, (6, 1.0), (20, 1, 1), "ELFORM 1, IHQ 6, QM 1, 20 x 1 x 1"),
                                               ("viscous", 1, (2, 0.1), (60, 4, 1), "ELFORM 1, IHQ 2, 60 x 4 x 1"),
                                               ("full", 2, None, (80, 4, 1), "ELFORM 2, 80 x 4 x 1")):
        nx, nz, ny = grid
        m = mesh.extruded(mesh.rectangle(nx, ny, length, b), nz, h)
        s = Structure("Cantilever under a step load at its end", f"Hexahedra: {what}.", SI, 0.1, m, solid_section(elform), elastic(rho, e, nu))
        s.hourglass = hourglass
        s.hold(lambda x, y, z: x == 0, "xyz")
        tip = m.where(lambda x, y, z: x == length)
        s.step()
        s.forces(3, {k: force / len(tip) for k in tip})
        s.write(folder / f"{key}.k")
        c = math.sqrt(e * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho))
        runs[key] = {"deck": f"{key}.k", "sample": sample, "steps": math.ceil(sample / ((0.55 if key == "assumed" else 0.7) * min(length / nx, h / nz) / c)),
                     "end": sample * math.ceil(0.1 / sample), **({} if key == "assumed" else {"long": True})}
        node = tip[0]
        figures += [frequencies(what, key, node, [f1], 0.01 if key == "assumed" else 0.04),
                    peak(what, key, node, {"file": "step.csv", "columns": ["w_tip"]}, 0.024, 0.02 if key == "assumed" else 0.08), energy(what, key)]
    write_case(folder, "Cantilever of solids", "Bending of hexahedra: exact with Belytschko and Bindeman's assumed strains on one element through the "
               "depth; one-point elements need several.", "frequency of Timoshenko's beam; step response: modal sum", runs, figures)


def taylor_bar_wall():
    """f9 with a rigid wall instead of supports: the nodes stop at it and may leave it again."""
    radius, length, speed, end, gap = 3.2e-3, 32.4e-3, 227.0, 80e-6, 1e-6
    e, nu, rho, sigy, h = 117e9, 0.35, 8930.0, 400e6, 100e6
    folder, sample, n, layers = ROOT / "taylor_bar_wall", 1e-6, 3, 36
    write_table(folder / "f9_taylor_24x192.csv", *resampled("f9_taylor_24x192.csv", sample, end))
    m = mesh.extruded(mesh.quarter_disk(n, radius), layers, length)
    s = quarter(Structure("Taylor bar on a rigid wall", f"A quarter, {3 * n * n} x {layers} hexahedra; the wall 1 um ahead.", SI, end, m, solid_section(),
                          plastic(rho, e, nu, sigy, e * h / (e + h))))
    s.text("$ all nodes; a point of the wall, a point before it, friction", "*RIGIDWALL_PLANAR", "0", card(0, 0, -gap, 0, 0, 1.0, 0),
           "$ everything moves towards the wall", "*INITIAL_VELOCITY_GENERATION", card(1, 2, 0, 0, 0, -speed), card(0, 0, 0, 0, 0, 0))
    s.write(folder / "wall.k")
    runs = {"wall": {"deck": "wall.k", "sample": sample, "end": end}}
    foot = [m.at(radius, 0, 0), m.at(radius * 0.5 ** 0.5, radius * 0.5 ** 0.5, 0)]
    radii = {"sum": [{"node": k, "quantity": "position", "components": [0, 1], "norm": True, "factor": 0.5} for k in foot]}
    height = {"node": m.at(0, 0, length), "quantity": "position", "components": [2]}
    figures = [{"figure": "final radius of the face, of 7.24 mm", "run": "wall", "signal": radii, "oracle": {"value": [7.24e-3]},
                "measure": "final_error", "scale": "peak", "limit": 0.05},
               {"figure": "length over time, of the first", "signal": height, "scale": length, "run": "wall", "measure": "max_error", "limit": 0.03,
                "oracle": {"file": "f9_taylor_24x192.csv", "columns": ["length"]}},
               {"figure": "kinetic energy over time, of the first", "signal": {"energy": "kinetic", "factor": 4}, "scale": 239.2, "run": "wall",
                "measure": "max_error", "limit": 0.03, "oracle": {"file": "f9_taylor_24x192.csv", "columns": ["kinetic_energy"]}},
               {"figure": "energy: drift of the total, of the first", "run": "wall", "signal": {"energy": "total"}, "measure": "drift",
                "scale": "initial", "limit": 0.03}]
    write_case(folder, "Taylor bar on a rigid wall", "Large plastic strains of one-point hexahedra against *RIGIDWALL_PLANAR.",
               "axisymmetric B-bar elements, 3 x 24 to 24 x 192", runs, figures)


def write_all():
    fully_integrated_shells()
    cantilever_of_solids()
    taylor_bar_wall()
