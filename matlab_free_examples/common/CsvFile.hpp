// A table on disk: lines that start with # say where it comes from, then the names of the columns, then the rows.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

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
