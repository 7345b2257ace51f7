// What all experiments have in common on their command lines.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

struct CommonOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  bool quick = false, quiet = false;
  std::string output = ".";
};

inline void addCommonOptions(CLI::App& app, CommonOptions& options, const std::string& useOfThreads) {
  app.add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  app.add_option("--threads", options.threads, useOfThreads)->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_flag("--quick", options.quick, "a small run of seconds, to see that everything works");
  app.add_option("--output", options.output, "existing folder for the CSV files")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "no progress bar");
}

// Parses the command line and runs the experiment; returns the exit code of the program.
inline int runExperiment(CLI::App& app, int argc, char** argv, const std::function<void()>& experiment) {
  try {
    app.parse(argc, argv);
    experiment();
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s: %s\n", argv[0], error.what()), 1;
  }
}
