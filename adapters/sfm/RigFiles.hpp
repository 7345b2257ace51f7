// rigs and frames, which COLMAP 3.12 and later write beside its model.
#pragma once

#include <string>

#include "FolderReplacement.hpp"
#include "Mending.hpp"
#include "WrittenParts.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// Reads rigs.txt and frames.txt (.bin) of the folder, if both are there. Things that they refer to and that are missing in the
// model are left out of them.
void readRigsText(const std::string& folder, Mending& mending, SparseModel& model);
void readRigsBinary(const std::string& folder, Mending& mending, SparseModel& model);

// Writes them without what belongs to images that are not written. A model that has none leaves none in the folder: those of
// another model would contradict its images.
void writeRigsText(const WrittenParts& parts, FolderReplacement& files);
void writeRigsBinary(const WrittenParts& parts, FolderReplacement& files);

}  // namespace sfm
}  // namespace hybridgv
