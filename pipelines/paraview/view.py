"""Slide and water of a run over the bed, in ParaView's colours.

pvpython view.py FOLDER PICTURE.png [TIME] a picture of the run in FOLDER (of make) at a time in s, otherwise at the last frame
pvpython view.py FOLDER PICTURE.png all    one of each frame, PICTURE.0000.png and so on
pvpython view.py FOLDER STATE.pvsm         a state for the window: paraview --state=STATE.pvsm

Water is blue by its speed, soil brown by its plastic strain, the bed grey. Without a display, put `xvfb-run -a -s -noreset` before pvpython.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

from paraview import simple as pv


def reader(folder):
    """The run itself for a ParaView that knows VTKHDF over time, its sidecar for an older one."""
    if pv.GetParaViewVersion() >= (5, 12):
        return pv.VTKHDFReader(FileName=[os.path.join(folder, "run.h5")])
    sidecar = os.path.join(folder, "run.xmf")
    if not os.path.exists(sidecar):
        sys.exit(f"view.py: {sidecar} is missing (ParaView before 5.12 cannot open run.h5 itself) run lgiw-run with --xmf")
    return pv.Xdmf3ReaderS(FileName=[sidecar])


def attributes(folder):
    """Attributes of the run: spacing, place of its rasters."""
    info = subprocess.run(["gdalinfo", "-json", os.path.join(folder, "run.h5")], capture_output=True, check=True, text=True)
    return json.loads(info.stdout)["metadata"][""]


def bed(folder, facts, table):
    """The bed below slide and water, with the failure surface, in the run's coordinates; by way of a file `table`."""
    x0, y0, spacing = (float(facts["lgiw_bed_" + key]) for key in ("x0", "y0", "dx"))
    raster = f'HDF5:"{os.path.join(folder, "run.h5")}"://lgiw/bed'
    rows = subprocess.run(["gdal_translate", "-q", "-of", "XYZ", raster, "/vsistdout/"], capture_output=True, check=True, text=True).stdout
    with open(table, "w") as file:
        file.write("x,y,z\n")
        for row in rows.splitlines():
            column, line, z = map(float, row.split())  # centres of cells, counted from the south-west
            if z == z:
                file.write(f"{x0 + (column - 0.5) * spacing},{y0 + (line - 0.5) * spacing},{z}\n")
    points = pv.TableToPoints(Input=pv.CSVReader(FileName=[table]), XColumn="x", YColumn="y", ZColumn="z")
    return pv.Delaunay2D(Input=points)


def phase(run, number):
    """The particles of one phase (0 water, 1 soil)."""
    return pv.Threshold(Input=run, Scalars=["POINTS", "Phase"], LowerThreshold=number, UpperThreshold=number)


def show_particles(source, view, array, component, low, high, colours, spacing):
    display = pv.Show(source, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.GaussianRadius = spacing / 2
    pv.ColorBy(display, ("POINTS", array, component) if component else ("POINTS", array))
    table = pv.GetColorTransferFunction(array)
    table.RGBPoints = [value for k, rgb in enumerate(colours) for value in (low + (high - low) * k / (len(colours) - 1), *rgb)]
    table.ColorSpace = "RGB"
    bar = pv.GetScalarBar(table, view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.Orientation = "Horizontal"
    bar.ScalarBarLength = 0.25
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%g"
    display.SetScalarBarVisibility(view, True)
    return bar


def scene(folder, table):
    run = reader(folder)
    facts = attributes(folder)
    spacing = float(facts["lgiw_ParticleSpacing"])
    view = pv.CreateView("RenderView")
    view.ViewSize = [1600, 1000]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0

    water = show_particles(phase(run, 0), view, "Velocity", "Magnitude", 0, 10,
                           [(0.62, 0.79, 0.88), (0.13, 0.44, 0.71), (0.03, 0.19, 0.42)], spacing)
    water.Title, water.ComponentTitle, water.Position, water.WindowLocation = "water speed (m/s)", "", [0.05, 0.05], "Any Location"
    soil = show_particles(phase(run, 1), view, "Adps", "", 0, 2,
                          [(0.87, 0.75, 0.49), (0.55, 0.32, 0.04), (0.25, 0.13, 0.0)], spacing)
    soil.Title, soil.Position, soil.WindowLocation = "plastic strain of the soil", [0.7, 0.05], "Any Location"

    ground = pv.Show(bed(folder, facts, table), view)
    ground.DiffuseColor = ground.AmbientColor = [0.75, 0.74, 0.7]

    clock = pv.Show(pv.AnnotateTimeFilter(Input=run, Format="{time:.0f} s"), view)
    clock.Color = [0, 0, 0]
    clock.FontSize = 24
    return run, view


def look(run, view):
    """From above, across the way of the slide: neither behind nor in front of it."""
    pv.UpdatePipeline(proxy=run)
    box = run.GetDataInformation().GetBounds()
    middle = [(box[2 * k] + box[2 * k + 1]) / 2 for k in range(3)]
    slide = phase(run, 1)
    pv.UpdatePipeline(proxy=slide)
    there = slide.GetDataInformation().GetBounds()
    pv.Delete(slide)
    away = [0, -1]
    if there[0] <= there[1]:  # there is soil
        side = [(there[2 * k] + there[2 * k + 1]) / 2 - middle[k] for k in range(2)]
        length = max(math.hypot(*side), 1e-6)
        away = [-side[1] / length, side[0] / length]
    far = math.hypot(box[1] - box[0], box[3] - box[2])
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0] + 1.1 * far * away[0], middle[1] + 1.1 * far * away[1], middle[2] + 0.9 * far]
    view.CameraViewUp = [0, 0, 1]


def save(run, view, result, when):
    times = list(run.TimestepValues)
    pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    view.ViewTime = times[0]
    pv.Render(view)  # the first picture would move the camera
    look(run, view)
    if result.endswith(".pvsm"):
        pv.SaveState(result)
    elif when == "all":
        pv.SaveAnimation(result, view, ImageResolution=view.ViewSize, FrameWindow=[0, len(times) - 1])
    else:
        wanted = float(when) if when else times[-1]
        view.ViewTime = min(times, key=lambda time: abs(time - wanted))
        pv.Render(view)
        pv.SaveScreenshot(result, view, ImageResolution=view.ViewSize)


def main(folder, result, when=None):
    with tempfile.TemporaryDirectory(prefix="lgiw-view-") as scratch:
        # A state needs its files for as long as it is used.
        table = result[:-len(".pvsm")] + "-bed.csv" if result.endswith(".pvsm") else os.path.join(scratch, "bed.csv")
        run, view = scene(os.path.abspath(folder), os.path.abspath(table))
        save(run, view, result, when)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
