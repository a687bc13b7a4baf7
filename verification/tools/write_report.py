#!/usr/bin/env python3
"""Writes docs/verification.md: runs `kardan verify --markdown` and puts the figures below the text of report_head.md.

usage: write_report.py KARDAN [GROUP|CASE …] > new.md     KARDAN: the program; GROUP: run these only (contact, contact-long, deformable, deformable-long,
                                                          mechanisms, mechanisms-long), CASE: likewise (hertz, hertz-long), and keep what
                                                          docs/verification.md says of the others
"""
import datetime
import os
import platform
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
GROUPS = ["contact", "contact-long", "deformable", "deformable-long", "mechanisms", "mechanisms-long"]


def machine():
    """Class of the machine: processor and number of cores, no names."""
    model = platform.machine()
    try:
        with open("/proc/cpuinfo") as f:
            model = next(line.split(":")[1].strip() for line in f if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{model}, {os.cpu_count()} cores"


def kept():
    """The sections of docs/verification.md by group."""
    with open(os.path.join(HERE, "../../docs/verification.md")) as f:
        parts = re.split(r"^## Figures: (\S+)$", f.read(), flags=re.M)
    return {group: text.strip() for group, text in zip(parts[1::2], parts[2::2])}


def figures(program, name):
    """What `kardan verify --markdown` says of a group or a case."""
    done = subprocess.run([program, "verify", "--markdown", name], capture_output=True, text=True)
    print(done.stderr.strip(), file=sys.stderr)
    return done.stdout.strip()


def with_case(section, case, stamp):
    """The text of a group in which that of one case is new, with a stamp of its own; cases stand in the order of their names."""
    start, *cases = re.split(r"^(?=### )", section, flags=re.M)
    heading = case.split(":")[0] + ":"
    cases = [c for c in cases if not c.startswith(heading)] + [re.sub(r"\n", f"\n\n{stamp}\n", case, count=1)]
    return "\n\n".join(part.strip() for part in [start, *sorted(cases)])


def main():
    program, wanted = sys.argv[1], sys.argv[2:] or GROUPS
    old = kept()
    with open(os.path.join(HERE, "report_head.md")) as f:
        print(f.read().rstrip())
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip().split("\n")[0]
    stamp = f"{datetime.date.today().isoformat()}, {version}, {machine()}."
    listed = subprocess.run([program, "verify", "--list"], capture_output=True, text=True).stdout.splitlines()
    group_of = {line.split()[1]: line.split()[0] for line in listed}
    for name in wanted:
        if name in GROUPS:
            old[name] = stamp + "\n\n" + figures(program, name)
        else:
            group = group_of[name.removesuffix("-long")] + ("-long" if name.endswith("-long") else "")
            old[group] = with_case(old[group], figures(program, name), stamp)
    for group in GROUPS:
        print(f"\n## Figures: {group}\n\n{old[group]}")


main()
