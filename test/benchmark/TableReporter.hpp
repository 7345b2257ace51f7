// Collects the repetitions of every benchmark and prints one table: medians of the CPU times, and their ratio to that of gp3p.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace hybridgv {
namespace benchmarks {

inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

class TableReporter : public benchmark::BenchmarkReporter {
 public:
  TableReporter(std::string yardstick, bool markdown) : yardstick_(std::move(yardstick)), markdown_(markdown) {}

  bool ReportContext(const Context& context) override {
    std::fprintf(stderr, "%d CPUs", context.cpu_info.num_cpus);
    for (double load : context.cpu_info.load_avg) std::fprintf(stderr, ", load %.2f", load);
    std::fprintf(stderr, "\n");
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const std::string& name = run.run_name.function_name;
      order_[run.family_index] = name;
      Row& row = rows_[name];
      row.microseconds.push_back(1e6 * run.cpu_accumulated_time / static_cast<double>(run.iterations));
      for (const auto& counter : run.counters) row.counters[counter.first] = counter.second.value;
    }
  }

  void Finalize() override {
    const double unit = rows_.count(yardstick_) ? median(rows_[yardstick_].microseconds) : 0;
    std::printf(
        markdown_ ? "| solver | us per call | x %s | mean solutions | max solutions | recovered %% |\n|---|---|---|---|---|---|\n"
                  : "%-16s us per call   x %s   mean solutions   max solutions   recovered %%\n",
        markdown_ ? yardstick_.c_str() : "solver", yardstick_.c_str());
    for (const auto& entry : order_) {
      const std::string& name = entry.second;
      Row& row = rows_[name];
      const double time = median(row.microseconds);
      std::printf(markdown_ ? "| %s | %.2f | %.3f | %.2f | %.0f | %.2f |\n" : "%-16s %11.2f   %6.3f   %14.2f   %13.0f   %11.2f\n",
                  name.c_str(), time, unit > 0 ? time / unit : 0, row.counters["mean solutions"], row.counters["max solutions"],
                  row.counters["recovered %"]);
    }
  }

 private:
  struct Row {
    std::vector<double> microseconds;
    std::map<std::string, double> counters;
  };
  std::string yardstick_;
  bool markdown_;
  std::map<std::int64_t, std::string> order_;  // by registration
  std::map<std::string, Row> rows_;
};

}  // namespace benchmarks
}  // namespace hybridgv
