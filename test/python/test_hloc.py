"""Files of hloc: the same poses as from the database."""

import pickle

import hybridgv
import numpy as np
import pytest
from conftest import Database
from hybridgv import hloc

h5py = pytest.importorskip("h5py")


def write_files(source, names, queries, world_names, folder, scores=True, reverse=False, old=False, dtype=np.float64, rename=str):
    with h5py.File(folder / "features.h5", "w", libver="latest") as file:
        for name in names:
            group = file.create_group(rename(name))
            group["keypoints"] = (source.keypoints(name) - 0.5).astype(dtype)
            group["image_size"] = np.array(source.size(name))
    with h5py.File(folder / "matches.h5", "w", libver="latest") as file:
        for query in queries:
            for other in world_names:
                a, b = (other, query) if reverse else (query, other)
                pairs = source.matches(a, b)
                if len(pairs) < 15:
                    continue
                matches = np.full(len(source.keypoints(a)), -1, np.int16)
                matches[pairs[:, 0]] = pairs[:, 1]
                group = file.create_group(("_" if old else "/").join(rename(n).replace("/", "-") for n in (a, b)))
                group["matches0"] = matches
                if scores:
                    group["matching_scores0"] = np.ones(len(matches), np.float16)
    (folder / "pairs.txt").write_text("".join(f"{rename(q)} {rename(o)}\n" for q in queries for o in world_names))


@pytest.fixture(scope="module")
def reference(photos):
    world = hybridgv.Map.read(photos / "map0")
    options = {"max_reproj_error": 12.0}
    results = hybridgv.register_images(photos / "database.db", photos / "map0", options=options)
    return world, Database(photos / "database.db"), {name: r for name, r in results.items() if r.success}


def run(folder, world, queries, **settings):
    (folder / "queries.txt").write_text("# names\n" + "".join(f"{q}\n" for q in queries))
    hloc.main(
        world, folder / "queries.txt", folder / "pairs.txt", folder / "features.h5", folder / "matches.h5", folder / "results.txt",
        **settings,
    )  # fmt: skip
    lines = [line.split() for line in (folder / "results.txt").read_text().splitlines()]
    with open(folder / "results.txt_logs.pkl", "rb") as file:
        return {line[0]: np.array(line[1:], float) for line in lines}, pickle.load(file)


def difference(poses, results):
    return max(np.abs(poses[name] - [*r.qvec, *r.tvec]).max() for name, r in results.items())


@pytest.mark.parametrize("variant", [{}, {"scores": False, "reverse": True}, {"old": True}])
def test_same_poses_as_from_the_database(reference, tmp_path, variant):
    world, source, results = reference
    assert len(results) >= 3
    write_files(source, source.ids, results, world.image_names, tmp_path, **variant)
    poses, logs = run(tmp_path, world, results)
    assert difference(poses, results) < 1e-6
    for name, result in results.items():
        log = logs["loc"][name]
        assert not log["failed"] and not log["covisibility_clustering"]
        assert np.array_equal(log["PnP_ret"]["cam_from_world"], log["result"].cam_from_world)
        assert len(log["keypoints_query"]) == len(log["points3D_ids"]) == len(log["PnP_ret"]["inlier_mask"])
        indices, votes = log["keypoint_index_to_db"]
        assert len(indices) == len(votes) and all(len(positions) > 0 for _, positions in votes)
        assert log["result"].num_inliers == result.num_inliers
    cameras = hloc.read_queries(tmp_path / "results_cameras.txt")
    assert cameras.keys() == results.keys()
    assert np.allclose(cameras[name]["params"], results[name].camera["params"])


def test_the_cameras_of_one_run_are_the_queries_of_the_next(reference, tmp_path):
    world, source, results = reference
    write_files(source, source.ids, results, world.image_names, tmp_path)
    run(tmp_path, world, results)
    (tmp_path / "next").mkdir()
    for file in ("features.h5", "matches.h5", "pairs.txt"):
        (tmp_path / file).rename(tmp_path / "next" / file)
    lines = (tmp_path / "results_cameras.txt").read_text().splitlines()
    poses, logs = run(tmp_path / "next", world, lines)
    assert difference(poses, results) < 0.05
    for name, result in results.items():
        assert logs["loc"][name]["result"].focal_length == pytest.approx(result.focal_length, rel=1e-3)


def test_float16_keypoints(reference, tmp_path):
    world, source, results = reference
    write_files(source, source.ids, results, world.image_names, tmp_path, dtype=np.float16)
    _, logs = run(tmp_path, world, results)
    for name, result in results.items():
        assert logs["loc"][name]["result"].focal_length == pytest.approx(result.focal_length, rel=0.02)


