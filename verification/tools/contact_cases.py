"""Cases of verification/contact: decks at several refinements, tables and case.json."""
import math
import pathlib

import mesh
from deck import card
from scene import Scene, elastic, rigid, shells, solids
from shell_cases import oracles, write_table
from solid_cases import resampled
from structure import write_case

ROOT = pathlib.Path("verification/contact")
MM = "mm, ms, kg, kN"


def octant(n, side, radius, growth):
    """Hexahedra of the octant x, y >= 0, z <= 0 of a ball: a cube of n^3 in its centre and three blocks of layers that grow outwards."""
    layers = math.ceil(math.log(radius / side) / math.log(growth))
    factor = (radius / side) ** (1 / layers)
    m = mesh.Mesh()

    def at(i, j, k, layer):
        p = [side * c / n for c in (i, j, k)]
        round_by = min(1.0, layer / 6)  # from the cube to spheres within six layers
        scale = factor ** layer * ((1 - round_by) + round_by * side / math.hypot(*p)) if layer else 1.0
        return m.node(scale * p[0], scale * p[1], -scale * p[2])

    def brick(corners):
        ids = [at(*c) for c in corners]
        m.elements.append(tuple(ids))

    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    for i in range(n):
        for j in range(n):
            for k in range(n):
                brick([(i + a, j + b, k + c, 0) for c in (1, 0) for a, b in square])
            for layer in range(layers):  # each pair of numbers twice turned outwards
                for face in (lambda a, b: (n, a, b), lambda a, b: (b, n, a), lambda a, b: (a, b, n)):
                    brick([(*face(i + a, j + b), layer + up) for up in (1, 0) for a, b in square])
    return m


def ball_cap(m_n, reach, radius):
    """The lowest part of a sphere's quarter that touches the origin from above, of quadrilaterals whose normals point down and out."""
    m = mesh.quarter_disk(m_n, reach)
    m.elements = [e[::-1] for e in m.elements]
    return m, lambda x, y, z: (x, y, radius - math.sqrt(radius ** 2 - x * x - y * y))


def falling_ball(s, o, mass, reach, n):
    """A quarter of the rigid sphere of the oracles, which falls on the origin, shown by shells where it may touch. @return its part"""
    radius, thickness = 1e3 * o["R"], 1e-4
    inertia = 0.4 * mass / 4 * radius ** 2
    ball = s.part(shells(thickness), rigid(7.85e-6, 1e-9 * o["E"], o["nu"], 4, 7),
                  ["$ centre, mass (a quarter)", card(0, 0, radius, mass / 4, 0), "$ inertia", card(inertia, 0, 0, inertia, 0, inertia),
                   "$ velocity", card(0, 0, -o["v"], 0, 0, 0)])
    m = mesh.quarter_disk(n, reach)
    s.add(ball, m, lambda x, y, z: (x, y, radius - math.sqrt(radius ** 2 - x * x - y * y) + thickness / 2))
    return ball


def quarter_of_elastic(title, about, end, tssfac, m, o):
    """A scene with one elastic part, held in its planes of symmetry. @return the scene, the part, {node of the mesh: node of the deck}"""
    s = Scene(title, about, MM, end, tssfac)
    part = s.part(solids(), elastic(1e-9 * o["rho"], 1e-9 * o["E"], o["nu"]))
    s.text("$ IHQ, QM", "*CONTROL_HOURGLASS", "6,1.0")
    ids = s.add(part, m)
    s.hold([ids[k] for k in m.where(lambda x, y, z: x == 0)], "x")
    s.hold([ids[k] for k in m.where(lambda x, y, z: y == 0)], "y")
    return s, part, ids


def history(what, run, signal, table, column, factor, limit):
    """Largest difference of a signal from a column of an oracle in SI units, of the column's peak, and that of the peaks."""
    oracle = {"file": table, "columns": [column], "time_factor": 1000, "factor": factor}
    entry = {"run": run, "signal": signal, "oracle": oracle, "scale": "peak", "limit": limit}
    return [{"figure": f"{what} over time, of peak", **entry, "measure": "max_error"}, {"figure": f"peak of {what}, relative", **entry, "measure": "peak_error"}]


