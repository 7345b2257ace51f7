/// \file
/// \brief Readers and writers of sparse models: COLMAP (text and binary), Bundler, NVM.
///
/// Every reader throws FileError, with file and line or byte offset, for a file that is missing, empty, truncated or malformed: a
/// word where a number is expected, an id that occurs twice, a count that does not fit the contents, anything after the end.
///
/// What other programs and scripts commonly have wrong is mended, counted and told in a ReadReport (Mend lists all kinds): tracks
/// that name images that were removed, a point at infinity, 128.0 where an integer belongs. ReadOptions::strict makes an error of
/// each. After reading, points are compared with what the images see of them (ReadOptions::checkConsistency).
///
/// The memory taken is proportional to the size of the files, whatever counts they declare. The time taken is that of parsing the
/// numbers: about half a second for a hundred megabytes of text.
///
/// The last argument of each reader, what was mended, may be null.
#pragma once

#include <string>

#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/ReadReport.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// Reads a model whatever its format:
/// * a folder with cameras.bin, images.bin, points3D.bin: COLMAP binary (preferred if both kinds are there)
/// * a folder with cameras.txt, images.txt, points3D.txt: COLMAP text
/// * a project folder with such a folder as sparse/0, sparse or 0 (the report says which was read)
/// * one of these files of a COLMAP model: its folder
/// * a file that starts with "NVM_V3": VisualSFM
/// * a file that starts with "# Bundle file v0.3": Bundler
///
/// For anything else the error says what the file looks like, and what can be read.
HYBRIDGV_EXPORT SparseModel readModel(const std::string& path, const ReadOptions& options = {}, ReadReport* report = nullptr);

/// COLMAP's cameras.txt, images.txt, points3D.txt in a folder.
///
/// All camera models of COLMAP 4.1 (CameraModel); images whose camera has another one are not registered. Where images and tracks
/// contradict each other, what the images say counts. Rigs and frames of COLMAP 3.12 and later are kept.
HYBRIDGV_EXPORT SparseModel readColmapText(const std::string& folder, const ReadOptions& options = {},
                                           ReadReport* report = nullptr);

/// COLMAP's cameras.bin, images.bin, points3D.bin in a folder; see readColmapText.
HYBRIDGV_EXPORT SparseModel readColmapBinary(const std::string& folder, const ReadOptions& options = {},
                                             ReadReport* report = nullptr);

/// A Bundler v0.3 file (bundle.out).
///
/// Bundler's cameras look along -z and its image y axis points up; both are converted (y and z axes of the camera change sign).
/// Cameras with f = 0 become images with registered == false; views in them are left out of the tracks. The format has no names: image i is called "image_i". Each image
/// has its own camera, of model Radial.
HYBRIDGV_EXPORT SparseModel readBundler(const std::string& path, const ReadOptions& options = {}, ReadReport* report = nullptr);

/// The first model of a VisualSFM file (NVM_V3, also with "FixedK fx cx fy cy"; NVM_V3_R9T with rotation matrix and translation
/// instead of quaternion and centre); the following models are checked but not kept.
///
/// Image positions are relative to the principal point; radial distortion is that of CameraModel::NvmRadial. With FixedK, the
/// focal lengths are fx and fy. A double quote in an image name stands for a space.
HYBRIDGV_EXPORT SparseModel readNvm(const std::string& path, const ReadOptions& options = {}, ReadReport* report = nullptr);

/// Writes cameras.txt, images.txt, points3D.txt into a folder, which is made if it is missing; images that are neither registered nor carried along
/// (Image::carried) are left out. Rigs and frames too if the model has some; otherwise such files of another model are removed from
/// the folder. Numbers are written with as many digits as are needed to read the same values again; what was read and has not been
/// changed is written as it was.
///
/// The files take their places together. They are written into FOLDER.hybridgv-unfinished, and that takes the folder's place at once: what else
/// is in the folder remains. So whoever is killed leaves the old model or the new one. Where the system has no such exchange (it is
/// Linux's), where the folder has subfolders, is the working folder or cannot be written beside, the files are moved one after the
/// other in the end; a folder in which that was interrupted is not read until the next writer has completed it.
/// \throws FileError if a file cannot be written; std::invalid_argument for a camera that COLMAP cannot describe (NvmRadial with
///         distortion; without, it becomes PINHOLE), or a model whose indices are not valid
HYBRIDGV_EXPORT void writeColmapText(const std::string& folder, const SparseModel& model);

/// Writes cameras.bin, images.bin, points3D.bin; see writeColmapText.
HYBRIDGV_EXPORT void writeColmapBinary(const std::string& folder, const SparseModel& model);

}  // namespace sfm
}  // namespace hybridgv
