"""Reads the last state of a run with VTK's vtkLSDynaReader and its binout, and compares one shell's stress with what the test says.

usage: check_stress.py DIRECTORY EXPECTED.json

EXPECTED.json: {"shell": id, "arrays": {VTK's name: values}, "elout": {name: values of the last output}, "scale": of the errors}
"""
import json
import sys
from pathlib import Path

import vtk

sys.path.insert(0, str(Path(__file__).parent))
from check_d3plot import leaves  # noqa: E402
from lsda_reader import Lsda  # noqa: E402


def compare(found, wanted, scale, what):
    if len(found) != len(wanted) or any(abs(a - b) > 1e-4 * scale for a, b in zip(found, wanted)):
        print(f"FAILED: {what}: {list(found)} instead of {wanted}")
        sys.exit(1)


def main(directory, expected):
    reader = vtk.vtkLSDynaReader()
    reader.SetFileName(str(directory / "d3plot"))
    reader.UpdateInformation()
    for i in range(reader.GetNumberOfShellArrays()):
        reader.SetShellArrayStatus(reader.GetShellArrayName(i), 1)
    reader.SetTimeStep(reader.GetNumberOfTimeSteps() - 1)
    reader.Update()
    seen = 0
    for _, grid in leaves(reader.GetOutput()):
        data = grid.GetCellData()
        for c in range(grid.GetNumberOfCells()):
            if int(data.GetArray("UserIds").GetTuple1(c)) != expected["shell"]:
                continue
            for name, values in expected["arrays"].items():
                compare(data.GetArray(name).GetTuple(c), values, expected["scale"].get(name, expected["scale"]["stress"]), name)
                seen += 1
    if seen != len(expected["arrays"]):
        print("FAILED: the shell is not there")
        sys.exit(1)
    lsda = Lsda(directory / "binout0000")
    last = max(path.split("/")[3] for path in lsda.symbols if path.startswith("/elout/shell/d0"))
    for name, values in expected["elout"].items():
        compare(lsda.read(f"/elout/shell/{last}/{name}"), values, expected["scale"]["stress"] if "sig" in name else 1, name)
    print("stresses compared")


if __name__ == "__main__":
    with open(sys.argv[2]) as file:
        main(Path(sys.argv[1]), json.load(file))
