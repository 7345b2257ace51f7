#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"

#include <cmath>
#include <string>
#include <typeinfo>
#include <utility>

#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace {

using Vectors = NoncentralHybridAdapter::Vectors;

void checkSize(const char* name, std::size_t size, const char* reference, std::size_t expected) {
  if (size != expected)
    throwInvalid(name, "has " + std::to_string(size) + " entries, " + reference + " has " + std::to_string(expected));
}

void checkSizeUnlessEmpty(const char* name, std::size_t size, const char* reference, std::size_t expected) {
  if (size != 0) checkSize(name, size, reference, expected);
}

std::string element(const char* name, std::size_t index) { return std::string(name) + "[" + std::to_string(index) + "]"; }

void checkAllFinite(const char* name, const Vectors& values) {
  for (std::size_t i = 0; i < values.size(); ++i)  // (names are made for messages only: there are many values)
    if (!values[i].allFinite()) checkFinite(element(name, i), values[i]);
}

void checkImagePoints(const char* name, const Vectors& points) {
  checkAllFinite(name, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i][2] == 0) throwInvalid(element(name, i), "must be homogeneous, (u, v, 1), is " + detail::format(points[i]));
}

void checkValues(const char* name, const std::vector<double>& values, bool negativeAllowed) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || (!negativeAllowed && values[i] < 0))
      throwInvalid(element(name, i), "must be finite" + std::string(negativeAllowed ? "" : " and not negative") + ", is " +
                                         detail::format(values[i]));
}

}  // namespace

NoncentralHybridAdapter::NoncentralHybridAdapter(Vectors imagePoints2d2d, Vectors bearingVectors, std::vector<int> camIndices,
                                                 Vectors camOffsets, Matrices camRotations, Vectors imagePoints2d3d,
                                                 Vectors points)
    : imagePoints2d2d_(std::move(imagePoints2d2d)),
      bearingVectors_(std::move(bearingVectors)),
      camIndices_(std::move(camIndices)),
      camOffsets_(std::move(camOffsets)),
      camRotations_(std::move(camRotations)),
      imagePoints2d3d_(std::move(imagePoints2d3d)),
      points_(std::move(points)) {
  checkSize("bearingVectors", bearingVectors_.size(), "imagePoints2d2d", imagePoints2d2d_.size());
  checkSize("camIndices", camIndices_.size(), "imagePoints2d2d", imagePoints2d2d_.size());
  checkSize("camRotations", camRotations_.size(), "camOffsets", camOffsets_.size());
  checkSize("points", points_.size(), "imagePoints2d3d", imagePoints2d3d_.size());
  checkImagePoints("imagePoints2d2d", imagePoints2d2d_);
  checkImagePoints("imagePoints2d3d", imagePoints2d3d_);
  checkAllFinite("bearingVectors", bearingVectors_);
  checkAllFinite("camOffsets", camOffsets_);
  checkAllFinite("points", points_);
  for (std::size_t i = 0; i < bearingVectors_.size(); ++i)
    if (bearingVectors_[i].isZero(0)) throwInvalid(element("bearingVectors", i), "its length is zero");
  for (std::size_t i = 0; i < camRotations_.size(); ++i) checkRotation(element("camRotations", i), camRotations_[i]);
  for (std::size_t i = 0; i < camIndices_.size(); ++i)
    if (camIndices_[i] < 0 || static_cast<std::size_t>(camIndices_[i]) >= camOffsets_.size())
      throwInvalid(element("camIndices", i),
                   std::to_string(camIndices_[i]) + " is outside the " + std::to_string(camOffsets_.size()) + " rig cameras");
}

NoncentralHybridAdapter::~NoncentralHybridAdapter() = default;

void NoncentralHybridAdapter::setRigFocalLengths(std::vector<double> focalLengths) {
  checkSize("focalLengths", focalLengths.size(), "camOffsets", camOffsets_.size());
  checkValues("focalLengths", focalLengths, false);
  rigFocalLengths_ = std::move(focalLengths);
}

void NoncentralHybridAdapter::setWeights(std::vector<double> weights2d2d, std::vector<double> weights2d3d) {
  checkSizeUnlessEmpty("weights2d2d", weights2d2d.size(), "imagePoints2d2d", imagePoints2d2d_.size());
  checkSizeUnlessEmpty("weights2d3d", weights2d3d.size(), "imagePoints2d3d", imagePoints2d3d_.size());
  checkValues("weights2d2d", weights2d2d, true);
  checkValues("weights2d3d", weights2d3d, true);
  weights2d2d_ = std::move(weights2d2d);
  weights2d3d_ = std::move(weights2d3d);
}

void NoncentralHybridAdapter::setFeatures(std::vector<int> features2d2d, std::vector<int> features2d3d) {
  checkSizeUnlessEmpty("features2d2d", features2d2d.size(), "imagePoints2d2d", imagePoints2d2d_.size());
  checkSizeUnlessEmpty("features2d3d", features2d3d.size(), "imagePoints2d3d", imagePoints2d3d_.size());
  features2d2d_ = std::move(features2d2d);
  features2d3d_ = std::move(features2d3d);
}

std::size_t NoncentralHybridAdapter::getNumberCorrespondences2d2d() const { return imagePoints2d2d_.size(); }
Eigen::Vector3d NoncentralHybridAdapter::getImagePoint2d2d(std::size_t index) const { return imagePoints2d2d_[index]; }
Eigen::Vector3d NoncentralHybridAdapter::getBearingVector(std::size_t index) const { return bearingVectors_[index]; }
int NoncentralHybridAdapter::getCamIndex(std::size_t index) const { return camIndices_[index]; }
Eigen::Vector3d NoncentralHybridAdapter::getCamOffset(std::size_t index) const {
  return camOffsets_[static_cast<std::size_t>(camIndices_[index])];
}
Eigen::Matrix3d NoncentralHybridAdapter::getCamRotation(std::size_t index) const {
  return camRotations_[static_cast<std::size_t>(camIndices_[index])];
}
double NoncentralHybridAdapter::getRigFocalLength(std::size_t index) const {
  return rigFocalLengths_.empty() ? 0 : rigFocalLengths_[static_cast<std::size_t>(camIndices_[index])];
}
double NoncentralHybridAdapter::getWeight2d2d(std::size_t index) const { return weights2d2d_.empty() ? 1 : weights2d2d_[index]; }

std::size_t NoncentralHybridAdapter::getNumberCorrespondences2d3d() const { return imagePoints2d3d_.size(); }
Eigen::Vector3d NoncentralHybridAdapter::getImagePoint2d3d(std::size_t index) const { return imagePoints2d3d_[index]; }
Eigen::Vector3d NoncentralHybridAdapter::getPoint(std::size_t index) const { return points_[index]; }
double NoncentralHybridAdapter::getWeight2d3d(std::size_t index) const { return weights2d3d_.empty() ? 1 : weights2d3d_[index]; }

int NoncentralHybridAdapter::getFeature2d2d(std::size_t index) const { return features2d2d_.empty() ? -1 : features2d2d_[index]; }
int NoncentralHybridAdapter::getFeature2d3d(std::size_t index) const { return features2d3d_.empty() ? -1 : features2d3d_[index]; }

bool NoncentralHybridAdapter::allowsConcurrentReads() const { return typeid(*this) == typeid(NoncentralHybridAdapter); }

}  // namespace hybridgv
