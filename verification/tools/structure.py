"""Writes a deck of one deformable part and the case.json beside it; used by make_deformable.py."""
import json

from deck import card

SUPPORT = {"": 0, "x": 1, "y": 2, "z": 3, "xy": 4, "yz": 5, "xz": 6, "xyz": 7}  # TC and RC of *NODE


def head(deck):
    """First lines of a deck with a title, about, units, end and tssfac."""
    return ["*KEYWORD", "*TITLE", deck.title, "$ " + deck.about,
            f"$ Units: {deck.units}. Comma-separated fields; every number is given in full double precision.",
            "$ Written by verification/tools/make_deformable.py.", "$",
            "*CONTROL_TERMINATION", card(deck.end, 0),
            "$ DTINIT, TSSFAC: the step that the verification gives is the largest", "*CONTROL_TIMESTEP", card(0, deck.tssfac),
            "$ HGEN = 2, SLNTEN = 2: hourglass and sliding energies are computed", "*CONTROL_ENERGY", "2,1,2,1",
            "*DATABASE_GLSTAT", card(deck.end / 100, 0), "*DATABASE_BINARY_D3PLOT", card(deck.end / 20, 0), "$"]


def node_cards(nodes, held):
    """*NODE with supports; `held`: {number: (translations, rotations)}."""
    o = ["*NODE"]
    for n, x in enumerate(nodes, 1):
        t, r = held.get(n, ("", ""))
        o.append(card(n, *x, SUPPORT[t], SUPPORT[r]) if t or r else card(n, *x))
    return o


class Structure:
    """One part of shells, solids or beams, with supports, nodal forces and the lines that are its own."""

    def __init__(self, title, about, units, end, mesh, section, material):
        """section: lines behind "*SECTION_…" with their keyword; material likewise. Both have the number 1."""
        self.title, self.about, self.units, self.end, self.mesh = title, about, units, end, mesh
        self.section, self.material = section, material
        self.held, self.extra, self.hourglass = {}, [], None
        self.tssfac = 0.9

    def hold(self, test, translations="", rotations=""):
        """Holds nodes with test(x, y, z) in global directions: "xz" or the like."""
        for n in self.mesh.where(test):
            t, r = self.held.get(n, ("", ""))
            self.held[n] = ("".join(sorted(set(t + translations))), "".join(sorted(set(r + rotations))))

    def curve(self, number, points):
        self.extra += ["*DEFINE_CURVE", str(number)] + [card(*p) for p in points] + [card(1e6, points[-1][1])]

    def step(self):
        """Curve 1: 1 from t = 0 on."""
        self.curve(1, [(0, 1.0)])

    def forces(self, dof, of_node):
        """Forces that follow curve 1: {node: force} in the direction dof (1, 2, 3)."""
        self.extra += ["$ node, direction, curve, factor", "*LOAD_NODE_POINT"]
        self.extra += [card(n, dof, 1, force) for n, force in sorted(of_node.items()) if force]

    def pressure(self, value):
        """Pressure from t = 0 on, positive along the normals of the shells (which is negative in *LOAD_SHELL)."""
        self.step()
        self.extra += ["*SET_SHELL_GENERAL", "1", "PART,1", "$ set, curve, factor: positive is against the normals", "*LOAD_SHELL_SET",
                       card(1, 1, -value)]

    def text(self, *lines):
        self.extra += list(lines)

    def write(self, path):
        o = head(self)
        if self.hourglass:
            o += ["$ IHQ, QM", "*CONTROL_HOURGLASS", card(*self.hourglass)]
        o += list(self.section) + list(self.material) + ["*PART", self.title, "1,1,1", "$"] + self.extra + node_cards(self.mesh.nodes, self.held)
        o.append({3: "*ELEMENT_BEAM", 4: "*ELEMENT_SHELL", 8: "*ELEMENT_SOLID"}[len(self.mesh.elements[0])])
        o += [card(e, 1, *nodes) for e, nodes in enumerate(self.mesh.elements, 1)] + ["*END"]
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(o) + "\n")


def shell_section(thickness, points, elform=2):
    return ["$ ELFORM, SHRF, NIP; thickness", "*SECTION_SHELL", card(1, elform, 5 / 6, points), card(*[thickness] * 4)]


def solid_section(elform=1):
    return ["$ ELFORM", "*SECTION_SOLID", card(1, elform)]


def elastic(density, modulus, ratio):
    return ["*MAT_ELASTIC", card(1, density, modulus, ratio)]


def plastic(density, modulus, ratio, yield_stress, tangent=0.0):
    return ["$ SIGY, ETAN", "*MAT_PIECEWISE_LINEAR_PLASTICITY", card(1, density, modulus, ratio, yield_stress, tangent), "0", "0", "0"]


def kinematic(density, modulus, ratio, yield_stress, tangent=0.0, beta=1.0):
    return ["$ SIGY, ETAN, BETA", "*MAT_PLASTIC_KINEMATIC", card(1, density, modulus, ratio, yield_stress, tangent, beta), "0"]


def write_case(folder, title, proves, source, runs, figures):
    """case.json with one run and one figure a line."""
    def lines(items):
        return ",\n    ".join(items)
    text = "{\n" + f'  "title": {json.dumps(title)},\n  "proves": {json.dumps(proves)},\n  "source": {json.dumps(source)},\n'
    text += '  "runs": {\n    ' + lines(f"{json.dumps(name)}: {json.dumps(run)}" for name, run in runs.items()) + "\n  },\n"
    text += '  "figures": [\n    ' + lines(json.dumps(f) for f in figures) + "\n  ]\n}\n"
    (folder / "case.json").write_text(text)
