"""Writes series of CT images for tests, with pydicom."""

import numpy as np


def write_series(folder, values, right, down, step, corner=(5.0, -7.0, 11.0)):
    """An image in the folder for each last index of `values` (column, row, image; stored values, HU + 1024). `right` and
    `down` are unit vectors along rows and columns, `step` leads from an image to the next, `corner` is the first voxel:
    mm, LPS. Pixels are 0.7 mm wide and 0.9 mm high."""
    from pydicom.dataset import FileDataset, FileMetaDataset
    from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian, generate_uid
    study, series = generate_uid(), generate_uid()
    for k in range(values.shape[2]):
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = CTImageStorage, generate_uid()
        meta.TransferSyntaxUID = ExplicitVRLittleEndian
        image = FileDataset("", {}, file_meta=meta, preamble=b"\0" * 128)
        image.SOPClassUID, image.SOPInstanceUID = CTImageStorage, meta.MediaStorageSOPInstanceUID
        image.StudyInstanceUID, image.SeriesInstanceUID, image.Modality = study, series, "CT"
        image.InstanceNumber = k + 1
        image.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL"]
        image.ImageOrientationPatient = [float(n) for n in (*right, *down)]
        image.ImagePositionPatient = [float(n) for n in np.array(corner) + k * np.array(step)]
        image.PixelSpacing, image.SliceThickness = [0.9, 0.7], 2.5
        image.Rows, image.Columns, image.SamplesPerPixel = values.shape[1], values.shape[0], 1
        image.PhotometricInterpretation, image.PixelRepresentation = "MONOCHROME2", 0
        image.BitsAllocated, image.BitsStored, image.HighBit = 16, 12, 11
        image.RescaleSlope, image.RescaleIntercept, image.RescaleType = 1, -1024, "HU"
        image.PixelData = np.ascontiguousarray(values[:, :, k].T).tobytes()
        image.save_as(folder / f"{k:03}.dcm", write_like_original=False)
