"""localize() on arrays."""

import gc
import os
import pickle
import resource
import subprocess
import sys
import threading
import time

import hybridgv
import numpy as np
import pytest
from conftest import HEIGHT, WIDTH, make_scene


def assert_right(result, scene, tolerance=0.01):
    assert result.success, result
    assert result.failure_reason is None
    assert abs(result.focal_length / scene.focal_length - 1) < tolerance
    truth = scene.cam_from_world
    assert np.abs(result.R - truth[:, :3]).max() < tolerance
    assert np.abs(result.center + truth[:, :3].T @ truth[:, 3]).max() < 5 * tolerance


def same(a, b):
    return np.array_equal(a.cam_from_world, b.cam_from_world) and a.focal_length == b.focal_length


def test_finds_pose_and_focal_length(scene, camera):
    result = hybridgv.localize(*scene.arrays, camera=camera)
    assert_right(result, scene)
    assert result.inlier_mask.dtype == bool and result.inlier_mask.shape == (60,)
    assert result.inlier_mask_rays.dtype == bool and result.inlier_mask_rays.shape == (80,)
    assert result.inlier_mask[: scene.num_right].mean() > 0.9
    assert result.inlier_mask[scene.num_right :].mean() < 0.2
    assert result.num_inliers_points == result.inlier_mask.sum()
    assert result.num_inliers_rays == result.inlier_mask_rays.sum()
    assert result.num_inliers == result.num_inliers_points + result.num_inliers_rays
    assert result.covariance.shape == (7, 7)
    assert np.allclose(result.covariance, result.covariance.T)
    assert result.focal_length_std == pytest.approx(result.focal_length * np.sqrt(result.covariance[6, 6]), rel=1e-6)
    assert 0.2 < result.noise_points < 1
    assert result.iterations == sum(result.iterations_per_solver.values())


def test_an_allowance_for_the_principal_point_changes_the_deviations_alone(scene, camera):
    exact = hybridgv.localize(*scene.arrays, camera=camera)
    result = hybridgv.localize(*scene.arrays, camera=camera, options={"principal_point_deviation": 5})
    assert np.array_equal(result.pose.position, exact.pose.position)
    assert np.all(np.diag(result.covariance) > np.diag(exact.covariance))
    assert result.covariance[0, 0] > 4 * exact.covariance[0, 0]
    assert result.focal_length_std > exact.focal_length_std


def test_two_poses_that_are_as_good_are_no_success(camera):
    one, other = make_scene(21, points=120, rays=0), make_scene(22, points=120, rays=0)
    points2D = np.concatenate([one.points2D, other.points2D])
    points3D = np.concatenate([one.points3D, other.points3D + [100, 0, 0]])
    result = hybridgv.localize(points2D, points3D, camera=camera)
    assert not result.success and result.failure_reason == "another pose is as good"
    assert result.second_pose_support > 0.8
    assert abs(result.second_pose.position - result.position).max() > 50
    alone = hybridgv.localize(*one.arrays[:2], camera=camera)
    assert alone.success and alone.second_pose is None and alone.second_pose_support == 0


def test_points_alone_and_rays_alone(camera):
    scene = make_scene(3, points=80, rays=120)
    assert_right(hybridgv.localize(scene.points2D, scene.points3D, camera=camera), scene, 0.02)
    rays = hybridgv.localize([], [], *scene.arrays[2:], camera=camera)
    assert rays.inlier_mask.shape == (0,) and rays.inlier_mask_rays.shape == (120,)


def test_distortion_is_found_and_goes_into_the_camera(camera):
    scene = make_scene(5, points=200, rays=200, k1=-0.15, focal_length=1200)
    result = hybridgv.localize(*scene.arrays, camera=camera)
    assert_right(result, scene)
    assert result.k1 == pytest.approx(-0.15, abs=0.02)
    assert result.distortion < 0 < result.distortion_std
    assert result.camera["model"] == "SIMPLE_RADIAL"
    assert (result.camera["width"], result.camera["height"]) == camera
    assert np.array_equal(result.camera["params"], [result.focal_length, WIDTH / 2, HEIGHT / 2, result.k1])
    # Its own camera, now known, leaves the pose as it is.
    again = hybridgv.localize(*scene.arrays, camera=result.camera, camera_knowledge="known")
    assert again.focal_length == pytest.approx(result.focal_length, rel=1e-12)
    assert np.abs(again.cam_from_world - result.cam_from_world).max() < 0.02
    for options in ({"radial": False}, None):
        pinhole = {"model": "SIMPLE_PINHOLE", "width": WIDTH, "height": HEIGHT}
        chosen = camera if options else pinhole
        assert hybridgv.localize(*scene.arrays, camera=chosen, options=options).k1 == 0


