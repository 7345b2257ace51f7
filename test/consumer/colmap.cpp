// A program that reads COLMAP's databases.
#include <hybridgv/adapters/colmap/DatabaseQueries.hpp>
#include <hybridgv/adapters/sfm/FileError.hpp>

#include <cstdio>

int main() try {
  const hybridgv::sfm::ColmapDatabase database("no_such_database.db");
  return 1;
} catch (const hybridgv::sfm::FileError& error) {
  std::printf("%s\n", error.what());
  return 0;
}
