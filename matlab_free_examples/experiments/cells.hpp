// Experiments on random scenes that fill one ErrorTable, cell by cell.
#pragma once

#include <string>
#include <vector>

#include "../common/Options.hpp"
#include "ErrorTable.hpp"
#include "common/ProgressBar.hpp"

// measure(cell, table) for every cell; with --quick for one of `quickStep`.
template <class Cell, class Measure>
ErrorTable measureCells(const std::vector<Cell>& cells, const CommonOptions& common, std::size_t quickStep,
                        const Measure& measure) {
  ProgressBar progress(cells.size(), !common.quiet);
  ErrorTable table;
  for (std::size_t i = 0; i < cells.size(); ++i, progress.step())
    if (!common.quick || i % quickStep == 0) measure(cells[i], table);
  return table;
}

// The program: run(common options, scenes for each row).
template <class Run>
int runSceneExperiment(int argc, char** argv, const std::string& description, int scenes, const Run& run) {
  CLI::App app{description};
  CommonOptions common;
  addCommonOptions(app, common, "threads of hybridRansac");
  app.add_option("--scenes", scenes, "scenes for each row (--quick: 2)")->check(CLI::Range(1, 100000))->capture_default_str();
  return runExperiment(app, argc, argv, [&] { run(common, common.quick ? 2 : scenes); });
}