def test_principal_point_and_aspect_ratio_of_the_camera(scene):
    moved = scene.points2D + [30, -20], scene.points3D, scene.points2D_rays + [30, -20], *scene.arrays[3:]
    center = WIDTH / 2 + 30, HEIGHT / 2 - 20
    given = {"model": "SIMPLE_RADIAL", "width": WIDTH, "height": HEIGHT, "params": [1, *center, 0]}
    assert_right(hybridgv.localize(*moved, camera=given), scene)
    stretch = np.array([1, 0.9])
    stretched = scene.points2D * stretch, scene.points3D, scene.points2D_rays * stretch, *scene.arrays[3:]
    given = {"model": "PINHOLE", "width": WIDTH, "height": 1080, "params": [1, 0.9, WIDTH / 2, 0.9 * HEIGHT / 2]}
    result = hybridgv.localize(*stretched, camera=given)
    assert_right(result, scene)
    assert result.camera["params"][1] == pytest.approx(0.9 * result.focal_length)


def test_known_and_prior_focal_length(scene):
    given = {"model": "SIMPLE_RADIAL", "width": WIDTH, "height": HEIGHT, "params": [1400, WIDTH / 2, HEIGHT / 2, 0]}
    known = hybridgv.localize(*scene.arrays, camera=given, camera_knowledge="known")
    assert_right(known, scene)
    assert known.focal_length == pytest.approx(1400, rel=1e-12)
    given["params"][0] = 1500
    prior = hybridgv.localize(*scene.arrays, camera=given, camera_knowledge="prior")
    assert_right(prior, scene)
    with pytest.raises(ValueError, match="camera_knowledge.*'guessed'"):
        hybridgv.localize(*scene.arrays, camera=given, camera_knowledge="guessed")


class ColmapModel:
    name = "SIMPLE_RADIAL"


class ColmapCamera:
    model = ColmapModel()
    width, height = WIDTH, HEIGHT
    params = np.array([1400.0, WIDTH / 2, HEIGHT / 2, 0.0])


class PoseLibCamera:
    width, height = WIDTH, HEIGHT
    params = [1400.0, WIDTH / 2, HEIGHT / 2, 0.0]

    def model_name(self):
        return "SIMPLE_RADIAL"


def test_cameras_of_pycolmap_and_poselib(scene, camera):
    expected = hybridgv.localize(*scene.arrays, camera=camera)
    for given in (ColmapCamera(), PoseLibCamera()):
        assert same(hybridgv.localize(*scene.arrays, camera=given), expected)


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"model": "SIMPLE_RADIAL", "focal": 3}, "no key 'focal'"),
        ({"model": "FISHY", "width": 3, "height": 3}, "no model 'FISHY'.*SIMPLE_RADIAL"),
        ({"model": "FOV", "width": 3, "height": 3}, "FOV"),
        (None, "camera must be a dict"),
        ({"model": "SIMPLE_RADIAL"}, "neither a size nor"),
    ],
)
def test_wrong_cameras_are_refused(scene, wrong, message):
    with pytest.raises(ValueError, match=message):
        hybridgv.localize(*scene.arrays, camera=wrong)


def test_arrays_of_every_kind(scene, camera):
    expected = hybridgv.localize(*scene.arrays, camera=camera)
    assert same(hybridgv.localize(*(a.tolist() for a in scene.arrays), camera=camera), expected)
    assert same(hybridgv.localize(*(np.asfortranarray(a) for a in scene.arrays), camera=camera), expected)
    assert same(hybridgv.localize(*(np.repeat(a, 2, axis=0)[::2] for a in scene.arrays), camera=camera), expected)
    single = [a.astype(np.float32) for a in scene.arrays]
    assert same(
        hybridgv.localize(*single, camera=camera), hybridgv.localize(*(a.astype(float) for a in single), camera=camera)
    )
    half = scene.points2D.astype(np.float16), scene.points3D, scene.points2D_rays.astype(np.float16), *scene.arrays[3:]
    assert_right(hybridgv.localize(*half, camera=camera), scene, 0.02)


