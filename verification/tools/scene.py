"""Writes a deck of several parts; used by contact_cases.py."""
from deck import card
from structure import head, node_cards


class Scene:
    """Parts with meshes of their own, supports, and the lines that are the scene's."""

    def __init__(self, title, about, units, end, tssfac=0.9):
        self.title, self.about, self.units, self.end, self.tssfac = title, about, units, end, tssfac
        self.nodes, self.held, self.elements, self.parts, self.extra = [], {}, [], [], []

    def part(self, section, material, inertia=None):
        """A new part; `section` and `material` are functions of its number that give lines. inertia: lines behind those of *PART_INERTIA's numbers."""
        number = len(self.elements) + 1
        self.elements.append([])
        self.parts += section(number) + material(number) + ["*PART_INERTIA" if inertia else "*PART", f"part {number}", card(number, number, number)]
        self.parts += inertia or []
        return number

    def add(self, part, mesh, place=lambda x, y, z: (x, y, z)):
        """The nodes and elements of a mesh, each node where place(x, y, z) says. @return {node of the mesh: node of the deck}"""
        first = len(self.nodes)
        self.nodes += [tuple(place(*x)) for x in mesh.nodes]
        self.elements[part - 1] += [tuple(n + first for n in e) for e in mesh.elements]
        return {n: n + first for n in range(1, len(mesh.nodes) + 1)}

    def share(self, part, ids, elements):
        """Elements of another part on nodes of a mesh that is there: `ids` is what add() returned."""
        self.elements[part - 1] += [tuple(ids[n] for n in e) for e in elements]

    def hold(self, nodes, translations="", rotations=""):
        """Holds nodes in global directions: "xz" or the like."""
        for n in nodes:
            t, r = self.held.get(n, ("", ""))
            self.held[n] = ("".join(sorted(set(t + translations))), "".join(sorted(set(r + rotations))))

    def curve(self, number, points):
        self.text("*DEFINE_CURVE", str(number), *[card(*p) for p in points])

    def nodes_set(self, number, nodes):
        nodes = sorted(nodes)
        self.text("*SET_NODE_LIST", str(number), *[card(*nodes[i:i + 8]) for i in range(0, len(nodes), 8)])

    def contact(self, number, kind, tracked, reference, scale=1.0, friction=(0.0, 0.0, 0.0), damping=0.0, soft=None):
        """*CONTACT_… of two parts, or of the parts of set `tracked` among each other (reference 0). friction: FS, FD, DC; damping: VDC in per cent."""
        self.text(f"*CONTACT_{kind}_ID", f"{number},", "$ tracked, reference, their kinds", card(tracked, reference, *((3, 3) if reference else (2, 0))),
                  "$ FS, FD, DC, VC, VDC", card(*friction, 0, damping), "$ SFSA, SFSB", card(scale, scale),
                  *(["$ SOFT", card(soft)] if soft is not None else []))

    def gravity(self, g):
        """Acceleration (x, y, z) of everything."""
        self.curve(900, [(0, 1.0), (1e6, 1.0)])
        for axis, component in zip("XYZ", g):
            if component:
                self.text("$ the acceleration of the frame", f"*LOAD_BODY_{axis}", card(900, -component))

    def text(self, *lines):
        self.extra += list(lines)

    def write(self, path):
        o = head(self) + self.parts + ["$"] + self.extra + node_cards(self.nodes, self.held)
        number = 0
        for part, elements in enumerate(self.elements, 1):
            o.append({4: "*ELEMENT_SHELL", 8: "*ELEMENT_SOLID"}[len(elements[0])])
            for nodes in elements:
                number += 1
                o.append(card(number, part, *nodes))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(o + ["*END"]) + "\n")


def solids(elform=1):
    return lambda number: ["$ ELFORM", "*SECTION_SOLID", card(number, elform)]


def shells(thickness, points=3, elform=2):
    return lambda number: ["$ ELFORM, SHRF, NIP; thickness", "*SECTION_SHELL", card(number, elform, 5 / 6, points), card(*[thickness] * 4)]


def elastic(density, modulus, ratio):
    return lambda number: ["*MAT_ELASTIC", card(number, density, modulus, ratio)]


def rigid(density, modulus, ratio, translations=0, rotations=0):
    """translations, rotations: CON1, CON2 of *MAT_RIGID."""
    return lambda number: ["*MAT_RIGID", card(number, density, modulus, ratio), card(1.0 if translations or rotations else 0.0, translations, rotations), "0"]
