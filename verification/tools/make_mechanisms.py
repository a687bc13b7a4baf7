#!/usr/bin/env python3
"""Writes the decks and oracle tables of verification/mechanisms (case.json files are written by hand).

usage: make_mechanisms.py [SHARED]   SHARED: the folder that holds verification/ and corpus/ (oracle tables);
                                     without it only the decks are written.
"""
import csv
import json
import math
import os
import sys

from deck import GLOBAL, Deck, add, card, cross, diag, dot, num, scale, sub, unit

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "mechanisms")
X, Y, Z = GLOBAL
TENSOR = [[0.02, 0.003, -0.004], [0.003, 0.025, 0.002], [-0.004, 0.002, 0.03]]  # cylindrical and planar cases


def path(case, name):
    os.makedirs(os.path.join(ROOT, case), exist_ok=True)
    return os.path.join(ROOT, case, name)


def rod(deck, part, title, mass, inertia, a, b, width=0.02, velocity=None):
    """A straight link from a to b with its centre in the middle, `inertia` in global axes."""
    middle, along = scale(0.5, add(a, b)), unit(sub(b, a))
    side = unit(cross(Z if abs(along[2]) < 0.9 else X, along))
    half = 0.5 * math.sqrt(dot(sub(b, a), sub(b, a)))
    deck.body(part, title, mass, middle, inertia, (half, width / 2, width / 2), show=(middle, [along, side, cross(along, side)]))
    if velocity:
        deck.initial(part, *velocity)


def slider_crank():
    a, b, d = [0.1, 0, 0], [0.378388218141501, 0.05, 0.1], [0, 0.05, 0.1]
    b = [math.sqrt(0.3**2 - 0.05**2 - 0.1**2) + 0.1, 0.05, 0.1]
    along = unit(sub(b, a))
    side = unit(cross(Z, along))
    axes = [along, side, cross(along, side)]
    middle = scale(0.5, add(a, b))
    w_coupler = [5.555555555555556, 0.9978072334820831, -15.964915735713323]
    about = """RSSP spatial slider-crank: ground - revolute - crank - spherical - coupler - spherical - slider -
translational - ground. Crank axis z through the origin, r = 0.1 m; slider line along x through (0, 0.05, 0.10);
coupler 0.3 m. No gravity, no load: the crank starts at 50 rad/s and the motion conserves energy.
"""
    for name, consistent, note in (("rssp.k", True, "All bodies start with velocities that fit the joints."),
                                   ("crank_only.k", False, "Only the crank moves at t = 0: the joints jump it to "
                                    "39.512 rad/s, then the motion is\nthat of rssp.k slowed by k = 0.790240349597417.")):
        k = Deck("RSSP spatial slider-crank", about + note, 0.5, 1e-5, 1e-3)
        k.ground(1)
        k.body(2, "crank", 1.5, [0.05, 0, 0], [[2e-3, 2e-4, 1e-4], [2e-4, 4e-3, -1.5e-4], [1e-4, -1.5e-4, 5e-3]],
               (0.06, 0.01, 0.01))
        k.body(3, "coupler", 0.6, middle, diag(6e-5, 4.5e-3, 4.5e-3), (0.15, 0.006, 0.006), axes)
        k.body(4, "slider", 0.8, b, [[4e-4, 3e-5, 0], [3e-5, 5e-4, 2e-5], [0, 2e-5, 6e-4]], (0.02, 0.015, 0.015))
        k.joint("revolute", 1, "ground - crank", 1, 2, [[0, 0, 0], [0, 0, 0.1]])
        k.joint("spherical", 2, "crank - coupler", 2, 3, [a])
        k.joint("spherical", 3, "coupler - slider", 3, 4, [b])
        k.joint("translational", 4, "ground - slider", 1, 4, [b, add(b, [0.1, 0, 0]), add(b, [0, 0.1, 0])])
        k.initial(2, [0, 2.5, 0], [0, 0, 50])
        if consistent:
            k.initial(3, add([0, 5, 0], cross(w_coupler, sub(middle, a))), w_coupler)
            k.initial(4, [0.8980265101338748, 0, 0], [0, 0, 0])
        k.write(path("rssp", name))


def a01():
    k = Deck("IFToMM A01: simple pendulum", """IFToMM benchmark A01: a point mass of 1 kg on a massless rod of 1 m, at rest at x = +1, y = 0.
A rigid body needs some inertia; 1e-10 kg m2 changes the period by 5e-11 of itself.""", 10, 1e-4, 0.01)
    k.ground(1)
    k.body(2, "point mass", 1.0, [1, 0, 0], diag(1e-10, 1e-10, 1e-10), (0.05, 0.05, 0.05))
    k.joint("revolute", 1, "pivot", 1, 2, [[0, 0, 0], [0, 0, 0.1]])
    k.gravity("Y", 9.81)
    k.write(path("pendulum_a01", "pendulum.k"))