@pytest.mark.parametrize("index, name", enumerate(["points2D", "points3D", "points2D_rays", "ray_directions", "ray_origins"]))
def test_wrong_shapes_are_named(scene, camera, index, name):
    arrays = list(scene.arrays)
    columns = arrays[index].shape[1]
    arrays[index] = np.zeros((7, 4))
    with pytest.raises(ValueError, match=rf"{name} must have the shape \(N, {columns}\), has \(7, 4\)"):
        hybridgv.localize(*arrays, camera=camera)
    arrays[index] = scene.arrays[index].ravel()
    with pytest.raises(ValueError, match=rf"{name} .*{columns}\), has \({arrays[index].size},\)"):
        hybridgv.localize(*arrays, camera=camera)
    arrays[index] = scene.arrays[index][:-1]
    with pytest.raises(ValueError, match=r"(60|80).*(59|79)|(59|79).*(60|80)"):
        hybridgv.localize(*arrays, camera=camera)
    arrays[index] = "text"
    with pytest.raises(ValueError, match=f"{name} is not an array of numbers"):
        hybridgv.localize(*arrays, camera=camera)
    arrays[index] = scene.arrays[index].copy()
    arrays[index][3, 1] = np.nan
    with pytest.raises(ValueError, match=rf"{name}\[3\] is not finite"):
        hybridgv.localize(*arrays, camera=camera)


def test_rays_by_camera_indices(scene, camera):
    by_index = hybridgv.localize(
        *scene.arrays[:4], scene.centers, camera_idxs=scene.camera_idxs, camera=camera, rig_focal_lengths=[900] * 4
    )
    by_ray = hybridgv.localize(*scene.arrays, camera=camera, rig_focal_lengths=[900] * 80)
    assert_right(by_index, scene)
    assert np.abs(by_index.cam_from_world - by_ray.cam_from_world).max() < 1e-6
    for idxs, message in (
        (scene.camera_idxs[:-1], "camera_idxs has the length 79, points2D_rays has 80"),
        ([4] * 80, r"camera_idxs\[0\] is 4, ray_origins has 4"),
        ([0.5] * 80, "integers"),
    ):
        with pytest.raises(ValueError, match=message):
            hybridgv.localize(*scene.arrays[:4], scene.centers, camera_idxs=idxs, camera=camera)
    with pytest.raises(ValueError, match="ray_origins is missing"):
        hybridgv.localize(*scene.arrays[:4], camera=camera)


def test_keypoints(scene, camera):
    points2D, points3D, points2D_rays, ray_directions, ray_origins = scene.arrays
    rays, points = np.arange(80), 80 + np.arange(60)
    once = hybridgv.localize(*scene.arrays, camera=camera)
    numbered = hybridgv.localize(*scene.arrays, camera=camera, keypoint_idxs=points, keypoint_idxs_rays=rays)
    assert numbered.focal_length_std == once.focal_length_std
    twice = [np.concatenate([a, a]) for a in scene.arrays]
    twice[0] = twice[0] + np.concatenate([np.zeros((60, 2)), np.full((60, 2), 0.01)])  # no longer equal
    twice[2] = twice[2] + np.concatenate([np.zeros((80, 2)), np.full((80, 2), 0.01)])
    numbers = {"keypoint_idxs": np.tile(points, 2), "keypoint_idxs_rays": np.tile(rays, 2)}
    assert hybridgv.localize(*twice, camera=camera, **numbers).focal_length_std == pytest.approx(once.focal_length_std, rel=0.15)
    assert hybridgv.localize(*twice, camera=camera).focal_length_std < 0.85 * once.focal_length_std
    none = hybridgv.localize(*scene.arrays, camera=camera, keypoint_idxs=np.full(60, -1))
    assert none.focal_length_std == once.focal_length_std
    with pytest.raises(ValueError, match="keypoint_idxs has the length 59"):
        hybridgv.localize(*scene.arrays, camera=camera, keypoint_idxs=points[1:])
    with pytest.raises(ValueError, match=r"keypoint_idxs_rays\[3\] is 4294967296"):
        hybridgv.localize(*scene.arrays, camera=camera, keypoint_idxs_rays=np.where(rays == 3, 2**32, rays))
    with pytest.raises(ValueError, match="keypoint_idxs is not an array of integers"):
        hybridgv.localize(*scene.arrays, camera=camera, keypoint_idxs=points + 0.5)


