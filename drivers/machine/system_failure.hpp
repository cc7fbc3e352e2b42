#pragma once
/// What is thrown where the system refuses something.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <system_error>

namespace clathra {

[[noreturn]] inline void system_failure(int error, std::string const& what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(error)));
}

}  // namespace clathra
