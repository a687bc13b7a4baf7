"""Compares the time histories of a run: binout with given numbers, and every ASCII file with binout, field by field.

usage: check_histories.py DIRECTORY EXPECTED.json

EXPECTED.json: {"states": n, "numbers": {"/folder/dNNNNNN/name": [values, exact], ...}, "texts": {path: text}}
"""
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from lsda_reader import Lsda  # noqa: E402

compared = 0


def fail(message):
    print("FAILED:", message)
    sys.exit(1)


def same(field, value, form, where):
    """The text of a fixed-width field must be the value in that format."""
    global compared
    compared += 1
    if field != form % value:
        fail(f"{where}: '{field}' in ASCII, {value!r} in binout")


class Cursor:
    """Lines of an ASCII file, read in order."""

    def __init__(self, path):
        self.path, self.lines, self.at = path, path.read_text().split("\n"), 0

    def find(self, pattern):
        while self.at < len(self.lines):
            hit = re.search(pattern, self.lines[self.at])
            self.at += 1
            if hit:
                return hit
        fail(f"{self.path}: no line like '{pattern}'")

    def next(self):
        self.at += 1
        return self.lines[self.at - 1]


def labelled(cursor, label, value, form="%14.5E"):
    line = cursor.next()
    if not line.startswith(label):
        fail(f"{cursor.path}: '{line}' where '{label}' was expected")
    width = len(form % 0)
    same(line[len(label):len(label) + width], value, form, label)


def dotted(text):
    return " " + text.ljust(29, ".")


def row(line, start, values, where):
    for k, value in enumerate(values):
        same(line[start + 12 * k:start + 12 * (k + 1)], value, "%12.4E", where)


def glstat(binout, cursor, states):
    labels = {"time": "time", "time_step": "time step", "kinetic_energy": "kinetic energy",
              "internal_energy": "internal energy", "external_work": "external work",
              "joint_internal_energy": "joint internal energy", "total_energy": "total energy",
              "energy_ratio": "total energy / initial energy", "global_x_velocity": "global x velocity"}
    for s in states:
        at = cursor.at
        cursor.find("dt of cycle")
        start = cursor.at
        for name, label in labels.items():
            cursor.at = start
            line = cursor.find("^ " + re.escape(label) + r" ?\.+").string
            same(line[32:46], binout.read(f"/glstat/{s}/{name}")[0], "%14.5E", label)
        cursor.at = max(start, at)


def matsum(binout, cursor, states):
    ids = binout.read("/matsum/metadata/ids")
    for s in states:
        get = lambda name: binout.read(f"/matsum/{s}/{name}")  # noqa: E731
        cursor.find("^ time =")
        for i, part in enumerate(ids):
            line = cursor.next()
            same(line[7:12], part, "%5d", "part")
            same(line[31:44], get("internal_energy")[i], "%13.4E", "inten")
            same(line[55:68], get("kinetic_energy")[i], "%13.4E", "kinen")
            for names in (("x_momentum", "y_momentum", "z_momentum"), ("x_rbvelocity", "y_rbvelocity", "z_rbvelocity")):
                line = cursor.next()
                for k, name in enumerate(names):
                    same(line[7 + 24 * k:20 + 24 * k], get(name)[i], "%13.4E", name)
            same(cursor.next()[-13:], get("mass")[i], "%13.4E", "mass")


def nodout(binout, cursor, states):
    blocks = (["x_displacement", "y_displacement", "z_displacement", "x_velocity", "y_velocity", "z_velocity",
               "x_acceleration", "y_acceleration", "z_acceleration", "x_coordinate", "y_coordinate", "z_coordinate"],
              ["rx_displacement", "ry_displacement", "rz_displacement", "rx_velocity", "ry_velocity", "rz_velocity",
               "rx_acceleration", "ry_acceleration", "rz_acceleration"])
    ids = binout.read("/nodout/metadata/ids")
    for s in states:
        for names in blocks:
            hit = cursor.find(r"^ n o d a l   p r i n t   o u t .*\( at time(.{12}) \)")
            same(hit.group(1), binout.read(f"/nodout/{s}/time")[0], "%12.5E", "time")
            cursor.find("^ nodal point")
            for i, node in enumerate(ids):
                line = cursor.next()
                same(line[:9], node, "%9d", "node")
                row(line, 10, [binout.read(f"/nodout/{s}/{name}")[i] for name in names], f"node {node}")