def test_weights(scene, camera):
    weights = np.linspace(1, 0, 60)
    assert_right(hybridgv.localize(*scene.arrays, camera=camera, weights=weights, weights_rays=np.ones(80)), scene)
    with pytest.raises(ValueError, match="weights has the length 59"):
        hybridgv.localize(*scene.arrays, camera=camera, weights=weights[1:])


def test_hard_data_give_a_reason(camera):
    result = hybridgv.localize([[1, 2]], [[1, 2, 3]], camera=camera)
    assert not result.success and not result.has_pose
    assert result.failure_reason == "too few correspondences"
    with pytest.raises(ValueError, match="no pose was found: too few correspondences"):
        result.R
    assert result["cam_from_world"] is None
    assert "too few correspondences" in repr(result)
    assert not hybridgv.localize([], [], camera=camera).success


def test_conventions_of_the_pose(scene, camera):
    result = hybridgv.localize(*scene.arrays, camera=camera)
    assert np.allclose(result.cam_from_world[:, :3], result.R) and np.allclose(result.cam_from_world[:, 3], result.t)
    assert np.allclose(result.rotation, result.R.T) and np.allclose(result.position, -result.R.T @ result.t)
    assert np.allclose(result.center, result.position)
    w, x, y, z = result.qvec
    assert w >= 0 and np.isclose(np.linalg.norm(result.qvec), 1)
    assert np.isclose(result.R[2, 1] - result.R[1, 2], 4 * w * x)
    pose = hybridgv.FocalPose.from_cam_from_world(result.cam_from_world, result.focal_length)
    assert np.allclose(pose.rotation, result.rotation) and np.allclose(pose.position, result.position)
    with pytest.raises(ValueError, match=r"\(3, 4\), has \(3, 3\)"):
        hybridgv.FocalPose.from_cam_from_world(np.eye(3), 1)


def test_reads_like_a_dict(scene, camera):
    result = hybridgv.localize(*scene.arrays, camera=camera)
    values = dict(result)
    assert np.array_equal(values["cam_from_world"], result.cam_from_world)
    assert values["num_inliers"] == result.num_inliers
    assert np.array_equal(result["inlier_mask"], result.inlier_mask)
    assert result.get("nothing") is None and "qvec" in result
    with pytest.raises(KeyError):
        result["nothing"]


def test_pickle_and_repr(scene, camera):
    result = hybridgv.localize(*scene.arrays, camera=camera)
    copy = pickle.loads(pickle.dumps(result))
    assert same(copy, result) and np.array_equal(copy.inlier_mask, result.inlier_mask)
    assert f"focal length {result.focal_length:.6g}" in repr(result)
    options = hybridgv.Options(seed=3)
    assert pickle.loads(pickle.dumps(options)) == options
    pose = pickle.loads(pickle.dumps(result.pose))
    assert np.array_equal(pose.rotation, result.rotation)
    error = pickle.loads(pickle.dumps(hybridgv.FileError("a: b", "a", 3)))
    assert (str(error), error.file, error.line, error.byte_offset) == ("a: b", "a", 3, None)


def test_options_by_dict_and_by_object(scene, camera):
    expected = hybridgv.localize(*scene.arrays, camera=camera, options={"seed": 5, "max_reproj_error": 8})
    assert same(
        hybridgv.localize(*scene.arrays, camera=camera, options=hybridgv.Options(seed=5, max_reproj_error=8)), expected
    )
    threads = {"seed": 5, "max_reproj_error": 8, "threads": 3}
    assert same(hybridgv.localize(*scene.arrays, camera=camera, options=threads), expected)


def test_defaults_of_options_are_the_librarys():
    from hybridgv import _core

    defaults = _core.default_options()
    options = vars(hybridgv.Options())
    assert options.keys() == defaults.keys()
    assert {name for name in defaults if options[name] != defaults[name]} == {"solvers"}


