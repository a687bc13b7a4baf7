#!/usr/bin/python3
"""Draws states of a d3plot side by side into a PNG, with VTK's own reader of LS-DYNA results. Without a display it starts
itself again under xvfb-run (Debian package xvfb).

  render_d3plot.py results/slider_crank/d3plot picture.png [--states 0 10 20] [--hide PART …] [--size 1600 520]
"""
import argparse
import os
import shutil
import sys

import vtk

COLORS = [(0.84, 0.33, 0.18), (0.95, 0.73, 0.25), (0.20, 0.47, 0.70), (0.62, 0.64, 0.67), (0.35, 0.60, 0.40)]


def open_reader(path):
    reader = vtk.vtkLSDynaReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    return reader


def part_actors(reader, state, hidden):
    """One actor for each part with cells, at a state."""
    reader.SetTimeStep(state)
    reader.Update()
    leaves = reader.GetOutput().NewIterator()
    leaves.SkipEmptyNodesOn()
    actors = []
    for index in range(10_000):
        if leaves.IsDoneWithTraversal():
            break
        grid = vtk.vtkUnstructuredGrid()
        grid.DeepCopy(leaves.GetCurrentDataObject())
        leaves.GoToNextItem()
        if grid.GetNumberOfCells() == 0 or index + 1 in hidden:
            continue
        surface = vtk.vtkDataSetSurfaceFilter()
        surface.SetInputData(grid)
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputConnection(surface.GetOutputPort())
        normals.SetFeatureAngle(35)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(normals.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*COLORS[index % len(COLORS)])
        actor.GetProperty().SetSpecular(0.25)
        actor.GetProperty().SetSpecularPower(30)
        actors.append(actor)
    return actors


def bounds_over(reader, states, hidden):
    box = vtk.vtkBoundingBox()
    for state in states:
        for actor in part_actors(reader, state, hidden):
            box.AddBounds(actor.GetBounds())
    bounds = [0.0] * 6
    box.GetBounds(bounds)
    return bounds


def draw(path, picture, states, hidden, size):
    reader = open_reader(path)
    count = reader.GetNumberOfTimeSteps()
    states = [min(s, count - 1) for s in states] if states else [0, count // 12, count // 5]
    bounds = bounds_over(reader, states, hidden)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    for position, state in enumerate(states):
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(position / len(states), 0, (position + 1) / len(states), 1)
        for actor in part_actors(reader, state, hidden):
            renderer.AddActor(actor)
        label = vtk.vtkTextActor()
        label.SetInput(f"t = {reader.GetTimeValue(state):.4g}")
        label.GetTextProperty().SetFontSize(20)
        label.GetTextProperty().SetColor(0.25, 0.25, 0.25)
        label.SetPosition(16, 12)
        renderer.AddActor2D(label)
        camera = renderer.GetActiveCamera()
        camera.SetViewUp(0, 0, 1)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(-0.55, -1, 0.75)
        renderer.ResetCamera(bounds)
        camera.Zoom(1.2)
        window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("d3plot")
    parser.add_argument("picture")
    parser.add_argument("--states", type=int, nargs="+")
    parser.add_argument("--hide", type=int, nargs="+", default=[])
    parser.add_argument("--size", type=int, nargs=2, default=[1600, 520])
    a = parser.parse_args()
    if "DISPLAY" not in os.environ:
        if not shutil.which("xvfb-run"):
            sys.exit("no display, and no xvfb-run to make one: apt-get install xvfb")
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1600x1200x24", sys.executable, *sys.argv])
    draw(a.d3plot, a.picture, a.states, set(a.hide), a.size)


if __name__ == "__main__":
    main()