def drift(what, run, limit=0.01):
    return {"figure": f"energy: drift of the total, {what}, of the first", "run": run, "signal": {"energy": "total"}, "measure": "drift",
            "scale": "initial", "limit": limit}


# Scale of the penalty springs, which makes them as stiff as masses and step allow, and TSSFAC: with 0.9 the sphere comes 10 % too deep.
FIRM, SHORT = 1000.0, 0.3


def hertz():
    """f1: half a steel ball of 40 mm stands for the half space; fixed outside, which makes it 0.4 % stiffer."""
    o = oracles()["f1_hertz"]
    table, end, radius = "f1_hertz_rigid_sphere.csv", 0.052, 40.0
    folder = ROOT / "hertz"
    write_table(folder / table, *resampled(table, 0.5e-6, 52e-6))
    runs, figures = {}, []

    def half_space(n, growth, what, tssfac):
        m = octant(n, 0.6, radius, growth)
        s, block, ids = quarter_of_elastic("Rigid sphere on an elastic half space", f"A quarter, {len(m.elements)} hexahedra, {what}", 0.06, tssfac, m, o)
        s.hold([ids[k] for k in m.where(lambda x, y, z: math.hypot(x, y, z) > radius - 1e-6)], "xyz")
        return s, block, [ids[k] for k in m.where(lambda x, y, z: z == 0 and math.hypot(x, y) < 1)]

    for n, growth, slow in ((5, 1.35, False), (8, 1.25, True)):
        s, block, _ = half_space(n, growth, "the sphere is a rigid body and falls at 1 m/s.", SHORT)
        s.contact(1, "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", block, falling_ball(s, o, o["rigid_sphere"]["m"], 0.8, n), FIRM)
        key = f"impact_{n}"
        s.write(folder / f"{key}.k")
        runs[key] = {"deck": f"{key}.k", "sample": 5e-4, "end": end, **({"long": True} if slow else {})}
        what = f"impact, elements of {0.6 / n:g} mm"
        figures += history(f"force, {what}", key, {"contact": 1, "quantity": "force", "components": [2], "factor": -4}, table, "force", 1e-3, 0.03)
        figures += history(f"approach, {what}", key, {"body": 2, "quantity": "displacement", "components": [2], "factor": -1}, table, "approach", 1e3,
                           0.03 if slow else 0.05)
        figures += [drift(what, key)]
    s, _, top = half_space(5, 1.35, "pressed by a rigid wall, a sphere, as deep as Hertz says.", 0.9)
    s.nodes_set(1, top)
    _, rows = resampled(table, 0.5e-6, 52e-6)
    s.curve(1, [(1e3 * r[0], 1e3 * r[1]) for r in rows])
    s.text("$ nodes; bottom of the sphere, its other end, friction; radius; displacement by curve 1 along -z", "*RIGIDWALL_GEOMETRIC_SPHERE_MOTION",
           "1", card(0, 0, 1e3 * o["R"], 0, 0, 2e3 * o["R"], 0), card(1e3 * o["R"]), card(1, 1, 0, 0, -1.0))
    s.write(folder / "wall.k")
    runs["wall"] = {"deck": "wall.k", "sample": 5e-4, "end": end}
    figures += history("force, pressed by a rigid wall, elements of 0.12 mm", "wall", {"wall": 1, "quantity": "force", "components": [2], "factor": 4},
                       table, "force", 1e-3, 0.03)
    write_case(folder, "Rigid sphere on a half space", "Force and indentation of penalty contact and of a rigid wall, in a mesh graded down to a sixth of the "
               "contact's radius.", "Hertz, F = 4/3 E* sqrt(R) d^1.5, integrated", runs, figures)


