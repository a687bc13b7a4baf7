#!/usr/bin/env python3
"""Runs the car of the corpus against a pole for the designs of 30 LS-DYNA runs and compares what comes out.

    car_study.py KARDAN DECKS [--runs N] [--keep FOLDER] [--figure FILE.png] [--csv FILE] [-- more options of kardan run]

The figure needs python3-matplotlib.

DECKS is the folder of main_v223.k (repository dbrizard/GSA-car-crash, GPL-3.0); verification/car/lsdyna_runs.csv holds LS-DYNA R10.1's results
(single precision, smp): fmax, the peak x force of the pole; dmax, the x displacement of node 605 at the end; vfin, the x velocity of part 1 at
the end; IE, the internal energy at the end. Exit code 1 where a limit is not kept.
"""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "tests" / "io" / "python"))
from lsda_reader import Lsda  # noqa: E402

PARAMETERS = {"tbumper_mm": "tbumper", "trailb_mm": "trailb", "trailf_mm": "trailf", "yrailf_MPa": "yrailf"}
NAMES = ["dmax_mm", "IE_Nmm", "fmax_N", "vfin_mm_s"]
LABELS = {"dmax_mm": "displacement of node 605 at the end, mm", "IE_Nmm": "internal energy at the end, N mm",
          "fmax_N": "peak force on the pole, N", "vfin_mm_s": "velocity of the body at the end, mm/s"}
LIMITS = {"dmax_mm": 0.03, "IE_Nmm": 0.015, "fmax_N": 0.12, "vfin_mm_s": 0.08}  # mean difference; half of it for the mean signed one
IMPACT_SPEED = 8333.0
LEAST_RANK_CORRELATION = 0.97


def write_deck(decks, design, path):
    text = (decks / "main_v223.k").read_text(encoding="latin-1")
    values = {"tbumper": 3, "trailb": 2, "trailf": 5, "yrailb": 400, "tgrill": 1, "thood": 1, "ybumper": 400, "yrailf": 400, "ybody": 400}
    values.update({name: design[column] for column, name in PARAMETERS.items()})
    lines = "".join(f"r{name:>9}{value:10}\n" for name, value in values.items())
    text = re.sub(r"\*PARAMETER\n.*?(?=\*INCLUDE)", "*PARAMETER\n" + lines, text, flags=re.S)
    path.write_text(text.replace("car6_crash_v223.k", str((decks / "car6_crash_v223.k").resolve())), encoding="latin-1")


def results(folder):
    out = Lsda(folder / "binout0000")

    def history(branch, name, column):
        return [out.read(f"{branch}/{state}/{name}")[column] for state in out.folders(branch) if state != "metadata"]

    walls = out.read("/rwforc/forces/metadata/ids")
    nodes = out.read("/nodout/metadata/ids")
    parts = out.read("/matsum/metadata/ids")
    # The deck calls the wall 2; its force is what the nodes exert on it.
    return {"fmax_N": max(abs(f) for f in history("/rwforc/forces", "x_force", walls.index(2))),
            "dmax_mm": history("/nodout", "x_displacement", nodes.index(605))[-1],
            "vfin_mm_s": history("/matsum", "x_rbvelocity", parts.index(1))[-1],
            "IE_Nmm": history("/glstat", "internal_energy", 0)[-1]}


def run(kardan, decks, design, folder, options):
    folder.mkdir(parents=True, exist_ok=True)
    write_deck(decks, design, folder / "main.k")
    command = [kardan, "run", str(folder / "main.k"), "-o", str(folder / "out"), *options]
    with open(folder / "log", "w", encoding="utf-8") as log:
        code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
    if code != 0:
        sys.exit(f"{' '.join(command)} ended with {code}; see {folder / 'log'}")
    return results(folder / "out")


def difference(name, ours, theirs):
    scale = IMPACT_SPEED if name == "vfin_mm_s" else abs(theirs)
    return (ours - theirs) / scale


def ranks(values):
    order = sorted(range(len(values)), key=lambda i: values[i])
    rank = [0] * len(values)
    for r, i in enumerate(order):
        rank[i] = r
    return rank


def rank_correlation(a, b):
    n = len(a)
    return 1 - 6 * sum((x - y) ** 2 for x, y in zip(ranks(a), ranks(b))) / (n * (n * n - 1))


def compare(rows):
    """Prints the table; returns whether all limits are kept."""
    kept = True
    print(f"{'':10}{'mean |difference|':>20}{'limit':>9}{'mean difference':>18}{'limit':>9}{'largest':>10}{'rank correlation':>18}")
    for name in NAMES:
        d = [difference(name, ours[name], theirs[name]) for ours, theirs in rows]
        mean, bias, worst = sum(map(abs, d)) / len(d), sum(d) / len(d), max(d, key=abs)
        rank = rank_correlation([o[name] for o, _ in rows], [t[name] for _, t in rows]) if len(rows) > 2 else 1.0
        good = mean <= LIMITS[name] and abs(bias) <= LIMITS[name] / 2 and (name != "dmax_mm" or rank >= LEAST_RANK_CORRELATION)
        kept = kept and good
        print(f"{name:10}{mean:>19.2%} {LIMITS[name]:>8.1%}{bias:>18.2%}{LIMITS[name] / 2:>9.2%}{worst:>10.2%}{rank:>18.4f}{'' if good else '  not kept'}")
    return kept


def draw(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 2, figsize=(9, 8))
    for axis, name in zip(axes.flat, NAMES):
        x, y = [t[name] for _, t in rows], [o[name] for o, _ in rows]
        low, high = min(x + y), max(x + y)
        axis.plot([low, high], [low, high], color="0.6", linewidth=1)
        axis.scatter(x, y, s=18, color="#1f5fa8")
        axis.set_title(LABELS[name], fontsize=10)
        axis.set_xlabel("LS-DYNA R10.1")
        axis.set_ylabel("Kardan")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kardan")
    parser.add_argument("decks", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=30, help="only the first N designs")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the runs; else a temporary one")
    parser.add_argument("--figure", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("options", nargs="*", help="more options of kardan run")
    a = parser.parse_args()
    with open(HERE.parent / "car" / "lsdyna_runs.csv", encoding="utf-8") as file:
        designs = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)][:a.runs]
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(a.jobs) as pool:
        folder = a.keep or pathlib.Path(scratch)
        ours = list(pool.map(lambda item: run(a.kardan, a.decks, item[1], folder / f"run{item[0]:02}", ["-j", "1", *a.options]), enumerate(designs)))
    rows = list(zip(ours, designs))
    compare_and_write(a, rows)


def compare_and_write(a, rows):
    kept = compare(rows)
    if a.csv:
        with open(a.csv, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow([*PARAMETERS, *(f"{side}_{name}" for name in NAMES for side in ("kardan", "lsdyna"))])
            for o, t in rows:
                writer.writerow([t[p] for p in PARAMETERS] + [f"{v[name]:.6g}" for name in NAMES for v in (o, t)])
    if a.figure:
        draw(rows, a.figure)
    sys.exit(0 if kept else 1)


if __name__ == "__main__":
    main()
