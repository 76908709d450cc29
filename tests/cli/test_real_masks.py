"""Real masks next to the checkout (RAMUS_SHARED_DATA): their counts are known from an independent program."""

import os
import pathlib
import unittest

from ramus import CommandLineTest

VOLUMES = pathlib.Path(os.environ.get("RAMUS_SHARED_DATA", "")) / "volumes"


class RealMasks(CommandLineTest):
    def test_voxels(self):
        liver = self.json("info", VOLUMES / "liver_002_vessels.nii.gz", "--json")
        self.assertEqual(liver["size"], [512, 512, 66])
        self.assertEqual([label["label"] for label in liver["labels"]], [1, 2])
        self.assertEqual(sum(label["voxels"] for label in liver["labels"]), 58235)
        airways = self.json("info", VOLUMES / "airways_lumen.nii.gz", "--json")
        self.assertEqual(airways["inside"]["voxels"], 204506)
        kidney = self.json("info", VOLUMES / "kidney.nii.gz", "--json")
        self.assertEqual([label["voxels"] for label in kidney["labels"]], [4246711])

    def test_components_and_tunnels(self):
        """Every piece and every cavity has a closed surface; each tunnel takes 2 from Euler's number."""
        known = {"liver_002_vessels": (1, 7, 1), "airways_lumen": (1, 58, 4), "kidney": (1, 49, 0)}
        for name, (pieces, tunnels, cavities) in known.items():
            with self.subTest(name):
                report = self.json("mesh", VOLUMES / (name + ".nii.gz"), "-o", "a.stl", "--method", "iso", "--json")
                self.assertEqual(report["components"], pieces + cavities)
                euler = report["vertices"] - report["triangles"] // 2
                self.assertEqual(euler, 2 * (pieces - tunnels + cavities))


if __name__ == "__main__":
    if not VOLUMES.is_dir():
        print(f"SKIPPED: {VOLUMES} is not here")
    else:
        unittest.main()