def karas():
    """f3: a steel sphere of 10 mm radius at 1 m/s on the centre of a plate of 200 by 200 by 8 mm."""
    o = oracles()["f3_karas"]
    table, folder, half, h = "f3_karas_rigid_sphere.csv", ROOT / "karas", 500 * o["a"], 1000 * o["h"]
    write_table(folder / table, *resampled(table, 0.5e-6, 60e-6))
    runs, figures = {}, []
    for n, growth, first, slow in ((4, 1.4, 0.15, False), (5, 1.35, 0.12, True)):
        m = graded_plate(n, 0.6, half, h, growth, first)
        s, plate, ids = quarter_of_elastic("Rigid sphere on a simply supported plate", f"A quarter, {len(m.elements)} hexahedra.", 0.08, SHORT, m, o)
        s.hold([ids[k] for k in m.where(lambda x, y, z: max(x, y) > half - 1e-6 and abs(z + h / 2) < 1e-6)], "z")
        s.contact(1, "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", plate, falling_ball(s, o, o["m"], 0.8, n), FIRM)
        key = f"impact_{n}"
        s.write(folder / f"{key}.k")
        runs[key] = {"deck": f"{key}.k", "sample": 5e-4, "end": 0.06, **({"long": True} if slow else {})}
        what = f"elements of {0.6 / n:g} mm"
        figures += history(f"force, {what}", key, {"contact": 1, "quantity": "force", "components": [2], "factor": -4}, table, "force", 1e-3,
                           0.03 if slow else 0.05)
        figures += history(f"way of the sphere, {what}", key, {"body": 2, "quantity": "displacement", "components": [2], "factor": -1}, table,
                           "z_sphere", 1e3, 0.03)
        figures += [{"figure": f"velocity of rebound, {what}, relative", "run": key, "signal": {"body": 2, "quantity": "velocity", "components": [2],
                     "factor": -1}, "oracle": {"file": table, "columns": ["v_sphere"], "time_factor": 1000}, "measure": "final_error", "scale": 0.58473,
                     "limit": 0.03}, drift(what, key)]
    write_case(folder, "Rigid sphere on a plate", "A short impact in which the plate's bending waves and the local indentation take part alike.",
               "Karas (1939): modal sum of Kirchhoff's plate with Hertz's law", runs, figures)


def geometric(first, length, growth):
    """Ends of intervals that grow geometrically from `first` to fill `length`: 0, …, length."""
    count = max(1, round(math.log(1 + length * (growth - 1) / first) / math.log(growth)))
    places, size = [0.0], 1.0
    for _ in range(count):
        places.append(places[-1] + size)
        size *= growth
    return [p * length / places[-1] for p in places]


def graded_plate(n, side, half_width, thickness, growth, first):
    """Hexahedra of a quarter of a square plate, z from 0 down: a core of n by n columns and two blocks that grow outwards; layers that grow
    from `first` on top to the middle surface and further below."""
    m = mesh.Mesh()
    outwards = [(side + r) / side for r in geometric(side / n, half_width - side, growth)]
    upper = geometric(first, thickness / 2, growth)
    size = upper[-1] - upper[-2]
    below = max(2, round(thickness / 2 / size))
    depths = upper + [thickness / 2 * (1 + (k + 1) / below) for k in range(below)]

    def column(corners):
        for above, under in zip(depths, depths[1:]):
            m.elements.append(tuple(m.node(x, y, -z) for z in (under, above) for x, y in corners))

    edge = [side * i / n for i in range(n + 1)]
    for i in range(n):
        for j in range(n):
            column([(edge[i], edge[j]), (edge[i + 1], edge[j]), (edge[i + 1], edge[j + 1]), (edge[i], edge[j + 1])])
        for r, q in zip(outwards, outwards[1:]):
            column([(r * side, r * edge[i]), (q * side, q * edge[i]), (q * side, q * edge[i + 1]), (r * side, r * edge[i + 1])])
            column([(r * edge[i + 1], r * side), (q * edge[i + 1], q * side), (q * edge[i], q * side), (r * edge[i], r * side)])
    return m


