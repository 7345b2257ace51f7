#include "Sqlite.hpp"

#include <filesystem>
#include <fstream>

#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// A path within an address.
std::string escaped(const std::string& path) {
  std::string result;
  for (const char c : path) {
    if (c == '%')
      result += "%25";
    else if (c == '?')
      result += "%3f";
    else if (c == '#')
      result += "%23";
    else
      result += c;
  }
  return result;
}

bool hasWaitingChanges(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path + "-wal", error);
  return !error && size > 0;
}

void expectDatabase(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw FileError::inFile(path, "is a folder, expected a database");
  if (!std::filesystem::is_regular_file(path, error)) throw FileError::inFile(path, "no such file");
  if (std::filesystem::file_size(path, error) == 0 && !error) throw FileError::inFile(path, "the file is empty");
  if (!std::ifstream(path, std::ios::binary)) throw FileError::inFile(path, "cannot be opened");
}

}  // namespace

SqliteFile::SqliteFile(const std::string& path) : path_(path) {
  expectDatabase(path);
  open("?mode=ro");
  if (!canRead() && sqlite3_errcode(handle()) != SQLITE_NOTADB && !hasWaitingChanges(path)) open("?mode=ro&immutable=1");
  if (!canRead()) fail("");
}

void SqliteFile::open(const std::string& parameters) {
  constexpr int kPatienceMs = 5000;
  const std::string address = "file:" + escaped(std::filesystem::absolute(path_).string()) + parameters;
  sqlite3* handle = nullptr;
  const int result =
      sqlite3_open_v2(address.c_str(), &handle, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (handle == nullptr) throw FileError::inFile(path_, "SQLite has no memory left");
  if (result != SQLITE_OK) fail("");
  sqlite3_busy_timeout(handle, kPatienceMs);
  // The file is foreign: nothing in it may run, and what it says about its own pages is checked.
  sqlite3_exec(handle, "PRAGMA trusted_schema = 0; PRAGMA cell_size_check = 1; PRAGMA query_only = 1", nullptr, nullptr, nullptr);
}

bool SqliteFile::canRead() const {
  return sqlite3_exec(handle(), "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::vector<std::string> SqliteFile::columns(const std::string& table) const {
  std::vector<std::string> result;
  SqliteStatement statement(*this, "table " + table, "SELECT name FROM pragma_table_info('" + table + "')");
  while (statement.next()) result.emplace_back(statement.blob(0));
  return result;
}

void SqliteFile::fail(const std::string& where) const {
  const int code = sqlite3_errcode(handle());
  std::string reason = where.empty() ? "" : where + ": ";
  if (code == SQLITE_NOTADB)
    reason += "this is no SQLite database";
  else
    reason += std::string("SQLite says: ") + sqlite3_errmsg(handle());
  if (code == SQLITE_IOERR || code == SQLITE_CORRUPT)
    reason += " (files " + path_ + "-wal and -shm that belong to another database have this effect)";
  throw FileError::inFile(path_, reason);
}

SqliteStatement::SqliteStatement(const SqliteFile& file, std::string where, const std::string& sql)
    : file_(file), where_(std::move(where)) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v3(file.handle(), sql.c_str(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT,
                                        &statement, nullptr);
  statement_.reset(statement);
  if (result != SQLITE_OK) file.fail(where_);
}

SqliteStatement::Run SqliteStatement::bind(std::int64_t value) {
  if (sqlite3_bind_int64(statement_.get(), 1, value) != SQLITE_OK) file_.fail(where_);
  return Run(statement_.get());
}

bool SqliteStatement::next() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) file_.fail(where_);
  return false;
}

std::int64_t SqliteStatement::integer(int column, const char* name, std::int64_t smallest, std::int64_t largest) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_INTEGER) fail(std::string(name) + " is not an integer");
  const std::int64_t value = sqlite3_column_int64(statement_.get(), column);
  if (value < smallest || value > largest) fail(std::string(name) + " is " + std::to_string(value));
  return value;
}

std::string_view SqliteStatement::blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr ? std::string_view()
                          : std::string_view(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

void SqliteStatement::fail(const std::string& reason) const { throw FileError::inFile(file_.path(), where_ + ": " + reason); }

}  // namespace sfm
}  // namespace hybridgv