def rbdout(binout, cursor, states):
    ids = binout.read("/rbdout/metadata/ids")
    nodal = binout.read("/rbdout/metadata/num_nodal")[0]
    axes = lambda f, k: [f"{f}{a}" for a in k]  # noqa: E731
    for s in states:
        cursor.find(r"^  r i g i d   b o d y   m o t i o n   a t  cycle=\s*(\d)+\s+time=")
        for i, body in enumerate(ids):
            hit = cursor.find(r"^ (nodal )?rigid body(.{8})$")
            same(hit.group(2), body, "%8d", "body")
            if bool(hit.group(1)) != (i >= len(ids) - nodal):
                fail(f"body {body}: nodal or not?")
            for frame in ("global_", "local_"):
                if frame == "global_":
                    row(cursor.find("^   coordinates:").string, 17,
                        [binout.read(f"/rbdout/{s}/global_{c}")[i] for c in "xyz"], "coordinates")
                for label, name in ((" displacements:", "d"), ("    velocities:", "v"), (" accelerations:", "a")):
                    names = axes(frame + name, "xyz") + axes(frame + "r" + name, "xyz")
                    row(cursor.find("^" + label).string, 17, [binout.read(f"/rbdout/{s}/{n}")[i] for n in names], label)
                if frame == "global_":
                    for r in "123":
                        line = cursor.find(f"^     row {r}").string
                        for k in range(3):
                            same(line[10 + 15 * k:25 + 15 * k], binout.read(f"/rbdout/{s}/dircos_{r}{k + 1}")[i], "%15.4E", "row")


def jntforc(binout, cursor, states):
    plain = {"x-force": "x_force", "y-force": "y_force", "z-force": "z_force", "x-moment": "x_moment",
             "y-moment": "y_moment", "z-moment": "z_moment"}
    stiff = {"type0": ["phi (degrees)|phi_degrees", "d(phi)/dt (degrees)|d(phi)_dt", "theta (degrees)|theta_degrees",
                       "d(theta)/dt (degrees)|d(theta)_dt", "psi (degrees)|psi_degrees",
                       "d(psi)/dt (degrees)|d(psi)_dt", "phi moment-stiffness|phi_moment_stiffness",
                       "phi moment-damping|phi_moment_damping", "phi moment-total|phi_moment_total"],
             "type1": ["alpha (degrees)|alpha_degrees", "d(alpha)/dt (degrees)|d(alpha)_dt",
                       "gamma (degrees)|gamma_degrees"],
             "type2": ["x-displacement|x_displacement", "d(dispx)/dt|d(dispx)_dt"]}
    for s in states:
        labelled(cursor_at(cursor, "^ time\\."), dotted("time"),
                 binout.read(f"/jntforc/joints/{s}/time")[0])
        local = binout.read("/jntforc/joints/metadata/local")
        for i, joint in enumerate(binout.read("/jntforc/joints/metadata/ids")):
            labelled(cursor, dotted("joint ID"), joint, "%10d")
            for label, name in plain.items():
                text = label.ljust(9) + "(local) " if local[i] else label
                labelled(cursor, dotted(text), binout.read(f"/jntforc/joints/{s}/{name}")[i])
            for label in ("resultant force", "resultant moment", "energy"):
                labelled(cursor, dotted(label), binout.read(f"/jntforc/joints/{s}/{label.replace(' ', '_')}")[i])
        for kind, pairs in stiff.items():
            for i, stiffness in enumerate(binout.read(f"/jntforc/{kind}/metadata/ids")):
                cursor_at(cursor, "^ joint stiffness id")
                labelled(cursor, dotted("joint stiffness id number"), stiffness, "%10d")
                for pair in pairs:
                    label, name = pair.split("|")
                    labelled(cursor, dotted(label), binout.read(f"/jntforc/{kind}/{s}/{name}")[i])


