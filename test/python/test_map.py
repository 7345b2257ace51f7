"""Maps: files, arrays, pycolmap's objects; query images against them; images of a database."""

import pickle
from types import SimpleNamespace

import hybridgv
import numpy as np
import pytest
from conftest import Database, read_truth


@pytest.fixture(scope="module")
def world(database):
    return hybridgv.Map.read(database / "map")


def matches_of(world, database, name):
    source = Database(database / "database.db")
    pairs = {other: source.matches(name, other) for other in world.image_names}
    return source.keypoints(name), {other: p for other, p in pairs.items() if len(p) >= 15}, source.size(name)


def test_arrays_of_a_map(world):
    assert world.points.ndim == 2 and world.points.shape[1] == 3
    assert world.colors.dtype == np.uint8 and world.colors.shape == world.points.shape
    assert world.cam_from_world.shape == (len(world.image_names), 3, 4)
    assert np.array_equal(world.cam_from_world[0], world.pose(world.image_names[0]))
    assert world.camera(world.image_names[0])["model"] == "SIMPLE_RADIAL"
    assert f"{len(world.points)} points" in repr(world)
    with pytest.raises(ValueError, match="no image 'nobody'"):
        world.pose("nobody")


def test_a_written_map_is_the_same(world, tmp_path):
    for binary in (True, False):
        folder = tmp_path / str(binary) / "deep"
        world.write(folder, binary=binary)
        again = hybridgv.Map.read(folder)
        assert again.image_names == world.image_names
        assert np.array_equal(again.points, world.points) and np.array_equal(again.cam_from_world, world.cam_from_world)


def test_errors_of_files(tmp_path):
    with pytest.raises(hybridgv.FileError) as caught:
        hybridgv.Map.read(tmp_path / "nothing")
    assert isinstance(caught.value, OSError) and "nothing" in caught.value.file
    for file in ("cameras.txt", "images.txt", "points3D.txt"):
        (tmp_path / file).write_text("1 PINHOLE 3\n")
    with pytest.raises(hybridgv.FileError) as caught:
        hybridgv.Map.read(tmp_path)
    assert caught.value.line == 1 and caught.value.byte_offset is None and str(caught.value).startswith(caught.value.file)


def as_pycolmap(world, is_new):
    """Objects as pycolmap has them: from 3.12 on, cam_from_world is a method, has_pose a property."""

    def image(name):
        pose = SimpleNamespace(matrix=lambda: world.pose(name))
        ids = world.keypoint_point3D_ids(name)
        points = [SimpleNamespace(xy=xy, point3D_id=2**64 - 1 if i < 0 else int(i)) for xy, i in zip(world.keypoints(name), ids)]
        number = world.image_id(name)
        state = {"has_pose": True} if is_new else {"registered": True}
        pose = (lambda: SimpleNamespace(matrix=lambda: world.pose(name))) if is_new else pose
        camera = next(i for i, c in world.cameras.items() if np.array_equal(c["params"], world.camera(name)["params"]))
        return number, SimpleNamespace(name=name, camera_id=camera, points2D=points, cam_from_world=pose, **state)

    cameras = {i: SimpleNamespace(model=SimpleNamespace(name=c["model"]), width=c["width"], height=c["height"], params=c["params"])
               for i, c in world.cameras.items()}  # fmt: skip
    points = {int(i): SimpleNamespace(xyz=x, color=c) for i, x, c in zip(world.point3D_ids, world.points, world.colors)}
    return SimpleNamespace(points3D=points, cameras=cameras, images=dict(image(name) for name in world.image_names))


@pytest.mark.parametrize("is_new", [True, False])
def test_from_pycolmap(world, database, is_new):
    other = hybridgv.Map.from_pycolmap(as_pycolmap(world, is_new))
    assert np.array_equal(other.points, world.points) and np.array_equal(other.colors, world.colors)
    assert np.abs(other.cam_from_world - world.cam_from_world).max() < 1e-12
    name = next(iter(read_truth(database)))
    keypoints, matches, size = matches_of(world, database, name)
    results = [m.localize(name, keypoints, matches, camera=size) for m in (world, other)]
    assert np.abs(results[0].cam_from_world - results[1].cam_from_world).max() < 1e-6


