#!/usr/bin/env python3
"""Rewrites the last part of src/kardan/io/deck/schema/keywords.tsv: the keywords that Kardan only knows by name.

usage: known_keywords.py CARDS_TSV

CARDS_TSV lists LS-DYNA's keywords with their cards, as taken from pydyna (MIT licence): keyword, card, fields per line.
The first part of the table, up to the marker, is written by hand and stays; every keyword of CARDS_TSV that no row of it
covers, alone or with its options, becomes a row by the first rule below that fits.
"""
import pathlib
import re
import sys

TABLE = pathlib.Path(__file__).resolve().parent.parent / "src/kardan/io/deck/schema/keywords.tsv"
MARKER = "# Known by name only; rewritten by tools/known_keywords.py"
RULES = [
    (r"CONTACT_FORCE_TRANSDUCER|RIGIDWALL_FORCE_TRANSDUCER", "not_needed", "measures contact forces, acts on nothing"),
    (r"CONTACT_", "stops", "contact is not built yet: parts would pass through each other; --without contact leaves it out at your own risk"),
    (r"RIGIDWALL_", "stops", "rigid walls that deform are not built: parts would pass through them; --without contact leaves them out at your own risk"),
    (r"DATABASE_", "not_needed", "output only"),
    (r"CONTROL_(ACCURACY|SOLID$|MPP|PARALLEL|CPU|CHECK|LSDA|REQUIRE|START|SUBCYCLE$|OUTPUT|UNITS|DEBUG)", "not_needed",
     "tuning or output of another solver"),
    (r"CONTROL_(CONTACT|AIRBAG|CPM|ALE|SPH|EFG|DISCRETE_ELEMENT|ADAPSTEP)", "not_needed", "acts only with features that stop a run themselves"),
    (r"CONTROL_IMPLICIT_(DYNAMIC|SOLUTION|SOLVER|AUTO|STABILI|NONLINEAR|TERMINATION|ORDERING|JOINTS|FORMING|CONSISTENT)", "not_needed",
     "acts only with *CONTROL_IMPLICIT_GENERAL"),
    (r"CONTROL_(THERMAL|IMPLICIT|FREQ|ACOUSTIC|VIBRO)", "stops", "another kind of analysis (implicit, thermal, acoustic); Kardan is explicit and mechanical"),
    (r"CONTROL_FORMING|INTERFACE_(BLANK|COMPENS|WELD|THICK)", "stops", "a sheet-forming tool of another solver"),
    (r"INTERFACE_(SPRINGBACK|COMPONENT|ENSIGHT)", "not_needed", "output only"),
    (r"CASE", "stops", "several runs in one deck; make one deck a run"),
    (r"DEFORMABLE_TO_RIGID|RIGID_DEFORMABLE", "stops", "switching parts between deformable and rigid is not built yet"),
    (r"MAT_", "stops", "this material is not built; the part would have no stiffness"),
    (r"EOS_", "stops", "equations of state are not built"),
    (r"SECTION_|ELEMENT_|PART_", "stops", "this kind of element or part is not built; it would be missing from the model"),
    (r"INCLUDE_", "stops", "this way of including is not built; the file would be missing"),
    (r"BOUNDARY_|CONSTRAINED_|INITIAL_|LOAD_|DAMPING_", "stops", "not built; this condition would be missing from the model"),
    (r"DEFINE_CONTACT_VOLUME", "not_needed", "acts only in contacts"),
    (r"SENSOR_(DEFINE|SWITCH)", "not_needed", "acts only through *SENSOR_CONTROL"),
    (r"SET_|DEFINE_|NODE_", "stops", "not built; what refers to it would be wrong"),
    (r"SENSOR_", "stops", "sensors are not built; what they switch would be wrong"),
    (r"PARAMETER_", "stops", "this kind of parameter is not built"),
    (r"", "stops", "not built; leaving it out would change the physics"),
]


def covered(name, rows):
    """Whether a row of the hand-written part, with its options, is this keyword."""
    for known, options in rows.items():
        rest = name[len(known):]
        if not name.startswith(known) or (rest and rest[0] != "_"):
            continue
        while rest:
            fits = [o for o in options + ["TITLE", "ID"] if rest == "_" + o or rest.startswith("_" + o + "_")]
            if not fits:
                break
            rest = rest[len(max(fits, key=len)) + 1:]
        if not rest:
            return True
    return False


def main():
    head = TABLE.read_text(encoding="utf-8").split(MARKER)[0].rstrip("\n")
    rows = {}
    for line in head.split("\n"):
        if line and line[0] not in "#\t":
            names, _, options = line.split("\t")[:3]
            rows.update({name: options.split() for name in names.split("=")})
    with open(sys.argv[1], encoding="utf-8") as file:
        names = sorted({line.split("\t")[0] for line in file})
    tail = []
    for name in names:
        if re.fullmatch(r"[A-Z][A-Z0-9_-]+", name) and not covered(name, rows):
            _, status, note = next(rule for rule in RULES if re.match(rule[0], name))
            tail.append(f"{name}\t{status}\t\t{note}")
    TABLE.write_text(f"{head}\n\n{MARKER}\n" + "\n".join(tail) + "\n", encoding="utf-8")


main()
