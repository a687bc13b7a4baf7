#!/usr/bin/python3
"""The house rules a machine can check.

  check_house.py includes ROOT   every #include "kardan/…" against the table of floors; no cycle between files
  check_house.py lengths ROOT    no source file longer than MAX_LINES
  check_house.py self-test       the checks themselves, on made-up trees that break each rule

Exit code 1 and one line a fault where a rule is broken.
"""
import pathlib
import re
import sys
import tempfile

# A folder of src/kardan may include itself and what stands here. docs/architecture.md shows the same table.
FLOORS = {
    "base": set(),
    "model": {"base"},
    "state": {"base", "model"},
    "materials": {"base", "model"},
    "parallel": {"base", "model"},
    "elements": {"base", "model", "state", "materials", "parallel"},
    "rigid": {"base", "model", "state", "parallel"},
    "contact": {"base", "model", "state", "parallel"},
    "loads": {"base", "model", "state"},
    "solver": {"base", "model", "state", "materials", "parallel", "elements", "rigid", "contact", "loads"},
    "io": {"base", "model", "state", "parallel"},
}
FLOORS["app"] = set(FLOORS)

MAX_LINES = 650
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]', re.M)


def sources(root, *folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".h", ".cu"):
                yield path


def check_includes(root):
    """Faults of the include graph of root/src/kardan."""
    faults, graph = [], {}
    top = root / "src"
    for path in sources(root, "src/kardan"):
        name = path.relative_to(top).as_posix()
        floor = name.split("/")[1]
        if floor not in FLOORS:
            faults.append(f"{name}: folder {floor} is not in the table of floors")
            continue
        graph[name] = []
        for bracket, target in INCLUDE.findall(path.read_text(encoding="utf-8")):
            if bracket == '"' and not target.startswith("kardan/"):
                if target != "kardan_build_info.hpp":
                    faults.append(f'{name}: "{target}" must be written "kardan/<floor>/…"')
                continue
            if not target.startswith("kardan/"):
                continue
            graph[name].append(target)
            below = target.split("/")[1]
            if below != floor and below not in FLOORS[floor]:
                faults.append(f"{name}: {floor} may not include {target}")
            if not (top / target).is_file():
                faults.append(f"{name}: {target} does not exist")
    return faults + [" -> ".join(cycle) + ": a cycle" for cycle in cycles(graph)]


def cycles(graph):
    """The first cycle found from each file that lies on one."""
    found, done = [], set()

    def visit(node, path):
        if node in path:
            found.append(path[path.index(node):] + [node])
            return
        if node in done:
            return
        for target in graph.get(node, []):
            visit(target, path + [node])
        done.add(node)

    for node in graph:
        visit(node, [])
    return found


def check_lengths(root):
    faults = []
    for path in sources(root, "src", "tests", "bench"):
        lines = path.read_text(encoding="utf-8").count("\n")
        if lines > MAX_LINES:
            faults.append(f"{path.relative_to(root)}: {lines} lines, more than {MAX_LINES}: two rooms, not one?")
    return faults


def self_test():
    """Each rule finds its breach, and a sound tree passes."""
    def faults_of(check, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return check(root)

    sound = {"src/kardan/base/a.hpp": "", "src/kardan/io/b.cpp": '#include "kardan/base/a.hpp"\n#include <map>\n'}
    expected = [
        (check_includes, sound, 0),
        (check_includes, {**sound, "src/kardan/base/c.hpp": '#include "kardan/io/b.cpp"\n'}, 1),
        (check_includes, {**sound, "src/kardan/base/c.hpp": '#include "a.hpp"\n'}, 1),
        (check_includes, {**sound, "src/kardan/base/c.hpp": '#include "kardan/base/missing.hpp"\n'}, 1),
        (check_includes, {**sound, "src/kardan/attic/c.hpp": ""}, 1),
        (check_includes, {"src/kardan/base/a.hpp": '#include "kardan/base/b.hpp"\n',
                          "src/kardan/base/b.hpp": '#include "kardan/base/a.hpp"\n'}, 1),
        (check_lengths, sound, 0),
        (check_lengths, {"src/kardan/base/a.hpp": "\n" * (MAX_LINES + 1)}, 1),
    ]
    faults = []
    for check, files, wanted in expected:
        found = faults_of(check, files)
        if len(found) != wanted:
            faults.append(f"{check.__name__} on {sorted(files)}: {wanted} fault(s) expected, found {found}")
    return faults


def main():
    if sys.argv[1:] == ["self-test"]:
        faults = self_test()
    else:
        check, root = sys.argv[1:]
        faults = {"includes": check_includes, "lengths": check_lengths}[check](pathlib.Path(root))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
