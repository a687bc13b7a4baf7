"""Writes small LS-DYNA keyword decks of rigid bodies and joints, comma-separated, every number in full precision.

Used by make_mechanisms.py; the decks it wrote are committed, so nobody needs to run it to verify Kardan.
"""
import math


def num(value):
    """Shortest text that reads back as the same double."""
    if isinstance(value, int):
        return str(value)
    return repr(float(value)) if value else "0"


def card(*fields):
    return ",".join(num(f) for f in fields)


def add(*vectors):
    return [sum(c) for c in zip(*vectors)]


def scale(factor, v):
    return [factor * c for c in v]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    return scale(1 / math.sqrt(dot(v, v)), v)


def diag(a, b, c):
    return [[a, 0, 0], [0, b, 0], [0, 0, c]]


GLOBAL = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]  # three axes, each as a row


class Deck:
    """One deck. Bodies are *PART_INERTIA parts shown by one hexahedron each; joint points are extra nodes of the bodies."""

    def __init__(self, title, about, end, dt, outputs, total_moments=True):
        self.title, self.about, self.end, self.dt, self.outputs = title, about, end, dt, outputs
        self.nodes, self.solids, self.extra = [], [], {}
        self.parts, self.joints, self.rest = [], [], []
        self.grounded = False
        self.rigid_card = (["$ LMF = 1: joints are held exactly (Lagrange multipliers); JNTF = 1: total angles", "*CONTROL_RIGID", "1,1"]
                           if total_moments else
                           ["$ LMF = 1: joints are held exactly (Lagrange multipliers); JNTF = 0: angles summed by step",
                            "*CONTROL_RIGID", "1,0"])

    def node(self, x, body=None):
        """Adds a node, as an extra node of `body` where that is given; returns its id."""
        self.nodes.append(list(x))
        n = len(self.nodes)
        if body is not None:
            self.extra.setdefault(body, []).append(n)
        return n

    def box(self, part, center, half, axes=GLOBAL):
        """One hexahedron, so that post-processors have something to show."""
        corners = []
        for c in (-1, 1):
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                x = list(center)
                for s, h, axis in zip((a, b, c), half, axes):
                    x = add(x, scale(s * h, axis))
                corners.append(self.node(x))
        self.solids.append((len(self.solids) + 1, part, corners))
        return corners

    def ground(self, part=1, center=(0, 0, 0), half=(0.02, 0.02, 0.02)):
        """A rigid part that cannot move (*MAT_RIGID CMO = 1, CON1 = CON2 = 7)."""
        self.grounded = True
        self.parts += ["*PART", "ground", card(part, 1, 2)]
        self.box(part, center, half)

    def body(self, part, title, mass, center, inertia, half, axes=None, show=None, velocity=None):
        """A body with given mass properties: `inertia` about the centre, in `axes` (three unit rows) or global axes.

        It is shown as a hexahedron of half sides `half`: along `axes` about the centre, or as `show` = (centre, axes)."""
        i = inertia
        self.parts += ["*PART_INERTIA", title, "$ pid, section, material", card(part, 1, 1),
                       "$ centre of mass, mass, IRCS", card(*center, mass, 0 if axes is None else 1),
                       "$ Ixx, Ixy, Ixz, Iyy, Iyz, Izz (entries of the tensor)",
                       card(i[0][0], i[0][1], i[0][2], i[1][1], i[1][2], i[2][2])]
        v = velocity or [0, 0, 0, 0, 0, 0]
        self.parts += ["$ initial velocity of the centre, angular velocity (global axes)", card(*v)]
        if axes is not None:
            self.parts += ["$ local x axis, a vector in the local xy plane", card(*axes[0], *axes[1])]
        at, along = show or (center, axes or GLOBAL)
        self.box(part, at, half, along)

    def joint(self, kind, number, title, a, b, points):
        """A joint between bodies a and b: each point gets one node on each of them; points may be pairs (on a, on b)."""
        ids = []
        for p in points:
            pair = p if isinstance(p[0], (list, tuple)) else (p, p)
            ids += [self.node(pair[0], a), self.node(pair[1], b)]
        self.joints += [f"*CONSTRAINED_JOINT_{kind.upper()}_ID", f"{number},{title}",
                        card(*(ids + [0] * (6 - len(ids))))]
        return ids

    def initial(self, part, v, w):
        self.rest += ["*INITIAL_VELOCITY_RIGID_BODY", card(part, *v, *w)]

    def gravity(self, axis, g):
        """Acceleration g against the global `axis` ("X", "Y", "Z")."""
        self.constant_curve()
        self.rest += [f"$ base acceleration: everything falls along -{axis.lower()}", f"*LOAD_BODY_{axis}", card(1, g)]

    def constant_curve(self):
        if "$ curve 1: always 1" not in self.rest:
            self.rest += ["$ curve 1: always 1", "*DEFINE_CURVE", "1", "0,1", "1e6,1"]

    def text(self, *lines):
        self.rest += list(lines)

    def write(self, path):
        o = ["*KEYWORD", "*TITLE", self.title]
        o += ["$ " + line for line in self.about.strip().split("\n")]
        o += ["$ Units: kg, m, s, N. Comma-separated fields; every number is given in full double precision.",
              "$ Written by verification/tools/make_mechanisms.py.", "$",
              "*CONTROL_TERMINATION", card(self.end, 0),
              "$ DTINIT, TSSFAC, ISDO, TSLIMT, DT2MS, LCTM", "*CONTROL_TIMESTEP", card(self.dt, 0, 0, 0, 0, 9),
              "$ curve 9: the largest time step", "*DEFINE_CURVE", "9", f"0,{num(self.dt)}", f"1e6,{num(self.dt)}"]
        o += self.rigid_card
        for name in ("GLSTAT", "RBDOUT", "JNTFORC"):
            o += ["*DATABASE_" + name, card(self.outputs, 0)]
        o += ["*DATABASE_BINARY_D3PLOT", card(self.end / 50, 0), "$", "*SECTION_SOLID", "1,1",
              "*MAT_RIGID", "1,7850,2.1e11,0.3", "0,0,0", "0"]
        if self.grounded:
            o += ["$ nothing of it can move", "*MAT_RIGID", "2,7850,2.1e11,0.3", "1,7,7", "0"]
        o += ["$"] + self.parts + ["$"]
        for part in sorted(self.extra):
            ids = self.extra[part]
            o += [f"$ joint nodes of part {part}", "*SET_NODE_LIST", num(part)]
            o += [card(*ids[i:i + 8]) for i in range(0, len(ids), 8)]
            o += ["*CONSTRAINED_EXTRA_NODES_SET", card(part, part)]
        o += self.joints + ["$"] + self.rest + ["$", "*NODE"]
        o += [card(i + 1, *x) for i, x in enumerate(self.nodes)]
        if self.solids:
            o += ["*ELEMENT_SOLID"] + [card(e, p, *c) for e, p, c in self.solids]
        o += ["*END"]
        with open(path, "w", newline="\n") as f:
            f.write("\n".join(o) + "\n")