def a02(n):
    k = Deck(f"IFToMM A02: {n} four-bars", f"""IFToMM benchmark A02 with N = {n}: {n + 1} vertical links and {n} couplers, each 1 m and 1 kg, all joints
revolute about z. The mechanism is over-constrained and passes through singular positions (all links in line);
the parallel branch goes on. B0, the top of the first link, starts at +1 m/s.""", 10, 1e-4, 0.01)
    slender = lambda p, q: diag(*[1e-3 if abs(c) > 0.5 else 1 / 12 for c in sub(q, p)])
    k.ground(1)
    for i in range(n + 1):
        rod(k, 2 + i, f"vertical {i}", 1.0, slender([i, 0, 0], [i, 1, 0]), [i, 0, 0], [i, 1, 0],
            velocity=([0.5, 0, 0], [0, 0, -1]))
    for i in range(n):
        rod(k, 101 + i, f"coupler {i}", 1.0, slender([i, 1, 0], [i + 1, 1, 0]), [i, 1, 0], [i + 1, 1, 0],
            velocity=([1, 0, 0], [0, 0, 0]))
    for i in range(n + 1):
        k.joint("revolute", 1 + i, f"ground - vertical {i}", 1, 2 + i, [[i, 0, 0], [i, 0, 0.1]])
    for i in range(n):
        for side in (0, 1):
            k.joint("revolute", 101 + 2 * i + side, f"vertical {i + side} - coupler {i}", 2 + i + side, 101 + i,
                    [[i + side, 1, 0], [i + side, 1, 0.1]])
    k.gravity("Y", 9.81)
    tip = k.node([0, 1, 0], 2)
    k.text(f"$ node {tip} is B0", "*DATABASE_HISTORY_NODE", num(tip))
    k.write(path(f"four_bars_a02_n{n}", "four_bars.k"))
    return tip


def a03(data):
    p, com = data["initial_points"], data["initial_com"]
    mass = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498]
    inertia = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5]
    ends = [("O", "F"), ("F", "E"), ("B", "E"), ("G", "E"), ("A", "G"), ("H", "E"), ("A", "H")]
    k = Deck("IFToMM A03: Andrews' squeezer", """Andrews' squeezer (Schiehlen, Multibody Systems Handbook, 1990; Hairer & Wanner 1996): seven rigid bodies,
ten revolute joints about z, a torque of 0.033 N m on K1, a spring of 4530 N/m between D on K3 and the fixed C.
Starts at rest. Parts 11 ... 17 are K1 ... K7; B, E, D of the triangle K3 belong to part 13.""", 0.05, 1e-6, 1e-4)
    k.ground(1, half=(0.002, 0.002, 0.002))
    for i in range(7):
        a, b = p[ends[i][0]], p[ends[i][1]]
        along = unit(sub(b, a))
        length = math.sqrt(dot(sub(b, a), sub(b, a)))
        k.body(11 + i, f"K{i + 1}", mass[i], com[i], diag(inertia[i], inertia[i], inertia[i]), (0.5 * length, 5e-4, 5e-4),
               show=(scale(0.5, add(a, b)), [along, cross(Z, along), Z]))
    pairs = [("O", 1, 11), ("F", 11, 12), ("E", 12, 13), ("E", 12, 14), ("E", 12, 16), ("B", 1, 13), ("G", 14, 15),
             ("A", 1, 15), ("A", 1, 17), ("H", 16, 17)]
    for number, (name, a, b) in enumerate(pairs):
        k.joint("revolute", number + 1, f"{name}", a, b, [p[name], add(p[name], [0, 0, 0.01])])
    d, c = k.node(p["D"], 13), k.node(p["C"], 1)
    k.constant_curve()
    stretched = math.sqrt(dot(sub(p["D"], p["C"]), sub(p["D"], p["C"])))
    k.text("$ torque on K1", "*LOAD_RIGID_BODY", card(11, 7, 1, 0.033),
           "$ spring from D to C; free length 0.07785 m, so it starts elongated by OFFSET", "*PART", "spring", "21,21,21",
           "*SECTION_DISCRETE", "21,0", "0,0", "*MAT_SPRING_ELASTIC", "21,4530",
           "*ELEMENT_DISCRETE", f"1,21,{d},{c},0,1,0,{num(stretched - 0.07785)}")
    k.write(path("andrews_a03", "andrews.k"))


def tops():
    for name, w, how in (("dzhanibekov", [0.01, 10, 0], "card"), ("generic", [4, 3, 2], "part")):
        k = Deck(f"Euler top, {name}", f"""A torque-free top with principal moments 1, 2 and 3 g m2, started at ({w[0]}, {w[1]}, {w[2]}) rad/s.
The velocity is given by {'*INITIAL_VELOCITY_RIGID_BODY' if how == 'card' else 'the velocity card of *PART_INERTIA'}.""", 10, 1e-4, 0.01)
        k.body(1, "top", 1.0, [0, 0, 0], diag(1e-3, 2e-3, 3e-3), (0.08, 0.06, 0.03),
               velocity=None if how == "card" else [0, 0, 0] + w)
        if how == "card":
            k.initial(1, [0, 0, 0], w)
        k.write(path(f"euler_top_{name}", "top.k"))