def test_pickle_of_a_map(world):
    again = pickle.loads(pickle.dumps(world))
    assert np.array_equal(again.points, world.points) and again.image_names == world.image_names
    assert np.array_equal(again.keypoint_point3D_ids(world.image_names[0]), world.keypoint_point3D_ids(world.image_names[0]))


def test_localize_against_a_map(world, database):
    for name, (focal_length, _, qvec, tvec) in read_truth(database).items():
        keypoints, matches, size = matches_of(world, database, name)
        result = world.localize(name, keypoints, matches, camera=size)
        assert result.success, result
        assert abs(result.focal_length / focal_length - 1) < 0.01
        assert abs(result.qvec @ qvec) > 0.99999 and np.abs(result.tvec - tvec).max() < 0.2
        assert len(result.keypoint_idxs) == len(result.point3D_ids) == len(result.inlier_mask)
        assert len(result.keypoint_idxs_rays) == len(result.image_names_rays) == len(result.inlier_mask_rays)
        assert set(result.point3D_ids) <= set(world.point3D_ids)
        assert {p["image"] for p in result.pairs} == set(matches)
        assert sum(p["inliers_points"] for p in result.pairs) >= result.num_inliers_points
        assert pickle.loads(pickle.dumps(result)).name == name


def test_matches_that_cannot_be_used_are_counted(world, database):
    name = next(iter(read_truth(database)))
    keypoints, matches, size = matches_of(world, database, name)
    first = next(iter(matches))
    result = world.localize(name, keypoints, {**matches, "elsewhere": [[0, 0]], first: [[10**6, 0]]}, camera=size)
    assert result.left_out["images_not_in_map"] == 1 and result.left_out["indices_out_of_range"] == 1
    for wrong, message in (([[0.5, 1]], "integers"), ([[-1, 0]], "-1 is no index"), ([1, 2], r"\(N, 2\), has \(2,\)")):
        with pytest.raises(ValueError, match=message):
            world.localize(name, keypoints, {first: wrong}, camera=size)
    with pytest.raises(ValueError, match="scores"):
        world.localize(name, keypoints, matches, camera=size, scores={first: [1.0]})
    nothing = world.localize(name, keypoints, {}, camera=size)
    assert nothing.failure_reason == "no matches with the map"


def test_register_images(world, database, tmp_path):
    truth = read_truth(database)
    results = hybridgv.register_images(database / "database.db", database / "map", tmp_path / "out", options={"threads": 2})
    assert results.keys() == truth.keys() and all(r.success for r in results.values())
    for name, result in results.items():
        assert abs(result.focal_length / truth[name][0] - 1) < 0.01
    written = hybridgv.Map.read(tmp_path / "out")
    assert set(written.image_names) == set(world.image_names) | truth.keys()
    name = next(iter(truth))
    assert np.abs(written.pose(name) - results[name].cam_from_world).max() < 1e-9
    assert np.allclose(written.camera(name)["params"], results[name].camera["params"])
    part = hybridgv.register_images(database / "database.db", database / "map", image_names=[name])
    assert list(part) == [name] and np.array_equal(part[name].cam_from_world, results[name].cam_from_world)


def test_page_of_register_images(database, tmp_path):
    results = hybridgv.register_images(database / "database.db", database / "map", html_path=tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="ascii")
    assert page.startswith("<!DOCTYPE html>") and all(f'"name":"{name}"' in page for name in results)


def test_wrong_calls_of_register_images(database, tmp_path):
    paths = database / "database.db", database / "map"
    with pytest.raises(ValueError, match="has no image nobody"):
        hybridgv.register_images(*paths, image_names=["nobody"])
    with pytest.raises(ValueError, match="'two_view_geometries' or 'matches'"):
        hybridgv.register_images(*paths, matches="some")
    with pytest.raises(hybridgv.FileError, match="nothing.db"):
        hybridgv.register_images(tmp_path / "nothing.db", paths[1])
