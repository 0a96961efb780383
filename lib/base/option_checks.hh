// Checks of numbers on the command line, which NaN and infinity do not pass.
#pragma once

#include <functional>
#include <string>

namespace lgiw {

/// What is wrong with an option's value; nothing where it is sound. For CLI::Option::check().
std::string above_zero(const std::string& text);
std::function<std::string(const std::string&)> between(double low, double high);

}  // namespace lgiw