def boxed(nx, ny, nz, size, at=(0.0, 0.0, 0.0)):
    """A block of hexahedra."""
    m = mesh.extruded(mesh.rectangle(nx, ny, size[0], size[1]), nz, size[2])
    return m, lambda x, y, z: (x + at[0], y + at[1], z + at[2])


def impact_pair():
    """A block of steel falls askew and off its centre on a free plate of steel shells."""
    folder, end = ROOT / "impact_pair", 1.0
    s = Scene("A block falls on a free plate", "Solids against shells, askew and off the centre.", MM, 1.5, 0.4)
    plate = s.part(shells(4.0), elastic(7.8e-6, 210.0, 0.3))
    block = s.part(solids(), elastic(7.8e-6, 210.0, 0.3))
    s.add(plate, mesh.rectangle(6, 6, 100.0, 100.0))
    m, place = boxed(4, 4, 2, (60.0, 60.0, 30.0), (23.0, 19.0, 3.0))
    ids = s.add(block, m, lambda x, y, z: [a + b for a, b in zip(place(x, y, z), (0, 0, 0.05 * x + 0.03 * y))])
    s.text("$ IHQ, QM", "*CONTROL_HOURGLASS", "4,0.05")
    s.nodes_set(1, ids.values())
    s.text("*INITIAL_VELOCITY", "1", card(0.5, 0.3, -5.0))
    s.contact(1, "AUTOMATIC_SURFACE_TO_SURFACE", block, plate)
    s.write(folder / "pair.k")
    runs = {"pair": {"deck": "pair.k", "sample": 0.01, "end": end}}
    of_both = {q: {"sum": [{"part": p, "quantity": q} for p in (plate, block)]} for q in ("momentum", "angular_momentum")}
    figures = [{"figure": f"{name} of both, drift, of the first", "run": "pair", "signal": of_both[q], "measure": "drift", "scale": "initial", "limit": limit}
               for q, name, limit in (("momentum", "momentum", 1e-12), ("angular_momentum", "angular momentum", 1e-12))]
    figures += [{"figure": "momentum that the plate has got, of the block's first, at least", "run": "pair",
                 "signal": {"part": plate, "quantity": "momentum", "components": [2], "norm": True}, "measure": "largest",
                 "scale": 5 * 60 * 60 * 30 * 7.8e-6, "at_least": 0.1},
                {"figure": "energy of contact after it, of the first energy", "run": "pair", "signal": {"energy": "sliding"}, "oracle": {"value": [0]},
                 "measure": "final_error", "scale": 0.5 * 60 * 60 * 30 * 7.8e-6 * 25.34, "limit": 0.01}, drift("both", "pair")]
    write_case(folder, "Impact of a block on a free plate", "Contact forces are equal and opposite and act in one line; a contact without friction "
               "gives back what it takes.", "conservation of momentum, angular momentum and energy", runs, figures)


