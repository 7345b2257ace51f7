#include "hybridgv/adapters/report/Page.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "SfmQuery.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/ransacOptions.hpp"

namespace hybridgv {
namespace report {
namespace {

using test::makeQuery;
using test::QueryScene;
using test::Random;
using test::TemporaryFolder;

QueryScene scene(sfm::CameraModel model = sfm::CameraModel::SimpleRadial) {
  Random random(test::testSeed(), 0);
  return makeQuery(test::makeScene(random, 6, 120, 0.6, {sfm::CameraModel::SimplePinhole, sfm::CameraModel::OpenCV, model}), 2);
}

ReportedImage localized(const QueryScene& scene) {
  return reportedImage(scene.map, scene.query, localizeQuery(scene.map, scene.query));
}

ReportedImage failed(const std::string& name, const std::string& reason = "it is blurred") {
  ReportedImage image;
  image.name = name;
  image.reason = reason;
  return image;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// The data between the page's fixed parts.
std::string dataOf(const std::string& page) {
  const std::string start = "<script id=\"data\" type=\"application/json\">";
  const std::size_t first = page.find(start) + start.size();
  return page.substr(first, page.find("</script>", first) - first);
}

std::string pageOf(const QueryScene& scene, const std::vector<ReportedImage>& images, const PageOptions& options = {}) {
  return makePage("page.html", scene.map, images, options);
}

double distanceTo(const std::vector<sfm::Keypoint>& line, double x, double y) {
  double smallest = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d a(line[i].x, line[i].y), b(line[i + 1].x, line[i + 1].y), p(x, y);
    const double length = std::max((b - a).squaredNorm(), 1e-12);
    const double share = std::min(1.0, std::max(0.0, (p - a).dot(b - a) / length));
    smallest = std::min(smallest, (a + share * (b - a) - p).norm());
  }
  return smallest;
}

TEST(ReportedImage, TellsWhatWasFound) {
  const QueryScene s = scene();
  const sfm::QueryLocalization found = localizeQuery(s.map, s.query);
  const ReportedImage image = reportedImage(s.map, s.query, found);
  ASSERT_TRUE(image.success);
  EXPECT_EQ(image.name, s.query.name);
  EXPECT_NEAR(image.focalLength, s.truth.focalLength, 1e-3 * s.truth.focalLength);
  EXPECT_LT((image.pose.position - s.truth.position).norm(), 1e-2);
  EXPECT_EQ(image.marks2d3d.size(), found.problem.adapter.getNumberCorrespondences2d3d());
  EXPECT_EQ(image.marks2d2d.size(), found.problem.adapter.getNumberCorrespondences2d2d());
  for (std::size_t i = 0; i < image.marks2d3d.size(); ++i) {
    const sfm::Keypoint& keypoint = s.query.keypoints[found.problem.keypoints2d3d[i]];
    EXPECT_EQ(image.marks2d3d[i].x, keypoint.x);
    EXPECT_EQ(image.marks2d3d[i].isInlier, found.result.inliers2d3d[i] != 0);
  }
  EXPECT_EQ(image.mapImages.size(), s.query.matches.size());
}

// The corners' rays are those of the camera that was found.
TEST(ReportedImage, HasTheTrueFieldOfView) {
  const QueryScene s = scene();
  const ReportedImage image = localized(s);
  const sfm::Camera& camera = s.query.camera;
  const auto ray = sfm::bearingVector(camera, 0, 0);
  ASSERT_TRUE(ray);
  EXPECT_LT((image.corners[0] - *ray).norm(), 2e-3);
  EXPECT_GT(image.corners[2].x(), 0);
  EXPECT_GT(image.corners[2].y(), 0);
}

TEST(ReportedImage, EpipolarSegmentsPassThroughTheirKeypoints) {
  QueryScene s = scene();
  s.query.matches.resize(2);  // points of which the map is certain become few
  sfm::QueryOptions options;
  options.matches.minParallaxDeg = 60;
  const ReportedImage image = reportedImage(s.map, s.query, localizeQuery(s.map, s.query, options));
  ASSERT_TRUE(image.success) << image.reason;
  std::size_t tested = 0;
  for (const Mark& mark : image.marks2d2d) {
    EXPECT_TRUE(mark.isInlier || mark.epipolar.empty());
    if (mark.epipolar.size() < 2) continue;
    ++tested;
    EXPECT_LT(distanceTo(mark.epipolar, mark.x, mark.y), 5);
  }
  EXPECT_GT(tested, 0u);
}

TEST(ReportedImage, OfAnImageThatIsLeftOut) {
  Random random(test::testSeed(), 1);
  const sfm::SparseModel map = test::makeScene(random, 6, 120, 0.6, {sfm::CameraModel::SimpleRadial});
  for (const bool undistort : {false, true}) {
    sfm::LocalizationProblemOptions options;
    options.undistortQuery = undistort;
    const sfm::LocalizationProblem problem = makeLocalizationProblem(map, 3, options);
    const sac::HybridRansacResult result = hybridRansac(problem.adapter, ransacOptions(problem));
    ASSERT_TRUE(result.success);
    const ReportedImage image = reportedImage(map, 3, problem, result);
    const double f = sfm::focalLength(map.cameras[0]);
    EXPECT_NEAR(image.focalLength, f, 0.01 * f);
    const auto ray = sfm::bearingVector(map.cameras[0], 0, 0);
    EXPECT_LT((image.corners[0] - *ray).norm(), 0.02);
    for (std::size_t i = 0; i < image.marks2d3d.size(); ++i)
      EXPECT_EQ(image.marks2d3d[i].x, map.images[3].observations[problem.keypoints2d3d[i]].x);
  }
}

TEST(ReportedImage, RefusesWhatDoesNotBelongTogether) {
  const QueryScene s = scene();
  const sfm::QueryLocalization found = localizeQuery(s.map, s.query);
  sfm::QueryImage other = s.query;
  other.keypoints.resize(1);
  EXPECT_THROW(reportedImage(s.map, other, found), std::invalid_argument);
  EXPECT_THROW(reportedImage(sfm::SparseModel(), s.query, found), std::invalid_argument);
  EXPECT_THROW(reportedImage(s.map, 1000, found.problem, found.result), std::invalid_argument);
  EXPECT_THROW(reportedImage(s.map, 2, found.problem, found.result), std::invalid_argument);
}

TEST(Page, HoldsAllImages) {
  const QueryScene s = scene();
  const std::string page = pageOf(s, {localized(s), failed("two.jpg"), failed("three.jpg")});
  const std::string data = dataOf(page);
  EXPECT_EQ(count(data, "\"success\":true"), 1u);
  EXPECT_EQ(count(data, "\"success\":false"), 2u);
  EXPECT_EQ(count(data, "it is blurred"), 2u);
  EXPECT_NE(data.find("\"numberPoints\":120"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  // A name in XML is the only thing that looks like the network.
  EXPECT_EQ(page.find("http://www.w3.org/2000/svg"), page.find("://") - 4);
  EXPECT_EQ(count(page, "://"), 1u);
  EXPECT_EQ(page.find("/*page."), std::string::npos);
  EXPECT_EQ(page.find("/*data*/"), std::string::npos);
}

// Whatever a name is made of, the data hold neither markup nor the end of the script.
TEST(Page, NamesAreText) {
  const QueryScene s = scene();
  const std::string name =
      "</script><script>alert(1)</script><!--&\"'\\\n\xE2\x80\xAE\xE2\x80\xA8\xF0\x9F\x98\x80\xFF\xC0\xAF\xED\xA0\x80.jpg";
  const std::string page = pageOf(s, {failed(name, name)}, PageOptions{name, {}});
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  const std::string data = dataOf(page);
  for (const char c : data) {
    EXPECT_TRUE(c >= ' ' && c < 0x7F);
    EXPECT_TRUE(c != '<' && c != '>' && c != '&' && c != '\'');
  }
  const std::string escaped =
      "\\u003C/script\\u003E\\u003Cscript\\u003Ealert(1)\\u003C/script\\u003E\\u003C!--\\u0026\\u0022\\u0027\\u005C\\u000A"
      "\\u202E\\u2028\\uD83D\\uDE00\\uFFFD\\uFFFD\\uFFFD\\uFFFD\\uFFFD\\uFFFD.jpg";
  EXPECT_EQ(count(data, '"' + escaped + '"'), 3u);
}

TEST(Page, SaysWhatItLeavesOut) {
  const QueryScene s = scene();
  PageOptions options;
  options.maxPoints = 50;
  options.maxMarks = 3;
  const std::string data = dataOf(pageOf(s, {localized(s)}, options));
  EXPECT_NE(data.find("\"stride\":3"), std::string::npos);
  EXPECT_EQ(data.find("\"marks2d3d\""), std::string::npos);
  EXPECT_NE(data.find("\"number2d3d\":"), std::string::npos);
}

// Images that have been appended without their correspondences make the same page as all of them.
TEST(Page, NeedsNoMarksThatItDoesNotShow) {
  const QueryScene s = scene();
  const ReportedImage image = localized(s);
  PageOptions options;
  options.maxMarks = 2 * (image.marks2d3d.size() + image.marks2d2d.size()) + 1;
  std::vector<ReportedImage> appended;
  for (int i = 0; i < 5; ++i) addImage(appended, image, options.maxMarks);
  for (std::size_t i = 0; i < appended.size(); ++i) {
    EXPECT_EQ(appended[i].marks2d3d.empty(), i >= 2);
    EXPECT_EQ(appended[i].matches2d3d, image.marks2d3d.size());
  }
  EXPECT_EQ(pageOf(s, appended, options), pageOf(s, std::vector<ReportedImage>(5, image), options));
}

TEST(Page, EmbedsImagesAndLinksLargeOnes) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("in"));
  const std::string jpeg = "\xFF\xD8\xFF";
  folder.write("in/a.jpg", jpeg);
  folder.write("in/b #1.jpg", jpeg + std::string(100, 'x'));
  folder.write("in/c.jpg", "<svg onload=alert(1)>");
  folder.write("d.jpg", jpeg);
  const QueryScene s = scene();
  PageOptions options;
  options.imageFolder = folder.file("in");
  options.maxImageBytes = 50;
  const std::vector<ReportedImage> images{failed("a.jpg"),
                                          failed("b #1.jpg"),
                                          failed("c.jpg"),
                                          failed("../d.jpg"),
                                          failed(folder.file("d.jpg")),
                                          failed("missing.jpg"),
                                          failed(std::string("a.jpg\0", 6))};
  const std::string data = dataOf(makePage(folder.file("page.html"), s.map, images, options));
  EXPECT_EQ(count(data, "\"address\""), 2u);
  EXPECT_NE(data.find("\"address\":\"data:image/jpeg;base64,/9j/\""), std::string::npos);
  EXPECT_NE(data.find("\"address\":\"./in/b%20%231.jpg\""), std::string::npos);
}

// Numbers that are not finite do not get into the data, and maps without anything make a page too.
TEST(Page, OfPoorData) {
  QueryScene s = scene();
  s.map.points[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  ReportedImage image = localized(s);
  image.focalLengthStandardDeviation = std::numeric_limits<double>::infinity();
  EXPECT_NE(dataOf(pageOf(s, {image})).find("\"focalLengthDeviation\":null"), std::string::npos);
  image.pose.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pageOf(s, {image}), std::invalid_argument);
  EXPECT_NE(makePage("page.html", {}, {}).find("\"images\":[]"), std::string::npos);
}

// A fisheye camera and a panorama in the map, which have no corners in front of them; a camera of unknown size.
TEST(Page, DrawsCamerasOfAllModels) {
  Random random(test::testSeed(), 2);
  sfm::SparseModel map = test::makeScene(random, 20, 50, 0.6, test::colmapModels());
  map.cameras[0].width = 0;
  const std::string data = dataOf(makePage("page.html", map, {}));
  const std::size_t first = data.find("\"mapCameras\":\"") + std::strlen("\"mapCameras\":\"");
  EXPECT_EQ(data.find('"', first) - first, 20u * 15 * 4 / 3 * 4);
}

TEST(Page, TakesItsPlace) {
  const TemporaryFolder folder;
  const QueryScene s = scene();
  const std::vector<ReportedImage> images{localized(s)};
  writePage(folder.file("page.html"), s.map, images);
  EXPECT_EQ(folder.read("page.html"), makePage(folder.file("page.html"), s.map, images));
  EXPECT_THROW(writePage(folder.file("nowhere/page.html"), s.map, images), sfm::FileError);
}

TEST(Ply, HoldsPointsAndCameras) {
  const TemporaryFolder folder;
  const QueryScene s = scene();
  writePly(folder.file("map.ply"), s.map, {localized(s), failed("two.jpg")});
  const std::string ply = folder.read("map.ply");
  constexpr std::size_t kVerticesOfCamera = 8 * 31, kBytes = 3 * 8 + 3;
  const std::size_t vertices = 120 + (5 + 1) * kVerticesOfCamera;
  EXPECT_NE(ply.find("element vertex " + std::to_string(vertices) + "\n"), std::string::npos);
  const std::size_t start = ply.find("end_header\n") + std::strlen("end_header\n");
  ASSERT_EQ(ply.size() - start, vertices * kBytes);
  double x = 0;
  std::memcpy(&x, &ply[start], sizeof x);
  EXPECT_EQ(x, s.map.points[0].position.x());
}

}  // namespace
}  // namespace report
}  // namespace hybridgv
