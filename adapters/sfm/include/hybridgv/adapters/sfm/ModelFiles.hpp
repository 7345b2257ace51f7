/// \file
/// \brief Readers and writers of sparse models: COLMAP (text and binary), Bundler, NVM.
///
/// Every reader throws FileError, with file and line or byte offset, for a file that is missing, truncated or malformed: a word
/// where a number is expected, NaN, infinite or out-of-range values, an index or id that names nothing, an id that occurs twice,
/// a count that does not fit the contents, anything after the end. The memory taken is proportional to the size of the files,
/// whatever counts they declare.
///
/// The time taken is that of parsing the numbers: about a second for a hundred megabytes of text.
#pragma once

#include <string>

#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// Reads a model whatever its format:
/// * a folder with cameras.bin, images.bin, points3D.bin: COLMAP binary (preferred if both kinds are there)
/// * a folder with cameras.txt, images.txt, points3D.txt: COLMAP text
/// * a file that starts with "NVM_V3": VisualSFM
/// * a file that starts with "# Bundle file v0.3": Bundler
HYBRIDGV_EXPORT SparseModel readModel(const std::string& path);

/// COLMAP's cameras.txt, images.txt, points3D.txt in a folder.
///
/// Camera models SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV; for any other the error names the model. An observation
/// and the track that lists it must agree.
HYBRIDGV_EXPORT SparseModel readColmapText(const std::string& folder);

/// COLMAP's cameras.bin, images.bin, points3D.bin in a folder; see readColmapText.
HYBRIDGV_EXPORT SparseModel readColmapBinary(const std::string& folder);

/// A Bundler v0.3 file (bundle.out).
///
/// Bundler's cameras look along -z and its image y axis points up; both are converted (y and z axes of the camera change sign).
/// Cameras with f = 0 become images with registered == false. The format has no names: image i is called "image_i". Each image
/// has its own camera, of model Radial.
HYBRIDGV_EXPORT SparseModel readBundler(const std::string& path);

/// The first model of a VisualSFM file (NVM_V3, also with "FixedK fx cx fy cy"); the following models are checked but not kept.
///
/// Image positions are relative to the principal point; radial distortion is that of CameraModel::NvmRadial. With FixedK, the
/// focal lengths are fx and fy. A double quote in an image name stands for a space.
HYBRIDGV_EXPORT SparseModel readNvm(const std::string& path);

/// Writes cameras.txt, images.txt, points3D.txt into an existing folder; images that are not registered are left out. Numbers are
/// written with as many digits as are needed to read the same values again.
/// \throws FileError if a file cannot be written; std::invalid_argument for a camera that COLMAP cannot describe (NvmRadial with
///         distortion; without, it becomes PINHOLE), or a model whose indices are not valid
HYBRIDGV_EXPORT void writeColmapText(const std::string& folder, const SparseModel& model);

/// Writes cameras.bin, images.bin, points3D.bin; see writeColmapText.
HYBRIDGV_EXPORT void writeColmapBinary(const std::string& folder, const SparseModel& model);

}  // namespace sfm
}  // namespace hybridgv
