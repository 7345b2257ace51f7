"""3. Files of hloc: features.h5, matches.h5, pairs and queries in, poses and cameras out. Needs h5py.

Here the files are made of the map that comes with the library; yours come from hloc's extract_features and match_features.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import hybridgv
from hybridgv import hloc

try:
    import h5py  # type: ignore[import]
except ImportError:
    print("skipped: there is no h5py (python3-h5py)")
    sys.exit(0)

reference = Path(__file__).parents[1] / "default_map"
world = hybridgv.Map.read(reference)
query, *others = world.image_names


def write_files(folder: Path) -> None:
    """What hloc would write for these images."""
    with h5py.File(folder / "features.h5", "w") as file:
        for name in world.image_names:
            file[f"{name}/keypoints"] = world.keypoints(name) - 0.5  # hloc counts from the centre of the first pixel
            file[f"{name}/image_size"] = (world.camera(name)["width"], world.camera(name)["height"])
    ids = world.keypoint_point3D_ids(query)
    with h5py.File(folder / "matches.h5", "w") as file:
        for name in others:
            index_of = {number: i for i, number in enumerate(world.keypoint_point3D_ids(name)) if number >= 0}
            file[f"{query}/{name}/matches0"] = np.array([index_of.get(number, -1) for number in ids], dtype=np.int16)
    (folder / "pairs.txt").write_text("".join(f"{query} {name}\n" for name in others))
    (folder / "queries.txt").write_text(f"{query}\n")  # a name alone: its focal length is found


with tempfile.TemporaryDirectory() as name_of_folder:
    folder = Path(name_of_folder)
    write_files(folder)
    hloc.main(
        reference, folder / "queries.txt", folder / "pairs.txt", folder / "features.h5", folder / "matches.h5", folder / "poses.txt"
    )
    print("pose   ", (folder / "poses.txt").read_text().strip())
    print("camera ", (folder / "poses_cameras.txt").read_text().strip())
    print("the map says", world.camera(query)["params"])