def friction_incline():
    """Two elastic blocks on an incline of 25 degrees: one slides, the other sticks."""
    folder, end, g, angle, slides, sticks = ROOT / "friction_incline", 100.0, 9.81e-3, math.radians(25), 0.2, 0.6
    s = Scene("Blocks on an incline", "Axes along the incline; one block slides, the other sticks.", MM, 1.2 * end, 0.9)
    floor = s.part(shells(2.0), rigid(7.8e-6, 210.0, 0.3, 7, 7))
    s.add(floor, mesh.rectangle(15, 8, 150.0, 80.0))
    tips = []
    for number, (mu, y) in enumerate(((slides, 5.3), (sticks, 45.3)), 1):
        block = s.part(solids(), elastic(1e-6, 0.1, 0.3))
        m, place = boxed(4, 4, 2, (24.0, 24.0, 8.0), (7.0, y, 1.0))
        ids = s.add(block, m, place)
        tips.append(ids[m.at(12, 12, 4)])
        s.contact(number, "AUTOMATIC_SURFACE_TO_SURFACE", block, floor, friction=(mu, mu, 0.0), damping=40.0)
    s.gravity((g * math.sin(angle), 0, -g * math.cos(angle)))
    s.write(folder / "blocks.k")
    runs = {"blocks": {"deck": "blocks.k", "sample": 1.0, "end": end}}
    mass, normal = 24 * 24 * 8 * 1e-6, 24 * 24 * 8 * 1e-6 * g * math.cos(angle)
    way = 0.5 * g * (math.sin(angle) - slides * math.cos(angle)) * end ** 2
    write_table(folder / "sliding.csv", ["t", "x"], [(t, way * (t / end) ** 2) for t in range(int(end) + 1)])
    x = [{"node": n, "quantity": "displacement", "components": [0]} for n in tips]
    figures = [{"figure": "way of the sliding block over time, of its last", "run": "blocks", "signal": x[0],
                "oracle": {"file": "sliding.csv", "columns": ["x"]}, "measure": "max_error", "scale": "peak", "limit": 0.01},
               {"figure": "what friction has taken at the end, of mu N x", "run": "blocks", "signal": {"contact": 1, "quantity": "friction_energy"},
                "oracle": {"value": [slides * normal * way]}, "measure": "final_error", "scale": "peak", "limit": 0.01},
               {"figure": "largest way of the block that sticks, of what it would slide freely", "run": "blocks", "signal": x[1], "measure": "largest",
                "scale": 0.5 * g * math.sin(angle) * end ** 2, "limit": 1e-3},
               {"figure": "force along the incline that holds it at the end, of m g sin", "run": "blocks",
                "signal": {"contact": 2, "quantity": "force", "components": [0]}, "oracle": {"value": [-mass * g * math.sin(angle)]},
                "measure": "final_error", "scale": "peak", "limit": 0.01},
               {"figure": "energy: total - external work, of the largest external work", "run": "blocks", "signal": {"energy": "balance"},
                "oracle": {"run": "blocks", "signal": {"energy": "external_work"}}, "measure": "largest", "scale": "peak", "limit": 0.01}]
    write_case(folder, "Blocks on an incline", "Coulomb's friction of deformable blocks: sliding and sticking.", "x = (sin - mu cos) g t^2/2", runs, figures)


def stack_of_plates():
    """Four loose elastic plates rest on a rigid floor: every contact carries what lies above it."""
    folder, count, size, h, g, end = ROOT / "stack_of_plates", 4, 60.0, 2.0, 9.81e-3, 60.0
    s = Scene("A stack of plates", "Four loose plates on a rigid floor.", MM, 1.2 * end, 0.9)
    floor = s.part(shells(h), rigid(7.8e-6, 210.0, 0.3, 7, 7))
    s.add(floor, mesh.rectangle(5, 5, 100.0, 100.0, -20.0, -20.0))
    plates = [s.part(shells(h), elastic(7.8e-6, 2.1, 0.3)) for _ in range(count)]
    for k, plate in enumerate(plates, 1):
        s.add(plate, mesh.rectangle(5 + k % 2, 5 + k % 2, size, size), lambda x, y, z, k=k: (x, y, k * h))
        s.contact(k, "AUTOMATIC_SURFACE_TO_SURFACE", plate, plate - 1, damping=50.0)
    s.gravity((0, 0, -g))
    s.write(folder / "stack.k")
    runs = {"stack": {"deck": "stack.k", "sample": 1.0, "end": end}}
    weight = size * size * h * 7.8e-6 * g
    figures = [{"figure": f"force under plate {k} from below at rest, relative", "run": "stack", "signal": {"contact": k, "quantity": "force", "components": [2]},
                "oracle": {"value": [(count + 1 - k) * weight]}, "measure": "max_error", "from": 0.8 * end, "scale": "peak", "limit": 0.01}
               for k in range(1, count + 1)]
    figures += [{"figure": "kinetic energy at rest, of the work of the weight over 0.01 mm", "run": "stack", "signal": {"energy": "kinetic"},
                 "measure": "largest", "from": 0.8 * end, "scale": 4 * weight * 0.01, "limit": 0.01}]
    write_case(folder, "Stack of plates", "Loose plates come to rest on each other.", "weights", runs, figures)