@pytest.mark.parametrize(
    "options, message",
    [
        ({"max_error": 12}, "no option 'max_error', valid are .*max_reproj_error"),
        ({"max_reproj_error": "wide"}, "option 'max_reproj_error' cannot be 'wide'"),
        ({"threads": 1.5}, "option 'threads' cannot be 1.5"),
        ({"max_reproj_error": -1}, "max_reproj_error.*-1"),
        ({"min_focal_length": 5, "max_focal_length": 4}, "max_focal_length"),
        ({"max_focal_length_deviation": -1}, "max_focal_length_deviation"),
        ({"principal_point_deviation": -1}, "principal_point_deviation.*-1"),
        ({"scoring": "votes"}, "'msac' or 'inlier_count', is 'votes'"),
        ({"sampling": "some"}, "'quality_ordered' or 'uniform'"),
        ({"solvers": ["p5pf"]}, "p5pf.*p35pf"),
        ({"seed": -1}, "seed"),
        (7, "options must be a dict"),
    ],
)
def test_wrong_options_are_refused_by_name(scene, camera, options, message):
    with pytest.raises(ValueError, match=message):
        hybridgv.localize(*scene.arrays, camera=camera, options=options)


def test_misspelt_attributes_of_options_are_refused(scene, camera):
    options = hybridgv.Options()
    options.thread = 2
    with pytest.raises(ValueError, match="no option 'thread'"):
        hybridgv.localize(*scene.arrays, camera=camera, options=options)
    with pytest.raises(TypeError, match="thread"):
        hybridgv.Options(thread=2)


def test_every_option_is_taken(scene, camera):
    pose = hybridgv.localize(*scene.arrays, camera=camera).pose
    options = hybridgv.Options(
        solvers={"p35pf": 1.0, "h13f": 2.0}, scoring="inlier_count", sampling="uniform", initial_pose=pose, time_budget=10
    )
    result = hybridgv.localize(*scene.arrays, camera=camera, options=options)
    assert_right(result, scene)
    assert set(result.iterations_per_solver) <= {"p35pf", "h13f"}
    assert_right(hybridgv.localize(*scene.arrays, camera=camera, options={"solvers": ["p4pf"]}), scene)


def processor_seconds(run):
    start = time.process_time()
    run()
    return time.process_time() - start


def test_searches_run_without_the_lock():
    """While a search runs in another thread, this one goes on."""
    scene = make_scene(1, points=20000, rays=20000, wrong=0.5)
    done = threading.Event()

    def search():
        hybridgv.localize(*scene.arrays, camera=(WIDTH, HEIGHT), options={"min_iterations": 200})
        done.set()

    thread = threading.Thread(target=search)
    thread.start()
    steps = 0
    while not done.is_set():
        time.sleep(0.0005)
        steps += 1
    thread.join()
    assert steps > 20


def test_threads_give_the_same_results(camera):
    scenes = [make_scene(seed) for seed in range(8)]
    expected = [hybridgv.localize(*s.arrays, camera=camera) for s in scenes]
    found = [None] * 8

    def search(first):
        for i in range(first, 8, 2):
            found[i] = hybridgv.localize(*scenes[i].arrays, camera=camera)

    threads = [threading.Thread(target=search, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(same(a, b) for a, b in zip(found, expected))


def test_overhead_of_a_call(camera):
    """The processor's time beside the search is at most 30 us and 20 ns a correspondence (three times that on a busy machine)."""
    random = np.random.default_rng(0)
    options = hybridgv.Options(min_iterations=0, max_iterations=1, local_optimization=False, final_optimization=False)

    def overhead(count):
        pixels, points = random.uniform(0, 1000, size=(count, 2)), random.normal(size=(count, 3))
        times = []
        for _ in range(200 if count < 100 else 20):
            start = time.perf_counter()
            result = hybridgv.localize(pixels, points, camera=camera, options=options)
            times.append(time.perf_counter() - start - result.seconds)
        return min(times)

    few, many = overhead(3), overhead(50000)
    assert few < 90e-6
    assert (many - few) / 50000 < 60e-9


def test_memory_does_not_grow(scene, camera):
    def calls(count):
        for _ in range(count):
            hybridgv.localize([[1, 2]], [[1, 2, 3]], camera=camera)
            hybridgv.p4pf(scene.points2D[:4], scene.points3D[:4])
            with pytest.raises(ValueError):
                hybridgv.localize([[1, 2]], [[1, 2]], camera=camera)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = calls(2000)
    assert calls(34000) - before < 2000  # KiB, 10^5 calls


def test_instruction_set():
    command = [sys.executable, "-c", "import hybridgv; print(hybridgv.instruction_set())"]
    environment = dict(os.environ, HYBRIDGV_SIMD="baseline")
    assert subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout == "baseline\n"
    assert hybridgv.instruction_set() in ("baseline", "avx2", "avx512")


def test_version():
    assert hybridgv.__version__.count(".") == 2
