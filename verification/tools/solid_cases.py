"""Solids of verification/deformable: decks at several refinements, tables and case.json."""
import csv

import mesh
import shell_oracles
from deck import card
from shell_cases import ROOT, SHARED, SI, energy, frequencies, quarter, run, write_table
from structure import Structure, elastic, kinematic, plastic, solid_section, write_case


def resampled(name, step, last):
    """Rows of a table of the oracles at 0, step, … last, between its rows linearly."""
    with open(SHARED / name) as f:
        header, *rows = list(csv.reader(f))
    rows = [[float(v) for v in row] for row in rows]
    result, i = [], 0
    for k in range(round(last / step) + 1):
        t = min(k * step, rows[-1][0])
        while rows[i + 1][0] < t:
            i += 1
        share = (t - rows[i][0]) / (rows[i + 1][0] - rows[i][0])
        result.append([k * step] + [a + share * (b - a) for a, b in zip(rows[i][1:], rows[i + 1][1:])])
    return header, result


def taylor_bar():
    """f9: a copper cylinder of 32.4 mm by 3.2 mm at 227 m/s against a wall without friction: its face is held along the axis."""
    radius, length, speed, end = 3.2e-3, 32.4e-3, 227.0, 80e-6
    e, nu, rho, sigy, h = 117e9, 0.35, 8930.0, 400e6, 100e6
    folder, sample = ROOT / "taylor_bar", 1e-6
    write_table(folder / "f9_taylor_24x192.csv", *resampled("f9_taylor_24x192.csv", sample, end))
    runs, figures = {}, []
    for n, layers, law, slow in ((3, 36, 24, False), (3, 36, 3, False), (6, 48, 24, True), (8, 80, 24, True)):
        m = mesh.extruded(mesh.quarter_disk(n, radius), layers, length)
        s = quarter(Structure("Taylor bar", f"A quarter, {3 * n * n} x {layers} hexahedra.", SI, end, m, solid_section(),
                              {24: plastic, 3: kinematic}[law](rho, e, nu, sigy, e * h / (e + h))))
        s.hold(lambda x, y, z: z == 0, "z")
        s.text("$ everything moves towards the wall, z = 0", "*INITIAL_VELOCITY_GENERATION", card(1, 2, 0, 0, 0, -speed), card(0, 0, 0, 0, 0, 0))
        key = f"mat{law}_{n}"
        s.write(folder / f"{key}.k")
        runs[key] = {"deck": f"{key}.k", "sample": sample, "end": end, **({"long": True} if slow else {})}
        name = f"{2 * n} elements over the radius, {layers} over the length, MAT_{law:0>3}"
        foot = [m.at(radius, 0, 0), m.at(radius * 0.5 ** 0.5, radius * 0.5 ** 0.5, 0)]
        radii = {"sum": [{"node": k, "quantity": "position", "components": [0, 1], "norm": True, "factor": 0.5} for k in foot]}
        height = {"node": m.at(0, 0, length), "quantity": "position", "components": [2]}
        if law == 3:
            figures.append({"figure": "MAT_003 with BETA = 1 against MAT_024, length over time, of itself", "run": key, "signal": height,
                            "oracle": {"run": "mat24_3", "signal": height}, "measure": "max_error", "scale": "peak", "limit": 1e-6})
            continue
        history = {"run": key, "measure": "max_error", "limit": {3: 0.03, 6: 0.015, 8: 0.01}[n]}
        figures += [{"figure": f"final radius of the face, {name}, of 7.24 mm", "run": key, "signal": radii, "oracle": {"value": [7.24e-3]},
                     "measure": "final_error", "scale": "peak", "limit": {3: 0.05, 6: 0.025, 8: 0.015}[n]},
                    {"figure": f"final length, {name}, of 21.41 mm", "run": key, "signal": height, "oracle": {"value": [21.41e-3]},
                     "measure": "final_error", "scale": "peak", "limit": 0.01 if n == 3 else 0.005},
                    {"figure": f"length over time, {name}, of the first", "signal": height, "scale": length,
                     "oracle": {"file": "f9_taylor_24x192.csv", "columns": ["length"]}, **history},
                    {"figure": f"kinetic energy over time, {name}, of the first", "signal": {"energy": "kinetic", "factor": 4}, "scale": 239.2,
                     "oracle": {"file": "f9_taylor_24x192.csv", "columns": ["kinetic_energy"]}, **history},
                    {"figure": f"energy: drift of the total, {name}, of the first", "run": key, "signal": {"energy": "total"},
                     "measure": "drift", "scale": "initial", "limit": 0.03}]
    write_case(folder, "Taylor bar", "Large plastic strains of one-point hexahedra with viscous hourglass control. The wall is a support along the axis.",
               "axisymmetric B-bar elements, 3 x 24 to 24 x 192, extrapolated; published: radius 7.22 to 7.24 mm, length 21.43 mm", runs, figures)