def ball_in_box():
    """A rigid ball flies about in a rigid box of shells."""
    folder, end, size, radius, speed = ROOT / "ball_in_box", 200.0, 100.0, 20.0, (6.1, 3.7, 2.3)
    s = Scene("A ball in a box", "A rigid ball of shells flies about in a rigid box of shells.", MM, 1.2 * end, 0.9)
    box = s.part(shells(2.0), rigid(7.8e-6, 210.0, 0.3, 7, 7))
    mass = 4 / 3 * math.pi * radius ** 3 * 1e-6
    inertia = 0.4 * mass * radius ** 2
    ball = s.part(shells(1.0), rigid(7.8e-6, 210.0, 0.3),
                  ["$ centre, mass", card(0, 0, 0, mass, 0), "$ inertia", card(inertia, 0, 0, inertia, 0, inertia), "$ velocity", card(*speed, 0, 0, 0)])
    for part, n, half, bulge in ((box, 4, size / 2 + 1, False), (ball, 4, 1.0, True)):
        m = mesh.Mesh()
        for axis in range(3):
            for sign in (1, -1):
                m.grid(n, n, lambda u, v, a=axis, f=sign: tuple((f * half, (2 * u - 1) * half * f, (2 * v - 1) * half)[(k - a) % 3] for k in range(3)))
        s.add(part, m, (lambda *x: [radius * c / math.hypot(*x) for c in x]) if bulge else (lambda *x: x))
    s.contact(1, "AUTOMATIC_SURFACE_TO_SURFACE", ball, box)
    s.write(folder / "box.k")
    runs = {"box": {"deck": "box.k", "sample": 1.0, "steps": 800, "end": end}}
    position = {"body": 2, "quantity": "center"}
    kinetic = 0.5 * mass * sum(v * v for v in speed)
    figures = [{"figure": f"largest distance of the centre from that of the box, axis {a}", "unit": "mm", "run": "box", "signal": {**position, "components": [a]},
                "measure": "largest", "limit": size / 2 - radius + 0.5} for a in range(3)]
    figures += [drift("whole run", "box"),
                {"figure": "kinetic energy at the end, of the first", "run": "box", "signal": {"energy": "kinetic"}, "oracle": {"value": [kinetic]},
                 "measure": "final_error", "scale": "peak", "limit": 0.01}]
    write_case(folder, "A ball in a box", "Nothing gets out of a closed box, and rigid bodies without friction keep their energy over some forty impacts.",
               "conservation of energy", runs, figures)


def dented(x, y, z, width):
    """A dent that starts the first fold of a square tube: two opposite sides go in, the others out."""
    begin, wave = 0.25 * width, 0.8 * width
    if begin <= z <= begin + wave:
        depth = 0.004 * width * math.sin(math.pi * (z - begin) / wave)
        if x in (0, width):
            return x + (depth if x == 0 else -depth) * math.sin(math.pi * y / width), y, z
        if y in (0, width):
            return x, y - (depth if y == 0 else -depth) * math.sin(math.pi * x / width), z
    return x, y, z


