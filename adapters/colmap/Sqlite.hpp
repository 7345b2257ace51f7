// SQLite for reading: connections and statements that clean up after themselves and speak through FileError.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hybridgv {
namespace sfm {

class SqliteFile {
 public:
  // Never writes. Where the folder cannot be written, which a database in WAL mode needs, the file is read as one that nobody
  // changes, unless another program's changes wait beside it.
  explicit SqliteFile(const std::string& path);

  const std::string& path() const { return path_; }
  sqlite3* handle() const { return handle_.get(); }
  // The names of a table's columns; none: there is no such table.
  std::vector<std::string> columns(const std::string& table) const;
  // FileError with SQLite's reason.
  [[noreturn]] void fail(const std::string& where) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  void open(const std::string& parameters);
  bool canRead() const;

  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

// A prepared statement, to be run once or several times.
class SqliteStatement {
 public:
  // `where` stands in messages: "table images".
  SqliteStatement(const SqliteFile& file, std::string where, const std::string& sql);

  // While it lives, the statement reads rows, and the file cannot be written by others.
  struct Reset {
    void operator()(sqlite3_stmt* statement) const { sqlite3_reset(statement); }
  };
  using Run = std::unique_ptr<sqlite3_stmt, Reset>;
  // Starts anew, with the statement's only parameter.
  [[nodiscard]] Run bind(std::int64_t value);
  // False at the end.
  bool next();

  // Columns of the row, from 0. Integers must be stored as such and be in the range.
  bool isNull(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
  std::int64_t integer(int column, const char* name, std::int64_t smallest, std::int64_t largest) const;
  std::string_view blob(int column) const;  // also of texts; valid until next()
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  const SqliteFile& file_;
  std::string where_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace sfm
}  // namespace hybridgv
