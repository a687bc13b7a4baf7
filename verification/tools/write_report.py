#!/usr/bin/env python3
"""Writes docs/verification.md: runs `kardan verify --markdown` and puts the figures below the text of report_head.md.

usage: write_report.py KARDAN [--quick] > docs/verification.md     KARDAN: the program; --quick leaves the long runs out
"""
import datetime
import os
import platform
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def machine():
    """Class of the machine: processor and number of cores, no names."""
    model = platform.machine()
    try:
        with open("/proc/cpuinfo") as f:
            model = next(line.split(":")[1].strip() for line in f if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{model}, {os.cpu_count()} cores"


def main():
    program = sys.argv[1]
    groups = ["deformable", "mechanisms"] if "--quick" in sys.argv else ["deformable", "deformable-long", "mechanisms", "mechanisms-long"]
    with open(os.path.join(HERE, "report_head.md")) as f:
        print(f.read().rstrip())
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip().split("\n")[0]
    print(f"\n## Figures\n\n{datetime.date.today().isoformat()}, {version}, {machine()}.")
    for group in groups:
        done = subprocess.run([program, "verify", "--markdown", group], capture_output=True, text=True)
        print(done.stdout.rstrip())
        print(done.stderr.strip(), file=sys.stderr)


main()
