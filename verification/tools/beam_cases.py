"""Beams of verification/deformable."""
import mesh
import shell_oracles
from deck import card
from shell_cases import ROOT, SI, energy, frequencies, oracles, peak, run, write_table
from structure import Structure, elastic, write_case


def section(elform, b, h):
    if elform == 1:
        return ["$ ELFORM, SHRF, QR, CST; TS1, TS2, TT1, TT2", "*SECTION_BEAM", card(1, 1, 5 / 6, 2.0, 0.0), card(b, b, h, h)]
    area, iss, itt = b * h, b * h ** 3 / 12, h * b ** 3 / 12
    return ["$ ELFORM; A, ISS, ITT, J, SAS", "*SECTION_BEAM", card(1, elform), card(area, iss, itt, iss + itt, 5 / 6 * area)]


def line(elements, length):
    """Beams along x, and a third node that puts s along y."""
    m = mesh.Mesh()
    nodes = [m.node(length * i / elements, 0, 0) for i in range(elements + 1)]
    side = m.node(0, length, 0)
    m.elements = [(nodes[i], nodes[i + 1], side) for i in range(elements)]
    return m, nodes[-1]


def cantilever_of_beams():
    """f5 with beams: a bar of 1 m by 50 mm by 50 mm, 10 N on its end from t = 0 on."""
    o = oracles()["f5_cantilever"]
    e, rho, nu, length, b, h = (o[k] for k in ("E", "rho", "nu", "L", "b", "h"))
    folder, f1, force = ROOT / "cantilever_of_beams", o["f_timoshenko_Hz"][0], 10.0
    sample, modes = 1 / f1 / 40, o["f_timoshenko_Hz"]
    write_table(folder / "step.csv", ["t", "w_tip"],
                [(i * sample, shell_oracles.cantilever_step(force, rho * length * b * h, modes, i * sample)) for i in range(41)])
    runs, figures = {}, []
    for elform, kind in ((1, "Hughes-Liu"), (2, "Belytschko-Schwer")):
        for n in (10, 20):
            m, tip = line(n, length)
            s = Structure("Cantilever under a step load at its end", f"{n} beams of ELFORM {elform}.", SI, 0.1, m, section(elform, b, h),
                          elastic(rho, e, nu))
            s.hold(lambda x, y, z: x == 0 and y == 0, "xyz", "xyz")
            s.step()
            s.forces(3, {tip: force})
            key = f"elform{elform}_{n}"
            s.write(folder / f"{key}.k")
            name = f"{kind}, {n} elements"
            runs[key] = run(f"{key}.k", sample, 0.1, length / n, e, rho, 0.0)
            figures += [frequencies(name, key, tip, [f1]), peak(name, key, tip, {"file": "step.csv", "columns": ["w_tip"]}, 0.024),
                        energy(name, key)]
    write_case(folder, "Cantilever of beams", "Bending of Hughes-Liu and Belytschko-Schwer beams: first frequency and step response.",
               "frequency of Timoshenko's beam; step response: modal sum", runs, figures)


def write_all():
    cantilever_of_beams()