def crush_tube():
    """A square steel tube of 160 by 160 by 600 mm, 1.2 mm thick, between a rigid wall and a rigid plate that comes down at 15 m/s."""
    folder, width, length, h, speed, end, gap, sides = ROOT / "crush_tube", 160.0, 600.0, 1.2, 15.0, 15.0, 0.05, 26
    levels = round(length / width * sides)
    m = mesh.Mesh()
    for a, b in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0))):
        m.grid(sides, levels, lambda u, v: (width * (a[0] + (b[0] - a[0]) * u), width * (a[1] + (b[1] - a[1]) * u), length * v))
    walls = len(m.elements)
    m.grid(sides, sides, lambda u, v: (width * u, width * v, length))
    lid, m.elements = m.elements[walls:], m.elements[:walls]

    s = Scene("Crush tube", f"{walls} shells, contact with itself, between a rigid wall and a rigid plate.", MM, end, 0.9)
    hardening = [(0, .25), (.01, .27), (.02, .285), (.05, .32), (.1, .36), (.2, .41), (.4, .47), (1.0, .55)]
    s.curve(100, hardening)
    tube = s.part(shells(h), lambda number: ["$ LCSS = 100", "*MAT_PIECEWISE_LINEAR_PLASTICITY", card(number, 7.85e-6, 210.0, 0.3, 0.25), "0,0,100", "0", "0"])
    plate = s.part(shells(h), rigid(7.85e-6, 210.0, 0.3, 4, 7))
    ids = s.add(tube, m, lambda x, y, z: (*dented(x, y, z, width)[:2], z + gap))
    s.share(plate, ids, lid)
    s.curve(200, [(0, -speed), (1e3, -speed)])
    s.text("$ the plate, z, velocity by curve 200", "*BOUNDARY_PRESCRIBED_MOTION_RIGID", card(plate, 3, 0, 200, 1.0),
           "$ everything comes down", "*INITIAL_VELOCITY_GENERATION", card(tube, 2, 0, 0, 0, -speed), card(0, 0, 0, 0, 0, 0),
           "*INITIAL_VELOCITY_GENERATION", card(plate, 2, 0, 0, 0, -speed), card(0, 0, 0, 0, 0, 0),
           "$ all nodes; a point of the wall, a point before it, friction", "*RIGIDWALL_PLANAR", "0", card(0, 0, 0, 0, 0, 1.0, 0.3),
           "*SET_PART_LIST", "10", card(tube, plate))
    s.contact(1, "AUTOMATIC_SINGLE_SURFACE", 10, 0, friction=(0.2, 0.2, 0.0))
    s.write(folder / "tube.k")
    mean = 9.56 * (hardening[0][1] + hardening[-1][1]) / 2 * h ** (5 / 3) * width ** (1 / 3)
    note = ("Wierzbicki and Abramowicz: P = 9.56 s t^(5/3) C^(1/3), with the flow stress s = 0.40 GPa, half way between the first and the last stress of the curve. "
            "The choice decides: sqrt(s_y s_u/(1 + n)) would be 0.34 GPa.")
    figures = [{"figure": "energy ratio, largest distance from 1", "run": "tube", "signal": {"energy": "ratio"}, "oracle": {"value": [1]},
                "measure": "max_error", "limit": 0.02},
               {"figure": "hourglass energy, of the largest external work", "run": "tube", "signal": {"energy": "hourglass"},
                "oracle": {"run": "tube", "signal": {"energy": "external_work"}}, "measure": "largest", "scale": "peak", "limit": 0.1},
               {"figure": "work of the plate over its way of 225 mm against the mean crush force, relative", "run": "tube",
                "signal": {"energy": "external_work", "factor": 1 / (speed * end)}, "oracle": {"value": [mean]}, "measure": "final_error", "scale": "peak",
                "limit": 0.15, "note": note}]
    write_case(folder, "Square crush tube", "Ten thousand shells fold into each other: the energy balance of large plastic folding with contact, the mean "
               "force.", "Wierzbicki and Abramowicz (1983), J. Appl. Mech. 50, 727-734: mean crush force of a square tube",
               {"tube": {"deck": "tube.k", "sample": 0.1, "end": end, "long": True}}, figures)


def write_all():
    crush_tube()
    hertz()
    karas()
    impact_pair()
    friction_incline()
    stack_of_plates()
    ball_in_box()