def test_names_with_folders(reference, tmp_path):
    world, source, results = reference
    rename = "db/left/{}".format
    ids = world.point3D_ids, world.points, world.colors
    _, state = world.__reduce__()
    images = [(image[0], rename(image[1]), *image[2:]) for image in state[0][4]]
    moved = hybridgv._map._make_of_arrays((*ids, state[0][3], images))
    write_files(source, source.ids, results, world.image_names, tmp_path, rename=rename)
    queries = {rename(name): r for name, r in results.items()}
    poses, _ = run(tmp_path, moved, queries)
    assert poses.keys() == results.keys()
    poses, _ = run(tmp_path, moved, queries, prepend_camera_name=True)
    assert poses.keys() == {f"left/{name}" for name in results}
    assert difference({name.split("/")[-1]: pose for name, pose in poses.items()}, results) < 1e-6


def test_clusters(reference, tmp_path):
    world, source, results = reference
    write_files(source, source.ids, results, world.image_names, tmp_path)
    poses, logs = run(tmp_path, world, results, covisibility_clustering=True)
    clusters = hloc.do_covisibility_clustering(world.image_names, world)
    assert sorted(sum(clusters, [])) == sorted(world.image_names)
    for name in results:
        assert len(logs["loc"][name]["log_clusters"]) == len(clusters) and logs["loc"][name]["best_cluster"] is not None


def test_a_query_that_fails_has_the_pose_of_the_first_image(reference, tmp_path, caplog):
    world, source, results = reference
    query = next(iter(results))
    write_files(source, source.ids, [query], world.image_names, tmp_path)
    with h5py.File(tmp_path / "matches.h5", "r+") as file:
        for key in list(file):
            del file[key]
    poses, logs = run(tmp_path, world, [query])
    assert logs["loc"][query]["failed"] and logs["loc"][query]["PnP_ret"] is None
    assert np.allclose(poses[query][4:], world.pose(world.image_names[0])[:, 3])
    assert "no matches with the map" in caplog.text
    assert (tmp_path / "results_cameras.txt").read_text() == ""


def test_localizer_and_cluster(reference, tmp_path):
    world, source, results = reference
    query = next(iter(results))
    write_files(source, source.ids, [query], world.image_names, tmp_path)
    localizer = hloc.QueryLocalizer(world, {"estimation": {"ransac": {"max_error": 12}}})
    numbers = [world.image_id(name) for name in world.image_names]
    found, log = hloc.pose_from_cluster(localizer, query, source.size(query), numbers, tmp_path / "features.h5", tmp_path / "matches.h5")
    assert np.abs(found["cam_from_world"] - results[query].cam_from_world).max() < 1e-6
    keypoints = source.keypoints(query)
    points = localizer.localize(keypoints, log["keypoint_index_to_db"][0], log["points3D_ids"], source.size(query))
    assert points is None or points["cam_from_world"].shape == (3, 4)
    with pytest.raises(ValueError, match="estimation has no option 'max_err'"):
        hloc.QueryLocalizer(world, {"estimation": {"ransac": {"max_err": 12}}})
    with pytest.raises(ValueError, match="there is no option 'max_err'"):
        hloc.QueryLocalizer(world, {"max_err": 12}).localize(keypoints, [], [], source.size(query))


def test_map_images_with_other_features_are_left_out(reference, tmp_path):
    world, source, results = reference
    query = next(iter(results))
    write_files(source, source.ids, [query], world.image_names, tmp_path)
    other = world.image_names[0]
    with h5py.File(tmp_path / "features.h5", "r+") as file:
        del file[other]["keypoints"]
        file[other]["keypoints"] = np.zeros((3, 2))
    _, logs = run(tmp_path, world, [query])
    assert logs["loc"][query]["images_that_differ"] == [other]


def test_wrong_files(reference, tmp_path):
    world, _, _ = reference
    with pytest.raises(FileNotFoundError, match="nothing"):
        hloc.read_queries(tmp_path / "nothing*.txt")
    (tmp_path / "queries.txt").write_text("a PINHOLE 3\n")
    with pytest.raises(ValueError, match="neither a name nor"):
        hloc.read_queries(tmp_path / "queries.txt")
    (tmp_path / "pairs.txt").write_text("a b c\n")
    with pytest.raises(ValueError, match="no pair"):
        hloc.read_retrieval(tmp_path / "pairs.txt")


def test_the_command(reference, tmp_path):
    from hybridgv.__main__ import main

    world, source, results = reference
    write_files(source, source.ids, results, world.image_names, tmp_path)
    world.write(tmp_path / "map")
    (tmp_path / "queries.txt").write_text("".join(f"{q}\n" for q in results))
    given = {"reference_sfm": "map", "queries": "queries.txt", "features": "features.h5", "matches": "matches.h5",
             "retrieval": "pairs.txt", "results": "poses.txt"}  # fmt: skip
    arguments = [word for name, file in given.items() for word in (f"--{name}", str(tmp_path / file))]
    assert main(["hloc", *arguments]) == 0
    assert len((tmp_path / "poses.txt").read_text().splitlines()) == len(results)
