// Folders with the features and matches of real images, maps of some of them, and where the others were taken.
//
// FOLDER/database.db          all images, by COLMAP
// FOLDER/reference.txt        lines "MAP NAME WIDTH HEIGHT F K1 QW QX QY QZ TX TY TZ": an image that the map FOLDER/MAP lacks, with its focal
//                             length [px] and x_image = R(q) X + t, X in the frame of that map
// or, where there is no such file,
// FOLDER/reference            a model of all images
// FOLDER/maps/KIND.NUMBER     maps of some of them, in any frame and scale; queries.txt in a map's folder names the images that are
//                             looked for in it (else: all that it lacks)
#pragma once

#include <hybridgv/adapters/sfm/SparseModel.hpp>
#include <hybridgv/types.hpp>

#include <string>
#include <vector>

struct PhotoReference {
  std::string name;          // of the image
  hybridgv::FocalPose pose;  // in the map's frame
};

struct PhotoMap {
  std::string name, path;
  std::vector<PhotoReference> queries;

  std::string kind() const { return name.substr(0, name.find('.')); }
};

// The image of that name if it has a pose, else nullptr.
const hybridgv::sfm::Image* findPosed(const hybridgv::sfm::SparseModel& model, const std::string& name);

// Its pose and focal length (fx).
hybridgv::FocalPose poseOf(const hybridgv::sfm::SparseModel& model, const hybridgv::sfm::Image& image);

// The maps of a folder.
// \throws std::runtime_error for a folder that is laid out otherwise
std::vector<PhotoMap> readPhotoMaps(const std::string& folder);
