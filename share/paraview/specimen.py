"""Discs and bonds of a Clathra run in ParaView.

    pvpython share/paraview/specimen.py OUT picture.png [--colour displacement|velocity|stress_yy|...] [--strain 0.02]
    paraview --script=share/paraview/specimen.py        (then set OUT in the environment: OUT=out/quick paraview ...)

OUT is the folder of a run with snapshots. Discs are drawn at their true size (Point Gaussian), bonds as lines: intact ones grey, broken ones
in the colour of what broke them. The time of ParaView is the axial strain. Without a display: xvfb-run -a pvpython ...
"""
import argparse
import os
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar, Hide, Render, ResetCamera,
                             SaveScreenshot, Show, Threshold, XDMFReader)

BROKEN = {2: ("tension", [0.0, 0.62, 0.45]), 3: ("compression", [0.9, 0.62, 0.0]), 4: ("shear", [0.0, 0.45, 0.7]),
          5: ("rolling", [0.84, 0.37, 0.0]), 6: ("dissolved", [0.34, 0.71, 0.91])}
MAGNITUDE = -1
PICTURE = [900, 1500]  # pixels
# What the discs can be coloured by: array of the snapshots, component, unit.
COLOURS = {"displacement": ("displacement", MAGNITUDE, "m"), "velocity": ("velocity", MAGNITUDE, "m/s"),
           "stress_xx": ("stress_xx_yy_xy", 0, "Pa"), "stress_yy": ("stress_xx_yy_xy", 1, "Pa"), "stress_xy": ("stress_xx_yy_xy", 2, "Pa"),
           "angle": ("angle", 0, "rad"), "coordination": ("coordination", 0, "pairs"), "bonds_intact": ("bonds_intact", 0, "bonds")}


def show_discs(folder, view):
    """The discs as circles of their radius."""
    discs = XDMFReader(registrationName="discs", FileNames=[os.path.join(folder, "particles.xdmf")])
    display = Show(discs, view)
    display.SetRepresentationType("Point Gaussian")
    display.GaussianRadius = 1.0
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius"]
    display.UseScaleFunction = 0
    display.ShaderPreset = "Plain circle"
    return discs, display


def colour_discs(discs, display, view, colour):
    """Colours the discs over the range that they have at the moment shown, which is printed; adds the bar of the colours."""
    array, component, unit = COLOURS[colour]
    ColorBy(display, ("POINTS", array))
    colours = GetColorTransferFunction(array)
    colours.VectorMode = "Magnitude" if component == MAGNITUDE else "Component"
    colours.VectorComponent = max(component, 0)
    low, high = discs.PointData[array].GetRange(component)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(low, high)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = f"{colour} [{unit}]", ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.TitleFontSize = bar.LabelFontSize = 20
    bar.Orientation, bar.WindowLocation, bar.ScalarBarLength, bar.ScalarBarThickness = "Horizontal", "Lower Center", 0.6, 16
    bar.DrawTickLabels, bar.RangeLabelFormat = 0, "%-#.3g"
    print(f"{colour} from {low:.4g} to {high:.4g} {unit} at an axial strain of {100 * view.ViewTime:.3g} %")


def show_bonds(folder, view):
    """Intact bonds as thin grey lines, broken ones thick and coloured by their mode."""
    pairs = XDMFReader(registrationName="contacts", FileNames=[os.path.join(folder, "contacts.xdmf")])
    Hide(pairs, view)
    for state, name, colour, width in [(1, "intact", [0.35, 0.35, 0.35], 1.0)] + [(s, n, c, 2.0) for s, (n, c) in BROKEN.items()]:
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
    parser.add_argument("--colour", default="displacement", choices=COLOURS, help="of the discs (default: %(default)s)")
    parser.add_argument("--strain", type=float, help="axial strain to show, 0.02 for 2 %% (default: the last)")
    options = parser.parse_args(arguments)
    if not options.folder or not os.path.exists(os.path.join(options.folder, "particles.xdmf")):
        parser.error("name the folder of a run that has particles.xdmf")
    view = GetActiveViewOrCreate("RenderView")
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    discs, display = show_discs(options.folder, view)
    show_bonds(options.folder, view)
    strains = list(discs.TimestepValues)
    view.ViewTime = strains[-1] if options.strain is None else min(strains, key=lambda s: abs(s - options.strain))
    discs.UpdatePipeline(view.ViewTime)
    colour_discs(discs, display, view, options.colour)
    if options.picture:
        view.ViewSize = PICTURE
    ResetCamera(view)
    left, right, bottom, top = discs.GetDataInformation().GetBounds()[:4]
    view.CameraParallelScale = 0.57 * max(top - bottom, (right - left) * view.ViewSize[1] / view.ViewSize[0])  # room for the bar
    Render(view)
    if options.picture:
        SaveScreenshot(options.picture, view, ImageResolution=PICTURE)


main(sys.argv[1:])