def taylor_bar_lsdyna():
    """A steel bar at four speeds, against kinetic energies of LS-DYNA read off a figure (+-270 mJ) in PyDyna's documentation (MIT). As in its
    deck the quarter has no supports in its planes of symmetry, and the wall, 0.1 mm ahead, stops the nodes of the first two layers only."""
    radius, length, layers, gap, sample = 4.0, 30.0, 32, 0.1, 4e-6
    folder = ROOT / "taylor_bar_lsdyna"
    with open(SHARED.parent / "corpus/taylor_bar/ke_lsdyna_digitised.csv") as f:
        rows = [line.strip().split(",") for line in f if line[0].isdigit()]
    m = mesh.extruded(mesh.quarter_disk(4, radius), layers, length)
    front = m.where(lambda x, y, z: z < 1.01 * length / layers)
    runs, figures = {}, []
    for speed in (275, 300, 325, 350):
        s = Structure(f"Taylor bar at {speed} m/s", "48 x 32 hexahedra.", "t, mm, s, N", 8e-5, m, solid_section(),
                      kinematic(7.85e-9, 150000.0, 0.34, 390.0, 90.0, 0.0))
        s.text("$ the nodes that the wall stops", "*SET_NODE_LIST", "1", *[card(*front[i:i + 8]) for i in range(0, len(front), 8)],
               "$ a point of the wall, a point before it, friction", "*RIGIDWALL_PLANAR", "1", card(0, 0, -gap, 0, 0, 1.0, 0),
               "$ everything moves towards the wall", "*INITIAL_VELOCITY_GENERATION", card(1, 2, 0, 0, 0, -1000.0 * speed),
               card(0, 0, 0, 0, 0, 0))
        key = f"speed_{speed}"
        s.write(folder / f"{key}.k")
        own = [(float(t), float(ke)) for v, t, ke in rows if int(v) == speed and ke != "nan"]
        write_table(folder / f"lsdyna_{speed}.csv", ["t", "kinetic_energy"], own)
        runs[key] = {"deck": f"{key}.k", "sample": sample, "end": sample * (len(own) - 1), **({"long": True} if speed in (300, 325) else {})}
        figures += [{"figure": f"kinetic energy over time, {speed} m/s, of the first", "run": key, "signal": {"energy": "kinetic"},
                     "oracle": {"file": f"lsdyna_{speed}.csv", "columns": ["kinetic_energy"]}, "measure": "max_error", "scale": "peak",
                     "limit": 0.02},
                    {"figure": f"energy: drift of the total, {speed} m/s, of the first", "run": key, "signal": {"energy": "total"},
                     "measure": "drift", "scale": "initial", "limit": 0.03}]
    write_case(folder, "Taylor bar against LS-DYNA", "One-point hexahedra with MAT_PLASTIC_KINEMATIC, kinematic hardening, against another program.",
               "LS-DYNA: kinetic energies read off a figure in PyDyna's documentation (github.com/ansys/pydyna 5f75f6c, MIT) to 0.25 % of the first",
               runs, figures)


def cantilever_of_quadratic_solids():
    """A bar of 1 m by 50 mm by 50 mm of one row of quadratic solids (ELFORM 3), 10 N on its end from t = 0 on. With PR = 0 it is a
    beam; with PR = 0.3 the element lacks the stretch that is quadratic across the bar, which makes it 1/(1 - PR^2)
    stiffer, and the clamp, which stops all of it, a little more."""
    e, rho, length, h, force = 210e9, 7850.0, 1.0, 0.05, 10.0
    folder, runs, figures = ROOT / "cantilever_of_quadratic_solids", {}, []
    for n, ratio in ((5, 0.0), (10, 0.0), (20, 0.0), (20, 0.3)):
        f1 = shell_oracles.timoshenko_first_frequency(e, e / 2 / (1 + ratio), rho, length, h, h)
        sample = 1 / f1 / 40
        m = mesh.extruded(mesh.rectangle(n, 1, length, h), 1, h)
        s = Structure("Cantilever under a step load at its end", f"One row of {n} solids of ELFORM 3.", SI, 0.1, m, solid_section(3),
                      elastic(rho, e, ratio))
        s.hold(lambda x, y, z: x == 0, "xyz", "xyz")
        tip = m.where(lambda x, y, z: x == length)
        s.step()
        s.forces(3, {k: force / 4 for k in tip})
        key = f"n{n}_nu{ratio:g}".replace(".", "")
        s.write(folder / f"{key}.k")
        # At 0.42 of the Courant step of plane stress: the element's own is 3/4 of that of the volume, less what a row may breathe.
        runs[key] = run(f"{key}.k", sample, 0.1, h, e, rho, ratio, share=0.42)
        name = f"{n} elements, PR = {ratio:g}"
        figures += [frequencies(name, key, tip[0], [f1], 0.06 if ratio else 0.03 if n == 5 else 0.01), energy(name, key)]
    write_case(folder, "Cantilever of quadratic solids", "Bending of one layer of solids of ELFORM 3: first frequency, also with elements four "
               "times as long as thick.", "frequency of Timoshenko's beam", runs, figures)


def write_all():
    cantilever_of_quadratic_solids()
    taylor_bar()
    taylor_bar_lsdyna()
