"""Discs and bonds of a Clathra run in ParaView.

    pvpython share/paraview/specimen.py OUT picture.png [--colour displacement|coordination|stress_xx_yy_xy|velocity] [--strain 0.02]
    paraview --script=share/paraview/specimen.py        (then set OUT in the environment: OUT=out/quick paraview ...)

OUT is the folder of a run with snapshots. Discs are drawn at their true size (Point Gaussian), bonds as lines: intact ones grey, broken ones
in the colour of what broke them. The time of ParaView is the axial strain. Without a display: xvfb-run -a pvpython ...
"""
import argparse
import os
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, Hide, Render, ResetCamera, SaveScreenshot, Show,
                             Threshold, XDMFReader)

BROKEN = {2: ("tension", [0.0, 0.62, 0.45]), 3: ("compression", [0.9, 0.62, 0.0]), 4: ("shear", [0.0, 0.45, 0.7]),
          5: ("rolling", [0.84, 0.37, 0.0])}


def show_discs(folder, view, colour):
    """The discs as circles of their radius, coloured by the size of one of their attributes."""
    discs = XDMFReader(registrationName="discs", FileNames=[os.path.join(folder, "particles.xdmf")])
    display = Show(discs, view)
    display.SetRepresentationType("Point Gaussian")
    display.GaussianRadius = 1.0
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius"]
    display.UseScaleFunction = 0
    display.ShaderPreset = "Plain circle"
    ColorBy(display, ("POINTS", colour, "Magnitude") if colour in ("displacement", "velocity") else ("POINTS", colour))
    return discs


def show_bonds(folder, view):
    """Intact bonds as thin grey lines, broken ones thick and coloured by their mode."""
    pairs = XDMFReader(registrationName="contacts", FileNames=[os.path.join(folder, "contacts.xdmf")])
    Hide(pairs, view)
    for state, name, colour, width in [(1, "intact", [0.35, 0.35, 0.35], 1.0)] + [(s, n, c, 3.0) for s, (n, c) in BROKEN.items()]:
        part = Threshold(registrationName=name, Input=pairs)
        part.Scalars = ["CELLS", "state"]
        part.LowerThreshold = part.UpperThreshold = state
        display = Show(part, view)
        display.SetRepresentationType("Wireframe")
        display.ColorArrayName = [None, ""]
        display.AmbientColor = display.DiffuseColor = colour
        display.LineWidth = width


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=os.environ.get("OUT"))
    parser.add_argument("picture", nargs="?")
    parser.add_argument("--colour", default="displacement")
    parser.add_argument("--strain", type=float, help="axial strain to show (default: the last)")
    options = parser.parse_args(arguments)
    if not options.folder or not os.path.exists(os.path.join(options.folder, "particles.xdmf")):
        parser.error("name the folder of a run that has particles.xdmf")
    view = GetActiveViewOrCreate("RenderView")
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    discs = show_discs(options.folder, view, options.colour)
    show_bonds(options.folder, view)
    strains = list(discs.TimestepValues)
    view.ViewTime = strains[-1] if options.strain is None else min(strains, key=lambda s: abs(s - options.strain))
    discs.UpdatePipeline(view.ViewTime)
    low, high = discs.PointData[options.colour].GetRange(-1)  # of the moment shown
    colours = GetColorTransferFunction(options.colour)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(low, high)
    print(f"{options.colour} from {low:.4g} to {high:.4g} at an axial strain of {100 * view.ViewTime:.3g} %")
    ResetCamera(view)
    Render(view)
    if options.picture:
        SaveScreenshot(options.picture, view, ImageResolution=[900, 1500])


main(sys.argv[1:])