def cardan_shafts(k, beta, i_in, i_out):
    out = [math.cos(beta), math.sin(beta), 0]
    side = cross(Z, out)
    k.ground(1)
    k.body(2, "input shaft", 1.0, [-0.2, 0, 0], diag(i_in, i_in, i_in), (0.2, 0.02, 0.02))
    k.body(3, "output shaft", 1.0, scale(0.2, out), diag(i_out, i_out, i_out), (0.2, 0.02, 0.02), [out, side, Z])
    k.joint("revolute", 1, "ground - input", 1, 2, [[-0.4, 0, 0], [-0.3, 0, 0]])
    k.joint("revolute", 2, "ground - output", 1, 3, [scale(0.4, out), scale(0.5, out)])
    # pins: y on the input shaft (in the plane of the shafts at theta = 0), z on the output shaft
    k.joint("universal", 3, "Cardan joint", 2, 3, [[0, 0, 0], ([0, 0.05, 0], [0, 0, 0.05])])
    return out


def cardan():
    for degrees in (10, 30):
        beta = math.radians(degrees)
        end = 2 * math.pi / 10
        k = Deck(f"Cardan joint, {degrees} degrees", f"""Two shafts meet at {degrees} degrees in a Cardan joint; the input turns at 10 rad/s (prescribed). The output
then turns at cos b / (1 - sin2 b cos2 theta) times the input. At t = 0 the input yoke's pin lies in the plane
of the shafts. Revolutes at both shafts make the loop over-constrained.""", end, 1e-5, end / 720)
        out = cardan_shafts(k, beta, 0.02, 0.05)
        k.initial(2, [0, 0, 0], [10, 0, 0])
        k.initial(3, [0, 0, 0], scale(10 / math.cos(beta), out))
        k.constant_curve()
        k.text("$ input: angular velocity about x, 10 rad/s", "*BOUNDARY_PRESCRIBED_MOTION_RIGID", card(2, 5, 0, 1, 10))
        k.write(path("cardan_kinematic", f"cardan_{degrees}.k"))
    k = Deck("Cardan joint, driven", """Shafts at 30 degrees, 5 N m on the input (inertia 0.02 kg m2), a damper of 0.1 N m s/rad between the output
(0.05 kg m2) and ground, from rest.""", 2, 1e-4, 1e-3)
    out = cardan_shafts(k, math.radians(30), 0.02, 0.05)
    k.constant_curve()
    frames(k, [(31, 1, scale(0.4, out), out), (32, 3, scale(0.4, out), out)])
    k.text("$ torque on the input shaft", "*LOAD_RIGID_BODY", card(2, 5, 1, 5),
           "$ damping moment against rate", "*DEFINE_CURVE", "2", "-1000,-100", "1000,100",
           "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "1,1,3,31,32", "0,0,0,2,0,0", "0,0,0,0,0,0", "0,0,0,0,0,0")
    k.write(path("cardan_driven", "cardan.k"))


def frames(k, specs):
    """*DEFINE_COORDINATE_NODES moving with bodies: (id, body, origin, direction of local x)."""
    for number, body, origin, x in specs:
        y = unit(cross(Z if abs(x[2]) < 0.9 else X, x))
        ids = [k.node(origin, body), k.node(add(origin, scale(0.1, x)), body), k.node(add(origin, scale(0.1, y)), body)]
        k.text(f"$ frame {number} moves with part {body}", "*DEFINE_COORDINATE_NODES", card(number, *ids, 1))


def guided():
    k = Deck("Cylindrical joint", """A body on a cylindrical joint along z with a full inertia tensor: falls freely along the axis while a
torque of 0.3 N m about the axis speeds it up; the joint takes the moments of the products of inertia.""", 1, 1e-5, 1e-3)
    k.ground(1)
    k.body(2, "body", 2.0, [0, 0, 1], TENSOR, (0.05, 0.05, 0.05))
    k.joint("cylindrical", 1, "axis", 1, 2, [[0, 0, 1], [0, 0, 1.1]])
    k.initial(2, [0, 0, 0.5], [0, 0, 3])
    k.gravity("Z", 9.81)
    k.text("$ torque about z", "*LOAD_RIGID_BODY", card(2, 7, 1, 0.3))
    k.write(path("cylindrical", "cylindrical.k"))

    t = math.radians(20)
    down, over, normal = [math.cos(t), 0, -math.sin(t)], [0, 1, 0], [math.sin(t), 0, math.cos(t)]
    at = lambda x, y: add(scale(x, down), scale(y, over))
    k = Deck("Planar joint on an incline", """A spinning body slides without friction on a plane inclined by 20 degrees (planar joint); the tensor
is given in the axes of the plane (down, across, normal).""", 1, 1e-5, 1e-3)
    k.ground(1)
    k.body(2, "body", 2.0, at(0.1, -0.2), TENSOR, (0.05, 0.05, 0.03), [down, over, normal])
    k.joint("planar", 1, "plane", 1, 2, [at(0.1, -0.2), add(at(0.1, -0.2), scale(0.1, normal))])
    k.initial(2, at(0.4, 0.3), scale(5, normal))
    k.gravity("Z", 9.81)
    k.write(path("planar_incline", "planar.k"))

    t = math.radians(30)
    down, normal = [math.cos(t), 0, -math.sin(t)], [math.sin(t), 0, math.cos(t)]
    for name, mu in (("frictionless.k", 0), ("friction.k", 0.2)):
        k = Deck(f"Translational joint on an incline, mu = {mu}", f"""A body on a slide (translational joint) inclined by 30 degrees, from rest, mu = {mu}."""
                 + ("""
Friction: *CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL along the slide's axis (x of the frames), FS = FD = mu on the
force of joint 1 (JID). ESX = 0: Coulomb's law without a spring that would have to be drawn first.""" if mu else ""), 1, 1e-5, 1e-3)
        k.ground(1)
        k.body(2, "slider", 2.0, [0, 0, 0], diag(0.02, 0.02, 0.02), (0.05, 0.03, 0.03), [down, Y, normal])
        k.joint("translational", 1, "slide", 1, 2, [[0, 0, 0], scale(0.1, down), [0, 0.1, 0]])
        k.gravity("Z", 9.81)
        if mu:
            frames(k, [(31, 1, [0, 0, 0], down), (32, 2, [0, 0, 0], down)])
            k.text("*CONSTRAINED_JOINT_STIFFNESS_TRANSLATIONAL", "1,1,2,31,32,1", "0,0,0,0,0,0", "0,0,0,0,0,0",
                   card(0, 0, 0, 0, 0, 0, mu, mu))
        k.write(path("translational_incline", name))


def double_pendulum():
    k = Deck("Double pendulum", """Two uniform rods, 1 m and 1 kg each, hinged about z: the first starts horizontal, the second hangs down.""",
             1, 1e-5, 0.01)
    k.ground(1)
    rod(k, 2, "first rod", 1.0, diag(1e-3, 1 / 12, 1 / 12), [0, 0, 0], [1, 0, 0])
    rod(k, 3, "second rod", 1.0, diag(1 / 12, 1e-3, 1 / 12), [1, 0, 0], [1, -1, 0])
    k.joint("revolute", 1, "ground - first", 1, 2, [[0, 0, 0], [0, 0, 0.1]])
    k.joint("revolute", 2, "first - second", 2, 3, [[1, 0, 0], [1, 0, 0.1]])
    k.gravity("Y", 9.81)
    tip = k.node([1, -1, 0], 3)
    k.text(f"$ node {tip} is the tip", "*DATABASE_HISTORY_NODE", num(tip))
    k.write(path("double_pendulum", "double_pendulum.k"))


def stops():
    def stiffness(es, fm, low, high):
        return ["*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "1,1,2,31,32", "0,0,0,0,0,0", card(es, fm, 0, 0, 0, 0),
                "$ stop angles in degrees", card(low, high, 0, 0, 0, 0)]

    k = Deck("Flywheel on an elastic stop", """A flywheel of 0.05 kg m2 turns at 10 rad/s about x, meets a stop of 2000 N m/rad at 0.5 rad and comes back.""",
             0.2, 1e-5, 1e-4)
    k.ground(1)
    k.body(2, "flywheel", 1.0, [0, 0, 0], diag(0.05, 0.05, 0.05), (0.02, 0.1, 0.1))
    k.joint("revolute", 1, "axle", 1, 2, [[0, 0, 0], [0.1, 0, 0]])
    k.initial(2, [0, 0, 0], [10, 0, 0])
    frames(k, [(31, 1, [0, 0, 0], X), (32, 2, [0, 0, 0], X)])
    k.text(*stiffness(2000, 0, 0, math.degrees(0.5)))
    k.write(path("stop_flywheel", "flywheel.k"))

    k = Deck("Pendulum between elastic stops", """A rod of 1 m and 1 kg hangs from a hinge about x, starts at 5 rad/s and hits stops of 500 N m/rad at
-30 and +30 degrees again and again.""", 3, 1e-5, 1e-3)
    k.ground(1)
    rod(k, 2, "rod", 1.0, diag(1 / 12, 1 / 12, 1e-3), [0, 0, 0], [0, 0, -1], velocity=([0, 2.5, 0], [5, 0, 0]))
    k.joint("revolute", 1, "hinge", 1, 2, [[0, 0, 0], [0.1, 0, 0]])
    k.gravity("Z", 9.81)
    frames(k, [(31, 1, [0, 0, 0], X), (32, 2, [0, 0, 0], X)])
    k.text(*stiffness(500, 0, -30, 30))
    k.write(path("stop_pendulum", "pendulum.k"))

    for name, total in (("spindown.k", False), ("spindown_total.k", True)):
        spin_down(name, total, stiffness)


def spin_down(name, total, stiffness):
    k = Deck("Coulomb spin-down", """A flywheel of 0.05 kg m2 at 20 rad/s is braked by a friction moment of 0.5 N m: it stops after 2 s and 20 rad.
The friction spring of 1e5 N m/rad slips at the limit.""", 3, 5e-6, 1e-3, total_moments=total)
    k.ground(1)
    k.body(2, "flywheel", 1.0, [0, 0, 0], diag(0.05, 0.05, 0.05), (0.02, 0.1, 0.1))
    k.joint("revolute", 1, "axle", 1, 2, [[0, 0, 0], [0.1, 0, 0]])
    k.initial(2, [0, 0, 0], [20, 0, 0])
    frames(k, [(31, 1, [0, 0, 0], X), (32, 2, [0, 0, 0], X)])
    k.text(*stiffness(1e5, 0.5, 0, 0))
    k.write(path("coulomb_spindown", name))


def chain(n):
    for kind in ("revolute", "spherical"):
        k = Deck(f"Chain of {n} rods, {kind} joints", f"""A chain of {n} uniform rods (0.1 m, 0.1 kg) from rest along +x, hinged to each other and to ground by {kind}
joints, falls under gravity along -z.""", 1, 1e-4, 0.01)
        k.ground(1)
        transverse = 0.1 * 0.1**2 / 12 + 1e-5
        for i in range(n):
            rod(k, 2 + i, f"rod {i + 1}", 0.1, diag(1e-5, transverse, transverse), [i / 10, 0, 0], [(i + 1) / 10, 0, 0], 0.02)
        for i in range(n):
            at = [i / 10, 0, 0]
            k.joint(kind, 1 + i, f"hinge {i}", 1 + i, 2 + i, [at] + ([[i / 10, 0.05, 0]] if kind == "revolute" else []))
        k.gravity("Z", 9.81)
        k.write(path(f"chain_n{n}", f"{kind}.k"))


def adams():
    """One body on one joint of ground; geometry, mass, inertia, load and axes from the .adm models (SI)."""
    turned = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]  # marker axes after REULER = 180D, 90D, 180D
    o = [0, 0, 0]
    cases = {
        "revolute": ("revolute", [2, 0, 0], turned, [0.04, 0.1, 0.1], [o, [0, 0.5, 0]]),
        "spherical": ("spherical", [2, 0, 0], GLOBAL, [0.04, 0.1, 0.1], [o]),
        "universal": ("universal", [0, 2, 0], [[1, 0, 0], [0, 0, 1], [0, -1, 0]], [0.1, 0.1, 0.04],
                      [o, ([0.5, 0, 0], [0, 0, 0.5])]),
        "cylindrical": ("cylindrical", [2, 0, 0], GLOBAL, [0.04, 0.1, 0.1], [o, [0, 0, 0.5]]),
        "prismatic": ("translational", [2, 0, 0], GLOBAL, [0.04, 0.1, 0.1], [o, [0, 0, 0.5], [0.5, 0, 0]]),
        "torsion_spring": ("revolute", [2, 0, 0], turned, [0.04, 0.1, 0.1], [o, [0, 0.5, 0]]),
    }
    for name, (kind, center, axes, inertia, points) in cases.items():
        about = f"""One body of 1 kg, 4 m long, on a {name.replace('_', ' ')} joint of ground under gravity 9.80665 m/s2 along -z:
the ADAMS model test_{ADAMS[name]}_Case01.adm of Project Chrono's tests (BSD-3)."""
        if name == "torsion_spring":
            about += """
Torsion spring 200 N m/rad and damper 10 N m s/rad: what the table itself gives (its moment over its angle and
rate); the .adm file says 57.3 and 2.86, with which the table was not computed."""
        k = Deck(f"ADAMS {name.replace('_', ' ')}", about, 5, 1e-4, 0.01)
        k.ground(1)
        long_axis = [1, 0, 0] if center[0] else [0, 1, 0]
        half = (2, 0.1, 0.1) if center[0] else (0.1, 0.1, 2)
        k.body(2, "pendulum", 1.0, center, diag(*inertia), half, axes)
        k.joint(kind, 1, name, 1, 2, points)
        k.gravity("Z", 9.80665)
        if name == "torsion_spring":
            frames(k, [(31, 1, o, Y), (32, 2, o, Y)])
            k.text("$ moment against angle, damping moment against rate", "*DEFINE_CURVE", "2", "-10,-2000", "10,2000",
                   "*DEFINE_CURVE", "3", "-100,-1000", "100,1000",
                   "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "1,1,2,31,32", "2,0,0,3,0,0", "0,0,0,0,0,0", "0,0,0,0,0,0")
        k.write(path(f"adams_{name}", "model.k"))


ADAMS = {"revolute": "Revolute", "spherical": "Spherical", "universal": "Universal", "cylindrical": "Cylindrical",
         "prismatic": "Prismatic", "torsion_spring": "RotSpring"}


def table(case, name, header, rows):
    with open(path(case, name), "w", newline="") as f:
        w = csv.writer(f, lineterminator="\n")
        w.writerow(header)
        w.writerows(rows)


def copy(shared, source, case, columns, until=1e99, every=1):
    """Copies the named columns of an oracle table, up to a time, every n-th row."""
    with open(os.path.join(shared, "verification", source + ".csv")) as f:
        rows = list(csv.reader(f))
    pick = [rows[0].index(c) for c in columns]
    body = [[r[i] for i in pick] for n, r in enumerate(rows[1:]) if n % every == 0 and float(r[0]) <= until * (1 + 1e-12)]
    table(case, source + ".csv", columns, body)


def oracles(shared):
    copy(shared, "a_rssp_A", "rssp", ["t", "theta", "omega_crank", "s", "v_slider", "Fx_on_slider", "Fy_on_slider", "Fz_on_slider"])
    copy(shared, "b_a01_pendulum", "pendulum_a01", ["t", "x", "y"])
    copy(shared, "b_a02_nfourbar_N2", "four_bars_a02_n2", ["t", "xB0", "yB0"])
    copy(shared, "b_a02_nfourbar_N40", "four_bars_a02_n40", ["t", "xB0", "yB0"], until=10)
    copy(shared, "b_a03_andrews_ivp", "andrews_a03", ["t", "beta", "theta", "gamma", "phi", "delta", "omega", "epsilon"], until=0.03)
    copy(shared, "c_eulertop_dzhanibekov", "euler_top_dzhanibekov", ["t", "w1_body", "w2_body", "w3_body"])
    copy(shared, "c_eulertop_generic", "euler_top_generic", ["t", "w1_body", "w2_body", "w3_body", "q0", "q1", "q2", "q3"])
    for b in (10, 30):
        copy(shared, f"d_cardan_kin_beta{b}", "cardan_kinematic", ["t", "theta_in", "theta_out", "ratio"])
    copy(shared, "d_cardan_driven", "cardan_driven", ["t", "theta_in", "omega_in", "omega_out"], every=10)
    copy(shared, "e_cylindrical", "cylindrical", ["t", "z", "vz", "phi", "omega"], every=10)
    copy(shared, "e_planar_incline", "planar_incline", ["t", "x_down", "y_cross", "phi"], every=10)
    copy(shared, "e_translational_incline", "translational_incline", ["t", "s_frictionless", "v_frictionless", "s_mu0.2", "v_mu0.2"], every=10)
    copy(shared, "e_double_pendulum_planar", "double_pendulum", ["t", "theta1", "theta2", "xtip", "ytip"], until=1)
    copy(shared, "e_stop_flywheel", "stop_flywheel", ["t", "phi", "omega", "M_stop"], every=10)
    copy(shared, "e_stop_pendulum", "stop_pendulum", ["t", "theta", "theta_dot", "M_stop"], every=10)
    copy(shared, "e_coulomb_spindown", "coulomb_spindown", ["t", "phi", "omega"], every=10)
    copy(shared, "g_chain_N10", "chain_n10", ["t", "x_tipcom", "z_tipcom", "phi_first", "phi_last"], every=10)
    copy(shared, "g_chain_N100", "chain_n100", ["t", "x_tipcom", "z_tipcom", "phi_first", "phi_last"])
    for name, adams_name in ADAMS.items():
        header, columns = ["t"], []
        for q, parts in (("Pos", "xyz"), ("Vel", "xyz"), ("Acc", "xyz"), ("Quat", "0123"), ("Avel", "xyz"), ("Aacc", "xyz"),
                         ("Rforce", "xyz"), ("Rtorque", "xyz")):
            header += [f"{q}_{c}" for c in parts]
            with open(os.path.join(shared, "corpus", "adams_joints", f"{adams_name}_Case01_ADAMS_{q}.txt")) as f:
                rows = [line.split() for line in f if line[0] in "+-"]
            if not columns:
                columns = [[r[0]] for r in rows]
            for c, r in zip(columns, rows):
                c += r[1:]
        table(f"adams_{name}", "adams.csv", header, columns)
    for name in ("spherical", "universal"):
        exact_pendulum(name)


def rk4(f, y, h):
    k1 = f(y)
    k2 = f(add(y, scale(h / 2, k1)))
    k3 = f(add(y, scale(h / 2, k2)))
    k4 = f(add(y, scale(h, k3)))
    return add(y, scale(h / 6, add(k1, scale(2, k2), scale(2, k3), k4)))


def exact_pendulum(name):
    """The spherical and the universal model swing in a plane as one pendulum: m = 1, d = 2, I = 0.1 + m d2, g = 9.80665.
    Runge-Kutta of order 4 with 0.1 ms steps (error < 1e-12)."""
    g, inertia = 9.80665, 4.1
    acceleration = lambda th: 2 * g * math.cos(th) / inertia
    y, rows = [0.0, 0.0], []
    for i in range(501):
        th, w = y
        al, c, s = acceleration(th), math.cos(th), math.sin(th)
        out, down = 2 * c, -2 * s  # horizontal, vertical position
        v = (-2 * w * s, -2 * w * c)
        a = (-2 * w * w * c - 2 * al * s, 2 * w * w * s - 2 * al * c)
        if name == "spherical":
            place = lambda p: [p[0], 0, p[1]]
            turn, quat = [0, w, 0, 0, al, 0], [math.cos(th / 2), 0, math.sin(th / 2), 0]
        else:
            place = lambda p: [0, p[0], p[1]]
            turn, quat = [-w, 0, 0, -al, 0, 0], [math.cos(math.pi / 4 - th / 2), math.sin(math.pi / 4 - th / 2), 0, 0]
        rows.append([num(round(i * 0.01, 10))] + [num(x) for x in place((out, down)) + place(v) + place(a) + quat + turn
                                                  + place((-a[0], -a[1] - g))])
        for _ in range(100):
            y = rk4(lambda u: [u[1], acceleration(u[0])], y, 1e-4)
    header = ["t"] + [f"{q}_{c}" for q, parts in (("Pos", "xyz"), ("Vel", "xyz"), ("Acc", "xyz"), ("Quat", "0123"),
                                                  ("Avel", "xyz"), ("Aacc", "xyz"), ("Rforce", "xyz")) for c in parts]
    table(f"adams_{name}", "exact.csv", header, rows)


def laws():
    """Laws of keywords: decks that must move alike."""
    about = """An angular body of three hexahedra tumbles on a spherical joint under gravity. """
    cells = [([0, 0, 0], "lead"), ([1, 0, 0], "second"), ([1, 1, 0], "third")]
    size, origin = [0.1, 0.08, 0.06], [0.02, -0.03, 0.01]
    for name, parts, note in (("merged.k", [2, 3, 4], "Three parts; part 4 is merged into 3 and 3 into 2."),
                              ("one_part.k", [2, 2, 2], "All three hexahedra belong to one part.")):
        k = Deck("Merging rigid bodies", about + note, 1, 1e-4, 0.01)
        k.ground(1, half=(0.01, 0.01, 0.01))
        grid = {}

        def corner(i, j, l):
            if (i, j, l) not in grid:
                grid[(i, j, l)] = k.node([o + s * c for o, s, c in zip(origin, size, (i, j, l))])
            return grid[(i, j, l)]

        for part in sorted(set(parts)):
            k.parts += ["*PART", f"part {part}", card(part, 1, 1)]
        for ((i, j, l), _), part in zip(cells, parts):
            ring = lambda h: [corner(i, j, h), corner(i + 1, j, h), corner(i + 1, j + 1, h), corner(i, j + 1, h)]
            k.solids.append((len(k.solids) + 1, part, ring(l) + ring(l + 1)))
        k.joint("spherical", 1, "support", 1, 2, [[0, 0, 0]])
        if len(set(parts)) > 1:
            k.text("*CONSTRAINED_RIGID_BODIES", "3,4", "2,3")
        k.text("$ the whole body turns about the support", "*INITIAL_VELOCITY_GENERATION",
               card(2, 2, 6, 0, 0, 0), card(0, 0, 0, 0.6, 0.0, 0.8))
        if len(set(parts)) > 1:
            for part in (3, 4):
                k.text("*INITIAL_VELOCITY_GENERATION", card(part, 2, 6, 0, 0, 0), card(0, 0, 0, 0.6, 0.0, 0.8))
        k.gravity("Z", 9.81)
        k.write(path("law_merge", name))

    k = Deck("PART_INERTIA overrides the mesh", """The mesh of the part weighs 7850 * 0.1 * 0.1 * 0.1 kg = 7.85 kg about the origin; *PART_INERTIA gives 2 kg at
(0.3, 0, 0) and Izz = 0.05 kg m2. A force of 4 N along x and a moment of 0.2 N m about z act on it:
x = 0.3 + t2, angle = 2 t2.""", 1, 1e-5, 0.01)
    k.body(1, "body", 2.0, [0.3, 0, 0], diag(0.03, 0.04, 0.05), (0.05, 0.05, 0.05), show=([0, 0, 0], GLOBAL))
    k.constant_curve()
    k.text("*LOAD_RIGID_BODY", card(1, 1, 1, 4), card(1, 7, 1, 0.2))
    k.write(path("law_part_inertia", "part_inertia.k"))

    k = Deck("Extra nodes follow their body", """A tumbling free body with two extra nodes far from its mesh: they follow it as a rigid arm does.""", 1, 1e-4, 0.01)
    k.body(1, "body", 1.0, [0, 0, 0], diag(1e-3, 2e-3, 3e-3), (0.08, 0.06, 0.03))
    k.initial(1, [1, 2, 3], [4, 3, 2])
    far = [k.node([1.5, -0.7, 0.4], 1), k.node([0.3, 0.2, -0.9], 1)]
    k.text(f"$ extra nodes {far[0]} and {far[1]}", "*DATABASE_HISTORY_NODE", card(*far))
    k.write(path("law_extra_nodes", "extra_nodes.k"))

    corners = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
    for name in ("part.k", "nodal_rigid_body.k"):
        rigid = name == "part.k"
        k = Deck("Nodal rigid body", "Eight nodes, each an eighth of a hexahedron of 0.2 x 0.12 x 0.08 m and 7850 kg/m3, tumble freely:\n"
                 + ("as a rigid part." if rigid else "as a *CONSTRAINED_NODAL_RIGID_BODY of nodes with *ELEMENT_MASS."), 1, 1e-4, 0.01)
        nodes = [k.node([0.1 * a, 0.06 * b, 0.04 * c]) for a, b, c in corners]
        if rigid:
            k.parts += ["*PART", "body", card(1, 1, 1)]
            k.solids.append((1, 1, nodes))
            k.initial(1, [1, 2, 3], [4, 3, 2])
        else:
            k.text("*SET_NODE_LIST", "1", card(*nodes), "*CONSTRAINED_NODAL_RIGID_BODY", "1,0,1", "*ELEMENT_MASS",
                   *[card(i + 1, n, 7850 * 0.2 * 0.12 * 0.08 / 8) for i, n in enumerate(nodes)])
            k.text("*INITIAL_VELOCITY_NODE", *[card(n, *add([1, 2, 3], cross([4, 3, 2], k.nodes[n - 1])), 4, 3, 2) for n in nodes])
        k.write(path("law_nodal_rigid_body", name))

    k = Deck("Signs of the inertia tensor", """A free body whose tensor has three products of inertia; IXY, IXZ, IYZ are the entries of the tensor
(not the negative integrals' opposites), so it must tumble as Euler's equations with that matrix say.""", 1, 1e-4, 0.01)
    k.body(1, "body", 1.0, [0, 0, 0], TENSOR, (0.08, 0.06, 0.03))
    k.initial(1, [0, 0, 0], [1, 2, 8])
    k.write(path("law_tensor_signs", "tensor.k"))


SKEW = [unit([2, 1, 2]), unit([-1, 2, 0]), cross(unit([2, 1, 2]), unit([-1, 2, 0]))]


def free_flight():
    """Pairs of bodies on each kind of joint: free.k (nothing but the joints acts) and grounded.k."""
    tensor = [[0.02, 0.003, -0.004], [0.003, 0.025, 0.002], [-0.004, 0.002, 0.03]]
    for kind in ("spherical", "revolute", "cylindrical", "planar", "universal", "translational", "locking"):
        def points(o, f, along):
            """Joint points at o, with axis f[0]; `along` shifts a parallel joint where that keeps it the same joint."""
            o = add(o, scale(along, f[1] if kind == "planar" else f[0])) if kind not in ("spherical", "universal") else o
            axis, side = add(o, scale(0.1, f[0])), add(o, scale(0.1, f[1]))
            return {"spherical": [o], "universal": [o, (axis, side)], "translational": [o, axis, side],
                    "locking": [o, axis, side]}.get(kind, [o, axis])

        def pair(k, a, at, f, ratio=1.0, grounded=False, twice=False):
            b = 1 if grounded else a + 1
            center = add(at, add(scale(-0.2, f[0]), scale(0.15, f[2])))
            k.body(a, f"body {a}", 1.0, center, tensor, (0.15, 0.1, 0.05))
            k.initial(a, [0.3, -0.2, 0.1] if grounded else [1, 0.5, -0.4], [1, -2, 1.5])
            if not grounded:
                k.body(b, f"body {b}", ratio, add(at, add(scale(0.25, f[0]), scale(-0.1, f[1]))),
                       [scale(ratio, row) for row in tensor], (0.15, 0.06, 0.1))
                k.initial(b, [-1, 0.8, 0.2], [-2, 1, 2.5])
            number = len([line for line in k.joints if line.startswith("*")])
            for n in range(2 if twice else 1):
                k.joint(kind, number + n + 1, f"{kind} {a} - {b}", a, b, points(at, f, 0.05 * n))

        k = Deck(f"Free flight, {kind} joint", f"""Four pairs of bodies, each held together by a {kind} joint, fly freely: no load, no gravity.
Parts 11-12 with the joint's axis along x, 21-22 with a skew axis, 31-32 with two such joints in parallel (redundant),
41-42 with a mass ratio of 1e6. The bodies start with velocities that contradict the joints.""", 1, 1e-4, 0.01)
        for a, f, options in ((11, GLOBAL, {}), (21, SKEW, {}), (31, SKEW, {"twice": True}), (41, SKEW, {"ratio": 1e6})):
            pair(k, a, FREE_AT[a], f, **options)
        k.write(path(f"free_flight_{kind}", "free.k"))
        k = Deck(f"Grounded, {kind} joint", f"""Two bodies, each on a {kind} joint of ground, without load: part 11 with the joint's axis along x, part 21 skew.""",
                 1, 1e-4, 0.01)
        k.ground(1)
        for a, f in ((11, GLOBAL), (21, SKEW)):
            pair(k, a, FREE_AT[a], f, grounded=True)
        k.write(path(f"free_flight_{kind}", "grounded.k"))


FREE_AT = {11: [0.1, 0.2, 0.3], 21: [0.1, 2.2, 0.3], 31: [0.1, 4.2, 0.3], 41: [0.1, 6.2, 0.3]}


def solve3(m, b):
    """Cramer's rule."""
    det = lambda a: dot(a[0], cross(a[1], a[2]))
    d = det(m)
    return [det([[b[r] if c == i else m[r][c] for c in range(3)] for r in range(3)]) / d for i in range(3)]


def tensor_oracle():
    """Euler's equations with TENSOR from (1, 2, 8) rad/s, body axes; Runge-Kutta of order 4, 0.1 ms."""
    product = lambda w: [dot(row, w) for row in TENSOR]
    f = lambda w: solve3(TENSOR, scale(-1, cross(w, product(w))))
    w, rows = [1.0, 2.0, 8.0], []
    for i in range(101):
        rows.append([num(round(i * 0.01, 10))] + [num(c) for c in w])
        for _ in range(100):
            w = rk4(f, w, 1e-4)
    table("law_tensor_signs", "euler.csv", ["t", "wx", "wy", "wz"], rows)


def main():
    slider_crank()
    a01()
    print("B0:", a02(2), a02(40))
    tops()
    cardan()
    guided()
    double_pendulum()
    stops()
    chain(10)
    chain(100)
    adams()
    laws()
    free_flight()
    tensor_oracle()
    if len(sys.argv) > 1:
        with open(os.path.join(sys.argv[1], "verification", "b_iftomm.json")) as f:
            a03(json.load(f)["A03"])
        oracles(sys.argv[1])


main()
