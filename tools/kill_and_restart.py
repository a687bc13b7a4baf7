#!/usr/bin/env python3
"""Kills a run at random moments and restarts it each time with another number of threads; then compares it with an unbroken one.

  tools/kill_and_restart.py [--kills N] [--seed S] [--checkpoint WORD] [--program kardan] [--threads 1,2,…] DECK [options of kardan run]

Everything must be equal to the last byte: every result file and the state hash. Exit code 0 if it is. The folder of a comparison that
fails is kept.
"""
import argparse
import filecmp
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time


def results_of(folder):
    """Result files: all but the log, the summary and the restart files, which have wall-clock times in them."""
    return sorted(n for n in os.listdir(folder)
                  if n not in ("kardan.log", "summary.json") and not n.startswith("checkpoint-"))


def run(command):
    start = time.monotonic()
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout, time.monotonic() - start


def killed_run(options, folder, seconds, choose):
    """Returns the numbers of kills that came in time and of restarts."""
    kills = restarts = 0
    first = [options.program, "run", options.deck, *options.rest, "-o", folder, "--checkpoint", options.checkpoint]
    again = [options.program, "run", "--restart", folder]
    threads = options.threads.split(",")
    command = first
    while True:
        if kills >= options.kills:
            code, out, _ = run(command + ["-j", choose.choice(threads)])
            return kills, restarts, code, out
        child = subprocess.Popen(command + ["-j", choose.choice(threads)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            child.wait(timeout=choose.uniform(0, 1.5 * seconds / (options.kills + 1)))
        except subprocess.TimeoutExpired:
            child.send_signal(signal.SIGKILL)
            child.wait()
            kills += 1
        else:
            if os.path.exists(os.path.join(folder, "summary.json")) or child.returncode != 2:
                return kills, restarts, child.returncode, ""
        has_checkpoint = os.path.isdir(folder) and any(n.startswith("checkpoint-") and not n.endswith(".tmp") for n in os.listdir(folder))
        restarts += has_checkpoint
        command = again if has_checkpoint else first


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--checkpoint", default="every=0.05")
    parser.add_argument("--program", default="build/release/bin/kardan")
    parser.add_argument("--threads", default="1,2,3")
    parser.add_argument("deck")
    options, options.rest = parser.parse_known_args()
    choose = random.Random(options.seed)
    folder = tempfile.mkdtemp(prefix="kardan_kill_")
    whole, broken = os.path.join(folder, "whole"), os.path.join(folder, "broken")
    code, out, seconds = run([options.program, "run", options.deck, *options.rest, "-o", whole])
    if code == 2:
        sys.exit(f"{options.deck}: {out}")
    kills, restarts, code_of_broken, out = killed_run(options, broken, seconds, choose)
    faults = [] if code == code_of_broken else [f"exit code {code_of_broken}, not {code}: {out[-500:]}"]
    names = results_of(whole)
    if names != results_of(broken):
        faults.append(f"files {results_of(broken)}, not {names}")
    else:
        faults += [f"{n} differs" for n in names if not filecmp.cmp(os.path.join(whole, n), os.path.join(broken, n), shallow=False)]
    try:
        hashes = [json.load(open(os.path.join(f, "summary.json")))["state_hash"] for f in (whole, broken)]
        if hashes[0] != hashes[1]:
            faults.append("the state hashes differ")
    except OSError as error:
        faults.append(str(error))
    print(f"{'FAILED' if faults else 'equal'}: {options.deck} {' '.join(options.rest)}: {kills} kills, {restarts} restarts, {len(names)} result files, "
          f"{seconds:.2f} s unbroken{'; kept in ' + folder if faults else ''}")
    for fault in faults:
        print("  " + fault)
    if not faults:
        shutil.rmtree(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
