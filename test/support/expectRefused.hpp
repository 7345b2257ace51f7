// Wrong calls throw std::invalid_argument, with a message that names the argument.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

namespace hybridgv {
namespace test {

// `wrong` says what is wrong with the call; the message must contain `argument`.
inline void expectRefused(const std::string& wrong, const std::string& argument, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << wrong << ": accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(argument), std::string::npos)
        << wrong << ": expected a message about " << argument << ", got: " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << wrong << ": another exception: " << error.what();
  }
}

inline void expectRefused(const std::string& argument, const std::function<void()>& call) {
  expectRefused("wrong " + argument, argument, call);
}

}  // namespace test
}  // namespace hybridgv
