// What all sub-commands share in reading their command lines.
#pragma once

#include <CLI/CLI.hpp>
#include <istream>
#include <string>
#include <vector>

namespace program {

// Exit codes. 0 is success.
constexpr int kFailed = 1;      // a file cannot be read or written, nothing to do
constexpr int kWrongUsage = 2;  // the command line
constexpr int kNotAll = 3;      // some images were not localized, and all were required
constexpr int kInterrupted = 130;

// Adds an option whose value must be a number for which `holds`. Otherwise the message names the option, what it `must` be and what
// was given.
template <class Number>
CLI::Option* addNumber(CLI::App& app, const char* name, Number& value, const char* help, const char* must,
                       bool (*holds)(Number)) {
  const auto check = [must, holds](const std::string& given) {
    Number number{};
    const bool isNumber = CLI::detail::lexical_cast(given, number);
    return isNumber && holds(number) ? std::string() : "must be " + std::string(must) + ", is " + given;
  };
  return app.add_option(name, value, help)->check(check)->capture_default_str();
}

bool isPositive(double value);     // and finite
bool isNotNegative(double value);  // and finite
bool isShare(double value);        // 0 .. 1
bool isProbability(double value);  // between 0 and 1
bool isCount(int value);           // > 0
bool isNotNegativeInteger(int value);

// --seed; CLI11 takes "-1" and numbers beyond 64 bits for other numbers.
void addSeed(CLI::App& app, const char* name, std::uint64_t& seed, const char* help);

// An option that is 0 or 1, or false or true, as COLMAP has them.
void addSwitch(CLI::App& app, const char* name, bool& value, const char* help);

// Parses, and returns the exit code if the program is to stop here (help, wrong usage), -1 otherwise.
int parse(CLI::App& app, std::vector<std::string> arguments);

// In quotation marks, with control characters as \xHH, so that one sees them.
std::string quoted(const std::string& text);

// The lines that are not empty, without the blanks around them and the carriage return of Windows' text files.
std::vector<std::string> readLines(std::istream& in);

// What was printed has arrived: results must not be lost in silence on a full disk, nor with a program that is interrupted.
void flushOutput();

// A name for a column of this width: one that is too long loses its beginning, which is the same for most.
std::string shortened(const std::string& name, std::size_t width);

}  // namespace program
