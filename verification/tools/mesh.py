"""Meshes of quadrilaterals and hexahedra for the cases of verification/deformable: refinement is a parameter of each."""
import math


class Mesh:
    """Nodes (x, y, z) and elements (4 or 8 numbers of nodes, from 1; 3 for a beam: its ends and the third node)."""

    def __init__(self):
        self.nodes, self.elements, self._at = [], [], {}

    def node(self, x, y, z=0.0):
        """Number of the node there; one is made if there is none."""
        x, y, z = (round(c, 9) + 0.0 for c in (x, y, z))
        key = tuple(round(c, 8) for c in (x, y, z))
        if key not in self._at:
            self.nodes.append((x, y, z))
            self._at[key] = len(self.nodes)
        return self._at[key]

    def grid(self, nx, ny, place):
        """nx by ny quadrilaterals; place(u, v) is the point at u, v in [0, 1]."""
        ids = [[self.node(*place(i / nx, j / ny)) for i in range(nx + 1)] for j in range(ny + 1)]
        for j in range(ny):
            for i in range(nx):
                self.elements.append((ids[j][i], ids[j][i + 1], ids[j + 1][i + 1], ids[j + 1][i]))

    def triangles(self):
        """Each quadrilateral becomes two triangles, which are quadrilaterals with node 4 = node 3."""
        self.elements = [t for a, b, c, d in self.elements for t in ((a, b, c, c), (a, c, d, d))]
        return self

    def where(self, test):
        """Numbers of the nodes with test(x, y, z)."""
        return [n + 1 for n, x in enumerate(self.nodes) if test(*x)]

    def at(self, x, y, z=0.0):
        """Number of the node nearest to a point."""
        return 1 + min(range(len(self.nodes)), key=lambda n: math.dist(self.nodes[n], (x, y, z)))

    def area(self, element):
        p = [self.nodes[n - 1] for n in element]
        d1, d2 = ([b - a for a, b in zip(p[i], p[i + 2])] for i in (0, 1))
        normal = (d1[1] * d2[2] - d1[2] * d2[1], d1[2] * d2[0] - d1[0] * d2[2], d1[0] * d2[1] - d1[1] * d2[0])
        return math.hypot(*normal) / 2

    def corner_areas(self):
        """A quarter of the area of each quadrilateral for each of its nodes: {node: area}."""
        share = {}
        for element in self.elements:
            for n in element:
                share[n] = share.get(n, 0.0) + self.area(element) / 4
        return share

    def characteristic_length(self):
        """The smallest area over longest side: what the stable step follows (triangles: twice their area, less a fifth)."""
        def length(element):
            p = [self.nodes[n - 1] for n in element]
            factor = 1.6 if element[2] == element[3] else 1.0
            return factor * self.area(element) / max(math.dist(p[i], p[(i + 1) % 4]) for i in range(4))
        return min(length(element) for element in self.elements)


def extruded(base, layers, height):
    """Hexahedra of equal height on the quadrilaterals of a mesh in the plane z = 0."""
    mesh = Mesh()
    ids = [[mesh.node(x, y, height * k / layers) for x, y, _ in base.nodes] for k in range(layers + 1)]
    for k in range(layers):
        for q in base.elements:
            mesh.elements.append(tuple(ids[k][n - 1] for n in q) + tuple(ids[k + 1][n - 1] for n in q))
    return mesh


def rectangle(nx, ny, a, b, x0=0.0, y0=0.0):
    mesh = Mesh()
    mesh.grid(nx, ny, lambda u, v: (x0 + a * u, y0 + b * v))
    return mesh


def quarter_disk(n, radius):
    """3 n^2 quadrilaterals on x, y >= 0: a core of n by n, its outer corner drawn in, and two blocks out to the circle."""
    mesh = Mesh()
    side, corner = 0.52 * radius, 0.44 * radius  # of the core: along the axes, of its outer corner

    def core(u, v):
        bulge = corner - side
        return side * u + bulge * u * v, side * v + bulge * u * v

    def ring(angle_0):
        def place(u, v):
            x0, y0 = core(1.0, u) if angle_0 == 0 else core(1 - u, 1.0)
            angle = angle_0 + math.pi / 4 * u
            return x0 + (radius * math.cos(angle) - x0) * v, y0 + (radius * math.sin(angle) - y0) * v
        return lambda u, v: place(v, u)  # u outwards, v around: right-handed

    mesh.grid(n, n, core)
    mesh.grid(n, n, ring(0))
    mesh.grid(n, n, ring(math.pi / 4))
    return mesh
