"""Reads a d3plot family with VTK's vtkLSDynaReader and compares it with what the test says stands in it.

usage: check_d3plot.py D3PLOT EXPECTED.json
"""
import json
import sys

import vtk


def leaves(block):
    for i in range(block.GetNumberOfBlocks()):
        child = block.GetBlock(i)
        if child is None:
            continue
        if child.IsA("vtkMultiBlockDataSet"):
            yield from leaves(child)
        else:
            yield block.GetMetaData(i).Get(vtk.vtkCompositeDataSet.NAME()), child


def fail(message):
    print("FAILED:", message)
    sys.exit(1)


def close(a, b, what):
    if any(abs(x - y) > 1e-6 * max(1.0, abs(y)) for x, y in zip(a, b)):
        fail(f"{what}: {a} instead of {b}")


def main(path, expected):
    reader = vtk.vtkLSDynaReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    states = expected["states"]
    if reader.GetNumberOfTimeSteps() != len(states):
        fail(f"{reader.GetNumberOfTimeSteps()} states instead of {len(states)}")
    if reader.GetTitle().strip() != expected["title"]:
        fail(f"title '{reader.GetTitle()}'")
    names = [reader.GetPartArrayName(i) for i in range(reader.GetNumberOfPartArrays())]
    if names != expected["part_names"]:
        fail(f"part names {names} instead of {expected['part_names']}")
    for i in range(reader.GetNumberOfPointArrays()):
        reader.SetPointArrayStatus(reader.GetPointArrayName(i), 1)
    for kind in ("Solid", "Shell", "Beam"):
        for i in range(getattr(reader, f"GetNumberOf{kind}Arrays")()):
            getattr(reader, f"Set{kind}ArrayStatus")(getattr(reader, f"Get{kind}ArrayName")(i), 1)
    for step, state in enumerate(states):
        close([reader.GetTimeValue(step)], [state["time"]], "time")
        reader.SetTimeStep(step)
        reader.Update()
        seen, elements = {}, {}
        for name, grid in leaves(reader.GetOutput()):
            data = grid.GetCellData()
            if "part_nodes" not in expected:  # VTK reorders the points of parts with deleted elements
                for c in range(grid.GetNumberOfCells()):
                    elements[int(data.GetArray("UserIds").GetTuple1(c))] = (name, None)
                continue
            # VTK 9.1 garbles the nodes' user ids of single-precision files; a part's points come in ascending order.
            ids = expected["part_nodes"][name]
            if grid.GetNumberOfPoints() != len(ids):
                fail(f"part {name} has {grid.GetNumberOfPoints()} points instead of {len(ids)}")
            velocity = grid.GetPointData().GetArray("Velocity")
            acceleration = grid.GetPointData().GetArray("Acceleration")
            for p, node in enumerate(ids):
                point = (*grid.GetPoint(p), *velocity.GetTuple3(p), *acceleration.GetTuple3(p))
                close(seen.setdefault(node, point), point, f"node {node} in two parts")
            for c in range(grid.GetNumberOfCells()):
                element = int(data.GetArray("UserIds").GetTuple1(c))
                points = grid.GetCell(c).GetPointIds()
                elements[element] = (name, [ids[points.GetId(k)] for k in range(points.GetNumberOfIds())])
                for array, wanted in expected["cells"].get(str(element), {}).items():
                    if not data.HasArray(array):
                        fail(f"no array {array}; there are {[data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]}")
                    close(data.GetArray(array).GetTuple(c), wanted, f"{array} of element {element}")
        for node, values in state["nodes"].items():
            if int(node) not in seen:
                fail(f"node {node} is missing; seen {sorted(seen)}")
            close(seen[int(node)], values, f"node {node} at time {state['time']}")
        for element, (part, nodes) in expected["elements"].items():
            if int(element) not in elements:
                fail(f"element {element} is missing; seen {sorted(elements)}")
            found = elements[int(element)]
            if found != (part, nodes) and found != (part, None):
                fail(f"element {element}: {found} instead of {(part, nodes)}")
        extra = set(map(str, elements)) - set(expected["elements"])
        if extra:
            fail(f"elements {extra} do not belong here")
    print(f"{len(states)} states, {len(names)} parts compared")


if __name__ == "__main__":
    with open(sys.argv[2]) as file:
        main(sys.argv[1], json.load(file))
