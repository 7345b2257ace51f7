#include "CommandLine.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace program {
namespace {

// Without the blanks around it and the carriage return of Windows' text files.
std::string trimmed(const std::string& line) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

std::string checkSeed(const std::string& given) {
  std::uint64_t seed = 0;
  const char* const end = given.data() + given.size();
  const auto result = std::from_chars(given.data(), end, seed);
  return result.ec == std::errc() && result.ptr == end ? std::string() : "must be an integer from 0 to 2^64 - 1, is " + given;
}

}  // namespace

bool isPositive(double value) { return value > 0 && std::isfinite(value); }
bool isNotNegative(double value) { return value >= 0 && std::isfinite(value); }
bool isShare(double value) { return value >= 0 && value <= 1; }
bool isProbability(double value) { return value > 0 && value < 1; }
bool isCount(int value) { return value > 0; }
bool isNotNegativeInteger(int value) { return value >= 0; }

void addSeed(CLI::App& app, const char* name, std::uint64_t& seed, const char* help) {
  app.add_option(name, seed, help)->check(checkSeed)->capture_default_str();
}

void addSwitch(CLI::App& app, const char* name, bool& value, const char* help) {
  const auto check = [](const std::string& given) {
    const bool isSwitch = given == "0" || given == "1" || given == "false" || given == "true";
    return isSwitch ? std::string() : "must be 0 or 1, is " + given;
  };
  const auto set = [&value](const std::string& given) { value = given == "1" || given == "true"; };
  app.add_option_function<std::string>(name, set, help)->check(check)->default_str(value ? "1" : "0")->type_name("0|1");
}

int parse(CLI::App& app, std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants it
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUsage;
  }
  return -1;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned char>(c));
    const bool isControl = (c >= 0 && c < ' ') || c == 127;
    result += isControl ? std::string(code) : std::string(1, c);
  }
  return result + "\"";
}

std::vector<std::string> readLines(std::istream& in) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    line = trimmed(line);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

void flushOutput() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw std::runtime_error("cannot write to the standard output");
}

std::string shortened(const std::string& name, std::size_t width) {
  if (name.size() <= width) return name;
  std::size_t start = name.size() - (width - 2);
  const auto isInsideOfCharacter = [&] { return (static_cast<unsigned char>(name[start]) & 0xC0) == 0x80; };  // of UTF-8
  while (start < name.size() && isInsideOfCharacter()) ++start;
  return ".." + name.substr(start);
}

}  // namespace program
