#!/usr/bin/env python3
"""Writes docs/verification.md: runs `kardan verify --markdown` and puts the figures below the text of report_head.md.

usage: write_report.py KARDAN [GROUP …] > new.md     KARDAN: the program; GROUP: run these only (contact, contact-long, deformable, deformable-long,
                                                     mechanisms, mechanisms-long) and keep what docs/verification.md says of the others
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


def main():
    program, wanted = sys.argv[1], sys.argv[2:] or GROUPS
    old = kept()
    with open(os.path.join(HERE, "report_head.md")) as f:
        print(f.read().rstrip())
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip().split("\n")[0]
    for group in GROUPS:
        print(f"\n## Figures: {group}\n")
        if group not in wanted:
            print(old[group])
            continue
        print(f"{datetime.date.today().isoformat()}, {version}, {machine()}.")
        done = subprocess.run([program, "verify", "--markdown", group], capture_output=True, text=True)
        print(done.stdout.rstrip())
        print(done.stderr.strip(), file=sys.stderr)


main()