def cursor_at(cursor, pattern):
    """Places the cursor on the next line like `pattern`."""
    cursor.find(pattern)
    cursor.at -= 1
    return cursor


def jntsep(binout, cursor, states):
    for s in states:
        cursor.find("joint ID      separation")
        for i, joint in enumerate(binout.read("/jntforc/joints/metadata/ids")):
            line = cursor.next()
            same(line[:10], joint, "%10d", "joint")
            same(line[12:26], binout.read(f"/jntforc/joints/{s}/separation")[i], "%14.5E", "separation")


def bndout(binout, cursor, states):
    for s in states:
        cursor.find("n o d a l   f o r c e/e n e r g y    o u t p u t   t=")
        for kind, tag in (("nodes", " nd#"), ("rigidbodies", "mat#")):
            folder = f"/bndout/velocity/{kind}"
            for i, entity in enumerate(binout.read(folder + "/metadata/ids")):
                line = cursor.find("^" + tag).string
                same(line[4:12], entity, "%8d", tag)
                for name, key in (("x_force", "xforce="), ("y_force", "yforce="), ("z_force", "zforce="), ("energy", "energy=")):
                    at = line.index(key) + len(key)
                    same(line[at:at + 13], binout.read(f"{folder}/{s}/{name}")[i], "%13.4E", name)


def spcforc(binout, cursor, states):
    for s in states:
        hit = cursor.find("^ output at time =(.{14})")
        same(hit.group(1), binout.read(f"/spcforc/{s}/time")[0], "%14.5E", "time")
        for i, node in enumerate(binout.read("/spcforc/metadata/force_ids")):
            for what, names in (("forces =", "force"), ("moments=", "moment")):
                line = cursor.find(f"^ node=.* local x,y,z {what}").string
                same(line[6:14], node, "%8d", "node")
                for k, axis in enumerate("xyz"):
                    same(line[35 + 14 * k:49 + 14 * k], binout.read(f"/spcforc/{s}/{axis}_{names}")[i], "%14.4E", names)


def deforc(binout, cursor, states):
    for s in states:
        labelled(cursor_at(cursor, "^ time\\."), dotted("time"), binout.read(f"/deforc/{s}/time")[0])
        for i, element in enumerate(binout.read("/deforc/metadata/ids")):
            labelled(cursor, dotted("spring/damper number"), element, "%10d")
            for label, name in (("x-force", "x_force"), ("y-force", "y_force"), ("z-force", "z_force"),
                                ("resultant force", "resultant_force"), ("change in length", "displacement")):
                labelled(cursor, dotted(label), binout.read(f"/deforc/{s}/{name}")[i])


def main(directory, expected):
    binout = Lsda(directory / "binout0000")
    for path, values in expected["numbers"].items():
        if binout.read(path) != values:
            fail(f"{path}: {binout.read(path)} instead of {values}")
    for path, text in expected["texts"].items():
        if binout.read(path).rstrip() != text:
            fail(f"{path}: '{binout.read(path)}' instead of '{text}'")
    states = [f"d{k + 1:06d}" for k in range(expected["states"])]
    for check in (glstat, matsum, nodout, rbdout, jntforc, jntsep, bndout, spcforc, deforc):
        cursor = Cursor(directory / check.__name__)
        check(binout, cursor, states)
    print(f"{compared} fields compared, {binout.tables} symbol tables")


if __name__ == "__main__":
    with open(sys.argv[2]) as file:
        main(Path(sys.argv[1]), json.load(file))
