#include "Situations.hpp"

#include <limits>

namespace hybridgv {
namespace test {

using Eigen::Vector3d;

static void keepScene(SituationScene&, Random&) {}
static void keepProblem(MinimalProblem&, Random&) {}

// An image coordinate times `image`, a length times `length`.
static void rescale(MinimalProblem& problem, double image, double length) {
  for (solvers::RayMatch& ray : problem.rays) {
    ray.u *= image;
    ray.v *= image;
    ray.centre *= length;
  }
  for (solvers::PointMatch& match : problem.points) {
    match.u *= image;
    match.v *= image;
    match.point *= length;
  }
  problem.truth.focalLength *= image;
  problem.truth.position *= length;
}

// Replaces the focal length, and the distance of the query by one from which the scene has about the same size in the image.
static void zoom(SituationScene& scene, double focalLength) {
  scene.query.position *= focalLength / scene.query.focalLength;
  scene.query.focalLength = focalLength;
}

static Vector3d direction(const SituationScene& scene, double u, double v) {
  return scene.query.rotation * Vector3d(u / scene.query.focalLength, v / scene.query.focalLength, 1);
}

static std::vector<Situation> makeSituations() {
  std::vector<Situation> list;
  const auto addScene = [&](const std::string& name, const std::string& outcomes,
                            const std::function<void(SituationScene&, Random&)>& change) {
    list.push_back({name, outcomes, change, &keepProblem});
  };
  const auto addProblem = [&](const std::string& name, const std::string& outcomes,
                              const std::function<void(MinimalProblem&, Random&)>& change) {
    list.push_back({name, outcomes, &keepScene, change});
  };

  // A letter for each solver (see Situation::outcomes), in groups:
  //
  //   ttt             p4pf, p35pf, h13f
  //       ttt         h32f with the rays of 1+1+1, 2+1, 3 to a camera
  //           tttttt         h51f with 1+1+1+1+1, 2+1+1+1, 2+2+1, 3+1+1, 3+2, 4+1
  //                  tt      h51f with 5, sixpt_onefocal
  //                     tttttttttttttt   h70f with 1+1+1+1+1+1+1, 2+1+1+1+1+1, 2+2+1+1+1, 2+2+2+1, 3+1+1+1+1, 3+2+1+1,
  //                                      3+2+2, 3+3+1, 4+1+1+1, 4+2+1, 4+3, 5+1+1, 5+2, 6+1
  //                                    t         p3p
  //                                      tt      h22 with the rays of 1+1, 2 to a camera
  //                                         t    h41
  //                                           t  h60
  //                                             t fivept
  addScene("all_scene_points_coplanar", "ttt ttt tttttt 00 ttttttttttttt0 t tt t t t", [](SituationScene& scene, Random& random) {
    const Vector3d normal = random.direction();
    for (Vector3d& point : scene.scenePoints) point -= normal * normal.dot(point);
  });
  addScene("all_scene_points_collinear", "000 000 000000 00 00000000000000 0 vv 0 0 0",
           [](SituationScene& scene, Random& random) {
             const Vector3d along = random.direction();
             for (Vector3d& point : scene.scenePoints) point = along * along.dot(point);
           });
  addScene("first_three_points_collinear", "000 ... ...... .. .............. 0 .. . . .",
           [](SituationScene& scene, Random& random) {
             scene.point(2) = scene.point(0) + random.uniform(0.2, 0.8) * (scene.point(1) - scene.point(0));
           });
  addScene("two_points_coincide", "000 000 ...... .. .............. 0 00 . . .",
           [](SituationScene& scene, Random&) { scene.point(1) = scene.point(0); });
  addScene("all_points_coincide", "000 000 ...... .. .............. 0 00 . . .", [](SituationScene& scene, Random&) {
    for (std::size_t i = 1; i < scene.points(); ++i) scene.point(i) = scene.point(0);
  });
  addProblem("points_coincide_but_not_their_images", "000 000 ...... .. .............. 0 00 . . .",
             [](MinimalProblem& problem, Random&) { problem.points[1].point = problem.points[0].point; });
  addScene("two_points_on_one_line_of_sight", "000 vvv ...... .. .............. t 00 . . .",
           [](SituationScene& scene, Random& random) {
             scene.point(1) = scene.query.position + random.uniform(1.1, 1.3) * (scene.point(0) - scene.query.position);
           });
  addProblem("image_points_of_two_points_coincide", "000 vvv ...... .. .............. v 00 . . .",
             [](MinimalProblem& problem, Random&) {
               problem.points[1].u = problem.points[0].u;
               problem.points[1].v = problem.points[0].v;
             });
  addProblem("all_image_points_coincide", "000 000 000000 00 00000000000000 0 00 0 0 0",
             [](MinimalProblem& problem, Random& random) {
               const double u = random.uniform(-500, 500), v = random.uniform(-500, 500);
               for (solvers::RayMatch& ray : problem.rays) {
                 ray.u = u;
                 ray.v = v;
               }
               for (solvers::PointMatch& match : problem.points) {
                 match.u = u;
                 match.v = v;
               }
             });
  addProblem("all_image_points_at_the_principal_point", "000 000 000000 00 00000000000000 0 00 0 0 0",
             [](MinimalProblem& problem, Random&) { rescale(problem, 0, 1); });
  addProblem("image_points_collinear", "vvv 000 vvvvv0 00 vvvvvvvvvvvvv0 v vv v v v",
             [](MinimalProblem& problem, Random& random) {
               const double slope = random.uniform(-1, 1), offset = random.uniform(-100, 100);
               for (solvers::RayMatch& ray : problem.rays) ray.v = offset + slope * ray.u;
               for (solvers::PointMatch& match : problem.points) match.v = offset + slope * match.u;
             });
  addScene("scene_and_query_coplanar", "vvv 000 vvvvv0 00 vvvvvvvvvvvvv0 t tt v v v", [](SituationScene& scene, Random& random) {
    const Vector3d along = direction(scene, random.uniform(-100, 100), random.uniform(-100, 100));
    const Vector3d normal = along.cross(random.direction()).normalized();
    for (Vector3d& point : scene.scenePoints) point -= normal * normal.dot(point - scene.query.position);
  });
  addScene("one_image_point_at_the_principal_point", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
           [](SituationScene& scene, Random& random) {
             scene.scenePoints[0] = scene.query.position + random.uniform(12, 28) * scene.query.rotation.col(2);
           });
  addScene("two_scene_points_of_rays_coincide", "... tt0 tttttt 00 tttttttttttttt . t0 0 t 0",
           [](SituationScene& scene, Random&) { scene.scenePoints[scene.rays() - 1] = scene.scenePoints[0]; });
  addProblem("ray_repeated", "... 000 000000 00 00000000000000 . 00 0 0 0",
             [](MinimalProblem& problem, Random&) { problem.rays.back() = problem.rays.front(); });
  addProblem("all_rays_equal", "... 000 000000 00 00000000000000 . 00 0 0 0", [](MinimalProblem& problem, Random&) {
    for (solvers::RayMatch& ray : problem.rays) ray = problem.rays[0];
  });
  addProblem("all_rays_parallel", "... vvv vvvvvv 00 vvvvvvvvvvvvv0 . vv 0 0 0", [](MinimalProblem& problem, Random&) {
    for (solvers::RayMatch& ray : problem.rays) ray.direction = problem.rays[0].direction;
  });
  addScene("ray_through_a_point", "..0 000 000000 0. .............. . vv 0 . .",
           [](SituationScene& scene, Random&) { scene.scenePoints[0] = scene.point(0); });
  addScene("centre_at_a_point", "..t t00 ttt000 0. .............. . tt 0 . .",
           [](SituationScene& scene, Random&) { scene.centreOfRay(0) = scene.point(0); });
  addScene("ray_through_the_centre_of_the_query", "..v vvv vvvvvv vv vvvvvvvvvvvvvv . vv v v v",
           [](SituationScene& scene, Random& random) {
             const Vector3d centre = scene.centreOfRay(0);
             scene.scenePoints[0] = scene.query.position + random.uniform(0.5, 0.9) * (centre - scene.query.position);
           });
  addScene("all_centres_equal", "... ttt tttttt tt 00000000000000 . tt t 0 t", [](SituationScene& scene, Random&) {
    for (Vector3d& centre : scene.centres) centre = scene.centres[0];
  });
  addScene("pure_rotation", "..v vvv 000000 00 00000000000000 . vv v 0 v", [](SituationScene& scene, Random&) {
    for (Vector3d& centre : scene.centres) centre = scene.query.position;
  });
  addScene("query_at_one_of_the_centres", "... vvv vvvvvv 00 vvvvvvvvvvvvv0 . vv v v v",
           [](SituationScene& scene, Random&) { scene.centres[0] = scene.query.position; });
  addScene("query_on_the_line_of_two_centres", "... tt. tttttt .. ttttttttttvtvv . t. . v .", [](SituationScene& scene, Random&) {
    scene.centres[1] = scene.query.position + 0.4 * (scene.centres[0] - scene.query.position);
  });
  addScene("all_behind_the_query", "vvv vvv vvvvvv vv vvvvvvvvvvvvvv v vv v v v",
           [](SituationScene& scene, Random&) { scene.query.rotation.rightCols<2>() *= -1; });
  addScene("one_behind_the_query", "vvv vvv vvvvvv vv vvvvvvvvvvvvvv v vv v v v", [](SituationScene& scene, Random& random) {
    scene.scenePoints.back() =
        scene.query.position - random.uniform(5, 25) * direction(scene, random.uniform(-500, 500), random.uniform(-500, 500));
  });
  addProblem("rays_point_backwards", "..v vvv vvvvvv vv vvvvvvvvvvvvvv . vv v v v", [](MinimalProblem& problem, Random&) {
    for (solvers::RayMatch& ray : problem.rays) ray.direction *= -1;
  });
  for (const double f : {1e-3, 1e6}) {
    const std::string value = f < 1 ? "a_thousandth" : "a_million";
    addProblem("focal_length_" + value + "_by_the_unit", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
               [f](MinimalProblem& problem, Random&) { rescale(problem, f / problem.truth.focalLength, 1); });
  }
  addScene("focal_length_a_million_by_distance", "ttt ttt tttttt tt tttttttttttttt v tt t t t",
           [](SituationScene& scene, Random&) { zoom(scene, 1e6); });
  addScene("focal_length_a_thousandth_by_field_of_view", "vvv vvv vvvvvv vv vvvvvvvvvvvvvv v tt t t t",
           [](SituationScene& scene, Random& random) {
             scene.query.focalLength = 1e-3;
             for (Vector3d& point : scene.scenePoints)
               point = scene.query.position +
                       1e-5 * random.uniform(1, 10) * direction(scene, random.uniform(-500, 500), random.uniform(-500, 500));
           });
  addProblem("rig_frame_shifted_by_1e8", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random& random) {
               const Vector3d shift = 1e8 * random.direction();
               for (solvers::RayMatch& ray : problem.rays) ray.centre += shift;
               for (solvers::PointMatch& match : problem.points) match.point += shift;
               problem.truth.position += shift;
             });
  addProblem("lengths_of_1e8", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1, 1e8 / 20); });
  addProblem("image_coordinates_of_1e8", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1e8 / 500, 1); });
  addProblem("lengths_of_1e150", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1, 1e150); });
  addProblem("lengths_of_1e300", "000 000 000000 0t 00000000000000 t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1, 1e300); });
  addProblem("image_coordinates_of_1e150", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1e147, 1); });
  addProblem("image_coordinates_of_1e150th", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1e-153, 1); });
  addProblem("image_coordinates_of_1e300", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1e298, 1); });
  addProblem("lengths_of_1e150th", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1, 1e-150); });
  addProblem("lengths_denormal", "000 000 000000 0t 00000000000000 t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1, 1e-312); });
  addProblem("image_coordinates_denormal", "ttt ttt tttttt tt tttttttttttttt t tt t t t",
             [](MinimalProblem& problem, Random&) { rescale(problem, 1e-313, 1); });
  addScene("one_image_point_denormal", "ttt ttt tttttt tt tttttttttttttt t tt t t t", [](SituationScene& scene, Random& random) {
    scene.scenePoints[0] = scene.query.position + random.uniform(12, 28) * scene.query.rotation.col(2);
  });
  list.back().changeProblem = [](MinimalProblem& problem, Random&) {
    double& u = problem.rays.empty() ? problem.points[0].u : problem.rays[0].u;
    double& v = problem.rays.empty() ? problem.points[0].v : problem.rays[0].v;
    u = 1e-310;
    v = -std::numeric_limits<double>::denorm_min();
  };
  addProblem("everything_zero", "000 000 000000 00 00000000000000 0 00 0 0 0",
             [](MinimalProblem& problem, Random&) { rescale(problem, 0, 0); });
  return list;
}

const std::vector<Situation>& situations() {
  static const std::vector<Situation> list = makeSituations();
  return list;
}

}  // namespace test
}  // namespace hybridgv
