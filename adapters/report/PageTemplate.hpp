// What is the same on every page: page.html with page.css and page.js inside, before and behind the data. Made by CMake.
#pragma once

namespace hybridgv {
namespace report {

extern const char* const kPageStart;
extern const char* const kPageEnd;

}  // namespace report
}  // namespace hybridgv
