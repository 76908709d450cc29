"""Turns once around a surface in VTK's own off-screen renderer and prints one JSON object: frames, seconds, fps,
triangles. The way of the camera is that of `ramus render --benchmark`.

    python3 turn_vtk.py MESH.ply WIDTH HEIGHT FRAMES

Needs python3-vtk9 and a display (xvfb-run gives one).
"""
import json
import sys
import time

import vtk


def main() -> None:
    path, (width, height, frames) = sys.argv[1], map(int, sys.argv[2:5])
    reader = vtk.vtkPLYReader()
    reader.SetFileName(path)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.80, 0.285, 0.235)
    renderer = vtk.vtkRenderer()
    renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, 1.0, 0.0)  # anterior, head up
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCamera()
    window.Render()  # what is made once is made
    pixel = vtk.vtkUnsignedCharArray()
    start = time.perf_counter()
    for _ in range(frames):
        camera.Azimuth(360.0 / frames)
        window.Render()
        window.GetRGBACharPixelData(0, 0, 0, 0, 1, pixel)  # waits until the frame is there
    seconds = time.perf_counter() - start
    triangles = reader.GetOutput().GetNumberOfPolys()
    print(json.dumps({"frames": frames, "seconds": seconds, "fps": frames / seconds, "triangles": triangles}))


main()
