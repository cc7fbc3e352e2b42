"""Reads the snapshots of a run with all three XDMF readers of ParaView, and with h5py: pvpython tests/paraview_reads.py OUT"""
import os
import sys

from paraview.simple import Threshold, XDMFReader, Xdmf3ReaderS, Xdmf3ReaderT

folder = sys.argv[1]
for index, association, key in (("particles.xdmf", "POINTS", "coordination"), ("contacts.xdmf", "CELLS", "state")):
    counts = set()
    for reader_type in (XDMFReader, Xdmf3ReaderS, Xdmf3ReaderT):
        names = [os.path.join(folder, index)]
        reader = reader_type(FileNames=names) if reader_type is XDMFReader else reader_type(FileName=names)
        reader.UpdatePipelineInformation()
        times = list(reader.TimestepValues)
        assert len(times) == len(os.listdir(os.path.join(folder, "snap"))), (reader_type, times)
        reader.UpdatePipeline(times[-1])
        info = reader.GetDataInformation()
        above = Threshold(Input=reader)
        above.Scalars = [association, key]
        above.LowerThreshold, above.UpperThreshold = 1, 255
        above.UpdatePipeline(times[-1])
        counts.add((info.GetNumberOfPoints(), info.GetNumberOfCells(), above.GetDataInformation().GetNumberOfCells()))
    assert len(counts) == 1, (index, counts)
    points, cells, kept = counts.pop()
    assert 0 < kept <= cells and points > 0, (index, points, cells, kept)
    print(index, points, cells, kept)
