// A table on disk: lines that start with # say where it comes from, then the names of the columns, then the rows.
#pragma once

#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Its arguments one after the other.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (void)std::initializer_list<int>{(out << parts, 0)...};
  return out.str();
}

class CsvFile {
 public:
  CsvFile(const std::string& folder, const std::string& name, const std::vector<std::string>& remarks, const std::string& columns)
      : path_(folder + "/" + name), out_(path_) {
    out_.precision(5);
    for (const std::string& remark : remarks) out_ << "# " << remark << '\n';
    out_ << columns << '\n';
  }
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  template <class First, class... Rest>
  void row(const First& first, const Rest&... rest) {
    out_ << first;
    (void)std::initializer_list<int>{(out_ << ',' << rest, 0)...};
    if (!(out_ << '\n' << std::flush)) throw std::runtime_error("cannot write " + path_);
  }

 private:
  std::string path_;
  std::ofstream out_;
};
